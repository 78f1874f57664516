# SPDX-License-Identifier: Apache-2.0
"""What the nodes of a mesh tell without its cells: the tube that they fill, the distance between neighbours, and which points lie
among them. Nodes may be denser in parts of the mesh."""

from __future__ import annotations

import functools
from typing import Any, NamedTuple

import numpy
from numpy.typing import NDArray

from riis._riis import mesh_sides

Reals = NDArray[numpy.float64]

_MOST_NODES = 50_000  # a larger mesh is judged by a random sample of this size
_N_SECTORS = 16
_MOST_UNEVEN = 0.08  # the scatter of the radii of a tube's section, as a share of the radius; a square has 0.11
_LEAST_DISTINCT = 1.3  # the ratio of two moments from which a principal axis counts


class Tube(NamedTuple):
    """A tube at one place of its length."""

    middle: Reals  #: (3,)
    axis: Reals  #: (3,), a unit vector. Its largest coordinate is above 0
    radius: float


class Nodes:
    """The nodes of a mesh, for several questions."""

    def __init__(self, nodes: Reals) -> None:
        self.n = len(nodes)
        self.lower, self.upper = nodes.min(axis=0), nodes.max(axis=0)
        self.fine: set[Any] = set()  #: placements in which a surface looked right
        self._all = nodes
        if self.n > _MOST_NODES:
            nodes = nodes[numpy.random.default_rng(1).integers(0, self.n, _MOST_NODES)]
        self._nodes = nodes

    @functools.cached_property
    def sides(self) -> tuple[float, float, float]:
        """The sides of the mesh along its principal axes, the longest first."""
        return mesh_sides(numpy.ascontiguousarray(self._all))

    @functools.cached_property
    def _boxes(self) -> Reals:
        """The middles of small boxes that contain nodes. They lie evenly in the mesh, although the nodes may not."""
        side, most = float((self.upper - self.lower).max()) / 32.0, max(64, len(self._nodes) // 4)
        for _ in range(4):
            n = ((self.upper - self.lower) / side).astype(numpy.int64) + 1
            taken = numpy.unique(numpy.ravel_multi_index(((self._nodes - self.lower) / side).astype(numpy.int64).T, n))
            if len(taken) <= most:
                break
            side *= 1.02 * (len(taken) / most) ** (1.0 / 3.0)
        return self.lower + side * (numpy.column_stack(numpy.unravel_index(taken, n)) + 0.5)

    @functools.cached_property
    def tube(self) -> Tube | None:
        """The tube at the middle of the mesh; None if the mesh is no tube."""
        if not (self.upper > self.lower).all():
            return None
        boxes = self._boxes
        axis = _distinct_axis(boxes)
        if axis is None:
            return None
        found = self.at(boxes.mean(axis=0), axis)
        if found is not None:
            from_middle = self._nodes - found.middle
            along = from_middle @ found.axis
            if numpy.linalg.norm(from_middle - along[:, None] * found.axis, axis=1).max() < 1.1 * found.radius:  # it is straight
                return self.at(found.middle + 0.5 * (along.min() + along.max()) * found.axis, axis)
        return self._follow(boxes.mean(axis=0), axis)

    def tube_near(self, place: Reals) -> Tube | None:
        """Returns the tube at a place; None if the mesh is no tube there."""
        return None if self.tube is None else self._follow(place, self.tube.axis)

    def _follow(self, middle: Reals, axis: Reals) -> Tube | None:
        """Returns the tube at a place. Far parts of a bent tube are left out step by step."""
        boxes, found = self._boxes, None
        for _ in range(6):
            found = self.at(middle, axis)
            if found is None:
                return None
            near = boxes[numpy.linalg.norm(boxes - found.middle, axis=1) < 2.5 * found.radius]
            turned = _distinct_axis(near) if len(near) > 30 else None
            if turned is None or abs(turned @ axis) < 0.5 or abs(turned @ axis) > 0.99995:
                break
            middle, axis = found.middle, turned
        return found

    def at(self, place: Reals, axis: Reals) -> Tube | None:
        """Returns the tube at a place near its axis. Returns None if the section there is not round."""
        axis = axis if axis[numpy.abs(axis).argmax()] > 0.0 else -axis
        first = numpy.cross(axis, numpy.eye(3)[numpy.abs(axis).argmin()])
        first /= numpy.linalg.norm(first)
        across = numpy.column_stack([first, numpy.cross(axis, first)])
        from_place = self._nodes - place
        along, flat = from_place @ axis, from_place @ across
        distance = numpy.hypot(*flat.T)
        width = float(numpy.sqrt(2.0 * numpy.mean(distance**2)))
        middle = numpy.zeros(2)
        radius, uneven = width, numpy.inf
        for _ in range(5):
            slab = numpy.abs(along) < 0.25 * radius
            section = flat[slab] - middle
            if len(section) < 4 * _N_SECTORS:
                return None
            sector = ((numpy.arctan2(section[:, 1], section[:, 0]) / (2.0 * numpy.pi) + 0.5) * _N_SECTORS).astype(int)
            reach = numpy.zeros(_N_SECTORS)
            numpy.maximum.at(reach, sector % _N_SECTORS, numpy.hypot(*section.T))
            turn = (numpy.arange(_N_SECTORS) + 0.5) / _N_SECTORS * 2.0 * numpy.pi - numpy.pi
            radius, uneven = float(reach.mean()), float(reach.std() / max(reach.mean(), 1e-300))
            # The first harmonic of the reach is the step to the middle of the section.
            step = 2.0 / _N_SECTORS * numpy.array([reach @ numpy.cos(turn), reach @ numpy.sin(turn)])
            middle = middle + step
        if uneven > _MOST_UNEVEN or reach.min() < 0.5 * radius:
            return None
        return Tube(place + across @ middle, axis, radius)

    def spacing(self, place: Reals, reach: float) -> float:
        """Returns the typical length of edges near a place: the median distance to the sixth neighbour of a node."""
        near = self._all[(numpy.abs(self._all - place) < reach).all(axis=1)]
        if len(near) < 30:
            near = self._all
        if len(near) > 20_000:  # a part of the box keeps its density
            far = numpy.abs(near - place).max(axis=1)
            near = near[far <= numpy.partition(far, 20_000)[20_000]]
        at = near[numpy.linalg.norm(near - place, axis=1).argsort(kind="stable")[:: max(1, len(near) // 80)][:40]]
        squares = ((at[:, None, :] - near[None, :, :]) ** 2).sum(axis=2)
        sixth = min(6, len(near) - 1)
        return float(numpy.sqrt(numpy.median(numpy.partition(squares, sixth, axis=1)[:, sixth])))

    @functools.cached_property
    def _sorted(self) -> tuple[int, Reals]:
        k = int((self.upper - self.lower).argmax())
        return k, self._nodes[self._nodes[:, k].argsort(kind="stable")]

    def are_near(self, points: Reals, reach: float) -> NDArray[numpy.bool_]:
        """Returns for each point whether a node is within this reach. In a sample of a large mesh, nodes are farther apart."""
        k, nodes = self._sorted
        reach *= (self.n / len(nodes)) ** (1.0 / 3.0)
        begin, end = (numpy.searchsorted(nodes[:, k], points[:, k] + by) for by in (-reach, reach))
        found = numpy.zeros(len(points), bool)
        for i, point in enumerate(points):
            found[i] = (((nodes[begin[i] : end[i]] - point) ** 2).sum(axis=1) < reach**2).any()
        return found


def _distinct_axis(points: Reals) -> Reals | None:
    """Returns the principal axis whose moment differs most from the others, as of a long tube or of a disc. None: all are
    alike."""
    moments, axes = numpy.linalg.eigh(numpy.cov(points.T))
    least, middle, most = (max(float(moment), 1e-300) for moment in moments)
    if max(most / middle, middle / least) < _LEAST_DISTINCT:
        return None
    return numpy.array(axes[:, 2] if most / middle >= middle / least else axes[:, 0])


def nodes_of(mesh: Any, mask: Any = None) -> Nodes | None:
    """Returns the nodes of a mesh without a grid, or None if there are none. The mesh remembers them until its next update."""
    if mask is not None:
        nodes = mesh.xyz[numpy.asarray(mask, bool)]
        return Nodes(nodes) if len(nodes) > 0 else None
    found = mesh._judged_nodes
    if found is None and len(mesh) > 0:
        found = mesh._judged_nodes = Nodes(mesh.xyz)
    return found
