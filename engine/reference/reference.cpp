// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "reference/reference.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <numeric>
#include <system_error>
#include <thread>

#include "reference/caster_shafts.hpp"
#include "reference/embree_scene.hpp"

namespace halfshadow::reference {
namespace {

constexpr std::size_t kPixelsPerChunk = 32;
// What the measurements call penumbra; this module does not depend on theirs.
constexpr float kPenumbraLow = 0.005f, kPenumbraHigh = 0.995f;

/// Scatters the bits of an integer: every output bit depends on every input bit.
/// Based on: Appleby, MurmurHash3, 2011, the 32-bit finaliser.
constexpr std::uint32_t scattered(std::uint32_t bits) {
  bits = (bits ^ (bits >> 16)) * 0x85ebca6bu;
  bits = (bits ^ (bits >> 13)) * 0xc2b2ae35u;
  return bits ^ (bits >> 16);
}

struct Strata {
  int columns, rows;
};

Strata strataFor(int samples) {
  int columns = static_cast<int>(std::ceil(std::sqrt(static_cast<double>(samples))));
  return {columns, (samples + columns - 1) / columns};
}

/// The light points' cells in the order of tracing: 4 × 4 neighbours share a packet, so its rays stay
/// together.
struct Stratum {
  float a, b;  ///< lower corner in [-1, 1]
  std::uint32_t number;
};

std::vector<Stratum> strataInPacketOrder(Strata strata) {
  std::vector<Stratum> order;
  for (int blockRow = 0; blockRow < strata.rows; blockRow += 4) {
    for (int blockColumn = 0; blockColumn < strata.columns; blockColumn += 4) {
      for (int row = blockRow; row < std::min(blockRow + 4, strata.rows); ++row) {
        for (int column = blockColumn; column < std::min(blockColumn + 4, strata.columns); ++column) {
          order.push_back({static_cast<float>(2.0 * column / strata.columns - 1.0),
                           static_cast<float>(2.0 * row / strata.rows - 1.0),
                           static_cast<std::uint32_t>(row * strata.columns + column)});
        }
      }
    }
  }
  return order;
}

/// Everything that the threads share, read-only.
class VisibilityTracer {
 public:
  VisibilityTracer(EmbreeScene casters, CasterShafts shafts, const TraceSpace& space,
                   const scene::AreaLight& light, const ReferenceOptions& options)
      : casters_(std::move(casters)),
        shafts_(std::move(shafts)),
        space_(space),
        light_{space.fromWorld(light.centerWorld), light.halfU * space.traceFromWorldScale,
               light.halfV * space.traceFromWorldScale},
        lightCenterWorld_(light.centerWorld),
        emission_(scene::emissionDirection(light)),
        lift_(options.originLiftWorld * space.traceFromWorldScale),
        seedKey_(scattered(options.seed + 0x9e3779b9u)) {
    const Strata strata = light_.hasSize() ? strataFor(options.samples) : Strata{1, 1};
    order_ = strataInPacketOrder(strata);
    widthA_ = 2.0f / static_cast<float>(strata.columns);
    widthB_ = 2.0f / static_cast<float>(strata.rows);
  }

  float visibility(const ReceiverImage& receivers, std::uint32_t pixel) const {
    if (receivers.kind[pixel] == kNoReceiver) return 1.0f;
    if (glm::dot(emission_, receivers.positionWorld[pixel] - lightCenterWorld_) <= 0.0) return 1.0f;
    RayOrigin origin{.point = space_.fromWorld(receivers.positionWorld[pixel]),
                     .normal = receivers.normalWorld[pixel]};
    if (receivers.kind[pixel] == kCasterReceiver) origin.point += lift_ * origin.normal;
    origin.rounding = kPointRounding * (glm::length(origin.point) +
                                        space_.traceFromWorldScale * glm::length(space_.centerWorld));
    if (light_.hasSize() && !shafts_.mayOcclude(origin.point, light_)) return 1.0f;
    return tracedVisibility(origin, scattered(seedKey_ ^ pixel));
  }

 private:
  /// Positions come from a camera ray in double: a few units in the last place.
  static constexpr double kPointRounding = 0x1p-48;

  float tracedVisibility(const RayOrigin& origin, std::uint32_t pixelKey) const {
    const glm::dvec3 toCenter = light_.center - origin.point;
    RayPacket rays;
    std::size_t hidden = 0;
    for (std::size_t first = 0; first < order_.size(); first += kPacketRays) {
      rays.count = std::min(kPacketRays, order_.size() - first);
      for (std::size_t i = 0; i < rays.count; ++i) {
        const Stratum& stratum = order_[first + i];
        const std::uint32_t bits = scattered(pixelKey + stratum.number * 0x9e3779b9u);
        // The two halves of one 32-bit value place the point inside its cell; 2^-16 of a cell is enough.
        const float jitterA = (static_cast<float>(bits & 0xffffu) + 0.5f) * (1.0f / 65536.0f);
        const float jitterB = (static_cast<float>(bits >> 16) + 0.5f) * (1.0f / 65536.0f);
        const double a = stratum.a + jitterA * widthA_, b = stratum.b + jitterB * widthB_;
        const glm::dvec3 direction = toCenter + a * light_.halfU + b * light_.halfV;
        rays.x[i] = direction.x, rays.y[i] = direction.y, rays.z[i] = direction.z;
      }
      hidden += casters_.occluded(origin, rays);
    }
    return static_cast<float>(1.0 - static_cast<double>(hidden) / static_cast<double>(order_.size()));
  }

  EmbreeScene casters_;
  CasterShafts shafts_;
  TraceSpace space_;
  TraceLight light_;
  glm::dvec3 lightCenterWorld_, emission_;
  double lift_;
  std::uint32_t seedKey_;
  std::vector<Stratum> order_;
  float widthA_ = 0.0f, widthB_ = 0.0f;
};

/// Chunks of pixels from a common counter; a pixel's value depends on nothing but the pixel and the seed.
void traceInThreads(const VisibilityTracer& tracer, const ReceiverImage& receivers,
                    std::span<const std::uint32_t> pixelIndices, const ReferenceOptions& options,
                    std::vector<float>& visibility) {
  std::atomic<std::size_t> next{0};
  const auto work = [&](const std::function<void(double)>& progress) {
    for (;;) {
      if (options.isCancelled && options.isCancelled()) return;
      const std::size_t first = next.fetch_add(kPixelsPerChunk);
      if (first >= pixelIndices.size()) return;
      const std::size_t end = std::min(first + kPixelsPerChunk, pixelIndices.size());
      for (std::size_t i = first; i < end; ++i) visibility[i] = tracer.visibility(receivers, pixelIndices[i]);
      if (progress) progress(static_cast<double>(end) / static_cast<double>(pixelIndices.size()));
    }
  };
  const int threads =
      options.threads > 0 ? options.threads : static_cast<int>(std::thread::hardware_concurrency());
  std::vector<std::thread> others;
  for (int i = 1; i < threads; ++i) {
    try {
      others.emplace_back(work, std::function<void(double)>());
    } catch (const std::system_error&) {
      break;  // no more threads to be had: those that run do all the work
    }
  }
  work(options.progress);
  for (std::thread& other : others) other.join();
  if (options.progress) options.progress(1.0);
}

}  // namespace

int tracedSamples(int samples) {
  if (samples < 1) return 0;
  const Strata strata = strataFor(samples);
  return strata.columns * strata.rows;
}

Result<std::vector<float>> tracePixels(const scene::SceneDescription& scene, const scene::AreaLight& light,
                                       const ReceiverImage& receivers,
                                       std::span<const std::uint32_t> pixelIndices,
                                       const ReferenceOptions& options) {
  const std::size_t pixelCount = receivers.kind.size();
  if (options.samples < 1 || options.samples > (1 << 24)) {
    return Error{ErrorCode::invalidArgument, "the reference needs between 1 and 16777216 samples per pixel"};
  }
  if (!(options.originLiftWorld >= 0.0) || !std::isfinite(options.originLiftWorld)) {
    return Error{ErrorCode::invalidArgument, "the origin lift must be a finite number of world units >= 0"};
  }
  if (receivers.positionWorld.size() != pixelCount || receivers.normalWorld.size() != pixelCount ||
      std::any_of(pixelIndices.begin(), pixelIndices.end(),
                  [&](std::uint32_t i) { return i >= pixelCount; })) {
    return Error{ErrorCode::invalidArgument, "the receiver image's vectors are shorter than its pixel count"};
  }
  const glm::dvec3 lightSum = light.centerWorld + light.halfU + light.halfV;
  if (!std::isfinite(lightSum.x + lightSum.y + lightSum.z)) {
    return Error{ErrorCode::invalidLight, "the light has a NaN or infinite component; give finite numbers"};
  }
  std::vector<float> visibility(pixelIndices.size(), 1.0f);
  const TraceSpace space = traceSpaceOf(scene);
  std::vector<TraceMesh> casters;
  for (const scene::SceneObject& object : scene.objects) {
    if (object.casts) casters.push_back(traceMeshOf(object, space));
  }
  double reach = 0.0;
  for (const std::uint32_t pixel : pixelIndices) {
    if (receivers.kind[pixel] == kNoReceiver) continue;
    reach = std::max(reach, glm::length(space.fromWorld(receivers.positionWorld[pixel])));
  }
  CasterShafts shafts(casters);
  Result<EmbreeScene> embree = EmbreeScene::build(std::move(casters), reach);
  if (!embree) return embree.error();
  const VisibilityTracer tracer(std::move(*embree), std::move(shafts), space, light, options);
  traceInThreads(tracer, receivers, pixelIndices, options, visibility);
  return visibility;
}

Result<std::vector<float>> traceVisibility(const scene::SceneDescription& scene,
                                           const scene::AreaLight& light, const ReceiverImage& receivers,
                                           const ReferenceOptions& options) {
  std::vector<std::uint32_t> all(receivers.kind.size());
  std::iota(all.begin(), all.end(), 0u);
  return tracePixels(scene, light, receivers, all, options);
}

Result<double> noiseRmse(const scene::SceneDescription& scene, const scene::AreaLight& light,
                         const ReceiverImage& receivers, std::span<const float> visibility,
                         const ReferenceOptions& options) {
  if (visibility.size() != receivers.kind.size()) {
    return Error{ErrorCode::invalidArgument, "the visibility image and the receiver image differ in size"};
  }
  std::vector<std::uint32_t> chosen;
  std::size_t penumbraPixels = 0;
  for (std::size_t i = 0; i < visibility.size(); ++i) {
    const bool penumbra =
        receivers.kind[i] != kNoReceiver && visibility[i] > kPenumbraLow && visibility[i] < kPenumbraHigh;
    if (penumbra && penumbraPixels++ % 3 == 0) chosen.push_back(static_cast<std::uint32_t>(i));
  }
  if (chosen.empty()) return 0.0;
  ReferenceOptions independent = options;
  independent.seed = scattered(options.seed) + 1;
  Result<std::vector<float>> second = tracePixels(scene, light, receivers, chosen, independent);
  if (!second) return second.error();
  double sum = 0.0;
  for (std::size_t i = 0; i < chosen.size(); ++i) {
    const double difference = (*second)[i] - visibility[chosen[i]];
    sum += difference * difference;
  }
  return std::sqrt(sum / static_cast<double>(chosen.size()));
}

}  // namespace halfshadow::reference
