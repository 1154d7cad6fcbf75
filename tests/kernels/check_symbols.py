#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Does an archive hold shared code that was compiled for one instruction set? Exits with 1 if so.

    check_symbols.py ARCHIVE MEMBER_PART...

Weak symbols (inline functions, template instances) are merged by the linker: the copy of an object file with special flags
might serve the whole program, on processors without the instructions. Members whose name contains a MEMBER_PART may define
none, unless it stands in a namespace of its set. An archive without such a member is an error too: then nothing was checked.
"""
import re
import subprocess
import sys

# Highway's namespaces: N_AVX3, N_SSE4, … No other file's symbol has the same name.
OF_ONE_SET = re.compile(r"\bN_[A-Z0-9]+::")


def main():
    if len(sys.argv) < 3:
        sys.exit(__doc__)
    archive, parts = sys.argv[1], sys.argv[2:]
    listing = subprocess.run(["nm", "--demangle", archive], check=True, capture_output=True, text=True).stdout
    member, checked, found = "", set(), []
    for line in listing.splitlines():
        if line.endswith(":"):
            member = line[:-1]
            checked.update(part for part in parts if part in member)
        elif any(part in member for part in parts):
            kind, _, name = line[17:].partition(" ")
            # Defined ones have an address. DW.ref symbols are addresses for the unwinder, no code.
            shared = kind and kind in "WVu" and not line.startswith(" ") and not name.startswith("DW.ref.")
            if shared and not OF_ONE_SET.search(name):
                found.append(f"{member}: {name}")
    for symbol in found:
        print(symbol)
    for part in parts:
        if part not in checked:
            found.append(part)
            print(f"no member {part}")
    sys.exit(1 if found else 0)


if __name__ == "__main__":
    main()
