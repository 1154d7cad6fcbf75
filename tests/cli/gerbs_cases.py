# SPDX-License-Identifier: Apache-2.0
"""Cases of cli_test.py: GERBS curves and patches."""
import json

from command import DATA, EXAMPLES, Command


class Gerbs(Command):
    MODEL = DATA / "model/gerbs.json"

    def test_what_a_model_holds(self):
        text = self.expect(0, "info", self.MODEL).stdout.decode()
        for line in ("1 patch, 2 curves, numbers in Q", "B-function polynomial(2), of order 2", "  t = 1: C2, derivative 3 jumps by (", "  t = 2: C2, derivative 3 jumps by (",
                     "B-function expo-rational(1,1,1,1/2), of order all", "  t = 1/2: C∞\n", "u: 2 local, centres 0 1 2, closed"):
            self.assertIn(line, text)

    def test_exact_values_and_enclosures(self):
        text = self.expect(0, "evaluate", self.MODEL, "--curve", "0", "--at", "3/2", "--derivatives", "2").stdout.decode()
        self.assertEqual([line.split() for line in text.splitlines()],
                         [["C", "2", "7/8"], ["C'", "23/8", "31/32"], ["C''", "0", "41/4"]])
        self.expect_refusal("evaluate", self.MODEL, "--patch", "0", "--at", "1/2,1/2", names=["--scalar interval", "trigonometric"])
        values = json.loads(self.expect(0, "evaluate", self.MODEL, "--patch", "0", "--at", "1/2,1/2", "--scalar", "interval", "--json", "-").stdout)["values"]
        low, high = (float(x) for x in values[0]["value"][2].strip("[]").split(","))
        self.assertTrue(low <= 0.55 <= high and high - low < 1e-15)
        self.expect_refusal("evaluate", self.MODEL, "--curve", "2", "--at", "0", names=["curves 0 to 1"])
        self.expect_refusal("evaluate", self.MODEL, "--curve", "1", "--at", "2", names=["outside the domain [0, 3/2]"])

    def test_a_seam_is_proved(self):
        report = json.loads(self.expect(0, "certify", self.MODEL, "--require", "G1", "--json", "-").stdout)
        join, = report["joins"]
        self.assertEqual((join["kind"], join["exact"]["C1"], join["exact"]["G1"], join["gap"]["upper"]), ("seam", "proven", "proven", 0))
        self.assertIn(b"patch 0: GERBS surface with trigonometric, bounded by Taylor models", self.expect(0, "certify", self.MODEL).stdout)

    def test_tangent_planes_of_rational_patches_are_proved(self):
        """The NURBS circle is C1 within itself, and twice as fast at the end as at the beginning."""
        report = json.loads(self.expect(0, "certify", EXAMPLES / "gerbs/torus_rational.json", "--require", "G1", "--json", "-").stdout)
        self.assertEqual([(j["kind"], j["exact"]["G1"], j["exact"]["C1"]) for j in report["joins"]],
                         [("seam", "proven", "undecided")] * 2 + [("knot-line", "proven", "undecided")] * 6)
        for name in ("torus", "cylinder", "cylinder_rational"):
            self.expect(0, "certify", EXAMPLES / f"gerbs/{name}.json", "--require", "G1")

    def test_written_and_drawn(self):
        once, twice = self.dir / "once.json", self.dir / "twice.json"
        self.expect(0, "convert", self.MODEL, once)
        self.expect(0, "convert", once, twice)
        self.assertEqual(once.read_bytes(), twice.read_bytes())
        self.expect_refusal("convert", self.MODEL, self.dir / "out.g2", names=["patch 0", "JSON"])
        for name in ("out.svg", "out.stl", "out.glb"):
            self.expect(0, "plot", self.MODEL, self.dir / name)
            self.assertGreater((self.dir / name).stat().st_size, 1000)
        exact = json.loads(self.MODEL.read_text())
        del exact["gerbs_patches"], exact["gerbs_curves"][1]
        done = self.expect(0, "convert", self.write("exact.json", json.dumps(exact)), self.dir / "exact.g2")
        self.assertIn(b"curve 0: GERBS curve, expanded exactly to degree 7", done.stderr)
