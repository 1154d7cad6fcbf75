#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Draws the README's picture: the normal angle along examples/seven/kink_between_samples.json, what 21 samples see of
it, and the certified bounds. Needs python3-matplotlib and the built program: make_pictures.py PATH/TO/patchproof"""
import json
import math
import pathlib
import subprocess
import sys

import matplotlib

matplotlib.use("svg")
import matplotlib.pyplot as plt  # noqa: E402

matplotlib.rcParams["svg.hashsalt"] = "patchproof"  # the same picture, the same bytes
here = pathlib.Path(__file__).resolve().parent
program = sys.argv[1]
model = here.parent.parent / "examples" / "seven" / "kink_between_samples.json"


def derivatives(patch, u, v):
    out = subprocess.run([program, "evaluate", model, "--patch", str(patch), "--at", f"{u},{v}", "--derivatives", "1",
                          "--scalar", "double", "--json", "-"], check=True, capture_output=True, text=True).stdout
    values = {(x["du"], x["dv"]): [float(c) for c in x["value"]] for x in json.loads(out)["values"]}
    return values[1, 0], values[0, 1]


def normal(patch, u, v):
    a, b = derivatives(patch, u, v)
    n = [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
    length = math.sqrt(sum(c * c for c in n))
    return [c / length for c in n]


report = json.loads(subprocess.run([program, "certify", model, "--json", "-"], check=True, capture_output=True,
                                   text=True).stdout)
join = report["joins"][0]
u_a, u_b = join["angle_degrees"]["at"]["a"][0], join["angle_degrees"]["at"]["b"][0]
begin, end = join["a"]["range"]


def angle(v):
    cosine = sum(x * y for x, y in zip(normal(0, u_a, v), normal(1, u_b, v)))
    return math.degrees(math.acos(max(-1, min(1, cosine))))


witness = join["angle_degrees"]["at"]["a"][1]
fine = sorted({begin + (end - begin) * i / 200 for i in range(201)} |
              {witness + (end - begin) * d / 2000 for d in range(-60, 61)
               if begin <= witness + (end - begin) * d / 2000 <= end})
samples = [begin + (end - begin) * i / 20 for i in range(21)]
figure, axes = plt.subplots(figsize=(8, 3.2))
axes.plot(fine, [angle(v) for v in fine], color="#c0392b", label="normal angle along the edge")
axes.plot(samples, [angle(v) for v in samples], "o", color="#2c3e50", label="21 samples: every one sees 0°")
upper = join["angle_degrees"]["upper"]
axes.axhline(upper, color="#27ae60", linestyle="--", label=f"certified: between {join['angle_degrees']['lower']:.4f}° and "
             f"{upper:.4f}° over the whole edge")
axes.set_xlabel("parameter along the edge")
axes.set_ylabel("degrees")
axes.set_ylim(-4, 135)
axes.legend(loc="upper right", frameon=False)
figure.tight_layout()
figure.savefig(here / "kink_between_samples.svg", metadata={"Date": None})
