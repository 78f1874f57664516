#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Draws the meaning of every parameter of a valve, from the library's own curves at the default parameters.

draw.py CURVES.json FOLDER [KIND...]: CURVES.json comes from riis-figures --curves. The script writes KIND_parameters as .png and
.svg into the folder, for these kinds of valve or for all. The script also writes parameters.json, from which draw_page.py puts
the drawings on its page. A drawing is refused if it omits a parameter, shows a wrong value, or has labels that overlap."""

import json
import os
import sys

import aortic
import bileaflet
import coapting
import curves
import mitral
import sheet
import trileaflet

MODULES = {"aortic": aortic, "trileaflet": trileaflet, "coapting": coapting, "mitral": mitral, "bileaflet": bileaflet}

CAPTIONS = {
    "aortic": "Every parameter of the aortic valve, with its default. Lines, angles and points are the library's own: each is "
    "compared with the parameter that it is named by.",
    "trileaflet": "Every parameter of the trileaflet valve, with its default, likewise.",
    "coapting": "Every parameter of the coapting valve, with its default, likewise.",
    "mitral": "Every parameter of the mitral valve, with its default, likewise.",
    "bileaflet": "Every parameter of the bileaflet valve, with its default, likewise.",
}
PAPER = {
    "aortic": "table “Aortic valve parameters” (section 2.1), which has no picture of them.",
    "trileaflet": "none: the paper has no such valve.",
    "coapting": "none: the paper has no such valve.",
    "mitral": "appendix, table of the mitral valve's parameters.",
    "bileaflet": "none: the paper has no such valve.",
}


def main(arguments):
    if len(arguments) < 2 or not set(arguments[2:]) <= set(MODULES):
        print(f"usage: draw.py CURVES.json FOLDER [{'|'.join(MODULES)}...]", file=sys.stderr)
        return 2
    path, folder, *kinds = arguments
    with open(path, encoding="utf-8") as file:
        valves = json.load(file)
    figures = []
    for valve in kinds or MODULES:
        try:
            states = [curves.state_of(valve, state) for state in valves[valve]["states"]]
            MODULES[valve].draw({**valves[valve], "states": states}).save(os.path.join(folder, f"{valve}_parameters"))
        except sheet.Refused as why:
            print(f"draw.py: {valve} valve: {why}", file=sys.stderr)
            return 1
        panel = {"png": f"{valve}_parameters.png", "caption": f"The {valve} valve's parameters."}
        title = f"What the parameters of the {valve} valve measure"
        figures.append({"title": title, "columns": 1, "panels": [panel], "caption": CAPTIONS[valve], "paper": PAPER[valve]})
    with open(os.path.join(folder, "parameters.json"), "w", encoding="utf-8") as file:
        json.dump({"figures": figures}, file, indent=2)
        file.write("\n")
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
