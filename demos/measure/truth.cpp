// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include <algorithm>

#include "measure/measurement.hpp"

namespace halfshadow::measure {

Result<Truth> traceTruth(const scene::SceneDescription& scene, int width, int height, int samples,
                         const Progress& progress, double originLiftWorld) {
  const scene::AreaLight& light = scene.lights.front();
  auto receivers = reference::traceReceivers(scene, *scene.camera, light, width, height);
  if (!receivers) return receivers.error();
  Truth truth{.width = width, .height = height, .samples = reference::tracedSamples(samples)};
  truth.receivers = std::move(receivers).value();
  truth.originLiftWorld = originLiftWorld;
  reference::ReferenceOptions options{.samples = samples, .originLiftWorld = originLiftWorld};
  const auto report = [&progress](const char* stage) -> std::function<void(double)> {
    if (!progress) return {};
    return [&progress, stage](double share) { progress(stage, share); };
  };
  options.progress = report("ground truth");
  auto visibility = reference::traceVisibility(scene, light, truth.receivers, options);
  if (!visibility) return visibility.error();
  truth.visibility = std::move(visibility).value();
  options.progress = report("noise floor of the truth");
  const auto noise = reference::noiseRmse(scene, light, truth.receivers, truth.visibility, options);
  if (!noise) return noise.error();
  truth.noiseRmse = *noise;
  truth.penumbra = metrics::penumbraMask(truth.visibility, truth.receivers.kind);
  const auto count = [](const std::vector<std::uint8_t>& mask) {
    return mask.size() - static_cast<std::size_t>(std::ranges::count(mask, 0));
  };
  truth.receiverPixels = count(truth.receivers.kind);
  truth.penumbraPixels = count(truth.penumbra);
  return truth;
}

}  // namespace halfshadow::measure
