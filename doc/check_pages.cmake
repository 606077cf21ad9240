# SPDX-License-Identifier: GPL-3.0-or-later
# Runs check_pages.awk on all pages, with the examples and tests as sources.

file(GLOB sources ${SOURCE_DIR}/examples/*.cpp ${SOURCE_DIR}/test/*.cpp)
file(GLOB pages ${SOURCE_DIR}/README.md ${SOURCE_DIR}/doc/*.md ${SOURCE_DIR}/benchmark/*.md ${SOURCE_DIR}/packaging/*.md)
file(GLOB_RECURSE headers ${SOURCE_DIR}/include/*.h ${SOURCE_DIR}/benchmark/*.h ${SOURCE_DIR}/examples/*.h
  ${SOURCE_DIR}/test/*.h ${SOURCE_DIR}/doc/*.h)
list(JOIN headers " " headers)
execute_process(COMMAND awk -v "headers=${headers} " -f ${SOURCE_DIR}/doc/check_pages.awk ${sources} ${pages}
  COMMAND_ERROR_IS_FATAL ANY)
