# SPDX-License-Identifier: Apache-2.0
"""Tests that the counts of ./run bench roofline are consistent. Times are not checked.

usage: test_roofline.py PROGRAM"""

import json
import os
import subprocess
import sys
import tempfile
import unittest

PROGRAM = sys.argv.pop(1)
STAGES = {"update", "regions", "filter", "decide", "rest", "order"}


class Roofline(unittest.TestCase):
    def test_counts_fit_together(self):
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "roofline.json")
            subprocess.run([PROGRAM, path, "20"], check=True)
            with open(path, encoding="utf-8") as file:
                all = json.load(file)
        for unit in ("floats", "doubles", "bytes"):
            self.assertGreater(all["peak"][unit], 0)
        self.assertGreater(all["fine"]["triangles"], 5 * all["coarse"]["triangles"])
        for case in (all["coarse"], all["fine"]):
            self.assertGreater(case["marked"], 100)
            self.assertLess(case["marked"], all["nodes"])
            self.assertGreaterEqual(case["decided_pairs"], case["marked"])
            self.assertGreaterEqual(case["filtered_pairs"], case["decided_pairs"])
            self.assertGreaterEqual(case["near_groups"], case["leaves"])
            self.assertGreaterEqual(case["leaves"] * 32, case["marked"])
            # A filtered pair needs a difference and three products of vectors. A decided pair needs three clamped segments.
            self.assertGreater(case["operations"]["filter"], 12 * case["filtered_pairs"])
            self.assertGreater(case["operations"]["decide"], 50 * case["decided_pairs"])
            self.assertEqual(set(case["bytes"]), STAGES)
            # The least number of bytes: a triangle has nine coordinates, a decided node has three, and an entry of the lists has
            # four numbers.
            self.assertGreater(case["bytes"]["update"], 72 * case["triangles"])
            self.assertGreater(case["bytes"]["decide"], 24 * case["marked"])
            self.assertGreater(case["bytes"]["order"], 28 * case["marked"])
            self.assertLessEqual(STAGES | {"sum", "whole"}, set(case["nanoseconds"]))

    def test_refused(self):
        for words, text in (([], "usage: "), (["/nowhere/roofline.json", "10"], "/nowhere/roofline.json: cannot be written")):
            run = subprocess.run([PROGRAM, *words], capture_output=True, text=True, check=False)
            self.assertNotEqual(run.returncode, 0)
            self.assertIn(text, run.stderr)


if __name__ == "__main__":
    unittest.main()
