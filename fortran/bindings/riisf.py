# SPDX-License-Identifier: Apache-2.0
"""Writes the external subroutines riisf_*, and their interfaces, from riis.h and from riisf.table.

A subroutine fills the structs of its C functions from its arguments, calls the functions, and copies results to its arguments."""

import re
import textwrap
from collections import namedtuple
from functools import lru_cache

from fortran import RULE, folded
from header import Problem, plain
from table import Argument

REALS = "real(c_double)"
KINDS = {"double": REALS, "int32_t": "integer(int32)", "uint8_t": "integer(int32)", "riis_status": "integer(riis_status)"}
C_KINDS = {"int64_t": "int64", "int32_t": "int32", "uint8_t": "int8"}
USED = {
    "iso_c_binding": "c_associated c_char c_double c_f_pointer c_loc c_null_ptr c_ptr c_sizeof".split(),
    "iso_fortran_env": "int8 int32 int64".split(),
    "riis_support": "c_handle_of end_for_c fail handle_of location_of out_of_memory text_of".split(),
}
COLUMN = 58  # of the arguments' comments
CREATED, MADE = "Written on success.", "0, which creates them, or from an earlier call."

# A place in C: the argument of a function, or a field of a struct, whose path is "struct%field". `words` are bindings.table's.
Place = namedtuple("Place", "path type extent words struct")
# A struct that the functions read or write: an argument, or a struct to which a field of an argument points, at this path.
Base = namedtuple("Base", "struct is_read path")


@lru_cache(maxsize=None)
def wrapped(text, width):
    return textwrap.wrap(text, width, break_on_hyphens=False)


def if_ok(statements):
    """Returns statements that set the status. Each runs only after success of those before it."""
    return [f"{'if (status == RIIS_OK) ' * (i > 0)}{statement}" for i, statement in enumerate(statements)]


class Subroutine:
    """One subroutine for one kind of counts and ids."""

    def __init__(self, writer, entry, kind):
        self.entry, self.kind, self.header, self.words = entry, kind, writer.header, writer.words
        self.writer = writer
        self.name = entry.name + ("_64" if kind == "int64" else "")
        self.functions = [writer.functions.get(name) or self.refuse(f"riis.h has no {name}") for name in entry.functions]
        self.bases = {}  # the structs, by the name of the argument or of the field that points to the struct
        self.values = {}  # the places of the other arguments
        for function in self.functions:
            for argument in function.arguments:
                if argument.type.base in writer.structs:
                    self.bases.setdefault(argument.name, Base(argument.type.base, argument.type.const, ""))
                elif argument.name != "struct_size":
                    self.values.setdefault(argument.name, Place(argument.name, argument.type, "",
                                                                self.words_of(function.name, argument.name), ""))
        self.arguments = entry.arguments or [
            Argument(name, "(*)" * any(word == "borrowed" or word.startswith("(") for word in place.words), "", "", "")
            for name, place in self.values.items()]
        for name, base in list(self.bases.items()):
            for field in self.fields(base.struct) if base.is_read else []:
                if field.type.base in writer.structs:
                    self.bases.setdefault(field.name, Base(field.type.base, True, f"{name}%{field.name}"))
        self.declarations, self.locals, self.allocated = [], [], []
        self.used = set()  # the structs that have a variable
        self.filled = {}  # the fields and arguments of C that arguments fill, and these arguments
        self.set = []  # statements before the calls
        self.passed = dict(entry.fixed)  # for each argument of the functions, what is passed
        self.results, self.copied = [], []  # statements after the calls, and arguments to which arrays are copied
        self.handle = self.created = ""  # the handle that a call makes; its type, if it makes one only for 0

    def refuse(self, message):
        raise Problem(f"{self.entry.place}: {self.entry.name}: {message}")

    # Places in C --------------------------------------------------------------------------------------------------

    def words_of(self, entry, name):
        entry = self.words.entries.get(entry)
        line = entry.line_of(name) if entry else None
        return line.words if line else []

    def fields(self, struct):
        return [field for line in self.writer.structs[struct].lines for field in line.fields]

    def field(self, base, name):
        """Returns the place of a struct's field. The struct is an argument, or a field of an argument points to it."""
        struct = self.bases[base].struct if base in self.bases else ""
        for field in self.fields(struct) if struct else []:
            if field.name == name:
                return Place(f"{base}%{name}", field.type, field.extent, self.words_of(struct, name), struct)
        return None

    def line_of(self, base, name):
        """Returns the line of riis.h that declares a struct's field."""
        lines = self.writer.structs[self.bases[base].struct].lines
        return next(line for line in lines if name in [field.name for field in line.fields])

    def find(self, argument, target):
        """Returns the place of an argument: the one that the table names, or the one with the argument's name."""
        base, _, name = target.rpartition("%")
        if base:
            return self.field(base, name) or self.refuse(f"riis.h has no {target}")
        stem = re.sub("_num$", "", argument.name)
        bases = sorted(self.bases, key=lambda name: (not self.bases[name].path, not self.bases[name].is_read))
        for name in [target] if target else dict.fromkeys([argument.name, stem + "_id", stem]):
            for place in [self.values.get(name), *(self.field(base, name) for base in bases)]:
                if place:
                    return place
        for base in bases:  # scale_before is the scale of options_before
            ending = re.search("(_after|_before)$", base)
            if ending and argument.name.endswith(ending[1]):
                return self.field(base, argument.name[:-len(ending[1])])
        return None if argument.type and not target else self.refuse(f"riis.h has no {target or argument.name}")

    def local(self, base):
        """Returns the name of the variable for a struct."""
        clash = base.lower() in [argument.name.lower() for argument in self.arguments]
        return f"the_{base}" if clash else base

    def path(self, path):
        base, _, name = path.partition("%")
        self.used.add(base)
        return f"{self.local(base)}%{name}"

    # Arguments ----------------------------------------------------------------------------------------------------

    def type_of(self, argument, place):
        base = place.type.base
        if argument.type:
            return argument.type
        if base in KINDS:
            return KINDS[base]
        if base == "char":
            return "character(len=*)"
        if base in self.header.handles:
            return "integer(int64)"
        if base == "void":
            return REALS if "real" in place.words else f"integer({self.kind})"
        whole = argument.shape and not argument.name.endswith("_num")
        return "integer(int64)" if whole else f"integer({self.kind})"

    def declare(self, argument, type_, intent, usual=""):
        text = argument.text or usual or self.writer.table.texts.get(argument.name) or self.refuse(f"{argument.name} has no text")
        self.declarations.append((f"{type_}, intent({intent}) :: {argument.name}{argument.shape}", text))

    def told(self, text):
        """Returns a text of riis.h with the names of subroutines and of their arguments, and without sentences about C's
        pointers."""
        text = re.sub(r"\briis_\w+", lambda match: self.writer.subroutines.get(match[0], match[0]), plain(text))
        for path, name in self.filled.items():  # a number such as n_points has the name of the argument that gives it
            text = re.sub(rf"\b{path.rpartition('%')[2]}\b", name, text) if name.startswith("n_") else text
        return text

    def described(self, argument, place):
        """Returns the text that riis.h has for an argument or a field, as it holds for a caller who passes all arguments. An
        argument without a text is an object, or a result, or has the text of the last function above that has its name."""
        name, base, counted = place.path.partition("%")[2], place.type.base, " Counted from 1." * argument.name.endswith("_num")
        if not name:
            above = self.header.functions[:self.header.functions.index(self.functions[0])]
            own, others = ([function.text.arguments.get(place.path) for function in functions]
                           for functions in (self.functions, reversed(above)))
            text = self.told(next(filter(None, own), ""))
            if not text and base in self.writer.makers:
                return f"From {self.writer.makers[base]}, for example."
            if not text and place.type.stars and not place.type.const and not argument.shape:
                return CREATED
            if not text and argument.name not in self.writer.table.texts:
                text = self.told(next(filter(None, others), ""))
            return text and text + counted
        if argument.name in self.writer.table.texts:
            return ""
        line = self.line_of(place.path.partition("%")[0], name)
        text = re.sub("Default NaN.*", "", line.text)
        text = re.sub(r"Default (\S+?)(:| stands)", r"\1\2", text.replace("0, the default:", "0:"))
        text = self.told(re.sub(r"Default(?= [0-9R])", "Usually", re.sub("[,;] default ", ", usually ", text)))
        if place.type.stars and not place.extent and not text.startswith("("):
            text = f"({', '.join(self.shape_of(place))}): {text[:1].lower()}{text[1:]}"
        if self.entry.counted and place.type.stars:
            count = self.shape_of(place)[-1]
            return f"{text[:-1].replace(count, 'length')}{', from 1' * bool(counted)}; written up to n."
        names = [field.name for field in line.fields]
        if len(names) > 1 and set(names) <= {other.name for other in self.arguments} and not place.type.stars:
            text = f"{', '.join(names)}: {text[:1].lower()}{text[1:]}"
        return text + counted

    def take(self, argument):
        """Declares an argument, and notes what becomes of it."""
        name = argument.name
        if name in ("n", "length") and self.entry.counted:
            usual = f"The number of {self.entry.counted}, even if an array is too short."
            if name == "length":
                usual = ("The number of entries for which the arrays have room. RIIS_INVALID_ARGUMENT if n is larger; only n is "
                         "then written.")
            self.declare(argument, f"integer({self.kind})", "in" if name == "length" else "inout", usual)
            return
        target, size = re.fullmatch(r"(.*?)(?:\((\w+)\))?", argument.target).groups()
        several = re.fullmatch(r"(?:(\w+)%)?\[(.*)\]", target)
        if several:
            places = [self.find(argument, (several[1] + "%" if several[1] else "") + part) for part in several[2].split(", ")]
            self.take_several(argument, places)
            return
        if self.entry.chosen and name == "values":
            target = self.entry.chosen[0][1]
        place = self.find(argument, target)
        if place is None:
            self.declare(argument, argument.type, "in")
            return
        type_ = self.type_of(argument, place)
        if place.struct and self.bases[place.path.partition("%")[0]].is_read:
            self.set_field(argument, type_, place, size)
        elif place.struct:
            self.declare(argument, type_, "inout", self.described(argument, place))
            if self.entry.counted and place.type.stars:
                self.copied.append((argument, place))
            else:
                self.results.append(f"{name} = {self.converted(argument, type_, place, self.path(place.path))}")
        else:
            self.pass_value(argument, type_, place, size)

    def converted(self, argument, type_, place, value):
        """Returns a number of the library as the argument's kind."""
        if place.type.base == "int64_t":
            value += " + 1" * argument.name.endswith("_num")
            return value if type_ == "integer(int64)" else f"int({value}, int32)"
        return value

    def take_several(self, argument, places):
        """An array whose entries, or whose rows, belong to several fields."""
        base, extent = places[0].path.partition("%")[0], argument.shape.strip("()").split(", ")
        if len(extent) > 1:
            count = self.filled.get(f"{base}%{self.shape_of(places[0])[-1]}")
            self.declare(argument, REALS, "in", f"({extent[0]}, {count}): the points, in mesh units.")
            for i, place in enumerate(places, 1):
                self.set.append(f"{self.path(place.path)} = location_of({argument.name}({i}, 1))")
            self.set.append(f"{self.path(base + '%stride')} = {len(places)}")
            return
        self.declare(argument, REALS, "inout")
        if self.bases[base].is_read:
            self.set += [f"{self.path(place.path)} = {argument.name}({i})" for i, place in enumerate(places, 1)]
        later = [self.path(place.path.replace(base, self.after(base), 1)) for place in places]
        self.results.append(f"{argument.name} = [{', '.join(later)}]")

    def after(self, base):
        """Returns the struct that a function writes as the next state of the struct `base`, or `base`."""
        struct = self.bases[base].struct
        return next((name for name, other in self.bases.items() if other.struct == struct and not other.is_read), base)

    def set_field(self, argument, type_, place, size):
        """An argument that goes into a field of a struct that is read."""
        name, path, base = argument.name, self.path(place.path), place.path.partition("%")[0]
        self.filled[place.path] = name
        next_state = self.after(base)
        writes = place.type.stars and not place.type.const or next_state != base
        self.declare(argument, type_, "inout" if writes else "in", self.described(argument, place))
        if any(f"{place.path} = " in line for line in self.entry.before):
            return
        if size and size.isdigit():
            self.set.append(f"{path}({size}) = " + (f"location_of({name})" if place.type.stars else name))
        elif size:
            self.set.append(f"{path} = c_loc({self.copy(argument, type_, place, size, writes)})")
        elif place.type.stars and place.extent:
            self.set += [f"{path}({i + 1}) = location_of({name}({i + 1}, 1))" for i in range(int(place.extent))]
            self.set.append(f"{path}_stride = {place.extent}")
        elif place.type.stars:
            self.set.append(f"{path} = location_of({name})")
        else:
            self.set.append(f"{path} = {name}" + " - 1" * name.endswith("_num"))
            if next_state != base:
                self.results.append(f"{name} = {self.path(place.path.replace(base, next_state, 1))}")

    def copy(self, argument, type_, place, size, writes):
        """Makes a copy of an array in the kind of C, with ids from 0. Returns its name."""
        name, kind = f"c_{argument.name}", C_KINDS[place.type.base]
        self.locals.append(f"integer({kind}), allocatable, target :: {name}(:)")
        self.allocated.append(f"{name}(max({size}, 1_{self.kind if argument.name.endswith('_num') else 'int32'}))")
        if writes:
            value = self.converted(argument, type_, place, f"{name}(:{size})")
            self.results.append(f"{argument.name}(:{size}) = {value}")
        else:
            self.set.append(f"{name}(:{size}) = int({argument.name}(:{size}), {kind}) - 1")
        return name

    def pass_value(self, argument, type_, place, size):
        """An argument that is an argument of a C function also."""
        name, base, stars = argument.name, place.type.base, place.type.stars
        key, writes = place.path, stars > 0 and not place.type.const
        self.filled[key] = name
        if base in self.header.handles:
            create = self.writer.functions.get(f"{base}_create")
            if stars == 2 or writes and create and len(create.arguments) == 1:
                self.handle, self.created = name, "" if stars == 2 else base
                self.declare(argument, type_, "inout", CREATED if stars == 2 else MADE)
                self.passed[key] = "c_handle"
            else:
                self.declare(argument, type_, "in", self.described(argument, place))
                self.passed[key] = f"c_handle_of({name})"
            return
        self.declare(argument, type_, "inout" if writes else "in", self.described(argument, place))
        self.passed[key] = name
        if base == "char":
            self.locals.append(f"character(len=len_trim({name}) + 1, kind=c_char) :: c_{name}")
            self.set.append(f"call end_for_c({name}, c_{name})")
            self.passed[key] = f"c_{name}"
        elif "borrowed" in place.words:
            self.passed[key] = f"location_of({name})"
        elif size and self.kind == "int32":
            self.passed[key] = self.copy(argument, type_, place, size, writes)
        elif size:
            self.results.append(f"{name}(:{size}) = {name}(:{size}) + 1")
        elif stars == 0 and base == "int64_t" and (type_ != "integer(int64)" or name.endswith("_num")):
            self.passed[key] = f"int({name}, int64)" + " - 1" * name.endswith("_num")
        elif stars == 1 and base == "int64_t" and type_ != "integer(int64)":
            self.locals.append(f"integer(int64) :: c_{name}")
            self.passed[key] = f"c_{name}"
            self.results.append(f"{name} = int(c_{name}, int32)")

    # Statements ---------------------------------------------------------------------------------------------------

    def call_of(self, function):
        """Returns the call of a function. Arguments that are left out are optional; keywords follow them."""
        parts, keyword = [], ""
        written = [name for name, base in self.bases.items() if not base.is_read]
        for argument in function.arguments:
            name, part = argument.name, self.passed.get(argument.name)
            optional = "optional" in self.words_of(function.name, name)
            if argument.type.base in self.writer.structs and (name in self.used or not optional):
                self.used.add(name)
                part = self.local(name)
            elif name == "struct_size":
                part = f"c_sizeof({self.local(written[-1])})"
            if part is None and not optional:
                self.refuse(f"no argument gives {name} of {function.name}")
            elif part is None:
                keyword = "{}="
            else:
                parts.append(keyword.format(name) + part)
        return f"{function.name}({', '.join(parts)})"

    def bits(self):
        """Returns statements that give fields such as id_bits the kind of an argument. The text of such a field in riis.h names
        the array, as in "of node_ids"."""
        lines = []
        for base in self.bases:
            for field in self.fields(self.bases[base].struct) if base in self.used else []:
                array = re.match(r"of (\w+)", self.line_of(base, field.name).text)
                given = array and self.filled.get(f"{base}%{array[1]}")
                if given and field.name in ("id_bits", "offset_bits", "column_bits"):
                    lines.append(f"{self.path(f'{base}%{field.name}')} = storage_size({given})")
        return lines

    def statements(self):
        before = self.bits() + [re.sub(r"\b(\w+)%", lambda match: self.path(match[0]), line) for line in self.entry.before]
        for name, base in self.bases.items():
            if base.path and name in self.used:
                before.append(f"{self.path(base.path)} = c_loc({self.local(name)})")
        calls = [f"status = {self.call_of(function)}" for function in self.functions]
        for base in self.bases:
            if base in self.used and self.bases[base].is_read and self.after(base) != base:
                before.append(f"{self.local(self.after(base))} = {self.local(base)}")
        lines = [*self.variables(), *self.set, *before, *self.chain(calls)]
        if self.handle and not self.created:
            self.results.insert(0, f"{self.handle} = handle_of(c_handle)")
        if self.results or self.copied:
            lines += ["if (status /= RIIS_OK) return", *self.copies(), *self.results]
        return lines

    def variables(self):
        """Declares the structs and copies. Returns the statements that give the structs their defaults and the copies memory."""
        inits = []
        for base, (struct, is_read, path) in self.bases.items():
            if base in self.used:
                name = self.local(base)
                self.locals.append(f"type({struct}){', target' * bool(path)} :: {name}")
                inits += [f"status = {struct}_init({name}, c_sizeof({name}))"] * is_read
        lines = if_ok(inits) + ["if (status /= RIIS_OK) return"] * bool(inits)
        if self.allocated:
            self.locals.append("integer :: stat")
            lines += [f"allocate ({', '.join(self.allocated)}, stat=stat)", "status = out_of_memory(stat)",
                      "if (status /= RIIS_OK) return"]
        return lines

    def chain(self, calls):
        """Returns the calls, with the handle that they make."""
        if self.handle:
            self.locals.append("type(c_ptr) :: c_handle")
        if not self.created:
            return ["c_handle = c_null_ptr"] * bool(self.handle) + if_ok(calls)
        is_new = f"{self.handle} == 0"
        return [f"c_handle = c_handle_of({self.handle})", f"if ({is_new}) status = {self.created}_create(c_handle)",
                *(f"if (status == RIIS_OK) {call}" for call in calls), "! The handle stays 0 if it was 0 and an error occurred.",
                f"if (status /= RIIS_OK .and. {is_new}) call {self.created}_destroy(c_handle)",
                f"{self.handle} = handle_of(c_handle)"]

    def copies(self):
        """Returns the statements that copy arrays of the library into the caller's."""
        if not self.copied:
            return []
        base = self.copied[0][1].path.partition("%")[0]
        n_all = f"{self.local(base)}%" + self.shape_of(self.copied[0][1])[-1]
        lines, missing = [], f"'{self.entry.needed}'"
        if self.entry.chosen:
            lines += self.choice(base, n_all)
            missing = "'field is ' // text_of(field) // ', which the marking did not keep'"
        lines += [f"n = int(min({n_all}, int(huge(n), int64)), {self.kind})", f"if ({n_all} > length) then",
                  f"  status = fail(RIIS_INVALID_ARGUMENT, 'length is ' // text_of(length) // "
                  f"'; {self.entry.counted}: ' // text_of({n_all}))", "  return", "end if", f"if ({n_all} == 0) return"]
        for i, (argument, place) in enumerate(self.copied):
            found = "location" if self.entry.chosen else self.path(place.path)
            copy = self.copied_array(argument, place, found, n_all)
            if missing == "''":
                lines += copy
            elif i == 0:
                lines += [f"if (.not. c_associated({found})) then", f"  status = fail(RIIS_INVALID_ARGUMENT, {missing})",
                          "  return", "end if", *copy]
            else:
                zero = copy[-1].partition(" = ")[0] + " = 0"
                lines += [f"if (c_associated({found})) then", *("  " + line for line in copy), "else", f"  {zero}", "end if"]
        return lines

    def shape_of(self, place):
        """Returns the extents of an array of the library, as bindings.table has them."""
        return next(word for word in place.words if word.startswith("(")).strip("()").split(", ")

    def choice(self, base, n_all):
        """Returns the statements that choose the array by the argument `field`."""
        self.locals += ["type(c_ptr) :: location", "integer(int64) :: n_values"]
        lines = ["select case (field)"]
        for constant, name in self.entry.chosen:
            first = self.shape_of(self.field(base, name))[:-1]
            factor = "".join(f"{extent if extent.isdigit() else self.local(base) + '%' + extent} * " for extent in first)
            lines += [f"case (RIIS_FIELD_{constant})", f"  location = {self.path(base + '%' + name)}",
                      f"  n_values = {factor}{n_all}"]
        names = ", ".join(f"{'_' if i else 'RIIS_FIELD_'}{constant}" for i, (constant, _) in enumerate(self.entry.chosen))
        return [*lines, "case default", "  status = fail(RIIS_INVALID_ARGUMENT, 'field is ' // text_of(field) // "
                f"'; it must be one of {names}')", "  return", "end select"]

    def copied_array(self, argument, place, found, n_all):
        """Returns the statements that copy one array, whose address is `found`. The last one is the assignment."""
        own, first = f"c_{argument.name}", argument.shape.strip("()").split(", ")[:-1]
        kind = REALS if place.type.base == "double" else f"integer({C_KINDS[place.type.base]})"
        self.locals.append(f"{kind}, pointer :: {own}({', '.join(':' for _ in [*first, 1])})")
        if self.entry.chosen:
            size = section = "n_values"
        else:
            whole = self.shape_of(place)[:-1]
            section = "n" if first or not whole else f"{' * '.join(whole)} * {n_all}"
            size = ", ".join([f"{extent}_int64" for extent in first] + [n_all if section == "n" else section])
        lines, value = [f"call c_f_pointer({found}, {own}, [{size}])"], own
        if argument.name.endswith("_num"):
            value = f"int({own} + 1, {self.kind})"
            if self.kind == "int32":
                what = argument.name[:-len("_num")]
                lines += [f"if (maxval({own}) >= huge(n)) then", f"  status = fail(RIIS_LIMIT_EXCEEDED, '{what} ' // "
                          f"text_of(maxval({own})) // ' is more than an INTEGER*4 can count: use {self.name}_64')",
                          "  return", "end if"]
        return [*lines, f"{argument.name}({''.join(':, ' for _ in first)}:{section}) = {value}"]

    def body(self):
        """Returns the statements of a subroutine. Some C functions return no status."""
        result, function = self.functions[0].result, self.functions[0]
        if result.base == "void":
            self.declare(Argument("handle", "", "", "", "May be 0."), "integer(int64)", "inout")
            self.locals.append("type(c_ptr) :: c_handle")
            return ["c_handle = c_handle_of(handle)", f"call {function.name}(c_handle)", "handle = handle_of(c_handle)"]
        for argument in self.arguments:
            if result.base == "char" and argument.name == "text":
                self.declare(argument, "character(len=*)", "out")
                return [f"text = riis_c_text({self.call_of(function)})"]
            self.take(argument)
        self.declare(Argument("status", "", "", "", ""), "integer(riis_status)", "out")
        return self.statements()

    def comment(self):
        """Returns what the subroutine does and its errors, by the table or by riis.h."""
        if self.kind == "int64":
            return f"Does the same as {self.entry.name}, with counts and ids of INTEGER*8."
        text = self.functions[0].text
        what = self.entry.comment or self.told(text.what) or self.refuse(f"{self.functions[0].name} has no comment")
        if self.functions[0].result.base == "void":
            what += " The handle becomes 0. Nothing happens to a handle that is 0."
        return what if "Errors" in what else f"{what} {self.told(text.errors)}".strip()

    def lines(self):
        """Returns the subroutine, and its interface without comments."""
        body = self.body()
        names = [re.search(r":: (\w+)", code)[1] for code, _ in self.declarations]
        head = f"subroutine {self.name}({', '.join(names)})"
        comment = wrapped(self.comment(), 126)
        lines = [f"{'!!' if i else '!>'} {line}" for i, line in enumerate(comment)] + folded(head, "")
        lines += self.uses([code for code, _ in self.declarations] + self.locals + body, "  ") + ["  implicit none"]
        for code, text in self.declarations:
            parts = wrapped(text, 128 - COLUMN - 4)
            lines.append(f"  {code:{COLUMN - 3}} !< {parts[0]}")
            lines += [f"{'':{COLUMN}}!! {part}" for part in parts[1:]]
        for line in [*self.locals, *body]:
            lines += folded(line.lstrip(), "  " + " " * (len(line) - len(line.lstrip())))
        interface = folded(head, "    ") + self.uses([code for code, _ in self.declarations], "      ")
        interface += ["      implicit none", *("      " + code for code, _ in self.declarations)]
        interface.append(f"    end subroutine {self.name}")
        return [*lines, f"end subroutine {self.name}"], interface

    def uses(self, code, indent):
        """Returns the USE statements for the names in some lines."""
        words = set(re.findall(r"[A-Za-z]\w*", re.sub("'[^']*'|%\\w+", "", "\n".join(code))))
        lines = []
        for module, names in [*USED.items(), ("riis_c", self.writer.names)]:
            # Without c_ptr, gfortran 12 takes the result of c_loc for an integer.
            wanted = [name for name in names if name in words or name == "c_ptr" and "c_loc" in words]
            if wanted:
                what = "use, intrinsic ::" if module.startswith("iso") else "use"
                lines += folded(f"{what} {module}, only: {', '.join(wanted)}", indent)
        return lines


class Writer:
    def __init__(self, header, words, table):
        self.header, self.words, self.table = header, words, table
        self.functions = {function.name: function for function in header.functions}
        self.structs = {struct.name: struct for struct in header.structs}
        self.subroutines = {}  # for each function, the name of the first subroutine that the table has for it
        self.makers = {}  # for each sort of object, the name of the first subroutine that changes one
        for entry in (entry for _, _, entries in table.sections for entry in entries):
            self.subroutines.setdefault(entry.functions[0], entry.name)
            function = self.functions.get(entry.functions[0])
            for base, const, _ in [argument.type for argument in function.arguments] if function else []:
                if base in header.handles and not const:
                    self.makers.setdefault(base, entry.name)
        constants = [constant.name for block in [*header.enums, header.macros] for constant in block]
        self.names = sorted({*self.functions, *self.structs, *constants, "riis_status", "riis_c_text"})

    def write(self):
        """Returns the subroutines, and the interfaces with the list of their names."""
        lines, interfaces, public = [], [], []
        for title, text, entries in self.table.sections:
            lines += ["", RULE, f"! {title}", *(f"! {line}" for line in textwrap.wrap(text, 126)), RULE]
            for entry in entries:
                for kind in ("int32", "int64") if entry.long else ("int32",):
                    subroutine = Subroutine(self, entry, kind)
                    whole, interface = subroutine.lines()
                    lines += ["", *whole]
                    interfaces += ["", *interface]
                    public.append(f"  public :: {subroutine.name}")
        return lines, [*public, "", "  interface", *interfaces, "  end interface"]
