#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""header_filter.py HEADER: prints a header of include/patchproof with its plain comments turned into Doxygen's.

Doxygen's INPUT_FILTER. The headers stay as they are: read by people, in an editor. What becomes of a comment:
    at the top of the file              the description of the header's page, a group in the group of its room
    before a declaration, without gap   its description (comment_markup.py), of all variables if it declares several
    behind a declaration, same line     likewise
    // ---- title ----                  a heading on the page (/* ---- title ---- */ likewise)
    /// \\param and other commands       stays as it is: Doxygen's own markup
    in bodies of functions, private sections, namespace detail, or beside nothing: stays, and Doxygen does not see it
From a line of dashes to the end of the file stands the implementation of templates; it is left out. Classes without a
comment of their own point to the header's page. Lines stay where they are, so that warnings name the right ones.
"""
import functools
import pathlib
import re
import sys

from comment_markup import markup
from header_scan import Header

DASHES = re.compile(r"^// -{20,}$", re.M)
HEADING = re.compile(r"(?://|/\*) -{4} (.*?) -{4,}(?: \*/)?$")
COMMAND = re.compile(r"(?:///|//!|/\*\*|/\*!).*?(?<![\w\\])[\\@](?!file\b)[a-z]{2,}", re.S)
DECLARATION = re.compile(r"\n[ \t]*(?![ \t\n}#]|namespace)|\n#[ \t]*define|[ \t]*(?![ \t\n/])")  # right behind a comment
TOP = re.compile(r"(?:\s*(?://[^\n]*\n|/\*.*?\*/))*\s*?#pragma once\n\n?", re.S)
CLOSE = "/** @} */"


def plain_lines(comment):
    """The lines of one comment without its signs."""
    if comment.startswith("//"):
        return [re.sub(r"^//[/!]?<? ?", "", comment).rstrip()]
    first, *rest = re.sub(r"^/\*[*!]?<?|\*/$", "", comment).split("\n")
    margin = 2 if first.strip() else 1  # text below the first line stands below its first letter
    lines = [first.strip()] + [re.sub(rf"^\s*\*? {{0,{margin}}}", "", line).rstrip() for line in rest]
    lines = [line for line in lines if line != "\\file"]
    while lines and not lines[0]:
        lines = lines[1:]
    return lines


def in_comment(body, line_breaks, mark=""):
    """Doxygen's comment of that many line breaks."""
    if "*/" not in body:
        return f"/**{mark} {body}" + "\n" * (line_breaks - body.count("\n")) + " */"
    if "\n" in body:
        raise ValueError(f"a laid-out comment that holds the end of a comment: {body}")
    return f"//!{mark} {body}" + "\n" * line_breaks


class Filter:
    def __init__(self, path):
        path = pathlib.Path(path).resolve()
        self.root = next((p for p in path.parents if p.name == "patchproof" and p.parent.name == "include"), path.parent)
        self.name = path.relative_to(self.root).as_posix()
        self.page, self.room = self.page_of(self.name)
        whole = path.read_text(encoding="utf-8")
        dashes = DASHES.search(whole)
        self.text = whole[:dashes.start()] if dashes else whole
        self.cut = "\n" * (whole.count("\n") - self.text.count("\n"))
        self.header = Header(self.text)
        self.edits = []      # (begin, end, replacement)
        self.described = []  # the lines of each comment that describes something
        self.brief = ""

    @staticmethod
    def page_of(name):
        """The group of a header, and the group of its room."""
        if name == "c_api.h":
            return "c_api", None
        room = name.split("/")[0] if "/" in name else "base"
        return f"{room}_{pathlib.PurePath(name).stem}", room

    @functools.cache
    def link(self, name):
        """The page of a header that a comment names, seen from this one; None where there is none, or it is this one."""
        rooms = [pathlib.PurePath(self.name).parent, *sorted(p.relative_to(self.root) for p in self.root.iterdir() if p.is_dir())]
        for candidate in (name, *((room / name).as_posix() for room in rooms)):
            if (self.root / candidate).is_file():
                return self.page_of(candidate)[0] if candidate != self.name else None
        return None

    def replace(self, begin, end, replacement):
        self.edits.append((begin, end, replacement))

    def insert(self, place, text):
        self.edits.append((place, place, text))

    def filtered(self):
        top = TOP.match(self.text)
        if not top:
            raise ValueError(f"{self.name}: #pragma once does not follow the first comments")
        self.describe_file(top)
        documented = set()  # where declarations with a description begin
        headed = []         # scopes with headings
        for block in self.header.blocks():
            if block[0].begin < top.end():
                continue
            heading = HEADING.match(self.text[block[0].begin:block[0].end])
            if heading and block[0].role == "before" and re.match(r"\n\n(?!namespace)", self.text[block[0].end:][:12]):
                self.begin_heading(block[0], heading[1], headed)
            else:
                documented.add(self.describe(block))
        for place in self.header.classes:
            if place not in documented:
                self.insert(place, f"/** \\details See \\ref {self.page}. */ ")
        end = self.end_headings(headed) + self.group_contents()
        out = self.text
        for begin, stop, replacement in sorted(self.edits, reverse=True):
            out = out[:begin] + replacement + out[stop:]
        return out + self.cut + f"{end}\n/** \\file patchproof/{self.name}\n{self.brief}\n\\details See \\ref {self.page}. */\n"

    def describe_file(self, top):
        lines = [line for c in self.header.comments if c.end <= top.end() for line in plain_lines(self.text[c.begin:c.end])]
        body = markup([line for line in lines if "SPDX-License-Identifier" not in line], self.link, of_file=True)
        self.brief = body.split(" \\details ")[0]
        body = f"\\defgroup {self.page} {self.name}\n{body}\n" + (f"\\ingroup {self.room}\n" if self.room else "")
        body += "@{" * (not self.header.namespaces)
        self.replace(0, top.end(), in_comment(body, top.group().count("\n") - 1) + "\n")

    def begin_heading(self, comment, title, headed):
        is_first = comment.scope not in headed
        self.replace(comment.begin, comment.end + 2, f"{'' if is_first else CLOSE} //! \\name {title}\n//! @{{\n")
        if is_first:
            headed.append(comment.scope)

    def end_headings(self, headed):
        for scope in headed:
            if scope.end >= 0:
                self.insert(scope.end, CLOSE)
        return (CLOSE + "\n") * sum(scope.end < 0 for scope in headed)

    def group_contents(self):
        """Puts what namespaces hold, not themselves, on the page; macros behind them; without namespaces, everything."""
        opening = f" /** \\addtogroup {self.page}\n@{{ */ "
        for scope in self.header.namespaces:
            self.replace(scope.inside, scope.inside + 1, opening)
            if scope.end >= 0:
                self.insert(scope.end, CLOSE)
        if self.cut:
            return f"{CLOSE} }}" * (len(self.header.scopes) - 1)
        last = max((scope.end for scope in self.header.namespaces), default=-1)
        if last >= 0 and re.search(r"^#[ \t]*define", self.text[last:], re.M):
            self.replace(last + 1, self.text.index("\n", last) + 1, opening)
            return CLOSE + "\n"
        return "" if self.header.namespaces else CLOSE + "\n"

    def describe(self, block):
        """Turns a block of comments into a description. Where the declaration begins that stands behind it; -1: none does."""
        first, last = block[0], block[-1]
        lines = [line for c in block for line in plain_lines(self.text[c.begin:c.end])]
        is_heading = first.scope.kind == "enum" and lines[-1:] and lines[-1].endswith(":")  # of several enumerators
        is_alone = first.role == "before" and not DECLARATION.match(self.text, last.end)
        if not first.role or is_heading or is_alone or "clang-format" in " ".join(lines) or not any(lines):
            return -1
        declaration = first.declaration
        if first.role == "before":
            declaration = re.compile(r"\s*").match(self.text, last.end).end()
        if any(COMMAND.match(self.text[c.begin:c.end]) for c in block):
            return -1 if first.role == "behind" else declaration
        self.described.append(lines)
        body, line_breaks = markup(lines, self.link), self.text.count("\n", first.begin, last.end)
        variables = self.header.variables.get(declaration, [declaration])
        if first.role == "behind":
            self.replace(first.begin, last.end, in_comment(body, line_breaks, "<"))
            return -1
        if first.role == "before":
            self.replace(first.begin, last.end, in_comment(body, line_breaks))
            variables = variables[1:]
        else:
            self.replace(first.begin, last.end, "\n" * line_breaks)
        for place in variables:
            self.insert(place, f" {in_comment(body, 0)} ")
        return declaration


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    sys.stdout.write(Filter(sys.argv[1]).filtered())
