# SPDX-License-Identifier: MIT
# Run by CTest: installs, configures, builds and runs the minimal host. Any failing step is fatal.
function(step text)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE status OUTPUT_VARIABLE output ERROR_VARIABLE output)
  if(NOT status EQUAL 0)
    message(FATAL_ERROR "${text} failed (${status}):\n${output}")
  endif()
  set(output "${output}" PARENT_SCOPE)
  message(STATUS "${text}: done")
endfunction()

file(REMOVE_RECURSE ${WORK_DIR})
set(prefix ${WORK_DIR}/prefix)
step("Install" ${CMAKE_COMMAND} --install ${BUILD_DIR} --prefix ${prefix} --component library)

# What is installed: headers of include/halfshadow, one library, three CMake files; no header of a module.
file(GLOB_RECURSE installed RELATIVE ${prefix} ${prefix}/*)
foreach(file ${installed})
  if(NOT file MATCHES "^include/halfshadow/[a-z_]+\\.(hpp|h)$|/libhalfshadow\\.a$|/cmake/halfshadow/halfshadowConfig[A-Za-z-]*\\.cmake$")
    message(FATAL_ERROR "${file} should not be installed")
  endif()
endforeach()

# The library finds OpenGL ES through the host's getProcAddress: it must not need any gl or EGL symbol to link.
file(GLOB_RECURSE archive ${prefix}/libhalfshadow.a)
if(NM)
  step("List symbols" ${NM} --undefined-only ${archive})
  string(REGEX MATCH " U (gl[A-Z][A-Za-z]*|egl[A-Z][A-Za-z]*)" symbol "${output}")
  if(symbol)
    message(FATAL_ERROR "The library links against OpenGL ES or EGL:${symbol}")
  endif()
endif()

step("Configure" ${CMAKE_COMMAND} -G ${GENERATOR} -S ${SOURCE_DIR} -B ${WORK_DIR}/build -DCMAKE_PREFIX_PATH=${prefix})
step("Build" ${CMAKE_COMMAND} --build ${WORK_DIR}/build)
file(GLOB_RECURSE host ${WORK_DIR}/build/minimal)
step("Run" ${host})
message(STATUS "${output}")

# A request for another minor version must be refused: before 1.0 it may differ.
file(WRITE ${WORK_DIR}/other/CMakeLists.txt
  "cmake_minimum_required(VERSION 3.22)\nproject(other LANGUAGES CXX)\nfind_package(halfshadow 0.99 REQUIRED)\n")
execute_process(COMMAND ${CMAKE_COMMAND} -G ${GENERATOR} -S ${WORK_DIR}/other -B ${WORK_DIR}/other/build
                        -DCMAKE_PREFIX_PATH=${prefix} RESULT_VARIABLE status OUTPUT_QUIET ERROR_QUIET)
if(status EQUAL 0)
  message(FATAL_ERROR "Version ${VERSION} was accepted where 0.99 was asked for")
endif()
