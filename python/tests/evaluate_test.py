# SPDX-License-Identifier: Apache-2.0
"""Values in double: held against the oracle's fractions within the proved bounds, and from every layout of arrays."""
from fractions import Fraction

import numpy as np
import pytest

import oracle
import patchproof
from conftest import random_parameters, random_patch

NAMES = {"point": (0, 0), "du": (1, 0), "dv": (0, 1), "duu": (2, 0), "duv": (1, 1), "dvv": (0, 2)}


@pytest.mark.parametrize("kind", ["bspline", "nurbs"])
def test_each_vector_is_within_its_bound_of_the_exact_value(kind, request):
    patch = request.getfixturevalue(kind)
    uv = random_parameters(patch, 25)
    values = patch.evaluate(uv, derivatives=2)
    for i, (u, v) in enumerate(uv.tolist()):
        exact = oracle.surface(patch, u, v)
        for name, order in NAMES.items():
            bound = patch.error_bound(name)
            assert 0 < bound < 1
            for got, want in zip(getattr(values, name)[i], exact[order]):
                assert abs(Fraction(float(got)) - want) <= Fraction(bound), (name, u, v)


def test_normals_are_unit_and_perpendicular(nurbs):
    values = nurbs.evaluate(random_parameters(nurbs, 100), derivatives=1, normal=True)
    assert np.allclose(np.linalg.norm(values.normal, axis=1), 1, atol=1e-12)
    assert np.allclose(np.sum(values.normal * values.du, axis=1) / np.linalg.norm(values.du, axis=1), 0, atol=1e-9)
    cross = np.cross(values.du, values.dv)
    assert np.allclose(values.normal, cross / np.linalg.norm(cross, axis=1)[:, None], atol=1e-9)
    assert values.duu is None
    only = nurbs.evaluate(random_parameters(nurbs, 100), normal=True)
    assert only.du is None and np.array_equal(only.normal, values.normal)


def test_every_layout_gives_the_same_bits(bspline):
    uv = random_parameters(bspline, 600)
    want = bspline.evaluate(uv)
    assert want.shape == (600, 3) and want.dtype == np.float64 and want.flags.c_contiguous
    wide = np.full((600, 7), np.nan)
    wide[:, 2:4] = uv
    spaced = np.full((1200, 2), np.nan)
    spaced[::2] = uv
    swapped = np.ascontiguousarray(uv[:, ::-1])
    layouts = {
        "columns of a table": wide[:, 2:4], "every second row": spaced[::2], "columns": np.asfortranarray(uv),
        "two arrays": (uv[:, 0].copy(), uv[:, 1].copy()), "two views": (uv[:, 0], uv[:, 1]),
        "exchanged columns": swapped[:, ::-1], "shape (20, 30, 2)": uv.reshape(20, 30, 2), "read-only": uv.copy(),
    }
    layouts["read-only"].flags.writeable = False
    for name, layout in layouts.items():
        assert np.array_equal(bspline.evaluate(layout).reshape(600, 3), want), name
    assert bspline.evaluate(uv.reshape(20, 30, 2)).shape == (20, 30, 3)
    assert np.array_equal(bspline.evaluate(uv, threads=-1), want)
    assert np.array_equal(bspline.evaluate(uv, derivatives=2, normal=True).point, want)


def test_one_point_and_lists(bspline):
    uv = random_parameters(bspline, 3)
    want = bspline.evaluate(uv)
    assert np.array_equal(bspline.evaluate(uv[1]), want[1]) and bspline.evaluate(uv[1]).shape == (3,)
    assert np.array_equal(bspline.evaluate((float(uv[1, 0]), float(uv[1, 1]))), want[1])
    assert np.array_equal(bspline.evaluate(uv.tolist()), want)
    assert np.array_equal(bspline.evaluate((uv[:, 0].tolist(), uv[:, 1].tolist())), want)


def test_no_points_at_all(bspline, curve):
    assert bspline.evaluate(np.empty((0, 2))).shape == (0, 3)
    assert bspline.evaluate((np.empty(0), np.empty(0)), derivatives=2, normal=True).dvv.shape == (0, 3)
    assert bspline.evaluate_grid(np.empty(0), np.linspace(0, 0.1, 5)).shape == (0, 5, 3)
    assert bspline.evaluate(np.empty((4, 0, 2))).shape == (4, 0, 3)
    for part in bspline.evaluate_bounded(np.empty((0, 2))) + bspline.enclose(np.empty((0, 2))):
        assert len(part) == 0
    assert bspline.evaluate_rounded(np.empty((0, 2))).shape == (0, 3)
    assert bspline.evaluate_exact(np.empty((0, 2))).shape == (0, 3)
    assert curve.evaluate(np.empty(0)).shape == (0, 3)


def test_out_is_written_and_returned(nurbs):
    uv = random_parameters(nurbs, 500)
    want = nurbs.evaluate(uv, derivatives=1, normal=True)
    layouts = {"plain": np.empty((500, 3)), "columns": np.empty((500, 3), order="F"), "wide": np.empty((500, 8))[:, 1:4],
               "rows apart": np.empty((1000, 3))[::2], "records": np.empty(500, dtype=[("p", "3f8"), ("id", "i8")])["p"]}
    for name, out in layouts.items():
        out[...] = np.nan
        assert nurbs.evaluate(uv, out=out) is out, name
        assert np.array_equal(out, want.point), name
    around = np.full((500, 5), 7.0)
    nurbs.evaluate(uv, out=around[:, 1:4])
    assert (around[:, [0, 4]] == 7).all()
    record = patchproof.Derivatives(du=np.empty((500, 3)), normal=np.empty((500, 3), order="F"))
    assert nurbs.evaluate(uv, out=record) is record
    assert np.array_equal(record.du, want.du) and np.array_equal(record.normal, want.normal) and record.point is None
    table = np.empty((500, 2 + 3))  # parameters and points side by side do not overlap
    table[:, :2] = uv
    nurbs.evaluate(table[:, :2], out=table[:, 2:])
    assert np.array_equal(table[:, 2:], want.point) and np.array_equal(table[:, :2], uv)


def test_memory_is_the_callers(bspline):
    """A million points move through 40 bytes each that the caller owns, and through nothing else."""
    import tracemalloc
    uv, out = random_parameters(bspline, 10**6), np.empty((10**6, 3))
    bspline.evaluate(uv[:10])
    tracemalloc.start()
    bspline.evaluate(uv, out=out)
    peak = tracemalloc.get_traced_memory()[1]
    tracemalloc.stop()
    assert peak < 100_000
    pick = slice(None, None, 99_991)
    assert np.array_equal(out[pick], bspline.evaluate(np.ascontiguousarray(uv[pick])))


def test_grid_is_evaluate(nurbs):
    (u0, u1), (v0, v1) = nurbs.domain
    u, v = np.linspace(u0, u1, 41), np.linspace(v0, v1, 37)
    grid = nurbs.evaluate_grid(u, v, derivatives=2, normal=True)
    pairs = nurbs.evaluate(np.stack(np.meshgrid(u, v, indexing="ij"), axis=-1), derivatives=2, normal=True)
    for name, one, other in zip(patchproof.Derivatives._fields, grid, pairs):
        assert one.shape == (41, 37, 3) and np.array_equal(one, other), name
    out = np.empty((41, 37, 3))
    assert nurbs.evaluate_grid(u, v, out=out) is out and np.array_equal(out, grid.point)


def test_sides_at_a_kink():
    points = np.array([[[i, j, abs(i - 1) * 1.0] for j in range(2)] for i in range(3)], dtype=float)
    data = patchproof.PatchData(points, degree=(1, 1), knots=([0, 0, 0.5, 1, 1], [0, 0, 1, 1]))
    patch = patchproof.Model([data]).patches[0]
    right, left = (patch.evaluate((0.5, 0.5), derivatives=1, side=side).du[2] for side in ("right", "left"))
    assert (right, left) == (2, -2)
    assert patch.evaluate((0.5, 0.5), derivatives=1, side=("left", "right")).du[2] == -2
    assert patch.evaluate_exact((Fraction(1, 2), 0), 1, side=("left", "right"))[1, 0][2] == -2
    assert oracle.surface(patch, 0.5, 0.5, ("left", "right"))[1, 0][2] == -2


def test_bounds_enclosures_and_rounding(nurbs):
    uv = random_parameters(nurbs, 25)
    points, bounds = nurbs.evaluate_bounded(uv)
    lower, upper = nurbs.enclose(uv)
    rounded = nurbs.evaluate_rounded(uv)
    assert points.shape == (25, 3) and bounds.shape == (25,)
    for i, (u, v) in enumerate(uv.tolist()):
        for k, exact in enumerate(oracle.surface(nurbs, u, v)[0, 0]):
            assert abs(Fraction(points[i, k]) - exact) <= Fraction(bounds[i])
            assert Fraction(lower[i, k]) <= exact <= Fraction(upper[i, k])
            assert rounded[i, k] == float(exact)
    assert (bounds < 1e-11).all() and (upper - lower < 1e-11).all()


def test_curves(curve):
    start, end = curve.domain
    t = np.linspace(start, end, 24)
    values = curve.evaluate(t, derivatives=2)
    assert isinstance(values, patchproof.CurveDerivatives)
    for i, at in enumerate(t.tolist()):
        exact = oracle.curve(curve, at)
        for name, want in zip(("point", "dt", "dtt"), exact):
            for got, x in zip(getattr(values, name)[i], want):
                assert abs(Fraction(float(got)) - x) <= Fraction(curve.error_bound(name)), (name, at)
    assert np.array_equal(curve.evaluate(t.reshape(2, 12)), values.point.reshape(2, 12, 3))
    assert np.array_equal(curve.evaluate(np.repeat(t, 3)[::3]), values.point)
    assert np.array_equal(curve.evaluate(float(t[5])), values.point[5])
    out = patchproof.CurveDerivatives(dt=np.empty((24, 3)))
    assert curve.evaluate(t, out=out) is out and np.array_equal(out.dt, values.dt)


def test_a_kernel_of_high_degree_knows_its_bound():
    patch = patchproof.Model([random_patch(5, (9, 8), (2, 1))]).patches[0]
    u, v = random_parameters(patch, 1)[0].tolist()
    for got, want in zip(patch.evaluate((u, v)), oracle.surface(patch, u, v)[0, 0]):
        assert abs(Fraction(float(got)) - want) <= Fraction(patch.error_bound("point"))
