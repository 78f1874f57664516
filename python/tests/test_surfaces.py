# SPDX-License-Identifier: Apache-2.0
"""Surfaces of valves, arrays and frames, their options, and closest points."""

import numpy
import pytest

import riis

# A tetrahedron. The normals of its faces point outwards.
CORNERS = numpy.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]], float)
FACES = numpy.array([[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]])


def test_info_and_arrays_agree(surface):
    info, triangles = surface.info, surface.triangles
    assert surface.vertices.shape == (info.n_vertices, 3) and surface.uv.shape == (info.n_vertices, 2)
    assert triangles.vertex_id.shape == (info.n_triangles, 3) and surface.velocities is None
    a, b, c = (surface.vertices[triangles.vertex_id[:, i]] for i in range(3))
    assert numpy.isclose(numpy.linalg.norm(numpy.cross(b - a, c - a), axis=1).sum() / 2, info.area)
    used = surface.vertices[triangles.vertex_id.ravel()]
    assert numpy.array_equal(used.min(axis=0), info.lower) and numpy.array_equal(used.max(axis=0), info.upper)
    assert info.half_thickness == surface.half_thickness == 0.15 and 0.0 < info.error_bound <= 0.05 * 0.15


def test_options_stay_until_they_are_named(valve):
    surface = riis.Surface(valve, scale=10.0, translation=(0, 0, 5))
    assert surface.half_thickness == 1.0  # 0.1 * scale
    low = surface.info.lower
    surface.update(valve, half_thickness=0.4)
    surface.update(valve)
    assert surface.half_thickness == 0.4 and numpy.allclose(surface.info.lower, low, atol=0.05)
    surface.update(valve, half_thickness="auto", scale=1.0, translation=numpy.zeros(3))
    assert surface.half_thickness == 0.1 and surface.info.upper[2] < 3.0
    surface.update(valve, tolerance=None)
    assert surface.half_thickness == 0.1


def test_placement_turns_and_moves(valve):
    plain = riis.Surface(valve).vertices
    placed = riis.Surface(valve, scale=2.0, half_thickness=0.2, rotation_axis=[1, 0, 0], rotation_angle=90, translation=(1, 2, 3))
    expected = 2.0 * plain @ numpy.array([[1, 0, 0], [0, 0, 1], [0, -1, 0]]) + [1, 2, 3]
    assert numpy.allclose(placed.vertices, expected, atol=1e-12)


@pytest.mark.parametrize("axis", [(1, 2, 2), (0, 0, 5), (0, 0, -0.1), (-3, 0, 0), (1e-9, 0, 1), (1e-9, -1e-9, -1)])
def test_an_axis_is_the_smallest_rotation(valve, axis):
    plain, placed = riis.Surface(valve), riis.Surface(valve, axis=axis, translation=(1, 2, 3))
    # The smallest rotation from z to n is R = I + [v] + [v]^2 / (1 + n_z) with v = z x n. For n = -z it is half a turn about x.
    n = numpy.array(axis, float) / numpy.linalg.norm(axis)
    x, y = -n[1], n[0]
    v = numpy.array([[0, 0, y], [0, 0, -x], [-y, x, 0]])
    rotation = numpy.eye(3) + v + v @ v / (1.0 + n[2]) if n[2] > -0.999 else numpy.diag([1.0, -1.0, -1.0])
    if axis == (1e-9, -1e-9, -1):  # half a turn about a line across the axis
        line = numpy.array([1.0, 1.0, 0.0]) / numpy.sqrt(2.0)
        rotation = 2.0 * numpy.outer(line, line) - numpy.eye(3)
    assert numpy.allclose(rotation @ [0, 0, 1], n, atol=1e-8)
    assert numpy.allclose(placed.vertices, plain.vertices @ rotation.T + [1, 2, 3], atol=1e-8)
    placed.update(valve, translation=(0, 0, 0), rotation_axis=None)  # keeps the axis
    assert numpy.allclose(placed.vertices, plain.vertices @ rotation.T, atol=1e-8)
    placed.update_moving(valve, valve, 0.5, placement_before={"axis": axis, "translation": (0, 0, -1)})
    assert numpy.allclose(placed.velocities, [0, 0, 2])


def test_normals_flip(valve):
    point = (0.1, 0.2, 0.3)
    plain, flipped = (riis.Surface(valve, flip_normals=flip).closest_point(point) for flip in (False, True))
    assert numpy.array_equal(plain.normal, -flipped.normal) and plain.side == -flipped.side != 0


def test_the_band_steps_aside_along_the_normals(valve):
    surface = riis.Surface(valve, half_thickness=0.1, offset=0.75)
    assert surface.info.offset == 0.75
    normal, middle = surface.closest_point((0.1, 0.2, 0.3)).normal, surface.closest_point((0.1, 0.2, 0.3)).point
    heights = numpy.array([-0.026, -0.024, 0.0, 0.075, 0.174, 0.176])
    mesh = riis.Mesh(middle + heights[:, None] * normal)
    marks = riis.mark(surface, mesh, R=1.0)
    assert marks.ids.tolist() == [1, 2, 3, 4] and marks.K.argmax() == 2
    assert numpy.allclose(marks.height, heights[1:5], atol=1e-12)
    surface.update(valve, flip_normals=True)
    assert riis.mark(surface, mesh).ids.tolist() == [0, 1, 2]


def test_directions_are_differences_of_vertices(valve):
    surface = riis.Surface(valve, triangulation="fixed", scale=2.0)
    step = 1e-5
    sides = []
    for sign in (-1.0, 1.0):
        near = valve.copy()
        near["opening"] = valve["opening"] + sign * step
        surface.update(near)
        sides.append((surface.vertices, surface.info.area, near))
    surface.update(valve)
    surface.add_direction(sides[1][2], sides[0][2], 2.0 * step)
    surface.add_direction(valve, valve, 0.5, placement_after={"scale": 2.5})
    opened, grown = surface.direction(0), surface.direction(direction_id=1)
    assert opened.rates.shape == surface.vertices.shape and numpy.abs(opened.rates).max() > 0.1
    assert numpy.allclose(opened.rates, (sides[1][0] - sides[0][0]) / (2.0 * step), atol=1e-8)
    assert numpy.isclose(opened.area_rate, (sides[1][1] - sides[0][1]) / (2.0 * step), rtol=1e-6)
    assert numpy.allclose(grown.rates, surface.vertices / 2.0, atol=1e-9)
    assert numpy.isclose(grown.area_rate, surface.info.area, rtol=1e-9)  # the area grows as the square of the scale, which is 2
    before = opened.rates.copy()
    surface.update(valve)  # the arrays are copies
    assert numpy.array_equal(opened.rates, before)


def test_a_fixed_triangulation_keeps_its_triangles(valve):
    surface = riis.Surface(valve, triangulation="fixed")
    before = surface.triangles.vertex_id.copy()
    valve["opening"] = 0.6
    surface.update(valve)
    assert numpy.array_equal(surface.triangles.vertex_id, before)
    with pytest.raises(riis.InvalidParameterError, match="AP_diameter"):
        valve["AP_diameter"] = valve["AP_diameter"] * 1.01
        surface.update(valve)


def test_velocities_are_differences_over_the_step():
    valve, before = riis.Valve("mitral", opening=0.5), riis.Valve("mitral", opening=0.4)
    surface = riis.Surface(before, triangulation="fixed")
    earlier = surface.vertices.copy()
    surface.update_moving(valve, before, 0.1)
    # A vertex of fixed triangles keeps its fraction of the arc length, whereas the velocity belongs to a fixed (u, v). The two
    # motions are therefore close, but not equal.
    assert numpy.allclose(surface.velocities, (surface.vertices - earlier) / 0.1, atol=0.05)
    assert numpy.abs(surface.velocities).max() > 1.0
    surface.update_moving(valve, valve, 0.1, placement_before={"translation": (0, 0, -1)})
    assert numpy.allclose(surface.velocities, [0, 0, 10], atol=1e-9)
    surface.update(valve)
    assert surface.velocities is None


@pytest.mark.parametrize("dtype", ["i4", "i8"])
def test_a_surface_comes_from_arrays(dtype):
    leaflets, velocities = numpy.array([3, 4, 5, 6], "i4"), numpy.ones((4, 3))
    surface = riis.Surface.from_arrays(
        numpy.asfortranarray(CORNERS), FACES.astype(dtype), leaflet_id=leaflets, velocities=velocities, half_thickness=0.1
    )
    assert surface.triangles.leaflet_id.tolist() == [3, 4, 5, 6] and numpy.array_equal(surface.triangles.vertex_id, FACES)
    assert numpy.array_equal(surface.velocities, velocities) and surface.uv is None
    found = surface.closest_point([1.0, 1.0, 1.0])
    assert numpy.isclose(found.distance, 2.0 / numpy.sqrt(3.0)) and found.leaflet_id == 6 and found.side == 1
    assert numpy.allclose(found.point, 1.0 / 3.0) and numpy.allclose(found.barycentric, 1.0 / 3.0)
    one = riis.Surface.from_arrays(CORNERS, FACES.astype(dtype) + 1, index_base=1)
    assert numpy.array_equal(one.triangles.vertex_id, FACES)
    surface.update_from_arrays(CORNERS + 1.0)  # moves only the vertices
    assert numpy.array_equal(surface.info.lower, [1, 1, 1]) and surface.half_thickness == 0.1
    assert surface.triangles.leaflet_id.tolist() == [3, 4, 5, 6]
    surface.update_from_arrays(CORNERS, FACES[:1].astype(dtype))
    assert surface.info.n_triangles == 1


def test_quads_become_two_triangles_and_flat_ones_are_skipped():
    quad = riis.Surface.from_arrays(numpy.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]], float), numpy.array([[0, 1, 2, 3]]))
    assert quad.triangles.vertex_id.tolist() == [[0, 1, 2], [0, 2, 3]]
    faces = numpy.array([[0, 0, 1], [0, 1, 2]])
    surface = riis.Surface.from_arrays(CORNERS, faces, zero_area="skip")
    assert surface.info.n_zero_area == 1 and surface.triangles.triangle_id.tolist() == [1]


def test_a_surface_comes_from_keyframes():
    frames = numpy.stack([CORNERS, CORNERS + [0, 0, 1]])
    keyframes = riis.Keyframes(numpy.array([0.0, 0.5]), frames, FACES, leaflet_id=numpy.full(4, 2, "i4"))
    surface = riis.Surface.from_keyframes(keyframes, 0.25)
    assert numpy.array_equal(surface.vertices, CORNERS + [0, 0, 0.5]) and set(surface.triangles.leaflet_id) == {2}
    assert numpy.allclose(surface.velocities, [0, 0, 2])
    surface.update_from_keyframes(keyframes, 1.0, dt=1.0)
    assert numpy.array_equal(surface.vertices, CORNERS + [0, 0, 1]) and numpy.allclose(surface.velocities, [0, 0, 1])
    keyframes.close()
    assert surface.info.n_triangles == 4
    cycle = riis.Keyframes(numpy.array([0.0, 0.5]), frames, FACES, period=1.0, interpolation="cubic")
    assert numpy.array_equal(riis.Surface.from_keyframes(cycle, 3.5).vertices, frames[1])


def test_points_are_chosen_by_mask_or_ids(surface, xyz):
    points = xyz[:1000]
    everything = surface.closest_points(points)
    mask = points[:, 0] > 0.0
    ids = numpy.flatnonzero(mask)
    for chosen in surface.closest_points(points, mask=mask), surface.closest_points(points, ids=ids):
        assert numpy.array_equal(chosen.distance[mask], everything.distance[mask])
        assert (chosen.distance[~mask] == riis.FAR_DISTANCE).all() and (chosen.triangle_id[~mask] == -1).all()
        assert not chosen.point[~mask].any()
    near = surface.closest_points(points, distance_limit=0.5, far_distance=9.0, n_threads=1)
    far = everything.distance > 0.5
    assert far.any() and (near.distance[far] == 9.0).all() and (near.leaflet_id[far] == -1).all()
    given = numpy.empty((1000, 3))
    found = surface.closest_points(points, distance=False, point=given, triangle_id=False, leaflet_id=False, normal=False)
    assert found.point is given and found.distance is None and found.normal is None
    assert numpy.array_equal(given, everything.point)
    assert surface.closest_points(xyz[:0]).distance.shape == (0,)


def test_other_distances_are_the_paper_s(valve):
    exact = riis.Surface(valve).closest_point((0.0, 0.0, 0.5))
    for measure in "sampling", "minimization":
        surface = riis.Surface(valve, measure=measure, measure_tolerance=0.1)
        assert abs(surface.closest_point((0.0, 0.0, 0.5)).distance - exact.distance) < 0.02
        with pytest.raises(riis.InvalidArgumentError, match="side"):
            surface.closest_points(numpy.zeros((1, 3)), side=True)


def test_crossings_are_found():
    crossed = numpy.array([[-1, -1, 0], [1, -1, 0], [0, 1, 0], [0, 0, -1], [0, 0, 1], [0, 3, 0]], float)
    surface = riis.Surface.from_arrays(crossed, numpy.array([[0, 1, 2], [3, 4, 5]]))
    found = riis.find_crossings(surface)
    assert found.n_pairs == 1 and found.triangle_id.tolist() == [[0, 1]] and found.deepest_triangle_id.tolist() == [0, 1]
    assert numpy.isclose(found.total_length, 1.0) and found.length[0] == found.total_length
    assert found.depth[0] == found.deepest_depth > 0.0
    assert numpy.allclose(found.point, [[0.0, 0.5, 0.0]]) and numpy.allclose(found.deepest_point, [0.0, 0.5, 0.0])
    none = riis.find_crossings(riis.Surface.from_arrays(CORNERS, FACES))
    assert none.n_pairs == 0 and none.triangle_id.shape == (0, 2) and none.deepest_triangle_id.tolist() == [-1, -1]


def test_a_skirt_of_arrays_leads_outwards():
    turns = numpy.arange(12) * numpy.pi / 6
    rim = numpy.stack([numpy.cos(turns), numpy.sin(turns), 0 * turns], axis=1)
    corners = numpy.concatenate([rim, [[0.0, 0.0, 0.2]]])
    faces = numpy.array([[i, (i + 1) % 12, 12] for i in range(12)])
    attached = numpy.arange(13) < 12
    for named in (None, attached):
        surface = riis.Surface.from_arrays(corners, faces, skirt_length=0.5, attached=named)
        assert numpy.allclose(surface.vertices[13:], 1.5 * rim)
        assert surface.info.largest_leaflet_id == 3 and surface.info.n_triangles == 36
        assert numpy.array_equal(numpy.unique(surface.attachment.vertex_id), numpy.arange(12))
    lengths = numpy.where(attached, 0.25, 0.0)
    surface = riis.Surface.from_arrays(corners, faces, skirt_length=0.5, attached=attached, skirt_lengths=lengths)
    assert numpy.allclose(surface.vertices[13:], 1.25 * rim)
    surface.update_from_arrays(2.0 * corners)
    assert numpy.allclose(surface.vertices[13:], 2.25 * rim)
    frames = riis.Keyframes(numpy.array([0.0, 1.0]), numpy.stack([corners, 2.0 * corners]), faces, skirt_length=0.5)
    surface = riis.Surface.from_keyframes(frames, 0.5)
    assert numpy.allclose(surface.vertices[13:], 2.0 * rim) and numpy.allclose(surface.velocities[13:], rim)
