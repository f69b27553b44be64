// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include <imgui.h>

#include <algorithm>
#include <cstdio>

#include "viewer/panels.hpp"

namespace halfshadow::viewer {
namespace {
void graph(PanelInput& in) {
  const std::vector<float> cpu = in.times.cpu(), total = in.times.total();
  if (total.empty()) {
    help("Frames are timed while \"Measure\" is on.");
    return;
  }
  const auto statistics = [](const std::vector<float>& values) {
    return measure::timeStatistics(std::vector<double>(values.begin(), values.end()));
  };
  const measure::TimeStatistics all = statistics(total), cpuOnly = statistics(cpu),
                                window = statistics(in.times.window());
  const float top = 1.2f * static_cast<float>(std::max(all.p95Ms, 0.1));
  ImGui::SetNextItemWidth(-1);
  ImGui::PlotLines("##frames", total.data(), static_cast<int>(total.size()), 0, nullptr, 0.0f, top,
                   {0, 5 * ImGui::GetFontSize()});
  in.controls.mark("cost/graph");
  ImGui::Text("frame  median %.2f ms   p95 %.2f ms", all.medianMs, all.p95Ms);
  ImGui::Text("CPU    median %.2f ms   p95 %.2f ms", cpuOnly.medianMs, cpuOnly.p95Ms);
  ImGui::Text("window median %.2f ms   p95 %.2f ms", window.medianMs, window.p95Ms);
  char text[160];
  std::snprintf(text, sizeof text,
                "last %d frames; CPU: the engine's; window: with panels and swap; the graph ends at %.1f ms",
                all.frames, static_cast<double>(top));
  help(text);
}

void passTable(const FrameFacts& facts, bool timed) {
  constexpr ImGuiTableFlags kFlags =
      ImGuiTableFlags_RowBg | ImGuiTableFlags_SizingFixedFit | ImGuiTableFlags_ScrollX;
  const float height =
      (static_cast<float>(facts.passes.size()) + 2.5f) * ImGui::GetTextLineHeightWithSpacing();
  if (!ImGui::BeginTable("passes", 7, kFlags, {0, height})) return;
  for (const char* name : {"pass", "ms", "draws", "triangles", "begins", "ends", "stored"})
    ImGui::TableSetupColumn(name);
  ImGui::TableHeadersRow();
  for (const measure::PassMeasurement& pass : facts.passes) {
    ImGui::TableNextRow();
    ImGui::TableNextColumn(), ImGui::TextUnformatted(pass.name.c_str());
    if (ImGui::IsItemHovered()) ImGui::SetTooltip("%s", pass.target.c_str());
    ImGui::TableNextColumn();
    if (timed) ImGui::Text("%.2f", pass.timeMs);
    ImGui::TableNextColumn(), ImGui::Text("%llu", static_cast<unsigned long long>(pass.draws));
    ImGui::TableNextColumn(), ImGui::Text("%llu", static_cast<unsigned long long>(pass.triangles));
    ImGui::TableNextColumn(), ImGui::TextUnformatted(pass.load ? "load" : pass.clear ? "clear" : "-");
    ImGui::TableNextColumn(), ImGui::TextUnformatted(pass.store ? "store" : pass.discard ? "discard" : "-");
    ImGui::TableNextColumn(), ImGui::TextUnformatted(byteText(pass.bytesStored).c_str());
  }
  ImGui::EndTable();
}
}  // namespace

void costPanel(PanelInput& in) {
  namedCheckbox(in, "Measure: draw all of it every frame", "measure", in.state.measures);
  graph(in);
  const FrameFacts& facts = in.picture.facts();
  heading(in.state.measures ? "Passes (every eighth frame, each waited for)" : "Passes of the last frame");
  passTable(facts, in.state.measures);
  heading("Counters");
  const auto row = [](const char* name, const std::string& value) {
    ImGui::TextUnformatted(name);
    ImGui::SameLine(11 * ImGui::GetFontSize());
    ImGui::TextUnformatted(value.c_str());
  };
  row("framebuffer switches", std::to_string(facts.counters.framebufferSwitches));
  row("draws, triangles",
      std::to_string(facts.counters.draws) + ", " + std::to_string(facts.counters.triangles));
  row("loaded, stored", byteText(facts.counters.bytesLoaded) + ", " + byteText(facts.counters.bytesStored));
  row("uploaded", byteText(facts.counters.textureBytesUploaded + facts.counters.bufferBytesUploaded));
  row("memory held", byteText(facts.memoryBytes));
  heading("Left out, and why");
  for (const measure::SkipMeasurement& skip : facts.skips) help(skip.what + ": " + skip.why);
  if (facts.skips.empty()) help("nothing");
  heading("Plan");
  ImGui::BeginChild("plan", {0, 14 * ImGui::GetFontSize()}, true, ImGuiWindowFlags_HorizontalScrollbar);
  ImGui::TextUnformatted(facts.planText.c_str());
  ImGui::EndChild();
}

void devicePanel(PanelInput& in) {
  const DriverRecord driver = in.picture.engine().driver();
  ImGui::TextWrapped("%s", driver.renderer);
  help(std::string(driver.version) + "; depth: " + driver.depthStorage);
  heading("Do as if it lacked");
  std::vector<std::string>& forcedOff = in.state.view.forcedOff;
  for (std::size_t i = 0; i < in.picture.engine().capabilityCount(); ++i) {
    const CapabilityRecord record = in.picture.engine().capability(i);
    const auto place = std::ranges::find(forcedOff, record.name);
    bool isOff = place != forcedOff.end();
    ImGui::BeginDisabled(!record.available && !isOff);
    if (namedCheckbox(in, record.name, std::string("force/") + record.name, isOff)) {
      if (isOff)
        forcedOff.push_back(record.name);
      else
        forcedOff.erase(place);
      in.requests.reopenEngine = true;
    }
    ImGui::EndDisabled();
    help(record.available ? record.text : std::string(record.text) + "; absent: " + record.reason);
  }
}

void keepPanel(PanelInput& in) {
  const View& view = in.state.view;
  if (namedButton(in, "Copy command line (C)", "keep/copy")) in.requests.copyCommand = true;
  help("of `halfshadow render`: it makes exactly this picture.");
  ImGui::BeginChild("command", {0, 9 * ImGui::GetFontSize()}, true);
  ImGui::TextWrapped("%s", commandLine(view, "halfshadow render", "-o picture.png").c_str());
  ImGui::EndChild();
  if (namedButton(in, "Save picture, PNG (P)", "keep/picture")) in.requests.savePicture = true;
  if (namedButton(in, "Save visibility, EXR", "keep/visibility")) in.requests.saveVisibility = true;
  help("into the folder that the viewer was started in, under the first free number.");
  heading("Window");
  help("Size, place, scene, technique and settings are known again at the next start.");
  if (namedButton(in, "Keys (?)", "keep/keys")) in.state.showsKeys = true;
}

void keysWindow(PanelInput& in) {
  if (!in.state.showsKeys) return;
  const ImVec2 size = ImGui::GetIO().DisplaySize;
  ImGui::SetNextWindowPos({size.x / 2, size.y / 2}, ImGuiCond_Always, {0.5f, 0.5f});
  constexpr ImGuiWindowFlags kFlags =
      ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_NoSavedSettings;
  if (ImGui::Begin("Keys", &in.state.showsKeys, kFlags)) {
    constexpr std::pair<const char*, const char*> kKeys[] = {
        {"left drag", "turn round; on a light's handle: move, aim, size it"},
        {"right or middle drag", "move sideways (also shift and left)"},
        {"ctrl and left drag", "the light, round what is looked at"},
        {"wheel", "nearer, farther"},
        {"W A S D, Q E", "fly forward, left, back, right, down, up"},
        {"F", "camera as the scene has it"},
        {"N, B", "next technique, the one before"},
        {"V", "lit colours or visibility"},
        {"T", "truth beside it"},
        {"M", "magnifier"},
        {"L", "light handles"},
        {"space", "play or pause; without an animation: path of the light"},
        {"R", "read the file again"},
        {"C", "copy the command line"},
        {"P", "save the picture"},
        {"H", "panels"},
        {"?", "this list"},
        {"ctrl Q", "end"}};
    for (const auto& [key, what] : kKeys) {
      ImGui::TextUnformatted(key);
      ImGui::SameLine(12 * ImGui::GetFontSize());
      ImGui::TextUnformatted(what);
    }
    if (namedButton(in, "Close", "keys/close")) in.state.showsKeys = false;
  }
  ImGui::End();
}

}  // namespace halfshadow::viewer
