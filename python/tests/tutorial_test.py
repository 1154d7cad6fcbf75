# SPDX-License-Identifier: Apache-2.0
"""The tutorial runs as it is printed, and its pictures show something."""
import os
import pathlib
import subprocess
import sys

import matplotlib.image
import numpy as np

TUTORIAL = pathlib.Path(__file__).resolve().parents[1] / "tutorial.py"
PICTURES = ["1_patch", "2_errors", "3_kink", "4_filled", "5_triangles", "6_moved"]


def test_the_tutorial(tmp_path):
    done = subprocess.run([sys.executable, TUTORIAL, tmp_path], capture_output=True, text=True, timeout=300,
                          env={**os.environ, "MPLBACKEND": "Agg", "MPLCONFIGDIR": str(tmp_path / "matplotlib")})
    assert done.returncode == 0, done.stderr
    assert "Warning" not in done.stderr, done.stderr
    for text in ("35 patches", "G1 is refuted by", "sqrt(2)", "watertight"):
        assert text in done.stdout, done.stdout
    for name in PICTURES:
        picture = matplotlib.image.imread(tmp_path / f"{name}.png")[..., :3]
        drawn = (picture < 0.97).any(axis=2)
        assert picture.shape[0] >= 400 and drawn.mean() > 0.03, f"{name}: {drawn.mean():.1%} of the picture is not white"
        rows, columns = np.flatnonzero(drawn.any(axis=1)), np.flatnonzero(drawn.any(axis=0))
        assert np.ptp(rows) > 0.6 * drawn.shape[0] and np.ptp(columns) > 0.5 * drawn.shape[1], name
        assert len(np.unique(picture.reshape(-1, 3), axis=0)) > 50, f"{name} has hardly a colour"
    assert (tmp_path / "cup.stl").stat().st_size > 10000
