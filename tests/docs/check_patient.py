# SPDX-License-Identifier: Apache-2.0
"""check_patient.py MAKE_PATIENT.py SCRATCH: checks the files of the synthetic patient.

The surface must be closed, with normals outwards and the volume that follows from the radii. Each run must give the same surface.
Landmarks without noise must lie on the surface, and noise must be as large as stated.
"""
import importlib.util
import json
import math
import pathlib
import random
import shutil
import struct
import subprocess
import sys


def read_stl(path):
    data = path.read_bytes()
    (n,) = struct.unpack_from("<I", data, 80)
    assert len(data) == 84 + 50 * n, f"{path}: {len(data)} bytes for {n} triangles"
    rows = [struct.unpack_from("<12f", data, 84 + 50 * i) for i in range(n)]
    return [(row[:3], row[3:6], row[6:9], row[9:12]) for row in rows]


def read_landmarks(path):
    (markups,) = json.loads(path.read_text(encoding="utf-8"))["markups"]
    assert (markups["coordinateSystem"], markups["coordinateUnits"]) == ("LPS", "mm")
    return {point["label"]: point["position"] for point in markups["controlPoints"]}


def check_surface(patient, root, triangles):
    edges = {}
    volume = 0.0
    for normal, *corners in triangles:
        for a, b in zip(corners, corners[1:] + corners[:1]):
            edges[a, b] = edges.get((a, b), 0) + 1
        a, b, c = ([x - origin for x, origin in zip(corner, root.centre)] for corner in corners)
        area = patient.cross([q - p for p, q in zip(a, b)], [q - p for p, q in zip(a, c)])
        assert sum(x * y for x, y in zip(area, normal)) > 0, f"the normal {normal} is not that of the corners {corners}"
        volume += sum(x * y for x, y in zip(a, patient.cross(b, c))) / 6
    for (a, b), n in edges.items():
        assert n == 1 and edges.get((b, a)) == 1, f"the edge from {a} to {b} has {n} triangles, its reverse {edges.get((b, a))}"
    # The volume is 1/2 r^2, integrated over angles and heights. The waves of the wall change it by a thousandth.
    n_angles, n_heights = 120, 100
    height = patient.TOP - patient.BOTTOM
    expected = sum((root.tube_radius(angle, z) + root.sinus(angle, z)) ** 2 / 2
                   for angle in (360 * (i + 0.5) / n_angles for i in range(n_angles))
                   for z in (patient.BOTTOM + height * (k + 0.5) / n_heights for k in range(n_heights))
                   ) * 2 * math.pi / n_angles * height / n_heights
    assert abs(volume / expected - 1) < 0.005, f"the volume is {volume}, not {expected}"


def check_landmarks(patient, root, triangles, folder):
    vertices = {corner for _, *corners in triangles for corner in corners}
    true = dict(root.landmarks())
    for name, place in true.items():
        away = min(math.dist(place, vertex) for vertex in vertices)
        assert away < 0.6 + patient.ROUGHNESS, f"{name} is {away} mm from the surface"
    squares = []
    for seed in range(40):
        patient.write_landmarks(folder / "noisy.mrk.json", root, random.Random(seed), 0.3)
        squares += [(x - y) ** 2 for name, place in read_landmarks(folder / "noisy.mrk.json").items()
                    for x, y in zip(place, true[name])]
    noise = math.sqrt(sum(squares) / len(squares))
    assert abs(noise - 0.3) < 0.03, f"the noise is {noise}, not 0.3"  # 4 standard errors of 720 numbers


def main(script, scratch):
    spec = importlib.util.spec_from_file_location("make_patient", script)
    patient = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(patient)
    scratch = pathlib.Path(scratch)
    shutil.rmtree(scratch, ignore_errors=True)
    made = {}
    for folder, options in ("one", []), ("two", []), ("random", ["--random", "--seed", "7"]):
        subprocess.run([sys.executable, "-B", script, scratch / folder, *options], check=True)
        made[folder] = {file.name: file.read_bytes() for file in (scratch / folder).iterdir()}
    assert made["one"] == made["two"], "the files differ from run to run"
    for folder, root in ("one", patient.Root()), ("random", patient.Root.drawn(random.Random(7))):
        triangles = read_stl(scratch / folder / "root.stl")
        check_surface(patient, root, triangles)
        check_landmarks(patient, root, triangles, scratch)
        print(f"{folder}: {len(triangles)} triangles and {len(root.landmarks())} landmarks are right")


if __name__ == "__main__":
    main(*sys.argv[1:])
