# SPDX-License-Identifier: Apache-2.0
"""Translates declarations of a C header to Fortran. If C leaves something open, the table has to say it."""

import fnmatch
import re
import textwrap
from collections import namedtuple

from header import Problem

NUMBERS = {"uint8_t": "integer(c_int8_t)", "int32_t": "integer(c_int32_t)", "int64_t": "integer(c_int64_t)",
           "double": "real(c_double)"}
EITHER_INTEGER = "integer(c_int32_t) or (c_int64_t)"  # an array behind void *
EITHER_REAL = "real(c_double) or (c_float)"  # an array behind void * with the word "real"
WIDTH = 120  # of wrapped lines
RULE = "! " + "-" * 113

# How an argument is declared: "TYPE, ATTRIBUTES :: name SHAPE". `note` is the beginning of the argument's comment.
Declared = namedtuple("Declared", "type attributes shape note")
# ORDER is the order of the words that the table may have for an argument; "(" stands for a shape. The dictionary gives the words
# for each sort of argument, and their meaning.
ORDER = "optional", "required", "borrowed", "scalar", "(", "out"
SUITABLE = {
    "value": ("", "nothing but '-' and a text"),
    "handle": ("", "nothing but '-' and a text"),
    "new handle": ("|optional", "'-', or 'optional' where it may be NULL"),
    "text": ("|optional", "'-', or 'optional' where it may be NULL"),
    "struct to read": (r"(optional|required)( \()?", "'required', or 'optional' where it may be NULL"),
    "struct to write": ("|optional|out|optional out", "'-', or 'optional' where it may be NULL"),
    "numbers to read": (r"borrowed|(optional|required) (scalar|\()",
                        "'required', or 'optional' where it may be NULL, with 'scalar', (*) or (3); or else 'borrowed'"),
    "numbers to write": (r"borrowed|(optional|required) (scalar|\()( out)?",
                         "'required', or 'optional' where it may be NULL, with 'scalar', (*) or (3); or else 'borrowed'"),
    "library's array": (r"(optional|required) \(",
                        "'required', or 'optional' where it may be NULL, with the array's shape, as in (3, n_vertices)"),
}


def in_c(type_, names):
    """Returns a declaration as C writes it."""
    return f"'{'const ' if type_.const else ''}{type_.base} {'*' * type_.stars}{names}'"


def natural(name):
    """Returns a sort key that puts c_int8_t before c_int32_t."""
    return [int(part) if part.isdigit() else part for part in re.split(r"([0-9]+)", name)]


def folded(line, indent, further="    "):
    """Returns a statement, broken after commas, operators and parentheses outside texts where it is too long."""
    lines, rest = [], indent + line
    while len(rest) > WIDTH:
        ends = [match.end() for match in re.finditer("(?<![(]c), |// |[)] ", rest) if match.end() < WIDTH]
        cut = max(end for end in ends if rest.count("'", 0, end) % 2 == 0)
        lines.append(rest[:cut].rstrip() + " &")
        rest = indent + further + rest[cut:]
    return [*lines, rest]


def listed(indent, entries):
    """Returns a comment that lists names with their texts."""
    width = max((len(names) for names, _ in entries), default=0)
    lines = []
    for names, text in entries:
        parts = textwrap.wrap(text, WIDTH - len(indent) - 7 - width, break_on_hyphens=False)
        lines += [f"  {names if i == 0 else '':{width}}  {part}" for i, part in enumerate(parts)]
    return lines


def comment(indent, lines):
    return [f"{indent}{'!!' if i else '!>'} {line}".rstrip() for i, line in enumerate(lines)]


def prose(indent, text):
    return textwrap.wrap(text, WIDTH - len(indent) - 3, break_on_hyphens=False)


class Bindings:
    def __init__(self, header, table):
        self.header, self.table = header, table
        self.struct_names = {struct.name for struct in header.structs}
        self.callback_names = {callback.name for callback in header.callbacks}
        self.problems = []
        self.missing = {}  # for each entry, the lines that the table lacks
        self.used = set()  # entries of the table that were used, (entry, None), and names in them, (entry, name)

    # Entries that the table lacks, and useless ones -----------------------------------------------------------------

    def refuse(self, line, message):
        self.problems.append(f"{line}: {message}")

    def need(self, line, entry, type_, names, what):
        self.refuse(line, f"{entry}: {self.table.shown} does not say of {in_c(type_, names)}: {what}")
        self.missing.setdefault(entry, []).append(names)

    def finish(self):
        """Fails if there was a problem, or if the table has a name that the header lacks."""
        for entry in self.table.entries.values():
            if (entry.name, None) not in self.used:
                self.problems.append(f"{entry.place}: {self.header.shown} has no {entry.name} that needs words")
                continue
            for line in entry.lines:
                for name in line.names:
                    if (entry.name, name) not in self.used:
                        self.problems.append(f"{line.place}: {entry.name} of {self.header.shown} has no {name}")
        if self.missing:
            self.problems.append(f"Needed in {self.table.shown}, whose head says how:")
            for entry, names in self.missing.items():
                self.problems.append("\n".join([entry, *(f"  {name}  ..." for name in names)]))
        if self.problems:
            raise Problem(*self.problems)

    def entry(self, name):
        self.used.add((name, None))
        return self.table.get(name)

    def line_of(self, entry, name):
        line = entry.line_of(name)
        self.used.add((entry.name, name))
        return line

    def kept(self, constants, file):
        """Returns the constants that the table does not list under "omit from FILE"."""
        entry = self.entry("omit from " + file)
        kept = []
        for constant in constants:
            patterns = [name for line in entry.lines for name in line.names if fnmatch.fnmatchcase(constant.name, name)]
            self.used.update((entry.name, name) for name in patterns)
            if not patterns:
                kept.append(constant)
        return kept

    # Constants ----------------------------------------------------------------------------------------------------

    def number(self, type_):
        return f"integer({type_})" if type_ in self.header.typedefs else NUMBERS.get(type_)

    def constants(self):
        lines = []
        for name, type_ in self.header.typedefs.items():
            lines += comment("  ", prose("  ", self.entry(name).text)) + [f"  integer, parameter :: {name} = c_{type_}"]
        for block in [*self.header.enums, self.header.macros]:
            constants = self.kept(block, "riis_c.f90")
            lines += [""] if constants else []
            for constant in constants:
                suffix = "_c_double" if constant.type == "double" else ""
                lines.append(f"  {self.number(constant.type)}, parameter :: {constant.name} = {constant.value}{suffix}")
        return lines

    def names_of_constants(self):
        """Returns the names of the constants that module riis publishes, as the end of a USE statement."""
        kept = [constant for block in [*self.header.enums, self.header.macros] for constant in self.kept(block, "riis_c.f90")]
        return folded(", ".join(constant.name for constant in self.kept(kept, "riis.f90")), "    ", "")

    def fixed_form_constants(self):
        """Returns the constants for fixed form, which has 72 columns. If options change the default kinds, a real constant
        with D0 has another kind. So values that are not exact in every kind are converted to the kind of the first one."""
        lines, first_real = [], None
        for block in [*self.header.enums, self.header.macros]:
            for constant in self.kept(self.kept(block, "riis_c.f90"), "riisf.h"):
                kind, value = "INTEGER(SELECTED_INT_KIND(9))", constant.value
                if constant.type == "double":
                    kind = "REAL(SELECTED_REAL_KIND(15))"
                    mantissa, _, power = constant.value.lower().partition("e")
                    value = f"{re.sub('[.]0*$', '', mantissa)}D{int(power or 0)}"
                    if not re.fullmatch(r"-?[0-9]{1,6}D0", value):
                        value = f"REAL({value}, KIND({first_real or constant.name}))"
                    first_real = first_real or constant.name
                lines += [f"      {kind} {constant.name}", f"      PARAMETER ({constant.name} = {value})"]
        return lines

    # Structs ------------------------------------------------------------------------------------------------------

    def field_text(self, struct, line, field_line, as_in_c):
        """Returns the Fortran type and the comment of the fields that one line of C declares."""
        type_ = field_line.fields[0].type
        names = ", ".join(field.name for field in field_line.fields)
        text = line.text if line else field_line.text if as_in_c else ""
        is_text = type_ == ("char", True, 1)
        if is_text or type_.stars == 0 and self.number(type_.base):
            if line and line.words:
                self.problems.append(f"{line.place}: {struct.name}: {in_c(type_, names)} points to no array; "
                                     "only a text is wanted, after '-'")
            return ("type(c_ptr)", text or "for riis_c_text") if is_text else (self.number(type_.base), text)
        words = [word for word in line.words if word != "real"] if line else []
        if type_.base == "void":
            kind = EITHER_REAL if line and "real" in line.words else EITHER_INTEGER
        else:
            kind = self.number(type_.base) or (f"type({type_.base})" if type_.base in self.struct_names else "")
        if type_.stars != 1 or not kind:
            self.refuse(field_line.line, f"{struct.name}: the type of {in_c(type_, names)} is not understood")
        elif not line or not line.shape or len(words) != 1:
            self.need(field_line.line, struct.name, type_, names, "the shape of the array, as in (3, n_points)")
        else:
            text = f"{kind}, {line.shape}" + (", " + text if text else "")
        return "type(c_ptr)", text

    def struct(self, struct):
        entry, fields = self.entry(struct.name), []
        as_in_c = self.line_of(self.entry("as in riis.h"), struct.name)
        for field_line in struct.lines:
            of_table = [self.line_of(entry, field.name) for field in field_line.fields]
            if any(line is not of_table[0] for line in of_table):
                self.problems.append(f"{of_table[0].place if of_table[0] else self.table.shown}: {struct.name}: "
                                     + ", ".join(field.name for field in field_line.fields) + " belong into one line, as in C")
            type_, text = self.field_text(struct, of_table[0], field_line, as_in_c)
            names = ", ".join(field.name + (f"({field.extent})" if field.extent else "") for field in field_line.fields)
            fields.append((f"    {type_} :: {names}", text))
        column = min(max([len(code) for code, text in fields if text], default=0), 45)
        text = struct.text if as_in_c else entry.text
        lines = comment("  ", prose("  ", text)) + [f"  type, bind(c) :: {struct.name}"]
        for code, text in fields:
            parts = textwrap.wrap(text, WIDTH - column - 4, break_on_hyphens=False) or [""]
            lines.append(f"{code:{column}} !< {parts[0]}" if text else code)
            lines += [f"{'':{column}} !! {part}" for part in parts[1:]]
        return [*lines, f"  end type {struct.name}"]

    def structs(self):
        lines = []
        for struct in self.header.structs:
            lines += ([""] if lines else []) + self.struct(struct)
        return lines

    # Arguments ----------------------------------------------------------------------------------------------------

    def sort_of(self, type_):
        """Returns the sort of argument that a C type makes, or None."""
        base, const, stars = type_
        if stars == 0:
            return "value" if self.number(base) or base in self.callback_names else None
        if base == "void" or base in self.header.handles:
            return {1: "handle", 2: "new handle" if base != "void" and not const else None}.get(stars)
        if base == "char":
            return "text" if const and stars == 1 else None
        if base in self.struct_names:
            return ("struct to read" if const else "struct to write") if stars == 1 else None
        if self.number(base):
            if stars == 2:
                return "library's array" if const else None
            return ("numbers to read" if const else "numbers to write") if stars == 1 else None
        return None

    def words_for(self, function, entry, argument, sort):
        """Returns the table's words for the argument, or () if these words do not suit the argument."""
        line = self.line_of(entry, argument.name)
        words = line.words if line else []
        plain = sorted(("(" if word.startswith("(") else word for word in words), key=ORDER.index)
        pattern, help_ = SUITABLE[sort]
        if re.fullmatch(pattern, " ".join(plain)):
            return words
        if words:
            self.problems.append(f"{line.place}: {function.name}: {' '.join(words)!r} does not suit "
                                 f"{in_c(argument.type, argument.name)}: {help_}")
        else:
            self.need(function.line, function.name, argument.type, argument.name, help_)
        return ()

    def declared(self, function, entry, argument):
        """Returns the Fortran declaration of a function's argument."""
        base, const, _ = argument.type
        sort = self.sort_of(argument.type)
        if not sort:
            self.refuse(function.line, f"{function.name}: the type of {in_c(argument.type, argument.name)} is not understood")
            return Declared("", "", "", "")
        words = self.words_for(function, entry, argument, sort)
        shape = next((word for word in words if word.startswith("(")), "")
        if sort == "value":
            return Declared(self.number(base) or "type(c_funptr)", ", value", "", "")
        if sort == "handle" or "borrowed" in words:
            return Declared("type(c_ptr)", ", value", "", "")
        optional = ", optional" if "optional" in words else ""
        if sort in ("new handle", "library's array"):
            note = f"{self.number(base)}, {shape}" if shape else ""
            return Declared("type(c_ptr)", ", intent(inout)" + optional, "", note)
        intent = ", intent(in)" if const else ", intent(out)" if "out" in words else ", intent(inout)"
        if sort == "text":
            return Declared("character(kind=c_char)", intent + optional, "(*)", "")
        return Declared(self.number(base) or f"type({base})", intent + optional, shape, "")

    def declarations(self, arguments, declared):
        """Returns lines that declare arguments. Adjacent arguments of one kind share a line; each handle has its own."""
        lines, last = [], None
        for argument, how in zip(arguments, declared):
            key = how[:2], argument.type if argument.type.base in self.header.handles else None
            if key == last:
                lines[-1] += f", {argument.name}{how.shape}"
            else:
                lines.append(f"{how.type}{how.attributes} :: {argument.name}{how.shape}")
            last = key
        return lines

    # Functions ----------------------------------------------------------------------------------------------------

    def comment_of(self, function, entry, declared):
        """Returns the comment of a function: the table's text for it and its arguments, and the notes that follow from their
        types."""
        lines = prose("    ", entry.text)
        if not lines and function.result == ("char", True, 1):
            lines = ["For riis_c_text."]
        entries, told = [], {}  # told: the notes, for each line of the table
        structs = [each.name for each in function.arguments if self.sort_of(each.type) == "struct to write"]
        for argument, how in zip(function.arguments, declared):
            line = entry.line_of(argument.name)
            text = ", ".join(part for part in (how.note, line.text if line else "") if part)
            if not text and argument.name == "struct_size" and len(structs) == 1:
                text = f"c_sizeof({structs[0]})"
            if line in told:
                if told[line] != how.note:
                    self.problems.append(f"{line.place}: {function.name}: {', '.join(line.names)} are of several types, "
                                         "so each needs a line of its own")
            elif text:
                entries.append((", ".join(line.names) if line else argument.name, text))
            if line:
                told.setdefault(line, how.note)
        return comment("    ", lines + listed("    ", entries))

    def result_of(self, function):
        """Returns the name and the type of the result, or two blanks."""
        if function.result == ("void", False, 0):
            return "", ""
        if function.result == ("char", True, 1):
            return "text", "type(c_ptr)"
        if function.result.stars == 0 and function.result.base in self.header.typedefs:
            return function.result.base.replace("riis_", "", 1), self.number(function.result.base)
        self.refuse(function.line, f"{function.name}: the type of its result is not understood")
        return "", ""

    def function(self, function):
        entry = self.entry(function.name)
        declared = [self.declared(function, entry, argument) for argument in function.arguments]
        result, type_ = self.result_of(function)
        names = [argument.name for argument in function.arguments]
        if result in names:
            self.refuse(function.line, f"{function.name}: no argument can have the name of the result, {result}")
        what = "function" if result else "subroutine"
        head = f"{what} {function.name}({', '.join(names)}) " + f"result({result}) " * bool(result)
        body = self.declarations(function.arguments, declared) + ([f"{type_} :: {result}"] if result else [])
        kinds = {kind for line in body for kind in re.findall(r"[(=](c_\w+|riis_\w+)\)", line.split(" :: ")[0])}
        lines = self.comment_of(function, entry, declared) + folded(f"{head}bind(c, name='{function.name}')", "    ")
        lines += folded("import :: " + ", ".join(sorted(kinds, key=natural)), "      ", "  ") if kinds else []
        return [*lines, "      implicit none", *("      " + line for line in body), f"    end {what} {function.name}"]

    def functions(self):
        lines, sections = [], list(self.header.sections)
        for function in self.header.functions:
            title = None
            while sections and sections[0].line < function.line:
                title = sections.pop(0).title
            if title:
                lines += [""] * bool(lines) + ["    " + RULE, f"    ! {title}", "    " + RULE]
            lines += [""] * bool(lines) + self.function(function)
        return lines

    def callback(self, callback):
        """Returns the interface of a function that the library calls. All its arguments are passed by value, including
        pointers."""
        entry, lines = self.entry(callback.name), []
        for argument in callback.arguments:
            type_ = self.number(argument.type.base) if argument.type.stars == 0 else "type(c_ptr)"
            if not type_ or argument.type.stars > 1:
                self.refuse(callback.line, f"{callback.name}: the type of {in_c(argument.type, argument.name)} is not understood")
            line = self.line_of(entry, argument.name)
            if line and line.words:
                self.problems.append(f"{line.place}: {callback.name}: only a text is wanted, after '-'")
            code = f"      {type_}, value :: {argument.name}"
            lines.append(f"{code:47} !< {line.text}" if line else code)
        kinds = sorted({kind for line in lines for kind in re.findall(r"\((\w+)\), value", line)}, key=natural)
        return [f"    subroutine {callback.name}(" + ", ".join(argument.name for argument in callback.arguments) + ") bind(c)",
                "      import :: " + ", ".join(kinds), "      implicit none", *lines, f"    end subroutine {callback.name}"]

    def callbacks(self):
        return [line for callback in self.header.callbacks for line in self.callback(callback)]
