# SPDX-License-Identifier: Apache-2.0
"""Draws the meaning of the mitral valve's parameters (docs/theory/mitral.md)."""

import math

import bezier
from sheet import BLUE, DARK, GREEN, GREY, PALE, PURPLE, VERMILION, Refused, Sheet, along, distance, plain

ANNULUS, ANTERIOR, POSTERIOR = DARK, BLUE, VERMILION


def plan(p):
    return p[0], p[1]


def side(p):
    """Projects points to the view from the posteromedial side. Anterior is on the right, and the ventricle below."""
    return p[1], p[2]


def mirrored(p):
    return -p[0], p[1], *p[2:]


class Valve:
    """The curves of one opening, and the points where the parts of the annulus begin."""

    def __init__(self, state):
        self.opening = state["opening"]
        self.annulus, self.anterior, self.posterior = state["annulus"], state["anterior"], state["posterior"]
        self.lines, self.arcs = state["lines"], [arc["curve"] for arc in state["arcs"]]
        starts, ends = [arc[0][0] for arc in self.arcs], [arc[-1][-1] for arc in self.arcs]
        # Two neighbouring arcs that end in one point are the sides of the commissure's triangle.
        (last,) = [i + 1 for i in range(len(ends) - 1) if ends[i] == ends[i + 1]]
        self.triangle, self.commissure, self.edge_end = starts[last - 1], starts[last], ends[last]
        self.cleft, self.cleft_end = starts[last + 1], ends[last + 1]
        self.posterior_point, self.anterior_point = self.annulus[0][0], self.annulus[3][0]
        self.anterior_tip, self.posterior_tip = ends[0], ends[-1]

    def at(self, share):
        """Returns the point of the annulus at a fraction of its length, anticlockwise from the posterior point."""
        return bezier.at_share(self.annulus, share % 1)

    def share(self, point):
        """Returns the fraction of the annulus' length between the posterior point and another point, anticlockwise."""
        return bezier.length(self.annulus, point) / bezier.length(self.annulus)

    def part(self, begin, end, outwards):
        """Returns points of the annulus between two fractions of its length. In the plan view, the points are shifted
        outwards."""
        points, lengths = bezier.samples(self.annulus, 256), [0.0]
        for p, q in zip(points, points[1:]):
            lengths.append(lengths[-1] + math.dist(p, q))
        made = []
        for p, before, after, length in zip(points[1:-1], points, points[2:], lengths[1:]):
            if begin <= length / lengths[-1] <= end:
                dx, dy = after[0] - before[0], after[1] - before[1]
                norm = math.hypot(dx, dy)
                made.append((p[0] + outwards * dy / norm, p[1] - outwards * dx / norm))
        return made


def draw_annulus(sheet, valve):
    title = "a   The annulus, seen from the atrium; open, when it is flat"
    panel = sheet.panel((0.15, 8.15), (7.3, 4.75), title, (-3.55, -1.95), 0.98)
    panel.curve(valve.annulus, plan, ANNULUS, 2.6)
    posterior, widest, trigone, anterior, other_trigone, other_widest = (plan(piece[0]) for piece in valve.annulus)
    panel.points(posterior, widest, trigone, anterior, other_trigone, other_widest, size=5)
    panel.length("AP_diameter", posterior, anterior, (-0.2, -0.6), ha="right", share=0.32)
    panel.length("ALPM_diameter", other_widest, widest, (-1.75, 0.36), share=0.12)
    name = "ALPM_position_ratio"
    level = (posterior[0], widest[1])
    value = f"{sheet.value_text(name)}, times\nAP_diameter"
    depth = distance(posterior, anterior)
    panel.length(name, posterior, level, (2.2, -0.75), shift=(0.3, 0), factor=depth, value=value, share=0.6)
    panel.length("IT_distance", other_trigone, trigone, (-1.1, 0.88), shift=(0, -0.6), share=0.25, ha="left")
    panel.line(anterior, (anterior[0] + 0.42, anterior[1]), width=0.5)
    panel.line(other_trigone, (anterior[0] + 0.42, trigone[1]), width=0.5)
    name, begin, end = "indent_depth", anterior, (anterior[0], trigone[1])
    value = f"{sheet.value_text(name)} / 2"
    panel.length(name, begin, end, (0.55, 0.88), shift=(0.34, 0), factor=0.5, shown=f"{name} / 2", value=value)
    shares(panel, valve)
    panel.note((0.08, -1.62), "posterior point, u = 0", ha="center", va="top")
    panel.note((2.1, 0.15), "widest point")


def shares(panel, valve):
    """Draws the parts of the annulus' length that belong to the anterior leaflet and to the commissures' triangles."""
    sheet, begin = panel.sheet, valve.share(valve.commissure)
    width = valve.share(valve.triangle) - begin
    sheet.check("anterior_ratio", 1 - 2 * begin)
    sheet.check("triangle_size_ratio", width)
    band(panel, valve, begin, 1 - begin, 0.42, ANTERIOR)
    value = f"{sheet.value_text('anterior_ratio')} of the annulus' length: the anterior leaflet's share"
    panel.label("anterior_ratio", (-0.95, 2.42), plan(valve.part(0.48, 0.5, 0.42)[0]), color=ANTERIOR, value=value)
    for first in (begin, 1 - begin - width):
        band(panel, valve, first, first + width, 0.2, GREEN)
    value = f"{sheet.value_text('triangle_size_ratio')} of the\nannulus' length,\neither side"
    at = plan(valve.part(1 - begin - width, 1 - begin, 0.2)[-90])
    panel.label("triangle_size_ratio", (-3.5, 2.3), at, color=GREEN, value=value)
    for share, text, at, ha in (
        (begin, "commissure\n(posteromedial)", (2.15, 0.62), "left"),
        (1 - begin, "commissure\n(anterolateral)", (-2.2, 0.42), "right"),
        (begin / 3, "cleft, at a third of the\nposterior leaflet's share", (1.35, -1.62), "left"),
        (1 - begin / 3, "cleft", (-1.35, -1.62), "right"),
    ):
        p = plan(valve.at(share))
        panel.points(p, color=PURPLE, size=5)
        panel.note(at, text, color=PURPLE, ha=ha)
        panel.line((at[0] - 0.03, at[1]) if ha == "left" else (at[0] + 0.03, at[1]), p, color=PURPLE, width=0.5)


def band(panel, valve, begin, end, outwards, color):
    """Draws an arrow along a part of the annulus, and lines to the part's ends."""
    points, ends = valve.part(begin, end, outwards), valve.part(begin, end, 0)
    panel.line(*points, color=color, width=1.4)
    panel.arrow(points[8], points[0], color=color, both=False)
    panel.arrow(points[-9], points[-1], color=color, both=False)
    for i in (0, -1):
        panel.line(ends[i], points[i], color=color, width=0.5)


def draw_closed(sheet, valve):
    title = "b   Closed, seen from the atrium: both leaflets share a free edge, in a plane"
    panel = sheet.panel((7.75, 8.15), (7.1, 4.75), title, (-3.2, -1.95), 0.98)
    panel.curve(valve.annulus, plan, ANNULUS, 2.2)
    panel.curve(valve.anterior, plan, PURPLE, 2.6)
    tip, anterior = plan(valve.anterior_tip), plan(valve.anterior_point)
    panel.length("anterior_length", anterior, tip, (-0.15, 1.2), color=ANTERIOR, ha="right", share=0.14)
    name = "posteromedial_commissure_height"
    value = f"{sheet.value_text(name)}, at both commissures"
    panel.length(name, plan(valve.commissure), plan(valve.edge_end), (-0.6, 2.25), value=value, color=GREEN)
    panel.length(name, plan(mirrored(valve.commissure)), plan(mirrored(valve.edge_end)), None, color=GREEN)
    panel.points(plan(valve.commissure), plan(mirrored(valve.commissure)), color=PURPLE, size=5)
    panel.points(plan(mirrored(valve.cleft_end)), plan(valve.cleft_end), color=PURPLE, size=5)
    for p, q in ((valve.cleft, valve.cleft_end), (mirrored(valve.cleft), mirrored(valve.cleft_end))):
        panel.line(plan(p), plan(q), color=PURPLE, width=0.8, style="--")
    panel.note((0, -1.0), "clefts: at thirds of\nthe edge's length", ha="center", color=PURPLE)
    panel.points(anterior, tip, color=ANTERIOR, size=5)


def draw_saddle(sheet, valve):
    panel = sheet.panel((0.15, 4.1), (5.0, 3.45), "c   Closed, from the posteromedial side", (-2.5, -0.65), 1.0)
    panel.curve(valve.annulus, side, ANNULUS, 2.2)
    panel.curve(valve.anterior, side, PURPLE, 2.6)
    shift = valve.edge_end[2]
    values = sheet.parameters["translation"]["values"]
    sheet.check("translation", shift, values[2])
    panel.line((-2.05, shift), (1.95, shift), color=GREY, width=0.6, style="--")
    panel.line((-2.05, 0), (1.95, 0), color=GREY, width=0.6)
    panel.note((1.95, 0.02), "z = 0", ha="right", va="bottom")
    panel.note((1.95, shift - 0.05), "z = 0 before the\ntranslation", ha="right", va="top")
    panel.note((0.1, 1.35), "annulus", color=ANNULUS, ha="right")
    panel.note((-0.85, 0.92), "free edge", color=PURPLE, ha="right", va="top")
    for name, point, out, at in (
        ("anterior_horn_height", side(valve.anterior_point), 0.3, (0.45, 2.3)),
        ("posterior_horn_height", side(valve.posterior_point), -0.3, (-2.45, 2.05)),
    ):
        panel.length(name, (point[0], shift), point, at, shift=(out, 0), share=0.75)
        panel.points(point, size=5)
    panel.arrow((-0.3, 0), (-0.3, shift), both=False)
    panel.label("translation", (-0.15, 0.45), (-0.3, 0.45), value=f"{', '.join(map(plain, values))} cm")


def draw_section(sheet, closed, half_open, valve):
    panel = sheet.panel((5.2, 4.1), (7.1, 3.45), "d   The symmetry plane: open; grey: closed, half open", (-3.95, -1.55), 1.0)
    for other in (closed, half_open):
        for arc in (other.arcs[0], other.arcs[-1]):
            panel.curve(arc, side, PALE, 1.1)
    hang(panel, valve.arcs[0], "anterior_length", (1.95, -0.35), ANTERIOR, 1)
    hang(panel, valve.arcs[-1], "posterior_scallop_length2", (-2.05, 0.2), POSTERIOR, -1)
    ways = [side(each.anterior_tip) for each in (closed, half_open, valve)]
    sheet.check("opening", distance(ways[0], ways[1]) / distance(ways[0], ways[2]), half_open.opening)
    sheet.check("opening", valve.opening)
    panel.arrow(along(ways[0], ways[2], 0.03), along(ways[0], ways[2], 0.97), both=False)
    panel.points(*ways, color=GREY, size=4)
    panel.note((ways[0][0] - 0.05, ways[0][1] + 0.13), "0, closed", ha="center")
    panel.note((ways[1][0] - 0.1, ways[1][1] - 0.08), "0.5", ha="right")
    panel.note((ways[2][0] - 0.1, ways[2][1] - 0.08), "1, open", ha="right")
    text = f"{sheet.value_text('opening')} (open); control points\nmove straight from 0 to 1"
    panel.label("opening", (-1.15, -1.15), along(ways[0], ways[2], 0.72), ha="right", value=text)


def hang(panel, arc, name, at, color, inwards):
    """Draws one leaflet in the symmetry plane: its arc from the annulus to the free edge, and the chord. `inwards` is 1 if the
    valve's middle is on the left."""
    start, inner, end = (side(p) for p in arc[0])
    panel.curve(arc, side, color, 2.6)
    panel.points(start, end, color=color, size=5)
    panel.line(start, end, color=color, width=0.8, style="--")
    # Draws a line along the chord, shifted outwards.
    across = [0.5 * inwards * a / distance(start, end) for a in (start[1] - end[1], end[0] - start[0])]
    panel.length(name, start, end, at, shift=tuple(across), ha="left" if inwards > 0 else "right", color=color, share=0.7)
    panel.line(start, (start[0] - 1.0 * inwards, start[1]), color=GREY, width=0.6, style="--")
    horizontal = (start[0] - inwards, start[1])
    at = (0.3, 1.5) if inwards > 0 else None
    panel.angle("leaflet_inward_angle", start, horizontal, end, 0.6, at, sense=inwards, share=0.35, ha="center")
    if inwards < 0:
        return
    for point, other, sense, radius, at in ((start, end, 1, 0.95, (1.95, 0.55)), (end, start, -1, 0.75, None)):
        panel.line(point, along(point, inner, 1.05 * radius / distance(point, inner)), color=color, width=0.7, style=":")
        panel.angle("surface_angle", point, other, inner, radius, at, sense=sense)


def draw_arc(sheet, valve):
    """Draws the free edge in the frame in which its cubic is made. In this frame, the cubic approximates an arc of a circle."""
    panel = sheet.panel((12.45, 4.1), (2.45, 3.45), "e   A free edge", (-1.35, -1.6), 1.1)
    (edge,) = valve.anterior
    chord = [b - a for a, b in zip(edge[0], edge[3])]
    inner = [b - a for a, b in zip(edge[1], edge[2])]
    # `share` is the distance of the inner control points from the chord's middle, divided by half the chord. `share` satisfies 1
    # - share = 2/3 (1 - tan(angle / 4)^2).
    share = sum(a * b for a, b in zip(inner, chord)) / sum(a * a for a in chord)
    height = math.sqrt(1 - 1.5 * (1 - share))  # the tip's height divided by half the chord, if the arc is part of a circle
    angle = 4 * math.atan(height)
    sheet.check("leaflet_arc_angle", math.degrees(angle))
    cubic = [(-1, 0), (-share, -4 / 3 * height), (share, -4 / 3 * height), (1, 0)]
    radius = 1 / math.sin(angle / 2)
    centre = (0, radius * math.cos(angle / 2))
    for p in bezier.samples([cubic]):
        if abs(distance(p, centre) / radius - 1) > 0.01:
            raise Refused("leaflet_arc_angle: the free edge is no arc of that angle")
    panel.curve([cubic], lambda p: p, ANTERIOR, 2.4)
    panel.line(centre, cubic[0], color=GREY, width=0.8)
    panel.line(centre, cubic[-1], color=GREY, width=0.8)
    panel.points(cubic[0], (0, -height), cubic[-1], color=ANTERIOR, size=5)
    name = "leaflet_arc_angle"
    panel.angle(name, centre, cubic[0], cubic[-1], 0.35 * radius, (0, 1.25), ha="center")
    text = "A free edge is an arc of this\nangle, stretched so that it\ngoes through its two ends\nand its tip."
    panel.note((0, -0.75), text, ha="center", va="top")


def draw_unrolled(sheet, valve):
    title = "f   Open, unrolled: across, along the annulus; down, the straight way to the free edge"
    panel = sheet.panel((0.15, 0.55), (14.7, 3.05), title, (-4.45, -2.5), 0.905)
    whole = bezier.length(valve.annulus)
    begin = valve.share(valve.commissure)
    for turned in (1, -1):
        outline(panel, valve, whole, turned)
    # Each line leads from a fraction of the annulus' length to a point of a free edge.
    scallop, middle = valve.posterior[0], valve.posterior[1]
    anterior, pm = "anterior_length", "posteromedial_commissure_height"
    hanging = (
        (anterior, 0.5, valve.anterior_tip, ANTERIOR, (0.15, -1.2)),
        (pm, begin, valve.edge_end, GREEN, None),
        (pm, 1 - begin, mirrored(valve.edge_end), GREEN, None),
        (pm, begin / 3, valve.cleft_end, GREEN, (-0.9, -2.15)),
        (pm, -begin / 3, mirrored(valve.cleft_end), GREEN, None),
        ("posterior_scallop_length1", 2 * begin / 3, bezier.point(scallop, 0.5), POSTERIOR, (-0.5, -1.75)),
        ("posterior_scallop_length1", -2 * begin / 3, mirrored(bezier.point(scallop, 0.5)), POSTERIOR, None),
        ("posterior_scallop_length2", 0, bezier.point(middle, 0.5), POSTERIOR, (-1.9, -1.75)),
    )  # fmt: skip
    for name, share, point, color, offset in hanging:
        sheet.check(name, distance(valve.at(share), point))
        x = share * whole
        panel.length(name, (x, 0), (x, -sheet.value(name)), offset and (x + offset[0], offset[1]), color=color, share=0.5)
    name, value = "triangle_size_ratio", f"{sheet.value_text('triangle_size_ratio')} of the annulus' length"
    ends = [(valve.share(p) * whole, 0) for p in (valve.commissure, valve.triangle)]
    panel.length(name, *ends, (ends[0][0] + 0.1, -0.42), shift=(0, -0.16), color=GREEN, factor=whole, value=value)
    ticks = ((-begin, "u = 1 − u_pm"), (-begin / 3, "1 − u_pm / 3"), (0, "0"), (begin / 3, "u_pm / 3"),
             (2 * begin / 3, "2 u_pm / 3"), (begin, "u_pm"), (0.5, "1/2"), (1 - begin, "1 − u_pm"))  # fmt: skip
    for share, text in ticks:
        panel.line((share * whole, 0), (share * whole, 0.06), color=DARK)
        panel.note((share * whole, 0.08), text, ha="center", va="bottom", color=DARK)


def outline(panel, valve, whole, turned):
    """Draws the lengths of the straight lines from the annulus to the free edges. `turned` is 1, or -1 for the mirrored half."""
    for leaflet, color in ((0, ANTERIOR), (1, POSTERIOR)):
        lines = [line for line in valve.lines if line["leaflet"] == leaflet]
        points = []
        for line in lines:
            share = line["u"] if turned > 0 else -line["u"] if leaflet == 1 else 1 - line["u"]
            points.append((share * whole, -distance(line["annulus"], line["edge"])))
        panel.line(*points, color=color, width=2.2)
        panel.axis.fill_between([p[0] for p in points], [p[1] for p in points], 0, color=color, alpha=0.07, linewidth=0)
        panel.line((points[0][0], 0), (points[-1][0], 0), color=ANNULUS, width=2.6)


def draw(mitral):
    sheet = Sheet("Parameters of the mitral valve", mitral["parameters"], (15, 13.7))
    text = "Defaults. u: share of the annulus' length, counter-clockwise from the posterior point; "
    text += "u_pm = 1/2 − anterior_ratio / 2."
    sheet.text(0.30, 1 - 0.27 / 13.7, text, va="center")
    sheet.skirt(13.7)
    closed, half_open, opened = (Valve(state) for state in mitral["states"])
    draw_annulus(sheet, opened)
    draw_closed(sheet, closed)
    draw_saddle(sheet, closed)
    draw_section(sheet, closed, half_open, opened)
    draw_arc(sheet, opened)
    draw_unrolled(sheet, opened)
    names = ("annulus", "anterior leaflet", "posterior leaflet", "free edge of both, commissures, clefts")
    legend = zip(names, (ANNULUS, ANTERIOR, POSTERIOR, PURPLE))
    for i, (text, color) in enumerate(legend):
        sheet.text(0.012 + 0.14 * i, 0.01, "■ " + text, color=color, va="bottom", weight="bold")
    return sheet
