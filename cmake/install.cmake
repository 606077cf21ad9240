# SPDX-License-Identifier: GPL-3.0-or-later
# Installs the headers and the package files that find_package(weft) reads.

include(GNUInstallDirs)
include(CMakePackageConfigHelpers)
set(weft_package_dir ${CMAKE_INSTALL_DATADIR}/cmake/weft)

install(DIRECTORY include/weft TYPE INCLUDE FILES_MATCHING PATTERN "*.h")
install(FILES LICENSE TYPE DOC)

install(TARGETS weft EXPORT weftTargets INCLUDES DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
install(EXPORT weftTargets NAMESPACE weft:: DESTINATION ${weft_package_dir})

configure_package_config_file(cmake/weftConfig.cmake.in ${PROJECT_BINARY_DIR}/weftConfig.cmake
  INSTALL_DESTINATION ${weft_package_dir} NO_SET_AND_CHECK_MACRO)
# Before 1.0 a new minor version may change the interface.
write_basic_package_version_file(${PROJECT_BINARY_DIR}/weftConfigVersion.cmake
  COMPATIBILITY SameMinorVersion ARCH_INDEPENDENT)
install(FILES ${PROJECT_BINARY_DIR}/weftConfig.cmake ${PROJECT_BINARY_DIR}/weftConfigVersion.cmake
  DESTINATION ${weft_package_dir})

# ---- pkg-config, for those who build without CMake

# CGAL has no pkg-config file; its headers and Boost's are expected where the compiler looks. The prefix is told from
# where the file lies, so that an installed tree may be moved, and `cmake --install --prefix` may name another.
set(weft_pc_dir ${CMAKE_INSTALL_DATADIR}/pkgconfig)
if(IS_ABSOLUTE ${weft_pc_dir})
  set(weft_pc_prefix ${CMAKE_INSTALL_PREFIX})
else()
  file(RELATIVE_PATH weft_pc_prefix /${weft_pc_dir} /)
  string(REGEX REPLACE "/$" "" weft_pc_prefix "\${pcfiledir}/${weft_pc_prefix}")
endif()
if(IS_ABSOLUTE ${CMAKE_INSTALL_INCLUDEDIR})
  set(weft_pc_include ${CMAKE_INSTALL_INCLUDEDIR})
else()
  set(weft_pc_include "\${prefix}/${CMAKE_INSTALL_INCLUDEDIR}")
endif()
set(weft_pc_flags "")
set(weft_pc_libs "")
if(weft_uses_tbb)
  string(APPEND weft_pc_flags " -DWEFT_LINKED_WITH_TBB")
  set(weft_pc_libs " -ltbb")
endif()
if(weft_uses_zlib)
  string(APPEND weft_pc_flags " -DWEFT_LINKED_WITH_ZLIB")
  string(APPEND weft_pc_libs " -lz")
endif()
if(CMAKE_CXX_COMPILER_ID STREQUAL GNU)
  string(APPEND weft_pc_flags " -frounding-math") # as CGAL::CGAL does, for its interval arithmetic
endif()
configure_file(cmake/weft.pc.in ${PROJECT_BINARY_DIR}/weft.pc @ONLY)
install(FILES ${PROJECT_BINARY_DIR}/weft.pc DESTINATION ${weft_pc_dir})
