// SPDX-License-Identifier: Apache-2.0
#include "program/leaks.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "program/advice.hpp"
#include "program/handles.hpp"
#include "program/numbers.hpp"
#include "program/progress.hpp"
#include "program/refusal.hpp"
#include "program/warnings.hpp"

namespace riis::program {
namespace {

// Examines the edges that may leak. longer_than is the argument of riis_vtk_mesh_create_long_edges.
Leaks leaks_of(const MarkedMesh &marked, const riis_mark_options &options, double longer_than,
               int64_t *n_cells_left_out) {
  riis_adjacency *handle = nullptr;
  check(riis_vtk_mesh_create_long_edges(marked.file, marked.surface, longer_than, options.n_threads, n_cells_left_out,
                                        &handle));
  const Adjacency adjacency(handle);
  riis_csr rows;
  check(riis_adjacency_get_csr(adjacency.get(), &rows, sizeof rows));
  check(riis_mesh_set_adjacency(marked.mesh, &rows));
  riis_leaks *leaks_handle = nullptr;
  check(riis_leaks_create(&leaks_handle));
  Leaks leaks(leaks_handle);
  const riis_status status = riis_find_leaks(marked.surface, marked.mesh, marked.result, &options, leaks.get());
  check(riis_mesh_set_adjacency(marked.mesh, nullptr));  // before the rows go; changes no error message
  check(status);
  return leaks;
}

// Marks once more, with another half thickness, and finds what leaks then.
Leaks leaks_with(const Options &options, const MarkedMesh &marked, double half_thickness) {
  riis_surface_options surface_options = options.surface_options;
  surface_options.half_thickness = half_thickness;
  riis_surface *surface_handle = nullptr;
  check(riis_surface_create(marked.valve, &surface_options, &surface_handle));
  const Surface surface(surface_handle);
  riis_marks *result_handle = nullptr;
  check(riis_marks_create(&result_handle));
  const Marks result(result_handle);
  riis_mark_options mark_options = options.mark_options;
  mark_options.search = RIIS_SEARCH_AUTO;
  mark_options.distance_limit = RIIS_AUTO;
  check(riis_mark_nodes(surface.get(), marked.mesh, &mark_options, result.get()));
  const bool is_by_triangles = options.surface_options.measure == RIIS_MEASURE_TRIANGLES;
  return leaks_of({surface.get(), marked.valve, marked.file, marked.mesh, result.get(), ""}, mark_options,
                  is_by_triangles ? 2 * half_thickness : 0, nullptr);
}

// The triangles of a valve follow the half thickness, so the number is tried. The triangles of a file stay. 0: none was found.
double closing_half_thickness(const Options &options, const MarkedMesh &marked, const riis_leak_list &leaks) {
  constexpr int n_tries = 8;
  double wanted = rounded_up(leaks.half_thickness);
  if (!marked.valve) return wanted;
  try {
    for (int i = 0; i < n_tries; ++i) {
      const Leaks handle = leaks_with(options, marked, wanted);
      const riis_leak_list left = list_of(handle.get());
      if (left.n_edges == 0) return wanted;
      wanted = rounded_up(std::max(left.half_thickness, 1.01 * wanted));
    }
  } catch (const Refusal &) {
    // The marks and the warning are good without advice: some half thicknesses do not make a surface.
  }
  return 0;
}

// Not even --quiet silences this: the valve does not hold.
void warn_of_leaks(const Options &options, const LeakReport &report, const std::string &surface,
                   double half_thickness) {
  const riis_leak_list &leaks = report.found;
  const bool is_one = leaks.n_edges == 1;
  const std::string length = shown(leaks.longest_length);
  const std::string text =
      surface + " leaks: " +
      (is_one ? "1 edge of length " + length + " crosses it between two unmarked nodes"
              : grouped(leaks.n_edges) + " edges cross it between two unmarked nodes, the longest (" + length + ")") +
      " at " + place_text(options, leaks.longest_middle, leaks.longest_length);
  std::string advice = "; ";
  if (report.closing_half_thickness > 0)
    advice += "--half-thickness " + shortest(report.closing_half_thickness) + " closes " + (is_one ? "it; " : "them; ");
  warn({{Cause::leaks, text,
         advice + "edges of at most two half thicknesses (" + shortest(2 * half_thickness) + ") do not leak"}});
}

}  // namespace

double rounded_up(double x) {
  const double unit = std::pow(10.0, std::floor(std::log10(x)) - 2);
  for (int steps = 0;; ++steps) {
    char text[64];
    double rounded = 0;
    const char *end = std::to_chars(text, text + sizeof text, x + steps * unit, std::chars_format::general, 3).ptr;
    std::from_chars(text, end, rounded);
    if (rounded >= x) return rounded;
  }
}

void look_for_leaks(const Options &options, const MarkedMesh &marked, Report &report) {
  const Stage stage("looking for leaks", options.quiet);
  LeakReport &leaks = report.leaks;
  // Short edges may also leak if marks may be missing, or if distances are not those to the triangles.
  const bool is_by_triangles = options.surface_options.measure == RIIS_MEASURE_TRIANGLES;
  const bool only_long = report.marks.complete && is_by_triangles;
  const double half_thickness = report.surface.half_thickness;
  const Leaks found =
      leaks_of(marked, options.mark_options, only_long ? 2 * half_thickness : 0, &leaks.n_cells_left_out);
  leaks.found = list_of(found.get());
  leaks.edges.assign(leaks.found.node_id, leaks.found.node_id + 2 * leaks.found.n_edges);
  leaks.found.node_id = nullptr;
  leaks.found.length = leaks.found.distance = nullptr;
  check(riis_vtk_mesh_get_volume_cells(marked.file, &leaks.n_volume_cells, nullptr));
  if (leaks.found.n_edges > 0 && !options.check_leaks) {
    if (report.marks.complete) leaks.closing_half_thickness = closing_half_thickness(options, marked, leaks.found);
    warn_of_leaks(options, leaks, marked.surface_name, half_thickness);
  }
  if (!options.check_leaks && !leaks.has_all_edges())
    warn((leaks.found.n_edges > 0 ? "more leaks of " : "leaks of ") + marked.surface_name +
         " are unknown: " + why_unknown(leaks, options.mesh));
  report.seconds.leaks = stage.seconds();
}

}  // namespace riis::program
