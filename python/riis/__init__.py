# SPDX-License-Identifier: Apache-2.0
"""riis: heart valves as resistive immersed implicit surfaces.

    import numpy, riis

    xyz = numpy.random.default_rng(1).uniform(-2.0, 2.0, (60_000, 3))  # your nodes, (n, 3) float64
    valve = riis.Valve("mitral", opening=0.3)
    surface = riis.Surface(valve, half_thickness=0.1)
    mesh = riis.Mesh(xyz)                               # borrowed, not copied
    marks = riis.mark(surface, mesh)
    marks.ids, marks.distance                           # views without a copy
    K = numpy.zeros(len(mesh))
    marks.add_resistance(K, R=1e4)

Lengths have one unit of the caller's choice, and angles are in degrees. Ids count from 0. A refused call raises TypeError or a
subclass of riis.Error, whose message names the argument. Calls release the interpreter's lock. Results are the same to the last
bit for any number of threads.
"""

from enum import IntEnum

from riis import laws
from riis._errors import (
    Error,
    InternalError,
    InvalidArgumentError,
    InvalidMeshError,
    InvalidParameterError,
    InvalidSurfaceError,
    LimitExceededError,
    MarksWarning,
    MissingAttributeError,
    OutOfMemoryError,
    UnavailableError,
    UnknownParameterError,
)
from riis._fit import FitResult, Rival, fit
from riis._place import PlaceResult, place
from riis._placed_file import PlacedValve, read_placed
from riis._plot import animate, plot
from riis._records import (
    BandSums,
    CellsAcross,
    ClosestPoint,
    ClosestPoints,
    Coaptation,
    Crossings,
    Dense,
    FirstPassage,
    Gap,
    LeafletSizes,
    Leaks,
    MarkStats,
    Orifice,
    Parameter,
    Passage,
    SurfaceInfo,
    Triangles,
    ValvePatches,
    WarpInfo,
)
from riis._riis import (
    FAR_DISTANCE,
    LOG_INFO,
    LOG_WARNING,
    Adjacency,
    Keyframes,
    Marks,
    Mesh,
    Surface,
    Valve,
    Warp,
    WithinLimit,
    find_crossings,
    find_by_area,
    find_first_passage,
    find_leaks,
    find_passage,
    label_open_regions,
    load_sums,
    loads,
    mark,
    set_log,
    status_name,
    version_string,
)
from riis.laws import (
    OpeningAngle,
    OpeningAngleState,
    OpeningSwitch,
    OpeningSwitchState,
    OpeningTable,
    OpeningTimes,
)

__version__ = version_string()


class Leaflet(IntEnum):
    """The leaflets of the parametric valves, as leaflet_id reports them."""

    RIGHT = 0  #: aortic: the right coronary cusp; other cusps: the cusp on the x axis
    LEFT = 1  #: aortic: the left coronary cusp; other cusps: the next one counter-clockwise, seen from +z
    NON_CORONARY = 2  #: aortic; other cusps: the third one. The fourth one has the id 3
    ANTERIOR = 0  #: mitral, mitral_coapting, tricuspid
    POSTERIOR = 1  #: mitral, mitral_coapting, with all its scallops. tricuspid: 1 is septal, and 2 posterior
    POSITIVE = 0  #: bileaflet: the leaflet at x > 0
    NEGATIVE = 1  #: bileaflet: the leaflet at x < 0
    HOUSING = 2  #: bileaflet: the housing's wall


__all__ = [
    "FAR_DISTANCE",
    "LOG_INFO",
    "LOG_WARNING",
    "Adjacency",
    "BandSums",
    "CellsAcross",
    "ClosestPoint",
    "ClosestPoints",
    "Coaptation",
    "Crossings",
    "Dense",
    "Error",
    "FirstPassage",
    "FitResult",
    "InternalError",
    "InvalidArgumentError",
    "InvalidMeshError",
    "InvalidParameterError",
    "InvalidSurfaceError",
    "Keyframes",
    "Leaflet",
    "Gap",
    "LeafletSizes",
    "Leaks",
    "LimitExceededError",
    "Marks",
    "MarkStats",
    "MarksWarning",
    "Mesh",
    "MissingAttributeError",
    "OpeningAngle",
    "OpeningAngleState",
    "OpeningSwitch",
    "OpeningSwitchState",
    "OpeningTable",
    "OpeningTimes",
    "Orifice",
    "OutOfMemoryError",
    "Parameter",
    "Passage",
    "PlaceResult",
    "PlacedValve",
    "Rival",
    "Surface",
    "SurfaceInfo",
    "Triangles",
    "UnavailableError",
    "UnknownParameterError",
    "Valve",
    "ValvePatches",
    "Warp",
    "WarpInfo",
    "WithinLimit",
    "animate",
    "find_crossings",
    "find_by_area",
    "find_first_passage",
    "find_leaks",
    "find_passage",
    "fit",
    "label_open_regions",
    "laws",
    "load_sums",
    "loads",
    "mark",
    "place",
    "plot",
    "read_placed",
    "set_log",
    "status_name",
    "version_string",
]
