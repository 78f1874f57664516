# SPDX-License-Identifier: Apache-2.0
"""Draws a valve at some openings, from above and from the side, with its measures from a table of `riis states`."""

import csv
import math
import os
import re
from typing import NamedTuple

import numpy as np

from library import Refused, model, samples
from page import Figure, Panel, html_table, number, percent, read_file
from picture import DARK, GREY, LEAFLETS, TOP_VIEW, Faces, Picture, looking

SIZE, MARGIN, TOLERANCE = (480, 400), 26, 0.01
MOST_OPENINGS = 6  # at most this many pictures stand in a row
ORIFICE = (247, 196, 190)
# The housing is higher than the closed leaflets, so the leaflets lie inside it.
HOUSING_HEIGHT, HOUSING = 1.1, 2


class Subject(NamedTuple):
    title: str
    from_above: str
    from_the_side: str
    side: tuple
    leaflets: tuple
    disc: str  # the name of the disc that contains the orifice
    caption: str
    paper: str = "none: the paper has no such valve."


OF_CUSPS = (
    "from the aorta", "from the side and slightly above, the aorta up", looking((-0.5, 0.87, -0.3), (0, 0, 1)),
    ("right cusp", "left cusp", "non-coronary cusp"), "the inside of the attachment",
)  # fmt: skip
SUBJECTS = {
    "aortic": Subject(
        "The aortic valve of the paper, from its one state to an open state",
        *OF_CUSPS,
        "At opening 0 the valve is the paper's, which does not close: a hole stays in its middle. The open state follows from "
        "the same parameters and from <code>open_radius_ratio</code> and <code>commissure_expansion</code>.",
        "section 2.1 and table “Aortic valve parameters” for opening 0. The paper has no open state of this valve.",
    ),
    "trileaflet": Subject(
        "The trileaflet valve, from closed to open",
        *OF_CUSPS,
        "Three equal cusps, whose free edges meet along the lines from the commissures to the axis when the valve is closed. "
        "Only slivers at the wall stay uncovered then.",
    ),
    "coapting": Subject(
        "The coapting valve, from closed to open",
        *OF_CUSPS,
        "Three equal cusps that lie side by side in a coaptation zone when the valve is closed. Their free edges keep their "
        "length: the middle of an edge sinks at first, and rises again.",
    ),
    "mitral": Subject(
        "The mitral valve, from closed to open",
        "from the atrium",
        "from the posteromedial side, the ventricle down",
        looking((-1, 0, 0), (0, 0, 1)),
        ("anterior leaflet", "posterior leaflet"),
        "the inside of the annulus",
        "The saddle of the annulus flattens while the leaflets turn into the ventricle. The paper's free edges lengthen more "
        "than tissue does, and its open orifice is large: docs/theory/measures.md has published values.",
        "appendix, table of the mitral valve's parameters, of which <i>t</i> is the opening.",
    ),
    "bileaflet": Subject(
        "The bileaflet mechanical valve, from closed to open",
        "from downstream",
        "from the side and above, along the hinges; downstream is up",
        looking((0.05, 1, -0.42), (0, 0, 1)),
        ("leaflet x &gt; 0", "leaflet x &lt; 0"),
        "the disc of <code>radius</code>",
        "Rigid leaflets turn about hinges from 30 to 85 degrees. The pictures from the side show a housing, see-through, which "
        "the valve has for a <code>ring_height</code> above 0.",
    ),
}


class Table(NamedTuple):
    """A table of `riis states`: its columns by their names. `edges` is empty if the leaflets are rigid."""

    kind: str
    columns: dict
    edges: list
    areas: list


def read_table(path):
    """Reads a file KIND.csv from `riis states KIND.csv --valve KIND`. Refuses a table of another kind, other leaflets or other
    openings."""
    kind = os.path.basename(path)[: -len(".csv")]
    head, *rows = list(csv.reader(read_file(path, "r", encoding="utf-8").splitlines())) or [[]]
    if not head:
        raise Refused(f"{path}: cannot be read")
    columns = {name: [] for name in head}
    for line, row in enumerate(rows, 2):
        if len(row) != len(head):
            raise Refused(f"{path}: line {line}: {len(row)} cells under {len(head)} names")
        for name, cell in zip(head, row):
            if not re.fullmatch(r"[-+.0-9eE]+", cell):
                raise Refused(f"{path}: line {line}: '{cell}' is no number")
            columns[name].append(float(cell))
    if head[0] != "opening" or not rows:
        raise Refused(f"{path}: no table of openings")
    for name in head[1:]:
        if not re.fullmatch(r"orifice_perimeter|effective_area|.*_(edge|area)(_ratio)?", name):
            raise Refused(f"{path}: '{name}' is no measure of a state")
    edges = [name for name in head if name.endswith("_edge")]
    areas = [name for name in head if name.endswith("_area") and name not in ("orifice_area", "effective_area")]
    check_table(Table(kind, columns, edges, areas))
    return Table(kind, columns, edges, areas)


def check_table(table):
    name, openings = table.kind + ".csv", table.columns["opening"]
    if table.kind not in SUBJECTS:
        raise Refused(f"{name}: the page has no states of a valve '{table.kind}'")
    n_leaflets = len(SUBJECTS[table.kind].leaflets)
    for opening in openings:
        if not 0 <= opening <= 1:
            raise Refused(f"{name}: opening {number(opening)} is not from 0 to 1")
    if len(openings) > MOST_OPENINGS:
        raise Refused(f"{name}: {len(openings)} openings are more than {MOST_OPENINGS}")
    if len(table.areas) != n_leaflets or len(table.edges) > n_leaflets:
        raise Refused(f"{name}: {len(table.areas)} leaflets have an area, not {n_leaflets}")


def edge_of_disc(kind, valves, state):
    """Returns the edge of the disc that contains the orifice."""
    if kind == "mitral":
        return samples(state.mitral()["annulus"])
    if kind != "bileaflet":
        points = np.concatenate([samples(line) for cusp in state.cusps() for line in cusp["sinus"]])
        beside = points - np.mean(points, axis=0)
        ring = points[np.argsort(np.arctan2(beside[:, 1], beside[:, 0]))]
        return np.vstack([ring, ring[:1]])
    radius = {each["name"]: each["values"] for each in valves[kind]["parameters"]}["radius"][0]
    turn = np.linspace(0, 2 * math.pi, 181)
    return radius * np.stack([np.cos(turn), np.sin(turn), 0 * turn], axis=1)


def outlines(kind, state):
    """Returns the lines that bound the leaflets."""
    if kind == "mitral":
        lines = list(state.mitral().values())
    elif kind == "bileaflet":
        lines = [image["placed"][side] for image in state.images for side in ("v0", "v1")]
    else:
        lines = [line for cusp in state.cusps() for name in ("leaflet", "sinus") for line in cusp[name]]
    return [samples(line) for line in lines]


def disc_below(edge, z):
    """Returns the disc, shifted below everything else. Seen from above, the part of the disc that no leaflet covers is the
    orifice."""
    edge = edge * (1, 1, 0) + (0, 0, z)
    n = len(edge)
    first = np.arange(n - 1)
    corners = np.stack([first, first + 1, np.full(n - 1, n)], axis=1)
    return Faces(np.vstack([edge, np.mean(edge, axis=0)]), corners, np.tile(ORIFICE, (n - 1, 1)))


def panels_of(kind, valves, openings):
    """Draws all states at one scale: the first row from above, the second row from the side."""
    subject = SUBJECTS[kind]
    states = [model(kind, TOLERANCE, opening=opening) for opening in openings]
    discs = [edge_of_disc(kind, valves, state) for state in states]
    everything = [state.points for state in states] + discs
    housing = None
    if kind == "bileaflet":
        housing = model(kind, TOLERANCE, ring_height=HOUSING_HEIGHT).triangles(HOUSING, colours=(GREY,) * (HOUSING + 1))
        everything.append(housing.points[housing.corners.ravel()])
    to_fit = np.concatenate(everything)
    panels = []
    for view, name in ((TOP_VIEW, subject.from_above), (subject.side, subject.from_the_side)):
        for opening, state, disc in zip(openings, states, discs):
            picture = Picture(SIZE, view, to_fit, MARGIN)
            picture.add_title("opening " + number(opening))
            picture.add_curve(disc, GREY, 2.5)
            if view is TOP_VIEW:
                picture.add_faces(disc_below(disc, min(to_fit[:, 2])), "painted")
            elif housing:
                picture.add_faces(housing, "ghost")
            picture.add_faces(state.triangles(), "smooth")
            for line in outlines(kind, state):
                picture.add_curve(line, DARK, 3)
            panels.append(Panel(picture.png(), f"Opening {number(opening)}, {name}."))
    return panels


def cells_of(table, column):
    """Returns table cells: the values, and the changes since the closed valve if the table has them."""
    values = table.columns[column]
    shares, cells = table.columns.get(column + "_ratio"), [f"{values[0]:.2f}"]
    for i in range(1, len(values)):
        change = 100 * (shares[i] - 1) if shares else None
        if change is None:
            bracket = ""
        elif abs(change) < 0.05:
            bracket = " (0 %)"
        else:
            bracket = f" ({'−' if change < 0 else '+'}{abs(change):.1f} %)"
        cells.append(f"{values[i]:.2f}{bracket}")
    return cells


def html_of(table):
    leaflets = SUBJECTS[table.kind].leaflets
    rows = [["opening", *map(number, table.columns["opening"])]]
    rows += [[f"{leaflet}: free edge (cm)", *cells_of(table, name)] for leaflet, name in zip(leaflets, table.edges)]
    rows += [[f"{leaflet}: area (cm²)", *cells_of(table, name)] for leaflet, name in zip(leaflets, table.areas)]
    if "orifice_area" in table.columns:
        rows.append(["orifice (cm²)", *cells_of(table, "orifice_area")])
    return html_table(rows)


def states_figure(table, valves):
    subject, openings = SUBJECTS[table.kind], table.columns["opening"]
    key = [*zip(LEAFLETS, subject.leaflets), (ORIFICE, "orifice, seen from above")]
    if table.kind != "mitral":  # the annulus is drawn dark, like the leaflets' other edges
        key.append((GREY, "edge of " + subject.disc))
    edges, rigid = ("the length of each free edge, ", "") if table.edges else ("", ", which is none, as the leaflets are rigid")
    caption = (
        f"{subject.caption} Parameters: the defaults; tolerance {percent(TOLERANCE)}. The table has {edges}the area of each "
        f"leaflet and, in brackets, the change since opening {number(openings[0])}{rigid}. The orifice is the part of "
        f"{subject.disc} that the leaflets leave uncovered along the axis. This command writes these numbers: "
        f"<code>riis states {table.kind}.csv --valve {table.kind} --count {len(openings)}</code>."
    )
    panels = panels_of(table.kind, valves, openings)
    return Figure(subject.title, len(openings), panels, caption, subject.paper, key, html_of(table))


def how_to_show(kind):
    return (
        f"The states of the {kind} valve: <code>riis states {kind}.csv --valve {kind} --count 5</code>, then give draw_page.py "
        "the file."
    )
