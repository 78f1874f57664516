# SPDX-License-Identifier: Apache-2.0
"""check_types.py FOLDER: checks the stubs of the installed package on every Python example, with mypy and with pyright.

The programs are from docs/python.md, the notebook, the example for dolfinx, and typed.py. FOLDER gets the programs of the
document and of the notebook as files. typed.py is strict in all respects. The examples have no annotations, so that they read
well. All other rules of mypy --strict hold for them, and the bodies of their functions are checked. Packages for pictures count
as anything, and so do packages without types, such as dolfinx. The plug-in for ParaView is left out, because it passes options
that ParaView collects at run time.
"""

import json
import pathlib
import re
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]


def programs_of_the_document():
    """Returns the programs by name. The first four programs belong together, and so do the next seven. All other programs stand
    alone."""
    blocks = re.findall(r"```python\n(.*?)```", (ROOT / "docs/python.md").read_text(encoding="utf-8"), re.DOTALL)
    if len(blocks) != 13:
        raise SystemExit(f"check_types.py: docs/python.md has {len(blocks)} programs, not 13")
    plot, n = re.subn(r"^import (?:(numpy, )?pyvista, riis|matplotlib.pyplot)$", "", "\n".join(blocks[:4]), flags=re.MULTILINE)
    if n != 2:
        raise SystemExit("check_types.py: the first programs of docs/python.md import other packages for pictures")
    head = "from typing import Any\n\nimport numpy\nimport riis\n\npyvista: Any = None\nmatplotlib: Any = None\n"
    return {"document_plot.py": head + plot, "document_marks.py": "\n".join(blocks[4:11]), "document_place.py": blocks[11],
            "document_fit.py": blocks[12]}


def program_of_the_notebook():
    notebook = json.loads((ROOT / "examples/python/tutorial.ipynb").read_text(encoding="utf-8"))
    text = "\n\n".join("".join(cell["source"]) for cell in notebook["cells"] if cell["cell_type"] == "code") + "\n"
    text, n = re.subn(r"^(?:import (pyvista)|import matplotlib.pyplot as (plt)|from IPython.display import (Image))$",
                      lambda found: f"{found[1] or found[2] or found[3]}: Any = None", text, flags=re.MULTILINE)
    if n != 3:
        raise SystemExit("check_types.py: the notebook imports other packages for pictures")
    return "from typing import Any\n\n" + text


def main(folder):
    folder.mkdir(parents=True, exist_ok=True)
    files = []
    for name, text in programs_of_the_document().items():
        files.append(folder / name)
        files[-1].write_text(text, encoding="utf-8")
    files.append(folder / "notebook.py")
    files[-1].write_text(program_of_the_notebook(), encoding="utf-8")
    files.append(ROOT / "examples/fenicsx/valve_in_duct.py")
    typed = ROOT / "python/tests/typed.py"
    (folder / "pyrightconfig.json").write_text(json.dumps({
        "typeCheckingMode": "standard", "reportMissingImports": False, "reportOptionalMemberAccess": False,
        "reportMissingModuleSource": False, "pythonVersion": f"3.{sys.version_info.minor}"}), encoding="utf-8")
    mypy = [sys.executable, "-m", "mypy", "--strict", "--cache-dir", str(folder / "mypy")]
    unannotated = [f"--disable-error-code={code}" for code in ("no-untyped-def", "no-untyped-call", "misc", "import-not-found",
                                                               "import-untyped", "var-annotated", "union-attr")]
    checks = [[*mypy, typed]] + [[*mypy, *unannotated, file] for file in files]
    checks.append([sys.executable, "-m", "pyright", "--pythonpath", sys.executable, *files, typed])
    failed = 0
    for check in checks:
        print(" ".join(map(str, check[2:])), flush=True)
        failed += subprocess.run(check, cwd=folder, check=False).returncode != 0
    if failed:
        raise SystemExit(f"check_types.py: {failed} of {len(checks)} checks failed")


if __name__ == "__main__":
    if len(sys.argv) != 2:
        raise SystemExit("usage: check_types.py FOLDER")
    main(pathlib.Path(sys.argv[1]).resolve())
