#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Draws what the flow solver left in a folder: beat.png, the heartbeat over time; flow.mp4, the flow through the valve; and
four stills of the movie."""
import pathlib
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.animation
import matplotlib.collections
import matplotlib.pyplot as plt
import numpy as np

MMHG = 133.322
LEAFLET = "#d62728"
WALL = "#b9aaa2"
UPSTREAM = "#a6361c"
DOWNSTREAM = "#1f4e9e"
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


class Frame:
    """Two slices of the flow, with the cut of the leaflets."""

    def __init__(self, path):
        with open(path, "rb") as file:
            data = file.read()
        self.path, self.data, self.offset = path, data, 0
        nx, ny, nz = self.take("<i4", 3)
        h, x, y, z, self.height, self.time, self.opening = self.take("<f4", 7) * 1.0
        self.long_axis = self.take("<f4", 3 * ny * nz).reshape(3, nz, ny)
        self.section = self.take("<f4", 3 * nx * ny).reshape(3, ny, nx)
        self.long_cut = self.take("<f4", 6 * self.take("<i4", 1)[0]).reshape(-1, 2, 3)
        self.section_cut = self.take("<f4", 6 * self.take("<i4", 1)[0]).reshape(-1, 2, 3)
        if self.offset != len(data):
            stop(f"{path} has {len(data)} bytes; {self.offset} were expected")
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
    """All quantities over time, in one figure."""
    figure, axes = plt.subplots(5, 1, figsize=(8, 11), sharex=True, constrained_layout=True)
    figure.suptitle("One heartbeat of the aortic valve (grey: the valve is closed)")
    time = table["time_s"]
    draw_pressures(axes[0], table)
    axes[0].legend(loc="upper right", framealpha=1)
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

    def __init__(self, table, frames, fastest):
        first = frames[0]
        self.figure = plt.figure(figsize=(12.8, 7.2), dpi=100)
        grid = self.figure.add_gridspec(2, 3, width_ratios=(1.25, 0.06, 1.25), left=0.05, right=0.98, bottom=0.08, top=0.86,
                                        wspace=0.35, hspace=0.38)
        self.long = self.figure.add_subplot(grid[:, 0])
        bar = self.figure.add_subplot(grid[:, 1])
        self.section = self.figure.add_subplot(grid[0, 2])
        self.chart = self.figure.add_subplot(grid[1, 2])
        colours = plt.get_cmap("viridis").copy()
        colours.set_bad(WALL)
        self.title = self.figure.suptitle("", fontsize=15, x=0.02, ha="left")
        options = {"cmap": colours, "vmin": 0, "vmax": fastest, "shading": "flat", "rasterized": True}
        self.speed = self.long.pcolormesh(first.y, first.z, self.speed_of(first.long_axis), **options)
        self.figure.colorbar(self.speed, cax=bar, label="speed of the blood, m/s")
        self.long.set_title("cut along the vessel", fontsize=11)
        self.long.set_xlabel("cm")
        self.long.set_ylabel("cm; the ventricle is below, the aorta above")
        centre = [(a[1:] + a[:-1]) / 2 for a in (first.y, first.z)]
        self.every = 2
        self.arrows = self.long.quiver(centre[0][::self.every], centre[1][::self.every],
                                       *self.arrows_of(first), color="w", scale=12 * fastest, width=0.003)
        self.through = self.section.pcolormesh(first.x, first.y, self.speed_of(first.section), **options)
        self.section.set_title(f"cut across the vessel, {10 * 100 * first.height:.1f} mm above the closed edges", fontsize=11)
        self.section.set_xlabel("cm")
        self.section.set_ylabel("cm")
        self.leaflets = []
        for axes in (self.long, self.section):
            axes.set_aspect("equal")
            lines = matplotlib.collections.LineCollection([], colors=LEAFLET, linewidths=3)
            axes.add_collection(lines)
            self.leaflets.append(lines)
        self.long.axhline(100 * first.height, color="w", ls=":", lw=1)
        self.long.plot([], [], color=LEAFLET, lw=3, label="valve leaflets")
        self.long.plot([], [], color=WALL, lw=8, label="wall of the vessel")
        self.long.legend(loc="upper left", framealpha=1, fontsize=9)
        draw_pressures(self.chart, table)
        shade_open(self.chart, table)
        self.chart.legend(loc="upper right", fontsize=8, framealpha=1)
        self.chart.set_xlabel("time, s (grey: the valve is closed)")
        self.chart.set_xlim(0, table["time_s"][-1])
        self.chart.set_title("pressures on both sides", fontsize=11)
        self.now = self.chart.axvline(0, color="k")
        self.flow_over_time = (table["time_s"], 1e6 * table["flow_m3_per_s"])

    @staticmethod
    def speed_of(velocity):
        return np.ma.masked_invalid(np.sqrt((velocity.astype(float) ** 2).sum(axis=0)))

    def arrows_of(self, frame):
        along = np.nan_to_num(frame.long_axis)[:, ::self.every, ::self.every]
        return along[1], along[2]

    def draw(self, frame):
        self.speed.set_array(self.speed_of(frame.long_axis).ravel())
        self.through.set_array(self.speed_of(frame.section).ravel())
        self.arrows.set_UVC(*self.arrows_of(frame))
        self.leaflets[0].set_segments(list(100 * frame.long_cut[:, :, 1:]))
        self.leaflets[1].set_segments(list(100 * frame.section_cut[:, :, :2]))
        self.now.set_xdata([frame.time, frame.time])
        flow = np.interp(frame.time, *self.flow_over_time)
        state = "closed" if frame.opening <= 0 else "open" if frame.opening >= 1 else "moving"
        self.title.set_text(f"Aortic valve: {state}, {100 * frame.opening:.0f} % open   |   {1000 * frame.time:.0f} ms"
                            f"   |   flow {flow:.0f} ml/s")


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
    fastest = np.ceil(10 * max(np.nanmax(Movie.speed_of(frame.long_axis)) for frame in frames)) / 10
    movie = Movie(table, frames, max(fastest, 0.1))
    writer = matplotlib.animation.FFMpegWriter(fps=FRAME_RATE, extra_args=["-pix_fmt", "yuv420p"])
    stills = {int(round(share * (len(frames) - 1))) for share in (0.02, 0.12, 0.2, 0.38, 0.45, 0.8)}
    with writer.saving(movie.figure, str(folder / "flow.mp4"), dpi=100):
        for i, frame in enumerate(frames):
            movie.draw(frame)
            writer.grab_frame()
            if i in stills:
                movie.figure.savefig(folder / f"flow_{1000 * frame.time:03.0f}ms.png", dpi=100)


if __name__ == "__main__":
    main()
