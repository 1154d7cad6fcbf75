# SPDX-License-Identifier: Apache-2.0
"""One call of everything, good and bad ones. As a program: how much memory many of them leave behind.

    everything.py          prints bytes and blocks of Python's allocator, and bytes of the process, that 8 more rounds add
    everything.py ROUNDS   only makes these rounds
"""
import gc
import sys
import tracemalloc

import numpy as np

import patchproof
from conftest import EXAMPLES, random_parameters, random_patch


def fails(error, call, *arguments, **more):
    try:
        call(*arguments, **more)
    except error:
        return
    raise AssertionError("no error")


def stop(done, all):
    raise KeyError("stop")


def one_of_everything():
    data = random_patch(31, rational=True)
    model = patchproof.Model([data], [patchproof.CurveData(np.eye(3))])
    patch, curve = model.patches[0], model.curves[0]
    uv = random_parameters(patch, 300)
    patch.evaluate(uv, derivatives=2, normal=True)
    patch.evaluate(uv, out=np.empty((300, 3)))
    patch.evaluate_grid([0.1], [0.1])
    patch.evaluate_bounded(uv), patch.enclose(uv), patch.evaluate_rounded(uv), patch.error_bound()
    patch.evaluate_exact(uv[:2], order=2), curve.evaluate_exact("1/3"), curve.evaluate(0.3, derivatives=2)
    patch.points, patch.weights, patch.knots, patch.domain, repr(patch), repr(model), patch.name
    pieces = patch.insert_knots("u", ["1/7"]).patches[0].elevate("v").patches[0].extract_bezier()
    report = patchproof.certify(pieces, require="G1", progress=lambda done, all: None)
    report.joins, report.summary, report.to_json(), report.table(), repr(report.joins)
    mesh = patchproof.tessellate(model, 5.0)
    mesh.vertices, mesh.triangles, mesh.patches, mesh.to_bytes("stl")
    patchproof.read_text(model.to_json(), "x.json").to_g2()
    patchproof.fill(EXAMPLES / "meshes" / "two_faces.json")[0].patches
    fails(patchproof.Error, patch.evaluate, uv + 100)
    fails(TypeError, patch.evaluate, uv.astype("f4"))
    fails(TypeError, patch.evaluate, uv[::-1])
    fails(ValueError, patch.evaluate, uv, side="up")
    fails(ValueError, patch.evaluate, uv, out=patchproof.Derivatives(du=np.empty((300, 3)), point=None, dv=None), derivatives=1)
    fails(patchproof.Error, patch.evaluate_exact, ("1/0", 0))
    fails(TypeError, patch.evaluate_exact, (None, 0))
    fails(patchproof.Error, patchproof.read_text, "{", "x.json")
    fails(patchproof.Error, patchproof.read, "missing.json")
    fails(patchproof.Error, patchproof.fill, "missing.json")
    fails(TypeError, patchproof.Model, [3])
    fails(TypeError, bool, report)
    fails(KeyError, patchproof.certify, pieces, progress=stop)
    fails(KeyError, patchproof.tessellate, pieces, 0.1, progress=stop)


def settle():
    """Collects garbage, and what the interpreter's cache of attributes keeps of names."""
    sys._clear_type_cache()
    gc.collect()


def resident():
    with open("/proc/self/statm", encoding="ascii") as statm:
        return int(statm.read().split()[1]) * 4096


def measure():
    tracemalloc.start()
    memory = resident()
    for window in range(3):  # what is kept once and for all is there after two of them
        traced, blocks = tracemalloc.get_traced_memory()[0], sys.getallocatedblocks()
        for _ in range(8):
            one_of_everything()
        settle()
        traced, blocks = tracemalloc.get_traced_memory()[0] - traced, sys.getallocatedblocks() - blocks
        memory = resident() if window == 0 else memory
    print(traced, blocks, resident() - memory)


if __name__ == "__main__":
    if len(sys.argv) == 1:
        measure()
    for _ in range(int(sys.argv[1]) if len(sys.argv) > 1 else 0):
        one_of_everything()
