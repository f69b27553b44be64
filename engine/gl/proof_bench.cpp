// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "gl/proof_bench.hpp"

#include <algorithm>
#include <array>

namespace halfshadow::gl {
namespace {

constexpr std::string_view kPaintVertex =
    "#version 100\nattribute vec2 a_position;\nvoid main() { gl_Position = vec4(a_position, 0.5, 1.0); }\n";
constexpr std::string_view kPaintFragment =
    "#version 100\nprecision mediump float;\nuniform vec4 u_color;\nvoid main() { gl_FragColor = u_color; "
    "}\n";

bool writesColor(const ProgramUse& use) {
  return std::ranges::any_of(use.state.colorMask, [](bool written) { return written; });
}
/// A variant's label names its defines.
bool fetchesFramebuffer(const Program& program) {
  return program.label().find("HS_USE_FETCH") != std::string::npos;
}
/// Whether the colour tells: what is written does not depend on what was there. Else the depth must.
bool showsByColor(const ProgramUse& use) {
  return writesColor(use) && !use.state.blend.enabled && !fetchesFramebuffer(*use.program);
}

/// Texels do not matter, but drivers compile whether a texture has mipmaps or sides that are powers of two.
device::TextureDesc smallest(device::TextureDesc desc) {
  const auto side = [&](int texels) { return (texels & (texels - 1)) == 0 ? (desc.mipmapped ? 2 : 1) : 3; };
  desc.width = side(desc.width);
  desc.height = side(desc.height);
  return desc;
}

/// As in use, but for what would keep the draw from leaving a trace.
DrawState tracedState(const ProgramUse& use, const Rect& pixel) {
  DrawState state = use.state;
  state.cull = Cull::none;
  state.stencil = {};
  state.scissor = pixel;
  state.polygonOffset.reset();
  state.depthRange = {0.0f, 1.0f};
  if (state.depth.test != Compare::always) state.depth.test = Compare::less;
  if (!showsByColor(use)) state.depth = {Compare::less, true};
  return state;
}

}  // namespace

Status ProofBench::makeTarget() {
  Context& context = encoder_.context();
  auto color = Texture::create(context, {.width = kColumns, .height = 2});
  if (!color) return color.error();
  color_ = std::move(*color);
  const bool deep = context.capabilities().has(device::Capability::depth24);
  auto depth = Renderbuffer::create(context, kColumns, 2,
                                    deep ? RenderbufferFormat::depth24 : RenderbufferFormat::depth16);
  if (!depth) return depth.error();
  depth_ = std::move(*depth);
  auto target = Framebuffer::create(context, {.color = &color_, .depth = &depth_});
  if (!target) return target.error();
  target_ = std::move(*target);
  return {};
}

/// The lower row to zeros, the upper one to ones: no colour is both.
void ProofBench::clear() {
  const Rect all{0, 0, kColumns, 2};
  PassBegin pass{.framebuffer = &target_, .viewport = all};
  pass.clear = {.color = glm::vec4(0.0f), .depth = 1.0f};
  encoder_.beginPass(pass);
  encoder_.endPass({});
  pass.clear = {.color = glm::vec4(1.0f)};
  const Rect upper{0, 1, kColumns, 1};
  pass.clearParts = {&upper, 1};
  encoder_.beginPass(pass);
  encoder_.endPass({});
}

Status ProofBench::bind(const ProgramUse& use) {
  for (const ProgramUse::Sampled& sampled : use.textures) {
    if (sampled.unit < 0) continue;
    const device::TextureDesc wanted = smallest(sampled.desc);
    auto found = std::ranges::find_if(textures_, [&](const auto& held) { return held.first == wanted; });
    if (found == textures_.end()) {
      auto made = Texture::create(encoder_.context(), wanted);
      if (!made) return made.error();
      textures_.emplace_back(wanted, std::move(*made));
      found = textures_.end() - 1;
    }
    const TextureBinding binding{sampled.unit, &found->second};
    encoder_.bindTextures({&binding, 1});
  }
  return {};
}

Status ProofBench::draw(const ProgramUse& use, int column) {
  Context& context = encoder_.context();
  Program& program = *use.program;
  encoder_.useProgram(program);
  program.set(context, "u_clipFromObject", glm::mat4(1.0f));
  program.set(context, "u_mapClipFromObject", glm::mat4(1.0f));
  program.set(context, "u_clipFromLight", glm::mat4(1.0f));
  program.set(context, "u_keepAll", 1.0f);
  program.set(context, "u_alphaCutoff",
              -1.0f);  // whatever texture is bound, it cuts no hole; draws set their own
  if (Status s = bind(use); !s) return s;
  // Two draws of a pixel: the same interpolated values for both.
  for (int row = 0; row < (showsByColor(use) ? 2 : 1); ++row) {
    const Rect pixel{column, row, 1, 1};
    encoder_.setViewport(pixel);
    encoder_.drawFullscreen(tracedState(use, pixel));
  }
  program.set(context, "u_keepAll", 0.0f);
  return {};
}

/// Ones where nothing has written a depth, zeros elsewhere, in the lower row.
void ProofBench::markUntouchedDepth(const Rect& columns, Program& paint) {
  encoder_.useProgram(paint);
  encoder_.setViewport(columns);
  DrawState state{.depth = {Compare::always, false}, .scissor = columns};
  for (const bool untouched : {false, true}) {
    paint.set(encoder_.context(), "u_color", glm::vec4(untouched ? 1.0f : 0.0f));
    if (untouched) state.depth.test = Compare::less;
    encoder_.drawFullscreen(state);
  }
}

Result<std::vector<bool>> ProofBench::traces(std::span<const ProgramUse* const> uses) {
  if (Status s = makeTarget(); !s) return s.error();
  Context& context = encoder_.context();
  auto paint = Program::link(context, kPaintVertex, kPaintFragment, {}, "paint of proofs");
  if (!paint) return paint.error();
  clear();
  encoder_.beginPass({.framebuffer = &target_, .viewport = {0, 0, kColumns, 2}});
  for (std::size_t i = 0; i < uses.size(); ++i) {
    if (Status s = draw(*uses[i], static_cast<int>(i)); !s) return s.error();
  }
  for (std::size_t i = 0; i < uses.size(); ++i) {
    if (!showsByColor(*uses[i])) markUntouchedDepth({static_cast<int>(i), 0, 1, 1}, *paint);
  }
  // The last column is never drawn to: it must be found so.
  constexpr int kControl = kColumns - 1;
  markUntouchedDepth({kControl, 0, 1, 1}, *paint);
  encoder_.endPass({});
  std::vector<std::uint8_t> rgba(static_cast<std::size_t>(kColumns) * 2 * 4);
  encoder_.readPixels(target_, {0, 0, kColumns, 2}, rgba.data());
  if (Status s = context.checkErrors("proving that programs draw"); !s) return s.error();

  const auto byte = [&](std::size_t column, std::size_t row, std::size_t channel) {
    return rgba[(row * kColumns + column) * 4 + channel];
  };
  if (byte(kControl, 0, 0) != 255) {
    return Error{ErrorCode::driverFault, "a depth that nothing has written is not found untouched"};
  }
  std::vector<bool> traced(uses.size(), false);
  for (std::size_t i = 0; i < uses.size(); ++i) {
    if (!showsByColor(*uses[i])) {
      traced[i] = byte(i, 0, 0) != 255;
      continue;
    }
    for (std::size_t channel = 0; channel < 4; ++channel) {
      const bool untouched = byte(i, 0, channel) == 0 && byte(i, 1, channel) == 255;
      if (uses[i]->state.colorMask[channel] && !untouched) traced[i] = true;
    }
  }
  return traced;
}

}  // namespace halfshadow::gl
