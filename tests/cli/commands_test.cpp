// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// Commands that render nothing: info, techniques, scenes, validate, reference, compare.
#include <set>

#include "cli_process.hpp"
#include "images/images.hpp"

namespace halfshadow::cli_tests {
namespace {
using nlohmann::json;

TEST_F(CliTest, InfoNamesDriverLimitsAndCapabilitiesWithReasons) {
  const json info = runJson({"info"});
  EXPECT_FALSE(info["driver"]["renderer"].get<std::string>().empty());
  EXPECT_GE(info["limits"]["texture_size"].get<int>(), 64);  // the specification's minimum
  EXPECT_FALSE(info["rungs"]["depth_storage"].get<std::string>().empty());
  std::set<std::string> names;
  for (const json& capability : info["capabilities"]) {
    names.insert(capability["name"]);
    EXPECT_TRUE(capability["available"] || !capability["reason"].get<std::string>().empty()) << capability;
  }
  for (const char* name : {"depth-texture", "packed-depth-stencil", "blend-minmax", "framebuffer-fetch",
                           "highp", "derivatives", "discard", "uint-index"}) {
    EXPECT_TRUE(names.contains(name)) << name;
  }
  const ProcessResult text = run({"info"});
  EXPECT_NE(text.output.find("depth-texture"), std::string::npos);
}

TEST_F(CliTest, ForcedCapabilitiesAreReportedAbsent) {
  const json info = runJson({"info", "--force", "depth-texture=off", "--force", "derivatives=off"});
  int seen = 0;
  for (const json& capability : info["capabilities"]) {
    if (capability["name"] != "depth-texture" && capability["name"] != "derivatives") continue;
    ++seen;
    EXPECT_FALSE(capability["available"].get<bool>()) << capability;
  }
  EXPECT_EQ(seen, 2);
}

TEST_F(CliTest, TechniquesListPapersAndSettings) {
  const json list = runJson({"techniques"});
  std::set<std::string> ids, keys;
  for (const json& technique : list["techniques"]) {
    ids.insert(technique["id"]);
    EXPECT_FALSE(technique["summary"].get<std::string>().empty()) << technique["id"];
    EXPECT_TRUE(technique["supported"] || !technique["reason"].get<std::string>().empty()) << technique["id"];
    for (const json& setting : technique["settings"]) {
      keys.insert(setting["key"]);
      EXPECT_FALSE(setting["default"].get<std::string>().empty()) << setting;
      EXPECT_FALSE(setting["allowed"].get<std::string>().empty()) << setting;
      EXPECT_FALSE(setting["text"].get<std::string>().empty()) << setting;
    }
  }
  for (const json& setting : list["shared_settings"]) keys.insert(setting["key"]);
  for (const char* id : {"none", "hard", "pcf", "pcss", "sampled"}) EXPECT_TRUE(ids.contains(id)) << id;
  for (const char* key : {"map_size", "bias", "pcf.size"}) EXPECT_TRUE(keys.contains(key)) << key;
}

TEST_F(CliTest, ScenesAreListedWithTheirSource) {
  const json list = runJson({"scenes"});
  std::set<std::string> sources;
  for (const json& scene : list["scenes"]) {
    sources.insert(scene["source"]);
    EXPECT_GT(scene["triangles"].get<int>(), 0) << scene;
  }
  for (const char* name :
       {"box", "bars", "fence", "leaves", "figure", "mannequin", "spheres27", "spheres81"}) {
    EXPECT_TRUE(sources.contains(std::string("builtin:") + name)) << name;
  }
}

TEST_F(CliTest, ValidateTellsClosedFromOpen) {
  const json box = runJson({"validate", "builtin:box"});
  EXPECT_EQ(box["open_casters"], 0);
  EXPECT_EQ(box["caster_parts"], 1);
  EXPECT_EQ(box["repaired_casters"], 0);
  // A verdict for each technique that there is.
  std::set<std::string> judged, known;
  for (const json& technique : box["techniques"]) judged.insert(technique["id"]);
  const json all = runJson({"techniques"});
  for (const json& technique : all["techniques"]) known.insert(technique["id"]);
  EXPECT_EQ(judged, known);
  const json sheets = runJson({"validate", "builtin:sheets"});
  EXPECT_GT(sheets["open_casters"].get<int>(), 0);
  EXPECT_FALSE(sheets["techniques"].empty());
  const ProcessResult text = run({"validate", "builtin:sheets"});
  EXPECT_EQ(text.status, 0);
  EXPECT_NE(text.output.find("boundaries count as silhouette"), std::string::npos);
}

TEST_F(CliTest, ReferenceAndCompareAgreeWithThemselves) {
  const std::vector<std::string> scene{"reference", "builtin:box", "--size", "64x48", "--samples", "64"};
  const auto trace = [&](const std::string& name, const std::string& seed) {
    std::vector<std::string> arguments = scene;
    arguments.insert(arguments.end(), {"-o", path(name), "--receivers", path("w.exr"), "--seed", seed});
    return runJson(arguments);
  };
  const json first = trace("a.exr", "1");
  trace("b.exr", "2");
  EXPECT_EQ(first["truth"]["samples"], 64);
  const json same = runJson({"compare", path("a.exr"), path("a.exr")});
  EXPECT_EQ(same["error"]["all"]["max"], 0.0);
  const json other = runJson({"compare", path("a.exr"), path("b.exr"), "--weights", path("w.exr")});
  EXPECT_EQ(other["error"]["all"]["pixels"], first["pixels"]["receiver"]);
  // Jittered 8 x 8 strata: each seed's deviation is far below that of 64 independent points, 0.5 / 8.
  EXPECT_GT(other["error"]["penumbra"]["rmse"].get<double>(), 0.0);
  EXPECT_LT(other["error"]["penumbra"]["rmse"].get<double>(), 0.0625);
  EXPECT_EQ(same["error"]["penumbra_roughness"], 0.0);
  EXPECT_GT(other["error"]["penumbra_roughness"].get<double>(), 0.0);
  const auto image = images::readImage(path("a.exr"));
  ASSERT_TRUE(image.ok());
  EXPECT_EQ(image->channelNames, std::vector<std::string>{"V"});
  EXPECT_EQ(files(), (std::vector<std::string>{"a.exr", "b.exr", "w.exr"}));
}
}  // namespace
}  // namespace halfshadow::cli_tests
