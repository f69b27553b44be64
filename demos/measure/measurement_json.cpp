// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "measure/measurement_json.hpp"

namespace halfshadow::measure {
namespace {
Json vectorJson(const glm::dvec3& vector) {
  return Json::array({vector.x, vector.y, vector.z});
}

Json toJson(const ErrorSet& errors) {
  return {{"receiver", measure::toJson(errors.receiver)},
          {"penumbra", measure::toJson(errors.penumbra)},
          {"penumbra_roughness", errors.penumbraRoughness}};
}

Json toJson(const TimeStatistics& time) {
  if (time.frames == 0) return nullptr;
  return {{"median", time.medianMs}, {"p95", time.p95Ms}, {"min", time.minMs}, {"frames", time.frames}};
}

}  // namespace

Json toJson(const metrics::ErrorStatistics& statistics) {
  return {{"mae", statistics.mae},       {"rmse", statistics.rmse},
          {"bias", statistics.bias},     {"p99", statistics.p99},
          {"max", statistics.max},       {"share_over_2_255", statistics.shareOver2Of255},
          {"pixels", statistics.pixels}, {"nan_pixels", statistics.nanPixels}};
}

Json toJson(const Counters& counters) {
  return {{"passes", counters.passes},
          {"framebuffer_switches", counters.framebufferSwitches},
          {"draws", counters.draws},
          {"triangles", counters.triangles},
          {"taps_per_pixel", counters.tapsPerPixel},
          {"bytes_loaded", counters.bytesLoaded},
          {"bytes_stored", counters.bytesStored},
          {"texture_bytes_uploaded", counters.textureBytesUploaded},
          {"buffer_bytes_uploaded", counters.bufferBytesUploaded},
          {"silhouettes_extracted", counters.silhouettesExtracted},
          {"casters_drawn", counters.castersDrawn},
          {"casters_kept", counters.castersKept}};
}

Json toJson(const PassMeasurement& pass) {
  return {{"name", pass.name},
          {"target", pass.target},
          {"draws", pass.draws},
          {"triangles", pass.triangles},
          {"clear", pass.clear},
          {"load", pass.load},
          {"store", pass.store},
          {"discard", pass.discard},
          {"light_space", pass.lightSpace},
          {"bytes_loaded", pass.bytesLoaded},
          {"bytes_stored", pass.bytesStored},
          {"time_ms", pass.timeMs}};
}

Json toJson(const std::vector<Setting>& settings) {
  Json json = Json::object();
  for (const Setting& setting : settings) json[setting.key] = setting.value;
  return json;
}

Json toJson(const std::vector<SkipMeasurement>& skips) {
  Json json = Json::array();
  for (const SkipMeasurement& skip : skips) json.push_back({{"what", skip.what}, {"why", skip.why}});
  return json;
}

Json toJson(const TechniqueMeasurement& measurement) {
  Json json{{"id", measurement.id},
            {"settings", toJson(measurement.settings)},
            {"supported", measurement.supported}};
  if (!measurement.supported) {
    json["reason"] = measurement.unsupportedReason;
    return json;
  }
  if (!measurement.measured()) {
    json["failed"] = measurement.failure;
    return json;
  }
  json["error"] = toJson(measurement.error);
  json["error_by_kind"] = {{"ground", toJson(measurement.errorOnGround)},
                           {"caster", toJson(measurement.errorOnCasters)}};
  json["time_ms"] = toJson(measurement.time);
  json["time_static_ms"] = toJson(measurement.timeStatic);
  json["memory_bytes"] = measurement.memoryBytes;
  json["counters"] = toJson(measurement.counters);
  json["counters_static"] = toJson(measurement.countersStatic);
  json["passes"] = Json::array();
  for (const PassMeasurement& pass : measurement.passes) json["passes"].push_back(toJson(pass));
  json["skipped"] = toJson(measurement.skipped);
  return json;
}

Json driverJson(const DriverRecord& driver) {
  return {{"vendor", driver.vendor}, {"renderer", driver.renderer}, {"version", driver.version}};
}

Json lightJson(const scene::AreaLight& light) {
  return {{"center", vectorJson(light.centerWorld)},
          {"u", vectorJson(light.halfU)},
          {"v", vectorJson(light.halfV)}};
}

Json toJson(const scene::SceneDescription& scene, const DriverRecord& driver, const Truth& truth,
            const std::vector<TechniqueMeasurement>& techniques) {
  Json json{
      {"scene", scene.name},
      {"size", {truth.width, truth.height}},
      {"driver", driverJson(driver)},
      {"light", lightJson(scene.lights.front())},
      {"camera",
       {{"eye", vectorJson(scene.camera->eyeWorld)},
        {"target", vectorJson(scene.camera->targetWorld)},
        {"up", vectorJson(scene.camera->up)},
        {"vertical_fov_radians", scene.camera->verticalFovRadians},
        {"near", scene.camera->nearDistance},
        {"far", scene.camera->farDistance}}},
      {"truth",
       {{"samples", truth.samples}, {"noise_rmse", truth.noiseRmse}, {"origin_lift", truth.originLiftWorld}}},
      {"pixels", {{"receiver", truth.receiverPixels}, {"penumbra", truth.penumbraPixels}}},
      {"notes", scene.notes}};
  json["techniques"] = Json::array();
  for (const TechniqueMeasurement& technique : techniques) json["techniques"].push_back(toJson(technique));
  return json;
}

}  // namespace halfshadow::measure
