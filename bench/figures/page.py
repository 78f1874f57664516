# SPDX-License-Identifier: Apache-2.0
"""Writes one HTML file that contains everything, with pictures as base64 and inline styles. The file has no scripts and loads
nothing."""

import base64
import json
import os
import struct
from typing import NamedTuple

from library import Refused

MAX_COLUMNS = 4


class Panel(NamedTuple):
    png: bytes
    caption: str


class Figure(NamedTuple):
    """A figure. The texts are HTML, and the numbers in the texts are counted while the figures are drawn."""

    title: str
    columns: int
    panels: list
    caption: str
    paper: str  # the part of the paper that the figure shows
    key: tuple = ()  # pairs of a colour and its meaning
    table: str = ""  # a table below the pictures


def count(n):
    return f"{n:,}"


def number(value, digits=3):
    """Returns the number with at most this many significant digits. For example, 0.050 becomes "0.05"."""
    return f"{value:.{digits}g}"


def percent(share):
    return number(100 * share) + " %"


def html_table(rows):
    """Returns an HTML table of texts. The first row is the table's head."""
    lines = [
        "<tr>" + "".join(f"<{tag}>{cell}</{tag}>" for cell in row) + "</tr>\n"
        for row, tag in zip(rows, ["th"] + ["td"] * (len(rows) - 1))
    ]
    return "<table>\n" + "".join(lines) + "</table>\n"


def size_of(png, path):
    """Returns width and height. A PNG begins with its signature, then its width and height."""
    if len(png) < 24 or png[:16] != b"\x89PNG\r\n\x1a\n\0\0\0\rIHDR":
        raise Refused(f"{path}: no PNG")
    return struct.unpack(">II", png[16:24])


def read_file(path, mode="rb", **how):
    try:
        with open(path, mode, **how) as file:
            return file.read()
    except OSError:
        raise Refused(f"{path}: cannot be read") from None


def given_figure(path, given):
    """Returns a figure of a JSON file. Paths of pictures start from the file's folder."""
    texts = [given[name] for name in ("title", "caption", "paper")]
    if not all(isinstance(text, str) for text in texts):
        raise TypeError("a text is not a string")
    columns, panels = given["columns"], []
    if columns not in range(1, MAX_COLUMNS + 1):
        raise Refused(f"{path}: columns = {columns} is not 1 to {MAX_COLUMNS}")
    for panel in given["panels"]:
        place = os.path.join(os.path.dirname(path), panel["png"])
        png = read_file(place)
        size_of(png, place)
        panels.append(Panel(png, panel["caption"]))
    return Figure(texts[0], columns, panels, *texts[1:])


def read_figures(path):
    """Reads figures that another program drew for the same page: {"figures": [{"title", "columns", "panels": [{"png", "caption"},
    ...], "caption", "paper"}, ...], "left_out": [...]}. "left_out" names the missing figures, and the commands that make these
    figures. Returns the figures and the texts of "left_out"."""
    text = read_file(path)
    try:
        given = json.loads(text)
        left_out = given.get("left_out", [])
        if not all(isinstance(each, str) for each in left_out):
            raise TypeError("left_out has another value than texts")
        return [given_figure(path, each) for each in given["figures"]], left_out
    except (ValueError, KeyError, TypeError, AttributeError) as error:
        raise Refused(f"{path}: {error}") from None


HEAD = """<!DOCTYPE html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<title>riis in figures</title>
<style>
body { font: 16px/1.5 system-ui, "Segoe UI", Helvetica, Arial, sans-serif; color: #222; background: #fff;
       max-width: 1240px; margin: 0 auto; padding: 1.5em; }
h1 { font-size: 1.7em; margin: 0 0 .3em; }
h2 { font-size: 1.2em; margin: 0 0 .5em; }
nav ol { columns: 2; padding-left: 1.4em; }
a { color: #0060a0; }
section { border-top: 1px solid #ccc; margin-top: 2.5em; padding-top: 1.2em; }
.panels { display: grid; gap: 14px; }
figure { margin: 0; }
figure img { width: 100%; height: auto; display: block; border: 1px solid #e4e4e4; }
figcaption { font-size: .88em; padding: .3em .2em 0; }
.key { font-size: .9em; margin: .8em 0 0; }
.key span { white-space: nowrap; margin-right: 1.4em; }
.key i { display: inline-block; width: .85em; height: .85em; border-radius: 2px; margin-right: .4em; vertical-align: -.08em; }
.caption { max-width: 62em; margin: .8em 0 0; }
.paper { color: #555; font-size: .9em; max-width: 68em; margin: .5em 0 0; }
table { border-collapse: collapse; font-size: .9em; margin: 1em 0 0; }
th, td { border-bottom: 1px solid #ddd; padding: .2em .9em .2em 0; text-align: left; vertical-align: top; }
th { border-bottom: 1px solid #888; }
code { font-size: .92em; }
@media (max-width: 640px) { .panels { grid-template-columns: 1fr !important; } nav ol { columns: 1; } }
@media print { section { break-inside: avoid; } body { max-width: none; padding: 0; } }
</style>
</head>
<body>
"""
INTRODUCTION = """<h1>riis in figures</h1>
<p>Every picture and every number on this page is computed by riis {version} itself: by the code that marks nodes, with the \
parameters of B. van der Vuurst, J. Kosinka and C. Bertoglio, <i>Fast generation of 3D flow obstacles from parametric surface \
models: application to cardiac valves</i> (2025), “the paper”. Only the paper's own times come from there. The trileaflet, the \
coapting and the bileaflet valve are not the paper's and have parameters of their own. Lengths are centimetres. The \
<i>tolerance</i> is the share of the half thickness, 0.1 cm, by which distances to the triangles may differ from distances to \
the smooth surface: 5 % stands for 0.005 cm. <a href="../../docs/view.md">riis view</a> shows a valve in your own mesh, and \
moves it with your hands.</p>
"""


def html_of(figure, n):
    """Returns the section of a figure."""
    text = (
        f'<section id="figure-{n}">\n<h2>Figure {n}. {figure.title}</h2>\n'
        f'<div class="panels" style="grid-template-columns: repeat({figure.columns}, 1fr)">\n'
    )
    for letter, (png, caption) in zip("abcdefghijklmnopqrstuvwxyz", figure.panels):
        # The attributes give the size of the picture. The style sheet lets the panel decide how large it is displayed.
        width, height = size_of(png, "a picture")
        text += (
            f'<figure><img width="{width}" height="{height}" alt="Figure {n}{letter}" '
            f'src="data:image/png;base64,{base64.b64encode(png).decode()}">\n'
            f"<figcaption><b>({letter})</b> {caption}</figcaption></figure>\n"
        )
    text += "</div>\n"
    if figure.key:
        spans = ['<span><i style="background:#%02x%02x%02x"></i>%s</span> ' % (*colour, entry) for colour, entry in figure.key]
        text += '<p class="key">' + "".join(spans) + "</p>\n"
    return (
        f'{text}<p class="caption"><b>Figure {n}.</b> {figure.caption}</p>\n{figure.table}'
        f'<p class="paper"><b>In the paper:</b> {figure.paper}</p>\n</section>\n'
    )


def parameter_tables(valves):
    """Returns a table of the parameters of each kind of valve."""
    html = '<section id="parameters">\n<h2>Parameters of the figures</h2>\n'
    for kind, valve in valves.items():
        rows = [["parameter", "value", "unit", "what it is"]]
        for each in valve["parameters"]:
            values = ", ".join(number(value, 6) for value in each["values"])
            rows.append([f"<code>{each['name']}</code>", values, each["unit"], each["description"]])
        summary = f"<summary>{kind} valve: {len(rows) - 1} parameters</summary>"
        html += f"<details>{summary}\n{html_table(rows)}</details>\n"
    return html + "</section>\n"


def page_of(version, figures, left_out, valves):
    """Returns the page. For each missing figure, left_out has a text with the command that makes the figure."""
    contents = [f'<li><a href="#figure-{n}">{figure.title}</a></li>\n' for n, figure in enumerate(figures, 1)]
    missing = "".join(f"<li>{text}</li>\n" for text in left_out)
    if missing:
        missing = f'<section id="left-out">\n<h2>Not on this page</h2>\n<ul>\n{missing}</ul>\n</section>\n'
    return (
        HEAD + INTRODUCTION.format(version=version) + "<nav><ol>\n" + "".join(contents) + "</ol></nav>\n"
        + "".join(html_of(figure, n) for n, figure in enumerate(figures, 1))
        + missing + parameter_tables(valves) + "</body>\n</html>\n"
    )  # fmt: skip
