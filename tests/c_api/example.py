# SPDX-License-Identifier: Apache-2.0
"""Runs an example: example.py STATUS REGEX PROGRAM ARGUMENTS… Its exit status and what it prints have to be these."""
import re
import subprocess
import sys

status, pattern, *command = sys.argv[1:]
run = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
print(run.stdout, end="")
if run.returncode != int(status):
    sys.exit(f"exit status {run.returncode} and not {status}")
if not re.search(pattern, run.stdout, re.DOTALL):
    sys.exit(f"nothing printed is like {pattern}")
