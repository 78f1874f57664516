# SPDX-License-Identifier: Apache-2.0
"""The parts of the page of riis view that a person changes: sliders and numbers, the placement, and the view of the
picture."""

from __future__ import annotations

import math
import time
from collections.abc import Callable
from typing import Any

import numpy

from riis._errors import InvalidParameterError
from riis.view import reading, rows, saving
from riis.view._numbers import in_unit
from riis.view._part import Part
from riis.view.patient import PLACING


class Hand(Part):
    """The part of a Page that answers sliders, fields, clicks and drags."""

    _set_landmark_at: Any
    _show_landmarks: Any

    # sliders and parameters

    def _slid(self, k: int) -> None:
        if self.model is None or k >= len(self.state.sliders) or self.state.sliders[k] is None:
            return
        name, value = self.state.sliders[k]["name"], float(self.state[f"slider_{k}"])
        if math.isclose(value, self._slider_values[k], rel_tol=1e-12, abs_tol=1e-12):
            return
        self._slider_values[k] = value
        own = self._in_own_unit(name, value)
        self._move(lambda: self._set_own(name, own), ("set", self.state.current, name))

    def _set_own(self, name: str, value: Any) -> None:
        """Sets a value. A refusal of a parameter's length says that it is in centimetres, if the screen has another unit."""
        try:
            self.model.set(self.state.current, name, value)
        except InvalidParameterError as error:
            hint = "" if self._valve().scale == 1.0 else " (lengths of parameters in centimetres)"
            raise reading.Refusal(f"{error}{hint}") from error

    def _in_own_unit(self, name: str, value: float) -> float:
        """Returns a number on the screen in the unit of the parameter. On the screen, all lengths have the mesh's unit."""
        valve = self._valve()
        if valve.surface is None:
            for parameter in self.model.parameters(valve.kind):
                if parameter.name == name:
                    return in_unit(value, 1.0 / rows.factor_of(parameter, valve.scale))
        return value

    def _move(self, change: Callable[[], Any], what: Any) -> None:
        """Makes a change. Changes of the same thing in one drag, or in quick succession, are one step of undo.

        The time is counted from the last picture, because a slow server responds late to a hand that still moves.
        """
        self._need_model()
        now = time.monotonic()
        if self._drag is None or self._drag[0] != what or (not self._held and now - max(self._drag[1], self._seen_at) > 0.7):
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
        if self.state.message_type == "error":  # it would seem to be about this change
            with self.state as state:
                state.message = ""

    def _on_set(self, name: str, value: Any) -> None:
        self._begin_change()
        if value is None:
            self.model.unset(self.state.current, name)
        elif name == "resistance":
            self._set_resistance(str(value).strip())
        else:
            numbers = [
                self._in_own_unit(name, reading.number_of(part, name)) for part in str(value).replace(",", " ").split()
            ]
            if not numbers:
                raise reading.Refusal(f"{name}: is empty; it must be a number")
            self._set_own(name, numbers if len(numbers) > 1 else numbers[0])
        self._renew_all()

    def _set_resistance(self, text: str) -> None:
        """Sets R from a number or from a text with a unit."""
        try:
            number: Any = float(text)
        except ValueError:
            number = text
        self.model.set(self.state.current, "resistance", number)

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
        if self.scene is None or self.state.tool not in ("click", PLACING):
            return
        self._need_model()
        point = self.scene.pick(x, y)
        if point is None:
            raise reading.Refusal("the click met no wall; click on the wall where the annulus is")
        if self.state.tool == PLACING:
            self._set_landmark_at(point)
            return
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
        if self.scene is not None and self.state.tool != PLACING and self.state.landmark:
            with self.state as state:
                state.landmark = ""
            self._show_landmarks()
            self._moved.set()
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
        elif tool in ("look", "click", PLACING):
            self.scene.turn_view(dx, dy)
        else:
            self._held = True
            valve = self._valve()
            place = rows.dragged(self.scene, tool, valve, dx, dy, shift)
            self._move(lambda: self.model.place(self.state.current, *place), ("place", self.state.current, tool))
            valve = self._valve()
            self.scene.show_handle(valve.origin, valve.flow, 1.2 * self._reach())
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

    def _look_at_all(self) -> None:
        """Shows the whole mesh or wall, in which the valve is not yet placed."""
        lower, upper = self.model.bounds if self.model.wall is None else (self.model.wall.lower, self.model.wall.upper)
        valve = self._valve()
        reach = 0.45 * float(numpy.linalg.norm(upper - lower))
        self.scene.look("oblique", 0.5 * (lower + upper), valve.axis, valve.reference, reach)
        self.scene.cut_here(valve.origin, valve.axis)

    def _look(self, how: str) -> None:
        valve = self._valve()
        centre, reach = numpy.asarray(valve.origin, float), self._reach()
        if self._shown is not None and len(self._shown.surfaces) > self.state.current:
            points = self._shown.surfaces[self.state.current].points
            centre = 0.5 * (points.min(axis=0) + points.max(axis=0))
            reach = float(numpy.linalg.norm(points - centre, axis=1).max())
        self.scene.look(how, centre, valve.axis, valve.reference, 1.45 * reach)
        self.scene.cut_here(valve.origin, valve.axis)
