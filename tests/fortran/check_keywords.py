# SPDX-License-Identifier: Apache-2.0
"""check_keywords.py SOURCES: in riis.h, the arguments of every released function must have the same names as in abi/riis-*.xml.
In C, argument names mean nothing to a caller. But riis_c.f90 takes the names from riis.h, and in Fortran they are keywords."""

import glob
import os
import sys
import xml.etree.ElementTree

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "fortran", "bindings"))
from header import Header


def main(sources):
    header = Header(os.path.join(sources, "include", "riis", "riis.h"), "riis.h")
    now = {function.name: [argument.name for argument in function.arguments] for function in header.functions}
    compared = renamed = 0
    for path in glob.glob(os.path.join(sources, "abi", "riis-*.xml")):
        for released in xml.etree.ElementTree.parse(path).iter("function-decl"):
            name, names = released.get("name"), [argument.get("name", "?") for argument in released.findall("parameter")]
            if name not in now:  # not in riis.h now; the test riis_symbols reports removed functions
                continue
            compared += 1
            if now[name] != names:
                renamed += 1
                print(f"riis.h: {name} has the arguments {', '.join(now[name])}, but was released with {', '.join(names)}",
                      file=sys.stderr)
    print(f"{compared} functions")
    return 1 if renamed or not compared else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1]))
