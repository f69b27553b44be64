// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "gl/embedded_shaders.hpp"

#include <fstream>
#include <iterator>
#include <map>
#include <memory>

namespace halfshadow::gl {
namespace {

struct EmbeddedShader {
  const char* name;
  const char* text;
};
constexpr EmbeddedShader kShaders[] = {
#include "embedded_shader_table.inc"
    {nullptr, nullptr}};

}  // namespace

const char* embeddedShader(std::string_view fileName) {
  for (const EmbeddedShader* shader = kShaders; shader->name; ++shader) {
    if (fileName == shader->name) return shader->text;
  }
  return nullptr;
}

std::vector<std::string_view> embeddedShaderNames() {
  std::vector<std::string_view> names;
  for (const EmbeddedShader* shader = kShaders; shader->name; ++shader) names.emplace_back(shader->name);
  return names;
}

ShaderSourceProvider directoryShaders(std::string path) {
  auto texts = std::make_shared<std::map<std::string, std::string, std::less<>>>();
  return [path = std::move(path), texts](std::string_view fileName) -> const char* {
    std::ifstream file(path + "/" + std::string(fileName), std::ios::binary);
    if (!file) return nullptr;
    std::string& text = (*texts)[std::string(fileName)];
    text.assign(std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>());
    return text.c_str();
  };
}

}  // namespace halfshadow::gl
