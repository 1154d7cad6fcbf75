# SPDX-License-Identifier: Apache-2.0
"""Patches, curves and joins given by arrays, brought into the form that the extension hands on."""
from __future__ import annotations

import operator
from typing import Any, NamedTuple, Optional

import numpy as np
from numpy.typing import ArrayLike, NDArray

EDGES = ("u_min", "u_max", "v_min", "v_max")


class PatchData(NamedTuple):
    """A B-spline or NURBS patch in doubles, each taken as exactly the number that it is.

    points   (nu, nv, 3), lengths in the model's units
    weights  (nu, nv), None: all are 1
    degree   (p, q), knots (ku, kv) with nu + p + 1 and nv + q + 1 knots. Both None: a Bézier patch over [0, 1] × [0, 1].
    """

    points: ArrayLike
    weights: Optional[ArrayLike] = None
    degree: Optional[tuple[int, int]] = None
    knots: Optional[tuple[ArrayLike, ArrayLike]] = None
    name: str = ""


class CurveData(NamedTuple):
    """A B-spline or NURBS curve in doubles: points (n, 3), weights (n,) or None, n + degree + 1 knots (None: Bézier)."""

    points: ArrayLike
    weights: Optional[ArrayLike] = None
    degree: Optional[int] = None
    knots: Optional[ArrayLike] = None
    name: str = ""


class DeclaredJoin(NamedTuple):
    """Two whole edges ("u_min", "u_max", "v_min", "v_max") of patches that belong together; reversed: their parameters run
    against each other."""

    patch_a: int
    edge_a: str
    patch_b: int
    edge_b: str
    reversed: bool = False


def doubles(value: Any, name: str, dimensions: int) -> NDArray[np.float64]:
    """A C-ordered float64 array of `value`, whose numbers all are doubles."""
    array = np.asarray(value)
    if array.dtype.kind not in "fiu" or array.dtype.itemsize > 8:
        raise TypeError(f"{name}: an array of {array.dtype}; numbers that are doubles are needed (exact ones go through "
                        "read_text)")
    if array.ndim != dimensions or (dimensions > 1 and name.endswith("points") and array.shape[-1] != 3):
        shape = {1: "(n,)", 2: "(n, 3)" if name.endswith("points") else "(nu, nv)", 3: "(nu, nv, 3)"}[dimensions]
        raise TypeError(f"{name}: an array of shape {array.shape}; {shape} is needed")
    if array.dtype.kind in "iu" and array.itemsize == 8 and array.size and \
            max(abs(int(array.max())), abs(int(array.min()))) > 2**53:
        raise TypeError(f"{name}: whole numbers beyond 2**53 are no doubles")
    return np.ascontiguousarray(array, dtype=np.float64)


def bezier_knots(degree: int) -> NDArray[np.float64]:
    return np.repeat([0.0, 1.0], degree + 1)


def _check(data: Any, name: str) -> None:
    if not hasattr(data, "points") or not hasattr(data, "knots"):
        raise TypeError(f"{name}: {type(data).__name__} has no points and knots; give PatchData or CurveData")
    if data.points is None:
        raise TypeError(f"{name}: a patch or curve without control points, {data!r}")
    if getattr(data, "is_double", True) is False:
        raise TypeError(f"{name}: {data!r} has numbers that are no doubles; model.to_json() keeps them")
    if (data.degree is None) != (data.knots is None):
        raise TypeError(f"{name}: degree and knots are given together, or none of them")


def patch(data: Any, number: int) -> tuple[Any, ...]:
    name = f"patches[{number}]"
    _check(data, name)
    points = doubles(data.points, f"{name}.points", 3)
    weights = None if data.weights is None else doubles(data.weights, f"{name}.weights", 2)
    if weights is not None and weights.shape != points.shape[:2]:
        raise TypeError(f"{name}.weights: an array of shape {weights.shape}; {points.shape[:2]} is needed")
    if data.degree is None:
        degree: tuple[int, ...] = (points.shape[0] - 1, points.shape[1] - 1)
        knots: tuple[NDArray[np.float64], ...] = (bezier_knots(degree[0]), bezier_knots(degree[1]))
    else:
        degree = tuple(operator.index(d) for d in data.degree)
        knots = tuple(doubles(k, f"{name}.knots", 1) for k in data.knots)
        if len(degree) != 2 or len(knots) != 2:
            raise TypeError(f"{name}: two degrees and two knot vectors are needed")
        for d, direction in enumerate("uv"):
            if len(knots[d]) != points.shape[d] + degree[d] + 1:
                raise ValueError(f"{name}.knots: {len(knots[d])} along {direction}; {points.shape[d]} control points of degree "
                                 f"{degree[d]} take {points.shape[d] + degree[d] + 1}")
    return degree, knots, points, weights, str(data.name)


def curve(data: Any, number: int) -> tuple[Any, ...]:
    name = f"curves[{number}]"
    _check(data, name)
    points = doubles(data.points, f"{name}.points", 2)
    weights = None if data.weights is None else doubles(data.weights, f"{name}.weights", 1)
    if weights is not None and len(weights) != len(points):
        raise TypeError(f"{name}.weights: an array of shape {weights.shape}; ({len(points)},) is needed")
    degree = len(points) - 1 if data.degree is None else operator.index(data.degree)
    knots = bezier_knots(degree) if data.knots is None else doubles(data.knots, f"{name}.knots", 1)
    return degree, knots, points, weights, str(data.name)


def join(data: Any, number: int) -> tuple[int, int, int, int, bool]:
    try:
        made = DeclaredJoin(*data)
        edges = [EDGES.index(edge) for edge in (made.edge_a, made.edge_b)]
    except (TypeError, ValueError):
        raise TypeError(f"joins[{number}]: {data!r}; DeclaredJoin(patch_a, edge_a, patch_b, edge_b, reversed) is needed, edges "
                        f"{', '.join(EDGES)}") from None
    return int(made.patch_a), edges[0], int(made.patch_b), edges[1], bool(made.reversed)
