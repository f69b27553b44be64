// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "framegraph/resource_pool.hpp"

#include <algorithm>
#include <utility>

namespace halfshadow::framegraph {
namespace {

// Everything but the name and the lifetime.
bool sameImage(const ResourceDesc& a, const ResourceDesc& b) {
  return a.width == b.width && a.height == b.height && a.format == b.format && a.storage == b.storage &&
         a.filter == b.filter && a.mipmapped == b.mipmapped;
}

gl::TextureFilter filterOf(Filter filter) {
  switch (filter) {
    case Filter::nearest:
      return gl::TextureFilter::nearest;
    case Filter::linear:
      return gl::TextureFilter::linear;
    case Filter::linearMipLinear:
      return gl::TextureFilter::linearMipLinear;
    case Filter::linearMipNearest:
      return gl::TextureFilter::linearMipNearest;
    case Filter::nearestMipNearest:
      return gl::TextureFilter::nearestMipNearest;
  }
  return gl::TextureFilter::nearest;
}

Error missing(const ResourceDesc& desc, device::Capability capability, ErrorCode code) {
  return Error{code, "resource '" + desc.name + "' needs the capability '" +
                         std::string(device::capabilityName(capability)) +
                         "', which this driver lacks; declare another format or storage"};
}

gl::TextureFormat textureFormatOf(Format format, bool has24) {
  switch (format) {
    case Format::depth16:
      return gl::TextureFormat::depth16;
    case Format::depth24:
      return has24 ? gl::TextureFormat::depth24 : gl::TextureFormat::depth16;
    case Format::depth24Stencil8:
      return gl::TextureFormat::depth24Stencil8;
    case Format::rgba8:
    case Format::stencil8:
      break;
  }
  return gl::TextureFormat::rgba8;
}

}  // namespace

gl::TextureDesc textureDescOf(const ResourceDesc& desc, const device::Capabilities& capabilities) {
  return {.width = desc.width,
          .height = desc.height,
          .format = textureFormatOf(desc.format, capabilities.has(device::Capability::depth24)),
          .filter = filterOf(desc.filter),
          .mipmapped = desc.mipmapped};
}

void ResourcePool::beginRun() {
  ++run_;
  for (const auto& image : transient_) image->taken = false;
}

void ResourcePool::repeatRun() {
  const auto repeat = [&](Image& image) {
    if (image.lastRun == run_) ++image.lastRun;
  };
  for (const auto& [name, image] : persistent_) repeat(*image);
  for (const auto& image : transient_) repeat(*image);
  for (auto& [key, attached] : framebuffers_) {
    if (attached.lastRun == run_) ++attached.lastRun;
  }
  ++run_;
}

Result<std::unique_ptr<Image>> ResourcePool::createImage(const ResourceDesc& desc) {
  const device::Capabilities& capabilities = context_.capabilities();
  const bool isTexture = desc.storage == Storage::texture;
  const bool hasDepth = desc.format != Format::rgba8 && desc.format != Format::stencil8;
  if (isTexture && hasDepth && !capabilities.has(device::Capability::depthTexture)) {
    return missing(desc, device::Capability::depthTexture, ErrorCode::internal);
  }
  if (desc.format == Format::depth24Stencil8 && !capabilities.has(device::Capability::packedDepthStencil)) {
    return missing(desc, device::Capability::packedDepthStencil, ErrorCode::capabilityMissing);
  }
  const bool has24 = capabilities.has(device::Capability::depth24);
  gl::RenderbufferFormat renderbufferFormat = gl::RenderbufferFormat::depth16;
  switch (desc.format) {
    case Format::rgba8:
      if (!isTexture) {
        return Error{ErrorCode::internal,
                     "resource '" + desc.name +
                         "' is a colour renderbuffer, which has 4 or 5 bits a channel in "
                         "OpenGL ES 2.0; declare Storage::texture"};
      }
      break;
    case Format::depth16:
      break;
    case Format::depth24:
      renderbufferFormat = has24 ? gl::RenderbufferFormat::depth24 : gl::RenderbufferFormat::depth16;
      break;
    case Format::stencil8:
      if (isTexture) {
        return Error{ErrorCode::internal, "resource '" + desc.name +
                                              "' is a stencil texture, which OpenGL ES 2.0 does not have; "
                                              "declare Storage::renderbuffer"};
      }
      renderbufferFormat = gl::RenderbufferFormat::stencil8;
      break;
    case Format::depth24Stencil8:
      renderbufferFormat = gl::RenderbufferFormat::depth24Stencil8;
      break;
  }
  auto image = std::make_unique<Image>();
  image->desc = desc;
  image->serial = nextSerial_++;
  if (isTexture) {
    Result<gl::Texture> texture = gl::Texture::create(context_, textureDescOf(desc, capabilities));
    if (!texture)
      return Error{texture.error().code, "resource '" + desc.name + "': " + texture.error().message};
    image->texture = std::move(*texture);
  } else {
    Result<gl::Renderbuffer> renderbuffer =
        gl::Renderbuffer::create(context_, desc.width, desc.height, renderbufferFormat);
    if (!renderbuffer) {
      return Error{renderbuffer.error().code,
                   "resource '" + desc.name + "': " + renderbuffer.error().message};
    }
    image->renderbuffer = std::move(*renderbuffer);
  }
  return image;
}

Image* ResourcePool::findPersistent(const ResourceDesc& desc) const {
  const auto found = persistent_.find(desc.name);
  return found != persistent_.end() && sameImage(found->second->desc, desc) ? found->second.get() : nullptr;
}

Result<Image*> ResourcePool::persistent(const ResourceDesc& desc) {
  Image* image = findPersistent(desc);
  if (!image) {
    if (const auto old = persistent_.find(desc.name); old != persistent_.end()) {
      forgetFramebuffersOf(*old->second);
      persistent_.erase(old);
    }
    Result<std::unique_ptr<Image>> created = createImage(desc);
    if (!created) return created.error();
    image = created->get();
    persistent_[desc.name] = std::move(*created);
  }
  image->lastRun = run_;
  return image;
}

Result<Image*> ResourcePool::takeTransient(const ResourceDesc& desc) {
  auto found = std::find_if(transient_.begin(), transient_.end(),
                            [&](const auto& image) { return !image->taken && sameImage(image->desc, desc); });
  if (found == transient_.end()) {
    Result<std::unique_ptr<Image>> created = createImage(desc);
    if (!created) return created.error();
    found = transient_.insert(transient_.end(), std::move(*created));
  }
  (*found)->taken = true;
  (*found)->lastRun = run_;
  return found->get();
}

Result<const gl::Framebuffer*> ResourcePool::framebuffer(const AttachedImages& images) {
  const auto serialOf = [](const Image* image) { return image ? image->serial : 0; };
  const FramebufferKey key{serialOf(images.color), serialOf(images.depth), serialOf(images.stencil)};
  if (const auto found = framebuffers_.find(key); found != framebuffers_.end()) {
    found->second.lastRun = run_;
    return &found->second.framebuffer;
  }
  gl::FramebufferAttachments attachments;
  if (images.color) attachments.color = &images.color->texture;
  if (images.depth && images.depth->texture) attachments.depthTexture = &images.depth->texture;
  if (images.depth && images.depth->renderbuffer) attachments.depth = &images.depth->renderbuffer;
  if (images.stencil) attachments.stencil = &images.stencil->renderbuffer;
  Result<gl::Framebuffer> created = gl::Framebuffer::create(context_, attachments);
  if (!created) return created.error();
  const auto isTransient = [](const Image* image) {
    return image != nullptr && image->desc.lifetime != Lifetime::persistent;
  };
  const bool transient =
      isTransient(images.color) || isTransient(images.depth) || isTransient(images.stencil);
  AttachedFramebuffer& made = framebuffers_[key];
  made = {.framebuffer = std::move(*created), .lastRun = run_, .transient = transient};
  return &made.framebuffer;
}

std::uint64_t ResourcePool::memoryBytes() const {
  std::uint64_t bytes = 0;
  const auto add = [&](const Image& image) {
    if (image.texture) bytes += image.texture.byteCount();
    if (image.renderbuffer) bytes += image.renderbuffer.byteCount();
  };
  for (const auto& [name, image] : persistent_) add(*image);
  for (const auto& image : transient_) add(*image);
  return bytes;
}

bool ResourcePool::isOld(std::uint64_t lastRun, int runs) const {
  return lastRun + static_cast<std::uint64_t>(std::max(runs, 0)) <= run_;
}

bool ResourcePool::isStale(const Image& image, int runs) const {
  return isOld(image.lastRun, runs);
}

void ResourcePool::trim(int runs) {
  const auto stale = [&](const Image& image) {
    const bool old = isStale(image, runs);
    if (old) forgetFramebuffersOf(image);
    return old;
  };
  std::erase_if(persistent_, [&](const auto& entry) { return stale(*entry.second); });
  std::erase_if(transient_, [&](const auto& image) { return stale(*image); });
  std::erase_if(framebuffers_, [&](const auto& entry) {
    return entry.second.transient && isOld(entry.second.lastRun, runs);
  });
}

void ResourcePool::forgetContent() {
  for (const auto& [name, image] : persistent_) image->contentKey = 0;
}

void ResourcePool::forgetFramebuffersOf(const Image& image) {
  std::erase_if(framebuffers_, [&](const auto& entry) {
    return std::find(entry.first.begin(), entry.first.end(), image.serial) != entry.first.end();
  });
}

}  // namespace halfshadow::framegraph
