// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

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

/// Since the process was begun, loading of libraries included; to a hundredth of a second.
double processAgeMs() {
  std::ifstream file("/proc/self/stat");
  std::string text;
  std::getline(file, text);
  // The program's name, in parentheses, may hold anything; the start stands 20 words behind it.
  std::istringstream words(text.substr(text.rfind(')') + 1));
  std::string word;
  for (int i = 0; i < 20; ++i) words >> word;
  timespec now{};
  clock_gettime(CLOCK_BOOTTIME, &now);
  const double startSeconds = std::strtod(word.c_str(), nullptr) / static_cast<double>(sysconf(_SC_CLK_TCK));
  return 1e3 * (static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec) - startSeconds);
}

double medianMs(const std::vector<float>& values) {
  return measure::timeStatistics(std::vector<double>(values.begin(), values.end())).medianMs;
}
}  // namespace

void App::noteFrame(double beganSeconds) {
  if (firstPictureMs_ == 0.0) {
    picture_->engine().finish();
    firstPictureMs_ = processAgeMs();
  }
  if (measuresFrame_) {
    picture_->engine().finish();
    const double windowMs = 1e3 * (window_->timeSeconds() - beganSeconds);
    times_.add(picture_->facts().cpuMs, picture_->facts().totalMs, windowMs);
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
                                       {"timed_frames", times_.count()},
                                       {"engine_frame_ms", medianMs(times_.total())},
                                       {"window_frame_ms", medianMs(times_.window())},
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
