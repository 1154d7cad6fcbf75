# SPDX-License-Identifier: Apache-2.0
"""What callers do wrong ends in an exception that says what, and never in a crash, a silent copy or a wrong number."""
import copy
import gc
import itertools
import math
import pickle
from fractions import Fraction

import numpy as np
import pytest

import patchproof
from conftest import random_parameters, random_patch

UV = np.full((8, 2), 0.1)


def bad_arrays():
    packed = np.zeros(8, dtype=np.dtype([("tag", "i1"), ("uv", "2f8")]))["uv"]  # doubles at odd addresses
    return {
        "float32": UV.astype(np.float32), "integers": np.zeros((8, 2), dtype=int), "complex": UV.astype(complex),
        "longdouble": UV.astype(np.longdouble), "objects": UV.astype(object), "texts": np.full((8, 2), "0.1"),
        "big-endian": UV.astype(">f8"), "booleans": UV > 0, "not aligned": packed,
        "three columns": np.zeros((8, 3)), "one axis": np.zeros(8), "no axis": np.float64(0.1),
        "backwards": UV[::-1], "broadcast": np.broadcast_to([0.1, 0.1], (8, 2)), "gaps": np.zeros((4, 6, 2))[:, ::2][:, :2],
    }


@pytest.mark.parametrize("name", bad_arrays())
def test_arrays_that_are_refused(name, bspline):
    bad = bad_arrays()[name]
    for call in (bspline.evaluate, bspline.evaluate_bounded, bspline.enclose, bspline.evaluate_rounded):
        with pytest.raises(TypeError) as raised:
            call(bad)
        assert "uv:" in str(raised.value)
        if isinstance(bad, np.ndarray):
            assert str(bad.shape) in str(raised.value) and str(bad.dtype) in str(raised.value)
    if np.ndim(bad) == 2 and np.shape(bad)[1] == 2:
        with pytest.raises(TypeError):
            bspline.evaluate((bad[:, 0], bad[:, 1]))


def test_pairs_that_are_refused(bspline):
    x = np.zeros(8)
    for pair in [(x, np.zeros(7)), (x, np.zeros((8, 1))), (x,), (x, x, x), (x, np.zeros(16)[::2]), (x, 0.5), (x, None),
                 (x, "0.5"), ("a", "b"), ({}, x)]:
        with pytest.raises((TypeError, ValueError)):
            bspline.evaluate(pair)
    for nonsense in [None, "uv", {}, object(), [], [[0.1, "x"]], [[1, 2], [3]], 0.5]:
        with pytest.raises((TypeError, ValueError)):
            bspline.evaluate(nonsense)
    for u, v in [(np.zeros((2, 2)), x), (np.zeros(16)[::2], x), (x, np.float64(0)), (None, x)]:
        with pytest.raises((TypeError, ValueError)):
            bspline.evaluate_grid(u, v)


@pytest.mark.parametrize("value", [math.nan, math.inf, -math.inf, 1e300, -0.6])
def test_parameters_outside_the_domain(value, bspline, curve):
    uv = UV.copy()
    uv[5, 1] = value
    for call in (bspline.evaluate, bspline.evaluate_bounded, bspline.enclose, bspline.evaluate_rounded, bspline.evaluate_exact):
        with pytest.raises(patchproof.Error) as raised:
            call(uv)
        assert raised.value.code in ("outside_domain", "bad_number")
        assert "5" in raised.value.where + raised.value.message + raised.value.values
    with pytest.raises(patchproof.Error):
        bspline.evaluate(uv, threads=3)
    with pytest.raises(patchproof.Error):
        bspline.evaluate_grid([0.1], [0.1, value])
    with pytest.raises(patchproof.Error):
        curve.evaluate([0.1, value])


def test_outs_that_are_refused(bspline):
    read_only = np.empty((8, 3))
    read_only.flags.writeable = False
    for out in [np.empty((8, 2)), np.empty((7, 3)), np.empty(24), np.empty((8, 3), dtype=np.float32), read_only,
                np.empty((8, 3), dtype=">f8"), np.empty((8, 3))[::-1], np.empty((8, 3))[:, ::-1], [[0.0] * 3] * 8, "out",
                np.zeros(8, dtype=np.dtype([("tag", "i1"), ("p", "3f8")]))["p"], patchproof.Derivatives(),
                patchproof.Derivatives(du=np.empty((8, 2))), (np.empty((8, 3)),)]:
        with pytest.raises((TypeError, ValueError)):
            bspline.evaluate(UV, out=out)
    with pytest.raises(TypeError):
        bspline.evaluate(UV, derivatives=1, out=np.empty((8, 3)))
    with pytest.raises(ValueError, match="out.dv is None"):
        bspline.evaluate(UV, derivatives=1, out=patchproof.Derivatives(point=np.empty((8, 3)), du=np.empty((8, 3))))
    table = np.full((8, 4), 0.1)
    with pytest.raises(ValueError, match="parameters"):
        bspline.evaluate(table[:, :2], out=table[:, 1:])
    both = np.empty((8, 4))
    with pytest.raises(ValueError, match="share memory"):
        bspline.evaluate(UV, out=patchproof.Derivatives(point=both[:, :3], du=both[:, 1:]))
    assert (table == 0.1).all()


def test_options_that_are_refused(bspline, curve):
    for more in [{"derivatives": 3}, {"derivatives": -1}, {"derivatives": "1"}, {"side": "up"}, {"side": ("left",)},
                 {"side": None}, {"threads": -2}, {"threads": 2**40}, {"threads": "all"}, {"normal": "yes"}]:
        with pytest.raises((TypeError, ValueError)):
            bspline.evaluate(UV, **more)
    with pytest.raises(ValueError):
        bspline.error_bound("dvvv")
    for order in (-1, 21, 10**12, "1"):
        with pytest.raises((TypeError, ValueError)):
            bspline.evaluate_exact(UV, order)
    for uv in [(0.1,), 0.1, (0.1, None), (0.1, 1j),
               ("1/0", 0), ("a", 0), ("1" * 5000, 0), (10**5000, 0), (Fraction(10**5000, 3), 0), ("", 0), (b"1", 0)]:
        with pytest.raises((TypeError, ValueError)):
            bspline.evaluate_exact(uv)
    for knots in [["1/0"], [None], "0.1", 7, [math.nan], [100], [""], [[0.1]]]:
        with pytest.raises((TypeError, ValueError)):
            bspline.insert_knots("u", knots)
    with pytest.raises(ValueError, match="'w'"):
        bspline.insert_knots("w", [0.1])
    for times in (-1, 10**6, 2**40, 0.5):
        with pytest.raises((TypeError, ValueError)):
            bspline.elevate("u", times)
        with pytest.raises((TypeError, ValueError)):
            curve.elevate(times)


def test_nothing_can_be_made_without_its_content(bspline, curve, cup):
    report, mesh = patchproof.certify(bspline.extract_bezier()), patchproof.tessellate(bspline.extract_bezier(), 1)
    for thing in (bspline, curve, report, mesh):
        kind = type(thing)
        for make in (kind, lambda: kind.__new__(kind), lambda: object.__new__(kind)):
            with pytest.raises(TypeError):
                make()
        with pytest.raises(TypeError):
            type("Sub", (kind,), {})
    for kind, thing in [(type(x), x) for x in (bspline, curve, report, mesh, cup)]:
        for name, member in vars(kind).items():  # every method and property, on what is no such object
            for stranger in (None, 3, object(), bspline if thing is not bspline else curve):
                if isinstance(member, property):
                    with pytest.raises(TypeError):
                        member.fget(stranger)
                elif callable(member) and not name.startswith("__"):
                    with pytest.raises(TypeError):
                        getattr(kind, name)(stranger)
    for make in (patchproof.Model.__new__, object.__new__):
        with pytest.raises(TypeError):
            make(patchproof.Model)
    with pytest.raises(TypeError):
        type("Sub", (patchproof.Model,), {})
    made = patchproof.Model([random_patch(1)])
    with pytest.raises(TypeError):
        made.__init__([random_patch(2)])
    assert made.patches[0].name == "random 1"
    with pytest.raises(patchproof.Error, match="neither patches nor curves"):
        patchproof.Model()
    for function in (patchproof.certify, lambda m: patchproof.tessellate(m, 1.0)):
        for stranger in (None, 3, bspline):
            with pytest.raises(TypeError):
                function(stranger)
    with pytest.raises(AttributeError):
        cup.units = "inch"


def test_models_that_are_refused():
    points = np.zeros((4, 4, 3))
    good = random_patch(1)
    with pytest.raises(TypeError, match=r"patches\[1\].points: an array of shape \(4, 4\)"):
        patchproof.Model([good, patchproof.PatchData(points[..., 0])])
    for bad in [good._replace(weights=np.ones(3)), good._replace(degree=None), good._replace(knots=None),
                good._replace(degree=(3,)), good._replace(degree=(3, 4)), good._replace(degree=("3", "x")),
                good._replace(points=good.points.astype(object)), good._replace(points=good.points.astype(complex)),
                good._replace(degree=(3, 2**40)), good._replace(degree=(-3, 3)), good._replace(name="\ud800"),
                good._replace(points=np.full(good.points.shape, 2**60 + 1)), 3, None, "patch", points]:
        with pytest.raises((TypeError, ValueError)):
            patchproof.Model([bad])
    for change in [{"points": np.where(np.indices(good.points.shape)[0] == 1, math.nan, good.points)},
                   {"points": good.points * math.inf}, {"weights": np.zeros(good.points.shape[:2])},
                   {"knots": (good.knots[0][::-1], good.knots[1])}, {"knots": (np.zeros_like(good.knots[0]), good.knots[1])},
                   {"knots": (good.knots[0] * math.nan, good.knots[1])}]:
        with pytest.raises(patchproof.Error):
            patchproof.Model([good._replace(**change)])
    for bad in [patchproof.PatchData(np.zeros((0, 4, 3))), patchproof.PatchData(np.zeros((1, 1, 3))),
                patchproof.PatchData(np.zeros((4, 0, 3)))]:
        with pytest.raises(ValueError):
            patchproof.Model([bad])
    for joins in [[(0, "u_min", 1)], [(0, "left", 1, "u_min")], [(0, "u_min", 7, "u_min")], [(-1, "u_min", 0, "u_min")], 3,
                  [(2**40, "u_min", 0, "u_min")], [("a", "u_min", 0, "u_min")]]:
        with pytest.raises((TypeError, ValueError)):
            patchproof.Model([good], joins=joins)
    with pytest.raises(TypeError):
        patchproof.Model([good], units=3)
    with pytest.raises(TypeError):
        patchproof.Model(patches=good.points)
    with pytest.raises(TypeError):
        patchproof.Model(surfaces=[])


def test_exact_patches_are_not_rounded_silently(examples):
    torus = patchproof.read(examples / "torus.json")
    with pytest.raises(TypeError, match="no doubles"):
        patchproof.Model(torus.patches)
    rounded = patchproof.read(examples / "cup.json", decimals="binary64")
    again = patchproof.Model(rounded.patches)
    assert [p.name for p in again.patches] == [p.name for p in rounded.patches]
    assert all(np.array_equal(a.points, b.points) for a, b in zip(again.patches, rounded.patches))


def test_files_that_are_refused(tmp_path):
    with pytest.raises(patchproof.Error) as raised:
        patchproof.read(tmp_path / "missing.json")
    assert raised.value.code == "cannot_open" and "missing.json" in str(raised.value)
    with pytest.raises(patchproof.Error) as raised:
        patchproof.fill(tmp_path / "missing.json")
    assert raised.value.code == "cannot_open" and "missing.json" in raised.value.where
    (tmp_path / "b\udcffd.json").write_text("{")  # a name that is no UTF-8
    for path in [tmp_path / "b\udcffd.json", tmp_path]:
        with pytest.raises(patchproof.Error):
            patchproof.read(path)
    for text in ["", "{", "\0\0\0", b"\xff\xfe", '{"format": "patchproof-model"}', "null", "[" * 100000, "🙂"]:
        with pytest.raises(patchproof.Error) as raised:
            patchproof.read_text(text, "bad.json")
        assert isinstance(raised.value, ValueError) and raised.value.message
        assert raised.value.args == (raised.value.code, raised.value.where, raised.value.message, raised.value.values)
        with pytest.raises(patchproof.Error):
            patchproof.fill_text(text, "bad.json")
    for wrong in [None, 3, object(), ["{}"]]:
        for function in (patchproof.read, patchproof.read_text, patchproof.fill, patchproof.fill_text):
            with pytest.raises((TypeError, patchproof.Error)):
                function(wrong)
    with pytest.raises(ValueError, match="decimals"):
        patchproof.read_text("{}", "x.json", decimals="rounded")


def test_errors_survive_pickling():
    error = patchproof.Error("wrong_count", "a.json", "too few", "3")
    again = pickle.loads(pickle.dumps(error))
    assert str(again) == str(error) == "a.json: too few [3] (wrong_count)"


def test_patches_outlive_their_model():
    def lone():
        return patchproof.Model([random_patch(7)], [patchproof.CurveData(np.eye(3))])
    patch, line = lone().patches[0], lone().curves[0]
    values = patch.evaluate(random_parameters(patch, 50))
    for _ in range(3):
        gc.collect()
        junk = [lone() for _ in range(20)]
        assert np.array_equal(patch.evaluate(random_parameters(patch, 50)), values)
        assert patch.name == "random 7" and line.evaluate(0.5).shape == (3,)
        del junk
    points = patch.points
    del patch
    gc.collect()
    assert np.array_equal(points, random_patch(7).points)


def test_results_are_the_callers_own(bspline):
    for array in (bspline.points, *bspline.knots):
        with pytest.raises(ValueError):
            array[...] = 0
    first = bspline.evaluate(UV)
    first[...] = 0
    assert not np.array_equal(bspline.evaluate(UV), first)


def test_copies_and_pickles(examples, bspline, curve):
    torus = patchproof.read(examples / "torus.json")
    for thing in (torus, bspline, curve):
        assert copy.copy(thing) is thing and copy.deepcopy(thing) is thing
    again = pickle.loads(pickle.dumps(torus))
    assert again.to_json() == torus.to_json() and repr(again) == repr(torus)
    for patch, other in itertools.islice(zip(torus.patches, again.patches), 2):
        assert (patch.evaluate_exact(("1/3", "1/5")) == other.evaluate_exact(("1/3", "1/5"))).all()
    other = pickle.loads(pickle.dumps(bspline))
    assert other.name == bspline.name and np.array_equal(other.evaluate(UV), bspline.evaluate(UV))
    assert np.array_equal(pickle.loads(pickle.dumps(curve)).points, curve.points)
    report, mesh = patchproof.certify(bspline.extract_bezier()), patchproof.tessellate(bspline.extract_bezier(), 1)
    for thing in (report, mesh):
        assert copy.deepcopy(thing) is thing
        with pytest.raises(TypeError, match="cannot be pickled"):
            pickle.dumps(thing)


def test_requests_that_are_refused(cup):
    for more in [{"require": "G2"}, {"require": 1}, {"gap": math.nan}, {"gap": -1}, {"gap": "1"}, {"angle": -1},
                 {"angle": math.nan}, {"seconds_per_join": 0}, {"seconds_per_join": math.nan}, {"seconds_per_join": -3},
                 {"seconds_per_join": math.inf}, {"match": 0}, {"match": math.nan}, {"jobs": -7}, {"jobs": 1.5}, {"progress": 3}]:
        with pytest.raises((TypeError, ValueError)):
            patchproof.certify(cup, **more)
    for chord in (0, -1, math.nan, math.inf, "1", None):
        with pytest.raises((TypeError, ValueError)):
            patchproof.tessellate(cup, chord)
    for more in [{"angle": 0}, {"angle": math.nan}, {"max_triangles": 0}, {"max_triangles": -1}, {"max_triangles": 2**80},
                 {"method": "delaunay"}, {"jobs": -7}, {"progress": "bar"}]:
        with pytest.raises((TypeError, ValueError)):
            patchproof.tessellate(cup, 1.0, **more)
    with pytest.raises(patchproof.Error):
        patchproof.tessellate(cup, 0.1, max_triangles=5)
    for more in [{"repair": math.nan}, {"repair": -1}, {"jobs": -7}, {"decimals": "float"}]:
        with pytest.raises((TypeError, ValueError)):
            patchproof.fill_text("{}", "mesh.json", **more)


def test_handles_stay_with_their_classes(cup):
    for thing, other in ((cup.patches[0], patchproof.Model), (cup, patchproof.Patch)):
        with pytest.raises(TypeError, match="__class__"):
            thing.__class__ = other


def test_texts_that_are_no_utf8(cup):
    patch = cup.patches[0]
    for call in (lambda: patchproof.read_text("\ud800"), lambda: patchproof.fill_text("\ud800"),
                 lambda: patch.evaluate_exact([["\ud800", "0"]]), lambda: patch.insert_knots("u", ["\ud800"])):
        with pytest.raises(UnicodeEncodeError):
            call()


def test_degrees_are_integers():
    with pytest.raises(TypeError):
        patchproof.Model([patchproof.PatchData(np.zeros((4, 4, 3)), None, (3.7, 3), ([0.0] * 4 + [1.0] * 4,) * 2)])
