# SPDX-License-Identifier: Apache-2.0
"""Prints the geometry of half a mitral valve in a stepped tube, for gmsh: mitral.py OPENING.

The leaflets follow the formulas of docs/theory/mitral.md, without the library. The parameters have their defaults. Lengths are in
centimetres. The valve is turned by half a turn about the axis x, so that the flow has the direction z. The plane of symmetry is
x = 0. The inflow tube has the outline of the annulus, a little smaller. The tube ends behind the annulus, at a step to a wider
chamber. Leaflets that lean inwards meet the wall of the tube, and leaflets that hang down meet the step. Either way, no leaflet
meets the edge of the step, where the mesh would have flat cells. The options of the mesh are the options of bileaflet.geo.
"""
import sys

import numpy as np

ANTERIOR_RATIO, AP, ALPM, ALPM_POSITION, IT, INDENT = 0.41, 3.0, 4.0, 0.55, 2.5, 0.5
ANTERIOR_HORN, POSTERIOR_HORN, ANTERIOR, COMMISSURE, SCALLOP = 0.8, 0.6, 2.12, 0.8, 1.35
EDGE_ARC, INWARD, ARC = np.radians([120, 75, 20])
TRIANGLE = 0.1
# Places on half the annulus, as fractions of its length from the posterior point: the cleft, the commissure, and the end of the
# triangle at the commissure.
AT_COMMISSURE = 1 - ANTERIOR_RATIO
AT_CLEFT, AFTER_TRIANGLE = AT_COMMISSURE / 3, AT_COMMISSURE + 2 * TRIANGLE
SHRUNK = 0.98  # the size of the inflow tube, relative to the annulus
INFLOW, OUTFLOW, CHAMBER = 1.5, 3.4, 2.6  # lengths before and behind the annulus, and the radius of the chamber
N = 12  # steps of u and of v between the points of a patch


class Curve:
    """A chain of cubics, evaluated by the share of its length."""

    def __init__(self, cubics, n=20001):
        t = np.linspace(0, 1, n)[:, None]
        cubics = np.asarray(cubics, float)
        self.points = np.concatenate([(1 - t) ** 3 * a + 3 * t * (1 - t) ** 2 * b + 3 * t * t * (1 - t) * c + t ** 3 * d
                                      for a, b, c, d in cubics])
        self.slopes = np.concatenate([(1 - t) ** 2 * (b - a) + 2 * t * (1 - t) * (c - b) + t * t * (d - c)
                                      for a, b, c, d in cubics])
        self.share = np.concatenate([[0], np.cumsum(np.linalg.norm(np.diff(self.points, axis=0), axis=1))])
        self.share /= self.share[-1]

    def __call__(self, share):
        return self._at(share, self.points)

    def tangent(self, share):
        along = self._at(share, self.slopes)
        return along / np.linalg.norm(along, axis=-1, keepdims=True)

    def _at(self, share, values):
        return np.stack([np.interp(share, self.share, values[:, k]) for k in range(3)], axis=-1)


def annulus_cubics(opening):
    """Returns the cubics of half the annulus, from the posterior to the anterior point."""
    points = np.array([[0, -AP / 2, POSTERIOR_HORN], [ALPM / 2, AP * (ALPM_POSITION - 0.5), 0],
                       [IT / 2, (AP + INDENT) / 2, 0.75 * ANTERIOR_HORN], [0, AP / 2, ANTERIOR_HORN]])
    tangents = np.array([[0.275 * (AP * ALPM_POSITION + ALPM / 2), 0, 0],
                         [0, 0.55 * (INDENT / 2 + AP * (1 - ALPM_POSITION)), 0], [-IT / 4, 0, 0], [-IT / 4, 0, 0]])
    points[:, 2] *= 1 - opening
    return [(points[i], points[i] + tangents[i], points[i + 1] - tangents[i + 1], points[i + 1]) for i in range(3)]


def edge(start, end, tip):
    """Returns the cubic of a free edge, through its tip."""
    start, end, tip = (np.asarray(point, float) for point in (start, end, tip))
    middle = (start + end) / 2
    k = 4 / 3 * np.tan(EDGE_ARC / 4)
    aside, out = (1 - k / np.tan(EDGE_ARC / 2)) * (end - start) / 2, 4 / 3 * (tip - middle)
    return np.array([start, middle - aside + out, middle + aside + out, end])


def part(cubic, first, last):
    """Returns the cubic between two parameters of a cubic."""
    def blossom(a, b, c):
        points = cubic
        for t in (a, b, c):
            points = (1 - t) * points[:-1] + t * points[1:]
        return points[0]
    return np.array([blossom(*[last] * k, *[first] * (3 - k)) for k in range(4)])


def mirrored(points):
    return np.asarray(points) * [-1, 1, 1]


def edges(opening):
    """Returns the cubics of three edges: half the middle scallop, the side scallop and half the anterior edge. Each cubic runs
    away from the posterior point, like the annulus."""
    closed, flat = Curve(annulus_cubics(0)), Curve(annulus_cubics(1))

    def inward(annulus, at):
        x, y, _ = annulus.tangent(np.array(at))
        return np.array([-y, x, 0]) / np.hypot(x, y)

    # closed: both leaflets share one edge in the plane z = 0
    end = (closed(AT_COMMISSURE) + COMMISSURE * inward(closed, AT_COMMISSURE)) * [1, 1, 0]
    shared = edge(end, mirrored(end), (closed(1) + ANTERIOR * inward(closed, 1)) * [1, 1, 0])
    whole = Curve([shared])
    parameter = np.interp([1 / 3, 2 / 3], whole.share, np.linspace(0, 1, len(whole.share)))
    thirds = part(shared, 0, parameter[0]), part(shared, *parameter)

    def hanging(share, length):
        return flat(share) + length * (np.cos(INWARD) * inward(flat, share) - np.sin(INWARD) * np.array([0, 0, 1]))

    commissure, tip = hanging(AT_COMMISSURE, COMMISSURE), hanging(AT_CLEFT, COMMISSURE)
    open_edges = (edge(commissure, tip, hanging(2 * AT_CLEFT, SCALLOP)), edge(tip, mirrored(tip), hanging(0, SCALLOP)),
                  edge(commissure, mirrored(commissure), hanging(1, ANTERIOR)))
    side, middle, anterior = ((1 - opening) * a + opening * b for a, b in zip((*thirds, shared), open_edges))
    return part(middle, 0.5, 0), part(side, 1, 0), part(anterior, 0, 0.5)


def patches(opening):
    """Returns the points of four patches, in the frame of the mesh: rows of v, from the annulus to the edge. The last row of the
    triangle at the commissure is one point."""
    annulus = Curve(annulus_cubics(opening))
    middle, side, anterior = (Curve([cubic]) for cubic in edges(opening))
    found = []
    for first, last, free in ((0, AT_CLEFT, middle), (AT_CLEFT, AT_COMMISSURE, side), (AT_COMMISSURE, AFTER_TRIANGLE, None),
                              (AFTER_TRIANGLE, 1, anterior)):
        share = np.linspace(0, 1, N + 1)
        u = first + (last - first) * share
        base, along = annulus(u), annulus.tangent(u)
        free_edge = free(share) if free else np.broadcast_to(anterior(0.0), base.shape)
        chord = free_edge - base
        out = np.cross(chord, along)
        out *= np.tan(ARC) / 2 * np.linalg.norm(chord, axis=1, keepdims=True) / np.linalg.norm(out, axis=1, keepdims=True)
        v = np.linspace(0, 1, N + 1)[:, None, None]
        found.append(((1 - v) * base + v * free_edge + 2 * v * (1 - v) * out) * [1, -1, -1])
    return found


def inflow_area():
    """Returns the area of the inflow tube in cm2."""
    x, y, _ = Curve(annulus_cubics(1)).points.T * SHRUNK
    return 2 * abs(np.trapz(x, y))


def main():
    opening = float(sys.argv[1])
    step = 0.05 if opening > 0.75 else 0.2  # where the chamber begins
    text = ['SetFactory("OpenCASCADE");']
    for name, value in (("fitted", 1), ("size", 0.05), ("band", 0.1), ("far", 0.13)):
        text.append(f"DefineConstant[ {name} = {value} ];")
    points, curves = {}, {}

    def point(at):
        place = tuple(float(x) for x in np.round(at, 9) + 0.0)
        if place not in points:
            points[place] = len(points) + 1
            text.append(f"Point({points[place]}) = {{{place[0]:.9g}, {place[1]:.9g}, {place[2]:.9g}}};")
        return points[place]

    def spline(row):
        """Returns the number of the curve through the points. The number is negative if the curve runs in the other direction."""
        numbers = [point(at) for at in row]
        forward = numbers[0] < numbers[-1]
        key = tuple(numbers if forward else numbers[::-1])
        if key not in curves:
            curves[key] = len(curves) + 1
            text.append(f"Spline({curves[key]}) = {{{', '.join(map(str, key))}}};")
        return curves[key] if forward else -curves[key]

    text.append("leaf() = {};")
    for grid in patches(opening):
        sides = [spline(grid[0]), spline(grid[:, -1])]
        if np.ptp(grid[-1], axis=0).max() > 1e-9:  # not at the commissure, where the edge is a point
            sides.append(spline(grid[-1, ::-1]))
        sides.append(spline(grid[::-1, 0]))
        inside = ", ".join(str(point(at)) for at in grid[1:-1, 1:-1].reshape(-1, 3))
        text.append(f"loop = newll; Curve Loop(loop) = {{{', '.join(map(str, sides))}}};")
        text.append(f"patch = news; Surface(patch) = {{loop}} Using Point {{{inside}}}; leaf() += patch;")
    # the blood: the inflow tube and the chamber
    outline = Curve(annulus_cubics(1))(np.linspace(0, 1, 49)) * [SHRUNK, -SHRUNK, 0] - [0, 0, INFLOW]
    wall = spline(outline)
    text.append(f"middle = newl; Line(middle) = {{{point(outline[-1])}, {point(outline[0])}}};")
    text.append(f"loop = newll; Curve Loop(loop) = {{{wall}, middle}}; inflow = news; Plane Surface(inflow) = {{loop}};")
    text.append(f"tube() = Extrude {{0, 0, {INFLOW + step}}} {{ Surface{{inflow}}; }};")
    text.append(f"chamber = newv; Cylinder(chamber) = {{0, 0, {step}, 0, 0, {OUTFLOW - step}, {CHAMBER}, Pi}};")
    text.append("Rotate {{0, 0, 1}, {0, 0, 0}, -Pi / 2} { Volume{chamber}; }")
    text.append("fluid() = BooleanUnion { Volume{tube(1)}; Delete; }{ Volume{chamber}; Delete; };")
    text.append(f"z_range() = {{{-INFLOW}, {OUTFLOW}}};")
    text.append(f"plane_boxes() = {{0, {-CHAMBER}, {-INFLOW}, 0, {CHAMBER}, {OUTFLOW}}};")
    text.append('Include "fluid.geo";')
    print("\n".join(text))


if __name__ == "__main__":
    main()
