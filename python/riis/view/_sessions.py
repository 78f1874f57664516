# SPDX-License-Identifier: Apache-2.0
"""The session of the view: a file that holds all that a model has, with all digits of its numbers."""

from __future__ import annotations

import base64
import json
import zlib
from collections.abc import Mapping
from types import MappingProxyType
from typing import Any

import numpy

from riis._errors import Error, InvalidArgumentError
from riis._place import UNITS
from riis.laws import OpeningTable, OpeningTimes
from riis.view._landmark_files import AXES, LandmarkSet, nested
from riis.view._outputs import Facts, law_values
from riis.view._valves import (
    KINDS, SURFACE, TRIANGULATIONS, Cycle, PlacedSource, SurfaceSource, Value, ValveState, WarpState, above_zero, at_least_zero,
    check_valve_name, number, refuse, share, vector,
)
from riis.view._walls import Wall

_FORMAT, _VERSION = "riis view", 2
_OLDEST = 1  # without walls, landmarks and warps


def _packed(array: Any) -> dict[str, Any]:
    array = numpy.ascontiguousarray(array)
    data = base64.b64encode(zlib.compress(array.tobytes())).decode("ascii")
    return {"type": array.dtype.str, "shape": list(array.shape), "zlib": data}


def _unpacked(value: Any) -> Any:
    data = zlib.decompress(base64.b64decode(value["zlib"]))
    return numpy.frombuffer(data, numpy.dtype(value["type"])).reshape(value["shape"]).copy()


def _warp_in_session(warp: WarpState | None) -> dict[str, Any] | None:
    if warp is None:
        return None
    sources, targets = _packed(warp.sources), _packed(warp.targets)
    return {"sources": sources, "targets": targets, "noise": warp.noise, "is_in_mesh": warp.is_in_mesh}


def _placed_in_session(source: PlacedSource, state: ValveState) -> dict[str, Any]:
    made = {
        "path": source.path, "kind": source.kind, "unit": source.unit, "parameters": nested(source.parameters),
        "rotate": list(source.rotation), "origin": list(source.origin),
    }  # fmt: skip
    return made | {"warp": "same" if source.warp is state.warp else _warp_in_session(source.warp)}


def session_of(
    states: tuple[ValveState, ...], facts: Facts, n_nodes: int, time: float, landmarks: LandmarkSet,
    page: Mapping[str, Any] | None,
) -> str:
    valves = []
    for state in states:
        valve: dict[str, Any] = {
            "name": state.name, "kind": state.kind, "parameters": nested(state.parameters), "opening": state.opening,
            "half_thickness": state.half_thickness, "resistance": state.resistance, "scale": state.scale,
            "rotate": list(state.rotation), "origin": list(state.origin), "triangulation": state.triangulation,
            "time": state.time, "offset": state.offset,
        }
        if state.warp is not None:
            valve["warp"] = _warp_in_session(state.warp)
        if state.skirt > 0.0:
            valve["skirt"] = state.skirt
        if state.placed is not None:
            valve["placed"] = _placed_in_session(state.placed, state)
        if state.cycle is not None:
            valve["cycle"] = {"source": state.cycle.source, "period": state.cycle.period, "law": law_values(state.cycle.law)}
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
        "format": _FORMAT, "version": _VERSION, "mesh": facts.path, "n_nodes": n_nodes, "unit": facts.unit, "time": time,
        "valves": valves,
    }
    if facts.cells_where is not None:
        root["cells_where"] = facts.cells_where
    wall = facts.wall
    if wall is not None:
        root["wall"] = {"path": wall.path, "points": _packed(wall.points), "triangles": _packed(wall.triangles)}
    if landmarks != LandmarkSet():
        root["landmarks"] = {
            "axes": landmarks.axes, "noise": landmarks.noise, "parameters": nested(landmarks.parameters),
            "points": {name: list(at) for name, at in landmarks.points.items()},
        }  # fmt: skip
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


def _parameters_from(values: Mapping[str, Any]) -> MappingProxyType[str, Value]:
    parameters: dict[str, Value] = {}
    for name, inner in values.items():
        for part, size in (inner.items() if isinstance(inner, dict) else (("", inner),)):
            full = f"{name}.{part}" if part else name
            parameters[full] = tuple(float(x) for x in size) if isinstance(size, list) else float(size)
    return MappingProxyType(parameters)


def _rotation_from(values: Any) -> tuple[float, float, float, float]:
    x, y, z, angle = (float(part) for part in values)
    return x, y, z, angle


def _warp_from(value: Any) -> WarpState | None:
    if value is None:
        return None
    sources, targets = _unpacked(value["sources"]), _unpacked(value["targets"])
    return WarpState(sources, targets, at_least_zero(value["noise"], "noise"), bool(value["is_in_mesh"]))


def _placed_from(value: Mapping[str, Any], warp: WarpState | None) -> PlacedSource:
    if value["kind"] not in KINDS or value["unit"] not in UNITS or not isinstance(value["path"], str):
        raise ValueError(f"placed is {value['path']!r}, {value['kind']!r}, {value['unit']!r}")
    return PlacedSource(
        value["path"], value["kind"], value["unit"], _parameters_from(value["parameters"]), _rotation_from(value["rotate"]),
        vector(value["origin"]), warp if value["warp"] == "same" else _warp_from(value["warp"]),
    )  # fmt: skip


def _wall_from(value: Any) -> Wall | None:
    return None if value is None else Wall(_unpacked(value["points"]), _unpacked(value["triangles"]), value["path"])


def _landmarks_from(value: Any) -> LandmarkSet:
    if value is None:
        return LandmarkSet()
    if value["axes"] not in (*AXES, None):
        raise ValueError(f"axes are {value['axes']!r}")
    points = MappingProxyType({name: vector(at) for name, at in value["points"].items()})
    noise = None if value["noise"] is None else at_least_zero(value["noise"], "noise")
    return LandmarkSet(points, value["axes"], noise, _parameters_from(value["parameters"]))


def _state_from(value: Mapping[str, Any]) -> ValveState:
    warp = _warp_from(value.get("warp"))
    cycle, surface = value.get("cycle"), value.get("surface")
    if cycle is not None and not isinstance(cycle["source"], str):
        raise ValueError(f"source of the cycle is {cycle['source']!r}")
    if value["kind"] not in (*KINDS, SURFACE) or (value["kind"] == SURFACE) != (surface is not None):
        raise ValueError(f"kind is {value['kind']!r}")
    if value["triangulation"] not in TRIANGULATIONS:
        raise ValueError(f"triangulation is {value['triangulation']!r}")
    return ValveState(
        name=check_valve_name(value["name"]), kind=value["kind"], opening=share(value["opening"], "opening"),
        half_thickness=above_zero(value["half_thickness"], "half_thickness"),
        resistance=at_least_zero(value["resistance"], "resistance"), scale=above_zero(value["scale"], "scale"),
        rotation=_rotation_from(value["rotate"]), origin=vector(value["origin"]),
        parameters=_parameters_from(value["parameters"]), warp=warp, skirt=at_least_zero(value.get("skirt", 0.0), "skirt"),
        placed=None if value.get("placed") is None else _placed_from(value["placed"], warp),
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
    if root.get("version") not in range(_OLDEST, _VERSION + 1):
        raise refuse(f"path: {path!r} has the version {root.get('version')!r}; this release reads {_OLDEST} to {_VERSION}")
    try:
        if root["mesh"] is not None and not isinstance(root["mesh"], str):
            raise ValueError(f"mesh is {root['mesh']!r}")
        if not isinstance(root.setdefault("cells_where", None), (str, type(None))):
            raise ValueError(f"cells_where is {root['cells_where']!r}")
        if root["unit"] is not None and root["unit"] not in UNITS:
            raise ValueError(f"unit is {root['unit']!r}")
        root["time"], root["n_nodes"] = number(root["time"], "time"), int(root["n_nodes"])
        root["wall"], root["landmarks"] = _wall_from(root.get("wall")), _landmarks_from(root.get("landmarks"))
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
