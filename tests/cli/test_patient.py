# SPDX-License-Identifier: Apache-2.0
"""test_patient.py PROGRAM MAKE_PATIENT.py: runs riis patient on small patients.

They are a root of make_patient.py with few triangles, and a ventricle. Checks the results by other commands and by units and axes
that must not matter, and each refusal by its status and text. RIIS_TEST_LONG also runs random roots.
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
import struct
import subprocess
import sys
import tempfile
import unittest

PROGRAM = ""
PATIENT = None  # the module make_patient
COARSE = ["--half-thickness", "1.6 mm", "--largest-edge", "5 mm"]  # cheap meshes


def write_stl(path, triangles, factor=1.0, sign=1.0):
    """Writes triangles in another unit, and with x and y reversed as between LPS and RAS if the sign is -1."""
    with open(path, "wb") as file:
        file.write(b"wall".ljust(80) + struct.pack("<I", len(triangles)))
        for triangle in triangles:
            turned = [(sign * factor * x, sign * factor * y, factor * z) for x, y, z in triangle]
            file.write(struct.pack("<12fH", 0, 0, 0, *turned[0], *turned[1], *turned[2], 0))


def write_landmarks(path, points, factor=1.0, sign=1.0, unit="mm", axes="LPS", **more):
    """Writes landmarks by name, given in mm and LPS."""
    def turned(point):
        return [sign * factor * point[0], sign * factor * point[1], factor * point[2]]
    text = {"unit": unit, "axes": axes, **more, "landmarks": {
        name: [turned(p) for p in at] if isinstance(at[0], (list, tuple)) else turned(at) for name, at in points.items()}}
    path.write_text(json.dumps(text), encoding="utf-8")


def volume_of(triangles):
    return sum(x * y for a, b, c in triangles for x, y in zip(a, PATIENT.cross(b, c))) / 6


class Ventricle:
    """A ventricle in mm: an ellipsoid with a tube to the atrium and a tube to the aorta, made by VTK. Both tubes are cut
    flat. The mitral annulus is a saddle on the wall of the first tube. The module vtk must be there."""

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
        return {"annulus": [at(90 + 11.25 + 22.5 * i) for i in range(16)], "anterior_horn": at(90), "posterior_horn": at(-90)}


class Patient(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.shared = pathlib.Path(tempfile.mkdtemp())
        cls.addClassCleanup(shutil.rmtree, cls.shared)
        # A shorter root with fewer triangles than that of docs/patient.md.
        PATIENT.N_ANGLES, PATIENT.SPACING, PATIENT.N_RINGS, PATIENT.TOP = 72, 1.2, 5, 45.0
        cls.root = PATIENT.Root()
        rng = random.Random(1)
        cls.triangles = list(PATIENT.wall_triangles(cls.root, PATIENT.waves(rng)))
        cls.landmarks = {name: [x + rng.gauss(0, 0.3) for x in place] for name, place in cls.root.landmarks(0)}

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def files(self, factor=1.0, sign=1.0, unit="mm", axes="LPS", wall_factor=1.0, wall_sign=1.0):
        """Writes the root and its landmarks."""
        write_stl(self.folder / "root.stl", self.triangles, wall_factor, wall_sign)
        write_landmarks(self.folder / "landmarks.json", self.landmarks, factor, sign, unit, axes)

    def run_riis(self, *words, **environment):
        return subprocess.run([PROGRAM, *words], cwd=self.folder, capture_output=True, text=True, check=False,
                              stdin=subprocess.DEVNULL, env={**os.environ, **environment})

    def patient(self, *words, wall="root.stl", landmarks="landmarks.json", output="case", **environment):
        return self.run_riis("patient", wall, landmarks, "--output", output, *words, **environment)

    def made(self, *words, output="case", **more):
        """Runs the command, which must succeed. Returns the report."""
        done = self.patient(*words, output=output, **more)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        self.assertFalse((self.folder / output / "UNFINISHED.txt").exists())
        return json.loads((self.folder / output / "patient.json").read_text(encoding="utf-8")), done

    def refused(self, status, text, *words, output="case", **more):
        """Runs the command, which must fail with one line on stderr that has the text, and leave nothing that looks finished."""
        done = self.patient(*words, output=output, **more)
        self.assertEqual(done.returncode, status, done.stdout + done.stderr)
        self.assertRegex(done.stderr, text)
        self.assertTrue(done.stderr.startswith("riis: "), done.stderr)
        self.assertFalse((self.folder / output / "patient.json").exists())
        return done

    def test_root(self):
        """A root in mm: the report agrees with what other commands find in the folder."""
        self.files()
        report, done = self.made(*COARSE)
        case = self.folder / "case"
        self.assertEqual((report["valve"], report["unit"], report["wall"]["axes"]), ("coapting", "mm", "LPS"))
        self.assertEqual((report["n_leaking_edges"], report["closed"], report["open"]), (0, "closed", "open"))
        self.assertEqual(sorted(b["name"] for b in report["boundaries"]), ["inlet", "outlet", "wall"])
        # The ends are the circles of the tube below the annulus and of the aorta.
        below = {b["name"]: b["centre"] for b in report["boundaries"]}
        for name, z in ("inlet", PATIENT.BOTTOM), ("outlet", PATIENT.TOP):
            self.assertLess(math.dist(below[name], self.root.placed(0, 0, z)), 1.0, name)
        # The points before and after the valve are on its sides, and their balls are in the blood.
        height = {name: sum((x - c) * e for x, c, e in zip(report[name], self.root.centre, self.root.e3))
                  for name in ("upstream", "downstream")}
        self.assertLess(height["upstream"], -report["ball_radius"])
        self.assertGreater(height["downstream"], max(h for _, h in self.root.commissures) - 8)
        # The mesh fills the wall.
        points = [",".join(map(str, report[name])) for name in ("upstream", "downstream")]
        check = self.run_riis("check", "leaks", "case/mesh.msh", "--valve", "case/placed.json", "--skirt", "6", "--wall",
                              "case/wall.stl", "--half-thickness", "1.6", "--opening", "0", "--demand-sealed", "--stats", "-",
                              "--between=" + points[0], points[1], "--quiet")
        self.assertEqual(check.returncode, 0, check.stdout + check.stderr)
        stats = json.loads(check.stdout)
        self.assertEqual((stats["n_nodes"], stats["n_volume_cells"]), (report["n_nodes"], report["n_cells"]))
        for name in "wall.stl", "mesh.vtu", "faces/inlet.vtp", "closed.vtu", "open.vtu", "beat.pvd", "leaflets.pvd":
            self.assertTrue((case / name).is_file(), name)
        # The printed commands run again, as they stand, in the folder.
        printed = re.findall(r"^  \$ (riis (?:place|size-field) .*)$", done.stdout, re.MULTILINE)
        self.assertEqual(len(printed), 2, done.stdout)
        before = {name: (case / name).read_bytes() for name in ("placed.json", "valve.dat")}
        for command in printed:
            subprocess.run([PROGRAM, *shlex.split(command)[1:]], cwd=case, check=True, capture_output=True)
        self.assertEqual(before, {name: (case / name).read_bytes() for name in before})
        # The folder is taken again only on request.
        self.assertRegex(self.patient().stderr, "--output: case: the folder has the results of an earlier run: .* --replace")

    def test_units_and_axes(self):
        """Wall and landmarks in any unit and axes give the same valve and about the same mesh."""
        found = {}
        cases = [("mm", {}, [], "mm"),
                 ("cm, landmarks in m and RAS", {"factor": 1e-3, "sign": -1, "unit": "m", "axes": "RAS", "wall_factor": 0.1}, [],
                  "cm"),
                 ("RAS wall", {"wall_sign": -1}, ["--unit", "cm"], "cm"),
                 ("m", {"wall_factor": 1e-3}, [], "m")]
        for name, files, words, unit in cases if os.environ.get("RIIS_TEST_LONG") == "1" else cases[:2]:
            self.files(**files)
            report, _ = self.made("--replace", *COARSE, *words)
            self.assertEqual(report["unit"], unit, name)
            self.assertEqual(report["wall"]["axes"], "RAS" if "wall_sign" in files else "LPS", name)
            mm = {"mm": 1, "cm": 10, "m": 1000}[unit]
            found[name] = (report["n_nodes"], report["effective_area_cm2"], report["gap"]["most"] * mm, report["fit"]["rms"] * mm)
        nodes, *measures = found["mm"]
        for name, (other_nodes, *others) in found.items():
            self.assertLess(abs(other_nodes / nodes - 1), 0.03, found)
            for a, b in zip(measures, others):
                self.assertAlmostEqual(a, b, delta=1e-3 * abs(a), msg=name)

    def test_ventricle(self):
        """A ventricle in metres with a mitral valve: the inlet is the end of the atrium."""
        try:
            ventricle = Ventricle()
            triangles = ventricle.triangles()
        except ImportError:
            self.skipTest("there is no vtk")
        write_stl(self.folder / "lv.stl", triangles, 1e-3)
        write_landmarks(self.folder / "landmarks.json", ventricle.landmarks(random.Random(3)))
        report, _ = self.made("--half-thickness", "2 mm", "--largest-edge", "8 mm", wall="lv.stl")
        self.assertEqual((report["valve"], report["unit"]), ("mitral", "m"))
        self.assertEqual((report["n_leaking_edges"], report["closed"], report["open"]), (0, "closed", "open"))
        centre = {b["name"]: b["centre"] for b in report["boundaries"]}
        atrium = [1e-3 * x for x in ventricle.placed((0, 0, 16))]
        self.assertLess(math.dist(centre["inlet"], atrium), math.dist(centre["outlet"], atrium))

    def test_options(self):
        """Options of the wall's unit, of the ends and of sick valves."""
        self.files()
        inlet = ",".join(map(str, self.root.placed(0, 0, PATIENT.TOP)))
        self.refused(1, "the end inlet at .* is after the valve: write --inlet X,Y,Z", *COARSE, "--inlet", inlet)
        report, done = self.made(*COARSE, "--valve", "aortic_regurgitation_severe")
        self.assertEqual(report["disease"], "aortic_regurgitation_severe")
        self.assertIn("because the band closes the gap of aortic_regurgitation_severe", done.stdout)

    def test_refused_options(self):
        self.files()
        self.refused(2, "--solver: nastran", "--solver", "nastran")
        self.refused(2, "--unit: openfoam takes metres, not millimetres: leave --unit out",
                     "--solver", "openfoam", "--unit", "mm")
        self.refused(2, "--half-thickness: 16 mm is not from 0.1 to 4 mm", "--half-thickness", "16 mm")
        self.files(wall_factor=1e-3)
        done = self.refused(2, "--half-thickness: 1 m is not from .* write --half-thickness '1 mm'", "--half-thickness", "1")
        self.assertFalse((self.folder / "case").exists(), done.stderr)
        self.refused(2, "--valve: the aortic valve does not close: write --valve coapting", "--valve", "aortic")
        self.refused(2, "--valve: riis patient takes .* not bileaflet", "--valve", "bileaflet")
        self.assertIn("--output is required", self.run_riis("patient", "root.stl", "landmarks.json").stderr)

    def test_refused_folders(self):
        self.files()
        case = self.folder / "case"
        case.mkdir()
        (case / "notes.txt").write_text("mine", encoding="utf-8")
        self.refused(1, "--output: case: the folder is not empty, and riis patient did not make it: name another", "--replace")
        self.assertEqual((case / "notes.txt").read_text(encoding="utf-8"), "mine")
        self.refused(1, "--output: no/case: cannot be made", output="no/case")
        self.refused(1, "--output: root.stl: is a file, not a folder", output="root.stl")
        # A folder of a run that was cut off is taken again. What it would remove may not be read.
        (case / "UNFINISHED.txt").write_text("", encoding="utf-8")
        shutil.copy(self.folder / "root.stl", case / "wall.stl")
        self.refused(1, "its wall.stl is also read, and would be removed: copy it elsewhere", wall="case/wall.stl")
        self.assertTrue((case / "wall.stl").exists())

    def test_refused_walls(self):
        self.files()
        here = self.folder
        write_stl(here / "hole.stl", self.triangles[:4000] + self.triangles[4003:])
        self.refused(1, "hole.stl: .*hole", wall="hole.stl")
        far = [tuple((x + 200, y, z) for x, y, z in t) for t in self.triangles]
        write_stl(here / "two.stl", self.triangles + far)
        self.refused(1, "two.stl: .*2 pieces", wall="two.stl")
        # Triangles that face inwards are turned, and the command says so.
        write_stl(here / "inwards.stl", [(a, c, b) for a, b, c in self.triangles])
        report, done = self.made(*COARSE, wall="inwards.stl", output="turned")
        self.assertRegex(done.stdout, "inwards.stl: .*turned")
        self.assertLess(report["n_leaking_edges"], 1)
        # The written wall faces outwards.
        data = (here / "turned" / "wall.stl").read_bytes()
        rows = [struct.unpack_from("<12f", data, 84 + 50 * i) for i in range(len(self.triangles))]
        self.assertGreater(volume_of([(r[3:6], r[6:9], r[9:12]) for r in rows]), 0.99 * volume_of(self.triangles))
        write_stl(here / "far.stl", far)
        self.refused(1, r"landmarks.json: the landmarks are \d+ mm from the wall of far.stl on average, and farther with "
                     "other units and axes.* same patient", wall="far.stl", output="none")
        self.refused(1, "they are .* mm from it with --wall-unit mm", "--wall-unit", "m", output="none")
        self.refused(1, "they are .* mm from it with --axes LPS", "--axes", "RAS", output="none")
        # A wide vessel: the landmarks are near the wall on average, but the wall is not within the skirt.
        wide = PATIENT.Root()
        wide.annulus, wide.junction, wide.aorta_radius = (17.0, 16.0, 30.0), (17.0, 21.0), 18.0
        write_stl(here / "wide.stl", list(PATIENT.wall_triangles(wide, lambda degrees, z: 0.0)))
        self.refused(1, "not within.*--skirt '[0-9.]+ mm' accepts it", "--skirt", "2 mm", wall="wide.stl", output="none")
        self.assertTrue((here / "none" / "UNFINISHED.txt").exists())

    def test_unclear_axes(self):
        """A wall around the axis z fits in LPS and in RAS."""
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
        """Files may have no more than 300 kB."""
        self.files()

        def limit():
            resource.setrlimit(resource.RLIMIT_FSIZE, (300000, 300000))
        done = subprocess.run([PROGRAM, "patient", "root.stl", "landmarks.json", "--output", "case"], cwd=self.folder, text=True,
                              capture_output=True, check=False, preexec_fn=limit)
        self.assertEqual(done.returncode, 1, done.stdout + done.stderr)
        self.assertRegex(done.stderr, "cannot be written|File too large")
        self.assertTrue((self.folder / "case" / "UNFINISHED.txt").exists())
        self.assertFalse((self.folder / "case" / "patient.json").exists())

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
