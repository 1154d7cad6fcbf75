# SPDX-License-Identifier: Apache-2.0
"""What the tests share: models, and the certainty that it is the installed package that is tested."""
import os
import pathlib

import numpy as np
import pytest

import patchproof

ROOT = pathlib.Path(__file__).resolve().parents[2]
EXAMPLES = ROOT / "examples"


def pytest_configure(config):
    wanted = os.environ.get("PATCHPROOF_PACKAGE")
    if wanted and pathlib.Path(patchproof.__file__).parent.resolve() != pathlib.Path(wanted).resolve():
        raise pytest.UsageError(f"tested would be {patchproof.__file__}, and not {wanted}")


@pytest.fixture(scope="session")
def examples():
    return EXAMPLES


@pytest.fixture(scope="session")
def cup():
    return patchproof.read(EXAMPLES / "cup.json")


def random_patch(seed, degree=(3, 3), spans=(3, 2), rational=False):
    """A patch whose numbers all are doubles, over a domain that is not [0, 1], with knots of several multiplicities."""
    random = np.random.default_rng(seed)
    knots = []
    for p, n in zip(degree, spans):
        inner = np.cumsum(random.uniform(0.1, 1, n))
        inner = np.repeat(inner[:-1], random.integers(1, p + 1, n - 1)) if n > 1 else inner[:0]
        end = (inner[-1] if len(inner) else 0) + 0.75
        knots.append(np.concatenate([np.full(p + 1, -0.5), inner, np.full(p + 1, end)]))
    counts = [len(k) - p - 1 for k, p in zip(knots, degree)]
    points = random.normal(size=(*counts, 3)) * 10
    weights = random.uniform(0.5, 2, counts) if rational else None
    return patchproof.PatchData(points, weights, degree, tuple(knots), f"random {seed}")


def random_parameters(patch, count, seed=1):
    random = np.random.default_rng(seed)
    (u0, u1), (v0, v1) = patch.domain
    uv = random.uniform([u0, v0], [u1, v1], (count, 2))
    return np.clip(uv, [u0, v0], [u1, v1])


@pytest.fixture(scope="session")
def bspline():
    return patchproof.Model([random_patch(1)]).patches[0]


@pytest.fixture(scope="session")
def nurbs():
    return patchproof.Model([random_patch(2, rational=True)]).patches[0]


@pytest.fixture(scope="session")
def curve():
    data = random_patch(3, rational=True)
    return patchproof.Model(curves=[patchproof.CurveData(
        data.points[:, 0], data.weights[:, 0], data.degree[0], data.knots[0], "a curve")]).curves[0]
