// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// From pictures to verdicts. Pure arithmetic: no engine, no rays.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "measure/measurement.hpp"
#include "stress/cases.hpp"

namespace halfshadow::stress {

/// What pictures of one variant are compared with.
struct Yardstick {
  measure::Truth truth;
  std::vector<float> hard;           ///< visibility of the light's centre, ray-traced: exact hard shadows
  std::vector<std::uint8_t> judged;  ///< see judgedPixels
};

/// Receiver pixels whose 3 × 3 neighbours show the same smooth surface (elsewhere rasteriser and ray see
/// different ones), from which all corners of the light lie above the facet and, unless
/// `behindLight`, before the light's plane, neither at a grazing angle.
std::vector<std::uint8_t> judgedPixels(const reference::ReceiverImage& receivers,
                                       const scene::SceneDescription& scene, bool behindLight);

/// A picture against a truth, over judged pixels.
struct Errors {
  double mae = 0.0, worst = 0.0;
  double penumbraRmse = 0.0;   ///< where the truth is between 0.005 and 0.995
  double rmseBeyondPixel = 0;  ///< of the distance to what the truth takes in the 3 × 3 pixels around
  /// Share of pixels further than kFalse outside all that truth and exact hard shadows take in the 3 × 3
  /// pixels around: light that leaks, spots, shadows that are missing.
  double falseShare = 0.0;
  std::size_t judged = 0, penumbra = 0;
};
inline constexpr double kFalse = 0.1;

Errors errorsOf(std::span<const float> picture, const Yardstick& yardstick);

/// Largest at p99.9 of what pixels jump from frame to frame beyond their truth's jump, over judged pixels of
/// both frames. The lists have the same length: one picture and one yardstick a frame.
double jumpBeyondTruth(const std::vector<std::vector<float>>& pictures,
                       const std::vector<Yardstick>& yardsticks);

enum class Verdict { ok, fellBack, refused, worse, wrong };  // in the order of gravity
const char* verdictText(Verdict verdict);

/// One sentence per figure that missed its limit; empty when none did.
struct Judgement {
  Verdict verdict = Verdict::ok;
  std::string reason{};
};

/// `restated`, `same`, `own`: `base` is the technique's own error in the base scene; `base`: null.
/// `fellBack`: what the frame's report says of a fall-back, or empty.
///  - ok: the penumbra RMSE is at most 1.3 × the base's (other edges, in other directions; what the truth's
///    noise adds is taken out) plus kSlack; the share of false pixels at most 1.3 × the base's plus 1 in 500
///    (single pixels at outlines).
///  - worse: more than that; fellBack: more, and the frame's report says why.
///  - wrong: errors beyond a pixel are larger than those of exact hard shadows, or false pixels are more than
///    1.3 × the base's share plus 1 in 100; where the truth is shared, also a penumbra RMSE of more than
///    twice the base's plus kSlack without a reason: the picture should be the same.
Judgement judged(Rule rule, const Errors& errors, const Errors* base, const Errors& hard, double truthNoise,
                 const std::string& fellBack);
/// Penumbra RMSE. Shared truth: two roundings to 8 bits. `own`: the share of pixels where edges meet, or
/// where a caster touches its receiver, is another.
inline constexpr double kSlackSame = 0.004, kSlackOwn = 0.012;
/// Fewer penumbra pixels say little about an RMSE.
inline constexpr std::size_t kFewestPenumbraPixels = 40;

/// What is left of a picture when its scene is written down in another way: at p99.9 a pixel may change by as
/// much as one may jump from frame to frame.
Judgement alsoUnchanged(Judgement judgement, double changed);
/// Difference at p99.9 of judged pixels.
double changeBetween(std::span<const float> picture, std::span<const float> other,
                     const Yardstick& yardstick);

Judgement judgedDark(const Errors& errors);
Judgement judgedLit(const Errors& errors);
Judgement judgedSteady(double jump);
/// Where a hard edge passes, a pixel jumps whole; soft shadows stay below a sixteenth of the light.
inline constexpr double kJump = 0.06;

}  // namespace halfshadow::stress
