# SPDX-License-Identifier: Apache-2.0
"""Prints how well riis.fit finds known valves again, from points with noise, gaps and outliers."""

import sys
import time

import numpy

import riis

PLACEMENT = {"rotation_axis": (1.0, 2.0, 3.0), "rotation_angle": 12.0, "translation": (0.2, -0.1, 0.3)}
VALVES = {
    "mitral": {"AP_diameter": 3.3, "ALPM_diameter": 3.6, "opening": 0.3},
    "trileaflet": {"leaflet_height": 1.25, "opening": 0.35},
}


def cloud(kind, n_points, noise, n_gaps=0, outliers=0.0, seed=0):
    """Returns points of a known valve: evenly over its area, with normal noise, without balls of radius 0.5, and outliers."""
    random = numpy.random.default_rng(seed)
    surface = riis.Surface(riis.Valve(kind, **VALVES[kind]), half_thickness=0.05, tolerance=0.02, **PLACEMENT)
    a, b, c = (surface.vertices[surface.triangles.vertex_id[:, i]] for i in range(3))
    area = numpy.linalg.norm(numpy.cross(b - a, c - a), axis=1)
    chosen = random.choice(len(area), n_points, p=area / area.sum())
    r = random.uniform(size=(2, n_points))
    r[:, r.sum(axis=0) > 1.0] = 1.0 - r[:, r.sum(axis=0) > 1.0]
    points = a[chosen] + r[0][:, None] * (b - a)[chosen] + r[1][:, None] * (c - a)[chosen]
    for middle in points[random.choice(n_points, n_gaps)]:
        points = points[numpy.linalg.norm(points - middle, axis=1) > 0.5]
    points = points + random.normal(0.0, noise, points.shape)
    n_out = int(outliers * len(points))
    points[:n_out] = random.uniform(points.min(axis=0) - 0.5, points.max(axis=0) + 0.5, (n_out, 3))
    return points


def main():
    print(f"{'valve':10} {'noise':>5} {'gaps':>4} {'outliers':>8}  {'parameter':14} {'true':>6} {'error':>7} {'std.':>7} {'rms':>6} {'s':>4}")
    for kind, true in VALVES.items():
        for noise, n_gaps, outliers in ((0.0, 0, 0.0), (0.02, 0, 0.0), (0.05, 0, 0.0), (0.02, 3, 0.05)):
            begin = time.perf_counter()
            found = riis.fit(cloud(kind, 1000, noise, n_gaps, outliers), kind, free=list(true))
            seconds = time.perf_counter() - begin
            for name, value in true.items():
                print(
                    f"{kind:10} {noise:5} {n_gaps:4} {outliers:8.0%}  {name:14} {value:6} {found.parameters[name] - value:7.3f} "
                    f"{found.standard_errors[name]:7.3f} {found.rms:6.3f} {seconds:4.0f}",
                    flush=True,
                )


if __name__ == "__main__":
    sys.exit(main())
