# SPDX-License-Identifier: Apache-2.0
"""B-splines by de Boor's recursion in Fractions: an oracle that shares nothing with patchproof.

Derivatives come from truncated power series in two variables: a Series is Σ c[i, j] s^i t^j with i + j ≤ 2, so that the recursion
at u + s, v + t yields S, S_u, S_v, S_uu / 2, S_uv, S_vv / 2 at once.
"""
from fractions import Fraction

ORDERS = [(0, 0), (1, 0), (0, 1), (2, 0), (1, 1), (0, 2)]


class Series:
    def __init__(self, terms):
        self.terms = {order: Fraction(value) for order, value in terms.items() if value != 0}

    def __add__(self, other):
        return Series({o: self.terms.get(o, 0) + other.terms.get(o, 0) for o in ORDERS})

    def __sub__(self, other):
        return Series({o: self.terms.get(o, 0) - other.terms.get(o, 0) for o in ORDERS})

    def __mul__(self, other):
        if not isinstance(other, Series):
            return Series({o: c * other for o, c in self.terms.items()})
        out = {}
        for (i, j), a in self.terms.items():
            for (k, l), b in other.terms.items():
                if i + j + k + l <= 2:
                    out[i + k, j + l] = out.get((i + k, j + l), 0) + a * b
        return Series(out)

    def __truediv__(self, other):  # by other = d (1 - r): Σ r^n
        d = other.terms[0, 0]
        r = Series({(0, 0): 1}) - other * (1 / d)
        return self * (Series({(0, 0): 1}) + r + r * r) * (1 / d)

    def derivative(self, order):
        return self.terms.get(order, Fraction(0)) * (2 if 2 in order else 1)


def span(knots, degree, u, side):
    """The span that u lies in; at a knot the one to the right, or to the left."""
    first, last = degree, len(knots) - degree - 2
    inside = [i for i in range(first, last + 1) if knots[i] < knots[i + 1]]
    if side == "right":
        return max([i for i in inside if knots[i] <= u and u < knots[i + 1]], default=inside[-1])
    return min([i for i in inside if knots[i] < u <= knots[i + 1]], default=inside[0])


def de_boor(degree, knots, points, u, series, side):
    """points: lists of Series (homogeneous coordinates); series: u + s."""
    k = span(knots, degree, u, side)
    d = [list(points[i]) for i in range(k - degree, k + 1)]
    for level in range(1, degree + 1):
        for j in range(degree, level - 1, -1):
            i = k - degree + j
            width = knots[i + degree - level + 1] - knots[i]
            a = (series - Series({(0, 0): knots[i]})) * (1 / width)
            b = Series({(0, 0): 1}) - a
            d[j] = [x * b + y * a for x, y in zip(d[j - 1], d[j])]
    return d[degree]


def fractions_of(array):
    if hasattr(array, "tolist"):
        array = array.tolist()
    return [fractions_of(a) for a in array] if isinstance(array, list) else Fraction(array)


def homogeneous(point, weight):
    return [Series({(0, 0): x * weight}) for x in point] + [Series({(0, 0): weight})]


def surface(patch, u, v, side=("right", "right")):
    """{(i, j): [x, y, z]} of a patch with arrays degree, knots, points, weights, all its numbers taken exactly."""
    u, v = Fraction(u), Fraction(v)
    (p, q), (ku, kv) = patch.degree, map(fractions_of, patch.knots)
    points = fractions_of(patch.points)
    weights = fractions_of(patch.weights) if patch.weights is not None else [[Fraction(1)] * len(r) for r in points]
    rows = [de_boor(q, kv, [homogeneous(x, w) for x, w in zip(row, ws)], v, Series({(0, 0): v, (0, 1): 1}), side[1])
            for row, ws in zip(points, weights)]
    x, y, z, w = de_boor(p, ku, rows, u, Series({(0, 0): u, (1, 0): 1}), side[0])
    affine = [c / w for c in (x, y, z)]
    return {order: [c.derivative(order) for c in affine] for order in ORDERS}


def curve(spline, t, side="right"):
    """[C, C', C''], each [x, y, z]."""
    t = Fraction(t)
    points = fractions_of(spline.points)
    weights = fractions_of(spline.weights) if spline.weights is not None else [Fraction(1)] * len(points)
    homogeneous_points = [homogeneous(x, w) for x, w in zip(points, weights)]
    x, y, z, w = de_boor(spline.degree, fractions_of(spline.knots), homogeneous_points, t,
                         Series({(0, 0): t, (1, 0): 1}), side)
    affine = [c / w for c in (x, y, z)]
    return [[c.derivative((n, 0)) for c in affine] for n in range(3)]
