# SPDX-License-Identifier: Apache-2.0
"""run_tutorial.py check|write TUTORIAL.md SCRATCH PROGRAM_FOLDER RIIS: runs the tutorial as its reader would.

Every block of ```sh is run in the scratch folder, in order, and must succeed. The output of its commands follows in a block of
```text. `check` compares this block with the new output; `write` puts the new output into the tutorial. Seconds and numbers of
threads are not compared. Another version of gmsh makes other meshes. For such meshes only the first two words of each line are
compared, without numbers: "1 edge crosses" may become "3 edges cross".
"""
import os
import pathlib
import re
import shutil
import subprocess
import sys

from snippets import BLOCK, run_commands

NUMBER = r"\d[\d,.]*(?:e[+-]?\d+)?"


def comparable(text, same_gmsh):
    lines = []
    for line in text.splitlines():
        line = re.sub(r"\d+ threads?", "# threads", line)
        line = re.sub(r"\b\d+(\.\d)? s\b", "# s", line)
        if line.startswith("seconds") or not same_gmsh:
            line = re.sub("-?" + NUMBER, "#", line)
        lines.append(line.rstrip() if same_gmsh else " ".join(line.split()[:2]))
    return lines


def main(mode, tutorial, scratch, programs, riis):
    for program in "gmsh", "Xvfb":
        if not shutil.which(program):
            print(f"skipped: there is no {program}")
            return 77
    tutorial, scratch = pathlib.Path(tutorial), pathlib.Path(scratch)
    shutil.rmtree(scratch, ignore_errors=True)
    scratch.mkdir(parents=True)
    environment = dict(os.environ, PATH=f"{programs}:{os.environ['PATH']}", RIIS=riis)
    text = tutorial.read_text(encoding="utf-8")
    version = subprocess.run(["gmsh", "--version"], capture_output=True, text=True, check=True)
    same_gmsh = f"gmsh {(version.stdout + version.stderr).strip()} " in text.replace("\n", " ")
    problems, written, end = [], [], 0
    blocks = [block for block in BLOCK.finditer(text) if block[2] == "sh"]
    for block in blocks:
        commands, expected = block[3], block[4]
        done = run_commands(commands, scratch, environment)
        if done.returncode != 0:
            sys.exit(f"{commands}ended with {done.returncode}:\n{done.stdout}")
        if mode == "check" and comparable(done.stdout, same_gmsh) != comparable(expected or "", same_gmsh):
            problems.append(f"{commands}printed\n{done.stdout}and not\n{expected or ''}")
        if expected is not None:
            written.append(text[end:block.start(4)] + done.stdout)
            end = block.end(4)
    if not written:
        sys.exit(f"{tutorial} has no block of commands with their output")
    if mode == "write":
        tutorial.write_text("".join(written) + text[end:], encoding="utf-8")
    if problems:
        sys.exit("\n".join(problems))
    print(f"{len(blocks)} blocks of commands; {'all' if same_gmsh else 'no'} numbers compared")
    return 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
