# SPDX-License-Identifier: Apache-2.0
"""The least squares behind riis.fit: residuals, their derivatives, and the search from one start."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy
from numpy.typing import NDArray

from riis._errors import Error
from riis._riis import Surface, Valve

Reals = NDArray[numpy.float64]

# Triangles lie within this distance of the smooth valve, as a fraction of the valve's size.
FINE, ROUGH = 5e-4, 2e-3
# The step of finite differences, as a fraction of a parameter's bounds. With a smaller step, changes of the triangulation would
# disturb the difference.
_STEP = 2e-3
# The residuals of values that do not fit together, in units of the valve's size. They are far larger than any distance to a valve
# near the points.
_CLASH = 10.0
# Threads are used for more points than this. A fit makes many small surfaces, each in a few milliseconds. For these, threads cost
# more than they gain.
_MANY = 20_000
_N_UNKNOWNS = {"rotation": 3, "translation": 3, "scale": 1}


def matrix_of(vector: Reals) -> Reals:
    """Returns the rotation for a vector, whose direction is the axis and whose length is the angle in radians (Rodrigues)."""
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
    """Returns the value below which half of the weight lies."""
    order = numpy.argsort(values)
    total = numpy.cumsum(weights[order])
    return float(values[order][numpy.searchsorted(total, 0.5 * total[-1])])


def vertex_areas(vertices: Reals, triangles: NDArray[numpy.int64]) -> Reals:
    """Returns a third of the area of the triangles around each vertex."""
    a, b, c = (vertices[triangles[:, k]] for k in range(3))
    third = numpy.linalg.norm(numpy.cross(b - a, c - a), axis=1) / 6.0
    return numpy.asarray(numpy.bincount(triangles.ravel(), numpy.repeat(third, 3), len(vertices)), numpy.float64)


@dataclass(frozen=True)
class Pose:
    """The placement x -> scale * rotation @ x + move."""

    rotation: Reals
    move: Reals
    scale: float


class Seen(NamedTuple):
    """The points' positions relative to a valve. The directions keep signed distances smooth if points change sides."""

    difference: Reals  # (n, 3), from the closest points
    direction: Reals  # (n, 3), unit vectors on the side of the normals
    distance: Reals  # (n,), signed, along the directions
    local: Reals  # (n, 3), the closest points in the valve's frame
    log_area: float


class Problem:
    """The unknowns x are the parameters as fractions of their bounds, then a rotation vector, a translation in units of the
    valve's size, and the scale's logarithm.

    The last three start at 0 and are relative to the pose with which a search begins.
    """

    def __init__(self, points: Reals, weights: Reals, valve: Valve, names: list[str], bounds: Reals, moves: list[str],
                 size: float, whole: bool, tolerance: float) -> None:
        self.points, self.weights, self.root_weights = points, weights, numpy.sqrt(weights)
        self.valve, self.names, self.bounds, self.moves, self.size, self.whole = valve, names, bounds, moves, size, whole
        self.tolerance = tolerance
        self.unknowns = list(names)
        for move in moves:
            self.unknowns += [move] * _N_UNKNOWNS[move]
        self.n = len(self.unknowns)
        self.base = Pose(numpy.eye(3), numpy.zeros(3), 1.0)
        self.noise = 0.0  # noise of the points, for the residual of the area
        self.log_area = 0.0  # log_area at the beginning of a search
        self.surface: Surface | None = None
        self.last: tuple[bytes, Seen | None] | None = None

    def begin(self, base: Pose) -> None:
        """Sets the pose to which placements are relative."""
        self.base, self.last = base, None

    def values(self, x: Reals) -> Reals:
        """Returns the parameters."""
        return self.bounds[:, 0] + x[: len(self.names)] * (self.bounds[:, 1] - self.bounds[:, 0])

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
        """Gives the valve and its surface the parameters of x. Returns None if these do not fit together."""
        try:
            self.valve.update(**dict(zip(self.names, self.values(x).tolist())))
            if self.surface is None:
                scale = self.base.scale
                self.surface = Surface(self.valve, half_thickness=self.size / scale, tolerance=self.tolerance, n_threads=1)
            else:
                self.surface.update(self.valve)
        except Error:
            return None
        return self.surface

    def look(self, x: Reals) -> tuple[Reals, Reals, Reals, float] | None:
        """Returns points minus closest points, normals, closest points in the valve's frame, and the logarithm of the area."""
        surface, pose = self.set_valve(x), self.pose(x)
        if surface is None:
            return None
        local = numpy.ascontiguousarray((self.points - pose.move) @ pose.rotation / pose.scale)
        n_threads = 0 if len(local) >= _MANY else 1
        found = surface.closest_points(local, triangle_id=False, leaflet_id=False, n_threads=n_threads)
        assert found.point is not None and found.normal is not None
        area = float(numpy.log(surface.info.area * pose.scale**2)) if self.whole else 0.0
        return pose.scale * (local - found.point) @ pose.rotation.T, found.normal @ pose.rotation.T, found.point, area

    def at(self, x: Reals) -> Seen | None:
        """Returns the points' positions relative to the valve at x, computed only once."""
        key = x.tobytes()
        if self.last is None or self.last[0] != key:
            found, seen = self.look(x), None
            if found is not None:
                difference, normal, local, area = found
                length = numpy.linalg.norm(difference, axis=1)
                near = length < 1e-9 * self.size
                direction = numpy.where(near[:, None], normal, difference / numpy.where(near, 1.0, length)[:, None])
                sign = numpy.where(numpy.einsum("ij,ij->i", direction, normal) < 0.0, -1.0, 1.0)
                seen = Seen(difference, direction * sign[:, None], length * sign, local, area)
            self.last = key, seen
        return self.last[1]

    # The last residual concerns the area. If points lie evenly over the whole valve, each has the probability density 1 / area.
    # So the logarithm of their likelihood contains the term -n log(area). Half the sum of squares is the rest of the likelihood,
    # times noise^2. It is biased near an edge: noise moves points beyond the edge, and these pull it outwards by n noise^2 / (4
    # area) per length. A quarter of the area's term pulls the edge inwards by the same amount, so edges stay where they are. Half
    # the square of this residual is n noise^2 / 4 (log(area) + constant). The constant keeps the root real.
    _CONSTANT = 4.0

    def _area_factor(self) -> float:
        return float(numpy.sqrt(0.5 * self.weights.sum())) * self.noise if self.whole else 0.0

    def _area_root(self, log_area: float) -> float:
        return float(numpy.sqrt(max(self._CONSTANT + log_area - self.log_area, 1e-3)))

    def residuals(self, x: Reals) -> Reals:
        """Returns the residuals of the points and the residual of the area."""
        seen = self.at(x)
        if seen is None:
            return numpy.full(len(self.points) + 1, _CLASH * self.size)
        return numpy.append(self.root_weights * seen.distance, self._area_factor() * self._area_root(seen.log_area))

    def jacobian(self, x: Reals) -> Reals:
        """Returns the derivatives of the residuals: by differences for parameters, exactly for the placement."""
        seen = self.at(x)
        result = numpy.zeros((len(self.points) + 1, self.n))
        if seen is None:
            return result
        area = self._area_factor() * 0.5 / self._area_root(seen.log_area)
        for i in range(len(self.names)):
            for step in (_STEP, -_STEP) if x[i] < 0.5 else (-_STEP, _STEP):
                moved = x.copy()
                moved[i] += step
                other = self.look(moved)
                if other is not None:  # if this side is not possible, tries the other side
                    along = numpy.einsum("ij,ij->i", other[0], seen.direction)
                    result[:-1, i] = self.root_weights * (along - seen.distance) / step
                    result[-1, i] = area * (other[3] - seen.log_area) / step
                    break
        at, pose = len(self.names), self.pose(x)
        turned = pose.scale * seen.local @ pose.rotation.T
        weighted = self.root_weights[:, None] * seen.direction
        vector = self.motion(x)[0]
        for move in self.moves:
            if move == "translation":
                result[:-1, at : at + 3] = -weighted * self.size
            elif move == "rotation":
                for k, step in enumerate(1e-6 * numpy.eye(3)):
                    change = (matrix_of(vector + step) - matrix_of(vector - step)) / 2e-6 @ matrix_of(vector).T
                    result[:-1, at + k] = -numpy.einsum("ij,ij->i", weighted, turned @ change.T)
            else:
                result[:-1, at] = -numpy.einsum("ij,ij->i", weighted, turned)
                result[-1, at] = 2.0 * area
            at += _N_UNKNOWNS[move]
        return result

    def scatter(self, x: Reals) -> float:
        """Returns the standard deviation of the normal noise that would have the same median of distances. Outliers hardly
        change the median."""
        seen = self.at(x)
        assert seen is not None
        return max(1.4826 * weighted_median(numpy.abs(seen.distance), self.weights), 1e-4 * self.size)

    def loss(self, x: Reals, width: float) -> float:
        """Returns the loss of the points' residuals for a given width."""
        return float(numpy.log1p((self.residuals(x)[:-1] / width) ** 2).sum())

    def merit(self, x: Reals, noise: float) -> float:
        """Returns the cost that solve minimizes, for a given noise."""
        seen, width = self.at(x), 3.0 * noise
        if seen is None:
            return numpy.inf
        return width**2 * self.loss(x, width) + 0.5 * float(self.weights.sum()) * noise**2 * seen.log_area

    def solve(self, x: Reals, width: float, n_steps: int, change: float) -> Reals:
        """Minimizes from x until x or the cost changes by less than `change`. Residuals beyond the width lose weight."""
        from scipy.optimize import least_squares

        seen = self.at(x)
        assert seen is not None
        self.log_area = seen.log_area

        def loss(z: Reals) -> Reals:
            rho = numpy.array([numpy.log1p(z), 1.0 / (1.0 + z), -1.0 / (1.0 + z) ** 2])
            rho[:, -1] = z[-1], 1.0, 0.0
            return rho

        low, high = numpy.full(self.n, -numpy.inf), numpy.full(self.n, numpy.inf)
        low[: len(self.names)], high[: len(self.names)] = 0.0, 1.0
        result = least_squares(
            self.residuals, x, self.jacobian, bounds=(low, high), loss=loss, f_scale=width, max_nfev=n_steps, ftol=change,
            xtol=change, gtol=1e-10,
        )
        return numpy.asarray(result.x)

    def refine(self, x: Reals, n_rounds: int) -> Reals:
        """Minimizes again with a width that follows the scatter of the points."""
        for _ in range(n_rounds):
            self.noise = self.scatter(x)
            before, x = x, self.solve(x, 3.0 * self.noise, 60, 1e-6)
            if numpy.abs(x - before).max() < 1e-4:
                break
        self.noise = self.scatter(x)
        return x

    def best_rotation(self, x: Reals, rotations: Reals, middle: Reals | None) -> Pose | None:
        """Turns the base by each rotation, and returns the pose with which the points are closest, or None if the values do not
        fit together.

        middle  the position for the middle of the surface; None keeps the translation
        """
        surface = self.set_valve(x)
        if surface is None:
            return None
        areas = vertex_areas(surface.vertices, surface.triangles.vertex_id)
        center = numpy.array([weighted_median(column, areas) for column in surface.vertices.T])
        few = self.points[:: max(1, len(self.points) // 200)]
        poses, local = [], []
        for rotation in rotations:
            turned = rotation @ self.base.rotation
            move = self.base.move if middle is None else middle - self.base.scale * turned @ center
            poses.append(Pose(turned, move, self.base.scale))
            local.append((few - move) @ turned / self.base.scale)
        found = surface.closest_points(numpy.concatenate(local), point=False, normal=False, triangle_id=False, leaflet_id=False)
        assert found.distance is not None
        squares = (found.distance.reshape(len(poses), -1) * self.base.scale / (0.05 * self.size)) ** 2
        return poses[int(numpy.argmin(numpy.log1p(squares).mean(axis=1)))]


def start_pose(given: dict[str, Any]) -> Pose:
    """Returns the pose of a dict of scale, rotation_axis, rotation_angle and translation."""
    axis, angle = numpy.asarray(given["rotation_axis"], float), numpy.radians(given["rotation_angle"])
    rotation = matrix_of(axis / numpy.linalg.norm(axis) * angle) if angle else numpy.eye(3)
    return Pose(rotation, numpy.asarray(given["translation"], float), float(given["scale"]))
