// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "forward_host.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <glm/gtc/type_ptr.hpp>
#include <string>

#include "engine_fixture.hpp"

namespace halfshadow::test {
namespace {
constexpr GLuint kPosition = 0;
constexpr int kFirstUnit = 2;  ///< what the host keeps in units 0 and 1 must not matter

GLuint compiled(GLenum kind, const std::string& text) {
  const gl::Functions& gl = hostGl();
  const GLuint shader = gl.createShader(kind);
  const char* source = text.c_str();
  gl.shaderSource(shader, 1, &source, nullptr);
  gl.compileShader(shader);
  return shader;
}
}  // namespace

ForwardHost::ForwardHost(const scene::SceneDescription& scene, int width, int height)
    : scene_(scene),
      camera_(scene.camera.value()),
      width_(width),
      height_(height),
      framebuffer_(width, height) {
  const gl::Functions& gl = hostGl();
  for (const scene::SceneObject& object : scene.objects) {
    std::vector<glm::vec3> corners;
    for (const std::uint32_t index : object.mesh->indices) corners.push_back(object.mesh->positions[index]);
    buffers_.push_back(0);
    gl.genBuffers(1, &buffers_.back());
    gl.bindBuffer(GL_ARRAY_BUFFER, buffers_.back());
    gl.bufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(corners.size() * sizeof(glm::vec3)),
                  corners.data(), GL_STATIC_DRAW);
  }
  gl.bindBuffer(GL_ARRAY_BUFFER, 0);
}

ForwardHost::~ForwardHost() {
  const gl::Functions& gl = hostGl();
  gl.useProgram(0);
  for (const GLuint program : programs_) gl.deleteProgram(program);
  gl.deleteBuffers(static_cast<GLsizei>(buffers_.size()), buffers_.data());
}

GLuint ForwardHost::link(const ForwardRecord& texts) {
  const gl::Functions& gl = hostGl();
  const GLuint vertex = compiled(
      GL_VERTEX_SHADER, std::string("#version 100\n") + texts.vertexGlsl +
                            "attribute highp vec3 a_position;\nuniform highp mat4 u_hostClipFromObject;\n"
                            "invariant gl_Position;\nvoid main() {\n"
                            "  gl_Position = u_hostClipFromObject * vec4(a_position, 1.0);\n"
                            "  halfshadow_receive(vec4(a_position, 1.0), vec3(0.0));\n}\n");
  const GLuint fragment =
      compiled(GL_FRAGMENT_SHADER, std::string("#version 100\n") + texts.fragmentGlsl +
                                       "void main() { gl_FragColor = vec4(halfshadow_visibility()); }\n");
  const GLuint program = gl.createProgram();
  programs_.push_back(program);
  gl.attachShader(program, vertex);
  gl.attachShader(program, fragment);
  gl.bindAttribLocation(program, kPosition, "a_position");
  gl.linkProgram(program);
  gl.deleteShader(vertex);
  gl.deleteShader(fragment);
  GLint linked = 0;
  gl.getProgramiv(program, GL_LINK_STATUS, &linked);
  EXPECT_TRUE(linked);
  return linked ? program : 0;
}

std::vector<std::uint8_t> ForwardHost::draw(Engine& engine, GLuint program, std::size_t light,
                                            const std::vector<std::size_t>& objects) {
  const gl::Functions& gl = hostGl();
  const glm::dmat4 clipFromWorld =
      scene::clipFromView(camera_, static_cast<double>(width_) / height_) * scene::viewFromWorld(camera_);
  gl.bindFramebuffer(GL_FRAMEBUFFER, framebuffer_.name());
  gl.viewport(0, 0, width_, height_);
  gl.clearColor(1, 1, 1, 1);
  gl.clear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
  gl.enable(GL_DEPTH_TEST);
  gl.useProgram(program);
  gl.enableVertexAttribArray(kPosition);
  const GLint place = gl.getUniformLocation(program, "u_hostClipFromObject");
  for (const std::size_t i : objects) {
    const scene::SceneObject& object = scene_.objects[i];
    const glm::mat4 clipFromObject(clipFromWorld * object.worldFromObject);
    gl.uniformMatrix4fv(place, 1, GL_FALSE, glm::value_ptr(clipFromObject));
    const Outcome bound =
        engine.bindForward(light, program, glm::value_ptr(object.worldFromObject), kFirstUnit);
    EXPECT_TRUE(bound.ok()) << bound.message;
    gl.bindBuffer(GL_ARRAY_BUFFER, buffers_[i]);
    gl.vertexAttribPointer(kPosition, 3, GL_FLOAT, GL_FALSE, 12, nullptr);
    gl.drawArrays(GL_TRIANGLES, 0, static_cast<GLsizei>(object.mesh->indices.size()));
  }
  std::vector<std::uint8_t> rgba(static_cast<std::size_t>(width_ * height_ * 4));
  gl.readPixels(0, 0, width_, height_, GL_RGBA, GL_UNSIGNED_BYTE, rgba.data());
  gl.disableVertexAttribArray(kPosition);
  gl.bindBuffer(GL_ARRAY_BUFFER, 0);
  gl.disable(GL_DEPTH_TEST);
  gl.bindFramebuffer(GL_FRAMEBUFFER, 0);
  std::vector<std::uint8_t> visibility;
  for (std::size_t i = 0; i < rgba.size(); i += 4) visibility.push_back(rgba[i]);
  return visibility;
}

std::size_t ForwardHost::dark(const std::vector<std::uint8_t>& picture) {
  return static_cast<std::size_t>(std::ranges::count_if(picture, [](std::uint8_t v) { return v < 128; }));
}

}  // namespace halfshadow::test
