// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "techniques/parts/screen/receiver_depth.hpp"

#include <algorithm>
#include <bitset>
#include <cmath>
#include <glm/gtc/matrix_inverse.hpp>
#include <limits>
#include <optional>
#include <vector>

#include "outlines/wedge_bounds.hpp"

namespace halfshadow::techniques {
namespace {
glm::dvec4 row(const glm::dmat4& m, int index) {
  return {m[0][index], m[1][index], m[2][index], m[3][index]};
}

/// The same projection with z = w - 2·near, whose far plane is at infinity.
glm::dmat4 withoutFarPlane(const glm::dmat4& clipFromWorld) {
  const glm::dvec4 z = row(clipFromWorld, 2), w = row(clipFromWorld, 3);
  const double slope = glm::dot(glm::dvec3(z), glm::dvec3(w)) / glm::dot(glm::dvec3(w), glm::dvec3(w));
  const double near = (slope * w.w - z.w) / (slope + 1.0);
  glm::dmat4 result = clipFromWorld;
  for (int column = 0; column < 4; ++column) result[column][2] = w[column];
  result[3][2] -= 2.0 * near;
  return result;
}

/// Keeps the part of a polygon where `distance` is not negative.
void cutPolygon(std::vector<glm::dvec4>& polygon, auto distance) {
  std::vector<glm::dvec4> kept;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const glm::dvec4 &from = polygon[i], &to = polygon[(i + 1) % polygon.size()];
    const double before = distance(from), after = distance(to);
    if (before >= 0.0) kept.push_back(from);
    if ((before >= 0.0) != (after >= 0.0)) kept.push_back(glm::mix(from, to, before / (before - after)));
  }
  polygon = std::move(kept);
}

/// Distance along the view axis from which on the box can be seen; infinite where it cannot. A floor that
/// reaches below the camera begins where the view's lower edge meets it.
double nearestInView(const scene::Bounds& box, const View& view) {
  const glm::dvec3 reach(view.nearReach);
  if (glm::all(glm::greaterThanEqual(view.eyeWorld + reach, box.low)) &&
      glm::all(glm::lessThanEqual(view.eyeWorld - reach, box.high)))
    return 0.0;
  constexpr int kFaces[6][4] = {{0, 2, 6, 4}, {1, 3, 7, 5}, {0, 1, 5, 4},
                                {2, 3, 7, 6}, {0, 1, 3, 2}, {4, 5, 7, 6}};
  constexpr double kWider = 1.01;  // what rasterisers may touch beyond the view's borders
  double nearest = std::numeric_limits<double>::infinity();
  for (const auto& face : kFaces) {
    std::vector<glm::dvec4> polygon;
    for (const int corner : face) {
      polygon.push_back(view.clipFromWorld * glm::dvec4(corner & 1 ? box.high.x : box.low.x,
                                                        corner & 2 ? box.high.y : box.low.y,
                                                        corner & 4 ? box.high.z : box.low.z, 1.0));
    }
    cutPolygon(polygon, [](const glm::dvec4& p) { return p.z + p.w; });
    for (const int axis : {0, 1}) {
      cutPolygon(polygon, [&](const glm::dvec4& p) { return kWider * p.w - p[axis]; });
      cutPolygon(polygon, [&](const glm::dvec4& p) { return kWider * p.w + p[axis]; });
    }
    for (const glm::dvec4& p : polygon) nearest = std::min(nearest, p.w);
  }
  return nearest;
}

/// In the plan, once each.
class DepthPrograms {
 public:
  explicit DepthPrograms(PassPlan& plan) : plan_(plan) {}
  std::uint32_t of(bool codes, bool planes) {
    std::optional<std::uint32_t>& program = programs_[codes][planes];
    if (program) return *program;
    std::vector<std::string> defines;
    if (codes) defines.push_back("HS_FACETS");
    if (planes) defines.push_back("HS_FACET_NORMAL");
    program =
        plan_.addProgram({"screen/receiver_depth.vert", "screen/receiver_depth.frag", std::move(defines)});
    return *program;
  }

 private:
  PassPlan& plan_;
  std::optional<std::uint32_t> programs_[2][2];
};

/// Places relative to the eye, and planes of facets where the item has them.
void setFacetUniforms(PlannedDraw& draw, const View& view, const ReceiverDepth& depth, const DrawItem& item,
                      bool planes) {
  // Unit scale keeps single precision in range for tiny and huge worlds.
  const double scale = 1.0 / depth.farthest;
  glm::dmat4 relative = item.worldFromObject;
  relative[3] -= glm::dvec4(view.eyeWorld, 0.0);
  for (int column = 0; column < 4; ++column) {
    relative[column] = glm::dvec4(scale * glm::dvec3(relative[column]), relative[column].w);
  }
  draw.uniforms.set("u_relativeFromObject", glm::mat4(relative));
  if (!planes) return;
  glm::dmat3 normals = glm::inverseTranspose(glm::dmat3(item.worldFromObject));
  normals /= std::max(glm::length(normals[0]) + glm::length(normals[1]) + glm::length(normals[2]), 1e-300);
  draw.uniforms.set("u_worldNormalFromObject", glm::mat3(normals));
}

MeshDraw meshDraw(const View& view, const ReceiverDepth& depth, std::span<const DrawItem> item, bool planes) {
  return {.items = item,
          .clipFromWorld = depth.clipFromWorld,
          .streams = planes ? MeshStreams::facet : MeshStreams::positions,
          .faces = MeshDraw::Faces::facing,
          .eyeWorld = view.eyeWorld,
          .nearReach = view.nearReach};
}

/// Plane and facet code of each item as `alpha` wants them. `number`: of ReceiverAlpha::numbers, 0 where it
/// casts nothing.
PlannedDraw depthDraw(const LightScene& scene, DepthPrograms& programs, const ReceiverDepth& depth,
                      ReceiverAlpha alpha, std::span<const DrawItem> item, int number) {
  const DrawItem& drawn = item.front();
  const View& view = scene.screen;
  const bool facets = alpha == ReceiverAlpha::facets;
  const bool planes = alpha != ReceiverAlpha::one && drawn.facetStream, codes = facets && drawn.casts;
  PlannedDraw draw{.program = programs.of(codes, planes)};

  const double scale = 1.0 / depth.farthest;
  draw.uniforms.set("u_inverseFarthest", static_cast<float>(scale));
  draw.uniforms.set("u_nearestReceiver", static_cast<float>(scale * depth.nearest));
  float mark = !facets && hasFewTriangles(drawn) ? 128.0f : 254.75f;
  if (alpha == ReceiverAlpha::numbers) mark = static_cast<float>(number);
  draw.uniforms.set("u_receiverMark", mark);
  if (planes || codes) setFacetUniforms(draw, view, depth, drawn, planes);
  if (planes) {
    const ReceiverRays rays = receiverRays(view, depth, glm::dmat3(scale), view.eyeWorld);
    draw.uniforms.set("u_pixelRay", glm::mat3(glm::dmat3(rays.rayX, rays.rayY, rays.rayOrigin)));
  }
  draw.state.depth = {.test = device::Compare::less, .write = true};
  draw.what = meshDraw(view, depth, item, planes);
  return draw;
}

const char* nameOf(ReceiverAlpha alpha) {
  switch (alpha) {
    case ReceiverAlpha::facets:
      return "receiver depth and facets";
    case ReceiverAlpha::numbers:
      return "receiver depth and numbers";
    case ReceiverAlpha::one:
      break;
  }
  return "receiver depth";
}
}  // namespace

ReceiverDepth planReceiverDepth(const LightScene& scene, PassPlan& plan, ReceiverAlpha alpha,
                                std::span<const NumberedReceiver> numbered) {
  const std::string name = nameOf(alpha);
  ReceiverDepth depth;
  depth.clipFromWorld = withoutFarPlane(scene.screen.clipFromWorld);
  const glm::dvec4 w = row(scene.screen.clipFromWorld, 3);
  double low = std::numeric_limits<double>::infinity(), high = 0.0;
  for (const DrawItem& item : scene.receivers) {
    if (alpha == ReceiverAlpha::numbers && !item.casts) continue;  // they hide others, no more
    low = std::min(low, nearestInView(item.boundsWorld, scene.screen));
    for (const glm::dvec3& corner : item.boundsWorld.corners())
      high = std::max(high, glm::dot(w, glm::dvec4(corner, 1.0)));
  }
  depth.farthest = high > 0.0 ? high * (1.0 + 1e-6) : 1.0;
  depth.nearest = std::isfinite(low) ? std::clamp(0.999 * low, 0.0, depth.farthest) : 0.0;
  const int width = scene.screen.width, height = scene.screen.height;
  depth.packed = plan.addSharedImage({.name = name, .width = width, .height = height});
  depth.depthTest = plan.addSharedImage({.name = name + " test",
                                         .width = width,
                                         .height = height,
                                         .format = framegraph::Format::depth24,
                                         .storage = framegraph::Storage::renderbuffer});
  PlannedPass pass{.name = name, .stage = framegraph::PassStage::receiverPrepass};
  pass.writes = {{.resource = depth.packed, .point = framegraph::AttachmentPoint::color},
                 {.resource = depth.depthTest, .point = framegraph::AttachmentPoint::depth}};
  DepthPrograms programs(plan);
  auto next = numbered.begin();
  for (std::size_t i = 0; i < scene.receivers.size(); ++i) {
    const bool isNumbered = next != numbered.end() && next->item == &scene.receivers[i];
    const int number = isNumbered ? next++->number : 0;
    pass.draws.push_back(depthDraw(scene, programs, depth, alpha, scene.receivers.subspan(i, 1), number));
  }
  pass.drawsForAllLights = pass.draws.size();
  plan.passes.push_back(std::move(pass));
  return depth;
}

std::optional<std::vector<NumberedReceiver>> numberReceivers(const LightScene& scene) {
  // Each is compared with all before it.
  constexpr std::size_t kMostNumber = 254, kMostReceivers = 4096;
  std::vector<NumberedReceiver> receivers;
  for (const DrawItem& item : scene.receivers) {
    if (!item.casts) continue;
    if (receivers.size() == kMostReceivers) return std::nullopt;
    NumberedReceiver receiver{
        .item = &item,
        .rect = outlines::screenBounds(item.boundsWorld.corners(), scene.screen.clipFromWorld,
                                       scene.screen.width, scene.screen.height)};
    if (receiver.rect) {
      std::bitset<kMostNumber + 1> taken;
      taken.set(0);
      for (const NumberedReceiver& other : receivers) {
        if (other.rect && outlines::commonRect(*receiver.rect, *other.rect))
          taken.set(static_cast<std::size_t>(other.number));
      }
      if (taken.all()) return std::nullopt;
      while (taken.test(static_cast<std::size_t>(receiver.number))) ++receiver.number;
    }
    receivers.push_back(receiver);
  }
  return receivers;
}

framegraph::ResourceId planReceiverFacets(const LightScene& scene, PassPlan& plan,
                                          const ReceiverDepth& depth) {
  const std::string name = "facets of receivers";
  const framegraph::ResourceId image =
      plan.addSharedImage({.name = name, .width = scene.screen.width, .height = scene.screen.height});
  PlannedPass pass{.name = name, .stage = framegraph::PassStage::receiverPrepass};
  pass.writes = {{.resource = image, .point = framegraph::AttachmentPoint::color},
                 {.resource = depth.depthTest,
                  .point = framegraph::AttachmentPoint::depth,
                  .initial = framegraph::InitialContent::keep}};
  for (std::size_t i = 0; i < scene.receivers.size(); ++i) {
    const DrawItem& item = scene.receivers[i];
    if (!item.casts) continue;
    PlannedDraw draw{.program = plan.addProgram({"screen/receiver_depth.vert",
                                                 "screen/receiver_facets.frag",
                                                 {item.facetStream ? "HS_FACET_NORMAL" : "HS_FACETS"}})};
    draw.uniforms.set("u_inverseFarthest", static_cast<float>(1.0 / depth.farthest));
    setFacetUniforms(draw, scene.screen, depth, item, item.facetStream);
    draw.state.depth = {.test = device::Compare::equal, .write = false};
    draw.what = meshDraw(scene.screen, depth, scene.receivers.subspan(i, 1), item.facetStream);
    pass.draws.push_back(std::move(draw));
  }
  pass.drawsForAllLights = pass.draws.size();
  plan.passes.push_back(std::move(pass));
  return image;
}

ReceiverRays receiverRays(const View& view, const ReceiverDepth& depth, const glm::dmat3& lightFromWorld,
                          const glm::dvec3& lightCenterWorld) {
  // Clip coordinates x, y and w are linear in the position relative to the eye, so that a pixel's ray is the
  // inverse of that map applied to (x, y, 1): its length is 1 along the view axis.
  glm::dmat3 windowFromRay(0.0);
  for (int column = 0; column < 3; ++column) {
    windowFromRay[column] = {view.clipFromWorld[column][0], view.clipFromWorld[column][1],
                             view.clipFromWorld[column][3]};
  }
  const glm::dmat3 ray = lightFromWorld * glm::inverse(windowFromRay) * depth.farthest;
  return {.eye = lightFromWorld * (view.eyeWorld - lightCenterWorld),
          .rayOrigin = ray[2] - ray[0] - ray[1],
          .rayX = ray[0] * (2.0 / view.width),
          .rayY = ray[1] * (2.0 / view.height)};
}

void addReceiverPosition(PlannedDraw& draw, const View& view, const ReceiverDepth& depth,
                         const ReceiverRays& rays) {
  draw.uniforms.set("u_receiverEye", glm::vec4(glm::vec3(rays.eye), 0.0f));
  draw.uniforms.set("u_receiverRay",
                    glm::vec4(glm::vec3(rays.rayOrigin), static_cast<float>(depth.nearest / depth.farthest)));
  draw.uniforms.set("u_receiverRayX", glm::vec4(glm::vec3(rays.rayX), 1.0f / static_cast<float>(view.width)));
  draw.uniforms.set("u_receiverRayY",
                    glm::vec4(glm::vec3(rays.rayY), 1.0f / static_cast<float>(view.height)));
  draw.textures.push_back({.sampler = "u_receiverDepth", .resource = depth.packed});
}

}  // namespace halfshadow::techniques
