/* SPDX-License-Identifier: MIT
 * Copyright (c) 2026 The Halfshadow authors */
/** @file
 * The one list of error codes: enum values and texts are both made from it. C99 and C++.
 */
#ifndef HALFSHADOW_ERROR_CODES_H
#define HALFSHADOW_ERROR_CODES_H

/* X(name, NAME, "what it means") */
#define HALFSHADOW_ERROR_LIST(X)                                                                 \
  X(ok, OK, "no error")                                                                          \
  X(invalidArgument, INVALID_ARGUMENT, "an argument is outside its documented range")            \
  X(invalidMesh, INVALID_MESH, "the mesh cannot be used: indices or positions are out of range") \
  X(invalidLight, INVALID_LIGHT, "the light has non-finite or degenerate vectors")               \
  X(invalidCamera, INVALID_CAMERA, "the camera has non-finite or degenerate vectors")            \
  X(emptyScene, EMPTY_SCENE, "the scene has no triangles")                                       \
  X(fileNotFound, FILE_NOT_FOUND, "the file does not exist or cannot be read")                   \
  X(fileMalformed, FILE_MALFORMED, "the file is not what its name or header says")               \
  X(fileNotWritable, FILE_NOT_WRITABLE, "the output cannot be written")                          \
  X(driverMissing, DRIVER_MISSING, "no usable EGL or OpenGL ES 2.0 driver was found")            \
  X(capabilityMissing, CAPABILITY_MISSING, "the driver lacks a capability that this needs")      \
  X(unknownTechnique, UNKNOWN_TECHNIQUE, "no technique has this id")                             \
  X(unknownSetting, UNKNOWN_SETTING, "no technique has this setting")                            \
  X(shaderFailed, SHADER_FAILED, "a shader did not compile or link")                             \
  X(outOfMemory, OUT_OF_MEMORY, "the driver or the system is out of memory")                     \
  X(contextLost, CONTEXT_LOST, "the OpenGL ES context was lost")                                 \
  X(driverFault, DRIVER_FAULT, "the driver raised an unexpected OpenGL ES error")                \
  X(internal, INTERNAL, "a broken invariant inside the engine; please report it")

#endif
