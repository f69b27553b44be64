// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// The smallest host: owns a context, a framebuffer and its OpenGL ES state, and lets Halfshadow draw a box
/// over a ground with soft shadows. Prints what it got; exits with 1 when a shadow is missing or its state
/// was changed.
///
/// Everything that a renderer needs of the library is between "1." and "4."; the rest is the host's own.
#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <GLES2/gl2.h>

#include <cstdio>
#include <cstring>
#include <memory>
#include <vector>

#include "halfshadow/halfshadow.hpp"

namespace {

constexpr int kWidth = 320, kHeight = 240;

/// An OpenGL ES 2.0 context without a window.
bool openContext() {
  EGLDisplay display = EGL_NO_DISPLAY;
  const char* extensions = eglQueryString(EGL_NO_DISPLAY, EGL_EXTENSIONS);
  const auto platformDisplay =
      reinterpret_cast<PFNEGLGETPLATFORMDISPLAYEXTPROC>(eglGetProcAddress("eglGetPlatformDisplayEXT"));
  if (extensions != nullptr && platformDisplay != nullptr &&
      std::strstr(extensions, "EGL_MESA_platform_surfaceless")) {
    display = platformDisplay(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr);
  }
  if (display == EGL_NO_DISPLAY) display = eglGetDisplay(EGL_DEFAULT_DISPLAY);
  const EGLint configAttributes[] = {
      EGL_SURFACE_TYPE, EGL_PBUFFER_BIT, EGL_RENDERABLE_TYPE, EGL_OPENGL_ES2_BIT, EGL_RED_SIZE, 8, EGL_NONE};
  const EGLint contextAttributes[] = {EGL_CONTEXT_CLIENT_VERSION, 2, EGL_NONE};
  const EGLint surfaceAttributes[] = {EGL_WIDTH, 16, EGL_HEIGHT, 16, EGL_NONE};
  EGLConfig config = nullptr;
  EGLint count = 0;
  if (!eglInitialize(display, nullptr, nullptr) || !eglBindAPI(EGL_OPENGL_ES_API) ||
      !eglChooseConfig(display, configAttributes, &config, 1, &count) || count == 0) {
    return false;
  }
  const EGLSurface surface = eglCreatePbufferSurface(display, config, surfaceAttributes);
  const EGLContext context = eglCreateContext(display, config, EGL_NO_CONTEXT, contextAttributes);
  return context != EGL_NO_CONTEXT && eglMakeCurrent(display, surface, surface, context);
}

/// The host's render target: colour texture and depth.
GLuint makeFramebuffer() {
  GLuint framebuffer = 0, color = 0, depth = 0;
  glGenTextures(1, &color);
  glBindTexture(GL_TEXTURE_2D, color);
  glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA, kWidth, kHeight, 0, GL_RGBA, GL_UNSIGNED_BYTE, nullptr);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
  glGenRenderbuffers(1, &depth);
  glBindRenderbuffer(GL_RENDERBUFFER, depth);
  glRenderbufferStorage(GL_RENDERBUFFER, GL_DEPTH_COMPONENT16, kWidth, kHeight);
  glGenFramebuffers(1, &framebuffer);
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
  glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, color, 0);
  glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, depth);
  return glCheckFramebufferStatus(GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE ? framebuffer : 0;
}

/// State that a real host would have set; unusual values, so that a restored default would show.
void disturbState() {
  glEnable(GL_BLEND);
  glBlendFuncSeparate(GL_SRC_ALPHA, GL_ONE, GL_ZERO, GL_ONE_MINUS_SRC_ALPHA);
  glEnable(GL_CULL_FACE);
  glCullFace(GL_FRONT);
  glDepthFunc(GL_GREATER);
  glDepthMask(GL_FALSE);
  glColorMask(GL_TRUE, GL_FALSE, GL_TRUE, GL_FALSE);
  glViewport(3, 5, 17, 19);
  glScissor(1, 2, 30, 40);
  glEnable(GL_SCISSOR_TEST);
  glClearColor(0.25f, 0.5f, 0.75f, 1.0f);
  glStencilFunc(GL_NOTEQUAL, 3, 0x0f);
  glActiveTexture(GL_TEXTURE3);
  glPixelStorei(GL_PACK_ALIGNMENT, 2);
}

std::vector<GLint> stateValues() {
  constexpr GLenum kNames[] = {GL_FRAMEBUFFER_BINDING,
                               GL_RENDERBUFFER_BINDING,
                               GL_ACTIVE_TEXTURE,
                               GL_TEXTURE_BINDING_2D,
                               GL_ARRAY_BUFFER_BINDING,
                               GL_ELEMENT_ARRAY_BUFFER_BINDING,
                               GL_CURRENT_PROGRAM,
                               GL_VIEWPORT,
                               GL_SCISSOR_BOX,
                               GL_BLEND,
                               GL_CULL_FACE,
                               GL_DEPTH_TEST,
                               GL_SCISSOR_TEST,
                               GL_STENCIL_TEST,
                               GL_DITHER,
                               GL_BLEND_SRC_RGB,
                               GL_BLEND_DST_RGB,
                               GL_BLEND_SRC_ALPHA,
                               GL_BLEND_DST_ALPHA,
                               GL_CULL_FACE_MODE,
                               GL_DEPTH_FUNC,
                               GL_DEPTH_WRITEMASK,
                               GL_COLOR_WRITEMASK,
                               GL_COLOR_CLEAR_VALUE,
                               GL_STENCIL_FUNC,
                               GL_STENCIL_REF,
                               GL_STENCIL_VALUE_MASK,
                               GL_PACK_ALIGNMENT,
                               GL_UNPACK_ALIGNMENT};
  std::vector<GLint> values;
  for (const GLenum name : kNames) {
    GLint value[4] = {0, 0, 0, 0};
    glGetIntegerv(name, value);
    values.insert(values.end(), value, value + 4);
  }
  return values;
}

bool failed(const char* what, const halfshadow::Outcome& outcome) {
  if (outcome.ok()) return false;
  std::fprintf(stderr, "%s: %s\n", what, outcome.message);
  return true;
}

// A ground of 2 triangles and a box of 12, counter-clockwise seen from outside.
constexpr float kGround[] = {-6, 0, -6, 6, 0, -6, 6, 0, 6, -6, 0, 6};
constexpr std::uint32_t kGroundIndices[] = {0, 2, 1, 0, 3, 2};
constexpr float kBox[] = {-1, 0.5f, -1, 1, 0.5f, -1, 1, 2.5f, -1, -1, 2.5f, -1,
                          -1, 0.5f, 1,  1, 0.5f, 1,  1, 2.5f, 1,  -1, 2.5f, 1};
constexpr std::uint32_t kBoxIndices[] = {0, 2, 1, 0, 3, 2, 4, 5, 6, 4, 6, 7, 0, 1, 5, 0, 5, 4,
                                         3, 6, 2, 3, 7, 6, 0, 4, 7, 0, 7, 3, 1, 2, 6, 1, 6, 5};

}  // namespace

int main() {
  if (!openContext()) {
    std::fprintf(stderr,
                 "No OpenGL ES 2.0 context; install libegl1, libgles2 and a driver (libgl1-mesa-dri).\n");
    return 1;
  }
  const GLuint framebuffer = makeFramebuffer();
  if (framebuffer == 0) return 1;

  // 1. An engine in the context that is current.
  halfshadow::EngineDesc engineDesc;
  engineDesc.getProcAddress = [](const char* name, void*) {
    return reinterpret_cast<void*>(eglGetProcAddress(name));
  };
  halfshadow::Outcome outcome;
  const std::unique_ptr<halfshadow::Engine> engine(halfshadow::Engine::create(engineDesc, outcome));
  if (failed("create", outcome)) return 1;

  // 2. What casts and what receives.
  halfshadow::ObjectId ground = 0, box = 0;
  halfshadow::ObjectDesc object;
  object.casts = false;
  object.mesh = {.positions = kGround, .vertexCount = 4, .indices = kGroundIndices, .indexCount = 6};
  if (failed("ground", engine->addObject(object, ground))) return 1;
  object.casts = true;
  object.mesh = {.positions = kBox, .vertexCount = 8, .indices = kBoxIndices, .indexCount = 36};
  if (failed("box", engine->addObject(object, box))) return 1;

  // 3. A square light of 1.2 × 1.2 units, nine above the ground, that looks down: halfU × halfV points there.
  halfshadow::LightDesc light;
  const double center[3] = {2, 9, 1}, halfU[3] = {0.6, 0, 0}, halfV[3] = {0, 0, 0.6};
  std::memcpy(light.center, center, sizeof center);
  std::memcpy(light.halfU, halfU, sizeof halfU);
  std::memcpy(light.halfV, halfV, sizeof halfV);
  if (failed("light", engine->setLights(&light, 1))) return 1;

  disturbState();
  const std::vector<GLint> before = stateValues();
  bool good = true;
  for (const char* technique : {"hard", "pcf"}) {
    // 4. Each frame: a camera and a rectangle of a framebuffer. Output::shaded would draw lit colours.
    halfshadow::RenderDesc frame;
    const double eye[3] = {7, 6, 9}, target[3] = {0, 0.5, 0};
    std::memcpy(frame.camera.eye, eye, sizeof eye);
    std::memcpy(frame.camera.target, target, sizeof target);
    frame.target.kind = halfshadow::TargetDesc::Kind::host;
    frame.target.framebuffer = framebuffer;
    frame.target.width = kWidth;
    frame.target.height = kHeight;
    frame.output = halfshadow::Output::visibility;
    halfshadow::FrameReport report;
    if (failed(technique, engine->setTechnique(technique))) return 1;
    if (failed(technique, engine->render(frame, report))) return 1;

    std::vector<std::uint8_t> pixels(std::size_t{kWidth} * kHeight * 4);
    const bool stateKept = stateValues() == before;
    glPixelStorei(GL_PACK_ALIGNMENT, 4);
    glReadPixels(0, 0, kWidth, kHeight, GL_RGBA, GL_UNSIGNED_BYTE, pixels.data());
    glPixelStorei(GL_PACK_ALIGNMENT, 2);
    int umbra = 0, penumbra = 0, lit = 0;
    for (std::size_t i = 0; i < pixels.size(); i += 4) {
      ++(pixels[i] == 0 ? umbra : pixels[i] == 255 ? lit : penumbra);
    }
    std::printf(
        "%-5s %6d lit, %5d penumbra, %5d umbra pixels; %zu passes, %llu framebuffer switches; state %s\n",
        technique, lit, penumbra, umbra, report.passCount,
        static_cast<unsigned long long>(report.framebufferSwitches), stateKept ? "kept" : "CHANGED");
    // Hard shadows have no penumbra; filtered ones must have some.
    const bool filtered = std::strcmp(technique, "pcf") == 0;
    good = good && stateKept && umbra > 0 && lit > 0 && (penumbra > 0) == filtered;
  }
  if (glGetError() != GL_NO_ERROR) good = false;
  return good ? 0 : 1;
}
