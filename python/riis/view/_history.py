# SPDX-License-Identifier: Apache-2.0
"""The valves of a model with their surfaces, the landmarks and the wall, and the steps of undo."""

from __future__ import annotations

import dataclasses
import time as clock
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any, NamedTuple

import numpy

from riis._riis import Keyframes, Marks, Surface, Valve
from riis.view._landmark_files import LandmarkSet
from riis.view._valves import ValveState, refuse
from riis.view._walls import Wall

_MOST_STEPS = 200  # of undo


@dataclasses.dataclass
class Placed:
    """The state of a valve, with the objects that are made from it."""

    state: ValveState
    surface: Surface
    keyframes: Keyframes | None
    marks: Marks
    seconds: float  # that the surface took
    wall: Wall | None  # to which the skirt leads; None without a skirt
    valve: Valve | None  # with this skirt; None without a skirt

    @classmethod
    def of(cls, state: ValveState, before: Placed | None = None, wall: Wall | None = None) -> Placed:
        start = clock.perf_counter()
        same = before is not None and before.state.surface is state.surface
        keyframes = before.keyframes if before is not None and same else state.keyframes()
        valve = None
        if state.skirt > 0.0:  # the skirt is that of the closed valve, so it stays while the valve opens
            known = before is not None and before.valve is not None and before.wall is wall and before.state.has_skirt_of(state)
            valve = before.valve if known and before is not None else state.valve_in(None if wall is None else wall.surface)
            assert valve is not None
            valve["opening"] = state.opening
        surface = state.made_surface(keyframes, valve)
        marks = before.marks if before is not None else Marks()
        return cls(state, surface, keyframes, marks, clock.perf_counter() - start, wall if valve is not None else None, valve)


class Snapshot(NamedTuple):
    """Everything that a change can change."""

    valves: tuple[ValveState, ...]
    unit: str | None
    landmarks: LandmarkSet
    wall: Wall | None


class Valves:
    """Valves, landmarks and a wall that can be changed and undone. A change that is refused changes nothing."""

    def __init__(self, unit: str | None) -> None:
        self._unit = unit
        self._placed: tuple[Placed, ...] = ()
        self._landmarks = LandmarkSet()
        self._wall: Wall | None = None
        self._undo: list[Snapshot] = []
        self._redo: list[Snapshot] = []
        self._drag: tuple[Any, ...] | None = None
        self._is_dragging = False

    def _forget(self) -> None:
        """Is called after each change."""

    @property
    def valves(self) -> tuple[ValveState, ...]:
        """Snapshots of the valves."""
        return tuple(placed.state for placed in self._placed)

    def _at(self, i: int) -> Placed:
        if isinstance(i, bool) or not isinstance(i, (int, numpy.integer)) or not 0 <= i < len(self._placed):
            raise refuse(f"i: is {i!r}; there are {len(self._placed)} valves, from 0")
        return self._placed[int(i)]

    def _now(self) -> Snapshot:
        return Snapshot(self.valves, self._unit, self._landmarks, self._wall)

    def _change(self, states: tuple[ValveState, ...], unit: str | None, key: tuple[Any, ...] | None = None) -> None:
        """Makes the surfaces of new states, and then takes the states and one step of undo."""
        self._change_to(self._now()._replace(valves=states, unit=unit), key)

    def _change_to(self, after: Snapshot, key: tuple[Any, ...] | None = None) -> None:
        placed = self._made(after.valves, after.wall)
        if not (self._is_dragging and key is not None and key == self._drag):
            self._undo.append(self._now())
            del self._undo[:-_MOST_STEPS]
        self._drag = key if self._is_dragging else None
        self._redo.clear()
        self._take(placed, after)

    def _made(self, states: tuple[ValveState, ...], wall: Wall | None) -> tuple[Placed, ...]:
        known = {id(placed.state): placed for placed in self._placed}
        made = []
        for number_of, state in enumerate(states):
            same = known.get(id(state))
            before = self._placed[number_of] if number_of < len(self._placed) else None
            if same is None or (state.skirt > 0.0 and same.wall is not wall):
                same = Placed.of(state, before if len(states) == len(self._placed) else None, wall)
            made.append(same)
        return tuple(made)

    def _take(self, placed: tuple[Placed, ...], after: Snapshot | None = None) -> None:
        """Adopts surfaces, together with everything else that has changed."""
        self._placed = placed
        if after is not None:
            self._unit, self._landmarks, self._wall = after.unit, after.landmarks, after.wall
        self._forget()

    def _replace(self, i: int, key: tuple[Any, ...] | None, **changes: Any) -> None:
        before = self._at(i).state
        if "found" not in changes and {"kind", "parameters", "rotation", "origin", "scale", "warp"} & set(changes):
            changes["found"] = None
        if before.warp is not None and "warp" not in changes and {"rotation", "origin", "scale"} & set(changes):
            moved = dataclasses.replace(before, **changes)
            if moved.placement != before.placement:
                changes["warp"] = before.warp.in_own_frame(before.placement)
        state = dataclasses.replace(before, **changes)
        if state == before:
            return
        states = tuple(state if number_of == i else other for number_of, other in enumerate(self.valves))
        self._change(states, self._unit, key)

    @contextmanager
    def dragging(self) -> Iterator[None]:
        """During this context, successive changes of one thing are one step of undo."""
        self._is_dragging, self._drag = True, None
        try:
            yield
        finally:
            self._is_dragging, self._drag = False, None

    def forget_steps(self) -> None:
        """Makes the present valves the first ones, so that there is nothing to undo or redo."""
        self._undo.clear()
        self._redo.clear()

    @property
    def can_undo(self) -> bool:
        return bool(self._undo)

    @property
    def can_redo(self) -> bool:
        return bool(self._redo)

    def undo(self) -> bool:
        """Undoes the last change. Returns whether there was one."""
        return self._step(self._undo, self._redo)

    def redo(self) -> bool:
        """Redoes the change that was undone last. Returns whether there was one."""
        return self._step(self._redo, self._undo)

    def _step(self, from_: list[Snapshot], to: list[Snapshot]) -> bool:
        if not from_:
            return False
        now = self._now()
        placed = self._made(from_[-1].valves, from_[-1].wall)
        to.append(now)
        self._drag = None
        self._take(placed, from_.pop())
        return True

    @contextmanager
    def one_step(self) -> Iterator[None]:
        """During this context, all changes are one step of undo. If one of these changes is refused, none of them remains."""
        before, undo, redo = self._now(), list(self._undo), list(self._redo)
        try:
            yield
        except BaseException:
            self._take(self._made(before.valves, before.wall), before)
            self._undo, self._redo = undo, redo
            raise
        self._undo = [*undo, before][-_MOST_STEPS:]
