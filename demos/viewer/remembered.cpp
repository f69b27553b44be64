// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "viewer/remembered.hpp"

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "measure/text_file.hpp"

namespace halfshadow::viewer {
namespace {
using nlohmann::json;

/// The value when it is there and of its kind.
template <typename T>
void read(const json& object, const char* key, T& value) {
  const auto found = object.find(key);
  if (found == object.end()) return;
  if constexpr (std::is_same_v<T, bool>) {
    if (found->is_boolean()) value = found->get<bool>();
  } else if constexpr (std::is_same_v<T, int>) {
    if (found->is_number_integer()) value = found->get<int>();
  } else {
    if (found->is_string()) value = found->get<std::string>();
  }
}

void readPlace(const json& object, const char* key, std::optional<int>& value) {
  const auto found = object.find(key);
  if (found != object.end() && found->is_number_integer()) value = found->get<int>();
}
}  // namespace

std::string rememberedPath() {
  const char* config = std::getenv("XDG_CONFIG_HOME");
  if (config != nullptr && *config != '\0') return std::string(config) + "/halfshadow/viewer.json";
  const char* home = std::getenv("HOME");
  if (home != nullptr && *home != '\0') return std::string(home) + "/.config/halfshadow/viewer.json";
  return {};
}

Remembered readRemembered(const std::string& path) {
  constexpr int kLeast = 200, kMost = 16384;  // pixels of a window that can be used
  Remembered remembered;
  std::ifstream file(path);
  if (!file) return remembered;
  const json object = json::parse(file, nullptr, false);
  if (!object.is_object()) return remembered;
  read(object, "window_width", remembered.windowWidth);
  read(object, "window_height", remembered.windowHeight);
  const auto fits = [](int side) { return side >= kLeast && side <= kMost; };
  if (!fits(remembered.windowWidth) || !fits(remembered.windowHeight))
    remembered.windowWidth = 1280, remembered.windowHeight = 720;
  readPlace(object, "window_x", remembered.windowX);
  readPlace(object, "window_y", remembered.windowY);
  read(object, "scene", remembered.source);
  read(object, "technique", remembered.technique);
  read(object, "tab", remembered.tab);
  read(object, "light_handles", remembered.showsHandles);
  if (const auto settings = object.find("settings"); settings != object.end() && settings->is_object()) {
    for (const auto& [key, value] : settings->items()) {
      if (value.is_string()) remembered.choices[key] = value.get<std::string>();
    }
  }
  return remembered;
}

Status writeRemembered(const std::string& path, const Remembered& remembered) {
  json object = {{"window_width", remembered.windowWidth},
                 {"window_height", remembered.windowHeight},
                 {"scene", remembered.source},
                 {"technique", remembered.technique},
                 {"settings", remembered.choices},
                 {"tab", remembered.tab},
                 {"light_handles", remembered.showsHandles}};
  if (remembered.windowX) object["window_x"] = *remembered.windowX;
  if (remembered.windowY) object["window_y"] = *remembered.windowY;
  std::error_code failed;
  std::filesystem::create_directories(std::filesystem::path(path).parent_path(), failed);
  return measure::writeTextFile(path, object.dump(2) + "\n");
}

}  // namespace halfshadow::viewer
