# SPDX-License-Identifier: Apache-2.0
"""What the tests of the program share: how it is run, and what every refusal looks like. The first two words of the command
line are the program and the root of the sources."""
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

PROGRAM, ROOT = os.path.abspath(sys.argv[1]), pathlib.Path(sys.argv[2]).resolve()
EXAMPLES, DATA = ROOT / "examples", ROOT / "tests/data"
CUP, SPHERE, KINK = EXAMPLES / "cup.json", EXAMPLES / "sphere_octants.json", EXAMPLES / "seven/kink_at_end.json"


def run(*words, **more):
    return subprocess.run([PROGRAM, *map(str, words)], capture_output=True, timeout=120, **more)


class Command(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.dir = pathlib.Path(self.folder.name)

    def tearDown(self):
        self.folder.cleanup()

    def expect(self, code, *words, **more):
        done = run(*words, **more)
        self.assertEqual(done.returncode, code, f"{words}\n{done.stdout.decode()[-500:]}\n{done.stderr.decode()[-500:]}")
        return done

    def expect_refusal(self, *words, names=()):
        """Exit 2, nothing on standard output, one line on standard error that names file and place."""
        done = self.expect(2, *words)
        self.assertEqual(done.stdout, b"")
        message = done.stderr.decode(errors="replace")
        self.assertTrue(message.startswith("patchproof: "), message)
        self.assertEqual(message.count("\n"), 1, message)
        self.assertNotIn("internal error", message)
        for name in names:
            self.assertIn(str(name), message)
        return message

    def write(self, name, text):
        path = self.dir / name
        path.write_bytes(text if isinstance(text, bytes) else text.encode())
        return path
