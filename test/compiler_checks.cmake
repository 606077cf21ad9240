# SPDX-License-Identifier: GPL-3.0-or-later
# Two tests that run the compiler, without making programs:
#   header_examples   the example on top of each header compiles;
#   complaints        mistakes in arguments give one short sentence.

if(CMAKE_CXX_COMPILER_ID MATCHES "GNU|Clang")
  # For what is compiled and linked with weft: the properties are those of weft::weft and all that it needs.
  add_library(compiler_checks OBJECT EXCLUDE_FROM_ALL test_main.cpp)
  target_link_libraries(compiler_checks PRIVATE weft::weft)
  set(folders "$<TARGET_PROPERTY:compiler_checks,INCLUDE_DIRECTORIES>")
  set(macros "$<TARGET_PROPERTY:compiler_checks,COMPILE_DEFINITIONS>")
  string(CONCAT flags "-std=c++17"
    "$<$<BOOL:${folders}>:;-I$<JOIN:$<FILTER:${folders},EXCLUDE,^/usr/include$>,;-I>>"
    "$<$<BOOL:${macros}>:;-D$<JOIN:${macros},;-D>>")

  add_test(NAME header_examples COMMAND ${CMAKE_COMMAND}
    -D COMPILER=${CMAKE_CXX_COMPILER} -D "FLAGS=${flags}" -D SOURCE_DIR=${PROJECT_SOURCE_DIR}
    -D WORK_DIR=${CMAKE_CURRENT_BINARY_DIR}/header_examples -P ${CMAKE_CURRENT_SOURCE_DIR}/header_examples.cmake)
  set_tests_properties(header_examples PROPERTIES LABELS headers COST 70 TIMEOUT 1800)

  # What a compiler prints is its own: both are asked where both are installed.
  set(compilers ${CMAKE_CXX_COMPILER})
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    find_program(WEFT_OTHER_COMPILER clang++ DOC "A second compiler, for the test of error messages")
  else()
    find_program(WEFT_OTHER_COMPILER g++ DOC "A second compiler, for the test of error messages")
  endif()
  if(WEFT_OTHER_COMPILER)
    list(APPEND compilers ${WEFT_OTHER_COMPILER})
  endif()
  foreach(compiler IN LISTS compilers)
    cmake_path(GET compiler FILENAME name)
    add_test(NAME complaints_${name} COMMAND ${CMAKE_COMMAND}
      -D COMPILER=${compiler} -D "FLAGS=${flags}" -D SOURCE_DIR=${CMAKE_CURRENT_SOURCE_DIR}/complaints
      -D WORK_DIR=${CMAKE_CURRENT_BINARY_DIR}/complaints/${name} -P ${CMAKE_CURRENT_SOURCE_DIR}/complaints/check.cmake)
    set_tests_properties(complaints_${name} PROPERTIES LABELS headers COST 80 TIMEOUT 1800)
  endforeach()
endif()
