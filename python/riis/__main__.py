# SPDX-License-Identifier: Apache-2.0
"""python -m riis view MESH: a valve in a mesh or in a wall, in a browser (docs/view.md)."""

from __future__ import annotations

import argparse
import os
import sys


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(prog="python -m riis", description="Heart valves in meshes.")
    commands = parser.add_subparsers(dest="command", required=True, metavar="COMMAND")
    view = commands.add_parser(
        "view", help="show a valve in a mesh, in a browser", description="Shows a valve in a mesh, in a browser on this machine."
    )
    view.add_argument("mesh", nargs="?", metavar="MESH", help="a mesh: .vtu, .vtk, .pvtu, .msh, .xdmf; or the page opens one")
    view.add_argument("--wall", metavar="FILE", help="the wall around the valve, such as root.stl, in the mesh's unit and axes")
    view.add_argument("--valve", metavar="FILE.json", help="a placed valve, as riis place --output writes it")
    view.add_argument("--landmarks", metavar="FILE", help="landmarks: .mrk.json or .fcsv of 3D Slicer, .json or .csv")
    view.add_argument("--open", metavar="FILE", dest="saved", help="a saved view; it names its mesh, unless MESH is given")
    view.add_argument("--unit", choices=("mm", "cm", "m"), help="the unit of the mesh; not known unless given")
    view.add_argument(
        "--cells-where", metavar="NAME=VALUES", help="only the cells with such a value of a cell array, such as region=1,2"
    )
    view.add_argument("--folder", default=".", help="where the page writes files; the current folder unless given")
    view.add_argument("--port", type=int, default=0, help="the port on 127.0.0.1; a free one unless given")
    view.add_argument("--no-browser", action="store_true", help="print the address, and open no browser")
    return parser


# The packages of pyproject.toml's extra `view`.
_NEEDED = ("pyvista", "vtk", "trame", "trame-vuetify", "meshio", "imageio", "imageio-ffmpeg")


def _say_missing(error: ImportError) -> int:
    """Says which package is missing, or why an installed package cannot be loaded."""
    is_missing = isinstance(error, ModuleNotFoundError) and error.name
    text = str(error)
    if is_missing:
        text = (f"{error.name} is missing: pip install {' '.join(_NEEDED)}, or in the top folder of the sources pip install "
                "'.[view]'")
    print(f"riis view: {text}", file=sys.stderr)
    return 1


def main(words: list[str] | None = None) -> int:
    """Runs a command. Returns the exit status: 0, 1 if the command failed, 2 for wrong usage."""
    options = _parser().parse_args(words)
    if options.valve is not None and not options.valve.endswith(".json"):
        print(f"riis view: --valve: {options.valve} is not a placed valve, FILE.json; the page has the kinds of valves",
              file=sys.stderr)
        return 2
    if (options.valve or options.landmarks) and not (options.mesh or options.wall or options.saved):
        print("riis view: --valve and --landmarks need MESH or --wall, in which the valve is shown", file=sys.stderr)
        return 2
    if options.saved is not None and (options.wall or options.valve or options.landmarks):
        print("riis view: --open has no effect with --wall, --valve and --landmarks: a saved view has its own", file=sys.stderr)
        return 2
    for path in (options.mesh, options.saved, options.wall, options.valve, options.landmarks):
        if path is not None and not os.path.exists(path):
            print(f"riis view: {path}: there is no such file", file=sys.stderr)
            return 2
    if not os.path.isdir(options.folder):
        print(f"riis view: --folder: {options.folder} is not a folder", file=sys.stderr)
        return 2
    if not 0 <= options.port <= 65535:
        print(f"riis view: --port: is {options.port}; it must be from 0 to 65535", file=sys.stderr)
        return 2
    try:
        from riis.view.page import Page
    except ImportError as error:
        return _say_missing(error)
    try:
        names = ("mesh", "saved", "wall", "valve", "landmarks")
        path, saved, wall, placed, landmarks = (
            None if getattr(options, name) is None else os.path.abspath(getattr(options, name)) for name in names
        )
        page = Page(
            path, saved=saved, unit=options.unit, folder=options.folder, cells_where=options.cells_where, wall=wall,
            placed=placed, landmarks=landmarks,
        )  # fmt: skip
        page.serve(port=options.port, browser=not options.no_browser)
    except (RuntimeError, OSError) as error:
        print(f"riis view: {error}", file=sys.stderr)
        return 1
    except ImportError as error:
        return _say_missing(error)
    return 0


if __name__ == "__main__":
    sys.exit(main())
