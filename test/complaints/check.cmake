# SPDX-License-Identifier: GPL-3.0-or-later
# Mistakes in arguments give one short sentence: each `#if CASE == n // SENTENCE` of planar.cpp and spatial.cpp is
# compiled by itself. The first error has to have that sentence, and all that is printed is at most 25 lines. A case
# without a sentence has to compile.
#
#   cmake -D COMPILER=PROGRAM -D FLAGS=LIST -D SOURCE_DIR=FOLDER -D WORK_DIR=FOLDER -P check.cmake

set(most_lines 25)
set(complaints "")
foreach(room planar spatial)
  # Headers are parsed once for all cases.
  file(COPY ${SOURCE_DIR}/${room}.h DESTINATION ${WORK_DIR})
  set(header ${WORK_DIR}/${room}.h)
  execute_process(COMMAND ${COMPILER} ${FLAGS} -x c++-header ${header} -o ${header}.gch COMMAND_ERROR_IS_FATAL ANY)

  file(STRINGS ${SOURCE_DIR}/${room}.cpp cases REGEX "^#if CASE == [0-9]+")
  foreach(case IN LISTS cases)
    string(REGEX MATCH "^#if CASE == ([0-9]+)( // (.*))?$" ignored "${case}")
    set(number ${CMAKE_MATCH_1})
    set(sentence "${CMAKE_MATCH_3}")
    execute_process(COMMAND ${COMPILER} ${FLAGS} -fsyntax-only -include ${header} -D CASE=${number} ${SOURCE_DIR}/${room}.cpp
      RESULT_VARIABLE status ERROR_VARIABLE output OUTPUT_QUIET)
    string(REGEX MATCHALL "\n" lines "${output}")
    list(LENGTH lines lines)
    string(REGEX MATCH "error:[^\n]*" first_error "${output}")
    message(STATUS "${room} ${number}: ${lines} lines. ${first_error}")
    string(FIND "${first_error}" "${sentence}" place)
    if(sentence STREQUAL "")
      if(NOT status EQUAL 0)
        string(APPEND complaints "${room} ${number} should compile:\n${output}\n")
      endif()
    elseif(status EQUAL 0 OR place EQUAL -1 OR lines GREATER most_lines)
      string(APPEND complaints "${room} ${number} should say \"${sentence}\" first, in ${most_lines} lines:\n${output}\n")
    endif()
  endforeach()
endforeach()
if(complaints)
  message(FATAL_ERROR "${complaints}")
endif()
