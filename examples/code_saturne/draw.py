# SPDX-License-Identifier: Apache-2.0
"""Draws the runs of ./run code_saturne: the pressure drop of the closed valve, the beat, and the flow with the leaflets."""
import ctypes
import glob
import os

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
from matplotlib.tri import Triangulation

DT = 0.002  # s, RUN_DT of settings.c
# These colours can be distinguished with every kind of colour vision (Okabe, Ito 2008), as in the pictures of riis.
COLOURS = ("#0072b2", "#e69f00", "#009e73")
LEAFLET = "#d55e00"


class Triangles(ctypes.Structure):
    """The struct riis_triangles of riis.h."""

    _fields_ = [("n_vertices", ctypes.c_int64), ("xyz", ctypes.POINTER(ctypes.c_double)),
                ("uv", ctypes.POINTER(ctypes.c_double)), ("velocity", ctypes.POINTER(ctypes.c_double)),
                ("n_triangles", ctypes.c_int64), ("vertex_id", ctypes.POINTER(ctypes.c_int64)),
                ("triangle_id", ctypes.POINTER(ctypes.c_int64)), ("leaflet_id", ctypes.POINTER(ctypes.c_int32)),
                ("patch_id", ctypes.POINTER(ctypes.c_int32))]


def leaflets_cut(opening):
    """Returns the segments in which the plane y = 0 cuts the valve at an opening, as an array (n, 2, 2), with x and z in
    metres."""
    riis = ctypes.CDLL(os.path.join(os.environ["RIIS_PREFIX"], "lib", "libriis.so"))
    riis.riis_last_error.restype = ctypes.c_char_p

    def check(status):
        if status != 0:
            raise RuntimeError(riis.riis_last_error().decode())

    valve, surface = ctypes.c_void_p(), ctypes.c_void_p()
    check(riis.riis_valve_create(b"trileaflet", ctypes.byref(valve)))
    check(riis.riis_valve_set_scalar(valve, b"opening", ctypes.c_double(opening)))
    check(riis.riis_surface_create(valve, None, ctypes.byref(surface)))
    found = Triangles()
    check(riis.riis_surface_get_triangles(surface, ctypes.byref(found), ctypes.c_int64(ctypes.sizeof(found))))
    points = 0.01 * np.ctypeslib.as_array(found.xyz, (found.n_vertices, 3)).copy()
    triangles = np.ctypeslib.as_array(found.vertex_id, (found.n_triangles, 3)).copy()
    riis.riis_surface_destroy(ctypes.byref(surface))
    riis.riis_valve_destroy(ctypes.byref(valve))
    segments = []
    for corners in points[triangles]:
        ends = []
        for a, b in ((0, 1), (1, 2), (2, 0)):
            ya, yb = corners[a][1], corners[b][1]
            if (ya < 0) != (yb < 0):
                ends.append((corners[a] + (corners[b] - corners[a]) * ya / (ya - yb))[[0, 2]])
        if len(ends) == 2:
            segments.append(ends)
    return np.array(segments).reshape(-1, 2, 2)


def draw_flow(study, out, history):
    """Draws the speed in the plane y = 0 at several times of the beat, with the leaflets."""
    opening = history["opening"]
    steps = sorted(int(os.path.basename(path).split("_")[1].split(".")[0])
                   for path in glob.glob(os.path.join(study, "c", "RESU", "beat", "slice_*.0.csv")))
    top = opening.index(max(opening))
    jet = history["flow"].index(max(history["flow"]))

    def nearest(wanted):
        return min(steps, key=lambda step: abs(step - wanted))

    half = next(i for i in range(len(opening)) if opening[i] > 0.4)
    closing = next(i for i in range(top, len(opening)) if opening[i] < 0.4) if opening[-1] < 0.4 else len(opening) - 1
    chosen = [nearest(step + 1) for step in (half - 18, half, jet, closing, len(opening) - 1)]
    figure, axes = plt.subplots(1, len(chosen), figsize=(3.2 * len(chosen), 6.2), sharey=True, constrained_layout=True)
    for axis, step in zip(axes, chosen):
        rows = np.concatenate([np.loadtxt(path, delimiter=",", ndmin=2) for path in
                               glob.glob(os.path.join(study, "c", "RESU", "beat", f"slice_{step:05d}.*.csv"))])
        x, z, speed = 1e3 * rows[:, 0], 1e3 * rows[:, 1], np.linalg.norm(rows[:, 2:5], axis=1)
        mesh = Triangulation(x, z)
        sides = np.hypot(x[mesh.triangles] - np.roll(x[mesh.triangles], 1, axis=1),
                         z[mesh.triangles] - np.roll(z[mesh.triangles], 1, axis=1)).max(axis=1)
        mesh.set_mask(sides > 6.5)  # hides gaps outside the curved wall
        colours = axis.tripcolor(mesh, np.minimum(speed, 0.8), shading="gouraud", vmin=0, vmax=0.8, cmap="viridis")
        axis.quiver(x[::2], z[::2], rows[::2, 2], rows[::2, 4], color="white", scale=8, width=0.004)
        for ends in leaflets_cut(opening[step - 1]):
            axis.plot(1e3 * ends[:, 0], 1e3 * ends[:, 1], color=LEAFLET, linewidth=2.5)
        title = f"{step * DT:.3f} s, opening {opening[step - 1]:.2f}\ndrop {history['drop'][step - 1]:.0f} Pa"
        axis.set_title(title, fontsize=11)
        axis.set_aspect("equal")
        axis.set_xlim(-14, 18)
        axis.set_ylim(-29, 24)
        axis.set_xlabel("x, mm")
    axes[0].set_ylabel("z, mm: the ventricle is below, the aorta above")
    figure.colorbar(colours, ax=axes, label="speed, m/s", shrink=0.7)
    figure.suptitle("The aortic root in code_saturne. Orange: the leaflets. The cut runs through the middle of the right cusp "
                    "and between the other two, which meet in the cut when they close")
    figure.savefig(os.path.join(out, "flow.png"), dpi=110)
    plt.close(figure)


def draw_beat(study, out, read_history):
    """Draws the pressure drop, the flow and the opening over the beat."""
    runs = [("C, head losses", read_history(study, "c", "beat"), COLOURS[0], "-"),
            ("C, without the leaflets' velocity", read_history(study, "c", "beat_still"), COLOURS[1], "--"),
            ("Fortran, momentum source", read_history(study, "fortran", "beat"), COLOURS[2], ":")]
    figure, axes = plt.subplots(3, 1, figsize=(9, 9), sharex=True, constrained_layout=True)
    for label, history, colour, line in runs:
        time = np.array(history["time"])
        axes[0].plot(time, history["drop"], color=colour, linestyle=line, label=label)
        axes[1].plot(time, 1e6 * np.array(history["flow"]), color=colour, linestyle=line)
        axes[2].plot(time, history["opening"], color=colour, linestyle=line)
    axes[0].set_ylabel("pressure upstream less\ndownstream, Pa")
    axes[1].set_ylabel("flow, ml/s")
    axes[2].set_ylabel("opening")
    axes[2].set_xlabel("time, s")
    axes[0].legend()
    for axis in axes:
        axis.grid(alpha=0.3)
        axis.axhline(0, color="black", linewidth=0.6)
    figure.suptitle("A beat: the valve opens when the solver's pressure upstream is higher,\n"
                    "and closes when its flow turns back. The resistance is mild, so the closed valve leaks.", fontsize=11)
    figure.savefig(os.path.join(out, "beat.png"), dpi=110)
    plt.close(figure)


def draw_closed(study, out, read_history):
    """Draws how the pressure drop of the closed valve builds up."""
    figure, axis = plt.subplots(figsize=(8, 4.5), constrained_layout=True)
    reference = read_history(study, "reference", "closed")
    runs = (("C, head losses", read_history(study, "c", "closed_1"), COLOURS[0], "o-"),
            ("Fortran, momentum source", read_history(study, "fortran", "closed_1"), COLOURS[2], "s-"),
            ("the solver's own head-loss zone", reference, "black", "--"))
    for label, history, colour, style in runs:
        axis.plot(history["step"][1:], history["drop"][1:], style, color=colour, markersize=3, label=label)
    axis.set_xlabel("time step after a sudden start; the first one, with the inertia of the whole fluid, is left out")
    axis.set_ylabel("drop across the closed valve, Pa")
    axis.grid(alpha=0.3)
    axis.legend()
    axis.set_title("The closed valve in a steady flow: head losses give the drop at once.\n"
                   "The pressure equation does not know a momentum source, so its drop builds up")
    figure.savefig(os.path.join(out, "closed.png"), dpi=110)
    plt.close(figure)


def draw_all(study, parts, out, read_history):
    """Draws the runs of the given parts of check.py."""
    os.makedirs(out, exist_ok=True)
    if "closed" in parts:
        draw_closed(study, out, read_history)
    if "beat" in parts:
        draw_beat(study, out, read_history)
        draw_flow(study, out, read_history(study, "c", "beat"))
