#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Writes an aortic valve with two cusps instead of three, for riis mark --valve bicuspid.json.

Two equal cusps without a raphe (type 0 of Sievers and Schmidtke, J. Thorac. Cardiovasc. Surg. 133, 2007) hang in a root of
constant radius. The free edges of both cusps meet along the line between the commissures, and open like a fish's mouth. Lengths
are in centimetres. After you change the numbers below, run python3 bicuspid.py > bicuspid.json.
"""
import json

ROOT_RADIUS = 1.2
COMMISSURE_HEIGHT = 1.2  # height above the lowest points of the attachment
COAPTATION_HEIGHT = 0.8  # height of the free edges' middles when the valve is closed
OPEN_WIDTH = 0.6  # distance of an open edge's middle from the line between the commissures
CIRCLE = 0.5522847498307936  # a cubic with handles of this length approximates a quarter of a circle to 0.03 % of its radius


def cusp(side, state):
    """Returns the curves of one cusp: side is +1 or -1, the sign of x; state is "closed" or "open"."""
    r, top = ROOT_RADIUS, COMMISSURE_HEIGHT
    width, height = (0.0, COAPTATION_HEIGHT) if state == "closed" else (OPEN_WIDTH, top)
    curves = {}
    for half, y in (("a", -r), ("b", r)):
        middle = [side * width, 0.0, height]
        curves[f"edge {half}"] = [[0.0, y, top], [side * width / 2, y * 0.6, (top + height) / 2],
                                  [side * width, y * 0.3, height], middle]
        curves[f"attachment {half}"] = [[0.0, y, top], [side * r * CIRCLE, y, 0.35 * top],
                                        [side * r, y * CIRCLE, 0.0], [side * r, 0.0, 0.0]]
    curves["middle"] = [[side * r, 0.0, 0.0], [side * r * 0.55, 0.0, 0.1], middle]
    return curves


def state_curves(state):
    curves = {f"commissure {half}": [[0.0, y, COMMISSURE_HEIGHT]] for half, y in (("a", -ROOT_RADIUS), ("b", ROOT_RADIUS))}
    for number, side in ((0, 1), (1, -1)):
        for name, points in cusp(side, state).items():
            curves[f"{name} {number}"] = points
    return curves


def patches():
    """u x v must point downstream, so u runs in opposite directions on the two cusps."""
    made = []
    for number, (first, second) in ((0, ("a", "b")), (1, ("b", "a"))):
        made.append({"v0": f"attachment {first} {number}", "v1": f"edge {first} {number}", "u0": f"commissure {first}",
                     "u1": f"middle {number}", "leaflet": number})
        made.append({"v0": f"-attachment {second} {number}", "v1": f"-edge {second} {number}", "u0": f"middle {number}",
                     "u1": f"commissure {second}", "leaflet": number})
    return made


def text(curves, indent):
    rounded = {name: [[round(x, 4) + 0.0 for x in point] for point in points] for name, points in sorted(curves.items())}
    return "{\n" + ",\n".join(f'{indent}  {json.dumps(name)}: {json.dumps(points)}' for name, points in
                              rounded.items()) + f"\n{indent}}}"


if __name__ == "__main__":
    lines = ",\n".join("    " + json.dumps(patch) for patch in patches())
    print(f'{{\n  "curves": {text(state_curves("closed"), "  ")},\n  "patches": [\n{lines}\n  ],\n'
          f'  "open": {{\n    "curves": {text(state_curves("open"), "    ")}\n  }}\n}}')
