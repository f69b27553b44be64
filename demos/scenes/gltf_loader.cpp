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
#include "scenes/gltf_instances.hpp"
#include "scenes/gltf_lights.hpp"
#include "scenes/gltf_materials.hpp"
#include "scenes/gltf_pose.hpp"
#include "scenes/gltf_presence.hpp"

namespace halfshadow::scenes {
namespace {
using scene::SceneDescription;
using scene::SceneObject;

std::string label(const char* kind, std::size_t index, const std::string& name) {
  return std::string(kind) + " " + std::to_string(index) + (name.empty() ? "" : " '" + name + "'");
}

/// a, b, c and 4 more
std::string listed(const std::vector<std::string>& names, const char* quote = "'") {
  constexpr std::size_t kShown = 3;
  std::string text;
  for (std::size_t i = 0; i < std::min(names.size(), kShown); ++i)
    text += (i > 0 ? ", " : "") + (quote + names[i].substr(0, 60)) + quote;
  if (names.size() > kShown) text += " and " + std::to_string(names.size() - kShown) + " more";
  return text;
}

class GltfSceneBuilder {
 public:
  GltfSceneBuilder(GltfFile& file, const GltfOptions& options)
      : model_(file.model), options_(options), images_(file.model, scene_.notes) {
    scene_.notes = std::move(file.notes);
  }

  Result<SceneDescription> build() {
    Result<Pose> pose = poseOf(model_, options_, scene_.notes);
    if (!pose) return pose.error();
    pose_ = std::move(pose).value();
    images_.beginDecoding(baseColorTextures(model_));
    const Result<std::vector<std::size_t>> nodes = nodesOfScene();
    if (!nodes) return nodes.error();
    for (const std::size_t node : *nodes) {
      if (!pose_.isVisible[node]) continue;
      for (const auto step : {&GltfSceneBuilder::addMesh, &GltfSceneBuilder::addLight}) {
        if (Status status = (this->*step)(node); !status) return status.error();
      }
    }
    addObjects(materialsOf(model_, images_));
    noteWhatAlphaDid();
    noteWhatWasSkipped();
    if (scene_.objects.empty()) return nothingToDraw();
    for (const std::size_t node : *nodes) {
      if (Status status = addCamera(node); !status) return status.error();
    }
    if (Status status = addLights(lights_, scene_); !status) return status.error();
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
    PrimitiveRequest request{.mesh = node.mesh};
    std::vector<glm::dmat4> joints;
    if (node.skin != -1) {
      Result<std::vector<glm::dmat4>> matrices = jointMatrices(model_, pose_, node.skin);
      if (!matrices) return matrices.error();
      joints = std::move(matrices).value();
      request.jointMatrices = &joints;
    }
    const std::vector<double>& ofNode = pose_.weights[nodeIndex];
    const std::vector<double>& weights = ofNode.empty() ? pose_.meshWeights[node.mesh] : ofNode;
    if (!weights.empty()) request.morphWeights = &weights;
    const Result<std::vector<glm::dmat4>> instances = instancesOf(model_, node, what);
    if (!instances) return instances.error();
    for (std::size_t i = 0; i < instances->size(); ++i) {
      // A skin's joints place it, not its node.
      const glm::dmat4 world =
          node.skin != -1 ? glm::dmat4(1.0) : pose_.worldFromNode[nodeIndex] * (*instances)[i];
      const std::string suffix = instances->size() > 1 ? "[" + std::to_string(i) + "]" : "";
      if (Status status = addPlaced(nodeIndex, suffix, request, world); !status) return status;
    }
    return {};
  }

  /// A transform has three axes that differ: what is flattened has not, nor what is scaled to nothing.
  static bool isInvertible(const glm::dmat4& world) {
    const glm::dmat3 axes(world);
    const double volume = std::abs(glm::determinant(axes));
    return volume > 1e-15 * glm::length(axes[0]) * glm::length(axes[1]) * glm::length(axes[2]);
  }

  /// The node's mesh, or one instance of it, by this transform.
  Status addPlaced(std::size_t nodeIndex, const std::string& suffix, PrimitiveRequest request,
                   glm::dmat4 worldFromObject) {
    const glm::dmat4 asInFile = worldFromObject;
    if (!isInvertible(worldFromObject)) {
      request.flattening = &asInFile;
      worldFromObject = glm::dmat4(1.0);
    }
    request.isMirrored = glm::determinant(glm::dmat3(worldFromObject)) < 0.0;
    if (request.isMirrored)
      worldFromObject = worldFromObject * glm::scale(glm::dmat4(1.0), glm::dvec3(-1, 1, 1));
    const bool isWorld = request.jointMatrices != nullptr || request.flattening != nullptr;
    const std::size_t count = model_.meshes[request.mesh].primitives.size();
    glm::dvec3 center(0.0);
    std::size_t added = 0;
    for (request.primitive = 0; request.primitive < count; ++request.primitive) {
      const Result<PrimitiveMesh> made = meshFor(request);
      if (!made) return made.error();
      if (made->mesh == nullptr) continue;
      ++added;
      if (isWorld && request.centerWorld == nullptr) {
        center = made->centerWorld;
        request.centerWorld = &center;
        worldFromObject = glm::translate(worldFromObject, center);
      }
      if (Status status = takeObject(nodeIndex, suffix, request, made->mesh, worldFromObject); !status)
        return status;
    }
    if (added == 0 && request.flattening != nullptr) {
      scene_.notes.push_back(label("node", nodeIndex, model_.nodes[nodeIndex].name) + suffix +
                             " is scaled to nothing and was skipped");
    }
    return {};
  }

  /// One that waits for its material: images are still being decoded.
  Status takeObject(std::size_t nodeIndex, const std::string& suffix, const PrimitiveRequest& request,
                    std::shared_ptr<const scene::TriangleMesh> mesh, const glm::dmat4& worldFromObject) {
    const tinygltf::Mesh& source = model_.meshes[request.mesh];
    const int material = source.primitives[request.primitive].material;
    SceneObject object{
        .name = model_.nodes[nodeIndex].name, .mesh = std::move(mesh), .worldFromObject = worldFromObject};
    if (object.name.empty()) object.name = source.name.empty() ? label("node", nodeIndex, "") : source.name;
    object.name += suffix;
    if (source.primitives.size() > 1) object.name += "#" + std::to_string(request.primitive);
    if (material >= static_cast<int>(model_.materials.size()) || material < -1) {
      return malformed("primitive " + std::to_string(request.primitive) + " of mesh " +
                       std::to_string(request.mesh) + " has material " + std::to_string(material) +
                       ", which does not exist");
    }
    object.casts = flag(nodeIndex, "casts");
    object.receives = flag(nodeIndex, "receives");
    waiting_.push_back({std::move(object), material, request.flattening != nullptr});
    return {};
  }

  struct WaitingObject {
    SceneObject object;
    int material = -1;  ///< of the file; -1: none
    bool isFlattened = false;
  };

  /// Objects that share a mesh and its material share what is left of it.
  const PresentMesh& presentOf(const WaitingObject& waiting, const GltfMaterial& material) {
    const auto [found, isNew] = present_.try_emplace(std::pair(waiting.object.mesh, waiting.material));
    if (isNew) found->second = presentMesh(material, waiting.object.mesh);
    return found->second;
  }

  void addObjects(const std::vector<GltfMaterial>& materials) {
    for (WaitingObject& waiting : waiting_) {
      SceneObject& object = waiting.object;
      GltfMaterial material;
      material.material.doubleSided = false;  // the format's default
      if (waiting.material >= 0) material = materials[waiting.material];
      const PresentMesh& present = presentOf(waiting, material);
      if (present.mesh == nullptr) {
        absent_.push_back(object.name);
        continue;
      }
      object.mesh = present.mesh;
      object.material = material.material;
      if (object.mesh->texcoords.empty()) object.material.baseColorImage = nullptr;
      if (!present.hasHoles) object.material.alphaCutoff = 0.0f;
      // What is flattened has both its sides in one place.
      object.material.doubleSided = object.material.doubleSided || waiting.isFlattened;
      if (material.blends) blended_.push_back(object.name);
      scene_.objects.push_back(std::move(object));
    }
  }

  void noteWhatWasSkipped() {
    if (!skipped_.pointsOrLines.empty()) {
      scene_.notes.push_back(listed(skipped_.pointsOrLines, "") +
                             ": points or lines, which cast no shadow, were skipped");
    }
    if (!skipped_.withoutArea.empty()) {
      scene_.notes.push_back(listed(skipped_.withoutArea, "") +
                             ": no triangle that has an area; they were skipped");
    }
  }

  Error nothingToDraw() const {
    if (!absent_.empty()) {
      return {ErrorCode::emptyScene,
              "all that it holds is transparent (alpha below the cutoff); export a mesh "
              "that can be seen"};
    }
    return {ErrorCode::emptyScene,
            "it has no triangles to draw in its scene; export a mesh (points and lines are skipped)"};
  }

  void noteWhatAlphaDid() {
    if (!absent_.empty()) {
      scene_.notes.push_back(listed(absent_) + ": transparent all over (alpha below the cutoff), left out");
    }
    if (!blended_.empty()) {
      scene_.notes.push_back(listed(blended_) +
                             ": of alphaMode BLEND what is at least half opaque is drawn and casts as if it "
                             "were opaque, the rest is left out");
    }
  }

  /// Nodes that show the same mesh undeformed share it.
  Result<PrimitiveMesh> meshFor(const PrimitiveRequest& request) {
    const bool isShared =
        request.jointMatrices == nullptr && request.morphWeights == nullptr && request.flattening == nullptr;
    const auto key = std::make_tuple(request.mesh, request.primitive, request.isMirrored);
    if (const auto found = sharedMeshes_.find(key); isShared && found != sharedMeshes_.end())
      return PrimitiveMesh{found->second};
    auto made = primitiveMesh(model_, request, skipped_);
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
    if (scene_.camera) {
      scene_.notes.push_back(what + " was skipped: only the first one is used");
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
    if (source.type == "orthographic") {
      if (Status status = moveFarAway(source.orthographic, what, bounds.radius(), *scene_.camera); !status)
        return status;
    }
    if (Status status = scene::checkCamera(*scene_.camera); !status) {
      return malformed(what + ": " + status.error().message);
    }
    return {};
  }

  /// An orthographic camera as a perspective one from far away: a thousand half heights for a scene about as
  /// deep as the picture is high, over which nothing is off by a two-thousandth of the height then, a quarter
  /// of a pixel of 480. Deeper scenes are seen from farther, but less so than they are deep: what is
  /// far away costs single precision its digits.
  static Status moveFarAway(const tinygltf::OrthographicCamera& source, const std::string& what,
                            double radius, scene::Camera& camera) {
    constexpr double kHalfHeights = 1000.0;
    const double halfHeight = std::abs(source.ymag);
    if (!(halfHeight > 0.0) || !std::isfinite(halfHeight)) {
      return malformed(what + " has a ymag of " + std::to_string(source.ymag) +
                       "; give a number that is not 0");
    }
    const glm::dvec3 way = camera.targetWorld - camera.eyeWorld;
    const double distance = kHalfHeights * std::sqrt(halfHeight * std::max(halfHeight, radius));
    camera.eyeWorld = camera.targetWorld - glm::normalize(way) * distance;
    camera.verticalFovRadians = 2.0 * std::atan(halfHeight / distance);
    camera.leastNearDistance =
        std::max(distance - glm::length(way) + std::max(source.znear, 0.0), 1e-3 * distance);
    camera.nearDistance = camera.leastNearDistance;
    camera.farDistance = 2.0 * std::max(distance, camera.leastNearDistance);
    return {};
  }

  Status addLight(std::size_t nodeIndex) {
    const tinygltf::Node& node = model_.nodes[nodeIndex];
    Result<std::optional<PendingLight>> light =
        lightOf(model_, node, pose_.worldFromNode[nodeIndex], label("node", nodeIndex, node.name));
    if (!light) return light.error();
    if (*light) lights_.push_back(**light);
    return {};
  }

  tinygltf::Model& model_;
  const GltfOptions& options_;
  SceneDescription scene_;
  Pose pose_;
  GltfImages images_;
  std::map<std::pair<std::shared_ptr<const scene::TriangleMesh>, int>, PresentMesh> present_;
  std::vector<WaitingObject> waiting_;
  std::vector<std::string> absent_, blended_;  ///< objects by name
  SkippedPrimitives skipped_;
  std::vector<PendingLight> lights_;
  std::map<std::tuple<int, std::size_t, bool>, std::shared_ptr<const scene::TriangleMesh>> sharedMeshes_;
};

Error inFile(const std::string& path, const Error& error) {
  return {error.code, path + ": " + error.message};
}
}  // namespace

Result<SceneDescription> loadGltf(const std::string& path, const GltfOptions& options) {
  Result<GltfFile> file = parseGltfFile(path);
  if (!file) return inFile(path, file.error());
  Result<SceneDescription> built = GltfSceneBuilder(*file, options).build();
  if (!built) return inFile(path, built.error());
  built->name = std::filesystem::path(path).filename().string();
  return built;
}

}  // namespace halfshadow::scenes
