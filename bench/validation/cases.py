# SPDX-License-Identifier: Apache-2.0
"""Reads the cases of body_fitted.sh: their names, flows and effective areas."""
import pathlib
import re
import sys

import mitral
import numpy

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "examples/openfoam"))
import foam_files as foam  # noqa: E402

RHO = 1060.0  # kg/m3
INLET = 0.5  # m/s, of steady_case/0/U
MMHG = 133.322  # Pa
GORLIN = 44.3  # cm2, ml/s and mmHg: the constant of Gorlin's formula for the aortic valve
RADIUS = {"bileaflet": 1.1, "trileaflet": 1.22, "coapting": 1.24}  # radii of the tubes, in centimetres
# Areas of the inlets, in cm2.
TUBE = {**{valve: numpy.pi * radius ** 2 for valve, radius in RADIUS.items()}, "mitral": mitral.inflow_area()}
COPIES = {"bileaflet": 4, "trileaflet": 6, "coapting": 6, "mitral": 2}  # number of equal pieces; one piece is computed
STEADY = 1e-4  # largest share of the drop by which it may change over the last 100 steps of a run that did not converge
SOLVER = "OpenFOAM 1912, simpleFoam, tetrahedra"
WALLS = "the same leaflets as walls of no thickness, body-fitted"  # the source of a row's reference


class Unsteady(Exception):
    """Raised for a run whose flow is not steady."""


class Run:
    """The results of one case, with its effective area in cm2."""

    def __init__(self, folder, meshes):
        self.folder, self.name = folder, folder.name
        kind, self.valve, opening, *words = self.name.split("-")
        self.opening = float(opening)
        self.fitted, self.solid = kind == "fitted", kind == "solid"
        self.rim = words[2] if kind == "riis" else None
        self.eps = 0.0 if self.fitted else float(words[0])
        self.size = float(words[0 if self.fitted else 1])
        self.far = float(words[1]) if self.fitted and len(words) > 1 else 0.13
        # Tells whether the band has two edges in eps. A usual mesh also has no other options.
        self.has_two_edges = kind == "riis" and abs(self.eps / self.size - 2) < 1e-6
        self.usual = self.has_two_edges and len(words) < 6
        self.resistance = float(words[3]) if kind == "riis" else None
        self.offset = float(words[4]) if kind == "riis" and len(words) > 4 else None
        mesh = self.name
        if kind == "riis":
            kind = "free" if self.offset is None else "wide"
            mesh = "-".join([kind, self.valve, opening, *words[:2], *words[5:]])
        self.cells = foam.n_cells(meshes / mesh / "constant/polyMesh")
        log = foam.text(folder / "log.simpleFoam")
        pressure = foam.table(folder, "inlet")[:, 1]
        self.steps = len(pressure)
        self.converged = "SIMPLE solution converged" in log
        # The area follows from the total drop, which differs from the static drop by a constant.
        total = pressure[-100:] + INLET ** 2 / 2
        self.change = (total.max() - total.min()) / total[-1]
        if not self.converged and not self.change <= STEADY:
            raise Unsteady(f"{folder.name}: simpleFoam did not converge in {self.steps} steps, and the drop still changes by"
                           f" {self.change:.1e} of it in 100 steps")
        self.seconds = float(re.findall(r"ExecutionTime = (\S+) s", log)[-1])
        self.settled = abs(pressure[-1] / pressure[-20] - 1)
        self.drop = RHO * pressure[-1]  # Pa, static, from the inlet to the outlet
        self.flow = INLET * TUBE[self.valve] * 1e2  # ml/s
        out = foam.table(folder, "outlet")[-1, 1] * 1e6 * COPIES[self.valve]
        # The mesh has polygons instead of circles, so a coarse mesh has less flow. The area follows from the polygon's flow.
        if abs(out / self.flow - 1) > 0.03:
            raise SystemExit(f"{folder}: {out} ml/s leave the tube, and {self.flow} enter it")
        self.flow = out
        self.total = self.drop + RHO * INLET ** 2 / 2
        self.area = self.flow / numpy.sqrt(2 * self.total / RHO) * 1e-2
        time = max((one.name for one in folder.iterdir() if one.name.isdigit()), key=int)
        self.jet = numpy.linalg.norm(foam.field(folder / time / "U", self.cells), axis=1).max()

    def gorlin(self):
        return self.flow / (GORLIN * numpy.sqrt(self.total / MMHG))


def read_runs(folder):
    """Returns the complete cases of the folder. Reports cases that are not steady, and leaves them out."""
    runs = []
    for case in sorted((folder / "cases").iterdir()):
        if not (case / "complete").exists():
            continue
        try:
            runs.append(Run(case, folder / "meshes"))
        except Unsteady as reason:
            print(f"left out: {reason}")
    return runs


def chosen(runs):
    """Returns the runs with default options and R = 1e3, from the largest eps to the smallest."""
    return sorted((run for run in runs if run.usual and run.resistance == 1e3), key=lambda run: -run.eps)


def place(run, value):
    """Returns one entry of a row's field `grids` (rows.py)."""
    name = "walls" if run.fitted else f"ε {10 * run.eps:g} mm"
    return {"n": f"{name}, h {10 * run.size:g} mm", "h": round(run.size * 1e-2, 7), "eps": round(run.eps * 1e-2, 7),
            "rim": run.rim, "value": round(float(value), 4)}


def line(eps, area):
    """Fits a straight line to area(eps). Returns the line's value at 0 and its slope."""
    slope, at_zero = numpy.polyfit(eps, area, 1)
    return at_zero, slope
