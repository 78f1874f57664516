# SPDX-License-Identifier: Apache-2.0
"""Makes markdown and plots for report.py."""

import re
import textwrap

# The colours of lines and bars are those of the program's pictures (src/riis_vtk/picture/drawing.hpp), and a dark colour. These
# colours are distinct for all kinds of colour vision.
COLOURS = ("#0072b2", "#e69f00", "#009e73", "#cc79a7", "#d55e00", "#56b4e9", "#2d2d2d")

_TAG = re.compile(r"^[ \t]*\{\{([#^/])(\w+)\}\}[ \t]*\n|\{\{([#^/]?)(\w+)\}\}", re.MULTILINE)


class Template:
    """Markdown with placeholders for values, in the syntax of Mustache.

    {{name}} is a value. {{#name}} ... {{/name}} is used if the value is not empty, once for each item of a list. If an item is a
    dict, its names can be used inside. {{^name}} ... {{/name}} is used if the value is empty. A name without a value is an error.
    """

    def __init__(self, text):
        self._parts, stack, end = [], [("", [])], 0
        for found in _TAG.finditer(text):
            kind, name = found[1] or found[3] or "", found[2] or found[4]
            stack[-1][1].append(text[end : found.start()])
            end = found.end()
            if kind in ("#", "^"):
                stack.append((name, []))
                stack[-2][1].append((kind, name, stack[-1][1]))
            elif kind == "/":
                if stack.pop()[0] != name or not stack:
                    raise ValueError(f"{{{{/{name}}}}} ends a part that was not begun last")
            else:
                stack[-1][1].append((kind, name, None))
        if len(stack) > 1:
            raise ValueError(f"{{{{#{stack[-1][0]}}}}} has no end")
        self._parts = stack[0][1] + [text[end:]]

    def fill(self, values, only=None):
        """Returns the text with wrapped prose: the whole text, or only the parts with the name `only`."""
        parts = [part for part in self._parts if only is None or part[1:2] == (only,)]
        return wrapped(_filled(parts, [values]))


def _value(name, scopes):
    for scope in reversed(scopes):
        if name in scope:
            return scope[name]
    raise KeyError(f"the template asks for {name}, which has no value")


def _filled(parts, scopes):
    text = []
    for part in parts:
        if isinstance(part, str):
            text.append(part)
            continue
        kind, name, inner = part
        value = _value(name, scopes)
        if kind == "":
            text.append(str(value))
        elif kind == "^":
            text += [] if value else [_filled(inner, scopes)]
        else:
            for item in value if isinstance(value, list) else [value] if value else []:
                text.append(_filled(inner, scopes + [item] if isinstance(item, dict) else scopes))
    return "".join(text)


_PLACE = re.compile(r"<!--=([\w.]+)-->(\n?)(.*?)<!--/-->", re.DOTALL)


def fill_in_place(path, values, to=None):
    """Writes the values between their marks in a page, or in a copy of the page.

    The mark `<!--=a.b-->` begins the place of values["a"]["b"], and `<!--/-->` ends it. A mark alone on a line begins a block
    such as a table. Other marks must not begin a line, because Markdown would take such a line for HTML. A place without a value,
    or with the value None, keeps its text. Returns the names of the places that keep their text."""
    left = []

    def put(found):
        value = values
        for name in found[1].split("."):
            value = value.get(name) if isinstance(value, dict) else None
        if value is None:
            left.append(found[1])
            return found[0]
        text = str(value).strip()
        return f"<!--={found[1]}-->" + (f"\n\n{text}\n\n" if found[2] else text) + "<!--/-->"

    with open(path, encoding="utf-8") as file:
        page = _PLACE.sub(put, file.read())
    with open(to or path, "w", encoding="utf-8") as file:
        file.write(page)
    return left


def without_marks(text):
    """Returns a page as readers see it."""
    return re.sub(r"^<!--(=[\w.]+|/)-->\n\n|<!--(=[\w.]+|/)-->", "", text, flags=re.MULTILINE)


def wrapped(text):
    """Wraps paragraphs and list items as on all pages, and puts one empty line between blocks. Tables and similar blocks stay
    unchanged."""
    blocks = [block.strip("\n") for block in re.split(r"\n(?:[ \t]*\n)+", text)]
    return (
        "\n\n".join(block if block.startswith(("|", "#", "!", "<!--")) else _wrapped_block(block) for block in blocks if block)
        + "\n"
    )


def _wrapped_block(block):
    items = re.split(r"\n(?=- )", block)
    return "\n".join(_wrapped_item(item, "- " if item.startswith("- ") else "") for item in items)


def _wrapped_item(item, mark):
    # A line must not begin with a per cent sign. Code in backticks and links are broken only at spaces.
    text = " ".join(item[len(mark) :].split()).replace(" %", "~%")
    indents = {"initial_indent": mark, "subsequent_indent": " " * len(mark)}
    return textwrap.fill(text, width=100, break_long_words=False, break_on_hyphens=False, **indents).replace("~%", " %")


def number(value):
    """Returns the number with three significant digits."""
    if value >= 999.5:
        return grouped(value)
    digits = 0 if value >= 99.95 else 1 if value >= 9.995 else 2 if value >= 0.9995 else 3
    return f"{value:.{digits}f}"


def grouped(value):
    return f"{round(value):,}"


def plural(count, noun):
    return f"{grouped(count)} {noun}" + ("" if count == 1 else "s")


def table(heads, rows):
    lines = ["| " + " | ".join(heads) + " |", "|" + "---|" * len(heads)]
    for row in rows:
        if len(row) != len(heads):
            raise ValueError(f"{len(row)} cells below {len(heads)} heads: {row}")
        lines.append("| " + " | ".join(row) + " |")
    return "\n".join(lines) + "\n"


class figure:
    """Makes plots with logarithmic axes. If matplotlib is missing, the class makes no plots, and prints a line that says so."""

    @staticmethod
    def _pyplot():
        try:
            import matplotlib
        except ImportError:
            print("==> matplotlib (python3-matplotlib) is missing: the page is made without plots")
            return None
        matplotlib.use("Agg")
        cycle = matplotlib.cycler(color=COLOURS)
        matplotlib.rcParams.update({"svg.hashsalt": "riis", "font.size": 9.5, "axes.prop_cycle": cycle})
        import matplotlib.pyplot

        return matplotlib.pyplot

    @staticmethod
    def can_draw():
        return bool(figure._pyplot())

    @staticmethod
    def _save(pyplot, plot, path):
        # The version of the program is omitted, so that equal data gives equal bytes.
        plot.savefig(path, dpi=140, metadata={"Software": None})
        pyplot.close(plot)
        return True

    @staticmethod
    def lines(panels, across, up, path, ticks=None):
        """Draws lines, with one key below all panels. panels: titles and lines. A line is a label, points and a style. A label
        has one colour and marker in all panels. ticks: values on the axes, instead of powers of ten."""
        pyplot = figure._pyplot()
        if not pyplot:
            return False
        plot = pyplot.figure(figsize=(7.2, 4.4), layout="constrained")
        grid = plot.add_gridspec(2, len(panels), height_ratios=(5, 1))
        axes = [plot.add_subplot(grid[0, 0])]
        axes += [plot.add_subplot(grid[0, at], sharey=axes[0]) for at in range(1, len(panels))]
        for axis in axes[1:]:
            axis.tick_params(labelleft=False)
        for axis, (title, lines) in zip(axes, panels):
            for index, (label, points, style) in enumerate(lines):
                if not points:
                    continue
                look = {"color": f"C{index}", "marker": "os^Dvp*X"[index % 8]} if style != ":" else {"color": "0.55"}
                axis.loglog(*zip(*points), style, markersize=4.5, linewidth=1.3, label=label, **look)
            axis.set(title=title, xlabel=across)
            axis.grid(True, which="major", linewidth=0.3)
            if ticks:
                for ruler in (axis.xaxis, axis.yaxis):
                    ruler.set_major_locator(pyplot.FixedLocator(ticks))
                    ruler.set_major_formatter("{x:g}")
                    ruler.set_minor_locator(pyplot.NullLocator())
        axes[0].set_ylabel(up)
        handles, labels = axes[-1].get_legend_handles_labels()
        if labels:
            key = plot.add_subplot(grid[1, :])
            key.set_axis_off()
            key.legend(handles, labels, ncols=3, loc="center", frameon=False)
        return figure._save(pyplot, plot, path)

    @staticmethod
    def bars(panels, across, path):
        pyplot = figure._pyplot()
        if not pyplot:
            return False
        plot, axes = pyplot.subplots(1, len(panels), figsize=(9, 3.4), sharey=True, layout="constrained")
        for axis, (title, bars) in zip(axes, panels):
            names, values = zip(*bars)
            colors = ["C1" if name.startswith("riis") else "C0" for name in names]
            axis.barh(names, values, color=colors)
            axis.set(title=title, xlabel=across, xscale="log")
            axis.xaxis.set_major_locator(pyplot.LogLocator())
            axis.tick_params(axis="y", labelsize=8.5)
            axis.grid(True, axis="x", which="major", linewidth=0.3)
        return figure._save(pyplot, plot, path)
