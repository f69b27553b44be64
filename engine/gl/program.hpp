// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// Linked programs and their cache. Uniforms are found by a hash made at compile time, never by string at
/// a draw.
#pragma once

#include <cstdint>
#include <functional>
#include <glm/glm.hpp>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.hpp"
#include "device/draw_state.hpp"
#include "device/shader_family.hpp"
#include "device/uniforms.hpp"
#include "gl/objects.hpp"

namespace halfshadow::gl {

using device::ProgramVariant;
using device::UniformKey;
using device::VertexAttribute;

/// "a_position", "a_normal", "a_texcoord", "a_extra0" …
const char* attributeName(VertexAttribute attribute);

/// Setting a uniform the program lacks is ignored (variants drop what they do not use). Values are cached:
/// an unchanged value is not sent again. The encoder makes the program current.
class Program {
 public:
  /// The active samplers of `samplerNames` get units 0, 1, 2 … in that order at link time; active samplers it
  /// does not name follow. Errors: shaderFailed with the driver's log and `label`.
  static Result<Program> link(Context& context, std::string_view vertexSource,
                              std::string_view fragmentSource, const std::vector<std::string>& samplerNames,
                              std::string_view label);
  /// A linked program of the host's, never deleted here; its samplers keep their units until setSampler().
  static Program wrap(Context& context, std::uint32_t name);
  std::uint32_t name() const { return wrapped_ ? wrapped_ : object_.name(); }
  const std::string& label() const { return label_; }
  /// Of both texts; 0 of a host's program.
  std::uint64_t sourceKey() const { return sourceKey_; }
  /// A number that its text carries in the name of a uniform, kTextKeyPrefix and 16 hexadecimal digits;
  /// 0 = none.
  static constexpr std::string_view kTextKeyPrefix = "halfshadow_lit_";
  std::uint64_t textKey() const { return textKey_; }
  void setTextKeyUniform(Context& context, float value) { set(context, textKeyUniform_, value); }
  /// Makes a sampler read from a unit; the program must be current.
  void setSampler(Context& context, UniformKey key, int unit);
  bool has(UniformKey key) const { return find(key) != nullptr; }
  /// Unit of a sampler, −1 when the program has none of that name. Use it as TextureBinding::unit.
  int samplerUnit(UniformKey key) const;

  void set(Context& context, UniformKey key, float value);
  void set(Context& context, UniformKey key, const glm::vec2& value);
  void set(Context& context, UniformKey key, const glm::vec3& value);
  void set(Context& context, UniformKey key, const glm::vec4& value);
  void set(Context& context, UniformKey key, const glm::mat3& value);
  void set(Context& context, UniformKey key, const glm::mat4& value);
  /// `count` at least 1; elements past the array's end are ignored.
  void setArray(Context& context, UniformKey key, const glm::vec4* values, int count);
  void setArray(Context& context, UniformKey key, const glm::vec2* values, int count);
  void set(Context& context, const device::UniformList& uniforms);

 private:
  struct Uniform {
    std::uint32_t hash = 0;
    int location = -1;
    std::uint32_t type = 0;  ///< the GL type
    int arraySize = 1;
    int samplerUnit = -1;
    std::vector<float> last;
  };
  void reflect(Context& context, const std::vector<std::string>& samplerNames);
  const Uniform* find(UniformKey key) const;
  const Uniform* findUniform(std::uint32_t hash) const;
  Uniform* findUniform(std::uint32_t hash);
  /// The uniform when it exists and its last value differs (then updated), else null.
  Uniform* changed(Context& context, UniformKey key, const float* values, std::size_t count);
  Object<ObjectKind::program> object_;
  std::uint32_t wrapped_ = 0;
  std::uint64_t sourceKey_ = 0;
  std::vector<Uniform> uniforms_;
  std::uint64_t textKey_ = 0;
  UniformKey textKeyUniform_ = "";
  std::string label_;
};

/// Text of a shader file by its name below shaders_es2/ ("map/pcf.frag"), or null.
using ShaderSourceProvider = std::function<const char*(std::string_view fileName)>;

/// The source of one shader stage, told by the file name's end (".frag" or ".vert"). In this order: version,
/// extension lines, HS_NO_HIGHP when the context lacks fragment highp, `defines`, the precision lines, the
/// file with `#include "file.glsl"` expanded (one level). The precision lines define, for both stages,
///   HS_HIGHP   the best precision of this stage (in a fragment shader mediump under HS_NO_HIGHP);
///   HS_SHARED  the precision of uniforms declared in both stages, the same in both, as ES 2.0 demands.
/// Extension lines: derivatives whenever the context has them (then HS_DERIVATIVES is defined); framebuffer
/// fetch and texture lod only when `defines` contains HS_USE_FETCH or HS_USE_LOD, and the former defines
/// HS_LAST_COLOR, the pixel's current color. Lines in the driver's log are SOURCE:LINE with source 0 the file
/// and 1, 2, … its includes in order.
/// Errors: shaderFailed (file absent, include malformed, absent or nested; capability of HS_USE_… missing).
Result<std::string> assembleShader(const ShaderSourceProvider& provider, std::string_view fileName,
                                   const std::vector<std::string>& defines,
                                   const device::Capabilities& capabilities);

/// Names of `uniform … sampler2D` declarations in order of appearance, each once; comments are skipped.
std::vector<std::string> samplerNamesOf(std::string_view source);

class ProgramCache {
 public:
  /// `families`: variants outside them are refused, so that what the tests compile is all there is; empty =
  /// everything is allowed.
  ProgramCache(Context& context, ShaderSourceProvider provider,
               std::vector<device::ShaderFamily> families = {});
  /// Linked on first use, kept until clear(). The pointer stays valid until then. Errors: internal for a
  /// variant outside the families; shaderFailed with the driver's log and the variant.
  Result<Program*> get(const ProgramVariant& variant);
  /// Sources as get() would compile them.
  struct Sources {
    std::string vertex, fragment;
  };
  Result<Sources> assemble(const ProgramVariant& variant) const;
  void clear();
  /// From here on programs are noted as used, for trim().
  void beginFrame() { ++frame_; }
  void trim();  ///< drops those that nobody asked for since beginFrame()
  std::size_t size() const { return programs_.size(); }
  const device::Capabilities& capabilities() const { return context_.capabilities(); }

 private:
  Context& context_;
  ShaderSourceProvider provider_;
  std::vector<device::ShaderFamily> families_;
  struct Cached {
    std::unique_ptr<Program> program;
    std::uint64_t frame = 0;  ///< in which it was last asked for
  };
  std::map<ProgramVariant, Cached> programs_;
  std::uint64_t frame_ = 0;
};

}  // namespace halfshadow::gl
