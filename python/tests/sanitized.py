#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The module and the C API under AddressSanitizer: sanitized.py "LIBASAN LIBSTDC++" FOLDER,
the folder that holds the package.

1. The suite runs without a finding.
2. Everything is called, good calls and bad ones, and no memory of ours is left behind at the end.
3. The same with a leak made on purpose: it is found. So step 2 would have found one.
4. A write beyond an array made on purpose through the C API is found, so step 1 would have found one.

Python itself leaves memory behind when it ends, some of it allocated below our functions. Stacks of leaks are therefore cut
after one frame of the caller: what counts is who asked for the memory, not who called whom.
"""
import os
import pathlib
import subprocess
import sys

HERE = pathlib.Path(__file__).resolve().parent
SUITE = ["evaluate", "exact", "misuse", "results", "threads"]
ONLY = "not other_threads and not ctrl_c"  # minutes here, and nothing more touched

LEAK = """
import ctypes, patchproof
from patchproof import _patchproof
library = ctypes.CDLL(_patchproof.__file__)
class Text(ctypes.Structure):
    _fields_ = [("data", ctypes.c_char_p), ("length", ctypes.c_size_t)]
context = ctypes.c_void_p()
assert library.patchproof_context_create(0, ctypes.byref(context)) == 0
del context
"""
OVERFLOW = """
import ctypes, numpy, patchproof
from patchproof import _patchproof
library = ctypes.CDLL(_patchproof.__file__)
class Info(ctypes.Structure):
    _fields_ = [("size", ctypes.c_size_t), ("rest", ctypes.c_char * 8)]
context = ctypes.c_void_p()
assert library.patchproof_context_create(0, ctypes.byref(context)) == 0
libc = ctypes.CDLL(None)
libc.malloc.restype = ctypes.c_void_p
place = libc.malloc(16)  # a patchproof_error says that it is whole, and is not
ctypes.cast(place, ctypes.POINTER(ctypes.c_size_t))[0] = 80
library.patchproof_last_error(context, ctypes.c_void_p(place))
"""


def run(preloaded, folder, words, options, **more):
    environment = {**os.environ, "LD_PRELOAD": preloaded, "PYTHONPATH": str(folder), "PYTHONMALLOC": "malloc",
                   "PATCHPROOF_PACKAGE": str(folder / "patchproof"), "MPLBACKEND": "Agg",
                   "ASAN_OPTIONS": options + ":allocator_may_return_null=1:quarantine_size_mb=64", **more}
    return subprocess.run([sys.executable, "-B", *map(str, words)], env=environment, capture_output=True, text=True,
                          check=False)


def require(condition, step, done):
    print(f"{step}: {'as it should be' if condition else 'WRONG'}", flush=True)
    if not condition:
        sys.exit(f"exit {done.returncode}\n{done.stdout[-6000:]}\n{done.stderr[-12000:]}")


def main():
    preloaded, folder = sys.argv[1], pathlib.Path(sys.argv[2]).resolve()
    suite = ["-X", "faulthandler", "-m", "pytest", "-q", "-x", "-p", "no:cacheprovider", "-o", "python_files=*_test.py",
             "-k", ONLY,
             *(HERE / f"{name}_test.py" for name in SUITE)]
    done = run(preloaded, folder, suite, "detect_leaks=0")
    require(done.returncode == 0 and "AddressSanitizer" not in done.stderr, "the suite", done)

    leaks = "detect_leaks=1:malloc_context_size=2:fast_unwind_on_malloc=0"
    suppressed = {"LSAN_OPTIONS": f"suppressions={HERE / 'leaks_of_python.txt'}:print_suppressions=0"}
    done = run(preloaded, folder, [HERE / "everything.py", 3], leaks, **suppressed)
    require(done.returncode == 0 and "LeakSanitizer" not in done.stderr, "nothing of ours is left behind", done)

    done = run(preloaded, folder, ["-c", LEAK], leaks, **suppressed)
    require(done.returncode != 0 and "patchproof_context_create" in done.stderr, "a leak on purpose is found", done)
    done = run(preloaded, folder, ["-c", OVERFLOW], "detect_leaks=0")
    require(done.returncode != 0 and "heap-buffer-overflow" in done.stderr, "a write beyond an end is found", done)


if __name__ == "__main__":
    main()
