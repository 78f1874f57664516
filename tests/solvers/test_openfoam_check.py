# SPDX-License-Identifier: Apache-2.0
"""Tests which invented files in OpenFOAM's format examples/openfoam/check.py refuses."""
import contextlib
import io
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

try:
    import numpy
except ImportError:
    print("skipped: there is no numpy")
    sys.exit(77)

sys.path.insert(0, str(pathlib.Path(__file__).parents[2] / "examples/openfoam"))
import check  # noqa: E402
import foam_files as foam  # noqa: E402

N = 400


def text_of(values, binary):
    """Returns a field of cells as OpenFOAM writes it."""
    kind = "vector" if values.ndim > 1 else "scalar"
    head = f"FoamFile {{ format {'binary' if binary else 'ascii'}; }}\ninternalField nonuniform List<{kind}> \n{len(values)}\n("
    if binary:
        return head.encode() + values.astype("<f8").tobytes() + b")\n;\n"
    rows = [f"({' '.join(repr(float(x)) for x in row)})" if values.ndim > 1 else repr(float(row)) for row in values]
    return (head + "\n" + "\n".join(rows) + "\n)\n;\n").encode()


class Files(unittest.TestCase):
    """Writes cases into a separate folder, and checks the output of a check."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        self.random = numpy.random.default_rng(7)

    def write(self, path, data):
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_bytes(data if isinstance(data, bytes) else data.encode())

    def parts(self, case, parts):
        """Writes the meshes of ranks with these cells. Returns their folders."""
        folders = []
        for rank, ids in enumerate(parts):
            folder = case / f"processor{rank}" if len(parts) > 1 else case
            listed = "\n".join(map(str, ids))
            mesh = folder / "constant/polyMesh"
            self.write(mesh / "owner", f'FoamFile {{ note "nPoints: 9 nCells: {len(ids)} nFaces: 9"; }}\n')
            self.write(mesh / "cellProcAddressing", f"FoamFile {{ format ascii; }}\n\n{len(ids)}\n(\n{listed}\n)\n")
            folders.append(folder)
        return folders

    def table(self, case, name, times, values):
        rows = "".join(f"{time!r}\t{value!r}\n" for time, value in zip(map(float, times), map(float, values)))
        self.write(case / f"postProcessing/{name}/0/surfaceFieldValue.dat",
                   f"# Region type : patch {name}\n# Time  areaAverage(p)\n{rows}")

    def log(self, case, times, opening, cells):
        self.write(case / "log.pimpleFoam", "Create time\n" + "".join(
            f"\nTime = {float(time)!r}\n\nriis aorticValve: opening {float(x)!r}, {n} cells marked, integral of K 1 kg/s, 0.001 s"
            f" in the library\nExecutionTime = {1 + i / 4} s\n" for i, (time, x, n) in enumerate(zip(times, opening, cells))))

    def valve(self, case):
        """Writes the dictionary of a valve with leaflets of 8 cm2."""
        self.write(case / "system/fvOptions", "aorticValve { resistance 1e3; halfThickness 1e-3; }\n")
        self.write(case / "postProcessing/aorticValve/0.01/leaflets.vtk",
                   "# vtk\nPOINTS 3 double\n0 0 0\n0.04 0 0\n0 0.04 0\nPOLYGONS 1 4\n3 0 1 2\n")

    def replace(self, path, old, new):
        text = path.read_text()
        self.assertIn(old, text)
        path.write_text(text.replace(old, new, 1))

    def printed(self, what, *paths):
        text = io.StringIO()
        with contextlib.redirect_stdout(text):
            what(*map(str, paths))
        return text.getvalue()

    def stopped(self, words, what, *paths):
        with self.assertRaises(SystemExit) as refusal:
            self.printed(what, *paths)
        self.assertIn(words, str(refusal.exception))


class Marks(Files):
    TIMES = ("0.001", "0.002", "0.003", "0.004")
    speed = staticmethod(lambda name, ids: numpy.ones(len(ids)))

    def setUp(self):
        super().setUp()
        self.centres = self.random.random((N, 3))
        # In each step, more cells have K, as in a valve that opens.
        self.k = [numpy.where(numpy.arange(N) < 150 + 10 * i, self.random.random(N) + 1, 0) for i in range(len(self.TIMES))]

    def case(self, name, parts, binary, change=lambda part_ids, k, centres, i: None):
        case = self.folder / name
        for ids, folder in zip(parts, self.parts(case, parts)):
            centres = self.centres[ids].copy()
            for i, time in enumerate(self.TIMES):
                k = self.k[i][ids].copy()
                change(ids, k, centres, i)
                self.write(folder / time / check.K_NAME, text_of(k, binary))
                self.write(folder / time / check.KU_NAME, text_of(numpy.stack(3 * [k * self.speed(name, ids)], axis=1), binary))
            self.write(folder / "0/C", text_of(centres, binary))
        self.log(case, self.TIMES, [0.5] * 4, [150] * 4)
        return case

    def cases(self, change=lambda *_: None, binary=True):
        ids = numpy.random.default_rng(8).permutation(N)
        return (self.case("serial", [numpy.arange(N)], False),
                self.case("two", [numpy.sort(ids[:170]), numpy.sort(ids[170:])], binary, change))

    def refused(self, change, words):
        self.stopped(words, check.marks, *self.cases(change))

    def test_equal_marks(self):
        for binary in (False, True):
            with self.subTest(binary=binary):
                self.assertIn(" 2     4    150-180 ", self.printed(check.marks, *self.cases(binary=binary)))

    def test_another_mark(self):
        def change(ids, k, centres, i):
            if i == 2:
                k[ids == 399] = 1e-300
        self.refused(change, "marks the cells that")

    def test_another_bit_of_k(self):
        def change(ids, k, centres, i):
            k[ids == 7] = numpy.nextafter(k[ids == 7], 9)
        self.refused(change, "cells whose centres have the same bits have the same K, not 8 others")

    def test_another_bit_of_a_centre_explains_it(self):
        def change(ids, k, centres, i):
            k[ids == 7] = numpy.nextafter(k[ids == 7], 9)
            centres[ids == 7] = numpy.nextafter(self.centres[7], 9)
        self.printed(check.marks, *self.cases(change))

    def test_a_large_difference_of_k(self):
        def change(ids, k, centres, i):
            k[ids == 7] *= 1.001
            centres[ids == 7] = numpy.nextafter(self.centres[7], 9)
        self.refused(change, f"{check.K_NAME} differs by at most 1e-9 of its largest value, not ")

    def test_a_large_difference_of_the_velocity(self):
        def change(ids, k, centres, i):
            centres[ids == 7] = numpy.nextafter(self.centres[7], 9)
        self.speed = lambda name, ids: numpy.where((ids == 7) & (name == "two"), 1.001, 1)
        self.refused(change, f"{check.KU_NAME} differs by at most 1e-9 of its largest value, not ")

    def test_nan_in_a_cell_without_k(self):
        def change(ids, k, centres, i):
            k[ids == 399] = numpy.nan
            centres[ids == 399] = numpy.nextafter(self.centres[399], 9)
        self.refused(change, f"0.001/{check.K_NAME} has values that are not finite, first in cell ")

    def test_a_valve_that_does_not_move(self):
        self.k = [self.k[0]] * 4
        self.refused(lambda *_: None, "the valve moves through cells: [150, 150, 150, 150] are marked")

    def test_too_few_times(self):
        self.TIMES = self.TIMES[:3]
        self.refused(lambda *_: None, "serial has written more than three steps, not ['0.001', '0.002', '0.003']")

    def test_a_missing_time(self):
        serial, other = self.cases()
        for rank in (0, 1):
            for name in (check.K_NAME, check.KU_NAME):
                (other / f"processor{rank}/0.004" / name).unlink()
            (other / f"processor{rank}/0.004").rmdir()
        self.stopped("two has the times", check.marks, serial, other)

    def test_a_missing_field(self):
        serial, other = self.cases()
        (other / f"processor1/0.003/{check.KU_NAME}").unlink()
        self.stopped(f"processor1/0.003/{check.KU_NAME}: No such file or directory", check.marks, serial, other)

    def test_fields_that_end_early(self):
        for binary, width, left in ((True, 1, 169), (False, 3, 170)):
            serial, other = self.cases(binary=binary)
            path = other / f"processor0/0.003/{check.K_NAME if binary else check.KU_NAME}"
            data = path.read_bytes()
            if binary:
                path.write_bytes(data[:data.index(b"(") + 1 + 170 * 8 - 3])
            else:
                path.write_bytes(re.sub(rb"\n\([^)\n]+\)", b"\n(1)", data))
            with self.subTest(binary=binary):
                self.stopped(f"has {left} numbers in a list of 170 times {width}", check.marks, serial, other)

    def test_a_word_in_a_field(self):
        serial, other = self.cases(binary=False)
        self.replace(other / f"processor0/0.003/{check.K_NAME}", "\n0.0\n", "\nnone\n")
        self.stopped(f"0.003/{check.K_NAME} has a list with another word than numbers: ", check.marks, serial, other)

    def test_ranks_with_the_same_cell(self):
        serial = self.case("serial", [numpy.arange(N)], False)
        other = self.case("two", [numpy.arange(201), numpy.arange(199, N - 2)], True)
        self.stopped("two: its ranks do not have each of 400 cells once", check.marks, serial, other)

    def test_another_mesh(self):
        serial = self.case("serial", [numpy.arange(N)], False)
        other = self.case("two", [numpy.arange(200), numpy.arange(200, N - 1)], True)
        self.stopped("two has 400 cells as ", check.marks, serial, other)

    def test_a_field_of_another_mesh(self):
        case = self.case("serial", [numpy.arange(N)], False)
        self.stopped("has 400 cells, and the mesh has 399", lambda path: foam.field(path, N - 1), case / "0.001" / check.K_NAME)

    def test_a_mesh_without_its_number_of_cells(self):
        serial, other = self.cases()
        self.write(serial / "constant/polyMesh/owner", "FoamFile { }\n")
        self.stopped("polyMesh/owner has no note with nCells", check.marks, serial, other)

    def test_files_of_another_kind(self):
        for path, words in ((f"processor1/0.003/{check.K_NAME}", "has no internalField"),
                            ("processor1/constant/polyMesh/cellProcAddressing", "has no list of labels")):
            serial, other = self.cases()
            self.write(other / path, "FoamFile { format ascii; }\n")
            with self.subTest(path=path):
                self.stopped(f"two/{path} {words}", check.marks, serial, other)

    def test_a_run_without_steps(self):
        serial, other = self.cases()
        for time in self.TIMES:
            shutil.rmtree(serial / time)
        self.stopped("serial has no written time", check.marks, serial, other)

    def test_nan_needs_a_uniform_pressure(self):
        case = self.case("serial", [numpy.arange(N)], False)
        pressure, owner = self.folder / "p", case / "constant/polyMesh/owner"
        pressure.write_text("FoamFile { format ascii; }\ninternalField uniform 1;\n")
        self.stopped("has the line 'internalField uniform 0;' once", check.nan, pressure, owner)
        pressure.write_text("FoamFile { format ascii; }\ninternalField uniform 0;\n")
        check.nan(pressure, owner)
        self.assertTrue(numpy.isnan(foam.field(pressure, N)).all())


class Drops(Files):
    FLOW = 4e-5  # m3/s; (R / eps) u through 8 cm2 is 50,000 Pa
    share = {}  # what the log expects for nine tenths of the area, by the case

    def setUp(self):
        super().setUp()
        self.drop = {"closed": numpy.full(10, 36000.0), "aside": numpy.full(10, 36000.0), "powerLaw": numpy.full(10, 36010.0),
                     "DarcyForchheimer": numpy.full(10, 39000.0), "open": numpy.full(10, 30.0), "none": numpy.full(10, 20.0)}
        self.drop["closed"][:2] = 40000, 35900

    def refused(self, words, change=lambda: None):
        times = 1e-3 * numpy.arange(1, 11)
        for name, drop in self.drop.items():
            case = self.folder / name
            self.table(case, "upstream", times, 5 + drop / check.RHO)
            self.table(case, "downstream", times, numpy.full(10, 5.0))
            self.table(case, "flow", times, numpy.full(10, self.FLOW))
        self.valve(self.folder / "closed")
        for name in ("closed", "aside"):
            share = self.share.get(name) or self.drop[name][-1] / 5e4 * 0.9
            self.write(self.folder / name / "log.pimpleFoam", "riis aorticValve: the closed valve has 0.00072 m2 in the mesh,"
                       f" and is expected to drop {share} of (R / eps) u, u = flow / area\n")
        change()
        if words:
            self.stopped(words, check.drops, self.folder)

    def at(self, path):
        return self.folder / "closed" / path

    def test_good_drops(self):
        self.refused(None)
        printed = self.printed(check.drops, self.folder)
        self.assertRegex(printed, r"closed valve, riis +40000\.0 +35900\.0 +36000\.0 +100\.00%")
        self.assertRegex(printed, r"u = flow / area +50000\.0 +50000\.0 +50000\.0 +138\.89%")

    def test_another_expected_drop(self):
        for name in ("closed", "aside"):
            with self.subTest(name=name):
                self.share = {name: 0.67}
                self.refused(f"{name}: the log expects the measured drop to 3 %: 0.6700 and 0.6480")

    def test_20_percent_off(self):
        for factor, words in ((0.8, "36010.0 and 28800.0 Pa"), (1.2, "36010.0 and 43200.0 Pa")):
            with self.subTest(factor=factor):
                self.drop["closed"] = numpy.full(10, factor * 36000)
                self.refused("OpenFOAM's powerLaw porosity and riis give the same drop to 0.5 %: " + words)

    def test_a_drop_that_builds_up(self):
        self.drop["closed"][1] *= 0.8
        self.refused("the second step has the drop of the last one to 5 %: 28720.0 and 36000.0 Pa")

    def test_both_far_from_the_flat_valve(self):
        for factor, words in ((0.5, "it is 0.360 of it"), (1.6, "it is 1.152 of it")):
            with self.subTest(factor=factor):
                self.drop["closed"] = numpy.full(10, factor * 36000)
                self.drop["powerLaw"] = numpy.full(10, factor * 36000)
                self.refused("the drop is between 0.4 and 1.1 of (R / eps) u: " + words)

    def test_an_open_valve_that_holds(self):
        self.drop["open"][-1] = 100
        self.refused("the open valve and no valve differ by less than 0.1 % of the closed one: 100.0 and 20.0 Pa")

    def test_a_run_that_ended_early(self):
        self.drop["open"] = self.drop["open"][:9]
        self.refused("the tables upstream and downstream of ")
        self.refused("open has 10 steps, not 9",
                     lambda: self.table(self.folder / "open", "downstream", 1e-3 * numpy.arange(1, 10), [5] * 9))

    def test_a_missing_table(self):
        self.refused("closed has no rows in a file postProcessing/flow/*/surfaceFieldValue.dat",
                     lambda: self.at("postProcessing/flow/0/surfaceFieldValue.dat").unlink())

    def test_a_table_without_rows(self):
        self.refused("closed has no rows in a file postProcessing/flow/",
                     lambda: self.table(self.folder / "closed", "flow", [], []))

    def test_bad_rows(self):
        for new, words in (("0.001\n", "line 3 has 1 columns, and needs 2"),
                           ("0.001\tnan\n", "line 3 has 'nan' in the place of a finite number"),
                           ("0.001\tinf\n", "line 3 has 'inf' in the place of a finite number"),
                           ("0.001\tx\n", "line 3 has 'x' in the place of a finite number")):
            path = self.at("postProcessing/flow/0/surfaceFieldValue.dat")
            with self.subTest(new=new):
                self.refused("flow/0/surfaceFieldValue.dat: " + words, lambda: self.replace(path, "0.001\t4e-05\n", new))

    def test_a_valve_without_its_numbers(self):
        self.refused("system/fvOptions has no entry resistance",
                     lambda: self.replace(self.at("system/fvOptions"), "resistance", "r"))
        self.refused("system/fvOptions: No such file or directory", lambda: self.at("system/fvOptions").unlink())

    def test_missing_leaflets(self):
        path = self.at("postProcessing/aorticValve/0.01/leaflets.vtk")
        self.refused("leaflets.vtk has no POLYGONS", lambda: self.replace(path, "POLYGONS", "LINES"))
        self.refused("closed has no file postProcessing/aorticValve/*/leaflets.vtk", path.unlink)


class Zones(Files):
    def zones(self, k, model="powerLaw"):
        closed, case = self.folder / "closed", self.folder / model
        self.parts(closed, [numpy.arange(N)])
        self.write(closed / "0.01" / check.K_NAME, text_of(k, True))
        for folder in ("constant/polyMesh", "system"):
            (case / folder).mkdir(parents=True, exist_ok=True)
        self.printed(check.zones, closed, case, model)
        return [(case / name).read_text() for name in ("constant/polyMesh/cellZones", "system/fvOptions")]

    def test_every_marked_cell_is_in_a_zone_with_its_resistance(self):
        k = numpy.where(numpy.arange(N) < 150, 1e5 * self.random.random(N), 0)
        for model, key, unit in (("powerLaw", r"C0 (\S+);", 1), ("DarcyForchheimer", r"d \((\S+) ", 3.3e-6)):
            zones, options = self.zones(k, model)
            given = numpy.zeros(N)
            found = re.findall(r"(zone\d+) \{ type cellZone; cellLabels List<label> \d+\(([^)]*)\)", zones)
            for name, cells in found:
                entry = re.search(rf"^{name} .*", options, re.MULTILINE).group(0)
                given[numpy.array(cells.split(), int)] += check.RHO * unit * float(re.search(key, entry).group(1))
            with self.subTest(model=model):
                self.assertEqual(sum(len(cells.split()) for _, cells in found), 150)
                self.assertLess(abs(given - k).max(), k.max() / 200)

    def test_bad_k(self):
        k = numpy.where(numpy.arange(N) < 150, 1.0, 0.0)
        for change in (0.0 * k, numpy.where(numpy.arange(N) == 399, -1.0, k)):
            with self.assertRaisesRegex(SystemExit, "closed is at least 0, and not 0 in every cell"):
                self.zones(change)
        k[3] = numpy.nan
        with self.assertRaisesRegex(SystemExit, "has values that are not finite, first in cell 3"):
            self.zones(k)


class Sizes(Files):
    def sizes(self, drops):
        cases = []
        for size, drop in zip(("0.16", "0.08"), drops):
            case = self.folder / f"cases/closed-{size}"
            self.parts(case, [numpy.arange(N)])
            self.valve(case)
            for name, value in (("upstream", drop / check.RHO), ("downstream", 0), ("flow", Drops.FLOW)):
                self.table(case, name, [0.001, 0.002], [value, value])
            self.log(case, [0.001, 0.002], [0, 0], [50, 50])
            self.write(self.folder / f"mesh-{size}/checkMesh.log", "    Total volume = 4e-07.  Cell volumes OK.\n")
            cases.append(case)
        return cases

    def test_finer_meshes_come_nearer(self):
        printed = self.printed(check.sizes, *self.sizes((36000, 45000)))
        self.assertRegex(printed, r"0\.16 +400 +50 +1\.00 +0\.720\n +0\.08 +400 +50 +1\.00 +0\.900")

    def test_finer_meshes_that_do_not(self):
        for drops, words in (((36000, 35000), "0.720, 0.700"), ((36000, 54000), "0.720, 1.080")):
            with self.subTest(drops=drops):
                self.stopped(f"finer meshes come nearer to (R / eps) u: they have {words} of it", check.sizes, *self.sizes(drops))

    def test_a_mesh_without_a_volume(self):
        cases = self.sizes((36000, 45000))
        path = self.folder / "mesh-0.08/checkMesh.log"
        path.write_text("Mesh OK.\n")
        self.stopped("mesh-0.08/checkMesh.log has no Total volume", check.sizes, *cases)
        path.unlink()
        self.stopped("mesh-0.08/checkMesh.log: No such file or directory", check.sizes, *cases)


class Hexahedra(Files):
    def test_drops_by_hand(self):
        """With eps = h, either the middle cell alone has K, or two cells at the distance h / 2 each have half of the largest K.
        With eps = 2 h the middle cell has twice the K of its neighbours. With many cells the sum is the integral of K."""
        printed = self.printed(check.hexahedra, "1", "2", "1000")
        found = [tuple(map(float, pair)) for pair in re.findall(r"\(\(R / eps\) u\) (\S+) to (\S+)\n", printed)]
        self.assertEqual(found[0], (0, 0.5))
        self.assertEqual((found[1][0], found[2]), (0.667, (1, 1)))


class Expected(Files):
    """Tests closed leaflets in a duct, with invented logs and pressures."""

    def setUp(self):
        super().setUp()
        self.cases = [self.case(f"tetrahedra-{half}-1-20") for half in numpy.linspace(1, 2, 11)] + [self.case("cubes-2-1-20")]
        self.restart(1.25, numpy.array([0, 7.25, 3, 0]))

    def case(self, name, size=1, share=0.8, measured=(0.81, 1.01), duct="expected"):
        area = float(0.008 ** 2 / numpy.cos(numpy.pi / 9 * (not name.endswith("-0"))))
        times = 1e-3 * numpy.arange(1, 11)
        for calibrate, drop in zip(("no", "yes"), measured):
            case = self.folder / f"{duct}-{name}-{calibrate}"
            factor = ". K is multiplied by 1.25" if calibrate == "yes" else ""
            self.write(case / "log.pimpleFoam",
                       f"Time = 0.001\n\nriis aorticValve: the closed valve has {area * size!r} m2 in the mesh, and is expected"
                       f" to drop {float(share)!r} of (R / eps) u, u = flow / area{factor}\n")
            self.write(case / "system/fvOptions", "aorticValve { resistance 1e4; halfThickness 1.5e-3; }\n")
            self.write(case / "constant/polyMesh/owner", 'FoamFile { note "nPoints: 9 nCells: 1536 nFaces: 9"; }\n')
            self.table(case, "inflow", times, [-6.4e-7] * 10)
            self.table(case, "pressure", times, [drop * 1e4 / 1.5e-3 * 6.4e-7 / area / check.RHO] * 10)
        return self.folder / f"{duct}-{name}-no"

    def restart(self, factor, k):
        first, again = check.cases_of_factor(self.cases[0])
        for case, time, values in ((first, "0.01", numpy.array([0, 7.25, 3, 0])), (again, "0.012", k)):
            self.write(case / time / "K.aorticValve", text_of(values, True))
            self.write(case / "constant/polyMesh/owner", f'FoamFile {{ note "nPoints: 9 nCells: {len(k)} nFaces: 9"; }}\n')
        self.write(again / "log.pimpleFoam", f"riis aorticValve: K is multiplied by {factor}, as before\n")
        self.ranks(numpy.array([0, 7.25, 3, 0]))

    def ranks(self, k):
        first = check.cases_of_factor(self.cases[0])[0]
        for ranks, cells in ((2, [[0, 3], [1, 2]]), (4, [[0], [3], [1], [2]])):
            case = first.parent / f"factor-ranks-{ranks}"
            for folder, ids in zip(self.parts(case, cells), cells):
                self.write(folder / "0.01/K.aorticValve", text_of(k[ids], True))
            self.write(case / "log.pimpleFoam", (first / "log.pimpleFoam").read_text())

    def test_other_ranks(self):
        self.ranks(numpy.array([0, 7.26, 3, 0]))
        self.stopped("factor-ranks-2 has the K of 1 rank to 1e-3 of the largest: 1.4e-03", check.expected, *self.cases)
        self.ranks(numpy.array([1e-9, 7.25, 3, 0]))
        self.stopped("factor-ranks-2 has the marks of 1 rank", check.expected, *self.cases)

    def test_another_restart(self):
        self.restart(1.26, numpy.array([0, 7.25, 3, 0]))
        self.stopped("keeps the factor 1.25 without a new estimate", check.expected, *self.cases)
        self.restart(1.25, numpy.array([0, 7.25, 3.0000001, 0]))
        self.stopped("has the same bits", check.expected, *self.cases)

    def test_good_cases(self):
        printed = self.printed(check.expected, *self.cases)
        self.assertRegex(printed, r"tetrahedra +20 +1\.50 +1 +0\.800 +0\.810 +-1\.23% +1\.250 +1\.010\n")

    def test_bad_cases(self):
        name = self.cases[3].name[len("expected-"):-len("-no")]
        for words, change in (("the expected drop is the measured one to 3 %", {"measured": (0.83, 1)}),
                              ("the calibrated drop is (R / eps) u to 2 %: 0.970 of it", {"measured": (0.8, 0.97)}),
                              ("has a leaflet of 68.11 mm2: 69.47", {"size": 1.02})):
            self.case(name, **change)
            self.stopped(words, check.expected, *self.cases)
        self.case(name)
        self.stopped("there are 12 cases, not 11", check.expected, *self.cases[1:])

    def test_cubes_have_the_sum_of_harmonic_means(self):
        """Cells are cubes of 1 mm. The cells' centres lie 1.3, 0.3, ... -1.2 mm from the leaflet, and the cells at the four faces
        are omitted."""
        heights = numpy.array([-1.8, -0.8, 0.2, 1.2])
        k = numpy.where(abs(heights) < 1.5, (1 + numpy.cos(numpy.pi * heights / 1.5)) / 3, 0)
        form = 2 / (1 / k[1] + 1 / k[2]) + 2 / (1 / k[2] + 1 / k[3])
        good = self.case("cubes-1.5-1-0", share=form, measured=(form, 1))
        self.printed(check.expected, good, *self.cases[1:])
        self.case("cubes-1.5-1-0", share=form + 0.02, measured=(form, 1))
        self.stopped("expects the sum of harmonic means", check.expected, good, *self.cases[1:])


class Table(Files):
    """Tests the table of a valve in one heartbeat, and in three heartbeats with arteries."""

    def setUp(self):
        super().setUp()
        self.times = 0.002 * numpy.arange(1, 151)
        self.opening = numpy.interp(self.times, [0.04, 0.08, 0.2, 0.24], [0, 1, 1, 0])
        self.columns = {"opening": self.opening, "pressure_difference": 100 + self.times,
                        "flow": numpy.where(self.times < 0.22, 3e-4 * self.opening, -1e-5)}
        q = self.columns["flow"]
        self.columns["forward_volume"] = numpy.cumsum(numpy.maximum(q, 0)) * 0.002
        self.columns["regurgitant_volume"] = numpy.cumsum(numpy.maximum(-q, 0)) * 0.002
        self.columns["orifice_area"] = 3e-4 * self.opening
        self.columns["band_free_area"] = 2e-4 * self.opening
        self.columns["effective_area"] = numpy.maximum(q, 0) / numpy.sqrt(2 * self.columns["pressure_difference"] / check.RHO)
        self.columns["speed_at_band"] = self.times
        for i in range(3):
            self.columns[f"force_{i}"] = numpy.outer(self.times, [i, 1, 2])
            self.columns[f"moment_{i}"] = numpy.outer(self.times, [1, i, 2])

    def written(self, case, name, columns, start=0):
        lines = ["# Valve aorticValve", "# Time " + " ".join(columns)]
        for i in range(start, len(self.times)):
            cells = [f"({' '.join(map(repr, map(float, c[i])))})" if c.ndim > 1 else repr(float(c[i])) for c in columns.values()]
            lines.append("\t".join([repr(float(self.times[i])), *cells]))
        self.write(case / f"postProcessing/{name}/0/riisValve.dat", "\n".join(lines) + "\n")

    def beats(self, change=None, again=None):
        case, restarted = self.folder / "beat", self.folder / "restart"
        log = "Create time\n"
        before = (0.0, 0.0)
        for i, (time, opening) in enumerate(zip(self.times.tolist(), self.opening.tolist())):
            force = sum(self.columns[f"force_{leaflet}"][i] for leaflet in range(3)).tolist()
            log += (f"\nTime = {time!r}\n\nriis aorticValve: opening {opening!r}, 9 cells marked, integral of K 1 kg/s,"
                    f" 0.1 s in the library, pressure difference {before[0]!r} Pa, flow {before[1]!r} m3/s\n"
                    f"riis aorticValve: force of the flow ({force[0]!r} {force[1]!r} {force[2]!r}) N\nExecutionTime = 1 s\n")
            before = float(self.columns["pressure_difference"][i]), float(self.columns["flow"][i])
        self.write(case / "log.pimpleFoam", log)
        self.table(case, "flow", self.times, self.columns["flow"])
        shifted = dict(self.columns)
        for i in range(3):
            shifted[f"moment_{i}"] = self.columns[f"moment_{i}"] - numpy.cross([0.01, 0.02, 0.03], self.columns[f"force_{i}"])
        self.written(case, "valve", {**self.columns, **(change or {})})
        self.written(case, "shifted", shifted)
        self.written(restarted, "valve", {**self.columns, **(again or {})}, 100)
        return case, restarted

    def test_a_good_table(self):
        printed = self.printed(check.tables, *self.beats())
        self.assertRegex(printed, r"the moment about another point, leaflet 2 +\d")

    def test_bad_columns(self):
        for name, words in (("opening", "the opening of the log"), ("flow", "the flow of OpenFOAM's table"),
                            ("pressure_difference", "the pressure difference that the law has"),
                            ("regurgitant_volume", "the regurgitant volume since the beat began"),
                            ("force_1", "the force of the log, as the sum over leaflets"),
                            ("moment_0", "the moment about another point, leaflet 0"), ("effective_area", "the effective area")):
            with self.subTest(name=name):
                wrong = self.columns[name] + 1e-3 * abs(self.columns[name]).max()
                self.stopped(f"has {words}", check.tables, *self.beats({name: wrong}))
        self.stopped("has an orifice when open", check.tables, *self.beats({"orifice_area": 3e-4 + 0 * self.opening}))
        self.stopped("leaves at most the orifice", check.tables, *self.beats({"band_free_area": 4e-4 * self.opening}))
        forgotten = self.columns["forward_volume"] - self.columns["forward_volume"][99]
        self.stopped("has after the restart: forward volume", check.tables, *self.beats(again={"forward_volume": forgotten}))


class Physiological(Table):
    def setUp(self):
        super().setUp()
        self.times = 1e-3 * numpy.arange(1, 2801)
        beat = (self.times - 5e-4) % 0.7
        self.opening = numpy.interp(beat, [0.1, 0.14, 0.3, 0.33], [0, 1, 1, 0])
        self.leak = 12000 * 1.8e-3 / 1e4 * 8e-4
        self.q = numpy.where(self.opening > 0, 3e-4 * self.opening, -self.leak)
        self.stored = 12000.0
        for flow in self.q:
            self.stored = (self.stored + 1e-3 / 1e-8 * flow) / (1 + 1e-3 / (1e-8 * 1.7e8))

    def refused(self, words, back=5e-6, pressure=-12000.0, last=1.0):
        case = self.folder / "physiological"
        self.parts(case, [[0]])
        self.log(case, self.times, self.opening, [100] * 2800)
        log = (case / "log.pimpleFoam").read_text().replace("\nriis", "\nCourant Number mean: 0.1 max: 2.5\nriis")
        (case / "log.pimpleFoam").write_text(log + "riis aorticValve: the closed valve has 0.0008 m2 in the mesh, and is expected"
                                             " to drop 0.8 of (R / eps) u, u = flow / area. K is multiplied by 1.25\n")
        self.write(case / "system/fvOptions", "aorticValve { resistance 1e4; halfThickness 1.8e-3; }\n")
        self.table(case, "downstream", self.times, [12.0] * 2800)
        for time, stored in (("0", 12000.0), ("2.8", self.stored)):
            self.write(case / time / "p", f"distalResistance 1.7e8; compliance 1e-8; pressure {float(stored)!r};")
        ones = numpy.ones(2800)
        forward = 6e-5 * numpy.where(self.times > 2.1005, last, 1)
        self.written(case, "valve", {"opening": self.opening, "flow": self.q, "forward_volume": forward,
                                     "pressure_difference": numpy.where(self.opening > 0, 500, pressure),
                                     "regurgitant_volume": back * ones, "speed_at_band": 2 * ones})
        if words:
            self.stopped(words, check.physiological, case)
        else:
            return self.printed(check.physiological, case)

    def test_good_beats(self):
        self.assertRegex(self.refused(None), r" 4 +0\.101 s +0\.33[01] s +300\.0 ml/s +60\.00 +5\.00 .* 1\.73 ml/s +1\.73 +2\.50"
                                             r" +2\.00")

    def test_bad_beats(self):
        self.refused("in beat 1 less than a fifth flows back: 13.00 of 60.00 ml", back=1.3e-5)
        self.refused("in beat 1 the valve closes against more than 85 mmHg: 82.5", pressure=-11000.0)
        self.refused("in beat 1 the leak is the ideal one to 5 %: 1.728 and 1.872 ml/s", pressure=-13000.0)
        self.refused("the last two beats have the same forward volume to 2 %: it changes by 2.10 %", last=1.021)
        self.refused(None, last=1.019)
        self.stored *= 1.02
        self.refused("the arteries have the pressure of the flow to 1 %")

    test_a_good_table = test_bad_columns = None


class Moving(Files):
    """Tests cases of moving valves with invented forces, volumes and jets."""
    OPENS = ("hexahedra-28", "hexahedra-32", "tetrahedra", "box-28", "box-32")
    SAME = ("ranks-2", "ranks-4", "two-valves", "pisoFoam", "tetrahedra-ranks-2", "tetrahedra-ranks-4")

    def setUp(self):
        super().setUp()
        self.times = 1e-3 * numpy.arange(1, 41)
        self.opening = numpy.minimum(1, numpy.arange(1, 41) / 20)
        self.stroke = 0.48 * numpy.tan(numpy.pi / 180)
        for mesh in self.OPENS:
            self.forces(f"{mesh}-PCG", [0.3, 0.4, 0.5])
            self.forces(f"{mesh}-riisSource", [0.03, 0.04, 0.1])
        for name in self.SAME:
            self.forces(name, [0.03, 0.04, 0.1])
        # Two valves share the force. A valve's second line comes from the last corrector.
        self.forces("two-valves", [0.015, 0.02, 0.05], ("first", "second"))
        (self.folder / "pisoFoam/log.pimpleFoam").rename(self.folder / "pisoFoam/log.pisoFoam")
        for solver in ("PCG", "riisSource"):
            self.forces(f"rest-{solver}", [0, 0, 0.2])
            for cells in (10, 20):
                self.plate(f"plate-{cells}-{solver}", 1, 1)
            for cells in (28, 32):
                self.jet(f"jet-{cells}-{solver}", 1.0 if solver == "riisSource" else 1.2)
                self.displaced(f"hexahedra-{cells}-{solver}", 0.9)
        swept = check.swept
        self.addCleanup(lambda: setattr(check, "swept", swept))
        check.swept = lambda library, kind, opening: 1e-6 * opening

    def forces(self, name, force, valves=("aorticValve",)):
        lines = "".join(f"riis {valve}: force of the flow (9 9 9) N\n" for valve in valves)
        lines += "".join(f"riis {valve}: force of the flow ({force[0]} {force[1]} {force[2]}) N\n" for valve in valves)
        steps = "riis {}: opening {}, 100 cells marked, integral of K 1 kg/s, 0.001 s in the library\n"
        self.write(self.folder / name / "log.pimpleFoam", "Create time\n" + "".join(
            f"\nTime = {time:.3f}\n\n{steps.format(valves[0], opening)}{lines}ExecutionTime = 1 s\n"
            for time, opening in zip(self.times, self.opening)))

    def displaced(self, name, share):
        """Writes the flows at both ends. Until the opening 0.25, the valve sweeps 0.25 ml in 5 steps."""
        for function, sign in (("inflow", -1.5), ("outflow", 0.5)):
            self.table(self.folder / name, function, self.times, [sign * 5e-5 * share] * 40)

    def plate(self, name, share_in, share_out):
        flow = 1e-4 * self.stroke / 0.04
        self.table(self.folder / name, "inflow", self.times, [-flow * share_in] * 40)
        self.table(self.folder / name, "outflow", self.times, [flow * share_out] * 40)

    def jet(self, name, fastest):
        """Writes the largest speed, in units of sqrt(2 dp / rho), which is 1 m/s here."""
        case = self.folder / name
        self.log(case, self.times, self.opening, [100] * 40)
        self.table(case, "below", self.times, [1.5] * 40)
        self.table(case, "above", self.times, [1.0] * 40)
        self.write(case / "postProcessing/fastest/0/volFieldValue.dat",
                   "# Time max(U)\n" + "".join(f"{time:.3f}\t(9 9 {fastest})\n" for time in self.times))

    def refused(self, words):
        self.stopped(words, check.moving, self.folder, "libriis.so")

    def test_good_cases(self):
        printed = self.printed(check.moving, self.folder, "libriis.so")
        self.assertRegex(printed, r"tetrahedra-riisSource +0\.050 +0\.100 +0\.100 +0\.100\n")
        self.assertRegex(printed, r"two-valves +\d\.\de-1\d N|two-valves +0\.0e\+00 N")
        self.assertRegex(printed, r"plate-20-PCG .*: 100\.000 % of area times stroke")
        self.assertRegex(printed, r"hexahedra-32-riisSource +0\.225: 90\.0 % of the swept volume")
        self.assertRegex(printed, r"jet-32-riisSource +1\.00, 1\.00 v")
        self.assertRegex(printed, r"jet-28-PCG +1\.20, 1\.20 v")

    def test_a_force_across_or_along(self):
        self.forces("box-32-riisSource", [0.08, -0.07, 0.1])
        self.refused("box-32-riisSource: the force across is less than 0.1 N: 0.106")
        self.forces("box-32-riisSource", [0.08, 0, -0.16])
        self.refused("box-32-riisSource: |Fz| is less than 0.15 N after 20 ms: 0.160")

    def test_nothing_to_cure(self):
        self.forces("tetrahedra-PCG", [0.3, 0.4, -0.1])
        self.refused("tetrahedra-PCG: |Fz| after 20 ms is what riisSource cures: 0.100 N")

    def test_other_forces(self):
        for name in self.SAME:
            with self.subTest(name=name):
                self.setUp()
                path = sorted((self.folder / name).glob("log.*"))[0]
                text = path.read_text()
                at = text.rindex(": force of the flow (")
                path.write_text(text[:at] + re.sub(r"\((\S+)", lambda x: f"({float(x[1]) + 2e-3}", text[at:], count=1))
                self.refused(f"{name} has the forces of ")

    def test_a_valve_at_rest(self):
        self.forces("rest-riisSource", [0, 0, 0.2000001])
        self.refused("a valve at rest has the same force, not 0, with riisSource and without: 0.2 and 0.2000001 N")
        for solver in ("PCG", "riisSource"):
            self.forces(f"rest-{solver}", [0, 0, 0])
        self.refused("a valve at rest has the same force, not 0")

    def test_a_volume(self):
        self.plate("plate-20-riisSource", 0.97, 1.005)
        self.refused("plate-20-riisSource: the mean volume is area times stroke to 1 %: 0.98750 of it")

    def test_a_swept_volume(self):
        for cells, share in ((28, 0.84), (32, 1.16)):
            self.displaced(f"hexahedra-{cells}-riisSource", share)
            self.refused(f"hexahedra-{cells}-riisSource: the mean volume is the swept volume to 15 %: {share:.3f} of it")
            self.displaced(f"hexahedra-{cells}-riisSource", 0.9)

    def test_a_jet(self):
        self.jet("jet-28-riisSource", 1.06)
        self.refused("jet-28-riisSource: the jet is at most 1.05 v: 1.060")
        self.jet("jet-28-riisSource", 1.0)
        self.jet("jet-28-PCG", 1.04)
        self.refused("jet-28-PCG: the jet is what riisSource cures, above 1.05 v: 1.040")
        self.opening[:] *= 0.5
        self.jet("jet-28-PCG", 1.2)
        self.refused("the valve of jet-28-PCG opens: its opening is 0.5 at the end")

    def test_missing_lines(self):
        self.replace(self.folder / "rest-PCG/log.pimpleFoam", "force of the flow (9 9 9) N\nriis aorticValve: force", "")
        self.refused("log.pimpleFoam has the force in the step of time 0.001")
        self.setUp()
        (self.folder / "ranks-4/log.pimpleFoam").unlink()
        self.refused("ranks-4 has no log.p*Foam")
        self.setUp()
        (self.folder / "jet-28-PCG/postProcessing/fastest/0/volFieldValue.dat").unlink()
        self.refused("jet-28-PCG has velocities in a file postProcessing/fastest/*/*FieldValue.dat")
        self.setUp()
        self.table(self.folder / "plate-10-PCG", "outflow", self.times[1:], [1] * 39)
        self.refused("plate-10-PCG has 40 steps, not 40 and 39")


class Beat(Files):
    def setUp(self):
        super().setUp()
        self.times = 0.002 * numpy.arange(1, 101)
        self.opening = numpy.interp(self.times, [0.04, 0.08, 0.12, 0.16], [0, 1, 1, 0])
        self.q = numpy.where(self.opening > 0, 3e-4 * self.opening, 1e-6)

    def beat(self):
        case = self.folder / "beat"
        self.log(case, self.times, self.opening, [100] * len(self.times))
        self.table(case, "flow", self.times, self.q)
        return case

    def refused(self, words):
        self.stopped(words, check.beat, self.beat())

    def test_a_good_beat(self):
        self.assertRegex(self.printed(check.beat, self.beat()), r"with their velocity +0\.040 s +0\.120 s +100 +300\.0 ml/s")

    def test_a_valve_that_never_opens(self):
        self.opening[:] = 0
        self.refused("beat opens and closes: its opening is 0.0 at first, 0.0 at most and 0.0 at the end")

    def test_a_valve_that_never_closes(self):
        self.opening[50:] = 1
        self.refused("beat opens and closes: its opening is 0.0 at first, 1.0 at most and 1.0 at the end")

    def test_a_valve_that_opens_by_half(self):
        self.opening *= 0.5
        self.refused("beat opens fully and ends closed: its opening is 0.5 at most and 0.0 at the end")

    def test_a_beat_that_ends_with_an_open_valve(self):
        self.opening[-1] = 0.25
        self.refused("beat opens fully and ends closed: its opening is 1.0 at most and 0.25 at the end")

    def test_a_closed_valve_that_leaks(self):
        self.q[:10] = -9e-6
        self.refused("beat lets less than 2 % of the largest flow through: 9.00 of 300.0 ml/s")

    def test_a_beat_that_starts_late(self):
        self.times, self.opening, self.q = (values[12:] for values in (self.times, self.opening, self.q))
        self.refused("beat has steps between 0.002 and 0.02 s, while the valve is closed")

    def test_a_flow_that_is_short(self):
        self.q = self.q[:99]
        self.refused("beat have a row for each step: 100 and 99")

    def test_an_opening_that_is_nan(self):
        self.opening[30] = numpy.nan
        self.refused("log.pimpleFoam: the step of time 0.062 has 'nan' in the place of a finite number")

    def test_logs_that_lack_something(self):
        for old, new, words in (("riis aorticValve", "", "the step of time 0.002 has no line with cells marked"),
                                ("\nExecutionTime = 25.75 s", "", "the step of time 0.2 has no line with ExecutionTime")):
            case = self.beat()
            self.replace(case / "log.pimpleFoam", old, new)
            with self.subTest(old=old):
                self.stopped("log.pimpleFoam: " + words, check.beat, case)
        (case / "log.pimpleFoam").write_text("Create time\n")
        self.stopped("log.pimpleFoam has no time step", check.beat, case)
        (case / "log.pimpleFoam").unlink()
        self.stopped("log.pimpleFoam: No such file or directory", check.beat, case)


class Model(Files):
    def cases(self, spoil=None, by=0.0, last="0.04"):
        """Writes a run, and its repetition by modelFoam. In the field `spoil`, the two runs differ at one value."""
        k = numpy.where(numpy.arange(N) < 150, self.random.random(N) + 1, 0)
        values = {check.K_NAME: k, "p": self.random.random(N), "U": self.random.random((N, 3))}
        shutil.rmtree(self.folder / "box-model", ignore_errors=True)
        for case, time in (("box", "0.04"), ("box-model", last)):
            self.parts(self.folder / case, [numpy.arange(N)])
            for name, all_values in values.items():
                all_values = all_values.copy()
                all_values[3] += by if case == "box-model" and name == spoil else 0
                self.write(self.folder / case / time / name, text_of(all_values, True))
        return self.folder / "box"

    def test_flows(self):
        printed = self.printed(check.model, self.cases("p", 1e-9))
        self.assertRegex(printed, r"box +0\.04 s: .* the same bits, p differs by 1\.0e-09, U the same bits")
        self.stopped("box-model at 0.04 differs by less than 1e-6 of the largest: 1.0e-05", check.model, self.cases("U", 1e-5))
        self.stopped("box-model: 1 cells differ", check.model, self.cases(check.K_NAME, 1e-15))
        self.stopped("box-model ends at 0.04, not at 0.039", check.model, self.cases(last="0.039"))


class Restart(Files):
    TIMES = ("0.2", "0.22", "0.24")

    def restart(self, change=lambda cases: None):
        """Makes two equal runs with a valve and two equal runs without. `change` may alter them."""
        k = numpy.where(numpy.arange(N) < 150, self.random.random(N) + 1, 0)
        values = {check.K_NAME: k, check.KU_NAME: numpy.stack([k, k, k], axis=1),
                  "p": self.random.random(N), "U": self.random.random((N, 3))}
        cases = [self.folder / name for name in ("beat", "beat-restart", "flow", "flow-restart")]
        for case in cases:
            parts = [numpy.arange(0, N, 2), numpy.arange(1, N, 2)]
            for folder, ids in zip(self.parts(case, parts), parts):
                for time in self.TIMES:
                    for name, all_values in values.items():
                        self.write(folder / time / name, text_of(all_values[ids], True))
        change(cases)
        return cases

    def refused(self, words, case, time, name, change):
        """`change` gets the values of the second rank and changes them."""
        def spoil(cases):
            path = cases[case] / "processor1" / time / name
            values = foam.field(path, N // 2).copy()
            change(values)
            self.write(path, text_of(values, True))
        self.stopped(words, check.restart, *self.restart(spoil))

    def test_the_same_bits(self):
        printed = self.printed(check.restart, *self.restart())
        same = ", ".join(f"{name} the same bits" for name in (check.K_NAME, check.KU_NAME, "p", "U"))
        self.assertIn("0.22 s: " + same, printed)
        self.assertRegex(printed, r"without a valve +0\.24 s: p the same bits, U the same bits")

    def test_one_changed_bit_of_k(self):
        def change(values):
            values[3] = numpy.nextafter(values[3], 9)
        self.refused(f"{check.K_NAME} at 0.24 has the same bits in ", 1, "0.24", check.K_NAME, change)
        self.refused("beat-restart: 1 cells differ", 1, "0.22", check.KU_NAME, change)

    def test_one_changed_pressure(self):
        def change(values):
            values[3] += 1e-5
        self.refused("p of ", 1, "0.22", "p", change)
        self.refused("flow-restart at 0.24 differs by less than 1e-6 of the largest: 1.0e-05", 3, "0.24", "U", change)

    def test_a_small_difference_of_the_flow(self):
        def spoil(cases):
            path = cases[1] / "processor1/0.22/p"
            values = foam.field(path, N // 2).copy()
            values[3] += 1e-9
            self.write(path, text_of(values, True))
        printed = self.printed(check.restart, *self.restart(spoil))
        self.assertRegex(printed, r"0\.22 s: .*, p differs by 1\.0e-09, U the same bits")

    def test_nan(self):
        def change(values):
            values[3] = numpy.nan
        for name in (check.K_NAME, "p", "U"):
            for case in (0, 1):
                with self.subTest(name=name, case=case):
                    self.refused(f"processor1/0.22/{name} has values that are not finite, first in cell 3",
                                 case, "0.22", name, change)

    def test_a_valve_that_is_not_there(self):
        def spoil(cases):
            for case in cases[:2]:
                for rank in (0, 1):
                    self.write(case / f"processor{rank}/0.22" / check.K_NAME, text_of(numpy.zeros(N // 2), True))
        self.stopped("beat at 0.22 is not 0 in every cell", check.restart, *self.restart(spoil))

    def test_a_restart_with_another_mesh(self):
        def spoil(cases):
            self.parts(cases[1], [numpy.arange(0, N, 2), numpy.arange(1, N - 2, 2)])
            for time in self.TIMES:
                path = cases[1] / "processor1" / time / check.K_NAME
                self.write(path, text_of(foam.field(path, N // 2)[:-1], True))
        self.stopped("beat-restart have as many cells: 400 and 399", check.restart, *self.restart(spoil))

    def test_a_missing_field_or_time(self):
        self.stopped("flow/processor0/0.24/p: No such file or directory", check.restart,
                     *self.restart(lambda cases: (cases[2] / "processor0/0.24/p").unlink()))
        self.stopped("beat-restart has written two times after its start, not ['0.22']", check.restart,
                     *self.restart(lambda cases: shutil.rmtree(cases[1] / "processor0/0.24")))


class Words(unittest.TestCase):
    def test_the_command_line(self):
        program = [sys.executable, "-B", check.__file__]
        for words in ((), ("beats", "x"), ("beat",)):
            with self.subTest(words=words):
                run = subprocess.run(program + list(words), capture_output=True, text=True)
                self.assertEqual((run.returncode, run.stderr[:40]), (1, "usage: check.py marks|zones|drops|sizes|"))
        run = subprocess.run(program + ["beat", "/nowhere"], capture_output=True, text=True)
        self.assertEqual((run.returncode, run.stderr), (1, "/nowhere/log.pimpleFoam: No such file or directory\n"))


if __name__ == "__main__":
    unittest.main()
