// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "measure/measurement.hpp"

#include <algorithm>
#include <chrono>

namespace halfshadow::measure {
namespace {
using Clock = std::chrono::steady_clock;

/// Relative to the light's distance: enough to count as another light, too little to change a texel.
constexpr double kLightStep = 1e-7;

ErrorSet errorsOn(std::span<const float> measured, const Truth& truth,
                  std::span<const std::uint8_t> selected) {
  const std::vector<std::uint8_t> penumbra = metrics::penumbraMask(truth.visibility, selected);
  return {.receiver = metrics::errorStatistics(measured, truth.visibility, selected),
          .penumbra = metrics::errorStatistics(measured, truth.visibility, penumbra),
          .penumbraRoughness = metrics::roughness(measured, truth.visibility, penumbra,
                                                  static_cast<std::size_t>(truth.width))};
}

std::vector<std::uint8_t> ofKind(const Truth& truth, reference::ReceiverKind kind) {
  std::vector<std::uint8_t> mask(truth.receivers.kind.size());
  std::ranges::transform(truth.receivers.kind, mask.begin(),
                         [kind](std::uint8_t k) { return k == kind ? 1 : 0; });
  return mask;
}

/// Frames of one configuration, with a light that can be moved by less than anyone sees.
class Rig {
 public:
  Rig(EngineSession& session, const scene::SceneDescription& scene, const Truth& truth, Output output)
      : session_(session), light_(scene.lights.front()) {
    desc_.camera = cameraDesc(*scene.camera);
    desc_.target = {.width = truth.width, .height = truth.height};
    desc_.output = output;
    const scene::Bounds bounds = scene::boundsWorld(scene, scene::ObjectFilter::all);
    step_ = kLightStep * std::max(glm::length(light_.centerWorld - bounds.center()), bounds.radius());
  }

  Status moveLight() {
    moved_ = !moved_;
    scene::AreaLight light = light_;
    if (moved_) light.centerWorld -= scene::emissionDirection(light) * step_;
    return session_.setLights({light});
  }
  Status restoreLight() {
    moved_ = false;
    return session_.setLights({light_});
  }
  Status render(FrameReport& report, Timing timing = Timing::off) {
    return session_.render(nextDesc(timing), report);
  }
  Result<RgbaImage> image(Output output) {
    RenderDesc desc = desc_;
    desc.output = output;
    FrameReport report;
    if (Status status = session_.render(desc, report); !status) return status.error();
    return session_.read(desc.target.width, desc.target.height);
  }

  enum class Motion { light, none };
  Result<TimeStatistics> time(Motion motion, const MeasureOptions& options) {
    std::vector<double> milliseconds;
    for (int i = -options.warmUpFrames; i < options.timingFrames; ++i) {
      session_.engine().finish();
      const Clock::time_point start = Clock::now();
      if (motion == Motion::light) {
        if (Status status = moveLight(); !status) return status.error();
      }
      if (Status status = session_.render(nextDesc(Timing::off)); !status) return status.error();
      session_.engine().finish();
      const std::chrono::duration<double, std::milli> elapsed = Clock::now() - start;
      if (i >= 0) milliseconds.push_back(elapsed.count());
    }
    return timeStatistics(std::move(milliseconds));
  }

 private:
  /// Of a frame in which the camera moved, so that receivers are drawn whatever the light does.
  RenderDesc nextDesc(Timing timing) {
    nudged_ = !nudged_;
    RenderDesc desc = desc_;
    desc.timing = timing;
    if (nudged_) desc.camera = nudged(desc_.camera);
    return desc;
  }

  EngineSession& session_;
  scene::AreaLight light_;
  RenderDesc desc_;
  double step_ = 0.0;
  bool moved_ = false, nudged_ = false;
};

/// Null when the engine has no such technique.
const char* unsupportedReason(Engine& engine, const std::string& id) {
  for (std::size_t i = 0; i < engine.techniqueCount(); ++i) {
    const TechniqueRecord record = engine.technique(i);
    if (id == record.id) return record.supported ? "" : record.unsupportedReason;
  }
  return nullptr;
}

double meanTaps(const std::vector<std::uint32_t>& taps, const std::vector<std::uint8_t>& selected) {
  double sum = 0.0;
  std::size_t count = 0;
  for (std::size_t i = 0; i < taps.size(); ++i) {
    if (selected[i] != 0) sum += taps[i], ++count;
  }
  return count == 0 ? 0.0 : sum / static_cast<double>(count);
}

Status measureOn(Rig& rig, const Truth& truth, const MeasureOptions& options, Output output,
                 TechniqueMeasurement& result) {
  auto image = rig.image(output);
  if (!image) return image.error();
  result.visibility = decodeVisibility(*image, output);
  result.error = errorsOn(result.visibility, truth, truth.receivers.kind);
  result.errorOnGround = errorsOn(result.visibility, truth, ofKind(truth, reference::kGroundReceiver));
  result.errorOnCasters = errorsOn(result.visibility, truth, ofKind(truth, reference::kCasterReceiver));

  // Counters before the taps frame, whose programs and targets users never hold.
  FrameReport report;
  if (Status status = rig.moveLight(); !status) return status;
  if (Status status = rig.render(report); !status) return status;
  result.counters = countersOf(report);
  result.memoryBytes = report.memoryBytes;
  result.planText = report.planText;
  if (Status status = rig.render(report); !status) return status;
  result.countersStatic = countersOf(report);

  if (options.timingFrames > 0) {
    const auto dynamic = rig.time(Rig::Motion::light, options);
    if (!dynamic) return dynamic.error();
    result.time = *dynamic;
    const auto unchanged = rig.time(Rig::Motion::none, options);
    if (!unchanged) return unchanged.error();
    result.timeStatic = *unchanged;
  }
  if (Status status = rig.moveLight(); !status) return status;
  if (Status status = rig.render(report, Timing::perPass); !status) return status;
  result.passes = passesOf(report);
  result.skipped = skipsOf(report);

  if (Status status = rig.restoreLight(); !status) return status;
  const auto taps = rig.image(Output::taps);
  if (!taps) return taps.error();
  result.counters.tapsPerPixel = result.countersStatic.tapsPerPixel =
      meanTaps(decodeTaps(*taps), truth.receivers.kind);
  return {};
}
}  // namespace

std::string TechniqueMeasurement::absence() const {
  if (!supported) return "not supported here: " + unsupportedReason;
  return failure.empty() ? "" : "failed: " + failure;
}

Result<TechniqueMeasurement> measureTechnique(EngineSession& session, const scene::SceneDescription& scene,
                                              const Truth& truth, const Configuration& configuration,
                                              const MeasureOptions& options) {
  if (Status status = session.renewEngine(); !status) return status.error();
  Engine& engine = session.engine();
  TechniqueMeasurement result{.id = configuration.technique};
  if (Status status = session.set(configuration.settings); !status) return status.error();
  result.settings = effectiveSettings(session, result.id);
  const char* reason = unsupportedReason(engine, result.id);
  if (reason != nullptr && *reason != '\0') {
    result.supported = false;
    result.unsupportedReason = reason;
    return result;
  }
  if (Status status = session.choose(result.id, {}); !status) return status.error();
  const Output output = visibilityOutputOf(result.id);
  Rig rig(session, scene, truth, output);
  if (options.progress) options.progress(result.id, 0.0);
  Status status = session.load(scene);
  if (status) status = measureOn(rig, truth, options, output, result);
  if (!status) {
    if (status.error().code == ErrorCode::contextLost) return status.error();
    // Others may do what this one cannot.
    TechniqueMeasurement failed{.id = result.id, .failure = status.error().message};
    failed.settings = std::move(result.settings);
    return failed;
  }
  if (options.progress) options.progress(result.id, 1.0);
  return result;
}

}  // namespace halfshadow::measure
