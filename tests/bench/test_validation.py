# SPDX-License-Identifier: Apache-2.0
"""Runs a tiny ./run validate. Its rows must meet their bars, and planted errors must make rows miss them. argv[1] is the program
of marks.c.

The order of a series, the reading of committed rows and the page are tried on made-up rows."""

import copy
import json
import os
import subprocess
import sys
import tempfile
import unittest

ROOT = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..")
sys.path[:0] = [os.path.join(ROOT, "bench", folder) for folder in ("validation", "report")]
try:
    import exact
    import jets
    import marking
    import octant
    import rows
    import staggered
    import stokes
    import validate
except ImportError as missing:
    print(f"{missing}: the validation is not tested")
    sys.exit(77)

PROGRAM = sys.argv.pop(1)


def results_of(tasks, library):
    return {name: function(library, *arguments) for name, function, arguments in tasks}


def stokes_row(scale_eps=1.0, scale_K=1.0):
    """Compares the c of a hole in a band with a round rim with the c of a hole in a solid plate. An edge acts as if it
    lay c half thicknesses farther out."""
    library, n, cells = marking.Library(PROGRAM, scale_K, scale_eps), 4, (1.5, 2, 3)
    values = [(1 - stokes.effective_radius(library, "hole", 1 / n, c, "round")[0]) * n for c in cells]
    solid = [(1 - stokes.solid_radius(library, "hole", 1 / n, c, "round")[0]) * n for c in cells]
    return rows.row("c", "stokes", "", solid[-1], "", "", [1 / c for c in cells], [""] * 3, values, 0.15)


class Computed(unittest.TestCase):
    def test_closed_forms(self):
        exact.check(lambda text: None)

    def test_wrong_closed_form_is_found(self):
        right = exact.disc
        for part in range(3):
            exact.disc = lambda a, r, z, part=part: [v * (1.01 if i == part else 1) for i, v in enumerate(right(a, r, z))]
            try:
                with self.assertRaises(AssertionError):
                    exact.check(lambda text: None)
            finally:
                exact.disc = right

    def test_hole(self):
        self.assertEqual(rows.missed([stokes_row()]), [])

    def test_hole_with_twice_eps(self):
        self.assertEqual(len(rows.missed([stokes_row(scale_eps=2.0)])), 1)

    def test_hole_almost_without_K(self):
        self.assertEqual(len(rows.missed([stokes_row(scale_K=1e-6)])), 1)

    def test_space(self):
        library = marking.Library(PROGRAM)
        space = octant.effective_radius(library, "disc", 0.5, 1.5, "round")[0]
        beside = [stokes.effective_radius(library, "disc", 0.5, 1.5, "round", (0.0, s))[0] for s in rows.ACROSS]
        self.assertAlmostEqual(space / (sum(beside) / 4), 1, delta=0.03)

    def test_closed(self):
        self.assertEqual(rows.missed(rows.closed_rows(marking.Library(PROGRAM))), [])

    def test_closed_with_scaled_K(self):
        self.assertEqual(len(rows.missed(rows.closed_rows(marking.Library(PROGRAM, scale_K=1.05)))), 1)

    def test_closed_with_twice_eps(self):
        self.assertEqual(len(rows.missed(rows.closed_rows(marking.Library(PROGRAM, scale_eps=2.0)))), 1)

    def test_jet(self):
        # On a coarse grid the contraction is 10 to 30 % above the limit, and the Borda-Carnot formula holds within 15 %.
        library, rho = marking.Library(PROGRAM), marking.RHO
        flow = jets.jet(library, 0.5, jets.B / 3, 2, "cut", reynolds=300.0)
        self.assertAlmostEqual(flow["by_core"] / exact.contraction(0.5), 1.15, delta=0.15)
        self.assertAlmostEqual(flow["drop"] / (rho / 2 * (flow["core"] - flow["inlet"]) ** 2), 1, delta=0.15)
        none = jets.jet(marking.Library(PROGRAM, scale_K=1e-8), 0.5, jets.B / 3, 2, "cut", reynolds=300.0)
        self.assertGreater(none["by_core"] / exact.contraction(0.5), 1.4)


class Judged(unittest.TestCase):
    def test_order_and_limit(self):
        for h in ((1, 1 / 2, 1 / 4), (1 / 24, 1 / 32, 1 / 40)):
            for p in (0.5, 1, 2):
                order, limit = rows.extrapolate(h, [3 - 2 * x**p for x in h])
                self.assertAlmostEqual(order, p, places=6)
                self.assertAlmostEqual(limit, 3, places=6)

    def test_no_order(self):
        for values in ([1, 2, 1.5], [1, 1.1, 1.3], [1, 1, 1]):
            self.assertEqual(rows.extrapolate((4, 2, 1), values), (None, values[-1]))

    def test_bar(self):
        made = rows.row("a", "jets", "", 2.0, "", "", (4, 2, 1), "abc", [2.2, 2.2, 2.2], 0.1 + 1e-9)
        self.assertEqual(rows.missed([made]), [])
        self.assertEqual(rows.missed([{**made, "bar": 0.09}]), [{**made, "bar": 0.09}])
        self.assertEqual(len(rows.missed([{**made, "deviation": float("nan")}])), 1)

    def test_committed_rows(self):
        made = rows.row("a", "clinical", "effective area", 2.0, "", "", (4, 2, 1), "abc", [2.2, 2.2, 2.2])
        validate.check_rows([made], "here")
        for broken, text in (({"group": "other"}, "has the group 'other'"), ({"id": "b"}, None)):
            if text:
                with self.assertRaisesRegex(SystemExit, text):
                    validate.check_rows([{**made, **broken}], "here")
        with self.assertRaisesRegex(SystemExit, "two rows have the id a"):
            validate.check_rows([made, copy.deepcopy(made)], "here")
        for field in validate.FIELDS:
            with self.assertRaisesRegex(SystemExit, f"lacks the field {field}"):
                validate.check_rows([{name: made[name] for name in made if name != field}], "here")
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "all.json")
            self.assertIsNone(validate.read_committed(path))
            with open(path, "w", encoding="utf-8") as file:
                json.dump({"commit": "c", "machine": "m", "rows": []}, file)
            with self.assertRaisesRegex(SystemExit, "lacks command"):
                validate.read_committed(path)
        self.assertIn("| effective area |", validate.table_of([made]))
        self.assertIn("**missed**", validate.table_of([{**made, "bar": 0.01}]))
        # Each row names its solver if there are several.
        two = [{**made, "solver": "second"}, {**made, "solver": "first", "quantity": "drop"}]
        table = validate.table_of(two)
        self.assertRegex(table, r"\| effective area \|.*\| b \|")
        self.assertRegex(table, r"\| drop \|.*\| a \|")
        self.assertEqual(validate.solvers_of(two), "(a) first; (b) second")
        self.assertEqual(validate.solvers_of(two[:1]), "second")
        self.assertNotIn("solver", validate.table_of(two[:1]))

    def test_status(self):
        # Makes the page from invented rows. Either one row misses its bar, or no row does.
        def made(key, group, bar=None):
            grids = [f"b/h {n}" for n in (2, 4, 8)]
            return {**rows.row(key, group, "", 1.0, "", "", (4, 2, 1), grids, [1.2, 1.2, 1.2], bar), "c": 1.0}

        some = [made(f"{word}_{kind}_{rim}{end}", "stokes") for kind in rows.SIGN for rim in ("round", "cut")
                for word, end in (("c", ""), ("stokes", ""), ("stokes", "_4"))]  # fmt: skip
        field = {"x": [0.0, 0.01], "y": [0.0, 0.01], "speed": [[0, 1], [0, 1]], "stream": [[0, 1], [0, 1]], "eps": 0.002}
        about = {"commit": "c", "machine": "m", "date": "d", "short": True}
        for bar, status in ((0.3, 0), (0.1, 1)):
            with tempfile.TemporaryDirectory() as folder:
                with open(os.path.join(folder, "rows.json"), "w", encoding="utf-8") as file:
                    all_rows = some + [made("jet_0.3", "jets", bar)]
                    json.dump({"about": about, "rows": all_rows, "fields": {"round": field, "cut": field}}, file)
                words = [sys.executable, "-B", validate.__file__, "--reuse", "--out", folder]
                run = subprocess.run(words, capture_output=True, text=True, check=False)
                self.assertEqual(run.returncode, status, run.stdout + run.stderr)
                self.assertEqual("jet_0.3 is +20.00 % off, and its bar is 10 %" in run.stdout, bool(status))
                with open(os.path.join(folder, "validation.md"), encoding="utf-8") as file:
                    self.assertEqual("**missed**" in file.read(), bool(status))

    def test_grid_that_does_not_fit(self):
        with self.assertRaisesRegex(ValueError, "do not fit between 0 and 6"):
            staggered.graded(0.5, (-1, 2), (0, 6))

    def test_program_refuses(self):
        with self.assertRaisesRegex(SystemExit, "half_thickness"):
            marking.Library(PROGRAM).K(marking.disc(1.0), -2.0, "round", [[0, 0, 0]])
        with self.assertRaisesRegex(SystemExit, "usage"):
            marking.Library(PROGRAM).K(marking.disc(1.0), 1.0, "sharp", [[0, 0, 0]])


if __name__ == "__main__":
    unittest.main()
