# SPDX-License-Identifier: GPL-3.0-or-later
# Configures, builds and runs the project in project_dir from scratch; everything it makes lies under work_dir.
# With install set, weft is first installed from its build tree to a prefix that the project is told of.

file(REMOVE_RECURSE ${work_dir})
set(prefix ${work_dir}/prefix)

function(run)
  execute_process(COMMAND ${ARGV} COMMAND_ERROR_IS_FATAL ANY)
endfunction()

if(install)
  run(${CMAKE_COMMAND} --install ${weft_binary_dir} --config ${config} --prefix ${prefix})
endif()
run(${CMAKE_COMMAND} -S ${project_dir} -B ${work_dir}/build -G ${generator}
  -D CMAKE_CXX_COMPILER=${compiler}
  -D CMAKE_BUILD_TYPE=Debug
  -D CGAL_DO_NOT_WARN_ABOUT_CMAKE_BUILD_TYPE=TRUE
  -D CMAKE_PREFIX_PATH=${prefix}
  -D CGAL_DIR=${cgal_dir}
  "-D cgal_include_dirs=${cgal_include_dirs}"
  -D pkgconfig_dir=${pkgconfig_dir}
  -D weft_source_dir=${weft_source_dir}
  -D weft_version=${weft_version})
run(${CMAKE_COMMAND} --build ${work_dir}/build --config Debug)
run(${CMAKE_CTEST_COMMAND} --test-dir ${work_dir}/build --build-config Debug --output-on-failure)
