# SPDX-License-Identifier: Apache-2.0
"""Prints how accurately riis.fit recovers known valves from points with noise, gaps and outliers, in any placement."""

import sys

import numpy

import fit_study
import riis

PLACEMENT = {"rotation_axis": (1.0, 2.0, 3.0), "rotation_angle": 12.0, "translation": (0.2, -0.1, 0.3)}
VALVES = {kind: studied.known for kind, studied in fit_study.KINDS.items()} | fit_study.NO_PATIENTS
# Noise, number of gaps, fraction of outliers.
CASES = ((0.0, 0, 0.0), (0.01, 0, 0.0), (0.02, 0, 0.0), (0.05, 0, 0.0), (0.02, 2, 0.05))


def cloud(kind, n_points, noise, n_gaps=0, outliers=0.0, seed=0, placement=None):
    """Returns points of a known valve, evenly distributed over its area. The points have normal noise, gaps (balls of radius 0.5
    without points) and outliers."""
    random = numpy.random.default_rng(seed)
    surface = riis.Surface(riis.Valve(kind, **VALVES[kind]), half_thickness=0.05, tolerance=0.02, **(placement or PLACEMENT))
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


def any_placement(seed):
    random = numpy.random.default_rng(seed)
    return {
        "rotation_axis": random.normal(size=3),
        "rotation_angle": random.uniform(0.0, 180.0),
        "translation": random.uniform(-100.0, 100.0, 3),
    }


def main(n_seeds):
    """Prints a row per parameter and a column per case, with the root mean square of the errors, and the standard error
    that the fits report."""
    cases = [f"{noise}" + (f", {n_gaps} gaps, {outliers:.0%} outliers" if n_gaps else "") for noise, n_gaps, outliers in CASES]
    print(f"| valve | parameter | true | {' | '.join(cases)} |")
    print("|---" * (3 + len(CASES)) + "|")
    within = []
    for kind, true in VALVES.items():
        cells = {name: [] for name in true}
        for noise, n_gaps, outliers in CASES:
            errors, stated = [], []
            for seed in range(n_seeds):
                points = cloud(kind, 1000, noise, n_gaps, outliers, seed, any_placement(seed))
                found = riis.fit(points, kind, free=list(true), seed=seed)
                errors.append([found.parameters[name] - true[name] for name in true])
                stated.append([found.standard_errors[name] for name in true])
            rms, typical = numpy.sqrt(numpy.square(errors).mean(axis=0)), numpy.median(stated, axis=0)
            within.extend((numpy.abs(errors) <= 2.0 * numpy.array(stated)).ravel())
            for i, name in enumerate(true):
                cells[name].append(f"{rms[i]:.4f} ({typical[i]:.4f})")
        for name, value in true.items():
            print(f"| {kind} | {name} | {value} | {' | '.join(cells[name])} |", flush=True)
    print(f"{numpy.mean(within):.0%} of {len(within)} errors are at most two standard errors")


if __name__ == "__main__":
    sys.exit(main(int(sys.argv[1]) if len(sys.argv) > 1 else 4))
