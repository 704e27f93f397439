# SPDX-License-Identifier: GPL-3.0-or-later
# Helpers that keep every stage folder's CMakeLists.txt to a few lines.

find_package(Eigen3 3.4 REQUIRED NO_MODULE)
find_package(fmt REQUIRED)
find_package(Threads REQUIRED)
find_package(PkgConfig REQUIRED)

# No warnings from third-party headers, in any target.
add_library(clatter_eigen INTERFACE)
target_link_libraries(clatter_eigen INTERFACE Eigen3::Eigen)

# The standard library, Eigen and fmt are precompiled once for all libraries, and once with GoogleTest for
# all tests: they dominate the compile time. Every file still includes what it uses. The kernels of Eigen's products
# are declared there as well, and are in a library of their own.
option(CLATTER_PRECOMPILE "precompile third-party headers" ON)
function(clatter_precompiled name)
  cmake_parse_arguments(ARG "" "" "LINKS" ${ARGN})
  file(CONFIGURE OUTPUT ${PROJECT_BINARY_DIR}/${name}.cpp CONTENT "")
  add_library(${name} STATIC ${PROJECT_BINARY_DIR}/${name}.cpp)
  target_link_libraries(${name} PRIVATE clatter_eigen fmt::fmt Threads::Threads ${ARG_LINKS})
  target_precompile_headers(${name} PRIVATE ${ARG_UNPARSED_ARGUMENTS})
endfunction()
function(clatter_use_precompiled target from)
  if(CLATTER_PRECOMPILE)
    target_precompile_headers(${target} REUSE_FROM ${from})
    target_link_libraries(${target} PRIVATE clatter_eigen_kernels)
  endif()
endfunction()
set(clatter_third_party_headers
  <Eigen/Dense> <Eigen/SparseCore> <fmt/format.h> <fmt/ranges.h> <algorithm> <array> <cmath> <cstdint> <filesystem>
  <fstream> <functional> <limits> <map> <memory> <numbers> <numeric> <optional> <random> <set> <span> <string>
  <string_view> <utility> <vector> "${PROJECT_SOURCE_DIR}/core/base/eigen_kernels.hpp")
if(CLATTER_PRECOMPILE)
  add_library(clatter_eigen_kernels STATIC ${PROJECT_SOURCE_DIR}/core/base/eigen_kernels.cpp)
  target_include_directories(clatter_eigen_kernels PRIVATE ${PROJECT_SOURCE_DIR})
  target_link_libraries(clatter_eigen_kernels PRIVATE clatter_eigen)
  clatter_precompiled(clatter_headers ${clatter_third_party_headers})
endif()

# Neighbouring sources of a library or a test program are compiled as one file, so that what they
# instantiate (Eigen, fmt, containers) is compiled once. Errors keep file and line. For repeated edits of
# one file -DCLATTER_UNITY=OFF is faster; it also finds includes that are missing.
option(CLATTER_UNITY "compile neighbouring sources as one file" ON)
set(CMAKE_UNITY_BUILD ${CLATTER_UNITY})
set(CMAKE_UNITY_BUILD_BATCH_SIZE 12)

# clatter_library(<name> SOURCES a.cpp ... LINKS clatter::core ...)
# creates the static library clatter_<name>, alias clatter::<name>; include headers as "<folder>/x.hpp".
function(clatter_library name)
  cmake_parse_arguments(ARG "" "" "SOURCES;LINKS;PRIVATE_LINKS" ${ARGN})
  add_library(clatter_${name} STATIC ${ARG_SOURCES})
  add_library(clatter::${name} ALIAS clatter_${name})
  target_include_directories(clatter_${name} PUBLIC ${PROJECT_SOURCE_DIR})
  target_link_libraries(clatter_${name} PUBLIC ${ARG_LINKS} PRIVATE ${ARG_PRIVATE_LINKS})
  clatter_use_precompiled(clatter_${name} clatter_headers)
endfunction()

# clatter_stage(<name> SOURCES main.cpp LINKS clatter::<name>) creates the executable clatter-<name>.
function(clatter_stage name)
  cmake_parse_arguments(ARG "" "" "SOURCES;LINKS" ${ARGN})
  add_executable(clatter-${name} ${ARG_SOURCES})
  target_link_libraries(clatter-${name} PRIVATE ${ARG_LINKS})
  clatter_use_precompiled(clatter-${name} clatter_headers)
  set_target_properties(clatter-${name} PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/bin)
  if(CLATTER_LEVELS)
    install(TARGETS clatter-${name} RUNTIME DESTINATION ${CMAKE_INSTALL_LIBEXECDIR}/clatter/${CLATTER_ARCH})
  else()
    install(TARGETS clatter-${name})
  endif()
endfunction()

# clatter_test(<name> LABEL unit SOURCES x_test.cpp LINKS clatter::core [DEFINES A=B] [TIMEOUT s])
# creates one test program; each GoogleTest case is a CTest test with the label.
include(GoogleTest)
function(clatter_test name)
  cmake_parse_arguments(ARG "" "LABEL;TIMEOUT" "SOURCES;LINKS;DEFINES" ${ARGN})
  if(NOT ARG_TIMEOUT)
    set(ARG_TIMEOUT 300)
  endif()
  add_executable(${name} ${ARG_SOURCES})
  target_link_libraries(${name} PRIVATE ${ARG_LINKS} GTest::gtest_main)
  clatter_use_precompiled(${name} clatter_test_headers)
  target_compile_definitions(${name} PRIVATE ${ARG_DEFINES})
  target_include_directories(${name} PRIVATE ${PROJECT_BINARY_DIR}/generated)
  set(hard "*Hard??_*:*Hard???_*:*HardTD??_*")
  gtest_discover_tests(${name} DISCOVERY_MODE PRE_TEST TEST_FILTER "-${hard}"
    PROPERTIES LABELS "${ARG_LABEL}" TIMEOUT ${ARG_TIMEOUT})
  # Tests named after a hard case get the label `hard` in every program.
  gtest_discover_tests(${name} DISCOVERY_MODE PRE_TEST TEST_FILTER "${hard}"
    TEST_LIST ${name}_hard PROPERTIES LABELS hard TIMEOUT ${ARG_TIMEOUT})
endfunction()
