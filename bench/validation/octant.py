# SPDX-License-Identifier: Apache-2.0
"""Computes Stokes flow through a hole or past a disc in three dimensions, on a staggered grid in one eighth of a box.

Sparse LU solves for the velocities, and conjugate gradients on the Schur complement solve for the pressure. The results show that
the axisymmetric results of stokes.py also hold in three dimensions."""

import numpy as np
import scipy.sparse as sp
import scipy.sparse.linalg as sla

import exact
import marking
from staggered import graded
from stokes import BOX, consistent


class _Side:
    """One direction of the grid. A direction has the sizes and centres of its n cells, and the distances between the centres
    beside faces 0 to n."""

    def __init__(self, edges):
        self.edge, self.size, self.centre = edges, np.diff(edges), (edges[1:] + edges[:-1]) / 2
        self.n = len(self.size)
        self.wide = np.concatenate([[self.size[0] / 2], np.diff(self.centre), [self.size[-1] / 2]])

    def along(self):
        """Returns the matrix of -d2/dx2 times length for values on faces. The first and the last face have only one neighbour."""
        return _springs(1 / self.size)

    def across(self, first_given):
        """Returns the matrix of -d2/dx2 times length for values at centres. The value on the far side of the box is prescribed.
        If first_given is true, the value at 0 is also prescribed."""
        ends = np.zeros(self.n)
        ends[-1] = 1 / self.wide[-1]
        if first_given:
            ends[0] = 1 / self.wide[0]
        return _springs(1 / self.wide[1:-1]) + sp.diags(ends)


def _springs(c):
    n = len(c) + 1
    low, high = sp.identity(n, format="csr")[:-1], sp.identity(n, format="csr")[1:]
    return (high - low).T @ sp.diags(c) @ (high - low)


def _kron(a, b, c):
    return sp.kron(sp.kron(a, b), c, format="csr")


def effective_radius(library, kind, eps, per_eps, rim, tolerance=1e-6):
    """Returns a_eff and the number of cells, like stokes.effective_radius. The plate lies on a face of the grid. The rim may lie
    anywhere between faces."""
    h = eps / per_eps
    n, m = round(1.5 * per_eps + 1), round(1 + 2.5 * eps * 1.0 / h + 1 / h)
    side = [_Side(graded(h, (0, m * h), (0, BOX), 1.15))] * 2 + [_Side(graded(h, (0, n * h), (0, BOX), 1.15))]
    surface = marking.disc(1.0) if kind == "disc" else marking.plate_with_hole(1.0, 2 * BOX)
    parts = [_Component(library, surface, side, c, eps, rim) for c in range(3)]
    A = [sla.splu((part.A)[part.free][:, part.free].tocsc()) for part in parts]
    D = [part.D[:, part.free] for part in parts]
    rough = sum(d @ sp.diags(1 / part.A.diagonal()[part.free]) @ d.T for d, part in zip(D, parts))
    size = np.kron(np.kron(side[0].size, side[1].size), side[2].size)
    rough = sla.splu(rough.tocsc())
    def computed(a):
        given = [part.given(kind, a) for part in parts]
        right = [(g[1] - part.A @ g[0])[part.free] for part, g in zip(parts, given)]
        started = [lu.solve(b) for lu, b in zip(A, right)]
        mass = -sum(part.D @ g[0] for part, g in zip(parts, given)) - sum(d @ x for d, x in zip(D, started))

        def schur(p):
            return sum(d @ lu.solve(d.T @ p) for d, lu in zip(D, A))

        # The velocity u = started + A^-1 D^T p must be free of divergence. This condition gives the equation S p = mass. The
        # Schur complement S is close to the cell volumes if viscosity dominates. If K dominates, S is close to the matrix
        # `rough`.
        p = _conjugate_gradients(schur, mass, lambda x: rough.solve(x) + x / size, tolerance)
        u = [x + lu.solve(d.T @ p) for x, lu, d in zip(started, A, D)]
        if kind == "disc":
            w = given[2][0].copy()
            w[parts[2].free] = u[2]
            return 8 * np.sum(parts[2].K * w * parts[2].volume) / 16
        p = p.reshape([s.n for s in side])
        x, y, z = side[0].centre[0], side[1].centre[0], side[2].centre[-1]
        low, high = 0.05, 2.0
        for _ in range(60):
            middle = (low + high) / 2
            ideal = exact.hole(middle, np.array([np.hypot(x, y)]), np.array([z]))[2][0]
            low, high = (middle, high) if ideal < p[0, 0, -1] else (low, middle)
        return (low + high) / 2

    return consistent(computed), len(size)


class _Component:
    """The equation of one velocity component: its matrix A, the component's part D of the divergence, and boundary values."""

    def __init__(self, library, surface, side, c, eps, rim):
        self.c, self.side = c, side
        place = [s.edge if d == c else s.centre for d, s in enumerate(side)]
        width = [s.wide if d == c else s.size for d, s in enumerate(side)]
        mass = [sp.diags(w) for w in width]
        self.volume = np.kron(np.kron(width[0], width[1]), width[2])
        # At z = 0, u and v are 0. The flow is symmetric about the planes x = 0 and y = 0.
        stiff = [s.along() if d == c else s.across(d == 2) for d, s in enumerate(side)]
        self.xyz = np.stack(np.meshgrid(*place, indexing="ij"), -1)
        shape = self.xyz.shape[:3]
        self.xyz = self.xyz.reshape(-1, 3)
        self.K = library.K(surface, eps, rim, self.xyz, marking.R / marking.MU)
        self.A = sum(_kron(*[stiff[d] if d == e else mass[d] for d in range(3)]) for e in range(3))
        self.A = self.A + sp.diags(self.K * self.volume)
        free = np.ones(shape, bool)
        np.moveaxis(free, c, 0)[-1] = False
        if c != 2:
            np.moveaxis(free, c, 0)[0] = False
        self.free = free.ravel()
        n = side[c].n
        jump = sp.diags([-np.ones(n), np.ones(n)], [0, 1], (n, n + 1))
        self.D = _kron(*[jump if d == c else sp.diags(side[d].size) for d in range(3)])

    def given(self, kind, a):
        """Returns the prescribed velocities on the box's faces normal to c. The velocities are 0 on all other faces. Also returns
        the friction of the other faces."""
        def velocity(x, y, z):
            r = np.hypot(x, y)
            u_r, u_z, _ = exact.disc(a, r, z) if kind == "disc" else exact.hole(a, r, z)
            if kind == "disc":
                u_r, u_z = -u_r, 1 - u_z
            return (u_r * x / np.maximum(r, 1e-300), u_r * y / np.maximum(r, 1e-300), u_z)[self.c]

        value = velocity(*self.xyz.T)
        fixed = np.where(self.free, 0, value)
        if self.c != 2:
            inner = np.isclose(self.xyz[:, self.c], 0)
            fixed[inner] = 0
        friction = np.zeros(len(fixed))
        for d in range(3):
            if d == self.c:
                continue
            s = self.side[d]
            at = self.xyz.copy()
            outer = np.isclose(at[:, d], s.centre[-1])
            at[:, d] = s.edge[-1]
            width = self.volume / np.where(outer, s.size[-1], 1)
            friction[outer] += (velocity(*at.T) * width / s.wide[-1])[outer]
        return fixed, friction


def _conjugate_gradients(S, b, precondition, tolerance, most=400):
    x, r = np.zeros(len(b)), b.copy()
    z = precondition(r)
    d, rz = z, r @ z
    first = rz
    for _ in range(most):
        Sd = S(d)
        alpha = rz / (d @ Sd)
        x, r = x + alpha * d, r - alpha * Sd
        z = precondition(r)
        rz, before = r @ z, rz
        if rz <= tolerance**2 * first:
            return x
        d = z + rz / before * d
    raise RuntimeError(f"the pressure has not converged in {most} steps")
