// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// One light over casters, its passes declared and run without an engine, so that what they compute can be
/// read back.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "framegraph/executor.hpp"
#include "gl_fixture.hpp"
#include "scene/scene_description.hpp"
#include "techniques/parts/maps/light_depth.hpp"
#include "techniques/registry/registry.hpp"

namespace halfshadow::test {

class LightRig {
 public:
  LightRig(gl::Context& context, const scene::SceneDescription& scene, int mapSize);

  techniques::LightFrame& frame() { return *frame_; }
  framegraph::Graph& graph() { return graph_; }
  /// Runs everything that the resource depends on. Bytes are RGBA, bottom row first.
  std::vector<std::uint8_t> run(framegraph::ResourceId resource);

 private:
  gl::Context& context_;
  gl::ProgramCache programs_;
  techniques::SharedTextures shared_;
  techniques::Settings settings_;
  framegraph::Graph graph_;
  techniques::View view_;
  scene::AreaLight light_;
  std::vector<techniques::GpuMesh> meshes_;
  std::vector<techniques::DrawItem> casters_;
  std::vector<glm::dvec3> points_;
  scene::CasterGroups groups_;
  gl::Encoder encoder_;
  std::unique_ptr<framegraph::Executor> executor_;
  std::unique_ptr<techniques::LightFrame> frame_;
};

/// Opens "box@light=1" and the like.
scene::SceneDescription openBuiltin(const std::string& name);

}  // namespace halfshadow::test
