# SPDX-License-Identifier: Apache-2.0
"""The lights of the view name the faults of a valve in a mesh, their places and their remedies.

The size limits are those of the program's warnings (riis help warnings), from the same sources.
"""

from __future__ import annotations

import dataclasses
import math
from dataclasses import dataclass, field

import numpy
from numpy.typing import NDArray

from riis._errors import Error
from riis._place import UNITS, WORDS_OF_UNITS
from riis._riis import (
    LARGEST_HALF_THICKNESS, MOST_OUTSIDE, USUAL_HALF_THICKNESS, Marks, Surface, area_samples, find_crossings, find_leaks,
    find_passage, judge_sizes,
)
from riis.view._cells import Region, WholeMesh
from riis.view._numbers import shown, with_unit
from riis.view._valves import ValveState
from riis.view._walls import MOST_BEYOND, Wall

Reals = NDArray[numpy.float64]

NAMES = ("unit", "inside", "half_thickness", "crossing", "wall", "sealed")  # in the order in which faults are corrected
LEVELS = ("bad", "warn", "good", "off")  # the worst first

_MOST_DRAWN = 300  # crossing pairs that are drawn

_NO_POINTS = numpy.empty((0, 3))
_NO_EDGES = numpy.empty((0, 2, 3))


@dataclass(frozen=True)
class Light:
    """A light says, with numbers, whether one property of the valves is right. If it is wrong, the light says what to do."""

    name: str  #: one of "unit", "inside", "half_thickness", "crossing", "wall" and "sealed"
    level: str  #: "good", "warn", "bad", or "off" if the light does not apply
    text: str  #: what this means for the present valves, with numbers
    advice: str = ""  #: what to do
    cure: tuple[str, str] | None = None  #: the label of a button, and the name that Model.cure takes
    points: Reals = field(default_factory=lambda: _NO_POINTS, repr=False)  #: (n, 3): places to draw
    edges: Reals = field(default_factory=lambda: _NO_EDGES, repr=False)  #: (n, 2, 3): lines to draw
    valve: int = -1  #: the valve to which the light belongs; -1: none
    value: float = 0.0  #: the length or the factor that the remedy uses


@dataclass
class Scene:
    """A valve in the mesh, as the lights judge it."""

    number: int
    state: ValveState
    surface: Surface
    marks: Marks
    region: Region
    whole: WholeMesh
    unit: str | None
    given_wall: Wall | None = None  #: from a file. None: the boundary of the cells is the wall

    @property
    def largest_side(self) -> float:
        info = self.surface.info
        return float((info.upper - info.lower).max())

    @property
    def box(self) -> WholeMesh | Wall:
        """The mesh, or the wall if there is no mesh."""
        if self.whole.is_missing and self.given_wall is not None:
            return self.given_wall
        return self.whole

    @property
    def word(self) -> str:
        """The word for what the box encloses."""
        return "wall" if self.whole.is_missing else "mesh"

    def length(self, value: float) -> str:
        return with_unit(value, self.unit)

    def place(self, point: Reals) -> str:
        """Returns a point with the unit of the mesh. A coordinate that is tiny beside the valve is shown as 0."""
        least = 1e-4 * self.largest_side
        texts = [shown(float(x) if abs(x) > least else 0.0) for x in point]
        return "(" + ", ".join(texts) + ")" + (f" {self.unit}" if self.unit else "")


def counted(n: int, noun: str) -> str:
    """Returns a number with its noun, such as "1 node" or "12,345 nodes"."""
    return f"{n:,} {noun}" + ("" if n == 1 else "s")


def rounded_up(length: float) -> float:
    """Returns the next larger number with three digits."""
    step = 10.0 ** (math.floor(math.log10(length)) - 2)
    return float(f"{math.ceil(length / step) * step:.12g}")


# ---- Sizes ----


def _edge_of(region: Region) -> float:
    """Returns the median length of the edges of a sample of cells; 0 without cells."""
    lengths = []
    for block in region.blocks:
        table = block.nodes[:: max(1, len(block.nodes) // 20_000)]
        if len(table):
            lengths.append(numpy.linalg.norm(region.points[table[:, 0]] - region.points[table[:, 1]], axis=1))
    return float(numpy.median(numpy.concatenate(lengths))) if lengths else 0.0


def unit(scene: Scene) -> Light:
    """Judges whether mesh and valve have the same unit."""
    side, mesh = scene.largest_side, float((scene.box.upper - scene.box.lower).max())
    if mesh == 0.0:
        return Light("unit", "off", f"the {scene.word} has no extent", valve=scene.number)
    sizes = f"the largest side of the {scene.word} is {scene.length(mesh)}, that of the valve {scene.length(side)}"
    known = scene.unit is not None and math.isclose(scene.state.scale, UNITS[scene.unit], rel_tol=1e-9)
    info = scene.surface.info
    fits, factor = judge_sizes(scene.box.sides, (info.lower, info.upper), _edge_of(scene.region), scene.state.half_thickness,
                               known)
    if factor is None:
        level, text = ("warn", sizes + ", which no unit explains") if not fits else ("good", sizes)
        return Light("unit", level, text, "look at the scale" if not fits else "", valve=scene.number)
    scale = factor * scene.state.scale
    name = next((known for known, size in UNITS.items() if math.isclose(size, scale, rel_tol=1e-9)), None)
    if name is None:
        advice, label = f"scale the valve by {factor:g}", f"scale the valve by {factor:g}"
    else:
        words = WORDS_OF_UNITS[name]
        advice = f"the {scene.word} looks as if it were in {words}: scale the valve by {factor:g}"
        label = f"The {scene.word} is in {words}"
    return Light("unit", "warn" if fits else "bad", sizes, advice, (label, "unit"), valve=scene.number, value=factor)


def inside(scene: Scene) -> Light:
    """Judges whether the valve lies in the mesh. A skirt may reach beyond the wall."""
    samples, area = area_samples(scene.surface)
    info = scene.surface.info
    wall = scene.given_wall.outward if scene.whole.is_missing and scene.given_wall else scene.region.wall()
    if wall is not None:
        found = wall.closest_points(samples, side=True, point=False, normal=False, triangle_id=False, leaflet_id=False)
        assert found.side is not None and found.distance is not None
        is_out = (found.side > 0) & (found.distance > info.half_thickness)
    else:
        low, high = scene.region.points.min(axis=0, initial=math.inf), scene.region.points.max(axis=0, initial=-math.inf)
        is_out = ((samples < low - info.half_thickness) | (samples > high + info.half_thickness)).any(axis=1)
    share, n_marked = float(area[is_out].sum() / area.sum()), len(scene.marks)
    cure = (f"Move the valve into the {scene.word}", "inside")
    no_marks = n_marked == 0 and not scene.whole.is_missing
    if no_marks or is_out.all():
        places = (
            f"the valve is at {scene.place((info.lower + info.upper) / 2)}, the {scene.word} from {scene.place(scene.box.lower)} "
            f"to {scene.place(scene.box.upper)}"
        )
        return Light("inside", "bad", f"no node is marked: {places}" if no_marks else f"the valve is outside: {places}",
                     "move the valve, or click three points of the annulus", cure, valve=scene.number)
    percent = f"{100 * share:.{1 if share < 0.1 else 0}f} %"
    outside = f"{percent} of the leaflets' area is farther than the half thickness outside the {scene.word}"
    if share > MOST_OUTSIDE:
        points = samples[is_out]
        return Light("inside", "warn", outside, "move or turn the valve, or make it smaller",
                     points=points[:: 1 + len(points) // _MOST_DRAWN], valve=scene.number)
    if scene.whole.is_missing:
        text = "the valve lies inside the wall"
        return Light("inside", "good", text + (f"; {outside}" if share > 0.0005 else ""), valve=scene.number)
    text = f"{counted(n_marked, 'node')} {'is' if n_marked == 1 else 'are'} marked"
    return Light("inside", "good", text + (f"; {outside}" if share > 0.0005 else ""),
                 valve=scene.number)


def _no_edges(scene: Scene, what: str) -> str:
    if scene.whole.is_missing:
        return f"{what} needs a mesh, and there is only a wall"
    if not scene.region.has_cells:
        return "there are no volume cells near the valve, so the edges of the mesh are unknown"
    return "the mesh has cells of a type whose edges the view does not know"


def half_thickness(scene: Scene) -> Light:
    """Judges whether the band is thick enough for the mesh's edges, and thin compared with the valve."""
    half, side = scene.state.half_thickness, scene.largest_side
    if half > LARGEST_HALF_THICKNESS * side:
        better = float(f"{USUAL_HALF_THICKNESS * side:.2g}")
        return Light("half_thickness", "bad", f"the half thickness is {scene.length(half)}, the valve's largest side "
                     f"{scene.length(side)}",
                     "make it thinner", (f"Set the half thickness to {scene.length(better)}", "half_thickness"),
                     valve=scene.number, value=better)
    if not scene.region.has_edges:
        return Light("half_thickness", "off", _no_edges(scene, "the light of the half thickness"), valve=scene.number)
    if len(scene.marks) == 0:
        return Light("half_thickness", "off", "no node is marked", valve=scene.number)
    scene.region.adjacency()
    across = scene.marks.cells_across(scene.region.mesh)
    leaks = find_leaks(scene.surface, scene.region.mesh, scene.marks)
    text = f"the half thickness is {scene.length(half)}, and {shown(across.mean)} edges of the mesh lie across the band"
    if leaks.n_edges == 0:
        return Light("half_thickness", "good", text, valve=scene.number)
    ends = scene.region.points[leaks.node_id]
    text += (
        f"; {counted(leaks.n_edges, 'edge')} {'crosses' if leaks.n_edges == 1 else 'cross'} the leaflets between unmarked nodes, "
        f"the longest {scene.length(leaks.longest_length)}"
    )
    better = rounded_up(1.01 * leaks.half_thickness)
    if better > LARGEST_HALF_THICKNESS * side:
        advice = (
            f"the mesh is too coarse for this valve: a half thickness of {scene.length(better)} would be needed, so refine the "
            "mesh near the leaflets"
        )
        return Light("half_thickness", "bad", text, advice, points=ends.mean(axis=1), edges=ends, valve=scene.number)
    return Light("half_thickness", "bad", text, f"a half thickness of {scene.length(better)} closes them, or a finer mesh",
                 (f"Set the half thickness to {scene.length(better)}", "half_thickness"), points=ends.mean(axis=1), edges=ends,
                 valve=scene.number, value=better)


# ---- The valve itself ----


def crossing(scene: Scene) -> Light:
    """Judges whether leaflets go through each other. Contacts do not count, and hinges in their housing do not count either."""
    surface, state = scene.surface, scene.state
    info = surface.info
    if state.kind == "bileaflet":
        surface = dataclasses.replace(state, parameters={**state.parameters, "ring_height": 0.0}).made_surface()
    depth = min(1.0, max(1e-6, info.contact_depth / info.half_thickness))
    found = find_crossings(surface, depth=depth)
    if found.n_pairs == 0:
        return Light("crossing", "good", "no leaflet goes through another", valve=scene.number)
    vertices, faces = surface.vertices, surface.triangles
    row = numpy.searchsorted(faces.triangle_id, found.triangle_id[:_MOST_DRAWN].ravel())
    corners = vertices[faces.vertex_id[row]]
    edges = numpy.concatenate([corners[:, [0, 1]], corners[:, [1, 2]], corners[:, [2, 0]]])
    names = [int(leaflet) for leaflet in found.deepest_leaflet_id]
    text = (
        f"{counted(found.n_pairs, 'pair')} of triangles {'goes' if found.n_pairs == 1 else 'go'} through each other, up to "
        f"{scene.length(found.deepest_depth)} deep, at "
        f"{scene.place(found.deepest_point)} (leaflets {names[0]} and {names[1]})"
    )
    is_slight = found.deepest_depth < 0.1 * info.half_thickness
    return Light("crossing", "warn" if is_slight else "bad", text, "change the sizes; undo takes the last change back",
                 points=numpy.array(found.point[:_MOST_DRAWN]), edges=edges, valve=scene.number)


def wall(scene: Scene) -> Light:
    """Judges the gap between the valve's attachment and the wall."""
    state, given = scene.state, scene.given_wall
    boundary = None if given is not None or not scene.region.has_cells else scene.region.wall()
    if given is None and boundary is None:
        return Light("wall", "off", "the mesh has no wall near the valve", valve=scene.number)
    if state.kind == "bileaflet":
        around = boundary if given is None else given.outward
        assert around is not None
        return _ring(scene, around)
    if state.surface is not None:
        return Light("wall", "off", "the attachment of a surface from a file is unknown", valve=scene.number)
    bare = scene.surface if state.skirt == 0.0 else dataclasses.replace(state, skirt=0.0).made_surface()
    try:
        gap = given.gap(bare) if boundary is None and given is not None else bare.gap(boundary)  # type: ignore[arg-type]
    except Error as error:
        return Light("wall", "off", str(error), valve=scene.number)
    attachment = numpy.array(bare.attachment.edges)
    missed = gap.distance >= 1e29
    valve = state.valve()
    assert valve is not None
    skirt = state.skirt or float(valve["skirt_length"]) * state.scale
    wide = (gap.distance > skirt + _beyond_rim(state)) & ~missed
    drawn = attachment[wide.any(axis=1) | missed.any(axis=1)]
    n_ends = gap.distance.size
    if gap.n_without_wall == n_ends:
        return Light("wall", "bad", "no part of the attachment has a wall beside it", "move or turn the valve", edges=drawn,
                     valve=scene.number)
    text = f"the wall is {shown(gap.least)} to {scene.length(gap.most)} from the attachment"
    if skirt > 0.0:
        at_most = "reaches it, and is at most" if state.skirt > 0.0 else "is"
        text += f"; the skirt {at_most} {scene.length(skirt)} long"
    if gap.n_without_wall > 0:
        return Light("wall", "warn", f"{text}; {100 * gap.n_without_wall / n_ends:.0f} % of the attachment has no wall beside it",
                     "move or turn the valve", edges=drawn, valve=scene.number)
    if state.skirt > 0.0:
        assert given is not None
        return _reach(scene, text, given)
    if not wide.any():
        return Light("wall", "good", text, valve=scene.number)
    needed = rounded_up(1.02 * gap.most)
    if given is not None:  # the attachment moves as the valve opens
        needed = rounded_up(1.02 * given.widest(state).gap)
    advice = "make the annulus larger, or give the valve a skirt to the wall"
    cure = None
    if needed < 0.5 * scene.largest_side:
        cure = (f"A skirt of {scene.length(needed)} to the wall", "wall")
    else:
        advice = "move the valve, or make its annulus larger: the gap is too wide for a skirt"
    return Light("wall", "bad", f"{text}: blood passes beside the valve", advice, cure, points=gap.widest_point[None, :],
                 edges=drawn, valve=scene.number, value=needed if given is not None else needed / state.scale)


def _reach(scene: Scene, text: str, given: Wall) -> Light:
    """Judges whether a skirt to the wall is long enough at all openings, as the program does."""
    widest, opening, _ = given.widest(scene.state)
    if widest <= (1.0 + MOST_BEYOND) * scene.state.skirt:
        return Light("wall", "good", text, valve=scene.number)
    needed = rounded_up(1.02 * widest)
    return Light(
        "wall", "bad", f"{text}; at the opening {shown(opening)} the wall is up to {scene.length(widest)} away",
        "the attachment moves as the valve opens: take a longer skirt",
        (f"A skirt of at most {scene.length(needed)}", "wall"), valve=scene.number, value=needed,
    )  # fmt: skip


def _beyond_rim(state: ValveState) -> float:
    """Returns how far the band extends beyond a rim, along the leaflet. With an offset it is a chord of the band's round end."""
    return state.half_thickness * math.sqrt(1.0 - state.offset**2)


def _ring(scene: Scene, boundary: Surface) -> Light:
    """Judges the distance from the wall to a bileaflet valve's housing, or to its circle without a housing."""
    state, valve = scene.state, scene.state.valve()
    assert valve is not None
    turn = numpy.linspace(0.0, 2.0 * math.pi, 72, endpoint=False)
    height = float(valve["ring_height"])
    levels = numpy.linspace(-height / 2.0, height / 2.0, 5 if height > 0.0 else 1)
    circle = valve["radius"] * numpy.column_stack([numpy.cos(turn), numpy.sin(turn)])
    own = numpy.concatenate([numpy.column_stack([circle, numpy.full(72, z)]) for z in levels])
    ring = state.scale * own @ state.matrix.T + numpy.array(state.origin)
    found = boundary.closest_points(ring, side=True, point=False, normal=False, triangle_id=False, leaflet_id=False)
    assert found.side is not None and found.distance is not None
    gap = numpy.where(found.side > 0, -found.distance, found.distance)
    least, most = shown(float(gap.min())), scene.length(float(gap.max()))
    text = f"the wall is {least} to {most} from the {'housing' if height else 'annulus'}"
    # If the wall meets one of the housing's circles at each angle, it seals the valve. The housing's normals point outwards.
    reach = (1.0 + state.offset) * state.half_thickness if height > 0.0 else _beyond_rim(state)
    is_open = (gap.reshape(len(levels), 72) > reach).all(axis=0)
    if not is_open.any():
        return Light("wall", "good", text, valve=scene.number)
    return Light("wall", "bad", f"{text}: blood passes beside the valve", "make the annulus (radius) larger",
                 points=ring[numpy.tile(is_open, len(levels))], valve=scene.number)


def sealed(scene: Scene) -> Light:
    """Judges whether unmarked nodes connect the two sides of the valve, and shows the path."""
    if not scene.region.has_edges:
        return Light("sealed", "off", _no_edges(scene, "whether the valve seals"), valve=scene.number)
    if len(scene.marks) == 0:
        return Light("sealed", "off", "no node is marked", valve=scene.number)
    ends = _sides(scene)
    if ends is None:
        return Light("sealed", "off", "the mesh has no nodes on both sides of the valve, near its axis", valve=scene.number)
    region = scene.region
    region.adjacency()
    found = find_passage(scene.surface, region.mesh, numpy.array([ends[0]]), numpy.array([ends[1]]))
    if found.state == "none":
        return Light("sealed", "off", "the mesh itself does not join the two sides of the valve", valve=scene.number)
    if found.state == "closed":
        return Light("sealed", "good", f"sealed: a half thickness down to {scene.length(found.distance)} would seal it",
                     valve=scene.number)
    is_open = numpy.ones(len(region.points), bool)
    is_open[scene.marks.ids] = False
    if is_open[found.node_id]:
        halves = region.path(ends[0], found.node_id, is_open), region.path(found.node_id, ends[1], is_open)
        nodes = numpy.concatenate([halves[0], halves[1][1:]])
    else:
        nodes = region.path(ends[0], ends[1], is_open)
    line = region.points[nodes]
    edges = numpy.stack([line[:-1], line[1:]], axis=1) if len(line) > 1 else _NO_EDGES
    # With an offset, the passage is as wide as the half thickness that closes it.
    offset = scene.state.offset
    width = scene.length(found.distance)
    text = f"a passage is open at {scene.place(found.point)}, " + (
        f"{width} from the leaflets" if offset == 0.0 else f"which a half thickness of {width} marks"
    )
    points = numpy.array(found.point)[None, :]
    if scene.state.opening > 0.0:
        return Light("sealed", "off", f"the valve is open ({shown(scene.state.opening)}): {text}",
                     "set the opening to 0 to see whether it seals", points=points, edges=edges, valve=scene.number)
    advice = "look at the light wall and at the half thickness"
    if scene.state.kind == "aortic":
        advice = "the paper's aortic valve does not close between its cusps: the kind coapting does; or " + advice
    if offset != 0.0:
        advice = "bring the offset nearer to 0, because the bands of two leaflets part; or " + advice
    better = rounded_up(1.01 * found.distance)
    cure = None
    if better <= min(LARGEST_HALF_THICKNESS * scene.largest_side, 2.0 * scene.state.half_thickness):
        length = scene.length(better)
        advice, cure = f"a half thickness of {length} closes it", (f"Set the half thickness to {length}", "sealed")
    return Light("sealed", "bad", f"leaking: {text}", advice, cure, points=points, edges=edges, valve=scene.number, value=better)


def _sides(scene: Scene) -> tuple[int, int] | None:
    """Returns an unmarked node on each side of the valve near its axis: one below the smallest z of the valve, and one above the
    largest z."""
    matrix, origin = scene.state.matrix, numpy.array(scene.state.origin)
    valve = (numpy.array(scene.surface.vertices) - origin) @ matrix
    middle = (valve[:, :2].min(axis=0) + valve[:, :2].max(axis=0)) / 2.0
    radius = float((valve[:, :2].max(axis=0) - valve[:, :2].min(axis=0)).max()) / 2.0
    low, high = float(valve[:, 2].min()), float(valve[:, 2].max())
    nodes = (scene.region.points - origin) @ matrix
    away = numpy.linalg.norm(nodes[:, :2] - middle, axis=1)
    is_free = numpy.ones(len(nodes), bool)
    is_free[scene.marks.ids] = False
    half = scene.state.half_thickness
    chosen = []
    for sign, level in ((-1.0, low), (1.0, high)):
        height = sign * (nodes[:, 2] - level)  # beyond the valve's end
        for reach in (0.6, 1.2):
            is_near = is_free & (height > half) & (height < 2.0 * radius) & (away < reach * radius)
            if is_near.any():
                at = numpy.flatnonzero(is_near)
                far = (height[at] - half - 0.4 * radius) ** 2 + away[at] ** 2
                chosen.append(int(at[numpy.argmin(far)]))
                break
    return (chosen[0], chosen[1]) if len(chosen) == 2 else None


JUDGES = {
    "unit": unit, "inside": inside, "half_thickness": half_thickness, "crossing": crossing, "wall": wall, "sealed": sealed,
}


def worst(lights: list[Light]) -> Light:
    """Returns the worst light of several valves for each subject."""
    return min(lights, key=lambda light: LEVELS.index(light.level))
