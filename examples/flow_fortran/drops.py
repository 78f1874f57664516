#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Computes the pressure drops of standing aortic valves with the program `drop`, and compares them with two formulas. The script
keeps finished runs in FOLDER/runs.csv, so it can continue after a stop. The script leaves the table in FOLDER/drops.md and a plot
in FOLDER/drops.png.

usage: drops.py PROGRAM FOLDER [--short]"""
import csv
import pathlib
import subprocess
import sys

RHO, MMHG = 1060.0, 133.322
GORLIN = 44.3  # cm2, ml/s and mmHg: the constant of Gorlin's formula for the aortic valve
KINDS = ("aortic", "coapting", "trileaflet")
OPENINGS = (0.25, 0.5, 1.0)
# The names of the program's options, and the columns of its results that have these values.
OPTIONS = {"kind": "kind", "opening": "opening", "flow_rate": "flow_ml_s", "cells": "cells", "eps": "eps_mm", "offset": "offset"}
HEAD = """| kind | opening | flow, ml/s | ε, mm | ε/h | o | A, cm² | drop, mmHg | ρQ²/2A² | Gorlin | drop over ρQ²/2A² \
| of it the band | of it the rest | lasting | ± |
|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|
"""


def stop(text):
    sys.exit(f"drops.py: {text}")


def run(kind, opening, flow=250.0, cells=24, eps=1.5, offset=0.0):
    """Describes a run. The flow is in ml/s and eps in mm."""
    return {"kind": kind, "opening": opening, "flow_rate": flow, "cells": cells, "eps": eps, "offset": offset}


def all_runs(short):
    """Returns the runs in the order in which they are computed."""
    both = (0.0, 0.75)
    runs = [run("trileaflet", opening, offset=offset) for opening in OPENINGS for offset in both]
    if short:
        return runs
    runs += [run(kind, opening, offset=offset) for kind in KINDS[:2] for opening in OPENINGS for offset in both]
    runs += [run("trileaflet", 0.5, flow=flow, offset=offset) for flow in (100.0, 400.0) for offset in both]
    runs += [run("trileaflet", opening, offset=0.5) for opening in OPENINGS]
    runs += [run("trileaflet", opening, cells=36, eps=1.0, offset=offset) for opening in OPENINGS for offset in both]
    runs += [run(kind, opening, cells=36, offset=offset) for kind in KINDS[::-1] for opening in OPENINGS for offset in both]
    return runs


def words_of(one):
    values = {**one, "kind": f"'{one['kind']}'", "eps": f"{one['eps']}e-3"}
    return [f"{name}={value}" for name, value in values.items()]


def is_of(row, one):
    """Tells whether a row of the table has the results of a run."""
    return row["kind"] == one["kind"] and all(abs(float(row[column]) - one[name]) < 1e-9
                                              for name, column in OPTIONS.items() if name != "kind")  # fmt: skip


def read_rows(path):
    if not path.is_file():
        return []
    with open(path, encoding="ascii", newline="") as file:
        return list(csv.DictReader(file))


def compute(program, one):
    """Runs the program. Returns the results of the run as a dict of texts."""
    done = subprocess.run([program, *words_of(one)], capture_output=True, text=True, check=False)
    if done.returncode != 0:
        stop(f"{program} {' '.join(words_of(one))} failed: {done.stderr.strip()}")
    names, values = done.stdout.splitlines()[-2:]
    return dict(zip(names.split(","), values.split(",")))


class Drop:
    """One run with the drops of both formulas, in mmHg."""

    def __init__(self, row):
        self.kind = row["kind"]
        for name, value in row.items():
            if name != "kind":
                setattr(self, name, float(value))
        self.bernoulli = RHO / 2 * (self.flow_ml_s / self.area_cm2 * 1e-2) ** 2 / MMHG
        self.gorlin = (self.flow_ml_s / (GORLIN * self.area_cm2)) ** 2
        self.ratio = self.drop_mmHg / self.bernoulli
        self.band = (self.area_cm2 / self.effective_cm2) ** 2
        self.rest = self.ratio / self.band

    def line(self):
        return (f"| {self.kind} | {self.opening:g} | {self.flow_ml_s:g} | {self.eps_mm:g} | {self.eps_mm / self.h_mm:g} "
                f"| {self.offset:g} | {self.area_cm2:.2f} | {self.drop_mmHg:.3g} | {self.bernoulli:.3g} | {self.gorlin:.3g} "
                f"| {self.ratio:.2f} | {self.band:.2f} | {self.rest:.2f} | {self.lasting_mmHg:.3g} "
                f"| {self.apart_percent:.1f} % |\n")  # fmt: skip


def draw(drops, path):
    """Draws the drop over the opening for each kind, at one flow and on the finest grid, together with both formulas."""
    try:
        import matplotlib
    except ImportError:
        print("matplotlib is missing: the plot is left out")
        return
    matplotlib.use("Agg")
    import matplotlib.pyplot as plt

    kinds = [kind for kind in KINDS if any(drop.kind == kind for drop in drops)]
    plt.rcParams.update({"font.size": 10, "axes.titlesize": 11})
    figure, axes = plt.subplots(1, len(kinds), figsize=(2.6 * len(kinds) + 0.7, 4.2), sharey=True, squeeze=False,
                                layout="constrained")
    cells = max(drop.cells for drop in drops)
    for one, kind in zip(axes[0], kinds):
        mine = sorted((drop for drop in drops if (drop.kind, drop.flow_ml_s, drop.cells) == (kind, 250, cells)),
                      key=lambda drop: drop.opening)  # fmt: skip
        for offset, colour in ((0, "#d55e00"), (0.5, "#009e73"), (0.75, "#0072b2")):
            for eps, style in zip(sorted({drop.eps_mm for drop in drops}), ("o-", "s--")):
                line = [drop for drop in mine if (drop.offset, drop.eps_mm) == (offset, eps)]
                if line:
                    one.plot([drop.opening for drop in line], [drop.drop_mmHg for drop in line], style, color=colour,
                             label=f"offset {offset:g}, ε = {eps:g} mm = {eps / line[0].h_mm:g} h")  # fmt: skip
        for name, style, text in (("bernoulli", ":", "Bernoulli, ρQ²/2A²"), ("gorlin", "-.", "Gorlin")):
            formula = {drop.opening: getattr(drop, name) for drop in mine}
            one.plot(list(formula), list(formula.values()), style, color="k", label=text)
        one.set_title(f"{kind}, 250 ml/s")
        one.set_yscale("log")
        one.set_xlabel("opening")
        one.grid(alpha=0.3, which="both")
    axes[0, 0].set_ylabel("drop from rest to the jet, mmHg")
    figure.get_layout_engine().set(rect=(0, 0.2, 1, 0.8))
    figure.legend(*axes[0, -1].get_legend_handles_labels(), loc="lower center", ncols=2, frameon=False)
    figure.savefig(path, dpi=110)
    plt.close(figure)


def main():
    words = sys.argv[1:]
    short = "--short" in words
    words = [word for word in words if word != "--short"]
    if len(words) != 2:
        stop("usage: drops.py PROGRAM FOLDER [--short]")
    program, folder = words[0], pathlib.Path(words[1])
    folder.mkdir(parents=True, exist_ok=True)
    table = folder / "runs.csv"
    runs = all_runs(short)
    for number, one in enumerate(runs, start=1):
        if any(is_of(row, one) for row in read_rows(table)):
            continue
        row = compute(program, one)
        is_new = not table.is_file()
        with open(table, "a", encoding="ascii", newline="") as file:
            writer = csv.DictWriter(file, list(row))
            if is_new:
                writer.writeheader()
            writer.writerow(row)
        print(f"{number} of {len(runs)}: {' '.join(words_of(one))}: {float(row['drop_mmHg']):.2f} mmHg, {row['seconds']} s",
              flush=True)  # fmt: skip
    rows = read_rows(table)
    drops = [Drop(next(row for row in rows if is_of(row, one))) for one in runs]
    drops.sort(key=lambda drop: (drop.kind, drop.opening, drop.flow_ml_s, drop.eps_mm, -drop.h_mm, drop.offset))
    text = HEAD + "".join(drop.line() for drop in drops)
    (folder / "drops.md").write_text(text, encoding="utf-8")
    print(text, end="")
    draw(drops, folder / "drops.png")


if __name__ == "__main__":
    main()
