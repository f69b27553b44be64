// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// Soft shadows of rectangular area lights on OpenGL ES 2.0, for a renderer that owns its context.
///
/// This library does NOT open a window, make a context, swap buffers, load files, or keep your data: it gets
/// meshes, lights and a camera, and draws into a framebuffer that you name, or into a texture that you read.
/// All calls come from the thread on which the context is current. No exceptions leave it: without memory a
/// call fails with outOfMemory and the engine goes on. An OpenGL ES error that the host had pending is still
/// pending after a call.
#pragma once

#include "halfshadow/types.hpp"

namespace halfshadow {

class Engine {
 public:
  /// Loads entry points and probes the context that is current. Null on failure; `outcome` then says why
  /// (driverMissing: an entry point is missing or the version is below 2.0).
  static Engine* create(const EngineDesc& desc, Outcome& outcome);
  /// Deletes all GL objects, so the context must be current, unless contextLost() was called.
  ~Engine();
  Engine(const Engine&) = delete;
  Engine& operator=(const Engine&) = delete;

  /// Copies, checks and uploads a mesh, once for all objects that are added with the same values. Degenerate
  /// and duplicate triangles are dropped. Errors: invalidMesh, emptyScene (no triangle is left),
  /// invalidArgument (non-finite transform), outOfMemory.
  Outcome addObject(const ObjectDesc& desc, ObjectId& id);
  /// Moves an object; light views that it touches are remade. Errors: invalidArgument.
  Outcome setTransform(ObjectId id, const double worldFromObject[16]);
  /// Replaces positions (and normals) of the same vertices and triangles: skinned and morphed meshes. Changes
  /// nothing when it fails. Errors: invalidArgument, invalidMesh, outOfMemory, contextLost.
  Outcome setVertices(ObjectId id, const MeshDesc& mesh);
  Outcome removeObject(ObjectId id);

  /// Up to kMaxLights lights. One with the same values as a light before is that light, wherever it stands in
  /// the list, and nothing of it is remade; among as many lights as before, one with other values is
  /// the light that stood in its place, moved; else a new one. Reports name a light by the lowest number that
  /// was free when it was new: "light 0". Errors: invalidLight, invalidArgument.
  Outcome setLights(const LightDesc* lights, std::size_t count);
  /// Errors: unknownTechnique, capabilityMissing (naming the capability).
  Outcome setTechnique(const char* id);
  /// "pcf.size" = "7". Errors: unknownSetting, invalidArgument; the message lists what is allowed.
  Outcome set(const char* key, const char* value);

  /// Renders one frame; without objects what is cleared, without lights what is unlit. Errors: invalidCamera,
  /// invalidArgument (an unknown enum, a size of 0 or above the limit, a framebuffer that is not complete or
  /// has no depth), capabilityMissing, shaderFailed, contextLost, driverFault, outOfMemory. On error nothing
  /// was drawn to the target, or it holds unshadowed receivers; never garbage.
  ///
  /// When nothing has changed since the last frame, neither `desc` nor anything that was set, the engine's
  /// own texture still holds the picture: no OpenGL call is made. A framebuffer of the host's may not hold it
  /// any more, so the receivers are drawn into it again, with all else as it is. With Timing::perPass
  /// everything that a moved camera would redraw is drawn.
  Outcome render(const RenderDesc& desc);
  /// What the last frame did, put together when it is asked for; empty after an error.
  FrameReport report();
  /// Both.
  Outcome render(const RenderDesc& desc, FrameReport& report);

  /// The last frame rendered with TargetDesc::Kind::engine: its texture (0 if none), and its pixels, RGBA,
  /// width × height × 4 bytes, top row first.
  std::uint32_t outputTexture() const;
  Outcome readOutput(std::uint8_t* rgba, std::size_t byteCount);

  /// Images of the last frame, for looking at what a technique works with: valid, with their names, until the
  /// engine's next call that changes or renders anything. They may be sampled, and must not be written. Of
  /// images that shared one texture only the last is listed; renderbuffers are not. Writes at most `capacity`
  /// records and returns how many there are: ask with capacity 0 first.
  std::size_t images(ImageRecord* records, std::size_t capacity) const;

  /// Shaders for a host that draws receivers itself. They stay valid while ForwardSerials::source is the
  /// same: also when a light has no caster left or goes out, which only changes uniforms. Errors:
  /// invalidArgument (no frame yet, no such light), capabilityMissing (the technique works on the screen
  /// only, e.g. sampled).
  Outcome forwardSource(std::size_t light, ForwardRecord& record);
  /// Of the last frame. Errors: those of forwardSource.
  Outcome forwardSerials(std::size_t light, ForwardSerials& serials);
  /// Sets the uniforms, samplers and texture bindings of the host's program for one object. The program must
  /// be current; units firstTextureUnit … are bound and stay bound: the host leaves them alone until the next
  /// render(). Call after render (Output::lightsOnly suffices).
  ///
  /// A program is looked up on its first call, and after that known by its name: a host that links it again,
  /// or deletes it, says so by forgetForwardProgram(). From the second object of a frame on a call makes at
  /// most 8 OpenGL ES calls, none of which asks the driver. Errors: invalidArgument (not linked, not made
  /// from forwardSource()'s texts, or from older ones; a matrix that is null or not finite; too few units).
  Outcome bindForward(std::size_t light, std::uint32_t program, const double worldFromObject[16],
                      int firstTextureUnit);
  void forgetForwardProgram(std::uint32_t program);

  /// GPU memory. Frames free by themselves what the few before them did not use, and at once what only a
  /// technique that is no longer chosen had; trim() does not wait. After Trim::everything there is no output
  /// until the next frame. The limit, 0 for none, holds for what is made from now on: a call that would pass
  /// it frees all it can, and else fails with outOfMemory.
  MemoryRecord memory() const;
  Outcome trim(Trim what);
  void setMemoryLimit(std::uint64_t bytes);

  /// The context was lost: GL names are forgotten, nothing is deleted, and nothing is called any more, not
  /// even by a call that is under way, which ends with contextLost. Objects, lights and settings stay, and
  /// may be changed by all calls but addObject and setVertices.
  void contextLost();
  /// Another context is current now: everything is made again on it, from what the engine kept. Entry points
  /// come from the EngineDesc's loader. Errors: driverMissing, outOfMemory; then the engine stays without a
  /// context. A technique that the new one does not support fails in render() until another is chosen.
  Outcome contextRestored();
  /// GL objects that are alive; 0 after the last engine is destroyed.
  int liveObjectCount() const;
  /// Waits until the GPU is done.
  void finish();

  /// Every program is drawn with once before it is used, since some drivers leave out draws of those they
  /// cannot compile, without an error: what was found so far, for EngineDesc::programProofs of the next
  /// start. Text of one line a program; valid until the next call.
  const char* programProofs();

  DriverRecord driver() const;
  // Records beyond the count are empty.
  std::size_t capabilityCount() const;
  CapabilityRecord capability(std::size_t index) const;
  std::size_t extensionCount() const;
  const char* extension(std::size_t index) const;
  std::size_t techniqueCount() const;
  TechniqueRecord technique(std::size_t index) const;
  std::size_t settingCount() const;
  SettingRecord setting(std::size_t index) const;

 private:
  Engine();
  struct State;
  State* state_;
};

}  // namespace halfshadow
