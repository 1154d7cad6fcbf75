#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Runs the program $PATCHPROOF_PROGRAM and falsifies its report in the way that $PATCHPROOF_LIE names, so that a test sees
whether second_opinion.py notices."""
import json
import os
import subprocess
import sys


def falsify(join, lie):
    exact = join["exact"]
    if lie == "C0" and exact["C0"] == "refuted":
        exact["C0"] = "proven"
    if lie == "C1" and exact["C1"] == "refuted":
        exact["C1"] = "proven"
    if lie == "G1" and exact["G1"] == "proven":
        exact["G1"] = "refuted"
    if lie in ("gap", "angle_degrees"):
        join[lie]["upper"] = 0.99 * join[lie]["lower"]
    if lie == "witness":
        join["angle_degrees"]["lower"] = 1.001 * join["angle_degrees"]["upper"]


done = subprocess.run([os.environ["PATCHPROOF_PROGRAM"], *sys.argv[1:]], capture_output=True, text=True)
out = done.stdout
if sys.argv[1] == "certify":
    report = json.loads(out)
    for join in report["joins"]:
        falsify(join, os.environ["PATCHPROOF_LIE"])
    out = json.dumps(report)
sys.stdout.write(out)
sys.stderr.write(done.stderr)
sys.exit(done.returncode)
