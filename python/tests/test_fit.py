# SPDX-License-Identifier: Apache-2.0
"""Known valves are found again from points, and bad input is refused."""

import json

import numpy
import pytest

import fit_table
import riis

pytest.importorskip("scipy", reason="scipy is missing; ./run python installs it")


@pytest.mark.parametrize("kind", ["mitral", "trileaflet"])
def test_known_valves_are_found_again(kind, tmp_path):
    true = fit_table.VALVES[kind]
    points = fit_table.cloud(kind, 500, 0.01, outliers=0.02)
    found = riis.fit(points, kind, free=list(true))
    assert found.undetermined == ()
    for name, value in true.items():
        assert abs(found.parameters[name] - value) < 0.05 * max(1.0, value), name
        assert found.valve[name] == found.parameters[name]
    assert 0.005 < found.rms < 0.02  # noise along the normal has 0.01
    # The fitted surface is the known one: distances of points without noise are small.
    clean = fit_table.cloud(kind, 500, 0.0, seed=1)
    surface = riis.Surface(found.valve, **found.placement)
    assert numpy.percentile(surface.closest_points(clean).distance, 90) < 0.02
    # The distances of the result are those to the surface.
    assert numpy.allclose(found.distances, surface.closest_points(points).distance, atol=0.01)
    assert found.weights[:10].max() < 0.5 < numpy.median(found.weights)  # the first ten are outliers
    options = found.write(tmp_path / "valve.json")
    assert json.loads((tmp_path / "valve.json").read_text())["opening"] == found.valve["opening"]
    assert f"--valve {kind} --params" in options and "--rotate" in options


def test_what_the_data_do_not_say_is_told():
    """A closed valve is the same whatever its open radius will be."""
    valve = riis.Valve("trileaflet", opening=0.0)
    points = numpy.array(riis.Surface(valve).vertices[::5])
    found = riis.fit(points, valve, free=["leaflet_height", "open_radius_ratio"], placement=["translation"])
    assert found.undetermined == ("open_radius_ratio",)
    assert numpy.isinf(found.standard_errors["open_radius_ratio"])
    assert abs(found.parameters["leaflet_height"] - valve["leaflet_height"]) < 0.02


POINTS = numpy.zeros((50, 3))


@pytest.mark.parametrize(
    "kind, text, points, options",
    [
        (TypeError, "points: must be", [[0.0] * 3], {}),
        (TypeError, "points: must be", POINTS.astype("f4"), {}),
        (riis.InvalidArgumentError, r"points: its shape is \(3, 50\)", POINTS.T, {}),
        (riis.InvalidArgumentError, "points: has a coordinate", POINTS + numpy.nan, {}),
        (riis.InvalidArgumentError, "points: there are 3, fewer than the 7", POINTS[:3], {}),
        (riis.InvalidArgumentError, "free: 'height' is no parameter", POINTS, {"free": ["height"]}),
        (riis.InvalidArgumentError, "free: 'translation' has three", POINTS, {"free": ["translation"]}),
        (riis.InvalidArgumentError, "free: and placement are empty", POINTS, {"free": [], "placement": []}),
        (riis.InvalidArgumentError, "bounds: those of 'opening' are 0.5 and 0.2", POINTS, {"bounds": {"opening": (0.5, 0.2)}}),
        (riis.InvalidArgumentError, "bounds: 'AP_diameter' is not in free", POINTS, {"bounds": {"AP_diameter": (1.0, 2.0)}}),
        (riis.InvalidArgumentError, "weights: must be an array", POINTS, {"weights": numpy.ones(3)}),
        (riis.InvalidArgumentError, "weights: must be finite", POINTS, {"weights": -numpy.ones(50)}),
        (riis.InvalidArgumentError, "placement: 'shear' is none", POINTS, {"placement": ["shear"]}),
        (riis.InvalidArgumentError, "start: 'angle' is none", POINTS, {"start": {"angle": 1.0}}),
        (riis.InvalidParameterError, "'tricuspid' is not a kind", POINTS, {"valve": "tricuspid"}),
    ],
)
def test_refused(kind, text, points, options):
    given = {"valve": "mitral", "free": ["opening"], **options}
    with pytest.raises(kind, match=text):
        riis.fit(points, given.pop("valve"), **given)
