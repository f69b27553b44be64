// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "techniques/shadow_volume/volume_count.hpp"

#include <algorithm>

#include "planner/light_space.hpp"

namespace halfshadow::techniques {
namespace {
using device::BlendEquation;
using device::BlendFactor;
using device::Compare;
using device::Cull;
using device::StencilOp;

/// Moves volumes back by a few steps of depth: a receiver in the plane of a cap is then in front of it,
/// however two different triangles round. Nothing for slopes: of two sides seen edge-on it would move only
/// one.
const glm::vec2 kBehindCoplanar(0.0f, 4.0f);
/// A step of one stored level. Added and subtracted alike: drivers that keep more than 8 bits until a tile is
/// stored must come back to where they were.
constexpr float kStep = 1.0f / 255.0f;

std::optional<Rect> unite(const std::optional<Rect>& a, const std::optional<Rect>& b) {
  if (!a || !b) return std::nullopt;
  const int x = std::min(a->x, b->x), y = std::min(a->y, b->y);
  return Rect{x, y, std::max(a->x + a->width, b->x + b->width) - x,
              std::max(a->y + a->height, b->y + b->height) - y};
}

/// Where casters can cover each other seen from the light: a grid over tangents in which each adds its
/// layers.
class LayerGrid {
 public:
  LayerGrid(const planner::LightSpace& space, int capacity) : space_(space), capacity_(capacity) {}

  /// Cells of a box; all of them where it reaches beside or behind the light.
  struct Cells {
    int low[2] = {0, 0}, high[2] = {kSide - 1, kSide - 1};
  };
  Cells cellsOf(const BoxCorners& boxWorld) const {
    Cells cells;
    glm::dvec2 low(1.0), high(-1.0);
    for (const glm::dvec3& corner : boxWorld) {
      const glm::dvec3 at = space_.lightFromWorld(corner);
      // (x, y) / (|x| + |y| + z) is monotonous along every line from the axis, but not in x alone; bounds of
      // x/z are, and so is their image under t / (1 + |t|).
      if (at.z <= 1e-9 * glm::length(at)) return {};
      const glm::dvec2 tangent = glm::dvec2(at) / at.z;
      const glm::dvec2 compressed = tangent / (1.0 + glm::abs(tangent));
      low = glm::min(low, compressed);
      high = glm::max(high, compressed);
    }
    for (int axis = 0; axis < 2; ++axis) {
      cells.low[axis] = cellAt(low[axis]);
      cells.high[axis] = cellAt(high[axis]);
    }
    return cells;
  }
  bool fits(const Cells& cells, int layers) const {
    bool fits = true;
    forEach(cells, [&](std::size_t cell) { fits = fits && count_[cell] + layers <= capacity_; });
    return fits;
  }
  void add(const Cells& cells, int layers) {
    forEach(cells, [&](std::size_t cell) { count_[cell] += layers; });
  }
  void clear() { std::ranges::fill(count_, 0); }

 private:
  static constexpr int kSide = 96;
  static int cellAt(double compressed) {
    return std::clamp(static_cast<int>((compressed * 0.5 + 0.5) * kSide), 0, kSide - 1);
  }
  template <typename Visit>
  static void forEach(const Cells& cells, const Visit& visit) {
    for (int y = cells.low[1]; y <= cells.high[1]; ++y) {
      for (int x = cells.low[0]; x <= cells.high[0]; ++x) visit(static_cast<std::size_t>(y * kSide + x));
    }
  }
  planner::LightSpace space_;
  int capacity_;
  std::vector<int> count_ = std::vector<int>(std::size_t{kSide} * kSide, 0);
};

/// Puts draws into batches, in order.
class Batcher {
 public:
  Batcher(const planner::LightSpace& space, int capacity) : grid_(space, capacity) {}

  void add(VolumeDraw draw, const BoxCorners& boxWorld) {
    const auto cells = grid_.cellsOf(boxWorld);
    const std::span<const VolumeChunk> chunks = draw.volume->chunks();
    for (std::uint32_t first = 0, last; first < chunks.size(); first = last) {
      if (batches_.empty() || !grid_.fits(cells, chunks[first].layers)) {
        batches_.emplace_back();
        grid_.clear();
      }
      for (last = first; last < chunks.size() && grid_.fits(cells, chunks[last].layers); ++last) {
        grid_.add(cells, chunks[last].layers);
      }
      // One that fits no empty grid: nothing else is drawn with it.
      if (last == first) grid_.add(cells, chunks[last++].layers);
      VolumeBatch& batch = batches_.back();
      draw.firstChunk = first;
      draw.lastChunk = last;
      batch.scissor = batch.draws.empty() ? draw.scissor : unite(batch.scissor, draw.scissor);
      batch.draws.push_back(draw);
    }
  }
  std::vector<VolumeBatch> take() { return std::move(batches_); }

 private:
  LayerGrid grid_;
  std::vector<VolumeBatch> batches_;
};

/// The draws of one light into one channel.
struct Counting {
  PlannedPass& pass;
  std::uint32_t volumeProgram = 0, fullscreenProgram = 0;
  glm::mat4 clipFromDirection{1.0f};
  int channel = 0;

  PlannedDraw volume(const VolumeDraw& draw) const {
    PlannedDraw planned{.program = volumeProgram};
    planned.uniforms.set("u_clipFromDirection", clipFromDirection);
    planned.uniforms.set("u_clipFromObject", draw.clipFromObject);
    planned.state.colorMask.fill(false);
    planned.state.polygonOffset = kBehindCoplanar;
    planned.state.scissor = draw.scissor;
    return planned;
  }
  PlannedDraw fullscreen(float color, const std::optional<Rect>& scissor) const {
    PlannedDraw planned{.program = fullscreenProgram};
    planned.uniforms.set("u_color", glm::vec4(color));
    planned.state.colorMask.fill(false);
    planned.state.colorMask[static_cast<std::size_t>(channel)] = true;
    planned.state.scissor = scissor;
    return planned;
  }
};

void addStencil(const Counting& counting, const VolumeDraw& draw) {
  PlannedDraw planned = counting.volume(draw);
  planned.state.depth = {.test = Compare::less, .write = false};
  device::StencilState& stencil = planned.state.stencil;
  stencil.enabled = true;
  device::StencilFace& entering = draw.mirrored ? stencil.back : stencil.front;
  device::StencilFace& leaving = draw.mirrored ? stencil.front : stencil.back;
  (draw.depthFail ? entering.depthFail : entering.pass) =
      draw.depthFail ? StencilOp::decrWrap : StencilOp::incrWrap;
  (draw.depthFail ? leaving.depthFail : leaving.pass) =
      draw.depthFail ? StencilOp::incrWrap : StencilOp::decrWrap;
  draw.volume->addDraws(counting.pass, planned, draw.surface, draw.firstChunk, draw.lastChunk);
}

void addBlended(const Counting& counting, const VolumeDraw& draw) {
  PlannedDraw planned = counting.volume(draw);
  planned.uniforms.set("u_color", glm::vec4(kStep));
  device::DrawState& state = planned.state;
  state.depth = {.test = draw.depthFail ? Compare::gequal : Compare::less, .write = false};
  state.colorMask[static_cast<std::size_t>(counting.channel)] = true;
  state.blend = {.enabled = true, .source = BlendFactor::one, .destination = BlendFactor::one};
  // What is added comes first: a channel cannot go below zero.
  const bool addsBack = draw.depthFail != draw.mirrored;
  const auto add = [&] {
    draw.volume->addDraws(counting.pass, planned, draw.surface, draw.firstChunk, draw.lastChunk);
  };
  state.cull = addsBack ? Cull::front : Cull::back;
  add();
  state.blend.equation = BlendEquation::reverseSubtract;
  state.cull = addsBack ? Cull::back : Cull::front;
  add();
}

/// Writes 0 where the stencil counts something and resets it.
void addStencilResolve(const Counting& counting, const std::optional<Rect>& scissor) {
  PlannedDraw planned = counting.fullscreen(0.0f, scissor);
  planned.state.stencil.enabled = true;
  planned.state.stencil.front = {.test = Compare::notEqual, .pass = StencilOp::zero};
  planned.state.stencil.back = planned.state.stencil.front;
  counting.pass.draws.push_back(std::move(planned));
}

/// Makes one level of every count: doubled eight times it is saturated, then all but one level is taken away.
void addCollapse(const Counting& counting, const std::optional<Rect>& scissor) {
  PlannedDraw doubled = counting.fullscreen(1.0f, scissor);
  doubled.state.blend = {.enabled = true, .source = BlendFactor::dstColor, .destination = BlendFactor::one};
  counting.pass.draws.insert(counting.pass.draws.end(), 8, doubled);
  PlannedDraw rest = counting.fullscreen(1.0f - kStep, scissor);
  rest.state.blend = {.enabled = true,
                      .equation = BlendEquation::reverseSubtract,
                      .source = BlendFactor::one,
                      .destination = BlendFactor::one};
  counting.pass.draws.push_back(std::move(rest));
}
}  // namespace

int maxVolumeLayers(VolumeCounter counter) {
  return counter == VolumeCounter::stencil ? 255 : 160;
}

LightVolumes lightVolumes(const LightScene& scene, PassPlan& plan, const VolumeView& view, VolumeCache& cache,
                          VolumeCounter counter) {
  const glm::dvec3 light = scene.light.centerWorld;
  const int maxLayers = maxVolumeLayers(counter);
  const bool wideIndices = scene.capabilities.has(device::Capability::uintIndex);
  LightVolumes result;
  glm::dmat4 clipFromDirection = view.clipFromWorld;
  clipFromDirection[3] = glm::dvec4(0.0);
  result.clipFromDirection = glm::mat4(clipFromDirection);
  Batcher batcher(planner::lightSpace(scene.light), maxLayers);
  int uncapped = 0, outOfView = 0;
  const std::span<const scene::PlacedCaster> casters = placedCasters(scene);
  std::vector<bool> drawn(casters.size(), true);
  for (const DrawItem& item : scene.casters) {
    if (!item.receives || item.frontOnly) drawn[placedCasterOf(scene, item)] = false;
  }
  for (const scene::PlacedCaster& caster : casters) {
    scene::Bounds bounds;
    for (const scene::CasterPart& part : caster.mesh->parts()) bounds.include(part.bounds);
    const BoxCorners box = boxCornersWorld(caster.worldFromObject, bounds);
    VolumeDraw draw;
    draw.depthFail = !missesNearPyramid(view, light, box);
    // The eye looks into the volume of a caster that is not drawn through its cap.
    draw.surface = draw.depthFail || !drawn[caster.object] ? VolumeSurface::capped : VolumeSurface::sides;
    draw.volume = &cache.get(plan, scene, caster, draw.surface, maxLayers, wideIndices);
    draw.mirrored = glm::determinant(glm::dmat3(caster.worldFromObject)) < 0.0;
    draw.clipFromObject = glm::mat4(view.clipFromWorld * caster.worldFromObject);
    draw.scissor = shadowScissor(view, light, box);
    uncapped += draw.surface == VolumeSurface::sides;
    if (draw.scissor && draw.scissor->width == 0) {
      ++outOfView;
      continue;
    }
    batcher.add(draw, box);
  }
  cache.endFrame();
  result.batches = batcher.take();
  if (uncapped > 0) {
    plan.note(scene.name + " caps of " + std::to_string(uncapped) + " shadow volumes",
              "no line from the light to the camera's near plane meets the caster");
  }
  if (outOfView > 0) {
    plan.note(scene.name + ", " + std::to_string(outOfView) + " shadow volumes",
              "the caster's shadow lies outside of the camera's view");
  }
  return result;
}

PlannedDraw volumeReceivers(PassPlan& plan, const VolumeView& view, std::span<const DrawItem> receivers) {
  PlannedDraw draw{.program = plan.addProgram({"volume/volume.vert", "volume/volume.frag", {}})};
  draw.state.depth = {.test = Compare::less, .write = true};
  draw.state.colorMask.fill(false);
  draw.what = MeshDraw{.items = receivers,
                       .clipFromWorld = view.clipFromWorld,
                       .faces = MeshDraw::Faces::facing,
                       .eyeWorld = view.eyeWorld,
                       .nearReach = view.nearReach};
  return draw;
}

void addVolumeCounts(PassPlan& plan, PlannedPass& pass, const LightVolumes& volumes, VolumeCounter counter,
                     int channel) {
  const Counting counting{pass, plan.addProgram({"volume/volume.vert", "volume/volume.frag", {}}),
                          plan.addProgram({"screen/fullscreen.vert", "volume/volume.frag", {}}),
                          volumes.clipFromDirection, channel};
  for (std::size_t i = 0; i < volumes.batches.size(); ++i) {
    const VolumeBatch& batch = volumes.batches[i];
    for (const VolumeDraw& draw : batch.draws) {
      if (counter == VolumeCounter::stencil) {
        addStencil(counting, draw);
      } else {
        addBlended(counting, draw);
      }
    }
    if (counter == VolumeCounter::stencil) {
      addStencilResolve(counting, batch.scissor);
    } else if (i + 1 < volumes.batches.size()) {
      // Also what earlier batches left outside of this one's scissor is one level already.
      addCollapse(counting, batch.scissor);
    }
  }
}

}  // namespace halfshadow::techniques
