# SPDX-License-Identifier: Apache-2.0
"""The files of riis view: meshes in, marked meshes out."""

from __future__ import annotations

import os
import re
import shlex
import warnings
from typing import Any

import numpy

from riis import FAR_DISTANCE, Error
from riis.view._cells import VOLUME_TYPES
from riis.view._domains import chosen_cells, groups_of_volumes, read_once
from riis.view._walls import Wall

BY_VTK, BY_MESHIO = (".vtu", ".pvtu", ".vtk"), (".msh", ".xdmf", ".xmf")
WALLS = (".stl", ".vtp", ".obj", ".ply")
SURFACES = (".stl", ".vtp", ".obj", ".ply", ".off")
BY_PROGRAM = (".vti", ".vtr", ".vts", ".vtm", ".e", ".exo", ".ex2", ".exii", ".foam")  # and folders of OpenFOAM


class Refusal(Exception):
    """Bad input, with a message for the page."""


def read_mesh(path: str, progress: dict[str, float] | None = None, *, cells_where: str | None = None) -> Any:
    """Returns a mesh of volume cells as pyvista.UnstructuredGrid. progress["part"] grows from 0 to 1.

    Nodes and cells keep the file's order, and points keep its precision. The program riis therefore finds the same marks.
    cells_where chooses cells, as the program's option --cells-where: "region=1,2".
    """
    import pyvista

    ending = os.path.splitext(path)[1].lower()
    if not os.path.exists(path):
        raise Refusal(f"{path}: there is no such file")
    if ending in SURFACES:
        raise Refusal(
            f"{path}: is a surface, and MESH has volume cells. Give it as the wall: riis view --wall {shlex.quote(path)}. Or "
            "gmsh or your mesher fills a closed surface with cells; docs/patient.md has the commands"
        )
    if os.path.isdir(path) or ending not in BY_VTK + BY_MESHIO:
        text = f"{path}: riis view reads {', '.join(BY_VTK + BY_MESHIO)}"
        if os.path.isdir(path) or ending in BY_PROGRAM:
            text += f". The program writes what the view reads: riis mark {shlex.quote(path)} --output mesh.vtu --allow-none"
        raise Refusal(text)
    names: dict[str, float] = {}
    if ending in BY_MESHIO:
        grid, names = _by_meshio(path)
    else:
        grid = _by_vtk(path, "mesh", progress)
        if isinstance(grid, pyvista.PolyData):
            raise Refusal(f"{path}: is a surface; riis view needs a mesh of volume cells")
    if not isinstance(grid, pyvista.UnstructuredGrid):
        raise Refusal(f"{path}: holds {type(grid).__name__}, not an unstructured grid")
    if grid.n_points == 0:
        raise Refusal(f"{path}: has no nodes, or is not a mesh")
    return grid if cells_where is None else chosen_cells(grid, cells_where, names)


def _refuse_cut_off_ply(path: str) -> None:
    """Refuses a .ply file that has fewer bytes than its header announces, because VTK crashes on such a file."""
    n_bytes = {"char": 1, "uchar": 1, "short": 2, "ushort": 2, "int": 4, "uint": 4, "float": 4, "double": 8}
    least, count, is_ascii = 0, 0, False
    with open(path, "rb") as file:
        for line in file:
            words = line.decode("ascii", "replace").split()
            if words[:1] == ["format"]:
                is_ascii = words[1:2] == ["ascii"]
            elif words[:1] == ["element"]:
                count = int(number_of("".join(words[2:]), f"{path}: {' '.join(words)}"))
            elif words[:1] == ["property"]:
                try:
                    sizes = [n_bytes.get(word) or numpy.dtype(word).itemsize for word in words[-2:0:-1] if word != "list"]
                except TypeError:
                    raise Refusal(f"{path}: '{' '.join(words)}' has no type of .ply files") from None
                if is_ascii:  # a number has a digit, and something that separates it from the next
                    sizes = [2] * len(sizes)
                n_corners = 3 if words[-1] in ("vertex_indices", "vertex_index") else 0  # other lists may be empty
                least += count * (n_corners * sizes[0] + sizes[1] if len(sizes) == 2 else sum(sizes))
            elif words == ["end_header"]:
                break
        else:
            raise Refusal(f"{path}: is not a .ply file, or is cut off: it lacks the line end_header")
        left = os.path.getsize(path) - file.tell()
    if left + 1 < least:
        raise Refusal(f"{path}: is cut off: its header announces at least {least} bytes, and {left} follow")


def _by_vtk(path: str, kind: str, progress: dict[str, float] | None = None) -> Any:
    """Returns the data of a file. Refuses a file that VTK calls damaged, a "mesh" or a "surface"."""
    import pyvista

    if path.lower().endswith(".ply"):
        _refuse_cut_off_ply(path)
    said: list[str] = []
    part = {} if progress is None else progress
    reader = pyvista.get_reader(path)
    low = reader.reader
    low.AddObserver("ProgressEvent", lambda source, _: part.update(part=float(source.GetProgress())))

    def hear(_: Any, __: str, text: str = "") -> None:
        said.append(text)

    hear.CallDataType = "string0"  # type: ignore[attr-defined]
    low.AddObserver("ErrorEvent", hear)
    data = None
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", UserWarning)  # PyVista repeats VTK's errors, and the refusal has them
            data = reader.read()
    except Exception as error:  # PyVista raises many kinds of exceptions for files that it cannot parse
        said.append(str(error))
    if said or low.GetErrorCode() != 0:
        # Later errors follow from the first one. Those of a pipeline say nothing about the file.
        first = next((text for text in said if "Pipeline" not in text), "")
        lines = [re.sub(r" ?\(0x[0-9a-f]+\):?", "", line).strip() for line in first.splitlines() if line.strip()]
        raise Refusal(f"{path}: is not a {kind} that VTK can read" + (f" ({lines[-1]})" if lines else ""))
    return data


def _by_meshio(path: str) -> tuple[Any, dict[str, float]]:
    """Returns the grid, and the numbers of gmsh's groups of volumes by name."""
    import pyvista

    try:
        import meshio
    except ImportError:
        raise Refusal(f"{path}: this format needs meshio: pip install meshio") from None
    try:
        mesh = read_once(meshio.read(path))
        return pyvista.from_meshio(mesh), groups_of_volumes(mesh)
    except SystemExit:  # meshio ends the process for some files
        raise Refusal(f"{path}: is not a mesh that meshio can read") from None
    except Exception as error:
        raise Refusal(f"{path}: is not a mesh that meshio can read ({error})") from error


def arrays_of(grid: Any) -> dict[str, Any]:
    """Returns the arrays of a grid by the names of Model's arguments."""
    offsets = grid.cell_offsets if hasattr(grid, "cell_offsets") else grid.offset  # PyVista 0.49 renamed it
    return {
        "points": numpy.ascontiguousarray(grid.points, numpy.float64), "cells": numpy.asarray(grid.cell_connectivity),
        "offsets": numpy.asarray(offsets), "types": numpy.asarray(grid.celltypes),
    }  # fmt: skip


def read_surface(path: str) -> dict[str, Any]:
    """Returns a surface by the names of the arguments of Model.add_surface. A .pvd file gives a surface that moves."""
    import pyvista

    ending = os.path.splitext(path)[1].lower()
    if not os.path.isfile(path):
        raise Refusal(f"{path}: there is no such file")
    if ending not in (".vtp", ".stl", ".pvd"):
        raise Refusal(f"{path}: a surface is a file .vtp, .stl or .pvd")
    try:
        if ending != ".pvd":
            frames, times = [_triangles_of(_by_vtk(path, "surface"), path)], None
        else:
            reader = pyvista.get_reader(path)
            times = numpy.array(reader.time_values, float)
            frames = []
            for value in times:
                reader.set_active_time_value(value)
                frames.append(_triangles_of(reader.read()[0], path))
    except Refusal:
        raise
    except Exception as error:  # PyVista raises many kinds of exceptions for files that it cannot parse
        raise Refusal(f"{path}: is not a surface that VTK can read ({error})") from error
    faces = frames[0].regular_faces if len(frames) else numpy.zeros((0, 3), int)
    if len(faces) == 0:
        raise Refusal(f"{path}: has no triangles")
    if any(frame.n_points != frames[0].n_points or not numpy.array_equal(frame.regular_faces, faces) for frame in frames):
        raise Refusal(f"{path}: its frames differ in their triangles; all must have those of the first")
    points = numpy.array([frame.points for frame in frames], numpy.float64)
    leaflet = frames[0].cell_data.get("riis_leaflet")
    return {
        "vertices": points if times is not None else points[0], "faces": numpy.array(faces, numpy.int64), "times": times,
        "leaflet_id": None if leaflet is None else numpy.array(leaflet, numpy.int32),
    }  # fmt: skip


def read_wall(path: str) -> Wall:
    """Returns the wall of a file: a surface, or the boundary of the volume cells of a mesh, as the program's --wall takes it."""
    if not os.path.isfile(path):
        raise Refusal(f"{path}: there is no such file")
    ending = os.path.splitext(path)[1].lower()
    if ending in BY_VTK + BY_MESHIO:
        from riis.view.scene import boundary_of

        grid = read_mesh(path)
        has_volumes = bool(numpy.isin(grid.celltypes, VOLUME_TYPES).any())
        data = boundary_of(_volumes_of(grid) if has_volumes else grid)
    elif ending in WALLS:
        data = _by_vtk(path, "surface")
    else:
        raise Refusal(f"{path}: a wall is a surface, {', '.join(WALLS)}, or a mesh, {', '.join(BY_VTK + BY_MESHIO)}")
    triangles = _triangles_of(data, path)
    if triangles.n_cells == 0 or triangles.n_points == 0:
        raise Refusal(f"{path}: has no triangles, or is not a surface that VTK can read")
    faces = numpy.asarray(triangles.regular_faces, numpy.int64)
    try:
        return Wall(numpy.array(triangles.points, numpy.float64), faces, path)
    except Error as error:
        raise Refusal(f"{path}: {error}") from error


def read_points(path: str) -> Any:
    """Returns the points of segmented leaflets for riis.fit: a surface, or rows of x, y and z."""
    ending = os.path.splitext(path)[1].lower()
    if not os.path.isfile(path):
        raise Refusal(f"{path}: there is no such file")
    if ending in (".csv", ".txt", ".xyz"):
        points: list[list[float]] = []
        with open(path, encoding="utf-8", errors="replace") as file:
            for number, line in enumerate(file, 1):
                cells = [cell for cell in re.split(r"[,;\s]+", line) if cell]
                if not cells or cells[0].startswith("#") or (not points and cells[:3] == ["x", "y", "z"]):
                    continue
                if len(cells) != 3:
                    raise Refusal(f"{path}: line {number} has {len(cells)} columns; it must have x, y and z")
                points.append([number_of(cell, f"{path}: line {number}") for cell in cells])
        if not points:
            raise Refusal(f"{path}: has no points")
        return numpy.array(points, numpy.float64)
    if ending not in WALLS:
        raise Refusal(f"{path}: points are a surface, {', '.join(WALLS)}, or rows of x, y and z in a .csv, .txt or .xyz")
    import pyvista

    data = _by_vtk(path, "surface")
    if not isinstance(data, pyvista.PolyData) or data.n_points == 0:
        raise Refusal(f"{path}: has no points, or is not a surface that VTK can read")
    return data


def _volumes_of(grid: Any) -> Any:
    """Returns the volume cells. A mesh of gmsh also has the triangles of its boundaries."""
    is_volume = numpy.isin(grid.celltypes, VOLUME_TYPES)
    return grid if is_volume.all() else grid.extract_cells(numpy.flatnonzero(is_volume))


def _triangles_of(data: Any, path: str) -> Any:
    import pyvista

    if not isinstance(data, pyvista.PolyData):
        raise Refusal(f"{path}: holds {type(data).__name__}, not a surface")
    triangles = data.triangulate()
    if triangles.n_cells > 0 and not triangles.is_all_triangles:
        raise Refusal(f"{path}: has faces without corners, so it is cut off or damaged")
    return triangles


def mesh_of_saved(path: str) -> tuple[str | None, str | None]:
    """Returns the path of the mesh of a saved view, and the choice of its cells."""
    from riis.view._sessions import read_session

    if not os.path.isfile(path):
        raise Refusal(f"{path}: there is no such file")
    root, valves = read_session(path)
    if not valves:
        raise Refusal(f"{path}: has no valves")
    return root["mesh"], root["cells_where"]


def number_of(value: Any, name: str) -> float:
    try:
        return float(value)
    except (TypeError, ValueError):
        raise Refusal(f"{name}: '{value}' is not a number") from None


def write_marked(grid: Any, model: Any, path: str) -> None:
    """Writes the mesh with the arrays that the program riis writes: riis_marked, riis_distance and riis_leaflet.

    With several valves, the names begin with the name of a valve instead of riis, as in the program.
    """
    import pyvista

    out = pyvista.UnstructuredGrid()
    out.deep_copy(grid)
    out.points = numpy.asarray(grid.points, numpy.float64)
    prefixes = ["riis"] if len(model.valves) == 1 else [valve.name for valve in model.valves]
    for k, prefix in enumerate(prefixes):
        ids, distance, leaflet = model.marks_of(k)
        n_nodes = grid.n_points
        arrays = {
            "marked": (numpy.zeros(n_nodes, numpy.uint8), 1), "distance": (numpy.full(n_nodes, FAR_DISTANCE), distance),
            "leaflet": (numpy.full(n_nodes, -1, numpy.int32), leaflet),
        }  # fmt: skip
        for name, (array, values) in arrays.items():
            array[ids] = values
            out.point_data[f"{prefix}_{name}"] = array
    out.save(path)
