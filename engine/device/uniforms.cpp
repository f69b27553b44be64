// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "device/uniforms.hpp"

#include <algorithm>

namespace halfshadow::device {

void UniformList::set(UniformKey key, UniformValue value) {
  const auto found = std::ranges::find(entries_, key.hash, [](const Entry& e) { return e.key.hash; });
  if (found != entries_.end()) {
    found->value = std::move(value);
  } else {
    entries_.push_back({key, std::move(value)});
  }
}

}  // namespace halfshadow::device
