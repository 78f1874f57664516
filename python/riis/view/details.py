# SPDX-License-Identifier: Apache-2.0
"""The part of the page of riis view for single leaflets, commissures and bumps."""

from __future__ import annotations

import re
from typing import Any

from riis.view import rows
from riis.view._bumps import Bump
from riis.view._part import Part
from riis.view._valves import n_leaflets

N_DETAILS = (4, 5)  # the numbers of sliders for a size of all leaflets, and for a bump


def sizes_of(parameters: Any) -> dict[str, list[Any]]:
    """Returns the sizes that several leaflets or commissures have, by names such as "cusp sector"."""
    sizes: dict[str, list[Any]] = {}
    for parameter in parameters:
        if parameter.part and not parameter.part.startswith("bump_") and parameter.n_values == 1:
            numbered = re.fullmatch("(.*_)[0-9]+", parameter.part)
            name = (numbered[1] if numbered else "") + parameter.size
            sizes.setdefault(name.replace("_", " "), []).append(parameter)
    return sizes


def places_of(kind: str) -> list[dict[str, str]]:
    """Returns the places of bumps, as the choices of a list."""
    n = n_leaflets(kind)
    names = [rows.leaflet_name(kind, leaflet) for leaflet in range(n)]
    leaflets = [{"value": f"leaflet {k}", "title": names[k]} for k in range(n)]
    between = [{"value": f"commissure {k}", "title": f"between {names[k]} and {names[(k + 1) % n]}"} for k in range(n)]
    return leaflets + between


def _choice(bump: Bump) -> str:
    """Returns the choice of the list for the place of a bump."""
    return f"leaflet {bump.leaflet}" if bump.leaflet >= 0 else f"commissure {bump.commissure}"


class Details(Part):
    """The part of a Page that shows and changes one size of all leaflets, and one bump."""

    def _details(self) -> list[dict[str, Any] | None]:
        """Sets the choices of both panels to the model's values. Returns the sliders of both, None for slots without one."""
        valve, state = self._valve(), self.state
        if valve.surface is not None:
            state.sizes, state.bumps, state.bump, state.most_bumps = [], [], -1, 0
            return [None] * sum(N_DETAILS)
        values = self.model.values(state.current)
        parameters = self.model.parameters(valve.kind)

        def slider(parameter: Any, label: str) -> dict[str, Any]:
            value, is_set = float(values[parameter.name]), parameter.name in valve.parameters
            return rows.slider_of(parameter, value, is_set, valve.scale, self.model.unit or "", label)

        sizes = sizes_of(parameters)
        state.sizes = list(sizes)
        if state.size not in sizes:
            state.size = "cusp sector" if "cusp sector" in sizes else next(iter(sizes), "")
        of_size = [slider(parameter, parameter.part.replace("_", " ")) for parameter in sizes.get(state.size, [])]

        bumps = {bump.number: bump for bump in self.model.bumps(state.current)}
        state.most_bumps, state.bump_places = self.model.most_bumps(state.current), places_of(valve.kind)
        titles = {place["value"]: place["title"] for place in state.bump_places}
        state.bumps = [{"number": number, "place": titles[_choice(bump)]} for number, bump in bumps.items()]
        if state.bump not in bumps:
            state.bump = next(iter(bumps), -1)
        of_bump = []
        if state.bump >= 0:
            bump = bumps[state.bump]
            state.bump_place = _choice(bump)
            hidden = {"leaflet", "commissure"} | ({"u"} if bump.leaflet < 0 else set())
            of_bump = [
                slider(parameter, "place on the edge" if parameter.size == "u" else parameter.size) for parameter in parameters
                if parameter.part == f"bump_{bump.number}" and parameter.size not in hidden
            ]  # fmt: skip
        made: list[dict[str, Any] | None] = []
        for shown, n in zip((of_size, of_bump), N_DETAILS):
            made += [*shown, *[None] * (n - len(shown))]
        return made

    def _show_bump(self) -> None:
        """Draws the chosen bump while its panel is unfolded."""
        if self.state.bump < 0 or "bumps" not in self.state.panels:
            self.scene.show_bump([])
            return
        place = self.model.bump_place(self.state.current, self.state.bump)
        self.scene.show_bump(place.lines, place.point)

    def _changed_size(self) -> None:
        self._show_numbers()

    def _changed_bump(self) -> None:
        self._show_numbers()
        self._changed_panels()

    def _changed_panels(self) -> None:
        if self.scene is not None:
            self._touch()

    def _changed_bump_place(self) -> None:
        if self.model is None or self.state.bump < 0:
            return
        now = {bump.number: _choice(bump) for bump in self.model.bumps(self.state.current)}
        if self.state.bump not in now or self.state.bump_place == now[self.state.bump]:
            return
        self._begin_change()
        word, number = self.state.bump_place.split()
        self.model.place_bump(self.state.current, self.state.bump, **{word: int(number)})
        self._renew_all()

    def _on_add_bump(self) -> None:
        self._begin_change()
        self.state.bump = self.model.add_bump(self.state.current)
        self._renew_all()

    def _on_remove_bump(self) -> None:
        self._begin_change()
        self.model.remove_bump(self.state.current, self.state.bump)
        self._renew_all()
