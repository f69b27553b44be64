// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "report_page.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <sstream>

namespace halfshadow::cli_tests {
namespace {

void replaceAll(std::string& text, const std::string& from, const std::string& to) {
  for (std::size_t at = 0; (at = text.find(from, at)) != std::string::npos; at += to.size())
    text.replace(at, from.size(), to);
}

std::string unescaped(std::string text) {
  replaceAll(text, "&lt;", "<"), replaceAll(text, "&gt;", ">");
  replaceAll(text, "&quot;", "\""), replaceAll(text, "&#39;", "'");
  replaceAll(text, "&amp;", "&");
  return text;
}

std::vector<std::uint8_t> bytesOfBase64(const std::string& text) {
  const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::vector<std::uint8_t> bytes;
  unsigned held = 0;
  int bits = 0;
  for (const char c : text) {
    const std::size_t digit = digits.find(c);
    if (digit == std::string::npos) break;  // padding
    held = held << 6 | static_cast<unsigned>(digit), bits += 6;
    if (bits >= 8) bytes.push_back(static_cast<std::uint8_t>(held >> (bits -= 8)));
  }
  return bytes;
}

}  // namespace

std::string textOf(const std::string& file) {
  std::stringstream text;
  text << std::ifstream(file).rdbuf();
  return text.str();
}

std::vector<Offer> offersOf(const std::string& page) {
  std::vector<Offer> offers;
  std::vector<std::string> pictures;
  std::string inViewer;
  for (std::size_t at = 0; (at = page.find('<', at)) != std::string::npos; ++at) {
    const std::string image = "<img src=\"data:image/png;base64,", code = "<code>";
    if (page.compare(at, image.size(), image) == 0) {
      const std::size_t first = at + image.size();
      pictures.push_back(page.substr(first, page.find('"', first) - first));
    }
    if (page.compare(at, code.size(), code) != 0) continue;
    const std::size_t first = at + code.size();
    const std::string text = unescaped(page.substr(first, page.find('<', first) - first));
    if (text.starts_with("halfshadow-viewer ")) inViewer = text;
    if (!text.starts_with("halfshadow render ")) continue;
    Offer offer{.inViewer = inViewer, .command = text, .visibility = {}};
    if (text.ends_with("--visibility picture.exr")) {
      // The error map stands between the picture and its commands.
      EXPECT_GE(pictures.size(), 2u);
      auto decoded = images::decodeImage(bytesOfBase64(pictures[pictures.size() - 2]), "png");
      EXPECT_TRUE(decoded.ok());
      if (decoded) offer.visibility = std::move(decoded).value();
    }
    offers.push_back(std::move(offer));
  }
  return offers;
}

std::string play(std::string command, const std::string& folder) {
  const std::string file = folder + (command.ends_with(".exr") ? "/picture.exr" : "/picture.png");
  command.replace(0, std::string("halfshadow").size(), std::string("'") + HALFSHADOW_CLI + "'");
  command = "cd '" + folder + "' && rm -f picture.png picture.exr && " + command + " >log 2>&1";
  EXPECT_EQ(std::system(command.c_str()), 0) << command << "\n" << textOf(folder + "/log");
  return file;
}

void expectSameVisibility(const images::ByteImage& shown, const images::FloatImage& made,
                          const std::string& command) {
  ASSERT_EQ(shown.width, made.width) << command;
  ASSERT_EQ(shown.height, made.height) << command;
  std::size_t receivers = 0, dark = 0;
  for (std::size_t i = 0; i < shown.pixels.size() / 3; ++i) {
    const std::uint8_t* p = shown.pixels.data() + 3 * i;
    if (p[0] != p[1] || p[1] != p[2]) continue;  // the tone of what receives nothing
    ++receivers;
    dark += p[0] < 250 ? 1 : 0;
    const float value = made.pixels[i * static_cast<std::size_t>(made.channels)];
    ASSERT_NEAR(p[0] / 255.0, static_cast<double>(value), 0.51 / 255.0) << command << " at pixel " << i;
  }
  EXPECT_GT(receivers, shown.pixels.size() / 12) << command;
  EXPECT_GT(dark, 20u) << "no shadow to tell one command from another: " << command;
}

images::FloatImage readImage(const std::string& file) {
  auto image = images::readImage(file);
  if (image) return std::move(image).value();
  ADD_FAILURE() << image.error().message;
  return {};
}

}  // namespace halfshadow::cli_tests
