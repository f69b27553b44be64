// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// The passes of one light as data: what preparation leaves for the GPU. No GL.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "base/error.hpp"
#include "device/program_variant.hpp"
#include "device/texture_desc.hpp"
#include "framegraph/graph.hpp"
#include "techniques/core/light_scene.hpp"
#include "techniques/core/receiver_shading.hpp"

namespace halfshadow::techniques {

/// A triangle over the whole viewport.
struct FullscreenDraw {};

/// Objects by their own meshes.
struct MeshDraw {
  std::span<const DrawItem> items;  ///< live until the frame ends; see PassPlan::keep()
  glm::dmat4 clipFromWorld{1.0};
  device::UniformKey clipFromObject = "u_clipFromObject";
  MeshStreams streams = MeshStreams::positions;
  /// Faces left out, of those that hiddenFaces() tells of `eyeWorld`.
  enum class Faces {
    all,     ///< none is left out
    facing,  ///< by the camera: those that unseenFaces() tells are
    turned,  ///< the hidden ones are, in a space that looks along +z of a right-handed one, as maps do
    averted  ///< those that are seen are left out; in such a space
  } faces = Faces::all;
  glm::dvec3 eyeWorld{0.0};
  double nearReach = 0.0;
};

/// Triangles from buffers of the plan.
struct BufferDraw {
  struct Attribute {
    device::VertexAttribute attribute = device::VertexAttribute::position;
    std::uint32_t buffer = 0;  ///< in PassPlan::buffers
    int components = 3;
    device::AttributeType type = device::AttributeType::float32;
    int strideBytes = 0;
    std::size_t offsetBytes = 0;
  };
  std::vector<Attribute> attributes;
  std::uint32_t indices = 0;  ///< in PassPlan::buffers; read unless indexType is none
  device::IndexType indexType = device::IndexType::none;
  std::size_t first = 0, count = 0;  ///< vertices, or indices
};

/// The receivers with a visibility function, as on the screen.
struct ReceiversDraw {
  ReceiverShading shading;
  ReceiverOutput output = ReceiverOutput::visibility;
  std::span<const DrawItem> items;
  ReceiverTarget target;
};

/// An image read back, changed on the CPU, and drawn over the viewport by the draw's program.
struct ReadBackDraw {
  framegraph::ResourceId image;
  int width = 0, height = 0;
  device::UniformKey sampler;
  std::function<void(std::vector<std::uint8_t>& rgba)> change;
};

/// One program with what it reads, and what is drawn with it.
struct PlannedDraw {
  std::uint32_t program = 0;  ///< in PassPlan::programs; of all but ReceiversDraw, whose shading has its own
  std::vector<TextureRead> textures{};
  device::UniformList uniforms{};
  device::DrawState state{};
  std::optional<Rect> viewport{};  ///< of the target; else all of it
  std::variant<FullscreenDraw, MeshDraw, BufferDraw, ReceiversDraw, ReadBackDraw> what{};
};

/// Resources are indices into the plan's images. What the draws read is what the pass reads.
struct PlannedPass {
  std::string name;
  framegraph::PassStage stage = framegraph::PassStage::mask;
  std::vector<framegraph::Attachment> writes{};
  std::uint64_t contentKey = 0;  ///< see framegraph::PassDesc
  std::string rebindReason{};
  std::vector<PlannedDraw> draws{};
  /// Set: one pass of this name serves all lights of the frame. So many draws, the first, are drawn once;
  /// those after them for each light. All lights plan the same writes, and draws after the first read nothing
  /// more.
  std::optional<std::size_t> drawsForAllLights{};
};

/// A texture of the technique's own. Uploaded when its key changes.
using Pixels = std::shared_ptr<const std::vector<std::uint8_t>>;
struct PlannedTexture {
  std::string name;
  device::TextureDesc desc;
  std::uint64_t key = 0;           ///< of its content; never 0
  bool forAllLights = false;       ///< a constant: uploaded once under this name
  std::function<Pixels()> pixels;  ///< called when they are uploaded
};

/// Vertices or indices. Uploaded when its key changes.
struct PlannedBuffer {
  enum class Kind { vertices, indices } kind = Kind::vertices;
  std::uint64_t id = 0;   ///< the same from frame to frame, so that GL's buffer is kept; once a plan
  std::uint64_t key = 0;  ///< of its content; never 0
  std::shared_ptr<const std::vector<std::byte>> bytes;
};

struct PassPlan {
  std::vector<device::ProgramVariant> programs;
  std::vector<framegraph::ResourceDesc> images;
  std::vector<bool> imageIsShared;  ///< by image: all lights that plan one of this name mean the same
  std::vector<PlannedPass> passes;
  std::vector<PlannedTexture> textures;
  std::vector<PlannedBuffer> buffers;
  std::vector<framegraph::Graph::Skipped> notes;  ///< what was not done, with its reason
  ReceiverShading shading;                        ///< its resources are indices into `images`

  void note(std::string what, std::string why) { notes.push_back({std::move(what), std::move(why)}); }

  std::uint32_t addProgram(device::ProgramVariant variant);  ///< once each
  framegraph::ResourceId addImage(framegraph::ResourceDesc desc);
  framegraph::ResourceId addSharedImage(framegraph::ResourceDesc desc);
  std::uint32_t addTexture(PlannedTexture texture);
  std::uint32_t addBuffer(PlannedBuffer buffer);
  /// Items that live as long as the plan.
  std::span<const DrawItem> keep(std::vector<DrawItem> items);

 private:
  std::vector<std::unique_ptr<std::vector<DrawItem>>> kept_;
};

/// Bytes of a stream of vertices or indices.
template <typename T>
std::shared_ptr<const std::vector<std::byte>> streamBytes(const std::vector<T>& stream) {
  const auto bytes = std::as_bytes(std::span<const T>(stream));
  return std::make_shared<const std::vector<std::byte>>(bytes.begin(), bytes.end());
}

/// Setting filter_skip: the device profile's choice.
FilterSkip preferredSkip(const LightScene& scene);

/// Setting program_size.
bool hasShortPrograms(const LightScene& scene);
bool hasProgramsInParts(const LightScene& scene);

/// Makes one light's passes, frame after frame: kept beside the light, with whatever it needs to know again.
class LightPlanner {
 public:
  virtual ~LightPlanner() = default;
  /// CPU only. Into an empty `plan`. Errors: invalidArgument, outOfMemory.
  virtual Status plan(const LightScene& scene, PassPlan& plan) = 0;
};

/// One that keeps nothing.
template <Status (*kPlan)(const LightScene&, PassPlan&)>
class PlainPlanner final : public LightPlanner {
 public:
  Status plan(const LightScene& scene, PassPlan& plan) override { return kPlan(scene, plan); }
};

}  // namespace halfshadow::techniques
