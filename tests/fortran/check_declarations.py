# SPDX-License-Identifier: Apache-2.0
"""check_declarations.py SOURCES FORTRAN_COMPILER C_COMPILER: riis_c.f90 must declare what riis.h declares. gfortran writes the C
declarations of its types and functions (-fc-prototypes). The C compiler compares the constants, and the fields of the structs
with their types and places. This script compares the names, order and types of the arguments. The check must refuse planted
faults.

Other Fortran compilers do not write C declarations, so the test is skipped with them (77). The comparison does not
depend on the compiler, because the types and functions are BIND(C)."""

import os
import re
import subprocess
import sys
import tempfile

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "fortran", "bindings"))
from header import Header

# The C types of Fortran's kinds. c_int64_t is long or long long.
TYPES = {"int64_t": ("long", "long long"), "int32_t": ("int",), "uint8_t": ("signed char",), "double": ("double",),
         "riis_status": ("int",), "char": ("char",)}
# Each fault is planted in riis_c.f90, and consists of the old text, the new text and the complaint.
SIZE = "    integer(c_int64_t) :: struct_size\n"
PROGRESS, PRESSURE = "    real(c_double) :: progress\n", "    real(c_double) :: pressure_difference\n"
FAULTS = (
    (PROGRESS + PRESSURE, PRESSURE + PROGRESS, "riis_opening_switch_state%progress differs"),
    ("integer(c_int64_t) :: n_edges", "real(c_double) :: n_edges", "riis_attachment%n_edges differs"),
    ("integer(c_int32_t) :: interpolation", "real(c_float) :: interpolation", "riis_keyframe_arrays%interpolation differs"),
    ("real(c_double) :: about(3)", "real(c_double) :: about(2)", "riis_reaction%about differs"),
    ("    integer(c_int32_t) :: reserved\n  end type riis_resistance\n", "  end type riis_resistance\n",
     "riis_resistance has other fields"),
    (SIZE, SIZE + "    integer(c_int64_t) :: planted\n", "riis_points has other fields"),
    (":: RIIS_SEARCH_PAPER = 3\n", ":: RIIS_SEARCH_PAPER = 4\n", "RIIS_SEARCH_PAPER differs"),
    (":: RIIS_AUTO = -1.0_c_double", ":: RIIS_AUTO = -1.0625_c_double", "RIIS_AUTO differs"),
    ("riis_valve_set(valve, name, n_values,", "riis_valve_set(valve, n_values, name,", "riis_valve_set: name, the argument 2"),
    ("real(c_double), value :: dt\n", "real(c_float), value :: dt\n", "riis_surface_update_moving: dt, the argument 4"),
    ("real(c_double), value :: dp\n", "real(c_double), intent(in) :: dp\n", "riis_surface_add_direction: dp, the argument 4"),
    ("type(c_ptr), value :: wall\n", "type(c_ptr), intent(inout) :: wall\n",
     "riis_valve_set_skirt_to_wall: wall, the argument 2"),
    ("bind(c, name='riis_mesh_prepare')", "bind(c, name='riis_planted')", "riis_mesh_prepare is not in both"),
)


def declarations(compiler, source):
    """Returns the C declarations that gfortran writes."""
    made = subprocess.run([compiler, "-std=f2018", "-fc-prototypes", "-fsyntax-only", source], cwd=os.path.dirname(source),
                          stdout=subprocess.PIPE, stderr=subprocess.PIPE, check=False, text=True)
    if made.returncode:
        raise SystemExit(made.stderr[:2000])
    return made.stdout


def structs_compared(header, text):
    """Returns a C program that compiles only if both sides have equal structs."""
    structs = re.findall(r"typedef struct (\w+) \{\n(.*?)\} \1;\n", text, re.DOTALL)
    fields = {name: re.findall(r"(\w+)(?:\[\d+\])?;", body) for name, body in structs}
    lines = ["#include <riis/riis.h>", "#include <stddef.h>"]
    lines += [f"typedef struct {{\n{body}}} fortran_{name};" for name, body in structs]
    for struct in header.structs:
        of_struct = [field for line in struct.lines for field in line.fields]
        same = sorted(field.name.lower() for field in of_struct) == sorted(fields[struct.name])  # gfortran writes K as k
        lines.append(f'_Static_assert({int(same)}, "{struct.name} has other fields");')
        for field in of_struct if same else []:
            kinds = ("void *",) if field.type.stars else TYPES[field.type.base]
            of_kind = "".join(f"{kind} (*){f'[{field.extent}]' if field.extent else ''}: 1, " for kind in kinds)
            fortran, name = f"fortran_{struct.name}", field.name.lower()
            lines.append(f"_Static_assert(offsetof({fortran}, {name}) == offsetof({struct.name}, {field.name}) &&\n"
                         f"  _Generic(&(({fortran} *)0)->{name}, {of_kind}default: 0) &&\n"
                         f"  sizeof({fortran}) == sizeof({struct.name}), \"{struct.name}%{field.name} differs\");")
    return lines


def constants_compared(source):
    """Returns assertions for the integer constants."""
    constants = re.findall(r"^  \w+\(\w+\), parameter :: (RIIS_\w+) = (-?\d+)$", source, re.MULTILINE)
    return [f'_Static_assert({value} == {name}, "{name} differs");' for name, value in constants]


def reals_compared(header, source):
    """Yields a complaint about each real constant that differs."""
    of_header = {macro.name: float(macro.value) for macro in header.macros if macro.type == "double"}
    of_source = dict(re.findall(r"parameter :: (RIIS_\w+) = (\S+)_c_double$", source, re.MULTILINE))
    for name in sorted(set(of_header) | set(of_source)):
        if of_header.get(name) != float(of_source.get(name, "nan")):
            yield f"{name} differs"


def in_c(type_):
    return f"{'const ' if type_.const else ''}{type_.base} {'*' * type_.stars}"


def reader_compared(header):
    """Returns assertions in C. The assertions show that the C compiler and the reader of the header understand the types of the
    functions alike. The generator of riis_c.f90 uses the reader, and could repeat the reader's mistakes."""
    types = [(function, ", ".join(in_c(argument.type) for argument in function.arguments)) for function in header.functions]
    return [f"_Static_assert(_Generic(&{function.name}, {in_c(function.result)}(*)({arguments or 'void'}): 1, default: 0), "
            f'"{function.name} was read wrongly");' for function, arguments in types]


def types_of(type_, is_value):
    """Returns the C types that gfortran may write for an argument. The address in a type(c_ptr) is passed by value. If the
    library writes a type(c_ptr), the address of this variable is passed. gfortran writes both as void *."""
    if type_.stars == 0:
        return [f"{kind} " for kind in TYPES.get(type_.base, ())] or ["int (*"]
    bases = TYPES.get(type_.base, (type_.base,))
    known = [f"{'const ' if type_.const else ''}{base} *" for base in bases] if type_.stars == 1 else []
    return known + (["void *"] if is_value == (type_.stars == 1) else [])


def functions_compared(header, text, source):
    """Yields a complaint about each function whose declarations differ."""
    made = {name: arguments for name, arguments in re.findall(r"^\w+ \*?(riis_\w+) \((.*)\);$", text, re.MULTILINE)}
    functions = header.functions + header.callbacks
    for name in sorted({function.name for function in functions} ^ set(made)):
        yield f"{name} is not in both riis.h and riis_c.f90"
    for function in functions:
        arguments = re.findall(r"(?! )[^,]+", made.get(function.name, "").replace(")()", ""))
        block = re.split(rf"(?:function|subroutine) {function.name}\(", source)[1].partition("  end ")[0]
        values = re.findall(r"\w+", " ".join(re.findall(r"type\(c_ptr\), value :: (.*)", block)))
        if len(arguments) != len(function.arguments):
            yield f"{function.name} has {len(arguments)} arguments in riis_c.f90, and {len(function.arguments)} in riis.h"
            continue
        for i, argument in enumerate(function.arguments):
            allowed = types_of(argument.type, argument.name in values)
            if arguments[i] not in [kind + argument.name for kind in allowed]:
                yield f"{function.name}: {argument.name}, the argument {i + 1}, differs"


def judge(folder, sources, compilers, source):
    """Returns the complaints about a text of riis_c.f90, and the number of compared things."""
    path, check = os.path.join(folder, "riis_c.f90"), os.path.join(folder, "declarations.c")
    with open(path, "w", encoding="utf-8") as file:
        file.write(source)
    header = Header(os.path.join(sources, "include", "riis", "riis.h"), "riis.h")
    text = declarations(compilers[0], path)
    complaints = [*functions_compared(header, text, source), *reals_compared(header, source)]
    lines = structs_compared(header, text) + constants_compared(source) + reader_compared(header)
    with open(check, "w", encoding="utf-8") as file:
        file.write("\n".join(lines) + "\n")
    made = subprocess.run([compilers[1], "-std=c11", "-fsyntax-only", "-I" + os.path.join(sources, "include"), check],
                          stderr=subprocess.PIPE, check=False, text=True)
    n_compared = len(header.structs), len(constants_compared(source)), len(header.functions)
    return "\n".join([*complaints, made.stderr]).strip(), "{} structs, {} constants, {} functions".format(*n_compared)


def main(sources, *compilers):
    version = subprocess.run([compilers[0], "--version"], stdout=subprocess.PIPE, check=True, text=True).stdout
    if "GNU Fortran" not in version:
        print("skipped: only gfortran writes C declarations")
        return 77
    with open(os.path.join(sources, "fortran", "generated", "riis_c.f90"), encoding="utf-8") as file:
        source = file.read()
    with tempfile.TemporaryDirectory() as folder:
        complaints, compared = judge(folder, sources, compilers, source)
        if complaints:
            print(complaints, file=sys.stderr)
            return 1
        for old, new, _ in FAULTS:
            if old not in source:
                print(f"riis_c.f90 lacks the text for a planted fault: {old}", file=sys.stderr)
                return 1
            source = source.replace(old, new, 1)
        complaints = judge(folder, sources, compilers, source.replace("c_double, ", "c_double, c_float, "))[0]
        missing = [expected for _, _, expected in FAULTS if expected not in complaints]
        if missing:
            print("no complaint that", ", ".join(missing), "but:\n", complaints, file=sys.stderr)
            return 1
    print(f"{compared}, {len(FAULTS)} planted faults were refused")
    return 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
