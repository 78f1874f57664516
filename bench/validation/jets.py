# SPDX-License-Identifier: Apache-2.0
"""Plane jets from a slit in a plate across a channel with slip walls: contraction, drop, pressure downstream.

SI units. The slit's half width is B, the flow's speed in the slit U / share of the jet. Viscosity is a model of what mixes the
jet, so it is small by the slit (REYNOLDS) and grows downstream. The walls do not rub, so the balance of momentum holds with any."""

import numpy as np

import exact
import marking
from staggered import Flow, graded

B = 0.008  # m
SPEED = 1.0  # m/s, the mean in the slit
REYNOLDS = 1500.0  # B SPEED / nu by the slit
MIXING = 12.0  # the same far downstream
EDDY = (2.0, 10.0)  # slit half widths downstream between which viscosity grows


def viscosity(x, reynolds, rho):
    share = np.clip((x / B - EDDY[0]) / (EDDY[1] - EDDY[0]), 0, 1)
    return rho * SPEED * B * np.exp((1 - share) * np.log(1 / reynolds) + share * np.log(1 / MIXING))


def grid_of(eps, per_eps, share, shift, length):
    h = eps / per_eps
    n, m = round(1.5 * per_eps + 1), round(2.5 * per_eps + 1)
    x = graded(h, ((-n - shift) * h, (n - shift) * h), (-4 * B / share, length), 1.08, 0.6 * B)
    y = graded(h, (B - (m + shift) * h, B + (m - shift) * h), (0, B / share), 1.08, 0.6 * B)
    return x, y


def jet(library, share, eps, per_eps, rim, shift=0.0, speed=SPEED, reynolds=REYNOLDS, length=None, say=None, start=None):
    """share: of the channel's width that the slit has. Returns a dict of measures."""
    length = length or max(40 * B, 10 * B / share)
    x, y = grid_of(eps, per_eps, share, shift, length)
    flow = Flow(x, y, walls="channel")
    points = np.vstack([flow.u_points(), flow.v_points()])
    K = library.K(marking.plate_with_slit(B, B / share + 4 * eps), eps, rim, np.column_stack([points, np.zeros(len(points))]))
    inlet = speed * share
    q = np.concatenate([np.full(flow.n_u, inlet), np.zeros(flow.n_v)])
    stages = [30.0, 150.0, 600.0, 2000.0]
    stages = [s for s in stages if s < reynolds / 1.5] + [reynolds]
    mu = [np.broadcast_to(viscosity(flow.xc, s, marking.RHO)[:, None], (flow.nx, flow.ny)) for s in stages]
    if start is not None:
        q, mu = start(flow), mu[-1:]
    u, v, p = flow.solve(marking.RHO, mu, K, q, say=say, tolerance=1e-6)
    rho, discharge = marking.RHO, inlet * B / share
    total = p[0, 0] + rho / 2 * inlet**2
    # Dead water: behind the plate, half way between slit and wall
    i = np.searchsorted(flow.xc, 2 * eps + B / 4)
    j = np.searchsorted(flow.yc, (B + B / share) / 2)
    core = u[(flow.x > 0) & (flow.x < 3 * B), 0].max()
    dead = p[i, j]
    return {
        "cells": flow.nx * flow.ny, "core": core, "by_core": discharge / (B * core),
        "by_drop": discharge / (B * np.sqrt(2 * (total - dead) / rho)), "drop": p[0].mean() - p[-1].mean(), "dead": dead,
        "outlet": u[-1], "flow": flow, "u": u, "v": v, "p": p, "K": K, "total": total,
        "vena_drop": p[0].mean() - dead, "inlet": inlet,
    }  # fmt: skip
