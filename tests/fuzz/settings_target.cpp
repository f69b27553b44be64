// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// What users write: settings, and the command line's options. Each line of an input is one argument.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>

#include "fuzz_target.hpp"
#include "gl/program_proofs.hpp"
#include "options.hpp"
#include "scenes/builtin_scenes.hpp"
#include "scenes/camera_light_options.hpp"
#include "techniques/registry/registry.hpp"

namespace halfshadow::fuzz {
namespace {
const std::vector<techniques::SettingInfo>& declaredSettings() {
  static const std::vector<techniques::SettingInfo> declared =
      techniques::allSettings(techniques::makeAllTechniques());
  return declared;
}

std::vector<std::string> linesOf(Input input) {
  std::vector<std::string> lines(1);
  for (const std::uint8_t byte : input) {
    if (byte == '\n') {
      lines.emplace_back();
    } else {
      lines.back() += static_cast<char>(byte);
    }
  }
  return lines;
}

template <typename T>
void requireSentence(const Result<T>& result) {
  require(result.ok() || result.error().message.size() > 10, "a refusal without a sentence");
}

void testSetting(techniques::Settings& settings, const std::string& line) {
  const std::size_t equals = std::min(line.find('='), line.size());
  const std::string key = line.substr(0, equals), value = line.substr(std::min(equals + 1, line.size()));
  const std::uint64_t before = settings.revision();
  const Status set = settings.set(key, value);
  if (!set) {
    require(set.error().message.size() > 10, "a refusal without a sentence");
    require(settings.revision() == before, "a refused setting changed something");
    return;
  }
  const auto info = std::ranges::find(declaredSettings(), key, &techniques::SettingInfo::key);
  require(info != declaredSettings().end() && settings.text(key) == value, "a setting is not what was set");
  if (info->type == techniques::SettingType::choice) {
    require(std::ranges::count(info->choices, settings.choice(key)) == 1, "a choice that there is not");
    return;
  }
  const double real = settings.real(key);
  require(std::isfinite(real) && real >= info->low && real <= info->high, "a number out of range");
  if (info->type != techniques::SettingType::integer) return;
  require(std::ranges::all_of(value, [](char c) { return c == '-' || (c >= '0' && c <= '9'); }),
          "an integer is not written as one: shaders get it as it is");
  require(settings.integer(key) == real, "an integer of another value");
}

void testOptionTexts(const std::string& line) {
  const auto camera = scenes::parseCamera(line);
  const auto light = scenes::parseLight(line);
  const auto up = scenes::parseUp(line);
  requireSentence(camera), requireSentence(light), requireSentence(up);
  require(!camera || scene::checkCamera(*camera).ok(), "a camera that is none");
  if (light) {
    const auto again = scene::areaLightFromVectors(light->centerWorld, light->halfU, light->halfV);
    require(again.ok(), "a light that is none");
  }
  require(!up || std::isfinite(up->x + up->y + up->z), "up is not finite");
  (void)cli::finiteProblem(line);
  // Others take long to make, and differ in nothing that the text decides.
  if (!line.starts_with("mannequin") && !line.starts_with("spheres"))
    requireSentence(scenes::makeBuiltinScene(line));
}

void testCommandLine(std::vector<std::string> arguments) {
  CLI::App app("", "halfshadow");
  cli::SceneArguments scene;
  cli::SizeArguments size;
  cli::TruthArguments truth;
  cli::DriverArguments driver;
  cli::SettingArguments settings;
  std::string json;
  cli::addSceneArguments(app, scene);
  cli::addSizeArgument(app, size);
  cli::addTruthArguments(app, truth);
  cli::addDriverArguments(app, driver);
  cli::addSettingArguments(app, settings);
  cli::addJsonArgument(app, json);
  std::ranges::reverse(arguments);  // as CLI11 wants them
  try {
    app.parse(arguments);
  } catch (const CLI::Error& refused) {
    require(refused.what() != nullptr, "a refusal without a sentence");
    return;
  }
  require(size.width >= 1 && size.height >= 1, "a size of nothing");
  require(truth.samples >= 1 && truth.originLiftWorld >= 0.0, "a truth of nothing");
  (void)cli::sceneOptions(scene);
  for (const measure::Setting& setting : cli::settingsOf(settings))
    require(!setting.key.empty(), "a setting without a key");
}

void testProofs(Input input) {
  const device::DriverIdentity driver{"vendor", "renderer", "version", ""};
  gl::ProgramProofs proofs;
  const std::string_view text(reinterpret_cast<const char*>(input.data()), input.size());
  if (!proofs.restore(text, driver)) {
    require(proofs.size() == 0, "proofs of a text that was refused");
    return;
  }
  gl::ProgramProofs again;
  require(again.restore(proofs.text(driver), driver) && again.size() == proofs.size(),
          "proofs do not come back from their own text");
}

void test(Input input) {
  techniques::Settings settings(declaredSettings());
  std::vector<std::string> lines = linesOf(input);
  if (lines.size() > 24) lines.resize(24);
  for (const std::string& line : lines) {
    testSetting(settings, line);
    testOptionTexts(line);
  }
  testCommandLine(lines);
  testProofs(input);
}

std::vector<Bytes> seeds() {
  std::string defaults;
  for (const techniques::SettingInfo& info : declaredSettings())
    defaults += info.key + "=" + info.defaultValue + "\n";
  std::vector<Bytes> all;
  // Of all settings in pieces of a few lines.
  std::string piece;
  for (const std::string& line : linesOf(bytesOf(defaults))) {
    piece += line + "\n";
    if (std::ranges::count(piece, '\n') < 8) continue;
    all.push_back(bytesOf(piece));
    piece.clear();
  }
  for (const char* text :
       {"builtin:box@light=1\n--size\n320x240\n--set\npcf.size=7\n--force\ndepth-texture=off",
        "model.glb\n--camera\neye=0,2,5 target=0,0,0 fov=40 up=0,1,0\n--ground\noff\n--up\n-z",
        "builtin:figure\n--light\ncenter=0,9,0 target=0,0,0 size=2x1\n--light\ncenter=1,8,0 u=1,0,0 v=0,0,1 "
        "color=1,.5,0 intensity=2 reference=9",
        "eye=1e3,-2,5.5 target=0,0,0", "center=0,9,0 u=0,0,0 v=0,0,0 emission=1,-1,0\n1,2,3",
        "box@light=0.5,scale=2,shift=100\nroom@light=0\ncontact",
        "builtin:box\n--animation\n-1\n--animation-time\n1.5\n--samples\n64\n--origin-lift\n.001\n--driver\n"
        "llvmpipe\n--device-profile\nnone\n--json\n-"}) {
    all.push_back(bytesOf(text));
  }
  gl::ProgramProofs proofs;
  all.push_back(bytesOf(proofs.text({"vendor", "renderer", "version", ""}) + "1f d\nfedcba9876543210 x\n"));
  return all;
}

std::vector<std::string> dictionary() {
  std::vector<std::string> words = {"eye=",    "target=", "up=",     "fov=",       "center=",     "size=",
                                    "u=",      "v=",      "color=",  "intensity=", "reference=",  "emission=",
                                    "@light=", ",scale=", ",shift=", "builtin:",   "\n--light\n", "\n--set\n",
                                    "=off",    "x",       ",",       "\n",         "=",           "nan",
                                    "inf",     "-",       "+",       "0x",         "1e1"};
  for (const techniques::SettingInfo& info : declaredSettings()) {
    words.push_back("\n" + info.key + "=");
    for (const std::string& choice : info.choices) words.push_back(choice);
  }
  return words;
}
}  // namespace

const Target& target() {
  static const Target made{
      .name = "settings", .test = test, .seeds = seeds, .dictionary = dictionary, .largestInput = 1024};
  return made;
}

}  // namespace halfshadow::fuzz
