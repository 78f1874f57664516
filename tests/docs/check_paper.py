# SPDX-License-Identifier: Apache-2.0
"""check_paper.py ROOT: the documents that the paper names must contain its numbers, and its bibliography must contain its
citations.

A table of numbers has the columns document and command. A number in any other cell must occur in the document, in the form of the
cell. Without an argument the script tests itself on invented texts.
"""
import pathlib
import re
import sys


def tables(text):
    """Yields the rows of the tables. A row maps the names of the columns to the cells."""
    names = None
    for line in text.splitlines():
        cells = [cell.strip() for cell in line.strip().strip("|").split("|")] if line.startswith("|") else None
        if cells is None:
            names = None
        elif names is None:
            names = cells
        elif not set(cells[0]) <= {"-", ":"}:
            yield dict(zip(names, cells))


def faults(paper, bibliography, read):
    n_rows = 0
    for row in tables(paper):
        if "document" not in row:
            yield f"a table has no column document: {row}"
            continue
        n_rows += 1
        if not row.get("command"):
            yield f"the row of {row['quantity']} has no command"
        value = row.get("deviation") or row.get("value")
        # A value fills a cell, begins a cell, or stands before a word such as "the bar".
        if not re.search(rf"(?<![\d.,]){re.escape(value)}(?![\d.,]\d|\d)", read(row["document"])):
            yield f"{value} ({row['quantity']}) is not in {row['document']}"
    if n_rows < 10:
        yield f"only {n_rows} rows of numbers"
    cited = set(re.findall(r"@([a-z]+[0-9]{4})", paper))
    listed = set(re.findall(r"^@\w+\{(\w+),", bibliography, re.MULTILINE))
    if cited != listed:
        yield f"cited and not listed: {sorted(cited - listed)}; listed and not cited: {sorted(listed - cited)}"


def judged():
    row = "| drop {} | {} | a.md | `{}` |\n"
    table = "| quantity | value | document | command |\n|---|---|---|---|\n"
    table += "".join(row.format(i, "1.5 ms", "run") for i in range(10))
    texts = {"a.md": "| drop | 1.5 ms |", "b.md": "| drop | 11.5 ms, 1.51 ms |"}
    good = table + "[@a2020]"
    assert not list(faults(good, "@misc{a2020,\n", texts.get))
    for paper, bibliography, fault in (
            (good.replace("a.md", "b.md"), "@misc{a2020,\n", "1.5 ms (drop 0) is not in b.md"),
            (good.replace("`run`", ""), "@misc{a2020,\n", "the row of drop 0 has no command"),
            (good, "@misc{b2020,\n", "cited and not listed: ['a2020']; listed and not cited: ['b2020']"),
            (good.replace("document", "place"), "@misc{a2020,\n", "a table has no column document"),
            ("[@a2020]", "@misc{a2020,\n", "only 0 rows of numbers")):
        assert any(fault in found for found in faults(paper, bibliography, texts.get)), fault


judged()
if len(sys.argv) > 1:
    root = pathlib.Path(sys.argv[1])
    paper, bibliography = ((root / "paper" / name).read_text(encoding="utf-8") for name in ("paper.md", "paper.bib"))
    found = list(faults(paper, bibliography, lambda name: (root / name).read_text(encoding="utf-8")))
    if found:
        sys.exit("\n".join(found))
