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
from riis.view._part import Part

TEXTS = {"case": "Case file", "command": "Command", "python": "Python", "openfoam": "OpenFOAM"}
_TEXT_ENDINGS = {"case": ".case.json", "command": ".sh", "python": ".py", "openfoam": ".foam.txt"}
WRITES = {"view": "This view", "mesh": "Marked mesh", "picture": "Picture", "movie": "Movie"}
_WRITE_ENDINGS = {"view": ".view.json", "mesh": ".vtu", "picture": ".png", "movie": ".mp4"}
FILMING = "a movie is being written"
_NO_FILMS = "a movie needs imageio and imageio-ffmpeg: pip install imageio imageio-ffmpeg"

# Errors that a person's input causes. Their message goes to the page. Other exceptions are faults of the page itself.
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
        if name not in TEXTS:
            raise reading.Refusal(f"text: '{name}' is not one of {', '.join(TEXTS)}")
        if name == "case" and any(self.model.period(k) > 0.0 for k in range(len(self.model.valves))):
            return str(self.model.case(numpy.linspace(*self.model.span, 51)))
        if name == "command":
            base = str(self.folder / self._name())
            case, before = base + ".now.case.json", ""
            words = shlex.split(self.model.command(case=case, output=base + ".vtu"))
            if len(self.model.valves) > 1:  # the page may have written a case file of a heartbeat
                before = f"cat >{shlex.quote(case)} <<'END'\n{self.model.case()}END\n"
            lines = [shlex.join(words[: words.index("mark") + 1])]
            for word in words[words.index("mark") + 1 :]:
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
        path = self._path(_WRITE_ENDINGS[name])
        if name == "movie":
            self._need_idle()
            self._begin_task(self._movie(path))
            return
        if name == "view":
            self.model.save(str(path), self._as_saved())
        elif name == "mesh":
            reading.write_marked(self._grid, self.model, str(path))
        else:
            self.scene.sharpen()
            self.scene.plotter.screenshot(str(path))
        self._wrote(path)

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
                self.scene.sharpen()
                with self.model.kept(), imageio.get_writer(str(part), fps=24) as writer:
                    begin, end = self.model.span
                    for k in range(n_frames):
                        self.model.at(begin + k / n_frames * (end - begin))
                        self._refresh()
                        self._show_orifice()
                        self.scene.rest()
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
