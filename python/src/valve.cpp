// SPDX-License-Identifier: Apache-2.0

#include "module.hpp"

namespace riis_python {
namespace {

std::int64_t n_parameters(const Valve &valve) {
  std::int64_t n = 0;
  call_shortly(riis_valve_get_n_parameters(valve.handle, &n));
  return n;
}

riis_parameter parameter(const Valve &valve, std::int64_t id) {
  riis_parameter found;
  call_shortly(riis_valve_get_parameter(valve.handle, id, &found, sizeof found));
  return found;
}

// Returns whether a name is the parameter's second name, such as "annulus" or "right.stj".
bool is_other_name(const riis_parameter &parameter, const std::string &name) {
  const std::string full = parameter.name, other = parameter.other_name;
  const std::size_t dot = full.rfind('.');
  return !other.empty() && name == (dot == std::string::npos ? other : full.substr(0, dot + 1) + other);
}

// Returns the number of values of a parameter, or 0 if there is no parameter with this name.
std::int64_t n_values(const Valve &valve, const std::string &name) {
  for (std::int64_t id = 0, n = n_parameters(valve); id < n; ++id) {
    const riis_parameter found = parameter(valve, id);
    if (name == found.name || is_other_name(found, name)) return found.n_values;
  }
  return 0;
}

// Throws the KeyError of a mapping, with the library's message.
[[noreturn]] void refuse_unknown(const Valve &valve, const std::string &name) {
  double value = 0;
  riis_valve_get(valve.handle, name.c_str(), 1, &value);
  const std::string message = in_python(riis_last_error());
  const nb::object error = nb::module_::import_("riis._errors").attr("UnknownParameterError");
  PyErr_SetObject(error.ptr(), nb::str(message.c_str()).ptr());
  throw nb::python_error();
}

void set(Valve &valve, nb::handle key, nb::handle value) {
  const Writing writing(valve.usage, "valve");
  const std::string name = text(key, "name");
  if (has_entries(value)) {
    double values[3];
    three_numbers(value, name.c_str(), values);
    call_shortly(riis_valve_set(valve.handle, name.c_str(), 3, values));
  } else {
    call_shortly(riis_valve_set_scalar(valve.handle, name.c_str(), number(value, name.c_str())));
    if (name == "skirt_length") valve.has_wall_lengths = false;
  }
}

nb::object get(Valve &valve, nb::handle key) {
  const Reading reading(valve.usage, "valve");
  const std::string name = text(key, "name");
  double values[3] = {};
  const std::int64_t n = n_values(valve, name);
  if (n == 0) refuse_unknown(valve, name);
  call_shortly(riis_valve_get(valve.handle, name.c_str(), n, values));
  return n == 1 ? nb::object(nb::float_(values[0])) : array_of(values, "float64");
}

void unset(Valve &valve, nb::handle key) {
  const Writing writing(valve.usage, "valve");
  call_shortly(riis_valve_unset(valve.handle, text(key, "name").c_str()));
}

bool is_set(Valve &valve, nb::handle key) {
  const Reading reading(valve.usage, "valve");
  std::int32_t found = 0;
  call_shortly(riis_valve_is_set(valve.handle, text(key, "name").c_str(), &found));
  return found != 0;
}

void set_all(Valve &valve, const nb::dict &parameters) {
  for (const auto [name, value] : parameters) set(valve, name, value);
}

// Sets parameters from the same arguments as dict.update.
void update(Valve &valve, nb::handle other, const nb::kwargs &parameters) {
  nb::dict all;
  if (!other.is_none()) {
    if (!nb::hasattr(other, "__iter__"))
      refuse_type("other", "must be a mapping, or pairs of name and value, not ", name_of_type(other));
    all.attr("update")(other);
  }
  set_all(valve, all);
  set_all(valve, parameters);
}

void create(Valve *self, nb::handle kind, const nb::kwargs &parameters) {
  new (self) Valve();
  try {
    self->kind = text(kind, "kind");
    call_shortly(riis_valve_create(self->kind.c_str(), &self->handle));
    set_all(*self, parameters);
  } catch (...) {
    self->~Valve();
    throw;
  }
}

Valve *copy(Valve &valve) {
  const Reading reading(valve.usage, "valve");
  auto made = std::make_unique<Valve>();
  made->kind = valve.kind;
  made->patches = valve.patches;
  made->open = valve.open;
  made->warp = valve.warp;
  made->has_wall_lengths = valve.has_wall_lengths;
  call_shortly(riis_valve_copy(valve.handle, &made->handle));
  return made.release();
}

Valve *from_patches(nb::handle degree, nb::handle control, nb::handle curve_id, nb::handle reversed,
                    nb::handle leaflet_id, nb::handle index_base) {
  riis_patches patches;
  call_shortly(riis_patches_init(&patches, sizeof patches));
  const Array degrees = Array::of<std::int32_t>(degree, "degree");
  degrees.expect({-1});
  std::int64_t n_points = 0;
  for (std::int64_t i = 0; i < degrees.size(0); ++i) {
    const std::int32_t d = degrees.data<std::int32_t>()[i];
    if (d < 1 || d > 3) refuse_value("degree", "entry ", i, " is ", d, "; it must be 1, 2 or 3");
    n_points += d + 1;
  }
  const Array points = Array::of<double>(control, "control");
  points.expect({n_points, 3});
  const Array curves = Array::of<std::int32_t>(curve_id, "curve_id");
  curves.expect({-1, 4});
  patches.n_curves = degrees.size(0);
  patches.degree = degrees.data<std::int32_t>();
  patches.control = points.data<double>();
  patches.n_patches = curves.size(0);
  patches.curve_id = curves.data<std::int32_t>();
  patches.index_base = integer32(index_base, "index_base");
  std::optional<Array> reversals, leaflets;
  if (!reversed.is_none()) {
    reversals.emplace(Array::of<std::int32_t>(reversed, "reversed")).expect({patches.n_patches, 4});
    patches.reversed = reversals->data<std::int32_t>();
  }
  if (!leaflet_id.is_none()) {
    leaflets.emplace(Array::of<std::int32_t>(leaflet_id, "leaflet_id")).expect({patches.n_patches});
    patches.leaflet_id = leaflets->data<std::int32_t>();
  }
  auto made = std::make_unique<Valve>();
  made->kind = "patches";
  const auto own = [](nb::handle array) {
    return array.is_none() ? nb::object(nb::none()) : nb::module_::import_("numpy").attr("array")(array);
  };
  made->patches =
      nb::make_tuple(own(degree), own(control), own(curve_id), own(reversed), own(leaflet_id), patches.index_base);
  call_library([&] { return riis_valve_create_from_patches(&patches, &made->handle); });
  return made.release();
}

void set_open_state(Valve &valve, nb::handle open_) {
  Valve &open = object<Valve>(open_, "open");
  open.usage.check("open");
  const Writing writing(valve.usage, "valve");
  if (&open != &valve && open.usage.is_written) Reading::refuse_busy("open");
  auto kept = std::make_unique<Valve>();
  kept->kind = open.kind;
  kept->patches = open.patches;
  call_shortly(riis_valve_copy(open.handle, &kept->handle));
  const nb::object owner = nb::cast(kept.release(), nb::rv_policy::take_ownership);
  call_shortly(riis_valve_set_open_state(valve.handle, open.handle));
  valve.open = owner;
}

nb::list names_of(Valve &valve) {
  const Reading reading(valve.usage, "valve");
  nb::list names;
  for (std::int64_t id = 0, n = n_parameters(valve); id < n; ++id) names.append(parameter(valve, id).name);
  return names;
}

nb::dict parameters(Valve &valve) {
  const Reading reading(valve.usage, "valve");
  const nb::object make = record("Parameter");
  nb::dict all;
  for (std::int64_t id = 0, n = n_parameters(valve); id < n; ++id) {
    const riis_parameter found = parameter(valve, id);
    const nb::object value = found.n_values == 1 ? nb::object(nb::float_(found.default_values[0]))
                                                 : array_of(found.default_values, "float64");
    all[found.name] = make(found.name, found.unit, in_python(found.description), found.n_values, value, found.minimum,
                           found.maximum, found.rule, found.other_name, found.other_factor);
  }
  return all;
}

bool contains(Valve &valve, nb::handle name) {
  if (!PyUnicode_Check(name.ptr())) return false;
  const Reading reading(valve.usage, "valve");
  return n_values(valve, nb::cast<std::string>(name)) > 0;
}

nb::object get_or(Valve &valve, nb::handle name, nb::handle otherwise) {
  return contains(valve, name) ? get(valve, name) : nb::borrow(otherwise);
}

// Returns a view of a mapping from collections.abc.
nb::object mapping_view(const char *view, nb::handle self) {
  object<Valve>(self, "valve").usage.check("valve");
  return nb::module_::import_("collections.abc").attr(view)(self);
}

nb::dict values_of(Valve &valve) {
  nb::dict all;
  for (const nb::handle name : names_of(valve)) all[name] = get(valve, name);
  return all;
}

nb::dict values_that_were_set(Valve &valve) {
  nb::dict all;
  for (const nb::handle name : names_of(valve))
    if (is_set(valve, name)) all[name] = get(valve, name);
  return all;
}

// Returns the values from which pickle makes the valve.
nb::tuple state_of(Valve &valve) {
  if (valve.has_wall_lengths)
    raise_status(RIIS_INVALID_ARGUMENT,
                 "valve: its skirt reaches a wall, and the lengths cannot be pickled: pickle it before skirt_to_wall");
  return nb::make_tuple(valve.kind, values_that_were_set(valve), valve.open, valve.patches, valve.warp);
}

void make_from_state(Valve *self, const nb::tuple &state) {
  const nb::object kind = state[0], open = state[2], patches = state[3];
  const nb::handle type = nb::type<Valve>();
  const nb::object made =
      patches.is_none()
          ? type(kind)
          : type.attr("from_patches")(patches[0], patches[1], patches[2], nb::arg("reversed") = patches[3],
                                      nb::arg("leaflet_id") = patches[4], nb::arg("index_base") = patches[5]);
  Valve &valve = object<Valve>(made, "valve");
  if (!open.is_none()) {
    // The library refuses an open state that does not fit the valve. The valve therefore first takes the values of the open
    // state. The real values of the valve come last, because only surfaces check whether they fit the open state.
    set_all(valve, values_of(object<Valve>(open, "open")));
    set_open_state(valve, open);
    for (const nb::handle name : names_of(valve)) unset(valve, name);
  }
  set_all(valve, nb::cast<nb::dict>(state[1]));
  warp_as_pickled(made, nb::object(state[4]));
  new (self) Valve();
  self->kind = valve.kind;
  self->patches = valve.patches;
  self->open = valve.open;
  self->warp = valve.warp;
  self->take(valve);
}

std::string description(Valve &valve) {
  if (valve.usage.is_closed) return "<riis.Valve, closed>";
  return text_of("<riis.Valve '", valve.kind, "', opening ", nb::cast<double>(get(valve, nb::str("opening"))), ">");
}

}  // namespace

nb::object record(const char *name) { return nb::module_::import_("riis._records").attr(name); }

void add_valve(nb::module_ &module) {
  nb::class_<Valve> valve(module, "Valve", nb::sig("class Valve(collections.abc.Mapping[str, typing.Any])"),
                          R"(A parametric valve: its kind and the values of its parameters.

kind is 'aortic' (the paper's three cusps), 'mitral', 'coapting' (three cusps with a zone of coaptation), 'bicuspid' and
'quadricuspid' (two and four such cusps), 'mitral_coapting' and 'tricuspid' (leaflets with a zone of coaptation, hung
from a saddle), 'trileaflet' (three equal cusps that close in straight lines) or 'bileaflet' (a mechanical prosthesis).
The opening is 0, closed, to 1, open. By default 'mitral' is open, and all other kinds are closed.
Keywords set parameters: Valve('mitral', opening=0.3), Valve('bicuspid', **{'cusp_0.sector': 150}).

A valve is a mapping from names to values: valve['AP_diameter'] = 3.1 sets a parameter, valve['opening'] reads it,
dict(valve) has all values. Names cannot be added or removed. A valve can be pickled. Lengths are in centimetres by
default, angles in degrees. A name such as 'leaflet_angle' of an aortic valve stands for all three cusps and can only
be set; 'right.leaflet_angle' belongs to one cusp. A coapting valve has its own 'effective_height', which
'cusp_0.effective_height' and so on follow until they are set. Rotation, translation, t0_* and t3_* have three values.

Bumps, 'bump_0' to 'bump_5', are disease at one place of a free edge (docs/theory/bumps.md): valve.update({
'bump_0.leaflet': 0, 'bump_0.open': 0.3}). Leaflets, commissures and bumps count from 0.

Sizes by a surgeon's names: annulus and stj (diameters) and effective_height, as in
Valve('trileaflet', annulus=2.4, stj=2.6, effective_height=1.0). Some parameters have a rule: unless they are set, they
follow from others, and reading them gives their present values (valve.parameters[name].rule). dict(valve) holds these
values too, so a valve made from it has all parameters set. Copies and pickles keep which parameters were set.)");
  valve
      .def("__init__", &create, nb::arg("kind").none() = "aortic", nb::arg("parameters"),
           nb::sig("def __init__(self, kind: str = 'aortic', **parameters: float | collections.abc.Sequence[float] | "
                   "numpy.typing.NDArray[numpy.float64]) -> None"))
      .def_static(
          "from_patches", &from_patches, nb::arg("degree").none(), nb::arg("control").none(),
          nb::arg("curve_id").none(), nb::kw_only(), nb::arg("reversed").none() = nb::none(),
          nb::arg("leaflet_id").none() = nb::none(), nb::arg("index_base").none() = 0,
          nb::sig(
              "def from_patches(degree: numpy.typing.NDArray[numpy.int32], control: "
              "numpy.typing.NDArray[numpy.float64], curve_id: numpy.typing.NDArray[numpy.int32], *, reversed: "
              "numpy.typing.NDArray[numpy.int32] | None = None, leaflet_id: numpy.typing.NDArray[numpy.int32] | None "
              "= None, index_base: int = 0) -> Valve"),
          R"(Makes a valve from Coons patches between Bézier curves.

degree       (n_curves,) int32: 1, 2 or 3
control      (sum of degree + 1, 3) float64: the control points, one curve after the other
curve_id     (n_patches, 4) int32: the curves at v = 0, v = 1, u = 0, u = 1, counted from index_base
reversed     (n_patches, 4) int32: 1 if the side runs opposite to its curve
leaflet_id   (n_patches,) int32, >= 0; default 0

The valve's parameters are 'opening' and 'skirt_length'. Arrays are copied.)")
      .def("__setitem__", &set, nb::arg("name").none(), nb::arg("value").none(),
           nb::sig("def __setitem__(self, name: str, value: float | collections.abc.Sequence[float] | "
                   "numpy.typing.NDArray[numpy.float64]) -> None"),
           "Sets a parameter to one value or to three values.")
      .def("__getitem__", &get, nb::arg("name").none(), nb::sig("def __getitem__(self, name: str) -> typing.Any"),
           "Returns a parameter: a float, or an array (3,) for a parameter with three values.")
      .def("__contains__", &contains, nb::arg("name").none(), nb::sig("def __contains__(self, name: object) -> bool"))
      .def(
          "__iter__", [](Valve &self) { return nb::iter(names_of(self)); },
          nb::sig("def __iter__(self) -> collections.abc.Iterator[str]"))
      .def("__len__", [](Valve &self) { return nb::len(names_of(self)); })
      .def(
          "keys", [](nb::handle self) { return mapping_view("KeysView", self); },
          nb::sig("def keys(self) -> collections.abc.KeysView[str]"), "Returns a view of the parameters' names.")
      .def(
          "values", [](nb::handle self) { return mapping_view("ValuesView", self); },
          nb::sig("def values(self) -> collections.abc.ValuesView[typing.Any]"),
          "Returns a view of the parameters' values.")
      .def(
          "items", [](nb::handle self) { return mapping_view("ItemsView", self); },
          nb::sig("def items(self) -> collections.abc.ItemsView[str, typing.Any]"),
          "Returns a view of the pairs of name and value.")
      .def("get", &get_or, nb::arg("name").none(), nb::arg("default").none() = nb::none(),
           nb::sig("def get(self, name: str, default: typing.Any = None, /) -> typing.Any"),
           "Returns a parameter as valve[name] does, or default if there is no parameter of this name.")
      .def("update", &update, nb::arg("other").none() = nb::none(), nb::arg("parameters"),
           nb::sig("def update(self, other: collections.abc.Mapping[str, typing.Any] | "
                   "collections.abc.Iterable[tuple[str, typing.Any]] | None = None, /, **parameters: float | "
                   "collections.abc.Sequence[float] | numpy.typing.NDArray[numpy.float64]) -> None"),
           "Sets several parameters, like dict.update: valve.update(opening=0.3), valve.update({'right.leaflet_angle': "
           "20}).")
      .def("unset", &unset, nb::arg("name").none(), nb::sig("def unset(self, name: str) -> None"),
           "Returns a parameter to the value of a valve on which it was not set: its rule's value, or its default.")
      .def("is_set", &is_set, nb::arg("name").none(), nb::sig("def is_set(self, name: str) -> bool"),
           "Returns whether a parameter was set. False: it has its default or follows its rule.")
      .def("__getstate__", &state_of, nb::sig("def __getstate__(self) -> tuple[typing.Any, ...]"))
      .def("__setstate__", &make_from_state, nb::arg("state"),
           nb::sig("def __setstate__(self, state: tuple[typing.Any, ...]) -> None"))
      .def("copy", &copy, nb::sig("def copy(self) -> Valve"),
           "Returns a copy: a valve with the same parameters and states.")
      .def("__copy__", &copy, nb::sig("def __copy__(self) -> Valve"))
      .def(
          "__deepcopy__", [](Valve &self, nb::handle) { return copy(self); }, nb::arg("memo").none(),
          nb::sig("def __deepcopy__(self, memo: object) -> Valve"))
      .def("set_open_state", &set_open_state, nb::arg("open").none(),
           nb::sig("def set_open_state(self, open: Valve) -> None"),
           R"(Gives the valve an open state: its own state is at opening 0, and that of the valve `open` at opening 1.

open is copied. It must be of the same kind. A valve from patches must have the same curves, degrees and sides.)")
      .def_prop_ro("parameters", attribute(&parameters),
                   nb::sig("def parameters(self) -> dict[str, riis._records.Parameter]"),
                   "Descriptions of the parameters by name: unit, text, default, minimum, maximum.")
      .def_prop_ro("kind", attribute(+[](const Valve &self) { return self.kind; }),
                   "The kind, such as 'mitral'; 'patches' for from_patches.")
      .def("__repr__", &description);
  add_closing(valve);
  nb::module_::import_("collections.abc").attr("Mapping").attr("register")(valve);
}

}  // namespace riis_python
