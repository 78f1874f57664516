// SPDX-License-Identifier: Apache-2.0
#include "surface.hpp"

namespace riis_python {
namespace {

// The types of options in the annotations of signatures.
#define RIIS_VECTOR "collections.abc.Sequence[float] | numpy.typing.NDArray[numpy.float64] | None = None"
#define RIIS_SURFACE_OPTIONS                                                                                    \
  "half_thickness: float | typing.Literal['auto'] | None = None, tolerance: float | None = None, scale: float " \
  "| None = None, rotation_axis: " RIIS_VECTOR ", rotation_angle: float | None = None, axis: " RIIS_VECTOR      \
  ", translation: " RIIS_VECTOR                                                                                 \
  ", flip_normals: bool | None = None, measure: typing.Literal['triangles', 'sampling', "                       \
  "'minimization'] | None = None, measure_tolerance: float | typing.Literal['auto'] | None = None, "            \
  "triangulation: typing.Literal['adapted', 'fixed'] | None = None, zero_area: typing.Literal['refuse', "       \
  "'skip'] | None = None, offset: float | None = None, n_threads: int | None = None"
#define RIIS_POINTS "numpy.typing.NDArray[numpy.float64]"
#define RIIS_FACES "numpy.typing.NDArray[numpy.integer]"

riis_surface_options default_options() {
  riis_surface_options options;
  call_shortly(riis_surface_options_init(&options, sizeof options));
  return options;
}

// Returns the options for a call in this process. A child of fork() has one thread, even if the options come from its parent.
riis_surface_options for_this_process(riis_surface_options options) {
  if (is_forked()) options.n_threads = 1;
  return options;
}

// Makes the content of a surface. make(handle, options) calls the library; the handle is null for a new surface.
template <class Make>
void make_content(Surface &surface, riis_surface_options options, const Make &make) {
  check_surfaces_allowed("surface");
  const riis_surface_options now = for_this_process(options);
  surface.drop_copies();
  call_to_write(surface.usage, [&] { return make(now); });
  surface.options = options;
}

template <class Make>
void update_content(Surface &surface, nb::handle keywords, const Make &make) {
  const Writing writing(surface.usage, "surface");
  riis_surface_options options = surface.options;
  set_surface_options(options, keywords, "options");
  make_content(surface, options, make);
}

template <class Make>
Surface *new_surface(nb::handle keywords, const Make &make) {
  auto made = std::make_unique<Surface>();
  riis_surface_options options = default_options();
  set_surface_options(options, keywords, "options");
  make_content(*made, options, [&](const riis_surface_options &now) { return make(now, &made->handle); });
  return made.release();
}

void create(Surface *self, nb::handle valve_, const nb::kwargs &keywords) {
  Valve &valve = object<Valve>(valve_, "valve");
  const Reading reading(valve.usage, "valve");
  riis_surface_options options = default_options();
  set_surface_options(options, keywords, "options");
  new (self) Surface();
  try {
    make_content(*self, options, [&](const riis_surface_options &now) {
      return riis_surface_create(valve.handle, &now, &self->handle);
    });
    self->valve = nb::borrow(valve_);
  } catch (...) {
    self->~Surface();
    throw;
  }
}

void update(Surface &self, nb::handle valve_, const nb::kwargs &keywords) {
  Valve &valve = object<Valve>(valve_, "valve");
  const Reading reading(valve.usage, "valve");
  update_content(self, keywords,
                 [&](const riis_surface_options &now) { return riis_surface_update(self.handle, valve.handle, &now); });
  self.valve = nb::borrow(valve_);
}

void update_moving(Surface &self, nb::handle valve_, nb::handle valve_before_, nb::handle dt_,
                   nb::handle placement_before, const nb::kwargs &keywords) {
  Valve &valve = object<Valve>(valve_, "valve"), &before = object<Valve>(valve_before_, "valve_before");
  const Reading reading(valve.usage, "valve"), reading_before(before.usage, "valve_before");
  const double dt = number(dt_, "dt");
  riis_surface_options placement = self.options;
  set_surface_options(placement, keywords, "options");
  set_placement(placement, placement_before, "placement_before");
  update_content(self, keywords, [&](const riis_surface_options &now) {
    return riis_surface_update_moving(self.handle, valve.handle, before.handle, dt, &now, &placement);
  });
  self.valve = nb::borrow(valve_);
}

void add_direction(Surface &self, nb::handle valve_after_, nb::handle valve_before_, nb::handle dp_,
                   nb::handle placement_after, nb::handle placement_before) {
  Valve &after = object<Valve>(valve_after_, "valve_after"), &before = object<Valve>(valve_before_, "valve_before");
  const Writing writing(self.usage, "surface");
  const Reading reading_after(after.usage, "valve_after"), reading_before(before.usage, "valve_before");
  const double dp = number(dp_, "dp");
  riis_surface_options of_after = self.options, of_before = self.options;
  set_placement(of_after, placement_after, "placement_after");
  set_placement(of_before, placement_before, "placement_before");
  call_to_write(self.usage, [&] {
    return riis_surface_add_direction(self.handle, after.handle, before.handle, dp, &of_after, &of_before);
  });
}

nb::object direction(Surface &surface, nb::handle direction_id_) {
  const Reading reading(surface.usage, "surface");
  const std::int64_t direction_id = integer(direction_id_, "direction_id");
  riis_direction found;
  call_shortly(riis_surface_get_direction(surface.handle, direction_id, &found, sizeof found));
  return record("Direction")(copy_of(found.rate, {static_cast<std::size_t>(found.n_vertices), 3}), found.area_rate);
}

Surface *from_arrays(nb::handle vertices, nb::handle faces, nb::handle leaflet_id, nb::handle velocities,
                     nb::handle index_base, nb::handle skirt_length, nb::handle attached, nb::handle skirt_lengths,
                     const nb::kwargs &keywords) {
  if (faces.is_none()) refuse_type("faces", "must be a numpy array of int32 or int64, not NoneType");
  FaceArrays of_faces(faces, leaflet_id, index_base);
  of_faces.set_vertices(vertices, velocities);
  of_faces.set_skirt({skirt_length, attached, skirt_lengths});
  return new_surface(keywords, [&](const riis_surface_options &now, riis_surface **made) {
    return riis_surface_create_from_arrays(&of_faces.arrays, &now, made);
  });
}

void update_from_arrays(Surface &self, nb::handle vertices, nb::handle faces, nb::handle leaflet_id,
                        nb::handle velocities, nb::handle index_base, nb::handle skirt_length, nb::handle attached,
                        nb::handle skirt_lengths, const nb::kwargs &keywords) {
  FaceArrays of_faces(faces, leaflet_id, index_base);
  of_faces.set_vertices(vertices, velocities);
  of_faces.set_skirt({skirt_length, attached, skirt_lengths});
  update_content(self, keywords, [&](const riis_surface_options &now) {
    return riis_surface_update_from_arrays(self.handle, &of_faces.arrays, &now);
  });
  self.valve = nb::object();
}

Surface *from_keyframes(nb::handle keyframes_, nb::handle time_, nb::handle dt_, const nb::kwargs &keywords) {
  Keyframes &keyframes = object<Keyframes>(keyframes_, "keyframes");
  const Reading reading(keyframes.usage, "keyframes");
  const double time = number(time_, "time"), dt = number_or(dt_, "dt", 0);
  return new_surface(keywords, [&](const riis_surface_options &now, riis_surface **made) {
    return riis_surface_create_from_keyframes(keyframes.handle, time, dt, &now, made);
  });
}

void update_from_keyframes(Surface &self, nb::handle keyframes_, nb::handle time_, nb::handle dt_,
                           const nb::kwargs &keywords) {
  Keyframes &keyframes = object<Keyframes>(keyframes_, "keyframes");
  const Reading reading(keyframes.usage, "keyframes");
  const double time = number(time_, "time"), dt = number_or(dt_, "dt", 0);
  update_content(self, keywords, [&](const riis_surface_options &now) {
    return riis_surface_update_from_keyframes(self.handle, keyframes.handle, time, dt, &now);
  });
  self.valve = nb::object();
}

riis_surface_info info_of(Surface &surface) {
  const Reading reading(surface.usage, "surface");
  riis_surface_info info;
  call_shortly(riis_surface_get_info(surface.handle, &info, sizeof info));
  return info;
}

nb::object info(Surface &surface) {
  const riis_surface_info found = info_of(surface);
  return record("SurfaceInfo")(found.n_vertices, found.n_triangles, found.n_zero_area, found.half_thickness, found.area,
                               array_of(found.lower, "float64"), array_of(found.upper, "float64"),
                               found.seconds_triangles, found.seconds_scene, found.error_bound,
                               found.largest_leaflet_id, found.offset, found.contact_depth, found.skirt_leaflet_id,
                               found.housing_leaflet_id);
}

riis_triangles triangles_of(const Surface &surface) {
  riis_triangles found;
  call_shortly(riis_surface_get_triangles(surface.handle, &found, sizeof found));
  return found;
}

// Returns an array of the vertices, or None if the surface has no such array.
nb::object vertex_array(Surface &surface, const double *riis_triangles::*member, std::size_t n_components,
                        nb::object Surface::*copy) {
  const Reading reading(surface.usage, "surface");
  if ((surface.*copy).is_valid()) return surface.*copy;
  const riis_triangles found = triangles_of(surface);
  const double *data = found.*member;
  return surface.*copy =
             data ? copy_of(data, {static_cast<std::size_t>(found.n_vertices), n_components}) : nb::object(nb::none());
}

nb::object triangles(Surface &surface) {
  const Reading reading(surface.usage, "surface");
  if (surface.triangles.is_valid()) return surface.triangles;
  const riis_triangles found = triangles_of(surface);
  const auto n = static_cast<std::size_t>(found.n_triangles);
  return surface.triangles = record("Triangles")(copy_of(found.vertex_id, {n, 3}), copy_of(found.triangle_id, {n}),
                                                 copy_of(found.leaflet_id, {n}), copy_of(found.patch_id, {n}));
}

nb::object attachment(Surface &surface) {
  const Reading reading(surface.usage, "surface");
  riis_attachment found;
  call_shortly(riis_surface_get_attachment(surface.handle, &found, sizeof found));
  const auto n = static_cast<std::size_t>(found.n_edges);
  return record("Attachment")(copy_of(found.edges, {n, 2, 3}), copy_of(found.vertex_id, {n, 2}),
                              copy_of(found.leaflet_id, {n}), copy_of(found.patch_id, {n}));
}

nb::dict placement(const Surface &surface) {
  const riis_surface_options &at = surface.options;
  nb::dict made;
  made["scale"] = at.scale;
  made["rotation_axis"] = array_of(at.rotation_axis, "float64");
  made["rotation_angle"] = at.rotation_angle;
  made["translation"] = array_of(at.translation, "float64");
  return made;
}

std::string description(Surface &surface) {
  if (surface.usage.is_closed) return "<riis.Surface, closed>";
  const riis_surface_info found = info_of(surface);
  return text_of("<riis.Surface, ", found.n_triangles, " triangles, half thickness ", found.half_thickness, ">");
}

}  // namespace

FaceArrays::FaceArrays(nb::handle given_faces, nb::handle leaflet_id, nb::handle index_base) {
  call_shortly(riis_surface_arrays_init(&arrays, sizeof arrays));
  arrays.index_base = integer32(index_base, "index_base");
  if (!given_faces.is_none()) {
    faces.emplace(Array::of_integers(given_faces, "faces"));
    faces->expect({-1, faces->n_dimensions() == 2 && faces->size(1) == 4 ? 4 : 3});
    arrays.n_faces = faces->size(0);
    if (arrays.n_faces == 0) raise_status(RIIS_INVALID_SURFACE, "faces: there are none");
    arrays.corners_per_face = static_cast<std::int32_t>(faces->size(1));
    arrays.vertex_ids = faces->data<void>();
    arrays.id_bits = faces->bits();
  }
  if (!leaflet_id.is_none()) {
    if (!faces) refuse_value("leaflet_id", "needs faces");
    leaflets.emplace(Array::of<std::int32_t>(leaflet_id, "leaflet_id")).expect({arrays.n_faces});
    arrays.leaflet_id = leaflets->data<std::int32_t>();
  }
}

void FaceArrays::set_vertices(nb::handle given_vertices, nb::handle given_velocities) {
  vertices = points_of(given_vertices, "vertices");
  arrays.n_vertices = vertices.n;
  arrays.x = vertices.x;
  arrays.y = vertices.y;
  arrays.z = vertices.z;
  arrays.stride = vertices.stride;
  if (given_velocities.is_none()) return;
  velocities = points_of(given_velocities, "velocities");
  velocities.arrays.front().expect_shape({vertices.n, 3});
  arrays.vx = velocities.x;
  arrays.vy = velocities.y;
  arrays.vz = velocities.z;
  arrays.velocity_stride = velocities.stride;
}

void FaceArrays::set_skirt(const SkirtArguments &skirt) {
  arrays.skirt_length = number(skirt.length, "skirt_length");
  if (!skirt.attached.is_none()) {
    attached.emplace(Array::of<std::uint8_t>(skirt.attached, "attached")).expect({arrays.n_vertices});
    arrays.attached = attached->data<std::uint8_t>();
  }
  if (!skirt.lengths.is_none()) {
    skirt_lengths.emplace(Array::of<double>(skirt.lengths, "skirt_lengths")).expect({arrays.n_vertices});
    arrays.skirt_lengths = skirt_lengths->data<double>();
  }
}

void Surface::close(const char *name) {
  Handle::close(name);
  drop_copies();
  valve = nb::object();
}

void add_surface(nb::module_ &module) {
  nb::class_<Surface> surface(module, "Surface", R"(Triangles with a half thickness, which answer closest-point queries.

Surface(valve, **options) makes the surface of a valve. from_arrays and from_keyframes make surfaces from other data.
Normals point downstream. Options:

half_thickness      the half width of the band that is marked, mesh units; 'auto', the default, is 0.1 * scale
tolerance           0.05: distances to the triangles and to the smooth valve differ by at most tolerance * half_thickness
scale               1. The placement is x -> scale * rotation * x + translation
rotation_axis       (0, 0, 1)
rotation_angle      0, degrees
axis                the direction of the valve's axis, in place of the two options above. The valve takes the smallest rotation
                    from (0, 0, 1). Blood flows along this axis, and through mitral and tricuspid valves against it
translation         (0, 0, 0), mesh units
flip_normals        False
measure             'triangles'; the paper's 'sampling' and 'minimization' serve for comparison
measure_tolerance  for 'sampling' and 'minimization', in half thicknesses; 'auto': tolerance
triangulation       'adapted', or 'fixed': the same triangles at every opening
zero_area           whether from_arrays should 'refuse' or 'skip' triangles without area
offset              0: o, above -1 and below 1. The middle of the band lies o half thicknesses beside the surface, along the
                    normals after flip_normals. With 0.75 an open valve has its full width (docs/theory/marks.md)
n_threads           0: 1 per 4096 triangles, at most 1 per processor

An update keeps the options that it does not name. Arrays of a surface are copies, made once after each update.)");
  surface
      .def("__init__", &create, nb::arg("valve").none(), nb::arg("options"),
           nb::sig("def __init__(self, valve: Valve, *, " RIIS_SURFACE_OPTIONS ") -> None"))
      .def_static("from_arrays", &from_arrays, nb::arg("vertices").none(), nb::arg("faces").none(), nb::kw_only(),
                  nb::arg("leaflet_id").none() = nb::none(), nb::arg("velocities").none() = nb::none(),
                  nb::arg("index_base").none() = 0, nb::arg("skirt_length").none() = 0.0,
                  nb::arg("attached").none() = nb::none(), nb::arg("skirt_lengths").none() = nb::none(),
                  nb::arg("options"),
                  nb::sig("def from_arrays(vertices: " RIIS_POINTS ", faces: " RIIS_FACES
                          ", *, leaflet_id: numpy.typing.NDArray[numpy.int32] | None = None, velocities: " RIIS_POINTS
                          " | None = None, index_base: int = 0, " RIIS_SKIRT ", " RIIS_SURFACE_OPTIONS ") -> Surface"),
                  R"(Makes a surface from triangles or quads, which are copied.

vertices       (n_vertices, 3) float64 of any forward strides, before placement
faces          (n_faces, 3 or 4) int32 or int64: vertex numbers from index_base; the normal follows the right-hand rule
leaflet_id     (n_faces,) int32, >= 0; default 0
velocities     (n_vertices, 3) float64, lengths divided by the caller's unit of time
skirt_length   the length of a skirt before placement, a strip from the attachment outwards; 0: no skirt
attached       (n_vertices,) bool or uint8: the vertices of the attachment. If it is None, the skirt leads from the
               closed line of open edges that encloses the largest area
skirt_lengths  (n_vertices,) float64: lengths of the skirt at the attached vertices, at most skirt_length)")
      .def_static(
          "from_keyframes", &from_keyframes, nb::arg("keyframes").none(), nb::arg("time").none(),
          nb::arg("dt").none() = nb::none(), nb::arg("options"),
          nb::sig(
              "def from_keyframes(keyframes: Keyframes, time: float, dt: float | None = None, *, " RIIS_SURFACE_OPTIONS
              ") -> Surface"),
          R"(Makes a surface from the frames around a time, with velocities.

The velocity is the mean from time - dt to time. If dt is None, it is the derivative of the interpolation.)")
      .def("update", &update, nb::arg("valve").none(), nb::arg("options"),
           nb::sig("def update(self, valve: Valve, *, " RIIS_SURFACE_OPTIONS ") -> None"),
           "Replaces the content by the surface of a valve, such as one that moved.")
      .def("update_moving", &update_moving, nb::arg("valve").none(), nb::arg("valve_before").none(),
           nb::arg("dt").none(), nb::kw_only(), nb::arg("placement_before").none() = nb::none(), nb::arg("options"),
           nb::sig(
               "def update_moving(self, valve: Valve, valve_before: Valve, dt: float, *, placement_before: dict[str, "
               "typing.Any] | None = None, " RIIS_SURFACE_OPTIONS ") -> None"),
           R"(Replaces the content as update does, and gives every vertex a velocity.

valve_before      the earlier state, of the same kind
dt                time from valve_before to valve; negative if time goes backwards
placement_before  a dict of scale, rotation_axis, rotation_angle and translation of the earlier state; missing
                  entries have their present values

The velocity is the mean over the step, in mesh units divided by the unit of dt.)")
      .def("add_direction", &add_direction, nb::arg("valve_after").none(), nb::arg("valve_before").none(),
           nb::arg("dp").none(), nb::kw_only(), nb::arg("placement_after").none() = nb::none(),
           nb::arg("placement_before").none() = nb::none(),
           nb::sig(
               "def add_direction(self, valve_after: Valve, valve_before: Valve, dp: float, *, placement_after: "
               "dict[str, typing.Any] | None = None, placement_before: dict[str, typing.Any] | None = None) -> None"),
           R"(Adds a direction in which the surface of a valve changes, for fields='distance_gradient' of riis.mark.

valve_after       a copy of the surface's valve with a parameter or a landmark a little larger
valve_before      the same with a little smaller value; for a change of the placement alone, the same valve
dp                difference of the parameter from valve_before to valve_after
placement_after, placement_before
                  dicts of scale, rotation_axis, rotation_angle and translation of both states; missing entries have the
                  surface's values

An update of the surface removes its directions.)")
      .def("direction", &direction, nb::arg("direction_id").none(),
           nb::sig("def direction(self, direction_id: int) -> riis._records.Direction"),
           R"(Copies the derivatives of the vertices and of the area in a direction.

direction_id  0 for the first add_direction after the last update, 1 for the second, and so on)")
      .def(
          "update_from_arrays", &update_from_arrays, nb::arg("vertices").none(), nb::arg("faces").none() = nb::none(),
          nb::kw_only(), nb::arg("leaflet_id").none() = nb::none(), nb::arg("velocities").none() = nb::none(),
          nb::arg("index_base").none() = 0, nb::arg("skirt_length").none() = 0.0,
          nb::arg("attached").none() = nb::none(), nb::arg("skirt_lengths").none() = nb::none(), nb::arg("options"),
          nb::sig(
              "def update_from_arrays(self, vertices: " RIIS_POINTS ", faces: " RIIS_FACES
              " | None = None, *, leaflet_id: numpy.typing.NDArray[numpy.int32] | None = None, velocities: " RIIS_POINTS
              " | None = None, index_base: int = 0, " RIIS_SKIRT ", " RIIS_SURFACE_OPTIONS ") -> None"),
          "Replaces the content from arrays as in from_arrays. Without faces, only the vertices move, and the "
          "skirt stays.")
      .def("update_from_keyframes", &update_from_keyframes, nb::arg("keyframes").none(), nb::arg("time").none(),
           nb::arg("dt").none() = nb::none(), nb::arg("options"),
           nb::sig("def update_from_keyframes(self, keyframes: Keyframes, time: float, dt: float | None = None, "
                   "*, " RIIS_SURFACE_OPTIONS ") -> None"),
           "Replaces the content by the frames around a time, as from_keyframes does.")
      .def_prop_ro("info", attribute(&info), nb::sig("def info(self) -> riis._records.SurfaceInfo"),
                   "Counts, bounds, area, and the seconds of the last creation or update.")
      .def_prop_ro("half_thickness", attribute(+[](Surface &self) { return info_of(self).half_thickness; }),
                   "The half thickness, mesh units.")
      .def_prop_ro("_valve", [](const Surface &self) { return self.valve.is_valid() ? self.valve : nb::none(); })
      .def_prop_ro("_placement", &placement)
      .def_prop_ro("vertices", attribute(+[](Surface &self) {
                     return vertex_array(self, &riis_triangles::xyz, 3, &Surface::vertices);
                   }),
                   nb::sig("def vertices(self) -> numpy.typing.NDArray[numpy.float64]"),
                   "(n_vertices, 3): the vertices after placement.")
      .def_prop_ro("uv",
                   attribute(+[](Surface &self) { return vertex_array(self, &riis_triangles::uv, 2, &Surface::uv); }),
                   nb::sig("def uv(self) -> numpy.typing.NDArray[numpy.float64] | None"),
                   "(n_vertices, 2): each vertex's u and v on its patch, 0 to 1. None for a surface from arrays.")
      .def_prop_ro("velocities", attribute(+[](Surface &self) {
                     return vertex_array(self, &riis_triangles::velocity, 3, &Surface::velocities);
                   }),
                   nb::sig("def velocities(self) -> numpy.typing.NDArray[numpy.float64] | None"),
                   "(n_vertices, 3): each vertex's velocity. None if the last update gave no velocities.")
      .def_prop_ro("attachment", attribute(&attachment), nb::sig("def attachment(self) -> riis._records.Attachment"),
                   "A copy of the edges at which tissue or a stent holds a valve's leaflets. Refused for arrays "
                   "without attached and without a skirt.")
      .def_prop_ro("triangles", attribute(&triangles), nb::sig("def triangles(self) -> riis._records.Triangles"),
                   "The triangles: vertex_id (n, 3), triangle_id, leaflet_id and patch_id (n,).")
      .def(
          "to_pyvista",
          [](nb::handle self) {
            return nb::object(nb::module_::import_("riis._plot").attr("surface_to_pyvista")(self));
          },
          nb::sig("def to_pyvista(self) -> typing.Any"),
          R"(Copies the surface to a pyvista.PolyData, which needs PyVista.

Cells have triangle_id, leaflet_id and patch_id; points have velocity if the last update gave velocities.)")
      .def("__repr__", &description);
  add_closest(surface);
  refuse_pickle(surface, "keep the valve and the options, or the arrays, and make the surface from them");
  add_closing(surface);
}

}  // namespace riis_python
