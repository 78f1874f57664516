# SPDX-License-Identifier: Apache-2.0
"""The heartbeat of riis view: its cycle, its curves, and its playback."""

from __future__ import annotations

import asyncio
import math
import os
import time
from typing import Any

from riis._plot import COLOURS
from riis.view import reading, rows
from riis.view._part import Part
from riis.view.model import CYCLES

ALONE = 4.0  # seconds without a browser after which a heartbeat pauses


class Heartbeat(Part):
    """The part of a Page that plays the heartbeat."""

    _end_drag: Any
    _begin_change: Any

    # the heartbeat

    def _show_curves(self) -> None:
        """Draws a heartbeat's curves. A valve without a cycle has none."""
        i, model = self.state.current, self.model
        begin, end = model.span
        with self.state as state:
            state.curves = []
            if end > begin:
                state.begin, state.end = begin, end
            if model.period(i) <= 0.0:
                return
            state.period = float(model.period(i))
            cycle = model.valves[i].cycle
            state.cycle = cycle.source if cycle is not None else ""
            curve = model.curve(41, i)
            state.curve_begin = float(curve["time"][0])
            times, unit = curve["time"], f"{model.unit}²" if model.unit else "square units"
            state.curves = [
                rows.line_of("Opening, from 0 to 1", times, curve["opening"], COLOURS[0], top=1.0),
                rows.line_of("Orifice area", times, curve["orifice"], COLOURS[1], unit),
                rows.line_of("Marked nodes", times, curve["marked"], COLOURS[2], "nodes"),
            ]

    def _on_cycle(self, cycle: str | None, period: Any) -> None:
        self._begin_change()
        seconds = reading.number_of(self.state.period if period is None else period, "period")
        name = str(cycle or "").strip()
        if name and name not in CYCLES:
            name = str(self.folder / os.path.expanduser(name))
        self.model.beat(seconds, chosen=name or None, valve=self.state.current)
        with self.state as state:
            state.time = self.model.span[0]
        self._renew_all()

    def _need_cycle(self) -> None:
        if not any(self.model.period(k) > 0.0 for k in range(len(self.model.valves))):
            self._on_cycle(None, None)

    def _changed_time(self) -> None:
        if self.model is None or self.state.playing or math.isclose(float(self.state.time), self.model.time, abs_tol=1e-12):
            return
        self._need_model()
        seconds = float(self.state.time)
        self._need_cycle()  # a new cycle begins at its first time
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
        last = time.monotonic()
        while True:
            await asyncio.sleep(0.02)
            now = time.monotonic()
            if self._alone_since is not None and now - self._alone_since > ALONE:
                break
            if self._moved.is_set() or not self._seen.is_set():
                continue  # the last picture is still on its way
            begin, end = self.model.span
            if not end > begin:  # the valve that moved is gone
                break
            seconds = begin + (self.model.time - begin + (now - last) * float(self.state.speed)) % (end - begin)
            last = now
            self._told(self._at)(seconds)
        self._playing = None
        with self.state as state:
            state.playing = False
