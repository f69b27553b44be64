// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// Images behind the resources of a graph, kept between frames: persistent ones under their name, transient
/// ones shared by equal description, and the framebuffers made over them.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "framegraph/graph.hpp"
#include "gl/objects.hpp"

namespace halfshadow::framegraph {

/// A texture or a renderbuffer.
struct Image {
  ResourceDesc desc;
  gl::Texture texture;
  gl::Renderbuffer renderbuffer;
  std::uint64_t serial = 0;      ///< never reused, so that a cached framebuffer never meets a newer image
  std::uint64_t contentKey = 0;  ///< of persistent images; 0 = nothing valid
  std::uint64_t lastRun = 0;
  bool taken = false;  ///< transient: some resource of the frame lives in it
};

/// Images at the three points of a framebuffer; null = none. A packed image stands at `depth`.
struct AttachedImages {
  const Image* color = nullptr;
  const Image* depth = nullptr;
  const Image* stencil = nullptr;
};

/// Of the texture behind a resource with Storage::texture and a format that textures have.
gl::TextureDesc textureDescOf(const ResourceDesc& desc, const device::Capabilities& capabilities);

class ResourcePool {
 public:
  explicit ResourcePool(gl::Context& context) : context_(context) {}

  void beginRun();  ///< all transient images become free
  /// The last run counts once more, with the images that it used.
  void repeatRun();
  /// The persistent image of this name; one of another description is replaced (its content is lost).
  /// Errors: those of createImage.
  Result<Image*> persistent(const ResourceDesc& desc);
  /// Null unless an image of this name and description exists.
  Image* findPersistent(const ResourceDesc& desc) const;
  /// A free transient image of this description, made when there is none.
  Result<Image*> takeTransient(const ResourceDesc& desc);
  /// Errors: capabilityMissing when the driver refuses the combination.
  Result<const gl::Framebuffer*> framebuffer(const AttachedImages& images);

  std::uint64_t memoryBytes() const;
  /// Not used by the last `runs` runs; with 0 every image is.
  bool isStale(const Image& image, int runs) const;
  /// Frees stale images, and framebuffers over transient ones that no such run had together.
  void trim(int runs);
  void forgetContent();  ///< all content keys become 0

 private:
  using FramebufferKey = std::array<std::uint64_t, 3>;
  /// Errors: internal (a depth texture without the capability, a colour renderbuffer), capabilityMissing
  /// (packed depth-stencil), and those of the GL objects.
  Result<std::unique_ptr<Image>> createImage(const ResourceDesc& desc);
  void forgetFramebuffersOf(const Image& image);
  bool isOld(std::uint64_t lastRun, int runs) const;

  gl::Context& context_;
  std::map<std::string, std::unique_ptr<Image>> persistent_;
  std::vector<std::unique_ptr<Image>> transient_;
  struct AttachedFramebuffer {
    gl::Framebuffer framebuffer;
    std::uint64_t lastRun = 0;
    bool transient = false;  ///< some image of it is: another frame may put others beside it
  };
  std::map<FramebufferKey, AttachedFramebuffer> framebuffers_;
  std::uint64_t nextSerial_ = 1;
  std::uint64_t run_ = 0;
};

}  // namespace halfshadow::framegraph
