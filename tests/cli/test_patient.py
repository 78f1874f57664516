# SPDX-License-Identifier: Apache-2.0
"""test_patient.py PROGRAM MAKE_PATIENT.py: runs riis patient on small patients.

The patients are a root of make_patient.py with few triangles, and a ventricle. Other commands check the results. Units and axes
must not change the results. Each refusal is checked by its status and text. Only one run draws pictures, and its mesh is the wall
of another run. RIIS_TEST_LONG also runs random roots.
"""
import importlib.util
import json
import math
import os
import pathlib
import random
import re
import resource
import shlex
import shutil
import signal
import struct
import subprocess
import sys
import tempfile
import time
import unittest

PROGRAM = ""
PATIENT = None  # the module make_patient
COARSE = ["--half-thickness", "1.6 mm", "--largest-edge", "5 mm"]  # cheap meshes
CUT = ["--skirt", "0.01 mm"]  # no wall is so near, so the run ends after the valve is placed


def write_stl(path, triangles, factor=1.0, sign=1.0):
    """Writes triangles in another unit. If the sign is -1, reverses x and y, as between LPS and RAS."""
    with open(path, "wb") as file:
        file.write(b"wall".ljust(80) + struct.pack("<I", len(triangles)))
        for triangle in triangles:
            turned = [(sign * factor * x, sign * factor * y, factor * z) for x, y, z in triangle]
            file.write(struct.pack("<12fH", 0, 0, 0, *turned[0], *turned[1], *turned[2], 0))


def write_landmarks(path, points, factor=1.0, sign=1.0, unit="mm", axes="LPS", **more):
    """Writes landmarks by name. The landmarks' coordinates are given in mm and LPS."""
    def turned(point):
        return [sign * factor * point[0], sign * factor * point[1], factor * point[2]]
    text = {"unit": unit, "axes": axes, **more, "landmarks": {
        name: [turned(p) for p in at] if isinstance(at[0], (list, tuple)) else turned(at) for name, at in points.items()}}
    path.write_text(json.dumps(text), encoding="utf-8")


def volume_of(triangles):
    return sum(x * y for a, b, c in triangles for x, y in zip(a, PATIENT.cross(b, c))) / 6


class Ventricle:
    """Makes a ventricle in mm by VTK: an ellipsoid with a tube to the atrium and a tube to the aorta. Both tubes are cut flat.
    The mitral annulus is a saddle on the wall of the first tube. The module vtk must be installed."""

    CENTRE = (31.0, -142.0, 87.0)
    ENDS = [((0, 0, 16), (0, -0.3, 0.95)), ((0, 48, 14.7), (0, 0.62, 0.78))]  # a point of each plane, and its normal
    HALF_AXES = (19, 15.5)  # of the first tube

    def __init__(self):
        self.e3 = PATIENT.unit((0.45, 0.35, 0.82))  # towards the atrium
        self.e2 = PATIENT.unit(PATIENT.cross(self.e3, (0.0, 1.0, 0.2)))
        self.e1 = PATIENT.cross(self.e2, self.e3)

    def placed(self, p):
        return tuple(self.CENTRE[k] + p[0] * self.e1[k] + p[1] * self.e2[k] + p[2] * self.e3[k] for k in range(3))

    def triangles(self):
        import vtk  # noqa: PLC0415

        def quadric(a, b, c, linear=(0, 0, 0), constant=-1, cross_yz=0):
            made = vtk.vtkQuadric()
            made.SetCoefficients(a, b, c, 0, cross_yz, 0, *linear, constant)
            return made

        def joined(operation, *parts):
            made = vtk.vtkImplicitBoolean()
            made.SetOperationType(operation)
            for part in parts:
                made.AddFunction(part)
            return made

        def plane(origin, normal):
            made = vtk.vtkPlane()
            made.SetOrigin(*origin)
            made.SetNormal(*normal)
            return made

        body = quadric(1 / 27**2, 1 / 31**2, 1 / 45**2, (0, -26 / 31**2, 80 / 45**2), 13**2 / 31**2 + 40**2 / 45**2 - 1)
        first = joined(1, quadric(1 / self.HALF_AXES[0]**2, 1 / self.HALF_AXES[1]**2, 0), plane((0, 0, -14), (0, 0, -1)))
        tube = vtk.vtkCylinder()
        tube.SetCenter(0, 33, -4)
        tube.SetAxis(*PATIENT.unit(self.ENDS[1][1]))
        tube.SetRadius(11)
        second = joined(1, tube, plane((0, 28, -10), [-x for x in self.ENDS[1][1]]))
        sample = vtk.vtkSampleFunction()
        sample.SetImplicitFunction(joined(0, joined(1, body, plane((0, 0, -4), (0, 0, 1))), first, second))
        sample.SetModelBounds(-32, 32, -24, 68, -92, 40)
        sample.SetSampleDimensions(44, 62, 88)
        sample.ComputeNormalsOff()
        contour = vtk.vtkFlyingEdges3D()
        contour.SetInputConnection(sample.GetOutputPort())
        contour.SetValue(0, 0)
        planes = vtk.vtkPlaneCollection()
        for origin, normal in self.ENDS:
            planes.AddItem(plane(origin, [-x for x in normal]))
        clip = vtk.vtkClipClosedSurface()
        clip.SetInputConnection(contour.GetOutputPort())
        clip.SetClippingPlanes(planes)
        clean = vtk.vtkCleanPolyData()
        clean.SetInputConnection(clip.GetOutputPort())
        faces = vtk.vtkTriangleFilter()
        faces.SetInputConnection(clean.GetOutputPort())
        faces.PassLinesOff()
        faces.PassVertsOff()
        faces.Update()
        made = faces.GetOutput()
        return [tuple(self.placed(made.GetPoint(made.GetCell(i).GetPointId(k))) for k in range(3))
                for i in range(made.GetNumberOfCells())]

    def landmarks(self, rng, noise=0.3):
        a, b = self.HALF_AXES

        def at(degrees):
            t = math.radians(degrees)
            point = self.placed((a * math.cos(t), b * math.sin(t), 2.5 * math.sin(t)**2 + math.sin(t)))
            return [x + rng.gauss(0, noise) for x in point]
        return {"annulus": [at(90 + 11.25 + 22.5 * i) for i in range(16)], "anterior_horn": at(90), "posterior_horn": at(-90),
                "trigone": [at(48), at(132)]}


class Patient(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.shared = pathlib.Path(tempfile.mkdtemp())
        cls.addClassCleanup(shutil.rmtree, cls.shared)
        # This root is shorter than that of docs/patient.md, and has fewer triangles.
        PATIENT.N_ANGLES, PATIENT.SPACING, PATIENT.N_RINGS, PATIENT.TOP = 72, 1.2, 5, 45.0
        cls.root = PATIENT.Root()
        rng = random.Random(1)
        cls.triangles = list(PATIENT.wall_triangles(cls.root, PATIENT.waves(rng)))
        cls.landmarks = {name: [x + rng.gauss(0, 0.3) for x in place] for name, place in cls.root.landmarks(0)}
        # This PATH lacks the programs for pictures and movies, which take half of a run's time.
        cls.undrawn = {"PATH": str(cls.shared / "bin"), "DISPLAY": ""}
        (cls.shared / "bin").mkdir()
        for program in "gmsh", "timeout":
            (cls.shared / "bin" / program).symlink_to(shutil.which(program))

    @classmethod
    def root_case(cls):
        """Makes a complete run in mm, at the first call only. Returns the run's folder, its report and the finished
        process."""
        case = cls.shared / "root"
        if not case.exists():
            write_stl(cls.shared / "root.stl", cls.triangles)
            write_landmarks(cls.shared / "landmarks.json", cls.landmarks)
            cls.root_run = subprocess.run([PROGRAM, "patient", "root.stl", "landmarks.json", "--output", "root", *COARSE],
                                          cwd=cls.shared, capture_output=True, text=True, check=False)
        assert cls.root_run.returncode == 0, cls.root_run.stdout + cls.root_run.stderr
        return case, json.loads((case / "patient.json").read_text(encoding="utf-8")), cls.root_run

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def files(self, factor=1.0, sign=1.0, unit="mm", axes="LPS", wall_factor=1.0, wall_sign=1.0, turned_inwards=False):
        """Writes the root and its landmarks."""
        triangles = [(a, c, b) for a, b, c in self.triangles] if turned_inwards else self.triangles
        write_stl(self.folder / "root.stl", triangles, wall_factor, wall_sign)
        write_landmarks(self.folder / "landmarks.json", self.landmarks, factor, sign, unit, axes)

    def run_riis(self, *words, **environment):
        return subprocess.run([PROGRAM, *words], cwd=self.folder, capture_output=True, text=True, check=False,
                              stdin=subprocess.DEVNULL, env={**os.environ, **environment})

    def patient(self, *words, wall="root.stl", landmarks="landmarks.json", output="case", **environment):
        return self.run_riis("patient", wall, landmarks, "--output", output, *words, **environment)

    def made(self, *words, output="case", **more):
        """Runs the command without pictures. It must succeed. Returns the report and the process."""
        done = self.patient(*words, output=output, **{**self.undrawn, **more})
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        self.assertFalse((self.folder / output / "UNFINISHED.txt").exists())
        return json.loads((self.folder / output / "patient.json").read_text(encoding="utf-8")), done

    def refused(self, status, text, *words, output="case", **more):
        """Runs the command, which must fail. The command must print one line on stderr with the text, and leave no folder that
        looks finished."""
        done = self.patient(*words, output=output, **more)
        self.assertEqual(done.returncode, status, done.stdout + done.stderr)
        self.assertRegex(done.stderr, text)
        self.assertTrue(done.stderr.startswith("riis: "), done.stderr)
        self.assertFalse((self.folder / output / "patient.json").exists())
        return done

    def test_root(self):
        """Makes a run of a root in mm. The report agrees with the results of other commands in the folder."""
        case, report, done = self.root_case()
        self.assertFalse((case / "UNFINISHED.txt").exists())
        self.assertEqual((report["valve"], report["unit"], report["wall"]["axes"]), ("coapting", "mm", "LPS"))
        self.assertEqual((report["n_leaking_edges"], report["closed"], report["open"]), (0, "closed", "open"))
        self.assertEqual(sorted(b["name"] for b in report["boundaries"]), ["inlet", "outlet", "wall"])
        # The ends are the circles of the tube below the annulus and of the aorta.
        below = {b["name"]: b["centre"] for b in report["boundaries"]}
        for name, z in ("inlet", PATIENT.BOTTOM), ("outlet", PATIENT.TOP):
            self.assertLess(math.dist(below[name], self.root.placed(0, 0, z)), 1.0, name)
        # The points before and after the valve lie on the right sides, and the balls around them lie in the blood.
        height = {name: sum((x - c) * e for x, c, e in zip(report[name], self.root.centre, self.root.e3))
                  for name in ("upstream", "downstream")}
        self.assertLess(height["upstream"], -report["ball_radius"])
        self.assertGreater(height["downstream"], max(h for _, h in self.root.commissures) - 8)
        # The mesh fills the wall.
        points = [",".join(map(str, report[name])) for name in ("upstream", "downstream")]
        check = self.run_riis("check", "leaks", case / "mesh.msh", "--valve", case / "placed.json", "--skirt", "6", "--wall",
                              case / "wall.stl", "--half-thickness", "1.6", "--opening", "0", "--demand-sealed", "--stats", "-",
                              "--between=" + points[0], points[1], "--quiet")
        self.assertEqual(check.returncode, 0, check.stdout + check.stderr)
        stats = json.loads(check.stdout)
        self.assertEqual((stats["n_nodes"], stats["n_volume_cells"]), (report["n_nodes"], report["n_cells"]))
        for name in "wall.stl", "mesh.vtu", "faces/inlet.vtp", "closed.vtu", "open.vtu", "beat.pvd", "leaflets.pvd":
            self.assertTrue((case / name).is_file(), name)
        for name, program in ("closed.png", "Xvfb"), ("open.png", "Xvfb"), ("beat.mp4", "ffmpeg"):
            self.assertTrue((case / name).is_file() or not shutil.which(program), name)
        # The printed commands run again in the folder without changes.
        commands = (case / "commands.sh").read_text(encoding="utf-8")
        printed = re.findall(r"^(riis (?:place|size-field) .*)$", commands, re.MULTILINE)
        self.assertEqual(len(printed), 2, commands)
        # The picture for a talk has the skirt and the wall.
        self.assertRegex(commands, r"\n# a picture for a talk:\n"
                         "# riis mark mesh.msh --valve placed.json --skirt 6 --wall wall.stl .*"
                         "--picture talk.png")
        self.assertNotIn("$ riis", done.stdout)
        self.assertIn("commands.sh has the command of each next step", done.stdout)
        # The thick band narrows the valve. A check with the half thickness of the warning leaves 80 %.
        warned = re.search(r"the band, 1.6 mm on each side of the leaflets, closes (\d+) % of the orifice\. .* --half-thickness "
                           r"'([\d.]+) mm' would leave about 80 %\. It needs about [\d,]+ nodes\.\n", done.stderr)
        self.assertTrue(warned, done.stderr)
        self.assertAlmostEqual(report["open_share"], 1 - int(warned[1]) / 100, delta=0.006)
        cured = self.run_riis("check", "leaks", case / "mesh.msh", "--valve", case / "placed.json", "--skirt", "6", "--wall",
                              case / "wall.stl", "--half-thickness", warned[2], "--opening", "1", "--stats", "-",
                              "--between=" + points[0], points[1], "--quiet")
        orifice = json.loads(cured.stdout)["orifice"]
        self.assertAlmostEqual(orifice["effective_area"] / orifice["area"], 0.8, delta=0.015)
        self.assertRegex(done.stdout, r"skirt +closes the gap between the closed valve and the wall, at most [\d.]+ mm")
        before = {name: (case / name).read_bytes() for name in ("placed.json", "valve.dat")}
        for command in printed:
            subprocess.run([PROGRAM, *shlex.split(command)[1:]], cwd=case, check=True, capture_output=True)
        self.assertEqual(before, {name: (case / name).read_bytes() for name in before})
        # The folder is used again only on request.
        again = self.run_riis("patient", self.shared / "root.stl", self.shared / "landmarks.json", "--output", case)
        self.assertRegex(again.stderr, "--output: .*root: the folder has the results of an earlier run: .* --replace")

    def test_units_and_axes(self):
        """Wall and landmarks in any unit and axes give the same valve and about the same mesh. A wall whose triangles face
        inwards also gives them. Missing programs for pictures change nothing."""
        def measures_of(report):
            mm = {"mm": 1, "cm": 10, "m": 1000}[report["unit"]]
            return report["n_nodes"], report["effective_area_cm2"], report["gap"]["most"] * mm, report["fit"]["rms"] * mm
        found = {"mm": measures_of(self.root_case()[1])}
        cases = [("cm, landmarks in m and RAS", {"factor": 1e-3, "sign": -1, "unit": "m", "axes": "RAS", "wall_factor": 0.1}, [],
                  "cm", "LPS"),
                 ("RAS wall", {"wall_sign": -1}, ["--unit", "cm"], "cm", "RAS"),
                 ("m, landmarks in the wall's axes", {"wall_factor": 1e-3, "axes": "mesh"}, [], "m", "mesh")]
        for name, files, words, unit, axes in cases if os.environ.get("RIIS_TEST_LONG") == "1" else cases[:1]:
            self.files(**files, turned_inwards=name.startswith("cm"))
            report, done = self.made("--replace", *COARSE, *words)
            self.assertEqual((report["unit"], report["wall"]["axes"]), (unit, axes), name)
            found[name] = measures_of(report)
            self.assertEqual(sorted(report["missing"]), ["beat.mp4", "closed.png", "open.png"], name)
            self.assertRegex(done.stdout, "without closed.png: .*Xvfb.* package xvfb")
            self.assertRegex(done.stdout, "without beat.mp4: .*ffmpeg")
            if not name.startswith("cm"):
                continue
            self.assertRegex(done.stdout, "root.stl: all triangles face inwards, and are turned outwards")
            # The written wall faces outwards.
            data = (self.folder / "case" / "wall.stl").read_bytes()
            rows = [struct.unpack_from("<12f", data, 84 + 50 * i) for i in range(len(self.triangles))]
            self.assertGreater(1e3 * volume_of([(r[3:6], r[6:9], r[9:12]) for r in rows]), 0.99 * volume_of(self.triangles))
        nodes, *measures = found["mm"]
        for name, (other_nodes, *others) in found.items():
            self.assertLess(abs(other_nodes / nodes - 1), 0.03, found)
            for a, b in zip(measures, others):
                self.assertAlmostEqual(a, b, delta=1e-3 * abs(a), msg=name)

    def leaking_gmsh(self, n):
        """Returns a PATH with a changed gmsh. The first n volume meshes of this gmsh have edges that are three times as long."""
        tools = self.folder / f"bin{n}"
        tools.mkdir()
        (tools / "timeout").symlink_to(shutil.which("timeout"))
        (tools / "gmsh").write_text(f"""#!/bin/sh
longer=
if [ "$1" = -3 ]; then
  echo "$1" >>'{tools}/calls'
  [ "$({shutil.which("wc")} -l <'{tools}/calls')" -gt {n} ] || longer='-clscale 3'
fi
exec '{shutil.which("gmsh")}' "$@" $longer
""", encoding="utf-8")
        (tools / "gmsh").chmod(0o755)
        return {"PATH": str(tools)}

    def test_volume_mesh_again(self):
        """A volume mesh serves as the wall. One run is killed while gmsh works. In the next run both meshes leak. The last run
        makes a second mesh, which does not leak."""
        self.files()
        wall, first, _ = self.root_case()
        command = [PROGRAM, "patient", wall / "mesh.vtu", "landmarks.json", "--output", "case", *COARSE]
        environment = {**os.environ, **self.undrawn}
        case = self.folder / "case"
        commands = case / "commands.sh"
        with subprocess.Popen(command, cwd=self.folder, stdout=subprocess.DEVNULL, env=environment) as run:
            while run.poll() is None and not (commands.exists() and "\ngmsh -3" in commands.read_text(encoding="utf-8")):
                time.sleep(0.01)
            run.kill()
        self.assertTrue((case / "UNFINISHED.txt").exists())
        self.assertTrue((case / "gmsh" / "surface.msh").exists())
        # Ctrl-C says how to go on, and the same command takes the folder over.
        (case / "placed.json").unlink()
        with subprocess.Popen(command, cwd=self.folder, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True,
                              env=environment) as run:
            while run.poll() is None and not (case / "placed.json").exists():
                time.sleep(0.01)
            run.send_signal(signal.SIGINT)
            said = run.communicate()[1]
        self.assertEqual(run.returncode, -signal.SIGINT)
        self.assertIn("riis: stopped before the folder was finished: run the same command again\n", said)
        (case / "mine.txt").write_text("kept", encoding="utf-8")

        done = self.refused(1, r"\d+ edges? leaks? at 11 openings also in the second mesh, whose edges in the band have 0.855 "
                               "half thicknesses: --band-edge 0.769 makes them shorter, or --half-thickness '1.76 mm' thickens",
                            *COARSE, wall=wall / "mesh.vtu", **self.leaking_gmsh(2))
        self.assertRegex(done.stdout, r"leaks? at 11 openings: the mesh is made once more, with edges of 0.855 half thicknesses")

        # Each command needs seconds to measure the gap of a sick valve.
        sick = ["--valve", "aortic_regurgitation_severe"] if os.environ.get("RIIS_TEST_LONG") == "1" else []
        report, done = self.made(*COARSE, *sick, wall=wall / "mesh.vtu", **self.leaking_gmsh(1))
        self.assertRegex(done.stdout, r"leaks? at 11 openings: the mesh is made once more, with edges of 0.855 half thicknesses")
        self.assertEqual((report["n_leaking_edges"], report["open"]), (0, "open"))
        self.assertAlmostEqual(report["band_edge"], 0.9 * first["band_edge"])
        # In both meshes, pressures are read at the same places, up to an edge length.
        for name in "upstream", "downstream":
            self.assertLess(math.dist(report[name], first[name]), report["band_edge"] * report["half_thickness"], name)
        # The option is in a command, and in the last lines.
        self.assertIn("--band-edge 0.855", (case / "commands.sh").read_text(encoding="utf-8"))
        self.assertEqual(done.stdout.count("--band-edge 0.855"), 1, done.stdout)
        self.assertEqual((case / "mine.txt").read_text(encoding="utf-8"), "kept")
        if sick:
            self.assertEqual(report["disease"], "aortic_regurgitation_severe")
            self.assertIn("because the band closes the gap of aortic_regurgitation_severe", done.stdout)
        # The program finds the ends of the volume mesh again.
        before, after = ({b["name"]: b for b in one["boundaries"]} for one in (first, report))
        self.assertEqual(sorted(before), sorted(after))
        for name, boundary in after.items():
            self.assertLess(math.dist(boundary["centre"], before[name]["centre"]), 0.3, name)
            self.assertAlmostEqual(boundary["area"] / before[name]["area"], 1, delta=0.03, msg=name)

    def test_folds(self):
        """If the warp folds, the message names one cure, and riis place confirms it. Sizes of a valve may also make it fold, and
        no change of the warp cures this."""
        self.files()
        places = dict(self.root.landmarks(3))
        aside = PATIENT.unit(PATIENT.cross(self.root.e3, [x - c for x, c in zip(places["nadir_left"], self.root.centre)]))

        def moved(name, direction, by):
            point = [x + by * e for x, e in zip(places[name], direction)]
            write_landmarks(self.folder / "landmarks.json", {**places, name: point})

        def place(*words):
            return self.run_riis("place", "landmarks.json", "--valve", "coapting", *words, "--output", "trial.json").returncode
        moved("nadir_left", aside, 8)
        done = self.refused(1, "the warp folds near .*--warp smoothed does not fold", "--warp", "exact")
        self.assertEqual((done.stderr.count("not fold"), done.stderr.count("--noise")), (1, 0), done.stderr)
        self.assertEqual((place("--warp", "exact"), place("--warp", "smoothed")), (1, 0))
        moved("nadir_left", aside, -6)
        for words in ["--warp", "exact"], []:
            self.refused(1, r"the warp (folds|turns) .*\. It does not fold with --warp smoothed --noise '0.6 mm', but first look "
                            "for a misplaced landmark", *words)
        self.assertEqual((place("--warp", "smoothed"), place("--warp", "smoothed", "--noise", "0.6")), (1, 0))
        moved("commissure_right_left", self.root.e3, -10)
        done = self.refused(1, "the landmarks give .* and then cusp . would fold .*--set")
        self.assertNotRegex(done.stderr, "not fold|--warp|--noise")
        self.assertEqual((place("--warp", "none"), place("--warp", "smoothed")), (1, 1))

    def test_ventricle(self):
        """A ventricle in metres with a mitral valve: the inlet is the end of the atrium. Trigones are among the landmarks."""
        try:
            ventricle = Ventricle()
            triangles = ventricle.triangles()
        except ImportError:
            self.skipTest("there is no vtk")
        write_stl(self.folder / "lv.stl", triangles, 1e-3)
        write_landmarks(self.folder / "landmarks.json", ventricle.landmarks(random.Random(3)))
        report, done = self.made("--half-thickness", "2 mm", "--largest-edge", "8 mm", "--solver", "openfoam", "--heart-rate",
                                 "70", wall="lv.stl")
        # The duration of a beat is rounded to the time between two files, in the pressures and in the end of the run.
        self.assertIn("for openfoam, at 69.8 beats a minute: a beat lasts 0.86 s, a multiple of", done.stdout)
        self.assertRegex((self.folder / "case/openfoam/0/p").read_text(encoding="utf-8"), r"p0 table \(.* \(0.86 [\d.]+\)\);")
        self.assertRegex((self.folder / "case/openfoam/system/controlDict").read_text(encoding="utf-8"),
                         r"(?s)endTime 0\.86;.*period 0\.86;")
        self.assertEqual((report["valve"], report["unit"]), ("mitral", "m"))
        # The horns show the side of the atrium. A flow into the atrium is refused before the mesh is made.
        along = report["flow"]
        for sign, status in (-1, 2), (1, 0):
            direction = ",".join(str(sign * x) for x in along)
            found = self.patient("--flow=" + direction, *CUT, wall="lv.stl", output="flow")
            text = "--flow: .* points into the atrium: both horns .* show a flow along .*: leave out --flow"
            self.assertEqual(bool(re.search(text, found.stderr)), status == 2, found.stderr)
            self.assertEqual(found.returncode, 2 if status == 2 else 1, found.stderr)
        self.refused(2, "--valve: .* are those of a mitral valve, and coapting is an aortic valve: leave out --valve",
                     "--valve", "coapting", wall="lv.stl", output="none")
        self.assertEqual((report["n_leaking_edges"], report["closed"], report["open"]), (0, "closed", "open"))
        centre = {b["name"]: b["centre"] for b in report["boundaries"]}
        atrium = [1e-3 * x for x in ventricle.placed((0, 0, 16))]
        self.assertLess(math.dist(centre["inlet"], atrium), math.dist(centre["outlet"], atrium))
        # The places where pressures are read lie on the valve's axis, and do not depend on the mesh.
        for name, sign in ("upstream", -1), ("downstream", 1):
            away = [x - c for x, c in zip(report[name], report["centre"])]
            along = sum(x * f for x, f in zip(away, report["flow"]))
            self.assertGreater(sign * along, report["ball_radius"], name)
            self.assertLess(math.hypot(*(x - along * f for x, f in zip(away, report["flow"]))), 2e-5, name)
        if os.environ.get("RIIS_TEST_LONG") == "1":
            finer, _ = self.made("--half-thickness", "2 mm", "--largest-edge", "6 mm", "--band-edge", "0.76", "--replace",
                                 wall="lv.stl")
            self.assertGreater(finer["n_nodes"], 1.3 * report["n_nodes"])
            for name in "upstream", "downstream":
                self.assertLess(math.dist(report[name], finer[name]), 2e-5, name)

    def test_wrong_end(self):
        """An end is on the wrong side of the valve. The message names the option, and prints the right options."""
        self.files()
        bottom, top = (self.root.placed(0, 0, z) for z in (PATIENT.BOTTOM, PATIENT.TOP))
        for option, point, words in (("inlet", top, "the end inlet at .*, which --inlet chose, is after the valve"),
                                     ("outlet", bottom, "the end outlet at .*, which --outlet chose, is before the valve")):
            done = self.refused(1, words, *COARSE, f"--{option}=" + ",".join(map(str, point)))
            inlet, outlet = re.search(": write --inlet=([^ ]+) --outlet=([^ ]+)$", done.stderr.strip()).groups()
            for text, end in (inlet, bottom), (outlet, top):
                self.assertLess(math.dist(map(float, text.split(",")), end), 1.0, done.stderr)

    def test_refused_options(self):
        self.files()
        self.refused(2, "--solver: nastran", "--solver", "nastran")
        self.refused(2, "--unit: openfoam takes metres, not millimetres: leave --unit out",
                     "--solver", "openfoam", "--unit", "mm")
        self.refused(2, "--half-thickness: 16 mm is not from 0.1 to 4 mm", "--half-thickness", "16 mm")
        self.files(wall_factor=1e-3)
        done = self.refused(2, "--half-thickness: 1 m is not from .* write --half-thickness '1 mm'", "--half-thickness", "1")
        self.assertFalse((self.folder / "case").exists(), done.stderr)
        # If a number has another unit than the wall, the message names the unit in which the number fits.
        self.files()
        self.refused(2, "--half-thickness: 1e-3 mm is not from 0.1 to 4 mm; without a unit, the number has that of WALL: "
                     "write --half-thickness '1e-3 m' if metres are meant$", "--half-thickness", "1e-3")
        self.refused(2, "--half-thickness: 50 mm is not from 0.1 to 4 mm$", "--half-thickness", "50")
        self.refused(2, "--heart-rate needs --solver", "--heart-rate", "60")
        self.refused(2, "--heart-rate: 39.9 is not from 40 to 180 beats a minute", "--heart-rate", "39.9", "--solver", "openfoam")
        self.refused(2, "--hold needs --solver openfoam", "--hold", "0.5")
        self.refused(2, "--hold: the opening must be below 1, but it is 1: write --hold 0.999", "--hold", "1",
                     "--solver", "openfoam")
        self.refused(2, "--valve: .* are those of an aortic valve, and mitral is a mitral valve: leave out --valve",
                     "--valve", "mitral")
        self.refused(2, "--valve: the aortic valve does not close: write --valve coapting", "--valve", "aortic")
        self.refused(2, "--valve: riis patient takes .*, or a disease of riis help diseases, not bileaflet", "--valve",
                     "bileaflet")
        self.assertIn("aortic_stenosis_severe", self.run_riis("help", "diseases").stdout)
        self.assertIn("--output is required", self.run_riis("patient", "root.stl", "landmarks.json").stderr)
        # A file of landmarks may state its unit and axes.
        text = json.loads((self.folder / "landmarks.json").read_text(encoding="utf-8"))
        for key, message in ("unit", "unit: it is missing; it must be m, cm or mm"), ("axes", "they must be LPS, RAS or mesh"):
            less = {name: value for name, value in text.items() if name != key}
            (self.folder / "landmarks.json").write_text(json.dumps(less), encoding="utf-8")
            self.refused(1, message)

    def test_numbers_in_another_unit_than_stated(self):
        """The numbers are in cm or m, and the file states mm, or the other way round."""
        for factor, unit, stated in (0.1, "cm", "mm"), (1e-3, "m", "mm"), (1, "mm", "cm"), (0.1, "cm", "m"):
            self.files(factor=factor, unit=stated)
            done = self.refused(1, f"landmarks.json: its numbers are probably in {unit}, but it states {stated}: .*: "
                                   f'write "unit": "{unit}" in it', output="none")
            self.assertFalse((self.folder / "none").exists(), done.stderr)
        # A file of 3D Slicer has another key.
        markups = {"markups": [{"coordinateSystem": "LPS", "coordinateUnits": "cm", "controlPoints": [
            {"label": name, "position": point} for name, point in self.landmarks.items()]}]}
        (self.folder / "points.mrk.json").write_text(json.dumps(markups), encoding="utf-8")
        self.refused(1, 'points.mrk.json: its numbers are probably in mm, but it states cm: .*: write "coordinateUnits": "mm" in',
                     landmarks="points.mrk.json", output="none")
        # The change that the message names cures the file.
        text = (self.folder / "landmarks.json").read_text(encoding="utf-8")
        (self.folder / "landmarks.json").write_text(text.replace('"unit": "m"', '"unit": "cm"'), encoding="utf-8")
        self.refused(2, "--half-thickness: 9 mm is not from", "--half-thickness", "9 mm", output="none")

    def test_names_of_landmarks(self):
        self.files()
        text = json.loads((self.folder / "landmarks.json").read_text(encoding="utf-8"))
        points = text["landmarks"]
        less = {name: point for name, point in points.items() if name != "commissure_left_non_coronary"}
        self.assertEqual(len(less), len(points) - 1)
        (self.folder / "landmarks.json").write_text(json.dumps({**text, "landmarks": less}), encoding="utf-8")
        self.refused(1, "landmarks.json: lacks commissure_left_non_coronary, which the coapting valve needs: add this point",
                     output="none")
        slicer = {f"F-{i + 1}": point for i, point in enumerate(points.values())}
        (self.folder / "landmarks.json").write_text(json.dumps({**text, "landmarks": slicer}), encoding="utf-8")
        done = self.refused(1, '"F-1" is not the name of a landmark.*nadir_right, nadir_left, nadir_non_coronary, '
                               "commissure_right_left, commissure_left_non_coronary, commissure_non_coronary_right; a mitral "
                               "valve has other names; riis help landmarks lists",
                            output="none")
        self.assertNotIn("...;", done.stderr)
        # Two names are exchanged. The message names both, and the file of the user.
        nadirs = {"nadir_right": points["nadir_left"], "nadir_left": points["nadir_right"]}
        (self.folder / "changed.json").write_text(json.dumps({**text, "landmarks": {**points, **nadirs}}), encoding="utf-8")
        self.refused(1, '^riis: changed.json: the name of "nadir_[rl][a-z]*t" and that of "nadir_[rl][a-z]*t" are exchanged',
                     landmarks="changed.json", output="changed")
        # A bicuspid valve has other points.
        bicuspid = "a bicuspid valve has the points nadir_cusp_0, nadir_cusp_1, commissure_1, commissure_2"
        (self.folder / "landmarks.json").write_text(json.dumps(text), encoding="utf-8")
        self.refused(1, f'"nadir_non_coronary" names a cusp that a bicuspid valve lacks: {bicuspid}', "--valve", "bicuspid",
                     output="none")
        commissures = {f"commissure_{i}": points[name] for i, name in enumerate(n for n in points if "commissure" in n)}
        two = {name: points[name] for name in ("nadir_right", "nadir_left")}
        (self.folder / "landmarks.json").write_text(json.dumps({**text, "landmarks": {**two, **commissures}}), encoding="utf-8")
        self.refused(1, f"has 3 commissures, which are 1 too many: {bicuspid}", "--valve", "bicuspid", output="none")
        joined = {f"commissure_cusp_{i}_cusp_{1 - i}": points["nadir_left"] for i in (0, 1)}
        (self.folder / "landmarks.json").write_text(json.dumps({**text, "landmarks": joined}), encoding="utf-8")
        self.refused(1, '"commissure_cusp_1_cusp_0" is given twice; the commissures of a bicuspid valve are commissure_1 and '
                     "commissure_2", "--valve", "bicuspid", output="none")
        (self.folder / "landmarks.json").write_text(json.dumps({**text, "landmarks": slicer}), encoding="utf-8")
        self.refused(1, "the mitral valve has annulus_1, annulus_2, .* and anterior_horn; riis help landmarks lists", "--valve",
                     "mitral", output="none")

    def test_refused_folders(self):
        self.files()
        case = self.folder / "case"
        case.mkdir()
        (case / "notes.txt").write_text("mine", encoding="utf-8")
        self.refused(1, "--output: case: the folder is not empty, and riis patient did not make it: name another folder",
                     "--replace")
        self.assertEqual((case / "notes.txt").read_text(encoding="utf-8"), "mine")
        self.refused(1, "--output: root.stl/case: cannot be made: Not a directory", output="root.stl/case")
        # Parent folders are made. A far wall is refused in the new folder.
        self.refused(1, "wall.stl: the wall is not within --skirt", *CUT, output="new/parent/case")
        self.assertTrue((self.folder / "new/parent/case/UNFINISHED.txt").exists())
        # The message names the results of a solver that --replace would remove.
        for computed, words in (("openfoam/0.8", "a computed beat of 0.8 s in openfoam"),
                                ("openfoam/processor0/0.46", "a computed beat of 0.46 s in openfoam"),
                                ("svmultiphysics/4-procs", "the computed svmultiphysics/4-procs"),
                                ("fenicsx/flow_001.bp", "the computed fenicsx/flow_001.bp")):
            shutil.rmtree(self.folder / "old", ignore_errors=True)
            (self.folder / "old" / computed).mkdir(parents=True)
            (self.folder / "old" / "openfoam/0").mkdir(parents=True, exist_ok=True)
            (self.folder / "old/patient.json").write_text("{}", encoding="utf-8")
            done = self.patient(output="old")
            self.assertEqual(done.returncode, 1)
            self.assertIn(f"write --replace, which also removes {words}", done.stderr)
            done = self.patient("--replace", *CUT, output="old")
            self.assertRegex(done.stdout, f"(?m)^replaced  removed {words}$")
            self.assertFalse((self.folder / "old" / computed).exists())
        # While a solver runs there, nothing is removed.
        shutil.rmtree(self.folder / "old")
        lock = self.folder / "old/openfoam/.lock"
        lock.parent.mkdir(parents=True)
        (self.folder / "old/patient.json").write_text("{}", encoding="utf-8")
        owner = subprocess.Popen(["flock", lock, "sleep", "60"])
        self.addCleanup(owner.wait)
        self.addCleanup(owner.kill)
        while subprocess.run(["flock", "-n", lock, "true"], check=False).returncode == 0:
            time.sleep(0.01)
        lock.write_text("123\n", encoding="utf-8")
        for words in [["--replace"], []]:
            done = self.patient(*words, output="old")
            self.assertEqual(done.returncode, 1, done.stdout + done.stderr)
            self.assertTrue((self.folder / "old/patient.json").exists())
            self.assertFalse((self.folder / "old/UNFINISHED.txt").exists())
            self.assertIn("a run in its folder openfoam has not ended (process 123), and nothing is removed" if words
                          else "write --replace", done.stderr)
            self.assertTrue(lock.exists())
        subprocess.run(["pkill", "-P", str(owner.pid)], check=False)
        owner.wait()
        self.refused(1, "wall.stl: the wall is not within --skirt", "--replace", *CUT, output="old")
        self.assertFalse(lock.exists())
        self.refused(1, "--output: root.stl: is a file, not a folder", output="root.stl")
        # If a run was cut off, the next run may use the same folder. Files that the program would remove there cannot be inputs.
        (case / "UNFINISHED.txt").write_text("", encoding="utf-8")
        shutil.copy(self.folder / "root.stl", case / "wall.stl")
        self.refused(1, "its wall.stl is also an input, and would be removed: copy it elsewhere", wall="case/wall.stl")
        self.assertTrue((case / "wall.stl").exists())

    def test_refused_walls(self):
        self.files()
        here = self.folder
        write_stl(here / "hole.stl", self.triangles[:4000] + self.triangles[4003:])
        self.refused(1, "hole.stl: .*hole", wall="hole.stl")
        # A pinhole cannot be an end.
        write_stl(here / "pinhole.stl", self.triangles[:4000] + self.triangles[4001:])
        done = self.refused(1, "pinhole.stl: the surface has a hole of 3 edges at .*: close it", wall="pinhole.stl")
        self.assertNotIn("--outlet", done.stderr)
        far = [tuple((x + 200, y, z) for x, y, z in t) for t in self.triangles]
        write_stl(here / "two.stl", self.triangles + far)
        self.refused(1, "two.stl: .*2 pieces", wall="two.stl")
        write_stl(here / "far.stl", far)
        self.refused(1, r"landmarks.json: the landmarks are \d+ mm from the wall of far.stl on average, and farther "
                     "away with other units and axes.* same patient.* mirrored", wall="far.stl", output="none")
        self.refused(1, "they are .* mm from it with --wall-unit mm", "--wall-unit", "m", output="none")
        self.refused(1, "they are .* mm from it with --axes LPS", "--axes", "RAS", output="none")
        # In a wide vessel, the landmarks are near the wall on average, but the skirt does not reach the wall.
        wide = PATIENT.Root()
        wide.annulus, wide.junction, wide.aorta_radius = (17.0, 16.0, 30.0), (17.0, 21.0), 18.0
        write_stl(here / "wide.stl", list(PATIENT.wall_triangles(wide, lambda degrees, z: 0.0)))
        done = self.refused(1, "wall.stl: the wall is not within --skirt, 2, at .*--skirt '[0-9.]+ mm' is long enough", "--skirt",
                            "2 mm", wall="wide.stl", output="none")
        self.assertRegex(done.stderr, "landmarks.json: the landmarks are [2-5].* mm from the wall of wide.stl on average, but a "
                         "person usually sets them within 1 mm: they may belong to another patient")
        self.assertTrue((here / "none" / "UNFINISHED.txt").exists())

    def test_unclear_axes(self):
        """A wall around the axis z fits both in LPS and in RAS."""
        tube = [tuple((12.5 * math.cos(t), 12.5 * math.sin(t), z) for t, z in corners)
                for i in range(48) for z0 in range(-15, 45, 3)
                for a, b in [(2 * math.pi * i / 48, 2 * math.pi * (i + 1) / 48)]
                for corners in [[(a, z0), (b, z0), (b, z0 + 3)], [(a, z0), (b, z0 + 3), (a, z0 + 3)]]]
        for z, turn in (-15, -1), (45, 1):
            for i in range(48):
                p = [(12.5 * math.cos(2 * math.pi * k / 48), 12.5 * math.sin(2 * math.pi * k / 48), z) for k in (i, i + 1)]
                tube.append(((0, 0, z), *p[::turn]))
        write_stl(self.folder / "root.stl", tube)
        write_landmarks(self.folder / "landmarks.json", {
            name: [r * math.cos(math.radians(t)), r * math.sin(math.radians(t)), z] for name, r, t, z in
            [(f"nadir_{n}", 12.3, 120 * i, 0) for i, n in enumerate(("right", "left", "non"))] +
            [(f"commissure_{n}", 12.7, 60 + 120 * i, 16) for i, n in enumerate(("right_left", "left_non", "non_right"))]})
        self.refused(2, "root.stl: its axes are not clear, .* with --axes LPS, and .* with --axes RAS: write one of them")

    def test_no_gmsh(self):
        self.files()
        self.refused(1, "gmsh: there is no such program in PATH.*apt-get install gmsh", PATH=str(self.folder))
        self.assertFalse((self.folder / "case").exists())

    def test_full_disc(self):
        """Limits the size of files to 300 kB."""
        self.files()

        def limit():
            resource.setrlimit(resource.RLIMIT_FSIZE, (300000, 300000))
        done = subprocess.run([PROGRAM, "patient", "root.stl", "landmarks.json", "--output", "case"], cwd=self.folder, text=True,
                              capture_output=True, check=False, preexec_fn=limit)
        self.assertEqual(done.returncode, 1, done.stdout + done.stderr)
        self.assertRegex(done.stderr, "cannot be written|File too large")
        self.assertTrue((self.folder / "case" / "UNFINISHED.txt").exists())
        self.assertFalse((self.folder / "case" / "patient.json").exists())
        # The disc is full when the run writes its first file.
        (self.folder / "full").mkdir()
        (self.folder / "full" / "UNFINISHED.txt").symlink_to("/dev/full")
        self.refused(1, "UNFINISHED.txt: cannot be written: .*The disc is full: free some space, .* by --output", output="full")

    @unittest.skipUnless(os.environ.get("RIIS_TEST_LONG") == "1", "long")
    def test_random_roots(self):
        for seed in range(1, 6):
            rng = random.Random(seed)
            root = PATIENT.Root.drawn(rng)
            write_stl(self.folder / "root.stl", list(PATIENT.wall_triangles(root, PATIENT.waves(rng))), 0.1)
            write_landmarks(self.folder / "landmarks.json",
                            {name: [x + rng.gauss(0, 0.3) for x in place] for name, place in root.landmarks(3)})
            report, _ = self.made("--replace")
            self.assertEqual((report["n_leaking_edges"], report["closed"], report["open"]), (0, "closed", "open"), seed)


def main():
    global PROGRAM, PATIENT  # noqa: PLW0603
    PROGRAM = sys.argv.pop(1)
    spec = importlib.util.spec_from_file_location("make_patient", sys.argv.pop(1))
    PATIENT = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(PATIENT)
    if not shutil.which("gmsh"):
        print("skipped: there is no gmsh")
        return 77
    return 0 if unittest.main(exit=False, verbosity=2).result.wasSuccessful() else 1


if __name__ == "__main__":
    sys.exit(main())
