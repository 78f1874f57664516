# SPDX-License-Identifier: Apache-2.0
"""The plug-in for ParaView 5.11 and later: the source "Heart Valve" and the filter "Mark By Valve" (docs/paraview.md).

ParaView loads this file by Tools, Manage Plugins, Load New, and pvpython loads it by LoadPlugin(path, ns=globals()). The package
riis must be importable by ParaView's own Python. Arrays are passed to riis and back as numpy arrays, so ParaView's VTK and
the libraries of riis never meet.
"""

import atexit
import csv
import math
import weakref
from xml.sax.saxutils import escape, quoteattr

import numpy
import riis
from paraview.util.vtkAlgorithm import VTKPythonAlgorithmBase, smproperty, smproxy
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonCore import VTK_ID_TYPE, vtkOutputWindow, vtkPoints
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkDataObject, vtkPolyData, vtkUnstructuredGrid
from vtkmodules.vtkCommonExecutionModel import vtkAlgorithm
from vtkmodules.vtkCommonExecutionModel import vtkStreamingDemandDrivenPipeline as Pipeline

# State files store the number of a kind, so a new kind must be the last.
KINDS = (
    "aortic", "trileaflet", "coapting", "mitral", "bileaflet", "bicuspid", "quadricuspid", "mitral_coapting", "tricuspid",
)  # fmt: skip
UNITS = {"cm": 1.0, "mm": 10.0, "m": 0.01}  # lengths in the mesh's unit for each centimetre
MOTIONS = ("fixed opening", "heartbeat by four times", "cycle from a table")
INTERPOLATIONS = ("linear", "cubic")
FIELDS = ("normal", "side", "point", "velocity")

# The panel always shows these sizes. All other sizes are advanced properties.
FIRST_SIZES = {
    "aortic": ("root_radius", "leaflet_height", "bending_height"),
    "trileaflet": ("root_radius", "leaflet_radius_out", "leaflet_height"),
    "coapting": ("root_radius", "commissure_radius", "effective_height"),
    "mitral": ("AP_diameter", "ALPM_diameter", "anterior_length"),
    "bileaflet": ("radius", "closed_angle", "open_angle"),
    "bicuspid": ("root_radius", "commissure_radius", "effective_height", "cusp_0.sector", "cusp_1.sector"),
    "quadricuspid": ("root_radius", "commissure_radius", "effective_height"),
    "mitral_coapting": ("AP_diameter", "ALPM_diameter", "anterior_length", "posterior_length"),
    "tricuspid": ("AP_diameter", "SL_diameter", "anterior_length", "posterior_length", "septal_length"),
}


DESCRIPTIONS = {kind: riis.Valve(kind).parameters for kind in KINDS}


class Refused(ValueError):
    """Bad input that riis itself does not see."""


def shown(request):
    """Turns a refusal into a message in ParaView's output window. The request then fails and leaves no output."""

    def run(self, request_object, inputs, outputs):
        try:
            return request(self, request_object, inputs, outputs)
        except (riis.Error, Refused) as refusal:
            for port in range(self.GetNumberOfOutputPorts()):
                data = vtkDataObject.GetData(outputs, port)
                if data is not None:
                    data.Initialize()
            vtkOutputWindow.GetInstance().DisplayErrorText(f"{self.label}: {refusal}\n")
            return 0

    return run


# ---- Properties ----


def _documentation(text):
    return f"<Documentation>{escape(text)}</Documentation>"


def _shown_if(name, value):
    """Hides a property in the panel unless another property has a value."""
    decorator = f'<PropertyWidgetDecorator type="GenericDecorator" mode="visibility" property="{name}" value="{value}"/>'
    return f"<Hints>{decorator}</Hints>"


def _choice(name, texts, text, hints=""):
    entries = "".join(f'<Entry value="{value}" text={quoteattr(entry)}/>' for value, entry in enumerate(texts))
    return f"""<IntVectorProperty name="{name}" command="Set{name}" number_of_elements="1" default_values="0">
      <EnumerationDomain name="enum">{entries}</EnumerationDomain>{_documentation(text)}{hints}</IntVectorProperty>"""


def _switch(name, text):
    return f"""<IntVectorProperty name="{name}" command="Set{name}" number_of_elements="1" default_values="0">
      <BooleanDomain name="bool"/>{_documentation(text)}</IntVectorProperty>"""


def _count(name, default, least, most, text):
    return f"""<IntVectorProperty name="{name}" command="Set{name}" number_of_elements="1" default_values="{default}">
      <IntRangeDomain name="range" min="{least}" max="{most}"/>{_documentation(text)}</IntVectorProperty>"""


def _numbers(name, default, text, least=None, most=None, visibility="default", hints="", label=""):
    """Returns the property of one number, or of several. A range makes a slider. pvpython's name of the property is its label
    without blanks, so only a name with underscores gets a label of its own."""
    values = [float(value) for value in numpy.ravel(default)]

    def listed(value):
        return " ".join([repr(float(value))] * len(values))

    limits = "" if least is None else f' min="{listed(least)}"'
    limits += "" if most is None else f' max="{listed(most)}"'
    named = f' label="{label}"' if label else ""
    return f"""<DoubleVectorProperty name="{name}"{named} command="Set{name}" panel_visibility="{visibility}"
      number_of_elements="{len(values)}" default_values="{' '.join(map(repr, values))}">
      <DoubleRangeDomain name="range"{limits}/>{_documentation(text)}{hints}</DoubleVectorProperty>"""


def _times_of_output():
    return """<DoubleVectorProperty name="TimestepValues" repeatable="1" information_only="1">
      <TimeStepsInformationHelper/></DoubleVectorProperty>"""


def _parameter_names(kind):
    """Returns the name of the property of each parameter of a kind, except the opening, which all kinds share."""
    return {name: f"{kind}_{name.replace('.', '_')}" for name in DESCRIPTIONS[kind] if name != "opening"}


def _parameter_property(kind, name, property_name):
    parameter = DESCRIPTIONS[kind][name]
    unit = {"length": ", in centimetres", "degree": ", in degrees", "1": ""}[parameter.unit]
    text = f"{name} of the {kind} valve{unit}: {parameter.description}."
    if parameter.rule:
        text += f" As long as it has its default, it follows its rule: {parameter.rule}."
    visibility = "default" if name in FIRST_SIZES[kind] else "advanced"
    return _numbers(property_name, parameter.default, text, parameter.minimum, parameter.maximum, visibility,
                    _shown_if("Kind", KINDS.index(kind)), property_name)  # fmt: skip


def _setter(name):
    def set_values(self, *values):
        self.keep(name, values[0] if len(values) == 1 else values)

    return set_values


def _with_setters(names):
    """For each property, adds a method Set..., which stores the property's value."""

    def decorate(algorithm):
        for name in names:
            setattr(algorithm, f"Set{name}", _setter(name))
        return algorithm

    return decorate


class _Kept(VTKPythonAlgorithmBase):
    """An algorithm whose properties are in a dictionary."""

    label = ""

    def __init__(self, defaults, **ports):
        super().__init__(**ports)
        self.values = dict(defaults)

    def keep(self, name, value):
        if self.values[name] != value:
            self.values[name] = value
            self.Modified()

    def length(self, name):
        """Returns a length, or 0 if riis chooses the length."""
        value = self.values[name]
        if not value >= 0.0:
            raise Refused(f"{name}: is {value}; it must be at least 0")
        return value


# ---- The source ----

VALVE_DEFAULTS = {
    "Kind": 0, "PlacedValve": "", "Opening": 0.0, "Motion": 0,
    "BeginsToOpen": 0.1, "OpensIn": 0.05, "BeginsToClose": 0.4, "ClosesIn": 0.05, "Period": 0.8, "CycleFile": "",
    "Interpolation": 0, "NumberOfTimes": 41, "MeshUnit": 0, "RotationAxis": (0.0, 0.0, 1.0), "RotationAngle": 0.0,
    "Translation": (0.0, 0.0, 0.0), "HalfThickness": 0.0, "Offset": 0.0, "Tolerance": 0.05,
}  # fmt: skip
PARAMETERS = {kind: _parameter_names(kind) for kind in KINDS}


def _default_of(kind, name):
    default = DESCRIPTIONS[kind][name].default
    return default if numpy.ndim(default) == 0 else tuple(float(value) for value in default)


PARAMETER_DEFAULTS = {
    property_name: _default_of(kind, name) for kind in KINDS for name, property_name in PARAMETERS[kind].items()
}


def _valve_properties():
    by_times, by_table = _shown_if("Motion", 1), _shown_if("Motion", 2)
    properties = [
        _times_of_output(),
        _choice("Kind", KINDS, "The kind of valve. Each kind has sizes of its own."),
        f"""<StringVectorProperty name="PlacedValve" command="SetPlacedValve" number_of_elements="1" default_values="">
          <FileListDomain name="files"/>{_documentation(
              "A placed valve, as riis place writes it. Its kind, sizes, unit, placement and warp then count.")}
          <Hints><FileChooser extensions="json" file_description="Placed valve"/></Hints></StringVectorProperty>""",
        _choice("Motion", MOTIONS, "Whether the valve stays at its opening, or moves in ParaView's time."),
        _numbers("Opening", 0.0, "0 is closed, 1 is open.", 0.0, 1.0, hints=_shown_if("Motion", 0)),
        _numbers("BeginsToOpen", 0.1, "The time at which the valve begins to open.", hints=by_times),
        _numbers("OpensIn", 0.05, "The duration of opening.", 0.0, hints=by_times),
        _numbers("BeginsToClose", 0.4, "The time at which the valve begins to close.", hints=by_times),
        _numbers("ClosesIn", 0.05, "The duration of closing.", 0.0, hints=by_times),
        _numbers("Period", 0.8, "The duration of a heartbeat.", 0.0, hints=by_times),
        f"""<StringVectorProperty name="CycleFile" command="SetCycleFile" number_of_elements="1" default_values="">
          <FileListDomain name="files"/>{_documentation(
              "A file of two columns, the times and the openings of the valve, separated by commas.")}
          <Hints><FileChooser extensions="csv txt" file_description="Cycle"/>
          <PropertyWidgetDecorator type="GenericDecorator" mode="visibility" property="Motion" value="2"/></Hints>
          </StringVectorProperty>""",
        _choice("Interpolation", INTERPOLATIONS, "How the opening changes between the table's times.", by_table),
        _count("NumberOfTimes", 41, 2, 1000, "The number of time steps of a motion, first and last included."),
        *(_parameter_property(kind, name, property_name)
          for kind in KINDS for name, property_name in PARAMETERS[kind].items()),
        _choice("MeshUnit", UNITS, "The unit of the mesh, and of the surface. The sizes of the valve are in centimetres."),
        _numbers("RotationAxis", (0, 0, 1), "The axis about which the valve is turned."),
        _numbers("RotationAngle", 0.0, "In degrees, counter-clockwise seen from the axis's tip.", -360, 360),
        _numbers("Translation", (0, 0, 0), "In the unit of the mesh, after the rotation."),
        _numbers("HalfThickness", 0.0,
                 "Nodes nearer to the leaflets are marked. In the unit of the mesh; 0 stands for 0.1 cm.", 0.0),
        _numbers("Offset", 0.0, "The band of marked nodes steps aside along the normals by this number of half thicknesses, "
                 "above -1 and below 1. 0.75 gives an open valve its full width.", -1.0, 1.0),
        _numbers("Tolerance", 0.05, "The error of the triangles, in half thicknesses.", 1e-6, 1.0, "advanced"),
        *(_groups(kind) for kind in KINDS),
    ]  # fmt: skip
    return "".join(properties)


def _groups(kind):
    """Puts the sizes of a kind below a heading, and its bumps below another heading."""
    groups = {"Sizes": [], "Bumps": []}
    for name, property_name in PARAMETERS[kind].items():
        groups["Bumps" if name.startswith("bump_") else "Sizes"].append(f'<Property name="{property_name}"/>')
    hints = _shown_if("Kind", KINDS.index(kind))
    return "".join(f"""<PropertyGroup label="{title} of the {kind} valve (cm, degrees)">{"".join(names)}
      {hints}</PropertyGroup>""" for title, names in groups.items() if names)


def read_cycle(path):
    """Reads the times and openings of a cycle, by the rules of the program riis. A first line without numbers names columns."""
    try:
        with open(path, encoding="utf-8", newline="") as file:
            rows = [[entry.strip() for entry in row] for row in csv.reader(file)]
    except OSError as error:
        raise Refused(f"CycleFile: {path}: {error.strerror}") from None
    except (UnicodeDecodeError, csv.Error):
        raise Refused(f"CycleFile: {path} is no text of two columns") from None
    keys, may_be_header = [], True
    for number, row in enumerate(rows, start=1):
        if not any(row) or row[0].startswith("#"):
            continue
        is_first, may_be_header = may_be_header, False
        numbers = [_number_in(entry) for entry in row]
        if len(row) != 2 or None in numbers:
            if is_first and numbers == [None, None]:
                continue
            raise Refused(f"CycleFile: {path}, line {number}: '{','.join(row)}' must be a time and an opening")
        keys.append(numbers)
    if not keys:
        raise Refused(f"CycleFile: {path} holds no times and openings")
    return numpy.array(keys)


def _number_in(text):
    """Returns the number in a text if it is finite, or None."""
    try:
        number = float(text)
    except ValueError:
        return None
    return number if math.isfinite(number) else None


@_with_setters([*VALVE_DEFAULTS, *PARAMETER_DEFAULTS])
class _HeartValve(_Kept):
    label = "Heart Valve"

    def __init__(self):
        super().__init__({**VALVE_DEFAULTS, **PARAMETER_DEFAULTS}, nInputPorts=0, nOutputPorts=1, outputType="vtkPolyData")

    def valve(self, opening):
        """Returns the riis.Valve. Sizes that have their defaults are not set, so they follow their rules."""
        placed = self.placed()
        if placed is not None:
            placed.valve["opening"] = opening
            return placed.valve
        kind = KINDS[self.values["Kind"]]
        valve = riis.Valve(kind, opening=opening)
        for name, property_name in PARAMETERS[kind].items():
            value = self.values[property_name]
            if value != PARAMETER_DEFAULTS[property_name]:
                valve[name] = value if numpy.ndim(value) == 0 else numpy.array(value)
        return valve

    def placed(self):
        """Returns the placed valve of the file, or None without a file."""
        if not self.values["PlacedValve"]:
            return None
        try:
            return riis.read_placed(self.values["PlacedValve"])
        except OSError as error:
            raise Refused(f"PlacedValve: {self.values['PlacedValve']}: {error.strerror}") from None

    def options(self):
        """Returns the options of riis.Surface."""
        placed = self.placed()
        placement = placed.placement if placed is not None else {
            "scale": list(UNITS.values())[self.values["MeshUnit"]],
            "rotation_axis": self.values["RotationAxis"],
            "rotation_angle": self.values["RotationAngle"],
            "translation": self.values["Translation"],
        }  # fmt: skip
        options = {**placement, "tolerance": self.values["Tolerance"]}
        if self.length("HalfThickness") > 0.0:
            options["half_thickness"] = self.values["HalfThickness"]
        if self.values["Offset"] != 0.0:
            options["offset"] = self.values["Offset"]
        return options

    def motion(self):
        """Returns the law of the opening and the times of the steps, or None and no times."""
        n, kept = self.values["NumberOfTimes"], self.values
        if kept["Motion"] == 0:
            return None, numpy.zeros(0)
        if n < 2:
            raise Refused(f"NumberOfTimes: is {n}; it must be at least 2")
        if kept["Motion"] == 1:
            if not kept["Period"] > 0.0:
                raise Refused(f"Period: is {kept['Period']}; it must be above 0")
            names = ("BeginsToOpen", "OpensIn", "BeginsToClose", "ClosesIn")
            law = riis.OpeningTimes(*(kept[name] for name in names), period=kept["Period"])
            law(0.0)  # refuses bad times now
            return law, numpy.linspace(0.0, kept["Period"], n)
        if not kept["CycleFile"]:
            raise Refused("CycleFile: no file is named, but the motion is a cycle from a table")
        time, opening = read_cycle(kept["CycleFile"]).T.copy()
        law = riis.OpeningTable(time, opening, interpolation=INTERPOLATIONS[kept["Interpolation"]])
        law(float(time[0]))
        return law, numpy.linspace(time[0], time[-1], n)

    @shown
    def RequestInformation(self, request, inputs, outputs):
        out = outputs.GetInformationObject(0)
        out.Remove(Pipeline.TIME_STEPS())
        out.Remove(Pipeline.TIME_RANGE())
        _, times = self.motion()
        _set_times(out, times)
        return 1

    @shown
    def RequestData(self, request, inputs, outputs):
        output, out = vtkPolyData.GetData(outputs, 0), outputs.GetInformationObject(0)
        law, times = self.motion()
        options = self.options()
        if law is None:
            surface = riis.Surface(self.valve(self.values["Opening"]), **options)
        else:
            time = float(out.Get(Pipeline.UPDATE_TIME_STEP())) if out.Has(Pipeline.UPDATE_TIME_STEP()) else float(times[0])
            # The velocity is the mean velocity over a thousandth of a step.
            dt = 1e-3 * float(times[1] - times[0])
            now, before = self.valve(law(time)), self.valve(law(time - dt))
            surface = riis.Surface(now, **options)
            surface.update_moving(now, before, dt)
            output.GetInformation().Set(vtkDataObject.DATA_TIME_STEP(), time)
        put_surface(surface, output)
        return 1


def _set_times(out, times):
    if len(times) == 0:
        return
    for time in times:
        out.Append(Pipeline.TIME_STEPS(), float(time))
    for time in (times[0], times[-1]):
        out.Append(Pipeline.TIME_RANGE(), float(time))


def _add(data, name, values):
    """Copies a numpy array to an array of VTK."""
    values = numpy.ascontiguousarray(values)
    array = numpy_to_vtk(values.astype(numpy.uint8) if values.dtype == numpy.bool_ else values, deep=True)
    array.SetName(name)
    data.AddArray(array)


def put_surface(surface, output):
    """Copies a riis.Surface to vtkPolyData, with the arrays that the program riis writes."""
    triangles = surface.triangles
    points, cells = vtkPoints(), vtkCellArray()
    points.SetData(numpy_to_vtk(numpy.ascontiguousarray(surface.vertices), deep=True))
    ids = numpy.ascontiguousarray(triangles.vertex_id, numpy.int64)
    offsets = numpy.arange(0, 3 * len(ids) + 1, 3, dtype=numpy.int64)
    cells.SetData(_id_array(offsets), _id_array(ids.ravel()))
    output.SetPoints(points)
    output.SetPolys(cells)
    for name, values in (("riis_leaflet", triangles.leaflet_id), ("riis_patch", triangles.patch_id),
                         ("riis_triangle", triangles.triangle_id)):  # fmt: skip
        _add(output.GetCellData(), name, values)
    if surface.velocities is not None:
        _add(output.GetPointData(), "riis_velocity", surface.velocities)
    _add(output.GetFieldData(), "riis_half_thickness", numpy.array([surface.info.half_thickness]))
    _add(output.GetFieldData(), "riis_offset", numpy.array([surface.info.offset]))


def _id_array(values):
    return numpy_to_vtk(values, deep=True, array_type=VTK_ID_TYPE)


@smproxy.source(name="HeartValve", label="Heart Valve")
@smproperty.xml(_valve_properties())
class HeartValve(_HeartValve):
    """The surface of a valve of riis, at one opening or in motion."""


# ---- The filter ----

MARK_DEFAULTS = {
    "HalfThickness": 0.0, "Offset": 0.0, "DistanceLimit": 0.0, "FarDistance": 1e30, "Resistance": 0.0, "FindLeaks": 0,
    **{f"Field{field.capitalize()}": 0 for field in FIELDS},
}  # fmt: skip


def _input(name, port, data_type, text):
    return f"""<InputProperty name="{name}" port_index="{port}" command="SetInputConnection">
      <ProxyGroupDomain name="groups"><Group name="sources"/><Group name="filters"/></ProxyGroupDomain>
      <DataTypeDomain name="input_type"><DataType value="{data_type}"/></DataTypeDomain>{_documentation(text)}</InputProperty>"""


def _mark_properties():
    fields = {
        "normal": "The unit normals of the leaflets at the closest points.",
        "side": "1 downstream of the leaflets, -1 upstream, 0 on neither side.",
        "point": "The closest points of the leaflets.",
        "velocity": "The velocity of the leaflets, and K times this velocity if there is a resistance.",
    }
    properties = [
        _input("Mesh", 0, "vtkUnstructuredGrid", "The mesh whose nodes are marked."),
        _input("Valve", 1, "vtkPolyData", "The leaflets: a Heart Valve, or any surface of triangles."),
        _times_of_output(),
        '<OutputPort name="Marked mesh" index="0"/><OutputPort name="Leaking edges" index="1"/>',
        _numbers("HalfThickness", 0.0,
                 "Nodes nearer to the leaflets are marked. 0 stands for the half thickness of the Heart Valve.", 0.0),
        _numbers("Offset", 0.0, "The band of marked nodes steps aside along the normals by this number of half thicknesses, "
                 "above -1 and below 1. 0 stands for the offset of the Heart Valve.", -1.0, 1.0),
        _numbers("DistanceLimit", 0.0,
                 "Distances are known up to this limit. 0 stands for the half thickness, or with an offset for the band.", 0.0),
        _numbers("FarDistance", 1e30, "The distance of all nodes beyond the limit.", visibility="advanced"),
        _numbers("Resistance", 0.0, "R. If it is above 0, each node gets K.", 0.0),
        *(_switch(f"Field{field.capitalize()}", text) for field, text in fields.items()),
        _switch("FindLeaks", "Finds edges that cross the leaflets between two unmarked nodes."),
    ]  # fmt: skip
    return "".join(properties)


def _points_of(data, what):
    """Returns the points as float64, without a copy if they have this type."""
    if data is None or data.GetNumberOfPoints() == 0:
        raise Refused(f"{what}: it has no points")
    return numpy.ascontiguousarray(vtk_to_numpy(data.GetPoints().GetData()), numpy.float64)


def _cells_of(cells):
    return vtk_to_numpy(cells.GetOffsetsArray()), vtk_to_numpy(cells.GetConnectivityArray())


def _surface_of(data, half_thickness, offset):
    """Returns the riis.Surface of the triangles, as ParaView shows them."""
    points = _points_of(data, "Valve")
    offsets, corners = _cells_of(data.GetPolys())
    n = len(offsets) - 1
    if n != data.GetNumberOfCells() or numpy.any(numpy.diff(offsets) != 3):
        raise Refused("Valve: it has cells that are not triangles; the filter Triangulate makes triangles of polygons")
    leaflets = data.GetCellData().GetArray("riis_leaflet")
    velocities = data.GetPointData().GetArray("riis_velocity")
    own = data.GetFieldData().GetArray("riis_half_thickness")
    if half_thickness == 0.0:
        if own is None:
            raise Refused("HalfThickness: it is 0, and the valve is not a Heart Valve, which has one")
        half_thickness = own.GetTuple1(0)
    of_valve = data.GetFieldData().GetArray("riis_offset")
    if offset == 0.0 and of_valve is not None:
        offset = of_valve.GetTuple1(0)
    options = {"offset": offset}
    if leaflets is not None:
        options["leaflet_id"] = numpy.ascontiguousarray(vtk_to_numpy(leaflets), numpy.int32)
    if velocities is not None:
        options["velocities"] = numpy.ascontiguousarray(vtk_to_numpy(velocities), numpy.float64)
    faces = numpy.ascontiguousarray(corners, numpy.int64).reshape(n, 3)
    return riis.Surface.from_arrays(points, faces, half_thickness=half_thickness, zero_area="skip", **options)


TETRA, VOXEL, HEXAHEDRON, WEDGE, PYRAMID = 10, 11, 12, 13, 14
VOLUMES = (TETRA, VOXEL, HEXAHEDRON, WEDGE, PYRAMID)
LARGEST_FLAT = 9


def _adjacency_of(grid):
    """Returns the neighbours of the nodes by the edges of the volume cells."""
    types = vtk_to_numpy(grid.GetCellTypesArray())
    offsets, nodes = (numpy.asarray(array, numpy.int64) for array in _cells_of(grid.GetCells()))
    is_volume = numpy.isin(types, VOLUMES)
    others = numpy.unique(types[~is_volume & (types > LARGEST_FLAT)])
    if len(others) > 0:
        raise Refused(f"FindLeaks: the mesh has cells of VTK's type {others[0]}; edges are known of linear cells only")
    if not is_volume.any():
        raise Refused("FindLeaks: the mesh has no volume cells")
    nodes = nodes.copy()
    voxels = offsets[:-1][types == VOXEL]
    for a, b in ((2, 3), (6, 7)):  # voxels have another order of nodes than hexahedra
        nodes[voxels + a], nodes[voxels + b] = nodes[voxels + b], nodes[voxels + a].copy()
    lengths = numpy.diff(offsets)
    kept = nodes[numpy.repeat(is_volume, lengths)]
    starts = numpy.concatenate([[0], numpy.cumsum(lengths[is_volume])])
    return riis.Adjacency.from_cells(kept, grid.GetNumberOfPoints(), offsets=starts)


class _KeptMesh:
    """The riis.Mesh of a filter, which stays the same as long as nodes and cells stay the same."""

    def __init__(self):
        self.mesh = self.points_key = self.cells_key = None
        kept_meshes.add(self)

    def of(self, grid, needs_edges):
        """Returns the mesh of a grid."""
        points, cells = grid.GetPoints(), grid.GetCells()
        key = points and (points, points.GetMTime())
        if self.mesh is None or self.points_key != key:
            self.mesh, self.points_key, self.cells_key = riis.Mesh(_points_of(grid, "Mesh")), key, None
        if needs_edges and self.cells_key != (cells, cells.GetMTime()):
            self.mesh.set_adjacency(_adjacency_of(grid))
            self.cells_key = (cells, cells.GetMTime())
        return self.mesh


kept_meshes = weakref.WeakSet()


@atexit.register
def forget_meshes():
    """ParaView ends Python before its filters. Objects of riis must not outlive Python."""
    for kept in kept_meshes:
        kept.mesh = None


@_with_setters(MARK_DEFAULTS)
class _MarkByValve(_Kept):
    label = "Mark By Valve"

    def __init__(self):
        super().__init__(MARK_DEFAULTS, nInputPorts=2, nOutputPorts=2, outputType="vtkUnstructuredGrid")
        self.kept_mesh = _KeptMesh()

    def FillInputPortInformation(self, port, info):
        info.Set(vtkAlgorithm.INPUT_REQUIRED_DATA_TYPE(), ("vtkUnstructuredGrid", "vtkPolyData")[port])
        return 1

    def FillOutputPortInformation(self, port, info):
        info.Set(vtkDataObject.DATA_TYPE_NAME(), ("vtkUnstructuredGrid", "vtkPolyData")[port])
        return 1

    def RequestDataObject(self, request, inputs, outputs):
        for port, make in enumerate((vtkUnstructuredGrid, vtkPolyData)):
            if make.GetData(outputs, port) is None:
                outputs.GetInformationObject(port).Set(vtkDataObject.DATA_OBJECT(), make())
        return 1

    def RequestInformation(self, request, inputs, outputs):
        """Gives the outputs the times of both inputs."""
        times = set()
        for port in range(2):
            given = inputs[port].GetInformationObject(0)
            if given.Has(Pipeline.TIME_STEPS()):
                times.update(given.Get(Pipeline.TIME_STEPS()))
        for port in range(2):
            out = outputs.GetInformationObject(port)
            out.Remove(Pipeline.TIME_STEPS())
            out.Remove(Pipeline.TIME_RANGE())
            _set_times(out, sorted(times))
        return 1

    @shown
    def RequestData(self, request, inputs, outputs):
        grid, leaflets = vtkUnstructuredGrid.GetData(inputs[0], 0), vtkPolyData.GetData(inputs[1], 0)
        marked, leaking = vtkUnstructuredGrid.GetData(outputs, 0), vtkPolyData.GetData(outputs, 1)
        kept = self.values
        surface = _surface_of(leaflets, self.length("HalfThickness"), kept["Offset"])
        mesh = self.kept_mesh.of(grid, kept["FindLeaks"])
        fields = [field for field in FIELDS if kept[f"Field{field.capitalize()}"]]
        if "velocity" in fields and surface.velocities is None:
            raise Refused("FieldVelocity: the valve does not move")
        options = {"distance_limit": kept["DistanceLimit"]} if self.length("DistanceLimit") > 0.0 else {}
        marks = riis.mark(surface, mesh, fields=fields or None, allow_none=True, **options)
        marked.ShallowCopy(grid)
        put_marks(marks, fields, kept["FarDistance"], marked.GetPointData(), len(mesh))
        if kept["Resistance"] != 0.0:
            put_resistance(marks, "velocity" in fields, kept["Resistance"], marked.GetPointData(), len(mesh))
        out = outputs.GetInformationObject(0)
        if out.Has(Pipeline.UPDATE_TIME_STEP()):
            marked.GetInformation().Set(vtkDataObject.DATA_TIME_STEP(), out.Get(Pipeline.UPDATE_TIME_STEP()))
        leaking.Initialize()
        if kept["FindLeaks"]:
            leaks = riis.find_leaks(surface, mesh, marks)
            _add(marked.GetFieldData(), "riis_leaking_edges", numpy.array([leaks.n_edges], numpy.int64))
            put_edges(mesh.xyz, leaks, leaking)
        return 1


def put_marks(marks, fields, far_distance, data, n):
    """Copies the marks to arrays with the names and values that the program riis writes."""
    dense = marks.dense(leaflet_id=True, far_distance=far_distance)
    for name, values in (("marked", dense.mark), ("distance", dense.distance), ("leaflet", dense.leaflet_id)):
        _add(data, f"riis_{name}", values)
    within = marks.within_limit
    for field in fields:
        found = getattr(within, field)
        values = numpy.zeros((n, *found.shape[1:]), found.dtype)
        values[within.ids] = found
        _add(data, f"riis_{field}", values)


def put_resistance(marks, has_velocity, resistance, data, n):
    K, K_u = numpy.zeros(n), numpy.zeros((n, 3)) if has_velocity else None
    marks.add_resistance(K, K_u, R=resistance)
    _add(data, "riis_K", K)
    if has_velocity:
        _add(data, "riis_K_u_surface", K_u)


def put_edges(xyz, leaks, output):
    """Copies leaking edges to lines, with their lengths and the half thicknesses that close them."""
    points, lines = vtkPoints(), vtkCellArray()
    ends = numpy.ascontiguousarray(xyz[leaks.node_id.ravel()])
    points.SetData(numpy_to_vtk(ends, deep=True))
    lines.SetData(_id_array(numpy.arange(0, len(ends) + 1, 2, dtype=numpy.int64)),
                  _id_array(numpy.arange(len(ends), dtype=numpy.int64)))  # fmt: skip
    output.SetPoints(points)
    output.SetLines(lines)
    for name, values in (("length", leaks.length), ("half_thickness", leaks.distance)):
        _add(output.GetCellData(), name, values)
    _add(output.GetPointData(), "riis_node_id", leaks.node_id.ravel())


@smproxy.filter(name="MarkByValve", label="Mark By Valve")
@smproperty.xml(_mark_properties())
class MarkByValve(_MarkByValve):
    """The marks of a mesh by a valve of riis."""
