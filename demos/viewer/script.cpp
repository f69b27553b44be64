// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "viewer/script.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>
#include <map>
#include <sstream>

namespace halfshadow::viewer {

const char* const kScriptHelp =
    "Scripts play one line after the other, one event a frame; # begins a comment. Places are window "
    "coordinates from the top left, or names of controls (tab/Technique, technique, technique/pcf, "
    "setting/pcf.size, ...; --list-controls FILE writes those that were drawn):\n"
    "  wait FRAMES              settle (background truth)     move PLACE\n"
    "  click PLACE [MODS]       right PLACE                   scroll PLACE STEPS\n"
    "  drag PLACE DX DY [left|right|middle] [MODS]            key NAME [MODS]\n"
    "  type TEXT                drop FILE                     resize WIDTH HEIGHT\n"
    "  minimise                 restore                       screenshot FILE.png\n"
    "  picture FILE.png         clipboard FILE                expect VALUE LOW HIGH\n"
    "  until VALUE LOW HIGH (waits for it, 20000 frames at most)\n"
    "PLACE is X,Y or a name; MODS are shift, ctrl, alt joined by +; keys are letters, digits, ?, space, "
    "escape, "
    "enter, tab, backspace, delete, left, right, up, down. Values: rmse, p99 (of the heat map), gl-errors, "
    "frames, memory-mib, message (1 while an error is shown), lights, drawn (frames of the engine), reloads, "
    "objects, width, height, ms.";

namespace {
struct Verb {
  std::size_t least, most;
  bool atPlace;
};

const std::map<std::string, Verb>& verbs() {
  static const std::map<std::string, Verb> kVerbs = {
      {"wait", {1, 1, false}},       {"settle", {0, 0, false}},      {"move", {1, 1, true}},
      {"click", {1, 2, true}},       {"right", {1, 2, true}},        {"scroll", {2, 2, true}},
      {"drag", {3, 5, true}},        {"key", {1, 2, false}},         {"type", {1, 99, false}},
      {"drop", {1, 99, false}},      {"resize", {2, 2, false}},      {"minimise", {0, 0, false}},
      {"restore", {0, 0, false}},    {"screenshot", {1, 99, false}}, {"picture", {1, 99, false}},
      {"clipboard", {1, 99, false}}, {"expect", {3, 3, false}},      {"until", {3, 3, false}}};
  return kVerbs;
}

std::optional<double> number(const std::string& text) {
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(value)) return std::nullopt;
  return value;
}

std::optional<Place> placeFromText(const std::string& text) {
  const std::size_t comma = text.find(',');
  if (comma == std::string::npos) return std::nullopt;
  const auto x = number(text.substr(0, comma)), y = number(text.substr(comma + 1));
  if (!x || !y) return std::nullopt;
  return Place{*x, *y};
}

Error problem(const ScriptLine& line, const std::string& text) {
  return {ErrorCode::fileMalformed, "script line " + std::to_string(line.number) + ": \"" + line.verb +
                                        (line.rest.empty() ? "" : " " + line.rest) + "\": " + text};
}

int modifiersOf(const std::string& text) {
  int modifiers = 0;
  std::stringstream words(text);
  for (std::string word; std::getline(words, word, '+');) {
    if (word == "shift") modifiers |= 1;
    if (word == "ctrl") modifiers |= 2;
    if (word == "alt") modifiers |= 4;
  }
  return modifiers;
}

int keyCode(const std::string& name) {
  static const std::map<std::string, int> kNamed = {
      {"space", 32},  {"escape", 256}, {"enter", 257}, {"tab", 258}, {"backspace", 259}, {"delete", 261},
      {"right", 262}, {"left", 263},   {"down", 264},  {"up", 265},  {"?", '/'}};
  if (const auto found = kNamed.find(name); found != kNamed.end()) return found->second;
  if (name.size() == 1 && name[0] >= 'a' && name[0] <= 'z') return name[0] - 'a' + 'A';
  if (name.size() == 1 && name[0] > ' ' && name[0] < 127) return name[0];
  return -1;
}

Status checkLine(const ScriptLine& line) {
  const auto verb = verbs().find(line.verb);
  if (verb == verbs().end()) {
    std::string list;
    for (const auto& [name, unused] : verbs()) list += (list.empty() ? "" : ", ") + name;
    return problem(line, "there is no such command; give one of " + list);
  }
  if (line.words.size() < verb->second.least || line.words.size() > verb->second.most) {
    return problem(line, "takes " + std::to_string(verb->second.least) + " to " +
                             std::to_string(verb->second.most) + " words; see --help");
  }
  const auto numeric = [&](std::size_t first, std::size_t count) {
    for (std::size_t i = first; i < first + count; ++i) {
      if (!number(line.words[i])) return false;
    }
    return true;
  };
  const bool numbers = line.verb == "wait"                             ? numeric(0, 1)
                       : line.verb == "resize"                         ? numeric(0, 2)
                       : line.verb == "scroll"                         ? numeric(1, 1)
                       : line.verb == "drag"                           ? numeric(1, 2)
                       : line.verb == "expect" || line.verb == "until" ? numeric(1, 2)
                                                                       : true;
  if (!numbers) return problem(line, "a number is missing; see --help");
  if (line.verb == "key" && keyCode(line.words[0]) < 0)
    return problem(line, "there is no such key; see --help");
  return {};
}
}  // namespace

Result<std::vector<ScriptLine>> parseScript(const std::string& text, const std::string& name) {
  std::vector<ScriptLine> lines;
  std::stringstream stream(text);
  int count = 0;
  for (std::string source; std::getline(stream, source);) {
    ScriptLine line{.number = ++count};
    std::stringstream words(source);
    if (!(words >> line.verb) || line.verb.front() == '#') continue;
    std::getline(words >> std::ws, line.rest);
    std::stringstream rest(line.rest);
    for (std::string word; rest >> word;) line.words.push_back(word);
    if (Status status = checkLine(line); !status)
      return Error{status.error().code, name + ": " + status.error().message};
    lines.push_back(std::move(line));
  }
  return lines;
}

Result<std::vector<ScriptLine>> readScript(const std::string& path) {
  std::ifstream file(path);
  if (!file) return Error{ErrorCode::fileNotFound, path + ": the script cannot be read; check the path"};
  std::stringstream text;
  text << file.rdbuf();
  return parseScript(text.str(), path);
}

ScriptPlayer::ScriptPlayer(std::vector<ScriptLine> lines) : lines_(std::move(lines)) {}

void ScriptPlayer::move(const Place& place) {
  pending_.push_back({.kind = InputEvent::Kind::move, .x = place.x, .y = place.y});
  pointer_ = place;
}

void ScriptPlayer::button(int code, bool pressed, int modifiers) {
  pending_.push_back(
      {.kind = InputEvent::Kind::button, .code = code, .pressed = pressed, .modifiers = modifiers});
}

void ScriptPlayer::key(const std::string& name, int modifiers) {
  if (name == "?") modifiers |= 1;
  for (const bool pressed : {true, false}) {
    pending_.push_back(
        {.kind = InputEvent::Kind::key, .code = keyCode(name), .pressed = pressed, .modifiers = modifiers});
  }
  releaseModifiers(modifiers);
}

void ScriptPlayer::releaseModifiers(int modifiers) {
  constexpr int kLeftControl = 341;
  if (modifiers != 0) pending_.push_back({.kind = InputEvent::Kind::key, .code = kLeftControl});
}

Status ScriptPlayer::pointer(const ScriptLine& line, const Place& from) {
  move(from);
  if (line.verb == "scroll") {
    pending_.push_back({.kind = InputEvent::Kind::scroll, .y = *number(line.words[1])});
    return {};
  }
  if (line.verb == "move") return {};
  if (line.verb != "drag") {
    const int modifiers = line.words.size() > 1 ? modifiersOf(line.words[1]) : 0;
    const int code = line.verb == "right" ? 1 : 0;
    button(code, true, modifiers);
    button(code, false, modifiers);
    releaseModifiers(modifiers);
    return {};
  }
  // As a hand drags: in steps, held at the end.
  constexpr int kSteps = 6;
  const std::string which = line.words.size() > 3 ? line.words[3] : "left";
  const int code = which == "right" ? 1 : which == "middle" ? 2 : 0;
  const int modifiers = line.words.size() > 4 ? modifiersOf(line.words[4]) : 0;
  const double dx = *number(line.words[1]), dy = *number(line.words[2]);
  button(code, true, modifiers);
  for (int i = 1; i <= kSteps; ++i) move({from.x + dx * i / kSteps, from.y + dy * i / kSteps});
  button(code, false, modifiers);
  releaseModifiers(modifiers);
  return {};
}

Status ScriptPlayer::files(const ScriptLine& line, Stage& stage) {
  Status status;
  if (line.verb == "screenshot") status = stage.writeScreenshot(line.rest);
  if (line.verb == "picture") status = stage.writePicture(line.rest);
  if (line.verb == "clipboard") status = stage.writeClipboard(line.rest);
  return status ? status : Status(problem(line, status.error().message));
}

Status ScriptPlayer::expect(const ScriptLine& line, Stage& stage) {
  const auto value = stage.value(line.words[0]);
  if (!value) return problem(line, "there is no such value; see --help");
  if (*value >= *number(line.words[1]) && *value <= *number(line.words[2])) return {};
  return problem(line, line.words[0] + " is " + std::to_string(*value));
}

Status ScriptPlayer::begin(const ScriptLine& line, Stage& stage) {
  if (line.verb == "wait") waitFrames_ = static_cast<int>(*number(line.words[0]));
  if (line.verb == "resize")
    stage.resize(static_cast<int>(*number(line.words[0])), static_cast<int>(*number(line.words[1])));
  if (line.verb == "minimise") stage.minimise();
  if (line.verb == "restore") stage.restore();
  if (line.verb == "drop") pending_.push_back({.kind = InputEvent::Kind::drop, .paths = {line.rest}});
  if (line.verb == "key") key(line.words[0], line.words.size() > 1 ? modifiersOf(line.words[1]) : 0);
  if (line.verb == "type") {
    for (const char c : line.rest)
      pending_.push_back({.kind = InputEvent::Kind::text, .codepoint = static_cast<unsigned char>(c)});
  }
  if (line.verb == "expect") return expect(line, stage);
  return files(line, stage);
}

Status ScriptPlayer::step(Stage& stage) {
  constexpr int kSearchFrames = 60;
  if (!pending_.empty()) {
    stage.send(pending_.front());
    pending_.pop_front();
    return {};
  }
  if (waitFrames_ > 0) {
    --waitFrames_;
    return {};
  }
  if (next_ >= lines_.size()) return {};
  const ScriptLine& line = lines_[next_];
  if (line.verb == "settle" && !stage.isSettled()) return {};
  if (line.verb == "until") {
    constexpr int kMostFrames = 20000;
    const Status met = expect(line, stage);
    if (!met && stage.value(line.words[0]) && ++searched_ < kMostFrames) return {};
    searched_ = 0;
    ++next_;
    return met;
  }
  if (verbs().at(line.verb).atPlace) {
    auto place = placeFromText(line.words[0]);
    if (!place) place = stage.find(line.words[0]);
    if (!place) {
      return ++searched_ < kSearchFrames
                 ? Status{}
                 : Status(problem(line, "no control of that name is drawn; --list-controls lists them"));
    }
    searched_ = 0;
    ++next_;
    return pointer(line, *place);
  }
  ++next_;
  return begin(line, stage);
}

}  // namespace halfshadow::viewer
