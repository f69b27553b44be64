// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include <algorithm>
#include <cstdio>
#include <limits>

#include "commands.hpp"
#include "images/images.hpp"
#include "json.hpp"
#include "measure/text_file.hpp"
#include "options.hpp"
#include "reference/reference.hpp"

namespace halfshadow::cli {
namespace {
struct Arguments {
  SceneArguments scene;
  SizeArguments size;
  std::string output, receivers, json;
  TruthArguments truth;
  std::uint32_t seed = 1;
};

Status checkOutputs(const Arguments& arguments) {
  if (Status s = measure::checkWritable(arguments.output); !s) return named("-o", s.error());
  if (!arguments.receivers.empty()) {
    if (Status s = measure::checkWritable(arguments.receivers); !s) {
      return named("--receivers", s.error());
    }
  }
  return checkJsonPath(arguments.json);
}

Status write(const std::string& path, const Arguments& arguments, std::vector<float> pixels) {
  return images::writeExr(path, {.width = arguments.size.width,
                                 .height = arguments.size.height,
                                 .channels = 1,
                                 .pixels = std::move(pixels),
                                 .channelNames = {"V"}});
}

ExitStatus traceReference(const Arguments& arguments) {
  if (Status status = checkOutputs(arguments); !status) return fail(status.error());
  const auto scene = openScene(arguments.scene);
  if (!scene) return fail(scene.error());
  const scene::AreaLight& light = scene->lights.front();
  const auto receivers =
      reference::traceReceivers(*scene, *scene->camera, light, arguments.size.width, arguments.size.height);
  if (!receivers) return fail(receivers.error());
  if (std::ranges::all_of(receivers->normalWorld,
                          [](const glm::dvec3& normal) { return glm::dot(normal, normal) == 0.0; })) {
    return fail({ErrorCode::emptyScene, scene->name +
                                            ": the picture is empty, no surface lies in the camera's view; "
                                            "point --camera at the scene"});
  }
  ProgressLine progress;
  const reference::ReferenceOptions options{
      .samples = arguments.truth.samples,
      .seed = arguments.seed,
      .originLiftWorld = arguments.truth.originLiftWorld,
      .progress = [&progress](double share) { progress.update("ground truth", share); }};
  auto visibility = reference::traceVisibility(*scene, light, *receivers, options);
  if (!visibility) return fail(visibility.error());
  const auto receiverPixels =
      receivers->kind.size() - static_cast<std::size_t>(std::ranges::count(receivers->kind, 0));
  if (Status status = write(arguments.output, arguments, std::move(visibility).value()); !status) {
    return fail(status.error());
  }
  if (!arguments.receivers.empty()) {
    std::vector<float> mask(receivers->kind.size());
    std::ranges::transform(receivers->kind, mask.begin(),
                           [](std::uint8_t kind) { return kind != 0 ? 1.0f : 0.0f; });
    if (Status status = write(arguments.receivers, arguments, std::move(mask)); !status)
      return fail(status.error());
  }
  const int traced = reference::tracedSamples(arguments.truth.samples);
  if (printsText(arguments.json)) {
    std::printf("%s: %dx%d, %d light points per pixel, %zu receiver pixels\n", arguments.output.c_str(),
                arguments.size.width, arguments.size.height, traced, receiverPixels);
  }
  const Json json{
      {"scene", scene->name},
      {"size", {arguments.size.width, arguments.size.height}},
      {"light", measure::lightJson(light)},
      {"truth",
       {{"samples", traced}, {"seed", arguments.seed}, {"origin_lift", arguments.truth.originLiftWorld}}},
      {"pixels", {{"receiver", receiverPixels}}},
      {"notes", scene->notes}};
  const Status written = writeJson(arguments.json, json);
  return written ? kDone : fail(written.error());
}
}  // namespace

void addReferenceCommand(CLI::App& app, ExitStatus& status) {
  const auto arguments = std::make_shared<Arguments>();
  CLI::App* command = app.add_subcommand("reference", "ground-truth visibility by ray tracing, on the CPU");
  addSceneArguments(*command, arguments->scene);
  command
      ->add_option("-o,--output", arguments->output,
                   "visibility of the scene's first light, OpenEXR, channel V")
      ->check(endsWith(".exr"))
      ->required();
  command
      ->add_option("--receivers", arguments->receivers,
                   "write 1 on receiver pixels and 0 elsewhere, OpenEXR: weights for `compare`")
      ->check(endsWith(".exr"));
  addTruthArguments(*command, arguments->truth);
  command->add_option("--seed", arguments->seed, "another seed gives independent noise")
      ->check(CLI::Range(std::uint32_t{0}, std::numeric_limits<std::uint32_t>::max()))
      ->capture_default_str();
  addSizeArgument(*command, arguments->size);
  addJsonArgument(*command, arguments->json);
  command->callback([arguments, &status] { status = traceReference(*arguments); });
}

}  // namespace halfshadow::cli
