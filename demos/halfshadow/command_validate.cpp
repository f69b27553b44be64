// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "scenes/validate.hpp"

#include <array>
#include <cstdio>

#include "commands.hpp"
#include "json.hpp"
#include "options.hpp"
#include "scenes/builtin_scenes.hpp"
#include "scenes/gltf_loader.hpp"
#include "text_table.hpp"

namespace halfshadow::cli {
namespace {
struct Arguments {
  std::string source, json;
  double animationTimeSeconds = 0.0;
  int animationIndex = 0;
};

/// The scene as it is stored: nothing fitted, nothing added.
Result<scene::SceneDescription> openAsStored(const Arguments& arguments) {
  constexpr std::string_view kBuiltin = "builtin:";
  if (arguments.source.starts_with(kBuiltin)) {
    return scenes::makeBuiltinScene(std::string_view(arguments.source).substr(kBuiltin.size()));
  }
  return scenes::loadGltf(arguments.source, {.animationTimeSeconds = arguments.animationTimeSeconds,
                                             .animationIndex = arguments.animationIndex});
}

/// What a technique sees a caster by.
enum class Sight { nothing, maps, volumes, wedges };
struct Judged {
  const char* id;
  Sight sight;
};
constexpr std::array<Judged, 16> kTechniques = {{{"none", Sight::nothing},
                                                 {"hard", Sight::maps},
                                                 {"pcf", Sight::maps},
                                                 {"pcf-masked", Sight::maps},
                                                 {"pcf-quantized", Sight::maps},
                                                 {"pcss", Sight::maps},
                                                 {"pcss-mip", Sight::maps},
                                                 {"vsm", Sight::maps},
                                                 {"occlusion-textures", Sight::maps},
                                                 {"shadow-width", Sight::maps},
                                                 {"shadow-volume", Sight::volumes},
                                                 {"wedges", Sight::wedges},
                                                 {"wedges-probabilistic", Sight::wedges},
                                                 {"wedges-blended", Sight::wedges},
                                                 {"wedges-cells", Sight::wedges},
                                                 {"sampled", Sight::maps}}};

struct Verdict {
  const char* verdict = "works";  ///< "works", "limited" or "lit"
  std::string outcome;
};

std::string countOf(std::uint32_t some, std::uint32_t all) {
  return std::to_string(some) + " of " + std::to_string(all) + " casters";
}

Verdict ofOutlines(const scenes::ValidationReport& report, Sight sight) {
  Verdict verdict;
  if (report.openCasters == 0) {
    verdict.outcome = sight == Sight::volumes
                          ? "all casters are closed, so silhouettes are closed loops"
                          : "all casters are closed; " + std::to_string(report.casterParts) +
                                (report.casterParts == 1 ? " part" : " parts") +
                                ", each one occluder with its own penumbra";
  } else {
    verdict.outcome = countOf(report.openCasters, report.casters) +
                      " are open: their boundaries count as silhouette edges, two-sided";
    if (sight == Sight::wedges)
      verdict.outcome +=
          "; of the sides that face the light and those that face away the one that covers more counts";
  }
  if (report.cutCasters > 0) {
    verdict.outcome += "; " + countOf(report.cutCasters, report.casters) +
                       " have holes that alpha cuts: their outlines follow it";
  }
  if (report.repairedCasters > 0) {
    verdict.outcome +=
        "; " + std::to_string(report.repairedCasters) + " of them mended for silhouettes, drawn as they are";
  }
  return verdict;
}

Verdict verdictOf(const scenes::ValidationReport& report, Sight sight) {
  if (report.casters == 0) return {"lit", "no casters: every pixel is lit"};
  if (sight == Sight::nothing) return {"lit", "draws no shadows"};
  if (sight != Sight::maps) return ofOutlines(report, sight);
  if (report.cutCasters == 0)
    return {"works", "it draws triangles into maps and asks nothing of the surface"};
  return {"works", "it draws triangles into maps, with the holes that alpha cuts into " +
                       countOf(report.cutCasters, report.casters)};
}

Json boundsJson(const scene::Bounds& bounds) {
  if (bounds.empty()) return nullptr;
  return {{"low", {bounds.low.x, bounds.low.y, bounds.low.z}},
          {"high", {bounds.high.x, bounds.high.y, bounds.high.z}}};
}

Json objectJson(const scenes::ObjectReport& object) {
  return {{"name", object.name},
          {"triangles", object.triangles},
          {"vertices", object.vertices},
          {"welded_vertices", object.weldedVertices},
          {"closed", object.closed},
          {"parts", object.parts},
          {"sheets", object.sheets},
          {"boundary_edges", object.boundaryEdges},
          {"non_manifold_edges", object.nonManifoldEdges},
          {"repaired",
           {{"merged_vertices", object.mergedVertices},
            {"back_to_back_faces", object.backToBackFaces},
            {"t_junctions", object.repairedTJunctions},
            {"flipped_faces", object.flippedFaces},
            {"filled_gaps", object.filledGaps}}},
          {"degenerate_dropped", object.degenerateDropped},
          {"duplicate_dropped", object.duplicateDropped},
          {"signed_volume", object.signedVolumeWorld},
          {"bounds", boundsJson(object.boundsWorld)},
          {"casts", object.casts},
          {"receives", object.receives},
          {"repairs", object.repairs},
          {"warnings", object.warnings}};
}

Json reportJson(const scenes::ValidationReport& report) {
  Json json{{"scene", report.name},
            {"triangles", report.triangles},
            {"casters", report.casters},
            {"open_casters", report.openCasters},
            {"repaired_casters", report.repairedCasters},
            {"cut_casters", report.cutCasters},
            {"caster_parts", report.casterParts},
            {"bounds", boundsJson(report.boundsWorld)},
            {"caster_bounds", boundsJson(report.casterBoundsWorld)},
            {"warnings", report.warnings}};
  json["objects"] = Json::array();
  for (const scenes::ObjectReport& object : report.objects) json["objects"].push_back(objectJson(object));
  json["techniques"] = Json::array();
  for (const Judged& judged : kTechniques) {
    const Verdict verdict = verdictOf(report, judged.sight);
    json["techniques"].push_back(
        {{"id", judged.id}, {"verdict", verdict.verdict}, {"outcome", verdict.outcome}});
  }
  return json;
}

void printReport(const scenes::ValidationReport& report) {
  std::printf("%s: %llu triangles, %zu objects, %u cast shadows in %u %s, %u of them are open\n",
              report.name.c_str(), static_cast<unsigned long long>(report.triangles), report.objects.size(),
              report.casters, report.casterParts, report.casterParts == 1 ? "part" : "parts",
              report.openCasters);
  TextTable table{.header = {"object", "triangles", "welded", "parts", "closed", "boundary", "non-manifold",
                             "dropped", "casts", "receives"}};
  for (const scenes::ObjectReport& object : report.objects) {
    table.rows.push_back({object.name, std::to_string(object.triangles),
                          std::to_string(object.weldedVertices), std::to_string(object.parts),
                          object.closed ? "yes" : "no", std::to_string(object.boundaryEdges),
                          std::to_string(object.nonManifoldEdges),
                          std::to_string(object.degenerateDropped + object.duplicateDropped),
                          object.casts ? "yes" : "no", object.receives ? "yes" : "no"});
  }
  print(table);
  for (const std::string& warning : report.warnings) std::printf("warning: %s\n", warning.c_str());
  for (const scenes::ObjectReport& object : report.objects) {
    for (const std::string& warning : object.warnings) {
      std::printf("warning: %s: %s\n", object.name.c_str(), warning.c_str());
    }
  }
  for (const scenes::ObjectReport& object : report.objects) {
    for (const std::string& repair : object.repairs) {
      std::printf("mended: %s: %s\n", object.name.c_str(), repair.c_str());
    }
  }
  TextTable verdicts{.header = {"technique", "verdict", "why"}};
  for (const Judged& judged : kTechniques) {
    const Verdict verdict = verdictOf(report, judged.sight);
    verdicts.rows.push_back({judged.id, verdict.verdict, verdict.outcome});
  }
  print(verdicts);
}

ExitStatus validate(const Arguments& arguments) {
  if (Status status = checkJsonPath(arguments.json); !status) return fail(status.error());
  const auto scene = openAsStored(arguments);
  if (!scene) return fail(scene.error());
  const scenes::ValidationReport report = scenes::validateScene(*scene);
  if (printsText(arguments.json)) printReport(report);
  const Status written = writeJson(arguments.json, reportJson(report));
  return written ? kDone : fail(written.error());
}
}  // namespace

void addValidateCommand(CLI::App& app, ExitStatus& status) {
  const auto arguments = std::make_shared<Arguments>();
  CLI::App* command = app.add_subcommand(
      "validate", "is a file fit for shadows: closed, manifold, scale; what techniques do with it");
  command->add_option("FILE", arguments->source, "a .gltf or .glb file, or builtin:NAME")->required();
  command->add_option("--animation-time", arguments->animationTimeSeconds, "seconds into the animation")
      ->check(finiteProblem)
      ->capture_default_str();
  command
      ->add_option("--animation", arguments->animationIndex, "number of the animation; -1 is the rest pose")
      ->check(CLI::Range(-1, 1 << 20))
      ->capture_default_str();
  addJsonArgument(*command, arguments->json);
  command->callback([arguments, &status] { status = validate(*arguments); });
}

}  // namespace halfshadow::cli
