#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""report.py [--picture]: prints a table of the last beat of this case, and what it should be, and writes report.txt.

It ends with 1 if a value is not as it should be, and with 2 if the beat is not complete. With --picture, it prints only the
arguments of riis for a picture of the flow, one a line. The picture shows the last beat at the written time with the largest
flow through the fully open valve.
"""
import pathlib
import re
import sys

from beat_table import beat_table, save_and_print

CASE = pathlib.Path(__file__).resolve().parent


def rows_of(case, name, file):
    """Returns the rows of a table of postProcessing by their times. If the run was started again, the rows of the later start
    replace earlier rows."""
    rows = {}
    for folder in sorted((case / "postProcessing" / name).glob("*"), key=lambda path: float(path.name)):
        for time in [time for time in rows if time > float(folder.name) + 1e-9]:
            del rows[time]
        # A run that was cut off before it wrote a time starts again from the beginning. Its new files have names such as
        # riisValve_0.dat.
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


def period_of(case):
    """Returns the duration of a beat [s]."""
    period = number_after(r"\n\s*period", (case / "system/controlDict").read_text())
    if not period or period <= 0:
        sys.exit(f"report.py: {case}/system/controlDict has no positive period, the duration of a beat in seconds")
    return period


def forecast_of(case):
    """Returns the closed valve's area and drop in the mesh as the plug-in foresees them, or (None, None)."""
    logs = [case / name for name in ("log.before", "log.pimpleFoam") if (case / name).exists()]
    log = "".join(path.read_text(errors="replace") for path in logs)
    found = re.search(r"closed valve has (\S+) m2 in the mesh, and is\s+expected to drop (\S+) of", log)
    return (float(found[1]), float(found[2])) if found else (None, None)


def steps_of(case, closed_area):
    valve = rows_of(case, "valve", "riisValve.dat")
    flows = [rows_of(case, path.name, "surfaceFieldValue.dat") for path in (case / "postProcessing").glob("flow_*")]
    fastest = rows_of(case, "fastest", "fieldMinMax.dat")
    arterial = rows_of(case, "pressure_outlet", "surfaceFieldValue.dat")  # of an aortic valve only
    if not valve or not flows:
        sys.exit(f"report.py: {case} has no tables in postProcessing: ./Allrun makes them")
    options = (case / "system/fvOptions").read_text()
    resistance, half_thickness = number_after("resistance", options), number_after("halfThickness", options)
    rho = number_after("rho", options)
    steps = []
    for time in sorted(valve):
        if not all(time in table for table in [*flows, fastest]):
            continue  # the run was cut off while it wrote this step
        opening, difference, flow = map(float, valve[time][:3])
        # The columns of fieldMinMax are the field, the least value and the largest value. With several ranks, a rank follows each
        # value.
        speed = float(fastest[time][2 if len(fastest[time]) < 5 else 3])
        steps.append({"time": time, "opening": opening, "difference": difference, "flow": flow, "band": float(valve[time][8]),
                      "arterial": rho * float(arterial[time][0]) if time in arterial else None,
                      "orifice": float(valve[time][5]), "free": float(valve[time][6]), "fastest": speed,
                      "balance": sum(float(table[time][0]) for table in flows),
                      "leak": closed_area and -difference * half_thickness * closed_area / resistance})
    return steps


def picture_words(case):
    """Returns the arguments of riis for a picture of the last beat, at the written time with the largest flow."""
    valve = rows_of(case, "valve", "riisValve.dat")
    names = [path.parent.name for path in case.glob("*/U")]
    written = {float(name): name for name in names if re.fullmatch(r"[\d.e-]+", name)}
    end = max(valve, default=0.0)
    # The table of the valve gets the row of a time after the fields of this time are written.
    shown = [time for time in written if time in valve and time > end - period_of(case) - 1e-9]
    if not shown:
        sys.exit("report.py: no written time has a row in postProcessing/valve: there is nothing to draw yet")
    # While the valve still opens, the jet has not formed.
    is_open = [time for time in shown if float(valve[time][0]) > 0.999]
    time = max(is_open or shown, key=lambda time: float(valve[time][2]))
    return ["mark", written[time], "--valve", "placed.json", "--skirt", "@SKIRT@", "--wall", "wall.stl", "--half-thickness",
            "@HALF_THICKNESS@", "--opening", f"{float(valve[time][0]):.4g}", "--picture", "flow.png", "--picture-velocity", "U",
            "--view", "valve-long"]


def main():
    if sys.argv[1:] == ["--picture"]:
        print("\n".join(picture_words(CASE)))
        return 0
    if len(sys.argv) > 1:
        sys.exit(f"report.py takes --picture or nothing, but got '{' '.join(sys.argv[1:])}'")
    area, drop = forecast_of(CASE)
    text, status = beat_table(steps_of(CASE, area), period_of(CASE), drop)
    save_and_print(text, CASE)
    return status


if __name__ == "__main__":
    sys.exit(main())
