# SPDX-License-Identifier: Apache-2.0
"""Makes technical drawings with the names of parameters: dimension lines, angles, leaders, labels.

Every named length or angle is measured between the drawn points, and compared with the parameter's value. A drawing is refused if
a length or angle in it differs from the parameter. A missing parameter or overlapping labels also lead to a refusal."""

import io
import math

import matplotlib

matplotlib.use("Agg")
matplotlib.rcParams.update({"svg.fonttype": "none", "svg.hashsalt": "riis", "font.family": "DejaVu Sans"})
from matplotlib import pyplot
from PIL import Image, PngImagePlugin

import bezier

# The colours of the drawings can be distinguished with any colour vision (Okabe, Ito 2008), as in the other figures. Dimension
# lines and names are dark.
BLUE, GREEN, PURPLE, VERMILION = "#0072b2", "#009e73", "#b5548f", "#d55e00"
DARK, GREY, PALE = "#2d2d2d", "#828282", "#c4c4c4"
SMALL, NORMAL, LARGE = 9, 10, 11.5  # font sizes, in points


class Refused(Exception):
    """Raised if the drawing would be false, incomplete or unreadable."""


def plain(value):
    """Returns the shortest text of the number, with a typographic minus sign."""
    return f"{value:.6g}".replace("-", "−")


def along(p, q, share):
    return tuple(a + share * (b - a) for a, b in zip(p, q))


def distance(p, q):
    return math.dist(p, q)


class Sheet:
    """A drawing of several panels for one kind of valve. If the three cusps differ, the drawing shows `cusp`."""

    def __init__(self, title, parameters, size, cusp=None):
        # The drawings show parameters up to the skirt's length. Later parameters change single cusps, commissures and places.
        names = [each["name"] for each in parameters]
        n_drawn = names.index("skirt_length") + 1 if "skirt_length" in names else len(names)
        self.parameters = {each["name"]: each for each in parameters[:n_drawn]}
        self.cusp, self.size, self.named = cusp, size, set()
        self.texts = []
        self.figure = pyplot.figure(figsize=size)
        self.text(0.012, 1 - 0.14 / size[1], title, fontsize=LARGE + 3, weight="bold", va="top")

    # ------------------------------------------------------------------------------------------------------- parameters

    def of_cusps(self, name):
        """Returns the parameter of every cusp. `name` is the parameter's name without the cusp."""
        return [each for full, each in self.parameters.items() if full.partition(".")[2] == name]

    def value(self, name):
        """Returns the default of the drawn parameter."""
        if name in self.parameters:
            values = self.parameters[name]["values"]
            return values[0] if len(values) == 1 else values[("right", "left", "non_coronary").index(self.cusp)]
        own = f"{self.cusp}.{name}"
        if own not in self.parameters:
            raise Refused(f"{name} is not a parameter")
        return self.parameters[own]["values"][0]

    def mark_named(self, name):
        if name in self.parameters:
            self.named.add(name)
            return
        found = self.of_cusps(name)
        if not found:
            raise Refused(f"{name} is drawn, but is not a parameter")
        self.named.update(each["name"] for each in found)

    def unit(self, name):
        each = self.parameters.get(name) or self.of_cusps(name)[0]
        return {"length": " cm", "degree": "°", "1": ""}[each["unit"]]

    def value_text(self, name):
        """Returns the defaults with their unit: one value, or the values of the three cusps."""
        if name in self.parameters:
            values = self.parameters[name]["values"]
        else:
            values = [each["values"][0] for each in self.of_cusps(name)]
        return " | ".join(map(plain, values)) + self.unit(name)

    def check(self, name, measured, value=None):
        """Refuses a drawing whose length, angle or ratio differs from the value."""
        value = self.value(name) if value is None else value
        if not abs(measured - value) <= 1e-7 * max(1, abs(value)):
            raise Refused(f"{name} is {value}, but the drawing shows {measured}")

    # ------------------------------------------------------------------------------------------------------------ texts

    def text(self, x, y, text, axis=None, **style):
        """Adds a text, which is checked for overlaps with other texts. If an axis is given, x and y are its coordinates.
        Otherwise x and y are fractions of the figure."""
        made = (axis.text if axis else self.figure.text)(x, y, text, **{"fontsize": NORMAL, "color": DARK, **style})
        self.texts.append(made)
        return made

    def panel(self, corner, size, title, left_bottom, centimetres):
        return Panel(self, corner, size, title, left_bottom, centimetres)

    def skirt(self, height):
        """Names the skirt's length at the right of the sheet's first line. The drawings show no skirt."""
        self.mark_named("skirt_length")
        text = f"skirt_length {self.value('skirt_length'):g}: no skirt"
        self.text(0.992, 1 - 0.27 / height, text, va="center", ha="right")

    # ------------------------------------------------------------------------------------------------------------ whole

    def missing(self):
        return [name for name in self.parameters if name not in self.named]

    def overlaps(self):
        """Returns pairs of texts that overlap, and texts that extend beyond the sheet."""
        renderer = self.figure.canvas.get_renderer()
        boxes = [(text.get_text(), text.get_window_extent(renderer)) for text in self.texts]
        width, height = self.figure.canvas.get_width_height()
        found = []
        for i, (text, box) in enumerate(boxes):
            if box.x0 < 0 or box.y0 < 0 or box.x1 > width or box.y1 > height:
                found.append(f"'{text}' leaves the sheet")
            for other_text, other in boxes[:i]:
                if box.x0 < other.x1 and other.x0 < box.x1 and box.y0 < other.y1 and other.y0 < box.y1:
                    found.append(f"'{text}' overlaps '{other_text}'")
        return found

    def check_whole(self):
        """Refuses a drawing that omits a parameter or is unreadable."""
        if self.missing():
            raise Refused(f"not drawn: {', '.join(self.missing())}")
        self.figure.canvas.draw()
        if self.overlaps():
            raise Refused("; ".join(self.overlaps()))

    def save(self, path):
        """Writes PATH.svg with lines and texts. Also writes PATH.png, with few colours to keep the file small. PATH.png has the
        names and defaults as metadata."""
        self.check_whole()
        drawn, about = io.BytesIO(), PngImagePlugin.PngInfo()
        self.figure.savefig(drawn, dpi=100, format="png")
        for name, each in self.parameters.items():
            about.add_text(name, " ".join(f"{value:.12g}" for value in each["values"]))
        picture = Image.open(drawn).convert("RGB").quantize(128, dither=Image.Dither.NONE)
        picture.save(path + ".png", optimize=True, pnginfo=about)
        self.figure.savefig(path + ".svg", metadata={"Date": None})
        pyplot.close(self.figure)


class Panel:
    """A view with plane coordinates in centimetres. The view's lower left corner is left_bottom. Both axes have one scale, in
    centimetres per inch of the sheet."""

    def __init__(self, sheet, corner, size, title, left_bottom, centimetres):
        self.sheet = sheet
        (x, y), (width, height) = corner, size
        whole_width, whole_height = sheet.size
        self.axis = sheet.figure.add_axes([x / whole_width, y / whole_height, width / whole_width, height / whole_height])
        limits = [(low, low + inches * centimetres) for low, inches in zip(left_bottom, size)]
        self.axis.set(xlim=limits[0], ylim=limits[1])
        self.axis.axis("off")
        sheet.text(x / whole_width, (y + height + 0.06) / whole_height, title, fontsize=LARGE, weight="bold", va="bottom")

    # ------------------------------------------------------------------------------------------------------------ lines

    def line(self, *points, color=DARK, width=0.8, style="-", zorder=2):
        self.axis.plot(*zip(*points), color=color, linewidth=width, linestyle=style, zorder=zorder, solid_capstyle="round")

    def curve(self, pieces, project, color, width=2.2, style="-", zorder=3):
        self.line(*(project(p) for p in bezier.samples(pieces)), color=color, width=width, style=style, zorder=zorder)

    def points(self, *points, color=DARK, size=4, zorder=4, marker="o", filled=True):
        face = color if filled else "white"
        self.axis.plot(
            *zip(*points), linestyle="none", marker=marker, markersize=size, color=color, markerfacecolor=face, zorder=zorder
        )

    def arrow(self, p, q, color=DARK, both=True, width=0.9, size=8):
        style = {"arrowstyle": "<|-|>" if both else "-|>", "mutation_scale": size, "shrinkA": 0, "shrinkB": 0}
        self.axis.annotate("", xy=q, xytext=p, arrowprops={**style, "color": color, "linewidth": width}, zorder=5)

    def note(self, at, text, color=GREY, ha="left", va="center", fontsize=SMALL, **style):
        style = {"linespacing": 1.2, **style}
        self.sheet.text(*at, text, axis=self.axis, color=color, ha=ha, va=va, fontsize=fontsize, zorder=7, **style)

    # ----------------------------------------------------------------------------------------------------------- labels

    def label(self, name, at, to=None, ha="left", color=DARK, shown=None, value=None):
        """Adds a name and its value at a position. If `to` is given, a leader leads from the texts to this point. `shown` is the
        text for a name that is inside a formula."""
        self.sheet.mark_named(name)
        if at is None:  # the name is elsewhere in the panel
            return
        points_of_line = 1 / 72 / self.sheet.size[1]
        to_figure = self.sheet.figure.transFigure.inverted()
        x, y = to_figure.transform(self.axis.transData.transform(at))
        box = {"facecolor": "white", "edgecolor": "none", "pad": 0.6, "alpha": 0.85}
        style = {"ha": ha, "color": color, "zorder": 7, "bbox": box}
        title = self.sheet.text(x, y + points_of_line, shown or name, weight="bold", va="bottom", **style)
        below = self.sheet.text(x, y - points_of_line, value or self.sheet.value_text(name), fontsize=SMALL, va="top", **style)
        if to is not None:
            self.line(self.edge_towards(to, title, below), to, color=color, width=0.6, zorder=6)
            self.points(to, color=color, size=2.2, zorder=6)

    def edge_towards(self, to, *texts):
        """Returns the point at which a leader leaves texts. The leader leaves at the point of the texts' bounding box that is
        nearest to the leader's end."""
        renderer = self.sheet.figure.canvas.get_renderer()
        boxes = [text.get_window_extent(renderer) for text in texts]
        x, y = self.axis.transData.transform(to)
        x = min(max(x, min(box.x0 for box in boxes) - 3), max(box.x1 for box in boxes) + 3)
        y = min(max(y, min(box.y0 for box in boxes) - 2), max(box.y1 for box in boxes) + 2)
        return tuple(self.axis.transData.inverted().transform((x, y)))

    def length(
        self, name, p, q, at, shift=(0, 0), ha="left", color=DARK, shown=None, value=None, factor=1.0, share=0.5, example=None
    ):
        """Draws a length from p to q: a dimension line, extension lines, and the length's name. The dimension line is `shift`
        away from the line p q. The drawn length is `factor` times the parameter, or an example. The leader ends at the fraction
        `share` of the dimension line."""
        self.sheet.check(name, distance(p, q) / abs(factor), example)
        moved = [(a[0] + shift[0], a[1] + shift[1]) for a in (p, q)]
        if shift != (0, 0):
            for a, b in zip((p, q), moved):
                self.line(a, along(a, b, 1 + 0.03 / max(distance(a, b), 1e-9)), color=color, width=0.5)
        self.arrow(*moved, color=color)
        self.label(name, at, along(*moved, share), ha, color, shown, value)

    def angle(
        self, name, centre, begin, end, radius, at, ha="left", color=DARK, share=0.5, shown=None, sense=1, value=None, text=None
    ):
        """Draws an angle at `centre` as an arc from the direction of `begin` to the direction of `end`. The arc runs
        anticlockwise if sense is 1."""
        start, stop = (math.degrees(math.atan2(p[1] - centre[1], p[0] - centre[0])) for p in (begin, end))
        measured = (stop - start) * sense
        measured = (measured + 180) % 360 - 180
        self.sheet.check(name, measured, value)
        stop = start + sense * measured
        angles = [math.radians(start + (stop - start) * i / 48) for i in range(49)]
        arc = [(centre[0] + radius * math.cos(a), centre[1] + radius * math.sin(a)) for a in angles]
        self.line(*arc, color=color, width=0.9, zorder=5)
        for before, end in ((arc[-4], arc[-1]), (arc[3], arc[0])):
            self.arrow(before, end, color=color, both=False, size=6, width=0.5)
        self.label(name, at, arc[round(48 * share)], ha, color, shown, text)
