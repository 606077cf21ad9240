# SPDX-License-Identifier: GPL-3.0-or-later
# Two tests of all headers under include/weft:
#   headers_alone   each compiles without another one before it, twice in one file, and without warnings;
#   link_twice      two translation units that include all of them link into one program, which runs.
# The generated sources compile when ctest runs, so a header that fails is a test that fails.
#
# Most of the time would go into reading the same few headers of CGAL: these are precompiled, in groups. A header is
# compiled after a group only if it includes every header of the group, itself or through headers of weft (which are
# tested in the same way). So the group gives it nothing that it doesn't ask for. Other headers are compiled after none.

set(group_triangulation_3 ${weft_triangulation_3_headers})
set(group_triangulation_2 ${weft_triangulation_2_headers})
set(group_kernel CGAL/Exact_predicates_inexact_constructions_kernel.h)
set(group_rationals CGAL/number_utils.h CGAL/Exact_rational.h)
set(group_functions CGAL/number_utils.h CGAL/Kernel/global_functions.h)
set(group_numbers CGAL/number_utils.h)
set(groups triangulation_3 triangulation_2 kernel rationals functions numbers) # the first that fits is taken

file(GLOB_RECURSE headers CONFIGURE_DEPENDS RELATIVE ${PROJECT_SOURCE_DIR}/include ${PROJECT_SOURCE_DIR}/include/weft/*.h)
list(SORT headers)
find_package(Eigen3 CONFIG QUIET)
if(NOT TARGET Eigen3::Eigen)
  list(FILTER headers EXCLUDE REGEX "(^|/)solve/")
endif()
set(generated ${CMAKE_CURRENT_BINARY_DIR}/headers)
file(MAKE_DIRECTORY ${generated})

# What each header includes. Lines within #if count as well: a group holds no header that is included on a condition.
foreach(header IN LISTS headers)
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/include/${header})
  file(STRINGS ${PROJECT_SOURCE_DIR}/include/${header} lines REGEX "^#include <")
  list(TRANSFORM lines REPLACE "^#include <([^>]+)>.*$" "\\1")
  set(includes_of_${header} ${lines})
endforeach()

# Sets `result` to all that a header includes, directly or by headers of weft.
function(weft_find_includes header result)
  set(found "")
  set(left ${header})
  while(left)
    list(POP_FRONT left next)
    foreach(include IN LISTS includes_of_${next})
      if(NOT include IN_LIST found)
        list(APPEND found ${include})
        list(APPEND left ${include})
      endif()
    endforeach()
  endwhile()
  set(${result} ${found} PARENT_SCOPE)
endfunction()

set(all_includes "")
foreach(header IN LISTS headers)
  string(MAKE_C_IDENTIFIER ${header} name)
  file(CONFIGURE OUTPUT ${generated}/${name}.cpp CONTENT "#include <${header}>\n#include <${header}>\n")
  string(APPEND all_includes "#include <${header}>\n")
  weft_find_includes(${header} includes)
  set(group_of_header none)
  foreach(group IN LISTS groups)
    set(missing ${group_${group}})
    list(REMOVE_ITEM missing ${includes})
    if(NOT missing)
      set(group_of_header ${group})
      break()
    endif()
  endforeach()
  list(APPEND sources_${group_of_header} ${generated}/${name}.cpp)
endforeach()

add_custom_target(headers_alone)
foreach(group IN LISTS groups ITEMS none)
  if(NOT sources_${group})
    continue()
  endif()
  add_library(headers_after_${group} OBJECT EXCLUDE_FROM_ALL ${sources_${group}})
  target_link_libraries(headers_after_${group}
    PRIVATE weft::weft weft_strict_warnings $<$<TARGET_EXISTS:Eigen3::Eigen>:Eigen3::Eigen>)
  target_compile_options(headers_after_${group} PRIVATE $<$<CXX_COMPILER_ID:GNU,Clang,AppleClang>:-O0;-g0;-Werror>)
  if(group MATCHES "^triangulation_(.)$")
    target_precompile_headers(headers_after_${group} REUSE_FROM weft_precompiled_${CMAKE_MATCH_1})
  elseif(group_${group})
    list(TRANSFORM group_${group} REPLACE "^(.+)$" "<\\1>" OUTPUT_VARIABLE precompiled)
    target_precompile_headers(headers_after_${group} PRIVATE ${precompiled})
  endif()
  add_dependencies(headers_alone headers_after_${group})
endforeach()

file(CONFIGURE OUTPUT ${generated}/link_twice_main.cpp
  CONTENT "${all_includes}int other_translation_unit();\nint main() { return other_translation_unit(); }\n")
file(CONFIGURE OUTPUT ${generated}/link_twice_other.cpp
  CONTENT "${all_includes}int other_translation_unit();\nint other_translation_unit() { return 0; }\n")
add_executable(link_twice EXCLUDE_FROM_ALL ${generated}/link_twice_main.cpp ${generated}/link_twice_other.cpp)
target_link_libraries(link_twice PRIVATE weft::weft weft_warnings $<$<TARGET_EXISTS:Eigen3::Eigen>:Eigen3::Eigen>)
target_compile_options(link_twice PRIVATE $<$<CXX_COMPILER_ID:GNU,Clang,AppleClang>:-O0;-g0>)

# Two builds in one build tree must not run at once.
include(ProcessorCount)
ProcessorCount(processors)
foreach(target headers_alone link_twice)
  add_test(NAME ${target}_builds
    COMMAND ${CMAKE_COMMAND} --build ${PROJECT_BINARY_DIR} --config $<CONFIG> --target ${target})
  set_tests_properties(${target}_builds PROPERTIES
    LABELS headers RESOURCE_LOCK weft_build_tree PROCESSORS ${processors} COST 1000 TIMEOUT 1800)
endforeach()
set_tests_properties(link_twice_builds PROPERTIES FIXTURES_SETUP link_twice)
add_test(NAME link_twice COMMAND link_twice)
set_tests_properties(link_twice PROPERTIES LABELS headers FIXTURES_REQUIRED link_twice)
