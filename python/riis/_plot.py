# SPDX-License-Identifier: Apache-2.0
"""Pictures by PyVista, which is imported for the first picture."""

from __future__ import annotations

import ctypes
import functools
import html
import io
import itertools
import json
import math
import os
import weakref
import zipfile
from collections.abc import Iterable
from typing import TYPE_CHECKING, Any

import numpy

from riis._errors import InvalidArgumentError
from riis._framing import check_grid, frame, frame_widget, notes_of, show_notes

if TYPE_CHECKING:
    from riis._riis import Marks, Mesh, Surface


# Blue, orange, bluish green, reddish purple, vermilion and sky blue can be distinguished with every kind of colour vision (Okabe,
# Ito 2008). The program's pictures have the same colours in the same order.
COLOURS = ("#0072b2", "#e69f00", "#009e73", "#cc79a7", "#d55e00", "#56b4e9")
WALL = "#c9ced6"


def _pyvista() -> Any:
    try:
        import pyvista
    except ImportError as missing:
        raise ImportError("pictures need PyVista: pip install pyvista") from missing
    return pyvista


@functools.cache
def _egl_works() -> bool:
    """Returns whether EGL draws pictures without a display."""
    try:
        egl = ctypes.CDLL("libEGL.so.1")
        query = egl.eglGetProcAddress
        query.restype, query.argtypes = ctypes.c_void_p, [ctypes.c_char_p]
        devices_at, platform_at = query(b"eglQueryDevicesEXT"), query(b"eglGetPlatformDisplayEXT")
        if not devices_at or not platform_at:
            return False
        pointer, integer = ctypes.c_void_p, ctypes.c_int
        query_devices = ctypes.CFUNCTYPE(integer, integer, ctypes.POINTER(pointer), ctypes.POINTER(integer))(devices_at)
        display_of = ctypes.CFUNCTYPE(pointer, integer, pointer, pointer)(platform_at)
        devices, n_devices = (pointer * 16)(), integer(0)
        if not query_devices(16, devices, ctypes.byref(n_devices)):
            return False
        initialize = egl.eglInitialize
        initialize.argtypes = [pointer, pointer, pointer]
        platform_device = 0x313F  # EGL_PLATFORM_DEVICE_EXT
        displays = [display_of(platform_device, device, None) for device in devices[: n_devices.value]]
        return any(display and initialize(display, None, None) for display in displays)
    except (OSError, AttributeError):
        return False


def _new_plotter(off_screen: bool, **how: Any) -> Any:
    """Returns a new plotter. Without a display VTK first tries X, and prints an error, so EGL is chosen here if it works."""
    if off_screen and not os.environ.get("DISPLAY") and "VTK_DEFAULT_OPENGL_WINDOW" not in os.environ and _egl_works():
        os.environ["VTK_DEFAULT_OPENGL_WINDOW"] = "vtkEGLRenderWindow"
    return _pyvista().Plotter(off_screen=off_screen, **how)


def boundary_of(grid: Any) -> Any:
    """Returns the boundary faces of a mesh of PyVista as pyvista.PolyData without arrays."""
    from vtkmodules.vtkFiltersGeometry import vtkGeometryFilter

    bare = grid.NewInstance()
    bare.CopyStructure(grid)
    faces = vtkGeometryFilter()
    faces.SetInputData(bare)
    faces.PassThroughCellIdsOff()
    faces.PassThroughPointIdsOff()
    faces.Update()
    return _pyvista().wrap(faces.GetOutput())


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
    "vertical": True, "position_x": 0.88, "position_y": 0.2, "height": 0.6, "width": 0.06, "n_labels": 3, "fmt": "{:.2g}",
    "title_font_size": 16, "label_font_size": 14,
}


_TO_FRONT = -20_000.0  # moves points forward by about a third of the depth of the scene, in units of VTK


def _bar_title(unit: str | None) -> str:
    return f"distance\nin {unit}\n" if unit else "distance\n"


def round_length(limit: float) -> float:
    """Returns the largest length that has one digit, 1, 2 or 5, and is not above the limit."""
    power = 10.0 ** math.floor(math.log10(limit))
    return next((digit * power for digit in (5.0, 2.0) if digit * power <= limit), power)


class _ScaleBar:
    """A line of a round length at the lower left of a picture, with its length beside it, as in the program's pictures.

    The length is true in the plane through the camera's focal point at right angles to the line of sight. The length of the bar
    is computed anew before each picture, because the camera or the window may have changed.
    """

    def __init__(self) -> None:
        from vtkmodules.vtkCommonDataModel import vtkPolyData
        from vtkmodules.vtkRenderingCore import vtkActor2D, vtkCoordinate, vtkPolyDataMapper2D, vtkTextActor

        self.unit, self.lift, self._observer = "", 0.0, 0
        self._lines, self._line, self._text = vtkPolyData(), vtkActor2D(), vtkTextActor()
        pixels, mapper = vtkCoordinate(), vtkPolyDataMapper2D()
        pixels.SetCoordinateSystemToViewport()
        mapper.SetTransformCoordinate(pixels)
        mapper.SetInputData(self._lines)
        self._line.SetMapper(mapper)
        for look in (self._line.GetProperty(), self._text.GetTextProperty()):
            look.SetColor(*_GREY)
        self._text.GetTextProperty().SetVerticalJustificationToCentered()

    def add_to(self, renderer: Any) -> None:
        """Adds the bar to a renderer. If the renderer was cleared, adds the bar again."""
        self.drop_from(renderer)
        renderer.AddViewProp(self._line)
        renderer.AddViewProp(self._text)
        self._observer = renderer.AddObserver("StartEvent", self.renew)

    def drop_from(self, renderer: Any) -> None:
        renderer.RemoveViewProp(self._line)
        renderer.RemoveViewProp(self._text)
        renderer.RemoveObserver(self._observer)

    def renew(self, renderer: Any, _: str = "") -> None:
        from vtkmodules.vtkCommonCore import vtkPoints
        from vtkmodules.vtkCommonDataModel import vtkCellArray

        width, height = renderer.GetSize()
        camera = renderer.GetActiveCamera()
        if camera.GetParallelProjection():
            tall = 2.0 * camera.GetParallelScale()
        else:
            tall = 2.0 * camera.GetDistance() * math.tan(math.radians(camera.GetViewAngle() / 2.0))
        if not (height > 0 and 0.0 < tall < math.inf):
            return
        length = round_length(0.25 * width * tall / height)
        letter = max(8, round(0.028 * height))
        left, middle, tick = 1.5 * letter, 1.5 * letter + self.lift * height, 0.3 * letter
        right = left + length * height / tall
        points, cells = vtkPoints(), vtkCellArray()
        for ends in (((left, middle), (right, middle)), *(((x, middle - tick), (x, middle + tick)) for x in (left, right))):
            cells.InsertNextCell(2)
            for x, y in ends:
                cells.InsertCellPoint(points.InsertNextPoint(x, y, 0.0))
        self._lines.SetPoints(points)
        self._lines.SetLines(cells)
        self._line.GetProperty().SetLineWidth(max(1.0, height / 400.0))
        self._text.GetTextProperty().SetFontSize(letter)
        self._text.SetPosition(right + 0.6 * letter, middle)
        self._text.SetInput(f"{length:g} {self.unit or ('mesh unit' if length == 1.0 else 'mesh units')}")


_GREY = (0.3, 0.3, 0.3)
_BARS: weakref.WeakKeyDictionary[Any, _ScaleBar] = weakref.WeakKeyDictionary()  # by plotter, so that each has one bar


def add_scale_bar(plotter: Any, unit: str | None, lift: float = 0.0) -> None:
    """Adds a scale bar to a plotter, or changes the unit of its scale bar. None or "" stands for mesh units. The bar is lifted by
    this share of the picture's height."""
    bar = _BARS.setdefault(plotter, _ScaleBar())
    bar.unit, bar.lift = unit or "", lift
    bar.add_to(plotter.renderer)


def drop_scale_bar(plotter: Any) -> None:
    if plotter in _BARS:
        _BARS.pop(plotter).drop_from(plotter.renderer)


def _check_unit(unit: Any) -> None:
    if unit is not None and not isinstance(unit, str):
        raise TypeError(f"unit: must be a text such as 'mm', or None, not {unit!r}")


def coloured(data: Any, valve: int = 0) -> Any:
    """Gives a surface of to_pyvista the cell array colour. The leaflets of a second valve have the next three colours."""
    rgb = numpy.array([[int(colour[at : at + 2], 16) for at in (1, 3, 5)] for colour in COLOURS], numpy.uint8)
    data.cell_data["colour"] = rgb[(3 * valve + numpy.maximum(data.cell_data["leaflet_id"], 0)) % len(COLOURS)]
    return data


def _check_types(surface: Any, mesh: Any, marks: Any, grid: Any = None) -> None:
    from riis._riis import Marks, Mesh, Surface

    if not isinstance(surface, Surface):
        raise TypeError(f"surface: must be a riis.Surface, not {type(surface).__name__}")
    if not (mesh is None or isinstance(mesh, Mesh)):
        raise TypeError(f"mesh: must be the riis.Mesh of the marking, not {type(mesh).__name__}; grid= takes a mesh of PyVista")
    if not (marks is None or isinstance(marks, Marks)):
        raise TypeError(f"marks: must be a riis.Marks, not {type(marks).__name__}")
    _check_grid(grid)


def _check_grid(grid: Any) -> None:
    if not (grid is None or isinstance(grid, _pyvista().DataSet)):
        raise TypeError(f"grid: must be a mesh of PyVista, such as an UnstructuredGrid, not {type(grid).__name__}")


def _check_of_mesh(marks: Marks | None, mesh: Mesh | None) -> None:
    if mesh is not None and marks is not None and marks._places != mesh._places:
        raise InvalidArgumentError(
            "marks: do not belong to mesh as it is now; pass the mesh that riis.mark took, and mark again after its updates"
        )


def point_size_of(n_marks: int, height: int, share: float = 1.0) -> float:
    """Returns the size of a marked node in pixels. Few nodes are drawn large. Many nodes are drawn so small that they do not
    merge. So are nodes of a surface that takes a small share of the picture's height."""
    return max(2.0, min(8.0, 300.0 / max(n_marks, 1) ** 0.5) * min(1.0, 1.7 * share)) * max(height, 1) / 768.0


def _check_of_surface(marks: Marks | None, surface: Surface, mesh: Mesh | None) -> None:
    if marks is None or mesh is None or len(marks) == 0 or hasattr(mesh, "axes"):
        return
    if marks._half_thickness != surface.half_thickness:
        raise InvalidArgumentError(
            f"marks: were made with the half thickness {marks._half_thickness:g}, and surface now has "
            f"{surface.half_thickness:g}; mark again after an update of the surface"
        )
    some = numpy.linspace(0, len(marks) - 1, min(len(marks), 32)).astype(int)
    nodes = numpy.ascontiguousarray(mesh.xyz[marks.ids[some]])
    found = surface.closest_points(nodes, point=False, normal=False, triangle_id=False, leaflet_id=False)
    if (numpy.abs(found.distance - marks.distance[some]) > 1e-3 * surface.half_thickness).any():
        raise InvalidArgumentError(
            "marks: do not belong to surface as it is now; pass the surface that riis.mark took, and mark again after its updates"
        )


def _draw_shell(plotter: Any, grid: Any) -> Any:
    """Draws the boundary of a grid, and returns its points. The shell comes before the marked nodes, which it would dye."""
    boundary = boundary_of(grid)
    plotter.add_mesh(boundary, color=WALL, opacity=0.16, pickable=False, name="riis grid", reset_camera=False)
    points = numpy.asarray(boundary.points, float)
    return points[:: 1 + len(points) // 20_000]


def _draw(
    plotter: Any, surface: Surface, mesh: Mesh | None, marks: Marks | None, unit: str | None, share: float = 1.0
) -> None:
    """Draws or replaces the leaflets and the marked nodes. Leaflets with marked nodes on both sides are translucent."""
    pyvista = _pyvista()
    has_marks = mesh is not None and marks is not None and len(marks) > 0
    for title in [title for title in plotter.scalar_bars.keys() if title.startswith("distance") and title != _bar_title(unit)]:
        plotter.remove_scalar_bar(title)
    plotter.add_mesh(
        coloured(surface_to_pyvista(surface)), scalars="colour", rgb=True, show_scalar_bar=False, ambient=0.3,
        opacity=0.4 if has_marks else 1.0, name="riis leaflets", reset_camera=False,
    )
    if has_marks:
        assert mesh is not None and marks is not None
        nodes = pyvista.PolyData(numpy.array(mesh.xyz[marks.ids]))
        nodes.point_data["distance"] = numpy.array(marks.distance)
        # Without light and in front of the translucent leaflets, the nodes have the colours of the bar.
        how = {"render_points_as_spheres": True, "lighting": False, "reset_camera": False}
        size = point_size_of(len(marks), plotter.window_size[1], share)
        rims = plotter.add_mesh(nodes, color=_GREY, point_size=1.35 * size, show_scalar_bar=False, name="riis rims", **how)
        dots = plotter.add_mesh(
            nodes, scalars="distance", cmap="plasma", clim=[0.0, surface.half_thickness], point_size=size,
            scalar_bar_args={"title": _bar_title(unit), **_BAR}, name="riis marks", **how,
        )
        for actor, depth in (rims, _TO_FRONT), (dots, 1.01 * _TO_FRONT):
            actor.mapper.SetResolveCoincidentTopologyToPolygonOffset()
            actor.mapper.SetRelativeCoincidentTopologyPointOffsetParameter(depth)
    else:
        for name in ("riis marks", "riis rims"):
            plotter.remove_actor(name, reset_camera=False)
    if marks is not None and not has_marks:
        from riis._odd_marks import box_of

        assert mesh is not None
        _, lower, upper = box_of(mesh)
        plotter.add_mesh(
            pyvista.Box([end[k] for k in range(3) for end in (lower, upper)]), style="wireframe", color=_GREY, lighting=False,
            name="riis box", reset_camera=False,
        )
    else:
        plotter.remove_actor("riis box", reset_camera=False)


def _around(mesh: Mesh | None, marks: Marks | None, grid: Any) -> Any:
    """Returns the points that a picture shall show around a surface."""
    if mesh is None or marks is None:
        return grid
    if len(marks) > 0:
        return numpy.array(mesh.xyz[marks.ids]) if grid is None else grid
    from riis._odd_marks import box_of

    _, lower, upper = box_of(mesh)
    corners = numpy.array([[end[k] for k, end in enumerate(ends)] for ends in itertools.product((lower, upper), repeat=3)])
    return corners if grid is None else numpy.concatenate([corners, grid])


def plot(
    surface: Surface,
    mesh: Mesh | None = None,
    marks: Marks | None = None,
    *,
    grid: Any = None,
    screenshot: str | os.PathLike[str] | None = None,
    plotter: Any = None,
    interactive: bool = False,
    unit: str | None = None,
) -> Any:
    """Draws a surface, coloured by leaflet, the marked nodes, coloured by distance, and a scale bar. With marked nodes the
    surface is translucent. If no node is marked, the picture says so, and shows the box of the mesh. The picture also says if the
    valve sticks out of the mesh, and if edges of the grid leak.

    mesh, marks  the mesh and the marks of a marking, both or neither. Mesh and surface must be as they were at the marking
    grid         a mesh of PyVista, whose boundary is drawn as a translucent shell around the valve. The camera shows all of it,
                 unless it is more than five times as long as the valve
    screenshot   a .png file to write; no window opens in this case
    plotter      a pyvista.Plotter to draw into. If None, a new one is used, and shown unless there is a screenshot
    interactive  whether to return a widget for a notebook, in which the mouse turns the scene. It has no scale bar
    unit         of the mesh, such as "mm", at the scale bar and at the colours. None stands for "mesh units"

    Returns the plotter, or the widget. riis.view.scene.widget also shows a mesh around the valve.
    """
    _check_types(surface, mesh, marks, grid)
    if (mesh is None) != (marks is None):
        raise InvalidArgumentError("marks: must be given together with mesh; one of them is None")
    _check_of_mesh(marks, mesh)
    _check_of_surface(marks, surface, mesh)
    _check_unit(unit)
    given = plotter is not None
    if not given:
        plotter = _new_plotter(interactive or screenshot is not None, notebook=True if interactive else None)
    notes = notes_of(surface, mesh, marks, unit)
    around = None
    if grid is not None:
        notes += check_grid(surface, mesh, marks, grid)
        around = _draw_shell(plotter, grid)
    n_lines, share = 0 if interactive else show_notes(plotter, notes), 1.0
    if not given:
        around = _around(mesh, marks, around)
        has_marks = marks is not None and len(marks) > 0
        if interactive:
            frame_widget(plotter, surface, around)
        else:
            share = frame(plotter, surface, around, has_bar=has_marks, n_lines=n_lines, is_whole=not has_marks)
    _draw(plotter, surface, mesh, marks, unit, share)
    plotter.renderer.reset_camera_clipping_range()
    if not interactive:
        add_scale_bar(plotter, unit)
    if screenshot is not None:
        plotter.render()  # a plotter that has drawn before would otherwise return its last picture
        plotter.screenshot(os.fspath(screenshot))
    elif not given and not interactive:
        plotter.show()
    return widget_of(plotter) if interactive else plotter


def widget_of(plotter: Any) -> Any:
    """Returns a plotter's scene as a widget for notebooks, which keeps the whole scene.

    trame describes the scene, and its page shows it. PyVista's own exporter does the same, but first it starts a server, which
    takes over the signals of the process, makes all of asyncio nestable, and downloads files in the background.
    """
    try:
        from ipywidgets import HTML
        from trame_vtk.modules.vtk.protocols.local_rendering import vtkWebLocalRendering
        from trame_vtk.tools.vtksz2html import write_html
        from vtkmodules.vtkWebCore import vtkWebApplication
    except ImportError as missing:
        raise ImportError("a widget needs more of PyVista: pip install 'pyvista[jupyter]'") from missing

    class Exporter(vtkWebLocalRendering):
        app = vtkWebApplication()  # otherwise the server's

    for renderer in plotter.renderers:
        if not renderer.camera.is_set:
            renderer.camera_position = renderer.get_default_cam_pos()
            renderer.ResetCamera()
    axes = [renderer.axes_widget for renderer in plotter.renderers if getattr(renderer, "axes_widget", None) is not None]
    number = Exporter.app.GetObjectIdMap().GetGlobalId(plotter.render_window)
    scene = Exporter().get_standalone_state(number, widgets=axes)
    packed, page = io.BytesIO(), io.StringIO()
    with zipfile.ZipFile(packed, "w", zipfile.ZIP_DEFLATED) as file:
        file.writestr("index.json", json.dumps(scene))
    write_html(packed.getvalue(), page)
    width, height = plotter.window_size
    style = f"width: {width}px; height: {height}px; border: 1px solid rgb(221, 221, 221);"
    return HTML(f'<iframe srcdoc="{html.escape(page.getvalue())}" style="{style}"></iframe>')


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
    _check_types(surface, mesh, marks)
    _check_of_mesh(marks, mesh)
    _check_of_surface(marks, surface, mesh)
    return surface, marks, caption


def animate(
    path: str | os.PathLike[str],
    frames: Iterable[Any],
    mesh: Mesh | None = None,
    *,
    frame_rate: float = 12.0,
    plotter: Any = None,
    unit: str | None = None,
    grid: Any = None,
) -> int:
    """Makes a movie of a valve that moves, and returns the number of frames.

    path        a file .gif or .mp4 to write
    frames      an iterable, such as a generator with a time loop. Each item is a Surface, (Surface, marks) or (Surface, marks,
                caption). It is drawn immediately, so all items may be the same objects with new content
    mesh        the mesh of the marks
    frame_rate  frames per second
    plotter     a pyvista.Plotter(off_screen=True) with your own camera and objects, which is closed afterwards
    unit        of the mesh, such as "mm", at the scale bar and at the colours. None stands for "mesh units"
    grid        a mesh of PyVista, whose boundary is drawn as a translucent shell in every frame

    Without plotter, the camera looks at the first frame, obliquely from above. If a frame raises an exception, no file is left. A
    movie needs imageio in addition to PyVista. A .mp4 also needs imageio-ffmpeg.
    """
    _pyvista()
    name = os.fspath(path)
    kind = os.path.splitext(name)[1].lower()
    if kind not in (".gif", ".mp4"):
        raise InvalidArgumentError(f"path: '{name}' must end in .gif or .mp4")
    if isinstance(frame_rate, (bool, str)) or not hasattr(frame_rate, "__float__") or numpy.ndim(frame_rate) != 0:
        raise TypeError(f"frame_rate: must be a number, not {frame_rate!r}")
    if not 0.0 < frame_rate <= 1000.0:
        raise InvalidArgumentError(f"frame_rate: is {frame_rate}; it must be above 0 and at most 1000")
    _check_unit(unit)
    _check_grid(grid)
    given = plotter is not None
    if not given:
        plotter = _new_plotter(True, window_size=(768, 576))  # multiples of 16, as .mp4 needs
    number, complete, shell, share = 0, False, None, 1.0
    try:
        for item in frames:
            surface, marks, caption = _frame_of(item, number, mesh)
            if number == 0 and grid is not None:
                shell = _draw_shell(plotter, grid)
            show_notes(plotter, notes_of(surface, mesh, marks, unit) if marks is not None and len(marks) == 0 else [])
            _caption(plotter, caption)
            if number == 0 and not given:
                share = frame(plotter, surface, _around(mesh, marks, shell), has_bar=marks is not None, n_lines=1)
            _draw(plotter, surface, mesh, marks, unit, share)
            plotter.renderer.reset_camera_clipping_range()
            if number == 0:
                add_scale_bar(plotter, unit)
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


def _caption(plotter: Any, caption: str) -> None:
    """Writes the caption of a frame at its upper right, away from the notes."""
    text = plotter.add_text(caption, position=(0.975, 0.97), viewport=True, name="riis caption", font_size=12)
    text.prop.SetVerticalJustificationToTop()
    text.prop.SetJustificationToRight()


def _open_movie(plotter: Any, name: str, kind: str, frame_rate: float) -> None:
    try:
        if kind == ".gif":
            plotter.open_gif(name, fps=frame_rate)
        else:
            plotter.open_movie(name, framerate=frame_rate)
    except ImportError as missing:
        raise ImportError("movies need imageio, .mp4 also imageio-ffmpeg: pip install imageio imageio-ffmpeg") from missing
