# SPDX-License-Identifier: Apache-2.0
"""Makes the tables, rows and picture of bands with an offset (docs/theory/marks.md, "Offset"), from the cases of
body_fitted.sh."""
import numpy
from cases import RADIUS, SOLVER, WALLS, foam, place

# Bars for the rows of the trileaflet valve with the offset 0.75, by opening and half thickness in millimetres.
BARS = {(1.0, 1.0): 0.015, (1.0, 0.5): 0.015, (0.5, 1.0): 0.04, (0.5, 0.5): 0.04, (0.25, 1.0): 0.05, (0.25, 0.5): 0.05}


def stall(run):
    """Returns words for a run that ended above the limit of the residuals, and no words for other runs."""
    if run.converged:
        return ""
    return f"; stalled above the limit of the residuals, but the drop changes by {run.change:.0e} of it in the last 100 steps"


def beside_words(run):
    return f"{run.valve} valve, opening {run.opening:g}, rim cut, ε {10 * run.eps:g} mm, o = {run.offset:g}"


def walls_of(valve, opening, runs, kept):
    """Returns the area of the walls in cm2, from the finest mesh. Also returns the entries for a row's grids. If the cases are
    missing, a row of `kept` provides the area and the entries."""
    fitted = sorted((run for run in runs if run.fitted and run.far == 0.13), key=lambda run: -run.size)
    if fitted:
        return fitted[-1].area, [place(run, run.area) for run in fitted]
    for row in kept.values():
        if row["id"].startswith((f"offset_{valve}_{opening:g}_", f"bodyfit_{valve}_{opening:g}_cut_")):
            return row["reference"], [grid for grid in row["grids"] if grid["eps"] == 0]
    return None, []


def beside(valve, opening, runs, kept):
    """Prints the table of a band with an offset, for one valve at one opening. Returns the rows of the table."""
    mine = [run for run in runs if run.offset is not None]
    if not mine:
        return []
    walls, grids = walls_of(valve, opening, runs, kept)
    if walls is None:
        print(f"\nThe {valve} valve, opening {opening:g}: no case with walls, so offsets have no rows")
        return []
    print(f"\nThe {valve} valve, opening {opening:g}, the band beside the leaflets, cut rim; walls {walls:.4f} cm2"
          f" ({', '.join(grid['n'] for grid in grids)})")
    print("  eps, mm  offset    cells  steps  seconds  total, Pa  area, cm2  off walls  drop off walls")
    rows = []
    for run in sorted(mine, key=lambda one: (-one.eps, one.offset, not one.usual)):
        off, drop = run.area / walls - 1, (walls / run.area) ** 2 - 1
        mesh = "" if run.usual else ", another mesh"
        print(f"  {10 * run.eps:>7g} {run.offset:>7g} {run.cells:>8,} {run.steps:>6} {run.seconds:>8.0f} {run.total:>10.2f}"
              f" {run.area:>10.4f} {100 * off:>+8.2f} % {100 * drop:>+13.1f} %{mesh}{stall(run)}")
        if not run.usual:
            continue
        eps = round(10 * run.eps, 6)
        areas, meshes = mean_of_meshes(run, mine, walls)
        area = numpy.mean(areas)
        off, drop = area / walls - 1, (walls / area) ** 2 - 1
        rows.append({
            "id": f"offset_{valve}_{opening:g}_{eps:g}_{run.offset:g}", "group": "offset",
            "quantity": f"{beside_words(run)}: effective area, cm²",
            "reference": round(float(walls), 4), "source": WALLS,
            "solver": SOLVER, "grids": [*grids, place(run, area)], "order": None, "extrapolated": round(float(area), 4),
            "deviation": round(float(off), 4),
            "bar": BARS.get((opening, eps)) if (valve, run.offset) == ("trileaflet", 0.75) else None,
            "note": f"total drop {run.total:.1f} Pa, {100 * drop:+.1f} % off walls; {run.steps} steps{stall(run)}"
                    f"{meshes}",
            "valve": valve, "opening": opening, "eps": round(eps * 1e-3, 7), "offset": run.offset, "drop": round(float(drop), 4)})
    return rows


def mean_of_meshes(run, runs, walls):
    """Returns the areas of this case in all meshes with two edges in eps. Also returns words on their range, if there are several
    meshes. In a narrow valve, one mesh says little, because few cells lie between the leaflets."""
    areas = [one.area for one in runs if one.has_two_edges and (one.eps, one.offset) == (run.eps, run.offset)]
    if len(areas) < 2:
        return areas, ""
    off = 100 * (numpy.array(areas) / walls - 1)
    return areas, (f"; the area is the mean of {len(areas)} meshes: {off.min():+.1f} to {off.max():+.1f} %,"
                   f" standard deviation {off.std(ddof=1):.1f} %")


def profile(run):
    """Returns places on a diameter 4.5 mm behind the free edges, in mm, and the axial speeds there. Negative places lie on the
    line through a commissure. Positive places lie on the line through the middle of a cusp."""
    from matplotlib import tri
    slices = sorted((run.folder / "postProcessing/slices").iterdir(), key=lambda path: float(path.name))[-1]
    points, corners, velocity = foam.triangles(slices / "across.vtk")
    speed = tri.LinearTriInterpolator(tri.Triangulation(points[:, 0], points[:, 1], corners), velocity[:, 2])
    radius = numpy.linspace(0, RADIUS[run.valve] * 1e-2, 201)
    places, speeds = [], []
    for sign, angle in ((-1, numpy.pi / 3 - 1e-3), (1, 1e-3)):  # just inside the planes of symmetry
        places.append(sign * radius * 1e3)
        speeds.append(speed(radius * numpy.cos(angle), radius * numpy.sin(angle)).filled(numpy.nan))
    order = numpy.argsort(numpy.concatenate(places), kind="stable")
    return numpy.concatenate(places)[order], numpy.concatenate(speeds)[order]


def profiles(runs, path):
    """Draws profiles of the axial speed behind the open and the half-open trileaflet valve. The profiles are computed with walls,
    and with bands at two offsets. Draws nothing if a case is missing."""
    import matplotlib
    matplotlib.use("Agg")
    import matplotlib.pyplot as plt
    shown = []
    for opening in (1.0, 0.5):
        mine = [run for run in runs if (run.valve, run.opening) == ("trileaflet", opening)]
        fitted = sorted((run for run in mine if run.fitted and run.far == 0.13), key=lambda run: run.size)
        bands = [run for run in mine if run.usual and run.eps == 0.1 and run.offset in (0, 0.75)]
        if not fitted or len(bands) < 2:
            return
        shown.append([fitted[0], *sorted(bands, key=lambda run: run.offset)])
    figure, axes = plt.subplots(1, 2, figsize=(9, 3.6), layout="constrained")
    for axis, some in zip(axes, shown):
        for run, colour in zip(some, ("k", "#d55e00", "#0072b2")):
            words = "walls" if run.fitted else f"o = {run.offset:g}"
            axis.plot(*profile(run), color=colour, linewidth=2.4 if run.fitted else 1.4, alpha=0.6 if run.fitted else 1,
                      label=f"{words}, {run.area:.2f} cm²")
        axis.set(xlabel="from the axis, mm: a commissure is left, a cusp right", ylabel="axial speed, m/s",
                 title=f"opening {some[0].opening:g}")
        axis.grid(True, linewidth=0.3)
        axis.legend(fontsize=8)
    figure.savefig(path, dpi=100, metadata={"Software": None})
    plt.close(figure)
