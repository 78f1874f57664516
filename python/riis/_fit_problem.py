# SPDX-License-Identifier: Apache-2.0
"""The likelihood behind riis.fit: residuals, their derivatives, and the search from one start."""

from __future__ import annotations

import copy
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy
from numpy.typing import NDArray

from riis._errors import Error
from riis._riis import Surface, Valve

Reals = NDArray[numpy.float64]

# Triangles lie within this distance of the smooth valve, as a fraction of the valve's size.
FINE, ROUGH = 5e-4, 2e-3
# A direction of the surface is the difference between two states. The difference between the states is this fraction of a
# parameter's bounds, or of the value of a fixed size.
_STEP = 1e-5
# Above this number of points, several threads are used. For fewer points a surface takes a few milliseconds, and threads would
# cost more than they gain.
_MANY = 20_000
_N_UNKNOWNS = {"rotation": 3, "translation": 3, "scale": 1}


def matrix_of(vector: Reals) -> Reals:
    """Returns the rotation for a vector. The direction of the vector is the axis, and its length is the angle in radians
    (Rodrigues)."""
    angle = float(numpy.linalg.norm(vector))
    if angle == 0.0:
        return numpy.eye(3)
    x, y, z = vector / angle
    cross = numpy.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])
    return numpy.eye(3) + numpy.sin(angle) * cross + (1.0 - numpy.cos(angle)) * cross @ cross


def axis_and_angle(rotation: Reals) -> tuple[tuple[float, float, float], float]:
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


def random_rotations(random: numpy.random.Generator, n: int) -> Reals:
    """Returns n uniformly random rotations, (n, 3, 3), from quaternions of four normal numbers."""
    quaternions = random.normal(size=(4, n))
    w, x, y, z = quaternions / numpy.linalg.norm(quaternions, axis=0)
    rows = [
        [1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
        [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
        [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)],
    ]
    return numpy.moveaxis(numpy.array(rows), 2, 0)


def weighted_median(values: Reals, weights: Reals) -> float:
    """Returns the weighted median: the value below which half of the weight lies."""
    order = numpy.argsort(values)
    total = numpy.cumsum(weights[order])
    return float(values[order][numpy.searchsorted(total, 0.5 * total[-1])])


def vertex_areas(vertices: Reals, triangles: NDArray[numpy.int64]) -> Reals:
    """Returns a third of the area of the triangles around each vertex."""
    a, b, c = (vertices[triangles[:, k]] for k in range(3))
    third = numpy.linalg.norm(numpy.cross(b - a, c - a), axis=1) / 6.0
    return numpy.asarray(numpy.bincount(triangles.ravel(), numpy.repeat(third, 3), len(vertices)), numpy.float64)


def is_fixed_size(valve: Valve, name: str) -> bool:
    """Returns whether a parameter is a size that may be wrong in a fit in which it is not free. A size of one cusp or commissure
    that was not set follows the valve, so it does not count. The sizes of a bump count if the bump has a place."""
    part, _, size = name.rpartition(".")
    if part.startswith("bump_"):
        has_place = valve[f"{part}.leaflet"] >= 0.0 or valve[f"{part}.commissure"] >= 0.0
        return has_place and size not in ("leaflet", "commissure")
    if part.startswith(("cusp_", "commissure_")):
        return valve.is_set(name)
    return name != "opening"


@dataclass(frozen=True)
class Pose:
    """The placement x -> scale * rotation @ x + move."""

    rotation: Reals
    move: Reals
    scale: float


class Seen(NamedTuple):
    """The points' positions relative to a valve."""

    residual: Reals  # (n,), distances; with a thickness, distances minus half of it
    direction: Reals  # (n, 3), unit vectors along which the residual grows
    distance: Reals  # (n,), at least 0
    local: Reals  # (n, 3), the closest points in the valve's frame
    log_area: float
    corners: NDArray[numpy.int64]  # (n, 3), the vertices of the triangles of the closest points
    barycentric: Reals  # (n, 3)


class Loss(NamedTuple):
    """The negative logarithm of the density of a residual. The negative logarithm is a concave function of the squared residual,
    so weighted least squares never increase it."""

    value: Callable[[Reals], Reals]
    weight: Callable[[Reals], Reals]  # the derivative by half of the residual's square
    area: float  # weight of log(area) for each point


def wide_loss(width: float) -> Loss:
    """Returns Cauchy's loss. With it, a search may begin far from the points."""
    return Loss(
        lambda r: numpy.asarray(numpy.log1p((r / width) ** 2)), lambda r: 2.0 / width**2 / (1.0 + (r / width) ** 2), 0.0)


@dataclass(frozen=True)
class Mixture:
    """Points with normal noise along the normal, and a share of outliers whose distances are uniformly distributed."""

    noise: float
    outliers: float  # their share
    reach: float  # the largest residual of an outlier

    def inlier(self, r: Reals) -> Reals:
        """Returns the probability that a point is not an outlier."""
        normal = (1.0 - self.outliers) * numpy.exp(-0.5 * (r / self.noise) ** 2) / (numpy.sqrt(2.0 * numpy.pi) * self.noise)
        return numpy.asarray(normal / (normal + 0.5 * self.outliers / self.reach))

    def value(self, r: Reals) -> Reals:
        """Returns the negative logarithm of the density."""
        normal = (1.0 - self.outliers) * numpy.exp(-0.5 * (r / self.noise) ** 2) / (numpy.sqrt(2.0 * numpy.pi) * self.noise)
        return numpy.asarray(-numpy.log(normal + 0.5 * self.outliers / self.reach))

    def loss(self, whole: bool) -> Loss:
        # If points lie evenly over the whole valve, each point has the probability density 1 / area. The logarithm of their
        # likelihood therefore contains the term -n log(area). The rest of the likelihood is biased near an edge. Noise moves
        # points beyond the edge. Such points pull the edge outwards by n noise^2 / (4 area) per length. A quarter of the area's
        # term pulls the edge inwards by the same amount, so edges stay in place.
        return Loss(self.value, lambda r: self.inlier(r) / self.noise**2, 0.25 * (1.0 - self.outliers) if whole else 0.0)


class Problem:
    """The unknowns x are the parameters as fractions of their bounds, a rotation vector, a translation in units of the
    valve's size, and the scale's logarithm.

    The last three start at 0, relative to the pose with which a search begins.
    """

    def __init__(self, points: Reals, weights: Reals, valve: Valve, names: list[str], bounds: Reals, moves: list[str],
                 size: float, whole: bool, tolerance: float, thickness: float, least_noise: float) -> None:
        self.points, self.weights = points, weights
        self.valve, self.names, self.bounds, self.moves, self.size, self.whole = valve, names, bounds, moves, size, whole
        self.tolerance, self.thickness, self.least_noise = tolerance, thickness, least_noise
        self.unknowns = list(names)
        for move in moves:
            self.unknowns += [move] * _N_UNKNOWNS[move]
        self.n = len(self.unknowns)
        self.low, self.high = numpy.full(self.n, -numpy.inf), numpy.full(self.n, numpy.inf)
        self.low[: len(names)], self.high[: len(names)] = 0.0, 1.0
        self.base = Pose(numpy.eye(3), numpy.zeros(3), 1.0)
        self.surface: Surface | None = None
        self.surface_at: bytes | None = None  # the parameters of the surface, unless it has directions
        self.last: tuple[bytes, Seen | None] | None = None

    def with_points(self, points: Reals) -> Problem:
        """Returns the problem of the same valve and pose with other points, each with the weight 1."""
        other = copy.copy(self)
        other.points, other.weights, other.valve = points, numpy.ones(len(points)), self.valve.copy()
        other.surface = other.surface_at = other.last = None
        return other

    def begin(self, base: Pose) -> None:
        """Sets the base: the pose to which the unknowns of the placement are relative."""
        self.base, self.last = base, None

    def rebased(self, x: Reals) -> Reals:
        """Makes the pose of x the base of the unknowns. Returns the unknowns of the same valve relative to this base."""
        self.begin(self.pose(x))
        x = x.copy()
        x[len(self.names):] = 0.0
        return x

    def values(self, x: Reals) -> Reals:
        """Returns the parameters."""
        return self.bounds[:, 0] + x[: len(self.names)] * (self.bounds[:, 1] - self.bounds[:, 0])

    def at_random(self, random: numpy.random.Generator) -> Reals:
        """Returns random parameters, as fractions of their bounds. Lengths are evenly distributed by their logarithms, because
        the bounds are half and twice a value."""
        shares = random.uniform(0.05, 0.95, len(self.names))
        for i, (name, (low, high)) in enumerate(zip(self.names, self.bounds.tolist())):
            if self.valve.parameters[name].unit == "length" and low > 0.0:
                shares[i] = ((high / low) ** shares[i] - 1.0) / (high / low - 1.0)
        return shares

    def motion(self, x: Reals) -> tuple[Reals, Reals, float]:
        """Returns the rotation vector, the translation and the factor that x adds to the base."""
        parts: dict[str, Reals] = {"rotation": numpy.zeros(3), "translation": numpy.zeros(3), "scale": numpy.zeros(1)}
        at = len(self.names)
        for move in self.moves:
            parts[move] = x[at : at + _N_UNKNOWNS[move]]
            at += _N_UNKNOWNS[move]
        return parts["rotation"], parts["translation"] * self.size, float(numpy.exp(parts["scale"][0]))

    def pose(self, x: Reals) -> Pose:
        """Returns the whole placement."""
        vector, move, factor = self.motion(x)
        return Pose(matrix_of(vector) @ self.base.rotation, self.base.move + move, factor * self.base.scale)

    def set_valve(self, x: Reals) -> Surface | None:
        """Gives the valve and its surface the parameters of x. Returns None if the parameters do not fit together."""
        key = x[: len(self.names)].tobytes()
        if self.surface is not None and self.surface_at == key:
            return self.surface
        self.surface_at = None
        try:
            self.valve.update(**dict(zip(self.names, self.values(x).tolist())))
            if self.surface is None:
                scale = self.base.scale
                self.surface = Surface(self.valve, half_thickness=self.size / scale, tolerance=self.tolerance, n_threads=1)
            else:
                self.surface.update(self.valve)
        except Error:
            return None
        self.surface_at = key
        return self.surface

    def look(self, x: Reals) -> Seen | None:
        """Computes the points' positions relative to the valve at x. Returns None if the valve's values do not fit together."""
        surface, pose = self.set_valve(x), self.pose(x)
        if surface is None:
            return None
        local = numpy.ascontiguousarray((self.points - pose.move) @ pose.rotation / pose.scale)
        n_threads = 0 if len(local) >= _MANY else 1
        found = surface.closest_points(local, barycentric=True, leaflet_id=False, n_threads=n_threads)
        assert found.point is not None and found.normal is not None and found.distance is not None
        assert found.barycentric is not None and found.triangle_id is not None
        triangles = surface.triangles
        row = numpy.searchsorted(triangles.triangle_id, found.triangle_id)
        difference, length = local - found.point, found.distance
        near = length * pose.scale < 1e-9 * self.size
        direction = numpy.where(near[:, None], found.normal, difference / numpy.where(near, 1.0, length)[:, None])
        length = length * pose.scale
        if self.thickness > 0.0:
            residual = length - 0.5 * self.thickness
        else:  # signed distances, which stay smooth if points change sides
            sign = numpy.where(numpy.einsum("ij,ij->i", direction, found.normal) < 0.0, -1.0, 1.0)
            direction, residual = direction * sign[:, None], length * sign
        area = float(numpy.log(surface.info.area * pose.scale**2))
        return Seen(residual, direction @ pose.rotation.T, length, found.point, area, triangles.vertex_id[row],
                    found.barycentric)

    def at(self, x: Reals) -> Seen | None:
        """Returns the points' positions relative to the valve at x, which are computed only once."""
        key = x.tobytes()
        if self.last is None or self.last[0] != key:
            self.last = key, self.look(x)
        return self.last[1]

    def slopes(self, x: Reals, steps: Sequence[tuple[str, float, float]]) -> list[tuple[Reals, float] | None]:
        """Returns the derivatives of the residuals and of log(area) by the parameters. An entry is None if the valve's values
        near x do not fit together.

        A closest point moves with its place on the triangle, because a shift along the surface does not change the distance.

        steps  for each derivative the parameter, a small change of it, and this change in the unit of the derivative
        """
        seen, pose, surface = self.at(x), self.pose(x), self.set_valve(x)
        assert seen is not None and surface is not None
        self.surface_at = None
        area = surface.info.area
        towards = -pose.scale * seen.direction @ pose.rotation
        of_corners = seen.barycentric[:, :, None] * towards[:, None, :]
        near, found, n_directions = self.valve.copy(), [], 0
        for name, change, step in steps:
            value, made = self.valve[name], None
            for sign in (1.0, -1.0):  # if this side is not possible, tries the other one
                try:
                    near.update(**{name: value + sign * change})
                    surface.add_direction(near, self.valve, sign * step)
                except Error:
                    continue
                direction = surface.direction(n_directions)
                n_directions += 1
                made = numpy.einsum("ijk,ijk->i", of_corners, direction.rates[seen.corners]), direction.area_rate / area
                break
            near.update(**{name: value})
            found.append(made)
        return found

    def jacobian(self, x: Reals) -> tuple[Reals, Reals]:
        """Returns the derivatives of the residuals and of log(area)."""
        seen = self.at(x)
        assert seen is not None
        result, area = numpy.zeros((len(self.points), self.n)), numpy.zeros(self.n)
        pose = self.pose(x)
        steps = numpy.where(x[: len(self.names)] < 0.5, _STEP, -_STEP)
        changes = steps * (self.bounds[:, 1] - self.bounds[:, 0])
        for i, found in enumerate(self.slopes(x, list(zip(self.names, changes.tolist(), steps.tolist())))):
            if found is not None:
                result[:, i], area[i] = found
        at, turned = len(self.names), pose.scale * seen.local @ pose.rotation.T
        vector = self.motion(x)[0]
        for move in self.moves:
            if move == "translation":
                result[:, at : at + 3] = -seen.direction * self.size
            elif move == "rotation":
                for k, step in enumerate(1e-6 * numpy.eye(3)):
                    change = (matrix_of(vector + step) - matrix_of(vector - step)) / 2e-6 @ matrix_of(vector).T
                    result[:, at + k] = -numpy.einsum("ij,ij->i", seen.direction, turned @ change.T)
            else:
                result[:, at] = -numpy.einsum("ij,ij->i", seen.direction, turned)
                area[at] = 2.0
            at += _N_UNKNOWNS[move]
        return result, area

    def fixed_jacobian(self, x: Reals) -> tuple[Reals, Reals]:
        """Returns the derivatives of the residuals and of log(area) by the fixed sizes. Each derivative is for a change of a
        length or ratio by its whole value, or of an angle by a radian."""
        self.set_valve(x)
        steps = []
        for name, parameter in self.valve.parameters.items():
            if name in self.names or parameter.n_values != 1 or self.valve[name] == 0.0 or not is_fixed_size(self.valve, name):
                continue
            whole = numpy.degrees(1.0) if parameter.unit == "degree" else self.valve[name]
            steps.append((name, _STEP * whole, _STEP))
        found = [slopes for slopes in self.slopes(x, steps) if slopes is not None]
        columns, areas = [residuals for residuals, _ in found], [area for _, area in found]
        return numpy.array(columns).T.reshape(len(self.points), -1), numpy.array(areas)

    def cost(self, x: Reals, loss: Loss) -> float:
        """Returns the negative logarithm of the likelihood, up to a constant."""
        seen = self.at(x)
        if seen is None:
            return numpy.inf
        return float(self.weights @ loss.value(seen.residual)) + loss.area * float(self.weights.sum()) * seen.log_area

    def normal_equations(self, x: Reals, loss: Loss) -> tuple[Reals, Reals]:
        """Returns the gradient of the cost and the matrix of its Gauss-Newton model."""
        seen = self.at(x)
        assert seen is not None
        jacobian, area = self.jacobian(x)
        weighted = (self.weights * loss.weight(seen.residual))[:, None] * jacobian
        n_area = loss.area * float(self.weights.sum())
        # The Gauss-Newton matrix of the area's term. The matrix is that of a quarter of the area's term, because this gives the
        # right uncertainty of edges.
        return weighted.T @ seen.residual + n_area * area, jacobian.T @ weighted + 0.125 * n_area * numpy.outer(area, area)

    def solve(self, x: Reals, loss: Loss, n_steps: int, change: float, held: int | None = None) -> Reals:
        """Minimizes the cost from x by Levenberg and Marquardt's steps, until the cost changes by less than `change` (of a
        likelihood's logarithm). Unknowns that are held do not move."""
        damping, cost = 1e-3, self.cost(x, loss)
        for _ in range(n_steps):
            if self.at(x) is None:
                return x
            gradient, matrix = self.normal_equations(x, loss)
            free = ~(((x <= self.low) & (gradient > 0.0)) | ((x >= self.high) & (gradient < 0.0)))
            if held is not None:
                free[held] = False
            diagonal = numpy.diag(matrix)[free]
            gain, done = 0.0, True
            for _ in range(8):
                extra = damping * diagonal + 1e-9 * max(float(diagonal.max(initial=0.0)), 1e-300)
                step = numpy.zeros(self.n)
                step[free] = -numpy.linalg.solve(matrix[numpy.ix_(free, free)] + numpy.diag(extra), gradient[free])
                length = numpy.abs(step).max()
                trial = numpy.clip(x + step * min(1.0, 0.3 / max(length, 1e-300)), self.low, self.high)
                kept = self.last
                new = self.cost(trial, loss)
                if new < cost:
                    gain, done = cost - new, length < 1e-7
                    x, cost, damping = trial, new, max(0.2 * damping, 1e-7)
                    break
                self.last = kept
                damping = max(damping, 1e-4) * 8.0
            if done or gain < change:
                break
        return x

    def mixture(self, x: Reals, start: Mixture | None = None) -> Mixture:
        """Returns the noise and the share of outliers that make the residuals most likely (expectation and maximization)."""
        seen = self.at(x)
        assert seen is not None
        r, total = seen.residual, float(self.weights.sum())
        least = max(self.least_noise, 1e-4 * self.size)
        found = start or Mixture(max(1.4826 * weighted_median(numpy.abs(r), self.weights), least), 0.1, 0.25 * self.size)
        for _ in range(40):
            inlier = self.weights * found.inlier(r)
            n_in = float(inlier.sum())
            noise = max(float(numpy.sqrt(inlier @ r**2 / max(n_in, 1e-300))), least)
            found, before = Mixture(noise, float(numpy.clip(1.0 - n_in / total, 0.002, 0.6)), found.reach), found
            if abs(found.noise - before.noise) < 1e-4 * noise:
                break
        return found

    def refine(self, x: Reals, n_rounds: int, change: float) -> tuple[Reals, Mixture]:
        """Minimizes again with the noise and the share of outliers at the end of each round."""
        found = self.mixture(x)
        for _ in range(n_rounds):
            before, x = found, self.solve(x, found.loss(self.whole), 30, change)
            found = self.mixture(x)
            if abs(found.noise - before.noise) < 0.01 * before.noise:
                break
        return x, found

    def best_pose(self, x: Reals, rotations: Reals, middle: Reals | None,
                  random: numpy.random.Generator | None) -> tuple[float, Pose] | None:
        """Rotates the base by each rotation, and returns the mean loss and the pose that is closest to the points. Returns None
        if the values do not fit together.

        middle  a position for the middle of the surface; None keeps the translation
        random  if given, and if the points do not cover the whole valve, the middle is a position for random points of the
                surface, and any of the three closest poses is returned
        """
        surface = self.set_valve(x)
        if surface is None:
            return None
        areas = vertex_areas(surface.vertices, surface.triangles.vertex_id)
        center = numpy.array([weighted_median(column, areas) for column in surface.vertices.T])
        vertices = surface.vertices
        few = self.points[:: max(1, len(self.points) // 70)]
        poses, local = [], []
        anywhere = random if not self.whole else None
        for rotation in rotations:
            turned = rotation @ self.base.rotation
            if anywhere is not None:
                center = vertices[anywhere.choice(len(areas), p=areas / areas.sum())]
            move = self.base.move if middle is None else middle - self.base.scale * turned @ center
            poses.append(Pose(turned, move, self.base.scale))
            local.append((few - move) @ turned / self.base.scale)
        found = surface.closest_points(numpy.concatenate(local), point=False, normal=False, triangle_id=False, leaflet_id=False,
                                       n_threads=1)
        assert found.distance is not None
        squares = (found.distance.reshape(len(poses), -1) * self.base.scale / (0.05 * self.size)) ** 2
        losses = numpy.log1p(squares).mean(axis=1)
        closest = numpy.argsort(losses)[:3]
        chosen = closest[0] if anywhere is None else anywhere.choice(closest)
        return float(losses[chosen]), poses[chosen]


def start_pose(given: dict[str, Any]) -> Pose:
    """Returns the pose of a dict of scale, rotation_axis, rotation_angle and translation."""
    axis, angle = numpy.asarray(given["rotation_axis"], float), numpy.radians(given["rotation_angle"])
    rotation = matrix_of(axis / numpy.linalg.norm(axis) * angle) if angle else numpy.eye(3)
    return Pose(rotation, numpy.asarray(given["translation"], float), float(given["scale"]))
