# SPDX-License-Identifier: MIT
# What hosts get: one static library with every engine module in it, the public headers, and a CMake package, so that
#   find_package(halfshadow 0.1 REQUIRED)
#   target_link_libraries(host PRIVATE halfshadow::halfshadow)
# is all. GLM is compiled in; OpenGL ES is not linked: the host passes its getProcAddress.
include(CMakePackageConfigHelpers)
include(GNUInstallDirs)

# Not named `halfshadow`: that is the command line tool's target.
add_library(hs_library STATIC)
foreach(module base device scene outlines gl framegraph_plan framegraph planner technique_plans techniques api)
  target_sources(hs_library PRIVATE $<TARGET_OBJECTS:hs_${module}>)
endforeach()
set_target_properties(hs_library PROPERTIES OUTPUT_NAME halfshadow EXPORT_NAME halfshadow LINKER_LANGUAGE CXX)
target_compile_features(hs_library INTERFACE cxx_std_17)
target_include_directories(hs_library INTERFACE $<BUILD_INTERFACE:${CMAKE_CURRENT_SOURCE_DIR}/include>
                                                $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
add_library(halfshadow::halfshadow ALIAS hs_library)

set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/halfshadow)
install(TARGETS hs_library EXPORT halfshadow ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT library)
install(DIRECTORY include/halfshadow DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} COMPONENT library)
install(EXPORT halfshadow NAMESPACE halfshadow:: FILE halfshadowConfig.cmake DESTINATION ${package_dir}
        COMPONENT library)
# Before 1.0 a minor version may change the interface.
write_basic_package_version_file(${CMAKE_CURRENT_BINARY_DIR}/halfshadowConfigVersion.cmake
                                 VERSION ${PROJECT_VERSION} COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/halfshadowConfigVersion.cmake DESTINATION ${package_dir} COMPONENT library)
