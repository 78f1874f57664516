# SPDX-License-Identifier: Apache-2.0
"""Marks are equal to those of a C program, to the last bit, for any layout of the arrays and any search."""

import re
import subprocess
import warnings

import numpy
import pytest

import riis
import tube


def same(a, b):
    """Returns whether two arrays have the same shape and bits."""
    return a.dtype == b.dtype and a.shape == b.shape and a.tobytes() == b.tobytes()


def a_box(unit, n=30):
    """Returns the nodes of a box of 4 cm around (7, 8, 9) cm, in a unit with this length for each centimetre."""
    axes = [unit * (middle + numpy.linspace(-2.0, 2.0, n)) for middle in (7.0, 8.0, 9.0)]
    return numpy.stack(numpy.meshgrid(*axes, indexing="ij"), axis=-1).reshape(-1, 3), axes


def warnings_of(mark):
    """Returns the warnings of riis about marks."""
    with warnings.catch_warnings(record=True) as found:
        warnings.simplefilter("always")
        mark()
    assert all(issubclass(one.category, riis.MarksWarning) and one.filename == __file__ for one in found)
    return [str(one.message) for one in found]


@pytest.mark.parametrize("unit, wrong, advice", [
    (10.0, 1.0, "scale=10, for a mesh in mm"), (0.01, 1.0, "scale=0.01, for a mesh in m"),
    (1.0, 10.0, "scale=1, for a mesh in cm"), (1.0, 0.01, "scale=1, for a mesh in cm"),
    (0.01, 10.0, "scale=0.01, for a mesh in m")])
@pytest.mark.parametrize("kind", ["coapting", "mitral"])
def test_a_wrong_scale_gives_a_warning_with_the_right_one(unit, wrong, advice, kind):
    xyz, axes = a_box(unit)
    valve, middle = riis.Valve(kind), unit * numpy.array([7.0, 8.0, 9.0])
    for mesh in riis.Mesh(xyz), riis.Mesh.grid(*axes):
        surface = riis.Surface(valve, scale=wrong, half_thickness=0.1 * min(wrong, unit), translation=middle)
        texts = warnings_of(lambda: riis.mark(surface, mesh))
        if len(riis.mark(surface, mesh)) < 100:
            assert len(texts) == 1 and "marked: the surface reaches from" in texts[0]
            assert f"The sizes suggest {advice}." in texts[0]
        elif texts:  # more than one unit may fit to a valve that is too large
            assert wrong > unit and "of the leaflets' area lies outside the mesh" in texts[0]
        surface = riis.Surface(valve, scale=unit, translation=middle)
        assert not warnings_of(lambda: riis.mark(surface, mesh)) and len(riis.mark(surface, mesh)) > 100


def test_a_valve_outside_the_mesh_gives_a_warning_with_the_middle_of_the_mesh():
    xyz, axes = a_box(1.0)
    valve = riis.Valve("coapting")
    for mesh in riis.Mesh(xyz), riis.Mesh.grid(*axes):
        [text] = warnings_of(lambda: riis.mark(riis.Surface(valve), mesh))
        assert text.startswith("no node is marked: the surface reaches from (-1.")
        assert text.endswith(", the mesh from (5, 6, 7) to (9, 10, 11). The surface lies outside the mesh. Try "
                             "riis.Surface(valve, translation=(7, 8, 9)). If these marks are right, pass allow_none=True.")
    half = (xyz[:, 0] < 7.0) & (xyz[:, 1] < 8.0)  # a corner, which the valve's box meets
    at_corner = riis.Surface(valve, half_thickness=0.02, translation=(8.15, 9.2, 8.0))
    [text] = warnings_of(lambda: riis.mark(at_corner, riis.Mesh(xyz), mask=half))
    assert "the mesh from (5, 6, 7) to (6.93, 7.93, 11)" in text
    thin = riis.Surface(valve, half_thickness=5e-4, tolerance=0.5, translation=(7.13, 8.07, 9.05))
    [text] = warnings_of(lambda: riis.mark(thin, riis.Mesh(a_box(1.0, 11)[0])))
    assert "The half thickness is 0.0005, and the nodes are about 0.4 apart" in text


def placed_tube(seed, unit, n=14, length=80.0):
    """Returns a mesh with its edges, and the true middle and axis, of a tube of radius 14 mm somewhere in space."""
    random = numpy.random.default_rng(seed)
    points, cells = tube.mesh(n, 14.0, length)
    frame = numpy.linalg.qr(random.normal(size=(3, 3)))[0]
    middle = random.uniform(-200.0, 200.0, 3)
    mesh = riis.Mesh(unit * (points @ frame.T + middle))
    mesh.set_adjacency(riis.Adjacency.from_cells(cells, len(points)))
    return mesh, unit * middle, frame[:, 2]


def pasted(text, valve):
    """Runs the calls of a warning, and returns their valve and surface."""
    calls = re.search(r"Try (?:(riis\.Valve\(.*?\)|valve\.update\(.*?\)) and )?(riis\.Surface\(valve, .*\))\..*If", text)
    names = {"riis": riis, "valve": valve}
    if calls[1]:
        made = eval(calls[1], names)
        names["valve"] = made or valve
    return names["valve"], eval(calls[2], names)


@pytest.mark.parametrize("kind, in_mm, unit, has_edges, seals", [
    ("coapting", {"annulus": 28.0}, 1.0, True, True), ("coapting", {"annulus": 28.0}, 1e-3, False, True),
    ("trileaflet", {"annulus": 28.0}, 1.0, False, True), ("bicuspid", {"annulus": 28.0}, 0.1, True, True),
    ("bileaflet", {"annulus": 28.0}, 1e-3, True, False), ("mitral_coapting", {"AP_diameter": 12.0, "ALPM_diameter": 16.0}, 1.0,
                                                          False, False)])
def test_the_calls_of_a_warning_put_a_valve_across_a_tube(kind, in_mm, unit, has_edges, seals):
    seed = round(1.0 / unit)
    mesh, middle, axis = placed_tube(seed, unit)
    if not has_edges:
        mesh = riis.Mesh(mesh.xyz)
    for valve in riis.Valve(kind, opening=0.0), riis.Valve(kind, opening=0.0, **in_mm):  # the second has sizes in mm by mistake
        for options in {}, {"scale": 10.0}, {"scale": 10.0 * unit, "translation": middle}:
            texts = warnings_of(lambda: riis.mark(riis.Surface(valve, **options), mesh))
            assert len(texts) == 1
            better, surface = pasted(texts[0], valve)
            assert not warnings_of(lambda: riis.mark(surface, mesh)), texts
            # The valve is in the middle, along the tube, and reaches the wall. A closed valve parts the nodes of both ends.
            placement = surface._placement
            assert numpy.linalg.norm(placement["translation"] - middle) < 1.0 * unit
            along = (mesh.xyz - middle) @ axis
            reach = numpy.linalg.norm(numpy.cross(surface.vertices - middle, axis), axis=1).max()
            assert 13.0 * unit < reach < 15.6 * unit
            with_edges = mesh if has_edges else placed_tube(seed, unit)[0]
            ends = numpy.flatnonzero(along < -38.0 * unit), numpy.flatnonzero(along > 38.0 * unit)
            if seals:  # the others leave gaps at their hinges, or beside their annulus in a round tube
                assert riis.find_passage(surface, with_edges, *ends).state == "closed"


def test_a_warning_names_the_half_thickness_and_leaflets_that_cross():
    mesh, middle, axis = placed_tube(5, 1.0)
    bare = riis.Mesh(mesh.xyz)
    valve = riis.Valve("coapting", annulus=2.8)
    across = {"scale": 10.0, "translation": middle, "axis": axis}
    for half, on, text in (
        (2e-2, bare, "The half thickness is 0.02, and the nodes are about "),
        (40.0, bare, "The half thickness is 40, and the largest"),
        (1.0, mesh, " edges of the mesh cross the leaflets between unmarked nodes, so the valve leaks there. Try"),
    ):
        [found] = warnings_of(lambda: riis.mark(riis.Surface(valve, half_thickness=half, **across), on))
        assert text in found and "scale=" not in found and "axis=" not in found
        half = float(re.search(r"Try riis.Surface\(valve, half_thickness=(.*?)\)", found)[1])
        assert 1.0 < half < 3.5
        for opening in 0.0, 0.5, 1.0:
            surface = riis.Surface(riis.Valve("coapting", annulus=2.8, opening=opening), half_thickness=half, **across)
            assert riis.find_leaks(surface, mesh, riis.mark(surface, mesh)).n_edges == 0
            assert not warnings_of(lambda: riis.mark(surface, bare))
    crossed = riis.Valve("trileaflet", annulus=2.7, stj=2.7, bending_height=0.55, opening=0.0)
    surface = riis.Surface(crossed, half_thickness=2.6, **across)
    found = warnings_of(lambda: riis.mark(surface, bare))
    pairs = riis.find_crossings(surface, depth=surface.info.contact_depth / surface.half_thickness)
    assert len(found) == (pairs.n_pairs > 0) == 1 and "go through each other, up to " in found[0]
    assert not warnings_of(lambda: riis.mark(riis.Surface(crossed, **across), bare, allow_none=True))


def test_a_time_loop_warns_once():
    xyz, _ = a_box(1.0)
    mesh, valve, marks = riis.Mesh(xyz), riis.Valve("coapting"), riis.Marks()
    surface = riis.Surface(valve)

    def beat(mesh, **options):
        for step in range(20):
            valve["opening"] = 0.05 * step
            surface.update(valve, translation=(0, 0, 0.01 * step), **options)
            riis.mark(surface, mesh, into=marks)

    assert len(warnings_of(lambda: beat(mesh))) == 1 and not warnings_of(lambda: beat(mesh))
    assert len(warnings_of(lambda: beat(mesh, scale=0.5))) == 1  # another try
    assert len(warnings_of(lambda: beat(riis.Mesh(xyz.copy())))) == 1


def test_marks_may_be_missing():
    xyz, _ = a_box(1.0)
    valve = riis.Valve("coapting")
    assert not warnings_of(lambda: riis.mark(riis.Surface(valve), riis.Mesh(xyz), allow_none=True))
    assert not warnings_of(lambda: riis.mark(riis.Surface(valve), riis.Mesh(xyz[:999].copy())))
    assert not warnings_of(lambda: riis.mark(riis.Surface(valve), riis.Mesh(xyz), mask=numpy.zeros(len(xyz), bool)))
    marks = riis.Marks()
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        with pytest.raises(riis.MarksWarning, match="no node is marked"):
            riis.mark(riis.Surface(valve), riis.Mesh(xyz), into=marks)
        assert marks.stats.n_nodes == len(xyz) and len(marks) == 0
        warnings.simplefilter("ignore", riis.MarksWarning)
        riis.mark(riis.Surface(valve), riis.Mesh(xyz))


def lists_of(marks):
    return [numpy.array(a) for a in (marks.ids, marks.distance, marks.triangle_id, marks.leaflet_id)]


@pytest.mark.parametrize("offset", [0.0, 0.75])
def test_marks_equal_those_of_c(c_marks, xyz, tmp_path, offset):
    xyz.tofile(tmp_path / "xyz")
    subprocess.run([c_marks, tmp_path / "xyz", tmp_path / "marks", str(offset)], check=True)
    data = (tmp_path / "marks").read_bytes()
    n = int(numpy.frombuffer(data, numpy.int64, 1)[0])
    assert n > 1000
    place = 8

    def take(dtype, *shape):
        nonlocal place
        count = int(numpy.prod(shape))
        found = numpy.frombuffer(data, dtype, count, place).reshape(shape)
        place += found.nbytes
        return found

    valve = riis.Valve("mitral", opening=0.4)
    before = valve.copy()
    before["opening"] = 0.3
    surface = riis.Surface(valve, half_thickness=0.15, offset=offset)
    surface.update_moving(valve, before, 0.05)
    marks = riis.mark(surface, riis.Mesh(xyz), fields="normal, velocity")
    coefficient, momentum = numpy.zeros(len(xyz)), numpy.zeros((len(xyz), 3))
    marks.add_resistance(coefficient, momentum, R=1e4)
    assert len(marks) == n
    assert same(marks.ids, take(numpy.int64, n))
    assert same(marks.distance, take(numpy.float64, n))
    assert same(marks.triangle_id, take(numpy.int64, n))
    assert same(marks.leaflet_id, take(numpy.int32, n))
    assert same(marks.normal, take(numpy.float64, n, 3))
    assert same(marks.velocity, take(numpy.float64, n, 3))
    assert same(coefficient, take(numpy.float64, len(xyz)))
    assert same(momentum, take(numpy.float64, len(xyz), 3))
    assert hasattr(marks, "height") == (offset != 0.0)
    if offset != 0.0:
        assert same(marks.height, take(numpy.float64, n))
    assert place == len(data)
    assert numpy.count_nonzero(momentum) > 0


@pytest.mark.parametrize("offset", [0.75, -0.5])
def test_an_offset_marks_the_band_beside_the_surface(valve, xyz, offset):
    half = 0.15
    surface = riis.Surface(valve, half_thickness=half, offset=offset)
    marks = riis.mark(surface, riis.Mesh(xyz), fields="side rim", distance_limit=2.0 * half, R=2.0)
    near = marks.within_limit
    inner = near.rim == 0
    assert numpy.allclose(near.height[inner], (near.side * near.distance)[inner], rtol=0.0, atol=1e-12)
    assert numpy.all(numpy.abs(near.height) <= near.distance * (1.0 + 1e-12))
    # Beyond a rim, the distance from the middle of the band has a component along the normal and one across it.
    across = numpy.where(inner, 0.0, near.distance**2 - near.height**2).clip(0.0)
    middle = numpy.sqrt(across + (near.height - offset * half) ** 2)
    sure = numpy.abs(middle - half) > 1e-9
    assert numpy.array_equal(numpy.isin(near.ids, marks.ids)[sure], (middle <= half)[sure])
    expected = numpy.where(middle < half, 2.0 / half * (1.0 + numpy.cos(numpy.pi * middle / half)) / (2.0 * half), 0.0)
    assert numpy.allclose(near.K, expected, rtol=0.0, atol=1e-9 * expected.max())
    turned = riis.mark(riis.Surface(valve, half_thickness=half, offset=-offset, flip_normals=True), riis.Mesh(xyz))
    assert same(turned.ids, marks.ids) and same(turned.leaflet_id, marks.leaflet_id)
    assert numpy.allclose(turned.distance, marks.distance, rtol=0.0, atol=1e-14)  # turned triangles round differently
    assert numpy.allclose(turned.height, -marks.height, rtol=0.0, atol=1e-12)


def test_an_offset_of_0_changes_no_bit(valve, xyz):
    found = []
    for options in {}, {"offset": 0.0}, {"offset": -0.0}:
        made = riis.mark(riis.Surface(valve, half_thickness=0.15, **options), riis.Mesh(xyz), fields="point side rim", R=2.0)
        assert not hasattr(made, "height")
        found.append([*lists_of(made), *map(numpy.array, (made.point, made.side, made.rim, made.K))])
    assert all(map(same, found[0], found[1])) and all(map(same, found[0], found[2]))


def test_derivatives_are_central_differences():
    valve = riis.Valve("trileaflet", opening=0.4)
    placement = {"scale": 10.0, "rotation_axis": (1, 2, 3), "rotation_angle": 40.0, "translation": (3, 4, 5)}
    surface = riis.Surface(valve, triangulation="fixed", **placement)
    h = 1e-4

    def opened(by):
        made = valve.copy()
        made["opening"] = valve["opening"] + by
        return made

    surface.add_direction(opened(h), opened(-h), 2 * h)
    surface.add_direction(valve, valve, 2 * h, placement_after={"translation": (3 + h, 4, 5)},
                          placement_before={"translation": (3 - h, 4, 5)})
    points = surface.vertices + numpy.random.default_rng(7).uniform(-0.5, 0.5, surface.vertices.shape)
    marks = riis.mark(surface, riis.Mesh(points), fields="distance_gradient", distance_limit=2.0, R=3.0)
    n = len(marks.within_limit)
    assert n == len(points)
    assert marks.within_limit.distance_gradient.shape == marks.within_limit.K_gradient.shape == (n, 2)
    assert marks.distance_gradient.shape == (len(marks), 2)
    # The surface keeps its triangles while the valve opens and moves.
    sides = []
    for sign in (-1, 1):
        surface.update(opened(sign * 1e-6))
        of_opening = surface.closest_points(points).distance
        surface.update(valve, translation=(3 + sign * 1e-6, 4, 5))
        sides.append(numpy.stack([of_opening, surface.closest_points(points).distance], axis=1))
        surface.update(valve, **placement)
    slope = (sides[1] - sides[0]) / 2e-6
    off = numpy.abs(marks.within_limit.distance_gradient - slope) / numpy.abs(slope).max(axis=0)
    far = marks.within_limit.distance > 0.05
    assert numpy.mean(off[far] < 1e-5) > 0.98
    with pytest.raises(riis.InvalidArgumentError, match="no direction"):  # an update ended the directions
        riis.mark(surface, riis.Mesh(points), fields="distance_gradient")


def layouts(xyz):
    wide = numpy.full((2 * len(xyz), 5), numpy.nan)
    wide[::2, 1:4] = xyz
    backwards = numpy.ascontiguousarray(xyz[:, ::-1])
    yield "Fortran order", (numpy.asfortranarray(xyz),)
    yield "rows of a wider array", (wide[::2, 1:4],)
    yield "coordinates in reverse", (backwards[:, ::-1],)
    yield "transposed", (numpy.ascontiguousarray(xyz.T).T,)
    yield "three arrays", tuple(numpy.ascontiguousarray(xyz[:, i]) for i in range(3))
    yield "three strided arrays", (xyz[:, 0], xyz[:, 1], xyz[:, 2])


def test_layouts_of_coordinates_give_the_same_marks(surface, xyz, marks):
    for name, arrays in layouts(xyz):
        found = riis.mark(surface, riis.Mesh(*arrays))
        assert all(map(same, lists_of(found), lists_of(marks))), name


def test_searches_instructions_and_threads_give_the_same_marks(surface, grid):
    expected = lists_of(riis.mark(surface, grid, search="exhaustive", n_threads=1))
    assert len(expected[0]) > 500
    for search in "auto", "neighbor", "clusters":
        for n_threads in 1, 3:
            marks = riis.mark(surface, grid, search=search, n_threads=n_threads)
            assert all(map(same, lists_of(marks), expected)), search
            assert marks.stats.complete
    baseline = riis.mark(surface, grid, search="clusters", instructions="baseline")
    assert all(map(same, lists_of(baseline), expected))
    assert baseline.stats.instructions == "baseline" and baseline.stats.search == "clusters"
    assert not riis.mark(surface, grid, search="paper").stats.complete


def test_a_result_is_reused(surface, mesh, valve):
    marks = riis.Marks()
    assert repr(marks) == "<riis.Marks, empty>" and len(marks) == 0
    assert marks.ids.shape == marks.within_limit.distance.shape == (0,)
    assert marks.stats.n_nodes == 0 and marks.dense().mark.shape == (0,)
    for opening in 0.1, 0.9:
        valve["opening"] = opening
        surface.update(valve)
        assert riis.mark(surface, mesh, into=marks) is marks
        assert all(map(same, lists_of(marks), lists_of(riis.mark(surface, mesh))))
    assert riis.mark(surface, mesh) is not riis.mark(surface, mesh)


def test_fields_equal_those_of_closest_points(grid):
    valve = riis.Valve("trileaflet", opening=0.5)
    before = riis.Valve("trileaflet", opening=0.4)
    # The valve is shifted, so that no node lies in a plane of symmetry. In a plane of symmetry two leaflets would be equally
    # near, and the velocity would be the mean of both.
    surface = riis.Surface(valve, translation=(0.0123, 0.0217, 0.0))
    surface.update_moving(valve, before, 0.01)
    names = ["point", "normal", "barycentric", "side", "rim", "uv", "velocity", "patch_id"]
    marks = riis.mark(surface, grid, fields=names)
    n = len(marks)
    xyz = numpy.stack(numpy.meshgrid(*3 * [numpy.linspace(-2.0, 2.0, 41)], indexing="ij"), axis=-1)
    nodes = numpy.ascontiguousarray(xyz.reshape(-1, 3)[:, ::-1])[marks.ids]
    closest = surface.closest_points(nodes, barycentric=True, side=True)
    assert same(marks.distance, closest.distance)
    assert same(marks.point, closest.point)
    assert same(marks.normal, closest.normal)
    assert same(marks.barycentric, closest.barycentric)
    assert same(marks.side, closest.side)
    assert same(marks.triangle_id, closest.triangle_id)
    assert same(marks.leaflet_id, closest.leaflet_id)
    assert marks.uv.shape == (n, 2) and marks.uv.min() >= 0.0 and marks.uv.max() <= 1.0
    assert same(marks.patch_id, surface.triangles.patch_id[marks.triangle_id])
    assert set(numpy.unique(marks.rim)) == {0, 1}
    # The velocity is interpolated from the triangle's vertices by the barycentric weights.
    corners = surface.velocities[surface.triangles.vertex_id[marks.triangle_id]]
    assert numpy.allclose(marks.velocity, numpy.einsum("ij,ijk->ik", marks.barycentric, corners), rtol=1e-12, atol=1e-12)
    assert numpy.abs(marks.velocity).max() > 1.0


def test_nodes_within_the_limit(surface, mesh):
    marks = riis.mark(surface, mesh, distance_limit=0.3, fields="point")
    within = marks.within_limit
    assert len(within) == marks.stats.n_within_limit > len(marks) == marks.stats.n_marked
    assert within.distance.max() <= 0.3 and marks.distance.max() <= 0.15
    assert same(within.ids[within.distance <= 0.15], marks.ids)
    assert within.point.shape == (len(within), 3)


def test_a_mask_leaves_nodes_out(surface, mesh, marks, xyz):
    mask = xyz[:, 0] > 0.0
    for given in mask, mask.astype(numpy.uint8):
        masked = riis.mark(surface, mesh, mask=given)
        assert same(masked.ids, marks.ids[mask[marks.ids]])


def test_dense_arrays_equal_the_lists(surface, mesh):
    marks = riis.mark(surface, mesh, distance_limit=0.3)
    dense = marks.dense(triangle_id=True, leaflet_id=True)
    assert dense.mark.dtype == bool and same(numpy.flatnonzero(dense.mark), marks.ids)
    within = marks.within_limit
    assert same(dense.distance[within.ids], within.distance)
    assert same(dense.triangle_id[within.ids], within.triangle_id)
    assert same(dense.leaflet_id[within.ids], within.leaflet_id)
    far = numpy.delete(numpy.arange(len(mesh)), within.ids)
    assert numpy.all(dense.distance[far] == riis.FAR_DISTANCE) and numpy.all(dense.triangle_id[far] == -1)
    given = numpy.empty(len(mesh))
    nan = marks.dense(mark=False, distance=given, far_distance=numpy.nan)
    assert nan.distance is given and nan.mark is None and nan.leaflet_id is None
    assert numpy.isnan(given[far]).all() and same(given[within.ids], within.distance)


def test_resistance_adds_the_formula(surface, mesh, marks):
    coefficient = numpy.ones(len(mesh))
    marks.add_resistance(coefficient, R=2.0, half_thickness=0.1)
    eps, d = 0.1, marks.distance
    delta = numpy.where(d < eps, (1.0 + numpy.cos(numpy.pi * numpy.minimum(d, eps) / eps)) / (2.0 * eps), 0.0)
    expected = numpy.ones(len(mesh))
    expected[marks.ids] += 2.0 / eps * delta
    assert numpy.allclose(coefficient, expected, rtol=1e-12)
    weight, velocity = numpy.full(len(mesh), 0.5), numpy.tile([1.0, 2.0, 3.0], (len(mesh), 1))
    force = marks.add_reaction(velocity, weight, R=2.0, half_thickness=0.1)
    assert numpy.allclose(force, 0.5 * (coefficient - 1.0).sum() * numpy.array([1.0, 2.0, 3.0]), rtol=1e-9)
    assert marks.add_reaction(velocity, weight, force, R=2.0, half_thickness=0.1) is force
    assert numpy.allclose(force, (coefficient - 1.0).sum() * numpy.array([1.0, 2.0, 3.0]), rtol=1e-9)


def test_reactions_by_leaflet_and_edge_add_up(surface, mesh):
    marks = riis.mark(surface, mesh, fields=["point"])
    random = numpy.random.default_rng(5)
    weight, velocity = random.random(len(mesh)), random.random((len(mesh), 3))
    attachment, n = surface.attachment, surface.info.largest_leaflet_id + 1
    assert n == 2 and attachment.edges.shape == (len(attachment.leaflet_id), 2, 3)
    assert same(attachment.edges, surface.vertices[attachment.vertex_id])
    assert same(attachment.leaflet_id, (attachment.patch_id >= 6).astype("int32")) and set(attachment.patch_id) == set(range(10))
    of_leaflets, of_edges = numpy.zeros((2, n, 3)), numpy.zeros((2, len(attachment.edges), 3))
    moment, about = numpy.zeros(3), numpy.array([1.0, -2.0, 0.5])
    force = marks.add_reaction(
        velocity, weight, R=2.0, moment=moment, about=about, leaflet_force=of_leaflets[0], leaflet_moment=of_leaflets[1],
        edges=attachment.edges, edge_force=of_edges[0], edge_moment=of_edges[1], edge_leaflet_id=attachment.leaflet_id)
    coefficient = numpy.zeros(len(mesh))
    marks.add_resistance(coefficient, R=2.0)
    each = (weight * coefficient)[marks.ids, None] * velocity[marks.ids]
    turning = numpy.cross(marks.point - about, each)
    assert numpy.allclose(force, each.sum(axis=0), rtol=1e-12) and numpy.allclose(moment, turning.sum(axis=0), rtol=1e-11)
    middle = attachment.edges.mean(axis=1)
    for leaflet in range(n):
        mine = marks.leaflet_id == leaflet
        assert numpy.allclose(of_leaflets[0, leaflet], each[mine].sum(axis=0), rtol=1e-12)
        assert numpy.allclose(of_leaflets[1, leaflet], turning[mine].sum(axis=0), rtol=1e-11, atol=1e-9)
        here = attachment.leaflet_id == leaflet
        edge_force = of_edges[0, here]
        assert numpy.allclose(edge_force.sum(axis=0), of_leaflets[0, leaflet], rtol=1e-12)
        moved = of_edges[1, here] + numpy.cross(middle[here] - about, edge_force)
        assert numpy.allclose(moved.sum(axis=0), of_leaflets[1, leaflet], rtol=1e-11, atol=1e-9)


def test_the_rim_is_cut(surface, mesh):
    marks = riis.mark(surface, mesh, fields=["rim"])
    whole, cut = numpy.zeros(len(mesh)), numpy.zeros(len(mesh))
    marks.add_resistance(whole, R=1.0)
    marks.add_resistance(cut, R=1.0, rim="cut")
    rim = marks.rim == 1
    assert rim.any() and not cut[marks.ids[rim]].any()
    assert same(cut[marks.ids[~rim]], whole[marks.ids[~rim]])


def test_band_sums_are_sums_by_side(mesh, xyz):
    surface = riis.Surface(riis.Valve("mitral", opening=0.0), half_thickness=0.15)
    marks = riis.mark(surface, mesh, fields="side rim")
    value, weight = xyz[:, 0].copy(), numpy.full(len(mesh), 2.0)
    sums = marks.band_sums(value, weight, 0.05, 0.15)
    for entry, side in enumerate((-1, 1)):
        ids = marks.ids[(marks.side == side) & (marks.rim == 0) & (marks.distance >= 0.05) & (marks.distance <= 0.15)]
        assert sums.n_nodes[entry] == len(ids) > 100
        assert numpy.isclose(sums.sum[entry], 2.0 * value[ids].sum()) and sums.weight[entry] == 2.0 * len(ids)


def test_moved_coordinates_count_after_an_update(surface, xyz):
    nodes = xyz.copy()
    mesh = riis.Mesh(nodes)
    before = lists_of(riis.mark(surface, mesh))
    nodes += 0.2
    mesh.update()
    moved = lists_of(riis.mark(surface, mesh))
    assert not same(moved[0], before[0])
    assert all(map(same, moved, lists_of(riis.mark(surface, riis.Mesh(xyz + 0.2)))))
    mesh.update(xyz)
    assert all(map(same, lists_of(riis.mark(surface, mesh)), before))


def test_a_mesh_without_nodes(surface):
    marks = riis.mark(surface, riis.Mesh(numpy.empty((0, 3))), fields="normal")
    assert len(marks) == 0 and marks.ids.shape == (0,) and marks.normal.shape == (0, 3)
    marks.add_resistance(numpy.empty(0), R=1.0)
    assert marks.dense().mark.shape == (0,)


def test_a_prepared_mesh_uses_clusters(surface, xyz):
    mesh = riis.Mesh(xyz)
    mesh.prepare(1)
    assert riis.mark(surface, mesh).stats.search == "clusters"


@pytest.mark.parametrize("kind", ["aortic", "mitral", "coapting", "trileaflet", "bileaflet", "bicuspid", "quadricuspid",
                                  "mitral_coapting", "tricuspid"])
def test_kinds_of_valves_are_marked(kind, mesh):
    assert len(riis.mark(riis.Surface(riis.Valve(kind)), mesh)) > 100
