# SPDX-License-Identifier: Apache-2.0
"""Markdown and plots for report.py."""

import textwrap


def paragraph(text):
    """Wraps text like all pages. Code in backticks and links may be cut only at spaces."""
    return textwrap.fill(text, width=100, break_long_words=False, break_on_hyphens=False) + "\n"


def number(value):
    """Formats with three significant digits."""
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
    """Plots with logarithmic axes. Without matplotlib there are none, and a line says so."""

    @staticmethod
    def _pyplot():
        try:
            import matplotlib
        except ImportError:
            print("==> no matplotlib (python3-matplotlib): the page is made without plots")
            return None
        matplotlib.use("Agg")
        matplotlib.rcParams.update({"svg.hashsalt": "riis", "font.size": 8})
        import matplotlib.pyplot

        return matplotlib.pyplot

    @staticmethod
    def can_draw():
        return bool(figure._pyplot())

    @staticmethod
    def _save(pyplot, plot, path):
        # The program's version is left out, so that the same data gives the same bytes.
        plot.savefig(path, dpi=110, metadata={"Software": None})
        pyplot.close(plot)
        return True

    @staticmethod
    def lines(panels, across, up, path, ticks=None, limit=None):
        """panels: titles and lines. A line is a label, points and a style, and has the same colour in all panels. ticks: the
        horizontal ones, in place of powers of ten. limit: (at, text), with the area beyond shaded and labelled with the text."""
        pyplot = figure._pyplot()
        if not pyplot:
            return False
        plot, ((*axes,),) = pyplot.subplots(1, len(panels), figsize=(8.5, 3.6), sharey=True, squeeze=False, layout="constrained")
        for axis, (title, lines) in zip(axes, panels):
            for index, (label, points, style) in enumerate(lines):
                if not points:
                    continue
                axis.loglog(*zip(*points), style, marker="o", markersize=3, linewidth=1, color=f"C{index}", label=label)
            axis.set(title=title, xlabel=across)
            axis.grid(True, which="major", linewidth=0.3)
            if ticks:
                for ruler in (axis.xaxis, axis.yaxis):
                    ruler.set_major_locator(pyplot.FixedLocator(ticks))
                    ruler.set_major_formatter("{x:g}")
                    ruler.set_minor_locator(pyplot.NullLocator())
            if limit and limit[0] < axis.get_xlim()[1]:
                end = axis.get_xlim()[1]
                axis.axvspan(limit[0], end, color="0.9", zorder=0)
                axis.axvline(limit[0], color="0.5", linewidth=0.8, linestyle=":")
                axis.text(0.97, 0.03, limit[1], transform=axis.transAxes, ha="right", va="bottom", fontsize=7, color="0.3")
                axis.set_xlim(right=end)
        axes[0].set_ylabel(up)
        if axes[-1].get_legend_handles_labels()[1]:
            axes[-1].legend(fontsize=6, loc="center left", bbox_to_anchor=(1, 0.5))
        return figure._save(pyplot, plot, path)

    @staticmethod
    def bars(panels, across, path):
        pyplot = figure._pyplot()
        if not pyplot:
            return False
        plot, axes = pyplot.subplots(1, len(panels), figsize=(8.5, 2.8), sharey=True, layout="constrained")
        for axis, (title, bars) in zip(axes, panels):
            names, values = zip(*bars)
            colors = ["C1" if name.startswith("riis") else "C0" for name in names]
            axis.barh(names, values, color=colors)
            axis.set(title=title, xlabel=across, xscale="log")
            axis.grid(True, axis="x", which="major", linewidth=0.3)
        return figure._save(pyplot, plot, path)
