# SPDX-License-Identifier: Apache-2.0
"""The plots of ./run openfoam: the heartbeat in time, and the velocity with the leaflets."""
import pathlib

import matplotlib
import numpy

import foam_files as foam

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402

RHO = 1060.0


def _drop(case):
    upstream, downstream = foam.table(case, "upstream"), foam.table(case, "downstream")
    return upstream[:, 0], RHO * (upstream[:, 1] - downstream[:, 1])


def beat(case, still, path):
    """Opening, pressure difference and flow over the heartbeat."""
    figure, axes = plt.subplots(3, 1, figsize=(8, 8), sharex=True)
    for folder, name, style in ((case, "K (u - velocity of the leaflets)", "C0-"), (still, "K u", "C1--")):
        rows, flow = foam.steps(folder), foam.table(folder, "flow")
        time, drop = _drop(folder)
        axes[0].plot(rows[:, 0], rows[:, 1], style, label=name)
        axes[1].plot(time, drop, style)
        axes[2].plot(flow[:, 0], flow[:, 1] * 1e6, style)
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
    figure.savefig(path, dpi=120)
    plt.close(figure)


def _cut(points, triangles):
    """The segments in which triangles cut the plane y = 0."""
    segments = []
    for corners in points[triangles]:
        ends = []
        for k in range(3):
            a, b = corners[k], corners[(k + 1) % 3]
            if (a[1] > 0) != (b[1] > 0):
                t = a[1] / (a[1] - b[1])
                ends.append((a + t * (b - a))[[0, 2]])
        if len(ends) == 2:
            segments.append(ends)
    return segments


def velocity(case, path):
    """The speed in the plane y = 0, and the leaflets there, at six of the written times."""
    case = pathlib.Path(case)
    rows = foam.steps(case)
    found = sorted((folder for folder in (case / "postProcessing/slice").iterdir()), key=lambda folder: float(folder.name))
    # From shortly before the valve opens to shortly after it has closed.
    moving = rows[rows[:, 1] > 0, 0]
    inside = [folder for folder in found if moving[0] - 0.025 < float(folder.name) < moving[-1] + 0.025]
    chosen = [inside[round(i)] for i in numpy.linspace(0, len(inside) - 1, 6)]
    slices = [numpy.loadtxt(next(folder.glob("U*middle*.raw"))) for folder in chosen]
    largest = max(numpy.linalg.norm(values[:, 3:6], axis=1).max() for values in slices)
    figure, axes = plt.subplots(1, 6, figsize=(14, 5.4), sharey=True, layout="constrained")
    for one, folder, values in zip(axes, chosen, slices):
        x, z = 100 * values[:, 0], 100 * values[:, 2]
        mesh = matplotlib.tri.Triangulation(x, z)
        # The root is not convex: triangles across the outside are long.
        corners = numpy.stack([x, z], axis=1)[mesh.triangles]
        longest = numpy.linalg.norm(corners - numpy.roll(corners, 1, axis=1), axis=2).max(axis=1)
        mesh.set_mask(longest > 6 * numpy.median(longest))
        colours = one.tripcolor(mesh, numpy.linalg.norm(values[:, 3:6], axis=1), shading="gouraud", vmin=0, vmax=largest, cmap="viridis")
        leaflets = case / "postProcessing/aorticValve" / folder.name / "leaflets.vtk"
        lines = [[100 * a, 100 * b] for a, b in _cut(*foam.leaflets(leaflets))]
        one.add_collection(matplotlib.collections.LineCollection(lines, colors="white", linewidths=2.5))
        one.add_collection(matplotlib.collections.LineCollection(lines, colors="red", linewidths=1.2))
        opening = rows[numpy.abs(rows[:, 0] - float(folder.name)).argmin(), 1]
        one.set_title(f"{float(folder.name):.2f} s, opening {opening:.2f}", fontsize=10)
        one.set_aspect("equal")
        one.set_xlabel("x, cm")
    axes[0].set_ylabel("z, cm; blood flows upwards")
    figure.colorbar(colours, ax=axes, label="speed, m/s", shrink=0.8)
    figure.suptitle("Speed in the plane y = 0; red: the leaflets there")
    figure.savefig(path, dpi=110)
    plt.close(figure)
