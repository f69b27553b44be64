// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "shader_variants.hpp"

#include <algorithm>
#include <array>
#include <set>

#include "techniques/registry/registry.hpp"

namespace halfshadow::architecture {
namespace {
using device::ShaderAxis;

/// What the context sets: two axes more.
const ShaderAxis kPrecision = {{}, {{"HS_NO_HIGHP"}}}, kDerivatives = {{{"HS_DERIVATIVES"}}, {}};

struct Member {
  std::vector<std::size_t> choices;  ///< by axis
  ShaderVariant variant;
};

std::vector<Member> membersOf(const device::ShaderFamily& family) {
  std::vector<ShaderAxis> axes = family.axes;
  for (ShaderAxis& axis : axes) std::erase_if(axis, [](const auto& choice) { return !choice.compiled; });
  axes.insert(axes.end(), {kPrecision, kDerivatives});
  std::vector<Member> members;
  std::vector<std::size_t> choices(axes.size(), 0);
  while (true) {
    std::vector<std::string> defines, context;
    for (std::size_t a = 0; a < axes.size(); ++a) {
      const std::vector<std::string>& chosen = axes[a][choices[a]].defines;
      auto& list = a < family.axes.size() ? defines : context;
      list.insert(list.end(), chosen.begin(), chosen.end());
    }
    if (device::refusal(family, defines, context).empty()) {
      members.push_back({choices,
                         {family.vertexFile, family.fragmentFile, defines, choices[axes.size() - 2] == 0,
                          choices.back() == 0}});
    }
    std::size_t a = 0;
    while (a < axes.size() && ++choices[a] == axes[a].size()) choices[a++] = 0;
    if (a == axes.size()) return members;
  }
}

using Pair = std::array<std::size_t, 4>;
std::vector<Pair> pairsOf(const std::vector<std::size_t>& choices) {
  std::vector<Pair> pairs;
  for (std::size_t a = 0; a < choices.size(); ++a) {
    for (std::size_t b = a + 1; b < choices.size(); ++b) pairs.push_back({a, choices[a], b, choices[b]});
  }
  return pairs;
}

}  // namespace

std::vector<ShaderVariant> compiledVariants(const device::ShaderFamily& family) {
  const std::vector<Member> members = membersOf(family);
  std::set<Pair> seen;
  std::vector<ShaderVariant> chosen;
  // Those that bring the most first: so they are few.
  for (std::size_t least = pairsOf(members.front().choices).size(); least > 0; least /= 2) {
    for (const Member& member : members) {
      const std::vector<Pair> pairs = pairsOf(member.choices);
      const auto fresh = std::ranges::count_if(pairs, [&](const Pair& pair) { return !seen.contains(pair); });
      if (static_cast<std::size_t>(fresh) < least) continue;
      seen.insert(pairs.begin(), pairs.end());
      chosen.push_back(member.variant);
    }
  }
  return chosen;
}

const std::vector<ShaderVariant>& shaderVariants() {
  static const std::vector<ShaderVariant> variants = [] {
    std::vector<ShaderVariant> all;
    for (const auto& family : techniques::allShaderFamilies(techniques::makeAllTechniques())) {
      for (ShaderVariant& variant : compiledVariants(family)) all.push_back(std::move(variant));
    }
    return all;
  }();
  return variants;
}

}  // namespace halfshadow::architecture
