# SPDX-License-Identifier: Apache-2.0
# figures_page.py FILE.md...: writes to stdout a page with every figure of the pages, its text, and a link to the page that
# explains it. Doxygen reads the page.
import pathlib
import re
import sys

FIGURE = re.compile(r"!\[([^\]]+)\]\((?:docs/|\.\./)?([^)]+)\)")
print("# Figures {#figures}\n\nAll figures of the pages, each with the page that explains it.\n")
seen = set()
for path in map(pathlib.Path, sys.argv[1:]):
    text = path.read_text(encoding="utf-8")
    title = re.search(r"^# (.*)", text, re.MULTILINE)
    if not title:
        sys.exit(f"figures_page.py: {path} has no title")
    figures = [(words, name) for words, name in FIGURE.findall(text) if name not in seen]
    if not figures:
        continue
    print(f"## {title[1]}\n\n[The page]({path}).\n")
    for words, name in figures:
        seen.add(name)
        words = " ".join(words.split())
        print(f"![{words}]({name})\n\n{words}.\n")
if len(seen) < 10:
    sys.exit(f"figures_page.py: only {len(seen)} figures: the pages' pictures have another form than ![text](file)")
