# SPDX-License-Identifier: Apache-2.0
"""Writes riis_c.f90 and riisf.h in fortran/generated, and tests/fortran/layouts.inc, from riis.h and from bindings.table.

    python3 generate.py                writes the files
    python3 generate.py --check        writes nothing; fails and shows the difference if a file is out of date
    python3 generate.py --root FOLDER  does one or the other in another copy of the sources
"""

import argparse
import difflib
import os
import sys

sys.dont_write_bytecode = True
from fortran import Bindings
from header import Header, Problem
from table import Table

HEADER = "include/riis/riis.h"
TABLE = "fortran/bindings/bindings.table"
TEMPLATES = "fortran/bindings/riis_c.f90.in", "fortran/bindings/riisf.h.in"
# The longest allowed line, by the language or by the project.
WIDTHS = {"fortran/generated/riis_c.f90": 130, "fortran/generated/riisf.h": 72, "tests/fortran/layouts.inc": 130}


def fill(template, shown, parts):
    """Returns the template with its lines "@name@" replaced."""
    lines, left = [], set(parts)
    for number, line in enumerate(template.splitlines(), 1):
        if line.startswith("@"):
            name = line.strip("@")
            if name not in left:
                raise Problem(f"{shown}:{number}: {line} is not known, or is there twice")
            left.remove(name)
            lines += parts[name]
        else:
            lines.append(line)
    if left:
        raise Problem(*(f"{shown}: there is no line @{name}@" for name in sorted(left)))
    return lines


def generate(root):
    """Returns the contents of the generated files, by path."""
    header = Header(os.path.join(root, HEADER), HEADER)
    bindings = Bindings(header, Table(os.path.join(root, TABLE), TABLE))
    parts = [{"constants": bindings.constants(), "structs": bindings.structs(), "callbacks": bindings.callbacks(),
              "functions": bindings.functions()},
             {"constants": bindings.fixed_form_constants()}]
    layouts = bindings.layouts()
    bindings.finish()
    files = {}
    for path, shown, part in zip(WIDTHS, TEMPLATES, parts):
        with open(os.path.join(root, shown), encoding="utf-8") as file:
            files[path] = fill(file.read(), shown, part)
    files["tests/fortran/layouts.inc"] = layouts
    problems = [f"{path}:{number}: this line would have {len(line)} columns, {WIDTHS[path]} are allowed: {line.strip()}"
                for path, lines in files.items() for number, line in enumerate(lines, 1) if len(line) > WIDTHS[path]]
    if problems:
        raise Problem(*problems)
    return {path: "\n".join(lines) + "\n" for path, lines in files.items()}


def read(path):
    if not os.path.exists(path):
        return ""
    with open(path, encoding="utf-8") as file:
        return file.read()


def main(words):
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--check", action="store_true", help="write nothing, compare")
    parser.add_argument("--root", default=os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", ".."),
                        help="the folder of the sources; this script's by default")
    arguments = parser.parse_args(words)
    try:
        files = generate(arguments.root)
    except Problem as problem:
        print(problem, file=sys.stderr)
        return 1
    differ = 0
    for path, text in files.items():
        found = read(os.path.join(arguments.root, path))
        if found == text:
            continue
        differ += 1
        if arguments.check:
            lines = found.splitlines(True), text.splitlines(True)
            sys.stdout.writelines(difflib.unified_diff(*lines, path, "generated anew", n=1))
            print(f"{path} is not what {HEADER} and {TABLE} give; ./run bindings writes it anew", file=sys.stderr)
        else:
            with open(os.path.join(arguments.root, path), "w", encoding="utf-8") as file:
                file.write(text)
            print(f"written: {path}")
    print(f"{len(files) - differ} of {len(files)} files were as they should be")
    return 1 if differ and arguments.check else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
