# SPDX-License-Identifier: Apache-2.0
"""riis.place against scipy's least squares, and the files and names of landmarks."""

import json
import pickle

import numpy
import pytest
import riis
from scipy.optimize import least_squares
from scipy.spatial.transform import Rotation

NAMES = ("nadir_right", "nadir_left", "nadir_non_coronary", "commissure_right_left", "commissure_left_non",
         "commissure_right_non")


def trileaflet(R, Rc, h):
    """Returns the landmarks of the names above in the valve's frame, in centimetres."""
    angles = numpy.radians([0, 120, 240, 60, 180, 300])
    radii = numpy.repeat([R, Rc], 3)
    return numpy.stack([radii * numpy.cos(angles), radii * numpy.sin(angles), numpy.repeat([0, h], 3)], 1)


def patient(seed, noise=0.0, scale=10.0):
    random = numpy.random.default_rng(seed)
    sizes = random.uniform([0.9, 0.8, 1.0], [1.5, 1.4, 2.2])
    turn, shift = Rotation.random(random_state=seed), random.uniform(-50, 50, 3)
    return sizes, turn, scale * turn.apply(trileaflet(*sizes)) + shift + random.normal(scale=noise, size=(6, 3)) if noise else (
        scale * turn.apply(trileaflet(*sizes)) + shift)


def oracle(points, scale, start, turn):
    """Returns the sizes and the sum of squares of the least squares that scipy finds."""

    def residuals(x):
        return (scale * Rotation.from_rotvec(x[3:6]).apply(trileaflet(*x[:3])) + x[6:9] - points).ravel()

    first = [*start, *turn.as_rotvec(), *points.mean(axis=0)]
    found = least_squares(residuals, first, xtol=1e-14, ftol=1e-14, gtol=1e-14, max_nfev=2000)
    return found.x[:3], 2 * found.cost, found.jac


@pytest.mark.parametrize("seed", range(6))
def test_least_squares(seed):
    sizes, turn, points = patient(seed, noise=1.0)
    found = riis.place(dict(zip(NAMES, points, strict=True)), "trileaflet", unit="mm")
    expected, squares, jacobian = oracle(points, 10.0, sizes, turn)
    got = [found.valve[name] for name in ("root_radius", "leaflet_radius_out", "leaflet_height")]
    numpy.testing.assert_allclose(got, expected, rtol=1e-4)
    assert found.rms**2 * 6 == pytest.approx(squares, rel=1e-6)
    errors = found.noise * numpy.sqrt(numpy.diag(numpy.linalg.inv(jacobian.T @ jacobian)))[:3]
    # riis and scipy linearise in different frames, the valve's and the patient's. The standard errors therefore differ in
    # proportion to the residuals.
    numpy.testing.assert_allclose(list(found.standard_errors.values()), errors, rtol=1e-2)
    assert found.worst == found.residuals.max() and found.worst_landmark == NAMES[int(found.residuals.argmax())]
    # The residuals belong to the placement, because the landmarks' places are where the result puts them.
    at = found.placement
    axis, degrees = numpy.array(at["rotation_axis"]), at["rotation_angle"]
    local = trileaflet(*got) + found.valve["translation"]
    places = at["scale"] * Rotation.from_rotvec(numpy.radians(degrees) * axis).apply(local) + at["translation"]
    numpy.testing.assert_allclose(numpy.linalg.norm(places - points, axis=1), found.residuals, atol=1e-6)
    assert "NOT DETERMINED" in found.report() or not found.undetermined
    assert found.report().startswith("trileaflet valve from 6 landmarks, axes mesh, noise ")
    stated = float(found.report().split("noise ")[1].split()[0])
    assert ("which the residuals show" in found.report()) == (found.noise > 1.05 * stated)


@pytest.mark.parametrize("seed", range(3))
def test_files_agree(seed, tmp_path):
    sizes, _, points = patient(seed)
    json_file, slicer, csv = tmp_path / "a.json", tmp_path / "b.mrk.json", tmp_path / "c.csv"
    named = {name: point.tolist() for name, point in zip(NAMES, points, strict=True)}
    json_file.write_text(json.dumps({"valve": "trileaflet", "unit": "mm", "axes": "LPS", "landmarks": named}))
    turned = points * (-1, -1, 1)
    control = [{"id": str(i), "label": name.replace("_", "-"), "position": point.tolist(), "positionStatus": "defined"}
               for i, (name, point) in enumerate(zip(NAMES, turned, strict=True))]
    markups = {"type": "Fiducial", "coordinateSystem": "RAS", "coordinateUnits": "mm", "controlPoints": control}
    slicer.write_text(json.dumps({"markups": [markups]}))
    rows = [f"{name},{x!r},{y!r},{z!r}" for name, (x, y, z) in zip(NAMES, (points / 1000).tolist(), strict=True)]
    csv.write_text("# unit = m\n# axes = LPS\nname,x,y,z\n" + "\n".join(rows) + "\n")
    results = [riis.place(json_file), riis.place(slicer, "trileaflet", axes="LPS"),
               riis.place(str(csv), riis.Valve("trileaflet"), unit="mm")]
    for found in results:
        numpy.testing.assert_allclose(found.valve["root_radius"], sizes[0], rtol=1e-9)
        assert found.unit == "mm" and found.axes == "LPS" and not found.undetermined
        numpy.testing.assert_allclose(found.placement["translation"], results[0].placement["translation"], atol=1e-7)
        surface = riis.Surface(found.valve, **found.placement)
        assert surface.info.half_thickness == pytest.approx(1.0)  # 0.1 cm in millimetres
        assert surface.closest_points(points).distance.max() < 0.1
    results[0].save(tmp_path / "placed.json")
    saved = json.loads((tmp_path / "placed.json").read_text())
    assert saved["valve"] == "trileaflet" and saved["parameters"]["root_radius"] == results[0].valve["root_radius"]


def test_held_and_copied():
    _, _, points = patient(4)
    valve = riis.Valve("trileaflet", leaflet_height=1.7)
    found = riis.place(dict(zip(NAMES, points, strict=True)), valve, unit="mm", held=["leaflet_height"])
    assert found.valve["leaflet_height"] == 1.7 and "leaflet_height" not in found.determined
    assert valve["root_radius"] == 1.25  # the caller's valve stays


def test_refused(tmp_path):
    _, _, points = patient(1)
    named = dict(zip(NAMES, points, strict=True))

    def refused(text, *arguments, error=riis.InvalidArgumentError, **keywords):
        with pytest.raises(error, match=text):
            riis.place(*arguments, **keywords)

    refused("unit: it is missing", named, "trileaflet")
    refused('the unit is "inch"', named, "trileaflet", unit="inch")
    refused("the unit is centimetres.*in millimetres", named, "trileaflet", unit="cm")
    refused("valve is needed", named, unit="mm")
    refused('"nadir_rigth" is not the name of a landmark, did you mean "nadir_right".*docs/formats.md#landmarks',
            named | {"nadir_rigth": (0, 0, 0)}, "trileaflet", unit="mm")
    refused('"nadir_right": y is nan', named | {"nadir_right": (0, numpy.nan, 0)}, "trileaflet", unit="mm")
    refused("must be three numbers", named | {"nadir_right": (0, 1)}, "trileaflet", unit="mm")
    refused('"nadir-right" is given twice', named | {"nadir-right": (0, 0, 0)}, "trileaflet", unit="mm")
    refused("holds no landmarks", {}, "trileaflet", unit="mm")
    refused("axes: landmarks states the axes mesh", named, "trileaflet", unit="mm", axes="LPS")
    refused("flow", named, "trileaflet", unit="mm", flow=(1, 2))
    refused("noise: -1 is below 0", named, "trileaflet", unit="mm", noise=-1)
    refused("did you mean 'leaflet_height'", named, "trileaflet", unit="mm", held="leaflet_hight",
            error=riis.InvalidParameterError)
    swapped = named | {"nadir_left": named["nadir_right"], "nadir_right": named["nadir_left"]}
    for name in NAMES[3:]:
        swapped["commissure_" + str(NAMES.index(name))] = swapped.pop(name)
    refused("mirrored", swapped, "aortic", unit="mm")
    one = named | {"nadir_left": named["nadir_right"] + 1e-3}
    refused('"nadir_right" and "nadir_left" are in one place', one, "trileaflet", unit="mm")
    line = {name: (3.0 * i, i, 2.0 * i) for i, name in enumerate(NAMES)}
    refused("the landmarks lie along a line", line, "trileaflet", unit="mm")
    mirror = {name: point * (-1, 1, 1) for name, point in named.items()}
    refused("mirrored", mirror, "trileaflet", unit="mm")
    turns = numpy.arange(12) * numpy.pi / 6
    annulus = numpy.stack([18 * numpy.sin(turns), 12 * numpy.cos(turns), 4 * numpy.cos(2 * turns)], 1)
    ring = {"annulus": annulus, "anterior_horn": annulus[0]}
    assert riis.place(ring, "mitral", unit="mm", flow=(0, 0, -1)).names[3] == "annulus_4"
    crossed = ring | {"annulus": annulus[[0, 1, 4, 3, 2, *range(5, 12)]]}
    refused('the annulus crosses itself: the line from "annulus_', crossed, "mitral", unit="mm", flow=(0, 0, -1))
    high = riis.Valve("coapting", coaptation_height=9)
    refused("the landmarks give root_radius .* and then coaptation_height is 9", named, high, unit="mm", held="coaptation_height",
            error=riis.InvalidParameterError)
    missing = {name: point for name, point in named.items() if name != "nadir_left"}
    refused("the nadir 2 times", missing, "trileaflet", unit="mm")
    with pytest.raises(TypeError, match="mapping"):
        riis.place(3, "trileaflet")
    for name, text, words in (
        ("a.txt", "", "must be a .json"),
        ("a.csv", "# unit = mm\nnadir,1,2,3\n", "states no axes.*half a turn"),
        ("a.csv", "# unit = mm\n# axes = LPI\nnadir,1,2,3\n", 'the axes are "LPI"'),
        ("a.csv", "# axes = LPS\nnadir,1,2,3\n", "states no unit"),
        ("a.csv", "# axes = LPS\nnadir,1,2\n", "line 2 must be NAME,X,Y,Z"),
        ("a.csv", "# axis = LPS\n", 'line 1: "axis" is unknown'),
        ("a.json", "{", "is not JSON"),
        ("a.json", "[]", "the file must be an object"),
        ("a.json", '{"axes": "LPS", "axes": "RAS"}', "given twice"),
        ("a.json", '{"axes": "LPS", "unitt": "mm"}', '"unitt" is unknown, did you mean "unit"'),
        ("a.json", '{"unit": "mm", "landmarks": {"nadir": [1, 2, 3]}}', "axes: they are missing.*half a turn"),
        ("a.json", '{"markups": [{"coordinateSystem": "LPI", "coordinateUnits": "mm"}]}', 'coordinateSystem is "LPI"'),
        ("a.json", '{"markups": [{"coordinateSystem": "LPS", "coordinateUnits": 7}]}', "coordinateUnits is 7; it must be a text"),
    ):
        (tmp_path / name).write_text(text)
        refused(words, tmp_path / name, "trileaflet")


@pytest.mark.parametrize("kind", ["trileaflet", "coapting"])
def test_warps(kind, tmp_path):
    _, _, points = patient(7, noise=0.8)
    named = dict(zip(NAMES, points, strict=True))
    exact = riis.place(named, kind, unit="mm", warp="exact")
    assert exact.rms > 0.2 and exact.warped_residuals.max() < 2e-3
    surface = riis.Surface(exact.valve, **exact.placement)
    nearest = numpy.linalg.norm(surface.vertices[:, None] - points, axis=2).min(0)
    assert nearest.max() < 1e-9
    # The places are on the valve before the warp. The distances of the places from the landmarks are the residuals.
    numpy.testing.assert_allclose(numpy.linalg.norm(exact.places - points, axis=1), exact.residuals, atol=1e-9)
    smoothed = riis.place(named, kind, unit="mm", warp="smoothed", noise=0.3)
    assert 0.02 < numpy.sqrt((smoothed.warped_residuals**2).mean()) < 0.6 and smoothed.warp_noise == 0.3
    surface = riis.Surface(smoothed.valve, tolerance=0.005, **smoothed.placement)
    numpy.testing.assert_allclose(surface.closest_points(points).distance, smoothed.warped_residuals, atol=0.006)
    surface = riis.Surface(exact.valve, **exact.placement)
    smoothed.save(tmp_path / "placed.json")
    saved = json.loads((tmp_path / "placed.json").read_text())["warp"]
    assert saved["noise"] == 0.3 and saved["targets"] == points.tolist() and saved["sources"] == smoothed.places.tolist()
    # The warp also meets a point of the attachment between two landmarks, which does not change the placement.
    edges = surface.attachment.edges.reshape(-1, 3)
    apart = numpy.linalg.norm(edges[:, None] - points, axis=2).min(1)
    further = {**named, "attachment": [edges[apart.argmax()] + (0.3, 0.2, -0.1)]}
    more = riis.place(further, kind, unit="mm", warp="exact")
    assert more.warped_residuals.max() < 2e-3
    for key, value in exact.placement.items():
        numpy.testing.assert_allclose(more.placement[key], value, rtol=1e-7, atol=1e-7)
    attachment = riis.Surface(more.valve, tolerance=0.005, **more.placement).attachment.edges.reshape(-1, 3)
    assert numpy.linalg.norm(attachment - further["attachment"][0], axis=1).min() < 0.5
    with pytest.raises(riis.InvalidArgumentError, match="it must be none, exact or smoothed"):
        riis.place(named, kind, unit="mm", warp="yes")
    # A point of the attachment may be equal to another landmark. A point that is only near another landmark is refused.
    at = named["commissure_left_non"]
    twice = riis.place({**named, "attachment": [at, at]}, kind, unit="mm", warp="exact")
    assert (twice.places[6:] == twice.places[list(named).index("commissure_left_non")]).all()
    numpy.testing.assert_allclose(pickle.loads(pickle.dumps(twice.warp)).map(points), exact.warp.map(points), atol=1e-9)
    with pytest.raises(riis.InvalidArgumentError, match='"commissure_left_non" and "attachment_1" are in one place on'):
        riis.place({**named, "attachment": [at + 0.01]}, kind, unit="mm")


@pytest.mark.parametrize("n", [1, 2])
def test_too_few_landmarks_are_counted_before_the_unit_is_judged(n):
    given = dict(zip(NAMES[:n], patient(3)[2], strict=False))
    with pytest.raises(riis.InvalidArgumentError, match="landmarks: it has the commissure 0 times; the coapting valve needs 3"):
        riis.place(given, "coapting", unit="mm")


def test_a_report_says_that_the_papers_aortic_valve_does_not_close():
    points = dict(zip(NAMES, patient(3)[2], strict=True))
    text = ("The paper's aortic valve does not close at opening 0. For a valve that closes, choose the kind coapting or "
            "trileaflet with the same landmarks.\n")
    open_share = {}
    for kind in ("aortic", "coapting", "trileaflet"):
        found = riis.place(points, kind, unit="mm")
        orifice = riis.Surface(found.valve, **found.placement).orifice()
        open_share[kind] = orifice.area / orifice.outline_area
        assert (text in found.report()) == (kind == "aortic")
    assert open_share["aortic"] > 0.1 and open_share["coapting"] < 0.02 and open_share["trileaflet"] < 0.02
    assert '"coapting" and "trileaflet" take the same landmarks, and close' in riis.place.__doc__


@pytest.mark.parametrize("kind", ["trileaflet", "coapting", "aortic"])
@pytest.mark.parametrize("warp", ["none", "exact", "smoothed"])
def test_a_placed_valve_is_read_as_it_was_saved(kind, warp, tmp_path):
    _, _, points = patient(7, noise=0.8)
    found = riis.place(dict(zip(NAMES, points, strict=True)), kind, unit="mm", warp=warp)
    path = tmp_path / "placed.json"
    found.save(path)
    read = riis.read_placed(path)
    assert read.unit == "mm" and read.valve.kind == kind
    found.valve["opening"] = read.valve["opening"] = 0.3
    ours, theirs = (riis.Surface(one.valve, **one.placement) for one in (read, found))
    assert numpy.array_equal(ours.vertices, theirs.vertices)
    in_metres = riis.read_placed(path, unit="m")
    in_metres.valve["opening"] = 0.3
    small = riis.Surface(in_metres.valve, **in_metres.placement)
    numpy.testing.assert_allclose(1e3 * small.vertices, ours.vertices, rtol=1e-9, atol=1e-7)
    root = json.loads(path.read_text())
    if warp == "exact":  # the same landmarks, stated in the valve's own frame
        at = found.placement
        turn = Rotation.from_rotvec(numpy.radians(at["rotation_angle"]) * numpy.array(at["rotation_axis"]))
        local = {key: (turn.inv().apply(numpy.array(root["warp"][key]) - at["translation"]) / at["scale"]).tolist()
                 for key in ("sources", "targets")}
        path.write_text(json.dumps(root | {"warp": local | {"coordinates": "valve"}}))
        same = riis.read_placed(path)
        same.valve["opening"] = 0.3
        numpy.testing.assert_allclose(riis.Surface(same.valve, **same.placement).vertices, ours.vertices, atol=1e-6)


def test_refused_placed_valves(tmp_path):
    path = tmp_path / "placed.json"
    good = {"valve": "coapting", "unit": "mm", "rotate": [0, 0, 1, 0], "translate": [0, 0, 0], "parameters": {"gap": 0.03}}
    path.write_text(json.dumps(good))
    assert riis.read_placed(path).valve["gap"] == 0.03
    warp = {"sources": [[0, 0, 0]], "targets": [[0, 0, 0]]}
    for change, text in (
        ("{", "placed.json: is not JSON"),
        ("[" * 100_000, "placed.json: is nested deeper than a placed valve can be"),
        ("[]", "placed.json: a placed valve must be an object"),
        ({"valve": 3}, "placed.json: valve: 3 is not a text"),
        ({"valve": "pulmonary"}, "placed.json: .*pulmonary"),
        ({"unit": "inch"}, 'placed.json: unit: "inch" is none of m, cm, mm'),
        ({"scale": 2}, 'placed.json: a placed valve: "scale" is unknown'),
        ({"rotate": [0, 0, 1]}, "placed.json: rotate: .* has 3 numbers; it takes 4"),
        ({"translate": [0, 0, "x"]}, 'placed.json: translate: "x" is not a number'),
        ({"parameters": [1]}, "placed.json: parameters: must hold a JSON object"),
        ({"parameters": {"gap": "wide"}}, "placed.json: parameters: gap must be a number"),
        ({"parameters": {"gap": [1, 2]}}, "placed.json: .*gap"),
        ({"parameters": {"translation": [0, 0, True]}}, "placed.json: parameters: translation must be a number"),
        ({"parameters": {"gap": -1}}, "placed.json: .*gap.*-1"),
        ({"parameters": {"gpa": 1}}, "placed.json: .*gpa"),
        ({"warp": 1}, "placed.json: warp must be an object"),
        ({"warp": warp | {"opened": {}}}, 'placed.json: warp: "opened" is unknown, did you mean "open"'),
        ({"warp": warp | {"noise": -1}}, "placed.json: warp: noise: -1 is below 0"),
        ({"warp": warp | {"coordinates": "LPS"}}, 'placed.json: warp: coordinates: "LPS" is none of mesh, valve'),
        ({"warp": {"sources": [[0, 0, 0]]}}, "placed.json: warp: targets: it is missing"),
        ({"warp": warp | {"sources": [[0, 0]]}}, "placed.json: warp: sources: point 0, .0,0., is not"),
    ):
        path.write_text(change if isinstance(change, str) else json.dumps(good | change))
        with pytest.raises(riis.Error, match=text):
            riis.read_placed(path)
    path.write_text(json.dumps({key: value for key, value in good.items() if key != "rotate"}))
    with pytest.raises(riis.InvalidArgumentError, match="placed.json: rotate: it is missing"):
        riis.read_placed(path)
    with pytest.raises(riis.InvalidArgumentError, match='unit is "inch"; it must be m, cm or mm'):
        riis.read_placed(path, unit="inch")
    with pytest.raises(FileNotFoundError):
        riis.read_placed(tmp_path / "none.json")


def test_warps_that_fold_are_refused():
    named = dict(zip(NAMES, 10 * trileaflet(1.1, 1.05, 1.4), strict=True))
    # Two points of one cusp's attachment are far apart, across the attachment. No smooth map without folds moves the valve to
    # both points.
    torn = named | {"attachment_right_1": (21, 2, 1), "attachment_right_2": (1, -2, 1)}
    with pytest.raises(riis.InvalidParameterError, match='the warp folds near ".*its determinant is -'):
        riis.place(torn, "coapting", unit="mm", warp="exact")
    assert riis.place(named, "coapting", unit="mm", warp="exact").warped_residuals.max() < 2e-3


def test_landmarks_must_be_at_the_nodes(tmp_path):
    # The valve is beside the axis z, so half a turn about z takes it away from the mesh.
    points = 10 * trileaflet(1.1, 1.05, 1.4) + (90, 80, 0)
    named = {name: point.tolist() for name, point in zip(NAMES, points, strict=True)}
    nodes = points[:, None].repeat(4, 1).reshape(-1, 3) + numpy.random.default_rng(3).normal(size=(24, 3))
    path = tmp_path / "a.json"

    def placed(stated, unit, sign, factor, **options):
        turned = {name: (factor * numpy.array(point) * (sign, sign, 1)).tolist() for name, point in named.items()}
        path.write_text(json.dumps({"unit": unit, "axes": stated, "landmarks": turned}))
        return riis.place(path, "trileaflet", nodes=options.pop("at", nodes), **options)

    assert placed("LPS", "mm", 1, 1).unit == "mm"
    for axes, other in (("LPS", "RAS"), ("RAS", "LPS")):
        words = f"x and y reversed, as between LPS and RAS, they are .* from them: give axes='{other}'"
        with pytest.raises(riis.InvalidArgumentError, match=words):
            placed(axes, "mm", -1, 1)
        assert placed(axes, "mm", -1, 1, axes=other).axes == other
    with pytest.raises(riis.InvalidArgumentError, match="in millimetres, they are .* give unit='mm'"):
        placed("LPS", "cm", 1, 0.1)
    words = "in millimetres and with the signs of x and y reversed.* give unit='mm' and give axes='RAS'"
    with pytest.raises(riis.InvalidArgumentError, match=words):
        placed("LPS", "cm", -1, 0.1)
    with pytest.raises(riis.InvalidArgumentError, match="reversed.* state the axes of the file"):
        placed("mesh", "mm", -1, 1)
    with pytest.raises(riis.InvalidArgumentError, match="in millimetres, they are .*: give the landmarks in millimetres"):
        riis.place({name: points[i] / 10 for i, name in enumerate(NAMES)}, "trileaflet", unit="cm", nodes=nodes)
    with pytest.raises(riis.InvalidArgumentError, match="more than 1 cm, whatever the unit"):
        placed("LPS", "mm", 1, 1, at=nodes + 400)
    with pytest.raises(riis.InvalidArgumentError, match=r"nodes: its shape is \(24,\)"):
        placed("LPS", "mm", 1, 1, at=nodes[:, 0])
