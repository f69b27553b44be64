# SPDX-License-Identifier: MIT
# Test programs that render scenes and compare them with ray-traced truth.

# A program of these sources and the scene renderer of tests/visibility.
function(picture_test target)
  set(visibility ${PROJECT_SOURCE_DIR}/tests/visibility)
  add_executable(${target} ${ARGN} ${visibility}/engine_fixture.cpp ${visibility}/analytic_scenes.cpp
                 ${visibility}/truth.cpp)
  target_include_directories(${target} PRIVATE ${visibility})
  target_link_libraries(${target} PRIVATE hs_api hs_gl hs_planner hs_scenes hs_scene hs_reference hs_metrics hs_images
                        hs_egl GTest::gtest_main)
  # One folder for all, so that each truth image is traced once.
  target_compile_definitions(${target} PRIVATE HALFSHADOW_TEST_OUTPUT_DIR="${PROJECT_BINARY_DIR}/test-output/visibility")
endfunction()

# Tests of one program share an engine: whatever order they run in, none may depend on what another left. Programs that
# run more than once do so in a shuffled order the first time, in their own the others. Fixed, so that a failure repeats.
set(HALFSHADOW_SHUFFLED --gtest_shuffle --gtest_random_seed=20261)

# One run of the program, with these environment variables.
function(picture_entry name target)
  cmake_parse_arguments(arg "" "" "ARGUMENTS" ${ARGN})
  add_test(NAME ${name} COMMAND ${target} ${arg_ARGUMENTS})
  set_tests_properties(${name} PROPERTIES LABELS techniques ENVIRONMENT "${arg_UNPARSED_ARGUMENTS}")
endfunction()

# Runs on llvmpipe, there once without each of the named capabilities, and on ANGLE where tests/fetch_angle.sh
# has put it.
function(picture_entries name target)
  picture_entry(${name} ${target} HALFSHADOW_TEST_DRIVER=llvmpipe ARGUMENTS ${HALFSHADOW_SHUFFLED})
  foreach(capability ${ARGN})
    picture_entry(${name}_without_${capability} ${target} HALFSHADOW_TEST_DRIVER=llvmpipe HALFSHADOW_TEST_FORCE=${capability})
  endforeach()
  set(angle_dir $ENV{HALFSHADOW_ANGLE_DIR})
  if(NOT angle_dir)
    set(angle_dir $ENV{HOME}/.cache/halfshadow/angle)
  endif()
  if(EXISTS ${angle_dir}/libEGL.so)
    picture_entry(${name}_on_angle ${target} HALFSHADOW_TEST_DRIVER=angle HALFSHADOW_ANGLE_DIR=${angle_dir})
  endif()
endfunction()
