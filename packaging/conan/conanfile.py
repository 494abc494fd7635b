"""The C++ library as a package of Conan 2, static or shared.

    conan create packaging/conan --build=missing

Eigen is ConanCenter's, needed by the build alone; one that the system has is taken with a profile
of two lines: `[platform_requires]`, `eigen/3.4.0`. packaging/check.sh runs the second way.
"""

import re
from pathlib import Path

from conan import ConanFile
from conan.tools.build import check_min_cppstd
from conan.tools.cmake import CMake, CMakeDeps, CMakeToolchain, cmake_layout
from conan.tools.files import copy

ROOT = Path(__file__).resolve().parents[2]  # of the sources, not of what Conan exported


class Curvewise(ConanFile):
    """The recipe; its methods are steps that Conan calls by name."""

    name = "curvewise"
    license = "MIT"
    description = "Similarity of two curves: area, pcm, Fréchet, DTW, curve length"
    topics = ("curves", "frechet-distance", "dynamic-time-warping", "calibration")
    package_type = "library"
    settings = "os", "arch", "compiler", "build_type"
    options = {"shared": [True, False], "fPIC": [True, False]}
    default_options = {"shared": False, "fPIC": True}
    implements = ["auto_shared_fpic"]

    def set_version(self):
        header = ROOT / "cpp" / "include" / "curvewise" / "version.hpp"
        self.version = re.search(r'version\[\] = "(.*)"', header.read_text())[1]

    def export_sources(self):
        for pattern in ("CMakeLists.txt", "LICENSE", "cpp/*"):
            copy(self, pattern, ROOT, self.export_sources_folder)

    def layout(self):
        cmake_layout(self)

    def validate(self):
        check_min_cppstd(self, 17)

    def requirements(self):
        # Not visible: no header of the library names Eigen.
        self.requires("eigen/3.4.0", visible=False, libs=False, headers=True)

    def generate(self):
        CMakeToolchain(self).generate()
        CMakeDeps(self).generate()

    def build(self):
        cmake = CMake(self)
        cmake.configure()
        cmake.build()

    def package(self):
        copy(self, "LICENSE", self.source_folder, Path(self.package_folder) / "licenses")
        CMake(self).install()

    def package_info(self):
        # CMake finds the installed curvewise-config.cmake, as it does without Conan.
        self.cpp_info.set_property("cmake_find_mode", "none")
        self.cpp_info.builddirs = ["lib/cmake/curvewise"]
        self.cpp_info.libs = ["curvewise"]
        if self.settings.os in ("Linux", "FreeBSD"):
            self.cpp_info.system_libs = ["m", "pthread"]
        if self.options.shared:
            self.cpp_info.defines = ["CURVEWISE_SHARED"]
