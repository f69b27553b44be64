// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include <imgui.h>

#include <algorithm>

#include "viewer/overlay.hpp"
#include "viewer/panels.hpp"

namespace halfshadow::viewer {
namespace {
bool isDepth(const ImageRecord& image) {
  return std::string(image.format).starts_with("depth");
}

/// What the bytes of a colour image are shown as.
constexpr std::pair<const char*, Shown> kWays[] = {{"colour", Shown::opaque},
                                                   {"red", Shown::red},
                                                   {"alpha", Shown::alpha},
                                                   {"2 bytes", Shown::word},
                                                   {"3 bytes", Shown::packed24}};

void show(PanelInput& in, const ImageRecord& image) {
  Shown way = Shown::red;
  if (!isDepth(image)) {
    way = static_cast<Shown>(in.state.imageWay);
    int count = 0;
    for (const auto& [label, choice] : kWays) {
      if (count++ % 3 != 0) ImGui::SameLine();
      if (namedRadio(in, label, std::string("inside/as/") + label, way == choice))
        in.state.imageWay = static_cast<int>(choice);
    }
  }
  const float width = ImGui::GetContentRegionAvail().x;
  const float height = width * static_cast<float>(image.height) / static_cast<float>(image.width);
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  // Long lists become tall: as much of them as is wide, from the first row.
  const float shownHeight = std::clamp(height, 2 * ImGui::GetFontSize(), 3 * width);
  const float bottom = 1.0f - std::min(shownHeight / std::max(height, 1.0f), 1.0f);
  ImGui::Image(imageId(image.texture, way), {width, shownHeight}, {0, 1}, {1, bottom});
  in.controls.mark("inside/image");
  if (!ImGui::IsItemHovered()) return;
  const ImVec2 mouse = ImGui::GetIO().MousePos;
  const float u = (mouse.x - corner.x) / width;
  const float v = 1.0f - (mouse.y - corner.y) / shownHeight * (1.0f - bottom);
  const float half = 8.0f / static_cast<float>(image.width);
  const float halfV = 8.0f / static_cast<float>(image.height);
  ImGui::BeginTooltip();
  ImGui::Text("texel %d, %d", static_cast<int>(u * static_cast<float>(image.width)),
              static_cast<int>(v * static_cast<float>(image.height)));
  const float side = 12 * ImGui::GetFontSize();
  ImGui::Image(imageId(image.texture, way), {side, side}, {u - half, v + halfV}, {u + half, v - halfV});
  ImGui::EndTooltip();
}
}  // namespace

void insidePanel(PanelInput& in) {
  heading("Lines in the picture");
  namedCheckbox(in, "Silhouettes seen from the light", "inside/silhouettes", in.state.showsSilhouettes);
  namedCheckbox(in, "Wedges: shadows of the light's corners", "inside/wedges", in.state.showsWedges);
  if (namedButton(in, in.state.seenFromLight ? "Back to the camera" : "See from the light",
                  "inside/from-light"))
    in.requests.toggleLightView = true;
  heading("Images of the last frame");
  const Engine& engine = in.picture.engine();
  std::vector<ImageRecord> images(engine.images(nullptr, 0));
  engine.images(images.data(), images.size());
  std::erase_if(images, [&](const ImageRecord& image) { return image.texture == in.picture.texture(); });
  if (images.empty()) {
    help("This technique keeps nothing in images.");
    return;
  }
  auto chosen = std::ranges::find_if(images, [&](const ImageRecord& i) { return in.state.image == i.name; });
  if (chosen == images.end()) chosen = images.begin();
  ImGui::SetNextItemWidth(-1);
  const bool isOpen = ImGui::BeginCombo("##image", chosen->name, ImGuiComboFlags_HeightLarge);
  in.controls.mark("inside/images");
  if (isOpen) {
    for (const ImageRecord& image : images) {
      ImGui::PushID(static_cast<int>(image.texture));
      if (ImGui::Selectable(image.name, &image == &*chosen)) in.state.image = image.name;
      ImGui::PopID();
      in.controls.mark(std::string("inside/images/") + image.name);
    }
    ImGui::EndCombo();
  }
  help(std::to_string(chosen->width) + " x " + std::to_string(chosen->height) + " texels, " + chosen->format);
  show(in, *chosen);
}

}  // namespace halfshadow::viewer
