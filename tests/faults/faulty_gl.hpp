// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// A driver that fails at one call. It stands between an engine and the process's driver.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <string>

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
  int inside = 0;                     ///< above 0 while the driver itself works
  std::map<std::string, long> alive;  ///< names made and not deleted, by kind
  void arm(Fault what, std::uint64_t call);
  void disarm();
};
FaultyDriver& faultyDriver();

/// Of an engine on the process's context, through the faulty driver.
EngineDesc faultyDesc(HostState hostState = HostState::leaveDirty);
std::unique_ptr<Engine> makeFaultyEngine(HostState hostState = HostState::leaveDirty);

}  // namespace halfshadow::test
