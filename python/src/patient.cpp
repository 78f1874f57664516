// SPDX-License-Identifier: Apache-2.0
// The program's rules for patients: files of landmarks and placed valves, units, and sizes that fit together. The sources of the
// program read and judge them (src/program/CMakeLists.txt).
#include <algorithm>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "arguments.hpp"
#include "arrays.hpp"
#include "errors.hpp"
#include "module.hpp"
#include "program/base/area_samples.hpp"
#include "program/base/quantities.hpp"
#include "program/base/refusal.hpp"
#include "program/base/text.hpp"
#include "program/base/units.hpp"
#include "program/input/parameters.hpp"
#include "program/input/placing.hpp"
#include "program/input/valve_file.hpp"
#include "program/input/warp_source.hpp"

namespace riis_python {
namespace {

namespace program = riis::program;
constexpr program::Reader reader = program::Reader::python;

// Calls code of the program without the interpreter's lock, and throws its refusals as Python's exceptions. `subject` is the
// beginning of most refusals. The subject may be a path, whose words must not be replaced.
template <class Call>
void call_program(const std::string &subject, const Call &call) {
  check_not_logging();
  std::optional<program::Refusal> refusal;
  {
    const nb::gil_scoped_release release;
    const Inside inside;
    try {
      call();
    } catch (const program::Refusal &thrown) {
      refusal = thrown;
    }
  }
  if (!refusal) return;
  const std::string begin = refusal->text.rfind(subject + ": ", 0) == 0 ? subject + ": " : "";
  raise_status(refusal->status, begin + (begin.empty() ? refusal->text : in_python(&refusal->text[begin.size()])));
}

program::Json json_of(nb::handle value) {
  if (nb::hasattr(value, "tolist")) return json_of(value.attr("tolist")());
  if (value.is_none()) return nullptr;
  if (PyBool_Check(value.ptr())) return value.ptr() == Py_True;
  if (PyUnicode_Check(value.ptr())) return nb::cast<std::string>(value);
  if (PyDict_Check(value.ptr())) {
    program::Json made = program::Json::object();
    for (const auto &[name, item] : nb::cast<nb::dict>(value)) made[text(name, "landmarks")] = json_of(item);
    return made;
  }
  if (PyNumber_Check(value.ptr())) return number(value, "landmarks");
  if (!PySequence_Check(value.ptr())) refuse_type("landmarks", "a point is of type ", name_of_type(value));
  program::Json made = program::Json::array();
  for (const nb::handle item : value) made.push_back(json_of(item));
  return made;
}

std::optional<program::Unit> unit_or_none(nb::handle given) {
  if (given.is_none()) return std::nullopt;
  const std::string name = text(given, "unit");
  const auto unit = program::unit_of(name);
  if (!unit)
    raise_status(RIIS_INVALID_ARGUMENT,
                 text_of("unit is ", program::quoted(name), "; it must be ", program::one_of(program::unit_names())));
  return unit;
}

nb::dict placement_of(const double scale, const double (&axis)[3], double angle, const double (&translation)[3]) {
  nb::dict made;
  made["scale"] = scale;
  made["rotation_axis"] = nb::make_tuple(axis[0], axis[1], axis[2]);
  made["rotation_angle"] = angle;
  made["translation"] = nb::make_tuple(translation[0], translation[1], translation[2]);
  return made;
}

nb::object points_of(const std::vector<double> &xyz) { return copy_of(xyz.data(), {xyz.size() / 3, 3}); }

// ---- Landmarks ----

// Returns the request of a user of riis.place.
program::PlaceRequest request_of(nb::handle unit, nb::handle axes, nb::handle noise, nb::handle flow) {
  program::PlaceRequest request;
  request.reader = reader;
  request.unit = unit_or_none(unit);
  if (!axes.is_none()) request.axes = text(axes, "axes");
  if (!noise.is_none()) request.noise = number(noise, "noise");
  if (request.noise && !(*request.noise >= 0)) refuse_value("noise", *request.noise, " is below 0");
  if (!flow.is_none()) {
    double xyz[3];
    three_numbers(flow, "flow", xyz);
    request.flow.emplace(xyz, xyz + 3);
  }
  return request;
}

// Returns the fields of a PlaceResult that need no warp.
nb::dict fields_of(const program::Placed &placed) {
  const riis_placement &at = placed.placement;
  const program::LandmarkFile &file = placed.landmarks;
  nb::dict made, errors;
  nb::list names, by_state[4];  // by RIIS_SIZE_*
  for (const std::string &name : file.names) names.append(name);
  for (const program::Size &size : placed.sizes) {
    by_state[size.state].append(size.parameter.name);
    if (size.state == RIIS_SIZE_DETERMINED || size.state == RIIS_SIZE_UNDETERMINED)
      errors[size.parameter.name] = size.standard_error;
  }
  made["placement"] = placement_of(at.scale, at.rotation_axis, at.rotation_angle, at.translation);
  made["unit"] = program::name_of(file.unit);
  made["axes"] = program::name_of(file.axes);
  made["names"] = nb::tuple(names);
  made["residuals"] = copy_of(placed.residuals.data(), {placed.residuals.size()});
  made["rms"] = at.rms;
  made["worst"] = at.worst;
  made["worst_landmark"] = file.names[static_cast<std::size_t>(at.worst_landmark_id)];
  made["noise"] = at.noise;
  made["rotation_error"] = at.rotation_error;
  made["position_error"] = at.position_error;
  made["standard_errors"] = errors;
  made["determined"] = nb::tuple(by_state[RIIS_SIZE_DETERMINED]);
  made["undetermined"] = nb::tuple(by_state[RIIS_SIZE_UNDETERMINED]);
  made["in_proportion"] = nb::tuple(by_state[RIIS_SIZE_TIED]);
  made["points"] = points_of(file.xyz);
  made["places"] = points_of(placed.places);
  return made;
}

// Makes Python's object of a warp that the valve has.
nb::object object_of(riis::Warp warp, const program::Placed &placed, const nb::dict &fields, double noise,
                     Valve &valve) {
  auto own = std::make_unique<Warp>();
  own->handle = warp.release();
  own->sources = points_of(placed.sources);
  own->targets = points_of(placed.targets);
  own->placement = fields["placement"];
  own->noise = noise;
  nb::object made = nb::cast(own.release(), nb::rv_policy::take_ownership);
  valve.warp = nb::make_tuple(made.attr("__getstate__")(), nb::none());
  return made;
}

nb::dict place_landmarks(const std::string &subject, nb::handle content, nb::handle valve_, nb::handle unit,
                         nb::handle axes, nb::handle flow, nb::handle noise, nb::handle held_,
                         const std::string &warp_choice, nb::handle nodes_) {
  const program::PlaceRequest request = request_of(unit, axes, noise, flow);
  std::vector<std::string> held;
  for (const nb::handle name : held_) held.push_back(text(name, "held"));
  std::optional<Array> nodes;
  if (!nodes_.is_none()) nodes.emplace(Array::of<double>(nodes_, "nodes")).expect({-1, 3});
  if (nodes && nodes->size(0) == 0) refuse_value("nodes", "has no node");
  const bool is_file = PyUnicode_Check(content.ptr());
  const std::string words = is_file ? nb::cast<std::string>(content) : "";
  const program::Json root = is_file ? program::Json() : json_of(content);
  const bool is_made = nb::isinstance<Valve>(valve_);
  std::string kind = is_made ? object<Valve>(valve_, "valve").kind : valve_.is_none() ? "" : text(valve_, "valve");
  program::LandmarkFile file;
  call_program(subject, [&] {
    file = is_file ? program::read_landmarks(subject, words) : program::landmarks_of_json(subject, root);
    program::adapt(file, request);
    if (nodes) program::check_at_nodes(file, nodes->size(0), nodes->data<double>(), "", reader);
    kind = program::kind_of(file, kind, reader);
  });
  const nb::object made = is_made ? valve_.attr("copy")() : nb::type<Valve>()(kind);
  Valve &valve = object<Valve>(made, "valve");
  std::optional<program::Placed> placed;
  riis::Warp warp;
  double smoothing = 0;
  call_program(subject, [&] {
    if (!file.parameters.is_null()) program::set_from_json(valve.handle, file.parameters, subject + ": parameters");
    placed = program::place_by_landmarks(file, valve.handle, kind, held, reader);
    if (warp_choice == "smoothed") smoothing = placed->noise;
    if (warp_choice != "none") warp = program::warp_to_landmarks(*placed, valve.handle, smoothing, reader);
  });
  nb::dict fields = fields_of(*placed);
  fields["valve"] = made;
  if (placed->is_warped) {
    fields["warp"] = object_of(std::move(warp), *placed, fields, smoothing, valve);
    fields["warp_noise"] = smoothing;
    fields["warped_residuals"] = copy_of(placed->still_off.data(), {placed->still_off.size()});
  }
  fields["_report"] = program::place_report(*placed, reader);
  fields["_file"] = program::placed_file_of(*placed, valve.handle);
  return fields;
}

// Returns the content of a file of landmarks, in this unit and these axes if they are given.
nb::dict read_landmarks(nb::handle path_, nb::handle content_, nb::handle unit, nb::handle axes) {
  const std::string path = text(path_, "path"), content = text(content_, "content");
  const program::PlaceRequest request = request_of(unit, axes, nb::none(), nb::none());
  program::LandmarkFile file;
  call_program(path, [&] {
    file = program::read_landmarks(path, content);
    program::adapt(file, request);
  });
  nb::dict made;
  nb::list names;
  for (const std::string &name : file.names) names.append(name);
  made["names"] = names;
  made["points"] = points_of(file.xyz);
  made["flow_ends"] = points_of(file.flow_ends);
  made["flow"] = file.flow ? copy_of(file.flow->data(), {3}) : nb::object(nb::none());
  made["noise"] = file.noise ? nb::object(nb::float_(*file.noise)) : nb::object(nb::none());
  made["valve"] = file.valve;
  made["unit"] = program::name_of(file.unit);
  made["axes"] = program::name_of(file.axes);
  made["parameters"] = file.parameters.is_null() ? std::string("{}") : file.parameters.dump();
  return made;
}

std::string with_parameters(const std::string &placed, nb::handle valve_) {
  Valve &valve = object<Valve>(valve_, "valve");
  const Reading reading(valve.usage, "valve");
  return program::with_parameters_of(placed, valve.handle);
}

// ---- Placed valves ----

struct PlacedFile {
  PlacedFile() = default;
  PlacedFile(PlacedFile &&) = default;  // a warp is not copied

  std::string path;
  program::PlacedFile file;
  program::WarpSource warp;
};

void create_placed(PlacedFile *self, nb::handle path_, nb::handle content_, nb::handle unit_) {
  const std::string path = text(path_, "path"), content = text(content_, "content");
  const auto unit = unit_or_none(unit_);
  PlacedFile made;
  made.path = path;
  call_program(path, [&] {
    made.file = program::read_placed(path, program::parse_json(path, content, "a placed valve"), unit);
    if (!made.file.warp.is_null())
      made.warp = program::WarpSource(path, "warp", made.file.warp, made.file.where, made.file.factor);
    if (made.warp.moves()) program::refuse_file(path, "warp: its landmarks move, and a valve at rest is read here");
  });
  new (self) PlacedFile(std::move(made));
}

void set_parameters(PlacedFile &self, nb::handle valve_) {
  Valve &valve = object<Valve>(valve_, "valve");
  const Writing writing(valve.usage, "valve");
  call_program(self.path,
               [&] { program::set_from_json(valve.handle, self.file.parameters, self.path + ": parameters"); });
}

// Returns sources and targets for each warp, of the closed state and of the open one.
nb::list warps_of(PlacedFile &self) {
  nb::list made;
  for (const program::LandmarkPairs &pairs : self.warp.pairs())
    made.append(nb::make_tuple(points_of(pairs.sources()), points_of(pairs.targets())));
  return made;
}

// ---- Units and sizes ----

// Returns R as the program reads it: from a text in SI units if it has a unit, and whether it has one.
nb::tuple read_resistance(const std::string &text) {
  program::Amount amount;
  call_program("resistance", [&] { amount = program::parse_amount(text, "resistance", program::a_resistance); });
  return nb::make_tuple(amount.number, amount.has_unit);
}

// Returns R in the units of the mesh for 1 kg/(m s), and the names of the units of R and K.
nb::tuple resistance_units(const std::string &unit) {
  const program::Unit of = *program::unit_of(unit);
  return nb::make_tuple(program::factor_from_si(program::a_resistance, of),
                        program::unit_text(program::a_resistance, of), program::unit_text(program::a_K, of));
}

nb::dict units() {
  nb::dict made;
  for (const std::string &name : program::unit_names()) {
    const program::Unit unit = *program::unit_of(name);
    made[name.c_str()] =
        nb::make_tuple(program::factor_between(program::Unit::centimetre, unit), program::words_of(unit));
  }
  return made;
}

nb::tuple mesh_sides(nb::handle points_) {
  const Array points = Array::of<double>(points_, "points");
  points.expect({-1, 3});
  program::Box box = program::empty_box();
  program::Moments moments;
  for (std::int64_t i = 0; i < points.size(0); ++i) {
    box.grow(points.data<double>() + 3 * i);
    moments.add(points.data<double>() + 3 * i);
  }
  const auto sides = program::sides_of(box, moments);
  return nb::make_tuple(sides[0], sides[1], sides[2]);
}

nb::tuple judge_sizes(nb::handle sides, const nb::tuple &surface, nb::handle edge, nb::handle half_thickness,
                      nb::handle is_unit_known) {
  program::Sizes sizes{
      {},  {}, number(edge, "edge"), number(half_thickness, "half_thickness"), flag(is_unit_known, "is_unit_known"),
      true};
  double of_mesh[3];
  three_numbers(sides, "sides", of_mesh);
  std::copy_n(of_mesh, 3, sizes.mesh_sides.begin());
  three_numbers(surface[0], "surface", sizes.surface.lower);
  three_numbers(surface[1], "surface", sizes.surface.upper);
  const program::UnitJudgement judgement = program::judge_units(sizes, program::unit_factors());
  const bool is_possible = judgement.is_right || judgement.is_possible(1);
  for (const double factor : judgement.factors)
    if (factor != 1 && !judgement.is_right) return nb::make_tuple(is_possible, 1 / factor);
  return nb::make_tuple(is_possible, nb::none());
}

nb::tuple area_samples(Surface &surface) {
  const Reading reading(surface.usage, "surface");
  program::AreaSamples samples;
  call_program("surface", [&] { samples = program::area_samples(surface.handle); });
  const std::size_t n = samples.area.size();
  return nb::make_tuple(copy_of(samples.xyz.data(), {n, 3}), copy_of(samples.area.data(), {n}));
}

}  // namespace

void add_patient(nb::module_ &module) {
  module.def("units", &units, nb::sig("def units() -> dict[str, tuple[float, str]]"),
             "Returns the units by name, with their lengths in a centimetre and the word for several.");
  module.def("read_resistance", &read_resistance, nb::arg("text"),
             nb::sig("def read_resistance(text: str) -> tuple[float, bool]"),
             "Reads R, such as 1e5 g/(cm s). Returns it in kg/(m s) if it has a unit, and whether it has one.");
  module.def("resistance_units", &resistance_units, nb::arg("unit"),
             nb::sig("def resistance_units(unit: str) -> tuple[float, str, str]"),
             "Returns R in the units of a mesh for 1 kg/(m s), and the names of the units of R and K.");
  module.attr("LARGEST_HALF_THICKNESS") = program::largest_half_thickness;  // as a multiple of the largest side of
                                                                            // the valve
  module.attr("USUAL_HALF_THICKNESS") = program::usual_half_thickness;
  module.attr("MOST_OUTSIDE") = program::most_outside;  // of the leaflets' area, outside a mesh
  module.def("area_samples", &area_samples, nb::arg("surface"),
             nb::sig("def area_samples(surface: Surface) -> tuple[numpy.typing.NDArray[numpy.float64], "
                     "numpy.typing.NDArray[numpy.float64]]"),
             "Returns points on the leaflets without skirt and housing, and the area for which each point stands.");
  module.def("mesh_sides", &mesh_sides, nb::arg("points").none(),
             nb::sig("def mesh_sides(points: typing.Any) -> tuple[float, float, float]"),
             "Returns the sides of a mesh along its principal axes, the longest first.");
  module.def("judge_sizes", &judge_sizes, nb::arg("sides").none(), nb::arg("surface").none(), nb::arg("edge").none(),
             nb::arg("half_thickness").none(), nb::arg("is_unit_known").none(),
             nb::sig("def judge_sizes(sides: tuple[float, float, float], surface: tuple[typing.Any, typing.Any], "
                     "edge: float, half_thickness: float, is_unit_known: bool) -> tuple[bool, float | None]"),
             R"(Judges whether a mesh and a valve may have the same unit.

sides           of the mesh, the longest first
surface         lower and upper corners
edge            median edge of the mesh; 0 if unknown
is_unit_known   whether the user named the unit

Returns whether the sizes fit, and the factor by which the valve's scale would have to change, or None.)");
  module.def(
      "place_landmarks", &place_landmarks, nb::arg("subject"), nb::arg("content").none(), nb::arg("valve").none(),
      nb::arg("unit").none(), nb::arg("axes").none(), nb::arg("flow").none(), nb::arg("noise").none(),
      nb::arg("held").none(), nb::arg("warp"), nb::arg("nodes").none(),
      nb::sig("def place_landmarks(subject: str, content: str | dict[str, typing.Any], valve: Valve | str | None, "
              "unit: str | None, axes: str | None, flow: typing.Any, noise: float | None, held: "
              "collections.abc.Iterable[str], warp: str, nodes: typing.Any) -> dict[str, typing.Any]"),
      "Does the work of riis.place, whose result has these fields.");
  module.def("read_landmarks", &read_landmarks, nb::arg("path").none(), nb::arg("content").none(),
             nb::arg("unit").none(), nb::arg("axes").none(),
             nb::sig("def read_landmarks(path: str, content: str, unit: str | None, axes: str | None) -> dict[str, "
                     "typing.Any]"),
             "Returns the names and points of a file of landmarks, and what else it states. parameters is JSON.");
  module.def("with_parameters", &with_parameters, nb::arg("placed_file"), nb::arg("valve").none(),
             nb::sig("def with_parameters(placed_file: str, valve: Valve) -> str"),
             "Returns the file of a placed valve with the valve's present parameters.");
  nb::class_<PlacedFile>(module, "PlacedFile", "The file of a placed valve, for riis.read_placed.")
      .def("__init__", &create_placed, nb::arg("path").none(), nb::arg("content").none(), nb::arg("unit").none(),
           nb::sig("def __init__(self, path: str, content: str, unit: str | None) -> None"))
      .def("set_parameters", &set_parameters, nb::arg("valve").none(),
           nb::sig("def set_parameters(self, valve: Valve) -> None"))
      .def_prop_ro("kind", [](PlacedFile &self) { return self.file.kind; })
      .def_prop_ro("unit", [](PlacedFile &self) { return program::name_of(self.file.unit); })
      .def_prop_ro(
          "placement",
          [](PlacedFile &self) {
            const riis_surface_options &at = self.file.where;
            return placement_of(at.scale, at.rotation_axis, at.rotation_angle, at.translation);
          },
          nb::sig("def placement(self) -> dict[str, typing.Any]"))
      .def_prop_ro("warps", &warps_of,
                   nb::sig("def warps(self) -> list[tuple[numpy.typing.NDArray[numpy.float64], "
                           "numpy.typing.NDArray[numpy.float64]]]"))
      .def_prop_ro("is_in_mesh", [](PlacedFile &self) { return self.warp.is_in_mesh(); })
      .def_prop_ro("noise", [](PlacedFile &self) { return self.warp.noise(); });
}

}  // namespace riis_python
