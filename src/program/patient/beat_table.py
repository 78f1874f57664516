# SPDX-License-Identifier: Apache-2.0
"""The table of a beat, with the same words and bounds for the cases of all solvers. report.py of a case reads the solver's files
and prints this table.

All numbers are in SI units. A step of the solver is a dictionary:
  time, flow     at the end of the step; the flow is positive in the valve's direction
  opening        of the valve, from 0 to 1
  difference     the pressure before the valve less the pressure behind it
  balance        the flow in less the flow out
  fastest, band  the fastest speed of all, and the fastest in the band of the valve, where the solver's files have them
  leak           of an ideal valve at this difference of pressures, if it is known
  arterial       the pressure in the aorta, if an aortic valve leads there
  orifice, free  the area between the leaflets, and the part of it that the band leaves open, if the solver's files have them

riis patient writes orifice.json beside this file: the two areas of the fully open valve, and words on a thinner band.
"""
import json
import pathlib

PASCALS_OF_MMHG = 133.322387415
REST = 0.05  # the leak is steady so long after the valve has closed [s]
# Bounds of a beat.
MOST_BACK = 0.12          # of the forward volume
LEAST_FREE = 0.8          # of the orifice: the band narrows the valve, and a narrower valve has other flows and gradients
MOST_OFF_FORECAST = 0.03  # of the leak
MOST_AT_BAND = 2          # m/s
MOST_WHILE_MOVING = 8     # m/s
FAST, MOST_FAST_MS = 3, 10  # m/s, and for how long a cell may have it while the valve moves
MOST_BALANCE = 1e-5       # of the largest flow


def motions_of(steps):
    """Returns [[word, start, end], ...]: when the valve opens and closes."""
    found = []
    for last, step in zip(steps, steps[1:]):
        if step["opening"] == last["opening"]:
            continue
        word = "opens" if step["opening"] > last["opening"] else "closes"
        if not found or found[-1][0] != word or found[-1][2] != last["time"]:
            found.append([word, last["time"], last["time"]])
        found[-1][2] = step["time"]
    return found


def is_moving(step, motions):
    return any(start < step["time"] <= end for _, start, end in motions)


class Lines:
    """The rows of the table. `is_fine` tells whether all bounds hold."""

    def __init__(self, is_judged):
        self.rows, self.advice, self.is_judged, self.is_fine = [], [], is_judged, True

    def head(self, text):
        self.rows.append(text)

    def add(self, text, value, unit="", bound=None, shown=None, note=""):
        """Adds a row. A bound is a pair: whether it holds, and its words."""
        if bound is not None and self.is_judged:
            self.is_fine = self.is_fine and bound[0]
            note = f"{'met' if bound[0] else 'MISSED'}: {bound[1]}"
        self.rows.append(f"  {text:<54} {shown or f'{value:.4g}':>9} {unit:<7} {note}".rstrip())

    def advise(self, *sentences):
        """Adds sentences that follow the table."""
        self.advice += sentences

    def add_speed(self, text, steps, name, most):
        """Adds the fastest speed of the steps that have one, and returns them. If all steps have a speed, a bound judges the
        fastest one."""
        known = [step for step in steps if step.get(name) is not None]
        if known:
            speed, is_whole = max(step[name] for step in known), len(known) == len(steps)
            self.add(text + ("" if is_whole else f", in {len(known)} files"), speed, "m/s",
                     (speed <= most, f"at most {most}") if most and is_whole else None)
        return known


def steady_leak(beat, motions):
    """Returns the steps in which the closed valve leaks steadily, at nearly the largest difference of pressures."""
    ends = [end for _, _, end in motions]
    still = [step for step in beat if step["opening"] == 0 and step["difference"] < 0 and not is_moving(step, motions)
             and step["time"] > max((end for end in ends if end <= step["time"]), default=0.0) + REST]
    most = min((step["difference"] for step in still), default=0)
    return [step for step in still if step["difference"] < 0.8 * most]


def read_orifice():
    """Returns the numbers of orifice.json, or {} for a case without them."""
    path = pathlib.Path(__file__).resolve().parent / "orifice.json"
    return json.loads(path.read_text("utf-8")) if path.exists() else {}


def add_orifice(lines, opened, motions, orifice):
    """Adds the areas of the open valve. Blood passes only through the part of the orifice that the band leaves open."""
    still = [step for step in opened if step["opening"] > 0.999 and not is_moving(step, motions)]
    areas = [(step["orifice"], step.get("free")) for step in opened if step.get("orifice") is not None]
    if not areas and still and orifice:
        areas = [(orifice["area_m2"], orifice["free_m2"])]
    if areas:
        area, free = max(areas, key=lambda pair: pair[0])
        lines.add("orifice of the open valve", 1e4 * area, "cm2")
        if free is not None and area > 0:
            share = free / area
            lines.add("of the orifice, left open by the band", 1e4 * free, "cm2",
                      (share >= LEAST_FREE, f"at least {100 * LEAST_FREE:.0f} %, {100 * share:.0f} %"))
            if share < LEAST_FREE:
                lines.advise(f"The band on both sides of the leaflets closes {100 * (1 - share):.0f} % of the orifice, so the "
                             "blood meets a narrower valve than yours.",
                             "Its volumes and gradients are those of the narrower valve. A bound on a share of the flow may be "
                             "missed only because little flows.",
                             orifice.get("cure") or "In riis patient, a smaller --half-thickness leaves more.")
    jets = [step for step in still if step.get("fastest") and step["flow"] > 0]
    if jets:
        most = max(jets, key=lambda step: step["flow"])
        lines.add("effective area: largest flow over its fastest blood", 1e4 * most["flow"] / most["fastest"], "cm2")


def add_clinical(lines, beat, dt, period, motions, orifice):
    """Adds the numbers that a physician compares."""
    if lines.is_judged:
        lines.add("heart rate", 60 / period, "/min", shown=f"{60 / period:.3g}")
    forward, back = (dt * sum(max(sign * step["flow"], 0) for step in beat) for sign in (1, -1))
    lines.add("forward volume", 1e6 * forward, "ml", None if forward > 0 else (False, "above 0"))
    share = back / forward if forward > 0 else float("inf")
    opened = [step for step in beat if step["opening"] > 0]
    is_held = bool(opened) and not motions  # a valve that is held open lets blood flow back
    lines.add("backward volume", 1e6 * back, "ml",
              None if is_held else (share < MOST_BACK, f"below {100 * MOST_BACK:.0f} %, {100 * share:.1f} %"))
    peak = max(beat, key=lambda step: step["flow"])
    lines.add("largest flow", 1e6 * peak["flow"], "ml/s", note=f"at {peak['time']:.3f} s")
    fast = [step for step in opened if step["flow"] > 0.5 * peak["flow"]]
    if fast:
        lines.add("mean gradient, while the flow is above half its largest",
                  sum(step["difference"] for step in fast) / len(fast) / PASCALS_OF_MMHG, "mmHg")
    if opened:
        lines.add("largest gradient while the valve is open", max(step["difference"] for step in opened) / PASCALS_OF_MMHG,
                  "mmHg")
    lines.add_speed("jet: fastest blood while the valve is fully open",
                    [step for step in opened if step["opening"] > 0.999 and not is_moving(step, motions)], "fastest", None)
    add_orifice(lines, opened, motions, orifice)
    arterial = [step["arterial"] for step in beat if step.get("arterial") is not None]
    if arterial:
        lines.add("systolic pressure in the aorta", max(arterial) / PASCALS_OF_MMHG, "mmHg")
        lines.add("diastolic pressure in the aorta", min(arterial) / PASCALS_OF_MMHG, "mmHg")
    held = steady_leak(beat, motions)
    if held and held[0].get("leak") is not None:
        lines.add(f"leak of the closed valve at {-min(step['difference'] for step in held) / PASCALS_OF_MMHG:.0f} mmHg",
                  -1e6 * sum(step["flow"] for step in held) / len(held), "ml/s")


def add_checks(lines, beat, dt, motions, drop, where):
    """Adds the numbers that show whether the mesh and the time step suffice."""
    held = steady_leak(beat, motions)
    if held and held[0].get("leak") is not None:
        share = -sum(step["flow"] for step in held) * (drop or 1) / sum(step["leak"] for step in held)
        if drop is None:
            lines.add("leak, as a multiple of an ideal valve's leak", share)
        else:
            lines.add("leak, as a multiple of the forecast for this mesh", share, "",
                      (abs(share - 1) < MOST_OFF_FORECAST, f"{1 - MOST_OFF_FORECAST:g} to {1 + MOST_OFF_FORECAST:g}"))
            lines.add("forecast of the pressure that the closed valve holds", 100 * drop, "%", note="of an ideal valve's")
    moving = [step for step in beat if is_moving(step, motions)]
    closed = [step for step in beat if step["opening"] == 0 and not is_moving(step, motions)]
    if not lines.add_speed(f"fastest {where} at the closed valve", closed, "band", MOST_AT_BAND):
        resting = [step for step in beat if not is_moving(step, motions)]
        lines.add_speed(f"fastest {where} while the valve is at rest", resting, "fastest", None)
    known = lines.add_speed(f"fastest {where} while the valve moves", moving, "fastest", MOST_WHILE_MOVING)
    if known and len(known) == len(moving):
        above = 1e3 * dt * sum(step["fastest"] > FAST for step in moving)
        lines.add(f"time with a {where} above {FAST} m/s while it moves", above, "ms",
                  (above <= MOST_FAST_MS + 0.1, f"at most {MOST_FAST_MS}"))
    largest = max(abs(step["flow"]) for step in beat)
    if largest > 0:
        balance = max(abs(step["balance"]) for step in beat) / largest
        lines.add("inflow less outflow, as a share of the largest flow", balance, "",
                  (balance <= MOST_BALANCE, "at most 1e-5"), f"{balance:.1e}")


FINE, MISSED, INCOMPLETE = 0, 1, 2  # the status of report.py


def beat_table(steps, period, drop=None, where="cell"):
    """Returns the text of the last beat, and FINE, MISSED or INCOMPLETE.

    drop is the forecast of the drop of the closed valve over (R / eps) u in this mesh, if the solver has one. where names the
    places with a speed.
    """
    if len(steps) < 2:
        return "the run has not made two steps yet", INCOMPLETE
    end = steps[-1]["time"]
    dt = min(b["time"] - a["time"] for a, b in zip(steps, steps[1:]))
    beat = [step for step in steps if step["time"] > end - period - dt / 2]
    motions = motions_of(steps)
    is_complete = len(beat) * dt > 0.99 * period
    said = []
    if not is_complete:
        said.append(f"the tables have {len(beat) * dt:.3g} s of a beat of {period:g} s: what follows is preliminary")
    shown = [motion for motion in motions if motion[2] > beat[0]["time"]]
    said += [f"the valve {word} from {start:.3f} to {last:.3f} s" for word, start, last in shown] or [
        "the valve does not move" if is_complete else "the valve has not moved yet"]
    lines = Lines(is_complete)
    lines.head(f"the beat that ends at {end:g} s")
    add_clinical(lines, beat, dt, period, motions, read_orifice())
    lines.head("numerical checks")
    add_checks(lines, beat, dt, motions, drop, where)
    status = INCOMPLETE if not is_complete else FINE if lines.is_fine else MISSED
    return "\n".join([*said, *lines.rows, *lines.advice]), status


def save_and_print(text, folder):
    """Prints the report, and writes it into report.txt of the folder."""
    print(text, flush=True)
    pathlib.Path(folder, "report.txt").write_text(text + "\n", encoding="utf-8")
