// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// One frame's passes, declared: what each reads and writes. No GL here; compile() derives the rest.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "base/error.hpp"
#include "base/rect.hpp"

namespace halfshadow::framegraph {

/// Stages run in this order, so that on a tile-based GPU every light-space pass ends before the scene pass
/// begins (a mask pass in the middle of the scene pass would store and reload the whole screen).
enum class PassStage { light, mask, receiverPrepass, scene, resolve };

enum class Format { rgba8, depth16, depth24, stencil8, depth24Stencil8 };
std::uint64_t bytesPerPixel(Format format);

enum class Storage {
  texture,      ///< can be read by later passes
  renderbuffer  ///< attachment only
};
enum class Lifetime {
  transient,   ///< lives within the frame; its memory may be shared
  persistent,  ///< keeps its content between frames under its name
  imported     ///< the host's framebuffer
};
enum class Filter { nearest, linear, linearMipLinear, linearMipNearest, nearestMipNearest };

struct ResourceDesc {
  std::string name;  ///< unique in the graph; for persistent resources, the identity between frames
  int width = 0, height = 0;
  Format format = Format::rgba8;
  Storage storage = Storage::texture;
  Lifetime lifetime = Lifetime::transient;
  Filter filter = Filter::nearest;
  bool mipmapped = false;  ///< the chain is generated after the pass that wrote it
};

struct ResourceId {
  std::uint32_t index = ~0u;
  bool operator==(const ResourceId&) const = default;
  bool valid() const { return index != ~0u; }
};
struct PassId {
  std::uint32_t index = ~0u;
};

/// Key of persistent content that is valid but was written by a pass without a contentKey.
inline constexpr std::uint64_t kUnidentifiedContent = ~std::uint64_t{0};

enum class AttachmentPoint { color, depth, stencil, depthStencil };

/// What a pass needs to find in an attachment when it starts.
enum class InitialContent {
  clear,    ///< the clear value
  keep,     ///< what an earlier pass (or the host, or the last frame) left: a load
  dontCare  ///< every pixel is overwritten
};

struct ClearValue {
  float color[4] = {0, 0, 0, 0};
  float depth = 1.0f;
  int stencil = 0;
  bool operator==(const ClearValue&) const = default;
};

struct Attachment {
  ResourceId resource;
  AttachmentPoint point = AttachmentPoint::color;
  InitialContent initial = InitialContent::clear;
  ClearValue clear;
  bool operator==(const Attachment&) const = default;
};

/// How a pass makes its content from what its targets hold of another frame.
struct Update {
  std::uint64_t fromKey = 0;  ///< content key of what they must hold for that; 0: it does not
  std::vector<Rect> parts;    ///< of the targets: outside of them nothing is different
};

/// Handed to a pass when it runs; the executor's type, opaque to the plan.
class PassContext;

struct PassDesc {
  std::string name;
  PassStage stage = PassStage::scene;
  std::vector<ResourceId> reads;
  std::vector<Attachment> writes;
  /// Non-zero: identifies the content that this pass leaves in its persistent targets (a hash of everything
  /// it depends on). When all of them already hold exactly this, the pass is skipped.
  std::uint64_t contentKey = 0;
  /// Of a pass with a contentKey that clears all its targets: where the persistent ones hold what it says,
  /// they are loaded, its parts alone are cleared, and the pass draws into them alone (PassContext::updates).
  Update update{};
  /// Why the framebuffer is bound a second time, when another pass of the frame wrote the same attachments.
  std::string rebindReason;
  std::function<void(PassContext&)> execute;
};

/// A framebuffer of the host's, as a colour (and depth) target of the frame.
struct ImportedTarget {
  std::uint32_t framebufferName = 0;
  int x = 0, y = 0, width = 0, height = 0;
};

class Graph {
 public:
  ResourceId addResource(ResourceDesc desc);
  /// The host's framebuffer; `initial` content of its attachments is the host's.
  ResourceId importTarget(std::string name, const ImportedTarget& target);
  PassId addPass(PassDesc desc);
  /// The resource is read after the frame (by the host, or a read-back): passes that feed it are kept.
  void markOutput(ResourceId resource);
  /// Records something that was not done, with its reason, for the report.
  void noteSkipped(std::string what, std::string why);

  const std::vector<ResourceDesc>& resources() const { return resources_; }
  const std::vector<PassDesc>& passes() const { return passes_; }
  const std::vector<ResourceId>& outputs() const { return outputs_; }
  const std::vector<ImportedTarget>& importedTargets() const { return importedTargets_; }
  struct Skipped {
    std::string what, why;
  };
  const std::vector<Skipped>& skipped() const { return skipped_; }
  /// Index into importedTargets() for an imported resource.
  std::size_t importedIndex(ResourceId resource) const;

 private:
  std::vector<ResourceDesc> resources_;
  std::vector<PassDesc> passes_;
  std::vector<ResourceId> outputs_;
  std::vector<ImportedTarget> importedTargets_;
  std::vector<std::uint32_t> importedOfResource_;
  std::vector<Skipped> skipped_;
};

}  // namespace halfshadow::framegraph
