# SPDX-License-Identifier: Apache-2.0
"""Writes docs/fortran_calls.md: the calls of riis.h in Fortran and Fortran 77, from riis.h, the Fortran sources, riisf.table and
calls.table, which has the calls whose procedures have other names.

    python3 calls.py                writes the page
    python3 calls.py --check        writes nothing; fails and shows the difference if the page is out of date
    python3 calls.py --root FOLDER  does one or the other in another copy of the sources
"""

import difflib
import glob
import os
import re
import sys
import textwrap

sys.dont_write_bytecode = True
import generate
from header import Header, Problem
from table import Subroutines

HEADER, TABLE, PAGE = "include/riis/riis.h", "fortran/bindings/calls.table", "docs/fortran_calls.md"
SUBROUTINES = "fortran/bindings/riisf.table"
SOURCES = "fortran/riis*.f90", "fortran/generated/riis*.f90"
HEAD = """<!-- SPDX-License-Identifier: Apache-2.0 -->
<!-- Written by ./run bindings (fortran/bindings/calls.py); edit fortran/bindings/calls.table. -->
# Calls in Fortran

This page lists the calls of `riis.h` in its order. The lines below a C call make the same call in
Fortran (`use riis`) and in Fortran 77. Arguments in brackets are optional. A Fortran 77 call with
`*` has a variant for INTEGER*8, whose name ends in `_64`. With `use riisf` the compiler checks the
arguments of Fortran 77 calls, and `include 'riisf.h'` adds the constants
([building.md](building.md)). The comments of the procedures in `fortran` explain the arguments. For
Fortran 77, types, shapes and comments stand in `fortran/generated/riis_f77.f90`. Mind arrays of
INTEGER*8: without `use riisf` no compiler notices an array of INTEGER. Calls that return the
library's own arrays, such as `marked`, take pointers. Calls such as `marked_nodes` fill the
caller's arrays.
"""
WIDTH = 100


def read(root, path):
    return generate.read(os.path.join(root, path))


def statements(text):
    """Yields the statements of a Fortran source, each in one line and without comments."""
    whole = ""
    for line in text.splitlines():
        line = re.sub(r"!.*", "", line).rstrip()
        whole += line.strip().lstrip("&")
        if whole.endswith("&"):
            whole = whole[:-1].rstrip() + " "
        elif whole:
            yield whole
            whole = ""


class Procedure:
    def __init__(self, kind, name, arguments):
        self.kind, self.name, self.arguments, self.optional = kind, name, arguments, set()

    def line(self, call, arguments):
        """Returns the line of use. Optional arguments stand last, in brackets."""
        needed = [name for name in arguments if name not in self.optional]
        rest = [name for name in arguments if name in self.optional]
        text = ", ".join(needed) + (f" [, {', '.join(rest)}]" if needed else f"[{', '.join(rest)}]") * bool(rest)
        return f"call {call}({text})" if self.kind == "subroutine" else f"value = {call}({text})"


class Fortran:
    """The procedures, generic names and bound procedures of the Fortran sources."""

    def __init__(self, root):
        self.procedures, self.generics, self.bound, self.specific = {}, {}, {}, {}
        self.public = set()
        for pattern in SOURCES:
            for path in sorted(glob.glob(os.path.join(root, pattern))):
                if os.path.basename(path) not in ("riis_c.f90", "riis_support.f90", "riis_calls.f90"):
                    self.read(read(root, path), os.path.basename(path))

    def read(self, text, file):
        procedure = type_ = generic = None
        for line in statements(text):
            if match := re.match(r"(?:pure |recursive )*(subroutine|function) (\w+)\((.*?)\)", line):
                if file == "riisf.f90" or not match[2].startswith("riisf_"):
                    names = [name.strip() for name in match[3].split(",") if name.strip()]
                    procedure = self.procedures[match[2]] = Procedure(match[1], match[2], names)
            elif procedure and "optional" in line.split("::")[0]:
                procedure.optional |= set(re.findall(r"\w+", re.sub(r"\(.*?\)", "", line.split("::")[1])))
            elif match := re.match(r"type(?:, \w+)? :: (riis_\w+)", line):
                type_ = match[1]
            elif line.startswith("end type"):
                type_ = None
            elif match := re.match(r"interface (riis_\w+)", line):
                generic = match[1]
            elif generic and (match := re.match(r"module procedure (\w+)", line)):
                self.generics.setdefault(generic, []).append(match[1])
            elif line.startswith("end interface"):
                generic = None
            elif type_ and (match := re.match(r"procedure, private, non_overridable :: (\w+) => (\w+)", line)):
                self.specific[type_, match[1]] = match[2]
            elif type_ and (match := re.match(r"procedure, non_overridable :: (\w+) => (\w+)", line)):
                self.bound[f"{type_}%{match[1]}"] = [match[2]]
            elif type_ and (match := re.match(r"generic :: (\w+) => (\w.*)", line)):
                self.bound[f"{type_}%{match[1]}"] = re.findall(r"\w+", match[2])
            elif file != "riisf.f90" and line.startswith("public ::"):
                self.public |= set(re.findall(r"\briis_\w+", line))

    def forms(self, name):
        """Returns the procedures of a name in the table: several for a generic name, none for an unknown one."""
        found = self.bound.get(name, []) if "%" in name else self.generics.get(name, [name])
        found = [self.specific.get((name.split("%")[0], form), form) for form in found]
        return [self.procedures[form] for form in found if form in self.procedures]

    def lines(self, name):
        """Returns the lines of use of a procedure. A form is left out if another form above it has all its arguments."""
        forms = []
        for form in self.forms(name):
            if not any(set(form.arguments) <= set(other.arguments) for other in forms):
                forms.append(form)
        if "%" in name:
            return [form.line(re.sub(r"^riis_", "", name), form.arguments[1:]) for form in forms]
        if name.startswith("riisf_"):
            star = "*" if name + "_64" in self.procedures else ""
            return [f"CALL {name.upper()}{star}({', '.join(forms[0].arguments).upper()})"]
        return [form.line(name, form.arguments) for form in forms]

    def wanted(self):
        """Returns the names that the table must have."""
        names = {name for name in self.bound if not re.search(r"%(is_created|c_handle|assignment|n_nodes)", name)}
        names |= {name for name in self.procedures if name.startswith("riisf_") and not name.endswith("_64")}
        return names | {name for name in self.public if self.forms(name) and name != "riis_log_procedure"}


class Calls:
    """For each C call, its procedures in both languages, and a reason if one language has none. Names in the table replace those
    names of a language that follow from the call: riis_type%name, riis_name or the subroutines that riisf.table has."""

    def __init__(self, root, declared, fortran):
        self.entries, self.problems = {}, []
        self.read(root)
        self.problems += [f"{TABLE}: {HEADER} has no {name}" for name in self.entries if name not in declared]
        subroutines = {}
        for entry in (entry for section in Subroutines(os.path.join(root, SUBROUTINES), SUBROUTINES).sections
                      for entry in section[2]):
            for name in entry.functions:
                subroutines.setdefault(name, []).append(entry.name)
        for call in declared:
            names, reason = self.entries.get(call, ([], ""))
            found = [name for name in names if not name.startswith("riisf_")] or self.of_same_name(call, fortran)
            found += [name for name in names if name.startswith("riisf_")] or subroutines.get(call, []) * (not reason)
            if found or reason:
                self.entries[call] = found, reason

    def of_same_name(self, call, fortran):
        """Returns riis_type%name for riis_type_name, or riis_name, in which `get` may be left out."""
        kind, _, name = call[len("riis_"):].partition("_")
        names = [f"riis_{kind}%{name}", call, f"riis_{name}", f"riis_{kind}%{name.replace('get_', '')}"]
        return next(([name] for name in names if fortran.forms(name)), [])

    def read(self, root):
        text = re.sub(r"\n +", " ", read(root, TABLE))  # an indented line continues the line above
        for line in text.splitlines():
            if line.strip() and not line.startswith("#"):
                words, _, reason = line.partition(" - ")
                call, *names = words.split()
                if call in self.entries:
                    self.problems.append(f"{TABLE}: {call} is there twice")
                self.entries[call] = names, reason.strip()


def contents(root):
    """Returns the groups of the contents of riis.h, each with its header, its title and its calls with their texts."""
    groups = []
    for line in read(root, HEADER).split("#ifndef")[0].splitlines():
        if match := re.match(r" \* (\w+\.h): (.*)$", line):
            groups.append((match[1], match[2], []))
        elif groups and (match := re.match(r" \*   ((?:riis_\w+(?:, )?)+) *(.*)$", line)):
            groups[-1][2].extend((name, match[2]) for name in match[1].split(", "))
    return groups


def wrapped(line):
    return "\n".join(textwrap.wrap(line, WIDTH, subsequent_indent="     ", break_long_words=False, break_on_hyphens=False))


def page(root):
    """Returns the text of the page."""
    header, fortran, groups = Header(os.path.join(root, HEADER), HEADER), Fortran(root), contents(root)
    declared = [function.name for function in header.functions]
    table = Calls(root, [name for name in declared if not name.endswith("_init")], fortran)
    problems = table.problems
    listed = [name for _, _, calls in groups for name, _ in calls]
    if listed != declared:
        changes = difflib.unified_diff(declared, listed, "the headers", "the contents of riis.h", n=0, lineterm="")
        problems += [f"{HEADER}: its contents are not the calls of the headers, in their order:", *changes]
    told = {name for names, _ in table.entries.values() for name in names}
    problems += [f"{TABLE}: there is no line for {name}" for name in declared
                 if not name.endswith("_init") and name not in table.entries]
    problems += [f"{TABLE}: the Fortran sources have no {name}" for name in sorted(told) if not fortran.forms(name)]
    problems += [f"{TABLE}: {name} belongs to no call" for name in sorted(fortran.wanted() - told)]
    for call, (names, reason) in table.entries.items():
        kinds = {name.startswith("riisf_") for name in names}
        if (len(kinds) == 2) == bool(reason):
            problems.append(f"{TABLE}: {call} needs procedures of both languages, or '-' and a reason")
    if problems:
        raise Problem(*problems)
    lines = [HEAD]
    for file, title, calls in groups:
        lines += [f"## {file}: {title}", "", "```fortran"]
        for call, text in calls:
            if call in table.entries:
                names, reason = table.entries[call]
                if not lines[-1].startswith("```"):
                    lines.append("")
                lines.append(f"! {call}: {text}" if text else f"! {call}")
                lines += [wrapped(line) for name in names for line in fortran.lines(name)]
                lines += [wrapped(f"! {reason}")] if reason else []
        lines += ["```", ""]
    return "\n".join(lines[:-1]) + "\n"


def main(words):
    return generate.main(words, lambda root: {PAGE: page(root)}, __doc__)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
