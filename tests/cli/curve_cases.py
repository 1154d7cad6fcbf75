# SPDX-License-Identifier: Apache-2.0
"""Cases of cli_test.py: curves, and patches made from curves."""
import json
from fractions import Fraction

from command import CUP, DATA, EXAMPLES, SPHERE, Command


class Curves(Command):
    TOOLBOX = EXAMPLES / "toolbox"

    def values(self, *words):
        return [row["value"] for row in json.loads(self.expect(0, "evaluate", *words, "--json", "-").stdout)["values"]]

    def test_evaluate_names_and_values(self):
        text = self.expect(0, "evaluate", self.TOOLBOX / "test01.json", "--at", "1/2", "--derivatives", 4).stdout.decode()
        self.assertEqual([line.split() for line in text.splitlines()],
                         [["C", "21/16", "11/16"], ["C'", "5/2", "3/2"], ["C''", "3", "-3"], ["C'''", "12", "-12"],
                          ["C^(4)", "-72", "72"]])
        document = json.loads(self.expect(0, "evaluate", DATA / "model/good_curves.json", "--curve", 1, "--at", "2",
                                          "--derivatives", 1, "--json", "-").stdout)
        self.assertEqual((document["curve"], document["at"]), (1, "2"))
        self.assertEqual([row["dt"] for row in document["values"]], [0, 1])
        self.assertEqual(document["values"][0]["value"], ["5/2", "1", "0"])

    def test_evaluate_from_both_sides(self):
        words = (self.TOOLBOX / "test12.json", "--curve", 2, "--at", "1")
        self.assertEqual(self.values(*words, "--left"), [["1", "4"]])
        self.assertEqual(self.values(*words), [["2", "3"]])

    def test_evaluate_agrees_in_all_scalars(self):
        for path, curve, at in ((self.TOOLBOX / "test08.json", 0, "10/3"), (self.TOOLBOX / "conics.json", 6, "0.7"),
                                (self.TOOLBOX / "test13.json", 0, "2.2")):
            exact, enclosure, rounded = (self.values(path, "--curve", curve, "--at", at, "--derivatives", 3, "--scalar", s)
                                         for s in ("rational", "interval", "double"))
            self.assertEqual(len(exact), 4)
            for xs, intervals, doubles in zip(exact, enclosure, rounded):
                self.assertEqual(len(xs), 2)
                for x, interval, d in zip(xs, intervals, doubles):
                    low, high = (Fraction(float(t)) for t in interval.strip("[]").split(", "))
                    self.assertLess(high - low, max(1, abs(high)) * Fraction(1, 10**9))
                    self.assertLess(abs(Fraction(float(d)) - low), max(1, abs(high)) * Fraction(1, 10**9))
                    if "sqrt" not in x:
                        self.assertTrue(low <= Fraction(x) <= high, f"{x} not in {interval}")

    def test_evaluate_refuses(self):
        both = DATA / "model/good_curves.json"
        self.assertEqual(self.values(both, "--at", "0,0"), [["0", "1", "0"]])  # the patch
        self.expect_refusal("evaluate", both, "--curve", 0, "--at", "2", names=["domain [0, 1]", "outside_domain"])
        self.expect_refusal("evaluate", both, "--at", "2,0", names=["domain [0, 1]", "outside_domain"])
        self.expect_refusal("evaluate", both, "--curve", 5, "--at", "0", names=["curves 0 to 4"])
        self.expect_refusal("evaluate", both, "--curve", -1, "--at", "0", names=["curves 0 to 4"])
        self.expect_refusal("evaluate", both, "--curve", 0, "--at", "0,0", names=["--at"])
        self.expect_refusal("evaluate", self.TOOLBOX / "test08.json", "--at", "0", names=["curves 0 to 1", "--curve"])
        self.expect_refusal("evaluate", self.TOOLBOX / "test01.json", "--patch", 0, "--at", "0,0", names=["no patches"])
        self.expect_refusal("evaluate", CUP, "--curve", 0, "--at", "0", names=["no curves"])
        self.assertIn(b"excludes", self.expect(2, "evaluate", both, "--curve", 0, "--patch", 0, "--at", "0").stderr)

    def test_certify_joins_of_curves(self):
        report = json.loads(self.expect(0, "certify", self.TOOLBOX / "test08.json", "--json", "-").stdout)
        self.assertEqual((report["joins"], report["input"]["patches"], report["curve_summary"]["curves"]), ([], 0, 2))
        self.expect(3, "certify", self.TOOLBOX / "test01.json", "--require", "C0")  # no ends meet
        for options, code in ((["--require", "G1"], 1), (["--require", "C0", "--gap", 0], 0), (["--angle", 89], 1),
                              (["--angle", 91], 0), (["--curvature", 0], 0), (["--curvature", "nan"], 2)):
            self.expect(code, "certify", self.lines("bent.json", [[0, 0], [1, 0]], [[1, 0], [1, 5]]), *options)

    def lines(self, name, *lines):
        curves = [{"name": f"line {i}", "degree": 1, "control_points": line} for i, line in enumerate(lines)]
        return self.write(name, json.dumps({"format": "patchproof-model", "version": 1, "curves": curves}))

    def test_certify_joins_curves_of_several_files(self):
        first, second = self.lines("first.json", [[0, 0], [1, 0]]), self.lines("second.json", [[1, 0], [4, 0]])
        report = json.loads(self.expect(0, "certify", first, second, "--require", "G1", "--json", "-").stdout)
        join, = report["curve_joins"]
        self.assertEqual((join["a"]["file"], join["b"]["file"]), (str(first), str(second)))
        self.assertEqual((join["class"], join["exact"]["ratio"]), ("G2", "3"))
        self.assertEqual(self.expect(0, "certify", first, second, "--jobs", 1).stdout,
                         self.expect(0, "certify", first, second, "--jobs", 5).stdout)
        table = self.expect(0, "certify", first, second, "--gap", 0).stdout.decode()
        self.assertIn("first.json: line 0.end", table)
        self.assertIn("1 pass, 0 fail, 0 undecided", table)
        # Beside a model of patches the files of curves are one report; without --json - their table is one as well.
        mixed = json.loads(self.expect(0, "certify", first, SPHERE, second, "--json", "-").stdout)
        self.assertEqual([len(r.get("curve_files", [])) for r in mixed], [2, 0])
        self.assertEqual(mixed[0]["curve_joins"], report["curve_joins"])
        root2 = self.write("root2.json", self.root(2))
        self.expect_refusal("certify", first, root2, self.write("root3.json", self.root(3)), names=["root3.json", "mixed_roots"])
        self.expect_refusal("certify", first, self.dir / "none.json", names=["none.json"])

    def root(self, n):
        return json.dumps({"format": "patchproof-model", "version": 1,
                           "curves": [{"degree": 1, "control_points": [[0, 0], [f"sqrt({n})", 0]]}]})

    def test_convert_round_trip(self):
        for path in sorted(self.TOOLBOX.glob("*.json")) + sorted(DATA.glob("*/good_*curve*")):
            with self.subTest(path.name):
                once, twice = self.dir / "once.json", self.dir / "twice.json"
                self.expect(0, "convert", path, once)
                self.expect(0, "convert", once, twice)
                self.assertEqual(once.read_bytes(), twice.read_bytes())

    def test_patches_made_from_curves_are_certified(self):
        # The cylinder closes: one seam, and its three lines of double knots.
        report = json.loads(self.expect(0, "certify", self.TOOLBOX / "test15.json", "--require", "C1", "--json", "-").stdout)
        self.assertEqual(sorted(j["kind"] for j in report["joins"]), ["knot-line"] * 3 + ["seam"])
        self.assertIn("expanded exactly", " ".join(report["input"]["notes"]))
