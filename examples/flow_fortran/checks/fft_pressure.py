#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Counts the iterations of conjugate gradients for the pressure of a fractional step with K. The preconditioner is a
solver by cosine transforms, for constant coefficients. The band crosses a duct: a plate, a leaning plate, a cap, and a
leaning plate with a slit through which the flow can pass."""

import numpy as np
from scipy.fft import dctn, idctn

SHAPE, H = (96, 48, 48), 1 / 48
EPS = 1.5 * H


def distance(kind, x, y, z):
    lean = np.abs((x - 1) * np.cos(0.35) + (y - 0.5) * np.sin(0.35)) + 0 * z
    if kind == "plate":
        return np.abs(x - 1.003) + 0 * y + 0 * z
    if kind == "leaning plate":
        return lean
    if kind == "cap":
        return np.abs(np.sqrt((x - 0.7) ** 2 + (y - 0.5) ** 2 + (z - 0.5) ** 2) - 0.75)
    return np.hypot(lean, np.maximum(0, 0.1 - np.abs(z - 0.5)))  # a slit 0.2 wide


def coefficients(kind, contrast):
    """Returns 1/(1 + K dt/rho) at the inner faces across each axis. The largest K dt/rho is called the contrast."""
    for axis in range(3):
        points = [(np.arange(n) + 0.5) * H for n in SHAPE]
        points[axis] = np.arange(1, SHAPE[axis]) * H
        d = distance(kind, *np.meshgrid(*points, indexing="ij", sparse=True))
        yield 1 / (1 + contrast * np.where(d < EPS, (1 + np.cos(np.pi * d / EPS)) / 2, 0))


def iterations(kind, contrast):
    faces = list(coefficients(kind, contrast))
    waves = [2 * (1 - np.cos(np.pi * np.arange(n) / n)) / H**2 for n in SHAPE]
    laplacian = waves[0][:, None, None] + waves[1][None, :, None] + waves[2][None, None, :]
    laplacian[0, 0, 0] = np.inf  # the mean of the pressure is free

    def matrix(p):
        result = np.zeros(SHAPE)
        for axis, coefficient in enumerate(faces):
            ends = [(int(a == axis),) * 2 for a in range(3)]
            result -= np.diff(np.pad(coefficient * np.diff(p, axis=axis) / H**2, ends), axis=axis)
        return result

    residual = np.random.default_rng(1).standard_normal(SHAPE)
    residual[:4] += 50  # the flow comes in here,
    residual[-4:] -= 50  # and leaves here
    residual -= residual.mean()
    least = 1e-6 * np.linalg.norm(residual)
    direction, before, n = np.zeros(SHAPE), np.inf, 0
    while np.linalg.norm(residual) > least:
        z = idctn(dctn(residual) / laplacian)
        product = np.vdot(residual, z)
        direction = z + product / before * direction
        before = product
        image = matrix(direction)
        residual -= product / np.vdot(direction, image) * image
        n += 1
    return n


print("iterations to a residual of 1e-6, by the largest K dt/rho")
print(f"{'':14}", *(f"{contrast:7}" for contrast in (20, 214, 2000)))
for shape in ("plate", "leaning plate", "cap", "slit"):
    print(f"{shape:14}", *(f"{iterations(shape, contrast):7}" for contrast in (20, 214, 2000)))
