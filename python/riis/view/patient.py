# SPDX-License-Identifier: Apache-2.0
"""The part of the page of riis view for a patient: the wall, the landmarks, placing and fitting, and the skirt to the wall."""

from __future__ import annotations

import asyncio
import functools
import os
from typing import Any

from riis._errors import Error
from riis.view import reading, rows
from riis.view._landmark_files import missing, role_of
from riis.view._lights import rounded_up
from riis.view._numbers import shown
from riis.view._part import Part

PLACING = "landmark"  # the tool that sets landmarks


class Patient(Part):
    """The part of a Page with the landmarks."""

    _end_drag: Any
    _look: Any

    def _show_patient(self) -> None:
        """Shows the landmarks, the residuals and the skirt of the model."""
        valve, state, model = self._valve(), self.state, self.model
        landmarks = model.landmarks
        state.landmarks = [] if valve.surface is not None else rows.landmarks_of(valve.kind, landmarks.points)
        if state.landmark and state.landmark not in {row["name"] for row in state.landmarks}:
            state.landmark = ""
        state.found = rows.found_of(valve.found, model.unit or "")
        state.unit, state.axes = model.unit, landmarks.axes
        state.has_wall = model.wall is not None
        state.skirt_on = valve.skirt > 0.0
        state.skirt = shown(valve.skirt, 6) if valve.skirt > 0.0 else ""
        state.resistance = shown(valve.resistance, 6)
        state.resistance_unit = "kg/(m s)" if model.unit else "in units of the mesh"
        state.sizes_to_fit = [] if valve.surface is not None else [
            name for name, known in valve.valve().parameters.items()
            if known.n_values == 1 and name not in ("opening", "skirt_length")
        ]  # fmt: skip
        if state.fit_kind != valve.kind:
            state.fit_kind, state.fit_sizes = valve.kind, model.sizes_to_fit(state.current)
        self.scene.renew_wall()
        self._show_landmarks()

    def _show_landmarks(self) -> None:
        """Draws the landmarks while their panel is unfolded."""
        is_unfolded = "patient" in self.state.panels
        self.scene.show_landmarks(self.model.landmarks.points if is_unfolded else {}, self.state.landmark)

    # landmarks

    def _on_landmark(self, name: str) -> None:
        """Chooses a landmark. The next click on the wall sets this landmark. A second press releases it."""
        self._need_model()
        with self.state as state:
            is_chosen = state.tool == PLACING and state.landmark == name
            state.landmark, state.tool, state.message = ("", "look", "") if is_chosen else (name, PLACING, "")
        self._show_landmarks()
        self._moved.set()

    def _set_landmark_at(self, point: Any) -> None:
        """Sets the chosen landmark, and chooses the next one that is missing."""
        self._end_drag()
        chosen = self.state.landmark
        name = self.model.set_landmark(chosen, point)
        kind = self._valve().kind
        lacks = missing(kind, self.model.landmarks.points)
        role = role_of(name, kind)
        with self.state as state:
            if role is not None and role.is_list and chosen == role.name:
                state.landmark = chosen  # more of the list follow, until another landmark is chosen
            elif lacks:
                following = role_of(lacks[0], kind)
                state.landmark = following.name if following is not None and following.is_list else lacks[0]
            else:
                state.landmark, state.tool = "", "look"
            state.message = ""
        self._renew_all()

    def _on_set_landmark(self, name: str, value: str) -> None:
        """Sets a landmark to typed coordinates, or removes it if they are empty."""
        self._begin_change()
        numbers = [reading.number_of(part, name) for part in str(value).replace(",", " ").split()]
        if numbers:
            self.model.set_landmark(name, numbers)
        else:
            self.model.remove_landmark(name)
        self._renew_all()

    def _on_remove_landmark(self, name: str) -> None:
        self._begin_change()
        if name:
            self.model.remove_landmark(name)
        else:
            self.model.clear_landmarks()
        self._renew_all()

    def _read_landmarks(self, path: str) -> None:
        self._begin_change()
        with self.model.one_step():
            kind = self.model.read_landmarks(path)
            if kind and self._valve().surface is None:
                self.model.change_kind(self.state.current, kind)
        self._renew_all()

    def _changed_axes(self) -> None:
        if self.model is not None and self.state.axes not in (None, self.model.landmarks.axes):
            self._begin_change()
            self.model.set_axes(self.state.axes)
            self._renew_all()

    def _changed_unit(self) -> None:
        if self.model is not None and self.state.unit not in (None, self.model.unit):
            self._begin_change()
            self.model.set_unit(self.state.unit)
            self._refresh()
            self._look("oblique")
            self._renew_all()

    # placing and fitting

    def _on_place_landmarks(self) -> None:
        self._begin_change()
        try:
            self.model.place_by_landmarks(self.state.current, warp=self.state.warp)
        except Error as error:
            raise reading.Refusal(_said_for_the_page(str(error))) from error
        self._refresh()
        self._look("oblique")
        self._renew_all()

    def _on_fit(self, path: str) -> None:
        self._need_model()
        self._need_idle()
        path = str(path).strip()
        if not path:
            raise reading.Refusal("write the path of the points of the segmented leaflets first")
        points = reading.read_points(str(self.folder / os.path.expanduser(path)))
        if not self.state.fit_sizes:
            raise reading.Refusal("choose a size to fit first")
        work = self.model.fit_of(self.state.current, points, free=list(self.state.fit_sizes), whole=bool(self.state.fit_whole))
        self._begin_task(self._fit(work, self.state.current, self._valve()))

    async def _fit(self, work: Any, i: int, valve: Any) -> None:
        """Fits on a thread. The valve gets the result, if it has not changed in the meantime."""
        with self._alone("a fit is running"):
            try:
                with self.state as state:
                    state.progress, state.progress_text = -1, "Fitting"
                found = await asyncio.get_running_loop().run_in_executor(None, functools.partial(work))
            finally:
                with self.state as state:
                    state.progress = None
        if i >= len(self.model.valves) or self.model.valves[i] != valve:
            raise reading.Refusal("the valve was changed while the fit ran, so its result is not taken; press Fit again")
        self._begin_change()
        self.model.take_fit(i, found)
        self._refresh()
        self._renew_all()
        for doubt in found.doubts:
            self._say(f"the fit is in doubt: {doubt}", "warning")

    def _on_report(self) -> None:
        """Shows the whole report of the last placing or fit."""
        self._need_model()
        found = self._valve().found
        if found is None:
            raise reading.Refusal("there is no report: the valve was changed after it was placed")
        self._text_name = "report"
        with self.state as state:
            state.text, state.text_title, state.text_shown = found.report(), "Report", True

    # the skirt

    def _on_skirt(self, is_on: Any, value: Any = None) -> None:
        """Gives the valve a skirt to the wall, or removes the skirt. Without a length, the skirt is long enough at all
        openings."""
        self._begin_change()
        if not is_on:
            self.model.set_skirt(self.state.current, 0.0)
        elif value is not None and str(value).strip():
            self.model.set_skirt(self.state.current, reading.number_of(value, "skirt"))
        else:
            self._need_wall()
            widest = self.model.wall.widest(self._valve())
            if widest.is_missed:
                raise reading.Refusal("a part of the attachment has no wall beside it: place the valve in the wall first")
            self.model.set_skirt(self.state.current, rounded_up(1.05 * max(widest.gap, self._valve().half_thickness)))
        self._renew_all()

    def _need_wall(self) -> None:
        """Uses the boundary of the mesh as the wall if there is no other wall."""
        if self.model.wall is None:
            self.model.set_wall(reading.read_wall(self.state.path))


def _said_for_the_page(text: str) -> str:
    """Returns a refusal of riis.place in the words of the page."""
    if "flow" in text and "flow_from" not in text:
        text += "; on this page the landmarks flow_from and flow_to give the direction of the flow"
    return text
