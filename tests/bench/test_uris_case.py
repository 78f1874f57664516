# SPDX-License-Identifier: Apache-2.0
"""Tests the cases of svMultiPhysics by bench/peers/uris_case.py. Also tests how this script reads invented results."""

import contextlib
import io
import os
import pathlib
import sys
import tempfile
import unittest
import xml.etree.ElementTree

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "bench", "peers"))
import uris_case

# Two hexahedra, one above the other, and a triangle that is not part of the volume.
DUCT = """$MeshFormat
2.2 0 8
$EndMeshFormat
$Nodes
12
1 0 0 0
2 1 0 0
3 1 1 0
4 0 1 0
5 0 0 1
6 1 0 1
7 1 1 1
8 0 1 1
9 0 0 2
10 1 0 2
11 1 1 2
12 0 1 2
$EndNodes
$Elements
3
1 2 2 1 1 1 2 3
2 5 2 1 1 1 2 3 4 5 6 7 8
3 5 2 1 1 5 6 7 8 9 10 11 12
$EndElements
"""
BLOCK = """<!-- a comment -->
<Add_URIS_mesh name="flat">
  <Closed_thickness> 0.5 </Closed_thickness>
  <Resistance> 2000 </Resistance>
  <Positive_flow_normal_file_path> flat/normal.dat </Positive_flow_normal_file_path>
</Add_URIS_mesh>
"""
HEAD = "# svMultiPhysics boundary integral results file. \n step time wall inlet outlet \n"


class UrisCase(unittest.TestCase):
    def setUp(self):
        self.scratch = tempfile.TemporaryDirectory()
        self.addCleanup(self.scratch.cleanup)
        self.folder = pathlib.Path(self.scratch.name)

    def write_case(self, duct=DUCT, block=BLOCK):
        (self.folder / "duct.msh").write_text(duct, encoding="ascii")
        (self.folder / "block.xml").write_text(block, encoding="ascii")
        uris_case.write(self.folder / "duct.msh", self.folder / "block.xml", self.folder / "case", "0.001")
        return self.folder / "case"

    def write_results(self, case, pressures, last_step=uris_case.STEPS):
        """Writes the inlet's pressures of the last steps. The outlet's pressure is 10, and its flow is 4."""
        (case / "2-procs").mkdir()
        rows = list(enumerate(pressures, last_step + 1 - len(pressures)))
        for name, row in (("Pressure_average", "{0} {0}e-3 7 {1} 10\n"), ("Velocity_flux", "{0} {0}e-3 0 -4 4\n")):
            text = HEAD + "".join(row.format(*each) for each in rows)
            (case / "2-procs" / f"B_NS_{name}.txt").write_text(text, encoding="ascii")

    def drop(self, case, area="8", forecast="0.75"):
        with contextlib.redirect_stdout(io.StringIO()) as out:
            uris_case.drop(case, area, forecast)
        return out.getvalue()

    def refused(self, text, function, *arguments, **named):
        with self.assertRaises(SystemExit) as raised:
            function(*arguments, **named)
        self.assertIn(text, str(raised.exception))

    def test_faces(self):
        case = self.write_case()
        faces = (("inlet", {9, 10, 11, 12}, [2]), ("outlet", {1, 2, 3, 4}, [1]), ("wall", set(range(1, 13)), [1] * 4 + [2] * 4))
        for name, nodes, cells in faces:
            piece = xml.etree.ElementTree.parse(case / f"{name}.vtp").find("PolyData/Piece")
            self.assertEqual({int(word) for word in piece.find("PointData/DataArray").text.split()}, nodes)
            elements = [int(word) for word in piece.find("CellData/DataArray").text.split()]
            self.assertEqual(sorted(elements), cells)
        solver = xml.etree.ElementTree.parse(case / "solver.xml")
        self.assertEqual(solver.findtext("GeneralSimulationParameters/Time_step_size").strip(), "0.001")
        normal = solver.findtext("Add_URIS_mesh/Positive_flow_normal_file_path").strip()
        self.assertEqual(normal, os.path.join(os.getcwd(), "flat", "normal.dat"))

    def test_drop(self):
        # R / eps is 4000 and u is 4 / 8, so the whole drop is 2000.
        case = self.write_case()
        self.write_results(case, [90000, 1511, 1510])
        self.assertEqual(self.drop(case), "0.7500\n")
        self.assertEqual(self.drop(case, "4", "0.37"), "0.3750\n")

    def test_wrong_forecast(self):
        case = self.write_case()
        self.write_results(case, [1510, 1510])
        self.drop(case, forecast="0.772")
        for forecast in ("0.773", "0.727", "nan"):
            self.refused(f"the forecast is {forecast}, and differs by more than 3 %", self.drop, case, forecast=forecast)

    def test_refusals(self):
        self.refused("has no tetrahedra and no hexahedra", self.write_case, duct=DUCT.replace(" 5 2 1 1", " 3 2 1 1"))
        (self.folder / "case").rmdir()
        self.refused("has no Add_URIS_mesh", self.write_case, block="<!-- refused -->")

    def test_unsteady(self):
        case = self.write_case()
        self.write_results(case, [1513, 1510])
        self.refused("is not steady: the drop was 0.7515, and then 0.7500", self.drop, case)

    def test_early_end(self):
        case = self.write_case()
        self.write_results(case, [1510, 1510], last_step=uris_case.STEPS - 1)
        self.refused(f"must end with {uris_case.STEPS}", self.drop, case)


if __name__ == "__main__":
    unittest.main()
