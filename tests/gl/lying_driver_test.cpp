// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// A probe that never fails proves nothing: each test here stands between the engine and the driver, breaks
// one thing that real drivers are known to break, and expects the probe to notice.
#include <cstring>
#include <functional>
#include <string>

#include "gl_fixture.hpp"

namespace halfshadow::test {
namespace {

using device::Capability;
using device::ProbeOutcome;

/// The driver's own functions, for the lies to fall back on. Plain functions carry no state, hence static.
gl::Functions honest;
std::string extensionText;

const GLubyte* GL_APIENTRY noExtensions(GLenum name) {
  if (name == GL_EXTENSIONS) return reinterpret_cast<const GLubyte*>("");
  return honest.getString(name);
}

const GLubyte* GL_APIENTRY boastfulExtensions(GLenum name) {
  if (name != GL_EXTENSIONS) return honest.getString(name);
  extensionText = reinterpret_cast<const char*>(honest.getString(name));
  extensionText += " GL_EXT_shader_texture_lod GL_EXT_shader_framebuffer_fetch";
  return reinterpret_cast<const GLubyte*>(extensionText.c_str());
}

void GL_APIENTRY additiveMinmax(GLenum, GLenum) {
  honest.blendEquationSeparate(GL_FUNC_ADD, GL_FUNC_ADD);
}

void GL_APIENTRY deafDepthFunc(GLenum) {
  honest.depthFunc(GL_ALWAYS);
}

void GL_APIENTRY greedyDiscard(GLenum, GLsizei, const GLenum*) {
  honest.clearColor(1, 0, 1, 1);
  honest.clear(GL_COLOR_BUFFER_BIT);
}

void GL_APIENTRY shortIndices(GLenum mode, GLsizei count, GLenum type, const void* indices) {
  // As if 32-bit indices were cut: the first three vertices, whatever was asked.
  if (type == GL_UNSIGNED_INT) return honest.drawArrays(mode, 0, count);
  honest.drawElements(mode, count, type, indices);
}

void GL_APIENTRY fastClock(GLuint, GLenum, GLuint64* nanoseconds) {
  *nanoseconds = 3600ull * 1000000000ull;
}

void GL_APIENTRY wrongCount(GLenum, GLenum, GLenum, GLenum) {}

/// The Mali-400 case: highp compiles, and computes in half floats.
void GL_APIENTRY mediumpForHighp(GLuint shader, GLsizei, const GLchar* const* text, const GLint* length) {
  std::string source(text[0], static_cast<std::size_t>(length[0]));
  const bool isFragment = source.find("gl_FragColor") != std::string::npos;
  for (std::size_t at; isFragment && (at = source.find("highp")) != std::string::npos;) {
    source.replace(at, std::strlen("highp"), "mediump");
  }
  const char* changed = source.c_str();
  honest.shaderSource(shader, 1, &changed, nullptr);
}

/// 16-bit storage behind every depth format.
void GL_APIENTRY shallowRenderbuffers(GLenum target, GLenum format, GLsizei width, GLsizei height) {
  honest.renderbufferStorage(target, format == GL_DEPTH_COMPONENT24_OES ? GL_DEPTH_COMPONENT16 : format,
                             width, height);
}
void GL_APIENTRY shallowTextures(GLenum target, GLint level, GLint internalFormat, GLsizei width,
                                 GLsizei height, GLint border, GLenum format, GLenum type,
                                 const void* pixels) {
  const bool deep = format == GL_DEPTH_COMPONENT && type == GL_UNSIGNED_INT;
  honest.texImage2D(target, level, internalFormat, width, height, border, format,
                    deep ? GL_UNSIGNED_SHORT : type, pixels);
}

class LyingDriver : public GlTest {
 protected:
  /// Capabilities as found when `name` answers with `lie`.
  template <typename Function>
  device::Capabilities capabilitiesWith(const char* name, Function* lie) {
    const auto honestAddress = [this](const char* wanted) { return headless().getProcAddress(wanted); };
    EXPECT_EQ(honest.load(honestAddress), "");
    const auto made = gl::Context::create(
        [&](const char* wanted) -> void* {
          return std::string_view(wanted) == name ? reinterpret_cast<void*>(lie) : honestAddress(wanted);
        },
        {});
    EXPECT_TRUE(made);
    device::Capabilities found;
    if (made) found = (*made)->capabilities();
    return found;
  }
  /// Skips where the honest driver lacks the capability: then there is nothing to lie about.
  bool missing(Capability capability) { return !capabilities().has(capability); }
  void expectCaught(const device::Capabilities& found, Capability capability) {
    const device::CapabilityState& state = found.state(capability);
    EXPECT_EQ(state.outcome, ProbeOutcome::probeFailed)
        << device::capabilityName(capability) << ": " << state.reason;
    EXPECT_FALSE(state.reason.empty());
  }
};

#define SKIP_WITHOUT(capability) \
  if (missing(capability)) GTEST_SKIP() << "this driver lacks " << device::capabilityName(capability)

TEST_F(LyingDriver, WithoutExtensionsOnlyHighpRemains) {
  const device::Capabilities found = capabilitiesWith("glGetString", noExtensions);
  for (std::size_t i = 0; i < device::kCapabilityCount; ++i) {
    const auto capability = static_cast<Capability>(i);
    if (capability == Capability::highp) continue;
    EXPECT_EQ(found.state(capability).outcome, ProbeOutcome::notAdvertised)
        << device::capabilityName(capability);
  }
  EXPECT_EQ(found.has(Capability::highp), capabilities().has(Capability::highp));
}

TEST_F(LyingDriver, ExtensionsThatDoNotCompileAreCaught) {
  const device::Capabilities found = capabilitiesWith("glGetString", boastfulExtensions);
  if (missing(Capability::textureLod)) expectCaught(found, Capability::textureLod);
  if (missing(Capability::framebufferFetch)) expectCaught(found, Capability::framebufferFetch);
}

TEST_F(LyingDriver, MinmaxThatAddsIsCaught) {
  SKIP_WITHOUT(Capability::blendMinmax);
  expectCaught(capabilitiesWith("glBlendEquationSeparate", additiveMinmax), Capability::blendMinmax);
}

TEST_F(LyingDriver, DepthTexturesThatIgnoreTheTestAreCaught) {
  SKIP_WITHOUT(Capability::depthTexture);
  expectCaught(capabilitiesWith("glDepthFunc", deafDepthFunc), Capability::depthTexture);
}

TEST_F(LyingDriver, ShallowDepthRenderbuffersAreCaught) {
  SKIP_WITHOUT(Capability::depth24);
  expectCaught(capabilitiesWith("glRenderbufferStorage", shallowRenderbuffers), Capability::depth24);
}

TEST_F(LyingDriver, ShallowDepthTexturesAreCaught) {
  SKIP_WITHOUT(Capability::depth24);
  SKIP_WITHOUT(Capability::depthTexture);
  expectCaught(capabilitiesWith("glTexImage2D", shallowTextures), Capability::depth24);
}

TEST_F(LyingDriver, StencilThatDoesNotCountIsCaught) {
  SKIP_WITHOUT(Capability::packedDepthStencil);
  expectCaught(capabilitiesWith("glStencilOpSeparate", wrongCount), Capability::packedDepthStencil);
}

TEST_F(LyingDriver, DiscardOfTheWrongAttachmentIsCaught) {
  SKIP_WITHOUT(Capability::discard);
  expectCaught(capabilitiesWith("glDiscardFramebufferEXT", greedyDiscard), Capability::discard);
}

TEST_F(LyingDriver, CutIndicesAreCaught) {
  SKIP_WITHOUT(Capability::uintIndex);
  expectCaught(capabilitiesWith("glDrawElements", shortIndices), Capability::uintIndex);
}

TEST_F(LyingDriver, ImpossibleTimesAreCaught) {
  SKIP_WITHOUT(Capability::timerQuery);
  expectCaught(capabilitiesWith("glGetQueryObjectui64vEXT", fastClock), Capability::timerQuery);
}

TEST_F(LyingDriver, HighpThatIsMediumpIsCaught) {
  if (capabilities().probes.mediumpMantissaBits >= 16) {
    GTEST_SKIP() << "this driver computes mediump in single precision, so highp cannot be impersonated by it";
  }
  const device::Capabilities found = capabilitiesWith("glShaderSource", mediumpForHighp);
  expectCaught(found, Capability::highp);
  EXPECT_EQ(found.probes.highpMantissaBits, found.probes.mediumpMantissaBits);
}

}  // namespace
}  // namespace halfshadow::test
