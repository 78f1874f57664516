# SPDX-License-Identifier: Apache-2.0
"""bound.py ROOT: checks that the Python package binds every function and field of riis.h, or that the list here gives a reason.

Also checks that every message of the library that names a part of riis.h has a Python name for it. The check only reads sources,
so it needs neither the package nor numpy.
"""

import pathlib
import re
import runpy
import sys

# Functions of riis.h, and the names through which the package calls them.
BOUND = {
    "riis_status_name": "status_name",
    "riis_version_string": "version_string",
    "riis_set_log": "set_log",
    "riis_last_error": "Error",
    "riis_valve_create": "Valve.__init__",
    "riis_valve_copy": "Valve.copy",
    "riis_valve_destroy": "Valve.close",
    "riis_valve_set": "Valve.__setitem__",
    "riis_valve_set_scalar": "Valve.__setitem__",
    "riis_valve_get": "Valve.__getitem__",
    "riis_valve_unset": "Valve.unset",
    "riis_valve_is_set": "Valve.is_set",
    "riis_valve_set_open_state": "Valve.set_open_state",
    "riis_valve_create_from_patches": "Valve.from_patches",
    "riis_valve_set_warp": "Valve.set_warp",
    "riis_valve_get_patches": "Valve.read_patches",
    "riis_warp_create": "Warp.__init__",
    "riis_warp_destroy": "Warp.close",
    "riis_warp_set_targets": "Warp.set_targets",
    "riis_warp_set_targets_at": "Warp.set_targets_at",
    "riis_warp_get_info": "Warp.info",
    "riis_warp_map": "Warp.map",
    "riis_valve_get_n_parameters": "Valve.parameters",
    "riis_valve_get_parameter": "Valve.parameters",
    "riis_surface_create": "Surface.__init__",
    "riis_surface_create_from_arrays": "Surface.from_arrays",
    "riis_surface_create_from_keyframes": "Surface.from_keyframes",
    "riis_surface_update": "Surface.update",
    "riis_surface_update_moving": "Surface.update_moving",
    "riis_surface_add_direction": "Surface.add_direction",
    "riis_surface_get_direction": "Surface.direction",
    "riis_surface_update_from_arrays": "Surface.update_from_arrays",
    "riis_surface_update_from_keyframes": "Surface.update_from_keyframes",
    "riis_surface_destroy": "Surface.close",
    "riis_surface_get_info": "Surface.info",
    "riis_surface_get_attachment": "Surface.attachment",
    "riis_surface_get_triangles": "Surface.triangles",
    "riis_keyframes_create": "Keyframes.__init__",
    "riis_keyframes_destroy": "Keyframes.close",
    "riis_find_crossings": "find_crossings",
    "riis_crossings_create": "find_crossings",
    "riis_crossings_destroy": "find_crossings",
    "riis_crossings_get_list": "find_crossings",
    "riis_closest_point": "Surface.closest_point",
    "riis_closest_points": "Surface.closest_points",
    "riis_mesh_create": "Mesh.__init__",
    "riis_mesh_update": "Mesh.update",
    "riis_mesh_create_grid": "Mesh.grid",
    "riis_mesh_update_grid": "Mesh.update_grid",
    "riis_mesh_destroy": "Mesh.close",
    "riis_mesh_prepare": "Mesh.prepare",
    "riis_mesh_set_adjacency": "Mesh.set_adjacency",
    "riis_adjacency_create_from_cells": "Adjacency.from_cells",
    "riis_adjacency_create_from_faces": "Adjacency.from_faces",
    "riis_adjacency_create_from_grid": "Adjacency.from_grid",
    "riis_adjacency_get_csr": "Adjacency.offsets",
    "riis_adjacency_destroy": "Adjacency.close",
    "riis_marks_create": "Marks.__init__",
    "riis_marks_destroy": "Marks.close",
    "riis_mark_nodes": "mark",
    "riis_marks_get_list": "Marks.ids",
    "riis_marks_get_dense": "Marks.dense",
    "riis_marks_get_stats": "Marks.stats",
    "riis_marks_add_resistance": "Marks.add_resistance",
    "riis_marks_add_reaction": "Marks.add_reaction",
    "riis_marks_add_vertex_reaction": "Marks.add_vertex_reaction",
    "riis_loads_add_sums": "load_sums",
    "riis_loads_add_forces": "loads",
    "riis_marks_get_band_sums": "Marks.band_sums",
    "riis_find_leaks": "find_leaks",
    "riis_leaks_create": "find_leaks",
    "riis_leaks_destroy": "find_leaks",
    "riis_leaks_get_list": "find_leaks",
    "riis_label_open_regions": "label_open_regions",
    "riis_find_passage": "find_passage",
    "riis_surface_get_n_leaflets": "Surface.leaflets",
    "riis_surface_get_leaflet": "Surface.leaflets",
    "riis_surface_get_orifice": "Surface.orifice",
    "riis_surface_get_orifice_in_wall": "Surface.orifice",
    "riis_surface_get_coaptation": "Surface.coaptation",
    "riis_surface_get_gap": "Surface.gap",
    "riis_valve_set_skirt_to_wall": "Valve.skirt_to_wall",
    "riis_surface_get_leak": "Surface.leak",
    "riis_find_by_area": "find_by_area",
    "riis_find_first_passage": "find_first_passage",
    "riis_marks_get_cells_across": "Marks.cells_across",
    "riis_valve_get_swept_volume": "Valve.swept_volume",
    "riis_place": "place",
    "riis_opening_from_table": "OpeningTable.opening_and_rate",
    "riis_opening_from_times": "OpeningTimes.opening_and_rate",
    "riis_opening_switch_advance": "OpeningSwitch.advance",
    "riis_opening_angle_advance": "OpeningAngle.advance",
}
# Functions that are left out, with reasons. If a struct holds options, it becomes keyword arguments, or a class with defaults. So
# nobody initialises a struct, and the functions whose names end in _init are left out also.
LEFT_OUT = {
    name: "a mesh of this package shows the coordinates as they are, so it borrows them"
    for name in ("riis_mesh_create_copy", "riis_mesh_update_copy")
}
# Fields of structs that python/src does not use, with reasons.
FIELDS_LEFT_OUT = {
    f"{struct}.real_bits": "arrays have 64 bits, the default"
    for struct in ("riis_points", "riis_grid", "riis_surface_arrays", "riis_keyframe_arrays", "riis_landmarks")
} | {
    "riis_grid.origin": "numpy makes axes of equal spacing",
    "riis_grid.spacing": "numpy makes axes of equal spacing",
    "riis_gap.n_ends": "is the size of distance",
    "riis_placement.n_undetermined": "undetermined has the names",
    "riis_resistance_arrays.K_stride": "K is contiguous, the default",
}


def fields_of(header: str) -> set[str]:
    """Returns the fields of all structs, such as riis_mark_list.height, except the size of a struct and padding."""
    code = re.sub(r"/\*.*?\*/", "", header, flags=re.DOTALL)
    fields = set()
    for struct, body in re.findall(r"typedef struct (riis_\w+) \{(.*?)\} \1;", code, re.DOTALL):
        names = re.findall(r"(\w+)(?:\[[^\]]*\])*\s*[,;]", body)
        fields |= {f"{struct}.{name}" for name in names if name not in ("struct_size", "reserved")}
    return fields


def texts_of_the_library(root: pathlib.Path) -> list[str]:
    """Returns the texts in the library's sources that name a part of riis.h. Statuses also have their C names in Python."""
    folders = [folder for folder in (root / "src" / "riis").iterdir() if folder.is_dir()]
    paths = sorted(path for folder in folders for path in folder.rglob("*.[ch]pp") if path.name != "library_api.cpp")
    lines = [line for path in paths for line in path.read_text(encoding="utf-8").splitlines()]
    code = "\n".join(line for line in lines if not line.lstrip().startswith(("#", "//")))
    return [text for text in re.findall(r'"((?:[^"\\\n]|\\.)*)"', code) if "riis_" in text or "RIIS_" in text]


def header_of(root: pathlib.Path) -> str:
    """Returns riis.h and the headers that it includes."""
    path = root / "include/riis/riis.h"
    text = path.read_text(encoding="utf-8")
    names = re.findall(r'^#include "(\w+\.h)"', text, re.MULTILINE)
    return text + "".join((path.parent / name).read_text(encoding="utf-8") for name in names)


def check(root: pathlib.Path) -> list[str]:
    """Returns the faults, one per line."""
    header = header_of(root)
    sources = "".join(path.read_text(encoding="utf-8") for path in sorted((root / "python/src").glob("*.[ch]pp")))
    sources += (root / "src/program/input/placing.cpp").read_text(encoding="utf-8")  # which the module contains
    functions = {name for name in re.findall(r"^RIIS_API [^(]*?\b(riis_\w+)\(", header, re.MULTILINE)
                 if not name.endswith("_init")}
    wrong = [] if len(functions) > 70 else ["riis.h was not read"]
    wrong += [f"{name} is not in python/tests/bound.py" for name in sorted(functions - set(BOUND) - set(LEFT_OUT))]
    wrong += [f"{name} of python/tests/bound.py is not in riis.h" for name in sorted((set(BOUND) | set(LEFT_OUT)) - functions)]
    wrong += [f"{name} is bound and left out" for name in sorted(set(BOUND) & set(LEFT_OUT))]
    wrong += [f"{name} is not called in python/src" for name in sorted(BOUND) if not re.search(rf"\b{name}\b", sources)]
    fields = fields_of(header)
    wrong += [] if len(fields) > 300 else ["the structs of riis.h were not read"]
    unused = {name for name in fields if not re.search(rf"(\.|::|->){name.split('.')[1]}\b", sources)}
    wrong += [f"the field {name} is neither used in python/src nor in FIELDS_LEFT_OUT" for name in
              sorted(unused - set(FIELDS_LEFT_OUT))]
    wrong += [f"{name} of FIELDS_LEFT_OUT is used, or not in riis.h" for name in sorted(set(FIELDS_LEFT_OUT) - unused)]
    wrong += [f"{name} has no reason" for name, reason in {**LEFT_OUT, **FIELDS_LEFT_OUT}.items() if not reason]
    in_python = runpy.run_path(str(root / "python/riis/_errors.py"))["in_python"]
    texts = texts_of_the_library(root)
    wrong += [] if texts else ["no text of src was read"]
    wrong += [f"python/riis/_errors.py lacks a name for the text '{text}'" for text in texts
              if re.search("riis_|RIIS_", in_python(text))]
    return wrong


if __name__ == "__main__":
    problems = check(pathlib.Path(sys.argv[1]))
    print("\n".join(problems) or f"{len(BOUND)} functions are bound, {len(LEFT_OUT)} are left out for a reason")
    sys.exit(bool(problems))
