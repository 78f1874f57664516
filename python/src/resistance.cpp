// SPDX-License-Identifier: Apache-2.0
#include "module.hpp"

namespace riis_python {

riis_resistance resistance_of(nb::handle R, nb::handle half_thickness, nb::handle rim) {
  if (R.is_none()) refuse_type("R", "is missing; R is a mass / (length time), such as R=1e4 for kg/(m s)");
  riis_resistance made;
  call_shortly(riis_resistance_init(&made, sizeof made));
  made.R = number(R, "R");
  made.half_thickness = number_or_auto(half_thickness, "half_thickness");
  if (!rim.is_none()) made.rim = choice(rim, "rim", {{"round", RIIS_RIM_ROUND}, {"cut", RIIS_RIM_CUT}});
  return made;
}

namespace {

// Returns the number of nodes. Refuses empty marks.
std::int64_t n_nodes_of(const Marks &result) {
  if (result.n_nodes < 0) refuse_value("marks", "is empty; riis.mark fills it");
  return result.n_nodes;
}

void add_to(Marks &result, nb::handle K_, nb::handle K_u_surface_, nb::handle R, nb::handle half_thickness,
            nb::handle rim) {
  const Reading reading(result.usage, "marks");
  result.check_threads("marks");
  const riis_resistance model = resistance_of(R, half_thickness, rim);
  const std::int64_t n = n_nodes_of(result);
  std::optional<Array> K, K_u_surface;
  if (!K_.is_none()) K.emplace(Array::of<double>(K_, "K", Access::write)).expect({n});
  if (!K_u_surface_.is_none())
    K_u_surface.emplace(Array::of<double>(K_u_surface_, "K_u_surface", Access::write)).expect({n, 3});
  riis_resistance_arrays to;
  call_shortly(riis_resistance_arrays_init(&to, sizeof to));
  to.n_nodes = n;
  if (K) to.K = K->data<double>();
  if (K_u_surface)
    for (int c = 0; c < 3; ++c) to.K_u_surface[c] = K_u_surface->data<double>() + c;
  to.K_u_surface_stride = 3;
  call_library([&] { return riis_marks_add_resistance(result.handle, &model, &to); });
}

// Returns the caller's array (n_rows, 3), to which a call adds sums. If n_rows is -1, the shape is (3,). None gives no array.
std::optional<Array> sums_of(nb::handle given, const char *name, std::int64_t n_rows) {
  if (given.is_none()) return std::nullopt;
  std::optional<Array> sums(Array::of<double>(given, name, Access::write));
  if (n_rows < 0)
    sums->expect({3});
  else
    sums->expect({n_rows, 3});
  return sums;
}

double *data_of(const std::optional<Array> &sums) { return sums ? sums->data<double>() : nullptr; }

// Returns the number of rows of the first array that is given, or 0 if both are None.
std::int64_t n_rows_of(nb::handle first, const char *first_name, nb::handle second, const char *second_name) {
  if (first.is_none() && second.is_none()) return 0;
  const bool has_first = !first.is_none();
  const Array array =
      Array::of<double>(has_first ? first : second, has_first ? first_name : second_name, Access::write);
  array.expect({-1, 3});
  return array.size(0);
}

// Describes the flow at n nodes in the form of riis.h, without a copy.
riis_flow_arrays flow_of(std::int64_t n, const Array &velocity, const Array &weight) {
  velocity.expect({n, 3});
  weight.expect({n});
  riis_flow_arrays flow;
  call_shortly(riis_flow_arrays_init(&flow, sizeof flow));
  flow.n_nodes = n;
  for (int c = 0; c < 3; ++c) flow.velocity[c] = velocity.data<double>() + c;
  flow.velocity_stride = 3;
  flow.weight = weight.data<double>();
  return flow;
}

nb::object add_reaction(Marks &result, nb::handle velocity_, nb::handle weight_, nb::handle force_, nb::handle R,
                        nb::handle half_thickness, nb::handle rim, nb::handle moment_, nb::handle about,
                        nb::handle leaflet_force_, nb::handle leaflet_moment_, nb::handle edges_,
                        nb::handle edge_force_, nb::handle edge_moment_, nb::handle edge_leaflet_id_) {
  const Reading reading(result.usage, "marks");
  result.check_threads("marks");
  const riis_resistance model = resistance_of(R, half_thickness, rim);
  const std::int64_t n = n_nodes_of(result);
  const Array velocity = Array::of<double>(velocity_, "velocity"), weight = Array::of<double>(weight_, "weight");
  const riis_flow_arrays flow = flow_of(n, velocity, weight);
  riis_reaction to;
  call_shortly(riis_reaction_init(&to, sizeof to));
  if (!about.is_none()) three_numbers(about, "about", to.about);
  const nb::object force = force_.is_none() ? new_filled_array("float64", {3}, nb::float_(0.0)) : nb::borrow(force_);
  to.n_leaflets = n_rows_of(leaflet_force_, "leaflet_force", leaflet_moment_, "leaflet_moment");
  std::optional<Array> edges, edge_leaflet_id;
  if (!edges_.is_none()) {
    edges.emplace(Array::of<double>(edges_, "edges")).expect({-1, 2, 3});
    to.n_edges = edges->size(0);
    to.edges = edges->data<double>();
  }
  if (!edge_leaflet_id_.is_none()) {
    edge_leaflet_id.emplace(Array::of<std::int32_t>(edge_leaflet_id_, "edge_leaflet_id")).expect({to.n_edges});
    to.edge_leaflet_id = edge_leaflet_id->data<std::int32_t>();
  }
  const auto whole = sums_of(force, "force", -1), moment = sums_of(moment_, "moment", -1),
             leaflet_force = sums_of(leaflet_force_, "leaflet_force", to.n_leaflets),
             leaflet_moment = sums_of(leaflet_moment_, "leaflet_moment", to.n_leaflets),
             edge_force = sums_of(edge_force_, "edge_force", to.n_edges),
             edge_moment = sums_of(edge_moment_, "edge_moment", to.n_edges);
  to.force = data_of(whole), to.moment = data_of(moment);
  to.leaflet_force = data_of(leaflet_force), to.leaflet_moment = data_of(leaflet_moment);
  to.edge_force = data_of(edge_force), to.edge_moment = data_of(edge_moment);
  call_library([&] { return riis_marks_add_reaction(result.handle, &model, &flow, &to); });
  return force;
}

nb::object add_vertex_reaction(Marks &result, nb::handle surface_, nb::handle velocity_, nb::handle weight_,
                               nb::handle force_, nb::handle R, nb::handle half_thickness, nb::handle rim) {
  Surface &surface = object<Surface>(surface_, "surface");
  const Reading reading(result.usage, "marks"), reading_surface(surface.usage, "surface");
  result.check_threads("marks");
  const riis_resistance model = resistance_of(R, half_thickness, rim);
  const Array velocity = Array::of<double>(velocity_, "velocity"), weight = Array::of<double>(weight_, "weight");
  const riis_flow_arrays flow = flow_of(n_nodes_of(result), velocity, weight);
  riis_surface_info info;
  call_shortly(riis_surface_get_info(surface.handle, &info, sizeof info));
  const nb::object force =
      force_.is_none() ? new_filled_array("float64", {info.n_vertices, 3}, nb::float_(0.0)) : nb::borrow(force_);
  const Array to = Array::of<double>(force, "force", Access::write);
  to.expect({info.n_vertices, 3});
  call_library([&] {
    return riis_marks_add_vertex_reaction(result.handle, surface.handle, &model, &flow, info.n_vertices,
                                          to.data<double>());
  });
  return force;
}

nb::object band_sums(Marks &result, nb::handle value_, nb::handle weight_, nb::handle inner_, nb::handle outer_) {
  const Reading reading(result.usage, "marks");
  result.check_threads("marks");
  const std::int64_t n = n_nodes_of(result);
  const Array value = Array::of<double>(value_, "value"), weight = Array::of<double>(weight_, "weight");
  value.expect({n});
  weight.expect({n});
  riis_band band;
  call_shortly(riis_band_init(&band, sizeof band));
  band.inner = number(inner_, "inner");
  band.outer = number(outer_, "outer");
  band.n_nodes = n;
  band.value = value.data<double>();
  band.weight = weight.data<double>();
  riis_band_sums sums;
  call_library([&] { return riis_marks_get_band_sums(result.handle, &band, &sums, sizeof sums); });
  return record("BandSums")(array_of(sums.sum, "float64"), array_of(sums.weight, "float64"),
                            array_of(sums.n_nodes, "int64"));
}

#define RIIS_MODEL "R: float, half_thickness: float | None = None, rim: typing.Literal['round', 'cut'] = 'round'"
#define RIIS_REALS "numpy.typing.NDArray[numpy.float64]"

}  // namespace

void add_resistance(nb::class_<Marks> &result) {
  result
      .def("add_resistance", &add_to, nb::arg("K").none() = nb::none(), nb::arg("K_u_surface").none() = nb::none(),
           nb::kw_only(), nb::arg("R").none() = nb::none(), nb::arg("half_thickness").none() = nb::none(),
           nb::arg("rim").none() = "round",
           nb::sig("def add_resistance(self, K: " RIIS_REALS " | None = None, K_u_surface: " RIIS_REALS
                   " | None = None, *, " RIIS_MODEL ") -> None"),
           R"(Adds K and K u_surface to the caller's arrays, so that several valves add up.

K               (n_nodes,) float64: K = (R / eps) delta(d) is added, with the distance d from the middle of the band
K_u_surface     (n_nodes, 3) float64: K u_surface is added; the marking needs fields='velocity'
R               mass / (length time), such as kg/(m s)
half_thickness  eps, mesh units; (1 + |offset|) eps is at most the distance limit of the marking; None: the marking's half
                thickness
rim             'round': every node within eps gets K; 'cut': nodes whose closest point is on the rim get none, which
                needs fields='rim')")
      .def("add_reaction", &add_reaction, nb::arg("velocity").none(), nb::arg("weight").none(),
           nb::arg("force").none() = nb::none(), nb::kw_only(), nb::arg("R").none() = nb::none(),
           nb::arg("half_thickness").none() = nb::none(), nb::arg("rim").none() = "round",
           nb::arg("moment").none() = nb::none(), nb::arg("about").none() = nb::none(),
           nb::arg("leaflet_force").none() = nb::none(), nb::arg("leaflet_moment").none() = nb::none(),
           nb::arg("edges").none() = nb::none(), nb::arg("edge_force").none() = nb::none(),
           nb::arg("edge_moment").none() = nb::none(), nb::arg("edge_leaflet_id").none() = nb::none(),
           nb::sig("def add_reaction(self, velocity: " RIIS_REALS ", weight: " RIIS_REALS ", force: " RIIS_REALS
                   " | None = None, *, " RIIS_MODEL ", moment: " RIIS_REALS
                   " | None = None, about: collections.abc.Sequence[float] | " RIIS_REALS
                   " | None = None, leaflet_force: " RIIS_REALS " | None = None, leaflet_moment: " RIIS_REALS
                   " | None = None, edges: " RIIS_REALS " | None = None, edge_force: " RIIS_REALS
                   " | None = None, edge_moment: " RIIS_REALS
                   " | None = None, edge_leaflet_id: numpy.typing.NDArray[numpy.int32] | None = None) -> " RIIS_REALS),
           R"(Adds the force of the flow on the surface to force, and returns force.

The force is the sum of weight * K * (velocity - u_surface). Sums are also added to the other float64 arrays that are given:
moments, and forces and moments by leaflet and by edge. Moments and sums of edges need fields='point', because a force acts
at the closest point of the surface. Ranks add their sums. The shares of edges are for tissue codes, and do not come from
the mechanics of a membrane.

velocity         (n_nodes, 3) float64: the flow's velocity
weight           (n_nodes,) float64: the volume that belongs to a node, 0 for nodes of other ranks
force            (3,) float64; None: a new array
moment           (3,): the moment on the whole surface
about            the point of moment and leaflet_moment; None: (0, 0, 0)
leaflet_force    (n_leaflets, 3): n_leaflets is above Surface.info.largest_leaflet_id
leaflet_moment   (n_leaflets, 3)
edges            (n_edges, 2, 3): both ends of each edge, such as Surface.attachment.edges
edge_force       (n_edges, 3): a node's force goes to the edge nearest to its closest point, the first of equally near edges
edge_moment      (n_edges, 3): the moments about the middle of each edge
edge_leaflet_id  (n_edges,) int32: a node's force goes to the nearest edge of its leaflet; None: of all leaflets)")
      .def("add_vertex_reaction", &add_vertex_reaction, nb::arg("surface").none(), nb::arg("velocity").none(),
           nb::arg("weight").none(), nb::arg("force").none() = nb::none(), nb::kw_only(),
           nb::arg("R").none() = nb::none(), nb::arg("half_thickness").none() = nb::none(),
           nb::arg("rim").none() = "round",
           nb::sig("def add_vertex_reaction(self, surface: Surface, velocity: " RIIS_REALS ", weight: " RIIS_REALS
                   ", force: " RIIS_REALS " | None = None, *, " RIIS_MODEL ") -> " RIIS_REALS),
           R"(Adds the force of the flow on each vertex of the surface to force, and returns force.

The force of a node goes to the vertices of its closest triangle, in the shares of the closest point's barycentric coordinates.
So sums and moments are those of add_reaction. The marking needs fields='barycentric'. Ranks add their forces.

surface   the surface of the marking, without an update since then
velocity  (n_nodes, 3) float64: the flow's velocity
weight    (n_nodes,) float64: the volume that belongs to a node, 0 for nodes of other ranks
force     (n_vertices, 3) float64; None: a new array)")
      .def(
          "band_sums", &band_sums, nb::arg("value").none(), nb::arg("weight").none(), nb::arg("inner").none(),
          nb::arg("outer").none(),
          nb::sig("def band_sums(self, value: " RIIS_REALS ", weight: " RIIS_REALS
                  ", inner: float, outer: float) -> riis._records.BandSums"),
          R"(Sums a value, such as the pressure, over the nodes at a distance from inner to outer, separately for each side.

Distances and sides are those from the middle of the band.

value, weight  (n_nodes,) float64
inner, outer   mesh units, 0 <= inner <= outer. outer + |offset| eps is at most the distance limit of the marking, which needs
               fields='side, rim')");
}

}  // namespace riis_python
