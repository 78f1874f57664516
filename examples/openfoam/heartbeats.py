# SPDX-License-Identifier: Apache-2.0
"""The check of ./run openfoam for the case physiological. check.py calls it."""
import pathlib
import re

import numpy

import foam_files as foam
from check import RHO, constant, estimate, require, valve_table

MMHG = 133.322


def physiological(case):
    """Checks heartbeats at 90 mmHg with arteries at the outlet. The last two heartbeats must agree."""
    n_beats, period = 4, 0.7
    rows = valve_table(case, "valve")
    time, q, opening = rows["Time"], 1e6 * rows["flow"], rows["opening"]
    text = foam.text(pathlib.Path(case) / "log.pimpleFoam")
    courant = numpy.array(re.findall(r"^Courant Number mean: (\S+) max: (\S+)", text, re.MULTILINE), float)
    size, _, factor = estimate(case)
    n = round(1e3 * n_beats * period)
    require(len(time) == n and len(courant) >= n, f"{case} has {n} steps, not {len(time)}")
    stored, numbers = arteries(case, rows["flow"]), []
    print(f"{n_beats} heartbeats at 90 mmHg. K is multiplied by {factor:.3f}. Volumes in ml, pressures in mmHg, speeds in m/s:")
    print(f"  {'beat':>4} {'opens at':>9} {'closes at':>9} {'largest flow':>13} {'forward':>8} {'back':>6} {'aorta':>11}"
          f" {'against':>7} {'leak at':>8} {'leak':>9} {'ideal':>6} {'largest Courant':>15} {'speed at band':>13} {'closed':>7}")
    aorta = RHO * foam.table(case, "downstream")[:, 1] / MMHG
    for beat in range(n_beats):
        now = (time > period * beat + 1e-3) & (time < period * (beat + 1) + 1e-3)
        moves = time[now][numpy.diff(opening[now], prepend=0) != 0] - period * beat
        shut = now & (opening == 0) & (time > period * beat + 0.5)
        require(len(moves) and opening[now].max() > 0.999 and shut.any(), f"beat {beat + 1} opens the valve fully and closes it")
        leak, pressure = -q[shut].mean(), -rows["pressure_difference"][shut].mean()
        ideal = 1e6 * pressure * constant(case, "halfThickness") / constant(case, "resistance") * size
        against = -rows["pressure_difference"][now & (opening == 0)].min() / MMHG
        forward, back = (1e6 * rows[name][now][-1] for name in ("forward_volume", "regurgitant_volume"))
        print(f"  {beat + 1:>4} {moves[0]:>7.3f} s {moves[-1]:>7.3f} s {q[now].max():>8.1f} ml/s {forward:>8.2f} {back:>6.2f}"
              f" {aorta[now].min():>5.1f}-{aorta[now].max():<5.1f} {against:>7.1f} {pressure / MMHG:>8.1f} {leak:>4.2f} ml/s"
              f" {ideal:>6.2f} {courant[-n:][now, 1].max():>15.2f} {rows['speed_at_band'][now].max():>13.2f}"
              f" {rows['speed_at_band'][shut].max():>7.2f}")
        require(against > 85, f"in beat {beat + 1} the valve closes against more than 85 mmHg: {against:.1f}")
        require(abs(leak / ideal - 1) < 0.05,
                f"in beat {beat + 1} the leak is the ideal one to 5 %: {leak:.3f} and {ideal:.3f} ml/s")
        require(back < 0.2 * forward, f"in beat {beat + 1} less than a fifth flows back: {back:.2f} of {forward:.2f} ml")
        require(20 < forward < 120, f"in beat {beat + 1} 20 to 120 ml flow forward: {forward:.2f}")
        numbers.append({"forward volume": forward, "regurgitant volume": back, "largest flow": q[now].max(),
                        "lowest pressure above the valve": aorta[now].min(), "highest pressure above it": aorta[now].max(),
                        "pressure of the arteries at the end": stored[now][-1]})
    changes = {name: abs(numbers[-1][name] / numbers[-2][name] - 1) for name in numbers[0]}
    print(f"From beat {n_beats - 1} to beat {n_beats}: " + ", ".join(f"{name} {100 * x:.2f} %" for name, x in changes.items()))
    for name, change in changes.items():
        require(change <= 0.02, f"the last two beats have the same {name} to 2 %: it changes by {100 * change:.2f} %")


def arteries(case, flows):
    """Returns the pressure in the compliance in each step in Pa, computed from the table of the flow. The last pressure must
    agree with that of OpenFOAM."""
    keys = ("distalResistance", "compliance", "pressure")
    first, last = ([float(re.search(rf"\b{key}\s+([0-9.e+-]+);", foam.text(pathlib.Path(case) / at / "p", "latin-1"))[1])
                    for key in keys] for at in ("0", foam.times(case)[-1]))
    distal, compliance, pressure = first
    stored = []
    for flow in flows:
        pressure = (pressure + 1e-3 / compliance * flow) / (1 + 1e-3 / (compliance * distal))
        stored.append(pressure)
    print(f"The arteries hold {last[2] / MMHG:.2f} mmHg at the end, and by the table of the flow {pressure / MMHG:.2f}.")
    require(abs(last[2] / pressure - 1) < 0.01,
            f"the arteries have the pressure of the flow to 1 %: {last[2]:.1f} and {pressure:.1f} Pa")
    return numpy.array(stored)
