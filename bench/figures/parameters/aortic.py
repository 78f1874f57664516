# SPDX-License-Identifier: Apache-2.0
"""Draws the meaning of the aortic valve's parameters on the left cusp (docs/theory/aortic.md)."""

import math

import bezier
from sheet import BLUE, DARK, GREEN, GREY, NORMAL, PALE, PURPLE, SMALL, VERMILION, Sheet, along, distance, plain

LEAFLET, BENDING, SINUS, SYMMETRY = VERMILION, BLUE, PURPLE, GREEN
CUSPS = ("right", "left", "non_coronary")
CUSP = "left"


def plan(p):
    return p[0], p[1]


def section(p):
    return p[0], p[2]


def power_of(curve):
    """Returns the exponent with which the power profile has the curve's tangent at its end. The exponent is the tangent's slope
    divided by the chord's slope."""
    first, _, before, last = curve[0]
    return ((last[0] - before[0]) / (last[1] - before[1])) / ((last[0] - first[0]) / (last[1] - first[1]))


def profile(curve, power):
    """Returns points of the profile x = first + (last - first) (y / y of last)^power, between a curve's ends."""
    first, last = curve[0][0], curve[0][-1]
    return [(first[0] + (last[0] - first[0]) * (i / 64) ** power, last[1] * i / 64) for i in range(65)]


def draw_plan(sheet, cusp):
    panel = sheet.panel(
        (0.15, 5.0), (7.0, 5.75), "a   A cusp in its own frame, seen from the aorta", (-1.2, -1.36), 0.482
    )
    panel.note((2.15, 1.25), "in this half: parameters\nof the free edge", color=LEAFLET, ha="right")
    panel.note((2.15, -1.25), "in the mirrored half:\nthose of the bending curve", color=BENDING, ha="right")
    for k in (0, 1):
        panel.curve(cusp["sinus"][k], plan, SINUS, 1.2)
        panel.curve(cusp["leaflet"][k], plan, LEAFLET, 2.4 if k == 0 else 0.8)
        panel.curve(cusp["bending"][k], plan, BENDING, 2.4 if k == 1 else 0.8)
    panel.line((-0.1, 0), (1.45, 0), color=GREY, width=0.6, style=(0, (8, 3, 2, 3)))
    panel.points((0, 0), color=DARK, size=5, marker="+")
    panel.note((-0.22, 0), "symmetry axis of the valve", ha="right")
    panel.line((-0.2, 0), (-0.12, 0), color=GREY, width=0.5)
    root = plan(cusp["symmetry"][0][0])
    panel.points(root, color=SYMMETRY, size=5)
    panel.note((1.5, 0.1), "x axis of the frame,\nin the symmetry plane")
    panel.line((1.49, 0.07), (1.42, 0), color=GREY, width=0.5)
    half(panel, "leaflet", cusp["leaflet"][0], LEAFLET, 1)
    half(panel, "bending", cusp["bending"][1], BENDING, -1)


def half(panel, kind, curve, color, up):
    """Draws the parameters of the free edge or of the bending curve. The free edge is the upper half, up = 1. The bending curve
    is the lower, mirrored half, up = -1."""
    sheet, (first, after, before, last) = panel.sheet, [plan(p) for p in curve[0]]
    # The frame's y axis points up in the upper half and down in the lower half.
    panel.line(first, after, color=color, width=1.1, style=":")
    panel.line(last, before, color=color, width=1.1, style=":")
    panel.points(first, after, before, last, color=color, size=4, filled=False)
    axis_point = (0, 0)
    at, shift = (-0.24, 0.22 * up), (0, 0.06 * up)
    panel.length(f"{kind}_radius_in", axis_point, first, at, shift=shift, color=color, ha="right", share=0.2)
    panel.length(f"{kind}_radius_out", axis_point, last, (-0.24, 0.92 * up), color=color, ha="right", share=0.42)
    panel.angle(f"{kind}_angle", axis_point, (1, 0), last, 0.3, (-0.24, 0.56 * up), color=color, ha="right", sense=up, share=0.8)
    # t0 and t3 only determine the y of the inner control points, as a fraction of the way between the ends.
    level = (first[0], after[1])
    panel.length(f"t0_{kind}", first, level, T0_PLACE[kind], shift=(0.1, 0), color=color)
    level = (last[0], before[1])
    panel.line(before, level, color=color, width=0.5)
    panel.length(f"t3_{kind}", last, level, T3_PLACE[kind], shift=(0.12, 0), color=color)
    power = power_of(curve)
    sheet.check(f"{kind}_power", power)
    points = profile(curve, power)
    panel.line(*points, color=color, width=1.0, style="--")
    panel.label(f"{kind}_power", POWER_PLACE[kind], points[40], color=color, shown=f"{kind}_power p")


T0_PLACE = {"leaflet": (1.3, 0.42), "bending": (1.42, -0.28)}
T3_PLACE = {"leaflet": (1.05, 1.12), "bending": (1.35, -0.92)}
POWER_PLACE = {"leaflet": (1.28, 0.77), "bending": (1.42, -0.6)}


def draw_section(sheet, cusp):
    panel = sheet.panel((7.4, 5.0), (7.5, 5.75), "b   The symmetry plane of the cusp, seen from the side", (-0.95, -0.53), 0.345)
    symmetry, leaflet, bending = cusp["symmetry"], cusp["leaflet"][0], cusp["bending"][0]
    root, inner, _, top = symmetry[0]
    middle = bending[0][0]
    panel.line((0, -0.3), (0, 1.25), color=GREY, width=0.6, style=(0, (8, 3, 2, 3)))
    panel.note((0.02, 1.3), "symmetry axis of the valve", va="bottom", ha="center")
    panel.line((-0.62, 0), (1.62, 0), color=GREY, width=0.6)
    panel.note((-0.93, -0.06), "root, z = 0 of\nthe cusp's frame", va="top")
    for pieces, color in ((cusp["sinus"][0], SINUS), (leaflet, LEAFLET), (bending, BENDING)):
        panel.curve(pieces, section, color, 1.1, style="--")
    panel.curve(symmetry, section, SYMMETRY, 2.6)
    for p, color in ((section(root), SYMMETRY), (section(middle), BENDING), (section(top), LEAFLET)):
        panel.points(p, color=color, size=6)
    zero = (0, 0)
    height, low = (root[0], root[2]), section(middle)
    panel.length("root_radius", zero, height, (0.645, -0.36), shift=(0, -0.2), ha="center")
    level = (section(top)[0], 0)
    shift = -0.3 - level[0]
    panel.length("leaflet_height", level, section(top), (-0.36, 0.62), shift=(shift, 0), ha="right", color=LEAFLET)
    level = (low[0], 0)
    panel.length("bending_height", level, low, (-0.19, 0.3), shift=(-0.12 - level[0], 0), ha="right", color=BENDING)
    first_inner(panel, section(root), low, section(inner))
    panel.note(along_curve(leaflet, 0.75, (0.02, 0.05)), "free edge, at this height", color=LEAFLET, ha="left", va="bottom")
    panel.note(along_curve(bending, 1, (0.12, 0)), "bending curve", color=BENDING, ha="left", va="bottom")


def along_curve(pieces, t, offset):
    x, y = section(bezier.point(pieces[0], t))
    return x + offset[0], y + offset[1]


INNER_PLACES = {"xq": (0.64, 0.54), "zq": (0.64, 0.3), "inner": (0.64, 0.1), "middle": (1.34, 0.44)}


def first_inner(panel, root, low, inner, places=INNER_PLACES, ha="right"):
    """Draws xq and zq, the position of the first inner control point relative to the middle between root and bending curve. `ha`
    aligns three of the labels. The label at the middle is always on the left."""
    sheet, middle = panel.sheet, along(root, low, 0.5)
    width, height = root[0] - low[0], low[1] - root[1]
    for p, q in (((low[0], root[1]), low), (low, (root[0], low[1])), ((root[0], low[1]), root)):
        panel.line(p, q, color=PALE, width=0.8)
    panel.line(root, low, color=PALE, width=0.8, style="--")
    panel.points(middle, color=DARK, size=7, marker="+")
    panel.points(inner, color=SYMMETRY, size=6, filled=False)
    panel.line(root, inner, color=SYMMETRY, width=1.1, style=":")
    sheet.check("xq", (inner[0] - middle[0]) / width)
    sheet.check("zq", (inner[1] - middle[1]) / height)
    corner = (inner[0], middle[1])
    panel.arrow(middle, corner, both=False)
    panel.arrow(corner, inner, both=False)
    value = f"{sheet.value_text('xq')}, times (root_radius\n− bending_radius_in): {plain(round(inner[0] - middle[0], 9))} cm"
    panel.label("xq", places["xq"], along(middle, corner, 0.5), ha=ha, value=value)
    value = f"{sheet.value_text('zq')}, times bending_height:\n{plain(round(inner[1] - middle[1], 9))} cm"
    panel.label("zq", places["zq"], along(corner, inner, 0.5), ha=ha, value=value)
    x, y = places["inner"]
    panel.note((x, y), "first inner control point\nof the symmetry curve", color=SYMMETRY, ha=ha)
    panel.line((x + (0.01 if ha == "right" else -0.01), y), inner, color=SYMMETRY, width=0.5)
    x, y = places["middle"]
    panel.note((x, y), "middle of\nthe box")
    panel.line((x - 0.01, y), middle, color=GREY, width=0.5)


def draw_rotations(sheet, cusps):
    panel = sheet.panel((0.15, 0.55), (4.85, 3.85), "c   All cusps in place, seen from the aorta", (-3.28, -1.95), 1.05)
    panel.line((0, 0), (1.6, 0), color=GREY, width=0.6)
    panel.note((1.63, 0), "x", ha="left")
    places = {"right": ((-1.55, -0.2), "right"), "left": ((-1.35, 1.1), "right"), "non_coronary": ((-1.35, -1.3), "right")}
    for index, cusp in enumerate(cusps):
        curves, name = cusp["placed"], cusp["name"]
        for k in (0, 1):
            for kind, color, width in (("sinus", SINUS, 0.9), ("leaflet", LEAFLET, 1.5), ("bending", BENDING, 0.9)):
                panel.curve(curves[kind][k], plan, color, width)
        panel.curve(curves["symmetry"], plan, SYMMETRY, 1.2)
        root = plan(curves["symmetry"][0][0])
        panel.line((0, 0), root, color=GREY, width=0.6, style=(0, (8, 3, 2, 3)))
        values = sheet.parameters[f"{name}.rotation"]["values"]
        at, ha = places[name]
        shown = f"{name}.rotation"
        text = f"{', '.join(map(plain, values))}°\nabout x, y, z"
        if values[2] == 0:
            panel.label(f"{name}.rotation", at, along((0, 0), root, 0.05), ha=ha, shown=shown, value=text)
            continue
        panel.angle(
            f"{name}.rotation", (0, 0), (1, 0), root, 0.42 + 0.16 * index, at, ha=ha, share=0.85, shown=shown,
            sense=int(math.copysign(1, values[2])), value=abs(values[2]), text=text,
        )  # fmt: skip


def draw_placement(sheet, cusps):
    panel = sheet.panel((5.1, 0.55), (4.75, 3.85), "d   The right cusp in place, from the side", (-1.62, -1.42), 0.72)
    right = next(cusp for cusp in cusps if cusp["name"] == "right")
    curves, own = right["placed"], right["own_frame"]
    for kind, color in (("sinus", SINUS), ("leaflet", LEAFLET), ("bending", BENDING)):
        panel.curve(curves[kind][0], section, color, 1.3)
    panel.curve(curves["symmetry"], section, SYMMETRY, 1.6)
    panel.curve(own["symmetry"], section, PALE, 1.0, style="--")
    root, before = section(curves["symmetry"][0][0]), section(own["symmetry"][0][0])
    panel.line((-0.3, 0), (1.5, 0), color=GREY, width=0.6)
    panel.note((1.52, 0), "z = 0", ha="left")
    panel.line((-0.3, root[1]), (1.5, root[1]), color=GREY, width=0.6)
    panel.note((1.52, root[1]), "root", ha="left")
    shift = [a - b for a, b in zip(curves["symmetry"][0][0], own["symmetry"][0][0])]
    values = sheet.parameters["right.translation"]["values"]
    for measured, value in zip(shift, values):
        sheet.check("right.translation", measured, value)
    panel.arrow((0, 0), (0, root[1]), both=False)
    text = f"{', '.join(map(plain, values))} cm, after the rotation;\nthe same for every cusp"
    panel.label("translation", (-0.08, -0.35), ha="right", value=text)
    panel.note((before[0] - 0.38, 0.72), "before: its\nown frame", color=GREY)
    panel.arrow(along(before, (0.3, 1.0), 0.0), root, color=PALE, both=False)
    top = (root[0], root[1] + sheet.value("root_height"))
    value = f"{sheet.value_text('root_height')}: no curve\ndepends on it; the\ntranslation does\nits work"
    panel.length("root_height", root, top, (1.5, -0.35), shift=(0.12, 0), value=value)


def draw_opening(sheet, aortic):
    panel = sheet.panel((9.95, 0.55), (4.95, 3.85), "e   Opening to the state of the last two parameters", (-0.35, -0.3), 0.43)
    index = CUSPS.index(CUSP)
    states = aortic["states"]
    ways, ends = [], []
    for state, color in zip(states, (DARK, GREY, PALE)):
        symmetry = state["own_frames"][index]["symmetry"]
        panel.curve(symmetry, section, color, 2.2 if state["opening"] == 0 else 1.6)
        ways.append(section(symmetry[0][-1]))
        ends.append(plan(state["own_frames"][index]["leaflet"][0][0][-1]))
        panel.points(ways[-1], color=color, size=5)
        panel.note((ways[-1][0], ways[-1][1] + 0.07), plain(state["opening"]), color=color, ha="center", fontsize=NORMAL)
    sheet.check("opening", states[0]["opening"])
    sheet.check("opening", distance(ways[0], ways[1]) / distance(ways[0], ways[2]), states[1]["opening"])
    panel.line((0, -0.1), (0, 1.2), color=GREY, width=0.6, style=(0, (8, 3, 2, 3)))
    panel.arrow(along(ways[0], ways[2], 0.05), along(ways[0], ways[2], 0.95), both=False)
    value = f"{sheet.value_text('opening')}: this state, to 1:\nthe open state"
    panel.label("opening", (0.06, 0.62), along(ways[0], ways[2], 0.25), value=value)
    root_radius = sheet.value("root_radius")
    sheet.check("open_radius_ratio", ways[2][0] / root_radius)
    value = f"{sheet.value_text('open_radius_ratio')}, times\nroot_radius: {plain(round(ways[2][0], 9))} cm"
    panel.label("open_radius_ratio", (1.12, 1.18), ways[2], value=value)
    sheet.check("commissure_expansion", math.hypot(*ends[2]) / math.hypot(*ends[0]) - 1)
    value = f"{sheet.value_text('commissure_expansion')}: leaflet_radius_out\ngrows by this share (not seen here)"
    panel.label("commissure_expansion", (0.05, 0.0), value=value)
    panel.note((0.05, -0.26), "Every control point moves on a straight line.")


def draw(aortic):
    sheet = Sheet("Parameters of the aortic valve", aortic["parameters"], (15, 11.8), CUSP)
    text = "Defaults; three values: right | left | non_coronary cusp. Curves and lengths: the left cusp at its defaults."
    sheet.text(0.30, 1 - 0.27 / 11.8, text, va="center")
    sheet.skirt(11.8)
    state = aortic["states"][0]
    cusps = [
        {"name": name, "own_frame": own, "placed": placed}
        for name, own, placed in zip(CUSPS, state["own_frames"], state["cusps"])
    ]
    cusp = cusps[CUSPS.index(CUSP)]["own_frame"]
    draw_plan(sheet, cusp)
    draw_section(sheet, cusp)
    draw_rotations(sheet, cusps)
    draw_placement(sheet, cusps)
    draw_opening(sheet, aortic)
    names = ("leaflet curve (free edge)", "bending curve", "sinus curve", "symmetry curve")
    legend = zip(names, (LEAFLET, BENDING, SINUS, SYMMETRY))
    for i, (text, color) in enumerate(legend):
        sheet.text(0.012 + 0.16 * i, 0.03, "■ " + text, color=color, va="bottom", weight="bold")
    points = "○ control points; t0 and t3 are along y, from the ends to the inner ones"
    dashes = "− −  in a: the profile x₀ + (x₁ − x₀) (y / y₁)ᵖ, whose slope at the ends is the tangents'"
    sheet.text(0.012, 0.01, f"{points}      {dashes}", va="bottom", fontsize=SMALL)
    return sheet
