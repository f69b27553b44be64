// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// Traces what the accuracy suite compares with. Runs first (a CTest fixture), so that the suite's
// configurations, which may run side by side, only read.
#include "truth.hpp"

#include <algorithm>
#include <set>

#include "reference/reference.hpp"

namespace halfshadow::test {
namespace {

TEST(Truth, HasGroundPenumbraeAndCasterSurfacesInEveryScene) {
  std::set<std::string> names(kBenchmarkScenes.begin(), kBenchmarkScenes.end());
  names.insert(kAcneScenes.begin(), kAcneScenes.end());
  for (const std::string& name : names) {
    const Truth& truth = truthOf(name);
    ASSERT_EQ(truth.visibility.size(), static_cast<std::size_t>(kWidth) * kHeight);
    // Fewer would make a mean over penumbra pixels a matter of chance.
    EXPECT_GE(std::ranges::count(truth.penumbraOnGround(), 1), 100) << name;
    EXPECT_GE(std::ranges::count(truth.kind, reference::kCasterReceiver), 300) << name;
    const auto interior = std::ranges::count(truth.interior, 1);
    EXPECT_GE(interior, kWidth * kHeight / 2) << name << ": too few pixels away from outlines to judge by";
    for (const float value : truth.visibility) ASSERT_TRUE(value >= 0.0f && value <= 1.0f) << name;
  }
}

}  // namespace
}  // namespace halfshadow::test
