// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// A host that draws receivers with its own shaders gets the engine's own visibility.
#include <gtest/gtest.h>

#include <cstring>

#include "gl_fixture.hpp"
#include "halfshadow/halfshadow.hpp"
#include "scenes/scene_source.hpp"

namespace halfshadow::test {
namespace {
constexpr int kWidth = 192, kHeight = 144;

class Forward : public GlTest, public testing::WithParamInterface<const char*> {
 protected:
  void SetUp() override {
    GlTest::SetUp();
    auto opened = scenes::openScene("builtin:figure@light=0.3", {});
    ASSERT_TRUE(opened.ok());
    scene_ = *opened;
    Outcome outcome;
    EngineDesc desc;
    desc.getProcAddress = [](const char* name, void* user) {
      return static_cast<HeadlessContext*>(user)->getProcAddress(name);
    };
    desc.getProcAddressUser = &headless();
    engine_.reset(Engine::create(desc, outcome));
    ASSERT_TRUE(outcome.ok()) << outcome.message;
    for (const scene::SceneObject& object : scene_.objects) {
      ObjectDesc added;
      added.mesh = {.positions = &object.mesh->positions[0].x,
                    .vertexCount = static_cast<std::uint32_t>(object.mesh->positions.size()),
                    .indices = object.mesh->indices.data(),
                    .indexCount = object.mesh->indices.size()};
      std::memcpy(added.worldFromObject, &object.worldFromObject[0][0], sizeof added.worldFromObject);
      added.casts = object.casts;
      ObjectId id = 0;
      ASSERT_TRUE(engine_->addObject(added, id).ok());
    }
    const scene::AreaLight& light = scene_.lights.front();
    LightDesc lightDesc;
    for (int i = 0; i < 3; ++i) {
      lightDesc.center[i] = light.centerWorld[i];
      lightDesc.halfU[i] = light.halfU[i];
      lightDesc.halfV[i] = light.halfV[i];
      frame_.camera.eye[i] = scene_.camera->eyeWorld[i];
      frame_.camera.target[i] = scene_.camera->targetWorld[i];
      frame_.camera.up[i] = scene_.camera->up[i];
    }
    frame_.camera.verticalFovRadians = scene_.camera->verticalFovRadians;
    frame_.camera.nearDistance = scene_.camera->nearDistance;
    frame_.camera.farDistance = scene_.camera->farDistance;
    frame_.target.width = kWidth;
    frame_.target.height = kHeight;
    ASSERT_TRUE(engine_->setLights(&lightDesc, 1).ok());
  }
  void TearDown() override {
    engine_.reset();
    GlTest::TearDown();
  }

  Outcome render(Output output) {
    frame_.output = output;
    return engine_->render(frame_, report_);
  }

  /// The scene drawn by the host: its own program, buffers and framebuffer.
  std::vector<std::uint8_t> drawnByHost(const ForwardRecord& forward);

  scene::SceneDescription scene_;
  std::unique_ptr<Engine> engine_;
  RenderDesc frame_;
  FrameReport report_;
};

std::vector<std::uint8_t> Forward::drawnByHost(const ForwardRecord& forward) {
  gl::Context& gl = context();
  gl::Encoder encoder(gl);
  const std::string vertex = std::string("#version 100\n") + forward.vertexGlsl +
                             "attribute highp vec3 a_position;\nuniform highp mat4 u_hostClipFromObject;\n"
                             "invariant gl_Position;\nvoid main() {\n"
                             "  gl_Position = u_hostClipFromObject * vec4(a_position, 1.0);\n"
                             "  halfshadow_receive(vec4(a_position, 1.0), vec3(0.0));\n}\n";
  const std::string fragment = std::string("#version 100\n") + forward.fragmentGlsl +
                               "void main() { gl_FragColor = vec4(halfshadow_visibility()); }\n";
  auto program = gl::Program::link(gl, vertex, fragment, {}, "the host's");
  EXPECT_TRUE(program.ok()) << program.error().message;
  if (!program) return {};
  auto color = gl::Texture::create(gl, {.width = kWidth, .height = kHeight});
  auto depth = gl::Renderbuffer::create(gl, kWidth, kHeight, gl::RenderbufferFormat::depth24);
  EXPECT_TRUE(color.ok() && depth.ok());
  auto framebuffer = gl::Framebuffer::create(gl, {.color = &*color, .depth = &*depth});
  EXPECT_TRUE(framebuffer.ok());
  std::vector<gl::Buffer> buffers;
  for (const scene::SceneObject& object : scene_.objects) {
    std::vector<glm::vec3> corners;
    for (const std::uint32_t index : object.mesh->indices) corners.push_back(object.mesh->positions[index]);
    auto buffer = gl::Buffer::create(gl, gl::BufferTarget::vertex, std::as_bytes(std::span(corners)),
                                     gl::BufferUsage::staticDraw);
    EXPECT_TRUE(buffer.ok());
    buffers.push_back(std::move(buffer).value());
  }
  const glm::dmat4 clipFromWorld =
      scene::clipFromView(*scene_.camera, static_cast<double>(kWidth) / kHeight) *
      scene::viewFromWorld(*scene_.camera);
  encoder.beginFrame();
  encoder.beginPass({.framebuffer = &*framebuffer,
                     .viewport = {0, 0, kWidth, kHeight},
                     .clear = {.color = glm::vec4(1.0f), .depth = 1.0f}});
  for (std::size_t i = 0; i < buffers.size(); ++i) {
    const scene::SceneObject& object = scene_.objects[i];
    encoder.useProgram(*program);
    program->set(gl, "u_hostClipFromObject", glm::mat4(clipFromWorld * object.worldFromObject));
    // From unit 2 on: what the host keeps in units 0 and 1 must not matter.
    const Outcome bound = engine_->bindForward(0, program->name(), &object.worldFromObject[0][0], 2);
    EXPECT_TRUE(bound.ok()) << bound.message;
    const gl::AttributeBinding attribute{gl::VertexAttribute::position, &buffers[i], 3,
                                         gl::AttributeType::float32,    12,          0};
    encoder.draw({.depth = {.test = gl::Compare::less, .write = true}},
                 {.attributes = {&attribute, 1}, .count = buffers[i].byteCount() / 12});
  }
  std::vector<std::uint8_t> pixels(kWidth * kHeight * 4);
  encoder.readPixels(*framebuffer, {0, 0, kWidth, kHeight}, pixels.data());
  return pixels;
}

TEST_P(Forward, isTheImageOfTheScreenSpaceRoute) {
  ASSERT_TRUE(engine_->setTechnique(GetParam()).ok());
  ASSERT_TRUE(render(Output::visibility).ok());
  std::vector<std::uint8_t> own(kWidth * kHeight * 4);
  ASSERT_TRUE(engine_->readOutput(own.data(), own.size()).ok());

  const Outcome lights = render(Output::lightsOnly);
  ASSERT_TRUE(lights.ok()) << lights.message;
  for (std::size_t i = 0; i < report_.passCount; ++i)
    EXPECT_TRUE(report_.passes[i].lightSpace) << report_.passes[i].name;
  ForwardRecord forward;
  const Outcome asked = engine_->forwardSource(0, forward);
  ASSERT_TRUE(asked.ok()) << asked.message;
  if (forward.readsFacetNormal)
    GTEST_SKIP() << "derivatives or highp are missing: this host passes no facet normals";
  const std::vector<std::uint8_t> host = drawnByHost(forward);
  ASSERT_EQ(host.size(), own.size());

  std::size_t differing = 0, shadowed = 0;
  for (std::size_t y = 0; y < kHeight; ++y) {
    for (std::size_t x = 0; x < kWidth; ++x) {
      const int engineByte = own[(y * kWidth + x) * 4], hostByte = host[((kHeight - 1 - y) * kWidth + x) * 4];
      differing += std::abs(engineByte - hostByte) > 1;
      shadowed += engineByte < 128;
    }
  }
  EXPECT_GT(shadowed, 200u) << "the comparison must see a shadow";
  // The engine takes facet normals from vertices where the host uses derivatives, and searches blockers on
  // casters by taps: a plane that differs in the last bit moves single taps. On 27,648 pixels, 0.5 percent.
  EXPECT_LE(differing, 138u) << GetParam();
}
INSTANTIATE_TEST_SUITE_P(Techniques, Forward,
                         testing::Values("hard", "pcf", "pcf-masked", "pcf-quantized", "pcss", "pcss-mip",
                                         "vsm", "occlusion-textures", "shadow-width"));

class ForwardErrors : public Forward {};
TEST_F(ForwardErrors, nameTheFix) {
  ForwardRecord forward;
  EXPECT_EQ(engine_->forwardSource(0, forward).code, ErrorCode::invalidArgument);  // no frame yet
  ASSERT_TRUE(engine_->setTechnique("sampled").ok());
  ASSERT_TRUE(engine_->set("sampled.samples", "2").ok());
  ASSERT_TRUE(render(Output::visibility).ok());
  EXPECT_EQ(engine_->forwardSource(0, forward).code, ErrorCode::capabilityMissing);
  ASSERT_TRUE(engine_->setTechnique("hard").ok());
  ASSERT_TRUE(render(Output::lightsOnly).ok());
  EXPECT_EQ(engine_->forwardSource(1, forward).code, ErrorCode::invalidArgument);  // one light only
  const double identity[16] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
  EXPECT_EQ(engine_->bindForward(0, 0, identity, 0).code, ErrorCode::invalidArgument);
}

}  // namespace
}  // namespace halfshadow::test
