# SPDX-License-Identifier: Apache-2.0
"""Finds the opening and the place of a valve from noisy velocities. `python inverse.py [CASES]` prints the table of a study.

The flow is a Stokes flow in a plane channel: the section y = 0 of a bileaflet valve in a tube. The valve is the term K u of the
momentum equation, with K from riis. Lengths are in cm, velocities in multiples of the largest velocity at the inlet, and the
viscosity is 1.
"""

from __future__ import annotations

import sys
import time
from dataclasses import dataclass
from typing import NamedTuple

import numpy
import scipy.sparse
import scipy.sparse.linalg

import riis

RADIUS = 1.1  # half of the channel's width, and the inner radius of the valve's housing
INLET, OUTLET = -2.2, 2.2  # z of the channel's ends
HALF_THICKNESS, R = 0.2, 20.0
PLANES = (-0.75, 1.1, 1.3, 1.6)  # z of the planes with measured velocities
N_ACROSS = 20  # measured places in a plane
LIMITS = numpy.array([[0.02, 0.98], [-0.4, 0.4]])  # of the unknowns: the opening, and the shift along the axis
START = numpy.array([0.5, 0.0])
STEPS = numpy.array([1e-4, 1e-4])  # half the differences between the two states of a direction


def valve_of(opening):
    return riis.Valve("bileaflet", radius=RADIUS, ring_height=0.4, opening=opening)


def placed(shift):
    return {"translation": (0.0, 0.0, shift)}


def second_difference(n, h, ends):
    """Returns the matrix of -d2/dx2 for n values on a grid of step h. Beyond an end, a value is ends[i] times the value at the
    end."""
    matrix = scipy.sparse.diags([-1.0, 2.0, -1.0], [-1, 0, 1], shape=(n, n)).tolil()
    matrix[0, 0] -= ends[0]
    matrix[-1, -1] -= ends[1]
    return matrix.tocsr() / h**2


def difference(n, h):
    """Returns the matrix of the differences between n neighbours, (n - 1, n)."""
    return scipy.sparse.diags([-1.0, 1.0], [0, 1], shape=(n - 1, n)) / h


class Flow(NamedTuple):
    velocity: numpy.ndarray  # of all faces, then the pressures
    factors: scipy.sparse.linalg.SuperLU  # of the flow's matrix


class Channel:
    """A staggered grid: u across the channel at faces x = const, w along it at faces z = const, p in the cells.

    The velocity is 0 at the walls, w is given at the inlet, and p and the shear are 0 at the outlet.
    """

    def __init__(self, n):
        """Makes a grid with n cells across the channel."""
        self.h = h = 2.0 * RADIUS / n
        self.n, self.m = n, m = n, round((OUTLET - INLET) / h)
        identity = scipy.sparse.identity
        # u: n - 1 inner faces across, m cells along; the last index is along. At the inlet, u is 0. At the outlet, du/dz is 0.
        u_terms = (scipy.sparse.kron(second_difference(n - 1, h, (0.0, 0.0)), identity(m))
                   + scipy.sparse.kron(identity(n - 1), second_difference(m, h, (-1.0, 1.0))))
        # w: n cells across, m faces along: all but the inlet's. At the outlet, dw/dz is 0.
        along = second_difference(m, h, (0.0, 1.0)).tolil()
        w_terms = (scipy.sparse.kron(second_difference(n, h, (-1.0, -1.0)), identity(m))
                   + scipy.sparse.kron(identity(n), along.tocsr()))
        # The pressure's gradient is the transposed divergence. At the outlet, the pressure of the half cell outside is 0.
        across = scipy.sparse.kron(difference(n, h), identity(m))
        into = scipy.sparse.vstack([difference(m, h), scipy.sparse.coo_matrix(([-1.0 / h], ([0], [m - 1])), (1, m))])
        gradient = scipy.sparse.vstack([across, scipy.sparse.kron(identity(n), into)])
        self.matrix = scipy.sparse.bmat([[scipy.sparse.block_diag([u_terms, w_terms]), gradient], [gradient.T, None]]).tocsc()
        x, z = -RADIUS + h * numpy.arange(n + 1), INLET + h * numpy.arange(m + 1)
        self.x_mid, self.z_mid = x[:-1] + 0.5 * h, z[:-1] + 0.5 * h
        self.x_face, self.z_face = x[1:-1], z[1:]
        self.n_u, self.n_w = (n - 1) * m, n * m
        # The inlet's profile, averaged over each face, so that all grids have the same flow.
        profile = numpy.diff(x - x**3 / (3.0 * RADIUS**2)) / h
        first = numpy.zeros((n, m))
        first[:, 0] = profile
        self.load = numpy.zeros(self.matrix.shape[0])
        self.load[self.n_u : self.n_u + self.n_w] = first.ravel() / h**2
        self.load[self.n_u + self.n_w :] = -first.ravel() / h  # transposed divergence: -(w_1 - w_0) / h = 0
        faces = [numpy.meshgrid(self.x_face, self.z_mid, indexing="ij"), numpy.meshgrid(self.x_mid, self.z_face, indexing="ij")]
        xz = numpy.concatenate([numpy.column_stack([a.ravel(), b.ravel()]) for a, b in faces])
        self.xyz = numpy.column_stack([xz[:, 0], numpy.zeros(len(xz)), xz[:, 1]])
        self.mesh = riis.Mesh(self.xyz)
        self.seen = self.interpolation()

    def interpolation(self):
        """Returns the matrix from the unknowns to u and w at the measured places, by linear interpolation."""
        x = numpy.linspace(-RADIUS, RADIUS, N_ACROSS + 2)[1:-1]
        rows = []
        for xs, zs, start in ((self.x_face, self.z_mid, 0), (self.x_mid, self.z_face, self.n_u)):
            across = weights(x, xs, 0.0 if start == 0 else -1.0)
            for z in PLANES:
                row = scipy.sparse.kron(across, weights(numpy.array([z]), zs, 1.0))
                shape = (N_ACROSS, self.matrix.shape[0])
                rows.append(scipy.sparse.coo_matrix((row.tocoo().data, (row.tocoo().row, row.tocoo().col + start)), shape))
        return scipy.sparse.vstack(rows).tocsr()

    def solve(self, K):
        """Returns the flow with the resistances K of all faces."""
        resistance = scipy.sparse.diags(numpy.concatenate([K, numpy.zeros(self.n_w)]))
        factors = scipy.sparse.linalg.splu((self.matrix + resistance).tocsc())
        return Flow(factors.solve(self.load), factors)

    def K(self, unknowns):
        """Returns K of all faces."""
        surface = riis.Surface(valve_of(unknowns[0]), half_thickness=HALF_THICKNESS, **placed(unknowns[1]))
        marks = riis.mark(surface, self.mesh, R=R)
        K = numpy.zeros(len(self.xyz))
        K[marks.ids] = marks.K
        return K

    def K_and_derivatives(self, unknowns):
        """Returns K of all faces, and its derivatives by the opening and the shift, (n, 2)."""
        (opening, shift), (d_opening, d_shift) = unknowns, STEPS
        valve = valve_of(opening)
        surface = riis.Surface(valve, half_thickness=HALF_THICKNESS, **placed(shift))
        surface.add_direction(valve_of(opening + d_opening), valve_of(opening - d_opening), 2.0 * d_opening)
        surface.add_direction(valve, valve, 2.0 * d_shift, placement_after=placed(shift + d_shift),
                              placement_before=placed(shift - d_shift))
        marks = riis.mark(surface, self.mesh, fields="distance_gradient", R=R)
        K, derivatives = numpy.zeros(len(self.xyz)), numpy.zeros((len(self.xyz), 2))
        K[marks.ids], derivatives[marks.ids] = marks.K, marks.K_gradient
        return K, derivatives

    def predict(self, unknowns):
        """Returns the velocities at the measured places, and their derivatives by the unknowns.

        If the flow satisfies A U = b, its derivative solves A dU = -dK U, with the same factors of A.
        """
        K, derivatives = self.K_and_derivatives(unknowns)
        flow = self.solve(K)
        right = numpy.zeros((len(self.load), 2))
        right[: len(K)] = -derivatives * flow.velocity[: len(K), None]
        return self.seen @ flow.velocity, self.seen @ flow.factors.solve(right)


def weights(at, grid, beyond):
    """Returns the matrix that interpolates values of a grid. The value one spacing beyond an end is `beyond` times the end's
    value, or 0 at the place beyond it."""
    h = grid[1] - grid[0]
    place = (at - grid[0]) / h
    low = numpy.floor(place).astype(int)
    rest = place - low
    result = scipy.sparse.lil_matrix((len(at), len(grid)))
    for row, (k, share) in enumerate(zip(low, rest)):
        for index, weight in ((k, 1.0 - share), (k + 1, share)):
            if 0 <= index < len(grid):
                result[row, index] += weight
            else:
                result[row, min(max(index, 0), len(grid) - 1)] += beyond * weight
    return result


@dataclass
class Estimate:
    unknowns: numpy.ndarray  # the opening and the shift
    covariance: numpy.ndarray  # of their errors by noise and by the grid
    grid_errors: numpy.ndarray  # the part that comes from the grid
    n_solves: int  # factorizations
    history: list  # the unknowns of each step

    @property
    def errors(self):
        """The standard errors."""
        return numpy.sqrt(numpy.diag(self.covariance))


def grid_errors(channel, unknowns, velocity, jacobian):
    """Returns an estimate of the error of the unknowns that the grid causes.

    A grid with 1.5 times as many cells across gives different velocities. Errors fall with the square of the spacing, so an
    infinitely fine grid differs 1 / (1 - 1 / 1.5^2) = 1.8 times as much.
    """
    finer = Channel(3 * channel.n // 2)
    difference = finer.seen @ finer.solve(finer.K(unknowns)).velocity - velocity
    return numpy.linalg.lstsq(jacobian, 1.8 * difference, rcond=None)[0]


def estimate(channel, measured, noise, start=START):
    """Finds the unknowns by Gauss-Newton. A step that makes the misfit larger is halved."""
    unknowns = numpy.array(start, float)
    velocity, jacobian = channel.predict(unknowns)
    misfit, n_solves, history = ((measured - velocity) ** 2).sum(), 1, [unknowns]
    for _ in range(30):
        step = numpy.linalg.lstsq(jacobian, measured - velocity, rcond=None)[0]
        covariance = noise**2 * numpy.linalg.inv(jacobian.T @ jacobian)
        while True:
            trial = numpy.clip(unknowns + step, LIMITS[:, 0], LIMITS[:, 1])
            found = channel.predict(trial)
            n_solves += 1
            new = ((measured - found[0]) ** 2).sum()
            if new <= misfit or numpy.abs(trial - unknowns).max() < 1e-6:
                break
            step *= 0.5
        moved = numpy.abs(trial - unknowns) / numpy.sqrt(numpy.diag(covariance))
        if new <= misfit:
            unknowns, (velocity, jacobian), misfit = trial, found, new
            history.append(unknowns)
        if moved.max() < 0.01:
            break
    by_grid = grid_errors(channel, unknowns, velocity, jacobian)
    covariance = noise**2 * numpy.linalg.inv(jacobian.T @ jacobian) + numpy.outer(by_grid, by_grid)
    return Estimate(unknowns, covariance, by_grid, n_solves + 1, history)


def section(unknowns):
    """Returns the lines of both leaflets in the plane y = 0, each as x and z."""
    surface = riis.Surface(valve_of(unknowns[0]), half_thickness=HALF_THICKNESS, **placed(unknowns[1]))
    lines = []
    for leaflet in (0, 1):
        of_leaflet = surface.triangles.vertex_id[surface.triangles.leaflet_id == leaflet]
        points = surface.vertices[numpy.unique(of_leaflet)]
        points = points[numpy.abs(points[:, 1]) < 1e-9]
        lines.append(points[numpy.argsort(points[:, 0])][:, [0, 2]].T)
    return lines


def truth_of(seed):
    random = numpy.random.default_rng(seed)
    return numpy.array([random.uniform(0.2, 0.9), random.uniform(-0.25, 0.25)]), random


def measure(fine, truth, noise, random):
    """Returns noisy velocities at the measured places, from the finer grid."""
    exact = fine.seen @ fine.solve(fine.K(truth)).velocity
    return exact + random.normal(0.0, noise, exact.shape)


def main(n_cases, noise=0.05, n=32, n_fine=96):
    channel, fine = Channel(n), Channel(n_fine)
    rows, start = [], time.process_time()
    print("| case | opening: true | found | error / std. error | shift: true | found | error / std. error | solves |")
    print("|---" * 8 + "|")
    for seed in range(1, n_cases + 1):
        truth, random = truth_of(seed)
        measured = measure(fine, truth, noise, random)
        found = estimate(channel, measured, noise)
        off = (found.unknowns - truth) / found.errors
        rows.append(off)
        cells = [f"{true:.3f} | {value:.3f} ± {error:.3f} | {share:+.2f}"
                 for true, value, error, share in zip(truth, found.unknowns, found.errors, off)]
        print(f"| {seed} | {' | '.join(cells)} | {found.n_solves} |", flush=True)
    off = numpy.array(rows)
    within = (numpy.abs(off) <= 2.0).sum(axis=0)
    print(f"{n_cases} cases. Within 2 standard errors: {within[0]} openings, {within[1]} shifts, and both in "
          f"{(numpy.abs(off) <= 2.0).all(axis=1).sum()} cases.")
    print(f"errors over standard errors: mean {off.mean(axis=0).round(2)}, rms {numpy.sqrt((off**2).mean(axis=0)).round(2)}; "
          f"{time.process_time() - start:.0f} s of processor time")
    return 0 if within.min() >= 0.9 * n_cases else 1


if __name__ == "__main__":
    given = sys.argv[1:] or ["20"]
    if len(given) > 1 or not given[0].isdecimal() or int(given[0]) == 0:
        sys.exit(f"inverse.py: '{' '.join(given)}' is not a number of cases")
    sys.exit(main(int(given[0])))
