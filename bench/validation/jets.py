# SPDX-License-Identifier: Apache-2.0
"""Computes plane jets from a slit in a plate across a channel with slip walls: contraction, drop, and pressure downstream.

Units are SI. The slit's half width is B, and the mean speed in the slit is SPEED. The viscosity is small near the slit
(REYNOLDS). The viscosity grows downstream (MIXING), because it stands for turbulent mixing. Slip walls have no friction, so the
balance of momentum holds with any viscosity."""

import numpy as np

import marking
from staggered import Flow, graded

B = 0.008  # m
SPEED = 1.0  # m/s, the mean in the slit
REYNOLDS = 1500.0  # B SPEED / nu near the slit
MIXING = 12.0  # B SPEED / nu far downstream
EDDY = (2.0, 10.0)  # x / B at which the viscosity begins and ends to grow


def viscosity(x, reynolds, rho):
    share = np.clip((x / B - EDDY[0]) / (EDDY[1] - EDDY[0]), 0, 1)
    return rho * SPEED * B * np.exp((1 - share) * np.log(1 / reynolds) + share * np.log(1 / MIXING))


def grid_of(eps, per_eps, share, shift):
    h = eps / per_eps
    n, m = round(1.2 * per_eps + 2), round(1.2 * per_eps + 2)
    x = graded(h, ((-n - shift) * h, (n - shift) * h), (-4 * B / share, max(40 * B, 10 * B / share)), 1.1, 0.6 * B)
    y = graded(h, (B - (m + shift) * h, B + (m - shift) * h), (0, B / share), 1.1, 0.6 * B)
    return x, y


def jet(library, share, eps, per_eps, rim, shift=0.0, speed=SPEED, reynolds=REYNOLDS, say=None):
    """Computes one jet. Returns a dict of measures. `share` is the slit's width over the channel's width."""
    x, y = grid_of(eps, per_eps, share, shift)
    flow = Flow(x, y, walls="channel")
    points = np.vstack([flow.u_points(), flow.v_points()])
    K = library.K(marking.plate_with_slit(B, B / share + 4 * eps), eps, rim, np.column_stack([points, np.zeros(len(points))]))
    inlet = speed * share
    q = np.concatenate([np.full(flow.n_u, inlet), np.zeros(flow.n_v)])
    stages = [30.0, 150.0, 600.0, 2000.0]
    stages = [s for s in stages if s < reynolds / 1.5] + [reynolds]
    mu = [np.broadcast_to(viscosity(flow.xc, s, marking.RHO)[:, None], (flow.nx, flow.ny)) for s in stages]
    u, v, p = flow.solve(marking.RHO, mu, K, q, say=say)
    rho, discharge = marking.RHO, inlet * B / share
    total = p[0, 0] + rho / 2 * inlet**2
    # The pressure downstream is that of a cell in the dead water behind the plate, half way between slit and wall.
    i = np.searchsorted(flow.xc, 2 * eps + B / 4)
    j = np.searchsorted(flow.yc, (B + B / share) / 2)
    core = u[(flow.x > 0) & (flow.x < 3 * B), 0].max()
    dead = p[i, j]
    # The pictures use the fields of the returned dict.
    return {
        "cells": flow.nx * flow.ny, "core": core, "inlet": inlet, "by_core": discharge / (B * core),
        "by_drop": discharge / (B * np.sqrt(2 * (total - dead) / rho)), "drop": p[0].mean() - p[-1].mean(),
        "vena_drop": p[0].mean() - dead, "uneven": np.ptp(u[-1]) / inlet, "x": flow.xc, "y": flow.yc, "eps": eps,
        "speed": np.hypot((u[1:] + u[:-1]) / 2, (v[:, 1:] + v[:, :-1]) / 2), "u": (u[1:] + u[:-1]) / 2,
        "v": (v[:, 1:] + v[:, :-1]) / 2,
    }  # fmt: skip
