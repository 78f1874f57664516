# SPDX-License-Identifier: Apache-2.0
"""Tests which invented tables examples/dealii/check.py refuses."""
import contextlib
import csv
import io
import pathlib
import sys
import tempfile
import unittest

try:
    import numpy
except ImportError:
    print("skipped: there is no numpy")
    sys.exit(77)

sys.path.insert(0, str(pathlib.Path(__file__).parents[2] / "examples/dealii"))
import check  # noqa: E402

COLUMNS = ("x", "y", "z", "edge", "u", "v", "w", "p", "K", "K_u", "K_v", "K_w")


def write(path, rows):
    with open(path, "w", newline="", encoding="utf-8") as file:
        writer = csv.DictWriter(file, list(rows[0]))
        writer.writeheader()
        writer.writerows(rows)


class Checks(unittest.TestCase):
    def setUp(self):
        held = tempfile.TemporaryDirectory()
        self.addCleanup(held.cleanup)
        self.folder = pathlib.Path(held.name)
        random = numpy.random.default_rng(5)
        self.cells = [{"id": f"{i}_1:7", **dict(zip(COLUMNS, random.random(len(COLUMNS))))} for i in range(40)]
        opening = [0.5, 1, 1, 0.5, 0, 0, 0]
        flow = [0.1, 1, 0.8, 0.2, -0.3, -0.001, -0.001]
        self.steps = [{"step": i + 1, "time": 0.1 * i, "opening": o, "drop": -1.0, "inflow": q, "outflow": q, "area": 1.0,
                       "share": 1.0, "eps_h": 1.0, "cells": 40, "unknowns": 90, "iterations": 9, "leaflet_area": 1.0,
                       "largest_speed": 0.05} for i, (o, q) in enumerate(zip(opening, flow))]

    def run_of(self, name, cells=None, parts=1):
        folder = self.folder / name
        folder.mkdir(exist_ok=True)
        write(folder / "steps.csv", self.steps)
        cells = cells or self.cells
        for part in range(parts):
            write(folder / f"cells-{part}.csv", cells[part::parts])
        return folder

    def said(self, call, *arguments):
        """Returns the text that a check prints, or the text of its refusal."""
        with contextlib.redirect_stdout(io.StringIO()) as text:
            try:
                call(*arguments)
            except SystemExit as stop:
                return str(stop)
        return text.getvalue()

    def test_equal_runs(self):
        said = self.said(check.same, self.run_of("a"), self.run_of("b", self.cells[::-1], 3))
        self.assertIn("0.0e+00", said)

    def test_runs_that_differ(self):
        first = self.run_of("a")
        for column, name in (("v", "velocity"), ("p", "pressure"), ("K", "K"), ("K_w", "K u_valve")):
            other = [dict(cell) for cell in self.cells]
            other[7][column] += 1e-5
            self.assertIn(f"{name} differs by at most", self.said(check.same, first, self.run_of("b", other)))
            other[7][column] = float("nan")
            self.assertIn(f"{name} is finite", self.said(check.same, first, self.run_of("b", other)))

    def test_other_cells(self):
        first = self.run_of("a")
        self.assertIn("the same cells", self.said(check.same, first, self.run_of("b", self.cells[1:])))
        self.assertIn("belongs to one rank", self.said(check.same, first, self.run_of("c", self.cells + self.cells[:1])))

    def test_another_last_step(self):
        first = self.run_of("a")
        self.steps.pop()
        self.assertIn("ends with the same step", self.said(check.same, first, self.run_of("b")))

    def test_a_valve_at_rest_proves_nothing(self):
        still = [dict(cell, K_u=0.0) for cell in self.cells]
        self.assertIn("the valve moves", self.said(check.same, self.run_of("a", still), self.run_of("b", still)))

    def drops(self, **changed):
        self.steps[-1].update({"drop": 50.0, "share": 1.0, "outflow": 0.01, **changed})
        return self.said(check.drops, f"{self.run_of('a')}:hexahedra:2e-3:1e1:0.01:1e-3")

    def test_drops(self):
        self.assertIn("1.000", self.drops())
        self.assertIn("1.000", self.drops(drop=49.0, share=0.98))
        self.assertIn("within 3 %", self.drops(drop=48.0))
        self.assertIn("within 10 %", self.drops(drop=44.0, share=0.88))
        self.assertIn("the speed is 0.01 m/s, not 0.02", self.drops(outflow=0.02))

    def test_a_plate_that_is_slow(self):
        self.steps[-1]["outflow"] = 0.0995
        self.assertIn("flows at 0.0995", self.said(check.plate, self.run_of("a"), "0.1"))
        self.steps[-1]["outflow"] = 0.09
        self.assertIn("plate's speed to 1 %", self.said(check.plate, self.run_of("a"), "0.1"))

    def test_beats(self):
        half_thickness, resistance = "1e-3", "1"
        said = self.said(check.beat, self.run_of("a"), half_thickness, resistance)
        self.assertIn("the closed valve passes 0.10 %, which is 1.000 of", said)
        for step, column, value, words in ((1, "inflow", 1.1, "inflow and outflow are equal"),
                                           (6, "outflow", -0.2, "passes less than 2 %"),
                                           (5, "outflow", -0.0004, "of what R lets through, not 0.4"),
                                           (5, "outflow", -0.0012, "of what R lets through, not 1.2"),
                                           (2, "largest_speed", 9, "no speed exceeds"),
                                           (6, "opening", 0.5, "closes again"), (0, "opening", 1, "the valve opens")):
            kept = dict(self.steps[step])
            self.steps[step][column] = value
            if column == "outflow":
                self.steps[step]["inflow"] = value
            self.assertIn(words, self.said(check.beat, self.run_of("a"), half_thickness, resistance))
            self.steps[step] = kept

    def test_a_coarse_band(self):
        cells = [dict(cell, K=float(i < 9), edge=1.0 if i < 9 else 2.0) for i, cell in enumerate(self.cells)]
        self.assertIn("9 of 40 cells", self.said(check.refined, self.run_of("a", cells), "2e-3"))
        cells[3]["edge"] = 2.0
        self.assertIn("smaller than the largest", self.said(check.refined, self.run_of("a", cells), "2e-3"))

    def test_a_program_that_refuses_nothing(self):
        self.assertIn("status 1, not 0", self.said(check.refuse, "bad input", ["true"], self.folder, "words"))
        wrong = ["sh", "-c", "echo 'valve_flow: other words' >&2; exit 1"]
        self.assertIn("the message has 'these', not", self.said(check.refuse, "bad input", wrong, self.folder, "these"))


if __name__ == "__main__":
    unittest.main()
