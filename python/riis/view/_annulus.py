# SPDX-License-Identifier: Apache-2.0
"""The annulus of a valve, and its placement by three points on it.

The three points lie on one circle. The valve is moved, rotated and scaled in proportion until this circle passes through three
points of the patient's annulus.
"""

from __future__ import annotations

import dataclasses
import math
from types import MappingProxyType
from typing import Any, NamedTuple

import numpy
from numpy.typing import NDArray

from riis._errors import InvalidParameterError
from riis._records import Attachment
from riis._riis import Surface, Valve
from riis.view._valves import (
    ValveState, has_cusps, n_leaflets, plain, refuse, rotation_of, values_that_were_set, vector,
)

Reals = NDArray[numpy.float64]

_LEAST, _MOST = 0.3, 3.5  # limits of the factor of a valve's lengths; beyond them the mesh has another unit


class Annulus(NamedTuple):
    """A circle of the closed valve in its own frame, centimetres. The normal is on the side of the z axis."""

    points: Reals  #: (3, 3), on the circle; the first is the place for the first click
    centre: Reals
    normal: Reals
    radius: float


def _circle(points: Reals) -> tuple[Reals, Reals, float]:
    """Returns the centre, the unit normal and the radius of the circle through three points."""
    a, b = points[1] - points[0], points[2] - points[0]
    normal = numpy.cross(a, b)
    square = float(normal @ normal)
    centre = points[0] + ((a @ a) * numpy.cross(b, normal) + (b @ b) * numpy.cross(normal, a)) / (2.0 * square)
    return centre, normal / math.sqrt(square), float(numpy.linalg.norm(points[0] - centre))


def _has_three_nadirs(kind: str) -> bool:
    return has_cusps(kind) and n_leaflets(kind) == 3


def annulus_of(state: ValveState) -> Annulus:
    """Returns the circle through three points of the annulus of the closed valve."""
    valve = state.valve()
    assert valve is not None
    valve["opening"] = 0.0
    if state.kind == "bileaflet":
        points = _thirds(valve, "radius", 90.0)  # the hinges run along y, so the first point is at an end of them
    elif has_cusps(state.kind) and not _has_three_nadirs(state.kind):
        points = _thirds(valve, "root_radius", 0.0)
    else:
        if "skirt_length" in valve:
            valve["skirt_length"] = 0.0
        if has_cusps(state.kind):
            points = _nadirs(Surface(valve).attachment)
        else:  # the same triangles for a valve that has grown in proportion
            points = _anterior(Surface(valve, half_thickness=valve["AP_diameter"] / 30.0).attachment)
    centre, normal, radius = _circle(points)
    return Annulus(points, centre, normal if normal[2] >= 0.0 else -normal, radius)


def _thirds(valve: Valve, radius: str, first: float) -> Reals:
    """Returns three points on the valve's circle, a third of the circle apart. The first point lies at this angle in degrees."""
    turn = numpy.radians(first + numpy.array([0.0, 120.0, 240.0]))
    shift = numpy.array(valve["translation"]) if "translation" in valve else numpy.zeros(3)
    return numpy.asarray(shift + valve[radius] * numpy.column_stack([numpy.cos(turn), numpy.sin(turn), numpy.zeros(3)]))


def _nadirs(attachment: Attachment) -> Reals:
    """Returns the nadir of each of three cusps: the mean of the lowest vertices of its attachment."""
    made = []
    for cusp in range(3):
        of_cusp = attachment.edges[attachment.leaflet_id == cusp].reshape(-1, 3)
        low = of_cusp[:, 2].min()
        height = float(of_cusp[:, 2].max() - low)
        made.append(of_cusp[of_cusp[:, 2] <= low + 1e-9 * height].mean(axis=0))
    return numpy.array(made)


def _anterior(attachment: Attachment) -> Reals:
    """Returns the annulus at the middle of the anterior leaflet, and at a third of a turn to each side of it."""
    edges = attachment.edges
    middle = (edges.min(axis=(0, 1)) + edges.max(axis=(0, 1))) / 2.0
    around = numpy.arctan2(edges[:, :, 1] - middle[1], edges[:, :, 0] - middle[0])
    anterior = edges[attachment.leaflet_id == 0].mean(axis=(0, 1)) - middle
    first = math.atan2(anterior[1], anterior[0])
    made = []
    for turn in (0.0, 2.0 * math.pi / 3.0, -2.0 * math.pi / 3.0):
        off = numpy.angle(numpy.exp(1j * (around - first - turn)))
        # One edge has one end on each side of the wanted direction.
        k = int(numpy.argmax((off.min(axis=1) <= 0.0) & (off.max(axis=1) > 0.0) & (numpy.ptp(off, axis=1) < math.pi)))
        a, b = off[k]
        made.append(edges[k, 0] + a / (a - b) * (edges[k, 1] - edges[k, 0]))
    return numpy.array(made)


def checked_clicks(points3: Any) -> Reals:
    """Returns three points. Refuses values that define no circle."""
    try:
        clicks = numpy.array(points3, numpy.float64)
    except (TypeError, ValueError):
        clicks = numpy.empty(0)
    if clicks.shape != (3, 3):
        raise refuse(f"points3: has the shape {numpy.shape(points3)}; it must be three points (3, 3)")
    for k, click in enumerate(clicks):
        if not numpy.isfinite(click).all():
            raise refuse(f"points3: point {k} is {tuple(click.tolist())}; it must be finite")
    size = max(float(numpy.linalg.norm(clicks[k] - clicks[k - 1])) for k in range(3))
    for k, other in ((1, 0), (2, 0), (2, 1)):
        if float(numpy.linalg.norm(clicks[k] - clicks[other])) <= 1e-3 * size:
            raise refuse(f"points3: points {other} and {k} are in one place, {tuple(clicks[k].tolist())}")
    area = float(numpy.linalg.norm(numpy.cross(clicks[1] - clicks[0], clicks[2] - clicks[0])))
    if area <= 0.02 * size * size:
        raise refuse(f"points3: the points {clicks.tolist()} are on a line, so they define no circle")
    return clicks


def placed_by(state: ValveState, points3: Any) -> dict[str, Any]:
    """Returns the changes of a state after which the annulus passes through three points."""
    clicks = checked_clicks(points3)
    known = annulus_of(state)
    centre, normal, radius = _circle(clicks)
    if normal @ (state.matrix @ known.normal) < 0.0:
        normal = -normal
    growth = radius / (state.scale * known.radius)
    if not _LEAST <= growth <= _MOST:
        raise refuse(
            f"points3: are on a circle of radius {radius:.3g}, and that of the valve is {state.scale * known.radius:.3g}: "
            "choose the mesh's unit first, or click on the annulus"
        )
    # The two rotations are frames with the circles' normals; x is towards the first point.
    frames = []
    for origin, up, points in ((known.centre, known.normal, known.points), (centre, normal, clicks)):
        x = points[0] - origin
        x = x - (x @ up) * up
        x = x / numpy.linalg.norm(x)
        frames.append(numpy.column_stack([x, numpy.cross(up, x), up]))
    turn = 0.0
    if _has_three_nadirs(state.kind):
        turn = _mean_turn(known, frames[0], centre, frames[1], clicks)
    about = numpy.array([[math.cos(turn), -math.sin(turn), 0.0], [math.sin(turn), math.cos(turn), 0.0], [0.0, 0.0, 1.0]])
    matrix = frames[1] @ about @ frames[0].T
    grown = _grown(state, growth)
    # The lengths grew, but a length may be bounded or follow a rule, so the circle is measured again.
    again = annulus_of(grown)
    origin = centre - state.scale * (matrix @ again.centre)
    return {"parameters": grown.parameters, "rotation": rotation_of(matrix), "origin": vector(origin)}


def _mean_turn(known: Annulus, own: Reals, centre: Reals, frame: Reals, clicks: Reals) -> float:
    """Returns the rotation about the axis after which the nadirs are nearest to the clicks. The first click shows which cusp is
    meant."""

    def angles(points: Reals, middle: Reals, axes: Reals) -> Reals:
        local = (points - middle) @ axes
        return numpy.arctan2(local[:, 1], local[:, 0]) % (2.0 * math.pi)

    cusps, places = angles(known.points, known.centre, own), angles(clicks, centre, frame)
    cusps[0] = places[0] = 0.0
    # Clicks and nadirs continue in the same direction.
    off = numpy.sort(places) - numpy.sort(cusps)
    return float(off.mean())


def _grown(state: ValveState, growth: float) -> ValveState:
    """Returns the valve with all lengths multiplied. A length that follows a rule and was not set changes without being set."""
    valve = state.valve()
    assert valve is not None
    wanted = {}
    for name, known in valve.parameters.items():
        if known.unit != "length" or (known.rule and not valve.is_set(name)):
            continue
        value = plain(valve[name])
        is_zero = not any(value) if isinstance(value, tuple) else value == 0.0
        if not is_zero:
            wanted[name] = tuple(growth * x for x in value) if isinstance(value, tuple) else growth * value
    if abs(growth - 1.0) < 1e-9:
        return state
    try:
        valve.update(wanted)
    except InvalidParameterError as error:
        raise refuse(f"points3: the valve cannot grow by {growth:.3g}: {error}") from None
    return dataclasses.replace(state, parameters=MappingProxyType(dict(values_that_were_set(valve))))
