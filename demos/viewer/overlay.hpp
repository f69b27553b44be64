// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// Draws what Dear ImGui lists, on OpenGL ES 2.0. Images are shown by what their bytes mean.
#pragma once

#include <imgui.h>

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "base/error.hpp"

namespace halfshadow::viewer {

/// How the texels of an image become a colour.
enum class Shown : std::uint32_t {
  blended,   ///< colour, with alpha
  opaque,    ///< colour alone
  red,       ///< first channel as grey
  alpha,     ///< last channel as grey
  word,      ///< first two channels, high byte first, as grey: Output::visibility16
  packed24,  ///< first three channels, highest first, as grey
};
inline constexpr std::size_t kShownCount = 6;
/// Only what is `blended` may be seen through: the others cover what they lie on.
ImTextureID imageId(std::uint32_t texture, Shown how);

/// A texture of the viewer's own.
class OwnTexture {
 public:
  OwnTexture() = default;
  ~OwnTexture();
  OwnTexture(const OwnTexture&) = delete;
  OwnTexture& operator=(const OwnTexture&) = delete;
  /// width × height × 4 bytes; the first row is at texture coordinate 0.
  void upload(int width, int height, const std::uint8_t* rgba);
  std::uint32_t name() const { return name_; }

 private:
  std::uint32_t name_ = 0;
};

class Overlay {
 public:
  /// Uploads the font of the current ImGui context. Errors: shaderFailed.
  static Result<std::unique_ptr<Overlay>> create();
  ~Overlay();
  Overlay(const Overlay&) = delete;
  Overlay& operator=(const Overlay&) = delete;
  /// Clears framebuffer 0 and draws. Sets every state that it depends on, and leaves what it has set.
  void draw(const ImDrawData& data);
  void rebuildFont();

 private:
  Overlay() = default;
  void bindStates(int width, int height);
  void drawList(const ImDrawData& data, const ImDrawList& list, int height);
  void use(const ImDrawData& data, Shown how);

  struct Program {
    std::uint32_t name = 0;
    int clipFromWindow = -1, image = -1;
  };
  std::array<Program, kShownCount> programs_{};
  std::uint32_t vertices_ = 0, indices_ = 0;
  OwnTexture font_;
};

/// Pixels of framebuffer 0, RGB, row 0 on top.
std::vector<std::uint8_t> windowPixels(int width, int height);
/// Texels of a rectangle of an image, RGBA bytes, first row at texture coordinate 0; nothing where the driver
/// cannot read images of its kind (depth textures).
std::optional<std::vector<std::uint8_t>> texels(std::uint32_t texture, int width, int height);
/// Errors of OpenGL since the last call, counted.
int takeGlErrors();

}  // namespace halfshadow::viewer
