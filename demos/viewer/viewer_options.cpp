// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "viewer/viewer_options.hpp"

#include <cstdio>
#include <map>

#include "options.hpp"
#include "output.hpp"
#include "scenes/camera_light_options.hpp"
#include "viewer/script.hpp"

namespace halfshadow::viewer {
namespace {
constexpr const char* kAbout =
    "Shows a scene with its soft shadows in a window: move round it, drag its light, choose techniques and "
    "their "
    "settings, compare them with ray-traced truth, look at what they cost. Press ? in the window for the "
    "keys.";

const std::map<std::string, WindowOptions::Context>& contexts() {
  static const std::map<std::string, WindowOptions::Context> kContexts = {
      {"any", WindowOptions::Context::any},
      {"egl", WindowOptions::Context::egl},
      {"glx", WindowOptions::Context::glx}};
  return kContexts;
}

void addWindowArguments(CLI::App& app, ViewerOptions& options, std::string& window) {
  app.add_option("--window", window,
                 "size of the window WIDTHxHEIGHT in screen coordinates (default: as remembered)")
      ->check([](const std::string& text) {
        int width = 0, height = 0;
        char end = 0;
        const bool fits = std::sscanf(text.c_str(), "%dx%d%c", &width, &height, &end) == 2 && width >= 200 &&
                          height >= 200 && width <= 16384 && height <= 16384;
        return fits ? std::string()
                    : "\"" + text + "\" is not a size like 1280x720, each side from 200 to 16384";
      });
  app.add_option("--scale", options.scale, "of text and panels, 0.5 to 4 (default: the desktop's)")
      ->check(CLI::Range(0.5, 4.0));
  app.add_option_function<std::string>(
         "--context", [&options](const std::string& name) { options.context = contexts().at(name); },
         "what makes the OpenGL ES context: egl, glx (its ES profile), or any: egl where it works, else glx")
      ->check(CLI::IsMember(std::vector<std::string>{"any", "egl", "glx"}))
      ->default_str("any");
  app.add_option_function<std::string>(
         "--show",
         [&options](const std::string& name) {
           options.showing = name == "shaded" ? Showing::shaded : Showing::visibility;
         },
         "shaded (lit colours) or visibility")
      ->check(CLI::IsMember({"shaded", "visibility"}))
      ->default_str("shaded");
  app.add_option("--beside", options.beside,
                 "what to compare with from the start: a technique, or truth (default: nothing)");
  app.add_option("--script", options.script, "play this file instead of waiting for hands (see below)");
  app.add_option("--frames", options.frames, "end after so many frames, and not before; a script must fit in")
      ->check(CLI::Range(1, 10000000));
  app.add_option("--screenshot", options.screenshot, "write the window, panels included, when it ends, PNG")
      ->check(cli::endsWith(".png"));
  app.add_option("--list-controls", options.controls,
                 "write the names that scripts can use when it ends, a line each");
  app.add_option(
         "--remember", options.remember,
         "FILE in which settings and window place are kept, auto (~/.config/halfshadow/viewer.json; not "
         "with scripts) or none")
      ->capture_default_str();
  app.add_option("--samples", options.samples, "light points per pixel at which the truth is done")
      ->check(CLI::Range(1, 1 << 20))
      ->capture_default_str();
  cli::addJsonArgument(app, options.json);
}
}  // namespace

std::optional<ViewerOptions> parseOptions(int argc, char** argv, int& status) {
  ViewerOptions options;
  cli::SceneArguments scene;
  cli::SizeArguments size;
  cli::DriverArguments driver;
  cli::SettingArguments settings;
  std::string window, technique;
  CLI::App app(kAbout, "halfshadow-viewer");
  app.footer(kScriptHelp);
  cli::addSceneArguments(app, scene);
  app.get_option("SCENE")->required(false);
  app.add_option("-t,--technique", technique,
                 "shadow technique, see `halfshadow techniques` (default: pcss-mip)");
  cli::addSettingArguments(app, settings);
  CLI::Option* sizeOption = nullptr;
  cli::addSizeArgument(app, size);
  sizeOption = app.get_option("--size");
  sizeOption->description("size of the picture WIDTHxHEIGHT in pixels (default: what the window leaves)");
  cli::addDriverArguments(app, driver);
  addWindowArguments(app, options, window);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    const bool isHelp = error.get_exit_code() == static_cast<int>(CLI::ExitCodes::Success);
    if (isHelp) {
      status = app.exit(error);
    } else {
      cli::say(std::string(error.what()) + "; see --help");
      status = cli::kBadUsage;
    }
    return std::nullopt;
  }
  if (!window.empty()) {
    int width = 0, height = 0;
    std::sscanf(window.c_str(), "%dx%d", &width, &height);
    options.windowWidth = width, options.windowHeight = height;
  }
  options.sceneIsGiven = !scene.source.empty();
  options.techniqueIsGiven = !technique.empty();
  View& view = options.view;
  if (options.sceneIsGiven) view.source = scene.source;
  view.technique = options.techniqueIsGiven ? technique : "pcss-mip";
  const scenes::SceneOptions parsed = cli::sceneOptions(scene);
  view.ground = parsed.ground, view.up = parsed.up, view.sides = parsed.sides;
  view.animationIndex = parsed.animationIndex;
  view.animationSeconds = parsed.animationTimeSeconds;
  options.camera = parsed.camera;
  if (parsed.light) options.lights = {*parsed.light};
  options.lights.insert(options.lights.end(), parsed.moreLights.begin(), parsed.moreLights.end());
  for (const measure::Setting& setting : cli::settingsOf(settings)) view.choices[setting.key] = setting.value;
  for (const std::string& text : driver.force) view.forcedOff.push_back(text.substr(0, text.find('=')));
  if (!driver.eglLibrary.empty()) {
    cli::say(
        "--egl-library: a window is drawn by the system's own EGL; leave it out, or use `halfshadow render`");
    status = cli::kBadUsage;
    return std::nullopt;
  }
  view.driver = driver.driver;
  view.deviceProfile = driver.deviceProfile;
  if (sizeOption->count() > 0) options.fixedWidth = size.width, options.fixedHeight = size.height;
  return options;
}

}  // namespace halfshadow::viewer
