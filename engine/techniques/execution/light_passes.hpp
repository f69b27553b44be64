// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// A light's plan on the GPU: its programs, textures and buffers, and its passes in the frame's graph.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <unordered_map>
#include <vector>

#include "framegraph/executor.hpp"
#include "gl/program.hpp"
#include "techniques/core/pass_plan.hpp"
#include "techniques/execution/map_updates.hpp"
#include "techniques/execution/program_uses.hpp"
#include "techniques/execution/receiver_pass.hpp"
#include "techniques/execution/shared_textures.hpp"

namespace halfshadow::techniques {

/// What all lights upload with.
struct Device {
  gl::Context& context;
  gl::ProgramCache& programs;
  SharedTextures& shared;
  bool holes = true;  ///< some object of the scene has holes that alpha cuts
};

class LightPasses;

/// A pass that several lights draw into, while their passes are declared.
struct SharedPass {
  std::string name;
  struct Part {
    LightPasses* light = nullptr;
    std::size_t pass = 0;
    std::vector<framegraph::ResourceId> images;
  };
  std::shared_ptr<std::vector<Part>> parts;
};

/// What the lights of one frame declare into.
struct FramePasses {
  const View& view;
  framegraph::Graph& graph;
  std::vector<SharedPass> shared{};
};

/// One light under one technique, from frame to frame.
class LightPasses {
 public:
  explicit LightPasses(std::unique_ptr<LightPlanner> planner) : planner_(std::move(planner)) {}

  /// CPU only. `casterKeys`, `casterChanges`: of the scene's casters, or none. Errors: those of
  /// LightPlanner::plan().
  Status prepare(const LightScene& scene, std::span<const ItemHistory::Key> casterKeys = {},
                 const ListChanges& casterChanges = {});
  /// Links programs, and uploads what changed since the last frame. Errors: shaderFailed, outOfMemory.
  Status upload(Device& device);
  /// What the passes draw with. After upload().
  void addUses(ProgramUses& uses) const;
  /// Adds images and passes; they refer to this and to the view until the frame ends.
  ReceiverShading declare(FramePasses& frame);
  /// After the frame's passes ran.
  const MapUpdates::Counts& castersDrawn() const { return updates_.counts(); }
  /// Calls `visit(name, texture)` for each texture of the technique's own.
  template <typename Visit>
  void visitTextures(Visit visit) const {
    for (const auto& [name, own] : textures_) {
      if (own.texture) visit(name, own.texture);
    }
  }

 private:
  struct OwnTexture {
    std::uint64_t key = 0;
    gl::Texture texture;
  };
  struct OwnBuffer {
    std::uint64_t key = 0;
    gl::Buffer buffer;
  };
  using Images = std::vector<framegraph::ResourceId>;  ///< of the plan's, the graph's
  Status link(Device& device);
  Status uploadTextures(Device& device);
  Status uploadBuffers(Device& device);
  Images declareImages(framegraph::Graph& graph) const;
  void declarePass(std::size_t pass, const Images& images, FramePasses& frame);
  void run(std::size_t pass, std::size_t firstDraw, const View& view, const Images& images,
           framegraph::PassContext& context);
  void runDraw(const PlannedDraw& draw, const Images& images, framegraph::PassContext& context) const;
  /// What of the pass is different.
  void runUpdate(std::size_t pass, const Images& images, framegraph::PassContext& context) const;
  /// Of the variants that cut holes.
  void addCuttingUses(ProgramUses& uses, const PlannedDraw& draw, const ProgramUses::DescOf& descOf) const;
  /// The variants that cut holes of one of the plan's programs that draws such items.
  Status linkCutting(Device& device, std::uint32_t program, std::span<const DrawItem> items);
  void setUp(gl::Encoder& encoder, gl::Program& program, const PlannedDraw& draw, const Images& images,
             framegraph::PassContext& context) const;
  /// `part`: what of the items is drawn, and where; null: all.
  void drawMeshes(const PlannedDraw& draw, const MeshDraw& meshes, const Images& images,
                  framegraph::PassContext& context, const MapUpdates::DrawPart* part = nullptr) const;
  void drawBuffers(gl::Encoder& encoder, const PlannedDraw& draw, const BufferDraw& triangles) const;

  std::unique_ptr<LightPlanner> planner_;
  PassPlan plan_;
  std::vector<gl::Program*> programs_;                              ///< by PassPlan::programs
  std::map<std::pair<std::uint32_t, bool>, gl::Program*> cutting_;  ///< the same; with colours of vertices?
  MapUpdates updates_;
  std::vector<std::vector<ReceiverProgramSet>> receivers_;  ///< by pass and draw; of ReceiversDraw alone
  std::map<std::string, OwnTexture, std::less<>> textures_;
  std::vector<const gl::Texture*> texturesOfPlan_;
  std::unordered_map<std::uint64_t, OwnBuffer> buffers_;  ///< by PlannedBuffer::id
  std::vector<const gl::Buffer*> buffersOfPlan_;
};

}  // namespace halfshadow::techniques
