# SPDX-License-Identifier: Apache-2.0
"""test_openfoam_case.py WRITER: tests the case of OpenFOAM that riis patient writes. The test checks the dictionaries, the
refusals and the scripts.

WRITER is write_solver_case. Allrun runs stand-ins for OpenFOAM's programs, so the test does not need OpenFOAM. If foamDictionary
is installed, OpenFOAM's parser also reads the dictionaries.
"""
import json
import math
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

WRITER = ""
TEXTS = pathlib.Path(__file__).resolve().parents[2] / "src/program/patient"
RHO, MMHG = 1060.0, 133.322
# The tools of the system that Allrun calls.
TOOLS = "awk bash cat cksum dirname env find flock grep mkdir paste readlink rm sed seq sh sort tail touch tr".split()


def parsed(text):
    """Returns the entries of a dictionary of OpenFOAM by their names. An entry is a dictionary or a list of words."""
    text = re.sub(r"//[^\n]*", "", text)
    tokens = re.findall(r'"[^"]*"|[{}();]|[^\s{}();"]+', text)

    def block(at):
        made = {}
        while at < len(tokens) and tokens[at] != "}":
            name, words, at = tokens[at], [], at + 1
            if tokens[at] == "{":
                made[name], at = block(at + 1)
                assert tokens[at] == "}", name
                at += 1
                continue
            depth = 0
            while tokens[at] != ";" or depth > 0:
                depth += {"(": 1, "{": 1, ")": -1, "}": -1}.get(tokens[at], 0)
                assert depth >= 0, f"{name}: a bracket too many"
                words.append(tokens[at])
                at += 1
            made[name], at = words, at + 1
        return made, at

    made, at = block(0)
    assert at == len(tokens), f"the end of the dictionary is at token {at} of {len(tokens)}"
    return made


def numbers(words):
    return [float(word) for word in words if re.fullmatch(r"[-+.\de]+", word)]


class OpenfoamCase(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def write(self, status=0, placed=None, **changes):
        """Writes a case. Returns the folder of the case, and the output of the writer."""
        root = {"valve": "coapting", "unit": "mm", "axes": "LPS", "rotate": [0, 0.6, 0.8, 30], "translate": [10, -20, 1000],
                "parameters": {"root_radius": 1.31, "cusp_0.sector": 130, "cusp_1.sector": 115, "cusp_2.sector": 115},
                "warp": {"sources": [[10, -8, 1000], [22, -20, 1000], [10, -32, 1004], [0, -20, 1010]],
                         "targets": [[10, -8, 1001], [22, -20, 1000], [10, -32, 1004], [0, -20, 1011]], "noise": 0.3}}
        root.update(placed or {})
        shutil.rmtree(self.folder / "openfoam", ignore_errors=True)
        (self.folder / "placed.json").write_text(json.dumps(root), encoding="utf-8")
        (self.folder / "wall.stl").write_text("solid wall\nendsolid wall\n", encoding="utf-8")
        (self.folder / "mesh.msh").write_text("$MeshFormat\n2.2 0 8\n$EndMeshFormat\n", encoding="utf-8")
        case = {"folder": str(self.folder), "solver": str(self.folder / "openfoam"), "unit": "m", "kind": "coapting",
                "is_mitral": False, "name": "aortic_valve", "half_thickness": 1e-3, "skirt": 6e-3, "resistance": 1e4,
                "starts_closed": True, "upstream": [0.01, -0.02, 0.985], "downstream": [0.01, -0.02, 1.02],
                "ball_radius": 4e-3, "n_nodes": 0, "n_cells": 0,
                "boundaries": [{"name": "inlet", "area": 4e-4}, {"name": "outlet", "area": 5e-4}, {"name": "wall"}]}
        case.update(changes)
        for i, boundary in enumerate(case["boundaries"]):
            boundary.update({"group": i + 1, "area": boundary.get("area", 1e-3)})
        (self.folder / "case.json").write_text(json.dumps(case), encoding="utf-8")
        done = subprocess.run([WRITER, "openfoam", self.folder / "case.json"], capture_output=True, text=True, check=False)
        self.assertEqual(done.returncode, status, done.stderr)
        return self.folder / "openfoam", done.stderr

    def dictionary(self, case, name):
        path = case / name
        made = parsed(path.read_text(encoding="utf-8"))
        if shutil.which("foamDictionary"):
            environment = {"WM_PROJECT_DIR": "/usr/share/openfoam", **os.environ, "PWD": str(case)}
            done = subprocess.run(["foamDictionary", path, "-disableFunctionEntries", "-keywords"], capture_output=True,
                                  text=True, check=False, env=environment, cwd=case)
            self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
            self.assertEqual(set(done.stdout.split()), set(made), done.stdout)
        return made

    def test_an_aortic_valve_has_its_pressures_and_its_skirt(self):
        case, _ = self.write()
        valve = self.dictionary(case, "system/fvOptions")["aortic_valve"]
        self.assertEqual(valve["type"], ["riisValve"])
        for key, number in (("rho", 1060), ("resistance", 1e4), ("halfThickness", 1e-3)):
            self.assertEqual(numbers(valve[key]), [number])
        self.assertEqual(valve["valve"], {"kind": ["coapting"], "root_radius": ["1.31"], "cusp_0.sector": ["130"],
                                          "cusp_1.sector": ["115"], "cusp_2.sector": ["115"]})
        self.assertEqual(valve["placement"]["scale"], ["0.01"])
        for found, expected in zip(numbers(valve["placement"]["translation"]), (0.01, -0.02, 1)):
            self.assertAlmostEqual(found, expected, 12)
        self.assertEqual(valve["skirt"], {"patch": ["wall"], "longest": ["0.006"]})
        targets = numbers(valve["warp"]["targets"])
        self.assertEqual(len(targets), 12)
        self.assertAlmostEqual(targets[11], 1.011, 12)
        self.assertAlmostEqual(numbers(valve["warp"]["noise"])[0], 3e-4, 12)
        law = valve["opening"]
        self.assertEqual((law["law"], law["flowPatch"], law["forward"]), (["switch"], ["inlet"], ["in"]))
        self.assertGreater(numbers(law["openAbove"])[0], 0)
        # A motion ends before the next motion may begin.
        self.assertGreaterEqual(numbers(law["dwellSeconds"])[0],
                                max(numbers(law[name])[0] for name in ("openingSeconds", "closingSeconds")))
        self.assertEqual(numbers(law["upstream"]["centre"]), [0.01, -0.02, 0.985])
        patches = self.dictionary(case, "0/p")["boundaryField"]
        table = numbers(patches["inlet"]["p0"])
        # The ventricle's pressure rises above that of the arteries, and returns to its first value. One beat can therefore follow
        # another beat without a jump.
        highest = max(table[1::2]) * RHO / MMHG
        self.assertTrue(110 < highest < 130, highest)
        self.assertEqual((table[0], table[-2], table[1]), (0, 0.8, table[-1]))
        self.assertEqual(numbers(patches["inlet"]["value"]), [table[1]])
        self.assertEqual(patches["outlet"]["type"], ["riisWindkessel"])
        solver = self.dictionary(case, "system/fvSolution")["solvers"]["p"]
        self.assertEqual((solver["solver"], solver["netSource"], solver["tolerance"]), (["riisSource"], ["no"], ["1e-7"]))
        control = self.dictionary(case, "system/controlDict")
        self.assertEqual((control["startFrom"], control["endTime"]), (["latestTime"], ["0.8"]))
        self.assertEqual(control["functions"]["valve"]["valve"], ["aortic_valve"])
        for name in ("0/U", "constant/transportProperties", "constant/turbulenceProperties", "system/fvSchemes",
                     "system/decomposeParDict"):
            self.dictionary(case, name)
        self.assertEqual((case / "beat_table.py").read_bytes(), (TEXTS / "beat_table.py").read_bytes())
        for name in ("mesh.msh", "placed.json", "wall.stl"):
            self.assertEqual((case / name).read_bytes(), (self.folder / name).read_bytes())
        self.assertTrue(os.access(case / "Allrun", os.X_OK))
        for path in case.rglob("*"):
            if path.is_file():
                self.assertFalse(re.search(r"@[A-Z_]+@", path.read_text(encoding="utf-8")), path)

    def test_outlets_share_the_arteries_by_area(self):
        case, _ = self.write()
        whole = self.dictionary(case, "0/p")["boundaryField"]["outlet"]
        case, _ = self.write(boundaries=[{"name": "inlet", "area": 4e-4}, {"name": "outlet", "area": 4.5e-4},
                                         {"name": "outlet_2", "area": 1.5e-4}, {"name": "wall"}])
        patches = self.dictionary(case, "0/p")["boundaryField"]
        parts = [patches["outlet"], patches["outlet_2"]]
        for key in ("proximalResistance", "distalResistance"):
            together = 1 / sum(1 / numbers(part[key])[0] for part in parts)
            self.assertTrue(math.isclose(together, numbers(whole[key])[0], rel_tol=1e-5), key)
            self.assertTrue(math.isclose(numbers(parts[1][key])[0], 3 * numbers(parts[0][key])[0], rel_tol=1e-5), key)
        self.assertTrue(math.isclose(sum(numbers(part["compliance"])[0] for part in parts), numbers(whole["compliance"])[0],
                                     rel_tol=1e-5))
        functions = self.dictionary(case, "system/controlDict")["functions"]
        self.assertIn("flow_outlet_2", functions)
        self.assertEqual((functions["pressure_outlet"]["operation"], functions["pressure_outlet"]["name"]),
                         (["areaAverage"], ["outlet"]))

    def test_a_mitral_valve_lies_between_atrium_and_ventricle(self):
        case, _ = self.write(kind="mitral", name="mitral_valve", is_mitral=True, half_thickness=1.5e-3,
                             placed={"valve": "mitral", "parameters": {"skirt_length": 0.3}})
        valve = self.dictionary(case, "system/fvOptions")["mitral_valve"]
        self.assertEqual(valve["valve"], {"kind": ["mitral"], "skirt_length": ["0.3"]})
        self.assertNotIn("skirt", valve)  # the valve keeps its own value
        self.assertGreater(numbers(valve["opening"]["closeBelow"])[0], 0)
        patches = self.dictionary(case, "0/p")["boundaryField"]
        self.assertEqual(patches["inlet"]["p0"][0], "constant")
        atrium = numbers(patches["inlet"]["p0"])[0]
        ventricle = numbers(patches["outlet"]["p0"])[1::2]
        self.assertTrue(min(ventricle) < atrium < max(ventricle))
        self.assertNotIn("pressure_outlet", self.dictionary(case, "system/controlDict")["functions"])

    def test_the_page_changes_the_end_and_the_time_step(self):
        case, _ = self.write()
        page = (TEXTS.parents[2] / "docs/patient_openfoam.md").read_text(encoding="utf-8")
        for command in re.findall("^sed .*controlDict.*$", page, re.MULTILINE):
            subprocess.run(["bash", "-c", command], cwd=case, check=True)
        control = self.dictionary(case, "system/controlDict")
        self.assertEqual((control["endTime"], control["deltaT"]), (["2.4"], ["5e-4"]))

    def test_a_valve_that_is_held(self):
        case, _ = self.write(hold=0.5)
        law = self.dictionary(case, "system/fvOptions")["aortic_valve"]["opening"]
        self.assertEqual(numbers(law["closed"]), [0.5])
        self.assertGreater(numbers(law["openAbove"])[0], 1e8)
        # The command of docs/patient_openfoam.md makes the same law from the case of a valve that moves.
        page = (TEXTS.parents[2] / "docs/patient_openfoam.md").read_text(encoding="utf-8")
        command = re.search("^sed .*closed 0.5.*$", page, re.MULTILINE)[0]
        case, _ = self.write()
        subprocess.run(["bash", "-c", command], cwd=case, check=True)
        self.assertEqual(self.dictionary(case, "system/fvOptions")["aortic_valve"]["opening"], law)
        # Much blood flows back through a valve that is held open, and the table does not judge this.
        done = self.run_case(case, tools=self.tools(*self.programs), FAULT="held")
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        self.assertIn("the valve does not move", done.stdout)
        self.assertRegex(done.stdout, "backward volume +[0-9.]+ ml\n")

    def test_refusals(self):
        _, said = self.write(1, unit="mm")
        self.assertIn("its mesh is in millimetres, and this solver needs metres", said)
        _, said = self.write(1, starts_closed=False)
        self.assertIn("starts with a closed valve", said)
        _, said = self.write(1, boundaries=[{"name": "inlet"}, {"name": "aorta"}, {"name": "wall"}])
        self.assertIn("its boundary 'aorta' is neither inlet, outlet nor wall", said)
        pairs = {"sources": [[0, 0, 0], [1, 0, 0], [0, 1, 0]], "targets": [[0, 0, 0], [1, 0, 0], [0, 1, 0]]}
        _, said = self.write(1, placed={"warp": {**pairs, "coordinates": "valve"}})
        self.assertIn("the warp's landmarks are in the valve's coordinates", said)
        _, said = self.write(1, placed={"warp": {**pairs, "open": {"targets": pairs["targets"], "sources": pairs["sources"]}}})
        self.assertIn("the warp moves", said)

    # ---- Allrun and report.py ----

    def tools(self, *names):
        """Makes a folder for PATH. The folder has tools of the system, and stand-ins for the named programs of OpenFOAM."""
        folder = self.folder / "bin"
        shutil.rmtree(folder, ignore_errors=True)
        folder.mkdir()
        for tool in TOOLS:
            found = shutil.which(tool)
            if found:
                (folder / tool).symlink_to(found)
        stand_ins = {
            "python3": f"exec {sys.executable} \"$@\"",  # python3 in PATH may be a script that needs more tools
            "gmshToFoam": "mkdir -p constant/polyMesh\n"
                          "echo 'note \"nPoints:8000 nCells:40000 nFaces:9\";' >constant/polyMesh/owner\n"
                          "printf 'inlet\\n{\\n type patch;\\n}\\nwall\\n{\\n type patch;\\n}\\n' >constant/polyMesh/boundary",
            "checkMesh": "echo 'Mesh OK.'",
            "foamDictionary": "sed -n \"s/^ *$3 \\([^;]*\\);.*/\\1/p\" \"$1\" | tail -n 1",
            "pimpleFoam": f"python3 {pathlib.Path(__file__).resolve()} --beat \"$@\"",
            "decomposePar": "for i in $(seq 0 3); do mkdir -p processor$i/0; done",
            "reconstructPar": ":",
            "mpirun": "echo \"mpirun $2\"; shift 2; \"$@\"",
        }
        for name in ("python3", *names):
            path = folder / name
            path.write_text(f"#!/bin/bash\n{stand_ins[name]}\n", encoding="utf-8")
            path.chmod(0o755)
        return folder

    def run_case(self, case, *words, tools, start_new_session=False, **environment):
        root = self.folder / "foam/etc"
        root.mkdir(parents=True, exist_ok=True)
        (root / "controlDict").touch()
        plugin = self.folder / "plugin"
        plugin.mkdir(exist_ok=True)
        (plugin / "libriisFvOption.so").touch()
        return subprocess.run([case / "Allrun", *words], capture_output=True, text=True, check=False, cwd="/",
                              start_new_session=start_new_session,
                              env={"PATH": str(tools), "HOME": str(self.folder), "WM_PROJECT_DIR": str(root.parent),
                                   "RIIS_OPENFOAM": str(plugin), **environment})

    def test_what_is_missing_is_named_with_its_command(self):
        case, _ = self.write()
        done = self.run_case(case, tools=self.tools())
        self.assertEqual(done.returncode, 1)
        self.assertIn("OpenFOAM is missing", done.stderr)
        self.assertIn("this command installs it: sudo apt-get install openfoam", done.stderr)
        tools = self.tools("pimpleFoam")
        done = self.run_case(case, tools=tools, RIIS_OPENFOAM=str(self.folder))
        self.assertEqual(done.returncode, 1)
        self.assertIn("./run openfoam plugin", done.stderr)
        self.assertIn("The Debian package riis-openfoam also has it", done.stderr)
        done = self.run_case(case, "four", tools=tools)
        self.assertEqual(done.returncode, 1)
        self.assertIn("'four' is not a number of processes", done.stderr)
        tools = self.tools("pimpleFoam", "gmshToFoam", "checkMesh", "foamDictionary")
        done = self.run_case(case, "4", tools=tools)
        self.assertEqual(done.returncode, 1)
        self.assertIn("mpirun is missing", done.stderr)
        (case / "processor0").mkdir()
        (case / "processor1").mkdir()
        done = self.run_case(case, tools=tools)
        self.assertEqual(done.returncode, 1)
        self.assertIn("this run began with 2 processes. ./Allrun 2 goes on", done.stderr)

    programs = ("pimpleFoam", "gmshToFoam", "checkMesh", "foamDictionary", "decomposePar", "reconstructPar", "mpirun")

    def test_a_beat_and_its_table(self):
        case, _ = self.write()
        done = self.run_case(case, tools=self.tools(*self.programs))
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        self.assertIn("40000 cells, 800 steps of 0.001 s from 0 s to 0.8 s, on 1 process", done.stdout)
        self.assertIn("this takes about 3 minutes", done.stdout)  # 5e-6 s of 40,000 cells and 800 steps are 160 s
        self.assertIn("type wall;", (case / "constant/polyMesh/boundary").read_text(encoding="utf-8").split("wall\n")[1])
        # The stand-in's beat has 100 ml/s for 0.2 s, then 10 ml/s back for 0.1 s. At 90 mmHg for 0.5 s, it has a leak of 1.01
        # times the forecast of 1.5 ml/s.
        self.assertIn("the valve opens from 0.100 to 0.101 s\nthe valve closes from 0.400 to 0.401 s\n", done.stdout)
        # The pressure in the aorta is between 80 mmHg and 125 mmHg.
        clinical, checks = done.stdout.split("numerical checks\n")
        for text in ("heart rate +75 /min", "forward volume +20 ml\n", "backward volume +1.757 ml +met: below 12 %, 8.8",
                     "largest flow +100 ml/s +at 0.101 s", "mean gradient, while the flow is above half its largest +5 mmHg",
                     "orifice of the open valve +3 cm2\n", "left open by the band +2.7 cm2 +met: at least 80 %, 90 %\n",
                     "largest flow over its fastest blood +0.5 cm2\n", "fastest blood while the valve is fully open +2 m/s",
                     "systolic pressure in the aorta +125 mmHg", "diastolic pressure in the aorta +80 mmHg",
                     r"leak of the closed valve at 90 mmHg +1\.515 ml/s"):
            self.assertRegex(clinical, text)
        for text in ("leak, as a multiple of the forecast for this mesh +1.01 +met: 0.97 to 1.03",
                     "pressure that the closed valve holds +80 % +of an ideal valve's\n", "at the closed valve +0.5 m/s +met",
                     "while the valve moves +2 m/s +met", "above 3 m/s while it moves +0 ms +met", "1.0e-07 +met"):
            self.assertRegex(checks, text)
        self.assertIn((case / "report.txt").read_text(encoding="utf-8"), done.stdout)
        self.assertTrue((case / "aortic_valve.foam").exists())

    def test_a_narrow_orifice_has_its_cure(self):
        case, _ = self.write(orifice=[3e-4, 2e-4, "A thinner band."])
        done = self.run_case(case, tools=self.tools(*self.programs), FAULT="band_of_orifice")
        self.assertEqual(done.returncode, 1, done.stdout + done.stderr)
        # The areas are those of the plug-in, at the opening that the valve had. The cure follows the table.
        self.assertRegex(done.stdout, "left open by the band +2.37 cm2 +MISSED")
        self.assertRegex(done.stdout, "(?s)numerical checks.*closes 21 % of the orifice, so the blood meets a narrower valve "
                         ".*\nA thinner band.\n")
        case, _ = self.write()  # as if the valve were held: the open valve needs no cure
        done = self.run_case(case, tools=self.tools(*self.programs), FAULT="band_of_orifice")
        self.assertIn("\nIn riis patient, a smaller --half-thickness leaves more.\n", done.stdout)

    def test_changed_inputs_need_a_fresh_run(self):
        case, _ = self.write()
        tools = self.tools(*self.programs)
        self.assertEqual(self.run_case(case, tools=tools).returncode, 0)
        inlet = (case / "0/p").read_text(encoding="utf-8")
        (case / "0/p").write_text(inlet.replace("(0.2 ", "(0.21 "), encoding="utf-8")
        done = self.run_case(case, tools=tools)
        self.assertEqual((done.returncode, done.stdout), (1, ""))
        self.assertIn("since the results here were computed, 0/p changed.", done.stderr)
        self.assertIn("./Allrun --fresh removes the results", done.stderr)
        done = self.run_case(case, "picture", tools=tools)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("since these results were computed, 0/p changed: ./Allrun --fresh computes anew", done.stderr)
        done = self.run_case(case, "--fresh", tools=tools)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        # The run may get a later end, but no other entry.
        control = case / "system/controlDict"
        before = control.read_text(encoding="utf-8")
        for changed, status in (("endTime 0.8;", "endTime 1.6;"), 0), (("deltaT 0.001;", "deltaT 0.002;"), 1):
            self.assertIn(changed[0], before)
            control.write_text(before.replace(*changed), encoding="utf-8")
            done = self.run_case(case, tools=tools)
            self.assertEqual(done.returncode, status, done.stdout + done.stderr)
        self.assertIn("system/controlDict changed", done.stderr)
        # Removing log.inputs is the other cure that the message names.
        (case / "log.inputs").unlink()
        self.assertEqual(self.run_case(case, tools=tools).returncode, 0)
        # A new mesh is converted again.
        os.utime(case / "mesh.msh", (2e9, 2e9))
        (case / "constant/polyMesh/old").touch()
        self.assertEqual(self.run_case(case, tools=tools).returncode, 0)
        self.assertFalse((case / "constant/polyMesh/old").exists())

    def test_another_heart_rate(self):
        case, _ = self.write(period=0.6)
        table = numbers(self.dictionary(case, "0/p")["boundaryField"]["inlet"]["p0"])
        # At 100 beats a minute, systole is shorter by (546 - 210) / (546 - 157.5), and diastole has the rest.
        self.assertEqual((table[0], table[-2], table[1]), (0, 0.6, table[-1]))
        self.assertAlmostEqual(table[-4], 0.38 * 336 / 388.5, delta=1e-4)
        self.assertEqual(table[2::2], sorted(table[2::2]))
        control = self.dictionary(case, "system/controlDict")
        self.assertEqual((control["endTime"], control["functions"]["valve"]["period"]), (["0.6"], ["0.6"]))
        tools = self.tools(*self.programs)
        done = self.run_case(case, tools=tools, CUT_AT="0.6", CUT_STATUS="0")
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        self.assertRegex(done.stdout, "heart rate +100 /min")
        # By hand: the pressures, the period and the end must agree.
        case, _ = self.write()
        inlet = (case / "0/p").read_text(encoding="utf-8")
        self.assertIn("(0.8 ", inlet)
        (case / "0/p").write_text(inlet.replace("(0.8 ", "(0.6 "), encoding="utf-8")
        done = self.run_case(case, tools=tools)
        self.assertEqual((done.returncode, done.stdout), (1, ""))
        self.assertIn("the pressures of 0/p repeat after 0.6 s, but a beat has a period of 0.8 s in system/controlDict",
                      done.stderr)
        subprocess.run(["bash", "-c", done.stderr.split("Allrun:   ")[1]], cwd=case, check=True)
        self.assertEqual(self.dictionary(case, "system/controlDict")["functions"]["valve"]["period"], ["0.6"])
        self.assertIn("steps of 0.001 s", self.run_case(case, tools=tools).stdout)
        # A table of several beats is allowed.
        (case / "0/p").write_text(inlet.replace("(0.8 ", "(1.2 "), encoding="utf-8")
        self.assertIn("steps of 0.001 s", self.run_case(case, "--fresh", tools=tools).stdout)
        # The page changes all three places.
        page = " ".join((TEXTS.parents[2] / "docs/patient_openfoam.md").read_text(encoding="utf-8").split())
        for name in ("--heart-rate", "`endTime` and `period`"):
            self.assertIn(name, page)

    def test_help_and_interruption(self):
        case, _ = self.write()
        done = self.run_case(case, "--help", tools=self.tools())
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        for text in ("./Allrun [RANKS] ", "./Allrun --fresh [RANKS] ", "./Allrun picture "):
            self.assertIn(text, done.stdout)
        # Ctrl-C reaches the script and its solver.
        tools = self.tools(*self.programs)
        for written, words in ("0", "is written up to 0 s: the same command begins again"), (
                "0.02", "is written up to 0.02 s: the same command goes on from there"):
            shutil.rmtree(case)
            case, _ = self.write()
            (tools / "pimpleFoam").write_text(f"#!/bin/bash\nmkdir -p {written} postProcessing\nkill -INT 0\nsleep 20\n",
                                              encoding="utf-8")
            done = self.run_case(case, tools=tools, start_new_session=True)
            self.assertEqual(done.returncode, -2, done.stdout + done.stderr)
            self.assertIn(f"the run was interrupted, and {words}", done.stderr)
        (tools / "pimpleFoam").write_text("#!/bin/bash\nexit 1\n", encoding="utf-8")
        self.assertNotIn("ended before its first written time", self.run_case(case, tools=tools).stdout)
        shutil.rmtree(case / "0.02")
        self.assertIn("the last run here ended before its first written time, and begins again",
                      self.run_case(case, tools=tools).stdout)

    def drawn(self, case, tools):
        """Returns the arguments of riis for the picture. The stand-in for riis writes them down."""
        program = tools / "riis"
        program.write_text("#!/bin/bash\nprintf '%s\\n' \"$@\" >words\ntouch flow.png\n", encoding="utf-8")
        program.chmod(0o755)
        done = self.run_case(case, "picture", tools=tools, RIIS_PROGRAM=str(program))
        return done, (case / "words").read_text(encoding="utf-8").split("\n")[:-1]

    def test_a_picture_of_the_largest_flow(self):
        case, _ = self.write()
        tools = self.tools(*self.programs)
        done = self.run_case(case, "picture", tools=tools)
        self.assertEqual(done.returncode, 1, done.stdout)
        self.assertIn("has no tables in postProcessing: ./Allrun makes them", done.stderr)
        done = self.run_case(case, tools=tools, RIIS_PROGRAM="/no/riis")
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        # The flow is 100 ml/s from 0.101 to 0.3 s. The stand-in writes the times 0.2, 0.4, 0.6 and 0.8.
        done, words = self.drawn(case, tools)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        self.assertEqual(words, "mark 0.2 --valve placed.json --skirt 0.006 --wall wall.stl --half-thickness 0.001 --opening 1 "
                         "--picture flow.png --picture-velocity U --view valve-long".split())
        self.assertIn("flow.png shows the speed at 0.2 s, the written time with the largest flow through the open valve.",
                      done.stdout)
        self.assertIn(" mark 0.2 --valve placed.json", done.stdout)
        # A time whose row is missing may not be complete.
        table = case / "postProcessing/valve/0/riisValve.dat"
        table.write_text("\n".join(table.read_text(encoding="utf-8").split("\n")[:150]) + "\n", encoding="utf-8")
        done = self.run_case(case, "picture", tools=tools)
        self.assertEqual(done.returncode, 2, done.stdout + done.stderr)
        self.assertIn("there is nothing to draw yet", done.stderr)
        self.assertIn("its tables lack a part, and ./Allrun --fresh computes it anew", done.stderr)

    def test_a_beat_that_is_not_complete_has_a_status(self):
        case, _ = self.write()
        tools = self.tools(*self.programs)
        control = case / "system/controlDict"
        control.write_text(control.read_text(encoding="utf-8").replace("endTime 0.8;", "endTime 0.4;"), encoding="utf-8")
        done = self.run_case(case, tools=tools, CUT_AT="0.4", CUT_STATUS="0")
        self.assertEqual(done.returncode, 2, done.stdout + done.stderr)
        self.assertIn("the tables have 0.4 s of a beat of 0.8 s: what follows is preliminary", done.stdout)
        self.assertIn("the last beat is not complete", done.stderr)
        # The run has reached its end, so the end must be later.
        subprocess.run(["bash", "-c", done.stderr[done.stderr.index("  sed "):]], cwd=case, check=True)
        self.assertEqual(self.dictionary(case, "system/controlDict")["endTime"], ["0.8"])
        done = self.run_case(case, tools=tools)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        self.assertIn("from 0.4 s to 0.8 s", done.stdout)

    def test_one_folder_has_one_run(self):
        case, _ = self.write()
        tools = self.tools(*self.programs)
        owner = subprocess.Popen([shutil.which("flock"), case / ".lock", "sleep", "60"])
        self.addCleanup(owner.wait)
        self.addCleanup(owner.kill)
        (case / ".lock").write_text(f"{owner.pid}\n", encoding="utf-8")
        while subprocess.run(["flock", "-n", case / ".lock", "true"], check=False).returncode == 0:
            pass
        done = self.run_case(case, tools=tools)
        self.assertEqual(done.returncode, 1, done.stdout)
        self.assertIn(f"another Allrun runs here (process {owner.pid})", done.stderr)
        self.assertFalse((case / "postProcessing").exists())
        # The solver of an Allrun that was killed still has the lock.
        (case / ".lock").write_text("999999999\n", encoding="utf-8")
        done = self.run_case(case, tools=tools)
        self.assertEqual(done.returncode, 1, done.stdout)
        self.assertIn("(process 999999999) was killed, but the solver that it started still runs here", done.stderr)
        # A lock of dead processes is taken over.
        subprocess.run(["pkill", "-P", str(owner.pid)], check=False)
        owner.wait()
        self.assertEqual(self.run_case(case, tools=tools).returncode, 0)

    def test_a_run_that_diverged_starts_again(self):
        tools = self.tools(*self.programs)
        # The words of the plug-in, or the last row of the table, show that a run diverged.
        for fault in "words", "table":
            case, _ = self.write()
            done = self.run_case(case, tools=tools, CUT_AT="0.4", DIVERGES=fault)
            self.assertEqual(done.returncode, 1)
            self.assertIn("pimpleFoam failed", done.stderr)
            done = self.run_case(case, tools=tools)
            self.assertEqual((done.returncode, done.stdout), (1, ""), fault)
            self.assertRegex(done.stderr, "the last run here diverged .* and cannot go on")
            commands = [line.removeprefix("Allrun:   ") for line in done.stderr.split("\n") if line.startswith("Allrun:   ")]
            self.assertEqual(commands[1], "./Allrun --fresh")
            subprocess.run(["bash", "-c", commands[0]], cwd=case, check=True)
            self.assertAlmostEqual(numbers(self.dictionary(case, "system/controlDict")["deltaT"])[0], 5e-4, 12)
            self.assertEqual(self.run_case(case, "picture", tools=tools).returncode, 2)  # what is written can still be drawn
            (case / "processor0").mkdir()
            done = self.run_case(case, "--fresh", tools=tools)
            self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
            self.assertIn("--fresh removes the results of earlier runs: 2 written times, and postProcessing", done.stdout)
            self.assertIn("from 0 s to 0.8 s", done.stdout)
            self.assertFalse((case / "log.before").exists() or (case / "processor0").exists())
            self.assertEqual([path.name for path in (case / "postProcessing/valve").iterdir()], ["0"])
            self.assertTrue((case / "0/p").exists())
        done = self.run_case(case, "--fresh", "4", tools=tools)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        self.assertIn("on 4 processes", done.stdout)
        done = self.run_case(case, "--fresh", "picture", tools=tools)
        self.assertEqual(done.returncode, 1)
        self.assertIn("--fresh removes the times that picture would draw", done.stderr)
        self.assertTrue((case / "postProcessing").exists())

    def test_a_run_on_four_processes(self):
        case, _ = self.write()
        done = self.run_case(case, "4", tools=self.tools(*self.programs))
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        self.assertIn("on 4 processes", done.stdout)
        self.assertIn("mpirun 4", (case / "log.pimpleFoam").read_text(encoding="utf-8"))
        # The picture needs the plug-in only if times must be joined.
        for missing in ("processor0/0.2", "processor0/0.83"):
            (case / missing).mkdir()
            done = self.run_case(case, "picture", tools=self.tools(), RIIS_OPENFOAM="/no", RIIS_PROGRAM="/no/riis")
            self.assertEqual(done.returncode, 0 if missing.endswith("0.2") else 1, done.stdout + done.stderr)
        self.assertIn("OpenFOAM is missing", done.stderr)
        done = self.run_case(case, "picture", tools=self.tools(*self.programs), RIIS_OPENFOAM="/no")
        self.assertIn("the picture needs the plug-in, because it joins the parts of the run", done.stderr)

    def test_what_is_out_of_its_bounds_is_marked(self):
        for fault, text in (("leak", "multiple of the forecast.*MISSED"), ("balance", "inflow less outflow.*MISSED"),
                            ("band", "closed valve.*MISSED"), ("moving", "while the valve moves.*MISSED"),
                            ("back", "backward volume.*MISSED"),
                            ("band_of_orifice", "left open by the band +2.37 cm2 +MISSED: at least 80 %, 79 %")):
            case, _ = self.write()
            done = self.run_case(case, tools=self.tools(*self.programs), FAULT=fault)
            self.assertEqual(done.returncode, 1, fault)
            self.assertRegex(done.stdout, text)

    def test_a_run_that_was_cut_off_goes_on(self):
        case, _ = self.write()
        tools = self.tools(*self.programs)
        done = self.run_case(case, tools=tools, CUT_AT="0.4")
        self.assertEqual(done.returncode, 1)
        self.assertIn("pimpleFoam failed", done.stderr)
        done = self.run_case(case, tools=tools)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        self.assertIn("400 steps of 0.001 s from 0.4 s to 0.8 s", done.stdout)
        self.assertRegex(done.stdout, "forward volume .* 20 ml")
        # If a run was cut off before it wrote a time, the next run begins at the start. The old tables get another name.
        for table in list((case / "postProcessing").glob("*/0/*.dat")):
            table.rename(table.with_name(f"{table.stem}_0.dat"))
            table.write_text("", encoding="utf-8")
        done = subprocess.run([sys.executable, "report.py"], cwd=case, capture_output=True, text=True, check=False)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        self.assertRegex(done.stdout, "forward volume .* 20 ml")


def stand_in_beat():
    """Writes the tables of a beat and a log as pimpleFoam with the plug-in does. The tables begin at the last written time."""
    fault = os.environ.get("FAULT", "")
    start = max([float(path.name) for path in pathlib.Path().glob("0.*") if path.is_dir()] + [0])
    end = float(os.environ.get("CUT_AT", "0.8"))
    print("riis aortic_valve: the closed valve has 0.001 m2 in the mesh, and is expected to drop 0.8 of (R / eps) u")
    if os.environ.get("DIVERGES") == "words":
        print("valve aortic_valve at time 0.4: the run diverges: the blood at (0 0 0) has 319 m/s")
    rows, flows, speeds, pressures = [], [], [], []
    for step in range(round(1000 * start) + 1, round(1000 * end) + 1):
        time = step / 1000
        opening = 0.5 if fault == "held" else 1 if 100 < step <= 400 else 0
        flow = 1e-4 if 100 < step <= 300 else (-1e-5 if fault != "back" else -1e-4) if 300 < step <= 400 else 0
        difference = 5 * MMHG if opening else -90 * MMHG
        if fault == "held":
            flow = 1e-4 if step <= 300 else -2e-4
        if not opening:
            flow = difference * 1e-3 * 1e-3 / 1e4 / 0.8 * (1.01 if fault != "leak" else 1.1)
        speed = 3 if fault == "band" else 0.5
        free = 0.9 if fault != "band_of_orifice" else 0.79
        rows.append([time, opening, difference, flow, 0, 0, 3e-4 * opening, free * 3e-4 * opening, 0, speed])
        pressures.append([time, (125 if time == 0.2 else 80) * MMHG / RHO])
        flows.append([time, flow, -flow + (1e-11 if fault != "balance" else 1e-8)])
        is_last = step == round(1000 * end)
        fastest = 9 if fault == "moving" else "6.97e+13" if is_last and os.environ.get("DIVERGES") == "table" else 2
        speeds.append([time, "mag(U)", 0, "(0 0 0)", fastest, "(1 1 1)"])
    name = f"{start:g}"
    for folder, file, table in (("valve", "riisValve.dat", rows), ("pressure_outlet", "surfaceFieldValue.dat", pressures),
                                ("fastest", "fieldMinMax.dat", speeds),
                                ("flow_inlet", "surfaceFieldValue.dat", [row[:2] for row in flows]),
                                ("flow_outlet", "surfaceFieldValue.dat", [[row[0], row[2]] for row in flows])):
        path = pathlib.Path("postProcessing", folder, name, file)
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text("# Time\n" + "".join("\t".join(map(str, row)) + "\n" for row in table), encoding="utf-8")
    for written in (0.2, 0.4, 0.6, 0.8):
        if start < written <= end:
            pathlib.Path(f"{written:g}").mkdir(exist_ok=True)
            pathlib.Path(f"{written:g}", "U").touch()
    return 0 if end >= 0.8 else int(os.environ.get("CUT_STATUS", "1"))


if __name__ == "__main__":
    if sys.argv[1] == "--beat":
        sys.exit(stand_in_beat())
    WRITER = sys.argv.pop(1)
    unittest.main()
