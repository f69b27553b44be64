// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "framegraph/plan.hpp"

#include <algorithm>
#include <map>
#include <optional>
#include <set>

#include "framegraph/graph_check.hpp"

namespace halfshadow::framegraph {
namespace {

constexpr const char* kUnchanged = "unchanged";
constexpr const char* kNotRead = "not-read";

// One state of a resource: what it holds after `writer` ran. Every value that a pass reads, as a texture or
// as kept attachment content, is one of these or (without a writer) what the last frame left.
struct Input {
  ResourceId resource;
  std::optional<std::uint32_t> writer;
};

struct Node {
  std::vector<Input> inputs;
  std::set<std::uint32_t> after;  // passes that must come before this one
  bool live = false;              // some chain of readers ends in an output
  bool demanded = false;          // the same, counting only passes that run
  bool runs = false;
  std::set<std::uint32_t> storedFor;  // resources whose value after this pass is read later
};

std::set<std::uint32_t> targetSet(const PassDesc& pass) {
  std::set<std::uint32_t> targets;
  for (const Attachment& attachment : pass.writes) targets.insert(attachment.resource.index);
  return targets;
}

// An imported framebuffer has one resource for all its points; each point takes 4 bytes but stencil.
std::uint64_t attachmentBytes(const ResourceDesc& desc, AttachmentPoint point) {
  const std::uint64_t pixels =
      static_cast<std::uint64_t>(desc.width) * static_cast<std::uint64_t>(desc.height);
  if (desc.lifetime != Lifetime::imported) return pixels * bytesPerPixel(desc.format);
  return pixels * (point == AttachmentPoint::stencil ? 1 : 4);
}

class Compiler {
 public:
  Compiler(const Graph& graph, const ContentKeyLookup& contentKeyOf)
      : graph_(graph), contentKeyOf_(contentKeyOf), nodes_(graph.passes().size()) {}

  Result<Plan> compile() {
    collectWriters();
    for (std::uint32_t pass = 0; pass < nodes_.size(); ++pass) {
      if (Status status = resolveInputs(pass); !status) return status.error();
    }
    if (Status status = sort(); !status) return status.error();
    markLive();
    chooseRunning();
    if (Status status = checkCarriedContent(); !status) return status.error();
    return emit();
  }

 private:
  const PassDesc& pass(std::uint32_t index) const { return graph_.passes()[index]; }
  const ResourceDesc& desc(ResourceId id) const { return graph_.resources()[id.index]; }

  // (stage, declaration): the order that versions of a resource are numbered in.
  bool before(std::uint32_t a, std::uint32_t b) const {
    return pass(a).stage != pass(b).stage ? pass(a).stage < pass(b).stage : a < b;
  }

  void collectWriters() {
    for (std::uint32_t i = 0; i < nodes_.size(); ++i) {
      for (const std::uint32_t resource : targetSet(pass(i))) writers_[resource].push_back(i);
    }
    for (auto& [resource, writers] : writers_) {
      std::sort(writers.begin(), writers.end(), [this](auto a, auto b) { return before(a, b); });
      for (std::size_t i = 1; i < writers.size(); ++i) nodes_[writers[i]].after.insert(writers[i - 1]);
    }
  }

  // Last writer before the pass in (stage, declaration) order.
  std::optional<std::uint32_t> writerBefore(std::uint32_t index, ResourceId resource) const {
    std::optional<std::uint32_t> last;
    const auto found = writers_.find(resource.index);
    if (found == writers_.end()) return last;
    for (const std::uint32_t writer : found->second) {
      if (before(writer, index)) last = writer;
    }
    return last;
  }

  Status resolveInputs(std::uint32_t index) {
    for (const Attachment& attachment : pass(index).writes) {
      if (attachment.initial != InitialContent::keep) continue;
      if (Status s = addInput(index, attachment.resource, writerBefore(index, attachment.resource)); !s)
        return s;
    }
    for (const ResourceId read : pass(index).reads) {
      std::optional<std::uint32_t> writer = writerBefore(index, read);
      const auto found = writers_.find(read.index);
      if (!writer && found != writers_.end()) {
        // Declared before its writers: it means what they leave at the end of its own stage.
        for (const std::uint32_t candidate : found->second) {
          if (pass(candidate).stage == pass(index).stage) writer = candidate;
        }
        if (!writer) {
          return Error{ErrorCode::internal, "pass '" + pass(index).name + "' reads '" + desc(read).name +
                                                "', which only pass '" + pass(found->second.front()).name +
                                                "' of a later stage writes; move one of them"};
        }
      }
      if (Status s = addInput(index, read, writer); !s) return s;
      // The next writer must not overwrite the value before it is read.
      if (writer && before(*writer, index)) {
        for (const std::uint32_t next : found->second) {
          if (before(index, next)) nodes_[next].after.insert(index);
        }
      }
    }
    return {};
  }

  Status addInput(std::uint32_t index, ResourceId resource, std::optional<std::uint32_t> writer) {
    nodes_[index].inputs.push_back({resource, writer});
    if (writer) nodes_[index].after.insert(*writer);
    if (!writer && desc(resource).lifetime == Lifetime::transient) {
      return Error{ErrorCode::internal, "pass '" + pass(index).name + "' needs the content of '" +
                                            desc(resource).name + "', which no earlier pass writes"};
    }
    return {};
  }

  // Kahn's algorithm, always taking the first ready pass in (stage, declaration) order.
  Status sort() {
    std::vector<bool> placed(nodes_.size(), false);
    while (order_.size() < nodes_.size()) {
      std::optional<std::uint32_t> next;
      for (std::uint32_t i = 0; i < nodes_.size(); ++i) {
        if (placed[i] || (next && !before(i, *next))) continue;
        const auto& after = nodes_[i].after;
        if (std::all_of(after.begin(), after.end(), [&](std::uint32_t other) { return placed[other]; }))
          next = i;
      }
      if (!next) {
        std::string names;
        for (std::uint32_t i = 0; i < nodes_.size(); ++i) {
          if (!placed[i]) names += (names.empty() ? "'" : ", '") + pass(i).name + "'";
        }
        return Error{ErrorCode::internal, "the passes " + names + " wait for each other; break the cycle"};
      }
      placed[*next] = true;
      order_.push_back(*next);
    }
    return {};
  }

  bool isOutput(ResourceId resource) const {
    return std::find(graph_.outputs().begin(), graph_.outputs().end(), resource) != graph_.outputs().end();
  }

  // The pass leaves something that outlives the frame: the host's pixels, or an output's final value.
  bool feedsHost(std::uint32_t index) const {
    for (const Attachment& attachment : pass(index).writes) {
      if (desc(attachment.resource).lifetime == Lifetime::imported) return true;
      if (isOutput(attachment.resource) && writers_.at(attachment.resource.index).back() == index)
        return true;
    }
    return false;
  }

  void markLive() {
    for (auto it = order_.rbegin(); it != order_.rend(); ++it) {
      Node& node = nodes_[*it];
      node.live = node.live || feedsHost(*it);
      if (!node.live) continue;
      for (const Input& input : node.inputs) {
        if (input.writer) nodes_[*input.writer].live = true;
      }
    }
  }

  // All persistent targets hold the pass's content.
  bool holdsContent(std::uint32_t index) const {
    if (pass(index).contentKey == 0 || pass(index).contentKey == kUnidentifiedContent) return false;
    bool any = false;
    for (const Attachment& attachment : pass(index).writes) {
      const ResourceDesc& target = desc(attachment.resource);
      if (target.lifetime != Lifetime::persistent) continue;
      if (contentKeyOf_(target) != pass(index).contentKey) return false;
      any = true;
    }
    return any;
  }

  // Every value wanted from the pass lies in a persistent resource.
  bool wantsOnlyPersistent(std::uint32_t index) const {
    for (const Attachment& attachment : pass(index).writes) {
      const bool wanted = nodes_[index].storedFor.count(attachment.resource.index) ||
                          (isOutput(attachment.resource) && feedsHost(index)) ||
                          desc(attachment.resource).lifetime == Lifetime::imported;
      if (wanted && desc(attachment.resource).lifetime != Lifetime::persistent) return false;
    }
    return true;
  }

  // A kept value is lost when an earlier pass of this frame overwrites it; such passes run after all, which
  // may make others run, so the choice is repeated until it stands. Each round adds a pass: it ends.
  void chooseRunning() {
    std::set<std::uint32_t> overwritten;
    for (;;) {
      for (Node& node : nodes_) node.demanded = node.runs = false, node.storedFor.clear();
      for (auto it = order_.rbegin(); it != order_.rend(); ++it) {
        Node& node = nodes_[*it];
        node.demanded = node.demanded || feedsHost(*it);
        if (!node.demanded) continue;
        node.runs = overwritten.count(*it) || !holdsContent(*it) || !wantsOnlyPersistent(*it);
        if (!node.runs) continue;
        for (const Input& input : node.inputs) {
          if (!input.writer) continue;
          nodes_[*input.writer].demanded = true;
          nodes_[*input.writer].storedFor.insert(input.resource.index);
        }
      }
      if (!addOverwritten(overwritten)) return;
    }
  }

  bool addOverwritten(std::set<std::uint32_t>& overwritten) const {
    bool added = false;
    std::set<std::uint32_t> touched;
    for (const std::uint32_t index : order_) {
      const Node& node = nodes_[index];
      for (const std::uint32_t target : targetSet(pass(index))) {
        if (node.runs) touched.insert(target);
        if (node.demanded && !node.runs && touched.count(target)) added |= overwritten.insert(index).second;
      }
    }
    return added;
  }

  // Content of earlier frames that a running pass needs must be there.
  Status checkCarriedContent() const {
    for (const std::uint32_t index : order_) {
      if (!nodes_[index].runs) continue;
      for (const Input& input : nodes_[index].inputs) {
        if (input.writer || desc(input.resource).lifetime != Lifetime::persistent) continue;
        if (contentKeyOf_(desc(input.resource)) == 0) {
          return Error{ErrorCode::internal, "pass '" + pass(index).name + "' needs the content of '" +
                                                desc(input.resource).name +
                                                "', which no pass writes and no earlier frame left valid"};
        }
      }
    }
    return {};
  }

  // What the pass would update is there, and no pass of this frame draws over it before.
  bool updatesTargets(std::uint32_t index) const {
    const std::uint64_t from = pass(index).update.fromKey;
    if (from == 0 || from == kUnidentifiedContent) return false;
    for (const Attachment& attachment : pass(index).writes) {
      const ResourceDesc& target = desc(attachment.resource);
      if (target.lifetime != Lifetime::persistent) continue;
      if (contentKeyOf_(target) != from) return false;
      for (const std::uint32_t writer : writers_.at(attachment.resource.index)) {
        if (writer != index && before(writer, index) && nodes_[writer].runs) return false;
      }
    }
    return true;
  }

  PlannedAttachment planAttachment(std::uint32_t index, const Attachment& attachment, bool updates) const {
    const ResourceDesc& target = desc(attachment.resource);
    PlannedAttachment planned{
        .resource = attachment.resource, .point = attachment.point, .clear = attachment.clear};
    const std::uint64_t bytes = attachmentBytes(target, attachment.point);
    const bool loads = updates && target.lifetime == Lifetime::persistent;
    switch (loads ? InitialContent::keep : attachment.initial) {
      case InitialContent::clear:
        planned.load = LoadAction::clear;
        break;
      case InitialContent::keep:
        planned.load = LoadAction::load;
        planned.bytesLoaded = bytes;
        break;
      case InitialContent::dontCare:
        planned.load = LoadAction::dontCare;
        break;
    }
    const bool wanted =
        target.lifetime != Lifetime::transient || nodes_[index].storedFor.count(attachment.resource.index) ||
        (isOutput(attachment.resource) && writers_.at(attachment.resource.index).back() == index);
    planned.store = wanted ? StoreAction::store : StoreAction::discard;
    planned.bytesStored = wanted ? bytes : 0;
    return planned;
  }

  Result<Plan> emit() const {
    Plan plan;
    plan.skipped = graph_.skipped();
    for (std::uint32_t i = 0; i < nodes_.size(); ++i) {
      if (nodes_[i].runs) continue;
      const bool unchanged = nodes_[i].live && holdsContent(i);
      plan.skipped.push_back({pass(i).name, unchanged ? kUnchanged : kNotRead});
    }
    std::map<std::set<std::uint32_t>, std::uint32_t> bound;
    for (const std::uint32_t index : order_) {
      if (!nodes_[index].runs) continue;
      const PassDesc& source = pass(index);
      const auto [first, fresh] = bound.try_emplace(targetSet(source), index);
      if (!fresh && source.rebindReason.empty()) {
        return Error{ErrorCode::internal, "pass '" + source.name + "' binds the framebuffer of pass '" +
                                              pass(first->second).name +
                                              "' again; merge them or give a rebindReason"};
      }
      PlannedPass planned{.pass = index, .updates = updatesTargets(index)};
      if (!fresh) planned.rebindReason = source.rebindReason;
      for (const Attachment& attachment : source.writes) {
        planned.attachments.push_back(planAttachment(index, attachment, planned.updates));
        plan.bytesLoaded += planned.attachments.back().bytesLoaded;
        plan.bytesStored += planned.attachments.back().bytesStored;
        if (desc(attachment.resource).mipmapped) planned.generatesMipmaps = true;
      }
      plan.passes.push_back(std::move(planned));
    }
    return plan;
  }

  const Graph& graph_;
  const ContentKeyLookup& contentKeyOf_;
  std::vector<Node> nodes_;
  std::map<std::uint32_t, std::vector<std::uint32_t>>
      writers_;  // of a resource, in (stage, declaration) order
  std::vector<std::uint32_t> order_;
};

}  // namespace

Result<Plan> compile(const Graph& graph, const ContentKeyLookup& contentKeyOf) {
  if (Status status = checkGraph(graph); !status) return status.error();
  return Compiler(graph, contentKeyOf).compile();
}

}  // namespace halfshadow::framegraph
