# SPDX-License-Identifier: Apache-2.0
"""Draws the meaning of the coapting valve's parameters on its right cusp (docs/theory/coapting.md)."""

import math

from aortic import BENDING, LEAFLET, SINUS, SYMMETRY, plan, section
from sheet import DARK, GREY, PALE, SMALL, Sheet, along, distance, plain

AXIS = (0, (8, 3, 2, 3))
TO_COMMISSURE = (math.cos(math.radians(60)), math.sin(math.radians(60)))


def beside(p):
    """Projects a point onto the vertical plane through the axis and the commissure. Returns the distance from the axis and the
    height."""
    return (p[0] * TO_COMMISSURE[0] + p[1] * TO_COMMISSURE[1], p[2])


def draw_plan(sheet, cusp):
    title = "a   The closed cusp in its own frame, seen from the aorta"
    panel = sheet.panel((0.15, 4.9), (6.2, 4.9), title, (-0.8, -1.2), 0.5)
    for k in (0, 1):
        panel.curve(cusp["sinus"][k], plan, SINUS, 2.4)
        panel.curve(cusp["leaflet"][k], plan, LEAFLET, 2.0)
    panel.line((-0.2, 0), (1.45, 0), color=GREY, width=0.6, style=AXIS)
    panel.points((0, 0), color=DARK, size=5, marker="+")
    panel.note((-0.7, 0.0), "symmetry axis\nof the valve")
    panel.line((-0.22, 0), (-0.04, 0), color=GREY, width=0.5)
    attachment, edge = cusp["sinus"][0][0], cusp["leaflet"][0][0]
    root, width, end = plan(attachment[0]), plan(attachment[1]), plan(edge[-1])
    for k in (0, 1):
        panel.line(root, plan(cusp["sinus"][k][0][1]), color=SINUS, width=1.1, style=":")
    panel.points(width, color=SINUS, size=6, filled=False)
    panel.length("root_radius", (0, 0), root, (0.35, -0.42), shift=(0, -0.3))
    panel.length("commissure_radius", (0, 0), end, (-0.7, 0.72), shift=(-0.17, 0.1), color=LEAFLET, share=0.6)
    radius = sheet.value("root_radius")
    value = f"{sheet.value_text('attachment_width')}, times\nroot_radius: {plain(round(distance(root, width), 9))} cm"
    panel.length("attachment_width", root, width, (1.5, 0.45), shift=(0.14, 0), factor=radius, value=value, color=SINUS)
    panel.note((0.7, 1.1), "commissure", color=LEAFLET)
    panel.note((-0.08, -0.85), "free edge", color=LEAFLET, ha="right")
    panel.line((-0.06, -0.85), along((0, 0), (end[0], -end[1]), 0.75), color=LEAFLET, width=0.5)
    panel.note((1.05, -1.0), "attachment", color=SINUS)
    panel.line((1.04, -1.0), plan(cusp["sinus"][1][0][0]), color=SINUS, width=0.0)


def draw_section(sheet, cusp):
    title = "b   The symmetry plane of the closed cusp, seen from the side"
    panel = sheet.panel((6.6, 4.9), (8.3, 4.9), title, (-1.2, -0.35), 0.46)
    lower, upper = cusp["symmetry"][0], cusp["symmetry"][-1]
    root, inner, bend, top = section(lower[0]), section(lower[1]), section(upper[0]), section(upper[-1])
    end = section(cusp["leaflet"][0][0][-1])
    panel.line((0, -0.25), (0, 1.85), color=GREY, width=0.6, style=AXIS)
    panel.line((-0.95, 0), (1.75, 0), color=GREY, width=0.6)
    panel.note((1.78, 0), "root, z = 0")
    for kind, color in (("sinus", SINUS), ("leaflet", LEAFLET), ("bending", BENDING)):
        panel.curve(cusp[kind][0], section, color, 1.1, style="--")
    panel.curve(cusp["symmetry"], section, SYMMETRY, 2.6)
    panel.line(root, inner, color=SYMMETRY, width=1.1, style=":")
    panel.points(inner, color=SYMMETRY, size=6, filled=False)
    for p, color in ((root, SYMMETRY), (bend, BENDING), (top, LEAFLET), (end, LEAFLET)):
        panel.points(p, color=color, size=6)
    panel.length("commissure_height", (end[0], 0), end, (1.5, 1.3), shift=(0.78, 0), color=LEAFLET, share=0.75)
    panel.length("effective_height", (top[0], 0), top, (-1.15, 0.62), shift=(-0.28 - top[0], 0), color=LEAFLET, share=0.7)
    panel.length("coaptation_height", bend, top, (-1.15, 1.15), shift=(-0.12 - top[0], 0), color=BENDING, share=0.8)
    panel.angle("bottom_angle", root, (root[0] - 1, 0), inner, 0.4, (0.38, -0.2), sense=-1, share=0.4)
    radius = sheet.value("root_radius")
    value = f"{sheet.value_text('belly')}, times\nroot_radius: {plain(round(distance(root, inner), 9))} cm"
    panel.length("belly", root, inner, (1.35, 0.5), shift=(0.05, 0.14), factor=radius, value=value, color=SYMMETRY)
    panel.note((end[0] + 0.05, end[1] + 0.04), "commissure", color=LEAFLET, va="bottom")
    panel.note((0.2, 0.42), "lower coaptation line", color=BENDING)
    panel.line((0.3, 0.46), section(cusp["bending"][0][0][1]), color=BENDING, width=0.5)
    panel.note((0.04, 1.42), "free edge", color=LEAFLET)


def draw_zone(sheet, cusp):
    title = "c   The coaptation zone, from the neighbour"
    panel = sheet.panel((0.15, 0.75), (4.0, 3.5), title, (-0.62, -0.1), 0.56)
    edge, attachment = cusp["leaflet"][0][0], cusp["sinus"][0][0]
    for kind, color in (("bending", BENDING), ("leaflet", LEAFLET)):
        panel.curve(cusp[kind][0], beside, color, 2.2)
    panel.curve(cusp["sinus"][0], beside, SINUS, 2.2)
    panel.line((0, 0), (0, 1.7), color=GREY, width=0.6, style=AXIS)
    first, near, end, drop = (beside(p) for p in (edge[1], edge[2], edge[3], attachment[2]))
    panel.points(first, near, color=LEAFLET, size=6, filled=False)
    panel.points(drop, color=SINUS, size=6, filled=False)
    panel.line(end, near, color=LEAFLET, width=1.1, style=":")
    panel.line(first, (near[0], first[1]), color=LEAFLET, width=0.7, style=":")
    whole = sheet.value("commissure_height") - sheet.value("effective_height")
    rise = plain(round(near[1] - first[1], 9))
    value = f"{sheet.value_text('edge_rise')}, times (commissure_height\n− effective_height): {rise} cm"
    panel.length("edge_rise", (near[0], first[1]), near, (-0.6, 1.55), factor=whole, value=value, color=LEAFLET)
    height = sheet.value("commissure_height")
    value = f"{sheet.value_text('attachment_drop')}, times\ncommissure_height:\n{plain(round(end[1] - drop[1], 9))} cm"
    panel.length("attachment_drop", drop, end, (0.32, 0.5), shift=(0.12, 0), factor=height, value=value, color=SINUS, share=0.25)


def draw_gap(sheet, states):
    panel = sheet.panel((4.3, 0.75), (2.3, 3.5), "d   At the axis", (-0.062, -0.06), 0.035)
    for cusp, color in zip(states[0]["cusps"], (LEAFLET, PALE, PALE)):
        for k in (0, 1):
            start, end = (plan(p) for p in (cusp["leaflet"][k][0][0], cusp["leaflet"][k][0][-1]))
            panel.line(start, along(start, end, 0.05 / distance(start, end)), color=color, width=2.2)
    panel.points((0, 0), color=DARK, size=5, marker="+")
    start = plan(states[0]["cusps"][0]["leaflet"][0][0][0])
    middle = start[0] * TO_COMMISSURE[0]
    foot = (middle * TO_COMMISSURE[0], middle * TO_COMMISSURE[1])
    across = (2 * foot[0] - start[0], 2 * foot[1] - start[1])
    panel.line((0, 0), along((0, 0), TO_COMMISSURE, 0.05), color=GREY, width=0.6, style=AXIS)
    panel.length("gap", start, across, (-0.055, 0.052))
    panel.note((-0.055, -0.045), "falls linearly to 0\nat the commissures", fontsize=SMALL)


def draw_opening(sheet, states):
    panel = sheet.panel((6.75, 0.75), (3.9, 3.5), "e   Symmetry curve at 0, 0.5, 1", (-0.35, -0.62), 0.6)
    ways = []
    for state, color in zip(states, (DARK, GREY, PALE)):
        symmetry = state["own_frames"][0]["symmetry"]
        panel.curve(symmetry, section, color, 2.2 if state["opening"] == 0 else 1.6)
        ways.append(section(symmetry[-1][-1]))
        panel.points(ways[-1], color=color, size=5)
        panel.note((ways[-1][0], ways[-1][1] + 0.04), plain(state["opening"]), color=GREY, ha="center", va="bottom")
    sheet.check("opening", states[0]["opening"])
    sheet.check("opening", (ways[1][0] - ways[0][0]) / (ways[2][0] - ways[0][0]), states[1]["opening"])
    panel.line((0, -0.1), (0, 1.3), color=GREY, width=0.6, style=AXIS)
    panel.line((-0.2, 0), (1.5, 0), color=GREY, width=0.6)
    panel.label("opening", (0.9, 1.25), ways[1], value=f"{sheet.value_text('opening')}: closed, to 1: open")
    own, placed = states[0]["own_frames"][0]["symmetry"][0][0], states[0]["cusps"][0]["symmetry"][0][0]
    values = sheet.parameters["translation"]["values"]
    for measured, value in zip((a - b for a, b in zip(placed, own)), values):
        sheet.check("translation", measured, value)
    text = f"{', '.join(map(plain, values))} cm; of the whole valve"
    panel.label("translation", (-0.3, -0.25), section(placed), value=text)
    panel.note((-0.3, -0.52), "The middle of the free edge sinks as far as\nthe length of the edge requires.", fontsize=SMALL)


def draw_commissures(sheet, states):
    panel = sheet.panel((10.9, 0.75), (4.0, 3.5), "f   All cusps, closed and open", (-1.45, -2.0), 1.1)
    closed, opened = states[0]["cusps"], states[-1]["cusps"]
    for cusps, color, width in ((opened, PALE, 1.8), (closed, LEAFLET, 1.4)):
        for cusp in cusps:
            for k in (0, 1):
                panel.curve(cusp["leaflet"][k], plan, color, width)
                panel.curve(cusp["sinus"][k], plan, PALE if cusps is opened else SINUS, 0.9)
    end, moved = plan(closed[0]["leaflet"][0][0][-1]), plan(opened[0]["leaflet"][0][0][-1])
    radius = sheet.value("commissure_radius")
    value = f"{sheet.value_text('commissure_expansion')}, times\ncommissure_radius:\n{plain(round(distance(end, moved), 9))} cm"
    panel.length("commissure_expansion", end, moved, (0.85, 1.45), factor=radius, value=value)
    inner = plan(opened[0]["leaflet"][0][0][0])
    value = f"{sheet.value_text('open_radius_ratio')}, times\ncommissure_radius:\n{plain(round(inner[0], 9))} cm"
    panel.length("open_radius_ratio", (0, 0), inner, (0.9, -1.45), shift=(0, -0.16), factor=radius, value=value, share=0.9)


def draw(coapting):
    sheet = Sheet("Parameters of the coapting valve", coapting["parameters"], (15, 10.6))
    text = "Defaults. The three cusps are equal. Sizes that are not set follow from root_radius."
    sheet.text(0.33, 1 - 0.27 / 10.6, text, va="center")
    sheet.skirt(10.6)
    states = coapting["states"]
    own = states[0]["own_frames"][0]
    draw_plan(sheet, own)
    draw_section(sheet, own)
    draw_zone(sheet, own)
    draw_gap(sheet, states)
    draw_opening(sheet, states)
    draw_commissures(sheet, states)
    names = ("free edge", "lower coaptation line", "attachment", "symmetry curve")
    for i, (text, color) in enumerate(zip(names, (LEAFLET, BENDING, SINUS, SYMMETRY))):
        sheet.text(0.012 + 0.16 * i, 0.035, "■ " + text, color=color, va="bottom", weight="bold")
    sheet.text(0.012, 0.012, "○ control points", va="bottom", fontsize=SMALL)
    return sheet
