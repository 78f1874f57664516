# SPDX-License-Identifier: Apache-2.0
"""Tests the cases of ./run svmultiphysics: examples/svmultiphysics/cases.py makes them from a duct of prisms whose volumes and
areas are known."""
import contextlib
import io
import math
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest
import xml.etree.ElementTree

SCRIPT = pathlib.Path(__file__).resolve().parents[3] / "examples/svmultiphysics/cases.py"
sys.path.insert(0, str(SCRIPT.parent))
import cases  # noqa: E402

SIDES, LAYERS = 8, 2
HEIGHT = cases.HIGH - cases.LOW
SECTOR = SIDES / 2 * math.sin(2 * math.pi / SIDES)  # the area of the polygon in a circle of radius 1
BLOCK = """<!-- a comment -->
<Add_URIS_mesh name="flat">
  <Positive_flow_normal_file_path> flat/normal.dat </Positive_flow_normal_file_path>
</Add_URIS_mesh>
"""


def duct():
    """Returns the text of a tube and its wall. Each layer consists of prisms, and each prism of three tetrahedra."""
    ring = [(radius * math.cos(2 * math.pi * i / SIDES), radius * math.sin(2 * math.pi * i / SIDES))
            for radius in (cases.RADIUS, cases.OUTER) for i in range(SIDES)]
    plane = [(0, 0), *ring]
    triangles = []
    for i in range(1, SIDES + 1):
        j = i % SIDES + 1
        triangles += [(0, i, j), (i, i + SIDES, j + SIDES), (i, j, j + SIDES)]
    places = [(x, y, cases.LOW + HEIGHT * layer / LAYERS) for layer in range(LAYERS + 1) for x, y in plane]
    cells = []
    for layer in range(LAYERS):
        for triangle in triangles:
            # With sorted corners, two prisms cut their common side along the same diagonal.
            a, b, c = (corner + layer * len(plane) for corner in sorted(triangle))
            up = len(plane)
            for cell in ((a, b, c, c + up), (a, b, b + up, c + up), (a, a + up, b + up, c + up)):
                cells.append(cell if volume([places[n] for n in cell]) > 0 else (cell[1], cell[0], *cell[2:]))
    return "\n".join(["$Nodes", str(len(places)), *(f"{i} {x:.17g} {y:.17g} {z:.17g}" for i, (x, y, z) in enumerate(places, 1)),
                      "$EndNodes", "$Elements", str(len(cells)),
                      *(f"{i} 4 2 1 1 " + " ".join(str(n + 1) for n in cell) for i, cell in enumerate(cells, 1)),
                      "$EndElements\n"])


def minus(a, b):
    return [p - q for p, q in zip(a, b)]


def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def volume(corners):
    a, b, c = (minus(corner, corners[0]) for corner in corners[1:4])
    return sum(p * q for p, q in zip(cross(a, b), c)) / 6


def area_vector(corners):
    return [value / 2 for value in cross(minus(corners[1], corners[0]), minus(corners[2], corners[0]))]


class Part:
    """A mesh or a face of the solver."""

    def __init__(self, path):
        piece = xml.etree.ElementTree.parse(path).getroot()[0][0]
        arrays = {array.get("Name"): array.text.split() for array in piece.iter("DataArray")}
        values = [float(word) for word in arrays["Points"]]
        self.places = [values[i:i + 3] for i in range(0, len(values), 3)]
        nodes, ends = [int(word) for word in arrays["connectivity"]], [int(word) for word in arrays["offsets"]]
        self.cells = [nodes[begin:end] for begin, end in zip([0, *ends], ends)]
        self.node_ids, self.element_ids = ([int(word) for word in arrays[f"Global{name}ID"]] for name in ("Node", "Element"))

    def corners(self):
        return [[self.places[n] for n in cell] for cell in self.cells]

    def volume(self):
        return sum(map(volume, self.corners()))

    def area(self):
        return sum(math.hypot(*area_vector(corners)) for corners in self.corners())


class Cases(unittest.TestCase):
    def setUp(self):
        held = tempfile.TemporaryDirectory()
        self.addCleanup(held.cleanup)
        self.folder = pathlib.Path(held.name)
        (self.folder / "duct.msh").write_text(duct(), encoding="ascii")
        (self.folder / "block.xml").write_text(BLOCK, encoding="utf-8")

    def write(self, kind, blocks=1):
        path = self.folder / kind
        with contextlib.redirect_stdout(io.StringIO()):
            cases.write(kind, self.folder / "duct.msh", path, "7", "200", "0.1", *[self.folder / "block.xml"] * blocks)
        root = xml.etree.ElementTree.parse(path / "solver.xml").getroot()
        self.assertEqual(root.findtext("GeneralSimulationParameters/Number_of_time_steps").strip(), "7")
        for entry in root.iter():
            if entry.tag in ("Mesh_file_path", "Face_file_path", "Temporal_values_file_path"):
                self.assertTrue((path / entry.text.strip()).is_file(), entry.text)
        return path, root

    def assert_faces(self, folder, areas):
        """The faces must have these areas, enclose the mesh, and name its nodes and elements."""
        mesh = Part(folder / "mesh.vtu")
        total = [0, 0, 0]
        for name, area in areas.items():
            face = Part(folder / f"{name}.vtp")
            self.assertAlmostEqual(face.area(), area, places=12)
            for number, place in zip(face.node_ids, face.places):
                self.assertEqual(mesh.places[number - 1], place)
            for number, cell in zip(face.element_ids, face.cells):
                self.assertLessEqual({face.node_ids[n] - 1 for n in cell}, set(mesh.cells[number - 1]))
            total = [t + sum(values) for t, values in zip(total, zip(*map(area_vector, face.corners())))]
        self.assertLess(math.hypot(*total), 1e-12)
        self.assertEqual({path.stem for path in folder.glob("*.vtp")}, set(areas))
        return mesh

    def side(self, radius):
        return 2 * SIDES * radius * math.sin(math.pi / SIDES) * HEIGHT

    def test_fluid(self):
        path, root = self.write("fluid", blocks=2)
        end = SECTOR * cases.OUTER ** 2
        mesh = self.assert_faces(path / "tube", {"low": end, "high": end, "wall": self.side(cases.OUTER)})
        self.assertAlmostEqual(mesh.volume(), end * HEIGHT, places=12)
        self.assertEqual({len(cell) for cell in mesh.cells}, {4})
        self.assertEqual(len(root.findall("Add_URIS_mesh")), 2)
        self.assertEqual([entry.get("type") for entry in root.findall("Add_equation")], ["fluid"])
        # The pressure is 200 cos(2 pi t / 0.1).
        head, *rows = [[float(word) for word in line.split()]
                       for line in (path / "pressure.dat").read_text(encoding="ascii").splitlines()]
        self.assertEqual(head[0], len(rows))
        for time, pressure in rows:
            self.assertAlmostEqual(pressure, 200 * math.cos(2 * math.pi * time / 0.1), places=6)
        self.assertEqual((rows[0][0], rows[-1][0]), (0, 0.1))

    def test_taylor_hood(self):
        path, root = self.write("taylor-hood")
        mesh = Part(path / "tube/mesh.vtu")
        self.assertAlmostEqual(mesh.volume(), SECTOR * cases.OUTER ** 2 * HEIGHT, places=12)
        for corners in mesh.corners():
            # VTK's order of the middles of a tetrahedron's edges
            for middle, (a, b) in zip(corners[4:], ((0, 1), (1, 2), (2, 0), (0, 3), (1, 3), (2, 3)), strict=True):
                for x, p, q in zip(middle, corners[a], corners[b]):
                    self.assertAlmostEqual(x, (p + q) / 2, places=14)
        wall = Part(path / "tube/wall.vtp")
        for corners in wall.corners():
            for middle, (a, b) in zip(corners[3:], ((0, 1), (1, 2), (2, 0)), strict=True):
                for x, p, q in zip(middle, corners[a], corners[b]):
                    self.assertAlmostEqual(x, (p + q) / 2, places=14)
        self.assertEqual(root.findtext("Add_equation/Use_taylor_hood_type_basis").strip(), "true")

    def test_elastic_tube(self):
        path, root = self.write("fsi")
        inner, outer = (SECTOR * radius ** 2 for radius in (cases.RADIUS, cases.OUTER))
        shared = self.side(cases.RADIUS)
        pipe = self.assert_faces(path / "pipe", {"low": inner, "high": inner, "side": shared})
        wall = self.assert_faces(path / "wall", {"low": outer - inner, "high": outer - inner, "inner": shared,
                                                 "outer": self.side(cases.OUTER)})
        self.assertAlmostEqual(pipe.volume(), inner * HEIGHT, places=12)
        self.assertAlmostEqual(wall.volume(), (outer - inner) * HEIGHT, places=12)
        # The pipe's side and the wall's inner side have the same nodes.
        sides = [sorted(Part(path / name).places) for name in ("pipe/side.vtp", "wall/inner.vtp")]
        self.assertEqual(*sides)
        self.assertEqual([entry.get("type") for entry in root.findall("Add_equation")], ["FSI", "mesh"])
        faces = {entry.get("name") for entry in root.iter("Add_face")}
        conditions = {entry.get("name") for entry in root.iter("Add_BC")}
        self.assertLess(conditions, faces)

    def test_scaffold(self):
        cases.scaffold(self.folder / "ring.vtu")
        ring = Part(self.folder / "ring.vtu")
        polygon = 36 / 2 * math.sin(2 * math.pi / 36)
        self.assertAlmostEqual(ring.area(), polygon * (cases.RADIUS ** 2 - 0.95 ** 2), places=12)
        self.assertEqual({math.copysign(1, area_vector(corners)[2]) for corners in ring.corners()}, {1})

    def test_scale(self):
        places = [(0.1, -2.5, 1 / 3), (7, 0, 1e-3)]
        text = "2 3\n" + "".join(" ".join(f"{x:.17g}" for x in place) + "\n" for place in places)
        valve = self.folder / "valve"
        valve.mkdir()
        for name in ("leaflet.dat", "normal.dat", "box.dat", "box.vtu"):
            (valve / name).write_text(text, encoding="ascii")
        cases.scale(valve, "10")
        self.assertEqual({path.name for path in valve.iterdir()}, {"leaflet.dat", "normal.dat"})
        self.assertEqual((valve / "normal.dat").read_text(encoding="ascii"), text)
        head, *rows = (valve / "leaflet.dat").read_text(encoding="ascii").splitlines()
        self.assertEqual(head, "2 3")
        for row, place in zip(rows, places, strict=True):
            for word, x in zip(row.split(), place, strict=True):
                self.assertAlmostEqual(10 * float(word), x, places=14)

    def test_words(self):
        for words in ([], ["ring"], ["tube", "0.3"], ["fsi", "duct.msh", "case", "7", "200", "0.1"]):
            done = subprocess.run([sys.executable, "-B", SCRIPT, *words], capture_output=True, text=True, check=False,
                                  cwd=self.folder, env=os.environ)
            self.assertEqual(done.returncode, 1)
            self.assertIn("Writes the cases of ./run svmultiphysics", done.stderr)


if __name__ == "__main__":
    unittest.main()
