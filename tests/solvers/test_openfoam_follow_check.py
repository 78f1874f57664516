# SPDX-License-Identifier: Apache-2.0
"""Tests which invented files in OpenFOAM's format examples/openfoam/follow.py refuses."""
import math
import re
import shutil
import sys
import unittest

from test_openfoam_check import Files, text_of  # if there is no numpy, it also ends the test

import numpy

import check  # noqa: E402
import follow  # noqa: E402

N, M = 60, 12  # cells and points of the mesh
DT = 1e-3
TIMES = [f"{(i + 1) * DT:g}" for i in range(8)]


def swing(i):
    """Returns rotation and shift of the mesh at step i."""
    a = 0.2 * numpy.sin(0.2 * i)
    return numpy.array([[1, 0, 0], [0, numpy.cos(a), -numpy.sin(a)], [0, numpy.sin(a), numpy.cos(a)]]), 4e-3 * a * numpy.ones(3)


def steady(i):
    return numpy.eye(3), numpy.array([0.1, 0.2, 0.3]) * DT * i


def rest(_):
    return numpy.eye(3), numpy.zeros(3)


def list_of(values, kind):
    return (f"FoamFile\n{{\n format binary; class {kind};\n}}\n{len(values)}\n(".encode() + values.tobytes() + b")\n")


class Follow(Files):
    def setUp(self):
        super().setUp()
        self.points = 0.02 * self.random.random((M, 3))
        self.points[:6] = [[0.0125, 0, -0.012], [-0.006, 0.011, -0.012], [-0.006, -0.011, -0.012], [0.01, 0.007, -0.006],
                           [-0.012, 0.005, -0.006], [0.001, -0.013, -0.006]]
        self.k = numpy.where(numpy.arange(N) < 30, self.random.random(N) + 1, 0)
        self.leaf = self.points[[0, 1, 2, 7, 8]] + 0.0
        self.rate = numpy.array([[0, 0, 0]] * 3 + [[0.1, 0, 0.2], [0, 0.3, 0]])
        self.write_case("follow-rest", rest, 1)
        for name, ranks in follow.SWING.items():
            self.write_case(name, swing, ranks)
        for name in ("follow-patch-restart", "follow-warp-restart"):
            self.write_case(name, swing, 2)
        self.write_case("follow-steady", steady, 1)
        self.write_case("follow-deform", swing, 2, deforms=True)

    def bend(self, i, points):
        """Moves points, in addition to the rigid motion."""
        return numpy.outer(numpy.sin(400 * points[:, 2] + 300 * points[:, 0]) * i / 8, [2e-4, 0, 1e-4])

    def write_case(self, name, motion, ranks, deforms=False, velocity=True, k=None, ku=None, shift=None, force=1.0,
                   pressure=100.0):
        case = self.folder / name
        shutil.rmtree(case, ignore_errors=True)
        ids = [numpy.arange(r, N, ranks) for r in range(ranks)]
        folders = self.parts(case, ids)
        self.write(case / "system/fvOptions", "aorticValve { resistance 1e4; halfThickness 1e-4; }\n")
        landmarks = " ".join("(%r %r %r)" % tuple(map(float, p)) for p in self.points[:6])
        self.write(case / "system/warp", f"sources ({landmarks});")
        faces = numpy.array([3 * i for i in range(M // 3 + 1)], "<i4")
        for folder in folders:
            self.write(folder / "constant/polyMesh/points", list_of(self.points, "vectorField"))
            self.write(folder / "constant/polyMesh/boundary", "wall { type wall; nFaces 4; startFace 0; }")
            self.write(folder / "constant/polyMesh/faces", list_of(faces, "faceCompactList")
                       + b"%d\n(" % M + numpy.arange(M, dtype="<i4").tobytes() + b")\n")
        log = "Create time\n"
        table = "# Time pressure_difference\n"
        before = None
        for i, time in enumerate(TIMES):
            turn, along = motion(i + 1)
            x = self.leaf + DT * (i + 1) * self.rate
            x = x @ turn.T + along
            if deforms:
                x[:3] += self.bend(i + 1, self.points[:3])
            if i == 0:
                before = self.leaf
            v = (x - before) / DT if velocity else numpy.zeros_like(x)
            before = x
            lines = ["# vtk", f"POINTS {len(x)} double"] + [" ".join(map(repr, map(float, p))) for p in x]
            lines += ["POLYGONS 2 8", "3 0 1 2", "3 2 3 4", f"POINT_DATA {len(x)}", "VECTORS velocity double"]
            lines += [" ".join(map(repr, map(float, p))) for p in v]
            self.write(case / f"postProcessing/aorticValve/{time}/leaflets.vtk", "\n".join(lines) + "\n")
            values = self.k.copy() if k is None else k
            momentum = values[:, None] * (numpy.ones(3) + (motion(2)[1] / 2 / DT if motion is steady else 0))
            momentum = momentum if ku is None else ku
            for folder, part in zip(folders, ids):
                now = self.points @ turn.T + along + (0 if shift is None else shift)
                now = now + (self.bend(i + 1, self.points) if deforms else 0)
                self.write(folder / time / "polyMesh/points", list_of(now, "vectorField"))
                self.write(folder / time / check.K_NAME, text_of(values[part], True))
                self.write(folder / time / check.KU_NAME, text_of(momentum[part], True))
            log += f"\nTime = {time}\nriis aorticValve: force of the flow (0 0 {force}) N\n"
            table += f"{time} {pressure}\n"
        self.write(case / "log.pimpleFoam", log)
        self.write(case / "postProcessing/valve/0/riisValve.dat", table)

    def refused(self, words):
        self.stopped(words, follow.follow, self.folder)

    def test_good_cases(self):
        printed = self.printed(follow.follow, self.folder)
        self.assertRegex(printed, r"follow-warp-2 +2 +11\.\d\N{DEGREE SIGN}")
        self.assertRegex(printed, r"follow-deform: nadirs move by up to \d\.\d\d mm, 0\.\d\d mm of it not rigid")
        self.assertIn("follow-warp-restart: K and K U_valve have the same bits after the restart", printed)

    def test_other_marks_and_k(self):
        k = self.k.copy()
        k[40] = 1e-200
        self.write_case("follow-zone", swing, 2, k=k)
        self.refused("follow-zone at 0.001 has the marks of the valve at rest: 1 cells differ")
        k = self.k.copy()
        k[3] *= 1 + 1e-10
        self.write_case("follow-zone", swing, 2, k=k)
        self.refused("follow-zone has the K of the valve at rest to 1e-12 of the largest")

    def test_a_velocity_without_that_of_the_mesh(self):
        self.write_case("follow-points", swing, 2, velocity=False)
        self.refused("the leaflets of follow-points have the velocity of the mesh to 1e-6: 1.0e+00")

    def test_leaflets_that_stay_behind(self):
        self.write_case("follow-patch-1", swing, 1, shift=[1e-6, 0, 0])
        self.refused("the leaflets of follow-patch-1 move with the mesh to 1e-6 half thicknesses: 1.0e-02")

    def test_a_mesh_that_does_not_move_or_deforms(self):
        self.write_case("follow-zone", rest, 2)
        self.refused("follow-zone moves by more than the half thickness: ")
        self.write_case("follow-zone", swing, 2, deforms=True)
        self.refused("the mesh of follow-zone moves as a rigid body: ")

    def test_ranks(self):
        self.write_case("follow-patch-2", swing, 1)
        self.refused("follow-patch-2 has 2 ranks, not 1")

    def test_a_restart_with_other_bits(self):
        k = self.k.copy()
        k[3] = numpy.nextafter(k[3], 9)
        self.write_case("follow-warp-restart", swing, 2, k=k)
        self.refused("follow-warp-restart at 0.005 has the bits of ")

    def test_other_ranks_of_the_velocity(self):
        self.write_case("follow-patch-2", swing, 2, ku=1.001 * self.k[:, None] * numpy.ones(3))
        self.refused("follow-patch has the same K and K U_valve on 1 and 2 ranks to 1e-10: 1.0e-03")

    def test_a_wall_that_does_not_deform_or_nadirs_that_rest(self):
        self.write_case("follow-deform", swing, 2)
        self.refused("deform deforms: ")
        self.leaf[0] += 1e-6
        self.write_case("follow-deform", swing, 2, deforms=True)
        self.refused("follow-deform move with the wall to 1e-6 half thicknesses: ")
        self.leaf[0] -= 1e-6
        self.write_case("follow-deform", swing, 2, deforms=True, velocity=False)
        self.refused("follow-deform have the velocity of the wall to 1e-3: ")

    def test_a_steady_mesh(self):
        self.write_case("follow-steady", steady, 1, ku=self.k[:, None] * numpy.ones(3))
        self.refused("follow-steady has the velocity of the mesh to 1e-9: ")
        self.write_case("follow-steady", steady, 1, force=1.03)
        self.refused("the force on the valve of follow-steady is that at rest to 2 %: 3.0e-02")
        self.write_case("follow-steady", steady, 1, pressure=106.0)
        self.refused("the places of the pressures of follow-steady move with the mesh: 6.0e-02")


class Angle(Files):
    def setUp(self):
        super().setUp()
        self.keys = {"pressureGain": 20, "flowGain": 2e6, "friction": 50, "vortexGain": 7e6, "angleMin": 5, "angleMax": 75}
        self.k = self.random.random(N) + 1
        times = DT * numpy.arange(1, 31)
        # At a constant pressure and without other torques, angle'' = a cos(angle). The square of the rate is therefore 2 a
        # sin(angle).
        self.keys.update(flowGain=0, friction=0, vortexGain=0, angleMin=0, angleMax=60)
        at, rate, self.opening = 0.0, 0.0, []
        for _ in times:
            for _ in range(200):  # the leapfrog
                rate += DT / 400 * 20 * 150 * math.cos(at)
                at += DT / 200 * rate
                rate += DT / 400 * 20 * 150 * math.cos(at)
            self.opening.append(min(1, at / math.radians(60)))
        self.times = times

    def cases(self, change=0.0, bits=False):
        case, again = self.folder / "angle", self.folder / "again"
        self.write(case / "system/fvOptions", "".join(f"{key} {value};\n" for key, value in self.keys.items()))
        self.log(case, self.times, numpy.array(self.opening) + change * numpy.array(self.opening), [100] * 30)
        text = (case / "log.pimpleFoam").read_text()
        text = re.sub("in the library", "in the library, pressure difference 150 Pa, flow 1e-5 m3/s", text)
        (case / "log.pimpleFoam").write_text(text)
        for folder in (case, again):
            self.parts(folder, [numpy.arange(N)])
            for time in ("0.015", "0.016", "0.017", "0.018", "0.019", "0.02"):
                k = self.k + (1e-12 if bits and folder == again else 0)
                self.write(folder / time / check.K_NAME, text_of(k, True))
                self.write(folder / time / check.KU_NAME, text_of(numpy.stack([k] * 3, axis=1), True))
        return case, again

    def test_a_good_case(self):
        self.assertIn("after four more steps K and K U_valve differ by 0.0e+00", self.printed(follow.angle, *self.cases()))

    def test_another_law(self):
        self.stopped("is that of the equation to 1e-4: ", follow.angle, *self.cases(change=-2e-4))
        self.keys["pressureGain"] = 21
        self.stopped("is that of the equation to 1e-4: ", follow.angle, *self.cases())

    def test_other_bits_after_the_restart(self):
        self.stopped("again at 0.016 has the bits of ", follow.angle, *self.cases(bits=True))


if __name__ == "__main__":
    unittest.main(argv=sys.argv)
