# SPDX-License-Identifier: Apache-2.0
"""Checks the runs of ./run svmultiphysics: check.py RUNS COMMAND RUN... Each RUN is a folder in RUNS: the folder of a case, with
the tables riis_*.csv of uris_check.cpp.

    signs RUN...                           # both engines have the same box of nodes, and the same signs in it
    points RUN...                          # K and K u_valve equal a loop over all triangles; a valve at rest has no velocity
    switching RUN SOLVER DISTANCES         # the steps in which a valve turns, with each engine
    restart WHOLE OURS SOLVERS             # a continued run has the frames of the solver's own, and K of the whole run
    ranks ONE TWO                          # two ranks have the sums and pressures of one
    drop OURS SOLVERS AREA                 # the drop of the closed valve over (R/eps) u, with each engine
    cost RUN SOLVER                        # processor seconds of a step
    draw RUN SOLVER DISTANCES FILE.png     # pressures, flow and frames of a beat
"""
import csv
import pathlib
import re
import sys

EXACT = 1e-9  # K and K u_valve, over the largest value
RANKS = 1e-6  # pressures on two ranks, over the largest pressure


def require(holds, text):
    if not holds:
        raise SystemExit(f"check.py: not as it must be: {text}")


def rows_of(folder, name):
    """Returns the rows of all ranks, with numbers where the table has numbers."""
    rows = []
    for path in sorted(pathlib.Path(folder).glob(f"riis_{name}_*.csv")):
        with open(path, encoding="utf-8") as file:
            for row in csv.DictReader(file):
                require(None not in row.values(), f"{path} has whole lines")
                rows.append({key: value if key in ("valve", "mesh") else float(value) for key, value in row.items()})
    require(rows, f"{folder} has riis_{name}_*.csv")
    return rows


def name_of(folder):
    return pathlib.Path(folder).name


def frames_of(folder):
    """Returns the frame of each valve in each step: its count, and whether the valve closes. A valve at rest has the count 0."""
    frames = {}
    for row in rows_of(folder, "nodes"):
        count = row["count"] if row["count"] <= row["frames"] else 0
        frame = (int(count), int(row["closing"]))
        key = (int(row["step"]), row["valve"])
        require(frames.setdefault(key, frame) == frame, f"all ranks of {folder} have the same frames")
    return frames


def signs(*folders):
    print("Nodes of the solver's box, over all steps and ranks. Lost nodes are in the band, but not by the solver's distances.")
    print(f"  {'run':<16} {'steps':>5} {'frames':>6} {'nodes':>8} {'other box':>9} {'other sign':>10} {'in the band':>11}"
          f" {'lost':>6}")
    for folder in folders:
        rows = rows_of(folder, "nodes")
        shown = {(row["valve"], min(row["count"], row["frames"] + 1), row["closing"]) for row in rows}
        total = {name: int(sum(row[name] for row in rows)) for name in ("box", "other_box", "other_sign", "within", "lost")}
        print(f"  {name_of(folder):<16} {len({row['step'] for row in rows}):>5} {len(shown):>6} {total['box']:>8}"
              f" {total['other_box']:>9} {total['other_sign']:>10} {total['within']:>11} {total['lost']:>6}")
        require(total["box"] > 0 and total["within"] > 0, f"{folder}: nodes were compared")
        require(total["other_box"] == 0, f"{folder}: both engines have the same box, which differs at {total['other_box']} nodes")
        require(total["other_sign"] == 0, f"{folder}: the signs are the solver's, but {total['other_sign']} differ")


def points(*folders):
    print("Gauss points, over all steps and ranks, against a loop over all triangles.")
    print(f"  {'run':<16} {'points':>8} {'marked':>8} {'wrong':>6} {'K off by':>9} {'K u off by':>10} {'at rest':>8}"
          f" {'skipped':>8}")
    for folder in folders:
        rows, frames = rows_of(folder, "points"), frames_of(folder)
        worst = {}
        for error, largest in (("K_error", "largest_K"), ("K_u_error", "largest_K_u")):
            worst[error] = max((row[error] / row[largest] for row in rows if row[largest] > 0), default=0)
            require(all(row[error] == 0 for row in rows if row[largest] == 0),
                    f"{folder}: {error} is 0 where nothing is marked")
        total = {name: int(sum(row[name] for row in rows)) for name in ("points", "marked", "wrong", "solid")}
        # Returns the steps after a motion in which every valve is at rest.
        resting = {step for step, _ in frames if all(frames[key][0] == 0 for key in frames if key[0] == step)}
        moved = [row["step"] for row in rows if row["K_u"] > 0]
        after = [row for row in rows if moved and row["step"] in resting and row["step"] > min(moved)]
        print(f"  {name_of(folder):<16} {total['points']:>8} {total['marked']:>8} {total['wrong']:>6} {worst['K_error']:>9.1e}"
              f" {worst['K_u_error']:>10.1e} {len({row['step'] for row in after}):>8} {total['solid']:>8}")
        require(total["marked"] > 0 and max(row["largest_K"] for row in rows) > 0, f"{folder}: points were compared")
        require(total["wrong"] == 0, f"{folder}: {total['wrong']} points are wrongly marked")
        for error, value in worst.items():
            require(value <= EXACT, f"{folder}: {error} is at most {EXACT} of the largest value, not {value}")
        require(all(row["K_u"] == 0 for row in after), f"{folder}: a valve that rests again has no velocity")


def turns_of(folder):
    """Returns the steps in which a valve begins to open and to close."""
    frames, turns = frames_of(folder), {}
    for (step, valve), (count, closing) in sorted(frames.items()):
        if count == 1:
            turns.setdefault(valve, []).append(("closes" if closing else "opens", step))
    return turns


def switching(ours, solver, distances):
    print("The steps in which a valve begins to move.")
    found = {}
    for label, folder in (("solver", solver), ("riis's distances, the solver's K", distances), ("riis", ours)):
        found[label] = turns_of(folder)
        for valve, turns in found[label].items():
            print(f"  {label:<34} {valve}: " + ", ".join(f"{what} in step {step}" for what, step in turns))
    require(found["solver"], "a valve turns")
    require(found["riis's distances, the solver's K"] == found["solver"],
            "the solver's K from riis's distances turns the valve in the solver's steps")


def restart(whole, ours, solvers):
    first = min(step for step, _ in frames_of(ours))
    frames = [frames_of(folder) for folder in (whole, ours, solvers)]
    print(f"A run that continues with step {first}. A valve's count and direction, 0 at rest:")
    print(f"  {'step':>4} {'not stopped':>12} {'continued':>12} {'solver':>12}")
    for step, valve in sorted(frames[1]):
        row = [found.get((step, valve)) for found in frames]
        print(f"  {step:>4} " + " ".join(f"{'-' if frame is None else str(frame):>12}" for frame in row))
    require(frames[1] == frames[2], "the continued run shows the frames that the solver's own continued run shows")
    repeated = [frames[0].get((first - 1, valve)) == frame for (step, valve), frame in frames[1].items() if step == first]
    require(all(repeated), "the solver plays the last frame again")
    moving = [frame[0] > 1 for (step, _), frame in frames[1].items() if step == first]
    require(any(moving), "the valve moves when the run is continued")
    # Checks that the step that is played again has the same K as before.
    def sums_of(folder, step):
        return {(row["mesh"], row["gauss"], row["functions"]): (row["K"], row["K_u"])
                for row in rows_of(folder, "points") if row["step"] == step}

    again = sums_of(ours, first)
    for key, before in sums_of(whole, first - 1).items():
        for name, a, b in zip(("K", "K u_valve"), before, again[key]):
            require(abs(a - b) <= EXACT * abs(a), f"the sum of {name} is that of the run that was not stopped, {a}, not {b}")
    print("  the sums of K and K u_valve of the repeated step are those of the run that was not stopped")


def ranks(one, two):
    worst = 0
    totals = []
    for folder in (one, two):
        total = {}
        for row in rows_of(folder, "points"):
            key = (row["step"], row["mesh"], row["gauss"], row["functions"])
            total[key] = [a + row[name] for a, name in zip(total.get(key, (0, 0, 0)), ("points", "K", "K_u"))]
        totals.append(total)
    require(totals[0].keys() == totals[1].keys(), "both runs have the same steps and meshes")
    for key, ours in totals[0].items():
        require(ours[0] == totals[1][key][0], f"both runs have the same Gauss points in step {key[0]:g}")
        worst = max([worst] + [abs(a - b) / abs(a) for a, b in zip(ours[1:], totals[1][key][1:]) if a])
    before, after = means_of(one, "Pressure_average"), means_of(two, "Pressure_average")
    largest = max(abs(value) for row in before for value in row.values())
    off = max(abs(a[face] - b[face]) for a, b in zip(before, after) for face in a) / largest
    print(f"Two ranks, {len(before)} steps: the sums of K and K u_valve differ by {worst:.1e} of themselves, the mean"
          f" pressures of faces by {off:.1e} of the largest.")
    require(len(before) == len(after), "both runs have the same number of steps")
    require(worst <= 1e-12, f"the sums are equal to 1e-12, not {worst}")
    require(off <= RANKS, f"the pressures are equal to {RANKS}, not {off}")


def means_of(folder, quantity):
    """Returns the solver's values in each step, by face."""
    paths = sorted(pathlib.Path(folder).glob(f"*-procs/B_*_{quantity}.txt"))
    require(len(paths) == 1, f"{folder} has one *-procs/B_*_{quantity}.txt")
    lines = [line.split() for line in paths[0].read_text(encoding="ascii").splitlines() if line.strip() and line[0] != "#"]
    (names,) = [line[2:] for line in lines if line[:2] == ["step", "time"]]
    return [dict(zip(names, map(float, line[2:]))) for line in lines if line[0].isdigit()]


def drop(ours, solvers, area):
    case = (pathlib.Path(ours) / "solver.xml").read_text(encoding="utf-8")
    resistance, half_thickness = (float(re.search(rf"<{name}>([^<]*)<", case)[1]) for name in ("Resistance", "Closed_thickness"))
    print("The drop of the closed valve over (R/eps) u, in the last two steps:")
    found = {}
    for label, folder in (("the solver's engine", solvers), ("riis", ours)):
        pressures, flows = means_of(folder, "Pressure_average")[-2:], means_of(folder, "Velocity_flux")[-2:]
        found[label] = [(p["inlet"] - p["outlet"]) / (resistance / half_thickness * abs(q["outlet"]) / float(area))
                        for p, q in zip(pressures, flows)]
        print(f"  {label:<20} {found[label][0]:.4f} {found[label][1]:.4f}")
        require(abs(found[label][0] - found[label][1]) <= 2e-3 * found[label][1], f"{folder} is steady")
    require(found["the solver's engine"][1] < found["riis"][1] < 1,
            "exact K keeps more of the drop than the solver's K, and less than all")


def cost(ours, solver):
    def mean(rows, name, steps):
        values = [row[name] for row in rows if row["step"] in steps]
        return sum(values) / len(values)

    print("Mean processor seconds of a step in which the valve moves.")
    print(f"  {'engine':<8} {'nodes':>10} {'K of all Gauss points, first':>29} {'in each iteration':>18}")
    found = {}
    for label, folder in (("riis", ours), ("solver", solver)):
        moving = {step for (step, _), frame in frames_of(folder).items() if frame[0] > 0}
        require(moving, f"{folder}: the valve moves")
        nodes, gauss = rows_of(folder, "nodes"), rows_of(folder, "points")
        found[label] = [mean(nodes, "seconds", moving), mean(gauss, "seconds", moving), mean(gauss, "seconds_again", moving)]
        print(f"  {label:<8} {found[label][0]:>10.4f} {found[label][1]:>29.4f} {found[label][2]:>18.4f}")
    share = sum(found["riis"][:2]) / found["solver"][0]
    print(f"  riis takes {100 * share:.1f} % of the solver's time for its nodes")
    require(share < 0.5, "riis takes less than half of the solver's time")


def draw(ours, solver, distances, path):
    try:
        import matplotlib
    except ImportError:
        print("there is no matplotlib, so no picture is drawn")
        return
    matplotlib.use("Agg")
    import matplotlib.pyplot as plt
    figure, axes = plt.subplots(4, 1, figsize=(7, 9), sharex=True, layout="constrained")
    runs = (("solver", solver, "s-"), ("riis's distances, the solver's K", distances, "x-"), ("riis", ours, ".-"))
    for label, folder, style in runs:
        flows, nodes = means_of(folder, "Velocity_flux"), rows_of(folder, "nodes")
        steps = range(1, len(flows) + 1)
        axes[0].plot(steps, [row["low"] - row["high"] for row in means_of(folder, "Pressure_average")], style, label=label)
        axes[1].plot(steps, [row["high"] for row in flows], style)
        opening = {}
        for row in nodes:
            share = min(1, (row["count"] - 1) / (row["frames"] - 1))
            opening[row["step"]] = 1 - share if row["closing"] else share
        axes[2].plot(list(opening), list(opening.values()), style)
        seconds = {row["step"]: row["seconds"] for row in nodes}
        axes[3].semilogy(list(seconds), [max(value, 1e-4) for value in seconds.values()], style)
    for axis, label in zip(axes, ("pressure drop, dyn/cm2", "flow, ml/s", "opening", "marking the nodes, s")):
        axis.set_ylabel(label)
        axis.grid(alpha=0.3)
    axes[0].legend()
    axes[-1].set_xlabel("step")
    figure.savefig(path, dpi=90)


# Each command with its smallest number of runs, and whether a word follows the runs.
COMMANDS = {"signs": (signs, 1, False), "points": (points, 1, False), "switching": (switching, 3, False),
            "restart": (restart, 3, False), "ranks": (ranks, 2, False), "drop": (drop, 2, True), "cost": (cost, 2, False),
            "draw": (draw, 3, True)}


def main(runs, command, *words):
    check, least, word_follows = COMMANDS[command]
    names, rest = (words[:-1], words[-1:]) if word_follows else (words, ())
    if len(names) < least:
        sys.exit(__doc__)
    check(*(pathlib.Path(runs) / name for name in names), *rest)


if __name__ == "__main__":
    if len(sys.argv) < 4 or sys.argv[2] not in COMMANDS:
        sys.exit(__doc__)
    main(*sys.argv[1:])
