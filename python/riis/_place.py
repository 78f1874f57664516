# SPDX-License-Identifier: Apache-2.0
"""A valve's sizes and placement from a patient's landmarks. The sources of the program read them (docs/formats.md)."""

from __future__ import annotations

import os
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, Literal

import numpy
from numpy.typing import NDArray

from riis._errors import InvalidArgumentError
from riis._riis import Valve, Warp, place_landmarks, units, with_parameters

Reals = NDArray[numpy.float64]

UNITS = {name: length for name, (length, _) in units().items()}  # lengths in the unit for each centimetre
WORDS_OF_UNITS = {name: words for name, (_, words) in units().items()}


@dataclass(frozen=True)
class PlaceResult:
    """A placed valve. The surface is Surface(result.valve, **result.placement). Lengths of the placement, residuals, noise and
    position_error have the unit of the landmarks; parameters are in centimetres."""

    valve: Valve
    placement: dict[str, Any]  #: scale, rotation_axis, rotation_angle (degrees) and translation
    unit: str  #: "mm", "cm" or "m", of the landmarks and of the placement
    axes: str  #: "LPS", "RAS" or "mesh"
    names: tuple[str, ...]  #: of the landmarks
    residuals: Reals  #: (n_landmarks,), the distances from the landmarks to their places on the valve
    rms: float  #: root mean square of the residuals
    worst: float  #: the largest residual
    worst_landmark: str  #: its landmark
    noise: float  #: for the standard errors: the landmarks' noise, or more if the residuals show more
    rotation_error: float  #: standard error of the rotation, degrees
    position_error: float  #: standard error of the position of the valve's origin
    standard_errors: dict[str, float]  #: of the parameters on which the landmarks bear
    determined: tuple[str, ...]  #: parameters from the landmarks
    undetermined: tuple[str, ...]  #: parameters on which landmarks bear without determining them
    in_proportion: tuple[str, ...]  #: parameters that follow from others, by the valve's proportions
    points: Reals = field(repr=False)  #: (n_landmarks, 3)
    places: Reals = field(repr=False)  #: (n_landmarks, 3), the landmarks' places on the closed valve before a warp
    warp: Warp | None = field(default=None, repr=False)  #: the valve's warp, which takes the places to the points
    warp_noise: float = 0.0  #: by which the warp is smoothed
    warped_residuals: Reals | None = None  #: (n_landmarks,), distances from the warped closed valve
    _report: str = field(default="", repr=False)
    _file: str = field(default="", repr=False)

    def report(self) -> str:
        """Returns a table of the parameters with their standard errors, followed by the residuals, as the program prints it."""
        return self._report

    def save(self, path: str | os.PathLike[str]) -> None:
        """Writes the file of a placed valve, which each command of the program riis accepts as --valve FILE.json."""
        Path(path).write_text(with_parameters(self._file, self.valve))


def place(
    landmarks: Mapping[str, Any] | str | os.PathLike[str],
    valve: Valve | str | None = None,
    *,
    unit: Literal["mm", "cm", "m"] | None = None,
    axes: Literal["LPS", "RAS"] | None = None,
    flow: Any = None,
    noise: float | None = None,
    held: Any = (),
    warp: Literal["none", "exact", "smoothed"] = "none",
    nodes: Any = None,
) -> PlaceResult:
    """Finds a valve's sizes and placement from a patient's landmarks.

    landmarks  a mapping of names to points, such as {"nadir_left": (1, 2, 3), "annulus": [(...), ...]}, or the path of a file in
               JSON, CSV, or 3D Slicer's .mrk.json or .fcsv. docs/formats.md lists the names
    valve      a kind, or a Valve whose proportions the result gets. The default is the kind that the file names. The paper's
               "aortic" valve does not close at opening 0. "coapting" and "trileaflet" take the same landmarks, and close
    unit       of the landmarks; needed for a mapping. For a file it is the unit of the result, to which the landmarks are
               converted
    axes       of the mesh. If a file has the other axes, its landmarks are turned by half a turn about z
    flow       (3,), the direction of flow; needed for bileaflet valves, for mitral valves without commissures and saddle, for
               mitral_coapting valves without commissures and horn, and for tricuspid valves without names of leaflets
    noise      standard deviation of each coordinate, in the unit; default 0.3 mm
    held       names of parameters that keep the valve's values
    warp       "exact" warps the valve to the landmarks, and "smoothed" as near to them as their noise allows
    nodes      (n, 3), of the mesh; landmarks are refused if their mean distance from the nodes is above a centimetre

    The valve is copied. Raises InvalidArgumentError naming landmarks that are missing, in one place, collinear, mirrored, or not
    of the size of a heart valve in this unit. If landmarks are not at the nodes, the message says whether they would be there
    with LPS and RAS swapped, or in another unit. Raises InvalidParameterError for sizes that do not fit together, for a folding
    warp, and for any warp of a bileaflet valve, which is rigid.
    """
    if warp not in ("none", "exact", "smoothed"):
        raise InvalidArgumentError(f"warp is {warp!r}; it must be none, exact or smoothed")
    if isinstance(landmarks, Mapping):
        stated = {} if unit is None else {"unit": unit}
        subject, unit = "landmarks", None
        content: str | dict[str, Any] = {**stated, "axes": "mesh", "landmarks": dict(landmarks)}
    elif isinstance(landmarks, str | os.PathLike):
        subject, content = os.fspath(landmarks), Path(landmarks).read_text("utf-8-sig", "replace")
    else:
        raise TypeError(f"landmarks must be a mapping of names to points, or a path, not {type(landmarks).__name__}")
    cloud = None if nodes is None else numpy.ascontiguousarray(nodes, numpy.float64)
    names = [held] if isinstance(held, str) else held
    return PlaceResult(**place_landmarks(subject, content, valve, unit, axes, flow, noise, names, warp, cloud))
