# SPDX-License-Identifier: Apache-2.0
"""Draws the beat of ./run nek5000: draw.py RUN PICTURE, with RUN/log."""
import os
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt

from check import Flow, lines_of, numbers

# These colours can be distinguished with every kind of colour vision (Okabe, Ito 2008), as in the pictures of riis.
BLUE, ORANGE, GREEN = "#0072b2", "#e69f00", "#009e73"


def draw(run, path):
    runs, name = os.path.split(os.path.abspath(run))
    flow = Flow(runs, name)
    orifice = numbers(lines_of(runs, name, "RIIS_ORIFICE")[0])[0]
    figure, axes = plt.subplots(4, 1, figsize=(8, 9), sharex=True, constrained_layout=True)
    axes[0].plot(flow.time, flow.opening, color=BLUE)
    axes[0].set_ylabel("opening")
    axes[1].plot(flow.time, flow.drive, color=BLUE)
    axes[1].set_ylabel("pressure over the pipe, dyn/cm$^2$")
    axes[2].plot(flow.time, flow.inflow, color=BLUE, label="inflow")
    axes[2].plot(flow.time, flow.outflow, color=ORANGE, linestyle="--", label="outflow")
    axes[2].plot(flow.time, flow.source, color=GREEN, label="source of the band")
    axes[2].set_ylabel("ml/s")
    axes[2].legend()
    axes[3].plot(flow.time, flow.speed, color=BLUE, label="largest speed")
    axes[3].axhline(2 * max(flow.outflow) / orifice, color=ORANGE, linestyle="--", label="2 x peak flow / open orifice")
    axes[3].set_ylabel("cm/s")
    axes[3].set_xlabel("time, s")
    axes[3].legend()
    figure.savefig(path, dpi=90)


if __name__ == "__main__":
    if len(sys.argv) != 3:
        raise SystemExit(__doc__)
    draw(*sys.argv[1:])
