// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// Writes the programs that an engine draws with, for compilers of other GPUs; see compile.py.
//
//   mobile_programs FOLDER RUNG [--dropped FILE] [--scenes NAME,NAME...] [KEY=VALUE ...]
//
// RUNG: derivatives, facets (without derivatives), or mediump (without highp either). FILE: ids of programs
// whose draws are left out, as such a GPU does. KEY=VALUE: settings. FOLDER/programs.tsv gets a line for each
// program, separated by tabs: id, vertex shader, fragment shader, flags of its blending (b: ONE ONE, m:
// DST_COLOR ZERO; n: no depth test), techniques that draw it, its file and defines. FOLDER/fallbacks.tsv:
// technique, scene, what was given up and why.
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <map>
#include <set>
#include <sstream>

#include "base/keys.hpp"
#include "engine_fixture.hpp"
#include "program_layer.hpp"

namespace {
using namespace halfshadow;
using namespace halfshadow::test;
namespace fs = std::filesystem;

struct Arguments {
  fs::path folder;
  std::vector<const char*> forcedOff{"framebuffer-fetch"};
  std::set<std::string> dropped;
  std::vector<std::string> scenes{"figure@light=1", "bars", "sheets", "convex", "room"};
  std::vector<Setting> settings;
};

std::vector<std::string> split(const std::string& text, char at) {
  std::vector<std::string> parts;
  std::istringstream stream(text);
  for (std::string part; std::getline(stream, part, at);) parts.push_back(part);
  return parts;
}

bool read(int argc, char** argv, Arguments& arguments) {
  if (argc < 3) return false;
  arguments.folder = fs::absolute(argv[1]);
  const std::string rung = argv[2];
  if (rung != "derivatives") arguments.forcedOff.push_back("derivatives");
  if (rung == "mediump") arguments.forcedOff.push_back("highp");
  if (rung != "derivatives" && rung != "facets" && rung != "mediump") return false;
  for (int i = 3; i < argc; ++i) {
    const std::string text = argv[i];
    if (text == "--dropped" && i + 1 < argc) {
      std::ifstream file(argv[++i]);
      for (std::string id; std::getline(file, id);) arguments.dropped.insert(id);
    } else if (text == "--scenes" && i + 1 < argc) {
      arguments.scenes = split(argv[++i], ',');
    } else if (const std::size_t at = text.find('='); at != std::string::npos) {
      arguments.settings.push_back({text.substr(0, at), text.substr(at + 1)});
    } else {
      return false;
    }
  }
  return true;
}

std::string hexOf(std::uint64_t key) {
  char text[20];
  std::snprintf(text, sizeof text, "%016llx", static_cast<unsigned long long>(key));
  return text;
}
std::string idOf(const DrawnProgram& program) {
  return hexOf(
      combineKeys(combineKeys(textKey(program.vertex), textKey(program.fragment)), textKey(program.blend)));
}
/// Written once under a name of its content.
std::string written(const fs::path& folder, const std::string& text, const char* extension) {
  const fs::path path = folder / (hexOf(textKey(text)) + extension);
  if (!fs::exists(path)) std::ofstream(path) << text;
  return path.string();
}
const char* flagsOf(const DrawnProgram& program) {
  if (program.blend.empty()) return "d";
  if (program.blend.starts_with("1 1 ")) return "nb";
  return program.blend.starts_with("306 0 ") ? "nm" : "n";
}

void list(const Arguments& arguments) {
  ProgramLayer layer;
  layer.drop([&](const DrawnProgram& program) { return arguments.dropped.contains(idOf(program)); });
  SceneRenderer renderer(layer.makeEngine(
      {.forcedOff = arguments.forcedOff.data(), .forcedOffCount = arguments.forcedOff.size()}));
  std::map<DrawnProgram, std::set<std::string>> users;
  std::ofstream fallbacks(arguments.folder / "fallbacks.tsv");
  for (const std::string& scene : arguments.scenes) {
    renderer.load(builtinScene(scene));
    renderer.desc().target.width = 64;
    renderer.desc().target.height = 48;
    for (const std::string& technique : techniquesBut(renderer.engine(), {})) {
      renderer.choose({technique, arguments.settings});
      for (const Output output : {Output::visibility, Output::shaded}) {
        (void)layer.takeDrawn();
        renderer.render(output);
        for (const DrawnProgram& program : layer.takeDrawn()) {
          if (!program.file().empty()) users[program].insert(technique);
        }
        for (const Skip& skip : renderer.report().skips) {
          if (skip.why.find("draws nothing") != std::string::npos)
            fallbacks << technique << "\t" << scene << "\t"
                      << (output == Output::shaded ? "shaded" : "visibility") << "\t" << skip.what << "\t"
                      << skip.why << "\n";
        }
      }
    }
    std::fprintf(stderr, "%s\n", scene.c_str());
  }
  std::ofstream programs(arguments.folder / "programs.tsv");
  for (const auto& [program, techniques] : users) {
    std::string names;
    for (const std::string& technique : techniques) names += (names.empty() ? "" : ",") + technique;
    programs << idOf(program) << "\t" << written(arguments.folder, program.vertex, ".vert") << "\t"
             << written(arguments.folder, program.fragment, ".frag") << "\t" << flagsOf(program) << "\t"
             << names << "\t" << program.file() << " " << program.defines() << "\n";
  }
}
}  // namespace

int main(int argc, char** argv) {
  Arguments arguments;
  if (!read(argc, argv, arguments)) {
    std::fprintf(
        stderr,
        "usage: mobile_programs FOLDER derivatives|facets|mediump [--dropped FILE] [--scenes NAME,...] "
        "[KEY=VALUE ...]\n");
    return 2;
  }
  if (headless() == nullptr) {
    std::fprintf(stderr, "%s\n", contextFailure().c_str());
    return 1;
  }
  fs::create_directories(arguments.folder);
  list(arguments);
  return testing::UnitTest::GetInstance()->ad_hoc_test_result().Failed() ? 1 : 0;
}
