# SPDX-License-Identifier: Apache-2.0
"""check_links.py FOLDER: links in the Markdown documents below the folder must lead to existing files and headings. Source
files that docs/walks.md names must exist."""
import pathlib
import re
import sys

LINK = re.compile(r"!?\[[^\]]*\]\(([^)\s]+)\)")


def text_of(path):
    """Returns the text without code, which has no links."""
    text = re.sub(r"^( *)```.*?^\1```", "", path.read_text(encoding="utf-8"), flags=re.MULTILINE | re.DOTALL)
    return re.sub(r"`[^`\n]*`", "", text)


def headings(path):
    text = re.sub(r"^( *)```.*?^\1```", "", path.read_text(encoding="utf-8"), flags=re.MULTILINE | re.DOTALL)
    titles = re.findall(r"^#+ +(.*)$", text, re.MULTILINE)
    return {re.sub(r"[^\w -]", "", title.lower()).replace(" ", "-") for title in titles}


def problems(folder):
    documents = [*folder.glob("*.md"), *folder.glob("docs/*.md"), *folder.glob("examples/*.md")]
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


def missing_sources(folder):
    """Yields the source files that docs/walks.md names and that do not exist."""
    if not (folder / "docs/walks.md").exists():
        return
    sources = [path.relative_to(folder).as_posix() for part in ("include", "src") for path in (folder / part).rglob("*")]
    named = re.findall(r"`([\w/]+\.(?:cpp|hpp|h))`", (folder / "docs/walks.md").read_text(encoding="utf-8"))
    if not named:
        yield "docs/walks.md names no file"
    for name in named:
        if not (folder / name).exists() and not any(source.endswith(f"/{name}") for source in sources):
            yield f"docs/walks.md: {name}: there is no such file"


folder = pathlib.Path(sys.argv[1])
found = [*problems(folder), *missing_sources(folder)]
if found:
    sys.exit("\n".join(found))
