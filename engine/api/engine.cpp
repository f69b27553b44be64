// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include <cmath>

#include "api/engine_state.hpp"

namespace halfshadow {
Outcome Engine::State::fail(const Error& error) {
  message = error.message;
  return {error.code, message.c_str()};
}

gl::HostStatePolicy Engine::State::policy() const {
  switch (hostState) {
    case HostState::restore:
      return gl::HostStatePolicy::restore;
    case HostState::leaveDefaults:
      return gl::HostStatePolicy::leaveDefaults;
    case HostState::leaveDirty:
      break;
  }
  return gl::HostStatePolicy::leaveDirty;
}

Outcome Engine::setTechnique(const char* id) {
  return state_->guarded([&] { return state_->setTechnique(id); });
}

Outcome Engine::State::setTechnique(const char* id) {
  State& state = *this;
  const std::string_view wanted = id ? id : "";
  std::string known;
  for (const auto& each : state.techniques) {
    known += (known.empty() ? "" : ", ") + each->info().id;
    if (each->info().id != wanted) continue;
    const techniques::Support support = each->support(state.context->capabilities());
    if (!support.supported) {
      return state.fail(
          {ErrorCode::capabilityMissing, "technique " + std::string(wanted) + " needs " + support.reason});
    }
    if (state.technique != each.get()) ++state.changes;
    state.technique = each.get();
    return {};
  }
  return state.fail(
      {ErrorCode::unknownTechnique, "unknown technique \"" + std::string(wanted) + "\"; known: " + known});
}

Outcome Engine::set(const char* key, const char* value) {
  if (key == nullptr || value == nullptr) {
    return {ErrorCode::invalidArgument, "a setting needs a key and a value, e.g. pcf.size=7"};
  }
  return state_->guarded([&] {
    const Status status = state_->settings->set(key, value);
    return status ? Outcome{} : state_->fail(status.error());
  });
}

Outcome Engine::setLights(const LightDesc* descs, std::size_t count) {
  return state_->guarded([&] { return state_->setLights(descs, count); });
}

Outcome Engine::State::setLights(const LightDesc* descs, std::size_t count) {
  State& state = *this;
  if (descs == nullptr && count > 0) {
    return state.fail(
        {ErrorCode::invalidArgument, "setLights needs an array of as many lights as it is told"});
  }
  if (count > static_cast<std::size_t>(kMaxLights)) {
    return state.fail({ErrorCode::invalidArgument, "at most 4 lights: visibility has one channel each"});
  }
  std::vector<scene::AreaLight> checked;
  for (std::size_t i = 0; i < count; ++i) {
    const LightDesc& desc = descs[i];
    const auto vector = [](const double v[3]) { return glm::dvec3(v[0], v[1], v[2]); };
    auto light = scene::areaLightFromVectors(vector(desc.center), vector(desc.halfU), vector(desc.halfV));
    if (!light) return state.fail(light.error());
    if (glm::length(light->halfU) == 0.0) {
      const glm::dvec3 emission = vector(desc.emission);
      if (!(glm::length(emission) > 0.0) || !std::isfinite(glm::length(emission))) {
        return state.fail(
            {ErrorCode::invalidLight, "a point light needs a finite, non-zero emission direction"});
      }
      light->emission = glm::normalize(emission);
    }
    light->color = {desc.color[0], desc.color[1], desc.color[2]};
    light->intensity = desc.intensity;
    light->referenceDistance = desc.referenceDistance;
    if (!std::isfinite(desc.color[0] + desc.color[1] + desc.color[2] + desc.intensity)) {
      return state.fail({ErrorCode::invalidLight, "the light's colour or intensity is not finite"});
    }
    if (!std::isfinite(desc.referenceDistance) || desc.referenceDistance < 0.0) {
      return state.fail(
          {ErrorCode::invalidLight, "the light's reference distance is negative or not finite"});
    }
    const double inner = desc.innerConeRadians, outer = desc.outerConeRadians;
    constexpr double kWidest = 1.5707963267948968;
    if (outer != 0.0 && !(inner >= 0.0 && inner < outer && outer <= kWidest)) {
      return state.fail({ErrorCode::invalidLight,
                         "the light's cones need 0 <= inner < outer <= pi / 2 radians, or an outer of 0"});
    }
    light->innerConeRadians = inner;
    light->outerConeRadians = outer;
    checked.push_back(*light);
  }
  state.setLights(std::move(checked));
  return {};
}

}  // namespace halfshadow
