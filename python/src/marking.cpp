// SPDX-License-Identifier: Apache-2.0

#include "module.hpp"

namespace riis_python {
namespace {

// The fields by name: the attribute, the bit, and the pointer in the library's list. A field without a bit is made without a
// request, from what `needs` names.
struct Field {
  const char *name;
  std::int32_t bit;
  const double *riis_mark_list::*reals;
  const std::int32_t *riis_mark_list::*integers;
  std::size_t n_components;
  const char *signature;
  const char *text;
  const char *needs = nullptr;
};

constexpr std::size_t per_direction = 0;  // as many components as the surface had directions

#define RIIS_REALS(name) "def " name "(self) -> numpy.typing.NDArray[numpy.float64]"
#define RIIS_INTEGERS(name) "def " name "(self) -> numpy.typing.NDArray[numpy.int32]"

const Field fields[] = {
    {"point", RIIS_FIELD_POINT, &riis_mark_list::point, nullptr, 3, RIIS_REALS("point"),
     "(n, 3): the closest points of the surface, mesh units. Needs fields='point'. A view."},
    {"normal", RIIS_FIELD_NORMAL, &riis_mark_list::normal, nullptr, 3, RIIS_REALS("normal"),
     "(n, 3): the unit normals at these points. Needs fields='normal'. A view."},
    {"barycentric", RIIS_FIELD_BARYCENTRIC, &riis_mark_list::barycentric, nullptr, 3, RIIS_REALS("barycentric"),
     "(n, 3): the closest points' barycentric coordinates. Needs fields='barycentric'. A view."},
    {"side", RIIS_FIELD_SIDE, nullptr, &riis_mark_list::side, 1, RIIS_INTEGERS("side"),
     "(n,): +1 downstream of the surface, -1 upstream, 0 on neither side. Needs fields='side'. A view."},
    {"rim", RIIS_FIELD_RIM, nullptr, &riis_mark_list::rim, 1, RIIS_INTEGERS("rim"),
     "(n,): 1 if the closest point lies on the rim of the surface, else 0. Needs fields='rim'. A view."},
    {"uv", RIIS_FIELD_UV, &riis_mark_list::uv, nullptr, 2, RIIS_REALS("uv"),
     "(n, 2): the closest points' u and v on their patches, 0 to 1. Needs fields='uv'. A view."},
    {"velocity", RIIS_FIELD_VELOCITY, &riis_mark_list::velocity, nullptr, 3, RIIS_REALS("velocity"),
     "(n, 3): the surface's velocities at the closest points, from its last update. Needs fields='velocity'. A view."},
    {"patch_id", RIIS_FIELD_PATCH, nullptr, &riis_mark_list::patch_id, 1, RIIS_INTEGERS("patch_id"),
     "(n,): the patches of the closest points. Needs fields='patch_id'. A view."},
    {"distance_gradient", RIIS_FIELD_GRADIENT, &riis_mark_list::distance_gradient, nullptr, per_direction,
     RIIS_REALS("distance_gradient"),
     "(n, directions): the derivatives of the distances in the directions of Surface.add_direction. Needs "
     "fields='distance_gradient'. A view."},
    {"K", 0, &riis_mark_list::K, nullptr, 1, RIIS_REALS("K"), "(n,): K of the nodes. Needs R=. A view.",
     "mark with R="},
    {"K_u_surface", 0, &riis_mark_list::K_u_surface, nullptr, 3, RIIS_REALS("K_u_surface"),
     "(n, 3): K u_surface of the nodes. Needs R= and a surface with velocities. A view.",
     "mark with R= and a surface with velocities"},
    {"K_gradient", 0, &riis_mark_list::K_gradient, nullptr, per_direction, RIIS_REALS("K_gradient"),
     "(n, directions): the derivatives of K in these directions. Needs R= and fields='distance_gradient'. A view.",
     "mark with R= and fields='distance_gradient'"},
    {"height", 0, &riis_mark_list::height, nullptr, 1, RIIS_REALS("height"),
     "(n,): the nodes' signed distances s to a surface with an offset o, mesh units, above 0 downstream; at a rim "
     "normal . (x - point). The band has |s - o eps| <= eps. Needs an offset. A view.",
     "mark with a surface that has an offset"},
};

std::int32_t field_of(const std::string &name) {
  std::string all;
  for (const Field &field : fields) {
    if (!field.bit) continue;
    if (name == field.name) return field.bit;
    all += text_of(all.empty() ? "" : ", ", "'", field.name, "'");
  }
  refuse_value("fields", "'", name, "' is not a field; the fields are ", all);
}

// Returns the sum of the named fields. The argument is a sequence of names, or a text with names separated by commas or blanks.
std::int32_t fields_of(nb::handle wanted) {
  if (wanted.is_none()) return 0;
  std::int32_t sum = 0;
  if (PyUnicode_Check(wanted.ptr())) {
    std::string names = text(wanted, "fields");
    for (char &letter : names)
      if (letter == ',') letter = ' ';
    std::istringstream words(names);
    for (std::string name; words >> name;) sum |= field_of(name);
    return sum;
  }
  if (!PySequence_Check(wanted.ptr()))
    refuse_type("fields", "must be a str or a sequence of str, not ", name_of_type(wanted));
  for (const nb::handle name : nb::borrow(wanted)) sum |= field_of(text(name, "fields"));
  return sum;
}

// Warns if the marks look wrong. Judges once for each surface, mesh, scale and half thickness.
void warn_of_odd_marks(nb::handle surface_, nb::handle mesh_, nb::handle mask, nb::handle marks) {
  Surface &surface = object<Surface>(surface_, "surface");
  const riis_surface_options &options = surface.options;
  const std::int64_t mesh = object<Mesh>(mesh_, "mesh").number;
  if (!surface.judged.emplace(mesh, options.scale, options.half_thickness).second) return;
  nb::module_::import_("riis._odd_marks").attr("warn")(surface_, mesh_, mask, marks);
}

double half_thickness_of(const Surface &surface) {
  riis_surface_info info;
  call_shortly(riis_surface_get_info(surface.handle, &info, sizeof info));
  return info.half_thickness;
}

nb::object mark(nb::handle surface_, nb::handle mesh_, nb::handle into, nb::handle wanted_fields,
                nb::handle distance_limit, nb::handle mask, nb::handle search, nb::handle n_threads,
                nb::handle instructions, nb::handle R, nb::handle half_thickness, nb::handle rim,
                nb::handle allow_none) {
  Surface &surface = object<Surface>(surface_, "surface");
  Mesh &mesh = object<Mesh>(mesh_, "mesh");
  const Reading reading_surface(surface.usage, "surface"), reading_mesh(mesh.usage, "mesh");
  MarkOptions given(mesh, mask, n_threads);
  riis_mark_options &options = given.options;
  options.distance_limit = number_or_auto(distance_limit, "distance_limit");
  options.search = choice(search, "search",
                          {{"auto", RIIS_SEARCH_AUTO},
                           {"exhaustive", RIIS_SEARCH_EXHAUSTIVE},
                           {"neighbor", RIIS_SEARCH_NEIGHBOR},
                           {"paper", RIIS_SEARCH_PAPER},
                           {"clusters", RIIS_SEARCH_CLUSTERS}});
  options.instructions = choice(instructions, "instructions",
                                {{"auto", RIIS_INSTRUCTIONS_AUTO},
                                 {"baseline", RIIS_INSTRUCTIONS_BASELINE},
                                 {"avx2", RIIS_INSTRUCTIONS_AVX2},
                                 {"avx512", RIIS_INSTRUCTIONS_AVX512}});
  options.fields = fields_of(wanted_fields);
  const bool may_find_none = flag(allow_none, "allow_none");
  std::optional<riis_resistance> resistance;
  if (!R.is_none())
    options.resistance = &resistance.emplace(resistance_of(R, half_thickness, rim));
  else if (!half_thickness.is_none() || !rim.is_none())
    refuse_value(half_thickness.is_none() ? "rim" : "half_thickness", "is given, but R is not");
  const nb::object result_object = into.is_none() ? nb::type<Marks>()() : nb::borrow(into);
  {
    Marks &result = object<Marks>(result_object, "into");
    const Writing writing(result.usage, "into");
    const auto mark_into = [&](Marks &to) {
      call_to_write(to.usage, [&] { return riis_mark_nodes(surface.handle, mesh.handle, &options, to.handle); });
    };
    if (result.is_shared()) {  // arrays still show the last marking
      Marks fresh;
      call_shortly(riis_marks_create(&fresh.handle));
      mark_into(fresh);
      result.take(fresh);
    } else {
      mark_into(result);
    }
    result.n_nodes = mesh.points.n;
    result.n_threads = options.n_threads;
    result.marking_fork = fork_number();
    result.places = mesh.places;
    result.half_thickness = half_thickness_of(surface);
  }
  // The judgement makes surfaces, which a child of fork() may not be able to do.
  if (!may_find_none && !is_forked()) warn_of_odd_marks(surface_, mesh_, mask, result_object);
  return result_object;
}

// The nodes of a marking within the distance limit.
struct WithinLimit {
  static constexpr const char *python_name = "WithinLimit";
  nb::object result;
};

// Reads a list of Marks or of WithinLimit.
struct ListReader {
  explicit ListReader(nb::handle self) {
    is_limit = nb::isinstance<WithinLimit>(self);
    owner = is_limit ? object<WithinLimit>(self, "self").result : nb::borrow(self);
    result = &object<Marks>(owner, "marks");
    reading.emplace(result->usage, "marks");
  }
  riis_mark_list list() const {
    riis_mark_list found;
    const std::int32_t which = is_limit ? RIIS_LIST_WITHIN_LIMIT : RIIS_LIST_MARKED;
    call_shortly(riis_marks_get_list(result->handle, which, &found, sizeof found));
    return found;
  }
  template <class T>
  nb::object view(const T *data, std::int64_t n, std::size_t n_components = 1) const {
    const auto size = static_cast<std::size_t>(n);
    return n_components == 1 ? view_of(data, {size}, result->share())
                             : view_of(data, {size, n_components}, result->share());
  }

  bool is_limit = false;
  nb::object owner;
  Marks *result = nullptr;
  std::optional<Reading> reading;
};

template <auto riis_mark_list::*member>
nb::object list_view(nb::handle self) {
  const ListReader reader(self);
  const riis_mark_list list = reader.list();
  return reader.view(list.*member, list.n_nodes);
}

template <int number>
nb::object field_view(nb::handle self) {
  const Field &field = fields[number];
  const ListReader reader(self);
  const riis_mark_list found = reader.list();
  const void *data = field.reals ? static_cast<const void *>(found.*field.reals) : found.*field.integers;
  if (!data && found.n_nodes > 0)
    field.bit ? refuse_value(field.name, "the marking did not request it; mark with fields='", field.name, "'")
              : refuse_value(field.name, "the marking did not make it; ", field.needs);
  if (field.n_components == per_direction)
    return view_of(found.*field.reals,
                   {static_cast<std::size_t>(found.n_nodes), static_cast<std::size_t>(found.n_directions)},
                   reader.result->share());
  return field.reals ? reader.view(found.*field.reals, found.n_nodes, field.n_components)
                     : reader.view(found.*field.integers, found.n_nodes);
}

template <class Type, int... numbers>
void add_fields(nb::class_<Type> &type, std::integer_sequence<int, numbers...>) {
  (type.def_prop_ro(fields[numbers].name, attribute(&field_view<numbers>), nb::sig(fields[numbers].signature),
                    fields[numbers].text),
   ...);
}

template <class Type>
void add_lists(nb::class_<Type> &type) {
  type.def_prop_ro("ids", attribute(&list_view<&riis_mark_list::node_id>),
                   nb::sig("def ids(self) -> numpy.typing.NDArray[numpy.int64]"), "(n,): the nodes, ascending. A view.")
      .def_prop_ro("distance", attribute(&list_view<&riis_mark_list::distance>), nb::sig(RIIS_REALS("distance")),
                   "(n,): the nodes' distances to the surface, mesh units. A view.")
      .def_prop_ro("triangle_id", attribute(&list_view<&riis_mark_list::triangle_id>),
                   nb::sig("def triangle_id(self) -> numpy.typing.NDArray[numpy.int64]"),
                   "(n,): the nodes' closest triangles. A view.")
      .def_prop_ro("leaflet_id", attribute(&list_view<&riis_mark_list::leaflet_id>),
                   nb::sig(RIIS_INTEGERS("leaflet_id")), "(n,): the leaflets of these triangles. A view.")
      .def(
          "__len__", [](nb::handle self) { return ListReader(self).list().n_nodes; },
          nb::sig("def __len__(self) -> int"));
  add_fields(type, std::make_integer_sequence<int, static_cast<int>(std::size(fields))>());
}

nb::object stats(Marks &result) {
  const Reading reading(result.usage, "marks");
  riis_mark_stats found;
  call_shortly(riis_marks_get_stats(result.handle, &found, sizeof found));
  static const char *const searches[] = {"auto", "exhaustive", "neighbor", "paper", "clusters"};
  static const char *const instructions[] = {"auto", "baseline", "avx2", "avx512"};
  return record("MarkStats")(found.n_nodes, found.n_marked, found.n_within_limit, found.n_queries, found.seconds,
                             searches[found.search], found.n_threads, found.complete != 0,
                             instructions[found.instructions], found.n_unreached);
}

nb::object dense(Marks &result, nb::handle mark_, nb::handle distance, nb::handle triangle_id, nb::handle leaflet_id,
                 nb::handle far_distance) {
  const Reading reading(result.usage, "marks");
  result.check_threads("marks");
  const std::int64_t n = result.n_nodes < 0 ? 0 : result.n_nodes;
  const double far = number(far_distance, "far_distance");
  const Output marks = output_of<std::uint8_t>(mark_, "mark", "bool", {n}),
               distances = output_of<double>(distance, "distance", "float64", {n}),
               triangles = output_of<std::int64_t>(triangle_id, "triangle_id", "int64", {n}),
               leaflets = output_of<std::int32_t>(leaflet_id, "leaflet_id", "int32", {n});
  riis_dense_arrays to;
  call_shortly(riis_dense_arrays_init(&to, sizeof to));
  to.n_nodes = n;
  to.far_distance = far;
  to.mark = marks.data<std::uint8_t>();
  to.distance = distances.data<double>();
  to.triangle_id = triangles.data<std::int64_t>();
  to.leaflet_id = leaflets.data<std::int32_t>();
  call_library([&] { return riis_marks_get_dense(result.handle, &to); });
  return record("Dense")(marks.array, distances.array, triangles.array, leaflets.array);
}

std::string description(nb::handle self) {
  Marks &result = object<Marks>(self, "self");
  if (result.usage.is_closed) return "<riis.Marks, closed>";
  if (result.n_nodes < 0) return "<riis.Marks, empty>";
  return text_of("<riis.Marks, ", ListReader(self).list().n_nodes, " of ", result.n_nodes, " nodes marked>");
}

}  // namespace

MarkOptions::MarkOptions(const Mesh &mesh, nb::handle mask_, nb::handle n_threads) {
  call_shortly(riis_mark_options_init(&options, sizeof options));
  options.n_threads = thread_count(n_threads);
  if (mask_.is_none()) return;
  mask.emplace(Array::of<std::uint8_t>(mask_, "mask")).expect({mesh.points.n});
  options.node_mask = mask->data<std::uint8_t>();
}

void Marks::check_threads(const char *name) const {
  if (marking_fork != fork_number() && n_threads != 1)
    raise_status(RIIS_UNAVAILABLE,
                 text_of(name,
                         ": the marking was made before the fork, for threads that the child lacks; mark "
                         "again, or with n_threads=1 before the fork"));
}

void add_marking(nb::module_ &module) {
  nb::class_<Marks> result(module, "Marks", R"(The nodes that riis.mark found, ascending by their ids.

Marks() is empty; riis.mark(..., into=result) fills it and reuses its memory. Arrays are views of that memory:
read-only, without a copy, and kept alive. While any of them is alive, the next marking uses new memory,
so they do not change.)");
  result.def("__init__", [](Marks *self) {
    new (self) Marks();
    call_shortly(riis_marks_create(&self->handle));
  });
  add_lists(result);
  nb::class_<WithinLimit> within(module, "WithinLimit",
                                 "The nodes of a Marks within the distance limit of the marking, marked or not.");
  add_lists(within);
  result
      .def_prop_ro("within_limit", attribute(+[](nb::handle self) { return WithinLimit{nb::borrow(self)}; }),
                   nb::sig("def within_limit(self) -> WithinLimit"),
                   "The same arrays for all nodes within the distance limit.")
      .def_prop_ro("_places", [](const Marks &self) { return self.places; })
      .def_prop_ro("_half_thickness", [](const Marks &self) { return self.half_thickness; })
      .def_prop_ro("stats", attribute(&stats), nb::sig("def stats(self) -> riis._records.MarkStats"),
                   "The statistics of the last marking.")
      .def("dense", &dense, nb::kw_only(), nb::arg("mark").none() = true, nb::arg("distance").none() = true,
           nb::arg("triangle_id").none() = false, nb::arg("leaflet_id").none() = false,
           nb::arg("far_distance").none() = RIIS_FAR_DISTANCE,
           nb::sig("def dense(self, *, mark: bool | numpy.typing.NDArray[numpy.bool_] | "
                   "numpy.typing.NDArray[numpy.uint8] = True, "
                   "distance: bool | numpy.typing.NDArray[numpy.float64] = True, triangle_id: bool | "
                   "numpy.typing.NDArray[numpy.int64] = False, leaflet_id: bool | numpy.typing.NDArray[numpy.int32] = "
                   "False, "
                   "far_distance: float = 1e30) -> riis._records.Dense"),
           R"(Returns arrays with an entry for every node of the mesh.

mark         (n_nodes,) bool: the marked nodes     each of these is True for a new array, False for no array, or
distance     (n_nodes,) float64                    an array to write, in which every entry is written
triangle_id  (n_nodes,) int64, -1 for far nodes
leaflet_id   (n_nodes,) int32, -1 for far nodes
far_distance  distance of nodes beyond the limit: any value outside [0, distance limit], including NaN)")
      .def("__repr__", &description);
  add_resistance(result);
  refuse_pickle(result, "keep the arrays, such as marks.ids");
  refuse_pickle(within, "keep the arrays, such as marks.within_limit.ids");
  add_closing(result);

  module.def(
      "mark", &mark, nb::arg("surface").none(), nb::arg("mesh").none(), nb::kw_only(),
      nb::arg("into").none() = nb::none(), nb::arg("fields").none() = nb::none(),
      nb::arg("distance_limit").none() = nb::none(), nb::arg("mask").none() = nb::none(),
      nb::arg("search").none() = "auto", nb::arg("n_threads").none() = 0, nb::arg("instructions").none() = "auto",
      nb::arg("R").none() = nb::none(), nb::arg("half_thickness").none() = nb::none(),
      nb::arg("rim").none() = nb::none(), nb::arg("allow_none").none() = false,
      nb::sig("def mark(surface: Surface, mesh: Mesh, *, into: Marks | None = None, fields: str | "
              "collections.abc.Sequence[str] | None = None, distance_limit: float | None = None, mask: "
              "numpy.typing.NDArray[numpy.bool_] | numpy.typing.NDArray[numpy.uint8] | None = None, search: "
              "typing.Literal['auto', 'exhaustive', 'neighbor', 'paper', 'clusters'] = 'auto', n_threads: int = 0, "
              "instructions: typing.Literal['auto', 'baseline', 'avx2', 'avx512'] = 'auto', R: float | None = None, "
              "half_thickness: float | None = None, rim: typing.Literal['round', 'cut'] | None = None, "
              "allow_none: bool = False) -> Marks"),
      R"(Finds every node whose distance to the surface is at most the half thickness, or with an offset every node in the band.

into            a Marks to fill, whose memory is reused; if None, a new one
fields          'normal, velocity' or ['normal', 'velocity']: fields that the result keeps, of 'point', 'normal',
                'barycentric', 'side', 'rim', 'uv', 'velocity', 'patch_id' and 'distance_gradient'
distance_limit  nodes get their distance up to this limit, mesh units, at least (1 + |offset|) half thicknesses; None: only
                the marked nodes do
mask            (n_nodes,) bool or uint8: other nodes are left out
search          all but 'paper' find the same nodes; 'neighbor' and 'paper' need an adjacency
n_threads       1 to 1024; 0: as many as there is work for
instructions    the instruction set, for tests and measurements; all give the same bits
R               mass / (length time): the marks get K, and K_u_surface if the surface has velocities
half_thickness  eps of K; (1 + |offset|) eps is at most the distance limit; None: the surface's half thickness
rim             as in add_resistance; None: 'round'
allow_none      whether the call may mark no node or odd nodes, as on an MPI rank whose nodes are far from the valve. False: if
                the marks look wrong, the call gives a riis.MarksWarning with its cure, once for each surface, mesh, scale
                and half thickness. The marks look wrong without marks, with a valve that leaves the mesh, and with a band
                that is too thin for the mesh's edges or too thick for the valve)");
}

}  // namespace riis_python
