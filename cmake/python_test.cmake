# SPDX-License-Identifier: GPL-3.0-or-later
# Tests that use Python's unittest.

# clatter_python_test(<file without .py> <label> [class ...]) runs the file, or only the given classes;
# the label `long` runs in `make validate` only. With -v the methods that it skips are in the log, for tests/tools/skipped.py.
function(clatter_python_test file label)
  string(JOIN "_" name ${file} ${ARGN})
  add_test(NAME ${name} COMMAND /usr/bin/python3 -B ${CMAKE_CURRENT_SOURCE_DIR}/${file}.py -v ${ARGN})
  if(label STREQUAL "long")
    set(seconds 5400)
  else()
    set(seconds 600)
  endif()
  math(EXPR seconds "${seconds} * ${CLATTER_SLOWER}")
  set_tests_properties(${name} PROPERTIES LABELS "${label}" TIMEOUT ${seconds} SKIP_RETURN_CODE 77
    ENVIRONMENT "CLATTER_BIN=${PROJECT_BINARY_DIR}/bin;CLATTER_BUILD=${PROJECT_BINARY_DIR};PYTHONPATH=${PROJECT_SOURCE_DIR}/python:${PROJECT_SOURCE_DIR}/tools:${PROJECT_SOURCE_DIR}/tests/tools;OMP_NUM_THREADS=2")
endfunction()
