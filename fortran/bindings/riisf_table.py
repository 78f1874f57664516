# SPDX-License-Identifier: Apache-2.0
"""Reads riisf.table. The head of that file describes the format."""

import re
from collections import namedtuple

from header import Problem

# An argument of a subroutine, as the table has it: "name(shape) = target : type  text".
Argument = namedtuple("Argument", "name shape target type text")


class Entry:
    """A subroutine in the table: its names, C functions, comment and arguments, and its lines of other sorts."""

    def __init__(self, place, name, long, functions):
        self.place, self.name, self.long, self.functions = place, name, long, functions
        self.comment, self.arguments, self.before, self.fixed, self.counted, self.needed, self.chosen = "", [], [], {}, "", "", []


class Table:
    """The groups of arguments and the sections, which have a title, a comment and entries."""

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
        """A block in which {marked/within_limit} stands is two blocks."""
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
            self.groups[head] = [argument for line in lines for argument in self.arguments(place, line)]
        else:
            for i in range(max(part.count("/") + 1 for part in re.findall(r"\{(.*?)\}", "".join(block)) or [""])):
                chosen = [re.sub(r"\{(.*?)\}", lambda match, i=i: match[1].split("/")[i], line) for line in [head, *lines]]
                self.sections[-1][2].append(self.entry(place, chosen[0], chosen[1:]))

    def entry(self, place, head, lines):
        match = re.fullmatch(r"riisf(_\w+)(, _64)?(?: = (riis_\w+(?:, riis_\w+)*))?", head)
        if not match:
            raise Problem(f"{place}: {head!r} is not understood; 'riisf_name, _64 = riis_name' is")
        entry = Entry(place, "riisf" + match[1], bool(match[2]), (match[3] or "riis" + match[1]).split(", "))
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
        """Reads "name  text", or several names in a line; a group stands for its arguments."""
        names, _, text = line.partition("  ")
        found = []
        for name in re.findall(r"(?! )(?:[^,(\[]|\([^)]*\)|\[[^\]]*\])+", names):
            match = re.fullmatch(r"(\w+)(\([^)]*\))?(?: = ([^:]+?))?(?: : (.*))?", name)
            if name in self.groups:
                found += self.groups[name]
            elif match:
                found.append(Argument(match[1], match[2] or "", match[3] or "", match[4] or "", text.strip()))
            else:
                raise Problem(f"{place}: the argument {name!r} is not understood")
        return found
