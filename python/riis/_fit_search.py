# SPDX-License-Identifier: Apache-2.0
"""The starts of riis.fit, the fits that they reach, and the standard errors of the best fit."""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

import numpy
from numpy.typing import NDArray

from riis._errors import InvalidArgumentError
from riis._fit_problem import Mixture, Pose, Problem, Reals, matrix_of, random_rotations, wide_loss

# Each start chooses a good rotation among this many.
_N_ROTATIONS = 150
# A start for a whole valve chooses a good valve among this many with random sizes.
_N_VALVES = 3
# Two fits have the same surface if their areas differ by at most this fraction, and if nine tenths of one surface lie near
# the other. "Near" means within this fraction of the valve's size.
_SAME = 0.02
# If the cost of a rough fit for each point exceeds the least by this, the fit is not refined.
_HOPELESS = 0.15
# The largest number of fits that are refined.
_N_ENDS = 4
# A fit is a rival if the likelihood ratio leaves it possible. Twice the difference of the logarithms is then below this number,
# the square of three standard errors.
RIVAL = 9.0
# An unknown is undetermined if its standard error exceeds this fraction of a reference: the width of its bounds, a radian, the
# valve's size, or the scale.
UNDETERMINED = 0.1
# To find correlated residuals, the valve is divided into this many parts.
_N_PARTS = 40
# For an unknown, the scatter of all parts counts as this number of parts that determine the unknown.
_N_USUAL = 10.0
# Fixed sizes differ from the patient's by at most about this fraction of a length, or this number of radians.
_FIXED_SPREAD = 0.1
# The difference of a fixed size counts if the logarithm of the ratio of likelihoods is at least this.
_LEAST_EVIDENCE = 4.0
# The number of simulated points that show how strongly fixed sizes seem wrong by chance.
_N_SIMULATED = 8000
# If the cost hardly rises at two standard errors, the profile looks this many times as far before it accepts a larger error.
_FARTHER = 2.5
# A fit with other values counts as better if it gains this much. The gain is twice the logarithm of a ratio of likelihoods.
_LEAST_GAIN = 0.1


@dataclass
class End:
    """A fit that the search from one or more starts has reached."""

    cost: float
    pose: Pose
    x: Reals  # relative to the pose
    probes: Reals  # points of the surface
    log_area: float
    n_starts: int  # starts that reached this fit, or a fit that turns take to this fit
    orbit: int  # turns take fits with the same number to each other


class Judged(NamedTuple):
    """The standard errors of the best fit."""

    errors: Reals  # standard errors of the unknowns
    influence: Reals  # how far a change of an unknown by its whole range moves the points' distances (root mean square)
    singular_values: Reals
    misfit: float  # the scatter of parts of the valve, divided by the scatter that independent points would have
    most_misfit: float  # a misfit above this cannot be chance
    better: Reals | None  # unknowns at which the profile found a lower cost


def probes_of(problem: Problem, x: Reals, random: numpy.random.Generator, n: int = 150) -> Reals:
    """Returns n points that are spread evenly over the surface at x."""
    surface, pose = problem.set_valve(x), problem.pose(x)
    assert surface is not None
    triangles, vertices = surface.triangles.vertex_id, surface.vertices
    a, b, c = (vertices[triangles[:, k]] for k in range(3))
    area = numpy.linalg.norm(numpy.cross(b - a, c - a), axis=1)
    chosen = random.choice(len(area), n, p=area / area.sum())
    shares = random.dirichlet((1.0, 1.0, 1.0), n)
    local = shares[:, :1] * a[chosen] + shares[:, 1:2] * b[chosen] + shares[:, 2:] * c[chosen]
    return numpy.asarray(pose.scale * local @ pose.rotation.T + pose.move)


def simulated(problem: Problem, x: Reals, noise: float, n: int, random: numpy.random.Generator) -> Reals:
    """Returns at most n points as a whole valve at x would give them, with normal noise. The points are spread evenly over the
    surface. If there is a thickness, the points lie on both faces, and less densely near the rims."""
    if problem.thickness == 0.0:
        points = probes_of(problem, x, random, n)
    else:  # points near the surface move to its faces, and around its rims
        away = random.normal(size=(2 * n, 3))
        length = problem.thickness * random.uniform(size=2 * n) ** (1.0 / 3.0)
        points = probes_of(problem, x, random, 2 * n) + away * (length / numpy.linalg.norm(away, axis=1))[:, None]
        seen = problem.with_points(points).at(x)
        assert seen is not None
        points = points - seen.residual[:, None] * seen.direction
        seen = problem.with_points(points).at(x)
        assert seen is not None
        points = points[numpy.abs(seen.residual) < 0.01 * problem.thickness][:n]  # the others are nearer to another leaflet
    return numpy.asarray(points + random.normal(0.0, noise, points.shape))


def likeliest_spread(pull: Reals, response: Reals, covariance: Reals, only_possible: bool) -> tuple[float, Reals, Reals]:
    """Finds the likeliest variance of fixed sizes that seem wrong, the same variance for all sizes. Returns how much likelier
    this variance is than no variance (the logarithm of the ratio), and the expectation and the covariance of the sizes.

    response       the derivatives of the pull by the sizes
    covariance     of the pull if the sizes have no variance
    only_possible  leaves out directions in which the pull needs more than three standard deviations, each of 1
    """
    # A pull of less than 1e-3 says nothing about sizes with a spread of 1. Rounding errors therefore do not count.
    chances, axes = numpy.linalg.eigh(covariance)
    white = (axes / numpy.sqrt(chances.clip(0.0) + 1e-6)).T
    left, gains, right = numpy.linalg.svd(white @ response)
    scores, values = left.T @ white @ pull, gains**2
    if only_possible:
        possible = scores**2 <= 9.0 * (1.0 + values)
        scores, gains, values, right = scores[possible], gains[possible], values[possible], right[possible]
    tried = numpy.logspace(-4.0, 0.0, 41)[:, None]
    evidence = 0.5 * (tried * values * scores**2 / (1.0 + tried * values) - numpy.log1p(tried * values)).sum(axis=1)
    best = tried[numpy.argmax(evidence)]
    shrunk = best / (1.0 + best * values)
    return float(evidence.max()), right.T @ (shrunk * gains * scores), (right.T * shrunk) @ right


def is_same(problem: Problem, x: Reals, log_area: float, end: End) -> bool:
    if abs(end.log_area - log_area) > _SAME:
        return False
    surface, pose = problem.set_valve(x), problem.pose(x)
    assert surface is not None
    local = numpy.ascontiguousarray((end.probes - pose.move) @ pose.rotation / pose.scale)
    found = surface.closest_points(local, point=False, normal=False, triangle_id=False, leaflet_id=False, n_threads=1)
    assert found.distance is not None
    return float(numpy.percentile(found.distance, 90.0)) * pose.scale < _SAME * problem.size


def _add(problem: Problem, x: Reals, cost: float, ends: list[End], orbit: int | None, random: numpy.random.Generator) -> None:
    """Adds the fit x to the fits, or counts it with the fit that has the same surface. The fit x came from a start, or from a
    rotation of a fit of an orbit."""
    seen = problem.at(x)
    if seen is None:
        return
    same = next((end for end in ends if is_same(problem, x, seen.log_area, end)), None)
    if same is None:
        number = 1 + max((end.orbit for end in ends), default=0)
        same = End(numpy.inf, problem.base, x, numpy.zeros((0, 3)), 0.0, 0, number if orbit is None else orbit)
        ends.append(same)
    if orbit is None:
        same.n_starts += 1
    else:
        for end in ends:
            end.orbit = orbit if end.orbit == same.orbit else end.orbit
    if cost < same.cost:
        same.cost, same.pose, same.probes, same.log_area = cost, problem.pose(x), probes_of(problem, x, random), seen.log_area
        same.x = x.copy()
        same.x[len(problem.names):] = 0.0
        ends.sort(key=lambda end: end.cost)


def search(problem: Problem, pose: Pose, given: Reals, middle: Reals | None, any_rotation: bool, n_least: int, n_most: int,
           random: numpy.random.Generator) -> tuple[list[End], int]:
    """Minimizes roughly from one start after the other, until two starts have reached the best fit. Returns the fits, the best
    first, and the number of starts."""
    n_names = len(problem.names)
    wide = wide_loss(0.05 * problem.size)
    ends: list[End] = []
    n_done = 0
    turned: set[int] = set()  # orbits
    least: list[float] = []  # cost with the wide loss

    def go_down(base: Pose, x: Reals, orbit: int | None = None) -> None:
        problem.begin(base)
        x = problem.solve(x, wide, 30, 0.2)
        cost = problem.cost(x, wide)
        least.append(min([cost, *least[-1:]]))
        if cost > least[-1] + _HOPELESS * problem.weights.sum():
            return
        x, mixture = problem.refine(problem.rebased(x), 2, 0.1)
        _add(problem, x, problem.cost(x, mixture.loss(problem.whole)), ends, orbit, random)

    def turn() -> None:
        """Rotates the best fit by one cusp, and exchanges front and back, because a rotated valve looks similar."""
        first, orbit = ends[0], ends[0].orbit
        angles = (90.0, 180.0, 270.0) if problem.valve.kind == "quadricuspid" else (120.0, 240.0, 180.0)
        for angle in numpy.radians(angles):
            rotation = first.pose.rotation @ matrix_of(numpy.array([0.0, 0.0, angle]))
            go_down(Pose(rotation, first.pose.move, first.pose.scale), first.x, orbit)
        turned.add(orbit)

    def n_agreeing(one: End) -> int:
        if not problem.whole:  # a part may fit several cusps, and each needs its own starts
            return one.n_starts
        return sum(end.n_starts for end in ends if end.orbit == one.orbit)

    def begin() -> tuple[Pose, Reals] | None:
        """Returns a random start. For a whole valve the closest of a few valves is chosen, because a start with sizes far from
        the true sizes leads to a wrong fit."""
        best = None
        for _ in range(_N_VALVES if problem.whole else 1):
            x, rotations = given.copy(), numpy.eye(3)[None]
            x[:n_names] = problem.at_random(random)
            if any_rotation:
                rotations = random_rotations(random, _N_ROTATIONS)
            elif middle is not None and not problem.whole:
                rotations = numpy.repeat(rotations, _N_ROTATIONS // 5, axis=0)  # each one with several translations
            problem.begin(pose)
            found = problem.best_pose(x, rotations, middle, random)
            if found is not None and (best is None or found[0] < best[0]):
                best = found[0], found[1], x
        return None if best is None else best[1:]

    for number in range(n_most):
        if number == 0:
            problem.begin(pose)
            found = problem.best_pose(given, numpy.eye(3)[None], middle, None)
            start = None if found is None else (found[1], given.copy())
        else:
            start = begin()
        n_done += 1
        if start is not None:  # None if the values do not fit together
            go_down(*start)
        if n_done >= n_least and ends:
            if any_rotation and n_most > 1 and ends[0].orbit not in turned:
                turn()
            if n_agreeing(ends[0]) >= 2:
                break
    if not ends:
        raise InvalidArgumentError("valve: no start has a surface; its values clash")
    for end, count in [(end, n_agreeing(end)) for end in ends]:
        end.n_starts = count
    return ends[:_N_ENDS], n_done


def _parts(points: Reals, weights: Reals, n_parts: int) -> NDArray[numpy.int64]:
    """Divides points into parts, and returns the part of each point. Each part surrounds the point that is farthest from the
    middles of the earlier parts."""
    first = int(numpy.argmax(weights))
    nearest, part = numpy.full(len(points), numpy.inf), numpy.zeros(len(points), numpy.int64)
    for k in range(n_parts):
        length = ((points - points[first]) ** 2).sum(axis=1)
        part[length < nearest] = k
        nearest = numpy.minimum(nearest, length)
        first = int(numpy.argmax(numpy.where(weights > 0.0, nearest, -1.0)))
    return part


@dataclass
class Judge:
    """Computes the standard errors at the minimum x of a problem."""

    problem: Problem
    x: Reals
    mixture: Mixture
    noise: float  # the noise that the caller states, or 0

    def judge(self) -> Judged:
        problem, mixture = self.problem, self.mixture
        seen = problem.at(self.x)
        assert seen is not None
        loss = mixture.loss(problem.whole)
        jacobian, area = problem.jacobian(self.x)
        inlier = problem.weights * mixture.inlier(seen.residual)
        n_points = inlier.sum() ** 2 / max((inlier**2).sum(), 1e-300)
        share = n_points / inlier.sum()  # the number of independent points in a unit of weight
        rows = numpy.vstack([jacobian * numpy.sqrt(inlier)[:, None], numpy.sqrt(
            0.125 * loss.area * problem.weights.sum()) * mixture.noise * area])
        _, s, v = numpy.linalg.svd(rows, full_matrices=False)
        blind = (v[s <= max(1e-6 * s.max(), 1e-12 * problem.size)] ** 2).sum(axis=0) > 1e-6
        surface, pose = problem.set_valve(self.x), problem.pose(self.x)
        assert surface is not None
        # The scatter is at least the stated noise, and at least the error of the triangles.
        scatter = max(mixture.noise, self.noise, pose.scale * surface.info.error_bound)
        n_spare = n_points - problem.n
        factor = n_points / (n_spare - 2.0) if n_spare > 3.0 else n_points  # the variance of Student's distribution
        precision = rows.T @ rows * share / scatter**2 + numpy.eye(problem.n)  # the data determine each unknown to within its
                                                                               # range
        covariance = numpy.linalg.inv(precision)
        # If residuals are alike within parts of the valve, the points are not independent and count as fewer.
        n_parts = int(min(_N_PARTS, n_points / 8.0))
        misfit, most_misfit = 1.0, numpy.inf
        variances = numpy.diag(covariance) * factor
        if n_parts > problem.n + 2:
            part = _parts(seen.local, inlier, n_parts)
            forces = numpy.zeros((n_parts, problem.n))
            numpy.add.at(forces, part, (inlier * seen.residual)[:, None] * jacobian * share / scatter**2)
            mean = numpy.bincount(part, inlier * seen.residual, n_parts)
            alone = numpy.bincount(part, inlier**2, n_parts)
            most_misfit = max(2.0, 1.0 + 5.0 * (2.0 / (n_parts - problem.n)) ** 0.5)
            misfit = float((mean**2).sum() / (alone.sum() * mixture.noise**2)) * n_parts / (n_parts - problem.n)
            robust = numpy.diag(covariance @ (forces.T @ forces) @ covariance) * n_parts / (n_parts - problem.n)
            # If few parts determine an unknown, its scatter may be large by chance. The scatter of all parts then also counts.
            pieces = numpy.zeros((n_parts, problem.n))
            numpy.add.at(pieces, part, inlier[:, None] * (jacobian @ covariance) ** 2)
            n_pieces = pieces.sum(axis=0) ** 2 / (pieces**2).sum(axis=0).clip(1e-300)
            usual = variances * max(misfit, 1.0)
            variances = numpy.maximum(variances, (_N_USUAL * usual + n_pieces * robust) / (_N_USUAL + n_pieces))
        errors = numpy.where(blind, numpy.inf, numpy.sqrt(variances))
        ratio = numpy.maximum(errors**2 / numpy.diag(covariance), 1.0)
        # The profile takes the errors without those of the fixed sizes. With them, most points would count as outliers.
        errors, better = self._profile(errors, covariance, ratio)
        errors = numpy.sqrt(errors**2 + self._of_fixed(precision, jacobian, area, inlier, share / scatter**2, errors**2))
        influence = numpy.sqrt((rows**2).sum(axis=0) / inlier.sum())
        return Judged(errors, influence, s / problem.size, misfit, most_misfit, better)

    def _of_fixed(self, precision: Reals, jacobian: Reals, free_area: Reals, inlier: Reals, factor: float,
                  variances: Reals) -> Reals:
        """Returns the share of the squared errors that comes from fixed sizes. The share is 0 if other values of the fixed sizes
        do not fit better than chance allows. The share consists of two parts: the shift of the unknowns in a fit with all sizes,
        and the variance that this fit adds.

        variances  the other share of the squared errors
        """
        problem, n, weights = self.problem, self.problem.n, inlier * factor
        seen, (columns, area) = problem.at(self.x), problem.fixed_jacobian(self.x)
        columns, area = columns * _FIXED_SPREAD, area * _FIXED_SPREAD
        assert seen is not None
        if columns.shape[1] == 0:
            return numpy.zeros(n)
        both = numpy.hstack([jacobian, columns])
        n_area = self.mixture.loss(problem.whole).area * problem.weights.sum() * self.mixture.noise**2 * factor
        both_areas = numpy.concatenate([free_area, area])
        full = both.T @ (both * weights[:, None]) + 0.125 * n_area * numpy.outer(both_areas, both_areas)
        full[:n, :n] = precision
        shares = numpy.linalg.solve(precision, full[:n, n:])
        alone = full[n:, n:] - full[n:, :n] @ shares
        # The free unknowns are at rest only up to the precision of the search. A size with almost the same effect as an unknown
        # would be sensitive to this precision.
        apart, of_area = columns - jacobian @ shares, n_area * (area - free_area @ shares)
        pull = -apart.T @ (weights * seen.residual) - of_area

        # For a whole valve, a pull towards far larger differences comes from edges, where the area's term is right only on
        # average.
        evidence, mean, covariance = likeliest_spread(pull, alone, alone, problem.whole)
        found = numpy.asarray((shares @ mean) ** 2 + numpy.einsum("ij,jk,ik->i", shares, covariance, shares))
        becomes = (variances <= UNDETERMINED**2) & (variances + found > UNDETERMINED**2)
        if evidence >= _LEAST_EVIDENCE and problem.whole and becomes[: len(problem.names)].any():
            # A few points near edges pull strongly. Points of a valve with right sizes show which pull is chance.
            points = simulated(problem, self.x, self.mixture.noise, _N_SIMULATED, numpy.random.default_rng(0))
            other = problem.with_points(points)
            there = other.at(self.x)
            assert there is not None
            pulls = (other.jacobian(self.x)[0] @ shares - _FIXED_SPREAD * other.fixed_jacobian(self.x)[0]) * (
                factor * self.mixture.inlier(there.residual) * there.residual)[:, None]
            pull = pull + of_area - problem.weights.sum() * (1.0 - self.mixture.outliers) * pulls.mean(axis=0)
            chance = numpy.cov(pulls.T).reshape(alone.shape) * (inlier**2).sum()
            evidence = likeliest_spread(pull, alone, chance, True)[0]
        return found if evidence >= _LEAST_EVIDENCE else numpy.zeros(n)

    def _profile(self, errors: Reals, covariance: Reals, ratio: Reals) -> tuple[Reals, Reals | None]:
        """Holds each parameter two standard errors away, and minimizes over all other parameters. If the cost rises less than the
        standard error predicts, the error is widened."""
        problem, loss = self.problem, self.mixture.loss(self.problem.whole)
        best = problem.cost(self.x, loss)
        errors, better, least = errors.copy(), None, -_LEAST_GAIN
        for i in range(len(problem.names)):
            if not 3e-3 < errors[i] < UNDETERMINED:
                continue
            linear = errors[i]
            for sign in (1.0, -1.0):
                error = linear
                for n_left in (3, 2, 1, 0):
                    target = float(numpy.clip(self.x[i] + sign * 2.0 * error, 0.0, 1.0))
                    moved = abs(target - self.x[i])
                    if moved < 0.5 * linear:
                        break
                    x = self.x + covariance[:, i] / covariance[i, i] * (target - self.x[i])
                    x = numpy.clip(x, problem.low, problem.high)
                    x[i] = target
                    if problem.at(x) is None:
                        x = self.x.copy()
                        x[i] = target
                    x = problem.solve(x, loss, 8, 0.1, held=i)
                    rise = 2.0 * (problem.cost(x, loss) - best)
                    if rise < least:
                        least, better = rise, x
                    wider = moved / numpy.sqrt(max(rise / ratio[i], 0.04))
                    if wider > _FARTHER * error and _FARTHER * error < UNDETERMINED and n_left and target not in (0.0, 1.0):
                        error *= _FARTHER  # the cost is flat here, but may rise farther out
                        continue
                    errors[i] = max(errors[i], min(wider, 1.0))
                    if wider < 1.3 * error or wider > UNDETERMINED or target in (0.0, 1.0):
                        break
                    error = wider
        return errors, better


def covered(problem: Problem, x: Reals, inlier: Reals, random: numpy.random.Generator) -> float:
    """Returns the share of the surface's area with points nearby, compared with the usual gaps between points."""
    near = problem.points[inlier > 0.5]
    if len(near) < 6:
        return 0.0
    near = random.permutation(near)[:2000]
    probes = numpy.vstack([probes_of(problem, x, random) for _ in range(2)])

    def squares(a: Reals, b: Reals) -> Reals:
        return numpy.asarray(((a**2).sum(axis=1)[:, None] + (b**2).sum(axis=1) - 2.0 * a @ b.T).clip(0.0))

    center = near.mean(axis=0)
    few = near[:200] - center
    fourth = numpy.sqrt(numpy.partition(squares(few, near - center), 4, axis=1)[:, 4])
    gap = 2.0 * float(numpy.median(fourth)) + 0.5 * problem.thickness
    least = numpy.sqrt(squares(probes - center, near - center).min(axis=1))
    return float((least < gap).mean())

