# SPDX-License-Identifier: Apache-2.0
"""Runs a host's check.py on the tables of a run, and on copies with one fault each.

    judge = Judged(check, {"drop.csv": "step,drop\\n1,0.99\\n"}, "closed")   # check.py FOLDER closed
    judge.passes()
    judge.refuses("the drop is 0.9", {"drop.csv": ("0.99", "0.9")})         # a text in the file, and what stands there instead
    judge.refuses("drop.csv", {"drop.csv": None}, status=2)                 # the file is missing"""

import os
import subprocess
import sys
import tempfile


class Judged:
    def __init__(self, check, tables, *arguments):
        """check: the path of check.py, which gets the folder of the tables and then these arguments; tables: texts by name."""
        self.check, self.tables, self.arguments = check, tables, arguments

    def said(self, tables):
        """Returns the status of check.py for these tables, and everything that it prints."""
        with tempfile.TemporaryDirectory() as folder:
            for name, text in tables.items():
                path = os.path.join(folder, name)
                os.makedirs(os.path.dirname(path), exist_ok=True)
                with open(path, "w", encoding="utf-8") as file:
                    file.write(text)
            done = subprocess.run([sys.executable, "-B", self.check, folder, *self.arguments], text=True, check=False,
                                  stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
        return done.returncode, done.stdout

    def passes(self):
        status, said = self.said(self.tables)
        assert status == 0, f"{self.check} refuses the recorded tables with the status {status}: {said}"
        return said

    def refuses(self, text, faults, status=1):
        """Checks check.py for tables with these faults: it must end with the status and print the text."""
        tables = dict(self.tables)
        for name, fault in faults.items():
            if fault is None:
                del tables[name]
                continue
            old, new = fault
            assert old in tables[name], f"{name} lacks {old!r}"
            tables[name] = tables[name].replace(old, new, 1)
        found, said = self.said(tables)
        assert found == status, f"{self.check} ends with {found}, not with {status}, for {faults}: {said}"
        assert text in said, f"{self.check} does not print {text!r} for {faults}: {said}"
