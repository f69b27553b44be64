// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include <cstdio>

#include "api/engine_state.hpp"
#include "techniques/parts/maps/light_depth.hpp"

namespace halfshadow {

DriverRecord Engine::driver() const {
  const device::Capabilities& capabilities = state_->context->capabilities();
  const char* rounding = "other";
  if (capabilities.probes.byteRounding == device::ByteRounding::nearest) rounding = "nearest";
  if (capabilities.probes.byteRounding == device::ByteRounding::truncate) rounding = "truncate";
  return {.vendor = capabilities.driver.vendor.c_str(),
          .renderer = capabilities.driver.renderer.c_str(),
          .version = capabilities.driver.version.c_str(),
          .shadingLanguageVersion = capabilities.driver.shadingLanguageVersion.c_str(),
          .depthStorage = techniques::depthStorageName(techniques::depthStorageFor(capabilities)),
          .byteRounding = rounding,
          .highpMantissaBits = capabilities.probes.highpMantissaBits,
          .mediumpMantissaBits = capabilities.probes.mediumpMantissaBits,
          .maxTextureSize = capabilities.limits.textureSize,
          .maxVaryingVectors = capabilities.limits.varyingVectors,
          .maxFragmentUniformVectors = capabilities.limits.fragmentUniformVectors,
          .maxVertexUniformVectors = capabilities.limits.vertexUniformVectors,
          .maxFragmentTextureUnits = capabilities.limits.fragmentTextureUnits,
          .maxVertexTextureUnits = capabilities.limits.vertexTextureUnits,
          .maxVertexAttributes = capabilities.limits.vertexAttributes,
          .maxRenderbufferSize = capabilities.limits.renderbufferSize};
}

std::size_t Engine::capabilityCount() const {
  return device::kCapabilityCount;
}

CapabilityRecord Engine::capability(std::size_t index) const {
  if (index >= device::kCapabilityCount) return {};
  const auto which = static_cast<device::Capability>(index);
  const device::CapabilityState& state = state_->context->capabilities().state(which);
  return {.name = device::capabilityName(which).data(),
          .text = device::capabilityText(which).data(),
          .available = state.outcome == device::ProbeOutcome::available,
          .reason = state.reason.c_str()};
}

std::size_t Engine::extensionCount() const {
  return state_->context->capabilities().extensions.size();
}
const char* Engine::extension(std::size_t index) const {
  return index < extensionCount() ? state_->context->capabilities().extensions[index].c_str() : "";
}

std::size_t Engine::techniqueCount() const {
  return state_->techniques.size();
}

TechniqueRecord Engine::technique(std::size_t index) const {
  if (index >= techniqueCount()) return {};
  const techniques::TechniqueInfo& info = state_->techniques[index]->info();
  const std::string& reason = state_->techniqueReasons[index];
  return {.id = info.id.c_str(),
          .paper = info.paper.c_str(),
          .summary = info.summary.c_str(),
          .guarantees = info.guarantees.c_str(),
          .knownFailures = info.knownFailures.c_str(),
          .supported = reason.empty(),
          .unsupportedReason = reason.c_str()};
}

std::size_t Engine::settingCount() const {
  return state_->settings->declared().size();
}

SettingRecord Engine::setting(std::size_t index) const {
  if (index >= settingCount()) return {};
  try {
    return state_->settingRecord(index);
  } catch (...) {
    return {};
  }
}

SettingRecord Engine::State::settingRecord(std::size_t index) {
  const techniques::SettingInfo& info = settings->declared()[index];
  std::vector<std::string>& texts = settingTexts;
  const std::size_t count = settings->declared().size();
  if (texts.size() != 2 * count) texts.resize(2 * count);
  std::string& allowed = texts[2 * index];
  std::string& value = texts[2 * index + 1];
  allowed.clear();
  if (info.type == techniques::SettingType::choice) {
    for (const std::string& choice : info.choices) allowed += (allowed.empty() ? "" : ", ") + choice;
  } else {
    char range[64];
    std::snprintf(range, sizeof range, "%g to %g", info.low, info.high);
    allowed = range;
  }
  value = settings->text(info.key);
  const char* type = info.type == techniques::SettingType::choice    ? "choice"
                     : info.type == techniques::SettingType::integer ? "integer"
                                                                     : "real";
  return {.key = info.key.c_str(),
          .type = type,
          .defaultValue = info.defaultValue.c_str(),
          .value = value.c_str(),
          .allowed = allowed.c_str(),
          .text = info.text.c_str()};
}

}  // namespace halfshadow
