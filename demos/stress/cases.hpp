// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// What a soft shadow must survive: cases of several scenes each, built in code.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "base/error.hpp"
#include "scene/scene_description.hpp"

namespace halfshadow::stress {

/// How a picture is judged. judge.hpp says by which figures.
enum class Rule {
  base,      ///< an ordinary scene; its error is what others are compared with
  restated,  ///< the base scene in other words: the base's own truth, and the very picture of the base scene
  same,    ///< the base scene and something more that shadows nothing in view, or the base scene cut up: the
           ///< base's own truth, and an error as there
  own,     ///< another picture: a truth of its own, an error like the base's, never worse than hard shadows
  dark,    ///< no pixel sees the light
  lit,     ///< every pixel sees all of it
  steady,  ///< frames in a row: no pixel jumps by more than its truth and a little
};
/// Judged against the base scene's truth.
inline bool sharesTruth(Rule rule) {
  return rule == Rule::restated || rule == Rule::same;
}
std::string ruleText(Rule rule);

struct Variant {
  std::string name;  ///< "1e-25"
  scene::SceneDescription scene;
  std::string base{};                      ///< variant of the case `base`; empty for closed forms
  std::vector<scene::AreaLight> frames{};  ///< steady: the light of each frame
  bool judgeBehindLight = false;           ///< receivers beside and behind the light's plane count too
};

struct Case {
  std::string name;  ///< "scale"
  std::string what;  ///< one sentence
  Rule rule = Rule::own;
  /// The scenes, equal for equal seed.
  std::vector<Variant> (*make)(std::uint64_t seed) = nullptr;
};

/// All, in the order of tables; `base` is the first.
const std::vector<Case>& cases();

/// Those whose names are asked for, in the order of tables; all when `names` is empty. A name may be the
/// beginning of several ("light" → light-size, light-shape, …). Errors: invalidArgument (no such case).
Result<std::vector<Case>> chosenCases(const std::vector<std::string>& names);

/// The scene that a variant is compared with.
const scene::SceneDescription& baseScene(const std::string& name);

}  // namespace halfshadow::stress
