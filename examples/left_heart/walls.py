# SPDX-License-Identifier: Apache-2.0
"""Compares the open aortic valve with the same leaflets as walls, for ./run heart --walls.

    walls.py faces CASE LEAFLETS.vtk    # writes the set `leaflets` of faces of the mesh, which become walls
    walls.py table WALLS BAND [BAND ...]    # prints flow, fastest blood and jet area of the cases

A face becomes a wall if the leaflets cut the line between the centres of its two cells. The walls are therefore staircases.
"""
import pathlib
import sys

import numpy as np

import check
import clinic
import zero_d
from zero_d import ML, MMHG, RHO, foam

LAST = 0.1  # s: the flow is steady then, and numbers are means over this last part of the run


def inner_faces(mesh):
    """Returns owner and neighbour of the inner faces, and the centres of all cells. All cells are tetrahedra."""
    points = foam.vectors(mesh / "points")
    faces = zero_d.triangles(mesh / "faces")
    owner, neighbour = foam.labels(mesh / "owner"), foam.labels(mesh / "neighbour")
    # Each corner of a tetrahedron belongs to three of its four faces.
    sums, corners = np.zeros((foam.n_cells(mesh), 3)), points[faces].sum(axis=1)
    np.add.at(sums, owner, corners)
    np.add.at(sums, neighbour, corners[: len(neighbour)])
    return owner[: len(neighbour)], neighbour, sums / 12


def crossed(start, end, points, corners):
    """Tells for each line from start to end whether a triangle cuts it."""
    found = np.zeros(len(start), bool)
    low, high = np.minimum(start, end), np.maximum(start, end)
    for a, b, c in points[corners]:
        near = np.flatnonzero(((high >= np.minimum(np.minimum(a, b), c)) & (low <= np.maximum(np.maximum(a, b), c))).all(axis=1))
        along = end[near] - start[near]
        # start + t along = a + u (b - a) + v (c - a)
        normal = np.cross(b - a, c - a)
        with np.errstate(divide="ignore", invalid="ignore"):
            inverse = -1 / (along @ normal)
            from_a = start[near] - a
            t = (from_a @ normal) * inverse
            turned = np.cross(along, from_a)
            u, v = (turned @ (c - a)) * -inverse, (turned @ (b - a)) * inverse
        found[near[(t >= 0) & (t <= 1) & (u >= 0) & (v >= 0) & (u + v <= 1)]] = True
    return found


def regions(n_cells, owner, neighbour):
    """Returns the number of each cell's region: the least number of a cell that can be reached through the given faces."""
    region, before = np.arange(n_cells), None
    while not np.array_equal(region, before):
        before = region.copy()
        least = np.minimum(region[owner], region[neighbour])
        np.minimum.at(region, owner, least)
        np.minimum.at(region, neighbour, least)
    return region


def without_pockets(wall, owner, neighbour, n_cells):
    """Opens one wall of each pocket that walls enclose, because the pressure there would have no level."""
    wall = wall.copy()
    while True:
        region = regions(n_cells, owner[~wall], neighbour[~wall])
        between = np.flatnonzero(wall & (region[owner] != region[neighbour]))
        if not len(between):
            return wall
        wall[between[0]] = False


def faces(case, leaflets):
    mesh = pathlib.Path(case) / "constant/polyMesh"
    owner, neighbour, centres = inner_faces(mesh)
    points, corners, _ = foam.triangles(leaflets)
    wall = crossed(centres[owner], centres[neighbour], points, corners)
    found = np.flatnonzero(without_pockets(wall, owner, neighbour, len(centres)))
    if not len(found):
        sys.exit(f"walls.py: the leaflets of {leaflets} cut no line between cells of {case}")
    (mesh / "sets").mkdir(exist_ok=True)
    (mesh / "sets/leaflets").write_text("FoamFile { version 2.0; format ascii; class faceSet; object leaflets; }\n"
                                        f"{len(found)}\n(\n" + "\n".join(map(str, found)) + "\n)\n", encoding="ascii")
    print(f"{len(found)} faces become walls")


def numbers(case):
    """Returns means over the end of the run: flow in ml/s, pressure difference in mmHg, and the fastest blood in the aorta."""
    case = pathlib.Path(case)
    flow = foam.table(case, "outflow")
    late = flow[:, 0] > flow[-1, 0] - LAST
    pressure = (check.pressure_of(case, "ventricle") - check.pressure_of(case, "aorta"))[late, 1]
    jets = []
    for time in clinic.written(case):
        if float(time) > flow[-1, 0] - LAST:
            points, _, velocity = foam.triangles(case / "postProcessing/slice" / time / "middle.vtk")
            jets.append(clinic.jet(points[:, 1:], velocity[:, 1:]))
    return flow[late, 1].mean() / ML, pressure.mean(), np.mean(jets)


def table(walls, *bands):
    print("| aortic valve, open | flow, ml/s | pressure difference, mmHg | effective area, cm2 | fastest blood, m/s |"
          " jet area, cm2 | over that of walls |\n|---|---|---|---|---|---|---|")
    whole = None
    for case in (walls, *bands):
        flow, difference, fastest = numbers(case)
        effective, jet = flow * ML * np.sqrt(RHO / (2 * difference * MMHG)) * 1e4, flow * ML / fastest * 1e4
        whole = whole or jet
        print(f"| {pathlib.Path(case).name} | {flow:.0f} | {difference:.1f} | {effective:.2f} | {fastest:.2f} | {jet:.2f} | "
              f"{jet / whole:.2f} |")


if __name__ == "__main__":
    if len(sys.argv) == 4 and sys.argv[1] == "faces":
        faces(*sys.argv[2:])
    elif len(sys.argv) > 3 and sys.argv[1] == "table":
        table(*sys.argv[2:])
    else:
        sys.exit(__doc__)
