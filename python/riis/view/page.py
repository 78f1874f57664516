# SPDX-License-Identifier: Apache-2.0
"""The page of riis view: a server on 127.0.0.1 with the picture of a Model, its sliders, lights and files.

The page is page.html, a template of Vue. The template's variables are the state of this server. browser.js hands the gestures on
the picture to the functions that begin with _on_. Everything runs on one thread, except that a separate thread reads a mesh.
hand.py, details.py, heartbeat.py and saving.py contain the parts of the page that change the valves, play them and write files.
"""

from __future__ import annotations

import asyncio
import base64
import functools
import os
import sys
import time
import traceback
from collections.abc import Callable, Coroutine, Iterator
from contextlib import ExitStack, contextmanager
from pathlib import Path
from typing import Any, NamedTuple

import numpy

import riis
from riis._place import UNITS
from riis._plot import COLOURS
from riis.view import guard, reading, rows, saving
from riis.view._landmark_files import AXES
from riis.view._landmarks import WARPS
from riis.view._lights import counted
from riis.view._sessions import read_session
from riis.view.details import N_DETAILS, Details
from riis.view.hand import Hand
from riis.view.heartbeat import Heartbeat
from riis.view.model import CYCLES, KINDS, Model
from riis.view.patient import Patient
from riis.view.scene import CELLS, GAP, LOOKS, WALLS, Scene, boundary_of, check_of_graphics, colour_of, places_of

N_SLIDERS = 12  # of the whole valve
N_ALL = N_SLIDERS + sum(N_DETAILS)
MANY_NODES = 1_000_000  # larger meshes are marked near the valves
REST = 0.25  # seconds without a move after which the lights and the cut are renewed


_SPEEDS = [{"title": name, "value": value} for name, value in (("1/10", 0.1), ("1/4", 0.25), ("1/2", 0.5), ("as in life", 1.0))]


class Sources(NamedTuple):
    """The files with which a page begins."""

    path: str | None = None  #: the mesh
    saved: str | None = None  #: a saved view
    cells_where: str | None = None
    wall: str | None = None
    placed: str | None = None  #: a placed valve
    landmarks: str | None = None


class Page(Hand, Details, Heartbeat, Patient, saving.Files):
    """A server with one model, which all its browsers share.

    path    the mesh to read, or None
    saved   a saved view to open, or None
    unit    of the meshes: "mm", "cm" or "m". None: not known
    folder  the folder to which the page writes, and from which relative paths start
    cells_where  NAME=VALUES: the cells of the mesh to take; by default all cells, or the saved view's
    wall    the wall to read, or None. With a wall there may be no mesh
    placed  the file of a placed valve to open, or None
    landmarks  a file of landmarks to read, or None
    """

    def __init__(
        self,
        path: str | None,
        *,
        saved: str | None = None,
        unit: Any = None,
        folder: str = ".",
        cells_where: str | None = None,
        wall: str | None = None,
        placed: str | None = None,
        landmarks: str | None = None,
    ):
        from trame.app import get_server

        check_of_graphics()
        self.server = get_server("riis", client_type="vue3")
        self.state = self.server.state
        self.folder = Path(folder).resolve()
        self._begin, self._unit = Sources(path, saved, cells_where, wall, placed, landmarks), unit
        self.model: Any = None
        self.scene: Any = None
        self._grid: Any = None
        self._moved = asyncio.Event()
        self._unsettled, self._stale = False, True
        self._seen = asyncio.Event()
        self._seen_at, self._number = time.monotonic(), 0
        self._alone_since: float | None = None  # the time at which the last browser left
        self._drag: tuple[Any, float] | None = None
        self._drag_stack = ExitStack()
        self._held = False
        self._clicks: list[Any] = []
        self._written: set[Path] = set()
        self._text_name = "case"
        self._slider_values: list[float] = []
        self._orifice_at = 0.0
        self._playing: asyncio.Task[None] | None = None
        self._tasks: set[asyncio.Task[None]] = set()  # asyncio itself does not keep these tasks
        self._busy = ""  # the name of the present long task, as a sentence
        self._wanted_size: tuple[int, int] | None = None  # a browser requested it during a movie
        self._shown: Any = None
        self._shows_gap = False
        self._build()

    # the page's variables and functions

    def _build(self) -> None:
        from trame.modules import vuetify3

        here = Path(__file__).parent
        self.server.enable_module(vuetify3)
        self.server.enable_module(
            {"serve": {"riis_view": str(here)}, "scripts": ["riis_view/browser.js"], "styles": ["riis_view/page.css"]}
        )
        template = (here / "page.html").read_text(encoding="utf-8")
        slots = iter(range(N_ALL))
        for name, n in (("SLIDERS", N_SLIDERS), ("SIZE_SLIDERS", N_DETAILS[0]), ("BUMP_SLIDERS", N_DETAILS[1])):
            template = template.replace("{{" + name + "}}", "".join(rows.SLIDER.format(k=next(slots)) for _ in range(n)))
        first = {
            "trame__title": "riis view", "trame__template_main": template,
            "trame__vuetify3_config": {"theme": {"themes": {"light": {"colors": {"primary": COLOURS[0]}}}}},
            "path": "", "mesh_text": "no mesh", "marked_text": "", "loaded": False, "progress": None, "progress_text": "",
            "message": "", "message_type": "error", "refusals": 0, "folder": str(self.folder),
            "kinds": list(KINDS), "kind": KINDS[0], "is_surface": False, "valve_names": [], "current": 0,
            "sliders": [], "rows": [], "panels": [], "sizes": [], "size": "", "bumps": [], "bump": -1, "most_bumps": 0,
            "bump_places": [], "bump_place": "", "placement": [], "tool": "look", "n_clicks": 0,
            "lights": [], "fresh": False, "at_rest": False, "digest": "", "n_marked": 0, "milliseconds": 0.0,
            "can_undo": False, "can_redo": False, "wall": "cut", "cells": "partly", "legend": [],
            "looks": {name: name.capitalize() for name in LOOKS},
            "playing": False, "time": 0.0, "begin": 0.0, "end": 1.0, "curve_begin": 0.0, "period": 1.0,
            "speed": 0.25, "speeds": _SPEEDS, "cycle": "", "cycles": list(CYCLES), "curves": [],
            "texts": saving.TEXTS, "text": "", "text_title": "", "text_shown": False,
            "writes": saving.WRITES, "file_name": "valve", "replace": False,
            "landmarks": [], "landmark": "", "warp": "smoothed", "warps": list(WARPS), "found": {}, "unit": None, "axes": None,
            "units": list(UNITS), "all_axes": list(AXES), "has_wall": False, "skirt_on": False, "skirt": "", "resistance": "",
            "resistance_unit": "", "sizes_to_fit": [], "fit_sizes": [], "fit_kind": "", "fit_whole": True, "fit_path": "",
            "picture_width": 1920, "picture_height": 1080,
            "open_rows": [
                {"name": "mesh", "label": "Mesh", "value": ""},
                {"name": "wall", "label": "Wall, such as root.stl", "value": ""},
                {"name": "placed", "label": "A placed valve, .json of riis place", "value": ""},
                {"name": "landmarks", "label": "Landmarks, .mrk.json, .json, .csv or .fcsv", "value": ""},
                {"name": "cells", "label": "Only its cells with NAME=VALUES, or all", "value": ""},
                {"name": "surface", "label": "A patient's surface", "value": ""},
                {"name": "view", "label": "A saved view", "value": ""},
            ],
            "picture": "", "picture_number": 0,
        }  # fmt: skip
        first.update({f"slider_{k}": 0.0 for k in range(N_ALL)})
        self.state.update(first)
        for name in [name for name in dir(self) if name.startswith("_on_")]:
            self.server.trigger("riis_" + name[4:])(self._told(getattr(self, name)))
        for k in range(N_ALL):
            self.state.change(f"slider_{k}")(self._told(functools.partial(self._slid, k)))
        for name in ("kind", "current", "wall", "cells", "tool", "time", "size", "bump", "bump_place", "panels", "unit", "axes"):
            self.state.change(name)(self._told(getattr(self, f"_changed_{name}")))
        self.server.controller.on_server_ready.add(self._ready)

    def _told(self, function: Callable[..., Any]) -> Callable[..., Any]:
        """Returns the function, with its errors shown in the page."""

        @functools.wraps(function)
        def told(*values: Any, **_: Any) -> Any:
            try:
                return function(*values)
            except saving.REFUSALS as error:
                self._say(saving.text_of(error))
                with self.state as state:
                    state.refusals += 1  # the fields are made again, with the model's values
                self._show_numbers()
            except Exception as error:
                self._tell_fault(error)
            return None

        if not hasattr(told, "__name__"):
            told.__name__ = "told"
        return told

    def _tell_fault(self, error: Exception) -> None:
        """Reports a fault of the page itself. The server continues to run."""
        traceback.print_exc()
        self._say(f"{type(error).__name__}: {error} (this is a fault of riis view; its terminal has the details)")

    def _begin_task(self, work: Coroutine[Any, Any, None]) -> None:
        """Begins a task, with its errors shown in the page."""

        async def told() -> None:
            try:
                await work
            except saving.REFUSALS as error:
                self._say(saving.text_of(error))
            except Exception as error:
                self._tell_fault(error)

        task = asyncio.ensure_future(told())
        self._tasks.add(task)
        task.add_done_callback(self._tasks.discard)

    def _need_idle(self) -> None:
        if self._busy:
            raise reading.Refusal(f"{self._busy}; wait until this is done")

    @contextmanager
    def _alone(self, what: str) -> Iterator[None]:
        """During this context, no other mesh is read and no movie is written."""
        self._need_idle()
        self._busy = what
        try:
            yield
        finally:
            self._busy = ""

    def _say(self, text: str, kind: str = "error") -> None:
        with self.state:
            self.state.message, self.state.message_type = text, kind
        if kind == "error":
            print(f"riis view: {text}", file=sys.stderr)

    def _ready(self, **_: Any) -> None:
        self._begin_task(self._pictures())
        begin = self._begin
        if begin.saved is not None:
            self._begin_task(self._reopen(begin.saved, begin.path, begin.cells_where))
        elif begin.path is not None or begin.wall is not None:
            self._begin_task(self._read(**begin._asdict()))
        elif begin.placed is not None or begin.landmarks is not None:
            self._say("open a mesh or a wall first, by MESH or --wall")

    # the mesh

    def _on_open(self, name: str, value: str) -> None:
        value = str(value).strip()
        if not value:
            return
        path = str(self.folder / os.path.expanduser(value))
        if name == "cells":
            self._need_model()
            if self._grid is None:
                raise reading.Refusal("open a mesh first: a wall has no cells to choose")
            self._begin_task(self._read(self.state.path, cells_where=None if value == "all" else value))
        elif name == "mesh":
            self._begin_task(self._read(path))
        elif name == "view":
            self._begin_task(self._reopen(path))
        elif name == "wall" and self.model is None:
            self._begin_task(self._read(wall=path))
        elif name == "wall":
            self._begin_change()
            self.model.set_wall(reading.read_wall(path))
            self._renew_all()
        elif name == "placed":
            self._begin_change()
            with self.model.one_step():
                self.model.add_placed(path)
                self.model.remove(self.state.current)
            self.state.current = len(self.model.valves) - 1
            self._refresh()
            self._look("oblique")
            self._renew_all()
        elif name == "landmarks":
            self._read_landmarks(path)
        elif name == "surface":
            self._begin_change()
            self.model.add_surface(**reading.read_surface(path), path=path)
            self.state.current = len(self.model.valves) - 1
            self._renew_all()

    async def _read(self, path: str | None = None, **others: str | None) -> None:
        """On a thread, reads a mesh or a wall and the other Sources, and shows the progress. If one of the files is refused,
        nothing changes."""
        sources = Sources(path, **others)
        parts = {"part": -1.0}
        name = os.path.basename(sources.path or sources.wall or sources.saved or "")
        with self._alone(f"{name} is being read"):
            work = asyncio.get_running_loop().run_in_executor(None, self._make_model, sources, parts, self.model)
            try:
                while not work.done():
                    with self.state as state:
                        state.progress = round(100 * parts["part"]) if parts["part"] >= 0 else -1
                        state.progress_text = f"{'Reading' if parts['part'] >= 0 else 'Preparing'} {name}"
                    await asyncio.wait([work], timeout=0.2)
                grid, wall, model, shown = work.result()
            finally:
                with self.state:
                    self.state.progress = None
            self._take(grid, wall, model, sources.path or "")
            self._show_as_saved(shown)

    def _make_model(
        self, sources: Sources, parts: dict[str, float], before: Any
    ) -> tuple[Any, Any, Any, dict[str, Any]]:
        path, grid, boundary = sources.path, None, None
        try:
            wall = None if sources.wall is None else reading.read_wall(sources.wall)
            if path is None and sources.saved is not None:
                model = Model.load(sources.saved)
            elif path is None:
                model = Model(None, unit=self._unit, wall=wall)
            else:
                grid = reading.read_mesh(path, parts, cells_where=sources.cells_where)
                parts["part"] = -1.0
                make = Model.near if grid.n_points > MANY_NODES else Model
                model = make(
                    **reading.arrays_of(grid), unit=self._unit, path=path, cells_where=sources.cells_where, wall=wall
                )
                boundary = boundary_of(grid)
        except riis.Error as error:
            raise reading.Refusal(f"{path or sources.wall or sources.saved}: {error}") from error
        shown = {} if sources.saved is None else model.restore(sources.saved)
        _check_of_saved(shown, len(model.valves))
        if sources.saved is None and before is not None and before.wall is not None and wall is None:
            model.take_over(before)  # a mesh of the patient whose valve is placed
        kind = model.read_landmarks(sources.landmarks) if sources.landmarks is not None else ""
        if sources.placed is not None:
            model.add_placed(sources.placed)
        elif kind and not model.valves:
            model.add(kind)
        return grid, boundary, model, shown

    def _take(self, grid: Any, wall: Any, model: Any, path: str) -> None:
        if not model.valves:
            model.add(self.state.kind)
            if model.wall is not None:
                model.stand_in_wall(0)
        model.forget_steps()  # the page always has a valve, so undo must not remove the first one
        scene = Scene(model, grid, wall=wall, size=self.scene.size if self.scene is not None else (900, 700))
        self._pause()
        self._end_drag()
        if self.scene is not None:
            self.scene.close()
        self.model, self.scene, self._grid, self._shown, self._clicks = model, scene, grid, None, []
        if model.wall is not None:
            is_placed = model.valves[0].placed is not None
            self.state.wall = "clear" if is_placed else "cut"  # landmarks are picked on the inside
            if not is_placed or model.landmarks.points:
                self.state.panels = [*(name for name in self.state.panels if name != "patient"), "patient"]
        self.scene.show_wall(self.state.wall)
        self.scene.show_cells(self.state.cells)
        with self.state:
            self.state.path, self.state.loaded = path, True
            self.state.current, self.state.message = 0, ""
            self.state.tool, self.state.n_clicks = "look", 0
            self.state.time, self.state.cycle, self.state.curves = float(model.time), "", []
        self._refresh()
        if model.wall is not None and model.valves[0].placed is None and not model.valves[0].parameters:
            self._look_at_all()
        else:
            self._look("oblique")
        self._renew_all()

    async def _reopen(self, path: str, mesh: str | None = None, cells_where: str | None = None) -> None:
        """Opens a saved view, with its own mesh and cells or with the given ones."""
        if mesh is None:
            mesh, saved_cells = reading.mesh_of_saved(path)
            cells_where = cells_where or saved_cells
        wanted = None if mesh is None else (os.path.abspath(mesh), cells_where)
        now = None if self.model is None or self._grid is None else (os.path.abspath(self.state.path), self.model.cells_where)
        if self.model is None or wanted != now:
            await self._read(mesh, saved=path, cells_where=cells_where)
        else:
            self._begin_change()
            root, valves = read_session(path)
            _check_of_saved(root["page"], len(valves))
            shown = self.model.restore(path)
            self._pause()
            with self.state as state:
                state.current, state.time, state.curves = 0, float(self.model.time), []
            self._refresh()
            self._look("oblique")
            self._renew_all()
            self._show_as_saved(shown)
        self._say(f"opened {path}", "success")

    def _as_saved(self) -> dict[str, Any]:
        """Returns everything that the page shows except the valves, for a saved view."""
        state = self.state
        return {
            "current": state.current, "wall": state.wall, "cells": state.cells, "speed": state.speed, "view": self.scene.view(),
        }  # fmt: skip

    def _show_as_saved(self, shown: dict[str, Any]) -> None:
        """Shows the content of a saved view. Views that the library or an older release has saved lack these entries."""
        if not shown:
            return
        with self.state as state:
            for name in ("current", "wall", "cells", "speed"):
                state[name] = shown.get(name, state[name])
        self.scene.show_wall(self.state.wall)
        self.scene.show_cells(self.state.cells)
        if "view" in shown:
            self.scene.set_view(shown["view"])
        self._show_numbers()
        self._show_curves()
        self._touch()

    def _need_model(self) -> None:
        """Refuses if there is no mesh, or if a movie is being written, whose frames a change would spoil."""
        if self.model is None:
            raise reading.Refusal("open a mesh first")
        if self._busy == saving.FILMING:
            self._need_idle()

    # the part of the model that the page shows

    def _valve(self) -> Any:
        return self.model.valves[self.state.current]

    def _show_numbers(self) -> None:
        """Sets the sliders, tables and names to the model's values."""
        if self.model is None:
            return
        model = self.model
        with self.state as state:
            state.current = max(0, min(state.current, len(model.valves) - 1))
            valve = self._valve()
            state.valve_names = [valve.name for valve in model.valves]
            unit = model.unit or ""
            state.mesh_text = self._text_of_mesh()
            state.is_surface = valve.surface is not None
            state.sliders, state.rows = [], []
            sliders: list[dict[str, Any] | None] = [rows.half_thickness_of(valve, unit), rows.offset_of(valve)]
            table = []
            if valve.surface is None:
                state.kind = valve.kind
                values = model.values(state.current)
                sliders.insert(0, rows.OPENING | {"value": valve.opening})
                for parameter in model.parameters(valve.kind):
                    value, is_set = values[parameter.name], parameter.name in valve.parameters
                    if parameter.part and parameter.n_values == 1:
                        continue  # among the details
                    if parameter.first and parameter.n_values == 1 and len(sliders) < N_SLIDERS:
                        sliders.append(rows.slider_of(parameter, float(value), is_set, valve.scale, unit))
                    else:
                        table.append(rows.row_of(parameter, value, is_set, valve.scale, unit))
            sliders = [*sliders, *[None] * (N_SLIDERS - len(sliders)), *self._details()]
            # The values are not in state.sliders, because trame does not send a list that was changed in place.
            self._slider_values = [float(slider.pop("value")) if slider is not None else 0.0 for slider in sliders]
            for k, value in enumerate(self._slider_values):
                state[f"slider_{k}"] = value
            state.sliders, state.rows = sliders, table
            state.placement = rows.placement_of(valve, unit)
            state.can_undo, state.can_redo = bool(model.can_undo), bool(model.can_redo)
            state.legend = self._legend()
            self._show_patient()

    def _text_of_mesh(self) -> str:
        model, parts = self.model, []
        if self._grid is not None:
            n_nodes, n_cells = counted(self._grid.n_points, "node"), counted(self._grid.n_cells, "cell")
            parts.append(f"{os.path.basename(self.state.path)}: {n_nodes}, {n_cells}")
            if model.cells_where:
                parts[0] += f" with {model.cells_where}"
        if model.wall is not None:
            parts.append(f"wall {os.path.basename(model.wall.path or '')}: {counted(len(model.wall.triangles), 'triangle')}")
        return ", ".join([*parts, f"in {model.unit}" if model.unit else "unit not known"])

    def _legend(self) -> list[dict[str, str]]:
        legend = []
        for k, valve in enumerate(self.model.valves):
            leaflets = numpy.unique(self.model.surface(k).triangles.leaflet_id).tolist()
            shown = leaflets[:1] if valve.surface is not None else leaflets
            legend += [{"label": rows.leaflet_name(valve.kind, leaflet), "colour": colour_of(k, leaflet)} for leaflet in shown]
        if self._grid is not None:
            legend += [{"label": "marked cells", "colour": "#56b4e9"}, {"label": "partly marked", "colour": "#f0e442"}]
        return legend + ([{"label": "gap to the wall", "colour": GAP}] if self._shows_gap else [])

    def _renew_all(self) -> None:
        """Shows the model after a larger change than a move of a slider."""
        self._show_numbers()
        self._show_placement()
        self._show_curves()
        self._touch()

    def _show_placement(self) -> None:
        valve = self._valve()
        self.scene.show_handle(valve.origin, valve.flow, 1.2 * self._reach())
        self.scene.cut_here(valve.origin, valve.axis)

    def _reach(self) -> float:
        """Returns the distance from the current valve's origin to its farthest point."""
        if self._shown is None or not len(self._shown.surfaces):
            return 1.0
        points = self._shown.surfaces[min(self.state.current, len(self._shown.surfaces) - 1)].points
        if len(points) == 0:
            return 1.0
        return float(numpy.linalg.norm(points - numpy.asarray(self._valve().origin), axis=1).max())

    def _touch(self) -> None:
        """Marks the picture as stale, so that a new one is drawn."""
        self._stale = True
        with self.state as state:
            state.fresh = False
        self._moved.set()

    def _refresh(self) -> None:
        self._shown = self.model.update()
        self.scene.show(self._shown, quick=True)
        self._stale = False
        if self._playing is None:
            self.scene.show_orifice([])
        elif time.monotonic() - self._orifice_at > 0.25:
            self._show_orifice()
        self.scene.show_lights([])
        self.scene.show_gap([], [])
        self._show_bump()
        self._show_landmarks()
        valve = self._valve()
        with self.state as state:
            if state.sliders and state.sliders[0]["name"] == "opening" and self._slider_values[0] != valve.opening:
                self._slider_values[0] = state.slider_0 = valve.opening
            if self._playing is not None:
                state.time = float(self.model.time)
            state.n_marked, state.milliseconds = len(self._shown.marked), self._shown.milliseconds
            state.marked_text = "" if self._grid is None else (
                f"{counted(len(self._shown.marked), 'node')} marked in {self._shown.milliseconds:.1f} ms"
            )
            state.can_undo, state.can_redo = bool(self.model.can_undo), bool(self.model.can_redo)

    def _show_orifice(self) -> None:
        i = self.state.current
        self.scene.show_orifice(self.model.orifice(i), self.model.valves[i].axis, 0.02 * self._reach() ** 2)
        self._orifice_at = time.monotonic()

    def _settle(self) -> None:
        """Renews the parts that take longer than a move: the lights, the cut through the mesh, the handle, and a sharper
        picture."""
        self._unsettled = False
        if not self._held:
            self._end_drag()
        lights = self.model.lights()
        self.scene.show_lights(lights)
        points, triangles = self.model.gap_ribbon(self.state.current)
        self.scene.show_gap(points, triangles)
        self._shows_gap = len(triangles) > 0
        self.scene.rest()
        valve = self._valve()
        self.scene.show_handle(valve.origin, valve.flow, 1.2 * self._reach())
        self._show_orifice()
        with self.state as state:
            state.lights = [rows.light_of(light) for light in lights]
            state.digest = rows.digest_of(self._shown)
        self._show_numbers()
        self._push(self.scene.picture)
        with self.state as state:
            state.fresh = state.at_rest = True

    async def _pictures(self) -> None:
        """Draws and sends pictures one at a time, each after a browser has shown the previous one."""
        while True:
            try:
                await asyncio.wait_for(self._moved.wait(), REST if self._unsettled else None)
            except asyncio.TimeoutError:
                if self.scene is not None and self._busy != saving.FILMING:
                    self._told(self._settle)()
                continue
            if self._busy == saving.FILMING:  # a picture between two frames would change the size of the next frame
                await asyncio.sleep(0.1)
                continue
            self._moved.clear()
            if self.scene is None:
                continue
            self.state.at_rest = False
            if self._stale:
                self._told(self._refresh)()
            self._told(self._push)(self.scene.quick_picture)
            self._unsettled = True
            try:
                await asyncio.wait_for(self._seen.wait(), 1.0)
            except asyncio.TimeoutError:
                pass

    def _push(self, draw: Callable[[], bytes]) -> None:
        picture = "data:image/jpeg;base64," + base64.b64encode(draw()).decode()
        if picture == self.state.picture:  # no browser would acknowledge it
            self._seen_at = time.monotonic()
            self._seen.set()
            return
        self._number += 1
        self._seen_at = time.monotonic()
        self._seen.clear()
        with self.state as state:
            state.picture, state.picture_number = picture, self._number

    def _on_seen(self, number: float) -> None:
        self._seen_at = time.monotonic()
        if int(number) >= self._number:
            self._seen.set()

    def _on_size(self, width: float, height: float) -> None:
        if self._busy == saving.FILMING:
            self._wanted_size = int(width), int(height)
        elif self.scene is not None and width > 0 and height > 0:
            self.scene.resize(int(width), int(height))
            self._moved.set()

    # the server

    def _on_sockets(self, n_open: int) -> None:
        self._alone_since = None if n_open else time.monotonic()

    def serve(self, *, port: int = 0, browser: bool = True) -> None:
        """Serves the page on 127.0.0.1 until Ctrl C. A port of 0 means a free port."""
        with guard.Guard(self.server, self._on_sockets) as gate:
            gate.start(port, browser)


def _check_of_saved(shown: dict[str, Any], n_valves: int) -> None:
    """Refuses a saved view whose entries for the page are not valid."""
    choices = {"current": range(n_valves), "wall": WALLS, "cells": CELLS, "speed": [speed["value"] for speed in _SPEEDS]}
    for name, value in shown.items():
        fits = isinstance(value, dict) if name == "view" else isinstance(value, (int, float, str)) and not isinstance(value, bool)
        if not fits or (name in choices and value not in choices[name]):
            raise reading.Refusal(f"the saved view is damaged: {name} is {value!r}")
    if "view" in shown:
        try:
            places_of(shown["view"])
        except riis.Error as error:
            raise reading.Refusal(f"the saved view is damaged: {error}") from None
