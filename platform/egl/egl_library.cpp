// SPDX-License-Identifier: MIT
// Copyright (c) 2026 The Halfshadow authors
#include "egl/egl_library.hpp"

#include <dlfcn.h>

namespace halfshadow {

Result<EglLibrary> loadEgl(const std::string& eglName, const std::string& glName) {
  EglLibrary egl;
  // The GL library first: ANGLE's EGL library looks it up by soname, and finds a loaded one without a path.
  egl.glLibrary = dlopen(glName.c_str(), RTLD_NOW | RTLD_LOCAL);
  void* library = dlopen(eglName.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (!library) {
    const char* reason = dlerror();
    return Error{ErrorCode::driverMissing,
                 "EGL library " + eglName + " cannot be loaded (" + (reason ? reason : "?") +
                     "); install libegl1 and libgles2 with libegl-mesa0, or give another "
                     "library."};
  }
  std::string missing;
#define HALFSHADOW_EGL_LOAD(member, eglSymbol)                                       \
  egl.member = reinterpret_cast<decltype(&::eglSymbol)>(dlsym(library, #eglSymbol)); \
  if (!egl.member) missing += std::string(" ") + #eglSymbol;
  HALFSHADOW_EGL_FUNCTIONS(HALFSHADOW_EGL_LOAD)
#undef HALFSHADOW_EGL_LOAD
  if (!missing.empty()) {
    return Error{ErrorCode::driverMissing, "EGL library " + eglName + " lacks" + missing +
                                               "; it is no EGL 1.4 library, give another one."};
  }
  egl.getPlatformDisplay =
      reinterpret_cast<PFNEGLGETPLATFORMDISPLAYEXTPROC>(egl.getProcAddress("eglGetPlatformDisplayEXT"));
  egl.queryDevices = reinterpret_cast<PFNEGLQUERYDEVICESEXTPROC>(egl.getProcAddress("eglQueryDevicesEXT"));
  egl.queryDeviceString =
      reinterpret_cast<PFNEGLQUERYDEVICESTRINGEXTPROC>(egl.getProcAddress("eglQueryDeviceStringEXT"));
  return egl;
}

void* EglLibrary::findGl(const char* name) const {
  // EGL 1.4 answers only extension functions, so the library comes first.
  if (glLibrary) {
    if (void* address = dlsym(glLibrary, name)) return address;
  }
  return reinterpret_cast<void*>(getProcAddress(name));
}

std::string EglLibrary::clientExtensions() const {
  const char* text = queryString(EGL_NO_DISPLAY, EGL_EXTENSIONS);
  if (!text) {
    getError();
    return " ";
  }
  return " " + std::string(text) + " ";
}

}  // namespace halfshadow
