# SPDX-License-Identifier: Apache-2.0
"""The bumps of the valves of a model, and their places. A bump is a disease at one place of a free edge
(docs/theory/bumps.md)."""

from __future__ import annotations

from typing import NamedTuple

import numpy
from numpy.typing import NDArray

from riis._riis import Valve
from riis.view._history import Valves
from riis.view._valves import ValveState, n_leaflets, refuse, values_that_were_set

Reals = NDArray[numpy.float64]

_NONE = -1
_N_POINTS = 25  # of a drawn line


class Bump(NamedTuple):
    """A bump that has a place. The bump lies on a leaflet or at a commissure, and the number of the other place is -1."""

    number: int  #: the n of bump_n
    leaflet: int
    commissure: int


class BumpPlace(NamedTuple):
    """The position of a bump in the mesh."""

    point: Reals  #: (3,), on the free edge
    lines: list[Reals]  #: (n, 3) each: the parts of free edges on which the bump acts


def most_bumps(valve: Valve) -> int:
    """Returns the number of bumps that a kind of valve can have."""
    return sum(name.startswith("bump_") and name.endswith(".leaflet") for name in valve)


def bumps_of(valve: Valve) -> list[Bump]:
    """Returns the bumps that have a place."""
    all_bumps = (
        Bump(k, int(valve[f"bump_{k}.leaflet"]), int(valve[f"bump_{k}.commissure"])) for k in range(most_bumps(valve))
    )
    return [bump for bump in all_bumps if bump.leaflet != _NONE or bump.commissure != _NONE]


# ---- The free edge ----


def _points_of(control: Reals) -> Reals:
    """Returns points of a Bézier curve, by de Casteljau's algorithm."""
    t = numpy.linspace(0.0, 1.0, _N_POINTS)[:, None]
    points = [numpy.broadcast_to(point, (_N_POINTS, 3)) for point in control]
    while len(points) > 1:
        points = [(1.0 - t) * a + t * b for a, b in zip(points, points[1:])]
    return numpy.array(points[0])


def _joined(pieces: list[Reals]) -> list[Reals]:
    """Returns lines in the order and in the directions in which they form one line."""
    chain, rest = [pieces[0]], list(pieces[1:])
    while rest:
        # Each line may continue the chain at either end, in either direction.
        trials = [
            (float(numpy.linalg.norm((chain[-1][-1] if at_end else chain[0][0]) - line[0 if at_end else -1])), k, at_end, turned)
            for k, piece in enumerate(rest)
            for turned, line in ((False, piece), (True, piece[::-1]))
            for at_end in (True, False)
        ]
        _, k, at_end, turned = min(trials)
        piece = rest.pop(k)
        line = piece[::-1] if turned else piece
        chain = [*chain, line] if at_end else [line, *chain]
    return chain


def free_edge(valve: Valve, leaflet: int) -> tuple[Reals, Reals]:
    """Returns points (n, 3) along the free edge of a leaflet, counter-clockwise seen from +z, and the share u (n,) of each.

    The points are in the valve's own frame. The middle of the edge, u = 0.5, is the joint of two curves.
    """
    read = valve.read_patches()
    curves = read.curve_id[read.leaflet_id == leaflet]
    ids, counts = numpy.unique(curves, return_counts=True)
    own = set(ids[counts == 1].tolist())  # a side v = 1 of only one patch of the leaflet is a part of its free edge
    starts = numpy.concatenate([[0], numpy.cumsum(read.degree + 1)])

    def control_of(curve: int) -> Reals:
        return read.control[starts[read.first_piece[curve]] : starts[read.first_piece[curve + 1]]]

    pieces = [
        _points_of(read.control[starts[piece] : starts[piece + 1]])
        for curve in curves[:, 1].tolist() if curve in own
        for piece in range(int(read.first_piece[curve]), int(read.first_piece[curve + 1]))
    ]  # fmt: skip
    chain = _joined(pieces)
    line = numpy.concatenate(chain)
    # Seen from the middle of the valve, the edge ends counter-clockwise of the middle of its attachment.
    attachments = []
    for patches in (read.attached >= 0, (read.attached >= 0) & (read.leaflet_id == leaflet)):
        sides = read.curve_id[patches, read.attached[patches]].tolist()
        attachments.append(numpy.concatenate([control_of(curve) for curve in sides]).mean(axis=0))
    outward, last = attachments[1] - attachments[0], line[-1] - attachments[0]
    if outward[0] * last[1] - outward[1] * last[0] < 0.0:
        chain = [piece[::-1] for piece in chain[::-1]]
        line = line[::-1]
    length = numpy.concatenate([[0.0], numpy.cumsum(numpy.linalg.norm(numpy.diff(line, axis=0), axis=1))])
    share = length / length[-1]
    if len(chain) == 1:
        return share, line
    joints = share[_N_POINTS - 1 : -1 : _N_POINTS]
    middle = joints[numpy.argmin(numpy.abs(joints - 0.5))]
    return numpy.interp(share, [0.0, middle, 1.0], [0.0, 0.5, 1.0]), line


def place_of(valve: Valve, bump: Bump, n: int) -> BumpPlace:
    """Returns the place of a bump in the valve's own frame. n is the number of leaflets."""
    width = float(valve[f"bump_{bump.number}.width"])

    def part(edge: tuple[Reals, Reals], low: float, high: float) -> Reals:
        at = numpy.linspace(max(0.0, low), min(1.0, high), _N_POINTS)
        return numpy.column_stack([numpy.interp(at, edge[0], coordinate) for coordinate in edge[1].T])

    if bump.leaflet != _NONE:
        u, edge = float(valve[f"bump_{bump.number}.u"]), free_edge(valve, bump.leaflet)
        return BumpPlace(part(edge, u, u)[0], [part(edge, u - width, u + width)])
    before, behind = (free_edge(valve, leaflet % n) for leaflet in (bump.commissure, bump.commissure + 1))
    lines = [part(before, 1.0 - width, 1.0), part(behind, 0.0, width)]
    return BumpPlace(lines[0][-1], lines)


# ---- Changes ----


class BumpedValves(Valves):
    """The part of a model that changes bumps."""

    def _valve_of(self, i: int) -> tuple[ValveState, Valve]:
        state = self._at(i).state
        valve = state.valve()
        if valve is None:
            raise refuse(f"i: valve {i} is a surface from a file, which has no bumps")
        return state, valve

    def most_bumps(self, i: int) -> int:
        """Returns the number of bumps that a valve can have; 0 for kinds without bumps."""
        valve = self._at(i).state.valve()
        return 0 if valve is None else most_bumps(valve)

    def bumps(self, i: int) -> list[Bump]:
        """Returns the bumps of a valve that have a place."""
        return bumps_of(self._valve_of(i)[1])

    def add_bump(self, i: int) -> int:
        """Adds a bump in the middle of the first leaflet of a valve. The bump changes nothing yet. Returns its number."""
        _, valve = self._valve_of(i)
        used = {bump.number for bump in bumps_of(valve)}
        free = [number for number in range(most_bumps(valve)) if number not in used]
        if used and not free:
            raise refuse(f"i: valve {i} has {len(used)} bumps, and no kind has more")
        number = free[0] if free else 0  # the library says which kinds have bumps
        self.place_bump(i, number, leaflet=0)
        return number

    def place_bump(self, i: int, number: int, *, leaflet: int = _NONE, commissure: int = _NONE) -> None:
        """Puts a bump on a leaflet or at a commissure."""
        _, valve = self._valve_of(i)
        valve.update({f"bump_{number}.leaflet": leaflet, f"bump_{number}.commissure": commissure})
        self._replace(i, ("bump", i, number), parameters=values_that_were_set(valve))

    def remove_bump(self, i: int, number: int) -> None:
        """Removes a bump, and all its numbers."""
        _, valve = self._valve_of(i)
        for name in list(valve):
            if name.startswith(f"bump_{number}."):
                valve.unset(name)
        self._replace(i, ("bump", i, number), parameters=values_that_were_set(valve))

    def bump_place(self, i: int, number: int) -> BumpPlace:
        """Returns where a bump lies in the mesh."""
        state, valve = self._valve_of(i)
        bump = next((bump for bump in bumps_of(valve) if bump.number == number), None)
        if bump is None:
            raise refuse(f"number: is {number!r}; valve {i} has no such bump")
        place = place_of(valve, bump, n_leaflets(state.kind))
        point, *lines = (
            numpy.array(state.origin) + state.scale * (own @ state.matrix.T) for own in (place.point, *place.lines)
        )
        return BumpPlace(point, lines)
