#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""second_opinion.py PROGRAM MODEL…: judges every join that `PROGRAM certify` reports a second time, by other means.

Patches are evaluated here in exact fractions, by the recursion of the basis functions, at so many parameters of each
polynomial piece that a join polynomial which vanishes at all of them is zero. This decides C0, C1 and coplanar tangent planes
without any formula of the program. At the same parameters the distance and the angle of the oriented normals must not
exceed the upper bounds, and at the place of a lower bound its value must be found.

Left out, and counted: models with square roots. Models that are absent are skipped; exit code 77 when all are.
"""
import json
import math
import pathlib
import subprocess
import sys
import tempfile
from fractions import Fraction

ROUNDING = 1e-9  # relative error allowed for places that reports give as doubles


def number(x):
    return Fraction(x) if not isinstance(x, str) else quotient(x)


def quotient(text):
    a, _, b = text.partition("/")
    return Fraction(a) / Fraction(b or 1)


class Knots:
    def __init__(self, degree, knots):
        self.p, self.t = degree, knots
        self.n = len(knots) - degree - 1
        self.begin, self.end = knots[degree], knots[self.n]

    def span(self, x, from_left):
        spans = [i for i in range(self.p, self.n) if self.t[i] < self.t[i + 1]]
        for i in spans:
            if self.t[i] <= x <= self.t[i + 1] and (x < self.t[i + 1] or from_left or i == spans[-1]) \
                    and (x > self.t[i] or not from_left or i == spans[0]):
                return i
        raise ValueError("outside the domain")

    def basis(self, x, from_left):
        """(first index, values, first derivatives) of the functions that are not zero on the span of x."""
        i, t, p = self.span(x, from_left), self.t, self.p
        row = [Fraction(1)]
        lower = row
        for q in range(1, p + 1):
            lower, row = row, [Fraction(0)] * (q + 1)
            for k in range(q):
                left, right = t[i - q + 1 + k], t[i + 1 + k]
                w = (x - left) / (right - left)
                row[k] += (1 - w) * lower[k]
                row[k + 1] += w * lower[k]
        slope = [Fraction(0)] * (p + 1)
        for k in range(p):
            d = p * lower[k] / (t[i + 1 + k] - t[i - p + 1 + k])
            slope[k] -= d
            slope[k + 1] += d
        return i - p, row, slope


class Patch:
    def __init__(self, patch):
        rows = [[[number(x) for x in point] for point in row] for row in patch["control_points"]]
        if "weights" in patch:
            rows = [[[w * x for x in point] + [w] for point, w in zip(row, map(number, weights))]
                    for row, weights in zip(rows, patch["weights"])]
        self.rational = len(rows[0][0]) == 4
        self.net = [[p if self.rational else p + [Fraction(1)] for p in row] for row in rows]
        bezier = [[0] * (d + 1) + [1] * (d + 1) for d in patch["degree"]]
        self.u, self.v = (Knots(d, [number(x) for x in k]) for d, k in zip(patch["degree"], patch.get("knots", bezier)))

    def at(self, u, v, left_u, left_v):
        """S, S_u, S_v."""
        iu, nu, du = self.u.basis(u, left_u)
        iv, nv, dv = self.v.basis(v, left_v)
        total = [[Fraction(0)] * 4 for _ in range(3)]
        for a, (f, fu) in enumerate(zip(nu, du)):
            for b, (g, gv) in enumerate(zip(nv, dv)):
                point = self.net[iu + a][iv + b]
                for k, w in enumerate((f * g, fu * g, f * gv)):
                    if w:
                        for c in range(4):
                            total[k][c] += w * point[c]
        (*x, w), *derivatives = total
        point = [c / w for c in x]
        return [point] + [[(d[c] - d[3] * point[c]) / w for c in range(3)] for d in derivatives]


class Line:
    """One side of a join: u or v constant, seen from one side."""

    def __init__(self, patch, side):
        self.patch, name = patch, side["edge"]
        self.u_constant = name[0] == "u"
        self.across, self.along = (patch.u, patch.v) if self.u_constant else (patch.v, patch.u)
        if "=" in name:
            self.value, self.from_left = number(name.split("=")[1].strip()[:-1]), name[-1] == "-"
        else:
            self.from_left = name.endswith("max")
            self.value = self.across.end if self.from_left else self.across.begin
        self.begin, self.end = (number(x) for x in side["exact_range"])

    def at(self, t, from_left):
        """Point, derivative along the line, derivative into the patch."""
        if self.u_constant:
            point, across, along = self.patch.at(self.value, t, self.from_left, from_left)
        else:
            point, along, across = self.patch.at(t, self.value, from_left, self.from_left)
        return point, along, [-x for x in across] if self.from_left else across


def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def root(square):
    """The root of a fraction as a double, also where the fraction is no double."""
    if square == 0:
        return 0.0
    shift = (square.denominator.bit_length() - square.numerator.bit_length()) // 2
    return math.ldexp(math.sqrt(square * Fraction(4) ** shift), -shift)


def angle(na, nb):
    """Degrees between the sides: 0 when they go on smoothly, 180 when they fold back."""
    c, d = cross(na, nb), -dot(na, nb)
    return math.degrees(math.atan2(root(dot(c, c) / (dot(na, na) * dot(nb, nb))),
                                   math.copysign(root(d * d / (dot(na, na) * dot(nb, nb))), d)))


class SecondOpinion:
    def __init__(self, program):
        self.program, self.failures, self.joins, self.points, self.left_out = program, [], 0, 0, {}

    def leave_out(self, why):
        self.left_out[why] = self.left_out.get(why, 0) + 1

    def model(self, path):
        with tempfile.TemporaryDirectory() as folder:
            copy = pathlib.Path(folder) / "copy.json"
            done = subprocess.run([self.program, "convert", str(path), str(copy)], capture_output=True, text=True)
            if done.returncode:
                return self.leave_out("models refused by the reader")
            text = copy.read_text(encoding="utf-8")
        if "sqrt" in text:
            return self.leave_out("models with square roots")
        self.patches = [Patch(p) for p in json.loads(text, parse_float=Fraction).get("patches", [])]
        if not self.patches:
            return self.leave_out("models without patches")
        done = subprocess.run([self.program, "certify", str(path), "--json", "-"], capture_output=True, text=True)
        for join in json.loads(done.stdout)["joins"]:
            self.name = f"{path.name}: join {join['id']}"
            self.join(join)

    def fail(self, text):
        self.failures.append(f"{self.name}: {text}")

    def join(self, join):
        self.joins += 1
        a, b = (Line(self.patches[join[s]["patch"]], join[s]) for s in "ab")
        r = number(join["pairing"].get("ratio", "1"))
        nodes = [[number(x) for x in node] for node in
                 join["pairing"].get("nodes", [[side["exact_range"][i] for side in (join["a"], join["b"])] for i in (0, 1)])]

        def partner(t):
            i = max(0, min(len(nodes) - 2, sum(node[0] <= t for node in nodes) - 1))
            (a0, b0), (a1, b1) = nodes[i], nodes[i + 1]
            x = (t - a0) / (a1 - a0)
            return b0 + r * x / (1 - x + r * x) * (b1 - b0)

        def preimage(t):
            for (a0, b0), (a1, b1) in zip(nodes, nodes[1:]):
                if min(b0, b1) <= t <= max(b0, b1):
                    y = (t - b0) / (b1 - b0)
                    return a0 + y / (r + y - r * y) * (a1 - a0)

        inside = [preimage(t) for t in set(b.along.t) if min(b.begin, b.end) < t < max(b.begin, b.end)]
        inside += [t for t in set(a.along.t) if a.begin < t < a.end]
        cuts = sorted({node[0] for node in nodes} | set(inside))
        degree = max(a.along.p, b.along.p)
        # The 4 × 4 determinant of homogeneous rows has at most this degree; other conditions have less, apart from
        # numerators of rational cross derivatives: at most 2 (p + q).
        count = 1 + (4 * degree if a.patch.rational or b.patch.rational or join["pairing"].get("ratio") else 3 * degree)
        same, equal, coplanar = True, True, True
        worst_gap, worst_angle = 0, 0.0
        for t0, t1 in zip(cuts, cuts[1:]):
            for k in range(count):
                t = t0 + (t1 - t0) * Fraction(k, count - 1)
                x, xt, xs = a.at(t, k == count - 1)
                y, yt, ys = b.at(partner(t), (k == count - 1) != (b.end < b.begin))
                self.points += 1
                difference = [p - q for p, q in zip(x, y)]
                worst_gap = max(worst_gap, dot(difference, difference))
                same = same and not any(difference)
                equal = equal and not any(p + q for p, q in zip(xs, ys))
                coplanar = coplanar and dot(cross(xt, xs), ys) == 0
                sense = -1 if b.end < b.begin else 1
                na, nb = cross(xt, xs), [sense * c for c in cross(yt, ys)]
                if any(na) and any(nb):
                    worst_angle = max(worst_angle, angle(na, nb))
        self.judge(join, a, b, same, equal, coplanar, worst_gap, worst_angle)

    def judge(self, join, a, b, same, equal, coplanar, worst_gap, worst_angle):
        exact, gap, bend = join["exact"], join["gap"], join["angle_degrees"]
        if (exact["C0"] == "proven") != same:
            self.fail(f"C0 {exact['C0']}, but the edges are {'the same' if same else 'different'}")
        if (exact["C1"] == "proven") != (same and equal):
            self.fail(f"C1 {exact['C1']}, but the edges and derivatives are {'equal' if same and equal else 'not equal'}")
        smooth = same and coplanar and worst_angle < 90
        if exact["G1"] != "undecided" and (exact["G1"] == "proven") != smooth:
            self.fail(f"G1 {exact['G1']}, but the planes are {'the same' if coplanar else 'not the same'}")
        if worst_gap > Fraction(gap["upper"]) ** 2:
            self.fail(f"gap {root(worst_gap)} found, above {gap['upper']}")
        if worst_angle > bend["upper"] * (1 + ROUNDING):
            self.fail(f"angle {worst_angle} found, above {bend['upper']}")
        # The lower bounds are attained where the report says.
        for what, bound in (("gap", gap), ("angle", bend)):
            if bound["lower"] == 0 or bound["lower"] < 1e-11:
                continue
            ends = []
            for line, (u, v) in ((a, bound["at"]["a"]), (b, bound["at"]["b"])):
                t = Fraction(v if line.u_constant else u)
                t = min(max(t, line.along.begin), line.along.end)
                ends.append(line.at(t, t == max(line.begin, line.end)))
            (x, xt, xs), (y, yt, ys) = ends
            sense = -1 if b.end < b.begin else 1
            na, nb = cross(xt, xs), [sense * c for c in cross(yt, ys)]
            found = root(sum((p - q) ** 2 for p, q in zip(x, y))) if what == "gap" else \
                angle(na, nb) if any(na) and any(nb) else None
            if found is not None and found < bound["lower"] * (1 - 1e-6):
                self.fail(f"{what} {found} at {bound['at']}, where at least {bound['lower']} was promised")


def main():
    opinion, absent = SecondOpinion(sys.argv[1]), 0
    for path in map(pathlib.Path, sys.argv[2:]):
        if path.exists():
            opinion.model(path)
        else:
            absent += 1
    print(f"{opinion.joins} joins at {opinion.points} points; {absent} models absent")
    for why, count in sorted(opinion.left_out.items()):
        print(f"left out: {count} {why}")
    print("\n".join(opinion.failures))
    if opinion.failures or len(sys.argv) < 3:
        return 1
    return 77 if absent == len(sys.argv) - 2 else 0


if __name__ == "__main__":
    sys.exit(main())
