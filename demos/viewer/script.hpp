// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// Scripts: what a person would do with mouse and keyboard, a line each, played one event a frame.
#pragma once

#include <deque>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "base/error.hpp"
#include "viewer/input_event.hpp"

namespace halfshadow::viewer {

/// One line of a script. What each takes is in kScriptHelp.
struct ScriptLine {
  int number = 0;  ///< from 1
  std::string verb;
  std::vector<std::string> words;
  std::string rest;  ///< of the line behind the verb
};

extern const char* const kScriptHelp;

/// Empty lines and those that begin with # are left out. Errors: fileNotFound; fileMalformed (the line's
/// number, the word, and what is allowed).
Result<std::vector<ScriptLine>> readScript(const std::string& path);
Result<std::vector<ScriptLine>> parseScript(const std::string& text, const std::string& name);

struct Place {
  double x = 0.0, y = 0.0;
};

/// What a script acts on.
class Stage {
 public:
  virtual ~Stage() = default;
  /// The middle of a named control, of the last frame; nothing when it was not drawn. Asks for it to be
  /// scrolled into view.
  virtual std::optional<Place> find(const std::string& name) = 0;
  virtual void send(const InputEvent& event) = 0;
  virtual void resize(int width, int height) = 0;
  virtual void minimise() = 0;
  virtual void restore() = 0;
  /// The window with its panels, as PNG; the text of the clipboard; the picture alone. Written when the frame
  /// is done.
  virtual Status writeScreenshot(const std::string& path) = 0;
  virtual Status writeClipboard(const std::string& path) = 0;
  virtual Status writePicture(const std::string& path) = 0;
  /// Whether background work (truth) is done.
  virtual bool isSettled() const = 0;
  /// One number about the process or the frame: see kScriptHelp.
  virtual std::optional<double> value(const std::string& name) = 0;
};

class ScriptPlayer {
 public:
  explicit ScriptPlayer(std::vector<ScriptLine> lines);
  /// Once a frame, before the frame is drawn. Errors: fileMalformed when a named control does not appear
  /// within 60 frames, or an expectation is not met.
  Status step(Stage& stage);
  bool isDone() const { return next_ >= lines_.size() && pending_.empty() && waitFrames_ == 0; }

 private:
  Status begin(const ScriptLine& line, Stage& stage);
  Status pointer(const ScriptLine& line, const Place& from);
  Status files(const ScriptLine& line, Stage& stage);
  Status expect(const ScriptLine& line, Stage& stage);
  void move(const Place& place);
  void button(int code, bool pressed, int modifiers);
  void key(const std::string& name, int modifiers);
  void releaseModifiers(int modifiers);

  std::vector<ScriptLine> lines_;
  std::size_t next_ = 0;
  std::deque<InputEvent> pending_;
  int waitFrames_ = 0;
  int searched_ = 0;  ///< frames in which the next line's control was not found
  Place pointer_;
};

}  // namespace halfshadow::viewer
