// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// One light in one frame: all that a technique prepares its passes from. No GL.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/rect.hpp"
#include "base/workers.hpp"
#include "device/capabilities.hpp"
#include "planner/light_fit.hpp"
#include "planner/sub_lights.hpp"
#include "scene/caster_groups.hpp"
#include "scene/caster_silhouettes.hpp"
#include "scene/light.hpp"
#include "scene/light_silhouettes.hpp"
#include "techniques/core/draw_item.hpp"
#include "techniques/core/settings.hpp"

namespace halfshadow::techniques {

/// The screen side of a frame.
struct View {
  glm::dmat4 clipFromWorld{1.0};
  glm::dvec3 eyeWorld{0.0};
  int width = 0, height = 0;
  double nearReach = 0.0;  ///< from the eye to the near plane's corners, world units
};

/// A map's worth of what a light sees: its casters from one point of the light, by one projection.
struct LightView {
  planner::LightFit fit;              ///< projection, near and far, size
  Rect rect;                          ///< of the atlas that it shares with the others of its light, texels
  std::span<const DrawItem> casters;  ///< that matter in it
  std::string name;                   ///< of its images, "light 0 sample 3"
  std::uint64_t contentKey = 0;       ///< of light, casters and fit; 0: remade each frame
  std::uint64_t sceneKey = 0;         ///< the same with the receivers
};

/// References live until the frame ends.
struct LightScene {
  const device::Capabilities& capabilities;
  const Settings& settings;
  const View& screen;
  int channel = 0;   ///< its place among the frame's lights, of images that hold one in each channel
  std::string name;  ///< "light 0": what names of images and passes begin with
  const scene::AreaLight& light;
  LightView center;                                    ///< from its centre, of all its casters
  const planner::SubLights* subLights = nullptr;       ///< what maps see it through; null: it is seen whole
  std::span<const planner::CasterShape> casterShapes;  ///< of `casters`: what the views enclose
  double receiverFarDistance = 0.0;   ///< largest z in light space of a receiver inside the fit; 0 = none
  std::span<const DrawItem> casters;  ///< of all views
  scene::CasterGroups& groups;        ///< of `casters`, kept between frames: see placedCasters()
  /// Of placedCasters(), kept between frames: whoever needs outlines takes them from here.
  scene::CasterSilhouettes& silhouettes;
  std::span<const DrawItem> receivers;
  /// Objects that receive but are not among `casters`, for maps that hold the whole scene.
  std::span<const DrawItem> shadowlessReceivers;
  std::uint64_t contentKey = 0;  ///< of light and casters
  std::uint64_t sceneKey = 0;    ///< the same with the receivers
  Workers workers{};             ///< threads that the host lends
  bool countsFetches = false;    ///< the frame asks for fetches of each pixel instead of visibility

  const planner::LightFit& fit() const { return center.fit; }
};

/// What maps of the light are made from, in one atlas: its sub-lights' views, or the one from its centre.
struct AtlasViews {
  std::vector<LightView> views;
  int atlasSize = 0;  ///< texels a side
};
AtlasViews atlasViews(const LightScene& scene);

/// For ReceiverShading::mapFromWorld of what tells nothing but the height over the light's plane (z), in
/// every component.
glm::dmat4 heightFromWorld(const LightScene& scene);

/// The frame's casters as silhouettes are taken of them, those whose borders coincide as one; `object` is the
/// index in this list. Meshes last until the casters change.
std::span<const scene::PlacedCaster> placedCasters(const LightScene& scene);
inline constexpr std::uint32_t kNoCaster = ~0u;
/// Which of placedCasters() holds the receiver; kNoCaster where it casts nothing.
std::uint32_t placedCasterOf(const LightScene& scene, const DrawItem& receiver);

/// Another technique that takes a light where this one would draw it wrong.
struct StandIn {
  std::string id;      ///< one that needs no capability and has no stand-in itself
  std::string reason;  ///< what about the light or its casters asks for it, for the frame's report
};

}  // namespace halfshadow::techniques
