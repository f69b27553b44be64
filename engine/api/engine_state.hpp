// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// Everything behind the public Engine.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "api/light_split.hpp"
#include "framegraph/executor.hpp"
#include "gl/context.hpp"
#include "gl/encoder.hpp"
#include "gl/host_state.hpp"
#include "gl/program.hpp"
#include "halfshadow/halfshadow.hpp"
#include "planner/frame_planner.hpp"
#include "scene/bounds.hpp"
#include "techniques/execution/gpu_mesh.hpp"
#include "techniques/execution/light_passes.hpp"
#include "techniques/execution/receiver_pass.hpp"
#include "techniques/registry/registry.hpp"

namespace halfshadow {

/// A receiver of which a camera sees so little that only that is drawn (see scene::cutToView).
struct CutReceiver {
  std::uint64_t key = 0;  ///< of the object and the view; 0 = not asked for yet
  bool needed = false;
  scene::TriangleMesh mesh;
  techniques::GpuMesh gpu;
};

struct EngineObject {
  ObjectId id = 0;
  scene::TriangleMesh mesh;  ///< recentred; kept for bounds, tight light fits and silhouettes
  scene::CasterGeometry geometry;
  techniques::GpuMesh gpu;
  glm::dmat4 worldFromHost{1.0};    ///< as the host placed the positions that it gave
  glm::dvec3 recenteredBy{0.0};     ///< what was taken off those
  glm::dmat4 worldFromObject{1.0};  ///< of the recentred positions
  scene::Bounds boundsObject, boundsWorld;
  bool mirrored = false;
  float solidity = 1.0f;  ///< of a caster, see scene::solidity(); of the first positions
  /// Sets worldFromObject and what follows from it; recenteredBy and boundsObject are set before.
  void place(const glm::dmat4& worldFromHostNow);
  /// Of the positions there are now; found on the first call.
  const scene::SupportingPlanes& support() const;
  bool casts = true, receives = true;
  glm::vec4 baseColor{1.0f};
  gl::Texture baseColorTexture;
  std::uint64_t revision = 0;
  mutable std::optional<scene::SupportingPlanes> supportingPlanes;  ///< see support()
  mutable CutReceiver cutReceiver;                                  ///< of the last frame
};

/// What is kept of a light between frames.
struct LightCache {
  std::uint64_t key = 0;
  int mapSize = 0;
  std::vector<glm::dvec3> casterPointsWorld;
  scene::CasterGroups groups;
  scene::AreaLight light;  ///< within reach of single precision
  planner::LightFit fit;
  std::uint64_t reachKey = 0;  ///< of the scene that receiverFarDistance was found in
  double receiverFarDistance = 0.0;
  api::LightSplit split;
  const techniques::Technique* passesOf = nullptr;
  std::unique_ptr<techniques::LightPasses> passes;
};

/// Strings and arrays that a FrameReport points to.
struct ReportStorage {
  std::uint64_t planKey = 0;  ///< of planText and planGraphviz
  std::vector<framegraph::PassReport> passReports;
  std::vector<framegraph::Graph::Skipped> skipped;
  std::vector<PassRecord> passes;
  std::vector<SkipRecord> skips;
  std::string planText, planGraphviz;
};

struct FrameLight {
  std::vector<techniques::DrawItem> casters;
  std::vector<techniques::DrawItem> shadowlessReceivers;
  techniques::ReceiverShading shading;
  techniques::ReceiverProgramSet programs;
};

/// Lives from declaration to execution of one frame.
struct Frame {
  techniques::View view;
  std::vector<techniques::DrawItem> receivers;
  std::vector<FrameLight> lights;
  framegraph::Graph graph;
  framegraph::ResourceId color;
  techniques::ShadingInputs shadingInputs;    ///< Output::shaded
  techniques::ReceiverShading screenShading;  ///< Output::shaded with several lights
  techniques::ReceiverProgramSet screenPrograms;
};

struct Engine::State {
  std::unique_ptr<gl::Context> context;
  HostState hostState = HostState::restore;
  std::unique_ptr<gl::ProgramCache> programs;
  std::unique_ptr<gl::Encoder> encoder;
  std::unique_ptr<framegraph::Executor> executor;
  techniques::SharedTextures shared;
  std::vector<std::unique_ptr<techniques::Technique>> techniques;
  std::unique_ptr<techniques::Settings> settings;
  std::vector<std::string> techniqueReasons, settingTexts;
  techniques::Technique* technique = nullptr;
  std::map<ObjectId, EngineObject> objects;
  ObjectId nextId = 1;
  std::uint64_t nextRevision = 1;
  std::vector<scene::AreaLight> lights;
  std::vector<std::uint64_t> lightRevisions;
  planner::FramePlanner planner;
  std::vector<LightCache> lightCaches;
  ReportStorage report;
  std::string message;
  std::unique_ptr<Frame> lastFrame;  ///< its graph names the output
  int outputWidth = 0, outputHeight = 0;

  techniques::ForwardTexts forwardTexts;

  Outcome fail(const Error& error);
  Status checkForward(std::size_t light) const;
  gl::HostStatePolicy policy() const;
  /// Null when there is none of that id.
  techniques::Technique* techniqueNamed(std::string_view id) const;
  Status declareLight(Frame& frame, techniques::FramePasses& passes, std::size_t index,
                      const planner::FramePlan& framePlan, const std::vector<const EngineObject*>& objects,
                      const RenderDesc& desc);
  /// Of the receivers in the light's fit; found again when the scene changed.
  double receiverReach(LightCache& cache, const std::vector<const EngineObject*>& objects,
                       std::uint64_t sceneKey) const;
  /// Prepares, uploads and declares the light's passes.
  Result<techniques::ReceiverShading> shadingOf(techniques::FramePasses& passes, std::size_t index,
                                                techniques::Technique& technique,
                                                const techniques::LightScene& scene);
  void declareVisibilityPass(Frame& frame, const RenderDesc& desc,
                             std::vector<framegraph::Attachment> targets);
  Status declareReceiverPasses(Frame& frame, const RenderDesc& desc);
  Status renderFrame(const RenderDesc& desc, FrameReport& report);
  void fillReport(const framegraph::Plan& plan, const planner::FramePlan& planned,
                  const gl::Counters& counters, FrameReport& report);
  std::uint64_t memoryBytes() const;
};

}  // namespace halfshadow
