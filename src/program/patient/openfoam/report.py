#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""report.py [CASE]: prints a table of the last beat of a case that riis patient wrote, and what it should be.

It ends with 1 if a value is not as it should be, unless the run is not complete.
"""
import pathlib
import re
import sys

PASCALS_OF_MMHG = 133.322387415
BEAT = float("@PERIOD@")  # of the tables in 0/p [s]
REST = 0.05  # the leak is steady so long after the valve has closed [s]


def rows_of(case, name, file):
    """Returns the rows of a table of postProcessing by their times. A later start replaces what an earlier one wrote."""
    rows = {}
    for folder in sorted((case / "postProcessing" / name).glob("*"), key=lambda path: float(path.name)):
        for time in [time for time in rows if time > float(folder.name) + 1e-9]:
            del rows[time]
        # A run that was cut off before it wrote a time begins there again, with files such as riisValve_0.dat.
        stem, ending = file.split(".")
        for path in sorted([*folder.glob(file), *folder.glob(f"{stem}_*.{ending}")], key=lambda path: path.stat().st_mtime):
            for line in path.read_text().split("\n"):
                words = re.sub(r"\([^)]*\)", " ", line).split()  # without vectors
                if words and not line.startswith("#"):
                    rows[float(words[0])] = words[1:]
    return rows


def number_after(word, text):
    match = re.search(rf"{word}\s+([-+.\de]+)", text)
    return float(match[1]) if match else None


def steps_of(case):
    """Returns a list of time steps with their values, in SI units."""
    valve = rows_of(case, "valve", "riisValve.dat")
    flows = [rows_of(case, path.name, "surfaceFieldValue.dat") for path in (case / "postProcessing").glob("flow_*")]
    fastest = rows_of(case, "fastest", "fieldMinMax.dat")
    if not valve or not flows:
        sys.exit(f"report.py: {case} has no tables in postProcessing: ./Allrun makes them")
    steps, before = [], None
    for time in sorted(valve):
        if not all(time in table for table in [*flows, fastest]):
            continue  # the run was cut off while it wrote this step
        opening, difference, flow = map(float, valve[time][:3])
        # The columns of fieldMinMax are the field, the least and the largest value, on several ranks each with its rank.
        speed = float(fastest[time][2 if len(fastest[time]) < 5 else 3])
        steps.append({"time": time, "opening": opening, "difference": difference, "flow": flow, "band": float(valve[time][8]),
                      "fastest": speed, "moves": before is not None and opening != before,
                      "balance": abs(sum(float(table[time][0]) for table in flows))})
        before = opening
    return steps


def main():
    case = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else ".")
    steps = steps_of(case)
    options = (case / "system/fvOptions").read_text()
    resistance, half_thickness = number_after("resistance", options), number_after("halfThickness", options)
    logs = [case / name for name in ("log.before", "log.pimpleFoam") if (case / name).exists()]
    log = "".join(path.read_text(errors="replace") for path in logs)
    forecast = re.search(r"closed valve has (\S+) m2 in the mesh, and is\s+expected to drop (\S+) of", log)
    end = steps[-1]["time"]
    dt = min(b["time"] - a["time"] for a, b in zip(steps, steps[1:]))
    beat = [step for step in steps if step["time"] > end - BEAT - dt / 2]
    complete = len(beat) * dt > 0.99 * BEAT
    if not complete:
        print(f"the tables have {len(beat) * dt:.3g} s of a beat of {BEAT:g} s: what follows is preliminary")
    lines, fine = [], True

    def line(text, value, unit, bar=None, shown=None):
        nonlocal fine
        note = ""
        if bar is not None and complete:
            fine = fine and bar[0]
            note = f"{'met' if bar[0] else 'MISSED'}: {bar[1]}"
        lines.append(f"  {text:<46} {shown or f'{value:.4g}':>9} {unit:<7} {note}".rstrip())

    forward = sum(step["flow"] for step in beat if step["flow"] > 0) * dt
    backward = -sum(step["flow"] for step in beat if step["flow"] < 0) * dt
    peak = max(step["flow"] for step in beat)
    fast = [step for step in beat if step["flow"] > 0.5 * peak and step["opening"] > 0]
    line("forward volume", 1e6 * forward, "ml", (forward > 0, "above 0"))
    share = backward / forward if forward > 0 else float("inf")
    line("backward volume", 1e6 * backward, "ml", (share < 0.12, f"below 12 %, {100 * share:.1f} %"))
    line("largest flow", 1e6 * peak, "ml/s")
    if fast:
        line("mean gradient, where the flow exceeds half of it",
             sum(step["difference"] for step in fast) / len(fast) / PASCALS_OF_MMHG, "mmHg")
    opened = [step["difference"] for step in beat if step["opening"] > 0]
    if opened:
        line("largest gradient while the valve is open", max(opened) / PASCALS_OF_MMHG, "mmHg")

    moved = -1.0
    still = []
    for step in steps:
        moved = step["time"] if step["moves"] else moved
        if step in beat and step["opening"] == 0 and step["time"] > moved + REST and step["difference"] < 0:
            still.append(step)
    most = min((step["difference"] for step in still), default=0)
    held = [step for step in still if step["difference"] < 0.8 * most]
    if forecast and held:
        area, drop = float(forecast[1]), float(forecast[2])
        found = -sum(step["flow"] for step in held)
        expected = sum(-step["difference"] * half_thickness * area / resistance / drop for step in held)
        line(f"leak at {-most / PASCALS_OF_MMHG:.0f} mmHg", 1e6 * found / len(held), "ml/s")
        line("leak over the forecast for this mesh", found / expected, "", (abs(found / expected - 1) < 0.03, "1 to 3 %"))
        line("drop of the closed valve over (R / eps) u", drop, "")
    shut = [step for step in beat if step["opening"] == 0 and not step["moves"]]
    if shut:
        speed = max(step["band"] for step in shut)
        line("fastest cell at the closed band", speed, "m/s", (speed <= 2, "at most 2"))
    moving = [step for step in beat if step["moves"]]
    if moving:
        speed = max(step["fastest"] for step in moving)
        line("fastest cell while the valve moves", speed, "m/s", (speed <= 8, "at most 8"))
        above = sum(step["fastest"] > 3 for step in moving) * dt
        line("time with a cell above 3 m/s meanwhile", 1e3 * above, "ms", (above <= 0.0101, "at most 10"))
    balance = max(step["balance"] for step in beat) / max(abs(step["flow"]) for step in beat)
    line("inflow less outflow, over the largest flow", balance, "", (balance <= 1e-5, "at most 1e-5"), f"{balance:.1e}")
    print(f"the beat that ends at {end:g} s")
    print("\n".join(lines))
    return 0 if fine or not complete else 1


if __name__ == "__main__":
    sys.exit(main())
