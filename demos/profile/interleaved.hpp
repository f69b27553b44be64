// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// Times of several configurations taken in turn, so that a machine that gets slower or faster meets all
/// alike.
#pragma once

#include <string>
#include <vector>

#include "measure/measurement.hpp"

namespace halfshadow::profile {

struct PassTime {
  std::string name;
  bool lightSpace = false;
  double medianMs = 0.0;  ///< waited for
};

struct FrameTimes {
  bool supported = true;
  measure::TimeStatistics frame;        ///< whole dynamic frames
  measure::TimeStatistics frameStatic;  ///< whole frames in which nothing changed
  /// The same in processor time of the whole process: on a software driver the cost of a frame, whatever else
  /// the machine does; elsewhere what the frame costs the CPU.
  measure::TimeStatistics frameCpu, frameStaticCpu;
  measure::TimeStatistics lightPasses;     ///< sum of the passes in light space, each waited for
  measure::TimeStatistics receiverPasses;  ///< sum of the others
  std::vector<PassTime> passes;            ///< of dynamic frames, in the order of drawing
  std::vector<float> visibility;  ///< after the timed frames, for comparison with the measured picture
};

struct InterleavedOptions {
  int width = 0, height = 0, repetitions = 0;
  measure::Progress progress{};
};

/// One engine, one scene; each repetition runs every configuration: two untimed frames, one timed whole, one
/// timed by pass, before each of which the light moves imperceptibly, so that nothing is cached; then one
/// unchanged frame, timed whole. The result has the order of `configurations`. Errors: those of
/// EngineSession.
Result<std::vector<FrameTimes>> interleavedTimes(measure::EngineSession& session,
                                                 const scene::SceneDescription& scene,
                                                 const std::vector<measure::Configuration>& configurations,
                                                 const InterleavedOptions& options);

}  // namespace halfshadow::profile
