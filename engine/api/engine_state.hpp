// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// Everything behind the public Engine.
#pragma once

#include <array>
#include <map>
#include <memory>
#include <new>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "api/draw_items.hpp"
#include "api/engine_object.hpp"
#include "api/frame_desc.hpp"
#include "api/item_list.hpp"
#include "api/light_fallbacks.hpp"
#include "api/light_split.hpp"
#include "api/receiver_reach.hpp"
#include "api/refusal.hpp"
#include "api/scene_lists.hpp"
#include "base/block_fold.hpp"
#include "framegraph/executor.hpp"
#include "gl/context.hpp"
#include "gl/encoder.hpp"
#include "gl/host_state.hpp"
#include "gl/program.hpp"
#include "gl/program_proofs.hpp"
#include "halfshadow/halfshadow.hpp"
#include "planner/frame_planner.hpp"
#include "techniques/execution/light_passes.hpp"
#include "techniques/execution/receiver_pass.hpp"
#include "techniques/registry/registry.hpp"

namespace halfshadow {

/// What is kept of a light between frames.
struct LightCache {
  std::uint64_t key = 0;
  int mapSize = 0;
  api::ItemList casters;
  /// Receivers that are no casters, by index in the scene's lists, which had that revision.
  std::vector<std::uint32_t> shadowless;
  std::uint64_t shadowlessSeen = 0;
  api::ItemList shadowlessReceivers;  ///< of them
  api::KeptList<planner::CasterShape> casterShapes;
  BlockFold<scene::Bounds> castersWorld;  ///< of `casterShapes`
  scene::CasterGroups groups;
  scene::CasterSilhouettes silhouettes;
  scene::AreaLight light;  ///< within reach of single precision
  planner::LightFitter fitter;
  planner::LightFit fit;
  std::uint64_t reachKey = 0;  ///< of the scene that the reach was found in
  api::ReceiverReach reach;
  api::LightSplit split;
  api::Refusal refusal;
  api::LightFallbacks fallbacks;
  techniques::ForwardVariant forward;  ///< of the last frame in which it shadowed something
  std::uint64_t forwardOf = 0;         ///< of the technique and settings that this was with; 0 = none
  const techniques::Technique* passesOf = nullptr;
  std::unique_ptr<techniques::LightPasses> passes;
};

struct FrameLight {
  techniques::Technique* technique = nullptr;
  techniques::ReceiverShading shading;
  techniques::ReceiverProgramSet programs;
  techniques::ForwardVariant forward;
  bool allLit = false;  ///< it shadows nothing: a program made from another text is right too
};

/// Lives from declaration to the next frame; the lists that it draws are the engine's.
struct Frame {
  RenderDesc desc;
  techniques::View view;
  std::span<const techniques::DrawItem> receivers;
  std::vector<FrameLight> lights;
  api::Shading shading = api::Shading::together;
  framegraph::Graph graph;
  framegraph::ResourceId color;
  techniques::ShadingInputs shadingInputs;    ///< Output::shaded
  techniques::ReceiverShading screenShading;  ///< Output::shaded apart
  techniques::ReceiverProgramSet screenPrograms;

  // What became of it.
  framegraph::Plan plan;
  std::vector<planner::Skip> skips;
  std::vector<framegraph::PassReport> passReports;
  gl::Counters counters;
  std::uint64_t silhouettesExtracted = 0;
  techniques::MapUpdates::Counts castersDrawn;
  bool unchanged = false;           ///< asked for again, it was drawn in part or not at all
  std::uint64_t sceneRevision = 0;  ///< see State::sceneRevision
  bool valid = false;               ///< it was drawn without an error
};

/// Strings and arrays that a FrameReport points to.
struct ReportStorage {
  std::vector<framegraph::Graph::Skipped> skipped;
  std::vector<std::string> targets;
  std::vector<PassRecord> passes;
  std::vector<SkipRecord> skips;
  std::string planText, planGraphviz;
};

/// What of a light is the same whatever takes it.
struct LightRequest {
  std::size_t light = 0;
  std::uint64_t contentKey = 0, sceneKey = 0;  ///< of light and casters; the same with the receivers
  double receiverFarDistance = 0.0;
  std::span<const std::uint32_t> casters;  ///< by index in the scene's lists
};

struct SplitScene {
  techniques::LightScene scene;
  std::string reason;  ///< why the light is split, or not; may be empty
};

struct Engine::State {
  std::unique_ptr<gl::Context> context;
  HostState hostState = HostState::restore;
  std::unique_ptr<gl::ProgramCache> programs;
  gl::ProgramProofs proofs;              ///< of `programs`
  std::string proofsText, proofFailure;  ///< the latter: why some programs are unproven
  std::unique_ptr<gl::Encoder> encoder;
  std::unique_ptr<framegraph::Executor> executor;
  techniques::SharedTextures shared;
  std::vector<std::unique_ptr<techniques::Technique>> techniques;
  std::unique_ptr<techniques::Settings> settings;
  std::vector<std::string> techniqueReasons, settingTexts;
  techniques::Technique* technique = nullptr;
  api::MeshStore meshes;
  api::SurfaceStore surfaces;
  std::map<ObjectId, EngineObject> objects;
  api::SceneLists lists;  ///< of `objects`
  ObjectId nextId = 1;
  std::uint64_t nextRevision = 1;
  /// Of the host's; without one a dark light stands here, which shadows nothing.
  std::vector<scene::AreaLight> lights;
  bool hasLights = false;
  std::vector<std::uint64_t> lightRevisions;
  /// By which lights are named and known again, whatever their places: below kMaxLights, each once.
  std::vector<std::uint32_t> lightNumbers;
  planner::FramePlanner planner;
  std::array<LightCache, kMaxLights> lightCaches;  ///< by number
  api::ReceiverItems receivers;
  gl::Counters uploadsTold;   ///< at the end of the last frame
  std::uint64_t changes = 0;  ///< of anything that the host set, but settings, which count for themselves
  ReportStorage report;
  std::string message;
  std::unique_ptr<Frame> lastFrame;  ///< its graph names the output

  // Hosts that draw receivers (engine_forward.cpp).
  techniques::ForwardTexts forwardTexts;
  std::map<std::uint32_t, gl::Program> forwardPrograms;  ///< looked up, by name
  techniques::ForwardUnits forwardUnits{};               ///< since the last render()
  std::uint64_t forwardBindings = 0;                     ///< counts frames that were drawn
  /// With the technique's text, or where the light shadows nothing the one that it had before.
  void chooseForward(FrameLight& target, LightCache& cache) const;
  /// Errors: those of Engine::bindForward about the program.
  Result<gl::Program*> forwardProgram(std::uint32_t name, const FrameLight& light);

  // What the context was made with, for the next one.
  void* (*getProcAddress)(const char* name, void* user) = nullptr;
  void* getProcAddressUser = nullptr;
  Workers workers;  ///< the host's, which it lends to render()
  gl::ContextOptions contextOptions;
  std::string shaderFolder;

  /// Of the context, with its programs, passes and meshes (engine_create.cpp).
  static Engine* create(const EngineDesc& desc, Outcome& outcome);
  Status openContext();
  Status uploadObjects();
  Outcome fail(const Error& error);
  Status checkForward(std::size_t light) const;
  gl::HostStatePolicy policy() const;
  /// Null when there is none of that id.
  techniques::Technique* techniqueNamed(std::string_view id) const;
  std::uint64_t sceneRevision() const { return changes + settings->revision(); }
  LightCache& cacheOf(std::size_t light) { return lightCaches[lightNumbers[light]]; }
  std::string nameOf(std::size_t light) const { return "light " + std::to_string(lightNumbers[light]); }
  Outcome setTechnique(const char* id);
  Outcome setLights(const LightDesc* descs, std::size_t count);
  void setLights(std::vector<scene::AreaLight> checked);
  SettingRecord settingRecord(std::size_t index);
  FrameReport frameReport();
  Outcome addObject(const ObjectDesc& desc, ObjectId& id);
  Outcome setVertices(ObjectId id, const MeshDesc& desc);
  /// Its mesh or its place is another.
  void changed(EngineObject& object) {
    object.revision = nextRevision++;
    lists.objectChanged(object);
    ++changes;
  }

  // One light's passes (engine_lights.cpp).
  void fitLight(std::size_t light, const planner::LightPlan& plan);
  void listCasters(LightCache& cache, const planner::LightPlan& plan);
  Status declareLight(Frame& frame, techniques::FramePasses& passes, std::size_t index,
                      const planner::FramePlan& framePlan);
  /// Says which casters the technique takes for whole though alpha cuts holes into them.
  void noteHoles(Frame& frame, std::size_t light, const std::string& technique,
                 std::span<const techniques::DrawItem> casters) const;
  /// Of the receivers in the light's fit; found again when the scene changed.
  double receiverReach(LightCache& cache, std::uint64_t sceneKey) const;
  /// As the technique of the choice sees the light, with its settings.
  SplitScene sceneFor(const Frame& frame, const LightRequest& request,
                      const api::LightFallbacks::Choice& choice);
  /// The choice, or what takes its place where it cannot plan the scene; passes are prepared.
  Result<api::LightFallbacks::Choice> prepared(Frame& frame, const LightRequest& request,
                                               api::LightFallbacks::Choice choice);
  Status prepareLight(Frame& frame, const LightRequest& request, const api::LightFallbacks::Choice& choice);
  /// Uploads and declares the light's prepared passes.
  Result<techniques::ReceiverShading> shadingOf(techniques::FramePasses& passes, std::size_t index);
  // Programs that draw nothing (engine_proofs.cpp).
  /// What the light is drawn with; gives reasons where that is not `asked`. Errors: capabilityMissing.
  Result<api::LightFallbacks::Choice> choiceFor(Frame& frame, std::size_t light,
                                                techniques::Technique& asked);
  /// Proves every program that the declared frame draws with; false when the frame must be declared again,
  /// with what takes the place of those that draw nothing. `spent` is set to what proving cost. Errors:
  /// capabilityMissing.
  Result<bool> provePrograms(const Frame& frame, gl::Counters& spent);
  // The frame (engine_frame.cpp).
  void declareVisibilityPass(Frame& frame, std::vector<framegraph::Attachment> targets);
  Status declareReceiverPasses(Frame& frame);
  Status checkFrame(const RenderDesc& desc, const scene::Camera& camera) const;
  Status declareFrame(Frame& frame, const scene::Camera& camera);
  /// The same as the last frame: what it left is as it was.
  bool isUnchanged(const RenderDesc& desc) const;
  /// Draws of an unchanged frame what only the host could have kept. False when that takes a whole frame.
  Result<bool> drawUnchanged();
  Status renderFrame(const RenderDesc& desc);
  std::vector<ImageRecord> images() const;  ///< of the last frame (engine_images.cpp)
  Outcome render(const RenderDesc& desc);
  Outcome readOutput(std::uint8_t* rgba, std::size_t byteCount);
  std::uint64_t memoryBytes() const { return context->storedBytes(); }

  // What can be made anew (engine_memory.cpp).
  /// Forgets all but objects, lights and settings.
  void forgetDerived() noexcept;
  void forgetDriverWork() noexcept;
  /// Frees what a second attempt can do without; false when nothing is left to free.
  bool freeForRetry(int attempt) noexcept;
  /// The public interface throws nothing: a call without memory fails and leaves a usable engine.
  template <typename Call>
  Outcome guarded(Call&& call) noexcept;
};

template <typename Call>
Outcome Engine::State::guarded(Call&& call) noexcept {
  try {
    const bool wasLost = context->lost();
    const Outcome outcome = call();
    if (!wasLost && context->lost()) {
      return {ErrorCode::contextLost,
              "the context was lost during the call; make a new one current and call contextRestored"};
    }
    return outcome;
  } catch (const std::bad_alloc&) {
    forgetDerived();
    return {ErrorCode::outOfMemory, "the system has no memory left for this call; free some and call again"};
  } catch (...) {
    forgetDerived();
    return {ErrorCode::internal, "an unexpected exception inside the engine; please report it"};
  }
}

}  // namespace halfshadow
