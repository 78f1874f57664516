# SPDX-License-Identifier: Apache-2.0
"""embree_cost.py PYTHON OTHER_PYTHON: compares the costs of the parts of riis that use Embree, in the packages of two Pythons.

These are, for example, the wheel with its own Embree and a package with the system's.

Both take turns, on one thread, and their processor time counts. The table has the shortest of all turns, and the ratio of the
first to the second.
"""

import json
import subprocess
import sys
import time

N_TURNS, N_POINTS = 9, 60  # so few points are queried one by one, also those of a coarse surface


def least(call, n_calls):
    """Returns the shortest processor time of five times n_calls calls, in microseconds for each call."""
    times = []
    for _ in range(5):
        begin = time.process_time()
        for _ in range(n_calls):
            call()
        times.append(time.process_time() - begin)
    return 1e6 * min(times) / n_calls


def measure():
    import numpy
    import riis

    found = {}
    box = numpy.random.default_rng(5).uniform(-1.6, 1.6, (N_POINTS, 3))
    for kind in "aortic", "mitral":
        valves = [riis.Valve(kind, opening=opening) for opening in (0.5, 0.6)]
        surface = riis.Surface(valves[0], n_threads=1)
        only = dict(point=False, normal=False, triangle_id=False, leaflet_id=False, n_threads=1)
        for name, limit in ("a query without a limit", numpy.inf), ("a query within 0.2 cm", 0.2):
            microseconds = least(lambda: surface.closest_points(box, distance_limit=limit, **only), 100) / N_POINTS
            found[f"{kind}, {name}"] = microseconds
        found[f"{kind}, an update"] = least(lambda: [surface.update(valve, n_threads=1) for valve in valves], 10) / 2
    print(json.dumps(found))


def main(pythons):
    turns = [[], []]
    for _ in range(N_TURNS):
        for python, found in zip(pythons, turns, strict=True):
            done = subprocess.run([python, "-B", __file__], check=True, stdout=subprocess.PIPE)
            found.append(json.loads(done.stdout))
    print(f"{'processor time, µs':40} {'first':>8} {'second':>8} {'ratio':>6}")
    for name in turns[0][0]:
        first, second = (min(turn[name] for turn in found) for found in turns)
        print(f"{name:40} {first:8.2f} {second:8.2f} {first / second:6.2f}")


if __name__ == "__main__":
    if len(sys.argv) == 3:
        main(sys.argv[1:])
    elif len(sys.argv) == 1:
        measure()
    else:
        sys.exit("usage: embree_cost.py PYTHON OTHER_PYTHON")
