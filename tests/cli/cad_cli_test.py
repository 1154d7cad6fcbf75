#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""cad_cli_test.py PROGRAM SOURCE_DIR: patchproof certify on STEP files: classes of edges, faces left out, damaged files."""
import json
import sys
import unittest

sys.dont_write_bytecode = True  # the sources may be read-only
if len(sys.argv) < 3:
    sys.exit(__doc__)
from command import DATA, CUP, EXAMPLES, Command

BLOCK = EXAMPLES / "cad/block.step"


class Cad(Command):
    def report(self, code, *words):
        return json.loads(self.expect(code, "certify", *words, "--json", "-").stdout)

    def test_the_block_has_smooth_fillets_and_sharp_edges(self):
        document = self.report(0, BLOCK)
        self.assertEqual(document["summary"]["edge_classes"], {"smooth": 18, "kinked": 0, "sharp": 34, "mixed": 0, "undecided": 0})
        self.assertEqual([edge["kind"] for edge in document["other_edges"]], ["degenerate"])
        self.assertEqual(document["left_out_faces"], [])
        self.assertEqual(document["input"]["units"], "mm")
        self.assertTrue(all(join["a"]["name"].startswith("#") and join["a"]["edge"].startswith("#") for join in document["joins"]))
        text = self.expect(0, "certify", BLOCK).stdout.decode()
        self.assertIn("34 sharp, 18 smooth", text)

    def test_sharp_edges_are_meant(self):
        self.expect(0, "certify", BLOCK, "--angle", "0.01", "--gap", "0.001")
        self.expect(1, "certify", BLOCK, "--angle", "0.01", "--smooth-below", "180")
        self.expect(1, "certify", BLOCK, "--gap", "0.0001")
        document = self.report(0, BLOCK, "--smooth-below", "89")
        self.assertGreater(document["summary"]["edge_classes"]["kinked"], 0)
        self.assertEqual(document["request"]["smooth_below_degrees"], 89)
        for words in (["--smooth-below", "nan"], ["--smooth-below", "181"], ["--smooth-below", "-1"]):
            self.expect(2, "certify", BLOCK, *words)

    def test_edges_of_no_face_are_curves(self):
        def lines(name, *ends):
            curves = [{"name": name, "degree": 1, "control_points": e} for e in ends]
            model = self.write(name + ".json", json.dumps({"format": "patchproof-model", "version": 1, "units": "mm", "curves": curves}))
            out = self.dir / (name + (".step" if name == "first" else ".brep"))
            self.expect(0, "convert", model, out)
            return out
        first, second = lines("first", [[0, 0], [1, 0]]), lines("second", [[1, 0], [4, 0]], [[4, 0], [4, 0.5]])
        document = self.report(0, first, second, "--angle", "0.01")
        self.assertEqual([file["format"] for file in document["curve_files"]], ["step", "brep"])
        self.assertEqual([join["edge_class"] for join in document["curve_joins"]], ["smooth", "sharp"])
        self.assertEqual(document["curve_joins"][0]["a"]["file"], str(first))
        self.expect(1, "certify", first, second, "--angle", "0.01", "--smooth-below", "180")
        # A profile speaks of surfaces: of curves alone it cannot be passed.
        self.expect(3, "certify", second, "--profile", "vda4955")
        # Back to JSON: the lines are curves again.
        self.expect(0, "convert", second, self.dir / "back.json")
        self.assertEqual(len(json.loads((self.dir / "back.json").read_text())["curves"]), 2)

    def test_the_bytes_do_not_depend_on_the_jobs(self):
        self.assertEqual(*(self.expect(0, "certify", BLOCK, "--json", "-", "--jobs", n).stdout for n in (1, 4)))

    def test_other_models_have_no_classes(self):
        document = self.report(0, CUP)
        self.assertNotIn("edge_class", document["joins"][0])
        self.assertNotIn("left_out_faces", document)

    def test_faces_that_are_not_usable(self):
        text = BLOCK.read_text()
        weights = text.index("RATIONAL_B_SPLINE_SURFACE((")
        first = text.index("(1.,", weights)
        bad = self.write("bad.step", text[:first] + "(-1.," + text[first + 4:])
        message = self.expect_refusal("certify", bad, names=[bad, " at #", "weight that is not positive"])
        label = message.split(" at ")[1].split(":")[0]
        document = self.report(0, bad, "--keep-going")
        self.assertIn(label, [face["face"] for face in document["left_out_faces"]])
        self.assertGreater(document["summary"]["edge_classes"]["smooth"], 10)
        self.assertIn("left out: face " + label, self.expect(0, "certify", bad, "--keep-going", "--quiet").stdout.decode())
        # What was not looked at is no pass.
        self.expect(3, "certify", bad, "--keep-going", "--gap", "1")

    def test_options_that_would_be_ignored(self):
        for words in (["--curvature", "1"], ["--match", "0.1"]):
            self.expect_refusal("certify", BLOCK, *words, names=[words[0], "usage"])
        self.expect_refusal("certify", CUP, "--curvature", "1", names=["--curvature", "usage"])

    def test_the_time_is_reported_when_it_is_asked_for(self):
        self.assertNotIn("seconds", self.report(0, BLOCK))
        self.assertGreater(self.report(0, BLOCK, "--time")["seconds"], 0)
        self.assertRegex(self.expect(0, "certify", BLOCK, "--time", "--quiet").stdout.decode(), r"\ntime +[0-9.e+-]+ s, [0-9.e+-]+ ms for each join\n")

    def test_approximated_surfaces(self):
        # One offset surface. What its approximation may add, a tolerance must allow for.
        document = self.report(1, BLOCK, "--gap", "1e-5")
        self.assertEqual(len(document["approximated_faces"]), 1)
        joins = [join for join in document["joins"] if "approximation" in join]
        self.assertEqual(len(joins), 4)
        for join in joins:
            self.assertGreater(join["approximation"]["length"], 1e-5)
            if join["gap"]["upper"] < 1e-5:
                self.assertEqual(join["verdict"], "undecided")
                self.assertIn("approximation", join["reason"])
        self.assertIn("approximated surfaces at 4 joins", self.expect(0, "certify", BLOCK, "--quiet").stdout.decode())

    def test_a_parameter_curve_that_the_conversion_would_mend(self):
        # Two planes; on one of them the file's parameter curve lies 0.3 beside the edge.
        path = DATA / "cad/shifted_parameter_curve.brep"
        report = json.loads(self.expect(3, "certify", path, "--gap", "0.01", "--json", "-").stdout)
        self.assertEqual(report["joins"], [])
        notes = [edge["note"] for edge in report["other_edges"] if edge["kind"] == "unusable"]
        self.assertEqual(len(notes), 1)
        self.assertIn("0.3 away from its curve in space", notes[0])

    def test_damaged_files(self):
        data = BLOCK.read_bytes()
        for name, text in (("empty.step", b""), ("header.step", b"ISO-10303-21;\n\0\xff\xfe"), ("cut.step", data[:len(data) // 3]),
                           ("empty.igs", b" " * 72 + b"S0000001\n"), ("head.brep", b"DBRep_DrawableShape\n")):
            with self.subTest(name):
                self.expect_refusal("certify", self.write(name, text), names=[name])
        self.expect_refusal("certify", self.dir, names=[self.dir])


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1] + sys.argv[3:])
