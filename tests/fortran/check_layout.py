# SPDX-License-Identifier: Apache-2.0
"""check_layout.py SOURCES FORTRAN_COMPILER C_COMPILER: the derived types of riis_c must have the fields of the structs in
riis.h, with the same types in the same places. gfortran writes C structs for the derived types (-fc-prototypes), and the C compiler
compares them with riis.h. Planted faults must be refused. Other Fortran compilers cannot write C structs: the test is then skipped
(77). The layout does not depend on the compiler, because the types are BIND(C)."""

import os
import re
import subprocess
import sys
import tempfile

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "fortran", "bindings"))
from header import Header

# The C types that a Fortran field may have. c_int64_t is long or long long; a pointer is a type(c_ptr).
TYPES = {"int64_t": ("long", "long long"), "int32_t": ("int",), "uint8_t": ("signed char",), "double": ("double",)}
# For each fault that is planted in riis_c.f90: the old text, the new text, and the complaint.
SIZE = "    integer(c_int64_t) :: struct_size\n"
PROGRESS, PRESSURE = "    real(c_double) :: progress\n", "    real(c_double) :: pressure_difference\n"
FAULTS = (
    (PROGRESS + PRESSURE, PRESSURE + PROGRESS, "riis_opening_switch_state%progress differs"),
    ("integer(c_int64_t) :: n_edges", "real(c_double) :: n_edges", "riis_attachment%n_edges differs"),
    ("integer(c_int32_t) :: rim\n", "real(c_float) :: rim\n", "riis_resistance%rim differs"),
    ("real(c_double) :: about(3)", "real(c_double) :: about(2)", "riis_reaction%about differs"),
    ("    integer(c_int32_t) :: reserved\n  end type riis_resistance\n", "  end type riis_resistance\n",
     "riis_resistance has other fields"),
    (SIZE, SIZE + "    integer(c_int64_t) :: planted\n", "riis_points has other fields"),
)


def prototypes(compiler, source):
    """Returns the names and types of the fields of each derived type, and the C structs."""
    made = subprocess.run([compiler, "-std=f2018", "-fc-prototypes", "-fsyntax-only", source], cwd=os.path.dirname(source),
                          stdout=subprocess.PIPE, check=True, text=True).stdout
    structs = re.findall(r"typedef struct (\w+) \{\n(.*?)\} \1;\n", made, re.DOTALL)
    fields = {name: re.findall(r"(\w+)(?:\[\d+\])?;", body) for name, body in structs}
    code = "".join(f"typedef struct {{\n{body}}} fortran_{name};\n" for name, body in structs)
    return fields, code


def assertions(header, fields):
    """Yields a C assertion for each field of the header's structs."""
    for struct in header.structs:
        names = [field.name.lower() for line in struct.lines for field in line.fields]  # gfortran writes K as k
        same = sorted(names) == sorted(fields[struct.name])
        yield f'_Static_assert({int(same)}, "{struct.name} has other fields");'
        for field in [field for line in struct.lines for field in line.fields] if same else []:
            kinds = ("void *",) if field.type.stars else TYPES[field.type.base]
            extent = f"[{field.extent}]" if field.extent else ""
            of_kind = "".join(f"{kind} (*){extent}: 1, " for kind in kinds)
            fortran, name = f"fortran_{struct.name}", field.name.lower()
            yield (f"_Static_assert(offsetof({fortran}, {name}) == offsetof({struct.name}, {field.name}) &&\n"
                   f"  _Generic(&(({fortran} *)0)->{name}, {of_kind}default: 0) &&\n"
                   f"  sizeof({fortran}) == sizeof({struct.name}), \"{struct.name}%{field.name} differs\");")


def judge(folder, sources, compilers, text):
    """Returns the complaints about a text of riis_c.f90, and the numbers of structs and fields that were compared."""
    source, check = os.path.join(folder, "riis_c.f90"), os.path.join(folder, "layout.c")
    with open(source, "w", encoding="utf-8") as file:
        file.write(text)
    header = Header(os.path.join(sources, "include", "riis", "riis.h"), "riis.h")
    fields, code = prototypes(compilers[0], source)
    missing = {struct.name for struct in header.structs} ^ set(fields)
    if missing:
        return "".join(f"{name} is not in both riis.h and riis_c.f90\n" for name in sorted(missing)), 0, 0
    lines = list(assertions(header, fields))
    with open(check, "w", encoding="utf-8") as file:
        file.write("#include <riis/riis.h>\n#include <stddef.h>\n" + code + "\n".join(lines) + "\n")
    made = subprocess.run([compilers[1], "-std=c11", "-fsyntax-only", "-I" + os.path.join(sources, "include"), check],
                          stderr=subprocess.PIPE, check=False, text=True)
    return made.stderr, len(fields), len(lines) - len(fields)


def main(sources, *compilers):
    version = subprocess.run([compilers[0], "--version"], stdout=subprocess.PIPE, check=True, text=True).stdout
    if "GNU Fortran" not in version:
        print("skipped: only gfortran writes the C structs of derived types")
        return 77
    with open(os.path.join(sources, "fortran", "generated", "riis_c.f90"), encoding="utf-8") as file:
        text = file.read()
    with tempfile.TemporaryDirectory() as folder:
        complaints, n_structs, n_fields = judge(folder, sources, compilers, text)
        if complaints or not n_fields:
            print(complaints, file=sys.stderr)
            return 1
        for old, new, expected in FAULTS:
            if old not in text:
                print(f"riis_c.f90 lacks the text for a planted fault: {old}", file=sys.stderr)
                return 1
            faulty = text.replace(old, new, 1).replace("only: c_char", "only: c_float, c_char", 1)
            complaints = judge(folder, sources, compilers, faulty)[0]
            if expected not in complaints:
                print(f"{new.strip()}: no complaint that {expected}, but:\n{complaints}", file=sys.stderr)
                return 1
    print(f"{n_structs} structs, {n_fields} fields, {len(FAULTS)} planted faults were refused")
    return 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
