// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "report/picture.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <vector>

#include "images/images.hpp"

namespace halfshadow::report {
namespace {

using Color = std::array<float, 3>;

/// Evenly spaced over [-limit, limit]; lightness falls alike on both sides, so that a sign never looks
/// larger.
constexpr std::array<Color, 7> kErrorColors = {{{8, 48, 107},
                                                {49, 116, 188},
                                                {147, 193, 226},
                                                {246, 246, 245},
                                                {243, 168, 142},
                                                {205, 76, 60},
                                                {103, 8, 26}}};
constexpr std::uint8_t kNotReceiver[3] = {196, 200, 206};

Color errorColor(float error) {
  const float limited = std::isfinite(error) ? std::clamp(error / kErrorMapLimit, -1.0f, 1.0f) : 1.0f;
  const float position = (limited + 1.0f) * 0.5f * static_cast<float>(kErrorColors.size() - 1);
  const std::size_t first = std::min(static_cast<std::size_t>(position), kErrorColors.size() - 2);
  const float share = position - static_cast<float>(first);
  Color color;
  for (int i = 0; i < 3; ++i) {
    color[i] = kErrorColors[first][i] * (1 - share) + kErrorColors[first + 1][i] * share;
  }
  return color;
}

std::string base64(std::span<const std::uint8_t> bytes) {
  constexpr char kDigits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const std::size_t count = std::min<std::size_t>(3, bytes.size() - i);
    std::uint32_t group = 0;
    for (std::size_t k = 0; k < 3; ++k) group = group << 8 | (k < count ? bytes[i + k] : 0u);
    for (std::size_t k = 0; k < 4; ++k) text += k <= count ? kDigits[group >> (18 - 6 * k) & 63] : '=';
  }
  return text;
}

Status checkSizes(int width, int height, std::initializer_list<std::size_t> lengths) {
  const std::size_t expected = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  for (const std::size_t length : lengths) {
    if (length != expected) {
      return Error{ErrorCode::invalidArgument, "A report image has " + std::to_string(length) +
                                                   " pixels where " + std::to_string(width) + "x" +
                                                   std::to_string(height) +
                                                   " were announced; give all images of a scene one size."};
    }
  }
  return {};
}

}  // namespace

Result<std::string> pngUri(int width, int height, int channels, std::span<const std::uint8_t> pixels) {
  auto png = images::encodePng(width, height, channels, pixels);
  if (!png) return png.error();
  return "data:image/png;base64," + base64(*png);
}

Result<std::string> visibilityUri(int width, int height, std::span<const float> visibility,
                                  std::span<const std::uint8_t> receiver) {
  if (Status s = checkSizes(width, height, {visibility.size(), receiver.size()}); !s) return s.error();
  std::vector<std::uint8_t> pixels(visibility.size() * 3);
  for (std::size_t i = 0; i < visibility.size(); ++i) {
    const float value = std::isfinite(visibility[i]) ? std::clamp(visibility[i], 0.0f, 1.0f) : 0.0f;
    const auto grey = static_cast<std::uint8_t>(std::lround(value * 255.0f));
    for (std::size_t k = 0; k < 3; ++k) pixels[3 * i + k] = receiver[i] ? grey : kNotReceiver[k];
  }
  return pngUri(width, height, 3, pixels);
}

Result<std::string> errorMapUri(int width, int height, std::span<const float> measured,
                                std::span<const float> truth, std::span<const std::uint8_t> receiver) {
  if (Status s = checkSizes(width, height, {measured.size(), truth.size(), receiver.size()}); !s)
    return s.error();
  std::vector<std::uint8_t> pixels(measured.size() * 3);
  for (std::size_t i = 0; i < measured.size(); ++i) {
    const Color color = errorColor(measured[i] - truth[i]);
    for (std::size_t k = 0; k < 3; ++k) {
      pixels[3 * i + k] = receiver[i] ? static_cast<std::uint8_t>(std::lround(color[k])) : kNotReceiver[k];
    }
  }
  return pngUri(width, height, 3, pixels);
}

std::string errorMapGradient() {
  std::string gradient = "linear-gradient(to right";
  for (const Color& color : kErrorColors) {
    char text[32];
    std::snprintf(text, sizeof text, ", rgb(%.0f %.0f %.0f)", color[0], color[1], color[2]);
    gradient += text;
  }
  return gradient + ")";
}

}  // namespace halfshadow::report
