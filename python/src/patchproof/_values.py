# SPDX-License-Identifier: Apache-2.0
"""Results that are plain records: vectors, bounds, verdicts, joins, summaries."""
from __future__ import annotations

import dataclasses
import decimal
import math
from typing import NamedTuple, NoReturn, Optional, Union

import numpy as np
from numpy.typing import NDArray

from ._numbers import Exact

Floats = NDArray[np.float64]


class Derivatives(NamedTuple):
    """Values of a surface at parameters of shape (...): float64 arrays of shape (..., 3), None where not asked for.

    Lengths are in the model's units; du is ∂S/∂u, duv is ∂²S/∂u∂v. normal is (du × dv) / |du × dv|, and 0 0 0 where
    the computed product is 0 or far below its size elsewhere. As `out=` of evaluate its arrays say where the values go.
    """

    point: Optional[Floats] = None
    du: Optional[Floats] = None
    dv: Optional[Floats] = None
    duu: Optional[Floats] = None
    duv: Optional[Floats] = None
    dvv: Optional[Floats] = None
    normal: Optional[Floats] = None


class CurveDerivatives(NamedTuple):
    """Values of a curve at parameters of shape (...): float64 arrays of shape (..., 3), None where not asked for."""

    point: Optional[Floats] = None
    dt: Optional[Floats] = None
    dtt: Optional[Floats] = None


def _number(x: float, rounding: str) -> str:
    """Five digits, rounded down or up: what is printed is proved as well."""
    if math.isinf(x):
        return "unknown"
    with decimal.localcontext() as context:
        context.prec, context.rounding = 5, rounding
        return f"{float(+decimal.Decimal(x)):.5g}"


@dataclasses.dataclass(frozen=True, repr=False)
class Bounds:
    """The largest value along a whole join lies in [lower, upper], which is proved.

    lower is attained at the point `at` (x, y, z; None in a summary). converged: upper − lower is at most 1 % of upper.
    Both are 0 where the quantity is exactly zero; upper is inf where nothing is known.
    """

    lower: float
    upper: float
    at: Optional[tuple[float, float, float]] = None
    converged: Optional[bool] = None

    def __repr__(self) -> str:
        return "0" if self.lower == self.upper == 0 else (
            f"[{_number(self.lower, decimal.ROUND_FLOOR)}, {_number(self.upper, decimal.ROUND_CEILING)}]")


@dataclasses.dataclass(frozen=True)
class Witness:
    """Exact numbers that refute a class: `quantity` should be zero (or of one sign) and is `values` at the parameters a of
    the first patch and b of the second (u, v). What is neither a fraction nor a number of Q(√d) is a text."""

    quantity: str
    a: tuple[Union[Exact, str], Union[Exact, str]]
    b: tuple[Union[Exact, str], Union[Exact, str]]
    values: tuple[Union[Exact, str], ...]


@dataclasses.dataclass(frozen=True, repr=False)
class Verdict:
    """ "proven", "refuted" or "undecided", with the reason, and a witness where one refutes it."""

    verdict: str
    reason: str = ""
    witness: Optional[Witness] = None

    @property
    def is_proven(self) -> bool:
        return self.verdict == "proven"

    @property
    def is_refuted(self) -> bool:
        return self.verdict == "refuted"

    def __bool__(self) -> NoReturn:
        raise TypeError("a verdict is proven, refuted or undecided: ask for .is_proven or .verdict")

    def __repr__(self) -> str:
        return f"<{self.verdict}{': ' if self.reason else ''}{self.reason}>"


class JoinSide(NamedTuple):
    """One side of a join: a patch (its number), its edge ("u_min", or "u = 1/2" for a line inside the patch), and the exact
    parameters along it in the order in which the join runs through them."""

    patch: int
    edge: str
    range: tuple[Union[Exact, str], Union[Exact, str]]


@dataclasses.dataclass(frozen=True, repr=False)
class Join:
    """What is proved of one join. Lengths are in the model's units, angles in degrees.

    id           its number in the table and in the JSON, from 1
    a, b         the two sides; reversed: their parameters run against each other
    c0 … g1      verdicts on the classes, over the whole join
    ratio        the exact λ > 0 with y_s = −λ·x_s of the derivatives across it, None where there is none
    gap          the largest distance, at paired parameters
    angle        the largest angle between the normals, in [0, 180]; plane_angle between the tangent planes, in [0, 90]
    orientation  "smooth", "cusp" (all along more than 90°), "mixed" or "unknown"
    outcome      "pass", "fail" or "undecided", of what certify was asked; `reason` says why
    """

    id: int
    a: JoinSide
    b: JoinSide
    reversed: bool
    c0: Verdict
    c1: Verdict
    c2: Verdict
    g1: Verdict
    ratio: Union[Exact, str, None]
    gap: Bounds
    angle: Bounds
    plane_angle: Bounds
    orientation: str
    outcome: str
    reason: str

    @property
    def strongest(self) -> str:
        """The strongest class that is proven: "C2", "C1", "G1", "C0", or "" where none is."""
        classes = (("C2", self.c2), ("C1", self.c1), ("G1", self.g1), ("C0", self.c0))
        return next((name for name, verdict in classes if verdict.is_proven), "")

    def __repr__(self) -> str:
        sides = " | ".join(f"patch {side.patch} {side.edge}" for side in (self.a, self.b))
        return (f"<Join {self.id}: {sides}, {self.strongest or 'no class proven'}, gap {self.gap!r}, "
                f"angle {self.angle!r} degrees, {self.outcome}>")


@dataclasses.dataclass(frozen=True, repr=False)
class CurveJoin:
    """Two ends of curves that meet. a, b: (number of the curve, "begin" or "end"); point: where, on the first.

    gap is the distance, angle the one between the directions of travel (degrees), curvature the difference of the curvature
    vectors (1/length): each is one exact number, enclosed; "unknown" where there is none. The report's JSON has more.
    """

    id: int
    a: tuple[int, str]
    b: tuple[int, str]
    point: tuple[float, float, float]
    c0: Verdict
    c1: Verdict
    c2: Verdict
    g1: Verdict
    g2: Verdict
    gap: Bounds
    angle: Bounds
    curvature: Bounds
    outcome: str
    reason: str

    @property
    def strongest(self) -> str:
        """The strongest class that is proven: "C2", "G2", "C1", "G1", "C0", or "" where none is."""
        classes = (("C2", self.c2), ("G2", self.g2), ("C1", self.c1), ("G1", self.g1), ("C0", self.c0))
        return next((name for name, verdict in classes if verdict.is_proven), "")

    def __repr__(self) -> str:
        ends = " | ".join(f"curve {curve} {end}" for curve, end in (self.a, self.b))
        return (f"<CurveJoin {self.id}: {ends}, {self.strongest or 'no class proven'}, gap {self.gap!r}, "
                f"angle {self.angle!r} degrees, {self.outcome}>")


@dataclasses.dataclass(frozen=True)
class ReportSummary:
    """A report in numbers: joins of patches, how they stand, and the largest gap and angle (degrees) over all of them; joins of
    curves, and how they stand. unmatched_edges have no partner near enough: they are no joins, and no gap counts them."""

    outcome: str
    joins: int
    passed: int
    failed: int
    undecided: int
    curve_joins: int
    curve_passed: int
    curve_failed: int
    curve_undecided: int
    unmatched_edges: int
    collapsed_edges: int
    gregory_patches: int
    largest_gap: Bounds
    largest_angle: Bounds


class Proofs(NamedTuple):
    """How many of something are proven, refuted and undecided."""

    proven: int
    refuted: int
    undecided: int


@dataclasses.dataclass(frozen=True)
class FillSummary:
    """What a filled curve mesh has and what is proved of it: g1 across the edges between faces, c1 inside the patches,
    regular: normals that vanish nowhere. findings: what is not proven, a text each."""

    faces: int
    smooth_edges: int
    sharp_edges: int
    boundary_edges: int
    g1: Proofs
    c1: Proofs
    regular: Proofs
    findings: tuple[str, ...]
