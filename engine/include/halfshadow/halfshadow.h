/* SPDX-License-Identifier: MIT
 * Copyright (c) 2026 The Halfshadow authors */
/** @file
 * The same engine for C99 and for languages that bind to C. See halfshadow.hpp for what every call does; the
 * units, ownership and errors are the same.
 *
 * Every struct begins with `struct_size`: set it to sizeof of the struct. All other fields may be zero; zero
 * means the default where one is given. An engine that is null is refused. Messages and reports live until
 * the engine's next call. All calls come from the thread on which the OpenGL ES context is current.
 */
#ifndef HALFSHADOW_H
#define HALFSHADOW_H

#include <stddef.h>
#include <stdint.h>

#include "halfshadow/error_codes.h"

#ifdef __cplusplus
extern "C" {
#endif

/* In C any int may be passed as an enum, and is checked; without a type of its own C++ may assume otherwise.
 */
#ifdef __cplusplus
#define HALFSHADOW_ENUM_TYPE : int
#else
#define HALFSHADOW_ENUM_TYPE
#endif

typedef enum HalfshadowError HALFSHADOW_ENUM_TYPE {
#define HALFSHADOW_ERROR_C_ENUM(name, NAME, text) HALFSHADOW_##NAME,
  HALFSHADOW_ERROR_LIST(HALFSHADOW_ERROR_C_ENUM)
#undef HALFSHADOW_ERROR_C_ENUM
} HalfshadowError;

typedef struct HalfshadowEngine HalfshadowEngine;

typedef enum HalfshadowHostState HALFSHADOW_ENUM_TYPE {
  HALFSHADOW_RESTORE_STATE = 0,
  HALFSHADOW_LEAVE_DEFAULTS = 1,
  HALFSHADOW_LEAVE_DIRTY = 2
} HalfshadowHostState;

typedef struct HalfshadowEngineDesc {
  size_t struct_size;
  void* (*get_proc_address)(const char* name, void* user); /* required */
  void* get_proc_address_user;
  const char* const* forced_off; /* capability names, for testing fallbacks */
  size_t forced_off_count;
  HalfshadowHostState host_state;
  const char* program_proofs; /* of halfshadow_program_proofs() at an earlier time, or null */
  /* Lends threads to halfshadow_render(), or null: work(0, job) to work(count - 1, job), each once, in any
     order and on any threads; returns when all have returned. Work calls neither OpenGL ES nor the host. */
  void (*parallel_for)(size_t count, void (*work)(size_t index, void* job), void* job, void* user);
  void* parallel_for_user;
} HalfshadowEngineDesc;

typedef struct HalfshadowObjectDesc {
  size_t struct_size;
  const float* positions;       /* vertex_count * 3 */
  size_t position_stride_bytes; /* 0 = 12 */
  uint32_t vertex_count;
  const uint32_t* indices; /* index_count, or null for 0, 1, 2, ... */
  size_t index_count;
  const float* normals;             /* vertex_count * 3, or null */
  double world_from_object[16];     /* column-major; all zero = identity */
  int casts, receives;              /* 0 or 1 */
  float base_color[4];              /* linear */
  const float* texcoords;           /* vertex_count * 2, or null */
  const float* colors;              /* vertex_count * 4, linear, or null */
  const uint8_t* base_color_pixels; /* sRGB, base_color_channels (3 or 4) a pixel, top row first, or null */
  int base_color_width, base_color_height, base_color_channels; /* channels 0 = 4 */
  float alpha_cutoff; /* above 0: nothing is there where alpha is less */
  int single_sided;   /* 1: back faces of open meshes are not drawn; shadows fall from both sides */
} HalfshadowObjectDesc;

typedef struct HalfshadowLightDesc {
  size_t struct_size;
  double center[3], half_u[3], half_v[3];
  double emission[3]; /* read only when both half vectors are zero: the light shines to that side */
  float color[3];
  double intensity;
  double reference_distance; /* where the intensity counts fully; 0 = the same at every distance */
  double inner_cone_radians, outer_cone_radians; /* of a spot; an outer of 0: no cone */
} HalfshadowLightDesc;

typedef enum HalfshadowOutput HALFSHADOW_ENUM_TYPE {
  HALFSHADOW_SHADED = 0,
  HALFSHADOW_VISIBILITY = 1,
  HALFSHADOW_VISIBILITY_16 = 2,
  HALFSHADOW_TAPS = 3,
  HALFSHADOW_LIGHTS_ONLY = 4
} HalfshadowOutput;

typedef struct HalfshadowRenderDesc {
  size_t struct_size;
  double eye[3], target[3], up[3];
  double vertical_fov_radians, near_distance, far_distance;
  int use_host_framebuffer; /* 0: a texture of the engine's own; 1: `framebuffer`, 0 included */
  uint32_t framebuffer;
  int x, y, width, height;
  HalfshadowOutput output;
  float clear_color[4];
} HalfshadowRenderDesc;

typedef enum HalfshadowTrim HALFSHADOW_ENUM_TYPE {
  HALFSHADOW_TRIM_UNUSED = 0,
  HALFSHADOW_TRIM_EVERYTHING = 1
} HalfshadowTrim;

typedef struct HalfshadowReport {
  size_t struct_size;
  uint64_t passes, draws, triangles, framebuffer_switches;
  uint64_t bytes_loaded, bytes_stored, memory_bytes;
  const char* plan_text;
} HalfshadowReport;

/* Null on failure; then *error and *message (both may be null) say why. */
HalfshadowEngine* halfshadow_create(const HalfshadowEngineDesc* desc, HalfshadowError* error,
                                    const char** message);
void halfshadow_destroy(HalfshadowEngine* engine);
/* Sentence of the last failed call on this engine; "" after success. */
const char* halfshadow_message(const HalfshadowEngine* engine);

HalfshadowError halfshadow_add_object(HalfshadowEngine* engine, const HalfshadowObjectDesc* desc,
                                      uint32_t* id);
HalfshadowError halfshadow_set_transform(HalfshadowEngine* engine, uint32_t id,
                                         const double world_from_object[16]);
HalfshadowError halfshadow_remove_object(HalfshadowEngine* engine, uint32_t id);
HalfshadowError halfshadow_set_lights(HalfshadowEngine* engine, const HalfshadowLightDesc* lights,
                                      size_t count);
HalfshadowError halfshadow_set_technique(HalfshadowEngine* engine, const char* id);
HalfshadowError halfshadow_set(HalfshadowEngine* engine, const char* key, const char* value);
/* `report` may be null. */
HalfshadowError halfshadow_render(HalfshadowEngine* engine, const HalfshadowRenderDesc* desc,
                                  HalfshadowReport* report);
uint32_t halfshadow_output_texture(const HalfshadowEngine* engine);
HalfshadowError halfshadow_read_output(HalfshadowEngine* engine, uint8_t* rgba, size_t byte_count);
/* Which programs were found to draw, to be kept for the next start; valid until the next call. */
const char* halfshadow_program_proofs(HalfshadowEngine* engine);
void halfshadow_context_lost(HalfshadowEngine* engine);
HalfshadowError halfshadow_context_restored(HalfshadowEngine* engine);
HalfshadowError halfshadow_trim(HalfshadowEngine* engine, HalfshadowTrim what);
/* 0: no limit. */
HalfshadowError halfshadow_set_memory_limit(HalfshadowEngine* engine, uint64_t bytes);

#undef HALFSHADOW_ENUM_TYPE

#ifdef __cplusplus
}
#endif

#endif
