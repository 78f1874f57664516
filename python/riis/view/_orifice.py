# SPDX-License-Identifier: Apache-2.0
"""The outline of a valve's free orifice, for a drawing: the edge of the area that the leaflets leave uncovered along the axis.

Surface.orifice measures this area exactly. The outline is traced on a grid, so it is off by up to half a grid's step.
"""

from __future__ import annotations

import numpy
from numpy.typing import NDArray

from riis._riis import Surface

Reals = NDArray[numpy.float64]
Bools = NDArray[numpy.bool_]

N_GRID = 256  # cells across the outline
_SPECK = 12  # cells of the smallest orifice that is drawn
_N_DIRECTIONS = 720  # directions in which the outline is known, if it is no disc


def _outline(points: Reals, faces: NDArray[numpy.int64]) -> Reals:
    """Returns the outline of triangles in the plane as edges (n, 2, 2): the boundary's farthest point in each direction.

    The directions are those from the middle of the boundary. Edges of only one triangle are the boundary.
    """
    _, place = numpy.unique(points, axis=0, return_inverse=True)
    sides = numpy.concatenate([faces[:, [0, 1]], faces[:, [1, 2]], faces[:, [2, 0]]])
    _, first, count = numpy.unique(
        numpy.sort(place.reshape(-1)[sides], axis=1), axis=0, return_index=True, return_counts=True
    )
    edges = points[sides[first[count == 1]]][:, :, :2]
    centre = edges.mean(axis=(0, 1))
    a, b = edges[:, 0] - centre, edges[:, 1] - centre
    turns_back = a[:, 0] * b[:, 1] < a[:, 1] * b[:, 0]
    a[turns_back], b[turns_back] = b[turns_back], a[turns_back]
    step = 2.0 * numpy.pi / _N_DIRECTIONS
    low = numpy.arctan2(a[:, 1], a[:, 0])
    turn = numpy.arctan2(b[:, 1], b[:, 0]) - low
    high = low + numpy.where(turn < 0.0, turn + 2.0 * numpy.pi, turn)
    start = numpy.ceil(low / step).astype(numpy.int64)
    n = (numpy.floor(high / step).astype(numpy.int64) - start + 1).clip(0)
    edge = numpy.repeat(numpy.arange(len(a)), n)
    direction = start[edge] + numpy.arange(int(n.sum())) - numpy.repeat(numpy.cumsum(n) - n, n)
    ray = numpy.column_stack([numpy.cos(direction * step), numpy.sin(direction * step)])
    along = (b - a)[edge]
    across = ray[:, 0] * along[:, 1] - ray[:, 1] * along[:, 0]
    with numpy.errstate(divide="ignore", invalid="ignore"):
        distance = (a[edge, 0] * along[:, 1] - a[edge, 1] * along[:, 0]) / across
    far = numpy.zeros(_N_DIRECTIONS)
    seen = numpy.isfinite(distance)
    numpy.maximum.at(far, direction[seen] % _N_DIRECTIONS, distance[seen])
    angle = numpy.flatnonzero(far > 0.0)
    corners = centre + far[angle, None] * numpy.column_stack([numpy.cos(angle * step), numpy.sin(angle * step)])
    return numpy.stack([corners, numpy.roll(corners, -1, axis=0)], axis=1)


def _filled(loops: Reals, x: Reals, y: Reals) -> Bools:
    """Returns which points of the grid lie inside closed lines of edges (n, 2, 2), by the even-odd rule."""
    inside = numpy.zeros((len(x), len(y)), bool)
    for (x0, y0), (x1, y1) in loops:
        if x0 == x1:
            continue
        low, high = (x0, x1) if x0 < x1 else (x1, x0)
        columns = numpy.flatnonzero((x >= low) & (x < high))
        heights = y0 + (x[columns] - x0) * (y1 - y0) / (x1 - x0)
        inside[columns] ^= y[None, :] > heights[:, None]
    return inside


def _covered(corners: Reals, x: Reals, y: Reals) -> Bools:
    """Returns which points of the grid lie in one of the triangles (n, 3, 2)."""
    covered = numpy.zeros((len(x), len(y)), bool)
    step = x[1] - x[0]
    low = numpy.ceil((corners.min(axis=1) - (x[0], y[0])) / step - 1e-9).astype(numpy.int64).clip(0, len(x))
    high = numpy.floor((corners.max(axis=1) - (x[0], y[0])) / step + 1e-9).astype(numpy.int64).clip(-1, len(x) - 1)
    shape = (high - low + 1).clip(0)
    count = shape[:, 0] * shape[:, 1]
    triangle = numpy.repeat(numpy.arange(len(corners)), count)
    within = numpy.arange(int(count.sum())) - numpy.repeat(numpy.cumsum(count) - count, count)
    i = low[triangle, 0] + within // numpy.maximum(shape[triangle, 1], 1)
    j = low[triangle, 1] + within % numpy.maximum(shape[triangle, 1], 1)
    place = numpy.column_stack([x[i], y[j]])
    sides = []
    for k in range(3):
        a, b = corners[triangle, k], corners[triangle, (k + 1) % 3]
        sides.append((b[:, 0] - a[:, 0]) * (place[:, 1] - a[:, 1]) - (b[:, 1] - a[:, 1]) * (place[:, 0] - a[:, 0]))
    signs = numpy.stack(sides)
    hit = (signs >= 0.0).all(axis=0) | (signs <= 0.0).all(axis=0)
    covered[i[hit], j[hit]] = True
    return covered


def _loops(free: Bools) -> list[NDArray[numpy.int64]]:
    """Traces the border of free grid cells. Returns closed lines of corners of cells, with the free cells on the left."""
    padded = numpy.pad(free, 1)
    after: dict[tuple[int, int], list[tuple[int, int]]] = {}
    for di, dj, start, end in ((0, -1, (0, 0), (1, 0)), (1, 0, (1, 0), (1, 1)), (0, 1, (1, 1), (0, 1)), (-1, 0, (0, 1), (0, 0))):
        beside = numpy.roll(padded, (-di, -dj), (0, 1))
        for i, j in numpy.argwhere(padded & ~beside).tolist():
            after.setdefault((i + start[0], j + start[1]), []).append((i + end[0], j + end[1]))
    loops = []
    while after:
        first = next(iter(after))
        line = [first]
        while True:
            ends = after[line[-1]]
            line.append(ends.pop())
            if not ends:
                del after[line[-2]]
            if line[-1] == first and (first not in after or len(line) > 2):
                break
        loops.append(numpy.array(line[:-1], numpy.int64) - 1)
    return loops


def outline_of(surface: Surface, centre: Reals) -> list[Reals]:
    """Returns the closed lines (n, 3) around the free orifice, in mesh units. The list is empty if the orifice is closed or has
    no outline.

    centre  a point on the axis of the valve's disc
    """
    measured = surface.orifice()
    if measured.outline == "none" or measured.outline_area <= 0.0:
        return []
    vertices, faces = surface.vertices, surface.triangles.vertex_id
    axis = measured.axis
    least = numpy.zeros(3)
    least[int(numpy.argmin(numpy.abs(axis)))] = 1.0
    across = numpy.cross(axis, least)
    across /= numpy.linalg.norm(across)
    frame = numpy.column_stack([across, numpy.cross(axis, across), axis])
    seen = (vertices - centre) @ frame
    if measured.radius > 0.0:
        turn = numpy.linspace(0.0, 2.0 * numpy.pi, 361)
        circle = measured.radius * numpy.column_stack([numpy.cos(turn), numpy.sin(turn)])
        edges = numpy.stack([circle[:-1], circle[1:]], axis=1)
    else:
        edges = _outline(seen, faces)
    low, high = edges.min(axis=(0, 1)), edges.max(axis=(0, 1))
    step = float((high - low).max()) / N_GRID
    x = (low[0] + high[0]) / 2 + step * (numpy.arange(N_GRID) - (N_GRID - 1) / 2)
    y = (low[1] + high[1]) / 2 + step * (numpy.arange(N_GRID) - (N_GRID - 1) / 2)
    free = _filled(edges, x, y) & ~_covered(seen[faces][:, :, :2], x, y)
    lines = []
    for loop in _loops(free):
        i, j = loop[:, 0], loop[:, 1]
        if abs(i @ numpy.roll(j, -1) - j @ numpy.roll(i, -1)) < 2 * _SPECK:
            continue  # between triangles that touch
        middles = (loop + numpy.roll(loop, -1, axis=0)) / 2.0
        flat = numpy.column_stack([x[0] + step * (middles[:, 0] - 0.5), y[0] + step * (middles[:, 1] - 0.5)])
        lines.append(_raised(flat, seen) @ frame.T + centre)
    return lines


def _raised(flat: Reals, seen: Reals) -> Reals:
    """Gives each point of an outline the height of the vertex nearest to it, as seen along the axis."""
    height = numpy.empty(len(flat))
    for k in range(0, len(flat), 256):
        part = flat[k : k + 256]
        far = ((part[:, None, :] - seen[None, :, :2]) ** 2).sum(axis=2)
        height[k : k + 256] = seen[numpy.argmin(far, axis=1), 2]
    return numpy.column_stack([flat, height])
