# SPDX-License-Identifier: GPL-3.0-or-later
# programs_compile: whether those programs compile that neither the tests nor .ci/run run. No code is generated, which
# takes less than half the time.

set(programs_that_run mesh_2 mesh_3 improve_2 improve_3 adapt_3 custom_types heat_conduction gallery_planar
  gallery_spatial report_inputs measure_mesh_2 measure_mesh_3)

# Sets `result` to the sources of all other programs in a directory and those below.
function(weft_collect_sources directory result)
  set(sources "")
  get_property(targets DIRECTORY ${directory} PROPERTY BUILDSYSTEM_TARGETS)
  list(REMOVE_ITEM targets ${programs_that_run})
  foreach(target IN LISTS targets)
    get_target_property(type ${target} TYPE)
    if(type STREQUAL "EXECUTABLE")
      get_target_property(names ${target} SOURCES)
      foreach(name IN LISTS names)
        cmake_path(ABSOLUTE_PATH name BASE_DIRECTORY ${directory})
        list(APPEND sources ${name})
      endforeach()
    endif()
  endforeach()
  get_property(subdirectories DIRECTORY ${directory} PROPERTY SUBDIRECTORIES)
  foreach(subdirectory IN LISTS subdirectories)
    weft_collect_sources(${subdirectory} below)
    list(APPEND sources ${below})
  endforeach()
  set(${result} ${sources} PARENT_SCOPE)
endfunction()

set(sources "")
if(WEFT_BUILD_EXAMPLES)
  weft_collect_sources(${PROJECT_SOURCE_DIR}/examples sources)
endif()
if(WEFT_BUILD_BENCHMARKS)
  weft_collect_sources(${PROJECT_SOURCE_DIR}/benchmark benchmark_sources)
  list(APPEND sources ${benchmark_sources})
endif()
if(sources)
  add_library(programs_compile OBJECT EXCLUDE_FROM_ALL ${sources})
  target_link_libraries(programs_compile PRIVATE weft::weft weft_warnings)
  find_package(Eigen3 CONFIG QUIET) # for those that solve
  if(TARGET Eigen3::Eigen)
    target_link_libraries(programs_compile PRIVATE Eigen3::Eigen)
  endif()
  target_compile_options(programs_compile PRIVATE $<$<CXX_COMPILER_ID:GNU,Clang,AppleClang>:-fsyntax-only>)
endif()
