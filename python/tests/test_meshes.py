# SPDX-License-Identifier: Apache-2.0
"""Adjacency, leaks, open regions and passages."""

import pickle

import numpy
import pytest

import riis


def rows(adjacency):
    return [adjacency.columns[a:b].tolist() for a, b in zip(adjacency.offsets[:-1], adjacency.offsets[1:])]


@pytest.mark.parametrize("dtype", ["i4", "i8"])
def test_adjacencies_of_cells_faces_and_grids(dtype):
    tetrahedra = numpy.array([[0, 1, 2, 3], [1, 2, 3, 4]], dtype)
    adjacency = riis.Adjacency.from_cells(tetrahedra, 5)
    assert rows(adjacency) == [[1, 2, 3], [0, 2, 3, 4], [0, 1, 3, 4], [0, 1, 2, 4], [1, 2, 3]]
    assert adjacency.offsets.dtype == numpy.int64 and adjacency.columns.dtype == numpy.int32 and len(adjacency) == 5
    mixed = riis.Adjacency.from_cells(tetrahedra.ravel() + 1, 5, offsets=numpy.array([0, 4, 8], dtype), index_base=1)
    assert rows(mixed) == rows(adjacency)
    faces = riis.Adjacency.from_faces(numpy.array([0, 1, 2], dtype), numpy.array([1, 2, -1], dtype), 3)
    assert rows(faces) == [[1], [0, 2], [1]]
    assert rows(riis.Adjacency.from_grid(2, 2, 1)) == [[1, 2], [0, 3], [0, 3], [1, 2]]
    assert repr(faces) == "<riis.Adjacency, 3 rows>"


def test_a_grid_marks_the_nodes_of_its_points(surface):
    x, y, z = numpy.linspace(-2, 2, 41), numpy.linspace(-1.9, 2, 38), numpy.sort(numpy.linspace(-1.4, 1.4, 35) ** 3)
    points = numpy.stack(numpy.meshgrid(x, y, z, indexing="ij"), axis=-1).reshape(-1, 3)
    expected = riis.mark(surface, riis.Mesh(points), R=3.0)
    mesh = riis.Mesh.grid(x, y, z)
    marks = riis.mark(surface, mesh, R=3.0)
    assert len(expected) > 100 and numpy.array_equal(marks.ids, expected.ids)
    assert numpy.array_equal(marks.distance, expected.distance) and numpy.array_equal(marks.K, expected.K)
    assert len(mesh) == mesh.n_nodes == 41 * 38 * 35 and repr(mesh) == "<riis.Mesh, grid of 41 x 38 x 35 nodes>"
    assert mesh.axes[1] is y
    K = numpy.zeros((len(x), len(y), len(z)))
    K.reshape(-1)[marks.ids] = marks.K
    i, j, k = numpy.unravel_index(K.argmax(), K.shape)
    assert surface.closest_point([x[i], y[j], z[k]]).distance == marks.distance[marks.K.argmax()]

    # A halo of one node, in Fortran's order.
    stride = numpy.array([1, 43, 43 * 40])
    mesh.update_grid(x, y, z, first=int(stride.sum()), stride=stride, n_nodes=43 * 40 * 37)
    riis.mark(surface, mesh, into=marks)
    index = numpy.unravel_index(expected.ids, K.shape)
    assert numpy.array_equal(numpy.sort(stride.sum() + stride @ numpy.array(index)), marks.ids) and len(mesh) == 43 * 40 * 37
    mesh.update(points)
    riis.mark(surface, mesh, into=marks)
    assert numpy.array_equal(marks.ids, expected.ids) and mesh.xyz is points and not hasattr(mesh, "axes")


def test_grids_are_refused_by_name(surface):
    x = numpy.linspace(-1, 1, 5)
    mesh = riis.Mesh.grid(x, x, x)
    with pytest.raises(riis.InvalidMeshError, match=r"^y\[1\] is 0.5, after 1; the axis must strictly ascend$"):
        riis.Mesh.grid(x, x[::-1].copy(), x)
    with pytest.raises(riis.InvalidArgumentError, match=r"^stride\[1\] is 4; it must be above 4,"):
        riis.Mesh.grid(x, x, x, stride=numpy.array([1, 4, 25]))
    with pytest.raises(riis.InvalidArgumentError, match="search is 'neighbor', which needs memory for each node"):
        riis.mark(surface, mesh, search="neighbor")
    with pytest.raises(riis.InvalidArgumentError, match="xyz: must be given, because the mesh is a grid"):
        mesh.update()
    with pytest.raises(AttributeError, match="a grid stores no coordinates of nodes"):
        mesh.xyz
    assert len(riis.mark(surface, mesh).within_limit.ids) >= 0


class Rows:
    """Sparse rows with the same attributes as scipy's."""

    def __init__(self, adjacency, dtype):
        self.indptr, self.indices = adjacency.offsets.astype(dtype), adjacency.columns.astype(dtype)


def test_rows_of_the_caller_give_the_same_marks(surface, grid):
    adjacency = riis.Adjacency.from_grid(41, 41, 41)
    expected = riis.mark(surface, grid, search="neighbor").ids.copy()
    for dtype in numpy.int32, numpy.int64:
        sparse = Rows(adjacency, dtype)
        grid.set_adjacency(sparse)
        assert numpy.array_equal(riis.mark(surface, grid, search="neighbor").ids, expected)
        grid.set_adjacency(offsets=sparse.indptr + 1, columns=sparse.indices + 1, index_base=1)
        del sparse
        assert numpy.array_equal(riis.mark(surface, grid, search="neighbor").ids, expected)
    grid.set_adjacency()
    with pytest.raises(riis.InvalidArgumentError):
        riis.mark(surface, grid, search="neighbor")


def test_an_adjacency_goes_with_the_number_of_nodes(surface, grid):
    grid.update(numpy.zeros((5, 3)))
    assert len(grid) == 5 and repr(grid) == "<riis.Mesh, 5 nodes>"
    with pytest.raises(riis.InvalidArgumentError):
        riis.mark(surface, grid, search="neighbor")


def plate(half_thickness):
    """Makes a square plate at z = 0.03 that divides a grid of spacing 0.1."""
    corners = numpy.array([[-3, -3, 0.03], [3, -3, 0.03], [3, 3, 0.03], [-3, 3, 0.03]])
    return riis.Surface.from_arrays(corners, numpy.array([[0, 1, 2, 3]]), half_thickness=half_thickness)


def test_leaks_regions_and_passages_tell_the_same(grid):
    n = 41
    below, above = numpy.array([0]), numpy.array([n**3 - 1])
    tight, loose = plate(0.06), plate(0.02)
    marks = riis.mark(tight, grid)
    assert len(marks) == n * n
    none = riis.find_leaks(tight, grid, marks)
    assert none.n_edges == 0 and none.node_id.shape == (0, 2) and none.longest_node_id.tolist() == [-1, -1]
    label, n_regions = riis.label_open_regions(grid, marks)
    assert n_regions == 2 and set(label) == {-1, 0, 21 * n * n} and (label[marks.ids] == -1).all()
    passage = riis.find_passage(tight, grid, below, above)
    assert passage.state == "closed" and numpy.isclose(passage.distance, 0.03)
    with pytest.warns(riis.MarksWarning, match="The half thickness is 0.02, and the nodes are about 0.1 apart"):
        riis.mark(loose, grid, into=marks)
    assert len(marks) == 0
    leaks = riis.find_leaks(loose, grid, marks)
    assert leaks.n_edges == n * n and numpy.isclose(leaks.longest_length, 0.1) and numpy.isclose(leaks.half_thickness, 0.03)
    assert leaks.node_id.shape == (n * n, 2) and numpy.allclose(leaks.length, 0.1) and numpy.allclose(leaks.distance, 0.03)
    given = numpy.empty(n**3, numpy.int64)
    same, n_regions = riis.label_open_regions(grid, marks, label=given)
    assert same is given and n_regions == 1 and not given.any()
    assert riis.find_passage(loose, grid, below, above).state == "open"
    mask = numpy.ones(n**3, bool)
    mask[20 * n * n : 21 * n * n] = False
    assert riis.find_passage(loose, grid, below, above, mask=mask).state == "none"


def test_a_skirt_reaches_a_wall():
    """The wall is a box around a trileaflet valve. The gap to its sides is known."""
    corners = numpy.array([[x, y, z] for z in (-4.0, 4.0) for x, y in ((2, 2), (-2, 2), (-2, -2), (2, -2))])
    faces = numpy.array([[i, (i + 1) % 4, (i + 1) % 4 + 4, i + 4] for i in range(4)])
    wall = riis.Surface.from_arrays(corners, faces)
    valve = riis.Valve("trileaflet")
    bare = riis.Surface(valve)
    gap = bare.gap(wall)
    ends = bare.attachment.edges
    radius, largest = numpy.hypot(ends[..., 0], ends[..., 1]), numpy.abs(ends[..., :2]).max(axis=-1)
    assert numpy.allclose(gap.distance, radius * (2 / largest - 1), rtol=1e-12)
    assert gap.least == gap.distance.min() and gap.most == gap.distance.max() and gap.n_without_wall == 0
    assert gap.least < gap.mean < gap.most and gap.widest_point.shape == (3,)
    valve.skirt_to_wall(wall, 3.0)
    assert gap.most - 0.01 < valve["skirt_length"] < 8**0.5 - radius.min()  # a corner lies between two ends of edges
    reaching = riis.Surface(valve)
    assert [leaflet.leaflet_id for leaflet in reaching.leaflets()] == [0, 1, 2, 3]
    assert abs(numpy.abs(reaching.vertices[:, :2]).max() - 2) < 0.02
    assert reaching.orifice().area == bare.orifice().area
    assert numpy.array_equal(riis.Surface(valve.copy()).vertices, reaching.vertices)
    with pytest.raises(riis.InvalidArgumentError, match="cannot be pickled"):
        pickle.dumps(valve)
    valve["skirt_length"] = 0.0
    assert len(riis.Surface(valve).leaflets()) == 3
    assert pickle.loads(pickle.dumps(valve))["skirt_length"] == 0.0


def test_outlines_and_contacts_of_arrays():
    """Two squares lie beside each other in the plane z = 0, a little apart."""
    square = numpy.array([[0.0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]])
    xyz = numpy.concatenate([square, square + [1.02, 0, 0]])
    faces = numpy.array([[0, 1, 2, 3], [4, 5, 6, 7]])
    surface = riis.Surface.from_arrays(xyz, faces, leaflet_id=numpy.array([0, 1], dtype=numpy.int32))
    orifice = surface.orifice()
    # Straight lines join the squares.
    assert orifice.outline == "boundary" and abs(orifice.outline_area - 2.02) < 1e-9
    assert numpy.allclose(orifice.axis, [0, 0, 1])
    contact = surface.coaptation(reach=0.1)
    assert abs(contact.area - 2 * 0.08) < 1e-4 and contact.reach == 0.1
    assert abs(surface.coaptation(0, reach=0.1).area - 0.08) < 1e-4
    assert surface.coaptation(reach=0.01).area == 0
    tall = numpy.array([[-1.0, -1, z] for z in (-1, 1)] + [[3.0, -1, z] for z in (-1, 1)])
    wide = numpy.concatenate([tall, tall[2:] + [0, 3, 0], tall[:2] + [0, 3, 0]])
    sides = numpy.array([[2 * i, 2 * i + 1, (2 * i + 3) % 8, (2 * i + 2) % 8] for i in range(4)])
    inside = surface.orifice(wall=riis.Surface.from_arrays(wide, sides))
    assert inside.outline == "wall" and abs(inside.outline_area - 12) < 1e-9 and abs(inside.area - 10) < 1e-2


def test_what_a_valve_means_for_the_flow():
    """The mesh is a box that the valve fills, with nodes 0.1 apart."""
    valve = riis.Valve("trileaflet", opening=1.0)
    surface = riis.Surface(valve)
    orifice = surface.orifice()
    assert orifice.outline == "attachment" and numpy.pi * 1.25**2 < orifice.outline_area < numpy.pi * 1.35**2
    assert 3.8 < orifice.area < 4.0 and 0 < orifice.effective_area < orifice.area
    placed = riis.Surface(valve, scale=2.0, rotation_axis=(1.0, 2.0, 3.0), rotation_angle=40.0).orifice()
    assert numpy.isclose(placed.area, 4 * orifice.area, rtol=1e-5)
    assert numpy.isclose(placed.perimeter, 2 * orifice.perimeter, rtol=1e-2)
    leaflets = surface.leaflets()
    assert [leaflet.leaflet_id for leaflet in leaflets] == [0, 1, 2]
    area = sum(leaflet.area for leaflet in leaflets)
    assert numpy.isclose(area, surface.info.area)
    assert numpy.isclose(surface.leak(50.0, R=10.0), 50 * 0.1 / 10 * area)
    volume = valve.swept_volume(0.0, 1.0)
    assert numpy.isclose(valve.swept_volume(0.0, 1.0, leaflet_id=1, scale=2.0), 8 * volume / 3)
    assert valve.swept_volume(1.0, 0.0, n_threads=2) == -volume

    sides = [numpy.arange(-8, 9) / 10, numpy.arange(-8, 9) / 10, numpy.arange(-20, 21) / 10]
    z, y, x = numpy.meshgrid(sides[2], sides[1], sides[0], indexing="ij")
    mesh = riis.Mesh(numpy.stack([x.ravel(), y.ravel(), z.ravel()], axis=1))
    mesh.set_adjacency(riis.Adjacency.from_grid(17, 17, 41))
    below, above = numpy.array([144]), numpy.array([17 * 17 * 40 + 144])
    cells = riis.mark(surface, mesh).cells_across(mesh)
    assert numpy.allclose(cells[:3], 2) and numpy.isclose(cells.mean_edge, 0.1) and cells.n_edges > 0
    first = riis.find_first_passage(valve, mesh, below, above, opening_tolerance=0.01, half_thickness=0.1)
    assert first.state == "found" and 0 < first.opening - first.closed_opening <= 0.01
    for opening, state in ((first.opening, "open"), (first.closed_opening, "closed")):
        valve["opening"] = opening
        assert riis.find_passage(riis.Surface(valve, half_thickness=0.1), mesh, below, above).state == state


@pytest.mark.parametrize("offset", [0.75, -0.6])
def test_edges_that_leak_with_an_offset(offset):
    """Random edges of 2 (1 - |o|) half thicknesses do not leak, and beside a sharp corner and a mitral valve no edges of 2
    sqrt(1 - o^2). Of edges of almost 2 half thicknesses, only some edges beside a rim leak: riis size-field shortens the edges
    there."""
    random, half, n, n_leaks = numpy.random.default_rng(59), 0.16, 50_000, 0
    options = {"half_thickness": half, "offset": offset}
    surfaces = [riis.Surface(riis.Valve(kind, opening=0.5), **options) for kind in ("trileaflet", "mitral")]
    spike = numpy.array([[-1.0, 0.0, 0.0], [1.0, -0.3, 0.0], [1.0, 0.3, 0.0]])
    surfaces.append(riis.Surface.from_arrays(spike, numpy.array([[0, 1, 2]]), **options))
    pairs = numpy.arange(2 * n) ^ 1  # nodes 2 k and 2 k + 1 are the ends of an edge
    for surface in surfaces:
        weights = random.dirichlet(numpy.ones(3), n)[:, :, None]
        triangles = surface.triangles.vertex_id[random.integers(surface.info.n_triangles, size=n)]
        crossed = (weights * surface.vertices[triangles]).sum(axis=1)
        along, part = random.normal(size=(n, 3)), random.uniform(size=(n, 1))
        along /= numpy.linalg.norm(along, axis=1, keepdims=True)
        sharp = 1.0 - abs(offset) if surface is surfaces[0] else (1.0 - offset**2) ** 0.5
        for length in (0.999 * 2.0 * sharp * half, 1.999 * half):
            ends = numpy.stack([crossed - part * length * along, crossed + (1.0 - part) * length * along], axis=1)
            mesh = riis.Mesh(ends.reshape(-1, 3))
            mesh.set_adjacency(offsets=numpy.arange(2 * n + 1), columns=pairs)
            marks = riis.mark(surface, mesh, fields="rim", distance_limit=3.0 * half)
            leaks = riis.find_leaks(surface, mesh, marks)
            assert leaks.n_edges == 0 or length > 1.9 * half
            n_leaks += leaks.n_edges
            is_beside_rim = numpy.zeros(2 * n, bool)
            is_beside_rim[marks.within_limit.ids[marks.within_limit.rim == 1]] = True
            assert is_beside_rim[leaks.node_id].any(axis=1).all()
    assert n_leaks > 3


def test_find_by_area():
    valve = riis.Valve("bileaflet")
    openings = numpy.array([0.0, 0.3, 0.8, 1.0])
    areas = []
    for opening in openings:
        valve["opening"] = opening
        areas.append(riis.Surface(valve).orifice().area if opening > 0 else 0.0)
    found = riis.find_by_area(valve, numpy.array(areas), n_samples=5)
    assert numpy.allclose(found.values, openings, rtol=0, atol=1e-5)
    assert numpy.allclose(found.reached[1:], areas[1:], rtol=1e-6)
    assert found.reached[0] == found.least
    assert found.least_at == 0.0
    assert found.most_at == 1.0
    assert found.n_turns == len(found.turns) == 0
    assert 5 <= found.n_surfaces < 40
    law = riis.OpeningTable(numpy.arange(4.0), found.values, interpolation="cubic")
    assert abs(law(1.0) - 0.3) < 1e-5
    assert law.rate(1.5) > 0.4
    scale = riis.find_by_area(valve, numpy.array([4 * areas[-1]]), name="scale", n_samples=3, scale=1.5).values
    assert abs(scale[0] - 2) < 1e-6
    narrow = riis.find_by_area(valve, numpy.array([1.0]), effective=True, rim="cut", from_=0.2, to=0.9, n_samples=5)
    assert found.values[0] < narrow.values[0] < 0.9


def test_areas_over_time_become_a_cycle():
    """The openings from the areas of a beat give these areas within 1e-6, with the fixed triangulation. With an offset, the
    effective areas are larger."""
    time = numpy.linspace(0.0, 0.3, 4)
    law = riis.OpeningTable(time, numpy.array([0.0, 0.35, 0.8, 0.0]))
    valve = riis.Valve("coapting")

    def measured(openings, **options):
        surface, areas = riis.Surface(valve, triangulation="fixed", **options), []
        for opening in openings:
            valve["opening"] = float(opening)
            surface.update(valve)
            areas.append(surface.orifice(rim="cut"))
        valve["opening"] = 0.0
        return areas

    areas = numpy.array([one.area for one in measured(law.opening)])
    found = riis.find_by_area(valve, areas, triangulation="fixed", n_samples=5)
    assert numpy.allclose(found.reached, areas, rtol=1e-6, atol=0.0)
    back = numpy.array([one.area for one in measured(found.values)])
    assert numpy.allclose(back, areas, rtol=1e-6, atol=1e-9 * areas.max())
    cycle = riis.OpeningTable(time, found.values)
    assert abs(cycle(0.1) - 0.35) < 1e-3 and cycle.rate(0.02) > 0.0 > cycle.rate(0.27)
    plain, aside = (measured([0.5], half_thickness=0.1, offset=offset)[0] for offset in (0.0, 0.75))
    assert plain.area == aside.area and plain.effective_area < aside.effective_area < aside.area
    again = riis.find_by_area(valve, numpy.array([aside.effective_area]), effective=True, rim="cut", triangulation="fixed",
                              half_thickness=0.1, offset=0.75, from_=0.4, to=0.6, n_samples=3)
    assert abs(again.values[0] - 0.5) < 1e-4


def test_a_mesh_gives_its_coordinates(xyz):
    assert riis.Mesh(xyz).xyz is xyz
    columns = [numpy.ascontiguousarray(xyz[:, i]) for i in range(3)]
    assert numpy.array_equal(riis.Mesh(*columns).xyz, xyz)
