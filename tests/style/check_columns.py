#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""check_columns.py FILE...: no line may be too long. Files of other kinds are ignored.

Code has at most 130 columns, fixed-form Fortran 72, and documents 100. In a document, blocks of code may have 130. The following
parts may be longer: tables, links alone on a line, HTML comments, and blocks of output (```text, or indented).
"""

import re
import sys

CODE, DOCUMENT, FIXED_FORM = 130, 100, 72
_CODE = re.compile(r"\.(c|C|h|H|cpp|hpp|py|sh|awk|cmake|f90|fypp|inc|geo)(\.in)?$|(^|/)CMakeLists\.txt$")
_FIXED_FORM = re.compile(r"\.f$|(^|/)riisf\.h(\.in)?$")
_LINK = re.compile(r"\s*([-*]|\d+\.)? *\(?(!?\[[^]]*\]\([^)]*\)|\[[^]]*\]: \S+|<?https?://\S+)[.,:;)]*$")


def limit_of(path, text):
    """Returns the limit of a file, or None if the file has no limit."""
    if path.endswith(".template.md"):  # its lines are wrapped again after numbers have replaced the names
        return CODE
    if path.endswith(".md"):
        return DOCUMENT
    if _FIXED_FORM.search(path):
        return FIXED_FORM
    is_script = re.match(r"#!.*\b(ba|da)?sh\b", text)
    return CODE if _CODE.search(path) or is_script else None


def limits_of_document(lines, most):
    """Yields the limit of each line, or None for a line without a limit. `most` is the limit of lines of text."""
    fence, is_comment, is_output, previous = None, False, False, ""
    for line in lines:
        mark = re.match(r"\s*```+\s*(\w*)", line)
        is_comment = is_comment or line.lstrip().startswith("<!--")
        is_output = line.startswith("    ") and (is_output or not previous.strip())
        if is_comment:
            yield None
            is_comment = "-->" not in line
        elif mark:
            fence = None if fence is not None else mark[1]
            yield most
        elif fence is not None:
            yield None if fence == "text" else CODE
        else:
            yield None if is_output or line.lstrip().startswith("|") or _LINK.match(line) else most
        previous = line


def too_long(path):
    """Returns the number, length and limit of each line that is too long, or None for a file without a limit."""
    try:
        with open(path, encoding="utf-8") as file:
            text = file.read()
    except UnicodeDecodeError:
        return None
    limit = limit_of(path, text)
    if limit is None:
        return None
    if path.endswith(".md"):
        text = re.sub(r"<!--(=[\w.]+|/)-->", "", text)  # readers do not see the marks around numbers that a program writes
    lines = text.split("\n")
    limits = limits_of_document(lines, limit) if path.endswith(".md") else [limit] * len(lines)
    return [(i, len(line), most) for i, (line, most) in enumerate(zip(lines, limits), 1) if most and len(line) > most]


def main(paths):
    failed = n = 0
    for path in paths:
        found = too_long(path)
        n += found is not None
        for line, length, limit in found or []:
            print(f"{path}:{line}: {length} columns; at most {limit}", file=sys.stderr)
            failed = 1
    if not n:
        sys.exit("no file has a limit of columns")
    return failed


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
