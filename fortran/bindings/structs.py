# SPDX-License-Identifier: Apache-2.0
"""For the templates of module riis: procedures with a status, the components of a type that shows a struct of riis.h, and the
statements that copy them."""

import os
import re
import textwrap
from itertools import takewhile

import generate
from fortran import folded
from header import Header, plain
from table import Table

ROOT = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..")
STATUS = ("    integer(riis_status), intent(out), optional :: status   "
          "!< RIIS_OK or the error. Without it an error stops the program.")
KINDS = {"double": "real(c_double)", "int32_t": "integer(int32)", "int64_t": "integer(int64)"}
header = Header(os.path.join(ROOT, generate.HEADER), generate.HEADER)
table = Table(os.path.join(ROOT, generate.TABLE), generate.TABLE)
table.add_from(header)
structs = {struct.name: struct for struct in header.structs}


def fields(name, without):
    """Yields the fields of a struct with the lines that declare them and, for pointers, the extents of the array."""
    for line in structs[name].lines:
        for field in line.fields:
            if field.name not in ["struct_size", "reserved", *without.split()]:
                shape = table.get(name).line_of(field.name).shape if field.type.stars else ""
                yield field, line, shape[1:-1].split(", ") if shape else []


def components(struct, without="", attributes=", pointer", unset="", texts=None, **defaults):
    """Returns the components of a type. Components in `unset` begin as no_value."""
    lines = []
    for field, line, extents in fields(struct, without):
        code = f"    {KINDS[field.type.base]}{attributes * bool(extents)} :: {field.name}"
        if extents:
            code += f"({', '.join(':' for _ in extents)}) => null()"
        else:
            usual = "no_value" if field.name in unset.split() else "-1" if field.name.endswith("_id") else "0"
            code += f"({field.extent})" * bool(field.extent) + f" = {defaults.get(field.name, usual)}"
        text = re.sub(r"\bfields\b", "components", plain((texts or {}).get(field.name, line.text)))
        text = re.sub(r"\b(riis_\w+)[.](?=\w)", r"\1%", text)
        if len(line.fields) > 1:
            text = f"{', '.join(each.name for each in line.fields)}: {text[:1].lower()}{text[1:]}"
        parts = textwrap.wrap(text, min(66, 125 - len(code)), break_on_hyphens=False)
        lines += [f"{code:59} !< {parts[0]}", *(f"{'':60}!! {part}" for part in parts[1:])]
    return "\n".join(lines)


def copied(struct, made, into, without="", indent=4):
    """Returns the statements that copy the numbers of one struct or type into another, and point to the arrays of C."""
    lines = []
    for field, _, extents in fields(struct, without):
        one, other = f"{made}%{field.name}", f"{into}%{field.name}"
        sizes = ", ".join(f"{extent}_int64" if extent.isdigit() else f"{made}%{extent}" for extent in extents)
        pointed = f"if (c_associated({one})) call c_f_pointer({one}, {other}, [{sizes}])"
        lines += folded(pointed if extents else f"{other} = {one}", " " * indent, "  ")
    return "\n".join(lines)


def procedure(name, text, form=0):
    """Returns a public subroutine. The text has its comment, its arguments in order, and then its local variables and statements,
    which set `code`. Each argument has an INTENT, so that no list of the arguments is needed. The status is the last argument,
    unless the text declares the status elsewhere. A text for several kinds may have several comments. `form` is the number of the
    comment, from 0, and a number that is too large stands for the last comment."""
    lines = text.splitlines()
    comments = list(takewhile(lambda line: line.startswith("  !"), lines))
    arguments = list(takewhile(lambda line: re.match(r" +!!|.*\bintent\(", line), lines[len(comments):]))
    rest = "\n".join(lines[len(comments) + len(arguments):]).strip("\n")
    arguments += [STATUS] * (STATUS not in arguments)
    names = [re.search(r":: (\w+)", line)[1] for line in arguments if "intent(" in line]
    comment = re.split(r"\n(?=  !>)", "\n".join(comments))[:form + 1][-1]
    return "\n".join([comment, *folded(f"subroutine {name}({', '.join(names)})", "  "), *arguments,
                      "    integer(riis_status) :: code", rest, "    call finish(code, status)", f"  end subroutine {name}", ""])


def specific_procedures(stem, bindings, renamed):
    """Yields the bindings that the generic names of a type need for specific procedures, and the names of these procedures."""
    text = re.sub("!<.*|&\n", "", bindings)
    for name in re.findall(r"\w+", " ".join(re.findall(r"generic :: \w+ => (.*)", text))):
        first, _, rest = name.partition("_")
        yield name, f"{renamed.get(first, f'{stem}_{first}')}_{rest}"
