// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// A driver that fails at one call. It stands between an engine and the process's driver.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "halfshadow/halfshadow.hpp"

namespace halfshadow::test {

enum class Fault {
  none,
  outOfMemory,  ///< the call does nothing, and GL_OUT_OF_MEMORY is the next glGetError's answer
  invalid,      ///< the same with GL_INVALID_OPERATION
  dropped,      ///< the call does nothing and says nothing
  refused,      ///< status queries answer "incomplete", "not compiled", "not linked"; other calls as dropped
  lost          ///< the host tells the engine, from inside the call, that the context is gone
};
const char* faultName(Fault fault);

/// The process's one faulty driver.
struct FaultyDriver {
  Fault fault = Fault::none;
  std::uint64_t failingCall = 0;  ///< counted from 0 since calls was set to 0
  std::uint64_t calls = 0;        ///< glGetError not counted: it has nothing to fail at
  std::uint64_t queries = 0;      ///< of those, and of glGetError, what asks the driver something
  std::function<void()> onLost;   ///< what the host does
  bool gone = false;              ///< the context is: calls are counted as callsAfterLoss and do nothing
  std::uint64_t callsAfterLoss = 0;
  const char* failedAt = "";  ///< the entry point
  /// A draw whose vertices are not where it was told would read anywhere: it is dropped, as by a driver that
  /// checks.
  bool drawsAreUnsafe = false;
  int inside = 0;                                                ///< above 0 while the driver itself works
  using Names = std::map<std::string, std::set<std::uint32_t>>;  ///< by kind
  Names alive;         ///< made, and not deleted as far as the caller knows
  Names left;          ///< what a deletion that failed left in the driver
  long strangers = 0;  ///< names that were deleted and were not alive
  void arm(Fault what, std::uint64_t call);
  /// Ends the fault, and deletes what it left.
  void disarm();
  /// Deletes what is alive, as the end of a context does: the one that follows knows none of those names.
  void endContext();
  /// How many names are alive.
  std::size_t aliveCount() const;
};
FaultyDriver& faultyDriver();

/// Each so-manieth call fails: HALFSHADOW_TEST_FAULT_STRIDE, else `bounded`.
std::uint64_t faultStride(std::uint64_t bounded);
/// HALFSHADOW_TEST_TECHNIQUES, separated by commas, else all of the engine's.
std::vector<std::string> faultedTechniques(Engine& engine);

/// Of an engine on the process's context, through the faulty driver.
EngineDesc faultyDesc(HostState hostState = HostState::leaveDirty);
std::unique_ptr<Engine> makeFaultyEngine(HostState hostState = HostState::leaveDirty);

}  // namespace halfshadow::test
