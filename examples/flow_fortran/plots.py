#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Draws the results of the flow solver in a folder: beat.png, the heartbeat over time; flow.mp4, the flow through the valve; and
five stills of the movie."""
import pathlib
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.animation
import matplotlib.collections
import matplotlib.pyplot as plt
import numpy as np

MMHG = 133.322
# These colours can be distinguished with every kind of colour vision (Okabe, Ito 2008), as in the pictures of riis.
LEAFLET = "#d55e00"
WALL = "#b9aaa2"
UPSTREAM = "#d55e00"
DOWNSTREAM = "#0072b2"
FRAME_RATE = 12


def stop(text):
    sys.exit(f"plots.py: {text}")


def read_table(path):
    """Reads beat.csv into one array for each column."""
    if not path.is_file():
        stop(f"there is no file {path}; the program flow writes it")
    with open(path, encoding="ascii") as file:
        names = file.readline().strip().split(",")
        rows = [line.split(",") for line in file]
    bad = [i for i, row in enumerate(rows, start=2) if len(row) != len(names)]
    if not rows or bad:
        stop(f"{path} has no complete row" if not rows else f"{path}, line {bad[0]}: not {len(names)} columns")
    return dict(zip(names, np.array(rows, float).T))


def cut(triangles, axis, position):
    """Returns the segments in which triangles (n, 3, 3) cut a plane across an axis: an array (n, 2, 3)."""
    above = triangles[:, :, axis] >= position
    triangles = triangles[above.any(axis=1) & ~above.all(axis=1)]
    above = triangles[:, :, axis] >= position
    start, end = triangles, np.roll(triangles, -1, axis=1)
    crosses = above != np.roll(above, -1, axis=1)  # two sides of each triangle
    start, end = start[crosses], end[crosses]
    share = (position - start[:, axis]) / (end[:, axis] - start[:, axis])
    return (start + share[:, None] * (end - start)).reshape(-1, 2, 3)


class Frame:
    """Draws two slices of the flow, with the cut of the leaflets."""

    def __init__(self, path):
        with open(path, "rb") as file:
            data = file.read()
        self.path, self.data, self.offset = path, data, 0
        nx, ny, nz = self.take("<i4", 3)
        h, x, y, z, self.height, self.time, self.opening = self.take("<f4", 7).astype(float)
        self.long_axis = self.take("<f4", 3 * ny * nz).reshape(3, nz, ny)
        self.pressure = self.take("<f4", ny * nz).reshape(nz, ny) / MMHG
        self.section = self.take("<f4", 3 * nx * ny).reshape(3, ny, nx)
        triangles = self.take("<f4", 9 * self.take("<i4", 1)[0]).reshape(-1, 3, 3).astype(float)
        if self.offset != len(data):
            stop(f"{path} has {len(data)} bytes; {self.offset} were expected")
        self.long_cut = cut(triangles, 0, 0.0)
        self.section_cut = cut(triangles, 2, self.height)
        to_cm = 100
        self.x = to_cm * (x + h * np.arange(nx + 1))
        self.y = to_cm * (y + h * np.arange(ny + 1))
        self.z = to_cm * (z + h * np.arange(nz + 1))

    def take(self, kind, count):
        size = np.dtype(kind).itemsize * int(count)
        if self.offset + size > len(self.data):
            stop(f"{self.path} ends after {len(self.data)} bytes")
        values = np.frombuffer(self.data, kind, int(count), self.offset)
        self.offset += size
        return values


def shade_open(axes, table):
    """Grey bands show when the valve is closed."""
    closed = table["opening"] <= 0
    time = table["time_s"]
    edges = np.flatnonzero(np.diff(closed.astype(int)))
    bounds = np.concatenate(([0], edges + 1, [len(time) - 1]))
    for first, last in zip(bounds[:-1], bounds[1:]):
        if closed[first]:
            axes.axvspan(time[first], time[last], color="0.92", lw=0)


def draw_pressures(axes, table):
    axes.plot(table["time_s"], table["p_upstream_Pa"] / MMHG, color=UPSTREAM, label="upstream (ventricle)")
    axes.plot(table["time_s"], table["p_downstream_Pa"] / MMHG, color=DOWNSTREAM, label="downstream (aorta)")
    axes.set_ylabel("pressure, mmHg")


def draw_beat(table, path):
    """Draws all quantities over time, in one figure."""
    figure, axes = plt.subplots(5, 1, figsize=(8, 11), sharex=True, constrained_layout=True)
    figure.suptitle("One heartbeat of the aortic valve, from rest (grey: the valve is closed).\n"
                    "It opens within 40 ms when the ventricle has more pressure, and closes when the flow turns back.",
                    fontsize=11)
    time = table["time_s"]
    draw_pressures(axes[0], table)
    axes[0].plot(time, (table["p_upstream_Pa"] - table["p_downstream_Pa"]) / MMHG, color="0.5", lw=1,
                 label="upstream less downstream")
    axes[0].set_ylim(top=1.4 * axes[0].get_ylim()[1])
    axes[0].legend(loc="upper center", framealpha=1, fontsize=9, ncols=3)
    axes[1].plot(time, 1e6 * table["flow_m3_per_s"], color="k")
    axes[1].set_ylabel("flow into the aorta, ml/s")
    axes[2].plot(time, table["opening"], color=LEAFLET)
    axes[2].set_ylabel("opening\n0 closed, 1 open")
    axes[3].plot(time, table["jet_m_per_s"], color="k")
    axes[3].set_ylabel("jet: largest speed\ntowards the aorta, m/s")
    axes[4].plot(time, table["force_z_N"], color="k")
    axes[4].set_ylabel("force on the leaflets, N\n(+ towards the aorta)")
    axes[4].set_xlabel("time, s")
    for one in axes:
        shade_open(one, table)
        one.grid(alpha=0.3)
        one.set_xlim(0, time[-1])
    figure.savefig(path, dpi=110)
    plt.close(figure)


class Movie:
    """The drawing of one frame."""

    def __init__(self, table, frames):
        first = frames[0]
        fastest = max(0.1, np.ceil(10 * max(np.nanmax(self.speed_of(frame.long_axis)) for frame in frames)) / 10)
        highest = 20 * np.ceil(max(table["p_upstream_Pa"].max(), table["p_downstream_Pa"].max()) / MMHG / 20)
        self.figure = plt.figure(figsize=(12.8, 7.2), dpi=100)
        grid = self.figure.add_gridspec(3, 3, width_ratios=(1, 1, 0.7), left=0.05, right=0.985, bottom=0.075, top=0.885,
                                        wspace=0.19, hspace=0.5)
        self.title = self.figure.suptitle("", fontsize=17, x=0.02, ha="left")
        self.speed = self.draw_long(self.figure.add_subplot(grid[:, 0]), first, "speed and direction of the blood",
                                    self.speed_of(first.long_axis), "viridis", fastest, "m/s")
        self.pressure = self.draw_long(self.figure.add_subplot(grid[:, 1]), first, "pressure of the blood",
                                       np.ma.masked_invalid(first.pressure), "coolwarm", highest, "mmHg")
        self.speed.axes.set_ylabel("height, cm: the ventricle is below, the aorta above")
        across = self.figure.add_subplot(grid[0, 2])
        self.across = self.shade(across, first.x, first.y, self.speed_of(first.section), "viridis", fastest)
        across.set_title("speed across, at the dotted line", fontsize=11)
        across.set_xlabel("x, cm", labelpad=0)
        across.set_ylabel("y, cm")
        across.axvline(0, color="w", ls=":", lw=1)
        axes = (self.speed.axes, self.pressure.axes, across)
        self.leaflets = [one.add_collection(matplotlib.collections.LineCollection([], colors=LEAFLET, linewidths=2.5))
                         for one in axes]
        self.every = 2
        middle = [((a[1:] + a[:-1]) / 2)[::self.every] for a in (first.y, first.z)]
        self.arrows = axes[0].quiver(*middle, *self.arrows_of(first), color="w", scale=13 * fastest, width=0.0035)
        for one in axes[:2]:
            one.axhline(100 * first.height, color="w", ls=":", lw=1)
        axes[0].plot([], [], color=LEAFLET, lw=2.5, label="leaflets of the valve")
        axes[0].plot([], [], color=WALL, lw=8, label="wall of the vessel")
        axes[0].legend(loc="upper center", framealpha=1, fontsize=9, ncols=2, columnspacing=1)
        charts = [self.figure.add_subplot(grid[row, 2]) for row in (1, 2)]
        draw_pressures(charts[0], table)
        charts[0].legend(loc="upper right", fontsize=7, framealpha=1)
        charts[1].plot(table["time_s"], 1e6 * table["flow_m3_per_s"], color="k")
        charts[1].set_ylabel("flow to aorta, ml/s")
        charts[1].set_xlabel("time, s (grey: the valve is closed)")
        self.now = []
        for one in charts:
            shade_open(one, table)
            one.set_xlim(0, table["time_s"][-1])
            self.now.append(one.axvline(0, color=LEAFLET, lw=1.5))
        self.table = table

    @staticmethod
    def shade(axes, x, y, values, colours, highest):
        colours = plt.get_cmap(colours).copy()
        colours.set_bad(WALL)
        axes.set_aspect("equal")
        return axes.pcolormesh(x, y, values, cmap=colours, vmin=0, vmax=highest, shading="flat", rasterized=True)

    def draw_long(self, axes, frame, title, values, colours, highest, unit):
        mesh = self.shade(axes, frame.y, frame.z, values, colours, highest)
        bar = self.figure.colorbar(mesh, ax=axes, orientation="horizontal", pad=0.08, fraction=0.04, aspect=30)
        bar.set_label(unit, labelpad=0)
        axes.set_title(title, fontsize=12)
        axes.set_xlabel("y, cm", labelpad=0)
        return mesh

    @staticmethod
    def speed_of(velocity):
        return np.ma.masked_invalid(np.sqrt((velocity.astype(float) ** 2).sum(axis=0)))

    def arrows_of(self, frame):
        along = frame.long_axis[1:, ::self.every, ::self.every].astype(float)
        return np.ma.masked_where(np.broadcast_to(~(np.hypot(*along) > 0.05), along.shape), along)

    def draw(self, frame):
        self.speed.set_array(self.speed_of(frame.long_axis).ravel())
        self.pressure.set_array(np.ma.masked_invalid(frame.pressure).ravel())
        self.across.set_array(self.speed_of(frame.section).ravel())
        self.arrows.set_UVC(*self.arrows_of(frame))
        for lines, cut in zip(self.leaflets, (frame.long_cut[:, :, 1:], frame.long_cut[:, :, 1:], frame.section_cut[:, :, :2])):
            lines.set_segments(list(100 * cut))
        for line in self.now:
            line.set_xdata([frame.time, frame.time])
        flow = np.interp(frame.time, self.table["time_s"], 1e6 * self.table["flow_m3_per_s"])
        before = np.interp(frame.time - 1e-3, self.table["time_s"], self.table["opening"])
        state = "opens" if frame.opening > before + 1e-3 else "closes" if frame.opening < before - 1e-3 else \
            "is closed" if frame.opening <= 0 else "is open"
        self.title.set_text(f"The aortic valve {state}: opening {100 * frame.opening:.0f} %, time {1000 * frame.time:.0f} ms, "
                            f"flow {flow:.0f} ml/s")


def choose_stills(frames, table):
    """Returns the numbers of the frames for the stills: closed, opening, at the largest flow, closing, closed again."""
    opening = np.array([frame.opening for frame in frames])
    time = np.array([frame.time for frame in frames])
    most = int(np.argmin(abs(time - table["time_s"][np.argmax(table["flow_m3_per_s"])])))
    held = table["p_downstream_Pa"] - table["p_upstream_Pa"]
    late = np.where(table["time_s"] > time[most], held, -np.inf)
    return {
        0: "1_closed",
        int(np.argmin(abs(opening[:most + 1] - 0.4))): "2_opens",
        most: "3_open",
        most + int(np.argmin(abs(opening[most:] - 0.4))): "4_closes",
        int(np.argmin(abs(time - table["time_s"][np.argmax(late)]))): "5_holds",
    }


def main():
    if len(sys.argv) != 2:
        stop("usage: plots.py FOLDER")
    folder = pathlib.Path(sys.argv[1])
    table = read_table(folder / "beat.csv")
    draw_beat(table, folder / "beat.png")
    paths = sorted((folder / "frames").glob("[0-9]*.bin"))
    if not paths:
        stop(f"there is no file {folder / 'frames'}/0000.bin; the program flow writes it")
    missing = [i for i, path in enumerate(paths) if int(path.stem) != i]
    if missing:
        stop(f"there is no file {folder / 'frames'}/{missing[0]:04}.bin")
    frames = [Frame(path) for path in paths]
    movie = Movie(table, frames)
    stills = choose_stills(frames, table)
    writer = matplotlib.animation.FFMpegWriter(fps=FRAME_RATE, extra_args=["-pix_fmt", "yuv420p"])
    with writer.saving(movie.figure, str(folder / "flow.mp4"), dpi=100):
        for i, frame in enumerate(frames):
            movie.draw(frame)
            writer.grab_frame()
            if i in stills:
                movie.figure.savefig(folder / f"{stills[i]}.png", dpi=100)


if __name__ == "__main__":
    main()
