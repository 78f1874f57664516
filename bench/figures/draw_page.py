#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Draws the geometry into one page. The page begins with the paper's figures. Then it shows valves at the openings in the
KIND.csv tables of `riis states`, and the pictures that the GIVEN.json files name.

draw_page.py FOLDER FILE.html [GIVEN.json|KIND.csv...]: FOLDER has the programs riis and riis-figures."""

import os
import sys

from vtkmodules.vtkCommonCore import vtkOutputWindow, vtkStringOutputWindow

import geometry_figures
import library
import measured_figures
import states
from library import Refused
from page import page_of, read_figures
from picture import held_display

OF_PAPER = (
    geometry_figures.bezier_figure, geometry_figures.coons_figure, geometry_figures.aortic_valve_figure,
    geometry_figures.aortic_cusp_figure, geometry_figures.mitral_curves_figure, geometry_figures.mitral_surfaces_figure,
    geometry_figures.mitral_quads_figure, measured_figures.marking_figure, geometry_figures.tolerance_figure,
    measured_figures.accuracy_figure, measured_figures.accuracy_distribution_figure,
)  # fmt: skip


def draw(path, given):
    try:
        with open(path, "w", encoding="utf-8"):  # a wrong path and faults of given files are refused before anything is drawn
            pass
    except OSError:
        raise Refused(f"{path}: cannot be written") from None
    tables = [states.read_table(each) for each in given if each.endswith(".csv")]
    read = [read_figures(each) for each in given if not each.endswith(".csv")]
    kinds = [table.kind for table in tables]
    left_out = [text for _, texts in read for text in texts]
    left_out += [states.how_to_show(kind) for kind in states.SUBJECTS if kind not in kinds]
    if not os.environ.get("DISPLAY"):
        raise Refused("there is no display; xvfb-run provides one")
    held = held_display()
    messages = vtkStringOutputWindow()
    vtkOutputWindow.SetInstance(messages)
    valves = library.written("--curves")
    figures = []
    for make in [*OF_PAPER, *((lambda table=table: states.states_figure(table, valves)) for table in tables)]:
        figures.append(make())
        if messages.GetOutput():
            raise Refused(messages.GetOutput())
        print(f"figure {len(figures)}: {figures[-1].title}", flush=True)
    held.Finalize()
    figures += [figure for each, _ in read for figure in each]
    version = library.run("riis", "--version").split()[1]
    with open(path, "w", encoding="utf-8") as file:
        file.write(page_of(version, figures, left_out, {kind: valves[kind] for kind in states.SUBJECTS}))


def main(arguments):
    if len(arguments) < 2:
        print("usage: draw_page.py FOLDER FILE.html [GIVEN.json|KIND.csv...]", file=sys.stderr)
        return 2
    folder, path, *given = arguments
    library.programs.update({name: os.path.join(folder, name) for name in ("riis", "riis-figures")})
    try:
        draw(path, given)
    except Refused as why:
        print(f"draw_page.py: {why}", file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
