# SPDX-License-Identifier: Apache-2.0
"""Tests for which invented times bench/report/compare.py reports a slower benchmark."""

import contextlib
import io
import json
import os
import sys
import tempfile
import unittest

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "bench", "report"))
import compare
import gbench

BASE = {"calibration_coordinates": 1.0, "calibration_products": 2.0, "mark": 10.0, "update": 0.5}


def run_of(name, ms, **more):
    return {"name": name, "run_name": name, "run_type": "iteration", "real_time": ms * 1e3, "time_unit": "us", **more}


class Compare(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = folder.name

    def file(self, name, content):
        path = os.path.join(self.folder, name)
        with open(path, "w", encoding="utf-8") as file:
            file.write(content if isinstance(content, str) else json.dumps(content))
        return path

    def judge(self, now, base=None, *words):
        """Returns the exit status and the output. `now` and `base` map names to times, or are the text of whole files."""
        paths = []
        for name, times in (("base.json", base or BASE), ("now.json", now)):
            whole = isinstance(times, str) or "benchmarks" in times
            paths.append(self.file(name, times if whole else {"milliseconds": times}))
        text = io.StringIO()
        with contextlib.redirect_stdout(text), contextlib.redirect_stderr(text):
            status = compare.main([*paths, *words])
        return status, text.getvalue()

    def test_the_same_passes(self):
        status, text = self.judge(BASE)
        self.assertEqual(status, 0, text)
        self.assertIn("0 of 2 are slower", text)

    def test_a_slower_one_fails_and_is_named(self):
        status, text = self.judge({**BASE, "mark": 13.1})
        self.assertEqual(status, 1)
        self.assertRegex(text, r"1\.31  mark  SLOWER")
        self.assertNotIn("update  SLOWER", text)

    def test_up_to_the_factor_passes(self):
        self.assertEqual(self.judge({**BASE, "mark": 12.9})[0], 0)
        self.assertEqual(self.judge({**BASE, "mark": 12.9}, None, "--factor", "1.2")[0], 1)
        self.assertEqual(self.judge({**BASE, "mark": 19}, None, "--factor", "2")[0], 0)

    def test_a_slower_machine_is_no_slower_benchmark(self):
        self.assertEqual(self.judge({name: 3 * ms for name, ms in BASE.items()})[0], 0)

    def test_a_faster_machine_hides_no_loss(self):
        now = {name: ms / 3 for name, ms in BASE.items()}
        self.assertEqual(self.judge({**now, "mark": 10 * 1.4 / 3})[0], 1)

    def test_slower_only_by_both_calibrations(self):
        now = {**BASE, "calibration_coordinates": 1.5, "mark": 15}
        status, text = self.judge(now)
        self.assertEqual(status, 0, text)
        self.assertIn("less than 1.50 times may stay unseen", text)
        self.assertEqual(self.judge({**now, "mark": 20})[0], 1)

    def test_gone_fails_and_new_does_not(self):
        less = {name: ms for name, ms in BASE.items() if name != "update"}
        status, text = self.judge(less)
        self.assertEqual(status, 1)
        self.assertRegex(text, "GONE  update")
        status, text = self.judge({**BASE, "more": 1})
        self.assertEqual(status, 0)
        self.assertRegex(text, "new  more")

    def test_google_benchmark_file(self):
        runs = [run_of(name, ms) for name, ms in BASE.items() if name != "mark"]
        runs += [run_of("mark/min_time:0.250/real_time", 14), run_of("mark/min_time:0.250/real_time", 11)]
        runs.append({**run_of("mark/min_time:0.250/real_time", 99), "run_type": "aggregate"})
        status, text = self.judge({"benchmarks": runs})
        self.assertEqual(status, 0, text)
        self.assertRegex(text, r"1\.10  mark\n")

    def test_what_ended_early_fails(self):
        for word in ("error_occurred", "skipped"):
            runs = [run_of(name, ms) for name, ms in BASE.items() if name != "mark"]
            runs.append(run_of("mark", 0, **{word: True, "error_message": "the loop and the marking differ"}))
            status, text = self.judge({"benchmarks": runs})
            self.assertEqual(status, 1)
            self.assertRegex(text, "FAILED  mark: the loop and the marking differ")

    def test_unusable_files(self):
        for now in ("{", "[]", {"benchmarks": []}, {"mark": 1.0}, {**BASE, "mark": 0}, {**BASE, "mark": float("nan")}):
            status, text = self.judge(now)
            self.assertEqual(status, 2, text)
            self.assertIn("now.json", text)
        status, text = self.judge({"calibration_other": 1.0, "mark": 1.0})
        self.assertEqual(status, 2)
        self.assertIn("no calibration in common", text)
        with contextlib.redirect_stderr(io.StringIO()):
            self.assertEqual(compare.main([os.path.join(self.folder, "none.json")] * 2), 2)

    def test_kept_baselines_can_be_read(self):
        folder = os.path.join(os.path.dirname(compare.__file__), "..", "baselines")
        kept = [name for name in os.listdir(folder) if name.endswith(".json")]
        self.assertTrue(kept)
        for name in kept:
            times, failed = compare.read(os.path.join(folder, name))
            self.assertFalse(failed)
            self.assertGreater(len(times), 20)
            with open(os.path.join(folder, name), encoding="utf-8") as file:
                self.assertIn("CPU", json.load(file)["machine"])


class GoogleBenchmark(unittest.TestCase):
    def test_the_shortest_call_counts(self):
        best, failed = gbench.least_times([run_of("a/real_time", 5, least_ms=3), run_of("a/real_time", 4, least_ms=3.5)])
        self.assertEqual((best["a"]["ms"], failed), (3, {}))


if __name__ == "__main__":
    unittest.main()
