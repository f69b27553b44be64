// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// Every variant passes the reference compiler, which is stricter than Mesa: no implicit conversions, no
// features beyond GLSL ES 1.00 without their extension.
#include <gtest/gtest.h>

#include <unistd.h>

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <map>

#include "gl/embedded_shaders.hpp"
#include "gl/program.hpp"
#include "shader_variants.hpp"

namespace halfshadow::architecture {
namespace {

namespace fs = std::filesystem;

/// A folder that goes away with the test.
class ScratchFolder {
 public:
  ScratchFolder() : path_(fs::temp_directory_path() / ("halfshadow_shaders_" + std::to_string(getpid()))) {
    fs::create_directories(path_);
  }
  ~ScratchFolder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  const fs::path& path() const { return path_; }

 private:
  fs::path path_;
};

device::Capabilities capabilitiesOf(const ShaderVariant& variant) {
  device::Capabilities capabilities;
  const auto offer = [&](device::Capability capability, bool available) {
    if (available) {
      capabilities.states[static_cast<std::size_t>(capability)].outcome = device::ProbeOutcome::available;
    }
  };
  offer(device::Capability::highp, variant.highp);
  offer(device::Capability::derivatives, variant.derivatives);
  offer(device::Capability::framebufferFetch, true);
  capabilities.extensions = {"GL_EXT_shader_framebuffer_fetch"};
  return capabilities;
}

std::string textOf(const std::string& file, const Defines& defines) {
  std::string text = file + " with";
  for (const std::string& define : defines) text += " " + define.substr(0, 40);
  return text;
}

/// The reference compiler does not know framebuffer fetch: the last colour becomes a constant.
std::string withoutFetch(std::string source) {
  for (const auto& [from, to] :
       {std::pair<std::string, std::string>{"#extension GL_EXT_shader_framebuffer_fetch : enable", ""},
        {"gl_LastFragData[0]", "vec4(0.5)"}}) {
    if (const std::size_t at = source.find(from); at != std::string::npos)
      source.replace(at, from.size(), to);
  }
  return source;
}

/// Runs the compiler on `files`; its output, empty when all compile.
std::string compilerOutput(const fs::path& folder, const std::vector<std::string>& files) {
  std::string command = "cd '" + folder.string() + "' && '" HALFSHADOW_GLSLANG "'";
  for (const std::string& file : files) command += " " + file;
  FILE* pipe = popen((command + " 2>&1").c_str(), "r");
  if (pipe == nullptr) return "the compiler could not be started";
  std::string output;
  char buffer[4096];
  while (std::fgets(buffer, sizeof buffer, pipe) != nullptr) output += buffer;
  return pclose(pipe) == 0 ? std::string() : "failed:\n" + output;
}

TEST(ShaderVariants, AllPassTheReferenceCompiler) {
  if (std::string(HALFSHADOW_GLSLANG).empty()) {
    GTEST_SKIP() << "glslangValidator was not found when CMake ran; install glslang-tools";
  }
  const ScratchFolder scratch;
  // Many variants differ only in the other stage: each source is compiled once.
  std::map<std::string, std::string> fileOfSource;
  std::map<std::string, std::string> variantOfFile;
  for (const ShaderVariant& variant : shaderVariants()) {
    for (const std::string& file : {variant.vertexFile, variant.fragmentFile}) {
      const auto source =
          gl::assembleShader(gl::embeddedShader, file, variant.defines, capabilitiesOf(variant));
      ASSERT_TRUE(source.ok()) << source.error().message;
      if (fileOfSource.count(*source)) continue;
      const std::string name = "v" + std::to_string(fileOfSource.size()) + file.substr(file.rfind('.'));
      fileOfSource[*source] = name;
      variantOfFile[name] = textOf(file, variant.defines) + (variant.highp ? "" : ", no highp") +
                            (variant.derivatives ? "" : ", no derivatives");
      std::ofstream(scratch.path() / name) << withoutFetch(*source);
    }
  }
  ASSERT_GT(fileOfSource.size(), 200u)
      << "three depth rungs, five outputs and all kernels: was the table read?";

  // In groups, since starting the compiler costs more than its work; a failing group is repeated one by one.
  constexpr std::size_t kGroup = 100;
  std::vector<std::string> group;
  int failures = 0;
  const auto check = [&] {
    if (compilerOutput(scratch.path(), group).empty()) return group.clear();
    for (const std::string& file : group) {
      const std::string output = compilerOutput(scratch.path(), {file});
      if (output.empty() || ++failures > 5) continue;
      ADD_FAILURE() << variantOfFile[file] << " " << output;
    }
    group.clear();
  };
  for (const auto& [file, variant] : variantOfFile) {
    group.push_back(file);
    if (group.size() == kGroup) check();
  }
  if (!group.empty()) check();
  EXPECT_EQ(failures, 0);
}

TEST(ShaderVariants, TheReferenceCompilerIsReallyAsked) {
  if (std::string(HALFSHADOW_GLSLANG).empty()) {
    GTEST_SKIP() << "glslangValidator was not found when CMake ran; install glslang-tools";
  }
  const ScratchFolder scratch;
  std::ofstream(scratch.path() / "good.frag") << "#version 100\nvoid main() { gl_FragColor = vec4(1.0); }\n";
  std::ofstream(scratch.path() / "bad.frag")
      << "#version 100\nvoid main() { gl_FragColor = vec4(1); float x = 1; }\n";
  EXPECT_EQ(compilerOutput(scratch.path(), {"good.frag"}), "");
  EXPECT_NE(compilerOutput(scratch.path(), {"bad.frag"}), "") << "ES has no implicit int to float";
  EXPECT_NE(compilerOutput(scratch.path(), {"good.frag", "bad.frag"}), "");
}

}  // namespace
}  // namespace halfshadow::architecture
