"""Builds the tree that this recipe is part of, without Embree: conan create packaging/conan. Needs cargo."""

import os
import re
import shutil

from conan import ConanFile
from conan.tools.cmake import CMake, CMakeToolchain
from conan.tools.files import copy, load


class Azulejo(ConanFile):
    name = "azulejo"
    description = "Blue-noise sampling of planes and triangle meshes, and relaxation of point sets"
    license = "MIT OR Apache-2.0"
    topics = ("blue-noise", "poisson-disk", "sampling", "mesh")
    settings = "os", "arch", "compiler", "build_type"
    package_type = "unknown"
    # Both libraries are in the package: azulejo::azulejo is the shared one, azulejo::azulejo_static the other.
    languages = "C"

    @property
    def _root(self):
        return os.path.join(self.recipe_folder, "..", "..")

    def set_version(self):
        manifest = load(self, os.path.join(self._root, "Cargo.toml"))
        self.version = re.search(r'^version = "(.*)"', manifest, re.MULTILINE)[1]

    def export_sources(self):
        # Cargo reads the manifests of all members of the workspace.
        for folder in ("cmake", "include", "src", "ffi", "cli", "studies", "benches", "tests", "examples"):
            copy(self, "*", os.path.join(self._root, folder), os.path.join(self.export_sources_folder, folder))
        # By name: a pattern would be looked for in all of the tree, what was built there included.
        for name in ("Cargo.toml", "Cargo.lock", "CMakeLists.txt", "LICENSE-MIT", "LICENSE-APACHE", "README.md"):
            shutil.copy2(os.path.join(self._root, name), self.export_sources_folder)

    def layout(self):
        self.folders.root = "../.."
        self.folders.source = "."
        self.folders.build = os.path.join("target", "packaging", "conan")
        self.folders.generators = os.path.join(self.folders.build, "generators")

    def generate(self):
        toolchain = CMakeToolchain(self)
        toolchain.user_presets_path = False
        toolchain.cache_variables["AZULEJO_EMBREE"] = False
        toolchain.cache_variables["AZULEJO_CARGO_FLAGS"] = "--locked"
        if self.settings.build_type == "Debug":
            toolchain.cache_variables["AZULEJO_CARGO_PROFILE"] = "dev"
        toolchain.generate()

    def build(self):
        cmake = CMake(self)
        cmake.configure()
        cmake.build()

    def package(self):
        CMake(self).install()
        licences = os.path.join(self.package_folder, "licenses")
        os.makedirs(licences)
        for name in ("LICENSE-MIT", "LICENSE-APACHE"):
            shutil.copy2(os.path.join(self.source_folder, name), licences)

    def package_info(self):
        # The package has CMake's files of its own.
        self.cpp_info.set_property("cmake_find_mode", "none")
        self.cpp_info.builddirs = [os.path.join("lib", "cmake", "azulejo")]
        self.cpp_info.libs = ["azulejo"]
