# SPDX-License-Identifier: Apache-2.0
"""Gives the nodes and triangles from riis_bench_peers to Python packages. Compares the packages' marks, measures the packages'
times, and writes both as JSON.

This script runs in a virtual environment that study.py makes. If a package is missing, the script omits it and gives the reason.
The process uses one processor, so packages with several threads have no advantage."""

import argparse
import collections
import importlib
import importlib.metadata
import json
import os
import sys
import time

HALF_THICKNESS = 0.1
TURNS = 5
# The errors that double and single precision may have for coordinates of some centimetres.
ROUNDING, SINGLE = 1e-12, 2e-6


def libigl(np, nodes, vertices, triangles):
    igl = importlib.import_module("igl")
    return lambda: np.sqrt(igl.point_mesh_squared_distance(nodes, vertices, triangles)[0])


def point_cloud_utils(np, nodes, vertices, triangles):
    pcu = importlib.import_module("point_cloud_utils")
    return lambda: pcu.closest_points_on_mesh(nodes, vertices, triangles)[0]


def open3d(np, nodes, vertices, triangles):
    o3d = importlib.import_module("open3d")
    scene = o3d.t.geometry.RaycastingScene(nthreads=1)
    scene.add_triangles(o3d.core.Tensor(vertices.astype(np.float32)), o3d.core.Tensor(triangles.astype(np.uint32)))
    asked = o3d.core.Tensor(nodes.astype(np.float32))
    return lambda: scene.compute_distance(asked, nthreads=1).numpy()


def fcpw(np, nodes, vertices, triangles, radius=HALF_THICKNESS):
    package = importlib.import_module("fcpw")
    scene = package.scene_3D()
    scene.set_object_count(1)
    scene.set_object_vertices(np.asfortranarray(vertices, dtype=np.float32), 0)
    scene.set_object_triangles(np.asfortranarray(triangles, dtype=np.int32), 0)
    scene.build(package.aggregate_type.bvh_surface_area, True)
    asked = np.asfortranarray(nodes, dtype=np.float32)
    squared_radii = np.full(len(nodes), radius**2, dtype=np.float32)
    found = package.interaction_3D_list()

    def ask():
        scene.find_closest_points(asked, squared_radii, found)
        return None

    # The list of results becomes an array after the timing, so the conversion is not timed.
    ask.read = lambda: np.array([at.d if at.primitive_index != 2**32 - 1 and at.d >= 0 else np.inf for at in found])
    return ask


def fcpw_everywhere(np, nodes, vertices, triangles):
    return fcpw(np, nodes, vertices, triangles, float("inf"))


# name: (package on PyPI, function that queries it, description)
PEERS = {
    "libigl": ("libigl", libigl, "double, no bound"),
    "point-cloud-utils": ("point-cloud-utils", point_cloud_utils, "double, no bound"),
    "open3d": ("open3d", open3d, "single, no bound"),
    "fcpw": ("fcpw", fcpw, "single, bounded"),
    "fcpw, every distance": ("fcpw", fcpw_everywhere, "single, no bound"),
}


def compared(np, truth, distance):
    """Compares distances with the truth, as riis_bench_peers does. Counts, by reason, the nodes that are marked differently."""
    by_peer, marked = distance <= HALF_THICKNESS, truth <= HALF_THICKNESS
    reasons = collections.Counter()
    for i in np.flatnonzero(by_peer != marked):
        margin = abs(truth[i] - HALF_THICKNESS)
        if margin <= ROUNDING:
            reasons["rounding"] += 1
        elif margin <= SINGLE:
            reasons["float"] += 1
        elif marked[i] and np.isinf(distance[i]):
            reasons["radius"] += 1
        else:
            reasons["unexplained"] += 1
    both = by_peer & marked
    largest = float(np.abs(distance[both] - truth[both]).max()) if both.any() else 0.0
    return {
        "marked": int(by_peer.sum()),
        "different": int((by_peer != marked).sum()),
        "reasons": dict(reasons),
        "largest_difference": largest,
        "largest_anywhere": float(np.abs(distance - truth)[np.isfinite(distance)].max(initial=0)),
    }


def measure(np, folder, kind):
    def read(name, dtype, columns):
        numbers = np.fromfile(os.path.join(folder, f"{kind}_{name}"), dtype=dtype)
        return numbers.reshape(-1, columns) if columns > 1 else numbers

    nodes, vertices = read("nodes.f64", np.float64, 3), read("vertices.f64", np.float64, 3)
    triangles, truth = read("triangles.i64", np.int64, 3), read("distances.f64", np.float64, 1)
    out = {"nodes": len(nodes), "triangles": len(triangles), "marks": {}, "times": {}, "made": {}, "left_out": {}, "notes": {}}
    for name, (package, make, note) in PEERS.items():
        try:
            start = time.perf_counter()
            ask = make(np, nodes, vertices, triangles)
            made = 1e3 * (time.perf_counter() - start)
            version = importlib.metadata.version(package)
            answer = ask()
        except Exception as error:  # whatever error a package raises, the package is left out with this reason
            out["left_out"][name] = f"not available: {type(error).__name__}: {error}".splitlines()[0]
            continue
        label = f"{name} {version}"
        out["marks"][label] = compared(np, truth, ask.read() if answer is None else np.asarray(answer, dtype=np.float64))
        out["notes"][label] = note
        out["made"][label] = made
        times = []
        for _ in range(TURNS):
            start = time.perf_counter()
            ask()
            times.append(1e3 * (time.perf_counter() - start))
        times.sort()
        out["times"][label] = {"least_ms": times[0], "median_ms": times[TURNS // 2], "turns": TURNS}
    return out


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("folder", help="where riis_bench_peers wrote nodes and triangles")
    parser.add_argument("out", help="the JSON file to write")
    arguments = parser.parse_args()
    os.sched_setaffinity(0, {min(os.sched_getaffinity(0))})
    os.environ["OMP_NUM_THREADS"] = "1"
    try:
        import numpy as np
    except ImportError as error:
        sys.exit(f"peers.py: {error}")
    result = {kind: measure(np, arguments.folder, kind) for kind in ("aortic", "mitral")}
    with open(arguments.out, "w", encoding="utf-8") as file:
        json.dump(result, file, indent=2, sort_keys=True)
        file.write("\n")


if __name__ == "__main__":
    main()
