# SPDX-License-Identifier: Apache-2.0
"""Landmarks of the view: their names for each kind of valve, and their files (docs/formats.md, "Landmarks").

The program's own sources read the files, so the view refuses the same files.
"""

from __future__ import annotations

import json
import os
import re
from collections.abc import Mapping
from functools import lru_cache
from pathlib import Path
from types import MappingProxyType
from typing import Any, Literal, NamedTuple

import numpy
from numpy.typing import NDArray

from riis._riis import read_landmarks
from riis.view._valves import Vector, check_kind, has_cusps, n_leaflets, refuse, vector

Reals = NDArray[numpy.float64]
Axes = Literal["LPS", "RAS", "mesh"]

AXES: tuple[Axes, ...] = ("LPS", "RAS", "mesh")
FLOW = ("flow_from", "flow_to")
_CUSPS = ("right", "left", "non_coronary")
_TRICUSPID = ("anterior", "septal", "posterior")
_FEWEST = {"annulus": 4, "hinge": 2}
_FEWEST_OF_CIRCLE = 3  # points of the annulus of a bileaflet valve


class Role(NamedTuple):
    """A landmark that a kind of valve can have."""

    name: str  #: as in a file; of a list, such as annulus, without the number
    text: str  #: the place that it marks
    is_needed: bool  #: whether place always needs it
    is_list: bool = False  #: whether there may be several, with numbers: annulus_1, annulus_2 and so on


class LandmarkSet(NamedTuple):
    """Landmarks in the mesh's unit, and the other statements of their file."""

    points: Mapping[str, Vector] = MappingProxyType({})
    axes: Axes | None = None  #: of the mesh and the wall. None: nobody has said them yet
    noise: float | None = None  #: standard deviation of a coordinate, in the mesh's unit
    parameters: Mapping[str, Any] = MappingProxyType({})  #: sizes that are known, centimetres


@lru_cache(maxsize=None)
def roles_of(kind: str) -> tuple[Role, ...]:
    """Returns the landmarks of a kind, in the order in which a person sets them."""
    check_kind(kind)
    if kind == "bileaflet":
        return (
            Role("annulus", "a point of the housing's circle at mid-height", True, True),
            Role("hinge", "an end of a leaflet's hinge line: both of one leaflet, or all four", True, True),
            *_flow(True),
        )
    if kind == "tricuspid":
        between = [(_TRICUSPID[k], _TRICUSPID[(k + 1) % 3]) for k in range(3)]
        return (
            *(Role(f"commissure_{a}_{b}", f"the annulus between the {a} and the {b} leaflet", True) for a, b in between),
            Role("annulus", "a point of the annulus, in the order around it", True, True), *_flow(False),
        )  # fmt: skip
    if not has_cusps(kind):
        trigones = [Role(f"trigone_{k}", "a fibrous trigone, beside the anterior leaflet", False) for k in (1, 2)]
        return (
            Role("anterior_horn", "the annulus at the middle of the anterior leaflet", kind == "mitral"),
            Role("posterior_horn", "the annulus at the middle of the posterior leaflet", False),
            Role("anterolateral_commissure", "the annulus at the commissure of the lateral side", False),
            Role("posteromedial_commissure", "the annulus at the commissure of the medial side", False),
            *(trigones if kind == "mitral" else []),
            Role("annulus", "a point of the annulus, in the order around it", True, True), *_flow(False),
        )  # fmt: skip
    n = n_leaflets(kind)
    cusps = _CUSPS if n == 3 else tuple(f"cusp_{k}" for k in range(n))
    if n == 2:
        commissures = [("commissure_1", "one end of both attachments"), ("commissure_2", "the other end of both attachments")]
    else:
        pairs = [(cusps[k], cusps[(k + 1) % n]) for k in range(n)]
        commissures = [(f"commissure_{a}_{b}", f"the top of the attachment between {_said(a)} and {_said(b)}") for a, b in pairs]
    return (
        *(Role(f"nadir_{cusp}", f"the lowest point of the attachment of {_said(cusp)}", True) for cusp in cusps),
        *(Role(name, text, True) for name, text in commissures),
        Role("coaptation", "where the closed cusps meet; it gives the axis", False),
        *(Role(f"attachment_{cusp}", f"a point of the attachment of {_said(cusp)}, for a warp", False, True) for cusp in cusps),
    )  # fmt: skip


def _said(cusp: str) -> str:
    return cusp.replace("_", " ") if cusp.startswith("cusp") else f"the {cusp.replace('_', '-')} cusp"


def _flow(is_needed: bool) -> list[Role]:
    return [
        Role("flow_from", "any point upstream, so that the flow goes from here", is_needed),
        Role("flow_to", "any point downstream, so that the flow goes here", is_needed),
    ]


def canonical(name: str, kind: str | None = None) -> str:
    """Returns a landmark's name as roles_of gives it, for a name of a file such as "Nadir-Left" or "commissure_left_right"."""
    text = re.sub("[ -]", "_", name.strip()).lower()
    text = re.sub("(?<=_)non(?=_|$)(?!_coronary)", "non_coronary", text)
    if kind is None or not text.startswith("commissure_"):
        return text
    for role in roles_of(kind):
        if role.name.startswith("commissure_") and text != role.name:
            first, second = _leaflets_of(role.name, kind)
            if text == f"commissure_{second}_{first}":
                return role.name
    return text


def _leaflets_of(name: str, kind: str) -> tuple[str, str]:
    rest = name.removeprefix("commissure_")
    words = _TRICUSPID if kind == "tricuspid" else _CUSPS if n_leaflets(kind) == 3 else tuple(f"cusp_{k}" for k in range(4))
    for word in words:
        if rest.startswith(word + "_"):
            return word, rest.removeprefix(word + "_")
    return rest, ""


def role_of(name: str, kind: str) -> Role | None:
    """Returns the role of a landmark, or None if the kind has no such landmark."""
    for role in roles_of(kind):
        if name == role.name or (role.is_list and re.fullmatch(re.escape(role.name) + "(_[0-9]+)?", name)):
            return role
    return None


def next_name(role: Role, points: Mapping[str, Any]) -> str:
    """Returns the name under which the next landmark of a role is set."""
    if not role.is_list:
        return role.name
    return next(name for k in range(1, len(points) + 2) if (name := f"{role.name}_{k}") not in points)


def missing(kind: str, points: Mapping[str, Any]) -> list[str]:
    """Returns the names of the landmarks that riis.place still needs."""
    names: list[str] = []
    for role in roles_of(kind):
        if role.is_needed and not role.is_list and role.name not in points:
            names.append(role.name)
        if role.is_needed and role.is_list:
            there = sum(role_of(name, kind) == role for name in points)
            is_circle = kind == "bileaflet" and role.name == "annulus"
            names += [f"{role.name}_{k + 1}" for k in range(there, _FEWEST_OF_CIRCLE if is_circle else _FEWEST[role.name])]
    return names


# ---- Files ----


class ReadLandmarks(NamedTuple):
    landmarks: LandmarkSet
    unit: str  #: of the landmarks
    kind: str  #: of the valve; "": the file does not say


def read_file(path: str | os.PathLike[str], unit: str | None, axes: str | None) -> ReadLandmarks:
    """Reads a file of landmarks. unit and axes belong to the mesh. By default, those of the file apply."""
    name = os.fspath(path)
    turned = axes if axes in ("LPS", "RAS") else None
    found = read_landmarks(name, Path(path).read_text("utf-8-sig", "replace"), unit, turned)
    points: dict[str, Vector] = {}
    kind = found["valve"] or None
    for given, point in zip(found["names"], found["points"]):
        own = canonical(given, kind)
        if own in points:  # a file may name several points annulus
            own = next(other for k in range(1, len(points) + 2) if (other := f"{own}_{k}") not in points)
        points[own] = vector(point)
    ends = found["flow_ends"]
    if len(ends) == 0 and found["flow"] is not None:  # a direction becomes two points, which can be seen and moved
        middle = numpy.mean(found["points"], axis=0)
        reach = float(numpy.linalg.norm(found["points"] - middle, axis=1).max())
        half = reach * found["flow"] / numpy.linalg.norm(found["flow"])
        ends = numpy.array([middle - half, middle + half])
    for own, point in zip(FLOW, ends):
        points[own] = vector(point)
    parameters = {
        f"{part}.{size}" if size else part: value for part, inner in json.loads(found["parameters"]).items()
        for size, value in (inner.items() if isinstance(inner, dict) else (("", inner),))
    }  # fmt: skip
    made = LandmarkSet(MappingProxyType(points), found["axes"], found["noise"], MappingProxyType(parameters))
    return ReadLandmarks(made, found["unit"], found["valve"])


def text_of(landmarks: LandmarkSet, path: str | os.PathLike[str], unit: str | None, kind: str | None) -> str:
    """Returns the content of a file of landmarks, in the format of its ending: .mrk.json of 3D Slicer, or .json."""
    name = os.fspath(path)
    if unit is None:
        raise refuse("unit: is None; a file of landmarks states the unit, so choose the unit of the mesh first")
    if not landmarks.points:
        raise refuse("landmarks: there are none to save; pick them on the wall first")
    points = {name: list(point) for name, point in landmarks.points.items()}
    if name.endswith(".mrk.json"):
        if landmarks.axes not in ("LPS", "RAS"):
            raise refuse(
                f"axes: are {landmarks.axes}; 3D Slicer's files have LPS or RAS, so choose the axes of the wall, or save a .json"
            )
        return json.dumps(_slicer(points, unit, landmarks.axes), indent=2) + "\n"
    if not name.endswith(".json"):
        raise refuse(f"path: {name!r} must end in .mrk.json or .json")
    root: dict[str, Any] = {} if kind is None else {"valve": kind}
    root |= {"unit": unit, "axes": landmarks.axes or "mesh"}
    if landmarks.noise is not None:
        root["noise"] = landmarks.noise
    if landmarks.parameters:
        root["parameters"] = nested(landmarks.parameters)
    root["landmarks"] = points
    return json.dumps(root, indent=2) + "\n"


def nested(parameters: Mapping[str, Any]) -> dict[str, Any]:
    """Returns parameters as files have them, with an object for each leaflet and the like."""
    made: dict[str, Any] = {}
    for name, value in parameters.items():
        *part, last = name.split(".")
        (made.setdefault(part[0], {}) if part else made)[last] = list(value) if isinstance(value, tuple) else value
    return made


def _slicer(points: Mapping[str, list[float]], unit: str, axes: str) -> dict[str, Any]:
    turn = [-1.0, 0.0, 0.0, 0.0, -1.0, 0.0, 0.0, 0.0, 1.0] if axes == "LPS" else [1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0]
    schema = "https://raw.githubusercontent.com/slicer/slicer/master/Modules/Loadable/Markups/Resources/Schema/"
    return {
        "@schema": schema + "markups-schema-v1.0.3.json#",
        "markups": [{
            "type": "Fiducial", "coordinateSystem": axes, "coordinateUnits": unit, "locked": False, "fixedNumberOfControlPoints":
            False, "labelFormat": "%N-%d", "lastUsedControlPointNumber": len(points),
            "controlPoints": [
                {"id": str(k + 1), "label": name, "description": "", "associatedNodeID": "", "position": point, "orientation":
                 turn, "selected": True, "locked": False, "visibility": True, "positionStatus": "defined"}
                for k, (name, point) in enumerate(points.items())
            ],
        }],
    }  # fmt: skip
