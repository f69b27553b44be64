// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "techniques/core/technique.hpp"

namespace halfshadow::techniques {

Result<ReceiverShading> Technique::declare(const LightFrame&) {
  return Error{ErrorCode::internal, "technique " + info().id + " has neither planner nor passes"};
}

}  // namespace halfshadow::techniques
