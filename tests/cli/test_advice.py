# SPDX-License-Identifier: Apache-2.0
"""test_advice.py PROGRAM: follows the advice of messages. Each command or option that a message recommends is run as printed.

tests/docs/messages.txt lists the commands of all messages. test_cli_conversions.c runs the commands of other tools.
"""
import json
import os
import pathlib
import re
import shlex
import subprocess
import sys
import tempfile
import tomllib
import unittest

PROGRAM = ""
CM, MM, M = 1.0, 10.0, 0.01


def box(path, n, half_sides, scale=CM, holes=lambda cell: False, centre=(0.0, 0.0, 0.0)):
    """Writes a legacy VTK file of n^3 hexahedra, without the cells for which `holes` is true."""
    points = [[scale * (c + h * (2 * i / n - 1)) for c, h, i in zip(centre, half_sides, (i, j, k))]
              for k in range(n + 1) for j in range(n + 1) for i in range(n + 1)]
    corners = ((0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1))
    cells = [[(i + a) + (n + 1) * ((j + b) + (n + 1) * (k + c)) for a, b, c in corners]
             for k in range(n) for j in range(n) for i in range(n) if not holes((i, j, k))]
    lines = ["# vtk DataFile Version 3.0", "box", "ASCII", "DATASET UNSTRUCTURED_GRID", f"POINTS {len(points)} double"]
    lines += [" ".join(map(repr, point)) for point in points]
    lines += [f"CELLS {len(cells)} {9 * len(cells)}"] + ["8 " + " ".join(map(str, cell)) for cell in cells]
    lines += [f"CELL_TYPES {len(cells)}"] + ["12"] * len(cells)
    path.write_text("\n".join(lines) + "\n", encoding="utf-8")


class Advice(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def run_words(self, *words, **environment):
        """Runs a command in the folder. `riis` on the PATH is the tested program."""
        path = f"{pathlib.Path(PROGRAM).parent}:{os.environ['PATH']}"
        return subprocess.run(words, cwd=self.folder, capture_output=True, text=True, check=False, stdin=subprocess.DEVNULL,
                              env={**os.environ, "PATH": path, **environment})

    def riis(self, *words, status=0, **environment):
        done = self.run_words("riis", *words, **environment)
        self.assertEqual(done.returncode, status, done.stdout + done.stderr)
        return done

    def advised(self, done, pattern):
        """Returns the words of the advice in a message."""
        found = re.search(pattern, done.stderr, re.MULTILINE)
        self.assertTrue(found, done.stderr)
        return shlex.split(found[1])

    def box(self, name="mesh.vtk", n=10, half_sides=(2.0, 2.0, 2.0), **more):
        box(self.folder / name, n, half_sides, **more)
        return name

    def test_the_lists_of_words(self):
        for words, pattern in ((["mark", "--fool"], r"\((riis mark --help) lists the options\)"),
                               (["check", "leaks", "--fool"], r"\((riis check leaks --help) lists the options\)"),
                               (["mark", "m.vtu", "--set", "a"], None),
                               (["fool"], r"\((riis --help) lists the commands\)"),
                               (["--fool", "mark"], r"\((riis --help) lists the commands\)"),
                               (["check", "fool"], r"\((riis check --help) lists the commands\)"),
                               (["help", "fool"], r"\((riis help) lists the topics\)")):
            refused = self.riis(*words, status=2)
            if pattern:
                done = self.run_words(*self.advised(refused, pattern))
                self.assertEqual(done.returncode, 0)
                self.assertGreater(len(done.stdout.splitlines()), 5)

    def test_the_names_of_parameters(self):
        refused = self.riis("mark", self.box(), "--set", "fool=1", "--output", "a.vtu", status=1)
        listed = json.loads(self.run_words(*self.advised(refused, r"(riis params) list")).stdout)
        self.assertIn("root_radius", str(listed))

    def test_arrays_that_are_there(self):
        self.riis("mark", self.box(n=30), "--output", "marked.vtu")
        again = ("mark", "marked.vtu", "--output", "again.vtu")
        refused = self.riis(*again, status=2)
        self.riis(*again, *self.advised(refused, r": write (--replace) to replace it"))
        self.riis(*again, *(word.replace("NAME", "other") for word in self.advised(refused, r", or (--prefix NAME) for other")))

    def test_leaks(self):
        command = ("mark", self.box(n=16), "--valve", "trileaflet", "--opening", "0", "--output", "marked.vtu")
        leaky = self.riis(*command)
        advice = self.advised(leaky, r"; (--half-thickness [^ ]+) closes (?:it|them);")
        sealed = self.riis(*command, *advice)
        self.assertIn("leaks     none", sealed.stdout)
        self.assertNotIn("the surface leaks", sealed.stderr)

    def test_a_passage(self):
        self.box(n=24, half_sides=(0.8, 0.8, 2.0))
        command = ("check", "leaks", "mesh.vtk", "--valve", "trileaflet", "--opening", "0", "--between", "0,0,-1.9", "0,0,1.9")
        leaky = self.riis(*command, "--half-thickness", "0.05")
        sealed = self.riis(*command, *self.advised(leaky, r", and (--half-thickness [^ ]+) closes it"))
        self.assertNotIn("unmarked nodes join", sealed.stderr)

    def test_crossings(self):
        shape = ("--valve", "trileaflet", "--set", "bending_height=0.55")
        crossed = self.riis("mark", self.box(n=20), *shape, "--output", "marked.vtu")
        checked = self.run_words(*self.advised(crossed, r"look at all openings by (riis check crossings)"), *shape)
        self.assertRegex(checked.stdout + checked.stderr, "go through each other|cross")

    def test_a_search_that_misses_nodes(self):
        self.box(n=40, holes=lambda cell: cell[0] in (19, 20))
        done = self.riis("mark", "mesh.vtk", "--search", "paper", "--output", "marked.vtu")
        advised = self.advised(done, r"; (--search neighbor) finds these nodes")
        complete = self.riis("mark", "mesh.vtk", *advised, "--output", "marked.vtu")
        self.assertNotIn("incomplete", complete.stderr)

    def test_half_thicknesses(self):
        command = ("mark", self.box(n=20), "--output", "marked.vtu")
        for wrong in "40", "1e-4":
            done = self.run_words("riis", *command, "--half-thickness", wrong)
            better = self.riis(*command, *self.advised(done, r": write (--half-thickness [^ ]+)$"))
            self.assertNotIn("write --half-thickness", better.stderr)

    def test_units(self):
        for scale, unit in (MM, "mm"), (M, "m"):
            done = self.run_words("riis", "mark", self.box(n=20, scale=scale), "--output", "marked.vtu")
            options = self.advised(done, r": write (--unit \w+)$")
            self.assertEqual(options, ["--unit", unit])
            self.assertNotIn("write --unit", self.riis("mark", "mesh.vtk", *options, "--output", "marked.vtu").stderr)
        # A surface comes from a file in another unit, so --unit and --surface-unit are needed together.
        self.riis("surface", "--output", "valve.vtp")
        done = self.run_words("riis", "mark", "mesh.vtk", "--surface", "valve.vtp", "--output", "marked.vtu")
        options = self.advised(done, r": write (--unit \w+ --surface-unit \w+)$")
        done = self.riis("mark", "mesh.vtk", "--surface", "valve.vtp", *options, "--output", "marked.vtu")
        self.assertNotIn(": write", done.stderr)

    def test_landmarks_elsewhere(self):
        points = {"nadir-right": (12.9, 0, -10), "nadir-left": (-6.35, 11.23, -10), "nadir-non_coronary": (-6.74, -11, -10),
                  "commissure-right-left": (6.62, 11.94, 0.2), "commissure-left-non_coronary": (-14.4, 0, 0.2),
                  "commissure-non_coronary-right": (6.62, -11.94, 0.2)}
        moved = {name: (x + 60, y, z) for name, (x, y, z) in points.items()}
        (self.folder / "root.json").write_text(json.dumps({"unit": "mm", "axes": "LPS", "landmarks": moved}), encoding="utf-8")
        command = ("place", "root.json", "--valve", "aortic", "--mesh", "mesh.vtk", "--output", "placed.json")
        self.box(scale=MM, centre=(-6.0, 0.0, 0.0))
        refused = self.riis(*command, "--axes", "LPS", status=1)
        self.riis(*command, *self.advised(refused, r": give (--axes RAS), the mesh's axes"))
        self.box(scale=M, centre=(6.0, 0.0, 0.0))
        refused = self.riis(*command, status=1)
        self.riis(*command, *self.advised(refused, r": give (--unit m)$"))

    def test_the_package_of_the_view(self):
        """The advised commands need the network, so the test only checks their words. The sources have the extra `view`."""
        refused = self.riis("view", status=1, RIIS_PYTHON="/bin/false")
        self.assertIn("'python3 -m venv ~/venv' and '~/venv/bin/pip install \".[view]\"' in the sources of riis", refused.stderr)
        sources = pathlib.Path(__file__).resolve().parents[2]
        self.assertRegex((sources / "pyproject.toml").read_text(encoding="utf-8"), r"(?m)^view = \[")
        self.assertEqual(self.advised(refused, r"set RIIS_PYTHON=(\S+)"), ["~/venv/bin/python"])

    def test_packages_of_python(self):
        """A message of Python advises `pip install`. The message names packages that pyproject.toml names, and all packages of
        the extra `view`."""
        sources = pathlib.Path(__file__).resolve().parents[2]
        extras = tomllib.loads((sources / "pyproject.toml").read_text(encoding="utf-8"))["project"]["optional-dependencies"]
        known = {name: {re.split("[>=]", package)[0] for package in packages} for name, packages in extras.items()}
        advised = []
        for path in (sources / "python/riis").rglob("*.py"):
            text = path.read_text(encoding="utf-8")
            advised += re.findall(r"pip install ('?[a-z][a-z\[\] -]*)", text)
            needed = re.search(r"^_NEEDED = \((.*)\)$", text, re.MULTILINE)
            if needed:
                self.assertEqual(set(re.findall(r'"(.*?)"', needed[1])), known["view"])
        self.assertGreater(len(advised), 3)
        for words in advised:
            for word in words.strip("' ").split():
                self.assertIn(word.split("[")[0], known["view"] | known["plot"])


if __name__ == "__main__":
    PROGRAM = os.path.abspath(sys.argv.pop(1))
    unittest.main()
