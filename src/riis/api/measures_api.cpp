// SPDX-License-Identifier: Apache-2.0
// Checks the arguments of the public functions for leaflets, orifice, leak, first passage and swept volume.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <vector>

#include "api/handles.hpp"
#include "api/structs.hpp"
#include "api/surface_options.hpp"
#include "base/errors.hpp"
#include "base/integer_array.hpp"
#include "common/array_view.hpp"
#include "common/first_passage.hpp"
#include "measures/measures.hpp"

using riis::check_range;
using riis::guarded_with_handles;
using riis::require;
using riis::require_handle;

namespace {

const riis_first_passage_options default_first_passage{sizeof(riis_first_passage_options), nullptr, nullptr, 1e-3};

// Returns the caller's resistance with the surface's half thickness in place of RIIS_AUTO. NULL stands for the defaults. R is not
// checked.
riis_resistance resistance_for(const riis_resistance *resistance, const riis::Surface &surface) {
  riis_resistance defaults;
  riis_resistance_init(&defaults, sizeof defaults);
  riis_resistance whole = riis::completed(resistance, "resistance", defaults);
  if (whole.half_thickness == RIIS_AUTO) whole.half_thickness = surface.half_thickness();
  check_range("resistance", "half_thickness", whole.half_thickness, 1e-50, 1e50);
  if (whole.rim != RIIS_RIM_ROUND && whole.rim != RIIS_RIM_CUT)
    riis::fail(RIIS_INVALID_ARGUMENT, "resistance.rim is ", whole.rim, "; it must be RIIS_RIM_ROUND or RIIS_RIM_CUT");
  riis::check_reserved("resistance.reserved", whole.reserved);
  return whole;
}

// `wall` bounds the orifice. Without a wall, the pointer is null.
riis_orifice orifice_of(const riis::Surface &surface, const riis::Surface *wall, const riis_resistance &resistance) {
  const double c = riis::rim_reach(surface, resistance.rim);
  const double eps = resistance.half_thickness;
  const riis::OrificeLimits limits{c * eps, 0.1 * eps};
  const riis::SourceValve *source = surface.source() ? &*surface.source() : nullptr;
  const riis::TriangleSet &set = surface.triangles();
  const riis::Orifice found = wall ? riis::measure_orifice_in_wall(set, source, wall->triangles(), limits)
                                   : riis::measure_orifice(set, source, limits);
  if (wall && found.outline == RIIS_OUTLINE_NONE)
    riis::fail(RIIS_INVALID_ARGUMENT, "wall has no outline: its open edges do not surround a centre");
  const double radius = found.outline == RIIS_OUTLINE_DISC ? source->placement.scale * source->disc.radius : 0;
  return {found.area,
          found.outline_area,
          found.perimeter,
          found.effective_area,
          c,
          eps,
          radius,
          {found.axis.x, found.axis.y, found.axis.z},
          found.outline,
          0};
}

void write_orifice(const riis::Surface &surface, const riis::Surface *wall, const riis_resistance *resistance,
                   riis_orifice *orifice, int64_t struct_size) {
  const riis_resistance whole = resistance_for(resistance, surface);
  riis::check_struct_size<riis_orifice>(struct_size, "orifice");
  require(orifice, "orifice");
  riis::write_struct(orifice, struct_size, "orifice", orifice_of(surface, wall, whole));
}

// Finds the passage through a mesh at each opening that the search tries. PassageTrials calls the public functions, which refuse
// bad input.
class PassageTrials {
 public:
  PassageTrials(const riis_valve *valve, const riis_mesh *mesh, const riis_passage_ends *ends,
                const riis_first_passage_options &options)
      : valve_(valve->valve), mesh_(mesh), ends_(ends), options_(options) {}
  ~PassageTrials() { riis_surface_destroy(&surface_); }
  PassageTrials(const PassageTrials &) = delete;
  PassageTrials &operator=(const PassageTrials &) = delete;

  riis_passage at(double opening) {
    valve_.set("opening", 1, &opening);
    const riis_valve moved{{}, valve_};
    check(surface_ ? riis_surface_update(surface_, &moved, nullptr)
                   : riis_surface_create(&moved, options_.surface, &surface_),
          "options.surface: ", opening);
    riis_passage passage;
    check(riis_find_passage(surface_, mesh_, ends_, options_.marking, &passage, sizeof passage), "", opening);
    return passage;
  }

 private:
  static void check(riis_status status, const char *argument, double opening) {
    if (status != RIIS_OK) riis::fail(status, "at the opening ", opening, ": ", argument, riis_last_error());
  }

  riis::Valve valve_;
  const riis_mesh *mesh_;
  const riis_passage_ends *ends_;
  const riis_first_passage_options &options_;
  riis_surface *surface_ = nullptr;
};

// Returns the volume that one leaflet sweeps after the placement. RIIS_ALL_LEAFLETS gives the sum over the leaflets without the
// skirt, whose id is the largest.
double placed_volume(const riis::SweptVolumes &volumes, std::int32_t leaflet_id, bool has_skirt,
                     const riis_surface_options &options) {
  const std::int32_t skirt = has_skirt ? volumes.rbegin()->first : -1;
  double sum = 0;
  for (const auto &[id, volume] : volumes)
    if (leaflet_id == RIIS_ALL_LEAFLETS ? id != skirt : id == leaflet_id) sum += volume;
  if (leaflet_id != RIIS_ALL_LEAFLETS && volumes.count(leaflet_id) == 0)
    riis::fail(RIIS_INVALID_ARGUMENT, "leaflet_id is ", leaflet_id,
               ", which the patches of the valve lack; RIIS_ALL_LEAFLETS, -1, stands for all");
  const double scale = options.scale;
  return (options.flip_normals ? -1 : 1) * (scale * scale * scale) * sum;
}

riis_surface_options checked_options(const riis_surface_options *options) {
  const riis_surface_options whole = riis::completed(options, "options", riis::default_surface_options);
  riis::check_options(whole);
  return whole;
}

}  // namespace

extern "C" {

riis_status riis_surface_get_n_leaflets(const riis_surface *surface, int64_t *n_leaflets) {
  return guarded_with_handles([&] {
    const riis::Surface &content = riis::content_of(surface);
    *require(n_leaflets, "n_leaflets") = riis::view(content.leaflet_ids()).size();
  });
}

riis_status riis_surface_get_leaflet(const riis_surface *surface, int64_t leaflet, riis_leaflet *sizes,
                                     int64_t struct_size) {
  return guarded_with_handles([&] {
    const std::vector<riis_leaflet> &leaflets = riis::content_of(surface).leaflets();
    const auto n = riis::view(leaflets).size();
    if (leaflet < 0 || leaflet >= n)
      riis::fail(RIIS_INVALID_ARGUMENT, "leaflet is ", leaflet, "; the surface has ", n, ", from 0");
    riis::write_struct(sizes, struct_size, "sizes", riis::view(leaflets)[leaflet]);
  });
}

riis_status riis_surface_get_orifice(const riis_surface *surface, const riis_resistance *resistance,
                                     riis_orifice *orifice, int64_t struct_size) {
  return guarded_with_handles(
      [&] { write_orifice(riis::content_of(surface), nullptr, resistance, orifice, struct_size); });
}

riis_status riis_surface_get_orifice_in_wall(const riis_surface *surface, const riis_surface *wall,
                                             const riis_resistance *resistance, riis_orifice *orifice,
                                             int64_t struct_size) {
  return guarded_with_handles([&] {
    const riis::Surface &content = riis::content_of(surface);
    const riis::Surface &of_wall = require_handle(wall, "wall")->updatable.surface();
    write_orifice(content, &of_wall, resistance, orifice, struct_size);
  });
}

riis_status riis_surface_get_coaptation(const riis_surface *surface, double reach, int32_t leaflet_id,
                                        riis_coaptation *coaptation, int64_t struct_size) {
  return guarded_with_handles([&] {
    const riis::Surface &content = riis::content_of(surface);
    const double whole = reach == RIIS_AUTO ? content.half_thickness() : reach;
    check_range("", "reach", whole, 1e-50, 1e50);
    riis::check_struct_size<riis_coaptation>(struct_size, "coaptation");
    require(coaptation, "coaptation");
    const std::vector<std::int32_t> &ids = content.leaflet_ids();
    if (leaflet_id != RIIS_ALL_LEAFLETS && std::find(ids.begin(), ids.end(), leaflet_id) == ids.end())
      riis::fail(RIIS_INVALID_ARGUMENT, "leaflet_id is ", leaflet_id,
                 ", which the surface lacks; RIIS_ALL_LEAFLETS, -1, stands for all");
    const riis::TriangleSet &triangles = content.triangles();
    const std::vector<std::int32_t> omitted{content.source() ? content.source()->housing : -1, triangles.skirt};
    const auto contacts = riis::contacts_of(triangles, riis::free_edge_parts(triangles), whole, leaflet_id, omitted,
                                            riis::threads_for(0, triangles.n_triangles(), riis::triangles_per_thread));
    riis_coaptation made{0, 0, whole};
    for (const auto &[id, contact] : contacts) made.area += contact.area, made.edge += contact.edge;
    riis::write_struct(coaptation, struct_size, "coaptation", made);
  });
}

riis_status riis_surface_get_gap(const riis_surface *surface, const riis_surface *wall, double *distance, riis_gap *gap,
                                 int64_t struct_size) {
  return guarded_with_handles([&] {
    const riis::Surface &content = riis::content_of(surface);
    const riis::Surface &of_wall = require_handle(wall, "wall")->updatable.surface();
    riis::check_struct_size<riis_gap>(struct_size, "gap");
    require(gap, "gap");
    if (!content.has_attachment())
      riis::fail(RIIS_INVALID_ARGUMENT,
                 "surface was made from arrays without a skirt, so its attached edges are not known: name the attached "
                 "vertices by arrays.attached");
    const riis::Gap made = riis::gap_of(content.attachment(), {of_wall.triangles(), of_wall.scene()},
                                        riis::threads_for(0, content.attachment().n_edges(), 2048));
    if (distance) std::copy(made.distance.begin(), made.distance.end(), distance);
    riis::write_struct(gap, struct_size, "gap", made.measures);
  });
}

riis_status riis_surface_get_leak(const riis_surface *surface, const riis_resistance *resistance, double drop,
                                  double *flow) {
  return guarded_with_handles([&] {
    const riis::Surface &content = riis::content_of(surface);
    const riis_resistance whole = resistance_for(require(resistance, "resistance"), content);
    check_range("resistance", "R", whole.R, 1e-60, 1e60);
    check_range("", "drop", drop, -1e30, 1e30);
    require(flow, "flow");
    const std::int32_t housing = content.source() ? content.source()->housing : -1;
    const riis::Band band = content.band().with(whole.half_thickness);
    const double area = band.steps_aside() ? riis::moved_area(content, band.offset * band.half_thickness, housing)
                        : content.source() ? riis::area_without(content.leaflets(), housing)
                                           : content.area();
    *flow = drop * (whole.half_thickness / whole.R) * area;
  });
}

RIIS_DEFINE_INIT(riis_first_passage_options_init, riis_first_passage_options, options, default_first_passage)

riis_status riis_find_first_passage(const riis_valve *valve, const riis_mesh *mesh, const riis_passage_ends *ends,
                                    const riis_first_passage_options *options, riis_first_passage *first,
                                    int64_t struct_size) {
  return guarded_with_handles([&] {
    const auto start = std::chrono::steady_clock::now();
    require_handle(valve, "valve");
    require_handle(mesh, "mesh");
    require(ends, "ends");
    const riis_first_passage_options whole = riis::completed(options, "options", default_first_passage);
    check_range("options", "tolerance", whole.tolerance, 1e-6, 1);
    riis::check_struct_size<riis_first_passage>(struct_size, "first");
    require(first, "first");
    if (!valve->valve.can_open())
      riis::fail(RIIS_INVALID_PARAMETER, "valve has only one state: set its open state with riis_valve_set_open_state");
    PassageTrials trials(valve, mesh, ends, whole);
    riis_first_passage found =
        riis::first_passage(whole.tolerance, [&trials](double opening) { return trials.at(opening); });
    const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;
    found.seconds = elapsed.count();
    riis::write_struct(first, struct_size, "first", found);
  });
}

riis_status riis_valve_get_swept_volume(const riis_valve *valve, double opening_from, double opening_to,
                                        const riis_surface_options *options, int32_t leaflet_id, double *volume) {
  return guarded_with_handles([&] {
    const riis::Valve &content = require_handle(valve, "valve")->valve;
    check_range("", "opening_from", opening_from, 0, 1);
    check_range("", "opening_to", opening_to, 0, 1);
    const riis_surface_options whole = checked_options(options);
    require(volume, "volume");
    constexpr std::int64_t triangles_at_all_openings = 4'000'000;
    const int n_threads =
        riis::threads_for(whole.n_threads, "options.n_threads", triangles_at_all_openings, riis::triangles_per_thread);
    *volume = placed_volume(riis::swept_volumes(content, opening_from, opening_to, n_threads), leaflet_id,
                            content.has_skirt(), whole);
  });
}
}
