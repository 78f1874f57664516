# SPDX-License-Identifier: Apache-2.0
"""Reads the numbers that riis-figures writes, and prepares the parts of a valve that can be drawn."""

import functools
import json
import os
import subprocess
import sys
import tempfile

import numpy as np

import picture
from picture import Faces

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "parameters"))
import bezier
import curves

HALF_THICKNESS = 0.1
programs = {}  # paths of the programs riis and riis-figures


class Refused(Exception):
    """The exception for a message to the user."""


def run(program, *words):
    """Returns the text that a program prints. If the program fails, raises Refused with its message."""
    done = subprocess.run([programs[program], *words], capture_output=True, text=True, check=False)
    if done.returncode != 0:
        raise Refused(done.stderr.strip() or f"{program} failed")
    return done.stdout


def written(*words):
    """Returns the output of riis-figures, with arrays instead of the references to long lists."""
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "out.json")
        run("riis-figures", words[0], path, *words[1:])
        numbers = np.fromfile(path + ".numbers") if os.path.exists(path + ".numbers") else None

        def array(value):
            return numbers[value["at"] : value["at"] + value["n"]] if value.keys() == {"at", "n"} else value

        with open(path, encoding="utf-8") as file:
            return json.load(file, object_hook=array)


def control_points(pieces):
    """Returns every control point once. The common end of two spans counts once, and so does the end of a closed curve."""
    points = [p for i, piece in enumerate(pieces) for p in piece[min(i, 1) :]]
    return np.array(points[:-1] if np.allclose(points[0], points[-1], atol=1e-9) else points)


def samples(pieces):
    return np.array(bezier.samples(pieces))


def add_controlled(to, pieces, colour, width, diameter, white):
    """Adds a curve to a picture, with its control points and its dashed control polygons."""
    for piece in pieces:
        to.add_dashed(piece, picture.paler(colour, white), 2.5)
    to.add_curve(samples(pieces), colour, width)
    to.add_points(control_points(pieces), colour, diameter)


class Grid:
    """Returns the points of the image of one patch."""

    def __init__(self, image):
        self.leaflet, self.placed, self.lengths = image["leaflet"], image["placed"], image["lengths"]
        grid = image["grid"]
        self.u, self.v, self.n_halved = grid["u"], grid["v"], image["n_halved"]
        self.patch_id, self.on_curves = image["patch_id"], grid["on_curves"]
        self.points = grid["points"].reshape(len(self.v), len(self.u), 3)

    def polylines(self):
        """Returns points and parameters of the polylines on the sides v0, v1, u0, u1."""
        lines = (self.points[0], self.u), (self.points[-1], self.u), (self.points[:, 0], self.v), (self.points[:, -1], self.v)
        kept = [self.on_curves[name] for name in ("v0", "v1", "u0", "u1")]
        return [(line[vertices], np.array(t)[vertices]) for (line, t), vertices in zip(lines, kept)]

    def corners(self):
        """Returns the corners of each quad as indices of points."""
        number = np.arange(self.points.size // 3).reshape(self.points.shape[:2])
        return np.stack([number[:-1, :-1], number[:-1, 1:], number[1:, 1:], number[1:, :-1]], axis=-1).reshape(-1, 4)


def joined_faces(parts):
    """Returns the faces of all parts, each as (points, corners, colours)."""
    firsts = np.cumsum([0] + [len(points) for points, _, _ in parts])
    return Faces(
        np.concatenate([points for points, _, _ in parts]),
        np.concatenate([corners + first for (_, corners, _), first in zip(parts, firsts)]),
        np.concatenate([colours for _, _, colours in parts]),
    )


class Model:
    """The results of every stage for a valve, or for one image of a patch."""

    def __init__(self, made):
        self.images, triangles = made["images"], made["triangles"]
        self.grids = [Grid(image) for image in self.images]
        self.points, self.uv = triangles["points"].reshape(-1, 3), triangles["uv"].reshape(-1, 2)
        self.corners = triangles["corners"].astype(int).reshape(-1, 3)
        self.leaflet = triangles["leaflet"].astype(int)

    def quads(self, leaflet=None, colours=picture.LEAFLETS):
        parts = [
            (grid.points.reshape(-1, 3), grid.corners(), np.tile(colours[grid.leaflet], (len(grid.corners()), 1)))
            for grid in self.grids
            if leaflet in (None, grid.leaflet)
        ]
        return joined_faces(parts)

    def is_chosen(self, leaflet):
        return np.isin(self.leaflet, self.leaflet if leaflet is None else leaflet)

    def triangles(self, leaflet=None, colours=picture.LEAFLETS):
        chosen = self.is_chosen(leaflet)
        table = np.array([*colours, *[picture.GREY] * (max(self.leaflet) + 1)])
        return Faces(self.points, self.corners[chosen], table[self.leaflet[chosen]])

    def triangle_edges(self, leaflet=None):
        """Returns two kinds of lines: the edges that subdivision adds to the quads, and the diagonals that divide quads into
        triangles."""
        corners = self.corners[self.is_chosen(leaflet)]
        ends = np.stack([corners, np.roll(corners, -1, axis=1)], axis=2).reshape(-1, 2)
        is_diagonal = np.all(self.uv[ends[:, 0]] != self.uv[ends[:, 1]], axis=1)
        return self.points[ends[~is_diagonal]], self.points[ends[is_diagonal]]

    def cusps(self):
        return curves.all_cusps(self.images)

    def mitral(self):
        return curves.mitral_curves(self.images)


@functools.cache
def model(kind, tolerance, patch_id=None, **settings):
    """Returns a valve with these settings, or only the image of the patch with the number patch_id."""
    patch = [] if patch_id is None else [str(patch_id)]
    return Model(written("--model", kind, str(tolerance), json.dumps(settings), *patch))
