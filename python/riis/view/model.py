# SPDX-License-Identifier: Apache-2.0
"""The model of the view, which contains everything except the pictures.

    model = Model(points, cells, unit="mm", path="root.vtu")
    i = model.add("coapting")
    model.place_by_clicks(i, clicks)              # three points of the annulus
    shown = model.update()                        # triangles, marked nodes and cells
    for light in model.lights(): print(light.name, light.level, light.text, light.advice)
    print(model.command())                        # riis mark root.vtu --valve=coapting ...

A change is checked when it is made. If it is refused, with a riis.Error that names the value, nothing has changed. A model is for
one thread at a time.
"""

from __future__ import annotations

import dataclasses
import json
import math
import os
import re
import time as clock
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path
from types import MappingProxyType
from typing import Any, Literal, NamedTuple

import numpy
from numpy.typing import NDArray

from riis._place import UNITS
from riis._riis import Marks, Surface, mark, read_resistance
from riis.view import _outputs, _sessions
from riis.view._annulus import annulus_of, placed_by
from riis.view._bumps import BumpedValves
from riis.view._cells import Region, WholeMesh
from riis.view._cycles import CYCLES, cycle_of
from riis.view._history import Placed, Snapshot
from riis.view._landmarks import LandmarkedValves, warp_object
from riis.view._lights import JUDGES, NAMES, Light, Scene, worst
from riis.view._walls import Wall
from riis.view._orifice import outline_of
from riis.view._valves import (
    KINDS, SURFACE, TRIANGULATIONS, Cycle, Parameter, SurfaceSource, Value, ValveState, above_zero,
    at_least_zero, check_kind, check_name, check_valve_name, is_atrioventricular, number, parameters_of, point, refuse,
    rotation_of, share, turned, values_of, values_that_were_set, vector,
)

__all__ = [
    "CYCLES", "KINDS", "UNITS", "Cycle", "Light", "Model", "Parameter", "ShownSurface", "Shown", "SurfaceSource", "ValveState",
]

Reals = NDArray[numpy.float64]
Ids = NDArray[numpy.int64]
Integers = NDArray[numpy.int32]

class ShownSurface(NamedTuple):
    """The triangles of a valve in its present state."""

    points: Reals  #: (n, 3), mesh units
    triangles: Ids  #: (m, 3)
    leaflet: Integers  #: (m,): the leaflet of each triangle; a skirt is a separate leaflet


class Shown(NamedTuple):
    """The contents of a picture: the valves, and the nodes and cells that they mark. Ids are the caller's, ascending."""

    surfaces: tuple[ShownSurface, ...]
    marked: Ids  #: (n,)
    leaflet: Integers  #: (n,): the leaflet that is nearest to each marked node
    distance: Reals  #: (n,), of each marked node, the distance from this leaflet
    valve: Ids  #: (n,): the valve of this leaflet
    cells_marked: Ids  #: volume cells whose nodes are all marked
    cells_partly: Ids  #: volume cells with some marked nodes
    milliseconds: float  #: the time of the last change of the surfaces and of these marks


class Model(BumpedValves, LandmarkedValves):
    """A mesh with valves that can be moved, changed, judged and written.

    points   (n, 3): the nodes. None: there is no mesh, only a wall
    cells    volume cells as riis.Adjacency.from_cells takes them: (n, 4, 5, 6 or 8), or flat with offsets. None: nodes only
    offsets  (n_cells + 1,): where each cell begins in cells
    types    (n_cells,): VTK's types of the cells. With types, cells may also be triangles, lines or quadratic
    unit     of the mesh: "mm", "cm" or "m". None: not known
    path     the file of the mesh, for the files and commands that the model writes
    cells_where  NAME=VALUES, if the arrays are only these cells of the file
    wall     the wall around the valve, to which skirts lead. None: the boundary of the cells is the wall
    """

    def __init__(
        self,
        points: Any,
        cells: Any = None,
        *,
        offsets: Any = None,
        types: Any = None,
        unit: Literal["mm", "cm", "m"] | None = None,
        path: str | os.PathLike[str] | None = None,
        cells_where: str | None = None,
        wall: Wall | None = None,
        _near: bool = False,
    ) -> None:
        if points is None and wall is None:
            raise refuse("points: is None, and so is wall; the view needs a mesh or a wall")
        if unit is not None and unit not in UNITS:
            raise refuse(f"unit: is {unit!r}; it must be {', '.join(UNITS)}")
        self._mesh = WholeMesh(points, cells, offsets=offsets, types=types, near=_near)
        self._path = None if path is None else os.fspath(path)
        self._cells_where = cells_where
        super().__init__(unit)
        self._wall = wall
        self._time = 0.0
        self._shown: Shown | None = None
        self._lights: list[Light] | None = None

    @classmethod
    def near(cls, points: Any, cells: Any = None, **options: Any) -> Model:
        """Makes a model of a large mesh. The model keeps the whole mesh, and works with the cells near the valves.

        The marks are equal to those of the whole mesh. If a valve leaves the cells near it, the next update finds new cells,
        which takes about a second for 5 million nodes.
        """
        return cls(points, cells, _near=True, **options)

    def _forget(self) -> None:
        self._shown = self._lights = None

    # ---- Facts ----

    @property
    def points(self) -> Reals:
        """(n, 3): the nodes of the whole mesh."""
        return self._mesh.points

    @property
    def unit(self) -> str | None:
        return self._unit

    @property
    def path(self) -> str | None:
        return self._path

    @property
    def cells_where(self) -> str | None:
        return self._cells_where

    @property
    def time(self) -> float:
        return self._time

    @property
    def bounds(self) -> tuple[Reals, Reals]:
        """The least and the largest coordinates of the mesh, or of the wall if there is no mesh."""
        box = self._wall if self._mesh.is_missing and self._wall is not None else self._mesh
        return box.lower, box.upper

    def parameters(self, kind: str) -> list[Parameter]:
        """Returns the sizes of a kind. The most important sizes come first."""
        return list(parameters_of(kind))

    def values(self, i: int) -> dict[str, Value]:
        """Returns the present values of all parameters of a valve, including values that are not set."""
        return values_of(self._at(i).state)

    def surface(self, i: int) -> Surface:
        """Returns the present surface of a valve, for its measures. The next change replaces it."""
        return self._at(i).surface

    # ---- Valves ----

    def _free_name(self, word: str) -> str:
        names = {state.name for state in self.valves}
        numbers = (word if k == 1 else f"{word}_{k}" for k in range(1, len(names) + 2))
        return next(name for name in numbers if name not in names)

    def add(self, kind: str) -> int:
        """Adds a closed valve of a kind at the mesh's origin, with the scale of the mesh's unit. Returns its number."""
        check_kind(kind)
        scale = UNITS[self._unit] if self._unit is not None else 1.0
        state = ValveState(
            name=self._free_name(kind), kind=kind, opening=0.0, half_thickness=0.1 * scale, resistance=1e4, scale=scale
        )
        self._change((*self.valves, state), self._unit)
        return len(self._placed) - 1

    def add_surface(
        self,
        vertices: Any,
        faces: Any,
        *,
        leaflet_id: Any = None,
        times: Any = None,
        period: float = 0.0,
        path: str | os.PathLike[str] | None = None,
        half_thickness: float | None = None,
    ) -> int:
        """Adds a surface from a file. Returns its number.

        vertices    (n, 3), or (n_frames, n, 3) with times: in the mesh's unit
        faces       (n, 3 or 4)
        times       (n_frames,): the times of the frames; ``at`` moves the surface
        path        the file, for the case and the command
        """
        array = numpy.ascontiguousarray(vertices, numpy.float64)
        if array.ndim == 2:
            array = array[None]
        if array.ndim != 3 or array.shape[2] != 3 or 0 in array.shape:
            raise refuse(f"vertices: has the shape {numpy.shape(vertices)}; it must be (n, 3), or (n_frames, n, 3)")
        moments = None if times is None else numpy.ascontiguousarray(times, numpy.float64)
        if moments is None and len(array) > 1 or moments is not None and moments.shape != (len(array),):
            raise refuse(f"times: has the shape {numpy.shape(times)} for {len(array)} frames of vertices")
        source = SurfaceSource(
            array, numpy.ascontiguousarray(faces, numpy.int64),
            None if leaflet_id is None else numpy.ascontiguousarray(leaflet_id, numpy.int32), moments,
            number(period, "period"), None if path is None else os.fspath(path),
        )
        side = float(numpy.ptp(array.reshape(-1, 3), axis=0).max())
        half = 0.04 * side if half_thickness is None else above_zero(half_thickness, "half_thickness")
        word = re.sub("[^A-Za-z0-9_.-]", "_", Path(source.path).stem)[:32] if source.path else ""
        state = ValveState(
            name=self._free_name(word or SURFACE), kind=SURFACE, opening=0.0, half_thickness=half, resistance=1e4, scale=1.0,
            surface=source, time=0.0 if moments is None else float(moments[0]),
        )
        self._change((*self.valves, state), self._unit)
        return len(self._placed) - 1

    def remove(self, i: int) -> None:
        self._at(i)
        self._change(tuple(state for number_of, state in enumerate(self.valves) if number_of != i), self._unit)

    def change_kind(self, i: int, kind: str) -> None:
        """Turns a valve into a valve of another kind, with the default sizes of this kind. The valve keeps its placement, half
        thickness and cycle."""
        state = self._at(i).state
        if state.surface is not None:
            raise refuse(f"i: valve {i} is a surface from a file, which has no kind")
        if check_kind(kind) != state.kind:
            name = self._free_name(kind) if re.fullmatch(state.kind + "(_[0-9]+)?", state.name) else state.name
            skirt = 0.0 if kind == "bileaflet" else state.skirt  # its housing takes the place of a skirt
            self._replace(i, None, kind=kind, parameters=MappingProxyType({}), name=name, warp=None, skirt=skirt)

    def set(self, i: int, name: str, value: Any) -> None:
        """Sets a parameter of a valve, or "opening", "half_thickness", "offset", "resistance", "scale", "triangulation", "name".

        Lengths of parameters are in centimetres, the half thickness is in mesh units. The offset is in half thicknesses. The
        resistance is in kg/(m s) if the mesh has a unit, and a text such as "1e5 g/(cm s)" then has its own. Without a unit, the
        resistance is in mesh units. A surgeon's name, such as "annulus", sets the parameter that it stands for. Refuses a value
        that is out of range, and sizes that do not fit together.
        """
        state = self._at(i).state
        key = ("set", i, name)
        if name == "opening" and state.surface is None:
            self._replace(i, key, opening=share(value, name))
        elif name in ("half_thickness", "scale"):
            self._replace(i, key, **{name: above_zero(value, name)})
        elif name == "offset":
            self._replace(i, key, offset=number(value, name))
        elif name == "resistance":
            self._replace(i, key, resistance=at_least_zero(self._resistance(value), name))
        elif name == "triangulation":
            if value not in TRIANGULATIONS:
                raise refuse(f"triangulation: is {value!r}; it must be {' or '.join(TRIANGULATIONS)}")
            self._replace(i, key, triangulation=value)
        elif name == "name":
            check_valve_name(value)
            if any(other.name == value for k, other in enumerate(self.valves) if k != i):
                raise refuse(f"name: {value!r} is the name of another valve")
            self._replace(i, key, name=value)
        else:
            self._set_parameter(i, name, value, key)

    def _resistance(self, value: Any) -> Any:
        """Returns R as the program reads it from a text. Other values stay."""
        if not isinstance(value, str):
            return value
        made, has_unit = read_resistance(value)
        if has_unit and self._unit is None:
            raise refuse(f"resistance: is {value!r}, which has a unit; the unit of the mesh is None")
        return made

    def _set_parameter(self, i: int, name: str, value: Any, key: tuple[Any, ...]) -> None:
        state = self._at(i).state
        valve = state.valve()
        if valve is None:
            raise refuse(f"name: is {name!r}; a surface has half_thickness, offset, resistance and scale")
        check_name(state.kind, name)
        if numpy.ndim(value) == 0:
            valve[name] = number(value, name)
        else:
            valve[name] = [number(part, name) for part in value]
        self._replace(i, key, parameters=values_that_were_set(valve))

    def unset(self, i: int, name: str) -> None:
        """Returns a parameter to its default, or to its rule."""
        state = self._at(i).state
        valve = state.valve()
        if valve is None:
            raise refuse(f"name: is {name!r}; a surface has no parameters")
        check_name(state.kind, name)
        valve.unset(name)
        self._replace(i, ("unset", i, name), parameters=values_that_were_set(valve))

    # ---- Placement ----

    def place(
        self, i: int, origin: Any = None, axis: Any = None, reference: Any = None, scale: float | None = None
    ) -> None:
        """Places a valve. If an argument is None, its part of the placement stays as it is.

        origin     the position of the valve's own origin, mesh units
        axis       the direction of the valve's z axis, of any length. Without a reference, the valve takes the smallest turn
        reference  a direction; the valve's x axis shall point as nearly to it as the axis allows
        """
        state = self._at(i).state
        changes: dict[str, Any] = {}
        if origin is not None:
            changes["origin"] = vector(point(origin, "origin"))
        if axis is not None or reference is not None:
            changes["rotation"] = rotation_of(turned(state.matrix, axis, reference))
        if scale is not None:
            changes["scale"] = above_zero(scale, "scale")
        self._replace(i, ("place", i), **changes)

    def flip(self, i: int) -> None:
        """Turns a valve upside down, by half a turn in the plane of its annulus, as nearly as possible about its x axis."""
        state = self._at(i).state
        middle, about = numpy.zeros(3), numpy.array([1.0, 0.0, 0.0])
        if state.surface is None:
            annulus = annulus_of(state)
            middle, about = annulus.centre, about - annulus.normal[0] * annulus.normal
            about /= numpy.linalg.norm(about)
        matrix = state.matrix @ (2.0 * numpy.outer(about, about) - numpy.eye(3))
        origin = numpy.array(state.origin) + state.scale * (state.matrix @ middle - matrix @ middle)
        self._replace(i, ("flip", i), rotation=rotation_of(matrix), origin=vector(origin))

    def place_by_clicks(self, i: int, points3: Any) -> None:
        """Places and sizes a valve by three points of the annulus, so that its annulus passes through them.

        The first point determines the turn of the valve. For three cusps the points are the nadirs, the lowest points of the
        attachment. The first nadir belongs to cusp 0, the right cusp of an aortic valve. For two or four cusps the first point is
        the nadir of cusp 0, and for mitral and tricuspid valves it is the middle of the anterior leaflet. The other points are
        then anywhere on the annulus. For a bileaflet valve the first point is at an end of the hinges. The valve's axis keeps its
        side, and ``flip`` reverses the axis. Lengths of the valve grow in proportion.
        """
        state = self._at(i).state
        if state.surface is not None:
            raise refuse(f"i: valve {i} is a surface from a file, which has no annulus")
        bare = dataclasses.replace(state, warp=None)
        self._replace(i, ("clicks", i), warp=None, **placed_by(bare, points3))

    # ---- Marks ----

    def _region(self) -> Region:
        lower, upper = numpy.full(3, math.inf), numpy.full(3, -math.inf)
        for placed in self._placed:
            box = _box_of_band(placed.surface)
            lower, upper = numpy.minimum(lower, box[0]), numpy.maximum(upper, box[1])
        if not self._placed:
            lower = upper = (self.bounds[0] + self.bounds[1]) / 2.0
        return self._mesh.region(lower, upper)

    def update(self) -> Shown:
        """Marks the nodes for the present valves. Without a change since the last call, returns the same object."""
        if self._shown is not None:
            return self._shown
        region = self._region()
        region.prepare()
        start = clock.perf_counter()
        lists = []
        for k, placed in enumerate(self._placed):
            mark(placed.surface, region.mesh, into=placed.marks, allow_none=True)
            lists.append((placed.marks.ids.copy(), placed.marks.leaflet_id.copy(), placed.marks.distance.copy(), k))
        nodes, leaflet, distance, valve = _merged(lists)
        cells_marked, cells_partly = region.cells_of(nodes)
        seconds = clock.perf_counter() - start
        surfaces = []
        for placed in self._placed:
            seconds += placed.seconds
            faces = placed.surface.triangles
            surfaces.append(ShownSurface(placed.surface.vertices, faces.vertex_id, faces.leaflet_id))
        self._shown = Shown(
            tuple(surfaces), region.ids_of(nodes), leaflet, distance, valve, cells_marked, cells_partly, 1000.0 * seconds
        )
        return self._shown

    def marks_of(self, i: int) -> tuple[Ids, Reals, Integers]:
        """Returns the marked nodes of one valve, ascending, with their distances and leaflets."""
        self.update()
        marks = self._at(i).marks
        return self._region().ids_of(marks.ids), marks.distance.copy(), marks.leaflet_id.copy()

    def orifice(self, i: int) -> list[Reals]:
        """Returns the outline of a valve's free orifice as closed lines (n, 3). The list is empty for a closed orifice."""
        placed = self._at(i)
        return outline_of(placed.surface, self._disc_centre(placed.state))

    @staticmethod
    def _disc_centre(state: ValveState) -> Reals:
        valve = state.valve()
        shift = numpy.zeros(3)
        if valve is not None and "translation" in valve:
            shift[:2] = valve["translation"][:2]
        return numpy.asarray(numpy.array(state.origin) + state.scale * (state.matrix @ shift))

    # ---- Lights ----

    def lights(self) -> list[Light]:
        """Judges the valves: unit, inside, half_thickness, crossing, wall and sealed. With several valves, the worst one counts.

        Judging the valves takes longer than the marks, about half a second for 100,000 nodes, so a page calls it when the hand
        rests.
        """
        if self._lights is None:
            self.update()
            self._lights = [self._light(name) for name in NAMES]
        return list(self._lights)

    def _scenes(self) -> list[Scene]:
        region = self._region()
        return [
            Scene(k, placed.state, placed.surface, placed.marks, region, self._mesh, self._unit, self._wall)
            for k, placed in enumerate(self._placed)
        ]

    def _light(self, name: str) -> Light:
        scenes = self._scenes()
        if not scenes:
            return Light(name, "off", "there is no valve yet", "add a valve")
        return worst([JUDGES[name](scene) for scene in scenes])

    def cure(self, name: str) -> None:
        """Does what a light proposes, as one step of undo. Refuses if the light proposes nothing."""
        if name not in NAMES:
            raise refuse(f"name: is {name!r}; the lights are {', '.join(NAMES)}")
        self.update()
        light = self._light(name)
        if light.cure is None:
            raise refuse(f"name: the light {name} is {light.level} and offers no cure: {light.text}")
        with self.one_step():
            self._cure(light)

    def _cure(self, light: Light) -> None:
        i, name = light.valve, light.name
        if name == "unit":
            self._rescale(light.value)
        elif name == "inside":
            self.move_inside(i)
        elif name == "wall":
            if self._wall is not None:
                self.set_skirt(i, light.value)
            else:
                self.set(i, "skirt_length", light.value)
        else:
            # A new half thickness changes the triangles slightly, so the light is read again.
            length = light.value
            for _ in range(6):
                self.set(i, "half_thickness", length)
                self.update()
                again = JUDGES[name](self._scenes()[i])
                if again.level != "bad" or again.cure is None:
                    break
                length = max(again.value, 1.02 * length)

    def _rescale(self, factor: float) -> None:
        states = tuple(
            dataclasses.replace(state, scale=float(f"{factor * state.scale:.12g}"),
                                half_thickness=float(f"{factor * state.half_thickness:.12g}"))
            for state in self.valves
        )
        scale = states[0].scale
        unit = next((known for known, size in UNITS.items() if scale == size), None)
        self._change(states, unit if all(state.surface is None for state in states) else self._unit)

    def move_inside(self, i: int) -> None:
        """Moves a valve to the middle of the mesh, or of the wall if there is no mesh."""
        placed = self._at(i)
        info = placed.surface.info
        nodes = self._mesh.points if self._wall is None or not self._mesh.is_missing else self._wall.points
        middle = nodes.mean(axis=0)
        target = nodes[int(numpy.argmin(((nodes - middle) ** 2).sum(axis=1)))]
        origin = numpy.array(placed.state.origin) + target - (info.lower + info.upper) / 2.0
        self._replace(i, None, origin=vector(origin))

    # ---- Time ----

    def set_cycle(
        self, builtin_or_csv: str | os.PathLike[str] | None, period: float = 1.0, *, valve: int | None = None,
        interpolation: Literal["linear", "cubic"] = "linear",
    ) -> None:
        """Gives valves an opening in time, which ``at`` plays.

        builtin_or_csv  "aortic", "mitral" or "slow", or a CSV file of the program with two columns, times and openings. None: no
                        cycle
        period          after which the cycle repeats
        valve           the valve; None: all valves
        """
        cycle = None if builtin_or_csv is None else cycle_of(os.fspath(builtin_or_csv), period, interpolation)
        if valve is not None:
            self._at(valve)
        states = tuple(
            dataclasses.replace(state, cycle=cycle) if valve in (None, k) and state.surface is None else state
            for k, state in enumerate(self.valves)
        )
        self._change(states, self._unit)

    def at(self, time: float) -> None:
        """Moves all valves with a cycle, and surfaces that move, to a time. The move to a time is not a step of undo."""
        moment = number(time, "time")
        states = tuple(_moved(state, moment) for state in self.valves)
        self._take(self._made(states, self._wall))
        self._time = moment

    @contextmanager
    def kept(self) -> Iterator[None]:
        """Restores the time and the openings that the valves had before, whatever ``at`` does."""
        states, moment = self.valves, self._time
        try:
            yield
        finally:
            self._take(self._made(states, self._wall))
            self._time = moment

    def beat(self, period: float, *, chosen: str | os.PathLike[str] | None = None, valve: int = 0) -> None:
        """Lets all valves beat with one period, as one step of undo.

        chosen  a cycle as in set_cycle, for this valve alone. The other valves keep their cycles. A valve without a cycle gets
                the built-in cycle of its kind
        """
        self._at(valve)
        with self.one_step():
            for k, state in enumerate(self.valves):
                if state.surface is not None:
                    continue
                own = "mitral" if is_atrioventricular(state.kind) else "aortic"
                source = own if state.cycle is None else state.cycle.source
                interpolation = getattr(None if state.cycle is None else state.cycle.law, "interpolation", "linear")
                if k == valve and chosen is not None:
                    source, interpolation = os.fspath(chosen), "linear"
                self.set_cycle(source, period, valve=k, interpolation=interpolation)

    @property
    def span(self) -> tuple[float, float]:
        """The first and the last time of the motion. The motion has the longest period, and begins with the first frame of
        surfaces that move. Both times are 0 if nothing moves."""
        parts = []
        for k, state in enumerate(self.valves):
            source, length = state.surface, self.period(k)
            if length > 0.0:
                first = 0.0 if source is None or source.times is None else float(source.times[0])
                parts.append((first, first + length))
        return (min(part[0] for part in parts), max(part[1] for part in parts)) if parts else (0.0, 0.0)

    def period(self, i: int) -> float:
        """Returns the period of a valve's cycle or of a moving surface. Returns 0 if there is no period."""
        state = self._at(i).state
        if state.surface is not None:
            times = state.surface.times
            return 0.0 if times is None else state.surface.period or float(times[-1] - times[0])
        return 0.0 if state.cycle is None else state.cycle.period

    def curve(self, n: int = 50, i: int = 0) -> dict[str, Reals]:
        """Returns arrays (n,) over one period of a valve: time, opening, orifice (area) and marked (number of nodes)."""
        state = self._at(i).state
        if isinstance(n, bool) or not isinstance(n, (int, numpy.integer)) or not 2 <= n <= 10_000:
            raise refuse(f"n: is {n!r}; it must be from 2 to 10000")
        whole = self.period(i)
        if not whole > 0.0:
            raise refuse(f"i: valve {i} has no cycle; set_cycle gives it one")
        start = 0.0
        if state.surface is not None and state.surface.times is not None:
            start = float(state.surface.times[0])
        times = start + whole * numpy.arange(n) / (n - 1)
        marks = Marks()
        columns: dict[str, list[float]] = {"opening": [], "orifice": [], "marked": []}
        placed = self._at(i)
        region = self._region()
        known: dict[float, tuple[float, float]] = {}  # a valve at rest has the same numbers at many times
        for moment in times:
            moved = _moved(state, float(moment))
            columns["opening"].append(moved.opening)
            if state.surface is None and moved.opening in known:
                columns["orifice"].append(known[moved.opening][0])
                columns["marked"].append(known[moved.opening][1])
                continue
            placed = Placed.of(moved, placed, self._wall)
            box = _box_of_band(placed.surface)
            if not region.holds(*box):
                region = self._mesh.region(*box)
            mark(placed.surface, region.mesh, into=marks, allow_none=True)
            columns["orifice"].append(placed.surface.orifice().area)
            columns["marked"].append(float(len(marks)))
            known[moved.opening] = columns["orifice"][-1], columns["marked"][-1]
        return {"time": times, **{name: numpy.array(column) for name, column in columns.items()}}

    # ---- Files ----

    def case(self, times: Any = None) -> str:
        """Returns a case file of the program (riis help cases): the valves as they are now, or as they move at ``times``."""
        moments = None if times is None else [number(moment, "times") for moment in numpy.ravel(times)]
        self._check_skirts()
        return _outputs.case_of(self.valves, self._facts(), moments)

    def command(
        self, *, case: str = "case.json", output: str = "marked.vtu", program: str = "riis", warp: str = "warp.json"
    ) -> str:
        """Returns the command that gives the present marks. The command needs the files of ``command_files``, under their names.

        Several valves need a case. If a warp is in no placed file, it needs a separate file. If one of several valves is a
        surface that moves, the output is a .pvd file, whose first step has the present marks. Without a mesh, the command writes
        the surface that the page shows, as .vtp.
        """
        self._check_skirts()
        return _outputs.command_of(self.valves, self._facts(), case, output, program, warp)

    def command_files(self, *, case: str = "case.json", warp: str = "warp.json") -> dict[str, str]:
        """Returns the files that ``command`` needs, by their names."""
        if len(self.valves) > 1:
            return {case: self.case()}
        state = self.valves[0] if self.valves else None
        if state is None or state.warp is None or _outputs.is_from_its_file(state, self._facts()):
            return {}
        return {warp: json.dumps(warp_object(state.warp), indent=2) + "\n"}

    def python(self) -> str:
        """Returns a script that gives the present marks: marks[NAME] for each valve, and K. Without a path it needs points."""
        return _outputs.python_of(self.valves, self._facts())

    def _facts(self) -> _outputs.Facts:
        return _outputs.Facts(self._unit, self._path, self._cells_where, self._wall, self._mesh.is_missing)

    def openfoam(self, density: float = 1060.0) -> str:
        """Returns fvOptions of OpenFOAM, in metres and kilograms. For a mesh without a unit, lengths and R are written
        unchanged."""
        return _outputs.openfoam_of(self.valves, self._unit, density)

    def save(self, path: str | os.PathLike[str], page: Mapping[str, Any] | None = None) -> None:
        """Writes the session. ``load`` opens it as it was. A page adds further data, such as its camera, as JSON."""
        text = _sessions.session_of(self.valves, self._facts(), len(self.points), self._time, self._landmarks, page)
        Path(path).write_text(text, encoding="utf-8")

    def restore(self, path: str | os.PathLike[str]) -> dict[str, Any]:
        """Reads the valves of a session into this model, as one step of undo. The mesh must have as many nodes.

        Returns the data that the page added.
        """
        root, states = _sessions.read_session(os.fspath(path))
        if root["n_nodes"] != len(self.points):
            raise refuse(f"path: {os.fspath(path)!r} is of a mesh with {root['n_nodes']} nodes; this one has {len(self.points)}")
        self._change_to(Snapshot(states, root["unit"], root["landmarks"], root["wall"] or self._wall))
        self._time = root["time"]
        page: dict[str, Any] = root["page"]
        return page

    @classmethod
    def load(
        cls,
        path: str | os.PathLike[str],
        mesh: Mapping[str, Any] | Callable[[str], Mapping[str, Any]] | None = None,
    ) -> Model:
        """Opens a session.

        mesh  the arrays of its mesh, by the names of Model's arguments, such as {"points": ..., "cells": ..., "near": True}; or a
              function that reads these arrays from the session's path
        """
        root, _ = _sessions.read_session(os.fspath(path))
        if callable(mesh) and root["n_nodes"] > 0:
            if root["mesh"] is None:
                raise refuse(f"mesh: {os.fspath(path)!r} names no file of a mesh; pass its arrays")
            arrays = dict(mesh(root["mesh"]))
        elif mesh is not None and not callable(mesh):
            arrays = dict(mesh)
        elif root["wall"] is not None and root["n_nodes"] == 0:
            arrays = {"points": None, "wall": root["wall"]}
        else:
            raise refuse(f"mesh: is None; pass the arrays of {root['mesh'] or 'the mesh'}, or a function that reads them")
        known = {name: root[name] for name in ("unit", "cells_where")}
        made = cls(**{"path": root["mesh"], **known, "_near": arrays.pop("near", False), **arrays})
        made.restore(path)
        made.forget_steps()
        return made


def _box_of_band(surface: Surface) -> tuple[Reals, Reals]:
    """Returns the least and the largest coordinates of nodes that the surface may mark."""
    info = surface.info
    reach = (1.0 + abs(info.offset)) * info.half_thickness
    return info.lower - reach, info.upper + reach


def _merged(lists: list[tuple[Ids, Integers, Reals, int]]) -> tuple[Ids, Integers, Reals, Ids]:
    """Returns the nodes of all valves, ascending, each with its nearest leaflet."""
    if not lists:
        return numpy.empty(0, numpy.int64), numpy.empty(0, numpy.int32), numpy.empty(0), numpy.empty(0, numpy.int64)
    ids = numpy.concatenate([part[0] for part in lists])
    leaflet = numpy.concatenate([part[1] for part in lists])
    distance = numpy.concatenate([part[2] for part in lists])
    valve = numpy.concatenate([numpy.full(len(part[0]), part[3], numpy.int64) for part in lists])
    if len(lists) == 1:
        return ids, leaflet, distance, valve
    order = numpy.lexsort((valve, distance, ids))
    order = order[numpy.concatenate([[True], numpy.diff(ids[order]) > 0])] if len(order) else order
    return ids[order], leaflet[order], distance[order], valve[order]


def _moved(state: ValveState, time: float) -> ValveState:
    if state.surface is not None and state.surface.moves:
        return dataclasses.replace(state, time=time)
    if state.cycle is not None:
        return dataclasses.replace(state, opening=float(state.cycle.law(time)))
    return state
