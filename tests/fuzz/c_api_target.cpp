// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
// Sequences of calls through halfshadow.h, drawn by the process's driver: whatever a host sends, in whatever
// order, an engine answers with a sentence or does it; no OpenGL ES error and no memory is left, and after it
// a known scene looks as it did before.
#include <algorithm>
#include <array>
#include <cstdlib>
#include <memory>

#include "egl/headless.hpp"
#include "gl/functions.hpp"
#include "halfshadow/halfshadow.h"
#include "input_reader.hpp"

namespace halfshadow::fuzz {
namespace {
constexpr int kWidth = 24, kHeight = 18;
constexpr std::uint64_t kMemoryLimit = 48u << 20;
constexpr int kInputsPerEngine = 64;
constexpr const char* kTechniques[] = {"none",
                                       "hard",
                                       "pcf",
                                       "pcf-masked",
                                       "pcf-quantized",
                                       "pcss",
                                       "pcss-mip",
                                       "vsm",
                                       "occlusion-textures",
                                       "shadow-width",
                                       "shadow-volume",
                                       "wedges",
                                       "wedges-probabilistic",
                                       "wedges-blended",
                                       "wedges-cells",
                                       "sampled"};
constexpr const char* kSettings[][2] = {{"map_size", "32"},
                                        {"map_size", "64"},
                                        {"sub_lights", "1"},
                                        {"sub_lights", "3"},
                                        {"shading", "apart"},
                                        {"program_size", "short"},
                                        {"filter_skip", "branch"},
                                        {"filter_skip", "loop"},
                                        {"pcf.size", "4"},
                                        {"pcf.pattern", "poisson"},
                                        {"sampled.samples", "3"},
                                        {"occlusion-textures.slices", "4"},
                                        {"shadow-width.preset", "paper"},
                                        {"wedges-cells.route", "scatter"},
                                        {"bias", "1e0"},
                                        {"map_size", "7.0"}};
/// Unit cube and square, as hosts have them.
constexpr float kCube[] = {-1, -1, -1, 1, -1, -1, 1, 1, -1, -1, 1, -1,
                           -1, -1, 1,  1, -1, 1,  1, 1, 1,  -1, 1, 1};
constexpr std::uint32_t kCubeIndices[] = {0, 2, 1, 0, 3, 2, 4, 5, 6, 4, 6, 7, 0, 1, 5, 0, 5, 4,
                                          3, 6, 2, 3, 7, 6, 0, 4, 7, 0, 7, 3, 1, 2, 6, 1, 6, 5};
constexpr float kSquare[] = {-9, 0, -9, -9, 0, 9, 9, 0, -9, 9, 0, 9};
constexpr std::uint32_t kSquareIndices[] = {0, 1, 2, 2, 1, 3};

struct Process {
  std::unique_ptr<HeadlessContext> context;
  gl::Functions functions;
};

Process& process() {
  static Process made = [] {
    Process opened;
    const char* driver = std::getenv("HALFSHADOW_TEST_DRIVER");
    auto context = createHeadless({.driver = driver ? driver : "llvmpipe"});
    require(context.ok(), context ? "" : context.error().message);
    opened.context = std::move(context).value();
    opened.functions.load(
        [raw = opened.context.get()](const char* name) { return raw->getProcAddress(name); });
    return opened;
  }();
  return made;
}

HalfshadowEngineDesc engineDesc(const std::string& proofs) {
  HalfshadowEngineDesc desc = {};
  desc.struct_size = sizeof desc;
  desc.get_proc_address = [](const char* name, void*) { return process().context->getProcAddress(name); };
  desc.program_proofs = proofs.empty() ? nullptr : proofs.c_str();
  return desc;
}

HalfshadowObjectDesc objectDesc(bool square) {
  HalfshadowObjectDesc desc = {};
  desc.struct_size = sizeof desc;
  desc.positions = square ? kSquare : kCube;
  desc.vertex_count = square ? 4 : 8;
  desc.indices = square ? kSquareIndices : kCubeIndices;
  desc.index_count = square ? 6 : 36;
  desc.casts = square ? 0 : 1;
  desc.receives = 1;
  for (float& channel : desc.base_color) channel = 1.0f;
  return desc;
}

HalfshadowLightDesc lightDesc() {
  HalfshadowLightDesc desc = {};
  desc.struct_size = sizeof desc;
  desc.center[1] = 9.0;
  desc.half_u[0] = 0.75;
  desc.half_v[2] = -0.75;
  for (float& channel : desc.color) channel = 1.0f;
  desc.intensity = 1.0;
  return desc;
}

HalfshadowRenderDesc renderDesc() {
  HalfshadowRenderDesc desc = {};
  desc.struct_size = sizeof desc;
  desc.eye[1] = 7.0;
  desc.eye[2] = 9.0;
  desc.up[1] = 1.0;
  desc.vertical_fov_radians = 0.9;
  desc.near_distance = 0.5;
  desc.far_distance = 60.0;
  desc.width = kWidth;
  desc.height = kHeight;
  desc.output = HALFSHADOW_VISIBILITY;
  return desc;
}

using Picture = std::array<std::uint8_t, 4 * kWidth * kHeight>;

/// One engine and what a host knows of it.
class Host {
 public:
  explicit Host(const std::string& proofs) {
    const HalfshadowEngineDesc desc = engineDesc(proofs);
    const char* message = "";
    engine_ = halfshadow_create(&desc, nullptr, &message);
    require(engine_ != nullptr, message);
    (void)known();
    emptyBytes_ = reset();
  }
  ~Host() { halfshadow_destroy(engine_); }
  Host(const Host&) = delete;
  Host& operator=(const Host&) = delete;

  std::string proofs() { return halfshadow_program_proofs(engine_); }

  void call(InputReader& reader);

  /// Back to what a fresh engine holds; the bytes that it has then.
  std::uint64_t reset() {
    expect(halfshadow_set_memory_limit(engine_, kMemoryLimit));
    for (const std::uint32_t id : ids_) expect(halfshadow_remove_object(engine_, id));
    ids_.clear();
    expect(halfshadow_set_lights(engine_, nullptr, 0));
    for (const auto& [key, value] : changed_) expect(halfshadow_set(engine_, key.c_str(), value.c_str()));
    changed_.clear();
    expect(halfshadow_set_technique(engine_, "hard"));
    HalfshadowRenderDesc desc = renderDesc();
    HalfshadowReport report = {};
    report.struct_size = sizeof report;
    expect(halfshadow_render(engine_, &desc, &report));
    expect(halfshadow_trim(engine_, HALFSHADOW_TRIM_UNUSED));
    expect(halfshadow_render(engine_, &desc, &report));
    return report.memory_bytes;
  }

  /// A cube over a square under a light, by `hard`.
  Picture known() {
    expect(halfshadow_set_technique(engine_, "hard"));
    expect(halfshadow_set(engine_, "map_size", "64"));
    changed_.emplace_back("map_size", "1024");
    for (const bool square : {true, false}) {
      HalfshadowObjectDesc object = objectDesc(square);
      if (!square) {
        for (int i : {0, 5, 10, 15}) object.world_from_object[i] = 1.0;
        object.world_from_object[13] = 2.5;
      }
      std::uint32_t id = 0;
      expect(halfshadow_add_object(engine_, &object, &id));
      ids_.push_back(id);
    }
    const HalfshadowLightDesc light = lightDesc();
    expect(halfshadow_set_lights(engine_, &light, 1));
    const HalfshadowRenderDesc desc = renderDesc();
    expect(halfshadow_render(engine_, &desc, nullptr));
    Picture picture{};
    expect(halfshadow_read_output(engine_, picture.data(), picture.size()));
    return picture;
  }

  void check(const Picture& wanted) {
    require(reset() == emptyBytes_, "an empty engine holds more or less than before");
    require(known() == wanted, "a known scene looks unlike before");
    reset();
  }

 private:
  void expect(HalfshadowError error) const {
    require(error == HALFSHADOW_OK, std::string("a valid call fails: ") + halfshadow_message(engine_));
  }
  void answer(HalfshadowError error) const {
    require(error >= HALFSHADOW_OK && error < HALFSHADOW_INTERNAL,
            std::string("not an error of the list, or internal: ") + halfshadow_message(engine_));
    require((error == HALFSHADOW_OK) == (halfshadow_message(engine_)[0] == '\0'),
            "a sentence after success, or none after failure");
    require(process().functions.getError() == GL_NO_ERROR, "an OpenGL ES error is left");
  }
  void addObject(InputReader& reader);
  void setLights(InputReader& reader);
  void render(InputReader& reader);
  void set(InputReader& reader);
  void setTransform(InputReader& reader);
  void loseContext(InputReader& reader);
  std::uint32_t idOf(InputReader& reader) const {
    const std::uint8_t choice = reader.byte();
    return ids_.empty() || choice >= 240 ? choice : ids_[choice % ids_.size()];
  }

  HalfshadowEngine* engine_ = nullptr;
  std::uint64_t emptyBytes_ = 0;
  std::vector<std::uint32_t> ids_;
  std::vector<std::pair<std::string, std::string>> changed_;  ///< settings and their defaults
};

void Host::addObject(InputReader& reader) {
  const std::uint8_t kind = reader.byte();
  HalfshadowObjectDesc desc = objectDesc((kind & 1) != 0);
  desc.casts = (kind & 2) != 0;
  desc.receives = (kind & 4) != 0;
  std::vector<float> positions, colors;
  std::vector<std::uint32_t> indices;
  std::vector<std::uint8_t> pixels;
  if ((kind & 8) != 0) {  // triangles of its own
    for (std::size_t i = reader.below(40); i > 0; --i)
      positions.push_back(static_cast<float>(reader.number()));
    for (std::size_t i = reader.below(30); i > 0; --i)
      indices.push_back(static_cast<std::uint32_t>(reader.below(15)));
    desc.positions = positions.data();
    desc.vertex_count = static_cast<std::uint32_t>(positions.size() / 3);
    desc.indices = indices.data();
    desc.index_count = indices.size();
  }
  if ((kind & 16) != 0) {  // colours, an image, holes
    colors.assign(std::size_t{4} * desc.vertex_count + 4, 0.75f);
    for (std::size_t i = 0; i < 4; ++i) colors[i] = static_cast<float>(reader.number());
    desc.colors = colors.data();
    desc.texcoords = colors.data();
    desc.base_color_width = static_cast<int>(reader.below(9));
    desc.base_color_height = static_cast<int>(reader.below(9));
    desc.base_color_channels = static_cast<int>(reader.below(6));
    pixels.assign(9 * 9 * 4, reader.byte());
    desc.base_color_pixels = pixels.data();
    desc.alpha_cutoff = static_cast<float>(reader.number());
  }
  if ((kind & 32) != 0) {
    for (int i : {0, 5, 10, 15}) desc.world_from_object[i] = 1.0;
    for (int i : {0, 5, 10, 12, 13, 14}) desc.world_from_object[i] = reader.number();
  }
  if (kind >= 252) desc.struct_size = reader.byte();
  std::uint32_t id = 0;
  const HalfshadowError added = halfshadow_add_object(engine_, &desc, &id);
  answer(added);
  require((added == HALFSHADOW_OK) == (id != 0), "an id of nothing, or none");
  if (added == HALFSHADOW_OK) ids_.push_back(id);
}

void Host::setTransform(InputReader& reader) {
  double matrix[16] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
  const std::uint32_t id = idOf(reader);
  for (std::size_t i = 1 + reader.below(6); i > 0; --i) matrix[reader.below(16)] = reader.number();
  answer(halfshadow_set_transform(engine_, id, matrix));
}

void Host::setLights(InputReader& reader) {
  HalfshadowLightDesc lights[6];
  const std::size_t count = reader.below(6);
  for (std::size_t i = 0; i < count; ++i) {
    lights[i] = lightDesc();
    lights[i].center[0] = 1.5 * static_cast<double>(i);
    const std::uint8_t kind = reader.byte();
    if ((kind & 1) != 0)
      for (double& value : lights[i].center) value = reader.number();
    if ((kind & 2) != 0)
      for (double* half : {lights[i].half_u, lights[i].half_v})
        for (int axis = 0; axis < 3; ++axis) half[axis] = reader.number();
    if ((kind & 4) != 0) {
      lights[i].intensity = reader.number();
      lights[i].reference_distance = reader.number();
      lights[i].outer_cone_radians = reader.number();
      lights[i].color[1] = static_cast<float>(reader.number());
      for (double& value : lights[i].emission) value = reader.number();
    }
    if (kind >= 252) lights[i].struct_size = 1;
  }
  answer(halfshadow_set_lights(engine_, lights, count));
}

void Host::set(InputReader& reader) {
  const std::uint8_t choice = reader.byte();
  std::string key, value, before;
  if (choice < 200) {
    key = kSettings[choice % std::size(kSettings)][0];
    value = kSettings[choice % std::size(kSettings)][1];
  } else {
    key = reader.text(24);
    value = reader.text(12);
  }
  // The C interface does not tell what a setting was: those that are known go back by their names.
  constexpr const char* kDefaults[][2] = {{"map_size", "1024"},       {"sub_lights", "auto"},
                                          {"shading", "together"},    {"program_size", "full"},
                                          {"filter_skip", "stencil"}, {"bias", "1.0"}};
  answer(halfshadow_set(engine_, key.c_str(), value.c_str()));
  for (const auto& known : kDefaults) {
    if (key == known[0]) changed_.emplace_back(known[0], known[1]);
  }
}

void Host::render(InputReader& reader) {
  HalfshadowRenderDesc desc = renderDesc();
  const std::uint8_t kind = reader.byte();
  desc.output = static_cast<HalfshadowOutput>(kind % 6);
  if ((kind & 8) != 0) {
    desc.width = static_cast<int>(reader.below(70)) - 2;
    desc.height = static_cast<int>(reader.below(70)) - 2;
  }
  if ((kind & 16) != 0)
    for (double* place : {desc.eye, desc.target, desc.up})
      for (int axis = 0; axis < 3; ++axis) place[axis] = reader.number();
  if ((kind & 32) != 0) {
    desc.vertical_fov_radians = reader.number();
    desc.near_distance = reader.number();
    desc.far_distance = reader.number();
  }
  if ((kind & 64) != 0) {
    desc.use_host_framebuffer = 1;
    desc.framebuffer = reader.byte() % 4;
    desc.x = static_cast<int>(reader.byte()) - 20;
    desc.clear_color[1] = static_cast<float>(reader.number());
  }
  HalfshadowReport report = {};
  report.struct_size = sizeof report;
  const HalfshadowError drawn = halfshadow_render(engine_, &desc, reader.flag() ? &report : nullptr);
  answer(drawn);
  std::vector<std::uint8_t> pixels(
      reader.flag() ? static_cast<std::size_t>(std::max(desc.width * desc.height * 4, 0)) : reader.byte());
  (void)halfshadow_output_texture(engine_);
  answer(halfshadow_read_output(engine_, pixels.data(), pixels.size()));
}

/// Seldom: everything is made again, and what the engine gave up stays in this process's context.
void Host::loseContext(InputReader& reader) {
  if (reader.byte() % 16 != 0) return;
  halfshadow_context_lost(engine_);
  const HalfshadowRenderDesc desc = renderDesc();
  require(halfshadow_render(engine_, &desc, nullptr) == HALFSHADOW_CONTEXT_LOST, "a frame without a context");
  expect(halfshadow_set_lights(engine_, nullptr, 0));
  expect(halfshadow_context_restored(engine_));
}

void Host::call(InputReader& reader) {
  switch (reader.below(16)) {
    case 0:
    case 1:
      return addObject(reader);
    case 2:
      return setTransform(reader);
    case 3: {
      const std::uint32_t id = idOf(reader);
      const HalfshadowError removed = halfshadow_remove_object(engine_, id);
      answer(removed);
      require((removed == HALFSHADOW_OK) == (std::erase(ids_, id) == 1), "removed what was not there");
      return;
    }
    case 4:
    case 5:
      return setLights(reader);
    case 6:
    case 7:
      return answer(halfshadow_set_technique(engine_, reader.byte() < 240
                                                          ? kTechniques[reader.below(std::size(kTechniques))]
                                                          : reader.text(20).c_str()));
    case 8:
      return set(reader);
    case 9:
      return answer(halfshadow_trim(engine_, static_cast<HalfshadowTrim>(reader.below(3))));
    case 10:
      return answer(halfshadow_set_memory_limit(
          engine_, reader.flag() ? std::uint64_t{reader.byte()} << 12 : kMemoryLimit));
    case 11:
      return loseContext(reader);
    default:
      return render(reader);
  }
}

struct Session {
  std::string proofs;
  Picture wanted{};
  std::unique_ptr<Host> host;
  int inputs = 0;
};

Host& host(Session& session) {
  if (session.host && session.inputs++ < kInputsPerEngine) return *session.host;
  session.host.reset();
  session.host = std::make_unique<Host>(session.proofs);
  session.inputs = 1;
  if (session.proofs.empty()) {
    session.wanted = session.host->known();
    session.host->reset();
    session.proofs = session.host->proofs();
  }
  return *session.host;
}

void test(Input input) {
  process();
  static Session session;
  Host& engine = host(session);
  InputReader reader(input);
  for (int calls = 0; calls < 24 && !reader.atEnd(); ++calls) engine.call(reader);
  engine.check(session.wanted);
}

std::vector<Bytes> seeds() {
  std::vector<Bytes> all;
  for (std::size_t technique = 0; technique < std::size(kTechniques); ++technique) {
    InputWriter writer;
    writer.byte(8).byte(technique % 2);                               // map_size
    writer.byte(0).byte(1 | 4);                                       // the square
    writer.byte(1).byte(2 | 4 | 32).numbers({1, 1, 1, 0.5, 2.5, 0});  // the cube above it
    writer.byte(4).byte(1).byte(0);                                   // a light
    writer.byte(6).byte(0).byte(technique);
    writer.byte(12).byte(technique % 2).byte(1).byte(1);  // shaded or visibility
    writer.byte(2).byte(1).byte(0).byte(12).number(1);    // the cube moves
    writer.byte(12).byte(1).byte(0).byte(1);
    writer.byte(9).byte(technique % 2).byte(12).byte(4).byte(0).byte(0).byte(9);  // trimmed; lightsOnly
    writer.byte(3).byte(0).byte(12).byte(0).byte(0).byte(1);                      // the square goes
    all.push_back(std::move(writer.bytes));
  }
  // Less memory than a frame needs, then enough; a context that goes and comes back; a host's framebuffer.
  InputWriter scarce;
  scarce.byte(0).byte(1 | 4).byte(1).byte(2 | 4).byte(4).byte(1).byte(0);
  scarce.byte(10).byte(1).byte(10).byte(12).byte(8).byte(64).byte(64).byte(1).byte(1);
  scarce.byte(10).byte(0).byte(12).byte(8).byte(64).byte(64).byte(1).byte(1);
  all.push_back(std::move(scarce.bytes));
  InputWriter returning;
  returning.byte(0).byte(1 | 4).byte(1).byte(2 | 4 | 16).numbers({1, 1, 1, 0.5}).byte(2).byte(2).byte(4);
  returning.byte(99).number(0.5).byte(4).byte(1).byte(0).byte(12).byte(0).byte(1).byte(1);
  returning.byte(11).byte(0).byte(12).byte(0).byte(1).byte(1).byte(12).byte(64).byte(0).byte(20).number(0);
  all.push_back(std::move(returning.bytes));
  return all;
}
}  // namespace

const Target& target() {
  static const Target made{.name = "c_api", .test = test, .seeds = seeds, .largestInput = 384};
  return made;
}

}  // namespace halfshadow::fuzz
