// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "techniques/execution/receiver_pass.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <glm/gtc/matrix_inverse.hpp>

#include "base/keys.hpp"
#include "techniques/execution/gpu_mesh.hpp"

namespace halfshadow::techniques {
namespace {

/// The largest of its colour's components below which the sky shows in a surface; as in shade.glsl.
constexpr float kDark = 0.25f;

std::vector<std::string> outputDefines(const ReceiverRequest& request, const ReceiverKind& kind) {
  switch (request.output) {
    case ReceiverOutput::visibility:
      return {};
    case ReceiverOutput::visibility16:
      return {"HS_VISIBILITY_16"};
    case ReceiverOutput::taps:
      return {"HS_COUNT_TAPS"};
    case ReceiverOutput::shaded:
      break;
  }
  std::vector<std::string> defines{"HS_SHADED"};
  if (kind.textured) defines.emplace_back("HS_BASE_COLOR_TEXTURE");
  if (kind.dark) defines.emplace_back("HS_DARK");
  if (kind.behind) defines.emplace_back("HS_LIGHT_BEHIND");
  const auto anyLight = [&](double scene::AreaLight::*length) {
    return std::ranges::any_of(request.lights,
                               [&](const scene::AreaLight& light) { return light.*length > 0.0; });
  };
  if (anyLight(&scene::AreaLight::outerConeRadians)) defines.emplace_back("HS_LIGHT_CONES");
  if (anyLight(&scene::AreaLight::referenceDistance)) defines.emplace_back("HS_LIGHT_FADES");
  return defines;
}

void bindTextures(framegraph::PassContext& context, gl::Program& program, const ReceiverShading& shading) {
  std::vector<gl::TextureBinding> bindings;
  for (const TextureRead& texture : shading.textures) {
    const int unit = program.samplerUnit(texture.sampler);
    if (unit < 0) continue;
    bindings.push_back({unit, texture.texture ? texture.texture : &context.texture(texture.resource)});
  }
  context.encoder.bindTextures(bindings);
}

/// The light's own plane, where it ends, counts as behind it: sums of products there are rounding.
bool reachesBehind(const DrawItem& item, const scene::AreaLight& light) {
  constexpr double kRounding = 1e-3;
  return std::ranges::any_of(item.boundsWorld.corners(), [&](const glm::dvec3& corner) {
    const glm::dvec3 fromLight = corner - light.centerWorld;
    return !(glm::dot(light.emission, fromLight) > kRounding * glm::length(fromLight));
  });
}

/// The facet stream has no smooth normals and no texture coordinates, so shading takes it only where there
/// are no derivatives to replace it.
ReceiverKind kindOf(const ReceiverShading& shading, const DrawItem& item,
                    std::span<const scene::AreaLight> shadedBy, bool derivatives) {
  const bool shaded = !shadedBy.empty();
  const bool oneColor = item.baseColorTexture == nullptr && !item.vertexColors;
  const float brightest = std::max(std::max(item.baseColor.r, item.baseColor.g), item.baseColor.b);
  const bool casting =
      shading.selfReceivers == ReceiverShading::SelfReceivers::all ||
      (shading.selfReceivers == ReceiverShading::SelfReceivers::casting &&
       (item.casts || std::ranges::find(shading.alsoCasting, item.object) != shading.alsoCasting.end()));
  const bool needsPlane = shading.usesFacetPlane && !(casting && !shading.castingFile.empty());
  return {.facets = needsPlane && item.mesh->hasFacetStream() && !(shaded && derivatives),
          .textured = shaded && item.baseColorTexture != nullptr,
          .casting = casting,
          .cut = item.alphaMask != nullptr,
          .colored = item.vertexColors && (shaded || item.alphaMask != nullptr),
          .dark = shaded && oneColor && brightest < kDark,
          .behind = std::ranges::any_of(
              shadedBy, [&](const auto& light) { return reachesBehind(item, light); })};
}

void setMapUniforms(gl::Context& gl, gl::Program& program, const ReceiverShading& shading,
                    const glm::dmat4& worldFromObject, bool facets) {
  const glm::dmat4 mapFromObject = shading.mapFromWorld * worldFromObject;
  program.set(gl, "u_mapFromObject", glm::mat4(mapFromObject));
  if (facets) {
    // Rows s·z, t·z and z of the map are the space in which the facet's plane is taken.
    glm::dmat3 planeFromObject(0.0);
    for (int column = 0; column < 3; ++column) {
      planeFromObject[column] =
          glm::dvec3(mapFromObject[column][0], mapFromObject[column][1], mapFromObject[column][3]);
    }
    glm::dmat3 normalMatrix = glm::inverseTranspose(planeFromObject);
    // Only the direction matters; unit scale keeps fp32 (and mediump varyings) in range for tiny worlds.
    double largest = 0.0;
    for (int i = 0; i < 9; ++i) largest = std::max(largest, std::abs(normalMatrix[i / 3][i % 3]));
    program.set(gl, "u_mapNormalFromObject", glm::mat3(normalMatrix / std::max(largest, 1e-300)));
  }
}

void setObjectUniforms(gl::Context& gl, gl::Program& program, const ReceiverShading& shading,
                       const View& view, const DrawItem& item, bool facets, const ShadingInputs* inputs,
                       device::UniformList& ofItem) {
  program.set(gl, "u_clipFromObject", glm::mat4(view.clipFromWorld * item.worldFromObject));
  setMapUniforms(gl, program, shading, item.worldFromObject, facets);
  if (shading.itemUniforms) {
    ofItem.clear();
    shading.itemUniforms(item, ofItem);
    program.set(gl, ofItem);
  }
  if (inputs == nullptr) return;
  glm::dmat4 relative = item.worldFromObject;
  relative[3] -= glm::dvec4(inputs->lights.front().centerWorld, 0.0);
  for (int column = 0; column < 4; ++column) {
    for (int row = 0; row < 3; ++row) relative[column][row] *= inputs->scale;
  }
  program.set(gl, "u_shadeFromObject", glm::mat4(relative));
  program.set(gl, "u_worldNormalFromObject",
              glm::mat3(glm::inverseTranspose(glm::dmat3(item.worldFromObject))));
  program.set(gl, "u_baseColor", item.baseColor);
}

/// Slope and offset of what the cone lets through, over the cosine to its axis; squared by the shader.
/// Based on: KHR_lights_punctual, inner and outer cone angles.
glm::vec2 coneEdge(const scene::AreaLight& light) {
  if (!(light.outerConeRadians > 0.0)) return {0.0f, 1.0f};
  const double outer = std::cos(light.outerConeRadians);
  const double slope = 1.0 / std::max(1e-3, std::cos(light.innerConeRadians) - outer);
  return {slope, -outer * slope};
}

glm::dvec3 within(const glm::dvec3& place, double distance) {
  const double length = glm::length(place);
  return length > distance ? place * (distance / length) : place;
}

void setFrameUniforms(gl::Context& gl, gl::Program& program, const ReceiverShading& shading, const View& view,
                      const gl::Rect& viewport, const ShadingInputs* inputs) {
  program.set(gl, shading.uniforms);
  const glm::vec2 scale(1.0f / static_cast<float>(viewport.width),
                        1.0f / static_cast<float>(viewport.height));
  program.set(gl, "u_viewport", glm::vec4(scale, -scale * glm::vec2(viewport.x, viewport.y)));
  if (inputs == nullptr) return;
  const glm::dvec3 origin = inputs->lights.front().centerWorld;
  glm::vec4 position[4] = {}, emission[4] = {}, color[4] = {};
  for (std::size_t i = 0; i < 4; ++i) {
    if (i >= inputs->lights.size()) continue;
    const scene::AreaLight& light = inputs->lights[i];
    // Beyond that the falloff is at its limit everywhere.
    constexpr double kMostReference = 1024.0;
    const double reference = std::min(light.referenceDistance * inputs->scale, kMostReference);
    constexpr double kDiffuse = 0.85;
    position[i] = glm::vec4(glm::vec3((light.centerWorld - origin) * inputs->scale), reference);
    const glm::vec2 cone = coneEdge(light);
    emission[i] = glm::vec4(glm::vec3(light.emission), cone.x);
    color[i] = glm::vec4(light.color * static_cast<float>(kDiffuse * light.intensity), cone.y);
  }
  program.setArray(gl, "u_lightPosition", position, 4);
  program.setArray(gl, "u_lightEmission", emission, 4);
  program.setArray(gl, "u_lightColor", color, 4);
  program.set(
      gl, "u_eye",
      glm::vec4(glm::vec3(within((view.eyeWorld - origin) * inputs->scale, inputs->farthestEye)), 0.0f));
}

}  // namespace

ShadingInputs shadingInputs(std::span<const scene::AreaLight> lights, bool apart,
                            std::span<const DrawItem> receivers, const device::Capabilities& capabilities) {
  // Up to a light that is far from the others, numbers of fp16 have room for; a single one is at the origin.
  const double reach = apart ? 1.0 : 128.0;
  // From farther off everything is seen from one direction, and its square root overflows.
  constexpr double kMostOfHalf = 16384.0;
  ShadingInputs inputs{.lights = lights, .scale = reach * shadingScale(lights.front(), receivers)};
  if (!capabilities.has(device::Capability::highp)) inputs.farthestEye = kMostOfHalf;
  return inputs;
}

double shadingScale(const scene::AreaLight& first, std::span<const DrawItem> receivers) {
  double farthest = 0.0;
  for (const DrawItem& item : receivers) {
    const glm::dvec3 reach = glm::max(glm::abs(item.boundsWorld.low - first.centerWorld),
                                      glm::abs(item.boundsWorld.high - first.centerWorld));
    farthest = std::max(farthest, glm::length(reach));
  }
  return farthest > 0.0 ? std::exp2(-std::ceil(std::log2(farthest))) : 1.0;
}

void bindAlphaMask(gl::Encoder& encoder, gl::Program& program, const DrawItem& item) {
  const gl::TextureBinding binding{program.samplerUnit("u_alphaMask"), item.alphaMask};
  encoder.bindTextures({&binding, 1});
  program.set(encoder.context(), "u_alphaCutoff", item.alphaCutoff);
}

ReceiverShading shadeFromScreen(framegraph::ResourceId visibility) {
  ReceiverShading shading;
  shading.fragmentFile = "receiver/shade_lights.frag";
  shading.forward = false;
  shading.textures = {{.sampler = "u_visibility", .resource = visibility}};
  return shading;
}

std::vector<framegraph::ResourceId> resourcesRead(const ReceiverShading& shading) {
  std::vector<framegraph::ResourceId> resources;
  for (const TextureRead& texture : shading.textures) {
    if (texture.texture == nullptr) resources.push_back(texture.resource);
  }
  return resources;
}

namespace {
bool inTwoDraws(const ReceiverShading& shading, const ReceiverRequest& request) {
  return shading.skip == FilterSkip::stencil && request.output != ReceiverOutput::taps;
}

Result<ReceiverPrograms> linkPrograms(gl::ProgramCache& programs, const ReceiverShading& shading,
                                      const ReceiverRequest& request, const ReceiverKind& kind) {
  ReceiverPrograms result;
  const bool byAnother = kind.casting && !shading.castingFile.empty();
  std::vector<std::string> defines = byAnother ? std::vector<std::string>() : shading.defines;
  if (kind.facets) defines.push_back("HS_FACET_NORMAL");
  if (kind.casting && !byAnother) defines.push_back("HS_CASTING_RECEIVER");
  if (kind.cut) defines.push_back("HS_ALPHA_MASK");
  if (kind.colored) defines.push_back("HS_VERTEX_COLORS");
  for (std::string& define : outputDefines(request, kind)) defines.push_back(std::move(define));
  const auto link = [&](std::initializer_list<const char*> extra, gl::Program*& program) -> Status {
    auto variant = defines;
    variant.insert(variant.end(), extra.begin(), extra.end());
    auto linked = programs.get(
        {"receiver/receiver.vert", byAnother ? shading.castingFile : shading.fragmentFile, variant});
    if (!linked) return linked.error();
    program = *linked;
    return {};
  };
  // Casting receivers are not classified: see drawReceivers().
  if (byAnother && inTwoDraws(shading, request)) {
    if (Status s = link({}, result.filter); !s) return s.error();
    return result;
  }
  // Tap counts must be those of the two draws together, so the count variant evaluates them in one.
  if (inTwoDraws(shading, request)) {
    if (Status s = link({"HS_PHASE_CLASSIFY"}, result.classify); !s) return s.error();
    // Equal depths pass, whatever the first draw decided: where the depths are complete the second decides
    // anew.
    const bool classified = shading.filterTrustsClasses && !kind.casting && !request.depthIsComplete;
    const Status s = classified ? link({"HS_PHASE_FILTER", "HS_CLASSIFIED"}, result.filter)
                                : link({"HS_PHASE_FILTER"}, result.filter);
    if (!s) return s.error();
  } else {
    if (Status s = link({}, result.whole); !s) return s.error();
  }
  return result;
}
}  // namespace

Result<ReceiverProgramSet> receiverPrograms(gl::ProgramCache& programs, const ReceiverShading& shading,
                                            const ReceiverRequest& request, std::span<const DrawItem> items) {
  ReceiverProgramSet set;
  set.twoDraws = inTwoDraws(shading, request);
  const bool derivatives = programs.capabilities().has(device::Capability::derivatives);
  const auto shadedBy =
      request.output == ReceiverOutput::shaded ? request.lights : std::span<const scene::AreaLight>();
  for (const DrawItem& item : items) {
    const ReceiverKind kind = kindOf(shading, item, shadedBy, derivatives);
    ReceiverPrograms& slot = set.of(kind);
    if (slot.whole || slot.filter) continue;
    auto linked = linkPrograms(programs, shading, request, kind);
    if (!linked) return linked.error();
    slot = *linked;
  }
  return set;
}

gl::DrawState receiverState(const ReceiverTarget& target) {
  gl::DrawState state;
  state.depth = {.test = target.depthIsComplete ? gl::Compare::equal : gl::Compare::less,
                 .write = !target.depthIsComplete};
  state.colorMask = target.colorMask;
  if (target.additive) {
    state.blend = {.enabled = true, .source = gl::BlendFactor::one, .destination = gl::BlendFactor::one};
  }
  return state;
}

namespace {
/// Depth ranges of one length that begin a step of the depth buffer apart. Not a polygon offset: drivers
/// compile that into their own programs (llvmpipe keeps 64 of them, and compiled them anew with every
/// object).
glm::vec2 depthRangeApart(std::ptrdiff_t place, const device::Capabilities& capabilities) {
  // Too few to bring anything forward that is not in the same place.
  constexpr std::ptrdiff_t kMostSteps = 64;
  // Twice what a buffer of 24 or 16 bits resolves: ranges are rounded to it on the way.
  const float step = std::ldexp(1.0f, capabilities.has(device::Capability::depth24) ? -23 : -15);
  const auto steps = static_cast<float>(place % kMostSteps);
  return {steps * step, 1.0f - (static_cast<float>(kMostSteps - 1) - steps) * step};
}
}  // namespace

void drawReceivers(framegraph::PassContext& context, const ReceiverShading& shading,
                   const ReceiverProgramSet& programs, const View& view, std::span<const DrawItem> items,
                   const ShadingInputs* inputs, const ReceiverTarget& target) {
  gl::Encoder& encoder = context.encoder;
  const bool derivatives = encoder.context().capabilities().has(device::Capability::derivatives);
  gl::DrawState state = receiverState(target);
  gl::Program* current = nullptr;
  device::UniformList ofItem;
  const auto shadedBy = inputs == nullptr ? std::span<const scene::AreaLight>() : inputs->lights;
  const auto draw = [&](const DrawItem& item, gl::Program* ReceiverPrograms::*phase) {
    if (target.depthsApart) {
      state.depthRange = depthRangeApart(&item - items.data(), encoder.context().capabilities());
    }
    const ReceiverKind kind = kindOf(shading, item, shadedBy, derivatives);
    gl::Program* program = programs.of(kind).*phase;
    if (program != current) {
      current = program;
      encoder.useProgram(*program);
      setFrameUniforms(encoder.context(), *program, shading, view, context.viewport, inputs);
      bindTextures(context, *program, shading);
    }
    if (kind.textured) {
      const gl::TextureBinding binding{program->samplerUnit("u_baseColorTexture"), item.baseColorTexture};
      encoder.bindTextures({&binding, 1});
    }
    if (kind.cut) bindAlphaMask(encoder, *program, item);
    setObjectUniforms(encoder.context(), *program, shading, view, item, kind.facets, inputs, ofItem);
    state.cull = unseenFaces(item, view.eyeWorld, view.nearReach);
    item.mesh->draw(encoder, state,
                    kind.facets ? GpuMesh::Streams::facet
                    : inputs    ? GpuMesh::Streams::shading
                                : GpuMesh::Streams::positions,
                    kind.cut ? MeshExtras::alpha : MeshExtras::none);
  };
  if (!programs.twoDraws) {
    for (const DrawItem& item : items) draw(item, &ReceiverPrograms::whole);
    return;
  }
  // Casters are their own neighbours in the map, so the mask leaves nearly all their pixels to the filter:
  // they are filtered at once and cover what lies behind them. Receivers that cast nothing are drawn twice:
  // pixels that the mask decides write colour and depth; the second draw fails the depth test there and
  // filters the rest.
  for (const DrawItem& item : items) {
    if (item.casts) draw(item, &ReceiverPrograms::filter);
  }
  for (const DrawItem& item : items) {
    if (!item.casts) draw(item, &ReceiverPrograms::classify);
  }
  for (const DrawItem& item : items) {
    if (!item.casts) draw(item, &ReceiverPrograms::filter);
  }
}

ForwardVariant forwardVariant(const ReceiverShading& shading) {
  ForwardVariant variant{.fragmentFile = shading.fragmentFile,
                         .defines = shading.defines,
                         .usesFacetPlane = shading.usesFacetPlane};
  const auto hashed = [](std::string_view text) {
    std::uint64_t key = 0xcbf29ce484222325ull;  // as good as any
    for (const char c : text) key = combineKeys(key, static_cast<std::uint8_t>(c));
    return key;
  };
  variant.key = combineKeys(hashed(shading.fragmentFile), shading.usesFacetPlane ? 1 : 2);
  for (const std::string& define : shading.defines) variant.key = combineKeys(variant.key, hashed(define));
  for (const TextureRead& texture : shading.textures) variant.samplers.push_back(texture.sampler);
  if (variant.key == 0) variant.key = 1;
  return variant;
}

Result<ForwardTexts> forwardTexts(const gl::ProgramCache& programs, const ForwardVariant& variant) {
  std::vector<std::string> defines = variant.defines;
  defines.push_back("HS_FORWARD");
  if (variant.usesFacetPlane && needsFacetStream(programs.capabilities()))
    defines.push_back("HS_FACET_NORMAL");
  auto sources = programs.assemble({"receiver/forward.vert", variant.fragmentFile, std::move(defines)});
  if (!sources) return sources.error();
  const auto withoutVersion = [](const std::string& text) { return text.substr(text.find('\n') + 1); };
  char key[24];
  std::snprintf(key, sizeof key, "%016llx", static_cast<unsigned long long>(variant.key));
  const std::string lit = std::string(gl::Program::kTextKeyPrefix) + key;
  // The maximum, beside the choice, keeps the uniform where the technique's function is a constant.
  return ForwardTexts{withoutVersion(sources->vertex),
                      "#define halfshadow_visibility hs_techniqueVisibility\n" +
                          withoutVersion(sources->fragment) +
                          "#undef halfshadow_visibility\nuniform mediump float " + lit +
                          ";\nfloat halfshadow_visibility() {\n  float seen = hs_techniqueVisibility();\n"
                          "  return max(" +
                          lit + " > 0.5 ? 1.0 : seen, " + lit + ");\n}\n"};
}

void bindForward(gl::Context& context, gl::Program& program, const ReceiverShading& shading,
                 const ForwardBinding& binding) {
  program.setTextKeyUniform(context, 0.0f);
  program.set(context, shading.uniforms);
  setMapUniforms(context, program, shading, binding.worldFromObject,
                 needsFacetStream(context.capabilities()));
  int unit = binding.firstTextureUnit;
  for (const TextureRead& texture : shading.textures) {
    const gl::Texture* read =
        texture.texture ? texture.texture : binding.executor.texture(binding.graph, texture.resource);
    if (!program.has(texture.sampler) || read == nullptr) continue;
    std::uint32_t& known = binding.bound[static_cast<std::size_t>(unit) % binding.bound.size()];
    if (known != read->name()) read->bind(context, unit);
    known = read->name();
    program.setSampler(context, texture.sampler, unit++);
  }
}

void bindForwardLit(gl::Context& context, gl::Program& program, const ForwardVariant& variant,
                    int firstTextureUnit) {
  program.setTextKeyUniform(context, 1.0f);
  // Samplers of unlike types may not share a unit, though nothing is read from it.
  int unit = firstTextureUnit;
  for (const device::UniformKey sampler : variant.samplers) {
    if (program.has(sampler)) program.setSampler(context, sampler, unit++);
  }
}

}  // namespace halfshadow::techniques
