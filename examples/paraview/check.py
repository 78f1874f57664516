# SPDX-License-Identifier: Apache-2.0
"""check.py FOLDER: checks the plug-in in pvpython, and leaves pictures in the folder. ./run paraview calls it.

The filter's marks have the bits of riis.mark's, for every kind of valve, placed at random in a random mesh. A saved state gives
the same bits when it is loaded again. Time steps follow the cycle. Bad input gives a message and no output.
"""

import os
import random
import sys

import numpy
import riis
from paraview import servermanager
from paraview import simple as pv
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonCore import VTK_ID_TYPE, vtkLogger, vtkOutputWindow, vtkPoints, vtkStringOutputWindow
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkDataObject, vtkUnstructuredGrid
from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridWriter

FOLDER = os.path.abspath(sys.argv[1])
HERE = os.path.dirname(os.path.abspath(__file__))
PLUGIN = os.path.join(HERE, "..", "..", "src", "paraview", "riis_paraview.py")
KINDS = (
    "aortic", "trileaflet", "coapting", "bicuspid", "quadricuspid", "mitral", "mitral_coapting", "tricuspid", "bileaflet",
)  # fmt: skip
UNITS = {"cm": 1.0, "mm": 10.0, "m": 0.01}
TETRA, VOXEL, HEXAHEDRON, LINE, QUADRATIC_TETRA = 10, 11, 12, 3, 24
SEED = int(os.environ.get("RIIS_TEST_SEED", random.SystemRandom().randrange(10**9)))
CHANCE = random.Random(SEED)

checks = 0


def check(holds, text):
    global checks
    checks += 1
    if not holds:
        sys.exit(f"check.py: {text} (RIIS_TEST_SEED={SEED})")


def same(a, b, text):
    """Checks that two arrays have the same type, shape and bits."""
    check(a.dtype == b.dtype and a.shape == b.shape and a.tobytes() == b.tobytes(), f"{text}: the bits differ")


def nearly_same(a, b, text):
    """Checks velocities. At the seam of two patches, a node may take the velocity of either patch."""
    differs = (a != b).any(axis=1)
    close = numpy.abs(a - b).max() <= 1e-3 * numpy.abs(b).max()
    check(differs.sum() <= 0.01 * (b != 0).any(axis=1).sum() and close, f"{text}: {differs.sum()} nodes differ")


# ---- Meshes ----


def grid_of(xyz, cells):
    """Makes a grid of VTK. cells: pairs of a type and the nodes."""
    grid, points, array = vtkUnstructuredGrid(), vtkPoints(), vtkCellArray()
    points.SetData(numpy_to_vtk(numpy.ascontiguousarray(xyz), deep=True))
    lengths = [len(nodes) for _, nodes in cells]
    offsets = numpy.concatenate([[0], numpy.cumsum(lengths)]).astype(numpy.int64)
    corners = numpy.concatenate([nodes for _, nodes in cells]).astype(numpy.int64)
    array.SetData(numpy_to_vtk(offsets, deep=True, array_type=VTK_ID_TYPE),
                  numpy_to_vtk(corners, deep=True, array_type=VTK_ID_TYPE))  # fmt: skip
    grid.SetPoints(points)
    grid.SetCells(numpy_to_vtk(numpy.array([kind for kind, _ in cells], numpy.uint8), deep=True), array)
    return grid


def box(n, size, centre):
    """Returns nodes and hexahedra of a box whose inner nodes are shaken."""
    line = numpy.linspace(-0.5 * size, 0.5 * size, n)
    xyz = numpy.stack(numpy.meshgrid(line, line, line, indexing="ij"), axis=-1)
    shake = numpy.random.default_rng(CHANCE.randrange(10**9)).uniform(-0.2, 0.2, xyz.shape) * size / n
    xyz[1:-1, 1:-1, 1:-1] += shake[1:-1, 1:-1, 1:-1]
    ids = numpy.arange(n**3).reshape(n, n, n)
    corners = ((0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1))
    hexahedra = numpy.stack([ids[i : n - 1 + i, j : n - 1 + j, k : n - 1 + k].ravel() for i, j, k in corners], axis=1)
    return xyz.reshape(-1, 3) + centre, hexahedra


def write(grid, name):
    path = os.path.join(FOLDER, name)
    writer = vtkXMLUnstructuredGridWriter()
    writer.SetFileName(path)
    writer.SetInputData(grid)
    writer.SetDataModeToBinary()
    check(writer.Write() == 1, f"{path} is not written")
    return path


# ---- What the plug-in gives ----


def output_of(proxy, port=0, is_shown=False):
    """Returns an output of the proxy as a data object of VTK: as a view shows it, or else after an update."""
    if not is_shown:
        proxy.UpdatePipeline()
    return proxy.GetClientSideObject().GetOutputDataObject(port)


def arrays_of(proxy, port=0, is_shown=False):
    """Returns the point arrays and the field arrays of an output, as numpy arrays."""
    data, found = output_of(proxy, port, is_shown), {}
    for attributes in (data.GetPointData(), data.GetFieldData()):
        for i in range(attributes.GetNumberOfArrays()):
            if attributes.GetArray(i) is not None:
                found[attributes.GetArrayName(i)] = numpy.array(vtk_to_numpy(attributes.GetArray(i)))
    return found


def expected_of(surface, mesh, fields, R=0.0):
    """Returns the results of riis itself."""
    marks = riis.mark(surface, mesh, fields=fields or None)
    dense = marks.dense(leaflet_id=True)
    found = {"riis_marked": dense.mark.astype(numpy.uint8), "riis_distance": dense.distance, "riis_leaflet": dense.leaflet_id}
    for field in fields:
        listed = getattr(marks, field)
        found[f"riis_{field}"] = numpy.zeros((len(mesh), *listed.shape[1:]), listed.dtype)
        found[f"riis_{field}"][marks.ids] = listed
    if R > 0:
        found["riis_K"] = numpy.zeros(len(mesh))
        K_u = numpy.zeros((len(mesh), 3)) if "velocity" in fields else None
        marks.add_resistance(found["riis_K"], K_u, R=R)
        if K_u is not None:
            found["riis_K_u_surface"] = K_u
    return marks, found


def compare(given, expected, text):
    for name, values in expected.items():
        check(name in given, f"{text}: {name} is missing")
        same(given[name], values, f"{text}: {name}")


def parameter_of(kind):
    """Returns a few random sizes near their defaults with which the valve has a surface, and the valve."""
    names = [name for name, known in riis.Valve(kind).parameters.items() if name != "opening" and known.n_values == 1]
    while True:
        opening, chosen = CHANCE.random(), {}
        for name in CHANCE.sample(names, 3):
            known = riis.Valve(kind).parameters[name]
            value = known.default * CHANCE.uniform(0.95, 1.05)
            if value != known.default and known.minimum <= value <= known.maximum:
                chosen[name] = value
        if "bump_0.leaflet" in names:
            chosen |= {"bump_0.leaflet": 1.0, "bump_0.open": CHANCE.uniform(0.3, 0.9)}
        try:
            valve = riis.Valve(kind, opening=opening, **chosen) if all(n.isidentifier() for n in chosen) else None
            if valve is None:
                valve = riis.Valve(kind, opening=opening)
                valve.update(chosen)
            riis.Surface(valve)
            return chosen, valve
        except riis.Error:
            continue


def check_kinds():
    """Compares the marks of every kind with riis, bit for bit. Returns what a state file needs for a comparison."""
    n_marked = 0
    for kind in KINDS:
        chosen, valve = parameter_of(kind)
        unit = CHANCE.choice(list(UNITS))
        scale = UNITS[unit]
        axis, angle = [CHANCE.gauss(0, 1) for _ in range(3)], CHANCE.uniform(-180, 180)
        shift = [scale * CHANCE.uniform(-20, 20) for _ in range(3)]
        xyz, cells = box(33, 4.5 * scale, shift)
        half_thickness, offset = CHANCE.choice([0.0, 0.13 * scale, 0.03 * scale]), CHANCE.choice([0.0, 0.75, -0.5])
        path = write(grid_of(xyz, [(HEXAHEDRON, cell) for cell in cells]), f"{kind}.vtu")
        mesh = pv.XMLUnstructuredGridReader(FileName=[path])
        source = pv.HeartValve(Kind=kind, Opening=valve["opening"], MeshUnit=unit, RotationAxis=axis, RotationAngle=angle,
                            Translation=shift, HalfThickness=half_thickness, Offset=offset)  # fmt: skip
        for name, value in chosen.items():
            setattr(source, f"{kind}_{name}".replace(".", "_"), value)
        marked = pv.MarkByValve(Mesh=mesh, Valve=source, Resistance=1e4, FieldNormal=1, FieldSide=1, FindLeaks=1)
        options = {"half_thickness": half_thickness} if half_thickness else {}
        surface = riis.Surface(valve, scale=scale, rotation_axis=axis, rotation_angle=angle, translation=shift, offset=offset,
                               **options)
        if offset != 0.0:  # at the rim the band depends on which edges are open, and the filter only has the triangles
            triangles = surface.triangles
            surface = riis.Surface.from_arrays(surface.vertices, triangles.vertex_id, leaflet_id=triangles.leaflet_id,
                                               half_thickness=surface.half_thickness, offset=offset)
        own = riis.Mesh(xyz)
        own.set_adjacency(riis.Adjacency.from_cells(cells.astype(numpy.int64), len(xyz)))
        marks, expected = expected_of(surface, own, ["normal", "side"], 1e4)
        compare(arrays_of(marked), expected, kind)
        leaks = riis.find_leaks(surface, own, marks)
        given = arrays_of(marked, 1)
        check(arrays_of(marked)["riis_leaking_edges"][0] == leaks.n_edges, f"{kind}: the number of leaking edges")
        if leaks.n_edges > 0:
            same(given["riis_node_id"].astype(numpy.int64), leaks.node_id.ravel(), f"{kind}: leaking edges")
        check(len(marks) > 50, f"{kind}: only {len(marks)} nodes are marked")
        n_marked += len(marks)
        print(f"{kind:10}  {len(marks):6} marked nodes, {leaks.n_edges:4} leaking edges, K, normals, sides: the same bits")
        if kind == KINDS[-1]:
            return mesh, source, marked, expected
        for proxy in (marked, source, mesh):
            pv.Delete(proxy)
    return None


def check_leaks_of_cells():
    """A coarse mesh has leaks. Voxels have the same edges as hexahedra, and the edges of line cells do not count."""
    xyz, cells = box(14, 4.0, numpy.zeros(3))
    numbers = []
    for order in ((HEXAHEDRON, list(range(8))), (VOXEL, [0, 1, 3, 2, 4, 5, 7, 6])):
        mixed = [(order[0], cell[order[1]]) for cell in cells] + [(LINE, numpy.array([0, len(xyz) - 1]))]
        mesh = pv.XMLUnstructuredGridReader(FileName=[write(grid_of(xyz, mixed), "coarse.vtu")])
        valve = pv.HeartValve(Kind="mitral", HalfThickness=0.05)
        marked = pv.MarkByValve(Mesh=mesh, Valve=valve, FindLeaks=1)
        numbers.append(int(arrays_of(marked)["riis_leaking_edges"][0]))
        edges = output_of(marked, 1)
        check(edges.GetNumberOfLines() == numbers[-1] > 0, "the lines of leaking edges")
        pv.Delete(marked)
        pv.Delete(mesh)
    check(numbers[0] == numbers[1], f"voxels have {numbers[1]} leaking edges, hexahedra {numbers[0]}")


def check_transformed():
    """ParaView's filters may lie between valve and marks: a valve moved by ParaView marks like a placed valve."""
    xyz, cells = box(25, 4.0, numpy.array([0.5, -0.25, 0.125]))
    mesh = pv.XMLUnstructuredGridReader(FileName=[write(grid_of(xyz, [(HEXAHEDRON, cell) for cell in cells]), "moved.vtu")])
    source = pv.HeartValve(Kind="coapting", Opening=0.4)
    moved = pv.Transform(Input=source)
    moved.Transform.Translate = [0.5, -0.25, 0.125]
    given = arrays_of(pv.MarkByValve(Mesh=mesh, Valve=moved, HalfThickness=0.1))
    surface = riis.Surface(riis.Valve("coapting", opening=0.4), translation=(0.5, -0.25, 0.125))
    _, expected = expected_of(surface, riis.Mesh(xyz), [])
    differ = numpy.count_nonzero(given["riis_marked"] != expected["riis_marked"])
    check(differ <= 2, f"a valve that ParaView moves: {differ} marks differ")  # ParaView may compute in single precision


def check_placed():
    """A placed valve with a warp marks as riis.mark does, whatever the panel says, and moves."""
    turns = numpy.arange(6) * numpy.pi / 3
    ring = numpy.stack([11.0 * numpy.cos(turns), 11.0 * numpy.sin(turns), numpy.where(numpy.arange(6) % 2, 14.0, 0.0)], 1)
    ring += [[CHANCE.gauss(0.0, 0.6) for _ in range(3)] for _ in range(6)]
    names = ("nadir_right", "commissure_right_left", "nadir_left", "commissure_left_non", "nadir_non", "commissure_non_right")
    xyz, cells = box(25, 40.0, numpy.array([0.0, 0.0, 7.0]))
    mesh = pv.XMLUnstructuredGridReader(FileName=[write(grid_of(xyz, [(HEXAHEDRON, cell) for cell in cells]), "placed.vtu")])
    path = os.path.join(FOLDER, "placed.json")
    for warp in ("none", "exact"):
        found = riis.place(dict(zip(names, ring)), "coapting", unit="mm", warp=warp)
        found.save(path)
        opening = CHANCE.random()
        source = pv.HeartValve(Kind="mitral", PlacedValve=path, Opening=opening, MeshUnit="m", Translation=[5, 5, 5])
        marked = pv.MarkByValve(Mesh=mesh, Valve=source, Resistance=10.0)
        placed = riis.read_placed(path)
        placed.valve["opening"] = opening
        surface = riis.Surface(placed.valve, **placed.placement)
        _, expected = expected_of(surface, riis.Mesh(xyz), [], 10.0)
        compare(arrays_of(marked), expected, f"a placed valve with the warp {warp}")
        source.Motion, source.NumberOfTimes = "heartbeat by four times", 5
        source.UpdatePipelineInformation()
        check(len(source.TimestepValues) == 5, f"a placed valve has the times {source.TimestepValues}")
        pv.Delete(marked)
        pv.Delete(source)
    print("placed      files of riis.place, with and without a warp: the same bits")


def check_state(marked, expected):
    path = os.path.join(FOLDER, "valve.pvsm")
    pv.SaveState(path)
    pv.ResetSession()
    load()
    pv.LoadState(path)
    loaded = [proxy for (name, _), proxy in pv.GetSources().items() if name.startswith("MarkByValve")]
    check(len(loaded) == 1, f"the state has {len(loaded)} filters")
    compare(arrays_of(loaded[0]), expected, "the loaded state")
    print("state file  the same bits after it is saved and loaded")
    return loaded[0]


def check_time():
    """At each step of both motions, the marks equal those of riis at the opening of this time. ParaView's animation shows
    them."""
    xyz, cells = box(25, 4.0, numpy.zeros(3))
    mesh = pv.XMLUnstructuredGridReader(FileName=[write(grid_of(xyz, [(HEXAHEDRON, cell) for cell in cells]), "time.vtu")])
    cycle = os.path.join(FOLDER, "cycle.csv")
    with open(cycle, "w", encoding="utf-8") as file:
        file.write("# a heartbeat\ntime,opening\n0.0,0.0\n0.25,1.0\n\n0.5, 0.4\n1.0,0.0\n")
    keys = numpy.array([0.0, 0.25, 0.5, 1.0]), numpy.array([0.0, 1.0, 0.4, 0.0])
    for motion, law, steps in (
        ("heartbeat by four times", riis.OpeningTimes(0.05, 0.2, 0.45, 0.2, period=0.8), numpy.linspace(0.0, 0.8, 9)),
        ("cycle from a table", riis.OpeningTable(*keys, interpolation="cubic"), numpy.linspace(0.0, 1.0, 9)),
    ):
        source = pv.HeartValve(Kind="mitral", Motion=motion, CycleFile=cycle, Interpolation="cubic", NumberOfTimes=9,
                            BeginsToOpen=0.05, OpensIn=0.2, BeginsToClose=0.45, ClosesIn=0.2)  # fmt: skip
        marked = pv.MarkByValve(Mesh=mesh, Valve=source, FieldVelocity=1, Resistance=10.0)
        marked.UpdatePipelineInformation()
        check(numpy.allclose(marked.TimestepValues, steps, rtol=0, atol=1e-12), f"{motion}: the times {marked.TimestepValues}")
        view = pv.CreateRenderView(ViewSize=[64, 64])
        pv.Show(marked, view)
        scene = pv.GetAnimationScene()
        scene.UpdateAnimationUsingDataTimeSteps()
        check(len(pv.GetTimeKeeper().TimestepValues) == 9, f"{motion}: the animation has other times")
        seen = []
        scene.GoToFirst()
        for step, time in enumerate(steps):
            given, at = arrays_of(marked, is_shown=True), output_of(marked, is_shown=True).GetInformation()
            of_source = output_of(source, is_shown=True).GetInformation()
            shown = at.Get(vtkDataObject.DATA_TIME_STEP())
            check(abs(shown - time) < 1e-12, f"{motion}: step {step} of the animation shows the time {shown}, not {time}")
            now, dt = of_source.Get(vtkDataObject.DATA_TIME_STEP()), 1e-3 * (steps[1] - steps[0])
            valve, before = (riis.Valve("mitral", opening=law(at)) for at in (now, now - dt))
            surface = riis.Surface(valve)
            surface.update_moving(valve, before, float(dt))
            _, expected = expected_of(surface, riis.Mesh(xyz), ["velocity"], 10.0)
            for name in ("riis_velocity", "riis_K_u_surface"):
                nearly_same(given[name], expected.pop(name), f"{motion}, step {step}: {name}")
            compare(given, expected, f"{motion}, step {step}")
            seen.append(given["riis_marked"].tobytes())
            scene.GoToNext()
        check(len(set(seen)) >= 4, f"{motion}: the valve does not move")
        for proxy in (view, marked, source):
            pv.Delete(proxy)
    print("time steps  marks, distances and K of 2 x 9 steps: the same bits; velocities agree")


def message_of(proxy):
    """Returns the text that appears in ParaView's output window while the proxy is updated."""
    window, before = vtkStringOutputWindow(), vtkOutputWindow.GetInstance()
    vtkOutputWindow.SetInstance(window)
    try:
        proxy.UpdatePipeline()
    except RuntimeError:
        pass
    finally:
        vtkOutputWindow.SetInstance(before)
    return window.GetOutput()


def check_refusals():
    xyz, cells = box(5, 4.0, numpy.zeros(3))
    mesh = pv.XMLUnstructuredGridReader(FileName=[write(grid_of(xyz, [(HEXAHEDRON, cell) for cell in cells]), "bad.vtu")])
    curved = [(QUADRATIC_TETRA, numpy.arange(10))]
    bad_cells = pv.XMLUnstructuredGridReader(FileName=[write(grid_of(xyz, curved), "curved.vtu")])
    bad_cycle = os.path.join(FOLDER, "bad.csv")
    with open(bad_cycle, "w", encoding="utf-8") as file:
        file.write("0,0\n1,full\n")
    table = {"Motion": "cycle from a table"}
    bad_placed = os.path.join(FOLDER, "bad.json")
    with open(bad_placed, "w", encoding="utf-8") as file:
        file.write('{"valve": "mitral", "unit": "inch"}')
    cases = [
        (lambda: pv.HeartValve(Kind="mitral", Opening=2.0), "opening", "2"),
        (lambda: pv.HeartValve(Kind="aortic", aortic_root_radius=-1.0), "root_radius", "-1"),
        (lambda: pv.HeartValve(HalfThickness=-1.0), "HalfThickness: is -1.0", ""),
        (lambda: pv.HeartValve(Offset=1.5), "offset is 1.5", "below 1"),
        (lambda: pv.HeartValve(Tolerance=2.0), "tolerance", "2"),
        (lambda: pv.HeartValve(RotationAxis=[0, 0, 0]), "rotation_axis", "(0, 0, 0)"),
        (lambda: pv.HeartValve(**table), "CycleFile: no file is named", ""),
        (lambda: pv.HeartValve(CycleFile=os.path.join(FOLDER, "none.csv"), **table), "No such file", "none.csv"),
        (lambda: pv.HeartValve(CycleFile=bad_cycle, **table), "bad.csv, line 2", "1,full"),
        (lambda: pv.HeartValve(PlacedValve=os.path.join(FOLDER, "none.json")), "No such file", "none.json"),
        (lambda: pv.HeartValve(PlacedValve=bad_placed), "bad.json: unit is 'inch'", ""),
        (lambda: pv.HeartValve(Motion="heartbeat by four times", Period=0.0), "Period: is 0.0", ""),
        (lambda: pv.HeartValve(Motion="heartbeat by four times", OpensIn=-1.0), "opening_duration", "-1"),
        (lambda: pv.MarkByValve(Mesh=mesh, Valve=pv.Sphere()), "HalfThickness: it is 0", ""),
        (lambda: pv.MarkByValve(Mesh=mesh, Valve=pv.Plane(), HalfThickness=0.1), "cells that are not triangles", ""),
        (lambda: pv.MarkByValve(Mesh=mesh, Valve=pv.HeartValve(), Offset=-1.5), "offset is -1.5", "above -1"),
        (lambda: pv.MarkByValve(Mesh=mesh, Valve=pv.HeartValve(), FieldVelocity=1), "FieldVelocity: the valve does not move", ""),
        (lambda: pv.MarkByValve(Mesh=mesh, Valve=pv.HeartValve(), Resistance=-1.0), "R", "-1"),
        (lambda: pv.MarkByValve(Mesh=mesh, Valve=pv.HeartValve(), DistanceLimit=1e-3), "distance_limit", "0.001"),
        (lambda: pv.MarkByValve(Mesh=mesh, Valve=pv.HeartValve(), DistanceLimit=-1.0), "DistanceLimit: is -1.0", ""),
        (lambda: pv.MarkByValve(Mesh=bad_cells, Valve=pv.HeartValve(), FindLeaks=1), "FindLeaks: the mesh has cells", "type 24"),
    ]  # fmt: skip
    before = vtkLogger.GetCurrentVerbosityCutoff()
    vtkLogger.SetStderrVerbosity(vtkLogger.VERBOSITY_OFF)  # the failed requests, which follow the messages
    for make, *parts in cases:
        proxy = make()
        text = message_of(proxy)
        check(all(part in text for part in parts), f"a refusal lacks {parts}: '{text}'")
        check("Traceback" not in text, f"a refusal has a traceback: '{text}'")
        check(arrays_of(proxy, is_shown=True) == {}, f"a refusal leaves an output: {parts}")
        pv.Delete(proxy)
    proxy = pv.HeartValve(Kind="mitral", Opening=2.0)
    message_of(proxy)
    vtkLogger.SetStderrVerbosity(before)
    proxy.Opening = 0.5
    check(message_of(proxy) == "" and proxy.GetDataInformation().GetNumberOfPoints() > 100, "no way back from a refusal")
    print(f"refusals    {len(cases)} messages, each with the name and the value")


def draw():
    """Draws the mitral valve and its marks in a mesh that is cut open."""
    xyz, cells = box(49, 4.4, numpy.array([0.0, 0.0, -0.6]))
    mesh = pv.XMLUnstructuredGridReader(FileName=[write(grid_of(xyz, [(HEXAHEDRON, cell) for cell in cells]), "draw.vtu")])
    source = pv.HeartValve(Kind="mitral", Opening=0.3)
    marked = pv.MarkByValve(Mesh=mesh, Valve=source)
    view = pv.CreateRenderView(ViewSize=[1000, 750], Background=[1, 1, 1], OrientationAxesLabelColor=[0, 0, 0])
    view.UseColorPaletteForBackground = 0
    band = pv.Threshold(Input=marked, Scalars=["POINTS", "riis_marked"])
    band.LowerThreshold, band.UpperThreshold = 1, 1
    half = pv.Clip(Input=band, ClipType="Plane")
    half.ClipType.Origin, half.ClipType.Normal = [0, 0, 0], [1, 0, 0]
    cut = pv.Clip(Input=marked, ClipType="Plane")
    cut.ClipType.Origin, cut.ClipType.Normal = [0, 0, 0], [1, 0, 0]
    leaflets = pv.Show(source, view)
    pv.ColorBy(leaflets, ("CELLS", "riis_leaflet"))
    bar = pv.GetColorTransferFunction("riis_leaflet")
    bar.InterpretValuesAsCategories = 1
    bar.Annotations = ["0", "anterior", "1", "posterior"]
    bar.IndexedColors = [0.0, 0.447, 0.698, 0.902, 0.624, 0.0]
    shown = pv.Show(half, view)
    shown.Opacity = 0.35
    pv.ColorBy(shown, ("POINTS", "riis_leaflet"))
    outline = pv.Show(cut, view, Representation="Outline")
    outline.AmbientColor = outline.DiffuseColor = [0.3, 0.3, 0.3]
    pv.ResetCamera(view)
    view.CameraPosition, view.CameraFocalPoint, view.CameraViewUp = [9, -6, 5], [0, 0, -0.6], [0, 0, 1]
    pv.Render(view)
    path = os.path.join(FOLDER, "marked.png")
    pv.SaveScreenshot(path, view)
    check(os.path.getsize(path) > 20_000, f"{path} is empty")


def load():
    pv.LoadPlugin(PLUGIN, remote=False, ns=vars(pv))
    check(hasattr(pv, "HeartValve") and hasattr(pv, "MarkByValve"), "the plug-in is not loaded")


print(f"RIIS_TEST_SEED={SEED}, {servermanager.vtkSMProxyManager.GetParaViewSourceVersion()}, riis {riis.version_string()}")
load()
mesh, source, marked, expected = check_kinds()
check_state(marked, expected)
check_placed()
check_leaks_of_cells()
check_transformed()
check_time()
check_refusals()
draw()
print(f"{checks} checks hold")
