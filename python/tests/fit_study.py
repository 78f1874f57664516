# SPDX-License-Identifier: Apache-2.0
"""Fits random patients with riis.fit, and prints how many of the fits are wrong and have no doubt (docs/design/fits.md)."""

import multiprocessing
import sys
import time
from dataclasses import dataclass, field
from typing import NamedTuple

import numpy

import riis
from riis._fit_problem import is_fixed_size


class Studied(NamedTuple):
    """Describes how a kind of valve is studied."""

    spreads: dict  # the free sizes, and how much each varies as a share of its default
    most_open: float
    known: dict  # the valve of fit_table.py


KINDS = {
    "aortic": Studied({"root_radius": 0.1, "leaflet_height": 0.1, "bending_height": 0.1}, 0.8,
                      {"leaflet_height": 1.1, "bending_height": 0.65, "right.leaflet_radius_in": 0.3}),
    "coapting": Studied({"root_radius": 0.2, "commissure_radius": 0.2, "effective_height": 0.15}, 0.8,
                        {"root_radius": 1.2, "effective_height": 0.95, "opening": 0.35}),
    "trileaflet": Studied({"root_radius": 0.2, "leaflet_radius_out": 0.2, "leaflet_height": 0.2}, 0.8,
                          {"root_radius": 1.2, "leaflet_height": 1.25, "opening": 0.35}),
    "mitral": Studied({"AP_diameter": 0.2, "ALPM_diameter": 0.2, "anterior_length": 0.2, "posterior_scallop_length1": 0.2}, 0.8,
                      {"AP_diameter": 3.3, "ALPM_diameter": 3.6, "anterior_length": 2.3, "opening": 0.3}),
    "bileaflet": Studied({"radius": 0.2}, 1.0, {"radius": 1.2, "opening": 0.3}),
}
# Other kinds have a known valve for fit_table.py, but no patients. Each seed of the study therefore keeps its patient.
NO_PATIENTS = {
    "bicuspid": {"root_radius": 1.3, "cusp_0.sector": 205.0, "cusp_1.sector": 155.0, "opening": 0.35},
    "quadricuspid": {"root_radius": 1.2, "effective_height": 0.95, "opening": 0.35},
    "mitral_coapting": {"AP_diameter": 2.9, "anterior_length": 2.6, "opening": 0.3},
    "tricuspid": {"AP_diameter": 3.8, "SL_diameter": 3.1, "opening": 0.3},
}
CASES = ("whole", "partial", "partial, said whole", "outliers", "thick", "millimetres", "other shape")
WHOLE = ("whole", "outliers", "thick", "millimetres")  # the points cover the valve, and its shape is that of the kind
# A size counts as found if its error is at most three standard errors, or at most these numbers, in cm, degrees and 1.
SMALL = {"length": 0.02, "degree": 2.0, "1": 0.02}
# The error of such a size must also be at most these numbers, even if its standard error is large.
LARGE = {"length": 0.2, "degree": 10.0, "1": 0.1}


@dataclass
class Patient:
    """A valve with known sizes, and points of its segmentation."""

    kind: str
    case: str
    seed: int
    true: dict
    points: numpy.ndarray
    noise: float  # in the points' unit
    options: dict
    found: riis.FitResult | None = None
    seconds: float = 0.0
    size_errors: list = field(default_factory=list)  # unit, error, standard error and name of each size that is not flagged

    def wrong(self):
        return [name for unit, error, stated, name in self.size_errors
                if error > LARGE[unit] or (error > SMALL[unit] and error > 3.0 * stated)]


def points_on(random, surface, n, keep=None):
    """Returns points that are spread evenly over the triangles of a surface, and the normals there."""
    vertices, triangles = surface.vertices, surface.triangles
    a, b, c = (vertices[triangles.vertex_id[:, k]] for k in range(3))
    normal = numpy.cross(b - a, c - a)
    area = numpy.linalg.norm(normal, axis=1)
    if keep is not None:
        area = area * keep((a + b + c) / 3.0, triangles.leaflet_id)
    chosen = random.choice(len(area), n, p=area / area.sum())
    shares = random.dirichlet((1.0, 1.0, 1.0), n)
    points = shares[:, :1] * a[chosen] + shares[:, 1:2] * b[chosen] + shares[:, 2:] * c[chosen]
    return points, (normal / numpy.linalg.norm(normal, axis=1)[:, None].clip(1e-300))[chosen]


def faces_of(random, surface, n, thickness):
    """Returns points at half the thickness from the surface, on both faces and around the rims."""
    points, _ = points_on(random, surface, 3 * n)
    away = random.normal(size=points.shape)
    points += away * (thickness * random.uniform(size=len(points)) ** (1 / 3) / numpy.linalg.norm(away, axis=1))[:, None]
    found = surface.closest_points(points, n_threads=1)
    points = found.point + 0.5 * thickness * (points - found.point) / found.distance[:, None]
    kept = surface.closest_points(points, n_threads=1).distance > 0.49 * thickness
    return points[kept][:n]


def part_of(random, surface):
    """Returns a function that keeps a part of a surface: one leaflet, the part on one side of a plane, or the part around an
    attachment."""
    what = random.integers(3)
    if what == 0 and surface.info.largest_leaflet_id > 0:
        leaflet = random.integers(min(surface.info.largest_leaflet_id, 2) + 1)
        return lambda middle, ids: ids == leaflet
    normal = random.normal(size=3)
    normal /= numpy.linalg.norm(normal)
    points, _ = points_on(random, surface, 500)
    if what == 1:
        limit = numpy.quantile(points @ normal, random.uniform(0.3, 0.6))
        return lambda middle, ids: middle @ normal > limit
    limit = numpy.quantile(points[:, 2], random.uniform(0.3, 0.6))
    return lambda middle, ids: (middle[:, 2] < limit) == (surface.info.lower[2] > -5.0)


def patient(seed):
    """Returns the patient of a seed. Consecutive seeds have the kinds and the cases in turn."""
    random = numpy.random.default_rng(seed)
    kind, case = list(KINDS)[seed % len(KINDS)], CASES[(seed + seed // len(KINDS)) % len(CASES)]
    spreads, most_open, _ = KINDS[kind]
    while True:
        valve = riis.Valve(kind)
        true = {name: valve[name] * random.uniform(1.0 - spread, 1.0 + spread) for name, spread in spreads.items()}
        true["opening"] = random.uniform(0.0, most_open)
        others = {}
        if case == "other shape":  # the fit starts from a valve with other fixed sizes
            others = {name: valve[name] * random.uniform(0.95, 1.05) for name, parameter in valve.parameters.items()
                      if parameter.unit == "length" and parameter.n_values == 1 and name not in true
                      and is_fixed_size(valve, name)}
        try:
            surface = riis.Surface(riis.Valve(kind, **true, **others), half_thickness=0.05, tolerance=0.01)
            break
        except riis.Error:  # the sizes do not fit together
            continue
    noise, n = random.uniform(0.005, 0.05), int(numpy.exp(random.uniform(numpy.log(200.0), numpy.log(1500.0))))
    options = {"free": list(true), "seed": seed}
    if case.startswith("partial"):
        points, _ = points_on(random, surface, n, part_of(random, surface))
        options["whole"] = case != "partial"
    elif case == "thick":
        options["thickness"] = random.uniform(0.1, 0.2)
        points = faces_of(random, surface, n, options["thickness"])
    else:
        points, _ = points_on(random, surface, n)
    points = points + random.normal(0.0, noise, points.shape)
    if case == "outliers":
        n_out = int(random.uniform(0.05, 0.25) * len(points))
        points[:n_out] = random.uniform(points.min(axis=0) - 0.5, points.max(axis=0) + 0.5, (n_out, 3))
    unit = 1.0
    if case == "millimetres":
        unit, options["unit"] = 10.0, "mm"
    axis = random.normal(size=3)
    axis *= random.uniform(0.0, numpy.pi) / numpy.linalg.norm(axis)
    points = unit * points @ rotation_of(axis).T + random.uniform(-100.0, 100.0, 3)
    if random.uniform() < 0.5:
        options["noise"] = unit * noise
    return Patient(kind, case, seed, true, points, unit * noise, options)


def rotation_of(vector):
    """Returns the rotation about a vector by an angle that is the vector's length (Rodrigues)."""
    angle = numpy.linalg.norm(vector)
    x, y, z = vector / angle
    cross = numpy.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])
    return numpy.eye(3) + numpy.sin(angle) * cross + (1.0 - numpy.cos(angle)) * cross @ cross


def examine(one):
    """Fits a patient, and notes the errors of sizes without a doubt."""
    start = time.process_time()
    one.found = found = riis.fit(one.points, one.kind, **one.options)
    one.seconds = time.process_time() - start
    table = found.valve.parameters
    one.size_errors = [(table[name].unit, abs(found.parameters[name] - value), found.standard_errors[name], name)
                       for name, value in one.true.items()
                       if not found.doubts and name not in found.undetermined and name not in found.at_bounds]
    return one


def tell(one, out=sys.stderr):
    """Prints a wrong fit."""
    print(f"seed {one.seed}, {one.kind}, {one.case}: wrong {', '.join(one.wrong())}; true {one.true}", file=out)
    print(one.found.report(), file=out, flush=True)


def table(patients):
    """Returns the lines of the table: a row for each case and for each kind."""
    lines = ["| patients | number | wrong | wrong, not flagged | doubted | sizes undetermined | errors within 3 stated | "
             "stated over true, rms | CPU s |", "|---" * 9 + "|"]
    groups = [(case, [one for one in patients if one.case == case]) for case in CASES]
    groups += [(kind, [one for one in patients if one.kind == kind]) for kind in KINDS] + [("all", patients)]
    for name, group in groups:
        if not group:
            continue
        raw, errors, stated, n_unknown = 0, [], [], 0
        for one in group:
            parameters = one.found.valve.parameters
            all_errors = {key: abs(one.found.parameters[key] - value) for key, value in one.true.items()}
            raw += any(error > max(SMALL[parameters[key].unit], 3.0 * one.found.standard_errors[key])
                       or error > LARGE[parameters[key].unit] for key, error in all_errors.items())
            n_unknown += len(set(one.found.undetermined) & set(one.true))
            for _, error, said, _ in one.size_errors:
                errors.append(error)
                stated.append(said)
        errors, stated = numpy.array(errors), numpy.array(stated)
        within = numpy.mean(errors <= 3.0 * stated) if len(errors) else numpy.nan
        over = numpy.sqrt((stated**2).mean() / (errors**2).mean()) if len(errors) else numpy.nan
        silent = sum(bool(one.wrong()) for one in group)
        lines.append(f"| {name} | {len(group)} | {raw} | {silent} ({silent / len(group):.1%}) | "
                     f"{sum(bool(one.found.doubts) for one in group)} | {n_unknown} | {within:.1%} of {len(errors)} | "
                     f"{over:.2f} | {numpy.mean([one.seconds for one in group]):.1f} |")
    return lines


def sizes(patients):
    """Returns the lines of a table with a row for each size of the whole valves."""
    lines = ["| kind | size | number | undetermined | error, rms | stated, rms | ratio | within 3 stated |", "|---" * 8 + "|"]
    for kind in KINDS:
        group = [one for one in patients if one.kind == kind and one.case in WHOLE]
        for name in group[0].true if group else ():
            errors = numpy.array([one.found.parameters[name] - one.true[name] for one in group])
            stated = numpy.array([one.found.standard_errors[name] for one in group])
            unknown = numpy.array([name in one.found.undetermined for one in group])
            true, said = (numpy.sqrt(numpy.mean(values[~unknown] ** 2)) for values in (errors, stated))
            lines.append(f"| {kind} | {name} | {len(group)} | {unknown.sum()} | {true:.4f} | {said:.4f} | {said / true:.1f} | "
                         f"{numpy.mean(numpy.abs(errors) <= 3.0 * stated):.1%} |")
    return lines


def undetermined(patients):
    """Returns a line for each size of the whole valves that the fit leaves undetermined."""
    return [f"seed {one.seed}, {one.kind}, {one.case}: {name} {one.found.parameters[name]:.4f} +- "
            f"{one.found.standard_errors[name]:.4f}, true {one.true[name]:.4f}"
            f"{', has no influence' * (name in one.found.without_influence)}"
            for one in patients if one.case in WHOLE for name in one.true if name in one.found.undetermined]


def examined(seed):
    return examine(patient(seed))


def main(n_patients=300, first=7000):
    patients = []
    with multiprocessing.get_context("spawn").Pool() as pool:
        for one in pool.imap(examined, range(first, first + n_patients)):
            patients.append(one)
            if one.wrong():
                tell(one)
    print(f"seeds {first} to {first + n_patients - 1}")
    print("\n".join([*table(patients), "", *sizes(patients), "", "undetermined sizes of whole valves:", *undetermined(patients)]))


if __name__ == "__main__":
    main(*(int(argument) for argument in sys.argv[1:]))
