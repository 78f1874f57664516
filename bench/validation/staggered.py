# SPDX-License-Identifier: Apache-2.0
"""Solves steady incompressible flow with a resistance K, plane or axisymmetric, on a staggered grid, by sparse LU.

  rho div(u u) = -grad p + div(mu grad u) - K u,  div u = 0

x runs along the axis or the stream. y is the radius or the direction across the stream. u lies on faces normal to x, and v on
faces normal to y. p lies at cell centres. Diffusion uses central differences. Convection extrapolates linearly from two points
upstream. Newton's method solves for all unknowns at once. The Jacobian is exact if the flow keeps its direction through each
face. Stokes flow needs only one solution of linear equations."""

import numpy as np
import scipy.sparse as sp
import scipy.sparse.linalg as sla


class Diverged(Exception):
    """Raised if Newton's method did not converge."""


class Flow:
    """A grid, its matrices and boundary values.

    x, y     edges of the cells, ascending
    axial    if true, y is a radius that begins at 0, and volumes and areas contain the factor y
    walls    "given": u and v are given on all four sides. "channel": u is given on the left side, the lower and the upper side
             are slip walls, and p is 0 on the right side.
    """

    def __init__(self, x, y, axial=False, walls="given"):
        self.x, self.y, self.axial, self.channel = np.asarray(x, float), np.asarray(y, float), axial, walls == "channel"
        self.xc, self.yc = (self.x[1:] + self.x[:-1]) / 2, (self.y[1:] + self.y[:-1]) / 2
        self.nx, self.ny = len(self.xc), len(self.yc)
        self.dx, self.dy = np.diff(self.x), np.diff(self.y)
        self.dxu = np.concatenate([[self.dx[0] / 2], np.diff(self.xc), [self.dx[-1] / 2]])
        self.dyv = np.concatenate([[self.dy[0] / 2], np.diff(self.yc), [self.dy[-1] / 2]])
        self.we, self.wc = (self.y, self.yc) if axial else (np.ones(self.ny + 1), np.ones(self.ny))
        self.n_u, self.n_v, self.n_p = (self.nx + 1) * self.ny, self.nx * (self.ny + 1), self.nx * self.ny
        self.u_of = np.arange(self.n_u).reshape(self.nx + 1, self.ny)
        self.v_of = np.arange(self.n_v).reshape(self.nx, self.ny + 1)
        self.p_of = np.arange(self.n_p).reshape(self.nx, self.ny)
        self.cell = self.wc * self.dy * self.dx[:, None]
        self.u_volume = self.dxu[:, None] * (self.wc * self.dy)
        self.v_volume = self.dx[:, None] * (self.we * self.dyv)
        self._make_divergence()
        free_u, free_v = np.ones((self.nx + 1, self.ny), bool), np.ones((self.nx, self.ny + 1), bool)
        free_u[0], free_v[:, 0], free_v[:, -1] = False, False, False
        free_u[-1] = self.channel
        self.free = np.concatenate([free_u.ravel(), free_v.ravel()])

    # u_points and v_points return the places of the unknown velocities, at which the library computes K.
    def u_points(self):
        return np.stack(np.meshgrid(self.x, self.yc, indexing="ij"), -1).reshape(-1, 2)

    def v_points(self):
        return np.stack(np.meshgrid(self.xc, self.y, indexing="ij"), -1).reshape(-1, 2)

    def _make_divergence(self):
        rows, columns, values = [], [], []
        for of, low, high, area_low, area_high in (
            (self.u_of, np.s_[:-1, :], np.s_[1:, :], self.wc * self.dy, self.wc * self.dy),
            (self.v_of + self.n_u, np.s_[:, :-1], np.s_[:, 1:], self.we[:-1] * self.dx[:, None], self.we[1:] * self.dx[:, None]),
        ):
            for part, area in ((low, -area_low), (high, area_high)):
                rows.append(self.p_of.ravel())
                columns.append(of[part].ravel())
                values.append(np.broadcast_to(area, (self.nx, self.ny)).ravel())
        shape = (self.n_p, self.n_u + self.n_v)
        self.D = sp.csr_matrix((np.concatenate(values), (np.concatenate(rows), np.concatenate(columns))), shape)

    def viscous(self, mu, edge_u=None, edge_v=None):
        """Returns the matrix and the right-hand side of -div(mu grad u), times volumes. mu is a number or has shape (nx, ny).

        edge_u has two arrays of shape (nx + 1): u on the lower and on the upper side. None stands for a side without friction.
        edge_v has two arrays of shape (ny + 1): v on the left and on the right side."""
        mu = np.broadcast_to(np.asarray(mu, float), (self.nx, self.ny))
        padded = np.pad(mu, 1, mode="edge")
        corner = (padded[1:, 1:] + padded[:-1, 1:] + padded[1:, :-1] + padded[:-1, :-1]) / 4
        pairs, rhs = [], np.zeros(self.n_u + self.n_v)
        diagonal = np.zeros(self.n_u + self.n_v)
        u, v = self.u_of, self.v_of + self.n_u
        pairs.append((u[:-1], u[1:], mu * self.wc * self.dy / self.dx[:, None]))
        pairs.append((u[:, :-1], u[:, 1:], corner[:, 1:-1] * self.we[1:-1] * self.dxu[:, None] / self.dyv[1:-1]))
        pairs.append((v[:, :-1], v[:, 1:], mu * self.wc * self.dx[:, None] / self.dy))
        pairs.append((v[:-1], v[1:], corner[1:-1] * self.we * self.dyv / self.dxu[1:-1, None]))
        if self.axial:  # -v/r^2
            between = (corner[1:] + corner[:-1]) / 2
            diagonal[v[:, 1:]] += (between[:, 1:] * self.dyv[1:] / self.we[1:]) * self.dx[:, None]
        for side, at in ((0, 0), (1, -1)):
            if edge_u is not None and edge_u[side] is not None:
                c = corner[:, at] * self.we[at] * self.dxu / self.dyv[at]
                diagonal[u[:, at]] += c
                rhs[u[:, at]] += c * edge_u[side]
            if edge_v is not None and edge_v[side] is not None:
                c = corner[at] * self.we * self.dyv / self.dxu[at]
                diagonal[v[at]] += c
                rhs[v[at]] += c * edge_v[side]
        rows, columns, values = [np.arange(len(diagonal))], [np.arange(len(diagonal))], [diagonal]
        for a, b, c in pairs:
            a, b, c = a.ravel(), b.ravel(), np.broadcast_to(c, a.shape).ravel()
            rows += [a, b, a, b]
            columns += [a, b, b, a]
            values += [c, c, -c, -c]
        n = self.n_u + self.n_v
        return sp.csr_matrix((np.concatenate(values), (np.concatenate(rows), np.concatenate(columns))), (n, n)), rhs

    def _convection(self):
        """Returns four matrices for the inner faces of the control volumes. M computes the mass flow through each face. B
        subtracts the flux of a face from one volume and adds it to the other volume. The last two matrices extrapolate a value to
        each face, for flow in the positive and in the negative direction."""
        if hasattr(self, "_faces"):
            return self._faces
        n = self.n_u + self.n_v
        u, v = self.u_of, self.v_of + self.n_u
        m_rows, m_columns, m_values, line = [], [], [], []
        count = 0

        def add(mass, stencil, where, face):
            # Adds faces. mass has two pairs (unknown, weight). stencil has the unknowns LL, L, R and RR, and `where` their
            # coordinates. face has the coordinates of the faces.
            nonlocal count
            shape = stencil[1].shape
            ids = (np.arange(stencil[1].size) + count).reshape(shape)
            for unknown, weight in mass:
                m_rows.append(ids.ravel())
                m_columns.append(unknown.ravel())
                m_values.append(np.broadcast_to(weight, shape).ravel())
            line.append([np.broadcast_to(a, shape).ravel() for a in (*stencil, *where, face)])
            count += stencil[1].size

        def beyond(a, axis):
            # Returns `a` shifted by one along the axis, in each of both directions. The value at the end is repeated.
            low = np.concatenate([a.take([0], axis), a.take(range(a.shape[axis] - 1), axis)], axis)
            high = np.concatenate([a.take(range(1, a.shape[axis]), axis), a.take([-1], axis)], axis)
            return low, high

        def stencil_of(a, axis):
            low, high = beyond(a, axis)
            first, last = range(a.shape[axis] - 1), range(1, a.shape[axis])
            return low.take(first, axis), a.take(first, axis), a.take(last, axis), high.take(last, axis)

        area = self.wc * self.dy / 2
        X, Y = np.meshgrid(self.x, self.yc, indexing="ij")
        add(((u[:-1], area), (u[1:], area)), stencil_of(u, 0), stencil_of(X, 0), self.xc[:, None])
        # The second faces lie between two volumes of u that are neighbours in y. The flow through such a face is half of v in the
        # cell on the left plus half of v in the cell on the right. At both ends of the grid a face has only one of these halves.
        left, right = np.concatenate([self.dx[:1] * 0, self.dx / 2]), np.concatenate([self.dx / 2, self.dx[:1] * 0])
        to_left = np.concatenate([v[:1], v])[:, 1:-1]
        to_right = np.concatenate([v, v[-1:]])[:, 1:-1]
        add(((to_left, left[:, None] * self.we[1:-1]), (to_right, right[:, None] * self.we[1:-1])),
            stencil_of(u, 1), stencil_of(Y, 1), self.y[1:-1])
        X, Y = np.meshgrid(self.xc, self.y, indexing="ij")
        half = self.dx[:, None] / 2
        add(((v[:, :-1], half * self.we[:-1]), (v[:, 1:], half * self.we[1:])), stencil_of(v, 1), stencil_of(Y, 1), self.yc)
        low, high = np.concatenate([[0], self.wc * self.dy / 2]), np.concatenate([self.wc * self.dy / 2, [0]])
        below = np.concatenate([u[:, :1], u], 1)[1:-1]
        above = np.concatenate([u, u[:, -1:]], 1)[1:-1]
        add(((below, low), (above, high)), stencil_of(v, 0), stencil_of(X, 0), self.x[1:-1, None])

        ll, l, r, rr, xll, xl, xr, xrr, xf = (np.concatenate(a) for a in zip(*line))
        ids = np.arange(count)

        def upstream(near, far, x_near, x_far):
            slope = np.where(x_near != x_far, (xf - x_near) / np.where(x_near != x_far, x_near - x_far, 1), 0)
            weights, columns = np.concatenate([1 + slope, -slope]), np.concatenate([near, far])
            return sp.csr_matrix((weights, (np.tile(ids, 2), columns)), (count, n))

        M = sp.csr_matrix((np.concatenate(m_values), (np.concatenate(m_rows), np.concatenate(m_columns))), (count, n))
        B = sp.csr_matrix((np.repeat([1.0, -1.0], count), (np.concatenate([l.astype(int), r.astype(int)]), np.tile(ids, 2))),
                          (n, count))
        self._faces = M, B, upstream(l.astype(int), ll.astype(int), xl, xll), upstream(r.astype(int), rr.astype(int), xr, xrr)
        return self._faces

    def _convect(self, q):
        """Returns div(u u) times volumes, and its Jacobian."""
        M, B, forward, backward = self._convection()
        mass = M @ q
        ahead = sp.diags((mass > 0).astype(float))
        value_of = ahead @ forward + (sp.identity(len(mass)) - ahead) @ backward
        value = value_of @ q
        residual = B @ (mass * value)
        jacobian = B @ (sp.diags(mass) @ value_of + sp.diags(value) @ M)
        out = self.u_of[-1]  # the half volumes at the outlet end at these faces; the outflow has the velocity of its face
        if self.channel:
            area = self.wc * self.dy
            residual[out] += area * q[out] * q[out]
            jacobian = jacobian + sp.csr_matrix((2 * area * q[out], (out, out)), jacobian.shape)
            # The half volumes at the inlet have no unknown, because u is given there.
        return residual, jacobian

    def solve_linear(self, mu, K, q, edge_u=None, edge_v=None):
        """Solves for Stokes flow, in which rho is 0. Later calls reuse the factors of the first call's matrix, and therefore also
        the first call's mu and K."""
        if not hasattr(self, "_stokes"):
            A, _ = self.viscous(mu, edge_u, edge_v)
            A = A + sp.diags(K * np.concatenate([self.u_volume.ravel(), self.v_volume.ravel()]))
            D = self.D[:, self.free][1:]  # the first cell is left out: its pressure is 0, and its balance follows from the others
            self._stokes = A, D, _factor(sp.bmat([[A[self.free][:, self.free], -D.T], [D, None]], format="csc"))
        A, D, factors = self._stokes
        _, rhs = self.viscous(mu, edge_u, edge_v)
        q = np.where(self.free, 0, q)
        x = factors.solve(np.concatenate([(rhs - A @ q)[self.free], -(self.D @ q)[1:]]))
        q[self.free] = x[: D.shape[1]]
        p = np.concatenate([[0], x[D.shape[1] :]])
        return self._split(q) + (p.reshape(self.nx, self.ny),)

    def _split(self, q):
        return q[: self.n_u].reshape(self.nx + 1, self.ny), q[self.n_u :].reshape(self.nx, self.ny + 1)

    def solve(self, rho, mu, K, q, tolerance=1e-6, most=40, say=None):
        """Solves for steady flow in a channel. Returns u (nx + 1, ny), v (nx, ny + 1) and p (nx, ny).

        q holds the first guess of the velocities, and the given velocities at the inlet. K holds the values at u_points, followed
        by those at v_points. mu is a list of descending viscosities. The solution for each viscosity is the first guess for the
        next viscosity."""
        free = self.free
        volume = np.concatenate([self.u_volume.ravel(), self.v_volume.ravel()])
        q, p = np.array(q, float), np.zeros(self.n_p)
        D = self.D[:, free]
        for number, stage in enumerate(mu):
            enough = tolerance if number == len(mu) - 1 else 0.1
            A, rhs = self.viscous(stage)
            A = A + sp.diags(K * volume)
            for iteration in range(most):
                convection, jacobian = self._convect(q)
                residual = rhs - A @ q - rho * convection + self.D.T @ p
                J = (A + rho * jacobian)[free][:, free]
                mass = -(self.D @ q)
                matrix = sp.bmat([[J, -D.T], [D, None]], format="csc")
                right = np.concatenate([residual[free], mass])
                step = _factor(matrix).solve(right)
                q[free] += step[: J.shape[0]]
                p += step[J.shape[0] :]
                change = np.abs(step[: J.shape[0]]).max() / np.abs(q).max()
                if say:
                    say(f"    step {iteration}: {change:.1e}")
                if not np.isfinite(change) or np.abs(q).max() > 1e6:
                    raise Diverged(f"Newton's method diverges at step {iteration}")
                if change < enough:
                    break
            else:
                raise Diverged(f"Newton's method has not converged in {most} steps: its last was {change:.1e}")
        return self._split(q) + (p.reshape(self.nx, self.ny),)


def _factor(matrix):
    return sla.splu(matrix, permc_spec="COLAMD", diag_pivot_thresh=0.1)


def graded(h, fine, ends, growth=1.1, largest=None):
    """Returns the edges of cells from ends[0] to ends[1]. Cells from fine[0] to fine[1] have the size h. Outside this range, each
    cell is `growth` times as large as its inner neighbour."""
    if fine[0] < ends[0] - 1e-9 * h or fine[1] > ends[1] + 1e-9 * h:
        raise ValueError(f"cells of {h} from {fine[0]} to {fine[1]} do not fit between {ends[0]} and {ends[1]}")
    n = max(1, round((fine[1] - fine[0]) / h))
    middle = np.linspace(fine[0], fine[0] + n * h, n + 1)
    low, high = _grow(h, middle[0], ends[0], growth, largest), _grow(h, middle[-1], ends[1], growth, largest)
    return np.concatenate([low[::-1], middle, high])


def _grow(h, start, end, growth, largest):
    length, sizes = abs(end - start), []
    if length < 1e-9 * h:
        return np.array([])
    size = h
    while sum(sizes) < length - 1e-9 * h:
        size = min(size * growth, largest or np.inf)
        sizes.append(size)
    sizes = np.array(sizes) * (length / sum(sizes))
    return start + np.sign(end - start) * np.cumsum(sizes)
