// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "scenes/gltf_loader.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <glm/ext/matrix_transform.hpp>
#include <map>
#include <optional>
#include <tuple>
#include <utility>

#include "scenes/gltf_geometry.hpp"
#include "scenes/gltf_materials.hpp"
#include "scenes/gltf_pose.hpp"

namespace halfshadow::scenes {
namespace {
using scene::SceneDescription;
using scene::SceneObject;

/// A light before the bounds are known, which directional lights are placed by.
struct PendingLight {
  std::size_t node = 0;
  const tinygltf::Light* source = nullptr;
  double width = 0.0, height = 0.0;
};

std::string label(const char* kind, std::size_t index, const std::string& name) {
  return std::string(kind) + " " + std::to_string(index) + (name.empty() ? "" : " '" + name + "'");
}

/// extras.halfshadow, or null.
const tinygltf::Value* ownExtras(const tinygltf::Value& extras) {
  if (!extras.IsObject() || !extras.Has("halfshadow")) return nullptr;
  const tinygltf::Value& own = extras.Get("halfshadow");
  return own.IsObject() ? &own : nullptr;
}

class GltfSceneBuilder {
 public:
  GltfSceneBuilder(tinygltf::Model& model, const GltfOptions& options) : model_(model), options_(options) {}

  Result<SceneDescription> build() {
    Result<Pose> pose = poseOf(model_, options_, scene_.notes);
    if (!pose) return pose.error();
    pose_ = std::move(pose).value();
    materials_ = materialsOf(model_, scene_.notes);
    const Result<std::vector<std::size_t>> nodes = nodesOfScene();
    if (!nodes) return nodes.error();
    for (const std::size_t node : *nodes) {
      for (const auto step : {&GltfSceneBuilder::addMesh, &GltfSceneBuilder::addLight}) {
        if (Status status = (this->*step)(node); !status) return status.error();
      }
    }
    if (scene_.objects.empty()) {
      return Error{ErrorCode::emptyScene,
                   "it has no triangles to draw in its scene; export a mesh (points and lines are skipped)"};
    }
    for (const std::size_t node : *nodes) {
      if (Status status = addCamera(node); !status) return status.error();
    }
    if (Status status = finishLights(); !status) return status.error();
    return std::move(scene_);
  }

 private:
  /// Parents before children; the file's default scene, its first, or all nodes.
  Result<std::vector<std::size_t>> nodesOfScene() const {
    std::vector<std::size_t> nodes;
    std::vector<char> isTaken(model_.nodes.size());
    const auto take = [&](std::size_t node) {
      if (!std::exchange(isTaken[node], true)) nodes.push_back(node);
    };
    const int chosen = model_.defaultScene >= 0 ? model_.defaultScene : model_.scenes.empty() ? -1 : 0;
    if (chosen >= static_cast<int>(model_.scenes.size())) {
      return malformed("its default scene " + std::to_string(chosen) + " does not exist");
    }
    if (chosen < 0) {
      for (std::size_t i = 0; i < model_.nodes.size(); ++i) {
        if (pose_.parent[i] < 0) take(i);
      }
    } else {
      for (const int root : model_.scenes[chosen].nodes) {
        if (root < 0 || static_cast<std::size_t>(root) >= model_.nodes.size()) {
          return malformed("scene " + std::to_string(chosen) + " names node " + std::to_string(root) +
                           ", which does not exist");
        }
        take(static_cast<std::size_t>(root));
      }
    }
    for (std::size_t next = 0; next < nodes.size(); ++next) {
      for (const int child : model_.nodes[nodes[next]].children) take(static_cast<std::size_t>(child));
    }
    return nodes;
  }

  /// A flag of extras.halfshadow, from the node or the nearest ancestor that sets it; else true.
  bool flag(std::size_t node, const char* key) {
    for (int at = static_cast<int>(node); at >= 0; at = pose_.parent[at]) {
      const tinygltf::Value* own = ownExtras(model_.nodes[at].extras);
      if (own == nullptr || !own->Has(key)) continue;
      if (own->Get(key).IsBool()) return own->Get(key).Get<bool>();
      scene_.notes.push_back("extras.halfshadow." + std::string(key) + " of node " + std::to_string(at) +
                             " is neither true nor false and was ignored");
    }
    return true;
  }

  Status addMesh(std::size_t nodeIndex) {
    const tinygltf::Node& node = model_.nodes[nodeIndex];
    if (node.mesh == -1) return {};
    const std::string what = label("node", nodeIndex, node.name);
    if (node.mesh < 0 || static_cast<std::size_t>(node.mesh) >= model_.meshes.size()) {
      return malformed(what + " shows mesh " + std::to_string(node.mesh) + ", which does not exist");
    }
    if (pose_.isScaledToNothing[nodeIndex] && node.skin == -1) {
      scene_.notes.push_back(what + " is scaled to nothing and was skipped");
      return {};
    }
    PrimitiveRequest request{.mesh = node.mesh};
    std::vector<glm::dmat4> joints;
    glm::dmat4 worldFromObject = pose_.worldFromNode[nodeIndex];
    if (node.skin != -1) {
      Result<std::vector<glm::dmat4>> matrices = jointMatrices(model_, pose_, node.skin);
      if (!matrices) return matrices.error();
      joints = std::move(matrices).value();
      request.jointMatrices = &joints;
      worldFromObject = glm::dmat4(1.0);  // a skin's joints place it, not its node
    }
    if (!pose_.weights[nodeIndex].empty()) request.morphWeights = &pose_.weights[nodeIndex];
    const double determinant = glm::determinant(glm::dmat3(worldFromObject));
    if (determinant == 0.0)
      return malformed(what + " has a singular transform; give it three independent axes");
    request.isMirrored = determinant < 0.0;
    if (request.isMirrored)
      worldFromObject = worldFromObject * glm::scale(glm::dmat4(1.0), glm::dvec3(-1, 1, 1));

    const std::size_t count = model_.meshes[node.mesh].primitives.size();
    glm::dvec3 center(0.0);
    for (request.primitive = 0; request.primitive < count; ++request.primitive) {
      const Result<PrimitiveMesh> made = meshFor(request);
      if (!made) return made.error();
      if (made->mesh == nullptr) continue;
      if (request.jointMatrices != nullptr && request.centerWorld == nullptr) {
        center = made->centerWorld;
        request.centerWorld = &center;
        worldFromObject = glm::translate(worldFromObject, center);
      }
      if (Status status = addObject(nodeIndex, request, made->mesh, worldFromObject); !status) return status;
    }
    return {};
  }

  Status addObject(std::size_t nodeIndex, const PrimitiveRequest& request,
                   std::shared_ptr<const scene::TriangleMesh> mesh, const glm::dmat4& worldFromObject) {
    const tinygltf::Mesh& source = model_.meshes[request.mesh];
    const int material = source.primitives[request.primitive].material;
    SceneObject object{
        .name = model_.nodes[nodeIndex].name, .mesh = std::move(mesh), .worldFromObject = worldFromObject};
    if (object.name.empty()) object.name = source.name.empty() ? label("node", nodeIndex, "") : source.name;
    if (source.primitives.size() > 1) object.name += "#" + std::to_string(request.primitive);
    if (material >= static_cast<int>(materials_.size()) || material < -1) {
      return malformed("primitive " + std::to_string(request.primitive) + " of mesh " +
                       std::to_string(request.mesh) + " has material " + std::to_string(material) +
                       ", which does not exist");
    }
    if (material >= 0) object.material = materials_[material];
    if (object.mesh->texcoords.empty()) object.material.baseColorImage = nullptr;
    object.casts = flag(nodeIndex, "casts");
    object.receives = flag(nodeIndex, "receives");
    scene_.objects.push_back(std::move(object));
    return {};
  }

  /// Nodes that show the same mesh undeformed share it.
  Result<PrimitiveMesh> meshFor(const PrimitiveRequest& request) {
    const bool isShared = request.jointMatrices == nullptr && request.morphWeights == nullptr;
    const auto key = std::make_tuple(request.mesh, request.primitive, request.isMirrored);
    if (const auto found = sharedMeshes_.find(key); isShared && found != sharedMeshes_.end())
      return PrimitiveMesh{found->second};
    auto made = primitiveMesh(model_, request, scene_.notes);
    if (made && isShared) sharedMeshes_[key] = made->mesh;
    return made;
  }

  Status addCamera(std::size_t nodeIndex) {
    const int index = model_.nodes[nodeIndex].camera;
    if (index == -1) return {};
    if (index < 0 || static_cast<std::size_t>(index) >= model_.cameras.size()) {
      return malformed(label("node", nodeIndex, model_.nodes[nodeIndex].name) + " uses camera " +
                       std::to_string(index) + ", which does not exist");
    }
    const tinygltf::Camera& source = model_.cameras[index];
    const std::string what = label("camera", static_cast<std::size_t>(index), source.name);
    if (scene_.camera || source.type != "perspective") {
      scene_.notes.push_back(what + (scene_.camera ? " was skipped: only the first one is used"
                                                   : " is not a perspective camera and was skipped"));
      return {};
    }
    const glm::dmat4& world = pose_.worldFromNode[nodeIndex];
    const glm::dvec3 eye(world[3]), backward(world[2]), up(world[1]);
    if (!(glm::length(backward) > 0.0 && glm::length(up) > 0.0)) {
      scene_.notes.push_back(what + " is scaled to nothing and was skipped");
      return {};
    }
    const scene::Bounds bounds = scene::boundsWorld(scene_, scene::ObjectFilter::all);
    const double distance = std::max(glm::length(bounds.center() - eye), 1e-3 * bounds.radius());
    scene_.camera = scene::Camera{.eyeWorld = eye,
                                  .targetWorld = eye - glm::normalize(backward) * distance,
                                  .up = glm::normalize(up),
                                  .verticalFovRadians = source.perspective.yfov};
    scene_.camera->nearDistance = 1e-3 * distance;  // fitted to the scene by whoever completes it
    scene_.camera->farDistance = distance + 2.0 * bounds.radius();
    if (Status status = scene::checkCamera(*scene_.camera); !status) {
      return malformed(what + ": " + status.error().message);
    }
    return {};
  }

  Status addLight(std::size_t nodeIndex) {
    const auto& extensions = model_.nodes[nodeIndex].extensions;
    const auto found = extensions.find("KHR_lights_punctual");
    if (found == extensions.end()) return {};
    const std::string what = label("node", nodeIndex, model_.nodes[nodeIndex].name);
    const tinygltf::Value& extension = found->second;
    const int index = extension.IsObject() && extension.Has("light") && extension.Get("light").IsNumber()
                          ? extension.Get("light").GetNumberAsInt()
                          : -1;
    if (index < 0 || static_cast<std::size_t>(index) >= model_.lights.size()) {
      return malformed(what + " uses a light that does not exist; the file has " +
                       std::to_string(model_.lights.size()));
    }
    PendingLight light{.node = nodeIndex, .source = &model_.lights[index]};
    const tinygltf::Value* const places[] = {&model_.nodes[nodeIndex].extras, &light.source->extras};
    for (const tinygltf::Value* extras : places) {
      const tinygltf::Value* own = ownExtras(*extras);
      if (own == nullptr || !own->Has("size")) continue;
      if (!readSize(own->Get("size"), light)) {
        return malformed("extras.halfshadow.size of the light at " + what +
                         " must be one number or [width, height], both zero or both positive");
      }
      break;
    }
    lights_.push_back(light);
    return {};
  }

  static bool readSize(const tinygltf::Value& size, PendingLight& light) {
    if (size.IsNumber()) {
      light.width = light.height = size.GetNumberAsDouble();
    } else if (size.IsArray() && size.ArrayLen() == 2 && size.Get(0).IsNumber() && size.Get(1).IsNumber()) {
      light.width = size.Get(0).GetNumberAsDouble();
      light.height = size.Get(1).GetNumberAsDouble();
    } else {
      return false;
    }
    const bool areNumbers = std::isfinite(light.width) && std::isfinite(light.height);
    return areNumbers && ((light.width > 0 && light.height > 0) || (light.width == 0 && light.height == 0));
  }

  Status finishLights() {
    double brightest = 0.0;
    for (const PendingLight& light : lights_) brightest = std::max(brightest, light.source->intensity);
    const scene::Bounds bounds = scene::boundsWorld(scene_, scene::ObjectFilter::all);
    for (const PendingLight& pending : lights_) {
      const glm::dmat4& world = pose_.worldFromNode[pending.node];
      const std::string what = label("light at node", pending.node, model_.nodes[pending.node].name);
      const double length = glm::length(glm::dvec3(world[2]));
      if (!(length > 0.0)) {
        scene_.notes.push_back(what + " is scaled to nothing and was skipped");
        continue;
      }
      const glm::dvec3 aim = -glm::dvec3(world[2]) / length;
      const bool isDirectional = pending.source->type == "directional";
      const glm::dvec3 center =
          isDirectional ? bounds.center() - aim * (3.0 * bounds.radius()) : glm::dvec3(world[3]);
      // The aim is a unit vector: far from the origin a target one unit away would be rounding noise.
      const double reach = std::max(bounds.radius(), glm::length(center) * 1e-6 + 1e-6);
      Result<scene::AreaLight> light = scene::areaLightAimed(center, center + aim * reach, pending.width,
                                                             pending.height, glm::dvec3(world[1]));
      if (!light) return malformed(what + ": " + light.error().message);
      light->referenceDistance = 0.0;  // the file names no distance, and none may come from the bounds
      const std::vector<double>& color = pending.source->color;
      if (color.size() == 3) light->color = glm::vec3(color[0], color[1], color[2]);
      // Candela and lux do not compare with anything here: the brightest light counts as 1.
      light->intensity = brightest > 0.0 ? std::max(pending.source->intensity, 0.0) / brightest : 1.0;
      scene_.lights.push_back(*light);
    }
    return {};
  }

  tinygltf::Model& model_;
  const GltfOptions& options_;
  SceneDescription scene_;
  Pose pose_;
  std::vector<scene::Material> materials_;
  std::vector<PendingLight> lights_;
  std::map<std::tuple<int, std::size_t, bool>, std::shared_ptr<const scene::TriangleMesh>> sharedMeshes_;
};

Error inFile(const std::string& path, const Error& error) {
  return {error.code, path + ": " + error.message};
}
}  // namespace

Result<SceneDescription> loadGltf(const std::string& path, const GltfOptions& options) {
  Result<tinygltf::Model> model = parseGltfFile(path);
  if (!model) return inFile(path, model.error());
  Result<SceneDescription> built = GltfSceneBuilder(*model, options).build();
  if (!built) return inFile(path, built.error());
  built->name = std::filesystem::path(path).filename().string();
  return built;
}

}  // namespace halfshadow::scenes
