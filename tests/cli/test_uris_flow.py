# SPDX-License-Identifier: Apache-2.0
"""test_uris_flow.py PATH_OF_URIS_FLOW tests uris_flow.py alone. Exits with 77 if Python lacks NumPy or SciPy.

Three oracles check the program: the equations by loops over single functions and a dense matrix, the flow through a square duct
in closed form, and sides that follow from the shape of the mesh.
"""
import importlib
import importlib.util
import io
import itertools
import math
import pathlib
import subprocess
import sys
import tempfile
import unittest
import unittest.mock

try:
    import numpy as np

    importlib.import_module("scipy.sparse.linalg")
except ImportError as error:
    print(f"skipped: {error}")
    sys.exit(77)

PATH = pathlib.Path(sys.argv.pop(1))
specification = importlib.util.spec_from_file_location("uris_flow", PATH)
uris_flow = importlib.util.module_from_spec(specification)
specification.loader.exec_module(uris_flow)
uris_flow.tell = lambda percent: None

HEX = np.array([[-1, -1, -1], [1, -1, -1], [1, 1, -1], [-1, 1, -1], [-1, -1, 1], [1, -1, 1], [1, 1, 1], [-1, 1, 1]], float)
TET = np.array([[1, 0, 0], [0, 1, 0], [0, 0, 1], [0, 0, 0]], float)


def hex_element():
    points = [np.array(p) / math.sqrt(3) for p in itertools.product((-1, 1), repeat=3)]
    values = [[np.prod(1 + node * p) / 8 for node in HEX] for p in points]
    slopes = [[[node[k] * np.prod(np.delete(1 + node * p, k)) / 8 for k in range(3)] for node in HEX] for p in points]
    return HEX, np.ones(8), np.array(values), np.array(slopes)


def tet_element():
    t = (5 - math.sqrt(5)) / 20
    values = np.full((4, 4), t) + (1 - 4 * t) * np.eye(4)
    return TET, np.full(4, 1 / 24), values, np.tile([[1, 0, 0], [0, 1, 0], [0, 0, 1], [-1, -1, -1]], (4, 1, 1)).astype(float)


def bricks(cells, lower, upper):
    """Returns the nodes and the hexahedra of a box."""
    lines = [np.linspace(a, b, n + 1) for a, b, n in zip(lower, upper, cells)]
    xyz = np.array(list(itertools.product(*lines)))
    number = np.arange(len(xyz)).reshape([n + 1 for n in cells])
    corners = ((HEX + 1) / 2).astype(int)
    return xyz, np.array([[number[tuple(np.add(at, c))] for c in corners] for at in np.ndindex(*cells)])


def tetrahedra(xyz, hexahedra):
    """Cuts each hexahedron along its diagonal, so that the cuts of neighbours' faces agree."""
    cuts = [[0, *[sum(1 << k for k in order[:n]) for n in (1, 2)], 7] for order in itertools.permutations(range(3))]
    by_bits = [0, 1, 3, 2, 4, 5, 7, 6]  # the corner whose coordinates are these bits
    found = np.concatenate([hexahedra[:, [by_bits[bits] for bits in cut]] for cut in cuts])
    volumes = np.linalg.det(xyz[found[:, :3]] - xyz[found[:, 3:]])
    found[volumes < 0] = found[volumes < 0][:, [1, 0, 2, 3]]
    return found


def problem_of(xyz, elements, element, eps, numbers, reach=math.inf, height=0.0):
    """A flat valve at z = height, which fills the box."""
    places, weights, values, slopes = element
    distance = xyz[:, 2] - height
    is_inside = (abs(distance[elements]) <= reach).any(axis=1)
    d = abs(distance)[elements[is_inside]] @ values.T
    delta = np.where(d < eps, (1 + np.cos(np.pi * d / eps)) / (2 * eps**2), 0)
    return uris_flow.Problem(np.array([*numbers, eps]), xyz, elements, places, weights, values, slopes,
                             is_inside.astype("u1"), delta, (distance < 0).astype("u1"))


def dense_flow(problem, is_wall, is_inlet):
    """Computes the flow by loops, without scaled units, times R / eps."""
    R, rho, mu, dt, eps = problem.numbers
    n = len(problem.xyz)
    a, b = np.zeros((4 * n, 4 * n)), np.zeros(4 * n)
    outward = np.zeros((n, 3))
    for delta, nodes in zip(problem.delta, problem.elements[problem.is_inside == 1]):
        for g, weight in enumerate(problem.weights):
            to = problem.xyz[nodes].T @ problem.slopes[g]
            back, w = np.linalg.inv(to), weight * np.linalg.det(to)
            N, dN, metric = problem.values[g], problem.slopes[g] @ back, back.T @ back
            K = R * delta[g]
            tau = 1 / (rho * math.sqrt(4 / dt**2 + K**2 + 36 * (mu / rho) ** 2 * (metric * metric).sum()))
            div, drag = 1 / (tau * np.trace(metric)), K + 1e-4 * R / eps**2
            for i, at in enumerate(nodes):
                outward[at] += w * dN[i]
                for j, to_at in enumerate(nodes):
                    p, q = dN[i], dN[j]
                    block = np.zeros((4, 4))
                    block[:3, :3] = (drag * N[i] * N[j] + mu * (p @ q)) * np.eye(3) + mu * np.outer(q, p) + div * np.outer(p, q)
                    block[:3, 3] = -p * N[j]
                    block[3, :3] = N[i] * q + tau * drag * p * N[j]
                    block[3, 3] = tau * (p @ q)
                    a[4 * at:4 * at + 4, 4 * to_at:4 * to_at + 4] += w * block
    used = np.isin(np.arange(n), problem.elements[problem.is_inside == 1])
    for node in range(n):
        for k in range(4):
            if not used[node] or (k < 3 and is_wall[node]):
                a[4 * node + k] = 0
                a[4 * node + k, 4 * node + k] = 1
            elif k < 3 and is_inlet[node]:
                b[4 * node + k] = -outward[node, k]
    x = np.linalg.solve(a, b).reshape(-1, 4)
    return -(x[is_inlet & ~is_wall, :3] * outward[is_inlet & ~is_wall]).sum() * R / eps


class Flow(unittest.TestCase):
    def flow(self, problem):
        region = uris_flow.region_of(problem)
        self.assertIsNotNone(region)
        return uris_flow.flow_of(problem, region)

    def meshes(self, seed):
        random = np.random.default_rng(seed)
        xyz, hexahedra = bricks((3, 3, 9), (-1, -1, -3), (1, 1, 3))
        is_inner = (abs(xyz) < np.array([0.9, 0.9, 2.9])).all(axis=1)
        xyz[is_inner] += random.uniform(-0.05, 0.05, (is_inner.sum(), 3))
        return (xyz, hexahedra, hex_element()), (xyz, tetrahedra(xyz, hexahedra), tet_element())

    def test_dense(self):
        for numbers in (1e4, 1.06, 0.04, 0.01), (3e3, 3, 0.3, 0.01), (1e4, 1060, 0.04, 1e-3):
            for xyz, elements, element in self.meshes(5):
                problem = problem_of(xyz, elements, element, 0.8, numbers, reach=2.1)
                nodes = np.unique(elements[problem.is_inside == 1])
                low = xyz[nodes, 2].min() + 0.3
                expected = dense_flow(problem, abs(xyz[:, :2]).max(axis=1) > 0.999, xyz[:, 2] < low)
                for sizes in (200,), (9,):  # one part, and many
                    with unittest.mock.patch.object(uris_flow, "SIZES_OF_PARTS", sizes):
                        self.assertAlmostEqual(self.flow(problem) / expected, 1, delta=1e-6)

    def test_duct(self):
        """Without a valve, the difference between the resistances of two square ducts has a closed form."""
        R, eps, mu = 1e-3, 0.5, 0.04
        flows = []
        for n in 24, 36:
            length = n / 6
            xyz, elements = bricks((10, 10, n + 2), (-0.5, -0.5, -length / 2 - 1 / 6), (0.5, 0.5, length / 2 + 1 / 6))
            problem = problem_of(xyz, elements, hex_element(), eps, (R, 1, mu, 1), reach=length / 2 - 0.1)
            flows.append(self.flow(problem._replace(delta=0 * problem.delta)))
        series = sum(math.tanh(k * math.pi / 2) / k**5 for k in range(1, 99, 2))
        of_length = 12 * mu / (1 - 192 / math.pi**5 * series) * eps / R  # divided by the side, which is 1
        self.assertAlmostEqual((1 / flows[1] - 1 / flows[0]) / (12 / 6) / of_length, 1, delta=0.03)

    def test_sides(self):
        xyz, elements = bricks((3, 3, 9), (-1, -1, -3), (1, 1, 3))
        whole = problem_of(xyz, elements, hex_element(), 0.8, (1e4, 1, 0.04, 0.01), reach=1.5)
        region = uris_flow.region_of(whole)
        low = region.xyz[:, 2].min()
        is_wall = abs(region.xyz[:, :2]).max(axis=1) > 0.999
        self.assertTrue((region.is_wall == is_wall).all())
        self.assertTrue((region.is_inlet == ((region.xyz[:, 2] < low + 1e-9) & ~is_wall)).all())
        # The region ends at the mesh on one side, or lies inside the flow.
        self.assertIsNone(uris_flow.region_of(problem_of(xyz, elements, hex_element(), 0.8, (1e4, 1, 0.04, 0.01), 1.5, 2.5)))
        ball = (np.linalg.norm(xyz[elements].mean(axis=1), axis=1) < 0.5).astype("u1")
        self.assertTrue(ball.any())
        self.assertIsNone(uris_flow.region_of(whole._replace(is_inside=ball)))

    def test_unsolved(self):
        xyz, elements = bricks((3, 3, 9), (-1, -1, -3), (1, 1, 3))
        for R in math.nan, 1e200:
            with np.errstate(all="ignore"):
                self.assertIsNone(self.flow(problem_of(xyz, elements, hex_element(), 0.8, (R, 1, 0.04, 0.01), 1.5)))

    def talk(self, problem, *words):
        with tempfile.TemporaryFile() as file:
            for array in problem:
                np.save(file, array)
            file.seek(0)
            return subprocess.run([sys.executable, *words], stdin=file, capture_output=True, text=True)

    def test_script(self):
        xyz, elements = bricks((3, 3, 9), (-1, -1, -3), (1, 1, 3))
        problem = problem_of(xyz, elements, hex_element(), 0.8, (1e4, 1, 0.04, 0.01), 1.5)
        said = self.talk(problem, str(PATH))
        *steps, last = said.stdout.splitlines()
        self.assertEqual(said.returncode, 0)
        self.assertEqual(float.fromhex(last.removeprefix("flow ")), self.flow(problem))
        percents = [int(step.removeprefix("step ")) for step in steps]
        self.assertEqual(percents, sorted(percents))
        self.assertGreaterEqual(len(percents), 5)
        self.assertEqual(self.talk(problem._replace(is_inside=0 * problem.is_inside), str(PATH)).stdout.splitlines()[-1], "open")
        without = f"import sys; sys.modules['scipy'] = None; exec(open({str(PATH)!r}).read())"
        self.assertEqual(self.talk(problem, "-c", without).stdout, "lacks scipy\n")
        # Objects in the input are not read, because they may run code.
        pickled = io.BytesIO()
        np.save(pickled, np.array([{}], dtype=object), allow_pickle=True)
        with tempfile.TemporaryFile() as file:
            file.write(pickled.getvalue())
            file.seek(0)
            refused = subprocess.run([sys.executable, PATH], stdin=file, capture_output=True, text=True)
        self.assertNotEqual(refused.returncode, 0)
        self.assertIn("allow_pickle", refused.stderr)


if __name__ == "__main__":
    unittest.main()
