# SPDX-License-Identifier: Apache-2.0
"""Models, reports, fillings and meshes as objects of Python."""
import io
import json
import math
from fractions import Fraction

import numpy as np
import pytest

import oracle
import patchproof
from conftest import random_patch


def plane(x0, x1, z=0.0):
    """Points of a bicubic patch over [x0, x1] × [0, 1]."""
    x = [x0, x0 + (x1 - x0) / 4, x0 + (x1 - x0) / 2, x1]
    return np.array([[[x[i], j / 4, z] for j in range(4)] for i in range(4)])


def test_a_model(examples, tmp_path):
    model = patchproof.read(examples / "cup.json")
    assert repr(model) == "<patchproof.Model: 35 patches, 0 curves, mm>"
    assert (model.units, model.format, model.solids, model.curves) == ("mm", "patchproof-model", 0, ())
    assert model.patches is model.patches and len(model.patches) == 35
    foot = next(p for p in model.patches if p.name == "foot1")
    assert repr(foot).startswith(f"<patchproof.Patch {foot.index} 'foot1': bspline of degree (")
    assert foot.kind == "bspline" and foot.knots[0].shape == (foot.points.shape[0] + foot.degree[0] + 1,)
    assert foot.points.shape[2] == 3 and foot.domain == ((0, 1), (0, 1))
    assert foot.weights is None or foot.weights.shape == foot.points.shape[:2]
    again = patchproof.read_text(model.to_json(), "again.json")
    assert json.loads(again.to_json()) == json.loads(model.to_json())
    (tmp_path / "cup.g2").write_text(model.to_g2())
    assert patchproof.read(str(tmp_path / "cup.g2")).format == "g2"
    assert patchproof.read(bytes(tmp_path / "cup.g2")).patches[3].degree == model.patches[3].degree
    assert patchproof.read_text(model.to_g2().encode(), "cup.g2").patches[3].degree == model.patches[3].degree


def test_a_model_from_arrays():
    data = random_patch(11, rational=True)
    curve = patchproof.CurveData([[0, 0, 0], [1, 2, 0], [3, 0, 1]], weights=[1, 2, 1], name="arc")
    bezier = patchproof.PatchData(np.arange(48.0).reshape(4, 4, 3))
    model = patchproof.Model([data, bezier], curves=[curve], units="inch")
    assert (model.units, len(model.patches), len(model.curves)) == ("inch", 2, 1)
    patch = model.patches[0]
    assert patch.name == "random 11" and patch.is_rational and patch.is_double and patch.degree == (3, 3)
    assert np.array_equal(patch.points, data.points) and np.array_equal(patch.weights, data.weights)
    assert all(np.array_equal(a, b) for a, b in zip(patch.knots, data.knots))
    assert model.patches[1].degree == (3, 3) and model.patches[1].weights is None
    assert model.curves[0].degree == 2 and np.array_equal(model.curves[0].weights, [1, 2, 1])
    assert repr(model.curves[0]) == "<patchproof.Curve 0 'arc': bspline of degree 2, 3 points, rational>"
    assert patchproof.Model((patch for patch in model.patches)).patches[0].name == "random 11"


def test_a_report_of_a_kink():
    points = plane(1, 2)
    points[1:, :, 2] = 0.25
    kinked = patchproof.Model([patchproof.PatchData(plane(0, 1)), patchproof.PatchData(points)])
    report = patchproof.certify(kinked, require="G1")
    assert (report.outcome, len(report.joins)) == ("fail", 1)
    join = report.joins[0]
    assert [join.c0.verdict, join.c1.verdict, join.g1.verdict] == ["proven", "refuted", "refuted"]
    assert (join.a.patch, join.a.edge, join.b.patch, join.b.edge) == (0, "u_max", 1, "u_min")
    assert join.a.range == (Fraction(0), Fraction(1)) and not join.reversed
    assert join.strongest == "C0" and join.outcome == "fail" and join.reason
    assert join.c0.is_proven and join.g1.is_refuted and join.g1.reason and join.c0.witness is None
    # The witness is checked, not believed: the derivatives across the edge are not parallel at these parameters.
    witness = join.g1.witness
    a, b = (oracle.surface(p, *at) for p, at in zip(kinked.patches, (witness.a, witness.b)))
    normals = [np.cross([float(x) for x in s[1, 0]], [float(x) for x in s[0, 1]]) for s in (a, b)]
    assert np.linalg.norm(np.cross(*normals)) > 0.01
    assert witness.values and all(isinstance(x, Fraction) for x in witness.values) and any(witness.values)
    assert join.angle.lower <= 45 <= join.angle.upper and join.angle.converged
    assert join.plane_angle.upper >= join.plane_angle.lower > 44
    assert join.gap.lower == join.gap.upper == 0 and repr(join.gap) == "0"
    assert join.angle.at[0] == 1
    assert repr(join).startswith("<Join 1: patch 0 u_max | patch 1 u_min, C0, gap 0, angle [") and "fail" in repr(join)
    assert repr(report).startswith("<patchproof.Report: fail, 1 joins, gap 0, angle [")
    summary = report.summary
    assert (summary.joins, summary.failed, summary.passed, summary.undecided, summary.outcome) == (1, 1, 0, 0, "fail")
    assert summary.largest_angle.lower == join.angle.lower and summary.unmatched_edges == 6
    document = json.loads(report.to_json())
    assert document["verdict"] == "fail" and len(document["joins"]) == 1
    assert "refuted" in report.to_json() and "u_max" in report.table()


def test_reports_and_verdicts_are_neither_true_nor_false():
    report = patchproof.certify(patchproof.Model([patchproof.PatchData(plane(0, 1)), patchproof.PatchData(plane(1, 2))]))
    with pytest.raises(TypeError, match="outcome"):
        bool(report)
    with pytest.raises(TypeError, match="is_proven"):
        bool(report.joins[0].c0)
    assert report.outcome == "pass" and report.joins[0].c0.is_proven


@pytest.mark.parametrize("require, gap, angle, outcome", [
    (None, None, None, "pass"), ("C0", None, None, "fail"), (None, 0.002, None, "pass"), (None, 0.0005, None, "fail"),
    (None, None, 0.1, "pass"), (None, 0.002, 1e-9, "pass")])
def test_requests(require, gap, angle, outcome):
    two = [patchproof.PatchData(plane(0, 1)), patchproof.PatchData(plane(1, 2, z=2.0**-10))]
    report = patchproof.certify(patchproof.Model(two), require, gap, angle, match=0.01)
    assert len(report.joins) == 1 and report.outcome == outcome
    assert report.joins[0].gap.lower <= 2.0**-10 <= report.joins[0].gap.upper


def test_the_report_does_not_depend_on_jobs(cup):
    one, two = (patchproof.certify(cup, jobs=jobs) for jobs in (1, 2))
    assert one.to_json() == two.to_json() and one.joins == two.joins
    assert one.summary.joins == 65 and len(one.joins) == 65
    assert sum(join.strongest == "C0" for join in one.joins) == 4
    ratio = next(join.ratio for join in one.joins if join.a.edge == "u_max" and join.strongest == "G1" and join.ratio)
    assert isinstance(ratio, Fraction)


def test_nothing_judged_is_undecided():
    alone = patchproof.Model([patchproof.PatchData(plane(0, 1))])
    report = patchproof.certify(alone, require="C0")
    assert report.outcome == "undecided" and report.joins == ()


def test_numbers_of_the_report_with_a_root(examples):
    report = patchproof.certify(patchproof.read(examples / "torus.json"))
    assert report.outcome == "pass" and len(report.joins) > 4 and all(j.c0.is_proven for j in report.joins)


def test_a_filled_mesh(examples):
    calls = []
    model, summary = patchproof.fill(examples / "meshes" / "two_faces.json", progress=lambda *done: calls.append(done))
    assert summary.faces == 2 and summary.smooth_edges == 1 and summary.boundary_edges == 6
    assert summary.g1 == (1, 0, 0) and summary.g1.proven == 1 and summary.regular.refuted == 0
    assert summary.findings == () and len(model.patches) == summary.faces
    assert {p.kind for p in model.patches} == {"gregory"} and "g1" in repr(summary)
    text = (examples / "meshes" / "two_faces.json").read_text()
    again, _ = patchproof.fill_text(text, "two_faces.json")
    assert again.to_json() == model.to_json()
    assert patchproof.certify(model).outcome == "pass"


def test_a_mesh(examples, tmp_path):
    model = patchproof.read(examples / "sphere_octants.json")
    mesh = patchproof.tessellate(model, 0.01, angle=5)
    n, m = len(mesh.vertices), len(mesh.triangles)
    assert mesh.vertices.shape == (n, 3) and mesh.vertices.dtype == np.float64
    assert mesh.triangles.shape == (m, 3) and mesh.triangles.dtype == np.int32 and mesh.patches.shape == (m,)
    assert mesh.triangles.min() == 0 and mesh.triangles.max() == n - 1
    assert set(mesh.patches) == set(range(len(model.patches)))
    assert mesh.is_watertight and mesh.is_oriented and (mesh.is_closed == (mesh.free_edges == 0))
    assert 0 < mesh.chord <= 0.01 and 0 < mesh.angle <= 5 and mesh.chord_misses == mesh.angle_misses == 0
    assert mesh.vertices is mesh.vertices and not mesh.vertices.flags.writeable
    # The proved chord is no smaller than what is seen: the radius of vertices and of the triangles' centres.
    radius = np.linalg.norm(mesh.vertices, axis=1).max()
    centres = np.linalg.norm(mesh.vertices[mesh.triangles].mean(axis=1), axis=1)
    assert 0 < radius - centres.min() <= mesh.chord * 1.0001
    assert repr(mesh).startswith(f"<patchproof.Mesh: {m} triangles, chord 0.0")
    stl = mesh.to_bytes("stl")
    assert len(stl) == 84 + 50 * m and int.from_bytes(stl[80:84], "little") == m
    for format, start in [("ply", b"ply\n"), ("glb", b"glTF"), ("vtu", b"<"), ("obj", b"")]:
        mesh.write(tmp_path / f"sphere.{format.upper()}")
        assert (tmp_path / f"sphere.{format.upper()}").read_bytes() == mesh.to_bytes(format)
        assert mesh.to_bytes(format).lstrip().startswith(start)
    mesh.write(str(tmp_path / "data.bin"), format="stl")
    assert (tmp_path / "data.bin").read_bytes() == stl
    for path, error in [("x.bmp", ValueError), ("x", ValueError), ("no/such/folder/x.stl", OSError)]:
        with pytest.raises(error):
            mesh.write(tmp_path / path)
    assert not (tmp_path / "x.bmp").exists()
    regular = patchproof.tessellate(model, 0.01, method="regular", jobs=1)
    assert len(regular.triangles) > 0 and regular.is_watertight


def test_values_print_themselves():
    assert repr(patchproof.Bounds(1.25, math.inf)) == "[1.25, unknown]"
    assert repr(patchproof.Verdict("refuted", "there is a kink")) == "<refuted: there is a kink>"
    stream = io.StringIO()
    print(patchproof.Derivatives(point=np.zeros(3)), file=stream)
    assert "point=" in stream.getvalue()


def test_profiles_and_curvature():
    points = plane(1, 2)
    points[1:, :, 2] = 0.25
    kinked = patchproof.Model([patchproof.PatchData(plane(0, 1)), patchproof.PatchData(points)], units="mm")
    assert patchproof.certify(kinked, profile="vda4955").outcome == "fail"
    assert patchproof.certify(kinked, angle=180.0, profile="vda4955").outcome == "pass"
    with pytest.raises(ValueError, match="profile"):
        patchproof.certify(kinked, profile="none such")
    with pytest.raises(ValueError, match="curvature_tolerance"):
        patchproof.certify(kinked, curvature=-1.0)


def test_joins_of_curves():
    corner = [patchproof.CurveData([[0, 0, 0], [1, 0, 0]]), patchproof.CurveData([[1, 0, 0], [1, 1, 0]])]
    report = patchproof.certify(patchproof.Model(curves=corner), require="C1")
    assert report.outcome == "fail" and report.joins == () and "1 joins of curves" in repr(report)
    (join,) = report.curve_joins
    assert (join.id, join.a, join.b, join.point) == (1, (0, "end"), (1, "begin"), (1, 0, 0))
    assert join.c0.is_proven and join.g1.is_refuted and join.strongest == "C0" and join.gap.upper == 0
    assert join.angle.lower <= 90 <= join.angle.upper < 90.001 and "curve 0 end | curve 1 begin" in repr(join)
    assert (report.summary.curve_joins, report.summary.curve_failed) == (1, 1)


def test_printed_bounds_are_bounds(cup):
    for join in patchproof.certify(cup).joins:
        for bounds in (join.gap, join.angle):
            shown = repr(bounds).strip("[]").split(", ")
            assert float(shown[0]) <= bounds.lower and float(shown[-1]) >= bounds.upper


def test_filled_models_are_no_g2(examples):
    model, _ = patchproof.fill(examples / "meshes" / "two_faces.json")
    with pytest.raises(patchproof.Error, match="Gregory"):
        model.to_g2()
