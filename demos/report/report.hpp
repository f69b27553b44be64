// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// Measurements as one HTML file: pictures, error maps, numbers and plots, no script, nothing fetched.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "measure/measurement.hpp"
#include "report/section.hpp"

namespace halfshadow::report {

/// Own copies of what DriverRecord points to.
struct Device {
  std::string vendor, renderer, version, depthStorage, byteRounding;
};
Device deviceOf(const DriverRecord& driver);

/// One scene, light and camera.
struct SceneReport {
  std::string title;          ///< "builtin:figure"
  std::string description;    ///< one line: objects, triangles, light
  scenes::ViewCommand view;   ///< opens the scene as it was measured; without technique
  measure::RgbaImage shaded;  ///< may be empty
  std::string shadedWith;     ///< the technique of `shaded`
  measure::Truth truth;       ///< of the same size
  std::vector<measure::TechniqueMeasurement> techniques;
};

struct Report {
  std::string title;
  std::string introduction;  ///< one paragraph: what was measured and how
  Device device;
  std::vector<Table> tables;  ///< shown before the scenes
  std::vector<SceneReport> scenes;
  std::vector<Section> sections;  ///< after the scenes
};

/// The whole document. Errors: invalidArgument (an image is not of its scene's size).
Result<std::string> reportHtml(const Report& report);
/// Writes it; a failed write leaves no partial file. Errors: those of reportHtml, fileNotWritable.
Status writeReport(const std::filesystem::path& path, const Report& report);

}  // namespace halfshadow::report
