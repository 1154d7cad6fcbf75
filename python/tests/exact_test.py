# SPDX-License-Identifier: Apache-2.0
"""Exact values against the oracle, and refinement that changes nothing."""
import decimal
import itertools
import math
import sys
from fractions import Fraction

import numpy as np
import pytest

import oracle
import patchproof
from patchproof import Quadratic


def test_fractions_equal_the_oracles(nurbs):
    (u0, u1), (v0, v1) = nurbs.domain
    places = [(Fraction(u0), Fraction(v1)), (Fraction(1, 7), Fraction(1, 3)), (Fraction(u1), 0), (0.1, -0.25)]
    values = nurbs.evaluate_exact(places, order=2)
    assert set(values) == set(oracle.ORDERS)
    for i, (u, v) in enumerate(places):
        for order, want in oracle.surface(nurbs, u, v).items():
            assert list(values[order][i]) == want, (u, v, order)
            assert all(isinstance(x, Fraction) for x in values[order][i])
    assert values[0, 0].shape == (4, 3) and values[0, 0].dtype == object
    points = nurbs.evaluate_exact(places)
    assert (points == values[0, 0]).all()
    assert nurbs.evaluate_exact([places[:2], places[2:]]).shape == (2, 2, 3)


def test_every_way_to_write_a_number(bspline):
    want = bspline.evaluate_exact((Fraction(1, 4), Fraction(-1, 8)))
    for u, v in [(0.25, -0.125), ("1/4", "-1/8"), ("0.25", "-1.25e-1"), (decimal.Decimal("0.25"), decimal.Decimal("-0.125")),
                 (np.float64(0.25), np.float32(-0.125)), ("0x1p-2", "-0x1p-3")]:
        assert (bspline.evaluate_exact((u, v)) == want).all(), (u, v)
    assert (bspline.evaluate_exact((0, np.int64(0))) == bspline.evaluate_exact(np.zeros(2))).all()
    tenth, third = bspline.evaluate_exact((0.1, 0)), bspline.evaluate_exact(("0.1", 0))
    assert list(tenth) == oracle.surface(bspline, Fraction(0.1), 0)[0, 0]
    assert list(third) == oracle.surface(bspline, Fraction(1, 10), 0)[0, 0]
    assert (tenth != third).any()


def test_curves(curve):
    values = curve.evaluate_exact([Fraction(1, 3), 0.2], order=2)
    for i, t in enumerate([Fraction(1, 3), Fraction(0.2)]):
        assert [list(values[n][i]) for n in range(3)] == oracle.curve(curve, t)
    assert list(curve.evaluate_exact("1/3")) == oracle.curve(curve, Fraction(1, 3))[0]


def test_decimals_in_files_are_exact(examples):
    text = (examples / "cup.json").read_text()
    model = patchproof.read_text(text, "cup.json")
    rounded = patchproof.read_text(text, "cup.json", decimals="binary64")
    assert not all(p.is_double for p in model.patches) and all(p.is_double for p in rounded.patches)
    for patch in rounded.patches[:3]:
        assert list(patch.evaluate_exact(("1/3", "1/7"))) == oracle.surface(patch, Fraction(1, 3), Fraction(1, 7))[0, 0]
    exact = [p.evaluate_exact(("1/3", "1/7")) for p in model.patches]
    near = [p.evaluate_exact(("1/3", "1/7")) for p in rounded.patches]
    assert any((a != b).any() for a, b in zip(exact, near))
    assert all(abs(float(x - y)) < 1e-13 for a, b in zip(exact, near) for x, y in zip(a, b))


def test_numbers_with_a_square_root(examples):
    torus = patchproof.read(examples / "torus.json")
    points = [p.evaluate_exact(("1/3", "1/4")) for p in torus.patches]
    roots = [x for point in points for x in point if isinstance(x, Quadratic)]
    assert roots and all(x.d == 2 and x.b != 0 for x in roots)
    for patch, point in zip(torus.patches, points):
        double = patch.evaluate((1 / 3, 0.25))
        assert np.allclose([float(x) for x in point], double, atol=1e-12)
    x = roots[0]
    again = torus.patches[0].evaluate_exact((Quadratic(Fraction(0), Fraction(1, 2), 2), "sqrt(2)/2"))
    assert np.allclose([float(c) for c in again], torus.patches[0].evaluate((math.sqrt(0.5), math.sqrt(0.5))), atol=1e-12)
    assert str(x).count("sqrt(2)") == 1 and repr(x) == f"Quadratic({x})"


@pytest.mark.parametrize("a, b, d", [(0, 1, 2), (1, -1, 2), (Fraction(-1, 3), Fraction(5, 7), 3), (0, Fraction(-2, 3), 5),
                                     (Fraction(99, 70), -1, 2), (10**300, -(10**299), 2), (Fraction(1, 10**40), 1, 7)])
def test_quadratic_is_read_written_and_rounded(a, b, d):
    from patchproof._numbers import from_text
    x = Quadratic(Fraction(a), Fraction(b), d)
    assert from_text(str(x)) == x
    with decimal.localcontext() as context:
        context.prec = 700
        value = decimal.Decimal(x.a.numerator) / x.a.denominator
        value += decimal.Decimal(x.b.numerator) / x.b.denominator * decimal.Decimal(d).sqrt()
    assert float(x) == float(value)


def test_numbers_longer_than_python_reads_at_once():
    from patchproof._numbers import from_text
    x = Fraction(-(3**20000), 7**15000)
    limit = sys.get_int_max_str_digits()
    sys.set_int_max_str_digits(0)
    digits = str(x)
    sys.set_int_max_str_digits(limit)
    assert len(digits) > 2 * 4300 and from_text(digits) == x


@pytest.mark.parametrize("kind", ["bspline", "nurbs"])
def test_refinement_is_the_same_surface(kind, request):
    patch = request.getfixturevalue(kind)
    (u0, u1), (v0, v1) = [tuple(map(Fraction, ends)) for ends in patch.domain]
    places = list(itertools.product([u0, Fraction(1, 7), u1], [v0, Fraction(1, 3), v1]))
    want = patch.evaluate_exact(places)
    finer = patch.insert_knots("u", [Fraction(1, 11), 0.3, "1/5"]).patches[0]
    assert finer.points.shape[0] == patch.points.shape[0] + 3 and (finer.evaluate_exact(places) == want).all()
    finer = patch.insert_knots("v", [0.01]).patches[0]
    assert finer.points.shape[1] == patch.points.shape[1] + 1 and (finer.evaluate_exact(places) == want).all()
    higher = patch.elevate("v", 2).patches[0]
    assert higher.degree == (3, 5) and (higher.evaluate_exact(places) == want).all()
    pieces = patch.extract_bezier().patches
    spans = [len(np.unique(k)) - 1 for k in patch.knots]
    assert len(pieces) == spans[0] * spans[1]
    for piece in pieces:
        (a, b), (c, d) = piece.domain
        middle = (Fraction(a + b) / 2, Fraction(c + d) / 2)
        assert piece.points.shape == (4, 4, 3)
        assert (piece.evaluate_exact(middle) == patch.evaluate_exact(middle)).all()


def test_refinement_of_curves(curve):
    want = curve.evaluate_exact(["1/3", 0])
    assert (curve.insert_knots([Fraction(1, 9)]).curves[0].evaluate_exact(["1/3", 0]) == want).all()
    higher = curve.elevate(3).curves[0]
    assert higher.degree == 6 and (higher.evaluate_exact(["1/3", 0]) == want).all()
    pieces = curve.extract_bezier().curves
    assert len(pieces) == len(np.unique(curve.knots)) - 1
    assert pieces[0].domain[0] == curve.domain[0] and pieces[-1].domain[1] == curve.domain[1]


def test_high_derivatives_of_any_kind(examples):
    football = patchproof.fill(examples / "meshes" / "two_faces.json")[0]
    gregory = [p for p in football.patches if p.kind == "gregory"][0]
    values = gregory.evaluate_exact(("1/3", "1/4"), order=1)
    assert all(isinstance(x, Fraction) for x in values[1, 0])
    heart = patchproof.read(examples / "gerbs" / "heart_polynomial.json").curves[0]
    assert heart.kind == "gerbs" and heart.degree is None and heart.points is None
    start, end = heart.domain
    assert set(heart.evaluate_exact((start + end) / 2, order=4)) == {0, 1, 2, 3, 4}
