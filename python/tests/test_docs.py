# SPDX-License-Identifier: Apache-2.0
"""The programs in docs/python.md run unchanged, README contains the first of them, and the notebooks are consistent."""

import ast
import json
import pathlib
import re

import numpy
import pytest

import riis

ROOT = pathlib.Path(__file__).resolve().parents[2]


def test_the_programs_of_the_document_run(xyz):
    text = (ROOT / "docs/python.md").read_text(encoding="utf-8")
    programs = re.findall(r"```python\n(.*?)```", text, re.DOTALL)
    assert len(programs) == 7  # test_plot.py, test_place.py and test_fit.py cover the last three programs
    assert programs[0] in (ROOT / "README.md").read_text(encoding="utf-8")
    names = {"xyz": xyz, "n_steps": 6, "dt": 0.125}
    exec(programs[0], names)
    marks = riis.mark(names["surface"], riis.Mesh(xyz))
    assert numpy.array_equal(names["marks"].ids, marks.ids) and numpy.count_nonzero(names["K"]) > 100
    exec(programs[1], names)
    # The last step goes from 0.625 s to 0.75 s, where the valve is open and at rest.
    assert names["valve"]["opening"] == 1.0 and not names["K_u"].any() and names["K"].any()
    exec(programs[2], names)
    slopes = names["marks"].K_gradient[:, 0]
    assert len(slopes) == len(names["marks"]) > 100 and slopes.min() < 0.0 < slopes.max()
    exec(programs[3], names)
    assert numpy.allclose(names["loads"].sum(axis=0), names["force"]) and names["force"].all() and names["moment"].any()
    assert names["n_pieces"].min() >= 1 and not names["quality"].is_planar


@pytest.mark.parametrize("name, n_least, used", [("tutorial", 10, {"Mesh", "mark", "animate", "fit"}), ("inverse", 4, set())])
def test_notebooks_are_committed_without_outputs(name, n_least, used):
    """A notebook is committed without outputs, because nobody would check them. ./run python runs it."""
    notebook = json.loads((ROOT / f"examples/python/{name}.ipynb").read_text(encoding="utf-8"))
    assert notebook["cells"][0]["source"][0].startswith("<!-- SPDX-License-Identifier: Apache-2.0 -->")
    cells = [cell for cell in notebook["cells"] if cell["cell_type"] == "code"]
    assert len(cells) > n_least
    names = set()
    for cell in cells:
        assert cell["outputs"] == [] and cell["execution_count"] is None
        for node in ast.walk(ast.parse("".join(cell["source"]))):
            if isinstance(node, ast.Attribute) and isinstance(node.value, ast.Name) and node.value.id == "riis":
                names.add(node.attr)
    assert used <= names and all(hasattr(riis, name) for name in names)
