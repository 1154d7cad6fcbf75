#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""What a batch call costs from C++, from C and from Python, in one process and by turns: call_times.py LIBRARY [ROUNDS]

LIBRARY is batch_calls.cpp as a shared library. A million scattered parameters, one thread. Every round times each of the calls
once, in changing order; printed are the nanoseconds per parameter of the fastest C++ call, and the median over the rounds of
each call's time divided by that of the C++ call of the same round.
"""
import ctypes
import random
import statistics
import sys
import time

import numpy as np

import patchproof

COUNT = 10**6
DOUBLES, SIZE = ctypes.c_void_p, ctypes.c_size_t


def library_of(path):
    library = ctypes.CDLL(path)
    library.batch_surface.restype = ctypes.c_void_p
    library.batch_surface.argtypes = [ctypes.c_int32] * 2 + [DOUBLES, SIZE] * 4
    for name in ("cpp_seconds", "c_seconds"):
        getattr(library, name).restype = ctypes.c_double
        getattr(library, name).argtypes = [ctypes.c_void_p, DOUBLES, DOUBLES, SIZE, ctypes.c_ssize_t] + [DOUBLES] * 3
    library.cpp_seconds_with_new_arrays.restype = ctypes.c_double
    library.cpp_seconds_with_new_arrays.argtypes = [ctypes.c_void_p, DOUBLES, DOUBLES, SIZE, ctypes.c_ssize_t, ctypes.c_int32]
    return library


def surfaces():
    """name, data: as validation/bench has them."""
    numbers = np.random.default_rng(1)
    knots = np.concatenate([np.zeros(3), np.linspace(0, 1, 18), np.ones(3)])
    points = numbers.normal(size=(20, 20, 3))
    yield "bicubic Bézier", patchproof.PatchData(numbers.normal(size=(4, 4, 3)))
    yield "B-spline 20×20", patchproof.PatchData(points, None, (3, 3), (knots, knots))
    yield "NURBS 20×20", patchproof.PatchData(points, numbers.uniform(0.5, 2, (20, 20)), (3, 3), (knots, knots))


def in_cpp(library, patch):
    """The same surface for C++ and C."""
    arrays = [*patch.knots, patch.points.reshape(-1)] + ([patch.weights.reshape(-1)] if patch.weights is not None else [])
    given = [x for a in arrays for x in (a.ctypes.data, a.size)] + ([] if len(arrays) == 4 else [None, 0])
    made = library.batch_surface(*patch.degree, *given)
    if not made:
        sys.exit("the C++ library refuses the surface")
    return made


def timed(call):
    start = time.perf_counter()
    call()
    return time.perf_counter() - start


def calls_of(library, surface, patch, uv, derivatives, outs):
    """{name: a function that returns seconds}."""
    pair = isinstance(uv, tuple)
    u, v, stride = (uv[0].ctypes.data, uv[1].ctypes.data, 1) if pair else (uv.ctypes.data, uv.ctypes.data + 8, 2)
    place = [a.ctypes.data for a in outs] if derivatives else [outs[0].ctypes.data, None, None]
    out = patchproof.Derivatives(*outs) if derivatives else outs[0]
    return {
        "C++": lambda: library.cpp_seconds(surface, u, v, COUNT, stride, *place),
        "C": lambda: library.c_seconds(surface, u, v, COUNT, stride, *place),
        "Python, out=": lambda: timed(lambda: patch.evaluate(uv, derivatives, out=out)),
        "C++, new arrays": lambda: library.cpp_seconds_with_new_arrays(surface, u, v, COUNT, stride, derivatives),
        "Python, new arrays": lambda: timed(lambda: patch.evaluate(uv, derivatives)),
    }


def main():
    if len(sys.argv) not in (2, 3):
        sys.exit(__doc__)
    library, rounds = library_of(sys.argv[1]), int(sys.argv[2]) if len(sys.argv) == 3 else 41
    uv = np.random.default_rng(2).random((COUNT, 2))
    layouts = {"pairs (n, 2)": uv, "two arrays": (uv[:, 0].copy(), uv[:, 1].copy())}
    outs = [np.zeros((COUNT, 3)) for _ in range(3)]
    print("| 10⁶ parameters, one thread | | C++, ns | C / C++ | Python out= / C++ | C++ new arrays / C++ "
          "| Python new arrays / C++ | Python / C++, both new |\n|---|---|---|---|---|---|---|---|")
    worst = {"C": [], "Python, out=": []}
    for name, data in surfaces():
        patch = patchproof.Model([data]).patches[0]
        surface = in_cpp(library, patch)
        for derivatives in (0, 1):
            for layout, parameters in layouts.items():
                calls = calls_of(library, surface, patch, parameters, derivatives, outs)
                results = {}
                for call in ("C++", "C", "Python, out="):  # the same bits come from each
                    for array in outs:
                        array.fill(np.nan)
                    calls[call]()
                    results[call] = [array.copy() for array in outs]
                    assert all(np.array_equal(a, b, equal_nan=True) for a, b in zip(results[call], results["C++"])), call
                times = {call: [] for call in calls}
                order = list(calls)
                for _ in range(rounds):
                    random.shuffle(order)
                    for call in order:
                        times[call].append(calls[call]())
                assert min(map(min, times.values())) > 0, "a call failed"

                def ratio(call, to="C++"):
                    return statistics.median(a / b for a, b in zip(times[call], times[to]))

                c, python = ratio("C"), ratio("Python, out=")
                for call, all_of_it in worst.items():
                    all_of_it.append((ratio(call), min(times[call]) / min(times["C++"])))
                print(f"| {name}, {'first derivatives' if derivatives else 'points'} | {layout} "
                      f"| {min(times['C++']) / COUNT * 1e9:.2f} | {c:.3f} | {python:.3f} | {ratio('C++, new arrays'):.3f} "
                      f"| {ratio('Python, new arrays'):.3f} | {ratio('Python, new arrays', 'C++, new arrays'):.3f} |",
                      flush=True)
    for call, asked in (("C", 1.05), ("Python, out=", 1.2)):
        median, fastest = map(max, zip(*worst[call]))
        print(f"\n{call}: at most {median:.3f} by medians, {fastest:.3f} by the fastest rounds (asked for: {asked})", end="")
    print()


if __name__ == "__main__":
    main()
