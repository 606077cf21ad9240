# SPDX-License-Identifier: GPL-3.0-or-later
# Two tests of all headers under include/weft:
#   headers_alone   each compiles without another one before it, twice in one file, and without warnings;
#   link_twice      two translation units that include all of them link into one program, which runs.
# The generated sources compile when ctest runs, so a header that fails is a test that fails.

file(GLOB_RECURSE headers CONFIGURE_DEPENDS RELATIVE ${PROJECT_SOURCE_DIR}/include ${PROJECT_SOURCE_DIR}/include/weft/*.h)
list(SORT headers)
set(generated ${CMAKE_CURRENT_BINARY_DIR}/headers)
file(MAKE_DIRECTORY ${generated})

set(sources "")
set(all_includes "")
foreach(header IN LISTS headers)
  string(MAKE_C_IDENTIFIER ${header} name)
  file(CONFIGURE OUTPUT ${generated}/${name}.cpp CONTENT "#include <${header}>\n#include <${header}>\n")
  list(APPEND sources ${generated}/${name}.cpp)
  string(APPEND all_includes "#include <${header}>\n")
endforeach()

add_library(headers_alone OBJECT EXCLUDE_FROM_ALL ${sources})
target_link_libraries(headers_alone PRIVATE weft::weft weft_strict_warnings)
target_compile_options(headers_alone PRIVATE $<$<CXX_COMPILER_ID:GNU,Clang,AppleClang>:-O0;-g0;-Werror>)

file(CONFIGURE OUTPUT ${generated}/link_twice_main.cpp
  CONTENT "${all_includes}int other_translation_unit();\nint main() { return other_translation_unit(); }\n")
file(CONFIGURE OUTPUT ${generated}/link_twice_other.cpp
  CONTENT "${all_includes}int other_translation_unit();\nint other_translation_unit() { return 0; }\n")
add_executable(link_twice EXCLUDE_FROM_ALL ${generated}/link_twice_main.cpp ${generated}/link_twice_other.cpp)
target_link_libraries(link_twice PRIVATE weft::weft weft_warnings)
target_compile_options(link_twice PRIVATE $<$<CXX_COMPILER_ID:GNU,Clang,AppleClang>:-O0;-g0>)

# Two builds in one build tree must not run at once.
include(ProcessorCount)
ProcessorCount(processors)
foreach(target headers_alone link_twice)
  add_test(NAME ${target}_builds
    COMMAND ${CMAKE_COMMAND} --build ${PROJECT_BINARY_DIR} --config $<CONFIG> --target ${target})
  set_tests_properties(${target}_builds PROPERTIES
    LABELS headers RESOURCE_LOCK weft_build_tree PROCESSORS ${processors} TIMEOUT 1800)
endforeach()
set_tests_properties(link_twice_builds PROPERTIES FIXTURES_SETUP link_twice)
add_test(NAME link_twice COMMAND link_twice)
set_tests_properties(link_twice PROPERTIES LABELS headers FIXTURES_REQUIRED link_twice)
