// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "techniques/none/none.hpp"

namespace halfshadow::techniques {
namespace {
class None final : public Technique {
 public:
  const TechniqueInfo& info() const override {
    static const TechniqueInfo info{.id = "none",
                                    .paper = "",
                                    .summary = "no shadows",
                                    .guarantees = "visibility is 1 everywhere",
                                    .knownFailures = "every shadow is missing"};
    return info;
  }
  Result<ReceiverShading> declare(const LightFrame&) override {
    return ReceiverShading{.fragmentFile = "receiver/none.frag"};
  }
};
}  // namespace

std::unique_ptr<Technique> makeNone() {
  return std::make_unique<None>();
}

}  // namespace halfshadow::techniques
