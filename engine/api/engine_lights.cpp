// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include <algorithm>

#include "api/draw_items.hpp"
#include "api/engine_state.hpp"
#include "api/frame_desc.hpp"
#include "api/receiver_reach.hpp"
#include "base/keys.hpp"
#include "planner/light_reach.hpp"

namespace halfshadow {
namespace {
constexpr std::uint32_t kNoNumber = ~0u;
/// Texels a side of maps with casters far off the light's axis, and how many times those asked for: of the
/// widest window the middle is as fine as that of an ordinary one with as many as were asked for.
constexpr int kMostMapSize = 4096, kMostGrowth = 4;

/// With equal shadows, if not of equal colour.
bool castsAlike(const scene::AreaLight& a, const scene::AreaLight& b) {
  return a.centerWorld == b.centerWorld && a.halfU == b.halfU && a.halfV == b.halfV &&
         a.emission == b.emission && (a.intensity > 0) == (b.intensity > 0);
}
}  // namespace

void Engine::State::setLights(std::vector<scene::AreaLight> checked) {
  const bool none = checked.empty();
  if (none) checked.push_back({.intensity = 0.0f});
  if (checked == lights && hasLights == !none) return;
  if (hasLights == none) {
    // The dark light that stands for none is nobody's light of before or after.
    lights.clear();
    lightRevisions.clear();
    lightNumbers.clear();
  }
  hasLights = !none;
  std::vector<std::uint32_t> numbers(checked.size(), kNoNumber);
  std::vector<std::uint64_t> revisions(checked.size(), 0);
  std::vector<bool> known(lights.size(), false);
  const auto take = [&](std::size_t now, std::size_t before, std::uint64_t revision) {
    known[before] = true;
    numbers[now] = lightNumbers[before];
    revisions[now] = revision;
  };
  // A light with the same values is the same light, wherever it stands: nothing of it is remade.
  for (std::size_t i = 0; i < std::min(checked.size(), lights.size()); ++i) {
    if (castsAlike(checked[i], lights[i])) take(i, i, lightRevisions[i]);
  }
  for (std::size_t i = 0; i < checked.size(); ++i) {
    for (std::size_t k = 0; k < lights.size() && numbers[i] == kNoNumber; ++k) {
      if (!known[k] && castsAlike(checked[i], lights[k])) take(i, k, lightRevisions[k]);
    }
  }
  // Among as many as before, one with other values is the one that stood in its place, if that is not found
  // elsewhere; else it is new.
  const bool asMany = checked.size() == lights.size();
  for (std::size_t i = 0; asMany && i < checked.size(); ++i) {
    if (numbers[i] == kNoNumber && !known[i]) take(i, i, nextRevision++);
  }
  for (std::size_t i = 0; i < checked.size(); ++i) {
    if (numbers[i] != kNoNumber) continue;
    std::uint32_t number = 0;
    while (std::ranges::find(numbers, number) != numbers.end()) ++number;
    numbers[i] = number;
    revisions[i] = nextRevision++;
  }
  lights = std::move(checked);
  lightRevisions = std::move(revisions);
  lightNumbers = std::move(numbers);
  ++changes;
}

void Engine::State::fitLight(std::size_t light, const planner::LightPlan& plan) {
  LightCache& cache = cacheOf(light);
  const int mapSize = settings->integer("map_size");
  if (cache.key == plan.contentKey && cache.mapSize == mapSize) return;
  const std::uint64_t seen = cache.casterShapes.changes().revision;
  const auto shapeOf = [&](std::uint32_t index) -> Result<planner::CasterShape> {
    return lists.object(index).shape();
  };
  (void)cache.casterShapes.follow(
      plan.casters, lists.changes(), [&](std::uint32_t index) { return api::keyOf(lists, index); }, shapeOf);
  const ListChanges shapeChanges = cache.casterShapes.changes();
  if (const auto places = shapeChanges.since(seen)) {
    for (const std::uint32_t place : places.places) cache.castersWorld.changed(place);
  } else {
    cache.castersWorld.forget();
  }
  const std::span<const planner::CasterShape> shapes = cache.casterShapes.values();
  const scene::Bounds castersWorld = cache.castersWorld.total(
      shapes.size(), [&](scene::Bounds& all, std::size_t place) { all.include(shapes[place].boundsWorld); },
      [](scene::Bounds& all, const scene::Bounds& part) { all.include(part); });
  cache.light = planner::lightWithinReach(lights[light], castersWorld);
  const int mostMapSize =
      std::min({kMostGrowth * mapSize, kMostMapSize, context->capabilities().limits.textureSize});
  cache.fit = cache.fitter.fit(cache.light, cache.casterShapes.values(),
                               {.mapSize = mapSize, .mostMapSize = mostMapSize}, shapeChanges);
  cache.key = plan.contentKey;
  cache.mapSize = mapSize;
  cache.reachKey = 0;
}

void Engine::State::noteHoles(Frame& frame, std::size_t light, const std::string& id,
                              std::span<const techniques::DrawItem> casters) const {
  const auto cut = std::ranges::count_if(casters, [](const techniques::DrawItem& item) {
    if (item.alphaMask == nullptr) return false;
    (void)item.halfEdges();
    return item.geometry->isCoarse();
  });
  if (cut == 0) return;
  frame.graph.noteSkipped(nameOf(light) + " holes of " + std::to_string(cut) + " casters",
                          id + " takes casters by their outlines, which follow alpha coarsely where it cuts "
                               "finer than 60,000 triangles can");
}

void Engine::State::listCasters(LightCache& cache, const planner::LightPlan& plan) {
  const ListChanges objectChanges = lists.changes();
  const ListChanges::Since moved =
      cache.casters.isOf(plan.casters) ? objectChanges.since(cache.shadowlessSeen) : ListChanges::Since{};
  cache.shadowlessSeen = 0;
  const bool stay = moved && std::ranges::all_of(moved.places, [&](std::uint32_t index) {
                      return std::ranges::binary_search(plan.casters, index);
                    });
  if (!stay) {
    // A caster that shadows nothing was left out of the casters, but it is a receiver like any other.
    cache.shadowless.clear();
    auto caster = plan.casters.begin();  // in the order of objects
    for (std::uint32_t i = 0; i < lists.planned().size(); ++i) {
      const bool casts = caster != plan.casters.end() && *caster == i;
      if (casts) ++caster;
      if (!casts && lists.planned()[i].receives) cache.shadowless.push_back(i);
    }
  }
  api::updateItems(cache.casters, lists, plan.casters, api::ItemRole::caster);
  api::updateItems(cache.shadowlessReceivers, lists, cache.shadowless, api::ItemRole::shadowless);
  cache.shadowlessSeen = objectChanges.revision;
}

Status Engine::State::declareLight(Frame& frame, techniques::FramePasses& passes, std::size_t index,
                                   const planner::FramePlan& framePlan) {
  const planner::LightPlan& plan = framePlan.lights[index];
  FrameLight& target = frame.lights[index];
  LightCache& cache = cacheOf(index);
  fitLight(index, plan);
  listCasters(cache, plan);
  techniques::Technique* used = technique;
  const bool shadowsNothing = !plan.active || cache.fit.empty || plan.casters.empty();
  if (shadowsNothing) {
    frame.graph.noteSkipped(nameOf(index) + " shadows",
                            std::string(planner::skipText(planner::SkipReason::noCasters)));
    used = techniqueNamed("none");
  }
  if (!shadowsNothing && cache.fit.growth > 1) {
    frame.graph.noteSkipped(nameOf(index) + " map_size",
                            "casters-off-axis: casters lie so far to the sides that the light's map has " +
                                std::to_string(cache.fit.mapSize) + " texels a side instead of " +
                                std::to_string(cache.mapSize));
  }
  auto choice = choiceFor(frame, index, *used);
  if (!choice) return choice.error();
  const std::uint64_t sceneKey = combineKeys(plan.contentKey, framePlan.sceneRevision);
  double receiverFarDistance = receiverReach(cache, sceneKey);
  if (frame.desc.receivers == Receivers::unknown)
    receiverFarDistance = std::max(receiverFarDistance, 4.0 * cache.fit.farthestCaster);
  const LightRequest request{index, plan.contentKey, sceneKey, receiverFarDistance, plan.casters};
  const bool hostEvaluates = frame.desc.output == Output::lightsOnly;
  if (const auto standIn = choice->technique->standIn(sceneFor(frame, request, *choice).scene)) {
    const std::string outcome = hostEvaluates ? "; kept, since " + standIn->id + " works on the screen only"
                                              : "; " + standIn->id + " takes the light";
    frame.graph.noteSkipped(nameOf(index) + " " + choice->technique->info().id, standIn->reason + outcome);
    if (!hostEvaluates) choice = choiceFor(frame, index, *techniqueNamed(standIn->id));
    if (!choice) return choice.error();
  }
  choice = prepared(frame, request, std::move(choice).value());
  if (!choice) return choice.error();
  if (choice->settings->choice("shading") == "apart") frame.shading = api::Shading::apart;
  target.technique = choice->technique;
  const techniques::TechniqueInfo& info = target.technique->info();
  if (info.takesOutlines) noteHoles(frame, index, info.id, cache.casters.values());
  auto shading = shadingOf(passes, index);
  if (!shading) return shading.error();
  target.shading = std::move(shading).value();
  target.allLit = shadowsNothing;
  chooseForward(target, cache);
  if (hostEvaluates) {
    for (const auto resource : techniques::resourcesRead(target.shading)) frame.graph.markOutput(resource);
    return {};
  }
  const techniques::ReceiverRequest programsAsked{.output = api::receiverOutput(frame.desc, frame.shading),
                                                  .lights = {&lights[index], 1},
                                                  .depthIsComplete = index > 0};
  auto linked = techniques::receiverPrograms(*programs, target.shading, programsAsked, frame.receivers);
  if (!linked) return linked.error();
  target.programs = *linked;
  return {};
}

double Engine::State::receiverReach(LightCache& cache, std::uint64_t sceneKey) const {
  if (cache.reachKey == sceneKey) return cache.reach.farthest();
  cache.reachKey = sceneKey;
  return cache.reach.update(cache.fit, lists.planned(), lists.changes());
}

SplitScene Engine::State::sceneFor(const Frame& frame, const LightRequest& request,
                                   const api::LightFallbacks::Choice& choice) {
  LightCache& cache = cacheOf(request.light);
  std::string splitReason;
  const planner::SubLights* subLights =
      cache.split.update({.light = cache.light,
                          .fit = cache.fit,
                          .casters = cache.casterShapes.values(),
                          .casterChanges = cache.casterShapes.changes(),
                          .receiverFarDistance = request.receiverFarDistance,
                          .contentKey = request.contentKey,
                          .mostTexels = context->capabilities().limits.textureSize},
                         *choice.technique, *choice.settings, splitReason);
  return {{.capabilities = context->capabilities(),
           .settings = *choice.settings,
           .screen = frame.view,
           .channel = static_cast<int>(request.light),
           .name = nameOf(request.light),
           .light = cache.light,
           .center = {.fit = cache.fit,
                      .casters = cache.casters.values(),
                      .contentKey = request.contentKey,
                      .sceneKey = request.sceneKey},
           .subLights = subLights,
           .casterShapes = cache.casterShapes.values(),
           .receiverFarDistance = request.receiverFarDistance,
           .casters = cache.casters.values(),
           .groups = cache.groups,
           .silhouettes = cache.silhouettes,
           .receivers = frame.receivers,
           .shadowlessReceivers = cache.shadowlessReceivers.values(),
           .contentKey = request.contentKey,
           .sceneKey = request.sceneKey,
           .workers = workers,
           .countsFetches = frame.desc.output == Output::taps},
          std::move(splitReason)};
}

Status Engine::State::prepareLight(Frame& frame, const LightRequest& request,
                                   const api::LightFallbacks::Choice& choice) {
  LightCache& cache = cacheOf(request.light);
  const SplitScene split = sceneFor(frame, request, choice);
  if (!split.reason.empty()) frame.graph.noteSkipped(nameOf(request.light) + " sub-lights", split.reason);
  if (cache.passesOf != choice.technique) {
    cache.passesOf = choice.technique;
    cache.passes = std::make_unique<techniques::LightPasses>(choice.technique->newPlanner());
    cache.silhouettes = {};  // another technique may see casters from other points
  }
  const std::uint64_t before = cache.silhouettes.extracted();
  Status prepared = cache.passes->prepare(split.scene, cache.casters.keys(), cache.casters.changes());
  frame.silhouettesExtracted += cache.silhouettes.extracted() - before;
  return prepared;
}

Result<api::LightFallbacks::Choice> Engine::State::prepared(Frame& frame, const LightRequest& request,
                                                            api::LightFallbacks::Choice choice) {
  LightCache& cache = cacheOf(request.light);
  techniques::Technique& asked = *choice.technique;
  api::Refusal& refusal = cache.refusal;
  techniques::Technique* instead = techniqueNamed("pcss-mip");
  const bool refused = refusal.technique == &asked && refusal.settings == choice.settings->revision() &&
                       std::ranges::equal(refusal.casters, request.casters);
  if (!refused) {
    const Status planned = prepareLight(frame, request, choice);
    if (planned) return choice;
    // Only what was planned, on the CPU, can be planned otherwise; a host that evaluates asked for this one.
    const bool hostEvaluates = frame.desc.output == Output::lightsOnly;
    if (planned.error().code != ErrorCode::outOfMemory || hostEvaluates || &asked == instead)
      return planned.error();
    refusal = {.technique = &asked,
               .casters = {request.casters.begin(), request.casters.end()},
               .settings = choice.settings->revision(),
               .why = planned.error().message};
  }
  frame.graph.noteSkipped(nameOf(request.light) + " " + asked.info().id,
                          refusal.why + "; pcss-mip takes the light");
  auto taken = choiceFor(frame, request.light, *instead);
  if (!taken) return taken.error();
  if (Status s = prepareLight(frame, request, *taken); !s) return s.error();
  return taken;
}

Result<techniques::ReceiverShading> Engine::State::shadingOf(techniques::FramePasses& passes,
                                                             std::size_t index) {
  LightCache& cache = cacheOf(index);
  techniques::Device device{*context, *programs, shared, lists.anyCutOut()};
  if (Status s = cache.passes->upload(device); !s) return s.error();
  return cache.passes->declare(passes);
}

}  // namespace halfshadow
