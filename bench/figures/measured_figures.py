# SPDX-License-Identifier: Apache-2.0
"""Draws the tetrahedra that the program marks, and the errors of the paper's three methods for a distance."""

import functools
import io
import math
import os
import tempfile

import matplotlib

matplotlib.use("Agg")
import numpy as np
from matplotlib import pyplot
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import VTK_TETRA, vtkPlane, vtkUnstructuredGrid
from vtkmodules.vtkFiltersCore import vtkCutter
from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridReader, vtkXMLUnstructuredGridWriter

from library import HALF_THICKNESS, joined_faces, run, written
from page import Figure, Panel, count, html_table, number, percent
from picture import (
    BLUE, GREEN, GREY, LEAFLETS, LIGHT_GREY, ORANGE, TOP_VIEW, VERMILION, Faces, Picture, cell_array, looking, paler,
)  # fmt: skip

# ------------------------------------------------------------------------------------------------------------ marked tetrahedra

EDGE, TOLERANCE = 0.08, 0.05
UNMARKED = (244, 244, 244)


def mesh_cylinder(middle, radius, height):
    """Returns nodes and tetrahedra. All hexahedra are cut into 6 tetrahedra along parallel diagonals, so the cuts of neighbours
    match."""
    n_across, n_up = math.ceil(2 * radius / EDGE), math.ceil(height / EDGE)
    across, up = 2 * np.arange(n_across + 1) / n_across - 1, 2 * np.arange(n_up + 1) / n_up - 1
    z, y, x = np.meshgrid(up, across, across, indexing="ij")
    # Maps a square to a disc. The square's grid lines become parts of ellipses.
    on_disc = radius * x * np.sqrt(1 - 0.5 * y * y), radius * y * np.sqrt(1 - 0.5 * x * x), 0.5 * height * z
    nodes = middle + np.stack(on_disc, axis=-1).reshape(-1, 3)
    number_of = np.arange(len(nodes)).reshape(x.shape)
    cube = [number_of[k:, j:, i:][:n_up, :n_across, :n_across].ravel() for k in (0, 1) for j in (0, 1) for i in (0, 1)]
    # Six paths lead along edges from corner 0 to corner 7.
    ways = ((1, 3), (3, 2), (2, 6), (6, 4), (4, 5), (5, 1))
    return nodes, np.stack([[cube[0], cube[a], cube[b], cube[7]] for a, b in ways], axis=0).transpose(2, 0, 1).reshape(-1, 4)


class Marked:
    """A mesh of tetrahedra that the program has marked. `leaflet` is the leaflet of the tetrahedron's closest marked node, or
    -1."""

    def __init__(self, kind, opening, cylinder):
        self.middle, self.radius, self.height = np.array(cylinder[0]), *cylinder[1:]
        self.nodes, self.tetrahedra = mesh_cylinder(*cylinder)
        self.grid, points = vtkUnstructuredGrid(), vtkPoints()
        points.SetData(numpy_to_vtk(self.nodes, deep=True))
        self.grid.SetPoints(points)
        self.grid.SetCells(VTK_TETRA, cell_array(self.tetrahedra))
        is_marked, leaflet, distance = self.marks(kind, opening)
        distance = np.where(is_marked, distance, np.inf)[self.tetrahedra]
        closest = self.tetrahedra[np.arange(len(distance)), np.argmin(distance, axis=1)]
        self.leaflet = np.where(is_marked, leaflet, -1)[closest]
        self.is_whole = np.all(is_marked[self.tetrahedra], axis=1)
        self.n_marked = np.count_nonzero(is_marked)

    def marks(self, kind, opening):
        """Marks the nodes by the program, as users do."""
        with tempfile.TemporaryDirectory() as folder:
            mesh, marked = os.path.join(folder, "mesh.vtu"), os.path.join(folder, "marked.vtu")
            writer, reader = vtkXMLUnstructuredGridWriter(), vtkXMLUnstructuredGridReader()
            writer.SetFileName(mesh)
            writer.SetInputData(self.grid)
            writer.Write()
            valve = ("--valve", kind, "--opening", str(opening), "--half-thickness", str(HALF_THICKNESS))
            run("riis", "mark", mesh, *valve, "--tolerance", str(TOLERANCE), "--output", marked, "--quiet")
            reader.SetFileName(marked)
            reader.Update()
            arrays = reader.GetOutput().GetPointData()
            made = [vtk_to_numpy(arrays.GetArray("riis_" + name)) for name in ("marked", "leaflet", "distance")]
            return made[0].astype(bool), *made[1:]

    def outline(self):
        """Returns the edges at the cylinder's ends, and two lines between these edges."""
        turn, up = np.linspace(0, 2 * math.pi, 121), np.array((0, 0, 0.5 * self.height))
        rim = self.middle + self.radius * np.stack([np.cos(turn), np.sin(turn), 0 * turn], axis=1)
        return [rim - up, rim + up, *([rim[i] - up, rim[i] + up] for i in (0, 60))]

    def outer_faces(self):
        """Returns the outer faces of the tetrahedra whose nodes are all marked."""
        wholes = self.tetrahedra[self.is_whole]
        faces = np.sort(np.concatenate([np.delete(wholes, k, axis=1) for k in range(4)]), axis=1)
        # A face that belongs to two tetrahedra is inside the mesh.
        unique, first, n = np.unique(faces, axis=0, return_index=True, return_counts=True)
        leaflets = np.tile(self.leaflet[self.is_whole], 4)[first]
        return Faces(self.nodes, unique[n == 1], np.array(LEAFLETS)[leaflets[n == 1]])

    def slice(self, normal):
        """Cuts the mesh by the plane through the origin with this normal. Returns the faces of the cut, and the edges of the cut
        tetrahedra. A face has the colour of its tetrahedron's leaflet, which is paler if only some nodes are marked."""
        colours = np.array([[paler(colour, 0.6) for colour in LEAFLETS] + [UNMARKED], [*LEAFLETS, UNMARKED]])
        shown = numpy_to_vtk(colours[self.is_whole.astype(int), self.leaflet].astype(np.uint8), deep=True)
        self.grid.GetCellData().SetScalars(shown)
        plane, cutter = vtkPlane(), vtkCutter()
        plane.SetNormal(normal)
        cutter.SetCutFunction(plane)
        cutter.SetInputData(self.grid)
        cutter.GenerateTrianglesOff()
        cutter.Update()
        cut = cutter.GetOutput()
        points, colours = vtk_to_numpy(cut.GetPoints().GetData()), vtk_to_numpy(cut.GetCellData().GetScalars())
        ends, corners = vtk_to_numpy(cut.GetPolys().GetOffsetsArray()), vtk_to_numpy(cut.GetPolys().GetConnectivityArray())
        polygons = [corners[a:b] for a, b in zip(ends, ends[1:])]
        edges = np.concatenate([np.stack([polygon, np.roll(polygon, -1)], axis=1) for polygon in polygons])
        triangles = [(polygon[0], *pair, i) for i, polygon in enumerate(polygons) for pair in zip(polygon[1:], polygon[2:])]
        triangles = np.array(triangles)
        return Faces(points, triangles[:, :3], colours[triangles[:, 3]]), points[edges]


def marking_figure():
    subjects = (
        ("aortic", 0, ((0, 0, -0.5), 1.75, 1.6), looking((-0.15, 1, -0.28), (0, 0, 1)), looking((0, 1, 0), (0, 0, 1)), "y = 0"),
        ("mitral", 1, ((0, 0.1, 0), 2.3, 2.5), looking((-1, 0.3, -0.15), (0, 0, 1)), looking((-1, 0, 0), (0, 0, 1)), "x = 0"),
    )
    panels, counts = [], []
    for kind, opening, cylinder, side, cut_view, plane in subjects:
        marked, name = Marked(kind, opening, cylinder), f"{kind} valve"
        outline, faces = marked.outline(), marked.outer_faces()
        to_fit = np.concatenate(outline)

        def picture_of(view, title):
            made = Picture((1160, 940), view, to_fit)
            made.add_title(f"{name}, {title}")
            made.add_scale_and_axes()
            return made

        outside = picture_of(TOP_VIEW, "top"), picture_of(side, "side")
        for made in outside:
            for line in outline:
                made.add_curve(line, LIGHT_GREY, 2.5)
            made.add_faces(faces, "flat")
            made.add_segments(faces.edges(), (70, 70, 70), 1)
        cut = picture_of(cut_view, f"cut at {plane}")
        section, edges = marked.slice(cut_view[0])
        cut.add_faces(section, "flat")
        cut.add_segments(edges, GREY, 1)
        n_whole, n_touched = np.count_nonzero(marked.is_whole), np.count_nonzero(marked.leaflet >= 0)
        panels += [
            Panel(outside[0].png(), f"From above: the {count(n_whole)} tetrahedra of which all four nodes are marked."),
            Panel(outside[1].png(), "The same from the side."),
            Panel(cut.png(), f"The mesh cut by the plane {plane}; pale: tetrahedra of which only some nodes are marked."),
        ]
        counts.append(
            f"{count(marked.n_marked)} of {count(len(marked.nodes))} nodes, {count(n_whole)} of {count(len(marked.tetrahedra))} "
            f"tetrahedra wholly and {count(n_touched - n_whole)} in part ({name})"
        )
    return Figure(
        "Marked tetrahedra", 3, panels,
        "Nodes within the half thickness, 0.1 cm, of the leaflets are marked; a tetrahedron is shown when all its nodes are, in "
        "the colour of the leaflet closest to it. The meshes know nothing of the valves: cylinders of hexahedra of about "
        f"{number(EDGE)} cm, each cut into six tetrahedra; surfaces at a tolerance of {percent(TOLERANCE)}, the mitral valve "
        f"open. Marked: {', '.join(counts)}.",
        "section 4.2, figure “Results of mesh traversal algorithms with aortic and mitral valves”.",
        tuple(zip(LEAFLETS, ("right cusp; anterior leaflet", "left cusp; posterior leaflet", "non-coronary cusp"))),
    )  # fmt: skip


# ---------------------------------------------------------------------------------------------------------- errors of distances

# The logarithm of an error gives its colour, from dark to bright. The colour map, viridis, suits any colour vision.
DARKEST_POWER, BRIGHTEST_POWER = -5, -1
METHOD_COLOURS = {"minimisation": GREEN, "sampling": ORANGE, "triangulation": BLUE}


def colours_of(errors):
    stops = np.array([(68, 1, 84), (65, 68, 135), (42, 120, 142), (34, 168, 132), (122, 209, 81), (253, 231, 37)])
    powers = np.log10(np.maximum(errors, 10.0**DARKEST_POWER))
    at = np.clip(powers, DARKEST_POWER, BRIGHTEST_POWER)
    ends = np.linspace(DARKEST_POWER, BRIGHTEST_POWER, len(stops))
    return np.rint(np.stack([np.interp(at, ends, stops[:, k]) for k in range(3)], axis=-1)).astype(np.uint8)


def share_text(share):
    """Returns a fraction of the half thickness as text."""
    return number(100 * share, 2) + " %"


def quantile(ascending, share):
    return ascending[min(len(ascending) - 1, int(share * len(ascending)))]


def painting_of(images):
    """Returns the cells of all images, coloured by the error at their middles."""
    parts = []
    for image in images:
        n_u, n_v = image["n_u"], image["n_v"]
        corner = np.arange((n_u + 1) * (n_v + 1)).reshape(n_v + 1, n_u + 1)
        cells = np.stack([corner[:-1, :-1], corner[:-1, 1:], corner[1:, 1:], corner[1:, :-1]], axis=-1).reshape(-1, 4)
        parts.append((image["corners"].reshape(-1, 3), cells, colours_of(image["errors"])))
    return joined_faces(parts)


@functools.cache
def written_errors():
    return written("--errors")


def accuracy_figure():
    panels = []
    views = {"right cusp": looking((-1, 0.35, -0.55), (0, 0, 1)), "anterior leaflet": looking((-0.35, -1, -0.35), (0, 0, 1))}
    for painting in (each for row in written_errors()["paintings"] for each in row):
        leaflet, method, setting = painting["leaflet"], painting["method"], painting["setting"]
        faces = painting_of(painting["images"])
        ascending = np.sort(np.concatenate([each["errors"] for each in painting["images"]]))
        made = Picture((900, 760), views[leaflet], faces.points, 40)
        made.add_title(f"{method}, {setting}")
        made.add_faces(faces, "painted")
        if not painting["is_part"]:
            made.add_scale_and_axes()
        part = "a part some millimetres wide, " if painting["is_part"] else ""
        caption = (
            f"{leaflet}, {part}{method} at {setting}: half of it is off by at most {share_text(quantile(ascending, 0.5))}, 95 % "
            f"by {share_text(quantile(ascending, 0.95))}, all by {share_text(ascending[-1])}."
        )
        panels.append(Panel(made.png(), caption))
    ends = {DARKEST_POWER: " or less", BRIGHTEST_POWER: " or more"}
    powers = range(DARKEST_POWER, BRIGHTEST_POWER + 1)
    key = [(tuple(colours_of(10.0**power)), share_text(10.0**power) + ends.get(power, "")) for power in powers]
    return Figure(
        "Errors of distances, painted", 3, panels,
        "Distances that the three methods give for points on the smooth surface, in per cent of the half thickness. From the "
        "top: one cusp of the aortic valve, a part of this cusp below its middle, and the anterior leaflet of the open mitral "
        "valve. The true distance is 0 everywhere. Between samples, distances grow to about the tolerance. Triangles touch the "
        "surface at their corners, and in between leave it by at most the tolerance. Minimisation has errors because it stops "
        "early, because of the patches that it uses, and sometimes because of a local minimum.",
        "section 4.1, “Performance evaluation”, figure “Errors in distance calculation plotted on aortic cusp surfaces for all "
        "three distance functions”.",
        key,
    )  # fmt: skip


# The scale of the distributions. A value below the scale is drawn at the scale's lower end.
LEAST_POWER, MOST_POWER, BINS_PER_POWER = -6, 0, 20


def css(colour):
    return "#%02x%02x%02x" % colour


def violin_plot(title, settings, where):
    """Draws the distributions of errors side by side on a logarithmic scale. Returns a PNG."""
    figure, axis = pyplot.subplots(figsize=(11.2, 7.6), dpi=100)
    axis.set_title(title, loc="left", fontsize=20, pad=14)
    ends = np.linspace(LEAST_POWER, MOST_POWER, (MOST_POWER - LEAST_POWER) * BINS_PER_POWER + 1)
    middles, smoothing = 0.5 * (ends[1:] + ends[:-1]), np.exp(-0.5 * np.arange(-4, 5) ** 2 / 2.25)
    for i, setting in enumerate(settings):
        ascending = np.sort(np.clip(setting[where], 10.0**LEAST_POWER, 10.0**MOST_POWER))
        powers = np.log10(ascending)
        widths = np.convolve(np.histogram(powers, ends)[0], smoothing, "same")
        # The smoothed outline must not extend beyond the least and the greatest value.
        inside = (middles > powers[0] - 0.05) & (middles < powers[-1] + 0.05)
        half = 0.42 * widths[inside] / max(widths)
        colour = css(METHOD_COLOURS[setting["method"]])
        axis.fill_betweenx(10 ** middles[inside], i - half, i + half, color=colour, linewidth=0)
        axis.hlines(setting["tolerance"], i - 0.46, i + 0.46, color=css(VERMILION), linewidth=3)
        axis.hlines(quantile(ascending, 0.5), i - 0.3, i + 0.3, color="#2d2d2d", linewidth=3)
        axis.hlines(quantile(ascending, 0.95), i - 0.15, i + 0.15, color="#2d2d2d", linewidth=2)
        axis.plot(i, ascending[-1], "o", color="#2d2d2d", markersize=6)
    for method, colour in METHOD_COLOURS.items():
        own = [i for i, setting in enumerate(settings) if setting["method"] == method]
        axis.text(np.mean(own), -0.1, method, transform=axis.get_xaxis_transform(), color=css(colour), ha="center", fontsize=17)
    axis.set_xticks(range(len(settings)), [setting["setting"] for setting in settings], fontsize=15)
    ticks = [10.0**power for power in range(LEAST_POWER, MOST_POWER + 1)]
    axis.set(yscale="log", ylim=(ticks[0], ticks[-1]), xlim=(-0.5, len(settings) - 0.5))
    axis.set_yticks(ticks, [f"{100 * tick:.10g} %" for tick in ticks], fontsize=15)
    axis.minorticks_off()
    axis.grid(axis="y", color="#cdcdcd")
    axis.set_axisbelow(True)
    axis.tick_params(length=0)
    axis.spines[:].set_visible(False)
    figure.subplots_adjust(0.11, 0.11, 0.99, 0.91)
    drawn = io.BytesIO()
    figure.savefig(drawn, format="png")
    pyplot.close(figure)
    return drawn.getvalue()


def accuracy_distribution_figure():
    rows = [["leaflet", "method", "tolerance", "on it: median", "95 %", "largest", "off it: median", "95 %", "largest"]]
    panels = []
    for each in written_errors()["distributions"]:
        leaflet, settings = each["leaflet"], each["settings"]
        for setting in settings:
            ascending = [np.sort(setting[where]) for where in ("on", "off")]
            quantiles = [share_text(quantile(values, share)) for values in ascending for share in (0.5, 0.95, 1)]
            rows.append([leaflet, setting["method"], setting["setting"], *quantiles])
        for where, points in (
            ("on", "points of the surface."),
            ("off", "points 0.1, 0.5 and 1 half thickness off the surface, to either side."),
        ):
            png = violin_plot(f"{each['valve']} valve, {leaflet}: {where} the surface", settings, where)
            panels.append(Panel(png, f"{leaflet}, {count(len(settings[0][where]))} {points}"))
    return Figure(
        "Errors of distances, distributed", 2, panels,
        "Errors of distances, in per cent of the half thickness, on a logarithmic scale. Widths show fractions of the points, "
        "lines the median and 95 %, dots the largest error. The errors of samples and of triangles stay below the tolerance; for "
        "minimisation the tolerance only says when to stop. The points' true distances are known: the smooth surface is "
        "evaluated from its curves, without polylines, and other points lie on its normals. Points are left out if another part "
        "of the leaflet is nearer, or if the offset exceeds half the radius of curvature.",
        "section 4.1, “Performance evaluation”, figure “Results for accuracy and performance testing for each distance "
        "algorithm”, left column.",
        (*((colour, method) for method, colour in METHOD_COLOURS.items()), (VERMILION, "tolerance")),
        html_table(rows),
    )  # fmt: skip
