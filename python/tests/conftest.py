# SPDX-License-Identifier: Apache-2.0
"""Objects that the tests share. The variable RIIS_C_MARKS, set by ./run python and CTest, is the path of the C program
c_marks."""

import os

import numpy
import pytest

import riis


@pytest.fixture(scope="session")
def xyz():
    """Returns nodes around the valves, in cm. Marking this many nodes starts threads."""
    return numpy.random.default_rng(2025).uniform(-2.0, 2.0, (60_000, 3))


@pytest.fixture
def valve():
    return riis.Valve("mitral", opening=0.3)


@pytest.fixture
def surface(valve):
    return riis.Surface(valve, half_thickness=0.15)


@pytest.fixture
def mesh(xyz):
    return riis.Mesh(xyz)


@pytest.fixture
def marks(surface, mesh):
    return riis.mark(surface, mesh)


@pytest.fixture
def grid():
    """Returns a structured mesh with its adjacency: 41 x 41 x 41 nodes from -2 to 2."""
    n = 41
    k, j, i = numpy.meshgrid(*3 * [numpy.linspace(-2.0, 2.0, n)], indexing="ij")
    mesh = riis.Mesh(numpy.ascontiguousarray(numpy.stack([i.ravel(), j.ravel(), k.ravel()], axis=1)))
    mesh.set_adjacency(riis.Adjacency.from_grid(n, n, n))
    return mesh


@pytest.fixture(scope="session")
def c_marks():
    program = os.environ.get("RIIS_C_MARKS")
    assert program, "RIIS_C_MARKS must name the program riis_python_c_marks"
    return program
