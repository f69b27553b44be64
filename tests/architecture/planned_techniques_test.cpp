// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// tests/plans runs without GL and so without the registry: its list of techniques is held against it here.
#include <gtest/gtest.h>

#include <algorithm>

#include "planned_techniques.hpp"
#include "techniques/registry/registry.hpp"

namespace halfshadow::architecture {
namespace {

TEST(PlannedTechniques, AreThoseOfTheRegistryThatHaveAPlanner) {
  std::vector<std::string> inRegistry, tested;
  for (const auto& technique : techniques::makeAllTechniques()) {
    if (technique->newPlanner()) inRegistry.push_back(technique->info().id);
  }
  for (const auto& technique : test::plannedTechniques()) tested.push_back(technique->info().id);
  std::ranges::sort(inRegistry);
  std::ranges::sort(tested);
  EXPECT_EQ(tested, inRegistry) << "add what is missing to tests/plans/planned_techniques.hpp";
}

}  // namespace
}  // namespace halfshadow::architecture
