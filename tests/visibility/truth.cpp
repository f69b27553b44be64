// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "truth.hpp"

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <map>

#include "images/images.hpp"
#include "metrics/metrics.hpp"
#include "reference/reference.hpp"

namespace halfshadow::test {
namespace {
namespace fs = std::filesystem;

constexpr std::size_t kPixels = static_cast<std::size_t>(kWidth) * kHeight;

/// Based on: Fowler, Noll, Vo, the FNV-1a hash, draft-eastlake-fnv.
class Hash {
 public:
  template <typename T>
  void add(const T* values, std::size_t count) {
    const auto* bytes = reinterpret_cast<const unsigned char*>(values);
    for (std::size_t i = 0; i < count * sizeof(T); ++i) value_ = (value_ ^ bytes[i]) * 0x100000001b3ull;
  }
  std::uint64_t value() const { return value_; }

 private:
  std::uint64_t value_ = 0xcbf29ce484222325ull;
};

std::uint64_t contentHash(const scene::SceneDescription& scene) {
  Hash hash;
  for (const scene::SceneObject& object : scene.objects) {
    hash.add(object.mesh->positions.data(), object.mesh->positions.size());
    hash.add(object.mesh->indices.data(), object.mesh->indices.size());
    hash.add(&object.worldFromObject, 1);
    const std::uint8_t roles[] = {object.casts, object.receives};
    hash.add(roles, 2);
  }
  const scene::AreaLight& light = scene.lights.front();
  const scene::Camera& camera = *scene.camera;
  const glm::dvec3 vectors[] = {light.centerWorld, light.halfU, light.halfV, camera.eyeWorld,
                                camera.targetWorld};
  hash.add(vectors, 5);
  hash.add(&camera.verticalFovRadians, 1);
  return hash.value();
}

std::string fileName(std::string text) {
  for (char& c : text) {
    if (!std::isalnum(static_cast<unsigned char>(c))) c = '_';
  }
  return text;
}

fs::path truthPath(const std::string& name, const scene::SceneDescription& scene) {
  char hash[17];
  std::snprintf(hash, sizeof hash, "%016llx", static_cast<unsigned long long>(contentHash(scene)));
  return fs::path(HALFSHADOW_TEST_OUTPUT_DIR) / "truth" /
         (fileName(name) + "_" + std::to_string(kTruthSamples) + "_v" +
          std::to_string(reference::kTracerVersion) + "_" + hash + ".bin");
}

std::vector<float> readTruth(const fs::path& path) {
  std::vector<float> values(kPixels);
  std::ifstream file(path, std::ios::binary);
  file.read(reinterpret_cast<char*>(values.data()), static_cast<std::streamsize>(kPixels * sizeof(float)));
  if (!file || file.peek() != std::ifstream::traits_type::eof()) values.clear();
  return values;
}

void writeTruth(const fs::path& path, const std::vector<float>& values) {
  fs::create_directories(path.parent_path());
  // A name of this process's own, renamed into place: whoever reads sees all or nothing.
  const fs::path partial = path.string() + "." + std::to_string(getpid());
  std::ofstream(partial, std::ios::binary)
      .write(reinterpret_cast<const char*>(values.data()),
             static_cast<std::streamsize>(values.size() * sizeof(float)));
  fs::rename(partial, path);
}

/// Pixels where a rasteriser may show another surface than a ray through the centre does: next to another
/// kind of receiver, or to a jump in depth.
std::vector<std::uint8_t> interiorPixels(const reference::ReceiverImage& receivers,
                                         const scene::Camera& camera) {
  const glm::dvec3 forward = glm::normalize(camera.targetWorld - camera.eyeWorld);
  const auto depth = [&](std::size_t i) {
    return glm::dot(receivers.positionWorld[i] - camera.eyeWorld, forward);
  };
  const double pixelAngle = 2.0 * std::tan(0.5 * camera.verticalFovRadians) / kHeight;
  std::vector<std::uint8_t> interior(kPixels, 0);
  for (int y = 1; y + 1 < kHeight; ++y) {
    for (int x = 1; x + 1 < kWidth; ++x) {
      const std::size_t center = static_cast<std::size_t>(y) * kWidth + static_cast<std::size_t>(x);
      bool smooth = true;
      for (int dy = -1; dy <= 1; ++dy) {
        for (int dx = -1; dx <= 1; ++dx) {
          const std::size_t near = center + static_cast<std::size_t>(dy * kWidth + dx);
          // A surface that falls away by four pixels per pixel is seen at 14 degrees.
          smooth = smooth && receivers.kind[near] == receivers.kind[center] &&
                   std::abs(depth(near) - depth(center)) < 4.0 * std::sqrt(2.0) * pixelAngle * depth(center);
        }
      }
      interior[center] = smooth;
    }
  }
  return interior;
}

std::vector<std::uint8_t> facingPixels(const reference::ReceiverImage& receivers,
                                       const scene::AreaLight& light) {
  std::vector<std::uint8_t> facing(kPixels, 1);
  for (std::size_t i = 0; i < kPixels; ++i) {
    for (const double a : {-1.0, 1.0}) {
      for (const double b : {-1.0, 1.0}) {
        const glm::dvec3 toCorner =
            light.centerWorld + a * light.halfU + b * light.halfV - receivers.positionWorld[i];
        if (glm::dot(glm::dvec3(receivers.normalWorld[i]), toCorner) <= 0.0) facing[i] = 0;
      }
    }
  }
  return facing;
}

}  // namespace

namespace {
std::vector<std::uint8_t> penumbraOn(const Truth& truth, std::uint8_t kind) {
  std::vector<std::uint8_t> pixels(truth.kind.size());
  for (std::size_t i = 0; i < pixels.size(); ++i) pixels[i] = truth.kind[i] == kind;
  return metrics::penumbraMask(truth.visibility, pixels);
}
}  // namespace

std::vector<std::uint8_t> Truth::penumbraOnGround() const {
  return penumbraOn(*this, reference::kGroundReceiver);
}
std::vector<std::uint8_t> Truth::penumbraOnCasters() const {
  return penumbraOn(*this, reference::kCasterReceiver);
}

const Truth& truthOf(const std::string& sceneName) {
  static std::map<std::string, Truth> known;
  const auto found = known.find(sceneName);
  if (found != known.end()) return found->second;
  const scene::SceneDescription& scene = builtinScene(sceneName);
  Truth truth;
  const auto receivers =
      reference::traceReceivers(scene, *scene.camera, scene.lights.front(), kWidth, kHeight);
  EXPECT_TRUE(receivers) << receivers.error().message;
  truth.kind = receivers->kind;
  truth.interior = interiorPixels(*receivers, *scene.camera);
  truth.facesWholeLight = facingPixels(*receivers, scene.lights.front());
  const fs::path path = truthPath(sceneName, scene);
  truth.visibility = readTruth(path);
  if (truth.visibility.empty()) {
    auto traced =
        reference::traceVisibility(scene, scene.lights.front(), *receivers, {.samples = kTruthSamples});
    EXPECT_TRUE(traced) << traced.error().message;
    truth.visibility = std::move(traced).value();
    writeTruth(path, truth.visibility);
  }
  return known[sceneName] = std::move(truth);
}

std::string saveComparison(const std::string& name, int width, int height, std::span<const float> expected,
                           std::span<const float> actual) {
  const fs::path folder = fs::path(HALFSHADOW_TEST_OUTPUT_DIR) / "failures";
  fs::create_directories(folder);
  const auto columns = static_cast<std::size_t>(width), rows = static_cast<std::size_t>(height);
  std::vector<std::uint8_t> pixels(columns * rows * 9);
  const auto byte = [](float value) {
    return static_cast<std::uint8_t>(std::clamp(value, 0.0f, 1.0f) * 255.0f + 0.5f);
  };
  for (std::size_t y = 0; y < rows; ++y) {
    for (std::size_t x = 0; x < columns; ++x) {
      const std::size_t i = y * columns + x;
      std::uint8_t* row = pixels.data() + y * columns * 9;
      std::fill_n(row + x * 3, 3, byte(expected[i]));
      std::fill_n(row + (columns + x) * 3, 3, byte(actual[i]));
      const float error = actual[i] - expected[i];
      row[(2 * columns + x) * 3] = byte(4 * error);
      row[(2 * columns + x) * 3 + 2] = byte(-4 * error);
    }
  }
  std::string file = fileName(name);
  if (const char* driver = std::getenv("HALFSHADOW_TEST_DRIVER")) file += "_on_" + std::string(driver);
  for (const std::string& capability : forcedOffByEnvironment()) file += "_without_" + fileName(capability);
  const fs::path path = folder / (file + ".png");
  const Status written = images::writePng(path, 3 * width, height, 3, pixels);
  return written ? "see " + path.string() : written.error().message;
}

std::string saveComparison(const std::string& name, const Truth& truth, std::span<const float> actual) {
  return saveComparison(name, kWidth, kHeight, truth.visibility, actual);
}

}  // namespace halfshadow::test
