# SPDX-License-Identifier: Apache-2.0
"""Fits a valve to points, such as those of a segmented image, by scipy's least squares over closest points."""

from __future__ import annotations

import json
import os
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any, Literal

import numpy
from numpy.typing import NDArray

from riis._errors import Error, InvalidArgumentError
from riis._records import Parameter
from riis._riis import Surface, Valve

Reals = NDArray[numpy.float64]

# The surfaces of a fit: their triangles lie within this many half thicknesses of the smooth valve.
_TOLERANCE = 0.01
# A parameter is called undetermined if its standard error is more than this share of its bounds.
_UNDETERMINED = 0.1


@dataclass(frozen=True)
class FitResult:
    """A fitted valve: Surface(result.valve, **result.placement) is its surface."""

    valve: Valve
    placement: dict[str, Any]  #: scale, rotation_axis, rotation_angle (degrees) and translation
    parameters: dict[str, float]  #: the free parameters
    standard_errors: dict[str, float]  #: of these by the data's own scatter; infinite where the data say nothing
    undetermined: tuple[str, ...]  #: free parameters that the data do not determine
    rms: float  #: root mean square of the points' distances, without outliers' weight, lengths
    percentile95: float  #: 95 % of all points are at most so far, lengths
    distances: Reals = field(repr=False)  #: (n_points,), of all points
    weights: Reals = field(repr=False)  #: (n_points,), 0 to 1 times the caller's: small for outliers

    def write(self, path: str | os.PathLike[str]) -> str:
        """Writes the parameters to a file for riis-mark --params, and returns the options that place the valve."""
        values = {name: numpy.asarray(value).tolist() for name, value in dict(self.valve).items()}
        with open(path, "w", encoding="utf-8") as file:
            json.dump(values, file, indent=2)
            file.write("\n")
        axis, move = self.placement["rotation_axis"], self.placement["translation"]
        rotation = ",".join(f"{v:.17g}" for v in (*axis, self.placement["rotation_angle"]))
        return (
            f"--valve {self.valve.kind} --params {os.fspath(path)} --scale {self.placement['scale']:.17g} "
            f"--rotate {rotation} --translate {','.join(f'{v:.17g}' for v in move)}"
        )


def _matrix(vector: Reals) -> Reals:
    """Returns the rotation by a vector: its direction is the axis, its length the angle in radians (Rodrigues)."""
    angle = float(numpy.linalg.norm(vector))
    if angle == 0.0:
        return numpy.eye(3)
    x, y, z = vector / angle
    cross = numpy.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])
    return numpy.eye(3) + numpy.sin(angle) * cross + (1.0 - numpy.cos(angle)) * cross @ cross


class _Problem:
    """The unknowns: free parameters in shares of their bounds, then a rotation vector, a translation, log of the scale."""

    def __init__(self, points: Reals, weights: Reals, valve: Valve, names: list[str], bounds: Reals, moves: list[str],
                 placement: dict[str, Any], size: float) -> None:
        self.points, self.weights, self.valve, self.names, self.bounds = points, weights, valve, names, bounds
        self.moves, self.placement, self.size = moves, placement, size
        self.n = len(names) + sum({"rotation": 3, "translation": 3, "scale": 1}[move] for move in moves)
        self.surface: Surface | None = None
        self.last: tuple[bytes, Any] | None = None

    def parts(self, x: Reals) -> tuple[Reals, Reals, Reals, float]:
        """Returns the parameters, the rotation vector, the translation and the scale."""
        share, rest = x[: len(self.names)], list(x[len(self.names) :])
        rotation, translation, scale = numpy.zeros(3), numpy.zeros(3), 0.0
        for move in self.moves:
            if move == "rotation":
                rotation, rest = numpy.array(rest[:3]), rest[3:]
            elif move == "translation":
                translation, rest = numpy.array(rest[:3]) * self.size, rest[3:]
            else:
                scale, rest = float(rest[0]), rest[1:]
        values = self.bounds[:, 0] + share * (self.bounds[:, 1] - self.bounds[:, 0])
        return values, rotation, translation, float(numpy.exp(scale))

    def placed(self, x: Reals) -> tuple[Reals, Reals, float]:
        """Returns rotation matrix, translation and scale of the whole placement: the start's, then that of x."""
        _, vector, move, factor = self.parts(x)
        axis = numpy.asarray(self.placement["rotation_axis"], float)
        angle = numpy.radians(self.placement["rotation_angle"])
        start = _matrix(axis / numpy.linalg.norm(axis) * angle) if angle else numpy.eye(3)
        return _matrix(vector) @ start, numpy.asarray(self.placement["translation"], float) + move, factor * self.placement["scale"]

    def closest(self, x: Reals) -> tuple[Reals, Reals, Reals] | None:
        """Returns points less closest points, normals, and closest points in the valve's frame; None if no valve has x."""
        values, *_ = self.parts(x)
        rotation, translation, scale = self.placed(x)
        try:
            self.valve.update(**dict(zip(self.names, values.tolist())))
            if self.surface is None:
                self.surface = Surface(self.valve, half_thickness=0.05 * self.size / self.placement["scale"], tolerance=_TOLERANCE)
            else:
                self.surface.update(self.valve)
        except Error:
            return None
        local = numpy.ascontiguousarray((self.points - translation) @ rotation / scale)
        found = self.surface.closest_points(local, triangle_id=False, leaflet_id=False)
        assert found.point is not None and found.normal is not None
        return scale * (local - found.point) @ rotation.T, found.normal @ rotation.T, found.point

    def at(self, x: Reals) -> Any:
        """Returns differences and directions at x, computed once."""
        key = x.tobytes()
        if self.last is None or self.last[0] != key:
            found = self.closest(x)
            if found is not None:
                difference, normal, local = found
                length = numpy.linalg.norm(difference, axis=1)
                near = length < 1e-9 * self.size
                direction = numpy.where(near[:, None], normal, difference / numpy.where(near, 1.0, length)[:, None])
                # The sign makes distances smooth where points change sides; a cost does not depend on it.
                sign = numpy.where(numpy.einsum("ij,ij->i", direction, normal) < 0.0, -1.0, 1.0)
                found = (difference, direction * sign[:, None], length * sign, local)
            self.last = key, found
        return self.last[1]

    def residuals(self, x: Reals) -> Reals:
        found = self.at(x)
        if found is None:
            return numpy.full(len(self.points), 10.0 * self.size)
        return self.weights * found[2]

    def jacobian(self, x: Reals) -> Reals:
        found = self.at(x)
        result = numpy.zeros((len(self.points), self.n))
        if found is None:
            return result
        _, direction, distance, local = found
        rotation, translation, scale = self.placed(x)
        for i in range(len(self.names)):
            step = 2e-3 if x[i] < 0.5 else -2e-3
            moved = x.copy()
            moved[i] += step
            other = self.closest(moved)
            if other is not None:
                result[:, i] = (numpy.einsum("ij,ij->i", other[0], direction) - distance) / step
        column = len(self.names)
        turned = scale * local @ rotation.T
        _, vector, _, _ = self.parts(x)
        for move in self.moves:
            if move == "translation":
                result[:, column : column + 3] = -direction * self.size
            elif move == "rotation":
                for k in range(3):
                    step = numpy.zeros(3)
                    step[k] = 1e-6
                    change = (_matrix(vector + step) - _matrix(vector - step)) / 2e-6
                    derivative = change @ _matrix(vector).T
                    result[:, column + k] = -numpy.einsum("ij,ij->i", direction, turned @ derivative.T)
            else:
                result[:, column] = -numpy.einsum("ij,ij->i", direction, turned)
            column += 1 if move == "scale" else 3
        return self.weights[:, None] * result


def _default_bounds(parameter: Parameter, value: float) -> tuple[float, float]:
    """Returns the bounds of the table. Those of lengths span many powers of ten, so they are narrowed to a factor of two."""
    if parameter.unit != "length" or value == 0.0:
        return parameter.minimum, parameter.maximum
    low, high = sorted((0.5 * value, 2.0 * value))
    return max(low, parameter.minimum), min(high, parameter.maximum)


def _bounds_of(valve: Valve, free: Sequence[str], given: Mapping[str, tuple[float, float]]) -> Reals:
    table = valve.parameters
    bounds = []
    for name in free:
        if name not in table:
            raise InvalidArgumentError(f"free: '{name}' is no parameter of a {valve.kind} valve; they are {', '.join(table)}")
        if table[name].n_values != 1:
            raise InvalidArgumentError(f"free: '{name}' has three values; placement fits a place and a rotation")
        low, high = given.get(name, _default_bounds(table[name], valve[name]))
        if not table[name].minimum <= low < high <= table[name].maximum:
            raise InvalidArgumentError(
                f"bounds: those of '{name}' are {low} and {high}; they must ascend within {table[name].minimum} and "
                f"{table[name].maximum}"
            )
        bounds.append((low, high))
    unknown = set(given) - set(free)
    if unknown:
        raise InvalidArgumentError(f"bounds: '{min(unknown)}' is not in free")
    return numpy.array(bounds, float).reshape(-1, 2)


def fit(
    points: Reals | Surface,
    valve: str | Valve,
    *,
    free: Sequence[str],
    placement: Sequence[Literal["rotation", "translation", "scale"]] = ("rotation", "translation"),
    start: Mapping[str, Any] | None = None,
    bounds: Mapping[str, tuple[float, float]] | None = None,
    weights: Reals | None = None,
    n_starts: int = 1,
    seed: int = 0,
) -> FitResult:
    """Finds parameters and a placement with which a valve lies closest to points.

    points     (n, 3) float64, or a Surface, whose vertices are taken
    valve      a kind, or a Valve with the values to start from, which stays as it is
    free       names of parameters with one value that are fitted; the others stay
    placement  which of rotation, translation and scale are fitted
    start      a dict of scale, rotation_axis, rotation_angle and translation to start from
    bounds     a dict from names in free to (low, high); others have those of valve.parameters, lengths half to twice
               the value to start from
    weights    (n,) float64 >= 0, of the squares of distances
    n_starts   1 starts from the given values; others from random values within the bounds, by seed

    Distances are from the points to the surface alone. So gaps in the points do no harm, but nothing pulls an edge back
    that reaches beyond the points. Outliers lose weight (Cauchy's loss, by the scatter of the points).
    """
    from scipy.optimize import least_squares

    valve = Valve(valve) if isinstance(valve, str) else valve.copy()
    if isinstance(points, Surface):
        points = numpy.array(points.vertices)
    if not isinstance(points, numpy.ndarray) or points.dtype != numpy.float64:
        raise TypeError("points: must be a numpy array of float64, or a riis.Surface")
    if points.ndim != 2 or points.shape[1] != 3:
        raise InvalidArgumentError(f"points: its shape is {points.shape}; it must be (n, 3)")
    if not numpy.isfinite(points).all():
        raise InvalidArgumentError("points: has a coordinate that is not finite")
    if weights is None:
        weights = numpy.ones(len(points))
    if not isinstance(weights, numpy.ndarray) or weights.shape != (len(points),):
        raise InvalidArgumentError(f"weights: must be an array of shape ({len(points)},)")
    if not (numpy.isfinite(weights).all() and (weights >= 0.0).all() and weights.any()):
        raise InvalidArgumentError("weights: must be finite, at least 0, and not all 0")
    moves = list(dict.fromkeys(placement))
    for move in moves:
        if move not in ("rotation", "translation", "scale"):
            raise InvalidArgumentError(f"placement: '{move}' is none of 'rotation', 'translation', 'scale'")
    place = {"scale": 1.0, "rotation_axis": (0.0, 0.0, 1.0), "rotation_angle": 0.0, "translation": (0.0, 0.0, 0.0)}
    for name, value in (start or {}).items():
        if name not in place:
            raise InvalidArgumentError(f"start: '{name}' is none of {', '.join(place)}")
        place[name] = value
    names = list(dict.fromkeys(free))
    limits = _bounds_of(valve, names, bounds or {})
    if not names and not moves:
        raise InvalidArgumentError("free: and placement are empty, so there is nothing to fit")
    info = Surface(valve, scale=place["scale"]).info
    size = float(numpy.linalg.norm(info.upper - info.lower))
    problem = _Problem(points, numpy.sqrt(weights), valve, names, limits, moves, place, size)
    if len(points) < problem.n:
        raise InvalidArgumentError(f"points: there are {len(points)}, fewer than the {problem.n} unknowns")

    span = limits[:, 1] - limits[:, 0]
    given = numpy.zeros(problem.n)
    given[: len(names)] = numpy.clip((numpy.array([valve[name] for name in names]) - limits[:, 0]) / span, 0.01, 0.99)
    low, high = numpy.full(problem.n, -numpy.inf), numpy.full(problem.n, numpy.inf)
    low[: len(names)], high[: len(names)] = 0.0, 1.0
    random = numpy.random.default_rng(seed)

    def solve(x: Reals, width: float) -> Any:
        return least_squares(
            problem.residuals, x, problem.jacobian, bounds=(low, high), loss="cauchy", f_scale=width, x_scale=1.0, max_nfev=60,
            ftol=1e-6, xtol=1e-6, gtol=1e-10,
        )

    def width_of(x: Reals) -> float:
        return max(3.0 * 1.4826 * float(numpy.median(numpy.abs(problem.residuals(x)))), 1e-4 * size)

    best: tuple[float, Reals] | None = None
    for number in range(max(1, n_starts)):
        x = given.copy()
        if number > 0:
            x[: len(names)] = random.uniform(0.05, 0.95, len(names))
            x[len(names) :] = random.normal(0.0, 0.1, problem.n - len(names))
        if problem.at(x) is None:
            continue  # the values clash
        x = solve(x, 0.05 * size).x
        for _ in range(2):
            x = solve(x, width_of(x)).x
        typical = float(numpy.median(numpy.abs(problem.residuals(x))))
        if best is None or typical < best[0]:
            best = typical, x
    if best is None:
        raise InvalidArgumentError("valve: no start has a surface; its values clash")
    return _result(problem, best[1], width_of(best[1]), weights)


def _result(problem: _Problem, x: Reals, width: float, weights: Reals) -> FitResult:
    found = problem.at(x)
    distances = numpy.abs(found[2])
    robust = 1.0 / (1.0 + (problem.weights * distances / width) ** 2)
    jacobian = problem.jacobian(x) * numpy.sqrt(robust)[:, None]
    total = weights * robust
    variance = float(total @ distances**2) / max(1.0, float(numpy.count_nonzero(total > 0.5 * weights.max()) - problem.n))
    assert problem.surface is not None
    scale = problem.placed(x)[2]
    variance = max(variance, (scale * problem.surface.info.error_bound) ** 2)  # triangles are no better than this
    _, s, v = numpy.linalg.svd(jacobian, full_matrices=False)
    kept = s > max(1e-6 * s.max(), 1e-12)
    covariance = (v[kept].T / s[kept] ** 2) @ v[kept] * variance
    blind = (v[~kept] ** 2).sum(axis=0) > 1e-6
    share = numpy.where(blind, numpy.inf, numpy.sqrt(numpy.diag(covariance)))
    problem.closest(x)  # the last difference moved the valve
    rotation, translation, scale = problem.placed(x)
    axis, angle = _axis_and_angle(rotation)
    values = problem.parts(x)[0]
    span = problem.bounds[:, 1] - problem.bounds[:, 0]
    return FitResult(
        valve=problem.valve,
        placement={"scale": scale, "rotation_axis": axis, "rotation_angle": angle, "translation": tuple(translation.tolist())},
        parameters=dict(zip(problem.names, values.tolist())),
        standard_errors={name: float(share[i] * span[i]) for i, name in enumerate(problem.names)},
        undetermined=tuple(name for i, name in enumerate(problem.names) if share[i] > _UNDETERMINED),
        rms=float(numpy.sqrt(total @ distances**2 / total.sum())),
        percentile95=float(numpy.percentile(distances, 95.0)),
        distances=distances,
        weights=total,
    )


def _axis_and_angle(rotation: Reals) -> tuple[tuple[float, float, float], float]:
    """Returns the axis of a rotation matrix and its angle in degrees, 0 to 180."""
    twice = numpy.array([rotation[2, 1] - rotation[1, 2], rotation[0, 2] - rotation[2, 0], rotation[1, 0] - rotation[0, 1]])
    angle = float(numpy.arctan2(numpy.linalg.norm(twice), numpy.trace(rotation) - 1.0))
    if numpy.linalg.norm(twice) < 1e-9:
        if angle < 1.0:
            return (0.0, 0.0, 1.0), 0.0
        column = int(numpy.argmax(numpy.diag(rotation)))
        twice = rotation[:, column] + numpy.eye(3)[column]
    x, y, z = (twice / numpy.linalg.norm(twice)).tolist()
    return (x, y, z), float(numpy.degrees(angle))
