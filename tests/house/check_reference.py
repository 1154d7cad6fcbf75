# SPDX-License-Identifier: Apache-2.0
"""check_reference.py DOXYGEN DOXYFILE ROOT WORK: makes the API reference of ROOT in WORK and reads it.

Fails when Doxygen warns; when a header has no page; when the description of a header or of anything that it declares does not
stand in the HTML word by word; and when a false comment (an unknown \\param, a \\ref to nothing) goes unnoticed.
"""
import html
import pathlib
import re
import shutil
import subprocess
import sys

MUST_STAND = [  # page, text
    ("group__patch__evaluate__batch.html",
     "(7) evaluate_correctly_rounded: the double nearest to the exact coordinate, the even one of two;"),
    ("group__patch__evaluate__batch.html", "S(u,v) = Σ w_ij P_ij N_{i,p}(u) N_{j,q}(v) / Σ w_ij N_{i,p}(u) N_{j,q}(v)"),
    ("group__join__certify.html", "(2) lower ≤ sup ≤ upper, lower attained at at;"),
    ("classpatchproof_1_1BatchSurface.html", "bound[i] ≥ |computed − exact| in each coordinate of point i"),
    ("classpatchproof_1_1Interval.html", "The negative part of the operand is cut off. REQUIRES sup ≥ 0."),
    ("group__c__api.html", "It returns a status. On any but PATCHPROOF_OK the context that was given says what was wrong"),
    ("group__c__api.html", "patchproof_status patchproof_certify ( patchproof_context * context"),
    ("index.html", "proves how the patches of a free-form model join"),
]
MUST_NOT_BE = ["namespacepatchproof_1_1detail.html"]
FALSE_COMMENTS = ["/// \\param nothing of that name", "/// \\ref nowhere_at_all", "/** \\unknown_command */"]


def plain(text):
    """Without blanks and the marks that are no words: ` around code, the * or - before an item of a list."""
    return re.sub(r"[`\s\xa0]+", "", re.sub(r"(?m)^ +[*-] +", "", text))


def words_of(page):
    text = re.sub(r"(?s)<script.*?</script>", "", page.read_text(encoding="utf-8"))
    return plain(html.unescape(re.sub(r"<[^>]*>", "", text)))


def run_doxygen(doxygen, doxyfile, folder, more=""):
    """Warnings and the exit status; the pages are in folder/html."""
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    settings = f'@INCLUDE = "{doxyfile}"\nOUTPUT_DIRECTORY = "{folder}"\n{more}'
    run = subprocess.run([doxygen, "-"], input=settings, capture_output=True, text=True, cwd=folder)
    return run.returncode, (run.stdout + run.stderr).strip()


def top_of(header):
    """The first comment, read without the filter."""
    text = header.read_text(encoding="utf-8").split("#pragma once")[0]
    lines = [re.sub(r"^(// ?|/\*\*| \*/| \* ?)", "", line) for line in text.split("\n")]
    return "\n".join(line for line in lines if "SPDX-License-Identifier" not in line and line != "\\file")


def free_comments(header):
    """The comments at the left margin that stand before something, read without the filter."""
    text = re.split(r"(?m)^// -{20,}$", header.read_text(encoding="utf-8").split("#pragma once")[1])[0]
    text = re.sub(r"(?m)^namespace detail \{\n(?:(?:class|struct) .*\n)+\}$", "", text)
    text = re.sub(r"(?ms)^namespace detail \{.*?^\}  // namespace detail$", "", text)
    for block in re.findall(r"(?m)((?:^//.*\n)+)(?!\n|namespace|#(?!\s*define))", text):
        if "clang-format" not in block and not block.startswith("// ----"):
            yield "\n".join(line[3:] for line in block.split("\n"))


def check_pages(root, folder):
    from header_filter import Filter
    pages = {page.name: words_of(page) for page in folder.glob("*.html")}
    failures = [f"{name} must not be there" for name in MUST_NOT_BE if name in pages]
    failures += [f"{page}: no '{text}'" for page, text in MUST_STAND if plain(text) not in pages.get(page, "")]
    count = 0
    for header in sorted((root / "include" / "patchproof").rglob("*.h")):
        filtered = Filter(header)
        filtered.filtered()
        page = "group__" + filtered.page.replace("_", "__") + ".html"
        if page not in pages:
            failures.append(f"{filtered.name}: no page {page}")
            continue
        if plain(top_of(header)) not in pages[page]:
            failures.append(f"{page}: the description differs from the comment of the header")
        for text in [*free_comments(header), *map("\n".join, filtered.described)]:
            count += 1
            if plain(text) not in pages[page] and not any(plain(text) in other for other in pages.values()):
                failures.append(f"{filtered.name}: nowhere in the reference: {text}")
    print(f"{len(pages)} pages, {count} comments looked for")
    return failures + (["fewer than 500 comments found"] if count < 500 else [])


def check_warnings(doxygen, doxyfile, work):
    failures = []
    for i, comment in enumerate([*FALSE_COMMENTS, "/// True."]):
        source = work / "false" / "include" / "patchproof"
        source.mkdir(parents=True, exist_ok=True)
        (source / "false.h").write_text(f"// A header.\n#pragma once\n\n{comment}\nint f(int x);\n", encoding="utf-8")
        status, output = run_doxygen(doxygen, doxyfile, work / "false_html",
                                     f'INPUT = "{source}"\nUSE_MDFILE_AS_MAINPAGE =\nGENERATE_HTML = NO\nGENERATE_XML = YES\n')
        own = [line for line in output.split("\n") if "false.h:4:" in line or "false.h:5:" in line]
        if bool(own) != (i < len(FALSE_COMMENTS)) or (i < len(FALSE_COMMENTS) and status == 0):
            failures.append(f"{comment}: Doxygen exits with {status} and says {output!r}")
    return failures


def main():
    if len(sys.argv) != 5:
        sys.exit(__doc__)
    doxygen, doxyfile, root, work = sys.argv[1], *map(pathlib.Path, sys.argv[2:])
    sys.path.insert(0, str(root / "docs" / "doxygen"))
    status, output = run_doxygen(doxygen, doxyfile, work / "reference")
    failures = [f"Doxygen exits with {status}:\n{output}"] if status or output else []
    failures += check_pages(root, work / "reference" / "html") + check_warnings(doxygen, doxyfile, work)
    print("\n".join(failures) if failures else "the reference says what the headers say")
    sys.exit(1 if failures else 0)


if __name__ == "__main__":
    main()
