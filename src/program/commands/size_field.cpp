// SPDX-License-Identifier: Apache-2.0
#include "program/commands/commands.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "common/array_view.hpp"
#include "program/base/progress.hpp"
#include "program/base/text.hpp"
#include "program/input/case.hpp"
#include "program/input/face_faults.hpp"
#include "program/input/valve_source.hpp"
#include "program/mark/moving_valve.hpp"
#include "program/mark/warnings.hpp"
#include "program/output/outputs.hpp"

namespace riis::program {
namespace {

// The largest number of points of the grid.
constexpr std::int64_t most_field_points = 20'000'000;

// Returns the valves and their times. If the user gives neither times nor an opening, the valve of the command line moves through
// all openings.
Case case_of(const SizeFieldOptions &options) {
  const bool has_case = !options.series.case_file.empty();
  Case all = has_case ? read_case(options) : case_of_command_line(options);
  std::vector<double> &times = all.options.series.times;
  if (!times.empty()) return all;
  times = {options.time.value_or(0)};
  if (has_case) return all;
  read_surfaces(all);
  ValveSource &source = all.valves[0];
  if (!source.valve || sets_opening(options)) return all;
  const Valve trial = program::copy_of(source.valve);
  if (!why_closed(trial, options.surface_options).empty()) return all;
  source.law = OpeningLaw(OpeningTable{{0, 1}, {0, 1}}, "");  // the opening equals the time
  times = openings_from_0_to_1(options.n_openings);
  return all;
}

// The edge lengths around one valve. The length is `band` within `band_reach` of the surface, and `beside_rims` within
// `band_reach` of a rim. Farther away, the length grows with the distance up to `largest`.
struct Edges {
  double half_thickness, offset, band_reach, band, beside_rims, growth, largest;

  double at(double distance) const { return std::min(largest, band + growth * std::max(0.0, distance - band_reach)); }
  // The distance at which the edge length reaches its largest value.
  double reach() const { return band_reach + (largest - band) / growth; }
};

std::vector<Edges> edges_of(const SizeFieldOptions &options, const std::vector<MovingValve> &valves) {
  std::vector<Edges> edges;
  double thickest = 0;
  for (const MovingValve &valve : valves) {
    const riis_surface_info info = info_of(valve.surface());
    const double half_thickness = info.half_thickness, o = info.offset, band = options.band_edge * half_thickness;
    // An edge longer than 2 half thicknesses can reach through the band, so it leaks. If the band has an offset o, an edge beside
    // a rim already leaks if it is longer than 2 sqrt(1 - o^2) half thicknesses (docs/theory/marks.md, "Offset"). One end of such
    // an edge is within `band_reach` of the rim.
    edges.push_back({half_thickness, o, (1 + std::abs(o)) * half_thickness, band, band * std::sqrt((1 - o) * (1 + o)),
                     options.growth, 0});
    thickest = std::max(thickest, info.half_thickness);
  }
  const double largest = options.largest_edge.value_or(4 * thickest);
  for (Edges &one : edges) {
    one.largest = largest;
    if (largest < one.band)
      refuse_usage("--largest-edge: " + shortest(largest) + " is below the edge length in the band, " +
                   shortest(one.band) + " (--band-edge times the half thickness)");
  }
  return edges;
}

struct Grid {
  std::array<double, 3> origin;
  double spacing;
  std::array<std::int64_t, 3> n;

  std::int64_t n_points() const { return n[0] * n[1] * n[2]; }
  // The grid's points are in gmsh's order, in which z runs fastest.
  std::vector<double> points() const {
    std::vector<double> xyz;
    xyz.reserve(static_cast<std::size_t>(3 * n_points()));
    for (std::int64_t i = 0; i < n[0]; ++i)
      for (std::int64_t j = 0; j < n[1]; ++j)
        for (std::int64_t k = 0; k < n[2]; ++k)
          for (const auto &[axis, at] : {std::pair(0, i), std::pair(1, j), std::pair(2, k)})
            xyz.push_back(origin[static_cast<std::size_t>(axis)] + spacing * static_cast<double>(at));
    return xyz;
  }
};

// A surface, and the edge lengths that depend on the distance from it.
struct Zone {
  Surface surface;
  Edges edges;
};

// Adds a narrow strip of triangles along the rim of a surface. The rim consists of the edges that belong to one triangle only.
// Vertices with equal coordinates count as one.
void add_rim(const riis_triangles &triangles, Triangles &rim) {
  for_each_edge(sorted_sides(joined_corners(triangles)), [&](const TriangleSide *side, std::size_t n_sides) {
    if (n_sides != 1 || side->a == side->b) return;
    const auto corner = [&](std::size_t k) {
      const auto at = static_cast<std::int64_t>((side->k + k) % 3);
      const double *const xyz = triangles.xyz + 3 * triangles.vertex_id[3 * side->triangle + at];
      return Vector3{xyz[0], xyz[1], xyz[2]};
    };
    const Vector3 middle = 0.5 * (corner(0) + corner(1));
    const std::int64_t first = view(rim.points).size();
    rim.points.insert(rim.points.end(), {corner(0), corner(1), middle + 1e-3 * (corner(2) - middle)});
    rim.corners.push_back({first, first + 1, first + 2});
  });
}

Surface surface_of(const Triangles &triangles, double half_thickness) {
  const riis_surface_arrays arrays = arrays_of(triangles);
  auto how = defaults<riis_surface_options>();
  how.half_thickness = half_thickness;
  how.zero_area = RIIS_ZERO_AREA_SKIP;  // the valve's own surface has no such triangles, except by rounding
  return create_for<Surface>("the triangles of all states together", riis_surface_create_from_arrays, &arrays, &how);
}

// Joins the triangles of one valve at all times into one surface. The distance to the joined surface is the least distance during
// the whole motion, so each valve is marked only once. If the band has an offset, a second joined surface has the rims at all
// times.
void add_zones(MovingValve &valve, const Edges &edges, const Case &all, std::vector<Zone> &zones) {
  const std::vector<double> &times = all.options.series.times;
  Triangles swept, rims;
  std::set<double> openings;
  StepProgress progress("collecting the states", times.size(), all.options.quiet);
  for (std::size_t step = 0; step < times.size(); ++step) {
    progress.begin(step);
    valve.move_to(times[step]);
    // An opening that occurs again is skipped, because its triangles have been added before.
    if (!valve.source().keyframes && !openings.insert(valve.opening().value_or(0)).second) continue;
    const riis_triangles triangles = triangles_of(valve.surface());
    add_triangles(swept, triangles);
    if (edges.offset != 0) add_rim(triangles, rims);
  }
  zones.push_back({surface_of(swept, edges.half_thickness), edges});
  if (rims.n() == 0) return;
  zones.push_back({surface_of(rims, edges.half_thickness), edges});
  zones.back().edges.band = edges.beside_rims;
}

// Returns the box around all points that are within reach of a surface.
Box box_around(const std::vector<Zone> &zones) {
  Box box = empty_box();
  for (const Zone &zone : zones) box.grow(box_of(info_of(zone.surface)).widened(zone.edges.reach()));
  return box;
}

// Returns the grid in a box. The spacing may come from the user.
Grid grid_in(const Box &box, double spacing, bool is_given) {
  Grid grid{{box.lower[0], box.lower[1], box.lower[2]}, spacing, {}};
  double n_points = 1;
  for (std::size_t k = 0; k < 3; ++k) {
    const double n = std::ceil((box.upper[k] - box.lower[k]) / spacing) + 1;
    n_points *= n;
    grid.n[k] = n < 1e9 ? static_cast<std::int64_t>(n) : most_field_points;
  }
  if (!(n_points <= static_cast<double>(most_field_points)))
    refuse_usage("--spacing: the grid would have " + shown(n_points) + " points with a spacing of " +
                 shortest(spacing) + "; at most " + grouped(most_field_points) + " are possible" +
                 (is_given ? ""
                           : "; the spacing is half of the half thickness, and the largest side is " +
                                 shown(box.largest_side()) + ": write a larger --half-thickness or --spacing"));
  return grid;
}

// Returns the edge length at each point. If the zones have different lengths there, the least of these lengths counts.
std::vector<double> lengths_at(const Grid &grid, const std::vector<Zone> &zones, const SizeFieldOptions &options) {
  const Stage stage("measuring the distances of the grid", options.quiet);
  const std::vector<double> xyz = grid.points();
  const auto mesh = create<Mesh>(riis_mesh_create, grid.n_points(), xyz.data(), xyz.data() + 1, xyz.data() + 2, 3);
  // Most points of the grid are near the valves. The search in clusters is therefore the fastest.
  check(riis_mesh_prepare(mesh, options.mark_options.n_threads));
  const Marks marks = new_result();
  std::vector<double> lengths(static_cast<std::size_t>(grid.n_points()), zones[0].edges.largest);
  for (const Zone &zone : zones) {
    riis_mark_options how = options.mark_options;
    how.distance_limit = std::max(zone.edges.reach(), zone.edges.half_thickness);
    check(riis_mark_nodes(zone.surface.get(), mesh, &how, marks));
    const riis_mark_list near = list_of(marks, RIIS_LIST_WITHIN_LIMIT);
    for (std::int64_t i = 0; i < near.n_nodes; ++i) {
      double &length = view(lengths)[near.node_id[i]];
      length = std::min(length, zone.edges.at(near.distance[i]));
    }
  }
  return lengths;
}

// Returns the text of gmsh's field "Structured": the origin, the spacing, the numbers of points, and the lengths in gmsh's order.
std::string text_of(const Grid &grid, const std::vector<double> &lengths) {
  const std::string spacing = shortest(grid.spacing);
  std::string text = numbers_text(grid.origin.data(), 3, " ") + "\n" + spacing + " " + spacing + " " + spacing + "\n" +
                     std::to_string(grid.n[0]) + " " + std::to_string(grid.n[1]) + " " + std::to_string(grid.n[2]) +
                     "\n";
  for (std::size_t i = 0; i < lengths.size(); ++i) {
    text += printed("%.5g", lengths[i]);
    text += static_cast<std::int64_t>(i + 1) % grid.n[2] == 0 ? '\n' : ' ';
  }
  return text;
}

// Returns the lines that load the field in a .geo file. gmsh takes the least length of all its sources of lengths, so the lines
// switch off the other sources.
std::string gmsh_lines(const SizeFieldOptions &options, double largest) {
  return "gmsh      Field[1] = Structured;\n"
         "          Field[1].FileName = \"" +
         options.field +
         "\";\n"
         "          Field[1].TextFormat = 1;\n"
         "          Field[1].SetOutsideValue = 1;\n"
         "          Field[1].OutsideValue = " +
         shortest(largest) +
         ";\n"
         "          Background Field = 1;\n"
         "          Mesh.MeshSizeExtendFromBoundary = 0;\n"
         "          Mesh.MeshSizeFromPoints = 0;\n"
         "          Mesh.MeshSizeFromCurvature = 0;\n";
}

void print_summary(const SizeFieldOptions &options, const Case &all, const std::vector<Edges> &edges,
                   const Grid &grid) {
  if (options.quiet || options.field == "-") return;
  const auto by_band = [](const Edges &a, const Edges &b) { return a.band < b.band; };
  const Edges least = *std::min_element(edges.begin(), edges.end(), by_band);
  const bool has_openings = options.series.case_file.empty() && options.series.times.empty();
  std::string text = "states    " + counted(static_cast<std::int64_t>(all.options.series.times.size()), "state") +
                     (has_openings && all.options.series.times.size() > 1 ? ", openings from 0 to 1\n" : "\n");
  text += "edges     " + shown(least.band) + " within " +
          (least.offset != 0 ? "the reach of the band, " : "the half thickness of ") + shown(least.band_reach) +
          (least.offset != 0 ? ", and " + shown(least.beside_rims) + " beside rims" : "") + ", growing by " +
          shown(least.growth) + " a length, up to " + shown(least.largest) + "\n";
  text += "grid      " + counted(grid.n_points(), "point") + ", spacing " + shown(grid.spacing) + "\n";
  text += "written   " + options.field + "\n";
  write_text("-", text + gmsh_lines(options, least.largest));
}

}  // namespace

ExitCode run_size_field(const SizeFieldOptions &options) {
  Case all = case_of(options);
  const OutputLocks locks = check_outputs(options, all.files);
  std::vector<MovingValve> valves = moving_valves(all);
  const std::vector<Edges> edges = edges_of(options, valves);
  double spacing = std::numeric_limits<double>::infinity();
  for (const Edges &one : edges) spacing = std::min(spacing, 0.5 * one.half_thickness);
  if (options.spacing) spacing = *options.spacing;
  // Collecting all states may take minutes. A grid around only the first states is therefore made first. It may already show that
  // the spacing gives too many points.
  Box first = empty_box();
  for (std::size_t i = 0; i < valves.size(); ++i)
    first.grow(box_of(info_of(valves[i].surface())).widened(edges[i].reach()));
  grid_in(first, spacing, options.spacing.has_value());
  std::vector<Zone> zones;
  for (std::size_t i = 0; i < valves.size(); ++i) add_zones(valves[i], edges[i], all, zones);
  const Grid grid = grid_in(box_around(zones), spacing, options.spacing.has_value());
  const std::vector<double> lengths = lengths_at(grid, zones, options);
  write_text(options.field, text_of(grid, lengths));
  print_summary(options, all, edges, grid);
  return exit_fine;
}

}  // namespace riis::program
