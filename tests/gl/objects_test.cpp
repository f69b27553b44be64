// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "gl/objects.hpp"

#include "gl_fixture.hpp"

namespace halfshadow::test {
namespace {

using gl::Texture;
using gl::TextureFormat;

class Objects : public GlTest {};

std::span<const std::byte> bytesOf(const std::vector<float>& values) {
  return std::as_bytes(std::span(values));
}

TEST_F(Objects, MovesLeaveTheSourceEmptyAndDeleteOnce) {
  const int before = context().liveObjects().textures;
  {
    Result<Texture> made = Texture::create(context(), {.width = 4, .height = 4});
    ASSERT_TRUE(made);
    Texture first = std::move(*made);
    EXPECT_FALSE(static_cast<bool>(*made));
    const std::uint32_t name = first.name();
    EXPECT_TRUE(context().functions().isTexture(name));
    Texture second = std::move(first);
    EXPECT_FALSE(static_cast<bool>(first));
    EXPECT_EQ(second.name(), name);
    EXPECT_EQ(context().liveObjects().textures, before + 1);

    Result<Texture> other = Texture::create(context(), {.width = 2, .height = 2});
    ASSERT_TRUE(other);
    EXPECT_EQ(context().liveObjects().textures, before + 2);
    second = std::move(*other);  // deletes what it held
    EXPECT_EQ(context().liveObjects().textures, before + 1);
    EXPECT_FALSE(context().functions().isTexture(name));
  }
  EXPECT_EQ(context().liveObjects().textures, before);
}

TEST_F(Objects, EveryKindIsCounted) {
  const gl::Context::LiveObjects before = context().liveObjects();
  {
    Result<Texture> texture = Texture::create(context(), {.width = 4, .height = 4});
    Result<gl::Renderbuffer> renderbuffer =
        gl::Renderbuffer::create(context(), 4, 4, gl::RenderbufferFormat::depth16);
    ASSERT_TRUE(texture);
    ASSERT_TRUE(renderbuffer);
    Result<gl::Framebuffer> framebuffer =
        gl::Framebuffer::create(context(), {.color = &*texture, .depth = &*renderbuffer});
    Result<gl::Buffer> buffer =
        gl::Buffer::create(context(), gl::BufferTarget::vertex, bytesOf({1, 2}), gl::BufferUsage::staticDraw);
    ASSERT_TRUE(framebuffer);
    ASSERT_TRUE(buffer);
    const gl::Context::LiveObjects now = context().liveObjects();
    EXPECT_EQ(now.textures, before.textures + 1);
    EXPECT_EQ(now.renderbuffers, before.renderbuffers + 1);
    EXPECT_EQ(now.framebuffers, before.framebuffers + 1);
    EXPECT_EQ(now.buffers, before.buffers + 1);
  }
  EXPECT_EQ(context().liveObjects().total(), before.total());
}

TEST_F(Objects, BadTexturesAreRefusedWithTheLimit) {
  const int limit = context().capabilities().limits.textureSize;
  for (const gl::TextureDesc& desc : std::vector<gl::TextureDesc>{
           {.width = 0, .height = 4},
           {.width = 4, .height = -1},
           {.width = limit + 1, .height = 1},
           {.width = 6, .height = 4, .mipmapped = true},
           {.width = 6, .height = 4, .wrap = gl::TextureWrap::repeat},
           {.width = 4, .height = 4, .filter = gl::TextureFilter::linearMipLinear}}) {
    const Result<Texture> made = Texture::create(context(), desc);
    ASSERT_FALSE(made) << desc.width << "x" << desc.height;
    EXPECT_EQ(made.error().code, ErrorCode::invalidArgument);
  }
  const Result<Texture> tooLarge = Texture::create(context(), {.width = limit + 1, .height = 1});
  EXPECT_NE(tooLarge.error().message.find(std::to_string(limit)), std::string::npos);
}

TEST_F(Objects, BadRenderbuffersAreRefused) {
  const int limit = context().capabilities().limits.renderbufferSize;
  for (const int size : {0, -3, limit + 1}) {
    const auto made = gl::Renderbuffer::create(context(), size, 1, gl::RenderbufferFormat::depth16);
    ASSERT_FALSE(made) << size;
    EXPECT_EQ(made.error().code, ErrorCode::invalidArgument);
  }
}

TEST_F(Objects, IncompleteFramebuffersAreRefused) {
  const Result<gl::Framebuffer> empty = gl::Framebuffer::create(context(), {});
  ASSERT_FALSE(empty);
  EXPECT_EQ(empty.error().code, ErrorCode::capabilityMissing);
  Result<Texture> color =
      Texture::create(context(), {.width = 4, .height = 4, .format = TextureFormat::alpha8});
  ASSERT_TRUE(color);
  const Result<gl::Framebuffer> alpha = gl::Framebuffer::create(context(), {.color = &*color});
  if (alpha) GTEST_SKIP() << "this driver renders to alpha textures, which ES 2.0 does not promise";
  EXPECT_NE(alpha.error().message.find("not complete"), std::string::npos);
}

TEST_F(Objects, TextureContentSurvivesUploadUpdateAndReadback) {
  // Three bytes a texel and three texels a row: wrong unless the unpack alignment is handled.
  std::array<std::uint8_t, 3 * 3 * 3> texels{};
  for (std::size_t i = 0; i < texels.size(); ++i) texels[i] = static_cast<std::uint8_t>(7 * i);
  Result<Texture> texture =
      Texture::create(context(), {.width = 3, .height = 3, .format = TextureFormat::rgb8}, texels.data());
  ASSERT_TRUE(texture);
  const std::array<std::uint8_t, 6> patch{200, 201, 202, 203, 204, 205};
  texture->update(context(), 1, 0, 1, 2, patch.data());
  Result<gl::Framebuffer> framebuffer = gl::Framebuffer::create(context(), {.color = &*texture});
  if (!framebuffer)
    GTEST_SKIP() << "this driver does not render to RGB8 textures, so they cannot be read back";
  gl::Encoder encoder(context());
  encoder.beginFrame();
  EXPECT_EQ(readPixel(encoder, *framebuffer, 2, 1), (Rgba{7 * 15, 7 * 16, 7 * 17, 255}));
  EXPECT_EQ(readPixel(encoder, *framebuffer, 1, 0), (Rgba{200, 201, 202, 255}));
  EXPECT_EQ(readPixel(encoder, *framebuffer, 1, 1), (Rgba{203, 204, 205, 255}));
}

TEST_F(Objects, BytesAreCounted) {
  Result<Texture> chain = Texture::create(context(), {.width = 8, .height = 2, .mipmapped = true});
  ASSERT_TRUE(chain);
  EXPECT_EQ(chain->byteCount(), 4u * (16 + 4 + 2 + 1));
  const std::uint64_t textureBytes = context().uploads().textureBytes;
  const std::array<std::uint8_t, 2 * 3 * 4> patch{};
  chain->update(context(), 0, 0, 3, 2, patch.data());
  EXPECT_EQ(context().uploads().textureBytes - textureBytes, patch.size());

  const std::uint64_t bufferBytes = context().uploads().bufferBytes;
  Result<gl::Buffer> buffer = gl::Buffer::create(context(), gl::BufferTarget::vertex, bytesOf({1, 2, 3}),
                                                 gl::BufferUsage::dynamicDraw);
  ASSERT_TRUE(buffer);
  EXPECT_TRUE(buffer->update(context(), bytesOf({4, 5, 6})));
  EXPECT_TRUE(buffer->update(context(), bytesOf({4, 5, 6, 7})));
  EXPECT_EQ(buffer->byteCount(), 16u);
  EXPECT_EQ(context().uploads().bufferBytes - bufferBytes, 12u + 12u + 16u);
}

TEST_F(Objects, WrappedObjectsAreNeverDeleted) {
  const gl::Functions& gl = context().functions();
  GLuint name = 0;
  gl.genTextures(1, &name);
  gl.bindTexture(GL_TEXTURE_2D, name);
  {
    const Texture wrapped = Texture::wrap(name, {.width = 1, .height = 1});
    EXPECT_EQ(wrapped.name(), name);
    const gl::Framebuffer host = gl::Framebuffer::wrap(0, 16, 16);
    EXPECT_TRUE(host.valid());
    EXPECT_EQ(host.name(), 0u);
  }
  EXPECT_TRUE(gl.isTexture(name));
  gl.deleteTextures(1, &name);
}

TEST_F(Objects, LostContextsDeleteNothingAndMakeNothing) {
  Result<std::unique_ptr<gl::Context>> made = makeContext();
  ASSERT_TRUE(made);
  gl::Context& doomed = **made;
  GLuint name = 0;
  {
    Result<Texture> texture = Texture::create(doomed, {.width = 1, .height = 1});
    ASSERT_TRUE(texture);
    name = texture->name();
    doomed.markLost();
    const Result<Texture> later = Texture::create(doomed, {.width = 1, .height = 1});
    ASSERT_FALSE(later);
    EXPECT_EQ(later.error().code, ErrorCode::contextLost);
    EXPECT_EQ(doomed.checkErrors("lost").error().code, ErrorCode::contextLost);
  }
  EXPECT_EQ(doomed.liveObjects().total(), 0) << "forgotten objects do not count as leaked";
  EXPECT_TRUE(context().functions().isTexture(name))
      << "a name of a lost context may belong to somebody else by now";
  context().functions().deleteTextures(1, &name);
}

}  // namespace
}  // namespace halfshadow::test
