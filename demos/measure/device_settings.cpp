// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "measure/device_settings.hpp"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

namespace halfshadow::measure {
namespace {
namespace fs = std::filesystem;
using nlohmann::json;

Result<json> readProfile(const std::string& path) {
  std::ifstream file(path);
  if (!file)
    return Error{ErrorCode::fileNotFound, path + ": the device profile cannot be read; check the path"};
  json profile = json::parse(file, nullptr, false);
  if (!profile.is_object()) {
    return Error{ErrorCode::fileMalformed,
                 path + ": not a device profile; give a device.json of `halfshadow profile`"};
  }
  return profile;
}

Result<std::vector<Setting>> settingsOf(const std::string& path, const json& profile) {
  std::vector<Setting> settings;
  const json list = profile.value("settings", json::array());
  for (const json& entry : list) {
    if (!entry.is_object() || !entry.contains("key") || !entry.contains("value") ||
        !entry["key"].is_string() || !entry["value"].is_string()) {
      return Error{ErrorCode::fileMalformed,
                   path + ": each of \"settings\" needs a text \"key\" and \"value\""};
    }
    settings.push_back({entry["key"], entry["value"]});
  }
  return settings;
}

/// `match.renderer`: a part of the renderer's name, or a list of such.
bool matches(const json& profile, const std::string& renderer) {
  const json match = profile.value("match", json::object());
  if (!match.is_object() || !match.contains("renderer")) return false;
  const json& named = match["renderer"];
  const auto isPart = [&](const json& part) {
    return part.is_string() && renderer.find(part.get<std::string>()) != std::string::npos;
  };
  return named.is_array() ? std::ranges::any_of(named, isPart) : isPart(named);
}
}  // namespace

Result<std::vector<Setting>> deviceSettings(const std::string& source, const std::string& renderer) {
  if (source == "none") return std::vector<Setting>{};
  if (source == "auto") return deviceSettingsIn(HALFSHADOW_DEVICE_PROFILES, renderer);
  auto profile = readProfile(source);
  if (!profile) return profile.error();
  return settingsOf(source, *profile);
}

Result<std::vector<Setting>> deviceSettingsIn(const std::string& folder, const std::string& renderer) {
  std::error_code missing;
  for (const auto& entry : fs::directory_iterator(folder, missing)) {
    if (entry.path().extension() != ".json") continue;
    auto profile = readProfile(entry.path().string());
    if (!profile) return profile.error();
    if (matches(*profile, renderer)) return settingsOf(entry.path().string(), *profile);
  }
  return std::vector<Setting>{};
}

}  // namespace halfshadow::measure
