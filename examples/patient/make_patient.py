#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Makes a synthetic patient: a segmented aortic root and the landmarks that a clinician would set in it.

make_patient.py FOLDER [--seed N] [--random] [--noise MM] [--attachment N] [--measure FILE.vtp]

Writes two files into FOLDER. root.stl is a closed surface in millimetres with flat ends. landmarks.mrk.json has three commissures
and three nadirs, as 3D Slicer writes them. Axes are LPS: x to the left, y to the back, z upwards. The root lies obliquely, and
all cusps are different. The seed determines the landmarks' noise and the waves of the wall. With --random the seed also
determines everything else. With --attachment there are also landmarks along the attachment. The root contains no curves of riis,
so it tests whether a valve of riis fits. With --measure the script writes no file, and prints a distance in millimetres. 95 % of
a valve's attachment lie within this distance of the patient's attachment. The valve is a file of riis surface --output without a
skirt. The script needs only the modules of Python itself.
"""
import argparse
import json
import math
import os
import random
import re
import struct

ROUGHNESS = 0.3  # largest height of the waves on the segmented wall, in millimetres
BOTTOM, TOP = -14.0, 60.0  # the segmentation ends in the outflow tract and in the aorta
N_ANGLES, SPACING, N_RINGS = 132, 0.7, 9  # of the triangles
CUSPS = ["right", "left", "non_coronary"]  # counter-clockwise seen against the flow


def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def unit(a):
    length = math.sqrt(sum(x * x for x in a))
    return [x / length for x in a]


def smooth_step(x):
    x = min(1.0, max(0.0, x))
    return x * x * (3 - 2 * x)


class Root:
    """A root, in millimetres. The axis of the root is z along the flow, from the annulus. The middle of the right cusp is near
    angle 0."""

    def __init__(self):
        self.commissures = [(65.0, 18.2), (165.0, 15.5), (295.0, 16.8)]  # angle and height, after each cusp
        self.nadirs = [0.5, -0.7, 0.2]       # heights
        self.annulus = (13.4, 11.6, 30.0)    # half axes of the ellipse, and the direction of the longer one in degrees
        self.junction = (13.5, 21.0)         # radius and height of the sinotubular junction
        self.aorta_radius = 14.5
        self.sinus_depth = 4.0
        self.put((-14.3, -172.6, -1083.4), (-0.42, -0.33, 0.845), (0.1, -1.0, 0.0))

    @classmethod
    def drawn(cls, rng):
        """Returns a random root."""
        root = cls()
        sectors = [120 + rng.uniform(-18, 18) for _ in CUSPS]
        sectors = [360 * sector / sum(sectors) for sector in sectors]
        height = rng.uniform(15.5, 18)
        ends = [sectors[0] / 2, sectors[0] / 2 + sectors[1], 360 - sectors[0] / 2]
        root.commissures = [(end, height + rng.uniform(-1.5, 1.5)) for end in ends]
        root.nadirs = [rng.uniform(-0.8, 0.8) for _ in CUSPS]
        radius, ratio = rng.uniform(11.5, 13.5), rng.uniform(1, 1.25)
        root.annulus = (radius * math.sqrt(ratio), radius / math.sqrt(ratio), rng.uniform(0, 180))
        root.junction = (radius * rng.uniform(1, 1.12), height + rng.uniform(3, 5))
        root.aorta_radius = root.junction[0] * rng.uniform(1, 1.15)
        root.sinus_depth = rng.uniform(2.5, 5)
        axis = [rng.uniform(-0.7, 0.3), rng.uniform(-0.6, 0.4), rng.uniform(0.5, 1)]
        root.put([rng.uniform(-30, 30), rng.uniform(-200, -100), rng.uniform(-1300, -700)], axis,
                 [rng.uniform(-0.4, 0.4), -1, 0])
        return root

    def put(self, centre, axis, front):
        """Puts the annulus at a centre in the scanner, with the flow along the axis and the right cusp towards the front."""
        self.centre = centre
        self.e3 = unit(axis)
        self.e2 = unit(cross(self.e3, front))
        self.e1 = cross(self.e2, self.e3)

    def placed(self, degrees, radius, z):
        """Returns the point in the scanner's axes."""
        x, y = radius * math.cos(math.radians(degrees)), radius * math.sin(math.radians(degrees))
        return tuple(self.centre[k] + x * self.e1[k] + y * self.e2[k] + z * self.e3[k] for k in range(3))

    def sector(self, cusp):
        """Returns the first angle of a cusp, and the width of the cusp."""
        first, last = self.commissures[cusp - 1][0], self.commissures[cusp][0]
        return first, (last - first) % 360

    def cusp_at(self, degrees):
        """Returns the cusp at an angle, and the place in it: -1 and 1 are its commissures."""
        for cusp in range(3):
            first, width = self.sector(cusp)
            after = (degrees - first) % 360
            if after <= width:
                return cusp, 2 * after / width - 1
        raise AssertionError(degrees)

    def attachment_height(self, cusp, place):
        """Returns the height at which a cusp is attached: flat at the nadir, steep at the commissures."""
        commissure, nadir = self.commissures[cusp if place > 0 else cusp - 1][1], self.nadirs[cusp]
        return nadir + (commissure - nadir) * (1 - (1 - place * place) ** 0.6)

    def tube_radius(self, degrees, z):
        """Returns the radius without the sinuses. The cusps are attached at this radius."""
        a, b, direction = self.annulus
        angle = math.radians(degrees - direction)
        ellipse = a * b / math.hypot(b * math.cos(angle), a * math.sin(angle))
        radius, height = self.junction
        up = smooth_step(z / height)
        return (1 - up) * ellipse + up * radius + (self.aorta_radius - radius) * smooth_step((z - height) / (TOP - height))

    def sinus(self, degrees, z):
        """Returns how far the wall bulges beyond the tube, above the attachment."""
        cusp, place = self.cusp_at(degrees)
        bottom = self.attachment_height(cusp, place)
        share = (z - bottom) / (self.junction[1] - bottom)
        if not 0 < share < 1:
            return 0.0
        return self.sinus_depth * (1 - place ** 4) ** 2 * math.sin(math.pi * share ** 0.7)

    def on_attachment(self, cusp, place):
        """Returns the point of a cusp's attachment at a place in its sector."""
        first, width = self.sector(cusp)
        degrees, z = first + 0.5 * (place + 1) * width, self.attachment_height(cusp, place)
        return self.placed(degrees, self.tube_radius(degrees, z), z)

    def half_attachment(self, cusp, side, n=120):
        """Returns n + 1 points of half a cusp's attachment, evenly by length from its nadir to a commissure."""
        # The curve is steep at the commissure, so places lie close together near the commissure.
        points = [self.on_attachment(cusp, side * (1 - (1 - i / 2000) ** 3)) for i in range(2001)]
        behind = [0.0]
        for p, q in zip(points, points[1:]):
            behind.append(behind[-1] + math.dist(p, q))
        made, k = [], 0
        for i in range(n + 1):
            while k + 1 < len(points) and behind[k] < behind[-1] * i / n - 1e-12:
                k += 1
            made.append(points[k])
        return made

    def landmarks(self, n_attachment=0):
        """Returns the landmarks without noise, as pairs of name and point: n_attachment of them inside each half attachment."""
        made = []
        for cusp, name in enumerate(CUSPS):
            first, width = self.sector(cusp)
            z = self.nadirs[cusp]
            made.append(("nadir_" + name, self.placed(first + width / 2, self.tube_radius(first + width / 2, z), z)))
        for cusp, (degrees, z) in enumerate(self.commissures):
            name = "commissure_" + CUSPS[cusp] + "_" + CUSPS[(cusp + 1) % 3]
            made.append((name, self.placed(degrees, self.tube_radius(degrees, z), z)))
        for cusp, name in enumerate(CUSPS):
            for side in 1, -1:
                half = self.half_attachment(cusp, side, n_attachment + 1)
                for number in range(1, n_attachment + 1):
                    at = number if side > 0 else n_attachment + number
                    made.append((f"attachment_{name}_{at}", half[number]))
        return made

    def distance_from_attachment(self, cloud):
        """Returns the distances of points from the attachment."""
        lines = [self.half_attachment(cusp, side) for cusp in range(3) for side in (1, -1)]
        return [min(distance_from_segment(p, a, b) for line in lines for a, b in zip(line, line[1:])) for p in cloud]


def distance_from_segment(p, a, b):
    along, to = [y - x for x, y in zip(a, b)], [y - x for x, y in zip(a, p)]
    size = sum(x * x for x in along)
    t = min(1.0, max(0.0, sum(x * y for x, y in zip(along, to)) / size)) if size > 0 else 0.0
    return math.dist(p, [x + t * y for x, y in zip(a, along)])


def attachment_of(path):
    """Returns the vertices of a valve's surface that lie on its attachment, where u = 1. The file is that of riis surface."""
    with open(path, "rb") as file:
        data = file.read()
    start = data.index(b"_", data.index(b"<AppendedData")) + 1

    def array(name):
        element = re.search(rb'<DataArray type="Float64" Name="' + name + rb'"[^>]*offset="(\d+)"', data)
        at = start + int(element[1])
        size, = struct.unpack_from("<Q", data, at)
        return struct.unpack_from(f"<{size // 8}d", data, at + 8)

    uv, xyz = array(b"riis_uv"), array(b"Points")
    return [xyz[3 * i:3 * i + 3] for i in range(len(uv) // 2) if uv[2 * i] == 1]


def waves(rng):
    """Returns a function of smooth waves, periodic in the angle."""
    parts = [(rng.randint(0, 12), rng.uniform(-0.9, 0.9), rng.uniform(0, 2 * math.pi)) for _ in range(24)]
    return lambda degrees, z: ROUGHNESS / 24 * sum(
        math.sin(n * math.radians(degrees) + k * z + phase) for n, k, phase in parts)


def wall_triangles(root, rough):
    """Returns the triangles of the closed surface, with normals outwards."""
    n_heights = round((TOP - BOTTOM) / SPACING)
    heights = [BOTTOM + (TOP - BOTTOM) * k / n_heights for k in range(n_heights + 1)]
    angles = [360 * i / N_ANGLES for i in range(N_ANGLES)]
    radius = [[root.tube_radius(a, z) + root.sinus(a, z) + rough(a, z) for a in angles] for z in heights]
    # The rows of points run from the middle of the lower end to the middle of the upper end.
    rows = [(0, j / N_RINGS) for j in range(N_RINGS)] + [(k, 1.0) for k in range(n_heights + 1)]
    rows += [(n_heights, j / N_RINGS) for j in range(N_RINGS - 1, -1, -1)]
    points = [[root.placed(a, share * radius[k][i], heights[k]) for i, a in enumerate(angles)] for k, share in rows]
    for lower, upper, (_, from_share), (_, to_share) in zip(points, points[1:], rows, rows[1:]):
        for i in range(N_ANGLES):
            j = (i + 1) % N_ANGLES
            if from_share > 0:
                yield lower[i], lower[j], upper[j] if to_share > 0 else upper[0]
            if to_share > 0:
                yield lower[i] if from_share > 0 else lower[0], upper[j], upper[i]


def write_stl(path, triangles):
    triangles = list(triangles)
    with open(path, "wb") as file:
        file.write(b"synthetic aortic root, millimetres, LPS".ljust(80) + struct.pack("<I", len(triangles)))
        for a, b, c in triangles:
            normal = unit(cross([q - p for p, q in zip(a, b)], [q - p for p, q in zip(a, c)]))
            file.write(struct.pack("<12fH", *normal, *a, *b, *c, 0))


def write_landmarks(path, root, rng, noise, n_attachment=0):
    points = [{"id": str(i + 1), "label": name, "position": [round(x + rng.gauss(0, noise), 3) for x in place],
               "positionStatus": "defined"} for i, (name, place) in enumerate(root.landmarks(n_attachment))]
    markups = {"type": "Fiducial", "coordinateSystem": "LPS", "coordinateUnits": "mm", "controlPoints": points}
    with open(path, "w", encoding="utf-8") as file:
        json.dump({"markups": [markups]}, file, indent=1)
        file.write("\n")


def main():
    arguments = argparse.ArgumentParser(description="makes a synthetic patient: root.stl and landmarks.mrk.json")
    arguments.add_argument("folder")
    arguments.add_argument("--seed", type=int, default=1)
    arguments.add_argument("--random", action="store_true", help="draw the root and its place also")
    arguments.add_argument("--noise", type=float, default=0.3, help="of the landmarks' coordinates, in millimetres (default 0.3)")
    arguments.add_argument("--attachment", type=int, default=0, help="points of the attachment in each half cusp (default 0)")
    arguments.add_argument("--measure", help="compare the attachment of this valve's surface with the patient's")
    options = arguments.parse_args()
    rng = random.Random(options.seed)
    root = Root.drawn(rng) if options.random else Root()
    if options.measure:
        off = sorted(root.distance_from_attachment(attachment_of(options.measure)))
        print(f"{off[math.ceil(0.95 * len(off)) - 1]:.3f}")
        return
    os.makedirs(options.folder, exist_ok=True)
    write_stl(os.path.join(options.folder, "root.stl"), wall_triangles(root, waves(rng)))
    write_landmarks(os.path.join(options.folder, "landmarks.mrk.json"), root, rng, options.noise,
                    options.attachment)


if __name__ == "__main__":
    main()
