# SPDX-License-Identifier: Apache-2.0
"""Draws the beating left heart of ./run heart.

    draw.py CASE ZERO_D.csv OUT      # OUT/loop.png, OUT/heart.png, and with ffmpeg OUT/heart.mp4
    draw.py loops PICTURE CASE TABLES [CASE TABLES ...]    # the loop of each heart; the folder TABLES has its zero_d.csv
    draw.py hearts PICTURE CASE [CASE ...]                 # each heart in systole and in diastole, and its valves
"""
import pathlib
import shutil
import subprocess
import sys
import tempfile

import matplotlib
import matplotlib.collections
import numpy as np

import check
import clinic
from check import foam

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402

# These colours can be distinguished with every kind of colour vision (Okabe, Ito 2008), as in the pictures of riis.
BLUE, ORANGE, RED, GREEN, GREY = "#0072b2", "#e69f00", "#d55e00", "#009e73", "0.6"


def loop(beat, model, path):
    """Draws the pressure-volume loop, and pressures, flows and openings over time. Grey lines show the 0D model."""
    figure, axes = plt.subplots(2, 2, figsize=(10, 7), layout="constrained")
    stroke = axes[0, 0]
    shift = model["volume"][0] - beat.volume[0]
    stroke.plot(model["volume"], model["ventricle"], color=GREY, label="without space")
    stroke.plot(beat.volume + shift, beat.ventricle, color=BLUE, label="in space")
    stroke.set_xlabel("volume of the ventricle, ml")
    stroke.set_ylabel("pressure, mmHg")
    stroke.legend(frameon=False)
    pressures, flows, openings = axes[0, 1], axes[1, 0], axes[1, 1]
    for name, values, colour in (("ventricle", beat.ventricle, BLUE), ("aorta", beat.aorta, RED), ("atrium", beat.atrium,
        ORANGE)):
        pressures.plot(beat.time, model[name], color=GREY, linewidth=0.8)
        pressures.plot(beat.time, values, color=colour, label=name)
    pressures.set_ylabel("pressure, mmHg")
    for name, values, colour in (("mitral", beat.mitral, ORANGE), ("aortic", beat.aortic, RED)):
        flows.plot(beat.time, model[f"{name}_flow"], color=GREY, linewidth=0.8)
        flows.plot(beat.time, values, color=colour, label=f"{name} valve")
        openings.plot(beat.time, beat.openings[name], color=colour, label=f"{name} valve")
    flows.set_ylabel("flow, ml/s")
    openings.set_ylabel("opening, 0 to 1")
    for one in (pressures, flows, openings):
        one.set_xlabel("time, s")
        one.legend(frameon=False)
    for one in axes.flat:
        one.spines[["top", "right"]].set_visible(False)
    figure.savefig(path, dpi=90)
    plt.close(figure)


def slice_at(axes, case, time, largest):
    """Draws the speed and the leaflets in the plane x = 0 at a written time."""
    points, corners, vectors = foam.triangles(case / "postProcessing/slice" / time / "middle.vtk")
    speed = np.linalg.norm(vectors, axis=1)
    colours = axes.tripcolor(1e3 * points[:, 1], 1e3 * points[:, 2], corners, speed, shading="gouraud", vmin=0, vmax=largest,
                             cmap="viridis")
    some = np.random.default_rng(1).choice(len(points), min(300, len(points)), replace=False)
    axes.quiver(1e3 * points[some, 1], 1e3 * points[some, 2], vectors[some, 1], vectors[some, 2], scale=15, color="white",
        width=4e-3)
    for name in ("mitral", "aortic"):
        leaflets = foam.triangles(case / "postProcessing" / name / time / "leaflets.vtk")
        lines = [[1e3 * a, 1e3 * b] for a, b in foam.cut(*leaflets[:2])]
        axes.add_collection(matplotlib.collections.LineCollection(lines, colors="white", linewidths=3))
        axes.add_collection(matplotlib.collections.LineCollection(lines, colors=RED, linewidths=1.5))
    axes.set_aspect("equal")
    axes.set_xlim(-32, 32)
    axes.set_ylim(-76, 34)
    axes.set_title(f"{float(time):.2f} s", fontsize=10)
    return colours


def valves(axes, case, time, tilt=25, above=False):
    """Draws the leaflets from below and slightly from the side, as seen from the ventricle, or from above, as seen by a
    surgeon."""
    tilt, up = np.radians(tilt), -1 if above else 1
    for name, colour in (("mitral", ORANGE), ("aortic", BLUE)):
        points, corners, _ = foam.triangles(case / "postProcessing" / name / time / "leaflets.vtk")
        points = 1e3 * points
        seen = np.column_stack([points[:, 1], up * np.cos(tilt) * points[:, 0] + np.sin(tilt) * points[:, 2],
                                up * np.cos(tilt) * points[:, 2] - np.sin(tilt) * points[:, 0]])
        a, b, c = (seen[corners[:, k]] for k in range(3))
        normal = np.cross(b - a, c - a)
        normal /= np.linalg.norm(normal, axis=1)[:, None] + 1e-30
        light = 0.35 + 0.65 * np.abs(normal @ np.array([-0.4, 0.4, 0.82]))
        # Triangles in front, with the smallest height, are drawn last.
        order = np.argsort(-(a + b + c)[:, 2])
        colours = light[order, None] * np.array(matplotlib.colors.to_rgb(colour))
        axes.add_collection(matplotlib.collections.PolyCollection(seen[corners[order]][:, :, :2], facecolors=colours,
                                                                  edgecolors=colours, linewidths=0.3))
    axes.set_aspect("equal")
    axes.set_xlim(-32, 32)
    axes.set_ylim(-19, 19)
    axes.axis("off")


def at_openings(case, beat, times):
    """Returns the written times at the middle of ejection, isovolumetric relaxation, the E wave and the A wave, in this order."""
    last = beat.time > beat.time[-1] - check.PERIOD
    time, aortic, mitral = beat.time[last], beat.aortic[last], beat.mitral[last]
    ejection = time[np.argmax(aortic)]
    e_wave = time[np.argmax(mitral * (time < ejection + 0.45))]
    wanted = (ejection, (ejection + 3 * e_wave) / 4 - 0.03, e_wave, e_wave + 0.2)
    return [min(times, key=lambda name: abs(float(name) - want)) for want in wanted]


def pictures(case, beat, out):
    times = clinic.written(case)
    largest = 1.2
    figure, axes = plt.subplots(2, 4, figsize=(11, 6.2), height_ratios=(2.9, 1), sharey="row",
                                layout="constrained")
    for above, below, time in zip(*axes, at_openings(case, beat, times)):
        colours = slice_at(above, case, time, largest)
        above.set_xlabel("y, mm")
        valves(below, case, time)
    axes[0, 0].set_ylabel("z, mm")
    figure.colorbar(colours, ax=axes[0], label="speed, m/s", shrink=0.8, extend="max")
    figure.savefig(out / "heart.png", dpi=90)
    plt.close(figure)
    if not shutil.which("ffmpeg"):
        print("draw.py: there is no ffmpeg, so there is no movie")
        return
    with tempfile.TemporaryDirectory() as folder:
        for i, time in enumerate(times):
            figure, axes = plt.subplots(2, 1, figsize=(5.6, 8.2), height_ratios=(2.9, 1), layout="constrained")
            figure.colorbar(slice_at(axes[0], case, time, largest), ax=axes[0], label="speed, m/s", shrink=0.8, extend="max")
            axes[0].set(xlabel="y, mm", ylabel="z, mm")
            valves(axes[1], case, time)
            figure.savefig(f"{folder}/{i:04}.png", dpi=100)
            plt.close(figure)
        subprocess.run(["ffmpeg", "-y", "-loglevel", "error", "-framerate", "20", "-i", f"{folder}/%04d.png", "-pix_fmt",
            "yuv420p",
                        "-vf", "pad=ceil(iw/2)*2:ceil(ih/2)*2", str(out / "heart.mp4")], check=True)


def loops(picture, *words):
    """Draws the pressure-volume loop of the last beat of each heart."""
    figure, axes = plt.subplots(figsize=(6.4, 4.6), layout="constrained")
    for case, tables, colour in zip(words[::2], words[1::2], (BLUE, RED, ORANGE, GREEN)):
        beat = check.Beat(pathlib.Path(case))
        model = check.zero_d_at(pathlib.Path(tables) / "zero_d.csv", beat.time)
        last = beat.time > beat.time[-1] - check.PERIOD
        axes.plot((beat.volume - beat.volume[0] + model["volume"][0])[last], beat.ventricle[last], color=colour,
                  label=clinic.name_of(case))
    axes.set_xlabel("volume of the ventricle, ml")
    axes.set_ylabel("pressure, mmHg")
    axes.legend(frameon=False)
    axes.spines[["top", "right"]].set_visible(False)
    figure.savefig(picture, dpi=90)


def hearts(picture, *cases):
    """Draws in a column for each heart: the speed in ejection and in the E wave, and below each the valves from above."""
    figure, axes = plt.subplots(4, len(cases), figsize=(2.9 * len(cases), 11.5), height_ratios=(2.7, 1.2, 2.7, 1.2), sharex=True,
                                squeeze=False, layout="constrained")
    for column, case in zip(axes.T, map(pathlib.Path, cases)):
        ejection, _, e_wave, _ = at_openings(case, check.Beat(case), clinic.written(case))
        for (above, below), time in zip(column.reshape(2, 2), (ejection, e_wave)):
            colours = slice_at(above, case, time, 2)
            above.set(xlim=(-36, 36), ylim=(-78, 42))
            valves(below, case, time, tilt=0, above=True)
            below.set(xlim=(-36, 36), ylim=(-24, 24))
            above.set_title(f"{clinic.name_of(case)}, {float(time):.2f} s", fontsize=10)
    for one in axes[::2, 0]:
        one.set_ylabel("z, mm")
    figure.colorbar(colours, ax=axes[::2], label="speed, m/s", shrink=0.5, extend="max")
    figure.savefig(picture, dpi=90)
    plt.close(figure)


def main(case, model_file, out):
    case, out = pathlib.Path(case), pathlib.Path(out)
    beat = check.Beat(case)
    loop(beat, check.zero_d_at(model_file, beat.time), out / "loop.png")
    pictures(case, beat, out)


if __name__ == "__main__":
    if len(sys.argv) > 4 and sys.argv[1] == "loops" and len(sys.argv) % 2:
        loops(*sys.argv[2:])
    elif len(sys.argv) > 3 and sys.argv[1] == "hearts":
        hearts(*sys.argv[2:])
    elif len(sys.argv) == 4:
        main(*sys.argv[1:])
    else:
        sys.exit(__doc__)
