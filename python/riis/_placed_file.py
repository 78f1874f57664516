# SPDX-License-Identifier: Apache-2.0
"""The file of a placed valve, as the program riis and PlaceResult.save write it."""

from __future__ import annotations

import os
from pathlib import Path
from typing import Any, NamedTuple

from riis._errors import Error
from riis._riis import PlacedFile, Valve, Warp


class PlacedValve(NamedTuple):
    """A placed valve from a file. The surface is Surface(placed.valve, **placed.placement)."""

    valve: Valve  #: closed, and warped if the file has a warp
    placement: dict[str, Any]  #: scale, rotation_axis, rotation_angle (degrees) and translation
    unit: str  #: "mm", "cm" or "m", of the placement


def read_placed(path: str | os.PathLike[str], unit: str | None = None) -> PlacedValve:
    """Reads a placed valve from the file of ``riis place --output``, or of the method save of place's result.

    path  the .json file
    unit  of the placement and of the warp: "mm", "cm" or "m". None: the file's unit

    Raises InvalidArgumentError naming the file and the fault in it, or the unit; InvalidParameterError for sizes that the valve
    refuses; OSError for a file that cannot be read.
    """
    file, valve = open_placed(path, unit)
    return PlacedValve(valve, file.placement, file.unit)


def open_placed(path: str | os.PathLike[str], unit: str | None) -> tuple[PlacedFile, Valve]:
    """Reads a placed valve as read_placed does. Returns the content of the file, and the valve."""
    name = os.fspath(path)
    file = PlacedFile(name, Path(path).read_text("utf-8-sig", "replace"), unit)
    try:
        valve = Valve(file.kind)
        file.set_parameters(valve)
        warps = []
        for sources, targets in file.warps:
            warps.append(Warp(sources, noise=file.noise, placement=file.placement if file.is_in_mesh else None))
            warps[-1].set_targets(targets)
        if warps:
            valve.set_warp(*warps)
    except Error as error:
        raise type(error)(str(error) if str(error).startswith(name) else f"{name}: {error}") from None
    return file, valve
