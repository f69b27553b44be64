// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// Which casters can shadow which receivers, kept from frame to frame (internal to engine/planner).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "planner/frame_planner.hpp"
#include "planner/light_space.hpp"
#include "planner/separation.hpp"

namespace halfshadow::planner {

/// Of one light and a set of receivers. For each caster one receiver is known that it can shadow, or that
/// there is none: so when an object moves, only it is asked about again, those casters whose known receiver
/// it was, and of those without one whether it is one. A search through all follows only from a light that
/// moves.
class Relevance {
 public:
  /// The objects, by index.
  struct Objects {
    std::span<const ObjectKey> keys;
    ListChanges changes;
  };
  /// `casters` and `receivers`: by object. Receivers are tried in the order of `likelyFirst`, which names all
  /// of them.
  void update(const FrameInput& input, const Objects& objects, std::size_t light,
              const std::vector<char>& casters, const std::vector<char>& receivers,
              std::span<const std::uint32_t> likelyFirst);
  /// The last update found another answer for some caster.
  bool changed() const { return changed_; }
  bool canShadow(std::uint32_t caster) const { return verdicts_[caster].kind == Verdict::Kind::canShadow; }
  struct Apart {
    std::uint32_t caster = 0;
    SkipReason reason = SkipReason::noReceiverBehind;
  };
  /// Casters that shadow none of the receivers.
  const std::vector<Apart>& apart() const { return apart_; }
  /// Pairs of caster and receiver that were looked at, since it was made.
  std::uint64_t pairsAsked() const { return pairsAsked_; }

 private:
  struct Verdict {
    enum class Kind : std::uint8_t { unknown, noCaster, canShadow, apart } kind = Kind::unknown;
    SkipReason reason = SkipReason::noReceiverBehind;  ///< where it is apart
    std::uint32_t receiver = 0;                        ///< that it can shadow
  };
  struct Known {
    std::uint32_t id = 0;
    std::uint64_t revision = 0;
    bool receives = false;  ///< was in the set
  };
  void forgetMoved(std::span<const ObjectKey> keys, std::span<const std::uint32_t> moved);
  void forgetChanged(std::span<const ObjectKey> keys, const std::vector<char>& receivers);
  void judge(const FrameInput& input, std::uint32_t caster, std::span<const std::uint32_t> likelyFirst);
  void askAgainByCamera(const FrameInput& input);
  bool meets(const FrameInput& input, std::uint32_t caster, std::uint32_t receiver, SkipReason& reason);
  Verdict searched(const FrameInput& input, std::uint32_t caster, std::span<const std::uint32_t> likelyFirst);

  std::uint64_t lightRevision_ = 0, cameraKey_ = 0;
  scene::AreaLight light_;
  LightSpace space_;
  Separation separation_;
  std::vector<Known> known_;  ///< by index, as all that follows
  std::vector<Verdict> verdicts_;
  std::vector<char> casters_, receivers_;  ///< of the last update
  std::vector<char> couldShadow_;          ///< in the update before
  std::vector<char> fresh_;                ///< receivers that are new in the set or moved
  std::vector<std::uint32_t> freshReceivers_;
  std::vector<std::uint32_t> asked_;  ///< casters whose verdicts are to be looked at
  std::vector<Apart> apart_;
  std::uint64_t seen_ = 0;  ///< revision of the objects
  bool changed_ = false;
  std::uint64_t pairsAsked_ = 0;
};

}  // namespace halfshadow::planner
