# SPDX-License-Identifier: Apache-2.0
"""The view's files: a case of the program riis, a command, a script, and OpenFOAM's dictionary.

Numbers are written with all their digits, so each file gives the same marks, to the last bit.
"""

from __future__ import annotations

import json
import math
import os
import shlex
from collections.abc import Iterable, Mapping
from typing import Any, NamedTuple

from riis._place import UNITS
from riis._riis import resistance_units
from riis.laws import OpeningTable, OpeningTimes
from riis.view._domains import OPTION
from riis.view._landmark_files import nested
from riis.view._landmarks import warp_object
from riis.view._valves import KINDS, Value, ValveState, refuse
from riis.view._walls import Wall

class Facts(NamedTuple):
    """Everything in the written files except the valves."""

    unit: str | None
    path: str | None  #: of the mesh
    cells_where: str | None
    wall: Wall | None
    is_wall_alone: bool  #: whether there is no mesh


def has_unit(states: Iterable[ValveState], unit: str | None) -> bool:
    """Returns whether the scale of all valves follows from the unit. If so, files may state the unit."""
    return unit is not None and all(state.scale == UNITS[unit] for state in states)


def _resistance(state: ValveState, unit: str | None) -> float:
    """Returns R in the units of the mesh. The state stores R in kg/(m s) if the mesh has a unit."""
    return state.resistance if unit is None else state.resistance * resistance_units(unit)[0]


def _check_paths(states: Iterable[ValveState]) -> None:
    for k, state in enumerate(states):
        if state.surface is not None and state.surface.path is None:
            raise refuse(f"valve {k}: its surface has no file, so no other program can read it; add it with a path")


def _wall_path(facts: Facts) -> str:
    if facts.wall is None or facts.wall.path is None:
        raise refuse("wall: has no file, so no other program can read it; make it with a path")
    return os.path.abspath(facts.wall.path)


def law_values(law: OpeningTable | OpeningTimes) -> dict[str, Any]:
    """Returns a law with the keys of a case."""
    if isinstance(law, OpeningTable):
        made: dict[str, Any] = {"times": law.time.tolist(), "openings": law.opening.tolist(), "interpolation": law.interpolation}
    else:
        keys = ("opening_start", "opening_duration", "closing_start", "closing_duration", "closed", "open")
        made = {key: getattr(law, key) for key in keys}
    if law.period > 0.0:
        made["period"] = law.period
    return made


# ---- The program ----


def _times_of_surfaces(states: Iterable[ValveState]) -> list[float] | None:
    """Returns two times of a series: the present time of moving surfaces, and a later one. Returns None if no surface moves."""
    moving = [state for state in states if state.surface is not None and state.surface.moves]
    if len({state.time for state in moving}) > 1:
        places = ", ".join(f"{state.name} at {state.time!r}" for state in moving)
        raise refuse(f"time: the surfaces are at different times, and a case has one: {places}; move them to one time first")
    if not moving or moving[0].surface is None or moving[0].surface.times is None:
        return None
    now, times = moving[0].time, moving[0].surface.times
    return [now, now + (moving[0].surface.period or float(times[-1] - times[0])) / 50.0]


def case_of(states: tuple[ValveState, ...], facts: Facts, times: list[float] | None) -> str:
    """Returns a case. Without times the valves keep their openings, and surfaces keep their time."""
    unit, path, cells_where = facts.unit, facts.path, facts.cells_where
    _check_paths(states)
    if not states:
        raise refuse("valves: there are none; a case needs one")
    stays = times is None
    if times is None:
        times = _times_of_surfaces(states)
    root: dict[str, Any] = {}
    if path is not None:
        root["mesh"] = os.path.abspath(path)
    if cells_where is not None:
        root["cells_where"] = cells_where
    with_unit = has_unit(states, unit)
    if with_unit:
        root["unit"] = unit
    if times is not None:
        root["times"] = times
    root["valves"] = []
    for state in states:
        valve: dict[str, Any] = {"name": state.name} if len(states) > 1 else {}
        if state.surface is not None:
            valve["surface"] = os.path.abspath(str(state.surface.path))
            if state.surface.period > 0.0 and state.surface.moves:
                valve["period"] = state.surface.period
            if with_unit:
                valve["surface_unit"] = "cm"
        else:
            valve["valve"] = state.kind
            valve["parameters"] = nested(state.parameters)
            valve["opening"] = state.opening if stays or state.cycle is None else law_values(state.cycle.law)
            if state.triangulation != "adapted":
                valve["triangulation"] = state.triangulation
        if not with_unit:
            valve["scale"] = state.scale
        valve["rotate"] = list(state.rotation)
        valve["translate"] = list(state.origin)
        if state.warp is not None:
            valve["warp"] = warp_object(state.warp)
        if state.skirt > 0.0:
            valve["skirt"], valve["wall"] = state.skirt, _wall_path(facts)
        valve["half_thickness"] = state.half_thickness
        if state.offset != 0.0:
            valve["offset"] = state.offset
        valve["resistance"] = state.resistance if with_unit else _resistance(state, unit)
        root["valves"].append(valve)
    return json.dumps(root, indent=2) + "\n"


def _numbers(values: Iterable[float]) -> str:
    return ",".join(repr(float(value)) for value in values)


def is_from_its_file(state: ValveState, facts: Facts) -> bool:
    """Returns whether a command names the file of the placed valve. The valve may have other sizes than those in the file."""
    source = state.placed
    return source is not None and has_unit([state], facts.unit) and source.unit == facts.unit and source.places(state)


def command_of(
    states: tuple[ValveState, ...], facts: Facts, case: str, output: str, program: str, warp: str
) -> str:
    _check_paths(states)
    if not states:
        raise refuse("valves: there are none; a command needs one")
    state, unit, path = states[0], facts.unit, facts.path
    if facts.is_wall_alone:
        if len(states) > 1:
            raise refuse(f"valves: there are {len(states)}; without a mesh a command writes the surface of one valve")
        output = os.path.splitext(output)[0] + ".vtp"
    if len(states) > 1:
        if _times_of_surfaces(states) is not None:  # the case has times, so the program writes a series
            output = os.path.splitext(output)[0] + ".pvd"
        return shlex.join([program, "mark", "--case", case, "--output", output])
    words = [program, "mark", "MESH.vtu" if path is None else os.path.abspath(path)]
    if facts.is_wall_alone:
        words = [program, "surface"]
    if facts.cells_where is not None:
        words.append(f"{OPTION}={facts.cells_where}")
    with_unit = has_unit(states, unit)
    is_placed = is_from_its_file(state, facts)
    if state.surface is not None:
        words.append(f"--surface={os.path.abspath(str(state.surface.path))}")
        if state.surface.moves:
            words.append(f"--time={state.time!r}")
            if state.surface.period > 0.0:
                words.append(f"--period={state.surface.period!r}")
        if with_unit:
            words.append("--surface-unit=cm")
    else:
        known: Mapping[str, Value] = {}
        if is_placed and state.placed is not None:
            known = state.placed.parameters
            words.append(f"--valve={state.placed.path}")
        else:
            words.append(f"--valve={state.kind}")
        for name, value in state.parameters.items():
            if known.get(name) != value:
                words.append(f"--set={name}={_numbers(value if isinstance(value, tuple) else (value,))}")
        words.append(f"--opening={state.opening!r}")
        if state.triangulation != "adapted":
            words.append(f"--triangulation={state.triangulation}")
    words.append(f"--unit={unit}" if with_unit else f"--scale={state.scale!r}")
    if not is_placed:
        words += [f"--rotate={_numbers(state.rotation)}", f"--translate={_numbers(state.origin)}"]
        if state.warp is not None:
            words.append(f"--warp={warp}")
    if state.skirt > 0.0:
        words += [f"--skirt={state.skirt!r}", f"--wall={_wall_path(facts)}"]
    words.append(f"--half-thickness={state.half_thickness!r}")
    if not facts.is_wall_alone:
        if state.offset != 0.0:
            words.append(f"--offset={state.offset!r}")
        resistance = state.resistance if with_unit else _resistance(state, unit)  # without --unit it is in the mesh's units
        words.append(f"--resistance={resistance!r}")
    return shlex.join([*words, f"--output={output}"])


# ---- Python ----


def _units_of_K(unit: str | None) -> str:
    if unit is None:
        return "  # in the units of the mesh, as R is"
    _, of_R, of_K = resistance_units(unit)
    return f"  # in {of_K}, with R in {of_R}"


def python_of(states: tuple[ValveState, ...], facts: Facts) -> str:
    _check_paths(states)
    unit, path, cells_where = facts.unit, facts.path, facts.cells_where
    has_skirt = any(state.skirt > 0.0 for state in states)
    reads_part = path is not None and cells_where is not None
    uses_files = (path is not None and not reads_part) or any(state.surface is not None for state in states)
    lines = ["import numpy"] + (["import pyvista"] if uses_files else []) + ["import riis"]
    lines += ["from riis.view import reading", ""] if reads_part or has_skirt else [""]
    if path is None:
        lines.append("# points: (n, 3) float64, the nodes of the mesh")
    elif reads_part:
        lines.append(f"grid = reading.read_mesh({os.path.abspath(path)!r}, cells_where={cells_where!r})")
        lines.append("points = numpy.array(grid.points, numpy.float64)")
    else:
        lines.append(f"points = numpy.array(pyvista.read({os.path.abspath(path)!r}).points, numpy.float64)")
    lines += ["mesh = riis.Mesh(points)", "K = numpy.zeros(len(mesh))" + _units_of_K(unit), "marks = {}"]
    if has_skirt:
        lines.append(f"wall = reading.read_wall({_wall_path(facts)!r}).surface")
    for state in states:
        lines.append("")
        options = ", ".join(f"{key}={value!r}" for key, value in state.options.items())
        if state.surface is None:
            lines.append(f"valve = riis.Valve({state.kind!r})")
            if state.parameters:
                lines.append("valve.update({")
                lines += [f"    {name!r}: {value!r}," for name, value in state.parameters.items()]
                lines.append("})")
            lines.append(f'valve["opening"] = {state.opening!r}')
            lines += _python_of_warp(state)
            if state.skirt > 0.0:
                where = ", ".join(f"{key}={value!r}" for key, value in state.placement.items())
                lines.append(f"valve.skirt_to_wall(wall, {state.skirt!r}, {where})")
            lines.append(f"surface = riis.Surface(valve, {options})")
        else:
            lines += _python_of_surface(state, options)
        lines.append(f"marks[{state.name!r}] = riis.mark(surface, mesh)")
        lines.append(f"marks[{state.name!r}].add_resistance(K, R={_resistance(state, unit)!r})")
    return "\n".join(lines) + "\n"


def _python_of_warp(state: ValveState) -> list[str]:
    warp = state.warp
    if warp is None:
        return []
    where = ", placement={" + ", ".join(f"{key!r}: {value!r}" for key, value in state.placement.items()) + "}"
    return [
        f"sources = numpy.array({warp.sources.tolist()!r})",
        f"targets = numpy.array({warp.targets.tolist()!r})",
        f"warp = riis.Warp(sources, noise={warp.noise!r}{where if warp.is_in_mesh else ''})",
        "warp.set_targets(targets)",
        "valve.set_warp(warp)",
    ]


def _python_of_surface(state: ValveState, options: str) -> list[str]:
    """Returns the lines that read a surface as the view does, and make it at the present time."""
    source = state.surface
    assert source is not None
    path, leaflets = repr(os.path.abspath(str(source.path))), ""
    if source.moves:
        lines = [
            f"reader, frames = pyvista.get_reader({path}), []",
            "for time in reader.time_values:",
            "    reader.set_active_time_value(time)",
            "    frames.append(reader.read()[0].triangulate())",
        ]
    else:
        lines = [f"frames = [pyvista.read({path}).triangulate()]"]
    lines.append("faces = frames[0].regular_faces.astype(numpy.int64)")
    lines.append("vertices = numpy.array([frame.points for frame in frames], numpy.float64)")
    if source.leaflet_id is not None:
        lines.append('leaflet = numpy.array(frames[0].cell_data["riis_leaflet"], numpy.int32)')
        leaflets = ", leaflet_id=leaflet"
    if not source.moves:
        return [*lines, f"surface = riis.Surface.from_arrays(vertices[0], faces{leaflets}, {options})"]
    lines.append("times = numpy.array(reader.time_values, numpy.float64)")
    lines.append(f"keyframes = riis.Keyframes(times, vertices, faces{leaflets}, period={source.period!r})")
    return [*lines, f"surface = riis.Surface.from_keyframes(keyframes, {state.time!r}, {options})"]


# ---- OpenFOAM ----

_METRES = {"mm": 1e-3, "cm": 1e-2, "m": 1.0}


def _foam(values: Iterable[float]) -> str:
    return "(" + " ".join(repr(float(value)) for value in values) + ")"


def _foam_law(state: ValveState) -> list[str]:
    if state.cycle is None:
        return ["law constant;", f"opening {state.opening!r};"]
    law = state.cycle.law
    period = [f"period {law.period!r};"] if law.period > 0.0 else []
    if isinstance(law, OpeningTable):
        keys = [f"    ({time!r} {opening!r})" for time, opening in zip(law.time.tolist(), law.opening.tolist(), strict=True)]
        return ["law table;", "keys", "(", *keys, ");", f"interpolation {law.interpolation};", *period]
    return [
        "law times;", f"openingStart {law.opening_start!r};", f"openingSeconds {law.opening_duration!r};",
        f"closingStart {law.closing_start!r};", f"closingSeconds {law.closing_duration!r};", f"closed {law.closed!r};",
        f"open {law.open!r};", *period,
    ]


def _foam_warp(state: ValveState, metres: float) -> list[str]:
    if state.warp is None:
        return []
    warp, lines = state.warp.in_mesh(state.placement), ["    warp", "    {"]
    for name, points in (("sources", warp.sources), ("targets", warp.targets)):
        lines += [f"        {name}", "        ("]
        lines += [f"            {_foam(metres * x for x in point)}" for point in points.tolist()] + ["        );"]
    return [*lines, f"        noise {metres * warp.noise!r};", "    }"]


def openfoam_of(states: tuple[ValveState, ...], unit: str | None, density: float) -> str:
    if not density > 0.0 or not math.isfinite(density):
        raise refuse(f"density: is {density!r}; it must be above 0")
    metres = _METRES[unit] if unit is not None else 1.0
    lines = ["FoamFile { version 2.0; format ascii; class dictionary; object fvOptions; }", ""]
    for k, state in enumerate(states):
        if state.surface is not None:
            raise refuse(f"valve {k}: is a surface from a file; OpenFOAM's plug-in takes only the kinds {', '.join(KINDS)}")
        lines += [state.name, "{", "    type riisValve;", '    libs ("libriisFvOption.so");', "",
                  f"    rho {density!r};                  // [kg/m3]",
                  f"    resistance {state.resistance!r};  // [kg/(m s)]",
                  f"    halfThickness {metres * state.half_thickness!r};  // [m]"]
        lines += ([f"    offset {state.offset!r};"] if state.offset != 0.0 else []) + [""]
        lines += ["    valve", "    {", f"        kind {state.kind};"]
        lines += [f"        {name} {_foam(value) if isinstance(value, tuple) else repr(value)};"
                  for name, value in state.parameters.items()]
        lines += ["    }", "    placement", "    {", f"        scale {metres * state.scale!r};",
                  f"        rotationAxis {_foam(state.rotation[:3])};", f"        rotationAngle {state.rotation[3]!r};",
                  f"        translation {_foam(metres * x for x in state.origin)};", "    }"]
        lines += _foam_warp(state, metres)
        if state.skirt > 0.0:  # the wall is a patch of the mesh
            lines += ["    skirt", "    {", "        patch wall;", f"        longest {metres * state.skirt!r};", "    }"]
        lines += ["    opening", "    {"]
        lines += [f"        {line}" for line in _foam_law(state)] + ["    }", "}", ""]
    return "\n".join(lines)
