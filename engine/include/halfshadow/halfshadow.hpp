// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// Soft shadows of rectangular area lights on OpenGL ES 2.0, for a renderer that owns its context.
///
/// This library does NOT open a window, make a context, swap buffers, load files, or keep your data: it gets
/// meshes, lights and a camera, and draws into a framebuffer that you name, or into a texture that you read.
/// All calls come from the thread on which the context is current. No exceptions leave it.
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

  /// Copies, checks and uploads a mesh, once for all objects that are added with the same values. Degenerate and duplicate triangles are dropped. Errors: invalidMesh,
  /// emptyScene (no triangle is left), invalidArgument (non-finite transform), outOfMemory.
  Outcome addObject(const ObjectDesc& desc, ObjectId& id);
  /// Moves an object; light views that it touches are remade. Errors: invalidArgument.
  Outcome setTransform(ObjectId id, const double worldFromObject[16]);
  /// Replaces positions (and normals) of the same vertices and triangles: skinned and morphed meshes.
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

  /// Renders one frame. Errors: invalidCamera, invalidArgument (size 0 or above the limit), emptyScene,
  /// shaderFailed, contextLost, driverFault, outOfMemory. On error nothing was drawn to the target, or it
  /// holds unshadowed receivers; never garbage.
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
  /// images that shared one texture only the last is listed; renderbuffers are not.
  std::size_t imageCount() const;
  ImageRecord image(std::size_t index) const;

  /// Shaders for a host that draws receivers itself. Valid for the technique, settings and light of the last
  /// frame; ask again when they change. Errors: invalidArgument (no frame yet, no such light),
  /// capabilityMissing (the technique works on the screen only, e.g. sampled).
  Outcome forwardSource(std::size_t light, ForwardRecord& record);
  /// Sets the uniforms, samplers and texture bindings of the host's program for one object. The program must
  /// be current; units firstTextureUnit … are bound and stay bound. Call after render (Output::lightsOnly
  /// suffices).
  Outcome bindForward(std::size_t light, std::uint32_t program, const double worldFromObject[16],
                      int firstTextureUnit);

  /// The context was lost: GL names are forgotten, nothing is deleted; then only destruction is allowed.
  void contextLost();
  /// GL objects that are alive; 0 after the last engine is destroyed.
  int liveObjectCount() const;
  /// Waits until the GPU is done.
  void finish();

  /// Every program is drawn with once before it is used, since some drivers leave out draws of those they
  /// cannot compile, without an error: what was found so far, for EngineDesc::programProofs of the next
  /// start. Text of one line a program; valid until the next call.
  const char* programProofs();

  DriverRecord driver() const;
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
