# SPDX-License-Identifier: Apache-2.0
"""Runs the notebooks of examples/python in a folder. The folder then contains their pictures, the movie, and a page with all
outputs of each notebook."""

import json
import os
import pathlib
import sys

import nbclient
import nbconvert
import nbformat

NOTEBOOKS = pathlib.Path(__file__).resolve().parents[2] / "examples/python"
FILES = {
    "tutorial": "valve.png marks.png cells.png resistance.png beating.gif beat.png fit.png fitted.json".split(),
    "inverse": "inverse.png inverse.json".split(),
}


def run(name, folder):
    """Runs a notebook, and writes its page. Returns the names of the files that the notebook should have made but has not."""
    for file in FILES[name]:
        (folder / file).unlink(missing_ok=True)
    notebook = nbformat.read(NOTEBOOKS / f"{name}.ipynb", as_version=4)
    nbclient.NotebookClient(notebook, timeout=1200, resources={"metadata": {"path": str(folder)}}).execute()
    for cell in notebook.cells:
        for output in cell.get("outputs", []):
            gif = output.get("data", {}).get("image/gif")
            if gif:  # nbconvert does not put movies into its page
                output.data["text/html"] = f'<img width="600" src="data:image/gif;base64,{gif}">'
    page, _ = nbconvert.HTMLExporter().from_notebook_node(notebook)
    (folder / f"{name}.html").write_text(page, encoding="utf-8")
    return [file for file in FILES[name] if not (folder / file).is_file() or (folder / file).stat().st_size < 100]


def main(folder, names):
    folder = pathlib.Path(folder)
    folder.mkdir(parents=True, exist_ok=True)
    # inverse.ipynb imports inverse.py, which is in the same folder.
    os.environ["PYTHONPATH"] = os.pathsep.join([str(NOTEBOOKS), *filter(None, [os.environ.get("PYTHONPATH")])])
    for name in names:
        missing = run(name, folder)
        if missing:
            print(f"{name}.ipynb has not made {', '.join(missing)}", file=sys.stderr)
            return 1
    if "tutorial" in names:
        opening = json.loads((folder / "fitted.json").read_text(encoding="utf-8"))["opening"]
        if abs(opening - 0.25) > 0.03:
            print(f"the fit has found the opening {opening}, and the hidden valve has 0.25", file=sys.stderr)
            return 1
    if "inverse" in names:
        found = json.loads((folder / "inverse.json").read_text(encoding="utf-8"))
        for name, true, value, error in zip(("opening", "shift"), found["truth"], found["found"], found["errors"]):
            if not abs(value - true) <= 3.0 * error <= 0.1:
                print(f"the {name} is {true}, and the flow gave {value} with the standard error {error}", file=sys.stderr)
                return 1
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1], sys.argv[2:] or list(FILES)))
