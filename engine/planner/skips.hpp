// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// What a frame leaves out, and why.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace halfshadow::planner {

// X(enumerator, "code", "sentence")
#define HALFSHADOW_SKIP_LIST(X)                                                                        \
  X(unchanged, "unchanged", "its inputs have the same revisions as when it was last made")             \
  X(behindLight, "behind-light", "the caster lies wholly behind the light's plane")                    \
  X(noReceiverBehind, "no-receiver-behind", "no receiver lies in the caster's shadow region")          \
  X(nothingBeyond, "nothing-beyond", "no receiver lies beyond the caster, seen from the light")        \
  X(shadowOutOfView, "shadow-out-of-view", "the caster's shadow region misses every visible receiver") \
  X(receiverOutOfView, "receiver-out-of-view", "the receiver lies outside the camera's view")          \
  X(noCasters, "no-casters", "no caster can shadow a receiver")                                        \
  X(lightOff, "light-off", "the light has no intensity")                                               \
  X(notRead, "not-read", "no pass reads its result")

enum class SkipReason {
#define HALFSHADOW_SKIP_ENUM(name, code, text) name,
  HALFSHADOW_SKIP_LIST(HALFSHADOW_SKIP_ENUM)
#undef HALFSHADOW_SKIP_ENUM
};
std::string_view skipCode(SkipReason reason);
std::string_view skipText(SkipReason reason);

/// Numbers alone: most frames are never asked for the words.
struct Skip {
  enum class Subject : std::uint8_t { caster, receiver, light } subject = Subject::light;
  SkipReason reason = SkipReason::unchanged;
  bool amongLights = false;  ///< of casters: there are several lights
  std::uint32_t id = 0;      ///< of the object
  std::uint32_t light = 0;   ///< its number; of casters and lights
};
/// "caster 3", "caster 3 for light 1", "receiver 7", "light 0".
std::string skipName(const Skip& skip);

}  // namespace halfshadow::planner
