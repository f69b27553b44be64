// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "techniques/parts/screen/receiver_depth.hpp"

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_inverse.hpp>
#include <limits>
#include <vector>

namespace halfshadow::techniques {
namespace {
/// Without facets; with planes of facets from the facet stream; and of receivers that cast, with codes of
/// where these face, by derivatives or by the stream.
struct DepthPrograms {
  gl::Program* plain = nullptr;
  gl::Program* planes = nullptr;
  gl::Program* codes = nullptr;
  gl::Program* planesAndCodes = nullptr;
  gl::Program* of(const DrawItem& item) const {
    const bool stream = planes != nullptr && item.mesh->hasFacetStream();
    if (item.casts && planesAndCodes != nullptr) return stream ? planesAndCodes : codes;
    return stream ? planes : plain;
  }
};

Result<DepthPrograms> depthPrograms(const LightFrame& frame, ReceiverAlpha alpha) {
  DepthPrograms programs;
  const auto link = [&](std::vector<std::string> defines, gl::Program*& program) -> Status {
    auto linked =
        frame.programs.get({"screen/receiver_depth.vert", "screen/receiver_depth.frag", std::move(defines)});
    if (!linked) return linked.error();
    program = *linked;
    return {};
  };
  if (Status s = link({}, programs.plain); !s) return s.error();
  if (alpha == ReceiverAlpha::one) return programs;
  if (Status s = link({"HS_FACET_NORMAL"}, programs.planes); !s) return s.error();
  if (Status s = link({"HS_FACETS", "HS_FACET_NORMAL"}, programs.planesAndCodes); !s) return s.error();
  if (!needsFacetStream(frame.capabilities)) {
    if (Status s = link({"HS_FACETS"}, programs.codes); !s) return s.error();
  }
  return programs;
}

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

framegraph::ResourceId findResource(const framegraph::Graph& graph, const std::string& name) {
  for (std::uint32_t i = 0; i < graph.resources().size(); ++i) {
    if (graph.resources()[i].name == name) return {i};
  }
  return {};
}
void drawDepths(framegraph::PassContext& context, const DepthPrograms& programs, const ReceiverDepth& depth,
                const View& view, std::span<const DrawItem> items) {
  gl::Encoder& encoder = context.encoder;
  gl::Context& gl = encoder.context();
  // Unit scale keeps single precision in range for tiny and huge worlds.
  const double scale = 1.0 / depth.farthest;
  const ReceiverRays rays = receiverRays(view, depth, glm::dmat3(scale), view.eyeWorld);
  const glm::mat3 pixelRay(glm::dmat3(rays.rayX, rays.rayY, rays.rayOrigin));
  const bool marked = programs.planes == nullptr;
  gl::DrawState state{.depth = {.test = gl::Compare::less, .write = true}};
  for (const DrawItem& item : items) {
    gl::Program& program = *programs.of(item);
    const bool stream = &program == programs.planes || &program == programs.planesAndCodes;
    encoder.useProgram(program);
    program.set(gl, "u_inverseFarthest", static_cast<float>(scale));
    program.set(gl, "u_nearestReceiver", static_cast<float>(scale * depth.nearest));
    program.set(gl, "u_clipFromObject", glm::mat4(depth.clipFromWorld * item.worldFromObject));
    program.set(gl, "u_receiverMark", marked && hasFewTriangles(item) ? 128.0f : 254.75f);
    if (&program != programs.plain) {
      glm::dmat4 relative = item.worldFromObject;
      relative[3] -= glm::dvec4(view.eyeWorld, 0.0);
      for (int column = 0; column < 4; ++column) {
        relative[column] = glm::dvec4(scale * glm::dvec3(relative[column]), relative[column].w);
      }
      program.set(gl, "u_relativeFromObject", glm::mat4(relative));
    }
    if (stream) {
      glm::dmat3 normals = glm::inverseTranspose(glm::dmat3(item.worldFromObject));
      normals /=
          std::max(glm::length(normals[0]) + glm::length(normals[1]) + glm::length(normals[2]), 1e-300);
      program.set(gl, "u_worldNormalFromObject", glm::mat3(normals));
      program.set(gl, "u_pixelRay", pixelRay);
    }
    state.cull = hiddenFaces(item, view.eyeWorld, view.nearReach);
    item.mesh->draw(encoder, state, stream ? GpuMesh::Streams::facet : GpuMesh::Streams::positions);
  }
}
}  // namespace

Result<ReceiverDepth> declareReceiverDepth(const LightFrame& frame, ReceiverAlpha alpha) {
  const std::string name = alpha == ReceiverAlpha::facets ? "receiver depth and facets" : "receiver depth";
  ReceiverDepth depth;
  depth.clipFromWorld = withoutFarPlane(frame.screen.clipFromWorld);
  const glm::dvec4 w = row(frame.screen.clipFromWorld, 3);
  double low = std::numeric_limits<double>::infinity(), high = 0.0;
  for (const DrawItem& item : frame.receivers) {
    low = std::min(low, nearestInView(item.boundsWorld, frame.screen));
    for (const glm::dvec3& corner : item.boundsWorld.corners())
      high = std::max(high, glm::dot(w, glm::dvec4(corner, 1.0)));
  }
  depth.farthest = high > 0.0 ? high * (1.0 + 1e-6) : 1.0;
  depth.nearest = std::isfinite(low) ? std::clamp(0.999 * low, 0.0, depth.farthest) : 0.0;
  depth.packed = findResource(frame.graph, name);
  depth.depthTest = findResource(frame.graph, name + " test");
  if (depth.packed.valid()) return depth;

  auto programs = depthPrograms(frame, alpha);
  if (!programs) return programs.error();
  const int width = frame.screen.width, height = frame.screen.height;
  depth.packed = frame.graph.addResource({.name = name, .width = width, .height = height});
  depth.depthTest = frame.graph.addResource({.name = name + " test",
                                             .width = width,
                                             .height = height,
                                             .format = framegraph::Format::depth24,
                                             .storage = framegraph::Storage::renderbuffer});
  framegraph::PassDesc pass{.name = name, .stage = framegraph::PassStage::receiverPrepass};
  pass.writes = {{.resource = depth.packed, .point = framegraph::AttachmentPoint::color},
                 {.resource = depth.depthTest, .point = framegraph::AttachmentPoint::depth}};
  pass.execute = [programs = *programs, depth, &view = frame.screen,
                  items = std::vector<DrawItem>(frame.receivers.begin(), frame.receivers.end())](
                     framegraph::PassContext& context) { drawDepths(context, programs, depth, view, items); };
  frame.graph.addPass(std::move(pass));
  return depth;
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

void bindReceiverPosition(framegraph::PassContext& context, gl::Program& program, const ReceiverDepth& depth,
                          const ReceiverRays& rays) {
  gl::Encoder& encoder = context.encoder;
  program.set(encoder.context(), "u_receiverEye", glm::vec4(glm::vec3(rays.eye), 0.0f));
  program.set(encoder.context(), "u_receiverRay",
              glm::vec4(glm::vec3(rays.rayOrigin), static_cast<float>(depth.nearest / depth.farthest)));
  program.set(encoder.context(), "u_receiverRayX",
              glm::vec4(glm::vec3(rays.rayX), 1.0f / static_cast<float>(context.viewport.width)));
  program.set(encoder.context(), "u_receiverRayY",
              glm::vec4(glm::vec3(rays.rayY), 1.0f / static_cast<float>(context.viewport.height)));
  const gl::TextureBinding binding{program.samplerUnit("u_receiverDepth"), &context.texture(depth.packed)};
  encoder.bindTextures({&binding, 1});
}

}  // namespace halfshadow::techniques
