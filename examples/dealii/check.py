# SPDX-License-Identifier: Apache-2.0
"""Checks the runs of ./run dealii: `check.py COMMAND ARGUMENT...`. Each run has a folder that contains steps.csv and
cells-*.csv."""
import csv
import pathlib
import subprocess
import sys

import numpy

EQUAL = 1e-6  # runs on several ranks and a restarted run must agree to this share of the largest value
DENSITY, LENGTH = 1060, 0.06  # of the blood, kg/m3, and of the duct of beat.prm, m
# The limits of the leak, divided by drop eps / R times the area of the leaflets. The limits of the leak were set after the first
# beat, in which the ratio was 0.69. Probably the walls cut off a part of the leaflets, and the bands of touching leaflets
# overlap.
LEAK = (0.5, 1.1)
FIELDS = {"velocity": ("u", "v", "w"), "pressure": ("p",), "K": ("K",), "K u_valve": ("K_u", "K_v", "K_w")}


def require(holds, text):
    if not holds:
        raise SystemExit(f"check.py: not as it must be: {text}")


def steps_of(folder):
    """Returns the table of a run's steps, as a dictionary of columns."""
    with open(pathlib.Path(folder) / "steps.csv", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    require(rows, f"{folder} has steps")
    return {name: numpy.array([float(row[name]) for row in rows]) for name in rows[0]}


def cells_of(folder):
    """Returns the cells of a run's last step, of all ranks: the sorted ids, and columns in the same order."""
    rows = []
    for path in sorted(pathlib.Path(folder).glob("cells-*.csv")):
        with open(path, encoding="utf-8") as file:
            rows += list(csv.DictReader(file))
    require(rows, f"{folder} has cells")
    rows.sort(key=lambda row: row["id"])
    ids = [row["id"] for row in rows]
    require(len(set(ids)) == len(ids), f"each cell of {folder} belongs to one rank")
    return ids, {name: numpy.array([float(row[name]) for row in rows]) for name in rows[0] if name != "id"}


def difference(ours, theirs):
    """Returns the largest difference of each field of two runs, divided by the field's largest value."""
    (ids, here), (other_ids, there) = ours, theirs
    require(ids == other_ids, f"both runs have the same cells, not {len(ids)} and {len(other_ids)} others")
    found = {}
    for name, columns in FIELDS.items():
        a, b = (numpy.stack([cells[column] for column in columns]) for cells in (here, there))
        require(numpy.isfinite(a).all() and numpy.isfinite(b).all(), f"{name} is finite")
        largest = numpy.abs(a).max()
        found[name] = numpy.abs(a - b).max() / largest if largest > 0 else numpy.abs(b).max()
    return found


def same(*folders):
    """Compares the last step of each run with that of the first run. Runs with a later start are restarts."""
    first, *others = map(pathlib.Path, folders)
    ours, steps = cells_of(first), steps_of(first)
    require(numpy.abs(ours[1]["K_u"]).max() > 0, "the valve moves in the step that is compared")
    print(f"Largest differences from {first.name} at step {int(steps['step'][-1])}, over the largest value.")
    print(f"  {'run':<12} {'cells':>6}" + "".join(f" {name:>10}" for name in FIELDS))
    for folder in others:
        theirs = cells_of(folder)
        last = steps_of(folder)["step"][-1]
        require(last == steps["step"][-1], f"{folder.name} ends with the same step, not with {last}")
        found = difference(ours, theirs)
        print(f"  {folder.name:<12} {len(ours[0]):>6}" + "".join(f" {value:>10.1e}" for value in found.values()))
        for name, value in found.items():
            require(value <= EQUAL, f"{folder.name}: {name} differs by at most {EQUAL}, not by {value}")


def drops(*runs):
    """Checks the drop across a plate that closes a duct. Each run is FOLDER:ELEMENTS:HALF THICKNESS:R:SPEED:SECONDS."""
    print("The drop across the closed plate, over (R / eps) u. Expected is the share of K that the quadrature finds.")
    print(f"  {'elements':<24} {'step, ms':>8} {'eps / h':>7} {'expected':>8} {'measured':>8} {'measured / expected':>19}")
    for run in runs:
        folder, elements, *numbers = run.split(":")
        eps, resistance, speed, seconds = map(float, numbers)
        steps = steps_of(folder)
        flow = steps["outflow"][-1] / steps["area"][-1]
        require(abs(flow / speed - 1) < 1e-5, f"{folder}: the speed is {speed} m/s, not {flow}")
        measured, expected = steps["drop"][-1] / (resistance / eps * speed), steps["share"][-1]
        print(f"  {elements:<24} {1e3 * seconds:>8g} {steps['eps_h'][-1]:>7.2f} {expected:>8.3f} {measured:>8.3f}"
              f" {measured / expected:>19.3f}")
        require(abs(measured / expected - 1) < 0.03, f"{folder}: the drop is within 3 % of the expected one")
        require(abs(measured - 1) < 0.1, f"{folder}: the drop is within 10 % of the closed form")


def plate(folder, speed):
    """Checks that a moving plate between equal pressures moves the blood at the speed of the plate."""
    steps, speed = steps_of(folder), float(speed)
    flow = steps["outflow"][-1] / steps["area"][-1]
    print(f"A plate moves at {speed:g} m/s between equal pressures: the blood flows at {flow:.6f} m/s.")
    require(abs(flow / speed - 1) < 0.01, f"the blood has the plate's speed to 1 %, not {flow}")


def beat(folder, half_thickness, resistance):
    """Checks the beating valve: it opens and closes, inflow equals outflow, and the closed valve holds."""
    steps = steps_of(folder)
    opening, flow, drop, speed = steps["opening"], steps["outflow"], steps["drop"], steps["largest_speed"]
    is_open, largest = opening == 1, numpy.abs(flow).max()
    require(is_open.any() and opening[0] < 1, "the valve opens")
    last_open = numpy.flatnonzero(is_open)[-1]
    shut = numpy.flatnonzero(opening[last_open:] == 0)
    require(len(shut) > 1 and opening[-1] == 0, "the valve closes again, and stays so for two steps")
    shut = last_open + shut[1:]  # not the step in which the leaflets arrive
    balance, leak = numpy.abs(steps["inflow"] - flow).max() / largest, numpy.abs(flow[shut]).max() / largest
    most = shut[numpy.abs(drop[shut]).argmax()]
    share = flow[most] / (drop * float(half_thickness) / float(resistance) * steps["leaflet_area"])[most]
    # The leaflets stop the column of blood in the duct. The inertia of the blood in the duct adds to the drop at the valve.
    hammer = DENSITY * LENGTH * numpy.abs(numpy.gradient(flow, steps["time"]) / steps["area"])
    bernoulli = (2 * (numpy.abs(drop) + hammer).max() / DENSITY) ** 0.5
    print("The trileaflet valve beats:")
    for i in range(0, len(opening), 2):
        print(f"  {steps['time'][i]:.3f} s: opening {opening[i]:.3f}, drop {drop[i]:8.2f} Pa, flow {1e6 * flow[i]:8.3f} ml/s,"
              f" at most {speed[i]:.3f} m/s, {int(steps['cells'][i])} cells, {int(steps['iterations'][i])} iterations")
    print(f"  flow {1e6 * flow.min():.2f} to {1e6 * flow.max():.2f} ml/s; inflow and outflow differ by {balance:.1e}"
          f" of the largest; the closed valve passes {100 * leak:.2f} %, which is {share:.3f} of drop eps / R times its area")
    print(f"  speeds up to {speed.max():.3f} m/s; sqrt(2 drop / rho) is at most {bernoulli:.3f} m/s, with the"
          " inertia of the blood in the duct as a part of the drop")
    print(f"  eps/h {steps['eps_h'].min():.2f} to {steps['eps_h'].max():.2f}, {int(steps['cells'].min())} to"
          f" {int(steps['cells'].max())} cells, {int(steps['unknowns'].min())} to {int(steps['unknowns'].max())} unknowns,"
          f" {int(steps['iterations'].min())} to {int(steps['iterations'].max())} iterations")
    require(balance < 1e-6, f"inflow and outflow are equal to 1e-6 of the largest flow, not {balance}")
    require(leak < 0.02, f"the closed valve passes less than 2 % of the largest flow, not {leak}")
    require(LEAK[0] < share < LEAK[1], f"the closed valve passes {LEAK} of what R lets through, not {share}")
    require(speed.max() < 2 * bernoulli, f"no speed exceeds {2 * bernoulli:.2f} m/s, as {speed.max():.2f} does")


def plot(folder, path):
    """Draws opening, drop, flow and largest speed of the beating valve over time."""
    import matplotlib
    matplotlib.use("Agg")
    import matplotlib.pyplot as plt
    steps = steps_of(folder)
    figure, axes = plt.subplots(4, 1, figsize=(7, 7), sharex=True, layout="constrained")
    for axis, name, unit, factor in zip(axes, ("opening", "drop", "outflow", "largest_speed"), ("", ", Pa", ", ml/s", ", m/s"),
                                        (1, 1, 1e6, 1)):
        axis.plot(steps["time"], factor * steps[name], ".-", color="black")
        axis.axhline(0, color="grey", linewidth=0.5)
        axis.set_ylabel(name.replace("_", " ") + unit)
    axes[-1].set_xlabel("time, s")
    figure.savefig(path, dpi=80)


def refined(folder, half_thickness):
    """Checks that every cell that the band touches is as small as the smallest cells nearby."""
    _, cells = cells_of(folder)
    band = cells["K"] > 0
    size = cells["edge"][band]
    print(f"In the last step {band.sum()} of {len(band)} cells are in the band. Their edges are {1e3 * size.min():.2f} to"
          f" {1e3 * size.max():.2f} mm, and {1e3 * cells['edge'].max():.2f} mm elsewhere;"
          f" eps is {1e3 * float(half_thickness):g} mm.")
    require(size.max() < 0.75 * cells["edge"].max(), "cells in the band are smaller than the largest cells")


def refusals(program, folder, *files):
    """Checks wrong entries and other bad input. Each bad input must be refused, with these words."""
    beats, closed = files
    unknown, folder = "subsection {0}\nset {1} = {2}\nend\n", pathlib.Path(folder)
    cases = (
        ("an unknown entry", beats, unknown.format("Valve", "Resistence", 1), "Resistence"),
        ("an unknown subsection", beats, unknown.format("Valves", "Kind", "mitral"), "Valves"),
        ("text for a number", beats, unknown.format("Run", "Time step", "short"), "Time step"),
        ("a number below its range", beats, unknown.format("Valve", "Half thickness", -1), "Half thickness"),
        ("a part of a step", beats, unknown.format("Run", "Steps", 1.5), "Steps"),
        ("a word that is no choice", beats, unknown.format("Duct", "Shape", "oval"), "Shape"),
        ("a line without an entry", beats, "Steps = 3\n", "Steps = 3"),
        ("a subsection without end", beats, "subsection Run\nset Steps = 1\n", "end"),
        ("no function of time", beats, unknown.format("Inlet", "Pressure", "500 * sine(t)"), "Inlet/Pressure: '500 * sine(t)'"),
        ("an unknown kind", beats, unknown.format("Valve", "Kind", "pulmonary"), "pulmonary"),
        ("an unknown parameter of the valve", beats, unknown.format("Valve", "Parameters", "anulus=2"), "anulus"),
        ("a parameter out of its range", beats, unknown.format("Valve", "Parameters", "root_radius=-1"), "root_radius"),
        ("a parameter without a number", beats, unknown.format("Valve", "Parameters", "root_radius=wide"), "wide"),
        ("a parameter without a value", beats, unknown.format("Valve", "Parameters", "root_radius"),
         "'root_radius' is not NAME=VALUE"),
        ("a plate with a round duct", closed, unknown.format("Duct", "Shape", "round"), "Valve/Kind"),
        ("a law without pressures", beats, unknown.format("Inlet", "Type", "speed"), "Valve/Law"),
        ("a valve outside the mesh", beats, unknown.format("Valve", "Position", 1), "step 1: no quadrature point"),
        ("a folder that is not there", beats, unknown.format("Run", "Folder", "nowhere"),
         "Run/Folder: there is no folder 'nowhere'"),
        ("no saved state", beats, unknown.format("Run", "Restart from", "."), "Run/Restart from: there is no saved state"),
        ("too few iterations", closed, unknown.format("Run", "Iterations", 2), "Run/Iterations"),
    )
    folder.mkdir(parents=True, exist_ok=True)
    for name, file, text, words in cases:
        (folder / "wrong.prm").write_text(text, encoding="utf-8")
        refuse(name, [program, file, "wrong.prm"], folder, words)
    refuse("a file that is not there", [program, "absent.prm"], folder, "there is no parameter file 'absent.prm'")
    refuse("no file", [program], folder, "usage: valve_flow FILE.prm")


def refuse(name, command, folder, words):
    answer = subprocess.run(command, cwd=folder, capture_output=True, text=True, check=False)
    said = " ".join(answer.stderr.split())
    require(answer.returncode == 1, f"{name}: status 1, not {answer.returncode}: {said}")
    require(words in said and said.count("valve_flow:") >= 1, f"{name}: the message has '{words}', not '{said}'")
    print(f"  {name + ':':<36} {said}")


def another(program, base, folder, saved):
    """The saved state of another valve is refused."""
    folder = pathlib.Path(folder)
    (folder / "wrong.prm").write_text(
        f"subsection Valve\nset Resistance = 7\nend\nsubsection Run\nset Restart from = {saved}\nend\n", encoding="utf-8")
    refuse("the state of another valve", [program, base, "wrong.prm"], folder, "is of another valve")


def picture(folder, path):
    """Draws the speed in the cells that the plane y = 0 cuts, at the end of the run, and the resistance."""
    import matplotlib
    matplotlib.use("Agg")
    import matplotlib.pyplot as plt
    from matplotlib.collections import PatchCollection
    from matplotlib.patches import Rectangle
    _, cells = cells_of(folder)
    steps = steps_of(folder)
    cut = (cells["y"] > 0) & (cells["y"] < 0.9 * cells["edge"])
    x, z, edge = (1e3 * cells[name][cut] for name in ("x", "z", "edge"))
    figure, axes = plt.subplots(figsize=(10, 4.4), layout="constrained")
    patches = PatchCollection([Rectangle((a - e / 2, b - e / 2), e, e) for a, b, e in zip(x, z, edge)], edgecolor="white",
                              linewidth=0.5)
    speed = numpy.sqrt(sum(cells[name][cut] ** 2 for name in "uvw"))
    patches.set_array(speed)
    axes.add_collection(patches)
    axes.quiver(x, z, cells["u"][cut], cells["w"][cut], color="white", width=0.002)
    band = cells["K"][cut] > 0
    axes.scatter(x[band], z[band], s=14, color="red", label="cells in the band")
    axes.set_xlim(0, 60)
    axes.set_ylim(-14, 14)
    axes.set_aspect("equal")
    axes.set_xlabel("x, mm; blood flows to the right")
    axes.set_ylabel("z, mm")
    axes.legend(loc="upper right")
    axes.set_title(f"{steps['time'][-1]:.2f} s, opening {steps['opening'][-1]:.2f}, flow {1e6 * steps['outflow'][-1]:.0f} ml/s")
    figure.colorbar(patches, ax=axes, label="speed, m/s", shrink=0.8)
    figure.savefig(path, dpi=80)


if __name__ == "__main__":
    commands = {"same": same, "drops": drops, "plate": plate, "beat": beat, "refined": refined, "refusals": refusals,
                "another": another, "picture": picture, "plot": plot}
    if len(sys.argv) < 2 or sys.argv[1] not in commands:
        raise SystemExit(f"usage: check.py {'|'.join(commands)} ARGUMENT...")
    commands[sys.argv[1]](*sys.argv[2:])
