# SPDX-License-Identifier: Apache-2.0
"""The common base of the parts of a Page. Each part is a class with functions of the page. Page itself has the attributes of all
parts."""

from __future__ import annotations

import asyncio
from collections.abc import Callable, Coroutine
from contextlib import ExitStack
from pathlib import Path
from typing import Any


class Part:
    """The attributes and functions of a Page that its parts use."""

    model: Any  #: riis.view.model.Model, or None before the first mesh
    scene: Any  #: riis.view.scene.Scene, or None before the first mesh
    state: Any  #: trame's variables of the page
    folder: Path  #: the folder to which the page writes, and from which relative paths start
    _grid: Any
    _shown: Any
    _busy: str
    _moved: asyncio.Event
    _seen: asyncio.Event
    _seen_at: float
    _alone_since: float | None
    _held: bool
    _drag: tuple[Any, float] | None
    _drag_stack: ExitStack
    _clicks: list[Any]
    _renew_wall: Any
    _playing: asyncio.Task[None] | None
    _written: set[Path]
    _text_name: str
    _slider_values: list[float]  #: as the sliders show them
    _wanted_size: tuple[int, int] | None
    _alone: Any
    _begin_task: Callable[[Coroutine[Any, Any, None]], None]
    _told: Callable[[Callable[..., Any]], Callable[..., Any]]
    _say: Any
    _need_idle: Callable[[], None]
    _need_model: Callable[[], None]
    _begin_change: Callable[[], None]
    _valve: Callable[[], Any]
    _reach: Callable[[], float]
    _refresh: Callable[[], None]
    _renew_all: Callable[[], None]
    _show_numbers: Callable[[], None]
    _show_placement: Callable[[], None]
    _show_orifice: Callable[[], None]
    _touch: Callable[[], None]
