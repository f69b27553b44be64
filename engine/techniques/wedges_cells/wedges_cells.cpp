// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "techniques/wedges_cells/wedges_cells.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "planner/frame_planner.hpp"
#include "techniques/wedges_cells/list_textures.hpp"

namespace halfshadow::techniques {
namespace {
/// Heights are in units of the casters' farthest distance. What is nearer to the light's plane is cut.
constexpr double kMinHeight = 1e-3;
/// A point light counts as a square this wide, in the same units: hard shadows to a fraction of a pixel.
constexpr double kMinHalfLength = 1e-4;
constexpr int kMaxTiles = 512;
/// Tiles of casters against those of other receivers: their surfaces turn away from the light within a tile,
/// and their own silhouettes pass it. Measured at 27 spheres: half as many vertices a fragment at 1/4, a
/// third less at 1/2, for twice and a half more list building.
constexpr double kCasterTileShare = 0.5;

/// What a list depends on besides the light's silhouettes.
struct CachedReceiver {
  std::uint64_t revision = 0;
  ReceiverTiles tiles;
  CellLists lists;
  glm::ivec2 firstTexel{0};
};

/// What is kept for one light.
struct LightLists {
  std::uint64_t key = 0;
  scene::LightPlane plane;
  std::array<scene::LightSilhouetteCache, kSubLights> silhouettes;
  std::vector<SubLightLoops> subLights;
  TangentRect shadows;
  double tileSize = 1.0;
  double lift = 0.0;                                ///< world units
  std::map<const void*, CachedReceiver> receivers;  ///< by the object's geometry
  std::vector<const void*> encoded;                 ///< those in the textures, by address
  gl::Texture tiles, records;
  glm::vec3 center{0.0f}, step{1.0f};
  std::uint32_t longestList = 0;
  std::size_t recordCount = 0, partialTiles = 0;
};

Status upload(gl::Context& context, const ListImage& image, gl::Texture& texture) {
  if (texture && texture.desc().width == image.width && texture.desc().height == image.height) {
    texture.update(context, 0, 0, image.width, image.height, image.rgba.data());
    return {};
  }
  auto made = gl::Texture::create(context, {.width = image.width, .height = image.height}, image.rgba.data());
  if (!made) return made.error();
  texture = std::move(made).value();
  return {};
}

/// How far fragments of casters are moved off their surface, along its normal: about a thousandth of the
/// casters' size, in steps of ten.
double liftDistance(std::span<const DrawItem> casters, double bias) {
  scene::Bounds bounds;
  for (const DrawItem& caster : casters) bounds.include(caster.boundsWorld);
  const double radius = bounds.radius();
  return radius > 0.0 ? bias * 0.002 * std::pow(10.0, std::floor(std::log10(radius))) : 0.0;
}

class WedgesCells final : public Technique {
 public:
  const TechniqueInfo& info() const override {
    static const TechniqueInfo info{
        .id = "wedges-cells",
        .paper = "after Forest, Barthe, Paulin 2006; light cells and gathered lists are this engine's own",
        .summary = "exact coverage of light cells per caster from silhouettes of four sub-lights, multiplied",
        .guarantees =
            "exact up to storage for one convex caster as each sub-light's centre sees it; the order "
            "of casters does not matter",
        .knownFailures =
            "casters that overlap within one cell count as independent; a non-convex caster's "
            "overlap with itself counts twice inside a cell"};
    return info;
  }
  std::vector<SettingInfo> settings() const override {
    return {{"wedges-cells.bytes",
             SettingType::choice,
             "16",
             0,
             0,
             {"4", "16", "32"},
             "light cells, one byte's worth each: 4 sub-lights of 1, 4 or 8 cells"},
            {"wedges-cells.tiles",
             SettingType::integer,
             "128",
             1,
             kMaxTiles,
             {},
             "tiles of vertex lists along the longer side of what the shadows cover, seen from the light"}};
  }
  Result<ReceiverShading> declare(const LightFrame& frame) override;
  void contextLost() override { lights_.clear(); }

 private:
  static void findSilhouettes(const LightFrame& frame, LightLists& lists);
  static Status encode(const LightFrame& frame, LightLists& lists);
  std::map<int, LightLists> lights_;
};

void WedgesCells::findSilhouettes(const LightFrame& frame, LightLists& lists) {
  // A power of two: casters that move about must not change the coordinates of the others.
  const double unit = std::exp2(std::ceil(std::log2(frame.fit.farDistance)));
  lists.lift = liftDistance(frame.casters, frame.settings.real("bias"));
  lists.plane = scene::LightPlane(frame.light, unit, kMinHalfLength * unit);
  std::vector<scene::PlacedCaster> casters;
  for (std::size_t i = 0; i < frame.casters.size(); ++i) {
    casters.push_back({.mesh = &frame.casters[i].halfEdges(),
                       .worldFromObject = frame.casters[i].worldFromObject,
                       .object = static_cast<std::uint32_t>(i),
                       .revision = frame.casters[i].revision});
  }
  lists.subLights.clear();
  const auto quarters = subLights();
  for (std::size_t i = 0; i < quarters.size(); ++i) {
    const glm::vec2 source = quarters[i].center;
    lists.subLights.push_back(loopsOf(lists.silhouettes[i].update(casters, lists.plane, source.x, source.y,
                                                                  kMinHeight, scene::LayerSplit::alongside),
                                      quarters[i]));
  }
  lists.shadows = shadowedTangents(lists.subLights);
  lists.receivers.clear();
}

Status WedgesCells::encode(const LightFrame& frame, LightLists& lists) {
  const glm::dvec2 size = lists.shadows.high - lists.shadows.low;
  const double finest = std::max(size.x, size.y) / frame.settings.integer("wedges-cells.tiles");
  const gl::Limits& limits = frame.capabilities.limits;
  // The column and row of a list take 24 bits; without highp, coordinates of 1024 rows are exact.
  const int maxRows =
      std::min({limits.textureSize, 65536, frame.capabilities.has(gl::Capability::highp) ? 65536 : 1024});
  if (lists.tileSize < finest || lists.receivers.empty()) lists.tileSize = finest;
  bool changed = !lists.tiles;
  for (int attempt = 0; attempt < 8; ++attempt) {
    std::vector<const void*> used;
    std::vector<ReceiverLists> receivers;
    for (const DrawItem& item : frame.receivers) {
      CachedReceiver& cached = lists.receivers[item.geometry];
      if (cached.revision != item.revision) {
        cached.revision = item.revision;
        cached.tiles = receiverTiles(
            {.mesh = item.sourceMesh, .worldFromObject = item.worldFromObject, .closed = item.closed},
            lists.plane, lists.shadows, (item.casts ? kCasterTileShare : 1.0) * lists.tileSize, kMaxTiles,
            kMinHeight, lists.lift);
        cached.lists = cellLists(lists.subLights, cached.tiles);
        changed = true;
      }
      used.push_back(item.geometry);
      receivers.push_back({&cached.lists, cached.tiles.columns, cached.tiles.rows});
    }
    // Receivers come in the camera's order; what is encoded does not depend on it.
    std::vector<const void*> inSomeOrder = used;
    std::ranges::sort(inSomeOrder);
    if (!changed && inSomeOrder == lists.encoded) return {};
    EncodedLists encoded;
    if (encodeLists(receivers, maxRows, encoded)) {
      if (Status s = upload(frame.context, encoded.tiles, lists.tiles); !s) return s;
      if (Status s = upload(frame.context, encoded.records, lists.records); !s) return s;
      lists.center = encoded.center;
      lists.step = encoded.step;
      for (std::size_t i = 0; i < used.size(); ++i)
        lists.receivers[used[i]].firstTexel = encoded.firstTexel[i];
      lists.encoded = std::move(inSomeOrder);
      return {};
    }
    // Half as many tiles a side: lists grow by less than their number shrinks.
    lists.tileSize *= 2.0;
    lists.receivers.clear();
    frame.graph.noteSkipped("wedges-cells.tiles",
                            "the lists exceed the largest texture; tiles are twice as large");
  }
  return Error{
      ErrorCode::outOfMemory,
      "the silhouettes' vertex lists exceed this device's largest texture; lower wedges-cells.tiles"};
}

/// Direction of a pixel's ray in the light's coordinates, from (x, y, 1) with x and y in [0, 1] over the
/// view.
glm::dmat3 pixelRays(const View& view, const scene::LightPlane& plane) {
  const glm::dmat4 worldFromClip = glm::inverse(view.clipFromWorld);
  const auto direction = [&](double x, double y) {
    const glm::dvec4 p = worldFromClip * glm::dvec4(x, y, 0.0, 1.0);
    return plane.axes * (glm::dvec3(p) / p.w - view.eyeWorld);
  };
  const glm::dvec3 corner = direction(-1, -1);
  glm::dmat3 rays(direction(1, -1) - corner, direction(-1, 1) - corner, corner);
  // Only directions matter: at unit scale single precision has them all.
  return rays / std::max(glm::length(corner), 1e-300);
}

Result<ReceiverShading> WedgesCells::declare(const LightFrame& frame) {
  LightLists& lists = lights_[frame.lightIndex];
  const std::uint64_t key = planner::combineKeys(frame.contentKey, frame.settings.revision());
  if (lists.key != key) {
    findSilhouettes(frame, lists);
    lists.key = key;
    lists.encoded.clear();
  }
  if (Status s = encode(frame, lists); !s) return s.error();

  ReceiverShading shading;
  shading.fragmentFile = "wedges_cells.frag";
  shading.defines = {"HS_CELLS " + frame.settings.choice("wedges-cells.bytes")};
  shading.forward = false;
  // Most fragments have no list; a loop that ends at once still costs a round on some devices.
  if (frame.preferredSkip == FilterSkip::stencil) shading.skip = FilterSkip::stencil;
  shading.usesFacetPlane = true;
  shading.selfReceivers = ReceiverShading::SelfReceivers::casting;
  shading.textures = {{.sampler = "u_cellTiles", .resource = {}, .texture = &lists.tiles},
                      {.sampler = "u_cellLists", .resource = {}, .texture = &lists.records}};
  // Rows a, b, h, h: what the vertex shader hands on as (a, b, -, h).
  const glm::dmat3& axes = lists.plane.axes;
  const glm::dvec3 offset = lists.plane.fromWorld(glm::dvec3(0.0));
  for (int column = 0; column < 3; ++column) {
    shading.mapFromWorld[column] = glm::dvec4(axes[column], axes[column].z);
  }
  shading.mapFromWorld[3] = glm::dvec4(offset, offset.z);
  const glm::vec2 tileTexel = 1.0f / glm::vec2(lists.tiles.desc().width, lists.tiles.desc().height);
  const glm::vec2 recordTexel = 1.0f / glm::vec2(lists.records.desc().width, lists.records.desc().height);
  const glm::mat3 lift(lists.lift * lists.lift * axes * glm::transpose(axes));
  // Vertices are stored to half a step.
  const auto heightBias = static_cast<float>(2.0 * frame.settings.real("bias")) * lists.step.z;
  const glm::mat3 rays(pixelRays(frame.view, lists.plane));
  const glm::vec3 eye(lists.plane.fromWorld(frame.view.eyeWorld));
  shading.setUniforms = [lift, rays, eye, center = glm::vec4(lists.center, kMinHeight),
                         step = glm::vec4(lists.step, heightBias), texel = glm::vec4(tileTexel, recordTexel)](
                            gl::Program& program, gl::Context& context) {
    program.set(context, "u_cellTexel", texel);
    program.set(context, "u_listCenter", center);
    program.set(context, "u_listScale", step);
    program.set(context, "u_lift", lift);
    program.set(context, "u_rayLight", rays);
    program.set(context, "u_eyeLight", eye);
    // The facet stream's gradient becomes that of i over t.
    program.set(context, "u_vertexPlane", glm::vec4(-1.0f, 1.0f, 1.0f, 1e6f));
  };
  shading.setItemUniforms = [&lists](gl::Program& program, gl::Context& context, const DrawItem& item) {
    const auto found = lists.receivers.find(item.geometry);
    if (found == lists.receivers.end() || found->second.tiles.empty()) {
      program.set(context, "u_tileAtlas", glm::vec4(0.0f));
      return;
    }
    const ReceiverTiles& tiles = found->second.tiles;
    const glm::dvec2 scale = 1.0 / tiles.tileSize;
    program.set(context, "u_tileOfTangent", glm::vec4(glm::dvec4(scale, -tiles.low * scale)));
    program.set(context, "u_tileAtlas",
                glm::vec4(tiles.columns, tiles.rows, found->second.firstTexel.x, found->second.firstTexel.y));
  };
  return shading;
}
}  // namespace

std::unique_ptr<Technique> makeWedgesCells() {
  return std::make_unique<WedgesCells>();
}

}  // namespace halfshadow::techniques
