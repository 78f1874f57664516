# SPDX-License-Identifier: Apache-2.0
"""Valves are mappings of their parameters, and can open."""

import collections.abc
import copy
import itertools
import pickle

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
    assert list(valve) == list(valve.keys()) and len(valve) == len(valve.keys()) and "opening" in valve.keys()
    assert "opening" in valve and "height" not in valve and 3 not in valve
    valve.update(opening=0.5, AP_diameter=3)
    assert (valve["opening"], valve["AP_diameter"]) == (0.5, 3.0)
    assert repr(valve) == "<riis.Valve 'mitral', opening 0.5>"


def test_a_valve_does_what_a_mapping_does():
    valve = riis.Valve("bileaflet", opening=0.3)
    same = dict(valve)
    assert isinstance(valve, collections.abc.Mapping) and not isinstance(valve, collections.abc.MutableMapping)
    public = {name for name in dir(collections.abc.Mapping) if not name.startswith("_")}
    assert public == {"get", "items", "keys", "values"} <= set(dir(valve))
    assert list(valve.items()) == [(name, valve[name]) for name in valve] == list(same.items())
    assert list(valve.values()) == list(same.values()) and len(valve.items()) == len(valve)
    assert ("opening", 0.3) in valve.items() and {**valve} == same
    assert valve.get("opening") == 0.3 and valve.get("height") is None and valve.get("height", 5) == valve.get(3, 5) == 5
    # A name that means all cusps can be set, but not read.
    assert "leaflet_angle" not in riis.Valve("aortic") and riis.Valve("aortic").get("leaflet_angle", 7.0) == 7.0
    with pytest.raises(KeyError) as missing:
        valve["height"]
    assert type(missing.value) is riis.UnknownParameterError and str(missing.value).startswith("'height' is not a parameter")
    assert isinstance(missing.value, riis.InvalidParameterError)
    assert collections.ChainMap(valve, {"height": 1.0})["height"] == 1.0
    with pytest.raises((TypeError, AttributeError)):
        del valve["opening"]


def test_a_valve_is_updated_as_a_dict():
    valve, other = riis.Valve("aortic"), riis.Valve("aortic", opening=0.2, root_radius=1.3)
    valve.update(other)
    assert all(numpy.array_equal(valve[name], other[name]) for name in other) and valve["root_radius"] == 1.3
    valve.update({"right.leaflet_angle": 20.0, "opening": 0.4}, opening=0.5)
    assert (valve["right.leaflet_angle"], valve["opening"]) == (20.0, 0.5)
    valve.update([("opening", 0.6)])
    valve.update()
    assert valve["opening"] == 0.6
    with pytest.raises(TypeError, match="other: must be a mapping, or pairs of name and value, not int"):
        valve.update(3)
    with pytest.raises(TypeError, match="name: must be a str, not int"):
        valve.update({3: 4.0})


def same_surfaces(one, other):
    """Returns whether two valves have the same surfaces, to the last bit, at several openings."""
    one, other = one.copy(), other.copy()
    for opening in (0.0, 0.3, 1.0):
        one["opening"] = other["opening"] = opening
        a, b = riis.Surface(one), riis.Surface(other)
        if a.vertices.tobytes() != b.vertices.tobytes() or not numpy.array_equal(a.triangles.vertex_id, b.triangles.vertex_id):
            return False
    return True


def valves_to_pickle():
    mitral = riis.Valve("mitral", opening=1 / 3, AP_diameter=3.1, translation=(0.1, 0.2, 1 / 7))
    opens = riis.Valve("trileaflet")
    opens.set_open_state(riis.Valve("trileaflet", open_radius_ratio=0.6))
    ring = riis.Valve("bileaflet", ring_height=0.2)
    ring.set_open_state(riis.Valve("bileaflet", ring_height=0.2, open_angle=80.0))
    ring.update(closed_angle=30.0, opening=0.5)
    ring.set_open_state(ring)
    degree, curves = numpy.ones(4, "i4"), numpy.array([[1, 2, 3, 4]], "i4")
    patches = riis.Valve.from_patches(degree, square(0.0), curves, leaflet_id=numpy.array([7], "i4"), index_base=1)
    patches.set_open_state(riis.Valve.from_patches(degree, square(0.5), curves, index_base=1))
    follows = riis.Valve("trileaflet", annulus=2.4, bending_height=0.7)
    follows.set_open_state(riis.Valve("trileaflet", stj=2.6))
    return {"mitral": mitral, "open state": opens, "ring": ring, "patches": patches, "follows": follows}


@pytest.mark.parametrize("name", ["mitral", "open state", "ring", "patches", "follows"])
def test_valves_are_pickled_with_all_that_they_have(name):
    valve = valves_to_pickle()[name]
    made = [pickle.loads(pickle.dumps(valve, protocol)) for protocol in range(2, pickle.HIGHEST_PROTOCOL + 1)]
    for other in (*made, pickle.loads(pickle.dumps(made[0])), pickle.loads(pickle.dumps(valve.copy())), copy.deepcopy(valve)):
        assert other.kind == valve.kind and list(other) == list(valve)
        for key in valve:
            assert numpy.array_equal(other[key], valve[key]), key
            assert other.is_set(key) == valve.is_set(key), key
        assert same_surfaces(other, valve)
        if name == "follows":
            other = other.copy()
            other["annulus"] = 2.2
            assert other["bending_radius_in"] == 0.32 * 1.1 and other["bending_height"] == 0.7
    made[0]["opening"] = 0.125
    assert valve["opening"] != 0.125
    if name == "patches":
        assert set(riis.Surface(made[0]).triangles.leaflet_id) == {7}


def test_states_that_later_values_clash_with_are_pickled():
    ring = riis.Valve("bileaflet", ring_height=0.2)
    ring.set_open_state(riis.Valve("bileaflet", ring_height=0.2))
    ring["ring_height"] = 0.0
    other = pickle.loads(pickle.dumps(ring))
    texts = []
    for valve in ring, other:
        valve["opening"] = 0.5
        with pytest.raises(riis.InvalidParameterError) as refusal:
            riis.Surface(valve)
        texts.append(str(refusal.value))
    assert texts[0] == texts[1]


def test_all_else_is_neither_pickled_nor_copied(surface, mesh, marks):
    keyframes = riis.Keyframes(numpy.zeros(1), numpy.eye(3)[None], numpy.array([[0, 1, 2]]))
    for thing in surface, mesh, marks, marks.within_limit, keyframes, riis.Adjacency.from_grid(2, 2, 2):
        for call in pickle.dumps, copy.copy, copy.deepcopy:
            with pytest.raises(TypeError, match=f"^{type(thing).__name__}: is neither pickled nor copied; keep "):
                call(thing)
    error = pickle.loads(pickle.dumps(riis.UnknownParameterError("lost")))
    assert type(error) is riis.UnknownParameterError and str(error) == "lost"


def test_sizes_by_a_surgeons_names():
    sizes = {"annulus": 2.3, "stj": 2.6, "effective_height": 1.0}
    expected = {"root_radius": 1.15, "leaflet_radius_out": 1.3, "leaflet_height": 1.0, "bending_height": 0.5, "t0_bending": 0.23,
                "bending_radius_in": 0.368, "bending_radius_out": 1.2495, "t3_bending": 0.23, "bending_angle": 35.0}
    for names in itertools.permutations(sizes):
        by_keywords = riis.Valve("trileaflet", **{name: sizes[name] for name in names})
        by_items = riis.Valve("trileaflet")
        for name in names:
            by_items[name] = sizes[name]
        for valve in by_keywords, by_items:
            assert all(valve[name] == size and name in valve and name not in list(valve) for name, size in sizes.items())
            assert [valve[name] for name in expected] == pytest.approx(list(expected.values()), rel=1e-15)
            assert valve.is_set("annulus") and valve.is_set("root_radius") and not valve.is_set("bending_height")
    valve["bending_height"] = 0.6
    valve["leaflet_height"] = 1.4
    assert valve["bending_height"] == 0.6 and valve.is_set("bending_height")
    valve.unset("bending_height")
    assert valve["bending_height"] == 0.7 and not valve.is_set("bending_height")
    assert valve.parameters["bending_height"].rule == "0.5 leaflet_height"
    assert valve.parameters["bending_height"].other_name == ""
    assert valve.parameters["root_radius"][-3:] == ("", "annulus", 2.0)
    valve.unset("stj")
    assert valve["leaflet_radius_out"] == 1.25
    everything = riis.Valve("trileaflet", **dict(valve))
    everything["leaflet_height"] = 1.2
    assert all(map(everything.is_set, everything)) and everything["bending_height"] == 0.7


def test_aortic_cusps_turn_until_they_meet():
    valve = riis.Valve("aortic", leaflet_angle=60.0, stj=2.8)
    rotations = [list(valve[f"{cusp}.rotation"]) for cusp in ("right", "left", "non_coronary")]
    assert rotations == [[0, 0, 0], [0, 0, 120], [0, 0, -120]]
    assert valve["left.stj"] == valve["right.stj"] == 2.8 and valve["non_coronary.leaflet_radius_out"] == 1.4
    valve["left.rotation"] = [1.0, 2.0, 3.0]
    valve["right.leaflet_angle"] = 57.0  # the angles now leave three gaps of 2 degrees between the leaflets
    assert list(valve["left.rotation"]) == [1, 2, 3] and list(valve["non_coronary.rotation"]) == [0, 0, -119]
    valve.unset("rotation")
    assert list(valve["left.rotation"]) == [0, 0, 119]
    assert "stj" not in valve and "right.stj" in valve


@pytest.mark.parametrize("kind, name, text", [
    ("mitral", "annulus", "its annulus is not round; set AP_diameter and ALPM_diameter"),
    ("mitral", "stj", "it has no sinotubular junction"),
    ("mitral", "effective_height", "only cusps have an effective height"),
    ("bileaflet", "stj", "its housing has only one radius"),
    ("bileaflet", "effective_height", "only cusps have an effective height"),
])
def test_names_without_a_meaning_are_refused(kind, name, text):
    text = f"'{name}' is not a parameter of the {kind} valve: {text}"
    with pytest.raises(riis.InvalidParameterError, match=text):
        riis.Valve(kind, **{name: 2.5})
    valve = riis.Valve(kind)
    for call in valve.unset, valve.is_set:
        with pytest.raises(riis.InvalidParameterError, match=text):
            call(name)
        with pytest.raises(TypeError, match="name: must be a str, not int"):
            call(3)
    with pytest.raises(riis.UnknownParameterError, match=text):
        valve[name]
    assert name not in valve and valve.get(name) is None


def test_cusps_have_parameters_of_their_own():
    valve = riis.Valve("aortic")
    valve["leaflet_angle"] = 20.0
    valve["right.leaflet_angle"] = 30.0
    assert (valve["right.leaflet_angle"], valve["left.leaflet_angle"]) == (30.0, 20.0)


@pytest.mark.parametrize("kind", ["aortic", "mitral", "coapting", "trileaflet", "bileaflet", "bicuspid", "quadricuspid",
                                  "mitral_coapting", "tricuspid"])
def test_parameters_describe_the_defaults(kind):
    valve = riis.Valve(kind)
    assert len(valve.parameters) == len(valve)
    for name, parameter in valve.parameters.items():
        assert parameter.name == name and parameter.description and parameter.unit in ("length", "degree", "1")
        value = numpy.atleast_1d(valve[name])
        assert len(value) == parameter.n_values and numpy.array_equal(value, numpy.atleast_1d(parameter.default))
        assert (value >= parameter.minimum).all() and (value <= parameter.maximum).all()


def test_cusps_follow_the_valve_until_they_are_set():
    valve = riis.Valve("bicuspid", effective_height=0.8, **{"cusp_0.sector": 150, "cusp_1.effective_height": 0.75})
    assert [valve[f"cusp_{k}.effective_height"] for k in range(2)] == [0.8, 0.75]
    assert valve.parameters["cusp_0.effective_height"].rule == "effective_height"
    valve["effective_height"] = 0.85
    assert [valve[f"cusp_{k}.effective_height"] for k in range(2)] == [0.85, 0.75]
    assert [valve.is_set(f"cusp_{k}.effective_height") for k in range(2)] == [False, True]
    for other in (valve.copy(), pickle.loads(pickle.dumps(valve))):
        other["effective_height"] = 0.8
        assert [other[f"cusp_{k}.effective_height"] for k in range(2)] == [0.8, 0.75]
    assert valve["cusp_0.sector"] == 150.0 and valve["cusp_1.sector"] == 180.0  # as they were set, not as they are scaled
    valve.unset("cusp_1.effective_height")
    assert valve["cusp_1.effective_height"] == 0.85
    with pytest.raises(riis.UnknownParameterError, match="'bump_0.leaf' is not a parameter of the bicuspid valve; did you mean"):
        valve["bump_0.leaf"]


@pytest.mark.parametrize("kind, leaflets", [("bicuspid", [0, 1]), ("quadricuspid", [0, 1, 2, 3]), ("mitral_coapting", [0, 1]),
                                            ("tricuspid", [0, 1, 2])])
def test_leaflets_and_skirts_have_ids(kind, leaflets):
    """The id of a skirt is one more than that of the last cusp, and at least 3."""
    assert [one.leaflet_id for one in riis.Surface(riis.Valve(kind)).leaflets()] == leaflets
    with_skirt = riis.Surface(riis.Valve(kind, skirt_length=0.2))
    assert [one.leaflet_id for one in with_skirt.leaflets()] == [*leaflets, max(3, len(leaflets))]
    assert riis.Leaflet.ANTERIOR == 0 and riis.Leaflet.POSTERIOR == 1


def test_a_bump_makes_an_open_valve_narrower():
    """A cusp that hardly opens, in a valve, its copy and its pickle."""
    valve = riis.Valve("coapting", opening=1.0)
    healthy = riis.Surface(valve).orifice().area
    valve.update({"bump_0.leaflet": 1, "bump_0.width": 1.0, "bump_0.open": 0.35})
    ill = riis.Surface(valve).orifice().area
    assert 0.6 * healthy < ill < 0.9 * healthy
    for other in (valve.copy(), pickle.loads(pickle.dumps(valve))):
        assert riis.Surface(other).orifice().area == ill
    valve["bump_0.leaflet"] = -1
    assert riis.Surface(valve).orifice().area == healthy


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
    """Returns the curves of a square's sides as straight lines: v = 0, v = 1, u = 0, u = 1."""
    a, b, c, d = [(x, y, z) for x, y in ((-1, -1), (1, -1), (-1, 1), (1, 1))]
    return numpy.array([a, b, c, d, a, c, b, d], float)


def test_a_valve_comes_from_patches():
    degree, curves = numpy.ones(4, "i4"), numpy.array([[0, 1, 2, 3]], "i4")
    valve = riis.Valve.from_patches(degree, square(0.0), curves, leaflet_id=numpy.array([7], "i4"))
    assert valve.kind == "patches" and list(valve.keys()) == ["opening", "skirt_length"]
    surface = riis.Surface(valve)
    assert numpy.isclose(surface.info.area, 4.0) and set(surface.triangles.leaflet_id) == {7}
    assert surface.closest_point((0, 0, 1)).distance == 1.0
    from_one = riis.Valve.from_patches(degree, square(0.0), curves + 1, index_base=1)
    assert numpy.array_equal(riis.Surface(from_one).vertices, surface.vertices)
    valve.set_open_state(riis.Valve.from_patches(degree, square(0.5), curves))
    valve["opening"] = 0.5
    assert riis.Surface(valve).closest_point((0, 0, 1)).distance == 0.75
    points = square(0.0)
    points[:2] = points[1::-1]  # the first side runs backwards
    reversals = numpy.array([[1, 0, 0, 0]], "i4")
    again = riis.Surface(riis.Valve.from_patches(degree, points, curves, reversed=reversals))
    assert numpy.isclose(again.info.area, 4.0)


def test_a_coapting_valve_has_surgeons_sizes_and_refuses_others():
    valve = riis.Valve("coapting", annulus=2.4, stj=2.6, effective_height=1.0)
    assert (valve["root_radius"], valve["commissure_radius"]) == (1.2, 1.3)
    assert numpy.isclose(valve["commissure_height"], 1.82) and numpy.isclose(valve["coaptation_height"], 0.39)
    edges = []
    for opening in (0.0, 0.3, 0.7, 1.0):
        valve["opening"] = opening
        edges.append([leaflet.free_edge for leaflet in riis.Surface(valve).leaflets()])
    assert numpy.allclose(edges, edges[0][0], rtol=1e-3)
    for sizes, text in (
        ({"gap": 0.001}, "gap is 0.001; it must be from 0.002 to 0.2 times commissure_radius, which is 1.25"),
        ({"coaptation_height": 0.9}, "coaptation_height is 0.9; it must be from 0.02 to 0.9 times effective_height"),
        ({"effective_height": 1.5, "commissure_expansion": 0.3}, "half an open free edge is at least"),
        ({"commissure_height": 1.4, "effective_height": 0.45, "edge_rise": 0.0}, "a cusp would fold beside its attachment"),
        ({"commissure_height": 1.0, "effective_height": 0.15, "coaptation_height": 0.1}, "may hang down to the height"),
    ):
        with pytest.raises(riis.InvalidParameterError, match=text):
            riis.Surface(riis.Valve("coapting", **sizes))


def test_a_warp_moves_a_valve():
    valve = riis.Valve("trileaflet", opening=0.4)
    placement = {"scale": 10.0, "rotation_axis": (1, 2, 3), "rotation_angle": 40.0, "translation": (4, 5, 6)}
    plain = riis.Surface(valve, **placement)
    sources = numpy.unique(plain.attachment.edges[::4, 0].round(9), axis=0)
    warp = riis.Warp(sources, placement=placement)
    assert warp.info.n_landmarks == len(sources) and warp.info.largest_residual < 1e-12 and not warp.info.is_planar
    assert numpy.allclose(warp.map(sources), sources, rtol=0, atol=1e-12)
    warp.set_targets(2.0 * sources)
    assert numpy.allclose(warp.map(plain.vertices), 2.0 * plain.vertices, rtol=0, atol=1e-9)
    assert abs(warp.info.least_determinant - 8.0) < 1e-9
    valve.set_warp(warp)
    twice = riis.Surface(valve, **placement)
    assert abs(twice.info.area - 4.0 * plain.info.area) < 0.02 * twice.info.area
    for other in (valve.copy(), pickle.loads(pickle.dumps(valve))):
        assert numpy.array_equal(riis.Surface(other, **placement).vertices, twice.vertices)
    again = pickle.loads(pickle.dumps(warp))
    assert numpy.array_equal(again.map(sources), warp.map(sources))
    keys = numpy.array([2.0 * sources, 2.0 * sources + [0, 0, 1]])
    before = valve.copy()
    warp.set_targets_at(numpy.array([0.0, 0.5]), keys, 0.25)
    valve.set_warp(warp, warp)
    twice.update_moving(valve, before, 0.25)
    assert numpy.allclose(twice.velocities, [0.0, 0.0, 2.0], rtol=0, atol=1e-8)
    timed = pickle.loads(pickle.dumps(warp))
    assert numpy.array_equal(timed.map(sources), warp.map(sources))
    noisy = riis.Warp(sources, noise=0.5)
    noisy.set_targets(sources + numpy.random.default_rng(1).normal(0.0, 0.5, sources.shape))
    assert 0.05 < noisy.info.rms_residual < 1.5 and noisy.info.smoothing > 0
    valve.set_warp()
    assert numpy.array_equal(riis.Surface(valve, **placement).vertices, plain.vertices)


def test_patches_are_read_out():
    valve = riis.Valve("aortic", opening=0.3)
    read = valve.read_patches()
    assert len(read.curve_id) == 12 and len(read.first_piece) == len(read.degree) + 1 and not read.bulge.any()
    assert sorted(read.patch_id) == list(range(12)) and set(read.attached) == {2, 3}
    again = riis.Valve.from_patches(read.degree, read.control, read.curve_id, reversed=read.reversed, leaflet_id=read.leaflet_id)
    assert abs(riis.Surface(again).info.area - riis.Surface(valve).info.area) < 0.05
    mitral = riis.Valve("mitral").read_patches()
    assert mitral.bulge.all() and set(mitral.attached) == {0} and len(mitral.curve_id) == 10
