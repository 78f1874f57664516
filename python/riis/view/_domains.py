# SPDX-License-Identifier: Apache-2.0
"""Domains of a mesh, such as the fluid and the wall: cells by their values in a cell array, and the groups of gmsh.

The program chooses the same cells by --cells-where (riis_vtk_mesh_choose_cells).
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy

from riis.view._valves import refuse

GROUPS = "gmsh:physical"  # the first group of a cell; gmsh:physical_2 and so on are the further ones
OPTION = "--cells-where"
NODE_IDS, CELL_IDS = "riis_node_id", "riis_cell_id"
_MOST_LISTED = 10


def chosen_cells(grid: Any, where: str, names: Mapping[str, float]) -> Any:
    """Returns the cells with certain values in a cell array, and their nodes, as pyvista.UnstructuredGrid.

    Nodes and cells keep their order. The arrays riis_node_id and riis_cell_id contain their numbers in the whole mesh.

    where  NAME=VALUES, such as "region=1,2"
    names  the numbers of gmsh's groups of volumes by name
    """
    name, _, text = where.rpartition("=")
    values = text.split(",")
    if not name or "" in values:
        raise refuse(f'{OPTION} is "{where}"; it must be NAME=VALUES, such as region=1,2')
    arrays = _arrays_of(grid, name)
    wanted = [_number_of(value, names if name == GROUPS else {}) for value in values]
    is_chosen = numpy.any([numpy.isin(array, wanted) for array in arrays], axis=0)
    is_volume = numpy.array([_dimension_of(kind) == 3 for kind in range(256)])[grid.celltypes]
    if not is_volume.any():
        is_volume[:] = True
    if not (is_chosen & is_volume).any():
        kept = numpy.concatenate([arrays[0][is_volume], *(array[is_volume & (array != 0)] for array in arrays[1:])])
        raise refuse(f"{OPTION}: no volume cell has such a value of {name}; they have {_listed(numpy.unique(kept))}")
    part = grid.extract_cells(numpy.flatnonzero(is_chosen))
    for data, kept_name, given in (
        (part.point_data, NODE_IDS, "vtkOriginalPointIds"), (part.cell_data, CELL_IDS, "vtkOriginalCellIds"),
    ):  # fmt: skip
        data[kept_name] = numpy.asarray(data[given], numpy.int64)
        del data[given]
    return part


def _dimension_of(kind: int) -> int:
    from vtkmodules.vtkCommonDataModel import vtkGenericCell

    cell = vtkGenericCell.InstantiateCell(kind)
    return -1 if cell is None else int(cell.GetCellDimension())


def _arrays_of(grid: Any, name: str) -> list[Any]:
    arrays = []
    while (array := grid.cell_data.get(name if not arrays else f"{name}_{len(arrays) + 1}")) is not None:
        if array.ndim != 1 or array.dtype.kind not in "iufb":
            break
        arrays.append(numpy.asarray(array))
        if name != GROUPS:
            break
    if not arrays:
        found = ", ".join(grid.cell_data.keys())
        there = f"there are: {found}" if found else "there is none"
        raise refuse(f"{OPTION}: the mesh has no cell array {name} of single numbers; {there}")
    return arrays


def _number_of(value: str, names: Mapping[str, float]) -> float:
    if value in names:
        return float(names[value])
    try:
        return float(value)
    except ValueError:
        raise refuse(f"{OPTION}: {value} is not a number" + (", nor the name of a physical group" if names else "")) from None


def _listed(values: Any) -> str:
    return ", ".join(f"{value:g}" for value in values[:_MOST_LISTED]) + (", ..." if len(values) > _MOST_LISTED else "")


# ---- Groups of gmsh ----


def groups_of_volumes(mesh: Any) -> dict[str, float]:
    """Returns the numbers of the groups of volumes of a meshio.Mesh by name."""
    return {name: int(pair[0]) for name, pair in mesh.field_data.items() if len(pair) == 2 and int(pair[1]) == 3}


def read_once(mesh: Any) -> Any:
    """Leaves out the repeated cells of a meshio.Mesh, and gives cells of several groups the arrays of further groups.

    gmsh's version 2 repeats a cell for each of its further groups. For version 4.1, meshio keeps further groups by name only.
    """
    numbers = numpy.concatenate(mesh.cell_data.get(GROUPS, [[]]))
    if len(numbers) == 0 or (len(numpy.unique(numbers)) < 2 and len(groups_of_volumes(mesh)) < 2):
        return mesh  # no cell has two groups
    starts = numpy.cumsum([0] + [len(block.data) for block in mesh.cells])
    original = _originals_of(mesh.cells, starts)
    cells = numpy.flatnonzero(original != numpy.arange(len(original)))
    groups = [(original[cells], numbers[cells])]
    for name, number in groups_of_volumes(mesh).items():
        for k, part in enumerate(mesh.cell_sets.get(name, ())):
            if part is not None and len(part):
                cells = starts[k] + numpy.asarray(part, numpy.int64)
                groups.append((cells, numpy.full(len(cells), number)))
    for k, array in enumerate(_further_groups(numbers, groups)):
        mesh.cell_data[f"{GROUPS}_{k + 2}"] = numpy.split(array, starts[1:-1])
    is_first = numpy.split(original == numpy.arange(len(original)), starts[1:-1])
    for k, block in enumerate(mesh.cells):
        block.data = block.data[is_first[k]]
        for values in mesh.cell_data.values():
            values[k] = values[k][is_first[k]]
    mesh.cell_sets = {}  # they have the numbers of the repeated cells
    return mesh


def _originals_of(blocks: Any, starts: Any) -> Any:
    """Returns for each cell of all blocks the first cell of its type with its nodes."""
    original = numpy.arange(starts[-1])
    for kind in {block.type for block in blocks}:
        members = [k for k, block in enumerate(blocks) if block.type == kind]
        ids = numpy.concatenate([numpy.arange(starts[k], starts[k + 1]) for k in members])
        rows = numpy.sort(numpy.concatenate([blocks[k].data for k in members]), axis=1)
        _, first, row = numpy.unique(rows, axis=0, return_index=True, return_inverse=True)
        original[ids] = ids[first[row.ravel()]]
    return original


def _further_groups(numbers: Any, groups: Any) -> list[Any]:
    """Returns arrays with the groups of each cell after its first one. 0: none."""
    cell = numpy.concatenate([cells for cells, _ in groups])
    number = numpy.concatenate([values for _, values in groups])
    pairs = numpy.unique(numpy.column_stack([cell, number])[number != numbers[cell]], axis=0)
    place = numpy.arange(len(pairs)) - numpy.searchsorted(pairs[:, 0], pairs[:, 0])
    arrays = []
    for k in range(place.max(initial=-1) + 1):
        array = numpy.zeros(len(numbers), numpy.int64)
        array[pairs[place == k, 0]] = pairs[place == k, 1]
        arrays.append(array)
    return arrays
