#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The rules of the house that a compiler cannot see. Prints one line per violation and exits with 1 if there is any.

    check_house.py ROOT         checks a source tree
    check_house.py --self-test  checks that each rule finds its violation in a tree made for it, and nothing in a clean one

Rules: direction (who may include whom), test (one per public header), literal (no float literals, no epsilon in
templates), length (400 lines), library (where GMP, MPFR, Boost, CGAL, OCCT and the kernels may appear), header (licence
line, #pragma once), path (no paths of one machine).
"""
import pathlib
import re
import sys
import tempfile

MAX_LINES = 400
LONGER = {"include/patchproof/c_api.h": 600}  # one header for whoever binds to it; docs/decisions.md

# room: the rooms it may include, besides itself
BELOW_IO = ["base", "scalar", "spline", "patch", "join", "mesh"]
MAY_INCLUDE = {
    "base": [],
    "scalar": ["base"],
    "spline": ["base", "scalar"],
    "patch": ["base", "scalar", "spline"],
    "join": ["base", "scalar", "spline", "patch"],
    "mesh": ["base", "scalar", "spline", "patch", "join"],
    "io": BELOW_IO,
    "c_api": BELOW_IO + ["io"],
    "cli": BELOW_IO + ["io", "c_api"],
}
ROOM_OF_ROOT_FILE = {"error": "base", "contract": "base", "deadline": "base", "parallel": "base", "vec": "base", "instruction_set": "base", "c_api": "c_api"}
TEMPLATE_ROOMS = ["spline", "patch", "join"]
SCANNED = ["include", "src", "kernels", "python", "tests", "examples", "validation", "cmake", "docs", ".ci"]
SOURCE = {".h", ".hpp", ".cpp", ".c", ".py", ".cmake"}

INCLUDE = re.compile(r'^[ \t]*#[ \t]*include[ \t]*([<"])([^>"]+)[>"]', re.M)
NUMBER_LIBRARY = re.compile(r"^(gmp(xx)?\.h|mpfr\.h|mpfi\w*\.h|boost/.*|CGAL/.*)$")
OCCT = re.compile(r"\.hxx$")
OCCT_PLACES = {("src", "io"), ("tests", "io"), ("validation", "peers"), ("validation", "bench"),
               ("validation", "verdicts"), ("validation", "shell"), ("validation", "tessellation"),
               ("examples", "cad")}
FLOAT = re.compile(r"(?<![\w.])(?:\d[\d']*\.\d*(?:[eE][+-]?\d+)?|\.\d+(?:[eE][+-]?\d+)?|\d+[eE][+-]?\d+"
                   r"|0[xX][\da-fA-F.]+[pP][+-]?\d+)[fFlL]?(?!\w)")
EPSILON = re.compile(r"\b\w*(?:epsilon|EPSILON)\w*|\b(?:eps|EPS|kEps)\b")
MACHINE_PATH = re.compile(r"(?<![\w.])/(?:work|home|root|Users)/\w")
SHARED = re.compile(r"\.\./shared")
COMMENT_OR_TEXT = re.compile(r'//[^\n]*|/\*.*?\*/|"(?:\\.|[^"\\\n])*"|\'(?:\\.|[^\'\\\n])\'', re.S)


def without_comments_and_texts(code):
    return COMMENT_OR_TEXT.sub(lambda m: "\n" * m.group().count("\n") or " ", code)


def line_of(text, position):
    return text.count("\n", 0, position) + 1


def room_of(path):
    """The room of a file below include/patchproof or src, given as its parts below there."""
    return path[0] if len(path) > 1 else ROOM_OF_ROOT_FILE.get(pathlib.PurePath(path[0]).stem, "unknown")


def included_room(own_room, name):
    """The room of an included file of ours; None for anybody else's."""
    parts = pathlib.PurePath(name).parts
    if parts[0] == "patchproof":
        return room_of(parts[1:])
    if len(parts) > 1 and parts[0] in MAY_INCLUDE:
        return parts[0]  # a private header of src/
    return own_room if len(parts) == 1 and name.endswith(".h") else None


class House:
    def __init__(self, root):
        self.root = pathlib.Path(root)
        self.violations = []
        self.files = sorted(p for top in SCANNED for p in (self.root / top).rglob("*")
                            if p.is_file() and "__pycache__" not in p.parts)
        self.files += sorted(p for p in self.root.glob("*") if p.is_file())

    def report(self, rule, path, line, message):
        self.violations.append((rule, f"{path.relative_to(self.root)}:{line}: {message} ({rule})"))

    def check(self):
        for path in self.files:
            if path.stat().st_size > 1 << 20:
                continue  # data
            text = path.read_text(encoding="utf-8", errors="replace")
            parts = path.relative_to(self.root).parts
            self.check_paths(path, parts, text)
            if path.suffix in SOURCE or path.name == "CMakeLists.txt":
                self.check_form(path, text)
            if path.suffix in {".h", ".cpp"}:
                self.check_includes(path, parts, text)
                self.check_literals(path, parts, text)
        self.check_tests()
        return self.violations

    def check_paths(self, path, parts, text):
        for match in MACHINE_PATH.finditer(text):
            self.report("path", path, line_of(text, match.start()), "a path of one machine")
        if parts[0] != "tests":
            for match in SHARED.finditer(text):
                self.report("path", path, line_of(text, match.start()), "a path outside the repository")

    def check_form(self, path, text):
        lines = text.splitlines()
        most = LONGER.get(path.relative_to(self.root).as_posix(), MAX_LINES)
        if len(lines) > most:
            self.report("length", path, most + 1, f"{len(lines)} lines; at most {most}")
        if path.suffix in {".h", ".hpp", ".cpp", ".c", ".py"}:
            first = [line for line in lines[:2] if not line.startswith("#!")][:1]
            if not first or first[0].strip("/*# ") != "SPDX-License-Identifier: Apache-2.0":
                self.report("header", path, 1, "the licence line is missing")
        if path.suffix in {".h", ".hpp"} and "\n#pragma once\n" not in text:
            self.report("header", path, 1, "#pragma once is missing")

    def check_includes(self, path, parts, text):
        below = parts[2:] if parts[:2] == ("include", "patchproof") else parts[1:] if parts[0] == "src" else None
        room = room_of(below) if below else None
        if room is not None and room not in MAY_INCLUDE:
            self.report("direction", path, 1, f"no room of the house: {room}")
            return
        for match in INCLUDE.finditer(text):
            name, line = match.group(2), line_of(text, match.start())
            target = included_room(room, name) if room and match.group(1) == '"' else None
            if target is not None and target != room and target not in MAY_INCLUDE[room]:
                self.report("direction", path, line, f"{room} must not include {name}")
            if NUMBER_LIBRARY.match(name) and room != "scalar" and parts[0] != "src" and parts[:2] != ("tests", "scalar"):
                self.report("library", path, line, f"{name} belongs to scalar/ and src/ only")
            if OCCT.search(name) and parts[:2] not in OCCT_PLACES:
                self.report("library", path, line, f"{name} belongs to src/io/, its tests, the peers, the verdicts and "
                                                   "examples/cad/")
            if name.startswith("kernels/") and parts[0] == "src" and path.name not in ("evaluate_batch.cpp",
                                                                                      "gregory_batch.cpp"):
                self.report("library", path, line, "only evaluate_batch.cpp and gregory_batch.cpp call the kernels")

    def check_literals(self, path, parts, text):
        if parts[:2] != ("include", "patchproof") or len(parts) < 4 or parts[2] not in TEMPLATE_ROOMS:
            return
        code = without_comments_and_texts(text)
        if "template <" not in code and "template<" not in code:
            return
        for pattern, what in ((FLOAT, "float literal"), (EPSILON, "epsilon")):
            for match in pattern.finditer(code):
                self.report("literal", path, line_of(code, match.start()), f"{what} {match.group()} in a template header")

    def check_tests(self):
        public = self.root / "include" / "patchproof"
        for header in sorted(public.glob("*/*.h")):
            room = header.parent.name
            test = self.root / "tests" / room / f"{header.stem}_test.cpp"
            if not test.is_file():
                self.report("test", header, 1, f"tests/{room}/{header.stem}_test.cpp is missing")
                continue
            own = f'"patchproof/{room}/{header.name}"'
            if own not in test.read_text(encoding="utf-8", errors="replace"):
                self.report("test", test, 1, f"does not include {own}")


# ---- the self-test --------------------------------------------------------------------------------------------------

LICENCE = "// SPDX-License-Identifier: Apache-2.0\n"
HEADER = LICENCE + "#pragma once\n"


def clean_tree():
    return {
        "include/patchproof/vec.h": HEADER,
        "include/patchproof/scalar/number.h": HEADER + "#include <gmp.h>\nconstexpr double kHalf = 0.5;\n",
        "include/patchproof/spline/line.h": HEADER + '#include "patchproof/scalar/number.h"\n// 0.5 and epsilon\n'
                                            'template <class T> T f() { return T(1) / T(2'  "'000); }\n",
        "tests/scalar/number_test.cpp": LICENCE + '#include "patchproof/scalar/number.h"\n',
        "tests/spline/line_test.cpp": LICENCE + '#include "patchproof/spline/line.h"\nconst char* data = "../shared/x";\n',
        "src/join/prove.cpp": LICENCE + '#include "patchproof/spline/line.h"\n#include <CGAL/x.h>\n#include "walk.h"\n',
        "src/join/walk.h": HEADER,
        "src/cli/main.cpp": LICENCE + '#include "join/walk.h"\n',
        "README.md": "See https://example.org/work/x.\n",
    }


def violations_of(tree):
    with tempfile.TemporaryDirectory() as root:
        for name, text in tree.items():
            path = pathlib.Path(root) / name
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(text, encoding="utf-8")
        return House(root).check()


def self_test():
    line, prove = "include/patchproof/spline/line.h", "src/join/prove.cpp"
    breaches = [  # rule, file, text added at its end (None: the file is removed)
        ("direction", line, '#include "patchproof/patch/square.h"\n'),
        ("direction", "include/patchproof/vec.h", '#include "patchproof/scalar/number.h"\n'),
        ("direction", prove, '#include "patchproof/io/read.h"\n'),
        ("direction", prove, '#include "mesh/fill.h"\n'),
        ("direction", prove, '#include "patchproof/c_api.h"\n'),
        ("direction", "src/utils/junk.cpp", LICENCE),
        ("test", "tests/spline/line_test.cpp", None),
        ("literal", line, "template <class T> T g() { return T(0.5); }\n"),
        ("literal", line, "template <class T> T g() { return 1e-9; }\n"),
        ("literal", line, "template <class T> T g() { return 1.f; }\n"),
        ("literal", line, "template <class T> T g() { return 0x1p-3; }\n"),
        ("literal", line, "auto e = std::numeric_limits<double>::epsilon();\n"),
        ("length", prove, "\n" * MAX_LINES),
        ("length", "CMakeLists.txt", "\n" * (MAX_LINES + 1)),
        ("library", line, "#include <mpfr.h>\n"),
        ("library", line, "#include <boost/multiprecision/gmp.hpp>\n"),
        ("library", "tests/spline/line_test.cpp", "#include <CGAL/Gmpq.h>\n"),
        ("library", prove, "#include <Geom_BSplineSurface.hxx>\n"),
        ("library", prove, '#include "kernels/dispatch.h"\n'),
        ("header", "src/join/free.h", LICENCE),
        ("header", "src/join/free.cpp", "int x;\n"),
        ("header", "tests/house/free.py", "#!/usr/bin/env python3\nx = 1\n"),
        ("path", "README.md", "cd /" + "work/main\n"),
        ("path", "src/join/walk.h", "// /" + "home/me/data\n"),
        ("path", "docs/formats.md", "see .." + "/shared/data\n"),
    ]
    failures = [f"the clean tree: {text}" for _, text in violations_of(clean_tree())]
    for rule, name, added in breaches:
        tree = clean_tree()
        if added is None:
            del tree[name]
        else:
            tree[name] = tree.get(name, "") + added
        found = violations_of(tree)
        if [r for r, _ in found] != [rule]:
            failures.append(f"{rule}: {name} + {added!r}: expected one violation, found {found}")
    tree = clean_tree()
    tree["tests/spline/line_test.cpp"] = LICENCE  # tests something else
    if [r for r, _ in violations_of(tree)] != ["test"]:
        failures.append("a test that does not include its header was not reported")
    return failures


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    if sys.argv[1] == "--self-test":
        problems = self_test()
    else:
        if not (pathlib.Path(sys.argv[1]) / "include" / "patchproof").is_dir():
            sys.exit(f"{sys.argv[1]} is not the source tree")
        problems = [text for _, text in House(sys.argv[1]).check()]
    print("\n".join(problems) if problems else "the house is in order")
    sys.exit(1 if problems else 0)


if __name__ == "__main__":
    main()
