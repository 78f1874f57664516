# SPDX-License-Identifier: Apache-2.0
"""Reads bindings.table and riisf.table. The heads of these files describe the formats."""

import re
from collections import namedtuple

from header import Problem

SHAPE = re.compile(r"\(\w+( \+ 1)?(, \w+( \+ 1)?)*\)")  # at the beginning of a text in the header
WORDS = {"optional", "required", "scalar", "borrowed", "out", "real"}


class Line:
    """The table's words and text for one argument or field, or for several."""

    def __init__(self, place, names, words, text):
        self.place, self.names, self.words, self.text = place, names, words, text
        shapes = [word for word in words if word.startswith("(")]
        self.shape = shapes[0] if shapes else ""


class Entry:
    """The table's entry for a function, struct, type or file."""

    def __init__(self, place, name, text):
        self.place, self.name, self.text = place, name, text
        self.lines = []

    def line_of(self, name):
        return next((line for line in self.lines if name in line.names), None)


def words_of(column):
    """Returns the words of the second column, where a shape is one word, or None if there are other words."""
    found = []
    rest = column
    while rest:
        match = re.match(r"\((?:[^()]|\([^()]*\))*\)|[a-z]+", rest)
        if not match or not (match[0] in WORDS or match[0].startswith("(")) or match[0] in found:
            return None
        found.append(match[0])
        rest = rest[match.end():].lstrip()
    return found if sum(word.startswith("(") for word in found) <= 1 else None


class Table:
    """The entries of bindings.table, by name."""

    def __init__(self, path, shown):
        self.shown, self.entries, self.problems = shown, {}, []
        entry = None
        with open(path, encoding="utf-8") as file:
            for number, line in enumerate(file.read().splitlines(), 1):
                place = f"{shown}:{number}"
                if not line.strip() or line.startswith("#"):
                    continue
                depth = len(line) - len(line.lstrip(" "))
                if depth == 0:
                    entry = self.read_head(place, line)
                elif entry and depth == 2:
                    self.read_line(place, line.strip(), entry)
                elif entry and depth > 2 and entry.lines:
                    entry.lines[-1].text += " " + line.strip()
                else:
                    self.problems.append(f"{place}: nothing is above that this line could belong to")
        if self.problems:
            raise Problem(*self.problems)

    def read_head(self, place, line):
        name, _, text = (line + "  ").partition("  ")
        if name in self.entries:
            self.problems.append(f"{place}: {name} is in {self.entries[name].place} already")
        return self.entries.setdefault(name, Entry(place, name, text.strip()))

    def read_line(self, place, line, entry):
        first, second, text = (re.split(r" {2,}", line, maxsplit=2) + ["", ""])[:3]
        words = [] if second == "-" else words_of(second)
        if not second or words is None:
            what = f"{second!r} is not understood" if second else "there is no second column"
            self.problems.append(f"{place}: {what}; the second column is '-' or some of "
                                 + ", ".join(sorted(WORDS)) + ", a shape in parentheses")
            words = []
        names = first.split(", ")
        for name in names:
            if entry.line_of(name):
                self.problems.append(f"{place}: {entry.name}: {name} is in {entry.line_of(name).place} already")
        entry.lines.append(Line(place, names, words, text))

    def add_from(self, header):
        """Adds what the header says where the table has no line: the shape at the beginning of a text, as in "(n_nodes): ...",
        fields that may point to a struct, and whether an argument may be NULL. It may if a sentence of its text begins
        with NULL, or if it is `options`. A function without a comment says nothing."""
        structs = {struct.name for struct in header.structs}
        for struct in header.structs:
            for line in struct.lines:
                base = line.fields[0].type.base
                if base in structs and "NULL" in line.text:
                    self.add(struct.name, line.line, [line.fields[0].name], ["(*)"], f"c_loc of a {base}; or c_null_ptr")
                shape = SHAPE.match(line.text)
                if shape and line.fields[0].type.stars:
                    null = "or c_null_ptr" if re.search("NULL(?! only)", line.text) else ""
                    self.add(struct.name, line.line, [field.name for field in line.fields], [shape[0]], null)
        for function in [function for function in header.functions if function.text.what]:
            for argument in function.arguments:
                base, const, stars = argument.type
                text = function.text.arguments.get(argument.name, "")
                if argument.name == "options" and const and "NULL" not in text:
                    text += ". NULL stands for all defaults"
                null = re.search(r"(?:^|[.;] )NULL\b(?:(?::| stands for| keeps) ([^.;]*))?", text)
                shape = SHAPE.match(text)
                words = ["optional" if null else "required"]
                meaning = [f"if left out: {null[1]}"] if null and null[1] else []
                if base in structs and (const or null):
                    self.add(function.name, function.line, [argument.name], words, "".join(meaning))
                elif shape and stars == 1 and base != "char":
                    self.add(function.name, function.line, [argument.name], [*words, "(*)"], ", ".join([shape[0], *meaning]))

    def add(self, name, place, names, words, text):
        entry = self.entries.setdefault(name, Entry(place, name, ""))
        if words and not entry.line_of(names[0]):
            entry.lines.append(Line(place, names, words, text))

    def get(self, name):
        return self.entries.get(name) or Entry(self.shown, name, "")


# An argument of a subroutine, as the table has it: "name(shape) = target : type  text".
Argument = namedtuple("Argument", "name shape target type text")


class Subroutine:
    """A subroutine in the table: its names, C functions, comment and arguments, and its lines of other sorts."""

    def __init__(self, place, name, long, functions):
        self.place, self.name, self.long, self.functions = place, name, long, functions
        self.comment, self.arguments, self.before, self.fixed, self.counted, self.needed, self.chosen = "", [], [], {}, "", "", []


class Subroutines:
    """riisf.table: groups of arguments, and sections, which have a title, a comment and entries."""

    def __init__(self, path, shown):
        self.shown, self.groups, self.texts, self.sections = shown, {}, {}, []
        with open(path, encoding="utf-8") as file:
            lines = file.read().splitlines()
        blocks = []  # a block begins in the first column; its other lines are indented
        for number, line in enumerate(lines, 1):
            if line[:1] not in ("#", " ", ""):
                blocks.append((f"{shown}:{number}", []))
            if line.strip() and not line.startswith("#"):
                blocks[-1][1].append(line)
        for place, block in blocks:
            self.read_block(place, block)

    def read_block(self, place, block):
        """A block in which {marked/within_limit} stands is a block for each of the names."""
        head, colon, rest = block[0].partition(": ")
        lines = [rest] if colon else []
        for line in block[1:]:
            if line.startswith("   "):
                if not lines:
                    raise Problem(f"{place}: nothing is above that the second line could belong to")
                lines[-1] += " " + line.strip()
            else:
                lines.append(line.strip())
        if head.startswith("---- "):
            self.sections.append((head.strip("- "), " ".join(line.lstrip("! ") for line in lines), []))
        elif head == "texts":
            self.texts.update((argument.name, argument.text) for line in lines for argument in self.arguments(place, line))
        elif head.startswith("@"):
            self.groups[head] = lines
        else:
            for i in range(max(part.count("/") + 1 for part in re.findall(r"\{(.*?)\}", "".join(block)) or [""])):
                self.sections[-1][2].append(self.entry(place, *self.chosen([head, *lines], i)))

    def chosen(self, lines, i):
        """Yields the lines with the name i of each {marked/within_limit}, and the lines of groups in place of their names."""
        for line in lines:
            line = re.sub(r"\{(.*?)\}", lambda match: match[1].split("/")[i], line)
            for part in [line] if line[0] in "!>" or "  " in line else re.split(r"(@\w+)(?:, )?", line):
                if part in self.groups:
                    yield from self.chosen(self.groups[part], i)
                elif part:
                    yield part.rstrip(", ")

    def entry(self, place, head, *lines):
        match = re.fullmatch(r"riisf(_\w+)(, _64)?(?: = (riis_\w+(?:, riis_\w+)*))?", head)
        if not match:
            raise Problem(f"{place}: {head!r} is not understood; 'riisf_name, _64 = riis_name' is")
        entry = Subroutine(place, "riisf" + match[1], bool(match[2]), (match[3] or "riis" + match[1]).split(", "))
        for line in lines:
            word, _, rest = line.partition(" ")
            if word == "!":
                entry.comment += " " * bool(entry.comment) + rest
            elif word == ">":
                entry.before.append(rest)
            elif word == "one":
                entry.chosen = [choice.split() for choice in rest.partition("of ")[2].split(", ")]
            elif word in ("counted", "needed"):
                setattr(entry, word, rest)
            elif re.match(r"= RIIS_", rest):
                entry.fixed[word] = rest[2:]
            else:
                entry.arguments += self.arguments(place, line)
        return entry

    def arguments(self, place, line):
        """Reads "name  text", or several names in a line."""
        names, _, text = line.partition("  ")
        found = []
        for name in re.findall(r"(?! )(?:[^,(\[]|\([^)]*\)|\[[^\]]*\])+", names):
            match = re.fullmatch(r"(\w+)(\([^)]*\))?(?: = ([^:]+?))?(?: : (.*))?", name)
            if match:
                found.append(Argument(match[1], match[2] or "", match[3] or "", match[4] or "", text.strip()))
            else:
                raise Problem(f"{place}: the argument {name!r} is not understood")
        return found
