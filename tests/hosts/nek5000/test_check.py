# SPDX-License-Identifier: Apache-2.0
"""check.py of examples/nek5000 must accept lines of real runs, and refuse each planted fault."""
import os
import sys
import unittest

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, os.path.dirname(HERE))
from judged import Judged  # noqa: E402

CHECK = os.path.join(HERE, "..", "..", "..", "examples", "nek5000", "check.py")
PLATE = """ RIIS_BRUTE step     0 triangles      2 marked    4608 differ   0 max dK/Kmax 0.00E+00
RIIS_DROP step     1 over (R/eps)u   1.005704336 umax   2.55576
RIIS_DROP step     5 over (R/eps)u   1.000127100 umax   6.94122
"""
POINTS = """         1   1.0E-01   2.0E-01   3.0E-01   4.0000000000000000E+05   1.0E+00   2.0E+00   2.0E+00
         2   1.0E-01   2.0E-01   4.0E-01   0.0000000000000000E+00   0.0E+00   0.0E+00   1.0E+00
"""
MOVED = POINTS.replace("4.0000000000000000E+05", "4.0000000000001000E+05")
FLOW = "RIIS_FLOW {:5d} {:9.6f} {:7.5f} {:8.1f} {:.9E} {:.9E} {:.9E} {:.9E} {:.15E} {:.2E} {:.2E}\n"


def closed(leak):
    lines = [FLOW.format(step, 1e-3 * step, 0., 1e4, leak, leak, 0., 3., 7., 2e-3, 1.5) for step in range(1, 9)]
    brute = " RIIS_BRUTE step     0 triangles    988 marked    7088 differ   0 max dK/Kmax 6.98E-16\n"
    return "RIIS_LEAK    1.235000\n" + brute + "".join(lines)


BEAT = """RIIS_ORIFICE    3.921130    5.447010    2.506046
 RIIS_BRUTE step    80 triangles   1332 marked    4511 differ   0 max dK/Kmax 6.98E-16
Step      2, t= 2.0000000E-03, DT= 1.0000000E-03, C=  0.603 5.0000000E-01 5.0000000E-01
""" + FLOW.format(200, .2, 1., 900., 80., 79., -1.05, 39., 9e3, 2e-3, .5) + FLOW.format(
    800, .8, 0., 0., -.1, -.1, 0., 1., 2., 2e-3, .5)
RUNS = {"plate_0/log": PLATE, "plate_0_stiff/log": PLATE, "held_0.02/log": closed(0.), "held_0.5/log": closed(0.),
        "closed/log": closed(1.2311), "beat/log": BEAT,
        "whole/log": BEAT + FLOW.format(203, .203, 1., 900., 80., 79., -1.05, 39., 9e3, 2e-3, .5), "whole/points.000": POINTS,
        "restart/log": FLOW.format(103, .203, 1., 900., 80., 79., -1.05, 39., 9e3, 2e-3, .5), "restart/points.000": POINTS}
for ranks in (1, 2, 4):
    RUNS[f"plate_20_{ranks}/log"] = PLATE
    RUNS[f"plate_20_{ranks}/points.000"] = POINTS if ranks == 1 else POINTS.splitlines(True)[0]
    if ranks > 1:
        RUNS[f"plate_20_{ranks}/points.001"] = POINTS.splitlines(True)[1]

LEAK = "0.00{}000 0.00000  10000.0 1.231100000E+00 {}"  # the time of a step, and the leak in it

# Each fault is a file, a text in this file, and the faulty text that replaces it.
FAULTS = (("plate_0/log", "1.000127100", "1.021"), ("plate_20_1/log", "1.000127100", "0.979"),
          ("plate_20_2/log", "1.000127100", "1.000147100"), ("plate_20_4/points.001", "0.0000000000000000E+00", "1E-3"),
          ("plate_20_2/points.000", "4.0000000000000000E+05", "4.0000000000100000E+05"),
          ("plate_0/log", "differ   0", "differ   1"), ("closed/log", "6.98E-16", "6.98E-12"),
          ("whole/log", "marked    4511", "marked 0"),
          ("closed/log", "RIIS_LEAK    1.235000", "RIIS_LEAK    1.300000"),
          ("closed/log", LEAK.format(5, "1.2311"), LEAK.format(5, "1.2011")),
          ("closed/log", LEAK.format(8, "1.2311"), LEAK.format(8, "1.1511")), ("beat/log", "3.90000", "4.10000"),
          ("beat/log", "-1.05", "-1.25"), ("beat/log", "0.800000", "0.700000"),
          ("restart/points.000", "2.0E+00   2.0E+00", "2.0E+00   2.00001E+00"),
          ("restart/points.000", "4.0000000000000000E+05", "4.00001E+05"))


class Check(unittest.TestCase):
    def setUp(self):
        self.judge = Judged(CHECK, RUNS)

    def test_recorded_runs_pass(self):
        self.assertNotIn("NO", self.judge.passes())

    def test_small_differences_of_ranks_pass(self):
        Judged(CHECK, {**RUNS, "plate_20_2/points.000": MOVED.splitlines(True)[0]}).passes()

    def test_faults_are_refused(self):
        for name, old, new in FAULTS:
            self.judge.refuses("**NO**", {name: (old, new)})

    def test_a_slow_step_is_refused(self):
        slow = closed(1.2311).replace("2.00E-03 1.50E+00", "2.00E-02 1.50E+00")
        judge = Judged(CHECK, {**RUNS, "closed/log": slow}, "share")
        judge.refuses("**NO**", {})

    def test_files_that_are_no_records(self):
        for name, fault, text in (("plate_0_stiff/log", None, "cannot read"), ("plate_20_2/points.001", None, "other points"),
                                  ("beat/log", ("RIIS_ORIFICE", "ORIFICE"), "has no line RIIS_ORIFICE"),
                                  ("closed/log", ("RIIS_LEAK", "LEAK"), "has no line RIIS_LEAK")):
            self.judge.refuses(text, {name: fault}, status=2)


if __name__ == "__main__":
    unittest.main()
