// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// Scripts do what hands do, one event a frame, and say which line is wrong.
#include <gtest/gtest.h>

#include <map>

#include "viewer/script.hpp"

namespace halfshadow::viewer {
namespace {

class RecordingStage final : public Stage {
 public:
  std::map<std::string, Place> controls;
  std::vector<InputEvent> events;
  std::vector<std::string> done;
  bool settled = true;

  std::optional<Place> find(const std::string& name) override {
    const auto found = controls.find(name);
    return found == controls.end() ? std::nullopt : std::optional(found->second);
  }
  void send(const InputEvent& event) override { events.push_back(event); }
  void resize(int width, int height) override {
    done.push_back("resize " + std::to_string(width) + "x" + std::to_string(height));
  }
  void minimise() override { done.push_back("minimise"); }
  void restore() override { done.push_back("restore"); }
  Status writeScreenshot(const std::string& path) override { return note("screenshot " + path); }
  Status writeClipboard(const std::string& path) override { return note("clipboard " + path); }
  Status writePicture(const std::string& path) override { return note("picture " + path); }
  bool isSettled() const override { return settled; }
  std::optional<double> value(const std::string& name) override {
    return name == "frames" ? std::optional(7.0) : std::nullopt;
  }

 private:
  Status note(const std::string& text) {
    done.push_back(text);
    return {};
  }
};

ScriptPlayer playerOf(const std::string& text) {
  return ScriptPlayer(parseScript(text, "test").value());
}

/// Frames until the end; -1 when it does not end.
int play(ScriptPlayer& player, Stage& stage, int most = 500) {
  for (int frame = 0; frame < most; ++frame) {
    if (player.isDone()) return frame;
    const Status status = player.step(stage);
    EXPECT_TRUE(status.ok()) << status.error().message;
    if (!status) return -1;
  }
  return -1;
}

TEST(Script, AClickMovesPressesAndReleases) {
  RecordingStage stage;
  stage.controls["ok"] = {30, 40};
  ScriptPlayer player = playerOf("# a comment\n\nclick ok\n");
  ASSERT_GT(play(player, stage), 0);
  ASSERT_EQ(stage.events.size(), 3u);
  EXPECT_EQ(stage.events[0].kind, InputEvent::Kind::move);
  EXPECT_EQ(stage.events[0].x, 30);
  EXPECT_TRUE(stage.events[1].pressed);
  EXPECT_FALSE(stage.events[2].pressed);
}

TEST(Script, ADragHoldsTheButtonAllTheWay) {
  RecordingStage stage;
  ScriptPlayer player = playerOf("drag 10,20 60 -30 right\n");
  ASSERT_GT(play(player, stage), 0);
  ASSERT_GE(stage.events.size(), 4u);
  EXPECT_EQ(stage.events[1].kind, InputEvent::Kind::button);
  EXPECT_EQ(stage.events[1].code, 1);
  EXPECT_EQ(stage.events[stage.events.size() - 2].x, 70);
  EXPECT_EQ(stage.events[stage.events.size() - 2].y, -10);
  EXPECT_FALSE(stage.events.back().pressed);
}

TEST(Script, WaitsForControlsAndForTheBackground) {
  RecordingStage stage;
  stage.settled = false;
  ScriptPlayer player = playerOf("settle\nclick late\n");
  for (int i = 0; i < 5; ++i) ASSERT_TRUE(player.step(stage).ok());
  EXPECT_TRUE(stage.events.empty());
  stage.settled = true;
  for (int i = 0; i < 5; ++i) ASSERT_TRUE(player.step(stage).ok());
  EXPECT_TRUE(stage.events.empty());
  stage.controls["late"] = {1, 2};
  EXPECT_GT(play(player, stage), 0);
  EXPECT_EQ(stage.events.size(), 3u);
}

TEST(Script, AControlThatNeverComesIsAnErrorOfItsLine) {
  RecordingStage stage;
  ScriptPlayer player = playerOf("wait 1\nclick nowhere\n");
  Status status;
  for (int i = 0; i < 200 && status.ok(); ++i) status = player.step(stage);
  ASSERT_FALSE(status.ok());
  EXPECT_NE(status.error().message.find("line 2"), std::string::npos) << status.error().message;
}

TEST(Script, ExpectationsAreKeptOrNamed) {
  RecordingStage stage;
  ScriptPlayer good = playerOf("expect frames 7 7\n"), bad = playerOf("expect frames 8 9\n");
  EXPECT_TRUE(good.step(stage).ok());
  EXPECT_FALSE(bad.step(stage).ok());
}

TEST(Script, FilesHaveNamesWithSpaces) {
  RecordingStage stage;
  ScriptPlayer player =
      playerOf("drop my model.glb\nresize 300 200\nscreenshot a b.png\nminimise\nrestore\n");
  ASSERT_GT(play(player, stage), 0);
  ASSERT_EQ(stage.events.size(), 1u);
  EXPECT_EQ(stage.events[0].paths, std::vector<std::string>{"my model.glb"});
  EXPECT_EQ(stage.done,
            (std::vector<std::string>{"resize 300x200", "screenshot a b.png", "minimise", "restore"}));
}

TEST(Script, WrongLinesAreRefusedBeforeAnythingIsPlayed) {
  for (const char* text : {"jump 3\n", "click\n", "wait soon\n", "resize 3\n", "drag 1,1 2\n", "key hyper\n",
                           "expect frames low high\n", "scroll 1,1 up\n"}) {
    const auto lines = parseScript(std::string("wait 1\n") + text, "wrong.txt");
    ASSERT_FALSE(lines.ok()) << text;
    EXPECT_NE(lines.error().message.find("wrong.txt"), std::string::npos);
    EXPECT_NE(lines.error().message.find("line 2"), std::string::npos) << lines.error().message;
  }
  EXPECT_FALSE(readScript("no such script").ok());
}

}  // namespace
}  // namespace halfshadow::viewer
