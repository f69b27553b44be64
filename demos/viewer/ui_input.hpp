// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// Input events for Dear ImGui.
#pragma once

#include <deque>
#include <vector>

#include "viewer/input_event.hpp"
#include "window/window.hpp"

namespace halfshadow::viewer {

/// Waits between events and frames: a press and its release never fall into one frame, where neither would be
/// seen.
class EventQueue {
 public:
  void push(InputEvent event) { events_.push_back(std::move(event)); }
  bool empty() const { return events_.empty(); }
  /// The events of the next frame.
  std::vector<InputEvent> take();

 private:
  std::deque<InputEvent> events_;
};

/// Keys and clipboard of the current ImGui context.
void connectUi(Window& window);
void feedUi(const InputEvent& event);
/// The window's events into the queue, which must outlive it.
WindowCallbacks callbacksInto(EventQueue& queue);

}  // namespace halfshadow::viewer
