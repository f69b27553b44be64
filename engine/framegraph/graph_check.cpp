// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "framegraph/graph_check.hpp"

#include <algorithm>
#include <set>

namespace halfshadow::framegraph {
namespace {

Error broken(std::string message) {
  return Error{ErrorCode::internal, std::move(message)};
}

bool formatFits(Format format, AttachmentPoint point) {
  switch (point) {
    case AttachmentPoint::color:
      return format == Format::rgba8;
    case AttachmentPoint::depth:
      return format == Format::depth16 || format == Format::depth24 || format == Format::depth24Stencil8;
    case AttachmentPoint::stencil:
      return format == Format::stencil8;
    case AttachmentPoint::depthStencil:
      return format == Format::depth24Stencil8;
  }
  return false;
}

// Bits of the framebuffer's points that an attachment occupies.
unsigned pointMask(AttachmentPoint point) {
  switch (point) {
    case AttachmentPoint::color:
      return 1u;
    case AttachmentPoint::depth:
      return 2u;
    case AttachmentPoint::stencil:
      return 4u;
    case AttachmentPoint::depthStencil:
      return 6u;
  }
  return 0u;
}

Status checkResources(const Graph& graph) {
  std::set<std::string> names;
  for (const ResourceDesc& desc : graph.resources()) {
    if (desc.width <= 0 || desc.height <= 0) {
      return broken("resource '" + desc.name + "' has a size of zero; declare width and height above 0");
    }
    if (!names.insert(desc.name).second) {
      return broken("two resources are named '" + desc.name + "'; names are unique in a graph");
    }
    if (desc.mipmapped && (desc.format != Format::rgba8 || desc.storage != Storage::texture)) {
      return broken("resource '" + desc.name + "' is mipmapped but is no rgba8 texture");
    }
  }
  for (const ResourceId output : graph.outputs()) {
    if (output.index >= graph.resources().size()) return broken("an output is no resource of the graph");
  }
  return {};
}

Status checkWrites(const Graph& graph, const PassDesc& pass) {
  const std::vector<ResourceDesc>& resources = graph.resources();
  if (pass.writes.empty()) return broken("pass '" + pass.name + "' writes nothing; give it a target");
  unsigned pointsUsed = 0;
  for (const Attachment& attachment : pass.writes) {
    if (attachment.resource.index >= resources.size()) {
      return broken("pass '" + pass.name + "' writes something that is no resource of the graph");
    }
    const ResourceDesc& desc = resources[attachment.resource.index];
    const std::string where = "pass '" + pass.name + "' writes '" + desc.name + "' ";
    const bool imported = desc.lifetime == Lifetime::imported;
    if (!imported && !formatFits(desc.format, attachment.point)) {
      return broken(where + "at an attachment point that its format does not fit");
    }
    if (pointsUsed & pointMask(attachment.point)) return broken(where + "at a point that is already taken");
    pointsUsed |= pointMask(attachment.point);
    for (const Attachment& other : pass.writes) {
      const ResourceDesc& otherDesc =
          resources[std::min<std::size_t>(other.resource.index, resources.size() - 1)];
      if (imported != (otherDesc.lifetime == Lifetime::imported) ||
          (imported && other.resource != attachment.resource)) {
        return broken(where + "together with targets that the host's framebuffer does not contain");
      }
      if (otherDesc.width != desc.width || otherDesc.height != desc.height) {
        return broken(where + "together with '" + otherDesc.name + "' of another size");
      }
      if (!imported && &other != &attachment && other.resource == attachment.resource) {
        return broken(where + "at two attachment points");
      }
    }
  }
  return {};
}

Status checkReads(const Graph& graph, const PassDesc& pass) {
  for (const ResourceId read : pass.reads) {
    if (read.index >= graph.resources().size()) {
      return broken("pass '" + pass.name + "' reads something that is no resource of the graph");
    }
    const ResourceDesc& desc = graph.resources()[read.index];
    const std::string where = "pass '" + pass.name + "' reads '" + desc.name + "', ";
    if (desc.storage != Storage::texture) {
      return broken(where + "which has no texture; give it Storage::texture");
    }
    if (std::any_of(pass.writes.begin(), pass.writes.end(),
                    [&](const Attachment& attachment) { return attachment.resource == read; })) {
      return broken(where + "which it also writes; split the pass or use two resources");
    }
  }
  return {};
}

Status checkUpdate(const Graph& graph, const PassDesc& pass) {
  if (pass.update.fromKey == 0) return {};
  const std::string where = "pass '" + pass.name + "' updates its targets ";
  if (pass.contentKey == 0) return broken(where + "but has no content key");
  bool anyPersistent = false;
  for (const Attachment& attachment : pass.writes) {
    const ResourceDesc& desc = graph.resources()[attachment.resource.index];
    if (attachment.initial != InitialContent::clear || desc.lifetime == Lifetime::imported)
      return broken(where + "but does not clear '" + desc.name + "', or the host owns it");
    anyPersistent = anyPersistent || desc.lifetime == Lifetime::persistent;
    for (const Rect& part : pass.update.parts) {
      if (part.x < 0 || part.y < 0 || part.width <= 0 || part.height <= 0 ||
          part.x + part.width > desc.width || part.y + part.height > desc.height)
        return broken(where + "in a part that is empty or reaches out of '" + desc.name + "'");
    }
  }
  if (!anyPersistent) return broken(where + "but none of them is persistent");
  return {};
}

}  // namespace

Status checkGraph(const Graph& graph) {
  if (Status status = checkResources(graph); !status) return status;
  for (const PassDesc& pass : graph.passes()) {
    if (Status status = checkWrites(graph, pass); !status) return status;
    if (Status status = checkReads(graph, pass); !status) return status;
    if (Status status = checkUpdate(graph, pass); !status) return status;
  }
  return {};
}

}  // namespace halfshadow::framegraph
