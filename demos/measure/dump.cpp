// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "measure/dump.hpp"

#include <charconv>
#include <string>

#include "images/images.hpp"
#include "measure/measurement_json.hpp"
#include "measure/text_file.hpp"

namespace halfshadow::measure {
namespace {
void appendNumber(std::string& text, double value) {
  char buffer[32];
  const auto [end, error] =
      std::to_chars(buffer, buffer + sizeof buffer, value);  // shortest that reads back equal
  text.append(buffer, error == std::errc() ? end : buffer);
}

std::string objText(const scene::SceneDescription& scene, bool casters) {
  std::string vertices, faces;
  std::size_t first = 1;
  for (const scene::SceneObject& object : scene.objects) {
    if (object.casts != casters) continue;
    const scene::TriangleMesh& mesh = *object.mesh;
    for (const glm::vec3& position : mesh.positions) {
      const glm::dvec3 world(object.worldFromObject * glm::dvec4(glm::dvec3(position), 1.0));
      vertices += 'v';
      for (int i = 0; i < 3; ++i) vertices += ' ', appendNumber(vertices, world[i]);
      vertices += '\n';
    }
    for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
      faces += 'f';
      for (std::size_t k = 0; k < 3; ++k) faces += ' ' + std::to_string(first + mesh.indices[i + k]);
      faces += '\n';
    }
    first += mesh.positions.size();
  }
  return vertices + faces;
}

images::FloatImage positionImage(const Truth& truth) {
  images::FloatImage image{.width = truth.width, .height = truth.height, .channels = 4};
  for (std::size_t i = 0; i < truth.receivers.kind.size(); ++i) {
    const bool receiver = truth.receivers.kind[i] != reference::kNoReceiver;
    const glm::vec3 position(truth.receivers.positionWorld[i]);
    image.pixels.insert(image.pixels.end(), {position.x, position.y, position.z, receiver ? 1.0f : 0.0f});
  }
  return image;
}

images::FloatImage normalImage(const Truth& truth) {
  images::FloatImage image{
      .width = truth.width, .height = truth.height, .channels = 3, .channelNames = {"R", "G", "B"}};
  for (const glm::dvec3& normalWorld : truth.receivers.normalWorld) {
    const glm::vec3 normal(normalWorld);
    image.pixels.insert(image.pixels.end(), {normal.x, normal.y, normal.z});
  }
  return image;
}

images::FloatImage visibilityImage(const Truth& truth, const std::vector<float>& visibility) {
  return {.width = truth.width,
          .height = truth.height,
          .channels = 1,
          .pixels = visibility,
          .channelNames = {"V"}};
}
}  // namespace

Status prepareDumpFolder(const std::filesystem::path& folder) {
  std::error_code failure;
  std::filesystem::create_directories(folder, failure);
  if (failure || !std::filesystem::is_directory(folder)) {
    return Error{ErrorCode::fileNotWritable,
                 "cannot make the folder " + folder.string() + ": " +
                     (failure ? failure.message() : "a file of that name exists") +
                     "; give another --dump folder"};
  }
  return checkWritable(folder / "reference.exr");
}

Status dumpMeasurement(const std::filesystem::path& folder, const scene::SceneDescription& scene,
                       const Truth& truth, const std::vector<TechniqueMeasurement>& techniques) {
  Json light = lightJson(scene.lights.front());
  light["origin_lift"] = truth.originLiftWorld;
  light["occluders"] = "geometry.obj alone; the triangles of receivers.obj cast no shadow";
  if (Status s = writeTextFile(folder / "geometry.obj", objText(scene, true)); !s) return s;
  if (Status s = writeTextFile(folder / "receivers.obj", objText(scene, false)); !s) return s;
  if (Status s = writeTextFile(folder / "light.json", light.dump(2) + "\n"); !s) return s;
  if (Status s = images::writeExr(folder / "position.exr", positionImage(truth)); !s) return s;
  if (Status s = images::writeExr(folder / "normal.exr", normalImage(truth)); !s) return s;
  if (Status s = images::writeExr(folder / "reference.exr", visibilityImage(truth, truth.visibility)); !s)
    return s;
  for (const TechniqueMeasurement& technique : techniques) {
    if (!technique.measured()) continue;
    const Status s =
        images::writeExr(folder / (technique.id + ".exr"), visibilityImage(truth, technique.visibility));
    if (!s) return s;
  }
  return {};
}

}  // namespace halfshadow::measure
