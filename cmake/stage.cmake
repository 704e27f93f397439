# SPDX-License-Identifier: GPL-3.0-or-later
# Helpers that keep every stage folder's CMakeLists.txt to a few lines.

find_package(Eigen3 3.4 REQUIRED NO_MODULE)
find_package(fmt REQUIRED)
find_package(Threads REQUIRED)
find_package(PkgConfig REQUIRED)

# No warnings from third-party headers, in any target.
add_library(clatter_eigen INTERFACE)
target_link_libraries(clatter_eigen INTERFACE Eigen3::Eigen)

# Libraries are installed for programs of others: find_package(clatter COMPONENTS ...), cmake/clatterConfig.cmake.in.
# Of an installation for several generations of processors they are those of the oldest.
if(NOT CLATTER_LEVELS OR CLATTER_ARCH STREQUAL "x86-64")
  set(CLATTER_INSTALL_LIBRARIES ON)
endif()
# clatter_install(clatter_sparse ...): exported as clatter::sparse.
function(clatter_install)
  foreach(target ${ARGN})
    string(REGEX REPLACE "^clatter_" "" exported ${target})
    set_target_properties(${target} PROPERTIES EXPORT_NAME ${exported})
  endforeach()
  if(CLATTER_INSTALL_LIBRARIES)
    install(TARGETS ${ARGN} EXPORT clatter ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR}/clatter)
  endif()
endfunction()
clatter_install(clatter_eigen)

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
  clatter_install(clatter_eigen_kernels)
  clatter_precompiled(clatter_headers ${clatter_third_party_headers})
endif()

# Neighbouring sources of a library or a test program are compiled as one file, so that what they
# instantiate (Eigen, fmt, containers) is compiled once. Errors keep file and line. For repeated edits of
# one file -DCLATTER_UNITY=OFF is faster; it also finds includes that are missing.
option(CLATTER_UNITY "compile neighbouring sources as one file" ON)
set(CMAKE_UNITY_BUILD ${CLATTER_UNITY})
set(CMAKE_UNITY_BUILD_BATCH_SIZE 12)

# clatter_library(<name> SOURCES a.cpp ... LINKS clatter::core ... PRIVATE_LINKS ...)
# creates the static library clatter_<name>, or without SOURCES one of headers alone; its alias is clatter::<name>, in an
# installation as well. Include headers as "<folder>/x.hpp".
function(clatter_library name)
  cmake_parse_arguments(ARG "" "" "SOURCES;LINKS;PRIVATE_LINKS" ${ARGN})
  if(ARG_SOURCES)
    set(users PUBLIC)
    add_library(clatter_${name} STATIC ${ARG_SOURCES})
    target_link_libraries(clatter_${name} PRIVATE ${ARG_PRIVATE_LINKS})
    clatter_use_precompiled(clatter_${name} clatter_headers)
  else()
    set(users INTERFACE)
    add_library(clatter_${name} INTERFACE)
  endif()
  add_library(clatter::${name} ALIAS clatter_${name})
  target_include_directories(clatter_${name} ${users}
    $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}> $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}/clatter>)
  target_link_libraries(clatter_${name} ${users} ${ARG_LINKS})
  clatter_install(clatter_${name})
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

# The GoogleTest filter of all cases of the sources ARGN, also of those with parameters or types.
function(clatter_cases_of out)
  set(filter "")
  foreach(source ${ARGN})
    file(READ ${source} text)
    string(REGEX MATCHALL "\n(TEST|TEST_F|TEST_P|TYPED_TEST)\\([ \n]*[A-Za-z0-9_]+,[ \n]*[A-Za-z0-9_]+\\)" cases "${text}")
    foreach(case ${cases})
      string(REGEX REPLACE ".*\\([ \n]*([A-Za-z0-9_]+),[ \n]*([A-Za-z0-9_]+)\\)" "\\1.\\2:*/\\1.\\2/*:\\1/*.\\2" case "${case}")
      string(APPEND filter ":${case}")
    endforeach()
  endforeach()
  string(SUBSTRING "${filter}" 1 -1 filter)
  set(${out} "${filter}" PARENT_SCOPE)
endfunction()

# clatter_test(<name> LINKS clatter::core [UNIT a_test.cpp ...] [ORDER ...] [INVARIANT ...] [PIPELINE ...] [CLI ...]
#              [HARD ...] [LONG ...] [SOURCES helper.cpp ...] [DEFINES A=B] [TIMEOUT s])
# creates one test program. Each GoogleTest case is a CTest test with the label under which its source is listed; a case
# that is new since CMake ran has the first of these labels until it runs again.
include(GoogleTest)
function(clatter_test name)
  set(labels UNIT ORDER INVARIANT PIPELINE CLI HARD LONG)
  cmake_parse_arguments(ARG "" "TIMEOUT" "SOURCES;LINKS;DEFINES;${labels}" ${ARGN})
  if(NOT ARG_TIMEOUT)
    set(ARG_TIMEOUT 300)
  endif()
  set(sources ${ARG_SOURCES})
  foreach(label ${labels})
    list(APPEND sources ${ARG_${label}})
  endforeach()
  add_executable(${name} ${sources})
  target_link_libraries(${name} PRIVATE ${ARG_LINKS} GTest::gtest_main)
  clatter_use_precompiled(${name} clatter_test_headers)
  target_compile_definitions(${name} PRIVATE ${ARG_DEFINES})
  target_include_directories(${name} PRIVATE ${PROJECT_BINARY_DIR}/generated)
  # Tests named after a hard case get the label `hard` wherever they are.
  set(hard "*Hard??_*:*Hard???_*:*HardTD??_*")
  clatter_register_cases(${name} hard "${hard}" ${ARG_TIMEOUT})
  set(rest "-${hard}")
  set(first "")
  foreach(label ${labels})
    string(TOLOWER ${label} lower)
    if(NOT ARG_${label})
      continue()
    elseif(NOT first)
      set(first ${lower})
      continue()
    endif()
    clatter_cases_of(cases ${ARG_${label}})
    set(seconds ${ARG_TIMEOUT})
    if(label STREQUAL "LONG")
      set(seconds 1800)
    endif()
    clatter_register_cases(${name} ${lower} "${cases}-${hard}" ${seconds})
    string(APPEND rest ":${cases}")
  endforeach()
  clatter_register_cases(${name} ${first} "${rest}" ${ARG_TIMEOUT})
endfunction()

function(clatter_register_cases name label filter seconds)
  math(EXPR seconds "${seconds} * ${CLATTER_SLOWER}")
  gtest_discover_tests(${name} DISCOVERY_MODE PRE_TEST DISCOVERY_TIMEOUT 60 TEST_FILTER "${filter}" TEST_LIST ${name}_${label}
    PROPERTIES LABELS ${label} TIMEOUT ${seconds})
endfunction()
