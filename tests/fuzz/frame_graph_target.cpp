// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// Graphs of any kind: refused with a sentence, or compiled into a plan that finds in every target and texture
// what it needs there.
#include <map>
#include <set>

#include "framegraph/plan.hpp"
#include "input_reader.hpp"

namespace halfshadow::fuzz {
namespace {
using namespace framegraph;

struct Source {
  Graph graph;
  std::map<std::string, std::uint64_t> held;  ///< content keys by name
};

/// Names are few, so that some are used twice; ids may be none of the graph.
ResourceId resourceOf(InputReader& reader, std::size_t resources) {
  return {static_cast<std::uint32_t>(reader.below(resources + 1 + (reader.flag() ? 1 : 0)))};
}

void addResource(InputReader& reader, Source& source) {
  const std::string name(1, static_cast<char>('a' + source.graph.resources().size()));
  const std::uint8_t kind = reader.byte();
  const int width = kind % 7 == 6 ? 0 : kind % 7 == 5 ? 16 : 64;
  if (kind >= 200) {
    source.graph.importTarget(name, {.width = width, .height = 32});
    return;
  }
  ResourceDesc desc{.name = kind % 31 == 30 ? "a" : name, .width = width, .height = 32};
  desc.format = static_cast<Format>(reader.below(5));
  desc.storage = static_cast<Storage>(reader.below(2));
  desc.lifetime = static_cast<Lifetime>(reader.below(2));
  desc.mipmapped = reader.byte() % 5 == 4;
  const std::uint8_t key = reader.byte();
  if (desc.lifetime == Lifetime::persistent && key % 4 != 0) source.held[desc.name] = key % 4;
  source.graph.addResource(desc);
}

void addPass(InputReader& reader, Source& source) {
  const std::size_t resources = source.graph.resources().size();
  PassDesc pass{.name = "pass " + std::to_string(source.graph.passes().size())};
  pass.stage = static_cast<PassStage>(reader.below(5));
  pass.contentKey = reader.below(4);
  if (reader.flag()) pass.rebindReason = "for a reason";
  for (std::size_t i = reader.below(3); i > 0; --i) pass.reads.push_back(resourceOf(reader, resources));
  for (std::size_t i = reader.below(4); i > 0; --i) {
    Attachment write{.resource = resourceOf(reader, resources)};
    write.point = static_cast<AttachmentPoint>(reader.below(4));
    write.initial = static_cast<InitialContent>(reader.below(3));
    pass.writes.push_back(write);
  }
  source.graph.addPass(std::move(pass));
}

Source sourceOf(Input input) {
  InputReader reader(input);
  Source source;
  for (std::size_t i = reader.below(9); i > 0; --i) addResource(reader, source);
  for (std::size_t i = reader.below(10); i > 0; --i) addPass(reader, source);
  for (std::size_t i = reader.below(4); i > 0; --i)
    source.graph.markOutput(resourceOf(reader, source.graph.resources().size()));
  return source;
}

/// Runs the plan on resources that are full or empty.
class PlanRun {
 public:
  explicit PlanRun(const Source& source) : graph_(source.graph) {
    for (std::uint32_t i = 0; i < graph_.resources().size(); ++i) {
      const ResourceDesc& desc = graph_.resources()[i];
      if (desc.lifetime == Lifetime::imported || source.held.contains(desc.name)) full_.insert(i);
    }
  }
  void run(const PlannedPass& planned) {
    const PassDesc& pass = graph_.passes()[planned.pass];
    require(ran_.insert(planned.pass).second, "a pass runs twice");
    require(pass.stage >= stage_, "stages are out of order");
    stage_ = pass.stage;
    for (const ResourceId read : pass.reads)
      require(full_.contains(read.index), pass.name + " reads what nothing holds");
    require(planned.attachments.size() == pass.writes.size(), "a pass lost a target");
    for (const PlannedAttachment& target : planned.attachments) {
      if (target.load == LoadAction::load)
        require(full_.contains(target.resource.index), pass.name + " loads what nothing holds");
      require((target.load == LoadAction::load) == (target.bytesLoaded > 0), "bytes of a load that is none");
    }
    for (const PlannedAttachment& target : planned.attachments) {
      if (target.store == StoreAction::store) {
        full_.insert(target.resource.index);
      } else {
        full_.erase(target.resource.index);
      }
    }
  }
  void checkOutputs() const {
    for (const ResourceId output : graph_.outputs()) {
      bool written = false;
      for (const PassDesc& pass : graph_.passes()) {
        for (const Attachment& write : pass.writes) written = written || write.resource == output;
      }
      if (written) require(full_.contains(output.index), "an output holds nothing");
    }
  }

 private:
  const Graph& graph_;
  std::set<std::uint32_t> full_, ran_;
  PassStage stage_ = PassStage::light;
};

void test(Input input) {
  const Source source = sourceOf(input);
  const auto plan = compile(source.graph, [&](const ResourceDesc& desc) {
    const auto found = source.held.find(desc.name);
    return found == source.held.end() ? std::uint64_t{0} : found->second;
  });
  if (!plan) {
    require(plan.error().message.size() > 10, "a refusal without a sentence");
    return;
  }
  PlanRun run(source);
  std::uint64_t loaded = 0, stored = 0;
  for (const PlannedPass& planned : plan->passes) {
    run.run(planned);
    for (const PlannedAttachment& target : planned.attachments)
      loaded += target.bytesLoaded, stored += target.bytesStored;
  }
  run.checkOutputs();
  require(loaded == plan->bytesLoaded && stored == plan->bytesStored, "the bytes do not add up");
  require(plan->passes.size() + plan->skipped.size() == source.graph.passes().size(),
          "a pass neither runs nor is said to be left out");
  require(!plan->text(source.graph).empty() && !plan->graphviz(source.graph).empty(),
          "a plan without a text");
}

/// A map that is kept, a mask of it, and the scene with both.
Bytes shadowSeed(std::size_t heldKey) {
  InputWriter writer;
  writer.byte(5);
  const auto resource = [&](std::size_t format, std::size_t storage, std::size_t lifetime, std::size_t key) {
    writer.byte(0).byte(format).byte(storage).byte(lifetime).byte(0).byte(key);
  };
  resource(0, 0, 1, heldKey), resource(1, 1, 0, 0), resource(0, 0, 0, 0), resource(0, 0, 0, 0),
      resource(1, 1, 0, 0);
  writer.byte(3);
  const auto id = [&](std::size_t index) { writer.byte(0).byte(index); };
  const auto write = [&](std::size_t index, std::size_t point) { id(index), writer.byte(point).byte(0); };
  writer.byte(0).byte(2).byte(0).byte(0).byte(2), write(0, 0), write(1, 1);
  writer.byte(1).byte(0).byte(0).byte(1), id(0), writer.byte(1), write(2, 0);
  writer.byte(3).byte(0).byte(0).byte(2), id(0), id(2), writer.byte(2), write(3, 0), write(4, 1);
  writer.byte(1), id(3);
  return writer.bytes;
}

/// The host's framebuffer, drawn twice with a reason.
Bytes hostSeed() {
  InputWriter writer;
  writer.byte(1).byte(203);
  writer.byte(2);
  for (const std::size_t initial : {0, 1})
    writer.byte(3).byte(0).byte(1).byte(0).byte(1).byte(0).byte(0).byte(0).byte(initial);
  writer.byte(0);
  return writer.bytes;
}

std::vector<Bytes> seeds() {
  return {shadowSeed(0), shadowSeed(2), shadowSeed(3), hostSeed()};
}
}  // namespace

const Target& target() {
  static const Target made{.name = "frame_graph", .test = test, .seeds = seeds, .largestInput = 256};
  return made;
}

}  // namespace halfshadow::fuzz
