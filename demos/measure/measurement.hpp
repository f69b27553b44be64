// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// Techniques against ray-traced truth: errors, counters and times of one scene, light and camera.
///
/// Usage: `traceTruth` once per scene, then `measureTechnique` once per configuration.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "measure/engine_session.hpp"
#include "metrics/metrics.hpp"
#include "reference/reference.hpp"

namespace halfshadow::measure {

/// Stage ("truth", "noise floor", …) and share done, 0 … 1. May be empty.
using Progress = std::function<void(const std::string& stage, double share)>;

/// Ray-traced visibility of the scene's first light from its camera.
struct Truth {
  int width = 0, height = 0;
  int samples = 0;  ///< light points per pixel that were traced
  reference::ReceiverImage receivers;
  std::vector<float> visibility;
  std::vector<std::uint8_t> penumbra;  ///< 1 on penumbra pixels
  double noiseRmse = 0.0;
  double originLiftWorld = 0.0;
  std::size_t receiverPixels = 0, penumbraPixels = 0;
};

/// `scene` has a camera and a light (scenes::openScene gives both). Errors: those of reference.hpp.
/// `originLiftWorld`: see reference::ReferenceOptions.
Result<Truth> traceTruth(const scene::SceneDescription& scene, int width, int height, int samples,
                         const Progress& progress, double originLiftWorld = 0.0);

struct ErrorSet {
  metrics::ErrorStatistics receiver, penumbra;
  double penumbraRoughness = 0.0;  ///< metrics::roughness
};

struct TimeStatistics {
  double medianMs = 0, p95Ms = 0, minMs = 0;
  int frames = 0;  ///< 0 = not measured
};
/// Percentiles by nearest rank.
TimeStatistics timeStatistics(std::vector<double> milliseconds);

struct PassMeasurement {
  std::string name, target;
  std::uint64_t draws = 0, triangles = 0;
  bool clear = false, load = false, store = false, discard = false, lightSpace = false;
  std::uint64_t bytesLoaded = 0, bytesStored = 0;
  double timeMs = 0.0;  ///< each pass waited for: their sum exceeds the frame's time
};

struct SkipMeasurement {
  std::string what, why;
};

struct Counters {
  std::uint64_t passes = 0, framebufferSwitches = 0, draws = 0, triangles = 0;
  std::uint64_t bytesLoaded = 0, bytesStored = 0, textureBytesUploaded = 0, bufferBytesUploaded = 0;
  std::uint64_t silhouettesExtracted = 0;
  std::uint64_t castersDrawn = 0, castersKept = 0;
  double tapsPerPixel = 0.0;  ///< mean over receiver pixels
};

/// What a report says, as values that outlive it. Counters lack tapsPerPixel, which takes a frame of its own.
Counters countersOf(const FrameReport& report);
std::vector<PassMeasurement> passesOf(const FrameReport& report);
std::vector<SkipMeasurement> skipsOf(const FrameReport& report);

/// A technique with the settings that it is measured at; the others have their defaults.
struct Configuration {
  std::string technique;
  std::vector<Setting> settings{};
};

struct MeasureOptions {
  int timingFrames = 5;  ///< 0 = no times
  int warmUpFrames = 2;
  Progress progress{};
};

struct TechniqueMeasurement {
  std::string id;
  bool supported = true;
  std::string unsupportedReason;
  std::string failure;  ///< why the engine refused the scene or a frame; the rest is then empty
  bool measured() const { return supported && failure.empty(); }
  /// "not supported here: …" or "failed: …"; empty when measured.
  std::string absence() const;
  std::vector<Setting> settings;  ///< effective: `<id>.*`, map_size, bias
  ErrorSet error;                 ///< against the truth, all receivers
  ErrorSet errorOnGround, errorOnCasters;
  /// Dynamic frames: the light moves by 1e-7 of its distance each frame, so that every shadow map is remade.
  TimeStatistics time;
  /// Frames in which nothing changed: what is cached stays.
  TimeStatistics timeStatic;
  std::uint64_t memoryBytes = 0;
  Counters counters;                    ///< of one dynamic frame
  Counters countersStatic;              ///< of one unchanged frame
  std::vector<PassMeasurement> passes;  ///< of one dynamic frame with per-pass timing
  std::vector<SkipMeasurement> skipped;
  std::string planText;
  std::vector<float> visibility;  ///< width × height; empty unless measured
};

/// Measures one configuration on a renewed engine. An unsupported technique is a result (supported = false
/// with the reason), and so is one that cannot draw the scene (`failure`). Errors: unknownTechnique,
/// unknownSetting, invalidArgument, contextLost.
Result<TechniqueMeasurement> measureTechnique(EngineSession& session, const scene::SceneDescription& scene,
                                              const Truth& truth, const Configuration& configuration,
                                              const MeasureOptions& options);

/// Values of `<technique>.*` and of the settings that all techniques share.
std::vector<Setting> effectiveSettings(EngineSession& session, const std::string& technique);

/// All techniques of the session's engine, in its order.
std::vector<std::string> techniqueIds(EngineSession& session);

}  // namespace halfshadow::measure
