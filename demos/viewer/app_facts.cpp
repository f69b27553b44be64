// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include <unistd.h>

#include <cstdio>
#include <fstream>
#include <nlohmann/json.hpp>

#include "measure/text_file.hpp"
#include "viewer/app.hpp"

namespace halfshadow::viewer {
namespace {
/// Frames after which all that is kept between frames is there.
constexpr std::uint64_t kEarlyFrame = 200;

std::uint64_t residentBytes() {
  std::ifstream file("/proc/self/statm");
  std::uint64_t all = 0, resident = 0;
  file >> all >> resident;
  return resident * static_cast<std::uint64_t>(sysconf(_SC_PAGESIZE));
}
}  // namespace

void App::noteFrame() {
  if (firstPictureMs_ == 0.0) {
    picture_->engine().finish();
    firstPictureMs_ =
        std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - started_).count();
  }
  if (frames_ != kEarlyFrame) return;
  earlyResidentBytes_ = residentBytes();
  earlyObjects_ = picture_->engine().liveObjectCount();
}

Status App::writeFacts() {
  if (options_.json.empty()) return {};
  const FrameFacts& facts = picture_->facts();
  const View& view = state_.view;
  const nlohmann::ordered_json json = {{"frames", frames_},
                                       {"drawn", drawn_},
                                       {"gl_errors", glErrors_},
                                       {"first_picture_ms", firstPictureMs_},
                                       {"slowest_switch_ms", slowestSwitchMs_},
                                       {"resident_bytes_at_frame_200", earlyResidentBytes_},
                                       {"resident_bytes", residentBytes()},
                                       {"gl_objects_at_frame_200", earlyObjects_},
                                       {"gl_objects", picture_->engine().liveObjectCount()},
                                       {"memory_bytes", facts.memoryBytes},
                                       {"scene", view.source},
                                       {"technique", view.technique},
                                       {"size", {view.width, view.height}},
                                       {"context", window_->contextName()},
                                       {"renderer", picture_->engine().driver().renderer},
                                       {"message", state_.message},
                                       {"command", commandLine(view, "halfshadow render", "-o picture.png")}};
  const std::string text = json.dump(2) + "\n";
  if (options_.json != "-") return measure::writeTextFile(options_.json, text);
  std::fputs(text.c_str(), stdout);
  return {};
}

}  // namespace halfshadow::viewer
