# SPDX-License-Identifier: Apache-2.0
"""Prints the time that the Python layer adds to riis_mark_nodes, for a million nodes and a prepared mesh.

The library measures its own time within each call (stats.seconds). Every step therefore compares times of the same run: the time
of the call in Python, with views of ids and distances, minus the time of the C function. The printed times are medians over the
steps.
"""

import statistics
import sys
import time

import numpy

import riis

BAR = 1.05


def measure(surface, mesh, n_threads, reuse, n_steps=50):
    """Returns the median times of the C function and of the Python layer, in seconds."""
    own = riis.Marks()
    inside, layer = [], []
    for _ in range(n_steps):
        begin = time.perf_counter()
        marks = riis.mark(surface, mesh, into=own if reuse else None, n_threads=n_threads)
        ids, distance = marks.ids, marks.distance
        end = time.perf_counter()
        assert len(ids) == len(distance) > 1000
        del ids, distance
        inside.append(marks.stats.seconds)
        layer.append(end - begin - marks.stats.seconds)
        del marks
    return statistics.median(inside), statistics.median(layer)


def main():
    # The corners of a box of nodes around each valve. The valve's band contains about 5 % of the nodes, as in ./run bench costs.
    nodes = numpy.random.default_rng(6).uniform(-1.6, 1.6, (1_000_000, 3))
    mesh = riis.Mesh(nodes)
    mesh.prepare()
    failed = False
    print(f"{'valve':8} {'threads':>7} {'result':>7} {'marked':>8} {'C, ms':>8} {'Python adds, µs':>16} {'ratio':>7}")
    for kind in "aortic", "mitral":
        surface = riis.Surface(riis.Valve(kind))
        n_marked = len(riis.mark(surface, mesh))
        for n_threads in 1, 2:
            for reuse in True, False:
                inside, layer = measure(surface, mesh, n_threads, reuse)
                ratio = 1.0 + layer / inside
                failed |= ratio > BAR
                print(
                    f"{kind:8} {n_threads:7} {'reused' if reuse else 'new':>7} {n_marked:8} {1e3 * inside:8.2f} "
                    f"{1e6 * layer:16.1f} {ratio:7.4f}"
                )
    if failed:
        print(f"the Python layer takes more than {BAR - 1:.0%} of the C function's time", file=sys.stderr)
    return failed


if __name__ == "__main__":
    sys.exit(main())
