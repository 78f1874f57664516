# SPDX-License-Identifier: Apache-2.0
"""The recipes for other package managers must agree with the sources: versions, options of CMake, files, compilers' sources,
workflows.

This test runs in the repository's root. The tests of the workflows and of conda's recipe need the module yaml. These tests are
skipped without yaml.
"""
import ast
import hashlib
import pathlib
import re
import subprocess
import sys
import tempfile
import tomllib
import unittest

try:
    import yaml
except ImportError:
    yaml = None

ROOT = pathlib.Path(__file__).resolve().parents[2]
WORKFLOWS = sorted((ROOT / ".github/workflows").glob("*.yml"))


def text_of(name):
    return (ROOT / name).read_text(encoding="utf-8")


def commands_of_run():
    """Returns the names of the functions run_NAME in `run` and in the scripts that it reads."""
    scripts = ["run", *re.findall(r"^\. ([a-z_/]+\.sh)", text_of("run"), re.MULTILINE)]
    return {name for script in scripts for name in re.findall(r"^run_([a-z0-9_]+)\(\)", text_of(script), re.MULTILINE)}


def version():
    header = text_of("include/riis/riis.h")
    return ".".join(re.search(rf"RIIS_VERSION_{part} (\d+)", header)[1] for part in ("MAJOR", "MINOR", "PATCH"))


def cmake_options():
    return set(re.findall(r"option\((\w+)", text_of("CMakeLists.txt")))


def fill(archive, url, folder):
    return subprocess.run([sys.executable, "-B", ROOT / "packaging/recipes.py", archive, url, folder], capture_output=True,
                          text=True, check=False)


class Recipes(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        self.archive = self.folder / f"riis-{version()}.tar.gz"
        self.archive.write_bytes(b"an archive")
        self.url = f"https://git.example/owner/riis/releases/download/v{version()}/{self.archive.name}"

    def filled(self):
        answer = fill(self.archive, self.url, self.folder)
        self.assertEqual(answer.returncode, 0, answer.stderr)
        return [(self.folder / name).read_text(encoding="utf-8") for name in ("conda/recipe.yaml", "spack/riis/package.py")]

    def test_packages_have_every_header(self):
        headers = ["riis.h", *re.findall(r'^#include "(\w+\.h)"', text_of("include/riis/riis.h"), re.MULTILINE)]
        self.assertEqual(headers[-1], "laws.h")
        for place in ("packaging/conda/recipe.yaml", "debian/libriis-dev.install"):
            if (ROOT / place).exists():  # the source archive lacks debian/
                lines = text_of(place).split()
                missing = [name for name in headers if not any(line.endswith("riis/" + name) for line in lines)]
                self.assertEqual(missing, [], place)

    def test_recipes_are_filled(self):
        for text in self.filled():
            self.assertIn(self.url, text)
            self.assertIn(hashlib.sha256(b"an archive").hexdigest(), text)
            self.assertNotRegex(text, r"@[A-Z0-9]+@")
        self.assertIn('homepage = "https://git.example/owner/riis"', text)

    def test_wrong_archives_are_refused(self):
        for name, url, said in (
                ("riis.tar.gz", self.url, "riis.tar.gz is not the name of a release's archive"),
                (self.archive.name, "http://git.example/" + self.archive.name, "is not an address https://.../"),
                (self.archive.name, "https://git.example/other.tar.gz", "https://git.example/other.tar.gz is not an address"),
                ("riis-90.1.2.tar.gz", "https://git.example/riis-90.1.2.tar.gz", "does not have the version 90.1.2")):
            (self.folder / name).write_bytes(b"an archive")
            answer = fill(self.folder / name, url, self.folder / "refused")
            self.assertEqual(answer.returncode, 1)
            self.assertIn(said, answer.stderr)
            self.assertFalse((self.folder / "refused/conda/recipe.yaml").exists())

    @unittest.skipUnless(yaml, "the module yaml is missing")
    def test_conda(self):
        recipe = yaml.safe_load(self.filled()[0])
        self.assertEqual(recipe["context"]["version"], version())
        self.assertEqual([output["package"]["name"] for output in recipe["outputs"]], ["libriis", "riis"])
        for output in recipe["outputs"]:
            script = " ".join(output["build"]["script"])
            self.assertLessEqual(set(re.findall(r"-D (RIIS_\w+|BUILD_SHARED_LIBS)", script)), cmake_options())
            files = [name for test in output["tests"] for name in test.get("files", {}).get("source", [])]
            self.assertTrue(files)
            for name in files:
                self.assertTrue((ROOT / name).exists(), name)
        needs = tomllib.loads(text_of("pyproject.toml"))
        host = " ".join(recipe["outputs"][1]["requirements"]["host"]).replace(" ==", "==").replace(" >=", ">=")
        for package in needs["build-system"]["requires"]:
            self.assertIn(package.split(">=")[0], host)
        for package in needs["project"]["dependencies"]:
            self.assertIn(package.replace(">=", " >="), recipe["outputs"][1]["requirements"]["run"])

    def test_spack(self):
        text = self.filled()[1]
        (recipe,) = [node for node in ast.parse(text).body if isinstance(node, ast.ClassDef)]
        self.assertEqual(recipe.name, "Riis")
        directives = {}
        for node in recipe.body:
            if isinstance(node, ast.Expr) and isinstance(node.value, ast.Call):
                first = ast.literal_eval(node.value.args[0]) if node.value.args else None
                directives.setdefault(node.value.func.id, []).append(first)
        self.assertEqual(directives["version"], [version()])
        passed = re.findall(r'self\.define(?:_from_variant)?\("(\w+)"', text)
        self.assertLessEqual(set(passed), cmake_options())
        self.assertGreaterEqual(len(passed), 7)
        for variant in re.findall(r'define_from_variant\("\w+", "(\w+)"', text):
            self.assertIn(variant, directives["variant"])
        oldest = re.search(r"cmake_minimum_required\(VERSION ([0-9.]+)", text_of("CMakeLists.txt"))[1]
        self.assertIn(f"cmake@{oldest}:", directives["depends_on"])
        for name in re.findall(r'"(first_marking\.\w+)"', text):
            (n,) = set(re.findall(r"\bn = (\d+)", text_of(f"examples/{name}")))
            self.assertIn(f"{int(n)**3} nodes, marked: ", text)

    def test_fpm(self):
        manifest = tomllib.loads(text_of("fpm.toml"))
        self.assertEqual(manifest["version"], version())
        self.assertEqual(manifest["license"], "Apache-2.0")
        self.assertEqual(manifest["build"]["link"], ["riis"])
        # fpm compiles all sources below its folder. CMake must compile the same files.
        folder = ROOT / manifest["library"]["source-dir"]
        library = text_of("fortran/CMakeLists.txt").partition("add_library(riis_fortran")[2].partition(")")[0]
        sources = {str(file.relative_to(folder)) for file in folder.rglob("*.f90")}
        self.assertEqual(sources, set(re.findall(r"[\w/]+\.f90", library)))
        for program in manifest["executable"]:
            self.assertTrue((ROOT / program["source-dir"] / program["main"]).is_file())

    @unittest.skipUnless(yaml, "the module yaml is missing")
    def test_workflows_only_call_commands_that_a_person_has(self):
        self.assertGreater(len(WORKFLOWS), 3)
        verbs = commands_of_run()
        called = set()
        for file in WORKFLOWS:
            workflow = yaml.safe_load(file.read_text(encoding="utf-8"))
            for job in workflow["jobs"].values():
                commands = [step["run"] for step in job["steps"] if "run" in step]
                for words in job.get("strategy", {}).get("matrix", {}).get("command", []):
                    called.add(words.split()[0])
                for command in commands:
                    called |= {word for word in re.findall(r"\./run ([a-z0-9_-]+)", command)}
                    # The other commands in the workflows only publish, or install packages that ./run itself needs.
                    self.assertRegex(command.strip(), r"^(\./run |apt-get update|gh release create )", file.name)
        self.assertLessEqual(called, verbs)
        self.assertLessEqual({"lint", "test", "sanitize", "tsan", "fuzz", "docs", "python"}, called)

    def test_the_container_calls_a_command_that_exists(self):
        words = re.findall(r"\./run ([a-z]+)", text_of("packaging/Containerfile"))
        self.assertEqual(set(words), {"test", "setup"})
        self.assertLessEqual(set(words), commands_of_run())

    def test_wheels_are_built_with_the_tools_of_the_project(self):
        settings = tomllib.loads(text_of("pyproject.toml"))
        (nanobind,) = [need for need in settings["build-system"]["requires"] if need.startswith("nanobind==")]
        for name in ("python/python.sh", "python/manylinux.sh"):
            self.assertIn(nanobind, text_of(name))
        for name in re.findall(r"python/\w+\.sh", str(settings["tool"]["cibuildwheel"])):
            self.assertTrue((ROOT / name).is_file(), name)


if __name__ == "__main__":
    unittest.main()
