# SPDX-License-Identifier: Apache-2.0
"""A valve's sizes and placement from a patient's landmarks: names and files of landmarks (docs/formats.md), and the result."""

from __future__ import annotations

import json
import math
import os
import re
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, Literal

import numpy
from numpy.typing import NDArray

from riis._errors import Error, InvalidArgumentError, InvalidParameterError
from riis._riis import Surface, Valve, Warp, place_landmarks

Reals = NDArray[numpy.float64]

_CUSPS = {"right": 0, "left": 1, "non_coronary": 2, "non": 2}
# The words for roles, in the order of RIIS_LANDMARK_*, and whether a valve may have several landmarks with the same name.
_ROLES = {
    "commissure": True,
    "nadir": True,
    "coaptation": False,
    "annulus": True,
    "anterior_horn": False,
    "posterior_horn": False,
    "trigone": True,
    "posteromedial_commissure": False,
    "anterolateral_commissure": False,
    "hinge": True,
    "attachment": True,
}
_ATTACHMENT = list(_ROLES).index("attachment")
_SCALES = {"mm": 10.0, "cm": 1.0, "m": 0.01}
_AXES = ("LPS", "RAS", "mesh")
_WHY_AXES = "; LPS and RAS differ by half a turn about z, which the landmarks themselves cannot show"
_SOURCES = ("kept", "determined", "proportion", "undetermined")  # in the order of RIIS_SIZE_*


@dataclass(frozen=True)
class PlaceResult:
    """A placed valve. Its surface is Surface(result.valve, **result.placement). Lengths of the placement, residuals, noise and
    position_error have the unit of the landmarks; parameters are in centimetres."""

    valve: Valve
    placement: dict[str, Any]  #: scale, rotation_axis, rotation_angle (degrees) and translation
    unit: str  #: "mm", "cm" or "m", of the landmarks and of the placement
    axes: str  #: "LPS", "RAS" or "mesh"
    names: tuple[str, ...]  #: of the landmarks
    residuals: Reals  #: (n_landmarks,), the distances from the landmarks to their places on the valve
    rms: float  #: root mean square of the residuals
    worst: float  #: the largest residual
    worst_landmark: str  #: its landmark
    noise: float  #: for the standard errors: the landmarks' noise, or more if the residuals show it
    rotation_error: float  #: standard error of the rotation, degrees
    position_error: float  #: standard error of the place of the valve's origin
    standard_errors: dict[str, float]  #: of the parameters that the landmarks bear on
    determined: tuple[str, ...]  #: parameters from the landmarks
    undetermined: tuple[str, ...]  #: parameters that landmarks bear on but do not determine
    in_proportion: tuple[str, ...]  #: parameters that follow from others, by the valve's proportions
    points: Reals = field(repr=False)  #: (n_landmarks, 3)
    places: Reals = field(repr=False)  #: (n_landmarks, 3), the landmarks' places on the closed valve before a warp
    warp: Warp | None = field(default=None, repr=False)  #: the valve's warp, which takes the places to the points
    warp_noise: float = 0.0  #: by which the warp is smoothed
    warped_residuals: Reals | None = None  #: (n_landmarks,), the distances from the landmarks to their warped places

    def report(self) -> str:
        """Returns a table of the parameters with their standard errors, followed by the residuals."""
        table = self.valve.parameters
        lines = [f"{'parameter':32} {'value':>10} {'std. error':>10}  from"]
        words = {"determined": "landmarks", "undetermined": "landmarks and proportion: NOT DETERMINED"}
        for source in words:
            for name in getattr(self, source):
                unit = "cm" if table[name].unit == "length" else table[name].unit.replace("1", "")
                error = self.standard_errors[name]
                lines.append(f"{name:32} {self.valve[name]:10.4g} {error:10.2g}  {words[source]} {unit}".rstrip())
        lines.append("in proportion: " + ", ".join(self.in_proportion))
        for key, value in self.placement.items():
            lines.append(f"{key:32} " + " ".join(f"{number:.4f}" for number in numpy.atleast_1d(value)))
        for number, (name, residual) in enumerate(zip(self.names, self.residuals, strict=True)):
            warped = "" if self.warped_residuals is None else f", warped {self.warped_residuals[number]:.3g}"
            lines.append(f"{name:32} residual {residual:.3g}{warped} {self.unit}")
        lines.append(f"rms {self.rms:.3g}, worst {self.worst:.3g} {self.unit} at {self.worst_landmark}")
        return "\n".join(lines)

    def save(self, path: str | os.PathLike[str]) -> None:
        """Writes the file of a placed valve, which each command of the program riis takes as --valve FILE.json."""
        at = self.placement
        parameters: dict[str, Any] = {}
        for name in self.valve.parameters:
            if name != "opening":
                *part, last = name.split(".")
                value = self.valve[name]
                (parameters.setdefault(part[0], {}) if part else parameters)[last] = (
                    value.tolist() if isinstance(value, numpy.ndarray) else value
                )
        content = {
            "valve": self.valve.kind,
            "unit": self.unit,
            "axes": self.axes,
            "rotate": [*at["rotation_axis"], at["rotation_angle"]],
            "translate": list(at["translation"]),
            "parameters": parameters,
        }
        if self.warp is not None:
            content["warp"] = {"sources": self.places.tolist(), "targets": self.points.tolist(), "noise": self.warp_noise}
        Path(path).write_text(json.dumps(content, indent=2) + "\n")


def _refuse(where: str, reason: str) -> InvalidArgumentError:
    return InvalidArgumentError(f"{where}: {reason}")


def _place_of(name: str) -> tuple[int, tuple[int, int], bool] | None:
    """Returns the role of a name, its leaflets, and whether other landmarks may have the same name."""
    text = re.sub(r"[ -]", "_", name.lower())
    for role, (word, is_repeated) in enumerate(_ROLES.items()):
        if text == word:
            return role, (-1, -1), is_repeated
        rest = text.removeprefix(word + "_")
        if rest == text:
            continue
        if re.fullmatch("[0-9]+", rest) and is_repeated:
            return role, (-1, -1), False
        cusp = re.fullmatch("(right|left|non_coronary|non)(_[0-9]+)?", rest)
        if word == "attachment":
            if cusp:
                return role, (_CUSPS[cusp[1]], -1), cusp[2] is None
            continue
        found = re.fullmatch("(right|left|non_coronary|non)(?:_(right|left|non_coronary|non))?", rest)
        if not found:
            continue
        cusps = [_CUSPS[cusp] for cusp in found.groups() if cusp]
        if word == "nadir" and len(cusps) == 1:
            return role, (cusps[0], -1), False
        if word == "commissure" and len(cusps) == 2 and cusps[0] != cusps[1]:
            return role, (cusps[0], cusps[1]), False
    return None


@dataclass
class _Landmarks:
    """Landmarks as the library takes them, and the facts that their file states."""

    where: str
    names: list[str] = field(default_factory=list)
    points: list[list[float]] = field(default_factory=list)
    roles: list[int] = field(default_factory=list)
    leaflets: list[tuple[int, int]] = field(default_factory=list)
    ends: dict[str, list[float]] = field(default_factory=dict)
    valve: str | None = None
    unit: str | None = None
    axes: str | None = None
    noise: float | None = None
    flow: Any = None
    parameters: Mapping[str, Any] = field(default_factory=dict)

    def add(self, name: str, point: Any) -> None:
        try:
            numbers = [float(x) for x in point]
        except (TypeError, ValueError):
            numbers = []
        if len(numbers) != 3:
            raise _refuse(self.where, f"{name!r} must be three numbers, not {str(point)[:80]}")
        for letter, x in zip("xyz", numbers, strict=True):
            if not math.isfinite(x):
                raise _refuse(self.where, f"{name!r}: {letter} is {x}; it must be finite")
        text = re.sub(r"[ -]", "_", name.lower())
        if text in ("flow_from", "flow_to"):
            if text in self.ends:
                raise _refuse(self.where, f"{name!r} is given twice")
            self.ends[text] = numbers
            return
        place = _place_of(name)
        if place is None:
            raise _refuse(
                self.where,
                f"{name!r} is not the name of a landmark; there are {', '.join(_ROLES)}, flow_from and flow_to; a nadir may name "
                "its cusp, as in nadir_left, a commissure its two, as in commissure_left_right, and a point of the attachment "
                "its cusp and a number, as in attachment_left_2",
            )
        role, leaflets, may_repeat = place
        is_known = any(
            role == other
            and (
                set(leaflets) == set(ids)
                if leaflets[0] >= 0 and role != _ATTACHMENT
                else text == re.sub(r"[ -]", "_", known.lower())
            )
            for other, ids, known in zip(self.roles, self.leaflets, self.names, strict=True)
        )
        if is_known and not may_repeat:
            raise _refuse(self.where, f"{name!r} is given twice")
        self.names.append(name)
        self.points.append(numbers)
        self.roles.append(role)
        self.leaflets.append(leaflets)

    def add_all(self, landmarks: Mapping[str, Any]) -> None:
        for name, value in landmarks.items():
            is_list = numpy.ndim(value) == 2 if not isinstance(value, str) else False
            if not is_list:
                self.add(name, value)
            for number, point in enumerate(value if is_list else (), 1):
                self.add(f"{name}_{number}", point)

    def finish(self) -> None:
        if not self.names:
            raise _refuse(self.where, "there are no landmarks")
        if len(self.ends) == 1:
            raise _refuse(self.where, "flow_from and flow_to must be given together")
        if self.ends:
            if self.flow is not None:
                raise _refuse(self.where, "the flow is given twice, by flow and by flow_from and flow_to")
            self.flow = numpy.subtract(self.ends["flow_to"], self.ends["flow_from"])


def _check_stated(read: _Landmarks, name: Literal["unit", "axes"], choices: tuple[str, ...], why: str = "") -> None:
    value = getattr(read, name)
    if value is None:
        raise _refuse(read.where, f"{name} is missing; it must be {', '.join(choices)}{why}")
    if value not in choices:
        raise _refuse(read.where, f"{name} is {str(value)[:80]!r}; it must be {', '.join(choices)}{why}")


def _read_json(read: _Landmarks, text: str) -> None:
    def once(pairs: list[tuple[str, Any]]) -> dict[str, Any]:
        made = dict(pairs)
        if len(made) < len(pairs):
            raise _refuse(read.where, "a name is given twice in one object")
        return made

    try:
        root = json.loads(text, object_pairs_hook=once)
    except json.JSONDecodeError as error:
        raise _refuse(read.where, f"is not JSON: {error}") from None
    if not isinstance(root, dict):
        raise _refuse(read.where, "must hold a JSON object")
    if "markups" in root:
        _read_slicer(read, root["markups"])
        return
    known = ("valve", "unit", "axes", "noise", "flow", "parameters", "landmarks")
    for key in root:
        if key not in known:
            raise _refuse(read.where, f"{key!r} is unknown; there are {', '.join(known)}")
    for key in ("valve", "unit", "axes", "noise", "flow"):
        setattr(read, key, root.get(key))
    read.parameters = root.get("parameters", {})
    landmarks = root.get("landmarks")
    if not isinstance(landmarks, dict) or not isinstance(read.parameters, dict):
        raise _refuse(read.where, "landmarks and parameters must be objects")
    read.add_all(landmarks)


def _read_slicer(read: _Landmarks, lists: Any) -> None:
    try:
        for number, markups in enumerate(lists):
            stated = markups["coordinateSystem"], markups["coordinateUnits"]
            if number > 0 and stated != (read.axes, read.unit):
                raise _refuse(read.where, f"markups {number} has other axes or another unit than markups 0")
            read.axes, read.unit = stated
            if read.axes not in ("LPS", "RAS"):
                raise _refuse(read.where, f"coordinateSystem is {str(read.axes)[:80]!r}; it must be LPS or RAS")
            for point in markups["controlPoints"]:
                if point.get("positionStatus", "defined") != "defined":
                    raise _refuse(read.where, f"{point['label']!r} has no position yet: place the point or delete it")
                read.add(str(point["label"]), point["position"])
    except (AttributeError, KeyError, TypeError) as error:
        raise _refuse(read.where, f"is not a file of 3D Slicer's markups: {error}") from None


def _rows(text: str) -> Iterator[tuple[int, str]]:
    for number, line in enumerate(text.splitlines(), 1):
        if line.strip():
            yield number, line.strip()


def _read_csv(read: _Landmarks, text: str) -> None:
    stated: dict[str, str] = {}
    is_first = True
    for number, line in _rows(text):
        if line.startswith("#"):
            key, equals, value = (part.strip() for part in line[1:].partition("="))
            if not equals:
                continue
            if key not in ("unit", "axes", "valve", "noise", "flow"):
                words = "a line # NAME = VALUE states unit, axes, valve, noise or flow"
                raise _refuse(read.where, f"line {number}: {key!r} is unknown; {words}")
            if key in stated:
                raise _refuse(read.where, f"line {number}: {key} is given twice")
            stated[key] = value
            continue
        cells = [cell.strip() for cell in re.split("[,;]", line)]
        if len(cells) != 4:
            raise _refuse(read.where, f"line {number} must be NAME,X,Y,Z, not {line[:80]!r}")
        if not (is_first and [cell.lower() for cell in cells[1:]] == ["x", "y", "z"]):
            read.add(cells[0], cells[1:])
        is_first = False
    read.unit, read.axes, read.valve = stated.get("unit"), stated.get("axes"), stated.get("valve")
    if read.axes is None:
        raise _refuse(read.where, f"states no axes: a line such as # axes = LPS is missing{_WHY_AXES}")
    try:
        read.noise = float(stated["noise"]) if "noise" in stated else None
        read.flow = [float(x) for x in stated["flow"].split(",")] if "flow" in stated else None
    except ValueError as error:
        raise _refuse(read.where, str(error)) from None


def _read(landmarks: Mapping[str, Any] | str | os.PathLike[str]) -> _Landmarks:
    if isinstance(landmarks, Mapping):
        read = _Landmarks("landmarks")
        read.add_all(landmarks)
        return read
    if not isinstance(landmarks, str | os.PathLike):
        raise TypeError(f"landmarks must be a mapping of names to points, or a path, not {type(landmarks).__name__}")
    path = Path(landmarks)
    read = _Landmarks(str(path))
    if path.suffix.lower() not in (".json", ".csv"):
        raise _refuse(read.where, "landmarks must be a .json, .mrk.json or .csv file")
    text = path.read_text()
    (_read_csv if path.suffix.lower() == ".csv" else _read_json)(read, text)
    _check_stated(read, "axes", _AXES, _WHY_AXES)
    return read


def _in_words_of_file(text: str, read: _Landmarks) -> str:
    """Returns the library's message with the names of landmarks, and the words of this module for fields."""
    text = re.sub(r"landmark (\d+)(?: \(\w+\))?", lambda found: repr(read.names[int(found[1])]), text)
    text = re.sub(r"^landmarks\.scale is \S+ \((\w+)\)", r"unit: the unit is \1", text)
    text = re.sub(r"^landmarks\.leaflet_id of ", "the name of ", text)
    text = re.sub(r"^landmarks\.leaflet_id", "the names", text)
    text = re.sub(r"^landmarks\.role has the ", "it has the ", text)
    text = re.sub(r"^landmarks\.", "", text)
    return f"{read.where}: {text}"


def _check_at_nodes(read: _Landmarks, is_file: bool, points: Reals, nodes: Any) -> None:
    """Refuses landmarks that are not at the nodes. The message says if other axes or another unit would bring them there."""
    cloud = numpy.asarray(nodes, numpy.float64)
    if cloud.ndim != 2 or cloud.shape[1] != 3 or len(cloud) == 0:
        raise InvalidArgumentError(f"nodes: its shape is {cloud.shape}; it must be (n, 3), with a node or more")

    def apart(sign: float, factor: float) -> float:
        moved = factor * points * (sign, sign, 1.0)
        return float(numpy.mean([math.sqrt(((cloud - point) ** 2).sum(1).min()) for point in moved]))

    assert read.unit is not None
    # Landmarks lie on the wall, so nodes of the mesh must be near. Landmarks a centimetre away belong to another place.
    near, found = _SCALES[read.unit], apart(1.0, 1.0)
    if found <= near:
        return
    text = f"the landmarks are {found:.3g} {read.unit} from the nodes on average"
    for unit in (read.unit, *_SCALES):
        factor = _SCALES[unit] / _SCALES[read.unit]
        for sign in (1.0, -1.0):
            other = apart(sign, factor)
            if other > factor * near:
                continue
            changes = ([f"in {unit}"] if unit != read.unit else []) + (
                ["with x and y reversed, as between LPS and RAS"] if sign < 0 else [])
            advice: list[str] = []
            if unit != read.unit:
                advice.append(f"give unit={unit!r}" if is_file else f"give the landmarks in {unit}")
            if sign < 0 and read.axes != "mesh":
                advice.append(f"give axes={'RAS' if read.axes == 'LPS' else 'LPS'!r}")
            elif sign < 0:
                advice.append("state the axes of the file" if is_file else "turn the landmarks by half a turn about z")
            text += f"; {' and '.join(changes)}, they are {other:.3g} {unit} from them: {' and '.join(advice)}"
            raise _refuse(read.where, text)
    raise _refuse(read.where, f"{text}, which is more than 1 cm, in any unit and with the axes LPS and RAS")


def place(
    landmarks: Mapping[str, Any] | str | os.PathLike[str],
    valve: Valve | str | None = None,
    *,
    unit: Literal["mm", "cm", "m"] | None = None,
    axes: Literal["LPS", "RAS"] | None = None,
    flow: Any = None,
    noise: float | None = None,
    held: Any = (),
    warp: Literal["none", "exact", "smoothed"] = "none",
    nodes: Any = None,
) -> PlaceResult:
    """Finds a valve's sizes and placement from a patient's landmarks.

    landmarks  a mapping of names to points, such as {"nadir_left": (1, 2, 3), "annulus": [(...), ...]}, or the path of a file in
               JSON, 3D Slicer's .mrk.json or CSV. docs/formats.md lists the names
    valve      a kind, or a Valve whose proportions the result has. The default is the kind that the file names
    unit       of the landmarks, needed for a mapping; of the result, for a file: the landmarks are converted
    axes       of the mesh: landmarks of a file in the other axes are turned by half a turn about z
    flow       (3,), the direction of flow; needed for bileaflet valves, and for mitral ones without commissures and saddle
    noise      standard deviation of each coordinate, in the unit; default 0.3 mm
    held       names of parameters that keep the valve's values
    warp       "exact" warps the valve to the landmarks, and "smoothed" as near to them as their noise
    nodes      (n, 3), of the mesh: landmarks that are more than a centimetre from them on average are refused

    The valve is copied. Raises InvalidArgumentError naming landmarks that are missing, in one place, collinear, mirrored, or not
    of the size of a heart valve in this unit. If landmarks are not at the nodes, the message says whether they would be with the
    axes LPS and RAS swapped, or in another unit. Raises InvalidParameterError for sizes that do not go together, for a folding
    warp, and for any warp of a bileaflet valve, which is rigid.
    """
    if warp not in ("none", "exact", "smoothed"):
        raise InvalidArgumentError(f"warp is {warp!r}; it must be none, exact or smoothed")
    read = _read(landmarks)
    is_file = not isinstance(landmarks, Mapping)
    if not is_file:
        read.unit, read.axes = unit, "mesh"
    _check_stated(read, "unit", tuple(_SCALES))
    assert read.unit is not None and read.axes is not None
    if flow is not None and (read.ends or read.flow is not None):
        raise _refuse(read.where, "the flow is given twice, by flow and by the landmarks")
    read.finish()
    points = numpy.array(read.points, numpy.float64)
    direction = None if read.flow is None else numpy.array(read.flow, numpy.float64).ravel()
    if is_file and unit is not None:
        if unit not in _SCALES:
            raise InvalidArgumentError(f"unit is {unit!r}; it must be {', '.join(_SCALES)}")
        points *= _SCALES[unit] / _SCALES[read.unit]
        if read.noise is not None:
            read.noise *= _SCALES[unit] / _SCALES[read.unit]
        read.unit = unit
    if axes is not None:
        if axes not in ("LPS", "RAS"):
            raise InvalidArgumentError(f"axes is {axes!r}; it must be LPS or RAS")
        if read.axes == "mesh":
            raise InvalidArgumentError(f"axes is {axes!r}, but {read.where} states the mesh's own axes, so they cannot be turned")
        if axes != read.axes:
            points *= (-1, -1, 1)
            direction = None if direction is None else direction * (-1, -1, 1)
        read.axes = axes
    if direction is None and flow is not None:
        direction = numpy.array(flow, numpy.float64).ravel()
    if direction is not None and direction.shape != (3,):
        raise InvalidArgumentError(f"flow has {direction.size} numbers; it must have 3")
    if nodes is not None:
        _check_at_nodes(read, is_file, points, nodes)
    if isinstance(valve, Valve):
        placed = valve.copy()
        if read.valve is not None and read.valve != placed.kind:
            raise InvalidParameterError(f"valve is of the kind {placed.kind}, but {read.where} names {read.valve}")
    else:
        if valve is None and read.valve is None:
            raise _refuse(read.where, "valve is needed, because the landmarks do not name the kind")
        if valve is not None and read.valve is not None and valve != read.valve:
            raise InvalidParameterError(f"valve is {valve!r}, but {read.where} names {read.valve}")
        placed = Valve(str(valve if valve is not None else read.valve))
    table = placed.parameters
    keep = [held] if isinstance(held, str) else list(held)
    for name, value in read.parameters.items():
        parts = {f"{name}.{inner}": x for inner, x in value.items()} if isinstance(value, Mapping) else {name: value}
        for part, number in parts.items():
            placed[part] = number
            keep.append(part)
    keep = [full for given in keep for full in table if full == given or full.endswith("." + given)] + [
        given for given in keep if not any(full == given or full.endswith("." + given) for full in table)
    ]
    scatter = noise if noise is not None else read.noise
    try:
        result = place_landmarks(
            placed,
            points,
            numpy.array(read.roles, numpy.int32),
            numpy.array(read.leaflets, numpy.int32).reshape(-1, 2),
            _SCALES[read.unit],
            scatter,
            None if direction is None else tuple(direction.tolist()),
            " ".join(keep),
        )
    except Error as error:
        raise type(error)(_in_words_of_file(str(error), read)) from None
    placement, residuals, errors, states, rms, worst, shown, rotation_error, position_error, worst_id, places = result
    made, warped_residuals, smoothing = None, None, 0.0
    if warp != "none":
        usual_noise = 0.03 * _SCALES[read.unit]
        smoothing = 0.0 if warp == "exact" else usual_noise if scatter is None else scatter
        made = _warped(placed, placement, places, points, smoothing, read)
        warped_residuals = numpy.linalg.norm(made.map(places) - points, axis=1)
    by_source: dict[str, list[str]] = {source: [] for source in _SOURCES}
    for name, state in zip(table, states, strict=True):
        by_source[_SOURCES[state]].append(name)
    fitted = by_source["determined"] + by_source["undetermined"]
    all_errors = dict(zip(table, errors.tolist(), strict=True))
    return PlaceResult(
        valve=placed,
        placement=placement,
        unit=read.unit,
        axes=read.axes,
        names=tuple(read.names),
        residuals=residuals,
        rms=rms,
        worst=worst,
        worst_landmark=read.names[worst_id],
        noise=shown,
        rotation_error=rotation_error,
        position_error=position_error,
        standard_errors={name: all_errors[name] for name in fitted},
        determined=tuple(by_source["determined"]),
        undetermined=tuple(by_source["undetermined"]),
        in_proportion=tuple(by_source["proportion"]),
        points=points,
        places=places,
        warp=made,
        warp_noise=smoothing,
        warped_residuals=warped_residuals,
    )


def _warped(valve: Valve, placement: dict[str, Any], places: Reals, points: Reals, noise: float, read: _Landmarks) -> Warp:
    """Warps the valve to the landmarks, and returns the warp. Refuses a warp that folds at one of five openings."""
    try:
        warp = Warp(places, noise=noise, placement=placement)
        warp.set_targets(points)
        valve.set_warp(warp)
        trial = valve.copy()
        for opening in (0.0, 0.25, 0.5, 0.75, 1.0):
            trial["opening"] = opening
            Surface(trial, half_thickness=0.1 * placement["scale"], **placement).close()
    except Error as error:
        raise type(error)(_in_words_of_file(str(error), read)) from None
    return warp
