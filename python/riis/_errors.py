# SPDX-License-Identifier: Apache-2.0
"""The exceptions of riis: one class for each status of the C library."""


class Error(Exception):
    """The base of all exceptions of riis. The message names the argument and its value.

    ``status`` is the status of the C library, and ``status_name`` its name there.
    """

    status: int = 0
    status_name: str = ""


class InvalidArgumentError(Error, ValueError):
    """An argument has a wrong shape, order or value, or is closed."""

    status = 1
    status_name = "RIIS_INVALID_ARGUMENT"


class InvalidParameterError(Error, ValueError):
    """A valve refuses a kind, the name or value of a parameter, or values that clash."""

    status = 3
    status_name = "RIIS_INVALID_PARAMETER"


class InvalidSurfaceError(Error, ValueError):
    """The caller's surface is empty, or has a bad vertex or face."""

    status = 4
    status_name = "RIIS_INVALID_SURFACE"


class InvalidMeshError(Error, ValueError):
    """The caller's mesh has a coordinate that is not finite, or a bad row, cell or face."""

    status = 5
    status_name = "RIIS_INVALID_MESH"


class LimitExceededError(Error, ValueError):
    """The request is sound, but larger than the library takes on."""

    status = 6
    status_name = "RIIS_LIMIT_EXCEEDED"


class OutOfMemoryError(Error, MemoryError):
    """Memory ran out. Nothing changed."""

    status = 7
    status_name = "RIIS_OUT_OF_MEMORY"


class UnavailableError(Error, RuntimeError):
    """The processor lacks the instructions, or the process may not do this: a child of ``fork``, or another thread's object."""

    status = 9
    status_name = "RIIS_UNAVAILABLE"


class InternalError(Error, RuntimeError):
    """An error in riis or in a library below it. An object that was being written can only be closed."""

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
for _class in (Error, *_classes.values()):
    _class.__module__ = "riis"


def class_of(status: int) -> type[Error]:
    """Returns the class of a status. A status without a class cannot come from the calls of this package."""
    return _classes.get(status, InternalError)
