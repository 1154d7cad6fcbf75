#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""check_format.py CLANG_FORMAT ROOT: names every source that `./dev format` would change; exits with 1 if there is one."""
import pathlib
import re
import subprocess
import sys


def main():
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    program, root = sys.argv[1], pathlib.Path(sys.argv[2])
    tops = ["include", "src", "kernels", "tests", "examples", "validation"]
    sources = sorted(p for top in tops for p in (root / top).rglob("*") if p.suffix in {".h", ".cpp", ".c"})
    if not sources:
        sys.exit(f"{root} has no sources")
    run = subprocess.run([program, "--dry-run", "-Werror", *map(str, sources)], capture_output=True, text=True)
    wrong = sorted(set(re.findall(r"^(.+?):\d+:\d+: error:", run.stderr, re.M)))
    for path in wrong:
        print(f"{pathlib.Path(path).relative_to(root)}: not formatted; run ./dev format")
    if run.returncode and not wrong:
        sys.exit(run.stderr)
    sys.exit(1 if wrong else 0)


if __name__ == "__main__":
    main()
