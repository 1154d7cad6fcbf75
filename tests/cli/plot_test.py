#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""plot_test.py PROGRAM SOURCE_DIR: patchproof plot: formats, choices, several models, refusals."""
import json
import os
import pathlib
import struct
import subprocess
import sys
import tempfile
import unittest
import xml.etree.ElementTree as ElementTree

if len(sys.argv) < 3:
    sys.exit(__doc__)
PROGRAM, ROOT = os.path.abspath(sys.argv[1]), pathlib.Path(sys.argv[2]).resolve()
EXAMPLES = ROOT / "examples"
CUP, SPHERE = EXAMPLES / "cup.json", EXAMPLES / "sphere_octants.json"
SVG = "{http://www.w3.org/2000/svg}"


def run(*words):
    return subprocess.run([PROGRAM, "plot", *map(str, words)], capture_output=True, timeout=120)


class Plot(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.dir = pathlib.Path(self.folder.name)
        self.curves = self.dir / "curves.json"
        self.curves.write_text('''{"format": "patchproof-model", "version": 1, "curves": [
            {"name": "arc <&>", "degree": 2, "control_points": [[1, 0], [1, 1], [0, 1]], "weights": [1, 1, 2]},
            {"degree": 1, "knots": [0, 0, 1, 1, 2, 2], "control_points": [[0, 0], [1, 0], [2, 2], [3, 2]]}]}''')

    def tearDown(self):
        self.folder.cleanup()

    def write(self, *words):
        """Runs with a file as the last word and returns its bytes."""
        done = run(*words[:-1], self.dir / words[-1])
        self.assertEqual(done.returncode, 0, done.stderr.decode())
        self.assertEqual((done.stdout, done.stderr), (b"", b""))
        return (self.dir / words[-1]).read_bytes()

    def refuse(self, *words, names=()):
        done = run(*words)
        self.assertEqual(done.returncode, 2, words)
        self.assertEqual(done.stdout, b"")
        message = done.stderr.decode()
        for name in names:
            self.assertIn(str(name), message)
        self.assertNotIn("internal error", message)
        return message

    def test_gregory_patches(self):
        for method, creases in (("new", False), ("former", True)):
            filled = self.dir / f"{method}.json"
            words = [PROGRAM, "fill", EXAMPLES / "meshes/two_faces.json", filled] + ["--method", "former"] * creases
            done = subprocess.run(words, capture_output=True, timeout=120)
            self.assertEqual(done.returncode, 1 if creases else 0, done.stderr)
            obj = self.write("--normals", "--sections", "3", filled, f"{method}.obj").decode()
            names = [line[2:] for line in obj.splitlines() if line.startswith("o ")]
            self.assertEqual(names[:2], ["F1", "F2"])
            self.assertEqual(names[5:], ["normals from the left", "normals from the right"])
            svg = ElementTree.fromstring(self.write("--control", "--normals", filled, f"{method}.svg"))
            self.assertEqual(len([e for e in svg.iter(SVG + "path") if e.get("class") == "normals"]), 2)
            for name in ("one.stl", "one.vtu", "one.glb"):
                self.assertGreater(len(self.write("--patch", "1", filled, name)), 1000)
        self.refuse("--normals", self.dir / "new.json", self.dir / "out.stl", names=["--normals", "no lines"])
        self.refuse("--sections", "0", self.dir / "new.json", self.dir / "out.svg", names=["--sections"])
        self.refuse("--patch", "2", self.dir / "new.json", self.dir / "out.svg", names=["patches 0 to 1"])

    def test_svg_of_patches_and_curves(self):
        root = ElementTree.fromstring(self.write(CUP, "cup.svg"))
        self.assertEqual(root.tag, SVG + "svg")
        self.assertEqual(root.find(SVG + "title").text, "cup")
        facets = [e for e in root.iter(SVG + "path") if e.get("class") == "facet"]
        self.assertGreater(len(facets), 100)
        root = ElementTree.fromstring(self.write(self.curves, "curves.svg"))
        self.assertEqual(len([e for e in root.iter(SVG + "path") if e.get("class") == "curve"]), 3)
        root = ElementTree.fromstring(self.write(self.curves, "--curve", "1", "--no-control", "one.svg"))
        self.assertEqual([e.get("class") for e in root.iter(SVG + "path")].count("curve"), 2)
        self.assertNotIn("polygon", [e.get("class") for e in root.iter(SVG + "path")])
        root = ElementTree.fromstring(self.write(self.curves, "--basis", "basis.svg"))
        self.assertEqual([e.get("class") for e in root.iter(SVG + "path")].count("function"), 3 + 3 + 4)

    def test_meshes(self):
        obj = self.write(SPHERE, "--cells", "2", "sphere.obj").decode()
        self.assertEqual(obj.count("\nf "), 8 * 4)
        stl = self.write(SPHERE, "sphere.stl")
        self.assertEqual(len(stl), 84 + 50 * struct.unpack_from("<I", stl, 80)[0])
        vtu = ElementTree.fromstring(self.write(SPHERE, "--patch", "3", "--cells", "5", "sphere.vtu"))
        self.assertEqual(vtu.find("UnstructuredGrid/Piece").get("NumberOfCells"), "25")
        glb = self.write(SPHERE, "sphere.glb")
        length = struct.unpack_from("<I", glb, 12)[0]
        self.assertEqual(len(json.loads(glb[20:20 + length])["meshes"]), 8)
        # The points of the tessellated sphere lie on it.
        points = [list(map(float, line.split()[1:])) for line in obj.splitlines() if line.startswith("v ")]
        self.assertEqual(len(points), 8 * 9)
        radii = [sum(x * x for x in p) for p in points]
        self.assertLess(max(radii) - min(radii), 1e-12)

    def test_standard_output_and_format(self):
        done = run(CUP, "-")
        self.assertEqual(done.returncode, 0)
        self.assertTrue(done.stdout.startswith(b"<svg"))
        self.assertEqual(run(CUP, "-").stdout, done.stdout)
        self.assertEqual(self.write(CUP, "cup.svg"), done.stdout)
        self.assertEqual(run(CUP, "--format", "glb", "-").stdout[:4], b"glTF")
        self.assertTrue(self.write(CUP, "--format", "obj", "cup.txt").startswith(b"# patchproof"))

    def test_several_models(self):
        done = run(CUP, SPHERE, self.curves, self.dir, "--format", "svg")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(sorted(p.name for p in self.dir.glob("*.svg")), ["cup.svg", "curves.svg", "sphere_octants.svg"])
        self.refuse(CUP, SPHERE, self.dir / "both.svg", names=["directory"])
        self.refuse(CUP, SPHERE, self.dir, names=["--format"])
        self.refuse(CUP, CUP, self.dir, "--format", "obj", names=["cup.obj"])

    def test_a_bad_model_among_good_ones_leaves_no_file(self):
        bad = self.dir / "bad.json"
        bad.write_text("{")
        self.refuse(CUP, bad, self.dir, "--format", "svg", names=["bad.json"])
        self.assertEqual(list(self.dir.glob("*.svg")), [])

    def test_refusals(self):
        out = self.dir / "x.svg"
        self.refuse(CUP)
        self.refuse(CUP, self.dir / "x.png", names=["x.png", "svg, obj, stl, vtu or glb"])
        self.refuse(CUP, self.dir / "x", names=["--format"])
        self.refuse(self.dir / "missing.json", out, names=["missing.json"])
        self.refuse(CUP, out, "--curve", "0", names=["no curves"])
        self.refuse(self.curves, out, "--curve", "2", names=["curves 0 to 1"])
        self.refuse(CUP, out, "--patch", "-1", names=["--patch"])
        self.refuse(CUP, out, "--cells", "0")
        self.refuse(CUP, out, "--cells", "many")
        self.refuse(CUP, out, "--control", "--no-control")
        self.refuse(CUP, out, "--cells", "1000000", names=["fewer cells"])
        self.refuse(CUP, self.dir / "x.vtu", "--cells", "1000000", names=["fewer cells"])
        self.refuse(self.curves, self.dir / "x.stl", names=["triangles"])
        self.refuse(CUP, self.dir / "x.obj", "--basis", names=["svg"])
        self.refuse(self.curves, self.curves, "--format", "svg", names=["overwrite"])
        self.refuse(CUP, self.dir / "none" / "x.svg", names=["cannot be written"])
        self.assertEqual([p.name for p in self.dir.iterdir()], ["curves.json"])


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0]])
