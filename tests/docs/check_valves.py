# SPDX-License-Identifier: Apache-2.0
"""Checks examples/valves: its script must reproduce the file of the bicuspid valve, and the table in its README must equal the
program's results. The least ratios in the table are the ratios over 101 openings. The check measures a tenth of these openings,
so its least ratio can only be larger. With RIIS_TEST_LONG=1 it measures all.

Checks docs/diseases.md: its table must have all diseases of the program with their areas. Measured areas must agree within 3 %.

    check_valves.py EXAMPLES_VALVES PROGRAM DISEASES.md
"""
import csv
import io
import os
import re
import subprocess
import sys
from pathlib import Path

VALVES = {
    "pulmonary": ["--valve", "trileaflet", "--params", "pulmonary.json"],
    "stenotic": ["--valve", "trileaflet", "--params", "stenotic.json"],
    "bicuspid": ["--valve", "bicuspid.json"],
}


COUNT = 101 if os.environ.get("RIIS_TEST_LONG") == "1" else 11
MOST_ABOVE = 0.0051 if COUNT == 101 else 0.02  # of a least ratio


def measured(program, folder, arguments):
    """Returns the least ratio of a free edge's length to its closed length. Also returns the last orifice."""
    command = [program, "states", "-", "--count", str(COUNT), *arguments]
    run = subprocess.run(command, cwd=folder, capture_output=True, text=True, check=True)
    rows = list(csv.DictReader(io.StringIO(run.stdout)))
    assert len(rows) == COUNT, len(rows)
    edges = [float(value) for row in rows for name, value in row.items() if name.endswith("_edge_ratio")]
    return min(edges), float(rows[-1]["orifice_area"])


def faults_of_diseases(program, page):
    """Compares the page's table with the program's list, and measures each area."""
    listed = subprocess.run([program, "help", "diseases"], capture_output=True, text=True, check=True).stdout
    areas = {}
    for name, kind, opening, wanted in re.findall(r"^([a-z]+_\w+) +(\w+) +(?:(open|gap) ([0-9.]+))?", listed, re.M):
        areas[name] = (kind, opening, wanted)
    rows = re.findall(r"^\| `(\w+)` \|.*\| (?:(open|gap))? ?\| ([0-9.]*) ?\| ([0-9.]*) ?\|$", page, re.M)
    if [row[0] for row in rows] != list(areas):
        yield f"diseases.md has {[row[0] for row in rows]}, riis help diseases {list(areas)}"
    for name, opening, wanted, told in rows:
        if (opening, wanted) != areas.get(name, ("",) * 3)[1:]:
            yield f"{name}: diseases.md says {opening} {wanted}, riis help diseases says {areas.get(name)}"
        command = [program, "states", "-", "--count", "2", "--valve", name]
        run = subprocess.run(command, capture_output=True, text=True, check=False)
        if run.returncode != 0:
            yield f"{name}: {run.stderr}"
        elif wanted:
            area = float(list(csv.DictReader(io.StringIO(run.stdout)))[opening == "open"]["orifice_area"])
            if abs(area - float(told)) > 0.0051 or abs(area - float(wanted)) > 0.03 * float(wanted):
                yield f"{name}: diseases.md says {told} for {wanted}, riis measures {area:.4f}"


def main():
    folder, program = Path(sys.argv[1]), str(Path(sys.argv[2]).resolve())
    written = subprocess.run([sys.executable, "-B", "bicuspid.py"], cwd=folder, capture_output=True, text=True, check=True)
    faults = []
    if written.stdout != (folder / "bicuspid.json").read_text():
        faults.append("bicuspid.json is not what bicuspid.py writes")
    readme = (folder / "README.md").read_text()
    for name, arguments in VALVES.items():
        row = re.search(rf"^\| {name} \| ([0-9.]+) \| ([0-9.]+) \|$", readme, re.M)
        if not row:
            faults.append(f"README.md has no row of measured values for {name}")
            continue
        values = zip(("free edge", "orifice"), row.groups(), measured(program, folder, arguments), (MOST_ABOVE, 0.0051))
        for what, told, value, most in values:
            if not -0.0051 <= value - float(told) <= most:
                faults.append(f"{name}: README.md says {what} {told}, riis measures {value:.4f}")
    faults += faults_of_diseases(program, Path(sys.argv[3]).read_text())
    for fault in faults:
        print(fault)
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
