# SPDX-License-Identifier: Apache-2.0
"""Checks the runs of ./run cans, and prints their tables.

check.py RUNS [--short]
  RUNS     the folder of the runs: RUNS/NAME/valve.csv and RUNS/NAME/log
  --short  without the table of lags and the opening valve

The exit status is 0 if every check holds, 1 if one fails, 2 if a file is missing or is not a record of a run.
"""
import argparse
import csv
import math
import os
import re
import sys

HALF_THICKNESS = 0.046875
ANGLES = {"upright": 0.0, "leaning": 20.0}
CONTRASTS = {"470": 214, "4394.53": 2000}  # K dt/rho at the peak, by R
# The names of the ways in cans.sh, and how many solutions of the Poisson equation each needs in a substep. CaNS itself needs one
# solution, without a valve.
WAYS = {"sweeps-1": ("K in the predictor alone", 1), "sweeps-2": ("2 sweeps", 2), "sweeps-4": ("4 sweeps", 4),
        "sweeps-8": ("8 sweeps", 8), "extrapolation-0.8": ("0.8 of the last change again", 1),
        "cg-2": ("2 iterations of CG", 3), "cg-4": ("4 iterations of CG", 5), "cg-8": ("8 iterations of CG", 9),
        "cg-16": ("16 iterations of CG", 17), "jump": ("jump", 1), "jump-sweeps-2": ("jump, 2 sweeps", 2),
        "jump-cg-1": ("jump, 1 iteration of CG", 2), "jump-cg-2": ("jump, 2 iterations of CG", 3)}
RECOMMENDED, MOVING, REFERENCE = "jump", "jump-cg-1", "cg-30"
OPENING = ["sweeps-1", "jump", "jump-sweeps-2", "jump-cg-1", "jump-cg-2", "cg-4"]
COLUMNS = ["step", "time", "opening", "drop", "flow", "faces", "seconds_riis", "seconds_pressure", "seconds"]
TIME_STEP = re.compile(r"dt_cfl = +(\S+)")
DIVERGENCE = re.compile(r"Velocity divergence norms: Mean = +(\S+) \| Maximum = +(\S+)")
SMALL = 1e7 * 2.0 ** -52  # CaNS's limit in double precision, `small` of its param.f90


class BadRecord(Exception):
    """Raised if a file is missing or is not a record of a run."""


def number(text):
    """Returns a number. Fortran writes 1.0+240 for 1e240, and stars for larger numbers."""
    try:
        return float(re.sub(r"(?<=\d)([+-]\d{3})$", r"e\1", text.strip()))
    except ValueError:
        return math.nan


def read_run(runs, name):
    """Returns the columns of a run's valve.csv."""
    path = os.path.join(runs, name, "valve.csv")
    try:
        with open(path, encoding="ascii", newline="") as file:
            rows = list(csv.DictReader(file))
    except OSError as error:
        raise BadRecord(f"cannot read {path}: {error.strerror}") from error
    if not rows or list(rows[0]) != COLUMNS:
        raise BadRecord(f"{path} is no table of a valve")
    return {column: [number(row[column] or "") for row in rows] for column in COLUMNS}


def read_log(runs, name):
    """Returns the output of CaNS."""
    path = os.path.join(runs, name, "log")
    try:
        with open(path, encoding="ascii", errors="replace") as file:
            return file.read()
    except OSError as error:
        raise BadRecord(f"cannot read {path}: {error.strerror}") from error


def median(values):
    ordered = sorted(values)
    return ordered[len(ordered) // 2]


class Report:
    """Collects checks and tables."""

    def __init__(self):
        self.failed = 0

    def check(self, holds, text):
        self.failed += not holds
        print(f"{'ok    ' if holds else 'FAILED'}  {text}")

    def table(self, title, head, rows):
        print(f"\n{title}\n\n| " + " | ".join(head) + " |\n|" + "---|" * len(head))
        for row in rows:
            print("| " + " | ".join(str(field) for field in row) + " |")
        print()


def formula(R, lean):
    """Returns the drop (R/eps) u cos(lean) of a plate in a flow of speed 1."""
    return float(R) / HALF_THICKNESS * math.cos(math.radians(lean))


def lag(drops):
    """Returns the first step from which the drops, divided by the formula, stay within 2 %, or None."""
    outside = [i for i, drop in enumerate(drops) if not abs(drop - 1) <= 0.02]
    if not outside:
        return 1
    return outside[-1] + 2 if outside[-1] + 1 < len(drops) else None


def check_divergence(report, runs, name, steps):
    text = read_log(runs, name)
    found = [number(match.group(2)) for match in DIVERGENCE.finditer(text)]
    largest = max(found, default=math.nan)
    report.check("*** Fim ***" in text and len(found) == steps // 10 and largest < SMALL,
                 f"{name}: CaNS's own check of the divergence passes {len(found)} times of {steps // 10}, with at most "
                 f"{largest:.1e} (its limit {SMALL:.1e})")


def check_stable(report, runs):
    """Checks 300 steps of the plates, and the ranks."""
    for name, lean in ANGLES.items():
        run = read_run(runs, f"{name}-300")
        drops = [drop / formula(470, lean) for drop in run["drop"]]
        first = lag(drops)
        report.check(len(drops) == 300 and first is not None and first <= 3,
                     f"{name}: of {len(drops)} steps, the drop stays within 2 % of (R/eps) u cos({lean:g}) from step {first} on; "
                     f"it is {drops[0]:.4f} in step 1 and {drops[-1]:.4f} in the last")
        check_divergence(report, runs, f"{name}-300", 300)
    one = read_run(runs, "ranks-1")
    for ranks in (2, 4):
        many = read_run(runs, f"ranks-{ranks}")
        report.check(many["faces"][-1] >= one["faces"][-1] and len(many["drop"]) == len(one["drop"]),
                     f"{ranks} ranks mark {many['faces'][-1]:.0f} faces, 1 rank {one['faces'][-1]:.0f}; ranks also mark "
                     f"the faces in their lower halos")
        difference = max(abs(a / b - 1) for a, b in zip(many["drop"], one["drop"]))
        report.check(difference < 1e-8, f"{ranks} ranks: the drop differs by at most {difference:.1e} of it")


def costs_of(run):
    """Returns the processor time of each step, divided by that of its part without a valve. Other work on the machine hardly
    changes the ratio of the two times."""
    return [whole / (whole - pressure - riis)
            for whole, pressure, riis in zip(run["seconds"], run["seconds_pressure"], run["seconds_riis"])]


def check_lags(report, runs):
    """Prints the table of lags and costs, and checks the recommended way."""
    rows, recommended = [], None
    for way, (title, solutions) in WAYS.items():
        cells, costs = [], []
        for R in CONTRASTS:
            for name, lean in ANGLES.items():
                run = read_run(runs, f"{name}-{R}-{way}")
                first = lag([drop / formula(R, lean) for drop in run["drop"]])
                finite = all(abs(drop) < 3 * formula(R, lean) for drop in run["drop"])
                cells.append(first if first else f"> {len(run['drop'])}" if finite else "blows up")
                if finite:
                    costs += costs_of(run)[5:]
        cost = median(costs) if costs else math.nan
        rows.append([title, solutions, f"{cost:.2f}" if costs else "-", *cells])
        if way == RECOMMENDED:
            recommended = cells, cost
    report.table("The first step from which the drop stays within 2 %", ["way", "Poisson solutions a substep",
                 "time of a step, of its part without a valve", "upright, 214", "leaning, 214", "upright, 2,000",
                 "leaning, 2,000"], rows)
    cells, cost = recommended
    report.check(all(isinstance(cell, int) and cell <= 3 for cell in cells) and cost <= 2,
                 f"the recommended way needs {', '.join(str(cell) for cell in cells)} steps, and {cost:.2f} of a plain step "
                 f"(limits 3 and 2)")
    slow = rows[0][5]
    report.check(not isinstance(slow, int) or slow > 400, f"K in the predictor alone needs {slow} steps at 2,000 (more than 400)")


def opening_row(runs, way, title, run, drop, flow):
    """Returns a row of the table of the valve that opens."""
    least = min((number(match.group(1)) for match in TIME_STEP.finditer(read_log(runs, f"opening-{way}"))), default=math.nan)
    return [title, drop, flow, f"{1e3 * least:.2f} ms", f"{median(costs_of(run)[5:]):.2f}"]


def check_opening(report, runs):
    """Compares the ways, while a valve opens, with 30 iterations of CG in each substep."""
    reference = read_run(runs, f"opening-{REFERENCE}")
    top = max(reference["flow"])
    rows, errors = [], {}
    for way in OPENING:
        run = read_run(runs, f"opening-{way}")
        if len(run["drop"]) != len(reference["drop"]):
            raise BadRecord(f"opening-{way} has {len(run['drop'])} steps, not {len(reference['drop'])}")
        pairs = list(zip(run["drop"], reference["drop"]))[5:]
        flow = max(abs(a - b) for a, b in zip(run["flow"], reference["flow"])) / top
        drop = max(abs(a / b - 1) for a, b in pairs)
        errors[way] = drop, flow
        rows.append(opening_row(runs, way, WAYS[way][0], run, f"{100 * drop:.1f} %", f"{100 * flow:.1f} %"))
    rows.append(opening_row(runs, REFERENCE, "30 iterations of CG", reference, "0", "0"))
    report.table("A valve that opens in 40 ms: the largest differences from 30 iterations of CG a substep",
                 ["way", "drop, of itself", "flow, of its peak", "CaNS's least limit of dt",
                 "time of a step, of its part without a valve"], rows)
    if reference["opening"][0] >= 1e-12:
        raise BadRecord(f"opening-{REFERENCE} does not begin with a closed valve")
    report.check(reference["opening"][-1] > 0.999,
                 f"the valve opens from {reference['opening'][0]:.3f} to {reference['opening'][-1]:.3f}")
    closed = abs([flow for opening, flow in zip(reference["opening"], reference["flow"]) if opening < 1e-12][-1])
    report.check(closed < 1e-3 * top, f"the flow is {closed:.4f} cm/s through the closed valve, and up to {top:.1f} cm/s")
    drop, flow = errors[MOVING]
    report.check(drop < 0.1 and flow < 0.05,
                 f"the way that the page recommends for valves that move: the drop differs by {100 * drop:.1f} %, the flow by "
                 f"{100 * flow:.1f} % of its peak (limits 10 % and 5 %)")
    for way in (MOVING, REFERENCE):
        check_divergence(report, runs, f"opening-{way}", len(reference["drop"]))
    riis = sum(reference["seconds_riis"][1:]) / len(reference["seconds_riis"][1:])
    report.check(riis > 0, f"riis marks the moving valve in {1e3 * riis:.1f} ms a step of processor time")


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("runs")
    parser.add_argument("--short", action="store_true")
    words = parser.parse_args()
    report = Report()
    try:
        check_stable(report, words.runs)
        if not words.short:
            check_lags(report, words.runs)
            check_opening(report, words.runs)
    except BadRecord as error:
        print(f"check.py: {error}", file=sys.stderr)
        return 2
    print(f"{report.failed} checks failed" if report.failed else "every check holds")
    return 1 if report.failed else 0


if __name__ == "__main__":
    sys.exit(main())
