# SPDX-License-Identifier: Apache-2.0
"""Known valves are recovered from points, and bad input is refused."""

import json
import os
import pathlib
import pickle
import shlex
import subprocess

import numpy
import pytest

import fit_table
import riis
from riis._fit_problem import axis_and_angle, matrix_of, random_rotations, weighted_median

pytest.importorskip("scipy", reason="scipy is missing; ./run python installs it")

ROOT = pathlib.Path(__file__).resolve().parents[2]


@pytest.mark.parametrize("kind", ["mitral", "aortic", "coapting", "trileaflet", "bileaflet"])
def test_known_valves_are_found_again(kind):
    true = fit_table.VALVES[kind]
    points = fit_table.cloud(kind, 600, 0.01, outliers=0.02)
    found = riis.fit(points, kind, free=list(true), n_starts=3, start={"rotation_angle": 0.0})
    assert found.undetermined == () and found.at_bounds == ()
    for name, value in true.items():
        assert abs(found.parameters[name] - value) < 5.0 * found.standard_errors[name] < 0.15, name
        assert found.valve[name] == found.parameters[name]
    assert 0.005 < found.rms < 0.02  # the noise along the normal is 0.01
    # The fitted surface is the known one: points without noise have small distances from it.
    clean = fit_table.cloud(kind, 500, 0.0, seed=1)
    surface = riis.Surface(found.valve, **found.placement)
    assert numpy.percentile(surface.closest_points(clean).distance, 90) < 0.02
    # The distances in the result are distances to the surface, and the measures are computed from them.
    assert numpy.allclose(found.distances, surface.closest_points(points).distance, atol=0.01)
    assert found.weights[:10].max() < 0.5 < numpy.median(found.weights)  # the first twelve are outliers
    assert numpy.isclose(found.percentile95, numpy.percentile(found.distances, 95.0))
    assert numpy.isclose(found.rms, numpy.sqrt(numpy.average(found.distances**2, weights=found.weights)))
    assert all(name in found.report() for name in true) and "95 % of 600 points" in found.report()


def test_a_valve_is_found_wherever_it_lies():
    """No start is given. The points are turned by more than a quarter, and are far from the origin."""
    placement = {"rotation_axis": (1.0, -2.0, 0.5), "rotation_angle": 140.0, "translation": (120.0, -40.0, 300.0)}
    true = fit_table.VALVES["aortic"]
    found = riis.fit(fit_table.cloud("aortic", 800, 0.02, placement=placement), "aortic", free=list(true))
    for name, value in true.items():
        assert abs(found.parameters[name] - value) < 5.0 * found.standard_errors[name], name
    # The whole valve lies where the known valve lies, each cusp at its own place.
    known = riis.Surface(riis.Valve("aortic", **true), **placement).closest_points(numpy.zeros((1, 3))).point
    surface = riis.Surface(found.valve, **found.placement)
    assert surface.closest_points(known).distance[0] < 0.02
    assert numpy.linalg.norm(numpy.array(found.placement["translation"]) - placement["translation"]) < 0.05


def test_edges_are_where_the_points_end():
    """Without a cost of the area, a disk that is too large would fit as well as the right one."""
    points = fit_table.cloud("bileaflet", 1000, 0.02)
    start = riis.Valve("bileaflet", radius=1.6, opening=0.3)
    arguments = {"free": ["radius"], "n_starts": 1, "start": fit_table.PLACEMENT}
    found = riis.fit(points, start, **arguments)
    assert abs(found.parameters["radius"] - 1.2) < 0.03
    without = riis.fit(points, start, whole=False, **arguments)
    assert without.parameters["radius"] > 1.3


def test_scale_is_found_with_the_proportions_of_a_valve():
    placement = {**fit_table.PLACEMENT, "scale": 10.0}
    points = fit_table.cloud("mitral", 500, 0.1, placement=placement)
    start = riis.Valve("mitral", **fit_table.VALVES["mitral"])
    found = riis.fit(points, start, free=[], placement=["rotation", "translation", "scale"], n_starts=1)
    assert abs(found.placement["scale"] - 10.0) < 0.1
    assert found.parameters == {} and found.undetermined == ()


def test_vertices_of_surfaces_count_by_their_area():
    valve = riis.Valve("trileaflet", leaflet_height=1.3)
    surface = riis.Surface(valve)
    arguments = {"free": ["leaflet_height"], "n_starts": 1, "start": {"translation": (0.0, 0.0, 0.0)}}
    found = riis.fit(surface, "trileaflet", **arguments)
    assert abs(found.parameters["leaflet_height"] - 1.3) < 0.01
    pyvista = pytest.importorskip("pyvista", reason="PyVista is missing; ./run python installs it")
    data = surface.to_pyvista()
    again = riis.fit(data, "trileaflet", **arguments)
    assert again.parameters == found.parameters  # the same points and weights
    single = pyvista.PolyData(numpy.array(surface.vertices, numpy.float32))  # only the points, all with weight 1
    alike = riis.fit(single, "trileaflet", **arguments)
    assert abs(alike.parameters["leaflet_height"] - 1.3) < 0.01 and numpy.ptp(alike.weights) < numpy.ptp(found.weights)


def test_weights_count():
    """Points with weight 0 change nothing."""
    points = fit_table.cloud("trileaflet", 400, 0.01)
    arguments = {"free": ["opening"], "n_starts": 1}
    found = riis.fit(points, "trileaflet", **arguments)
    weights = numpy.append(numpy.ones(400), numpy.zeros(300))
    more = riis.fit(numpy.concatenate([points, points[:300] + 0.3]), "trileaflet", weights=weights, **arguments)
    assert abs(more.parameters["opening"] - found.parameters["opening"]) < 1e-3
    assert (more.weights[400:] == 0.0).all()


def test_the_same_seed_gives_the_same_fit():
    points = fit_table.cloud("bileaflet", 300, 0.02)
    first, second = (riis.fit(points, "bileaflet", free=["opening"], n_starts=n, seed=seed)
                     for n, seed in ((2, 7), (numpy.array(2), numpy.int64(7))))
    assert first.parameters == second.parameters and first.placement == second.placement
    kept = pickle.loads(pickle.dumps(first))
    assert kept.report() == first.report() and kept.valve["opening"] == first.valve["opening"]


def test_bounds_hold_and_are_told():
    points = fit_table.cloud("trileaflet", 400, 0.01)
    found = riis.fit(points, "trileaflet", free=["leaflet_height"], bounds={"leaflet_height": (1.0, 1.15)}, n_starts=1)
    assert found.at_bounds == ("leaflet_height",) and 1.149 < found.parameters["leaflet_height"] <= 1.15
    assert "at a bound" in found.report()


def test_what_the_data_do_not_say_is_told():
    """A closed valve is the same for any open radius, so the data do not determine it."""
    valve = riis.Valve("trileaflet", opening=0.0)
    valve.update(dict(valve))  # all parameters are set, so no other size follows the free one
    points = numpy.array(riis.Surface(valve).vertices[::5])
    free = ["leaflet_height", "open_radius_ratio"]
    found = riis.fit(points, valve, free=free, placement=["translation"], n_starts=1, whole=False)
    assert found.undetermined == ("open_radius_ratio",)
    assert numpy.isinf(found.standard_errors["open_radius_ratio"])
    assert found.singular_values[-1] < 1e-9 < found.singular_values[-2]
    assert abs(found.parameters["leaflet_height"] - valve["leaflet_height"]) < 0.02


def test_the_placement_may_be_undetermined():
    """Points on a flat patch of a disk do not determine shifts along the disk."""
    valve = riis.Valve("bileaflet", opening=1.0, open_angle=90.0)
    y, z = numpy.meshgrid(numpy.linspace(-0.2, 0.2, 12), numpy.linspace(0.2, 0.5, 12))
    points = numpy.column_stack([numpy.full(144, valve["hinge_offset"]), y.ravel(), z.ravel()])
    start = {"rotation_angle": 0.0, "translation": (0.02, 0.0, 0.0)}
    found = riis.fit(points, valve, free=[], placement=["translation"], start=start, n_starts=1, whole=False)
    assert found.undetermined == ("translation",) and abs(found.placement["translation"][0]) < 1e-3
    assert "undetermined in the placement: translation" in found.report()


def program_riis():
    for path in [os.environ.get("RIIS_PROGRAM"), ROOT / "build/bin/riis"]:
        if path and os.access(path, os.X_OK):
            return path
    pytest.skip("the program riis is not built; ./run demo builds it")


CUBE = """# vtk DataFile Version 3.0
cube
ASCII
DATASET UNSTRUCTURED_GRID
POINTS 8 double
-9 -9 -9 9 -9 -9 9 9 -9 -9 9 -9 -9 -9 9 9 -9 9 9 9 9 -9 9 9
CELLS 1 9
8 0 1 2 3 4 5 6 7
CELL_TYPES 1
12
"""


@pytest.mark.parametrize("kind", ["mitral", "aortic"])
def test_riis_mark_makes_the_fitted_surface(kind, tmp_path):
    """With the file and the options, the program makes the same surface, up to the last digits."""
    pyvista = pytest.importorskip("pyvista", reason="PyVista is missing; ./run python installs it")
    program = program_riis()
    placement = {**fit_table.PLACEMENT, "scale": 1.1}
    points = fit_table.cloud(kind, 300, 0.02, placement=placement)
    start = riis.Valve(kind, **fit_table.VALVES[kind])
    found = riis.fit(points, start, free=["leaflet_height" if kind == "aortic" else "opening"],
                     placement=["rotation", "translation", "scale"], n_starts=1)
    options = shlex.split(found.write(tmp_path / "a valve.json"))
    (tmp_path / "cube.vtk").write_text(CUBE)
    command = [program, "mark", tmp_path / "cube.vtk", *options, "--surface-output", tmp_path / "valve.vtp", "--allow-none"]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    made, known = pyvista.read(tmp_path / "valve.vtp"), riis.Surface(found.valve, **found.placement)
    assert numpy.array_equal(made.faces.reshape(-1, 4)[:, 1:], known.triangles.vertex_id)
    assert numpy.allclose(made.points, known.vertices, rtol=0.0, atol=1e-6)  # the file may have single precision


def test_the_file_has_all_parameters(tmp_path):
    points = fit_table.cloud("mitral", 200, 0.02)
    found = riis.fit(points, "mitral", free=["opening"], n_starts=1)
    options = found.write(tmp_path / "valve.json")
    values = json.loads((tmp_path / "valve.json").read_text())
    assert list(values) == list(found.valve) and values["opening"] == found.valve["opening"]
    assert values["translation"] == [0.0, 0.0, 1.0]
    assert options.startswith(f"--valve mitral --params {tmp_path / 'valve.json'} --scale 1 --rotate=")


def test_a_valve_that_is_more_than_its_parameters_is_not_written(tmp_path):
    valve = riis.Valve("trileaflet")
    valve.set_open_state(riis.Valve("trileaflet", bending_angle=30.0))
    found = riis.fit(fit_table.cloud("trileaflet", 200, 0.02), valve, free=["opening"], n_starts=1)
    with pytest.raises(riis.InvalidArgumentError, match="valve: has patches or an open state of its own"):
        found.write(tmp_path / "valve.json")
    assert not (tmp_path / "valve.json").exists()


def test_rotations_go_to_axis_and_angle_and_back():
    """The library is the reference: it places a surface by an axis and an angle."""
    valve = riis.Valve("bileaflet")
    surface = riis.Surface(valve)
    known = numpy.array(surface.vertices)
    random = numpy.random.default_rng(3)
    rotations = [*random_rotations(random, 200), numpy.eye(3), numpy.diag([1.0, -1.0, -1.0]), numpy.diag([-1.0, 1.0, -1.0])]
    for angle in (1e-10, 1e-5, numpy.pi - 1e-10, numpy.pi - 1e-5, numpy.pi):
        axis = random.normal(size=3)
        rotations.append(matrix_of(axis / numpy.linalg.norm(axis) * angle))
    for rotation in rotations:
        assert numpy.allclose(rotation @ rotation.T, numpy.eye(3), atol=1e-12) and numpy.linalg.det(rotation) > 0.0
        axis, angle = axis_and_angle(rotation)
        surface.update(valve, rotation_axis=axis, rotation_angle=angle)
        assert numpy.allclose(surface.vertices, known @ rotation.T, atol=1e-8)
    mean = numpy.mean(rotations[:200], axis=0)
    assert abs(mean).max() < 0.25  # the rotations cover all directions


def test_half_of_the_weight_lies_below_the_median():
    random = numpy.random.default_rng(4)
    for _ in range(200):
        values, times = random.normal(size=9), random.integers(1, 6, 9)
        repeated = numpy.sort(numpy.repeat(values, times))
        assert weighted_median(values, times.astype(float)) == repeated[(len(repeated) - 1) // 2]


POINTS = numpy.zeros((50, 3))


@pytest.mark.parametrize(
    "kind, text, points, options",
    [
        (TypeError, "points: must be a numpy array of float64, .* not list", [[0.0] * 3], {}),
        (TypeError, "points: must be .* not an array of float32", POINTS.astype("f4"), {}),
        (riis.InvalidArgumentError, r"points: its shape is \(3, 50\)", POINTS.T, {}),
        (riis.InvalidArgumentError, r"points: its shape is \(150,\)", POINTS.ravel(), {}),
        (riis.InvalidArgumentError, r"points: row 0 is \[nan, nan, nan\]", POINTS + numpy.nan, {}),
        (riis.InvalidArgumentError, "points: 3 have a weight, fewer than the 7 unknowns", POINTS[:3], {}),
        (riis.InvalidArgumentError, "points: 0 have a weight", POINTS[:0], {}),
        (riis.InvalidArgumentError, "points: 0 have a weight", POINTS, {"weights": numpy.zeros(50)}),
        (TypeError, "valve: must be a kind or a riis.Valve, not int", POINTS, {"valve": 3}),
        (riis.InvalidParameterError, "'tricuspid' is not a kind", POINTS, {"valve": "tricuspid"}),
        (TypeError, "free: must be a list of names, not 'opening'", POINTS, {"free": "opening"}),
        (TypeError, r"free: must be a list of names, not \[3\]", POINTS, {"free": [3]}),
        (riis.InvalidArgumentError, "free: 'height' is not a parameter", POINTS, {"free": ["height"]}),
        (riis.InvalidArgumentError, "free: 'translation' has three", POINTS, {"free": ["translation"]}),
        (riis.InvalidArgumentError, "free: and placement are empty", POINTS, {"free": [], "placement": []}),
        (TypeError, "bounds: must be a dict", POINTS, {"bounds": [(0.0, 1.0)]}),
        (TypeError, "bounds: those of 'opening' must be two numbers, not 0.5", POINTS, {"bounds": {"opening": 0.5}}),
        (riis.InvalidArgumentError, "bounds: those of 'opening' are 0.5 and 0.2", POINTS, {"bounds": {"opening": (0.5, 0.2)}}),
        (riis.InvalidArgumentError, "bounds: those of 'opening' are 0.5 and 1.2", POINTS, {"bounds": {"opening": (0.5, 1.2)}}),
        (riis.InvalidArgumentError, "bounds: those of 'opening' are nan", POINTS, {"bounds": {"opening": (numpy.nan, 1.0)}}),
        (riis.InvalidArgumentError, "bounds: 'AP_diameter' is not in free", POINTS, {"bounds": {"AP_diameter": (1.0, 2.0)}}),
        (TypeError, "weights: must be a numpy array of float64, not list", POINTS, {"weights": [1.0] * 50}),
        (TypeError, "weights: must be .* not an array of int64", POINTS, {"weights": numpy.ones(50, int)}),
        (riis.InvalidArgumentError, r"weights: its shape is \(3,\); there are 50 points", POINTS, {"weights": numpy.ones(3)}),
        (riis.InvalidArgumentError, "weights: entry 0 is -1.0", POINTS, {"weights": -numpy.ones(50)}),
        (riis.InvalidArgumentError, "weights: entry 0 is inf", POINTS, {"weights": numpy.full(50, numpy.inf)}),
        (riis.InvalidArgumentError, "placement: 'shear' is not one of", POINTS, {"placement": ["shear"]}),
        (TypeError, "placement: must be a list of names, not 'rotation'", POINTS, {"placement": "rotation"}),
        (TypeError, "start: must be a dict", POINTS, {"start": 3.0}),
        (riis.InvalidArgumentError, "start: 'angle' is not one of", POINTS, {"start": {"angle": 1.0}}),
        (riis.InvalidArgumentError, "scale is 0", POINTS, {"start": {"scale": 0.0}}),
        (TypeError, "rotation_axis: must be three numbers", POINTS, {"start": {"rotation_axis": "z"}}),
        (riis.InvalidArgumentError, "translation is inf", POINTS, {"start": {"translation": (0.0, 0.0, numpy.inf)}}),
        (TypeError, "n_starts: must be an int, not 1.5", POINTS, {"n_starts": 1.5}),
        (riis.InvalidArgumentError, "n_starts: is 0; it must be at least 1", POINTS, {"n_starts": 0}),
        (TypeError, "seed: must be an int, not None", POINTS, {"seed": None}),
        (riis.InvalidArgumentError, "seed: is -1; it must be at least 0", POINTS, {"seed": -1}),
        (TypeError, "whole: must be True or False, not 1", POINTS, {"whole": 1}),
    ],
)
def test_refused(kind, text, points, options):
    given = {"valve": "mitral", "free": ["opening"], **options}
    with pytest.raises(kind, match=text):
        riis.fit(points, given.pop("valve"), **given)


def test_values_that_clash_are_refused():
    clashing = riis.Valve("mitral", triangle_size_ratio=0.3)
    with pytest.raises(riis.InvalidParameterError, match="triangle_size_ratio"):
        riis.fit(POINTS, clashing, free=["opening"])


def test_values_that_clash_are_passed_over():
    """For half of the bounds there is no valve: the triangles must fit beside the anterior leaflet."""
    points = fit_table.cloud("mitral", 400, 0.01)
    start = riis.Valve("mitral", **fit_table.VALVES["mitral"])
    start["triangle_size_ratio"] = 0.19
    found = riis.fit(points, start, free=["triangle_size_ratio"], n_starts=4, start=fit_table.PLACEMENT)
    assert abs(found.parameters["triangle_size_ratio"] - 0.1) < 0.02
