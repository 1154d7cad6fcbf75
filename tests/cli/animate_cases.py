# SPDX-License-Identifier: Apache-2.0
"""Cases of cli_test.py: GERBS curves and patches that move."""
import json
import re
import subprocess
import sys
import xml.etree.ElementTree as xml

from command import EXAMPLES, Command

GERBS = EXAMPLES / "gerbs"
HEART, BEAT = GERBS / "heart.json", GERBS / "heart_beat.motion.json"


class Animate(Command):
    def out(self, name="out"):
        return self.dir / name

    def names(self, folder):
        return sorted(p.name for p in folder.iterdir())

    def motion(self, *motions, **more):
        document = {"format": "patchproof-motion", "version": 1, "motions": list(motions), **more}
        return self.write("motion.json", json.dumps(document))

    def test_the_examples_are_what_make_writes(self):
        made = self.out("made")
        made.mkdir()
        subprocess.run([sys.executable, GERBS / "make.py", made], check=True, timeout=60)
        for path in made.iterdir():
            self.assertEqual(path.read_bytes(), (GERBS / path.name).read_bytes(), path.name)
        self.assertGreater(len(self.names(made)), 12)

    def test_the_heart_beats(self):
        self.expect(0, "animate", HEART, BEAT, self.out(), "--frames", 6, "--cells", 4)
        frames = [f"frame_{k:04}" for k in range(1, 7)]
        self.assertEqual(self.names(self.out()),
                         sorted(["animation.svg"] + [f + end for f in frames for end in (".json", ".svg")]))
        # At rest, the model; at its end moved by the given vectors, exactly.
        rest, again = self.dir / "rest.json", self.out() / "frame_0001.json"
        self.expect(0, "convert", HEART, rest)
        self.assertEqual(rest.read_bytes(), again.read_bytes())
        far = json.loads((self.out() / "frame_0004.json").read_text())["gerbs_curves"][0]
        constants = [far["locals"][l["same_as"]] if "same_as" in l else l for l in far["locals"]]
        self.assertEqual([l["control_points"][0] for l in constants],
                         [[0, 2]] + [[1, 0]] * 4 + [[0, -2]] + [[-1, 0]] * 4)
        for k, l in ((2, 6), (3, 5)):  # there and back
            self.assertEqual((self.out() / f"frame_{k:04}.json").read_bytes(), (self.out() / f"frame_{l:04}.json").read_bytes())
        boxes = {xml.parse(self.out() / (f + ".svg")).getroot().get("viewBox") for f in frames}
        self.assertEqual(len(boxes), 1)
        moving = (self.out() / "animation.svg").read_text()
        root = xml.fromstring(moving)
        self.assertEqual({root.get("viewBox")}, boxes)
        self.assertEqual(moving.count("<g class=\"frame s"), 4)  # six frames, four states
        self.assertEqual(len(re.findall(r"@keyframes", moving)), 4)
        self.assertNotIn("http", moving.replace("http://www.w3.org/2000/svg", ""))

    def test_a_torus_moves(self):
        self.expect(0, "animate", GERBS / "torus.json", GERBS / "torus.motion.json", self.out(), "--frames", 2, "--cells", 1)
        moved = self.out() / "frame_0002.json"
        self.assertIn(b"closed", self.expect(0, "info", moved).stdout)
        self.assertNotEqual(moved.read_bytes(), (self.out() / "frame_0001.json").read_bytes())

    def test_formats(self):
        self.expect(0, "animate", HEART, BEAT, self.out("a"), "--frames", 2, "--format", "json")
        self.assertEqual(self.names(self.out("a")), ["frame_0001.json", "frame_0002.json"])
        self.expect(0, "animate", HEART, BEAT, self.out("b"), "--frames", 2, "--format", "svg")
        self.assertEqual(self.names(self.out("b")), ["animation.svg", "frame_0001.svg", "frame_0002.svg"])

    def test_only_force_writes_where_something_is(self):
        self.out().mkdir()
        self.expect(0, "animate", HEART, BEAT, self.out(), "--frames", 4, "--format", "json")
        (self.out() / "notes.txt").write_text("mine")
        self.expect_refusal("animate", HEART, BEAT, self.out(), "--frames", 2, names=["out", "--force"])
        self.assertEqual(len(self.names(self.out())), 5)
        self.expect(0, "animate", HEART, BEAT, self.out(), "--frames", 2, "--format", "json", "--force")
        self.assertEqual(self.names(self.out()), ["frame_0001.json", "frame_0002.json", "notes.txt"])
        self.expect_refusal("animate", HEART, BEAT, self.out() / "notes.txt", names=["notes.txt", "directory"])
        self.expect_refusal("animate", HEART, BEAT, self.out("no") / "deep", names=["no"])
        self.expect_refusal("animate", self.out() / "frame_0001.json", BEAT, self.out(), "--force", names=["overwrite"])

    def test_bad_motions_are_refused_and_leave_nothing(self):
        move = {"curve": 0, "translate": [1, 0, 0]}
        for motions, more, words in (
                ([{"curve": 1, "translate": [1, 0, 0]}], {}, ["/motions/0/curve", "0 … 0", "[1]", "bad_reference"]),
                ([{"patch": 0, "translate": [1, 0, 0]}], {}, ["/motions/0/patch", "no GERBS patches", "bad_reference"]),
                ([move, {"curve": 0, "locals": [3, 10]}], {}, ["/motions/1/locals/1", "0 … 9", "[10]", "bad_reference"]),
                ([{"curve": 0, "locals": [-1]}], {}, ["/motions/0/locals/0", "[-1]", "bad_reference"]),
                ([{"curve": 0, "locals": [[1, 2]]}], {}, ["/motions/0/locals/0", "1, 2", "wrong_count"]),
                ([{"translate": [1, 0, 0]}], {}, ["/motions/0", "syntax"]),
                ([{"curve": 0, "patch": 0}], {}, ["/motions/0", "syntax"]),
                ([{"curve": 0, "translate": [1, 0]}], {}, ["/motions/0/translate", "wrong_count"]),
                ([{"curve": 0, "translate": [1, 0, "1/0"]}], {}, ["/motions/0/translate/2", "1/0", "bad_number"]),
                ([{"curve": 0, "translate": [1, 0, "sqrt(2)"]}], {}, ["/motions/0/translate/2", "rational", "sqrt(2)"]),
                ([{"curve": 0, "scale": [1, 0, "1e101"]}], {}, ["/motions/0/scale/2", "10^100", "bad_number"]),
                ([{"curve": 0, "rotate": {"axis": [0, 0, 0], "half_tangent": 1}}], {}, ["/rotate/axis", "bad_number"]),
                ([{"curve": 0, "rotate": {"axis": [0, 0, 1]}}], {}, ["half_tangent", "syntax"]),
                ([{"curve": 0, "shear": {"xx": 1}}], {}, ["xx", "syntax"]),
                ([move], {"pace": "expo-rational"}, ["/pace", "exact", "unsupported"]),
                ([move], {"pace": "bernstein(0,-1,1)"}, ["/pace", "not_monotone"]),
                ([move], {"pace": "quick"}, ["/pace", "quick", "syntax"]),
                ([move], {"version": 2}, ["/version", "unsupported"]),
                ([move], {"format": "patchproof-model"}, ["/format", "unknown_format"])):
            with self.subTest(str(words)):
                self.expect_refusal("animate", HEART, self.motion(*motions, **more), self.out(), names=["motion.json"] + words)
                self.assertFalse(self.out().exists())
        self.expect_refusal("animate", HEART, self.dir / "none.json", self.out(), names=["none.json", "cannot_open"])
        self.expect_refusal("animate", HEART, self.write("empty.json", ""), self.out(), names=["empty_input"])
        self.expect_refusal("animate", EXAMPLES / "cup.json", BEAT, self.out(), names=["cup.json", "GERBS"])
        self.expect_refusal("animate", self.dir / "none.json", BEAT, self.out(), names=["none.json"])
        for words in (["--frames", 1], ["--frames", 1001], ["--seconds", 0], ["--format", "gif"], ["--cells", 0]):
            self.expect(2, "animate", HEART, BEAT, self.out(), *words)
        self.assertFalse(self.out().exists())

    def test_what_cannot_be_written_leaves_nothing(self):
        (self.out() / "frame_0002.json" / "mine").mkdir(parents=True)
        self.expect_refusal("animate", HEART, BEAT, self.out(), "--frames", 2, "--force", names=["cannot be written"])
        self.assertEqual(self.names(self.out()), ["frame_0002.json"])

    def test_the_same_bytes_each_time(self):
        for name in ("a", "b"):
            self.expect(0, "animate", HEART, BEAT, self.out(name), "--frames", 2)
        for path in self.out("a").iterdir():
            self.assertEqual(path.read_bytes(), (self.out("b") / path.name).read_bytes())
