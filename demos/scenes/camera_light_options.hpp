// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// Cameras and lights written on the command line.
#pragma once

#include <string_view>

#include "base/error.hpp"
#include "scene/camera.hpp"
#include "scene/light.hpp"

namespace halfshadow::scenes {

/// "eye=x,y,z target=x,y,z [fov=DEGREES] [up=x,y,z]", words in any order, separated by spaces; fov is
/// vertical, 34 when left out; up is y. Errors: invalidCamera (the message quotes the word that is wrong).
Result<scene::Camera> parseCamera(std::string_view text);

/// "center=x,y,z target=x,y,z size=WxH [up=x,y,z]" (full side lengths; "size=S" is a square, 0x0 a point), or
/// "center=x,y,z u=x,y,z v=x,y,z" (half-extent vectors; shines to the side of u × v; both zero: a point that
/// shines downward, or as emission=x,y,z says). Either with color=r,g,b (linear), intensity=I and
/// reference=D, see scene::AreaLight; the aimed form's reference is the target's distance when left out.
/// Errors: invalidLight (the message quotes the word that is wrong).
Result<scene::AreaLight> parseLight(std::string_view text);

/// "x", "y", "z", the same with a "-" in front, or "x,y,z". Errors: invalidArgument.
Result<glm::dvec3> parseUp(std::string_view text);

}  // namespace halfshadow::scenes
