#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""shared_library.py TREE LIBDIR VERSION CC CXX: the installed libpatchproof.so shows what c_api.h declares and nothing else,
and its header is one for C and C++ alike. With --self-test in place of it all: the parser of the header."""
import pathlib
import re
import sys
import tempfile

from steps import dynamic_section, environment, fail, require, run

COMMENT = re.compile(r"/\*.*?\*/|//[^\n]*", re.S)
# A prototype: a type, the name, an open parenthesis; function pointers in structs have no such name.
PROTOTYPE = re.compile(r"^[ \t]*((?:PATCHPROOF_API[ \t]+)?)[\w \t\*]*?\b(patchproof_\w+)[ \t]*\(", re.M)


def declared(header):
    """Names of the functions in the text of c_api.h, and of those without PATCHPROOF_API."""
    code = COMMENT.sub(" ", header)
    found = [(match.group(2), bool(match.group(1))) for match in PROTOTYPE.finditer(code)]
    return [name for name, _ in found], [name for name, marked in found if not marked]


def exported(words, *options):
    symbols = {}
    for line in run("nm", *words, *options, env=environment()).splitlines():
        match = re.fullmatch(r"[0-9a-f]* ?([A-Za-z]) (\S+)", line.strip())
        if match:
            symbols[match.group(2)] = match.group(1)
    return symbols


def difference(what, found, expected):
    if sorted(found) != sorted(expected):
        fail(f"{what}: not declared in c_api.h {sorted(set(found) - set(expected))}, "
             f"missing {sorted(set(expected) - set(found))}")


def check_symbols(library, abi, names):
    symbols = exported(["-D", "--defined-only", "--with-symbol-versions"], library)
    require(symbols.pop(f"PATCHPROOF_{abi}", None) == "A", f"there is no version PATCHPROOF_{abi}")
    difference("exported symbols", [name.split("@")[0] for name in symbols], names)
    for name, kind in symbols.items():
        require(kind == "T", f"{name} is no function but of kind {kind}")
        require(name.endswith(f"@@PATCHPROOF_{abi}"), f"{name} has another version than PATCHPROOF_{abi}")


def check_file(libdir, abi, version):
    library = libdir / f"libpatchproof.so.{version}"
    require(library.is_file() and not library.is_symlink(), f"{library} is missing")
    for link in (f"libpatchproof.so.{abi}", "libpatchproof.so"):
        require((libdir / link).is_symlink() and (libdir / link).resolve() == library.resolve(), f"{link} is no link to it")
    section = dynamic_section(library)
    require([value for tag, value in section if tag == "SONAME"] == [f"libpatchproof.so.{abi}"], f"SONAME: {section}")
    tags = {tag for tag, _ in section}
    for unwanted in ("RPATH", "RUNPATH", "TEXTREL"):
        require(unwanted not in tags, f"the library has {unwanted}")
    libraries = [value for tag, value in section if tag == "NEEDED"]
    for name in libraries:
        require(not name.startswith("libTK"), f"the library needs {name}, a part of Open CASCADE")
        require("patchproof" not in name, f"the library needs {name}")
    stack = [line for line in run("readelf", "-lW", library, env=environment()).splitlines() if "GNU_STACK" in line]
    require(len(stack) == 1 and "RWE" not in stack[0], f"the stack is executable: {stack}")
    undefined = run("ldd", "-r", library, env=environment())
    require("undefined symbol" not in undefined and "not found" not in undefined, undefined)
    return library, libraries


def check_header(include, cc, cxx):
    with tempfile.TemporaryDirectory() as folder:
        strict = ["-Wall", "-Wextra", "-pedantic", "-Werror", "-c", "-o", f"{folder}/alone.o", f"-I{include}"]
        for compiler, suffix, standards in ((cc, "c", ("c99", "c11", "c17")), (cxx, "cpp", ("c++11", "c++20"))):
            source = pathlib.Path(folder) / f"alone.{suffix}"
            source.write_text("#include <patchproof/c_api.h>\n#include <patchproof/c_api.h>\n")
            for standard in standards:
                run(compiler, f"-std={standard}", *strict, source, env=environment())


def check_cxx_headers(include, cxx):
    """All public headers are there, with all that they include, and no header of CGAL among these is under the GPL."""
    headers = sorted(path.relative_to(include) for path in (include / "patchproof").rglob("*.h"))
    require(len(headers) > 100, f"only {len(headers)} headers are installed")
    with tempfile.TemporaryDirectory() as folder:
        source = pathlib.Path(folder) / "all.cpp"
        source.write_text("".join(f"#include <{header}>\n" for header in headers))
        used = run(cxx, "-std=c++20", "-frounding-math", "-M", f"-I{include}", source, env=environment()).split()
    cgal = [path for path in used if "/CGAL/" in path]
    require(len(cgal) > 10, "CGAL's headers were not found among the included ones")
    for path in cgal:
        licence = re.search(r"SPDX-License-Identifier:\s*(\S+)", pathlib.Path(path).read_text(errors="replace")[:4000])
        require(licence is not None and not licence.group(1).startswith("GPL"), f"{path} is under the GPL")
    return len(headers), len(cgal)


def check_no_triangulations(libdir):
    """CGAL's triangulations are under the GPL: no code of them is in the static libraries, nor in what is made of these."""
    for name in ("libpatchproof.a", "libpatchproof_exact.a", "libpatchproof_kernels.a"):
        of_cgal = [symbol for symbol in exported([], libdir / name) if "4CGAL" in symbol]
        bad = [symbol for symbol in of_cgal if "riangulation" in symbol or "Delaunay" in symbol]
        require(bad == [], f"{name} contains {bad[:1]}")


def self_test():
    names, unmarked = declared("/* patchproof_no(void) */\nPATCHPROOF_API uint32_t patchproof_a(void) X;\n"
                               "PATCHPROOF_API patchproof_status patchproof_b(\n    const char* x) X;\n"
                               "typedef struct { int32_t (*progress)(void* user); } patchproof_callback;\n"
                               "const char* patchproof_c(const patchproof_model* m);  // patchproof_d(\n")
    require(names == ["patchproof_a", "patchproof_b", "patchproof_c"], f"declared: {names}")
    require(unmarked == ["patchproof_c"], f"without PATCHPROOF_API: {unmarked}")
    print("the parser of the header is in order")


def main():
    if sys.argv[1:] == ["--self-test"]:
        return self_test()
    tree, libdir, version, cc, cxx = sys.argv[1:]
    tree, include = pathlib.Path(tree), pathlib.Path(tree) / "include"
    header = (include / "patchproof" / "c_api.h").read_text(encoding="utf-8")
    abi = re.search(r"#define PATCHPROOF_ABI_VERSION (\d+)u", header).group(1)
    names, unmarked = declared(header)
    require(len(names) > 40, f"only {len(names)} functions were found in c_api.h")
    require(unmarked == [], f"without PATCHPROOF_API: {unmarked}")

    library, libraries = check_file(tree / libdir, abi, version)
    check_symbols(library, abi, names)
    archive = exported(["-g", "--defined-only"], tree / libdir / "libpatchproof.a")
    difference("functions of libpatchproof.a", [name for name in archive if name.startswith("patchproof_")], names)
    check_header(include, cc, cxx)
    check_no_triangulations(tree / libdir)
    headers, cgal = check_cxx_headers(include, cxx)
    print(f"{len(names)} functions, version PATCHPROOF_{abi}, needing {' '.join(libraries)}; "
          f"{headers} headers over {cgal} of CGAL, none of these under the GPL")


main()
