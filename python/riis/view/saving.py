# SPDX-License-Identifier: Apache-2.0
"""The files that the page of riis view writes, for the program, for solvers and for reports."""

from __future__ import annotations

import asyncio
import os
import shlex
from pathlib import Path
from typing import Any

import numpy

import riis
from riis.view import reading
from riis.view._numbers import shown
from riis.view._part import Part
from riis.view.scene import LEAST_SIDE, MOST_SIDE

TEXTS = {"placed": "Placed valve", "command": "Command", "case": "Case file", "python": "Python", "openfoam": "OpenFOAM"}
_TEXT_ENDINGS = {
    "placed": ".placed.json", "case": ".case.json", "command": ".sh", "python": ".py", "openfoam": ".foam.txt", "report": ".txt",
}  # fmt: skip
WRITES = {"view": "This view", "landmarks": "Landmarks", "mesh": "Marked mesh", "picture": "Picture", "movie": "Movie"}
_WRITE_ENDINGS = {"view": ".view.json", "landmarks": ".mrk.json", "mesh": ".vtu", "picture": ".png", "movie": ".mp4"}
FILMING = "a movie is being written"
_NO_FILMS = "a movie needs imageio and imageio-ffmpeg: pip install imageio imageio-ffmpeg"

# Errors that a person's input causes. The message of such an error goes to the page. All other exceptions are faults of the page
# itself.
REFUSALS = (riis.Error, OSError, ImportError, reading.Refusal)


def text_of(error: BaseException) -> str:
    return str(error) or type(error).__name__


class Files(Part):
    """The part of a Page that writes files."""

    _need_cycle: Any
    _pause: Any
    _as_saved: Any

    def _on_text(self, name: str) -> None:
        self._need_model()
        text = self._text(name)
        self._text_name = name
        with self.state as state:
            state.text, state.text_title, state.text_shown = text, TEXTS[name], True

    def _text(self, name: str) -> str:
        if name == "report":
            return str(self.state.text)
        if name not in TEXTS:
            raise reading.Refusal(f"text: '{name}' is not one of {', '.join(TEXTS)}")
        if name == "placed":
            return str(self.model.placed_file(self.state.current))
        if name == "case" and any(self.model.period(k) > 0.0 for k in range(len(self.model.valves))):
            return str(self.model.case(numpy.linspace(*self.model.span, 51)))
        if name == "command":
            base = str(self.folder / self._name())
            names = {"case": base + ".now.case.json", "warp": base + ".warp.json"}  # the page may have written another case
            words = shlex.split(self.model.command(output=base + ".vtu", **names))
            before = "".join(
                f"cat >{shlex.quote(path)} <<'END'\n{text}END\n" for path, text in self.model.command_files(**names).items()
            )
            lines = [shlex.join(words[:2])]
            for word in words[2:]:
                if lines[-1].startswith("--") and not word.startswith("--") and "=" not in lines[-1]:
                    lines[-1] += " " + shlex.quote(word)
                else:
                    lines.append(shlex.quote(word))
            return before + " \\\n  ".join(lines) + "\n"
        return str(getattr(self.model, name)())

    def _on_write_text(self) -> None:
        self._need_model()
        path = self._path(_TEXT_ENDINGS[self._text_name])
        path.write_text(self._text(self._text_name), encoding="utf-8")
        self._wrote(path)

    def _name(self) -> str:
        name = str(self.state.file_name).strip()
        if not name or name in (".", "..") or "/" in name or "\0" in name:
            raise reading.Refusal(f"file name: '{name}' must be a name without a folder")
        return name

    def _path(self, ending: str) -> Path:
        path = self.folder / (self._name() + ending)
        if path.exists() and not self.state.replace and path not in self._written:
            raise reading.Refusal(f"{path} exists: tick 'Replace files that exist', or take another name")
        return path

    def _wrote(self, path: Path) -> None:
        self._written.add(path)
        self._say(f"wrote {path}", "success")

    def _on_write(self, name: str) -> None:
        self._need_model()
        if name not in WRITES:
            raise reading.Refusal(f"file: '{name}' is not one of {', '.join(WRITES)}")
        ending = _WRITE_ENDINGS[name]
        if name == "landmarks" and self.model.landmarks.axes not in ("LPS", "RAS"):
            ending = ".landmarks.json"  # 3D Slicer's files have no other axes
        path = self._path(ending)
        if name == "movie":
            self._need_idle()
            self._begin_task(self._movie(path))
            return
        if name == "view":
            self.model.save(str(path), self._as_saved())
        elif name == "landmarks":
            self.model.save_landmarks(path, self.state.current)
        elif name == "mesh":
            if self._grid is None:
                raise reading.Refusal("there is no mesh that could have marks, only a wall; open a mesh first")
            reading.write_marked(self._grid, self.model, str(path))
        else:
            self.scene.save_picture(str(path), self._picture_size())
            self._moved.set()
        self._wrote(path)

    def _picture_size(self) -> tuple[int, int]:
        sides = []
        for name in ("width", "height"):
            side = reading.number_of(self.state[f"picture_{name}"], f"{name} of the picture")
            if not (LEAST_SIDE <= side <= MOST_SIDE and side == int(side)):
                raise reading.Refusal(
                    f"{name} of the picture: is {shown(side, 6)}; it must be a whole number of pixels from {LEAST_SIDE} to "
                    f"{MOST_SIDE}"
                )
            sides.append(int(side))
        return sides[0], sides[1]

    async def _movie(self, path: Path, n_frames: int = 48) -> None:
        """Writes one heartbeat as a movie. Browsers see its progress. If a movie fails, an older file stays as it is."""
        try:
            import imageio
        except ImportError:
            raise ImportError(_NO_FILMS) from None
        self._pause()
        self._need_cycle()
        part = path.with_name(f".{path.stem}.part{path.suffix}")
        with self._alone(FILMING):
            size = self.scene.size
            try:
                self.scene.resize(*(length // 16 * 16 for length in size))  # as .mp4 needs
                with self.scene.for_a_report(), self.model.kept(), imageio.get_writer(str(part), fps=24) as writer:
                    begin, end = self.model.span
                    for k in range(n_frames):
                        self.model.at(begin + k / n_frames * (end - begin))
                        self._refresh()
                        self._show_orifice()
                        self.scene.rest()
                        self.scene.hide_helpers()
                        writer.append_data(numpy.asarray(self.scene.plotter.screenshot(return_img=True)))
                        with self.state as state:
                            state.progress, state.progress_text = round(100 * (k + 1) / n_frames), "Writing the movie"
                        await asyncio.sleep(0)
                os.replace(part, path)
            except ImportError:
                raise ImportError(_NO_FILMS) from None
            finally:
                part.unlink(missing_ok=True)
                self.scene.resize(*(self._wanted_size or size))
                self._wanted_size = None
                with self.state as state:
                    state.progress, state.time = None, float(self.model.time)
                self._touch()
        self._wrote(path)
