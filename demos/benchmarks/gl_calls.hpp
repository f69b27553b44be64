// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
/// @file
/// Counts the OpenGL ES calls of an engine, and keeps its draws from the driver.
#pragma once

#include <cstdint>
#include <string_view>

namespace halfshadow::benchmarks {

/// Of the entry points listed below: all that frames call, but none of those that compile programs.
inline std::uint64_t glCalls = 0;
/// False: draws are counted, and end here.
inline bool glDraws = true;

template <int index, typename Result, typename... Arguments>
struct GlCall {
  static inline Result (*driver)(Arguments...) = nullptr;
  static Result call(Arguments... arguments) {
    ++glCalls;
    return driver(arguments...);
  }
  static void draw(Arguments... arguments) {
    ++glCalls;
    if (glDraws) driver(arguments...);
  }
};

// X(name, result, arguments …), in the types that they have without OpenGL's header.
#define HALFSHADOW_BENCHMARK_GL_CALLS(X)                                                       \
  X(glActiveTexture, void, unsigned)                                                           \
  X(glBindBuffer, void, unsigned, unsigned)                                                    \
  X(glBindFramebuffer, void, unsigned, unsigned)                                               \
  X(glBindTexture, void, unsigned, unsigned)                                                   \
  X(glBlendEquationSeparate, void, unsigned, unsigned)                                         \
  X(glBlendFuncSeparate, void, unsigned, unsigned, unsigned, unsigned)                         \
  X(glBufferData, void, unsigned, std::intptr_t, const void*, unsigned)                        \
  X(glBufferSubData, void, unsigned, std::intptr_t, std::intptr_t, const void*)                \
  X(glClear, void, unsigned)                                                                   \
  X(glClearColor, void, float, float, float, float)                                            \
  X(glClearDepthf, void, float)                                                                \
  X(glClearStencil, void, int)                                                                 \
  X(glColorMask, void, unsigned char, unsigned char, unsigned char, unsigned char)             \
  X(glCullFace, void, unsigned)                                                                \
  X(glDepthFunc, void, unsigned)                                                               \
  X(glDepthMask, void, unsigned char)                                                          \
  X(glDepthRangef, void, float, float)                                                         \
  X(glDisable, void, unsigned)                                                                 \
  X(glDisableVertexAttribArray, void, unsigned)                                                \
  X(glDiscardFramebufferEXT, void, unsigned, int, const unsigned*)                             \
  X(glEnable, void, unsigned)                                                                  \
  X(glEnableVertexAttribArray, void, unsigned)                                                 \
  X(glFrontFace, void, unsigned)                                                               \
  X(glGenerateMipmap, void, unsigned)                                                          \
  X(glGetError, unsigned)                                                                      \
  X(glIsTexture, unsigned char, unsigned)                                                      \
  X(glPixelStorei, void, unsigned, int)                                                        \
  X(glPolygonOffset, void, float, float)                                                       \
  X(glScissor, void, int, int, int, int)                                                       \
  X(glStencilFuncSeparate, void, unsigned, unsigned, int, unsigned)                            \
  X(glStencilMaskSeparate, void, unsigned, unsigned)                                           \
  X(glStencilOpSeparate, void, unsigned, unsigned, unsigned, unsigned)                         \
  X(glTexImage2D, void, unsigned, int, int, int, int, int, unsigned, unsigned, const void*)    \
  X(glTexSubImage2D, void, unsigned, int, int, int, int, int, unsigned, unsigned, const void*) \
  X(glUniform1f, void, int, float)                                                             \
  X(glUniform1i, void, int, int)                                                               \
  X(glUniform2fv, void, int, int, const float*)                                                \
  X(glUniform3fv, void, int, int, const float*)                                                \
  X(glUniform4fv, void, int, int, const float*)                                                \
  X(glUniformMatrix3fv, void, int, int, unsigned char, const float*)                           \
  X(glUniformMatrix4fv, void, int, int, unsigned char, const float*)                           \
  X(glUseProgram, void, unsigned)                                                              \
  X(glVertexAttribPointer, void, unsigned, int, unsigned, unsigned char, int, const void*)     \
  X(glViewport, void, int, int, int, int)

/// What an engine is given for an entry point of the driver.
inline void* countedEntryPoint(std::string_view name, void* driver) {
  if (driver == nullptr) return nullptr;
#define HALFSHADOW_BENCHMARK_COUNT(glName, ...)                      \
  if (name == #glName) {                                             \
    using Call = GlCall<__COUNTER__, __VA_ARGS__>;                   \
    Call::driver = reinterpret_cast<decltype(Call::driver)>(driver); \
    return reinterpret_cast<void*>(&Call::call);                     \
  }
  HALFSHADOW_BENCHMARK_GL_CALLS(HALFSHADOW_BENCHMARK_COUNT)
#undef HALFSHADOW_BENCHMARK_COUNT
  if (name == "glDrawArrays") {
    using Call = GlCall<-1, void, unsigned, int, int>;
    Call::driver = reinterpret_cast<decltype(Call::driver)>(driver);
    return reinterpret_cast<void*>(&Call::draw);
  }
  if (name == "glDrawElements") {
    using Call = GlCall<-2, void, unsigned, int, unsigned, const void*>;
    Call::driver = reinterpret_cast<decltype(Call::driver)>(driver);
    return reinterpret_cast<void*>(&Call::draw);
  }
  return driver;
}

}  // namespace halfshadow::benchmarks
