# SPDX-License-Identifier: Apache-2.0
"""Makes the tables, rows and pictures of body_fitted.sh. The results compare the effective areas of open leaflets in two forms:
as walls without thickness, and as obstacles of riis. body_fitted.py FOLDER [--quick] reads the cases in FOLDER and prints the
tables. The script writes body_fitted.json and pictures into FOLDER. Rows of all.json without cases are kept, but not with
--quick."""
import json
import pathlib
import re
import subprocess
import sys

import numpy
from beside import beside, beside_words, profiles
from cases import COPIES, INLET, MMHG, RADIUS, RHO, ROOT, SOLVER, WALLS, chosen, foam, line, place, read_runs

ALL = ROOT / "bench/validation/all.json"
BAR = 0.1  # bar of the row for the smallest eps
LINE_BAR = 0.02  # bar of the row for the line through all eps


def outline(valve, opening, n=200001):
    """Returns two numbers, seen along the flow: the area in cm2 that the leaflets leave open, and the length in cm of their
    outlines inside the tube."""
    radius = RADIUS[valve]
    if valve == "bileaflet":  # docs/theory/bileaflet.md
        hinge, closed, now = 0.22, numpy.radians(30), numpy.radians(30 + 55 * opening)
        q = numpy.cos(now) / numpy.cos(closed)
        edge = hinge * (1 - q)
        top = numpy.sqrt(radius ** 2 - edge ** 2)
        y = numpy.linspace(0, top, n)
        arc = numpy.minimum(edge + q * numpy.sqrt(radius ** 2 - y ** 2), numpy.sqrt(radius ** 2 - y ** 2))
        angle = numpy.linspace(0, numpy.pi / 2, n)
        x, y_arc = edge + q * radius * numpy.cos(angle), radius * numpy.sin(angle)
        covered = numpy.trapz(arc - edge, y)
        length = top + _length_inside(x, y_arc, radius)
    else:  # docs/theory/trileaflet.md: x of the free edge is linear (closed) or quadratic (open) in y, and the cusp covers only
        # the part outside the edge
        u, expanded = numpy.linspace(0, 1, n), 1 + 0.1 * opening
        y = expanded * 1.25 * numpy.sin(numpy.pi / 3) * u
        x = (1 - opening) * 0.625 * u + opening * (1.0 + (1.1 * 0.625 - 1.0) * u ** 2)
        inside = x ** 2 + y ** 2 < radius ** 2
        angle, distance = numpy.arctan2(y, x), numpy.hypot(x, y)
        covered = numpy.trapz(numpy.where(inside, radius ** 2 - distance ** 2, 0) / 2, angle)
        length = _length_inside(x, y, radius)
    copies = COPIES[valve]
    return numpy.pi * radius ** 2 - copies * covered, copies * length


def _length_inside(x, y, radius):
    middle = numpy.hypot((x[1:] + x[:-1]) / 2, (y[1:] + y[:-1]) / 2) < radius
    return float((numpy.hypot(numpy.diff(x), numpy.diff(y)) * middle).sum())


def order_of(sizes, values):
    """Returns order and limit by Richardson's extrapolation, from three grids with a constant ratio of sizes. If the values have
    no order, returns None and the value of the finest grid."""
    if len(values) < 3:
        return None, values[-1]
    (a, b, c), ratio = values[-3:], sizes[-2] / sizes[-1]
    share = (a - b) / (b - c) if b != c else 0
    if share <= 1:
        return None, c
    order = numpy.log(share) / numpy.log(ratio)
    return float(order), float(c + (c - b) / (ratio ** order - 1))


def far_from(points, triangles):
    """Returns the largest distance from a point to the triangles. There are few points, so each point is compared with each
    triangle."""
    a, b, c = (triangles[:, k] for k in range(3))
    largest = 0.0
    for point in points:
        least = numpy.inf
        for p, q in ((a, b), (b, c), (c, a)):  # edges
            t = numpy.clip(((point - p) * (q - p)).sum(1) / ((q - p) ** 2).sum(1), 0, 1)[:, None]
            least = min(least, (((p + t * (q - p)) - point) ** 2).sum(1).min())
        normal = numpy.cross(b - a, c - a)
        square = (normal ** 2).sum(1)
        # v and w are barycentric coordinates of the perpendicular's foot.
        v = (numpy.cross(point - a, c - a) * normal).sum(1) / square
        w = (numpy.cross(b - a, point - a) * normal).sum(1) / square
        foot = (v >= 0) & (w >= 0) & (v + w <= 1)
        height = (((point - a) * normal).sum(1) ** 2 / square)[foot]
        least = min(least, height.min(initial=numpy.inf))
        largest = max(largest, least)
    return float(numpy.sqrt(largest))


def msh_leaflet(path):
    """Returns the triangles of the surface "leaflet" in a mesh file of gmsh, format 2.2."""
    lines = foam.text(path).splitlines()

    def section(name):
        at = lines.index(name)
        return [one.split() for one in lines[at + 2:at + 2 + int(lines[at + 1])]]
    number = next(int(words[1]) for words in section("$PhysicalNames") if words[2] == '"leaflet"')
    place = {int(words[0]): [float(x) for x in words[1:4]] for words in section("$Nodes")}
    elements = section("$Elements")
    corners = [[int(x) for x in words[-3:]] for words in elements if words[1] == "2" and int(words[3]) == number]
    return numpy.array([[place[k] for k in triangle] for triangle in corners])


def same_leaflets(folder):
    """Prints the distance between the fitted leaflets and the leaflets of the library."""
    for case in sorted(path.parent for path in folder.glob("leaflets-*/complete")):
        points, corners, _ = foam.triangles(case / "leaflets.vtk")
        fitted = msh_leaflet(case / "fitted.msh")
        vertices = numpy.unique(fitted.reshape(-1, 3), axis=0)
        print(f"  {case.name[9:]:<16} {len(vertices)} points of the fitted leaflet are at most"
              f" {1e3 * far_from(vertices, points[corners]):.4f} mm from the library's {len(corners)} triangles")


def picture(runs, path):
    """Draws the speed in planes along the valve and across it, for some cases."""
    import matplotlib
    matplotlib.use("Agg")
    import matplotlib.pyplot as plt
    figure, axes = plt.subplots(2, len(runs), figsize=(4.4 * len(runs), 6.5), squeeze=False, height_ratios=(1, 2),
                                layout="constrained")
    for column, run in enumerate(runs):
        slices = sorted((run.folder / "postProcessing/slices").iterdir(), key=lambda p: float(p.name))[-1]
        for axis, name, across, up in ((axes[0][column], "along", 2, 0), (axes[1][column], "across", 0, 1)):
            points, corners, velocity = foam.triangles(slices / f"{name}.vtk")
            speed = numpy.linalg.norm(velocity, axis=1)
            drawn = axis.tripcolor(1e3 * points[:, across], 1e3 * points[:, up], corners, speed, shading="gouraud",
                                   cmap="viridis", vmin=0, vmax=max(one.jet for one in runs))
            axis.set_aspect("equal")
            axis.set_xlabel(f"{'xyz'[across]}, mm")
            axis.set_ylabel(f"{'xyz'[up]}, mm")
        words = f"walls, edges {10 * run.size:g} mm" if run.fitted else f"riis, eps {10 * run.eps:g} mm, rim {run.rim}"
        axes[0][column].set_title(f"{words}\n{run.area:.3f} cm²", fontsize=10)
    figure.colorbar(drawn, ax=axes, label="speed, m/s", shrink=0.6)
    figure.savefig(path, dpi=70)
    plt.close(figure)


def machine():
    models = re.findall(r"^model name\s*: (.*)$", foam.text("/proc/cpuinfo"), re.MULTILINE)
    return f"{models[0]}, {len(models)} processors" if models else "unknown"


def commit():
    command = ["git", "-C", str(ROOT), "describe", "--always", "--dirty"]
    found = subprocess.run(command, capture_output=True, text=True, check=False)
    return found.stdout.strip() or "unknown"


def solid_row(what, three, solids):
    """Returns a row that compares the effective areas of `three` with the areas of solid leaflets. The solid leaflets are as
    thick as the band. `solids` has the area of solid leaflets in cm2 for each eps. With fewer than two areas, returns no row."""
    if len(three) < 2:
        return []
    share = [one.area / solids[one.eps] for one in three]
    areas = ", ".join(f"{solids[one.eps]:.3f} at {10 * one.eps:g} mm" for one in three)
    return [{"id": f"bodyfit_{what.replace(' valve, opening ', '_').replace(', rim ', '_')}_solid", "group": "bodyfit",
             "quantity": f"{what}: effective area over that of solid leaflets as thick as the band, at the least ε",
             "reference": 1, "source": "the same leaflets as solid bodies of the thickness 2 ε with square edges, body-fitted",
             "solver": SOLVER, "grids": [place(one, one_share) for one, one_share in zip(three, share)], "order": None,
             "extrapolated": round(float(share[-1]), 4), "deviation": round(float(share[-1] - 1), 4), "bar": BAR,
             "note": f"areas with solid leaflets, cm²: {areas}"}]


def compare(valve, opening, runs, solids, folder):
    """Prints the tables of one valve at one opening. Returns their rows."""
    mine = [run for run in runs if (run.valve, run.opening) == (valve, opening)]
    fitted = sorted((run for run in mine if run.fitted and run.far == 0.13), key=lambda run: -run.size)
    obstacles = [run for run in mine if not run.fitted]
    geometric, perimeter = outline(valve, opening)
    print(f"\nThe {valve} valve, opening {opening:g}: {fitted[0].flow:.1f} ml/s, geometric orifice {geometric:.3f} cm2,"
          f" outlines {perimeter:.2f} cm")
    print("  walls of no thickness")
    print("  edges, mm    cells  steps  drop, Pa  total, Pa  area, cm2")
    for run in fitted:
        print(f"  {10 * run.size:>9g} {run.cells:>8,} {run.steps:>6} {run.drop:>9.2f} {run.total:>10.2f} {run.area:>10.4f}")
    order, body = order_of([run.size for run in fitted], [run.area for run in fitted])
    print(f"  order {'none' if order is None else f'{order:.2f}'}, {body:.4f} cm2 are the reference")
    for run in mine:
        if run.fitted and run.far != 0.13:
            same = next(one for one in fitted if one.size == run.size)
            print(f"  edges of at most {10 * run.far:g} mm elsewhere instead of 1.3 mm, {run.cells:,} cells: {run.area:.4f} cm2,"
                  f" {100 * (run.area / same.area - 1):+.2f} %")

    def c_of(run):
        return (body - run.area) / (run.eps * perimeter)
    for eps, area in sorted(solids.items(), reverse=True):
        print(f"  solid leaflets, {20 * eps:g} mm thick, with square edges: {area:.4f} cm2,"
              f" {100 * (area / body - 1):+.2f} % off walls")
    print("  riis, R in kg/(m s)")
    print("  eps, mm  edges, mm    cells  steps  rim       R  drop, Pa  area, cm2  off walls      c")
    for run in sorted(obstacles, key=lambda one: (-one.eps, -one.size, one.rim, one.resistance)):
        print(f"  {10 * run.eps:>7g} {10 * run.size:>10g} {run.cells:>8,} {run.steps:>6}  {run.rim:<5} {run.resistance:>5g}"
              f" {run.drop:>9.2f} {run.area:>10.4f} {100 * (run.area / body - 1):>+8.2f} %  {c_of(run):>5.3f}")
    rows = []
    for rim in ("round", "cut"):
        # Runs with other edges or other resistances exist only for the largest half thickness.
        first = [one for one in obstacles if one.rim == rim and one.eps == max(other.eps for other in obstacles)]
        others = ""
        for words, some in (("edges", [one for one in first if one.resistance == 1e3]),
                            ("R", [one for one in first if abs(one.eps / one.size - 2) < 1e-6])):
            values = [(10 * one.size if words == "edges" else one.resistance, c_of(one)) for one in some]
            if len(values) > 1:
                others += f"; {words} {min(values)[0]:g} to {max(values)[0]:g}{' mm' if words == 'edges' else ''} at ε" \
                          f" {10 * first[0].eps:g} mm: {min(c for _, c in values):.2f} to {max(c for _, c in values):.2f}"
        three = [one for one in chosen(obstacles) if one.rim == rim]
        if len(three) < 2:
            continue
        eps, area = numpy.array([one.eps for one in three]), numpy.array([one.area for one in three])
        at_zero, slope = line(eps, area)
        c_line, c_each = -slope / perimeter, (body - area) / (eps * perimeter)
        in_eps = numpy.polyfit(numpy.log(eps), numpy.log(numpy.abs(body - area)), 1)[0]
        print(f"  rim {rim}: a straight line gives {at_zero:.4f} cm2 at eps 0, {100 * (at_zero / body - 1):+.2f} % off the walls;"
              f" order in eps {in_eps:.2f}")
        print(f"    area = area of walls - c eps P, P = {perimeter:.3f} cm: c = {c_line:.3f} of the line; from each eps"
              f" {', '.join(f'{c:.3f}' for c in c_each)}; over the discharge coefficient {body / geometric:.3f}:"
              f" {c_line * geometric / body:.3f}")
        share = ", ".join(f"{100 * (one.area / body - 1):+.1f} % at {10 * one.eps:g} mm" for one in three)
        slit = ""
        if valve == "bileaflet":
            angles = numpy.radians(30), numpy.radians(30 + 55 * opening)
            slit = f". The slit between the leaflets is {4.4 * (1 - numpy.cos(angles[1]) / numpy.cos(angles[0])):.2f} mm wide"
        what = f"{valve} valve, opening {opening:g}, rim {rim}"
        common = {"group": "bodyfit", "reference": round(float(body), 4),
                  "source": WALLS, "solver": SOLVER,
                  "grids": [place(one, one.area) for one in three], "order": round(float(in_eps), 2),
                  "extrapolated": round(float(at_zero), 4)}
        rows.append({"id": f"bodyfit_{valve}_{opening:g}_{rim}_finest",
                     "quantity": f"{what}: effective area at the least ε, cm²", **common,
                     "deviation": round(float(three[-1].area / body - 1), 4),
                     "bar": BAR if opening == 1 and three[-1].eps <= 0.05 else None,
                     "note": f"{share}{slit}"})
        rows.append({"id": f"bodyfit_{valve}_{opening:g}_{rim}_line",
                     "quantity": f"{what}: effective area on a line through all ε, at ε = 0, cm²", **common,
                     "deviation": round(float(at_zero / body - 1), 4), "bar": LINE_BAR if opening == 1 else None,
                     "note": f"A − c ε P with P = {perimeter:.2f} cm: c is {c_line:.2f} on the line and {min(c_each):.2f} to"
                             f" {max(c_each):.2f} at single ε; divided by the discharge coefficient"
                             f" {c_line * geometric / body:.2f}{others}"})
        rows += solid_row(what, [one for one in three if one.eps in solids], solids)
    shown = [one for one in chosen(obstacles) if one.rim == "round"]
    picture([fitted[-1], shown[0], shown[-1]], folder / f"{valve}-{opening:g}.png")
    return rows


def clinical(runs):
    """Prints the orifice areas by clinical formulas beside the geometric area, from the finest runs. Returns the rows of these
    areas."""
    print("\nOrifice areas in cm2: geometric, effective, by Gorlin's formula, by continuity (flow over the largest speed).")
    print("  valve        opening  leaflets                geometric  effective  discharge  Gorlin  continuity  total, mmHg")
    rows = []
    for valve, opening in sorted({(run.valve, run.opening) for run in runs}):
        mine = [run for run in runs if (run.valve, run.opening) == (valve, opening)]
        geometric, _ = outline(valve, opening)
        walls = min((run for run in mine if run.fitted and run.far == 0.13), key=lambda run: run.size)
        shown = [walls] + [run for run in chosen(mine) if run.rim == "round"]
        for run in shown:
            name = "walls" if run.fitted else f"riis, eps {10 * run.eps:g} mm, round"
            print(f"  {valve:<12} {opening:>7g}  {name:<22} {geometric:>10.3f} {run.area:>10.3f} {run.area / geometric:>10.3f}"
                  f" {run.gorlin():>7.3f} {run.flow / run.jet * 1e-2:>11.3f} {run.total / MMHG:>12.3f}")
        eps, area = [run.eps for run in shown[1:]], [run.area for run in shown[1:]]
        at_zero = line(eps, area)[0] if len(eps) > 1 else walls.area
        rows.append({
            "id": f"clinical_discharge_{valve}_{opening:g}", "group": "clinical",
            "quantity": f"{valve} valve, opening {opening:g}: effective over geometric area", "reference": None,
            "source": "a trend only: 0.675 to 0.93 for 23 orifices of 0.3 to 2.5 cm² (F. A. Flachskampf et al., J Am Coll Cardiol"
                      " 15, 1990, 1173-1180, abstract)", "solver": SOLVER,
            "grids": [place(run, run.area / geometric) for run in shown], "order": None,
            "extrapolated": round(float(at_zero / geometric), 4), "deviation": None, "bar": None,
            "note": f"areas with walls, cm²: geometric {geometric:.2f}, effective {walls.area:.2f}, Gorlin {walls.gorlin():.2f},"
                    f" continuity {walls.flow / walls.jet * 1e-2:.2f}; ten times blood's viscosity"})
        if (valve, opening) == ("bileaflet", 1.0):
            rows.append({
                "id": "clinical_area_bileaflet_1", "group": "clinical",
                "quantity": "bileaflet valve of size 25, open: effective area, cm²", "reference": 2.5,
                "source": "a trend only, another design: 2.5 ± 0.8 early, 2.8 ± 0.8 after a year (On-X, instructions for use,"
                          " table of aortic results, 25 mm, 33 and 25 patients)", "solver": SOLVER,
                "grids": [place(run, run.area) for run in shown], "order": None, "extrapolated": round(float(at_zero), 4),
                "deviation": round(float(at_zero / 2.5 - 1), 4), "bar": None,
                "note": f"{walls.flow:.0f} ml/s and ten times blood's viscosity: the total pressure drops by"
                        f" {walls.total / MMHG:.1f} mmHg. Patients have mean gradients of 7.5 ± 3.8 and 3.7 ± 2.2 mmHg, at flows"
                        " that the table does not give. Medtronic Advantage, size 27: 7 (2) mmHg and 3.2 (0.66) cm²"
                        " (R. Haaverstad et al., Heart 93, 2007, 500-505, abstract)"})
    return rows


def blood(folder, runs):
    """Prints means in time of the runs with blood's viscosity. The runs with blood's viscosity start from the steady flows.
    Returns the rows of the runs."""
    begin = 0.04  # s
    found = []
    for case in sorted((folder / "blood").glob("*")):
        if not (case / "complete").exists():
            continue
        steady = next(run for run in runs if run.name == case.name)
        table = foam.table(case, "inlet")
        if not found:
            print(f"\nBlood's viscosity, means over {begin:g} to {table[-1, 0]:g} s, within the planes of symmetry. The last"
                  " column has ten times the viscosity.")
            print("  case                                      steps  drop, Pa  least  largest  area, cm2  steady")
        time, drop = table[table[:, 0] >= begin].T
        mean = RHO * numpy.trapz(drop, time) / (time[-1] - time[0])
        area = steady.flow / numpy.sqrt(2 * mean / RHO + INLET ** 2) * 1e-2
        print(f"  {case.name:<40} {len(table):>6} {mean:>9.1f} {RHO * drop.min():>6.0f} {RHO * drop.max():>8.0f} {area:>10.3f}"
              f" {steady.area:>10.3f}")
        found.append((steady, area))
    rows = []
    for valve, opening in dict.fromkeys((run.valve, run.opening) for run, _ in found):
        mine = [(run, area) for run, area in found if (run.valve, run.opening) == (valve, opening)]
        walls = next((area for run, area in mine if run.fitted), None)
        if walls is None:
            continue
        rows += blood_line([one for one in mine if one[0].offset is None], walls)
        rows += [blood_beside(run, area, walls, mine) for run, area in mine if run.offset is not None]
    return rows


BLOOD = {"source": WALLS,
         "solver": SOLVER.replace("simpleFoam", "pimpleFoam"), "order": None, "bar": None}


def blood_line(found, walls):
    """Returns the row for the line through the areas of `found`, with blood's viscosity. There must be at least two half
    thicknesses."""
    others = [(run, area) for run, area in found if not run.fitted]
    if len(others) < 2:
        return []
    at_zero = line([run.eps for run, _ in others], [area for _, area in others])[0]
    print(f"  a straight line gives {at_zero:.3f} cm2 at eps 0, {100 * (at_zero / walls - 1):+.2f} % of the walls")
    return [{
        "id": "bodyfit_blood", "group": "bodyfit",
        "quantity": "bileaflet valve, open, rim round, blood's viscosity: effective area, mean in time, at ε = 0, cm²",
        **BLOOD, "reference": round(float(walls), 4),
        "grids": [place(run, area) for run, area in sorted(found, key=lambda one: -one[0].eps)],
        "extrapolated": round(float(at_zero), 4), "deviation": round(float(at_zero / walls - 1), 4),
        "note": "means over 0.06 s in a quarter of the valve; fluctuations across its planes of symmetry are missing"}]


def blood_beside(run, area, walls, found):
    """Returns the row of a band with an offset, with blood's viscosity."""
    fitted = [place(one, its_area) for one, its_area in found if one.fitted]
    return {
        "id": f"offset_blood_{run.valve}_{run.opening:g}_{10 * run.eps:g}_{run.offset:g}", "group": "offset",
        "quantity": f"{beside_words(run)}, blood's viscosity: effective area, mean in time, cm²", **BLOOD,
        "reference": round(float(walls), 4), "grids": [*fitted, place(run, area)], "extrapolated": round(float(area), 4),
        "deviation": round(float(area / walls - 1), 4),
        "note": "means over 0.06 s in a sixth of the valve; fluctuations across its planes of symmetry are missing"}


def merged(rows, kept, now):
    """Returns the rows with the commits on which they were measured. The order of the rows is that of `kept`, then that of
    `rows`. A row that equals the kept row keeps its commit."""
    new = {row["id"]: {**row, "commit": now} for row in rows}
    for key, row in kept.items():
        if {**new.get(key, {}), "commit": row["commit"]} == row:
            del new[key]
    return [new.pop(key, row) for key, row in kept.items()] + list(new.values())


def main(folder, quick):
    folder = pathlib.Path(folder)
    runs, kept, about = read_runs(folder), {}, {"commit": commit(), "machine": machine()}
    if not quick:
        old = json.loads(ALL.read_text(encoding="utf-8"))
        kept = {row["id"]: {**row, "commit": row.get("commit", old["commit"])} for row in old["rows"]}
        about = {name: old[name] for name in about}
    if not runs and not kept:
        raise SystemExit(f"{folder} has no complete case")
    all_solids = [run for run in runs if run.solid]
    runs = [run for run in runs if not run.solid]
    if runs:
        print(f"The largest change of the drop over the last 20 steps is {max(run.settled for run in runs):.1e} of it."
              f" {len(runs)} cases took {sum(run.seconds for run in runs) / 60:.1f} minutes of processor time.")
    same_leaflets(folder)
    rows, plain = [], []
    for valve, opening in sorted({(run.valve, run.opening) for run in runs}, key=lambda pair: (pair[0], -pair[1])):
        mine = [run for run in runs if (run.valve, run.opening) == (valve, opening)]
        if any(run.offset is None and not run.fitted for run in mine) and any(run.fitted for run in mine):
            solids = {run.eps: run.area for run in all_solids if (run.valve, run.opening) == (valve, opening)}
            some = [run for run in mine if run.offset is None]
            rows += compare(valve, opening, some, solids, folder)
            plain += some
        rows += beside(valve, opening, mine, kept)
    rows += blood(folder, runs) + (clinical(plain) if plain else [])
    profiles(runs, folder / "profiles.png")
    text = {**about, "command": "bench/validation/body_fitted.sh FOLDER", "rows": merged(rows, kept, commit())}
    (folder / "body_fitted.json").write_text(json.dumps(text, indent=1, ensure_ascii=False) + "\n", encoding="utf-8")


if __name__ == "__main__":
    if len(sys.argv) not in (2, 3) or sys.argv[2:] not in ([], ["--quick"]):
        raise SystemExit("usage: body_fitted.py FOLDER [--quick]")
    main(sys.argv[1], len(sys.argv) == 3)
