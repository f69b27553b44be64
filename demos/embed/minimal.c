/* SPDX-License-Identifier: MIT
 * Copyright (c) 2026 The Halfshadow authors */
/* The smallest host in C99: a context, a box over a ground, one frame read back. Prints how many pixels are
 * shadowed; exits with 1 when something is wrong. */
#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "halfshadow/halfshadow.h"

#define WIDTH 160
#define HEIGHT 120

static void* load(const char* name, void* user) {
  void (*function)(void) = eglGetProcAddress(name);
  void* address = NULL;
  (void)user;
  memcpy(&address, &function, sizeof address); /* C has no cast from function to object pointers */
  return address;
}

static int openContext(void) {
  const EGLint config_attributes[] = {EGL_RENDERABLE_TYPE, EGL_OPENGL_ES2_BIT, EGL_SURFACE_TYPE,
                                      EGL_PBUFFER_BIT, EGL_NONE};
  const EGLint context_attributes[] = {EGL_CONTEXT_CLIENT_VERSION, 2, EGL_NONE};
  const EGLint surface_attributes[] = {EGL_WIDTH, 16, EGL_HEIGHT, 16, EGL_NONE};
  const char* extensions = eglQueryString(EGL_NO_DISPLAY, EGL_EXTENSIONS);
  EGLDisplay display = EGL_NO_DISPLAY;
  EGLConfig config = NULL;
  EGLint count = 0;
  if (extensions && strstr(extensions, "EGL_MESA_platform_surfaceless")) {
    PFNEGLGETPLATFORMDISPLAYEXTPROC platformDisplay =
        (PFNEGLGETPLATFORMDISPLAYEXTPROC)eglGetProcAddress("eglGetPlatformDisplayEXT");
    if (platformDisplay) display = platformDisplay(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, NULL);
  }
  if (display == EGL_NO_DISPLAY) display = eglGetDisplay(EGL_DEFAULT_DISPLAY);
  if (!eglInitialize(display, NULL, NULL) || !eglBindAPI(EGL_OPENGL_ES_API) ||
      !eglChooseConfig(display, config_attributes, &config, 1, &count) || count == 0) {
    return 0;
  }
  {
    EGLSurface surface = eglCreatePbufferSurface(display, config, surface_attributes);
    EGLContext context = eglCreateContext(display, config, EGL_NO_CONTEXT, context_attributes);
    return context != EGL_NO_CONTEXT && eglMakeCurrent(display, surface, surface, context);
  }
}

static int check(const HalfshadowEngine* engine, HalfshadowError error) {
  if (error == HALFSHADOW_OK) return 1;
  fprintf(stderr, "halfshadow: %s\n", halfshadow_message(engine));
  return 0;
}

int main(void) {
  static const float ground[] = {-9, 0, -9, -9, 0, 9, 9, 0, 9, 9, 0, -9};
  static const uint32_t ground_indices[] = {0, 1, 2, 0, 2, 3};
  static const float box[] = {-1, 1, -1, 1, 1, -1, -1, 2, -1, 1, 2, -1, -1, 1, 1, 1, 1, 1, -1, 2, 1, 1, 2, 1};
  static const uint32_t box_indices[] = {0, 2, 1, 1, 2, 3, 4, 5, 6, 5, 7, 6, 0, 1, 4, 1, 5, 4,
                                         2, 6, 3, 3, 6, 7, 0, 4, 2, 2, 4, 6, 1, 3, 5, 3, 7, 5};
  HalfshadowEngineDesc engine_desc = {sizeof engine_desc};
  HalfshadowObjectDesc object = {sizeof object};
  HalfshadowLightDesc light = {sizeof light};
  HalfshadowRenderDesc frame = {sizeof frame};
  HalfshadowReport report = {sizeof report};
  HalfshadowEngine* engine = NULL;
  const char* message = "";
  uint8_t* pixels = malloc(WIDTH * HEIGHT * 4);
  uint32_t id = 0;
  int shadowed = 0, partly = 0, i, ok;

  if (!openContext()) {
    fprintf(stderr, "no OpenGL ES 2.0 context; install libegl1 and libgl1-mesa-dri\n");
    return 1;
  }
  engine_desc.get_proc_address = load;
  engine = halfshadow_create(&engine_desc, NULL, &message);
  if (!engine || !pixels) {
    fprintf(stderr, "halfshadow: %s\n", message);
    return 1;
  }
  object.positions = ground;
  object.vertex_count = 4;
  object.indices = ground_indices;
  object.index_count = 6;
  object.receives = 1;
  ok = check(engine, halfshadow_add_object(engine, &object, &id));
  object.positions = box;
  object.vertex_count = 8;
  object.indices = box_indices;
  object.index_count = 36;
  object.casts = 1;
  ok = ok && check(engine, halfshadow_add_object(engine, &object, &id));
  light.center[1] = 8;
  light.half_u[0] = 0.5;
  light.half_v[2] = 0.5; /* x cross z is -y: it emits downwards */
  light.color[0] = light.color[1] = light.color[2] = 1;
  light.intensity = 1;
  ok = ok && check(engine, halfshadow_set_lights(engine, &light, 1));
  ok = ok && check(engine, halfshadow_set_technique(engine, "pcss-mip"));
  frame.eye[0] = 6;
  frame.eye[1] = 7;
  frame.eye[2] = 8;
  frame.up[1] = 1;
  frame.vertical_fov_radians = 0.7;
  frame.near_distance = 0.5;
  frame.far_distance = 60;
  frame.width = WIDTH;
  frame.height = HEIGHT;
  frame.output = HALFSHADOW_VISIBILITY;
  ok = ok && check(engine, halfshadow_render(engine, &frame, &report));
  ok = ok && check(engine, halfshadow_read_output(engine, pixels, WIDTH * HEIGHT * 4));
  for (i = 0; ok && i < WIDTH * HEIGHT; ++i) {
    shadowed += pixels[4 * i] == 0;
    partly += pixels[4 * i] > 0 && pixels[4 * i] < 255;
  }
  /* A refused call says why and changes nothing. */
  ok = ok && halfshadow_set_technique(engine, "no-such") == HALFSHADOW_UNKNOWN_TECHNIQUE;
  ok = ok && strstr(halfshadow_message(engine), "no-such") != NULL;
  frame.struct_size = 4;
  ok = ok && halfshadow_render(engine, &frame, NULL) == HALFSHADOW_INVALID_ARGUMENT;
  printf("%d pixels in umbra, %d in penumbra, %d passes\n", shadowed, partly, (int)report.passes);
  halfshadow_destroy(engine);
  free(pixels);
  return ok && shadowed > 50 && partly > 50 && report.passes > 1 ? 0 : 1;
}
