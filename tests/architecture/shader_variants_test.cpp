// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// Every variant passes the reference compiler, which is stricter than Mesa: no implicit conversions, no
// features beyond GLSL ES 1.00 without their extension.
#include <gtest/gtest.h>

#include <unistd.h>

#include <algorithm>
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

std::string textOf(const std::string& file, const std::vector<std::string>& defines) {
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
  std::printf("%zu sources\n", fileOfSource.size());
  ASSERT_GT(fileOfSource.size(), 200u)
      << "three depth rungs, five outputs and all kernels: were they declared?";

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

TEST(ShaderVariants, OutsideAFamilyAreRefusedByName) {
  const device::ShaderFamily family{"a.vert",
                                    "a.frag",
                                    {{{{"HS_SIZE 2"}}, {{"HS_TAPS(T) *"}}},
                                     {{}, {{"HS_LOOP"}, {"HS_SIZE"}}},
                                     {{.needs = {"!HS_NO_HIGHP"}}, {{"HS_PACKED"}}}}};
  const auto reason = [&](const std::vector<std::string>& defines, const std::vector<std::string>& context) {
    return device::refusal(family, defines, context);
  };
  EXPECT_EQ(reason({"HS_SIZE 2"}, {}), "");
  EXPECT_EQ(reason({"HS_LOOP", "HS_PACKED", "HS_SIZE 2"}, {"HS_NO_HIGHP"}), "");
  EXPECT_EQ(reason({"HS_TAPS(T) T(0.1) T(0.2)"}, {}), "");
  EXPECT_EQ(reason({"HS_SIZE 3"}, {}), "HS_SIZE 3 is no choice that is declared");
  EXPECT_EQ(reason({"HS_SIZE 2", "HS_OTHER 1"}, {}), "HS_OTHER 1 is not declared");
  EXPECT_EQ(reason({}, {}), "nothing is chosen of the axis of HS_SIZE 2");
  EXPECT_EQ(reason({"HS_TAPS(T) T(0.1)", "HS_LOOP"}, {}), "HS_LOOP needs HS_SIZE");
  EXPECT_EQ(reason({"HS_SIZE 2"}, {"HS_NO_HIGHP"}), "a variant without HS_PACKED needs !HS_NO_HIGHP");
  const Status unknown = device::checkVariant({&family, 1}, {"a.vert", "b.frag", {}}, {});
  ASSERT_FALSE(unknown.ok());
  EXPECT_EQ(unknown.error().code, ErrorCode::internal);
  EXPECT_NE(unknown.error().message.find("a.vert + b.frag"), std::string::npos);
}

TEST(ShaderVariants, FewHoldEveryPairOfChoices) {
  const device::ShaderAxis three = {{}, {{"HS_A"}}, {{"HS_B"}}};
  const std::vector<ShaderVariant> variants = compiledVariants(
      {"a.vert", "a.frag", {three, {{}, {{"HS_C"}}, {{"HS_D"}, {}, false}}, {{}, {{"HS_E"}, {"HS_A"}}}}});
  EXPECT_LT(variants.size(), 16u) << "of 32";
  const auto has = [&](std::initializer_list<std::string> pair) {
    return std::ranges::any_of(variants, [&](const ShaderVariant& variant) {
      return std::ranges::all_of(pair, [&](const std::string& define) {
        return std::ranges::find(variant.defines, define) != variant.defines.end();
      });
    });
  };
  EXPECT_TRUE(has({"HS_A", "HS_C"}) && has({"HS_B", "HS_C"}) && has({"HS_A", "HS_E"}) &&
              has({"HS_C", "HS_E"}));
  EXPECT_FALSE(has({"HS_B", "HS_E"})) << "excluded";
  EXPECT_FALSE(has({"HS_D"})) << "not for compiling";
}

}  // namespace
}  // namespace halfshadow::architecture
