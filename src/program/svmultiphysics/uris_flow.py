# SPDX-License-Identifier: Apache-2.0
"""The drop across a closed valve as svMultiPhysics computes it (docs/export.md).

The program has this text inside, and `riis export FOLDER MESH` starts a Python with it (uris_flow.cpp).
In: the arrays of Problem in their order, each in NumPy's format .npy, on the standard input.
Out: lines. `step I` says how much of 100 is done. The last line is one of
  flow F    the flow for a drop of R / eps, which has the unit of an area
  open      the leaflets do not separate two sides of the mesh
  unsolved  the equations were not solved
  lacks M   Python has no module M
"""
import inspect
import math
import sys
from typing import NamedTuple

try:
    import numpy as np
    from scipy import sparse
    from scipy.sparse import csgraph, linalg
    from scipy.spatial import cKDTree
except ImportError as error:
    if __name__ != "__main__":
        raise
    sys.exit(print("lacks", (error.name or "scipy").partition(".")[0]))

# This share of R / eps^2 resists the flow everywhere. It takes the place of the inertia. Without it, the equations outside the
# band would have almost no velocity terms. The share adds a thousandth to the drop.
SHARE_EVERYWHERE = 1e-4
# The constant of the solver's stabilisation.
VISCOUS_CONSTANT = 36
# The equations are solved in parts of about this many nodes. If the iterations fail, larger parts are tried.
SIZES_OF_PARTS = 150, 1000
TOLERANCE, RESTART, MOST_RESTARTS = 1e-7, 80, 8
# The integrals over elements are computed in chunks of about this many values of shape functions. One chunk takes 100 MB.
VALUES_IN_CHUNK = 1 << 20


class Problem(NamedTuple):
    """The arrays on the standard input. All indices begin at 0."""

    numbers: "np.ndarray"  # resistance R, density, viscosity, time step, half thickness eps, in the solver's units
    xyz: "np.ndarray"  # (nodes, 3), of the whole mesh
    elements: "np.ndarray"  # (elements, nodes of an element), all elements of the mesh, of one type
    places: "np.ndarray"  # (nodes of an element, 3): their places in the reference element
    weights: "np.ndarray"  # (points): the solver's Gauss points
    values: "np.ndarray"  # (points, nodes of an element): shape functions
    slopes: "np.ndarray"  # (points, nodes of an element, 3): their derivatives, where the solver takes them
    is_inside: "np.ndarray"  # (elements): 1 if the element belongs to the region near the valve
    delta: "np.ndarray"  # (elements of the region, points): K / R
    is_before: "np.ndarray"  # (nodes): 1 if the node lies before the valve


class Region(NamedTuple):
    """The part of the mesh near the valve. Its nodes have new numbers."""

    xyz: "np.ndarray"
    elements: "np.ndarray"
    is_wall: "np.ndarray"  # nodes on the mesh's boundary, where the flow does not slip
    is_inlet: "np.ndarray"  # nodes on the cut through the mesh before the valve, where the pressure is 1


def faces_of(places):
    """Returns each face's nodes and the number of corners of an element, from the places of its nodes."""
    x, y, z = places.T
    n_corners = {4: 4, 10: 4, 6: 6}.get(len(places), 8)
    # Each of the following functions is zero on one face.
    of_faces = {4: (x, y, z, 1 - x - y - z), 6: (x, y, 1 - x - y, 1 - z, 1 + z),
                8: (1 - x, 1 + x, 1 - y, 1 + y, 1 - z, 1 + z)}[n_corners]
    return [np.flatnonzero(abs(function) < 1e-12) for function in of_faces], n_corners


def region_of(problem):
    """Returns the region and its two sides, or None if the valve does not separate two sides."""
    is_inside = problem.is_inside.astype(bool)
    nodes = np.unique(problem.elements[is_inside])
    n = len(nodes)
    position = np.full(len(problem.xyz), -1)
    position[nodes] = np.arange(n)
    elements = position[problem.elements]
    faces, n_corners = faces_of(problem.places)
    # Finds all faces of the mesh whose corners belong to the region. The three smallest node numbers of a face suffice to tell
    # faces apart.
    keys, owners, numbers = [], [], []
    for number, face in enumerate(faces):
        corners = elements[:, face[face < n_corners]]
        near = np.flatnonzero((corners >= 0).all(axis=1))
        a, b, c = np.sort(corners[near], axis=1)[:, :3].T
        keys.append((a * n + b) * n + c)
        owners.append(near)
        numbers.append(np.full(len(near), number))
    owners, numbers = np.concatenate(owners), np.concatenate(numbers)
    _, same = np.unique(np.concatenate(keys), return_inverse=True)
    inside = is_inside[owners]
    # The region ends at a face that has only one element of the region. If the face has no other element, it is on a wall,
    # otherwise on a cut.
    is_end = inside & (np.bincount(same, inside)[same] == 1)
    is_last = np.bincount(same)[same] == 1
    is_wall, is_cut = np.zeros(n, bool), np.zeros(n, bool)
    starts, ends = [], []
    for number, face in enumerate(faces):
        of_face = is_end & (numbers == number)
        is_wall[elements[owners[of_face & is_last]][:, face]] = True
        cut = elements[owners[of_face & ~is_last]][:, face]
        is_cut[cut] = True
        starts.append(np.repeat(cut[:, 0], len(face)))
        ends.append(cut.ravel())
    # A connected piece of the cut belongs to the side to which most of its nodes belong.
    starts, ends = np.concatenate(starts), np.concatenate(ends)
    joins = sparse.coo_matrix((np.ones(len(starts)), (starts, ends)), shape=(n, n))
    n_pieces, piece = csgraph.connected_components(joins, directed=False)
    size = np.bincount(piece, is_cut, n_pieces)
    balance = np.bincount(piece, is_cut * np.where(problem.is_before[nodes], 1, -1), n_pieces)
    # A piece of the cut with many nodes on both sides leads around the valve.
    if (2 * abs(balance) < size).any() or not (balance > 0).any() or not (balance[size > 0] <= 0).any():
        return None
    return Region(problem.xyz[nodes], elements[is_inside], is_wall, is_cut & ~is_wall & (balance[piece] > 0))


def equations_of(problem, region):
    """Returns the solver's matrix, with three velocities and a pressure for each node, and the outward area of each node.

    The outward area is the integral of a shape function over the region's boundary, times the outward normal.
    The unit of velocity is the one that a drop of 1 gives across the resistance R / eps. All terms then have about the same size.
    """
    resistance, density, viscosity, time_step, eps = problem.numbers
    unit = resistance / eps
    mu, nu = viscosity / unit, viscosity / density
    n, (n_elements, n_nodes) = len(region.xyz), region.elements.shape
    rows = np.repeat(region.elements, n_nodes, axis=1)
    columns = np.tile(region.elements, (1, n_nodes))
    pairs, place = np.unique(rows * n + columns, return_inverse=True)
    place = place.reshape(n_elements, -1)
    blocks = np.zeros((4, 4, len(pairs)))
    outward = np.zeros((n, 3))
    N = problem.values
    step = max(1, VALUES_IN_CHUNK // N.size)
    for begin in range(0, n_elements, step):
        tell(10 + 20 * begin / n_elements)
        chunk = slice(begin, begin + step)
        elements, places = region.elements[chunk], place[chunk].ravel()
        # (elements, points, coordinates in space, coordinates of the reference element)
        jacobian = np.einsum("eai,gak->egik", region.xyz[elements], problem.slopes)
        back = np.linalg.inv(jacobian)
        w = problem.weights * np.linalg.det(jacobian)
        gradient = np.ascontiguousarray(np.einsum("gak,egki->iega", problem.slopes, back))
        metric = np.einsum("egki,egkj->egij", back, back)
        K = resistance * problem.delta[chunk]
        tau = 1 / (density * np.sqrt(4 / time_step**2 + K**2 + VISCOUS_CONSTANT * nu**2 * (metric**2).sum(axis=(2, 3))))
        tau_div = 1 / (tau * np.trace(metric, axis1=2, axis2=3)) / unit
        drag = (K + SHARE_EVERYWHERE * resistance / eps**2) / unit

        def integral(factor, left, right):
            """Returns the integrals of the products of all pairs of functions in each element."""
            return np.matmul((factor[..., None] * left).swapaxes(1, 2), right)

        def add(i, j, integrals):
            blocks[i, j] += np.bincount(places, integrals.ravel(), len(pairs))

        values = np.broadcast_to(N, gradient[0].shape)
        laplacian = sum(integral(w * mu, gradient[k], gradient[k]) for k in range(3))
        mass = integral(w * drag, values, values)
        for i in range(3):
            add(i, i, laplacian + mass)
            for k in range(3):
                # Adds the transposed part of the viscous stress, and the stabilisation of the divergence.
                add(i, k, integral(w * mu, gradient[k], gradient[i]) + integral(w * tau_div, gradient[i], gradient[k]))
            add(i, 3, -integral(w, gradient[i], values))
            add(3, i, integral(w, values, gradient[i]) + integral(w * tau * unit * drag, gradient[i], values))
            add(3, 3, integral(w * tau * unit, gradient[i], gradient[i]))
            outward[:, i] += np.bincount(elements.ravel(), np.einsum("eg,ega->ea", w, gradient[i]).ravel(), n)
    starts = np.searchsorted(pairs, np.arange(n + 1) * n)
    blocks = np.ascontiguousarray(blocks.transpose(2, 0, 1))
    return sparse.bsr_matrix((blocks, pairs % n, starts), shape=(4 * n, 4 * n)), outward


def parts_of(region, size):
    """Returns the part of each node. A part is a column through the valve, with about `size` nodes.

    The nodes of the cut before the valve are halved across their longest extent until each part is small. Each node of the
    region belongs to the nearest of them. Columns let the flow through, so they need fewer iterations than other parts.
    """
    inlet = region.xyz[region.is_inlet]
    most = max(1, size * len(inlet) // len(region.xyz))
    part = np.zeros(len(inlet), int)
    waiting, n_parts = [np.arange(len(inlet))], 0
    while waiting:
        nodes = waiting.pop()
        if len(nodes) <= most:
            part[nodes] = n_parts
            n_parts += 1
            continue
        nodes = nodes[np.argsort(inlet[nodes, np.ptp(inlet[nodes], axis=0).argmax()], kind="stable")]
        waiting += [nodes[:len(nodes) // 2], nodes[len(nodes) // 2:]]
    return part[cKDTree(inlet).query(region.xyz)[1]]


def solve(matrix, right, part):
    """Solves the equations by GMRES, which is preconditioned by the parts. Returns None if this fails.

    The complete factors of the region need too much memory. Without the couplings between parts they are small. Most of the
    flow goes straight through a part, so the number of iterations hardly depends on the number of parts.
    """
    couplings = matrix.tocoo()
    within = part[couplings.row] == part[couplings.col]
    in_parts = sparse.csc_matrix((couplings.data[within], (couplings.row[within], couplings.col[within])), shape=matrix.shape)
    try:
        factors = linalg.splu(in_parts, permc_spec="MMD_AT_PLUS_A", diag_pivot_thresh=0.001, options={"SymmetricMode": True})
    except RuntimeError:  # a part's matrix is singular
        return None
    tell(50)
    # SciPy 1.12 renamed the argument.
    tolerance = {"rtol" if "rtol" in inspect.signature(linalg.gmres).parameters else "tol": TOLERANCE, "atol": 0}
    solution, _ = linalg.gmres(
        matrix, right, M=linalg.LinearOperator(matrix.shape, factors.solve), restart=RESTART, maxiter=MOST_RESTARTS,
        callback=lambda residual: tell(50 + 50 * min(1, math.log(max(residual, TOLERANCE)) / math.log(TOLERANCE))),
        callback_type="pr_norm", **tolerance)
    # The residual is computed here again, so that a NaN also counts as a failure.
    is_solved = np.linalg.norm(matrix @ solution - right) <= 1e-6 * np.linalg.norm(right)
    return solution if is_solved else None


def flow_of(problem, region):
    """Returns the flow through the closed valve for a drop of R / eps, or None if the equations are not solved."""
    if not region.is_inlet.any():  # each node of the cut is at a wall, and nothing flows
        return None
    matrix, outward = equations_of(problem, region)
    tell(30)
    right = np.zeros((len(region.xyz), 4))
    # The pressure outside the region is 1 before the valve and 0 behind it.
    right[region.is_inlet, :3] = -outward[region.is_inlet]
    is_free = np.ones(right.shape, bool)
    is_free[region.is_wall, :3] = False
    free = np.flatnonzero(is_free)
    matrix = matrix.tocsr()[free][:, free]
    for size in SIZES_OF_PARTS:
        solution = solve(matrix, right.ravel()[free], parts_of(region, size)[free // 4])
        if solution is not None:
            unknowns = np.zeros(right.size)
            unknowns[free] = solution
            return -(unknowns.reshape(-1, 4)[region.is_inlet, :3] * outward[region.is_inlet]).sum()
    return None


def tell(percent):
    print("step", int(percent), flush=True)


def main():
    problem = Problem(*(np.load(sys.stdin.buffer, allow_pickle=False) for _ in Problem._fields))
    tell(5)
    region = region_of(problem) if problem.is_inside.any() else None
    if region is None:
        return "open"
    flow = flow_of(problem, region)
    return "unsolved" if flow is None else f"flow {flow.hex()}"


if __name__ == "__main__":
    print(main(), flush=True)
