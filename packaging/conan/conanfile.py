# SPDX-License-Identifier: GPL-3.0-or-later
"""Conan 2 recipe: `conan create packaging/conan`. Sources are the tree that the recipe lies in."""

import os
import re

from conan import ConanFile
from conan.tools.build import check_min_cppstd
from conan.tools.cmake import CMake, CMakeDeps, CMakeToolchain
from conan.tools.files import copy, load, rmdir

required_conan_version = ">=2.0"


class WeftConan(ConanFile):
    name = "weft"
    description = "Meshes by interleaved refinement and optimisation"
    license = "GPL-3.0-or-later"
    topics = ("mesh-generation", "delaunay", "computational-geometry", "header-only")
    package_type = "header-library"
    settings = "os", "arch", "compiler", "build_type"
    # with_json: for those who include weft/IO/write_report_json_2.h or write_report_json_3.h; no other header needs it
    options = {"with_tbb": [True, False], "with_zlib": [True, False], "with_json": [True, False]}
    default_options = {"with_tbb": True, "with_zlib": True, "with_json": False}
    no_copy_source = True

    @property
    def _root(self):
        return os.path.join(self.recipe_folder, os.pardir, os.pardir)

    def set_version(self):
        text = load(self, os.path.join(self._root, "include", "weft", "version.h"))
        parts = [re.search(rf"WEFT_VERSION_{part} (\d+)", text).group(1) for part in ("MAJOR", "MINOR", "PATCH")]
        self.version = ".".join(parts)

    def export_sources(self):
        for pattern in ("CMakeLists.txt", "LICENSE", "cmake/*", "include/*"):
            copy(self, pattern, self._root, self.export_sources_folder)

    def requirements(self):
        self.requires("cgal/[>=5.5]", transitive_headers=True)
        if self.options.with_tbb:
            self.requires("onetbb/[>=2021.8]", transitive_headers=True)
        if self.options.with_zlib:
            self.requires("zlib/[>=1.2.11 <2]", transitive_headers=True)
        if self.options.with_json:
            self.requires("nlohmann_json/[>=3.11]", transitive_headers=True)

    def build_requirements(self):
        self.tool_requires("cmake/[>=3.25]")

    def validate(self):
        check_min_cppstd(self, 17)

    def package_id(self):
        self.info.settings.clear()

    def generate(self):
        CMakeDeps(self).generate()
        toolchain = CMakeToolchain(self)
        for part in ("EXAMPLES", "TESTS", "BENCHMARKS"):
            toolchain.cache_variables[f"WEFT_BUILD_{part}"] = False
        toolchain.cache_variables["WEFT_WITH_TBB"] = bool(self.options.with_tbb)
        toolchain.cache_variables["WEFT_WITH_ZLIB"] = bool(self.options.with_zlib)
        toolchain.generate()

    def build(self):
        CMake(self).configure()

    def package(self):
        CMake(self).install()
        copy(self, "LICENSE", self.source_folder, os.path.join(self.package_folder, "licenses"))
        rmdir(self, os.path.join(self.package_folder, "share"))  # Conan writes package files of its own

    def package_info(self):
        self.cpp_info.bindirs = []
        self.cpp_info.libdirs = []
        self.cpp_info.set_property("cmake_file_name", "weft")
        self.cpp_info.set_property("cmake_target_name", "weft::weft")
        self.cpp_info.set_property("pkg_config_name", "weft")
        if self.options.with_tbb:
            self.cpp_info.defines.append("WEFT_LINKED_WITH_TBB")
        if self.options.with_zlib:
            self.cpp_info.defines.append("WEFT_LINKED_WITH_ZLIB")
