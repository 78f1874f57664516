# SPDX-License-Identifier: Apache-2.0
"""Cycles of the view: openings in time, built in or from the CSV files of the program."""

from __future__ import annotations

import math
import re
from pathlib import Path
from typing import Any

import numpy
from numpy.typing import NDArray

from riis._errors import InvalidArgumentError
from riis.laws import OpeningTable, OpeningTimes
from riis.view._valves import Cycle, above_zero, refuse

Reals = NDArray[numpy.float64]

# Built-in cycles by shares of the period: when the valve begins to open and to close, and how long each takes. The aortic valve
# is open in systole, the mitral valve in diastole.
CYCLES = {"aortic": (0.05, 0.06, 0.36, 0.06), "mitral": (0.46, 0.07, 0.92, 0.07), "slow": (0.0, 0.45, 0.5, 0.45)}


def cycle_of(source: str, period: float, interpolation: Any) -> Cycle:
    length = above_zero(period, "period")
    if interpolation not in ("linear", "cubic"):
        raise refuse(f"interpolation: is {interpolation!r}; it must be linear or cubic")
    if source in CYCLES:
        a, b, c, d = CYCLES[source]
        law: OpeningTable | OpeningTimes = OpeningTimes(length * a, length * b, length * c, length * d, period=length)
    else:
        times, openings = _read_cycle(source)
        law = OpeningTable(times, openings, length, interpolation)
    law(0.0)  # refuses keys that do not fit into the period
    return Cycle(source, law, length)


def _read_cycle(path: str) -> tuple[Reals, Reals]:
    """Reads a cycle as the program does: a time and an opening in each line, perhaps names of columns first, and comments."""
    try:
        text = Path(path).read_text(encoding="utf-8-sig")
    except (OSError, ValueError) as error:
        raise refuse(f"builtin_or_csv: {path!r} is neither {', '.join(CYCLES)} nor a file that can be read: {error}") from None
    keys: list[tuple[float, float]] = []
    is_first = True
    for number_of, line in enumerate(text.splitlines(), 1):
        columns = [column for column in re.split(r"[,;\s]+", line) if column]
        if not columns or columns[0].startswith("#"):
            continue
        where = f"{path}: line {number_of}"
        if len(columns) != 2:
            raise InvalidArgumentError(f"{where}: has {len(columns)} columns: {line[:80]!r}; it must have 2, time and opening")
        values = [_number_in(column) for column in columns]
        may_be_names, is_first = is_first, False
        if may_be_names and values == [None, None]:
            continue
        for value, column, what in zip(values, columns, ("time", "opening"), strict=True):
            if value is None:
                raise InvalidArgumentError(f"{where}: the {what} {column[:80]!r} is not a finite number")
        time, opening = (float(value) for value in values if value is not None)
        if keys and time <= keys[-1][0]:
            raise InvalidArgumentError(f"{where}: the time {columns[0]} is not above the time before it")
        if not 0.0 <= opening <= 1.0:
            raise InvalidArgumentError(f"{where}: the opening {columns[1]} is not from 0 to 1")
        keys.append((time, opening))
    if not keys:
        raise InvalidArgumentError(f"{path}: holds no times and openings")
    table = numpy.array(keys)
    return numpy.ascontiguousarray(table[:, 0]), numpy.ascontiguousarray(table[:, 1])


def _number_in(text: str) -> float | None:
    """Returns a finite number that the program also reads. Python alone would also accept 1_000."""
    if not re.fullmatch(r"[+-]?([0-9]+\.?[0-9]*|\.[0-9]+)([eE][+-]?[0-9]+)?", text):
        return None
    made = float(text)
    return made if math.isfinite(made) else None
