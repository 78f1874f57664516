# SPDX-License-Identifier: Apache-2.0
"""Makes the rows of ./run validate. A row compares a computed value with a reference.

A row is one JSON object with the fields below. bench/validation/all.json also has rows, from solvers that take hours. Its key
"rows" has these rows, and "commit", "machine" and "command" say where they come from. validate.py merges them into the page.
  id            unique word, which the page's prose may use
  group         stokes, closed, jets, bodyfit, offset or clinical: the page's section
  quantity      text
  reference     number, or null for a row that only shows a trend
  source        text: where the reference comes from
  solver        text: the solver that computed the row
  grids         [{"n": text of the grid, "value": number}], coarse to fine, usually three
  order         number: the order of convergence, or null if the values do not converge with an order
  extrapolated  number: the limit by this order, or the value of the finest grid if order is null
  deviation     number: extrapolated / reference - 1, or null if reference is null
  bar           number: the largest deviation that passes, or null if every deviation passes
  note          text, may be empty
Rows of all.json also have "commit", the commit on which the row was measured. Steady rows of the group offset also have "valve",
"opening", "eps" in metres, "offset", and "drop", the total drop over that of walls minus 1."""

import math
import subprocess

import numpy as np

import exact
import jets
import marking
import octant
import stokes
from staggered import Flow

PLACES = ((0.0, 0.0), (0.5, 0.5))  # distances of the plate and of the rim from a face, in cells
ACROSS = (0.0, 0.25, 0.5, 0.75)
SIGN = {"hole": 1, "disc": -1}  # the sign of 1 - a_eff


def extrapolate(h, values, least=0.3, most=5.0):
    """Fits f + c h^p to the values of three grids, coarse to fine. Returns the order p and the limit f. If no p from `least` to
    `most` fits, returns None instead of the order, and the value of the finest grid."""
    a, b, c = values
    if not (a - b) * (b - c) > 0 or abs(b - c) < 1e-4 * abs(c):
        return None, c

    def ratio(p):
        return (h[0] ** p - h[1] ** p) / (h[1] ** p - h[2] ** p)

    wanted = (a - b) / (b - c)
    if not ratio(least) <= wanted <= ratio(most):
        return None, c
    low, high = least, most
    for _ in range(60):
        middle = (low + high) / 2
        low, high = (middle, high) if ratio(middle) < wanted else (low, middle)
    return low, c + (c - b) * h[2] ** low / (h[1] ** low - h[2] ** low)


def row(key, group, quantity, reference, source, solver, h, names, values, bar=None, note=""):
    order, limit = extrapolate(h, values)
    return {
        "id": key, "group": group, "quantity": quantity, "reference": reference, "source": source, "solver": solver,
        "grids": [{"n": n, "value": float(v)} for n, v in zip(names, values)], "order": order, "extrapolated": float(limit),
        "deviation": None if reference is None else float(limit / reference - 1), "bar": bar, "note": note,
    }  # fmt: skip


def missed(rows):
    """Returns the rows whose deviation is above their bar."""
    return [r for r in rows if r["bar"] is not None and not abs(r["deviation"]) <= r["bar"]]


# ------------------------------------------------------------------------------------------------------------------ Stokes


class Variant:
    """The sizes that a run computes. The half thickness is 1/n of the hole's radius or of the slit's half width, for each n
    listed. A grid is given by the number of cells in the half thickness."""

    def __init__(self, stokes_n, stokes_cells, jet_n, jet_cells, contraction_cells, shares, in_space):
        self.contraction_cells = contraction_cells
        self.stokes_n, self.stokes_cells, self.jet_n, self.jet_cells = stokes_n, stokes_cells, jet_n, jet_cells
        self.shares, self.in_space = shares, in_space


FULL = Variant((4, 8, 16), (2, 4, 8), 4, (2, 4, 8), (4, 8, 16), (0.1, 0.3, 0.5), ("hole", "disc"))
SHORT = Variant((4, 8, 16), (2, 3, 4), 4, (2, 4, 8), (2, 4, 8), (0.3,), ())
AXIAL = "staggered grid round the axis, sparse LU (bench/validation/staggered.py)"


def stokes_tasks(variant):
    """Returns the tasks whose results stokes_rows needs, as tuples (name, function, arguments)."""
    tasks = [(("stokes", kind, rim, n, cells, place), stokes.effective_radius, (kind, 1 / n, cells, rim, place))
             for kind in SIGN for rim in ("round", "cut") for n in variant.stokes_n for cells in variant.stokes_cells
             for place in PLACES]
    middle = variant.stokes_n[1]
    tasks += [(("solid", kind, rim, cells), stokes.solid_radius, (kind, 1 / middle, cells, rim))
              for kind in SIGN for rim in ("round", "cut") for cells in variant.stokes_cells]
    tasks += resistance_tasks(variant)
    for kind in variant.in_space:
        tasks.append((("space", kind), octant.effective_radius, (kind, 1 / 4, 2, "round")))
        tasks += [(("beside", kind, across), stokes.effective_radius, (kind, 1 / 4, 2, "round", (0.0, across)))
                  for across in ACROSS]
    return tasks


FACTORS = (1.0, 1e-2, 1e-4)  # R divided by the resistance of the examples


def resistance_tasks(variant):
    return [(("R", factor, cells), stokes.effective_radius,
             ("hole", 1 / variant.stokes_n[1], cells, "round", PLACES[0], False, factor * marking.R / marking.MU))
            for factor in FACTORS for cells in variant.stokes_cells]  # fmt: skip


def resistance_rows(variant, results):
    """Returns the rows that show the effect of R on a hole. The flow enters the band to the depth at which K equals mu over the
    squared depth, so the depth is proportional to (R/mu)^(-1/4). If R is small, blood also leaks through the plate."""
    n, rows, cells = variant.stokes_n[1], [], variant.stokes_cells
    for factor in FACTORS:
        ratio = factor * marking.R / marking.MU
        made = row(f"R_{factor:g}", "stokes", f"c of the hole, round rim, ε = a/{n}, R/μ = {ratio:.1e}", None,
                   "trend: depth of the flow in the band about 0.8 ε (R/μ)^(−1/4), and the leak Δp ε/R of the plate", AXIAL,
                   [1 / c for c in cells], [f"ε/h {c}" for c in cells],
                   [(1 - results["R", factor, c][0]) * n for c in cells])  # fmt: skip
        made["R_over_mu"] = ratio
        rows.append(made)
    return rows


def stokes_rows(variant, results):
    rows, cells, limits = [], variant.stokes_cells, {}
    what = {"hole": "hole in a plate, a_eff / a by Q = a_eff³ Δp / (3 μ)",
            "disc": "disc broadside, a_eff / a by F = 16 μ a_eff U"}  # fmt: skip
    source = {"hole": "Sampson 1891, derived in bench/validation/exact.py",
              "disc": "closed form derived in bench/validation/exact.py"}  # fmt: skip
    for kind, sign in SIGN.items():
        for rim in ("round", "cut"):
            radii = []
            for n in variant.stokes_n:
                both = [[results["stokes", kind, rim, n, c, place][0] for place in PLACES] for c in cells]
                # The reference has eps = 0, so the deviation here is the effect of the half thickness.
                made = row(f"stokes_{kind}_{rim}_{n}", "stokes", f"{what[kind]}; {rim} rim, ε = a/{n}", 1.0, source[kind], AXIAL,
                           [1 / c for c in cells], [f"ε/h {c}" for c in cells], [np.mean(b) for b in both])  # fmt: skip
                spread = abs(both[-1][0] - both[-1][1]) * n / 2
                made["c"], made["c_spread"] = sign * (1 - made["extrapolated"]) * n, spread
                made["note"] = f"c = {made['c']:.2f}, ± {spread:.2f} for other places of the rim between faces"
                radii.append(made)
            rows += radii
            eps = [1 / n for n in variant.stokes_n]
            limits[kind, rim] = [r["c"] for r in radii]
            rows.append(row(f"stokes_{kind}_{rim}", "stokes", f"the same for ε → 0; {rim} rim", 1.0, source[kind], AXIAL, eps,
                            [f"ε = a/{n}" for n in variant.stokes_n], [r["extrapolated"] for r in radii], 0.02))  # fmt: skip
    n = variant.stokes_n[1]
    for kind, sign in SIGN.items():
        for rim in ("round", "cut"):
            solid = row("", "", "", None, "", "", [1 / c for c in cells], [""] * 3,
                        [sign * (1 - results["solid", kind, rim, c][0]) * n for c in cells])["extrapolated"]
            values = [sign * (1 - np.mean([results["stokes", kind, rim, n, c, place][0] for place in PLACES])) * n for c in cells]
            shape = "half a tube at its edge" if rim == "round" else "a square edge"
            rows.append(row(f"c_{kind}_{rim}", "stokes", f"c of a_eff = a {'−' if sign > 0 else '+'} c ε, {kind}, {rim} rim, "
                            f"ε = a/{n}", solid, f"solid plate of thickness 2 ε with {shape}, same solver, no slip", AXIAL,
                            [1 / c for c in cells], [f"ε/h {c}" for c in cells], values, 0.15))  # fmt: skip
    rows += resistance_rows(variant, results)
    for kind in variant.in_space:
        beside = np.mean([results["beside", kind, across][0] for across in ACROSS])
        value = results["space", kind][0]
        rows.append({
            "id": f"space_{kind}", "group": "stokes", "quantity": f"{what[kind]}; round rim, ε = a/4, ε/h 2, in space",
            "reference": float(beside), "source": "the same grid size round the axis, mean over four positions of the rim",
            "solver": "staggered grid in an eighth of a box, Schur complement (bench/validation/octant.py)",
            "grids": [{"n": f"{results['space', kind][1]} cells", "value": float(value)}], "order": None,
            "extrapolated": float(value), "deviation": float(value / beside - 1), "bar": 0.05,
            "note": "one grid; it only shows that the rows round the axis also hold in space",
        })  # fmt: skip
    return rows


# ------------------------------------------------------------------------------------------------------------------ closed


def closed_plane(library, cells, rim="round"):
    """Returns the drop of a plate across a plane channel, divided by (R/eps) u. The drop is computed for four places of the plate
    between two faces of the grid. `cells` is the number of cells in eps."""
    h, u, ratios = 1e-3, 0.1, []
    eps = cells * h
    for place in (0.1, 0.35, 0.6, 0.85):
        flow = Flow(h * (np.arange(25) - 12 - place), h * np.arange(5), walls="channel")
        points = np.vstack([flow.u_points(), flow.v_points()])
        surface = marking.plate_with_slit(-0.1, 0.1)
        K = library.K((surface[0][:4], surface[1][:2]), eps, rim, np.column_stack([points, np.zeros(len(points))]))
        q = np.concatenate([np.full(flow.n_u, u), np.zeros(flow.n_v)])
        p = flow.solve(marking.RHO, [np.full((flow.nx, flow.ny), marking.MU)], K, q)[2]
        ratios.append((p[0].mean() - p[-1].mean()) / (marking.R / eps * u))
    return ratios


def closed_rows(library, flow_program=None, short=False):
    """Returns the rows of flat plates. If flow_program, the program of closed.f90, is given, also returns the rows of the solver
    of examples/flow_fortran."""
    cells = (1, 2, 3)
    law = "integral of K over the band"
    rows = [row("closed_plane", "closed", "drop of a plate across a channel over (R/ε) u", 1.0, law,
                "staggered grid in the plane, sparse LU (bench/validation/staggered.py)", [1 / c for c in cells],
                [f"ε/h {c}" for c in cells], [np.mean(closed_plane(library, c)) for c in cells], 0.01)]  # fmt: skip
    if not flow_program:
        return rows
    run = subprocess.run([flow_program] + ["short"] * short, capture_output=True, text=True, check=False)
    if run.returncode:
        raise SystemExit(f"{flow_program} fails: {run.stdout}{run.stderr}")
    found = {}
    for line in run.stdout.splitlines():
        name, n, value = line.split()
        found.setdefault(name, []).append((float(n), float(value)))
    solver = "examples/flow_fortran"

    def of(name, key, quantity, reference, source, text, bar, note=""):
        n, values = zip(*found[name])
        names = [text.format(x) for x in n]
        rows.append(row(key, "closed", quantity, reference, source, solver, [1 / x for x in n], names, values, bar, note))

    spread = max(value for _, value in found["spread"])
    of("drop", "closed_drop", "drop of a plate across a duct in the step in which it closes, over (R/ε) u", 1.0, law,
       "ε/h {:.0f}", 0.01, f"ten places between two faces differ by {spread:.0e} at most")  # fmt: skip
    of("moving", "moving_plate", "volume that a moving plate takes through a duct, over area times stroke (mean of both ends)",
       1.0, "no flow through the plate", "{:.0f} cells across", 0.01)  # fmt: skip
    of("leak", "closed_leak", "leak of the closed aortic valve at 80 mmHg, ε = 1.5 h, over Δp ε/R times the area of its leaflets",
       1.0, "(R/ε) u on each leaflet by itself", "{:.0f} cells across", None,
       "less than 1, because two cusps that touch have one band; tends to 1 as ε tends to 0")  # fmt: skip
    return rows


# -------------------------------------------------------------------------------------------------------------------- jets

PLANE = "staggered grid in the plane, Newton's method, sparse LU (bench/validation/staggered.py)"
SPEEDS = (0.5, 1.0, 2.0)


def jet_tasks(variant):
    n, tasks = variant.jet_n, []
    for share in variant.shares:
        some = sorted(set(variant.contraction_cells + (variant.jet_cells if share == 0.3 else ())))
        tasks += [(("jet", "cut", share, n, c, 1.0), jets.jet, (share, jets.B / n, c, "cut")) for c in some]
    tasks += [(("jet", "round", 0.3, n, c, 1.0), jets.jet, (0.3, jets.B / n, c, "round")) for c in variant.jet_cells]
    if variant.in_space:  # the full variant
        tasks += [(("jet", rim, 0.3, 2 * n, c / 2, 1.0), jets.jet, (0.3, jets.B / n / 2, c / 2, rim))
                  for c in variant.jet_cells for rim in ("round", "cut")]
    tasks += [(("jet", "cut", 0.3, n, c, s), jets.jet, (0.3, jets.B / n, c, "cut", 0.0, s))
              for c in variant.jet_cells for s in SPEEDS if s != 1.0]  # fmt: skip
    return tasks


def slope_row(rim, n, thick, thin):
    """Returns the row with c of a slit. c is the difference between the effective half widths for eps and for eps/2, divided by
    eps/2. Both half widths are computed on the same cells, so the grid's errors cancel."""
    if [g["n"] for g in thick["grids"]] != [g["n"] for g in thin["grids"]]:
        raise ValueError(f"the rows {thick['id']} and {thin['id']} are not on the same grids")
    values = [(b["value"] - a["value"]) * 2 * n for a, b in zip(thick["grids"], thin["grids"])]
    names = [g["n"] for g in thick["grids"]]
    what = f"c of b_eff = b − c ε, {rim} rim, between ε = b/{n} and ε = b/{2 * n}"
    return row(f"c_slit_{rim}", "jets", what, None, "trend", PLANE, [1 / float(name.split()[-1]) for name in names],
               names, values, note="the same cells for both ε")  # fmt: skip


def jet_rows(variant, results):
    rows, n, cells, fine = [], variant.jet_n, variant.jet_cells, variant.contraction_cells
    h, names = [1 / (n * c) for c in cells], [f"b/h {n * c}" for c in cells]
    for share in variant.shares:
        C = exact.contraction(share)
        reference, source = C, f"von Mises 1917, slit {share} of the channel, by 1/C = 1 + (2/π)(1/k − k) arctan k, k = C {share}"
        if share == 0.1:
            reference, source = exact.contraction(0), f"π/(π + 2), Kirchhoff; a slit of 0.1 of the channel has {C:.4f}"
        rows.append(row(f"jet_{share}", "jets", f"contraction of a plane jet, slit {share} of the channel, cut rim, ε = b/{n}",
                        reference, source, PLANE, [1 / c for c in fine], [f"b/h {n * c}" for c in fine],
                        [results["jet", "cut", share, n, c, 1.0]["by_core"] for c in fine], 0.05))  # fmt: skip
    C = exact.contraction(0.3)
    for m, some in ((n, cells), (2 * n, tuple(c / 2 for c in cells))):
        for rim in ("round", "cut"):
            if ("jet", rim, 0.3, m, some[0], 1.0) not in results:
                continue
            h_m = [1 / (m * c) for c in some]
            made = row(f"slit_{rim}_{m}", "jets", f"effective half width of a slit, b_eff / b by Δp and C, {rim} rim, ε = b/{m}",
                       1.0, "contraction of the infinitely thin plate", PLANE, h_m, [f"b/h {m * c:g}" for c in some],
                       [results["jet", rim, 0.3, m, c, 1.0]["by_drop"] / C for c in some])  # fmt: skip
            made["note"] = "this value contains the error of the grid; c below does not"
            rows.append(made)
    for rim in ("round", "cut"):
        pair = [r for r in rows if r["id"] in (f"slit_{rim}_{n}", f"slit_{rim}_{2 * n}")]
        if len(pair) == 2:
            rows.append(slope_row(rim, n, *pair))

    def of(key, quantity, source, values, bar):
        rows.append(row(key, "jets", quantity, 1.0, source, PLANE, h, names, values, bar))

    some = [results["jet", "cut", 0.3, n, c, 1.0] for c in cells]
    loss = [r["drop"] / (marking.RHO / 2 * (r["core"] - r["inlet"]) ** 2) for r in some]
    rise = [(r["vena_drop"] - r["drop"]) / (marking.RHO * r["inlet"] * (r["core"] - r["inlet"])) for r in some]
    of("borda_carnot", "loss behind a slit of 0.3 of the channel over (ρ/2)(U_jet − U)²",
       "Borda-Carnot, with the jet's own speed", loss, 0.05)  # fmt: skip
    of("recovery", "rise of the pressure downstream of the jet over ρ U (U_jet − U)",
       "balance of momentum, with the jet's own speed", rise, 0.05)  # fmt: skip
    exponents = []
    for c in cells:
        drops = [results["jet", "cut", 0.3, n, c, s]["drop"] for s in SPEEDS]
        exponents.append(math.log(drops[-1] / drops[0]) / math.log(SPEEDS[-1] / SPEEDS[0]))
    rows.append(row("drop_exponent", "jets", "exponent of Q in the drop, from half to twice the flow", 2.0, "drop ∝ Q²", PLANE,
                    h, names, exponents, 0.05, "the viscosity is fixed, so a faster jet contracts more"))  # fmt: skip
    return rows


def picture(result):
    """Returns the fields near the slit that the plot of a jet shows: the speed, and the stream function divided by the flow."""
    x, y = result["x"], result["y"]
    near = np.abs(x - jets.B) < 3 * jets.B
    low = y < 3 * jets.B
    edges = np.concatenate([[0], (y[1:] + y[:-1]) / 2, [2 * y[-1] - (y[-1] + y[-2]) / 2]])
    stream = np.cumsum(result["u"] * np.diff(edges), axis=1) / (jets.SPEED * jets.B)
    return {"x": x[near].tolist(), "y": y[low].tolist(), "eps": result["eps"],
            "speed": np.round(result["speed"][near][:, low], 4).tolist(), "stream": np.round(stream[near][:, low], 4).tolist()}
