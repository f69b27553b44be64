// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include <algorithm>
#include <cstdio>
#include <filesystem>

#include "animation.hpp"
#include "commands.hpp"
#include "images/images.hpp"
#include "json.hpp"
#include "measure/measurement.hpp"
#include "measure/text_file.hpp"

namespace halfshadow::cli {
namespace {
struct Arguments {
  SceneArguments scene;
  SizeArguments size;
  DriverArguments driver;
  SettingArguments settings;
  std::string output, visibility, graphviz, json, technique;
  bool plan = false;
  int frames = 0;  ///< 0 = one image under its own name
  std::string animate = "light";
  double framesPerSecond = 30.0;
};

Status checkArguments(const Arguments& arguments) {
  if (arguments.output.empty() && arguments.visibility.empty() && !arguments.plan &&
      arguments.graphviz.empty()) {
    return Error{ErrorCode::invalidArgument,
                 "nothing to write; give -o out.png, --visibility v.exr, --plan or --graphviz plan.dot"};
  }
  if (arguments.animate == "time" && arguments.scene.source.starts_with("builtin:")) {
    return Error{ErrorCode::invalidArgument, "--animate time needs a file: " + arguments.scene.source +
                                                 " has no animation; use light or camera"};
  }
  const std::pair<const char*, const std::string*> outputs[] = {{"-o", &arguments.output},
                                                                {"--visibility", &arguments.visibility},
                                                                {"--graphviz", &arguments.graphviz}};
  for (const auto& [option, path] : outputs) {
    if (path->empty()) continue;
    const std::string file =
        arguments.frames > 0 && path != &arguments.graphviz ? framePath(*path, 0) : *path;
    if (Status status = measure::checkWritable(file); !status) {
      return Error{status.error().code, std::string(option) + ": " + status.error().message};
    }
  }
  return checkJsonPath(arguments.json);
}

Motion motionOf(const std::string& animate) {
  if (animate == "camera") return Motion::camera;
  return animate == "time" ? Motion::time : Motion::light;
}

/// `auto` where the engine has it, else `hard`.
std::string defaultTechnique(measure::EngineSession& session) {
  const std::vector<std::string> ids = measure::techniqueIds(session);
  return std::ranges::find(ids, "auto") != ids.end() ? "auto" : "hard";
}

std::vector<std::uint8_t> opaquePixels(const measure::RgbaImage& image) {
  std::vector<std::uint8_t> rgb;
  rgb.reserve(image.pixels.size() / 4 * 3);
  for (std::size_t i = 0; i < image.pixels.size(); i += 4) {
    rgb.insert(rgb.end(), image.pixels.begin() + static_cast<std::ptrdiff_t>(i),
               image.pixels.begin() + static_cast<std::ptrdiff_t>(i) + 3);
  }
  return rgb;
}

/// Channel V is the first light; further lights follow as V1, V2, V3.
images::FloatImage visibilityImage(const measure::RgbaImage& image, Output output, std::size_t lights) {
  images::FloatImage result{
      .width = image.width, .height = image.height, .channels = static_cast<int>(lights)};
  for (std::size_t i = 0; i < lights; ++i)
    result.channelNames.push_back(i == 0 ? "V" : "V" + std::to_string(i));
  if (lights == 1) {
    result.pixels = measure::decodeVisibility(image, output);
    return result;
  }
  for (std::size_t i = 0; i < image.pixels.size(); i += 4) {
    for (std::size_t k = 0; k < lights; ++k)
      result.pixels.push_back(static_cast<float>(image.pixels[i + k]) / 255.0f);
  }
  return result;
}

class Renderer {
 public:
  Renderer(measure::EngineSession& session, const Arguments& arguments, std::string technique)
      : session_(session), arguments_(arguments), technique_(std::move(technique)) {}

  Status renderFrame(const scene::SceneDescription& scene, const std::string& output,
                     const std::string& visibility) {
    const int width = arguments_.size.width, height = arguments_.size.height;
    RenderDesc desc{.camera = measure::cameraDesc(*scene.camera),
                    .target = {.width = width, .height = height}};
    if (!visibility.empty()) {
      // Four channels hold four lights; only a single light can have 16 bits.
      desc.output = scene.lights.size() == 1 ? measure::visibilityOutputOf(technique_) : Output::visibility;
      auto image = imageOf(desc);
      if (!image) return image.error();
      const Status written =
          images::writeExr(visibility, visibilityImage(*image, desc.output, scene.lights.size()));
      if (!written) return written;
      files_.push_back(visibility);
    }
    if (visibility.empty() || !output.empty()) {
      desc.output = Output::shaded;
      auto image = imageOf(desc);
      if (!image) return image.error();
      if (output.empty()) return {};
      if (Status s = images::writePng(output, width, height, 3, opaquePixels(*image)); !s) return s;
      files_.push_back(output);
    }
    return {};
  }

  /// An image of one colour may show a wall or nothing; rays tell.
  Status checkSomethingIsSeen(const scene::SceneDescription& scene) const {
    if (!isUniform_) return {};
    const auto receivers = reference::traceReceivers(scene, *scene.camera, scene.lights.front(),
                                                     arguments_.size.width, arguments_.size.height);
    if (!receivers) return receivers.error();
    const bool isSeen = std::ranges::any_of(receivers->normalWorld,
                                            [](const auto& normal) { return glm::dot(normal, normal) > 0; });
    if (isSeen) return {};
    return Error{ErrorCode::emptyScene, scene.name +
                                            ": the picture is empty, no surface lies in the camera's view; "
                                            "point --camera at the scene"};
  }

  const std::string& planText() const { return planText_; }
  const std::string& planGraphviz() const { return planGraphviz_; }

  Json json(const scene::SceneDescription& scene) {
    return {{"scene", scene.name},
            {"size", {arguments_.size.width, arguments_.size.height}},
            {"driver", measure::driverJson(session_.engine().driver())},
            {"light", measure::lightJson(scene.lights.front())},
            {"technique", technique_},
            {"settings", measure::toJson(measure::effectiveSettings(session_, technique_))},
            {"memory_bytes", memoryBytes_},
            {"counters", counters_},
            {"passes", passes_},
            {"skipped", skipped_},
            {"notes", scene.notes},
            {"files", files_}};
  }

 private:
  /// Keeps what the frame's report says; the first frame makes all maps, so its report is the one to show.
  Result<measure::RgbaImage> imageOf(const RenderDesc& desc) {
    FrameReport report;
    if (Status status = session_.render(desc, report); !status) return status.error();
    if (planText_.empty()) {
      planText_ = report.planText;
      planGraphviz_ = report.planGraphviz;
      memoryBytes_ = report.memoryBytes;
      counters_ = measure::toJson(measure::countersOf(report));
      counters_.erase("taps_per_pixel");
      passes_ = Json::array();
      for (const auto& pass : measure::passesOf(report)) passes_.push_back(measure::toJson(pass));
      for (Json& pass : passes_) pass.erase("time_ms");
      skipped_ = measure::toJson(measure::skipsOf(report));
    }
    auto image = session_.read(desc.target.width, desc.target.height);
    isUniform_ = isUniform_ && image && isUniform(*image);
    return image;
  }

  static bool isUniform(const measure::RgbaImage& image) {
    for (std::size_t i = 4; i < image.pixels.size(); ++i) {
      if (image.pixels[i] != image.pixels[i - 4]) return false;
    }
    return true;
  }

  measure::EngineSession& session_;
  const Arguments& arguments_;
  std::string technique_, planText_, planGraphviz_;
  std::uint64_t memoryBytes_ = 0;
  Json counters_, passes_, skipped_;
  bool isUniform_ = true;  ///< every image so far is of one colour
  std::vector<std::string> files_;
};

Status renderFrames(measure::EngineSession& session, const Arguments& arguments,
                    const scene::SceneDescription& first, Renderer& renderer) {
  if (arguments.frames == 0) return renderer.renderFrame(first, arguments.output, arguments.visibility);
  const Animation animation(arguments.scene, first, motionOf(arguments.animate), arguments.frames,
                            arguments.framesPerSecond);
  const auto numbered = [](const std::string& path, int frame) {
    return path.empty() ? path : framePath(path, frame);
  };
  ProgressLine progress;
  for (int frame = 0; frame < arguments.frames; ++frame) {
    const auto scene = animation.sceneAt(frame);
    if (!scene) return scene.error();
    if (Status status = session.update(*scene); !status) return status;
    if (Status status = session.setLights(scene->lights); !status) return status;
    const Status status = renderer.renderFrame(*scene, numbered(arguments.output, frame),
                                               numbered(arguments.visibility, frame));
    if (!status) return status;
    progress.update("frames", static_cast<double>(frame + 1) / arguments.frames);
  }
  return {};
}

ExitStatus render(const Arguments& arguments) {
  if (Status status = checkArguments(arguments); !status) return fail(status.error());
  auto session = openSession(arguments.driver);
  if (!session) return fail(session.error());
  if (Status status = checkSize(arguments.size, **session); !status) return fail(status.error());
  const std::string technique =
      arguments.technique.empty() ? defaultTechnique(**session) : arguments.technique;
  if (Status s = (*session)->choose(technique, {}); !s) return fail(named("-t", s.error()));
  if (Status s = (*session)->set(settingsOf(arguments.settings)); !s) return fail(named("--set", s.error()));
  auto scene = openScene(arguments.scene);
  if (!scene) return fail(scene.error());
  if (Status status = (*session)->load(*scene); !status) return fail(status.error());
  scene::releaseColorImages(*scene);
  if (Status status = (*session)->setLights(scene->lights); !status) return fail(status.error());
  Renderer renderer(**session, arguments, technique);
  if (Status status = renderFrames(**session, arguments, *scene, renderer); !status)
    return fail(status.error());
  if (Status status = renderer.checkSomethingIsSeen(*scene); !status) return fail(status.error());
  if (!arguments.graphviz.empty()) {
    const Status written = measure::writeTextFile(arguments.graphviz, renderer.planGraphviz());
    if (!written) return fail(written.error());
  }
  if (arguments.plan && printsText(arguments.json)) std::printf("%s", renderer.planText().c_str());
  const Status written = writeJson(arguments.json, renderer.json(*scene));
  return written ? kDone : fail(written.error());
}
}  // namespace

void addRenderCommand(CLI::App& app, ExitStatus& status) {
  const auto arguments = std::make_shared<Arguments>();
  CLI::App* command = app.add_subcommand("render", "shaded image of a scene, or its visibility");
  addSceneArguments(*command, arguments->scene);
  command->add_option("-o,--output", arguments->output, "the shaded image, PNG, sRGB")
      ->check(endsWith(".png"));
  command
      ->add_option(
          "--visibility", arguments->visibility,
          "visibility, OpenEXR: channel V is the first light (1 lit, 0 umbra), V1 to V3 are further ones")
      ->check(endsWith(".exr"));
  command->add_option("-t,--technique", arguments->technique,
                      "shadow technique, see `halfshadow techniques` (default: auto, else hard)");
  addSettingArguments(*command, arguments->settings);
  addSizeArgument(*command, arguments->size);
  command
      ->add_option(
          "--frames", arguments->frames,
          "number of animated images; they are written as out_0000.png, … (default: one still image)")
      ->check(CLI::Range(1, 9999));
  command
      ->add_option("--animate", arguments->animate,
                   "what moves: light (once round a small circle), camera (once round its target), time (the "
                   "file's animation); needs --frames")
      ->check(CLI::IsMember({"light", "camera", "time"}))
      ->capture_default_str()
      ->needs("--frames");
  command->add_option("--fps", arguments->framesPerSecond, "images per second of --animate time")
      ->check(finiteProblem)
      ->check(CLI::Range(0.001, 1e6))
      ->capture_default_str();
  command->add_flag("--plan", arguments->plan, "print the first frame's passes, attachments and bytes");
  command->add_option("--graphviz", arguments->graphviz, "write that plan as a Graphviz file");
  addDriverArguments(*command, arguments->driver);
  addJsonArgument(*command, arguments->json);
  command->callback([arguments, &status] { status = render(*arguments); });
}

}  // namespace halfshadow::cli
