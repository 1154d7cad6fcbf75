#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""make.py [FOLDER]: writes the models and motions of this folder, every number exact."""
import json
import pathlib
import sys
from fractions import Fraction as Q

HERE = pathlib.Path(__file__).resolve().parent


# ---- numbers and files ------------------------------------------------------------------------------------------------

def number(x):
    """A decimal where it is short, else "p/q"."""
    x = Q(x)
    return x.numerator if x.denominator == 1 else f"{x.numerator}/{x.denominator}"


def numbers(x):
    if isinstance(x, dict):
        return {key: numbers(value) for key, value in x.items()}
    return [numbers(y) for y in x] if isinstance(x, (list, tuple)) else number(x) if isinstance(x, Q) else x


def lines(value, depth=0):
    """JSON with one line for each list of numbers, objects in lines of their own."""
    pad = "  " * depth
    if isinstance(value, dict):
        flat = json.dumps(value, ensure_ascii=False)
        if len(flat) + len(pad) <= 118:
            return flat
        inner = (f'{pad}  {json.dumps(k)}: {lines(v, depth + 1)}' for k, v in value.items())
        return "{\n" + ",\n".join(inner) + f"\n{pad}}}"
    if isinstance(value, list) and len(json.dumps(value)) + len(pad) > 118:
        return "[\n" + ",\n".join(f"{pad}  {lines(v, depth + 1)}" for v in value) + f"\n{pad}]"
    return json.dumps(value, ensure_ascii=False)


def model(**parts):
    return {"format": "patchproof-model", "version": 1, **parts}


def motion(motions, pace="polynomial(1)"):
    return {"format": "patchproof-motion", "version": 1, "pace": pace, "motions": motions}


# ---- polynomials ------------------------------------------------------------------------------------------------------

def binomial(n, k):
    out = 1
    for i in range(k):
        out = out * (n - i) // (i + 1)
    return out


def taylor_bezier(derivatives, centre, begin, end):
    """Bézier points over [begin, end] of Σ f_r (t − centre)^r / r!."""
    q, h = len(derivatives) - 1, Q(end) - begin
    power = []  # in x = (t − begin)/h
    for j in range(q + 1):
        factorial, total = 1, 0
        for r in range(q + 1):
            factorial *= max(r, 1)
            if r >= j:
                total += derivatives[r] / Q(factorial) * binomial(r, j) * (Q(begin) - centre)**(r - j) * h**j
        power.append(total)
    return [sum(Q(binomial(l, j), binomial(q, j)) * power[j] for j in range(l + 1)) for l in range(q + 1)]


def bezier_knots(degree, begin, end):
    return [begin] * (degree + 1) + [end] * (degree + 1)


# ---- curves -----------------------------------------------------------------------------------------------------------

# 1, cos πt, sin πt, …, cos 4πt, sin 4πt
HEART = [[0, 0], [0, 13], [12, 0], [0, -5], [0, 0], [0, -2], [-4, 0], [0, -1], [0, 0]]
TENTHS = [Q(k, 5) for k in range(11)]


def heart(name="heart", b="expo-rational"):
    locals_ = [{"degree": 4, "trigonometric": "t", "control_points": HEART}] + [{"same_as": 0}] * 9
    return {"name": name, "b_function": b, "closed": True, "knots": TENTHS, "locals": locals_}


def moved_heart(name):
    """Every other sub-curve moved outwards."""
    moves = {1: (2, 2), 3: (3, -1), 5: (0, -3), 7: (-3, -1), 9: (-2, 2)}
    locals_ = []
    for i in range(10):
        local = {"degree": 4, "trigonometric": "t", "control_points": [list(moves.get(i, (0, 0)))] + HEART[1:]}
        locals_.append(local if i % 2 or i == 0 else {"same_as": 0})
    return {"name": name, "b_function": "expo-rational", "closed": True, "knots": TENTHS, "locals": locals_}


def beat(i):
    return (0, 2) if i == 0 else (0, -2) if i == 5 else (1, 0) if i < 5 else (-1, 0)


def sub_curve(whole, i):
    """Local curve i of a closed one, over the part of the domain where it is used."""
    begin, end = (i - 1) * Q(1, 5), (i + 1) * Q(1, 5)
    return {"name": f"local curve {i}", "b_function": "polynomial(0)", "knots": [begin, end],
            "locals": [whole["locals"][i if i % 2 else 0], {"same_as": 0}]}


# cos and sin of kπ/5, to three digits, and π: what comes of them is an exact model of its own, near the heart.
COSINES = [Q(x, 1000) for x in (1000, 809, 309, -309, -809, -1000, -809, -309, 309, 809)]
SINES = [Q(x, 1000) for x in (0, 588, 951, 951, 588, 0, -588, -951, -951, -588)]
PI = Q(355, 113)


def polynomial_heart():
    """Taylor curves of degree 3 at the ten knots of the heart, with rounded derivatives; laid out as Bézier curves."""
    locals_ = []
    for i in range(10):
        def wave(m, d, cosine):
            """The d-th derivative of cos or sin of mπt at i/5."""
            c, s = COSINES[i * m % 10], SINES[i * m % 10]
            table = [c, -s, -c, s] if cosine else [s, c, -s, -c]
            return table[d % 4] * (m * PI)**d
        xs, ys = [], []
        for d in range(4):
            xs.append(12 * wave(1, d, False) - 4 * wave(3, d, False))
            ys.append(13 * wave(1, d, True) - 5 * wave(2, d, True) - 2 * wave(3, d, True) - wave(4, d, True))
        xs, ys = ([Q(round(x * 1000), 1000) for x in values] for values in (xs, ys))
        begin, end = (i - 1) * Q(1, 5), (i + 1) * Q(1, 5)
        points = list(zip(*(taylor_bezier(values, i * Q(1, 5), begin, end) for values in (xs, ys))))
        locals_.append({"degree": 3, "knots": bezier_knots(3, begin, end), "control_points": points})
    return {"name": "heart of cubics", "b_function": "polynomial(2)", "closed": True, "knots": TENTHS,
            "locals": locals_}


def blend(x, order):
    """Figure 3: two curves on [0, 1], the second from x on."""
    return {"name": f"from {x} on", "b_function": f"polynomial({order})", "blend": {
        "overlap": 1 - x,
        "first": {"degree": 3, "control_points": [[0, 0], [1, 3], [2, 3], [3, 1]]},
        "second": {"degree": 3, "control_points": [[2, 0], [3, -1], [5, 3], [6, 2]]}}}


# ---- surfaces ---------------------------------------------------------------------------------------------------------

def surface(name, b, closed, u, v, locals_):
    return {"name": name, "b_function": b, "closed": closed, "knots": [u, v], "locals": locals_}


def plane():
    """The square [0, 3]² nine times, one piece of it lifted and turned."""
    flat = {"degree": [1, 1], "knots": [[0, 0, 3, 3], [0, 0, 3, 3]],
            "control_points": [[[0, 0, 0], [0, 3, 0]], [[3, 0, 0], [3, 3, 0]]]}
    return surface("plane", "polynomial(2)", [False, False], [0, 1, 2, 3], [0, 1, 2, 3], [flat] + [{"same_as": 0}] * 15)


def quarters():
    """Quarters of the unit circle in turn, on [0, 1]: (1−t²)/(1+t²), 2t/(1+t²), turned by multiples of 90 degrees."""
    out = []
    for c, s in [(1, 0), (0, 1), (-1, 0), (0, -1)]:
        out.append([(c * x - s * y, s * x + c * y, w) for x, y, w in [(1, 0, 1), (1, 1, 1), (0, 2, 2)]])
    return out


def half_circle(i):
    """Quarters i − 1 and i of the unit circle over [i − 1, i + 1]; homogeneous points, weights 1 1 2 | 2 2 4 of one parameter."""
    q = quarters()
    before, after = q[(i - 1) % 4], q[i % 4]
    return [i - 1] * 3 + [i] * 2 + [i + 1] * 3, before + [tuple(2 * x for x in p) for p in after[1:]]


def rational_patch(knots, rows):
    """rows of homogeneous points (wx, wy, wz, w)"""
    return {"degree": [2, 1 if len(knots[1]) == 4 else 2], "knots": knots,
            "control_points": [[[x / Q(w), y / Q(w), z / Q(w)] for x, y, z, w in row] for row in rows],
            "weights": [[w for *_, w in row] for row in rows]}


def rational_cylinder():
    locals_ = []
    for i in range(4):
        knots, circle = half_circle(i)
        rows = [[(2 * x, 2 * y, z * w, w) for z in (0, 3)] for x, y, w in circle]
        locals_ += [rational_patch([knots, [0, 0, 3, 3]], rows)] + [{"same_as": 4 * i}] * 3
    return surface("cylinder of rational patches", "polynomial(1)", [True, False], [0, 1, 2, 3, 4], [0, 1, 2, 3], locals_)


def rational_torus(big, small):
    locals_ = []
    for i in range(4):
        for j in range(4):
            ku, cu = half_circle(i)
            kv, cv = half_circle(j)
            rows = [[((big * wv + small * xv) * xu, (big * wv + small * xv) * yu, small * yv * wu, wu * wv)
                     for xv, yv, wv in cv] for xu, yu, wu in cu]
            locals_.append(rational_patch([ku, kv], rows))
    return surface("torus of rational patches", "polynomial(1)", [True, True], [0, 1, 2, 3, 4], [0, 1, 2, 3, 4], locals_)


def trigonometric_torus(big, small, b="polynomial(2)", pieces=(6, 3)):
    net = [[[0, 0, 0] for _ in range(3)] for _ in range(3)]  # over 1, cos, sin of πu and of πv
    net[1][0], net[1][1] = [big, 0, 0], [small, 0, 0]
    net[2][0], net[2][1] = [0, big, 0], [0, small, 0]
    net[0][2] = [0, 0, small]
    local = {"degree": [1, 1], "trigonometric": "uv", "control_points": net}
    u, v = ([Q(2 * k, n) for k in range(n + 1)] for n in pieces)
    return surface("torus", b, [True, True], u, v, [local] + [{"same_as": 0}] * (pieces[0] * pieces[1] - 1))


def trigonometric_cylinder():
    net = [[[0, 0, 0], [0, 0, 3]], [[2, 0, 0], [2, 0, 0]], [[0, 2, 0], [0, 2, 0]]]
    local = {"degree": [1, 1], "trigonometric": "u", "knots": [[], [0, 0, 3, 3]], "control_points": net}
    return surface("cylinder", "polynomial(2)", [True, False], [Q(k, 3) for k in range(7)], [0, 1, 2, 3],
                   [local] + [{"same_as": 0}] * 23)


# ---- figure 2 ---------------------------------------------------------------------------------------------------------

def bsplines():
    return model(curves=[{"name": "B-spline from eight control points", "degree": 3,
                          "knots": [0, 0, 0, 0, 1, 2, 3, 4, 5, 5, 5, 5],
                          "control_points": [[0, 0], [1, 3], [2, -1], [4, 2], [5, 5], [7, 1], [8, 3], [10, 0]]}])


def samples():
    """The second spline of figure 2 is the one nearest to these."""
    rows = ["# (10 t, 15 t (1 - t^2)(2 - t^2)/2), t = -1 ... 1. patchproof fit examples/gerbs/samples.txt OUT --controls 8"]
    for k in range(-10, 11):
        t = Q(k, 10)
        rows.append(f"{number(10 * t)} {number(15 * t * (1 - t * t) * (2 - t * t) / 2)}")
    return "\n".join(rows) + "\n"


# ---- motions ----------------------------------------------------------------------------------------------------------

def heart_beat():
    """Equation 12's heart: sub-curves 1–4 and 6–9 along x, 0 and 5 along y."""
    groups = {}
    for i in range(10):
        groups.setdefault(beat(i), []).append(i)
    return motion([{"curve": 0, "locals": where, "translate": [x, y, 0]} for (x, y), where in groups.items()])


FILES = {
    "bsplines.json": bsplines,
    "blends_1.json": lambda: model(gerbs_curves=[blend(Q(*x), 1) for x in ((4, 5), (1, 2), (1, 5))]),
    "blends_2.json": lambda: model(gerbs_curves=[blend(Q(*x), 2) for x in ((4, 5), (1, 2), (1, 5))]),
    "heart.json": lambda: model(gerbs_curves=[heart()]),
    "heart_polynomial.json": lambda: model(gerbs_curves=[polynomial_heart()]),
    "sub_curves.json": lambda: model(gerbs_curves=[(h := moved_heart("heart, moved"))] + [sub_curve(h, i) for i in range(10)]),
    "plane.json": lambda: model(gerbs_patches=[plane()]),
    "cylinder.json": lambda: model(gerbs_patches=[trigonometric_cylinder()]),
    "cylinder_rational.json": lambda: model(gerbs_patches=[rational_cylinder()]),
    "torus.json": lambda: model(gerbs_patches=[trigonometric_torus(4, Q(3, 2))]),
    "torus_rational.json": lambda: model(gerbs_patches=[rational_torus(4, Q(3, 2))]),
    "heart_beat.motion.json": heart_beat,
    "plane.motion.json": lambda: motion([
        {"patch": 0, "locals": [[1, 1]], "translate": [0, 0, 1], "rotate": {"axis": [1, 1, 0], "half_tangent": "1/4"}},
        {"patch": 0, "locals": [[2, 2]], "translate": [0, 0, "-3/4"]}]),
    "cylinder.motion.json": lambda: motion([
        {"patch": 0, "locals": [[i, j] for i in range(6) for j in (1, 2)], "about": [0, 0, "3/2"],
         "scale": ["8/5", "8/5", 1], "rotate": {"axis": [0, 0, 1], "half_tangent": "1/4"}}]),
    "torus.motion.json": lambda: motion([
        {"patch": 0, "locals": [[i, 0] for i in (0, 2, 4)], "scale": [1, 1, 2]},
        {"patch": 0, "locals": [[i, j] for i in (1, 3, 5) for j in range(3)], "translate": [0, 0, "6/5"]},
        {"patch": 0, "locals": [[0, j] for j in range(3)], "about": [4, 0, 0],
         "rotate": {"axis": [0, 1, 0], "half_tangent": "1/3"}, "scale": ["5/4", "5/4", "5/4"]}]),
}


def main():
    folder = pathlib.Path(sys.argv[1]) if len(sys.argv) > 1 else HERE
    for name, make in FILES.items():
        (folder / name).write_text(lines(numbers(make())) + "\n", encoding="utf-8")
    (folder / "samples.txt").write_text(samples(), encoding="utf-8")


if __name__ == "__main__":
    main()
