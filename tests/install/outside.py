#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""outside.py KIND TREE LIBDIR SOURCES WORK CMAKE CC CXX BUILD_TYPE FLAGS: builds and runs a program outside the project
against the installed TREE, as KIND says:

    cmake_c, cmake_c_static, cmake_cxx    find_package(patchproof COMPONENTS …)
    cmake_refusals                        requests that find_package must refuse, or accept, and what it says
    pkgconfig_shared, pkgconfig_static, pkgconfig_cxx
"""
import os
import pathlib
import shutil
import sys

from steps import environment, needed, require, run

# Packages that only C++ users need: programs in C are configured as on a machine that has none of them.
CXX_PACKAGES = ["CGAL", "TBB", "pugixml", "fmt", "nlohmann_json", "Boost", "MPFR", "GMP"]


class Outside:
    def __init__(self, tree, libdir, sources, work, cmake, cc, cxx, build_type, flags):
        self.tree, self.sources, self.work = pathlib.Path(tree), pathlib.Path(sources), pathlib.Path(work)
        self.libdir = self.tree / libdir
        self.cmake, self.cc, self.cxx, self.build_type, self.flags = cmake, cc, cxx, build_type, flags
        shutil.rmtree(self.work, ignore_errors=True)
        self.work.mkdir(parents=True)

    # ---- CMake

    def configure(self, project, *definitions, expect=0):
        return run(self.cmake, "-S", project, "-B", self.work / "build", f"-DCMAKE_PREFIX_PATH={self.tree}",
                   f"-DCMAKE_BUILD_TYPE={self.build_type}", f"-DCMAKE_C_COMPILER={self.cc}",
                   f"-DCMAKE_CXX_COMPILER={self.cxx}", f"-DCMAKE_C_FLAGS={self.flags}",
                   f"-DCMAKE_CXX_FLAGS={self.flags}", "--no-warn-unused-cli", *definitions, expect=expect,
                   env=environment())

    def cmake_program(self, project, *definitions):
        self.configure(project, *definitions)
        found = [line for line in (self.work / "build" / "CMakeCache.txt").read_text().splitlines()
                 if line.startswith("patchproof_DIR:")]
        require(len(found) == 1 and found[0].endswith(f"={self.libdir}/cmake/patchproof"),
                f"another patchproof was found: {found}")
        run(self.cmake, "--build", self.work / "build", env=environment())
        return self.work / "build" / "outside"

    def without_cxx_packages(self):
        return [f"-DCMAKE_DISABLE_FIND_PACKAGE_{name}=ON" for name in CXX_PACKAGES]

    def cmake_c(self):
        program = self.cmake_program(self.sources / "c", "-DCOMPONENT=c", *self.without_cxx_packages())
        self.run_c(program, shared=True)

    def cmake_c_static(self):
        program = self.cmake_program(self.sources / "c", "-DCOMPONENT=c_static", *self.without_cxx_packages())
        self.run_c(program, shared=False)

    def cmake_cxx(self):
        self.run_cxx(self.cmake_program(self.sources / "cxx"))

    def cmake_refusals(self):
        project = self.work / "project"
        project.mkdir()

        def find(words, language, *definitions, expect):
            shutil.rmtree(self.work / "build", ignore_errors=True)
            (project / "CMakeLists.txt").write_text(
                f"cmake_minimum_required(VERSION 3.25)\nproject(p LANGUAGES {language})\nfind_package(patchproof {words})\n"
                "foreach(name c c_static patchproof exact)\n  if(TARGET patchproof::${name})\n"
                '    message(STATUS "has ${name};")\n  endif()\nendforeach()\n'
                'message(STATUS "found ${patchproof_FOUND};")\n')
            output = self.configure(project, *definitions, expect=expect)
            return " ".join(output.split())  # as CMake wraps its messages

        without_cgal = "-DCMAKE_DISABLE_FIND_PACKAGE_CGAL=ON"
        cases = [
            ("REQUIRED", "C", [without_cgal], 0, ["has c;", "has c_static;"], ["has exact;"]),
            ("REQUIRED", "CXX", [], 0, ["has c;", "has c_static;", "has patchproof;", "has exact;"], []),
            ("REQUIRED COMPONENTS cxx", "CXX", [without_cgal], 1, ["CGAL", "component cxx"], []),
            ("REQUIRED COMPONENTS c OPTIONAL_COMPONENTS cxx", "CXX", [without_cgal], 0, ["has c;"], ["has exact;"]),
            ("COMPONENTS cxx", "CXX", [without_cgal], 0, ["found 0;"], ["has exact;"]),
            ("REQUIRED COMPONENTS rust", "C", [], 1, ["rust"], []),
            ("9.0 REQUIRED", "C", [], 1, ["9.0"], []),
        ]
        for words, language, definitions, expect, said, unsaid in cases:
            output = find(words, language, *definitions, expect=expect)
            for text in said:
                require(text in output, f"find_package(patchproof {words}) in {language} does not say '{text}':\n{output}")
            for text in unsaid:
                require(text not in output, f"find_package(patchproof {words}) in {language} says '{text}':\n{output}")
        print(f"{len(cases)} requests answered")

    # ---- pkg-config

    def pkg_config(self, *words, libdir=None):
        folder = (libdir or self.libdir) / "pkgconfig"
        return run("pkg-config", *words, env=environment(PKG_CONFIG_PATH=str(folder))).split()

    def compile(self, compiler, source, flags):
        program = self.work / "outside"
        run(compiler, *self.flags.split(), source, "-o", program, *flags, env=environment())
        return program

    def c_flags(self):
        return ["-std=c99", "-Wall", "-Wextra", "-pedantic", "-Werror"]

    def pkgconfig_shared(self):
        said = self.pkg_config("--cflags", "--libs", "patchproof")
        require(not [word for word in said if word.startswith("-l") and word != "-lpatchproof"],
                f"a C program needs no other library: {said}")
        program = self.compile(self.cc, self.sources / "c" / "main.c", self.c_flags() + said)
        self.run_c(program, shared=True)

    def pkgconfig_static(self):
        program = self.compile(self.cc, self.sources / "c" / "main.c",
                               self.c_flags() + self.pkg_config("--cflags", "--libs", "patchproof-static"))
        self.run_c(program, shared=False)

        # patchproof.pc with --static, where no shared library stands in the way
        only_static = self.work / "only_static"
        shutil.copytree(self.tree, only_static, symlinks=True, copy_function=os.link,
                        ignore=shutil.ignore_patterns("*.so", "*.so.*", "bin", "python3"))
        libdir = only_static / self.libdir.relative_to(self.tree)
        program = self.compile(self.cc, self.sources / "c" / "main.c", self.c_flags() + self.pkg_config(
            "--static", "--cflags", "--libs", "patchproof", libdir=libdir))
        self.run_c(program, shared=False)

    def pkgconfig_cxx(self):
        said = self.pkg_config("--cflags", "--libs", "patchproof-cxx")
        for flag in ("-std=c++20", "-ffp-contract=off", "-frounding-math"):
            require(flag in said, f"{flag} is missing in {said}")
        self.run_cxx(self.compile(self.cxx, self.sources / "cxx" / "main.cpp", ["-O1", "-Wall"] + said))

    # ---- what the programs must say

    def run_c(self, program, shared):
        ours = [name for name in needed(program) if "patchproof" in name]
        if shared:
            require(len(ours) == 1 and ours[0].startswith("libpatchproof.so."), f"the program needs {ours}")
            resolved = run("ldd", program, env=environment(LD_LIBRARY_PATH=str(self.libdir)))
            require(f"{self.libdir}/{ours[0]}" in resolved, f"another library than the installed one:\n{resolved}")
        else:
            require(ours == [], f"a program linked statically needs {ours}")
        variables = {"LD_LIBRARY_PATH": str(self.libdir)} if shared else {}
        output = run(program, env=environment(**variables))
        require("C0 0, G1 1, angle in [" in output and "refused: " in output, f"the program says\n{output}")
        print(output, end="")

    def run_cxx(self, program):
        output = run(program, "1/3", "0.1", env=environment())
        require(output == "13/30\n", f"the program says '{output}'")
        print(f"1/3 + 0.1 = {output}", end="")


def main():
    kind, *rest = sys.argv[1:]
    getattr(Outside(*rest), kind)()


main()
