# SPDX-License-Identifier: Apache-2.0
"""The installed package has all its files, and a wheel has the licence of every library that it contains."""

import importlib.metadata
import pathlib
import re
import subprocess
import sys
import tomllib

import pytest

import riis

ROOT = pathlib.Path(__file__).resolve().parents[2]


def test_every_file_is_installed():
    sources, package = ROOT / "python/riis", pathlib.Path(riis.__file__).parent
    files = [file.relative_to(sources) for file in sources.rglob("*") if file.is_file() and "__pycache__" not in file.parts]
    assert len(files) > 30 and not [str(file) for file in files if not (package / file).is_file()]


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
    # The text that the licence of each library must contain, and the licence's SPDX name. A library of another name needs a line
    # here.
    gcc = "RUNTIME LIBRARY EXCEPTION", "GPL-3.0-or-later WITH GCC-exception-3.1"
    words = {"embree": ("Apache", "Apache-2.0"), "tbb": ("Apache", "Apache-2.0"), "gomp": gcc, "gcc_s": gcc, "stdc++": gcc}
    assert "Wenzel Jakob" in licences["nanobind.copyright"] and "tessil" in licences["robin_map.copyright"]
    assert "Niels Lohmann" in licences["nlohmann-json.copyright"]
    libraries = {re.match(r"lib([a-z_+]+)", file.name).group(1) for file in files if file.parts[0] == "riis.libs"}
    assert {"tbb", "gomp"} <= libraries and "embree" not in libraries
    libraries.add("embree")  # is in the module
    for library in libraries:
        own = [name for name in licences if name.endswith(".copyright") and library.replace("_", "-") in name]
        assert own, f"no licence of {library} among {sorted(licences)}"
        assert words[library][0].lower() in " ".join(licences[own[0]].split()).lower()
    # The module contains nanobind (BSD), robin_map and nlohmann_json (MIT).
    expression = importlib.metadata.metadata("riis")["License-Expression"]
    expected = {"Apache-2.0", "BSD-3-Clause", "MIT"} | {words[library][1] for library in libraries}
    assert set(expression.split(" AND ")) == expected and len(expected) == 4
    licenses = pytest.importorskip("packaging.licenses", reason="packaging is missing; ./run python installs it")
    assert licenses.canonicalize_license_expression(expression) == expression
    for text in licences.values():
        for name in re.findall(r"/usr/share/common-licenses/(Apache-2.0|GPL-3|LGPL-3)\b", text):
            assert f"common-licenses/{name}" in licences


def test_the_module_alone_has_the_licences_of_its_parts():
    project = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
    assert project["license"] == "Apache-2.0 AND BSD-3-Clause AND MIT"


@pytest.mark.parametrize("libraries, text", [
    (["libembree4.so.4", "libtbb.so.12"], "Apache-2.0 AND MIT"),
    (["libgomp.so.1.0.0", "libgcc_s.so.1"], "Apache-2.0 AND MIT AND GPL-3.0-or-later WITH GCC-exception-3.1"),
    (["libomp.so.5"], "licences.py: the SPDX expression of libomp.so.5 is unknown; EXPRESSIONS lacks libomp"),
])
def test_an_expression_names_the_licence_of_each_library(libraries, text):
    program = "import sys, licences; print(licences.expression_of('Apache-2.0 AND MIT', sys.argv[1:]))"
    answer = subprocess.run([sys.executable, "-B", "-c", program, *libraries], cwd=ROOT / "python",
                            capture_output=True, text=True, check=False)
    assert (answer.stdout + answer.stderr).strip() == text


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


def test_a_folder_without_texts_of_static_libraries_is_refused(tmp_path):
    answer = subprocess.run([sys.executable, "-B", ROOT / "python/licences.py", tmp_path, tmp_path, tmp_path],
                            capture_output=True, text=True, check=False)
    assert answer.returncode == 1 and f"licences.py: {tmp_path} has no file NAME.copyright" in answer.stderr
