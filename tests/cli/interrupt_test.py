#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""interrupt_test.py PROGRAM SOURCE_DIR: Ctrl-C and its like leave no half-written file, and no process behind."""
import os
import pathlib
import resource
import signal
import subprocess
import sys
import time
import unittest

sys.dont_write_bytecode = True  # the sources may be read-only
if len(sys.argv) < 3:
    sys.exit(__doc__)
from command import CUP, EXAMPLES, PROGRAM, Command

BLOCK = EXAMPLES / "cad/block.step"
PATIENCE = 60  # seconds; nothing here depends on how fast the machine is


def with_default_signals():
    for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
        signal.signal(number, signal.SIG_DFL)


def wait_until(condition):
    end = time.monotonic() + PATIENCE
    while not condition():
        if time.monotonic() > end:
            raise TimeoutError
        time.sleep(0.002)


def children(process):
    return pathlib.Path(f"/proc/{process.pid}/task/{process.pid}/children").read_text().split()


def state(pid):
    """As ps prints it: R, S, T (stopped), Z (ended, not yet waited for), X; the last as well where there is none."""
    try:
        return pathlib.Path(f"/proc/{pid}/stat").read_text().rsplit(")", 1)[1].split()[0]
    except (FileNotFoundError, ProcessLookupError):
        return "X"


def is_gone(pid):
    return state(pid) in "ZX"


class Interrupts(Command):
    def start(self, *words, preexec_fn=with_default_signals):
        process = subprocess.Popen([PROGRAM, *map(str, words)], stdout=subprocess.PIPE, stderr=subprocess.PIPE, preexec_fn=preexec_fn)
        self.addCleanup(self.close, process)
        self.addCleanup(process.kill)
        return process

    def close(self, process):
        """Without waiting for the pipes' other ends: a stopped child would hold them for ever."""
        process.wait(timeout=PATIENCE)
        process.stdout.close()
        process.stderr.close()

    def long_file(self):
        """Zeros that take no room on the disk and a while to read; no model."""
        path = self.dir / "model.json"
        with path.open("wb") as file:
            file.truncate(200 << 20)
        return path

    def stopped(self, is_there, *words, **more):
        """The program, stopped where `is_there` holds. What passes by too quickly is tried again."""
        for _ in range(100):
            process = self.start(*words, **more)
            while process.poll() is None and not is_there(process):
                time.sleep(0.0005)
            process.send_signal(signal.SIGSTOP)  # is nothing to a process that has ended
            wait_until(lambda: process.poll() is not None or state(process.pid) == "T")
            if process.poll() is None and is_there(process):
                return process
            process.send_signal(signal.SIGCONT)
            process.communicate(timeout=PATIENCE)
        self.fail("the program was a hundred times too fast")

    @staticmethod
    def reads(path):
        """The program has its name by now: it is beyond the shell of Python that starts it."""
        def is_there(process):
            try:
                names = {os.readlink(entry) for entry in pathlib.Path(f"/proc/{process.pid}/fd").iterdir()}
            except OSError:
                return False
            return str(path.resolve()) in names
        return is_there

    def expect_interrupted(self, process, number):
        process.send_signal(number)
        process.send_signal(signal.SIGCONT)
        out, err = process.communicate(timeout=PATIENCE)
        self.assertEqual(process.returncode, 128 + number, err)
        self.assertEqual((out, err), (b"", b"patchproof: interrupted\n"))

    def expect_files(self, *names):
        self.assertEqual(sorted(p.name for p in self.dir.iterdir()), sorted(names))

    def test_while_a_model_is_read(self):
        model, out = self.long_file(), self.dir / "report.json"
        out.write_text("of yesterday")
        for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
            for words in (["certify", CUP, model, "--json", out], ["convert", model, out]):
                with self.subTest(words=words, number=number):
                    self.expect_interrupted(self.stopped(self.reads(model), *words), number)
                    self.assertEqual(out.read_text(), "of yesterday")
                    self.expect_files("model.json", "report.json")

    def test_while_files_are_written(self):
        """Whenever the signal comes: the old file, or the new one, and nothing else."""
        out = self.dir / "out.json"
        self.expect(0, "convert", CUP, out)
        whole = out.read_bytes()
        for attempt in range(20):
            out.write_text("old")
            process = self.start("convert", CUP, out)
            wait_until(lambda: process.poll() is not None or len(list(self.dir.iterdir())) > 1 or out.read_bytes() != b"old"
                       or attempt % 2 == 0)
            process.send_signal(signal.SIGINT)
            process.communicate(timeout=PATIENCE)
            self.assertIn(process.returncode, (0, 130, -signal.SIGINT))  # the last: before the program began
            self.assertIn(out.read_bytes(), (b"old", whole))
            if process.returncode == 0:
                self.assertEqual(out.read_bytes(), whole)
            self.expect_files("out.json")

    def test_a_file_that_cannot_be_written_whole(self):
        out = self.dir / "out.json"
        out.write_text("old")
        done = self.expect(2, "convert", CUP, out, preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (1000, 1000)))
        self.assertIn(b"cannot be written", done.stderr)
        self.assertEqual(out.read_text(), "old")
        self.expect_files("out.json")

    def test_what_is_ignored_stays_ignored(self):
        model = self.long_file()
        process = self.stopped(self.reads(model), "convert", model, self.dir / "out.json",
                               preexec_fn=lambda: signal.signal(signal.SIGINT, signal.SIG_IGN))
        process.send_signal(signal.SIGINT)
        process.send_signal(signal.SIGCONT)
        process.communicate(timeout=PATIENCE)
        self.assertEqual(process.returncode, 2)  # zeros are no model

    def test_pipes_and_devices_are_not_waited_for(self):
        pipe = self.dir / "pipe.step"
        os.mkfifo(pipe)
        for path in (pipe, "/dev/zero", "/dev/null", self.dir):
            for words in (["certify", path], ["convert", path, self.dir / "out.json"], ["info", path]):
                with self.subTest(words=words):
                    self.expect_refusal(*words, names=[path, "cannot_open"])

    def test_while_joins_are_certified(self):
        if not self.reads_step():
            self.skipTest("STEP files are not read by this build")
        out = self.dir / "report.json"
        out.write_text("of yesterday")

        def certifies(process):  # in as many threads, once the file is read
            try:
                threads = len(os.listdir(f"/proc/{process.pid}/task"))
            except OSError:
                return False
            return threads > 2 and out.read_text() == "of yesterday"

        for number in (signal.SIGINT, signal.SIGTERM):
            process = self.stopped(certifies, "certify", BLOCK, "--json", out, "--jobs", "4")
            self.expect_interrupted(process, number)
            self.assertEqual(out.read_text(), "of yesterday")
            self.expect_files("report.json")

    def test_the_first_reading_in_a_child_ends_too(self):
        if not self.reads_step():
            self.skipTest("STEP files are not read by this build")
        for _ in range(100):
            process = self.start("certify", BLOCK, "--json", self.dir / "report.json")
            child = self.stop_the_reading_child(process)
            if child:
                break
            process.communicate(timeout=PATIENCE)  # the child was faster
        else:
            self.fail("the child ended a hundred times before it could be stopped")
        self.addCleanup(self.end, child)
        self.expect_interrupted(process, signal.SIGINT)  # the program waits for the child
        wait_until(lambda: is_gone(child))
        self.expect_files()

    def stop_the_reading_child(self, process):
        """Its number; None if it was over. Once it reads it has let go of our pipes, and ends with its parent; not before."""
        while process.poll() is None:
            try:
                child = int(children(process)[0])
                if os.readlink(f"/proc/{child}/fd/2") == os.devnull:
                    os.kill(child, signal.SIGSTOP)
                    wait_until(lambda: state(child) in "TZX")
                    return child if state(child) == "T" else None
            except (IndexError, OSError):
                pass
            time.sleep(0.001)
        return None

    def end(self, child):
        if not is_gone(child):
            os.kill(child, signal.SIGKILL)

    def reads_step(self):
        return subprocess.run([PROGRAM, "certify", str(BLOCK), "--quiet"], capture_output=True, timeout=PATIENCE).returncode == 0


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1] + sys.argv[3:])
