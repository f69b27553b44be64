// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "gl/program.hpp"

#include <regex>

#include "gl/embedded_shaders.hpp"
#include "gl_fixture.hpp"
#include "test_programs.hpp"

namespace halfshadow::test {
namespace {

using device::Capability;
using gl::assembleShader;

device::Capabilities withoutAnything() {
  return {};
}

device::Capabilities with(std::initializer_list<Capability> available) {
  device::Capabilities capabilities;
  for (const Capability capability : available) {
    capabilities.states[static_cast<std::size_t>(capability)].outcome = device::ProbeOutcome::available;
  }
  return capabilities;
}

std::size_t placeOf(const std::string& text, const std::string& part) {
  const std::size_t place = text.find(part);
  EXPECT_NE(place, std::string::npos) << part << " is missing in\n" << text;
  return place;
}

TEST(ShaderAssembly, OrderIsVersionExtensionsDefinesPrecisionFile) {
  const auto provider = provide({{"a.frag", "void main() {}\n"}});
  const Result<std::string> source =
      assembleShader(provider, "a.frag", {"HS_SIZE 7", "HS_GRID"}, with({Capability::derivatives}));
  ASSERT_TRUE(source);
  EXPECT_EQ(placeOf(*source, "#version 100\n"), 0u);
  const std::size_t extension = placeOf(*source, "#extension GL_OES_standard_derivatives : enable\n");
  const std::size_t noHighp = placeOf(*source, "#define HS_NO_HIGHP 1\n");
  const std::size_t size = placeOf(*source, "#define HS_SIZE 7\n");
  const std::size_t grid = placeOf(*source, "#define HS_GRID 1\n");
  const std::size_t precision = placeOf(*source, "precision mediump float;");
  const std::size_t body = placeOf(*source, "#line 1 0\nvoid main() {}");
  EXPECT_LT(extension, noHighp);
  EXPECT_LT(noHighp, size);
  EXPECT_LT(size, grid);
  EXPECT_LT(grid, precision);
  EXPECT_LT(precision, body);
}

TEST(ShaderAssembly, VertexShadersGetNoFragmentLines) {
  const auto provider = provide({{"a.vert", "void main() {}\n"}});
  const Result<std::string> source =
      assembleShader(provider, "a.vert", {}, with({Capability::derivatives, Capability::highp}));
  ASSERT_TRUE(source);
  EXPECT_EQ(source->find("#extension"), std::string::npos);
  EXPECT_EQ(source->find("precision "), std::string::npos);
  EXPECT_EQ(source->find("#define HS_NO_HIGHP"), std::string::npos);
}

TEST(ShaderAssembly, IncludesExpandOnceAndKeepLineNumbers) {
  const auto provider =
      provide({{"a.frag", "// one\n#include \"b.glsl\"\n// three\n"}, {"b.glsl", "float b;\n"}});
  const Result<std::string> source = assembleShader(provider, "a.frag", {}, withoutAnything());
  ASSERT_TRUE(source);
  EXPECT_NE(source->find("// one\n#line 1 1\nfloat b;\n#line 3 0\n// three\n"), std::string::npos) << *source;
}

TEST(ShaderAssembly, MissingNestedAndMalformedIncludesAreErrors) {
  const auto provider = provide({{"missing.frag", "\n#include \"gone.glsl\"\n"},
                                 {"nested.frag", "#include \"b.glsl\"\n"},
                                 {"malformed.frag", "#include <b.glsl>\n"},
                                 {"b.glsl", "  #include \"c.glsl\"\n"},
                                 {"c.glsl", ""}});
  const auto messageOf = [&](const char* file) {
    const Result<std::string> source = assembleShader(provider, file, {}, withoutAnything());
    EXPECT_FALSE(source) << file;
    if (source) return std::string();
    EXPECT_EQ(source.error().code, ErrorCode::shaderFailed);
    return source.error().message;
  };
  EXPECT_NE(messageOf("absent.frag").find("absent.frag"), std::string::npos);
  EXPECT_NE(messageOf("missing.frag").find("line 2: included file gone.glsl"), std::string::npos);
  EXPECT_NE(messageOf("nested.frag").find("one level"), std::string::npos);
  EXPECT_NE(messageOf("malformed.frag").find("#include"), std::string::npos);
}

TEST(ShaderAssembly, FetchAndLodNeedTheirCapability) {
  const auto provider = provide({{"a.frag", "void main() {}\n"}});
  EXPECT_FALSE(assembleShader(provider, "a.frag", {"HS_USE_FETCH"}, withoutAnything()));
  EXPECT_FALSE(assembleShader(provider, "a.frag", {"HS_USE_LOD"}, withoutAnything()));
  device::Capabilities capabilities = with({Capability::framebufferFetch, Capability::textureLod});
  capabilities.extensions = {"GL_ARM_shader_framebuffer_fetch"};
  const Result<std::string> source =
      assembleShader(provider, "a.frag", {"HS_USE_FETCH", "HS_USE_LOD"}, capabilities);
  ASSERT_TRUE(source);
  EXPECT_NE(source->find("#extension GL_ARM_shader_framebuffer_fetch : enable"), std::string::npos);
  EXPECT_NE(source->find("#define HS_LAST_COLOR gl_LastFragColorARM"), std::string::npos);
  EXPECT_NE(source->find("#extension GL_EXT_shader_texture_lod : enable"), std::string::npos);
  const Result<std::string> unused = assembleShader(provider, "a.frag", {}, capabilities);
  ASSERT_TRUE(unused);
  EXPECT_EQ(unused->find("#extension"), std::string::npos);
}

TEST(ShaderAssembly, SamplerNamesComeInOrderOnceAndNotFromComments) {
  EXPECT_EQ(gl::samplerNamesOf(
                "// uniform sampler2D u_no;\nuniform HS_HIGHP sampler2D u_b; /* uniform sampler2D u_c;\n"
                "*/ uniform vec4 u_v;\nuniform sampler2D u_a, u_d[2];\n#else\n"
                "uniform mediump sampler2D u_b;\nvoid f(sampler2D s) {}\n"),
            (std::vector<std::string>{"u_b", "u_a", "u_d"}));
}

TEST(EmbeddedShaders, AreFoundByNameAndNeverUseABareHighpInFragments) {
  const std::regex bareHighp("\\bhighp\\b");
  const std::regex comment("//[^\n]*");
  for (const std::string_view name : gl::embeddedShaderNames()) {
    const char* text = gl::embeddedShader(name);
    ASSERT_NE(text, nullptr) << name;
    if (!name.ends_with(".frag")) continue;
    const std::string code = std::regex_replace(std::string(text), comment, "");
    EXPECT_FALSE(std::regex_search(code, bareHighp))
        << name << ": write HS_HIGHP, fragment highp is optional";
  }
  EXPECT_EQ(gl::embeddedShader("no such file"), nullptr);
}

TEST(EmbeddedShaders, DirectoryFilesEqualTheEmbeddedOnes) {
  const gl::ShaderSourceProvider directory = gl::directoryShaders(HALFSHADOW_SHADER_DIR);
  for (const std::string_view name : gl::embeddedShaderNames()) {
    const char* text = directory(name);
    ASSERT_NE(text, nullptr) << name;
    EXPECT_STREQ(text, gl::embeddedShader(name)) << name;
  }
  EXPECT_EQ(directory("no such file"), nullptr);
}

class Programs : public GlTest {};

TEST_F(Programs, BadShadersFailWithTheDriversLog) {
  gl::ProgramCache cache(
      context(),
      provide({{"a.vert", "void main() { gl_Position = vec4(0.0); }\n"},
               {"bad.frag", "void main() { gl_FragColor = undefinedThing; }\n"},
               {"unlinked.frag", "varying vec4 v_absent;\nvoid main() { gl_FragColor = v_absent; }\n"}}));
  const Result<gl::Program*> bad = cache.get({"a.vert", "bad.frag", {"HS_X"}});
  ASSERT_FALSE(bad);
  EXPECT_EQ(bad.error().code, ErrorCode::shaderFailed);
  EXPECT_NE(bad.error().message.find("undefinedThing"), std::string::npos) << bad.error().message;
  EXPECT_NE(bad.error().message.find("bad.frag HS_X"), std::string::npos) << "the message names the variant";
  const Result<gl::Program*> unlinked = cache.get({"a.vert", "unlinked.frag", {}});
  ASSERT_FALSE(unlinked);
  EXPECT_EQ(unlinked.error().code, ErrorCode::shaderFailed);
  EXPECT_EQ(cache.size(), 0u);
}

TEST_F(Programs, CacheLinksOncePerVariantAndFreesOnClear) {
  const int before = context().liveObjects().programs;
  gl::ProgramCache cache(context(), provide(paintFiles()));
  const Result<gl::Program*> first = cache.get({"paint.vert", "paint.frag", {}});
  const Result<gl::Program*> again = cache.get({"paint.vert", "paint.frag", {}});
  const Result<gl::Program*> other = cache.get({"paint.vert", "paint.frag", {"HS_OTHER"}});
  ASSERT_TRUE(first && again && other);
  EXPECT_EQ(*first, *again);
  EXPECT_NE(*first, *other);
  EXPECT_EQ(cache.size(), 2u);
  EXPECT_EQ(context().liveObjects().programs, before + 2);
  cache.clear();
  EXPECT_EQ(context().liveObjects().programs, before);
}

TEST_F(Programs, ActiveSamplersGetConsecutiveUnits) {
  gl::ProgramCache cache(
      context(), provide({{"a.vert", "void main() { gl_Position = vec4(0.0); }\n"},
                          {"a.frag",
                           "uniform HS_HIGHP sampler2D u_unused;\nuniform HS_HIGHP sampler2D u_second;\n"
                           "uniform HS_HIGHP sampler2D u_first;\n"
                           "void main() { gl_FragColor = texture2D(u_first, vec2(0.5)) *\n"
                           "                             texture2D(u_second, vec2(0.5)); }\n"}}));
  const Result<gl::Program*> program = cache.get({"a.vert", "a.frag", {}});
  ASSERT_TRUE(program) << program.error().message;
  EXPECT_EQ((*program)->samplerUnit("u_second"), 0);
  EXPECT_EQ((*program)->samplerUnit("u_first"), 1);
  EXPECT_EQ((*program)->samplerUnit("u_unused"), -1);
  EXPECT_EQ((*program)->samplerUnit("u_absent"), -1);
}

TEST_F(Programs, UnchangedUniformsAreNotSentAgain) {
  gl::ProgramCache cache(context(), provide(paintFiles()));
  const Result<gl::Program*> program = cache.get({"paint.vert", "paint.frag", {}});
  ASSERT_TRUE(program);
  gl::Encoder encoder(context());
  encoder.beginFrame();
  encoder.useProgram(**program);
  const std::uint64_t before = encoder.counters().uniformUploads;
  (*program)->set(context(), "u_color", glm::vec4(1.0f));
  (*program)->set(context(), "u_color", glm::vec4(1.0f));
  (*program)->set(context(), "u_absent", 3.0f);
  (*program)->set(context(), "u_color", glm::vec4(0.5f));
  EXPECT_EQ(encoder.counters().uniformUploads - before, 2u);
}

TEST_F(Programs, EveryUniformTypeArrives) {
  gl::ProgramCache cache(
      context(),
      provide(
          {{"a.vert",
            "attribute vec2 a_position;\nvoid main() { gl_Position = vec4(a_position, 0.0, 1.0); }\n"},
           {"a.frag",
            "uniform float u_float; uniform vec2 u_vec2; uniform vec3 u_vec3; uniform vec4 u_vec4;\n"
            "uniform mat3 u_mat3; uniform mat4 u_mat4; uniform vec4 u_array4[2]; uniform vec2 u_array2[2];\n"
            "uniform int u_int;\n"
            "void main() {\n"
            "  float sum = u_float + u_vec2.y + u_vec3.z + u_vec4.w;\n"
            "  float products = u_mat3[2].y + u_mat4[1].w;\n"
            "  float arrays = u_array4[1].z + u_array2[1].x;\n"
            "  gl_FragColor = vec4(sum, products, arrays, float(u_int)) / 255.0;\n"
            "}\n"}}));
  const Result<gl::Program*> made = cache.get({"a.vert", "a.frag", {}});
  ASSERT_TRUE(made) << made.error().message;
  gl::Program& program = **made;
  Result<gl::Texture> color = gl::Texture::create(context(), {.width = 4, .height = 4});
  ASSERT_TRUE(color);
  Result<gl::Framebuffer> target = gl::Framebuffer::create(context(), {.color = &*color});
  ASSERT_TRUE(target);
  gl::Encoder encoder(context());
  encoder.beginFrame();
  encoder.beginPass({.framebuffer = &*target, .viewport = {0, 0, 4, 4}});
  encoder.useProgram(program);
  program.set(context(), "u_float", 1.0f);
  program.set(context(), "u_vec2", glm::vec2(0, 2));
  program.set(context(), "u_vec3", glm::vec3(0, 0, 4));
  program.set(context(), "u_vec4", glm::vec4(0, 0, 0, 8));
  glm::mat3 mat3(0.0f);
  mat3[2][1] = 16.0f;
  glm::mat4 mat4(0.0f);
  mat4[1][3] = 32.0f;
  program.set(context(), "u_mat3", mat3);
  program.set(context(), "u_mat4", mat4);
  const std::array<glm::vec4, 2> array4{glm::vec4(0), glm::vec4(0, 0, 64, 0)};
  const std::array<glm::vec2, 2> array2{glm::vec2(0), glm::vec2(128, 0)};
  program.setArray(context(), "u_array4", array4.data(), 2);
  program.setArray(context(), "u_array2", array2.data(), 2);
  program.set(context(), "u_int", 77.0f);
  encoder.drawFullscreen({});
  encoder.endPass({});
  EXPECT_EQ(readPixel(encoder, *target, 1, 1), (Rgba{15, 48, 192, 77}));
}

TEST_F(Programs, LinkingBetweenUseAndSetKeepsTheCurrentProgram) {
  gl::ProgramCache cache(context(), provide(paintFiles()));
  const Result<gl::Program*> paint = cache.get({"paint.vert", "paint.frag", {}});
  ASSERT_TRUE(paint);
  gl::Encoder encoder(context());
  encoder.beginFrame();
  encoder.useProgram(**paint);
  ASSERT_TRUE(cache.get({"paint.vert", "show.frag", {}}));
  (*paint)->set(context(), "u_color", glm::vec4(1.0f));
  EXPECT_TRUE(context().checkErrors("set after another link"));
}

}  // namespace
}  // namespace halfshadow::test
