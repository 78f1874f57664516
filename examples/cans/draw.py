# SPDX-License-Identifier: Apache-2.0
"""draw.py RUNS PICTURE: draws the lag of the pressure and the opening valve, from the runs of ./run cans."""
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt

from check import WAYS, formula, read_run

# These colours can be distinguished with every kind of colour vision (Okabe, Ito 2008), as in the pictures of riis.
COLOURS = ("#0072b2", "#e69f00", "#009e73", "#d55e00", "#cc79a7", "#000000")


def main(runs, picture):
    figure, (lags, opening) = plt.subplots(1, 2, figsize=(11, 4), constrained_layout=True)
    for way, colour in zip(("sweeps-1", "sweeps-8", "cg-4", "cg-16", "jump", "jump-cg-2"), COLOURS):
        run = read_run(runs, f"leaning-4394.53-{way}")
        lags.plot(run["step"][:40], [drop / formula(4394.53, 20) for drop in run["drop"][:40]], color=colour, label=WAYS[way][0])
    lags.axhspan(0.98, 1.02, color="0.9")
    lags.set(title="A leaning plate, K dt/rho = 2,000", xlabel="time step", ylabel="drop / ((R/eps) u cos 20°)", ylim=(0, 1.1))
    lags.legend(fontsize=8)
    for way, colour in zip(("sweeps-1", "jump", "jump-cg-1", "cg-30"), COLOURS):
        run = read_run(runs, f"opening-{way}")
        title = WAYS[way][0] if way in WAYS else "30 iterations of CG"
        opening.plot([1e3 * time for time in run["time"]], run["flow"], color=colour, label=title)
    opening.set(title="A trileaflet valve opens from 10 to 50 ms", xlabel="ms", ylabel="mean velocity, cm/s")
    opening.legend(fontsize=8)
    figure.savefig(picture, dpi=120)


if __name__ == "__main__":
    main(*sys.argv[1:])
