# SPDX-License-Identifier: Apache-2.0
"""The model of the view: what it shows, judges, undoes and writes, and what it refuses."""

import json
import os
import pathlib
import re
import shlex
import subprocess

import numpy
import pytest
import tube

import riis
from riis.view import model as view
from riis.view import reading, rows
from riis.view._bumps import free_edge
from riis.view._valves import has_cusps, matrix_of, n_leaflets, rotation_of, turned

ROOT = pathlib.Path(__file__).resolve().parents[2]
SEED = int(os.environ.get("RIIS_TEST_SEED", "34"))


@pytest.fixture(scope="module")
def small():
    return tube.mesh(13)


@pytest.fixture(scope="module")
def fine():
    return tube.mesh(23)


@pytest.fixture
def random():
    print("seed", SEED)
    return numpy.random.default_rng(SEED)


def placed_model(mesh, kinds, random, **options):
    """Returns a model with a valve of each kind, at random places, openings and sizes."""
    model = view.Model(*mesh, **options)
    for kind in kinds:
        i = model.add(kind)
        model.place(i, random.normal(0.0, 0.2, 3), axis=(0, 0, 1) + random.normal(0.0, 0.3, 3), reference=random.normal(size=3))
        model.set(i, "opening", random.uniform())
        model.set(i, "half_thickness", random.uniform(0.1, 0.25))
        name = "annulus" if "annulus" in model.values(i) else "AP_diameter"
        model.set(i, name, random.uniform(0.9, 1.0) * model.values(i)[name])
        model.set(i, "offset", random.choice([0.0, 0.75, -0.5]))
    return model


def surface_of(state):
    """Makes a surface from a snapshot, without the model."""
    valve = riis.Valve(state.kind, opening=state.opening)
    valve.update(state.parameters)
    return riis.Surface(valve, half_thickness=state.half_thickness, scale=state.scale, rotation_axis=state.rotation[:3],
                        rotation_angle=state.rotation[3], translation=state.origin, triangulation=state.triangulation,
                        offset=state.offset)


# ---- What is shown ----


@pytest.mark.parametrize("triangulation", ["adapted", "fixed"])
@pytest.mark.parametrize("kind", view.KINDS)
def test_marks_are_those_of_the_library(kind, triangulation, small, random):
    model = placed_model(small, [kind], random)
    model.set(0, "triangulation", triangulation)
    shown = model.update()
    marks = riis.mark(surface_of(model.valves[0]), riis.Mesh(small[0]))
    assert len(marks) > 20 and numpy.array_equal(shown.marked, marks.ids)
    assert numpy.array_equal(shown.distance, marks.distance) and numpy.array_equal(shown.leaflet, marks.leaflet_id)
    triangles = surface_of(model.valves[0]).triangles
    assert numpy.array_equal(shown.surfaces[0].triangles, triangles.vertex_id)
    assert numpy.array_equal(shown.surfaces[0].leaflet, triangles.leaflet_id)
    assert shown.milliseconds > 0.0 and model.update() is shown


def test_several_valves_and_their_cells(small, random):
    model = placed_model(small, ["mitral", "coapting", "bileaflet"], random)
    shown = model.update()
    best = {}
    for k, state in enumerate(model.valves):
        marks = riis.mark(surface_of(state), riis.Mesh(small[0]))
        for node, distance, leaflet in zip(marks.ids, marks.distance, marks.leaflet_id, strict=True):
            best[node] = min(best.get(node, (9.0,)), (distance, k, leaflet))
    assert shown.marked.tolist() == sorted(best)
    found = zip(shown.distance, shown.valve, shown.leaflet, strict=True)
    assert [tuple(one) for one in found] == [best[node] for node in sorted(best)]
    counts = [sum(node in best for node in cell) for cell in small[1].tolist()]
    assert shown.cells_marked.tolist() == [k for k, n in enumerate(counts) if n == 4]
    assert shown.cells_partly.tolist() == [k for k, n in enumerate(counts) if 0 < n < 4]


def test_cells_of_all_types(random):
    """A hexahedron, a voxel, a prism, a pyramid, a triangle and a line, in the numbers of the caller."""
    points = random.uniform(-1.0, 1.0, (12, 3))
    cells = [[0, 1, 2], [0, 1, 2, 3, 4, 5, 6, 7], [4, 5, 6, 7, 8, 9, 10, 11], [0, 1], [0, 1, 2, 3, 4, 5], [7, 8, 9, 10, 11]]
    offsets = numpy.cumsum([0] + [len(cell) for cell in cells])
    made = view.Model(points, numpy.concatenate(cells), offsets=offsets, types=[5, 12, 11, 3, 13, 14])
    made.add("coapting")
    marked = set(made.update().marked.tolist())
    volumes = {k: sum(node in marked for node in cells[k]) / len(cells[k]) for k in (1, 2, 4, 5)}
    assert set(made.update().cells_marked.tolist()) == {k for k, share in volumes.items() if share == 1}
    assert set(made.update().cells_partly.tolist()) == {k for k, share in volumes.items() if 0 < share < 1}


def faces_alone(cells, faces):
    """Returns the sets of nodes of the faces that only one cell has, by counting."""
    count = {}
    for cell in cells:
        for face in faces:
            key = frozenset(cell[k] for k in face)
            count[key] = count.get(key, 0) + 1
    return {key for key, n in count.items() if n == 1}


def test_the_wall_is_the_boundary(small, random):
    """The wall of tetrahedra with a hole inside, and of hexahedra, has normals outwards. The wall encloses the volume of the
    cells."""
    points, tetrahedra = small
    n = 5
    axis = numpy.linspace(-1.0, 1.0, n)
    grid = numpy.stack(numpy.meshgrid(axis, axis, axis, indexing="ij"), axis=-1).reshape(-1, 3)
    i, j, k = (part.ravel() for part in numpy.meshgrid(*3 * [numpy.arange(n - 1)], indexing="ij"))
    corner = [(a, b, c) for c in (0, 1) for a, b in ((0, 0), (1, 0), (1, 1), (0, 1))]
    hexahedra = numpy.column_stack([(i + a) * n * n + (j + b) * n + k + c for a, b, c in corner])
    six = [(0, 1, 2, 3), (4, 5, 6, 7), (0, 1, 5, 4), (1, 2, 6, 5), (2, 3, 7, 6), (3, 0, 4, 7)]
    middle = points[tetrahedra].mean(axis=1)
    holed = tetrahedra[numpy.linalg.norm(middle, axis=1) > 0.6]
    a, b, c, d = (points[holed[:, k]] for k in range(4))
    volume = numpy.abs(numpy.einsum("ij,ij->i", numpy.cross(b - a, c - a), d - a)).sum() / 6.0
    for nodes, cells, faces, known in [
        (points, holed, [(0, 1, 2), (0, 1, 3), (0, 2, 3), (1, 2, 3)], volume),
        (grid, hexahedra[random.permutation(len(hexahedra))], six, 8.0),
    ]:
        wall = view.Model(nodes, cells)._region().wall()
        vertices, triangles = wall.vertices, wall.triangles.vertex_id
        x, y, z = (vertices[triangles[:, k]] for k in range(3))
        assert abs(numpy.einsum("ij,ij->i", x, numpy.cross(y, z)).sum() / 6.0 - known) < 1e-9 * known
        sets = faces_alone(cells.tolist(), faces)
        assert len(triangles) == sum(len(key) - 2 for key in sets)


def of_second_order(points, tetrahedra):
    """Returns the mesh with a node in the middle of each edge, in VTK's order."""
    edges = [(0, 1), (1, 2), (2, 0), (0, 3), (1, 3), (2, 3)]
    pairs = numpy.sort(numpy.stack([tetrahedra[:, edge] for edge in edges], axis=1), axis=2)
    known, place = numpy.unique(pairs.reshape(-1, 2), axis=0, return_inverse=True)
    middles = points[known].mean(axis=1)
    return numpy.concatenate([points, middles]), numpy.concatenate([tetrahedra, len(points) + place.reshape(-1, 6)], axis=1)


def test_edges_of_second_order(small):
    """A tetrahedron of second order has the edges of its eight small tetrahedra, except for the inner edge that joins two
    middles."""
    points, cells = of_second_order(*tube.mesh(5))
    small_ones = [(0, 4, 6, 7), (1, 4, 5, 8), (2, 5, 6, 9), (3, 7, 8, 9)]
    middles = [(4, 5, 6), (4, 7, 8), (5, 8, 9), (6, 7, 9)]
    known = set()
    for cell in cells.tolist():
        for group in small_ones + middles:
            known |= {(cell[a], cell[b]) for a in group for b in group if a != b}
    rows = view.Model(points, cells, types=numpy.full(len(cells), 24))._region().adjacency()
    found = {(k, int(n)) for k in range(len(points)) for n in rows.columns[rows.offsets[k] : rows.offsets[k + 1]]}
    assert found == known
    model = view.Model(*of_second_order(*small), types=numpy.full(len(small[1]), 24), unit="cm")
    model.add("coapting")
    for name in ("annulus", "stj"):
        model.set(0, name, 2.55)
    assert light(model, "half_thickness").level == "good" and light(model, "sealed").cure[1] == "sealed"
    model.cure("sealed")
    assert 0.1 < model.valves[0].half_thickness < 0.12
    assert {one.name: one.level for one in model.lights()} == dict.fromkeys(view.NAMES, "good")
    strange = view.Model(numpy.zeros((27, 3)) + numpy.arange(27.0)[:, None], numpy.arange(27)[None], types=[29], unit="cm")
    strange.add("coapting")
    assert light(strange, "sealed").text == "the mesh has cells of a type whose edges the view does not know"


def test_another_kind(small):
    model = view.Model(*small, unit="cm")
    i, j = model.add("mitral"), model.add("coapting")
    model.set(i, "AP_diameter", 2.8)
    model.place(i, (0.1, 0.0, 0.0))
    model.change_kind(i, "coapting")
    state = model.valves[i]
    assert (state.kind, state.name, state.parameters, state.origin) == ("coapting", "coapting_2", {}, (0.1, 0.0, 0.0))
    for k in (i, j):
        marks = riis.mark(surface_of(model.valves[k]), riis.Mesh(small[0]))
        nodes, distance, leaflet = model.marks_of(k)
        assert numpy.array_equal(nodes, marks.ids) and numpy.array_equal(distance, marks.distance)
        assert numpy.array_equal(leaflet, marks.leaflet_id)


@pytest.mark.parametrize("kind", view.KINDS)
def test_near_is_the_whole(kind, random):
    """Near the valve, the marks and cells are those of the whole mesh, even after the valve has left the first cells near it."""
    mesh = tube.mesh(9, radius=4.0, length=20.0)
    near, whole = view.Model.near(*mesh), view.Model(*mesh)
    for model in (near, whole):
        model.add(kind)
        model.set(0, "half_thickness", 0.55)
        model.set(0, "offset", 0.75)
    regions = set()
    for z in (0.0, 0.3, 7.5, -8.0):
        axis = random.normal(size=3)
        for model in (near, whole):
            model.place(0, (0.3, 0.0, z), axis=axis)
        a, b = near.update(), whole.update()
        assert len(a.marked) > 5
        for name in ("marked", "leaflet", "distance", "cells_marked", "cells_partly"):
            assert numpy.array_equal(getattr(a, name), getattr(b, name)), name
        regions.add(id(near._region()))
        assert len(near._region().points) < 0.7 * len(whole.points)
        levels = [[light.level for light in model.lights() if light.name in ("unit", "crossing", "half_thickness")]
                  for model in (near, whole)]
        assert levels[0] == levels[1]
    assert len(regions) > 1


def test_an_orifice_is_drawn(random):
    """For oblique valves of each kind, the area inside the drawn outline is the orifice's area."""
    for kind in view.KINDS:
        model = view.Model(numpy.zeros((1, 3)))
        i = model.add(kind)
        model.set(i, "opening", 0.9)
        model.set(i, "half_thickness", 0.6)
        model.place(i, random.normal(size=3), axis=random.normal(size=3), reference=random.normal(size=3), scale=3.0)
        measured = model.surface(i).orifice()
        area = 0.0
        for line in model.orifice(i):
            after = numpy.roll(line, -1, axis=0)
            area += 0.5 * float((numpy.cross(line, after) @ measured.axis).sum())
        assert abs(area - measured.area) < 0.02 * measured.outline_area, kind


def test_the_flow_goes_with_the_normals(random):
    """The normals of closed leaflets point downstream, as riis/surface.h says."""
    for kind in view.KINDS:
        model = view.Model(numpy.zeros((1, 3)))
        i = model.add(kind)
        model.set(i, "opening", 0.0)
        model.place(i, random.normal(size=3), axis=random.normal(size=3), reference=random.normal(size=3))
        a, b, c = numpy.asarray(model.surface(i).vertices)[model.surface(i).triangles.vertex_id].transpose(1, 0, 2)
        flow = numpy.asarray(model.valves[i].flow)
        assert numpy.cross(b - a, c - a).sum(axis=0) @ flow > 0.0, kind
        assert numpy.allclose(numpy.abs(flow @ model.valves[i].axis), 1.0), kind
        words = {row["name"]: row["description"] for row in rows.placement_of(model.valves[i], "cm")}["axis"]
        assert words.startswith("against the flow") == (flow @ model.valves[i].axis < 0.0), kind


# ---- Placement ----


def test_rotations(random):
    for k in range(60):
        angle = [0.0, 180.0, 1e-5, 179.9999][k % 6] if k % 6 < 4 else random.uniform(0.0, 180.0)
        axis = random.normal(size=3) if k % 4 else numpy.eye(3)[k % 3]
        matrix = matrix_of((*axis.tolist(), angle))
        assert numpy.allclose(matrix @ matrix.T, numpy.eye(3), atol=1e-14) and numpy.linalg.det(matrix) > 0.99
        assert numpy.allclose(matrix_of(rotation_of(matrix)), matrix, atol=1e-8)
        z, x = random.normal(size=3), random.normal(size=3)
        made = turned(matrix, z, x)
        assert numpy.allclose(made[:, 2], z / numpy.linalg.norm(z)) and made[:, 0] @ x > 0.0 and abs(made[:, 1] @ x) < 1e-12
        smallest = turned(matrix, z, None)
        assert numpy.allclose(smallest[:, 2], z / numpy.linalg.norm(z))
        turn = rotation_of(smallest @ matrix.T)[3]
        assert abs(numpy.cos(numpy.radians(turn)) - matrix[:, 2] @ smallest[:, 2]) < 1e-8


def test_the_placement_is_the_surface_s(small):
    model = view.Model(*small)
    i = model.add("aortic")
    before = numpy.array(model.surface(i).vertices)
    model.place(i, (1.0, 2.0, 3.0), axis=(1.0, 0.0, 0.0), reference=(0.0, 0.0, 2.0), scale=2.0)
    frame = numpy.array([[0.0, 0.0, 1.0], [0.0, 1.0, 0.0], [1.0, 0.0, 0.0]])  # rows: x to z, y to y, z to x, but mirrored
    frame[1] = numpy.cross(frame[2], frame[0])
    state = model.valves[i]
    model.set(i, "half_thickness", 0.2)  # the same tolerance as the scale, so that the triangles are the same
    assert numpy.allclose(model.surface(i).vertices, 2.0 * before @ frame + (1.0, 2.0, 3.0), atol=1e-12)
    assert numpy.allclose(state.axis, (1.0, 0.0, 0.0)) and numpy.allclose(state.reference, (0.0, 0.0, 1.0))


@pytest.mark.parametrize("kind", view.KINDS)
@pytest.mark.parametrize("unit", ["mm", "cm", "m"])
def test_clicks_place_the_annulus(kind, unit, random):
    """Three clicks on the annulus of a placed, enlarged valve find its place again, from another place and the default size."""
    size = view.UNITS[unit]
    model = view.Model(numpy.zeros((1, 3)), unit=unit)
    known, i = model.add(kind), model.add(kind)
    growth, axis = random.uniform(0.8, 1.25), random.normal(size=3)
    for name, value in model.values(known).items():
        parameter = next(one for one in model.parameters(kind) if one.name == name)
        if parameter.unit == "length" and name in riis.Valve(kind) and not parameter.rule:
            model.set(known, name, numpy.multiply(growth, value))
    model.place(known, 5.0 * size * random.normal(size=3), axis=axis, reference=random.normal(size=3))
    at = view.annulus_of(model.valves[known])
    state = model.valves[known]
    clicks = numpy.array(state.origin) + state.scale * at.points @ state.matrix.T
    assert numpy.ptp(numpy.linalg.norm(clicks - clicks.mean(axis=0), axis=1)) < 0.5 * size
    if kind in ("aortic", "coapting", "trileaflet") and random.uniform() < 0.7:
        clicks = clicks[[0, 2, 1]]  # the order of the second and the third click is free
    model.place(i, axis=axis + 0.3 * random.normal(size=3))
    model.place_by_clicks(i, clicks)
    made = model.valves[i]
    assert numpy.allclose(made.matrix, state.matrix, atol=1e-9) and made.scale == size
    assert numpy.allclose(made.origin, state.origin, atol=1e-8 * size)
    for name, value in model.values(known).items():
        assert numpy.allclose(model.values(i)[name], value, rtol=1e-9, atol=1e-9), name


@pytest.mark.parametrize("kind", ["bicuspid", "coapting", "quadricuspid", "trileaflet"])
def test_the_first_click_is_for_cusp_0(kind):
    """The annulus passes through the lowest point of each cusp, first through that of cusp 0, also if the cusps are unequal."""
    model = view.Model(numpy.zeros((1, 3)))
    i = model.add(kind)
    model.set(i, "translation", (0.1, -0.2, 0.3))
    if "cusp_0.sector" in model.values(i):
        model.set(i, "cusp_0.sector", 1.2 * model.values(i)["cusp_0.sector"])
    annulus, attached = view.annulus_of(model.valves[i]), model.surface(i).attachment
    for cusp in range(n_leaflets(kind)):
        ends = attached.edges[attached.leaflet_id == cusp].reshape(-1, 3)
        nadir = ends[numpy.argmin(ends[:, 2])]
        assert abs(numpy.linalg.norm(nadir - annulus.centre) - annulus.radius) < 1e-9 * annulus.radius
        assert cusp != 0 or numpy.allclose(annulus.points[0], nadir, rtol=0, atol=1e-9)


@pytest.mark.parametrize("kind", view.KINDS)
def test_clicks_anywhere_on_a_circle(kind, random):
    """The circle through any three clicks becomes the annulus. The axis of the annulus points to the side of the given axis."""
    model = view.Model(numpy.zeros((1, 3)), unit="mm")
    i = model.add(kind)
    for _ in range(5):
        up, centre, radius = random.normal(size=3), 50.0 * random.normal(size=3), random.uniform(9.0, 16.0)
        frame = turned(numpy.eye(3), up, random.normal(size=3))
        angle = random.uniform(0, 6) + numpy.array([0.0, 2.1, 4.2]) + random.uniform(-0.6, 0.6, 3)
        clicks = centre + radius * (numpy.cos(angle)[:, None] * frame[:, 0] + numpy.sin(angle)[:, None] * frame[:, 1])
        model.place(i, axis=up + 0.2 * random.normal(size=3))
        model.place_by_clicks(i, clicks)
        state = model.valves[i]
        at = view.annulus_of(state)
        assert abs(state.scale * at.radius - radius) < 1e-8 * radius
        assert numpy.allclose(state.matrix @ at.normal, up / numpy.linalg.norm(up), atol=1e-9)
        assert numpy.allclose(state.origin + state.scale * state.matrix @ at.centre, centre, atol=1e-8)
        model.flip(i)
        flipped = model.valves[i]
        assert numpy.allclose(flipped.matrix @ at.normal, -up / numpy.linalg.norm(up), atol=1e-9)
        assert numpy.allclose(flipped.origin + flipped.scale * flipped.matrix @ at.centre, centre, atol=1e-8)


def test_landmarks(random):
    """Exact landmarks of a trileaflet valve give its size and place, as riis.place does."""
    known = riis.Valve("trileaflet", annulus=2.3)
    placement = {"scale": 10.0, "rotation_axis": (0.6, 0.0, 0.8), "rotation_angle": 40.0, "translation": (7.0, -3.0, 90.0)}
    attachment = riis.Surface(known, half_thickness=1.0, **placement).attachment
    up = matrix_of((0.6, 0.0, 0.8, 40.0))[:, 2]
    marks = {"nadir": [], "commissure": []}
    for cusp in range(3):
        ends = attachment.edges[attachment.leaflet_id == cusp].reshape(-1, 3)
        marks["nadir"].append(ends[numpy.argmin(ends @ up)])
    ends = attachment.edges.reshape(-1, 3)
    top = ends[ends @ up > (ends @ up).max() - 1e-9]
    for k in range(3):
        far = [numpy.linalg.norm(top - kept, axis=1) > 1.0 for kept in marks["commissure"]]
        marks["commissure"].append(top[numpy.argmax(numpy.all(far, axis=0))] if far else top[0])
    model = view.Model(numpy.zeros((1, 3)), unit="mm")
    i = model.add("trileaflet")
    found = model.place_by_landmarks(i, marks)
    assert found.worst < 0.2 and abs(model.values(i)["annulus"] - 2.3) < 0.03
    assert numpy.allclose(model.valves[i].axis, up, atol=0.01) and model.valves[i].scale == 10.0
    assert model.undo() and model.valves[i].parameters == {}


# ---- Undo ----


def test_undo_is_exact(small, random):
    """Random changes are undone and redone, and compared with a list of snapshots."""
    model = view.Model(*small, unit="cm")
    history, at = [model.valves], 0
    for _ in range(60):
        move, n = random.integers(0, 8), len(model.valves)
        if move < 2 and at > 0:
            assert model.can_undo and model.undo()
            at -= 1
        elif move == 2 and at + 1 < len(history):
            assert model.can_redo and model.redo()
            at += 1
        else:
            if n == 0 or (n < 3 and move == 3):
                model.add(view.KINDS[random.integers(len(view.KINDS))])
            elif move == 4 and n > 1:
                model.remove(int(random.integers(n)))
            elif move == 5:
                model.place(int(random.integers(n)), random.normal(size=3), axis=random.normal(size=3))
            elif move == 6:
                model.set_cycle("mitral", random.uniform(0.5, 1.0))
            else:
                model.set(int(random.integers(n)), "opening", random.uniform())
            history = [*history[: at + 1], model.valves]
            at += 1
        assert model.valves == history[at]
        assert model.can_undo == (at > 0) and model.can_redo == (at + 1 < len(history))
    while model.undo():
        pass
    assert model.valves == () and not model.undo()


def test_a_drag_is_one_step(small):
    model = view.Model(*small)
    i = model.add("coapting")
    with model.dragging():
        for annulus in (2.4, 2.5, 2.6):
            model.set(i, "annulus", annulus)
        for opening in (0.1, 0.2):
            model.set(i, "opening", opening)
    assert model.values(i)["annulus"] == 2.6 and model.valves[i].opening == 0.2
    assert model.undo() and model.valves[i].opening == 0.0 and model.values(i)["annulus"] == 2.6
    assert model.undo() and model.valves[i].parameters == {}
    assert model.redo() and model.redo() and not model.redo() and model.valves[i].opening == 0.2
    model.set(i, "opening", 0.2)  # no change, no step
    model.undo()
    assert model.valves[i].opening == 0.0


# ---- Leaflets and bumps ----

WITH_BUMPS = ("bicuspid", "coapting", "quadricuspid", "mitral_coapting", "tricuspid")


def test_the_kinds_are_those_of_the_library():
    with pytest.raises(riis.InvalidParameterError) as refused:
        riis.Valve("none")
    assert sorted(view.KINDS) == str(refused.value).split("there are: ")[1].split(". ")[0].split(", ")
    with_bumps = [kind for kind in view.KINDS if "bump_0.leaflet" in riis.Valve(kind)]
    assert sorted(with_bumps) == sorted(WITH_BUMPS)
    leaflets = {kind: n_leaflets(kind) for kind in view.KINDS}
    assert leaflets == {"coapting": 3, "bicuspid": 2, "quadricuspid": 4, "trileaflet": 3, "aortic": 3, "mitral": 2,
                        "mitral_coapting": 2, "tricuspid": 3, "bileaflet": 2}
    assert {kind for kind in view.KINDS if has_cusps(kind)} == {
        "coapting", "bicuspid", "quadricuspid", "trileaflet", "aortic"}


def free_ends(surface, leaflet):
    """Returns the edges (n, 2, 3) of a leaflet that only one triangle has, without its attachment."""
    faces = surface.triangles.vertex_id[surface.triangles.leaflet_id == leaflet]
    _, place = numpy.unique(surface.vertices.round(9), axis=0, return_inverse=True)
    sides = numpy.sort(place.reshape(-1)[numpy.concatenate([faces[:, [0, 1]], faces[:, [1, 2]], faces[:, [2, 0]]])], axis=1)
    known, first, count = numpy.unique(sides, axis=0, return_index=True, return_counts=True)
    held = {tuple(side) for side in numpy.sort(place.reshape(-1)[surface.attachment.vertex_id], axis=1).tolist()}
    at = numpy.concatenate([faces[:, [0, 1]], faces[:, [1, 2]], faces[:, [2, 0]]])[first]
    alone = [n == 1 and tuple(side) not in held for side, n in zip(known.tolist(), count.tolist())]
    return surface.vertices[at[alone]]


@pytest.mark.parametrize("kind", WITH_BUMPS)
def test_a_bump_lies_on_the_free_edge(kind, random):
    """The place of a bump is on the edge of the triangles, and the edge moves most near it."""
    model = view.Model(numpy.zeros((1, 3)), unit="cm")
    i = model.add(kind)
    model.place(i, random.normal(size=3), axis=random.normal(size=3), reference=random.normal(size=3))
    model.set(i, "triangulation", "fixed")
    model.set(i, "opening", 0.6)
    n = n_leaflets(kind)
    assert model.bumps(i) == [] and model.most_bumps(i) == 6
    first = numpy.array(model.surface(i).vertices)
    for leaflet in range(n):
        number = model.add_bump(i)
        model.place_bump(i, number, leaflet=leaflet)
        u = random.choice([1 / 3, 0.5, 2 / 3])  # places of control points
        for name, value in (("u", u), ("width", 0.3)):
            model.set(i, f"bump_{number}.{name}", value)
        assert model.surface(i).closest_points(first).distance.max() < 0.01  # a new bump changes at most triangles
        place = model.bump_place(i, number)
        ends = free_ends(model.surface(i), leaflet)
        for line in (place.point[None], *place.lines):
            a, b = ends[:, 0], ends[:, 1]
            t = numpy.einsum("ijk,jk->ij", line[:, None] - a, b - a) / ((b - a) ** 2).sum(axis=1)
            near = a + t.clip(0.0, 1.0)[:, :, None] * (b - a)
            assert numpy.linalg.norm(line[:, None] - near, axis=2).min(axis=1).max() < 0.02
        before = free_edge(model.valves[i].valve(), leaflet)
        model.set(i, f"bump_{number}.open", 0.5)
        at, after = numpy.linspace(0.0, 1.0, 201), free_edge(model.valves[i].valve(), leaflet)
        moved = [[numpy.interp(at, share, line[:, k]) for k in range(3)] for share, line in (before, after)]
        assert abs(at[numpy.argmax(numpy.linalg.norm(numpy.subtract(*moved), axis=0))] - u) < 0.12
        model.remove_bump(i, number)
        assert model.bumps(i) == [] and numpy.array_equal(model.surface(i).vertices, first)


@pytest.mark.parametrize("kind", WITH_BUMPS)
def test_edges_run_counter_clockwise_between_commissures(kind):
    """The edge of leaflet k ends where that of leaflet k + 1 begins, and the middles of the leaflets turn counter-clockwise."""
    unequal = {
        "bicuspid": {"cusp_0.sector": 225.0, "cusp_1.sector": 135.0}, "coapting": {"cusp_1.sector": 160.0, "stj": 2.7},
        "quadricuspid": {"cusp_3.sector": 60.0, "stj": 2.7},
    }  # fmt: skip
    for opening, sizes in ((0.0, {}), (0.5, {}), (1.0, {}), (0.3, unequal.get(kind, {}))):
        valve = riis.Valve(kind, opening=opening, **sizes)
        edges = [free_edge(valve, leaflet) for leaflet in range(n_leaflets(kind))]
        for k, (share, line) in enumerate(edges):
            assert share[0] == 0.0 and share[-1] == 1.0 and (numpy.diff(share) >= 0.0).all()
            assert numpy.linalg.norm(line[-1] - edges[(k + 1) % len(edges)][1][0]) < 0.05
        attached = riis.Surface(valve).attachment
        middles = numpy.array([attached.edges[attached.leaflet_id == k].mean(axis=(0, 1)) for k in range(len(edges))])
        turns = numpy.diff(numpy.unwrap(numpy.arctan2(*(middles - middles.mean(axis=0))[:, 1::-1].T)))
        assert len(edges) == 2 or (turns > 0.0).all()


def test_bumps_are_changed_and_refused(small):
    model = view.Model(*small, unit="cm")
    i, j = model.add("bicuspid"), model.add("mitral")
    assert [model.add_bump(i) for _ in range(6)] == list(range(6))
    with pytest.raises(riis.InvalidArgumentError, match="i: valve 0 has 6 bumps, and no kind has more"):
        model.add_bump(i)
    model.place_bump(i, 2, commissure=1)
    assert model.bumps(i)[2] == (2, -1, 1) and model.values(i)["bump_2.leaflet"] == -1.0
    assert len(model.bump_place(i, 2).lines) == 2 and len(model.bump_place(i, 1).lines) == 1
    model.remove_bump(i, 4)
    assert [bump.number for bump in model.bumps(i)] == [0, 1, 2, 3, 5] and model.add_bump(i) == 4
    assert model.undo() and model.undo() and model.undo() and model.bumps(i)[2] == (2, 0, -1)
    before = model.valves
    for call, text in (
        (lambda: model.add_bump(j), "only bicuspid, coapting, quadricuspid, mitral_coapting and tricuspid valves have bumps"),
        (lambda: model.place_bump(i, 0, leaflet=2), "bump_0.leaflet"),
        (lambda: model.place_bump(i, 0, leaflet=1, commissure=1), "a bump is at one place"),
        (lambda: model.set(i, "bump_0.lift", 0.1), "name: is 'bump_0.lift'"),
        (lambda: model.set(i, "bump_0.width", 0.1), "bump_0.width"),
        (lambda: model.set(i, "cusp_0.sector", 40.0), "sector"),
        (lambda: model.bump_place(j, 0), "number: is 0; valve 1 has no such bump"),
    ):
        with pytest.raises(riis.Error, match=text):
            call()
        assert model.valves == before
    model.set(i, "cusp_0.sector", 150.0)
    model.set(i, "effective_height", 0.8)
    assert model.values(i)["cusp_1.effective_height"] == 0.8 and model.values(i)["cusp_1.sector"] == 180.0
    k = model.add_surface([[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]], [[0, 1, 2]])
    assert model.most_bumps(k) == 0
    with pytest.raises(riis.InvalidArgumentError, match="i: valve 2 is a surface from a file, which has no bumps"):
        model.add_bump(k)


# ---- Lights ----


def light(model, name):
    return next(one for one in model.lights() if one.name == name)


@pytest.mark.parametrize("kind", ["coapting", "trileaflet"])
def test_a_valve_that_fits_is_good(kind, fine):
    model = view.Model(*fine, unit="cm")
    assert {one.level for one in model.lights()} == {"off"}
    i = model.add(kind)
    model.set(i, "annulus", 2.55)
    model.set(i, "stj", 2.55)
    model.set(i, "half_thickness", 0.16)
    assert {one.name: one.level for one in model.lights()} == dict.fromkeys(view.NAMES, "good")
    model.set(i, "opening", 1.0)
    sealed = light(model, "sealed")
    assert sealed.level == "off" and "open" in sealed.text
    path = sealed.edges
    assert path[0, 0, 2] * path[-1, 1, 2] < 0.0 and numpy.array_equal(path[1:, 0], path[:-1, 1])  # from side to side
    marked = {tuple(point) for point in fine[0][model.update().marked]}
    assert not any(tuple(point) in marked for point in path.reshape(-1, 3))


def test_a_gap_to_the_wall_and_its_skirt(fine):
    """A valve that is 0.25 too small leaks beside the wall. The gap is the distance to the wall's polygon, and the skirt that the
    light proposes seals it."""
    model = view.Model(*fine, unit="cm")
    i = model.add("coapting")
    model.set(i, "half_thickness", 0.16)
    for name in ("annulus", "stj"):
        model.set(i, name, 2.1)
    wall, sealed = light(model, "wall"), light(model, "sealed")
    assert wall.level == sealed.level == "bad" and wall.cure is not None and len(wall.edges) > 10
    n_sides = 4 * (23 - 1)
    least, most = (float(text) for text in re.search(r"wall is (\S+) to (\S+) cm from", wall.text).groups())
    assert 1.3 * numpy.cos(numpy.pi / n_sides) - 1.05 - 0.01 <= least and most <= 1.3 - 1.05 + 0.06
    assert numpy.hypot(*sealed.points[0, :2]) > 1.0  # beside the valve
    model.cure("wall")
    wall = model._region().wall().closest_points(numpy.array(model.surface(i).vertices), side=True)
    assert ((wall.side > 0) & (wall.distance > 0.16)).mean() < 0.2 and light(model, "inside").level == "good"
    assert light(model, "wall").level == light(model, "sealed").level == "good"
    assert model.undo() and model.valves[i].parameters == {"root_radius": 1.05, "commissure_radius": 1.05}
    model.set(i, "skirt_length", 0.9)
    wall = model._region().wall().closest_points(numpy.array(model.surface(i).vertices), side=True)
    assert ((wall.side > 0) & (wall.distance > 0.16)).mean() > 0.2 and light(model, "inside").text.endswith("nodes are marked")


def test_a_thin_band_and_its_cure(small):
    model = view.Model(*small, unit="cm")
    i = model.add("coapting")
    model.set(i, "half_thickness", 0.02)
    found = light(model, "half_thickness")
    assert found.level == "bad" and found.cure[1] == "half_thickness" and len(found.edges) == len(found.points)
    leaks = riis.find_leaks(model.surface(i), model._region().mesh, model._at(i).marks)
    assert len(found.edges) == leaks.n_edges > 100
    model.cure("half_thickness")
    assert light(model, "half_thickness").level == "good" and 0.02 < model.valves[i].half_thickness < 0.3
    assert model.undo() and model.valves[i].half_thickness == 0.02
    model.set(i, "half_thickness", 1.5)
    assert "largest side" in light(model, "half_thickness").text
    model.cure("half_thickness")
    assert 0.05 < model.valves[i].half_thickness < 0.2


def test_an_offset_is_judged_with_its_band(fine):
    """The offset does not open a valve without a gap. The offset opens a wider gap, and shortens the band beyond the rim. The
    edges that leak are those of the shifted band."""
    model = view.Model(*fine, unit="cm")
    i = model.add("coapting")
    model.set(i, "annulus", 2.55)
    model.set(i, "stj", 2.55)
    model.set(i, "half_thickness", 0.16)
    marked = model.update().marked
    with pytest.raises(riis.InvalidArgumentError, match="^offset is 1; it must be above -1 and below 1"):
        model.set(i, "offset", 1.0)
    assert model.update().marked is marked and model.valves[i].offset == 0.0
    model.set(i, "offset", 0.5)
    assert not numpy.array_equal(model.update().marked, marked)
    assert {one.name: one.level for one in model.lights()} == dict.fromkeys(view.NAMES, "good")
    model.set(i, "gap", 0.2)
    model.set(i, "offset", 0.0)
    assert light(model, "sealed").level == "good"
    model.set(i, "offset", 0.9)
    found = light(model, "sealed")
    assert found.level == "bad" and re.search("a passage is open at .*, which a half thickness of [0-9.]+ cm marks", found.text)
    assert found.advice.startswith("bring the offset nearer to 0") or found.cure is not None
    model.unset(i, "gap")
    for name in ("annulus", "stj"):
        model.set(i, name, 2.35)  # the wall is 0.125 farther, which is 0.78 half thicknesses
    levels = []
    for offset in (0.0, 0.5, 0.75):  # the band reaches 1, 0.87 and 0.66 half thicknesses beyond the attachment
        model.set(i, "offset", offset)
        levels.append(light(model, "wall").level)
    assert levels == ["good", "good", "bad"]
    model.set(i, "half_thickness", 0.06)
    model.update()
    leaks = riis.find_leaks(model.surface(i), model._region().mesh, model._at(i).marks)
    assert model.valves[i].offset == 0.75 and len(light(model, "half_thickness").edges) == leaks.n_edges > 100


def test_a_mesh_in_millimetres(fine):
    """The unit is reported and corrected. One undo reverts scale, half thickness and unit."""
    model = view.Model(10.0 * fine[0], fine[1])
    i = model.add("coapting")
    found = light(model, "unit")
    assert found.level in ("bad", "warn") and "millimetres" in found.advice and found.cure[1] == "unit"
    model.cure("unit")
    state = model.valves[i]
    assert (state.scale, state.half_thickness, model.unit) == (10.0, 1.0, "mm")
    model.cure("half_thickness")
    assert light(model, "unit").level == light(model, "sealed").level == "good"
    assert model.undo() and model.undo() and model.unit is None and model.valves[i].scale == 1.0
    metres = view.Model(0.01 * fine[0], fine[1])
    metres.add("trileaflet")
    assert "metres" in light(metres, "unit").advice
    metres.cure("unit")
    assert metres.unit == "m" and light(metres, "unit").level == "good"


def test_a_valve_outside(small):
    model = view.Model(*small, unit="cm")
    i = model.add("coapting")
    assert light(model, "inside").level == "good"
    model.place(i, (0.0, 9.0, 0.0))
    assert light(model, "inside").level == "bad" and light(model, "sealed").level == "off"
    model.cure("inside")
    assert light(model, "inside").level == "good" and abs(model.valves[i].origin[1]) < 1.0
    model.place(i, (1.0, 0.0, 0.0))
    share = share_outside(model.surface(i), 1.3 + 0.1)
    found = light(model, "inside")
    assert found.level == "warn" and found.cure is None and abs(float(re.match("([0-9]+) %", found.text)[1]) / 100 - share) < 0.02
    assert 0 < len(found.points) <= 300 and (numpy.hypot(found.points[:, 0], found.points[:, 1]) > 1.3).all()


def share_outside(surface, radius):
    """The share of the area outside a cylinder, by the middles of the triangles."""
    corners = numpy.array(surface.vertices)[surface.triangles.vertex_id]
    area = numpy.linalg.norm(numpy.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]), axis=1)
    return area[numpy.hypot(*corners.mean(axis=1)[:, :2].T) > radius].sum() / area.sum()


def test_the_light_inside_is_green_up_to_two_percent(fine):
    """The valve is shifted step by step. The light changes where the share of the area outside the cylinder passes 2 %."""
    model = view.Model(*fine, unit="cm")
    i = model.add("coapting")
    model.set(i, "half_thickness", 0.16)
    levels = {}
    for shift in numpy.linspace(0.0, 0.8, 17):
        model.place(i, (shift, 0.0, 0.0))
        share = share_outside(model.surface(i), 1.3 + 0.16)
        found = light(model, "inside")
        if abs(share - 0.02) > 0.012:
            assert found.level == ("good" if share < 0.02 else "warn"), (shift, share, found.text)
        levels[found.level] = share
    assert levels["good"] < 0.035 and levels["warn"] > 0.1


def two_cubes(path, version, groups):
    """Writes two cubes, one above the other, in the given groups. Version 2.2 of gmsh contains a cube once for each of its
    groups."""
    nodes = [(x, y, z) for z in range(3) for y in range(2) for x in range(2)]
    cubes = [[1, 2, 4, 3, 5, 6, 8, 7], [5, 6, 8, 7, 9, 10, 12, 11]]
    lines = ["$MeshFormat", f"{version} 0 8", "$EndMeshFormat", "$PhysicalNames", "4", '3 1 "all"', '3 2 "lumen"', '2 3 "lid"']
    lines += ['3 4 "wall"', "$EndPhysicalNames"]
    points = [f"{x} {y} {z}" for x, y, z in nodes]
    if version == "2.2":
        lines += ["$Nodes", "12"] + [f"{i + 1} {point}" for i, point in enumerate(points)] + ["$EndNodes"]
        elements = [(5, 2, groups[cube][k], cube + 1, *cubes[cube]) for k in range(2) for cube in range(2)]
        lines += ["$Elements", str(len(elements))] + [" ".join(map(str, (i + 1, *row))) for i, row in enumerate(elements)]
    else:
        lines += ["$Entities", "0 0 0 2"]
        for cube in range(2):
            lines.append(" ".join(map(str, (cube + 1, 0, 0, cube, 1, 1, cube + 1, len(groups[cube]), *groups[cube], 0))))
        lines += ["$EndEntities", "$Nodes", "1 12 1 12", "3 1 0 12"] + [str(i + 1) for i in range(12)] + points + ["$EndNodes"]
        lines += ["$Elements", "2 2 1 2"]
        for cube in range(2):
            lines += [f"3 {cube + 1} 5 1", " ".join(map(str, (cube + 1, *cubes[cube])))]
    path.write_text("\n".join([*lines, "$EndElements", ""]))


@pytest.mark.parametrize("version", ["2.2", "4.1"])
def test_cells_of_two_physical_groups_are_read_once(tmp_path, version):
    """Without the check for repeated cells, the view would have no wall. All groups of a cell can be chosen."""
    pytest.importorskip("pyvista", reason="PyVista is missing; ./run python installs it")
    pytest.importorskip("meshio", reason="meshio is missing; ./run python installs it")
    path = tmp_path / "twice.msh"
    two_cubes(path, version, [[1, 2], [1, 4]])
    grid = reading.read_mesh(str(path), {})
    assert grid.n_cells == 2 and grid.n_points == 12 and list(grid.cell_data["gmsh:physical"]) == [1, 1]
    assert list(grid.cell_data["gmsh:physical_2"]) == [2, 4]
    assert numpy.isclose(view.Model(**reading.arrays_of(grid))._region().wall().info.area, 10.0)
    for where, cells in (("1", [0, 1]), ("all", [0, 1]), ("lumen", [0]), ("2", [0]), ("wall", [1]), ("wall,2", [0, 1])):
        part = reading.read_mesh(str(path), cells_where=f"gmsh:physical={where}")
        assert list(part.cell_data["riis_cell_id"]) == cells, where
    with pytest.raises(riis.InvalidArgumentError, match="--cells-where: lid is not a number, nor the name of a physical group"):
        reading.read_mesh(str(path), cells_where="gmsh:physical=lid")


def test_cells_of_one_domain(tmp_path):
    """The chosen cells, and the marks of their nodes, equal those of the whole mesh. The program's files keep the choice."""
    pyvista = pytest.importorskip("pyvista", reason="PyVista is missing; ./run python installs it")
    image = pyvista.ImageData(dimensions=(25, 25, 25), spacing=3 * [1.0 / 6.0], origin=(-2.0, -2.0, -1.5))
    grid, path = image.cast_to_unstructured_grid(), tmp_path / "two.vtu"
    grid.cell_data["region"] = numpy.where(grid.cell_centers().points[:, 0] > 0.3, 7, 3)
    grid.points = numpy.asarray(grid.points, numpy.float64)
    grid.save(path)
    cells = numpy.flatnonzero(grid.cell_data["region"] == 7)
    nodes = numpy.unique(grid.cell_connectivity.reshape(-1, 8)[cells])
    part = reading.read_mesh(str(path), cells_where="region=7")
    assert numpy.array_equal(part.cell_data["riis_cell_id"], cells)
    assert numpy.array_equal(part.point_data["riis_node_id"], nodes)
    assert numpy.array_equal(part.points, grid.points[nodes])
    assert numpy.array_equal(nodes[part.cell_connectivity], grid.cell_connectivity.reshape(-1, 8)[cells].ravel())
    marks = {}
    for name, mesh, where in (("whole", grid, None), ("part", part, "region=7")):
        model = view.Model(**reading.arrays_of(mesh), path=path, cells_where=where)
        model.add("aortic")
        marks[name] = model.update().marked
    assert 0 < len(marks["part"]) and numpy.array_equal(nodes[marks["part"]], numpy.intersect1d(marks["whole"], nodes))
    assert "--cells-where=region=7" in shlex.split(model.command()) and json.loads(model.case())["cells_where"] == "region=7"
    model.save(tmp_path / "part.view.json")
    assert reading.mesh_of_saved(str(tmp_path / "part.view.json")) == (str(path), "region=7")
    assert view.Model.load(tmp_path / "part.view.json", reading.arrays_of(part)).cells_where == "region=7"
    script: dict = {}
    exec(model.python(), script)
    assert numpy.array_equal(script["marks"]["aortic"].ids, marks["part"])
    for where, text in (
        ("region", "it must be NAME=VALUES"), ("region=3,,7", "it must be NAME=VALUES"), ("=3", "it must be NAME=VALUES"),
        ("region=fluid", "--cells-where: fluid is not a number$"),
        ("domain=3", "the mesh has no cell array domain of single numbers; there are: region"),
        ("region=4", "no volume cell has such a value of region; they have 3, 7"),
    ):  # fmt: skip
        with pytest.raises(riis.InvalidArgumentError, match=text):
            reading.read_mesh(str(path), cells_where=where)


def test_crossing_leaflets(small):
    model = view.Model(*small, unit="cm")
    i = model.add("trileaflet")
    assert light(model, "crossing").level == "good"
    model.set(i, "t3_bending", 1.5)
    found = light(model, "crossing")
    crossings = riis.find_crossings(model.surface(i), depth=1e-3)
    assert crossings.n_pairs > 300 and found.level == "bad" and found.text.startswith(f"{crossings.n_pairs:,} pairs")
    assert numpy.array_equal(found.points, crossings.point[:300])
    first = crossings.triangle_id[0].tolist()
    corners = surface_of(model.valves[i]).vertices[model.update().surfaces[i].triangles[first]]
    drawn = {tuple(point) for point in found.edges.reshape(-1, 3)}
    assert all(tuple(point) in drawn for point in corners.reshape(-1, 3)) and len(found.edges) == 6 * len(found.points)
    bileaflet = view.Model(*small, unit="cm")
    bileaflet.set(bileaflet.add("bileaflet"), "ring_height", 0.4)
    assert riis.find_crossings(bileaflet.surface(0)).n_pairs > 0  # hinges in the housing, which do not count
    assert light(bileaflet, "crossing").level == "good"


def test_lights_without_cells(small):
    model = view.Model(small[0], unit="cm")
    model.add("coapting")
    levels = {one.name: one.level for one in model.lights()}
    assert levels["half_thickness"] == levels["sealed"] == levels["wall"] == "off" and levels["crossing"] == "good"
    with pytest.raises(riis.InvalidArgumentError, match="the light sealed is off and offers no cure: there are no volume cells"):
        model.cure("sealed")
    with pytest.raises(riis.InvalidArgumentError, match="name: is 'wal'; the lights are unit, inside"):
        model.cure("wal")


# ---- Time ----


def test_cycles(small, tmp_path):
    model = view.Model(*small, unit="cm")
    i, j = model.add("coapting"), model.add("mitral")
    (tmp_path / "beat.csv").write_text("# a comment\ntime; opening\n0; 0\n +.2\t1e0 ; \r\n\n0.5 0,\n")
    model.set_cycle(tmp_path / "beat.csv", 0.8, valve=i)
    model.set_cycle("mitral", 0.8, valve=j)
    steps = len(model._undo)
    model.at(0.9)
    assert model.valves[i].opening == pytest.approx(0.5) and model.time == 0.9 and len(model._undo) == steps
    law = riis.OpeningTimes(0.8 * 0.46, 0.8 * 0.07, 0.8 * 0.92, 0.8 * 0.07, period=0.8)
    assert model.valves[j].opening == law(0.9)
    curve = model.curve(9, i)
    assert numpy.allclose(curve["time"], numpy.linspace(0.0, 0.8, 9)) and model.valves[i].opening == pytest.approx(0.5)
    assert numpy.allclose(curve["opening"], numpy.interp(curve["time"], [0.0, 0.2, 0.5], [0.0, 1.0, 0.0]))
    model.at(0.1)
    assert curve["marked"][1] == (model.update().valve == i).sum() or j in model.update().valve
    assert curve["orifice"][1] == model.surface(i).orifice().area
    model.set_cycle(None)
    with pytest.raises(riis.InvalidArgumentError, match="i: valve 0 has no cycle"):
        model.curve()


def test_a_surface_that_moves(small):
    vertices = numpy.array([[-1.0, -1.0, 0.0], [1.0, -1.0, 0.0], [0.0, 1.0, 0.0]])
    frames = numpy.stack([vertices, vertices + (0.0, 0.0, 1.0)])
    model = view.Model(*small)
    i = model.add_surface(frames, [[0, 1, 2]], times=[0.0, 2.0], half_thickness=0.2)
    model.at(1.0)
    surface = riis.Surface.from_arrays(vertices + (0.0, 0.0, 0.5), numpy.array([[0, 1, 2]]), half_thickness=0.2)
    marks = riis.mark(surface, riis.Mesh(small[0]))
    assert len(marks) > 5 and numpy.array_equal(model.update().marked, marks.ids)
    assert model.period(i) == 2.0 and model.values(i) == {}
    with pytest.raises(riis.InvalidArgumentError, match="valve 0: its surface has no file"):
        model.case()
    with pytest.raises(riis.InvalidArgumentError, match="a surface from a file; OpenFOAM's plug-in takes only the kinds"):
        model.openfoam()


# ---- Files ----


def program_riis():
    for path in [os.environ.get("RIIS_PROGRAM"), ROOT / "build/bin/riis"]:
        if path and os.access(path, os.X_OK):
            return str(path)
    pytest.skip("the program riis is not built; ./run demo builds it")


def write_mesh(path, points, cells):
    lines = ["# vtk DataFile Version 3.0", "tube", "ASCII", "DATASET UNSTRUCTURED_GRID", f"POINTS {len(points)} double"]
    lines += [" ".join(map(repr, point)) for point in points.tolist()]
    lines += [f"CELLS {len(cells)} {5 * len(cells)}"] + ["4 " + " ".join(map(str, cell)) for cell in cells.tolist()]
    path.write_text("\n".join([*lines, f"CELL_TYPES {len(cells)}", *["10"] * len(cells)]) + "\n")


@pytest.mark.parametrize("unit", [None, "mm"])
def test_python_lines_give_the_same_bits(unit, small, random):
    mesh = (small[0] * view.UNITS[unit] if unit else small[0], small[1])
    for kind in view.KINDS:
        model = view.Model(*mesh, unit=unit)
        i = model.add(kind)
        size = 0.2 * view.UNITS[unit or "cm"]
        model.place(i, size * random.normal(size=3), axis=(0, 0, 1) + 0.5 * random.normal(size=3))
        model.set(i, "opening", random.uniform())
        parameters = [one for one in model.parameters(kind) if one.n_values == 1 and one.unit == "length" and one.default]
        for parameter in random.choice(len(parameters), 2, replace=False):
            model.set(i, parameters[parameter].name, parameters[parameter].default * random.uniform(0.98, 1.02))
        model.set(i, "triangulation", "fixed" if random.uniform() < 0.5 else "adapted")
        model.set(i, "offset", random.uniform(-0.9, 0.9))
        lines = {"points": mesh[0]}
        exec(model.python(), lines)
        shown, marks = model.update(), lines["marks"][kind]
        assert len(marks) > 10 and numpy.array_equal(marks.ids, shown.marked)
        assert numpy.array_equal(marks.distance, shown.distance)
        assert numpy.count_nonzero(lines["K"]) == len(marks)


def test_the_program_gives_the_same_bits(tmp_path, small, random):
    """riis mark marks the same nodes at the same distances, by the command for one valve and by the case for two."""
    pyvista = pytest.importorskip("pyvista", reason="PyVista is missing; ./run python installs it")
    program = program_riis()
    points = 10.0 * small[0]
    write_mesh(tmp_path / "a tube.vtk", points, small[1])
    for number, kind in enumerate(view.KINDS):
        model = view.Model(points, small[1], unit="mm", path=tmp_path / "a tube.vtk")
        i = model.add(kind)
        model.place(i, random.normal(size=3), axis=(0, 0, 1) + 0.3 * random.normal(size=3), scale=None if number % 2 else 9.7)
        model.set(i, "opening", random.uniform())
        model.set(i, "half_thickness", random.uniform(1.5, 2.0))
        name = "annulus" if "annulus" in model.values(i) else "AP_diameter"
        model.set(i, name, 0.95 * model.values(i)[name])
        if model.most_bumps(i):
            model.place_bump(i, 1, commissure=1)
            model.set(i, "bump_1.open", 0.3)
        if kind in ("bicuspid", "quadricuspid"):
            model.set(i, "cusp_1.sector", 1.1 * model.values(i)["cusp_1.sector"])
        if kind != "bileaflet":
            model.set(i, "translation", (0.1, -0.05, random.uniform()))
        model.set(i, "triangulation", "fixed" if number < 3 else "adapted")
        model.set(i, "offset", (0.0, 0.75, -0.3, 0.5, 0.95)[number % 5])
        command = model.command(program=program, output=str(tmp_path / "marked.vtu"))
        done = subprocess.run(command, shell=True, capture_output=True, text=True, check=False)
        assert done.returncode == 0, done.stderr
        made, shown = pyvista.read(tmp_path / "marked.vtu").point_data, model.update()
        assert numpy.array_equal(numpy.flatnonzero(made["riis_marked"]), shown.marked) and len(shown.marked) > 20
        assert numpy.array_equal(made["riis_distance"][shown.marked], shown.distance)
        assert numpy.array_equal(made["riis_leaflet"][shown.marked], shown.leaflet)
    other = model.add("trileaflet")
    model.place(other, (0.0, 0.0, -8.0))
    (tmp_path / "two.json").write_text(model.case())
    command = model.command(program=program, case=str(tmp_path / "two.json"), output=str(tmp_path / "two.vtu"))
    done = subprocess.run(shlex.split(command), capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    made, shown = pyvista.read(tmp_path / "two.vtu").point_data, model.update()
    nearest = numpy.full(len(points), numpy.inf)
    for state in model.valves:
        marked = made[f"{state.name}_marked"] == 1
        nearest[marked] = numpy.minimum(nearest[marked], made[f"{state.name}_distance"][marked])
    assert numpy.array_equal(numpy.flatnonzero(numpy.isfinite(nearest)), shown.marked)
    assert numpy.array_equal(nearest[shown.marked], shown.distance)


def test_the_program_marks_a_surface_from_a_file(tmp_path, small):
    """A surface in the mesh's unit is beside a valve. The case, and the command for the surface alone, are tested."""
    pyvista = pytest.importorskip("pyvista", reason="PyVista is missing; ./run python installs it")
    program = program_riis()
    write_mesh(tmp_path / "tube.vtk", *small)
    shape = pyvista.Sphere(radius=0.7, theta_resolution=12, phi_resolution=9)
    shape.save(tmp_path / "ball.vtp")
    read = pyvista.read(tmp_path / "ball.vtp")
    model = view.Model(*small, unit="cm", path=tmp_path / "tube.vtk")
    i = model.add_surface(read.points, read.regular_faces, path=tmp_path / "ball.vtp", half_thickness=0.15)
    model.set(i, "offset", 0.5)
    model.place(i, (0.1, 0.2, 0.3), axis=(1.0, 1.0, 0.0), scale=1.2)
    assert model.valves[i].name == "ball"
    with pytest.raises(riis.InvalidArgumentError, match="name: is 'gap'; a surface has half_thickness, offset, resistance"):
        model.set(i, "gap", 1.0)
    for kinds in ([], ["coapting"]):
        for kind in kinds:
            model.add(kind)
        (tmp_path / "case.json").write_text(model.case())
        command = model.command(program=program, case=str(tmp_path / "case.json"), output=str(tmp_path / "marked.vtu"))
        done = subprocess.run(shlex.split(command), capture_output=True, text=True, check=False)
        assert done.returncode == 0, done.stderr
        made = pyvista.read(tmp_path / "marked.vtu").point_data
        for k, state in enumerate(model.valves):
            nodes, distance, _ = model.marks_of(k)
            name = state.name if kinds else "riis"
            assert len(nodes) > 20 and numpy.array_equal(numpy.flatnonzero(made[f"{name}_marked"]), nodes)
            assert numpy.array_equal(made[f"{name}_distance"][nodes], distance)
    lines = {}
    exec(model.python(), lines)
    assert numpy.array_equal(lines["marks"]["ball"].ids, model.marks_of(i)[0])


def test_several_valves_that_move_are_what_is_seen(tmp_path, small, random):
    """Two valves beat, and a surface moves by frames. Case, command and Python lines are tested at a time of the beat."""
    pyvista = pytest.importorskip("pyvista", reason="PyVista is missing; ./run python installs it")
    program = program_riis()
    write_mesh(tmp_path / "tube.vtk", *small)
    shape = pyvista.Sphere(radius=0.5, theta_resolution=12, phi_resolution=9)
    shape.cell_data["riis_leaflet"] = random.integers(0, 3, shape.n_cells).astype(numpy.int32)
    lines = ['<?xml version="1.0"?>', '<VTKFile type="Collection" version="0.1"><Collection>']
    for k, time in enumerate((0.25, 0.5, 0.75)):
        frame = shape.copy()
        frame.points = frame.points * (1.0 + 0.2 * k) + (0.1 * k, 0.0, -0.9)
        frame.save(tmp_path / f"ball_{k}.vtp")
        lines.append(f'<DataSet timestep="{time}" part="0" file="ball_{k}.vtp"/>')
    (tmp_path / "ball.pvd").write_text("\n".join([*lines, "</Collection></VTKFile>"]))
    model = view.Model(*small, unit="cm", path=tmp_path / "tube.vtk")
    for number, kind in enumerate(("coapting", "mitral")):
        model.place(model.add(kind), (0.0, 0.0, 1.2 * number))
    assert model.span == (0.0, 0.0)
    model.beat(0.8, chosen="slow", valve=0)
    assert [state.cycle.source for state in model.valves] == ["slow", "mitral"] and model.span == (0.0, 0.8)
    model.beat(1.0, chosen="aortic", valve=0)
    assert [(state.cycle.source, state.cycle.period) for state in model.valves] == [("aortic", 1.0), ("mitral", 1.0)]
    ends = model.undo() and [(state.cycle.source, state.cycle.period) for state in model.valves]
    assert ends == [("slow", 0.8), ("mitral", 0.8)]  # one step for both

    def check():
        """Compares the files with the model's marks."""
        output = tmp_path / "marked.vtu"
        (tmp_path / "case.json").write_text(model.case())
        command = model.command(program=program, case=str(tmp_path / "case.json"), output=str(output))
        is_series = ".pvd" in command
        words = [*shlex.split(command), *["--all-cells"] * is_series]
        done = subprocess.run(words, capture_output=True, text=True, check=False)
        assert done.returncode == 0, done.stderr
        if is_series:
            output = tmp_path / "marked/marked_0000.vtu"
        made, namespace = pyvista.read(output).point_data, {}
        exec(model.python(), namespace)
        for k, state in enumerate(model.valves):
            nodes, distance, leaflet = model.marks_of(k)
            assert len(nodes) > 20 and numpy.array_equal(numpy.flatnonzero(made[f"{state.name}_marked"]), nodes), state.name
            assert numpy.array_equal(made[f"{state.name}_distance"][nodes], distance)
            marks = namespace["marks"][state.name]
            assert numpy.array_equal(marks.ids, nodes) and numpy.array_equal(marks.distance, distance)
            assert numpy.array_equal(marks.leaflet_id, leaflet)

    model.at(0.61)
    assert 0.0 < model.valves[0].opening != model.valves[1].opening > 0.0
    check()
    i = model.add_surface(**reading.read_surface(str(tmp_path / "ball.pvd")), path=tmp_path / "ball.pvd", half_thickness=0.1)
    assert model.span == (0.0, 0.8) and model.period(i) == 0.5
    model.at(0.61)
    model.set(0, "opening", 0.123)  # by hand, beside its cycle
    check()
    other = model.add_surface(**reading.read_surface(str(tmp_path / "ball.pvd")), path=tmp_path / "ball.pvd")
    with pytest.raises(riis.InvalidArgumentError, match="the surfaces are at different times, and a case has one: ball at 0.61"):
        model.case()
    model.remove(other)
    for k in (1, 0):
        model.remove(k)
    assert model.span == (0.25, 0.75)


def test_a_case_that_moves(tmp_path, small):
    """The program plays the cycle of the case, and at each time marks the same nodes as the model at that time."""
    pyvista = pytest.importorskip("pyvista", reason="PyVista is missing; ./run python installs it")
    program = program_riis()
    write_mesh(tmp_path / "tube.vtk", *small)
    (tmp_path / "beat.csv").write_text("time,opening\n0,0\n0.3,1\n")
    for cycle in ("aortic", tmp_path / "beat.csv"):
        model = view.Model(*small, unit="cm", path=tmp_path / "tube.vtk")
        model.set(model.add("coapting"), "half_thickness", 0.2)
        model.set_cycle(cycle, 0.8)
        (tmp_path / "case.json").write_text(model.case(times=[0.0, 0.07, 0.1]))
        command = [program, "mark", "--case", tmp_path / "case.json", "--output", tmp_path / "beat.pvd", "--all-cells"]
        done = subprocess.run(command, capture_output=True, text=True, check=False)
        assert done.returncode == 0, done.stderr
        for step, time in enumerate([0.0, 0.07, 0.1]):
            model.at(time)
            made, shown = pyvista.read(tmp_path / f"beat/beat_{step:04}.vtu").point_data, model.update()
            assert numpy.array_equal(numpy.flatnonzero(made["riis_marked"]), shown.marked), (step, done.stdout)
            assert numpy.array_equal(made["riis_distance"][shown.marked], shown.distance)


@pytest.mark.parametrize("unit", ["m", "cm", "mm"])
@pytest.mark.parametrize("scale", [1.0, 0.97])
def test_r_is_in_kilograms_metres_and_seconds(tmp_path, small, unit, scale):
    """The command, the case, the script and the dictionary give the same K, even if a scale hides the unit from the program."""
    pyvista = pytest.importorskip("pyvista", reason="PyVista is missing; ./run python installs it")
    program = program_riis()
    metres = {"m": 1.0, "cm": 1e-2, "mm": 1e-3}[unit]
    points = 0.01 / metres * small[0]
    write_mesh(tmp_path / "tube.vtk", points, small[1])
    model = view.Model(points, small[1], unit=unit, path=tmp_path / "tube.vtk")
    i = model.add("coapting")
    model.set(i, "half_thickness", 0.002 / metres)
    model.place(i, scale=scale * 0.01 / metres)
    model.set(i, "resistance", "1e5 g/(cm s)")
    marks = riis.mark(model.surface(i), riis.Mesh(points))
    expected = numpy.zeros(len(points))  # kg/(m3 s)
    distance = marks.distance * metres
    expected[marks.ids] = 1e4 / 0.002 * (1 + numpy.cos(numpy.pi * distance / 0.002)) / (2 * 0.002)
    kilograms = 1.0 if unit == "m" else 1e-3
    lines = {}
    exec(model.python(), lines)
    (tmp_path / "case.json").write_text(model.case())
    made = [lines["K"]]
    for words in [shlex.split(model.command(program=program, output=str(tmp_path / "command.vtu"))),
                  [program, "mark", "--case", tmp_path / "case.json", "--output", tmp_path / "case.vtu"]]:
        done = subprocess.run(words, capture_output=True, text=True, check=False)
        assert done.returncode == 0, done.stderr
        made.append(pyvista.read(words[-1].removeprefix("--output=") if isinstance(words[-1], str) else words[-1])
                    .point_data["riis_K"])
    for K in made:
        assert numpy.allclose(K * kilograms / metres**3, expected, rtol=0, atol=1e-9 * expected.max())
    assert "    resistance 10000.0;  // [kg/(m s)]" in model.openfoam()
    assert {"m": "kg/(m3 s)", "cm": "g/(cm3 s)", "mm": "g/(mm3 s)"}[unit] in model.python()


def test_r_of_a_mesh_without_a_unit(small):
    model = view.Model(*small)
    i = model.add("coapting")
    assert "--resistance=10000.0" in model.command() and "add_resistance(K, R=10000.0)" in model.python()
    with pytest.raises(riis.InvalidArgumentError, match="resistance: is '1 Pa s', which has a unit; the unit of the mesh"):
        model.set(i, "resistance", "1 Pa s")
    with pytest.raises(riis.InvalidArgumentError, match="resistance: 'Pa' is not a unit of a resistance"):
        model.set(i, "resistance", "1 Pa")


def test_openfoam_s_dictionary(small):
    """The dictionary has the numbers of the model in metres, and the law of its cycle."""
    model = view.Model(10.0 * small[0], small[1], unit="mm")
    i = model.add("mitral")
    model.set(i, "translation", (0.1, 0.2, 0.3))
    model.place(i, (10.0, 0.0, 5.0), axis=(1.0, 0.0, 0.0))
    text = model.openfoam()
    words = text.replace("(", " ( ").replace(")", " ) ").replace(";", " ;").split()

    def entry(key):
        at = words.index(key) + 1
        return [float(word) for word in words[at : words.index(";", at)] if word not in "()"]

    assert entry("scale") == [0.01] and numpy.allclose(entry("translation"), [0.1, 0.2, 0.3])
    assert entry("halfThickness") == [0.001]
    placement = text[text.index("placement") :]
    assert numpy.allclose([float(x) for x in re.search(r"translation \((.*)\)", placement)[1].split()], [0.01, 0.0, 0.005])
    assert text.count("{") == text.count("}") and "law constant" in text
    model.set_cycle("mitral", 0.9)
    assert "law times;" in model.openfoam() and "period 0.9;" in model.openfoam()
    assert "offset" not in text
    model.set(i, "offset", 0.75)
    assert "    halfThickness 0.001;  // [m]\n    offset 0.75;\n" in model.openfoam()
    with pytest.raises(riis.InvalidArgumentError, match="density: is 0; it must be above 0"):
        model.openfoam(0)


def test_a_session_opens_as_it_was(tmp_path, small, random):
    model = placed_model(small, view.KINDS, random, unit="cm", path="tube.vtu")
    model.set(0, "name", "my.valve")
    model.set_cycle("aortic", 0.8, valve=1)
    (tmp_path / "beat.csv").write_text("0 0\n0.1 1\n")
    model.set_cycle(tmp_path / "beat.csv", 0.9, valve=2, interpolation="cubic")
    vertices = random.normal(size=(2, 3, 3))
    model.add_surface(vertices, [[0, 1, 2]], times=[0.0, 1.0], period=2.0, path="leaf let.pvd", leaflet_id=[4])
    model.at(0.07)
    model.save(tmp_path / "session.json")
    opened = [view.Model.load(tmp_path / "session.json", {"points": small[0], "cells": small[1]}),
              view.Model.load(tmp_path / "session.json", lambda path: {"points": small[0], "cells": small[1], "path": path,
                                                                      "near": True})]
    for other in opened:
        assert (other.unit, other.path, other.time, other.can_undo) == ("cm", "tube.vtu", 0.07, False)
        a, b = model.update(), other.update()
        for name in ("marked", "leaflet", "distance", "valve", "cells_marked", "cells_partly"):
            assert numpy.array_equal(getattr(a, name), getattr(b, name)), name
        for one, two in zip(model.valves, other.valves, strict=True):
            assert (one.name, one.kind, one.parameters, one.opening, one.rotation, one.origin, one.scale, one.resistance,
                    one.triangulation, one.offset) == (two.name, two.kind, two.parameters, two.opening, two.rotation,
                                                       two.origin, two.scale, two.resistance, two.triangulation, two.offset)
        for each in (model, other):
            each.at(0.42)
        assert numpy.array_equal(model.update().distance, other.update().distance)
        model.at(0.07)
        other.save(tmp_path / "again.json")
        other.at(0.07)
        other.save(tmp_path / "again.json")
        assert (tmp_path / "again.json").read_text() == (tmp_path / "session.json").read_text()


# ---- Refusals ----


NAN, INF = float("nan"), float("inf")
LAW = {"times": [0.0, 1.0], "openings": [0.0, 1.0], "interpolation": "linear"}


def damaged(tmp_path, small, change):
    model = view.Model(*small)
    model.add("coapting")
    path = tmp_path / "session.json"
    model.save(path)
    root = json.loads(path.read_text())
    change(root)
    path.write_text(json.dumps(root))
    return lambda: view.Model.load(path, {"points": small[0], "cells": small[1]})


def test_refused_sessions(tmp_path, small):
    (tmp_path / "no.json").write_text("{}")
    for change, message in [
        (lambda root: root.update(version=7), "has the version 7"),
        (lambda root: root.pop("valves"), "is damaged: KeyError 'valves'"),
        (lambda root: root.update(n_nodes=5), f"is of a mesh with 5 nodes; this one has {len(small[0])}"),
        (lambda root: root.update(unit="inch"), "is damaged: ValueError unit is 'inch'"),
        (lambda root: root["valves"][0].update(kind="pulmonary"), "kind is 'pulmonary'"),
        (lambda root: root["valves"][0].update(opening=3.0), "is damaged: opening: is 3.0; it must be from 0 to 1"),
        (lambda root: root["valves"][0].update(half_thickness=-1.0), "is damaged: half_thickness: is -1.0"),
        (lambda root: root["valves"][0].update(scale=0), "is damaged: scale: is 0"),
        (lambda root: root["valves"][0].update(offset="far"), "is damaged: offset: is 'far'; it must be a finite number"),
        (lambda root: root["valves"][0].update(offset=1.0), "offset is 1; it must be above -1 and below 1"),
        (lambda root: root["valves"][0].update(origin=[0, 0]), "is damaged: ValueError"),
        (lambda root: root["valves"][0].update(time=NAN), "is damaged: time: is nan; it must be a finite number"),
        (lambda root: root["valves"][0].update(cycle={"source": 1, "period": 1.0, "law": {}}), "source of the cycle is 1"),
        (lambda root: root["valves"][0].update(cycle={"source": "", "period": -1.0, "law": LAW}), "period: is -1.0; it must be"),
        (lambda root: root["valves"].append(root["valves"][0]), "the names of the valves are coapting, coapting"),
        (lambda root: root.update(time=INF), "is damaged: time: is inf; it must be a finite number"),
        (lambda root: root.update(mesh=7), "is damaged: ValueError mesh is 7"),
        (lambda root: root["valves"][0]["parameters"].update(gap=1e99), "parameter 'gap' is 1e\\+99"),
    ]:
        with pytest.raises(riis.Error, match=message):
            damaged(tmp_path, small, change)()
    for path, message in [("no.json", "is not a session of the view"), ("none.json", "cannot be read as a session")]:
        with pytest.raises(riis.InvalidArgumentError, match=message):
            view.Model.load(tmp_path / path, {"points": small[0]})
    view.Model(*small, path="m.vtu").save(tmp_path / "s.json")
    with pytest.raises(riis.InvalidArgumentError, match="mesh: is None; pass the arrays of m.vtu, or a function that reads them"):
        view.Model.load(tmp_path / "s.json")


@pytest.mark.parametrize("change, error, message", [
    (lambda m: m.add("pulmonary"), riis.InvalidArgumentError, "kind: is 'pulmonary'; it must be one of coapting, bicuspid"),
    (lambda m: m.set(0, "opening", 1.5), riis.InvalidArgumentError, "opening: is 1.5; it must be from 0 to 1"),
    (lambda m: m.set(0, "opening", NAN), riis.InvalidArgumentError, "opening: is nan; it must be a finite number"),
    (lambda m: m.set(0, "gap", -1), riis.InvalidParameterError, "parameter 'gap' is -1; it must be from"),
    (lambda m: m.set(0, "gap", "wide"), riis.InvalidArgumentError, "gap: is 'wide'; it must be a finite number"),
    (lambda m: m.set(0, "coaptation_height", 1.3), riis.InvalidParameterError, "coaptation_height"),
    (lambda m: m.set(0, "gapp", 1), riis.UnknownParameterError, "name: is 'gapp'; a coapting valve has annulus"),
    (lambda m: m.set(0, "half_thickness", 0), riis.InvalidArgumentError, "half_thickness: is 0; it must be above 0"),
    (lambda m: m.set(0, "scale", -2.0), riis.InvalidArgumentError, "scale: is -2.0; it must be above 0"),
    (lambda m: m.set(0, "resistance", -1), riis.InvalidArgumentError, "resistance: is -1; it must be at least 0"),
    (lambda m: m.set(0, "triangulation", "x"), riis.InvalidArgumentError, "triangulation: is 'x'; it must be adapted or fixed"),
    (lambda m: m.set(0, "name", "a b"), riis.InvalidArgumentError, "name: is 'a b'; it must have 1 to 64 characters: letters"),
    (lambda m: m.set(2, "gap", 1), riis.InvalidArgumentError, "i: is 2; there are 1 valves, from 0"),
    (lambda m: m.unset(0, "gapp"), riis.UnknownParameterError, "name: is 'gapp'"),
    (lambda m: m.place(0, (0, 0)), riis.InvalidArgumentError, r"origin: is \(0, 0\); it must be three finite numbers"),
    (lambda m: m.place(0, axis=(0, 0, 0)), riis.InvalidArgumentError, r"axis: is \(0.0, 0.0, 0.0\); a direction must not be"),
    (lambda m: m.place(0, axis=(0, 0, 1), reference=(0, 0, 2)), riis.InvalidArgumentError, "which is along the axis"),
    (lambda m: m.place(0, scale=INF), riis.InvalidArgumentError, "scale: is inf; it must be a finite number"),
    (lambda m: m.place_by_clicks(0, [[0, 0, 0]]), riis.InvalidArgumentError, r"points3: has the shape \(1, 3\)"),
    (lambda m: m.place_by_clicks(0, [[0, 0, 0], [1, 0, 0], [1, 0, 0]]), riis.InvalidArgumentError,
     r"points3: points 1 and 2 are in one place, \(1.0, 0.0, 0.0\)"),
    (lambda m: m.place_by_clicks(0, [[0, 0, 0], [1, 0, 0], [2, 0, 1e-4]]), riis.InvalidArgumentError, "are on a line"),
    (lambda m: m.place_by_clicks(0, [[0, 0, NAN], [1, 0, 0], [2, 0, 1]]), riis.InvalidArgumentError, "points3: point 0 is"),
    (lambda m: m.place_by_clicks(0, [[90, 0, 0], [0, 90, 0], [-90, 0, 0]]), riis.InvalidArgumentError,
     "are on a circle of radius 90, and that of the valve is 1.25: choose the mesh's unit"),
    (lambda m: m.place_by_landmarks(0, {"nadir": numpy.eye(3)}), riis.InvalidArgumentError, "commissure"),
    (lambda m: m.place_by_landmarks(0, {}, warp="bent"), riis.InvalidArgumentError, "warp is 'bent'; it must be none, exact"),
    (lambda m: m.add_surface([[0, 0]], [[0, 1, 2]]), riis.InvalidArgumentError, r"vertices: has the shape \(1, 2\)"),
    (lambda m: m.add_surface(numpy.eye(3), [[0, 1, 7]]), riis.InvalidSurfaceError, "7"),
    (lambda m: m.add_surface(numpy.zeros((2, 3, 3)), [[0, 1, 2]]), riis.InvalidArgumentError, "times: has the shape"),
    (lambda m: m.set_cycle("aortic", 0), riis.InvalidArgumentError, "period: is 0; it must be above 0"),
    (lambda m: m.set_cycle("aorta"), riis.InvalidArgumentError, "builtin_or_csv: 'aorta' is neither aortic, mitral, slow nor a"),
    (lambda m: m.set_cycle("mitral", valve=3), riis.InvalidArgumentError, "i: is 3"),
    (lambda m: m.at(INF), riis.InvalidArgumentError, "time: is inf"),
    (lambda m: m.curve(1), riis.InvalidArgumentError, "n: is 1; it must be from 2 to 10000"),
])
def test_refused_changes(change, error, message, small):
    """A refused change names the value, and changes nothing."""
    model = view.Model(*small, unit="cm")
    model.add("coapting")
    before = model.valves
    with pytest.raises(error, match=message):
        change(model)
    assert model.valves == before and model.undo() and not model.can_undo


def test_refused_meshes(small):
    points, cells = small
    bad = points.copy()
    bad[7, 1] = INF
    far = cells.copy()
    far[3, 2] = len(points)
    for error, message, make in [
        (riis.InvalidMeshError, "y of node 7 is inf", lambda: view.Model(bad, cells)),
        (riis.InvalidMeshError, "y of node 7 is inf", lambda: view.Model.near(bad, cells)),
        (riis.InvalidArgumentError, r"points: has the shape \(3,\)", lambda: view.Model(numpy.zeros(3))),
        (riis.InvalidMeshError, "points: there are none", lambda: view.Model(numpy.zeros((0, 3)))),
        (riis.InvalidMeshError, f"cells: none of the {len(cells)} is a volume cell, they are triangles",
         lambda: view.Model(points, cells[:, :3])),
        (riis.InvalidMeshError, "cells: none of the 2 is a volume cell, they are quads and triangles",
         lambda: view.Model(points, [0, 1, 2, 0, 1, 2, 3], offsets=[0, 3, 7], types=[5, 9])),
        (riis.InvalidMeshError, rf"cells: cell 3 has the nodes \[.*{len(points)}.*\]; the mesh has {len(points)}",
         lambda: view.Model(points, far)),
        (riis.InvalidMeshError, "cells: cell 0 of type 10 has 3 nodes; it must have 4",
         lambda: view.Model(points, [0, 1, 2], offsets=[0, 3], types=[10])),
        (riis.InvalidArgumentError, "offsets: must ascend from 0 to 4, the length of cells; they go from 0 to 3",
         lambda: view.Model(points, [0, 1, 2, 3], offsets=[0, 3])),
        (riis.InvalidArgumentError, "types: has 1 entries for", lambda: view.Model(points, cells, types=[10])),
        (riis.InvalidArgumentError, "cells: has the type float64", lambda: view.Model(points, cells * 1.0)),
        (riis.InvalidArgumentError, "unit: is 'inch'; it must be m, cm, mm", lambda: view.Model(points, cells, unit="inch")),
    ]:
        with pytest.raises(error, match=message):
            make()


@pytest.mark.parametrize("text, message", [
    ("0,0,1\n", "line 1: has 3 columns: '0,0,1'; it must have 2, time and opening"),
    ("just words\nand more\n", "line 2: the time 'and' is not a finite number"),
    ("0\n", "line 1: has 1 columns"),
    ("0,0\n1_0,1\n", "line 2: the time '1_0' is not a finite number"),
    ("0,0\n0.1,nan\n", "line 2: the opening 'nan' is not a finite number"),
    ("0,0\n0,1\n", "line 2: the time 0 is not above the time before it"),
    ("0,0\n1,1.5\n", "line 2: the opening 1.5 is not from 0 to 1"),
    ("# nothing\n", "holds no times and openings"),
    ("0,0\n7,1\n", "7"),
])
def test_refused_cycles(text, message, tmp_path, small):
    (tmp_path / "beat.csv").write_text(text)
    model = view.Model(*small)
    model.add("coapting")
    with pytest.raises(riis.InvalidArgumentError, match=message):
        model.set_cycle(tmp_path / "beat.csv", 0.8)
    assert model.valves[0].cycle is None


def test_lights_show_tiny_coordinates_as_zero(fine):
    model = view.Model(*fine, unit="cm")
    model.add("bileaflet")
    model.place(0, (0.0, 1e-7, 50.0))
    found = light(model, "inside")
    assert found.level == "bad" and re.search(r"the valve is at \(0, 0, [0-9.]+\) cm", found.text), found.text
