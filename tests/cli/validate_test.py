#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""validate_test.py PROGRAM: `patchproof validate` passes, reports what it did, and notices kernels that lie."""
import json
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest
import xml.etree.ElementTree as ElementTree

if len(sys.argv) < 2:
    sys.exit(__doc__)
PROGRAM = os.path.abspath(sys.argv.pop(1))


def validate(*words):
    return subprocess.run([PROGRAM, "validate", *map(str, words)], capture_output=True, timeout=900, check=False)


class Validate(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.json, cls.junit = (pathlib.Path(cls.folder.name) / name for name in ("report.json", "report.xml"))
        cls.done = validate("--count", 1, "--json", cls.json, "--junit", cls.junit)
        cls.report = json.loads(cls.json.read_text(encoding="utf-8"))

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    def test_every_kernel_holds_on_every_instruction_set(self):
        first = [k.get("first_violation") for k in self.report["kernels"] if k["violations"]]
        self.assertEqual(self.done.returncode, 0, "\n".join(map(str, first)))
        self.assertEqual(self.report["verdict"], "pass")
        self.assertIn(b"every bound holds", self.done.stdout)

    def test_every_kernel_and_set_is_there_and_saw_every_group(self):
        sets = self.report["instruction_sets"]
        self.assertIn("portable", sets)
        evaluated = [k for k in self.report["kernels"] if not k["kernel"].startswith("decide")]
        self.assertEqual(len({k["kernel"] for k in evaluated}), 24)
        self.assertEqual(len(evaluated), 24 * len(sets))
        groups = [set(k["groups"]) for k in evaluated]
        self.assertTrue(all(g == groups[0] and len(g) >= 15 for g in groups))
        for k in evaluated:
            self.assertGreater(k["numbers"], 1000, k["kernel"])

    def test_decisions_of_joins(self):
        decided = {(k["kernel"], k["instruction_set"]): k for k in self.report["kernels"]
                   if k["kernel"].startswith("decide")}
        self.assertIn(("decide", "portable"), decided)
        for k in decided.values():
            self.assertEqual(len(k["groups"]), 11)
            self.assertEqual(k["groups"]["joins_smooth"]["without_bound"], 0)
            self.assertEqual(k["violations"], 0)

    def test_bounds_say_something(self):
        for k in self.report["kernels"]:
            if "bound_reached_within_1000" in k:
                self.assertTrue(k["bound_reached_within_1000"], k["kernel"])

    def test_rounded_is_rounded(self):
        for k in self.report["kernels"]:
            if k["kernel"] == "rounded":
                self.assertLessEqual(k["worst_ulp"], 0.5)

    def test_junit(self):
        suite = ElementTree.parse(self.junit).getroot()
        self.assertEqual(int(suite.get("tests")), len(suite.findall("testcase")))
        self.assertEqual(int(suite.get("failures")), len(suite.findall("testcase/failure")))

    def test_the_smallest_lies_are_noticed(self):
        # A correctly rounded number that is the next double instead.
        for kernel, by in (("rounded", 1), ("same bits", 1), ("compensated", 2), ("interval", 100_000),
                           ("bounded", 100_000), ("refine", 100_000), ("C", 100_000), ("grid S_uv", 100_000), ("decide", 1)):
            done = validate("--count", 0, "--group", "unclamped", "--instructions", "portable", "--break", kernel,
                            "--break-by", by)
            self.assertEqual(done.returncode, 1, kernel)
            self.assertIn(f"violated: {kernel} on portable".encode(), done.stdout)

    def test_the_same_bytes_again(self):
        words = ("--count", 0, "--group", "random", "--json", "-")
        first = validate(*words)
        self.assertEqual(first.stdout, validate(*words).stdout)
        self.assertNotEqual(first.stdout, validate(*words, "--seed", 2).stdout)

    def test_bad_usage(self):
        for words in (["--count", "-1"], ["--instructions", "mmx"], ["--json", "-", "--junit", "-"], ["extra"],
                      ["--break", "nothing"], ["--group", "nothing"], ["--seed", "x"]):
            done = validate(*words)
            self.assertEqual(done.returncode, 2, words)
            self.assertEqual(done.stdout, b"", words)
            self.assertNotEqual(done.stderr, b"", words)


if __name__ == "__main__":
    unittest.main()
