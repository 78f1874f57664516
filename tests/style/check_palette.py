#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""check_palette.py FOLDER: all pictures must take their colours from one palette. The palette's colours must be distinct in every
kind of colour vision.

The palette is distinct_colours of src/riis_vtk/picture/drawing.hpp. The matrices of Machado, Oliveira, Fernandes (2009) for the
severity 1 give the colours that protanopes, deuteranopes and tritanopes see. Two colours count as distinct if their difference in
CIELAB is at least LEAST. To test the check itself, matplotlib's palette and Set2 must fail.
"""

import itertools
import os
import re
import sys

LEAST = 15.0
VISIONS = {
    "normal": ((1, 0, 0), (0, 1, 0), (0, 0, 1)),
    "protanope": ((0.152286, 1.052583, -0.204868), (0.114503, 0.786281, 0.099216), (-0.003882, -0.048116, 1.051998)),
    "deuteranope": ((0.367322, 0.860646, -0.227968), (0.280085, 0.672501, 0.047413), (-0.011820, 0.042940, 0.968881)),
    "tritanope": ((1.255528, -0.076749, -0.178779), (-0.078411, 0.930809, 0.147602), (0.004733, 0.691367, 0.303900)),
}
TO_XYZ = ((0.4124564, 0.3575761, 0.1804375), (0.2126729, 0.7151522, 0.0721750), (0.0193339, 0.1191920, 0.9503041))
WHITE = (0.95047, 1.0, 1.08883)


def product(matrix, vector):
    return [sum(a * b for a, b in zip(row, vector)) for row in matrix]


def cielab(colour, vision):
    linear = [c / 255 / 12.92 if c <= 10 else ((c / 255 + 0.055) / 1.055) ** 2.4 for c in colour]
    seen = [min(1.0, max(0.0, c)) for c in product(VISIONS[vision], linear)]
    x, y, z = (
        t ** (1 / 3) if t > 0.008856 else 7.787 * t + 16 / 116
        for t in (value / white for value, white in zip(product(TO_XYZ, seen), WHITE))
    )
    return 116 * y - 16, 500 * (x - y), 200 * (y - z)


def closest(colours):
    """Returns the least difference between two colours, the kind of vision, and both colours."""
    found = []
    for vision in VISIONS:
        for a, b in itertools.combinations(colours, 2):
            squares = ((p - q) ** 2 for p, q in zip(cielab(a, vision), cielab(b, vision)))
            found.append((sum(squares) ** 0.5, vision, a, b))
    return min(found)


def from_hex(text):
    return tuple(int(text[i : i + 2], 16) for i in (1, 3, 5))


def colours_in(folder, path, pattern):
    """Returns all colours in the text that match the pattern, as three numbers or as #rrggbb."""
    with open(os.path.join(folder, path), encoding="utf-8") as file:
        found = re.search(pattern, file.read(), re.DOTALL)
    if not found:
        sys.exit(f"{path}: there are no colours like {pattern}")
    numbers = re.findall(r"[({]\s*(\d+),\s*(\d+),\s*(\d+)\s*[)}]", found[1])
    return [tuple(map(int, colour)) for colour in numbers] + [from_hex(text) for text in re.findall(r"#[0-9a-f]{6}", found[1])]


def main(folder):
    palette = colours_in(folder, "src/riis_vtk/picture/drawing.hpp", r"distinct_colours\[\]\[3\] = (\{.*?\});")
    with open(os.path.join(folder, "src/riis_vtk/picture/picture_scene.hpp"), encoding="utf-8") as file:
        red = re.search(r"leak_colour = \{([0-9., ]+)\}", file.read())[1]
    leak = tuple(round(255 * float(part)) for part in red.split(","))
    plots = colours_in(folder, "bench/report/report_text.py", r"\nCOLOURS = (\(.*?\))\n")
    sheets = colours_in(folder, "bench/figures/parameters/sheet.py", r"\nBLUE, GREEN, PURPLE, VERMILION = (.*?)\n")
    examples = {
        path: colours_in(folder, f"examples/{path}", pattern) for path, pattern in (
            ("flow_fortran/plots.py", r"\nUPSTREAM = (.*?)\nFRAME_RATE"), ("openfoam/draw.py", r"\nCOLOURS = (.*?)\n\n"),
            ("code_saturne/draw.py", r"\nCOLOURS = (.*?)\n\n"), ("fenicsx/check.py", r"\nLEAFLET = (.*?)\n"),
        )
    }  # fmt: skip
    complaints = []
    if len(palette) != 6:
        complaints.append(f"drawing.hpp has {len(palette)} colours, not 6")
    if colours_in(folder, "python/riis/_plot.py", r"\nCOLOURS = (\(.*?\))\n") != palette:
        complaints.append("the colours of python/riis/_plot.py are not those of drawing.hpp")
    if colours_in(folder, "bench/figures/picture.py", r"\nPALETTE = (\(.*?\))\n") != palette:
        complaints.append("the colours of bench/figures/picture.py are not those of drawing.hpp")
    if plots[:6] != palette:
        complaints.append("the colours of bench/report/report_text.py do not begin with those of drawing.hpp")
    for path, colours in examples.items():
        if not set(colours) <= set(palette):
            complaints.append(f"examples/{path} has other colours than drawing.hpp")
        with open(os.path.join(folder, "examples", path), encoding="utf-8") as file:
            names = re.findall(r"""["'](?:tab:\w+|C\d\W*|red|green|blue|orange)["']""", file.read())
        if names:
            complaints.append(f"examples/{path} names colours beside the palette: {', '.join(names)}")
    for name, colours in (("pictures, with leaks", [*palette, leak]), ("plots", plots), ("drawings of parameters", sheets)):
        difference, vision, a, b = closest(colours)
        print(f"{name}: the closest are {a} and {b}, {difference:.1f} apart for a {vision} eye")
        if difference < LEAST:
            complaints.append(f"{name}: {a} and {b} look alike to a {vision} eye: {difference:.1f} < {LEAST}")
    for name, texts in (("matplotlib's palette", "#1f77b4 #ff7f0e #2ca02c #d62728 #9467bd #8c564b"),
                        ("Set2", "#66c2a5 #fc8d62 #8da0cb #e78ac3")):  # fmt: skip
        if closest([from_hex(text) for text in texts.split()])[0] >= LEAST:
            complaints.append(f"{name} passes, so this check finds nothing")
    sys.exit("\n".join(complaints) if complaints else 0)


if __name__ == "__main__":
    main(sys.argv[1])
