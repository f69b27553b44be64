// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "images/images.hpp"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <optional>
#include <random>

namespace halfshadow::images {
namespace {

using Bytes = std::vector<std::uint8_t>;

/// Small images: one thread each, and no pool of worker threads beside the caller's own.
void configureOnce() {
  static const bool configured = [] {
    OIIO::attribute("threads", 1);
    OIIO::attribute("exr_threads", 1);
    return true;
  }();
  static_cast<void>(configured);
}

/// A copy on disk of what is in memory, for readers that want a name.
class TemporaryFile {
 public:
  TemporaryFile(std::span<const std::uint8_t> bytes, const char* extension) {
    std::error_code failure;
    path_ = std::filesystem::temp_directory_path(failure) /
            ("halfshadow-" + std::to_string(std::random_device{}()) + "." + extension);
    std::ofstream stream(path_, std::ios::binary);
    stream.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
    stream.close();
    written_ = !failure && static_cast<bool>(stream);
  }
  ~TemporaryFile() {
    std::error_code ignored;
    std::filesystem::remove(path_, ignored);
  }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;
  const std::filesystem::path& path() const { return path_; }
  bool written() const { return written_; }

 private:
  std::filesystem::path path_;
  bool written_ = false;
};

Error notWritable(const std::filesystem::path& path, const std::string& why) {
  return Error{ErrorCode::fileNotWritable, "cannot write '" + path.string() + "': " + why +
                                               "; create its folder, free the space or give another path"};
}

Status replaceFile(const std::filesystem::path& path, const Bytes& bytes) {
  std::filesystem::path unfinished = path;
  unfinished += ".unfinished-" + std::to_string(std::random_device{}());
  std::error_code ignored;
  errno = 0;
  {
    std::ofstream stream(unfinished, std::ios::binary | std::ios::trunc);
    stream.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
    stream.close();
    if (!stream) {
      const std::string why = errno ? std::strerror(errno) : "the stream failed";
      std::filesystem::remove(unfinished, ignored);
      return notWritable(path, why);
    }
  }
  std::error_code failure;
  std::filesystem::rename(unfinished, path, failure);
  if (failure) {
    std::filesystem::remove(unfinished, ignored);
    return notWritable(path, failure.message());
  }
  return {};
}

Result<Bytes> encode(const char* format, const OIIO::ImageSpec& spec, OIIO::TypeDesc type,
                     const void* pixels) {
  configureOnce();
  const auto failed = [format](const std::string& why) {
    return Error{ErrorCode::internal, std::string("OpenImageIO cannot encode ") + format + ": " + why};
  };
  std::unique_ptr<OIIO::ImageOutput> output = OIIO::ImageOutput::create(format);
  if (!output) return failed(OIIO::geterror());
  Bytes bytes;
  OIIO::Filesystem::IOVecOutput memory(bytes);
  if (!output->supports("ioproxy") || !output->set_ioproxy(&memory))
    return failed("the plugin cannot write to memory");
  if (!output->open(std::string("memory.") + format, spec)) return failed(output->geterror());
  if (!output->write_image(type, pixels)) return failed(output->geterror());
  if (!output->close()) return failed(output->geterror());
  return bytes;
}

std::vector<std::string> namesFor(int channels) {
  if (channels == 1) return {"V"};
  static const char* const kRgba[] = {"R", "G", "B", "A"};
  std::vector<std::string> names;
  for (int i = 0; i < channels; ++i) names.push_back(i < 4 ? kRgba[i] : "channel" + std::to_string(i));
  return names;
}

bool sizesAgree(int width, int height, int channels, std::size_t values) {
  return width > 0 && height > 0 && channels > 0 &&
         values == static_cast<std::size_t>(width) * static_cast<std::size_t>(height) *
                       static_cast<std::size_t>(channels);
}

}  // namespace

int FloatImage::channelIndex(std::string_view name) const {
  for (std::size_t i = 0; i < channelNames.size(); ++i) {
    if (channelNames[i] == name) return static_cast<int>(i);
  }
  return -1;
}

Result<FloatImage> readImage(const std::filesystem::path& path) {
  configureOnce();
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(path, ignored) || !std::ifstream(path)) {
    return Error{ErrorCode::fileNotFound,
                 "cannot read '" + path.string() + "': give the path of an existing image"};
  }
  const auto malformed = [&path](std::string why) {
    if (why.empty()) why = "unknown format";
    return Error{ErrorCode::fileMalformed,
                 "'" + path.string() + "' is not a readable image (" + why + "); give an EXR or PNG file"};
  };
  OIIO::ImageSpec asStored;
  asStored.attribute("oiio:UnassociatedAlpha", 1);  // colours are not multiplied by alpha on the way in
  std::unique_ptr<OIIO::ImageInput> input = OIIO::ImageInput::open(path.string(), &asStored);
  if (!input) return malformed(OIIO::geterror());
  const OIIO::ImageSpec& spec = input->spec();
  FloatImage image{.width = spec.width, .height = spec.height, .channels = spec.nchannels};
  image.channelNames = spec.channelnames;
  if (spec.image_pixels() == 0 || spec.nchannels < 1) return malformed("it has no pixels");
  image.pixels.resize(spec.image_pixels() * static_cast<std::size_t>(spec.nchannels));
  if (!input->read_image(0, 0, 0, spec.nchannels, OIIO::TypeDesc::FLOAT, image.pixels.data())) {
    return malformed(input->geterror());
  }
  return image;
}

namespace {
/// Sides of 16384: more is more than a device holds, and a few bytes may claim it.
constexpr std::uint64_t kMostPixels = std::uint64_t{1} << 28;

/// Grey, with or without alpha, becomes colours that are alike.
void spreadGrey(ByteImage& image) {
  const auto from = static_cast<std::size_t>(image.channels), to = from + 2;
  std::vector<std::uint8_t> pixels(image.pixels.size() / from * to);
  const std::uint8_t* source = image.pixels.data();
  for (auto target = pixels.begin(); target != pixels.end(); source += from) {
    target = std::fill_n(target, 3, source[0]);
    if (from == 2) *target++ = source[1];
  }
  image.pixels = std::move(pixels);
  image.channels = static_cast<int>(to);
}
}  // namespace

Result<ByteImage> decodeImage(std::span<const std::uint8_t> file, const char* format) {
  configureOnce();
  const auto failed = [format](const std::string& why) {
    return Error{ErrorCode::fileMalformed, std::string("OpenImageIO cannot decode it as ") + format + ": " +
                                               (why.empty() ? "unknown format" : why)};
  };
  OIIO::Filesystem::IOMemReader memory(const_cast<std::uint8_t*>(file.data()), file.size());
  std::unique_ptr<OIIO::ImageInput> input = OIIO::ImageInput::create(format);
  if (!input) return failed(OIIO::geterror());
  OIIO::ImageSpec asStored, opened;
  asStored.attribute("oiio:UnassociatedAlpha", 1);
  // OpenImageIO 2.4 reads WebP from named files only.
  std::optional<TemporaryFile> named;
  if (!input->supports("ioproxy") || !input->set_ioproxy(&memory)) {
    named.emplace(file, format);
    if (!named->written()) return failed("the folder for temporary files cannot be written to");
  }
  if (!input->open(named ? named->path().string() : std::string("memory.") + format, opened, asStored))
    return failed(input->geterror());
  const OIIO::ImageSpec& spec = input->spec();
  if (spec.image_pixels() == 0 || spec.nchannels < 1) return failed("it has no pixels");
  if (spec.image_pixels() > kMostPixels) return failed("it has more than 16384 x 16384 pixels");
  ByteImage image{.width = spec.width, .height = spec.height, .channels = std::min(spec.nchannels, 4)};
  image.pixels.resize(spec.image_pixels() * static_cast<std::size_t>(image.channels));
  if (!input->read_image(0, 0, 0, image.channels, OIIO::TypeDesc::UINT8, image.pixels.data()))
    return failed(input->geterror());
  if (image.channels < 3) spreadGrey(image);
  return image;
}

Status writeExr(const std::filesystem::path& path, const FloatImage& image) {
  return writeExr(path, image, image.channelNames);
}

Status writeExr(const std::filesystem::path& path, const FloatImage& image,
                std::span<const std::string> channelNames) {
  if (!sizesAgree(image.width, image.height, image.channels, image.pixels.size())) {
    return Error{ErrorCode::invalidArgument, "the image for '" + path.string() +
                                                 "' has a pixel count other than width x height x channels"};
  }
  OIIO::ImageSpec spec(image.width, image.height, image.channels, OIIO::TypeDesc::FLOAT);
  spec.channelnames = channelNames.empty()
                          ? namesFor(image.channels)
                          : std::vector<std::string>(channelNames.begin(), channelNames.end());
  if (spec.channelnames.size() != static_cast<std::size_t>(image.channels)) {
    return Error{ErrorCode::invalidArgument,
                 "the image for '" + path.string() + "' needs one name for each of its channels"};
  }
  spec.alpha_channel = -1;  // nothing is premultiplied
  spec.attribute("compression", "zip");
  Result<Bytes> bytes = encode("exr", spec, OIIO::TypeDesc::FLOAT, image.pixels.data());
  if (!bytes) return bytes.error();
  return replaceFile(path, *bytes);
}

Result<Bytes> encodePng(int width, int height, int channels, std::span<const std::uint8_t> pixels) {
  if (channels > 4 || !sizesAgree(width, height, channels, pixels.size())) {
    return Error{ErrorCode::invalidArgument,
                 "a PNG needs a positive size, 1 to 4 channels and width x height x channels bytes"};
  }
  OIIO::ImageSpec spec(width, height, channels, OIIO::TypeDesc::UINT8);
  spec.attribute("oiio:UnassociatedAlpha", 1);  // bytes go to the file as they are
  return encode("png", spec, OIIO::TypeDesc::UINT8, pixels.data());
}

Status writePng(const std::filesystem::path& path, int width, int height, int channels,
                std::span<const std::uint8_t> pixels) {
  Result<Bytes> bytes = encodePng(width, height, channels, pixels);
  if (!bytes) return bytes.error();
  return replaceFile(path, *bytes);
}

}  // namespace halfshadow::images
