// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "scenes/gltf_images.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <new>
#include <system_error>

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

struct Format {
  std::string_view magic;  ///< the first bytes of its files
  const char* name;        ///< OpenImageIO's
};
/// Two more than the format allows, which some exporters embed all the same.
constexpr std::array<Format, 5> kFormats = {
    {{"\x89PNG", "png"}, {"\xFF\xD8\xFF", "jpeg"}, {"RIFF", "webp"}, {"BM", "bmp"}, {"GIF8", "gif"}}};

Result<scene::Image> decodedImage(const ByteRange& range) {
  if (begins(range, "\xABKTX 20")) return malformed("KTX 2 cannot be decoded here; export PNG, JPEG or WebP");
  if (begins(range, "DDS ")) return malformed("DDS cannot be decoded here; export PNG, JPEG or WebP");
  const auto format = std::ranges::find_if(kFormats, [&](const Format& f) { return begins(range, f.magic); });
  const Error undecodable = malformed("its bytes are not a PNG, JPEG or WebP image that can be decoded");
  if (format == kFormats.end()) return undecodable;
  try {
    auto image = images::decodeImage({range.begin, range.size}, format->name);
    if (!image) return undecodable;
    return scene::Image{.width = image->width,
                        .height = image->height,
                        .channels = image->channels,
                        .pixels = std::move(image->pixels)};
  } catch (const std::bad_alloc&) {
    return malformed("there is not enough memory to decode it");
  }
}
}  // namespace

void GltfImages::beginDecoding(const std::vector<int>& textures) {
  for (const int texture : textures) {
    if (texture < 0 || static_cast<std::size_t>(texture) >= model_.textures.size()) continue;
    const tinygltf::Texture& source = model_.textures[static_cast<std::size_t>(texture)];
    const int webp = sourceIn(source, kOtherSources[0]);
    const int image = webp >= 0 ? webp : source.source;
    if (image < 0 || static_cast<std::size_t>(image) >= ahead_.size()) continue;
    if (std::ranges::find(wanted_, image) == wanted_.end()) wanted_.push_back(image);
  }
  const std::size_t most = std::min<std::size_t>(std::thread::hardware_concurrency(), wanted_.size());
  try {
    while (helpers_.size() < most) helpers_.emplace_back([this] { decodeWanted(); });
  } catch (const std::system_error&) {
    // No thread to be had: endDecoding() does what is left.
  }
}

void GltfImages::decodeWanted() {
  for (std::size_t i = next_++; i < wanted_.size(); i = next_++)
    ahead_[static_cast<std::size_t>(wanted_[i])] = decoded(wanted_[i]);
}

void GltfImages::endDecoding() {
  decodeWanted();
  helpers_.clear();
}

GltfImages::~GltfImages() {
  next_ = wanted_.size();  // what nobody asks for any more need not be begun
}

std::shared_ptr<const scene::Image> GltfImages::ofTexture(int texture) {
  endDecoding();
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
  std::optional<Result<scene::Image>>& ahead = ahead_[static_cast<std::size_t>(index)];
  Result<scene::Image> image = ahead ? std::move(*ahead) : decoded(index);
  ahead.reset();
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
