// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "device/shader_family.hpp"

#include <algorithm>

namespace halfshadow::device {
namespace {
std::string_view nameOf(std::string_view define) {
  return define.substr(0, define.find_first_of(" ("));
}

bool names(const ShaderAxis& axis, std::string_view define) {
  return std::ranges::any_of(axis, [&](const ShaderChoice& choice) {
    return std::ranges::find(choice.defines, nameOf(define), nameOf) != choice.defines.end();
  });
}

bool matches(std::string_view declared, std::string_view define) {
  return declared.ends_with('*') ? define.starts_with(declared.substr(0, declared.size() - 1))
                                 : declared == define;
}

bool holds(std::string_view term, const std::vector<std::string>& defines) {
  if (term.starts_with('!')) return !holds(term.substr(1), defines);
  return std::ranges::any_of(
      defines, [&](const std::string& define) { return define == term || nameOf(define) == term; });
}

std::string textOf(const std::vector<std::string>& defines) {
  std::string text;
  for (const std::string& define : defines) text += (text.empty() ? "" : " with ") + define.substr(0, 40);
  return text;
}
}  // namespace

std::vector<std::string> contextDefines(const Capabilities& capabilities) {
  std::vector<std::string> defines;
  if (!capabilities.has(Capability::highp)) defines.emplace_back("HS_NO_HIGHP");
  if (capabilities.has(Capability::derivatives)) defines.emplace_back("HS_DERIVATIVES");
  return defines;
}

std::string refusal(const ShaderFamily& family, const std::vector<std::string>& defines,
                    const std::vector<std::string>& contextDefines) {
  std::vector<std::string> all = defines;
  all.insert(all.end(), contextDefines.begin(), contextDefines.end());
  std::size_t declared = 0;
  for (const ShaderAxis& axis : family.axes) {
    std::vector<std::string> asked;
    std::ranges::copy_if(defines, std::back_inserter(asked),
                         [&](auto& define) { return names(axis, define); });
    declared += asked.size();
    const auto choice = std::ranges::find_if(axis, [&](const ShaderChoice& candidate) {
      return std::ranges::is_permutation(candidate.defines, asked, matches);
    });
    if (choice == axis.end()) {
      return asked.empty() ? "nothing is chosen of the axis of " + textOf(axis.front().defines)
                           : textOf(asked) + " is no choice that is declared";
    }
    for (const std::string& need : choice->needs) {
      if (!holds(need, all))
        return (asked.empty() ? "a variant without " + textOf(axis.back().defines) : textOf(asked)) +
               " needs " + need;
    }
  }
  if (declared == defines.size()) return "";
  return *std::ranges::find_if(defines, [&](const std::string& define) {
    return std::ranges::none_of(family.axes, [&](const ShaderAxis& axis) { return names(axis, define); });
  }) + " is not declared";
}

Status checkVariant(std::span<const ShaderFamily> families, const ProgramVariant& variant,
                    const Capabilities& capabilities) {
  std::string reason = "no technique declares this pair; see Technique::shaderFamilies()";
  for (const ShaderFamily& family : families) {
    if (family.vertexFile != variant.vertexFile || family.fragmentFile != variant.fragmentFile) continue;
    reason = refusal(family, variant.defines, contextDefines(capabilities));
    if (reason.empty()) return {};
  }
  return Error{ErrorCode::internal, variant.vertexFile + " + " + variant.fragmentFile + ": " + reason};
}

}  // namespace halfshadow::device
