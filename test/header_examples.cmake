# SPDX-License-Identifier: GPL-3.0-or-later
# Examples in the headers' opening comments compile, each with its header and the headers that it includes itself. An
# example is an indented block with a semicolon; the kernel K stands for the usual one.
#
#   cmake -D COMPILER=PROGRAM -D FLAGS=LIST -D SOURCE_DIR=FOLDER -D WORK_DIR=FOLDER -P header_examples.cmake

file(GLOB_RECURSE headers RELATIVE ${SOURCE_DIR}/include ${SOURCE_DIR}/include/weft/*.h)
list(SORT headers)
set(examples 0)
set(complaints "")

foreach(header IN LISTS headers)
  # Semicolons and brackets would split and join the list of lines.
  file(READ ${SOURCE_DIR}/include/${header} text)
  string(REGEX REPLACE "\n[^/].*" "\n" text "${text}")
  string(REGEX REPLACE "\n\n.*" "\n" text "${text}")
  if(NOT text MATCHES "\n//   [^ \n][^\n]*;")
    continue()
  endif()
  string(REPLACE ";" "<semicolon>" text "${text}")
  string(REPLACE "[" "<opening>" text "${text}")
  string(REPLACE "]" "<closing>" text "${text}")
  string(REGEX MATCHALL "\n//[^\n]*" lines "${text}")
  set(includes "")
  set(code "")
  foreach(line IN LISTS lines)
    if(line MATCHES "^\n//   (#include .*)$")
      string(APPEND includes "${CMAKE_MATCH_1}\n")
    elseif(line MATCHES "^\n//   (.*)$")
      string(APPEND code "  ${CMAKE_MATCH_1}\n")
    endif()
  endforeach()
  set(source "#include <${header}>\n${includes}#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>\n\n\
using K = CGAL::Exact_predicates_inexact_constructions_kernel<semicolon>\n\nvoid example()\n{\n${code}}\n")
  string(REPLACE "<semicolon>" ";" source "${source}")
  string(REPLACE "<opening>" "[" source "${source}")
  string(REPLACE "<closing>" "]" source "${source}")
  string(MAKE_C_IDENTIFIER ${header} name)
  file(WRITE ${WORK_DIR}/${name}.cpp "${source}")

  execute_process(COMMAND ${COMPILER} ${FLAGS} -fsyntax-only ${WORK_DIR}/${name}.cpp
    RESULT_VARIABLE status ERROR_VARIABLE errors OUTPUT_QUIET)
  math(EXPR examples "${examples} + 1")
  if(NOT status EQUAL 0)
    string(APPEND complaints "${header}: its example doesn't compile:\n${errors}\n")
  endif()
endforeach()

message(STATUS "${examples} examples")
if(examples EQUAL 0)
  message(FATAL_ERROR "no header has an example")
endif()
if(complaints)
  message(FATAL_ERROR "${complaints}")
endif()
