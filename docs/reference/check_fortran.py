# SPDX-License-Identifier: Apache-2.0
# check_fortran.py ford.md: checks that every public Fortran name has a text in FORD's output. The names that FORD shows are
# compared with the names of the PUBLIC statements, so the check also finds a name that FORD overlooks. This script runs in the
# Python that has FORD.
import pathlib
import re
import sys

import ford
from ford.fortran_project import Project

settings, _ = ford.initialize()
project = Project(settings)
project.correlate()
documented, undocumented = set(), set()


def look(item, prefix=""):
    name = prefix + item.name
    procedure = getattr(item, "procedure", None)  # of an interface with one body
    has_text = any(line.strip() for line in item.doc_list) or (procedure and any(line.strip() for line in procedure.doc_list))
    (documented if has_text else undocumented).add(name.lower())


for module in project.modules:
    look(module)
    for kind in "variables", "types", "interfaces", "absinterfaces", "functions", "subroutines":
        for item in getattr(module, kind):
            if item.permission == "public":
                look(item)
                for part in getattr(item, "boundprocs", []) + (item.variables if kind == "types" else []):
                    if part.permission == "public":
                        look(part, item.name + "%")

for file in project.files:
    for item in file.functions + file.subroutines:  # external ones
        look(item)

for source in settings.src_dir:
    for path in sorted(pathlib.Path(source).glob("*.f90")):
        text = re.sub(r"!.*", "", path.read_text())
        for names in re.findall(r"^ *public *:: *((?:[^\n&]*& *\n)*[^\n]*)", text, re.MULTILINE | re.IGNORECASE):
            for name in re.findall(r"\w+", names):
                if name.lower() not in documented:
                    undocumented.add(name.lower())

if undocumented:
    sys.exit("not documented: " + ", ".join(sorted(undocumented)))
print(len(documented), "names")
