# SPDX-License-Identifier: GPL-3.0-or-later
# Target clatter_each_header: every header compiles by itself, without the precompiled ones.
file(GLOB_RECURSE clatter_headers_of_sources CONFIGURE_DEPENDS RELATIVE ${PROJECT_SOURCE_DIR}
  core/*.hpp mesh/*.hpp assembly/*.hpp modal/*.hpp condense/*.hpp dynamics/*.hpp recover/*.hpp)
set(clatter_header_sources)
foreach(header ${clatter_headers_of_sources})
  string(REPLACE "/" "__" name ${header})
  set(source ${PROJECT_BINARY_DIR}/each_header/${name}.cpp)
  file(CONFIGURE OUTPUT ${source} CONTENT "#include \"${header}\"\n")
  list(APPEND clatter_header_sources ${source})
endforeach()
add_library(clatter_each_header OBJECT EXCLUDE_FROM_ALL ${clatter_header_sources})
set_target_properties(clatter_each_header PROPERTIES UNITY_BUILD OFF)
target_compile_options(clatter_each_header PRIVATE -fsyntax-only)
target_include_directories(clatter_each_header SYSTEM PRIVATE ${HDF5_INCLUDE_DIRS} ${CHOLMOD_INCLUDE}
  ${METIS_INCLUDE} ${MUMPS_INCLUDE} ${GMSH_INCLUDE_DIR} ${OCCT_INCLUDE_DIR})
target_link_libraries(clatter_each_header PRIVATE clatter::modes clatter::mesh_cad)
if(CLATTER_TESTS)
  add_test(NAME EachHeader.CompilesByItself
           COMMAND ${CMAKE_COMMAND} --build ${PROJECT_BINARY_DIR} --target clatter_each_header)
  set_tests_properties(EachHeader.CompilesByItself PROPERTIES LABELS "long;unit" TIMEOUT 3600)
endif()
