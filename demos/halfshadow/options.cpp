// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "options.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "measure/measurement.hpp"
#include "output.hpp"
#include "scenes/camera_light_options.hpp"

namespace halfshadow::cli {
namespace {
/// No device renders more; the reference, which needs no device, stops here too (its images stay below 20
/// GB).
constexpr int kLargestSide = 16384;

bool parseSide(std::string_view text, int& side) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), side);
  return error == std::errc() && end == text.data() + text.size() && side >= 1 && side <= kLargestSide;
}

std::string sizeProblem(const std::string& text, SizeArguments& size) {
  const std::size_t cross = text.find('x');
  if (cross != std::string::npos && parseSide(std::string_view(text).substr(0, cross), size.width) &&
      parseSide(std::string_view(text).substr(cross + 1), size.height)) {
    return {};
  }
  return "\"" + text + "\" is not a size; give WIDTHxHEIGHT in pixels, each from 1 to " +
         std::to_string(kLargestSide) + ", e.g. 640x480";
}

/// CLI11 puts the option's name in front of what a check says; the scene parsers do so themselves.
template <typename T>
std::string problemOf(const Result<T>& result, const std::string& option) {
  if (result.ok()) return {};
  const std::string& message = result.error().message;
  return message.starts_with(option + ": ") ? message.substr(option.size() + 2) : message;
}

std::string assignmentProblem(const std::string& text, const char* example) {
  const std::size_t equals = text.find('=');
  if (equals != std::string::npos && equals > 0 && equals + 1 < text.size()) return {};
  return "\"" + text + "\" is not KEY=VALUE; write it like " + example;
}

std::string forceProblem(const std::string& text) {
  constexpr const char* kExample = "depth-texture=off";
  if (std::string problem = assignmentProblem(text, kExample); !problem.empty()) return problem;
  if (text.substr(text.find('=') + 1) == "off") return {};
  return "\"" + text + "\": a capability can only be forced off; write it like " + kExample;
}
}  // namespace

std::string finiteProblem(const std::string& text) {
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error == std::errc() && end == text.data() + text.size() && std::isfinite(value)) return {};
  return "\"" + text + "\" is not a finite number; give one, e.g. 1.5";
}

CLI::Validator endsWith(const std::string& extension) {
  return CLI::Validator(
      [extension](std::string& path) {
        return path.size() > extension.size() && path.ends_with(extension)
                   ? std::string()
                   : "\"" + path + "\" does not end with " + extension + "; this option writes such a file";
      },
      "FILE" + extension);
}

void addSceneArguments(CLI::App& app, SceneArguments& arguments) {
  app.add_option("SCENE", arguments.source,
                 "a .gltf or .glb file, or builtin:NAME[@light=HALFSIZE] (see `halfshadow scenes`)")
      ->required();
  app.add_option(
         "--camera", arguments.camera,
         "\"eye=x,y,z target=x,y,z [fov=DEGREES] [up=x,y,z]\" in world units; fov is vertical, default 34 "
         "(default: the scene's camera, else one fitted to casters and shadow)")
      ->check([](const std::string& text) { return problemOf(scenes::parseCamera(text), "--camera"); });
  app.add_option(
         "--light", arguments.lights,
         "\"center=x,y,z target=x,y,z size=WxH [up=x,y,z]\" (full side lengths in world units) or "
         "\"center=x,y,z u=x,y,z v=x,y,z\" (half-extent vectors, emits towards u x v), with "
         "[color=r,g,b] (linear) [intensity=I] [reference=D] (world units at which I counts fully; 0: "
         "everywhere); repeatable, up to 4 (default: the scene's lights, else one fitted above the "
         "casters)")
      ->check([](const std::string& text) { return problemOf(scenes::parseLight(text), "--light"); })
      ->allow_extra_args(false);
  app.add_option(
         "--ground", arguments.ground,
         "auto adds a ground plane to scenes without a floor, on to all, off to none (and removes those of "
         "built-in scenes)")
      ->check(CLI::IsMember({"auto", "on", "off"}))
      ->capture_default_str();
  app.add_option(
         "--up", arguments.up,
         "what the scene takes for upward, where ground, lamp and camera are added: x, y, z, -x, -y, -z or "
         "a direction x,y,z; the scene itself is not turned")
      ->check([](const std::string& text) { return problemOf(scenes::parseUp(text), "--up"); })
      ->capture_default_str();
  app.add_option(
         "--sides", arguments.sides,
         "from where a file's surfaces are seen that are not doubleSided: file: the front (closed ones "
         "from within too), or both; shadows fall from both sides")
      ->check(CLI::IsMember({"both", "file"}))
      ->capture_default_str();
  app.add_option("--animation-time", arguments.animationTimeSeconds,
                 "seconds into a file's animation at which it is posed")
      ->check(finiteProblem)
      ->capture_default_str();
  app.add_option("--animation", arguments.animationIndex,
                 "number of the file's animation; -1 is the rest pose")
      ->check(CLI::Range(-1, 1 << 20))
      ->capture_default_str();
}

void addSizeArgument(CLI::App& app, SizeArguments& arguments) {
  app.add_option("--size", arguments.text, "image size WIDTHxHEIGHT in pixels")
      ->check([&arguments](const std::string& text) { return sizeProblem(text, arguments); })
      ->capture_default_str();
}

void addTruthArguments(CLI::App& app, TruthArguments& arguments) {
  app.add_option("--samples", arguments.samples, "light points per pixel of the truth")
      ->check(CLI::Range(1, 1 << 24))
      ->capture_default_str();
  app.add_option(
         "--origin-lift", arguments.originLiftWorld,
         "how far rays start above casters' facets, world units; 0: on the facet. Only to compare with "
         "a truth that was made so")
      ->check(CLI::NonNegativeNumber)
      ->capture_default_str();
}

void addDriverArguments(CLI::App& app, DriverArguments& arguments) {
  app.add_option("--driver", arguments.driver, "OpenGL ES driver: default, llvmpipe, softpipe, angle, device")
      ->check(CLI::IsMember({"default", "llvmpipe", "softpipe", "angle", "device"}))
      ->capture_default_str();
  app.add_option("--egl-library", arguments.eglLibrary,
                 "file of the EGL library (default: the driver's own)");
  app.add_option(
         "--device-profile", arguments.deviceProfile,
         "measured choices for the device: FILE (device.json of `halfshadow profile`), auto (the kept "
         "profile of this renderer, if any) or none")
      ->capture_default_str();
  app.add_option("--force", arguments.force,
                 "CAPABILITY=off: do as if the device lacked it, e.g. depth-texture=off; repeatable "
                 "(names: `halfshadow info`; default: none)")
      ->check(forceProblem)
      ->allow_extra_args(false);
  app.add_option(
         "--threads", arguments.threads,
         "threads that the engine may use where lists of dense casters are made; pictures are the same")
      ->check(CLI::Range(1, 256))
      ->capture_default_str();
}

void addSettingArguments(CLI::App& app, SettingArguments& arguments) {
  app.add_option("--set", arguments.texts,
                 "KEY=VALUE: a setting, e.g. pcf.size=7; repeatable (keys, units and defaults: `halfshadow "
                 "techniques`)")
      ->check([](const std::string& text) { return assignmentProblem(text, "pcf.size=7"); })
      ->allow_extra_args(false);
}

void addJsonArgument(CLI::App& app, std::string& path) {
  app.add_option("--json", path,
                 "write the result as JSON to this file; - is standard output, without the table");
}

scenes::SceneOptions sceneOptions(const SceneArguments& arguments) {
  scenes::SceneOptions options{.animationTimeSeconds = arguments.animationTimeSeconds,
                               .animationIndex = arguments.animationIndex};
  if (arguments.ground == "on") options.ground = scenes::GroundMode::on;
  if (arguments.ground == "off") options.ground = scenes::GroundMode::off;
  if (arguments.sides == "both") options.sides = scenes::Sides::both;
  options.up = scenes::parseUp(arguments.up).value();
  if (!arguments.camera.empty()) options.camera = scenes::parseCamera(arguments.camera).value();
  for (const std::string& text : arguments.lights) {
    const scene::AreaLight light = scenes::parseLight(text).value();
    if (!options.light) {
      options.light = light;
    } else {
      options.moreLights.push_back(light);
    }
  }
  return options;
}

std::vector<measure::Setting> settingsOf(const SettingArguments& arguments) {
  std::vector<measure::Setting> settings;
  for (const std::string& text : arguments.texts) {
    const std::size_t equals = text.find('=');
    settings.push_back({text.substr(0, equals), text.substr(equals + 1)});
  }
  return settings;
}

Result<scene::SceneDescription> openScene(const SceneArguments& arguments) {
  auto scene = scenes::openScene(arguments.source, sceneOptions(arguments));
  if (!scene) return scene;
  for (const std::string& note : scene->notes) say("note: " + note);
  if (scene->lights.size() > static_cast<std::size_t>(kMaxLights)) {
    const std::string note = "the scene has " + std::to_string(scene->lights.size()) + " lights; the first " +
                             std::to_string(kMaxLights) + " are used";
    say("note: " + note);
    scene->notes.push_back(note);
    scene->lights.resize(kMaxLights);
  }
  return scene;
}

Result<std::unique_ptr<measure::EngineSession>> openSession(const DriverArguments& arguments) {
  measure::SessionOptions options{.driver = arguments.driver, .eglLibrary = arguments.eglLibrary};
  options.deviceProfile = arguments.deviceProfile;
  options.threads = arguments.threads;
  for (const std::string& text : arguments.force) options.forcedOff.push_back(text.substr(0, text.find('=')));
  auto session = measure::EngineSession::open(options);
  if (!session && session.error().code == ErrorCode::invalidArgument && !options.forcedOff.empty()) {
    return named("--force", session.error());
  }
  return session;
}

Error named(const std::string& option, const Error& error) {
  return {error.code, option + ": " + error.message};
}

Status checkSize(const SizeArguments& size, const measure::EngineSession& session) {
  const int limit = session.sizeLimit();
  if (size.width <= limit && size.height <= limit) return {};
  return Error{ErrorCode::invalidArgument, "--size " + size.text + " is above this device's limit of " +
                                               std::to_string(limit) + " pixels a side; give a smaller one"};
}

Result<std::vector<std::string>> chosenTechniques(measure::EngineSession& session,
                                                  const std::vector<std::string>& asked) {
  const std::vector<std::string> known = measure::techniqueIds(session);
  std::vector<std::string> chosen;
  for (const std::string& id : asked) {
    if (id != "all" && std::ranges::find(known, id) == known.end()) {
      std::string list;
      for (const std::string& name : known) list += ", " + name;
      return Error{ErrorCode::unknownTechnique, "-t: there is no technique \"" + id + "\"; give all" + list};
    }
    for (const std::string& name : id == "all" ? known : std::vector<std::string>{id}) {
      if (std::ranges::find(chosen, name) == chosen.end()) chosen.push_back(name);
    }
  }
  return chosen;
}

}  // namespace halfshadow::cli
