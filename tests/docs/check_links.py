# SPDX-License-Identifier: Apache-2.0
"""check_links.py FOLDER: documents and sources below the folder may refer only to things that exist.

Links in Markdown documents lead to existing files and headings. Sources and documents name pages in the form docs/*.md, or
docs/*.md, "Heading". A section's number is refused, because such numbers change. If documents name files of the repository, the
files must exist. The files that Debian's tests name must also exist. A formula begins and ends on one line. A page of docs/theory
or docs/design has at most 4000 words.
"""
import functools
import pathlib
import re
import sys

LINK = re.compile(r"!?\[[^\]]*\]\(([^)\s]+)\)")
REFERENCE = re.compile(r'\b(docs/[\w/.-]*?\.md)(?:, "([^"]+)"|,? (section \d+))?')
FORMULA = re.compile(r"(?<![\w$\\])\$(?=[^\s$])[^$]*?(?<=[^\s$])\$(?![\w$])")
FOLDERS = ("abi", "bench", "cmake", "debian", "docs", "examples", "fortran", "include", "packaging", "python", "src", "tests")
MOST_WORDS = 4000


def text_of(path):
    """Returns the text without code, which has no links."""
    text = re.sub(r"^( *)```.*?^\1```", "", path.read_text(encoding="utf-8"), flags=re.MULTILINE | re.DOTALL)
    return re.sub(r"`[^`\n]*`", "", text)


def slug(title):
    return re.sub(r"[^\w -]", "", title.lower()).replace(" ", "-")


@functools.lru_cache(maxsize=None)
def headings(path):
    text = re.sub(r"^( *)```.*?^\1```", "", path.read_text(encoding="utf-8"), flags=re.MULTILINE | re.DOTALL)
    titles = re.findall(r"^#+ +(.*)$", text, re.MULTILINE)
    return {slug(title) for title in titles}


def pages_of_books(folder):
    return [*folder.glob("docs/theory/*.md"), *folder.glob("docs/design/*.md")]


def documents_of(folder):
    return [path for pattern in ("*.md", "docs/*.md", "examples/*.md") for path in folder.glob(pattern)] + pages_of_books(folder)


def problems(folder):
    documents = documents_of(folder)
    if not documents:
        yield f"no documents in {folder}"
    for document in documents:
        for link in LINK.findall(text_of(document)):
            if re.match(r"[a-z]+:", link):
                continue
            file, _, place = link.partition("#")
            target = document.parent / file if file else document
            if not target.exists():
                yield f"{document.relative_to(folder)}: {link}: there is no such file"
            elif place and target.suffix == ".md" and place not in headings(target):
                yield f"{document.relative_to(folder)}: {link}: there is no such heading"


def wrong_references(folder):
    """Yields the missing pages and headings that a source or a document names. CHANGELOG.md may name pages of the past, and the
    test of this script names invented pages."""
    files = [path for part in FOLDERS for path in (folder / part).rglob("*")] + list(folder.glob("*"))
    for path in files:
        if path.name in ("CHANGELOG.md", "test_check_pages.py") or not path.is_file():
            continue
        try:
            text = path.read_text(encoding="utf-8")
        except UnicodeDecodeError:
            continue  # a picture
        text = re.sub(r'\\n",\n *"', " ", text.replace('\\"', '"'))  # the lines of a notebook
        text = re.sub(r"\n[ \t]*(?://+|\*+|#+|![<>!]*)?[ \t]*", " ", text)  # a comment of several lines
        for page, heading, section in REFERENCE.findall(text):
            target = folder / page
            if not target.exists():
                yield f"{path.relative_to(folder)}: {page}: there is no such file"
            elif section:
                yield f"{path.relative_to(folder)}: {page}, {section}: name the heading, because numbers shift"
            elif heading and slug(heading) not in headings(target):
                yield f'{path.relative_to(folder)}: {page}, "{heading}": there is no such heading'


def broken_formulas(folder):
    """Yields the lines on which a formula has only one dollar sign. Code contains no formulas."""
    for document in documents_of(folder):
        text = re.sub(r"^( *)```.*?^\1```", lambda block: "\n" * block[0].count("\n"),
                      document.read_text(encoding="utf-8"), flags=re.MULTILINE | re.DOTALL)
        for number, line in enumerate(text.splitlines(), 1):
            if not line.startswith("    ") and "$" in FORMULA.sub("", re.sub(r"`[^`]*`", "", line)):
                yield f"{document.relative_to(folder)}:{number}: a formula must begin and end on one line, or stand in ```math"


def long_pages(folder):
    for page in pages_of_books(folder):
        n_words = len(page.read_text(encoding="utf-8").split())
        if n_words > MOST_WORDS:
            yield f"{page.relative_to(folder)}: {n_words} words; at most {MOST_WORDS}"


def missing_sources(folder):
    """Yields the missing files of this repository that documents name in code. A name may be a pattern, or have words in capitals
    that the reader replaces. A source that is named without its folder counts only in pages about the sources. CHANGELOG.md may
    name files of the past."""
    parts = ("include", "src", "fortran", "tests")
    sources = [path.relative_to(folder).as_posix() for part in parts for path in (folder / part).rglob("*")]
    about_sources = [folder / "CONTRIBUTING.md", folder / "docs/walks.md", *pages_of_books(folder)]
    for page in documents_of(folder):
        text = page.read_text(encoding="utf-8")
        short = re.findall(r"`([\w/]+\.(?:cpp|hpp|h))`", text) if page in about_sources else []
        if not short and page.name == "walks.md":
            yield "docs/walks.md names no file"
        paths = re.findall(rf"`((?:{'|'.join(FOLDERS)})/[\w./*-]*)`", text) if page.name != "CHANGELOG.md" else []
        for name in [*short, *paths]:
            pattern = re.sub(r"\b(?:[A-Z]+|X\.Y)\b", "*", name)
            if not any(folder.glob(pattern)) and not (name in short and any(path.endswith(f"/{name}") for path in sources)):
                yield f"{page.relative_to(folder)}: {name}: there is no such file"
    # Debian's tests run only in Debian's own tools, so a renamed file would be noticed late.
    named = re.compile(rf"(?<![\w/])(?:{'|'.join(FOLDERS)})/[\w./-]*\w(?![\w./-]*\$)")
    for script in (folder / "debian" / "tests").glob("*"):
        for name in named.findall(script.read_text(encoding="utf-8")):
            if not (folder / name).exists():
                yield f"debian/tests/{script.name}: {name}: there is no such file"


folder = pathlib.Path(sys.argv[1])
found = [*problems(folder), *wrong_references(folder), *broken_formulas(folder), *long_pages(folder), *missing_sources(folder)]
if found:
    sys.exit("\n".join(dict.fromkeys(found)))
