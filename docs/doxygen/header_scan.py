# SPDX-License-Identifier: Apache-2.0
"""Finds the comments of a C or C++ header and what each of them stands before or behind: no parser, but it knows the scopes."""
import re
from dataclasses import dataclass, field

TOKEN = re.compile(r"""
    (?P<directive>^[ \t]*\#(?:[^\\\n/]|\\.|\\\n|/(?![/*]))*) | (?P<newline>\n) | (?P<space>[ \t]+)
  | (?P<comment>//[^\n]*|/\*.*?\*/)
  | (?P<text>R"(?P<tag>[^(\s"]*)\(.*?\)(?P=tag)"|"(?:\\.|[^"\\\n])*"|'(?:\\.|[^'\\\n])+')
  | (?P<word>\w(?:\w|'\w)*) | (?P<sign>.)""", re.S | re.M | re.X)
ANGLES = r"<(?:[^<>]|<(?:[^<>]|<[^<>]*>)*>)*>"
PARENTHESES = r"\((?:[^()]|\((?:[^()]|\([^()]*\))*\))*\)"
ARGUMENTS = re.compile(rf"\b(?:template|alignas|requires|__attribute__) ?(?:{ANGLES}|{PARENTHESES})")
CLASS = re.compile(r"(?:.*\s)?(class|struct|union)\b")
LABELS = (["public"], ["protected"], ["private"])


@dataclass(eq=False)
class Scope:
    kind: str             # namespace, detail, class, enum, body
    start: int = 0        # where its declaration begins
    inside: int = 0       # behind its {
    end: int = -1         # where its } stands; -1: none, or that of extern "C", which is no scope for Doxygen
    access: str = "public"
    # The statement that is being read:
    words: list = field(default_factory=list)
    begin: int = 0
    commas: list = field(default_factory=list)  # behind those between the variables that it declares
    parentheses: int = 0
    angles: int = 0
    # The one before it:
    ended: str = ""       # by which sign
    last: int = -1        # where it began, if it declared a class, an enum or several variables

    def is_described(self):
        return self.kind in ("namespace", "class", "enum") and self.access != "private"


@dataclass
class Comment:
    begin: int
    end: int
    column: int
    role: str             # before, behind (on one line), opening (on the line of `declaration`), or empty: describes nothing
    scope: Scope
    declaration: int      # where the class, the enum or the several variables begin


def kind_of(words):
    """What the braces behind these words hold, and who may see it."""
    text = ARGUMENTS.sub("", " ".join(words))
    if "namespace" in words:
        return ("detail" if words[-1] == "detail" else "namespace"), "public"
    if words[:2] == ["extern", '"C"']:
        return "namespace", "public"
    key = CLASS.match(text)
    if "(" in text or "=" in text or not ("enum" in words or key):
        return "body", "public"
    return ("enum", "public") if "enum" in words else ("class", "private" if key[1] == "class" else "public")


class Header:
    """comments; classes: where those of namespaces begin; namespaces: their scopes; variables: where a declaration of several
    begins, and where each of them does; scopes: what is open at the end."""

    def __init__(self, text):
        self.text = text
        self.comments, self.classes, self.namespaces, self.variables = [], [], [], {}
        self.scopes = [Scope("namespace")]
        self.line_begin, self.line_has_code = 0, False
        for match in TOKEN.finditer(text):
            kind = match.lastgroup
            if kind == "newline":
                self.line_begin, self.line_has_code = match.end(), False
            elif kind == "comment":
                self.add_comment(match)
            elif kind != "space":
                self.line_has_code = True
                if kind == "directive":
                    self.scopes[-1].ended = "#"
                else:
                    self.add_code(match)

    def add_comment(self, match):
        scope = self.scopes[-1]
        role, declaration = "", scope.start
        if self.line_has_code and scope.ended == "{" and not scope.words:
            role = "opening" if scope.kind in ("class", "enum") and self.scopes[-2].is_described() else ""
        elif scope.is_described() and scope.parentheses == 0:
            if not self.line_has_code:
                role = "" if scope.words else "before"
            elif scope.words:
                role = "behind" if scope.kind == "enum" else ""
            elif scope.ended == ";" and scope.last >= 0:
                role, declaration = "opening", scope.last
            elif scope.ended in (";", ",", "}"):
                role = "behind"
        column = match.start() - self.line_begin
        self.comments.append(Comment(match.start(), match.end(), column, role, scope, declaration))

    def add_code(self, match):
        scope, sign = self.scopes[-1], match.group()
        if not scope.words:
            scope.begin, scope.commas, scope.angles = match.start(), [], 0
        is_outside = scope.parentheses == 0
        if sign == "{":
            return self.open_scope(match)
        if sign == "}" and len(self.scopes) > 1:
            return self.close_scope(match)
        if is_outside and (sign == ";" or (sign == "," and scope.kind == "enum")):
            if scope.commas and "(" not in scope.words:
                self.variables[scope.begin] = [scope.begin, *scope.commas]
            if scope.begin in self.variables:
                scope.last = scope.begin
            elif scope.last != scope.begin:
                scope.last = -1
            scope.words, scope.ended = [], sign
            return None
        if sign == ":" and scope.words[-1:] in LABELS:
            scope.access, scope.words, scope.ended = scope.words[-1], [], ":"
            return None
        if sign == "," and is_outside and scope.angles == 0:
            scope.commas.append(match.end())
        scope.parentheses += {"(": 1, ")": -1}.get(sign, 0)
        scope.angles += {"<": 1, ">": -1}.get(sign, 0)
        scope.words.append(sign)
        return None

    def open_scope(self, match):
        outer = self.scopes[-1]
        kind, access = kind_of(outer.words) if outer.is_described() else ("body", "public")
        if outer.kind == "detail":
            kind = "detail"
        if kind == "class" and outer.kind == "namespace":
            self.classes.append(outer.begin)
        self.scopes.append(Scope(kind, outer.begin, match.end(), access=access, ended="{"))
        if kind == "namespace" and "extern" not in outer.words:
            self.namespaces.append(self.scopes[-1])

    def close_scope(self, match):
        closed, scope = self.scopes.pop(), self.scopes[-1]
        closed.end = -1 if "extern" in scope.words else match.start()
        scope.ended = "" if closed.kind in ("namespace", "detail") else "}"
        if closed.kind in ("class", "enum"):
            scope.last = scope.begin
        elif closed.kind != "body" or "(" in scope.words:
            scope.words = []  # else the braces hold the value of a variable

    def blocks(self):
        """Comments that are one: whole lines one below the other, or what goes on below a comment behind something."""
        out = []
        for comment in self.comments:
            if out and self.continues(out[-1], comment):
                out[-1].append(comment)
            else:
                out.append([comment])
        return out

    def continues(self, block, comment):
        first, last = block[0], block[-1]
        if (comment.column != first.column or self.text[comment.begin:comment.begin + 2] != "//"
                or self.text[first.begin:first.begin + 2] != "//"
                or not re.fullmatch(r"\n[ \t]*", self.text[last.end:comment.begin])):
            return False
        if first.role in ("", "before"):
            return comment.role == first.role
        below = re.compile(r"\n([ \t]*)[^\s/]").search(self.text, comment.end)
        return below is None or len(below[1]) != comment.column  # else it stands before what follows
