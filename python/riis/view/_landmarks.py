# SPDX-License-Identifier: Apache-2.0
"""The part of a model with the landmarks of a patient and the wall: picking, placing, fitting, and the skirt to the wall."""

from __future__ import annotations

import dataclasses
import json
import os
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from types import MappingProxyType
from typing import Any, NamedTuple

import numpy
from numpy.typing import NDArray

from riis._fit import FitResult, fit
from riis._place import UNITS, PlaceResult, place
from riis._placed_file import open_placed
from riis._riis import PlacedFile, Valve, with_parameters
from riis.view import _landmark_files as files
from riis.view._history import Snapshot, Valves
from riis.view._landmark_files import FLOW, LandmarkSet, canonical, missing, next_name, role_of, roles_of
from riis.view._numbers import in_unit, with_unit
from riis.view._valves import (
    PlacedSource, ValveState, WarpState, check_kind, parameters_of, point, refuse, rotation_of, turned,
    values_that_were_set, vector,
)
from riis.view._walls import MOST_BEYOND, Wall, checked_skirt

Reals = NDArray[numpy.float64]
Ids = NDArray[numpy.int64]

WARPS = ("none", "smoothed", "exact")


class _Start(NamedTuple):
    """A valve and its placement, from which a fit starts."""

    valve: Valve
    placement: dict[str, Any]


class LandmarkedValves(Valves):
    """The part of a model with landmarks and a wall."""

    _free_name: Callable[[str], str]

    # ---- The wall ----

    @property
    def wall(self) -> Wall | None:
        """The wall around the valve. Without this wall, the lights use the boundary of the mesh's cells as the wall."""
        return self._wall

    def set_wall(self, wall: Wall | None) -> None:
        """Adopts a wall, to which skirts lead. None: no wall, and no skirts to it."""
        states = self.valves if wall is not None else tuple(_changed(state, skirt=0.0) for state in self.valves)
        self._change_to(self._now()._replace(wall=wall, valves=states))

    def stand_in_wall(self, i: int) -> None:
        """Puts a valve into the middle of the wall, with its axis along the wall's longest side. The axis points upwards."""
        if self._wall is None:
            raise refuse("wall: is None; there is no wall in which the valve could stand")
        points = self._wall.points
        middle = points.mean(axis=0)
        along = numpy.linalg.svd((points - middle)[:: 1 + len(points) // 20_000], full_matrices=False)[2][0]
        state = self._at(i).state
        axis = along if along[2] >= 0.0 else -along
        self._replace(i, ("place", i), rotation=rotation_of(turned(state.matrix, axis, None)), origin=vector(middle))

    def set_skirt(self, i: int, longest: Any) -> None:
        """Gives a valve a skirt that reaches the wall and no farther, or no skirt for 0.

        longest  the longest skirt to accept, in the mesh's unit. A wall that is missed or farther away is refused
        """
        length = checked_skirt(longest)
        if length > 0.0 and self._wall is None:
            raise refuse("skirt: there is no wall that it could reach; open a wall first, such as root.stl")
        self._replace(i, ("skirt", i), skirt=length)

    def _check_skirts(self) -> None:
        """Refuses a skirt that the program would refuse: the wall must be within reach at all openings."""
        for state in self.valves:
            if state.skirt > 0.0 and self._wall is not None:
                widest = self._wall.widest(state)
                if widest.is_missed or widest.gap > (1.0 + MOST_BEYOND) * state.skirt:
                    longest, gap = with_unit(state.skirt, self._unit), with_unit(widest.gap, self._unit)
                    found = "missed" if widest.is_missed else f"up to {gap} away as the valve opens"
                    raise refuse(
                        f"skirt: of the valve {state.name} is {longest} at most, and the wall is {found}: take a longer skirt, "
                        "as the light wall proposes"
                    )

    def gap_ribbon(self, i: int) -> tuple[Reals, Ids]:
        """Returns points (n, 3) and triangles (m, 3) of the gap between a valve and the wall: the skirt that would close it.

        The gap has no triangles without a wall, if the wall is missed, or if the valve has a skirt.
        """
        state, none = self._at(i).state, (numpy.empty((0, 3)), numpy.empty((0, 3), numpy.int64))
        valve = state.valve()
        if self._wall is None or valve is None or state.skirt > 0.0 or state.kind == "bileaflet" or valve["skirt_length"] > 0.0:
            return none
        gap = self._wall.gap(self._at(i).surface)
        if gap.n_without_wall > 0 or not gap.most > 0.0:
            return none
        valve.skirt_to_wall(self._wall.surface, 2.0 * gap.most + self._at(i).surface.info.half_thickness, **state.placement)
        surface = state.made_surface(valve=valve)
        faces, skirt = surface.triangles, surface.info.skirt_leaflet_id
        return numpy.array(surface.vertices), numpy.array(faces.vertex_id[faces.leaflet_id == skirt], numpy.int64)

    # ---- Landmarks ----

    @property
    def landmarks(self) -> LandmarkSet:
        """The landmarks, in the mesh's unit."""
        return self._landmarks

    def _set_landmarks(self, landmarks: LandmarkSet, key: tuple[Any, ...] | None = None) -> None:
        if landmarks != self._landmarks:
            self._change_to(self._now()._replace(landmarks=landmarks), key)

    def set_landmark(self, name: str, at: Any) -> str:
        """Sets a landmark, or moves it if it is set. Returns its name, with a number if the role has several landmarks.

        name  such as "nadir_left"; riis.place has the names. The name of a list without a number, such as "annulus", adds a
              landmark
        """
        own = self._checked_name(name)
        for kind in self._kinds():
            role = role_of(own, kind)
            if role is not None and role.is_list and own == role.name:
                own = next_name(role, self._landmarks.points)
        points = dict(self._landmarks.points) | {own: vector(point(at, own))}
        self._set_landmarks(self._landmarks._replace(points=MappingProxyType(points)), ("landmark", own))
        return own

    def _kinds(self) -> list[str]:
        return [state.kind for state in self.valves if state.surface is None]

    def _checked_name(self, name: Any) -> str:
        if not isinstance(name, str) or not name.strip():
            raise refuse(f"name: is {name!r}; it must be the name of a landmark")
        kinds = self._kinds()
        names = [canonical(name, kind) for kind in kinds] or [canonical(name)]
        for own, kind in zip(names, kinds):
            if role_of(own, kind) is not None:
                return own
        if names[0] in self._landmarks.points:
            return names[0]
        known = ", ".join(dict.fromkeys(role.name for kind in kinds for role in roles_of(kind)))
        raise refuse(f"name: {name!r} is no landmark of the kind {' or '.join(kinds) or 'None'}; it has {known or 'none'}")

    def remove_landmark(self, name: str) -> None:
        points = dict(self._landmarks.points)
        if points.pop(name, None) is None:
            raise refuse(f"name: {name!r} is not set; the landmarks are {', '.join(points) or 'none'}")
        self._set_landmarks(self._landmarks._replace(points=MappingProxyType(points)))

    def clear_landmarks(self) -> None:
        """Removes all landmarks."""
        self._set_landmarks(LandmarkSet(axes=self._landmarks.axes))

    def set_axes(self, axes: Any) -> None:
        """States the axes of the mesh and the wall: LPS, RAS or mesh, for other axes. The landmarks themselves do not move."""
        if axes not in files.AXES:
            raise refuse(f"axes: are {axes!r}; they must be {', '.join(files.AXES)}")
        self._set_landmarks(self._landmarks._replace(axes=axes))

    def missing_landmarks(self, i: int) -> list[str]:
        """Returns the names of the landmarks that a valve still needs."""
        state = self._at(i).state
        return [] if state.surface is not None else missing(state.kind, self._landmarks.points)

    def read_landmarks(self, path: str | os.PathLike[str]) -> str:
        """Takes the landmarks of a file in place of the present ones. The landmarks of the file are converted to the unit and the
        axes of the mesh.

        If the unit of the mesh is not known, it becomes that of the file. If the axes are not known, they become those of the
        file. Returns the kind of valve that the file names, or "".
        """
        read = files.read_file(path, self._unit, self._landmarks.axes)
        if read.kind:
            check_kind(read.kind)
        made = read.landmarks
        if self._landmarks.axes == "mesh":
            made = made._replace(axes="mesh")
        after = self._now()._replace(landmarks=made)
        if self._unit is None:
            after = _in_unit(after, read.unit)
        self._change_to(after)
        return read.kind

    def save_landmarks(self, path: str | os.PathLike[str], i: int = 0) -> None:
        """Writes the landmarks as .mrk.json of 3D Slicer or as .json, with the unit and the axes. i: the valve of the .json."""
        kind = self.valves[i].kind if i < len(self.valves) and self.valves[i].surface is None else None
        Path(path).write_text(files.text_of(self._landmarks, path, self._unit, kind), encoding="utf-8")

    def take_over(self, other: LandmarkedValves) -> None:
        """Takes the valves, the landmarks, the wall and the unit of another model, such as that of the same patient without a
        mesh."""
        now = other._now()
        self._change_to(now if self._unit is None else _in_unit(now, self._unit))

    # ---- Units ----

    def set_unit(self, unit: str | None) -> None:
        """States the unit of the mesh and the wall. Valves and landmarks keep their sizes in the mesh, and valves get the unit's
        scale."""
        if unit is not None and unit not in UNITS:
            raise refuse(f"unit: is {unit!r}; it must be {', '.join(UNITS)}")
        if unit != self._unit:
            self._change_to(_in_unit(self._now(), unit))

    # ---- Placing and fitting ----

    def place_by_landmarks(
        self, i: int, landmarks: Mapping[str, Any] | str | os.PathLike[str] | None = None, **options: Any
    ) -> PlaceResult:
        """Places and sizes a valve by a patient's landmarks, as riis.place does, with its options. Returns its result.

        landmarks  as riis.place takes them. None: the landmarks of the model
        """
        state = self._at(i).state
        if state.surface is not None:
            raise refuse(f"i: valve {i} is a surface from a file, which has no landmarks")
        if self._unit is None:
            raise refuse("unit: is None; landmarks need the unit of the mesh, so choose mm, cm or m first")
        valve = _changed(state, warp=None, opening=0.0).valve()
        assert valve is not None
        for name in state.sized:  # cusps that an earlier place found unequal begin equal
            if "." in name:
                valve.unset(name)
        if landmarks is None:
            landmarks, options = self._own_landmarks(state.kind, valve, options)
        found = place(landmarks, valve, unit=self._unit, **options)  # type: ignore[arg-type]
        warp = None
        if found.warp is not None:
            warp = WarpState(numpy.array(found.places), numpy.array(found.points), found.warp_noise, True)
        at = found.placement
        x, y, z = vector(at["rotation_axis"])
        self._replace(
            i, ("landmarks", i), parameters=values_that_were_set(found.valve), scale=float(at["scale"]),
            rotation=(x, y, z, float(at["rotation_angle"])), origin=vector(at["translation"]), warp=warp, found=found,
            sized=(*found.determined, *found.undetermined),
        )
        return found

    def _own_landmarks(self, kind: str, valve: Valve, options: dict[str, Any]) -> tuple[dict[str, Any], dict[str, Any]]:
        """Returns the landmarks of the kind, and the options with which riis.place takes them."""
        mine = self._landmarks
        lacks = missing(kind, mine.points)
        if lacks:
            raise refuse(f"landmarks: {', '.join(lacks)} {'is' if len(lacks) == 1 else 'are'} missing; pick them on the wall")
        others = [name for name in mine.points if role_of(name, kind) is None]
        if others:
            raise refuse(
                f"landmarks: a {kind} valve has no {others[0]}: choose the kind of valve to which the landmarks belong, or "
                "delete it"
            )
        points = {name: at for name, at in mine.points.items() if name not in FLOW}
        ends = [mine.points[name] for name in FLOW if name in mine.points]
        if len(ends) == 1:
            raise refuse("landmarks: of flow_from and flow_to only one is set; set both, or none")
        if ends:
            options.setdefault("flow", tuple(b - a for a, b in zip(*ends)))
        if mine.noise is not None:
            options.setdefault("noise", mine.noise)
        if mine.parameters:
            valve.update(mine.parameters)
            options.setdefault("held", [*options.get("held", ()), *mine.parameters])
        if self._wall is not None:
            options.setdefault("nodes", self._wall.points)
        return points, options

    def fit_of(self, i: int, points: Any, *, free: Sequence[str] | None = None, **options: Any) -> Callable[[], FitResult]:
        """Returns a function that fits a valve to the points of its segmented leaflets, as riis.fit does, with its options. The
        fit starts from the present sizes and placement. The function changes nothing, so it may run on another thread; take_fit
        takes its result.

        points  (n, 3), in the mesh's unit, or what riis.fit takes
        free    names of the sizes to fit. Without names, ``sizes_to_fit`` chooses them
        """
        state = self._at(i).state
        if state.surface is not None:
            raise refuse(f"i: valve {i} is a surface from a file, which has no sizes to fit")
        if state.warp is not None:
            raise refuse(f"i: valve {i} is warped to landmarks, and a fit has no warp: place it with the warp none first")
        valve = state.valve()
        assert valve is not None
        names = list(self.sizes_to_fit(i) if free is None else free)
        if self._unit is not None and state.scale == UNITS[self._unit]:
            options.setdefault("unit", self._unit)
        return lambda: fit(points, valve, free=names, start=_Start(valve, state.placement), **options)

    def sizes_to_fit(self, i: int) -> list[str]:
        """Returns the sizes that a fit frees unless others are named: the most important lengths of the kind."""
        state = self._at(i).state
        if state.surface is not None:
            return []
        names = list(Valve(state.kind))
        first = {size.name if size.name in names else size.other_name for size in parameters_of(state.kind)
                 if size.first and size.n_values == 1 and size.unit == "length"}
        return [name for name in names if name in first and name not in ("gap", "skirt_length", "meeting_shift")]

    def take_fit(self, i: int, found: FitResult) -> None:
        """Gives a valve the sizes and the placement of a fit."""
        if found.valve.kind != self._at(i).state.kind:
            raise refuse(f"found: is of a {found.valve.kind} valve; valve {i} is of the kind {self._at(i).state.kind}")
        at = found.placement
        x, y, z = vector(at["rotation_axis"])
        self._replace(
            i, ("fit", i), parameters=values_that_were_set(found.valve), scale=float(at["scale"]),
            rotation=(x, y, z, float(at["rotation_angle"])), origin=vector(at["translation"]), found=found,
        )

    # ---- Placed files ----

    def add_placed(self, path: str | os.PathLike[str]) -> int:
        """Adds the valve of a placed file, as riis place writes it. Returns its number.

        If the unit of the mesh is not known, it becomes that of the file.
        """
        file, valve = open_placed(path, self._unit)
        state = self._state_of_placed(path, file, valve)
        now = self._now()
        if self._unit is None:
            now = _in_unit(now, file.unit)
        self._change_to(now._replace(valves=(*now.valves, state)))
        return len(self._placed) - 1

    def _state_of_placed(self, path: str | os.PathLike[str], file: PlacedFile, valve: Valve) -> ValveState:
        kind, at = check_kind(file.kind), file.placement
        x, y, z = vector(at["rotation_axis"])
        rotation, origin = (x, y, z, float(at["rotation_angle"])), vector(at["translation"])
        pairs = file.warps
        if len(pairs) > 1:
            raise refuse(f"{os.fspath(path)}: has a warp of the open valve, which the view does not show")
        warp = WarpState(*pairs[0], file.noise, file.is_in_mesh) if pairs else None
        parameters = values_that_were_set(valve)
        source = PlacedSource(os.path.abspath(path), kind, file.unit, parameters, rotation, origin, warp)
        scale = float(at["scale"])
        return ValveState(
            name=self._free_name(kind), kind=kind, opening=0.0, half_thickness=0.1 * scale, resistance=1e4, scale=scale,
            rotation=rotation, origin=origin, parameters=parameters, warp=warp, placed=source,
        )

    def placed_file(self, i: int) -> str:
        """Returns the file of the placed valve, which each command of the program takes as --valve FILE.json. The file contains
        the sizes, the placement and the warp. The opening, the half thickness and a skirt are options of the commands."""
        state = self._at(i).state
        valve = state.valve()
        if valve is None:
            raise refuse(f"i: valve {i} is a surface from a file, which is placed by options of the commands")
        if self._unit is None:
            raise refuse("unit: is None; a placed file states the unit, so choose the unit of the mesh first")
        if state.scale != UNITS[self._unit]:
            raise refuse(
                f"scale: of valve {i} is {state.scale:.9g}, and a placed file has the scale of its unit, {UNITS[self._unit]:g} "
                f"for {self._unit}: set the scale to it, and change the sizes instead"
            )
        if isinstance(state.found, PlaceResult):
            return with_parameters(state.found._file, valve)
        return _placed_text(state, self._unit, self._landmarks.axes)


def _placed_text(state: ValveState, unit: str, axes: str | None) -> str:
    root: dict[str, Any] = {
        "valve": state.kind, "unit": unit, "axes": axes or "mesh", "rotate": list(state.rotation),
        "translate": list(state.origin), "parameters": files.nested(state.parameters),
    }  # fmt: skip
    if state.warp is not None:  # in the mesh, as riis place writes it and OpenFOAM takes it
        root["warp"] = warp_object(state.warp.in_mesh(state.placement))
    return json.dumps(root, indent=2) + "\n"


def warp_object(warp: WarpState) -> dict[str, Any]:
    """Returns a warp with the keys of a case and of a file for --warp."""
    return {
        "sources": warp.sources.tolist(), "targets": warp.targets.tolist(), "noise": warp.noise,
        "coordinates": "mesh" if warp.is_in_mesh else "valve",
    }  # fmt: skip


def _changed(state: ValveState, **changes: Any) -> ValveState:
    return dataclasses.replace(state, **changes)


def _in_unit(before: Snapshot, unit: str | None) -> Snapshot:
    """Returns the state of a model after the mesh's unit has become known. Valves get the unit's scale, and other lengths in the
    mesh stay as they are."""
    if unit is None or unit == before.unit:
        return before._replace(unit=unit)
    states = []
    for state in before.valves:
        if state.surface is not None:
            states.append(state)
            continue
        factor = UNITS[unit] / (state.scale if before.unit is None else UNITS[before.unit])
        warp = None if state.warp is None else state.warp.in_own_frame(state.placement)
        states.append(_changed(
            state, scale=in_unit(state.scale, factor), half_thickness=in_unit(state.half_thickness, factor), warp=warp,
            found=None, skirt=in_unit(state.skirt, factor),
        ))  # fmt: skip
    landmarks = before.landmarks
    if landmarks.noise is not None and before.unit is not None:
        landmarks = landmarks._replace(noise=in_unit(landmarks.noise, UNITS[unit] / UNITS[before.unit]))
    return before._replace(unit=unit, valves=tuple(states), landmarks=landmarks)
