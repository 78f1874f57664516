# SPDX-License-Identifier: Apache-2.0
"""The contents of the page of riis view as plain values: sliders, rows, lights, curves, and placements after drags."""

from __future__ import annotations

import hashlib
import math
from typing import Any

import numpy

from riis.view._valves import SURFACE, n_leaflets

_LIGHT = {
    "good": ("mdi-check-circle", "#009e73"),
    "warn": ("mdi-alert", "#e69f00"),
    "bad": ("mdi-close-octagon", "#d55e00"),
    "off": ("mdi-minus-circle-outline", "#9e9e9e"),
}

SLIDER = """
      <div class="slider" v-if="sliders[{k}]" :title="sliders[{k}].description">
        <div class="line"><span class="name">{{{{ sliders[{k}].label }}}}</span>
          <input type="number" step="any" :key="refusals" :id="'slider-' + sliders[{k}].name"
            :value="Number(Number(slider_{k}).toPrecision(4))"
            :min="sliders[{k}].least" :max="sliders[{k}].greatest"
            @change="trigger('riis_set', [sliders[{k}].name, $event.target.value])">
          <span class="unit">{{{{ sliders[{k}].unit }}}}</span>
          <button v-if="sliders[{k}].changed" class="back" title="Back to the default"
            @click="trigger('riis_set', [sliders[{k}].name, null])">↺</button></div>
        <v-slider v-model="slider_{k}" :min="sliders[{k}].low" :max="sliders[{k}].high" :step="sliders[{k}].step"
          :data-parameter="sliders[{k}].name" hide-details density="compact" color="primary" class="mx-0"
          @start="trigger('riis_hold', [true])" @end="trigger('riis_hold', [false])"></v-slider>
      </div>"""

OPENING = {
    "name": "opening", "label": "opening", "unit": "", "least": 0.0, "greatest": 1.0, "low": 0.0, "high": 1.0, "step": 0.005,
    "description": "0 is closed, 1 is open",
}  # fmt: skip
_LABELS = {"annulus": "annulus, diameter", "stj": "sinotubular junction, diameter"}
_UNITS = {"length": "cm", "degree": "°", "1": ""}
_CUSPS = ["right cusp", "left cusp", "non-coronary cusp"]
_MITRAL = ["anterior leaflet", "posterior leaflet"]
_LEAFLETS = {
    "aortic": _CUSPS, "coapting": _CUSPS, "trileaflet": _CUSPS, "mitral": _MITRAL, "mitral_coapting": _MITRAL,
    "tricuspid": ["anterior leaflet", "septal leaflet", "posterior leaflet"],
    "bileaflet": ["leaflet at x > 0", "leaflet at x < 0"],
}  # fmt: skip


def leaflet_name(kind: str, leaflet: int) -> str:
    """Returns the name of a part of a surface that has this leaflet_id."""
    if kind == SURFACE:
        return "surface"
    if leaflet >= n_leaflets(kind):
        return "housing" if kind == "bileaflet" else "skirt"
    return _LEAFLETS[kind][leaflet] if kind in _LEAFLETS else f"cusp {leaflet}"


def half_thickness_of(valve: Any, unit: str) -> dict[str, Any]:
    value = float(valve.half_thickness)
    middle = 10.0 ** round(math.log10(value))
    return {
        "name": "half_thickness", "label": "half thickness", "unit": unit, "least": 0.0, "greatest": 1e60, "low": 0.05 * middle,
        "high": 4.0 * middle, "step": 0.005 * middle, "value": value,
        "description": "nodes closer than this to a leaflet are marked; in the mesh's unit",
    }  # fmt: skip


def offset_of(valve: Any) -> dict[str, Any]:
    """Returns the slider of the offset, with the advice of riis params."""
    advice = (
        "leave it at 0, because the flow passes on both sides of the leaflets" if valve.kind == "bileaflet" else
        "with a cut rim and a skirt, 0.75 gives an open valve its full width if the flow is on one side and the half thickness "
        "is at least twice the gap of the closed valve. Take 0.5 from one gap on, and 0 for a wider gap"
    )  # fmt: skip
    return {
        "name": "offset", "label": "offset of the band", "unit": "", "least": -1.0, "greatest": 1.0, "low": -0.95, "high": 0.95,
        "step": 0.05, "value": float(valve.offset),
        "description": f"by how many half thicknesses the band steps aside along the normals: {advice}",
    }  # fmt: skip


def slider_of(parameter: Any, value: float, is_set: bool, label: str = "") -> dict[str, Any]:
    low, high = min(float(parameter.low), value), max(float(parameter.high), value)
    step = 10.0 ** math.floor(math.log10((high - low) / 100)) if high > low else 0.01
    return {
        "name": parameter.name, "label": label or _LABELS.get(parameter.name, parameter.name.replace("_", " ")),
        "changed": is_set, "unit": _UNITS[parameter.unit],
        "least": float(parameter.least), "greatest": float(parameter.greatest), "low": low, "high": high, "step": step,
        "value": value, "description": parameter.description,
    }  # fmt: skip


def _number(value: float) -> str:
    return f"{value:.6g}"


def _range_of(parameter: Any) -> str:
    """Returns a range in words. The library's widest ranges only keep out numbers that overflow."""
    if parameter.greatest < 1e8:
        return f"{_number(parameter.least)} to {_number(parameter.greatest)}"
    if parameter.least < -1e8:
        return "any"
    return "above 0" if 0.0 < parameter.least < 1e-8 else f"at least {_number(parameter.least)}"


def row_of(parameter: Any, value: Any, is_set: bool) -> dict[str, Any]:
    parts = value if isinstance(value, tuple) else (value,)
    return {
        "name": parameter.name, "value": ", ".join(_number(part) for part in parts), "unit": _UNITS[parameter.unit],
        "range": _range_of(parameter), "changed": is_set,
        "description": parameter.description + (f" (unless set: {parameter.rule})" if parameter.rule else ""),
    }  # fmt: skip


def placement_of(valve: Any) -> list[dict[str, Any]]:
    def row(name: str, label: str, values: Any, description: str) -> dict[str, Any]:
        return {"name": name, "label": label, "values": values, "description": description}

    def direction(values: Any) -> list[str]:  # in one field, because a direction with one new component is a different direction
        return [", ".join(f"{round(x, 6) + 0.0:g}" for x in values)]

    return [
        row("origin", "Centre", [_number(x) for x in valve.origin], "the valve's origin, in the mesh's unit"),
        row("axis", "Axis", direction(valve.axis), "the direction of the flow, of any length"),
        row("reference", "Turn", direction(valve.reference), "the direction of the valve's x axis, of any length"),
        row("scale", "Scale", [_number(valve.scale)], "the length of a centimetre of the valve, in the mesh's unit"),
    ]


def light_of(light: Any) -> dict[str, Any]:
    icon, colour = _LIGHT[light.level]
    return {
        "name": light.name, "level": light.level, "text": light.text, "advice": light.advice or "",
        "cure": light.cure[0] if light.cure else "", "icon": icon, "colour": colour,
    }  # fmt: skip


def line_of(label: str, times: Any, values: Any, colour: str, unit: str = "", *, top: float = 0.0) -> dict[str, str]:
    """Returns a curve as the points of an SVG polyline, in a box of 300 by 44."""
    values = numpy.nan_to_num(numpy.asarray(values, float))
    if top == 0.0:
        top = max(float(values.max()), 1e-300)
        label += f", at most {float(f'{top:.3g}'):,g} {unit}"
    x, y = 300 * (times - times[0]) / (times[-1] - times[0]), 41 - 38 * values / top
    return {"label": label, "colour": colour, "points": " ".join(f"{a:.1f},{b:.1f}" for a, b in zip(x, y, strict=True))}


def digest_of(shown: Any) -> str:
    """Returns a digest of the marks: ids, distances and leaflets, to the last bit. ./run view --check compares it with files."""
    parts = (shown.marked, numpy.int64), (shown.distance, numpy.float64), (shown.leaflet, numpy.int32)
    return hashlib.sha256(b"".join(numpy.asarray(array, kind).tobytes() for array, kind in parts)).hexdigest()


def dragged(scene: Any, tool: str, valve: Any, dx: float, dy: float, shift: bool) -> tuple[Any, Any, Any, float]:
    """Returns the placement of a valve after a drag."""
    origin, axis, reference = (numpy.asarray(v, float) for v in (valve.origin, valve.axis, valve.reference))
    scale = float(valve.scale)
    if tool == "move":
        step = scene.world_step(dx, dy, origin)
        origin = origin + (axis * (step @ axis) if shift else step)
    elif tool == "size":
        scale *= math.exp(2.0 * max(-1.0, min(1.0, dy)))
    elif shift:
        reference = _turned(reference, axis, math.pi * dx)
    else:
        right, up = scene.axes_of_view()
        axis, reference = (_turned(_turned(v, up, math.pi * dx), right, -math.pi * dy) for v in (axis, reference))
    return origin, axis, reference, scale


def _turned(vector: Any, about: Any, angle: float) -> Any:
    """Returns a vector turned about a unit vector (Rodrigues)."""
    along = about * (about @ vector)
    return along + math.cos(angle) * (vector - along) + math.sin(angle) * numpy.cross(about, vector)
