# SPDX-License-Identifier: Apache-2.0
"""The view of a patient: walls, placed valves, landmarks, skirts and fits, and the commands that give what is seen."""

import importlib.util
import json
import os
import pathlib
import shlex
import subprocess
from random import Random

import numpy
import pytest
import tube
from test_view_model import light, program_riis, write_mesh

import riis
from riis.view import _landmark_files as landmark_files
from riis.view import model as view
from riis.view._numbers import shown
from riis.view._valves import matrix_of
from riis.view._walls import Wall

ROOT = pathlib.Path(__file__).resolve().parents[2]
SEED = int(os.environ.get("RIIS_TEST_SEED", "62"))


@pytest.fixture
def random():
    print("seed", SEED)
    return numpy.random.default_rng(SEED)


def synthetic_patient():
    path = ROOT / "examples/patient/make_patient.py"
    spec = importlib.util.spec_from_file_location("make_patient", path)
    made = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(made)
    return made


@pytest.fixture(scope="module")
def patient(tmp_path_factory):
    """A folder with the root and the landmarks of docs/patient.md, and a tube of tetrahedra around the root."""
    folder = tmp_path_factory.mktemp("patient")
    make = synthetic_patient()
    make.N_ANGLES, make.SPACING = 60, 1.5  # a coarser wall
    rng, root = Random(1), make.Root()
    make.write_stl(folder / "root.stl", make.wall_triangles(root, make.waves(rng)))
    make.write_landmarks(folder / "landmarks.mrk.json", root, rng, 0.3)
    points, cells = tube.mesh(21, radius=17.0, length=32.0, middle=8.0)
    axes = numpy.array([root.e1, root.e2, root.e3])
    write_mesh(folder / "tube.vtk", points @ axes + root.centre, cells)
    return folder


@pytest.fixture(scope="module")
def wall(patient):
    return wall_of(patient / "root.stl")


def wall_of(path, factor=1.0):
    """Reads a binary STL without VTK, and joins equal points."""
    data = path.read_bytes()
    n = int.from_bytes(data[80:84], "little")
    rows = numpy.frombuffer(data[84 : 84 + 50 * n], numpy.dtype([("v", "<f4", (4, 3)), ("end", "<u2")]))
    points, faces = numpy.unique(rows["v"][:, 1:].reshape(-1, 3), axis=0, return_inverse=True)
    return Wall(factor * points.astype(float), faces.reshape(-1, 3), path)


def mesh_of(path):
    lines = path.read_text().splitlines()
    n = int(lines[4].split()[1])
    points = numpy.array([[float(x) for x in line.split()] for line in lines[5 : 5 + n]])
    m = int(lines[5 + n].split()[1])
    cells = numpy.array([[int(x) for x in line.split()[1:]] for line in lines[6 + n : 6 + n + m]])
    return points, cells


@pytest.fixture(scope="module")
def mesh(patient):
    return mesh_of(patient / "tube.vtk")


def model_of(patient, wall, mesh=(None, None), **options):
    path = None if mesh[0] is None else patient / "tube.vtk"
    return view.Model(*mesh, wall=wall, path=path, **{"unit": "mm", **options})


def landmarks_of(patient):
    lists = json.loads((patient / "landmarks.mrk.json").read_text())["markups"]
    return {point["label"]: tuple(point["position"]) for point in lists[0]["controlPoints"]}


# ---- Numbers ----


def test_numbers_are_written_as_people_write_them(random):
    known = {-1084.2: "-1084", 0.35: "0.35", 1e4: "10000", 0.0012: "0.0012", 12.345: "12.3", 99.96: "100", 0.0: "0", 5.0: "5",
             -0.0: "0", 123456.7: "123457", 3.0e-7: "3e-07", 4e12: "4e+12", -1e-5: "-0.00001", numpy.inf: "inf"}
    assert {value: shown(value) for value in known} == known
    for value in random.choice([-1.0, 1.0], 300) * 10.0 ** random.uniform(-5.9, 8.9, 300):
        text = shown(value)
        assert "e" not in text and abs(float(text) - value) <= 0.00501 * abs(value), text


# ---- Landmarks ----


def test_landmarks_are_set_moved_and_removed_with_undo(patient, wall):
    model = model_of(patient, wall)
    i = model.add("coapting")
    assert model.missing_landmarks(i) == [
        "nadir_right", "nadir_left", "nadir_non_coronary", "commissure_right_left", "commissure_left_non_coronary",
        "commissure_non_coronary_right",
    ]  # fmt: skip
    for name, point in landmarks_of(patient).items():
        assert model.set_landmark(name, point) == name
    assert model.missing_landmarks(i) == [] and len(model.landmarks.points) == 6
    first = model.landmarks
    assert model.set_landmark("Nadir Left", (1, 2, 3)) == "nadir_left"
    assert model.set_landmark("commissure_left_right", (4, 5, 6)) == "commissure_right_left"
    assert model.landmarks.points["commissure_right_left"] == (4.0, 5.0, 6.0) and len(model.landmarks.points) == 6
    assert model.undo() and model.undo() and model.landmarks == first
    with model.dragging():
        for k in range(3):
            model.set_landmark("nadir_right", (k, k, k))
    assert model.undo() and model.landmarks == first
    model.remove_landmark("nadir_left")
    assert model.missing_landmarks(i) == ["nadir_left"] and model.undo() and model.landmarks == first
    names = [model.set_landmark("attachment_right", (k, 0, 0)) for k in range(3)]
    assert names == ["attachment_right_1", "attachment_right_2", "attachment_right_3"]
    model.remove_landmark("attachment_right_2")
    assert model.set_landmark("attachment_right", (9, 0, 0)) == "attachment_right_2"
    model.clear_landmarks()
    assert not model.landmarks.points and model.undo() and len(model.landmarks.points) == 9


@pytest.mark.parametrize("kind", view.KINDS)
def test_the_names_of_a_kind_place_it(kind):
    """Landmarks under the names of the list, on circles, place each kind with its axis along the circle's."""
    points, way = on_circles(kind)
    turn = matrix_of((0.6, 0.0, 0.8, 40.0))
    model = view.Model(numpy.zeros((1, 3)), unit="mm")
    i = model.add(kind)
    for role in landmark_files.roles_of(kind):
        assert role.name in points or any(name.startswith(role.name) for name in points) or not role.is_needed, role
    for name, point in points.items():
        assert model.set_landmark(name, turn @ point + (7.0, -3.0, 90.0)) == name
        assert (len(model.missing_landmarks(i)) == 0) == (name == list(points)[-1]), name
    found = model.place_by_landmarks(i)
    assert found.worst < 3.0 and abs(numpy.dot(model.valves[i].axis, turn @ way)) > 0.98, found.report()
    with pytest.raises(riis.InvalidArgumentError, match=f"name: 'apex' is no landmark of the kind {kind}; it has "):
        model.set_landmark("apex", (0, 0, 0))


def on_circles(kind):
    """Returns landmarks of a kind on circles about z, by the names of the view, and the direction of flow. The last is needed."""

    def at(degrees, height=0.0, radius=13.0):
        angle = numpy.radians(degrees)
        return numpy.array([radius * numpy.cos(angle), radius * numpy.sin(angle), height])

    names = [role.name for role in landmark_files.roles_of(kind)]
    lows = [name for name in names if name.startswith("nadir")]
    tops = [name for name in names if name.startswith("commissure")]
    n, way = len(lows), numpy.array([0.0, 0.0, 1.0 if lows or kind == "bileaflet" else -1.0])
    points = {}
    if lows:
        points["coaptation"] = at(0.0, 8.0, 0.0)
        points |= {name: at(360.0 * k / n) for k, name in enumerate(lows)}
        points |= {name: at(360.0 * (k + 0.5) / n, 16.0) for k, name in enumerate(tops)}
        return points, way
    for name, angle in (("anterior_horn", 0.0), ("posterior_horn", 180.0), ("anterolateral_commissure", 120.0),
                        ("posteromedial_commissure", 240.0), ("trigone_1", 35.0), ("trigone_2", -35.0)):
        if name in names:
            points[name] = at(angle, radius=15.0)
    points |= {"flow_from": -20.0 * way, "flow_to": 20.0 * way}
    if kind == "bileaflet":
        points |= {"hinge_1": numpy.array([1.0, 12.0, 0.0]), "hinge_2": numpy.array([1.0, -12.0, 0.0])}
    points |= {name: at(60.0 + 120.0 * k, radius=15.0) for k, name in enumerate(tops)}
    n_annulus = 3 if kind == "bileaflet" else 4
    return points | {f"annulus_{k + 1}": at(10.0 + 360.0 * k / n_annulus, radius=15.0) for k in range(n_annulus)}, way


@pytest.mark.parametrize("ending", [".mrk.json", ".json"])
@pytest.mark.parametrize("unit", ["mm", "cm", "m"])
def test_landmarks_are_saved_and_read(ending, unit, patient, wall, tmp_path):
    """A file that the view writes has the landmarks, for riis.place too, and states unit and axes."""
    model = model_of(patient, wall_of(patient / "root.stl", view.UNITS[unit] / 10.0), unit=unit)
    assert model.read_landmarks(patient / "landmarks.mrk.json") == ""
    assert model.landmarks.axes == "LPS"
    for name, point in landmarks_of(patient).items():
        assert numpy.allclose(model.landmarks.points[name], numpy.array(point) * view.UNITS[unit] / 10.0, rtol=1e-12)
    i = model.add("coapting")
    model.set_landmark("coaptation", model.landmarks.points["nadir_left"])
    path = tmp_path / f"again{ending}"
    model.save_landmarks(path, i)
    other = model_of(patient, wall, unit=None)
    assert other.read_landmarks(path) == ("coapting" if ending == ".json" else "")
    assert other.landmarks == model.landmarks and other.unit == unit and other.landmarks.axes == "LPS"
    model.remove_landmark("coaptation")
    model.save_landmarks(path, i)
    found, mine = riis.place(path, "coapting"), model.place_by_landmarks(i)
    assert found.unit == unit and numpy.allclose(found.residuals, mine.residuals, rtol=1e-9)
    turned = model_of(patient, wall)
    turned.set_axes("RAS")
    turned.read_landmarks(path)
    factor = 10.0 / view.UNITS[unit]
    for name, (x, y, z) in model.landmarks.points.items():
        assert numpy.allclose(turned.landmarks.points[name], (-factor * x, -factor * y, factor * z), rtol=1e-12)


def test_a_flow_becomes_two_points(patient, wall, tmp_path):
    """A direction of flow in a file is shown as two points. Two points of a file stay where they are."""
    points = {f"annulus_{k + 1}": [10 * numpy.cos(k), 10 * numpy.sin(k), 1.0] for k in range(6)}
    root = {"valve": "bileaflet", "unit": "mm", "axes": "mesh", "flow": [0, 0.6, 0.8], "landmarks": points}
    (tmp_path / "flow.json").write_text(json.dumps(root))
    model = model_of(patient, wall)
    assert model.read_landmarks(tmp_path / "flow.json") == "bileaflet"
    way = numpy.subtract(model.landmarks.points["flow_to"], model.landmarks.points["flow_from"])
    assert numpy.allclose(way / numpy.linalg.norm(way), [0, 0.6, 0.8])
    del root["flow"]
    root["landmarks"] = points | {"flow_from": [1, 2, 3], "flow_to": [1, 2, 13]}
    root["unit"] = "cm"
    (tmp_path / "flow.json").write_text(json.dumps(root))
    model.read_landmarks(tmp_path / "flow.json")
    assert model.landmarks.points["flow_from"] == (10.0, 20.0, 30.0) and model.landmarks.points["flow_to"] == (10, 20, 130)


@pytest.mark.parametrize("change, message", [
    (lambda m, p: m.place_by_landmarks(0), "landmarks: nadir_right, nadir_left, .* are missing; pick them on the wall"),
    (lambda m, p: m.set_landmark("nadir_lefft", (0, 0, 0)), "name: 'nadir_lefft' is no landmark of the kind coapting; it has"),
    (lambda m, p: m.set_landmark("", (0, 0, 0)), "name: is ''; it must be the name of a landmark"),
    (lambda m, p: m.set_landmark("nadir_left", (0, 0)), r"nadir_left: is \(0, 0\); it must be three finite numbers"),
    (lambda m, p: m.remove_landmark("nadir_left"), "name: 'nadir_left' is not set; the landmarks are none"),
    (lambda m, p: m.set_axes("XYZ"), "axes: are 'XYZ'; they must be LPS, RAS, mesh"),
    (lambda m, p: m.save_landmarks(p / "none.mrk.json"), "landmarks: there are none to save; pick them on the wall first"),
    (lambda m, p: m.set_skirt(0, -1.0), "skirt: is -1.0; it must be above 0"),
    (lambda m, p: m.set_skirt(0, 3.0), "longest|wall"),
    (lambda m, p: m.set_unit("inch"), "unit: is 'inch'; it must be m, cm, mm"),
    (lambda m, p: m.add_placed(p / "landmarks.mrk.json"), "landmarks.mrk.json"),
    (lambda m, p: m.fit_of(0, numpy.eye(60, 3), free=["nothing"])(), "free: 'nothing' is not a parameter"),
])
def test_refused_changes_of_a_patient(change, message, patient, wall):
    """A refused change names the value, and changes nothing."""
    model = model_of(patient, wall)
    model.add("coapting")
    before = model._now()
    with pytest.raises(riis.Error, match=message):
        change(model, patient)
    assert model._now() == before


def test_refused_landmarks_say_what_helps(patient, wall, tmp_path):
    model = model_of(patient, wall)
    i = model.add("bicuspid")
    model.read_landmarks(patient / "landmarks.mrk.json")
    with pytest.raises(riis.InvalidArgumentError, match="nadir_cusp_0, nadir_cusp_1, .* are missing"):
        model.place_by_landmarks(i)
    model.change_kind(i, "coapting")
    with pytest.raises(riis.InvalidArgumentError, match="axes: are mesh; 3D Slicer's files have LPS or RAS"):
        model.set_axes("mesh")
        model.save_landmarks(tmp_path / "x.mrk.json")
    with pytest.raises(riis.InvalidArgumentError, match="must end in .mrk.json or .json"):
        model.save_landmarks(tmp_path / "x.txt")
    # The landmarks with the other axes are far from the wall. The message says so.
    turned = model_of(patient, wall)
    turned.set_axes("RAS")
    turned.read_landmarks(patient / "landmarks.mrk.json")
    turned.add("coapting")
    with pytest.raises(riis.InvalidArgumentError, match="LPS"):
        turned.place_by_landmarks(0)
    assert turned.valves[0].parameters == {}


# ---- Placed valves, walls and skirts ----


def test_a_valve_is_placed_from_the_wall_and_landmarks(patient, wall, mesh, tmp_path):
    """The placed valve is that of riis.place. Undo reverts it in one step, including its residuals."""
    model = model_of(patient, wall, mesh)
    i = model.add("coapting")
    model.read_landmarks(patient / "landmarks.mrk.json")
    model.set_landmark("nadir_left", landmarks_of(patient)["nadir_left"])
    for warp in ("none", "smoothed", "exact"):
        before = model._now()
        found = model.place_by_landmarks(i, warp=warp)
        known = riis.place(patient / "landmarks.mrk.json", "coapting", warp=warp)
        # The order of the landmarks differs, and with it the last digits.
        places = [known.names.index(name) for name in found.names]
        assert numpy.allclose(found.residuals, known.residuals[places], atol=1e-4) and model.valves[i].found is found
        surface = riis.Surface(known.valve, half_thickness=model.valves[i].half_thickness, **known.placement)
        assert numpy.abs(surface.vertices - model.surface(i).vertices).max() < 1e-3
        surface = riis.Surface(found.valve, half_thickness=model.valves[i].half_thickness, **found.placement)
        assert numpy.array_equal(surface.vertices, model.surface(i).vertices), warp
        marks = riis.mark(surface, riis.Mesh(mesh[0]))
        assert len(marks) > 200 and numpy.array_equal(model.update().marked, marks.ids)
        assert numpy.array_equal(model.update().distance, marks.distance)
        after = model._now()
        assert model.undo() and model._now() == before and model.redo() and model._now() == after
        assert model.valves[i].found is found
        model.set(i, "opening", 0.2)
        assert model.valves[i].found is found
        model.place(i, numpy.array(model.valves[i].origin) + 0.1)
        assert model.valves[i].found is None and model.undo() and model.undo()


def test_a_placed_file_opens_and_is_written(patient, wall, mesh, tmp_path):
    known = riis.place(patient / "landmarks.mrk.json", "coapting", warp="smoothed")
    known.save(tmp_path / "placed.json")
    for unit in ("mm", "cm", "m", None):
        factor = view.UNITS[unit or "mm"] / 10.0
        model = view.Model(factor * mesh[0], mesh[1], unit=unit)
        i = model.add_placed(tmp_path / "placed.json")
        assert model.unit == (unit or "mm") and model.valves[i].kind == "coapting"
        read = riis.read_placed(tmp_path / "placed.json", unit or "mm")
        options = {"half_thickness": model.valves[i].half_thickness, **read.placement}
        assert numpy.array_equal(riis.Surface(read.valve, **options).vertices, model.surface(i).vertices)
        (tmp_path / "again.json").write_text(model.placed_file(i))
        again = riis.read_placed(tmp_path / "again.json")
        assert numpy.array_equal(riis.Surface(again.valve, **options).vertices, model.surface(i).vertices)
        # If a valve is moved by hand, its warp moves with it: all its points make the same move.
        before, origin = model.surface(i).vertices.copy(), numpy.array(model.valves[i].origin)
        model.place(i, origin + factor * numpy.array([1.0, -2.0, 3.0]))
        moved = model.surface(i).vertices - before
        assert numpy.allclose(moved, factor * numpy.array([1.0, -2.0, 3.0]), atol=1e-9 * factor)
        model.set(i, "scale", 1.1 * model.valves[i].scale)
        with pytest.raises(riis.InvalidArgumentError, match="a placed file has the scale of its unit"):
            model.placed_file(i)
    unplaced = view.Model(*mesh)
    unplaced.add("coapting")
    with pytest.raises(riis.InvalidArgumentError, match="unit: is None; a placed file states the unit"):
        unplaced.placed_file(0)


def test_a_skirt_reaches_the_wall(patient, wall):
    """The outer rim of the skirt lies on the wall. The rim stays on the wall at each opening, and undo removes the skirt. Without
    a mesh nothing is marked, and the lights judge the valve in the wall."""
    model = model_of(patient, wall)
    i = model.add("coapting")
    model.read_landmarks(patient / "landmarks.mrk.json")
    model.place_by_landmarks(i, warp="smoothed")
    assert len(model.update().marked) == 0 and light(model, "inside").level == "good"
    assert light(model, "sealed").text == "whether the valve seals needs a mesh, and there is only a wall"
    wide = light(model, "wall")
    gap = model.surface(i).gap(wall.surface)
    assert f"the wall is {shown(gap.least)} to {shown(gap.most)} mm from the attachment" in wide.text
    model.set(i, "half_thickness", 0.1)
    wide = light(model, "wall")
    assert wide.level == "bad" and wide.cure[0].startswith("A skirt of ") and wide.cure[0].endswith(" mm to the wall")
    model.cure("wall")
    assert light(model, "wall").level == "good" and model.valves[i].skirt == wide.value
    for opening in (0.0, 0.6, 1.0):
        model.set(i, "opening", opening)
        valve = riis.Valve("coapting", opening=opening, **model.valves[i].parameters)
        warp = model.valves[i].warp.warp(model.valves[i].placement)
        valve.set_warp(warp)
        valve.skirt_to_wall(wall.surface, wide.value, **model.valves[i].placement)
        known = riis.Surface(valve, **model.valves[i].options)
        assert numpy.array_equal(known.vertices, model.surface(i).vertices)
        assert known.info.skirt_leaflet_id == 3
    with pytest.raises(riis.InvalidArgumentError, match="longest"):
        model.set_skirt(i, 0.2)
    assert model.valves[i].skirt == wide.value
    model.set_skirt(i, 0)
    assert model.surface(i).info.skirt_leaflet_id == -1
    model.undo()
    assert model.surface(i).info.skirt_leaflet_id == 3
    model.set_wall(None)
    assert model.valves[i].skirt == 0.0 and model.wall is None and model.undo() and model.wall is wall
    assert model.surface(i).info.skirt_leaflet_id == 3


def test_a_wall_that_is_turned_inwards_is_judged_alike(patient, wall):
    turned = Wall(wall.points, wall.triangles[:, ::-1])
    said = []
    for one in (wall, turned):
        model = model_of(patient, one)
        model.add("coapting")
        model.read_landmarks(patient / "landmarks.mrk.json")
        model.place_by_landmarks(0)
        said.append([(found.name, found.level, found.text) for found in model.lights()])
        model.place(0, numpy.array(model.valves[0].origin) + 100.0)
        assert light(model, "inside").level == "bad" and "the valve is outside: the valve is at" in light(model, "inside").text
        model.cure("inside")
        assert light(model, "inside").level != "bad"
    assert said[0] == said[1]


# ---- Files ----


def states_of(model, tmp_path):
    """Yields names of states of a patient's view: placed or not, warped, moved, with a skirt, open, with an offset."""
    yield "from its file"
    model.set_skirt(0, 6.0)
    model.set(0, "opening", 0.37)
    model.set(0, "offset", 0.5)
    yield "with a skirt, opened, and with an offset"
    model.set(0, "cusp_1.sector", 104.0)
    model.set(0, "half_thickness", 1.3)
    model.set(0, "resistance", 3e4)
    yield "with other sizes"
    model.place(0, numpy.array(model.valves[0].origin) + (0.2, -0.1, 0.3), axis=numpy.array(model.valves[0].axis) + 0.02)
    yield "moved by hand"
    model.place_by_landmarks(0, warp="exact")
    yield "placed anew, with an exact warp"
    model.place_by_landmarks(0)
    yield "placed without a warp"
    model.set_skirt(0, 0)
    model.place(0, scale=9.9)
    model.set(0, "triangulation", "fixed")
    yield "scaled by hand"


def test_the_copied_command_gives_what_is_seen(patient, wall, mesh, tmp_path):
    """In each state the command, the case and the Python lines mark the same nodes at the same distances."""
    pyvista = pytest.importorskip("pyvista", reason="PyVista is missing; ./run python installs it")
    program = program_riis()
    riis.place(patient / "landmarks.mrk.json", "coapting", warp="smoothed").save(tmp_path / "placed.json")
    from riis.view import reading

    model = view.Model(*mesh, path=patient / "tube.vtk", wall=reading.read_wall(str(patient / "root.stl")))
    model.add_placed(tmp_path / "placed.json")
    model.read_landmarks(patient / "landmarks.mrk.json")
    names = []
    for name in states_of(model, tmp_path):
        names.append(name)
        shown_now = model.update()
        case, warp = str(tmp_path / "case.json"), str(tmp_path / "warp.json")
        for path, text in model.command_files(case=case, warp=warp).items():
            pathlib.Path(path).write_text(text)
        (tmp_path / "case.json").write_text(model.case())
        command = model.command(program=program, output=str(tmp_path / "marked.vtu"), warp=warp)
        assert ("--valve=" + str(tmp_path / "placed.json") in command) == (len(names) <= 3), name
        for words in (shlex.split(command), [program, "mark", "--case", case, "--output", str(tmp_path / "marked.vtu")]):
            done = subprocess.run(words, capture_output=True, text=True, check=False)
            assert done.returncode == 0, (name, done.stderr)
            made = pyvista.read(tmp_path / "marked.vtu").point_data
            nodes = numpy.flatnonzero(made["riis_marked"])
            assert len(nodes) > 200 and numpy.array_equal(nodes, shown_now.marked), name
            assert numpy.array_equal(made["riis_distance"][nodes], shown_now.distance), name
            assert numpy.array_equal(made["riis_leaflet"][nodes], shown_now.leaflet), name
        lines = {}
        exec(model.python(), lines)
        marks = lines["marks"][model.valves[0].name]
        assert numpy.array_equal(marks.ids, shown_now.marked) and numpy.array_equal(marks.distance, shown_now.distance), name
    assert len(names) == 7
    model.set_skirt(0, 0.0)


def test_without_a_mesh_the_command_writes_the_surface(patient, wall, tmp_path):
    pyvista = pytest.importorskip("pyvista", reason="PyVista is missing; ./run python installs it")
    program = program_riis()
    model = model_of(patient, wall)
    model.add("coapting")
    model.read_landmarks(patient / "landmarks.mrk.json")
    model.place_by_landmarks(0, warp="smoothed")
    model.set_skirt(0, 6.0)
    for path, text in model.command_files(warp=str(tmp_path / "warp.json")).items():
        pathlib.Path(path).write_text(text)
    command = model.command(program=program, output=str(tmp_path / "seen.vtu"), warp=str(tmp_path / "warp.json"))
    done = subprocess.run(shlex.split(command), capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    assert numpy.array_equal(pyvista.read(tmp_path / "seen.vtp").points, model.surface(0).vertices)


def test_a_command_that_the_program_would_refuse_is_refused():
    """The wall, a cone, is within the skirt of the closed valve, but not of the open one, whose annulus has moved."""
    n, (low, high) = 90, (-3.0, 3.0)
    turn = numpy.linspace(0.0, 2.0 * numpy.pi, n, endpoint=False)
    around = numpy.column_stack([numpy.cos(turn), numpy.sin(turn)])
    points = numpy.concatenate([numpy.column_stack([(2.6 - 0.35 * z) * around, numpy.full(n, z)]) for z in (low, high)])
    k, after = numpy.arange(n), (numpy.arange(n) + 1) % n
    faces = numpy.concatenate([numpy.column_stack([k, after, n + k]), numpy.column_stack([after, n + after, n + k])])
    wall = Wall(points, faces, "cone.stl")
    model = view.Model(None, wall=wall, unit="cm")
    model.add("mitral")
    model.place(0, (0.0, 0.0, 0.0))
    widest, closed = wall.widest(model.valves[0]), model.surface(0).gap(wall.surface).most
    assert widest.opening > 0.0 and widest.gap > 1.02 * closed and not widest.is_missed
    assert wall.gap(model.surface(0)).most == closed
    model.set_skirt(0, 1.005 * closed)
    assert wall.widest(model.valves[0]) == widest
    assert light(model, "wall").level == "bad" and f"at the opening {shown(widest.opening)}" in light(model, "wall").text
    for refused in (model.command, model.case):
        with pytest.raises(riis.InvalidArgumentError, match="skirt: of the valve mitral is .* cm at most, and the wall is up to"):
            refused()
    model.cure("wall")
    assert light(model, "wall").level == "good" and "--wall=" in model.command()


def test_a_session_of_a_patient_opens_as_it_was(patient, wall, mesh, tmp_path):
    riis.place(patient / "landmarks.mrk.json", "coapting", warp="smoothed").save(tmp_path / "placed.json")
    for nodes in (mesh, (None, None)):
        model = model_of(patient, wall, nodes)
        model.add_placed(tmp_path / "placed.json")
        model.read_landmarks(patient / "landmarks.mrk.json")
        model.set_skirt(0, 6.0)
        model.save(tmp_path / "patient.view.json")
        arrays = {"points": mesh[0], "cells": mesh[1]} if nodes[0] is not None else None
        again = view.Model.load(tmp_path / "patient.view.json", arrays)
        assert again.command() == model.command() and again.landmarks == model.landmarks
        assert numpy.array_equal(again.surface(0).vertices, model.surface(0).vertices)
        assert numpy.array_equal(again.update().marked, model.update().marked)
        assert numpy.array_equal(again.wall.points, wall.points) and again.wall.path == wall.path
        assert not again.can_undo
        model.place_by_landmarks(0, warp="exact")
        model.save(tmp_path / "patient.view.json")
        again = view.Model.load(tmp_path / "patient.view.json", arrays)
        assert again.command_files() == model.command_files() and again.command() == model.command()


def test_openfoam_gets_the_warp_and_the_skirt(patient, wall, tmp_path):
    """The dictionary has the landmarks in metres, also after the valve was moved by hand, and the longest skirt."""
    model = model_of(patient, wall)
    model.add("coapting")
    model.read_landmarks(patient / "landmarks.mrk.json")
    found = model.place_by_landmarks(0, warp="smoothed")
    model.set_skirt(0, 6.0)
    shift = numpy.array([0.1, 0.2, -0.1])
    for moved in (numpy.zeros(3), shift):
        model.place(0, numpy.array(model.valves[0].origin) + moved)
        text = model.openfoam()
        assert text.count("{") == text.count("}")
        assert "    skirt\n    {\n        patch wall;\n        longest 0.006;\n    }\n" in text
        entry = text[text.index("        targets") : text.index("        noise")]
        rows = [[float(word) for word in line.strip(" ()").split()] for line in entry.splitlines() if line.startswith(12 * " ")]
        assert numpy.allclose(rows, 1e-3 * (found.points + moved), rtol=1e-12)
        assert f"noise {1e-3 * found.warp_noise:.6g}"[:12] in text
        (tmp_path / "placed.json").write_text(model.placed_file(0))
        assert json.loads((tmp_path / "placed.json").read_text())["warp"].get("coordinates", "mesh") == "mesh"
        again = riis.read_placed(tmp_path / "placed.json")
        bare = riis.Surface(again.valve, half_thickness=1.0, **again.placement).vertices
        model.set_skirt(0, 0.0)
        assert numpy.allclose(bare, model.surface(0).vertices, atol=1e-9)
        model.undo()


# ---- Fits ----


def test_a_fit_finds_the_valve_of_its_points(patient, wall, random):
    """Points on a known valve, near which the view's valve stands, give its sizes and its place."""
    model = model_of(patient, wall)
    i = model.add("coapting")
    model.read_landmarks(patient / "landmarks.mrk.json")
    model.place_by_landmarks(i)
    state = model.valves[i]
    points = model.surface(i).vertices[random.permutation(len(model.surface(i).vertices))[:800]]
    points = points + random.normal(0.0, 0.1, points.shape)
    model.place(i, numpy.array(state.origin) + (0.8, -0.5, 0.4), axis=numpy.array(state.axis) + (0.05, 0.0, -0.03))
    model.set(i, "root_radius", 1.05 * state.parameters["root_radius"])
    assert model.sizes_to_fit(i) == ["root_radius", "commissure_radius", "effective_height", "coaptation_height"]
    before = model._now()
    found = model.fit_of(i, points, free=["root_radius", "commissure_radius"], noise=0.1)()
    assert model._now() == before
    model.take_fit(i, found)
    assert model.valves[i].found is found and found.rms < 0.2, found.report()
    assert abs(model.values(i)["root_radius"] - state.parameters["root_radius"]) < 0.02
    assert numpy.linalg.norm(numpy.subtract(model.valves[i].origin, state.origin)) < 0.3
    assert model.undo() and model._now() == before
    model.place_by_landmarks(i, warp="smoothed")
    with pytest.raises(riis.InvalidArgumentError, match="is warped to landmarks, and a fit has no warp"):
        model.fit_of(i, points)
