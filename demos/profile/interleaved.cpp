// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "profile/interleaved.hpp"

#include <algorithm>
#include <chrono>
#include <ctime>
#include <set>
#include <utility>

namespace halfshadow::profile {
namespace {
using Clock = std::chrono::steady_clock;
using measure::Configuration;
using measure::Setting;

/// As in the measurements: another light to the engine, the same texels.
constexpr double kLightStep = 1e-7;

bool supports(Engine& engine, const std::string& technique) {
  for (std::size_t i = 0; i < engine.techniqueCount(); ++i) {
    if (technique == engine.technique(i).id) return engine.technique(i).supported;
  }
  return true;  // choosing it reports the unknown name
}

/// Each configuration's settings with the defaults of what only the others set, since all share one engine.
std::vector<Configuration> completed(Engine& engine, const std::vector<Configuration>& configurations) {
  std::set<std::string> keys;
  for (const Configuration& configuration : configurations) {
    for (const Setting& setting : configuration.settings) keys.insert(setting.key);
  }
  std::vector<Setting> defaults;
  for (std::size_t i = 0; i < engine.settingCount(); ++i) {
    const SettingRecord record = engine.setting(i);
    if (keys.count(record.key)) defaults.push_back({record.key, record.defaultValue});
  }
  std::vector<Configuration> result;
  for (const Configuration& configuration : configurations) {
    Configuration full{configuration.technique, defaults};
    full.settings.insert(full.settings.end(), configuration.settings.begin(), configuration.settings.end());
    result.push_back(std::move(full));
  }
  return result;
}

/// Wall clock and processor time since it was made.
class Stopwatch {
 public:
  double wallMs() const { return std::chrono::duration<double, std::milli>(Clock::now() - wall_).count(); }
  double cpuMs() const { return 1e3 * static_cast<double>(std::clock() - cpu_) / CLOCKS_PER_SEC; }

 private:
  Clock::time_point wall_ = Clock::now();
  std::clock_t cpu_ = std::clock();
};

struct FrameTime {
  double wallMs = 0.0, cpuMs = 0.0;
};

struct Samples {
  std::vector<double> frame, frameCpu, unchanged, unchangedCpu, light, receiver;
  std::vector<PassTime> passes;             ///< of the last frame
  std::vector<std::vector<double>> byPass;  ///< parallel to it

  void addPasses(const FrameReport& report) {
    if (passes.size() != report.passCount) {
      passes.resize(report.passCount);
      byPass.assign(report.passCount, {});
    }
    double lightSum = 0.0, receiverSum = 0.0;
    for (std::size_t i = 0; i < report.passCount; ++i) {
      const PassRecord& pass = report.passes[i];
      (pass.lightSpace ? lightSum : receiverSum) += pass.milliseconds;
      passes[i] = {.name = pass.name, .lightSpace = pass.lightSpace};
      byPass[i].push_back(pass.milliseconds);
    }
    light.push_back(lightSum);
    receiver.push_back(receiverSum);
  }
};

class Frames {
 public:
  Frames(measure::EngineSession& session, const scene::SceneDescription& scene,
         const InterleavedOptions& options)
      : session_(session), light_(scene.lights.front()) {
    desc_.camera = measure::cameraDesc(*scene.camera);
    desc_.target = {.width = options.width, .height = options.height};
    const scene::Bounds bounds = scene::boundsWorld(scene, scene::ObjectFilter::all);
    step_ = kLightStep * std::max(glm::length(light_.centerWorld - bounds.center()), bounds.radius());
  }

  Status choose(const Configuration& configuration) {
    desc_.output = measure::visibilityOutputOf(configuration.technique);
    return session_.choose(configuration.technique, configuration.settings);
  }

  Status repetition(Samples* samples) {
    FrameReport report;
    FrameTime time;
    // The first frame after a change of technique makes its targets; the second fills what the first
    // replaced.
    for (int i = 0; i < 2; ++i) {
      if (Status status = dynamicFrame(Timing::off, report, time); !status) return status;
    }
    if (Status status = dynamicFrame(Timing::off, report, time); !status) return status;
    if (samples != nullptr) {
      samples->frame.push_back(time.wallMs);
      samples->frameCpu.push_back(time.cpuMs);
    }
    if (Status status = dynamicFrame(Timing::perPass, report, time); !status) return status;
    if (samples != nullptr) samples->addPasses(report);
    // The light as it was, under a camera that moved: of a wholly unchanged frame nothing is drawn.
    session_.engine().finish();
    const CameraDesc camera = std::exchange(desc_.camera, measure::nudged(desc_.camera));
    const Status nudged = timedFrame(Timing::off, Stopwatch(), report, time);
    desc_.camera = camera;
    if (!nudged) return nudged;
    if (samples != nullptr) {
      samples->unchanged.push_back(time.wallMs);
      samples->unchangedCpu.push_back(time.cpuMs);
    }
    return {};
  }

  Result<std::vector<float>> visibility() {
    if (Status status = session_.setLights({light_}); !status) return status.error();
    FrameReport report;
    desc_.timing = Timing::off;
    if (Status status = session_.render(desc_, report); !status) return status.error();
    auto image = session_.read(desc_.target.width, desc_.target.height);
    if (!image) return image.error();
    return measure::decodeVisibility(*image, desc_.output);
  }

 private:
  /// Moves the light and renders.
  Status dynamicFrame(Timing timing, FrameReport& report, FrameTime& time) {
    session_.engine().finish();
    const Stopwatch watch;
    moved_ = !moved_;
    scene::AreaLight light = light_;
    if (moved_) light.centerWorld -= scene::emissionDirection(light) * step_;
    if (Status status = session_.setLights({light}); !status) return status;
    return timedFrame(timing, watch, report, time);
  }

  Status timedFrame(Timing timing, const Stopwatch& watch, FrameReport& report, FrameTime& time) {
    desc_.timing = timing;
    if (Status status = session_.render(desc_); !status) return status;
    session_.engine().finish();
    time = {watch.wallMs(), watch.cpuMs()};
    report = session_.engine().report();
    return {};
  }

  measure::EngineSession& session_;
  scene::AreaLight light_;
  RenderDesc desc_;
  double step_ = 0.0;
  bool moved_ = false;
};

}  // namespace

Result<std::vector<FrameTimes>> interleavedTimes(measure::EngineSession& session,
                                                 const scene::SceneDescription& scene,
                                                 const std::vector<Configuration>& configurations,
                                                 const InterleavedOptions& options) {
  if (Status status = session.renewEngine(); !status) return status.error();
  if (Status status = session.load(scene); !status) return status.error();
  const std::vector<Configuration> full = completed(session.engine(), configurations);
  std::vector<FrameTimes> times(full.size());
  std::vector<Samples> samples(full.size());
  for (std::size_t i = 0; i < full.size(); ++i)
    times[i].supported = supports(session.engine(), full[i].technique);

  Frames frames(session, scene, options);
  // Repetition -1 warms up: programs are linked and caches filled.
  for (int repetition = -1; repetition < options.repetitions; ++repetition) {
    if (options.progress) {
      options.progress("timing", static_cast<double>(repetition + 1) / (options.repetitions + 1));
    }
    for (std::size_t i = 0; i < full.size(); ++i) {
      if (!times[i].supported) continue;
      if (Status status = frames.choose(full[i]); !status) return status.error();
      if (Status status = frames.repetition(repetition < 0 ? nullptr : &samples[i]); !status)
        return status.error();
    }
  }
  for (std::size_t i = 0; i < full.size(); ++i) {
    if (!times[i].supported) continue;
    if (Status status = frames.choose(full[i]); !status) return status.error();
    auto visibility = frames.visibility();
    if (!visibility) return visibility.error();
    times[i].visibility = std::move(*visibility);
    times[i].passes = std::move(samples[i].passes);
    for (std::size_t k = 0; k < times[i].passes.size(); ++k) {
      times[i].passes[k].medianMs = measure::timeStatistics(std::move(samples[i].byPass[k])).medianMs;
    }
    times[i].frameStatic = measure::timeStatistics(std::move(samples[i].unchanged));
    times[i].frame = measure::timeStatistics(std::move(samples[i].frame));
    times[i].frameCpu = measure::timeStatistics(std::move(samples[i].frameCpu));
    times[i].frameStaticCpu = measure::timeStatistics(std::move(samples[i].unchangedCpu));
    times[i].lightPasses = measure::timeStatistics(std::move(samples[i].light));
    times[i].receiverPasses = measure::timeStatistics(std::move(samples[i].receiver));
  }
  return times;
}

}  // namespace halfshadow::profile
