# SPDX-License-Identifier: Apache-2.0
"""Calls made again and again, good and bad ones, leave no memory and no reference behind."""
import pathlib
import subprocess
import sys

import numpy as np
import pytest

import patchproof
from conftest import random_parameters, random_patch
from everything import fails


@pytest.mark.skipif(sys.platform != "linux", reason="reads /proc/self/statm")
def test_nothing_grows():
    """In a process of its own: what pytest keeps is not ours."""
    program = pathlib.Path(__file__).with_name("everything.py")
    done = subprocess.run([sys.executable, "-B", program], capture_output=True, text=True, timeout=300)
    assert done.returncode == 0, done.stderr
    traced, blocks, memory = map(int, done.stdout.split())
    assert traced < 2000 and blocks < 8 and memory < 20 << 20, done.stdout


def test_references_are_given_back():
    patch = patchproof.Model([random_patch(32)]).patches[0]
    uv, out = random_parameters(patch, 10), np.empty((10, 3))
    progress = lambda done, all: None  # noqa: E731
    before = [sys.getrefcount(x) for x in (uv, out, progress, patch)]
    for _ in range(500):
        patch.evaluate(uv, out=out)
        fails(patchproof.Error, patch.evaluate, uv + 100, out=out)
        fails(TypeError, patch.evaluate, uv, out=out[::-1])
    for _ in range(5):
        patchproof.certify(patch.extract_bezier(), progress=progress)
    after = [sys.getrefcount(x) for x in (uv, out, progress, patch)]
    assert before == after
