// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// Plain data: no OpenGL, no mathematics library, no containers. Places lie within 1e30 of the origin.
#pragma once

#include <cstddef>
#include <cstdint>

#include "halfshadow/error_codes.h"

namespace halfshadow {

enum class ErrorCode : int {
#define HALFSHADOW_ERROR_ENUM(name, NAME, text) name,
  HALFSHADOW_ERROR_LIST(HALFSHADOW_ERROR_ENUM)
#undef HALFSHADOW_ERROR_ENUM
};

/// How a call ended. `message` is one sentence that names what to change; it belongs to the engine (or is a
/// literal) and lives until the engine's next call.
struct Outcome {
  ErrorCode code = ErrorCode::ok;
  const char* message = "";
  bool ok() const { return code == ErrorCode::ok; }
};

/// What the engine leaves of the host's OpenGL ES state after each call.
enum class HostState {
  restore,        ///< everything is put back
  leaveDefaults,  ///< the specification's initial values
  leaveDirty      ///< undefined; fastest
};

struct EngineDesc {
  /// Address of an OpenGL ES entry point, or null. Required.
  void* (*getProcAddress)(const char* name, void* user) = nullptr;
  void* getProcAddressUser = nullptr;
  /// Capabilities treated as absent ("depth-texture", "highp", …); for testing fallbacks.
  const char* const* forcedOff = nullptr;
  std::size_t forcedOffCount = 0;
  HostState hostState = HostState::restore;
  /// Folder that replaces the embedded shaders, or null.
  const char* shaderFolder = nullptr;
  /// What Engine::programProofs() gave at an earlier time, or null: those programs are not proven again. Of
  /// another driver, or malformed: as null. Read by create() alone.
  const char* programProofs = nullptr;
  /// Lends threads to render(): does work(0, job) to work(count - 1, job), each once, in any order and on any
  /// threads, the calling one among them, and returns when all have returned. Work calls neither OpenGL ES
  /// nor the host, and nothing leaves it as an exception. Null: everything is done on the calling thread.
  /// Pictures are the same. Worth it where wedges-cells or wedges-blended make lists for dense casters that
  /// move.
  void (*parallelFor)(std::size_t count, void (*work)(std::size_t index, void* job), void* job,
                      void* user) = nullptr;
  void* parallelForUser = nullptr;
};

/// A triangle list, copied during the call. Closed shells may be wound either way, even unlike themselves:
/// the engine winds them outward. Everything is seen, and casts, from both sides.
struct MeshDesc {
  const float* positions = nullptr;  ///< vertexCount × 3, object space, scene units
  std::size_t positionStrideBytes = 12;
  std::uint32_t vertexCount = 0;
  const std::uint32_t* indices = nullptr;  ///< indexCount entries, or null for 0, 1, 2, …
  std::size_t indexCount = 0;
  const float* normals = nullptr;    ///< vertexCount × 3, unit, or null (facets are shaded flat)
  const float* texcoords = nullptr;  ///< vertexCount × 2, or null
  const float* colors = nullptr;     ///< vertexCount × 4, linear, multiply the base colour; or null
};

/// What an image holds beyond its borders.
enum class ImageWrap { repeat, clampToEdge, mirroredRepeat };
/// How it is read between its texels.
enum class ImageFilter { linear, nearest };

struct ObjectDesc {
  MeshDesc mesh;
  double worldFromObject[16] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};  ///< column-major, affine
  bool casts = true;                              ///< may shadow others (and itself)
  bool receives = true;                           ///< is drawn, with visibility
  float baseColor[4] = {0.8f, 0.8f, 0.8f, 1.0f};  ///< linear
  const std::uint8_t* baseColorPixels = nullptr;  ///< sRGB, baseColorChannels (3 or 4) a pixel, top row first
  int baseColorWidth = 0, baseColorHeight = 0, baseColorChannels = 4;  ///< sides: at most 65536 texels
  ImageWrap baseColorWrapU = ImageWrap::repeat, baseColorWrapV = ImageWrap::repeat;
  ImageFilter baseColorFilter = ImageFilter::linear;
  /// Above 0: where the alpha of base colour, image and vertex colour together is less, nothing is there: it
  /// is not drawn, and casts no shadow. Shadow volumes and wedges cut the mesh along alpha the first time
  /// that they take its outline; frames' reports say where it takes more triangles than they make. 0: all of
  /// it is there, and alpha means nothing. Not above 1.
  float alphaCutoff = 0.0f;
  /// The camera is not shown its back faces: those that it sees wound clockwise, with worldFromObject as it
  /// is, counter-clockwise where that mirrors. Closed meshes without holes show theirs all the same, to a
  /// camera inside, and so do meshes with closed parts wound inward, which are turned when added. Shadows
  /// fall from both sides.
  bool singleSided = false;
};
using ObjectId = std::uint32_t;

/// The points center + a·halfU + b·halfV, a and b in [-1, 1], world units; shines into the half-space on the
/// side of halfU × halfV, and not at all behind its own plane.
/// Both half vectors zero: a point that shines into the half-space on the side of `emission`, like a
/// rectangle too small to see. u = v = 0 alone leaves `emission` as it is, downward. One half vector zero, or
/// both along one line, is an error: such a light has no side.
/// Surfaces behind the light's plane get none of its light; their visibility is 1 by convention.
struct LightDesc {
  double center[3] = {0, 0, 0};
  double halfU[3] = {0, 0, 0};
  double halfV[3] = {0, 0, 0};
  double emission[3] = {0, -1, 0};  ///< read only when both half vectors are zero; need not be unit
  float color[3] = {1, 1, 1};
  double intensity = 1.0;
  /// Where the intensity counts fully, world units; it falls with the square of the distance, up to 4 times
  /// as much near the light. 0: the same at every distance, as of a sun. Only shading reads it.
  double referenceDistance = 0.0;
  /// Of a spot: half angles about `emission`, radians; full light inside the inner one, none outside the
  /// outer. An outer angle of 0: no cone. Only shading reads them: visibility is that of the whole light.
  double innerConeRadians = 0.0, outerConeRadians = 0.0;
};
inline constexpr int kMaxLights = 4;

struct CameraDesc {
  double eye[3] = {0, 0, 5};
  double target[3] = {0, 0, 0};
  double up[3] = {0, 1, 0};
  double verticalFovRadians = 0.8;
  double nearDistance = 0.1, farDistance = 1000.0;
};

enum class Output {
  shaded,      ///< lit colours of all lights; one light is evaluated forward, in the same pass
  visibility,  ///< light i in channel i, 8 bits; a single light in all four channels; 1 where no receiver is
  visibility16,  ///< first light, red high byte, green low byte; value = (256·red + green) / 65280
  taps,          ///< first light, texture fetches of the visibility function; red low byte, green high byte
  lightsOnly     ///< light and mask passes alone: receivers are drawn by the host, forward (see bindForward)
};

/// Where a frame goes.
struct TargetDesc {
  enum class Kind {
    engine,  ///< a texture of the engine's own (see Engine::outputTexture, Engine::readOutput)
    host     ///< a framebuffer of the host's, with depth; cleared inside the rectangle
  };
  Kind kind = Kind::engine;
  std::uint32_t framebuffer = 0;  ///< host only; 0 is allowed
  int x = 0, y = 0;
  int width = 0, height = 0;
};

enum class Timing { off, perPass };

/// Which receivers the light passes are made for. Casters that shadow none of them are left out.
enum class Receivers {
  seen,      ///< objects that `camera` sees
  anywhere,  ///< objects wherever they are: the host draws other views of them from the same frame
  unknown    ///< also surfaces that the engine was never told of, as far from the light as four times the
             ///< farthest caster
};

struct RenderDesc {
  CameraDesc camera;
  TargetDesc target;
  Output output = Output::shaded;
  Timing timing = Timing::off;
  Receivers receivers = Receivers::seen;
  float clearColor[4] = {0.045f, 0.055f, 0.075f, 1.0f};  ///< of shaded output
};

struct PassRecord {
  const char* name = "";
  const char* target = "";
  std::uint64_t draws = 0, triangles = 0;
  bool clear = false, load = false, store = false, discard = false;
  std::uint64_t bytesLoaded = 0, bytesStored = 0;
  double milliseconds = 0.0;  ///< only with Timing::perPass
  bool lightSpace = false;    ///< a shadow map or mask pass, as opposed to a pass over receivers
};

struct SkipRecord {
  const char* what = "";
  const char* why = "";
};

/// What a frame did. Pointers live until the next frame or report.
struct FrameReport {
  const PassRecord* passes = nullptr;
  std::size_t passCount = 0;
  const SkipRecord* skips = nullptr;
  std::size_t skipCount = 0;
  std::uint64_t framebufferSwitches = 0, draws = 0, triangles = 0;
  std::uint64_t bytesLoaded = 0, bytesStored = 0, textureBytesUploaded = 0, bufferBytesUploaded = 0;
  std::uint64_t memoryBytes = 0;  ///< of textures, renderbuffers and buffers that the engine holds
  /// Casters whose silhouette was found anew, once for each point of a light that the technique sees it from.
  std::uint64_t silhouettesExtracted = 0;
  /// Casters drawn into maps and slices, once for each that they are drawn into; and those which such maps
  /// held and kept, where only a part was drawn again in which others moved (setting map_updates).
  std::uint64_t castersDrawn = 0, castersKept = 0;
  const char* planText = "";  ///< passes, attachments and bytes as a table
  const char* planGraphviz = "";
};

/// A texture that the last frame drew, or read as a table: shadow map, mask, pyramid, list, …
struct ImageRecord {
  const char* name = "";      ///< "light 0 map"; that of its pass or of the technique's table
  std::uint32_t texture = 0;  ///< the engine's; bottom row first
  int width = 0, height = 0;  ///< texels of level 0
  const char* format = "";    ///< "rgba8", "depth24", …
};

/// GLSL ES 1.00 that a host puts right behind the #version line of its own shaders to receive one light's
/// shadows in its own pass. Texts live until the engine's next call.
struct ForwardRecord {
  /// Declares `void halfshadow_receive(highp vec4 positionObject, highp vec3 facetNormalObject)`: call it in
  /// main.
  const char* vertexGlsl = "";
  /// Declares `float halfshadow_visibility()`: call it once, outside branches. Sets the default precision.
  const char* fragmentGlsl = "";
  int textureUnits = 0;  ///< that bindForward uses, at most
  bool readsFacetNormal =
      false;                 ///< the host must pass the triangle's normal (derivatives or highp are missing)
  std::uint64_t serial = 0;  ///< of the texts, see ForwardSerials::source
};

/// Numbers to compare with those of the frame before.
struct ForwardSerials {
  std::uint64_t source = 0;    ///< changes when the texts do: a program made from others is refused
  std::uint64_t bindings = 0;  ///< changes when uniforms or textures may have: bindForward is due again
};

/// What the engine holds on the GPU, for all techniques and objects together.
struct MemoryRecord {
  std::uint64_t bytes = 0;       ///< of textures, renderbuffers and buffers, by their formats
  std::uint64_t limitBytes = 0;  ///< of setMemoryLimit(); 0 = none
  int textures = 0, renderbuffers = 0, framebuffers = 0, buffers = 0, programs = 0;
};

enum class Trim {
  unused,     ///< what the last frame did not need: images of other sizes, programs of other techniques
  everything  ///< all but meshes and their textures: the next frame makes anew what it needs
};

struct CapabilityRecord {
  const char* name = "";
  const char* text = "";
  bool available = false;
  const char* reason = "";
};

struct TechniqueRecord {
  const char* id = "";
  const char* paper = "";
  const char* summary = "";
  const char* guarantees = "";
  const char* knownFailures = "";
  bool supported = false;
  const char* unsupportedReason = "";
};

struct SettingRecord {
  const char* key = "";
  const char* type = "";  ///< "integer", "real" or "choice"
  const char* defaultValue = "";
  const char* value = "";
  const char* allowed = "";  ///< "2 to 17" or "grid, poisson"
  const char* text = "";
};

struct DriverRecord {
  const char* vendor = "";
  const char* renderer = "";
  const char* version = "";
  const char* shadingLanguageVersion = "";
  const char* depthStorage = "";  ///< the rung chosen for shadow maps
  const char* byteRounding = "";  ///< of RGBA8 targets, measured
  int highpMantissaBits = 0, mediumpMantissaBits = 0;
  int maxTextureSize = 0, maxVaryingVectors = 0, maxFragmentUniformVectors = 0, maxVertexUniformVectors = 0;
  int maxFragmentTextureUnits = 0, maxVertexTextureUnits = 0, maxVertexAttributes = 0,
      maxRenderbufferSize = 0;
};

}  // namespace halfshadow
