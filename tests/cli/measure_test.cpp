// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include <algorithm>
#include <fstream>
#include <glm/glm.hpp>
#include <sstream>

#include "cli_process.hpp"
#include "images/images.hpp"
#include "metrics/metrics.hpp"

namespace halfshadow::cli_tests {
namespace {
using nlohmann::json;

std::vector<std::string> measureBox(const std::vector<std::string>& more) {
  std::vector<std::string> arguments{"measure", "builtin:box", "--size", "64x48", "--samples", "64"};
  arguments.insert(arguments.end(), more.begin(), more.end());
  return arguments;
}

void expectFields(const json& object, const std::vector<std::string>& names) {
  for (const std::string& name : names)
    EXPECT_TRUE(object.contains(name)) << name << " is missing in " << object;
}

std::vector<float> channelOf(const std::string& file, const char* channel) {
  const auto image = images::readImage(file);
  if (!image || image->channelIndex(channel) < 0) {
    ADD_FAILURE() << file << " has no channel " << channel;
    return {};
  }
  std::vector<float> pixels;
  const auto channels = static_cast<std::size_t>(image->channels);
  for (auto i = static_cast<std::size_t>(image->channelIndex(channel)); i < image->pixels.size();
       i += channels) {
    pixels.push_back(image->pixels[i]);
  }
  return pixels;
}

TEST_F(CliTest, MeasureWritesThePromisedFields) {
  const json document = runJson(measureBox({"-t", "all", "--frames", "2"}));
  expectFields(document, {"scene", "size", "driver", "light", "truth", "pixels", "techniques"});
  expectFields(document["driver"], {"vendor", "renderer", "version"});
  expectFields(document["light"], {"center", "u", "v"});
  expectFields(document["truth"], {"samples", "noise_rmse"});
  EXPECT_EQ(document["size"], json::array({64, 48}));
  EXPECT_GT(document["pixels"]["penumbra"].get<int>(), 0);
  EXPECT_GT(document["pixels"]["receiver"].get<int>(), document["pixels"]["penumbra"].get<int>());
  const json listed = runJson({"techniques"})["techniques"];
  ASSERT_EQ(document["techniques"].size(), listed.size());
  for (std::size_t i = 0; i < listed.size(); ++i) {
    const json& technique = document["techniques"][i];
    SCOPED_TRACE(technique["id"].get<std::string>());
    EXPECT_EQ(technique["id"], listed[i]["id"]) << "all means the engine's order";
    expectFields(technique, {"id", "settings", "supported"});
    if (!technique["supported"]) {
      EXPECT_FALSE(technique["reason"].get<std::string>().empty());
      continue;
    }
    expectFields(technique, {"error", "error_by_kind", "time_ms", "time_static_ms", "memory_bytes",
                             "counters", "passes", "skipped"});
    for (const char* set : {"receiver", "penumbra"}) {
      expectFields(technique["error"][set], {"mae", "rmse", "bias", "p99", "max", "share_over_2_255"});
    }
    EXPECT_EQ(technique["error"]["receiver"]["nan_pixels"], 0);
    EXPECT_GE(technique["error"]["penumbra_roughness"].get<double>(), 0.0);
    expectFields(technique["time_ms"], {"median", "p95", "min", "frames"});
    EXPECT_EQ(technique["time_ms"]["frames"], 2);
    EXPECT_LE(technique["time_ms"]["min"].get<double>(), technique["time_ms"]["median"].get<double>());
    EXPECT_LE(technique["time_ms"]["median"].get<double>(), technique["time_ms"]["p95"].get<double>());
    expectFields(technique["counters"],
                 {"passes", "framebuffer_switches", "draws", "triangles", "taps_per_pixel", "bytes_loaded",
                  "bytes_stored", "texture_bytes_uploaded"});
    EXPECT_EQ(technique["counters"]["passes"], technique["passes"].size());
    for (const json& pass : technique["passes"]) {
      expectFields(pass, {"name", "target", "draws", "triangles", "clear", "load", "store", "discard",
                          "bytes_loaded", "bytes_stored", "time_ms"});
    }
  }
}

TEST_F(CliTest, NoneHasNoShadowAndHardHasOneTap) {
  const json document = runJson(measureBox({"-t", "hard,none", "--frames", "0"}));
  ASSERT_EQ(document["techniques"].size(), 2u);
  const json& hard = document["techniques"][0];
  const json& none = document["techniques"][1];
  EXPECT_EQ(none["id"], "none");
  EXPECT_EQ(none["counters"]["taps_per_pixel"], 0.0);
  EXPECT_TRUE(none["time_ms"].is_null()) << "--frames 0 times nothing";
  // Without shadows the error is the missing darkness: positive, and the mean error is all of one sign.
  EXPECT_GT(none["error"]["receiver"]["bias"].get<double>(), 0.0);
  EXPECT_DOUBLE_EQ(none["error"]["receiver"]["bias"], none["error"]["receiver"]["mae"]);
  EXPECT_LT(hard["error"]["receiver"]["rmse"].get<double>(), none["error"]["receiver"]["rmse"].get<double>());
  EXPECT_LE(hard["counters"]["taps_per_pixel"].get<double>(), 1.0);
  EXPECT_GT(hard["counters"]["passes"].get<int>(), hard["counters_static"]["passes"].get<int>())
      << "a moved light remakes the map, a still one keeps it";
}

TEST_F(CliTest, SettingsReachTheTechnique) {
  const json document =
      runJson(measureBox({"-t", "pcf", "--frames", "0", "--set", "pcf.size=7", "--set", "map_size=256"}));
  const json& pcf = document["techniques"][0];
  EXPECT_EQ(pcf["settings"]["pcf.size"], "7");
  EXPECT_EQ(pcf["settings"]["map_size"], "256");
  EXPECT_NEAR(pcf["counters"]["taps_per_pixel"].get<double>(), 49.0, 0.5)
      << "7 x 7 taps; outside the map fewer";
}

TEST_F(CliTest, DumpedFilesGiveTheNumbersAgain) {
  const json document = runJson(measureBox({"-t", "none,pcss", "--frames", "0", "--dump", path("dump")}));
  EXPECT_EQ(files(), (std::vector<std::string>{
                         "dump", "dump/geometry.obj", "dump/light.json", "dump/none.exr", "dump/normal.exr",
                         "dump/pcss.exr", "dump/position.exr", "dump/receivers.obj", "dump/reference.exr"}));
  const std::vector<float> alpha = channelOf(path("dump/position.exr"), "A");
  const std::vector<float> truth = channelOf(path("dump/reference.exr"), "V");
  std::vector<std::uint8_t> receiver(alpha.size());
  std::ranges::transform(alpha, receiver.begin(), [](float a) { return a == 1.0f ? 1 : 0; });
  EXPECT_EQ(std::ranges::count(receiver, 1), document["pixels"]["receiver"].get<int>());
  const auto penumbra = metrics::penumbraMask(truth, receiver);
  EXPECT_EQ(std::ranges::count(penumbra, 1), document["pixels"]["penumbra"].get<int>());
  for (const json& technique : document["techniques"]) {
    const std::string id = technique["id"];
    const std::vector<float> visibility = channelOf(path("dump/" + id + ".exr"), "V");
    ASSERT_EQ(visibility.size(), truth.size());
    // The files hold the very floats: nothing but the order of summation could differ.
    EXPECT_NEAR(metrics::errorStatistics(visibility, truth, penumbra).rmse,
                technique["error"]["penumbra"]["rmse"], 1e-12);
    EXPECT_NEAR(metrics::errorStatistics(visibility, truth, receiver).mae,
                technique["error"]["receiver"]["mae"], 1e-12);
  }
}

TEST_F(CliTest, DumpedGeometryLightAndNormalsBelongTogether) {
  runJson(measureBox({"-t", "none", "--frames", "0", "--dump", path("dump")}));
  std::ifstream obj(path("dump/geometry.obj"));
  int vertices = 0, faces = 0;
  for (std::string line; std::getline(obj, line);) {
    std::istringstream words(line);
    std::string kind;
    words >> kind;
    ASSERT_TRUE(kind == "v" || kind == "f") << line;
    ++(kind == "v" ? vertices : faces);
    for (int i = 0; i < 3; ++i) {
      double value = 0;
      ASSERT_TRUE(words >> value) << line;
      ASSERT_TRUE(kind == "v" || (value >= 1 && value <= vertices)) << line;
    }
  }
  EXPECT_EQ(faces, 12) << "the box alone: the ground casts nothing";
  const json light = json::parse(std::ifstream(path("dump/light.json")));
  expectFields(light, {"center", "u", "v", "origin_lift"});
  const glm::dvec3 center(light["center"][0], light["center"][1], light["center"][2]);
  const char* const axes[] = {"R", "G", "B"};
  std::vector<float> position[3], normal[3];
  for (int i = 0; i < 3; ++i) {
    position[i] = channelOf(path("dump/position.exr"), axes[i]);
    normal[i] = channelOf(path("dump/normal.exr"), axes[i]);
  }
  const std::vector<float> alpha = channelOf(path("dump/position.exr"), "A");
  for (std::size_t i = 0; i < alpha.size(); ++i) {
    if (alpha[i] != 1.0f) continue;
    const glm::dvec3 p(position[0][i], position[1][i], position[2][i]),
        n(normal[0][i], normal[1][i], normal[2][i]);
    ASSERT_NEAR(glm::length(n), 1.0, 1e-5);
    ASSERT_GT(glm::dot(n, center - p), 0.0) << "a receiver faces the light's centre, pixel " << i;
  }
}

TEST_F(CliTest, AZeroSizeLightHasNoPenumbraAndHardShadowsAreRight) {
  const json document = runJson({"measure", "builtin:box@light=0", "-t", "hard", "--size", "64x48",
                                 "--samples", "1", "--frames", "0", "--set", "map_size=2048"});
  EXPECT_EQ(document["pixels"]["penumbra"], 0);
  // Pixels at the shadow's edge may fall to either side of a texel: at 64 x 48 a rim of a few dozen.
  EXPECT_LT(document["techniques"][0]["error"]["receiver"]["mae"].get<double>(), 0.02);
}

TEST_F(CliTest, EveryCapabilityCanBeForcedOff) {
  const json info = runJson({"info"});
  ASSERT_FALSE(info["capabilities"].empty());
  for (const json& capability : info["capabilities"]) {
    const std::string name = capability["name"];
    SCOPED_TRACE(name);
    const json document = runJson(measureBox({"-t", "hard,pcss", "--frames", "0", "--force", name + "=off"}));
    for (const json& technique : document["techniques"]) {
      EXPECT_TRUE(technique["supported"].get<bool>()) << "ES 2.0 without extensions must do";
      // Visibility without any shadow is off by .14 RMSE here; the worst depth storage must stay far from
      // that.
      EXPECT_LT(technique["error"]["receiver"]["rmse"].get<double>(), 0.1) << technique["id"];
    }
  }
}
}  // namespace
}  // namespace halfshadow::cli_tests
