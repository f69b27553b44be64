// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// The OpenGL ES 2.0 entry points that the engine calls, loaded by name. Nothing here links a GL library.
#pragma once

#include <GLES2/gl2.h>
#include <GLES2/gl2ext.h>

#include <functional>
#include <string>

namespace halfshadow::gl {

// X(member, glName): core OpenGL ES 2.0, all of them must be present.
#define HALFSHADOW_GL_CORE_FUNCTIONS(X)                   \
  X(activeTexture, glActiveTexture)                       \
  X(attachShader, glAttachShader)                         \
  X(bindAttribLocation, glBindAttribLocation)             \
  X(bindBuffer, glBindBuffer)                             \
  X(bindFramebuffer, glBindFramebuffer)                   \
  X(bindRenderbuffer, glBindRenderbuffer)                 \
  X(bindTexture, glBindTexture)                           \
  X(blendColor, glBlendColor)                             \
  X(blendEquationSeparate, glBlendEquationSeparate)       \
  X(blendFuncSeparate, glBlendFuncSeparate)               \
  X(bufferData, glBufferData)                             \
  X(bufferSubData, glBufferSubData)                       \
  X(checkFramebufferStatus, glCheckFramebufferStatus)     \
  X(clear, glClear)                                       \
  X(clearColor, glClearColor)                             \
  X(clearDepthf, glClearDepthf)                           \
  X(clearStencil, glClearStencil)                         \
  X(colorMask, glColorMask)                               \
  X(compileShader, glCompileShader)                       \
  X(createProgram, glCreateProgram)                       \
  X(createShader, glCreateShader)                         \
  X(cullFace, glCullFace)                                 \
  X(deleteBuffers, glDeleteBuffers)                       \
  X(deleteFramebuffers, glDeleteFramebuffers)             \
  X(deleteProgram, glDeleteProgram)                       \
  X(deleteRenderbuffers, glDeleteRenderbuffers)           \
  X(deleteShader, glDeleteShader)                         \
  X(deleteTextures, glDeleteTextures)                     \
  X(depthFunc, glDepthFunc)                               \
  X(depthMask, glDepthMask)                               \
  X(depthRangef, glDepthRangef)                           \
  X(disable, glDisable)                                   \
  X(disableVertexAttribArray, glDisableVertexAttribArray) \
  X(drawArrays, glDrawArrays)                             \
  X(drawElements, glDrawElements)                         \
  X(enable, glEnable)                                     \
  X(enableVertexAttribArray, glEnableVertexAttribArray)   \
  X(finish, glFinish)                                     \
  X(flush, glFlush)                                       \
  X(framebufferRenderbuffer, glFramebufferRenderbuffer)   \
  X(framebufferTexture2D, glFramebufferTexture2D)         \
  X(frontFace, glFrontFace)                               \
  X(genBuffers, glGenBuffers)                             \
  X(generateMipmap, glGenerateMipmap)                     \
  X(genFramebuffers, glGenFramebuffers)                   \
  X(genRenderbuffers, glGenRenderbuffers)                 \
  X(genTextures, glGenTextures)                           \
  X(getActiveUniform, glGetActiveUniform)                 \
  X(getBooleanv, glGetBooleanv)                           \
  X(getError, glGetError)                                 \
  X(getFloatv, glGetFloatv)                               \
  X(getIntegerv, glGetIntegerv)                           \
  X(getProgramInfoLog, glGetProgramInfoLog)               \
  X(getProgramiv, glGetProgramiv)                         \
  X(getShaderInfoLog, glGetShaderInfoLog)                 \
  X(getShaderiv, glGetShaderiv)                           \
  X(getString, glGetString)                               \
  X(getUniformLocation, glGetUniformLocation)             \
  X(getVertexAttribfv, glGetVertexAttribfv)               \
  X(getVertexAttribiv, glGetVertexAttribiv)               \
  X(getVertexAttribPointerv, glGetVertexAttribPointerv)   \
  X(isEnabled, glIsEnabled)                               \
  X(isFramebuffer, glIsFramebuffer)                       \
  X(isProgram, glIsProgram)                               \
  X(isTexture, glIsTexture)                               \
  X(linkProgram, glLinkProgram)                           \
  X(pixelStorei, glPixelStorei)                           \
  X(polygonOffset, glPolygonOffset)                       \
  X(readPixels, glReadPixels)                             \
  X(renderbufferStorage, glRenderbufferStorage)           \
  X(sampleCoverage, glSampleCoverage)                     \
  X(scissor, glScissor)                                   \
  X(shaderSource, glShaderSource)                         \
  X(stencilFuncSeparate, glStencilFuncSeparate)           \
  X(stencilMaskSeparate, glStencilMaskSeparate)           \
  X(stencilOpSeparate, glStencilOpSeparate)               \
  X(texImage2D, glTexImage2D)                             \
  X(texParameteri, glTexParameteri)                       \
  X(texSubImage2D, glTexSubImage2D)                       \
  X(uniform1f, glUniform1f)                               \
  X(uniform1i, glUniform1i)                               \
  X(uniform1iv, glUniform1iv)                             \
  X(uniform2fv, glUniform2fv)                             \
  X(uniform3fv, glUniform3fv)                             \
  X(uniform4fv, glUniform4fv)                             \
  X(uniformMatrix3fv, glUniformMatrix3fv)                 \
  X(uniformMatrix4fv, glUniformMatrix4fv)                 \
  X(useProgram, glUseProgram)                             \
  X(vertexAttrib4fv, glVertexAttrib4fv)                   \
  X(vertexAttribPointer, glVertexAttribPointer)           \
  X(viewport, glViewport)

// X(member, "glName", type): of extensions; null where the driver has none.
#define HALFSHADOW_GL_OPTIONAL_FUNCTIONS(X)                                                          \
  X(discardFramebuffer, "glDiscardFramebufferEXT", PFNGLDISCARDFRAMEBUFFEREXTPROC)                   \
  X(genQueries, "glGenQueriesEXT", PFNGLGENQUERIESEXTPROC)                                           \
  X(deleteQueries, "glDeleteQueriesEXT", PFNGLDELETEQUERIESEXTPROC)                                  \
  X(beginQuery, "glBeginQueryEXT", PFNGLBEGINQUERYEXTPROC)                                           \
  X(endQuery, "glEndQueryEXT", PFNGLENDQUERYEXTPROC)                                                 \
  X(getQueryiv, "glGetQueryivEXT", PFNGLGETQUERYIVEXTPROC)                                           \
  X(getQueryObjectuiv, "glGetQueryObjectuivEXT", PFNGLGETQUERYOBJECTUIVEXTPROC)                      \
  X(getQueryObjectui64v, "glGetQueryObjectui64vEXT", PFNGLGETQUERYOBJECTUI64VEXTPROC)                \
  X(bindVertexArray, "glBindVertexArray", PFNGLBINDVERTEXARRAYOESPROC)                               \
  X(bindVertexArrayOes, "glBindVertexArrayOES", PFNGLBINDVERTEXARRAYOESPROC)                         \
  X(vertexAttribDivisor, "glVertexAttribDivisor", PFNGLVERTEXATTRIBDIVISOREXTPROC)                   \
  X(vertexAttribDivisorExt, "glVertexAttribDivisorEXT", PFNGLVERTEXATTRIBDIVISOREXTPROC)             \
  X(vertexAttribDivisorAngle, "glVertexAttribDivisorANGLE", PFNGLVERTEXATTRIBDIVISORANGLEPROC)       \
  X(bindSampler, "glBindSampler", ::halfshadow::gl::BindSamplerFunction)                             \
  X(pauseTransformFeedback, "glPauseTransformFeedback", ::halfshadow::gl::TransformFeedbackFunction) \
  X(resumeTransformFeedback, "glResumeTransformFeedback", ::halfshadow::gl::TransformFeedbackFunction)

// Of OpenGL ES 3.0, whose header is not included: the engine only undoes with them what a host did.
using BindSamplerFunction = void(GL_APIENTRYP)(GLuint unit, GLuint sampler);
using TransformFeedbackFunction = void(GL_APIENTRYP)();

/// Entry points of one context.
struct Functions {
#define HALFSHADOW_GL_CORE_MEMBER(member, glName) decltype(&::glName) member = nullptr;
  HALFSHADOW_GL_CORE_FUNCTIONS(HALFSHADOW_GL_CORE_MEMBER)
#undef HALFSHADOW_GL_CORE_MEMBER
#define HALFSHADOW_GL_OPTIONAL_MEMBER(member, glName, type) type member = nullptr;
  HALFSHADOW_GL_OPTIONAL_FUNCTIONS(HALFSHADOW_GL_OPTIONAL_MEMBER)
#undef HALFSHADOW_GL_OPTIONAL_MEMBER

  /// Fills every member. Returns the names of absent core entry points, separated by spaces; empty is good.
  std::string load(const std::function<void*(const char* name)>& getProcAddress);
  /// Every member that is there does nothing from now on, and answers 0: for a context that is gone.
  void disconnect();
};

}  // namespace halfshadow::gl
