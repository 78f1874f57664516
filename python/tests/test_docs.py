# SPDX-License-Identifier: Apache-2.0
"""The programs of docs/python.md run as they stand there, and README has the first."""

import pathlib
import re

import numpy

import riis

ROOT = pathlib.Path(__file__).resolve().parents[2]


def test_the_programs_of_the_document_run(xyz):
    text = (ROOT / "docs/python.md").read_text(encoding="utf-8")
    programs = re.findall(r"```python\n(.*?)```", text, re.DOTALL)
    assert len(programs) == 3  # test_fit.py does what the third does
    assert programs[0] in (ROOT / "README.md").read_text(encoding="utf-8")
    names = {"xyz": xyz, "n_steps": 6, "dt": 0.125}
    exec(programs[0], names)
    marks = riis.mark(names["surface"], riis.Mesh(xyz))
    assert numpy.array_equal(names["marks"].ids, marks.ids) and numpy.count_nonzero(names["K"]) > 100
    exec(programs[1], names)
    # The last step goes from 0.625 s to 0.75 s, when the valve is open and at rest.
    assert names["valve"]["opening"] == 1.0 and not names["K_u"].any() and names["K"].any()
