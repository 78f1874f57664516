# SPDX-License-Identifier: Apache-2.0
"""Every function of riis.h is bound, or left out for a reason that stands here. All that is public has a text."""

import ast
import inspect
import pathlib
import re

import riis

ROOT = pathlib.Path(__file__).resolve().parents[2]

BOUND = {
    "riis_status_name": "status_name",
    "riis_version": "version",
    "riis_version_string": "version_string",
    "riis_set_log": "set_log",
    "riis_last_error": "Error",
    "riis_valve_create": "Valve.__init__",
    "riis_valve_copy": "Valve.copy",
    "riis_valve_destroy": "Valve.close",
    "riis_valve_set": "Valve.__setitem__",
    "riis_valve_set_scalar": "Valve.__setitem__",
    "riis_valve_get": "Valve.__getitem__",
    "riis_valve_set_open_state": "Valve.set_open_state",
    "riis_valve_create_from_patches": "Valve.from_patches",
    "riis_valve_n_parameters": "Valve.parameters",
    "riis_valve_parameter": "Valve.parameters",
    "riis_surface_create": "Surface.__init__",
    "riis_surface_create_from_arrays": "Surface.from_arrays",
    "riis_surface_create_from_keyframes": "Surface.from_keyframes",
    "riis_surface_update": "Surface.update",
    "riis_surface_update_moving": "Surface.update_moving",
    "riis_surface_update_from_arrays": "Surface.update_from_arrays",
    "riis_surface_update_from_keyframes": "Surface.update_from_keyframes",
    "riis_surface_destroy": "Surface.close",
    "riis_surface_get_info": "Surface.info",
    "riis_surface_vertices": "Surface.vertices",
    "riis_surface_vertex_parameters": "Surface.uv",
    "riis_surface_vertex_velocities": "Surface.velocities",
    "riis_surface_triangles": "Surface.triangles",
    "riis_keyframes_create": "Keyframes.__init__",
    "riis_keyframes_destroy": "Keyframes.close",
    "riis_find_crossings": "find_crossings",
    "riis_surface_crossing_pairs": "Surface.crossing_pairs",
    "riis_closest_point": "Surface.closest_point",
    "riis_closest_points": "Surface.closest_points",
    "riis_mesh_create": "Mesh.__init__",
    "riis_mesh_update": "Mesh.update",
    "riis_mesh_destroy": "Mesh.close",
    "riis_mesh_prepare": "Mesh.prepare",
    "riis_mesh_set_adjacency": "Mesh.set_adjacency",
    "riis_adjacency_create_from_cells": "Adjacency.from_cells",
    "riis_adjacency_create_from_faces": "Adjacency.from_faces",
    "riis_adjacency_create_from_grid": "Adjacency.from_grid",
    "riis_adjacency_csr": "Adjacency.offsets",
    "riis_adjacency_destroy": "Adjacency.close",
    "riis_mark_result_create": "MarkResult.__init__",
    "riis_mark_result_destroy": "MarkResult.close",
    "riis_mark_nodes": "mark",
    "riis_mark_result_marked": "MarkResult.ids",
    "riis_mark_result_within_limit": "MarkResult.within_limit",
    "riis_mark_result_marked_fields": "MarkResult.normal",
    "riis_mark_result_within_limit_fields": "WithinLimit.normal",
    "riis_mark_result_dense": "MarkResult.dense",
    "riis_mark_result_stats": "MarkResult.stats",
    "riis_mark_result_add_resistance": "MarkResult.add_resistance",
    "riis_mark_result_add_reaction": "MarkResult.add_reaction",
    "riis_mark_result_band_sums": "MarkResult.band_sums",
    "riis_find_leaks": "find_leaks",
    "riis_mark_result_leaking_edges": "MarkResult.leaking_edges",
    "riis_label_open_regions": "label_open_regions",
    "riis_find_passage": "find_passage",
    "riis_opening_from_table": "OpeningTable.opening_and_rate",
    "riis_opening_from_times": "OpeningTimes.opening_and_rate",
    "riis_opening_switch_advance": "OpeningSwitch.advance",
    "riis_opening_angle_advance": "OpeningAngle.advance",
}
# A struct of options is a call's keyword arguments, or a class with defaults.
LEFT_OUT = {
    name: "keyword arguments have defaults, so nobody initialises a struct"
    for name in (
        "riis_patches_init",
        "riis_surface_options_init",
        "riis_surface_arrays_init",
        "riis_keyframe_arrays_init",
        "riis_crossing_options_init",
        "riis_closest_options_init",
        "riis_closest_arrays_init",
        "riis_csr_init",
        "riis_cells_init",
        "riis_faces_init",
        "riis_mark_options_init",
        "riis_resistance_init",
        "riis_opening_table_init",
        "riis_opening_times_init",
        "riis_opening_switch_init",
        "riis_opening_switch_state_init",
        "riis_opening_angle_init",
        "riis_opening_angle_state_init",
    )
}


def test_every_function_is_bound_or_left_out():
    header = (ROOT / "include/riis/riis.h").read_text(encoding="utf-8")
    functions = set(re.findall(r"^RIIS_API [^(]*?\b(riis_\w+)\(", header, re.MULTILINE))
    assert len(functions) > 70
    assert functions == set(BOUND) | set(LEFT_OUT)
    assert not set(BOUND) & set(LEFT_OUT) and all(LEFT_OUT.values())
    sources = "".join(path.read_text(encoding="utf-8") for path in sorted((ROOT / "python/src").glob("*.[ch]pp")))
    for function, name in BOUND.items():
        assert re.search(rf"\b{function}\b", sources), f"{function} is not called"
        found = riis
        for part in name.split("."):
            found = getattr(found, part)
    for function in LEFT_OUT:
        assert re.search(rf"\b{function}\(", sources), f"{function} does not fill the defaults of its struct"


def test_options_of_surfaces_are_the_fields_of_their_struct():
    header = (ROOT / "include/riis/riis.h").read_text(encoding="utf-8")
    struct = re.search(r"typedef struct riis_surface_options \{(.*?)\n\}", header, re.DOTALL)[1]
    code = re.sub(r"/\*.*?\*/", "", struct, flags=re.DOTALL)
    fields = set(re.findall(r"(\w+)(?:\[3\])?;", code)) - {"struct_size", "reserved"}
    try:
        riis.Surface(riis.Valve(), nothing=1)
    except TypeError as refusal:
        options = set(str(refusal).split("the options are ")[1].split(", "))
    assert options == fields


def public_objects():
    for name in riis.__all__:
        found = getattr(riis, name)
        if not (inspect.isclass(found) or callable(found)):
            continue
        yield name, found
        if inspect.isclass(found) and found.__module__.startswith("riis"):
            for member, value in vars(found).items():
                if not member.startswith("_") and (callable(value) or isinstance(value, property)):
                    if not hasattr(tuple, member) and not hasattr(int, member):
                        yield f"{name}.{member}", value


def test_everything_public_has_a_text():
    names = dict(public_objects())
    assert len(names) > 90
    inherited = {"opening_and_rate"}  # the laws of time have the text of their base
    missing = [n for n, value in names.items() if not value.__doc__ and n.split(".")[-1] not in inherited]
    assert not missing


def test_the_stub_has_every_name():
    stub = pathlib.Path(riis.__file__).with_name("_riis.pyi").read_text(encoding="utf-8")
    tree = ast.parse(stub)
    stubs = {node.name: node for node in tree.body if isinstance(node, (ast.ClassDef, ast.FunctionDef))}
    for name, found in vars(riis._riis).items():
        if name.startswith("__") or isinstance(found, (int, float)):
            continue
        assert name in stubs or name.startswith("_"), name
        if inspect.isclass(found):
            members = {node.name: node for node in stubs[name].body if isinstance(node, ast.FunctionDef)}
            for member in vars(found):
                if not member.startswith("_"):
                    assert member in members, f"{name}.{member}"
                    assert members[member].returns is not None, f"{name}.{member} has no annotation"
    assert pathlib.Path(riis.__file__).with_name("py.typed").exists()
