# SPDX-License-Identifier: Apache-2.0
"""Tests Judged with a check that accepts a drop of at least 0.98. Judged must notice a check that accepts a fault."""
import os
import tempfile
import unittest

from judged import Judged

CHECK = """import sys
try:
    drop = float(open(sys.argv[1] + "/deep/drop.csv").read())
except OSError as error:
    sys.exit(print(error) or 2)
print(sys.argv[2], "the drop is", drop)
sys.exit(drop < 0.98)
"""


class Judging(unittest.TestCase):
    def setUp(self):
        held = tempfile.TemporaryDirectory()
        self.addCleanup(held.cleanup)
        self.check = os.path.join(held.name, "check.py")
        with open(self.check, "w", encoding="utf-8") as file:
            file.write(CHECK)

    def test_faults_are_refused(self):
        judge = Judged(self.check, {"deep/drop.csv": "0.99"}, "closed:")
        self.assertEqual(judge.passes(), "closed: the drop is 0.99\n")
        judge.refuses("closed: the drop is 0.97", {"deep/drop.csv": ("0.99", "0.97")})
        judge.refuses("No such file", {"deep/drop.csv": None}, status=2)

    def test_a_lenient_check_is_noticed(self):
        judge = Judged(self.check, {"deep/drop.csv": "0.99"}, "closed:")
        for text, fault in (("", ("0.99", "0.985")), ("another text", ("0.99", "0.9")), ("", ("0.5", "0.9"))):
            with self.assertRaises(AssertionError):
                judge.refuses(text, {"deep/drop.csv": fault})
        with self.assertRaises(AssertionError):
            Judged(self.check, {"deep/drop.csv": "0.9"}, "closed:").passes()


if __name__ == "__main__":
    unittest.main()
