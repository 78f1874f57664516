# SPDX-License-Identifier: Apache-2.0
"""Tests bench/figures/parameters. The drawings' check must find labels that overlap or leave the sheet. Lengths along curves must
be right."""

import math
import importlib.util
import os
import sys
import unittest

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "bench", "figures", "parameters"))
if importlib.util.find_spec("matplotlib") is None:  # only this module may be missing
    print("skipped: there is no module matplotlib (Debian: python3-matplotlib)")
    sys.exit(77)
import bezier
import sheet

PARAMETERS = [
    {"name": "width", "unit": "length", "values": [2.0], "description": ""},
    {"name": "right.tilt", "unit": "degree", "values": [10.0], "description": ""},
    {"name": "left.tilt", "unit": "degree", "values": [45.0], "description": ""},
    {"name": "non_coronary.tilt", "unit": "degree", "values": [20.5], "description": ""},
]


class Sheet(unittest.TestCase):
    def setUp(self):
        self.sheet = sheet.Sheet("title", PARAMETERS, (8, 6), cusp="left")
        self.panel = self.sheet.panel((1, 1), (5, 4), "panel", (0, 0), 1)

    def refused(self):
        with self.assertRaises(sheet.Refused) as caught:
            self.sheet.check_whole()
        return str(caught.exception)

    def test_whole(self):
        self.panel.length("width", (1, 1), (1, 3), (2, 2))
        self.panel.angle("tilt", (3, 1), (4, 1), (4, 2), 1, (3, 3))
        self.sheet.check_whole()
        self.assertEqual(self.sheet.value_text("tilt"), "10 | 45 | 20.5°")
        self.assertEqual(self.sheet.value_text("width"), "2 cm")

    def test_missing(self):
        self.panel.length("width", (1, 1), (1, 3), (2, 2))
        self.assertEqual(self.refused(), "not drawn: right.tilt, left.tilt, non_coronary.tilt")

    def test_untrue(self):
        for draw in (
            lambda: self.panel.length("width", (1, 1), (1, 3.001), (2, 2)),
            lambda: self.panel.angle("tilt", (3, 1), (4, 1), (4, 2), 1, (3, 3), sense=-1),
            lambda: self.panel.length("height", (1, 1), (1, 3), (2, 2)),
        ):
            with self.assertRaises(sheet.Refused):
                draw()

    def test_unreadable(self):
        self.panel.length("width", (1, 1), (1, 3), (2, 2))
        self.panel.angle("tilt", (3, 1), (4, 1), (4, 2), 1, (2.3, 2.1))
        self.assertIn("overlaps 'width'", self.refused())

    def test_outside(self):
        self.panel.length("width", (1, 1), (1, 3), (2, 2))
        self.panel.angle("tilt", (3, 1), (4, 1), (4, 2), 1, (7, 3))
        self.assertIn("'10 | 45 | 20.5°' leaves the sheet", self.refused())


class Bezier(unittest.TestCase):
    LINE = [[0, 0, 0], [1, 0, 0], [2, 0, 0], [3, 0, 0]]
    PARABOLA = [[0, 0, 0], [0.5, 0, 0], [1, 1, 0]]  # y = x^2

    def test_lengths(self):
        expected = math.sqrt(5) / 2 + math.asinh(2) / 4
        self.assertAlmostEqual(bezier.length([self.PARABOLA]), expected, 8)
        self.assertAlmostEqual(bezier.length([self.LINE, self.PARABOLA]), 3 + expected, 8)
        half = math.sqrt(2) / 4 + math.asinh(1) / 4
        self.assertAlmostEqual(bezier.length([self.PARABOLA], (0.5, 0.25, 0)), half, 7)

    def test_shares(self):
        whole = math.sqrt(5) / 2 + math.asinh(2) / 4
        x, y, _ = bezier.at_share([self.PARABOLA], (math.sqrt(2) / 4 + math.asinh(1) / 4) / whole)
        self.assertAlmostEqual(x, 0.5, 8)
        self.assertAlmostEqual(y, 0.25, 8)
        self.assertAlmostEqual(bezier.at_share([self.LINE], 0.25)[0], 0.75, 8)


if __name__ == "__main__":
    unittest.main()
