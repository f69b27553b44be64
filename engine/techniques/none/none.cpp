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
  std::vector<ShaderFamily> shaderFamilies() const override {
    return receiverFamilies("receiver/none.frag", {});
  }
  std::unique_ptr<LightPlanner> newPlanner() const override {
    return std::make_unique<PlainPlanner<&plan>>();
  }

 private:
  static Status plan(const LightScene&, PassPlan& plan) {
    plan.shading.fragmentFile = "receiver/none.frag";
    return {};
  }
};
}  // namespace

std::unique_ptr<Technique> makeNone() {
  return std::make_unique<None>();
}

}  // namespace halfshadow::techniques
