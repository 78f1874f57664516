# SPDX-License-Identifier: Apache-2.0
"""The view's files: a case of the program riis, a command, a script, OpenFOAM's dictionary, and the session.

Numbers are written with all their digits, so each file gives the same marks, to the last bit.
"""

from __future__ import annotations

import base64
import json
import math
import os
import shlex
import zlib
from collections.abc import Iterable, Mapping
from types import MappingProxyType
from typing import Any

import numpy

from riis._errors import Error, InvalidArgumentError
from riis._place import UNITS
from riis._riis import resistance_units
from riis.laws import OpeningTable, OpeningTimes
from riis.view._domains import OPTION
from riis.view._valves import (
    KINDS, SURFACE, TRIANGULATIONS, Cycle, SurfaceSource, Value, ValveState, above_zero, at_least_zero, check_valve_name,
    number, refuse, share,
)

_FORMAT, _VERSION = "riis view", 1


def has_unit(states: Iterable[ValveState], unit: str | None) -> bool:
    """Returns whether the unit gives the scale of all valves. If so, files may state the unit."""
    return unit is not None and all(state.scale == UNITS[unit] for state in states)


def _resistance(state: ValveState, unit: str | None) -> float:
    """Returns R in the units of the mesh. The state has it in kg/(m s) if the mesh has a unit."""
    return state.resistance if unit is None else state.resistance * resistance_units(unit)[0]


def _check_paths(states: Iterable[ValveState]) -> None:
    for k, state in enumerate(states):
        if state.surface is not None and state.surface.path is None:
            raise refuse(f"valve {k}: its surface has no file, so no other program can read it; add it with a path")


def _nested(parameters: Mapping[str, Value]) -> dict[str, Any]:
    made: dict[str, Any] = {}
    for name, value in parameters.items():
        *part, last = name.split(".")
        (made.setdefault(part[0], {}) if part else made)[last] = list(value) if isinstance(value, tuple) else value
    return made


def _law(law: OpeningTable | OpeningTimes) -> dict[str, Any]:
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


def case_of(
    states: tuple[ValveState, ...], unit: str | None, path: str | None, cells_where: str | None, times: list[float] | None
) -> str:
    """Returns a case. Without times the valves keep their openings, and surfaces keep their time."""
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
            valve["parameters"] = _nested(state.parameters)
            valve["opening"] = state.opening if stays or state.cycle is None else _law(state.cycle.law)
            if state.triangulation != "adapted":
                valve["triangulation"] = state.triangulation
        if not with_unit:
            valve["scale"] = state.scale
        valve["rotate"] = list(state.rotation)
        valve["translate"] = list(state.origin)
        valve["half_thickness"] = state.half_thickness
        if state.offset != 0.0:
            valve["offset"] = state.offset
        valve["resistance"] = state.resistance if with_unit else _resistance(state, unit)
        root["valves"].append(valve)
    return json.dumps(root, indent=2) + "\n"


def _numbers(values: Iterable[float]) -> str:
    return ",".join(repr(float(value)) for value in values)


def command_of(
    states: tuple[ValveState, ...], unit: str | None, path: str | None, cells_where: str | None, case: str, output: str,
    program: str,
) -> str:
    _check_paths(states)
    if not states:
        raise refuse("valves: there are none; a command needs one")
    state = states[0]
    if len(states) > 1:
        if _times_of_surfaces(states) is not None:  # the case has times, so the program writes a series
            output = os.path.splitext(output)[0] + ".pvd"
        return shlex.join([program, "mark", "--case", case, "--output", output])
    words = [program, "mark", os.path.abspath(path) if path is not None else "MESH.vtu"]
    if cells_where is not None:
        words.append(f"{OPTION}={cells_where}")
    with_unit = has_unit(states, unit)
    if state.surface is not None:
        words.append(f"--surface={os.path.abspath(str(state.surface.path))}")
        if state.surface.moves:
            words.append(f"--time={state.time!r}")
            if state.surface.period > 0.0:
                words.append(f"--period={state.surface.period!r}")
        if with_unit:
            words.append("--surface-unit=cm")
    else:
        words.append(f"--valve={state.kind}")
        for name, value in state.parameters.items():
            words.append(f"--set={name}={_numbers(value if isinstance(value, tuple) else (value,))}")
        words.append(f"--opening={state.opening!r}")
        if state.triangulation != "adapted":
            words.append(f"--triangulation={state.triangulation}")
    words.append(f"--unit={unit}" if with_unit else f"--scale={state.scale!r}")
    words += [f"--rotate={_numbers(state.rotation)}", f"--translate={_numbers(state.origin)}"]
    resistance = state.resistance if with_unit else _resistance(state, unit)  # without --unit it is in the mesh's units
    words.append(f"--half-thickness={state.half_thickness!r}")
    if state.offset != 0.0:
        words.append(f"--offset={state.offset!r}")
    words += [f"--resistance={resistance!r}", f"--output={output}"]
    return shlex.join(words)


# ---- Python ----


def _units_of_K(unit: str | None) -> str:
    if unit is None:
        return "  # in the units of the mesh, as R is"
    _, of_R, of_K = resistance_units(unit)
    return f"  # in {of_K}, with R in {of_R}"


def python_of(states: tuple[ValveState, ...], unit: str | None, path: str | None, cells_where: str | None) -> str:
    _check_paths(states)
    reads_part = path is not None and cells_where is not None
    uses_files = (path is not None and not reads_part) or any(state.surface is not None for state in states)
    lines = ["import numpy"] + (["import pyvista"] if uses_files else []) + ["import riis"]
    lines += ["from riis.view import reading", ""] if reads_part else [""]
    if path is None:
        lines.append("# points: (n, 3) float64, the nodes of the mesh")
    elif reads_part:
        lines.append(f"grid = reading.read_mesh({os.path.abspath(path)!r}, cells_where={cells_where!r})")
        lines.append("points = numpy.array(grid.points, numpy.float64)")
    else:
        lines.append(f"points = numpy.array(pyvista.read({os.path.abspath(path)!r}).points, numpy.float64)")
    lines += ["mesh = riis.Mesh(points)", "K = numpy.zeros(len(mesh))" + _units_of_K(unit), "marks = {}"]
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
            lines.append(f"surface = riis.Surface(valve, {options})")
        else:
            lines += _python_of_surface(state, options)
        lines.append(f"marks[{state.name!r}] = riis.mark(surface, mesh)")
        lines.append(f"marks[{state.name!r}].add_resistance(K, R={_resistance(state, unit)!r})")
    return "\n".join(lines) + "\n"


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
                  f"        translation {_foam(metres * x for x in state.origin)};", "    }", "    opening", "    {"]
        lines += [f"        {line}" for line in _foam_law(state)] + ["    }", "}", ""]
    return "\n".join(lines)


# ---- Sessions ----


def _packed(array: Any) -> dict[str, Any]:
    array = numpy.ascontiguousarray(array)
    data = base64.b64encode(zlib.compress(array.tobytes())).decode("ascii")
    return {"type": array.dtype.str, "shape": list(array.shape), "zlib": data}


def _unpacked(value: Any) -> Any:
    data = zlib.decompress(base64.b64decode(value["zlib"]))
    return numpy.frombuffer(data, numpy.dtype(value["type"])).reshape(value["shape"]).copy()


def session_of(
    states: tuple[ValveState, ...], unit: str | None, path: str | None, cells_where: str | None, n_nodes: int, time: float,
    page: Mapping[str, Any] | None,
) -> str:
    valves = []
    for state in states:
        valve: dict[str, Any] = {
            "name": state.name, "kind": state.kind, "parameters": _nested(state.parameters), "opening": state.opening,
            "half_thickness": state.half_thickness, "resistance": state.resistance, "scale": state.scale,
            "rotate": list(state.rotation), "origin": list(state.origin), "triangulation": state.triangulation,
            "time": state.time, "offset": state.offset,
        }
        if state.cycle is not None:
            valve["cycle"] = {"source": state.cycle.source, "period": state.cycle.period, "law": _law(state.cycle.law)}
        if state.surface is not None:
            source = state.surface
            valve["surface"] = {
                "path": source.path, "period": source.period,
                "vertices": _packed(source.vertices), "faces": _packed(source.faces),
                "leaflet_id": None if source.leaflet_id is None else _packed(source.leaflet_id),
                "times": None if source.times is None else _packed(source.times),
            }
        valves.append(valve)
    root: dict[str, Any] = {
        "format": _FORMAT, "version": _VERSION, "mesh": path, "n_nodes": n_nodes, "unit": unit, "time": time, "valves": valves,
    }
    if cells_where is not None:
        root["cells_where"] = cells_where
    if page is not None:
        root["page"] = page
    return json.dumps(root, indent=2) + "\n"


def _law_from(values: Mapping[str, Any]) -> OpeningTable | OpeningTimes:
    if "times" in values:
        return OpeningTable(
            numpy.array(values["times"], numpy.float64), numpy.array(values["openings"], numpy.float64),
            float(values.get("period", 0.0)), values["interpolation"],
        )
    return OpeningTimes(**{key: float(value) for key, value in values.items()})


def _state_from(value: Mapping[str, Any]) -> ValveState:
    parameters: dict[str, Value] = {}
    for name, inner in value["parameters"].items():
        for part, size in (inner.items() if isinstance(inner, dict) else (("", inner),)):
            full = f"{name}.{part}" if part else name
            parameters[full] = tuple(float(x) for x in size) if isinstance(size, list) else float(size)
    cycle, surface = value.get("cycle"), value.get("surface")
    if cycle is not None and not isinstance(cycle["source"], str):
        raise ValueError(f"source of the cycle is {cycle['source']!r}")
    if value["kind"] not in (*KINDS, SURFACE) or (value["kind"] == SURFACE) != (surface is not None):
        raise ValueError(f"kind is {value['kind']!r}")
    if value["triangulation"] not in TRIANGULATIONS:
        raise ValueError(f"triangulation is {value['triangulation']!r}")
    axis_x, axis_y, axis_z, angle = (float(x) for x in value["rotate"])
    x, y, z = (float(part) for part in value["origin"])
    return ValveState(
        name=check_valve_name(value["name"]), kind=value["kind"], opening=share(value["opening"], "opening"),
        half_thickness=above_zero(value["half_thickness"], "half_thickness"),
        resistance=at_least_zero(value["resistance"], "resistance"), scale=above_zero(value["scale"], "scale"),
        rotation=(axis_x, axis_y, axis_z, angle), origin=(x, y, z), parameters=MappingProxyType(parameters),
        triangulation=value["triangulation"], time=number(value["time"], "time"),
        offset=number(value.get("offset", 0.0), "offset"),  # sessions of earlier versions have none
        cycle=None if cycle is None else Cycle(cycle["source"], _law_from(cycle["law"]), above_zero(cycle["period"], "period")),
        surface=None if surface is None else SurfaceSource(
            _unpacked(surface["vertices"]), _unpacked(surface["faces"]),
            None if surface["leaflet_id"] is None else _unpacked(surface["leaflet_id"]),
            None if surface["times"] is None else _unpacked(surface["times"]), float(surface["period"]), surface["path"],
        ),
    )


def read_session(path: str) -> tuple[dict[str, Any], tuple[ValveState, ...]]:
    """Reads a session. Returns the file's root and its valves. The valves' values are checked by making their surfaces."""
    try:
        with open(path, encoding="utf-8") as file:
            root = json.load(file)
    except (OSError, ValueError, RecursionError) as error:
        raise refuse(f"path: {path!r} cannot be read as a session: {error}") from None
    if not isinstance(root, dict) or root.get("format") != _FORMAT:
        raise refuse(f"path: {path!r} is not a session of the view")
    if root.get("version") != _VERSION:
        raise refuse(f"path: {path!r} has the version {root.get('version')!r}; this release reads {_VERSION}")
    try:
        if root["mesh"] is not None and not isinstance(root["mesh"], str):
            raise ValueError(f"mesh is {root['mesh']!r}")
        if not isinstance(root.setdefault("cells_where", None), (str, type(None))):
            raise ValueError(f"cells_where is {root['cells_where']!r}")
        if root["unit"] is not None and root["unit"] not in UNITS:
            raise ValueError(f"unit is {root['unit']!r}")
        root["time"], root["n_nodes"] = number(root["time"], "time"), int(root["n_nodes"])
        states = tuple(_state_from(value) for value in root["valves"])
        names = [state.name for state in states]
        if len(set(names)) < len(names):
            raise ValueError(f"the names of the valves are {', '.join(names)}; they must differ")
        if not isinstance(root.setdefault("page", {}), dict):
            raise ValueError(f"page is {root['page']!r}")
    except Error as error:
        raise type(error)(f"path: {path!r} is damaged: {error}") from None
    except (AttributeError, KeyError, TypeError, ValueError, zlib.error) as error:
        raise InvalidArgumentError(f"path: {path!r} is damaged: {type(error).__name__} {error}") from None
    return root, states
