# SPDX-License-Identifier: Apache-2.0
"""The forces of the flow at the vertices of a surface, and the forces of the leaflets at nodes of tissue, against numpy."""

import numpy
import pytest

import riis

RADIUS = 0.3


@pytest.fixture(scope="module", params=[0.0, 0.75])
def surface(request):
    """With an offset too, the forces act at the closest points of the surface."""
    return riis.Surface(riis.Valve("mitral", opening=0.4), half_thickness=0.15, offset=request.param)


@pytest.fixture(scope="module")
def reaction(surface):
    """Forces and moments of the leaflets, and the force of each vertex, in a random flow."""
    random = numpy.random.default_rng(7)
    xyz = random.uniform(surface.info.lower - 0.2, surface.info.upper + 0.2, (20000, 3))
    marks = riis.mark(surface, riis.Mesh(xyz), fields="point barycentric")
    velocity, weight = random.normal(size=xyz.shape), random.random(len(xyz))
    force, moment = numpy.zeros((2, 3)), numpy.zeros((2, 3))
    marks.add_reaction(velocity, weight, R=2.0, leaflet_force=force, leaflet_moment=moment)
    return force, moment, marks.add_vertex_reaction(surface, velocity, weight, R=2.0), (marks, velocity, weight)


@pytest.fixture(scope="module")
def tissue(surface):
    random = numpy.random.default_rng(11)
    ends = surface.attachment.edges[random.integers(len(surface.attachment.edges), size=3000), 0]
    return ends + random.uniform(-0.4, 0.4, ends.shape), random.random(len(ends))


def moment_of(force, points):
    return numpy.cross(points, force).sum(axis=0)


def distance_from(edges, points):
    """The distance of each point from the nearest edge."""
    first, along = edges[:, 0], edges[:, 1] - edges[:, 0]
    whole = numpy.maximum((along**2).sum(axis=1), 1e-300)
    at = numpy.clip(((points[:, None] - first) * along).sum(axis=2) / whole, 0.0, 1.0)
    return numpy.linalg.norm(points[:, None] - first - at[..., None] * along, axis=2).min(axis=1)


def expected_loads(points, weight, edges, force, moment, about):
    """Solves the six equations for the forces w (a + b x r)."""
    d = numpy.minimum(distance_from(edges, points) / RADIUS, 1.0)
    w, r = weight * 0.5 * (1.0 + numpy.cos(numpy.pi * d)), points - about
    columns = [w[:, None] * unit for unit in numpy.eye(3)] + [w[:, None] * numpy.cross(unit, r) for unit in numpy.eye(3)]
    matrix = numpy.array([numpy.concatenate([f.sum(axis=0), moment_of(f, r)]) for f in columns]).T
    solution = numpy.linalg.solve(matrix, numpy.concatenate([force, moment]))
    return sum(x * f for x, f in zip(solution, columns))


def test_vertices_have_the_forces_of_the_leaflets(surface, reaction):
    force, moment, at_vertices, (marks, velocity, weight) = reaction
    for leaflet in range(2):
        mine = numpy.unique(surface.triangles.vertex_id[surface.triangles.leaflet_id == leaflet])
        assert numpy.allclose(at_vertices[mine].sum(axis=0), force[leaflet], rtol=1e-11)
        assert numpy.allclose(moment_of(at_vertices[mine], surface.vertices[mine]), moment[leaflet], rtol=1e-10)
    coefficient = numpy.zeros(len(velocity))
    marks.add_resistance(coefficient, R=2.0)
    each = (weight * coefficient)[marks.ids, None] * velocity[marks.ids]
    expected = numpy.zeros_like(at_vertices)
    corners = surface.triangles.vertex_id[marks.triangle_id]
    for corner in range(3):
        numpy.add.at(expected, corners[:, corner], marks.barycentric[:, corner, None] * each)
    assert numpy.allclose(at_vertices, expected, atol=1e-12 * numpy.abs(each).sum())
    assert marks.add_vertex_reaction(surface, velocity, weight, at_vertices.copy(), R=2.0) == pytest.approx(2 * at_vertices)


def test_loads_solve_the_six_equations(surface, reaction, tissue):
    force, moment = reaction[:2]
    points, weight = tissue
    held, about = surface.attachment, numpy.array([1.0, -2.0, 0.5])
    moment = moment - numpy.cross(about, force)
    got = riis.loads(points, RADIUS, held.edges, force, moment, about=about, edge_leaflet_id=held.leaflet_id, weight=weight)
    expected = sum(expected_loads(points, weight, held.edges[held.leaflet_id == leaflet], force[leaflet], moment[leaflet], about)
                   for leaflet in range(2))
    assert numpy.allclose(got, expected, atol=1e-10 * numpy.abs(got).max())
    assert numpy.allclose(got.sum(axis=0), force.sum(axis=0), rtol=1e-11)
    assert numpy.allclose(moment_of(got, points - about), moment.sum(axis=0), rtol=1e-10)
    speed, spin = numpy.array([0.3, -0.2, 0.9]), numpy.array([2.0, 1.0, -1.0])
    power = (got * (speed + numpy.cross(spin, points - about))).sum()
    assert numpy.isclose(power, force.sum(axis=0) @ speed + moment.sum(axis=0) @ spin, rtol=1e-10)


def test_ranks_add_their_sums(surface, reaction, tissue):
    force, moment = reaction[:2]
    points, weight = tissue
    edges = surface.attachment.edges
    whole = riis.loads(points, RADIUS, edges, force, moment, weight=weight)
    parts = numpy.array_split(numpy.random.default_rng(2).permutation(len(points)), 3)
    sums = sum(riis.load_sums(points[part], RADIUS, edges, 2, weight=weight[part]) for part in parts)
    assert sums.shape == (2, 11)
    for part in parts:
        got = riis.loads(points[part], RADIUS, edges, force, moment, weight=weight[part], sums=sums)
        assert numpy.allclose(got, whole[part], atol=1e-12 * numpy.abs(whole).max())


def test_a_bileaflet_valve_takes_the_callers_edges():
    held = riis.Surface(riis.Valve("bileaflet")).attachment
    assert len(held.edges) == 0
    with pytest.raises(riis.InvalidArgumentError, match="^n_edges is 0; .*: a surface without an attachment needs edges"):
        riis.loads(numpy.eye(3), 0.5, held.edges, numpy.ones((1, 3)), numpy.zeros((1, 3)))
    pivots = numpy.array([[[-1.0, 0.0, 0.0], [1.0, 0.0, 0.0]]])
    got = riis.loads(numpy.vstack([numpy.eye(3), -numpy.eye(3)]), 1.5, pivots, numpy.ones((1, 3)), numpy.zeros((1, 3)))
    assert numpy.allclose(got.sum(axis=0), 1.0)
