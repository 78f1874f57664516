# SPDX-License-Identifier: Apache-2.0
"""Tests examples/cans/check.py: it must accept recorded runs of ./run cans, and refuse copies with one fault each.

For each run, recorded.json has columns of valve.csv up to the step from which they repeat, and the output of CaNS.
test_check.py --record RUNS writes this file."""
import json
import pathlib
import sys
import unittest

HERE = pathlib.Path(__file__).parent
CHECK = HERE.parents[2] / "examples/cans/check.py"
sys.path[:0] = [str(HERE.parent), str(CHECK.parent)]
import check  # noqa: E402
from judged import Judged  # noqa: E402

VARYING = ["opening", "drop", "flow"]


def record(runs):
    """Writes recorded.json from the runs of ./run cans. The file keeps every sixth step of the valve that opens."""
    found = {}
    for folder in sorted(pathlib.Path(runs).iterdir()):
        run = check.read_run(str(folder.parent), folder.name)
        every = 6 if folder.name.startswith("opening") else 1
        columns = [[float(f"{value:.5g}") for value in run[column][::every]] for column in VARYING]
        n = len(columns[0])
        for column in columns:
            while len(column) > 1 and column[-1] == column[-2]:
                column.pop()
        log = check.read_log(str(folder.parent), folder.name)
        largest = max((check.number(match.group(2)) for match in check.DIVERGENCE.finditer(log)), default=1.0)
        limit = min((check.number(match.group(1)) for match in check.TIME_STEP.finditer(log)), default=1.0)
        found[folder.name] = {"steps": n, "columns": columns, "faces": int(run["faces"][-1]), "divergence": f"{largest:.3g}",
                              "dt_cfl": f"{limit:.3g}", "ended": "*** Fim ***" in log,
                              "seconds": [f"{check.median(run[column][1:]):.4g}" for column in check.COLUMNS[6:]]}
    text = ",\n".join(f"{json.dumps(name)}: {json.dumps(run)}" for name, run in found.items())
    (HERE / "recorded.json").write_text("{\n" + text + "\n}\n", encoding="ascii")


def tables():
    """Returns the files of the recorded runs."""
    files = {}
    for name, run in json.loads((HERE / "recorded.json").read_text(encoding="ascii")).items():
        lines = [",".join(check.COLUMNS)]
        for i in range(run["steps"]):
            row = [repr(column[min(i, len(column) - 1)]) for column in run["columns"]]
            lines.append(",".join([str(i + 1), str(i), *row, str(run["faces"]), *run["seconds"]]))
        files[f"{name}/valve.csv"] = "\n".join(lines) + "\n"
        line = f" Velocity divergence norms: Mean =  1e-16 | Maximum =  {run['divergence']}\n"
        end = run["ended"] * " *** Fim ***\n"
        files[f"{name}/log"] = f" dt_cfl =  {run['dt_cfl']} dt = 1\n" + run["steps"] // 10 * line + end
    return files


class Checks(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.whole = Judged(str(CHECK), tables())
        cls.short = Judged(str(CHECK), {name: text for name, text in tables().items() if "300" in name or "ranks" in name},
                           "--short")

    def planted(self, judge, said, run, column, value, rows=slice(-1, None), status=1):
        """Checks that changed values in some rows of a run are refused."""
        lines = judge.tables[f"{run}/valve.csv"].splitlines()
        at = check.COLUMNS.index(column)
        changed = [line.split(",") for line in lines[1:]]
        for row in changed[rows]:
            row[at] = value
        text = "\n".join([lines[0], *(",".join(row) for row in changed)]) + "\n"
        judge.refuses(said, {f"{run}/valve.csv": (judge.tables[f"{run}/valve.csv"], text)}, status)

    def test_recorded_runs_pass(self):
        said = self.whole.passes()
        self.assertIn("| jump | 1 |", said)
        self.assertIn("every check holds", said)
        self.assertIn("every check holds", self.short.passes())

    def test_drops(self):
        wrong = f"{1.03 * check.formula(470, 0)}"
        self.planted(self.short, "FAILED  upright: of 300 steps", "upright-300", "drop", wrong)
        self.planted(self.short, "FAILED  leaning: of 300 steps", "leaning-300", "drop", "NaN", slice(0, 5))
        self.planted(self.short, "FAILED  2 ranks: the drop", "ranks-2", "drop", "9421.0")
        self.planted(self.short, "FAILED  4 ranks mark 9 faces", "ranks-4", "faces", "9")

    def test_divergence(self):
        for old, new in (("Maximum =", "Maximum = 1e-3"), (" *** Fim ***\n", ""), ("Velocity divergence norms", "Nothing")):
            self.short.refuses("FAILED  upright-300: CaNS's own check", {"upright-300/log": (old, new)})

    def test_lags(self):
        slow = f"{0.9 * check.formula(470, 20)}"
        self.planted(self.whole, "FAILED  the recommended way", "leaning-470-jump", "drop", slow, slice(0, 6))
        costly = dict(self.whole.tables)
        for name in check.ANGLES:
            for R in check.CONTRASTS:
                head, *lines = costly[f"{name}-{R}-jump/valve.csv"].splitlines()
                lines = [",".join([*line.split(",")[:6], "0", "0.9", "1"]) for line in lines]
                costly[f"{name}-{R}-jump/valve.csv"] = "\n".join([head, *lines]) + "\n"
        Judged(str(CHECK), costly).refuses("and 10.00 of a plain step", {"upright-470-jump/log": ("", "")})
        self.planted(self.whole, "FAILED  K in the predictor alone", "upright-4394.53-sweeps-1", "drop",
                     f"{check.formula(4394.53, 0)}", slice(100, None))

    def test_opening(self):
        self.planted(self.whole, "FAILED  the way that the page recommends", "opening-jump-cg-1", "flow", "99")
        self.planted(self.whole, "FAILED  the way that the page recommends", "opening-jump-cg-1", "drop", "9")
        self.planted(self.whole, "FAILED  the valve opens", "opening-cg-30", "opening", "0.5")
        self.planted(self.whole, "FAILED  the flow is", "opening-cg-30", "flow", "3", slice(0, 10))
        self.planted(self.whole, "does not begin with a closed valve", "opening-cg-30", "opening", "0.5", slice(0, 1), 2)

    def test_no_records(self):
        self.short.refuses("cannot read", {"ranks-4/valve.csv": None}, 2)
        self.short.refuses("cannot read", {"leaning-300/log": None}, 2)
        self.short.refuses("is no table of a valve", {"ranks-1/valve.csv": ("step,time", "steps")}, 2)


if __name__ == "__main__":
    if sys.argv[1:2] == ["--record"]:
        record(sys.argv[2])
    else:
        unittest.main()
