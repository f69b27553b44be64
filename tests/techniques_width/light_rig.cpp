// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "light_rig.hpp"

#include "gl/embedded_shaders.hpp"
#include "scenes/scene_source.hpp"

namespace halfshadow::test {

scene::SceneDescription openBuiltin(const std::string& name) {
  auto scene = scenes::openScene("builtin:" + name, {});
  EXPECT_TRUE(scene) << scene.error().message;
  return scene ? *scene : scene::SceneDescription{};
}

LightRig::LightRig(gl::Context& context, const scene::SceneDescription& scene, int mapSize)
    : context_(context),
      programs_(context, gl::embeddedShader),
      settings_(techniques::allSettings(techniques::makeAllTechniques())),
      light_(scene.lights.front()),
      encoder_(context),
      executor_(std::make_unique<framegraph::Executor>(context)) {
  meshes_.reserve(scene.objects.size());
  double farthest = 0.0;
  for (const scene::SceneObject& object : scene.objects) {
    if (!object.casts) continue;
    auto mesh = techniques::GpuMesh::create(context, *object.mesh);
    EXPECT_TRUE(mesh) << mesh.error().message;
    meshes_.push_back(std::move(mesh).value());
    casters_.push_back({.mesh = &meshes_.back(), .worldFromObject = object.worldFromObject});
    for (const auto& position : object.mesh->positions) {
      points_.push_back(glm::dvec3(object.worldFromObject * glm::dvec4(glm::dvec3(position), 1.0)));
      farthest = std::max(farthest, glm::dot(points_.back() - light_.centerWorld, light_.emission));
    }
  }
  const planner::LightFit fit = planner::fitLight(light_, points_, {.mapSize = mapSize});
  frame_ =
      std::make_unique<techniques::LightFrame>(techniques::LightFrame{.capabilities = context.capabilities(),
                                                                      .context = context,
                                                                      .programs = programs_,
                                                                      .shared = shared_,
                                                                      .settings = settings_,
                                                                      .graph = graph_,
                                                                      .view = view_,
                                                                      .light = light_,
                                                                      .fit = fit,
                                                                      .casterPointsWorld = points_,
                                                                      .receiverFarDistance = 1.3 * farthest,
                                                                      .casters = casters_,
                                                                      .groups = groups_,
                                                                      .contentKey = 1,
                                                                      .sceneKey = 1});
}

std::vector<std::uint8_t> LightRig::run(framegraph::ResourceId resource) {
  graph_.markOutput(resource);
  const framegraph::ResourceDesc& desc = graph_.resources()[resource.index];
  std::vector<std::uint8_t> pixels(static_cast<std::size_t>(desc.width) *
                                   static_cast<std::size_t>(desc.height) * 4);
  const auto plan = framegraph::compile(
      graph_, [this](const framegraph::ResourceDesc& held) { return executor_->contentKeyOf(held); });
  EXPECT_TRUE(plan) << plan.error().message;
  if (!plan) return pixels;
  encoder_.beginFrame();
  const auto reports = executor_->run(graph_, *plan, encoder_, framegraph::PassTiming::off);
  EXPECT_TRUE(reports) << reports.error().message;
  const gl::Framebuffer* framebuffer = executor_->framebufferFor(graph_, resource);
  EXPECT_NE(framebuffer, nullptr);
  if (framebuffer) encoder_.readPixels(*framebuffer, {0, 0, desc.width, desc.height}, pixels.data());
  return pixels;
}

}  // namespace halfshadow::test
