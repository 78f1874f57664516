# SPDX-License-Identifier: Apache-2.0
"""The snippets of the documents: the blocks of ```sh and ```python, and the list of snippets that run only under a condition.

python/tests/test_docs.py runs the snippets in Python, and run_snippets.py those in sh. run_tutorial.py runs the pages whose
output is compared.
"""
import collections
import json
import os
import pathlib
import re
import subprocess
import textwrap

ROOT = pathlib.Path(__file__).resolve().parents[2]
BLOCK = re.compile(r"^([ ]*)```(\w+)\n(.*?)^[ ]*```\n(?:\n```text\n(.*?)^```\n)?", re.MULTILINE | re.DOTALL)

Snippet = collections.namedtuple("Snippet", "document line language text condition")

# The points of an aortic root in millimetres, which stand for a patient's.
LANDMARKS = {"nadir-right": (12.9, 0, -10), "nadir-left": (-6.35, 11.23, -10), "nadir-non_coronary": (-6.74, -11, -10),
             "commissure-right-left": (6.62, 11.94, 8.2), "commissure-left-non_coronary": (-14.4, 0, 8.2),
             "commissure-non_coronary-right": (6.62, -11.94, 8.2)}


def landmarks():
    """Returns the content of root.mrk.json: these points in 3D Slicer's format."""
    control = [{"label": name, "position": position} for name, position in LANDMARKS.items()]
    return json.dumps({"markups": [{"type": "Fiducial", "coordinateSystem": "RAS", "coordinateUnits": "mm",
                                    "controlPoints": control}]})


def documents():
    """Returns the pages that show commands, by their paths from the top folder."""
    paths = [*ROOT.glob("*.md"), *ROOT.glob("docs/**/*.md"), *ROOT.glob("examples/**/*.md")]
    return sorted(str(path.relative_to(ROOT)) for path in paths if path.name != "CHANGELOG.md")


def conditions(list_file=None):
    """Returns the list as a dict, which maps a document and the first line of snippets to their conditions."""
    found = collections.defaultdict(list)
    for line in (list_file or pathlib.Path(__file__).with_name("snippets.txt")).read_text(encoding="utf-8").splitlines():
        if line and not line.startswith("#"):
            document, condition, first = line.split(" | ", 2)
            if not re.match(r"(never|elsewhere|modules): \S|long$", condition):
                raise SystemExit(f"snippets.txt: {condition!r} is not a condition")
            found[document, first.rstrip()].append(condition)
    return found


def snippets(list_file=None):
    """Returns all snippets in sh and Python. Ends with an error if the list names a snippet that no longer exists."""
    listed, made = conditions(list_file), []
    unused = set(listed)
    for document in documents():
        text = (ROOT / document).read_text(encoding="utf-8")
        for block in BLOCK.finditer(text):
            if block[2] not in ("sh", "python"):
                continue
            content = textwrap.dedent(block[3])
            first = content.split("\n", 1)[0].rstrip()
            keys = [(document, first), (document, re.sub(r" +#.*", "", first)), (document, "*")]
            key = next((one for one in keys if one in listed), None)
            unused.discard(key)
            condition = listed[key][0] if key else ""
            made.append(Snippet(document, text.count("\n", 0, block.start()) + 1, block[2], content, condition))
    if unused:
        raise SystemExit("\n".join(f"snippets.txt: {document} has no snippet that begins with: {first}"
                                   for document, first in sorted(unused)))
    return made


def is_run(condition):
    """Returns whether a snippet with this condition runs now. The caller of this function checks the modules that the snippet
    needs."""
    return not condition.startswith(("never", "elsewhere")) and (condition != "long" or os.environ.get("RIIS_TEST_LONG") == "1")


def run_commands(commands, folder, environment, *before):
    """Runs the commands of a snippet as a reader's bash would. The first command that fails ends the run."""
    return subprocess.run([*before, "bash", "-euo", "pipefail", "-c", commands], cwd=folder, env=environment, text=True,
                          stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, check=False)
