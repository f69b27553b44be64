// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// Every choice of a device profile is one that the engine knows, with its reason; what is modelled says so.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "engine_fixture.hpp"
#include "shipped/profiles.hpp"

namespace halfshadow::test {
namespace {
using nlohmann::json;

class DeviceProfiles : public SharedEngineTest {};

TEST_F(DeviceProfiles, NameKnownSettingsWithReasons) {
  Engine& engine = renderer().engine();
  std::vector<std::string> parts;
  for (const shipped::File& file : shipped::profiles("devices")) {
    SCOPED_TRACE(file.path);
    const json profile = json::parse(file.text, nullptr, false);
    ASSERT_TRUE(profile.is_object());
    EXPECT_TRUE(profile.contains("measured_on") ||
                profile.value("label", "").find("not measured") != std::string::npos);
    const json& named = profile["match"]["renderer"];
    for (const json& part : named.is_array() ? named : json::array({named})) parts.push_back(part);
    EXPECT_GT(profile["settings"].size(), 0u);
    for (const json& setting : profile["settings"]) {
      const std::string key = setting["key"], value = setting["value"], reason = setting["reason"];
      const Outcome outcome = engine.set(key.c_str(), value.c_str());
      EXPECT_TRUE(outcome.ok()) << outcome.message;
      EXPECT_GT(reason.size(), 20u) << key;
      for (std::size_t i = 0; i < engine.settingCount(); ++i) {
        const SettingRecord record = engine.setting(i);
        if (key == record.key) EXPECT_TRUE(engine.set(record.key, record.defaultValue).ok());
      }
    }
  }
  // No renderer is of two devices.
  for (std::size_t i = 0; i < parts.size(); ++i) {
    for (std::size_t k = 0; k < parts.size(); ++k) {
      EXPECT_TRUE(i == k || parts[i].find(parts[k]) == std::string::npos) << parts[i] << " and " << parts[k];
    }
  }
  EXPECT_GT(parts.size(), 10u);
}

}  // namespace
}  // namespace halfshadow::test
