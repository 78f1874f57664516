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

import fit_study
import fit_table
import riis
from riis._fit_problem import (
    FINE,
    Mixture,
    Pose,
    Problem,
    axis_and_angle,
    is_fixed_size,
    matrix_of,
    random_rotations,
    weighted_median,
    wide_loss,
)
from riis._fit_search import likeliest_spread, simulated

ROOT = pathlib.Path(__file__).resolve().parents[2]


@pytest.mark.parametrize("kind", ["mitral", "aortic", "coapting", "trileaflet", "bileaflet", "bicuspid", "quadricuspid",
                                  "mitral_coapting", "tricuspid"])
def test_known_valves_are_found_again(kind):
    true = fit_table.VALVES[kind]
    points = fit_table.cloud(kind, 600, 0.01, outliers=0.02)
    n_starts = 6 if kind == "bicuspid" else 3  # two cusps are alike, so starts with other sectors are led astray
    found = riis.fit(points, kind, free=list(true), n_starts=n_starts, start={"rotation_angle": 0.0})
    assert found.undetermined == () and found.at_bounds == ()
    assert found.n_agreeing >= 2 and 3 <= found.n_starts <= n_starts and 0.0 < found.outliers < 0.06
    for name, value in true.items():
        most = 5.0 if name.endswith(".sector") else 0.15
        assert abs(found.parameters[name] - value) < 5.0 * found.standard_errors[name] < most, name
        assert found.valve[name] == found.parameters[name]
    assert 0.005 < found.rms < 0.02  # the noise along the normal is 0.01
    # The fitted surface is the known surface: points without noise have small distances from it.
    clean = fit_table.cloud(kind, 500, 0.0, seed=1)
    surface = riis.Surface(found.valve, **found.placement)
    assert numpy.percentile(surface.closest_points(clean).distance, 90) < 0.02
    # The distances in the result are distances to the surface, and the measures follow from them.
    assert numpy.allclose(found.distances, surface.closest_points(points).distance, atol=0.01)
    far = found.distances[:12] > 0.05  # the first twelve points are outliers, a few of which lie on the surface by chance
    assert far.sum() > 6 and found.weights[:12][far].max() < 0.5 < numpy.median(found.weights)
    assert found.doubts == () and found.n_crossings == 0 and found.covered > 0.95
    assert numpy.isclose(found.percentile95, numpy.percentile(found.distances, 95.0))
    assert numpy.isclose(found.rms, numpy.sqrt(numpy.average(found.distances**2, weights=found.weights)))
    assert all(name in found.report() for name in true) and "95 % of 600 points" in found.report()


def test_a_valve_is_found_wherever_it_lies():
    """The fit gets no start, although the points are turned by more than a quarter turn and are far from the origin."""
    placement = {"rotation_axis": (1.0, -2.0, 0.5), "rotation_angle": 140.0, "translation": (120.0, -40.0, 300.0)}
    true = fit_table.VALVES["aortic"]
    found = riis.fit(fit_table.cloud("aortic", 800, 0.02, placement=placement), "aortic", free=list(true))
    for name, value in true.items():
        assert abs(found.parameters[name] - value) < 5.0 * found.standard_errors[name], name
    # The whole valve lies where the known valve lies, with each cusp at its own place.
    known = riis.Surface(riis.Valve("aortic", **true), **placement).closest_points(numpy.zeros((1, 3))).point
    surface = riis.Surface(found.valve, **found.placement)
    assert surface.closest_points(known).distance[0] < 0.02
    assert numpy.linalg.norm(numpy.array(found.placement["translation"]) - placement["translation"]) < 0.05


def test_edges_are_where_the_points_end():
    """The cost of a fit includes the area, because otherwise a disk that is too large would fit as well as the right disk."""
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
    assert again.parameters == found.parameters  # both fits have the same points and weights
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


def test_a_second_name_frees_its_parameter():
    points = fit_table.cloud("trileaflet", 400, 0.01)
    options = {"n_starts": 1, "start": {"translation": (0.0, 0.0, 0.0)}}
    first = riis.fit(points, "trileaflet", free=["root_radius"], bounds={"root_radius": (1.0, 1.5)}, **options)
    second = riis.fit(points, "trileaflet", free=["annulus"], bounds={"annulus": (2.0, 3.0)}, **options)
    assert first.parameters == second.parameters and second.valve["annulus"] == 2.0 * second.parameters["root_radius"]
    with pytest.raises(riis.InvalidArgumentError, match="^free: 'anulus' is not .* valve; did you mean 'annulus'"):
        riis.fit(points, "trileaflet", free=["anulus"])


def test_what_the_data_do_not_say_is_told():
    """A closed valve is the same for any open radius, so the data do not determine this radius."""
    valve = riis.Valve("trileaflet", opening=0.0)
    valve.update(dict(valve))  # sets all parameters, so that no other size follows the free size by a rule
    points = numpy.array(riis.Surface(valve).vertices[::5])
    free = ["leaflet_height", "open_radius_ratio"]
    found = riis.fit(points, valve, free=free, placement=["translation"], n_starts=1, whole=False)
    assert found.undetermined == found.without_influence == ("open_radius_ratio",)
    assert "undetermined, has no influence" in found.report()
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


def problem_of(kind, points, whole=True, thickness=0.0):
    """Returns a problem with all sizes of a known valve free, and unknowns in the middle of their bounds."""
    valve, names = riis.Valve(kind), list(fit_table.VALVES[kind])
    bounds = numpy.array([sorted((0.5 * valve[name], 1.5 * valve[name])) if name != "opening" else (0.0, 0.8) for name in names])
    problem = Problem(points, numpy.ones(len(points)), valve, names, bounds, ["rotation", "translation", "scale"], 4.0, whole,
                      FINE, thickness, 0.0)
    problem.begin(Pose(matrix_of(numpy.array([0.1, 0.2, 0.3])), numpy.array([0.1, 0.2, -0.1]), 1.1))
    middle = [0.45 + 0.02 * name.startswith("cusp_1.") for name in names]  # unequal cusps, as in a fit
    return problem, numpy.concatenate([middle, 0.02 * numpy.ones(problem.n - len(names))])


@pytest.mark.parametrize("thickness", [0.0, 0.3])
@pytest.mark.parametrize("kind", list(fit_table.VALVES))
def test_derivatives_are_those_of_new_closest_points(kind, thickness):
    """The derivatives move closest points with their triangles. The oracle searches the closest points again."""
    points = numpy.random.default_rng(5).uniform(-1.5, 1.5, (300, 3))
    problem, x = problem_of(kind, points, thickness=thickness)
    jacobian, area = problem.jacobian(x)
    for i in range(problem.n):
        ends = []
        for step in (1e-5, -1e-5):
            moved = x.copy()
            moved[i] += step
            ends.append(problem.look(moved))
        difference = (ends[0].residual - ends[1].residual) / 2e-5
        close = numpy.abs(difference - jacobian[:, i]) < 1e-3 * (1.0 + numpy.abs(difference))
        assert close.mean() > 0.97, i  # the few other derivatives change from one triangle to another
        assert abs((ends[0].log_area - ends[1].log_area) / 2e-5 - area[i]) < 1e-3


def test_derivatives_by_fixed_sizes_are_those_of_new_closest_points():
    """A column is the derivative for a change by the whole value of a size, or by a radian."""
    points = numpy.random.default_rng(6).uniform(-1.5, 1.5, (300, 3))
    problem, x = problem_of("coapting", points)
    jacobian, areas = problem.fixed_jacobian(x)
    valve, fixed = problem.valve, []
    for name, parameter in valve.parameters.items():
        is_own = "." not in name  # the sizes of single cusps follow the valve's, and there is no bump
        if name not in problem.names and parameter.n_values == 1 and name != "opening" and valve[name] != 0.0 and is_own:
            fixed.append((name, valve[name], numpy.degrees(1.0) if parameter.unit == "degree" else valve[name]))
    assert jacobian.shape == (len(points), len(fixed)) and len(fixed) > 3
    for (name, value, whole), column, area in zip(fixed, jacobian.T, areas):
        ends = []
        for step in (1e-5, -1e-5):
            valve[name] = value + step * whole
            problem.surface_at = None
            ends.append(problem.look(x))
        valve[name] = value
        difference = (ends[0].residual - ends[1].residual) / 2e-5
        close = numpy.abs(difference - column) < 1e-3 * (1.0 + numpy.abs(difference))
        assert close.mean() > 0.97, name
        assert abs((ends[0].log_area - ends[1].log_area) / 2e-5 - area) < 1e-3, name


@pytest.mark.parametrize("thickness", [0.0, 0.2])
def test_simulated_points_lie_on_the_surface_or_on_its_faces(thickness):
    """The residuals of simulated points have the noise, and the problem keeps its own points."""
    points = numpy.random.default_rng(17).uniform(-1.5, 1.5, (50, 3))
    problem, x = problem_of("bileaflet", points, thickness=thickness)
    own = problem.look(x).residual
    noise = 0.01
    made = simulated(problem, x, noise, 4000, numpy.random.default_rng(18))
    residual = problem.with_points(made).look(x).residual
    assert 3000 < len(made) <= 4000 and abs(residual.mean()) < 0.1 * noise
    assert 0.9 * noise < numpy.sqrt((residual**2).mean()) < 1.1 * noise
    assert problem.points is points and (problem.look(x).residual == own).all()


def test_the_likeliest_spread_is_that_of_normal_distributions():
    """The oracle has the densities of normal distributions, for each of the spreads that are tried."""
    for seed in range(200):
        random = numpy.random.default_rng(seed)
        n = random.integers(1, 6)
        root, mixed = random.normal(size=(2, n, n))
        chance, response = root @ root.T + 0.1 * numpy.eye(n), 10.0 * mixed @ mixed.T
        pull = response @ random.normal(0.0, 0.3, n) + root @ random.normal(size=n)
        evidence, mean, covariance = likeliest_spread(pull, response, chance, False)
        rounded = chance + 1e-6 * numpy.eye(n)

        def density(spread):
            whole = rounded + spread * response @ response
            return -0.5 * (numpy.linalg.slogdet(whole)[1] + pull @ numpy.linalg.solve(whole, pull))

        spreads = numpy.logspace(-4.0, 0.0, 41)
        ratios = [density(spread) - density(0.0) for spread in spreads]
        spread = spreads[numpy.argmax(ratios)]
        assert abs(evidence - max(ratios)) < 1e-9 * (1.0 + abs(evidence)), seed
        gain = spread * response @ numpy.linalg.inv(rounded + spread * response @ response)
        assert numpy.allclose(mean, gain @ pull, rtol=1e-6, atol=1e-9), seed
        assert numpy.allclose(covariance, spread * (numpy.eye(n) - gain @ response), rtol=1e-6, atol=1e-9), seed


def test_a_surface_is_updated_after_derivatives():
    """A jacobian at one place leaves the values of this place, whatever surface was evaluated last."""
    points = numpy.random.default_rng(7).uniform(-1.5, 1.5, (50, 3))
    problem, x = problem_of("mitral", points)
    first, area = problem.jacobian(x)
    seen, moved = problem.last, x.copy()
    moved[:2] += 0.2
    problem.at(moved)
    problem.last = seen  # as if the move had been refused
    again, area_again = problem.jacobian(x)
    assert numpy.array_equal(first, again) and numpy.array_equal(area, area_again)
    assert [problem.valve[name] for name in problem.names] == problem.values(x).tolist()


def test_weights_are_derivatives_of_the_losses():
    r = numpy.linspace(-0.2, 0.2, 81)
    for loss in (wide_loss(0.1), Mixture(0.03, 0.1, 1.0).loss(True), Mixture(0.02, 0.002, 0.5).loss(False)):
        slope = (loss.value(r + 1e-6) - loss.value(r - 1e-6)) / 2e-6
        assert numpy.allclose(slope, loss.weight(r) * r, rtol=1e-5, atol=1e-5)
    r = numpy.linspace(-1.0, 1.0, 200_001)
    assert abs(numpy.exp(-Mixture(0.03, 0.2, 1.0).value(r)).mean() * 2.0 - 1.0) < 1e-4  # the integral of a density is 1


def known(kind, true, points, noise=0.02, **options):
    """Returns the examined fit of points of a known valve, from any rotation."""
    placed = points @ fit_study.rotation_of(numpy.array([1.0, -0.5, 2.0])).T + numpy.array([5.0, 40.0, -3.0])
    placed = placed + numpy.random.default_rng(6).normal(0.0, noise, points.shape)
    one = fit_study.Patient(kind, "known", 0, true, placed, noise, {"free": list(true), **options})
    return fit_study.examine(one)


TRILEAFLET = {"root_radius": 1.15, "leaflet_height": 1.3, "opening": 0.2}


@pytest.mark.parametrize("kind, whole", [("trileaflet", True), ("trileaflet", False), ("aortic", False)])
def test_a_fit_to_one_leaflet_of_three_is_right_or_flagged(kind, whole):
    """An earlier version had this fault: the height had an error of 1.1 and a standard error of 0.0025."""
    true = {**TRILEAFLET} if kind == "trileaflet" else {"root_radius": 1.2, "leaflet_height": 1.1, "bending_height": 0.65}
    surface = riis.Surface(riis.Valve(kind, **true), half_thickness=0.05, tolerance=0.02)
    points, _ = fit_study.points_on(numpy.random.default_rng(7), surface, 400, lambda middle, leaflet_id: leaflet_id == 0)
    one = known(kind, true, points, whole=whole)
    assert not one.wrong(), one.found.report()
    assert one.found.covered < 0.6 and any(doubt.startswith("cover") for doubt in one.found.doubts) == whole


@pytest.mark.parametrize("whole", [True, False])
def test_a_fit_to_an_attachment_is_right_or_flagged(whole):
    """An earlier version had this fault: the radius was 2.27 with a standard error of 0.15, although thirty points of an edge do
    not determine the opening."""
    surface = riis.Surface(riis.Valve("trileaflet", **TRILEAFLET))
    edges = surface.attachment.edges.mean(axis=1)
    one = known("trileaflet", TRILEAFLET, edges[numpy.random.default_rng(8).choice(len(edges), 30)], whole=whole)
    assert not one.wrong(), one.found.report()
    assert "opening" in one.found.undetermined or one.found.doubts


@pytest.mark.parametrize("whole", [True, False])
def test_a_fifth_of_outliers_is_left_out(whole):
    """An earlier version had this fault: a size had an error of 0.9. Since the points cover the valve, the fit must have no
    doubts."""
    random = numpy.random.default_rng(9)
    surface = riis.Surface(riis.Valve("trileaflet", **TRILEAFLET), half_thickness=0.05, tolerance=0.02)
    points, _ = fit_study.points_on(random, surface, 500)
    points[:100] = random.uniform(points.min(axis=0) - 0.5, points.max(axis=0) + 0.5, (100, 3))
    one = known("trileaflet", TRILEAFLET, points, whole=whole)
    assert not one.wrong() and one.found.doubts == () and one.found.undetermined == (), one.found.report()
    assert 0.15 < one.found.outliers < 0.25


def test_random_patients_are_right_or_flagged():
    """The first patients of ./run fit-study. For whole valves every size is determined, and errors are as large as the standard
    errors say."""
    first = int(os.environ.get("RIIS_TEST_SEED", "0"))
    print(f"seeds {first} to {first + 19}; RIIS_TEST_SEED sets the first")
    patients = [fit_study.examine(fit_study.patient(seed)) for seed in range(first, first + 20)]
    for one in patients:
        if one.wrong():
            fit_study.tell(one)
    print("\n".join(fit_study.table(patients)))
    assert sum(bool(one.wrong()) for one in patients) <= 1  # 5 %
    whole = [one for one in patients if one.case in fit_study.WHOLE]
    assert len(whole) >= 8 and {one.kind for one in patients} == set(fit_study.KINDS)
    assert sum(len(one.found.undetermined) for one in whole) <= 1
    ratios = [error / stated for one in whole for _, error, stated, _ in one.size_errors]
    assert len(ratios) > 20 and 1.0 / 3.0 < numpy.sqrt(numpy.mean(numpy.square(ratios))) < 1.2
    assert numpy.mean(numpy.array(ratios) <= 3.0) >= 0.95


@pytest.mark.parametrize("seed", [7020, 7039, 7053, 7254, 50047, 50249])
def test_whole_valves_whose_sizes_were_undetermined(seed):
    """Cases from past faults. Patient 7020 starts with far too large roots (see also test_starts_are_near_enough). In patient
    7053, three of 26 parts determine a length. By chance, the points of these three parts have large residuals. In patients 7039
    and 7254, a few points near the edges of two closed disks pull as if the housing had other angles. In patient 50047, two root
    radii are equally likely. In patient 50249, a profile looked too far."""
    one = fit_study.examine(fit_study.patient(seed))
    assert one.found.doubts == () and one.found.undetermined == () and not one.wrong(), one.found.report()


def test_a_pull_beyond_chance_leaves_a_size_undetermined():
    """The fixed sizes of this valve are wrong. Simulated points do not explain the pull of these sizes, so the doubt stays."""
    one = fit_study.examine(fit_study.patient(1061))
    assert one.case == "other shape" and one.found.undetermined == ("root_radius",) and not one.wrong(), one.found.report()


@pytest.mark.parametrize("seed", [104, 117, 134])
def test_starts_are_near_enough(seed):
    """With these seeds, a start that does not choose among valves reaches this patient's fit in at most one of 20 cases."""
    one = fit_study.patient(7020)
    one.options["seed"] = seed
    found = fit_study.examine(one).found
    assert found.doubts == () and found.undetermined == () and found.n_starts < 20, found.report()


@pytest.mark.parametrize("seed", [7178, 7238, 7263])
def test_sizes_without_influence_are_named(seed):
    """In a closed mitral valve the length of the posterior scallop moves nearly nothing. An eighth of its range, to either side,
    moves the surface by less than an eighth of the noise."""
    name = "posterior_scallop_length1"
    one = fit_study.examine(fit_study.patient(seed))
    found, noise = one.found, one.noise / (10.0 if "unit" in one.options else 1.0)
    assert found.undetermined == found.without_influence == (name,) and one.true["opening"] < 0.04, found.report()
    true = riis.Surface(riis.Valve("mitral", **one.true), half_thickness=0.05, tolerance=0.01)
    points, _ = fit_study.points_on(numpy.random.default_rng(15), true, 2000)
    span = 1.5 * riis.Valve("mitral")[name]
    for change in (-0.125, 0.125):
        other = riis.Surface(riis.Valve("mitral", **{**one.true, name: one.true[name] + change * span}), half_thickness=0.05,
                             tolerance=0.01)
        moved = numpy.sqrt((other.closest_points(points, n_threads=1).distance ** 2).mean())
        print(f"seed {seed}: {change} of the range moves the surface by {moved:.5f}, the noise is {noise:.4f}")
        assert moved < 0.125 * noise


def test_sizes_that_trade_with_the_placement_have_an_influence():
    """A rotation of the valve moves a single disk in the same way as the opening does. The data therefore determine neither
    rotation nor opening, although each of them moves the disk."""
    valve = riis.Valve("bileaflet", opening=0.4)
    random, disk = numpy.random.default_rng(16), lambda middle, leaflet_id: leaflet_id == 0
    points, _ = fit_study.points_on(random, riis.Surface(valve), 400, disk)
    start = {"rotation_angle": 0.0, "translation": (0.0, 0.0, 0.0)}
    found = riis.fit(points, valve, free=["opening"], start=start, n_starts=1, whole=False)
    assert "opening" in found.undetermined and "rotation" in found.undetermined, found.report()
    assert found.without_influence == () and "no influence" not in found.report()


def test_every_kind_is_studied():
    with pytest.raises(riis.InvalidParameterError) as refused:
        riis.Valve("none")
    kinds = set(str(refused.value).split("there are: ")[1].split(". ")[0].split(", "))
    assert set(fit_table.VALVES) == kinds
    assert set(fit_study.KINDS) | set(fit_study.NO_PATIENTS) == kinds


def test_sectors_have_a_sum_of_360():
    """All sectors free, or all but one, or one of the start values whose sum is not 360: the result is the same valve."""
    sizes = {"cusp_0.sector": 150.0, "cusp_1.sector": 210.0}
    true = riis.Valve("bicuspid", opening=0.5, **sizes)
    points, _ = fit_study.points_on(numpy.random.default_rng(21), riis.Surface(true), 500, None)
    options = {"start": {"rotation_angle": 0.0, "translation": (0.0, 0.0, 0.0)}, "n_starts": 1, "noise": 0.01}
    points = points + numpy.random.default_rng(22).normal(0.0, 0.01, points.shape)
    for start, free in (({}, list(sizes)), ({}, ["cusp_0.sector"]), ({"cusp_0.sector": 80.0, "cusp_1.sector": 80.0},
                                                                     ["cusp_1.sector"])):
        found = riis.fit(points, riis.Valve("bicuspid", opening=0.5, **start), free=free, **options)
        assert list(found.parameters) == free and sum(found.valve[name] for name in sizes) == pytest.approx(360.0)
        for name, value in sizes.items():
            assert abs(found.valve[name] - value) < 1.5, found.report()
        for name in free:
            assert found.parameters[name] == found.valve[name]
            assert abs(found.parameters[name] - sizes[name]) < 4.0 * found.standard_errors[name] < 4.0
    assert found.standard_errors == pytest.approx({"cusp_1.sector": found.standard_errors["cusp_1.sector"]})


def test_a_bump_is_fitted_at_a_known_place():
    """How far a cusp opens at one place is found. The other bumps and the sizes of the cusps are not fixed sizes."""
    place = {"bump_0.leaflet": 1, "bump_0.width": 0.3}
    true = riis.Valve("coapting", opening=0.9, **place, **{"bump_0.open": 0.4})
    points, _ = fit_study.points_on(numpy.random.default_rng(23), riis.Surface(true), 600, None)
    points = points + numpy.random.default_rng(24).normal(0.0, 0.01, points.shape)
    valve = riis.Valve("coapting", opening=0.9, **place)
    names = [name for name in valve if is_fixed_size(valve, name)]
    assert [name for name in names if "." in name] == [f"bump_0.{name}" for name in ("u", "width", "closed", "open")]
    found = riis.fit(points, valve, free=["bump_0.open"], noise=0.01, n_starts=2,
                     start={"rotation_angle": 0.0, "translation": (0.0, 0.0, 0.0)})
    assert abs(found.parameters["bump_0.open"] - 0.4) < 4.0 * found.standard_errors["bump_0.open"] < 0.2, found.report()
    for name in "bump_0.leaflet", "bump_3.commissure":
        with pytest.raises(riis.InvalidArgumentError, match=f"free: '{name}' is the whole number of a place"):
            riis.fit(points, valve, free=[name])
    sectors = [f"cusp_{k}.sector" for k in range(3)]
    with pytest.raises(riis.InvalidArgumentError, match="bounds: all sectors are free, so 'cusp_2.sector' follows"):
        riis.fit(points, valve, free=sectors, bounds={"cusp_2.sector": (100.0, 140.0)})


def test_points_on_both_faces_lie_at_half_the_thickness():
    points = fit_study.faces_of(numpy.random.default_rng(10), riis.Surface(riis.Valve("bileaflet", opening=0.3)), 500, 0.2)
    options = {"start": {"rotation_angle": 0.0}, "free": ["opening"]}
    one = known("bileaflet", {"opening": 0.3}, points, noise=0.005, thickness=0.2).found
    assert abs(one.parameters["opening"] - 0.3) < 3.0 * one.standard_errors["opening"] < 0.02
    assert one.noise < 0.01 and abs(numpy.median(one.distances) - 0.1) < 0.005
    without = riis.fit(points, "bileaflet", n_starts=2, **options)
    assert without.noise > 0.08  # half of the thickness counts as noise


def test_a_unit_scales_the_placement_and_not_the_sizes():
    points = fit_table.cloud("trileaflet", 300, 0.02)
    options = {"free": list(fit_table.VALVES["trileaflet"]), "n_starts": 2, "start": {"rotation_angle": 0.0}}
    cm, mm, m = (riis.fit(scale * points, "trileaflet", unit=unit, **options)
                 for scale, unit in ((1.0, "cm"), (10.0, "mm"), (0.01, "m")))
    for other, scale in ((mm, 10.0), (m, 0.01)):
        assert other.placement["scale"] == scale and abs(other.noise / cm.noise - scale) < 1e-3 * scale
        for name, value in cm.parameters.items():
            assert abs(other.parameters[name] - value) < 0.02 * cm.standard_errors[name]
            assert abs(other.standard_errors[name] - cm.standard_errors[name]) < 0.05 * cm.standard_errors[name]
    # A report says the unit of each length: the sizes are in centimetres, and all else in the points' unit.
    for found, unit in ((cm, "cm"), (mm, "mm"), (m, "m"), (riis.fit(points, "trileaflet", **options), None)):
        lines = found.report().splitlines()
        of_points, of_sizes = ("", "length") if unit is None else (" " + unit, "cm")
        assert found.unit == unit and all(line.split()[3] == of_sizes for line in lines if line.startswith(("root", "leaflet_h")))
        (translation,) = (line for line in lines if line.startswith("translation"))
        assert translation.split()[4:] == of_points.split()
        (measures,) = (line for line in lines if line.startswith("rms"))
        assert f"rms {found.rms:.4f}{of_points}, " in measures and f"within {found.percentile95:.4f}{of_points}, " in measures


def test_a_larger_scatter_than_the_stated_noise_is_doubted():
    points = fit_table.cloud("trileaflet", 300, 0.03)
    options = {"free": ["opening"], "n_starts": 2, "start": fit_table.PLACEMENT}
    start = riis.Valve("trileaflet", **fit_table.VALVES["trileaflet"])
    found, low, high = (riis.fit(points, start, noise=noise, **options) for noise in (0.03, 0.01, 0.09))
    assert found.doubts == high.doubts == () and [doubt[:5] for doubt in low.doubts] == ["noise"]
    assert low.doubts[0] in low.report() and "stated noise is 0.01" in low.doubts[0]
    assert high.standard_errors["opening"] > 2.0 * found.standard_errors["opening"]  # the stated noise widens the errors


def test_a_wrong_model_is_doubted_and_widens_the_errors():
    """The fit keeps the bending height. The known valve has another bending height than the start."""
    true = {"root_radius": 1.2, "leaflet_height": 1.25, "opening": 0.3}
    found = []
    for height in (0.625, 0.85):  # the rule gives the first value, half of leaflet_height
        surface = riis.Surface(riis.Valve("trileaflet", **true, bending_height=height), half_thickness=0.05, tolerance=0.01)
        points, _ = fit_study.points_on(numpy.random.default_rng(11), surface, 600)
        found.append(known("trileaflet", true, points, noise=0.01).found)
    right, wrong = found
    assert right.misfit < 2.0 and right.doubts == ()
    assert wrong.misfit > 3.0 and any(doubt.startswith("misfit") for doubt in wrong.doubts)
    for name in true:
        assert wrong.standard_errors[name] > 2.0 * right.standard_errors[name]


def test_two_places_that_fit_equally_are_rivals():
    """The points lie on one of the two open disks, which are parallel. The points fit both disks, so a shift by the distance of
    the disks gives a rival."""
    valve = riis.Valve("bileaflet", opening=1.0, open_angle=90.0)
    surface = riis.Surface(valve)
    points, _ = fit_study.points_on(numpy.random.default_rng(13), surface, 200, lambda middle, leaflet_id: leaflet_id == 0)
    points += numpy.array([3.0, 0.0, 0.0])
    options = {"free": [], "placement": ["translation"], "start": {"rotation_angle": 0.0}, "whole": False, "noise": 0.01}
    n_found = 0
    for seed in range(6):  # four starts may all go to the same disk
        found = riis.fit(points, valve, seed=seed, **options)
        if found.rivals:
            n_found += 1
            assert found.rivals[0].excess < 0.5 and any(doubt.startswith("rivals") for doubt in found.doubts)
            places = sorted([found.placement["translation"][0], found.rivals[0].placement["translation"][0]])
            assert numpy.allclose(places, [3.0, 3.0 + 2.0 * valve["hinge_offset"]], atol=0.01) and "rival" in found.report()
    assert n_found >= 3


def test_a_start_may_be_a_valve_with_a_placement():
    points = fit_table.cloud("mitral", 300, 0.01)
    options = {"free": list(fit_table.VALVES["mitral"]), "n_starts": 1}
    first = riis.fit(points, "mitral", start=fit_table.PLACEMENT, **options)
    again = riis.fit(points, "mitral", start=first, **options)
    for name, value in first.parameters.items():
        assert abs(again.parameters[name] - value) < 0.1 * first.standard_errors[name]
    assert first.n_starts == again.n_starts == 1 and again.doubts[0].startswith("starts: 1 of 1 starts")


def test_landmarks_may_start_a_fit():
    """Two of three leaflets in millimetres are upside down. One start from six landmarks with errors of 0.5 mm finds the
    sizes. Without the landmarks, the single start is wrong and doubted."""
    random = numpy.random.default_rng(14)
    surface = riis.Surface(riis.Valve("trileaflet", **TRILEAFLET), half_thickness=0.05, tolerance=0.02)
    points, _ = fit_study.points_on(random, surface, 500, lambda middle, leaflet_id: leaflet_id < 2)
    rotation, shift = fit_study.rotation_of(numpy.array([2.9, 0.5, 0.3])), numpy.array([50.0, 400.0, -30.0])
    points = 10.0 * points @ rotation.T + shift + random.normal(0.0, 0.2, points.shape)
    turns = numpy.radians([0.0, 120.0, 240.0, 60.0, 180.0, 300.0])
    top = numpy.repeat([0.0, TRILEAFLET["leaflet_height"]], 3)
    radius = numpy.repeat([TRILEAFLET["root_radius"], riis.Valve("trileaflet")["leaflet_radius_out"]], 3)
    places = numpy.stack([radius * numpy.cos(turns), radius * numpy.sin(turns), top], 1)
    places += riis.Valve("trileaflet")["translation"]
    names = ("nadir_right", "nadir_left", "nadir_non_coronary", "commissure_right_left", "commissure_left_non",
             "commissure_right_non")
    marks = dict(zip(names, 10.0 * places @ rotation.T + shift + random.normal(0.0, 0.5, (6, 3)), strict=True))
    landmarks = riis.place(marks, "trileaflet", unit="mm", held=["leaflet_radius_out"])
    options = {"free": list(TRILEAFLET), "unit": "mm", "whole": False, "n_starts": 1}
    found = riis.fit(points, "trileaflet", start=landmarks, **options)
    for name, true in TRILEAFLET.items():
        assert abs(found.parameters[name] - true) < max(0.02, 3.0 * found.standard_errors[name]), found.report()
    assert found.noise < 0.25
    without = riis.fit(points, "trileaflet", **options)
    assert without.noise > 0.5 or without.outliers > 0.3, without.report()


def test_a_result_that_crosses_itself_says_so():
    true = riis.Valve("trileaflet", bending_radius_in=0.1)  # the cusps then extend beyond the axis
    surface = riis.Surface(true)
    assert riis.find_crossings(surface).n_pairs > 0
    points, _ = fit_study.points_on(numpy.random.default_rng(12), surface, 300)
    options = {"free": ["leaflet_height"], "n_starts": 1, "start": {"rotation_angle": 0.0}}
    found = riis.fit(points, true, **options)
    assert found.n_crossings > 0 and f"crosses itself in {found.n_crossings} pairs" in found.report()
    assert "does not cross itself" in riis.fit(fit_table.cloud("mitral", 200, 0.01), "mitral", free=["opening"], n_starts=1,
                                               start=fit_table.PLACEMENT).report()


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
        (riis.InvalidParameterError, "'pulmonary' is not a kind", POINTS, {"valve": "pulmonary"}),
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
        (TypeError, "noise: must be a number or None, not '1'", POINTS, {"noise": "1"}),
        (TypeError, "noise: must be a number or None, not True", POINTS, {"noise": True}),
        (riis.InvalidArgumentError, "noise: is 0.0; it must be finite and greater than 0", POINTS, {"noise": 0.0}),
        (riis.InvalidArgumentError, "noise: is nan; it must be finite", POINTS, {"noise": numpy.nan}),
        (riis.InvalidArgumentError, "noise: is 2.0; it must be at most a fifth of the valve's size", POINTS, {"noise": 2.0}),
        (TypeError, r"thickness: must be a number or None, not \(0.1, 0.2\)", POINTS, {"thickness": (0.1, 0.2)}),
        (riis.InvalidArgumentError, "thickness: is -0.1; it must be finite and", POINTS, {"thickness": -0.1}),
        (riis.InvalidArgumentError, "thickness: is inf; it must be finite and", POINTS, {"thickness": numpy.inf}),
        (riis.InvalidArgumentError, "thickness: is 3.0; it must be at most a fifth of the valve's", POINTS, {"thickness": 3}),
        (TypeError, "unit: must be one of m, cm, mm, not 10.0", POINTS, {"unit": 10.0}),
        (riis.InvalidArgumentError, "unit: 'inch' is not one of m, cm, mm", POINTS, {"unit": "inch"}),
        (riis.InvalidArgumentError, "unit: 'mm' sets the scale, which placement frees", POINTS,
         {"unit": "mm", "placement": ["scale"]}),
        (riis.InvalidArgumentError, "unit: 'mm' sets the scale to 10.0, but start sets it to 2.0", POINTS,
         {"unit": "mm", "start": {"scale": 2.0}}),
        (riis.InvalidArgumentError, "points: their median distance from their middle is 1.*, that of the valve's surface is 1.*; "
         "set unit to", 10.0 * fit_table.cloud("mitral", 100, 0.0), {}),
        (riis.InvalidArgumentError, "points: their median distance from their middle is 0.0", 0.01 * fit_table.cloud(
            "mitral", 100, 0.0), {}),
        (TypeError, "start: must be a dict of a placement, or have a valve and a placement", POINTS, {"start": "mitral"}),
    ],
)
def test_refused(kind, text, points, options):
    given = {"valve": "mitral", "free": ["opening"], **options}
    with pytest.raises(kind, match=text):
        riis.fit(points, given.pop("valve"), **given)


def test_a_start_of_another_kind_is_refused():
    start = riis.fit(fit_table.cloud("mitral", 100, 0.01), "mitral", free=[], n_starts=1, start=fit_table.PLACEMENT)
    with pytest.raises(riis.InvalidArgumentError, match="start: its valve is of the kind mitral, but valve is aortic"):
        riis.fit(POINTS, "aortic", free=["opening"], start=start)


def test_patches_have_no_unit():
    knots = numpy.array([[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]])
    curves = numpy.array([knots[[a, b]] for a, b in ((0, 1), (3, 2), (0, 3), (1, 2))]).reshape(-1, 3)
    valve = riis.Valve.from_patches(numpy.ones(4, numpy.int32), curves, numpy.array([[0, 1, 2, 3]], numpy.int32))
    with pytest.raises(riis.InvalidArgumentError, match="unit: is 'mm', but the lengths of a valve from patches"):
        riis.fit(POINTS, valve, free=[], unit="mm")


def test_values_that_clash_are_refused():
    clashing = riis.Valve("mitral", triangle_size_ratio=0.3)
    with pytest.raises(riis.InvalidParameterError, match="triangle_size_ratio"):
        riis.fit(POINTS, clashing, free=["opening"])


def test_values_that_clash_are_passed_over():
    """For half of the values within the bounds there is no valve, because the two triangles must fit beside the anterior
    leaflet."""
    points = fit_table.cloud("mitral", 400, 0.01)
    start = riis.Valve("mitral", **fit_table.VALVES["mitral"])
    start["triangle_size_ratio"] = 0.19
    found = riis.fit(points, start, free=["triangle_size_ratio"], n_starts=4, start=fit_table.PLACEMENT)
    assert abs(found.parameters["triangle_size_ratio"] - 0.1) < 0.02
