// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// Every file of public collections, where they are at hand:
//
//   HALFSHADOW_GLTF_CORPORA=/path/a:/path/b build/bin/scenes_tests --gtest_filter='GltfCorpora.*'
//
// for example clones of KhronosGroup/glTF-Asset-Generator (folder Output/Positive), glTF-Sample-Assets
// (Models) and glTF-Validator (test). Prints a table of verdict, milliseconds and file.
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <string>

#include "scenes/scene_source.hpp"

namespace halfshadow::scenes {
namespace {
namespace fs = std::filesystem;

std::vector<std::string> filesBelow(const std::string& folders) {
  std::vector<std::string> files;
  for (std::size_t from = 0; from < folders.size();) {
    const std::size_t to = std::min(folders.find(':', from), folders.size());
    const std::string folder = folders.substr(from, to - from);
    from = to + 1;
    if (!fs::is_directory(folder)) continue;
    for (const auto& entry : fs::recursive_directory_iterator(folder)) {
      const std::string extension = entry.path().extension().string();
      if (entry.is_regular_file() && (extension == ".glb" || extension == ".gltf"))
        files.push_back(entry.path().string());
    }
  }
  std::ranges::sort(files);
  return files;
}

bool areFinite(const scene::SceneDescription& description) {
  const scene::Bounds bounds = scene::boundsWorld(description, scene::ObjectFilter::all);
  return std::isfinite(glm::length(bounds.low) + glm::length(bounds.high));
}

TEST(GltfCorpora, OpenOrSayWhatIsWrong) {
  const char* folders = std::getenv("HALFSHADOW_GLTF_CORPORA");
  if (folders == nullptr) GTEST_SKIP() << "needs HALFSHADOW_GLTF_CORPORA, folders of glTF files";
  const std::vector<std::string> files = filesBelow(folders);
  ASSERT_FALSE(files.empty()) << folders << " holds no .gltf and no .glb file";
  std::size_t opened = 0, empty = 0;
  for (const std::string& file : files) {
    const auto begin = std::chrono::steady_clock::now();
    const auto scene = openScene(file, {});
    const double ms =
        std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count();
    std::string verdict = "opens";
    if (scene) {
      ++opened;
      EXPECT_TRUE(areFinite(*scene)) << file;
      EXPECT_TRUE(scene::checkCamera(*scene->camera).ok()) << file;
    } else {
      verdict = scene.error().message;
      ASSERT_GT(verdict.size(), file.size() + 2) << "a sentence behind the file's name";
      EXPECT_EQ(verdict.substr(0, file.size()), file);
      verdict = verdict.substr(file.size() + 2);
      empty += scene.error().code == ErrorCode::emptyScene;
      // The files of these tests hold what the format allows: nothing of them is malformed but what asks for
      // an extension that nobody knows.
      if (file.find("Output/Positive") != std::string::npos) {
        EXPECT_TRUE(scene.error().code == ErrorCode::emptyScene || verdict.find("FAKE_") != std::string::npos)
            << file << ": " << verdict;
      }
    }
    std::printf("%8.1f ms  %s: %s\n", ms, file.c_str(), verdict.substr(0, 160).c_str());
  }
  std::printf("%zu files: %zu open, %zu hold nothing to draw, %zu are refused\n", files.size(), opened, empty,
              files.size() - opened - empty);
}

}  // namespace
}  // namespace halfshadow::scenes
