# SPDX-License-Identifier: Apache-2.0
"""riis and another OpenMP run-time in the same process: scikit-learn's wheel contains its own libgomp."""

import pathlib
import subprocess
import sys

import pytest

import riis

pytest.importorskip("sklearn", reason="scikit-learn is missing; ./run python installs it")

# The child program marks nodes and clusters points, in the order of its arguments, and prints both results.
PROGRAM = """
import ctypes, pathlib, sys
import numpy
xyz = numpy.random.default_rng(5).uniform(-2.0, 2.0, (40_000, 3))

def marks():
    import riis
    surface = riis.Surface(riis.Valve("mitral", opening=0.3), n_threads=2)
    found = riis.mark(surface, riis.Mesh(xyz), n_threads=4, search="exhaustive")
    assert found.stats.n_threads == 4
    return hash((found.ids.tobytes(), found.distance.tobytes()))

def clusters():
    from sklearn.cluster import KMeans
    return hash(KMeans(4, n_init=1, random_state=0).fit(xyz[:5000]).labels_.tobytes())

def their_libgomp_for_all():
    # Loads scikit-learn's libgomp as torch loads its own, so its names precede those of later libraries.
    import importlib.util
    folder = pathlib.Path(importlib.util.find_spec("sklearn").origin).parent.parent / "scikit_learn.libs"
    (library,) = folder.glob("libgomp*")
    ctypes.CDLL(str(library), ctypes.RTLD_GLOBAL)

for name in sys.argv[1].split():
    print(name, locals()[name](), flush=True)
with open("/proc/self/maps") as maps:
    found = {line.split()[-1] for line in maps if "libgomp" in line}
print("libgomps", len(found))
"""


def lines_of(order):
    answer = subprocess.run(
        [sys.executable, "-c", PROGRAM, order], capture_output=True, text=True, check=True
    )
    return dict(line.split(maxsplit=1) for line in answer.stdout.splitlines())


@pytest.mark.parametrize("order", ["marks clusters marks", "clusters marks clusters", "their_libgomp_for_all marks clusters"])
def test_both_results_are_those_of_each_alone(order, monkeypatch):
    monkeypatch.setenv("PYTHONHASHSEED", "0")
    together = lines_of(order)
    assert together["marks"] == lines_of("marks")["marks"]
    assert together["clusters"] == lines_of("clusters")["clusters"]
    print(order, "with", together["libgomps"], "libgomp in the process")


def test_the_module_needs_few_names_of_openmp():
    """Any libgomp since gcc 4.9 has the functions of the test. The module of riis binds all of these functions when it is loaded,
    so it uses one run-time."""
    module = pathlib.Path(riis._riis.__file__)
    answer = subprocess.run(["nm", "-D", "--undefined-only", module], capture_output=True, text=True, check=True)
    names = {line.split()[-1].split("@")[0] for line in answer.stdout.splitlines()}
    assert {name for name in names if name.lower().startswith(("gomp_", "omp_"))} == {
        "GOMP_parallel",
        "omp_get_num_procs",
        "omp_get_num_threads",
        "omp_get_proc_bind",
        "omp_get_thread_num",
        "omp_in_parallel",
    }
    answer = subprocess.run(["readelf", "-d", module], capture_output=True, text=True, check=True)
    assert "BIND_NOW" in answer.stdout or "NOW" in answer.stdout
