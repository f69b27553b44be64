// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// What the viewer remembers, and what it makes of a file that someone else wrote.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "viewer/remembered.hpp"

namespace halfshadow::viewer {
namespace {

class RememberedTest : public testing::Test {
 protected:
  RememberedTest() {
    std::string name = (std::filesystem::temp_directory_path() / "halfshadow-viewer-XXXXXX").string();
    EXPECT_NE(mkdtemp(name.data()), nullptr);
    folder_ = name;
  }
  ~RememberedTest() override { std::filesystem::remove_all(folder_); }
  std::string path() const { return (folder_ / "new folder" / "viewer.json").string(); }
  std::filesystem::path folder_;
};

TEST_F(RememberedTest, ComesBackAsItWas) {
  const Remembered remembered{.windowWidth = 960,
                              .windowHeight = 600,
                              .windowX = -20,
                              .windowY = 40,
                              .source = "builtin:leaves",
                              .technique = "wedges",
                              .choices = {{"map_size", "512"}},
                              .tab = "Cost",
                              .showsHandles = false};
  ASSERT_TRUE(writeRemembered(path(), remembered).ok());
  const Remembered read = readRemembered(path());
  EXPECT_EQ(read.windowWidth, 960);
  EXPECT_EQ(read.windowHeight, 600);
  EXPECT_EQ(read.windowX, -20);
  EXPECT_EQ(read.windowY, 40);
  EXPECT_EQ(read.source, "builtin:leaves");
  EXPECT_EQ(read.technique, "wedges");
  EXPECT_EQ(read.choices, remembered.choices);
  EXPECT_EQ(read.tab, "Cost");
  EXPECT_FALSE(read.showsHandles);
}

TEST_F(RememberedTest, NoFileKeepsTheViewerFromStarting) {
  std::filesystem::create_directories(folder_ / "new folder");
  for (const char* text :
       {"", "[1, 2]", "{", R"({"window_width": "wide", "settings": 3, "tab": null})",
        R"({"window_width": 1, "window_height": -5})", R"({"settings": {"map_size": 512}})"}) {
    std::ofstream(path()) << text;
    const Remembered read = readRemembered(path());
    EXPECT_EQ(read.windowWidth, 1280) << text;
    EXPECT_EQ(read.windowHeight, 720) << text;
    EXPECT_EQ(read.tab, "Scene") << text;
    EXPECT_TRUE(read.choices.empty()) << text;
  }
  EXPECT_EQ(readRemembered("/no/such/file").windowWidth, 1280);
}

TEST_F(RememberedTest, SaysWhereItCannotWrite) {
  std::ofstream(folder_ / "new folder") << "a file";
  EXPECT_FALSE(writeRemembered(path(), {}).ok());
}

}  // namespace
}  // namespace halfshadow::viewer
