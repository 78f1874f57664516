# SPDX-License-Identifier: Apache-2.0
"""Pictures by PyVista, which is imported for the first picture."""

from __future__ import annotations

import os
from collections.abc import Iterable
from typing import TYPE_CHECKING, Any

import numpy

from riis._errors import InvalidArgumentError

if TYPE_CHECKING:
    from riis._riis import Marks, Mesh, Surface


# Blue, orange, bluish green, reddish purple, vermilion and sky blue: distinct for all kinds of colour vision (Okabe, Ito 2008).
# The program's pictures have the same colours in the same order.
COLOURS = ("#0072b2", "#e69f00", "#009e73", "#cc79a7", "#d55e00", "#56b4e9")


def _pyvista() -> Any:
    try:
        import pyvista
    except ImportError as missing:
        raise ImportError("pictures need PyVista: pip install pyvista, or install riis[plot]") from missing
    return pyvista


def surface_to_pyvista(surface: Surface) -> Any:
    """Copies a surface to pyvista.PolyData, as described for Surface.to_pyvista."""
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


_BAR = {
    "title": "distance\n", "vertical": True, "position_x": 0.88, "position_y": 0.2, "height": 0.6, "width": 0.06, "n_labels": 3,
    "fmt": "{:.2g}", "title_font_size": 16, "label_font_size": 14,
}


def _look(plotter: Any, zoom: float) -> None:
    """Aims the camera at everything drawn, obliquely from above."""
    plotter.view_vector((1.0, -1.6, 1.5), viewup=(0.0, 0.0, 1.0))
    plotter.camera.zoom(zoom)


def coloured(data: Any, valve: int = 0) -> Any:
    """Gives a surface of to_pyvista the cell array colour. The leaflets of a second valve have the next three colours."""
    rgb = numpy.array([[int(colour[at : at + 2], 16) for at in (1, 3, 5)] for colour in COLOURS], numpy.uint8)
    data.cell_data["colour"] = rgb[(3 * valve + numpy.maximum(data.cell_data["leaflet_id"], 0)) % len(COLOURS)]
    return data


def _check_of_mesh(marks: Marks | None, mesh: Mesh | None) -> None:
    if mesh is not None and marks is not None and marks._places != mesh._places:
        raise InvalidArgumentError(
            "marks: do not belong to mesh as it is now; pass the mesh that riis.mark took, and mark again after its updates"
        )


def _draw(plotter: Any, surface: Surface, mesh: Mesh | None, marks: Marks | None) -> None:
    """Draws or replaces the leaflets and the marked nodes."""
    pyvista = _pyvista()
    plotter.add_mesh(
        coloured(surface_to_pyvista(surface)), scalars="colour", rgb=True, show_scalar_bar=False, ambient=0.3,
        name="riis leaflets", reset_camera=False,
    )
    if mesh is not None and marks is not None and len(marks) > 0:
        nodes = pyvista.PolyData(numpy.array(mesh.xyz[marks.ids]))
        nodes.point_data["distance"] = numpy.array(marks.distance)
        plotter.add_mesh(
            nodes, scalars="distance", cmap="viridis", clim=[0.0, surface.half_thickness], point_size=3,
            render_points_as_spheres=True, opacity=0.35, scalar_bar_args=_BAR, name="riis marks", reset_camera=False,
        )
    else:
        plotter.remove_actor("riis marks", reset_camera=False)


def plot(
    surface: Surface,
    mesh: Mesh | None = None,
    marks: Marks | None = None,
    *,
    screenshot: str | os.PathLike[str] | None = None,
    plotter: Any = None,
    interactive: bool = False,
) -> Any:
    """Draws a surface, coloured by leaflet, and the marked nodes, coloured by distance.

    mesh, marks  the mesh and the marks of a marking, both or neither. The mesh must still have the nodes of the marking
    screenshot   a .png file to write; then no window opens
    plotter      a pyvista.Plotter to draw into. If None, a new one is used, and shown unless there is a screenshot
    interactive  whether to return PyVista's widget for a notebook, in which the mouse turns the scene

    Returns the plotter, or the widget. riis.view.scene.widget also shows a mesh around the valve.
    """
    pyvista = _pyvista()
    if (mesh is None) != (marks is None):
        raise InvalidArgumentError("marks: must be given together with mesh; one of them is None")
    _check_of_mesh(marks, mesh)
    given = plotter is not None
    if not given:
        plotter = pyvista.Plotter(off_screen=interactive or screenshot is not None, notebook=True if interactive else None)
    _draw(plotter, surface, mesh, marks)
    if not given:
        _look(plotter, 1.2)
    if screenshot is not None:
        plotter.screenshot(os.fspath(screenshot))
    elif not given and not interactive:
        plotter.show()
    return widget_of(plotter) if interactive else plotter


def widget_of(plotter: Any) -> Any:
    """Returns a plotter's scene as PyVista's widget for notebooks. The notebook keeps it, and no server is started."""
    import warnings

    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        try:
            made = plotter.show(jupyter_backend="html", return_viewer=True)
        except ImportError:
            made = None
    if not hasattr(made, "value"):  # PyVista falls back to a picture
        raise ImportError("a widget needs more of PyVista: pip install 'pyvista[jupyter]'")
    return made


def _frame_of(item: Any, number: int, mesh: Mesh | None) -> tuple[Surface, Marks | None, str]:
    """Returns a frame's surface, marks and caption."""
    from riis._riis import Marks, Surface

    parts = item if isinstance(item, tuple) else (item,)
    surface, marks, caption = (*parts, None, "")[:3] if len(parts) == 1 else (*parts, "")[:3]
    if (
        len(parts) > 3
        or not isinstance(surface, Surface)
        or not (marks is None or isinstance(marks, Marks))
        or not isinstance(caption, str)
    ):
        raise TypeError(f"frames: frame {number} must be a Surface, (Surface, marks) or (Surface, marks, caption), not {item!r}")
    if marks is not None and mesh is None:
        raise InvalidArgumentError(f"mesh: is None, but frame {number} of frames has marks")
    _check_of_mesh(marks, mesh)
    return surface, marks, caption


def animate(
    path: str | os.PathLike[str],
    frames: Iterable[Any],
    mesh: Mesh | None = None,
    *,
    frame_rate: float = 12.0,
    plotter: Any = None,
) -> int:
    """Makes a movie of a valve that moves, and returns the number of frames.

    path        a file .gif or .mp4 to write
    frames      an iterable, such as a generator with a time loop. Each item is a Surface, (Surface, marks) or
                (Surface, marks, caption), and is drawn immediately, so all may be the same objects with new content
    mesh        the mesh of the marks
    frame_rate  frames per second
    plotter     a pyvista.Plotter(off_screen=True) with your own camera and objects; it is closed afterwards

    Without plotter, the camera looks at the first frame obliquely from above. If a frame raises an exception, no file is left. A
    movie needs imageio besides PyVista, .mp4 also imageio-ffmpeg: pip install riis[plot].
    """
    pyvista = _pyvista()
    name = os.fspath(path)
    kind = os.path.splitext(name)[1].lower()
    if kind not in (".gif", ".mp4"):
        raise InvalidArgumentError(f"path: '{name}' must end in .gif or .mp4")
    if isinstance(frame_rate, (bool, str)) or not hasattr(frame_rate, "__float__") or numpy.ndim(frame_rate) != 0:
        raise TypeError(f"frame_rate: must be a number, not {frame_rate!r}")
    if not 0.0 < frame_rate <= 1000.0:
        raise InvalidArgumentError(f"frame_rate: is {frame_rate}; it must be above 0 and at most 1000")
    given = plotter is not None
    if not given:
        plotter = pyvista.Plotter(off_screen=True, window_size=(768, 576))  # multiples of 16, as .mp4 needs
    number, complete = 0, False
    try:
        for item in frames:
            surface, marks, caption = _frame_of(item, number, mesh)
            _draw(plotter, surface, mesh, marks)
            plotter.add_text(caption, name="riis caption", font_size=12)
            if number == 0:
                if not given:
                    _look(plotter, 1.1)
                _open_movie(plotter, name, kind, float(frame_rate))
            plotter.write_frame()
            number += 1
        if number == 0:
            raise InvalidArgumentError("frames: has no frame")
        complete = True
    finally:
        plotter.close()
        if number > 0 and not complete:
            os.remove(name)
    return number


def _open_movie(plotter: Any, name: str, kind: str, frame_rate: float) -> None:
    try:
        if kind == ".gif":
            plotter.open_gif(name, fps=frame_rate)
        else:
            plotter.open_movie(name, framerate=frame_rate)
    except ImportError as missing:
        raise ImportError("movies need imageio, .mp4 also imageio-ffmpeg: install riis[plot]") from missing
