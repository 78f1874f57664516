# SPDX-License-Identifier: Apache-2.0
"""Checks the beating left heart of ./run heart, and prints its numbers. The exit status is 1 if a check fails.

    check.py keys LEAST                            # prints the openings of `orifice` for OpenFOAM, from the least one
    check.py orifice CASE VALVE LEAST              # prints area and leak of each opening, as a table
    check.py beat CASE ZERO_D.csv MITRAL.csv AORTIC.csv    # checks whole beats
    check.py ranks CASE CASE                       # compares runs on 1 and 2 ranks
    check.py restart CASE CASE                     # compares a run with a run that was restarted
"""
import csv
import functools
import pathlib
import re
import sys

import numpy as np

import zero_d
from zero_d import ML, MMHG, PERIOD, RHO, foam

# Without a pressure difference, the valve first moves to these shares of the way from the smallest opening to 1, at these times.
# The flow then shows the volume that the leaflets displace.
SWEPT, SWEEP = ((0.0, 0.0), (0.08, 0.4), (0.12, 1.0), (0.16, 0.0)), 0.17
# The openings at which the orifice is then measured, as shares of the same way. Each opening is held for HOLD seconds. With an
# offset, the bands separate below the opening 0.01. Without an offset, they separate near 0.2.
HELD = (0.0, 0.001, 0.002, 0.003, 0.004, 0.006, 0.008, 0.01, 0.015, 0.02, 0.03, 0.04, 0.06, 0.08, 0.1, 0.125,
        *np.arange(0.15, 0.36, 0.0125), *np.arange(0.4, 0.91, 0.05), 1.0)
HOLD = 0.03

failures = []


def demand(fine, words):
    print(("" if fine else "FAILED: ") + words)
    if not fine:
        failures.append(words)


def read_valves(case):
    """Returns the log's lines of each valve: time, opening, number of marked cells and integral of K."""
    found = {}
    time = None
    for line in foam.text(case / "log.pimpleFoam").splitlines():
        if line.startswith("Time = "):
            time = float(line.split()[-1])
        match = re.match(r"riis (\w+): opening ([^,]+), (\d+) cells marked, integral of K (\S+)", line)
        if match:
            found.setdefault(match[1], {})[time] = (float(match[2]), int(match[3]), float(match[4].rstrip(",")))
    return {name: np.array([(time, *row) for time, row in sorted(rows.items())]) for name, rows in found.items()}


def amplitude(case, times):
    """Returns the amplitude of the motion."""
    text = foam.text(case / "constant" / "amplitude")
    rows = np.array(re.findall(r"(?<![a-z])[-+]?[0-9][-+.e0-9]*", text), float).reshape(-1, 2)
    return np.interp(times, rows[:, 0], rows[:, 1])


def volumes(case, times):
    """Returns the volume of the mesh in ml, at the start and at the given times. The volume is computed from the outer faces of
    the mesh, moved as beatMotion.C does."""
    mesh = zero_d.Mesh(case)
    return np.array([mesh.volume(one) / ML for one in amplitude(case, (0.0, *times))])


def pressure_of(case, name):
    """Returns times and pressures in mmHg."""
    return foam.columns(case, f"postProcessing/{name}/*/volFieldValue.dat", 2) * (1, RHO / MMHG)


class Beat:
    """Time series of a case, in s, ml, ml/s and mmHg. Inflow and outflow are positive in the forward direction."""

    def __init__(self, case):
        inflow, outflow = foam.table(case, "inflow"), foam.table(case, "outflow")
        self.case, self.time = case, inflow[:, 0]
        self.mitral, self.aortic = -inflow[:, 1] / ML, outflow[:, 1] / ML
        self.ventricle, self.atrium, self.aorta = (pressure_of(case, name)[:, 1] for name in ("ventricle", "atrium", "aorta"))
        valves = read_valves(case)
        self.openings = {name: np.interp(self.time, rows[:, 0], rows[:, 1]) for name, rows in valves.items()}
        log = foam.text(case / "log.pimpleFoam")
        seconds = np.array(re.findall(r"ExecutionTime = (\S+)", log), float)
        # If a run was cut off and continued, its time begins at 0 again.
        self.processor_seconds = seconds[-1] + seconds[:-1][np.diff(seconds) < 0].sum()
        self.courant = max(float(word) for word in re.findall(r"Courant Number mean: \S+ max: (\S+)", log))

    @functools.cached_property
    def volumes(self):
        return volumes(self.case, self.time)

    @property
    def volume(self):
        return self.volumes[1:]


def held(least):
    """Returns the openings at which the orifice is measured."""
    least = float(least)
    if not 0 <= least < 1:
        sys.exit(f"check.py: the least opening is {least:g}, and must be at least 0 and below 1")
    return [least + (1 - least) * share for share in HELD]


def keys(least):
    """The valve uses the first tenth of each hold to move to the next opening."""
    openings = held(least)
    swept = (f"({time:g} {openings[0] + (1 - openings[0]) * share:g})" for time, share in SWEPT)
    holds = (f"({SWEEP + (i + share) * HOLD:.6g} {opening:g})" for i, opening in enumerate(openings) for share in (0.1, 1))
    print(f"period {2 * PERIOD}; keys ({' '.join((*swept, *holds))});")


def orifice(case, valve, least):
    """Prints opening, area and leak, and the volume that a change of the opening displaces.

    The pressure difference drives the leak and the jet. As long as there is no jet, the leak is the flow divided by the pressure
    difference. If a valve does not close, its smallest opening is above 0. At its smallest opening, such a valve has an orifice,
    and no leak.
    """
    openings = held(least)
    beat = Beat(pathlib.Path(case))
    flow, difference = ((beat.mitral, beat.atrium - beat.ventricle) if valve == "mitral" else
                        (beat.aortic, beat.ventricle - beat.aorta))
    opens = beat.time < SWEPT[2][0] + 1e-6
    swept = beat.openings[valve][opens]
    displaced = flow[opens] * (beat.time[1] - beat.time[0]) / np.diff(swept, prepend=openings[0])
    ends = [np.argmin(np.abs(beat.time - SWEEP - (i + 1) * HOLD)) for i in range(len(HELD))]
    flow, difference = flow[ends], difference[ends]
    if not ((flow > 0).all() and (difference > 0).all()):
        sys.exit(f"check.py: the {valve} valve has the flows {flow} ml/s at the differences {difference} mmHg")
    leak = flow / difference * (openings[0] == 0)
    # When bands begin to separate, a little blood passes through. A flow of ten times the leak of the closed valve counts as a
    # jet.
    creeps = leak < 10 * leak[0]
    leak[~creeps] = leak[creeps][-1] if creeps.any() else 0
    area = np.where(creeps, 0, (flow - leak * difference) * ML * np.sqrt(RHO / (2 * difference * MMHG)))
    print("opening,area,leak,displaced")
    for one in np.unique(np.round(np.concatenate([openings, swept]), 6)):
        print(f"{one:g},{np.interp(one, openings, area):.6g},{np.interp(one, openings, leak):.8g},"
              f"{np.interp(one, swept, displaced):.6g}")


def zero_d_at(path, times):
    with open(path, encoding="ascii") as file:
        rows = list(csv.DictReader(file))
    phase = np.array([float(row["time"]) for row in rows])
    order = np.argsort(phase)
    return {name: np.interp(times % PERIOD, phase[order], np.array([float(row[name]) for row in rows])[order], period=PERIOD)
            for name in rows[0] if name != "time"}


def check_beat(case, model_file, mitral, aortic):
    beat = Beat(pathlib.Path(case))
    model = zero_d_at(model_file, beat.time)
    orifices = {"mitral": zero_d.read_orifice(mitral), "aortic": zero_d.read_orifice(aortic)}
    closed = {name: ~orifice.is_open(beat.openings[name]) for name, orifice in orifices.items()}
    step = beat.time[1] - beat.time[0]
    peak = max(beat.mitral.max(), beat.aortic.max())

    balance = np.diff(beat.volumes) / step - (beat.mitral - beat.aortic)
    demand(np.abs(balance).max() <= 1e-5 * peak,
           f"balance: |dV/dt - (Qm - Qa)| is at most {np.abs(balance).max() / peak:.1e} of the peak flow (1e-5)")
    n = round(PERIOD / step)
    drift = np.abs(np.cumsum(balance) * step)[: n].max()
    demand(drift <= 1e-4, f"balance: {drift:.1e} ml are lost or gained within a beat (1e-4)")
    both = ~closed["mitral"] & ~closed["aortic"]
    if all(orifice.leak > 0 for orifice in orifices.values()):
        demand(not both.any(), f"both valves leave an orifice in {both.sum()} steps (0)")

    for name, flow, difference in (("mitral", beat.mitral, beat.atrium - beat.ventricle),
                                   ("aortic", beat.aortic, beat.ventricle - beat.aorta)):
        leak = orifices[name].leak
        if leak == 0:
            print(f"the {name} valve does not close")
            continue
        # A leak is known only if the pressure difference is large, and if the valve has rested for 10 ms.
        at_rest = closed[name] & (np.abs(difference) > 20)
        for _ in range(round(0.01 / step)):
            at_rest[1:] &= at_rest[:-1]
        ratio = flow[at_rest] / difference[at_rest] / leak
        demand(at_rest.any() and np.abs(ratio - 1).max() <= 0.1,
               f"leak of the closed {name} valve: {ratio.min():.3f} to {ratio.max():.3f}"
               f" of the calibrated {leak:.4f} ml/s/mmHg (0.1)")

    moved = beat.time > 0.02  # the blood starts at rest
    off = beat.ventricle - model["ventricle"]
    isovolumetric = closed["mitral"] & closed["aortic"] & moved
    if isovolumetric.any():
        demand(np.abs(off[isovolumetric]).max() <= 3, f"isovolumetric pressure: within"
               f" {np.abs(off[isovolumetric]).max():.2f} mmHg of the heart without space (3)")
    demand(np.abs(off[moved]).max() <= 30,
           f"pressure in the ventricle: within {np.abs(off[moved]).max():.1f}"
           f" mmHg (30), root mean square {np.sqrt((off[moved]**2).mean()):.1f}")
    print_numbers(beat, n)


def print_numbers(beat, n):
    """Prints the numbers of each whole beat, and demands that the last two agree."""
    step = beat.time[1] - beat.time[0]
    rows = []
    for first in range(0, len(beat.time) - n + 1, n):
        part = slice(first, first + n)
        volume, pressure = beat.volume[part] - beat.volume.max(), beat.ventricle[part]
        filling = beat.mitral[part]
        e_wave, _, a_wave = zero_d.waves(beat.time[: n], filling)
        rows.append({
            "stroke volume, ml": volume.max() - volume.min(),
            "largest pressure, mmHg": pressure.max(),
            "aortic peak, ml/s": beat.aortic[part].max(),
            "E wave, ml/s": filling[e_wave],
            "A wave, ml/s": filling[a_wave],
            "backflow mitral, ml": -filling[filling < 0].sum() * step,
            "backflow aortic, ml": -beat.aortic[part][beat.aortic[part] < 0].sum() * step,
            "stroke work, J": -np.sum(pressure * np.gradient(volume)) * MMHG * ML,
        })
    for name in rows[0]:
        print(f"| {name} | " + " | ".join(f"{row[name]:.3g}" for row in rows) + " |")
    print(f"largest Courant number {beat.courant:.1f}, "
          f"processor time {beat.processor_seconds / len(rows) / 60:.1f} minutes a beat")
    if len(rows) > 1:
        worst = max(abs(rows[-1][name] - rows[-2][name]) / abs(rows[-2][name]) for name in
                    ("stroke volume, ml", "largest pressure, mmHg", "aortic peak, ml/s", "E wave, ml/s", "stroke work, J"))
        demand(worst <= 0.02, f"the last two beats differ by at most {worst:.4f} (0.02)")


def check_ranks(one, two):
    first, second = Beat(pathlib.Path(one)), Beat(pathlib.Path(two))
    a, b = read_valves(pathlib.Path(one)), read_valves(pathlib.Path(two))
    for name in a:
        demand(np.array_equal(a[name][:, :3], b[name][:, :3]),
               f"{name}: openings and marked cells of {len(a[name])} lines are equal")
        k = np.abs(a[name][:, 3] / b[name][:, 3] - 1).max()
        demand(k <= 1e-5, f"{name}: integrals of K differ by {k:.1e}, by the digits of the log (1e-5)")
    peak = max(np.abs(first.mitral).max(), np.abs(first.aortic).max())
    off = max(np.abs(first.mitral - second.mitral).max(), np.abs(first.aortic - second.aortic).max()) / peak
    demand(off <= 1e-4, f"flows differ by {off:.1e} of the largest (1e-4)")


def check_restart(whole, restarted):
    first, second = Beat(pathlib.Path(whole)), Beat(pathlib.Path(restarted))
    same = np.isin(np.round(first.time, 9), np.round(second.time, 9))
    peak = max(np.abs(first.mitral).max(), np.abs(first.aortic).max())
    off = max(np.abs(first.mitral[same] - second.mitral).max(), np.abs(first.aortic[same] - second.aortic).max()) / peak
    demand(same.any() and off <= 1e-4, f"restart: flows of {same.sum()} steps differ by {off:.1e} of the largest (1e-4)")
    pressure = np.abs(first.ventricle[same] - second.ventricle).max()
    demand(pressure <= 0.1, f"restart: pressures in the ventricle differ by {pressure:.1e} mmHg (0.1)")


COMMANDS = {"keys": (keys, 1), "orifice": (orifice, 3), "beat": (check_beat, 4), "ranks": (check_ranks, 2),
            "restart": (check_restart, 2)}

if __name__ == "__main__":
    if len(sys.argv) < 2 or sys.argv[1] not in COMMANDS or len(sys.argv) - 2 != COMMANDS[sys.argv[1]][1]:
        sys.exit(__doc__)
    COMMANDS[sys.argv[1]][0](*sys.argv[2:])
    sys.exit(1 if failures else 0)
