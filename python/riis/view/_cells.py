# SPDX-License-Identifier: Apache-2.0
"""The mesh of the view: its volume cells, the part of it near the valves, and its wall.

The input is arrays of nodes and cells, as a reader of meshes returns them. The output is marked and partly marked cells, edges,
paths and the wall.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy
from numpy.typing import NDArray

from riis._errors import Error, InvalidArgumentError, InvalidMeshError
from riis._riis import Adjacency, Mesh, Surface, mesh_sides

Reals = NDArray[numpy.float64]
Ids = NDArray[numpy.int64]
Bools = NDArray[numpy.bool_]
AnyIds = NDArray[Any]

_TETRA, _VOXEL, _HEXAHEDRON, _WEDGE, _PYRAMID = 10, 11, 12, 13, 14
# VTK's types of volume cells, with the number of nodes and of corners. The corners come first.
_VOLUMES = {
    _TETRA: (4, 4), _VOXEL: (8, 8), _HEXAHEDRON: (8, 8), _WEDGE: (6, 6), _PYRAMID: (5, 5),
    24: (10, 4), 25: (20, 8), 26: (15, 6), 27: (13, 5), 29: (27, 8), 32: (18, 6), 33: (24, 8),
}
VOLUME_TYPES = tuple(_VOLUMES)
_KIND_OF_SIZE = {4: _TETRA, 5: _PYRAMID, 6: _WEDGE, 8: _HEXAHEDRON}
_SURFACES = {5: "triangles", 6: "triangle strips", 7: "polygons", 8: "pixels", 9: "quads", 22: "triangles", 23: "quads"}
# The faces of a cell by its number of corners. A face of three nodes contains its last node twice.
_FACES = {
    4: ((0, 1, 3, 3), (1, 2, 3, 3), (2, 0, 3, 3), (0, 2, 1, 1)),
    5: ((0, 3, 2, 1), (0, 1, 4, 4), (1, 2, 4, 4), (2, 3, 4, 4), (3, 0, 4, 4)),
    6: ((0, 1, 2, 2), (3, 5, 4, 4), (0, 3, 4, 1), (1, 4, 5, 2), (2, 5, 3, 0)),
    8: ((0, 4, 7, 3), (1, 2, 6, 5), (0, 1, 5, 4), (3, 7, 6, 2), (0, 3, 2, 1), (4, 5, 6, 7)),
}
_MARGIN = 0.4  # how far the region extends beyond the valves, as a share of their size
_EDGES = {
    4: ((0, 1), (1, 2), (2, 0), (0, 3), (1, 3), (2, 3)),
    5: ((0, 1), (1, 2), (2, 3), (3, 0), (0, 4), (1, 4), (2, 4), (3, 4)),
    6: ((0, 1), (1, 2), (2, 0), (3, 4), (4, 5), (5, 3), (0, 3), (1, 4), (2, 5)),
    8: ((0, 1), (1, 2), (2, 3), (3, 0), (4, 5), (5, 6), (6, 7), (7, 4), (0, 4), (1, 5), (2, 6), (3, 7)),
}
_CHUNK = 2_000_000  # rows that one step gathers, so that a large mesh needs little memory in addition to its arrays


@dataclass(frozen=True)
class Block:
    """Cells with the same number of nodes."""

    nodes: AnyIds  #: (n, n_nodes of a cell)
    ids: AnyIds | None  #: (n,), the caller's numbers of the cells; None: from 0
    n_corners: int

    def numbers(self, rows: AnyIds) -> Ids:
        return numpy.asarray(rows if self.ids is None else self.ids[rows], numpy.int64)


def _array_of_ids(value: Any, name: str) -> AnyIds:
    array = numpy.asarray(value)
    if array.dtype.kind not in "iu":
        raise InvalidArgumentError(f"{name}: has the type {array.dtype}; it must have a type of integers")
    return array


def _refuse_no_volume(n_cells: int, words: str) -> InvalidMeshError:
    return InvalidMeshError(
        f"cells: none of the {n_cells} is a volume cell, they are {words}; the marks need a mesh of tetrahedra, pyramids, prisms "
        "or hexahedra, and a surface can be a valve"
    )


def blocks_of(cells: Any, n_nodes: int, offsets: Any = None, types: Any = None) -> list[Block]:
    """Returns the volume cells. Other cells, such as the triangles of a boundary, are left out."""
    nodes = _array_of_ids(cells, "cells")
    kinds = None if types is None else _array_of_ids(types, "types").ravel()
    if offsets is None and nodes.ndim == 2:
        n_cells, size = nodes.shape
        if kinds is None:
            if size == 3 or (size < 3 and n_cells > 0):
                raise _refuse_no_volume(n_cells, "triangles" if size == 3 else f"cells of {size} nodes")
            if size not in _KIND_OF_SIZE:
                raise InvalidMeshError(f"cells: have {size} nodes each; there must be 4, 5, 6 or 8, or types")
            return _checked([Block(nodes, None, size)], n_nodes)
        if len(kinds) != n_cells:
            raise InvalidArgumentError(f"types: has {len(kinds)} entries for {n_cells} cells")
        starts = numpy.arange(n_cells + 1, dtype=numpy.int64) * size
        nodes = nodes.ravel()
    else:
        if offsets is None:
            raise InvalidArgumentError(f"cells: has the shape {nodes.shape}; without offsets it must be (n, 4, 5, 6 or 8)")
        starts = _array_of_ids(offsets, "offsets").ravel()
        nodes = nodes.ravel()
        n_cells = len(starts) - 1
        if n_cells < 0 or starts[0] != 0 or starts[-1] != len(nodes) or (numpy.diff(starts) < 0).any():
            raise InvalidArgumentError(
                f"offsets: must ascend from 0 to {len(nodes)}, the length of cells; they go from "
                f"{starts[0] if len(starts) else 'nothing'} to {starts[-1] if len(starts) else 'nothing'}"
            )
        if kinds is not None and len(kinds) != n_cells:
            raise InvalidArgumentError(f"types: has {len(kinds)} entries for {n_cells} cells")
    sizes = numpy.diff(starts)
    if kinds is None:
        kinds = numpy.zeros(n_cells, numpy.int64)
        for size, kind in _KIND_OF_SIZE.items():
            kinds[sizes == size] = kind
    made = []
    for kind in numpy.unique(kinds):
        if int(kind) not in _VOLUMES:
            continue
        size, n_corners = _VOLUMES[int(kind)]
        ids = numpy.flatnonzero(kinds == kind)
        wrong = ids[sizes[ids] != size]
        if len(wrong):
            raise InvalidMeshError(f"cells: cell {wrong[0]} of type {kind} has {sizes[wrong[0]]} nodes; it must have {size}")
        first = starts[ids]
        whole = len(ids) == n_cells and len(nodes) == n_cells * size
        table = nodes.reshape(n_cells, size) if whole else nodes[first[:, None] + numpy.arange(size)]
        if kind == _VOXEL:
            table = table[:, [0, 1, 3, 2, 4, 5, 7, 6]]
        made.append(Block(table, None if whole else ids, n_corners))
    if not made and n_cells > 0:
        words = sorted({_SURFACES.get(int(kind), f"cells of type {kind}") for kind in numpy.unique(kinds) if kind != 0})
        if types is None:
            words = [f"cells of {size} nodes" if size != 3 else "triangles" for size in numpy.unique(sizes)]
        raise _refuse_no_volume(n_cells, " and ".join(words))
    return _checked(made, n_nodes)


def _checked(blocks: list[Block], n_nodes: int) -> list[Block]:
    for block in blocks:
        if block.nodes.size == 0:
            continue
        if block.nodes.min() < 0 or block.nodes.max() >= n_nodes:
            row = int(numpy.flatnonzero(((block.nodes < 0) | (block.nodes >= n_nodes)).any(axis=1))[0])
            number = int(block.numbers(numpy.array([row]))[0])
            raise InvalidMeshError(f"cells: cell {number} has the nodes {block.nodes[row].tolist()}; the mesh has {n_nodes}")
    return blocks


def _order_of(numbers: AnyIds) -> AnyIds:
    """Returns the stable order of numbers from 0 to 2**32 - 1. numpy sorts 16 bits by counting, so two such sorts are faster."""
    order = numpy.argsort((numbers & 0xFFFF).astype(numpy.uint16), kind="stable")
    high = (numbers >> 16).astype(numpy.uint16)[order]
    return numpy.asarray(order[numpy.argsort(high, kind="stable")])


def _alone(quads: Ids) -> Ids:
    """Returns the rows of the faces that belong to only one cell. A face of three nodes has its last node twice."""
    key = numpy.sort(quads, axis=1)
    is_triangle = quads[:, 2] == quads[:, 3]
    # The three smallest nodes identify a face. For a triangle the three smallest nodes are its nodes, each once.
    second = numpy.where(is_triangle & (key[:, 0] == key[:, 1]), key[:, 2], key[:, 1])
    third = numpy.where(is_triangle, key[:, 3], key[:, 2])
    order = numpy.lexsort((third, second, key[:, 0]))
    low, mid, high = key[order, 0], second[order], third[order]
    same = (low[1:] == low[:-1]) & (mid[1:] == mid[:-1]) & (high[1:] == high[:-1])
    alone = numpy.ones(len(order), numpy.bool_)
    alone[1:] &= ~same
    alone[:-1] &= ~same
    return numpy.asarray(order[alone])


class _Incidence:
    """For each node of a block, the rows of the cells with this node."""

    def __init__(self, nodes: AnyIds, n_nodes: int) -> None:
        flat = nodes.ravel()
        order = _order_of(flat)
        self.row = (order // nodes.shape[1]).astype(numpy.int32 if len(nodes) < 2**31 else numpy.int64)
        self.start = numpy.zeros(n_nodes + 1, numpy.int64)
        numpy.cumsum(numpy.bincount(flat, minlength=n_nodes), out=self.start[1:])

    def rows_at(self, nodes: AnyIds) -> AnyIds:
        """Returns the rows of the cells at all given nodes. A row occurs as often as it contains one of the given nodes."""
        first = self.start[nodes]
        count = self.start[nodes + 1] - first
        total = int(count.sum())
        before = numpy.cumsum(count) - count
        return numpy.asarray(self.row[numpy.repeat(first - before, count) + numpy.arange(total)])


def _links(n_corners: int, n_nodes: int) -> list[tuple[int, int]]:
    """Returns the pairs of a cell's nodes that are neighbours, by the program's rules.

    The edges of a cell of second order have two halves, and the middles of a face's edges form a ring.
    """
    edges = _EDGES[n_corners]
    if n_nodes == n_corners:
        return list(edges)
    middle = {frozenset(edge): n_corners + k for k, edge in enumerate(edges)}
    made = [(end, n_corners + k) for k, edge in enumerate(edges) for end in edge]
    for face in _FACES[n_corners]:
        ring = list(dict.fromkeys(face))
        middles = [middle[frozenset((ring[k], ring[k - 1]))] for k in range(len(ring))]
        made += [(middles[k], middles[k - 1]) for k in range(len(middles))]
    return made


class Rows(NamedTuple):
    """The neighbours of the nodes, as compressed sparse rows."""

    offsets: Ids
    columns: AnyIds


def _rows_of(blocks: list[Block], n_nodes: int) -> Rows:
    """Makes the rows from the edges of all cells."""
    pairs = [numpy.empty(0, numpy.int64)]
    for block in blocks:
        for a, b in _links(block.n_corners, block.nodes.shape[1]):
            first, second = block.nodes[:, a].astype(numpy.int64), block.nodes[:, b].astype(numpy.int64)
            pairs += [numpy.unique(first * n_nodes + second), numpy.unique(second * n_nodes + first)]
    both = numpy.unique(numpy.concatenate(pairs))
    both = both[both // n_nodes != both % n_nodes]
    offsets = numpy.zeros(n_nodes + 1, numpy.int64)
    numpy.cumsum(numpy.bincount(both // n_nodes, minlength=n_nodes), out=offsets[1:])
    return Rows(offsets, both % n_nodes)


class Region:
    """The nodes and cells with which the view works: the whole mesh, or the part near the valves.

    Nodes have local numbers. ``node_ids`` contains the caller's numbers, or is None if they are the same.
    """

    def __init__(
        self, points: Reals, blocks: list[Block], node_ids: Ids | None, cut: Bools | None, box: tuple[Reals, Reals] | None
    ) -> None:
        self.points = points
        self.blocks = blocks
        self.node_ids = node_ids
        self.box = box  # None: the whole mesh
        self.mesh = Mesh(points)
        self._cut = cut  # nodes on the cut, whose faces are not part of the wall
        self._incidence: list[_Incidence] | None = None
        self._rows: Rows | None = None
        self._wall: Surface | None = None
        self._knows_wall = False

    def ids_of(self, nodes: AnyIds) -> Ids:
        """Returns the caller's numbers of local nodes."""
        return numpy.asarray(nodes if self.node_ids is None else self.node_ids[nodes], numpy.int64)

    def holds(self, lower: Reals, upper: Reals) -> bool:
        return self.box is None or bool((lower >= self.box[0]).all() and (upper <= self.box[1]).all())

    @property
    def has_cells(self) -> bool:
        return any(len(block.nodes) for block in self.blocks)

    def prepare(self) -> list[_Incidence]:
        """Makes the lists of cells at nodes, once."""
        if self._incidence is None:
            self._incidence = [_Incidence(block.nodes, len(self.points)) for block in self.blocks]
        return self._incidence

    def cells_of(self, marked: AnyIds) -> tuple[Ids, Ids]:
        """Returns the cells with only marked nodes, and the cells with some marked nodes, both ascending."""
        whole, partly = [numpy.empty(0, numpy.int64)], [numpy.empty(0, numpy.int64)]
        for block, incidence in zip(self.blocks, self.prepare(), strict=True):
            rows = incidence.rows_at(marked)
            count = numpy.bincount(rows, minlength=1)
            touched = numpy.flatnonzero(count)
            is_whole = count[touched] == block.nodes.shape[1]
            whole.append(block.numbers(touched[is_whole]))
            partly.append(block.numbers(touched[~is_whole]))
        return numpy.sort(numpy.concatenate(whole)), numpy.sort(numpy.concatenate(partly))

    @property
    def has_edges(self) -> bool:
        """Whether there are volume cells, and whether the edges of all of them are known."""
        n_known = [(block.n_corners, block.n_corners + len(_EDGES[block.n_corners])) for block in self.blocks]
        return self.has_cells and all(block.nodes.shape[1] in n for block, n in zip(self.blocks, n_known, strict=True))

    def adjacency(self) -> Rows:
        """Returns the neighbours of the nodes, and gives them to the mesh."""
        if self._rows is None:
            n_nodes = len(self.points)
            if all(block.nodes.shape[1] == block.n_corners for block in self.blocks):
                tables = [block.nodes if block.nodes.dtype in (numpy.int32, numpy.int64) else block.nodes.astype(numpy.int64)
                          for block in self.blocks]
                if len(tables) == 1:
                    made = Adjacency.from_cells(numpy.ascontiguousarray(tables[0]), n_nodes)
                else:
                    sizes = numpy.concatenate([numpy.full(len(table), table.shape[1], numpy.int64) for table in tables])
                    offsets = numpy.concatenate([numpy.zeros(1, numpy.int64), numpy.cumsum(sizes)])
                    flat = numpy.concatenate([table.ravel().astype(numpy.int64) for table in tables])
                    made = Adjacency.from_cells(flat, n_nodes, offsets=offsets)
                self.mesh.set_adjacency(made)
                self._rows = Rows(made.offsets, made.columns)
            else:
                self._rows = _rows_of(self.blocks, n_nodes)
                self.mesh.set_adjacency(offsets=self._rows.offsets, columns=self._rows.columns)
        return self._rows

    def path(self, start: int, end: int, is_open: Bools) -> Ids:
        """Returns the nodes of a shortest path along edges through open nodes; empty if there is no path."""
        rows = self.adjacency()
        offsets, columns = rows.offsets, rows.columns
        before = numpy.full(len(self.points), -1, numpy.int64)
        before[start] = start
        front = numpy.array([start], numpy.int64)
        while len(front) and before[end] < 0:
            first = offsets[front]
            count = offsets[front + 1] - first
            at = numpy.repeat(first - (numpy.cumsum(count) - count), count) + numpy.arange(int(count.sum()))
            reached, origin = columns[at].astype(numpy.int64), numpy.repeat(front, count)
            fresh = is_open[reached] & (before[reached] < 0)
            reached, origin = reached[fresh], origin[fresh]
            reached, position = numpy.unique(reached, return_index=True)
            before[reached] = origin[position]
            front = reached
        if before[end] < 0:
            return numpy.empty(0, numpy.int64)
        path = [end]
        while path[-1] != start:
            path.append(int(before[path[-1]]))
        return numpy.array(path[::-1], numpy.int64)

    def wall(self) -> Surface | None:
        """Returns the boundary of the volume cells, with normals outwards. None if there is no boundary nearby."""
        if not self._knows_wall:
            self._knows_wall = True
            self._wall = self._made_wall()
        return self._wall

    def _may_be_wall(self) -> Bools:
        """Returns the nodes that may lie on the boundary. All other nodes certainly lie inside.

        The tetrahedra around an inner node cover a sphere about it. By Euler's formula, their number is 2 n - 4 if the node has n
        neighbours. Around a boundary node, they cover only a part of the sphere, with fewer triangles.
        """
        made = numpy.ones(len(self.points), numpy.bool_)
        if len(self.blocks) == 1 and self.blocks[0].nodes.shape[1] == 4:
            n_cells = numpy.diff(self.prepare()[0].start)
            made[n_cells == 2 * numpy.diff(self.adjacency().offsets) - 4] = False
        return made

    def _made_wall(self) -> Surface | None:
        faces, cells = [], []
        may_be_wall = self._may_be_wall()
        for block in self.blocks:
            for face in _FACES[block.n_corners]:
                a, b, c = (may_be_wall[block.nodes[:, corner]] for corner in face[:3])
                row = numpy.flatnonzero(a & b & c)
                corners = block.nodes[row]
                faces.append(corners[:, face].astype(numpy.int64))
                cells.append(self.points[corners[:, : block.n_corners]].mean(axis=1))
        if not faces:
            return None
        quads, middle = numpy.concatenate(faces), numpy.concatenate(cells)
        kept = _alone(quads)
        quads, middle = quads[kept], middle[kept]
        if self._cut is not None:
            is_wall = ~self._cut[quads].all(axis=1)
            quads, middle = quads[is_wall], middle[is_wall]
        if len(quads) == 0:
            return None
        halves = numpy.concatenate([quads[:, :3], quads[:, [0, 2, 3]][quads[:, 2] != quads[:, 3]]])
        inner = numpy.concatenate([middle, middle[quads[:, 2] != quads[:, 3]]])
        a, b, c = (self.points[halves[:, k]] for k in range(3))
        outwards = numpy.einsum("ij,ij->i", numpy.cross(b - a, c - a), a - inner)
        halves[outwards < 0.0] = halves[outwards < 0.0][:, ::-1]
        used, faces_of_wall = numpy.unique(halves.ravel(), return_inverse=True)
        size = float(numpy.ptp(self.points[used], axis=0).max())
        try:
            return Surface.from_arrays(
                numpy.ascontiguousarray(self.points[used]), faces_of_wall.reshape(-1, 3).astype(numpy.int64),
                half_thickness=1e-3 * size, zero_area="skip",
            )
        except Error:  # no face has an area, so the cells have no volume
            return None


class WholeMesh:
    """The caller's mesh, and the region of it in which the view works. Without points there is no mesh, and nothing is marked."""

    lower: Reals
    upper: Reals
    sides: tuple[float, float, float]

    def __init__(self, points: Any, cells: Any = None, *, offsets: Any = None, types: Any = None, near: bool = False) -> None:
        self.is_missing = points is None
        array = numpy.empty((0, 3)) if points is None else numpy.asarray(points)
        if array.ndim != 2 or array.shape[1] != 3:
            raise InvalidArgumentError(f"points: has the shape {array.shape}; it must be (n, 3)")
        if len(array) == 0 and not self.is_missing:
            raise InvalidMeshError("points: there are none; the mesh must have a node")
        if array.dtype.kind not in "fiu":
            raise InvalidArgumentError(f"points: has the type {array.dtype}; it must have a type of numbers")
        self.points: Reals = numpy.ascontiguousarray(array, numpy.float64)
        Mesh(self.points).close()  # refuses coordinates that are not finite, and names the first
        if cells is None and (offsets is not None or types is not None):
            raise InvalidArgumentError("cells: is None, but offsets or types are given")
        self.blocks = [] if cells is None else blocks_of(cells, len(self.points), offsets, types)
        self.is_near = near
        if not self.is_missing:
            self.lower, self.upper = self.points.min(axis=0), self.points.max(axis=0)
            self.sides = mesh_sides(self.points)
        self._region: Region | None = None

    def region(self, lower: Reals, upper: Reals) -> Region:
        """Returns a region that holds a box: the whole mesh, or the cells near the box."""
        if self._region is None or not self._region.holds(lower, upper):
            self._region = self._cut_out(lower, upper) if self.is_near else Region(self.points, self.blocks, None, None, None)
        return self._region

    def _cut_out(self, lower: Reals, upper: Reals) -> Region:
        margin = _MARGIN * float((upper - lower).max())
        low, high = lower - margin, upper + margin
        inside: Bools = numpy.asarray(((self.points >= low) & (self.points <= high)).all(axis=1), numpy.bool_)
        chosen, cut = inside.copy(), numpy.zeros(len(inside), numpy.bool_)
        rows_of = []
        for block in self.blocks:
            near = numpy.concatenate(
                [numpy.zeros(0, bool)]
                + [inside[block.nodes[k : k + _CHUNK]].any(axis=1) for k in range(0, len(block.nodes), _CHUNK)]
            )
            rows = numpy.flatnonzero(near)
            chosen[block.nodes[rows].ravel()] = True
            rows_of.append((near, rows))
        for block, (near, _) in zip(self.blocks, rows_of, strict=True):
            for k in range(0, len(block.nodes), _CHUNK):
                cut[block.nodes[k : k + _CHUNK][~near[k : k + _CHUNK]].ravel()] = True
        node_ids = numpy.flatnonzero(chosen)
        local = numpy.full(len(chosen), -1, numpy.int64)
        local[node_ids] = numpy.arange(len(node_ids))
        blocks = [
            Block(local[block.nodes[rows]], block.numbers(rows), block.n_corners)
            for block, (_, rows) in zip(self.blocks, rows_of, strict=True)
            if len(rows)
        ]
        return Region(numpy.ascontiguousarray(self.points[node_ids]), blocks, node_ids, cut[node_ids], (low, high))
