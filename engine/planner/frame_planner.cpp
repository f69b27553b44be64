// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "planner/frame_planner.hpp"

#include <algorithm>
#include <bit>

#include "base/keys.hpp"
#include "planner/relevance.hpp"

namespace halfshadow::planner {
namespace {

constexpr int kChangesUntilDynamic = 2;
constexpr std::uint64_t kKeySeed = 0x68616c66736861ull;
/// Of moved receivers, from which on the order is sorted anew.
constexpr std::size_t kFewMoved = 16;

bool shines(const scene::AreaLight& light) {
  return light.intensity > 0.0 && std::max({light.color.r, light.color.g, light.color.b}) > 0.0f;
}

/// Distance at which it may begin. Drawn front to back, what lies behind is rejected before its visibility is
/// computed.
double nearestTo(const glm::dvec3& eye, const scene::Bounds& bounds) {
  return glm::length(glm::max(glm::max(bounds.low - eye, eye - bounds.high), glm::dvec3(0.0)));
}

std::uint64_t keyOf(const PlannedObject& object) {
  const std::uint64_t roles = (object.casts ? 2u : 0u) + (object.receives ? 1u : 0u);
  return combineKeys(combineKeys(combineKeys(kKeySeed, object.id), object.revision), roles);
}

std::uint64_t neverZero(std::uint64_t key) {
  return key == 0 ? 1 : key;
}

}  // namespace

std::uint64_t lightRevisionOf(const FrameInput& input, std::size_t light) {
  return light < input.lightRevisions.size() ? input.lightRevisions[light] : 0;
}

std::uint32_t lightNumberOf(const FrameInput& input, std::size_t light) {
  return light < input.lightNumbers.size() ? input.lightNumbers[light] : static_cast<std::uint32_t>(light);
}

std::uint64_t cameraKeyOf(const FrameInput& input) {
  if (input.camera == nullptr) return 0;
  std::uint64_t key = kKeySeed;
  const scene::Camera& camera = *input.camera;
  for (const glm::dvec3& vector :
       {camera.eyeWorld, camera.targetWorld, camera.up,
        glm::dvec3(camera.verticalFovRadians, camera.nearDistance, camera.farDistance),
        glm::dvec3(input.aspectWidthOverHeight)}) {
    for (int i = 0; i < 3; ++i) key = combineKeys(key, std::bit_cast<std::uint64_t>(vector[i]));
  }
  return key;
}

/// What is kept of a light between frames.
struct FramePlanner::LightHistory {
  std::uint32_t number = 0;
  std::uint64_t lightRevision = 0, castersRevision = 0;
  int changedFramesRunning = 0;
  std::uint64_t key = 0;
  bool reduced = false;                 ///< the view lacks casters that no visible receiver needed
  std::vector<std::uint32_t> drawnIds;  ///< sorted
  std::vector<char> drawn;              ///< the same by object
  Relevance toAll, toVisible;           ///< receivers
  std::vector<std::uint32_t> casters;   ///< that were drawn, by index
  std::uint64_t castersKey = 0;         ///< sum of theirs
  std::uint64_t movesSeen = 0;          ///< up to which it is
  std::vector<char> relevant;           ///< by object, to any receiver
  bool relevantIsToAll = false;         ///< what `toAll` says
  std::uint64_t relevanceOf = 0;        ///< scene, light and camera that `toAll` was last asked for
};

FramePlanner::FramePlanner() = default;
FramePlanner::~FramePlanner() = default;
FramePlanner::FramePlanner(FramePlanner&&) noexcept = default;
FramePlanner& FramePlanner::operator=(FramePlanner&&) noexcept = default;

std::uint64_t FramePlanner::pairsAsked() const {
  std::uint64_t pairs = 0;
  for (const auto& history : histories_)
    pairs += history->toAll.pairsAsked() + history->toVisible.pairsAsked();
  return pairs;
}

FramePlanner::LightHistory& FramePlanner::historyOf(std::uint32_t number) {
  const auto found =
      std::ranges::find_if(histories_, [&](const auto& history) { return history->number == number; });
  if (found != histories_.end()) return **found;
  histories_.push_back(std::make_unique<LightHistory>());
  histories_.back()->number = number;
  return *histories_.back();
}

void FramePlanner::listObjects(const FrameInput& input) {
  keys_.clear(), known_.clear();
  castersRevision_ = sceneRevision_ = kKeySeed;
  casters_.clear(), receivers_.clear(), visible_.clear(), largestFirst_.clear();
  for (std::uint32_t i = 0; i < input.objects.size(); ++i) {
    const PlannedObject& object = input.objects[i];
    const bool exists = !object.boundsWorld.empty();
    keys_.push_back({.id = object.id});
    known_.push_back({.casts = object.casts});
    casters_.push_back(exists && object.casts ? 1 : 0);
    receivers_.push_back(exists && object.receives ? 1 : 0);
    if (receivers_.back()) largestFirst_.push_back(i);
  }
  visible_.assign(known_.size(), 0);
  std::ranges::stable_sort(largestFirst_, std::ranges::greater{},
                           [&](std::uint32_t i) { return input.objects[i].boundsWorld.radius(); });
}

/// Whether the camera sees the receiver, and from where on; `frontToBack_` stays sorted.
void FramePlanner::place(const FrameInput& input, const glm::dmat4& clipFromWorld, std::uint32_t object) {
  const auto before = std::ranges::find(receiversInOrder_, object);
  if (before != receiversInOrder_.end()) {
    frontToBack_.erase(frontToBack_.begin() + (before - receiversInOrder_.begin()));
    receiversInOrder_.erase(before);
  }
  const scene::Bounds& bounds = input.objects[object].boundsWorld;
  visible_[object] = receivers_[object] && (!input.camera || visibleIn(clipFromWorld, bounds)) ? 1 : 0;
  if (!visible_[object]) return;
  const Placed placed{input.camera ? nearestTo(input.camera->eyeWorld, bounds) : 0.0, object};
  const auto after = frontToBack_.insert(std::ranges::lower_bound(frontToBack_, placed), placed);
  receiversInOrder_.insert(receiversInOrder_.begin() + (after - frontToBack_.begin()), object);
}

void FramePlanner::findMoved(const FrameInput& input) {
  foundMoved_.clear(), foundChanges_.clear();
  const auto look = [&](std::uint32_t i) {
    const PlannedObject& object = input.objects[i];
    Known& known = known_[i];
    if (known.key != 0 && keys_[i].revision == object.revision) return;
    // Sums, so that one object's share changes without the others' being looked at.
    const std::uint64_t change = keyOf(object) - known.key;
    sceneRevision_ += change;
    if (known.casts) castersRevision_ += change;
    known.key += change;
    keys_[i].revision = object.revision;
    foundMoved_.push_back(i);
    foundChanges_.push_back(change);
  };
  if (input.changed && !objectsListed_) {
    std::vector<std::uint32_t> asked(input.changed->begin(), input.changed->end());
    std::ranges::sort(asked);
    for (const std::uint32_t i : asked) look(i);
  } else {
    for (std::uint32_t i = 0; i < known_.size(); ++i) look(i);
  }
  // Who looks again later is told of the last moves, not that nothing moved since.
  if (foundMoved_.empty() && !objectsListed_) return;
  movesRevision_ += objectsListed_ ? 2 : 1;
  moved_ = foundMoved_, keyChanges_ = foundChanges_;
}

/// Takes over what changed since the frame before.
void FramePlanner::observe(const FrameInput& input) {
  const bool told = input.changed && input.objects.size() == keys_.size();
  objectsListed_ = !told && !std::ranges::equal(input.objects, keys_, {}, &PlannedObject::id, &ObjectKey::id);
  if (objectsListed_) listObjects(input);
  findMoved(input);
  const std::uint64_t cameraNow = cameraKeyOf(input);
  glm::dmat4 clipFromWorld(1.0);
  if (input.camera) {
    clipFromWorld =
        scene::clipFromView(*input.camera, input.aspectWidthOverHeight) * scene::viewFromWorld(*input.camera);
  }
  if (objectsListed_ || cameraNow != cameraKey_ || foundMoved_.size() > kFewMoved) {
    frontToBack_.clear();
    for (std::uint32_t i = 0; i < known_.size(); ++i) {
      const scene::Bounds& bounds = input.objects[i].boundsWorld;
      visible_[i] = receivers_[i] && (!input.camera || visibleIn(clipFromWorld, bounds)) ? 1 : 0;
      if (visible_[i])
        frontToBack_.push_back({input.camera ? nearestTo(input.camera->eyeWorld, bounds) : 0.0, i});
    }
    // Coincident surfaces keep their order: which of them wins stays the same.
    std::ranges::sort(frontToBack_);
    receiversInOrder_.clear();
    for (const Placed& placed : frontToBack_) receiversInOrder_.push_back(placed.object);
  } else {
    for (const std::uint32_t i : foundMoved_) place(input, clipFromWorld, i);
  }
  cameraKey_ = cameraNow;
}

/// The sum of the keys of the casters that were drawn; where few moved since it was last asked for, they
/// alone are looked at.
std::uint64_t FramePlanner::castersKeyOf(LightHistory& history) const {
  if (const auto moved = moves().since(history.movesSeen)) {
    for (std::size_t k = 0; k < moved.places.size(); ++k) {
      if (history.drawn[moved.places[k]]) history.castersKey += keyChanges_[k];
    }
  } else {
    history.castersKey = 0;
    for (const std::uint32_t i : history.casters) history.castersKey += known_[i].key;
  }
  history.movesSeen = movesRevision_;
  return history.castersKey;
}

LightPlan FramePlanner::planLight(const FrameInput& input, std::size_t light, LightHistory& history,
                                  std::vector<Skip>& skips) {
  const std::uint64_t lightRevision = lightRevisionOf(input, light);
  const bool several = input.lights.size() > 1;
  const auto skipLight = [&](SkipReason reason) {
    skips.push_back({.subject = Skip::Subject::light, .reason = reason, .light = history.number});
  };
  const auto skipCaster = [&](std::uint32_t caster, SkipReason reason) {
    skips.push_back({.subject = Skip::Subject::caster,
                     .reason = reason,
                     .amongLights = several,
                     .id = input.objects[caster].id,
                     .light = history.number});
  };
  LightPlan plan;
  const std::uint64_t lightKey = combineKeys(kKeySeed, lightRevision);
  if (!shines(input.lights[light])) {
    plan.active = false;
    plan.contentKey = neverZero(lightKey);
    skipLight(SkipReason::lightOff);
    return plan;
  }
  const bool first = history.key == 0;
  const bool changed =
      first || history.lightRevision != lightRevision || history.castersRevision != castersRevision_;
  history.changedFramesRunning = changed && !first ? history.changedFramesRunning + 1 : 0;
  const bool dynamic = history.changedFramesRunning >= kChangesUntilDynamic;
  const std::uint64_t now = neverZero(combineKeys(combineKeys(sceneRevision_, lightRevision), cameraKey_));
  bool relevantChanged = false;
  if (input.receiversUnknown) {
    relevantChanged = history.relevant != casters_;
    history.relevant = casters_;
    history.relevantIsToAll = false;
    history.relevanceOf = 0;
  } else if (history.relevanceOf != now || objectsListed_) {
    history.relevanceOf = now;
    history.toAll.update(input, {keys_, moves()}, light, casters_, receivers_, largestFirst_);
    relevantChanged = history.toAll.changed();
    history.relevant.resize(known_.size());
    for (std::uint32_t i = 0; i < known_.size() && (relevantChanged || !history.relevantIsToAll); ++i)
      history.relevant[i] = history.toAll.canShadow(i) ? 1 : 0;
    history.relevantIsToAll = true;
  }
  if (!input.receiversUnknown) {
    for (const Relevance::Apart& apart : history.toAll.apart()) skipCaster(apart.caster, apart.reason);
  }
  if (objectsListed_ || history.drawn.size() != known_.size()) {
    history.drawn.assign(known_.size(), 0);
    for (std::uint32_t i = 0; i < known_.size(); ++i)
      history.drawn[i] = std::ranges::binary_search(history.drawnIds, keys_[i].id) ? 1 : 0;
  }

  // A complete view needs every relevant caster; one without those out of view, what this camera needs.
  const std::vector<char>* needed = &history.relevant;
  std::vector<char> neededInView;
  // Then none can be dropped.
  const bool allVisible = input.receiversUnknown || frontToBack_.size() == largestFirst_.size();
  if ((dynamic || history.reduced) && !allVisible) {
    history.toVisible.update(input, {keys_, moves()}, light, history.relevant, visible_, largestFirst_);
    neededInView.resize(known_.size());
    for (std::uint32_t i = 0; i < known_.size(); ++i)
      neededInView[i] = history.toVisible.canShadow(i) ? 1 : 0;
    needed = &neededInView;
  }
  const auto isNeeded = [&](std::uint32_t i) { return (*needed)[i] != 0; };
  bool allDrawn = true;
  const bool drawnAreRelevant = history.drawn == history.relevant;
  for (std::uint32_t i = 0; i < known_.size() && !(drawnAreRelevant && needed == &history.relevant); ++i)
    allDrawn = allDrawn && (!isNeeded(i) || history.drawn[i]);
  // The cached view may hold more than is needed: it stays.
  const bool cached = !dynamic && !changed && !relevantChanged && allDrawn;
  const bool complete = !dynamic && !cached;
  if (complete) needed = &history.relevant;
  bool anyOutOfView = false;
  std::uint64_t key = lightKey;
  // All that is needed, as in the frame before: mostly so, though one of them moved.
  const bool sameDrawn = !cached && needed == &history.relevant && !objectsListed_ && drawnAreRelevant &&
                         !history.casters.empty();
  if (sameDrawn) {
    plan.casters = history.casters;
    key += castersKeyOf(history);
  }
  for (std::uint32_t i = 0; i < known_.size() && !sameDrawn; ++i) {
    const bool drawn = cached ? casters_[i] && history.drawn[i] : isNeeded(i);
    if (drawn) {
      plan.casters.push_back(i);
      key += known_[i].key;
    } else if (history.relevant[i]) {
      skipCaster(i, SkipReason::shadowOutOfView);
      anyOutOfView = true;
    }
    if (!cached) history.drawn[i] = drawn ? 1 : 0;
  }
  if (!cached) history.reduced = anyOutOfView;
  plan.contentKey = neverZero(key);
  plan.active = !plan.casters.empty();
  if (!plan.active) {
    skipLight(SkipReason::noCasters);
  } else if (plan.contentKey == history.key) {
    skipLight(SkipReason::unchanged);
  }
  history.lightRevision = lightRevision;
  history.castersRevision = castersRevision_;
  history.key = plan.contentKey;
  if (sameDrawn) return plan;
  history.casters = plan.casters;
  history.castersKey = key - lightKey;
  history.movesSeen = movesRevision_;
  history.drawnIds.clear();
  for (const std::uint32_t caster : plan.casters) history.drawnIds.push_back(keys_[caster].id);
  if (!std::ranges::is_sorted(history.drawnIds)) std::ranges::sort(history.drawnIds);
  return plan;
}

void FramePlanner::listReceivers(const FrameInput& input, FramePlan& plan) const {
  plan.receivers = receiversInOrder_;
  if (frontToBack_.size() == largestFirst_.size()) return;
  for (std::uint32_t i = 0; i < known_.size(); ++i) {
    if (!receivers_[i] || visible_[i]) continue;
    plan.skips.push_back({.subject = Skip::Subject::receiver,
                          .reason = SkipReason::receiverOutOfView,
                          .id = input.objects[i].id});
  }
}

FramePlan FramePlanner::plan(const FrameInput& input) {
  FramePlan plan;
  observe(input);
  plan.sceneRevision = sceneRevision_;
  listReceivers(input, plan);
  for (std::size_t light = 0; light < input.lights.size(); ++light) {
    plan.lights.push_back(planLight(input, light, historyOf(lightNumberOf(input, light)), plan.skips));
  }
  // Of lights that are gone.
  std::erase_if(histories_, [&](const auto& history) {
    for (std::size_t light = 0; light < input.lights.size(); ++light) {
      if (lightNumberOf(input, light) == history->number) return false;
    }
    return true;
  });
  return plan;
}

}  // namespace halfshadow::planner
