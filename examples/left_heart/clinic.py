# SPDX-License-Identifier: Apache-2.0
"""Prints a clinician's usual numbers of the last beat, with a column for each heart. The exit status is 1 if a diseased heart
lacks a sign of its disease.

    clinic.py CASE TABLES [CASE TABLES ...]

TABLES is a folder with zero_d.csv, mitral.csv and aortic.csv of the case.
"""
import pathlib
import sys

import numpy as np

import check
import zero_d
from check import foam
from zero_d import ML, MMHG, PERIOD, RHO

NONE = float("nan")
BACK, SHARE = "blood back through the mitral valve, ml", "share of it in the stroke volume"
MEAN_GRADIENT = "aortic gradient, mean over the ejection, mmHg"
MITRAL_AREA = "effective area of the open mitral valve, cm2"


def name_of(case):
    """Returns a readable name of the heart. The name is that of the heart's case, except for the healthy heart."""
    name = pathlib.Path(case).name
    return "healthy" if name == "beat" else name


def written(case):
    """Returns the names of the times at which the case wrote its plane x = 0."""
    return sorted((folder.name for folder in (case / "postProcessing/slice").iterdir()), key=float)


def plane(case, time):
    """Returns for the plane x = 0: y and z of the points (n, 2), triangles (m, 3), velocities (n, 2).

    z is 0 at the base, which descends.
    """
    points, corners, vectors = foam.triangles(case / "postProcessing/slice" / time / "middle.vtk")
    descent = zero_d.Mesh(case).base * check.amplitude(case, float(time))
    return points[:, 1:] + (0, descent), corners, vectors[:, 1:]


def jet(points, velocity):
    """Returns the speed of the fastest blood in this plane in the aortic tube."""
    in_tube = (points[:, 1] > 2e-3) & (points[:, 0] > 0)
    return np.linalg.norm(velocity[in_tube], axis=1).max()


def vortex(points, corners, velocity):
    """Returns the circulation of the strongest vortex in the ventricle, in m2/s, and its centre and radius in mm.

    A vortex is a disc in this plane that lies in the blood below the base. The circulation of a vortex is the integral of the
    vorticity.
    """
    a, b, c = (points[corners[:, k]] for k in range(3))
    first, second = b - a, c - a
    twice = first[:, 0] * second[:, 1] - first[:, 1] * second[:, 0]
    fine = np.abs(twice) > 1e-14
    one, two = (velocity[corners[:, k]] - velocity[corners[:, 0]] for k in (1, 2))
    # The velocity is linear in a triangle, so its circulation around the triangle is exact.
    around = ((one * second).sum(axis=1) - (two * first).sum(axis=1)) / 2 * np.sign(twice)
    areas, middles = np.abs(twice) / 2, (a + b + c) / 3
    keep = fine & (middles[:, 1] < 0)
    around, areas, middles = around[keep], areas[keep], middles[keep]
    best = (0.0, (0.0, 0.0), 0.0)
    for y in np.arange(-24e-3, 25e-3, 3e-3):
        for z in np.arange(-63e-3, -5e-3, 3e-3):
            distance = np.hypot(middles[:, 0] - y, middles[:, 1] - z)
            for radius in (6e-3, 9e-3, 12e-3, 15e-3, 18e-3):
                inside = distance < radius
                if areas[inside].sum() > 0.96 * np.pi * radius**2:
                    circulation = around[inside].sum()
                    if abs(circulation) > abs(best[0]):
                        best = (circulation, (1e3 * y, 1e3 * z), 1e3 * radius)
    return best


def regurgitant_area(flow, difference):
    """Returns the area in cm2 through which blood flows back while the ventricle is 40 mmHg above the atrium."""
    driven = difference > 40
    return -flow[driven].mean() * ML * np.sqrt(RHO / (2 * difference[driven].mean() * MMHG)) * 1e4


def numbers(case, tables):
    """Returns the numbers of the last whole beat."""
    case, tables = pathlib.Path(case), pathlib.Path(tables)
    beat = check.Beat(case)
    model = check.zero_d_at(tables / "zero_d.csv", beat.time)
    orifices = {name: zero_d.read_orifice(tables / f"{name}.csv") for name in ("mitral", "aortic")}
    step = beat.time[1] - beat.time[0]
    n = round(PERIOD / step)
    first = (len(beat.time) // n - 1) * n
    if first < 0:
        sys.exit(f"clinic.py: {case} has {len(beat.time)} steps, and a beat has {n}")
    last = slice(first, first + n)
    time, mitral, aortic = beat.time[last] - beat.time[first], beat.mitral[last], beat.aortic[last]
    volume = (beat.volume - beat.volume[0] + model["volume"][0])[last]
    ventricle, aorta, atrium = beat.ventricle[last], beat.aorta[last], beat.atrium[last]
    open_ = {name: orifices[name].is_open(beat.openings[name][last]) for name in orifices}
    ejects = np.flatnonzero(open_["aortic"])

    e_wave, trough, a_wave = zero_d.waves(time, mitral)
    e_volume = np.clip(mitral[ejects[-1] : trough], 0, None).sum() * step
    stroke = volume.max() - volume.min()

    # In isovolumetric phases, both valves leave no orifice.
    closed = ~open_["mitral"] & ~open_["aortic"]
    moved = time > 0.005
    contraction = (closed & moved & (time < time[ejects[0]])).sum() * step * 1e3
    relaxation = (closed & (time > time[ejects[-1]])).sum() * step * 1e3
    has_phases = open_["mitral"].any() and not open_["mitral"].all()

    # While the flow slows down, its inertia keeps the pressure in the aorta above that in the ventricle. Over the whole ejection,
    # this part of the gradient cancels the part that accelerates the blood. Steps in which the ventricle is above the aorta
    # contain only the second part.
    forward = (aortic > 0) & open_["aortic"]
    gradient = (ventricle - aorta)[forward]
    effective = aortic[forward].mean() * ML * np.sqrt(RHO / (2 * gradient.mean() * MMHG))
    back = -np.clip(mitral, None, 0).sum() * step
    fills = (mitral > 0) & open_["mitral"]

    jets, drops, swirls = [], [], []
    for name in written(case):
        at = float(name) - beat.time[first] + step
        if not 0 < at <= PERIOD + step / 2:
            continue
        points, corners, velocity = plane(case, name)
        if open_["aortic"][min(n - 1, round(at / step) - 1)]:
            jets.append(jet(points, velocity))
        if time[ejects[-1]] < at < zero_d.KICK_START:
            below = (points[:, 0] < 0) & (points[:, 1] > -30e-3)
            drops.append(-velocity[below, 1].min())
        if at > time[ejects[-1]]:
            swirls.append((*vortex(points, corners, velocity), float(name)))
    swirl = max(swirls, key=lambda row: abs(row[0]))
    area = orifices["mitral"].areas[-1]
    return {
        "end-diastolic volume, ml": volume.max(),
        "end-systolic volume, ml": volume.min(),
        "stroke volume, ml": stroke,
        "ejection fraction": stroke / volume.max(),
        "blood into the aorta, ml": aortic.sum() * step,
        BACK: back,
        SHARE: back / stroke,
        "pressure in the ventricle, end of diastole, mmHg": ventricle[np.argmax(volume)],
        "largest pressure in the ventricle, mmHg": ventricle.max(),
        "pressure in the aorta, mmHg": (aorta.min(), aorta.max()),
        "pressure in the atrium, mean, mmHg": atrium.mean(),
        "largest pressure in the atrium, mmHg": atrium.max(),
        MEAN_GRADIENT: gradient.mean(),
        "the same, while the ventricle is above the aorta": gradient[gradient > 0].mean(),
        "aortic gradient, largest, mmHg": gradient.max(),
        "effective aortic area, cm2": effective * 1e4,
        "mitral gradient, mean over the filling, mmHg": (atrium - ventricle)[fills].mean(),
        MITRAL_AREA: area * 1e4,
        "effective regurgitant area of the mitral valve, cm2": regurgitant_area(mitral, ventricle - atrium),
        "largest flow into the aorta, ml/s": aortic.max(),
        "fastest blood in the aorta, m/s": max(jets),
        "jet area, largest flow over fastest blood, cm2": aortic.max() * ML / max(jets) * 1e4,
        "E wave, ml/s": mitral[e_wave],
        "A wave, ml/s": mitral[a_wave],
        "E/A": mitral[e_wave] / mitral[a_wave],
        "fastest blood of the E wave, m/s": max(drops),
        "isovolumetric contraction, ms": contraction if has_phases else NONE,
        "ejection, ms": len(ejects) * step * 1e3,
        "isovolumetric relaxation, ms": relaxation if has_phases else NONE,
        "stroke work, J": -np.sum(ventricle * np.gradient(volume)) * MMHG * ML,
        "vortex: circulation, m2/s": abs(swirl[0]),
        "vortex: formation time": e_volume * ML / area / np.sqrt(4 * area / np.pi),
    }, swirl


def demand_diseases(hearts):
    """Checks that each diseased heart has the signs that patients have. `hearts` contains the numbers of each heart by its
    name."""
    if "stenosis" in hearts:
        gradient = hearts["stenosis"][MEAN_GRADIENT]
        check.demand(gradient > 40, f"stenosis: the mean gradient is {gradient:.1f} mmHg (above 40)")
    if "flail" not in hearts:
        return
    flail = hearts["flail"]
    check.demand(flail[SHARE] > 0.4, f"flail: {100 * flail[SHARE]:.0f} % of the stroke volume go back (above 40)")
    if "clip" in hearts:
        clip = hearts["clip"]
        less = 1 - clip[MITRAL_AREA] / flail[MITRAL_AREA]
        check.demand(0.35 <= less <= 0.5, f"clip: the open valve has {100 * less:.0f} % less area (35 to 50)")
        check.demand(clip[BACK] <= flail[BACK] / 2, f"clip: {clip[BACK]:.1f} ml go back in place of {flail[BACK]:.1f} (half)")


def show(value):
    if isinstance(value, tuple):
        return " to ".join(show(one) for one in value)
    return "none" if np.isnan(value) else f"{value:.3g}"


def main(words):
    if not words or len(words) % 2:
        sys.exit(__doc__)
    hearts = {name_of(case): numbers(case, tables) for case, tables in zip(words[::2], words[1::2])}
    print("| last beat | " + " | ".join(hearts) + " |\n|---|" + "---|" * len(hearts))
    for row in next(iter(hearts.values()))[0]:
        print(f"| {row} | " + " | ".join(show(values[row]) for values, _ in hearts.values()) + " |")
    for name, (_, (_, (y, z), radius, time)) in hearts.items():
        print(f"{name}: the strongest vortex has its middle at y {y:.0f}, z {z:.0f} mm, radius {radius:.0f} mm, at {time:.2f} s")
    demand_diseases({name: values for name, (values, _) in hearts.items()})
    sys.exit(1 if check.failures else 0)


if __name__ == "__main__":
    main(sys.argv[1:])
