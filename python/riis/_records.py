# SPDX-License-Identifier: Apache-2.0
"""Named tuples that the calls of riis return."""

from __future__ import annotations

from typing import Literal, NamedTuple

import numpy
from numpy.typing import NDArray

Reals = NDArray[numpy.float64]
Ids = NDArray[numpy.int64]
Integers = NDArray[numpy.int32]


class Parameter(NamedTuple):
    """The description of a valve's parameter."""

    name: str
    unit: Literal["length", "degree", "1"]
    description: str
    n_values: int  #: 1 or 3
    default: float | Reals  #: (3,) for three values
    minimum: float  #: of every value, inclusive
    maximum: float  #: of every value, inclusive
    rule: str = ""  #: value of a parameter that was not set, such as "0.5 leaflet_height"; "": the default
    other_name: str = ""  #: second name that sets it, such as "annulus"; "": none
    other_factor: float = 0.0  #: the factor from the parameter's value to the value of other_name


class SurfaceInfo(NamedTuple):
    """The size of a surface, and the seconds that its last creation or update took."""

    n_vertices: int
    n_triangles: int
    n_zero_area: int  #: triangles that were skipped because they have no area
    half_thickness: float  #: mesh units, like all lengths here
    area: float
    lower: Reals  #: (3,), bounds of the triangles
    upper: Reals  #: (3,), bounds of the triangles
    seconds_triangles: float
    seconds_scene: float
    error_bound: float  #: distances to the triangles and to the smooth valve differ by at most this length
    largest_leaflet_id: int  #: of the triangles
    offset: float  #: of the band, in half thicknesses
    contact_depth: float  #: deeper crossings of triangles are no contacts of leaflets
    skirt_leaflet_id: int  #: -1 without a skirt
    housing_leaflet_id: int  #: of a bileaflet valve; -1 for other surfaces


class Triangles(NamedTuple):
    """The triangles of a surface."""

    vertex_id: Ids  #: (n, 3)
    triangle_id: Ids  #: (n,), ascending: the ids that queries report
    leaflet_id: Integers  #: (n,), see Leaflet
    patch_id: Integers  #: (n,)


class Direction(NamedTuple):
    """The rates of a surface along a direction: the derivatives by the parameter."""

    rates: Reals  #: (n_vertices, 3), of the vertices; within a triangle the rate is linear
    area_rate: float  #: of the surface's area


class Attachment(NamedTuple):
    """The edges at which tissue or a stent holds the leaflets of a valve. A bileaflet valve has no such edges."""

    edges: Reals  #: (n, 2, 3): both ends of each
    vertex_id: Ids  #: (n, 2): the vertices at the ends
    leaflet_id: Integers  #: (n,): the leaflet that is attached there
    patch_id: Integers  #: (n,): its patch


class ValvePatches(NamedTuple):
    """The curves and patches of a valve. If every curve has one piece, Valve.from_patches takes these arrays."""

    first_piece: Ids  #: (n_curves + 1,): the pieces of curve i are first_piece[i] to first_piece[i + 1] - 1
    degree: Integers  #: (n_pieces,): 2 or 3
    control: Reals  #: (sum of degree + 1, 3): control points, piece after piece
    curve_id: Integers  #: (n_patches, 4): the curves at v = 0, v = 1, u = 0, u = 1
    reversed: Integers  #: (n_patches, 4): 1 if the side runs against its curve
    leaflet_id: Integers  #: (n_patches,)
    patch_id: Integers  #: (n_patches,)
    attached: Integers  #: (n_patches,): the side that is attached, 0 to 3 in the order of curve_id, or -1
    bulge: Reals  #: (n_patches,): 0 for a Coons patch, otherwise the factor of its arcs from v = 0 to v = 1


class WarpInfo(NamedTuple):
    """The quality of a warp, in the units of its landmarks."""

    n_landmarks: int
    rms_residual: float  #: root mean square of the distances between mapped sources and targets
    largest_residual: float  #: the largest distance between a mapped source and its target
    largest_landmark_id: int  #: its landmark
    smoothing: float  #: lambda of the smoothing; 0 without noise, infinite if the map is affine
    least_determinant: float  #: of the map's derivative, half way from each landmark to the nearest other one
    least_point: Reals  #: (3,): the point between the sources where the determinant is least
    is_planar: bool  #: the landmarks lie nearly in a plane


class ClosestPoint(NamedTuple):
    """The closest point of a surface to one point."""

    distance: float  #: mesh units
    point: Reals  #: (3,), on the triangle
    barycentric: Reals  #: (3,), the point's barycentric coordinates
    normal: Reals  #: (3,), unit normal of the triangle
    triangle_id: int
    leaflet_id: int
    side: int  #: +1 on the side of the normals (downstream), -1 on the other side, 0 on the surface or level with its rim


class ClosestPoints(NamedTuple):
    """The closest points to many points, as in ClosestPoint. An array that was not requested is None."""

    distance: Reals | None  #: (n,)
    point: Reals | None  #: (n, 3)
    barycentric: Reals | None  #: (n, 3)
    normal: Reals | None  #: (n, 3)
    triangle_id: Ids | None  #: (n,)
    leaflet_id: Integers | None  #: (n,)
    side: Integers | None  #: (n,)


class MarkStats(NamedTuple):
    """The statistics of a marking."""

    n_nodes: int  #: number of the mesh's nodes
    n_marked: int
    n_within_limit: int
    n_queries: int  #: number of closest-point queries
    seconds: float
    search: str  #: the search that ran
    n_threads: int  #: the largest number of threads in any part
    complete: bool  #: whether every node within the limit was certainly found
    instructions: str  #: the instructions that were used
    n_unreached: int  #: nodes that the neighbour search found only by its final check


class Dense(NamedTuple):
    """Arrays with an entry for every node of the mesh. An array that was not requested is None."""

    mark: NDArray[numpy.bool_] | None
    distance: Reals | None
    triangle_id: Ids | None
    leaflet_id: Integers | None


class BandSums(NamedTuple):
    """Sums on each side of the surface: entry 0 is upstream, entry 1 downstream. The mean is sum / weight."""

    sum: Reals  #: (2,), the sum of weight * value
    weight: Reals  #: (2,), the sum of weight
    n_nodes: Ids  #: (2,), number of nodes in the band


class Leaks(NamedTuple):
    """Mesh edges that cross the surface between two unmarked nodes, ascending. Lengths are in mesh units."""

    n_edges: int
    node_id: Ids  #: (n, 2), the lower id first
    length: Reals  #: (n,)
    distance: Reals  #: (n,): the half thickness that closes the edge
    half_thickness: float  #: the smallest half thickness that gives each edge a marked node
    longest_node_id: Ids  #: (2,), -1 if there is no edge
    longest_length: float
    longest_middle: Reals  #: (3,)
    seconds: float


class Passage(NamedTuple):
    """The widest passage from one set of nodes to another."""

    state: Literal["closed", "open", "none"]  #: "none": the mesh has no path at all
    node_id: int  #: the node at the passage's narrowest point, -1 without a path
    distance: float  #: the smallest half thickness that closes the passage
    point: Reals  #: (3,), the node's coordinates
    seconds: float


class FirstPassage(NamedTuple):
    """The opening at which a valve first leaves a passage through a mesh."""

    state: Literal["found", "always", "never", "none"]  #: "always": open at 0; "none": the mesh itself has no path
    opening: float  #: the first opening with a passage; 0 for "always" and "none", 1 for "never"
    closed_opening: float  #: the largest tried opening below it
    node_id: int  #: the passage at the opening, as in Passage
    distance: float  #: as in Passage
    point: Reals  #: (3,), as in Passage
    n_openings: int  #: number of openings that were tried
    seconds: float


class ByArea(NamedTuple):
    """Openings or sizes at which the orifice of a valve has given areas, and the areas that can be reached."""

    values: Reals  #: (n,), the openings or sizes
    reached: Reals  #: (n,), the areas at these values
    least: float  #: the least area that can be reached
    most: float  #: the largest area that can be reached
    least_at: float  #: a value with the least area
    most_at: float  #: a value with the largest area
    turns: Reals  #: at most 4 values at which the area stops growing or falling
    n_turns: int  #: the number of turns; 0: the area grows or falls over all values
    n_surfaces: int  #: the number of surfaces that were made
    n_refused: int  #: sampled values that make no valve or no orifice
    seconds: float


class LeafletSizes(NamedTuple):
    """A leaflet of a surface. Lengths are in mesh units."""

    leaflet_id: int
    n_triangles: int
    area: float
    free_edge: float  #: length of the free edge, 0 for a surface from arrays


class Orifice(NamedTuple):
    """The area that a surface's triangles leave uncovered, as seen along its axis. Lengths are in mesh units."""

    area: float
    outline_area: float  #: area inside the outline
    perimeter: float  #: length of the orifice's edge along the triangles
    effective_area: float  #: area that the band leaves to the flow; to first order area - c eps perimeter
    rim_reach: float  #: c
    half_thickness: float  #: eps
    radius: float  #: of the disc; 0 for other outlines
    axis: Reals  #: (3,)
    outline: Literal["none", "disc", "attachment", "boundary", "wall"]


class Coaptation(NamedTuple):
    """The parts of leaflets that lie within reach of another leaflet. Lengths are in mesh units."""

    area: float
    edge: float  #: length of free edge
    reach: float


class Gap(NamedTuple):
    """The gap between a valve's attachment and a wall, along the direction of a skirt. Lengths are in mesh units."""

    least: float
    mean: float  #: weighted by the edges' lengths
    most: float
    widest_point: Reals  #: (3,)
    distance: Reals  #: (n_edges, 2), at the ends of the edges of ``Surface.attachment``; 1e30 without a wall
    n_without_wall: int  #: ends whose line misses the wall


class CellsAcross(NamedTuple):
    """The number of mesh edges across the band: 2 * half_thickness divided by the lengths of edges with a marked node."""

    least: float  #: for the longest of these edges
    mean: float  #: for the mean of these lengths
    most: float  #: for the shortest of these edges
    shortest_edge: float
    mean_edge: float
    longest_edge: float
    half_thickness: float
    n_edges: int  #: number of these edges; if 0, the other numbers except half_thickness are 0


class Crossings(NamedTuple):
    """Pairs of triangles that go through each other, ascending. Lengths are in mesh units."""

    n_pairs: int
    triangle_id: Ids  #: (n, 2), the lower id first
    point: Reals  #: (n, 3), the middle of the pair's intersection
    depth: Reals  #: (n,)
    length: Reals  #: (n,), the length of the pair's intersection
    total_length: float
    deepest_depth: float
    deepest_point: Reals  #: (3,)
    deepest_triangle_id: Ids  #: (2,), -1 if there is no pair
    deepest_leaflet_id: Integers  #: (2,)
    seconds: float


for _record in (
    Parameter,
    SurfaceInfo,
    Triangles,
    ClosestPoint,
    ClosestPoints,
    MarkStats,
    Dense,
    BandSums,
    Leaks,
    Passage,
    FirstPassage,
    ByArea,
    LeafletSizes,
    Orifice,
    Coaptation,
    Gap,
    CellsAcross,
    Crossings,
):
    _record.__module__ = "riis"
