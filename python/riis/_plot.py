# SPDX-License-Identifier: Apache-2.0
"""Pictures by PyVista, which is imported when the first picture is made."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING, Any

import numpy

from riis._errors import InvalidArgumentError

if TYPE_CHECKING:
    from riis._riis import MarkResult, Mesh, Surface


def _pyvista() -> Any:
    try:
        import pyvista
    except ImportError as missing:
        raise ImportError("pictures need PyVista: pip install pyvista, or install riis[plot]") from missing
    return pyvista


def surface_to_pyvista(surface: Surface) -> Any:
    """Copies a surface to pyvista.PolyData; Surface.to_pyvista says more."""
    pyvista = _pyvista()
    triangles, velocities = surface.triangles, surface.velocities
    corners = numpy.full((len(triangles.vertex_id), 4), 3, numpy.int64)
    corners[:, 1:] = triangles.vertex_id
    data = pyvista.PolyData(numpy.array(surface.vertices), corners.ravel())
    for name in ("triangle_id", "leaflet_id", "patch_id"):
        data.cell_data[name] = numpy.array(getattr(triangles, name))
    if velocities is not None:
        data.point_data["velocity"] = numpy.array(velocities)
    return data


def plot(
    surface: Surface,
    mesh: Mesh | None = None,
    marks: MarkResult | None = None,
    *,
    screenshot: str | os.PathLike[str] | None = None,
    plotter: Any = None,
) -> Any:
    """Draws a surface, coloured by leaflet, and the marked nodes, coloured by distance.

    mesh, marks  those of the marking, both or none
    screenshot   a .png file to write; no window opens then
    plotter      a pyvista.Plotter to draw into; None: a new one, which is shown if there is no screenshot

    Returns the plotter.
    """
    pyvista = _pyvista()
    if (mesh is None) != (marks is None):
        raise InvalidArgumentError("marks: goes together with mesh; one of them is None")
    given = plotter is not None
    if not given:
        plotter = pyvista.Plotter(off_screen=screenshot is not None)
    leaflets = surface_to_pyvista(surface)
    plotter.add_mesh(leaflets, scalars="leaflet_id", cmap="Set2", clim=[-0.5, 7.5], show_scalar_bar=False, opacity=0.85)
    if mesh is not None and marks is not None and len(marks) > 0:
        nodes = pyvista.PolyData(numpy.array(mesh.xyz[marks.ids]))
        nodes.point_data["distance"] = numpy.array(marks.distance)
        plotter.add_mesh(
            nodes, scalars="distance", cmap="viridis", clim=[0.0, surface.half_thickness], point_size=5, render_points_as_spheres=True, opacity=0.5,
            scalar_bar_args={"title": "distance"},
        )
    if screenshot is not None:
        plotter.screenshot(os.fspath(screenshot))
    elif not given:
        plotter.show()
    return plotter
