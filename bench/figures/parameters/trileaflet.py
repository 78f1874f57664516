# SPDX-License-Identifier: Apache-2.0
"""Draws the meaning of the trileaflet valve's parameters on its right cusp (docs/theory/trileaflet.md)."""

import math

import aortic
from aortic import BENDING, LEAFLET, SINUS, SYMMETRY, plan, section
from sheet import DARK, GREY, PALE, SMALL, Sheet, along, distance, plain

INNER_PLACES = {"xq": (1.3, 0.6), "zq": (1.3, 0.38), "inner": (1.3, 0.18), "middle": (1.3, 0.8)}
AXIS = (0, (8, 3, 2, 3))


def draw_plan(sheet, cusp):
    panel = sheet.panel((0.15, 4.7), (7.0, 5.1), "a   A cusp in its own frame, seen from the aorta", (-1.25, -1.2), 0.472)
    panel.note((2.0, 1.1), "in this half: the free edge,\na straight line", color=LEAFLET, ha="right")
    panel.note((2.0, -1.1), "in the mirrored half:\nthe bending curve", color=BENDING, ha="right")
    for k in (0, 1):
        panel.curve(cusp["sinus"][k], plan, SINUS, 1.2)
        panel.curve(cusp["leaflet"][k], plan, LEAFLET, 2.4 if k == 0 else 0.8)
        panel.curve(cusp["bending"][k], plan, BENDING, 2.4 if k == 1 else 0.8)
    panel.line((-0.1, 0), (1.45, 0), color=GREY, width=0.6, style=AXIS)
    panel.points((0, 0), color=DARK, size=5, marker="+")
    panel.note((-0.22, 0), "symmetry axis of the valve", ha="right")
    panel.line((-0.2, 0), (-0.04, 0), color=GREY, width=0.5)
    panel.points(plan(cusp["symmetry"][0][0]), color=SYMMETRY, size=5)
    panel.note((1.5, 0.1), "x axis of the frame,\nin the symmetry plane")
    panel.line((1.49, 0.07), (1.42, 0), color=GREY, width=0.5)
    end = plan(cusp["leaflet"][0][0][-1])
    panel.length("leaflet_radius_out", (0, 0), end, (-0.24, 0.8), shift=(-0.09, 0.052), ha="right", color=LEAFLET, share=0.7)
    panel.note((-0.24, 0.34), "60° on each side of the x axis", ha="right", color=LEAFLET)
    panel.note((1.0, 0.87), "commissure", color=LEAFLET)
    panel.line((0.99, 0.9), end, color=LEAFLET, width=0.5)
    aortic.half(panel, "bending", cusp["bending"][1], BENDING, -1)


def draw_section(sheet, cusp):
    panel = sheet.panel((7.4, 4.7), (7.5, 5.1), "b   The symmetry plane of the cusp, seen from the side", (-0.83, -0.5), 0.4)
    symmetry, leaflet, bending = cusp["symmetry"], cusp["leaflet"][0], cusp["bending"][0]
    root, inner, _, top = symmetry[0]
    low = section(bending[0][0])
    panel.line((0, -0.3), (0, 1.4), color=GREY, width=0.6, style=AXIS)
    panel.note((0.02, 1.42), "symmetry axis of the valve", va="bottom", ha="center")
    panel.line((-0.62, 0), (1.62, 0), color=GREY, width=0.6)
    panel.note((-0.82, -0.06), "root, z = 0 of\nthe cusp's frame", va="top")
    for pieces, color in ((cusp["sinus"][0], SINUS), (leaflet, LEAFLET), (bending, BENDING)):
        panel.curve(pieces, section, color, 1.1, style="--")
    panel.curve(symmetry, section, SYMMETRY, 2.6)
    for p, color in ((section(root), SYMMETRY), (low, BENDING), (section(top), LEAFLET)):
        panel.points(p, color=color, size=6)
    panel.length("root_radius", (0, 0), section(root), (0.62, -0.36), shift=(0, -0.2), ha="center")
    level = (section(top)[0], 0)
    panel.length("leaflet_height", level, section(top), (-0.4, 0.75), shift=(-0.32, 0), ha="right", color=LEAFLET)
    level = (low[0], 0)
    panel.length("bending_height", level, low, (-0.21, 0.3), shift=(-0.12 - low[0], 0), ha="right", color=BENDING)
    aortic.first_inner(panel, section(root), low, section(inner), INNER_PLACES, "left")
    panel.note((0.2, 1.25), "free edge, at this height", color=LEAFLET, va="bottom")
    panel.note((0.54, 0.62), "bending curve", color=BENDING, va="bottom")


def draw_placement(sheet, own, placed):
    panel = sheet.panel((0.15, 0.55), (4.6, 3.4), "c   The right cusp in place, from the side", (-1.75, -1.5), 0.85)
    for kind, color in (("sinus", SINUS), ("leaflet", LEAFLET), ("bending", BENDING)):
        panel.curve(placed[kind][0], section, color, 1.3)
    panel.curve(placed["symmetry"], section, SYMMETRY, 1.6)
    panel.curve(own["symmetry"], section, PALE, 1.0, style="--")
    root, before = placed["symmetry"][0][0], own["symmetry"][0][0]
    for height, text in ((0, "z = 0"), (root[2], "root")):
        panel.line((-0.3, height), (1.5, height), color=GREY, width=0.6)
        panel.note((1.52, height), text)
    values = sheet.parameters["translation"]["values"]
    for measured, value in zip((a - b for a, b in zip(root, before)), values):
        sheet.check("translation", measured, value)
    panel.arrow((0, 0), (0, root[2]), both=False)
    text = f"{', '.join(map(plain, values))} cm;\nof the whole valve,\nafter cusps are turned\nby 0, 120 and −120°"
    panel.label("translation", (-0.1, -0.35), along((0, 0), (0, root[2]), 0.4), ha="right", value=text)
    panel.note((before[0] - 0.1, 0.9), "before: its\nown frame", color=GREY)


def draw_opening(sheet, states):
    title = "d   The symmetry curve at openings 0, 0.5, 1"
    panel = sheet.panel((5.0, 0.55), (4.7, 3.4), title, (-0.35, -0.35), 0.52)
    ways = []
    for state, color in zip(states, (DARK, GREY, PALE)):
        symmetry = state["own_frames"][0]["symmetry"]
        panel.curve(symmetry, section, color, 2.2 if state["opening"] == 0 else 1.6)
        ways.append(section(symmetry[0][-1]))
        panel.points(ways[-1], color=color, size=5)
        panel.note((ways[-1][0], ways[-1][1] + 0.04), plain(state["opening"]), color=color, ha="center", va="bottom")
    sheet.check("opening", states[0]["opening"])
    sheet.check("opening", distance(ways[0], ways[1]) / distance(ways[0], ways[2]), states[1]["opening"])
    panel.line((0, -0.1), (0, 1.15), color=GREY, width=0.6, style=AXIS)
    panel.arrow(along(ways[0], ways[2], 0.05), along(ways[0], ways[2], 0.95), both=False)
    panel.label("opening", (1.3, 0.95), along(ways[0], ways[2], 0.7), value=f"{sheet.value_text('opening')}: closed,\nto 1: open")
    root_radius = sheet.value("root_radius")
    value = f"{sheet.value_text('open_radius_ratio')}, times\nroot_radius: {plain(round(ways[2][0], 9))} cm"
    foot = (ways[0][0], -0.18)
    panel.line(ways[2], (ways[2][0], -0.2), color=GREY, width=0.5)
    panel.length("open_radius_ratio", foot, (ways[2][0], -0.18), (1.3, 0.1), factor=root_radius, value=value, share=0.9)
    panel.note((0.05, -0.3), "Every control point moves on a straight line.", fontsize=SMALL)


def draw_commissures(sheet, states):
    panel = sheet.panel((9.95, 0.55), (4.95, 3.4), "e   All cusps, seen from the aorta", (-1.55, -1.55), 0.91)
    closed, opened = states[0]["cusps"], states[-1]["cusps"]
    for cusps, color, width in ((opened, PALE, 1.6), (closed, LEAFLET, 1.8)):
        for cusp in cusps:
            for k in (0, 1):
                panel.curve(cusp["leaflet"][k], plan, color, width)
                panel.curve(cusp["sinus"][k], plan, PALE if cusps is opened else SINUS, 0.9)
    panel.note((0.12, 0.07), "closed", color=LEAFLET)
    panel.note((0.98, -0.12), "open", color=GREY, ha="right")
    end, moved = plan(closed[0]["leaflet"][0][0][-1]), plan(opened[0]["leaflet"][0][0][-1])
    radius = sheet.value("leaflet_radius_out")
    value = f"{sheet.value_text('commissure_expansion')}, times\nleaflet_radius_out:\n{plain(round(distance(end, moved), 9))} cm"
    panel.length("commissure_expansion", end, moved, (1.1, 1.2), factor=radius, value=value)
    sheet.check("commissure_expansion", math.hypot(*moved) / math.hypot(*end) - 1)


def draw(trileaflet):
    sheet = Sheet("Parameters of the trileaflet valve", trileaflet["parameters"], (15, 10.6))
    text = "Defaults. The three cusps are equal. One radius gives length and place of the closed free edges."
    sheet.text(0.33, 1 - 0.27 / 10.6, text, va="center")
    sheet.skirt(10.6)
    states = trileaflet["states"]
    own = states[0]["own_frames"][0]
    draw_plan(sheet, own)
    draw_section(sheet, own)
    draw_placement(sheet, own, states[0]["cusps"][0])
    draw_opening(sheet, states)
    draw_commissures(sheet, states)
    names = ("leaflet curve (free edge)", "bending curve", "sinus curve (attachment)", "symmetry curve")
    for i, (text, color) in enumerate(zip(names, (LEAFLET, BENDING, SINUS, SYMMETRY))):
        sheet.text(0.012 + 0.16 * i, 0.035, "■ " + text, color=color, va="bottom", weight="bold")
    points = "○ control points; t0 and t3 are along y, from the ends to the inner ones"
    dashes = "− −  in a: the profile x₀ + (x₁ − x₀) (y / y₁)ᵖ, whose slope at the ends is the tangents'"
    sheet.text(0.012, 0.012, f"{points}      {dashes}", va="bottom", fontsize=SMALL)
    return sheet
