# SPDX-License-Identifier: Apache-2.0
"""Checks the runs of ./run code_saturne, prints their tables, and draws them.

check.py STUDY closed [open] [beat] [--out FOLDER]
  STUDY   the study's folder, with the runs in STUDY/CASE/RESU/NAME
  closed  checks the closed valve: the pressure drop, the solver's own head-loss zone, the ranks
  open    checks the open valve, and the flow without a valve
  beat    checks the beat: the ranks, the velocity of the leaflets, the restart
  --out   a folder for plots and pictures of the flow; needs matplotlib

The exit status is 0 if every check holds, 1 if one fails, 2 if a file is missing or is not a record of a run.
"""
import argparse
import glob
import math
import os
import sys

INFLOW = 0.05  # m/s, for the closed valve
RESISTANCE = 20.0  # kg/(m s)
HALF_THICKNESS = 0.002  # m


class BadRecord(Exception):
    """Raised if a file is missing or is not a record of a run."""


def read_history(study, case, name):
    """Returns the columns of a run's history.csv: numbers, and texts for the sums of bits."""
    path = os.path.join(study, case, "RESU", name, "history.csv")
    try:
        with open(path, encoding="ascii") as file:
            lines = file.read().splitlines()
    except OSError as error:
        raise BadRecord(f"cannot read {path}: {error.strerror}") from error
    texts = {"ids", "resistances", "centres"}
    names = lines[0].split(",") if lines else []
    if "upstream" not in names or len(lines) < 2:
        raise BadRecord(f"{path} has no time step")
    history = {column: [] for column in names}
    for number, line in enumerate(lines[1:], 2):
        fields = line.split(",")
        if len(fields) != len(names):
            raise BadRecord(f"{path}: line {number} has {len(fields)} fields, not {len(names)}")
        for column, field in zip(names, fields):
            if column in texts:
                history[column].append(field)
                continue
            try:
                value = float(field)
            except ValueError:
                value = math.nan
            if not math.isfinite(value):
                raise BadRecord(f"{path}: line {number} has {column} '{field}'")
            history[column].append(value)
    history["drop"] = [up - down for up, down in zip(history["upstream"], history["downstream"])]
    return history


def read_cells(study, case, name, step):
    """Returns the marked cells of a run by their global numbers, with the bits of each centre and of K."""
    paths = sorted(glob.glob(os.path.join(study, case, "RESU", name, f"cells_{step:05d}.*.csv")))
    cells = {}
    for path in paths:
        with open(path, encoding="ascii") as file:
            for line in file:
                fields = line.strip().split(",")
                if len(fields) != 5 or int(fields[0]) in cells:
                    raise BadRecord(f"{path} is no list of cells: '{line.strip()}'")
                cells[int(fields[0])] = (tuple(fields[1:4]), fields[4])
    if not cells:
        raise BadRecord(f"{case}/RESU/{name} has no list of cells of time step {step}")
    return cells


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


def mean(values):
    return sum(values) / len(values)


def runs_on_ranks(study, case, first):
    """Returns, in ascending order, the numbers of ranks for which there are runs NAME_1, NAME_2, ..."""
    found = glob.glob(os.path.join(study, case, "RESU", first + "_[0-9]*", "history.csv"))
    return sorted(int(os.path.basename(os.path.dirname(path)).rsplit("_", 1)[1]) for path in found)


def cost_row(solver, ranks, history, equal, drop, reference):
    """Returns a row of the table of costs. The first step is left out, because it makes the surface and the solver's lists."""
    library, total = mean(history["seconds_riis"][1:]), mean(history["seconds"][1:])
    return [solver, ranks, int(history["cells"][0]), len(history["step"]), f"{1e3 * library:.2f} ms", f"{total:.3f} s",
            f"{100 * library / total:.2f} %", equal, drop, reference]


COST_HEAD = ["solver", "ranks", "cells", "steps", "riis a step", "a step", "share", "marks equal", "drop, Pa", "reference, Pa"]


def compare_ranks(report, text, one, many):
    """Checks that two runs have the same marked cells in all their common time steps. Also compares the cell centres and K."""
    steps = min(len(one["step"]), len(many["step"]))
    ids = sum(one["ids"][i] == many["ids"][i] for i in range(steps))
    centres = sum(one["centres"][i] == many["centres"][i] for i in range(steps))
    resistances = sum(one["resistances"][i] == many["resistances"][i] for i in range(steps))
    report.check(ids == steps, f"{text}: the same cells are marked in {ids} of {steps} time steps")
    both = sum(one["centres"][i] == many["centres"][i] and one["resistances"][i] != many["resistances"][i] for i in range(steps))
    report.check(both == 0, f"{text}: all centres have the same bits in {centres} of {steps} time steps, all K in {resistances}; "
                            f"the centres without K in {both}")
    return f"{ids} of {steps}"


def compare_cells(report, text, one, many):
    """Checks K cell by cell: K must have the same bits if the centre has the same bits."""
    report.check(one.keys() == many.keys(), f"{text}: {len(one)} and {len(many)} cells are marked, "
                                            f"{len(one.keys() & many.keys())} by both")
    same = [cell for cell in one if cell in many and one[cell][0] == many[cell][0]]
    equal = sum(one[cell][1] == many[cell][1] for cell in same)
    report.check(equal == len(same) > 0, f"{text}: {len(same)} centres have the same bits, K has them in {equal} of these cells")
    moved = [cell for cell in one if cell in many and one[cell][0] != many[cell][0]]
    largest = max((abs(float.fromhex(one[cell][1]) / float.fromhex(many[cell][1]) - 1) for cell in moved), default=0)
    report.check(largest < 1e-6, f"{text}: in the other {len(moved)} cells K differs by at most {largest:.1e} of it")


def check_closed(report, study):
    """Checks the closed valve: drops, the solver's own zone, ranks."""
    reference = read_history(study, "reference", "closed")
    target, steps = reference["drop"][-1], len(reference["step"])
    flat = RESISTANCE / HALF_THICKNESS * INFLOW
    rows = []
    first = {}
    for case, language, tolerance in (("c", "C, head losses", 0.001), ("fortran", "Fortran, momentum source", 0.35)):
        one = first[case] = read_history(study, case, "closed_1")
        cells = read_cells(study, case, "closed_1", steps)
        report.check(abs(one["drop"][-1] / target - 1) <= tolerance,
                     f"{language}: the drop is {one['drop'][-1]:.2f} Pa after {len(one['step'])} time steps, {target:.2f} Pa "
                     f"by the solver's own zone, {100 * (one['drop'][-1] / target - 1):+.3f} % (limit {100 * tolerance:g} %)")
        for ranks in runs_on_ranks(study, case, "closed"):
            history = read_history(study, case, f"closed_{ranks}")
            equal = "-"
            if ranks > 1:
                equal = compare_ranks(report, f"{language}, {ranks} ranks", one, history)
                compare_cells(report, f"{language}, {ranks} ranks", cells, read_cells(study, case, f"closed_{ranks}", steps))
                report.check(abs(history["drop"][-1] / one["drop"][-1] - 1) < 0.01,
                             f"{language}, {ranks} ranks: the drop is {history['drop'][-1]:.2f} Pa")
            rows.append(cost_row(language, ranks, history, equal, f"{history['drop'][-1]:.1f}", f"{target:.1f}"))
    rows.append(cost_row("the solver's own zone", 1, reference, "-", f"{target:.1f}", f"{flat:.0f} (flat)"))
    report.check(first["c"]["resistances"][0] == first["fortran"]["resistances"][0],
                 "C and Fortran: the same cells are marked, and K has the same bits")
    # The leaflets' area is larger than the tube's section, so the flow through the leaflets is slower. The integral of K is R/eps
    # times the leaflets' area.
    ratio, one = RESISTANCE / HALF_THICKNESS, first["c"]
    curved = ratio * one["flow"][-1] / (one["integral"][-1] / ratio)
    report.check(abs(target / curved - 1) < 0.2,
                 f"the solver's own zone: the drop is {target:.1f} Pa; R/eps times the flow over the area of the leaflets is "
                 f"{curved:.1f} Pa (limit 20 %), R/eps u of a flat valve {flat:.0f} Pa")
    chosen = [i for i in (1, 2, 3, 5, 10, 20, 30, 40, 60, 80, 100) if i <= len(first["fortran"]["step"])]
    report.table("The drop over the time steps after a sudden start, in Pa", ["time step"] + [str(i) for i in chosen],
                 [[name] + [f"{history['drop'][i - 1]:.0f}" if i <= len(history["drop"]) else "" for i in chosen]
                  for name, history in (("C, head losses", first["c"]), ("the solver's own zone", reference),
                                        ("Fortran, momentum source", first["fortran"]))])
    report.table("Closed valve", COST_HEAD, rows)


def check_open(report, study):
    """Checks that the open valve's drop is close to the drop without a valve."""
    with_valve, without = read_history(study, "c", "open"), read_history(study, "c", "none")
    closed = read_history(study, "c", "closed_1")
    scale = closed["drop"][-1] * 0.2 / INFLOW
    difference = with_valve["drop"][-1] - without["drop"][-1]
    report.check(abs(difference) < 0.05 * scale,
                 f"the open valve: the drop at 20 cm/s is {with_valve['drop'][-1]:.2f} Pa, without a valve "
                 f"{without['drop'][-1]:.2f} Pa; the difference is {100 * difference / scale:.2f} % of what the closed valve "
                 f"would have, {scale:.0f} Pa (limit 5 %)")


def check_beat(report, study):
    """Checks the beat: opening, ranks, velocity of the leaflets, restart."""
    rows = []
    histories = {}
    for case, language in (("c", "C, head losses"), ("fortran", "Fortran, momentum source")):
        beat = histories[case] = read_history(study, case, "beat")
        top = max(beat["opening"])
        report.check(beat["opening"][0] == 0 and top > 0.99 and beat["opening"][-1] < 0.01,
                     f"{language}: the pressures open the valve to {top:.3f} and close it to {beat['opening'][-1]:.3f}")
        forward, backward = max(beat["flow"]), abs(beat["flow"][-1])
        report.check(backward < 0.5 * forward, f"{language}: the flow is up to {1e6 * forward:.0f} ml/s, and "
                                               f"-{1e6 * backward:.0f} ml/s through the valve that closed")
        rows.append(cost_row(language, 1, beat, "-", "", ""))
        for ranks in runs_on_ranks(study, case, "beat"):
            history = read_history(study, case, f"beat_{ranks}")
            equal = compare_ranks(report, f"the beat, {language}, {ranks} ranks", beat, history)
            rows.append(cost_row(language, ranks, history, equal, "", ""))
        check_restart(report, study, case, language)
    still = read_history(study, "c", "beat_still")
    beat = histories["c"]
    n = min(len(beat["drop"]), len(still["drop"]))
    differences = [abs(beat["drop"][i] - still["drop"][i]) for i in range(n)]
    i = differences.index(max(differences))
    report.check(max(differences) > 1,
                 f"without u_surface the drop differs by up to {differences[i]:.0f} Pa: at {beat['time'][i]:.3f} s, opening "
                 f"{beat['opening'][i]:.2f}, it is {beat['drop'][i]:.0f} Pa with it, {still['drop'][i]:.0f} Pa without")
    report.table("The beat", COST_HEAD[:-2], [row[:-2] for row in rows])


def restart_difference(whole, continued):
    """Returns the largest difference between the drops of a whole and a restarted run, and the largest drop."""
    place = {step: i for i, step in enumerate(whole["step"])}
    pairs = [(whole["drop"][place[step]], drop) for step, drop in zip(continued["step"], continued["drop"]) if step in place]
    if not pairs:
        raise BadRecord("a continued run has no time step of the whole one")
    return max(abs(a - b) for a, b in pairs), max(abs(a) for a, _ in pairs)


def check_restart(report, study, case, language):
    """Checks a run that was restarted from a checkpoint in mid-motion: marks, K and pressures."""
    whole, continued = read_history(study, case, "beat"), read_history(study, case, "continued")
    place = {step: i for i, step in enumerate(whole["step"])}
    steps = len(continued["step"])
    for column, what in (("ids", "the marked cells are the same"), ("resistances", "K has the same bits")):
        same = sum(whole[column][place[step]] == value for step, value in zip(continued["step"], continued[column]))
        report.check(same == steps, f"{language}, restart at opening {whole['opening'][place[continued['step'][0]] - 1]:.2f}: "
                                    f"{what} in {same} of {steps} time steps")
    difference, scale = restart_difference(whole, continued)
    bare, bare_scale = restart_difference(read_history(study, "c", "none_whole"), read_history(study, "c", "none_continued"))
    limit = max(bare / bare_scale, 1e-12)
    report.check(difference / scale <= 10 * limit,
                 f"{language}, restart: the drop differs by up to {difference:.2g} Pa, {difference / scale:.1e} of the largest; "
                 f"without a valve by {bare:.2g} Pa, {bare / bare_scale:.1e}")


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("study")
    parser.add_argument("parts", nargs="+", choices=["closed", "open", "beat"])
    parser.add_argument("--out")
    words = parser.parse_args()
    report = Report()
    try:
        for part in words.parts:
            {"closed": check_closed, "open": check_open, "beat": check_beat}[part](report, words.study)
        if words.out:
            import draw  # imported here, because only drawing needs matplotlib
            draw.draw_all(words.study, words.parts, words.out, read_history)
    except BadRecord as error:
        print(f"check.py: {error}", file=sys.stderr)
        return 2
    print(f"{report.failed} checks failed" if report.failed else "every check holds")
    return 1 if report.failed else 0


if __name__ == "__main__":
    sys.exit(main())
