# SPDX-License-Identifier: Apache-2.0
"""The wall around a valve, such as a segmented root: triangles in the mesh's frame and unit."""

from __future__ import annotations

import dataclasses
import os
from typing import Any, NamedTuple

import numpy
from numpy.typing import NDArray

from riis._errors import Error
from riis._records import Gap
from riis._riis import Surface, mesh_sides
from riis.view._valves import ValveState, above_zero, refuse

Reals = NDArray[numpy.float64]
Ids = NDArray[numpy.int64]

N_OPENINGS = 11  # at which the program tests that the wall is within the longest skirt
MOST_BEYOND = 0.01  # the share by which the gap may exceed the longest skirt, as in the program
_MARGIN = 0.3  # how far the part of a wall extends beyond a valve, as a share of its size
_N_KEPT = 8  # results


class Widest(NamedTuple):
    """The widest gap between a valve and a wall over all openings."""

    gap: float  #: mesh units
    opening: float  #: at which it is
    is_missed: bool  #: whether a part of the closed valve's attachment has no wall beside it


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
        self._part: tuple[Reals, Reals, Surface] | None = None
        self._widest: list[tuple[ValveState, Widest]] = []

    def _made(self, triangles: Ids) -> Surface:
        return Surface.from_arrays(self.points, triangles, zero_area="skip")

    @property
    def outward(self) -> Surface:
        """The wall with normals outwards. In some files, all triangles point inwards."""
        if self._outward is None:
            a, b, c = (self.points[self.triangles[:, k]] - self.points.mean(axis=0) for k in range(3))
            volume = float(numpy.einsum("ij,ij->", a, numpy.cross(b, c)))
            self._outward = self.surface if volume >= 0.0 else self._made(self.triangles[:, ::-1].copy())
        return self._outward


    def _near(self, surface: Surface) -> Surface:
        """Returns the part of the wall around a valve, in which a gap is found faster."""
        info = surface.info
        margin = _MARGIN * float((info.upper - info.lower).max())
        lower, upper = info.lower - margin, info.upper + margin
        if self._part is None or (self._part[0] > info.lower).any() or (self._part[1] < info.upper).any():
            corners = self.points[self.triangles]
            is_near = ((corners.max(axis=1) >= lower) & (corners.min(axis=1) <= upper)).all(axis=1)
            if not is_near.any() or is_near.all():
                return self.surface
            self._part = lower, upper, self._made(self.triangles[is_near])
        return self._part[2]

    def gap(self, surface: Surface) -> Gap:
        """Measures the gap between a valve and the wall, as Surface.gap does."""
        near = self._near(surface)
        found = surface.gap(near)
        if near is not self.surface and (found.n_without_wall > 0 or found.most > 0.5 * _MARGIN * _size(surface)):
            found = surface.gap(self.surface)
        return found

    def widest(self, state: ValveState) -> Widest:
        """Measures the gap of a valve over all openings, without its skirt."""
        bare = dataclasses.replace(state, opening=0.0, skirt=0.0, offset=0.0, resistance=0.0, name="", cycle=None, placed=None)
        for known, found in self._widest:
            if known == bare:
                return found
        gaps = []
        for opening in numpy.linspace(0.0, 1.0, N_OPENINGS).tolist():
            gaps.append((self.gap(dataclasses.replace(bare, opening=opening).made_surface()), opening))
        most, opening = max((gap.most, opening) for gap, opening in gaps)
        made = Widest(most, opening, gaps[0][0].n_without_wall > 0)
        self._widest = [*self._widest[1 - _N_KEPT :], (bare, made)]
        return made


def _size(surface: Surface) -> float:
    info = surface.info
    return float((info.upper - info.lower).max())


def checked_skirt(value: Any) -> float:
    """Returns the longest skirt, or 0 for none."""
    return 0.0 if value is None or value == 0 else above_zero(value, "skirt")
