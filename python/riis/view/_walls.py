# SPDX-License-Identifier: Apache-2.0
"""The wall around a valve, such as a segmented root: triangles in the mesh's frame and unit."""

from __future__ import annotations

import os
from typing import Any

import numpy
from numpy.typing import NDArray

from riis._riis import Surface, mesh_sides
from riis.view._valves import above_zero, refuse
from riis._errors import Error

Reals = NDArray[numpy.float64]
Ids = NDArray[numpy.int64]


class Wall:
    """A wall from a file, or from arrays in a notebook.

    points     (n, 3)
    triangles  (m, 3)
    path       the file, which commands name. None: commands cannot name the wall
    """

    def __init__(self, points: Any, triangles: Any, path: str | os.PathLike[str] | None = None) -> None:
        self.path = None if path is None else os.fspath(path)
        self.points: Reals = numpy.ascontiguousarray(points, numpy.float64)
        self.triangles: Ids = numpy.ascontiguousarray(triangles, numpy.int64)
        if self.points.ndim != 2 or self.points.shape[1:] != (3,) or len(self.points) == 0:
            raise refuse(f"wall: its points have the shape {numpy.shape(points)}; it must be (n, 3)")
        if self.triangles.ndim != 2 or self.triangles.shape[1:] != (3,) or len(self.triangles) == 0:
            raise refuse(f"wall: its triangles have the shape {numpy.shape(triangles)}; it must be (n, 3)")
        self.lower, self.upper = self.points.min(axis=0), self.points.max(axis=0)
        self.sides = mesh_sides(self.points)
        try:
            self.surface = self._made(self.triangles)
        except Error as error:
            raise type(error)(f"wall: {error}") from None
        self._outward: Surface | None = None

    def _made(self, triangles: Ids) -> Surface:
        return Surface.from_arrays(self.points, triangles, zero_area="skip")

    @property
    def outward(self) -> Surface:
        """The wall with normals outwards. A file may have all triangles turned inwards."""
        if self._outward is None:
            a, b, c = (self.points[self.triangles[:, k]] - self.points.mean(axis=0) for k in range(3))
            volume = float(numpy.einsum("ij,ij->", a, numpy.cross(b, c)))
            self._outward = self.surface if volume >= 0.0 else self._made(self.triangles[:, ::-1].copy())
        return self._outward


def checked_skirt(value: Any) -> float:
    """Returns the longest skirt, or 0 for none."""
    return 0.0 if value is None or value == 0 else above_zero(value, "skirt")
