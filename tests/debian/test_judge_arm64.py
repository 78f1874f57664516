#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Tests judge_arm64.py: it must refuse a failure, an unexpected skip, a skip for another reason, and a list that it cannot read.
./run arm64 must refuse other processors, and systems without apt-get."""

import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

HERE = pathlib.Path(__file__).resolve().parent
SKIPPED = """# a comment
test_sets "no AVX2" : the processor has none
test_environment/traps : the processor has none
"""


def case(name, status="run", inside="", output=""):
    return f'<testcase name="{name}" status="{status}">{inside}<system-out>{output}</system-out></testcase>'


PASSED = case("test_bezier", output="[  PASSED  ] 3 test(s).\n")
SETS = case("test_sets", "notrun", '<skipped message="SKIP_RETURN_CODE=77"/>', "there is no AVX2 here")
TRAPS = case("test_environment", output="[  SKIPPED ] traps\n[       OK ] others\n[  SKIPPED ] 1 test(s), listed below:\n"
             "[  SKIPPED ] traps\n")


class Judge(unittest.TestCase):
    def judge(self, tests, skipped=SKIPPED):
        with tempfile.TemporaryDirectory() as folder:
            results, expected = pathlib.Path(folder, "results.xml"), pathlib.Path(folder, "skipped.txt")
            results.write_text(f'<?xml version="1.0"?><testsuite>{"".join(tests)}</testsuite>', encoding="utf-8")
            expected.write_text(skipped, encoding="utf-8")
            return subprocess.run([sys.executable, "-B", HERE / "judge_arm64.py", results, expected], capture_output=True,
                                  text=True, check=False)

    def refused(self, text, *arguments):
        answer = self.judge(*arguments)
        self.assertEqual(answer.returncode, 1, answer)
        self.assertIn(text, answer.stderr)

    def test_expected_results_are_accepted(self):
        answer = self.judge([PASSED, SETS, TRAPS])
        self.assertEqual((answer.returncode, answer.stderr), (0, ""))
        self.assertEqual(answer.stdout, "2 tests passed, 1 were skipped; of those that passed, 1 cases were skipped\n")

    def test_an_expected_skip_may_pass(self):
        self.assertEqual(self.judge([PASSED, case("test_sets")]).returncode, 0)

    def test_failures_are_refused(self):
        self.refused("test_offset failed", [PASSED, case("test_offset", "fail", '<failure message="Failed"/>')])
        self.refused("test_offset failed", [PASSED, case("test_offset", "fail", '<failure message="Timeout"/>')])

    def test_other_skips_are_refused(self):
        other = case("test_new", "notrun", "<skipped/>", "there is no AVX2 here")
        self.refused("test_new was skipped, which is not expected: there is no AVX2 here", [PASSED, other])
        other = SETS.replace("AVX2", "gmsh")
        self.refused("test_sets was skipped for another reason than expected: there is no gmsh here", [PASSED, other])
        # A test without an executable also counts as a test that did not run.
        self.refused("test_new was skipped", [PASSED, case("test_new", "notrun")])
        self.refused("test_environment skipped its case new", [TRAPS, case("test_environment", output="[  SKIPPED ] new\n")])

    def test_no_results_are_refused(self):
        self.refused("no test ran", [])

    def test_a_list_that_cannot_be_read_is_refused(self):
        self.refused("line 1 is neither TEST", [PASSED], "test_sets: without the text that it prints\n")
        self.refused("line 2 is neither TEST", [PASSED], '\ntest_sets/case "text" : a case prints none\n')
        self.refused("line 1 is neither TEST", [PASSED], "test_sets/case\n")

    def test_other_systems_are_refused(self):
        for processor, text in ("riscv64", "the emulator needs x86_64, and this processor is riscv64"), (
                "x86_64", "apt-get, which fetches the packages for ARM, is missing"):
            with self.subTest(processor), tempfile.TemporaryDirectory() as folder:
                for name in "bash", "dirname", "readlink", "nproc", "env":
                    pathlib.Path(folder, name).symlink_to(shutil.which(name))
                uname = pathlib.Path(folder, "uname")
                uname.write_text(f"#!{shutil.which('sh')}\necho {processor}\n", encoding="utf-8")
                uname.chmod(0o755)
                answer = subprocess.run([HERE / "../../run", "arm64"], capture_output=True, text=True, check=False,
                                        env=dict(os.environ, PATH=folder))
                self.assertEqual(answer.returncode, 2, answer)
                self.assertIn(f"./run arm64: {text}", answer.stderr)

    def test_the_list_can_be_read(self):
        answer = self.judge([PASSED], (HERE / "arm64_skipped.txt").read_text(encoding="utf-8"))
        self.assertEqual(answer.returncode, 0, answer.stderr)


if __name__ == "__main__":
    unittest.main()
