# SPDX-License-Identifier: Apache-2.0
"""Pictures by PyVista, if it is installed."""

import os
import subprocess
import sys

import numpy
import pytest

import riis
import tube
from riis import _plot

pyvista = pytest.importorskip("pyvista", reason="PyVista is missing; ./run python installs it")


def test_a_surface_goes_to_pyvista():
    valve, before = riis.Valve("mitral", opening=0.4), riis.Valve("mitral", opening=0.3)
    surface = riis.Surface(valve)
    assert "velocity" not in surface.to_pyvista().point_data
    surface.update_moving(valve, before, 0.1)
    data = surface.to_pyvista()
    assert numpy.array_equal(data.points, surface.vertices)
    assert numpy.array_equal(data.faces.reshape(-1, 4)[:, 1:], surface.triangles.vertex_id)
    assert numpy.isclose(data.area, surface.info.area)
    assert numpy.array_equal(data.cell_data["leaflet_id"], surface.triangles.leaflet_id)
    assert numpy.array_equal(data.point_data["velocity"], surface.velocities)
    surface.update(valve)  # the copy does not prevent an update


def test_a_picture_shows_the_leaflets_and_the_marks(surface, mesh, marks, tmp_path):
    alone, marked = tmp_path / "alone.png", tmp_path / "marked.png"
    for path, rest in (alone, ()), (marked, (mesh, marks)):
        plotter = pyvista.Plotter(off_screen=True)
        plotter.camera_position = [(4.0, -7.0, 5.0), (0.0, 0.0, 0.0), (0.0, 0.0, 1.0)]
        riis.plot(surface, *rest, screenshot=path, plotter=plotter).close()
    pictures = [numpy.asarray(pyvista.read(path).active_scalars)[:, :3].astype(int) for path in (alone, marked)]
    background = pictures[0][0]
    drawn = [numpy.count_nonzero((picture != background).any(axis=1)) for picture in pictures]
    assert drawn[0] > 10_000 and drawn[1] > 1.1 * drawn[0]  # the band is wider than the leaflets
    # The nodes are visible, in the colours of the bar, also in front of the leaflets.
    plasma = pyvista.LookupTable("plasma").values[:, :3].astype(int)
    for is_leaflet in (pictures[0] == background).all(axis=1), (pictures[0] != background).any(axis=1):
        seen = numpy.unique(pictures[1][is_leaflet], axis=0, return_counts=True)
        is_of_bar = (abs(seen[0][:, None] - plasma[None]).sum(axis=2) <= 3).any(axis=1)
        assert seen[1][is_of_bar].sum() > len(marks)
    with pytest.raises(riis.InvalidArgumentError, match="marks: must be given together with mesh"):
        riis.plot(surface, mesh)


def test_nodes_of_another_mesh_are_not_drawn(surface, mesh, marks, xyz, tmp_path):
    text = "^marks: do not belong to mesh as it is now; pass the mesh that riis.mark took, and mark again after its updates$"
    refused = pytest.raises(riis.InvalidArgumentError, match=text)
    others = riis.Mesh(xyz[::-1].copy()), riis.Mesh(xyz[: len(xyz) // 2].copy())
    for other in others:
        with refused:
            riis.plot(surface, other, marks, screenshot=tmp_path / "valve.png")
        with refused:
            riis.animate(tmp_path / "valve.gif", [(surface, marks)], other)
    with refused:
        riis.plot(surface, mesh, riis.Marks(), screenshot=tmp_path / "valve.png")
    moved = riis.Mesh(xyz.copy())
    riis.mark(surface, moved, into=marks)
    moved.xyz[:] += 1.0
    moved.update()
    with refused:
        riis.plot(surface, moved, marks, screenshot=tmp_path / "valve.png")
    assert not list(tmp_path.iterdir())
    riis.mark(surface, moved, into=marks)
    riis.plot(surface, moved, marks, screenshot=tmp_path / "valve.png").close()
    assert (tmp_path / "valve.png").is_file()


def pixels_of(path):
    """Returns the colours of a picture, (height, width, 3), the lowest row first."""
    data = pyvista.read(path)
    return numpy.asarray(data.active_scalars)[:, :3].astype(int).reshape(data.dimensions[1], data.dimensions[0], 3)


def test_a_picture_without_marks_says_so_and_shows_the_mesh(surface, tmp_path):
    far = riis.Mesh(numpy.random.default_rng(2).uniform(6.0, 9.0, (5000, 3)))
    marks = riis.mark(surface, far, allow_none=True)
    plotter = riis.plot(surface, far, marks, screenshot=tmp_path / "none.png")
    note = plotter.renderer.actors["riis notes"].GetInput()
    assert note.startswith("0 of 5,000 nodes are marked\nThe valve is 4 long, the mesh 3; riis.mark names")
    assert numpy.allclose(plotter.renderer.actors["riis box"].bounds, numpy.stack([far.xyz.min(0), far.xyz.max(0)], 1).ravel())
    picture = pixels_of(tmp_path / "none.png")
    height, width = picture.shape[:2]
    words = (picture[-height // 12 :, : 2 * width // 3] != picture[-1, -1]).any(axis=2)
    assert words.sum() > 200 and not words[:, : width // 60].any()  # the letters, not at the edge
    # The same plotter draws a marking that has marks. The words and the box are gone.
    near = riis.Mesh(1.4 * (far.xyz - 7.5))
    riis.plot(surface, near, riis.mark(surface, near), screenshot=tmp_path / "some.png", plotter=plotter)
    assert not {"riis notes", "riis box"} & set(plotter.renderer.actors)
    plotter.close()
    axes = [numpy.linspace(6.0, 9.0, n) for n in (11, 12, 13)]
    grid = riis.Mesh.grid(*axes)
    plotter = riis.plot(surface, grid, riis.mark(surface, grid, allow_none=True), screenshot=tmp_path / "grid.png")
    assert plotter.renderer.actors["riis notes"].GetInput().startswith("0 of 1,716 nodes are marked\n")
    plotter.close()


@pytest.mark.parametrize("make", [
    lambda: pyvista.CylinderStructured(
        radius=numpy.linspace(0.1, 2.2, 12), height=9.0, direction=(0, 0, 1)).cast_to_unstructured_grid(),
    lambda: pyvista.ImageData(dimensions=(9, 9, 9), spacing=(0.6,) * 3, origin=(-2.4,) * 3),
    lambda: pyvista.Cylinder(radius=2.2, height=9.0, direction=(0, 0, 1))])
def test_a_grid_is_a_shell_around_the_valve(make, surface, mesh, marks, tmp_path):
    grid = make()
    alone = riis.plot(surface, mesh, marks, screenshot=tmp_path / "alone.png")
    plotter = riis.plot(surface, mesh, marks, grid=grid, screenshot=tmp_path / "valve.png")
    shell = plotter.renderer.actors["riis grid"]
    assert numpy.allclose(shell.bounds, grid.bounds) and 0.1 < shell.prop.opacity < 0.3
    assert numpy.allclose(plotter.camera.focal_point, (surface.info.lower + surface.info.upper) / 2.0)
    pictures = [pixels_of(tmp_path / name) for name in ("alone.png", "valve.png")]
    # The whole grid is in the picture, beside the colour bar. A much longer grid is cut off, so that the valve stays large.
    drawn = (pictures[1] != pictures[1][0, 0]).any(axis=2)
    height, width = drawn.shape
    assert not (drawn[:, : width // 100].any() or drawn[-height // 100 :].any() or drawn[:, -width // 100 :].any())
    assert not drawn[: height // 12, width // 2 :].any() and not drawn[:, int(0.863 * width) : int(0.868 * width)].any()
    distances = []
    for length in 1.0, 100.0:
        longer = grid.cast_to_unstructured_grid().scale((1.0, 1.0, length))
        one = riis.plot(surface, mesh, marks, grid=longer, screenshot=tmp_path / "longer.png")
        distances.append(one.camera.distance * numpy.tan(numpy.radians(one.camera.view_angle / 2.0)))
        one.close()
    assert 0.1 < distances[1] / distances[0] < 1.5
    assert numpy.mean((pictures[1] != pictures[1][0, 0]).any(axis=2)) > 0.1
    assert numpy.count_nonzero((pictures[0] != pictures[1]).any(axis=2)) > 10_000
    alone.close()
    plotter.close()
    # Without marks, the camera shows both the valve and the mesh.
    far = grid.translate((40.0, 0.0, 0.0))
    beside = riis.Mesh(numpy.ascontiguousarray(far.points, float))
    none = riis.mark(surface, beside, allow_none=True)
    with pytest.warns(riis.MarksWarning, match="^grid: reaches from .* and the surface from .* Is grid in another unit"):
        plotter = riis.plot(surface, beside, none, grid=far, screenshot=tmp_path / "beside.png")
    data = pixels_of(tmp_path / "beside.png")
    note = plotter.renderer.actors["riis notes"].GetInput()
    assert note.endswith("The grid does not surround the valve: is it in another unit?")
    seen = (data != data[-1, -1]).any(axis=2)
    assert not seen[:, : width // 100].any() and not seen[:, -width // 100 :].any() and seen.sum() > 5_000
    plotter.close()


def test_marks_of_an_earlier_surface_are_not_drawn(valve, mesh, tmp_path):
    surface = riis.Surface(valve, half_thickness=0.15)
    marks = riis.mark(surface, mesh)
    riis.plot(riis.Surface(valve, half_thickness=0.15), mesh, marks, screenshot=tmp_path / "same.png").close()  # the same shape
    surface.update(valve, half_thickness=0.2)
    with pytest.raises(riis.InvalidArgumentError, match="^marks: were made with the half thickness 0.15, and surface .* 0.2;"):
        riis.plot(surface, mesh, marks, screenshot=tmp_path / "never.png")
    riis.mark(surface, mesh, into=marks)
    valve["opening"] = 0.9
    surface.update(valve)
    for draw in (lambda: riis.plot(surface, mesh, marks, screenshot=tmp_path / "never.png"),
                 lambda: riis.animate(tmp_path / "never.gif", [(surface, marks)], mesh)):
        with pytest.raises(riis.InvalidArgumentError, match="^marks: do not belong to surface as it is now; pass the surface"):
            draw()
    assert sorted(path.name for path in tmp_path.iterdir()) == ["same.png"]


def test_a_picture_tells_of_leaking_edges_and_of_a_valve_outside(tmp_path):
    points, cells = tube.mesh(12, 1.4, 5.0)
    grid = pyvista.UnstructuredGrid({pyvista.CellType.TETRA: cells}, points)
    mesh = riis.Mesh(points)
    with_edges = riis.Mesh(points)
    with_edges.set_adjacency(riis.Adjacency.from_cells(cells, len(points)))
    surface = riis.Surface(riis.Valve("coapting", annulus=2.8), half_thickness=0.13)
    marks = riis.mark(surface, mesh, allow_none=True)
    n_leaks = riis.find_leaks(surface, with_edges, marks).n_edges
    assert n_leaks > 1
    advice = f"^{n_leaks} edges of the mesh cross .* Try riis.Surface\\(valve, half_thickness=0"
    with pytest.warns(riis.MarksWarning, match=advice) as found:
        plotter = riis.plot(surface, mesh, marks, grid=grid, screenshot=tmp_path / "leaks.png")
    half = float(str(found[0].message).split("=")[1].rstrip(")"))
    assert f"half_thickness={half:g} closes them" in plotter.renderer.actors["riis notes"].GetInput().replace("\n", " ")
    plotter.close()
    for opening in 0.0, 0.4, 1.0:
        surface.update(riis.Valve("coapting", annulus=2.8, opening=opening), half_thickness=half)
        assert riis.find_leaks(surface, with_edges, riis.mark(surface, with_edges)).n_edges == 0
    plotter = riis.plot(surface, mesh, riis.mark(surface, mesh), grid=grid, screenshot=tmp_path / "fine.png")
    assert "riis notes" not in plotter.renderer.actors
    plotter.close()
    wide = riis.Surface(riis.Valve("mitral", opening=0.2), half_thickness=0.3)
    marks = riis.mark(wide, mesh, allow_none=True)
    plotter = riis.plot(wide, mesh, marks, grid=grid, screenshot=tmp_path / "wide.png")
    assert " % of the leaflets' area is outside the mesh" in plotter.renderer.actors["riis notes"].GetInput()
    plotter.close()


def test_the_colour_bar_has_the_unit(surface, mesh, marks, tmp_path):
    plotter = riis.plot(surface, mesh, marks, unit="mm", screenshot=tmp_path / "mm.png")
    assert list(plotter.scalar_bars.keys()) == ["distance\nin mm\n"]
    riis.plot(surface, mesh, marks, screenshot=tmp_path / "none.png", plotter=plotter)
    assert list(plotter.scalar_bars.keys()) == ["distance\n"]
    plotter.close()


def test_objects_of_other_types_are_refused(surface, mesh, marks, tmp_path):
    grid = pyvista.ImageData(dimensions=(3, 3, 3))
    for text, arguments, options in (
        ("surface: must be a riis.Surface, not PolyData", (surface.to_pyvista(),), {}),
        ("mesh: must be the riis.Mesh of the marking, not ImageData; grid= takes a mesh of PyVista", (surface, grid, marks), {}),
        ("marks: must be a riis.Marks, not ndarray", (surface, mesh, marks.ids), {}),
        ("grid: must be a mesh of PyVista, such as an UnstructuredGrid, not Mesh", (surface, mesh, marks), {"grid": mesh}),
    ):
        with pytest.raises(TypeError, match=f"^{text}$"):
            riis.plot(*arguments, **options, screenshot=tmp_path / "never.png")
    with pytest.raises(TypeError, match="^grid: must be a mesh of PyVista, such as an UnstructuredGrid, not Mesh$"):
        riis.animate(tmp_path / "never.gif", [(surface, marks)], mesh, grid=mesh)
    with pytest.raises(TypeError, match="^mesh: must be the riis.Mesh of the marking, not ImageData"):
        riis.animate(tmp_path / "never.gif", [(surface, marks)], grid)
    assert not list(tmp_path.iterdir())


def test_a_picture_without_a_display_prints_no_error(tmp_path):
    if not _plot._egl_works():
        pytest.skip("EGL is missing")
    program = "import riis; riis.plot(riis.Surface(riis.Valve('mitral')), screenshot='valve.png')"
    without = {name: value for name, value in os.environ.items() if name not in ("DISPLAY", "VTK_DEFAULT_OPENGL_WINDOW")}
    done = subprocess.run(
        [sys.executable, "-B", "-c", program], cwd=tmp_path, env=without, capture_output=True, text=True, check=True)
    assert done.stdout == "" and "DISPLAY" not in done.stderr and (tmp_path / "valve.png").stat().st_size > 10_000


def test_a_new_picture_looks_at_the_whole_valve(surface, tmp_path):
    riis.plot(surface, screenshot=tmp_path / "valve.png").close()
    data = pyvista.read(tmp_path / "valve.png")
    picture = numpy.asarray(data.active_scalars)[:, :3].astype(int).reshape(data.dimensions[1], data.dimensions[0], 3)
    drawn = (picture != picture[0, 0]).any(axis=2)
    assert drawn.mean() > 0.1
    assert not (drawn[0].any() or drawn[-1].any() or drawn[:, 0].any() or drawn[:, -1].any())


@pytest.mark.parametrize("parallel, zoom, unit", [(True, 1.0, "mm"), (False, 1.0, ""), (False, 3.7, "cm"), (True, 0.02, None)])
def test_a_scale_bar_is_as_long_as_it_says(parallel, zoom, unit, surface, tmp_path):
    """The renderer projects a length at the camera's focal point. The line in the picture is as long as this projection."""
    plotter = pyvista.Plotter(off_screen=True, window_size=(700, 500))
    plotter.camera_position = [(4.0, -7.0, 5.0), (0.3, 0.2, 0.1), (0.0, 0.0, 1.0)]
    plotter.camera.parallel_projection = parallel
    plotter.camera.zoom(zoom)
    riis.plot(surface, screenshot=tmp_path / "valve.png", plotter=plotter, unit=unit)
    bars = [prop for prop in plotter.renderer.GetViewProps() if hasattr(prop, "GetInput")]
    assert len(bars) == 1
    number, words = bars[0].GetInput().split(" ", 1)
    assert words == (unit or ("mesh unit" if number == "1" else "mesh units"))
    assert float(number) == pytest.approx(float(f"{float(number):.0e}")) and number.strip("0.")[0] in "125"
    data = pyvista.read(tmp_path / "valve.png")
    picture = numpy.asarray(data.active_scalars)[:, :3].astype(int).reshape(data.dimensions[1], data.dimensions[0], 3)
    corner = picture[:50, :350]  # rows count from the lower edge; leaflets and background are not of this grey
    is_grey = (corner.max(axis=2) - corner.min(axis=2) < 20) & (corner.max(axis=2) < 200)
    lengths = [max((len(run) for run in "".join("x" if at else " " for at in row).split()), default=0) for row in is_grey]
    camera = plotter.camera
    forward = numpy.subtract(camera.focal_point, camera.position)
    across = numpy.cross(forward, camera.up)
    ends = []
    for shift in (0.0, float(number)):
        point = numpy.array(camera.focal_point) + shift * across / numpy.linalg.norm(across)
        plotter.renderer.SetWorldPoint(*point, 1.0)
        plotter.renderer.WorldToDisplay()
        ends.append(plotter.renderer.GetDisplayPoint()[0])
    assert max(lengths) == pytest.approx(ends[1] - ends[0], abs=3.0) and 50 < max(lengths) < 190
    # Another picture by the same plotter has one bar, even after the plotter was cleared.
    riis.plot(surface, screenshot=tmp_path / "again.png", plotter=plotter, unit=unit)
    assert len([prop for prop in plotter.renderer.GetViewProps() if hasattr(prop, "GetInput")]) == 1
    plotter.clear()
    riis.plot(surface, screenshot=tmp_path / "again.png", plotter=plotter, unit="m")
    assert [prop.GetInput().split()[-1] for prop in plotter.renderer.GetViewProps() if hasattr(prop, "GetInput")] == ["m"]
    plotter.close()
    with pytest.raises(TypeError, match="unit: must be a text such as 'mm', or None, not 3"):
        riis.plot(surface, unit=3, screenshot=tmp_path / "never.png")
    assert not (tmp_path / "never.png").exists()


def beat(n_frames):
    """Yields a valve that opens, always as the same objects."""
    valve = riis.Valve("mitral")
    surface, marks = riis.Surface(valve), riis.Marks()
    mesh = riis.Mesh(numpy.random.default_rng(1).uniform(-2.0, 2.0, (20_000, 3)))
    yield mesh
    for i in range(n_frames):
        valve["opening"] = i / (n_frames - 1)
        surface.update(valve)
        riis.mark(surface, mesh, into=marks)
        yield surface, marks, f"opening {valve['opening']:.1f}"


def test_a_movie_shows_the_grid(tmp_path):
    imageio = pytest.importorskip("imageio.v3", reason="imageio is missing; ./run python installs it")
    mesh, pictures = next(beat(1)), []
    grid = pyvista.Cylinder(radius=2.2, height=6.0, direction=(0, 0, 1))
    for shell in None, grid:
        frames = beat(2)
        next(frames)
        riis.animate(tmp_path / "beat.gif", ((surface, None, words) for surface, _, words in frames), mesh, grid=shell, unit="cm")
        pictures.append(imageio.imread(tmp_path / "beat.gif", index=1)[..., :3].astype(int))
    shells = [(numpy.ptp(picture, axis=2) < 12) & (abs(picture[:, :, 0] - 215) < 35) for picture in pictures]
    assert shells[0].mean() < 0.01 and shells[1].mean() > 0.1  # grey and translucent
    rows = (pictures[1] != pictures[1][0, 0]).any(axis=2)
    assert not (rows[:3].any() or rows[-3:].any() or rows[:, :3].any() or rows[:, -3:].any())  # nor is the caption at the edge


@pytest.mark.parametrize("kind", ["gif", "mp4"])
def test_a_movie_has_every_frame(kind, tmp_path):
    imageio = pytest.importorskip("imageio.v3", reason="imageio is missing; ./run python installs it")
    pytest.importorskip("imageio_ffmpeg", reason="imageio-ffmpeg is missing; ./run python installs it")
    frames = beat(3)
    assert riis.animate(tmp_path / f"beat.{kind}", frames, next(frames), frame_rate=numpy.array(4)) == 3
    pictures = [picture[..., :3].astype(int) for picture in imageio.imiter(tmp_path / f"beat.{kind}")]
    assert len(pictures) == 3 and pictures[0].shape[:2] == (576, 768)
    for one, other in zip(pictures, pictures[1:]):
        assert numpy.count_nonzero(abs(one - other).max(axis=2) > 60) > 5_000  # the leaflets move


def test_an_animation_takes_bare_surfaces_and_a_plotter_of_the_callers(surface, tmp_path):
    pytest.importorskip("imageio", reason="imageio is missing; ./run python installs it")
    plotter = pyvista.Plotter(off_screen=True, window_size=(320, 240))
    plotter.camera_position = "xy"
    assert riis.animate(tmp_path / "valve.gif", [surface, (surface, None)], plotter=plotter) == 2
    assert pyvista.read(tmp_path / "valve.gif").dimensions[:2] == (320, 240)


@pytest.mark.parametrize(
    "kind, text, arguments",
    [
        (riis.InvalidArgumentError, "path: 'beat.avi' must end in .gif or .mp4", {"path": "beat.avi"}),
        (TypeError, "frame_rate: must be a number, not '4'", {"frame_rate": "4"}),
        (TypeError, "frame_rate: must be a number, not \\[4\\]", {"frame_rate": [4]}),
        (riis.InvalidArgumentError, "frame_rate: is 0; it must be above 0", {"frame_rate": 0}),
        (riis.InvalidArgumentError, "frames: has no frame", {"frames": []}),
        (TypeError, "frames: frame 0 must be a Surface, .*, not 3", {"frames": [3]}),
        (TypeError, "frames: frame 1 must be a Surface", {"frames": ["surface", ("surface", "marks", 5)]}),
        (TypeError, "frames: frame 0 must be a Surface", {"frames": [("surface", "marks", "text", 5)]}),
        (riis.InvalidArgumentError, "mesh: is None, but frame 1", {"frames": ["surface", ("surface", "marks")]}),
        (ZeroDivisionError, "in the loop", {"frames": "fails"}),
    ],
)
def test_refused_animations_leave_no_file(kind, text, arguments, surface, marks, tmp_path, monkeypatch):
    pytest.importorskip("imageio", reason="imageio is missing; ./run python installs it")
    monkeypatch.chdir(tmp_path)

    def fails():
        yield surface
        raise ZeroDivisionError("in the loop")

    def real(item):
        return {"surface": surface, "marks": marks}.get(item, item) if isinstance(item, str) else item

    given = {"path": "beat.gif", "frames": ["surface"], **arguments}
    if given["frames"] == "fails":
        frames = fails()
    else:
        frames = [tuple(map(real, item)) if isinstance(item, tuple) else real(item) for item in given["frames"]]
    with pytest.raises(kind, match=text):
        riis.animate(given["path"], frames, frame_rate=given.get("frame_rate", 12))
    assert not list(tmp_path.iterdir())
