# SPDX-License-Identifier: Apache-2.0
"""Runs bench/validation/body_fitted.sh with stand-ins for gmsh and OpenFOAM. The script must keep the rows of all.json. If a case
fails, the script must go on, and the next call must run only this case. If all rows exist, the script must run nothing."""

import importlib.util
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
if not importlib.util.find_spec("numpy"):
    print("there is no numpy: the cases of the validation are not tested")
    sys.exit(77)

STAND_INS = {
    "cmake": "", "gcc": "", "createBaffles": "", "postProcess": "", "checkMesh": "echo Mesh OK", "dpkg-query": "echo 1",
    "gmsh": 'while [[ $1 != -o ]]; do shift; done; touch "$2"',
    "gmshToFoam": """mkdir -p "$2/constant/polyMesh"; touch "$2/constant/polyMesh/boundary"
        echo 'note "nCells:1";' >"$2/constant/polyMesh/owner" """,
    # The flow fills the whole tube: 0.5 m/s through a sixth of a circle of 1.22 cm.
    "simpleFoam": """echo "${2##*/}" >>"$RAN"
        [[ ! $FAILS || $2 != *$FAILS* ]] || exit 3
        mkdir -p "$2"/{400,postProcessing/{inlet,outlet}/0,postProcessing/valve/1}
        touch "$2/postProcessing/valve/1/leaflets.vtk"
        for step in {1..150}; do
          echo "$step 1.0" >>"$2/postProcessing/inlet/0/surfaceFieldValue.dat"
          echo "$step 3.89e-5" >>"$2/postProcessing/outlet/0/surfaceFieldValue.dat"
        done
        echo 'internalField uniform (0 0 1);' >"$2/400/U"
        echo 'SIMPLE solution converged in 150 iterations'; echo 'ExecutionTime = 1 s'""",
}
FAILING = "riis-trileaflet-0.5-0.05-0.025-cut-1e3-0.75"


class Resumed(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.root = pathlib.Path(self.folder.name)
        for part in ("bench/validation", "examples/openfoam"):
            shutil.copytree(ROOT / part, self.root / part, ignore=shutil.ignore_patterns("__pycache__"))
        (self.root / "build/openfoam/source/1").mkdir(parents=True)
        (self.root / "build/openfoam/source/1/with_dynamicMesh").touch()
        (self.root / "bin").mkdir()
        for name, text in STAND_INS.items():
            path = self.root / "bin" / name
            path.write_text(f"#!/usr/bin/env bash\n{text}\n")
            path.chmod(0o755)
        # This test does not need the triangles of the leaflets.
        script = self.root / "bench/validation/body_fitted.py"
        script.write_text(script.read_text().replace("\n    same_leaflets(folder)\n", "\n"))
        self.all = self.root / "bench/validation/all.json"

    def tearDown(self):
        self.folder.cleanup()

    def run_script(self, out, fails=""):
        """Returns the status, and the names of the cases that simpleFoam ran."""
        ran = self.root / "ran"
        ran.write_text("")
        words = ["bash", self.root / "bench/validation/body_fitted.sh", self.root / out]
        path = f"{self.root / 'bin'}:{os.environ['PATH']}"
        run = subprocess.run(words, capture_output=True, text=True, check=False,
                             env={**os.environ, "PATH": path, "RAN": str(ran), "FAILS": fails})
        self.assertTrue((self.root / out / "body_fitted.json").exists(), run.stdout + run.stderr)
        return run.returncode, ran.read_text().split()

    def test_kept_and_resumed(self):
        # Two rows are missing: the half-open valve with the offset 0.75.
        found = json.loads(self.all.read_text())
        base = next(row for row in found["rows"] if row["group"] == "offset")
        missing = {f"offset_trileaflet_0.5_{eps}_0.75" for eps in ("1", "0.5")}
        script = (ROOT / "bench/validation/body_fitted.sh").read_text()
        wanted = set(re.findall(r"finished (offset_blood\S+)", script))
        for valve, openings in (("trileaflet", ("1", "0.5", "0.25")), ("coapting", ("1", "0.5")), ("mitral", ("1", "0.5"))):
            wanted |= {f"offset_{valve}_{opening}_{eps}_{offset}" for opening in openings for eps in ("1", "0.5")
                       for offset in ("0", "0.5", "0.75", "0.85")}
        have = {row["id"] for row in found["rows"]}
        found["rows"] = [row for row in found["rows"] if row["id"] not in missing]
        found["rows"] += [{**base, "id": key} for key in sorted(wanted - have - missing)]
        self.all.write_text(json.dumps(found, indent=1))

        status, ran = self.run_script("out", FAILING)
        self.assertEqual(status, 1)
        self.assertIn(FAILING, ran)
        self.assertIn("riis-trileaflet-0.5-0.1-0.05-cut-1e3-0.75", ran)
        self.assertEqual([name for name in ran if "trileaflet-0.5" not in name], [])
        rows = {row["id"]: row for row in json.loads((self.root / "out/body_fitted.json").read_text())["rows"]}
        self.assertEqual(missing & set(rows), {"offset_trileaflet_0.5_1_0.75"})
        for row in found["rows"]:
            kept = dict(rows[row["id"]])
            self.assertEqual(kept.pop("commit"), row.get("commit", found["commit"]))
            self.assertEqual(kept, {name: value for name, value in row.items() if name != "commit"})

        self.assertEqual(self.run_script("out"), (0, [FAILING]))
        finished = (self.root / "out/body_fitted.json").read_text()
        self.assertEqual(missing - {row["id"] for row in json.loads(finished)["rows"]}, set())
        self.all.write_text(finished)
        self.assertEqual(self.run_script("new"), (0, []))


if __name__ == "__main__":
    unittest.main()
