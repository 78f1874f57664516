# SPDX-License-Identifier: Apache-2.0
"""test_solver_cases.py WRITE_SOLVER_CASE TEXTS: reads the folders of solvers again, and runs stand-ins for the solvers."""
import base64
import fcntl
import importlib.util
import json
import math
import os
import pathlib
import re
import shutil
import struct
import subprocess
import sys
import tempfile
import types
import unittest
import xml.etree.ElementTree as xml
import zlib

WRITE, TEXTS = "", pathlib.Path()
MMHG = 133.322
LAST_Z = 3.0

# The names that Parameters.cpp of svMultiPhysics b5fbed0 accepts in each element. Only names for a fluid and a valve are listed.
KNOWN = {
    "svMultiPhysicsFile": "GeneralSimulationParameters Add_mesh Add_URIS_mesh Add_equation",
    "GeneralSimulationParameters":
        "Check_IEN_order Continue_previous_simulation Convert_BIN_to_VTK_format Debug Increment_in_saving_restart_files"
        " Increment_in_saving_VTK_files Name_prefix_of_saved_VTK_files Number_of_initialization_time_steps"
        " Number_of_spatial_dimensions Number_of_time_steps Overwrite_restart_file Restart_file_name Save_averaged_results"
        " Save_results_in_folder Save_results_to_VTK_format Searched_file_name_to_trigger_stop"
        " Spectral_radius_of_infinite_time_step Start_saving_after_time_step Time_step_size Verbose Warning",
    "Add_mesh": "Mesh_file_path Mesh_scale_factor Add_face Domain",
    "Add_face": "Face_file_path",
    "Add_URIS_mesh": "Add_URIS_face Mesh_scale_factor Thickness Closed_thickness Resistance Valve_starts_as_closed Invert_normal"
                     " Positive_flow_normal_file_path Scaffold_file_path Include_URIS_velocity",
    "Add_URIS_face": "Face_file_path Open_motion_file_path Close_motion_file_path",
    "Add_equation": "Coupled Min_iterations Max_iterations Tolerance Use_taylor_hood_type_basis Density Viscosity"
                    " Backflow_stabilization_coefficient Output LS Add_BC Initialize_RCR_from_flow",
    "Viscosity": "Value",
    "Output": "Velocity Pressure Traction WSS Vorticity Divergence",
    "LS": "Linear_algebra Absolute_tolerance Krylov_space_dimension Max_iterations NS_CG_max_iterations NS_CG_tolerance"
          " NS_GM_max_iterations NS_GM_tolerance Tolerance",
    "Linear_algebra": "Preconditioner",
    "Add_BC": "Type Time_dependence Value Temporal_values_file_path RCR_values",
    "RCR_values": "Capacitance Distal_resistance Distal_pressure Initial_pressure Proximal_resistance",
}


def vtk_array(kind, name, values, components=1):
    text = " ".join(map(repr, values))
    return f'<DataArray type="{kind}" Name="{name}" NumberOfComponents="{components}" format="ascii">{text}</DataArray>\n'


def duct(folder, scale):
    """Writes a duct of tetrahedra along z, with the files that riis patient leaves. Returns the number of nodes and of cells."""
    n, low, high = (7, 7, 12), (-1.05, -1.05, -2.0), (1.05, 1.05, LAST_Z)

    def number(i, j, k):
        return i + (n[0] + 1) * (j + (n[1] + 1) * k)

    points = [scale * (low[axis] + (high[axis] - low[axis]) * at[axis] / n[axis])
              for at in ((i, j, k) for k in range(n[2] + 1) for j in range(n[1] + 1) for i in range(n[0] + 1))
              for axis in range(3)]
    cells = []
    for k in range(n[2]):
        for j in range(n[1]):
            for i in range(n[0]):
                for way in ((0, 1, 2), (1, 2, 0), (2, 0, 1), (0, 2, 1), (2, 1, 0), (1, 0, 2)):
                    at, corners = [i, j, k], [number(i, j, k)]
                    for axis in way:
                        at[axis] += 1
                        corners.append(number(*at))
                    cells.append(corners if way in ((0, 1, 2), (1, 2, 0), (2, 0, 1)) else [corners[0], corners[2], corners[1],
                                                                                         corners[3]])
    n_nodes = len(points) // 3
    folder.mkdir(parents=True)
    (folder / "mesh.vtu").write_text(
        '<VTKFile type="UnstructuredGrid" version="0.1" byte_order="LittleEndian"><UnstructuredGrid>\n'
        f'<Piece NumberOfPoints="{n_nodes}" NumberOfCells="{len(cells)}">\n'
        f'<PointData>{vtk_array("Int32", "GlobalNodeID", range(1, n_nodes + 1))}</PointData>\n'
        f'<CellData>{vtk_array("Int32", "GlobalElementID", range(1, len(cells) + 1))}</CellData>\n'
        f'<Points>{vtk_array("Float64", "Points", points, 3)}</Points>\n'
        f'<Cells>{vtk_array("Int64", "connectivity", [node for cell in cells for node in cell])}'
        f'{vtk_array("Int64", "offsets", range(4, 4 * len(cells) + 1, 4))}'
        f'{vtk_array("UInt8", "types", [10] * len(cells))}</Cells>\n'
        "</Piece></UnstructuredGrid></VTKFile>\n", encoding="ascii")
    (folder / "faces").mkdir()
    for name in ("inlet", "outlet", "outlet_2", "wall"):
        (folder / "faces" / f"{name}.vtp").write_text(f"the face {name}\n", encoding="ascii")
    for name in ("mesh.msh", "wall.stl"):
        (folder / name).write_text(f"the file {name}\n", encoding="ascii")
    unit = {1.0: "cm", 0.01: "m"}[scale]
    placed = {"valve": "trileaflet", "unit": unit, "axes": "LPS", "rotate": [0.0, 0.0, 1.0, 0.0], "translate": [0.0, 0.0, 0.0],
              "parameters": {}}
    (folder / "placed.json").write_text(json.dumps(placed), encoding="ascii")
    return n_nodes, len(cells)


class Cases(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def numbers(self, solver, **changes):
        """Writes the files of a patient, and returns the numbers of the case."""
        scale = {"svmultiphysics": 1.0, "fenicsx": 0.01}[solver]
        folder = self.folder / f"patient {len(list(self.folder.iterdir()))}"
        n_nodes, n_cells = duct(folder, scale)
        boundaries = [{"name": name, "group": group, "area": area}
                      for name, group, area in (("inlet", 1, 4.4), ("outlet", 2, 4.4), ("wall", 3, 42.0))]
        return {"folder": str(folder), "solver": str(folder / solver), "unit": "cm" if scale == 1 else "m", "kind": "trileaflet",
                "is_mitral": False, "name": "aortic_valve", "half_thickness": 0.3 * scale, "skirt": 0.0, "resistance": 1e4,
                "starts_closed": True, "upstream": [0.0, 0.0, -1.5 * scale], "downstream": [0.0, 0.0, 2.5 * scale],
                "ball_radius": 0.4 * scale, "boundaries": boundaries, "n_nodes": n_nodes, "n_cells": n_cells, **changes}

    def write(self, solver, numbers, status=0):
        path = self.folder / "case.json"
        path.write_text(json.dumps(numbers), encoding="ascii")
        # The forecast of the drop would take seconds. RIIS_PYTHON names no Python, so there is no forecast.
        done = subprocess.run([WRITE, solver, path], capture_output=True, text=True, check=False, timeout=300,
                              env={**os.environ, "RIIS_PYTHON": "/no/python"})
        self.assertEqual(done.returncode, status, done.stdout + done.stderr)
        return done.stderr

    def refused(self, solver, text, **changes):
        message = self.write(solver, self.numbers(solver, **changes), status=1)
        self.assertIn(text, message)

    # ---- svMultiPhysics ----

    def read(self, numbers):
        """Checks the names and files in solver.xml. Returns the parsed file."""
        folder = pathlib.Path(numbers["solver"])
        tree = xml.parse(folder / "solver.xml").getroot()
        n_files = 0
        for element in tree.iter():
            known = KNOWN.get(element.tag, "").split()
            for child in element:
                self.assertIn(child.tag, known, f"in {element.tag}")
            if element.tag.endswith("file_path"):
                path = element.text.strip()
                self.assertFalse(path.startswith("/"), path)
                self.assertTrue((folder / path).is_file(), path)
                n_files += 1
        self.assertGreater(n_files, 10)
        return tree

    @staticmethod
    def value(element, path):
        return float(element.find(path).text)

    def test_aortic(self):
        numbers = self.numbers("svmultiphysics")
        said = self.write("svmultiphysics", numbers)
        self.assertRegex(said, r"(?m)^riis: cd '.*/svmultiphysics' && riis export valve ../mesh.vtu --unit cm --valve ")
        self.assertRegex(said, r"a beat has 400 steps of 0.002 s; svMultiPhysics needs about [0-9.]+ (seconds|minutes|hours)")
        tree, folder = self.read(numbers), pathlib.Path(numbers["solver"])
        step, n_steps = self.value(tree, ".//Time_step_size"), self.value(tree, ".//Number_of_time_steps")
        self.assertAlmostEqual(step * n_steps, 0.8)
        # The mesh is that of the patient.
        source = pathlib.Path(numbers["folder"])
        self.assertEqual((folder / "mesh-complete/mesh-complete.mesh.vtu").read_bytes(), (source / "mesh.vtu").read_bytes())
        faces = {face.get("name"): face.find("Face_file_path").text.strip() for face in tree.iter("Add_face")}
        self.assertEqual(sorted(faces), ["inlet", "outlet", "wall"])
        for name, path in faces.items():
            self.assertEqual((folder / path).read_text(), f"the face {name}\n")
        # Units are g, cm and s.
        self.assertAlmostEqual(self.value(tree, ".//Density"), 1.06)
        self.assertAlmostEqual(self.value(tree, ".//Viscosity/Value"), 0.035)
        valve = tree.find("Add_URIS_mesh")
        self.assertEqual(valve.get("name"), "aortic_valve")
        self.assertAlmostEqual(self.value(valve, "Resistance"), 1e5)
        self.assertAlmostEqual(self.value(valve, "Closed_thickness"), 0.3)
        self.assertEqual(valve.find("Valve_starts_as_closed").text.strip(), "true")
        for element in valve.iter("Open_motion_file_path"):
            n_frames = int((folder / element.text.strip()).read_text().split()[0])
            self.assertAlmostEqual((n_frames - 1) * step, 0.04)
        # The ventricle drives the inlet, and the body lies behind the outlet. Blood rests at the wall.
        conditions = {condition.get("name"): condition for condition in tree.iter("Add_BC")}
        self.assertEqual(sorted(conditions), sorted(faces))
        self.assertEqual(conditions["wall"].find("Type").text.strip(), "Dir")
        self.assertEqual(conditions["inlet"].find("Time_dependence").text.strip(), "Unsteady")
        curve = (folder / conditions["inlet"].find("Temporal_values_file_path").text.strip()).read_text().splitlines()
        keys = [tuple(map(float, line.split())) for line in curve[1:]]
        self.assertEqual(int(curve[0].split()[0]), len(keys))
        self.assertEqual((keys[0][0], keys[-1][0], keys[0][1]), (0, 0.8, keys[-1][1]))
        self.assertAlmostEqual(max(pressure for _, pressure in keys) / (10 * MMHG), 120, delta=0.01)
        # If the unit is dyn s/cm5, a flow of 83 ml/s through the Windkessel leaves a mean pressure of 80 to 130 mmHg.
        body = conditions["outlet"].find("RCR_values")
        mean = 83 * (self.value(body, "Proximal_resistance") + self.value(body, "Distal_resistance")) / (10 * MMHG)
        self.assertTrue(80 < mean < 130, mean)
        decay = self.value(body, "Distal_resistance") * self.value(body, "Capacitance")
        self.assertTrue(1 < decay < 3, decay)
        self.assertAlmostEqual(self.value(body, "Initial_pressure") / (10 * MMHG), 80, delta=0.01)

    def test_two_outlets(self):
        one, two = self.numbers("svmultiphysics"), self.numbers("svmultiphysics", starts_closed=False, name="second")
        two["boundaries"][1]["area"] = 3.0
        two["boundaries"].append({"name": "outlet_2", "group": 4, "area": 1.4})
        bodies = []
        for numbers in (one, two):
            self.write("svmultiphysics", numbers)
            tree = self.read(numbers)
            bodies.append([{child.tag: float(child.text) for child in body} for body in tree.iter("RCR_values")])
        self.assertEqual((len(bodies[0]), len(bodies[1])), (1, 2))
        for name in ("Proximal_resistance", "Distal_resistance"):
            self.assertAlmostEqual(sum(1 / body[name] for body in bodies[1]) * bodies[0][0][name], 1, delta=1e-4)
        self.assertAlmostEqual(sum(body["Capacitance"] for body in bodies[1]) / bodies[0][0]["Capacitance"], 1, delta=1e-4)
        self.assertEqual(tree.find("Add_URIS_mesh").get("name"), "second")
        self.assertEqual(tree.find("Add_URIS_mesh/Valve_starts_as_closed").text.strip(), "false")

    def test_another_heart_rate(self):
        """At 120 beats a minute, the systole of both curves is shorter by the same factor, and diastole has the rest."""
        factor = (0.546 - 2.1e-3 * 120) / (0.546 - 2.1e-3 * 75)
        for is_mitral in (False, True):
            numbers = self.numbers("svmultiphysics", period=0.5, is_mitral=is_mitral)
            self.assertIn("a beat has 250 steps of 0.002 s", self.write("svmultiphysics", numbers))
            self.assertEqual(self.value(self.read(numbers), ".//Number_of_time_steps"), 250)
            rows = (pathlib.Path(numbers["solver"]) / "ventricle.dat").read_text().splitlines()[1:]
            times = [float(row.split()[0]) for row in rows]
            self.assertEqual((times[0], times[-1], times), (0, 0.5, sorted(times)))
            systole = 0.5 - times[3] if is_mitral else times[-2]  # the aortic beat ends with diastole, the mitral one begins so
            self.assertAlmostEqual(systole, factor * (0.4 if is_mitral else 0.38), delta=2e-4)
            numbers = self.numbers("fenicsx", period=0.5, is_mitral=is_mitral)
            self.write("fenicsx", numbers)
            case = json.loads((pathlib.Path(numbers["solver"]) / "case.json").read_text())
            self.assertEqual((case["period"], case["steps"]), (0.5, 250))
            curve = case["pressures"]["outlet" if is_mitral else "inlet"]
            self.assertEqual([time for time, _ in curve], times)
            for pressure in case["pressures"].values():
                self.assertEqual(pressure[-1][0], 0.5)

    def test_mitral(self):
        numbers = self.numbers("svmultiphysics", is_mitral=True, name="mitral_valve")
        self.write("svmultiphysics", numbers)
        tree = self.read(numbers)
        conditions = {condition.get("name"): condition for condition in tree.iter("Add_BC")}
        self.assertAlmostEqual(self.value(conditions["inlet"], "Value") / (10 * MMHG), 10, delta=0.01)
        self.assertEqual(conditions["outlet"].find("Temporal_values_file_path").text.strip(), "ventricle.dat")
        self.assertIsNone(tree.find(".//RCR_values"))

    def test_allrun(self):
        numbers = self.numbers("svmultiphysics")
        self.write("svmultiphysics", numbers)
        folder = pathlib.Path(numbers["solver"])
        stand_in = self.folder / "solver"
        # The stand-in has two steps of backward flow and one step of forward flow. The stand-in writes the last step twice, as a
        # continued run does.
        stand_in.write_text("#!/bin/sh\ncp \"$1\" ran.xml && mkdir -p 1-procs && : >1-procs/stFile_last.bin\n"
                            "printf 'step time inlet outlet wall\\n\\n 1 .002 1.5 -1.5 0\\n 2 .004 0.5 -0.5 0\\n"
                            " 3 .006 -100 100 0\\n 3 .006 -400 400 0\\n' >1-procs/B_NS_Velocity_flux.txt\n"
                            "sed '/ [123] /s/ [^ ]*$/ 0/' 1-procs/B_NS_Velocity_flux.txt >1-procs/B_NS_Pressure_average.txt\n",
                            encoding="ascii")
        stand_in.chmod(0o755)

        def allrun(*words, status=0, program=str(stand_in)):
            done = subprocess.run([folder / "Allrun", *words], capture_output=True, text=True, check=False,
                                  env={**os.environ, "SVMULTIPHYSICS": program})
            self.assertEqual(done.returncode, status, done.stdout + done.stderr)
            return done.stdout + done.stderr

        self.assertIn("the program '/no/solver' is missing. Write SVMULTIPHYSICS=PATH/svmultiphysics ./Allrun",
                      allrun(status=1, program="/no/solver"))
        self.assertIn("'two' is not a number of ranks: write ./Allrun 2", allrun("two", status=2))
        with open(folder / ".lock", "w", encoding="ascii") as lock:
            lock.write("77\n")
            lock.flush()
            fcntl.flock(lock, fcntl.LOCK_EX)
            self.assertIn("another run in this folder has not ended (process 77): wait for its end", allrun(status=1))
        self.assertIn("ended with the status 1", allrun(status=1, program="false"))
        said = allrun(status=2)
        self.assertIn("what follows is preliminary\nthe valve has not moved yet\n", said)
        self.assertNotIn("heart rate", said)
        for line in (r"forward volume +0.8 ml\n", r"backward volume +0.004 ml\n",
                     r"largest flow +400 ml/s +at 0.006 s\n"):
            self.assertRegex(said, line)
        self.assertIn("<Continue_previous_simulation> false", (folder / "ran.xml").read_text())
        self.assertIn("the run goes on", allrun(status=2))
        self.assertIn("<Continue_previous_simulation> true", (folder / "ran.xml").read_text())
        self.assertIn("1-procs has a run on another number of ranks. Continue it by ./Allrun 1 or remove it",
                      allrun("2", status=1))

    @staticmethod
    def leaflets(path, points, is_text):
        """Writes a file of leaflets as the solver does."""
        data = struct.pack(f"<{len(points)}d", *points)
        parts = [data[i:i + 4096] for i in range(0, len(data), 4096)]
        packed = [zlib.compress(part) for part in parts]
        head = struct.pack(f"<{3 + len(parts)}I", len(parts), 4096, len(parts[-1]) % 4096, *map(len, packed))
        body = b"".join(packed)
        if is_text:
            head, body = base64.b64encode(head), base64.b64encode(body)
        encoding = "base64" if is_text else "raw"
        path.write_bytes(b'<DataArray type="Float64" Name="other" format="appended" offset="0"/>\n<DataArray type="Float64" '
                         b'Name="coordinates" NumberOfComponents="3" format="appended" RangeMin="0" offset="3"/>\n'
                         + f'<AppendedData encoding="{encoding}">\n   _123'.encode() + head + body + b"\n</AppendedData>")

    def test_svmultiphysics_report(self):
        numbers = self.numbers("svmultiphysics")
        self.write("svmultiphysics", numbers)
        folder = pathlib.Path(numbers["solver"])
        text, results = (folder / "solver.xml").read_text(), folder / "1-procs"
        (folder / "solver.xml").write_text(text.replace("<Add_URIS_mesh", "<!-- area of the leaflets in the mesh, 9.5; -->"
                                                        "<Add_URIS_mesh", 1))
        results.mkdir()
        # The valve opens after step 24 and closes after step 75, each in 20 steps. The closed valve leaks 1.25 times the ideal
        # leak.
        eps, resistance, drop, n_steps = 0.3, 1e5, 80 * 10 * MMHG, 400
        leak = 1.25 * drop * eps * 9.5 / resistance
        flows, pressures = (["face areas: 1 1 1", "step time inlet outlet wall"] for _ in range(2))
        for step in range(1, n_steps + 1):
            is_open = 24 < step <= 95
            flow = 300 if is_open else -leak
            flows.append(f" {step} {0.002 * step:e} {-flow:e} {flow + 3e-4:e} 0.0 ")
            pressures.append(f" {step} {0.002 * step:e} {2e5 if is_open else 1e4:e} {1e4 + (0 if is_open else drop):e} 0.0 ")
        for name, rows in (("Velocity_flux", flows), ("Pressure_average", pressures)):
            (results / f"B_NS_{name}.txt").write_text("\n".join(rows) + "\n")
        face = xml.fromstring(text).find("Add_URIS_mesh/Add_URIS_face")
        frames = {}
        for name in ("Open", "Close"):
            lines = (folder / face.find(f"{name}_motion_file_path").text.strip()).read_text().split("\n")
            n_vertices = int(lines[0].split()[1])
            rows = [list(map(float, line.split())) for line in lines[1:] if line.strip()]
            frames[name] = [sum(rows[i:i + n_vertices], []) for i in range(0, len(rows), n_vertices)]
        self.assertEqual((len(frames["Open"]), len(frames["Close"])), (21, 21))
        for step in range(10, n_steps + 1, 10):
            shown = frames["Open"][min(max(step - 24, 0), 20)] if step < 76 else frames["Close"][min(step - 75, 20)]
            self.leaflets(results / f"result_uris_aortic_valve_{step:03d}.vtu", shown + [9.0] * 30, is_text=step % 20 == 0)
            speed = 250 if step == 30 else 150 if step == 150 else 20
            (results / f"result_{step:03d}.vtu").write_text(
                f'<DataArray type="Float64" Name="Velocity" RangeMin="0" RangeMax="{speed}" offset="0"/>')
        done = subprocess.run([sys.executable, "-B", folder / "report.py", results], capture_output=True, text=True, check=False)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("the valve opens from 0.048 to 0.088 s\nthe valve closes from 0.150 to 0.190 s\n", done.stdout)
        back = leak * 0.002 * (n_steps - 71)
        for line in (rf"forward volume +{300 * 0.142:.4g} ml\n",
                     rf"backward volume +{back:.4g} ml +met: below 12 %, {100 * back / 42.6:.1f} %\n",
                     r"largest flow +300 ml/s +at 0.050 s\n",
                     r"inflow less outflow, as a share of the largest flow +1.0e-06 +met: ",
                     rf"leak of the closed valve at 80 mmHg +{leak:.4g} ml/s\n",
                     r"as a multiple of an ideal valve's leak +1.25\n",
                     r"fastest node while the valve moves, in 4 files +2.5 m/s\n",
                     r"fastest node while the valve is at rest, in 36 files +1.5 m/s\n"):
            self.assertRegex(done.stdout, line)
        # With twice the leak, too much blood flows back, and the status reports this.
        (results / "B_NS_Velocity_flux.txt").write_text("\n".join(flows[:2] + [
            re.sub(r"^( \d+ \S+).*", rf"\1 {4 * leak:e} {-4 * leak:e} 0.0", row) if int(row.split()[0]) > 95 else row
            for row in flows[2:]]) + "\n")
        done = subprocess.run([sys.executable, "-B", folder / "report.py", results], capture_output=True, text=True, check=False)
        self.assertEqual(done.returncode, 1, done.stderr)
        self.assertRegex(done.stdout, r"backward volume +\S+ ml +MISSED: below 12 %")
        for words in ([], [str(self.folder)]):
            done = subprocess.run([sys.executable, "-B", folder / "report.py", *words], capture_output=True, text=True,
                                  check=False)
            self.assertEqual(done.returncode, 1)
            self.assertIn("report.py takes the folder of results, such as 1-procs, but got", done.stderr)

    def test_refusals(self):
        self.refused("svmultiphysics", "its mesh is in metres, and this solver needs centimetres", unit="m")
        self.refused("fenicsx", "its mesh is in millimetres, and this solver needs metres", unit="mm")
        for solver in ("svmultiphysics", "fenicsx"):
            whole = self.numbers(solver)["boundaries"]
            self.refused(solver, "at least one outlet, not 1, 0 and 1", boundaries=whole[:2])
            self.refused(solver, "not 1, 1 and 0", boundaries=[whole[0], whole[2]])
            self.refused(solver, "not 2, 1 and 1", boundaries=[whole[0], *whole])
            self.refused(solver, "its boundary 'rim' is neither inlet, outlet nor wall",
                         boundaries=[*whole, {"name": "rim", "group": 9, "area": 1}])
            numbers = self.numbers(solver)
            pathlib.Path(numbers["solver"]).mkdir()
            (pathlib.Path(numbers["solver"]) / "result").touch()
            self.assertIn("a case is there already: remove this folder", self.write(solver, numbers, status=1))
            numbers = self.numbers(solver, skirt=0.1)
            for name in ("faces/outlet.vtp", "wall.stl"):
                (pathlib.Path(numbers["folder"]) / name).unlink()
            self.assertRegex(self.write(solver, numbers, status=1), r"(outlet.vtp|wall.stl): cannot be copied: No such file")
        self.refused("svmultiphysics", "svMultiPhysics would never open the valve", half_thickness=5.0)

    # ---- dolfinx ----

    def test_fenicsx(self):
        numbers = self.numbers("fenicsx", skirt=0.005)
        self.assertRegex(self.write("fenicsx", numbers), r"a beat has 400 steps of 0.002 s; dolfinx needs about [0-9.]+ ")
        folder = pathlib.Path(numbers["solver"])
        for name in ("mesh.msh", "placed.json", "wall.stl"):
            self.assertEqual((folder / name).read_bytes(), (folder.parent / name).read_bytes())
        for name in ("fenicsx/run.py", "fenicsx/report.py", "beat_table.py"):
            self.assertEqual((folder / pathlib.Path(name).name).read_bytes(), (TEXTS / name).read_bytes())
        case = json.loads((folder / "case.json").read_text())
        self.assertEqual(case["boundaries"], {"inlet": 1, "outlet": 2, "wall": 3})
        for name in ("half_thickness", "skirt", "resistance", "upstream", "downstream", "ball_radius", "unit", "starts_closed"):
            self.assertEqual(case[name], numbers[name])
        self.assertEqual((case["density"], case["viscosity"]), (1060, 3.5e-3))
        self.assertAlmostEqual(case["steps"] * case["time_step"], case["period"])
        self.assertAlmostEqual(max(pressure for _, pressure in case["pressures"]["inlet"]) / MMHG, 120)
        self.assertEqual(list(case["windkessels"]), ["outlet"])
        numbers = self.numbers("fenicsx", is_mitral=True)
        self.write("fenicsx", numbers)
        case = json.loads((pathlib.Path(numbers["solver"]) / "case.json").read_text())
        self.assertEqual((sorted(case["pressures"]), case["windkessels"]), (["inlet", "outlet"], {}))
        law = case["law"]
        self.assertEqual(law["close_below"], 1e-4)
        # The closing leaflets push blood back, which raises the pressure before them. The valve must not open again because of
        # this pressure.
        self.assertGreaterEqual(law["dwell_time"], max(law["opening_duration"], law["closing_duration"]))
        self.assertFalse((pathlib.Path(numbers["solver"]) / "wall.stl").exists())

    def test_missing_packages(self):
        numbers = self.numbers("fenicsx")
        self.write("fenicsx", numbers)
        # Empty modules stand for installed packages.
        there = self.folder / "modules"
        there.mkdir()
        (there / "basix.py").write_text("raise ImportError('none', name='basix')\n", encoding="ascii")
        done = subprocess.run([sys.executable, "-B", pathlib.Path(numbers["solver"]) / "run.py"], capture_output=True, text=True,
                              check=False, env={**os.environ, "PYTHONPATH": str(there)})
        self.assertEqual(done.returncode, 1)
        self.assertRegex(done.stderr, r"^run.py: .* lacks basix. Debian 13 has it: sudo apt-get install --no-install-recommends ")

    def program(self):
        """Returns run.py as a module. Empty modules take the place of dolfinx."""
        if not importlib.util.find_spec("numpy"):
            self.skipTest("there is no NumPy")
        numbers = self.numbers("fenicsx")
        self.write("fenicsx", numbers)

        class Anything(types.ModuleType):
            def __getattr__(self, name):
                if name.startswith("__"):
                    raise AttributeError(name)
                return "0.9.0" if name == "__version__" else Anything(name)

            __version__ = "0.9.0"

        names = ("basix", "basix.ufl", "dolfinx", "dolfinx.fem", "dolfinx.fem.petsc", "dolfinx.io", "gmsh", "mpi4py", "ufl",
                 "report", "riis")
        path = sys.path[:]
        self.addCleanup(lambda: sys.path.__setitem__(slice(None), path))
        before = {name: sys.modules.get(name) for name in names}
        self.addCleanup(lambda: [sys.modules.pop(name) if old is None else sys.modules.__setitem__(name, old)
                                 for name, old in before.items()])
        sys.modules.update({name: Anything(name) for name in names})
        spec = importlib.util.spec_from_file_location("run", pathlib.Path(numbers["solver"]) / "run.py")
        module = importlib.util.module_from_spec(spec)
        spec.loader.exec_module(module)
        return module

    def test_program(self):
        run = self.program()
        # Both forms of STL have equal triangles.
        corners = [(0.5, 0.25, 0.0), (1.0, 0.0, 0.0), (0.0, 1.0, 2.0)]
        binary, text = self.folder / "binary.stl", self.folder / "text.stl"
        binary.write_bytes(b"solid".ljust(80) + struct.pack("<I", 2)
                           + 2 * struct.pack("<12fH", 0, 0, 1, *(x for corner in corners for x in corner), 0))
        rows = "".join("vertex {} {} {}\n".format(*corner) for corner in corners)
        facet = f"facet normal 0 0 1\nouter loop\n{rows}endloop\nendfacet\n"
        text.write_text("solid w\n" + 2 * facet + "endsolid w\n", encoding="ascii")
        for path in (binary, text):
            self.assertEqual(run.read_stl(path).tolist(), [[list(corner) for corner in corners]] * 2)
        # Two runs cannot have one folder.
        one = types.SimpleNamespace(rank=0, bcast=lambda value: value)
        lock = run.locked(one)
        self.assertEqual((run.HERE / ".lock").read_text(), f"{os.getpid()}\n")
        with self.assertRaisesRegex(SystemExit, "run.py: another run in .* has not ended: wait for its end"):
            run.locked(one)
        self.assertIsNone(run.locked(types.SimpleNamespace(rank=1, bcast=lambda _: True)))
        lock.close()
        run.locked(one).close()
        # The curve repeats and is linear between its keys.
        pressure = run.curve([[0, 10], [0.2, 30], [0.8, 10]])
        for now, expected in ((0.1, 20), (0.9, 20), (0.5, 20), (1.6, 10)):
            self.assertAlmostEqual(float(pressure(now)), expected)
        # Without flow the Windkessel decays with its time constant, and a steady flow gives the sum of both resistances.
        body = run.Windkessel((2.0, 50.0, 0.01, 0.0), 100.0)
        for _ in range(200):
            last = body.pressure(0.0)
        self.assertAlmostEqual(last, 100 * math.exp(-200 * run.DT / 0.5), delta=0.2)
        for _ in range(20000):
            last = body.pressure(3.0)
        self.assertAlmostEqual(last, 3.0 * 52, delta=1e-6)

    def test_fenicsx_report(self):
        numbers = self.numbers("fenicsx", orifice=[4e-4, 3.5e-4, ""])
        self.write("fenicsx", numbers)
        folder = pathlib.Path(numbers["solver"])
        case = json.loads((folder / "case.json").read_text())
        # After 0.1 s the valve opens in 20 steps, and 200 ml/s pass. After 0.4 s the valve closes in 20 steps, while 50 ml/s
        # return. The valve then leaks at 80 mmHg half as much again as an ideal valve of 9 cm2.
        drop, area = -80 * MMHG, 9e-4
        leak = 1.5 * drop * case["half_thickness"] * area / case["resistance"]

        def row(step):
            now = 0.002 * step
            opening = round(min(max((now - 0.1) / 0.04, 0), 1, max((0.44 - now) / 0.04, 0)), 9)
            if now < 0.1001 or now > 0.4401:
                return [step, now, 0.0, 0, -drop, leak, 1.0, 0.3, 1e-10, area]
            flow, fastest = (2e-4, 2.0) if now < 0.4001 else (-5e-5, 3.5 if now < 0.4101 else 2.5)
            return [step, now, opening, 500, 0, flow, fastest, 9.0, -2e-10, area]

        def report(n_rows, status=0):
            names = re.search(r"COLUMNS = \((.*?)\)", (folder / "run.py").read_text(), re.DOTALL)[1]
            lines = [re.sub(r'["\s]', "", names), *(",".join(map(repr, row(step))) for step in range(1, n_rows + 1))]
            (folder / "valve.csv").write_text("\n".join(lines) + "\n", encoding="ascii")
            done = subprocess.run([sys.executable, "-B", folder / "report.py"], capture_output=True, text=True, check=False,
                                  cwd="/")
            self.assertEqual(done.returncode, status, done.stdout + done.stderr)
            return done.stdout + done.stderr

        done = subprocess.run([sys.executable, "-B", folder / "report.py"], capture_output=True, text=True, check=False)
        self.assertIn("has no valve.csv yet: run.py writes it after ten steps", done.stderr)
        said = report(400)
        self.assertIn("the valve opens from 0.100 to 0.140 s\nthe valve closes from 0.400 to 0.440 s\n", said)
        back = 50 * 0.04 - 1e6 * leak * 0.002 * (50 + 180)
        # The areas are those of the case. The effective area is 200 ml/s over 2 m/s.
        for line in (r"heart rate +75 /min\n", r"orifice of the open valve +4 cm2\n",
                     r"left open by the band +3.5 cm2 +met: at least 80 %, 88 %\n",
                     r"effective area: largest flow over its fastest blood +1 cm2\n"):
            self.assertRegex(said, line)
        for line in (r"forward volume +60 ml\n", rf"backward volume +{back:.4g} ml +met",
                     r"of the largest flow +1.0e-06 +met: at most 1e-5", r"while the valve moves +3.5 m/s +met: at most 8",
                     r"time with a node above 3 m/s while it moves +10 ms +met: at most 10",
                     r"at the closed valve +0.3 m/s +met: at most 2",
                     rf"leak of the closed valve at 80 mmHg +{-1e6 * leak:.4g} ml/s\n",
                     r"as a multiple of an ideal valve's leak +1.5\n"):
            self.assertRegex(said, line)
        # As long as a valve that never moves has no steady leak, the script judges nothing.
        self.assertIn((folder / "report.txt").read_text(), said)
        said = report(20, status=2)
        self.assertIn("0.04 s of a beat of 0.8 s: what follows is preliminary\nthe valve has not moved yet\n", said)
        for word in ("leak", "met", "MISSED"):
            self.assertNotIn(word, said)
        self.assertIn("not made two steps yet", report(1, status=2))


if __name__ == "__main__":
    if len(sys.argv) < 3:
        sys.exit(__doc__)
    WRITE, TEXTS = sys.argv[1], pathlib.Path(sys.argv[2])
    if not shutil.which(WRITE):
        sys.exit(f"test_solver_cases.py: {WRITE} is missing")
    unittest.main(argv=sys.argv[:1] + sys.argv[3:])
