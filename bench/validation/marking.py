# SPDX-License-Identifier: Apache-2.0
"""Makes surfaces of triangles. The program of marks.c computes K at points by the library."""

import subprocess

import numpy as np

R = 1e4  # kg/(m s), the resistance of the examples
MU, RHO = 3.5e-3, 1060.0  # Pa s, kg/m^3: blood
N_SIDES = 1440  # sides of the polygon for a circle; their middles lie 2.4e-6 radii inside the circle


class Library:
    """Calls the program of marks.c. The factors scale_K and scale_eps let a test plant errors."""

    def __init__(self, program, scale_K=1.0, scale_eps=1.0):
        self.program, self.scale_K, self.scale_eps = program, scale_K, scale_eps

    def K(self, surface, eps, rim, xyz, resistance=R):
        vertices, faces = surface
        xyz = np.ascontiguousarray(xyz, "<f8")
        data = np.array([len(vertices), len(faces), len(xyz)], "<i8").tobytes()
        data += np.ascontiguousarray(vertices, "<f8").tobytes() + np.ascontiguousarray(faces, "<i8").tobytes() + xyz.tobytes()
        words = [self.program, repr(float(eps * self.scale_eps)), repr(float(resistance * self.scale_K)), rim]
        run = subprocess.run(words, input=data, capture_output=True, check=False)
        if run.returncode:
            raise SystemExit(f"{' '.join(words)}: {run.stderr.decode().strip()}")
        return np.frombuffer(run.stdout, "<f8").copy()


def disc(a):
    """Returns a disc of radius a in the plane z = 0, with a vertex at y = 0."""
    angle = 2 * np.pi * np.arange(N_SIDES) / N_SIDES
    circle = np.stack([a * np.cos(angle), a * np.sin(angle), 0 * angle], 1)
    i = np.arange(N_SIDES)
    return np.vstack([circle, [[0, 0, 0]]]), np.stack([i, (i + 1) % N_SIDES, np.full(N_SIDES, N_SIDES)], 1)


def plate_with_hole(a, outer):
    """Returns a plate in the plane z = 0 between the radii a and outer, so that it has a hole of radius a."""
    angle = 2 * np.pi * np.arange(N_SIDES) / N_SIDES
    circle = np.stack([np.cos(angle), np.sin(angle), 0 * angle], 1)
    i, j = np.arange(N_SIDES), (np.arange(N_SIDES) + 1) % N_SIDES
    faces = np.vstack([np.stack([i, i + N_SIDES, j], 1), np.stack([j, i + N_SIDES, j + N_SIDES], 1)])
    return np.vstack([a * circle, outer * circle]), faces


def plate_with_slit(b, outer):
    """Returns a plate in the plane x = 0 from y = b to y = outer, and its mirror image. The plate and the image reach from z =
    -outer to outer."""
    vertices, faces = [], []
    for sign in (1, -1):
        first = len(vertices)
        vertices += [[0, sign * b, -outer], [0, sign * outer, -outer], [0, sign * outer, outer], [0, sign * b, outer]]
        faces += [[first, first + 1, first + 2], [first, first + 2, first + 3]]
    return np.array(vertices, float), np.array(faces)
