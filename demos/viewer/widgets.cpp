// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include <imgui.h>

#include <cstdio>

#include "viewer/panels.hpp"

namespace halfshadow::viewer {

float panelWidth() {
  return 23.0f * ImGui::GetFontSize();
}

bool namedButton(PanelInput& in, const char* label, const std::string& name) {
  const bool pressed = ImGui::Button(label);
  in.controls.mark(name);
  return pressed;
}

bool namedCheckbox(PanelInput& in, const char* label, const std::string& name, bool& value) {
  const bool changed = ImGui::Checkbox(label, &value);
  in.controls.mark(name);
  return changed;
}

bool namedRadio(PanelInput& in, const char* label, const std::string& name, bool chosen) {
  const bool pressed = ImGui::RadioButton(label, chosen);
  in.controls.mark(name);
  return pressed;
}

void help(const std::string& text) {
  ImGui::PushStyleColor(ImGuiCol_Text, ImGui::GetStyleColorVec4(ImGuiCol_TextDisabled));
  ImGui::TextWrapped("%s", text.c_str());
  ImGui::PopStyleColor();
}

void heading(const char* text) {
  ImGui::Dummy({0, 0.25f * ImGui::GetFontSize()});
  ImGui::TextUnformatted(text);
  ImGui::Separator();
}

std::string byteText(std::uint64_t bytes) {
  char text[48];
  const double value = static_cast<double>(bytes);
  if (bytes < 10240)
    std::snprintf(text, sizeof text, "%.0f B", value);
  else if (bytes < 10u << 20)
    std::snprintf(text, sizeof text, "%.1f KiB", value / 1024);
  else
    std::snprintf(text, sizeof text, "%.1f MiB", value / (1 << 20));
  return text;
}

}  // namespace halfshadow::viewer
