# SPDX-License-Identifier: Apache-2.0
"""Draws the meaning of the bileaflet valve's parameters (docs/theory/bileaflet.md)."""

import math

from sheet import BLUE, DARK, GREEN, GREY, VERMILION, Sheet, plain

POSITIVE, NEGATIVE, HOUSING = BLUE, VERMILION, GREEN
AXIS = (0, (8, 3, 2, 3))


def plan(p):
    return p[0], p[1]


def section(p):
    return p[0], p[2]


def halves(state, leaflet):
    return [half for half in state["halves"] if half["leaflet"] == leaflet]


def symmetry_line(state, leaflet):
    """Returns the leaflet's line in the plane y = 0, from the rim to the middle edge."""
    line = halves(state, leaflet)[0]["u0"][0]
    return section(line[0]), section(line[-1])


def crossing(a, b, c, d):
    """Returns the point at which the lines a b and c d meet."""
    (ax, ay), (bx, by), (cx, cy), (dx, dy) = a, b, c, d
    share = ((cx - ax) * (dy - cy) - (cy - ay) * (dx - cx)) / ((bx - ax) * (dy - cy) - (by - ay) * (dx - cx))
    return ax + share * (bx - ax), ay + share * (by - ay)


def slope(line):
    """Returns the angle of a leaflet from the orifice plane, in degrees."""
    (x, z), (x_middle, z_middle) = line
    return math.degrees(math.atan2(z - z_middle, abs(x) - abs(x_middle)))


class Drawing:
    def __init__(self, bileaflet):
        self.sheet = Sheet("Parameters of the bileaflet valve", bileaflet["parameters"], (15, 7.3))
        self.example = bileaflet["example"]
        self.states = bileaflet["states"]
        closed, _, opened = (symmetry_line(state, 0) for state in self.states)
        self.hinge = crossing(*closed, *opened)

    def value_text(self, name):
        return f"{self.sheet.value_text(name)}; here {plain(self.example[name])} cm"

    def shown(self, name, p, q, at, **style):
        """Draws a length whose default is 0, with the value of an example."""
        self.sheet.check(name, 0)
        self.panel.length(name, p, q, at, value=self.value_text(name), example=self.example[name], **style)

    def draw_section(self):
        title = "a   The symmetry plane y = 0, seen along the hinges"
        self.panel = panel = self.sheet.panel((0.15, 0.5), (7.75, 6.0), title, (-2.05, -1.25), 0.55)
        closed, half_open, opened = self.states
        wall, h = halves(closed, 2), self.hinge
        panel.line((0, -1.0), (0, 1.75), color=GREY, width=0.6, style=AXIS)
        panel.note((0.04, 1.85), "axis of the housing, z", ha="center", va="bottom")
        panel.line((-1.3, 0), (1.3, 0), color=GREY, width=0.6)
        panel.note((-1.35, 0), "orifice plane,\nz = 0", ha="right")
        panel.arrow((-0.55, -0.95), (-0.55, -0.5), color=GREY, both=False, width=1.4, size=14)
        panel.note((-0.62, -0.75), "blood", ha="right")
        lower, upper = wall[0]["v0"][0][0], wall[0]["v1"][0][0]
        for side in (1, -1):
            ends = [(side * p[0], p[2]) for p in (lower, upper)]
            panel.line(*ends, color=HOUSING, width=3)
        for state, style in ((opened, "--"), (half_open, ":"), (closed, "-")):
            panel.line(*symmetry_line(state, 0), color=POSITIVE, width=2.6 if style == "-" else 1.4, style=style)
            panel.line(*symmetry_line(state, 1), color=NEGATIVE, width=2.6 if style == "-" else 1.4, style=style)
        panel.points(h, (-h[0], h[1]), size=6, filled=False)
        self.shown("hinge_height", (h[0], 0), h, (1.32, 0.06), shift=(0.5, 0))
        panel.length("hinge_offset", (0, h[1]), h, (0.5, 1.5), shift=(0, 1.3), share=0.9)
        self.shown("ring_height", section(lower), section(upper), (1.32, -0.38), shift=(0.12, 0), color=HOUSING, share=0.2)
        level, apex, tip = (h[0] + 1, h[1]), symmetry_line(closed, 0)[0], symmetry_line(opened, 0)[0]
        panel.line(h, (h[0] + 0.75, h[1]), color=GREY, width=0.5)
        panel.angle("closed_angle", h, level, apex, 0.66, (1.32, 0.55), color=POSITIVE, share=0.6)
        panel.angle("open_angle", h, level, tip, 0.4, (1.32, 0.95), color=POSITIVE, share=0.7)
        self.draw_opening()

    def draw_opening(self):
        """Draws the opening on the leaflet at x < 0. The opening is the fraction of the way from the closed to the open angle."""
        panel, sheet = self.panel, self.sheet
        lines = [symmetry_line(state, 1) for state in self.states]
        closed, half_open, opened = map(slope, lines)
        sheet.check("opening", self.states[0]["opening"])
        sheet.check("opening", (half_open - closed) / (opened - closed), self.states[1]["opening"])
        for line, state in zip(lines, self.states):
            (x, z), text = line[0], plain(state["opening"])
            panel.note((x - 0.06, z + 0.04), text, color=NEGATIVE, ha="right", va="bottom")
        centre, radius = (-self.hinge[0], self.hinge[1]), 0.85
        angles = [math.radians(180 - closed - (opened - closed) * i / 40) for i in range(41)]
        arc = [(centre[0] + radius * math.cos(a), centre[1] + radius * math.sin(a)) for a in angles]
        panel.line(*arc, color=NEGATIVE, width=0.9)
        panel.arrow(arc[-4], arc[-1], color=NEGATIVE, both=False, size=7, width=0.6)
        value = f"{sheet.value_text('opening')}: closed, to 1: open;\nthe leaflets turn evenly"
        panel.label("opening", (-1.0, 1.5), arc[24], ha="right", color=NEGATIVE, value=value)

    def draw_plan(self):
        title = "b   Closed (lines) and open (dashes), seen from downstream"
        self.panel = panel = self.sheet.panel((8.0, 0.5), (6.9, 6.0), title, (-1.85, -1.65), 0.55)
        closed, _, opened = self.states
        for leaflet, color in ((0, POSITIVE), (1, NEGATIVE)):
            for half in halves(closed, leaflet):
                panel.curve(half["v0"], plan, color, 2.4)
                panel.curve(half["v1"], plan, color, 2.4)
            for half in halves(opened, leaflet):
                panel.curve(half["v0"], plan, color, 1.2, style="--")
                panel.curve(half["v1"], plan, color, 1.2, style="--")
        radius = closed["halves"][0]["v0"][0][0][0]
        for half in halves(closed, 2):
            panel.curve(half["v0"], plan, HOUSING, 6, zorder=1)
        for side in (1, -1):
            x = side * self.hinge[0]
            panel.line((x, -1.25), (x, 1.25), color=GREY, width=0.6, style=AXIS)
        panel.note((self.hinge[0] + 0.05, -1.3), "hinge lines", va="top")
        panel.points((0, 0), color=DARK, size=5, marker="+")
        slant = math.radians(-35)
        rim = (radius * math.cos(slant), radius * math.sin(slant))
        panel.length("radius", (0, 0), rim, (1.15, -0.95), color=HOUSING, share=0.85)
        edge = plan(halves(closed, 0)[0]["v1"][0][0])
        self.shown("gap", (-edge[0], edge[1]), edge, (-1.8, 1.35), shift=(0, 1.35), share=0.0)
        panel.note((0.62, 0.45), "leaflet\nx > 0", color=POSITIVE, ha="center")
        panel.note((-0.62, 0.45), "leaflet\nx < 0", color=NEGATIVE, ha="center")

    def draw(self):
        names = ", ".join(self.example)
        text = f"Defaults. Drawn with other values: {names}, which are 0 by default. A ring_height of 0 makes no wall."
        self.sheet.text(0.31, 1 - 0.27 / 7.3, text, va="center")
        self.draw_section()
        self.draw_plan()
        legend = (("leaflet of x > 0", POSITIVE), ("leaflet of x < 0, the other turned by 180°", NEGATIVE), ("housing", HOUSING))
        for x, (text, color) in zip((0.012, 0.15, 0.45), legend):
            self.sheet.text(x, 0.02, "■ " + text, color=color, va="bottom", weight="bold")
        return self.sheet


def draw(bileaflet):
    return Drawing(bileaflet).draw()
