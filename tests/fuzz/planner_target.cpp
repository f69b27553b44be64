// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// Scenes of boxes that move, appear and go, under lights and cameras of any kind that passes their checks:
// what is planned names what there is, and the same frame planned afresh needs no caster that was left out.
#include <algorithm>
#include <cmath>
#include <memory>

#include "input_reader.hpp"
#include "planner/frame_planner.hpp"
#include "planner/light_fit.hpp"
#include "planner/light_reach.hpp"
#include "planner/sub_lights.hpp"
#include "scene/place.hpp"
#include "scenes/shapes.hpp"

namespace halfshadow::fuzz {
namespace {

struct Shape {
  std::shared_ptr<const scene::TriangleMesh> mesh;
  scene::SupportingPlanes support;
  scene::EnclosingPoints enclosing;
};

const std::vector<Shape>& shapes() {
  static const std::vector<Shape> made = [] {
    std::vector<Shape> list;
    for (const scenes::Shape& shape :
         {scenes::boxShape(glm::dvec3(0.0), glm::dvec3(1.0)), scenes::planeShape({}, 2.0),
          scenes::icosphereShape({}, 1.0, 1), scenes::frustumShape({}, 1.0, 0.0, 2.0, 5)}) {
      Shape one{.mesh = scenes::meshOf(shape)};
      one.support = scene::supportingPlanesOf(*one.mesh, glm::dvec3(0.0));
      one.enclosing = scene::enclosingPoints(*one.mesh);
      list.push_back(std::move(one));
    }
    return list;
  }();
  return made;
}

glm::dvec3 place(InputReader& reader) {
  const double x = reader.number(), y = reader.number(), z = reader.number();
  return {x, y, z};
}

class World {
 public:
  explicit World(Input input) : reader_(input) {}
  bool change() {
    if (reader_.atEnd()) return false;
    for (std::size_t steps = 1 + reader_.below(4); steps > 0; --steps) step();
    return true;
  }
  /// Of what stands now; false where an engine would have refused the camera.
  bool isComplete() const { return camera_.has_value() && !lights_.empty() && !objects_.empty(); }
  planner::FrameInput input() const {
    return {.objects = objects_,
            .camera = &*camera_,
            .aspectWidthOverHeight = 1.5,
            .lights = lights_,
            .lightRevisions = lightRevisions_,
            .receiversUnknown = receiversUnknown_};
  }
  const std::vector<scene::AreaLight>& lights() const { return lights_; }
  int mapSize() const { return mapSize_; }

 private:
  void step() {
    switch (reader_.below(6)) {
      case 0:
        return addObject();
      case 1:
        if (!objects_.empty())
          objects_.erase(objects_.begin() + static_cast<std::ptrdiff_t>(reader_.below(objects_.size())));
        return;
      case 2:
        if (!objects_.empty()) (void)placeObject(objects_[reader_.below(objects_.size())]);
        return;
      case 3:
        return setLight();
      case 4:
        return setCamera();
      default:
        receiversUnknown_ = reader_.flag();
        mapSize_ = 16 << reader_.below(7);
    }
  }
  void addObject() {
    const Shape& shape = shapes()[reader_.below(shapes().size())];
    const std::uint8_t kind = reader_.byte();
    planner::PlannedObject object{.id = ++lastId_, .casts = (kind & 1) != 0, .receives = (kind & 2) != 0};
    if ((kind & 4) == 0)
      object.mesh = shape.mesh.get(), object.support = &shape.support, object.enclosing = &shape.enclosing;
    boundsObject_.resize(lastId_ + 1);
    boundsObject_[lastId_] = scene::boundsOf(*shape.mesh);
    if (placeObject(object) && objects_.size() < 12) objects_.push_back(object);
  }
  /// False, and nothing done, where engines refuse.
  bool placeObject(planner::PlannedObject& object) {
    glm::dmat4 world(1.0);
    for (int axis = 0; axis < 3; ++axis) world[axis][axis] = reader_.number();
    world[1][0] = reader_.plainNumber() / 8.0;
    world[3] = glm::dvec4(place(reader_), 1.0);
    const scene::Bounds bounds = scene::transformed(world, boundsObject_[object.id]);
    if (!scene::isPlace(bounds.low) || !scene::isPlace(bounds.high)) return false;
    if (glm::determinant(glm::dmat3(world)) == 0.0) return false;
    object.worldFromObject = world;
    object.boundsWorld = bounds;
    object.revision = ++lastRevision_;
    return true;
  }
  void setLight() {
    const std::size_t which = reader_.below(3);
    const glm::dvec3 center = place(reader_), u = place(reader_), v = place(reader_);
    const auto light = scene::areaLightFromVectors(center, u, v);
    if (!light) return;
    if (which >= lights_.size()) {
      lights_.push_back(*light);
      lightRevisions_.push_back(++lastRevision_);
    } else {
      lights_[which] = *light;
      lightRevisions_[which] = ++lastRevision_;
    }
  }
  void setCamera() {
    const glm::dvec3 eye = place(reader_), target = place(reader_), up = place(reader_);
    const scene::Camera camera{.eyeWorld = eye,
                               .targetWorld = target,
                               .up = up,
                               .verticalFovRadians = reader_.number(),
                               .nearDistance = reader_.number(),
                               .farDistance = reader_.number()};
    if (scene::checkCamera(camera)) camera_ = camera;
  }

  InputReader reader_;
  std::vector<planner::PlannedObject> objects_;
  std::vector<scene::Bounds> boundsObject_;  ///< by id
  std::vector<scene::AreaLight> lights_;
  std::vector<std::uint64_t> lightRevisions_;
  std::optional<scene::Camera> camera_;
  bool receiversUnknown_ = false;
  int mapSize_ = 256;
  std::uint32_t lastId_ = 0;
  std::uint64_t lastRevision_ = 0;
};

void checkPlan(const planner::FrameInput& input, const planner::FramePlan& plan) {
  require(plan.lights.size() == input.lights.size(), "a light has no plan");
  std::vector<std::uint32_t> receivers = plan.receivers;
  std::ranges::sort(receivers);
  require(std::ranges::adjacent_find(receivers) == receivers.end(), "a receiver is drawn twice");
  for (const std::uint32_t receiver : plan.receivers)
    require(receiver < input.objects.size() && input.objects[receiver].receives,
            "what is no receiver is one");
  for (const planner::LightPlan& light : plan.lights) {
    require(light.contentKey != 0, "a light view without a key");
    require(!light.active || !light.casters.empty(), "a light without casters is at work");
    require(std::ranges::adjacent_find(light.casters, std::greater_equal<>()) == light.casters.end(),
            "casters are not in order, once each");
    for (const std::uint32_t caster : light.casters)
      require(caster < input.objects.size() && input.objects[caster].casts, "what is no caster is one");
  }
}

/// A planner that knows the frames before leaves out no caster that one without a past would draw.
void checkAgainstFresh(const planner::FrameInput& input, const planner::FramePlan& plan) {
  planner::FramePlanner fresh;
  const planner::FramePlan again = fresh.plan(input);
  checkPlan(input, again);
  require(again.receivers == plan.receivers, "other receivers are seen when frames came before");
}

void checkFits(const World& world, const planner::FrameInput& input, const planner::FramePlan& plan) {
  for (std::size_t light = 0; light < plan.lights.size(); ++light) {
    std::vector<glm::dvec3> points;
    scene::Bounds bounds;
    for (const std::uint32_t caster : plan.lights[light].casters) {
      bounds.include(input.objects[caster].boundsWorld);
      for (const glm::dvec3& corner : input.objects[caster].boundsWorld.corners()) points.push_back(corner);
    }
    if (points.empty()) continue;
    const scene::AreaLight source = planner::lightWithinReach(world.lights()[light], bounds);
    const planner::LightFit fit = planner::fitLight(source, points, {.mapSize = world.mapSize()});
    if (fit.empty) continue;
    require(std::isfinite(fit.nearDistance) && std::isfinite(fit.farDistance) && fit.nearDistance > 0.0 &&
                fit.nearDistance < fit.farDistance,
            "a map has no depth");
    require(std::isfinite(fit.tangentLow.x + fit.tangentLow.y + fit.tangentHigh.x + fit.tangentHigh.y) &&
                fit.tangentLow.x < fit.tangentHigh.x && fit.tangentLow.y < fit.tangentHigh.y,
            "a map sees nothing");
    const planner::SubLightGrid grid = planner::subLightGrid(source, 3);
    require(grid.alongU >= 1 && grid.alongV >= 1, "a light without parts");
    if (const int side = planner::subLightMapSize(grid, world.mapSize()); side > 0)
      (void)planner::fitSubLights(source, points, grid, side);
  }
}

void test(Input input) {
  World world(input);
  planner::FramePlanner kept;
  for (int frame = 0; frame < 16 && world.change(); ++frame) {
    if (!world.isComplete()) continue;
    const planner::FrameInput now = world.input();
    const planner::FramePlan plan = kept.plan(now);
    checkPlan(now, plan);
    checkAgainstFresh(now, plan);
    checkFits(world, now, plan);
  }
}

Bytes seed(std::size_t shape, double lightHalf) {
  InputWriter writer;
  writer.byte(3);
  writer.byte(0).byte(1).byte(2).numbers({8, 1, 8, 0, 0, 0, 0});
  writer.byte(0).byte(shape).byte(3).numbers({1, 1, 1, 0, 0, 2, 0});
  writer.byte(3).byte(0).numbers({1, 9, 2, lightHalf, 0, 0, 0, 0, -lightHalf});
  writer.byte(4).numbers({0, 6, 9, 0, 0, 0, 0, 1, 0, 1, 0.5, 14});
  for (int frame = 0; frame < 3; ++frame)
    writer.byte(0).byte(2).byte(1).numbers({1, 1, 1, 1, 0.25 * frame, 2, 0});
  writer.byte(1).byte(3).byte(0).numbers({-3, 9, 2, 1, 0, 0, 0, 0, -1});
  writer.byte(5).byte(1).byte(3);
  return writer.bytes;
}

std::vector<Bytes> seeds() {
  return {seed(0, 0.5), seed(2, 0.0), seed(3, 2.0), seed(1, 0.125)};
}
}  // namespace

const Target& target() {
  static const Target made{.name = "planner", .test = test, .seeds = seeds, .largestInput = 512};
  return made;
}

}  // namespace halfshadow::fuzz
