# SPDX-License-Identifier: Apache-2.0
"""The state of a valve in the view: its kind, sizes and placement as plain values, from which surfaces and files are made."""

from __future__ import annotations

import math
import re
from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import lru_cache
from types import MappingProxyType
from typing import Any, Literal, NamedTuple

import numpy
from numpy.typing import NDArray

from riis._errors import InvalidArgumentError, UnknownParameterError
from riis._riis import Keyframes, Surface, Valve, Warp
from riis.laws import OpeningTable, OpeningTimes

Reals = NDArray[numpy.float64]
Ids = NDArray[numpy.int64]
Integers = NDArray[numpy.int32]
Vector = tuple[float, float, float]
Value = float | tuple[float, ...]

KINDS = (
    "coapting", "bicuspid", "quadricuspid", "trileaflet", "aortic", "mitral", "mitral_coapting", "tricuspid", "bileaflet",
)  # fmt: skip
TRIANGULATIONS = ("adapted", "fixed")
SURFACE = "surface"  # the kind of a surface from a file

# The sizes that matter first. Names that surgeons use, such as annulus, come first in any case.
_FIRST = {
    "aortic": ("bending_height", "skirt_length"),
    "bicuspid": ("effective_height", "coaptation_height", "gap", "meeting_shift", "skirt_length"),
    "coapting": ("effective_height", "coaptation_height", "gap", "skirt_length"),
    "quadricuspid": ("effective_height", "coaptation_height", "gap", "skirt_length"),
    "trileaflet": ("bending_height", "skirt_length"),
    "mitral": ("AP_diameter", "ALPM_diameter", "anterior_length", "posterior_scallop_length1", "posterior_scallop_length2",
               "skirt_length"),
    "mitral_coapting": ("AP_diameter", "ALPM_diameter", "anterior_length", "posterior_length", "tenting_height", "skirt_length"),
    "tricuspid": ("AP_diameter", "SL_diameter", "anterior_length", "posterior_length", "septal_length", "tenting_height",
                  "skirt_length"),
    "bileaflet": ("closed_angle", "open_angle", "ring_height"),
}
# Sliders of sizes of a leaflet, a commissure or a bump whose range in the library is wider than any that a hand can use.
_SLIDERS = {"sector": (50.0, 240.0), "width": (0.2, 1.0), "lift": (-0.5, 1.0)}


class Parameter(NamedTuple):
    """A size of a kind of valve, with what a slider and a table need. Lengths are in centimetres, angles in degrees."""

    name: str
    unit: str  #: "length", "degree" or "1"
    least: float  #: the library refuses less
    greatest: float  #: the library refuses more
    default: Value
    description: str
    first: bool  #: whether it is one of the most important sizes
    n_values: int  #: 1 or 3
    low: float  #: the value at which a slider begins: a size that a valve may have
    high: float  #: where a slider ends
    rule: str  #: the value while the size is not set, such as "0.5 leaflet_height"; "": the default
    other_name: str  #: a surgeon's name of the same size, such as "annulus", which is then a separate entry
    other_factor: float  #: the factor from the parameter's value to the other name's value

    @property
    def part(self) -> str:
        """The leaflet, the commissure or the bump of the size, such as "cusp_0"; "": it belongs to the whole valve."""
        return self.name.rpartition(".")[0]

    @property
    def size(self) -> str:
        """The name without the part, such as "sector"."""
        return self.name.rpartition(".")[2]


class Cycle(NamedTuple):
    """An opening in time."""

    source: str  #: the name of a built-in cycle, or the path of a CSV file
    law: OpeningTable | OpeningTimes
    period: float


@dataclass(frozen=True, eq=False)
class SurfaceSource:
    """A surface from a file, with one frame or with several in time. Lengths have the file's unit."""

    vertices: Reals  #: (n_frames, n_vertices, 3)
    faces: Ids  #: (n_faces, 3 or 4)
    leaflet_id: Integers | None = None
    times: Reals | None = None  #: (n_frames,); None for one frame
    period: float = 0.0
    path: str | None = None

    @property
    def moves(self) -> bool:
        return self.times is not None


@dataclass(frozen=True, eq=False)
class WarpState:
    """Landmarks on the closed valve, and the places in the patient to which the valve is warped."""

    sources: Reals  #: (n, 3)
    targets: Reals  #: (n, 3)
    noise: float  #: by which the warp is smoothed
    is_in_mesh: bool  #: whether both lie in the mesh, where the valve's placement puts it; otherwise in the valve's own frame

    def warp(self, placement: Mapping[str, Any]) -> Warp:
        made = Warp(self.sources, noise=self.noise, placement=dict(placement) if self.is_in_mesh else None)
        made.set_targets(self.targets)
        return made

    def in_own_frame(self, placement: Mapping[str, Any]) -> WarpState:
        """Returns the same warp in the valve's own frame. If a valve is moved by hand, its warp moves with it."""
        if not self.is_in_mesh:
            return self
        scale, origin = float(placement["scale"]), numpy.array(placement["translation"])
        matrix = matrix_of((*vector(placement["rotation_axis"]), float(placement["rotation_angle"])))
        sources, targets = (
            numpy.ascontiguousarray((points - origin) @ matrix / scale) for points in (self.sources, self.targets)
        )
        return WarpState(sources, targets, self.noise / scale, False)

    def in_mesh(self, placement: Mapping[str, Any]) -> WarpState:
        """Returns the same warp in the mesh, where a placement puts the valve."""
        if self.is_in_mesh:
            return self
        scale, origin = float(placement["scale"]), numpy.array(placement["translation"])
        matrix = matrix_of((*vector(placement["rotation_axis"]), float(placement["rotation_angle"])))
        sources, targets = (
            numpy.ascontiguousarray(scale * points @ matrix.T + origin) for points in (self.sources, self.targets)
        )
        return WarpState(sources, targets, scale * self.noise, True)


@dataclass(frozen=True, eq=False)
class PlacedSource:
    """The file of a placed valve that was opened, with its statements about the valve."""

    path: str
    kind: str
    unit: str  #: of the placement below
    parameters: Mapping[str, Value]
    rotation: tuple[float, float, float, float]
    origin: Vector
    warp: WarpState | None

    def places(self, state: ValveState) -> bool:
        """Returns whether the file still gives the valve's placement and warp, so that a command can name it."""
        mine = (self.kind, self.rotation, self.origin, self.warp)
        return mine == (state.kind, state.rotation, state.origin, state.warp) and set(self.parameters) <= set(state.parameters)


@dataclass(frozen=True)
class ValveState:
    """A valve in the view. A valve is a snapshot, because the model makes a new one for each change.

    The placement takes a point x of the valve to scale * rotation * x + origin. ``axis`` and ``reference`` are the directions of
    the valve's z and x axes in the mesh.
    """

    name: str
    kind: str  #: one of KINDS, or "surface"
    opening: float
    half_thickness: float  #: mesh units
    resistance: float  #: kg/(m s) if the mesh has a unit; otherwise mesh units
    scale: float
    rotation: tuple[float, float, float, float] = (0.0, 0.0, 1.0, 0.0)  #: an axis, and degrees
    origin: Vector = (0.0, 0.0, 0.0)  #: the place of the valve's own origin, mesh units
    parameters: Mapping[str, Value] = field(default_factory=lambda: MappingProxyType({}))  #: only parameters that were set
    triangulation: Literal["adapted", "fixed"] = "adapted"
    cycle: Cycle | None = None
    surface: SurfaceSource | None = None
    time: float = 0.0  #: of a surface that moves
    offset: float = 0.0  #: of the band, in half thicknesses along the normals
    warp: WarpState | None = None
    skirt: float = 0.0  #: the longest skirt to the wall, mesh units; 0: none
    placed: PlacedSource | None = None  #: the file from which the valve came
    sized: tuple[str, ...] = field(default=(), compare=False)  #: the sizes on which the landmarks of the last place bear
    found: Any = field(default=None, compare=False)  #: the PlaceResult or FitResult that gave the present sizes and placement

    @property
    def matrix(self) -> Reals:
        """The rotation: its columns are the directions of the valve's axes."""
        return matrix_of(self.rotation)

    @property
    def axis(self) -> Vector:
        return vector(self.matrix[:, 2])

    @property
    def flow(self) -> Vector:
        """The direction of the blood. For a valve into a ventricle, the z axis points to the atrium, against the flow."""
        return vector(-self.matrix[:, 2] if is_atrioventricular(self.kind) else self.matrix[:, 2])

    @property
    def reference(self) -> Vector:
        return vector(self.matrix[:, 0])

    @property
    def placement(self) -> dict[str, Any]:
        """The options of riis.Surface that place the valve."""
        return {
            "scale": self.scale,
            "rotation_axis": self.rotation[:3],
            "rotation_angle": self.rotation[3],
            "translation": self.origin,
        }

    @property
    def options(self) -> dict[str, Any]:
        """All options of riis.Surface."""
        made = {"half_thickness": self.half_thickness, **self.placement}
        if self.triangulation != "adapted":
            made["triangulation"] = self.triangulation
        if self.offset != 0.0:
            made["offset"] = self.offset
        return made

    def valve(self) -> Valve | None:
        """Makes the valve, without its skirt to the wall. A surface from a file has no valve."""
        if self.surface is not None:
            return None
        made = Valve(self.kind)
        made.update(self.parameters)
        made["opening"] = self.opening
        if self.warp is not None:
            made.set_warp(self.warp.warp(self.placement))
        return made

    def valve_in(self, wall: Surface | None) -> Valve | None:
        """Makes the valve with its skirt to the wall."""
        made = self.valve()
        if made is not None and self.skirt > 0.0:
            if wall is None:
                raise refuse(f"wall: is None; the valve {self.name} has a skirt to a wall")
            made.skirt_to_wall(wall, self.skirt, **self.placement)
        return made

    def keyframes(self) -> Keyframes | None:
        source = self.surface
        if source is None or source.times is None:
            return None
        return Keyframes(source.times, source.vertices, source.faces, leaflet_id=source.leaflet_id, period=source.period)

    def has_skirt_of(self, other: ValveState) -> bool:
        """Returns whether another valve has the same skirt to the same wall."""
        names = ("kind", "parameters", "rotation", "origin", "scale", "warp", "skirt")
        return all(getattr(self, name) == getattr(other, name) for name in names)

    def made_surface(self, keyframes: Keyframes | None = None, valve: Valve | None = None) -> Surface:
        """Makes the surface, from a valve with its skirt if that is given."""
        source = self.surface
        valve = self.valve() if valve is None else valve
        if valve is not None:
            return Surface(valve, **self.options)
        assert source is not None
        if source.times is not None:
            return Surface.from_keyframes(keyframes or self.keyframes(), self.time, **self.options)  # type: ignore[arg-type]
        return Surface.from_arrays(source.vertices[0], source.faces, leaflet_id=source.leaflet_id, **self.options)


# ---- Values ----


def refuse(message: str) -> InvalidArgumentError:
    return InvalidArgumentError(message)


def number(value: Any, name: str) -> float:
    """Returns a finite number, or refuses the value with this name."""
    try:
        made = float(value) if not isinstance(value, str) else math.nan
    except (TypeError, ValueError):
        made = math.nan
    if not math.isfinite(made):
        raise refuse(f"{name}: is {value!r}; it must be a finite number")
    return made


def above_zero(value: Any, name: str) -> float:
    made = number(value, name)
    if not made > 0.0:
        raise refuse(f"{name}: is {value!r}; it must be above 0")
    return made


def at_least_zero(value: Any, name: str) -> float:
    made = number(value, name)
    if made < 0.0:
        raise refuse(f"{name}: is {value!r}; it must be at least 0")
    return made


def share(value: Any, name: str) -> float:
    made = number(value, name)
    if not 0.0 <= made <= 1.0:
        raise refuse(f"{name}: is {value!r}; it must be from 0 to 1")
    return made


def check_valve_name(value: Any) -> str:
    """Returns a name that the program accepts for a valve and its arrays."""
    if not isinstance(value, str) or not re.fullmatch("[A-Za-z0-9_.-]{1,64}", value) or value == "riis":
        raise refuse(f"name: is {value!r}; it must have 1 to 64 characters: letters, digits, _, - and ., and not riis")
    return value


def point(value: Any, name: str) -> Reals:
    """Returns three finite numbers, or refuses the value with this name."""
    try:
        made = numpy.asarray(value, numpy.float64)
    except (TypeError, ValueError):
        made = numpy.empty(0)
    if made.shape != (3,) or not numpy.isfinite(made).all():
        raise refuse(f"{name}: is {value!r}; it must be three finite numbers")
    return made


def vector(value: Any) -> Vector:
    x, y, z = (float(component) for component in value)
    return x, y, z


def plain(value: Any) -> Value:
    """Returns a parameter's value as a number or a tuple."""
    return float(value) if numpy.ndim(value) == 0 else tuple(float(component) for component in value)


def values_that_were_set(valve: Valve) -> Mapping[str, Value]:
    """Returns the parameters that were set, without the opening."""
    return MappingProxyType({name: plain(valve[name]) for name in valve if name != "opening" and valve.is_set(name)})


# ---- Parameters ----


def check_kind(kind: Any) -> str:
    if kind not in KINDS:
        raise refuse(f"kind: is {kind!r}; it must be one of {', '.join(KINDS)}")
    return str(kind)


@lru_cache(maxsize=None)
def n_leaflets(kind: str) -> int:
    """Returns the number of leaflets of a kind, without a skirt and without a housing."""
    return int(Valve(kind).read_patches().leaflet_id.max()) + 1


@lru_cache(maxsize=None)
def has_cusps(kind: str) -> bool:
    """Returns whether the leaflets are cusps, which have an effective height."""
    return any("effective_height" in (name, known.other_name) for name, known in Valve(kind).parameters.items())


def is_atrioventricular(kind: str) -> bool:
    """Returns whether a valve lets the blood into a ventricle. The leaflets of such a valve hang from an annulus."""
    return kind not in (SURFACE, "bileaflet") and not has_cusps(kind)


def _slider(name: str, unit: str, least: float, greatest: float, default: Value) -> tuple[float, float]:
    """Returns the ends of a slider. Lengths range from 0.4 to 2 times the default."""
    _, dot, size = name.rpartition(".")
    if dot and size in _SLIDERS:
        return _SLIDERS[size]
    largest = max(abs(part) for part in default) if isinstance(default, tuple) else abs(default)
    if unit == "length":
        if isinstance(default, tuple) or (least < 0 and largest == 0.0):
            return max(least, -5.0), min(greatest, 5.0)
        if largest == 0.0:
            return least, min(greatest, 1.0)
        ends = 0.4 * float(default), 2.0 * float(default)
        return max(least, min(ends)), min(greatest, max(ends))
    if greatest - least <= 720.0:
        return least, greatest
    return max(least, -max(1.0, 2.0 * largest)), min(greatest, max(1.0, 2.0 * largest))


@lru_cache(maxsize=None)
def parameters_of(kind: str) -> tuple[Parameter, ...]:
    """Returns the parameters of a kind, with the most important sizes first. A size with a surgeon's name is listed under both
    names."""
    table = Valve(check_kind(kind)).parameters
    first: list[Parameter] = []
    rest: list[Parameter] = []
    for name, known in table.items():
        if name == "opening":
            continue
        default = plain(known.default)
        low, high = _slider(name, known.unit, known.minimum, known.maximum, default)
        is_first = name in _FIRST[kind] and not known.other_name
        made = Parameter(name, known.unit, known.minimum, known.maximum, default, known.description, is_first, known.n_values,
                         low, high, known.rule, known.other_name, known.other_factor)
        (first if is_first else rest).append(made)
    by_surgeons: list[Parameter] = []
    for size in [*first, *rest]:
        if not size.other_name or any(made.name == size.other_name for made in by_surgeons):
            continue
        if size.name == size.other_name:  # such as effective_height of a coapting valve
            rest = [made for made in rest if made.name != size.name]
            by_surgeons.append(size._replace(first=True))
            continue
        factor = size.other_factor
        words = {"annulus": "diameter of the annulus", "stj": "diameter at the commissures (sinotubular junction)",
                 "effective_height": "height of the free edges above the annulus"}
        by_surgeons.append(
            size._replace(name=size.other_name, least=factor * size.least, greatest=factor * size.greatest,
                          default=factor * size.default if isinstance(size.default, float) else size.default,
                          description=words.get(size.other_name, size.description), first=True, low=factor * size.low,
                          high=factor * size.high, other_name=size.name, other_factor=1.0 / factor)
        )
    order = list(_FIRST[kind])
    first.sort(key=lambda made: order.index(made.name))
    return (*by_surgeons, *first, *rest)


def values_of(state: ValveState) -> dict[str, Value]:
    """Returns the present values of all parameters, and of surgeons' names. Sizes that follow a rule are included."""
    valve = state.valve()
    if valve is None:
        return {}
    made = {}
    for known in parameters_of(state.kind):
        if known.name in valve:
            made[known.name] = plain(valve[known.name])
        else:
            made[known.name] = float(valve[known.other_name]) / known.other_factor
    return made


def check_name(kind: str, name: str) -> None:
    """Refuses a name that no parameter has."""
    valve = Valve(kind)
    sizes = {known.size for known in parameters_of(kind)} | {part.split(".")[-1] for part in valve}
    if name not in sizes and name not in valve:
        raise UnknownParameterError(
            f"name: is {name!r}; a {kind} valve has {', '.join(sorted(sizes))}, and the view has opening, half_thickness, "
            "offset, resistance, scale and triangulation"
        )


# ---- Rotations ----


def matrix_of(rotation: tuple[float, float, float, float]) -> Reals:
    """Returns the matrix of a rotation about an axis by degrees (Rodrigues)."""
    axis = numpy.array(rotation[:3])
    axis = axis / numpy.linalg.norm(axis)
    angle = math.radians(rotation[3])
    x, y, z = axis
    cross = numpy.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])
    return numpy.asarray(numpy.eye(3) + math.sin(angle) * cross + (1.0 - math.cos(angle)) * (cross @ cross))


def rotation_of(matrix: Reals) -> tuple[float, float, float, float]:
    """Returns the axis and the degrees of a rotation matrix."""
    twist = numpy.array([matrix[2, 1] - matrix[1, 2], matrix[0, 2] - matrix[2, 0], matrix[1, 0] - matrix[0, 1]])
    sine, cosine = float(numpy.linalg.norm(twist)), float(numpy.trace(matrix)) - 1.0
    angle = math.degrees(math.atan2(sine, cosine))
    if sine > 1e-9:
        axis = twist / sine
    elif cosine > 0.0:
        return 0.0, 0.0, 1.0, 0.0
    else:  # half a turn: a column of the matrix plus 1 lies along the axis
        doubled = matrix + numpy.eye(3)
        axis = doubled[:, int(numpy.argmax(numpy.diag(doubled)))]
        axis = axis / numpy.linalg.norm(axis)
    x, y, z = vector(axis)
    return x, y, z, angle


def _unit(value: Reals, name: str) -> Reals:
    length = float(numpy.linalg.norm(value))
    if not length > 0.0:
        raise refuse(f"{name}: is {tuple(value.tolist())}; a direction must not be zero")
    return numpy.asarray(value / length)


def turned(matrix: Reals, axis: Any, reference: Any) -> Reals:
    """Returns a rotation whose z axis is along axis. Without a reference, it is the smallest rotation from the given
    orientation."""
    if axis is None and reference is None:
        return matrix
    z = matrix[:, 2] if axis is None else _unit(point(axis, "axis"), "axis")
    if reference is None:
        old = matrix[:, 2]
        sine = numpy.cross(old, z)
        length = float(numpy.linalg.norm(sine))
        if length < 1e-12:
            x = matrix[:, 0]  # the same axis, or half a turn about the valve's x axis
        else:
            degrees = math.degrees(math.atan2(length, float(old @ z)))
            x = matrix_of((*vector(sine / length), degrees)) @ matrix[:, 0]
    else:
        x = _unit(point(reference, "reference"), "reference")
    across = x - (x @ z) * z
    length = float(numpy.linalg.norm(across))
    if length < 1e-6:
        raise refuse(f"reference: is {tuple(x.tolist())}, which is along the axis {tuple(z.tolist())}")
    across = across / length
    return numpy.column_stack([across, numpy.cross(z, across), z])
