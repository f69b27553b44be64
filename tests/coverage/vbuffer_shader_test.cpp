// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// vbuffer_edges.glsl and vbuffer_merge.glsl, rendered, against their twin on the CPU.
#include <random>

#include "coverage/trapezoid.hpp"
#include "coverage/vbuffer.hpp"
#include "gl/embedded_shaders.hpp"
#include "gl/program.hpp"
#include "gl_fixture.hpp"

namespace halfshadow::test {
namespace {
using coverage::FlatPoint;
using coverage::QuadrantOcclusion;

constexpr int kSide = 48;     // cases along a side of the target
constexpr int kVertices = 8;  // of a loop
using Polygon = std::vector<FlatPoint<double>>;

constexpr const char* kVertex =
    "attribute highp vec2 a_position;\nvoid main() { gl_Position = vec4(a_position, 0.0, 1.0); }\n";
// Fragment (x, y) walks the loop of eight texels at its place, and that of the row above it.
constexpr const char* kFragment = R"(
#include "list/vbuffer_edges.glsl"
#include "list/vbuffer_merge.glsl"
uniform HS_HIGHP sampler2D u_loops;
HS_HIGHP vec2 vertexAt(HS_HIGHP float k, HS_HIGHP float row) {
  HS_HIGHP vec2 at = vec2(floor(gl_FragCoord.x) * 8.0 + k + 0.5, mod(floor(gl_FragCoord.y) + row, HS_SIDE) + 0.5);
  HS_HIGHP vec4 bytes = floor(texture2D(u_loops, at / vec2(8.0 * HS_SIDE, HS_SIDE)) * 255.0 + 0.5);
  return (bytes.xz - 128.0) * (1.0 / 32.0) + bytes.yw * (1.0 / 8192.0);
}
HS_Occlusion occlusionOf(HS_HIGHP float row) {
  HS_Sums sums;
  hs_clearSums(sums);
  HS_HIGHP vec2 previous = vertexAt(7.0, row);
  // Long enough not to be unrolled, which would take the compiler seconds.
  for (int k = 0; k < 64; ++k) {
    if (k == 8) break;
    HS_HIGHP vec2 vertex = vertexAt(float(k), row);
    hs_addEdge(sums, previous, vertex);
    previous = vertex;
  }
  return hs_occlusion(sums);
}
void main() {
  HS_Occlusion one = occlusionOf(0.0);
  HS_Occlusion both = hs_merge(one, occlusionOf(1.0));
  gl_FragColor = HS_SHOWN;
}
)";

struct Image {
  std::vector<std::uint8_t> rgba;
  double at(int x, int y, int channel) const {
    return rgba[static_cast<std::size_t>((y * kSide + x) * 4 + channel)] / 255.0;
  }
};

class VBufferShader : public GlTest {
 protected:
  void SetUp() override {
    GlTest::SetUp();
    std::mt19937 random(31);
    std::uniform_real_distribution<double> place(-1.3, 1.3), jitter(0.0, 0.7), logRadius(-1.2, 0.3);
    for (int i = 0; i < kSide * kSide; ++i) {
      const double x = place(random), y = place(random), radius = std::pow(10.0, logRadius(random));
      Polygon polygon;
      for (int k = 0; k < kVertices; ++k) {
        const double angle = (k + jitter(random)) * 2 * 3.14159265358979 / kVertices;
        polygon.push_back({stored(x + radius * std::cos(angle)), stored(y + radius * std::sin(angle))});
      }
      polygons_.push_back(polygon);
    }
  }
  /// The multiple of 1/8192 that the texture keeps.
  static double stored(double value) { return std::round(std::clamp(value, -3.9, 3.9) * 8192) / 8192; }

  /// One expression of the shader's main() for all cases.
  Result<Image> render(gl::Context& on, const char* shown, bool centres) {
    const gl::ShaderSourceProvider provider = [](std::string_view name) -> const char* {
      if (name == "loops.vert") return kVertex;
      if (name == "loops.frag") return kFragment;
      return gl::embeddedShader(name);
    };
    gl::ProgramCache programs(on, provider);
    std::vector<std::string> defines{"HS_SIDE " + std::to_string(kSide) + ".0",
                                     std::string("HS_SHOWN ") + shown};
    if (centres) defines.push_back("HS_CENTRES");
    auto program = programs.get({"loops.vert", "loops.frag", defines});
    if (!program) return program.error();
    std::vector<std::uint8_t> texels;
    for (int y = 0; y < kSide; ++y) {
      for (int x = 0; x < kSide; ++x) {
        for (const FlatPoint<double>& p : polygons_[static_cast<std::size_t>(y * kSide + x)]) {
          for (const double value : {p.x, p.y}) {
            const int steps = static_cast<int>(std::lround(value * 8192)) + 32768;
            texels.push_back(static_cast<std::uint8_t>(steps >> 8));
            texels.push_back(static_cast<std::uint8_t>(steps & 255));
          }
        }
      }
    }
    auto loops = gl::Texture::create(on, {.width = kVertices * kSide, .height = kSide}, texels.data());
    auto target = gl::Texture::create(on, {.width = kSide, .height = kSide});
    if (!loops || !target) return Error{ErrorCode::outOfMemory, "no textures"};
    auto framebuffer = gl::Framebuffer::create(on, {.color = &*target});
    if (!framebuffer) return framebuffer.error();
    Image image;
    image.rgba.resize(static_cast<std::size_t>(kSide * kSide * 4));
    gl::Encoder encoder(on);
    encoder.beginFrame();
    encoder.beginPass({.framebuffer = &*framebuffer, .viewport = {0, 0, kSide, kSide}});
    encoder.useProgram(**program);
    const gl::TextureBinding binding{(*program)->samplerUnit("u_loops"), &*loops};
    encoder.bindTextures({&binding, 1});
    encoder.drawFullscreen({});
    encoder.readPixels(*framebuffer, {0, 0, kSide, kSide}, image.rgba.data());
    encoder.endPass({});
    return image;
  }

  /// The twin's quadrant in the shader's order and orientation: local x and y grow to the right and upwards.
  QuadrantOcclusion<double> twin(int x, int y, int channel) const {
    constexpr int kTwinOf[] = {2, 3, 1, 0};
    const Polygon& polygon = polygons_[static_cast<std::size_t>((y % kSide) * kSide + x)];
    coverage::QuadrantSums<double> sums;
    int winding = 0;
    for (std::size_t k = 0; k < polygon.size(); ++k) {
      const FlatPoint<double>&p = polygon[k], &q = polygon[(k + 1) % polygon.size()];
      const coverage::Projected<double> q0{p.x, p.y, 1}, q1{q.x, q.y, 1};
      winding += coverage::centreCrossing(q0, q1);
      coverage::addEdge(sums, coverage::clipToQuadrant(coverage::clipToLight(q0, q1), kTwinOf[channel]));
    }
    QuadrantOcclusion<double> result = coverage::resolved(sums, double(winding));
    if (channel % 2 == 0) {
      const coverage::Bounds<double> b = result.bounds;
      result.bounds.left = 1 - b.right, result.bounds.right = 1 - b.left;
      result.centreU = 1 - result.centreU;
    }
    if (channel < 2) {
      const coverage::Bounds<double> b = result.bounds;
      result.bounds.bottom = 1 - b.top, result.bounds.top = 1 - b.bottom;
      result.centreV = 1 - result.centreV;
    }
    return result;
  }

  /// Differences over quadrants that `counts`: the worst but `outliers` of them, and their mean.
  template <typename Expected, typename Counts>
  void compare(const Image& image, double tolerance, double outliers, const char* what, Expected expected,
               Counts counts) {
    double sum = 0;
    int count = 0, beyond = 0;
    for (int i = 0; i < kSide * kSide; ++i) {
      const int x = i % kSide, y = i / kSide;
      for (int channel = 0; channel < 4; ++channel) {
        if (!counts(x, y, channel)) continue;
        const double error = std::abs(image.at(x, y, channel) - expected(x, y, channel));
        beyond += error > tolerance ? 1 : 0;
        sum += error;
        ++count;
      }
    }
    ASSERT_GT(count, 1'000) << what;
    EXPECT_LE(beyond, outliers * count) << what;
    EXPECT_LE(sum / count, tolerance / 2) << what;
  }

  /// `steps` of 8 bits as tolerance for shares; centres are quotients of them.
  enum class Outputs { all, some };
  void compareAll(gl::Context& on, bool centres, double steps, double outliers, Outputs outputs) {
    const auto all = [](int, int, int) { return true; };
    const auto some = [&](int x, int y, int channel) { return twin(x, y, channel).share > 0.02; };
    const auto someOfBoth = [&](int x, int y, int channel) {
      return some(x, y, channel) && some(x, y + 1, channel);
    };
    const auto how = centres ? coverage::Centres::used : coverage::Centres::ignored;
    const auto merged = [&](int x, int y, int channel) {
      return coverage::mergedQuadrant(twin(x, y, channel), twin(x, y + 1, channel), how);
    };
    const double tolerance = steps / 255;
    const auto shown = [&](const char* what) {
      auto image = render(on, what, centres);
      EXPECT_TRUE(image) << (image ? "" : image.error().message);
      return image ? *image : Image{std::vector<std::uint8_t>(kSide * kSide * 4)};
    };
    compare(
        shown("one.share"), tolerance, outliers, "share",
        [&](int x, int y, int c) { return twin(x, y, c).share; }, all);
    compare(
        shown("vec4(one.left.xy, one.top.zw)"), tolerance, outliers, "left, top",
        [&](int x, int y, int c) {
          const auto bounds = twin(x, y, c).bounds;
          return c < 2 ? bounds.left : bounds.top;
        },
        some);
    if (outputs == Outputs::all) {
      compare(
          shown("vec4(one.right.xy, one.bottom.zw)"), tolerance, outliers, "right, bottom",
          [&](int x, int y, int c) {
            const auto bounds = twin(x, y, c).bounds;
            return c < 2 ? bounds.right : bounds.bottom;
          },
          some);
      compare(
          shown("both.share"), 2 * tolerance, outliers, "merged share",
          [&](int x, int y, int c) { return merged(x, y, c).share; }, someOfBoth);
    }
    if (centres && outputs == Outputs::all) {
      compare(
          shown("vec4(one.centreX.xy, one.centreY.zw)"), 3 * tolerance, outliers, "centre",
          [&](int x, int y, int c) {
            const auto q = twin(x, y, c);
            return c < 2 ? q.centreU : q.centreV;
          },
          some);
    }
    if (!centres) return;
    compare(
        shown("vec4(both.centreX.xy, both.centreY.zw)"), 3 * tolerance, outliers, "merged centre",
        [&](int x, int y, int c) {
          const auto q = merged(x, y, c);
          return c < 2 ? q.centreU : q.centreV;
        },
        someOfBoth);
  }

  std::vector<Polygon> polygons_;
};

TEST_F(VBufferShader, HighpIsTheTwinToEightBits) {
  if (!capabilities().has(device::Capability::highp)) GTEST_SKIP() << "this driver has no highp in fragments";
  // Half a step of storage, and as much again for the arithmetic.
  compareAll(context(), false, 1.0, 0.0, Outputs::all);
  compareAll(context(), true, 1.0, 0.0, Outputs::all);
}

TEST_F(VBufferShader, MediumpIsTheTwinToItsTenBits) {
  auto medium = makeContext({.forcedOff = {device::Capability::highp}});
  ASSERT_TRUE(medium) << medium.error().message;
  // Coordinates up to 4 have steps of 1/512 in fp16, and quotients of them several; an edge that grazes a
  // quadrant may be taken for one that misses it. (Few outputs: llvmpipe
  // takes seconds to compile each in fp16.)
  compareAll(**medium, true, 8.0, 0.01, Outputs::some);
}

}  // namespace
}  // namespace halfshadow::test
