# SPDX-License-Identifier: Apache-2.0
"""What the tests of the installed tree share: commands that must succeed, and ends with a sentence."""
import os
import subprocess
import sys

SKIPPED = 77


def fail(sentence):
    sys.exit(f"FAILED: {sentence}")


def skip(reason):
    print(f"skipped: {reason}")
    sys.exit(SKIPPED)


def require(condition, sentence):
    if not condition:
        fail(sentence)


def run(*words, expect=0, **options):
    """Output (both streams) of a command, which must end with `expect`."""
    words = [str(word) for word in words]
    done = subprocess.run(words, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, errors="replace",
                          check=False, **options)
    if done.returncode != expect:
        fail(f"{' '.join(words)} ended with {done.returncode} instead of {expect}:\n{done.stdout}")
    return done.stdout


def environment(**changes):
    """Without anything that leads to another patchproof."""
    kept = {name: value for name, value in os.environ.items()
            if name not in ("LD_LIBRARY_PATH", "PKG_CONFIG_PATH", "CMAKE_PREFIX_PATH", "CPATH", "LIBRARY_PATH")}
    return {**kept, "LC_ALL": "C", **changes}


def dynamic_section(file):
    """[(tag, value)] of an ELF file: ("NEEDED", "libc.so.6") and so on."""
    entries = []
    for line in run("readelf", "-dW", file, env=environment()).splitlines():
        words = line.split(None, 2)
        if len(words) == 3 and words[0].startswith("0x"):
            value = words[2][words[2].find("[") + 1:words[2].rfind("]")] if "[" in words[2] else words[2]
            entries.append((words[1].strip("()"), value))
    return entries


def needed(file):
    return [value for tag, value in dynamic_section(file) if tag == "NEEDED"]
