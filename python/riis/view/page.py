# SPDX-License-Identifier: Apache-2.0
"""The page of riis view: a server on 127.0.0.1 with the picture of a Model, its sliders, lights and files.

The page is page.html, a template of Vue. Its variables are the state of this server. browser.js hands the gestures on the
picture to the functions that begin with _on_. Everything runs on one thread, but reading a mesh has one of its own.
"""

from __future__ import annotations

import asyncio
import base64
import functools
import math
import os
import sys
import time
import traceback
from collections.abc import Callable, Coroutine, Iterator
from contextlib import ExitStack, contextmanager
from pathlib import Path
from typing import Any

import numpy

import riis
from riis._plot import COLOURS
from riis.view import guard, reading, rows, saving
from riis.view.model import CYCLES, KINDS, Model
from riis.view.scene import LOOKS, Scene, boundary_of, check_of_graphics, colour_of

N_SLIDERS = 12
MANY_NODES = 1_000_000  # larger meshes are marked near the valves
REST = 0.25  # seconds without a move after which the lights and the cut are renewed
UNSEEN = 4.0  # seconds after which a picture that no browser shows pauses a heartbeat


_SPEEDS = [{"title": name, "value": value} for name, value in (("1/10", 0.1), ("1/4", 0.25), ("1/2", 0.5), ("as in life", 1.0))]


class Page(saving.Files):
    """A server with one model, which all its browsers share.

    path    the mesh to read, or None
    saved   a saved view to open, or None
    unit    of the meshes: "mm", "cm" or "m". None: not known
    folder  the folder to which the page writes, and from which relative paths count
    """

    def __init__(self, path: str | None, *, saved: str | None = None, unit: Any = None, folder: str = "."):
        from trame.app import get_server

        check_of_graphics()
        self.server = get_server("riis", client_type="vue3")
        self.state = self.server.state
        self.folder = Path(folder).resolve()
        self._begin_path, self._begin_saved, self._unit = path, saved, unit
        self.model: Any = None
        self.scene: Any = None
        self._grid: Any = None
        self._moved = asyncio.Event()
        self._unsettled, self._stale = False, True
        self._seen = asyncio.Event()
        self._seen_at, self._number = time.monotonic(), 0
        self._drag: tuple[Any, float] | None = None
        self._drag_stack = ExitStack()
        self._held = False
        self._clicks: list[Any] = []
        self._written: set[Path] = set()
        self._text_name = "case"
        self._orifice_at = 0.0
        self._playing: asyncio.Task[None] | None = None
        self._tasks: set[asyncio.Task[None]] = set()  # asyncio itself does not keep them
        self._busy = ""  # what takes a while now, as a sentence
        self._wanted_size: tuple[int, int] | None = None  # that a browser asked for during a movie
        self._shown: Any = None
        self._slider_values: list[float] = []  # as the model has them
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
        sliders = "".join(rows.SLIDER.format(k=k) for k in range(N_SLIDERS))
        first = {
            "trame__title": "riis view", "trame__template_main": template.replace("{{SLIDERS}}", sliders),
            "trame__vuetify3_config": {"theme": {"themes": {"light": {"colors": {"primary": COLOURS[0]}}}}},
            "path": "", "mesh_text": "no mesh", "marked_text": "", "loaded": False, "progress": None, "progress_text": "",
            "message": "", "message_type": "error", "refusals": 0, "folder": str(self.folder),
            "kinds": list(KINDS), "kind": KINDS[0], "is_surface": False, "valve_names": [], "current": 0,
            "sliders": [], "rows": [], "panels": [], "placement": [], "tool": "look", "n_clicks": 0,
            "lights": [], "fresh": False, "at_rest": False, "digest": "", "n_marked": 0, "milliseconds": 0.0,
            "can_undo": False, "can_redo": False, "wall": "cut", "cells": "partly", "legend": [],
            "looks": {name: name.capitalize() for name in LOOKS},
            "playing": False, "time": 0.0, "period": 1.0, "speed": 0.25, "speeds": _SPEEDS,
            "cycle": "", "cycles": list(CYCLES), "curves": [],
            "texts": saving.TEXTS, "text": "", "text_title": "", "text_shown": False,
            "writes": saving.WRITES, "file_name": "valve", "replace": False,
            "open_rows": [
                {"name": "mesh", "label": "Mesh", "value": ""},
                {"name": "surface", "label": "A patient's surface", "value": ""},
                {"name": "view", "label": "A saved view", "value": ""},
            ],
            "picture": "", "picture_number": 0,
        }  # fmt: skip
        first.update({f"slider_{k}": 0.0 for k in range(N_SLIDERS)})
        self.state.update(first)
        for name in [name for name in dir(self) if name.startswith("_on_")]:
            self.server.trigger("riis_" + name[4:])(self._told(getattr(self, name)))
        for k in range(N_SLIDERS):
            self.state.change(f"slider_{k}")(self._told(functools.partial(self._slid, k)))
        for name in ("kind", "current", "wall", "cells", "tool", "time"):
            self.state.change(name)(self._told(getattr(self, f"_changed_{name}")))
        self.server.controller.on_server_ready.add(self._ready)

    def _told(self, function: Callable[..., Any]) -> Callable[..., Any]:
        """Returns the function with its errors told in the page."""

        @functools.wraps(function)
        def told(*values: Any, **_: Any) -> Any:
            try:
                return function(*values)
            except saving.REFUSALS as error:
                self._say(saving.text_of(error))
                with self.state as state:
                    state.refusals += 1  # makes the fields anew, with the values that hold
                self._show_numbers()
            except Exception as error:
                self._tell_fault(error)
            return None

        if not hasattr(told, "__name__"):
            told.__name__ = "told"
        return told

    def _tell_fault(self, error: Exception) -> None:
        """Tells a fault of the page itself. The server lives on."""
        traceback.print_exc()
        self._say(f"{type(error).__name__}: {error} (this is a fault of riis view; its terminal has the details)")

    def _begin_task(self, work: Coroutine[Any, Any, None]) -> None:
        """Begins a task, with its errors told in the page."""

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
        """While this lasts, no mesh is read and no movie is written besides."""
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
        if self._begin_saved is not None:
            self._begin_task(self._reopen(self._begin_saved, self._begin_path))
        elif self._begin_path is not None:
            self._begin_task(self._read(self._begin_path))

    # the mesh

    def _on_open(self, name: str, value: str) -> None:
        value = str(value).strip()
        if not value:
            return
        path = str(self.folder / os.path.expanduser(value))
        if name == "mesh":
            self._begin_task(self._read(path))
        elif name == "view":
            self._begin_task(self._reopen(path))
        elif name == "surface":
            self._begin_change()
            self.model.add_surface(**reading.read_surface(path), path=path)
            self.state.current = len(self.model.valves) - 1
            self._renew_all()

    async def _read(self, path: str, saved: str | None = None) -> None:
        """Reads a mesh, and a saved view of it, on a thread, and shows the progress. If one is refused, nothing changes."""
        parts = {"part": -1.0}
        with self._alone(f"{os.path.basename(path)} is being read"):
            work = asyncio.get_running_loop().run_in_executor(None, self._make_model, path, saved, parts)
            try:
                while not work.done():
                    with self.state as state:
                        state.progress = round(100 * parts["part"]) if parts["part"] >= 0 else -1
                        state.progress_text = f"{'Reading' if parts['part'] >= 0 else 'Preparing'} {os.path.basename(path)}"
                    await asyncio.wait([work], timeout=0.2)
                grid, wall, model = work.result()
            finally:
                with self.state:
                    self.state.progress = None
            self._take(grid, wall, model, path)

    def _make_model(self, path: str, saved: str | None, parts: dict[str, float]) -> tuple[Any, Any, Any]:
        grid = reading.read_mesh(path, parts)
        parts["part"] = -1.0
        make = Model.near if grid.n_points > MANY_NODES else Model
        try:
            model = make(**reading.arrays_of(grid), unit=self._unit, path=path)
        except riis.Error as error:
            raise reading.Refusal(f"{path}: {error}") from error
        if saved is not None:
            model.restore(saved)
        return grid, boundary_of(grid), model

    def _take(self, grid: Any, wall: Any, model: Any, path: str) -> None:
        if not model.valves:
            model.add(self.state.kind)
        model.forget_steps()  # the page always has a valve, so undo must not take the first one away
        scene = Scene(model, grid, wall=wall, size=self.scene.size if self.scene is not None else (900, 700))
        self._pause()
        self._end_drag()
        if self.scene is not None:
            self.scene.close()
        self.model, self.scene, self._grid, self._shown, self._clicks = model, scene, grid, None, []
        self.scene.show_wall(self.state.wall)
        self.scene.show_cells(self.state.cells)
        with self.state:
            self.state.path, self.state.loaded = path, True
            self.state.current, self.state.message = 0, ""
            self.state.tool, self.state.n_clicks = "look", 0
            self.state.time, self.state.cycle, self.state.curves = float(model.time), "", []
        self._refresh()
        self._look("oblique")
        self._renew_all()

    async def _reopen(self, path: str, mesh: str | None = None) -> None:
        """Opens a saved view, with its mesh, or with this mesh instead."""
        mesh = mesh if mesh is not None else reading.mesh_of_saved(path)
        if mesh is not None and (self.model is None or os.path.abspath(mesh) != os.path.abspath(self.state.path)):
            await self._read(mesh, path)
        else:
            self._begin_change()
            self.model.restore(path)
            self._pause()
            with self.state as state:
                state.current, state.time = 0, float(self.model.time)
            self._refresh()
            self._look("oblique")
            self._renew_all()
        self._say(f"opened {path}", "success")

    def _need_model(self) -> None:
        """Refuses if there is no mesh, or if a movie is being written, whose frames a change would spoil."""
        if self.model is None:
            raise reading.Refusal("open a mesh first")
        if self._busy == saving.FILMING:
            self._need_idle()

    # what the page shows of the model

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
            state.mesh_text = (
                f"{os.path.basename(state.path)}: {self._grid.n_points:,} nodes, {self._grid.n_cells:,} cells, "
                + (f"in {model.unit}" if model.unit else "unit not known")
            )
            state.is_surface = valve.surface is not None
            state.sliders, state.rows = [], []
            sliders, table = [rows.half_thickness_of(valve, unit)], []
            if valve.surface is None:
                state.kind = valve.kind
                values = model.values(state.current)
                sliders.insert(0, rows.OPENING | {"value": valve.opening})
                for parameter in model.parameters(valve.kind):
                    value = values[parameter.name]
                    if parameter.first and parameter.n_values == 1 and len(sliders) < N_SLIDERS:
                        sliders.append(rows.slider_of(parameter, float(value)))
                    else:
                        table.append(rows.row_of(parameter, value, parameter.name in valve.parameters))
            # The server changes no list that it has pushed: the page would not hear of it.
            self._slider_values = [slider.pop("value") for slider in sliders]
            for k, value in enumerate(self._slider_values):
                state[f"slider_{k}"] = value
            state.sliders, state.rows = sliders, table
            state.placement = rows.placement_of(valve)
            state.can_undo, state.can_redo = bool(model.can_undo), bool(model.can_redo)
            state.legend = self._legend()

    def _legend(self) -> list[dict[str, str]]:
        legend = []
        for k, valve in enumerate(self.model.valves):
            names = rows.LEAFLETS.get(valve.kind, ["surface"])
            if valve.parameters.get("skirt_length", 0.0) != 0.0:
                names = [*names, "skirt"]
            legend += [{"label": name, "colour": colour_of(k, j)} for j, name in enumerate(names)]
        return legend + [{"label": "marked cells", "colour": "#56b4e9"}, {"label": "partly marked", "colour": "#f0e442"}]

    def _renew_all(self) -> None:
        """Shows the model after more than a move of a slider."""
        self._show_numbers()
        self._show_placement()
        self._show_curves()
        self._touch()

    def _show_placement(self) -> None:
        valve = self._valve()
        self.scene.show_handle(valve.origin, valve.axis, 1.2 * self._reach())
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
        """Makes the picture stale, so that a new one is drawn."""
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
        valve = self._valve()
        with self.state as state:
            if state.sliders and state.sliders[0]["name"] == "opening" and self._slider_values[0] != valve.opening:
                self._slider_values[0] = state.slider_0 = valve.opening
            if self._playing is not None:
                state.time = float(self.model.time)
            state.n_marked, state.milliseconds = len(self._shown.marked), self._shown.milliseconds
            state.marked_text = (
                f"{len(self._shown.marked):,} nodes marked in {self._shown.milliseconds:.1f} ms"
            )
            state.can_undo, state.can_redo = bool(self.model.can_undo), bool(self.model.can_redo)

    def _show_orifice(self) -> None:
        i = self.state.current
        self.scene.show_orifice(self.model.orifice(i), self.model.valves[i].axis, 0.02 * self._reach() ** 2)
        self._orifice_at = time.monotonic()

    def _settle(self) -> None:
        """Renews what takes longer than a move: the lights, the cut through the mesh, the handle, a sharper picture."""
        self._unsettled = False
        if not self._held:
            self._end_drag()
        lights = self.model.lights()
        self.scene.show_lights(lights)
        self.scene.rest()
        valve = self._valve()
        self.scene.show_handle(valve.origin, valve.axis, 1.2 * self._reach())
        self._show_orifice()
        with self.state as state:
            state.lights = [rows.light_of(light) for light in lights]
            state.digest = rows.digest_of(self._shown)
        self._show_numbers()
        self._push(self.scene.picture)
        with self.state as state:
            state.fresh = state.at_rest = True

    async def _pictures(self) -> None:
        """Draws and sends pictures: one at a time, and the next when a browser has shown the last."""
        while True:
            try:
                await asyncio.wait_for(self._moved.wait(), REST if self._unsettled else None)
            except asyncio.TimeoutError:
                if self.scene is not None and self._busy != saving.FILMING:
                    self._told(self._settle)()
                continue
            if self._busy == saving.FILMING:  # a picture between two frames would change the size of the next
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

    # sliders and parameters

    def _slid(self, k: int) -> None:
        if self.model is None or k >= len(self.state.sliders):
            return
        name, value = self.state.sliders[k]["name"], float(self.state[f"slider_{k}"])
        if math.isclose(value, self._slider_values[k], rel_tol=1e-12, abs_tol=1e-12):
            return
        self._slider_values[k] = value
        self._move(lambda: self.model.set(self.state.current, name, value), ("set", self.state.current, name))

    def _move(self, change: Callable[[], Any], what: Any) -> None:
        """Makes a change. Changes of the same thing in one drag, or in quick succession, are one step of undo."""
        self._need_model()
        now = time.monotonic()
        if self._drag is None or self._drag[0] != what or (not self._held and now - self._drag[1] > 0.7):
            self._end_drag()
            self._drag_stack.enter_context(self.model.dragging())
        self._drag = (what, now)
        change()
        self._touch()

    def _on_hold(self, held: bool) -> None:
        self._held = bool(held)

    def _end_drag(self) -> None:
        self._drag = None
        self._drag_stack.close()

    def _begin_change(self) -> None:
        self._need_model()
        self._end_drag()

    def _on_set(self, name: str, value: Any) -> None:
        self._begin_change()
        if value is None:
            self.model.unset(self.state.current, name)
        else:
            numbers = [reading.number_of(part, name) for part in str(value).replace(",", " ").split()]
            if not numbers:
                raise reading.Refusal(f"{name}: is empty; it must be a number")
            self.model.set(self.state.current, name, numbers if len(numbers) > 1 else numbers[0])
        self._renew_all()

    def _changed_kind(self) -> None:
        if self.model is None or self.state.is_surface or self.state.kind == self._valve().kind:
            return
        self._begin_change()
        self.model.change_kind(self.state.current, self.state.kind)
        self._renew_all()

    def _changed_current(self) -> None:
        if self.model is not None:
            self._end_drag()
            self._renew_all()

    def _on_add(self, kind: str) -> None:
        self._begin_change()
        self.model.add(kind)
        self.state.current = len(self.model.valves) - 1
        self._renew_all()

    def _on_remove(self) -> None:
        self._need_model()
        if len(self.model.valves) < 2:
            raise reading.Refusal("the last valve stays; choose another kind of valve instead")
        self._end_drag()
        self.model.remove(self.state.current)
        self._renew_all()

    def _on_undo(self) -> None:
        self._begin_change()
        if self.model.can_undo:
            self.model.undo()
            self._renew_all()

    def _on_redo(self) -> None:
        self._begin_change()
        if self.model.can_redo:
            self.model.redo()
            self._renew_all()

    def _on_cure(self, name: str) -> None:
        self._begin_change()
        self.model.cure(name)
        if name in ("unit", "inside"):  # the valve is elsewhere
            self._refresh()
            self._look("oblique")
        self._renew_all()

    # placement

    def _on_place(self, field: str, k: int, value: Any) -> None:
        self._begin_change()
        valve = self._valve()
        place = {name: list(getattr(valve, name)) for name in ("origin", "axis", "reference")} | {"scale": [valve.scale]}
        if field in ("axis", "reference"):
            place[field] = [reading.number_of(part, field) for part in str(value).replace(",", " ").split()]
        else:
            place[field][int(k)] = reading.number_of(value, field)
        self.model.place(self.state.current, **place | {"scale": place["scale"][0]})
        self._renew_all()

    def _on_flip(self) -> None:
        self._begin_change()
        self.model.flip(self.state.current)
        self._renew_all()

    def _on_click_three(self) -> None:
        self._need_model()
        self._clicks = []
        self.scene.show_points([])
        with self.state as state:
            state.tool, state.n_clicks, state.message = ("look" if state.tool == "click" else "click"), 0, ""
        self._moved.set()

    def _on_click(self, x: float, y: float) -> None:
        if self.scene is None or self.state.tool != "click":
            return
        self._need_model()
        point = self.scene.pick(x, y)
        if point is None:
            raise reading.Refusal("the click met no wall of the mesh; click on the wall where the annulus is")
        self._clicks.append(point)
        self.scene.show_points(self._clicks)
        with self.state as state:
            state.n_clicks, state.message = len(self._clicks), ""
        if len(self._clicks) == 3:
            points, self._clicks = self._clicks, []
            with self.state as state:
                state.tool, state.n_clicks = "look", 0
            self._end_drag()
            self.scene.show_points([])
            self.model.place_by_clicks(self.state.current, points)
            self._renew_all()
        self._moved.set()

    def _changed_tool(self) -> None:
        if self.scene is not None and self.state.tool != "click" and self._clicks:
            self._clicks = []
            self.scene.show_points([])
            with self.state as state:
                state.n_clicks = 0
            self._moved.set()

    def _on_gesture(self, kind: str, dx: float, dy: float, shift: bool) -> None:
        if self.scene is None or self._busy == saving.FILMING:
            return
        tool = self.state.tool if kind == "tool" else kind
        if tool == "zoom":
            self.scene.zoom(dy)
        elif tool == "pan":
            self.scene.move_view(dx, dy)
        elif tool in ("look", "click"):
            self.scene.turn_view(dx, dy)
        else:
            self._held = True
            valve = self._valve()
            place = rows.dragged(self.scene, tool, valve, dx, dy, shift)
            self._move(lambda: self.model.place(self.state.current, *place), ("place", self.state.current, tool))
            valve = self._valve()
            self.scene.show_handle(valve.origin, valve.axis, 1.2 * self._reach())
        self._moved.set()

    def _on_gesture_ends(self) -> None:
        self._held = False
        if self.scene is None:
            return
        if self.state.tool in ("move", "turn", "size"):
            self._end_drag()
            self._show_placement()
        self._touch()

    # the view

    def _changed_wall(self) -> None:
        if self.scene is not None:
            self.scene.show_wall(self.state.wall)
            self._moved.set()

    def _changed_cells(self) -> None:
        if self.scene is not None:
            self.scene.show_cells(self.state.cells)
            self._moved.set()

    def _on_look(self, how: str) -> None:
        self._need_model()
        self._look(how)
        self._moved.set()

    def _look(self, how: str) -> None:
        valve = self._valve()
        centre, reach = numpy.asarray(valve.origin, float), self._reach()
        if self._shown is not None and len(self._shown.surfaces) > self.state.current:
            points = self._shown.surfaces[self.state.current].points
            centre = 0.5 * (points.min(axis=0) + points.max(axis=0))
            reach = float(numpy.linalg.norm(points - centre, axis=1).max())
        self.scene.look(how, centre, valve.axis, valve.reference, 1.45 * reach)
        self.scene.cut_here(valve.origin, valve.axis)

    # the heartbeat

    def _show_curves(self) -> None:
        """Draws a heartbeat's curves. A valve without a cycle has none."""
        i, model = self.state.current, self.model
        with self.state as state:
            state.curves = []
            if model.period(i) <= 0.0:
                return
            state.period = float(model.period(i))
            cycle = model.valves[i].cycle
            state.cycle = cycle.source if cycle is not None else ""
            curve = model.curve(41, i)
            times, unit = curve["time"], f"{model.unit}²" if model.unit else "square units"
            state.curves = [
                rows.line_of("Opening, from 0 to 1", times, curve["opening"], COLOURS[0], top=1.0),
                rows.line_of("Orifice area", times, curve["orifice"], COLOURS[1], unit),
                rows.line_of("Marked nodes", times, curve["marked"], COLOURS[2], "nodes"),
            ]

    def _on_cycle(self, cycle: str | None, period: Any) -> None:
        self._begin_change()
        seconds = reading.number_of(self.state.period if period is None else period, "period")
        name = str(self.state.cycle if cycle is None else cycle or "").strip()
        if not name:
            name = "mitral" if self._valve().kind == "mitral" else "aortic"
        self.model.set_cycle(name if name in CYCLES else str(self.folder / os.path.expanduser(name)), seconds)
        with self.state as state:
            state.cycle, state.time = name, 0.0
        self._renew_all()

    def _need_cycle(self) -> None:
        if not any(self.model.period(k) > 0.0 for k in range(len(self.model.valves))):
            self._on_cycle(None, None)
        elif self.model.period(self.state.current) > 0.0:
            self.state.period = float(self.model.period(self.state.current))

    def _changed_time(self) -> None:
        if self.model is None or self.state.playing or math.isclose(float(self.state.time), self.model.time, abs_tol=1e-12):
            return
        self._need_model()
        seconds = float(self.state.time)
        self._need_cycle()  # a new cycle begins at 0
        self._at(seconds)
        with self.state as state:
            state.time = seconds

    def _at(self, seconds: float) -> None:
        self._end_drag()
        self.model.at(seconds)
        self._touch()

    def _on_play(self) -> None:
        self._need_model()
        if self._playing is not None:
            self._pause()
        else:
            self._need_cycle()
            self._playing = asyncio.ensure_future(self._play())

    def _pause(self) -> None:
        if self._playing is not None:
            self._playing.cancel()
            self._playing = None
        with self.state as state:
            state.playing = False

    async def _play(self) -> None:
        with self.state as state:
            state.playing = True
        self._seen_at = time.monotonic()
        last = time.monotonic()
        while True:
            await asyncio.sleep(0.02)
            now = time.monotonic()
            if now - self._seen_at > UNSEEN:  # the browser is gone
                break
            if self._moved.is_set() or not self._seen.is_set():
                continue  # the last picture is still under way
            seconds = (self.model.time + (now - last) * float(self.state.speed)) % float(self.state.period)
            last = now
            self._told(self._at)(seconds)
        self._playing = None
        with self.state as state:
            state.playing = False

    # the server

    def serve(self, *, port: int = 0, browser: bool = True) -> None:
        """Serves the page on 127.0.0.1 until Ctrl C. A port of 0 takes a free one."""
        with guard.Guard(self.server) as gate:
            gate.start(port, browser)
