# SPDX-License-Identifier: Apache-2.0
"""The exceptions of riis, one class for each status of the C library, and a warning. The module _errors also replaces C names in
messages by Python names."""

import re
from collections.abc import Callable


class Error(Exception):
    """The base of all exceptions of riis. The message of an exception names the argument and its value.

    ``status`` is the status of the C library, and ``status_name`` is its name in C.
    """

    status: int = 0
    status_name: str = ""


class InvalidArgumentError(Error, ValueError):
    """An argument has a wrong shape, order or value, or it is closed."""

    status = 1
    status_name = "RIIS_INVALID_ARGUMENT"


class InvalidParameterError(Error, ValueError):
    """A kind of valve is unknown, a parameter's name or value is refused, or values do not fit together."""

    status = 3
    status_name = "RIIS_INVALID_PARAMETER"


class MissingAttributeError(InvalidArgumentError, AttributeError):
    """The object has no such attribute: the marking did not make it, or the object is closed. ``hasattr`` then returns False."""


class UnknownParameterError(InvalidParameterError, KeyError):
    """The valve has no parameter of this name."""

    __str__ = Exception.__str__  # KeyError's own __str__ shows the message in quotes


class InvalidSurfaceError(Error, ValueError):
    """The caller's surface is empty, or has a bad vertex or face."""

    status = 4
    status_name = "RIIS_INVALID_SURFACE"


class InvalidMeshError(Error, ValueError):
    """The caller's mesh has a coordinate that is not finite, or a bad row, cell or face."""

    status = 5
    status_name = "RIIS_INVALID_MESH"


class LimitExceededError(Error, ValueError):
    """The request is valid, but larger than the library allows."""

    status = 6
    status_name = "RIIS_LIMIT_EXCEEDED"


class OutOfMemoryError(Error, MemoryError):
    """Memory ran out. Nothing changed."""

    status = 7
    status_name = "RIIS_OUT_OF_MEMORY"


class UnavailableError(Error, RuntimeError):
    """The processor lacks the instructions, or the process must not make this call. Examples are a call in a child of ``fork``,
    and a call with another thread's object."""

    status = 9
    status_name = "RIIS_UNAVAILABLE"


class MarksWarning(UserWarning):
    """riis.mark has marked no node, or few nodes with sizes that suggest a wrong scale."""


class InternalError(Error, RuntimeError):
    """An error in riis or in a library below it. If an object was being written at this time, it can then only be closed."""

    status = -1
    status_name = "RIIS_INTERNAL_ERROR"


_classes = {
    error.status: error
    for error in (
        InvalidArgumentError,
        InvalidParameterError,
        InvalidSurfaceError,
        InvalidMeshError,
        LimitExceededError,
        OutOfMemoryError,
        UnavailableError,
        InternalError,
    )
}
for _class in (Error, MissingAttributeError, UnknownParameterError, MarksWarning, *_classes.values()):
    _class.__module__ = "riis"


def class_of(status: int) -> type[Error]:
    """Returns the class for a status. A status without a class cannot come from the calls of this package."""
    return _classes.get(status, InternalError)


# The functions and structs of riis.h that messages name, and their Python names.
_NAMES = {
    "riis_find_crossings": "riis.find_crossings",
    "riis_loads_add_sums": "riis.load_sums",
    "riis_mark_nodes": "riis.mark",
    "riis_marks_add_vertex_reaction": "Marks.add_vertex_reaction",
    "riis_marks_get_band_sums": "Marks.band_sums",
    "riis_mesh_set_adjacency": "Mesh.set_adjacency",
    "riis_surface_add_direction": "Surface.add_direction",
    "riis_surface_options": "riis.Surface",
    "riis_surface_update_moving": "Surface.update_moving",
    "riis_valve_get_parameter": "Valve.parameters",
    "riis_valve_set_open_state": "Valve.set_open_state",
}
# Fields of C structs that correspond to an argument with another name in Python. All other fields have the same name as their
# argument.
_ARGUMENTS = {
    "arrays.vertex_ids": "faces",
    "csr.n_rows": "the number of rows",
    "ends.from": "from_ids",
    "ends.n_from": "the number of from_ids",
    "ends.n_to": "the number of to_ids",
    "ends.to": "to_ids",
    "options.n_point_ids": "the number of ids",
    "options.node_mask": "mask",
    "options.point_ids": "ids",
    "options.point_mask": "mask",
    "search.from": "from_",
}
# Python's words for C's constants, by argument.
WORDS = {
    "measure": ("triangles", "sampling", "minimization"),
    "instructions": ("auto", "baseline", "avx2", "avx512"),
    "search": ("auto", "exhaustive", "neighbor", "paper", "clusters"),
    "triangulation": ("adapted", "fixed"),
}
FIELDS = ("point", "normal", "barycentric", "side", "rim", "uv", "velocity", "patch_id", "distance_gradient")


def _word_of(match: re.Match[str]) -> str:
    name, verb, number = match[1], match[2], int(match[3])
    if name == "fields":
        words = [word for bit, word in enumerate(FIELDS) if number >> bit & 1]
        return f"{name}{verb}" + (repr(", ".join(words)) if words else "None")
    return f"{name}{verb}{WORDS[name][number]!r}"


def _constant_of(match: re.Match[str]) -> str:
    group, word = match[1].lower(), match[2].lower()
    if word == "*":
        return f"the words of {group}"
    word = {"patch": "patch_id", "gradient": "distance_gradient"}.get(word, word)
    return f"rim={word!r}" if group == "rim" else repr(word)


_CHANGES: tuple[tuple[str, str | Callable[[re.Match[str]], str]], ...] = (
    (r"riis_valve_get_parameter and riis params list them", "Valve.parameters lists them"),
    (r"riis help landmarks lists all names", "docs/formats.md#landmarks lists all names"),
    (r"is not a kind of valve; there are: .*", r"\g<0>. A mechanical valve is 'bileaflet', and a pulmonary valve 'coapting'"),
    (rf"\boptions\.(fields|{'|'.join(WORDS)})( is | = )(\d+)", _word_of),
    (rf"\bRIIS_(AREA|FIELD|INTERPOLATION|PHASE|RIM|{'|'.join(WORDS).upper()})_([A-Z0-9_]+|\*)(?:, \d+)?", _constant_of),
    (r"RIIS_ALL_LEAFLETS, -1, stands", "None stands"),
    (r"^search\.surface: ", ""),
    (r"\briis_[a-z_]+", lambda match: _NAMES.get(match[0], match[0])),
    (r"(?<!['\w])(?:arrays|band|cells|csr|ends|faces|flow|frames|grid|law|loads|nodes|options|patches|points|"
     r"resistance|search|table|times)\.(?:resistance\.)?([A-Za-z]\w*)",
     lambda match: _ARGUMENTS.get(match[0], match[1])),
    (r"\bRIIS_LIST_\*", "the lists of riis.Marks"),
    (r"\bNULL\b", "None"),
)


def in_python(message: str) -> str:
    """Returns a message of the C library with Python names."""
    for pattern, change in _CHANGES:
        message = re.sub(pattern, change, message)
    return message
