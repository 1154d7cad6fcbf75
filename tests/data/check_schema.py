#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""check_schema.py SOURCE_DIR: docs/model.schema.json accepts every model of examples/ and every good one of tests/data,
and refuses wrong ones. Exit code 77 (skipped) without python3-jsonschema."""
import copy
import json
import pathlib
import sys

try:
    import jsonschema
except ImportError:
    print("skipped: python3-jsonschema is not installed")
    sys.exit(77)

root = pathlib.Path(sys.argv[1])
schema = json.loads((root / "docs/model.schema.json").read_text(encoding="utf-8"))
jsonschema.Draft7Validator.check_schema(schema)
validator = jsonschema.Draft7Validator(schema)


def complaints(document):
    return [f"{'/'.join(map(str, e.absolute_path))}: {e.message[:200]}" for e in validator.iter_errors(document)]


failures = []
models = sorted((root / "tests/data/model").glob("good_*.json")) + sorted((root / "examples").glob("**/*.json"))
checked = 0
for path in models:
    document = json.loads(path.read_text(encoding="utf-8"))
    if not isinstance(document, dict) or document.get("format") != "patchproof-model":
        continue
    checked += 1
    failures += [f"{path.relative_to(root)}: {text}" for text in complaints(document)]
if checked < 2:
    failures.append("fewer than two models were found")


def refuses(name, change):
    document = {
        "format": "patchproof-model",
        "version": 1,
        "curves": [{"degree": 1, "control_points": [[0, 0], [1, 0]]}],
        "patches": [{"degree": [1, 1], "control_points": [[[0, 0, 0], [0, 1, 0]], [[1, 0, 0], [1, "1/3", 0]]]},
                    {"coons": {"v_min": [0, 0, 0], "v_max": {"degree": 1, "control_points": [[0, 1, 0], [1, 1, 0]]},
                               "u_min": {"degree": 1, "control_points": [[0, 0, 0], [0, 1, 0]]},
                               "u_max": {"degree": 1, "control_points": [[0, 0, 0], [1, 1, 0]]}}},
                    {"transfinite": {"along": "u", "degree": 1, "controls": [[0, 0, 0], [1, 0, 0]]}},
                    {"gordon": {"u": [0, 1], "v": [0, "1/2"], "along_u": [[0, 0, 0]] * 2, "along_v": [[0, 0, 0]] * 2}}],
        "joins": [{"a": {"patch": 0, "edge": "u_min"}, "b": {"patch": 0, "edge": "u_max"}}],
    }
    if complaints(document):
        failures.append(f"the model that '{name}' changes is refused itself")
    document = copy.deepcopy(document)
    change(document)
    if not complaints(document):
        failures.append(f"accepted: {name}")


refuses("a misspelt key", lambda d: d["patches"][0].update(weigths=[[1, 1], [1, 1]]))
refuses("no degree", lambda d: d["patches"][0].pop("degree"))
refuses("degree 0", lambda d: d["patches"][0].update(degree=[0, 1]))
refuses("degree 65", lambda d: d["patches"][0].update(degree=[1, 65]))
refuses("one knot vector", lambda d: d["patches"][0].update(knots=[[0, 0, 1, 1]]))
refuses("a point of two numbers", lambda d: d["patches"][0]["control_points"][0].__setitem__(0, [0, 0]))
refuses("a word for a number", lambda d: d["patches"][0]["control_points"][0].__setitem__(0, [0, 0, "nan"]))
refuses("null for a number", lambda d: d["patches"][0]["control_points"][0].__setitem__(0, [0, 0, None]))
refuses("neither curves nor patches", lambda d: d.update(patches=[], curves=[]))
refuses("a curve with two degrees", lambda d: d["curves"][0].update(degree=[1, 1]))
refuses("a curve of points with one number", lambda d: d["curves"][0].update(control_points=[[0], [1]]))
refuses("a net for a curve", lambda d: d["curves"][0].update(control_points=[[[0, 0], [1, 0]]]))
refuses("a side that is a number", lambda d: d["patches"][1]["coons"].update(u_min=1))
refuses("three sides", lambda d: d["patches"][1]["coons"].pop("u_min"))
refuses("one derivative across", lambda d: d["patches"][1]["coons"].update(across_u_min=[0, 0, 0]))
refuses("a Coons patch with a degree", lambda d: d["patches"][1].update(degree=[1, 1]))
refuses("a blending along w", lambda d: d["patches"][2]["transfinite"].update(along="w"))
refuses("a network of one curve", lambda d: d["patches"][3]["gordon"].update(along_u=[[0, 0, 0]]))
refuses("another version", lambda d: d.update(version=2))
refuses("an edge that is none", lambda d: d["joins"][0]["a"].update(edge="top"))
refuses("a negative patch", lambda d: d["joins"][0]["b"].update(patch=-1))

print(f"{checked} models checked")
for failure in failures:
    print(failure)
sys.exit(1 if failures else 0)
