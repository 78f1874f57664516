# SPDX-License-Identifier: Apache-2.0
"""Arrays are read-only, keep their memory alive, and do not change in later calls."""

import gc
import os
import subprocess
import sys
import weakref

import numpy
import pytest

import riis


def views_of(surface, marks, adjacency):
    return {
        "vertices": surface.vertices,
        "uv": surface.uv,
        "vertex_id": surface.triangles.vertex_id,
        "ids": marks.ids,
        "distance": marks.distance,
        "normal": marks.normal,
        "within": marks.within_limit.distance,
        "offsets": adjacency.offsets,
        "columns": adjacency.columns,
    }


def test_views_are_read_only_and_share_memory(surface, mesh):
    marks = riis.mark(surface, mesh, fields="normal")
    adjacency = riis.Adjacency.from_grid(3, 4, 5)
    again = views_of(surface, marks, adjacency)
    for name, view in views_of(surface, marks, adjacency).items():
        assert not view.flags.writeable and not view.flags.owndata, name
        assert view.__array_interface__["data"] == again[name].__array_interface__["data"], name
        with pytest.raises(ValueError, match="read-only"):
            view[...] = 0


def test_views_keep_the_memory(surface, mesh):
    ids = riis.mark(surface, mesh).ids
    part = riis.mark(surface, mesh).distance[10:20]
    vertices = surface.vertices
    expected = ids.copy(), part.copy(), vertices.copy()
    del surface
    gc.collect()
    riis.mark(riis.Surface(riis.Valve("aortic")), mesh)  # the call would reuse the memory if it had been freed
    assert all(numpy.array_equal(a, b) for a, b in zip((ids, part, vertices), expected))


def test_a_mesh_keeps_its_coordinates(xyz):
    nodes = numpy.array(xyz)
    kept = weakref.ref(nodes)
    mesh = riis.Mesh(nodes)
    del nodes
    gc.collect()
    assert kept() is not None
    mesh.close()
    gc.collect()
    assert kept() is None
    nodes = numpy.array(xyz)
    mesh = riis.Mesh(nodes)
    with pytest.raises(ValueError, match="resize"):
        nodes.resize(3, refcheck=True)
    count = sys.getrefcount(nodes)
    del mesh
    assert sys.getrefcount(nodes) == count - 1


def test_views_outlive_the_markings_that_follow(surface, mesh, valve):
    """An array keeps its content after later markings, and these markings are right."""
    marks, kept = riis.Marks(), []
    for opening in 0.0, 0.3, 0.6, 0.9:
        valve["opening"] = opening
        surface.update(valve)
        assert riis.mark(surface, mesh, into=marks, fields="normal", distance_limit=0.2) is marks
        arrays = marks.ids, marks.distance[10:20], marks.normal, marks.within_limit.distance
        expected = riis.mark(surface, mesh, fields="normal", distance_limit=0.2)
        assert numpy.array_equal(marks.ids, expected.ids) and numpy.array_equal(marks.normal, expected.normal)
        kept += [(array, array.copy()) for array in arrays]
    marks.close()
    del marks, expected
    gc.collect()
    riis.mark(riis.Surface(riis.Valve("aortic")), mesh, distance_limit=1.0)  # would reuse the memory if it had been freed
    assert all(numpy.array_equal(array, copy) for array, copy in kept)
    assert len({len(array) for array, _ in kept[::4]}) == 4


def test_a_result_without_views_reuses_its_memory(surface, mesh, marks):
    place = marks.ids.__array_interface__["data"]
    riis.mark(surface, mesh, into=marks)
    assert marks.ids.__array_interface__["data"] == place
    ids = marks.ids
    riis.mark(surface, mesh, into=marks)
    assert marks.ids.__array_interface__["data"] != ids.__array_interface__["data"]


def test_a_refused_marking_leaves_a_result_with_views(surface, mesh, marks):
    ids = marks.ids
    with pytest.raises(riis.InvalidArgumentError):
        riis.mark(surface, mesh, into=marks, distance_limit=0.01)
    assert not marks.closed and numpy.array_equal(marks.ids, ids)
    assert marks.ids.__array_interface__["data"] == ids.__array_interface__["data"]


def test_arrays_of_a_surface_outlive_its_updates(surface, valve):
    kept = []
    for opening in 0.1, 0.5, 0.9:
        before = valve.copy()
        valve["opening"] = opening
        surface.update_moving(valve, before, 0.1)
        fresh = riis.Surface(valve, half_thickness=0.15)
        fresh.update_moving(valve, before, 0.1)
        for name in "vertices", "uv", "velocities":
            assert numpy.array_equal(getattr(surface, name), getattr(fresh, name))
            kept.append((getattr(surface, name), getattr(fresh, name).copy()))
        kept += [(array, array.copy()) for array in surface.triangles]
    surface.close()
    gc.collect()
    riis.Surface(riis.Valve("aortic"))
    assert all(numpy.array_equal(array, copy) for array, copy in kept)


def test_a_refused_update_leaves_the_arrays(surface, valve):
    vertices = surface.vertices
    with pytest.raises(riis.InvalidArgumentError):
        surface.update(valve, half_thickness=-2.0)
    assert numpy.array_equal(surface.vertices, vertices)


def test_pairs_and_edges_outlive_the_next_search(surface, grid):
    marks = riis.mark(surface, grid)
    kept = []
    for half_thickness in 0.02, 0.01:
        surface.update(riis.Valve("trileaflet", bending_height=0.55, opening=0.0), half_thickness=half_thickness)
        riis.mark(surface, grid, into=marks)
        leaks, crossings = riis.find_leaks(surface, grid, marks), riis.find_crossings(surface)
        assert leaks.n_edges == len(leaks.length) > 100 and crossings.n_pairs == len(crossings.depth) > 0
        kept += [(array, array.copy()) for array in (leaks.node_id, leaks.length, leaks.distance, crossings.triangle_id,
                                                     crossings.point, crossings.depth, crossings.length)]
    marks.close()
    surface.close()
    assert all(numpy.array_equal(array, copy) for array, copy in kept) and len(kept[0][0]) != len(kept[7][0])


def test_an_adjacency_that_is_borrowed_stays(surface, grid):
    expected = riis.mark(surface, grid, search="neighbor").ids
    adjacency = riis.Adjacency.from_grid(41, 41, 41)
    columns, copy = adjacency.columns, adjacency.columns.copy()
    grid.set_adjacency(adjacency)
    adjacency.close()
    gc.collect()
    riis.Adjacency.from_grid(40, 41, 42)  # the call would reuse the memory if it had been freed
    assert numpy.array_equal(columns, copy)
    assert numpy.array_equal(riis.mark(surface, grid, search="neighbor").ids, expected)
    with pytest.raises(riis.InvalidArgumentError, match="adjacency: is closed"):
        grid.set_adjacency(adjacency)


NOTEBOOK = """
from IPython.core.interactiveshell import InteractiveShell
shell = InteractiveShell()
for cell in (
    "import numpy, riis",
    "valve = riis.Valve('mitral'); surface = riis.Surface(valve); mesh = riis.Mesh(numpy.zeros((9, 3)))",
    "surface.vertices",
    "surface.triangles",
    "surface.update(valve)",
    "marks = riis.mark(surface, mesh)",
    "marks.ids",
    "riis.mark(surface, mesh, into=marks)",
    "surface.close()",
):
    shell.run_cell(cell, store_history=True).raise_error()
assert sorted(shell.user_ns["Out"]) == [3, 4, 7, 8]
"""


def test_what_a_notebook_shows_is_not_in_the_way(tmp_path):
    """IPython keeps every displayed object, in Out and _. The kept objects must not prevent later calls."""
    pytest.importorskip("IPython", reason="IPython is missing; ./run python installs it")
    environment = {**os.environ, "IPYTHONDIR": str(tmp_path)}
    answer = subprocess.run([sys.executable, "-B", "-c", NOTEBOOK], env=environment, capture_output=True, text=True, check=False)
    assert answer.returncode == 0, answer.stderr


def test_closed_objects_are_refused(surface, mesh, marks, valve):
    with surface as same:
        assert same is surface and not surface.closed
    assert surface.closed
    surface.close()  # closing again does nothing
    for use in (
        lambda: riis.mark(surface, mesh),
        lambda: surface.update(valve),
        lambda: surface.vertices,
        lambda: surface.info,
        lambda: surface.closest_point((0, 0, 0)),
    ):
        with pytest.raises(riis.InvalidArgumentError, match="surface: is closed"):
            use()
    assert repr(surface) == "<riis.Surface, closed>"
    surface = riis.Surface(valve)
    for closed, name, use in (
        (mesh, "mesh", lambda: riis.mark(surface, mesh)),
        (mesh, "mesh", lambda: len(mesh)),
        (marks, "marks", lambda: marks.ids),
        (marks, "marks", lambda: marks.add_resistance(R=1.0)),
        (marks, "into", lambda: riis.mark(surface, riis.Mesh(numpy.zeros((1, 3))), into=marks)),
        (valve, "valve", lambda: riis.Surface(valve)),
        (valve, "valve", lambda: valve["opening"]),
    ):
        closed.close()
        with pytest.raises(riis.InvalidArgumentError, match=f"{name}: is closed"):
            use()


def test_objects_without_their_constructor_are_refused(mesh):
    with pytest.raises(TypeError, match="surface"), pytest.warns(RuntimeWarning):
        riis.mark(riis.Surface.__new__(riis.Surface), mesh)
