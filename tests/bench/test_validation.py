# SPDX-License-Identifier: Apache-2.0
"""Runs a tiny ./run validate. Rows must meet their bars, and planted errors must make rows miss the bars. argv[1] is the program
of marks.c.

Invented rows also test the order of a series, the reading of committed rows and the page."""

import contextlib
import copy
import io
import json
import math
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

ROOT = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..")
sys.path[:0] = [os.path.join(ROOT, "bench", folder) for folder in ("validation", "report")]
try:
    import beside
    import body_fitted
    import cases
    import exact
    import jets
    import marking
    import mitral
    import numpy
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
    """Compares the c of a hole in a band with that of a hole in a solid plate. The band has a round rim. The rim of a band acts
    as if it lay c half thicknesses farther out."""
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
        # On a coarse grid the contraction is 10 to 30 % above the limit. The Borda-Carnot formula holds within 15 %.
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
        # If there are several solvers, each row names its solver.
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

    def test_offsets(self):
        # There is a case of each kind, from files as simpleFoam writes them.
        def case(folder, name, mesh, pressures, words):
            at = pathlib.Path(folder)
            owner, log = at / "meshes" / mesh / "constant/polyMesh/owner", at / "cases" / name / "log.simpleFoam"
            for path, text in ((owner, 'note "nCells:1";'), (log, words + "\nExecutionTime = 2 s"),
                               (log.parent / "complete", ""), (log.parent / "400/U", "internalField uniform (0 0 1);")):
                path.parent.mkdir(parents=True, exist_ok=True)
                path.write_text(text)
            for patch, values in (("inlet", pressures), ("outlet", [0.5e-4 * math.pi * 1.22**2 / 6] * len(pressures))):
                table = log.parent / "postProcessing" / patch / "0/surfaceFieldValue.dat"
                table.parent.mkdir(parents=True)
                table.write_text("".join(f"{at + 1} {value}\n" for at, value in enumerate(values)))

        done, valve = "SIMPLE solution converged in 400 iterations", "trileaflet-0.5"
        steady, moving = [2.0] * 350 + [2.00001] * 50, [2.0] * 350 + [2.1] * 50
        with tempfile.TemporaryDirectory() as folder, contextlib.redirect_stdout(io.StringIO()) as told:
            case(folder, f"fitted-{valve}-0.03", f"fitted-{valve}-0.03", [1.5] * 400, done)
            case(folder, f"riis-{valve}-0.1-0.05-cut-1e3-0.75", f"wide-{valve}-0.1-0.05", steady, "")
            case(folder, f"riis-{valve}-0.1-0.05-cut-1e3-0", f"wide-{valve}-0.1-0.05", moving, "")
            runs = cases.read_runs(pathlib.Path(folder))
            made = beside.beside("trileaflet", 0.5, runs, {})
            # If the case of the walls is missing, a kept row provides the area of the walls.
            again = beside.beside("trileaflet", 0.5, runs[1:], {made[0]["id"]: made[0]})
            none = beside.beside("trileaflet", 0.5, runs[1:], {})
            case(folder, f"riis-{valve}-0.1-0.05-cut-1e3-0.75-0.16", f"wide-{valve}-0.1-0.05-0.16", [2.5] * 400, done)
            mean = beside.beside("trileaflet", 0.5, cases.read_runs(pathlib.Path(folder)), {})
        self.assertIn(f"left out: riis-{valve}-0.1-0.05-cut-1e3-0: simpleFoam did not converge in 400 steps", told.getvalue())
        self.assertEqual([row["id"] for row in made], ["offset_trileaflet_0.5_1_0.75"])
        # The area is Q / sqrt(2 dp / rho), with the total pressure 1.625 or 2.125 rho.
        self.assertAlmostEqual(made[0]["deviation"], math.sqrt(1.625 / 2.12501) - 1, delta=1e-4)
        self.assertAlmostEqual(made[0]["drop"], 2.12501 / 1.625 - 1, delta=1e-4)
        self.assertEqual(made[0]["bar"], 0.04)
        self.assertIn("stalled above the limit of the residuals", made[0]["note"])
        self.assertEqual([row["reference"] for row in again + none], [made[0]["reference"]])
        # With a second mesh, the row has the mean of both areas.
        other = math.sqrt(1.625 / 2.625) - 1
        self.assertEqual([row["id"] for row in mean], ["offset_trileaflet_0.5_1_0.75"])
        self.assertAlmostEqual(mean[0]["deviation"], (made[0]["deviation"] + other) / 2, delta=1e-4)
        self.assertIn(f"the area is the mean of 2 meshes: {100 * other:+.1f} to -12.6 %", mean[0]["note"])
        validate.check_rows(made, "here")
        table = validate.offsets_of([*made, {**made[0], "opening": 1.0, "offset": 0, "deviation": -0.05, "drop": 0.1}])
        self.assertEqual(table.splitlines(), ["| valve | opening | ε | o = 0 | o = 0.75 |", "|---|---|---|---|---|",
                                              "| trileaflet | 1 | 1 mm | -5.0 % (+10 %) |  |",
                                              "| trileaflet | 0.5 | 1 mm |  | -12.6 % (+31 %) |"])

    def test_the_mitral_valve_of_the_walls(self):
        # docs/theory/mitral.md has these lengths and points, which the library's own tests check.
        for opening, length in ((0, 12.62), (1, 12.21)):
            points = mitral.Curve(mitral.annulus_cubics(opening)).points
            self.assertAlmostEqual(2 * numpy.linalg.norm(numpy.diff(points, axis=0), axis=1).sum(), length, delta=0.005)
        middle, side, triangle, anterior = mitral.patches(1)
        numpy.testing.assert_allclose(anterior[-1, -1], (0, -0.951, 2.048), atol=1e-3)
        numpy.testing.assert_allclose(numpy.ptp(triangle[-1], axis=0), 0, atol=1e-12)
        for opening in (0, 0.3, 1):
            middle, side, triangle, anterior = mitral.patches(opening)
            for left, right in ((middle, side), (side, triangle), (triangle, anterior)):
                numpy.testing.assert_allclose(left[:, -1], right[:, 0], atol=1e-4)
            numpy.testing.assert_allclose((middle[:, 0, 0], anterior[:, -1, 0]), 0, atol=1e-9)
        closed = mitral.patches(0)
        self.assertLess(abs(numpy.concatenate([patch[-1] for patch in closed])[:, 2]).max(), 1e-9)

    def test_rows_are_kept(self):
        kept = {key: {"id": key, "commit": "old", "deviation": 1} for key in "ab"}
        again = [{"id": "a", "deviation": 1}, {"id": "b", "deviation": 2}, {"id": "c", "deviation": 3}]
        found = body_fitted.merged(again, kept, "new")
        self.assertEqual([(row["id"], row["commit"], row["deviation"]) for row in found],
                         [("a", "old", 1), ("b", "new", 2), ("c", "new", 3)])

    def test_grid_that_does_not_fit(self):
        with self.assertRaisesRegex(ValueError, "do not fit between 0 and 6"):
            staggered.graded(0.5, (-1, 2), (0, 6))

    def test_points(self):
        # docs/theory/trileaflet.md: on the free edge, x is linear in y if the valve is closed, and quadratic if it is open.
        program = os.path.join(os.path.dirname(PROGRAM), "validation_points")
        text = subprocess.run([program, "trileaflet", "0.5"], capture_output=True, text=True, check=True).stdout
        numbers = [float(word) for word in text.split("{")[1].split("}")[0].split(",")]
        self.assertEqual(len(numbers), 2 * 9 * 9 * 3)
        for place in range(2 * 9 * 9 - 9, 2 * 9 * 9):
            x, y, z = numbers[3 * place : 3 * place + 3]
            share = y / (1.05 * 1.25 * math.sin(math.pi / 3))
            self.assertAlmostEqual(x, 0.5 * 0.625 * share + 0.5 * (1 - 0.3125 * share**2), delta=2e-4)
            self.assertAlmostEqual(z, 0, delta=1e-12)
        self.assertGreater(share, 0.95)
        # The last row of the lower patch is the first row of the upper patch.
        for found, right in zip(numbers[3 * 72 : 3 * 81], numbers[3 * 81 : 3 * 90]):
            self.assertAlmostEqual(found, right, delta=1e-12)
        for words, message in ((["pulmonary", "1"], "'pulmonary' is not a kind of valve"), (["coapting"], "usage")):
            run = subprocess.run([program, *words], capture_output=True, text=True, check=False)
            self.assertIn(message, run.stderr)
            self.assertNotEqual(run.returncode, 0)

    def test_program_refuses(self):
        with self.assertRaisesRegex(SystemExit, "half_thickness"):
            marking.Library(PROGRAM).K(marking.disc(1.0), -2.0, "round", [[0, 0, 0]])
        with self.assertRaisesRegex(SystemExit, "usage"):
            marking.Library(PROGRAM).K(marking.disc(1.0), 1.0, "sharp", [[0, 0, 0]])


if __name__ == "__main__":
    unittest.main()
