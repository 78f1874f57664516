# SPDX-License-Identifier: Apache-2.0
"""A 0D model of the left heart writes the motion of the wall, both end pressures and the openings for the flow in space.

    python3 zero_d.py CASE MITRAL.csv AORTIC.csv [--beats N] [--dilated] [--out TABLE.csv]

The ventricle has the elastance E(t), so p = E (V - V0). The pulmonary veins fill an atrium before the ventricle, and a windkessel
lies behind it. The tables contain the leak of each closed valve, the area that each opening leaves to the flow, and the volume
that the moving leaflets displace. check.py orifice measures them in the mesh, so the isovolumetric phases last as long as in
space. Blood is incompressible, so an error of a few milliseconds would change the pressure in space by hundreds of mmHg.

With --dilated the ventricle is larger, as after years of a large regurgitation. In space, the wall of this ventricle begins
farther out.

The model runs until its beats repeat. The case's tables begin after the A wave, when the blood in the closing mitral valve is
at rest, because the case starts at rest.
"""
import argparse
import collections
import csv
import math
import pathlib
import sys
import typing

import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "openfoam"))
import foam_files as foam  # noqa: E402

MMHG, ML, RHO = 133.322, 1e-6, 1060.0  # Pa, m3, kg/m3
PERIOD, STEP, STEP_IN_SPACE = 0.8, 5e-5, 2e-3  # s
SYSTOLE, RELAXATION, STEEP = 0.35, 0.14, 0.6    # s, s, -: of the ventricle's activation
KICK_START, KICK = 0.60, 0.17               # s, of the atrium's activation
E_MIN, E_MAX = 0.055, 2.2                   # mmHg/ml
ATRIUM_MIN, ATRIUM_KICK, ATRIUM_V_0 = 0.17, 0.15, 5.0  # mmHg/ml, mmHg/ml, ml
VEIN_RESISTANCE = 0.045                                # mmHg s/ml
PROXIMAL, DISTAL, COMPLIANCE = 0.08, 1.05, 1.4         # mmHg s/ml, ml/mmHg
MOVE = {"mitral": 0.07, "aortic": 0.05}     # s, to open and to close
OPEN_ABOVE, DWELL = 2.0, 0.06                     # mmHg, s
INERTANCE = {"mitral": 5e-4, "aortic": 9e-4}      # mmHg s2/ml, of the tube and the blood before it
AT_REST = 119.9  # ml, of the ventricle in heart.geo at the amplitude 0: 2/3 pi 28 mm 28 mm 73 mm


class Body(typing.NamedTuple):
    """The constants that a large regurgitation changes, compared with the healthy heart."""

    v_0: float            # ml, of the ventricle without a pressure
    vein_pressure: float  # mmHg
    # A valve begins to close when its flow falls below close_below, in ml/s. A valve that closes at full backflow would stop the
    # blood abruptly. If a valve begins to close late, both valves are open for a moment. For example, a mitral valve with a clip
    # still fills fast when the beat begins.
    close_below: float


HEALTHY, DILATED = Body(6.0, 12.0, 60.0), Body(36.0, 15.0, 120.0)


def elastance(t):
    """mmHg/ml"""
    t %= PERIOD
    if t < SYSTOLE:
        active = (1 - math.cos(math.pi * (t / SYSTOLE) ** STEEP)) / 2
    elif t < SYSTOLE + RELAXATION:
        active = (1 + math.cos(math.pi * (t - SYSTOLE) / RELAXATION)) / 2
    else:
        active = 0
    return E_MIN + (E_MAX - E_MIN) * active


def atrial_elastance(t):
    phase = (t - KICK_START) % PERIOD / KICK
    return ATRIUM_MIN + (ATRIUM_KICK * math.sin(math.pi * phase) ** 2 if phase < 1 else 0)


class Orifice(typing.NamedTuple):
    """The area that a valve leaves to the flow at each opening, and the largest opening at which the valve seals, or -1 if it
    never seals.

    A valve seals if it leaves no area, and its leak is less than 1.1 times the leak at opening 0.
    """

    openings: np.ndarray
    areas: np.ndarray      # m2
    leaks: np.ndarray      # ml/s/mmHg
    displaced: np.ndarray  # ml, by the leaflets for a change of the opening by 1
    sealed: float

    @property
    def rest(self):
        """The opening of the closed valve. At this opening the bands just touch. Leaflets that begin to open therefore push
        hardly any blood before their bands separate."""
        return max(self.sealed, self.openings[0])

    @property
    def leak(self):
        return np.interp(self.rest, self.openings, self.leaks)

    def is_open(self, opening):
        return opening > self.sealed + 1e-6


class Valve:
    """The flow Q in addition to the leak: L dQ/dt = dp - q |q| rho / (2 A^2), with the effective area A of the opening.

    q is the flow that passes the leaflets. Q also includes the volume that the leaflets displace.
    """

    def __init__(self, name, orifice, body=HEALTHY):
        self.name, self.orifice, self.close_below = name, orifice, body.close_below
        self.flow, self.before, self.progress, self.opens, self.turned = 0.0, 0.0, 0.0, False, -1.0
        self.lagged = collections.deque([self.opening()] * (1 + round(STEP_IN_SPACE / 2 / STEP)))

    def opening(self):
        rest = self.orifice.rest
        # The motion of the leaflets begins and ends without acceleration, because the blood that they push between closed valves
        # cannot escape.
        return rest + (1 - rest) * self.progress**3 * (10 - 15 * self.progress + 6 * self.progress**2)

    def pushed(self):
        """Returns the flow that the leaflets displace in the step.

        OpenFOAM computes the leaflets' flow as a mean over the step, and their position at the end of the step. In space, the
        openings therefore lag by half a time step (write_tables).
        """
        now = self.opening()
        self.lagged.append(now)
        return np.interp(now, self.orifice.openings, self.orifice.displaced) * (self.lagged[1] - self.lagged.popleft()) / STEP

    def step(self, t, difference):
        falls = self.flow < min(self.close_below, self.before)
        self.before = self.flow
        if t - self.turned > DWELL and (falls if self.opens else difference > OPEN_ABOVE):
            self.opens, self.turned = not self.opens, t
        change = STEP / MOVE[self.name]
        self.progress = min(1.0, max(0.0, self.progress + (change if self.opens else -change)))
        area, conductance = (np.interp(self.opening(), self.orifice.openings, values)
                             for values in (self.orifice.areas, self.orifice.leaks))
        pushed = self.pushed()
        if area > 0:
            loss = 0.5 * RHO * (ML / area) ** 2 / MMHG  # mmHg s2/ml2
            conductance += 1 / (loss * max(abs(self.flow - pushed), 0.5))
        inertance = INERTANCE[self.name]
        self.flow = ((self.flow + STEP / inertance * (difference + pushed / conductance)) /
                     (1 + STEP / (inertance * conductance)))


REPEATS = 2e-3  # ml
COLUMNS = ("time", "volume", "ventricle", "atrium", "aorta", "mitral_opening", "aortic_opening", "mitral_flow", "aortic_flow")


def beats(valves, body=HEALTHY, most=40):
    """Returns one beat, row by row in COLUMNS, once the volume repeats to REPEATS."""
    mitral, aortic = valves
    volume, stored, atrium, before = 120.0, 85.0, 60.0, 0.0
    n = round(PERIOD / STEP)
    for _ in range(most):
        rows = np.empty((n, len(COLUMNS)))
        for k in range(n):
            t = k * STEP
            p, p_atrium = elastance(t) * (volume - body.v_0), atrial_elastance(t) * (atrium - ATRIUM_V_0)
            p_aorta = stored + PROXIMAL * aortic.flow
            mitral.step(t, p_atrium - p)
            aortic.step(t, p - p_aorta)
            rows[k] = (t, volume, p, p_atrium, p_aorta, mitral.opening(), aortic.opening(), mitral.flow, aortic.flow)
            volume += STEP * (mitral.flow - aortic.flow)
            atrium += STEP * ((body.vein_pressure - p_atrium) / VEIN_RESISTANCE - mitral.flow)
            stored += STEP * (aortic.flow - stored / DISTAL) / COMPLIANCE
        for valve in valves:
            valve.turned -= PERIOD
        change, before = volume - before, volume
        if abs(change) < REPEATS:
            # A jump of the volume at the end of the beat would be a flow into a closed chamber. The remaining difference is
            # therefore spread over the beat.
            rows[:, 1] -= change * rows[:, 0] / PERIOD
            return rows
    sys.exit(f"zero_d.py: the volume still changes by {change:g} ml after {most} beats")


def start_of(rows):
    """Returns the row after the A wave at which the blood in the mitral valve is at rest. The valve is half closed at this
    time."""
    half_open = (rows[:, 5].min() + 1) / 2
    ending = np.flatnonzero((rows[:, 0] > KICK_START + KICK / 2) & (rows[:, 5] > 0.6 * half_open))
    return ending[np.argmin(np.abs(rows[ending, 7]))]


def waves(time, flow):
    """Returns the rows of the E wave's peak, of the trough behind it, and of the A wave's peak, from a beat of the mitral flow.

    The A wave begins at the trough. When the atrium begins to contract, the end of a high E wave may exceed the A wave. A run in
    space begins shortly before the beat of zero_d.py, so the same times are valid for it.
    """
    filling, kick = np.where(time > SYSTOLE, flow, 0), np.searchsorted(time, KICK_START + KICK / 2)
    e_wave = np.argmax(filling[:kick])
    trough = e_wave + np.argmin(filling[e_wave:kick])
    return e_wave, trough, trough + np.argmax(filling[trough:])


def report(rows, valves, out=sys.stdout):
    col = {name: rows[:, i] for i, name in enumerate(COLUMNS)}
    e_wave, _, a_wave = (col["mitral_flow"][row] for row in waves(col["time"], col["mitral_flow"]))
    both = valves[0].orifice.is_open(col["mitral_opening"]) & valves[1].orifice.is_open(col["aortic_opening"])
    stroke = col["volume"].max() - col["volume"].min()
    print(f"0D: {col['volume'].max():.1f} to {col['volume'].min():.1f} ml, ejection fraction {stroke / col['volume'].max():.2f}, "
          f"ventricle {col['ventricle'].min():.1f} to {col['ventricle'].max():.1f} mmHg, "
          f"aorta {col['aorta'].min():.1f} to {col['aorta'].max():.1f}, "
          f"atrium {col['atrium'].min():.1f} to {col['atrium'].max():.1f}",
          file=out)
    print(f"0D: E {e_wave:.0f} ml/s, A {a_wave:.0f}, E/A {e_wave / a_wave:.2f}, aortic peak {col['aortic_flow'].max():.0f}; "
          f"both valves leave an orifice for {both.sum() * STEP * 1e3:.1f} ms", file=out)


# ---- The tables of the case ----


def triangles(path):
    """Returns the corners of all faces. The file is text, and has only triangles."""
    text = foam.text(path)
    body = text[text.index("(", text.index("// * *")) + 1 : text.rindex(")")]
    numbers = np.array(body.replace("(", " ").replace(")", " ").split(), int)
    if len(numbers) % 4 or (numbers[::4] != 3).any():
        sys.exit(f"zero_d.py: {path} has other faces than triangles")
    return numbers.reshape(-1, 4)[:, 1:]


class Mesh:
    """The outer faces of the case's mesh, to find its volume at any amplitude of the motion."""

    def __init__(self, case):
        folder = case / "constant" / "polyMesh"
        self.points = foam.vectors(folder / "points")
        self.outer = triangles(folder / "faces")[len(foam.labels(folder / "neighbour")):]
        text = foam.text(case / "constant" / "dynamicMeshDict")
        words = text.replace(";", " ").split()
        self.length, self.ramp, self.radial, self.axial, self.base = (
            float(words[words.index(key) + 1]) for key in ("length", "ramp", "radial", "axial", "base"))

    def moved(self, amplitude):
        """Computes the same as beatMotion.C, but the base does not descend. The descent of the base does not change any
        volume."""
        x = self.points.copy()
        below = x[:, 2] < 0
        depth = np.minimum(1, -x[below, 2] / (self.length * self.ramp))
        grip = depth**2 * (3 - 2 * depth)
        x[below, :2] *= (1 - amplitude * self.radial * grip)[:, None]
        x[below, 2] *= 1 - amplitude * self.axial * grip
        return x

    def volume(self, amplitude):
        a, b, c = (self.moved(amplitude)[self.outer[:, i]] for i in range(3))
        return float(np.einsum("ij,ij->", a, np.cross(b, c))) / 6


def amplitude_of(mesh, change):
    """Returns the amplitudes for given changes of the mesh's volume, relative to the volume at rest, in m3."""
    amplitudes = np.linspace(-0.6, 1.25, 60)  # in the coarse mesh, a run with 1.28 blew up
    changes = np.array([mesh.volume(a) for a in amplitudes]) - mesh.volume(0)
    if changes[0] < change.max() or changes[-1] > change.min():
        sys.exit(f"zero_d.py: the motion spans {changes[-1] / ML:.1f} to {changes[0] / ML:.1f} ml, and the heart needs "
                 f"{change.min() / ML:.1f} to {change.max() / ML:.1f} ml")
    # The volume is a cubic polynomial of the amplitude, so the fit is exact.
    cubic = np.polynomial.Polynomial.fit(amplitudes, changes, 3)
    slope = cubic.deriv()
    found = np.interp(change, changes[::-1], amplitudes[::-1])
    for _ in range(5):
        found -= (cubic(found) - change) / slope(found)
    return found


def at(rows, name, times):
    """Returns a column of a beat at any times after its start."""
    return np.interp(times, rows[:, 0], rows[:, COLUMNS.index(name)], period=PERIOD)


def table(times, values):
    return "\n(\n" + "\n".join(f"({t:.6g} {v:.15g})" for t, v in zip(times, values)) + "\n)"


def write_table(path, key, times, values):
    path.write_text(f"{key} table{table(times, values)};\n", encoding="ascii")


def write_start(case, mesh, amplitude):
    """Writes the points at which the run starts, as if it were a restart. The points at rest stay in constant."""
    points = mesh.moved(amplitude) - (0, 0, amplitude * mesh.base)
    folder = case / "0" / "polyMesh"
    folder.mkdir(exist_ok=True)
    head = "FoamFile { version 2.0; format ascii; class vectorField; location 0/polyMesh; object points; }"
    rows = "\n".join("({:.15g} {:.15g} {:.15g})".format(*row) for row in points)
    (folder / "points").write_text(f"{head}\n{len(points)}\n(\n{rows}\n)\n", encoding="ascii")


def write_tables(case, rows, n_beats, dilated=False):
    """Writes constant/amplitude, constant/inletPressure, constant/outletPressure, and constant/mitralKeys and aorticKeys.

    The wall of the healthy heart starts at rest. The wall of a dilated heart starts where the ventricle has the volume of the 0D
    model.
    """
    start = rows[start_of(rows), 0]
    times = np.arange(round(n_beats * PERIOD / 1e-3) + 1) * 1e-3
    keys = np.arange(round(PERIOD / 1e-3)) * 1e-3

    change = (at(rows, "volume", start + times) - (AT_REST if dilated else at(rows, "volume", start))) * ML
    constant = case / "constant"
    # OpenFOAM uses dV/dt as the mean over a step, and the opening at the end of the step. The openings therefore lag by half a
    # step.
    lagged = keys - STEP_IN_SPACE / 2
    mesh = Mesh(case)
    amplitudes = amplitude_of(mesh, change)
    write_table(constant / "amplitude", "amplitude", times, amplitudes)
    if dilated:
        write_start(case, mesh, amplitudes[0])
    for name, file in (("atrium", "inletPressure"), ("aorta", "outletPressure")):
        pressures = at(rows, name, start + times) * MMHG / RHO
        # The blood begins with the pressure 0, including both ends. decomposePar writes the first row of the tables there. On
        # several ranks, another first row would push the blood in the first step. The solver itself uses the rows from the end of
        # the first step on.
        pressures[0] = 0
        write_table(constant / file, "p0", times, pressures)
    for name in ("mitral", "aortic"):
        openings = table(keys, at(rows, f"{name}_opening", start + lagged))
        (constant / f"{name}Keys").write_text(f"period {PERIOD}; keys{openings};\n", encoding="ascii")
    return start


def read_orifice(path):
    """Returns the table of a valve that check.py orifice has measured.

    If a valve does not close, its table begins with an opening above 0, which leaves an area. In this case the leak is 0.
    """
    with open(path, encoding="ascii") as file:
        rows = list(csv.DictReader(file))
    columns = ("opening", "area", "leak", "displaced")
    for column in columns:
        if not rows or column not in rows[0]:
            sys.exit(f"zero_d.py: {path} has no column {column}; make it by check.py orifice")
    openings, areas, leaks, displaced = (np.array([float(row[column]) for row in rows]) for column in columns)
    leak = leaks[0]
    ascend = np.isfinite(areas).all() and areas[-1] > 0 and openings[-1] == 1 and (np.diff(openings) > 0).all()
    if ascend and openings[0] > 0 and areas[0] > 0 and leak == 0:
        return Orifice(openings, areas, leaks, displaced, -1.0)
    if not (leak > 0 and np.isfinite(leaks).all()):
        sys.exit(f"zero_d.py: {path}: the leak is {leak:g}, and must be positive")
    if not (ascend and areas[0] == 0 and openings[0] == 0):
        sys.exit(f"zero_d.py: {path}: openings must ascend from 0 to 1, and areas must begin with 0 and end with a positive one")
    # For a row with an area, the leak is that of the last row without an area. A valve therefore seals only if its area is also
    # 0.
    parts = np.flatnonzero((areas > 0) | (leaks >= 1.1 * leak))[0]
    return Orifice(openings, areas, leaks, displaced, openings[parts - 1])


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("case", type=pathlib.Path)
    parser.add_argument("mitral")
    parser.add_argument("aortic")
    parser.add_argument("--beats", type=int, default=1, choices=range(1, 10))
    parser.add_argument("--dilated", action="store_true")
    parser.add_argument("--out", default="zero_d.csv")
    options = parser.parse_args()
    body = DILATED if options.dilated else HEALTHY
    valves = Valve("mitral", read_orifice(options.mitral), body), Valve("aortic", read_orifice(options.aortic), body)
    rows = beats(valves, body)
    report(rows, valves)
    start = write_tables(options.case, rows, options.beats, options.dilated)
    shifted = np.roll(rows, -start_of(rows), axis=0)[::10]
    shifted[:, 0] = (shifted[:, 0] - start) % PERIOD
    np.savetxt(options.out, shifted, delimiter=",", header=",".join(COLUMNS), comments="", fmt="%.10g")


if __name__ == "__main__":
    main()
