# SPDX-License-Identifier: Apache-2.0
"""Numbers as people write them, such as -1084 and 0.35, without an exponent for the usual sizes of valves and meshes."""

from __future__ import annotations

import math

_LEAST, _MOST = 1e-6, 1e9  # numbers beyond these have an exponent


def shown(value: float, digits: int = 3) -> str:
    """Returns a number with at least this many digits. Whole numbers keep all their digits."""
    if value == 0.0:
        return "0"
    if not _LEAST <= abs(value) < _MOST:  # also inf and nan
        return f"{value:.{digits}g}"
    power = math.floor(math.log10(float(f"{abs(value):.{digits - 1}e}")))  # of the rounded number
    text = f"{value:.{max(0, digits - 1 - power)}f}"
    if "." in text:
        text = text.rstrip("0").rstrip(".")
    return "0" if text == "-0" else text


def with_unit(value: float, unit: str | None) -> str:
    """Returns a length with its unit, if the unit is known."""
    return shown(value) + (f" {unit}" if unit else "")


def in_unit(value: float, factor: float) -> float:
    """Returns a length times a factor, without the last bits that the product of two decimal numbers leaves."""
    return float(f"{value * factor:.14g}")
