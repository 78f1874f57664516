# SPDX-License-Identifier: Apache-2.0
"""The camera of a picture, and the words in it: what a picture of riis.plot or riis.animate frames, and what is odd about it."""

from __future__ import annotations

import math
import textwrap
import warnings
from typing import TYPE_CHECKING, Any

import numpy

from riis._errors import Error, MarksWarning

if TYPE_CHECKING:
    from riis._riis import Marks, Mesh, Surface
    from riis._tube import Reals

_FROM = numpy.array([1.0, -1.6, 1.5])  # the camera looks obliquely from above
_RIGHT, _BELOW, _ABOVE, _BESIDE = 0.72, -0.82, 0.95, -0.96  # the part of a picture beside the colour bar, above the scale bar
_WHOLE = 5.0  # a mesh of at most this many lengths of the valve is shown whole
_MOST_OUT = 0.05  # of the leaflets' area, outside the mesh; the words begin above this share
_LARGEST_NOTE = 78  # letters in a line


def frame(
    plotter: Any, surface: Surface, around: Any = None, *, has_bar: bool = True, n_lines: int = 0, is_whole: bool = False
) -> float:
    """Aims the camera at a surface, so that points around it are in the picture, beside the colour bar and below the words. If
    they reach much farther than the surface, only near points are in the picture, unless all must be in it.

    Returns the share of the picture's height that the surface takes.
    """
    vertices = numpy.array(surface.vertices)
    focus = (vertices.min(axis=0) + vertices.max(axis=0)) / 2.0
    points = vertices
    if around is not None and len(around):
        length = float(numpy.linalg.norm(vertices.max(axis=0) - vertices.min(axis=0)))
        far = numpy.linalg.norm(around - focus, axis=1)
        is_whole = is_whole or numpy.linalg.norm(numpy.ptp(around, axis=0)) <= _WHOLE * length
        shown = around if is_whole else around[far < 1.2 * length]
        points = numpy.concatenate([vertices, shown])
    sight = _FROM / numpy.linalg.norm(_FROM)
    right = numpy.cross([0.0, 0.0, 1.0], sight)
    right /= numpy.linalg.norm(right)
    up = numpy.cross(sight, right)
    distance = max(float(numpy.linalg.norm(points - focus, axis=1).max()), 1e-300) / math.sin(math.radians(15.0))
    depth = distance - (points - focus) @ sight
    x, y = (points - focus) @ right / depth, (points - focus) @ up / depth
    left, low = _BESIDE, _BELOW
    edge, top = (_RIGHT if has_bar else -left), _ABOVE - 0.07 * n_lines
    width, height = plotter.window_size
    tangent = max(float(numpy.ptp(x)) / (edge - left) * height / width, float(numpy.ptp(y)) / (top - low))
    plotter.view_vector(_FROM, viewup=(0.0, 0.0, 1.0))
    camera = plotter.camera
    camera.focal_point, camera.position = focus, focus + distance * sight
    camera.view_angle = 2.0 * math.degrees(math.atan(tangent))
    middle = numpy.array([(x.min() + x.max()) / 2.0 / (tangent * width / height), (y.min() + y.max()) / 2.0 / tangent])
    camera.SetWindowCenter(*(middle - [(left + edge) / 2.0, (low + top) / 2.0]))
    plotter.renderer.reset_camera_clipping_range()
    n = len(vertices)
    return max(float(numpy.ptp(x[:n])), float(numpy.ptp(y[:n]))) / (2.0 * tangent)


def frame_widget(plotter: Any, surface: Surface, around: Any) -> None:
    """Aims the camera of a widget, which has no colour bar at its side and whose window may have any shape."""
    frame(plotter, surface, around, has_bar=False)
    plotter.camera.SetWindowCenter(0.0, 0.0)
    plotter.camera.zoom(0.9)


def show_notes(plotter: Any, notes: list[str]) -> int:
    """Writes the notes at the upper left, in place of earlier ones. Returns the number of lines."""
    plotter.remove_actor("riis notes", reset_camera=False)
    lines = [line for note in notes for line in textwrap.wrap(note, _LARGEST_NOTE)]
    if lines:
        text = plotter.add_text(
            "\n".join(lines), position=(0.02, 0.975), viewport=True, font_size=max(6, round(plotter.window_size[1] / 76.8)),
            color=(0.6, 0.1, 0.0), name="riis notes",
        )
        text.prop.SetVerticalJustificationToTop()
    return len(lines)


def notes_of(surface: Surface, mesh: Mesh | None, marks: Marks | None, unit: str | None) -> list[str]:
    """Returns sentences about what is odd in a picture."""
    from riis._odd_marks import LEAST_NODES, box_of, share_outside

    notes, of_unit = [], f" {unit}" if unit else ""
    info = surface.info
    side = float((info.upper - info.lower).max())
    if mesh is not None and marks is not None and len(marks) == 0:
        n_nodes, lower, upper = box_of(mesh)
        notes.append(f"0 of {n_nodes:,} nodes are marked")
        if n_nodes > 0:
            notes.append(
                f"The valve is {side:.3g}{of_unit} long, the mesh {float((upper - lower).max()):.3g}{of_unit}; riis.mark names "
                "what fits"
            )
    elif mesh is not None and marks is not None and len(mesh) >= LEAST_NODES and not hasattr(mesh, "axes"):
        share = share_outside(surface, mesh)
        if share > _MOST_OUT:
            notes.append(f"About {100 * share:.0f} % of the leaflets' area is outside the mesh, where no nodes are")
    return notes


def check_grid(surface: Surface, mesh: Mesh | None, marks: Marks | None, grid: Any) -> list[str]:
    """Warns of a grid far from the surface, and of edges of the grid that leak. Returns the notes for the picture."""
    from riis._odd_marks import leak_of_grid

    bounds = numpy.array(grid.bounds).reshape(3, 2)
    lower, upper = bounds[:, 0], bounds[:, 1]
    info = surface.info
    middle, size = (info.lower + info.upper) / 2.0, info.upper - info.lower
    if (middle < lower - size / 2.0).any() or (middle > upper + size / 2.0).any() or (upper - lower).max() < 0.3 * size.max():
        note = "The grid does not surround the valve: is it in another unit?"
        warnings.warn(
            f"grid: reaches from {_point(lower)} to {_point(upper)}, and the surface from {_point(info.lower)} to "
            f"{_point(info.upper)}. Is grid in another unit, such as grid.scale(0.1)?", MarksWarning, stacklevel=3,
        )
        return [note]
    if mesh is None or marks is None or len(marks) == 0:
        return []
    try:
        said, half = leak_of_grid(surface, mesh, grid)
    except Error:  # the cells have nodes that the mesh lacks
        return []
    if said is None:
        return []
    warnings.warn(f"{said}. Try riis.Surface(valve, half_thickness={half:g})", MarksWarning, stacklevel=3)
    return [f"{said}: half_thickness={half:g} closes them"]


def _point(point: Reals) -> str:
    return "(" + ", ".join(f"{float(x):.3g}" for x in point) + ")"
