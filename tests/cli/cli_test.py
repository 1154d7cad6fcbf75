#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""cli_test.py PROGRAM SOURCE_DIR: the program's commands, exit codes, outputs and messages."""
import json
import os
import resource
import signal
import subprocess
import sys
import tempfile
import unittest
from fractions import Fraction

sys.dont_write_bytecode = True  # the sources may be read-only
if len(sys.argv) < 3:
    sys.exit(__doc__)
from animate_cases import Animate
from command import CUP, DATA, EXAMPLES, KINK, PROGRAM, SPHERE, Command, run
from convert_cases import Convert, Profiles
from curve_cases import Curves
from fill_cases import Fill
from fit_cases import Fit
from gerbs_cases import Gerbs
from tessellate_cases import Tessellate


class Certify(Command):
    def test_exit_0_when_nothing_is_asked_or_all_is_proven(self):
        self.assertIn(b"largest gap", self.expect(0, "certify", CUP).stdout)
        self.expect(0, "certify", SPHERE, "--require", "G1", "--gap", "0", "--angle", "0")
        self.expect(0, "certify", SPHERE, "--require", "C1")

    def test_exit_1_when_something_is_refuted_or_exceeds(self):
        self.expect(1, "certify", KINK, "--require", "G1")
        self.expect(1, "certify", CUP, "--gap", "1e-9")
        self.expect(1, "certify", CUP, "--angle", "1")

    def test_exit_2_for_bad_usage(self):
        for words in ([], ["certify"], ["polish", CUP], ["certify", CUP, "--require", "C7"], ["certify", CUP, "--gap", "-1"],
                      ["certify", CUP, "--gap", "nan"], ["certify", CUP, "--angle", "nan"], ["certify", CUP, "--match", "nan"],
                      ["certify", CUP, "--budget", "nan"], ["certify", CUP, "--budget", "-1"], ["certify", CUP, "--angle", "181"],
                      ["certify", CUP, "--gap", "inf"], ["certify", CUP, "--gap", "1mm"], ["certify", CUP, "--jobs", "0"],
                      ["certify", CUP, "--decimals", "float"], ["certify", CUP, "--unknown"], ["evaluate", CUP]):
            done = self.expect(2, *words)
            self.assertEqual(done.stdout, b"", words)
            self.assertNotEqual(done.stderr, b"", words)

    def test_exit_3_when_something_stays_undecided(self):
        # One straight edge, run through at another pace: its pairing is found numerically and decides nothing.
        model = self.write("pace.json", b'''{"format":"patchproof-model","version":1,"patches":[
          {"degree":[1,1],"control_points":[[[0,0,0],[0,1,0]],[[1,0,0],[1,1,0]]]},
          {"degree":[1,2],"control_points":[[[1,0,0],[1,"1/3",0],[1,1,0]],[[2,0,0],[2,"1/3",0],[2,1,0]]]}]}''')
        document = json.loads(self.expect(3, "certify", model, "--require", "C0", "--json", "-").stdout)
        self.assertEqual(document["verdict"], "undecided")
        self.assertEqual(document["summary"]["fail"], 0)
        self.assertGreater(document["summary"]["undecided"], 0)

    def test_json_to_standard_output_is_only_json(self):
        done = self.expect(0, "certify", CUP, "--json", "-")
        document = json.loads(done.stdout)
        self.assertEqual(document["tool"], "patchproof")
        self.assertEqual(document["input"]["joins"], len(document["joins"]))
        self.assertEqual(done.stderr, b"")

    def test_the_bytes_do_not_depend_on_the_jobs(self):
        outputs = {self.expect(0, "certify", CUP, "--json", "-", "--jobs", n).stdout for n in (1, 2, 8)}
        self.assertEqual(len(outputs), 1)
        self.assertEqual(len({self.expect(0, "certify", CUP, "--jobs", n).stdout for n in (1, 2, 8)}), 1)

    def test_json_file_beside_the_table(self):
        out = self.dir / "report.json"
        done = self.expect(1, "certify", KINK, "--require", "C1", "--json", out)
        self.assertIn(b"verdict", done.stdout)
        self.assertEqual(json.loads(out.read_text())["verdict"], "fail")
        self.assertEqual(sorted(p.name for p in self.dir.iterdir()), ["report.json"])

    def test_several_models(self):
        done = self.expect(1, "certify", SPHERE, KINK, "--require", "G1", "--json", "-")
        documents = json.loads(done.stdout)
        self.assertEqual([d["verdict"] for d in documents], ["pass", "fail"])
        table = self.expect(0, "certify", SPHERE, KINK).stdout
        self.assertIn(b"sphere_octants.json", table)
        self.assertIn(b"kink_at_end.json", table)

    def test_a_bad_model_among_good_ones_leaves_no_report(self):
        out = self.dir / "report.json"
        self.expect_refusal("certify", SPHERE, self.write("empty.json", ""), "--json", out, names=["empty.json"])
        self.assertFalse(out.exists())

    def test_budgets_end(self):
        done = self.expect(0, "certify", CUP, "--budget", "0", "--json", "-")
        full = json.loads(self.expect(0, "certify", CUP, "--json", "-").stdout)
        for quick, slow in zip(json.loads(done.stdout)["joins"], full["joins"]):
            for name in ("C0", "C1", "C2", "G1"):
                if quick["exact"][name] != "undecided":
                    self.assertEqual(quick["exact"][name], slow["exact"][name])
            for bound in ("gap", "angle_degrees"):
                if quick[bound]["upper"] is not None:  # there may be no time for any bound
                    self.assertLessEqual(slow[bound]["lower"], quick[bound]["upper"])
                self.assertLessEqual(quick[bound]["lower"], slow[bound]["upper"])

    def test_quiet(self):
        quiet = self.expect(0, "certify", CUP, "--quiet").stdout
        self.assertLess(quiet.count(b"\n"), 12)
        self.assertIn(b"65 joins", quiet)


class BadInput(Command):
    def test_every_bad_file(self):
        bad = sorted(p for p in DATA.rglob("bad_*") if p.is_file())
        self.assertGreaterEqual(len(bad), 7)
        for path in bad:
            for command in ("certify", "info"):
                with self.subTest(f"{command} {path.name}"):
                    self.expect_refusal(command, path, names=[path.name])

    def test_missing_directory_and_empty(self):
        self.expect_refusal("certify", self.dir / "none.json", names=["none.json"])
        self.expect_refusal("certify", self.dir, names=[self.dir.name])
        self.expect_refusal("info", self.write("empty.bpt", ""), names=["empty.bpt"])

    def test_every_truncation_of_a_model(self):
        text = KINK.read_bytes()
        for cut in range(1, len(text.rstrip()), 37):
            self.expect_refusal("info", self.write("cut.json", text[:cut]), names=["cut.json"])

    def test_hostile_bytes(self):
        for i, text in enumerate((b"\0" * 100, b"\xff\xfe\x00[", b"[" * 100000, b"{" * 100000, b'{"a":' * 50000, b"1 " * 100000,
                                  b"<" * 1000, b"<a>" * 20000, b"9" * 1000000, b"3\n1 2 3\n4 5 6\nnan 0 0\n")):
            self.expect_refusal("certify", self.write(f"hostile{i}", text), names=[f"hostile{i}"])

    def test_names_that_are_no_utf8(self):
        path = os.path.join(os.fsencode(self.dir), b"caf\xe9.json")
        with open(path, "wb") as out:
            out.write(KINK.read_bytes())
        for words in ([b"certify", path, b"--json", b"-"], [b"evaluate", path, b"--at", b"0,0", b"--json", b"-"]):
            done = subprocess.run([os.fsencode(PROGRAM), *words], capture_output=True, timeout=60)
            self.assertEqual(done.returncode, 0, done.stderr)
            json.loads(done.stdout)


class Output(Command):
    def test_unwritable_places(self):
        self.expect_refusal("certify", KINK, "--json", self.dir / "none/report.json", names=["report.json"])
        self.expect_refusal("convert", KINK, self.dir / "none/model.json", names=["model.json"])
        (self.dir / "folder").mkdir()
        self.expect_refusal("convert", KINK, self.dir / "folder", names=["folder"])
        self.assertEqual(sorted(p.name for p in self.dir.iterdir()), ["folder"])

    def test_a_full_disk(self):
        def no_room():  # every write to a file fails
            signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
            resource.setrlimit(resource.RLIMIT_FSIZE, (0, 0))

        def run_without_room(words, stdout):
            return subprocess.run([PROGRAM, *map(str, words)], stdout=stdout, stderr=subprocess.PIPE, timeout=60,
                                  preexec_fn=no_room, restore_signals=False)

        for words in (["certify", CUP], ["certify", CUP, "--json", "-"], ["info", CUP], ["convert", CUP, "-"],
                      ["evaluate", CUP, "--at", "0,0"]):
            with tempfile.TemporaryFile() as full:
                done = run_without_room(words, full)
            self.assertEqual(done.returncode, 2, words)
            self.assertIn(b"standard output", done.stderr)
        for words in (["convert", CUP, self.dir / "out.json"], ["certify", CUP, "--json", self.dir / "out.json"]):
            done = run_without_room(words, subprocess.DEVNULL)
            self.assertEqual(done.returncode, 2, words)
            self.assertIn(b"out.json", done.stderr)
            self.assertEqual(list(self.dir.iterdir()), [], "a partial file was left")

    def test_a_closed_standard_output(self):
        done = subprocess.run([PROGRAM, "info", str(CUP)], stderr=subprocess.PIPE, timeout=60, preexec_fn=lambda: os.close(1))
        self.assertEqual(done.returncode, 2)

    def test_pipes_stay_pipes(self):
        fifo = self.dir / "pipe"
        os.mkfifo(fifo)
        with subprocess.Popen([PROGRAM, "convert", str(KINK), str(fifo)], stderr=subprocess.PIPE) as process:
            text = fifo.read_bytes()
            self.assertEqual(process.wait(60), 0)
        self.assertEqual(json.loads(text)["format"], "patchproof-model")
        self.assertTrue(fifo.is_fifo())


class Others(Command):
    def test_help_and_version(self):
        self.assertIn(b"certify", self.expect(0, "--help").stdout)
        for command in ("certify", "evaluate", "info", "convert"):
            self.assertIn(b"--", self.expect(0, command, "--help").stdout)
        self.assertRegex(self.expect(0, "--version").stdout.decode(), r"^patchproof \d+\.\d+\.\d+\n$")

    def test_evaluate_agrees_in_all_scalars(self):
        for path, patch, at in ((CUP, 3, "1/3,0.7"), (SPHERE, 0, "1/7,3/5"), (EXAMPLES / "torus_q.json", 5, "0.25,1"), (KINK, 1, "0,1")):
            values = {}
            for scalar in ("rational", "interval", "double"):
                done = self.expect(0, "evaluate", path, "--patch", patch, "--at", at, "--derivatives", 3, "--scalar", scalar, "--json", "-")
                values[scalar] = json.loads(done.stdout)["values"]
            self.assertEqual(len(values["rational"]), 10)
            for exact, enclosure, rounded in zip(*(values[s] for s in ("rational", "interval", "double"))):
                for x, i, d in zip(exact["value"], enclosure["value"], rounded["value"]):
                    low, high = (Fraction(float(t)) for t in i.strip("[]").split(", "))
                    scale = max(1, abs(high))
                    self.assertLess(high - low, scale * Fraction(1, 10**9))
                    self.assertLess(abs(Fraction(float(d)) - low), scale * Fraction(1, 10**9))
                    if "sqrt" not in x:
                        self.assertTrue(low <= Fraction(x) <= high, f"{x} not in {i}")

    def test_evaluate_refuses(self):
        for more in (["--at", "2,0"], ["--at", "0"], ["--at", "a,0"], ["--at", "0,1/0"], ["--at", "nan,0"], ["--at", "0,0,0"],
                     ["--at", "0,0", "--patch", "99"], ["--at", "0,0", "--patch", "-1"]):
            self.expect_refusal("evaluate", CUP, *more)

    def test_convert_round_trip(self):
        for path in [CUP, SPHERE, *sorted(p for p in DATA.rglob("good_*") if p.is_file())]:
            with self.subTest(path.name):
                once, twice = self.dir / "once.json", self.dir / "twice.json"
                self.expect(0, "convert", path, once)
                self.expect(0, "convert", once, twice)
                self.assertEqual(once.read_bytes(), twice.read_bytes())
                self.assertEqual(self.expect(0, "convert", once, "-").stdout, once.read_bytes())
                a, b = (json.loads(self.expect(0, "certify", p, "--json", "-").stdout) for p in (path, once))
                for part in ("joins", "summary", "unmatched_edges", "collapsed_edges"):
                    self.assertEqual(a[part], b[part])

    def test_convert_onto_itself(self):
        copy = self.write("model.json", KINK.read_bytes())
        self.assertIn(b"would overwrite", self.expect(2, "convert", copy, copy).stderr)
        self.assertIn(b"would overwrite", self.expect(2, "certify", copy, "--json", copy).stderr)
        self.assertEqual(copy.read_bytes(), KINK.read_bytes())

    def test_info(self):
        text = self.expect(0, "info", CUP).stdout.decode()
        self.assertIn("35 patches", text)
        self.assertIn("numbers in Q\n", text)
        self.assertIn("Q(√d)", self.expect(0, "info", SPHERE).stdout.decode())

    def info(self, **parts):
        """What info says of a model: the lines after the heading, stripped."""
        model = self.write("info.json", json.dumps({"format": "patchproof-model", "version": 1, **parts}))
        lines = self.expect(0, "info", model).stdout.decode().splitlines()
        self.assertTrue(all(len(line) <= 100 for line in lines[2:]), lines)
        return [" ".join(line.split()) for line in lines[2:]]

    def test_info_of_curves(self):
        corner = {"name": "C2 with a corner", "degree": 3, "knots": [0, 0, 0, 0, 1, 2, 3, 3, 3, 3],
                  "control_points": [[0, 0], [2.5, 5], [2.5, 5], [2.5, 5], [6, 1], [9, 3]]}
        self.assertEqual(self.info(curves=[corner]), [
            'curve 0 "C2 with a corner": plane, polynomial, open',
            "degree 3, 6 control points, domain [0, 3], 3 spans", "knots 0×4 1 2 3×4",
            "at knot times promised actual first jump, right minus left",
            "1 1 C2 C2 order 3: (-39/4, -36) no speed, no tangent", "2 1 C2 C2 order 3: (-3, 36)"])
        torn = {"degree": 2, "knots": [0, 0, 0, 1, 1, 1, 1, 2, 2, 2],
                "control_points": [[0, 0], [-1, 2], [1, 4], [2, 3], [1, 1], [1, 2], [2.5, 1]]}
        text = self.info(curves=[torn])
        self.assertIn("components [0, 1] [1, 2]", text)
        self.assertIn("without influence: control point 3", text)
        self.assertIn("1 4 jump jump order 0: (0, -3)", text)
        negative = {"degree": 2, "control_points": [[1, 0, 0], [1, 1, 0], [0, 1, 0]], "weights": [1, -1, 2]}
        self.assertIn("rational, w > 0 everywhere", self.info(curves=[negative])[0])

    def test_info_of_a_full_circle(self):
        """Promised C0, truly C1, and no break at all where two of the quarters are one half circle."""
        circle = {"degree": 2, "knots": [0, 0, 0, 1, 1, 2, 2, 3, 3, 4, 4, 4], "weights": [1, 1, 2, 1, 1, 1, 2, 1, 1],
                  "control_points": [[1, 0], [1, 1], [0, 1], [-1, 1], [-1, 0], [-1, -1], [0, -1], [1, -1], [1, 0]]}
        text = self.info(curves=[circle])
        self.assertEqual(text[0], "curve 0: plane, rational, w > 0 everywhere, closed, smooth at the seam")
        self.assertEqual(text[4:], ["1 2 C0 C1 order 2: (-2, 0)", "2 2 C0 smooth", "3 2 C0 C1 order 2: (2, 0)"])

    def test_info_of_patches(self):
        self.assertEqual(self.expect(0, "info", EXAMPLES / "torus.json").stdout.decode().count("2      C0        C1"), 6)
        self.assertEqual(self.expect(0, "info", EXAMPLES / "torus.json").stdout.decode().count("closed, C1 at the seam"), 2)
        # Bilinear over two spans: a plane has no break in u, and a fold in v.
        folded = [[[u, v, 0 if v < 2 else 1] for v in range(3)] for u in range(3)]
        text = self.info(patches=[{"degree": [1, 1], "knots": [[0, 0, 1, 2, 2], [0, 0, 1, 2, 2]], "control_points": folded}])
        self.assertEqual([line for line in text if line.startswith("1 ")], ["1 1 C0 smooth", "1 1 C0 C0"])
        self.assertIn("u: degree 3, 4 rows, Bézier on [0, 1]", self.expect(0, "info", CUP).stdout.decode())
        # One column of weights bends the rows: then the same net is no longer smooth in u.
        bent = [[1, 1, 1], [1, 1, 2], [1, 1, 1]]
        text = self.info(patches=[{"degree": [1, 1], "knots": [[0, 0, 1, 2, 2], [0, 0, 1, 2, 2]], "control_points": folded,
                                   "weights": bent}])
        self.assertEqual([line for line in text if line.startswith("1 ")], ["1 1 C0 C0", "1 1 C0 C0"])

    def test_info_of_many_knots_is_short(self):
        n = 500
        knots = [0] * 4 + list(range(1, n - 3)) + [n - 3] * 4
        text = self.info(curves=[{"degree": 3, "knots": knots, "control_points": [[i, i * i % 7, 0] for i in range(n)]}])
        self.assertLess(len(text), 12)
        self.assertTrue(any("knots of multiplicity 1, C2 promised, C2: 1 2 3" in line for line in text), text)
        # Exact numbers too long for a table are rounded there, and marked.
        third = f"{10**30 + 1}/{3 * 10**30}"
        text = self.info(curves=[{"degree": 1, "knots": [0, 0, third, 1, 1], "control_points": [[0, 0], [1, 1], [2, 0]]}])
        self.assertTrue(any(line.startswith("≈0.3333333 1 C0 C0") for line in text), text)

    def test_info_keeps_names_on_one_line(self):
        text = self.info(curves=[{"name": "two\nlines\u001b[31m", "degree": 1, "control_points": [[0, 0], [1, 1]]}])
        self.assertEqual(text[0], 'curve 0 "two?lines?[31m": plane, polynomial, open')

    def test_binary64_decimals_are_other_numbers(self):
        exact = json.loads(self.expect(0, "certify", CUP, "--json", "-").stdout)
        rounded = json.loads(self.expect(0, "certify", CUP, "--json", "-", "--decimals", "binary64").stdout)
        self.assertEqual((exact["input"]["decimals"], rounded["input"]["decimals"]), ("exact", "binary64"))
        self.assertEqual(exact["input"]["sha256"], rounded["input"]["sha256"])


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1] + sys.argv[3:])
