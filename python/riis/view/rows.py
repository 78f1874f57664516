# SPDX-License-Identifier: Apache-2.0
"""The contents of the page of riis view as plain values: sliders, rows, lights, curves, and placements after drags."""

from __future__ import annotations

import hashlib
import math
from typing import Any

import numpy

from riis.view._landmark_files import missing, role_of, roles_of
from riis.view._numbers import in_unit, shown
from riis.view._valves import SURFACE, is_atrioventricular, n_leaflets

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
_UNITS = {"degree": "°", "1": ""}
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
        "name": "half_thickness", "label": "half thickness ε", "unit": unit, "least": 0.0, "greatest": 1e60,
        "low": 0.05 * middle, "high": 4.0 * middle, "step": 0.005 * middle, "value": value,
        "description": "nodes closer than this to a leaflet are marked; in the mesh's unit",
    }  # fmt: skip


def offset_of(valve: Any) -> dict[str, Any]:
    """Returns the slider of the offset, with the advice of riis params."""
    advice = (
        "leave it at 0, because the flow passes on both sides of the leaflets" if valve.kind == "bileaflet" else
        "with a cut rim and a skirt, take 0.5 if the half thickness is at least the gap of the closed valve. Take 0 for a wider"
        " gap" if valve.kind == "mitral" else
        "with a cut rim and a skirt, 0.75 gives an open valve its full width if the flow is on one side and the half thickness "
        "is at least twice the gap of the closed valve. Take 0.5 from one gap on, and 0 for a wider gap"
    )  # fmt: skip
    return {
        "name": "offset", "label": "offset of the band", "unit": "", "least": -1.0, "greatest": 1.0, "low": -0.95, "high": 0.95,
        "step": 0.05, "value": float(valve.offset),
        "description": f"by how many half thicknesses the band steps aside along the normals: {advice}",
    }  # fmt: skip


def factor_of(parameter: Any, scale: float) -> float:
    """Returns the factor from a parameter's value to the number on the screen, where lengths have the mesh's unit."""
    return scale if parameter.unit == "length" else 1.0


def slider_of(parameter: Any, value: float, is_set: bool, scale: float, unit: str, label: str = "") -> dict[str, Any]:
    factor = factor_of(parameter, scale)

    def on_screen(number: float) -> float:
        return in_unit(float(number), factor)

    value = on_screen(value)
    low, high = min(on_screen(parameter.low), value), max(on_screen(parameter.high), value)
    step = 10.0 ** math.floor(math.log10((high - low) / 100)) if high > low else 0.01
    return {
        "name": parameter.name, "label": label or _LABELS.get(parameter.name, parameter.name.replace("_", " ")),
        "changed": is_set, "unit": unit if parameter.unit == "length" else _UNITS[parameter.unit],
        "least": on_screen(parameter.least), "greatest": on_screen(parameter.greatest), "low": low, "high": high, "step": step,
        "value": value, "description": parameter.description,
    }  # fmt: skip


def _number(value: float) -> str:
    return shown(value, 6)


def _range_of(parameter: Any, factor: float) -> str:
    """Returns a range in words. The widest ranges of the library only keep out numbers that overflow."""
    least, greatest = factor * parameter.least, factor * parameter.greatest
    if parameter.greatest < 1e8:
        return f"{_number(least)} to {_number(greatest)}"
    if parameter.least < -1e8:
        return "any"
    return "above 0" if 0.0 < parameter.least < 1e-8 else f"at least {_number(least)}"


def row_of(parameter: Any, value: Any, is_set: bool, scale: float, unit: str) -> dict[str, Any]:
    parts, factor = value if isinstance(value, tuple) else (value,), factor_of(parameter, scale)
    return {
        "name": parameter.name, "value": ", ".join(_number(factor * part) for part in parts),
        "unit": unit if parameter.unit == "length" else _UNITS[parameter.unit], "range": _range_of(parameter, factor),
        "changed": is_set, "description": parameter.description + (f" (unless set: {parameter.rule})" if parameter.rule else ""),
    }  # fmt: skip


def placement_of(valve: Any, unit: str) -> list[dict[str, Any]]:
    def row(name: str, label: str, values: Any, description: str) -> dict[str, Any]:
        return {"name": name, "label": label, "values": values, "description": description}

    def direction(values: Any) -> list[str]:  # in one field, because a direction with one new component is a different direction
        return [", ".join(shown(round(x, 6), 6) for x in values)]

    words = f" in {unit}" if unit else ""
    flow = "against the flow, towards the atrium" if is_atrioventricular(valve.kind) else "the direction of the flow"
    return [
        row("origin", f"Centre{words}", [_number(x) for x in valve.origin], "the valve's origin, in the mesh's unit"),
        row("axis", "Axis", direction(valve.axis), f"{flow}, of any length"),
        row("reference", "Turn", direction(valve.reference), "the direction of the valve's x axis, of any length"),
        row("scale", "Scale", [_number(valve.scale)], "the length of a centimetre of the valve, in the mesh's unit"),
    ]


# ---- Landmarks ----


def landmarks_of(kind: str, points: Any) -> list[dict[str, Any]]:
    """Returns a row for each landmark that is set, or that a kind may have, in the order of the kind's list."""
    needed = set(missing(kind, points))
    rows, done = [], set()

    def row(name: str, text: str, role: str, is_needed: bool) -> dict[str, Any]:
        at = points.get(name)
        return {
            "name": name, "label": name.replace("_", " "), "role": role, "text": text, "needed": is_needed, "set": at is not None,
            "value": "" if at is None else ", ".join(_number(x) for x in at),
        }  # fmt: skip

    for role in roles_of(kind):
        mine = sorted((name for name in points if role_of(name, kind) == role), key=_by_number)
        rows += [row(name, role.text, name, False) for name in mine]
        done.update(mine)
        if role.is_list:
            is_needed = any(role_of(name, kind) == role for name in needed)
            adding = row(role.name, f"{role.text}: press to add one", role.name, is_needed)
            rows.append(adding | {"label": f"+ {adding['label']}"})
        elif not mine:
            rows.append(row(role.name, role.text, role.name, role.name in needed))
    return rows + [row(name, "this kind of valve has no such landmark", name, False) for name in points if name not in done]


def _by_number(name: str) -> tuple[str, int]:
    word, _, number = name.rpartition("_")
    return (word, int(number)) if number.isdigit() else (name, 0)


def found_of(found: Any, unit: str) -> dict[str, Any]:
    """Returns the table of a placing or of a fit: a head, the rows, and remarks that a person should read."""
    if found is None:
        return {}
    words = f" {unit}" if unit else ""
    if hasattr(found, "residuals"):
        has_warp = found.warped_residuals is not None
        head = ["landmark", f"residual{words}"] + ([f"warped{words}"] if has_warp else [])
        rows = [
            [name.replace("_", " "), shown(found.residuals[k])] + ([shown(found.warped_residuals[k])] if has_warp else [])
            for k, name in enumerate(found.names)
        ]
        notes = [
            f"rms {shown(found.rms)}{words}, worst {shown(found.worst)}{words} at {found.worst_landmark.replace('_', ' ')}",
            f"standard errors: {shown(found.rotation_error)}°, {shown(found.position_error)}{words}",
        ]
        if found.undetermined:
            notes.append(f"the landmarks do not determine {', '.join(found.undetermined)}")
        return {"title": "Placed by landmarks", "head": head, "rows": rows, "notes": notes}
    table = found.valve.parameters
    factor = float(found.placement["scale"])
    rows = []
    for name, value in found.parameters.items():
        times, of = (factor, unit) if table[name].unit == "length" else (1.0, _UNITS[table[name].unit])
        rows.append([name.replace("_", " "), f"{shown(times * value)} {of}", shown(times * found.standard_errors[name])])
    notes = [
        f"rms {shown(found.rms)}{words}; 95 % of {len(found.distances)} points within {shown(found.percentile95)}{words}",
        f"outliers {100 * found.outliers:.1f} %; the points cover {100 * found.covered:.0f} % of the valve",
        *(f"doubt: {doubt}" for doubt in found.doubts),
    ]
    return {"title": "Fitted to points", "head": ["size", "value", "std. error"], "rows": rows, "notes": notes}


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
        label += f", at most {shown(top)} {unit}"
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
