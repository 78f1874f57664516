// SPDX-License-Identifier: Apache-2.0

#include "program/base/units.hpp"

#include <array>
#include <cmath>
#include <cstddef>
#include <functional>

#include "common/vectors.hpp"

namespace riis::program {

namespace {

constexpr std::array<Unit, 3> all_units = {Unit::metre, Unit::centimetre, Unit::millimetre};

// The results are whole numbers. The quotient of two results is therefore exactly the number that a user would write, such as
// 0.01.
double millimetres_of(Unit unit) { return unit == Unit::metre ? 1000 : unit == Unit::centimetre ? 10 : 1; }

bool is_about(double a, double b) { return std::abs(a - b) <= 1e-9 * b; }

}  // namespace

const std::vector<std::string> &unit_names() {
  static const std::vector<std::string> names = {"m", "cm", "mm"};
  return names;
}

const char *name_of(Unit unit) { return unit_names()[static_cast<std::size_t>(unit)].c_str(); }

const char *words_of(Unit unit) {
  return unit == Unit::metre ? "metres" : unit == Unit::centimetre ? "centimetres" : "millimetres";
}

std::optional<Unit> unit_of(const std::string &name) {
  for (const Unit unit : all_units)
    if (name == name_of(unit)) return unit;
  return std::nullopt;
}

double factor_between(Unit from, Unit to) { return millimetres_of(from) / millimetres_of(to); }

double paper_half_thickness(Unit unit) { return 1 / millimetres_of(unit); }

std::optional<Unit> unit_reached(Unit from, double factor) {
  for (const Unit to : all_units)
    if (is_about(factor, factor_between(from, to))) return to;
  return std::nullopt;
}

std::optional<UnitPair> units_of_factor(double factor) {
  for (const Unit surface : all_units)
    for (const Unit mesh : all_units)
      if (surface != mesh && is_about(factor, factor_between(surface, mesh))) return UnitPair{surface, mesh};
  return std::nullopt;
}

std::optional<Unit> unit_of_valve(double largest_side) {
  for (const Unit unit : all_units) {
    const double centimetres = largest_side * factor_between(unit, Unit::centimetre);
    if (centimetres >= 1.2 && centimetres < 12) return unit;
  }
  return std::nullopt;
}

namespace {

// A unit fits if it puts the vessel's width between the least and the largest width. The middle one of the mesh's three sides
// must be above the least width, because a valve is no wider than its vessel. The shortest side must be below the largest width,
// because a vessel is not much wider than its valve. Both widths are multiples of the valve's largest side. The two widths differ
// by a factor of ten, so two units seldom fit.
constexpr double least_width = 0.4, largest_width = 4;
// If a mesh's edges are longer than this share of the valve's largest side, the mesh cannot show the valve.
constexpr double longest_edge = 0.3;
// In a mesh that was made for the default half thickness, edges are usually at most this number of half thicknesses long.
constexpr double usual_edge = 3;
// Near the valve, edges are usually at least this number of half thicknesses long.
constexpr double shortest_edge = 0.3;
// Edges above the limit show that the mesh was made for another valve. With the default half thickness, the limit is `most_edge`
// half thicknesses. Otherwise the limit is the share `most_edge_of_valve` of the valve's largest side.
constexpr double most_edge = 10, most_edge_of_valve = 0.4;
// The least half thickness, as a share of the mesh's edge length. A thinner band fits between two layers of nodes, and contains
// few nodes.
constexpr double smallest_half_thickness = 0.3;
// A unit is impossible if it makes the vessel much too narrow or much too wide. The limit for wide vessels is larger than the
// limit for narrow vessels, because a valve may stand in a wide basin.
constexpr double most_too_narrow = 1.5, most_too_wide = 10;
// The oddity of a unit tells how unlikely the unit is. The oddity is a product of ratios, which are all at least 1. A unit is
// possible if its oddity is at most this factor times the oddity of the likeliest unit.
constexpr double most_odd = 2.7;
// In a wide basin, the present unit is right if the oddity of every other unit is larger by this factor.
constexpr double surely_odder = 1.35;

double excess(double ratio) { return std::max(ratio, 1.0); }

double narrowness_at(double factor, const Sizes &s) {
  return excess(least_width * s.surface.largest_side() / (factor * s.mesh_sides[1]));
}

double wideness_at(double factor, const Sizes &s) {
  return excess(factor * s.mesh_sides[2] / (largest_width * s.surface.largest_side()));
}

// Returns the oddity of the sizes after the mesh's lengths are multiplied by the factor. A default half thickness is in the
// valve's unit, so the mesh's edges may be too long or too short for this half thickness.
double oddity_at(double factor, const Sizes &s, double edge) {
  double oddity = narrowness_at(factor, s) * wideness_at(factor, s) *
                  excess(factor * edge / (longest_edge * s.surface.largest_side()));
  if (s.has_usual_half && edge > 0)
    oddity *= excess(factor * edge / (usual_edge * s.half_thickness)) *
              excess(shortest_edge * s.half_thickness / (factor * edge));
  return oddity;
}

// Returns the eigenvalues of a symmetric matrix with the elements xx, yy, zz, xy, xz, yz. The largest is the first.
std::array<double, 3> eigenvalues_of(const std::array<double, 6> &m) {
  const double mean = (m[0] + m[1] + m[2]) / 3;
  const double x = m[0] - mean, y = m[1] - mean, z = m[2] - mean;
  const double size = std::sqrt((x * x + y * y + z * z + 2 * (m[3] * m[3] + m[4] * m[4] + m[5] * m[5])) / 6);
  if (size == 0) return {mean, mean, mean};
  const double determinant =
      x * (y * z - m[5] * m[5]) - m[3] * (m[3] * z - m[5] * m[4]) + m[4] * (m[3] * m[5] - y * m[4]);
  const double turn = arc_cosine(std::clamp(determinant / (2 * size * size * size), -1.0, 1.0)) / 3;
  const double first = mean + 2 * size * sine_cosine(turn).cosine;
  const double last = mean + 2 * size * sine_cosine(turn + 2 * pi / 3).cosine;
  return {first, 3 * mean - first - last, last};
}

}  // namespace

bool is_too_large(double half_thickness, const Sizes &s) {
  return half_thickness > largest_half_thickness * s.surface.largest_side();
}

bool is_too_small(double half_thickness, const Sizes &s) {
  return half_thickness < smallest_half_thickness * s.median_edge;
}

UnitJudgement judge_units(const Sizes &s, const std::vector<double> &factors) {
  UnitJudgement judgement{is_as_wide(s, 1), {1}};
  std::vector<double> &possible = judgement.factors;
  possible.insert(possible.end(), factors.begin(), factors.end());
  std::sort(possible.begin(), possible.end());
  possible.erase(std::unique(possible.begin(), possible.end()), possible.end());
  const auto is_impossible = [&](double factor) {
    return narrowness_at(factor, s) > most_too_narrow || wideness_at(factor, s) > most_too_wide;
  };
  possible.erase(std::remove_if(possible.begin(), possible.end(), is_impossible), possible.end());
  if (narrowness_at(1, s) == 1 && judgement.is_possible(1)) {
    // A basin may have long edges everywhere except near the valve.
    const double edge = s.near_edge > 0 ? std::min(s.near_edge, s.median_edge) : s.median_edge;
    judgement.is_right |= s.is_unit_known || std::all_of(possible.begin(), possible.end(), [&](double factor) {
                            return factor == 1 || oddity_at(factor, s, edge) >= oddity_at(1, s, edge) * surely_odder;
                          });
  }
  const auto oddity = [&](double factor) { return oddity_at(factor, s, s.median_edge); };
  std::stable_sort(possible.begin(), possible.end(), [&](double a, double b) { return oddity(a) < oddity(b); });
  const double least = possible.empty() ? 0 : oddity(possible.front());
  const double longest =
      s.has_usual_half ? most_edge * s.half_thickness : most_edge_of_valve * s.surface.largest_side();
  const auto is_unlikely = [&](double factor) {
    return is_about(factor, s.unnamed_factor) ? factor * s.median_edge > longest * (1 + 1e-6)
                                              : oddity(factor) > least * most_odd;
  };
  possible.erase(std::remove_if(possible.begin(), possible.end(), is_unlikely), possible.end());
  return judgement;
}

bool is_as_wide(const Sizes &s, double factor) { return narrowness_at(factor, s) == 1 && wideness_at(factor, s) == 1; }

const std::vector<double> &unit_factors() {
  static const std::vector<double> all = {0.1, 10, 0.01, 100, 0.001, 1000};
  return all;
}

void Moments::add(const double *p) {
  n += 1;
  for (int k = 0; k < 3; ++k) {
    sum[k] += p[k];
    squares[k] += p[k] * p[k];
  }
  squares[3] += p[0] * p[1];
  squares[4] += p[0] * p[2];
  squares[5] += p[1] * p[2];
}

void Moments::add(const Moments &other) {
  n += other.n;
  for (int k = 0; k < 3; ++k) sum[k] += other.sum[k];
  for (int k = 0; k < 6; ++k) squares[k] += other.squares[k];
}

std::array<double, 3> sides_of(const Box &box, const Moments &moments) {
  std::array<double, 3> sides{};
  for (std::size_t k = 0; k < 3; ++k) sides[k] = box.upper[k] - box.lower[k];
  std::sort(sides.begin(), sides.end(), std::greater<>());
  if (moments.n == 0) return sides;
  const double mean[3] = {moments.sum[0] / moments.n, moments.sum[1] / moments.n, moments.sum[2] / moments.n};
  std::array<double, 6> matrix{};
  constexpr int row[6] = {0, 1, 2, 0, 0, 1}, column[6] = {0, 1, 2, 1, 2, 2};
  for (std::size_t k = 0; k < 6; ++k) matrix[k] = moments.squares[k] / moments.n - mean[row[k]] * mean[column[k]];
  // The moment of a disc is a sixteenth of the square of its diameter.
  const std::array<double, 3> roots = eigenvalues_of(matrix);
  for (std::size_t k = 0; k < 3; ++k) sides[k] = std::min(sides[k], 4 * std::sqrt(std::max(roots[k], 0.0)));
  return sides;
}

Sizes rescaled(const Sizes &s, double factor) {
  Sizes changed = s;
  for (int k = 0; k < 3; ++k) {
    changed.surface.lower[k] /= factor;
    changed.surface.upper[k] /= factor;
  }
  return changed;
}

double better_half_thickness(const Sizes &s) {
  const auto fits = [&](double half_thickness) {
    return !is_too_large(half_thickness, s) && !is_too_small(half_thickness, s);
  };
  const double usual = usual_half_thickness * s.surface.largest_side();
  const auto distance = [&](double half_thickness) {
    return excess(half_thickness / usual) * excess(usual / half_thickness);
  };
  double best = 0;
  for (const double factor : unit_factors()) {
    const double candidate = s.half_thickness * factor;
    if (!fits(candidate)) continue;
    if (best == 0 || distance(candidate) < distance(best)) best = candidate;
  }
  if (best != 0) return best;
  return s.median_edge > 0 && fits(s.median_edge) ? s.median_edge : 0;
}

}  // namespace riis::program
