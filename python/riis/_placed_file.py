# SPDX-License-Identifier: Apache-2.0
"""The file of a placed valve, as the program riis and PlaceResult.save write it."""

from __future__ import annotations

import json
import os
from collections.abc import Mapping
from typing import Any, NamedTuple

import numpy

from riis._errors import Error, InvalidArgumentError
from riis._riis import Valve, Warp

_SCALES = {"mm": 10.0, "cm": 1.0, "m": 0.01}  # lengths in the unit for each centimetre
_KEYS = ("valve", "unit", "axes", "rotate", "translate", "parameters", "landmarks", "fit", "warp")  # as in the program
_KEYS_OF_WARP = ("sources", "targets", "noise", "coordinates")


class PlacedValve(NamedTuple):
    """A placed valve from a file. Its surface is Surface(placed.valve, **placed.placement)."""

    valve: Valve  #: closed, and warped if the file has a warp
    placement: dict[str, Any]  #: scale, rotation_axis, rotation_angle (degrees) and translation
    unit: str  #: "mm", "cm" or "m", of the placement


def read_placed(path: str | os.PathLike[str], unit: str | None = None) -> PlacedValve:
    """Reads a placed valve: the file of ``riis place --output``, or of the method save of place's result.

    path  the .json file
    unit  of the placement and of the warp: "mm", "cm" or "m". None: the file's unit

    Raises InvalidArgumentError naming the file and what is wrong in it, or unit; InvalidParameterError for sizes that the valve
    refuses; OSError for a file that cannot be read.
    """
    name = os.fspath(path)
    if unit is not None and unit not in _SCALES:
        raise InvalidArgumentError(f"unit is {unit!r}; it must be {', '.join(_SCALES)}")
    with open(name, "rb") as file:
        try:
            root = json.loads(file.read())
        except (ValueError, RecursionError) as error:
            raise InvalidArgumentError(f"{name} is not JSON: {error}") from None
    if not isinstance(root, dict) or not isinstance(root.get("valve"), str):
        raise InvalidArgumentError(f"{name} is not a placed valve: it must be a JSON object with the kind of valve in \"valve\"")
    _check_keys(name, root, _KEYS)
    own = root.get("unit")
    if own not in _SCALES:
        raise InvalidArgumentError(f"{name}: unit is {own!r}; it must be {', '.join(_SCALES)}")
    wanted = own if unit is None else unit
    factor = _SCALES[wanted] / _SCALES[own]
    turn, shift = _numbers(name, root, "rotate", (4,)), _numbers(name, root, "translate", (3,))
    placement = {
        "scale": _SCALES[wanted], "rotation_axis": tuple(turn[:3].tolist()), "rotation_angle": float(turn[3]),
        "translation": tuple((factor * shift).tolist()),
    }  # fmt: skip
    sizes = root.get("parameters", {})
    if not isinstance(sizes, dict):
        raise InvalidArgumentError(f"{name}: parameters is {sizes!r}; it must be an object")
    try:
        valve = Valve(root["valve"])
        valve.update(_flat(name, sizes))
        if "warp" in root:
            valve.set_warp(_warp_of(f"{name}: warp", root["warp"], factor, placement))
    except Error as error:
        raise type(error)(str(error) if str(error).startswith(name) else f"{name}: {error}") from None
    return PlacedValve(valve, placement, wanted)


def _check_keys(where: str, values: Mapping[str, Any], known: tuple[str, ...]) -> None:
    for key in values:
        if key not in known:
            raise InvalidArgumentError(f"{where}: {key!r} is unknown; the keys are {', '.join(known)}")


def _flat(name_of_file: str, sizes: Mapping[str, Any]) -> dict[str, Any]:
    """Returns sizes by their full names, such as right.leaflet_height."""
    made = {}
    for name, value in sizes.items():
        made.update({f"{name}.{inner}": part for inner, part in value.items()} if isinstance(value, dict) else {name: value})
    for name, value in made.items():
        parts = value if isinstance(value, list) else [value]
        if any(isinstance(part, bool) or not isinstance(part, (int, float)) for part in parts):
            raise InvalidArgumentError(f"{name_of_file}: {name} is {value!r}; it must be a number, or numbers")
    return made


def _numbers(where: str, values: Mapping[str, Any], key: str, shape: tuple[int, ...]) -> Any:
    """Returns an array of finite numbers. A length of -1 is any length."""
    words = {1: f"must be {shape[0]} finite numbers", 2: "must be points of three finite numbers each"}[len(shape)]
    try:
        array = numpy.array(values[key], numpy.float64)
    except KeyError:
        raise InvalidArgumentError(f"{where}: {key} is missing") from None
    except (TypeError, ValueError):
        raise InvalidArgumentError(f"{where}: {key} {words}") from None
    fits = array.ndim == len(shape) and all(n in (-1, m) for n, m in zip(shape, array.shape, strict=True))
    if not fits or not numpy.isfinite(array).all():
        raise InvalidArgumentError(f"{where}: {key} {words}")
    return array


def _warp_of(where: str, values: Any, factor: float, placement: Mapping[str, Any]) -> Warp:
    if not isinstance(values, dict):
        raise InvalidArgumentError(f"{where} is {values!r}; it must be an object")
    _check_keys(where, values, _KEYS_OF_WARP)
    coordinates, noise = values.get("coordinates", "mesh"), values.get("noise", 0.0)
    if coordinates not in ("mesh", "valve"):
        raise InvalidArgumentError(f"{where}: coordinates is {coordinates!r}; it must be mesh or valve")
    if isinstance(noise, bool) or not isinstance(noise, (int, float)) or not 0.0 <= noise < float("inf"):
        raise InvalidArgumentError(f"{where}: noise is {noise!r}; it must be at least 0")
    is_placed = coordinates == "mesh"
    factor = factor if is_placed else 1.0
    sources, targets = (factor * _numbers(where, values, key, (-1, 3)) for key in ("sources", "targets"))
    warp = Warp(sources, noise=factor * noise, placement=placement if is_placed else None)
    warp.set_targets(targets)
    return warp
