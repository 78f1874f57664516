# SPDX-License-Identifier: Apache-2.0
"""The warning of riis.mark about missing marks: the boxes of surface and mesh, and the likely reason."""

from __future__ import annotations

import warnings
from typing import Any

import numpy

from riis._errors import MarksWarning
from riis._riis import Mesh, Surface, judge_sizes, mesh_sides, units

LEAST_NODES = 1000  # smaller meshes are not judged, because a few points may lie anywhere


def _place(point: Any) -> str:
    return "(" + ", ".join(f"{float(x):.3g}" for x in point) + ")"


def box_of(mesh: Mesh, mask: Any = None) -> tuple[int, Any, Any, tuple[float, float, float]]:
    """Returns the number of a mesh's nodes, their lower and upper corner, and the sides of the mesh, the longest first."""
    if hasattr(mesh, "axes"):  # a grid
        axes = mesh.axes
        lower, upper = (numpy.array([end(axis) for axis in axes]) for end in (numpy.min, numpy.max))
        first, second, third = sorted((float(side) for side in upper - lower), reverse=True)
        return int(numpy.prod([len(axis) for axis in axes])), lower, upper, (first, second, third)
    nodes = mesh.xyz if mask is None else mesh.xyz[numpy.asarray(mask, bool)]
    if len(nodes) == 0:
        return 0, numpy.zeros(3), numpy.zeros(3), (0.0, 0.0, 0.0)
    return len(nodes), nodes.min(axis=0), nodes.max(axis=0), mesh_sides(numpy.ascontiguousarray(nodes))


def _reason_of_none(surface: Surface, lower: Any, upper: Any, spacing: float, fits: bool) -> str:
    info = surface.info
    if not fits:
        return "No usual unit explains these sizes"
    reach = 2.0 * info.half_thickness
    is_outside = (info.lower - reach > upper).any() or (info.upper + reach < lower).any()
    if not is_outside and info.half_thickness < spacing:
        return f"The half thickness is {info.half_thickness:.3g}, and the nodes are about {spacing:.1g} apart"
    beside = "lies outside the mesh" if is_outside else "may lie beside the mesh"
    return f"The surface {beside}: see translation. The middle of the mesh is {_place((lower + upper) / 2.0)}"


def warn(surface: Surface, mesh: Mesh, mask: Any, scale: float, n_marked: int) -> None:
    """Warns, at the line that called riis.mark, of a marking without marks, or with few marks and a scale that looks wrong."""
    n, lower, upper, sides = box_of(mesh, mask)
    if n < LEAST_NODES:
        return
    info = surface.info
    spacing = float(numpy.prod(sides) / n) ** (1.0 / 3.0)  # about the distance between neighbouring nodes
    fits, factor = judge_sizes(sides, (info.lower, info.upper), spacing, info.half_thickness, False)
    if factor is not None:
        unit = next((name for name, (size, _) in units().items() if numpy.isclose(size, factor * scale)), None)
        of_unit = f", for a mesh in {unit}" if unit and surface.uv is not None else ""
        reason = f"The sizes suggest scale={factor * scale:g}{of_unit}"
    elif n_marked > 0:
        return
    else:
        reason = _reason_of_none(surface, lower, upper, spacing, fits)
    found = "no node is marked" if n_marked == 0 else f"only {n_marked} of {n:,} nodes are marked"
    warnings.warn(
        f"{found}: the surface reaches from {_place(info.lower)} to {_place(info.upper)}, the mesh from {_place(lower)} to "
        f"{_place(upper)}. {reason}. If these marks are right, pass allow_none=True.",
        MarksWarning,
        stacklevel=2,
    )
