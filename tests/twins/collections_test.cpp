// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// Files of public collections that come with the same sample image, byte for byte, mean the same: they must
// have the same picture here. Khronos' glTF-Asset-Generator has such, in Output/Positive:
//
//   HALFSHADOW_GLTF_CORPORA=/path/Output/Positive build/bin/twins_tests --gtest_filter='Collections.*'
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "measure/engine_session.hpp"
#include "scenes/scene_source.hpp"

namespace halfshadow::scenes {
namespace {
namespace fs = std::filesystem;

constexpr int kWidth = 160, kHeight = 120;

std::vector<std::string> folders(const char* list) {
  std::vector<std::string> result;
  std::istringstream stream(list);
  for (std::string folder; std::getline(stream, folder, ':');) {
    if (fs::is_directory(folder)) result.push_back(folder);
  }
  return result;
}

/// Files below a folder by the bytes of Figures/SampleImages/NAME.png or .gif beside them, and their folder.
std::map<std::string, std::vector<fs::path>> bySampleImage(const fs::path& below) {
  std::map<std::string, std::vector<fs::path>> groups;
  for (const auto& entry : fs::recursive_directory_iterator(below)) {
    const fs::path& file = entry.path();
    if (file.extension() != ".gltf" && file.extension() != ".glb") continue;
    for (const char* extension : {".png", ".gif"}) {
      const fs::path image =
          file.parent_path() / "Figures" / "SampleImages" / file.filename().replace_extension(extension);
      std::ifstream stream(image, std::ios::binary);
      if (!stream) continue;
      const std::string bytes{std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
      groups[file.parent_path().string() + bytes].push_back(file);
    }
  }
  for (auto& [key, files] : groups) std::ranges::sort(files);
  return groups;
}

/// Surfaces are matte here, in their diffuse colour: two of them that mirror the same look alike elsewhere.
bool isShadedAsMeant(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
  return text.find("KHR_materials_pbrSpecularGlossiness") == std::string::npos;
}

/// Shaded where that is as meant, then visibility by maps and by outlines; empty where there is nothing to
/// draw.
std::vector<std::uint8_t> picturesOf(measure::EngineSession& session, const fs::path& file) {
  const auto scene = openScene(file.string(), {});
  std::vector<std::uint8_t> pictures;
  if (!scene) {
    EXPECT_EQ(scene.error().code, ErrorCode::emptyScene) << scene.error().message;
    return pictures;
  }
  EXPECT_TRUE(session.renewEngine().ok());
  EXPECT_TRUE(session.load(*scene).ok());
  for (const auto& [technique, output] :
       {std::pair("hard", Output::shaded), std::pair("pcss-mip", Output::visibility),
        std::pair("wedges-cells", Output::visibility)}) {
    if (output == Output::shaded && !isShadedAsMeant(file)) continue;
    EXPECT_TRUE(session.choose(technique, {}).ok());
    const Status drawn = session.render({.camera = measure::cameraDesc(*scene->camera),
                                         .target = {.width = kWidth, .height = kHeight},
                                         .output = output});
    EXPECT_TRUE(drawn.ok()) << file << ": " << (drawn.ok() ? "" : drawn.error().message);
    const auto image = session.read(kWidth, kHeight);
    EXPECT_TRUE(image.ok());
    if (image.ok()) pictures.insert(pictures.end(), image->pixels.begin(), image->pixels.end());
  }
  return pictures;
}

TEST(Collections, FilesWithOneSampleImageHaveOnePicture) {
  const char* corpora = std::getenv("HALFSHADOW_GLTF_CORPORA");
  if (corpora == nullptr) GTEST_SKIP() << "needs HALFSHADOW_GLTF_CORPORA, folders of glTF files";
  const auto session = measure::EngineSession::open({});
  ASSERT_TRUE(session.ok()) << session.error().message;
  int twins = 0;
  for (const std::string& folder : folders(corpora)) {
    for (const auto& [key, files] : bySampleImage(folder)) {
      if (files.size() < 2) continue;
      const std::vector<std::uint8_t> first = picturesOf(**session, files[0]);
      for (std::size_t i = 1; i < files.size(); ++i) {
        const std::vector<std::uint8_t> other = picturesOf(**session, files[i]);
        ASSERT_EQ(other.size(), first.size()) << files[0] << " and " << files[i];
        int worst = 0, apart = 0;
        for (std::size_t k = 0; k < first.size(); ++k) {
          const int difference = std::abs(int{first[k]} - int{other[k]});
          worst = std::max(worst, difference);
          apart += difference > 3;  // colours in bytes instead of floats
        }
        EXPECT_LE(apart, static_cast<int>(first.size() / 2000)) << files[0] << " and " << files[i];
        std::printf("%s = %s: at most %d of 255 apart, %d channels by more than 3\n",
                    files[0].filename().c_str(), files[i].filename().c_str(), worst, apart);
        ++twins;
      }
    }
  }
  if (twins == 0) GTEST_SKIP() << corpora << " holds no files with the same sample image";
}

}  // namespace
}  // namespace halfshadow::scenes
