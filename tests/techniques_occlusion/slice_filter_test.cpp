// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// The GPU's prefilters against the same sums on the CPU.
#include <cmath>
#include <functional>
#include <random>

#include "framegraph/executor.hpp"
#include "framegraph/plan.hpp"
#include "gl/embedded_shaders.hpp"
#include "gl_fixture.hpp"
#include "techniques/execution/light_passes.hpp"
#include "techniques/occlusion_textures/slice_passes.hpp"

namespace halfshadow::techniques {
namespace {
using Pixels = std::vector<std::uint8_t>;

struct Filtered {
  int width = 0, height = 0;
  Pixels pixels;
  std::size_t at(int x, int y) const {
    return 4u * (static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x));
  }
};

/// Filters one texture of size² texels.
class FilterPlanner final : public LightPlanner {
 public:
  FilterPlanner(int size, const Pixels& source, SliceFilter filter, double widestTexels)
      : size_(size), source_(source), filter_(filter), widestTexels_(widestTexels) {}
  Status plan(const LightScene& scene, PassPlan& plan) override {
    const bool mipmap = filter_ == SliceFilter::mipmap;
    const auto slices =
        plan.addImage({.name = "slices",
                       .width = size_,
                       .height = size_,
                       .lifetime = framegraph::Lifetime::persistent,
                       .filter = mipmap ? framegraph::Filter::linearMipNearest : framegraph::Filter::nearest,
                       .mipmapped = mipmap});
    const std::uint32_t source = plan.addTexture(
        {.name = "source", .desc = {.width = size_, .height = size_}, .key = 1, .pixels = [this] {
           return std::make_shared<const Pixels>(source_);
         }});
    PlannedPass pass{
        .name = "slices", .stage = framegraph::PassStage::light, .writes = {{.resource = slices}}};
    pass.draws.push_back({.program = plan.addProgram({"screen/fullscreen.vert", "map/pyramid_copy.frag", {}}),
                          .textures = {{.sampler = "u_source", .own = source}}});
    plan.passes.push_back(std::move(pass));
    SliceSpace space;
    space.mapSize = glm::ivec2(size_);
    space.atlasSize = size_;
    space.widestTexels = widestTexels_;
    auto made = planSliceFilter(scene, plan, space, {.textures = {slices}, .contentKey = 1}, filter_);
    if (!made) return made.error();
    plan.shading.textures = {{.sampler = "u_result", .resource = made->textures[0]}};
    return {};
  }

 private:
  int size_;
  Pixels source_;
  SliceFilter filter_;
  double widestTexels_;
};

class SliceFilterTest : public test::GlTest {
 protected:
  /// Filters one texture of size² texels with a context of its own.
  static Filtered filter(int size, const Pixels& source, SliceFilter filter, double widestTexels,
                         const gl::ContextOptions& options = {}) {
    auto context = test::makeContext(options);
    EXPECT_TRUE(context.ok());
    gl::ProgramCache programs(**context, gl::embeddedShader);
    SharedTextures shared;
    const Settings settings(commonSettings());
    framegraph::Graph graph;
    const View view;
    const scene::AreaLight light;
    scene::CasterGroups groups;
    scene::CasterSilhouettes silhouettes;
    const LightScene scene{.capabilities = (*context)->capabilities(),
                           .settings = settings,
                           .screen = view,
                           .name = "light 0",
                           .light = light,
                           .groups = groups,
                           .silhouettes = silhouettes};
    LightPasses passes(std::make_unique<FilterPlanner>(size, source, filter, widestTexels));
    Device device{**context, programs, shared};
    Status status = passes.prepare(scene);
    if (status) status = passes.upload(device);
    EXPECT_TRUE(status) << status.error().message;
    FramePasses frame{view, graph};
    const framegraph::ResourceId filtered = passes.declare(frame).textures[0].resource;
    graph.markOutput(filtered);
    gl::Encoder encoder(**context);
    framegraph::Executor executor(**context);
    const auto plan = framegraph::compile(
        graph, [&](const framegraph::ResourceDesc& desc) { return executor.contentKeyOf(desc); });
    EXPECT_TRUE(plan.ok());
    const auto reports = executor.run(graph, *plan, encoder, framegraph::PassTiming::off);
    EXPECT_TRUE(reports.ok());
    const framegraph::ResourceDesc& desc = graph.resources()[filtered.index];
    Filtered result{.width = desc.width, .height = desc.height};
    result.pixels.resize(4u * static_cast<std::size_t>(desc.width) * static_cast<std::size_t>(desc.height));
    encoder.readPixels(*executor.framebufferFor(graph, filtered), {0, 0, desc.width, desc.height},
                       result.pixels.data());
    return result;
  }

  static Pixels randomPixels(int size, const std::function<std::uint8_t(std::mt19937&)>& value) {
    std::mt19937 random(static_cast<unsigned>(size));
    Pixels pixels(4u * static_cast<std::size_t>(size) * static_cast<std::size_t>(size));
    for (std::uint8_t& byte : pixels) byte = value(random);
    return pixels;
  }

  /// Compares all sums with 64-bit integers; `countOf` turns a byte into its count.
  static void expectExactSums(int size, const Pixels& source, const Filtered& sums,
                              const std::function<std::uint32_t(int)>& countOf) {
    std::size_t wrong = 0;
    for (int channel = 0; channel < 4; ++channel) {
      std::vector<std::uint64_t> above(static_cast<std::size_t>(size), 0);
      for (int y = 0; y < size; ++y) {
        std::uint64_t row = 0;
        for (int x = 0; x < size; ++x) {
          row += countOf(
              source[4u * static_cast<std::size_t>(y * size + x) + static_cast<std::size_t>(channel)]);
          std::uint64_t& sum = above[static_cast<std::size_t>(x)];
          sum += row;
          const std::size_t at = sums.at(x + channel % 2 * size, y + channel / 2 * size);
          const std::uint64_t stored =
              sums.pixels[at] * 65536u + sums.pixels[at + 1] * 256u + sums.pixels[at + 2];
          wrong += stored != sum;
        }
      }
    }
    EXPECT_EQ(wrong, 0u) << "of " << 4 * size * size << " sums";
  }
};

TEST_F(SliceFilterTest, SummedAreaTablesOfBinarySlicesAreExact) {
  for (const int size : {64, 256}) {
    const Pixels binary =
        randomPixels(size, [](std::mt19937& random) { return random() % 3 == 0 ? 255 : 0; });
    expectExactSums(size, binary, filter(size, binary, SliceFilter::summedArea, 8),
                    [](int byte) { return static_cast<std::uint32_t>(byte); });
  }
}

// The largest total: 256 x 256 full texels count 255 each, 16,711,680 of 16,777,215.
TEST_F(SliceFilterTest, SummedAreaTablesOfFullSlicesDoNotOverflow) {
  const Pixels full(4u * 256 * 256, 255);
  expectExactSums(256, full, filter(256, full, SliceFilter::summedArea, 8),
                  [](int byte) { return static_cast<std::uint32_t>(byte); });
}

TEST_F(SliceFilterTest, SummedAreaTablesOfPartlyCoveredTexelsAreExactInTheirQuantum) {
  const Pixels any =
      randomPixels(128, [](std::mt19937& random) { return static_cast<std::uint8_t>(random()); });
  expectExactSums(128, any, filter(128, any, SliceFilter::summedArea, 8),
                  [](int byte) { return static_cast<std::uint32_t>(byte); });
  // 512 texels a side leave 24 - 18 bits for a texel: it counts up to 63.
  const Pixels large = randomPixels(512, [](std::mt19937& random) { return random() % 3 == 0 ? 255 : 0; });
  expectExactSums(512, large, filter(512, large, SliceFilter::summedArea, 8),
                  [](int byte) { return byte == 255 ? 63u : 0u; });
}

// Bytes and carries stay whole numbers below 2048, which fp16 holds.
TEST_F(SliceFilterTest, SummedAreaTablesAreExactWithoutHighp) {
  const Pixels binary = randomPixels(256, [](std::mt19937& random) { return random() % 3 == 0 ? 255 : 0; });
  gl::ContextOptions options;
  options.forcedOff = {device::Capability::highp};
  expectExactSums(256, binary, filter(256, binary, SliceFilter::summedArea, 8, options),
                  [](int byte) { return static_cast<std::uint32_t>(byte); });
}

TEST_F(SliceFilterTest, NBufferLevelsAreMeansOverSquaresAtEveryPlace) {
  constexpr int kSize = 64, kPad = 5, kSide = kSize + 2 * kPad + 1, kLastFull = 3;
  const Pixels source = randomPixels(kSize, [](std::mt19937& random) { return random() % 3 == 0 ? 255 : 0; });
  // The map's border is empty, as slicing leaves it.
  Pixels bordered = source;
  for (int y = 0; y < kSize; ++y) {
    for (int x = 0; x < kSize; ++x) {
      if (std::min({x, y, kSize - 1 - x, kSize - 1 - y}) >= 3) continue;
      for (int c = 0; c < 4; ++c)
        bordered[4u * static_cast<std::size_t>(y * kSize + x) + static_cast<std::size_t>(c)] = 0;
    }
  }
  const Filtered atlas = filter(kSize, bordered, SliceFilter::nbuffer, 64.0);
  int y0 = 0;
  for (int level = 0; level <= 6; ++level) {
    const int stride = level <= kLastFull ? 1 : 1 << (level - kLastFull);
    const int side = kSize / stride + 2 * kPad + 1;
    const int originX = level <= kLastFull ? level % 2 * kSide : 2 * kSide;
    const int originY = level <= kLastFull ? level / 2 * kSide : y0;
    if (level > kLastFull) y0 += side;
    double worst = 0.0;
    for (int j = 0; j < side; ++j) {
      for (int i = 0; i < side; ++i) {
        // Texels from low to low + 2^level, those outside the map empty.
        const int lowX = (i - kPad) * stride - (1 << level) / 2,
                  lowY = (j - kPad) * stride - (1 << level) / 2;
        double sum = 0.0;
        for (int y = std::max(lowY, 0); y < std::min(lowY + (1 << level), kSize); ++y) {
          for (int x = std::max(lowX, 0); x < std::min(lowX + (1 << level), kSize); ++x)
            sum += bordered[4u * static_cast<std::size_t>(y * kSize + x)];
        }
        const double mean = sum / (1 << (2 * level));
        worst = std::max(worst, std::abs(mean - atlas.pixels[atlas.at(originX + i, originY + j)]));
      }
    }
    // Each level rounds (or truncates) once more; a mean of four keeps the error of the level before.
    EXPECT_LE(worst, 1.0 * level + 1e-9) << "level " << level;
  }
}

TEST_F(SliceFilterTest, MipmapsKeepTheMeanOfTheMap) {
  const Pixels source = randomPixels(64, [](std::mt19937& random) { return random() % 3 == 0 ? 255 : 0; });
  const Filtered atlas = filter(64, source, SliceFilter::mipmap, 32.0);
  double mean = 0.0;
  for (std::size_t i = 0; i < source.size(); i += 4) mean += source[i] / 4096.0;
  // Level 5: 2 x 2 texels in the column on the right, below four others with gutters of 2.
  double coarse = 0.0;
  const int x0 = 64 + 3, y0 = 1 + 64 - 2 * 2 + 2 * (5 - 1);
  for (int y = 0; y < 2; ++y) {
    for (int x = 0; x < 2; ++x) coarse += atlas.pixels[atlas.at(x0 + x, y0 + y)] / 4.0;
  }
  // Five levels of rounding or truncation.
  EXPECT_NEAR(coarse, mean, 5.0);
}

}  // namespace
}  // namespace halfshadow::techniques
