// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "measure/device_settings.hpp"

#include <algorithm>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>

namespace halfshadow::measure {
namespace {
using nlohmann::json;

Result<json> parsed(const std::string& path, std::string_view text) {
  json profile = json::parse(text, nullptr, false);
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
  if (source == "auto") return deviceSettingsAmong(shipped::profiles("devices"), renderer);
  std::ifstream file(source);
  if (!file)
    return Error{ErrorCode::fileNotFound, source + ": the device profile cannot be read; check the path"};
  const std::string text{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
  const auto profile = parsed(source, text);
  if (!profile) return profile.error();
  return settingsOf(source, *profile);
}

Result<std::vector<Setting>> deviceSettingsAmong(std::span<const shipped::File> profiles,
                                                 const std::string& renderer) {
  for (const shipped::File& file : profiles) {
    const std::string path(file.path);
    const auto profile = parsed(path, file.text);
    if (!profile) return profile.error();
    if (matches(*profile, renderer)) return settingsOf(path, *profile);
  }
  return std::vector<Setting>{};
}

}  // namespace halfshadow::measure
