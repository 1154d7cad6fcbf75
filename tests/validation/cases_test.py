#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""cases_test.py PROGRAM SOURCE_DIR CASE.json…: runs `PROGRAM certify --json -` on each case and compares its report with what
mathematics says. Cases are described in validation/README.md. Exit code 77 (skipped) when the models of every case given are
absent ("others:…" stands for ../shared/data, which is not part of the repository).

Besides, every report must be consistent: bounds in order and as tight as they claim, exact zeros where a class was proven,
implications between the classes, counts that add up, and the exit code that its verdicts demand.
"""
import json
import pathlib
import subprocess
import sys
import tempfile
from fractions import Fraction

OTHERS = "../shared/data"  # models made by others, beside the repository
CLASSES = ("C2", "C1", "G1", "C0")
BOUNDS = {"gap": "gap", "angle": "angle_degrees", "plane_angle": "tangent_plane_angle_degrees"}


def best_class(join):
    exact = join["exact"]
    if exact["C0"] != "proven":
        return "gap" if exact["C0"] == "refuted" else "undecided"
    if exact["G1"] != "proven" and exact["C1"] == "proven":
        return "C1 not G1"
    return next(c for c in CLASSES if exact[c] == "proven")


class Case:
    def __init__(self, program, root, name):
        self.program, self.root, self.name, self.failures = program, root, name, []

    def check(self, good, text):
        if not good:
            self.failures.append(f"{self.name}: {text}")

    def model_path(self, model):
        return self.root / OTHERS / model[len("others:"):] if model.startswith("others:") else self.root / model

    def run(self, path, request):
        command = [self.program, "certify", str(path), "--json", "-"]
        for option, value in request.items():
            command += ["--" + option, str(value)]
        done = subprocess.run(command, capture_output=True, text=True, timeout=600)
        self.check(done.returncode != 2, f"bad input: {done.stderr.strip()}")
        report = json.loads(done.stdout) if done.stdout else None
        if report and report["input"]["format"] == "patchproof-model":
            document = json.loads(pathlib.Path(path).read_text(encoding="utf-8"))
            report["patch_names"] = [patch.get("name", "") for patch in document["patches"]]
        return done.returncode, report

    def refused(self, path, code):
        done = subprocess.run([self.program, "certify", str(path)], capture_output=True, text=True, timeout=600)
        self.check(done.returncode == 2 and f"({code})" in done.stderr and not done.stdout, f"expected ({code}): {done.stderr}")

    # ---- a report by itself

    def consistent(self, code, report):
        summary = report["summary"]
        verdicts = [j["verdict"] for j in report["joins"]]
        for verdict in ("pass", "fail", "undecided"):
            self.check(summary[verdict] == verdicts.count(verdict), f"summary counts {summary[verdict]} {verdict}")
        demanded = 1 if "fail" in verdicts else 3 if "undecided" in verdicts else 0
        self.check(code == demanded, f"exit code {code}, but the verdicts demand {demanded}")
        for join in report["joins"]:
            what = f"join {join['id']}: "
            exact = join["exact"]
            for key, largest in (("gap", float("inf")), ("angle", 180), ("plane_angle", 90)):
                bound = join[BOUNDS[key]]
                lower, upper = bound["lower"], bound["upper"]
                self.check(upper is not None and 0 <= lower <= upper <= largest, f"{what}{key} [{lower}, {upper}]")
                if bound["tight"]:
                    self.check(upper - lower <= 0.01 * upper, f"{what}{key} [{lower}, {upper}] is not tight")
            proven = {c for c in CLASSES if exact[c] == "proven"}
            for strong, weak in (("C2", "C1"), ("C1", "C0"), ("G1", "C0")):
                self.check(strong not in proven or weak in proven, f"{what}{strong} without {weak}")
                self.check(exact[weak] != "refuted" or exact[strong] == "refuted", f"{what}{strong} not refuted, {weak} is")
            self.check(("C0" in proven) == (join["gap"]["upper"] == 0), f"{what}C0 is {exact['C0']}, gap {join['gap']}")
            if "G1" in proven:
                self.check(join["angle_degrees"]["upper"] == 0 and join["orientation"] == "smooth", f"{what}G1, yet {join}")
            if "C1" in proven:
                self.check(exact["ratio"] in ("1", None), f"{what}C1 with the ratio {exact['ratio']}")
            for c in CLASSES:
                self.check(exact[c] == "proven" or join["reasons"].get(c), f"{what}{c} {exact[c]} without a reason")

    # ---- a report against what is expected

    def bound(self, what, bound, expected):
        """expected: "zero", or any of encloses [a, b] (the true value lies there), below, above, sampled [value, rounding] (the
        value was found, so that the upper bound is not below it)."""
        lower, upper = Fraction(bound["lower"]), Fraction(bound["upper"])
        text = f"{what} is [{bound['lower']}, {bound['upper']}], expected {expected}"
        if expected == "zero":
            self.check(upper == 0, text)
            return
        unknown = set(expected) - {"encloses", "below", "above", "sampled"}
        self.check(not unknown, f"{what}: unknown keys {unknown}")
        if "encloses" in expected:
            least, most = map(Fraction, expected["encloses"])
            self.check(lower <= most and least <= upper, text)
        if "below" in expected:
            self.check(upper <= Fraction(expected["below"]), text)
        if "sampled" in expected:
            value, rounding = map(Fraction, expected["sampled"])
            self.check(upper >= value - rounding, text)
        if "above" in expected:
            self.check(lower >= Fraction(expected["above"]), text)

    def join(self, report, expected):
        name = f"{expected['a']}|{expected['b']}"
        joins = [j for j in report["joins"]
                 if sorted([side_name(report, j["a"]), side_name(report, j["b"])]) == sorted([expected["a"], expected["b"]])]
        self.check(len(joins) == 1, f"{len(joins)} joins {name}")
        for join in joins:
            for key, value in expected.items():
                if key in ("a", "b"):
                    continue
                if key in BOUNDS:
                    self.bound(f"{name}: {key}", join[BOUNDS[key]], value)
                elif key == "at_b":
                    self.check([Fraction(x) for x in join["angle_degrees"]["at"]["b"]] == [Fraction(x) for x in value],
                               f"{name}: the worst angle is at {join['angle_degrees']['at']['b']}, expected {value}")
                else:
                    found = join["exact"].get(key, join.get(key)) if key in CLASSES + ("ratio",) else join.get(key)
                    self.check(found == value, f"{name}: {key} is {found}, expected {value}")

    def counts(self, report, expected):
        joins = report["joins"]
        tally = lambda values: {v: values.count(v) for v in sorted(set(values))}
        found = {
            "joins": len(joins),
            "kinds": tally([j["kind"] for j in joins]),
            "classes": tally([best_class(j) for j in joins]),
            "ratios": tally([j["exact"]["ratio"] or "none" for j in joins if best_class(j) == "G1"]),
            "collapsed": len(report["collapsed_edges"]),
            "poles_with_tangent_plane": sum(e["tangent_plane"] for e in report["collapsed_edges"]),
            "free": len(report["unmatched_edges"]),
        }
        for key, value in expected.items():
            self.check(key in found and found[key] == value, f"{key}: {found.get(key)}, expected {value}")

    def compare(self, code, report, expected):
        if report is None:
            return
        self.consistent(code, report)
        for key, value in expected.items():
            if key == "exit":
                self.check(code == value, f"exit code {code}, expected {value}")
            elif key == "joins":
                for join in value:
                    self.join(report, join)
            elif key == "counts":
                self.counts(report, value)
            elif key == "max":
                for name, bound in value.items():
                    bounds = [j[BOUNDS[name]] for j in report["joins"]]
                    self.bound(f"largest {name}", {e: max((b[e] for b in bounds), default=0) for e in ("lower", "upper")}, bound)
            else:
                self.check(False, f"unknown expectation {key}")


def side_name(report, side):
    """a.u_max, or 3.u_max when patch 3 has no name."""
    names = report.get("patch_names")
    return f"{names and names[side['patch']] or side['patch']}.{side['edge']}"


def changed(model, change):
    """The model with the values at these JSON pointers replaced."""
    for pointer, value in change.items():
        *path, last = [int(k) if k.isdigit() else k for k in pointer.split("/")[1:]]
        place = model
        for key in path:
            place = place[key]
        place[last] = value
    return model


def run_case(program, root, path):
    """Failures, or None when the model is absent."""
    case = json.loads(path.read_text(encoding="utf-8"))
    test = Case(program, root, case["id"])
    test.check(case["id"] == path.stem, f"the id is not the name of the file {path.name}")
    for key in ("title", "source", "kind", "note"):
        test.check(case.get(key), f"no {key}")
    if case["kind"] == "table":
        found = 0
        for row in case["models"]:
            model = test.model_path(row["model"])
            if not model.exists():
                continue
            found += 1
            test.name = f"{case['id']}: {row['model']}"
            if "refused" in row:
                test.refused(model, row["refused"])
                continue
            test.compare(*test.run(model, row.get("request", {})), row["expected"])
        return test.failures if found else None
    model = test.model_path(case["model"])
    if not model.exists():
        return None
    test.compare(*test.run(model, case.get("request", {})), case["expected"])
    for number, twin in enumerate(case.get("twins", []), 1):
        test.name = f"{case['id']}, twin {number}"
        test.check(twin.get("note"), "no note")
        # Decimals stay the text that they are: the model is not read through doubles.
        document = changed(json.loads(model.read_text(encoding="utf-8"), parse_float=str), twin["change"])
        with tempfile.TemporaryDirectory() as folder:
            copy = pathlib.Path(folder) / "twin.json"
            copy.write_text(json.dumps(document), encoding="utf-8")
            test.compare(*test.run(copy, case.get("request", {})), twin["expected"])
    return test.failures


def main():
    program, root, paths = sys.argv[1], pathlib.Path(sys.argv[2]), [pathlib.Path(p) for p in sys.argv[3:]]
    failures, absent = [], 0
    for path in paths:
        result = run_case(program, root, path)
        if result is None:
            absent += 1
            print(f"skipped: {path.stem}: its models are not here")
            continue
        print(f"{'FAILED' if result else 'passed'}: {path.stem}")
        failures += result
    print("\n".join(failures))
    return 1 if failures or not paths else 77 if absent == len(paths) else 0


if __name__ == "__main__":
    sys.exit(main())
