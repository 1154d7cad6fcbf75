# SPDX-License-Identifier: Apache-2.0
"""The text of a plain comment in Doxygen's markup, so that it appears as it was written.

A comment is made of
    paragraphs, whose words flow;
    laid-out blocks (indented formulas, tables), kept as they stand;
    lists, whose items begin with * or - and are indented;
    sections: a word of capitals at the beginning of a line, ENSURES for one, and what is indented behind it. Laws that are
    numbered (1), (2), … become a list; lines of a section that are indented further and have columns are laid out.

The result has line breaks only inside laid-out blocks, so it never takes more lines than the comment did.
"""
import re

KEYWORDS = r"REQUIRES|ENSURES|ERRORS|COST|SOURCE|NEIGHBOURS|TEST|SCALARS"
SECTION = re.compile(r"([A-Z]{4,})(?: {2,}|$)")
FILE_SECTION = re.compile(rf"([A-Z]{{4,}})(?: {{2,}}|$)|({KEYWORDS}) +")  # aligned behind NEIGHBOURS, one space may be left
BULLET = re.compile(r" +[*-] +")
COLUMNS = re.compile(r"\S {3,}\S|[^.;:,\s] {2}\S")
SENTENCE_END = re.compile(r"(?<=[^\s.]{2}\.|\s[a-z]\.) +(?=[^a-z\s])")
INLINE = re.compile(rf"`([^`]+)`|\b({KEYWORDS})\b|(?<![\w/.])((?:\w+/)*\w+\.h)\b")
SPECIAL = re.compile(r"[\\@#%$*`\[\]]|(?<![A-Za-z0-9])_|-{2,3}|[<>&\"]")
ENTITY = {"<": "&lt;", ">": "&gt;", "&": "&amp;", '"': "&quot;"}


def escape(text):
    return SPECIAL.sub(lambda m: ENTITY.get(m.group()) or "\\" + m.group(), text)


def flowing(text, link):
    """Words of a paragraph. link(name) is the page of the header of that name, or None."""
    def mark(match):
        code, keyword, header = match.groups()
        if code:
            return f"<code>{escape(code)}</code>"
        if keyword:
            return f"<b>{keyword}</b>"
        page = link(header)
        return f'\\ref {page} "{header}"' if page else escape(header)
    out, end = [], 0
    for match in INLINE.finditer(text):
        out += [escape(text[end:match.start()]), mark(match)]
        end = match.end()
    return " ".join(("".join(out) + escape(text[end:])).split())


def indent(line):
    return len(line) - len(line.lstrip())


def is_table(lines):
    return any(COLUMNS.search(line.strip()) for line in lines)


def runs(lines, is_deep):
    """(True, indented lines) and (False, other lines) in turn; blank lines stay with the indented ones around them."""
    out = []
    for line in lines:
        deep = is_deep(line) if line else bool(out) and out[-1][0]
        begins_list = BULLET.match(line) and not out[-1][1][-1] if out else False
        if out and out[-1][0] == deep and not begins_list:
            out[-1][1].append(line)
        else:
            out.append((deep, [line]))
    return [(deep, part) for deep, part in out if any(part)]


def blocks(lines, margin=0, tables_only=False):
    """("text", words), ("laid out", lines) and ("list", items) of lines without sections."""
    out = []
    for deep, part in runs(lines, lambda line: indent(line) > margin):
        if deep and BULLET.match(part[0]):
            items = []
            for line in part:
                if BULLET.match(line):
                    items.append(BULLET.sub("", line, count=1))
                else:
                    items[-1] += "\n" + line.strip()
            out.append(("list", items))
        elif deep and (not tables_only or is_table(part)):
            out.append(("laid out", part))
        else:
            for paragraph in re.split(r"\n{2,}", "\n".join(line.strip() for line in part)):
                if tables_only and out and out[-1][0] == "text":
                    out[-1] = ("text", out[-1][1] + "\n" + paragraph)
                elif paragraph.strip():
                    out.append(("text", paragraph))
    return out


def laws(parts):
    """The parts of a section, cut before (1), (2), …; the first list is what stands before (1)."""
    items, number = [[]], 1
    if not (parts and parts[0][0] == "text" and parts[0][1].startswith("(1) ")):
        return [parts]
    for kind, content in parts:
        while kind == "text":
            begin = re.search(rf"(?:^|\n| {{2}}|[;.] )(\({number}\) )", content)
            if not begin:
                break
            items[-1].append((kind, content[:begin.start(1)]))
            items.append([])
            content, number = content[begin.start(1):], number + 1
        items[-1].append((kind, content))
    return items


def render(parts, link, paragraph=("", "")):
    out = []
    for kind, content in parts:
        if kind == "text":
            out.append(paragraph[0] + flowing(content, link) + paragraph[1] if content.strip() else "")
        elif kind == "list":
            out.append("<ul>" + "".join(f"<li>{flowing(item, link)}</li>" for item in content) + "</ul>")
        else:
            while not content[-1]:
                content = content[:-1]
            margin = min(indent(line) for line in content if line)
            out.append("\\verbatim " + "\n".join(line[margin:] for line in content) + "\\endverbatim ")
    return "".join(out)


def section(keyword, first, lines, link):
    margin = min((indent(line) for line in lines if line), default=0)
    parts = blocks([" " * margin + first] * bool(first) + lines, margin, tables_only=True)
    before, *numbered = laws(parts)
    body = render(before, link)
    if numbered:
        body += '<ul class="laws">' + "".join(f"<li>{render(law, link)}</li>" for law in numbered) + "</ul>"
    return f"<dt>{keyword}</dt><dd>{body}</dd>"


def segments(lines, of_file):
    """(keyword, what follows it in its line, further lines): the sections, and with keyword None what is between them."""
    pattern = FILE_SECTION if of_file else SECTION
    out = []
    for line in lines:
        head = pattern.match(line)
        if head:
            out.append((head[head.lastindex], line[head.end():], []))
        elif out and (out[-1][0] is None or not line or indent(line) > 1):
            out[-1][2].append(line)
        else:
            out.append((None, "", [line]))
    return out


def markup(lines, link=lambda name: None, of_file=False):
    """\\brief the first sentence, \\details the rest. `of_file`: a word of KEYWORDS and one blank begin a section as well."""
    brief, details, in_sections = "", "", False
    for keyword, first, rest in segments(lines, of_file):
        if in_sections != bool(keyword):
            details += "<dl>" if keyword else "</dl>"
            in_sections = bool(keyword)
        if keyword:
            details += section(keyword, first, rest, link)
            continue
        parts = blocks(rest)
        if not brief and not details and parts and parts[0][0] == "text":
            sentence, *others = SENTENCE_END.split(" ".join(parts[0][1].split()), maxsplit=1)
            brief = "\\brief " + flowing(sentence, link)
            parts[0] = ("text", "".join(others))
        details += render(parts, link, ("<p>", "</p>"))
    details += "</dl>" * in_sections
    return " ".join(filter(None, [brief, details and "\\details " + details]))
