// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// Image files. All writers encode in memory first and rename a finished file into place: a failed write
/// leaves no partial file, and an existing file of that name stays as it was.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "base/error.hpp"

namespace halfshadow::images {

/// width × height × channels floats, row 0 on top, channels interleaved.
struct FloatImage {
  int width = 0, height = 0, channels = 0;
  std::vector<float> pixels;
  std::vector<std::string> channelNames;  ///< one per channel, e.g. "V" or "R", "G", "B", "A"

  /// Position of a channel by name, or -1.
  int channelIndex(std::string_view name) const;
};

/// Reads any format that OpenImageIO knows; integers become 0 … 1; no colour conversion, not premultiplied.
/// Errors: fileNotFound, fileMalformed.
Result<FloatImage> readImage(const std::filesystem::path& path);

/// 8 bits a channel, row 0 on top, not premultiplied.
struct ByteImage {
  int width = 0, height = 0, channels = 0;  ///< channels: 3 or 4
  std::vector<std::uint8_t> pixels;
};
/// Decodes a file held in memory; `format` is OpenImageIO's name of it, e.g. "webp". Grey images are spread
/// to three channels, 16 bits rounded to 8. May be called on several threads. Errors: fileMalformed (also
/// above 16384 x 16384 pixels).
Result<ByteImage> decodeImage(std::span<const std::uint8_t> file, const char* format);

/// Writes 32-bit float OpenEXR (lossless). The image's own channelNames are used; when it has none,
/// "V" for one channel and R, G, B, A for up to four. OpenEXR stores channels sorted by name.
/// Errors: invalidArgument (sizes disagree), fileNotWritable.
Status writeExr(const std::filesystem::path& path, const FloatImage& image);
/// The same with names that replace the image's own.
Status writeExr(const std::filesystem::path& path, const FloatImage& image,
                std::span<const std::string> channelNames);

/// 8-bit PNG; channels 1 (grey), 2 (grey, alpha), 3 (RGB) or 4 (RGBA, not premultiplied); row 0 on top.
/// `pixels` holds width · height · channels bytes. Errors: invalidArgument, fileNotWritable.
Status writePng(const std::filesystem::path& path, int width, int height, int channels,
                std::span<const std::uint8_t> pixels);
/// The bytes of that PNG file. Errors: invalidArgument.
Result<std::vector<std::uint8_t>> encodePng(int width, int height, int channels,
                                            std::span<const std::uint8_t> pixels);

}  // namespace halfshadow::images
