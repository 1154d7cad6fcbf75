# SPDX-License-Identifier: Apache-2.0
"""Whole interpreters: how they end, and what they print."""
import subprocess
import sys

import pytest

from conftest import EXAMPLES

@pytest.mark.parametrize("work", ["model.patches[0].evaluate(uv)", "patchproof.certify(model)"])
def test_threads_that_still_work_when_the_interpreter_ends(work):
    program = f"""
import sys, threading, time
import numpy as np
import patchproof
model = patchproof.read({str(EXAMPLES / "cup.json")!r})
uv = np.random.rand(1000, 2)
def loop():
    while True:
        {work}
for _ in range(4):
    threading.Thread(target=loop, daemon=True).start()
time.sleep(0.3)
"""
    for _ in range(3):
        ended = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, timeout=120)
        assert (ended.returncode, ended.stderr) == (0, "")


def test_many_threads_print_nothing():
    program = f"""
import numpy as np
import patchproof
patch = patchproof.read({str(EXAMPLES / "cup.json")!r}).patches[0]
one = patch.evaluate(np.full((200000, 2), 0.25))
assert (patch.evaluate(np.full((200000, 2), 0.25), threads=8) == one).all()
"""
    ended = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, timeout=120)
    assert (ended.returncode, ended.stdout, ended.stderr) == (0, "", "")
