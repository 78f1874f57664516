# SPDX-License-Identifier: Apache-2.0
"""Reads riis.h and the headers that it includes. A declaration that this reader does not know is reported as an error with its
place, and never skipped."""

import os
import re
from collections import namedtuple


class Problem(Exception):
    """A list of messages. Each names the place and the fault."""

    def __init__(self, *messages):
        super().__init__("\n".join(messages))
        self.messages = list(messages)


CType = namedtuple("CType", "base const stars")  # for const double **: ("double", True, 2)
Argument = namedtuple("Argument", "name type")
Field = namedtuple("Field", "name type extent")  # extent: "3" for double lower[3], else ""
FieldLine = namedtuple("FieldLine", "fields text line")  # fields that C declares in one line, and their comment
Function = namedtuple("Function", "name result arguments line text")
Struct = namedtuple("Struct", "name lines line text")
Constant = namedtuple("Constant", "name value type line")  # value: as C writes it; type: the integer type, or double
Section = namedtuple("Section", "title line")


class Place(namedtuple("Place", "file line shown")):
    """A line of one of the headers. Places compare in the order in which riis.h includes the headers."""

    def __str__(self):
        return f"{self.shown}:{self.line}"


class Text:
    """The comment of a function: what it does, its arguments (`name`: text) and its errors. More about the function may stand
    between the arguments and the errors, and is left out."""

    def __init__(self, comment):
        self.what, self.arguments, self.errors = "", {}, ""
        names, lines = [], [re.sub(r"^ *\*", "", line) for line in comment[2:-2].splitlines()]
        for line in lines:
            item = re.match(r"   ((?:`\w+`(?:, )?)+)(?: (?=\()|: ?|, )(.*)", line)
            if item:
                names = re.findall(r"\w+", item[1])
                self.arguments.update((name, item[2].strip()) for name in names)
            elif names and line.startswith("     "):
                self.arguments.update((name, f"{self.arguments[name]} {line.strip()}") for name in names)
            elif self.errors or line.startswith(" Errors: "):
                self.errors = f"{self.errors} {line.strip()}".strip()
            elif not self.arguments:
                self.what = f"{self.what} {line.strip()}".strip()


COMMENT = re.compile(r"/\*.*?\*/", re.DOTALL)
# Preprocessor lines that declare nothing.
KNOWN_LINES = re.compile(r'#(ifndef RIIS_\w+_H|define RIIS_\w+_H|include <stdint\.h>|include "\w+\.h"|ifdef __cplusplus'
                         r"|if defined\(__GNUC__\) && !defined\(RIIS_STATIC\)"
                         r"|define RIIS_API( __attribute__\(\(visibility\(\"default\"\)\)\))?|else|endif)$")


def text_of(comment):
    """Returns the text of a C comment, without its marks and line breaks."""
    return " ".join(re.sub(r"^\s*\*", "", line).strip() for line in comment[2:-2].splitlines()).strip()


def plain(text):
    """Returns a text of riis.h as sentences for callers in Fortran, without those about C's pointers."""
    text = re.sub(r"; [^.;]*\bNULL\b[^.;]*[.] ", ". ", text)
    sentences = [sentence for sentence in re.split("(?<=[.;]) ", text) if not re.search(r"\bNULL\b|->|[*]now", sentence)]
    text = re.sub(r" [*](?=\w)", " ", " ".join(sentences).rstrip(".; ").replace('"', "'"))
    return text and text[:1].upper() + text[1:] + "."


def c_type(words):
    """Returns the type in words such as "const double **", or None."""
    match = re.fullmatch(r"(const )?(\w+) ?(\**)", words.strip())
    return match and CType(match[2], bool(match[1]), len(match[3]))


def with_included(path):
    """Returns the paths of a header and of the headers that it includes by name, in the order in which a compiler reads them."""
    with open(path, encoding="utf-8") as file:
        names = re.findall(r'^#include "(\w+\.h)"', file.read(), re.MULTILINE)
    return [path, *(os.path.join(os.path.dirname(path), name) for name in names)]


class Header:
    """All declarations of a header and of the headers that it includes, in order."""

    def __init__(self, path, shown):
        self.shown = shown  # the header's name in messages
        self.problems = []
        self.functions, self.structs, self.enums, self.macros, self.sections = [], [], [], [], []
        self.typedefs, self.handles, self.callbacks = {}, set(), []
        for number, file in enumerate(with_included(path)):
            self.file = number, os.path.join(os.path.dirname(shown), os.path.basename(file))
            self.read(file)
        if self.problems:
            raise Problem(*self.problems)

    def read(self, path):
        with open(path, encoding="utf-8") as file:
            self.raw = file.read()
        # Comments become blanks, so that everything else keeps its position.
        self.code = COMMENT.sub(lambda match: re.sub(r"[^\n]", " ", match[0]), self.raw)
        self.read_sections()
        self.read_macros()
        self.read_declarations()

    def line(self, place):
        number, shown = self.file
        return Place(number, self.raw.count("\n", 0, place) + 1, shown)

    def refuse(self, place, message):
        self.problems.append(f"{self.line(place)}: {message}")

    def read_sections(self):
        for match in re.finditer(r"^/\* ---- (.*?) -* ?\*/$", self.raw, re.MULTILINE):
            self.sections.append(Section(re.split(r":| \(", match[1])[0].strip(), self.line(match.start())))

    def read_macros(self):
        def blank(match):
            line = " ".join(match[0].split())
            value = re.fullmatch(r"#define (\w+) \(?(-?[0-9]+(?:[.][0-9]*)?(?:e[+-]?[0-9]+)?)\)?", line)
            if value:
                self.macros.append(Constant(value[1], value[2], "double" if re.search("[.e]", value[2]) else "int32_t",
                                            self.line(match.start())))
            elif not KNOWN_LINES.match(line):
                self.refuse(match.start(), f"this line is not understood: {line}")
            return " " * len(match[0])

        self.code = re.sub(r"^#.*$", blank, self.code, flags=re.MULTILINE)
        # Declarations inside extern "C" count like others.
        self.code = re.sub(r'extern "C" \{(.*)\}', r"            \1 ", self.code, flags=re.DOTALL)

    def read_declarations(self):
        """A declaration ends at a semicolon outside braces."""
        start = depth = 0
        after_typedef = None  # the integer type that the previous declaration named
        for match in re.finditer("[{};]", self.code):
            place = match.start()
            depth += (match[0] == "{") - (match[0] == "}")
            if match[0] == ";" and depth == 0:
                start += len(self.code[start:place]) - len(self.code[start:place].lstrip())
                after_typedef = self.read_declaration(start, place, after_typedef)
                start = place + 1
        if self.code[start:].strip():
            start += len(self.code[start:]) - len(self.code[start:].lstrip())
            self.refuse(start, "no semicolon ends what begins here")

    def read_declaration(self, start, end, after_typedef):
        words = " ".join(self.code[start:end].split())
        if words.startswith("enum {"):
            self.read_enum(words, start, after_typedef)
        elif words.startswith("RIIS_API "):
            self.read_function(words, start, end)
        elif re.fullmatch(r"typedef struct (riis_\w+) \1", words):
            self.handles.add(words.split()[2])
        elif re.match(r"typedef struct (riis_\w+) \{.*\} \1$", words):
            self.read_struct(start, end)
        elif re.fullmatch(r"typedef int32_t riis_\w+", words):
            self.typedefs[words.split()[2]] = "int32_t"
            return words.split()[2]
        elif re.match(r"typedef void \(\*riis_\w+\)\(.*\)$", words):
            name, arguments = re.fullmatch(r"typedef void \(\*(riis_\w+)\)\((.*)\)", words).groups()
            self.callbacks.append(Function(name, CType("void", False, 0), self.arguments(arguments, name, start),
                                           self.line(start), Text("")))
        else:
            self.refuse(start, f"this declaration is not understood: {words[:100]}")
        return None

    def read_enum(self, words, start, after_typedef):
        """The values have the integer type that is named just before the enum."""
        values = []
        for entry in words[len("enum {"):].rstrip("} ").rstrip(", ").split(","):
            match = re.fullmatch(r"(RIIS_[A-Z0-9_]+) = (-?[0-9]+)", entry.strip())
            if match:
                values.append(Constant(match[1], match[2], after_typedef or "int32_t", self.line(start)))
            else:
                self.refuse(start, f"the value {entry.strip()!r} of this enum is not understood; NAME = NUMBER is")
        self.enums.append(values)

    def read_function(self, words, start, end):
        match = re.fullmatch(r"RIIS_API (.*?)\b(riis_\w+)\((.*)\)", words)
        result = match and c_type(match[1])
        if not result:
            self.refuse(start, f"this declaration is not understood: {words[:100]}")
            return
        behind = re.compile(r" */\*.*?\*/(?=\n)").match(self.raw, end + 1)
        above = re.search(r"\n(/\*(?:(?!\*/).)*\*/)\n$", self.raw[:start], re.DOTALL)
        comment = behind[0].strip() if behind else above[1] if above else ""
        self.functions.append(Function(match[2], result, self.arguments(match[3], match[2], start), self.line(start),
                                       Text(comment)))

    def arguments(self, words, of, start):
        found = []
        for entry in [] if words == "void" else words.split(","):
            match = re.fullmatch(r"(.*?[ *])([a-z][a-z0-9_]*)", entry.strip())
            type_ = match and c_type(match[1])
            if type_:
                found.append(Argument(match[2], type_))
            else:
                self.refuse(start, f"{of}: the argument {entry.strip()!r} is not understood")
        return found

    def read_struct(self, start, end):
        opening = self.code.index("{", start)
        closing = self.code.rindex("}", start, end)
        name = self.code[start:opening].split()[2]
        lines, place = [], opening + 1
        for match in re.finditer(r"[^;]*;", self.code[opening + 1:closing]):
            place = opening + 1 + match.end()
            lines.append(FieldLine(self.fields(" ".join(match[0][:-1].split()), name, place - 1), self.comment_after(place),
                                   self.line(place - 1)))
        if self.code[place:closing].strip():
            self.refuse(place, f"{name}: no semicolon ends the last field")
        self.structs.append(Struct(name, lines, self.line(start), self.comment_before(start)))

    def fields(self, words, struct, place):
        found = []
        match = re.fullmatch(r"(const )?(\w+) (.*)", words)
        for entry in match[3].split(",") if match else []:
            declared = re.fullmatch(r"(\**)([A-Za-z][A-Za-z0-9_]*)(?:\[([0-9]+)\])?", entry.strip())
            if not declared:
                break
            found.append(Field(declared[2], CType(match[2], bool(match[1]), len(declared[1])), declared[3] or ""))
        else:
            if found:
                return found
        self.refuse(place, f"{struct}: the field {words!r} is not understood")
        return []

    def comment_after(self, place):
        match = re.compile(r"[ \n]*(/\*.*?\*/)", re.DOTALL).match(self.raw, place)
        return text_of(match[1]) if match else ""

    def comment_before(self, place):
        before = self.raw[:place].rstrip()
        return text_of(before[before.rindex("/*"):]) if before.endswith("*/") else ""
