# SPDX-License-Identifier: Apache-2.0
"""run_snippets.py SCRATCH PROGRAM_FOLDER: runs the commands of README, docs and examples as their reader would.

Each document has a separate folder, which looks like the top folder of the sources after ./run demo. The document's commands run
there in order, and must succeed. snippets.txt lists the commands that do not run, each with a reason. The meshes of the demo are
coarser than the reader's, except with RIIS_TEST_LONG=1. GIVEN makes the files that a document expects of its reader.
"""
import os
import pathlib
import shutil
import sys
import tempfile
import unittest

import snippets

# Commands that make the files that a document expects of its reader. The tube is that of the tutorial's first snippet, with
# coarser edges.
TUBE = next(one.text for one in snippets.snippets() if one.document == "docs/tutorial.md")
COARSE = TUBE[:TUBE.index("gmsh")] + """
sed 's/= 0.09/= 0.2/; s/1.6}/1.4}/' tube.geo > coarse.geo
gmsh -3 -nt 1 -setnumber Mesh.ScalingFactor 10 -format vtk -o mm.vtk coarse.geo > gmsh.log
"""
GIVEN = {
    "docs/building.md": "echo 'an archive' > riis-1.0.0.tar.gz",
    "docs/export.md": COARSE + "riis mark mm.vtk --scale 10 --prefix given --output mesh.vtu",
    "docs/meshes.md": TUBE + COARSE + """
gmsh -2 -nt 1 -setnumber Mesh.ScalingFactor 10 -format stl -save_all -o wall.stl coarse.geo > gmsh.log
riis mark mm.vtk --unit mm --prefix given --output mesh.vtu""",
    "docs/program.md": COARSE + f"""
echo '{snippets.landmarks()}' > root.mrk.json
riis mark mm.vtk --unit mm --prefix given --output root.vtu
cp root.vtu mesh.vtu""",
    "docs/scale.md": """
riis mark build/demo/mitral_tube.vtk --valve mitral --prefix given --output tube.vtu
cat > heart.pvtu <<'END'
<VTKFile type="PUnstructuredGrid"><PUnstructuredGrid><PPoints>
<PDataArray type="Float64" NumberOfComponents="3"/></PPoints><PPointData>
<PDataArray type="UInt8" Name="given_marked"/><PDataArray type="Float64" Name="given_distance"/>
<PDataArray type="Int32" Name="given_leaflet"/></PPointData>
<PCellData><PDataArray type="Int32" Name="CellEntityIds"/></PCellData>
<Piece Source="tube.vtu"/></PUnstructuredGrid></VTKFile>
END
cp examples/demo/mitral_cycle.csv beat.csv""",
}


def top_folder(folder, programs, demo):
    """Makes a folder that looks like the sources' top folder. The folder contains the built program."""
    (folder / "build").mkdir(parents=True)
    (folder / "out").mkdir()
    for path in snippets.ROOT.iterdir():
        if not path.name.startswith((".", "build", "out")):
            (folder / path.name).symlink_to(path)
    (folder / "build/bin").symlink_to(programs)
    (folder / "build/demo").symlink_to(demo)


def demo_meshes(folder, environment):
    """Makes the meshes of ./run demo."""
    folder.mkdir()
    coarser = "1" if os.environ.get("RIIS_TEST_LONG") == "1" else "2"
    for name, more in ("aortic_root", "-setnumber coapting 1"), ("mitral_tube", ""):
        commands = f"""
gmsh -2 -nt 1 -clscale {coarser} {more} -format msh2 -o {name}.msh {snippets.ROOT}/examples/demo/{name}.geo
gmsh -3 -nt 1 -clscale {coarser} -format vtk -o {name}.vtk {name}.msh {snippets.ROOT}/examples/demo/fill.geo"""
        done = snippets.run_commands(commands, folder, environment)
        if done.returncode != 0:
            raise SystemExit(done.stdout)


class TheList(unittest.TestCase):
    def test_tests_that_run_snippets_elsewhere_exist(self):
        """`elsewhere` names commands of ./run, programs of .ci, and tests of CTest."""
        sources = [path for folder in ("tests", "examples", "docs") for pattern in ("**/CMakeLists.txt", "**/*.sh")
                   for path in (snippets.ROOT / folder).glob(pattern)]
        text = "\n".join(path.read_text(encoding="utf-8") for path in [*sources, snippets.ROOT / "run"])
        for listed in snippets.conditions().values():
            for name in listed[0].partition("elsewhere: ")[2].split(", "):
                word = name.removeprefix("./run ").replace("./", "")
                known = word == "" or (snippets.ROOT / word).is_file() or f"run_{word}()" in text or word in text
                self.assertTrue(known, name)

    def test_a_snippet_that_is_gone_is_told(self):
        with tempfile.TemporaryDirectory() as folder:
            short = pathlib.Path(folder) / "list.txt"
            short.write_text("README.md | long | ./run program\n", encoding="utf-8")
            (program,) = (one for one in snippets.snippets(short) if one.condition)
            self.assertEqual((program.document, program.text.split("#")[0].strip()), ("README.md", "./run program"))
            short.write_text("README.md | never: gone | ./run progam\n", encoding="utf-8")
            with self.assertRaisesRegex(SystemExit, "README.md has no snippet that begins with: ./run progam"):
                snippets.snippets(short)
            short.write_text("README.md | often | ./run program\n", encoding="utf-8")
            with self.assertRaisesRegex(SystemExit, "'often' is not a condition"):
                snippets.snippets(short)


def main(scratch, programs):
    if not unittest.TextTestRunner().run(unittest.defaultTestLoader.loadTestsFromTestCase(TheList)).wasSuccessful():
        return 1
    for program in "gmsh", "Xvfb":
        if not shutil.which(program):
            print(f"skipped: there is no {program}")
            return 77
    scratch = pathlib.Path(scratch)
    shutil.rmtree(scratch, ignore_errors=True)
    scratch.mkdir(parents=True)
    environment = dict(os.environ, PATH=f"{programs}:{os.environ['PATH']}", HOME=str(scratch), TMPDIR=str(scratch))
    demo_meshes(scratch / "demo", environment)
    n_run, n_listed, problems = 0, 0, []
    for document in snippets.documents():
        folder = scratch / document.replace("/", "_")
        for one in snippets.snippets():
            if one.document != document or one.language != "sh":
                continue
            if not snippets.is_run(one.condition):
                n_listed += 1
                continue
            if not folder.exists():
                top_folder(folder, programs, scratch / "demo")
                given = snippets.run_commands(GIVEN.get(document, ":"), folder, environment)
                if given.returncode != 0:
                    return f"what {document} expects of its reader: {given.stdout}"
            begin = os.times()
            done = snippets.run_commands(one.text, folder, environment)
            n_run += 1
            end = os.times()
            print(f"{end.children_user - begin.children_user:6.1f} s of the processor  {document}, line {one.line}", flush=True)
            if done.returncode != 0:
                problems.append(f"{document}, line {one.line}: ended with {done.returncode}\n{one.text}{done.stdout}")
    print(f"{n_run} snippets of commands run, {n_listed} are listed in snippets.txt")
    return "\n".join(problems) or 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
