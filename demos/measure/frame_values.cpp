// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include <algorithm>
#include <cmath>

#include "measure/measurement.hpp"

namespace halfshadow::measure {

Counters countersOf(const FrameReport& report) {
  return {.passes = report.passCount,
          .framebufferSwitches = report.framebufferSwitches,
          .draws = report.draws,
          .triangles = report.triangles,
          .bytesLoaded = report.bytesLoaded,
          .bytesStored = report.bytesStored,
          .textureBytesUploaded = report.textureBytesUploaded,
          .bufferBytesUploaded = report.bufferBytesUploaded,
          .silhouettesExtracted = report.silhouettesExtracted,
          .castersDrawn = report.castersDrawn,
          .castersKept = report.castersKept};
}

std::vector<PassMeasurement> passesOf(const FrameReport& report) {
  std::vector<PassMeasurement> passes;
  for (std::size_t i = 0; i < report.passCount; ++i) {
    const PassRecord& pass = report.passes[i];
    passes.push_back({.name = pass.name,
                      .target = pass.target,
                      .draws = pass.draws,
                      .triangles = pass.triangles,
                      .clear = pass.clear,
                      .load = pass.load,
                      .store = pass.store,
                      .discard = pass.discard,
                      .lightSpace = pass.lightSpace,
                      .bytesLoaded = pass.bytesLoaded,
                      .bytesStored = pass.bytesStored,
                      .timeMs = pass.milliseconds});
  }
  return passes;
}

std::vector<SkipMeasurement> skipsOf(const FrameReport& report) {
  std::vector<SkipMeasurement> skips;
  for (std::size_t i = 0; i < report.skipCount; ++i)
    skips.push_back({report.skips[i].what, report.skips[i].why});
  return skips;
}

std::vector<Setting> effectiveSettings(EngineSession& session, const std::string& technique) {
  Engine& engine = session.engine();
  std::vector<Setting> settings;
  for (std::size_t i = 0; i < engine.settingCount(); ++i) {
    const SettingRecord record = engine.setting(i);
    const std::string key = record.key;
    if (key.starts_with(technique + ".") || key.find('.') == std::string::npos)
      settings.push_back({key, record.value});
  }
  return settings;
}

TimeStatistics timeStatistics(std::vector<double> milliseconds) {
  if (milliseconds.empty()) return {};
  std::ranges::sort(milliseconds);
  const auto rank = [&](double share) {
    const auto count = static_cast<double>(milliseconds.size());
    const auto index = static_cast<std::size_t>(std::max(std::ceil(share * count), 1.0)) - 1;
    return milliseconds[std::min(index, milliseconds.size() - 1)];
  };
  return {.medianMs = rank(0.5),
          .p95Ms = rank(0.95),
          .minMs = milliseconds.front(),
          .frames = static_cast<int>(milliseconds.size())};
}

std::vector<std::string> techniqueIds(EngineSession& session) {
  std::vector<std::string> ids;
  for (std::size_t i = 0; i < session.engine().techniqueCount(); ++i)
    ids.emplace_back(session.engine().technique(i).id);
  return ids;
}

}  // namespace halfshadow::measure
