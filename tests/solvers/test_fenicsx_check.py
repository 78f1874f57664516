# SPDX-License-Identifier: Apache-2.0
"""Tests which differences between two runs examples/fenicsx/check.py refuses. The points of the runs are invented."""
import pathlib
import sys
import unittest

try:
    import numpy
except ImportError:
    print("skipped: there is no numpy")
    sys.exit(77)

sys.path.insert(0, str(pathlib.Path(__file__).parents[2] / "examples/fenicsx"))
import check  # noqa: E402

N, STEPS = 500, 3


class Compare(unittest.TestCase):
    def setUp(self):
        random = numpy.random.default_rng(11)
        self.xyz = random.random((N, 3))
        K = numpy.where(numpy.arange(N) < 300, 1 + random.random((STEPS, N)), 0)[..., None]
        self.fields = {"K": K, "K_u": K * random.random((STEPS, N, 3)), "velocity": random.random((STEPS, N, 3))}
        self.order = random.permutation(N)  # the other run has the points in another order
        self.other_xyz = self.xyz[self.order]
        self.other = {name: values[:, self.order] for name, values in self.fields.items()}

    def compare(self):
        return check.compare(self.xyz, self.fields, self.other_xyz, self.other)

    def refused(self, words):
        with self.assertRaises(SystemExit) as stop:
            self.compare()
        self.assertIn(words, str(stop.exception))

    def marked(self, step=1):
        return int(numpy.flatnonzero(self.other["K"][step, :, 0])[0])

    def test_equal_runs(self):
        moved, rows = self.compare()
        self.assertEqual(moved, 0)
        self.assertEqual([row[1:] for row in rows], [[0, 0, 0, 0.0, 0.0]] * STEPS)
        self.assertEqual([row[0] for row in rows], [300] * STEPS)

    def test_last_bits_of_a_point_explain_those_of_k(self):
        i = self.marked()
        self.other_xyz[i, 0] = numpy.nextafter(self.other_xyz[i, 0], 2)
        self.other["K"][1, i] *= 1 + 1e-14
        moved, rows = self.compare()
        self.assertEqual((moved, rows[1][2], rows[1][3]), (1, 1, 0))

    def test_other_bits_of_k(self):
        i = self.marked()
        self.other["K"][1, i] *= 1 + 1e-14
        self.refused("the same bits of K and K u_valve")

    def test_other_bits_of_k_u(self):
        self.other["K_u"][2, self.marked(2), 1] *= 1 + 1e-14
        self.refused("the same bits of K and K u_valve")

    def test_another_marked_point(self):
        self.other["K"][1, self.marked()] = 0
        self.refused("both runs mark the same points")

    def test_another_k_at_a_moved_point(self):
        i = self.marked()
        self.other_xyz[i, 0] = numpy.nextafter(self.other_xyz[i, 0], 2)
        self.other["K"][1, i] *= 1.001
        self.refused("K differs by at most 1e-9")

    def test_another_mesh(self):
        self.other_xyz[0] += 1e-6
        self.refused("each point of one run is a point of the other")

    def test_a_missing_point(self):
        self.other_xyz = self.other_xyz[1:]
        self.refused("both have as many points, not 500 and 499")

    def test_nothing_marked(self):
        for fields in (self.fields, self.other):
            fields["K"] = fields["K"] * 0
            fields["K"][:, :50] = 1
        self.other["K"] = self.fields["K"][:, self.order]
        self.other["K_u"], self.fields["K_u"] = self.other["K_u"] * 0, self.fields["K_u"] * 0
        self.refused("each step marks points")


if __name__ == "__main__":
    unittest.main()
