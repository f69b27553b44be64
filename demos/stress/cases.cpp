// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "stress/cases.hpp"

#include <algorithm>
#include <cassert>
#include <map>

#include "stress/stages.hpp"

namespace halfshadow::stress {
namespace {
std::map<std::string, SceneDescription> makeBases() {
  const scene::AreaLight lamp = lightDown({0, 2.7, 0}, 0.2, 0.2), high = lightDown({0, 3, 0}, 0.2, 0.2);
  return {
      {"box", builtin("box@light=1")},
      {"box-small-light", builtin("box@light=0.3")},
      {"bars", builtin("bars@light=1")},
      {"figure", builtin("figure@light=1")},
      {"leaves", builtin("leaves@light=1")},
      {"lamp", stage({boxObject("box", {0.4, 0.4, 0.3}, {0.2, 0.4, 0.2}), floorObject(16)}, lamp, {4, 4, 5},
                     {0, 0.3, 0})},
      {"tower", stage({boxObject("box", {0, 0.4, 0}, {0.2, 0.4, 0.2}), floorObject(16)}, high, {4, 4, 5},
                      {0, 0.3, 0})},
      {"apart", stage({boxObject("near", {0, 0.2, 3}, {1.0, 0.2, 1.5}), floorObject(40)},
                      lightDown({1, 5, 3}, 0.2, 0.2), {0, 4.2, -3}, {0, 0, 3.5})},
  };
}
}  // namespace

std::string ruleText(Rule rule) {
  switch (rule) {
    case Rule::base:
      return "against its truth; never worse than hard shadows";
    case Rule::restated:
      return "against the base scene's truth, with the base scene's error and picture";
    case Rule::same:
      return "against the base scene's truth, with the base scene's error";
    case Rule::own:
      return "against its truth, with the base scene's error; never worse than hard shadows";
    case Rule::dark:
      return "dark everywhere";
    case Rule::lit:
      return "lit everywhere";
    case Rule::steady:
      return "jumps from frame to frame, beyond the truth's";
  }
  return {};
}

const SceneDescription& baseScene(const std::string& name) {
  static const std::map<std::string, SceneDescription> bases = makeBases();
  const auto found = bases.find(name);
  assert(found != bases.end());
  return found->second;
}

const std::vector<Case>& cases() {
  static const std::vector<Case> all = [] {
    std::vector<Case> list = {
        {"base", "ordinary scenes, whose errors the others are compared with", Rule::base, baseVariants}};
    for (auto& more :
         {placementCases(), groundCases(), lampCases(), lightCases(), roomCases(), hostileCases()})
      list.insert(list.end(), more.begin(), more.end());
    return list;
  }();
  return all;
}

Result<std::vector<Case>> chosenCases(const std::vector<std::string>& names) {
  if (names.empty()) return cases();
  for (const std::string& name : names) {
    const auto asked = [&](const Case& c) { return c.name.starts_with(name); };
    if (!name.empty() && std::ranges::any_of(cases(), asked)) continue;
    std::string list;
    for (const Case& c : cases()) list += (list.empty() ? "" : ", ") + c.name;
    return Error{ErrorCode::invalidArgument, "there is no case \"" + name + "\"; give some of " + list};
  }
  std::vector<Case> chosen;
  for (const Case& c : cases()) {
    if (std::ranges::any_of(names, [&](const std::string& name) { return c.name.starts_with(name); }))
      chosen.push_back(c);
  }
  return chosen;
}

}  // namespace halfshadow::stress
