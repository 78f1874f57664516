# SPDX-License-Identifier: Apache-2.0
"""The warning of riis.mark about marks that look wrong. It names the cure as arguments that can be pasted."""

from __future__ import annotations

import functools
import math
import warnings
from typing import Any

import numpy

from riis._errors import Error, MarksWarning
from riis._riis import (
    LARGEST_HALF_THICKNESS, Adjacency, Marks, Mesh, Surface, Valve, area_samples, find_crossings, find_leaks, judge_sizes,
    mark, units,
)
from riis._tube import Reals, nodes_of

LEAST_NODES = 1000  # smaller meshes are not judged, because a few points may lie anywhere
_FEW = 100  # marks, with which another scale may be likelier
_MOST_OUT = 0.1  # of the leaflets' area, away from all nodes
_THIN = 0.45  # half thicknesses below this share of an edge leave most edges unmarked
# The vessels of heart valves have diameters between these lengths, in cm. They tell the unit of a tube.
_LEAST_VESSEL, _LARGEST_VESSEL = 0.8, 8.0
# The sizes that make a valve wide, by kind. The first are set even if the user has not set them.
_WIDTHS = {
    "mitral": ("AP_diameter", "ALPM_diameter"),
    "mitral_coapting": ("AP_diameter", "ALPM_diameter"),
    "tricuspid": ("AP_diameter", "SL_diameter"),
    "trileaflet": ("annulus", "stj"),
}
_KINDS = (*_WIDTHS, "aortic", "coapting", "bicuspid", "quadricuspid", "bileaflet")
_MOST_TURNED = 25.0  # degrees between the axes of a valve and of its tube
_FLAT = 0.3  # a valve with less than this share of its kind's height has sizes of several units


def _place(point: Any) -> str:
    return "(" + ", ".join(f"{float(x):.3g}" for x in point) + ")"


def _rounded(value: float, size: float) -> str:
    """Returns a number with the digits that matter beside a size."""
    step = 10.0 ** math.floor(math.log10(size / 300.0))
    return f"{round(value / step) * step + 0.0:.10g}"


def _triple(point: Any, size: float) -> str:
    return "(" + ", ".join(_rounded(float(x), size) for x in point) + ")"


def rounded_up(value: float) -> float:
    """Returns the next larger number with two digits."""
    step = 10.0 ** (math.floor(math.log10(value)) - 1)
    return float(f"{math.ceil(value / step * (1.0 - 1e-9)) * step:.12g}")


def box_of(mesh: Mesh) -> tuple[int, Reals, Reals]:
    """Returns the number of a mesh's nodes, and their lower and upper corner."""
    if hasattr(mesh, "axes"):  # a grid
        lower, upper = (numpy.array([end(axis) for axis in mesh.axes]) for end in (numpy.min, numpy.max))
        return int(numpy.prod([len(axis) for axis in mesh.axes])), lower, upper
    nodes = mesh.xyz
    if len(nodes) == 0:
        return 0, numpy.zeros(3), numpy.zeros(3)
    return len(nodes), nodes.min(axis=0), nodes.max(axis=0)


class _GridNodes:
    """The nodes of a grid, with the answers of riis._tube.Nodes."""

    tube = None

    def __init__(self, mesh: Mesh) -> None:
        self.n, self.lower, self.upper = box_of(mesh)
        first, second, third = sorted((float(side) for side in self.upper - self.lower), reverse=True)
        self.sides = first, second, third
        self.fine: set[Any] = set()
        self._axes = mesh.axes

    def spacing(self, place: Reals, reach: float) -> float:
        steps = []
        for axis, at in zip(self._axes, place):
            near = axis[numpy.abs(axis - at) < reach]
            steps += [float(numpy.diff(line).mean()) for line in (near if len(near) > 1 else axis,) if len(line) > 1]
        return max(steps, default=0.0)

    def are_near(self, points: Reals, reach: float) -> Any:
        return ((points > self.lower - reach) & (points < self.upper + reach)).all(axis=1)


class _Case:
    """A surface in a mesh. Lengths are in mesh units."""

    def __init__(self, surface: Surface, mesh: Mesh, nodes: Any, n_marked: int) -> None:
        self.surface, self.mesh, self.nodes, self.n_marked = surface, mesh, nodes, n_marked
        self.valve: Valve | None = surface._valve
        self.info = surface.info
        self.half = self.info.half_thickness
        self.middle = (self.info.lower + self.info.upper) / 2.0
        self.side = float((self.info.upper - self.info.lower).max())
        placement = surface._placement
        self.scale = float(placement["scale"])
        self.axis = _turned(placement["rotation_axis"], placement["rotation_angle"])
        self.translation = placement["translation"]
        self.is_off = bool((self.middle < nodes.lower).any() or (self.middle > nodes.upper).any())
        self.spacing = nodes.spacing(numpy.clip(self.middle, nodes.lower, nodes.upper), max(self.side / 2.0, self.half))
        self.reach = max(self.half, 1.1 * self.spacing)
        self.share_out = 0.0
        self.n_leaks, self.closing = 0, 0.0
        self.width = self.height = 0.0
        self.is_flat = False
        if self.valve is not None:
            is_fine = self.info.n_triangles > 100_000  # a coarser surface has the same place
            samples = area_samples(Surface(self.valve, **placement, half_thickness=self.side / 50.0) if is_fine else surface)[0]
            samples = samples[:: 1 + len(samples) // 300]
            self.share_out = float(1.0 - nodes.are_near(samples, self.reach).mean())
            self.width, self.height = (self.scale * size for size in _sizes(self.valve))
            width, height = _sizes(Valve(self.valve.kind)) if self.valve.kind in _KINDS else (1.0, 0.0)
            self.is_flat = self.height * width < _FLAT * height * self.width

    @functools.cached_property
    def vessel_scale(self) -> float | None:
        """The scale with which the tube of the mesh is as wide as vessels are. None: no usual unit gives this width."""
        if self.nodes.tube is None:
            return None
        diameter = 2.0 * self.nodes.tube.radius
        if 0.6 < self.width / diameter < 1.2 and not self.is_flat:
            return self.scale
        known = (self.scale, *(size for size, _ in units().values()))
        return next((size for size in known if _LEAST_VESSEL <= diameter / size < _LARGEST_VESSEL), None)


def _key(surface: Surface, mesh: Mesh) -> tuple[Any, ...]:
    """Returns what decides about the judgement, but not the opening."""
    kind = None if surface._valve is None else surface._valve.kind
    values = surface._placement.values()
    return kind, surface.half_thickness, mesh._has_edges, *(number for value in values for number in numpy.ravel(value))


def _turned(rotation_axis: Any, angle: float) -> Reals:
    """Returns the direction of the valve's axis."""
    axis, turn, z = rotation_axis / numpy.linalg.norm(rotation_axis), math.radians(angle), numpy.array([0.0, 0.0, 1.0])
    return numpy.array(
        z * math.cos(turn) + numpy.cross(axis, z) * math.sin(turn) + axis * axis[2] * (1.0 - math.cos(turn))
    )


def _attachment(surface: Surface) -> Reals:
    """Returns the points at which a valve is attached, or its vertices if it has no attachment."""
    try:
        points = surface.attachment.edges.reshape(-1, 3)
    except Error:
        points = surface.vertices
    return points if len(points) else surface.vertices


def _sizes(valve: Valve) -> tuple[float, float]:
    """Returns the width of a closed valve at its attachment, and its height, in its own unit."""
    closed = valve.copy()
    closed["opening"] = 0.0
    surface = Surface(closed)
    across = _attachment(surface)[:, :2]
    across = across[:: 1 + len(across) // 400]
    width = float(numpy.sqrt(((across[:, None, :] - across[None, :, :]) ** 2).sum(axis=2).max()))
    return width, float(surface.info.upper[2] - surface.info.lower[2])


def _leaks(surface: Surface, mesh: Mesh, marks: Marks) -> tuple[int, float]:
    """Returns the number of edges that cross the surface between unmarked nodes, and the half thickness that closes them."""
    if not mesh._has_edges:
        return 0, 0.0
    found = find_leaks(surface, mesh, marks)
    return found.n_edges, found.half_thickness


def _unit(scale: float) -> str | None:
    return next((name for name, (size, _) in units().items() if math.isclose(size, scale, rel_tol=1e-9)), None)


def _sized(valve: Valve, factor: float) -> tuple[Valve, dict[str, float]]:
    """Returns a copy of a valve that is wider by this factor, and the sizes that changed."""
    names = list(_WIDTHS.get(valve.kind, ("annulus",)))
    if "stj" not in names and valve.kind in ("coapting", "bicuspid", "quadricuspid") and valve.is_set("stj"):
        names.append("stj")
    changed = {name: float(f"{factor * float(valve[name]):.3g}") for name in names}
    try:
        wider = valve.copy()
        wider.update(changed)
        Surface(wider)
    except Error:  # other sizes do not fit to the new width
        wider = Valve(valve.kind)
        wider.update(changed)
    return wider, changed


def _keywords(values: dict[str, float]) -> str:
    return ", ".join(f"{name}={value:g}" for name, value in values.items())


def _advice(case: _Case, is_misplaced: bool, factor: float | None) -> tuple[list[str], str]:
    """Returns sentences about the mesh, and the calls that give a valve which fits."""
    tube, valve, scale, half = case.nodes.tube, case.valve, case.scale, case.half
    said: list[str] = []
    sizes: dict[str, float] = {}
    at, axis, size = case.middle, None, case.side
    if tube is not None and valve is not None and is_misplaced and case.vessel_scale is not None:
        diameter, scale = 2.0 * tube.radius, case.vessel_scale
        width = case.width * scale / case.scale
        said.append(
            f"The mesh looks like a tube that is {diameter:.3g} wide, along {_triple(tube.axis, 1.0)}. The valve is "
            f"{case.width:.3g} wide, along {_triple(case.axis, 1.0)}"
        )
        if case.is_flat:
            said.append(f"It is only {case.height:.3g} high, as if its sizes had several units")
        wider = valve
        if not 0.98 < width / diameter < 1.02:
            if case.is_flat:
                valve, width = Valve(valve.kind, opening=valve["opening"]), scale * _sizes(Valve(valve.kind))[0]
            wider, sizes = _sized(valve, diameter / width)
        at, axis, size = tube.middle, tube.axis if tube.axis @ case.axis > -0.5 else -tube.axis, diameter
    elif is_misplaced:
        scale = case.scale if factor is None else factor * case.scale
        size = case.side * scale / case.scale
        if case.is_off or case.n_marked == 0:
            at = (case.nodes.lower + case.nodes.upper) / 2.0
    if scale != case.scale:
        half *= scale / case.scale
        unit = _unit(scale) if valve is not None else None
        said.append(f"The sizes suggest scale={scale:g}" + (f", for a mesh in {unit}" if unit else ""))
    spacing = case.nodes.spacing(at, size / 2.0)
    most = LARGEST_HALF_THICKNESS * size
    if spacing > 0.0 and not 0.7 * spacing < half < most and not (scale != case.scale and axis is None):
        half = max(spacing, min(half, most) if half < most else 0.0)
    if case.mesh._has_edges and axis is not None:
        half = _sealing(wider, case, half, {"scale": scale, "translation": at, "axis": axis})
    elif case.n_leaks > 0:
        half = _sealing(valve, case, 1.02 * case.closing, case.surface._placement)
    if half > most * 1.001:
        said.append(f"The edges near the valve are about {spacing:.2g} long, too long for a valve of this size: refine the mesh")
        half = min(half, most)
    options = [f"scale={scale:g}"] if scale != case.scale or axis is not None else []
    if is_misplaced and at is not case.middle:
        options.append(f"translation={_triple(at, size)}")
    if axis is not None:
        options.append(f"axis={_triple(axis, 1.0)}")
    if not math.isclose(half, case.half * scale / case.scale, rel_tol=1e-6) or (
            axis is not None and not math.isclose(half, 0.1 * scale, rel_tol=1e-6)):
        options.append(f"half_thickness={half if half == case.half else rounded_up(half):g}")
    if is_misplaced and case.nodes.tube is None and len(options) == 0:
        said.append("Move or turn the valve, or make it smaller")
    if valve is None:
        return said, f"Try the options {', '.join(options)}" if options else ""
    calls = []
    if sizes:
        said.append("Sizes of a valve are in cm, and scale turns them into the unit of the mesh")
        given = {name: float(valve[name]) for name in valve if valve.is_set(name) and valve.parameters[name].n_values == 1}
        own = {name: value for name, value in given.items() if valve[name] == wider[name] and "." not in name}
        if len(own) > 3 or len(own) < sum(wider.is_set(name) for name in wider) - len(sizes):
            calls.append(f"valve.update({_keywords(sizes)})")
        else:
            calls.append(f"riis.Valve({valve.kind!r}, {_keywords(own | sizes)})")
    if options:
        calls.append(f"riis.Surface(valve, {', '.join(options)})")
    turn = ". If blood flows the other way, change the signs of axis" if axis is not None else ""
    # Without its scale, a pasted surface would stand at the origin in centimetres.
    keep = ". Keep the other arguments of riis.Surface" if options and case.scale != 1.0 and axis is None else ""
    return said, f"Try {' and '.join(calls)}{keep}{turn}" if calls else ""


def _sealing(valve: Valve | None, case: _Case, half: float, placement: dict[str, Any]) -> float:
    """Returns a half thickness with which no edge crosses the surface between unmarked nodes, at some openings of a valve."""
    if valve is None:
        return half
    for opening in (0.0, 0.5, 1.0, float(valve["opening"])):
        state = valve.copy()
        state["opening"] = opening
        for _ in range(3):
            surface = Surface(state, **placement, half_thickness=half, offset=case.info.offset)
            n, closing = _leaks(surface, case.mesh, mark(surface, case.mesh, allow_none=True))
            if n == 0:
                break
            half = 1.02 * closing
    return half


def share_outside(surface: Surface, mesh: Mesh) -> float:
    """Returns the share of the leaflets' area that is away from all nodes of a mesh. 0 for a surface without a valve."""
    return _Case(surface, mesh, nodes_of(mesh), 0).share_out


def leak_of_grid(surface: Surface, mesh: Mesh, grid: Any) -> tuple[str | None, float]:
    """Returns a sentence about the edges of a grid of PyVista that leak, and the half thickness that closes them. The grid must
    have the nodes of the mesh, and cells with straight edges."""
    cells = grid if hasattr(grid, "cells_dict") else grid.cast_to_unstructured_grid() if hasattr(grid, "n_cells") else None
    if cells is None or cells.n_points != len(mesh) or hasattr(mesh, "axes"):
        return None, 0.0
    kinds = {int(kind): numpy.asarray(ids) for kind, ids in cells.cells_dict.items()}
    if not kinds or not set(kinds) <= {10, 12, 13, 14}:  # VTK's tetrahedra, hexahedra, prisms and pyramids
        return None, 0.0
    xyz = numpy.ascontiguousarray(mesh.xyz)
    if not numpy.allclose(xyz, cells.points, rtol=1e-5, atol=1e-5 * float(numpy.ptp(xyz, axis=0).max())):
        return None, 0.0
    ids = numpy.concatenate([table.ravel() for table in kinds.values()]).astype(numpy.int64)
    lengths = numpy.concatenate([numpy.full(len(table), table.shape[1], numpy.int64) for table in kinds.values()])
    meshed = Mesh(xyz)
    meshed.set_adjacency(Adjacency.from_cells(ids, len(xyz), offsets=numpy.concatenate([[0], lengths.cumsum()])))
    case = _Case(surface, meshed, nodes_of(meshed), 0)
    case.n_leaks, case.closing = _leaks(surface, meshed, mark(surface, meshed, allow_none=True))
    if case.n_leaks == 0:
        return None, 0.0
    half = _sealing(case.valve, case, 1.02 * case.closing, surface._placement)
    return _of_leaks(case.n_leaks), rounded_up(half)


def _of_leaks(n: int) -> str:
    edges = "1 edge of the mesh crosses" if n == 1 else f"{n:,} edges of the mesh cross"
    return f"{edges} the leaflets between unmarked nodes, so the valve leaks there"


def _beside(case: _Case) -> str | None:
    """Says if a valve stands obliquely in its tube, or if blood passes between both."""
    if case.nodes.tube is None or case.valve is None:
        return None
    here = case.nodes.tube_near(case.translation)
    if here is None or numpy.linalg.norm(here.middle - case.translation) > 0.5 * here.radius:
        return None
    turn = math.degrees(math.acos(min(1.0, abs(float(here.axis @ case.axis)))))
    if turn > _MOST_TURNED:
        return f"The axis of the valve is turned by {turn:.0f} degrees from the tube"
    if case.info.skirt_leaflet_id >= 0:
        return None
    gap = here.radius - case.width / 2.0
    if gap < 1.1 * case.half or gap < 0.05 * here.radius:
        return None
    return f"A gap of about {gap:.2g} between the valve and the tube is wider than the half thickness, so blood passes there"


def _crossing(case: _Case) -> str | None:
    """Says if leaflets go through each other, as the library's log does."""
    if case.valve is None or case.valve.kind == "bileaflet":  # its hinges reach into the housing
        return None
    found = find_crossings(case.surface, depth=min(1.0, max(1e-6, case.info.contact_depth / case.half)))
    if found.n_pairs == 0:
        return None
    one, other = (int(leaflet) for leaflet in found.deepest_leaflet_id)
    who = f"Leaflet {one} goes through itself" if one == other else f"Leaflets {one} and {other} go through each other"
    return f"{who}, up to {found.deepest_depth:.2g} deep: change the sizes. riis.find_crossings lists the places"


def _judge(surface: Surface, mesh: Mesh, mask: Any, marks: Marks) -> str | None:
    """Returns the text of a warning, or None if the marks look right."""
    is_grid = hasattr(mesh, "axes")
    nodes: Any = _GridNodes(mesh) if is_grid else nodes_of(mesh, mask)
    if nodes is None or nodes.n < LEAST_NODES:
        return None
    n_marked, n = len(marks), nodes.n
    key = _key(surface, mesh)
    if key in nodes.fine and n_marked >= _FEW:
        return None
    case = _Case(surface, mesh, nodes, n_marked)
    sides = nodes.sides
    even = float(numpy.prod(sides) / n) ** (1.0 / 3.0)
    fits, factor = judge_sizes(sides, (case.info.lower, case.info.upper), even, case.half, False)
    reach = case.reach
    is_outside = bool((case.info.lower - reach > nodes.upper).any() or (case.info.upper + reach < nodes.lower).any())
    is_out = n_marked == 0 or case.share_out > _MOST_OUT or (n_marked < _FEW and factor is not None) or (
        case.is_flat and case.vessel_scale not in (None, case.scale))
    beside = None if is_out else _beside(case)
    is_thick = case.half > LARGEST_HALF_THICKNESS * case.side
    is_thin = not is_outside and case.half < _THIN * case.spacing
    if not is_out and not is_thick and not is_thin:
        n_leaks, case.closing = _leaks(surface, mesh, marks)
        case.n_leaks = n_leaks if case.closing > 1.001 * case.half else 0
    crossing = None if is_out or is_thick or is_thin else _crossing(case)
    if not (is_out or beside or is_thick or is_thin or case.n_leaks or crossing):
        nodes.fine.add(key)
        return None
    is_only_thin = is_thin and case.share_out <= _MOST_OUT and not case.is_flat and factor is None
    is_misplaced = (is_out and not is_only_thin) or beside is not None
    said: list[str] = []
    about, advice = _advice(case, is_misplaced, factor)
    if is_outside and factor is None:
        said.append("The surface lies outside the mesh")
    elif is_misplaced and case.share_out > _MOST_OUT and n_marked > 0:
        said.append(f"About {100 * case.share_out:.0f} % of the leaflets' area lies outside the mesh")
    elif n_marked == 0 and not is_thin and factor is None:
        said.append("The surface may lie beside the mesh")
    if n_marked == 0 and not fits and not about:
        said.append("No usual unit explains these sizes")
    said += about
    if beside:
        said.append(beside)
    if is_thick:
        said.append(f"The half thickness is {case.half:.3g}, and the largest side of the surface {case.side:.3g}")
    elif is_only_thin:
        said.append(
            f"The half thickness is {case.half:.3g}, and the nodes are about {case.spacing:.2g} apart: blood passes between the "
            "marked nodes"
        )
    elif case.n_leaks:
        said.append(_of_leaks(case.n_leaks))
    if crossing:
        said.append(crossing)
    few = "no node is marked" if n_marked == 0 else (
        f"only {n_marked} of {n:,} nodes {'is' if n_marked == 1 else 'are'} marked" if n_marked < _FEW
        else f"all {n:,} nodes are marked" if n_marked == n else f"{n_marked:,} of {n:,} nodes are marked")
    if is_misplaced or n_marked == 0 or is_thick:
        few += (
            f": the surface reaches from {_place(case.info.lower)} to {_place(case.info.upper)}, the mesh from "
            f"{_place(nodes.lower)} to {_place(nodes.upper)}"
        )
    return ". ".join([few, *said, *([advice] if advice else []), "If these marks are right, pass allow_none=True."])


def warn(surface: Surface, mesh: Mesh, mask: Any, marks: Marks) -> None:
    """Warns at the line that called riis.mark, if the marks look wrong."""
    try:
        text = _judge(surface, mesh, mask, marks)
    except Error:  # the caller or another thread has changed the valve since the surface was made
        return
    if text is not None:
        warnings.warn(text, MarksWarning, stacklevel=2)
