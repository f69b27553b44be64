// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "scenes/gltf_images.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <exception>

#include "images/images.hpp"
#include "scenes/gltf_accessors.hpp"

namespace halfshadow::scenes {
namespace {
/// Extensions of textures that name another image, the first that can be decoded first.
constexpr std::array<const char*, 4> kOtherSources = {"EXT_texture_webp", "KHR_texture_basisu",
                                                      "EXT_texture_avif", "MSFT_texture_dds"};

int sourceIn(const tinygltf::Texture& texture, const char* extension) {
  const auto found = texture.extensions.find(extension);
  if (found == texture.extensions.end() || !found->second.IsObject()) return -1;
  return indexIn(found->second.Get("source"));
}

bool begins(const ByteRange& bytes, std::string_view magic) {
  return bytes.size >= magic.size() && std::memcmp(bytes.begin, magic.data(), magic.size()) == 0;
}

/// Behind "data:…;base64,"; empty where the text is no such URI.
FileBytes bytesOfDataUri(std::string_view uri) {
  constexpr std::string_view kMark = ";base64,";
  const std::size_t mark = uri.find(kMark);
  FileBytes bytes;
  if (!uri.starts_with("data:") || mark == std::string_view::npos) return bytes;
  constexpr std::string_view kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::uint32_t bits = 0;
  int held = 0;
  for (const char c : uri.substr(mark + kMark.size())) {
    const std::size_t digit = kDigits.find(c);
    if (digit == std::string_view::npos) break;
    bits = bits << 6 | static_cast<std::uint32_t>(digit);
    held += 6;
    if (held < 8) continue;
    held -= 8;
    bytes.push_back(static_cast<unsigned char>(bits >> held));
  }
  return bytes;
}

/// 8 bits per channel, 3 or 4 channels; an error when the sizes do not fit together.
Result<scene::Image> converted(const tinygltf::Image& source) {
  const bool isWide = source.bits == 16;
  const auto pixelCount = static_cast<std::size_t>(std::max(source.width, 0)) *
                          static_cast<std::size_t>(std::max(source.height, 0));
  const auto channels = static_cast<std::size_t>(std::max(source.component, 0));
  if (pixelCount == 0 || channels < 1 || channels > 4 || (source.bits != 8 && !isWide) ||
      source.image.size() != pixelCount * channels * (isWide ? 2 : 1)) {
    return malformed("its size or depth is none of an image");
  }
  const auto value = [&](std::size_t i) { return source.image[isWide ? 2 * i + 1 : i]; };  // high byte of two
  scene::Image image{.width = source.width, .height = source.height};
  const bool hasAlpha = channels == 2 || channels == 4, isGrey = channels <= 2;
  image.channels = hasAlpha ? 4 : 3;
  image.pixels.resize(pixelCount * static_cast<std::size_t>(image.channels));
  std::uint8_t* target = image.pixels.data();
  for (std::size_t p = 0; p < pixelCount; ++p) {
    for (std::size_t c = 0; c < 3; ++c) *target++ = value(p * channels + (isGrey ? 0 : c));
    if (hasAlpha) *target++ = value(p * channels + channels - 1);
  }
  return image;
}

Result<scene::Image> decodedWebP(const ByteRange& range) {
  auto decoded = images::decodeImage({range.begin, range.size}, "webp");
  if (!decoded) return decoded.error();
  return scene::Image{.width = decoded->width,
                      .height = decoded->height,
                      .channels = decoded->channels,
                      .pixels = std::move(decoded->pixels)};
}

Result<scene::Image> decodedImage(const ByteRange& range) {
  if (begins(range, "RIFF")) return decodedWebP(range);
  if (begins(range, "\xABKTX 20")) return malformed("KTX 2 cannot be decoded here; export PNG, JPEG or WebP");
  if (begins(range, "DDS ")) return malformed("DDS cannot be decoded here; export PNG, JPEG or WebP");
  tinygltf::Image image;
  std::string error, warning;
  bool done = false;
  try {
    done = range.size > 0 && tinygltf::LoadImageData(&image, 0, &error, &warning, 0, 0, range.begin,
                                                     static_cast<int>(range.size), nullptr);
  } catch (const std::exception&) {
    done = false;
  }
  if (!done) return malformed("its bytes are not a PNG, JPEG or WebP image that can be decoded");
  return converted(image);
}
}  // namespace

std::shared_ptr<const scene::Image> GltfImages::ofTexture(int texture) {
  if (texture < 0 || static_cast<std::size_t>(texture) >= model_.textures.size()) {
    addNote("texture " + std::to_string(texture) + " does not exist; a plain colour is used");
    return nullptr;
  }
  const tinygltf::Texture& source = model_.textures[texture];
  // The extension's image is the one meant; the plain one is for who cannot decode that.
  if (const int webp = sourceIn(source, kOtherSources[0]); webp >= 0) {
    if (auto image = at(webp)) return image;
  }
  if (source.source >= 0) return at(source.source);
  for (const char* extension : kOtherSources) {
    if (const int index = sourceIn(source, extension); index >= 0) return at(index);
  }
  addNote("texture " + std::to_string(texture) + " has no image; a plain colour is used");
  return nullptr;
}

std::shared_ptr<const scene::Image> GltfImages::at(int index) {
  if (index < 0 || static_cast<std::size_t>(index) >= images_.size()) {
    addNote("image " + std::to_string(index) + " does not exist; a plain colour is used");
    return nullptr;
  }
  if (isTried_[index]) return images_[index];
  isTried_[index] = true;
  Result<scene::Image> image = decoded(index);
  if (!image) {
    const std::string uri =
        model_.images[index].uri.starts_with("data:") ? std::string() : model_.images[index].uri;
    addNote("image " + std::to_string(index) + (uri.empty() ? "" : " '" + uri.substr(0, 80) + "'") +
            " is not used, nor holes that it may cut: " + image.error().message);
    return nullptr;
  }
  images_[index] = std::make_shared<const scene::Image>(std::move(image).value());
  return images_[index];
}

Result<scene::Image> GltfImages::decoded(int index) const {
  const tinygltf::Image& source = model_.images[index];
  if (source.bufferView != -1) {
    const Result<ByteRange> range = bytesOfView(model_, source.bufferView);
    if (!range) return range.error();
    return decodedImage(*range);
  }
  // The parser leaves out data URIs of formats that it does not know.
  const FileBytes inUri = source.image.empty() ? bytesOfDataUri(source.uri) : FileBytes();
  const std::vector<unsigned char>& bytes = source.image.empty() ? inUri : source.image;
  if (bytes.empty()) return malformed("its file is missing or empty");
  return decodedImage({bytes.data(), bytes.size()});
}

void GltfImages::addNote(std::string note) {
  if (std::ranges::find(notes_, note) == notes_.end()) notes_.push_back(std::move(note));
}

}  // namespace halfshadow::scenes
