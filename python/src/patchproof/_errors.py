# SPDX-License-Identifier: Apache-2.0
"""What patchproof raises besides Python's own TypeError, IndexError, MemoryError and KeyboardInterrupt."""
from __future__ import annotations


class Error(ValueError):
    """Numbers, a file or a request that cannot be used.

    code     what is wrong, in a word: "wrong_count", "outside_domain", "cannot_open" … (include/patchproof/error.h
             lists all of them with an example each), "bad_argument"
    where    the place: "part.json at /patches/3/knots/0", "item 17", "" where there is none
    message  one sentence
    values   the offending values, as they were read
    """

    code: str
    where: str
    message: str
    values: str

    def __init__(self, code: str, where: str, message: str, values: str) -> None:
        super().__init__(code, where, message, values)
        self.code, self.where, self.message, self.values = code, where, message, values

    def __str__(self) -> str:
        place = f"{self.where}: " if self.where else ""
        values = f" [{self.values}]" if self.values else ""
        return f"{place}{self.message}{values} ({self.code})"


class InternalError(RuntimeError):
    """A mistake of patchproof itself: please report it."""
