#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""peers_test.py PROGRAM EXAMPLE_PLUGIN BAD_PLUGIN: patchproof_peers measures plug-ins, and survives those that crash, hang,
lie or say nothing."""
import json
import os
import subprocess
import sys
import unittest

if len(sys.argv) < 4:
    sys.exit(__doc__)
PROGRAM, EXAMPLE, BAD = map(os.path.abspath, sys.argv[1:4])
del sys.argv[1:]


def peers(*words):
    return subprocess.run([PROGRAM, "--count", "0", *words], capture_output=True, timeout=900, check=False)


class Peers(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        # Both by name: the other peers have their turn in the benchmarks.
        done = peers("--plugin", EXAMPLE, "--plugin", BAD, "--only", "template", "--only", "bad", "--seconds", "2",
                     "--json", "-")
        assert done.returncode == 0, done.stderr.decode()
        cls.rows = {(r["peer"], r["arrangement"], r["group"]): r for r in json.loads(done.stdout)["rows"]}

    def row(self, group, peer="bad"):
        return self.rows[peer, "scattered", group]

    def test_the_example_is_measured(self):
        for arrangement, quantities in (("scattered", ("points", "first", "second")), ("curve", ("points", "first"))):
            row = self.rows["template", arrangement, "random"]
            for q in quantities:
                self.assertGreater(row[q]["vectors"], 50)
                self.assertGreater(row[q]["worst_ulp"], 0)
                self.assertLess(row[q]["worst_ulp"], 10_000)
        self.assertNotIn("normals", self.rows["template", "scattered", "random"])

    def test_a_crash_loses_its_case_only(self):
        row = self.row("torn")
        self.assertEqual((row["cases"], row["refused"], row["crashed"]), (6, 3, 3))
        self.assertEqual(self.row("unclamped")["crashed"], 0)
        self.assertLess(self.row("unclamped")["points"]["worst_ulp"], 1000)

    def test_an_endless_loop_is_ended(self):
        row = self.row("degree_15")
        self.assertEqual((row["cases"], row["refused"], row["timed_out"]), (2, 1, 1))

    def test_a_wrong_result_is_measured(self):
        self.assertAlmostEqual(self.row("huge")["points"]["worst_ulp"] / 2 ** 23, 0.75, delta=0.3)

    def test_silence_is_not_finite(self):
        self.assertEqual(self.row("tiny")["points"]["worst_ulp"], "not finite")

    def test_refusals_are_counted(self):
        row = self.row("zero_weights")
        self.assertEqual((row["cases"], row["refused"]), (4, 4))
        self.assertNotIn("points", row)

    def test_bad_usage(self):
        for words in (["--plugin", "/nowhere.so"], ["--plugin", PROGRAM], ["--seconds", "0"], ["extra"]):
            done = peers(*words)
            self.assertEqual(done.returncode, 2, words)
            self.assertEqual(done.stdout, b"", words)
            self.assertNotEqual(done.stderr, b"", words)


if __name__ == "__main__":
    unittest.main()
