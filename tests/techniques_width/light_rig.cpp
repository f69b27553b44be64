// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "light_rig.hpp"

#include <algorithm>

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
  shape_ = {.pointsWorld = points_};
  const planner::LightFit fit = planner::fitLight(light_, {&shape_, 1}, {.mapSize = mapSize});
  scene_ = std::make_unique<techniques::LightScene>(
      techniques::LightScene{.capabilities = context.capabilities(),
                             .settings = settings_,
                             .screen = view_,
                             .name = "light 0",
                             .light = light_,
                             .center = {.fit = fit, .casters = casters_, .contentKey = 1, .sceneKey = 1},
                             .casterShapes = {&shape_, 1},
                             .receiverFarDistance = 1.3 * farthest,
                             .casters = casters_,
                             .groups = groups_,
                             .silhouettes = silhouettes_,
                             .contentKey = 1,
                             .sceneKey = 1});
}

namespace {
class BuildPlanner final : public techniques::LightPlanner {
 public:
  explicit BuildPlanner(const LightRig::Build& build) : build_(build) {}
  Status plan(const techniques::LightScene& scene, techniques::PassPlan& plan) override {
    plan.shading.textures = {{.sampler = "u_result", .resource = build_(scene, plan)}};
    return {};
  }

 private:
  const LightRig::Build& build_;
};
}  // namespace

framegraph::ResourceId imageNamed(const techniques::PassPlan& plan, const std::string& name) {
  const auto found = std::ranges::find(plan.images, name, &framegraph::ResourceDesc::name);
  EXPECT_NE(found, plan.images.end()) << name;
  return {static_cast<std::uint32_t>(found - plan.images.begin())};
}

std::vector<std::uint8_t> LightRig::run(const Build& build) {
  techniques::LightPasses passes(std::make_unique<BuildPlanner>(build));
  techniques::Device device{context_, programs_, shared_};
  Status status = passes.prepare(*scene_);
  if (status) status = passes.upload(device);
  EXPECT_TRUE(status) << status.error().message;
  if (!status) return {};
  framegraph::Graph graph;
  techniques::FramePasses frame{view_, graph};
  const framegraph::ResourceId resource = passes.declare(frame).textures[0].resource;
  graph.markOutput(resource);
  const framegraph::ResourceDesc& desc = graph.resources()[resource.index];
  std::vector<std::uint8_t> pixels(static_cast<std::size_t>(desc.width) *
                                   static_cast<std::size_t>(desc.height) * 4);
  const auto plan = framegraph::compile(
      graph, [this](const framegraph::ResourceDesc& held) { return executor_->contentKeyOf(held); });
  EXPECT_TRUE(plan) << plan.error().message;
  if (!plan) return pixels;
  encoder_.beginFrame();
  const auto reports = executor_->run(graph, *plan, encoder_, framegraph::PassTiming::off);
  EXPECT_TRUE(reports) << reports.error().message;
  const gl::Framebuffer* framebuffer = executor_->framebufferFor(graph, resource);
  EXPECT_NE(framebuffer, nullptr);
  if (framebuffer) encoder_.readPixels(*framebuffer, {0, 0, desc.width, desc.height}, pixels.data());
  return pixels;
}

}  // namespace halfshadow::test
