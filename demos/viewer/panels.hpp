// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// The panels beside the picture. Each draws itself with what it is given and keeps nothing.
#pragma once

#include "viewer/controls.hpp"
#include "viewer/frame_times.hpp"
#include "viewer/picture.hpp"
#include "viewer/truth_worker.hpp"
#include "viewer/ui_state.hpp"

namespace halfshadow::viewer {

struct PanelInput {
  UiState& state;
  Requests& requests;
  Controls& controls;
  Picture& picture;
  const TruthWorker& truth;
  const FrameTimes& times;
  std::optional<metrics::ErrorStatistics> error;  ///< of the heat map that is shown
};

void scenePanel(PanelInput& in);
void shadowPanel(PanelInput& in);
void comparePanel(PanelInput& in);
void insidePanel(PanelInput& in);
void costPanel(PanelInput& in);
void devicePanel(PanelInput& in);
void keepPanel(PanelInput& in);
/// The list of keys, over everything.
void keysWindow(PanelInput& in);

/// Width of the text column that all panels share, in pixels.
float panelWidth();

// Widgets that have a name for scripts.
bool namedButton(PanelInput& in, const char* label, const std::string& name);
bool namedCheckbox(PanelInput& in, const char* label, const std::string& name, bool& value);
bool namedRadio(PanelInput& in, const char* label, const std::string& name, bool chosen);
void help(const std::string& text);  ///< grey, wrapped
void heading(const char* text);

/// "1.25 MiB".
std::string byteText(std::uint64_t bytes);

}  // namespace halfshadow::viewer
