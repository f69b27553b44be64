// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// What a technique is, what it gets per frame and light, and what it gives back: declared passes and the way
/// a receiver fragment obtains its visibility.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/error.hpp"
#include "framegraph/executor.hpp"
#include "framegraph/graph.hpp"
#include "gl/program.hpp"
#include "planner/light_fit.hpp"
#include "scene/caster_groups.hpp"
#include "scene/half_edge_mesh.hpp"
#include "scene/light_silhouettes.hpp"
#include "techniques/core/gpu_mesh.hpp"
#include "techniques/core/settings.hpp"
#include "techniques/core/shared_textures.hpp"

namespace halfshadow::techniques {

struct TechniqueInfo {
  std::string id;
  std::string paper;  ///< author, year, section
  std::string summary;
  std::string guarantees;     ///< what holds exactly
  std::string knownFailures;  ///< what it gets wrong by construction
};

struct Support {
  bool supported = true;
  std::string reason;  ///< the missing capability by name, and what would provide it
};

/// One object placed in the world, as passes draw it.
struct DrawItem {
  const GpuMesh* mesh = nullptr;
  bool casts = true;  ///< of receivers: it is among the casters of some light in this frame
  bool receives = true;
  glm::dmat4 worldFromObject{1.0};
  glm::vec4 baseColor{1.0f};
  const gl::Texture* baseColorTexture = nullptr;
  scene::Bounds boundsWorld;
  bool closed = false;    ///< no boundary edges: from outside only front faces are seen
  bool mirrored = false;  ///< the transform turns the winding round
  const scene::TriangleMesh* sourceMesh = nullptr;
  const scene::CasterGeometry* geometry = nullptr;
  std::uint64_t revision = 0;  ///< of mesh and transform
  /// Adjacency, for silhouettes; built on the first call.
  const scene::HalfEdgeMesh& halfEdges() const { return geometry->halfEdges(*sourceMesh); }
};

/// Faces that need not be drawn when seen from `eyeWorld`: back faces of closed objects that are farther than
/// `nearReach`, so that no near plane opens them. Halves rasterisation, which is most of the cost of dense
/// meshes.
gl::Cull hiddenFaces(const DrawItem& item, const glm::dvec3& eyeWorld, double nearReach = 0.0);

/// The screen side of a frame.
struct View {
  glm::dmat4 clipFromWorld{1.0};
  glm::dvec3 eyeWorld{0.0};
  int width = 0, height = 0;
  double nearReach = 0.0;  ///< from the eye to the near plane's corners, world units
};

/// How receiver fragments that need the filter are kept apart from those that do not.
enum class FilterSkip {
  none,    ///< every fragment runs the same code
  branch,  ///< `if` around the taps
  loop,    ///< a tap loop that ends at the fragment's own count
  stencil  ///< a first draw decides what needs no filter and tags it in depth; a second draw filters the rest
};

/// What a technique may read while it declares a frame for one light. References live until the frame ends.
struct LightFrame {
  const gl::Capabilities& capabilities;
  gl::Context& context;
  gl::ProgramCache& programs;
  SharedTextures& shared;
  const Settings& settings;
  framegraph::Graph& graph;
  const View& view;
  const scene::AreaLight& light;
  int lightIndex = 0;
  planner::LightFit fit;
  std::span<const glm::dvec3> casterPointsWorld;  ///< what the fit encloses, three a triangle
  double receiverFarDistance = 0.0;   ///< largest z in light space of a receiver inside the fit; 0 = none
  std::span<const DrawItem> casters;  ///< those the light view is made from
  scene::CasterGroups& groups;        ///< of `casters`, kept between frames: see placedCasters()
  std::span<const DrawItem> receivers;
  /// Objects that receive but are not among `casters`, for maps that hold the whole scene.
  std::span<const DrawItem> shadowlessReceivers;
  std::uint64_t contentKey = 0;  ///< of light, casters and fit
  std::uint64_t sceneKey = 0;    ///< the same with the receivers
  std::string mapName;           ///< appended to the names of maps, for techniques with several a light
  framegraph::Lifetime mapLifetime = framegraph::Lifetime::persistent;
  FilterSkip preferredSkip = FilterSkip::stencil;  ///< setting filter_skip: the device profile's choice
};

/// For ReceiverShading::mapFromWorld of what tells nothing but the height over the light's plane (z), in
/// every component.
glm::dmat4 heightFromWorld(const LightFrame& frame);

/// The frame's casters as silhouettes are taken of them, those whose borders coincide as one; `object` is the
/// index in this list. Meshes last until the casters change.
std::span<const scene::PlacedCaster> placedCasters(const LightFrame& frame);
inline constexpr std::uint32_t kNoCaster = ~0u;
/// Which of placedCasters() holds the receiver; kNoCaster where it casts nothing.
std::uint32_t placedCasterOf(const LightFrame& frame, const DrawItem& receiver);

/// Of the setting value "branch", "loop" or "stencil".
FilterSkip filterSkipFromName(std::string_view name);

/// A sampler of the receiver program and what it reads: a resource of the graph, or a texture of the
/// technique's own.
struct ReceiverTexture {
  gl::UniformKey sampler;
  framegraph::ResourceId resource;
  const gl::Texture* texture = nullptr;
};

/// How a receiver fragment obtains the visibility of one light.
struct ReceiverShading {
  std::string fragmentFile;          ///< below shaders_es2/; defines halfshadow_visibility()
  std::vector<std::string> defines;  ///< of the variant
  std::vector<ReceiverTexture> textures;
  std::function<void(gl::Program&, gl::Context&)> setUniforms;
  /// Uniforms that differ from receiver to receiver; may be empty.
  std::function<void(gl::Program&, gl::Context&, const DrawItem&)> setItemUniforms;
  glm::dmat4 mapFromWorld{
      1.0};  ///< world -> (s·z, t·z, d·z, z); screen-space techniques use z alone, or none
  FilterSkip skip = FilterSkip::none;
  bool usesFacetPlane = false;  ///< receiver-plane bias: by facet stream or by derivatives, per mesh
  /// Receivers compiled with HS_CASTING_RECEIVER: means over regions of the map would mislead them.
  enum class SelfReceivers { none, casting, all } selfReceivers = SelfReceivers::none;
  /// With SelfReceivers::casting, receivers of these meshes too, though they cast nothing themselves.
  std::vector<const GpuMesh*> alsoCasting;
  bool forward = true;  ///< may be evaluated inside a host's own fragment shader
};

/// Another technique that takes a light where this one would draw it wrong.
struct StandIn {
  std::string id;      ///< one that needs no capability and has no stand-in itself
  std::string reason;  ///< what about the light or its casters asks for it, for the frame's report
};

class Technique {
 public:
  virtual ~Technique() = default;
  virtual const TechniqueInfo& info() const = 0;
  virtual std::vector<SettingInfo> settings() const { return {}; }
  virtual Support support(const gl::Capabilities& capabilities) const {
    (void)capabilities;
    return {};
  }
  /// Asked each frame before `declare`, about geometry alone. Lights whose visibility a host evaluates itself
  /// keep their technique, since a stand-in may work on the screen only.
  virtual std::optional<StandIn> standIn(const LightFrame& frame) const {
    (void)frame;
    return std::nullopt;
  }
  /// Adds light, mask and screen passes to the graph and says how receivers consume them.
  virtual Result<ReceiverShading> declare(const LightFrame& frame) = 0;
  /// The context is gone: forget all GL objects.
  virtual void contextLost() {}
};

}  // namespace halfshadow::techniques
