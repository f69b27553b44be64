// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "stress/judge.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "metrics/metrics.hpp"

namespace halfshadow::stress {
namespace {
/// Facets closer to edge-on than this change from lit to dark within the rounding of their normal.
constexpr double kGrazing = 0.02;

struct Range {
  float low = 1.0f, high = 0.0f;
  void include(float value) { low = std::min(low, value), high = std::max(high, value); }
  double distance(float value) const { return std::max({low - value, value - high, 0.0f}); }
};

/// Of the 3 × 3 pixels around, which are receivers wherever the pixel is judged.
Range rangeAround(std::span<const float> image, int width, std::size_t center) {
  Range range;
  for (int dy = -1; dy <= 1; ++dy) {
    for (int dx = -1; dx <= 1; ++dx)
      range.include(image[static_cast<std::size_t>(static_cast<long>(center) + dy * width + dx)]);
  }
  return range;
}

std::string figure(const char* text, double value, double limit) {
  char line[160];
  std::snprintf(line, sizeof line, text, value, limit);
  return line;
}

void add(Judgement& judgement, Verdict verdict, const std::string& reason) {
  judgement.verdict = std::max(judgement.verdict, verdict);
  judgement.reason += (judgement.reason.empty() ? "" : "; ") + reason;
}

/// At p99.9; 0 when there are none.
double nearlyLargest(std::vector<double> values) {
  if (values.empty()) return 0.0;
  const auto rank = static_cast<std::size_t>(0.999 * static_cast<double>(values.size() - 1));
  std::ranges::nth_element(values, values.begin() + static_cast<long>(rank));
  return values[rank];
}

double without(double rmse, double noise) {
  return std::sqrt(std::max(rmse * rmse - noise * noise, 0.0));
}
}  // namespace

std::vector<std::uint8_t> judgedPixels(const reference::ReceiverImage& receivers,
                                       const scene::SceneDescription& scene, bool behindLight) {
  const scene::AreaLight& light = scene.lights.front();
  const scene::Camera& camera = *scene.camera;
  const glm::dvec3 forward = glm::normalize(camera.targetWorld - camera.eyeWorld);
  const glm::dvec3 aim = scene::emissionDirection(light);
  const auto depth = [&](std::size_t i) {
    return glm::dot(receivers.positionWorld[i] - camera.eyeWorld, forward);
  };
  const int width = receivers.width, height = receivers.height;
  // A surface that falls away by four pixels per pixel is seen at 14 degrees.
  const double pixelAngle = 2.0 * std::tan(0.5 * camera.verticalFovRadians) / height;
  std::vector<std::uint8_t> judged(receivers.kind.size(), 0);
  for (int y = 1; y + 1 < height; ++y) {
    for (int x = 1; x + 1 < width; ++x) {
      const auto center = static_cast<std::size_t>(y * width + x);
      if (receivers.kind[center] == reference::kNoReceiver) continue;
      bool good = true;
      for (int dy = -1; dy <= 1; ++dy) {
        for (int dx = -1; dx <= 1; ++dx) {
          const auto near = static_cast<std::size_t>((y + dy) * width + x + dx);
          good = good && receivers.kind[near] == receivers.kind[center] &&
                 std::abs(depth(near) - depth(center)) < 4.0 * std::sqrt(2.0) * pixelAngle * depth(center);
        }
      }
      for (const double a : {-1.0, 1.0}) {
        for (const double b : {-1.0, 1.0}) {
          const glm::dvec3 toCorner =
              light.centerWorld + a * light.halfU + b * light.halfV - receivers.positionWorld[center];
          const double limit = kGrazing * glm::length(toCorner);
          good = good && glm::dot(glm::dvec3(receivers.normalWorld[center]), toCorner) > limit;
          good = good && (behindLight || glm::dot(toCorner, aim) < -limit);
        }
      }
      judged[center] = good;
    }
  }
  return judged;
}

Errors errorsOf(std::span<const float> picture, const Yardstick& yardstick) {
  const std::vector<float>& truth = yardstick.truth.visibility;
  Errors errors;
  double penumbra = 0.0, beyond = 0.0;
  std::size_t wrong = 0;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    if (!yardstick.judged[i]) continue;
    const double error = std::abs(static_cast<double>(picture[i]) - truth[i]);
    errors.mae += error;
    errors.worst = std::max(errors.worst, error);
    ++errors.judged;
    if (truth[i] > metrics::kPenumbraLow && truth[i] < metrics::kPenumbraHigh)
      penumbra += error * error, ++errors.penumbra;
    Range range = rangeAround(truth, yardstick.truth.width, i);
    const double outside = range.distance(picture[i]);
    beyond += outside * outside;
    const Range hard = rangeAround(yardstick.hard, yardstick.truth.width, i);
    range.include(hard.low), range.include(hard.high);
    wrong += range.distance(picture[i]) > kFalse;
  }
  const auto count = static_cast<double>(std::max<std::size_t>(errors.judged, 1));
  errors.mae /= count;
  errors.penumbraRmse = std::sqrt(penumbra / static_cast<double>(std::max<std::size_t>(errors.penumbra, 1)));
  errors.rmseBeyondPixel = std::sqrt(beyond / count);
  errors.falseShare = static_cast<double>(wrong) / count;
  return errors;
}

double jumpBeyondTruth(const std::vector<std::vector<float>>& pictures,
                       const std::vector<Yardstick>& yardsticks) {
  std::vector<double> jumps;
  for (std::size_t frame = 1; frame < pictures.size(); ++frame) {
    const Yardstick &before = yardsticks[frame - 1], &after = yardsticks[frame];
    for (std::size_t i = 0; i < before.judged.size(); ++i) {
      if (!before.judged[i] || !after.judged[i]) continue;
      const double own = std::abs(after.truth.visibility[i] - before.truth.visibility[i]);
      jumps.push_back(std::abs(pictures[frame][i] - pictures[frame - 1][i]) - own);
    }
  }
  return std::max(nearlyLargest(std::move(jumps)), 0.0);
}

double changeBetween(std::span<const float> picture, std::span<const float> other,
                     const Yardstick& yardstick) {
  std::vector<double> changes;
  for (std::size_t i = 0; i < yardstick.judged.size(); ++i) {
    if (yardstick.judged[i]) changes.push_back(std::abs(static_cast<double>(picture[i]) - other[i]));
  }
  return nearlyLargest(std::move(changes));
}

Judgement alsoUnchanged(Judgement judgement, double changed) {
  if (changed > kJump)
    add(judgement, Verdict::worse, figure("changes by %.3f at p99.9 (at most %.2f)", changed, kJump));
  return judgement;
}

const char* verdictText(Verdict verdict) {
  switch (verdict) {
    case Verdict::ok:
      return "ok";
    case Verdict::fellBack:
      return "fell back";
    case Verdict::refused:
      return "refused";
    case Verdict::worse:
      return "worse";
    case Verdict::wrong:
      return "WRONG";
  }
  return "";
}

Judgement judged(Rule rule, const Errors& errors, const Errors* base, const Errors& hard, double truthNoise,
                 const std::string& fellBack) {
  Judgement judgement;
  const double baseFalse = base ? base->falseShare : 0.0;
  const auto falseShare = [&](double allowed) {
    return figure("%.2f %% false pixels (at most %.2f %%)", 100.0 * errors.falseShare, 100.0 * allowed);
  };
  // Never worse than hard shadows. A tenth, and a hundredth, for edges that fall on the other side of a
  // pixel.
  const double hardLimit = 1.1 * hard.rmseBeyondPixel + 0.01;
  if (errors.rmseBeyondPixel > hardLimit)
    add(judgement, Verdict::wrong,
        figure("RMSE %.3f beyond the truth's pixels (hard shadows: %.3f)", errors.rmseBeyondPixel,
               hard.rmseBeyondPixel));
  if (errors.falseShare > 1.3 * baseFalse + 0.01)
    add(judgement, Verdict::wrong, falseShare(1.3 * baseFalse + 0.01));
  if (judgement.verdict == Verdict::wrong || rule == Rule::base) return judgement;

  // What the base scene's error does not explain.
  const Verdict more = fellBack.empty() ? Verdict::worse : Verdict::fellBack;
  const bool comparable =
      errors.penumbra >= kFewestPenumbraPixels && base != nullptr && base->penumbra >= kFewestPenumbraPixels;
  if (comparable) {
    const auto limit = [&](double factor) {
      const double own = factor * without(base->penumbraRmse, truthNoise);
      return std::sqrt(own * own + truthNoise * truthNoise) + (sharesTruth(rule) ? kSlackSame : kSlackOwn);
    };
    const bool another = sharesTruth(rule) && fellBack.empty() && errors.penumbraRmse > limit(2.0);
    if (errors.penumbraRmse > limit(1.3))
      add(judgement, another ? Verdict::wrong : more,
          figure("penumbra RMSE %.4f (at most %.4f)", errors.penumbraRmse, limit(1.3)));
  }
  const double allowed = 1.3 * baseFalse + 0.002;
  if (errors.falseShare > allowed) add(judgement, more, falseShare(allowed));
  if (judgement.verdict == Verdict::fellBack) judgement.reason += "; " + fellBack;
  return judgement;
}

Judgement judgedDark(const Errors& errors) {
  Judgement judgement;
  // A hundredth of light is seen in a dark room; single pixels where walls meet are one in a hundred.
  if (errors.mae > 0.01) add(judgement, Verdict::wrong, figure("MAE %.3f (at most %.2f)", errors.mae, 0.01));
  if (errors.falseShare > 0.01)
    add(judgement, Verdict::wrong,
        figure("%.2f %% of the pixels are lit (at most %.2f %%)", 100.0 * errors.falseShare, 1.0));
  return judgement;
}

Judgement judgedLit(const Errors& errors) {
  Judgement judgement;
  if (errors.mae > 0.002)
    add(judgement, errors.mae > 0.01 ? Verdict::wrong : Verdict::worse,
        figure("MAE %.4f (at most %.3f)", errors.mae, 0.002));
  if (errors.falseShare > 0.002)
    add(judgement, errors.falseShare > 0.01 ? Verdict::wrong : Verdict::worse,
        figure("%.2f %% of the pixels are shadowed (at most %.2f %%)", 100.0 * errors.falseShare, 0.2));
  return judgement;
}

Judgement judgedSteady(double jump) {
  Judgement judgement;
  if (jump > kJump)
    add(judgement, Verdict::worse, figure("jumps by %.3f at p99.9 (at most %.2f)", jump, kJump));
  return judgement;
}

}  // namespace halfshadow::stress
