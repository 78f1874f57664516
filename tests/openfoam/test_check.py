# SPDX-License-Identifier: Apache-2.0
"""Tests what examples/openfoam/check.py refuses, on OpenFOAM's files made up here."""
import contextlib
import io
import pathlib
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
TIMES = ("0.001", "0.002", "0.003", "0.004")


def text_of(values, binary):
    """A field of cells as OpenFOAM writes it."""
    kind = "vector" if values.ndim > 1 else "scalar"
    head = f"FoamFile {{ format {'binary' if binary else 'ascii'}; }}\ninternalField nonuniform List<{kind}> \n{len(values)}\n("
    if binary:
        return head.encode() + values.astype("<f8").tobytes() + b")\n;\n"
    rows = [f"({' '.join(repr(float(x)) for x in row)})" if values.ndim > 1 else repr(float(row)) for row in values]
    return (head + "\n" + "\n".join(rows) + "\n)\n;\n").encode()


class Check(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        random = numpy.random.default_rng(7)
        self.centres = random.random((N, 3))
        # More cells in each step, as of an opening valve.
        self.k = [numpy.where(numpy.arange(N) < 150 + 10 * i, random.random(N) + 1, 0) for i in range(len(TIMES))]

    def write(self, path, data):
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_bytes(data)

    def case(self, name, parts, binary, change=lambda part_ids, k, centres, i: None):
        case = self.folder / name
        for rank, ids in enumerate(parts):
            folder = case / f"processor{rank}" if len(parts) > 1 else case
            mesh = folder / "constant/polyMesh"
            self.write(mesh / "owner", f'FoamFile {{ note "nPoints: 9 nCells: {len(ids)} nFaces: 9"; }}\n'.encode())
            listed = "\n".join(map(str, ids))
            self.write(mesh / "cellProcAddressing", f"FoamFile {{ format ascii; }}\n\n{len(ids)}\n(\n{listed}\n)\n".encode())
            centres = self.centres[ids].copy()
            for i, time in enumerate(TIMES):
                k = self.k[i][ids].copy()
                change(ids, k, centres, i)
                self.write(folder / time / check.K_NAME, text_of(k, binary))
                self.write(folder / time / check.KU_NAME, text_of(numpy.stack([k, k, k], axis=1), binary))
            self.write(folder / "0/C", text_of(centres, binary))
        log = "".join(f"\nTime = {time}\n\nriis v: opening 0.5, 150 cells marked, integral of K 1 kg/s, 0.001 s in the library\n"
                      f"ExecutionTime = {1 + i} s\n" for i, time in enumerate(TIMES))
        (case / "log.pimpleFoam").write_text(log)
        return case

    def marks(self, *cases):
        printed = io.StringIO()
        with contextlib.redirect_stdout(printed):
            check.marks(*map(str, cases))
        return printed.getvalue()

    def two_ranks(self, change, binary=True):
        ids = numpy.random.default_rng(8).permutation(N)
        serial = self.case("serial", [numpy.arange(N)], False)
        return self.marks(serial, self.case("two", [numpy.sort(ids[:170]), numpy.sort(ids[170:])], binary, change))

    def test_equal_marks(self):
        for binary in (False, True):
            with self.subTest(binary=binary):
                self.assertIn(" 2     4    150-180 ", self.two_ranks(lambda *_: None, binary))

    def refused(self, change, words):
        with self.assertRaises(SystemExit) as refusal:
            self.two_ranks(change)
        self.assertIn(words, str(refusal.exception))

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
        self.two_ranks(change)

    def test_a_large_difference_of_k(self):
        def change(ids, k, centres, i):
            k[ids == 7] *= 1.001
            centres[ids == 7] = numpy.nextafter(self.centres[7], 9)
        self.refused(change, "K differs by at most 1e-9 of its largest value")

    def test_a_missing_time(self):
        serial = self.case("serial", [numpy.arange(N)], False)
        other = self.case("two", [numpy.arange(200), numpy.arange(200, N)], True)
        for rank in (0, 1):
            for name in (check.K_NAME, check.KU_NAME):
                (other / f"processor{rank}/0.004" / name).unlink()
            (other / f"processor{rank}/0.004").rmdir()
        with self.assertRaisesRegex(SystemExit, "has the times"):
            self.marks(serial, other)

    def test_a_field_of_another_mesh(self):
        case = self.case("serial", [numpy.arange(N)], False)
        with self.assertRaisesRegex(SystemExit, "has 400 cells, and the mesh has 399"):
            foam.field(case / "0.001" / check.K_NAME, N - 1)

    def test_nan_needs_a_uniform_pressure(self):
        case = self.case("serial", [numpy.arange(N)], False)
        pressure = self.folder / "p"
        pressure.write_text("FoamFile { format ascii; }\ninternalField uniform 1;\n")
        with self.assertRaisesRegex(SystemExit, "has the line"):
            check.nan(pressure, case / "constant/polyMesh/owner")
        pressure.write_text("FoamFile { format ascii; }\ninternalField uniform 0;\n")
        check.nan(pressure, case / "constant/polyMesh/owner")
        self.assertTrue(numpy.isnan(foam.field(pressure, N)).all())


if __name__ == "__main__":
    unittest.main()
