// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "techniques/execution/map_updates.hpp"

#include <algorithm>
#include <limits>

#include "base/keys.hpp"

namespace halfshadow::techniques {
namespace {
/// Texels that a GPU which renders by tiles loads in the time of a draw call, when a target is not cleared,
/// by a model, not measured: phones read some 2.5 thousand million texels of 4 bytes a second, and their
/// drivers take some 10 microseconds for a call; two thirds of that, so that an update surely gains. For a
/// map of 1024 x 1024 texels it must save 64 draws.
constexpr std::uint64_t kTexelsPerCall = 1 << 14;

const MeshDraw& meshesOf(const PlannedDraw& draw) {
  return std::get<MeshDraw>(draw.what);
}

bool sameMeshes(const MeshDraw& a, const MeshDraw& b) {
  return a.clipFromWorld == b.clipFromWorld && a.clipFromObject == b.clipFromObject &&
         a.streams == b.streams && a.faces == b.faces && a.eyeWorld == b.eyeWorld &&
         a.nearReach == b.nearReach;
}

/// But for items, and for what textures hold.
bool sameDraw(const PlannedDraw& a, const PlannedDraw& b) {
  const auto sameSampler = [](const TextureRead& x, const TextureRead& y) { return x.sampler == y.sampler; };
  return a.state == b.state && a.viewport == b.viewport && a.uniforms == b.uniforms &&
         std::ranges::equal(a.textures, b.textures, sameSampler) && sameMeshes(meshesOf(a), meshesOf(b));
}

bool overlap(const Rect& a, const Rect& b) {
  return a.x < b.x + b.width && b.x < a.x + a.width && a.y < b.y + b.height && b.y < a.y + a.height;
}
}  // namespace

UpdateRule updateRuleOf(const Settings& settings) {
  const std::string& rule = settings.choice("map_updates");
  if (rule == "never") return UpdateRule::never;
  return rule == "always" ? UpdateRule::always : UpdateRule::worthwhile;
}

/// It draws objects alone, and clears what it keeps under a key.
bool MapUpdates::isFollowed(const PlannedPass& pass) const {
  if (pass.contentKey == 0 || pass.drawsForAllLights || pass.draws.empty()) return false;
  bool keeps = false;
  for (const framegraph::Attachment& write : pass.writes) {
    const framegraph::ResourceDesc& image = plan_->images[write.resource.index];
    if (write.initial != framegraph::InitialContent::clear) return false;
    if (std::max(image.width, image.height) > std::numeric_limits<std::int16_t>::max()) return false;
    keeps = keeps || image.lifetime == framegraph::Lifetime::persistent;
  }
  return keeps && std::ranges::all_of(pass.draws, [](const PlannedDraw& draw) {
           return std::holds_alternative<MeshDraw>(draw.what) && !draw.state.scissor;
         });
}

/// 0 where it is not known what a texture holds.
std::uint64_t MapUpdates::readKeyOf(const PlannedDraw& draw) const {
  std::uint64_t key = 1;
  for (const TextureRead& read : draw.textures) {
    std::uint64_t content = 0;
    if (read.own) content = plan_->textures[*read.own].key;
    for (const PlannedPass& pass : plan_->passes) {
      const bool writes =
          !read.own && std::ranges::find(pass.writes, read.resource, &framegraph::Attachment::resource) !=
                           pass.writes.end();
      if (writes) content = pass.contentKey;
    }
    if (content == 0) return 0;
    key = combineKeys(key, content);
  }
  return key;
}

MapWindow MapUpdates::windowOf(const PlannedPass& pass, const PlannedDraw& draw) const {
  const framegraph::ResourceDesc& target = plan_->images[pass.writes.front().resource.index];
  return {meshesOf(draw).clipFromWorld, draw.viewport.value_or(Rect{0, 0, target.width, target.height})};
}

std::uint32_t MapUpdates::listOf(std::span<const DrawItem> items) {
  const auto known = std::ranges::find_if(listsNow_, [&](const ListNow& list) {
    return list.items.data() == items.data() && list.items.size() == items.size();
  });
  const auto index = static_cast<std::uint32_t>(known - listsNow_.begin());
  if (known == listsNow_.end()) listsNow_.push_back({items});
  return index;
}

void MapUpdates::begin(const PassPlan& plan, UpdateRule rule, const KeyedItems& casters) {
  plan_ = &plan;
  counts_ = {};
  listsNow_.clear();
  passes_.assign(plan.passes.size(), {});
  std::size_t followed = 0;
  for (std::size_t i = 0; i < plan.passes.size(); ++i) {
    PassNow& now = passes_[i];
    now.followed = isFollowed(plan.passes[i]);
    if (!now.followed) continue;
    ++followed;
    for (const PlannedDraw& draw : plan.passes[i].draws) now.lists.push_back(listOf(meshesOf(draw).items));
  }
  lists_.resize(listsNow_.size());
  if (rule == UpdateRule::never) {
    drawn_.clear();
    return;
  }
  for (std::size_t i = 0; i < plan.passes.size(); ++i) {
    if (passes_[i].followed) follow(plan.passes[i], passes_[i], rule, casters);
  }
  if (drawn_.size() <= followed) return;
  std::erase_if(drawn_, [&](const auto& drawn) {
    return std::ranges::find(plan.passes, drawn.first, &PlannedPass::name) == plan.passes.end();
  });
}

void MapUpdates::follow(const PlannedPass& pass, PassNow& now, UpdateRule rule, const KeyedItems& casters) {
  const auto known = drawn_.find(pass.name);
  now.changed = known == drawn_.end() || known->second.contentKey != pass.contentKey;
  if (!now.changed) return;
  for (const std::uint32_t list : now.lists) {
    if (listsNow_[list].takenOver) continue;
    const std::span<const DrawItem> items = listsNow_[list].items;
    const bool keyed = items.data() == casters.items.data() && items.size() == casters.items.size();
    if (keyed) {
      lists_[list].update(items, casters.keys, nextGeneration_, casters.changes);
    } else {
      lists_[list].update(items, {}, nextGeneration_);
    }
    listsNow_[list].takenOver = true;
  }
  if (known == drawn_.end()) return;
  now.alike = isDrawnAlike(pass, known->second);
  if (!now.alike || !findParts(pass, known->second, now)) return;
  findItems(pass, known->second, now);
  if (rule == UpdateRule::always || pays(pass, now)) now.fromKey = known->second.contentKey;
}

bool MapUpdates::isDrawnAlike(const PlannedPass& pass, const DrawnPass& drawn) const {
  if (pass.writes != drawn.writes || pass.draws.size() != drawn.draws.size()) return false;
  for (std::size_t i = 0; i < pass.draws.size(); ++i) {
    const DrawnDraw& before = drawn.draws[i];
    const std::uint64_t readKey = readKeyOf(pass.draws[i]);
    if (readKey == 0 || readKey != before.readKey || !sameDraw(pass.draws[i], before.draw) ||
        plan_->programs[pass.draws[i].program] != before.program)
      return false;
  }
  return true;
}

bool MapUpdates::findParts(const PlannedPass& pass, const DrawnPass& drawn, PassNow& now) const {
  struct Seen {
    Rect viewport;
    TexelRect part;
  };
  std::vector<Seen> views;
  for (std::size_t i = 0; i < pass.draws.size(); ++i) {
    const ItemHistory& list = lists_[now.lists[i]];
    const std::uint64_t generation = drawn.draws[i].generation;
    const bool same = generation == list.generation();
    if (!same && (generation == 0 || generation != list.generationBefore())) return false;
    const MapWindow window = windowOf(pass, pass.draws[i]);
    auto view = std::ranges::find(views, window.viewport, &Seen::viewport);
    if (view == views.end()) {
      // What one view clears, another must not have drawn.
      const auto meets = [&](const Seen& other) { return overlap(other.viewport, window.viewport); };
      if (std::ranges::any_of(views, meets)) return false;
      view = views.insert(views.end(), {window.viewport, {}});
    }
    if (same) continue;
    for (const ItemHistory::Change& change : list.changes()) {
      view->part.include(window.texelsOf(change.boundsBefore));
      view->part.include(window.texelsOf(change.boundsAfter));
    }
  }
  for (const Seen& view : views) {
    if (!view.part.empty()) now.clearedParts.push_back(view.part.rect());
  }
  for (const PlannedDraw& draw : pass.draws) {
    const Rect viewport = windowOf(pass, draw).viewport;
    now.parts.push_back({std::ranges::find(views, viewport, &Seen::viewport)->part, {}});
  }
  return true;
}

void MapUpdates::findItems(const PlannedPass& pass, DrawnPass& drawn, PassNow& now) {
  for (std::size_t i = 0; i < pass.draws.size(); ++i) {
    DrawPart& part = now.parts[i];
    ItemPlaces& places = drawn.draws[i].places;
    places.update(lists_[now.lists[i]], windowOf(pass, pass.draws[i]));
    const std::span<const TexelRect> texels = places.texels();
    for (std::uint32_t item = 0; item < texels.size(); ++item) {
      if (texels[item].meets(part.part)) part.items.push_back(item);
    }
  }
}

bool MapUpdates::pays(const PlannedPass& pass, const PassNow& now) const {
  std::uint64_t saved = 0, loaded = 0;
  for (std::size_t i = 0; i < now.parts.size(); ++i) {
    const ItemHistory& list = lists_[now.lists[i]];
    saved += list.work();
    for (const std::uint32_t item : now.parts[i].items) saved -= list.items()[item].work;
  }
  for (const framegraph::Attachment& write : pass.writes) {
    const framegraph::ResourceDesc& image = plan_->images[write.resource.index];
    if (image.lifetime == framegraph::Lifetime::persistent)
      loaded += static_cast<std::uint64_t>(image.width) * static_cast<std::uint64_t>(image.height);
  }
  return saved * kTexelsPerCall >= loaded;
}

framegraph::Update MapUpdates::updateOf(std::size_t pass) const {
  const PassNow& now = passes_[pass];
  if (now.fromKey == 0) return {};
  return {.fromKey = now.fromKey, .parts = now.clearedParts};
}

void MapUpdates::drawn(std::size_t pass, Extent extent) {
  const PlannedPass& planned = plan_->passes[pass];
  const PassNow& now = passes_[pass];
  if (!now.followed) return;
  for (std::size_t i = 0; i < planned.draws.size(); ++i) {
    const std::size_t all = meshesOf(planned.draws[i]).items.size();
    const std::size_t some = extent == Extent::update ? now.parts[i].items.size() : all;
    counts_.drawn += some;
    counts_.kept += all - some;
  }
  if (now.changed) remember(planned, now, drawn_[planned.name]);
}

void MapUpdates::remember(const PlannedPass& pass, const PassNow& now, DrawnPass& drawn) const {
  drawn.contentKey = pass.contentKey;
  if (!now.alike) {
    drawn.writes = pass.writes;
    drawn.draws.clear();
    for (const PlannedDraw& draw : pass.draws) {
      DrawnDraw& known = drawn.draws.emplace_back(
          DrawnDraw{.program = plan_->programs[draw.program], .draw = draw, .readKey = readKeyOf(draw)});
      std::get<MeshDraw>(known.draw.what).items = {};  // they live until the frame ends
    }
  }
  for (std::size_t i = 0; i < drawn.draws.size(); ++i)
    drawn.draws[i].generation = lists_[now.lists[i]].generation();
}

}  // namespace halfshadow::techniques
