// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "viewer/controls.hpp"

#include <imgui.h>

#include <algorithm>

namespace halfshadow::viewer {

void Controls::mark(std::string name) {
  // In a script a space ends a name.
  std::ranges::replace(name, ' ', '-');
  const ImVec2 low = ImGui::GetItemRectMin(), high = ImGui::GetItemRectMax();
  const ImVec2 middle((low.x + high.x) / 2, (low.y + high.y) / 2);
  if (ImGui::IsRectVisible(middle, ImVec2(middle.x + 1, middle.y + 1))) {
    drawn_[name] = {middle.x, middle.y};
  } else if (name == wanted_) {
    ImGui::SetScrollHereY(0.5f);
  }
}

void Controls::endFrame() {
  last_ = std::move(drawn_);
  drawn_.clear();
}

std::optional<Place> Controls::find(const std::string& name) {
  wanted_.clear();
  if (const auto found = last_.find(name); found != last_.end()) return found->second;
  wanted_ = name;
  return std::nullopt;
}

std::vector<std::string> Controls::names() const {
  std::vector<std::string> names;
  for (const auto& [name, place] : last_) names.push_back(name);
  return names;
}

}  // namespace halfshadow::viewer
