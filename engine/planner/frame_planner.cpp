// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "planner/frame_planner.hpp"

#include <algorithm>
#include <bit>
#include <optional>

#include "base/keys.hpp"
#include "planner/light_space.hpp"
#include "planner/separation.hpp"

namespace halfshadow::planner {
namespace {

constexpr int kChangesUntilDynamic = 2;
constexpr std::uint64_t kKeySeed = 0x68616c66736861ull;

bool shines(const scene::AreaLight& light) {
  return light.intensity > 0.0 && std::max({light.color.r, light.color.g, light.color.b}) > 0.0f;
}

// Receivers with large boxes first: they are the likeliest to be shadowed, so that searches end early.
std::vector<std::uint32_t> largestFirst(const FrameInput& input, std::vector<std::uint32_t> receivers) {
  std::stable_sort(receivers.begin(), receivers.end(), [&](std::uint32_t a, std::uint32_t b) {
    return input.objects[a].boundsWorld.radius() > input.objects[b].boundsWorld.radius();
  });
  return receivers;
}

/// By the distance at which each may begin, so that what lies behind is rejected before its visibility is
/// computed. Coincident surfaces keep their order: which of them wins stays the same.
void sortFrontToBack(const FrameInput& input, std::vector<std::uint32_t>& receivers) {
  std::vector<double> nearest(input.objects.size());
  for (const std::uint32_t i : receivers) {
    const scene::Bounds& bounds = input.objects[i].boundsWorld;
    const glm::dvec3& eye = input.camera->eyeWorld;
    nearest[i] = glm::length(glm::max(glm::max(bounds.low - eye, eye - bounds.high), glm::dvec3(0.0)));
  }
  std::ranges::stable_sort(receivers, {}, [&](std::uint32_t i) { return nearest[i]; });
}

/// What keeps a caster from all of `receivers`; nothing when it can shadow one of them.
std::optional<SkipReason> apartFrom(const FrameInput& input, const scene::AreaLight& light,
                                    Separation& separation, std::uint32_t caster,
                                    const std::vector<std::uint32_t>& receivers) {
  SkipReason reason = SkipReason::noReceiverBehind;
  for (const std::uint32_t receiver : receivers) {
    // The cheaper proof first: a ground is asked about everything that stands on it.
    if (separation.cannotShadow(caster, receiver)) {
      reason = SkipReason::nothingBeyond;
    } else if (shadowRegionMeets(light, input.objects[caster].boundsWorld,
                                 input.objects[receiver].boundsWorld)) {
      return std::nullopt;
    }
  }
  return reason;
}

std::uint64_t keyOf(const FrameInput& input, std::uint64_t lightRevision,
                    const std::vector<std::uint32_t>& casters) {
  std::uint64_t key = combineKeys(kKeySeed, lightRevision);
  for (const std::uint32_t caster : casters) {
    key = combineKeys(combineKeys(key, input.objects[caster].id), input.objects[caster].revision);
  }
  return key == 0 ? 1 : key;
}

std::uint64_t cameraKeyOf(const FrameInput& input) {
  if (input.camera == nullptr) return 0;
  std::uint64_t key = kKeySeed;
  const scene::Camera& camera = *input.camera;
  for (const glm::dvec3& vector :
       {camera.eyeWorld, camera.targetWorld, camera.up,
        glm::dvec3(camera.verticalFovRadians, camera.nearDistance, input.aspectWidthOverHeight)}) {
    for (int i = 0; i < 3; ++i) key = combineKeys(key, std::bit_cast<std::uint64_t>(vector[i]));
  }
  return key;
}

std::string casterName(const FrameInput& input, std::uint32_t caster, std::size_t light) {
  std::string name = "caster " + std::to_string(input.objects[caster].id);
  if (input.lights.size() > 1) name += " for light " + std::to_string(light);
  return name;
}

}  // namespace

std::string_view skipCode(SkipReason reason) {
  switch (reason) {
#define HALFSHADOW_SKIP_CODE(name, code, text) \
  case SkipReason::name:                       \
    return code;
    HALFSHADOW_SKIP_LIST(HALFSHADOW_SKIP_CODE)
#undef HALFSHADOW_SKIP_CODE
  }
  return "unknown";
}

std::string_view skipText(SkipReason reason) {
  switch (reason) {
#define HALFSHADOW_SKIP_TEXT(name, code, text) \
  case SkipReason::name:                       \
    return text;
    HALFSHADOW_SKIP_LIST(HALFSHADOW_SKIP_TEXT)
#undef HALFSHADOW_SKIP_TEXT
  }
  return "unknown";
}

// Based on: Steele, Lea and Flood 2014, "Fast splittable pseudorandom number generators", section 4 (the
// finaliser's constants); the seed is mixed first, so that the order of values matters.
FramePlanner::Revisions FramePlanner::revisionsOf(const FrameInput& input) {
  Revisions revisions{kKeySeed, kKeySeed};
  for (const PlannedObject& object : input.objects) {
    const std::uint64_t roles = (object.casts ? 2u : 0u) + (object.receives ? 1u : 0u);
    revisions.scene =
        combineKeys(combineKeys(combineKeys(revisions.scene, object.id), object.revision), roles);
    if (object.casts)
      revisions.casters = combineKeys(combineKeys(revisions.casters, object.id), object.revision);
  }
  return revisions;
}

void FramePlanner::findRelevant(const FrameInput& input, std::size_t light, const Receivers& receivers,
                                LightHistory& history) {
  history.relevant.clear();
  history.irrelevant.clear();
  const LightSpace space = lightSpace(input.lights[light]);
  Separation separation(input, input.lights[light]);
  for (std::uint32_t i = 0; i < input.objects.size(); ++i) {
    const PlannedObject& object = input.objects[i];
    if (!object.casts || object.boundsWorld.empty()) continue;
    if (space.boundsLight(object.boundsWorld).high.z <= 0.0) {
      history.irrelevant.push_back({casterName(input, i, light), SkipReason::behindLight});
    } else if (const auto apart = apartFrom(input, input.lights[light], separation, i, receivers.all)) {
      history.irrelevant.push_back({casterName(input, i, light), *apart});
    } else {
      history.relevant.push_back(i);
    }
  }
  history.byCamera.clear();
  for (const auto& [caster, receiver, cannotShadow] : separation.byCamera()) {
    history.byCamera.push_back({caster, receiver, cannotShadow});
  }
  history.cameraKey = cameraKeyOf(input);
}

/// The camera moved, and what was decided by where it was is decided otherwise now.
bool FramePlanner::relevanceIsStale(const FrameInput& input, std::size_t light, LightHistory& history) {
  if (history.byCamera.empty()) return false;
  const std::uint64_t cameraNow = cameraKeyOf(input);
  if (cameraNow == history.cameraKey) return false;
  history.cameraKey = cameraNow;
  Separation separation(input, input.lights[light]);
  return std::ranges::any_of(history.byCamera, [&](const LightHistory::ByCamera& known) {
    return separation.cannotShadow(known.caster, known.receiver) != known.cannotShadow;
  });
}

LightPlan FramePlanner::planLight(const FrameInput& input, std::size_t light, const Receivers& receivers,
                                  const Revisions& revisions, LightHistory& history,
                                  std::vector<Skip>& skips) {
  const std::uint64_t lightRevision = light < input.lightRevisions.size() ? input.lightRevisions[light] : 0;
  const std::string lightName = "light " + std::to_string(light);
  LightPlan plan;
  if (!shines(input.lights[light])) {
    plan.active = false;
    plan.contentKey = keyOf(input, lightRevision, {});
    skips.push_back({lightName, SkipReason::lightOff});
    return plan;
  }
  const bool first = history.key == 0;
  const bool changed =
      first || history.lightRevision != lightRevision || history.castersRevision != revisions.casters;
  history.changedFramesRunning = changed && !first ? history.changedFramesRunning + 1 : 0;
  const bool dynamic = history.changedFramesRunning >= kChangesUntilDynamic;
  const std::uint64_t sceneNow = combineKeys(revisions.scene, lightRevision);
  bool relevantChanged = false;
  if (first || sceneNow != history.sceneRevision || relevanceIsStale(input, light, history)) {
    const std::vector<std::uint32_t> before = history.relevant;
    findRelevant(input, light, receivers, history);
    relevantChanged = before != history.relevant;
  }
  skips.insert(skips.end(), history.irrelevant.begin(), history.irrelevant.end());

  // A complete view needs every relevant caster; one without those out of view, what this camera needs.
  std::vector<std::uint32_t> needed = history.relevant, outOfView;
  const bool allVisible = receivers.visible.size() == receivers.all.size();  // then none can be dropped
  if ((dynamic || history.reduced) && !allVisible) {
    Separation separation(input, input.lights[light]);
    const auto split = std::stable_partition(needed.begin(), needed.end(), [&](std::uint32_t caster) {
      return !apartFrom(input, input.lights[light], separation, caster, receivers.visible);
    });
    outOfView.assign(split, needed.end());
    needed.erase(split, needed.end());
  }
  const auto drawnBefore = [&](std::uint32_t caster) {
    return std::ranges::binary_search(history.drawnIds, input.objects[caster].id);
  };
  if (dynamic) {
    plan.casters = needed;
    history.reduced = !outOfView.empty();
  } else if (!changed && !relevantChanged && std::all_of(needed.begin(), needed.end(), drawnBefore)) {
    // The cached view holds all that is needed, perhaps more: it stays.
    for (std::uint32_t i = 0; i < input.objects.size(); ++i) {
      if (input.objects[i].casts && drawnBefore(i)) plan.casters.push_back(i);
    }
    std::erase_if(outOfView, drawnBefore);
  } else {
    plan.casters = history.relevant;
    history.reduced = false;
    outOfView.clear();
  }
  for (const std::uint32_t caster : outOfView) {
    skips.push_back({casterName(input, caster, light), SkipReason::shadowOutOfView});
  }

  plan.contentKey = keyOf(input, lightRevision, plan.casters);
  plan.active = !plan.casters.empty();
  if (!plan.active) {
    skips.push_back({lightName, SkipReason::noCasters});
  } else if (plan.contentKey == history.key) {
    skips.push_back({lightName, SkipReason::unchanged});
  }
  history.lightRevision = lightRevision;
  history.castersRevision = revisions.casters;
  history.sceneRevision = sceneNow;
  history.key = plan.contentKey;
  history.drawnIds.clear();
  for (const std::uint32_t caster : plan.casters) history.drawnIds.push_back(input.objects[caster].id);
  std::ranges::sort(history.drawnIds);
  return plan;
}

FramePlan FramePlanner::plan(const FrameInput& input) {
  FramePlan plan;
  Receivers receivers;
  glm::dmat4 clipFromWorld(1.0);
  if (input.camera) {
    clipFromWorld =
        scene::clipFromView(*input.camera, input.aspectWidthOverHeight) * scene::viewFromWorld(*input.camera);
  }
  for (std::uint32_t i = 0; i < input.objects.size(); ++i) {
    const PlannedObject& object = input.objects[i];
    if (!object.receives || object.boundsWorld.empty()) continue;
    receivers.all.push_back(i);
    if (!input.camera || visibleIn(clipFromWorld, object.boundsWorld)) {
      plan.receivers.push_back(i);
    } else {
      plan.skips.push_back({"receiver " + std::to_string(object.id), SkipReason::receiverOutOfView});
    }
  }
  receivers.all = largestFirst(input, std::move(receivers.all));
  receivers.visible = largestFirst(input, plan.receivers);
  if (input.camera) sortFrontToBack(input, plan.receivers);
  history_.resize(input.lights.size());
  const Revisions revisions = revisionsOf(input);
  plan.sceneRevision = revisions.scene;
  for (std::size_t light = 0; light < input.lights.size(); ++light) {
    plan.lights.push_back(planLight(input, light, receivers, revisions, history_[light], plan.skips));
  }
  return plan;
}

}  // namespace halfshadow::planner
