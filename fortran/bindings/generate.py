# SPDX-License-Identifier: Apache-2.0
"""Writes riis_c.f90, riis.f90, riis_f77.f90, riisf.f90 and riisf.h in fortran/generated, from riis.h, bindings.table and
riisf.table.

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
from riisf import Writer
from table import Subroutines, Table

HEADER = "include/riis/riis.h"
TABLE = "fortran/bindings/bindings.table"
SUBROUTINES = "fortran/bindings/riisf.table"
# The generated files, with the longest line that the language or the project allows. Each has a template in fortran/bindings.
WIDTHS = {"fortran/generated/riis_c.f90": 130, "fortran/generated/riisf.h": 72, "fortran/generated/riis_f77.f90": 130,
          "fortran/generated/riisf.f90": 130, "fortran/generated/riis.f90": 130}


def template_of(path):
    return path.replace("generated", "bindings") + ".in"


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
    header, table = Header(os.path.join(root, HEADER), HEADER), Table(os.path.join(root, TABLE), TABLE)
    table.add_from(header)
    bindings = Bindings(header, table)
    parts = {"constants": bindings.constants(), "structs": bindings.structs(), "callbacks": bindings.callbacks(),
             "functions": bindings.functions()}
    fixed, names = {"constants": bindings.fixed_form_constants()}, {"constants": bindings.names_of_constants()}
    bindings.finish()
    subroutines, interfaces = Writer(header, table, Subroutines(os.path.join(root, SUBROUTINES), SUBROUTINES)).write()
    files, problems = {}, []
    filled = parts, fixed, {"subroutines": subroutines}, {"interfaces": interfaces}, names
    for (path, width), part in zip(WIDTHS.items(), filled):
        template = template_of(path)
        with open(os.path.join(root, template), encoding="utf-8") as file:
            files[path] = fill(file.read(), template, part)
        problems += [f"{path}:{number}: this line would have {len(line)} columns, {width} are allowed: {line.strip()}"
                     for number, line in enumerate(files[path], 1) if len(line) > width]
    if problems:
        raise Problem(*problems)
    return {path: "\n".join(lines) + "\n" for path, lines in files.items()}


def read(path):
    if not os.path.exists(path):
        return ""
    with open(path, encoding="utf-8") as file:
        return file.read()


def main(words, generate=generate, description=__doc__):
    """Writes or checks the files of a function that returns their contents by path. Returns the exit status."""
    parser = argparse.ArgumentParser(description=description, formatter_class=argparse.RawDescriptionHelpFormatter)
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
            print(f"{path} is not what {HEADER} and the tables in fortran/bindings give; ./run bindings writes it anew",
                  file=sys.stderr)
        else:
            with open(os.path.join(arguments.root, path), "w", encoding="utf-8") as file:
                file.write(text)
            print(f"written: {path}")
    print(f"{len(files) - differ} of {len(files)} files were as they should be")
    return 1 if differ and arguments.check else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
