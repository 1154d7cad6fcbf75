#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""install_tree.py CMAKE BUILD SOURCE BUILD_TYPE TREE: installs BUILD into a scratch prefix and moves it to TREE, where all
other tests use it. Nothing in it may name the folders it was made in."""
import pathlib
import shutil
import sys

from steps import fail, require, run

TEXTS = {".cmake", ".pc", ".h", ".py", ".pyi"}


def main():
    cmake, build, source, build_type, tree = sys.argv[1:]
    tree = pathlib.Path(tree)
    first = tree.with_name(tree.name + "_before_it_moved")
    shutil.rmtree(tree, ignore_errors=True)
    shutil.rmtree(first, ignore_errors=True)
    run(cmake, "--install", build, "--prefix", first)
    first.rename(tree)

    traces = [str(path).encode() for path in (build, source, first)]
    without_debug_information = build_type in ("Release", "MinSizeRel")
    looked_at = 0
    for path in sorted(p for p in tree.rglob("*") if p.is_file() and not p.is_symlink()):
        if path.suffix not in TEXTS and not without_debug_information:
            continue
        looked_at += 1
        content = path.read_bytes()
        for trace in traces:
            if trace in content:
                fail(f"{path.relative_to(tree)} contains {trace.decode()}: it cannot be moved to another machine")
    require(looked_at > 50, f"only {looked_at} files were installed")
    print(f"{looked_at} installed files, none of which names a folder of the build")


main()
