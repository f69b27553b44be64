// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include <algorithm>
#include <cctype>

#include "gl/program.hpp"

namespace halfshadow::gl {
namespace {

constexpr std::string_view kIncludeDirective = "#include";

Error assemblyError(std::string_view fileName, const std::string& text) {
  return {ErrorCode::shaderFailed, "Shader " + std::string(fileName) + ": " + text};
}

std::string_view trimmed(std::string_view text) {
  const auto isBlank = [](char c) { return c == ' ' || c == '\t' || c == '\r'; };
  while (!text.empty() && isBlank(text.front())) text.remove_prefix(1);
  while (!text.empty() && isBlank(text.back())) text.remove_suffix(1);
  return text;
}

/// Cuts the first line off `text`.
std::string_view takeLine(std::string_view& text) {
  const std::size_t end = text.find('\n');
  const std::string_view line = text.substr(0, end);
  text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
  return line;
}

/// "x.glsl" of `#include "x.glsl"`; empty when malformed.
std::string_view includedName(std::string_view line) {
  std::string_view rest = trimmed(trimmed(line).substr(kIncludeDirective.size()));
  if (rest.size() < 3 || rest.front() != '"') return {};
  rest.remove_prefix(1);
  const std::size_t end = rest.find('"');
  return end == std::string_view::npos ? std::string_view{} : rest.substr(0, end);
}

bool isInclude(std::string_view line) {
  return trimmed(line).starts_with(kIncludeDirective);
}

bool defined(const std::vector<std::string>& defines, std::string_view name) {
  return std::any_of(defines.begin(), defines.end(), [&](const std::string& define) {
    return define == name || define.starts_with(std::string(name) + " ");
  });
}

bool advertises(const device::Capabilities& capabilities, std::string_view extension) {
  const auto& list = capabilities.extensions;
  return std::find(list.begin(), list.end(), extension) != list.end();
}

Result<std::string> extensionLines(std::string_view fileName, const std::vector<std::string>& defines,
                                   const device::Capabilities& capabilities) {
  std::string lines, macros;
  if (capabilities.has(device::Capability::derivatives)) {
    lines += "#extension GL_OES_standard_derivatives : enable\n";
    macros += "#define HS_DERIVATIVES 1\n";
  }
  if (defined(defines, "HS_USE_LOD")) {
    if (!capabilities.has(device::Capability::textureLod)) {
      return assemblyError(fileName, "HS_USE_LOD needs the capability texture-lod; choose another variant.");
    }
    lines += "#extension GL_EXT_shader_texture_lod : enable\n";
  }
  if (defined(defines, "HS_USE_FETCH")) {
    if (!capabilities.has(device::Capability::framebufferFetch)) {
      return assemblyError(fileName,
                           "HS_USE_FETCH needs the capability framebuffer-fetch; choose another variant.");
    }
    if (advertises(capabilities, "GL_EXT_shader_framebuffer_fetch")) {
      lines += "#extension GL_EXT_shader_framebuffer_fetch : enable\n";
      macros += "#define HS_LAST_COLOR gl_LastFragData[0]\n";
    } else if (advertises(capabilities, "GL_ARM_shader_framebuffer_fetch")) {
      lines += "#extension GL_ARM_shader_framebuffer_fetch : enable\n";
      macros += "#define HS_LAST_COLOR gl_LastFragColorARM\n";
    } else {
      lines += "#extension GL_NV_shader_framebuffer_fetch : enable\n";
      macros += "#define HS_LAST_COLOR gl_LastFragColor\n";
    }
  }
  return lines + macros;
}

}  // namespace

Result<std::string> assembleShader(const ShaderSourceProvider& provider, std::string_view fileName,
                                   const std::vector<std::string>& defines,
                                   const device::Capabilities& capabilities) {
  const char* text = provider(fileName);
  if (!text) return assemblyError(fileName, "there is no such file below shaders_es2/.");
  const bool isFragment = fileName.ends_with(".frag");

  std::string source = "#version 100\n// shaders_es2/" + std::string(fileName) + "\n";
  if (isFragment) {
    Result<std::string> lines = extensionLines(fileName, defines, capabilities);
    if (!lines) return lines.error();
    source += *lines;
  }
  if (!capabilities.has(device::Capability::highp)) source += "#define HS_NO_HIGHP 1\n";
  for (const std::string& define : defines) {
    source += "#define " + define + (define.find(' ') == std::string::npos ? " 1\n" : "\n");
  }
  if (isFragment) {
    source +=
        "#ifdef HS_NO_HIGHP\nprecision mediump float;\n#define HS_HIGHP mediump\n#define HS_SHARED mediump\n"
        "#else\nprecision highp float;\n#define HS_HIGHP highp\n#define HS_SHARED highp\n#endif\n";
  } else {
    source +=
        "#define HS_HIGHP highp\n"
        "#ifdef HS_NO_HIGHP\n#define HS_SHARED mediump\n#else\n#define HS_SHARED highp\n#endif\n";
  }
  source += "#line 1 0\n";

  std::string_view rest = text;
  int lineNumber = 0, includeCount = 0;
  while (!rest.empty()) {
    const std::string_view line = takeLine(rest);
    ++lineNumber;
    if (!isInclude(line)) {
      source.append(line) += '\n';
      continue;
    }
    const std::string where = "line " + std::to_string(lineNumber) + ": ";
    const std::string_view name = includedName(line);
    if (name.empty()) return assemblyError(fileName, where + "write #include \"file.glsl\".");
    const char* included = provider(name);
    if (!included)
      return assemblyError(fileName, where + "included file " + std::string(name) + " does not exist.");
    source += "#line 1 " + std::to_string(++includeCount) + "\n";
    std::string_view body = included;
    while (!body.empty()) {
      const std::string_view bodyLine = takeLine(body);
      if (isInclude(bodyLine)) {
        return assemblyError(fileName, where + std::string(name) +
                                           " includes another file; one level only: include both from here.");
      }
      source.append(bodyLine) += '\n';
    }
    source += "#line " + std::to_string(lineNumber + 1) + " 0\n";
  }
  return source;
}

std::vector<std::string> samplerNamesOf(std::string_view source) {
  std::string code;  // without comments
  for (std::size_t i = 0; i < source.size(); ++i) {
    if (source.substr(i).starts_with("//")) {
      i = std::min(source.find('\n', i), source.size());
      code += '\n';
    } else if (source.substr(i).starts_with("/*")) {
      const std::size_t end = source.find("*/", i + 2);
      i = end == std::string_view::npos ? source.size() : end + 1;
      code += ' ';
    } else {
      code += source[i];
    }
  }
  const auto isNameChar = [](char c) { return std::isalnum(static_cast<unsigned char>(c)) || c == '_'; };
  std::vector<std::string> names;
  bool inUniform = false, inSampler = false;
  for (std::size_t i = 0; i < code.size();) {
    if (code[i] == ';' || code[i] == '{' || code[i] == '}') inUniform = inSampler = false;
    if (!isNameChar(code[i])) {
      ++i;
      continue;
    }
    std::size_t end = i;
    while (end < code.size() && isNameChar(code[end])) ++end;
    const std::string word = code.substr(i, end - i);
    i = end;
    if (word == "uniform") {
      inUniform = true;
    } else if (inUniform && word == "sampler2D") {
      inSampler = true;
    } else if (inSampler && !std::isdigit(static_cast<unsigned char>(word[0])) &&
               std::find(names.begin(), names.end(), word) == names.end()) {
      names.push_back(word);
    }
  }
  return names;
}

}  // namespace halfshadow::gl
