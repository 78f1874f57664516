# SPDX-License-Identifier: Apache-2.0
"""Valves are mappings of their parameters, and open."""

import copy

import numpy
import pytest

import riis


def test_a_valve_is_a_mapping():
    valve = riis.Valve("mitral", opening=0.3, translation=(1, 2, 3))
    assert valve.kind == "mitral" and valve["opening"] == 0.3
    valve["AP_diameter"] = numpy.float64(3.1)
    assert valve["AP_diameter"] == 3.1 and isinstance(valve["AP_diameter"], float)
    assert valve["translation"].tolist() == [1.0, 2.0, 3.0]
    valve["translation"] = numpy.array([4.0, 5.0, 6.0])
    assert dict(valve)["translation"].tolist() == [4.0, 5.0, 6.0]
    assert list(valve) == valve.keys() and len(valve) == len(valve.keys())
    assert "opening" in valve and "height" not in valve and 3 not in valve
    valve.update(opening=0.5, AP_diameter=3)
    assert (valve["opening"], valve["AP_diameter"]) == (0.5, 3.0)
    assert repr(valve) == "<riis.Valve 'mitral', opening 0.5>"


def test_cusps_have_parameters_of_their_own():
    valve = riis.Valve("aortic")
    valve["leaflet_angle"] = 20.0
    valve["right.leaflet_angle"] = 30.0
    assert (valve["right.leaflet_angle"], valve["left.leaflet_angle"]) == (30.0, 20.0)


@pytest.mark.parametrize("kind", ["aortic", "mitral", "trileaflet", "bileaflet"])
def test_parameters_describe_the_defaults(kind):
    valve = riis.Valve(kind)
    assert len(valve.parameters) == len(valve)
    for name, parameter in valve.parameters.items():
        assert parameter.name == name and parameter.description and parameter.unit in ("length", "degree", "1")
        value = numpy.atleast_1d(valve[name])
        assert len(value) == parameter.n_values and numpy.array_equal(value, numpy.atleast_1d(parameter.default))
        assert (value >= parameter.minimum).all() and (value <= parameter.maximum).all()


def test_copies_are_independent():
    valve = riis.Valve("mitral", opening=0.3)
    for made in valve.copy(), copy.copy(valve), copy.deepcopy(valve):
        made["opening"] = 0.9
        assert valve["opening"] == 0.3 and made.kind == "mitral"


def test_an_open_state_is_opened_to():
    closed, opened = riis.Valve("trileaflet"), riis.Valve("trileaflet", open_radius_ratio=0.6)
    plain = riis.Surface(riis.Valve("trileaflet", opening=1.0)).vertices
    closed.set_open_state(opened)
    closed["opening"] = 1.0
    assert not numpy.array_equal(riis.Surface(closed).vertices, plain)


def square(z):
    """The curves of a square's sides, as straight lines: v = 0, v = 1, u = 0, u = 1."""
    a, b, c, d = [(x, y, z) for x, y in ((-1, -1), (1, -1), (-1, 1), (1, 1))]
    return numpy.array([a, b, c, d, a, c, b, d], float)


def test_a_valve_comes_from_patches():
    degree, curves = numpy.ones(4, "i4"), numpy.array([[0, 1, 2, 3]], "i4")
    valve = riis.Valve.from_patches(degree, square(0.0), curves, leaflet_id=numpy.array([7], "i4"))
    assert valve.kind == "patches" and valve.keys() == ["opening"]
    surface = riis.Surface(valve)
    assert numpy.isclose(surface.info.area, 4.0) and set(surface.triangles.leaflet_id) == {7}
    assert surface.closest_point((0, 0, 1)).distance == 1.0
    from_one = riis.Valve.from_patches(degree, square(0.0), curves + 1, index_base=1)
    assert numpy.array_equal(riis.Surface(from_one).vertices, surface.vertices)
    valve.set_open_state(riis.Valve.from_patches(degree, square(0.5), curves))
    valve["opening"] = 0.5
    assert riis.Surface(valve).closest_point((0, 0, 1)).distance == 0.75
    points = square(0.0)
    points[:2] = points[1::-1]  # the first side backwards
    reversals = numpy.array([[1, 0, 0, 0]], "i4")
    again = riis.Surface(riis.Valve.from_patches(degree, points, curves, reversed=reversals))
    assert numpy.isclose(again.info.area, 4.0)
