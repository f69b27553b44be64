// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// What a host that draws receivers itself may rely on from frame to frame.
#include <gtest/gtest.h>

#include <algorithm>
#include <glm/ext/matrix_transform.hpp>
#include <memory>
#include <optional>

#include "engine_fixture.hpp"
#include "faulty_gl.hpp"
#include "forward_host.hpp"

namespace halfshadow::test {
namespace {
constexpr const char* kTechniques[] = {"hard",     "pcf", "pcf-masked",         "pcf-quantized", "pcss",
                                       "pcss-mip", "vsm", "occlusion-textures", "shadow-width"};

class ForwardContract : public EngineTest {
 protected:
  void SetUp() override {
    EngineTest::SetUp();
    if (HasFatalFailure()) return;
    renderer_ = std::make_unique<SceneRenderer>(makeFaultyEngine(HostState::restore));
    renderer_->load(scene());
    renderer_->desc().output = Output::lightsOnly;
    renderer_->choose({"hard", {{"map_size", "128"}}});
    host_ = std::make_unique<ForwardHost>(scene(), kWidth, kHeight);
    for (std::size_t i = 0; i < scene().objects.size(); ++i) {
      (scene().objects[i].casts ? casters_ : grounds_).push_back(i);
      all_.push_back(i);
    }
  }
  void TearDown() override {
    host_.reset();
    renderer_.reset();
    faultyDriver().disarm();
    EXPECT_EQ(faultyDriver().aliveCount(), 0u);
    faultyDriver().endContext();
    EngineTest::TearDown();
  }

  /// A box over a ground; the box itself is not drawn, so that it matters by its shadow alone.
  static const scene::SceneDescription& scene() {
    static const scene::SceneDescription made = [] {
      scene::SceneDescription copy = builtinScene("box@light=0.3");
      for (scene::SceneObject& object : copy.objects) object.receives = !object.casts;
      return copy;
    }();
    return made;
  }
  Engine& engine() { return renderer_->engine(); }
  SceneRenderer& renderer() { return *renderer_; }
  ForwardHost& host() { return *host_; }
  void frame() {
    const Outcome rendered = engine().render(renderer().desc());
    ASSERT_TRUE(rendered.ok()) << rendered.message;
  }
  /// A frame, and the program for its texts; 0 where this device needs facet normals from hosts.
  GLuint programOfFrame() {
    frame();
    ForwardRecord texts;
    const Outcome asked = engine().forwardSource(0, texts);
    EXPECT_TRUE(asked.ok()) << asked.message;
    return asked.ok() && !texts.readsFacetNormal ? host().link(texts) : 0;
  }
  ForwardSerials serials() {
    ForwardSerials numbers;
    const Outcome asked = engine().forwardSerials(0, numbers);
    EXPECT_TRUE(asked.ok()) << asked.message;
    return numbers;
  }
  std::vector<std::uint8_t> ground(GLuint program) { return host().draw(engine(), program, 0, grounds_); }
  Outcome bind(GLuint program, const glm::dmat4& world = glm::dmat4(1.0), int unit = 2) {
    return engine().bindForward(0, program, &world[0][0], unit);
  }
  /// Moves casters behind the light, where they shadow nothing, or back.
  void hideCasters(bool hidden) {
    for (const std::size_t i : casters_) {
      const glm::dmat4 moved = glm::translate(glm::dmat4(1.0), glm::dvec3(0.0, hidden ? 500.0 : 0.0, 0.0)) *
                               scene().objects[i].worldFromObject;
      renderer().setTransform(i, moved);
    }
  }

  std::vector<std::size_t> casters_, grounds_, all_;  ///< of the scene's objects

 private:
  std::unique_ptr<SceneRenderer> renderer_;
  std::unique_ptr<ForwardHost> host_;
};

bool allLit(const std::vector<std::uint8_t>& picture) {
  return std::ranges::all_of(picture, [](std::uint8_t v) { return v == 255; });
}

TEST_F(ForwardContract, AProgramStaysRightWhenTheLastCasterGoesAndComesBack) {
  for (const char* technique : kTechniques) {
    SCOPED_TRACE(technique);
    renderer().choose({technique, {{"map_size", "128"}}});
    hideCasters(false);
    const GLuint program = programOfFrame();
    if (program == 0) GTEST_SKIP() << "derivatives or highp are missing: this host passes no facet normals";
    const ForwardSerials before = serials();
    const auto shadowed = ground(program);
    ASSERT_GT(ForwardHost::dark(shadowed), 100u);
    hideCasters(true);
    frame();
    EXPECT_EQ(serials().source, before.source) << "the program is to be linked anew";
    EXPECT_NE(serials().bindings, before.bindings);
    EXPECT_TRUE(allLit(ground(program)));
    hideCasters(false);
    frame();
    EXPECT_EQ(serials().source, before.source);
    EXPECT_EQ(ground(program), shadowed);
  }
}

TEST_F(ForwardContract, AProgramStaysRightWhenTheLastCasterIsRemoved) {
  const GLuint program = programOfFrame();
  if (program == 0) GTEST_SKIP() << "derivatives or highp are missing: this host passes no facet normals";
  const std::uint64_t source = serials().source;
  ASSERT_GT(ForwardHost::dark(ground(program)), 100u);
  for (const std::size_t i : casters_) ASSERT_TRUE(engine().removeObject(renderer().id(i)).ok());
  frame();
  EXPECT_EQ(serials().source, source);
  EXPECT_TRUE(allLit(ground(program)));
  // So that the renderer's list is right again.
  ObjectId id = 0;
  for (const std::size_t i : casters_)
    ASSERT_TRUE(engine().addObject(objectDesc(scene().objects[i]), id).ok());
  frame();
  EXPECT_EQ(serials().source, source);
  EXPECT_GT(ForwardHost::dark(ground(program)), 100u);
}

TEST_F(ForwardContract, AProgramStaysRightWhenTheLightGoesOut) {
  const GLuint program = programOfFrame();
  if (program == 0) GTEST_SKIP() << "derivatives or highp are missing: this host passes no facet normals";
  const std::uint64_t source = serials().source;
  const auto shadowed = ground(program);
  ASSERT_GT(ForwardHost::dark(shadowed), 100u);
  std::vector<scene::AreaLight> dark = scene().lights;
  dark.front().intensity = 0.0;
  renderer().setLights(dark);
  frame();
  EXPECT_EQ(serials().source, source);
  EXPECT_TRUE(allLit(ground(program)));
  renderer().setLights(scene().lights);
  frame();
  EXPECT_EQ(serials().source, source);
  EXPECT_EQ(ground(program), shadowed);
}

TEST_F(ForwardContract, SerialsTellWhenTheSourceOrBindingsChange) {
  const GLuint program = programOfFrame();
  const ForwardSerials first = serials();
  EXPECT_NE(first.source, 0u);
  ForwardRecord texts;
  ASSERT_TRUE(engine().forwardSource(0, texts).ok());
  EXPECT_EQ(texts.serial, first.source);
  frame();  // nothing changed
  EXPECT_EQ(serials().source, first.source);
  renderer().setTransform(casters_.front(), glm::translate(glm::dmat4(1.0), glm::dvec3(1.0, 2.0, 0.0)));
  frame();
  const ForwardSerials moved = serials();
  EXPECT_EQ(moved.source, first.source) << "a moved caster changes no text";
  EXPECT_NE(moved.bindings, first.bindings);
  renderer().choose({"pcf", {{"map_size", "128"}}});
  frame();
  const ForwardSerials other = serials();
  EXPECT_NE(other.source, first.source) << "another technique has another text";
  EXPECT_NE(other.bindings, moved.bindings);
  if (program != 0) {
    EXPECT_EQ(bind(program).code, ErrorCode::invalidArgument) << "it is of older texts";
  }
  renderer().choose({"pcf", {{"map_size", "128"}, {"pcf.size", "5"}}});
  frame();
  EXPECT_NE(serials().source, other.source) << "a kernel's size is in the text";
}

TEST_F(ForwardContract, ForeignUnlinkedAndOutdatedProgramsAreRefused) {
  const gl::Functions& gl = hostGl();
  const GLuint program = programOfFrame();
  if (program == 0) GTEST_SKIP() << "derivatives or highp are missing: this host passes no facet normals";
  const auto refused = [&](const Outcome& outcome, const char* what) {
    EXPECT_EQ(outcome.code, ErrorCode::invalidArgument) << what << ": " << outcome.message;
    EXPECT_GE(std::string(outcome.message).size(), 20u) << what;
  };
  gl.useProgram(program);
  refused(bind(0), "no program");
  refused(bind(99999), "a name of nothing");
  const GLuint empty = gl.createProgram();
  refused(bind(empty), "a program that is not linked");
  gl.deleteProgram(empty);
  const GLuint shader = gl.createShader(GL_VERTEX_SHADER);
  refused(bind(shader), "a shader");
  gl.deleteShader(shader);
  const GLuint foreign = host().link(
      {.vertexGlsl = "void halfshadow_receive(highp vec4 p, highp vec3 n) {}\n",
       .fragmentGlsl = "precision mediump float;\nfloat halfshadow_visibility() { return 0.5; }\n"});
  refused(bind(foreign), "a program of other texts");
  refused(engine().bindForward(0, program, nullptr, 2), "no matrix");
  refused(bind(program, glm::dmat4(1.0), -1), "a negative unit");
  refused(bind(program, glm::dmat4(1.0), 10000), "units that there are not");
  refused(engine().bindForward(3, program, &glm::dmat4(1.0)[0][0], 2), "no such light");
  EXPECT_TRUE(bind(program).ok()) << "refusals change nothing";
  renderer().choose({"vsm", {{"map_size", "128"}}});
  frame();
  refused(bind(program), "a program of the technique before");
  const GLuint newer = programOfFrame();
  gl.useProgram(newer);
  EXPECT_TRUE(bind(newer).ok());
  gl.useProgram(0);
}

TEST_F(ForwardContract, ANameThatIsUsedAgainIsForgottenWhenTheHostSaysSo) {
  const gl::Functions& gl = hostGl();
  frame();
  ForwardRecord texts;
  ASSERT_TRUE(engine().forwardSource(0, texts).ok());
  if (texts.readsFacetNormal) GTEST_SKIP() << "derivatives or highp are missing";
  const GLuint program = host().link(texts);
  gl.useProgram(program);
  ASSERT_TRUE(bind(program).ok());
  engine().forgetForwardProgram(program);
  engine().forgetForwardProgram(424242);  // never known
  faultyDriver().arm(Fault::dropped, ~std::uint64_t{0});
  EXPECT_TRUE(bind(program).ok());
  EXPECT_GT(faultyDriver().queries, 3u) << "it was not looked up again";
  faultyDriver().disarm();
  gl.useProgram(0);
}

TEST_F(ForwardContract, AfterTheFirstCallOfAFrameFewCallsAndNoQueries) {
  const gl::Functions& gl = hostGl();
  for (const char* technique : kTechniques) {
    SCOPED_TRACE(technique);
    renderer().choose({technique, {{"map_size", "128"}}});
    const GLuint program = programOfFrame();
    if (program == 0) GTEST_SKIP() << "derivatives or highp are missing: this host passes no facet normals";
    gl.useProgram(program);
    for (int round = 0; round < 2; ++round) {
      ASSERT_TRUE(bind(program, scene().objects[all_.front()].worldFromObject).ok());
      for (const std::size_t i : all_) {
        faultyDriver().arm(Fault::dropped, ~std::uint64_t{0});
        ASSERT_TRUE(bind(program, scene().objects[i].worldFromObject).ok());
        EXPECT_LE(faultyDriver().calls, 8u);
        EXPECT_EQ(faultyDriver().queries, 0u);
        faultyDriver().disarm();
      }
      // In a later frame the program is known: even its first object asks nothing.
      renderer().setTransform(casters_.front(),
                              glm::translate(scene().objects[casters_.front()].worldFromObject,
                                             glm::dvec3(0.01 * (round + 1), 0.0, 0.0)));
      frame();
      gl.useProgram(program);
      faultyDriver().arm(Fault::dropped, ~std::uint64_t{0});
      ASSERT_TRUE(bind(program, scene().objects[all_.front()].worldFromObject).ok());
      EXPECT_EQ(faultyDriver().queries, 0u);
      faultyDriver().disarm();
    }
    renderer().setTransform(casters_.front(), scene().objects[casters_.front()].worldFromObject);
  }
  gl.useProgram(0);
}

/// A camera that looks at the sky.
CameraDesc lookingUp(const CameraDesc& camera) {
  CameraDesc up = camera;
  for (int axis = 0; axis < 3; ++axis) {
    up.target[axis] = camera.eye[axis] + (axis == 1 ? 1.0 : 0.0);
    up.up[axis] = axis == 2 ? 1.0 : 0.0;
  }
  return up;
}

// A host that draws a second view (a mirror, a split screen) from one frame: with Receivers::seen the maps
// hold what the declared camera needs, with `anywhere` what any view needs.
TEST_F(ForwardContract, CastersAreCulledByDeclaredViewsAlone) {
  renderer().desc().receivers = Receivers::anywhere;
  const GLuint program = programOfFrame();
  if (program == 0) GTEST_SKIP() << "derivatives or highp are missing: this host passes no facet normals";
  const auto wanted = ground(program);
  ASSERT_GT(ForwardHost::dark(wanted), 100u);
  renderer().desc().camera = lookingUp(cameraDesc(scene().camera.value()));
  // While a caster moves, what the declared views do not need is left out.
  const auto moved = [&] {
    for (int step = 0; step < 3; ++step) {
      hideCasters(true);
      frame();
      hideCasters(false);
      frame();
    }
    return ground(program);
  };
  EXPECT_EQ(moved(), wanted) << "another view than the declared camera's lost its shadow";
  renderer().desc().receivers = Receivers::seen;
  EXPECT_TRUE(allLit(moved())) << "nothing is seen: the caster was drawn in vain";
}

// The ground is the host's alone: the engine was told of the caster only.
TEST_F(ForwardContract, UnknownReceiversAreShadowedWhenTheHostSaysSo) {
  const GLuint program = programOfFrame();
  if (program == 0) GTEST_SKIP() << "derivatives or highp are missing: this host passes no facet normals";
  const auto wanted = ground(program);
  ASSERT_GT(ForwardHost::dark(wanted), 100u);
  for (const std::size_t i : grounds_) ASSERT_TRUE(engine().removeObject(renderer().id(i)).ok());
  frame();
  EXPECT_TRUE(allLit(ground(program))) << "no receiver that the engine knows of is shadowed";
  for (const char* technique : {"hard", "pcf", "pcss-mip", "vsm", "occlusion-textures", "shadow-width"}) {
    SCOPED_TRACE(technique);
    renderer().choose({technique, {{"map_size", "128"}}});
    renderer().desc().receivers = Receivers::unknown;
    const GLuint own = programOfFrame();
    ASSERT_NE(own, 0u);
    const std::size_t dark = ForwardHost::dark(ground(own));
    EXPECT_GT(dark, ForwardHost::dark(wanted) / 2);
    EXPECT_LT(dark, 2 * ForwardHost::dark(wanted));
  }
  for (const std::size_t i : grounds_) {
    ObjectId id = 0;
    ASSERT_TRUE(engine().addObject(objectDesc(scene().objects[i]), id).ok());
  }
}

}  // namespace
}  // namespace halfshadow::test
