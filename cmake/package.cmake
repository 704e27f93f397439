# SPDX-License-Identifier: GPL-3.0-or-later
# find_package(clatter) of an installation: headers, libraries, what they link.
if(NOT CLATTER_INSTALL_LIBRARIES)
  return()
endif()
include(CMakePackageConfigHelpers)
set(package ${CMAKE_INSTALL_LIBDIR}/cmake/clatter)
install(EXPORT clatter FILE clatterTargets.cmake NAMESPACE clatter:: DESTINATION ${package})
configure_package_config_file(cmake/clatterConfig.cmake.in ${PROJECT_BINARY_DIR}/clatterConfig.cmake
                              INSTALL_DESTINATION ${package})
# Until 1.0.0 a minor version may change what programs use.
write_basic_package_version_file(${PROJECT_BINARY_DIR}/clatterConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/clatterConfig.cmake ${PROJECT_BINARY_DIR}/clatterConfigVersion.cmake
        DESTINATION ${package})
install(DIRECTORY core mesh assembly modal condense dynamics recover
        DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/clatter FILES_MATCHING PATTERN "*.hpp" PATTERN "*_impl.hpp" EXCLUDE)
