// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include <algorithm>
#include <cmath>

#include "commands.hpp"
#include "images/images.hpp"
#include "json.hpp"
#include "metrics/metrics.hpp"
#include "options.hpp"
#include "text_table.hpp"

namespace halfshadow::cli {
namespace {
struct Arguments {
  std::string measured, truth, weights, json;
};

struct Plane {
  int width = 0, height = 0;
  std::vector<float> pixels;
};

/// Channel V, else the first one.
Result<Plane> readPlane(const std::string& path) {
  const auto image = images::readImage(path);
  if (!image) return image.error();
  const auto channel = static_cast<std::size_t>(std::max(image->channelIndex("V"), 0));
  const auto channels = static_cast<std::size_t>(image->channels);
  Plane plane{image->width, image->height, {}};
  for (std::size_t i = channel; i < image->pixels.size(); i += channels)
    plane.pixels.push_back(image->pixels[i]);
  return plane;
}

Status checkSameSize(const std::string& path, const Plane& plane, const std::string& truthPath,
                     const Plane& truth) {
  if (plane.width == truth.width && plane.height == truth.height) return {};
  const auto text = [](const Plane& p) { return std::to_string(p.width) + "x" + std::to_string(p.height); };
  return Error{ErrorCode::fileMalformed, path + " is " + text(plane) + " but " + truthPath + " is " +
                                             text(truth) + " pixels; render both with the same --size"};
}

std::vector<std::string> row(const char* name, const metrics::ErrorStatistics& s) {
  return {name,
          std::to_string(s.pixels),
          fixedText(s.mae, 6),
          fixedText(s.rmse, 6),
          fixedText(s.bias, 6),
          fixedText(s.p99, 5),
          fixedText(s.max, 5),
          fixedText(s.shareOver2Of255, 5)};
}

ExitStatus compare(const Arguments& arguments) {
  if (Status status = checkJsonPath(arguments.json); !status) return fail(status.error());
  const auto measured = readPlane(arguments.measured);
  if (!measured) return fail(measured.error());
  const auto truth = readPlane(arguments.truth);
  if (!truth) return fail(truth.error());
  Plane weights{truth->width, truth->height, std::vector<float>(truth->pixels.size(), 1.0f)};
  if (!arguments.weights.empty()) {
    auto read = readPlane(arguments.weights);
    if (!read) return fail(read.error());
    weights = std::move(read).value();
  }
  if (Status s = checkSameSize(arguments.measured, *measured, arguments.truth, *truth); !s)
    return fail(s.error());
  if (Status s = checkSameSize(arguments.weights, weights, arguments.truth, *truth); !s)
    return fail(s.error());
  const bool finite = std::ranges::all_of(truth->pixels, [](float v) { return std::isfinite(v); });
  if (!finite) {
    return fail(
        {ErrorCode::fileMalformed, arguments.truth + " holds NaN or infinite values; give a finite truth"});
  }
  const auto all = metrics::weightedErrorStatistics(measured->pixels, truth->pixels, weights.pixels);
  std::vector<float> penumbraWeights = weights.pixels;
  for (std::size_t i = 0; i < penumbraWeights.size(); ++i) {
    const float v = truth->pixels[i];
    if (!(v > metrics::kPenumbraLow && v < metrics::kPenumbraHigh)) penumbraWeights[i] = 0.0f;
  }
  const auto penumbra = metrics::weightedErrorStatistics(measured->pixels, truth->pixels, penumbraWeights);
  std::vector<std::uint8_t> inPenumbra(penumbraWeights.size());
  std::ranges::transform(penumbraWeights, inPenumbra.begin(), [](float weight) { return weight > 0.0f; });
  const double roughness =
      metrics::roughness(measured->pixels, truth->pixels, inPenumbra, static_cast<std::size_t>(truth->width));
  if (printsText(arguments.json)) {
    print({.header = {"pixels", "count", "mae", "rmse", "bias", "p99", "max", "share > 2/255"},
           .rows = {row(arguments.weights.empty() ? "all" : "weighted", all), row("penumbra", penumbra)}});
  }
  const Json json{{"measured", arguments.measured},
                  {"truth", arguments.truth},
                  {"size", {truth->width, truth->height}},
                  {"error",
                   {{"all", measure::toJson(all)},
                    {"penumbra", measure::toJson(penumbra)},
                    {"penumbra_roughness", roughness}}}};
  const Status written = writeJson(arguments.json, json);
  return written ? kDone : fail(written.error());
}
}  // namespace

void addCompareCommand(CLI::App& app, ExitStatus& status) {
  const auto arguments = std::make_shared<Arguments>();
  CLI::App* command = app.add_subcommand("compare", "errors between two visibility images");
  command->add_option("A", arguments->measured, "the image to judge; its channel V, else its first channel")
      ->required();
  command->add_option("B", arguments->truth, "the truth; penumbra is where it lies between 0.005 and 0.995")
      ->required();
  command->add_option("--weights", arguments->weights,
                      "image of one weight per pixel, 0 leaves a pixel out (default: 1 everywhere)");
  addJsonArgument(*command, arguments->json);
  command->callback([arguments, &status] { status = compare(*arguments); });
}

}  // namespace halfshadow::cli
