# SPDX-License-Identifier: Apache-2.0
"""The installed wheel has the licence of every library that it brings."""

import importlib.metadata
import pathlib
import re
import subprocess
import sys

import pytest

ROOT = pathlib.Path(__file__).resolve().parents[2]


def files_of_the_wheel():
    try:
        files = importlib.metadata.files("riis")
    except importlib.metadata.PackageNotFoundError:
        files = None
    if not any(file.parts[0] == "riis.libs" for file in files or []):
        pytest.skip("the package is not installed from a repaired wheel; ./run python does that")
    return files


def test_every_library_of_the_wheel_has_its_licence():
    files = files_of_the_wheel()
    licences = {
        "/".join(file.parts[2:]): file.read_text(encoding="utf-8") for file in files if file.parts[1:2] == ("licenses",)
    }
    assert sorted(importlib.metadata.metadata("riis").get_all("License-File")) == sorted(licences)
    assert "Apache License" in licences["LICENSE"]
    # What a licence has to say of each library: a library of another name needs a line here.
    words = {"embree": "Apache", "tbb": "Apache", "gomp": "RUNTIME LIBRARY EXCEPTION", "gcc_s": "RUNTIME LIBRARY EXCEPTION",
             "stdc++": "RUNTIME LIBRARY EXCEPTION"}
    assert "Wenzel Jakob" in licences["nanobind.copyright"] and "tessil" in licences["robin_map.copyright"]
    libraries = {re.match(r"lib([a-z_+]+)", file.name).group(1) for file in files if file.parts[0] == "riis.libs"}
    assert {"embree", "tbb", "gomp"} <= libraries
    for library in libraries:
        own = [name for name in licences if name.endswith(".copyright") and library.replace("_", "-") in name]
        assert own, f"no licence of {library} among {sorted(licences)}"
        assert words[library].lower() in " ".join(licences[own[0]].split()).lower()
    for text in licences.values():
        for name in re.findall(r"/usr/share/common-licenses/(Apache-2.0|GPL-3|LGPL-3)\b", text):
            assert f"common-licenses/{name}" in licences


def test_a_library_of_no_package_is_refused(tmp_path):
    program = "import pathlib, sys, licences; licences.package_of(pathlib.Path(sys.argv[1]))"
    answer = subprocess.run([sys.executable, "-B", "-c", program, tmp_path / "libown.so.1"], cwd=ROOT / "python",
                            capture_output=True, text=True, check=False)
    assert answer.returncode == 1
    assert f"no Debian package has {tmp_path}/libown.so.1, so its licence is unknown" in answer.stderr


@pytest.mark.parametrize("name, text", [
    ("libunknown-01234567.so.1", "loads no libunknown.so.1, which the wheel has as libunknown-01234567.so.1"),
    (None, "riis.libs has no library"),
])
def test_a_library_without_a_licence_is_refused(tmp_path, name, text):
    (tmp_path / "riis.libs").mkdir()
    (tmp_path / "riis-0.dist-info").mkdir()
    (tmp_path / "riis-0.dist-info/METADATA").write_text("Name: riis\n\ntext\n", encoding="utf-8")
    if name:
        (tmp_path / "riis.libs" / name).touch()
    answer = subprocess.run(
        [sys.executable, "-B", ROOT / "python/licences.py", tmp_path, pathlib.Path(sys.executable).resolve()],
        capture_output=True, text=True, check=False)
    assert answer.returncode == 1 and text in answer.stderr
