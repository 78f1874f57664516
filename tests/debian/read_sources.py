#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""read_sources.py BUILD_FOLDER STANDARD... [-FLAG...]

Lets the compiler of a configured folder read every C and C++ file that the folder would compile, with its flags. Each file is
read in each named standard of C++. The compiler makes no code. If the folder was configured with warnings as errors, a warning is
a failure. Files of C are read once.
"""
import concurrent.futures
import json
import os
import shlex
import subprocess
import sys


def commands(folder, standards, flags):
    with open(os.path.join(folder, "compile_commands.json"), encoding="utf-8") as file:
        for entry in json.load(file):
            words = shlex.split(entry["command"])
            output = words.index("-o")
            words = [word for i, word in enumerate(words) if i not in (output, output + 1)] + flags + ["-fsyntax-only"]
            is_c = entry["file"].endswith(".c")
            for standard in standards[:1] if is_c else standards:
                yield entry["directory"], words + ([] if is_c else ["-std=" + standard]), entry["file"]


def main():
    folder, flags = sys.argv[1], [word for word in sys.argv[2:] if word.startswith("-")]
    todo = list(commands(folder, [word for word in sys.argv[2:] if not word.startswith("-")], flags))
    if not todo:
        sys.exit(f"read_sources.py: {folder} has no files")

    def read(command):
        return subprocess.run(command[1], cwd=command[0], capture_output=True, text=True, check=False)

    n_faulty = 0
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        for command, done in zip(todo, pool.map(read, todo)):
            if done.returncode != 0 or done.stderr:
                n_faulty += 1
                print(" ".join(command[1]), done.stderr, sep="\n", flush=True)
    n_files = len({command[2] for command in todo})
    print(f"{n_files} files, {len(todo)} times read, {n_faulty} with faults")
    sys.exit(n_faulty > 0)


main()
