// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include <imgui.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>

#include "viewer/error_map.hpp"
#include "viewer/panels.hpp"

namespace halfshadow::viewer {
namespace {
bool isOf(const SettingChoice& setting, const std::string& technique) {
  return setting.key.find('.') == std::string::npos || setting.key.starts_with(technique + ".");
}

/// "2 to 17" as numbers.
bool rangeOf(const SettingChoice& setting, double& low, double& high) {
  return std::sscanf(setting.allowed.c_str(), "%lg to %lg", &low, &high) == 2;
}

std::vector<std::string> optionsOf(const SettingChoice& setting) {
  std::vector<std::string> options;
  for (std::size_t first = 0; first < setting.allowed.size();) {
    const std::size_t end = std::min(setting.allowed.find(", ", first), setting.allowed.size());
    options.push_back(setting.allowed.substr(first, end - first));
    first = end + 2;
  }
  return options;
}

void choose(Choices& choices, const SettingChoice& setting, const std::string& value) {
  if (value == setting.start) {
    choices.erase(setting.key);
  } else {
    choices[setting.key] = value;
  }
}

void choiceRow(PanelInput& in, const SettingChoice& setting, const std::string& value) {
  const bool isOpen = ImGui::BeginCombo("##value", value.c_str());
  in.controls.mark("setting/" + setting.key);
  if (!isOpen) return;
  for (const std::string& option : optionsOf(setting)) {
    if (ImGui::Selectable(option.c_str(), option == value)) choose(in.state.view.choices, setting, option);
    in.controls.mark("setting/" + setting.key + "/" + option);
  }
  ImGui::EndCombo();
}

void numberRow(PanelInput& in, const SettingChoice& setting, const std::string& value) {
  double low = 0.0, high = 1.0;
  if (!rangeOf(setting, low, high)) return;
  Choices& choices = in.state.view.choices;
  // A wide range is felt better on a logarithmic scale.
  const ImGuiSliderFlags flags =
      (low > 0 && high / low > 100 ? ImGuiSliderFlags_Logarithmic : 0) | ImGuiSliderFlags_AlwaysClamp;
  char text[40];
  if (setting.type == "integer") {
    int number = std::atoi(value.c_str());
    if (ImGui::SliderInt("##value", &number, static_cast<int>(low), static_cast<int>(high), "%d", flags))
      choose(choices, setting, std::to_string(number));
  } else {
    float number = static_cast<float>(std::atof(value.c_str()));
    if (ImGui::SliderFloat("##value", &number, static_cast<float>(low), static_cast<float>(high), "%.4g",
                           flags)) {
      std::snprintf(text, sizeof text, "%.6g", static_cast<double>(number));
      choose(choices, setting, text);
    }
  }
  in.controls.mark("setting/" + setting.key);
}

void settingRow(PanelInput& in, const SettingChoice& setting) {
  const std::string value = in.picture.value(setting.key, in.state.view.choices);
  ImGui::PushID(setting.key.c_str());
  const std::size_t dot = setting.key.find('.');
  const bool isChanged = in.state.view.choices.contains(setting.key);
  ImGui::TextUnformatted(setting.key.substr(dot == std::string::npos ? 0 : dot + 1).c_str());
  if (isChanged) {
    ImGui::SameLine();
    if (ImGui::SmallButton("as it was")) in.state.view.choices.erase(setting.key);
    in.controls.mark("setting/" + setting.key + "/reset");
  }
  ImGui::SetNextItemWidth(-1);
  if (setting.type == "choice") {
    choiceRow(in, setting, value);
  } else {
    numberRow(in, setting, value);
  }
  help(setting.text + "; " + setting.allowed + "; default " + setting.start);
  ImGui::PopID();
}

void techniqueList(PanelInput& in, const char* label, const std::string& name, std::string& technique) {
  ImGui::SetNextItemWidth(-1);
  const bool isOpen = ImGui::BeginCombo(label, technique.c_str(), ImGuiComboFlags_HeightLargest);
  in.controls.mark(name);
  if (!isOpen) return;
  for (const TechniqueChoice& choice : in.picture.techniques()) {
    ImGui::BeginDisabled(!choice.supported);
    if (ImGui::Selectable(choice.id.c_str(), choice.id == technique)) technique = choice.id;
    ImGui::EndDisabled();
    in.controls.mark(name + "/" + choice.id);
    if (ImGui::IsItemHovered(ImGuiHoveredFlags_AllowWhenDisabled))
      ImGui::SetTooltip("%s", (choice.supported ? choice.summary : choice.reason).c_str());
  }
  ImGui::EndCombo();
}

/// What the map's colours mean.
void errorScale(double full) {
  constexpr int kSteps = 64;
  const float width = ImGui::GetContentRegionAvail().x, height = ImGui::GetFontSize();
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  for (int i = 0; i < kSteps; ++i) {
    const double share = (i + 0.5) / kSteps;
    const Colour colour = errorColour((2.0 * share - 1.0) * full, full);
    const float left = corner.x + width * static_cast<float>(i) / kSteps;
    ImGui::GetWindowDrawList()->AddRectFilled({left, corner.y},
                                              {left + width / kSteps + 1, corner.y + height},
                                              IM_COL32(colour.r, colour.g, colour.b, 255));
  }
  ImGui::Dummy({width, height});
  char low[32], high[32];
  std::snprintf(low, sizeof low, "-%.3g too dark", full);
  std::snprintf(high, sizeof high, "too bright +%.3g", full);
  ImGui::TextDisabled("%s", low);
  ImGui::SameLine(width - ImGui::CalcTextSize(high).x);
  ImGui::TextDisabled("%s", high);
}

void about(const std::vector<TechniqueChoice>& techniques, const std::string& id) {
  const auto found = std::ranges::find(techniques, id, &TechniqueChoice::id);
  if (found == techniques.end()) return;
  help(found->summary + (found->paper.empty() ? "" : ". After " + found->paper));
  if (!found->guarantees.empty()) help("Holds: " + found->guarantees);
  if (!found->failures.empty()) help("Fails: " + found->failures);
}
}  // namespace

void shadowPanel(PanelInput& in) {
  View& view = in.state.view;
  techniqueList(in, "##technique", "technique", view.technique);
  about(in.picture.techniques(), view.technique);
  heading("Show");
  if (namedRadio(in, "lit colours", "show/shaded", in.state.showing == Showing::shaded))
    in.state.showing = Showing::shaded;
  ImGui::SameLine();
  if (namedRadio(in, "visibility", "show/visibility", in.state.showing == Showing::visibility))
    in.state.showing = Showing::visibility;
  heading("Settings of this technique");
  bool any = false;
  for (const SettingChoice& setting : in.picture.settings()) {
    if (setting.key.find('.') == std::string::npos || !isOf(setting, view.technique)) continue;
    settingRow(in, setting);
    any = true;
  }
  if (!any) help("none");
  heading("Settings of all that use them");
  for (const SettingChoice& setting : in.picture.settings()) {
    if (setting.key.find('.') == std::string::npos) settingRow(in, setting);
  }
}

void comparePanel(PanelInput& in) {
  UiState& state = in.state;
  constexpr std::pair<const char*, Compare> kWays[] = {
      {"nothing", Compare::off}, {"a technique", Compare::technique}, {"truth", Compare::truth}};
  ImGui::TextUnformatted("Beside it");
  for (const auto& [label, way] : kWays) {
    if (way != Compare::off) ImGui::SameLine();
    if (namedRadio(in, label, std::string("compare/") + label, state.compare == way)) state.compare = way;
  }
  if (state.compare == Compare::technique) {
    techniqueList(in, "##other", "other", state.otherTechnique);
    about(in.picture.techniques(), state.otherTechnique);
  }
  if (state.compare != Compare::off) help("Drag the line in the picture.");
  if (state.compare == Compare::truth)
    help("Truth is visibility of the first light, so both sides show that.");
  heading("Error");
  namedCheckbox(in, "Map of the error against truth", "heat-map", state.heatMap);
  if (state.heatMap) {
    float full = static_cast<float>(state.heatFull);
    ImGui::SetNextItemWidth(-5.0f * ImGui::GetFontSize());
    if (ImGui::SliderFloat("full scale", &full, 0.005f, 1.0f, "%.3f", ImGuiSliderFlags_Logarithmic))
      state.heatFull = static_cast<double>(full);
    in.controls.mark("heat-scale");
    errorScale(state.heatFull);
  }
  if (in.error) {
    ImGui::Text("RMSE %.4f   p99 %.4f   bias %+.4f", in.error->rmse, in.error->p99, in.error->bias);
    help("over all receivers in the picture");
  }
  const TruthWorker::State truth = in.truth.state();
  if (!truth.error.empty()) {
    ImGui::TextWrapped("%s", truth.error.c_str());
  } else if (state.compare == Compare::truth || state.heatMap) {
    ImGui::ProgressBar(static_cast<float>(truth.done ? 1.0 : truth.share));
    const auto image = in.truth.image();
    char text[120];
    std::snprintf(text, sizeof text, "%d samples a pixel%s; noise below %.4f", image ? image->samples : 0,
                  truth.done ? "" : ", tracing", image ? image->noiseAtMost : 1.0);
    help(text);
  }
  heading("Magnifier");
  namedCheckbox(in, "Pixels under the pointer", "magnifier", state.magnifier);
}

}  // namespace halfshadow::viewer
