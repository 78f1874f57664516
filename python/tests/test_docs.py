# SPDX-License-Identifier: Apache-2.0
"""The programs of README and of docs run as they stand, and the notebooks are consistent. tests/docs/snippets.txt lists the
programs that cannot run here."""

import ast
import importlib.util
import json
import pathlib
import re
import sys
import textwrap

import numpy
import pytest

import riis
import tube
from riis import _riis

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tests/docs"))
import snippets  # noqa: E402


def landmarks_of_a_root(folder):
    (folder / "root.mrk.json").write_text(snippets.landmarks(), encoding="utf-8")


def a_mesh(folder):
    """Writes mesh.vtu: a box of hexahedra round a valve."""
    import pyvista
    n = 20
    pyvista.ImageData(dimensions=(n, n, n), spacing=3 * (4.0 / (n - 1),), origin=(-2.0, -2.0, -1.5)).cast_to_unstructured_grid() \
        .save(folder / "mesh.vtu")


def landmarks_and_a_tube(folder):
    """Writes landmarks, and mesh.vtu: an oblique tube of tetrahedra in mm, far from the origin."""
    landmarks_of_a_root(folder)
    if importlib.util.find_spec("pyvista"):
        import pyvista
        points, cells = tube.mesh(14, 14.0, 80.0)
        across = numpy.array([[2.0, 2.0, 1.0], [1.0, -2.0, 2.0], [2.0, -1.0, -2.0]]).T / 3.0
        points = points @ across.T + numpy.array(TUBE["middle"])
        pyvista.UnstructuredGrid({pyvista.CellType.TETRA: cells}, points).save(folder / "mesh.vtu")


TUBE = {"middle": (-33.0, 197.0, -68.0), "axis": numpy.array([2.0, -1.0, -2.0]) / 3.0}


# What a document expects of its reader.
GIVEN = {"docs/python.md": landmarks_and_a_tube, "docs/view.md": a_mesh}
SNIPPETS = [one for one in snippets.snippets() if one.language == "python"]


def runnable(document):
    """Returns the programs of a document that can run here, in the order of the document."""
    programs = []
    for one in SNIPPETS:
        modules = one.condition.partition("modules: ")[2].split()
        if one.document == document and snippets.is_run(one.condition) and \
                all(importlib.util.find_spec(name) for name in modules):
            programs.append(one)
    return programs


@pytest.mark.parametrize("document", sorted({one.document for one in SNIPPETS if snippets.is_run(one.condition)}))
def test_the_programs_of_a_document_run_as_they_stand(document, tmp_path, monkeypatch, capsys):
    programs = runnable(document)
    if not programs:
        pytest.skip("modules are missing")
    monkeypatch.chdir(tmp_path)
    GIVEN.get(document, lambda folder: None)(tmp_path)
    names = {}
    for program in programs:
        exec(compile(program.text, f"{document}:{program.line}", "exec"), names)
        CHECKS.get((document, program.text.split("\n", 1)[0]), lambda names: None)(names)


def check_whole(names):
    """Checks the two programs that begin in this way: the first of a document, and that of a fit."""
    check_fit(names) if "found" in names else check_marks(names)


def check_marks(names):
    marks = riis.mark(names["surface"], riis.Mesh(names["xyz"]))
    assert numpy.array_equal(names["marks"].ids, marks.ids) and numpy.count_nonzero(names["K"]) > 100


def check_plot(names):
    """Checks the marks and the picture of the program that README begins with."""
    assert len(names["marks"]) == len(riis.mark(names["surface"], riis.Mesh(names["mesh"].xyz))) > 500
    check_across(names, numpy.array([50.0, 0.0, 90.0]), numpy.array([2.0, -1.0, 2.0]) / 3.0)
    check_picture("valve.png")


def check_own_mesh(names):
    check_across(names, numpy.array(TUBE["middle"]), TUBE["axis"])
    assert riis.find_leaks(names["surface"], names["mesh"], names["marks"]).n_edges == 0
    check_picture("my_valve.png")


def check_across(names, middle, axis):
    """Checks that a valve stands across a tube of radius 14 mm at its middle, and touches its wall."""
    vertices = names["surface"].vertices
    assert abs(names["axis"] @ axis) > 0.999 and len(names["marks"]) > 100
    foot = vertices[numpy.abs((vertices - middle) @ axis).argsort()[:20]]
    assert numpy.abs((foot - middle) @ axis).max() < 1.0
    assert 13.9 < numpy.linalg.norm(numpy.cross(vertices - middle, axis), axis=1).max() < 14.4


def check_file_for_paraview(names):
    import pyvista
    read, marks = pyvista.read("marked.vtu"), names["marks"]
    assert numpy.array_equal(numpy.flatnonzero(~numpy.isnan(read["riis_distance"])), marks.ids)
    assert numpy.array_equal(read["riis_K"], names["K"]) and set(numpy.flatnonzero(names["K"])) <= set(marks.ids)


def check_period(names):
    kept = numpy.load("period.npz")
    numbers = kept["numbers"]
    assert len(kept["times"]) == len(numbers) == 41 and numbers.sum() == len(kept["ids"]) == len(kept["K"])
    assert numbers[0] == numbers[-1] and numbers.min() > 100 and len(set(numbers)) > 3 and kept["K"].max() > 0.0
    check_picture("numbers.png")


def check_picture(name):
    """Checks that a picture is neither empty nor of one colour."""
    import pyvista
    pixels = pyvista.read(name).point_data.active_scalars
    assert len(numpy.unique(pixels, axis=0)) > 50


def check_beat(names):
    # The last step goes from 0.625 s to 0.75 s, where the valve is open and at rest.
    assert names["valve"]["opening"] == 1.0 and not names["K_u"].any() and names["K"].any()


def check_slopes(names):
    slopes = names["marks"].K_gradient[:, 0]
    assert len(slopes) == len(names["marks"]) > 100 and slopes.min() < 0.0 < slopes.max()


def check_loads(names):
    assert numpy.allclose(names["loads"].sum(axis=0), names["force"]) and names["force"].all() and names["moment"].any()
    assert numpy.allclose(names["at_vertices"].sum(axis=0), names["force"])
    assert names["n_pieces"].min() >= 1 and names["quality"].is_planar  # as the annulus is


def check_place(names):
    assert names["found"].rms < 0.5 and names["read"].valve["root_radius"] == names["found"].valve["root_radius"]


def check_fit(names):
    found = names["found"]
    assert found.doubts == () and abs(found.parameters["opening"] - 0.2) < 0.02 and "--scale 10 " in names["options"]


def check_aside(names):
    heights, areas = names["marks"].height, names["areas"]
    assert heights.min() < 0.0 and 0.1 < heights.max() <= 0.175
    assert numpy.allclose(names["found"].reached[1:3], areas[1:3], rtol=1e-6) and 0.4 < names["cycle"](0.2) < 1.0


def check_view(names):
    assert len(names["model"].update().marked) > 0


OWN_MESH = 'grid = pyvista.read("mesh.vtu")                        # the cells of the flow; .msh needs meshio'
# A check of what the program made, by the document and the program's first line.
CHECKS = {(document, first): check for document, first, check in (
    ("README.md", "import numpy, pyvista, riis", check_plot),
    ("docs/python.md", "import numpy, pyvista, riis", check_plot),
    ("docs/python.md", OWN_MESH, check_own_mesh),
    ("docs/python.md", "K = numpy.zeros(len(mesh))", check_file_for_paraview),
    ("docs/python.md", "import matplotlib.pyplot", check_period),
    ("docs/python.md", "import numpy, riis", check_whole),
    ("docs/python.md", "law, n_steps, dt = riis.OpeningTimes(0.45, 0.05, 0.95, 0.05, period=1.0), 6, 0.125", check_beat),
    ("docs/python.md", "aside = riis.Surface(valve, half_thickness=0.1, offset=0.75)", check_aside),
    ("docs/python.md", "def changed(by):", check_slopes),
    ("docs/python.md", "surface.update(valve)", check_loads),
    ("docs/python.md", "import riis", check_place),
    ("docs/view.md", "import pyvista", check_view))}


def test_every_check_belongs_to_a_program():
    programs = {(one.document, one.text.split("\n", 1)[0]) for one in SNIPPETS}
    assert set(CHECKS) <= programs and {document for document, _ in programs} >= set(GIVEN)


def test_the_landmarks_of_formats_give_a_valve_that_closes(tmp_path):
    text = (ROOT / "docs/formats.md").read_text(encoding="utf-8")
    (tmp_path / "root.json").write_text(re.search(r"```json\n(\{\"valve\".*?)```", text, re.DOTALL)[1])
    found = riis.place(tmp_path / "root.json")
    orifice = riis.Surface(found.valve, **found.placement).orifice()
    assert found.valve.kind == "coapting" and found.rms < 1.0 and orifice.area < 0.02 * orifice.outline_area


def test_the_table_of_units_is_that_of_the_program():
    text = (ROOT / "docs/python.md").read_text(encoding="utf-8")
    for unit, (scale, _) in _riis.units().items():
        factor, of_R, of_K = _riis.resistance_units(unit)
        R = f"{1e4 * factor:.0e}".replace("+0", "")
        assert f"\n| {unit} | {scale:g} | {R} {of_R} | {of_K} |\n" in text


def test_the_first_program_is_in_all_texts():
    first = {one.document: one.text for one in reversed(SNIPPETS)}
    assert first["README.md"] == first["docs/python.md"]
    text = re.search(r"\n\n((?:    .*\n|\n)+)", riis.__doc__)
    names = {}
    exec(textwrap.dedent(text[1]), names)
    check_marks(names)


@pytest.mark.parametrize("name, n_least, used", [("tutorial", 10, {"Mesh", "mark", "animate", "fit"}), ("inverse", 4, set())])
def test_notebooks_are_committed_without_outputs(name, n_least, used):
    """A notebook is committed without outputs, because nobody would check them. ./run python runs the notebook."""
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
