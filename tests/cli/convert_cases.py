# SPDX-License-Identifier: Apache-2.0
"""convert by extension, and profiles of thresholds: cases of cli_test.py."""
import json

from command import CUP, ROOT, SPHERE, Command, run


class Convert(Command):
    def surfaces(self, path):
        """Homogeneous nets of all patches as doubles, with their knots."""
        document = json.loads(self.expect(0, "convert", path, "-").stdout)
        number = lambda x: eval(x.replace("sqrt", "__import__('math').sqrt")) if isinstance(x, str) else x
        flat = lambda x: [y for part in x for y in flat(part)] if isinstance(x, list) else [number(x)]
        return [(p["degree"], flat(p.get("knots", [])), flat(p["control_points"])) for p in document["patches"]]

    def test_g2_has_the_same_surfaces(self):
        out = self.dir / "out.g2"
        done = self.expect(0, "convert", CUP, out)
        self.assertEqual(done.stdout, b"")
        self.assertIn(b"note: 35 names left out", done.stderr)
        self.assertEqual(self.surfaces(out), self.surfaces(CUP))

    def test_cad_formats(self):
        for name in ("out.step", "out.STP", "out.brep", "out.iges", "out.igs"):
            out = self.dir / name
            done = run("convert", CUP, out)
            if b"need a build with Open CASCADE" in done.stderr:
                self.assertEqual(done.returncode, 2)
                self.assertFalse(out.exists())
                continue
            self.assertEqual((done.returncode, done.stdout), (0, b""))
            for (degree, knots, points), (degree_back, knots_back, points_back) in zip(self.surfaces(CUP), self.surfaces(out),
                                                                                   strict=True):
                self.assertEqual((degree, knots), (degree_back, knots_back))
                for a, b in zip(points, points_back, strict=True):
                    self.assertAlmostEqual(a, b, delta=1e-12)
            self.assertIn(b"untrimmed", self.expect(0, "convert", out, self.dir / "back.json").stderr)

    def test_gregory_patches_are_approximated_and_said_so(self):
        filled = self.dir / "filled.json"
        self.expect(0, "fill", ROOT / "examples/meshes/two_faces.json", filled)
        bounds = []
        for cells in (2, 8, 32):
            done = self.expect(0, "convert", "--cells", cells, filled, self.dir / "out.g2")
            note = done.stderr.decode()
            self.assertIn("2 of 2 Gregory patches approximated", note)
            bounds.append(float(note.split("points within ")[1].split()[0]))
        self.assertEqual(bounds, sorted(bounds, reverse=True))
        self.assertEqual(len(self.surfaces(self.dir / "out.g2")), 2)
        self.assertNotIn(b"approximated", self.expect(0, "convert", filled, self.dir / "out.json").stderr)
        self.assertIn(b"--cells", self.expect(2, "convert", "--cells", "65", filled, self.dir / "no.g2").stderr)

    def test_what_cannot_be_written(self):
        self.expect_refusal("convert", CUP, self.dir / "out.stl", names=["out.stl", ".step"])
        self.assertFalse((self.dir / "out.stl").exists())
        jump = self.write("tiny.json", """{"format":"patchproof-model","version":1,"patches":[
          {"degree":[1,1],"control_points":[[[0,0,0],[0,1,0]],[[1,0,0],[1,1,"1e-400"]]]}]}""")
        self.expect_refusal("convert", jump, self.dir / "out.g2", names=["patch 0", "1/1"])


class Profiles(Command):
    def test_list_needs_no_model(self):
        text = self.expect(0, "certify", "--profile", "list").stdout.decode()
        for name in ("mil-std-31000a", "vda4955", "catia", "class-a", "class-b", "class-c", "source:", "(not checked)",
                     "G-SU-NT", "g1_discontinuous_surface"):
            self.assertIn(name, text)

    def test_exit_codes(self):
        self.expect(0, "certify", SPHERE, "--profile", "class-a")
        self.expect(1, "certify", CUP, "--profile", "mil-std-31000a")
        self.expect(0, "certify", CUP, "--profile", "mil-std-31000a", "--angle", "30")
        self.expect(2, "certify", CUP, "--profile", "class-d")
        self.expect(2, "certify", "--profile", "catia")

    def test_units(self):
        text = CUP.read_text()
        self.assertIn('"units": "mm"', text)
        strange = self.write("strange.json", text.replace('"units": "mm"', '"units": "parsec"'))
        self.expect_refusal("certify", strange, "--profile", "catia", names=["parsec", "--gap"])
        self.expect(1, "certify", strange, "--profile", "catia", "--gap", "1")
        metres = self.write("metres.json", text.replace('"units": "mm"', '"units": "m"'))
        document = json.loads(self.expect(1, "certify", metres, "--profile", "class-c", "--json", "-").stdout)
        self.assertEqual(document["request"]["gap"], 5e-5)
        self.assertEqual(document["profile"]["criteria"][0]["threshold"], 0.05)
