# SPDX-License-Identifier: Apache-2.0
"""Runs riis as the valve engine of a made-up solver, and compares every step with loops over all triangles (model.cpp)."""
import contextlib
import io
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[3] / "examples/svmultiphysics"))
import check  # noqa: E402

MODEL = sys.argv.pop()


class Engine(unittest.TestCase):
    def setUp(self):
        held = tempfile.TemporaryDirectory()
        self.addCleanup(held.cleanup)
        self.folder = pathlib.Path(held.name)

    def run_model(self, case, **environment):
        folder = self.folder / "-".join([case, *environment.values()])
        folder.mkdir()
        settings = {"URIS_TABLE": str(folder / "riis"), "URIS_CHECK": "all", **environment}
        done = subprocess.run([MODEL, case], env={**os.environ, **settings}, capture_output=True, text=True, check=False)
        return folder, done

    def checked(self, case):
        """Runs a case, and returns its steps and Gauss points after both checks."""
        folder, done = self.run_model(case)
        self.assertEqual(done.returncode, 0, done.stderr)
        with contextlib.redirect_stdout(io.StringIO()):
            check.signs(folder)
            check.points(folder)
        return check.frames_of(folder), check.rows_of(folder, "points"), done.stdout

    def test_beat(self):
        frames, points, said = self.checked("beat")
        self.assertIn("flaps has 256 triangles; 3 others", said)
        moving = {step for (step, _), frame in frames.items() if frame[0] > 1}
        self.assertEqual(moving, {4, 5, 6, 7, 12, 13, 14, 15})
        self.assertEqual({row["step"] for row in points if row["K_u"] > 0}, moving)
        # The solid's mesh has no points, but the solver requests its points.
        self.assertEqual({row["points"] > 0 for row in points if row["mesh"] == "solid"}, {False})
        self.assertEqual({row["solid"] > 0 for row in points if row["mesh"] == "solid"}, {True})
        self.assertEqual({row["solid"] for row in points if row["mesh"] == "fluid"}, {0})
        # The half thickness is the solver's ramp. The scaffold adds to K of the closed valve.
        closed = {row["step"]: row["largest_K"] for row in points if row["gauss"] == 4 and row["mesh"] == "fluid"}
        self.assertGreater(closed[7], 1.2 * closed[1])

    def test_two_valves_of_which_one_is_scaled(self):
        frames, points, said = self.checked("two")
        self.assertEqual({valve for _, valve in frames}, {"flaps", "scaled"})
        self.assertIn("scaled has 256 triangles; 0 others", said)
        alone = self.checked("vanish")[1]
        both, one = (next(row["K"] for row in rows if row["step"] == 1) for rows in (points, alone))
        self.assertGreater(both, 1.2 * one)

    def test_other_nodes_with_the_same_number(self):
        _, points, _ = self.checked("remesh")
        before, after = ([row["K"] for row in points if row["step"] == step][0] for step in (8, 9))
        self.assertNotEqual(before, after)

    def test_a_half_thickness_that_vanishes(self):
        _, points, _ = self.checked("vanish")
        marked = {row["step"]: row["marked"] for row in points if row["mesh"] == "fluid"}
        self.assertGreater(marked[6], 0)
        self.assertEqual({marked[step] for step in (7, 8, 9, 10)}, {0})
        self.assertGreater(marked[11], 0)

    def test_engines(self):
        folder, done = self.run_model("beat", URIS_ENGINE="solver")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertNotIn("riis", done.stdout)
        rows = check.rows_of(folder, "points")
        self.assertEqual({row["K"] for row in rows}, {row["points"] for row in rows})  # the made-up solver's K is 1
        folder, done = self.run_model("beat", URIS_ENGINE="distances")
        self.assertIn("riis: the valve flaps", done.stdout)
        rows = check.rows_of(folder, "points")
        self.assertTrue(all(row["K"] == row["points"] for row in rows))
        with contextlib.redirect_stdout(io.StringIO()):
            check.signs(folder)

    def test_refusals(self):
        _, done = self.run_model("quads")
        self.assertIn("the face right of a valve must consist of triangles", done.stderr)
        _, done = self.run_model("beat", URIS_ENGINE="other")
        self.assertIn("URIS_ENGINE is 'other', and must be riis, distances or solver", done.stderr)
        self.assertNotEqual(done.returncode, 0)


if __name__ == "__main__":
    unittest.main()
