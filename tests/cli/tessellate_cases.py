# SPDX-License-Identifier: Apache-2.0
"""Cases of cli_test.py: triangles, what is proved of them, and what the files hold."""
import json
import struct
from collections import Counter

from command import EXAMPLES, Command


def ply_triangles(data):
    """The vertices (as bytes) and triangles of a binary PLY file."""
    head, body = data.split(b"end_header\n", 1)
    count = {w[1]: int(w[2]) for w in (line.split() for line in head.decode().splitlines()) if w[0] == "element"}
    vertices = [body[24 * i:24 * i + 24] for i in range(count["vertex"])]
    body, faces = body[24 * count["vertex"]:], []
    for k in range(count["face"]):
        n, a, b, c = struct.unpack_from("<Biii", body, 13 * k)
        assert n == 3
        faces.append((a, b, c))
    assert len(body) == 13 * count["face"]
    return vertices, faces


def edges_by_use(vertices, triangles):
    uses = Counter()
    for t in triangles:
        for i in range(3):
            uses[frozenset((vertices[t[i]], vertices[t[(i + 1) % 3]]))] += 1
    return Counter(uses.values())


class Tessellate(Command):
    SPHERE = EXAMPLES / "sphere_octants.json"

    def test_a_sphere_is_closed_in_its_file(self):
        out, report = self.dir / "sphere.ply", self.dir / "report.json"
        text = self.expect(0, "tessellate", self.SPHERE, out, "--chord", 0.02, "--angle", 12, "--json", report).stdout.decode()
        self.assertIn("watertight: yes, closed", text)
        vertices, triangles = ply_triangles(out.read_bytes())
        self.assertEqual(len(set(vertices)), len(vertices))
        self.assertEqual(set(edges_by_use(vertices, triangles)), {2})
        self.assertEqual(len(vertices) - 3 * len(triangles) // 2 + len(triangles), 2)
        found = json.loads(report.read_text())
        self.assertTrue(found["proved"])
        self.assertEqual((found["vertices"], found["triangles"]), (len(vertices), len(triangles)))
        self.assertLessEqual(found["chord"]["proved"], 0.02)
        self.assertLessEqual(found["angle"]["proved"], 12)

    def test_every_format_and_method(self):
        for extension in ("stl", "obj", "ply", "glb", "vtu"):
            for method in ("adaptive", "regular"):
                out = self.dir / f"{method}.{extension}"
                self.expect(0, "tessellate", EXAMPLES / "cylinder.json", out, "--chord", 0.05, "--method", method)
                self.assertGreater(out.stat().st_size, 100)

    def test_free_edges_are_counted(self):
        text = self.expect(0, "tessellate", EXAMPLES / "cylinder.json", self.dir / "c.stl", "--chord", 0.05).stdout.decode()
        self.assertRegex(text, r"watertight: yes, but for \d+ edges of triangles on free edges")

    def test_jobs_do_not_matter(self):
        for jobs in (1, 4):
            self.expect(0, "tessellate", self.SPHERE, self.dir / f"{jobs}.ply", "--chord", 0.02, "--jobs", jobs)
        self.assertEqual((self.dir / "1.ply").read_bytes(), (self.dir / "4.ply").read_bytes())

    def test_bad_requests_are_refused_and_leave_nothing(self):
        out = self.dir / "out.ply"
        for arguments, names in ((("--chord", 0), ["chord", "usage"]), (("--chord", -1), ["chord", "usage"]),
                                 (("--chord", "nan"), ["chord", "usage"]), (("--chord", 1, "--angle", 0), ["angle", "usage"]),
                                 (("--chord", 1e-9, "--max-triangles", 100), ["100", "usage"]),
                                 (("--chord", 1, "--method", "delaunay"), ["delaunay", "unsupported"])):
            self.expect_refusal("tessellate", self.SPHERE, out, *arguments, names=names)
            self.assertFalse(out.exists())
        self.expect_refusal("tessellate", self.SPHERE, self.dir / "out.png", "--chord", 1, names=[".png", "usage"])
        self.expect_refusal("tessellate", self.dir / "none.json", out, "--chord", 1, names=["none.json", "cannot_open"])

    def test_a_fan_at_a_pole_has_no_cracks(self):
        """The triangle that is left out at the pole has a side on the border of the model: its neighbour ends there."""
        net = [[[0, 0, 1]] * 3] + [[[1, j - 1, z] for j in range(3)] for z in (1, 0)]
        model = self.write("pole.json", json.dumps({"format": "patchproof-model", "version": 1,
                                                    "patches": [{"degree": [2, 2], "control_points": net}]}))
        out = self.dir / "pole.ply"
        text = self.expect(0, "tessellate", model, out, "--chord", 0.01).stdout.decode()
        vertices, triangles = ply_triangles(out.read_bytes())
        uses = edges_by_use(vertices, triangles)
        self.assertEqual(set(uses), {1, 2})
        self.assertIn(f"watertight: yes, but for {uses[1]} edges of triangles on free edges of the model\n", text)
