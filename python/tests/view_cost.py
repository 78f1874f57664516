# SPDX-License-Identifier: Apache-2.0
"""Measures the moves of riis.view.model.Model: python view_cost.py [N_NODES] [near]. Prints the median of 50 moves.

A move sets the opening or the origin, and marks again. The mesh is a tube of tetrahedra around a valve of each kind. With
"near", it is a wider and longer tube of the size of a heart, and the model works with the cells near the valve.
"""

import statistics
import sys
import time

import numpy
import tube

from riis.view.model import KINDS, Model


def moves(model: Model, i: int) -> list[float]:
    """Returns the milliseconds of 50 moves."""
    seconds = []
    for k in range(50):
        start = time.perf_counter()
        if k % 2:
            model.set(i, "opening", k / 50)
        else:
            model.place(i, origin=(0.05 * numpy.sin(k), 0.05 * numpy.cos(k), 0.0))
        model.update()
        seconds.append(1e3 * (time.perf_counter() - start))
    return seconds


def main() -> None:
    n_nodes = int(sys.argv[1]) if len(sys.argv) > 1 else 100_000
    near = "near" in sys.argv[2:]
    start = time.perf_counter()
    points, cells = tube.of_nodes(n_nodes, 4.0, 24.0) if near else tube.of_nodes(n_nodes)
    print(f"{len(points):,} nodes, {len(cells):,} tetrahedra, made in {time.perf_counter() - start:.1f} s")
    start = time.perf_counter()
    model = (Model.near if near else Model)(points, cells, unit="cm")
    print(f"opened in {time.perf_counter() - start:.2f} s")
    for kind in KINDS:
        i = model.add(kind)
        start = time.perf_counter()
        model.update()
        first = time.perf_counter() - start
        times = moves(model, i)
        start = time.perf_counter()
        model.lights()
        lights = time.perf_counter() - start
        print(f"{kind:10} first {first:6.2f} s, move median {statistics.median(times):6.2f} ms, "
              f"most {max(times):6.2f} ms, lights {lights:5.2f} s, {len(model.update().marked):,} nodes marked")
        model.remove(i)


if __name__ == "__main__":
    main()
