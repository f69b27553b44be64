// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// One light over casters, its passes planned and run without an engine, so that what they compute can be
/// read back.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "framegraph/executor.hpp"
#include "gl_fixture.hpp"
#include "scene/scene_description.hpp"
#include "techniques/execution/gpu_mesh.hpp"
#include "techniques/execution/light_passes.hpp"
#include "techniques/registry/registry.hpp"

namespace halfshadow::test {

class LightRig {
 public:
  LightRig(gl::Context& context, const scene::SceneDescription& scene, int mapSize);

  /// Adds passes and answers with the image to read.
  using Build = std::function<framegraph::ResourceId(const techniques::LightScene&, techniques::PassPlan&)>;
  /// Runs everything that the image depends on. Bytes are RGBA, bottom row first.
  std::vector<std::uint8_t> run(const Build& build);
  const techniques::LightScene& scene() const { return *scene_; }

 private:
  gl::Context& context_;
  gl::ProgramCache programs_;
  techniques::SharedTextures shared_;
  techniques::Settings settings_;
  techniques::View view_;
  scene::AreaLight light_;
  std::vector<techniques::GpuMesh> meshes_;
  std::vector<techniques::DrawItem> casters_;
  std::vector<glm::dvec3> points_;
  planner::CasterShape shape_;  ///< of all of them
  scene::CasterGroups groups_;
  scene::CasterSilhouettes silhouettes_;
  gl::Encoder encoder_;
  std::unique_ptr<framegraph::Executor> executor_;
  std::unique_ptr<techniques::LightScene> scene_;
};

/// The plan's image of that name.
framegraph::ResourceId imageNamed(const techniques::PassPlan& plan, const std::string& name);

/// Opens "box@light=1" and the like.
scene::SceneDescription openBuiltin(const std::string& name);

}  // namespace halfshadow::test
