// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "halfshadow/halfshadow.h"

#include <algorithm>
#include <memory>
#include <new>

#include "halfshadow/halfshadow.hpp"

struct HalfshadowEngine {
  std::unique_ptr<halfshadow::Engine> engine;
  const char* message = "";  ///< the engine's, or a literal
};

namespace {
using halfshadow::Outcome;

HalfshadowError finish(HalfshadowEngine* engine, const Outcome& outcome) {
  engine->message = outcome.message;
  return static_cast<HalfshadowError>(outcome.code);
}

HalfshadowError refuse(HalfshadowEngine* engine, const char* message) {
  if (engine) engine->message = message;
  return HALFSHADOW_INVALID_ARGUMENT;
}

/// A struct of this version, from a caller that may have been compiled against another.
template <typename T>
bool fits(const T* desc) {
  return desc != nullptr && desc->struct_size == sizeof(T);
}
constexpr const char* kWrongSize =
    "a struct is null or its struct_size is not sizeof the struct of this header";

constexpr const char* kNoEngine = "the engine is null; use one that halfshadow_create made";

template <typename T, std::size_t n>
void copy(const T (&source)[n], T (&target)[n]) {
  std::copy(source, source + n, target);
}
}  // namespace

extern "C" {

HalfshadowEngine* halfshadow_create(const HalfshadowEngineDesc* desc, HalfshadowError* error,
                                    const char** message) {
  Outcome outcome{halfshadow::ErrorCode::invalidArgument, kWrongSize};
  std::unique_ptr<HalfshadowEngine> made;
  if (fits(desc)) {
    halfshadow::Engine* engine =
        halfshadow::Engine::create({.getProcAddress = desc->get_proc_address,
                                    .getProcAddressUser = desc->get_proc_address_user,
                                    .forcedOff = desc->forced_off,
                                    .forcedOffCount = desc->forced_off_count,
                                    .hostState = static_cast<halfshadow::HostState>(desc->host_state),
                                    .programProofs = desc->program_proofs,
                                    .parallelFor = desc->parallel_for,
                                    .parallelForUser = desc->parallel_for_user},
                                   outcome);
    if (engine) {
      made.reset(new (std::nothrow) HalfshadowEngine);
      if (made) {
        made->engine.reset(engine);
      } else {
        delete engine;
        outcome = {halfshadow::ErrorCode::outOfMemory, "the system has no memory left for an engine"};
      }
    }
  }
  if (error) *error = static_cast<HalfshadowError>(outcome.code);
  if (message) *message = outcome.message;
  return made.release();
}

void halfshadow_destroy(HalfshadowEngine* engine) {
  delete engine;
}

const char* halfshadow_message(const HalfshadowEngine* engine) {
  return engine ? engine->message : "";
}

HalfshadowError halfshadow_add_object(HalfshadowEngine* engine, const HalfshadowObjectDesc* desc,
                                      uint32_t* id) {
  if (engine == nullptr) return refuse(engine, kNoEngine);
  if (!fits(desc)) return refuse(engine, kWrongSize);
  if (id == nullptr) return refuse(engine, "halfshadow_add_object needs a place for the id");
  halfshadow::ObjectDesc object;
  object.mesh = {.positions = desc->positions,
                 .positionStrideBytes = desc->position_stride_bytes ? desc->position_stride_bytes : 12,
                 .vertexCount = desc->vertex_count,
                 .indices = desc->indices,
                 .indexCount = desc->index_count,
                 .normals = desc->normals,
                 .texcoords = desc->texcoords,
                 .colors = desc->colors};
  const bool placed =
      std::any_of(desc->world_from_object, desc->world_from_object + 16, [](double e) { return e != 0; });
  if (placed) copy(desc->world_from_object, object.worldFromObject);
  object.casts = desc->casts != 0;
  object.receives = desc->receives != 0;
  copy(desc->base_color, object.baseColor);
  object.baseColorPixels = desc->base_color_pixels;
  object.baseColorWidth = desc->base_color_width;
  object.baseColorHeight = desc->base_color_height;
  object.baseColorChannels = desc->base_color_channels ? desc->base_color_channels : 4;
  object.alphaCutoff = desc->alpha_cutoff;
  object.singleSided = desc->single_sided != 0;
  return finish(engine, engine->engine->addObject(object, *id));
}

HalfshadowError halfshadow_set_transform(HalfshadowEngine* engine, uint32_t id,
                                         const double world_from_object[16]) {
  if (engine == nullptr) return refuse(engine, kNoEngine);
  if (world_from_object == nullptr)
    return refuse(engine, "halfshadow_set_transform needs a matrix of 16 numbers");
  return finish(engine, engine->engine->setTransform(id, world_from_object));
}

HalfshadowError halfshadow_remove_object(HalfshadowEngine* engine, uint32_t id) {
  if (engine == nullptr) return refuse(engine, kNoEngine);
  return finish(engine, engine->engine->removeObject(id));
}

HalfshadowError halfshadow_set_lights(HalfshadowEngine* engine, const HalfshadowLightDesc* lights,
                                      size_t count) {
  if (engine == nullptr) return refuse(engine, kNoEngine);
  halfshadow::LightDesc descs[halfshadow::kMaxLights];
  if (count > static_cast<size_t>(halfshadow::kMaxLights)) return refuse(engine, "at most 4 lights");
  for (size_t i = 0; i < count; ++i) {
    if (lights == nullptr || !fits(&lights[i])) return refuse(engine, kWrongSize);
    copy(lights[i].center, descs[i].center);
    copy(lights[i].half_u, descs[i].halfU);
    copy(lights[i].half_v, descs[i].halfV);
    copy(lights[i].emission, descs[i].emission);
    copy(lights[i].color, descs[i].color);
    descs[i].intensity = lights[i].intensity;
    descs[i].referenceDistance = lights[i].reference_distance;
    descs[i].innerConeRadians = lights[i].inner_cone_radians;
    descs[i].outerConeRadians = lights[i].outer_cone_radians;
  }
  return finish(engine, engine->engine->setLights(descs, count));
}

HalfshadowError halfshadow_set_technique(HalfshadowEngine* engine, const char* id) {
  if (engine == nullptr) return refuse(engine, kNoEngine);
  return finish(engine, engine->engine->setTechnique(id));
}

HalfshadowError halfshadow_set(HalfshadowEngine* engine, const char* key, const char* value) {
  if (engine == nullptr) return refuse(engine, kNoEngine);
  return finish(engine, engine->engine->set(key, value));
}

HalfshadowError halfshadow_render(HalfshadowEngine* engine, const HalfshadowRenderDesc* desc,
                                  HalfshadowReport* report) {
  if (engine == nullptr) return refuse(engine, kNoEngine);
  if (!fits(desc) || (report != nullptr && !fits(report))) return refuse(engine, kWrongSize);
  if (desc->output < HALFSHADOW_SHADED || desc->output > HALFSHADOW_LIGHTS_ONLY)
    return refuse(engine, "unknown output");
  halfshadow::RenderDesc frame;
  copy(desc->eye, frame.camera.eye);
  copy(desc->target, frame.camera.target);
  copy(desc->up, frame.camera.up);
  frame.camera.verticalFovRadians = desc->vertical_fov_radians;
  frame.camera.nearDistance = desc->near_distance;
  frame.camera.farDistance = desc->far_distance;
  frame.target = {.kind = desc->use_host_framebuffer ? halfshadow::TargetDesc::Kind::host
                                                     : halfshadow::TargetDesc::Kind::engine,
                  .framebuffer = desc->framebuffer,
                  .x = desc->x,
                  .y = desc->y,
                  .width = desc->width,
                  .height = desc->height};
  frame.output = static_cast<halfshadow::Output>(desc->output);
  copy(desc->clear_color, frame.clearColor);
  const HalfshadowError error = finish(engine, engine->engine->render(frame));
  if (report) {
    const halfshadow::FrameReport done = engine->engine->report();
    *report = {sizeof(HalfshadowReport), done.passCount,           done.draws,
               done.triangles,           done.framebufferSwitches, done.bytesLoaded,
               done.bytesStored,         done.memoryBytes,         done.planText};
  }
  return error;
}

uint32_t halfshadow_output_texture(const HalfshadowEngine* engine) {
  return engine ? engine->engine->outputTexture() : 0;
}

HalfshadowError halfshadow_read_output(HalfshadowEngine* engine, uint8_t* rgba, size_t byte_count) {
  if (engine == nullptr) return refuse(engine, kNoEngine);
  return finish(engine, engine->engine->readOutput(rgba, byte_count));
}

const char* halfshadow_program_proofs(HalfshadowEngine* engine) {
  return engine ? engine->engine->programProofs() : "";
}

void halfshadow_context_lost(HalfshadowEngine* engine) {
  if (engine) engine->engine->contextLost();
}

HalfshadowError halfshadow_context_restored(HalfshadowEngine* engine) {
  if (engine == nullptr) return refuse(engine, kNoEngine);
  return finish(engine, engine->engine->contextRestored());
}

HalfshadowError halfshadow_trim(HalfshadowEngine* engine, HalfshadowTrim what) {
  if (engine == nullptr) return refuse(engine, kNoEngine);
  return finish(engine, engine->engine->trim(static_cast<halfshadow::Trim>(what)));
}

HalfshadowError halfshadow_set_memory_limit(HalfshadowEngine* engine, uint64_t bytes) {
  if (engine == nullptr) return refuse(engine, kNoEngine);
  engine->engine->setMemoryLimit(bytes);
  return finish(engine, {});
}

}  // extern "C"
