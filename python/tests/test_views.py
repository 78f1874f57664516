# SPDX-License-Identifier: Apache-2.0
"""Arrays show the library's memory: read-only, kept alive, and in the way of calls that would change it."""

import gc
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
    riis.mark(riis.Surface(riis.Valve("aortic")), mesh)  # takes memory that was freed
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


def test_marking_into_a_result_with_views_is_refused(surface, mesh, marks):
    ids = marks.ids
    expected = ids.copy()
    part = ids[3:5]
    del ids
    for _ in range(2):
        with pytest.raises(BufferError, match="into: 1 array shows its memory"):
            riis.mark(surface, mesh, into=marks)
    assert numpy.array_equal(part, expected[3:5])
    del part
    riis.mark(surface, mesh, into=marks)


def test_a_view_of_a_list_is_in_the_way_too(surface, mesh, marks):
    lists = marks.within_limit  # holds no array
    riis.mark(surface, mesh, into=marks)
    distance = lists.distance
    with pytest.raises(BufferError, match="into"):
        riis.mark(surface, mesh, into=marks)
    del distance
    riis.mark(surface, mesh, into=marks)


def test_updating_a_surface_with_views_is_refused(surface, valve):
    triangles = surface.triangles
    with pytest.raises(BufferError, match="surface: 4 arrays show its memory"):
        surface.update(valve)
    with pytest.raises(BufferError, match="surface"):
        surface.update_moving(valve, valve, 1.0)
    with pytest.raises(BufferError, match="Surface: 4 arrays"):
        surface.close()
    del triangles
    surface.update(valve)
    surface.close()


def test_pairs_and_edges_are_views_of_their_own(surface, grid):
    marks = riis.mark(surface, grid)
    riis.find_crossings(surface)
    pairs = surface.crossing_pairs
    with pytest.raises(BufferError, match="surface: 4 arrays"):
        riis.find_crossings(surface)
    with pytest.raises(BufferError, match="surface: 4 arrays"):
        surface.update(riis.Valve("mitral"))
    with pytest.raises(BufferError, match="Surface: 4 arrays"):
        surface.close()
    del pairs
    vertices = surface.vertices
    riis.find_crossings(surface)  # replaces the pairs alone
    assert vertices.shape[1] == 3
    riis.find_leaks(surface, grid, marks)
    edges = marks.leaking_edges
    with pytest.raises(BufferError, match="marks: 3 arrays"):
        riis.find_leaks(surface, grid, marks)
    with pytest.raises(BufferError, match="into: 3 arrays"):
        riis.mark(surface, grid, into=marks)
    with pytest.raises(BufferError, match="MarkResult: 3 arrays"):
        marks.close()
    del edges
    ids = marks.ids
    riis.find_leaks(surface, grid, marks)  # leaves the marks
    assert len(ids) == len(marks)


def test_an_adjacency_that_is_borrowed_stays(mesh, xyz):
    mesh = riis.Mesh(xyz[:60])
    adjacency = riis.Adjacency.from_grid(3, 4, 5)
    mesh.set_adjacency(adjacency)
    with pytest.raises(BufferError, match="Adjacency: 1 array"):
        adjacency.close()
    mesh.set_adjacency()
    adjacency.close()


def test_closed_objects_are_refused(surface, mesh, marks, valve):
    with surface as same:
        assert same is surface and not surface.closed
    assert surface.closed
    surface.close()  # again: nothing happens
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
        (marks, "marks", lambda: marks.add_resistance(resistance=1.0)),
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
