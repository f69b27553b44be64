// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "images/images.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>

namespace halfshadow::images {
namespace {

class Images : public testing::Test {
 protected:
  void SetUp() override {
    folder_ =
        std::filesystem::path(testing::TempDir()) /
        (std::string("halfshadow_images_") + testing::UnitTest::GetInstance()->current_test_info()->name());
    std::filesystem::remove_all(folder_);
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }
  std::ptrdiff_t fileCount() const {
    return std::distance(std::filesystem::directory_iterator(folder_), std::filesystem::directory_iterator());
  }
  std::filesystem::path folder_;
};

TEST_F(Images, ExrKeepsEveryBitAndItsNames) {
  FloatImage image{
      .width = 3, .height = 2, .channels = 1, .pixels = {0.0f, 1e-20f, -1.5f, 1.0f / 3, 70000.0f, 1.0f}};
  ASSERT_TRUE(writeExr(folder_ / "v.exr", image).ok());
  const Result<FloatImage> read = readImage(folder_ / "v.exr");
  ASSERT_TRUE(read.ok()) << read.error().message;
  EXPECT_EQ(read->width, 3);
  EXPECT_EQ(read->height, 2);
  EXPECT_EQ(read->pixels, image.pixels);
  EXPECT_EQ(read->channelIndex("V"), 0);
  EXPECT_EQ(fileCount(), 1) << "no unfinished file is left";
}

TEST_F(Images, ExrOfPositionsKeepsAllChannels) {
  FloatImage image{.width = 1, .height = 2, .channels = 4, .pixels = {1, 2, 3, 0, 4, 5, 6, 1}};
  ASSERT_TRUE(writeExr(folder_ / "p.exr", image).ok());
  const Result<FloatImage> read = readImage(folder_ / "p.exr");
  ASSERT_TRUE(read.ok()) << read.error().message;
  for (const auto& [name, index] :
       {std::pair("R", 0), std::pair("G", 1), std::pair("B", 2), std::pair("A", 3)}) {
    const int channel = read->channelIndex(name);
    ASSERT_GE(channel, 0) << name;
    // Where A = 0 the position must survive: nothing is premultiplied.
    EXPECT_EQ(read->pixels[static_cast<std::size_t>(channel)], image.pixels[static_cast<std::size_t>(index)]);
    EXPECT_EQ(read->pixels[static_cast<std::size_t>(4 + channel)],
              image.pixels[static_cast<std::size_t>(4 + index)]);
  }
}

TEST_F(Images, PngKeepsBytesAndRowOrder) {
  const std::vector<std::uint8_t> pixels{255, 0, 0, 0, 10, 20, 30, 255, 1, 2, 3, 128};
  ASSERT_TRUE(writePng(folder_ / "c.png", 1, 3, 4, pixels).ok());
  const Result<FloatImage> read = readImage(folder_ / "c.png");
  ASSERT_TRUE(read.ok()) << read.error().message;
  ASSERT_EQ(read->channels, 4);
  // Colour under alpha 0 must survive too.
  for (std::size_t i = 0; i < pixels.size(); ++i)
    EXPECT_EQ(std::lround(read->pixels[i] * 255), pixels[i]) << i;
  const Result<std::vector<std::uint8_t>> encoded = encodePng(1, 3, 4, pixels);
  ASSERT_TRUE(encoded.ok());
  const std::vector<std::uint8_t> signature{0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n'};
  ASSERT_GT(encoded->size(), signature.size());
  EXPECT_TRUE(std::equal(signature.begin(), signature.end(), encoded->begin()));
  std::ifstream stream(folder_ / "c.png", std::ios::binary);
  const std::vector<char> file((std::istreambuf_iterator<char>(stream)), {});
  EXPECT_TRUE(std::equal(file.begin(), file.end(), encoded->begin(), encoded->end(),
                         [](char a, std::uint8_t b) { return static_cast<std::uint8_t>(a) == b; }));
}

TEST_F(Images, UnwritablePathsAreNamedAndLeaveNothing) {
  const FloatImage image{.width = 1, .height = 1, .channels = 1, .pixels = {0.5f}};
  const std::filesystem::path missing = folder_ / "missing" / "v.exr";
  const Status exr = writeExr(missing, image);
  ASSERT_FALSE(exr.ok());
  EXPECT_EQ(exr.error().code, ErrorCode::fileNotWritable);
  EXPECT_NE(exr.error().message.find(missing.string()), std::string::npos) << exr.error().message;
  // A folder in the file's place fails only at the last step, after the bytes are written.
  std::filesystem::create_directories(folder_ / "taken.png" / "inside");
  const Status png = writePng(folder_ / "taken.png", 1, 1, 1, std::vector<std::uint8_t>{7});
  ASSERT_FALSE(png.ok());
  EXPECT_EQ(png.error().code, ErrorCode::fileNotWritable);
  EXPECT_EQ(fileCount(), 1) << "only the folder";
}

TEST_F(Images, WrongSizesAndFilesAreRefused) {
  const FloatImage image{.width = 2, .height = 2, .channels = 1, .pixels = {0.5f}};
  EXPECT_EQ(writeExr(folder_ / "v.exr", image).error().code, ErrorCode::invalidArgument);
  EXPECT_EQ(writePng(folder_ / "v.png", 1, 1, 5, std::vector<std::uint8_t>(5)).error().code,
            ErrorCode::invalidArgument);
  EXPECT_EQ(fileCount(), 0);
  EXPECT_EQ(readImage(folder_ / "none.exr").error().code, ErrorCode::fileNotFound);
  std::ofstream(folder_ / "text.exr") << "no image";
  EXPECT_EQ(readImage(folder_ / "text.exr").error().code, ErrorCode::fileMalformed);
}

}  // namespace
}  // namespace halfshadow::images
