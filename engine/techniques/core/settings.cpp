// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "techniques/core/settings.hpp"

#include <algorithm>
#include <cassert>
#include <charconv>
#include <cmath>
#include <cstdio>

#include "base/keys.hpp"

namespace halfshadow::techniques {
namespace {
std::string number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%g", value);
  return text;
}

bool parse(std::string_view text, double& value) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc() && end == text.data() + text.size() && std::isfinite(value);
}
/// Digits alone, of which the first of several is not 0, behind a minus or not.
bool isPlainInteger(std::string_view text) {
  if (text.starts_with('-')) text.remove_prefix(1);
  if (text.empty() || (text.size() > 1 && text.front() == '0')) return false;
  return std::ranges::all_of(text, [](char c) { return c >= '0' && c <= '9'; });
}
}  // namespace

std::vector<SettingInfo> commonSettings() {
  return {
      {"map_size",
       SettingType::integer,
       "1024",
       16,
       8192,
       {},
       "side in texels of the depth map, or of all maps that a light's sub-lights share"},
      {"sub_lights",
       SettingType::choice,
       "auto",
       0,
       0,
       {"auto", "1", "2", "3", "4"},
       "parts per longer side of a rectangle light that maps see it from; auto: as the penumbrae need, with "
       "one search for their width instead of one for each part"},
      {"bias",
       SettingType::real,
       "1.0",
       0,
       16,
       {},
       "multiple of the depth bias derived from texel size, slope, storage and kernel; 1 = no acne"},
      {"shading",
       SettingType::choice,
       "together",
       0,
       0,
       {"together", "apart"},
       "whether a single light is shaded where its visibility is found, or in a pass of its own: smaller "
       "programs, and one image more; several lights are always shaded apart"},
      {"program_size",
       SettingType::choice,
       "full",
       0,
       0,
       {"full", "short", "parts"},
       "short: forms of pcss, pcss-mip and pcf-quantized that fit 256 instructions (tap by tap, one search, "
       "no horizons; without highp few registers, four taps a turn), and wedges that receivers cut a vertex "
       "at a time; parts: also occlusion-textures "
       "two "
       "slices a draw and wedges-blended two quadrants a draw, on the screen; taken by themselves where the "
       "full ones draw nothing; device profiles set it"},
      {"filter_skip",
       SettingType::choice,
       "stencil",
       0,
       0,
       {"branch", "loop", "stencil"},
       "how pixels that need no filter skip it, where a technique leaves it open; device profiles set it"},
      {"occlusion_prefilter",
       SettingType::choice,
       "nbuffer",
       0,
       0,
       {"nbuffer", "sat"},
       "what occlusion-textures.filter=auto means: the cheaper of the two accurate prefilters; device "
       "profiles set it"},
      {"map_updates",
       SettingType::choice,
       "auto",
       0,
       0,
       {"auto", "always", "never"},
       "whether maps and slices in which some casters moved are drawn again in that part alone; auto: where "
       "that saves more draws than loading the rest takes a GPU that renders by tiles; the picture is the "
       "same; device profiles set it"},
      {"outline_triangles",
       SettingType::integer,
       "50000",
       1,
       999999,
       {},
       "triangles of casters that are not convex, in all, up to which wedges follow their outlines; where "
       "there are more pcss-mip takes the light, since a frame would take seconds"},
      {"outline_detail",
       SettingType::real,
       "0.002",
       0,
       0.1,
       {},
       "share of a light by which outlines may be off where receivers stand: vertices that matter less are "
       "left out of the lists of wedges-cells and wedges-blended; 0 keeps all"},
      {"list_walk",
       SettingType::choice,
       "auto",
       0,
       0,
       {"auto", "surfaces", "screen"},
       "where casters that receive walk their lists: surfaces: as they are drawn; screen: in a pass of their "
       "own over what is seen of them, for whose pixels it does not matter how small their triangles are; "
       "auto: on the screen where they are dense, so that lists lead into trees of faces"},
      {"wedge_route",
       SettingType::choice,
       "gather",
       0,
       0,
       {"gather", "scatter", "fetch"},
       "what wedges-cells.route=auto means; device profiles set it"},
      {"wedge_merge",
       SettingType::choice,
       "gather",
       0,
       0,
       {"gather", "core", "minmax", "fetch"},
       "what wedges-blended.merge=auto means; device profiles set it"}};
}

Settings::Settings(std::vector<SettingInfo> declared) : declared_(std::move(declared)) {
  for (const SettingInfo& info : declared_) values_[info.key] = info.defaultValue;
}

Status Settings::set(std::string_view key, std::string_view value) {
  const auto info = std::ranges::find(declared_, key, &SettingInfo::key);
  if (info == declared_.end()) {
    const std::string prefix(key.substr(0, key.find('.')));
    std::string known;
    for (const SettingInfo& candidate : declared_) {
      const bool related =
          candidate.key.starts_with(prefix + ".") || candidate.key.find('.') == std::string::npos;
      if (related) known += (known.empty() ? "" : ", ") + candidate.key;
    }
    return Error{ErrorCode::unknownSetting,
                 "unknown setting \"" + std::string(key) + "\"; known here: " + known};
  }
  if (info->type == SettingType::choice) {
    if (std::ranges::find(info->choices, value) == info->choices.end()) {
      std::string known;
      for (const std::string& choice : info->choices) known += (known.empty() ? "" : ", ") + choice;
      return Error{ErrorCode::invalidArgument,
                   info->key + "=" + std::string(value) + ": choose one of " + known};
    }
  } else {
    double parsed = 0;
    // Integers reach shaders as they are written.
    const bool whole = info->type != SettingType::integer || isPlainInteger(value);
    if (!parse(value, parsed) || !whole || parsed < info->low || parsed > info->high) {
      return Error{ErrorCode::invalidArgument,
                   info->key + "=" + std::string(value) + ": give " +
                       (info->type == SettingType::integer ? "a whole number" : "a number") + " from " +
                       number(info->low) + " to " + number(info->high)};
    }
  }
  std::string& stored = values_.find(key)->second;
  if (stored != value) {
    stored = value;
    ++revision_;
  }
  return {};
}

Settings Settings::with(std::span<const std::pair<std::string, std::string>> values) const {
  Settings changed = *this;
  for (const auto& [key, value] : values) {
    (void)changed.set(key, value).ok();
    changed.revision_ = combineKeys(changed.revision_, textKey(key + "=" + value));
  }
  return changed;
}

const std::string& Settings::valueOf(std::string_view key) const {
  const auto found = values_.find(key);
  assert(found != values_.end() && "a technique reads a setting that it never declared");
  return found->second;
}

double Settings::real(std::string_view key) const {
  double value = 0;
  parse(valueOf(key), value);
  return value;
}

int Settings::integer(std::string_view key) const {
  return static_cast<int>(std::lround(real(key)));
}
const std::string& Settings::choice(std::string_view key) const {
  return valueOf(key);
}
std::string Settings::text(std::string_view key) const {
  return valueOf(key);
}

}  // namespace halfshadow::techniques
