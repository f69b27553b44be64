// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// Rules over the text of the shaders.
#include <gtest/gtest.h>

#include <algorithm>
#include <regex>
#include <set>

#include "shader_variants.hpp"
#include "source_tree.hpp"

namespace halfshadow::architecture {
namespace {

std::vector<SourceFile> shaders() {
  std::vector<SourceFile> files;
  for (const SourceFile& file : sourceTree()) {
    if (file.path.starts_with("shaders_es2/") && isShader(file)) files.push_back(file);
  }
  return files;
}

std::string nameOf(const SourceFile& file) {
  return file.path.substr(std::string("shaders_es2/").size());
}

TEST(ShaderRules, EverySamplerSaysItsPrecision) {
  // GLSL ES 1.00 section 4.5.3: sampler2D is lowp unless told otherwise, which cuts packed depth to 11 bits.
  const std::regex kSampler("(\\w+)\\s+sampler(2D|Cube)\\b");
  const std::set<std::string> kPrecisions = {"lowp", "mediump", "highp", "HS_HIGHP", "HS_SHARED"};
  int samplers = 0;
  for (const SourceFile& file : shaders()) {
    const std::string code = withoutComments(file.text);
    for (std::sregex_iterator match(code.begin(), code.end(), kSampler), end; match != end; ++match) {
      ++samplers;
      EXPECT_TRUE(kPrecisions.count((*match)[1])) << file.path << ": " << match->str();
    }
  }
  EXPECT_GT(samplers, 5);
}

TEST(ShaderRules, FragmentShadersNeverDemandHighp) {
  // A bare `highp` does not compile where fragments lack it; HS_HIGHP is the best there is.
  const std::regex kBareHighp("\\bhighp\\b");
  for (const SourceFile& file : shaders()) {
    if (file.path.ends_with(".vert") || file.path.ends_with("_vertex.glsl")) continue;
    EXPECT_FALSE(std::regex_search(withoutComments(file.text), kBareHighp))
        << file.path << ": write HS_HIGHP";
  }
}

TEST(ShaderRules, SomeTechniqueDeclaresEveryShader) {
  std::set<std::string> used;
  for (const ShaderVariant& variant : shaderVariants())
    used.insert({variant.vertexFile, variant.fragmentFile});
  std::set<std::string> present;
  for (const SourceFile& file : shaders()) {
    if (!file.path.ends_with(".glsl")) present.insert(nameOf(file));
  }
  for (const std::string& name : present) {
    EXPECT_TRUE(used.count(name)) << name << ": no technique declares it";
  }
  for (const std::string& name : used) EXPECT_TRUE(present.count(name)) << name << " does not exist";
}

TEST(ShaderRules, SomeTechniqueDeclaresEverySwitch) {
  // Each HS_ name that an #if asks for is defined by some variant, by the assembly, or by a shader.
  std::set<std::string> known = {"HS_NO_HIGHP", "HS_DERIVATIVES"};
  for (const ShaderVariant& variant : shaderVariants()) {
    for (const std::string& define : variant.defines)
      known.insert(define.substr(0, define.find_first_of(" (")));
  }
  const std::regex kDefine("#\\s*define\\s+(HS_\\w+)");
  const std::regex kName("\\bHS_[A-Z0-9_]+\\b");
  const std::regex kCondition("^\\s*#\\s*(if|ifdef|ifndef|elif)\\b");
  for (const SourceFile& file : shaders()) {
    const std::string code = withoutComments(file.text);
    for (std::sregex_iterator match(code.begin(), code.end(), kDefine), end; match != end; ++match) {
      known.insert((*match)[1]);
    }
  }
  for (const SourceFile& file : shaders()) {
    for (const std::string& line : linesOf(withoutComments(file.text))) {
      if (!std::regex_search(line, kCondition)) continue;
      for (std::sregex_iterator match(line.begin(), line.end(), kName), end; match != end; ++match) {
        EXPECT_TRUE(known.count(match->str())) << file.path << ": no variant defines " << match->str();
      }
    }
  }
}

}  // namespace
}  // namespace halfshadow::architecture
