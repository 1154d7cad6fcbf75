#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""A walk through patchproof, from a file to proofs and pictures: python3 tutorial.py [FOLDER FOR PICTURES]

It reads models of examples/, prints what it finds, and draws with matplotlib. Each step is a function that can be copied.
"""
import pathlib
import sys
from collections import Counter
from fractions import Fraction

import matplotlib
import matplotlib.pyplot as plt
import numpy as np
from mpl_toolkits.mplot3d.art3d import Poly3DCollection

import patchproof

EXAMPLES = pathlib.Path(__file__).resolve().parents[1] / "examples"
BLUE, ORANGE, GREEN, GREY = "#3b6fb6", "#d9822b", "#3f9e6b", "#8a8f98"


def space(title, elevation=22, azimuth=-60):
    """An axis for things in space, without a box around them."""
    figure = plt.figure(figsize=(6.4, 5.2), layout="constrained")
    axis = figure.add_subplot(projection="3d", elev=elevation, azim=azimuth)
    axis.set_title(title)
    axis.set_axis_off()
    return figure, axis


def frame(axis, points):
    """Equal scales on all three axes, around the points."""
    low, high = points.reshape(-1, 3).min(axis=0), points.reshape(-1, 3).max(axis=0)
    for set_limits, a, b in zip((axis.set_xlim, axis.set_ylim, axis.set_zlim), low, high):
        set_limits(a, b)
    axis.set_box_aspect(np.maximum(high - low, 1e-3 * (high - low).max()), zoom=1.05)


def shaded(grids, colours):
    """The cells of grids of points (faces, m, n, 3), each face in its colour, under a light from the upper left."""
    corners = [grids[:, :-1, :-1], grids[:, 1:, :-1], grids[:, 1:, 1:], grids[:, :-1, 1:]]
    normals = np.cross(corners[2] - corners[0], corners[3] - corners[1])
    normals /= np.linalg.norm(normals, axis=-1, keepdims=True)
    light = 0.55 + 0.45 * np.abs(normals @ (np.array([-0.5, -0.6, 0.62])))
    paint = np.clip(light[..., None] * np.asarray(colours)[:, None, None], 0, 1).reshape(-1, 3)
    return Poly3DCollection(np.stack(corners, axis=-2).reshape(-1, 4, 3), facecolor=paint, edgecolor=paint, linewidth=0.3)


def a_patch(folder):
    """1. A model, and one of its patches. Arrays go in, arrays come out; nothing is copied on the way."""
    model = patchproof.read(EXAMPLES / "cup.json")
    print(model)
    patch = next(p for p in model.patches if p.name == "handle2-right")
    print(patch, "over", patch.domain)

    # Any float64 array of shape (..., 2) is taken as it lies. Here 30 × 30 places, on a grid, with unit normals.
    u, v = np.linspace(0, 1, 30), np.linspace(0, 1, 30)
    surface = patch.evaluate_grid(u, v, normal=True)
    print("points", surface.point.shape, "in", model.units, "- each coordinate within", patch.error_bound("point"))

    figure, axis = space(f"{patch.name}: lines of equal u and v, control points, normals", azimuth=-35)
    axis.plot_surface(*np.moveaxis(surface.point, -1, 0), color=BLUE, alpha=0.25, linewidth=0)
    for t in np.linspace(0, 1, 7):  # isolines: (u, t) and (t, v)
        for line in (patch.evaluate_grid([t], v)[0], patch.evaluate_grid(u, [t])[:, 0]):
            axis.plot(*line.T, color=BLUE, linewidth=1)
    net = patch.points
    axis.plot_wireframe(*np.moveaxis(net, -1, 0), color=GREY, linewidth=0.7)
    axis.scatter(*net.reshape(-1, 3).T, color=ORANGE, s=14)
    feet = surface.point[::6, ::6].reshape(-1, 3)
    length = 0.1 * np.ptp(net.reshape(-1, 3), axis=0).max()
    axis.quiver(*feet.T, *surface.normal[::6, ::6].reshape(-1, 3).T, length=length, color=GREEN, linewidth=0.8)
    frame(axis, np.concatenate([net.reshape(-1, 3), feet]))
    figure.savefig(folder / "1_patch.png")


def exact_numbers(folder):
    """2. Exact numbers: what goes in as a fraction comes out as one, and shows how far doubles are off."""
    torus, cup = (patchproof.read(EXAMPLES / name) for name in ("torus.json", "cup.json"))
    print("\nexactly, at u = 1/3, v = 1/4:")
    for patch in (cup.patches[0], torus.patches[0]):
        print("  ", patch.name or patch, [str(x) for x in patch.evaluate_exact(("1/3", "1/4"))])
    derivatives = cup.patches[0].evaluate_exact((Fraction(1, 3), Fraction(1, 4)), order=2)
    print("   its mixed derivative", [str(x) for x in derivatives[1, 1]])

    # Three ways to a coordinate in double: fast, fast with a bound of its own, and correctly rounded.
    patch = torus.patches[0]
    uv = np.random.default_rng(1).random((20000, 2))
    points, bounds = patch.evaluate_bounded(uv)
    errors = np.abs(points - patch.evaluate_rounded(uv)).max(axis=1)
    assert (errors <= bounds).all()
    figure, axis = plt.subplots(figsize=(6.4, 4.2), layout="constrained")
    places = np.geomspace(1e-17, 1e-13, 60)
    axis.hist(np.maximum(errors, 1e-17), places, color=BLUE, label="distance to the correctly rounded point")
    axis.hist(bounds, places, color=ORANGE, alpha=0.8, label="bound proved for that very point")
    axis.axvline(patch.error_bound("point"), color=GREY, linestyle="--", label="bound for every point of the patch")
    axis.set(xscale="log", xlabel="largest error of a coordinate", ylabel="points",
             title=f"20 000 points of a patch of the torus")
    axis.legend()
    figure.savefig(folder / "2_errors.png")


def a_kink(folder):
    """3. A join that is smooth wherever one samples it, and is not: a proof sees the whole edge."""
    model = patchproof.read(EXAMPLES / "seven" / "kink_between_samples.json")
    report = patchproof.certify(model, require="G1", angle=0.1)
    print("\n", report)
    join = report.joins[0]
    print(join, "because", join.reason)
    witness = join.g1.witness
    print("G1 is refuted by", witness.quantity, "=", [str(x) for x in witness.values], "at", [str(x) for x in witness.a])

    def angles(v):
        """Between the normals of both patches along their common edge."""
        normals = []
        for side in (join.a, join.b):
            along = np.column_stack([np.full_like(v, 1.0 if side.edge == "u_max" else 0.0), v])
            normals.append(model.patches[side.patch].evaluate(along, normal=True).normal)
        return np.degrees(np.arctan2(np.linalg.norm(np.cross(*normals), axis=1), np.sum(normals[0] * normals[1], axis=1)))

    fine, samples = np.linspace(0, 1, 4001), np.linspace(0, 1, 21)
    figure, axis = plt.subplots(figsize=(6.4, 4.2), layout="constrained")
    axis.axhspan(join.angle.lower, join.angle.upper, color=ORANGE, label=f"proved: the largest angle lies in {join.angle}°")
    axis.plot(fine, angles(fine), color=BLUE, label="angle between the normals")
    axis.plot(samples, angles(samples), "o", color=GREEN, label=f"21 samples: at most {angles(samples).max():.3g}°")
    axis.annotate("attained here", (join.angle.at[1], join.angle.lower), (join.angle.at[1] + 0.1, join.angle.lower - 12),
                  arrowprops={"arrowstyle": "->", "color": GREY})
    axis.set(xlabel="v along the edge", ylabel="degrees", title="An edge with a kink between two samples", ylim=(-3, 105))
    axis.legend(loc="upper left")
    figure.savefig(folder / "3_kink.png")


def a_filled_mesh(folder):
    """4. A mesh of curves becomes a surface: one Gregory patch for each face, and a proof that they join."""
    model, summary = patchproof.fill(EXAMPLES / "meshes" / "football.json")
    print("\nfilled:", summary.faces, "faces; edges that are G1 across:", summary.g1)
    middle = model.patches[0].evaluate_exact(("1/2", "1/2"))
    print(model.patches[0], "has its middle at", middle.astype(float), "or, exactly, at fractions of",
          [len(str(x)) for x in middle], "characters")

    # Gregory patches have exact values only; a handful of places on each face is enough for a picture.
    u, v = np.meshgrid(*2 * [np.linspace(0, 1, 5)], indexing="ij")
    grids = np.array([p.evaluate_exact(np.stack([u, v], axis=-1)).astype(float) for p in model.patches])
    figure, axis = space("A football of curves, filled with Gregory patches")
    sides = Counter(p.name.split(".")[0] for p in model.patches)  # "F7.2" is a part of face 7
    colours = [(0.25, 0.29, 0.36) if sides[p.name.split(".")[0]] == 5 else (0.93, 0.94, 0.96) for p in model.patches]
    axis.add_collection3d(shaded(grids, colours))
    frame(axis, grids)
    figure.savefig(folder / "4_filled.png")


def triangles(folder):
    """5. Triangles that are proved to be near enough, for a printer or a renderer."""
    cup = patchproof.read(EXAMPLES / "cup.json")
    figure = plt.figure(figsize=(9.6, 4.4), layout="constrained")
    for place, chord in enumerate((2.0, 0.2)):
        mesh = patchproof.tessellate(cup, chord)
        print(mesh)
        axis = figure.add_subplot(1, 2, place + 1, projection="3d", elev=25, azim=-60)
        axis.plot_trisurf(*mesh.vertices.T, triangles=mesh.triangles, color="#c8d4e6", edgecolor=BLUE, linewidth=0.25)
        axis.set_title(f"{len(mesh.triangles)} triangles, {mesh.chord:.3g} {cup.units} away at most")
        axis.set_axis_off()
        frame(axis, mesh.vertices)
    mesh.write(folder / "cup.stl")
    figure.savefig(folder / "5_triangles.png")


def your_own(folder):
    """6. A model of one's own arrays: two Bézier patches, one of them moved by hand, and what that does to the join."""
    x, y = np.meshgrid(np.linspace(0, 1, 4), np.linspace(0, 1, 4), indexing="ij")
    left = np.stack([x, y, 0.3 * np.sin(2 * y)], axis=-1)
    right = left + [1, 0, 0]
    lifts, bounds = np.linspace(0, 0.05, 6), []
    for lift in lifts:
        moved = right.copy()
        moved[1, 2, 2] += lift  # one control point beside the edge
        model = patchproof.Model([patchproof.PatchData(left), patchproof.PatchData(moved)], units="m")
        join = patchproof.certify(model).joins[0]
        bounds.append((join.angle.lower, join.angle.upper))
    print("\nafter the last move:", join)
    figure, axis = plt.subplots(figsize=(6.4, 4.2), layout="constrained")
    axis.plot(lifts, [high for _, high in bounds], "v", color=ORANGE, label="is proved to be the most")
    axis.plot(lifts, [low for low, _ in bounds], "^", color=BLUE, label="is attained")
    axis.set(xlabel="lift of one control point, m", ylabel="angle along the edge, degrees",
             title="What moving a control point does to a join")
    axis.legend()
    figure.savefig(folder / "6_moved.png")


def main():
    folder = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else ".")
    folder.mkdir(parents=True, exist_ok=True)
    if not sys.flags.interactive:
        matplotlib.use("Agg")  # pictures go to files; no display is needed
    for step in (a_patch, exact_numbers, a_kink, a_filled_mesh, triangles, your_own):
        step(folder)
        plt.close("all")
    print("\npictures in", folder.resolve())


if __name__ == "__main__":
    main()
