# SPDX-License-Identifier: Apache-2.0
"""Checks the runs of ./run nek5000, and prints their tables.

check.py RUNS [PART...]
  RUNS  the folder of the runs: RUNS/NAME/log, and RUNS/NAME/points.RANK where every point was written
  PART  plates, ranks, brute, leak, share, beat, restart; default: the parts whose runs are there

The exit status is 0 if every check holds, 1 if one fails, 2 if a file is missing or is not a record of a run."""
import glob
import math
import os
import sys

class BadRecord(Exception):
    """Raised if a file is missing or is not a record of a run."""


class Judge:
    """Counts the checks that fail."""

    def __init__(self):
        self.failed = 0

    def row(self, what, value, bar, holds):
        self.failed += not holds
        print(f"| {what} | {value} | {bar} | {'yes' if holds else '**NO**'} |")


def lines_of(runs, name, mark):
    """Returns the words that follow the mark, for each line of a run's log that begins with the mark."""
    path = os.path.join(runs, name, "log")
    try:
        with open(path, encoding="ascii", errors="replace") as file:
            found = [line.split()[1:] for line in file if line.lstrip().startswith(mark)]
    except OSError as error:
        raise BadRecord(f"cannot read {path}: {error.strerror}") from error
    if not found:
        raise BadRecord(f"{path} has no line {mark}")
    return found


def numbers(words):
    """Returns the numbers among the words."""
    found = []
    for word in words:
        try:
            found.append(float(word))
        except ValueError:
            continue
    return found


def drops_of(runs, name):
    """Returns the drop over (R/eps) u of every step."""
    return [numbers(words)[1] for words in lines_of(runs, name, "RIIS_DROP")]


def points_of(runs, name):
    """Returns x, y, z, K and the velocity of every point by its global number."""
    paths = sorted(glob.glob(os.path.join(runs, name, "points.*")))
    if not paths:
        raise BadRecord(f"{os.path.join(runs, name)} has no points.*")
    points = {}
    for path in paths:
        with open(path, encoding="ascii") as file:
            for line in file:
                number, *values = line.split()
                if len(values) != 7:
                    raise BadRecord(f"{path}: a line has {len(values) + 1} numbers, not 8")
                points[int(number)] = [float(value) for value in values]
    return points


def plates(runs, judge):
    for name, what in (("plate_0", "upright"), ("plate_0_stiff", "upright, R = 1e5"), ("plate_20_1", "leans by 20 degrees")):
        drops = drops_of(runs, name)
        judge.row(f"closed plate, {what}: drop over (R/eps) u, steps 1 and {len(drops)}", f"{drops[0]:.4f}, {drops[-1]:.4f}",
                  "the last: 0.98 to 1.02", 0.98 <= drops[-1] <= 1.02)


def ranks(runs, judge):
    one, drops = points_of(runs, "plate_20_1"), drops_of(runs, "plate_20_1")
    largest = max(values[3] for values in one.values())
    for name in ("plate_20_2", "plate_20_4"):
        points = points_of(runs, name)
        if points.keys() != one.keys():
            raise BadRecord(f"{name} has other points than plate_20_1")
        marks = sum((points[i][3] > 0) != (one[i][3] > 0) for i in one)
        difference = max(abs(points[i][3] - one[i][3]) for i in one) / largest
        of_drops = max(abs(a - b) for a, b in zip(drops_of(runs, name), drops))
        judge.row(f"{name[-1]} ranks and 1 rank: other marks, K over its largest, drop",
                  f"{marks}, {difference:.1e}, {of_drops:.1e}", "0, 1e-12, 1e-5",
                  marks == 0 and difference <= 1e-12 and of_drops <= 1e-5)


def brute(runs, judge):
    for name in ("plate_0", "plate_20_1", "closed", "held_0.02", "held_0.5", "whole"):
        if not os.path.exists(os.path.join(runs, name)):
            continue
        step, triangles, marked, differ, largest = numbers(lines_of(runs, name, "RIIS_BRUTE")[0])
        judge.row(f"{name}, step {step:.0f}: {marked:.0f} points against all {triangles:.0f} triangles: other marks, K over its "
                  "largest", f"{differ:.0f}, {largest:.1e}", "0, 1e-12", marked > 0 and differ == 0 and largest <= 1e-12)


class Flow:
    """The columns of a valve's run, one entry for each step."""

    def __init__(self, runs, name):
        rows = [numbers(words) for words in lines_of(runs, name, "RIIS_FLOW")]
        if any(len(row) != 11 for row in rows):
            raise BadRecord(f"{name}: a line RIIS_FLOW has not 11 numbers")
        (self.step, self.time, self.opening, self.drive, self.inflow, self.outflow, self.source, self.speed, self.energy,
         self.riis, self.clock) = map(list, zip(*rows))


def leak(runs, judge):
    flow = Flow(runs, "closed")
    formula = numbers(lines_of(runs, "closed", "RIIS_LEAK")[0])[0]
    # In a band as thick as the distance of two points, blood beside the leaflets accelerates, and the leak slowly grows.
    for step, least, most in ((flow.step.index(5), 0.98, 1.02), (-1, 0.95, 1.05)):
        ratio = flow.outflow[step] / formula
        judge.row(f"closed valve, {flow.drive[step]:.0f} dyn/cm^2, step {flow.step[step]:.0f}: leak of {flow.outflow[step]:.4f} "
                  f"ml/s over the formula's {formula:.4f}", f"{ratio:.4f}", f"{least} to {most}", least <= ratio <= most)


def share(runs, judge):
    flow = Flow(runs, "closed")
    part = sum(flow.riis[5:]) / sum(flow.clock[5:])
    judge.row("riis's share of a step, 85,536 points, 1 rank", f"{100 * part:.2f} %", "1 %", part < 0.01)


def beat(runs, judge):
    flow = Flow(runs, "beat")
    orifice, _, effective = numbers(lines_of(runs, "beat", "RIIS_ORIFICE")[0])
    courant = [float(words[words.index("C=") + 1]) for words in lines_of(runs, "beat", "Step") if "C=" in words]
    peak = max(flow.outflow)
    reference = peak / orifice
    fastest = max(range(len(flow.speed)), key=lambda i: flow.speed[i])
    balance = max(abs(i - o + s) for i, o, s in zip(flow.inflow, flow.outflow, flow.source))
    judge.row("the beat: seconds at a fixed step", f"{flow.time[-1]:.4f}", "0.8", flow.time[-1] > 0.7999)
    judge.row(f"largest speed of the beat, {flow.speed[fastest]:.1f} cm/s at {flow.time[fastest]:.3f} s, opening "
              f"{flow.opening[fastest]:.3f}, over peak flow {peak:.1f} ml/s / open orifice {orifice:.2f} cm^2",
              f"{flow.speed[fastest] / reference:.2f}; {flow.speed[fastest] / peak * effective:.2f} with the effective "
              f"orifice of {effective:.2f} cm^2", "2", flow.speed[fastest] <= 2 * reference)
    judge.row("inflow - outflow + source of the band, over the peak flow", f"{balance / peak:.1e}", "1e-3",
              balance <= 1e-3 * peak)
    judge.row("largest Courant number", f"{max(courant):.2f}", "", True)


def restart(runs, judge):
    whole, continued = Flow(runs, "whole"), Flow(runs, "restart")
    at = {round(time, 6): i for i, time in enumerate(whole.time)}
    last = at.get(round(continued.time[-1], 6))
    if last is None:
        raise BadRecord("the restarted run ends at a time that the whole run lacks")
    a, b = points_of(runs, "whole"), points_of(runs, "restart")
    fastest = max(math.sqrt(sum(u * u for u in values[4:])) for values in a.values())
    velocity = max(abs(p - q) for i in a for p, q in zip(a[i][4:], b[i][4:])) / fastest
    resistance = max(abs(a[i][3] - b[i][3]) for i in a) / max(values[3] for values in a.values())
    judge.row(f"restart, {len(continued.time) - 2} steps later: velocity over the largest speed, K over its largest",
              f"{velocity:.1e}, {resistance:.1e}", "1e-6", velocity <= 1e-6 and resistance <= 1e-6)


PARTS = {"plates": (plates, "plate_0"), "ranks": (ranks, "plate_20_4"), "brute": (brute, "plate_0"), "leak": (leak, "closed"),
         "share": (share, "closed"), "beat": (beat, "beat"), "restart": (restart, "restart")}


def main(arguments):
    if not arguments or any(part not in PARTS for part in arguments[1:]):
        print(__doc__, file=sys.stderr)
        return 2
    runs, judge = arguments[0], Judge()
    parts = arguments[1:] or [part for part, (_, name) in PARTS.items() if os.path.exists(os.path.join(runs, name))]
    print("| what | found | bar | holds |\n|---|---|---|---|")
    try:
        for part in parts or PARTS:
            PARTS[part][0](runs, judge)
    except (BadRecord, IndexError, ValueError) as error:
        print(f"check.py: {error}", file=sys.stderr)
        return 2
    return 1 if judge.failed else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
