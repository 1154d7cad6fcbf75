# SPDX-License-Identifier: Apache-2.0
"""The interpreter's lock is free while patchproof works; callbacks, Ctrl-C, and many threads on one patch."""
import os
import pathlib
import signal
import subprocess
import sys
import threading
import time

import numpy as np
import pytest

import patchproof
from conftest import EXAMPLES, random_parameters, random_patch


def turns_of_another_thread_during(work):
    """How often another Python thread came to its turn while `work` ran, and how long that took.

    The interval after which Python takes the lock away is set beyond the work, so that only work that gives it back lets
    others run."""
    turns, stop, running = [0], threading.Event(), threading.Event()

    def count():
        running.set()
        while not stop.is_set():
            turns[0] += 1
            time.sleep(0.0005)

    other = threading.Thread(target=count)
    interval = sys.getswitchinterval()
    sys.setswitchinterval(1000)
    try:
        other.start()
        running.wait()
        before, start = turns[0], time.perf_counter()
        work()
        seconds, during = time.perf_counter() - start, turns[0] - before
    finally:
        sys.setswitchinterval(interval)
        stop.set()
        other.join()
    return during, seconds


def test_work_that_holds_the_lock_is_seen_by_this_test():
    during, seconds = turns_of_another_thread_during(lambda: sum(range(10**7)))
    assert during <= 2 and seconds > 0.02


@pytest.mark.parametrize("name", ["certify", "evaluate", "evaluate_rounded", "evaluate_exact", "tessellate", "fill", "read"])
def test_other_threads_run_meanwhile(name, cup, nurbs):
    uv = random_parameters(nurbs, 2 * 10**6)
    mesh = (EXAMPLES / "meshes" / "football.json").read_text()
    text = patchproof.Model([random_patch(1, spans=(60, 60))]).to_json()
    work = {
        "certify": lambda: patchproof.certify(cup),
        "evaluate": lambda: nurbs.evaluate(uv, derivatives=2),
        "evaluate_rounded": lambda: nurbs.evaluate_rounded(uv),
        "evaluate_exact": lambda: nurbs.evaluate_exact(uv[:50], order=3),
        "tessellate": lambda: patchproof.tessellate(cup, 0.1),
        "fill": lambda: patchproof.fill_text(mesh, "football.json"),
        "read": lambda: patchproof.read_text(text, "large.json"),
    }[name]
    during, seconds = turns_of_another_thread_during(work)
    assert during >= 3, f"{during} turns in {seconds} s"


def test_threads_hammer_one_patch():
    patch = patchproof.Model([random_patch(21, rational=True)]).patches[0]  # not prepared yet: the first calls race for that
    uv = random_parameters(patch, 4000)
    want = patchproof.Model([random_patch(21, rational=True)]).patches[0].evaluate(uv, derivatives=2, normal=True)
    exact = patch.evaluate_exact(("1/7", "1/9"))
    wrong, start = [], threading.Barrier(12)

    def hammer(seed):
        random = np.random.default_rng(seed)
        start.wait()
        for _ in range(25):
            pick = random.permutation(len(uv))[: random.integers(1, len(uv))]
            got = patch.evaluate(np.ascontiguousarray(uv[pick]), derivatives=2, normal=True, threads=int(random.integers(1, 3)))
            if not all(np.array_equal(a, b[pick]) for a, b in zip(got, want)):
                wrong.append(seed)
            with pytest.raises(patchproof.Error):  # errors are each thread's own
                patch.evaluate(np.array([[seed + 100.0, 0]]))
            if (patch.evaluate_exact(("1/7", "1/9")) != exact).any() or patch.points.shape != want.point.shape[:0] + (
                    len(patch.knots[0]) - 4, len(patch.knots[1]) - 4, 3):
                wrong.append(seed)

    threads = [threading.Thread(target=hammer, args=(seed,)) for seed in range(12)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert not wrong


def test_models_are_certified_in_threads(cup):
    want, reports = patchproof.certify(cup).to_json(), [None] * 4

    def work(i):
        reports[i] = patchproof.certify(cup, jobs=1 + i % 2, progress=lambda done, all: None).to_json()

    threads = [threading.Thread(target=work, args=(i,)) for i in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert reports == [want] * 4


def test_progress_is_told(cup):
    calls = []
    patchproof.certify(cup, progress=lambda done, all: calls.append((done, all)))
    assert calls and calls[-1][0] == calls[-1][1] > 0
    done = [d for d, _ in calls]
    assert done == sorted(done) and all(a is None or d <= a for d, a in calls)
    calls.clear()
    patchproof.tessellate(cup, 1.0, progress=lambda done, all: calls.append((done, all)))
    assert calls


class Stop(Exception):
    pass


def works(cup):
    mesh = (EXAMPLES / "meshes" / "two_faces.json").read_text()
    return [lambda progress: patchproof.certify(cup, progress=progress),
            lambda progress: patchproof.tessellate(cup, 1.0, progress=progress),
            lambda progress: patchproof.fill_text(mesh, "two_faces.json", progress=progress)]


def test_what_progress_raises_comes_out(cup):
    raised = Stop("enough")

    def stop(done, all):
        raise raised

    for work in works(cup):
        with pytest.raises(Stop) as caught:
            work(stop)
        assert caught.value is raised
        with pytest.raises(TypeError):
            work(lambda: None)  # takes no arguments
        with pytest.raises(SystemExit):
            work(lambda done, all: sys.exit(3))
        work(lambda done, all: "any value goes on")


def test_progress_may_use_patchproof(cup, bspline):
    seen = []

    def progress(done, all):
        seen.append(bspline.evaluate((0.1, 0.1)))
        patchproof.certify(bspline.extract_bezier())

    for work in works(cup):
        work(progress)
    assert seen


LONG = """
import signal, sys, threading, time, patchproof
model = patchproof.read(sys.argv[1])
def interrupt():
    time.sleep(0.5)
    signal.raise_signal(signal.SIGINT)
threading.Thread(target=interrupt, daemon=True).start()
start = time.monotonic()
try:
    while True:
        patchproof.tessellate(model, 1e-7, max_triangles=10**9)
except KeyboardInterrupt:
    print("interrupted", time.monotonic() - start)
print(patchproof.certify(model).outcome)
"""


def test_ctrl_c_stops_the_work():
    done = subprocess.run([sys.executable, "-c", LONG, EXAMPLES / "cup.json"], capture_output=True, text=True, timeout=120)
    assert done.returncode == 0, done.stderr
    first, second = done.stdout.splitlines()
    assert first.startswith("interrupted") and second == "pass"


def test_a_forked_child_works(bspline):
    want = bspline.evaluate((0.1, 0.1))
    child = os.fork()
    if child == 0:
        same = np.array_equal(bspline.evaluate((0.1, 0.1)), want)
        os._exit(0 if same else 1)
    assert os.waitpid(child, 0)[1] == 0
