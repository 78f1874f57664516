# SPDX-License-Identifier: Apache-2.0
"""Draws surfaces, curves, points and texts, seen without perspective on a white background.

Objects are in centimetres. Lines, points and texts have sizes in pixels. Points are arrays (n, 3), segments (n, 2, 3)."""

import importlib
import os
from typing import NamedTuple

import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData
from vtkmodules.vtkFiltersCore import vtkCleanPolyData, vtkGlyph3D, vtkPolyDataNormals, vtkTubeFilter
from vtkmodules.vtkFiltersSources import vtkSphereSource
from vtkmodules.vtkIOImage import vtkPNGWriter
from vtkmodules.vtkRenderingCore import (
    vtkActor, vtkLight, vtkPolyDataMapper, vtkRenderer, vtkRenderWindow, vtkTextActor, vtkWindowToImageFilter,
)  # fmt: skip

for module in ("vtkRenderingFreeType", "vtkRenderingOpenGL2"):  # importing these modules makes them draw
    importlib.import_module("vtkmodules." + module)

# Colours that most readers with colour-vision deficiency can distinguish (Okabe, Ito 2008).
PALETTE = ((0, 114, 178), (230, 159, 0), (0, 158, 115), (204, 121, 167), (213, 94, 0), (86, 180, 233))
BLUE, ORANGE, GREEN, PURPLE, VERMILION, SKY_BLUE = PALETTE
DARK, GREY, LIGHT_GREY = (45, 45, 45), (130, 130, 130), (205, 205, 205)
LEAFLETS = (BLUE, ORANGE, GREEN)
TITLE_HEIGHT = 36  # pixels
# Without a graphics card, smooth edges take most of a picture's time. The tests draw without smooth edges.
N_SAMPLES = int(os.environ.get("RIIS_FIGURES_SAMPLES", "8"))


def paler(colour, white):
    """Mixes the colour with white. `white` is the fraction of white."""
    return tuple(int(part + white * (255 - part) + 0.5) for part in colour)


def looking(direction, up):
    """Returns a view: the direction in which the eye looks, and the upward direction."""
    along = np.array(direction) / np.linalg.norm(direction)
    across = np.array(up) - np.dot(up, along) * along
    return along, across / np.linalg.norm(across)


TOP_VIEW = looking((0, 0, -1), (0, 1, 0))


class Faces(NamedTuple):
    """Triangles or quads, each with a colour."""

    points: np.ndarray  # (n_points, 3)
    corners: np.ndarray  # (n, 3 or 4)
    colours: np.ndarray  # (n, 3)

    def edges(self):
        """Returns the edges of every face in turn."""
        ends = np.stack([self.corners, np.roll(self.corners, -1, axis=1)], axis=2)
        return self.points[ends.reshape(-1, 2)]


def cell_array(cells):
    """Returns cells of equal size. The array has a row of points for each cell."""
    array, cells = vtkCellArray(), np.asarray(cells, dtype=np.int64)
    offsets = np.arange(len(cells) + 1) * cells.shape[1]
    array.SetData(numpy_to_vtkIdTypeArray(offsets, deep=True), numpy_to_vtkIdTypeArray(cells.ravel(), deep=True))
    return array


def poly_data(points, polygons=None, lines=None):
    """Returns points with cells. Polygons and lines are arrays with a row of points for each cell."""
    data, made = vtkPolyData(), vtkPoints()
    made.SetData(numpy_to_vtk(np.ascontiguousarray(points, dtype=float), deep=True))
    data.SetPoints(made)
    for cells, put in ((polygons, data.SetPolys), (lines, data.SetLines)):
        if cells is not None:
            put(cell_array(cells))
    return data


def held_display():
    """Returns a small window that holds a connection to the display. Without this connection, a virtual display restarts when its
    last client leaves. A picture that starts at this moment would find no display."""
    window = vtkRenderWindow()
    window.SetOffScreenRendering(1)
    window.SetSize(8, 8)
    window.Render()
    return window


class Picture:
    """The picture contains all points of `to_fit`. The points keep at least the margin from the edges and the title."""

    def __init__(self, size, view, to_fit, margin=60):
        self.width, self.height = size
        self.direction, self.up = view
        self.right = np.cross(self.direction, self.up)
        to_fit = np.asarray(to_fit, dtype=float)
        low, high = (limit(to_fit @ np.array((self.right, self.up, self.direction)).T, axis=0) for limit in (np.min, np.max))
        half, (x, y, z) = 0.5 * (high - low), 0.5 * (high + low)
        self.pixel = 2 * max(half[0] / (self.width - 2 * margin), half[1] / (self.height - TITLE_HEIGHT - 2 * margin))
        self.focus = x * self.right + (y + 0.5 * TITLE_HEIGHT * self.pixel) * self.up + z * self.direction
        self.depth = max(half)
        self.renderer = vtkRenderer()
        self.renderer.SetBackground(1, 1, 1)
        self.renderer.TwoSidedLightingOn()
        # One lamp is at the eye, and one at the eye's upper left. Parts that face away from both lamps are dim.
        for position, intensity in (((0, 0, 1), 0.62), ((-0.6, 0.8, 1), 0.45)):
            light = vtkLight()
            light.SetLightTypeToCameraLight()
            light.SetPosition(position)
            light.SetFocalPoint(0, 0, 0)
            light.SetIntensity(intensity)
            self.renderer.AddLight(light)
        camera = self.renderer.GetActiveCamera()
        camera.ParallelProjectionOn()
        camera.SetFocalPoint(self.focus)
        camera.SetPosition(self.focus - 6 * self.depth * self.direction)
        camera.SetViewUp(self.up)
        camera.SetParallelScale(0.5 * self.height * self.pixel)

    # Objects in faces are drawn above the faces. The order is: faces, segments, curves, points. Among objects of one kind, an
    # object of higher rank is drawn above an object of lower rank.

    def raised(self, points, layer):
        """Moves points towards the eye. Without perspective, the points keep their place in the picture."""
        return np.asarray(points, dtype=float) - 0.004 * layer * self.depth * self.direction

    def add(self, data, colour, ambient, diffuse):
        """Adds an object. If no colour is given, the cells have colours."""
        mapper, actor = vtkPolyDataMapper(), vtkActor()
        mapper.SetInputData(data)
        actor.SetMapper(mapper)
        if colour is None:
            mapper.SetScalarModeToUseCellData()
            mapper.SetColorModeToDirectScalars()
        else:
            mapper.ScalarVisibilityOff()
            actor.GetProperty().SetColor(*(part / 255 for part in colour))
        actor.GetProperty().SetAmbient(ambient)
        actor.GetProperty().SetDiffuse(diffuse)
        self.renderer.AddActor(actor)
        return actor.GetProperty()

    def add_faces(self, faces, shading):
        """Adds faces whose shading is smooth, flat, ghost (transparent) or painted. Painted faces have constant colours from
        every direction, because the colours are data."""
        data = poly_data(faces.points, faces.corners)
        data.GetCellData().SetScalars(numpy_to_vtk(np.ascontiguousarray(faces.colours, dtype=np.uint8), deep=True))
        if shading in ("smooth", "ghost"):
            # Patches have separate points where they meet. One common normal hides the seam between the patches.
            clean, normals = vtkCleanPolyData(), vtkPolyDataNormals()
            clean.SetInputData(data)
            clean.ToleranceIsAbsoluteOn()
            clean.SetAbsoluteTolerance(1e-9)
            clean.ConvertPolysToLinesOff()
            clean.ConvertLinesToPointsOff()
            normals.SetInputConnection(clean.GetOutputPort())
            normals.SetFeatureAngle(40)
            normals.ConsistencyOff()
            normals.Update()
            data = normals.GetOutput()
        # The surface emits some light, so that unlit parts keep their colour.
        ambient, diffuse = {"painted": (1, 0), "ghost": (0.8, 0.3)}.get(shading, (0.52, 0.55))
        style = self.add(data, None, ambient, diffuse)
        if shading in ("flat", "painted"):
            style.SetInterpolationToFlat()
        if shading == "ghost":
            style.SetOpacity(0.2)

    def add_segments(self, segments, colour, width, rank=0):
        points = self.raised(segments, 1 + rank).reshape(-1, 3)
        style = self.add(poly_data(points, lines=np.arange(len(points)).reshape(-1, 2)), colour, 0, 1)
        style.LightingOff()
        style.SetLineWidth(width)

    def add_tubes(self, points, lines, colour, width):
        tubes = vtkTubeFilter()
        tubes.SetInputData(poly_data(points, lines=lines))
        tubes.SetRadius(0.5 * width * self.pixel)
        tubes.SetNumberOfSides(12)
        tubes.CappingOn()
        tubes.Update()
        self.add(tubes.GetOutput(), colour, 1, 0)

    def add_curve(self, points, colour, width, rank=0):
        self.add_tubes(self.raised(points, 4 + rank), [range(len(points))], colour, width)

    def add_dashed(self, points, colour, width):
        dash, period, dashes = 11 * self.pixel, 19 * self.pixel, []
        points = np.asarray(points)
        for p, q in zip(points, points[1:]):
            whole = np.linalg.norm(q - p)
            if whole > 0:
                starts = np.arange(0, whole, period)
                shares = np.stack([starts, np.minimum(starts + dash, whole)], axis=1) / whole
                dashes.append(p + shares[:, :, None] * (q - p))
        ends = self.raised(np.concatenate(dashes).reshape(-1, 3), 3)
        self.add_tubes(ends, np.arange(len(ends)).reshape(-1, 2), colour, width)

    def add_points(self, points, colour, diameter):
        sphere, spheres = vtkSphereSource(), vtkGlyph3D()
        sphere.SetRadius(0.5 * diameter * self.pixel)
        sphere.SetThetaResolution(20)
        sphere.SetPhiResolution(14)
        spheres.SetInputData(poly_data(self.raised(points, 8)))
        spheres.SetSourceConnection(sphere.GetOutputPort())
        spheres.ScalingOff()
        spheres.Update()
        self.add(spheres.GetOutput(), colour, 0.35, 0.75)

    def add_text(self, x, y, text, colour, size, is_centred):
        actor = vtkTextActor()
        actor.SetInput(text)
        actor.SetPosition(x, y)
        style = actor.GetTextProperty()
        style.SetFontFamilyToArial()
        style.SetFontSize(size)
        style.SetColor(*(part / 255 for part in colour))
        if is_centred:
            style.SetJustificationToCentered()
        style.SetVerticalJustificationToCentered()
        self.renderer.AddViewProp(actor)

    def in_picture(self, vector):
        return np.array((np.dot(vector, self.right), np.dot(vector, self.up)))

    def add_label(self, at, text, right, above, colour=DARK, size=26):
        """Adds a text whose middle is `right` pixels to the right of a point, and `above` pixels above it."""
        x, y = self.in_picture(np.asarray(at) - self.focus) / self.pixel
        self.add_text(0.5 * self.width + x + right, 0.5 * self.height + y + above, text, colour, size, True)

    def add_label_away(self, at, away_from, text, distance, colour=DARK, size=26):
        """Adds a text. In this camera's view, the text's middle is shifted away from another point."""
        way = self.in_picture(np.asarray(at) - away_from)
        length = np.hypot(*way)
        self.add_label(at, text, *(distance * way / length if length > 0 else (0, distance)), colour, size)

    def add_title(self, text):
        self.add_text(24, self.height - 32, text, DARK, 28, False)

    def add_scale_and_axes(self):
        """Adds a scale bar of 1 cm at the lower left, and the directions of x, y and z at the lower right."""

        def at_pixel(x, y):
            across, up = self.pixel * (x - 0.5 * self.width), self.pixel * (y - 0.5 * self.height)
            return self.focus + across * self.right + up * self.up - 4 * self.depth * self.direction

        cm = 1 / self.pixel
        self.add_tubes([at_pixel(28, 30), at_pixel(28 + cm, 30)], [(0, 1)], DARK, 4)
        self.add_text(28 + 0.5 * cm, 50, "1 cm", DARK, 22, True)
        x, y = self.width - 85, 62
        for axis, name in zip(np.eye(3), "xyz"):
            way = 38 * self.in_picture(axis)
            if np.hypot(*way) >= 38 * 0.15:  # otherwise the axis points towards the eye
                end = at_pixel(x + way[0], y + way[1])
                self.add_tubes([at_pixel(x, y), end], [(0, 1)], DARK, 3)
                self.add_label_away(end, at_pixel(x, y), name, 17, DARK, 24)

    def png(self):
        """Returns the bytes of a PNG file."""
        window, image, writer = vtkRenderWindow(), vtkWindowToImageFilter(), vtkPNGWriter()
        window.SetOffScreenRendering(1)
        window.SetMultiSamples(N_SAMPLES)
        window.SetSize(self.width, self.height)
        window.AddRenderer(self.renderer)
        self.renderer.ResetCameraClippingRange()
        window.Render()
        image.SetInput(window)
        image.ReadFrontBufferOff()
        writer.SetInputConnection(image.GetOutputPort())
        writer.WriteToMemoryOn()
        writer.Write()
        window.RemoveRenderer(self.renderer)
        return vtk_to_numpy(writer.GetResult()).tobytes()
