# SPDX-License-Identifier: Apache-2.0
"""Calls a script's main many times in one process, because importing matplotlib or VTK takes longer than most calls.

answer.py SCRIPT PRINTED: each line of the standard input has the words of one call. The file PRINTED gets the text that the call
prints, and the standard output gets its exit status."""

import contextlib
import importlib
import os
import shlex
import sys


def main(script, printed):
    folder, name = os.path.split(script)
    sys.path.insert(0, folder)
    called = importlib.import_module(os.path.splitext(name)[0])
    for line in sys.stdin:
        with open(printed, "w", encoding="utf-8") as file, contextlib.redirect_stdout(file), contextlib.redirect_stderr(file):
            status = called.main(shlex.split(line))
        print(status, flush=True)


if __name__ == "__main__":
    main(*sys.argv[1:])
