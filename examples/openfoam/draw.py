# SPDX-License-Identifier: Apache-2.0
"""Draws the plots of ./run openfoam: the heartbeat in time, and the velocity with the leaflets."""
import pathlib

import matplotlib
import matplotlib.collections
import numpy

import foam_files as foam

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402

RHO = 1060.0
# These colours can be distinguished with every kind of colour vision (Okabe, Ito 2008), as in the pictures of riis.
COLOURS = ("#0072b2", "#e69f00")
LEAFLET = "#d55e00"


def _drop(case):
    upstream, downstream = foam.table(case, "upstream"), foam.table(case, "downstream")
    return upstream[:, 0], RHO * (upstream[:, 1] - downstream[:, 1])


def beat(case, still, path):
    """Draws opening, pressure difference and flow over the heartbeat."""
    figure, axes = plt.subplots(3, 1, figsize=(8, 8), sharex=True)
    runs = (case, "K (u - velocity of the leaflets)", "-"), (still, "K u", "--")
    for (folder, name, style), colour in zip(runs, COLOURS):
        rows, flow = foam.steps(folder), foam.table(folder, "flow")
        time, drop = _drop(folder)
        axes[0].plot(rows[:, 0], rows[:, 1], style, color=colour, label=name)
        axes[1].plot(time, drop, style, color=colour)
        axes[2].plot(flow[:, 0], flow[:, 1] * 1e6, style, color=colour)
    axes[0].set_ylabel("opening, 0 to 1")
    axes[0].legend(frameon=False)
    axes[1].set_ylabel("pressure below the valve\nless that above, Pa")
    axes[2].set_ylabel("flow through the outlet, ml/s")
    axes[2].set_xlabel("time, s")
    for one in axes:
        one.axhline(0, color="0.8", linewidth=0.8, zorder=0)
        one.spines[["top", "right"]].set_visible(False)
    axes[0].set_title("A heartbeat of the aortic valve in OpenFOAM's pimpleFoam")
    figure.tight_layout()
    figure.savefig(path, dpi=80)
    plt.close(figure)


def velocity(case, path):
    """Draws the speed and the leaflets in the plane x = 0, at six of the written times."""
    case = pathlib.Path(case)
    rows = foam.steps(case)
    time, opening = rows[:, 0], rows[:, 1]
    half = time[opening > 0.5]
    moving = time[opening > 0]
    full = time[opening > 0.999]
    # At the six times the valve is closed, half open, open, about to close, half closed, and closed again.
    wanted = [moving[0] - 0.01, half[0], full.mean(), full[-1] - 0.01, half[-1], moving[-1] + 0.01]
    written = {float(folder.name): folder for folder in (case / "postProcessing/slice").iterdir()}
    chosen = [written[min(written, key=lambda t: abs(t - want))] for want in wanted]
    slices = [foam.triangles(folder / "middle.vtk") for folder in chosen]
    # A few cells beside the moving band may have a much higher speed than all other cells. The colour scale does not include
    # their speeds.
    largest = max(numpy.percentile(numpy.linalg.norm(vectors, axis=1), 99.5) for _, _, vectors in slices)
    figure, axes = plt.subplots(1, 6, figsize=(14, 4.4), sharey=True, layout="constrained")
    for one, folder, (points, corners, vectors) in zip(axes, chosen, slices):
        speed = numpy.linalg.norm(vectors, axis=1)
        colours = one.tripcolor(100 * points[:, 1], 100 * points[:, 2], corners, speed, shading="gouraud", vmin=0, vmax=largest,
                                cmap="viridis")
        leaflets = foam.triangles(case / "postProcessing/aorticValve" / folder.name / "leaflets.vtk")
        lines = [[100 * a, 100 * b] for a, b in foam.cut(*leaflets[:2])]
        one.add_collection(matplotlib.collections.LineCollection(lines, colors="white", linewidths=2.5))
        one.add_collection(matplotlib.collections.LineCollection(lines, colors=LEAFLET, linewidths=1.2))
        now = opening[numpy.abs(time - float(folder.name)).argmin()]
        one.set_title(f"{float(folder.name):.2f} s, opening {now:.2f}", fontsize=10)
        one.set_aspect("equal")
        one.set_xlabel("y, cm")
    axes[0].set_ylabel("z, cm; blood flows upwards")
    figure.colorbar(colours, ax=axes, label="speed, m/s", shrink=0.9, extend="max")
    figure.suptitle("Speed in the plane x = 0; orange: the leaflets there")
    figure.savefig(path, dpi=90)
    plt.close(figure)
