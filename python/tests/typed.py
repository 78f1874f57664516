# SPDX-License-Identifier: Apache-2.0
"""./run python checks this program with mypy --strict, so that the stubs must describe what the calls accept and return."""

from collections.abc import Mapping

import numpy
from numpy.typing import NDArray

import riis
from riis.view.model import Light, Model, Shown


def largest(parameters: Mapping[str, float]) -> float:
    return max(parameters.values())


def resistance_of(xyz: NDArray[numpy.float64], opening: float) -> NDArray[numpy.float64]:
    valve = riis.Valve("mitral", opening=opening)
    valve["AP_diameter"] = 3.1
    surface = riis.Surface(valve, half_thickness=0.1)
    mesh = riis.Mesh(xyz)
    marks: riis.Marks = riis.mark(surface, mesh, fields="normal")
    ids: NDArray[numpy.int64] = marks.ids
    normals: NDArray[numpy.float64] = marks.normal
    assert len(ids) == len(normals)
    depths: NDArray[numpy.float64] = riis.find_crossings(surface).depth
    lengths: NDArray[numpy.float64] = riis.find_crossings(surface).length
    assert len(lengths) == len(depths) == 0 and largest(valve) == max(valve.values())
    coefficient = numpy.zeros(mesh.n_nodes)
    marks.add_resistance(coefficient, R=1e4)
    lowest: float = surface.info.lower[2]
    assert lowest < surface.closest_point((0.0, 0.0, 9.0)).point[2]
    law = riis.OpeningTimes(0.45, 0.05, 0.95, 0.05, period=1.0)
    valve["opening"] = law(0.475)
    return coefficient


def valve_of(points: NDArray[numpy.float64]) -> riis.Valve:
    found: riis.FitResult = riis.fit(points, "mitral", free=["opening"], placement=["translation"], n_starts=2)
    opening: float = found.parameters["opening"]
    assert opening <= 1.0 and found.weights.shape == found.distances.shape
    frames: int = riis.animate("valve.gif", [riis.Surface(found.valve, **found.placement)], frame_rate=4.0)
    assert frames == 1
    placed: riis.PlacedValve = riis.read_placed("placed.json", unit="mm")
    assert riis.Surface(placed.valve, **placed.placement) and placed.unit == "mm"
    return found.valve


def faults_of(xyz: NDArray[numpy.float64], cells: NDArray[numpy.int64]) -> list[str]:
    model = Model(xyz, cells, unit="mm", path="root.vtu")
    i: int = model.add("coapting")
    with model.dragging():
        model.set(i, "opening", 0.5)
    model.place_by_clicks(i, xyz[:3])
    shown: Shown = model.update()
    ids: NDArray[numpy.int64] = shown.marked
    lights: list[Light] = model.lights()
    command: str = model.command()
    assert len(ids) == len(shown.distance) and command and model.curve(9)["time"].shape == (9,)
    return [light.text for light in lights if light.level == "bad"]
