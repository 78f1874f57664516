# SPDX-License-Identifier: Apache-2.0
"""Tries volumeSearch.H in a 0D model of the heart: prints the pressures and the trials of each variant of the search.

    python3 study.py LIBRARY         # LIBRARY: libvolumeSearch.so

The blood of this model responds as in OpenFOAM. The model gives the pressure that belongs to a volume. The valves move once in
each step. Each outer corrector uses the flows of the previous corrector.
"""
import ctypes
import math
import sys

MMHG = 133.322  # Pa
ML = 1e-6       # m3
STEP, PERIOD, START = 2e-3, 0.8, 0.09  # s
LEAK = {"mitral": 0.026, "aortic": 0.0137}     # of the closed valve, ml/s/mmHg
ORIFICE = {"mitral": 2.6, "aortic": 1.4}       # of the open valve, cm2
DEAD = {"mitral": 0.2, "aortic": 0.25}         # the opening up to which the valve is sealed
INERTANCE = {"mitral": 5e-4, "aortic": 9e-4}   # mmHg s2/ml
UNSTRESSED = 8.0                               # ml
PROXIMAL, DISTAL, COMPLIANCE = 0.065, 1.1, 1.4  # mmHg s/ml, ml/mmHg


def elastance(time):  # mmHg/ml
    t = time % PERIOD
    if t < 0.38:
        active = (1 - math.cos(math.pi * t / 0.38)) / 2
    else:
        active = (1 + math.cos(math.pi * (t - 0.38) / 0.15)) / 2 if t < 0.53 else 0
    return 0.074 + 2.126 * active


def atrium(time):  # mmHg
    kick = (time % PERIOD - 0.64) / 0.14
    return 7.5 + (5 * math.sin(math.pi * kick) ** 2 if 0 < kick < 1 else 0)


class Valve:
    """The law `switch`: the valve opens above 3 mmHg, closes when the flow reverses, and takes 40 ms for each motion."""

    def __init__(self, name):
        self.name, self.flow, self.progress, self.opens, self.turned = name, 0.0, 0.0, False, -1.0

    def advance(self, time, difference):
        if time - self.turned > 0.02 and (self.flow < 0 if self.opens else difference > 3):
            self.opens, self.turned = not self.opens, time
        self.progress = min(1, max(0, self.progress + (STEP if self.opens else -STEP) / 0.04))

    def conductance(self, flow):
        """The mean flow divided by the pressure difference, in ml/s/mmHg."""
        opening = self.progress ** 2 * (3 - 2 * self.progress)
        share = max(0, (opening - DEAD[self.name]) / (1 - DEAD[self.name]))
        area = ORIFICE[self.name] * 1e-4 * share ** 1.5  # m2
        return LEAK[self.name] + (area ** 2 / (530 * ML ** 2) * MMHG / max(abs(flow), 2) if area > 0 else 0)


class Blood:
    """The valves and the vessels. `pressure` returns the pressure of the cavity for its flow dV/dt over the step."""

    def __init__(self):
        self.valves = [Valve("mitral"), Valve("aortic")]
        self.stored = 85.0
        self.last = [0.0, 0.0]

    def begin(self, time, pressure):
        mitral, aortic = self.valves
        ends = atrium(time), self.stored + PROXIMAL * aortic.flow
        mitral.advance(time, ends[0] - pressure)
        aortic.advance(time, pressure - ends[1])
        self.time, self.last = time, [mitral.flow, aortic.flow]

    def pressure(self, flow):
        mitral, aortic = self.valves
        parts = []  # the flow through a valve is offset + slope (difference of pressure)
        for valve, last in zip(self.valves, self.last):
            inertance = INERTANCE[valve.name] / STEP
            slope = 1 / (inertance + 1 / valve.conductance(last))
            parts.append((slope * inertance * valve.flow, slope))
        (om, sm), (oa, sa) = parts
        ends = atrium(self.time + STEP), self.stored + PROXIMAL * self.last[1]
        found = (om - oa + sm * ends[0] + sa * ends[1] - flow) / (sm + sa)
        self.last = [om + sm * (ends[0] - found), oa + sa * (found - ends[1])]
        return found

    def end(self):
        for valve, flow in zip(self.valves, self.last):
            valve.flow = flow
        self.stored += STEP * (self.last[1] - self.stored / DISTAL) / COMPLIANCE


def library(path):
    search = ctypes.CDLL(path)
    search.search_new.restype = ctypes.c_void_p
    search.search_new.argtypes = [ctypes.c_double] * 5 + [ctypes.c_int]
    for name, arguments in (("begin", 3), ("measured", 1), ("next", 0), ("residual", 0), ("miss", 0), ("slope", 0),
                            ("echo", 0)):
        function = getattr(search, "search_" + name)
        function.restype = ctypes.c_double
        function.argtypes = [ctypes.c_void_p] + [ctypes.c_double] * arguments
    search.search_delete.argtypes = [ctypes.c_void_p]
    return search


def coupled(search, beats, most, safeguards):
    """Returns for each step: time, volume, pressure, residual, trials, the worst pressure of a trial, openings."""
    volume = 119.0
    pressure = elastance(START) * (volume - UNSTRESSED)
    largest = 1 / sum(LEAK.values())
    state = search.search_new(0.05 * MMHG / ML, largest * MMHG / ML, 20 * MMHG, volume * ML, pressure * MMHG, safeguards)
    blood, rows = Blood(), []
    for step in range(round(beats * PERIOD / STEP)):
        time = START + step * STEP
        blood.begin(time, pressure)
        before, worst = volume, 0.0
        last = False
        for trial in range(most):
            volume = (search.search_next(state) if trial else
                      search.search_begin(state, STEP, elastance(time + STEP) * MMHG / ML, UNSTRESSED * ML)) / ML
            pressure = blood.pressure((volume - before) / STEP)
            worst = max(worst, abs(pressure))
            search.search_measured(state, pressure * MMHG)
            residual = search.search_residual(state) / MMHG
            if not math.isfinite(residual):
                break
            if last:
                break
            last = search.search_miss(state) / MMHG < 0.25  # PIMPLE then makes one more corrector
        blood.end()
        rows.append((time + STEP, volume, pressure, residual, trial + 1, worst, *(v.progress for v in blood.valves)))
        if not math.isfinite(residual) or worst > 1e6:
            break
    search.search_delete(state)
    return rows


def prescribed(volumes):
    """The naive variant has volumes from another model, and valves that open and close by the pressures of this heart."""
    blood, rows, before = Blood(), [], volumes[0]
    pressure = elastance(START) * (before - UNSTRESSED)
    for step, volume in enumerate(volumes):
        time = START + step * STEP
        blood.begin(time, pressure)
        for _ in range(3):
            pressure = blood.pressure((volume - before) / STEP)
        blood.end()
        before = volume
        rows.append(pressure)
    return rows


def main():
    search = library(sys.argv[1])
    print("search, most trials | steps | mean trials | above 0.5 mmHg | largest residual | largest pressure of a trial, mmHg")
    for safeguards in (0, 1):
        for most in (4, 6, 8, 12):
            rows = coupled(search, 3, most, safeguards)
            trials = [row[4] for row in rows]
            name = "with safeguards" if safeguards else "bare secant"
            print(f"{name}, {most} | {len(rows)} | {sum(trials) / len(trials):.2f} | "
                  f"{sum(not abs(row[3]) <= 0.5 for row in rows)} | {max(abs(row[3]) for row in rows):.2g} | "
                  f"{max(row[5] for row in rows):.0f}")
    rows = coupled(search, 3, 12, 1)
    last = rows[-round(PERIOD / STEP):]
    print(f"coupled: {max(r[1] for r in last):.1f} to {min(r[1] for r in last):.1f} ml, {min(r[2] for r in last):.1f} to "
          f"{max(r[2] for r in last):.1f} mmHg")
    bands = dict(DEAD)
    for share in (1, 0.75, 0.5, 0):  # of the dead band in the heart that the volumes come from
        DEAD.update({name: share * band for name, band in bands.items()})
        volumes = [row[1] for row in coupled(search, 1, 12, 1)]
        DEAD.update(bands)
        found = prescribed(volumes)
        print(f"volumes of a heart with {share:g} of the dead bands, valves that switch: "
              f"{min(found):.0f} to {max(found):.0f} mmHg")


if __name__ == "__main__":
    main()
