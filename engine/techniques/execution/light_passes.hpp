// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// A light's plan on the GPU: its programs, textures and buffers, and its passes in the frame's graph.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "framegraph/executor.hpp"
#include "gl/program.hpp"
#include "techniques/core/pass_plan.hpp"
#include "techniques/execution/receiver_pass.hpp"
#include "techniques/execution/shared_textures.hpp"

namespace halfshadow::techniques {

/// What all lights upload with.
struct Device {
  gl::Context& context;
  gl::ProgramCache& programs;
  SharedTextures& shared;
};

/// One light under one technique, from frame to frame.
class LightPasses {
 public:
  explicit LightPasses(std::unique_ptr<LightPlanner> planner) : planner_(std::move(planner)) {}

  /// CPU only. Errors: those of LightPlanner::plan().
  Status prepare(const LightScene& scene);
  /// Links programs, and uploads what changed since the last frame. Errors: shaderFailed, outOfMemory.
  Status upload(Device& device);
  /// Adds images and passes; they refer to this and to `view` until the frame ends.
  ReceiverShading declare(const View& view, framegraph::Graph& graph) const;
  std::uint64_t memoryBytes() const;  ///< of textures and buffers of its own

 private:
  struct DrawPrograms {
    gl::Program* program = nullptr;
    ReceiverProgramSet receivers;  ///< of ReceiversDraw
  };
  struct OwnTexture {
    std::uint64_t key = 0;
    gl::Texture texture;
  };
  struct OwnBuffer {
    std::uint64_t key = 0;
    gl::Buffer buffer;
  };
  Status link(Device& device);
  Status uploadTextures(Device& device);
  Status uploadBuffers(Device& device);
  void run(std::size_t pass, const View& view, std::span<const framegraph::ResourceId> images,
           framegraph::PassContext& context) const;
  void drawMeshes(gl::Encoder& encoder, gl::Program& program, const PlannedDraw& draw,
                  const MeshDraw& meshes) const;
  void drawBuffers(gl::Encoder& encoder, const PlannedDraw& draw, const BufferDraw& triangles) const;

  std::unique_ptr<LightPlanner> planner_;
  PassPlan plan_;
  std::vector<std::vector<DrawPrograms>> programs_;  ///< by pass and draw
  std::map<std::string, OwnTexture, std::less<>> textures_;
  std::vector<const gl::Texture*> texturesOfPlan_;
  std::vector<OwnBuffer> buffers_;
};

}  // namespace halfshadow::techniques
