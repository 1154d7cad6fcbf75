# SPDX-License-Identifier: Apache-2.0
"""Cases of cli_test.py: meshes of curves, filled with Gregory patches."""
import json
from fractions import Fraction

from command import EXAMPLES, Command


class Fill(Command):
    TWO = EXAMPLES / "meshes/two_faces.json"

    def filled(self, *words, code=0):
        out = self.dir / "filled.json"
        text = self.expect(code, "fill", *words, out).stdout.decode()
        return out, text

    def report(self, path, *words):
        return json.loads(self.expect(0, "certify", path, "--json", "-", *words).stdout)

    def changed(self, name, old, new):
        text = self.TWO.read_text()
        self.assertIn(old, text)
        return self.write(name, text.replace(old, new, 1).encode())

    def test_everything_is_proved(self):
        out, text = self.filled(self.TWO)
        for line in ("2 faces, 7 edges (1 smooth, 0 sharp, 6 boundary)", "G1 across smooth edges: 1 proven",
                     "C1 inside patches: 2 proven", "normal nowhere zero: 2 proven"):
            self.assertIn(line, text)
        report = self.report(out, "--require", "G1")
        self.assertEqual([j["exact"]["G1"] for j in report["joins"]], ["proven"])
        self.assertEqual(len(report["unmatched_edges"]), 6)
        self.assertEqual([(p["c1"], p["regular"]) for p in report["gregory_patches"]], [("proven", "proven")] * 2)

    def test_the_former_method_is_kinked_inside(self):
        out, text = self.filled(self.TWO, "--method", "former", code=1)
        self.assertIn("C1 inside patches: 0 proven, 2 refuted", text)
        report = self.report(out)
        kinks = {j["a"]["name"]: j["angle_degrees"] for j in report["joins"] if j["a"]["edge"] == "v = 1/3-"}
        self.assertEqual(set(kinks), {"F1", "F2"})
        # 3.61 and 11.42 degrees at u = 1/2, more elsewhere on the line.
        self.assertTrue(3.61 < kinks["F1"]["lower"] <= kinks["F1"]["upper"] < 5.26, kinks)
        self.assertTrue(11.42 < kinks["F2"]["lower"] <= kinks["F2"]["upper"] < 13.5, kinks)
        self.assertEqual([j["exact"]["G1"] for j in report["joins"] if j["kind"] != "knot-line"], ["proven"])

    def test_a_closed_mesh_of_pentagons_and_hexagons(self):
        out, text = self.filled(EXAMPLES / "meshes/football.json")
        self.assertIn("split: 32 faces not of four sides; 180 faces in place of 32", text)
        self.assertIn("C1 inside patches: 180 proven\nnormal nowhere zero: 180 proven", text)
        report = self.report(out)
        self.assertEqual(report["unmatched_edges"], [])
        self.assertTrue(all(j["exact"]["G1"] == "proven" and j["exact"]["C0"] == "proven" for j in report["joins"]))

    def test_the_result_does_not_depend_on_the_jobs(self):
        files = set()
        for jobs in (1, 2, 8):
            files.add(self.filled(self.TWO, "--jobs", jobs)[0].read_bytes())
        self.assertEqual(len(files), 1)
        self.assertEqual(files, {self.expect(0, "fill", self.TWO, "-").stdout})

    def test_evaluate_and_info_know_the_patches(self):
        out, _ = self.filled(self.TWO)
        rows = json.loads(self.expect(0, "evaluate", out, "--patch", 0, "--at", "1/2,1/3", "--derivatives", 1, "--json",
                                      "-").stdout)["values"]
        self.assertEqual(rows[2]["value"], ["-292351/316875", "3855491/422500", "431569/422500"])  # S_v
        for scalar, near in (("interval", 0), ("double", Fraction(1, 10**12))):
            at = json.loads(self.expect(0, "evaluate", out, "--at", "1/2,1/3", "--scalar", scalar, "--json", "-").stdout)
            exact = [Fraction(x) for x in rows[0]["value"]]
            for x, text in zip(exact, at["values"][0]["value"]):
                low, high = ((Fraction(float(t)) for t in text.strip("[]").split(", ")) if scalar == "interval" else
                             (Fraction(float(text)),) * 2)
                self.assertTrue(low - near <= x <= high + near, (scalar, text))
        corner = self.expect(0, "evaluate", out, "--at", "0,0", "--derivatives", 1).stdout.decode().split("\n")
        self.assertEqual(corner[0].split(), ["S", "-6", "0", "0"])
        self.expect_refusal("evaluate", out, "--at", "0,0", "--derivatives", 2, names=["corners"])
        self.expect_refusal("evaluate", out, "--patch", 2, "--at", "0,0", names=["patches 0 to 1"])
        self.assertIn(b"NURBS boundary Gregory patch", self.expect(0, "info", out).stdout)

    def test_convert_keeps_them(self):
        out, _ = self.filled(self.TWO)
        again = self.dir / "again.json"
        self.expect(0, "convert", out, again)
        self.assertEqual(again.read_bytes(), out.read_bytes())

    def test_rounded_meshes_are_sharp_until_repaired(self):
        mesh = self.changed("rounded.json", '[-2, "1/3", "1/3"]', "[-2, 0.3333, 0.3334]")
        _, text = self.filled(mesh)
        self.assertIn("1 sharp", text)
        self.assertIn("--repair", text)
        _, text = self.filled(mesh, "--repair", 0.1)
        self.assertIn("repaired:", text)
        self.assertIn("(1 smooth, 0 sharp, 6 boundary)", text)

    def test_bad_meshes_are_refused_and_leave_nothing(self):
        out = self.dir / "out.json"
        for name, old, new, words in (
                ("apart", '"point": [0, 9, 0]', '"point": [0, 9, 1]', ["edge E0", "ends_apart"]),
                ("bent", '"right": [6, 0, -3]', '"right": [6, 0, -2]', ["edge E0", "1/3", "control_vectors_bent"]),
                ("knots", '"1/3", "1/3", "1/3", 1', '"1/3", "1/3", "1/4", 1', ["edge E0", "decreasing_knots"]),
                ("number", '"point": [0, 9, 0]', '"point": [0, "9/0", 0]', ["/vertices/1/point/1", "9/0", "bad_number"]),
                ("loop", '{"edge": "E2"}', '{"edge": "E4"}', ["face F1", "open_loop"]),
                ("unknown", '{"edge": "E2"}', '{"edge": "E2x"}', ["E2x", "bad_reference"])):
            self.expect_refusal("fill", self.changed(name + ".json", old, new), out, names=words)
            self.assertFalse(out.exists(), name)
        self.expect_refusal("fill", self.TWO, self.TWO, names=["overwrite"])
        self.expect_refusal("fill", EXAMPLES / "cup.json", out, names=["patchproof-curve-mesh", "unknown_format"])

    def test_an_edited_patch_is_noticed(self):
        out, _ = self.filled(self.TWO)
        model = json.loads(out.read_text())
        points = model["gregory_patches"][0]["u"]["control_points"]
        points[2][3] = [str(Fraction(str(points[2][3][0])) + Fraction(1, 1000))] + points[2][3][1:]
        edited = self.write("edited.json", json.dumps(model).encode())
        report = json.loads(self.expect(1, "certify", edited, "--require", "G1", "--json", "-").stdout)
        self.assertEqual([j["exact"]["G1"] for j in report["joins"]], ["refuted"])
        points[0][0] = [0, 0, 0]
        self.expect_refusal("certify", self.write("corner.json", json.dumps(model).encode()), names=["corner", "curves_apart"])
