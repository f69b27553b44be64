// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// Scenes generated in code: deterministic, without files, each with its own camera and light.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.hpp"
#include "scene/scene_description.hpp"

namespace halfshadow::scenes {

struct BuiltinInfo {
  std::string name;
  std::string description;  ///< one sentence
  /// Triangles of casters and receivers together. Generates the scene: milliseconds, a second for
  /// `mannequin`.
  std::uint64_t triangleCount() const;
};

/// All built-in scenes in the order in which they are listed to users.
std::vector<BuiltinInfo> builtinScenes();

/// Generates the scene `name`, optionally followed by `@key=value,key=value`:
///  - `light=h`: half size of the light in world units before `scale` and `shift`, h >= 0; 0 is a point
///  light;
///  - `scale=s`: everything (camera and light too) scaled by s > 0 about the world origin;
///  - `shift=d`: everything moved by d along world x and z after scaling.
/// Every caster is one object, closed and wound counter-clockwise seen from outside (the scene `sheets` is
/// the exception: its leaves are open and double-sided). Objects with casts = false are pure receivers; the
/// plane named `ground` lies at y = 0, 120 units wide. The camera is meant for an aspect of 4:3. Errors:
/// invalidArgument (unknown name, unknown key, value not a number or out of range).
Result<scene::SceneDescription> makeBuiltinScene(std::string_view name);

}  // namespace halfshadow::scenes
