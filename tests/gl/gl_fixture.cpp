// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "gl_fixture.hpp"

namespace halfshadow::test {
namespace {

struct Process {
  std::unique_ptr<HeadlessContext> headless;
  std::unique_ptr<gl::Context> context;
  std::string failure;
};

Process openProcess() {
  Process process;
  HeadlessOptions options;
  const char* driver = std::getenv("HALFSHADOW_TEST_DRIVER");
  options.driver = driver ? driver : "default";
  Result<std::unique_ptr<HeadlessContext>> headless = createHeadless(options);
  if (!headless) {
    process.failure = headless.error().message;
    return process;
  }
  process.headless = std::move(*headless);
  HeadlessContext* raw = process.headless.get();
  Result<std::unique_ptr<gl::Context>> context =
      gl::Context::create([raw](const char* name) { return raw->getProcAddress(name); }, {});
  if (context) {
    process.context = std::move(*context);
  } else {
    process.failure = context.error().message;
  }
  return process;
}

Process& process() {
  static Process opened = openProcess();
  return opened;
}

}  // namespace

Result<std::unique_ptr<gl::Context>> makeContext(const gl::ContextOptions& options) {
  HeadlessContext* raw = process().headless.get();
  return gl::Context::create([raw](const char* name) { return raw->getProcAddress(name); }, options);
}

void GlTest::SetUp() {
  ASSERT_TRUE(process().context) << process().failure;
  liveBefore_ = context().liveObjects().total();
}

void GlTest::TearDown() {
  if (!process().context) return;
  const Status errors = context().checkErrors("after the test");
  EXPECT_TRUE(errors) << errors.error().message;
  EXPECT_EQ(context().liveObjects().total(), liveBefore_) << "the test leaked OpenGL ES objects";
}

gl::Context& GlTest::context() {
  return *process().context;
}

HeadlessContext& GlTest::headless() {
  return *process().headless;
}

Rgba readPixel(gl::Encoder& encoder, const gl::Framebuffer& framebuffer, int x, int y) {
  Rgba pixel{};
  encoder.readPixels(framebuffer, {x, y, 1, 1}, pixel.data());
  return pixel;
}

}  // namespace halfshadow::test
