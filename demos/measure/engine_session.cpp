// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "measure/engine_session.hpp"

#include <algorithm>
#include <glm/gtc/type_ptr.hpp>
#include <utility>

#include "measure/device_settings.hpp"

namespace halfshadow::measure {
namespace {
void store(const glm::dvec3& vector, double target[3]) {
  for (int i = 0; i < 3; ++i) target[i] = vector[i];
}

Status toStatus(const Outcome& outcome) {
  return outcome.ok() ? Status{} : Status(Error{outcome.code, outcome.message});
}

/// Triangles as they were wound in the file: the engine mends them itself, and remembers what was inward.
std::vector<std::uint32_t> sourceIndices(const scene::TriangleMesh& mesh) {
  std::vector<std::uint32_t> indices = mesh.indices;
  for (std::size_t t = 0; t < mesh.turned.size(); ++t) {
    if (mesh.turned[t]) std::swap(indices[3 * t + 1], indices[3 * t + 2]);
  }
  return indices;
}

/// `indices` are read while the description is in use.
ObjectDesc objectDesc(const scene::SceneObject& object, const std::vector<std::uint32_t>& indices) {
  const scene::TriangleMesh& mesh = *object.mesh;
  ObjectDesc desc{
      .mesh = {.positions = glm::value_ptr(mesh.positions.front()),
               .vertexCount = static_cast<std::uint32_t>(mesh.positions.size()),
               .indices = indices.data(),
               .indexCount = indices.size(),
               .normals = mesh.normals.empty() ? nullptr : glm::value_ptr(mesh.normals.front()),
               .texcoords = mesh.texcoords.empty() ? nullptr : glm::value_ptr(mesh.texcoords.front()),
               .colors = mesh.colors.empty() ? nullptr : glm::value_ptr(mesh.colors.front())},
      .casts = object.casts,
      .receives = object.receives};
  std::copy_n(glm::value_ptr(object.worldFromObject), 16, desc.worldFromObject);
  std::copy_n(glm::value_ptr(object.material.baseColor), 4, desc.baseColor);
  if (const scene::Image* image = object.material.baseColorImage.get(); image && !mesh.texcoords.empty()) {
    desc.baseColorPixels = image->pixels.data();
    desc.baseColorWidth = image->width;
    desc.baseColorHeight = image->height;
    desc.baseColorChannels = image->channels;
    desc.baseColorWrapU = object.material.sampling.wrapU;
    desc.baseColorWrapV = object.material.sampling.wrapV;
    desc.baseColorFilter = object.material.sampling.filter;
  }
  desc.alphaCutoff = std::min(object.material.alphaCutoff, 1.0f);
  desc.singleSided = !object.material.doubleSided;
  return desc;
}
}  // namespace

CameraDesc cameraDesc(const scene::Camera& camera) {
  CameraDesc desc{.verticalFovRadians = camera.verticalFovRadians,
                  .nearDistance = camera.nearDistance,
                  .farDistance = camera.farDistance};
  store(camera.eyeWorld, desc.eye);
  store(camera.targetWorld, desc.target);
  store(camera.up, desc.up);
  return desc;
}

CameraDesc nudged(const CameraDesc& camera) {
  constexpr double kStep = 1e-7;
  CameraDesc nearer = camera;
  for (int i = 0; i < 3; ++i) nearer.eye[i] += kStep * (camera.target[i] - camera.eye[i]);
  return nearer;
}

LightDesc lightDesc(const scene::AreaLight& light) {
  LightDesc desc{.intensity = light.intensity,
                 .referenceDistance = light.referenceDistance,
                 .innerConeRadians = light.innerConeRadians,
                 .outerConeRadians = light.outerConeRadians};
  store(light.centerWorld, desc.center);
  store(light.halfU, desc.halfU);
  store(light.halfV, desc.halfV);
  store(light.emission, desc.emission);
  for (int i = 0; i < 3; ++i) desc.color[i] = light.color[i];
  return desc;
}

EngineSession::~EngineSession() = default;

Result<std::unique_ptr<EngineSession>> EngineSession::open(const SessionOptions& options) {
  auto context = createHeadless({.driver = options.driver, .eglLibrary = options.eglLibrary});
  if (!context) return context.error();
  HeadlessContext* const headless = context->get();
  auto session = openIn(
      {.getProcAddress = [](const char* name,
                            void* user) { return static_cast<HeadlessContext*>(user)->getProcAddress(name); },
       .user = headless,
       .description = headless->description()},
      options);
  if (session) (*session)->context_ = std::move(context).value();
  return session;
}

Result<std::unique_ptr<EngineSession>> EngineSession::openIn(const HostContext& context,
                                                             const SessionOptions& options) {
  std::unique_ptr<EngineSession> session(new EngineSession);
  session->options_ = options;
  session->threads_ = WorkerThreads(options.threads);
  session->host_ = context;
  if (Status status = session->renewEngine(); !status) return status.error();
  return session;
}

Status EngineSession::renewEngine() {
  objectIds_.clear();
  objects_.clear();
  engine_.reset();  // before the new one: two engines' textures need not fit side by side
  std::vector<const char*> forcedOff;
  for (const std::string& name : options_.forcedOff) forcedOff.push_back(name.c_str());
  Outcome outcome;
  engine_.reset(Engine::create({.getProcAddress = host_.getProcAddress,
                                .getProcAddressUser = host_.user,
                                .forcedOff = forcedOff.data(),
                                .forcedOffCount = forcedOff.size(),
                                .hostState = options_.hostState,
                                .parallelFor = threads_.count() > 1 ? WorkerThreads::parallelFor : nullptr,
                                .parallelForUser = &threads_},
                               outcome));
  if (!outcome.ok()) return toStatus(outcome);
  auto measured = deviceSettings(options_.deviceProfile, engine_->driver().renderer);
  if (!measured) return measured.error();
  return set(*measured);
}

int EngineSession::sizeLimit() const {
  const DriverRecord driver = engine_->driver();
  return std::min(driver.maxTextureSize, driver.maxRenderbufferSize);
}

Status EngineSession::addObjects(const scene::SceneDescription& scene) {
  for (const scene::SceneObject& object : scene.objects) {
    ObjectId id = 0;
    const Outcome outcome = engine_->addObject(objectDesc(object, sourceIndices(*object.mesh)), id);
    if (!outcome.ok()) {
      return Error{outcome.code, scene.name + ": object \"" + object.name + "\": " + outcome.message};
    }
    objectIds_.push_back(id);
    objects_.push_back(object);
    objects_.back().material.baseColorImage = nullptr;  // the engine has its own copy
  }
  return {};
}

Status EngineSession::load(const scene::SceneDescription& scene) {
  if (Status status = addObjects(scene); !status) return status;
  return setLights({scene.lights.front()});
}

Status EngineSession::updateObject(std::size_t index, const scene::SceneObject& object) {
  scene::SceneObject& loaded = objects_[index];
  const ObjectDesc desc = objectDesc(object, object.mesh->indices);  // which setVertices does not read
  if (loaded.worldFromObject != object.worldFromObject) {
    if (Status s = toStatus(engine_->setTransform(objectIds_[index], desc.worldFromObject)); !s) return s;
  }
  if (loaded.mesh->positions != object.mesh->positions) {
    if (Status s = toStatus(engine_->setVertices(objectIds_[index], desc.mesh)); !s) return s;
  }
  loaded = object;
  return {};
}

Status EngineSession::update(const scene::SceneDescription& scene) {
  const auto sameTriangles = [](const scene::SceneObject& a, const scene::SceneObject& b) {
    return a.mesh->indices == b.mesh->indices && a.mesh->positions.size() == b.mesh->positions.size() &&
           a.casts == b.casts && a.receives == b.receives;
  };
  if (std::ranges::equal(scene.objects, objects_, sameTriangles)) {
    for (std::size_t i = 0; i < scene.objects.size(); ++i) {
      if (Status status = updateObject(i, scene.objects[i]); !status) return status;
    }
    return {};
  }
  for (const ObjectId id : objectIds_) {
    if (Status status = toStatus(engine_->removeObject(id)); !status) return status;
  }
  objectIds_.clear();
  objects_.clear();
  return addObjects(scene);
}

Status EngineSession::setLights(const std::vector<scene::AreaLight>& lights) {
  std::vector<LightDesc> descs;
  for (const scene::AreaLight& light : lights) descs.push_back(lightDesc(light));
  return toStatus(engine_->setLights(descs.data(), descs.size()));
}

Status EngineSession::choose(const std::string& technique, const std::vector<Setting>& settings) {
  if (Status status = toStatus(engine_->setTechnique(technique.c_str())); !status) return status;
  return set(settings);
}

Status EngineSession::set(const std::vector<Setting>& settings) {
  for (const Setting& setting : settings) {
    if (Status status = toStatus(engine_->set(setting.key.c_str(), setting.value.c_str())); !status)
      return status;
  }
  return {};
}

Status EngineSession::render(const RenderDesc& desc, FrameReport& report) {
  return toStatus(engine_->render(desc, report));
}

Status EngineSession::render(const RenderDesc& desc) {
  return toStatus(engine_->render(desc));
}

Result<RgbaImage> EngineSession::read(int width, int height) {
  RgbaImage image{width, height, {}};
  image.pixels.resize(static_cast<std::size_t>(width) * static_cast<std::size_t>(height) * 4);
  if (Status status = toStatus(engine_->readOutput(image.pixels.data(), image.pixels.size())); !status) {
    return status.error();
  }
  return image;
}

std::vector<float> decodeVisibility(const RgbaImage& image, Output output) {
  std::vector<float> visibility(image.pixels.size() / 4);
  for (std::size_t i = 0; i < visibility.size(); ++i) {
    const std::uint8_t* pixel = image.pixels.data() + 4 * i;
    visibility[i] = output == Output::visibility16 ? static_cast<float>(256 * pixel[0] + pixel[1]) / 65280.0f
                                                   : static_cast<float>(pixel[0]) / 255.0f;
  }
  return visibility;
}

std::vector<std::uint32_t> decodeTaps(const RgbaImage& image) {
  std::vector<std::uint32_t> taps(image.pixels.size() / 4);
  for (std::size_t i = 0; i < taps.size(); ++i) {
    taps[i] = image.pixels[4 * i] + 256u * image.pixels[4 * i + 1];
  }
  return taps;
}

Output visibilityOutputOf(const std::string& technique) {
  return technique == "sampled" ? Output::visibility16 : Output::visibility;
}

}  // namespace halfshadow::measure
