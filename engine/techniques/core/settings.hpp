// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// Settings of techniques: declared with type, range, default and sentence; stored as checked values.
#pragma once

#include <map>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/error.hpp"

namespace halfshadow::techniques {

enum class SettingType { integer, real, choice };

struct SettingInfo {
  std::string key;  ///< "pcf.size"; keys without a dot hold for every technique that uses them
  SettingType type = SettingType::real;
  std::string defaultValue;
  double low = 0, high = 0;          ///< inclusive range of numbers
  std::vector<std::string> choices;  ///< of a choice
  std::string text;                  ///< one sentence, with the unit
};

/// Those that hold for every technique that uses them.
std::vector<SettingInfo> commonSettings();

/// Values by key, all valid. Keys are declared once by the registry.
class Settings {
 public:
  explicit Settings(std::vector<SettingInfo> declared);

  /// Errors: unknownSetting (lists the technique's keys), invalidArgument (names range or choices).
  Status set(std::string_view key, std::string_view value);
  /// A copy with other values, of another revision. Values that set() would refuse stay as they are.
  Settings with(std::span<const std::pair<std::string, std::string>> values) const;
  int integer(std::string_view key) const;
  double real(std::string_view key) const;
  const std::string& choice(std::string_view key) const;
  std::string text(std::string_view key) const;
  std::span<const SettingInfo> declared() const { return declared_; }
  /// Changes whenever a value does: part of content keys.
  std::uint64_t revision() const { return revision_; }

 private:
  const std::string& valueOf(std::string_view key) const;
  std::vector<SettingInfo> declared_;
  std::map<std::string, std::string, std::less<>> values_;
  std::uint64_t revision_ = 1;
};

}  // namespace halfshadow::techniques
