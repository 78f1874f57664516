# SPDX-License-Identifier: Apache-2.0
"""Runs examples/python/tutorial.ipynb in a folder. The folder then contains its pictures, its movie, and tutorial.html with
all outputs."""

import json
import pathlib
import sys

import nbclient
import nbconvert
import nbformat

NOTEBOOK = pathlib.Path(__file__).resolve().parents[2] / "examples/python/tutorial.ipynb"
FILES = "valve.png marks.png cells.png resistance.png beating.gif beat.png fit.png fitted.json".split()


def main(folder):
    folder = pathlib.Path(folder)
    folder.mkdir(parents=True, exist_ok=True)
    for name in FILES:
        (folder / name).unlink(missing_ok=True)
    notebook = nbformat.read(NOTEBOOK, as_version=4)
    nbclient.NotebookClient(notebook, timeout=1200, resources={"metadata": {"path": str(folder)}}).execute()
    for cell in notebook.cells:
        for output in cell.get("outputs", []):
            gif = output.get("data", {}).get("image/gif")
            if gif:  # nbconvert does not put movies into its page
                output.data["text/html"] = f'<img width="600" src="data:image/gif;base64,{gif}">'
    page, _ = nbconvert.HTMLExporter().from_notebook_node(notebook)
    (folder / "tutorial.html").write_text(page, encoding="utf-8")
    missing = [name for name in FILES if not (folder / name).is_file() or (folder / name).stat().st_size < 100]
    if missing:
        print(f"the notebook has not made {', '.join(missing)}", file=sys.stderr)
        return 1
    opening = json.loads((folder / "fitted.json").read_text(encoding="utf-8"))["opening"]
    if abs(opening - 0.25) > 0.03:
        print(f"the fit has found the opening {opening}, and the hidden valve has 0.25", file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1]))
