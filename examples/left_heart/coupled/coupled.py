# SPDX-License-Identifier: Apache-2.0
"""Writes the files of the coupled heart, and checks its runs.

    python3 coupled.py tables CASE MITRAL.csv AORTIC.csv   # the tables of check.py orifice
    python3 coupled.py check CASE MITRAL.csv AORTIC.csv    # residual, balance of the flow, openings, numbers of the beat
    python3 coupled.py naive_tables CASE COUPLED START    # for a run with prescribed volumes from a time of the coupled run
    python3 coupled.py naive CASE COUPLED  # how far the pressures of a run with prescribed volumes are off
    python3 coupled.py ranks CASE PART    # PART went on from a time of CASE on 2 ranks
    python3 coupled.py restart CASE PART
"""
import pathlib
import re
import sys

import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent))
import check as prescribed  # noqa: E402
import zero_d  # noqa: E402
from zero_d import ML, MMHG, PERIOD, RHO, foam  # noqa: E402

TABLE = ("time", "volume", "flow", "pressure", "wall", "residual", "slope", "trials", "amplitude")


# ---- The files of the case ----


def isovolumetric(rows, valves):
    """Returns the row after which both valves of the 0D model are closed, during its contraction."""
    mitral, aortic = (rows[:, 5 + i] == valve.orifice.rest for i, valve in enumerate(valves))
    closed = np.flatnonzero((rows[:, 0] < zero_d.SYSTOLE) & mitral & aortic)
    if not len(closed):
        sys.exit("coupled.py: the heart without space never closes both valves in its contraction")
    return rows[closed[0]]


def tables(case, mitral, aortic, beats=3):
    valves = zero_d.Valve("mitral", zero_d.read_orifice(mitral)), zero_d.Valve("aortic", zero_d.read_orifice(aortic))
    leaks = [valve.orifice.leak for valve in valves]
    rows = zero_d.beats(valves)
    row = dict(zip(zero_d.COLUMNS, isovolumetric(rows, valves)))
    phase = row["time"]
    constant = pathlib.Path(case) / "constant"

    def write(name, text):
        (constant / name).write_text(text, encoding="ascii")

    phases = np.arange(round(PERIOD / 1e-3) + 1) * 1e-3
    law = zero_d.table(phases, [zero_d.elastance(t) * MMHG / ML for t in phases])
    write("elastance", f"period {PERIOD}; phase {phase:.10g};\nvolume {row['volume'] * ML:.10g}; // [m3], of the mesh at rest\n"
          f"unstressedVolume {zero_d.HEALTHY.v_0 * ML:.10g};\n"
          f"largestSlope {1.5 * MMHG / ML / sum(leaks):.6g}; // 1.5 over both leaks\n"
          f"elastance table{law};\n")
    times = np.arange(round((beats * PERIOD + 0.1) / 2e-3) + 1) * 2e-3
    zero_d.write_table(constant / "inletPressure", "p0", times, zero_d.at(rows, "atrium", phase + times) * MMHG / RHO)
    resistance = MMHG / ML
    write("arteries", f"proximalResistance {zero_d.PROXIMAL * resistance:.8g};\n"
          f"distalResistance {zero_d.DISTAL * resistance:.8g};\n"
          f"compliance {zero_d.COMPLIANCE / resistance:.8g}; venousPressure 0;\n"
          f"pressure {(row['aorta'] - zero_d.PROXIMAL * row['aortic_flow']) * MMHG:.10g};\n")
    volumes = zero_d.at(rows, "volume", phase + times)
    np.savetxt(constant / "zeroDVolume", np.column_stack([times, volumes]), fmt="%.12g")  # for the naive variant
    for valve in valves:
        write(f"{valve.name}Closed", f"closed {valve.orifice.rest:g};\n")
    write("startPressure", f"internalField uniform {row['ventricle'] * MMHG / RHO:.10g};\n")
    print(f"starts at {phase:.4f} s of the beat, {row['volume']:.2f} ml, {row['ventricle']:.1f} mmHg")


def naive_tables(case, coupled_case, start):
    """Writes the amplitude of the naive variant. The naive variant continues from a time of the coupled run, with the volumes of
    zero_d.py."""
    times, volumes = np.loadtxt(pathlib.Path(case) / "constant" / "zeroDVolume").T
    run = run_of(coupled_case)
    at = np.abs(run["time"] - float(start)).argmin()
    law = foam.text(pathlib.Path(coupled_case) / "constant" / "elastance")
    rest = float(re.search(r"^volume (\S+);", law, re.MULTILINE)[1]) / ML
    volumes += run["volume"][at] - rest - np.interp(run["time"][at], times, volumes)
    amplitudes = zero_d.amplitude_of(zero_d.Mesh(pathlib.Path(case)), volumes * ML)
    zero_d.write_table(pathlib.Path(case) / "constant" / "amplitude", "amplitude", times, amplitudes)


# ---- What a run wrote ----


def columns(case, pattern, names):
    return dict(zip(names, foam.columns(case, pattern, len(names)).T))


def run_of(case):
    """Returns the table of the cavity in ml, s and mmHg, with the flows and the openings."""
    run = columns(case, "postProcessing/elastance/*/elastance.dat", TABLE)
    for name in ("volume", "flow"):
        run[name] = run[name] / ML
    for name in ("pressure", "wall", "residual"):
        run[name] = run[name] / MMHG
    run["mitral_flow"] = -foam.table(case, "inflow")[:, 1] / ML
    run["aortic_flow"] = foam.table(case, "outflow")[:, 1] / ML
    for name, rows in prescribed.read_valves(pathlib.Path(case)).items():
        run[name + "_opening"] = rows[:, 1]
    lengths = {name: len(values) for name, values in run.items()}
    if len(set(lengths.values())) != 1:
        sys.exit(f"{case}: its tables have different numbers of steps: {lengths}")
    return run


def seconds(case):
    return float(re.findall(r"ExecutionTime = (\S+) s", foam.text(pathlib.Path(case) / "log.pimpleFoam"))[-1])


# ---- Checks ----


def check(case, mitral, aortic):
    run = run_of(case)
    residual = np.abs(run["residual"])
    worst = residual.argmax()
    prescribed.demand(residual.max() <= 0.5,
           f"the largest of {len(residual)} residuals is {residual.max():.3f} mmHg, at {run['time'][worst]:.3f} s; "
           f"median {np.median(residual):.3f}; above 0.5: {(residual > 0.5).sum()}")
    print(f"trials a step: mean {run['trials'].mean():.2f}, largest {run['trials'].max():.0f}; "
          f"{seconds(case):.0f} s of processor time, {seconds(case) / len(residual):.2f} s a step")
    peak = max(run["aortic_flow"].max(), run["mitral_flow"].max())
    balance = np.abs(run["flow"] - run["mitral_flow"] + run["aortic_flow"]).max()
    prescribed.demand(balance <= 1e-5 * peak,
           f"|dV/dt - (Qm - Qa)| is at most {balance:.2g} ml/s, {balance / peak:.1e} of the peak flow {peak:.0f} ml/s")
    orifices = {"mitral": zero_d.read_orifice(mitral), "aortic": zero_d.read_orifice(aortic)}
    both = np.logical_and(*(orifice.is_open(run[f"{name}_opening"]) for name, orifice in orifices.items()))
    prescribed.demand(not both.any(), f"both valves are above their dead bands in {both.sum()} steps")
    volume, pressure = run["volume"], run["pressure"]
    work = np.trapz(pressure, volume) * MMHG * ML
    print(f"volume {volume.max():.1f} to {volume.min():.1f} ml, ejection fraction {1 - volume.min() / volume.max():.2f}, "
          f"pressure {pressure.min():.1f} to {pressure.max():.1f} mmHg, stroke work {abs(work):.2f} J")
    base = re.search(r"^ *base (\S+);", foam.text(pathlib.Path(case) / "constant" / "dynamicMeshDict"), re.MULTILINE)
    if base:
        print(f"the base descends by {1e3 * float(base[1]) * np.ptp(run['amplitude']):.1f} mm")
    step = np.diff(run["time"]).mean()
    for name in ("mitral", "aortic"):
        flow, opening = run[name + "_flow"], run[name + "_opening"]
        moves = run["time"][1:][np.diff(orifices[name].is_open(opening))]
        print(f"{name}: peak {flow.max():.0f} ml/s, {np.clip(flow, 0, None).sum() * step:.1f} ml forward, "
              f"{np.clip(flow, None, 0).sum() * step:.1f} ml back; leaves or reaches the closed state at "
              f"{', '.join(f'{t:.3f}' for t in moves)} s")


def naive(case, coupled_case):
    """The same valves, with the volumes of the 0D model."""
    pressure, run = prescribed.pressure_of(case, "ventricle"), run_of(coupled_case)
    off = np.abs(pressure[:, 1] - np.interp(pressure[:, 0], run["time"], run["pressure"])).max()
    print(f"prescribed volumes, valves that switch: {pressure[:, 1].min():.0f} to {pressure[:, 1].max():.0f} mmHg "
          f"in {len(pressure)} steps")
    prescribed.demand(off > 100, f"the prescribed volumes with valves that switch fail by {off:.0f} mmHg (more than 100)")


def both_of(whole, part):
    """Returns the tables of two runs, at the times of the second one."""
    a, b = run_of(whole), run_of(part)
    at = [np.abs(a["time"] - time).argmin() for time in b["time"]]
    a = {name: values[at] for name, values in a.items()}
    if np.abs(a["time"] - b["time"]).max() > 1e-9:
        sys.exit(f"{part} has times that {whole} lacks")
    return a, b


def compare(whole, part, what, bounds):
    a, b = both_of(whole, part)
    for name, (bound, unit) in bounds.items():
        difference = np.abs(a[name] - b[name]).max()
        prescribed.demand(difference <= bound,
               f"{what}: {name} differs by at most {difference:.1e}{unit} in {len(b['time'])} steps ({bound:g})")


def ranks(whole, part):
    compare(whole, part, "1 and 2 ranks", {"mitral_opening": (1e-3, ""), "aortic_opening": (1e-3, ""),
                                           "volume": (5e-3, " ml"), "pressure": (0.5, " mmHg")})


def restart(whole, part):
    compare(whole, part, "restart", {"mitral_opening": (1e-6, ""), "aortic_opening": (1e-6, ""),
                                     "volume": (1e-3, " ml"), "pressure": (0.1, " mmHg")})


COMMANDS = {f.__name__: f for f in (tables, check, naive_tables, naive, ranks, restart)}
if __name__ == "__main__":
    if len(sys.argv) < 3 or sys.argv[1] not in COMMANDS:
        sys.exit(f"coupled.py: the first argument must be one of {', '.join(COMMANDS)}, and the second one a case")
    COMMANDS[sys.argv[1]](*sys.argv[2:])
    sys.exit(1 if prescribed.failures else 0)
