# SPDX-License-Identifier: Apache-2.0
"""A tube of tetrahedra: the mesh for the view's tests, for view_cost.py and for the check in a browser."""

import numpy

# A cube is cut into six tetrahedra around its diagonal. The tetrahedra of a cube fit those of neighbouring cubes.
_SIX = ((0, 1, 2, 6), (0, 2, 3, 6), (0, 3, 7, 6), (0, 7, 4, 6), (0, 4, 5, 6), (0, 5, 1, 6))


def mesh(n, radius=1.3, length=4.0, n_z=None, middle=0.0):
    """Returns points (n_points, 3) and tetrahedra (n_cells, 4) of a tube about z: a grid of n nodes across, smoothed to a circle.

    The wall is a regular polygon with 4 (n - 1) sides, whose corners are at the radius. n_z is the number of nodes along z. None
    makes these edges about as long as those across. The middle is at this z.
    """
    n_z = max(3, round(n * length / (2.0 * radius))) if n_z is None else n_z
    a = numpy.linspace(-1.0, 1.0, n)
    z, y, x = numpy.meshgrid(middle + numpy.linspace(-length / 2.0, length / 2.0, n_z), a, a, indexing="ij")
    # The square becomes the disc, and each smaller square |x|, |y| <= r becomes a circle.
    ring = numpy.maximum(numpy.abs(x), numpy.abs(y))
    turn = numpy.where(numpy.abs(x) >= numpy.abs(y), numpy.pi / 4 * y / numpy.where(x == 0, 1.0, x), 0.0)
    other = numpy.pi / 2 - numpy.pi / 4 * x / numpy.where(y == 0, 1.0, y)
    angle = numpy.where(numpy.abs(x) >= numpy.abs(y), turn + numpy.where(x < 0, numpy.pi, 0.0),
                        other + numpy.where(y < 0, numpy.pi, 0.0))
    disc = radius * ring * numpy.cos(angle), radius * ring * numpy.sin(angle)
    points = numpy.column_stack([disc[0].ravel(), disc[1].ravel(), z.ravel()])
    i, j, k = (part.ravel() for part in numpy.meshgrid(*(numpy.arange(m - 1) for m in (n, n, n_z)), indexing="ij"))

    def node(di, dj, dk):
        return i + di + n * (j + dj + n * (k + dk))

    corner = [node(*at) for at in ((0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1))]
    cells = numpy.concatenate([numpy.column_stack([corner[c] for c in four]) for four in _SIX])
    return numpy.ascontiguousarray(points), cells


def of_nodes(n_nodes, radius=1.3, length=4.0):
    """Returns a tube with about this many nodes."""
    return mesh(round((n_nodes / (length / (2.0 * radius))) ** (1 / 3)), radius, length)
