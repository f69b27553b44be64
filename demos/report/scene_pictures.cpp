// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "report/scene_pictures.hpp"

#include "report/html.hpp"

namespace halfshadow::report {

std::string describeScene(const scene::SceneDescription& scene) {
  std::uint64_t triangles = 0;
  for (const scene::SceneObject& object : scene.objects) triangles += object.mesh->triangleCount();
  std::string text = counted(scene.objects.size()) +
                     (scene.objects.size() == 1 ? " object, " : " objects, ") + counted(triangles) +
                     " triangles; ";
  if (!scene.lights.empty()) {
    const scene::AreaLight& light = scene.lights.front();
    const scene::Bounds casters = scene::boundsWorld(scene, scene::ObjectFilter::casters);
    text += "light " + threeDigits(2.0 * glm::length(light.halfU)) + " × " +
            threeDigits(2.0 * glm::length(light.halfV)) + ", " +
            threeDigits(glm::length(light.centerWorld - casters.center())) + " from the casters' middle.";
  }
  return text;
}

Result<measure::RgbaImage> renderShaded(measure::EngineSession& session, const scene::SceneDescription& scene,
                                        const measure::Configuration& configuration, int width, int height) {
  if (Status status = session.renewEngine(); !status) return status.error();
  if (Status status = session.choose(configuration.technique, configuration.settings); !status)
    return status.error();
  if (Status status = session.load(scene); !status) return status.error();
  RenderDesc desc;
  desc.camera = measure::cameraDesc(*scene.camera);
  desc.target = {.width = width, .height = height};
  FrameReport ignored;
  if (Status status = session.render(desc, ignored); !status) return status.error();
  return session.read(width, height);
}

}  // namespace halfshadow::report
