# SPDX-License-Identifier: Apache-2.0
"""Fits a valve to points, for example from a segmented image. The fit maximizes a likelihood of the distances to closest
points."""

from __future__ import annotations

import difflib
import json
import operator
import os
import re
import shlex
import sys
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import Any, Literal, NamedTuple

import numpy
from numpy.typing import NDArray

from riis._errors import InvalidArgumentError
from riis._fit_problem import FINE, ROUGH, Mixture, Pose, Problem, axis_and_angle, start_pose, vertex_areas, weighted_median
from riis._fit_search import RIVAL, UNDETERMINED, End, Judge, Judged, covered, is_same, probes_of, search
from riis._place import UNITS
from riis._records import Parameter
from riis._riis import Surface, Valve, find_crossings

Reals = NDArray[numpy.float64]

_SECTORS = (50.0, 240.0)  # the range of a cusp's sector, degrees
_MOVES = ("rotation", "translation", "scale")
# The number of points that the rough search uses.
_N_ROUGH = 400
# If n_starts is not given, a fit has at least the first and at most the second number of starts.
_LEAST_STARTS, _LEAST_STARTS_OF_PART, _MOST_STARTS = 4, 8, 20
# A fit with one of the doubts below may have ended in the wrong place, so more starts follow.
_OF_ENDS = ("starts:", "outliers:", "noise:", "misfit:", "cover:")
# A fit whose measures exceed the limits below gets a doubt in its result.
_MOST_OUTLIERS = 0.3
_LEAST_COVERED = 0.9
_MOST_NOISE = 1.25  # largest noise of the residuals, as a multiple of the stated noise
_MOST_SCATTER = 0.05  # as a share of the valve's size, if no noise is stated


class Rival(NamedTuple):
    """Another fit with a similar cost, whose surface differs from that of the best fit."""

    parameters: dict[str, float]
    placement: dict[str, Any]
    excess: float  #: twice the logarithm of the ratio of likelihoods. The best fit is sqrt(excess) standard errors ahead


@dataclass(frozen=True)
class FitResult:
    """A fitted valve. The surface is Surface(result.valve, **result.placement)."""

    valve: Valve
    placement: dict[str, Any]  #: scale, rotation_axis, rotation_angle (degrees) and translation
    parameters: dict[str, float]  #: the free parameters
    standard_errors: dict[str, float]  #: of the free parameters, with misfit and rivals; infinite if the data say nothing about
                                       #: a parameter
    undetermined: tuple[str, ...]  #: free parameters and parts of the placement that the data do not determine
    without_influence: tuple[str, ...]  #: undetermined parameters whose whole range moves the surface by less than the noise
    at_bounds: tuple[str, ...]  #: free parameters that ended at a bound
    doubts: tuple[str, ...]  #: reasons to distrust the whole result, each as a sentence; empty if there is none
    n_starts: int  #: number of starts
    n_agreeing: int  #: number of starts that reached this fit, directly or after a turn by a cusp or half a turn
    rivals: tuple[Rival, ...]  #: other fits of similar cost, the best first
    n_crossings: int  #: number of pairs of triangles of the fitted surface that go through each other
    singular_values: Reals  #: of the Jacobian (rows: points, columns: unknowns), descending, in units of the valve's size
    rms: float  #: root mean square of the residuals, with the weights below
    noise: float  #: standard deviation of the residuals of the points that are no outliers
    misfit: float  #: the residuals' variance in parts of the valve, divided by the variance of independent points; large if the
                   #: model is wrong
    outliers: float  #: share of the points that are outliers
    covered: float  #: share of the fitted surface with points nearby
    percentile95: float  #: 95 % of all points have at most this distance
    distances: Reals = field(repr=False)  #: (n_points,), of all points, to the surface midway between both faces
    weights: Reals = field(repr=False)  #: (n_points,), the caller's weights times a factor from 0 to 1, small for outliers
    unit: str | None = None  #: "mm", "cm" or "m", of the points. The parameters are then in centimetres

    def report(self) -> str:
        """Returns a table of the parameters with their standard errors, followed by the measures of the fit."""
        table = self.valve.parameters
        of_points = "" if self.unit is None else f" {self.unit}"
        lines = [f"{'parameter':32} {'value':>10} {'std. error':>10}  unit"]
        for name, value in self.parameters.items():
            notes = ["undetermined"] * (name in self.undetermined) + ["has no influence"] * (name in self.without_influence)
            notes += ["at a bound"] * (name in self.at_bounds)
            unit = "cm" if self.unit is not None and table[name].unit == "length" else table[name].unit
            lines.append(f"{name:32} {value:10.4f} {self.standard_errors[name]:10.4f}  {unit:7} {', '.join(notes)}".rstrip())
        for name, value in self.placement.items():
            numbers = " ".join(f"{number:.4f}" for number in numpy.atleast_1d(value))
            lines.append(f"{name:32} {numbers}{of_points if name == 'translation' else ''}")
        moves = [name for name in self.undetermined if name in _MOVES]
        if moves:
            lines.append(f"undetermined in the placement: {', '.join(moves)}")
        share = f"95 % of {len(self.distances)} points within {self.percentile95:.4f}{of_points}"
        lines.append(f"rms {self.rms:.4f}{of_points}, {share}, outliers {self.outliers:.1%}, misfit {self.misfit:.2g}")
        lines.append(f"{self.n_agreeing} of {self.n_starts} starts reached this fit; points cover {self.covered:.0%} of it")
        for rival in self.rivals:
            values = ", ".join(f"{name} {value:.4f}" for name, value in rival.parameters.items())
            lines.append(f"rival, {rival.excess:.1f} behind: {values or 'another placement'}")
        crossed = f"crosses itself in {self.n_crossings} pairs of triangles" if self.n_crossings else "does not cross itself"
        lines.append(f"the fitted surface {crossed}")
        lines += [f"doubt: {doubt}" for doubt in self.doubts]
        lines.append(f"singular values of the Jacobian: {' '.join(f'{value:.3g}' for value in self.singular_values)}")
        return "\n".join(lines)

    def write(self, path: str | os.PathLike[str]) -> str:
        """Writes the parameters to a file for riis mark --params. Returns the options that name the file and the placement."""
        if not _is_its_parameters(self.valve):
            raise InvalidArgumentError(
                "valve: has patches or an open state of its own, which a file of parameters does not hold; write those with "
                "the program that made them"
            )
        values = {name: numpy.asarray(value).tolist() for name, value in dict(self.valve).items()}
        with open(path, "w", encoding="utf-8") as file:
            json.dump(values, file, indent=2)
            file.write("\n")
        rotation = ",".join(f"{v:.17g}" for v in (*self.placement["rotation_axis"], self.placement["rotation_angle"]))
        move = ",".join(f"{v:.17g}" for v in self.placement["translation"])
        return (
            f"--valve {self.valve.kind} --params {shlex.quote(os.fspath(path))} --scale {self.placement['scale']:.17g} "
            f"--rotate={rotation} --translate={move}"
        )


def _is_its_parameters(valve: Valve) -> bool:
    """Returns whether the parameters alone define the valve, without patches and without an open state from the caller."""
    if valve.kind == "patches":
        return False
    alone = Valve(valve.kind)
    alone.update(**dict(valve))
    if "opening" in valve:
        valve, alone = valve.copy(), alone.copy()
        valve["opening"] = alone["opening"] = 1.0
    return numpy.array_equal(Surface(alone).vertices, Surface(valve).vertices)


def _reals(data: Any, name: str, or_else: str = "") -> Reals:
    """Returns an array of float64. Refuses other values in the same way as the calls in C++."""
    if isinstance(data, numpy.ma.MaskedArray):
        raise TypeError(
            f"{name}: is a masked array, and its mask would be lost; pass {name}.filled(...), or {name}.data if the mask "
            "does not matter"
        )
    if not isinstance(data, numpy.ndarray) or data.dtype != numpy.float64:
        what = f"an array of {data.dtype}" if isinstance(data, numpy.ndarray) else type(data).__name__
        hint = "" if data is None or isinstance(data, str) else f"; pass numpy.ascontiguousarray({name}, dtype=float)"
        raise TypeError(f"{name}: must be a numpy array of float64{or_else}, not {what}{hint}")
    return data


def _points_of(data: Any) -> tuple[Reals, Reals | None]:
    """Returns points, and the areas around them if they are vertices of a surface."""
    pyvista = sys.modules.get("pyvista")
    if isinstance(data, Surface):
        points = numpy.array(data.vertices)
        return points, vertex_areas(points, data.triangles.vertex_id)
    if pyvista is not None and isinstance(data, pyvista.PolyData):
        points = numpy.array(data.points, numpy.float64)  # PyVista's points are often float32
        triangles = data.triangulate().faces.reshape(-1, 4)[:, 1:] if data.faces.size > 0 else None
        return points, None if triangles is None else vertex_areas(points, triangles)
    return _reals(data, "points", ", a riis.Surface or a pyvista.PolyData"), None


def _check_points(points: Reals) -> None:
    if points.ndim != 2 or points.shape[1] != 3:
        raise InvalidArgumentError(f"points: its shape is {points.shape}; it must be (n, 3)")
    bad = numpy.flatnonzero(~numpy.isfinite(points).all(axis=1))
    if len(bad) > 0:
        raise InvalidArgumentError(f"points: row {bad[0]} is {points[bad[0]].tolist()}; coordinates must be finite")


def _checked_weights(weights: Any, n: int) -> Reals:
    weights = _reals(weights, "weights")
    if weights.shape != (n,):
        raise InvalidArgumentError(f"weights: its shape is {weights.shape}; there are {n} points")
    bad = numpy.flatnonzero(~(numpy.isfinite(weights) & (weights >= 0.0)))
    if len(bad) > 0:
        raise InvalidArgumentError(f"weights: entry {bad[0]} is {weights[bad[0]]}; it must be finite and at least 0")
    return weights


def _whole(number: Any, name: str, least: int) -> int:
    try:
        found = operator.index(number)
    except TypeError:
        found = None
    if found is None or isinstance(number, bool):
        raise TypeError(f"{name}: must be an int, not {number!r}")
    if found < least:
        raise InvalidArgumentError(f"{name}: is {found}; it must be at least {least}")
    return found


def _names_of(names: Any, argument: str) -> list[str]:
    if isinstance(names, str) or not isinstance(names, Sequence) or not all(isinstance(name, str) for name in names):
        raise TypeError(f"{argument}: must be a list of names, not {names!r}")
    return list(dict.fromkeys(names))


def _default_bounds(parameter: Parameter, value: float, size: float) -> tuple[float, float]:
    """Returns the bounds from the table of parameters. The bounds of lengths span many powers of ten, so they are narrowed
    around the value."""
    if parameter.name.endswith(".sector"):  # in a sum of 360 degrees with the start values of the others
        others = 360.0 - value
        low, high = (others * sector / (360.0 - sector) for sector in _SECTORS)
        return max(low, parameter.minimum), min(high, parameter.maximum)
    if parameter.unit != "length":
        return parameter.minimum, parameter.maximum
    low, high = sorted((0.5 * value, 2.0 * value)) if value != 0.0 else (-0.25 * size, 0.25 * size)
    return max(low, parameter.minimum), min(high, parameter.maximum)


def _pair(given: Any, name: str) -> tuple[float, float]:
    try:
        low, high = (float(number) for number in given)
    except (TypeError, ValueError):
        raise TypeError(f"bounds: those of '{name}' must be two numbers, not {given!r}") from None
    return low, high


def _second_names(valve: Valve) -> dict[str, tuple[str, float]]:
    """Returns the parameters that have a second name, such as "annulus", with the factor from the parameter to this name."""
    return {
        ".".join([*name.split(".")[:-1], parameter.other_name]): (name, parameter.other_factor)
        for name, parameter in valve.parameters.items() if parameter.other_name
    }


def _in_own_names(valve: Valve, names: list[str], bounds: Any) -> tuple[list[str], Any]:
    """Returns names and bounds with the first names of parameters in place of their second names."""
    second = {name: own for name, own in _second_names(valve).items() if name in names and name not in valve.parameters}
    if isinstance(bounds, Mapping):
        bounds = {
            second[name][0] if name in second else name:
            tuple(number / second[name][1] for number in _pair(pair, name)) if name in second else pair
            for name, pair in bounds.items()
        }
    return list(dict.fromkeys(second[name][0] if name in second else name for name in names)), bounds


def _bounds_of(valve: Valve, free: list[str], given: Any, size: float) -> Reals:
    if not isinstance(given, Mapping):
        raise TypeError(f"bounds: must be a dict from names to pairs, not {given!r}")
    table = valve.parameters
    bounds = []
    for name in free:
        if name not in table:
            known = [*table, *_second_names(valve)]
            near = difflib.get_close_matches(name, known, 1)
            raise InvalidArgumentError(f"free: '{name}' is not a parameter of a {valve.kind} valve; " + (
                f"did you mean '{near[0]}'? Valve.parameters lists them" if near else f"the parameters are {', '.join(known)}"))
        if table[name].n_values != 1:
            raise InvalidArgumentError(f"free: '{name}' has three values; only parameters with one can be free")
        if re.fullmatch(r"bump_\d+\.(leaflet|commissure)", name):
            raise InvalidArgumentError(f"free: '{name}' is the whole number of a place, so it cannot be free; set it in valve")
        low, high = _pair(given[name], name) if name in given else _default_bounds(table[name], valve[name], size)
        if not table[name].minimum <= low < high <= table[name].maximum:
            raise InvalidArgumentError(
                f"bounds: those of '{name}' are {low} and {high}; they must ascend within {table[name].minimum} and "
                f"{table[name].maximum}"
            )
        bounds.append((low, high))
    unknown = sorted(set(given) - set(free), key=str)
    if unknown:
        raise InvalidArgumentError(f"bounds: '{unknown[0]}' is not in free")
    return numpy.array(bounds, float).reshape(-1, 2)


def _sectors_of(valve: Valve) -> list[str]:
    return [name for name in valve if name.endswith(".sector")]


def _without_last_sector(names: list[str], valve: Valve, bounds: Any) -> list[str]:
    """Gives the sectors a sum of 360 degrees if one of them is free. Only their ratios count, so if all are free, the last one
    keeps its value. Returns the names that are then free."""
    sectors = _sectors_of(valve)
    free = [name for name in sectors if name in names]
    if not free:
        return names
    total = sum(valve[name] for name in sectors)
    valve.update({name: 360.0 * valve[name] / total for name in sectors})
    if len(free) < len(sectors):
        return names
    if isinstance(bounds, Mapping) and free[-1] in bounds:
        raise InvalidArgumentError(f"bounds: all sectors are free, so '{free[-1]}' follows from the others and has no bounds")
    return [name for name in names if name != free[-1]]


def _with_sum_of_360(found: FitResult, names: list[str]) -> FitResult:
    """Returns the result with sectors whose sum is 360 degrees, and with all names that were free."""
    sectors = _sectors_of(found.valve)
    if not set(sectors) & set(names):
        return found

    def whole(values: Mapping[str, float]) -> dict[str, float]:
        """Returns these parameters, with the sectors in a sum of 360."""
        of_all = {name: values.get(name, own[name]) for name in sectors}
        total = sum(of_all.values())
        every = {**values, **{name: 360.0 * value / total for name, value in of_all.items()}}
        return {name: every[name] for name in names}

    own = {name: found.valve[name] for name in sectors}
    values = numpy.array(list(own.values()))
    total = values.sum()
    # The errors of several free sectors count as independent.
    slopes = 360.0 * (numpy.eye(len(sectors)) - values[:, None] / total) / total
    errors = numpy.array([found.standard_errors.get(name, 0.0) for name in sectors])
    of_all = numpy.sqrt((slopes**2 * errors**2).sum(axis=1))
    standard_errors = {**found.standard_errors, **dict(zip(sectors, of_all.tolist()))}
    undetermined = set(found.undetermined) | ({sectors[-1]} if set(sectors) & set(found.undetermined) else set())
    found.valve.update({name: 360.0 * value / total for name, value in own.items()})
    return replace(
        found, parameters=whole(found.parameters), standard_errors={name: standard_errors[name] for name in names},
        undetermined=tuple(name for name in dict.fromkeys([*names, *found.undetermined]) if name in undetermined),
        rivals=tuple(rival._replace(parameters=whole(rival.parameters)) for rival in found.rivals),
    )


def _placed(start: Any) -> dict[str, Any]:
    if not isinstance(start, Mapping):
        raise TypeError(f"start: must be a dict of a placement, or have a valve and a placement, not {start!r}")
    place = {"scale": 1.0, "rotation_axis": (0.0, 0.0, 1.0), "rotation_angle": 0.0, "translation": (0.0, 0.0, 0.0)}
    for name, value in start.items():
        if name not in place:
            raise InvalidArgumentError(f"start: '{name}' is not one of {', '.join(place)}")
        place[name] = value
    return place


def _length(number: Any, name: str) -> float:
    """Returns the checked length of an argument, or 0 for None."""
    if number is None:
        return 0.0
    if isinstance(number, bool) or not isinstance(number, (int, float, numpy.integer, numpy.floating)):
        raise TypeError(f"{name}: must be a number or None, not {number!r}")
    if not (numpy.isfinite(number) and number > 0.0):
        raise InvalidArgumentError(f"{name}: is {number}; it must be finite and greater than 0")
    return float(number)


def _with_unit(unit: Any, start: Mapping[str, Any], moves: list[str], kind: str) -> dict[str, Any]:
    """Returns the start values of a fit, with the scale for the unit."""
    if unit is None:
        return dict(start)
    if not isinstance(unit, str):
        raise TypeError(f"unit: must be one of {', '.join(UNITS)}, not {unit!r}")
    if unit not in UNITS:
        raise InvalidArgumentError(f"unit: '{unit}' is not one of {', '.join(UNITS)}")
    if kind == "patches":
        raise InvalidArgumentError(f"unit: is '{unit}', but the lengths of a valve from patches have no known unit")
    if "scale" in moves:
        raise InvalidArgumentError(f"unit: '{unit}' sets the scale, which placement frees")
    if start.get("scale", UNITS[unit]) != UNITS[unit]:
        raise InvalidArgumentError(f"unit: '{unit}' sets the scale to {UNITS[unit]}, but start sets it to {start['scale']}")
    return {**start, "scale": UNITS[unit]}


def _check_unit(points: Reals, weights: Reals, surface: Surface, valve: Valve, limits: Reals, names: list[str]) -> None:
    """Refuses points that are far larger or smaller than the valve can be."""
    here, there = _extent(points, weights), _extent_of(surface)
    grown = [limit[1] / valve[name] for name, limit in zip(names, limits)
             if valve.parameters[name].unit == "length" and valve[name] > 0.0]
    if here > 2.5 * there * max([1.0, *grown]) or here < there / 40.0:
        raise InvalidArgumentError(
            f"points: their median distance from their middle is {here:.4g}, that of the valve's surface is {there:.4g}; set "
            "unit to the points' unit, start['scale'], or bounds"
        )


def fit(
    points: Any,
    valve: str | Valve,
    *,
    free: Sequence[str],
    placement: Sequence[Literal["rotation", "translation", "scale"]] = ("rotation", "translation"),
    start: Any = None,
    bounds: Mapping[str, tuple[float, float]] | None = None,
    weights: Reals | None = None,
    whole: bool = True,
    n_starts: int | None = None,
    seed: int = 0,
    noise: float | None = None,
    thickness: float | None = None,
    unit: Literal["m", "cm", "mm"] | None = None,
) -> FitResult:
    """Finds the parameters and the placement that bring a valve closest to points.

    points     (n, 3) float64; or a Surface or a pyvista.PolyData, whose vertices are taken
    valve      a kind, or a Valve with the start values, which is not changed
    free       names of the parameters to fit, each with one value; the others stay. A second name such as "annulus" frees its
               parameter, whose own name the result has. Only ratios of the sectors of cusps count, so a result with a free
               sector has a sum of 360 degrees
    placement  which of rotation, translation and scale to fit
    start      a dict of the start values of scale, rotation_axis, rotation_angle and translation. Without a
               translation, the middle of the valve starts at the middle of the points. Without a scale, a free scale
               starts from their extents. Instead of the dict, an object with such a dict as its placement and with a
               valve, such as another result. The first start then has the values of that valve
    bounds     a dict from names in free to (low, high). Other parameters have the bounds of valve.parameters, and
               lengths have half to twice the start value
    weights    (n,) float64 >= 0, of the squares of distances. If None: the area around each vertex of a
               surface, or 1 for other points
    whole      True: the points cover the whole valve about evenly, so a surface that extends beyond them is penalized.
               False: they cover a part of it, and nothing pulls back an edge that extends beyond them
    n_starts   the largest number of starts; None: 20. The first start has the given values. The others, by seed, have
               random values within the bounds, and a random rotation if start has none. The starts end when two of them have
               reached the best fit. There are at least four starts, or eight for a part of a valve. If this fit has doubts that
               a wrong result would explain, the other starts follow
    seed       the seed of the random starts
    noise      the standard deviation of the points from the surface, in the points' unit. If the residuals are larger, the
               result is doubted. If they are smaller, the standard errors stay
    thickness  the distance of both faces of a leaflet, if the points lie on both. Residuals are distances from the faces.
               None: the points lie on the surface
    unit       the points' unit. The valve's lengths are then in cm, and the placement has the scale 100 cm / m and so on.
               None: start gives the scale

    The fit maximizes the likelihood of points with normal noise along the surface's normal and with outliers.
    """
    points, areas = _points_of(points)
    _check_points(points)
    if isinstance(valve, Valve):
        own = valve.copy()
    elif isinstance(valve, str):
        own = Valve(valve)
    else:
        raise TypeError(f"valve: must be a kind or a riis.Valve, not {type(valve).__name__}")
    names, moves = _names_of(free, "free"), _names_of(placement, "placement")
    for move in moves:
        if move not in _MOVES:
            raise InvalidArgumentError(f"placement: '{move}' is not one of {', '.join(_MOVES)}")
    if not names and not moves:
        raise InvalidArgumentError("free: and placement are empty, so there is nothing to fit")
    if weights is not None:
        weights = _checked_weights(weights, len(points))
    else:
        weights = numpy.ones(len(points)) if areas is None else areas / (areas.mean() or 1.0)
    n_most = _MOST_STARTS if n_starts is None else _whole(n_starts, "n_starts", 1)
    seed = _whole(seed, "seed", 0)
    stated, thick = _length(noise, "noise"), _length(thickness, "thickness")
    if not isinstance(whole, bool):
        raise TypeError(f"whole: must be True or False, not {whole!r}")
    given = {} if start is None else start
    from_start = getattr(start, "valve", None)
    if isinstance(from_start, Valve):
        if from_start.kind != own.kind:
            raise InvalidArgumentError(f"start: its valve is of the kind {from_start.kind}, but valve is {own.kind}")
        own, given = from_start.copy(), getattr(start, "placement", None)
    names, bounds = _in_own_names(own, names, bounds)
    asked, names = names, _without_last_sector(names, own, bounds)
    _placed(given)
    given = _with_unit(unit, given, moves, own.kind)
    place = _placed(given)
    first = Surface(own, **place)  # this call refuses a bad placement, and values that do not fit together
    pose = start_pose(place)
    used = points[weights > 0.0]
    n_unknowns = len(names) + sum({"rotation": 3, "translation": 3, "scale": 1}[move] for move in moves)
    if len(used) < n_unknowns:
        raise InvalidArgumentError(f"points: {len(used)} have a weight, fewer than the {n_unknowns} unknowns")
    if "scale" in moves and "scale" not in given:
        pose = Pose(pose.rotation, pose.move, pose.scale * _extent(points, weights) / _extent_of(first))
    size = float(numpy.linalg.norm(first.info.upper - first.info.lower)) * pose.scale / place["scale"]
    limits = _bounds_of(own, names, {} if bounds is None else bounds, size / pose.scale)
    if "scale" not in moves:
        _check_unit(points, weights, first, own, limits, names)
    if thick > 0.2 * size:
        raise InvalidArgumentError(f"thickness: is {thick}; it must be at most a fifth of the valve's size, which is {size:.4g}")
    if stated > 0.2 * size:
        raise InvalidArgumentError(f"noise: is {stated}; it must be at most a fifth of the valve's size, which is {size:.4g}")

    random = numpy.random.default_rng(seed)
    problem = Problem(points, weights, own, names, limits, moves, size, whole, FINE, thick, 0.5 * stated)
    few = random.permutation(numpy.flatnonzero(weights > 0.0))[:_N_ROUGH]
    rough = Problem(points[few], weights[few], own.copy(), names, limits, moves, size, whole, ROUGH, thick, 0.5 * stated)
    middle = None
    if "translation" in moves and "translation" not in given:
        middle = numpy.array([weighted_median(column, weights) for column in points.T])
    shares = (numpy.array([own[name] for name in names]) - limits[:, 0]) / (limits[:, 1] - limits[:, 0])
    x = numpy.zeros(problem.n)
    x[: len(names)] = numpy.clip(shares, 0.01, 0.99)
    # Three equal cusps may open farther than unequal ones. Therefore the sizes of the cusps start with different values, and the
    # search sees one rule.
    x[: len(names)] += [1e-7 * (i + 1) if name.startswith(("cusp_", "commissure_")) else 0.0 for i, name in enumerate(names)]
    any_rotation = "rotation" in moves and "rotation_angle" not in given
    n_least = min(_LEAST_STARTS if whole else _LEAST_STARTS_OF_PART, n_most)
    ends, n_done = search(rough, pose, x, middle, any_rotation, n_least, n_most, random)
    found = _finish(problem, ends, n_done, stated, len(used), random)
    if n_done < n_most and any(doubt.startswith(_OF_ENDS) for doubt in found.doubts):  # the starts may agree on a wrong fit
        ends, n_done = search(rough, pose, x, middle, any_rotation, n_most, n_most, random)
        found = _finish(problem, ends, n_done, stated, len(used), random)
    return replace(_with_sum_of_360(found, asked), unit=unit)


def _extent(points: Reals, weights: Reals) -> float:
    """Returns the median distance of points from their middle."""
    middle = numpy.array([weighted_median(column, weights) for column in points.T])
    return weighted_median(numpy.linalg.norm(points - middle, axis=1), weights) or 1.0


def _extent_of(surface: Surface) -> float:
    return _extent(surface.vertices, vertex_areas(surface.vertices, surface.triangles.vertex_id))


def _placement_of(pose: Pose) -> dict[str, Any]:
    axis, angle = axis_and_angle(pose.rotation)
    return {"scale": pose.scale, "rotation_axis": axis, "rotation_angle": angle, "translation": tuple(pose.move.tolist())}


def _finish(problem: Problem, ends: list[End], n_done: int, stated: float, n_used: int,
            random: numpy.random.Generator) -> FitResult:
    """Minimizes finely from the best fits, and judges the best result."""
    best, others = ends[0], ends[1:]
    problem.begin(best.pose)
    x, mixture = problem.refine(best.x, 8, 1e-4)
    for attempt in range(4):
        x = problem.rebased(x)
        loss = mixture.loss(problem.whole)
        base, cost, fine = problem.base, problem.cost(x, loss), problem.at(x)
        assert fine is not None
        here = End(cost, base, x, probes_of(problem, x, random), fine.log_area, 0, 0)
        # The other fits are minimized once more, with the noise of the best fit.
        found: list[tuple[float, Reals, Pose]] = []
        better = None
        for end in others:
            if 2.0 * (end.cost - best.cost) > 100.0 * n_used / len(problem.points):
                continue
            problem.begin(end.pose)
            z = problem.solve(end.x, loss, 20, 0.01)
            there = problem.at(z)
            if there is None or is_same(problem, z, there.log_area, here):
                continue
            found.append((2.0 * (problem.cost(z, loss) - cost), z, problem.base))
            if found[-1][0] < -0.5:
                better = z, problem.base, end
        if better is not None and attempt < 3:
            problem.begin(better[1])
            x, mixture = problem.refine(better[0], 8, 1e-4)
            others = [end for end in ends if end is not better[2]]
            best = better[2]
            continue
        problem.begin(base)
        judged = Judge(problem, x, mixture, stated).judge()
        if judged.better is None or attempt == 3:
            break
        before = x
        x, mixture = problem.refine(judged.better, 8, 1e-4)
        there, is_near = problem.at(x), bool((numpy.abs(x - before) <= 3.0 * judged.errors).all())
        if not is_near and there is not None and not is_same(problem, x, there.log_area, here):
            best = replace(best, n_starts=0)  # the profile found this fit, and no start has reached it
    return _result(problem, x, mixture, judged, found, best, n_done, stated, random)


def _result(problem: Problem, x: Reals, mixture: Mixture, judged: Judged, found: list[tuple[float, Reals, Pose]], best: End,
            n_done: int, stated: float, random: numpy.random.Generator) -> FitResult:
    n_names, names = len(problem.names), problem.names
    base, values, pose = problem.base, problem.values(x), problem.pose(x)
    span = problem.bounds[:, 1] - problem.bounds[:, 0]
    errors = judged.errors.copy()
    rivals = []
    for excess, z, other in sorted(found, key=lambda one: one[0]):
        excess = max(excess, 0.0) / max(judged.misfit, 1.0)
        problem.begin(other)
        there = problem.values(z)
        if excess < RIVAL:
            rivals.append(Rival(dict(zip(names, there.tolist())), _placement_of(problem.pose(z)), excess))
            # Widens standard errors towards a rival. If the rival has the same cost, one standard error reaches the rival. If the
            # rival's cost is at the limit, three standard errors reach it.
            errors[:n_names] = numpy.maximum(errors[:n_names], numpy.abs(there - values) / span / max(1.0, excess**0.5))
    problem.begin(base)
    seen = problem.at(x)
    surface = problem.set_valve(x)
    assert seen is not None and surface is not None
    inlier = mixture.inlier(seen.residual)
    total = problem.weights * inlier
    share = covered(problem, x, inlier * (problem.weights > 0.0), random)
    problem.set_valve(x)
    undetermined = tuple(dict.fromkeys(name for i, name in enumerate(problem.unknowns) if errors[i] > UNDETERMINED))
    without_influence = tuple(name for name, moved in zip(names, judged.influence)
                              if name in undetermined and moved < max(mixture.noise, stated))
    at_bounds = tuple(name for name, at in zip(names, x[:n_names]) if not 1e-3 < at < 1.0 - 1e-3)
    doubts = []
    if best.n_starts < 2:
        doubts.append(f"starts: {best.n_starts} of {n_done} starts reached this fit; two that agree are needed")
    if rivals:
        doubts.append(f"rivals: {len(rivals)} other fits have a similar cost")
    if mixture.outliers > _MOST_OUTLIERS:
        doubts.append(f"outliers: {mixture.outliers:.0%} of the points are not on this fit")
    if stated > 0.0 and mixture.noise > _MOST_NOISE * stated:
        doubts.append(f"noise: the residuals scatter by {mixture.noise:.4g}, but the stated noise is {stated:.4g}")
    if stated == 0.0 and mixture.noise > _MOST_SCATTER * problem.size:
        doubts.append(f"noise: the residuals scatter by {mixture.noise:.4g}, and the valve's size is {problem.size:.4g}")
    if judged.misfit > judged.most_misfit:
        doubts.append(f"misfit: neighbouring residuals are alike ({judged.misfit:.2g} times as much as at random)")
    if problem.whole and share < _LEAST_COVERED:
        doubts.append(f"cover: the points cover {share:.0%} of this fit; for points on a part of a valve pass whole=False")
    moves = [name for name in undetermined if name in _MOVES]
    if moves:
        doubts.append(f"placement: the points do not determine {', '.join(moves)}, on which the sizes depend")
    if at_bounds:
        doubts.append(f"bounds: {', '.join(at_bounds)} ended at a bound")
    distances = seen.distance
    return FitResult(
        valve=problem.valve,
        placement=_placement_of(pose),
        parameters=dict(zip(names, values.tolist())),
        standard_errors={name: float(errors[i] * span[i]) for i, name in enumerate(names)},
        undetermined=undetermined,
        without_influence=without_influence,
        at_bounds=at_bounds,
        doubts=tuple(doubts),
        n_starts=n_done,
        n_agreeing=best.n_starts,
        rivals=tuple(rivals),
        n_crossings=int(find_crossings(surface, n_threads=1).n_pairs),
        singular_values=judged.singular_values,
        rms=float(numpy.sqrt(total @ seen.residual**2 / total.sum())),
        noise=mixture.noise,
        misfit=judged.misfit,
        outliers=mixture.outliers,
        covered=share,
        percentile95=float(numpy.percentile(distances, 95.0)),
        distances=distances,
        weights=total,
    )
