# SPDX-License-Identifier: Apache-2.0
"""Fits a valve to points, such as those of a segmented image. It uses scipy's least squares on distances to closest points."""

from __future__ import annotations

import json
import operator
import os
import shlex
import sys
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any, Literal

import numpy
from numpy.typing import NDArray

from riis._errors import InvalidArgumentError
from riis._fit_problem import (
    FINE,
    ROUGH,
    Pose,
    Problem,
    axis_and_angle,
    matrix_of,
    random_rotations,
    start_pose,
    vertex_areas,
    weighted_median,
)
from riis._records import Parameter
from riis._riis import Surface, Valve

Reals = NDArray[numpy.float64]

# An unknown is undetermined if its standard error exceeds this fraction of a reference: the width of its bounds, a radian, the
# valve's size, or the scale.
_UNDETERMINED = 0.1
_MOVES = ("rotation", "translation", "scale")
# The rough search uses this number of points.
_N_ROUGH = 400
# This many results of the rough search are refined, with a width from the scatter of the points.
_N_ENDS = 3
# Each further start chooses among this many rotations.
_N_ROTATIONS = 150


@dataclass(frozen=True)
class FitResult:
    """A fitted valve. Its surface is Surface(result.valve, **result.placement)."""

    valve: Valve
    placement: dict[str, Any]  #: scale, rotation_axis, rotation_angle (degrees) and translation
    parameters: dict[str, float]  #: the free parameters
    standard_errors: dict[str, float]  #: of the free parameters, from the data's scatter; infinite if the data say nothing about
                                       #: a parameter
    undetermined: tuple[str, ...]  #: free parameters and parts of the placement that the data do not determine
    at_bounds: tuple[str, ...]  #: free parameters that ended at a bound
    singular_values: Reals  #: of the Jacobian (rows: points, columns: unknowns), descending, in units of the valve's size
    rms: float  #: root mean square of the distances, with the weights below
    percentile95: float  #: 95 % of all points have at most this distance
    distances: Reals = field(repr=False)  #: (n_points,), of all points
    weights: Reals = field(repr=False)  #: (n_points,), the caller's weights times a factor from 0 to 1, small for outliers

    def report(self) -> str:
        """Returns a table of the parameters with their standard errors, followed by the measures of the fit."""
        table = self.valve.parameters
        lines = [f"{'parameter':32} {'value':>10} {'std. error':>10}  unit"]
        for name, value in self.parameters.items():
            notes = ["undetermined"] * (name in self.undetermined) + ["at a bound"] * (name in self.at_bounds)
            lines.append(
                f"{name:32} {value:10.4f} {self.standard_errors[name]:10.4f}  {table[name].unit:7} {', '.join(notes)}".rstrip()
            )
        for name, value in self.placement.items():
            numbers = " ".join(f"{number:.4f}" for number in numpy.atleast_1d(value))
            lines.append(f"{name:32} {numbers}")
        moves = [name for name in self.undetermined if name in _MOVES]
        if moves:
            lines.append(f"undetermined in the placement: {', '.join(moves)}")
        light = int(numpy.count_nonzero(self.weights < 0.25 * self.weights.max()))
        share = f"95 % of {len(self.distances)} points within {self.percentile95:.4f}"
        lines.append(f"rms {self.rms:.4f}, {share}, {light} with little weight")
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
    """Returns whether the parameters alone define the valve: it has no patches, and the caller gave no open state."""
    if valve.kind == "patches":
        return False
    alone = Valve(valve.kind)
    alone.update(**dict(valve))
    if "opening" in valve:
        valve, alone = valve.copy(), alone.copy()
        valve["opening"] = alone["opening"] = 1.0
    return numpy.array_equal(Surface(alone).vertices, Surface(valve).vertices)


def _reals(data: Any, name: str, or_else: str = "") -> Reals:
    """Returns an array of float64. Refuses other values as the calls in C++ do."""
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


def _bounds_of(valve: Valve, free: list[str], given: Any, size: float) -> Reals:
    if not isinstance(given, Mapping):
        raise TypeError(f"bounds: must be a dict from names to pairs, not {given!r}")
    table = valve.parameters
    bounds = []
    for name in free:
        if name not in table:
            raise InvalidArgumentError(
                f"free: '{name}' is not a parameter of a {valve.kind} valve; the parameters are {', '.join(table)}")
        if table[name].n_values != 1:
            raise InvalidArgumentError(f"free: '{name}' has three values; only parameters with one can be free")
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


def _placed(start: Any) -> dict[str, Any]:
    if not isinstance(start, Mapping):
        raise TypeError(f"start: must be a dict of a placement, not {start!r}")
    place = {"scale": 1.0, "rotation_axis": (0.0, 0.0, 1.0), "rotation_angle": 0.0, "translation": (0.0, 0.0, 0.0)}
    for name, value in start.items():
        if name not in place:
            raise InvalidArgumentError(f"start: '{name}' is not one of {', '.join(place)}")
        place[name] = value
    return place


def fit(
    points: Any,
    valve: str | Valve,
    *,
    free: Sequence[str],
    placement: Sequence[Literal["rotation", "translation", "scale"]] = ("rotation", "translation"),
    start: Mapping[str, Any] | None = None,
    bounds: Mapping[str, tuple[float, float]] | None = None,
    weights: Reals | None = None,
    whole: bool = True,
    n_starts: int = 8,
    seed: int = 0,
) -> FitResult:
    """Finds the parameters and the placement that bring a valve closest to points.

    points     (n, 3) float64; or a Surface or a pyvista.PolyData, whose vertices are taken
    valve      a kind, or a Valve with the start values, which is not changed
    free       names of the parameters to fit, each with one value; the others stay
    placement  which of rotation, translation and scale to fit
    start      a dict of the start values of scale, rotation_axis, rotation_angle and translation. Without a
               translation, the middle of the valve starts at the middle of the points. Without a scale, a free scale
               starts from their extents
    bounds     a dict from names in free to (low, high). The others have the bounds of valve.parameters, and lengths
               half to twice the start value
    weights    (n,) float64 >= 0, of the squares of distances. If None: the area around each vertex of a
               surface, or 1 for other points
    whole      True: the points cover the whole valve, about evenly, so a surface that reaches beyond them is penalized.
               False: they cover a part of it, and nothing pulls back an edge that reaches beyond them
    n_starts   the first start has the given values. Others, chosen by seed, have random values within the bounds and,
               if start has no rotation, any rotation. The closest fit is returned
    seed       the seed of the random starts

    Distances are from the points to the surface. Outliers lose weight (Cauchy's loss, with a width from the scatter of the
    points).
    """
    points, areas = _points_of(points)
    _check_points(points)
    if isinstance(valve, Valve):
        valve = valve.copy()
    elif isinstance(valve, str):
        valve = Valve(valve)
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
    n_starts, seed = _whole(n_starts, "n_starts", 1), _whole(seed, "seed", 0)
    if not isinstance(whole, bool):
        raise TypeError(f"whole: must be True or False, not {whole!r}")
    given = {} if start is None else start
    place = _placed(given)
    first = Surface(valve, **place)  # this call refuses a bad placement, and values that do not fit together
    pose = start_pose(place)
    used = points[weights > 0.0]
    n_unknowns = len(names) + sum({"rotation": 3, "translation": 3, "scale": 1}[move] for move in moves)
    if len(used) < n_unknowns:
        raise InvalidArgumentError(f"points: {len(used)} have a weight, fewer than the {n_unknowns} unknowns")
    if "scale" in moves and "scale" not in given:
        pose = Pose(pose.rotation, pose.move, pose.scale * _extent(points, weights) / _extent_of(first))
    size = float(numpy.linalg.norm(first.info.upper - first.info.lower)) * pose.scale / place["scale"]
    limits = _bounds_of(valve, names, {} if bounds is None else bounds, size / pose.scale)

    random = numpy.random.default_rng(seed)
    problem = Problem(points, weights, valve, names, limits, moves, size, whole, FINE)
    few = random.permutation(numpy.flatnonzero(weights > 0.0))[:_N_ROUGH]
    rough = Problem(points[few], weights[few], valve.copy(), names, limits, moves, size, whole, ROUGH)
    middle = None
    if "translation" in moves and "translation" not in given:
        middle = numpy.array([weighted_median(column, weights) for column in points.T])
    shares = (numpy.array([valve[name] for name in names]) - limits[:, 0]) / (limits[:, 1] - limits[:, 0])
    x = numpy.zeros(problem.n)
    x[: len(names)] = numpy.clip(shares, 0.01, 0.99)
    base, x = _search(rough, pose, x, middle, "rotation" in moves and "rotation_angle" not in given, n_starts, random)
    problem.begin(base)
    return _result(problem, problem.refine(x, 8))


def _extent(points: Reals, weights: Reals) -> float:
    """Returns the median distance of points from their middle."""
    middle = numpy.array([weighted_median(column, weights) for column in points.T])
    return weighted_median(numpy.linalg.norm(points - middle, axis=1), weights) or 1.0


def _extent_of(surface: Surface) -> float:
    return _extent(surface.vertices, vertex_areas(surface.vertices, surface.triangles.vertex_id))


def _search(problem: Problem, pose: Pose, given: Reals, middle: Reals | None, any_rotation: bool, n_starts: int,
            random: numpy.random.Generator) -> tuple[Pose, Reals]:
    """Minimizes roughly from every start. Returns the base and the unknowns of the best result."""
    n_names = len(problem.names)
    width = 0.05 * problem.size
    ends: list[tuple[float, Pose, Reals]] = []

    def go_down(base: Pose, x: Reals) -> None:
        problem.begin(base)
        x = problem.solve(x, width, 30, 1e-4)
        ends.append((problem.loss(x, width), problem.pose(x), numpy.append(x[:n_names], numpy.zeros(problem.n - n_names))))
        ends.sort(key=lambda end: end[0])

    for number in range(n_starts):
        x, rotations = given.copy(), numpy.eye(3)[None]
        if number > 0:
            x[:n_names] = random.uniform(0.05, 0.95, n_names)
            if any_rotation:
                rotations = random_rotations(random, _N_ROTATIONS)
        problem.begin(pose)
        base = problem.best_rotation(x, rotations, middle)
        if base is not None:  # None if the values do not fit together
            go_down(base, x)
    if not ends:
        raise InvalidArgumentError("valve: no start has a surface; its values clash")
    if any_rotation and n_starts > 1:
        # A valve looks similar if it is turned by one cusp, or if front and back are swapped. So these rotations are tried.
        _, found, x = ends[0]
        for angle in numpy.radians((120.0, 240.0, 180.0)):
            turn = matrix_of(numpy.array([0.0, 0.0, angle]))
            go_down(Pose(found.rotation @ turn, found.move, found.scale), x)
    best: list[tuple[float, Pose, Reals]] = []
    for _, base, x in ends[:_N_ENDS]:
        problem.begin(base)
        x = problem.refine(x, 2)
        best.append((problem.noise, problem.pose(x), numpy.append(x[:n_names], numpy.zeros(problem.n - n_names))))
    noise = min(end[0] for end in best)

    def rank(end: tuple[float, Pose, Reals]) -> float:
        problem.begin(end[1])
        return problem.merit(end[2], noise)

    _, base, x = min(best, key=rank)
    return base, x


def _result(problem: Problem, x: Reals) -> FitResult:
    seen, width, weights = problem.at(x), 3.0 * problem.noise, problem.weights
    assert seen is not None
    distances = numpy.abs(seen.distance)
    robust = 1.0 / (1.0 + weights * (distances / width) ** 2)
    jacobian = problem.jacobian(x) * numpy.sqrt(numpy.append(robust, 1.0))[:, None]
    surface, pose = problem.set_valve(x), problem.pose(x)  # the last derivative changed the valve, so this restores it
    assert surface is not None
    total = weights * robust
    n_free = total.sum() ** 2 / (total**2).sum() - problem.n
    variance = float(total @ distances**2) / total.sum() * (1.0 + problem.n / max(1.0, n_free))
    variance = max(variance, (pose.scale * surface.info.error_bound) ** 2)  # the fit cannot be more accurate than the triangles
    _, s, v = numpy.linalg.svd(jacobian, full_matrices=False)
    kept = s > max(1e-6 * s.max(), 1e-12 * problem.size)
    covariance = (v[kept].T / s[kept] ** 2) @ v[kept] * variance
    blind = (v[~kept] ** 2).sum(axis=0) > 1e-6
    errors = numpy.where(blind, numpy.inf, numpy.sqrt(numpy.diag(covariance)))
    axis, angle = axis_and_angle(pose.rotation)
    n_names = len(problem.names)
    span = problem.bounds[:, 1] - problem.bounds[:, 0]
    return FitResult(
        valve=problem.valve,
        placement={"scale": pose.scale, "rotation_axis": axis, "rotation_angle": angle, "translation": tuple(pose.move.tolist())},
        parameters=dict(zip(problem.names, problem.values(x).tolist())),
        standard_errors={name: float(errors[i] * span[i]) for i, name in enumerate(problem.names)},
        undetermined=tuple(dict.fromkeys(name for i, name in enumerate(problem.unknowns) if errors[i] > _UNDETERMINED)),
        at_bounds=tuple(name for name, share in zip(problem.names, x[:n_names]) if not 1e-3 < share < 1.0 - 1e-3),
        singular_values=s / problem.size,
        rms=float(numpy.sqrt(total @ distances**2 / total.sum())),
        percentile95=float(numpy.percentile(distances, 95.0)),
        distances=distances,
        weights=total,
    )
