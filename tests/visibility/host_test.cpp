// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// The engine as a guest in the host's context: its target, its state, its objects.
#include <algorithm>
#include <array>
#include <cstring>
#include <map>

#include "analytic_scenes.hpp"
#include "gl/state_list.hpp"

namespace halfshadow::test {
namespace {

/// Calls of each entry point, by name; of glGen… and glDelete… the number of names.
std::map<std::string, int>& calls() {
  static std::map<std::string, int> counted;
  return counted;
}

template <int index, typename Function>
struct Counted;
template <int index, typename Returned, typename... Arguments>
struct Counted<index, Returned (*)(Arguments...)> {
  static inline Returned (*real)(Arguments...) = nullptr;
  static inline const char* name = "";
  static Returned GL_APIENTRY call(Arguments... arguments) {
    int count = 1;
    if constexpr (sizeof...(Arguments) == 2) {
      const auto first = std::get<0>(std::tuple<Arguments...>(arguments...));
      const bool plural = name[std::strlen(name) - 1] == 's';
      if (plural && (std::strncmp(name, "glGen", 5) == 0 || std::strncmp(name, "glDelete", 8) == 0)) {
        if constexpr (std::is_integral_v<decltype(first)>) count = static_cast<int>(first);
      }
    }
    calls()[name] += count;
    return real(arguments...);
  }
};

/// The driver's function with a counter before it.
void* countedFunction(const char* wanted, void*) {
  void* address = headless()->getProcAddress(wanted);
#define HALFSHADOW_COUNT(member, glName)                            \
  if (address != nullptr && std::strcmp(wanted, #glName) == 0) {    \
    using Wrapper = Counted<__COUNTER__, decltype(&::glName)>;      \
    Wrapper::real = reinterpret_cast<decltype(&::glName)>(address); \
    Wrapper::name = #glName;                                        \
    return reinterpret_cast<void*>(&Wrapper::call);                 \
  }
  HALFSHADOW_GL_CORE_FUNCTIONS(HALFSHADOW_COUNT)
#undef HALFSHADOW_COUNT
  return address;
}

int callsOf(const std::string& prefix) {
  int sum = 0;
  for (const auto& [name, count] : calls()) sum += name.starts_with(prefix) ? count : 0;
  return sum;
}

std::unique_ptr<SceneRenderer> countedRenderer() {
  const std::vector<std::string> forced = forcedOffByEnvironment();
  std::vector<const char*> names;
  for (const std::string& name : forced) names.push_back(name.c_str());
  calls().clear();
  Outcome outcome;
  std::unique_ptr<Engine> engine(Engine::create(
      {.getProcAddress = countedFunction, .forcedOff = names.data(), .forcedOffCount = names.size()},
      outcome));
  EXPECT_TRUE(outcome.ok()) << outcome.message;
  return std::make_unique<SceneRenderer>(std::move(engine));
}

const std::vector<OptOut> kNoOptOuts;

/// A host's framebuffer: RGBA8 and 16-bit depth, filled with one colour.
class HostFramebuffer {
 public:
  static constexpr int kSide = 256;
  HostFramebuffer() {
    const gl::Functions& gl = hostGl();
    gl.genTextures(1, &color_);
    gl.bindTexture(GL_TEXTURE_2D, color_);
    gl.texImage2D(GL_TEXTURE_2D, 0, GL_RGBA, kSide, kSide, 0, GL_RGBA, GL_UNSIGNED_BYTE, nullptr);
    gl.texParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    gl.genRenderbuffers(1, &depth_);
    gl.bindRenderbuffer(GL_RENDERBUFFER, depth_);
    gl.renderbufferStorage(GL_RENDERBUFFER, GL_DEPTH_COMPONENT16, kSide, kSide);
    gl.genFramebuffers(1, &name_);
    gl.bindFramebuffer(GL_FRAMEBUFFER, name_);
    gl.framebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, color_, 0);
    gl.framebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, depth_);
    gl.clearColor(0.2f, 0.4f, 0.6f, 0.8f);
    gl.clear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
  }
  ~HostFramebuffer() {
    const gl::Functions& gl = hostGl();
    gl.bindFramebuffer(GL_FRAMEBUFFER, 0);
    gl.bindRenderbuffer(GL_RENDERBUFFER, 0);
    gl.bindTexture(GL_TEXTURE_2D, 0);
    gl.deleteFramebuffers(1, &name_);
    gl.deleteRenderbuffers(1, &depth_);
    gl.deleteTextures(1, &color_);
  }
  GLuint name() const { return name_; }
  /// Row 0 at the bottom, as OpenGL ES has it.
  std::vector<std::array<std::uint8_t, 4>> pixels() const {
    std::vector<std::array<std::uint8_t, 4>> read(kSide * kSide);
    hostGl().bindFramebuffer(GL_FRAMEBUFFER, name_);
    hostGl().readPixels(0, 0, kSide, kSide, GL_RGBA, GL_UNSIGNED_BYTE, read.data());
    return read;
  }

 private:
  GLuint color_ = 0, depth_ = 0, name_ = 0;
};

class Host : public EngineTest {
 protected:
  static void expectState(const gl::state::StateValues& expected, const std::string& after) {
    const gl::state::StateValues now = gl::state::captureState(hostGl());
    gl::state::forEachState([&]<typename State, std::size_t i>() {
      EXPECT_TRUE(std::get<i>(now) == std::get<i>(expected))
          << State::kName << " is not what the host left, after " << after << ": "
          << testing::PrintToString(std::get<i>(now));
    });
  }
};

TEST_F(Host, FramebufferIsUntouchedOutsideTheRectangleAndHoldsTheImageInside) {
  SceneRenderer renderer(makeEngine());
  renderer.load(builtinScene("figure@light=1"));
  for (const std::string& technique : techniquesBut(renderer.engine(), kNoOptOuts)) {
    const Image expected = renderer.render(Configuration{technique});
    const HostFramebuffer target;
    RenderDesc desc = renderer.desc();
    desc.target = {.kind = TargetDesc::Kind::host,
                   .framebuffer = target.name(),
                   .x = 37,
                   .y = 51,
                   .width = kWidth,
                   .height = kHeight};
    FrameReport report;
    const Outcome outcome = renderer.engine().render(desc, report);
    ASSERT_TRUE(outcome.ok()) << outcome.message;
    const auto pixels = target.pixels();
    int outside = 0, inside = 0;
    for (int y = 0; y < HostFramebuffer::kSide; ++y) {
      for (int x = 0; x < HostFramebuffer::kSide; ++x) {
        const auto& pixel = pixels[static_cast<std::size_t>(y * HostFramebuffer::kSide + x)];
        const int column = x - 37, row = kHeight - 1 - (y - 51);
        if (column < 0 || column >= kWidth || row < 0 || row >= kHeight) {
          outside += pixel != std::array<std::uint8_t, 4>{51, 102, 153, 204};
        } else {
          inside += pixel[0] != expected.byte(static_cast<std::size_t>(row * kWidth + column));
        }
      }
    }
    EXPECT_EQ(outside, 0) << technique;
    // 16 bits of depth instead of 24 decide differently only where two surfaces nearly touch.
    EXPECT_LE(inside, 5) << technique;
  }
}

TEST_F(Host, StateSurvivesEveryCall) {
  const gl::Functions& gl = hostGl();
  const HostFramebuffer framebuffer;
  const gl::state::StateValues initial = gl::state::captureState(gl);
  GLuint buffer = 0;
  gl.genBuffers(1, &buffer);
  gl.bindBuffer(GL_ARRAY_BUFFER, buffer);
  gl.enable(GL_BLEND);
  gl.enable(GL_CULL_FACE);
  gl.enable(GL_SCISSOR_TEST);
  gl.enable(GL_POLYGON_OFFSET_FILL);
  gl.scissor(1, 2, 3, 4);
  gl.viewport(5, 6, 7, 8);
  gl.colorMask(GL_FALSE, GL_TRUE, GL_FALSE, GL_TRUE);
  gl.depthFunc(GL_NEVER);
  gl.depthMask(GL_FALSE);
  gl.frontFace(GL_CW);
  gl.cullFace(GL_FRONT);
  gl.polygonOffset(3.0f, 100.0f);
  gl.clearColor(0.1f, 0.2f, 0.3f, 0.4f);
  gl.pixelStorei(GL_UNPACK_ALIGNMENT, 2);
  gl.activeTexture(GL_TEXTURE3);
  gl.bindFramebuffer(GL_FRAMEBUFFER, framebuffer.name());
  const gl::state::StateValues hostile = gl::state::captureState(gl);
  {
    SceneRenderer renderer(makeEngine());
    expectState(hostile, "Engine::create");
    renderer.load(PlateOverGround().scene());
    expectState(hostile, "addObject, setLights");
    for (const std::string& technique : techniquesBut(renderer.engine(), kNoOptOuts)) {
      const Image image = renderer.render(Configuration{technique});
      expectState(hostile, technique);
      // vsm's bound stays above 0 where the depths behind the plate vary at all.
      const bool shadowed = std::ranges::count_if(image.rgba, [](std::uint8_t v) { return v <= 8; }) > 1000;
      EXPECT_EQ(shadowed, technique != "none") << technique << " under the host's state";
    }
  }
  expectState(hostile, "~Engine");
  gl::state::applyState(gl, initial);
  gl.deleteBuffers(1, &buffer);
}

TEST_F(Host, EveryObjectIsDeleted) {
  auto renderer = countedRenderer();
  const int before = renderer->engine().liveObjectCount();
  renderer->load(builtinScene("figure@light=1"));
  for (const std::string& technique : techniquesBut(renderer->engine(), kNoOptOuts))
    renderer->render(Configuration{technique});
  EXPECT_GT(renderer->engine().liveObjectCount(), before);
  renderer.reset();
  for (const char* kind : {"Textures", "Buffers", "Framebuffers", "Renderbuffers"}) {
    EXPECT_GT(callsOf("glGen" + std::string(kind)), 0) << kind;
    EXPECT_EQ(callsOf("glGen" + std::string(kind)), callsOf("glDelete" + std::string(kind))) << kind;
  }
  EXPECT_EQ(callsOf("glCreateProgram"), callsOf("glDeleteProgram"));
  EXPECT_EQ(callsOf("glCreateShader"), callsOf("glDeleteShader"));
}

TEST_F(Host, LostContextIsNotCalled) {
  auto renderer = countedRenderer();
  renderer->load(PlateOverGround().scene());
  for (const std::string& technique : techniquesBut(renderer->engine(), kNoOptOuts))
    renderer->render(Configuration{technique});
  renderer->engine().contextLost();
  const auto atLoss = calls();
  FrameReport report;
  const Outcome outcome = renderer->engine().render(renderer->desc(), report);
  EXPECT_EQ(outcome.code, ErrorCode::contextLost) << outcome.message;
  std::vector<std::uint8_t> pixels(4 * kWidth * kHeight);
  EXPECT_EQ(renderer->engine().readOutput(pixels.data(), pixels.size()).code, ErrorCode::contextLost);
  EXPECT_TRUE(renderer->engine().removeObject(renderer->id(0)).ok());
  renderer->engine().finish();
  renderer.reset();
  EXPECT_EQ(calls(), atLoss) << "no OpenGL ES call after the loss";
}

TEST_F(Host, RemovedObjectsAndReplacedScenesDoNotGrow) {
  SceneRenderer renderer(makeEngine());
  renderer.load(builtinScene("figure@light=1"));
  renderer.render(Configuration{"pcss-mip"});
  const int once = renderer.engine().liveObjectCount();
  for (int i = 0; i < 3; ++i) {
    renderer.load(builtinScene("figure@light=1"));
    renderer.render();
  }
  EXPECT_EQ(renderer.engine().liveObjectCount(), once);
}

}  // namespace
}  // namespace halfshadow::test
