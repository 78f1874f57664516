# SPDX-License-Identifier: Apache-2.0
"""Computes the effective radius of a hole in a plate, and of a disc, in axisymmetric Stokes flow.

Lengths are in radii a. K / mu is (R / mu) delta / eps with R / mu = 1e4 / 3.5e-3 = 2.9e6. R / mu has no unit, so the value for
blood holds at any size. The closed form for the effective radius gives the boundary values. The effective radius is therefore
found by iteration."""

import numpy as np

import exact
import marking
from staggered import Flow, graded

BOX = 6.0  # radii, half the box's length and its radius


def grid_of(eps, per_eps, along, across):
    """Returns the edges of the cells along the axis and along the radius. The plate is `along` cells from a face. The rim is
    `across` cells from a face."""
    h = eps / per_eps
    n, m = round(1.5 * per_eps + 1), round(2.5 * per_eps + 1)
    z = graded(h, ((-n - along) * h, (n - along) * h), (-BOX, BOX), 1.12)
    inner = min(m, int(1 / h - across + 1e-9))  # number of cells of size h between the axis and the rim, at most m
    r = graded(h, (1 - (inner + across) * h, 1 + (m - across) * h), (0, BOX), 1.12)
    return z, r


def effective_radius(library, kind, eps, per_eps, rim, place=(0.0, 0.0), solid=False, R_over_mu=marking.R / marking.MU):
    """Returns a_eff and the number of cells. `kind` is hole or disc. `place` holds the arguments along and across of grid_of. If
    `solid` is true, no flow enters the band."""
    z, r = grid_of(eps, per_eps, *place)
    flow = Flow(z, r, axial=True)
    surface = marking.disc(1.0) if kind == "disc" else marking.plate_with_hole(1.0, BOX + 4 * eps)
    points = np.vstack([flow.u_points(), flow.v_points()])
    if solid:  # K / mu is so large that no flow enters the band
        K = np.where(_in_band(kind, eps, rim, *points.T), 1e12, 0)
    else:
        K = library.K(surface, eps, rim, np.stack([points[:, 1], 0 * points[:, 0], points[:, 0]], 1), R_over_mu)

    def outer(a, r, z):
        # Returns u_z and u_r on the boundary of the box.
        u_r, u_z, _ = exact.disc(a, r, z) if kind == "disc" else exact.hole(a, r, z)
        return (1 - u_z, -u_r) if kind == "disc" else (u_z, u_r)

    def computed(a):
        q = np.zeros(flow.n_u + flow.n_v)
        u, v = q[: flow.n_u].reshape(flow.nx + 1, flow.ny), q[flow.n_u :].reshape(flow.nx, flow.ny + 1)
        for at in (0, -1):
            u[at] = outer(a, flow.yc, np.full(flow.ny, flow.x[at]))[0]
        v[:, -1] = outer(a, np.full(flow.nx, flow.y[-1]), flow.xc)[1]
        # The velocities on the outer face are corrected, so that the net flow into the box is also 0 on the grid.
        area = flow.wc * flow.dy
        excess = area @ (u[-1] - u[0]) + flow.we[-1] * (flow.dx @ v[:, -1])
        v[:, -1] -= excess / (flow.we[-1] * (flow.x[-1] - flow.x[0]))
        edge_u = outer(a, np.full(flow.nx + 1, flow.y[-1]), flow.x)[0]
        edge_v = [outer(a, flow.y, np.full(flow.ny + 1, z))[1] for z in (flow.x[0], flow.x[-1])]
        u, v, p = flow.solve_linear(1.0, K, q, (None, edge_u), edge_v)
        if kind == "disc":
            force = 2 * np.pi * np.sum(K[: flow.n_u].reshape(u.shape) * u * flow.u_volume)
            return force / 16
        # Finds the radius at which the closed form of a hole has the computed drop between the two ends of ring j.
        j = flow.ny // 2
        drop = p[0, j] - p[-1, j]
        ends = np.array([flow.xc[0], flow.xc[-1]])
        low, high = 0.05, 2.0
        for _ in range(60):  # the drop falls as the hole grows
            middle = (low + high) / 2
            ideal = exact.hole(middle, np.full(2, flow.yc[j]), ends)[2]
            low, high = (middle, high) if ideal[0] - ideal[1] > drop else (low, middle)
        return (low + high) / 2

    return consistent(computed), flow.nx * flow.ny


def solid_radius(library, kind, eps, per_eps, rim):
    """Returns a_eff and the number of cells, like effective_radius, for a solid plate with the shape of the band. Plane sides of
    the plate lie on faces of the grid. The library is not called."""
    return effective_radius(library, kind, eps, per_eps, rim, solid=True)


def _in_band(kind, eps, rim, z, r):
    beyond = np.maximum(1 - r if kind == "hole" else r - 1, 0)  # radial distance from the plate's edge, 0 on the plate
    rounding = 1e-9 * eps
    if rim == "cut":
        return (np.abs(z) <= eps + rounding) & (beyond <= rounding)
    return np.hypot(z, beyond) <= eps + rounding


def consistent(computed):
    """Returns the radius a with computed(a) = a. The boundary values depend on a. The secant method converges quickly, because
    computed(a) is nearly linear in a."""
    given = [1.0, computed(1.0)]
    found = [given[1], computed(given[1])]
    for _ in range(6):
        slope = (found[-1] - found[-2]) / (given[-1] - given[-2])
        given.append(given[-1] + (found[-1] - given[-1]) / (1 - slope))
        found.append(computed(given[-1]))
        if abs(found[-1] - given[-1]) < 1e-5:
            return found[-1]
    raise RuntimeError(f"the radius {found[-1]} does not fit the box's {given[-1]}")
