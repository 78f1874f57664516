# SPDX-License-Identifier: Apache-2.0
"""Tests which runs examples/svmultiphysics/check.py refuses: it gets recorded runs, and copies with one fault each.

In recorded.txt, a line "== RUN/FILE" begins a file of a run."""
import pathlib
import re
import sys
import unittest

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))
from judged import Judged  # noqa: E402

CHECK = str(HERE.parents[2] / "examples/svmultiphysics/check.py")
_, *RECORDED = re.split(r"^== (.*)\n", (HERE / "recorded.txt").read_text(encoding="ascii"), flags=re.MULTILINE)


def tables_of(*runs):
    return {path: text for path, text in zip(RECORDED[::2], RECORDED[1::2]) if path.split("/")[0] in runs}


def judge(command, *words):
    return Judged(CHECK, tables_of(*words), command, *words)


def fault(judged, table, column, value, where=lambda row: True):
    """Changes a value in the first row of the table whose columns match."""
    head, *lines = judged.tables[table].splitlines()
    names = head.split(",")
    for line in lines:
        row = dict(zip(names, line.split(",")))
        if where(row):
            row[column] = value
            return {table: (line + "\n", ",".join(row.values()) + "\n")}
    raise AssertionError(f"{table} has no such row")


def moves(row):
    return float(row["K_u"]) > 0


class Checks(unittest.TestCase):
    def test_signs(self):
        judged = judge("signs", "beat", "short_2")
        self.assertIn("short_2", judged.passes())
        for column in ("other_sign", "other_box"):
            text = "1 differ" if column == "other_sign" else "differs at 1 node"
            judged.refuses(text, fault(judged, "beat/riis_nodes_0.csv", column, "1"))
            judged.refuses("short_2: ", fault(judged, "short_2/riis_nodes_1.csv", column, "2"))
        judged.refuses("has riis_nodes_*.csv", {"beat/riis_nodes_0.csv": None})

    def test_points(self):
        judged = judge("points", "short", "short_2")
        judged.passes()
        table = "short/riis_points_0.csv"
        judged.refuses("points are wrongly marked", fault(judged, table, "wrong", "1"))
        judged.refuses("K_error is at most 1e-09", fault(judged, table, "K_error", "1e-3"))
        judged.refuses("K_u_error is at most 1e-09", fault(judged, table, "K_u_error", "1", moves))
        judged.refuses("K_u_error is 0 where nothing is marked",
                       fault(judged, table, "K_u_error", "1e-3", lambda row: not moves(row)))
        judged.refuses("a valve that rests again has no velocity",
                       fault(judged, table, "K_u", "1", lambda row: row["step"] == "9"))

    def test_switching(self):
        judged = judge("switching", "beat", "beat_solver", "beat_distances")
        self.assertIn("opens in step", judged.passes())
        table = "beat_distances/riis_nodes_0.csv"
        judged.refuses("turns the valve in the solver's steps",
                       fault(judged, table, "count", "2", lambda row: row["count"] == "1"))

    def test_restart(self):
        judged = judge("restart", "beat", "continued", "continued_solver")
        self.assertIn("not stopped", judged.passes())
        judged.refuses("the frames that the solver's own", fault(judged, "continued_solver/riis_nodes_0.csv", "count", "3"))
        judged.refuses("the sum of K is", fault(judged, "continued/riis_points_0.csv", "K", "1e9"))
        judged.refuses("the sum of K u_valve is", fault(judged, "continued/riis_points_0.csv", "K_u", "1e9"))

    def test_ranks(self):
        judged = judge("ranks", "short", "short_2")
        self.assertIn("Two ranks", judged.passes())
        judged.refuses("the sums are equal", fault(judged, "short_2/riis_points_1.csv", "K", "1e9"))
        judged.refuses("the same Gauss points", fault(judged, "short_2/riis_points_1.csv", "points", "4"))

    def test_drop(self):
        tables = tables_of("closed")
        # The run of the other engine is invented: its pressure at the inlet is smaller.
        name = "closed/1-procs/B_NS_Pressure_average.txt"
        weaker = tables[name].replace("4.8765086955e+03", "3.7865086955e+03").replace("4.8763185608e+03", "3.7863185608e+03")
        self.assertNotEqual(weaker, tables[name])
        tables |= {path.replace("closed", "closed_solver"): weaker if path == name else text for path, text in tables.items()}
        Judged(CHECK, tables, "drop", "closed", "closed_solver", "7.8802").passes()
        Judged(CHECK, tables, "drop", "closed_solver", "closed", "7.8802").refuses("exact K keeps more", {})
        Judged(CHECK, tables, "drop", "closed", "closed_solver", "7.8802").refuses("is steady", {name: ("4.8763", "4.9763")})

    def test_cost(self):
        judged = judge("cost", "beat", "beat_solver")
        self.assertIn("of the solver's time", judged.passes())
        judged.refuses("less than half",
                       fault(judged, "beat/riis_nodes_0.csv", "seconds", "1e4", lambda row: row["count"] == "2"))

    def test_words(self):
        judge("signs").refuses("COMMAND RUN", {})


if __name__ == "__main__":
    unittest.main()
