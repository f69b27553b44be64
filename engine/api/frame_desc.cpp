// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "api/frame_desc.hpp"

#include <algorithm>
#include <cmath>
#include <string>

namespace halfshadow::api {
namespace {
glm::dvec3 toVector(const double v[3]) {
  return {v[0], v[1], v[2]};
}

template <typename T, std::size_t n>
bool same(const T (&a)[n], const T (&b)[n]) {
  return std::equal(a, a + n, b);
}
}  // namespace

scene::Camera toCamera(const CameraDesc& desc) {
  return {.eyeWorld = toVector(desc.eye),
          .targetWorld = toVector(desc.target),
          .up = toVector(desc.up),
          .verticalFovRadians = desc.verticalFovRadians,
          .nearDistance = desc.nearDistance,
          .farDistance = desc.farDistance};
}

Status checkFrameDesc(const RenderDesc& desc) {
  const auto within = [](auto value, auto last) { return value >= decltype(value){} && value <= last; };
  if (!within(desc.output, Output::lightsOnly) || !within(desc.timing, Timing::perPass) ||
      !within(desc.receivers, Receivers::unknown) || !within(desc.target.kind, TargetDesc::Kind::host)) {
    return Error{ErrorCode::invalidArgument,
                 "the frame's output, timing, receivers or kind of target is none of its enum's values"};
  }
  for (const float component : desc.clearColor) {
    if (!std::isfinite(component))
      return Error{ErrorCode::invalidArgument, "the clear colour has a NaN or infinite component"};
  }
  return {};
}

Status checkTarget(const TargetDesc& target, const device::Limits& limits) {
  const int limit = std::min(limits.textureSize, limits.renderbufferSize);
  if (target.width <= 0 || target.height <= 0) {
    return Error{ErrorCode::invalidArgument, "the target's size is " + std::to_string(target.width) + "x" +
                                                 std::to_string(target.height) + "; give positive numbers"};
  }
  // Beyond any driver's viewport; also keeps sums of place and size within int.
  constexpr int kFarthest = 1 << 16;
  if (std::max(target.width, target.height) > kFarthest ||
      std::abs(static_cast<double>(target.x)) > kFarthest ||
      std::abs(static_cast<double>(target.y)) > kFarthest) {
    return Error{ErrorCode::invalidArgument,
                 "the target's rectangle " + std::to_string(target.width) + "x" +
                     std::to_string(target.height) + " at " + std::to_string(target.x) + ", " +
                     std::to_string(target.y) + " reaches beyond 65536; give a place within the framebuffer"};
  }
  if (target.kind == TargetDesc::Kind::engine && std::max(target.width, target.height) > limit) {
    return Error{ErrorCode::invalidArgument, "the target's size " + std::to_string(target.width) + "x" +
                                                 std::to_string(target.height) +
                                                 " is above this device's limit of " + std::to_string(limit)};
  }
  return {};
}

techniques::ReceiverOutput receiverOutput(const RenderDesc& desc, Shading shading) {
  switch (desc.output) {
    case Output::shaded:
      return shading == Shading::apart ? techniques::ReceiverOutput::visibility
                                       : techniques::ReceiverOutput::shaded;
    case Output::visibility:
    case Output::lightsOnly:
      return techniques::ReceiverOutput::visibility;
    case Output::visibility16:
      return techniques::ReceiverOutput::visibility16;
    case Output::taps:
      return techniques::ReceiverOutput::taps;
  }
  return techniques::ReceiverOutput::visibility;
}

std::size_t drawnLights(const RenderDesc& desc, Shading shading, std::size_t lightCount) {
  return receiverOutput(desc, shading) == techniques::ReceiverOutput::visibility ? lightCount : 1;
}

techniques::ReceiverTarget receiverTarget(std::size_t light, std::size_t drawn) {
  techniques::ReceiverTarget target{.depthIsComplete = light > 0};
  if (drawn > 1) {
    target.colorMask.fill(false);
    target.colorMask[light] = true;
  }
  return target;
}

bool sameFrame(const RenderDesc& a, const RenderDesc& b) {
  const auto sameCamera = [](const CameraDesc& p, const CameraDesc& q) {
    return same(p.eye, q.eye) && same(p.target, q.target) && same(p.up, q.up) &&
           p.verticalFovRadians == q.verticalFovRadians && p.nearDistance == q.nearDistance &&
           p.farDistance == q.farDistance;
  };
  const auto sameTarget = [](const TargetDesc& p, const TargetDesc& q) {
    return p.kind == q.kind && p.framebuffer == q.framebuffer && p.x == q.x && p.y == q.y &&
           p.width == q.width && p.height == q.height;
  };
  return sameCamera(a.camera, b.camera) && sameTarget(a.target, b.target) && a.output == b.output &&
         a.receivers == b.receivers && same(a.clearColor, b.clearColor);
}

}  // namespace halfshadow::api
