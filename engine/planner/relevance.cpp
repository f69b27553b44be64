// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "planner/relevance.hpp"

#include <algorithm>

namespace halfshadow::planner {

/// Takes over what the objects are now: `fresh_`, and verdicts that rest on what is no more. Where the sets
/// are the same and it is known what moved.
void Relevance::forgetMoved(std::span<const ObjectKey> keys, std::span<const std::uint32_t> moved) {
  for (const std::uint32_t i : freshReceivers_) fresh_[i] = 0;
  freshReceivers_.clear();
  for (const std::uint32_t i : moved) {
    if (receivers_[i]) {
      fresh_[i] = 1;
      freshReceivers_.push_back(i);
    }
    separation_.forget(i);
    verdicts_[i].kind = Verdict::Kind::unknown;
    known_[i].revision = keys[i].revision;
    asked_.push_back(i);
  }
  for (std::uint32_t i = 0; i < verdicts_.size() && !freshReceivers_.empty(); ++i) {
    Verdict& verdict = verdicts_[i];
    if (verdict.kind != Verdict::Kind::canShadow || !fresh_[verdict.receiver]) continue;
    verdict.kind = Verdict::Kind::unknown;
    asked_.push_back(i);
  }
  for (const Apart& apart : apart_) asked_.push_back(apart.caster);
}

/// The same of all.
void Relevance::forgetChanged(std::span<const ObjectKey> keys, const std::vector<char>& receivers) {
  const std::size_t count = keys.size();
  fresh_.assign(count, 0);
  freshReceivers_.clear();
  for (std::uint32_t i = 0; i < count; ++i) {
    Known& known = known_[i];
    const bool moved = known.revision != keys[i].revision;
    if (receivers[i] && (moved || !known.receives)) {
      fresh_[i] = 1;
      freshReceivers_.push_back(i);
    }
    if (moved) {
      separation_.forget(i);
      verdicts_[i].kind = Verdict::Kind::unknown;
      // Not the witness of anyone until it is asked.
      known.receives = false;
    }
    known.revision = keys[i].revision;
  }
  for (Verdict& verdict : verdicts_) {
    const bool rests = verdict.kind != Verdict::Kind::canShadow ||
                       (receivers[verdict.receiver] && known_[verdict.receiver].receives);
    if (!rests) verdict.kind = Verdict::Kind::unknown;
  }
  for (std::uint32_t i = 0; i < count; ++i) {
    known_[i].receives = receivers[i] != 0;
    asked_.push_back(i);
  }
}

/// The camera moved, and what was decided by where it was may be decided otherwise now.
void Relevance::askAgainByCamera(const FrameInput& input) {
  const std::uint64_t cameraNow = cameraKeyOf(input);
  const bool moved = cameraNow != cameraKey_;
  cameraKey_ = cameraNow;
  const std::vector<Separation::ByCamera> pairs = separation_.takeByCamera();
  for (const Separation::ByCamera& pair : pairs) {
    const Verdict& verdict = verdicts_[pair.caster];
    const bool matters = verdict.kind == Verdict::Kind::apart ||
                         (verdict.kind == Verdict::Kind::canShadow && verdict.receiver == pair.receiver);
    if (!matters || fresh_[pair.receiver]) continue;
    if (moved && separation_.cannotShadow(pair.caster, pair.receiver) != pair.cannotShadow) {
      verdicts_[pair.caster].kind = Verdict::Kind::unknown;
      asked_.push_back(pair.caster);
    }
    if (!moved) separation_.keepByCamera(pair);
  }
}

/// Whether the caster can shadow the receiver; `reason` becomes what keeps it from doing so.
bool Relevance::meets(const FrameInput& input, std::uint32_t caster, std::uint32_t receiver,
                      SkipReason& reason) {
  ++pairsAsked_;
  // The cheaper proof first: a ground is asked about everything that stands on it.
  if (separation_.cannotShadow(caster, receiver)) {
    reason = SkipReason::nothingBeyond;
    return false;
  }
  return shadowRegionMeets(light_, space_, input.objects[caster].boundsWorld,
                           input.objects[receiver].boundsWorld);
}

Relevance::Verdict Relevance::searched(const FrameInput& input, std::uint32_t caster,
                                       std::span<const std::uint32_t> likelyFirst) {
  if (space_.boundsLight(input.objects[caster].boundsWorld).high.z <= 0.0)
    return {Verdict::Kind::apart, SkipReason::behindLight, 0};
  Verdict verdict{.kind = Verdict::Kind::apart};
  for (const std::uint32_t receiver : likelyFirst) {
    if (receivers_[receiver] && meets(input, caster, receiver, verdict.reason))
      return {Verdict::Kind::canShadow, SkipReason::noReceiverBehind, receiver};
  }
  return verdict;
}

void Relevance::judge(const FrameInput& input, std::uint32_t caster,
                      std::span<const std::uint32_t> likelyFirst) {
  Verdict& verdict = verdicts_[caster];
  if (!casters_[caster]) {
    verdict.kind = Verdict::Kind::noCaster;
  } else if (verdict.kind == Verdict::Kind::unknown || verdict.kind == Verdict::Kind::noCaster) {
    verdict = searched(input, caster, likelyFirst);
  } else if (verdict.kind == Verdict::Kind::apart && verdict.reason != SkipReason::behindLight) {
    for (const std::uint32_t receiver : freshReceivers_) {
      if (!meets(input, caster, receiver, verdict.reason)) continue;
      verdict = {Verdict::Kind::canShadow, SkipReason::noReceiverBehind, receiver};
      break;
    }
  }
}

void Relevance::update(const FrameInput& input, const Objects& objects, std::size_t light,
                       const std::vector<char>& casters, const std::vector<char>& receivers,
                       std::span<const std::uint32_t> likelyFirst) {
  const std::size_t count = input.objects.size();
  const std::uint64_t lightRevision = lightRevisionOf(input, light);
  const bool sameLight = lightRevision == lightRevision_;
  const auto moved = sameLight && casters == casters_ && receivers == receivers_
                         ? objects.changes.since(seen_)
                         : ListChanges::Since{};
  seen_ = 0;
  const bool anew =
      !moved && (!sameLight || !std::ranges::equal(objects.keys, known_, {}, &ObjectKey::id, &Known::id));
  light_ = input.lights[light];
  space_ = lightSpace(light_);
  lightRevision_ = lightRevision;
  separation_.begin(input, light_, anew);
  if (anew) {
    verdicts_.assign(count, {});
    known_.resize(count);
    for (std::size_t i = 0; i < count; ++i) known_[i] = {.id = objects.keys[i].id};
  }
  asked_.clear();
  if (moved) {
    forgetMoved(objects.keys, moved.places);
  } else {
    casters_ = casters, receivers_ = receivers;
    forgetChanged(objects.keys, receivers);
  }
  askAgainByCamera(input);
  std::ranges::sort(asked_);
  const auto repeated = std::ranges::unique(asked_);
  asked_.erase(repeated.begin(), repeated.end());
  changed_ = couldShadow_.size() != count;
  couldShadow_.resize(count, 0);
  apart_.clear();
  for (const std::uint32_t i : asked_) {
    judge(input, i, likelyFirst);
    const char can = canShadow(i) ? 1 : 0;
    changed_ = changed_ || couldShadow_[i] != can;
    couldShadow_[i] = can;
    if (verdicts_[i].kind == Verdict::Kind::apart) apart_.push_back({i, verdicts_[i].reason});
  }
  seen_ = objects.changes.revision;
}

}  // namespace halfshadow::planner
