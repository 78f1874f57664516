// SPDX-License-Identifier: Apache-2.0
// Measures of a valve for the flow: leaflets, orifice, leak, first passage, cells across and swept volume.
#include <algorithm>
#include <cstddef>
#include <iterator>
#include <string>
#include <vector>

#include "arguments.hpp"
#include "errors.hpp"
#include "module.hpp"

namespace riis_python {
namespace {

nb::object leaflets(Surface &self) {
  const Reading reading(self.usage, "surface");
  std::int64_t n = 0;
  call_shortly(riis_surface_get_n_leaflets(self.handle, &n));
  nb::list made;
  for (std::int64_t i = 0; i < n; ++i) {
    riis_leaflet sizes;
    call_shortly(riis_surface_get_leaflet(self.handle, i, &sizes, sizeof sizes));
    made.append(record("LeafletSizes")(sizes.leaflet_id, sizes.n_triangles, sizes.area, sizes.free_edge));
  }
  return made;
}

nb::object orifice(Surface &self, nb::handle half_thickness, nb::handle rim, nb::handle wall_) {
  Surface &wall = wall_.is_none() ? self : object<Surface>(wall_, "wall");
  const Reading reading(self.usage, "surface"), reading_wall(wall.usage, "wall");
  const riis_resistance model = resistance_of(nb::float_(0.0), half_thickness, rim);
  riis_orifice made;
  call_library([&] {
    if (&wall == &self) return riis_surface_get_orifice(self.handle, &model, &made, sizeof made);
    return riis_surface_get_orifice_in_wall(self.handle, wall.handle, &model, &made, sizeof made);
  });
  static const char *const outlines[] = {"none", "disc", "attachment", "boundary", "wall"};
  return record("Orifice")(made.area, made.outline_area, made.perimeter, made.effective_area, made.rim_reach,
                           made.half_thickness, made.radius, array_of(made.axis, "float64"), outlines[made.outline]);
}

std::int32_t leaflet_or_all(nb::handle leaflet_id) {
  return leaflet_id.is_none() ? std::int32_t{RIIS_ALL_LEAFLETS} : integer32(leaflet_id, "leaflet_id");
}

nb::object coaptation(Surface &self, nb::handle leaflet_id, nb::handle reach_) {
  const Reading reading(self.usage, "surface");
  const std::int32_t id = leaflet_or_all(leaflet_id);
  const double reach = number_or_auto(reach_, "reach");
  riis_coaptation made;
  call_library([&] { return riis_surface_get_coaptation(self.handle, reach, id, &made, sizeof made); });
  return record("Coaptation")(made.area, made.edge, made.reach);
}

nb::object gap(Surface &self, nb::handle wall_) {
  Surface &wall = object<Surface>(wall_, "wall");
  const Reading reading(self.usage, "surface"), reading_wall(wall.usage, "wall");
  riis_gap made;
  riis_attachment held;
  call_shortly(riis_surface_get_attachment(self.handle, &held, sizeof held));
  std::vector<double> distance(static_cast<std::size_t>(2 * held.n_edges));
  call_library([&] { return riis_surface_get_gap(self.handle, wall.handle, distance.data(), &made, sizeof made); });
  nb::object distances = copy_of(distance.data(), {static_cast<std::size_t>(held.n_edges), 2});
  return record("Gap")(made.least, made.mean, made.most, array_of(made.widest_point, "float64"), distances,
                       made.n_without_wall);
}

void skirt_to_wall(Valve &self, nb::handle wall_, nb::handle longest_, const nb::kwargs &surface_options) {
  Surface &wall = object<Surface>(wall_, "wall");
  const Writing writing(self.usage, "valve");
  const Reading reading_wall(wall.usage, "wall");
  const double longest = number(longest_, "longest");
  riis_surface_options options;
  call_shortly(riis_surface_options_init(&options, sizeof options));
  set_surface_options(options, surface_options, "skirt_to_wall");
  call_library([&] { return riis_valve_set_skirt_to_wall(self.handle, wall.handle, longest, &options); });
  self.has_wall_lengths = true;
}

double leak(Surface &self, nb::handle drop, nb::handle R, nb::handle half_thickness) {
  const Reading reading(self.usage, "surface");
  const riis_resistance model = resistance_of(R, half_thickness, nb::none());
  const double pressure = number(drop, "drop");
  double flow = 0;
  call_library([&] { return riis_surface_get_leak(self.handle, &model, pressure, &flow); });
  return flow;
}

riis_surface_options sweep_options(nb::handle scale, nb::handle n_threads) {
  riis_surface_options options;
  call_shortly(riis_surface_options_init(&options, sizeof options));
  options.scale = number(scale, "scale");
  options.n_threads = thread_count(n_threads);
  return options;
}

double swept_by_valve(Valve &self, nb::handle from_, nb::handle to_, nb::handle leaflet_id, nb::handle scale,
                      nb::handle n_threads) {
  const Reading reading(self.usage, "valve");
  const riis_surface_options options = sweep_options(scale, n_threads);
  const double from = number(from_, "opening_from"), to = number(to_, "opening_to");
  const std::int32_t id = leaflet_or_all(leaflet_id);
  double volume = 0;
  call_library([&] { return riis_valve_get_swept_volume(self.handle, from, to, &options, id, &volume); });
  return volume;
}

nb::object cells_across(Marks &self, nb::handle mesh_) {
  Mesh &mesh = object<Mesh>(mesh_, "mesh");
  const Reading reading_marks(self.usage, "marks"), reading_mesh(mesh.usage, "mesh");
  self.check_threads("marks");
  riis_cells_across made;
  call_library([&] { return riis_marks_get_cells_across(self.handle, mesh.handle, &made, sizeof made); });
  return record("CellsAcross")(made.least, made.mean, made.most, made.shortest_edge, made.mean_edge, made.longest_edge,
                               made.half_thickness, made.n_edges);
}

nb::object find_first_passage(nb::handle valve_, nb::handle mesh_, nb::handle from_, nb::handle to_,
                              nb::handle opening_tolerance, nb::handle mask, nb::handle n_threads,
                              const nb::kwargs &surface_options) {
  Valve &valve = object<Valve>(valve_, "valve");
  Mesh &mesh = object<Mesh>(mesh_, "mesh");
  const Reading reading_valve(valve.usage, "valve"), reading_mesh(mesh.usage, "mesh");
  const MarkOptions marking(mesh, mask, n_threads);
  riis_surface_options surface;
  call_shortly(riis_surface_options_init(&surface, sizeof surface));
  set_surface_options(surface, surface_options, "find_first_passage");
  surface.n_threads = marking.options.n_threads;
  const Array from = Array::of<std::int64_t>(from_, "from_ids"), to = Array::of<std::int64_t>(to_, "to_ids");
  from.expect({-1});
  to.expect({-1});
  riis_passage_ends ends;
  call_shortly(riis_passage_ends_init(&ends, sizeof ends));
  ends.n_from = from.size(0);
  ends.from = from.data<std::int64_t>();
  ends.n_to = to.size(0);
  ends.to = to.data<std::int64_t>();
  riis_first_passage_options options;
  call_shortly(riis_first_passage_options_init(&options, sizeof options));
  options.surface = &surface;
  options.marking = &marking.options;
  options.tolerance = number(opening_tolerance, "opening_tolerance");
  if (!(options.tolerance >= 1e-6 && options.tolerance <= 1))
    refuse_value("opening_tolerance", "is ", number(opening_tolerance, "opening_tolerance"),
                 "; it must be from 1e-06 to 1");
  riis_first_passage found;
  call_library(
      [&] { return riis_find_first_passage(valve.handle, mesh.handle, &ends, &options, &found, sizeof found); });
  static const char *const states[] = {"found", "always", "never", "none"};
  return record("FirstPassage")(states[found.state], found.opening, found.closed_opening, found.node_id, found.distance,
                                array_of(found.point, "float64"), found.n_openings, found.seconds);
}

nb::object find_by_area(nb::handle valve_, nb::handle areas_, nb::handle name_, nb::handle effective, nb::handle from,
                        nb::handle to, nb::handle rim, nb::handle area_tolerance, nb::handle n_samples,
                        const nb::kwargs &surface_options) {
  Valve &valve = object<Valve>(valve_, "valve");
  const Reading reading(valve.usage, "valve");
  riis_surface_options surface;
  call_shortly(riis_surface_options_init(&surface, sizeof surface));
  set_surface_options(surface, surface_options, "find_by_area");
  const riis_resistance model = resistance_of(nb::float_(0.0), nb::none(), rim);
  const std::string name = text(name_, "name");
  riis_area_search search;
  call_shortly(riis_area_search_init(&search, sizeof search));
  search.surface = &surface;
  search.resistance = &model;
  search.area = flag(effective, "effective") ? RIIS_AREA_EFFECTIVE : RIIS_AREA_GEOMETRIC;
  search.from = number_or(from, "from_", search.from);
  search.to = number_or(to, "to", search.to);
  search.tolerance = number(area_tolerance, "area_tolerance");
  if (!(search.tolerance >= 1e-12 && search.tolerance <= 1e-2))
    refuse_value("area_tolerance", "is ", search.tolerance, "; it must be from 1e-12 to 0.01");
  search.n_samples = integer32(n_samples, "n_samples");
  const Array areas = Array::of<double>(areas_, "areas");
  areas.expect({-1});
  const std::int64_t n = areas.size(0);
  const nb::object values = new_array("float64", {n}), reached = new_array("float64", {n});
  const Array value = Array::of<double>(values, "values", Access::write),
              area = Array::of<double>(reached, "reached", Access::write);
  riis_area_range range;
  call_library([&] {
    return riis_find_by_area(valve.handle, name.c_str(), n, areas.data<double>(), &search, value.data<double>(),
                             area.data<double>(), &range, sizeof range);
  });
  const std::size_t n_turns = std::min<std::size_t>(static_cast<std::size_t>(range.n_turns), std::size(range.turns));
  return record("ByArea")(values, reached, range.least, range.most, range.least_at, range.most_at,
                          copy_of(range.turns, {n_turns}), range.n_turns, range.n_surfaces, range.n_refused,
                          range.seconds);
}

#define RIIS_RIM_MODEL "half_thickness: float | None = None, rim: typing.Literal['round', 'cut'] = 'round'"
#define RIIS_SWEEP "leaflet_id: int | None = None, scale: float = 1.0"

}  // namespace

void add_measures(nb::module_ &module) {
  add_method(module, "Surface", "leaflets", &leaflets,
             nb::sig("def leaflets(self) -> list[riis._records.LeafletSizes]"),
             "Returns the sizes of each leaflet, ascending by leaflet_id.");
  add_method(module, "Surface", "orifice", &orifice, nb::kw_only(), nb::arg("half_thickness").none() = nb::none(),
             nb::arg("rim").none() = "round", nb::arg("wall").none() = nb::none(),
             nb::sig("def orifice(self, *, " RIIS_RIM_MODEL ", wall: Surface | None = None) -> riis._records.Orifice"),
             R"(Measures the orifice of a surface, the area that its triangles leave uncovered, seen along its axis.

The outline of a surface from arrays or keyframes is that of its open edges.

half_thickness  eps of the resistance; None: the surface's half thickness
rim             'round' or 'cut', as in add_resistance
wall            a ring or a tube around leaflets that do not reach it; None: the leaflets' own edges are the outline)");
  add_method(module, "Surface", "coaptation", &coaptation, nb::arg("leaflet_id").none() = nb::none(), nb::kw_only(),
             nb::arg("reach").none() = nb::none(),
             nb::sig("def coaptation(self, leaflet_id: int | None = None, *, reach: float | None = None) -> "
                     "riis._records.Coaptation"),
             R"(Measures the coaptation of leaflets: the parts of them that lie within reach of another leaflet.

leaflet_id  the leaflet; None: the sum over all leaflets
reach       the distance within which leaflets touch; None: the surface's half thickness)");
  add_method(module, "Surface", "gap", &gap, nb::arg("wall").none(),
             nb::sig("def gap(self, wall: Surface) -> riis._records.Gap"),
             R"(Measures the gap between the valve's attachment and a wall, along the direction of a skirt.

wall  a surface in the same frame, such as one from arrays)");
  add_method(module, "Valve", "skirt_to_wall", &skirt_to_wall, nb::arg("wall").none(), nb::arg("longest").none(),
             nb::arg("options"),
             nb::sig("def skirt_to_wall(self, wall: Surface, longest: float, **options: typing.Any) -> None"),
             R"(Gives the valve a skirt that reaches a wall, and no farther.

wall     a surface in the frame of the placed valve
longest  the longest length to accept, mesh units
options  options of riis.Surface, of which scale, rotation and translation place the valve)");
  add_method(module, "Surface", "leak", &leak, nb::arg("drop").none(), nb::kw_only(), nb::arg("R").none() = nb::none(),
             nb::arg("half_thickness").none() = nb::none(),
             nb::sig("def leak(self, drop: float, *, R: float, half_thickness: float | None = None) -> float"),
             R"(Returns the ideal leak of a closed surface: the volume flow drop * (eps / R) * area.

The area is that of the middle of the band.

drop            upstream minus downstream pressure
R               mass / (length time), such as kg/(m s), above 0
half_thickness  eps of the resistance; None: the surface's half thickness)");
  add_method(module, "Valve", "swept_volume", &swept_by_valve, nb::arg("opening_from").none(),
             nb::arg("opening_to").none(), nb::kw_only(), nb::arg("leaflet_id").none() = nb::none(),
             nb::arg("scale").none() = 1.0, nb::arg("n_threads").none() = 0,
             nb::sig("def swept_volume(self, opening_from: float, opening_to: float, *, " RIIS_SWEEP
                     ", n_threads: int = 0) -> float"),
             R"(Returns the volume that the valve sweeps between two openings, positive along the normals.

leaflet_id  the leaflet; None: all leaflets
scale       converts lengths to the mesh's unit)");
  add_method(module, "Marks", "cells_across", &cells_across, nb::arg("mesh").none(),
             nb::sig("def cells_across(self, mesh: Mesh) -> riis._records.CellsAcross"),
             R"(Computes the number of mesh edges across the band, from the lengths of the edges with a marked node.

mesh  the mesh of the marking)");
  module.def(
      "find_by_area", &find_by_area, nb::arg("valve").none(), nb::arg("areas").none(), nb::kw_only(),
      nb::arg("name").none() = "opening", nb::arg("effective").none() = false, nb::arg("from_").none() = nb::none(),
      nb::arg("to").none() = nb::none(), nb::arg("rim").none() = "round", nb::arg("area_tolerance").none() = 1e-8,
      nb::arg("n_samples").none() = 33, nb::arg("options"),
      nb::sig("def find_by_area(valve: Valve, areas: numpy.typing.NDArray[numpy.float64], *, name: str = 'opening', "
              "effective: bool = False, from_: float | None = None, to: float | None = None, rim: "
              "typing.Literal['round', 'cut'] = 'round', area_tolerance: float = 1e-8, n_samples: int = 33, "
              "**options: typing.Any) -> riis._records.ByArea"),
      R"(Finds the openings, or the sizes, at which the orifice of a valve has given areas.

areas           (n,), mesh units squared; 0 stands for the closed valve
name            'opening', 'scale' or a parameter with one value
effective       True: the areas are effective areas, with eps as the half thickness; False: geometric areas
from_, to       the values to search; None: 0 to 1 for the opening, a tenth to ten times the scale, half to twice a parameter
rim             'round' or 'cut', as in add_resistance
area_tolerance  of an area, as a share of it, 1e-12 to 1e-2
n_samples       the number of values that are tried first
options         the options of riis.Surface

Of several openings the least is taken, and of several sizes the one nearest to the present size. If the areas were measured at
several times, OpeningTable(times, values) is the opening in time.)");
  module.def("find_first_passage", &find_first_passage, nb::arg("valve").none(), nb::arg("mesh").none(),
             nb::arg("from_ids").none(), nb::arg("to_ids").none(), nb::kw_only(),
             nb::arg("opening_tolerance").none() = 1e-3, nb::arg("mask").none() = nb::none(),
             nb::arg("n_threads").none() = 0, nb::arg("options"),
             nb::sig("def find_first_passage(valve: Valve, mesh: Mesh, from_ids: numpy.typing.NDArray[numpy.int64], "
                     "to_ids: numpy.typing.NDArray[numpy.int64], *, opening_tolerance: float = 1e-3, mask: "
                     "numpy.typing.NDArray[numpy.bool_] | numpy.typing.NDArray[numpy.uint8] | None = None, n_threads: "
                     "int = 0, **options: typing.Any) -> riis._records.FirstPassage"),
             R"(Finds the opening at which a valve first leaves a passage from one set of nodes to another.

from_ids, to_ids   as for find_passage
opening_tolerance  1e-6 to 1
options            the options of riis.Surface

The call tries the openings 0, 1/8, 2/8, ... until it finds a passage. Then it halves the last step.)");
}

}  // namespace riis_python
