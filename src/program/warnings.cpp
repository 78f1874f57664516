// SPDX-License-Identifier: Apache-2.0
#include "program/warnings.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <utility>

#include "program/advice.hpp"
#include "program/refusal.hpp"
#include "program/report.hpp"

namespace riis::program {
namespace {

std::int64_t n_printed = 0;
Cause first_cause = Cause::leaks;  // of the advice that was printed

// With fewer nodes, all of them may well lie near the surface.
constexpr int64_t fewest_judged_nodes = 100;

Box box_of(int64_t n_nodes, const double *xyz) {
  Box box{{xyz[0], xyz[1], xyz[2]}, {xyz[0], xyz[1], xyz[2]}};
  for (int64_t i = 0; i < 3 * n_nodes; ++i) {
    const auto axis = i % 3;
    box.lower[axis] = std::min(box.lower[axis], xyz[i]);
    box.upper[axis] = std::max(box.upper[axis], xyz[i]);
  }
  return box;
}

// Returns a coordinate, rounded to a tenth of the edge or finer. It has no trailing zeros, and 0 has no sign.
std::string coordinate_text(double x, double edge) {
  constexpr int most_digits = 17;  // of any double
  int n_digits = 6;
  if (edge > 0) n_digits = static_cast<int>(std::floor(std::log10(std::abs(x))) - std::floor(std::log10(edge)) + 2);
  if (x == 0 || n_digits < 1) return "0";
  char text[32];
  const int precision = std::min(n_digits, most_digits);
  double rounded = 0;
  const char *end = std::to_chars(text, text + sizeof text, x, std::chars_format::scientific, precision - 1).ptr;
  std::from_chars(text, end, rounded);
  const bool is_usual = std::abs(rounded) >= 1e-9 && std::abs(rounded) < 1e15;
  const auto form = is_usual ? std::chars_format::fixed : std::chars_format::scientific;
  return {text, std::to_chars(text, text + sizeof text, rounded, form).ptr};
}

std::string text_of(const Box &box, double edge) {
  std::string text;
  for (int k = 0; k < 3; ++k) {
    text += std::string(k == 0 ? "" : ", ") + "xyz"[k] + " " + coordinate_text(box.lower[k], edge) + " to " +
            coordinate_text(box.upper[k], edge);
  }
  return text;
}

bool has_all(const Situation &s) { return s.n_marked == s.n_nodes && s.n_nodes >= fewest_judged_nodes; }

// A single layer of nodes all over the surface would have about area / edge^2 nodes.
bool has_hardly_any(const Situation &s) {
  if (s.n_marked == 0 || s.n_nodes < fewest_judged_nodes || s.median_edge == 0) return false;
  return static_cast<double>(s.n_marked) * s.median_edge * s.median_edge < 0.1 * s.area;
}

bool has_odd_half_thickness(const Situation &s) {
  return s.n_nodes >= fewest_judged_nodes && (is_too_large(s.half_thickness, s) || is_too_small(s.half_thickness, s));
}

std::string marked_text(const Situation &s) {
  if (s.n_marked == 0) return "no node is marked";
  if (has_all(s)) return "all " + counted(s.n_nodes, "node") + " are marked";
  const std::string text =
      grouped(s.n_marked) + " of " + counted(s.n_nodes, "node") + (s.n_marked == 1 ? " is marked" : " are marked");
  return has_hardly_any(s) ? "only " + text : text + ", which looks wrong";
}

// Tells the places, for the case that sizes explain nothing.
Warning warning_of_places(const Situation &s) {
  return {Cause::place,
          "the mesh is in " + text_of(s.mesh, s.median_edge) + ", the surface in " + text_of(s.surface, s.median_edge) +
              ", the half thickness is " + shown(s.half_thickness),
          ": see --translate, --rotate, --scale, --half-thickness"};
}

}  // namespace

double Box::largest_side() const { return std::max({upper[0] - lower[0], upper[1] - lower[1], upper[2] - lower[2]}); }

Situation situation_of(const Options &options, const riis_surface_info &surface, const riis_mark_stats &marks,
                       const riis_vtk_mesh *mesh) {
  int64_t n_nodes = 0;
  const double *xyz = nullptr;
  check(riis_vtk_mesh_get_nodes(mesh, &n_nodes, nullptr, &xyz));
  Situation situation{options, n_nodes, marks.n_marked, box_of(n_nodes, xyz),
                      {},      0,       surface.area,   surface.half_thickness};
  std::copy_n(surface.lower, 3, situation.surface.lower);
  std::copy_n(surface.upper, 3, situation.surface.upper);
  check(riis_vtk_mesh_get_median_edge(mesh, &situation.median_edge));
  return situation;
}

std::optional<Warning> warning_of(const Situation &s) {
  const bool has_none = s.n_marked == 0 && !s.options.allow_none;
  if (!has_none && !has_all(s) && !has_hardly_any(s) && !has_odd_half_thickness(s)) return std::nullopt;
  std::optional<Warning> why = warning_of_units(s);
  if (!why) why = warning_of_half_thickness(s);
  if (!why) why = warning_of_places(s);
  why->text = marked_text(s) + ": " + why->text;
  return why;
}

void warn(const std::string &text) {
  ++n_printed;
  std::fprintf(stderr, "riis-mark: %s\n", text.c_str());
}

void warn(std::vector<Warning> warnings) {
  std::stable_sort(warnings.begin(), warnings.end(),
                   [](const Warning &a, const Warning &b) { return a.cause < b.cause; });
  for (const Warning &warning : warnings) {
    const bool is_first = warning.cause <= first_cause;
    if (is_first) first_cause = warning.cause;
    warn(is_first ? warning.text + warning.advice : warning.text);
  }
}

std::int64_t n_warnings() { return n_printed; }

std::string place_text(const Options &options, const double *point, double edge) {
  std::string text;
  for (int k = 0; k < 3; ++k) text += (k == 0 ? "" : " ") + coordinate_text(point[k], edge);
  return options.unit ? text + " " + name_of(*options.unit) : text;
}

}  // namespace riis::program
