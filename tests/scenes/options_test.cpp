// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include <gtest/gtest.h>

#include <glm/trigonometric.hpp>

#include "scenes/camera_light_options.hpp"

namespace halfshadow::scenes {
namespace {

TEST(CameraOption, ReadsAllWordsInAnyOrder) {
  const auto camera = parseCamera("  target=1,2,-3   eye=-6.5,9,1.5e0 fov=60 up=0,0,1 ");
  ASSERT_TRUE(camera.ok()) << camera.error().message;
  EXPECT_EQ(camera->eyeWorld, glm::dvec3(-6.5, 9, 1.5));
  EXPECT_EQ(camera->targetWorld, glm::dvec3(1, 2, -3));
  EXPECT_EQ(camera->up, glm::dvec3(0, 0, 1));
  EXPECT_DOUBLE_EQ(camera->verticalFovRadians, glm::radians(60.0));
}

TEST(CameraOption, DefaultsTo34Degrees) {
  const auto camera = parseCamera("eye=0,0,5 target=0,0,0");
  ASSERT_TRUE(camera.ok());
  EXPECT_DOUBLE_EQ(camera->verticalFovRadians, glm::radians(34.0));
}

TEST(CameraOption, QuotesWhatIsWrong) {
  struct Case {
    const char *text, *quoted;
  };
  for (const Case& c : {Case{"target=0,0,0", "eye"},
                        {"eye=0,0,5", "target"},
                        {"eye=0,0 target=0,0,0", "eye=0,0"},
                        {"eye=0,0,x target=0,0,0", "eye=0,0,x"},
                        {"eye=0,0,inf target=0,0,0", "eye=0,0,inf"},
                        {"eye=0,0,5 target=0,0,0 fov=180", "fov=180"},
                        {"eye=0,0,5 target=0,0,0 near=1", "near=1"},
                        {"eye=0,0,5 eye=0,0,5 target=0,0,0", "twice"},
                        {"eye=0,0,5 target=0,0,5", "target"},
                        {"eye=0, 0,5 target=0,0,0", "0,5"}}) {
    const auto camera = parseCamera(c.text);
    ASSERT_FALSE(camera.ok()) << c.text;
    EXPECT_EQ(camera.error().code, ErrorCode::invalidCamera);
    EXPECT_NE(camera.error().message.find(c.quoted), std::string::npos) << camera.error().message;
  }
}

TEST(LightOption, ReadsTheAimedForm) {
  const auto light = parseLight("center=0,5,0 target=0,0,0 size=2x1 up=0,0,1");
  ASSERT_TRUE(light.ok()) << light.error().message;
  EXPECT_NEAR(glm::length(light->halfU), 1.0, 1e-12);
  EXPECT_NEAR(glm::length(light->halfV), 0.5, 1e-12);
  EXPECT_LT(glm::length(light->emission - glm::dvec3(0, -1, 0)), 1e-12);
  EXPECT_LT(glm::length(glm::normalize(glm::cross(light->halfU, light->halfV)) - light->emission), 1e-12);
  const auto square = parseLight("center=0,5,0 target=0,0,0 size=3");
  ASSERT_TRUE(square.ok());
  EXPECT_NEAR(glm::length(square->halfV), 1.5, 1e-12);
  EXPECT_TRUE(parseLight("center=0,5,0 target=0,0,0 size=0x0").ok()) << "a point light";
}

TEST(LightOption, ReadsTheVectorForm) {
  const auto light = parseLight("center=1,2,3 u=1,0,0 v=0,0,2");
  ASSERT_TRUE(light.ok());
  EXPECT_EQ(light->halfU, glm::dvec3(1, 0, 0));
  EXPECT_EQ(light->halfV, glm::dvec3(0, 0, 2));
  EXPECT_EQ(light->emission, glm::dvec3(0, -1, 0));
}

TEST(LightOption, ALightOfNoSizeShinesToASideOfItsOwn) {
  const auto down = parseLight("center=1,2,3 u=0,0,0 v=0,0,0");
  ASSERT_TRUE(down.ok());
  EXPECT_EQ(down->emission, glm::dvec3(0, -1, 0));
  const auto aimed = parseLight("center=0,0,0 target=0,0,7 size=0x0");
  ASSERT_TRUE(aimed.ok());
  EXPECT_EQ(aimed->halfU, glm::dvec3(0.0));
  EXPECT_EQ(aimed->emission, glm::dvec3(0, 0, 1));
}

TEST(LightOption, QuotesWhatIsWrong) {
  struct Case {
    const char *text, *quoted;
  };
  for (const Case& c : {Case{"", "center"},
                        {"center=0,5,0 target=0,0,0", "size"},
                        {"center=0,5,0 size=1x1", "target"},
                        {"center=0,5,0 target=0,0,0 size=1x2x3", "1x2x3"},
                        {"center=0,5,0 target=0,0,0 size=-1x1", "negative"},
                        {"center=0,5,0 u=1,0,0", "v=x,y,z"},
                        {"center=0,5,0 u=1,0,0 v=2,0,0", "parallel"},
                        {"center=0,5,0 u=1,0,0 v=0,0,0", "zero"},
                        {"center=0,5,0 target=0,0,0 size=2x0", "line"},
                        {"center=0,5,0 u=1,0,0 v=0,0,1 size=1x1", "mixed"},
                        {"center=0,5,0 target=0,5,0 size=1x1", "target"},
                        {"hello", "hello"}}) {
    const auto light = parseLight(c.text);
    ASSERT_FALSE(light.ok()) << c.text;
    EXPECT_EQ(light.error().code, ErrorCode::invalidLight);
    EXPECT_NE(light.error().message.find(c.quoted), std::string::npos) << light.error().message;
  }
}

}  // namespace
}  // namespace halfshadow::scenes
