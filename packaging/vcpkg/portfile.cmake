# SPDX-License-Identifier: GPL-3.0-or-later
# An overlay port: vcpkg install weft --overlay-ports=packaging/vcpkg. Sources are the tree that the port lies in.

cmake_path(GET CMAKE_CURRENT_LIST_DIR PARENT_PATH SOURCE_PATH)
cmake_path(GET SOURCE_PATH PARENT_PATH SOURCE_PATH)

vcpkg_check_features(OUT_FEATURE_OPTIONS FEATURE_OPTIONS FEATURES tbb WEFT_WITH_TBB zlib WEFT_WITH_ZLIB)
vcpkg_cmake_configure(
  SOURCE_PATH "${SOURCE_PATH}"
  OPTIONS
    ${FEATURE_OPTIONS}
    -DWEFT_BUILD_EXAMPLES=OFF
    -DWEFT_BUILD_TESTS=OFF
    -DWEFT_BUILD_BENCHMARKS=OFF)
vcpkg_cmake_install()
vcpkg_cmake_config_fixup(PACKAGE_NAME weft CONFIG_PATH share/cmake/weft)
vcpkg_fixup_pkgconfig()

# Headers only: nothing differs in a debug build.
file(REMOVE_RECURSE "${CURRENT_PACKAGES_DIR}/debug" "${CURRENT_PACKAGES_DIR}/lib")
vcpkg_install_copyright(FILE_LIST "${SOURCE_PATH}/LICENSE")
