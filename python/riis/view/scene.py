# SPDX-License-Identifier: Apache-2.0
"""The picture of a Model: the mesh, the leaflets, the cells around them, and the places that the lights report.

A scene draws into a PyVista plotter without a window, or into a plotter of a notebook. The objects of a scene stay in place while
a valve moves, and only their points and cells change. All calls of a scene must come from one thread.
"""

from __future__ import annotations

import math
import os
import time
import warnings
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from typing import Any

import numpy

from riis._errors import MarksWarning
from riis._plot import COLOURS, WALL, _egl_works, _pyvista, add_scale_bar, boundary_of, coloured, drop_scale_bar, widget_of
from riis.view._valves import point, refuse

PARTLY, LEAK, CROSSING, ORIFICE, HANDLE = "#9aa3b2", "#d50000", "#cc00aa", "#111111", "#333333"
BUMP, LANDMARK, CHOSEN, GAP = "#5e35b1", "#1b5e20", "#d50000", "#ff7043"
WALLS = ("cut", "clear", "none")
CELLS = ("partly", "marked", "none")
LOOKS = ("oblique", "top", "side")
LEAST_SIDE, MOST_SIDE = 64, 4096  # of a picture, in pixels
_LETTER = 15  # size of the names of landmarks, in pixels
_HELPERS = ("riis light ", "riis gap", "riis handle", "riis points", "riis bump")  # that a report does not show
SLOW = 0.12  # seconds; if a picture takes longer while a hand moves, the next picture has fewer pixels
MANY_MARKED = 400_000  # if more cells are marked, they are drawn only while the hand rests
MANY_CELLS = 2_000_000  # larger meshes show only the cut through the cells near the valve


def check_of_graphics() -> None:
    """If pictures cannot be drawn here, raises RuntimeError with the packages that are missing.

    Without an X display VTK draws by EGL. The libraries of Debian for this are libegl1 and, without a graphics card,
    libgl1-mesa-dri.
    """
    if os.environ.get("VTK_DEFAULT_OPENGL_WINDOW"):
        return
    if _egl_works():
        os.environ["VTK_DEFAULT_OPENGL_WINDOW"] = "vtkEGLRenderWindow"  # no window, even if there is a display
    elif not os.environ.get("DISPLAY"):
        raise RuntimeError(
            "no display, and no EGL that draws without one: install two packages by sudo apt-get install libegl1 libgl1-mesa-dri"
        )


def colour_of(valve: int, leaflet: int) -> str:
    """Returns the colour of a leaflet, such as '#0072b2'. The leaflets of a second valve have the next three colours."""
    return COLOURS[(3 * valve + leaflet) % len(COLOURS)]


def places_of(view: Mapping[str, Any]) -> dict[str, Any]:
    """Returns the places of Scene.view(). Refuses places that are not three numbers, and directions that are zero."""
    names = ["position", "focal_point", "up"] + ["cut_origin", "cut_normal"] * ("cut_normal" in view)
    places = {name: point(view.get(name), name) for name in names}
    directions = places | {"position": places["position"] - places["focal_point"]}
    for name in ("position", "up", "cut_normal"):
        if name in directions and not directions[name].any():
            raise refuse(f"{name}: is {view[name]!r}, which gives no direction")
    return places


class Scene:
    """The picture of a riis.view.Model.

    model    the Model. The scene reads the model and never changes it
    grid     the mesh as pyvista.UnstructuredGrid, with the nodes and cells of the model, or None for leaflets alone
    wall     the mesh's boundary as pyvista.PolyData. If None, the scene extracts it. A wall of the model is drawn in its place
    plotter  the pyvista.Plotter to draw into. If None, the scene makes one without a window
    """

    def __init__(
        self, model: Any, grid: Any = None, *, wall: Any = None, plotter: Any = None, size: tuple[int, int] = (900, 700)
    ) -> None:
        pyvista = _pyvista()
        if plotter is None:
            check_of_graphics()
            plotter = pyvista.Plotter(off_screen=True, window_size=size)
        self.plotter, self.model, self.grid = plotter, model, grid
        self._size, self._ratio = (int(plotter.window_size[0]), int(plotter.window_size[1])), 1.0
        self._pv = pyvista
        self._boundary = wall if wall is not None or grid is None else boundary_of(grid)
        self._given_wall: Any = None
        self._wall: Any = None
        self._how, self._cells_shown = "cut", "partly"
        self._plane: Any = None
        self._waiting = False  # whether marked cells are drawn only after the hand rests
        self._shown: Any = None
        self._data: dict[str, Any] = {}
        self._actors: dict[str, Any] = {}
        self._wall_actors: dict[str, Any] = {}
        self._placed: Any = None
        self._labels: list[Any] = []
        plotter.set_background("white")
        self.renew_wall()

    # the wall and the mesh

    def renew_wall(self) -> None:
        """Draws the wall of the model. If the model has none, draws the boundary of the mesh."""
        given = self.model.wall
        if self._wall is not None and given is self._given_wall:
            return
        self._given_wall = given
        for name in ("riis wall", "riis clear wall"):
            self.plotter.remove_actor(name, reset_camera=False)
        self._wall_actors, before = {}, self._plane
        self._wall = self._boundary if given is None else self._shell(given)
        if self._wall is None:
            self._plane = None
            return
        self._add_wall(before)

    def _shell(self, given: Any) -> Any:
        """Returns the triangles of a wall, with normals for smooth light."""
        faces = numpy.full((len(given.triangles), 4), 3, numpy.int64)
        faces[:, 1:] = given.triangles
        data = self._pv.PolyData(given.points, faces.ravel())
        return data.compute_normals(cell_normals=False, split_vertices=True, feature_angle=50.0)

    def _add_wall(self, plane: Any = None) -> None:
        from vtkmodules.vtkCommonDataModel import vtkPlane

        self._plane = plane or vtkPlane()
        common = {"color": WALL, "reset_camera": False, "pickable": True, "show_scalar_bar": False}
        solid = self.plotter.add_mesh(self._wall, ambient=0.35, specular=0.0, name="riis wall", **common)
        solid.mapper.AddClippingPlane(self._plane)
        lit = {"opacity": 0.16} if self._given_wall is None else {
            "opacity": 0.3, "smooth_shading": False, "ambient": 0.25, "diffuse": 0.8, "specular": 0.35, "specular_power": 25.0}
        clear = self.plotter.add_mesh(self._wall.copy(deep=False), name="riis clear wall", **lit, **common)
        self._wall_actors = {"cut": solid, "clear": clear}
        self._show_wall()

    def _show_wall(self) -> None:
        for how, actor in self._wall_actors.items():
            actor.SetVisibility(how == self._how)
        if "riis cut" in self._actors:
            self._actors["riis cut"].SetVisibility(self._how == "cut")

    def freeze(self) -> None:
        """Cuts the wall itself. In other cases a plane hides the half towards the camera, but vtk.js does not support such a
        plane.

        vtk.js does not support a scale bar either.
        """
        drop_scale_bar(self.plotter)
        if self._plane is not None and self._wall is not None:
            rest = self._wall.clip(normal=self._plane.GetNormal(), origin=self._plane.GetOrigin(), invert=False)
            self.plotter.remove_actor("riis wall", reset_camera=False)
            self.plotter.remove_actor("riis clear wall", reset_camera=False)
            still = self.plotter.add_mesh(rest, color=WALL, ambient=0.35, name="riis wall", reset_camera=False)
            self._wall_actors = {"cut": still}

    def show_wall(self, how: str) -> None:
        """Shows the mesh's boundary cut open ("cut"), see-through ("clear") or not at all ("none")."""
        if how not in WALLS:
            raise refuse(f"wall: is '{how}'; it must be one of {', '.join(WALLS)}")
        self._how = how
        self._show_wall()
        self.show_cut()

    def cut_here(self, origin: Any, axis: Any) -> None:
        """Cuts the mesh along the valve's axis, and removes the half towards the camera."""
        if self._plane is None:
            return
        towards = numpy.subtract(self.plotter.camera.position, self.plotter.camera.focal_point)
        axis = numpy.asarray(axis, float)
        normal = towards - axis * (towards @ axis)
        at = numpy.asarray(origin, float)
        if numpy.linalg.norm(normal) < 0.3 * numpy.linalg.norm(towards):  # along the axis: take away what lies before the valve
            normal = axis if towards @ axis > 0.0 else -axis
            if self._shown is not None and self._shown.surfaces:
                at = at + normal * max(((s.points - at) @ normal).max(initial=0.0) for s in self._shown.surfaces)
        normal = -normal / numpy.linalg.norm(normal)
        self._plane.SetOrigin(*(float(x) for x in at))
        self._plane.SetNormal(*(float(x) for x in normal))
        self._placed = None

    def show_cut(self) -> None:
        """Draws the cells' edges in the plane of the cut. Drawing the edges takes longer than a move of a leaflet, so call it
        when the mouse rests."""
        if self._plane is None or self._how != "cut" or self.grid is None:
            return
        place = (self._plane.GetOrigin(), self._plane.GetNormal())
        if self._placed == place:
            return
        self._placed = place
        grid = self.grid
        if grid.n_cells > MANY_CELLS and self._shown is not None:
            grid = self._near_valves(grid)
        lines = grid.slice(normal=place[1], origin=place[0]).extract_all_edges() if grid.n_cells > 0 else self._pv.PolyData()
        self._put("riis cut", lines, color="#8d97a5", line_width=1, opacity=0.55, pickable=False, lighting=False)

    def _near_valves(self, grid: Any) -> Any:
        bounds = numpy.array([[s.points.min(axis=0), s.points.max(axis=0)] for s in self._shown.surfaces if len(s.points)])
        if len(bounds) == 0:
            return grid.extract_cells(numpy.zeros(0, int))
        low, high = bounds[:, 0].min(axis=0), bounds[:, 1].max(axis=0)
        margin = 0.15 * numpy.linalg.norm(high - low)
        inside = numpy.all((grid.points >= low - margin) & (grid.points <= high + margin), axis=1)
        offsets = grid.cell_offsets if hasattr(grid, "cell_offsets") else grid.offset  # PyVista 0.49 renamed it
        return grid.extract_cells(numpy.flatnonzero(inside[grid.cell_connectivity[offsets[:-1]]]))

    # what moves

    def _put(self, name: str, data: Any, **how: Any) -> None:
        """Draws data as an object with a name. If an object has the name already, gives it the data."""
        if name in self._data:
            self._data[name].shallow_copy(data)
            self._actors[name].SetVisibility(data.n_points > 0)
            return
        if data.n_points == 0:
            return
        self._data[name] = data
        self._actors[name] = self.plotter.add_mesh(data, name=name, reset_camera=False, show_scalar_bar=False, **how)

    def _drop(self, name: str) -> None:
        self._data.pop(name, None)
        self._actors.pop(name, None)
        self.plotter.remove_actor(name, reset_camera=False)

    def show(self, shown: Any, quick: bool = False) -> None:
        """Draws what Model.update() returned: leaflets and cells near them. In a quick show, very many cells are drawn only by
        rest()."""
        self._shown = shown
        add_scale_bar(self.plotter, self.model.unit, lift=0.03)  # above the page's legend
        self._waiting = quick and len(shown.cells_marked) + len(shown.cells_partly) > MANY_MARKED
        for k, surface in enumerate(shown.surfaces):
            faces = numpy.full((len(surface.triangles), 4), 3, numpy.int64)
            faces[:, 1:] = surface.triangles
            data = self._pv.PolyData(numpy.array(surface.points, float), faces.ravel())
            if len(faces) > 0:
                data = data.compute_normals(
                    cell_normals=False, split_vertices=False, consistent_normals=False, auto_orient_normals=False
                )
            data.cell_data["leaflet_id"] = surface.leaflet
            name = f"riis valve {k}"
            self._put(name, coloured(data, k), scalars="colour", rgb=True, ambient=0.3, specular=0.15, pickable=False)
        for name in [name for name in self._data if name.startswith("riis valve ")]:
            if int(name.split()[-1]) >= len(shown.surfaces):
                self._drop(name)
        self._show_cells()

    def rest(self) -> None:
        """Draws what a quick show has left out, and the mesh in the plane of the cut."""
        if self._waiting:
            self._waiting = False
            self._show_cells()
        self.show_cut()

    def show_cells(self, which: str) -> None:
        """Shows the cells with a marked node ("partly"), only the cells with all nodes marked ("marked"), or none."""
        if which not in CELLS:
            raise refuse(f"cells: is '{which}'; it must be one of {', '.join(CELLS)}")
        self._cells_shown = which
        if self._shown is not None:
            self._show_cells()

    def _show_cells(self) -> None:
        empty = self._pv.PolyData()
        marked = partly = empty
        if self.grid is not None and self._cells_shown != "none" and not self._waiting:
            marked = self._hull(self._shown.cells_marked)
            if self._cells_shown == "partly":
                partly = self._hull(self._shown.cells_partly)
        self._put("riis marked cells", marked, color="#56b4e9", opacity=0.24, ambient=0.3, pickable=False)
        self._put("riis partly marked cells", partly, color="#f0e442", opacity=0.07, ambient=0.4, pickable=False)

    def _hull(self, cells: Any) -> Any:
        cells = numpy.asarray(cells)
        if cells.dtype == bool:
            cells = numpy.flatnonzero(cells)
        if len(cells) == 0:
            return self._pv.PolyData()
        return boundary_of(self.grid.extract_cells(cells))

    # things that the lights report, and handles

    def show_lights(self, lights: Any) -> None:
        """Draws the points and edges of the lights: passages in red, crossings in magenta."""
        drawn = set()
        for light in lights:
            if light.level in ("good", "off") or (len(light.points) == 0 and len(light.edges) == 0):
                continue
            name = f"riis light {light.name}"
            n_edges, points = len(light.edges), numpy.asarray(light.points, float).reshape(-1, 3)
            both = numpy.concatenate([numpy.asarray(light.edges, float).reshape(-1, 3), points])
            lines = numpy.full((n_edges, 3), 2, numpy.int64)
            lines[:, 1:] = numpy.arange(2 * n_edges).reshape(-1, 2)
            corners = numpy.full((len(points), 2), 1, numpy.int64)
            corners[:, 1] = 2 * n_edges + numpy.arange(len(points))
            data = self._pv.PolyData(
                both, lines=lines.ravel() if n_edges else None, verts=corners.ravel() if len(points) else None
            )
            self._drop(name)
            self._put(
                name, data, color=CROSSING if light.name == "crossing" else LEAK, line_width=6, point_size=10, lighting=False,
                pickable=False,
            )
            drawn.add(name)
        for name in [name for name in self._data if name.startswith("riis light ") and name not in drawn]:
            self._drop(name)

    def show_orifice(self, lines: Any, axis: Any = (0.0, 0.0, 1.0), least: float = 0.0) -> None:
        """Draws closed lines, each an array of shape (n, 3), around at least this area. The lines are smooth, and flat across the
        axis."""
        self._drop("riis orifice")
        lines = [numpy.asarray(line, float) for line in lines if len(line) > 8]
        lines = [_smooth(line, numpy.asarray(axis, float)) for line in lines if _area_of(line) > least]
        if not lines:
            return
        starts = numpy.cumsum([0] + [len(line) for line in lines])
        rows = [
            numpy.concatenate([[len(line) + 1], start + numpy.arange(len(line)), [start]]) for start, line in zip(starts, lines)
        ]
        data = self._pv.PolyData(numpy.concatenate(lines), lines=numpy.concatenate(rows))
        self._put("riis orifice", data, color=ORIFICE, line_width=4, lighting=False, pickable=False)

    def show_gap(self, points: Any, triangles: Any) -> None:
        """Draws the gap between the valve and the wall as a ribbon, or nothing."""
        self._drop("riis gap")
        if len(triangles) > 0:
            faces = numpy.full((len(triangles), 4), 3, numpy.int64)
            faces[:, 1:] = triangles
            data = self._pv.PolyData(numpy.array(points, float), faces.ravel())
            self._put("riis gap", data, color=GAP, opacity=0.75, ambient=0.5, pickable=False)

    def show_landmarks(self, landmarks: Mapping[str, Any], chosen: str = "") -> None:
        """Draws landmarks as points with their names. The chosen landmark is red."""
        for name in ("riis landmarks", "riis chosen landmark"):
            self._drop(name)
        for label in self._labels:
            self.plotter.renderer.RemoveViewProp(label)
        self._labels = [self._label_of(name.replace("_", " "), at) for name, at in landmarks.items()]
        for label in self._labels:
            self.plotter.renderer.AddViewProp(label)
        for name, colour, points in (
            ("riis landmarks", LANDMARK, [at for one, at in landmarks.items() if one != chosen]),
            ("riis chosen landmark", CHOSEN, [at for one, at in landmarks.items() if one == chosen]),
        ):  # fmt: skip
            if points:
                self._put(name, self._pv.PolyData(numpy.array(points, float)), color=colour, point_size=13,
                          render_points_as_spheres=True, lighting=False, pickable=False)
    def _label_of(self, text: str, at: Any) -> Any:
        """Returns a text beside a point, in front of everything."""
        from vtkmodules.vtkRenderingCore import vtkTextActor

        label = vtkTextActor()
        label.SetInput(f"  {text} ")
        label.GetPositionCoordinate().SetCoordinateSystemToWorld()
        label.GetPositionCoordinate().SetValue(*(float(x) for x in at))
        look = label.GetTextProperty()
        look.SetFontSize(_LETTER)
        look.SetVerticalJustificationToCentered()
        look.SetColor(0.07, 0.07, 0.07)
        look.SetBackgroundColor(1.0, 1.0, 1.0)
        look.SetBackgroundOpacity(0.6)
        return label

    def show_points(self, points: Any) -> None:
        """Draws points that were clicked."""
        self._drop("riis points")
        if len(points) > 0:
            data = self._pv.PolyData(numpy.asarray(points, float))
            self._put(
                "riis points", data, color=LEAK, point_size=14, render_points_as_spheres=True, lighting=False, pickable=False
            )

    def show_bump(self, lines: Any, point: Any = None) -> None:
        """Draws the lines (n, 3) of a free edge on which a bump acts, and its place, or nothing."""
        for name in ("riis bump", "riis bump place"):
            self._drop(name)
        if len(lines) > 0:
            ends = numpy.cumsum([0] + [len(line) for line in lines])
            rows = [numpy.concatenate([[len(line)], start + numpy.arange(len(line))]) for start, line in zip(ends, lines)]
            data = self._pv.PolyData(numpy.concatenate(lines), lines=numpy.concatenate(rows))
            self._put("riis bump", data, color=BUMP, line_width=7, lighting=False, pickable=False)
        if point is not None:
            data = self._pv.PolyData(numpy.asarray(point, float).reshape(1, 3))
            self._put(
                "riis bump place", data, color=BUMP, point_size=18, render_points_as_spheres=True, lighting=False, pickable=False
            )

    def show_handle(self, origin: Any = None, flow: Any = None, length: float = 1.0) -> None:
        """Draws an arrow from the valve's origin along its axis, in the direction of flow, or nothing."""
        self._drop("riis handle")
        if origin is not None:
            arrow = self._pv.Arrow(
                start=origin, direction=flow, tip_length=0.12, tip_radius=0.025, shaft_radius=0.006, scale=length,
                tip_resolution=24,
            )
            self._put("riis handle", arrow, color=HANDLE, ambient=0.4, pickable=False)

    # the camera

    def look(self, how: str, origin: Any = None, axis: Any = None, reference: Any = None, reach: float | None = None) -> None:
        """Looks at the valve obliquely, from the tip of its z axis ("top") or from the side. Without a valve, the camera looks at
        everything."""
        if how not in LOOKS:
            raise refuse(f"look: is '{how}'; it must be one of {', '.join(LOOKS)}")
        z = numpy.array([0.0, 0.0, 1.0]) if axis is None else numpy.asarray(axis, float)
        x = numpy.array([1.0, 0.0, 0.0]) if reference is None else numpy.asarray(reference, float)
        y = numpy.cross(z, x)
        direction, up = {"oblique": (-0.55 * x - 1.0 * y + 0.75 * z, z), "top": (z, y), "side": (-y, z)}[how]
        self.plotter.view_vector(direction, viewup=up)
        self.plotter.reset_camera()
        if origin is not None and reach:
            camera = self.plotter.camera
            direction = direction / numpy.linalg.norm(direction)
            distance = reach / math.sin(math.radians(camera.view_angle / 2))
            camera.focal_point = tuple(origin)
            camera.position = tuple(numpy.asarray(origin) + distance * direction)
            self.plotter.renderer.ResetCameraClippingRange()

    def view(self) -> dict[str, list[float]]:
        """Returns the camera and the plane of the cut as plain numbers, which set_view takes."""
        camera = self.plotter.camera
        places = {"position": camera.position, "focal_point": camera.focal_point, "up": camera.up}
        if self._plane is not None:
            places |= {"cut_origin": self._plane.GetOrigin(), "cut_normal": self._plane.GetNormal()}
        return {name: [float(x) for x in place] for name, place in places.items()}

    def set_view(self, view: Mapping[str, Any]) -> None:
        """Sets the camera and the cut as view() described them."""
        places = places_of(view)
        for name in ("position", "focal_point", "up"):
            setattr(self.plotter.camera, name, tuple(places[name].tolist()))
        self.plotter.renderer.ResetCameraClippingRange()
        if self._plane is not None and "cut_normal" in places:
            self._plane.SetOrigin(*places["cut_origin"].tolist())
            self._plane.SetNormal(*places["cut_normal"].tolist())
            self._placed = None

    def turn_view(self, dx: float, dy: float) -> None:
        """Turns the camera about its focal point. dx and dy are shares of the picture's height."""
        camera = self.plotter.camera
        camera.Azimuth(-180.0 * dx)
        camera.Elevation(-180.0 * dy)
        camera.OrthogonalizeViewUp()
        self.plotter.renderer.ResetCameraClippingRange()

    def world_step(self, dx: float, dy: float, at: Any = None) -> Any:
        """Returns the step in space that a drag by dx and dy means at a point, or at the camera's focal point."""
        camera = self.plotter.camera
        position, focus = numpy.array(camera.position), numpy.array(camera.focal_point)
        forward = (focus - position) / numpy.linalg.norm(focus - position)
        right = numpy.cross(forward, camera.up)
        right /= numpy.linalg.norm(right)
        depth = numpy.dot((focus if at is None else numpy.asarray(at)) - position, forward)
        height = 2.0 * depth * math.tan(math.radians(camera.view_angle / 2))
        return height * (dx * right + dy * numpy.cross(right, forward))

    def axes_of_view(self) -> tuple[Any, Any]:
        """Returns the unit vectors to the right and upwards in the picture."""
        camera = self.plotter.camera
        forward = numpy.subtract(camera.focal_point, camera.position)
        forward /= numpy.linalg.norm(forward)
        right = numpy.cross(forward, camera.up)
        right /= numpy.linalg.norm(right)
        return right, numpy.cross(right, forward)

    def move_view(self, dx: float, dy: float) -> None:
        step, camera = self.world_step(dx, dy), self.plotter.camera
        camera.position = tuple(numpy.subtract(camera.position, step))
        camera.focal_point = tuple(numpy.subtract(camera.focal_point, step))
        self.plotter.renderer.ResetCameraClippingRange()

    def zoom(self, dy: float) -> None:
        self.plotter.camera.Dolly(math.exp(max(-2.0, min(2.0, dy))))
        self.plotter.renderer.ResetCameraClippingRange()

    def pick(self, x: float, y: float) -> Any:
        """Returns the point of the mesh's wall behind a point of the picture, or None.

        x and y are from 0 to 1, from the picture's lower left corner.
        """
        from vtkmodules.vtkRenderingCore import vtkCellPicker

        picker = vtkCellPicker()
        picker.SetTolerance(0.0005)
        picker.PickFromListOn()
        actor = self._wall_actors.get("cut" if self._how == "cut" else "clear")
        if actor is None:
            return None
        visible = actor.GetVisibility()
        actor.SetVisibility(True)
        picker.AddPickList(actor)
        width, height = self.plotter.render_window.GetSize()
        found = picker.Pick(x * width, y * height, 0.0, self.plotter.renderer)
        actor.SetVisibility(visible)
        return numpy.array(picker.GetPickPosition()) if found else None

    # the picture

    @property
    def size(self) -> tuple[int, int]:
        """The width and the height of a sharp picture, in pixels."""
        return self._size

    def resize(self, width: int, height: int) -> None:
        self._size = tuple(max(LEAST_SIDE, min(MOST_SIDE, int(side))) for side in (width, height))  # type: ignore[assignment]
        self._set_window(1.0)

    def _set_window(self, ratio: float) -> None:
        size = tuple(int(ratio * length + 0.5) for length in self._size)
        if tuple(self.plotter.render_window.GetSize()) != size:
            self.plotter.window_size = list(size)

    def quick_picture(self) -> bytes:
        """Returns the picture as the bytes of a JPEG file, with so few pixels that it keeps up with a moving hand."""
        self.plotter.render_window.SetMultiSamples(0)
        self._set_window(self._ratio)
        start = time.perf_counter()
        made = self._jpeg(75)
        seconds = time.perf_counter() - start
        if seconds > SLOW and self._ratio > 0.5:
            self._ratio = max(0.5, 0.8 * self._ratio)
        elif seconds < 0.4 * SLOW and self._ratio < 1.0:
            self._ratio = min(1.0, self._ratio / 0.8)
        return made

    def picture(self) -> bytes:
        """Returns the picture as the bytes of a JPEG file, with all pixels and smooth edges."""
        self.sharpen()
        return self._jpeg(92)

    def sharpen(self) -> None:
        """Gives the next picture all pixels and smooth edges."""
        self.plotter.render_window.SetMultiSamples(4)
        self._set_window(1.0)

    def _jpeg(self, quality: int) -> bytes:
        from vtkmodules.vtkIOImage import vtkJPEGWriter
        from vtkmodules.vtkRenderingCore import vtkWindowToImageFilter

        window = self.plotter.render_window
        window.Render()
        image = vtkWindowToImageFilter()
        image.SetInput(window)
        image.ReadFrontBufferOff()
        image.ShouldRerenderOff()
        writer = vtkJPEGWriter()
        writer.SetQuality(quality)
        writer.ProgressiveOff()
        writer.WriteToMemoryOn()
        writer.SetInputConnection(image.GetOutputPort())
        writer.Write()
        return memoryview(writer.GetResult()).tobytes()

    def save_picture(self, path: str, size: tuple[int, int] | None = None) -> None:
        """Writes the picture as .png, without the aids for placing the valve: lights, the gap, the axis and clicked points.

        size  width and height in pixels, by default the page's. Lines, points and letters grow with the height
        """
        with self.for_a_report(size):
            self.plotter.screenshot(path)

    @contextmanager
    def for_a_report(self, size: tuple[int, int] | None = None) -> Iterator[None]:
        """During this context, the picture has this size, and no lights and handles."""
        before, hidden = self._size, self.hide_helpers()
        try:
            if size is not None:
                self.resize(*size)
            grown = self._size[1] / before[1]
            with self._grown(grown):
                self.sharpen()
                yield
        finally:
            for actor in hidden:
                actor.SetVisibility(True)
            self.resize(*before)

    def hide_helpers(self) -> list[Any]:
        """Hides the aids for placing the valve. Returns the actors that were visible."""
        hidden = [actor for name, actor in self._actors.items() if name.startswith(_HELPERS) and actor.GetVisibility()]
        for actor in hidden:
            actor.SetVisibility(False)
        return hidden

    @contextmanager
    def _grown(self, factor: float) -> Iterator[None]:
        """During this context, lines, points and letters are larger by a factor."""
        looks = [actor.GetProperty() for actor in self._actors.values() if hasattr(actor, "GetProperty")]
        sizes = [(look, look.GetLineWidth(), look.GetPointSize()) for look in looks]
        letters = [label.GetTextProperty() for label in self._labels]
        try:
            for look, width, point_size in sizes:
                look.SetLineWidth(factor * width)
                look.SetPointSize(factor * point_size)
            for letter in letters:
                letter.SetFontSize(max(6, round(factor * _LETTER)))
            yield
        finally:
            for look, width, point_size in sizes:
                look.SetLineWidth(width)
                look.SetPointSize(point_size)
            for letter in letters:
                letter.SetFontSize(_LETTER)

    def close(self) -> None:
        self.plotter.close()


def widget(model: Any, grid: Any = None) -> Any:
    """Returns a widget that shows a Model in a notebook: the mesh cut open, the leaflets, the marked cells, the lights' places.

    model  a riis.view.model.Model
    grid   its mesh as pyvista.UnstructuredGrid; without it the leaflets are alone

    The mouse turns the scene. Call it again after a change of the model. If no node is marked, or the unit looks
    wrong, it gives a riis.MarksWarning. It needs pyvista[jupyter].
    """
    check_of_graphics()
    scene = Scene(model, grid, plotter=_pyvista().Plotter(notebook=True, off_screen=True, window_size=(900, 600)))
    shown = model.update()
    scene.show(shown)
    is_unmarked = grid is not None and len(shown.surfaces) > 0 and len(shown.marked) == 0
    if shown.surfaces:
        valve, points = model.valves[0], numpy.asarray(shown.surfaces[0].points)
        if is_unmarked:  # looks at both
            points = numpy.concatenate([points, numpy.reshape(grid.bounds, (3, 2)).T])
        centre = 0.5 * (points.min(axis=0) + points.max(axis=0))
        reach = float(numpy.linalg.norm(points - centre, axis=1).max())
        scene.look("oblique", centre, valve.axis, valve.reference, 1.45 * reach)
        scene.cut_here(valve.origin, valve.axis)
    scene.show_cut()
    lights = model.lights()
    scene.show_lights(lights)
    judged = ("unit", "inside") if is_unmarked else ("unit",)
    wrong = [f"{one.text}: {one.advice}" for one in lights if one.name in judged and one.level in ("bad", "warn")]
    if wrong:
        warnings.warn("; ".join(wrong), MarksWarning, stacklevel=2)
    scene.freeze()
    return widget_of(scene.plotter)


def _smooth(line: Any, axis: Any) -> Any:
    """Returns a closed line in the plane of its mean height, without the steps of the grid on which it was found."""
    height = line @ axis
    line = line + numpy.outer(height.mean() - height, axis)
    return numpy.mean([numpy.roll(line, k, axis=0) for k in range(-3, 4)], axis=0)


def _area_of(line: Any) -> float:
    return 0.5 * float(numpy.linalg.norm(numpy.cross(line, numpy.roll(line, -1, axis=0)).sum(axis=0)))
