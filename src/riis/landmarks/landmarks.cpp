// SPDX-License-Identifier: Apache-2.0
#include "landmarks/landmarks.hpp"

#include <riis/riis.h>

#include <algorithm>
#include <cmath>
#include <initializer_list>

#include "base/errors.hpp"
#include "common/array_view.hpp"
#include "landmarks/fit.hpp"

namespace riis {
namespace {

// The smallest and the largest mean distance of a heart valve's landmarks from their middle, in centimetres. The range covers
// a newborn's aortic valve and a dilated mitral annulus, with room on both sides.
constexpr double least_size = 0.2, largest_size = 4;

struct LengthUnit {
  const char *name;
  double scale;  // units in a centimetre
};
constexpr LengthUnit units[] = {{"metres", 0.01}, {"centimetres", 1}, {"millimetres", 10}};

// Returns " (millimetres)" for the scale 10, or "" if the scale belongs to no usual unit.
std::string unit_in_brackets(double scale) {
  for (const LengthUnit &unit : units)
    if (std::abs(scale - unit.scale) <= 1e-9 * unit.scale) return std::string(" (") + unit.name + ")";
  return "";
}

// Two landmarks count as one place if their distance is at most `same_place`, in centimetres.
constexpr double same_place = 1e-4;

// For two landmarks in the same place, returns whether `a` makes `b` superfluous for the fit.
bool implies(const Landmark &a, const Landmark &b) {
  const auto is_one_of = [&](std::initializer_list<std::int32_t> roles) {
    return std::find(roles.begin(), roles.end(), a.role) != roles.end();
  };
  if (b.role == RIIS_LANDMARK_ANNULUS)
    return is_one_of({RIIS_LANDMARK_ANNULUS, RIIS_LANDMARK_ANTERIOR_HORN, RIIS_LANDMARK_POSTERIOR_HORN,
                      RIIS_LANDMARK_TRIGONE, RIIS_LANDMARK_POSTEROMEDIAL, RIIS_LANDMARK_ANTEROLATERAL,
                      RIIS_LANDMARK_COMMISSURE});
  if (b.role != RIIS_LANDMARK_ATTACHMENT) return false;
  const bool is_of_leaflet =
      b.leaflet_ids[0] == -1 || a.leaflet_ids[0] == b.leaflet_ids[0] || a.leaflet_ids[1] == b.leaflet_ids[0];
  return is_of_leaflet && is_one_of({RIIS_LANDMARK_ATTACHMENT, RIIS_LANDMARK_NADIR, RIIS_LANDMARK_COMMISSURE});
}

// The least width of the landmarks, as a share of their length.
constexpr double least_width = 0.05;

}  // namespace

std::vector<std::size_t> Landmarks::with_role(std::int32_t role) const {
  std::vector<std::size_t> numbers;
  for (std::size_t i = 0; i < list.size(); ++i) {
    const std::optional<std::size_t> other = list[i].repeated;
    if (list[i].role == role && !(other && list[*other].role == role)) numbers.push_back(i);
  }
  return numbers;
}

void find_repeated(std::vector<Landmark> &list) {
  for (std::size_t i = 0; i < list.size(); ++i)
    for (std::size_t k = 0; k < list.size(); ++k) {
      if (k == i || distance(list[i].point, list[k].point) > same_place || !implies(list[k], list[i])) continue;
      if (implies(list[i], list[k]) && i < k) continue;
      list[i].repeated = k;
      break;
    }
  for (Landmark &landmark : list)
    while (landmark.repeated && list[*landmark.repeated].repeated)
      landmark.repeated = list[*landmark.repeated].repeated;
}

Vec3 Landmarks::mean_of(const std::vector<std::size_t> &numbers) const {
  Vec3 sum{0, 0, 0};
  for (const std::size_t i : numbers) sum = sum + at(i);
  return (1.0 / static_cast<double>(numbers.size())) * sum;
}

const char *role_name(std::int32_t role) {
  static const char *const names[n_roles] = {"commissure",
                                             "nadir",
                                             "coaptation",
                                             "annulus",
                                             "anterior_horn",
                                             "posterior_horn",
                                             "trigone",
                                             "posteromedial_commissure",
                                             "anterolateral_commissure",
                                             "hinge",
                                             "attachment"};
  return view(names)[role];
}

std::string words_for(const Landmarks &landmarks, std::size_t i) {
  return "landmark " + std::to_string(i) + " (" + role_name(landmarks.list[i].role) + ")";
}

void check_unit(const Landmarks &landmarks) {
  if (landmarks.list.size() < 2) return;  // one landmark has no size; a later check asks for more landmarks
  double size = 0;
  for (const Landmark &landmark : landmarks.list)
    size += length(landmark.point) / static_cast<double>(landmarks.list.size());
  if (size >= least_size && size <= largest_size) return;
  std::string other;
  for (const LengthUnit &unit : units) {
    const double centimetres = size * landmarks.scale / unit.scale;
    if (centimetres < least_size || centimetres > largest_size || !other.empty()) continue;
    other = std::string("; in ") + unit.name + ", scale " + Message(unit.scale).text() + ", this would be " +
            Message(rounded(centimetres, 3)).text() + " cm";
  }
  fail(RIIS_INVALID_ARGUMENT, "landmarks.scale is ", landmarks.scale, unit_in_brackets(landmarks.scale),
       ": the landmarks' mean distance from their middle is then ", rounded(size, 3),
       " cm, and a heart valve's is from ", least_size, " to ", largest_size, " cm", other);
}

void check_roles(const Landmarks &landmarks, const char *kind, const std::vector<std::int32_t> &roles) {
  for (std::size_t i = 0; i < landmarks.list.size(); ++i)
    if (std::find(roles.begin(), roles.end(), landmarks.list[i].role) == roles.end()) {
      std::string allowed;
      for (const std::int32_t role : roles) allowed += (allowed.empty() ? "" : ", ") + std::string(role_name(role));
      fail(RIIS_INVALID_ARGUMENT, words_for(landmarks, i), " has a role that the ", kind,
           " valve lacks; its roles are ", allowed);
    }
}

void check_count(const Landmarks &landmarks, const char *kind, std::int32_t role, std::size_t least, std::size_t most) {
  const std::size_t n = landmarks.count(role);
  if (n >= least && (most == 0 || n <= most)) return;
  std::string needs = std::to_string(least);
  if (most == 0)
    needs += " or more";
  else if (most != least)
    needs = least == 0 ? "at most " + std::to_string(most) : needs + " to " + std::to_string(most);
  fail(RIIS_INVALID_ARGUMENT, "landmarks.role has the ", role_name(role), " ", n, n == 1 ? " time" : " times", "; the ",
       kind, " valve needs ", needs);
}

Spread spread_of(const Landmarks &landmarks, const std::vector<std::size_t> &numbers) {
  const Vec3 mean = landmarks.mean_of(numbers);
  std::vector<double> moments(9);
  for (const std::size_t i : numbers) {
    const Vec3 d = landmarks.at(i) - mean;
    const double parts[3] = {d.x, d.y, d.z};
    for (std::size_t j = 0; j < 3; ++j)
      for (std::size_t k = 0; k < 3; ++k)
        moments[3 * j + k] += parts[j] * parts[k] / static_cast<double>(numbers.size());
  }
  const Eigen eigen = symmetric_eigen(moments, 3);
  Spread spread{};
  for (std::size_t k = 0; k < 3; ++k) {
    const double *v = eigen.vectors.data() + 3 * (2 - k);
    spread.direction[k] = {v[0], v[1], v[2]};
    spread.deviation[k] = std::sqrt(std::max(0.0, eigen.values[2 - k]));
  }
  return spread;
}

void check_apart(const Landmarks &landmarks, const std::vector<std::size_t> &numbers, double share) {
  const Spread spread = spread_of(landmarks, numbers);
  for (std::size_t i = 0; i < numbers.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) {
      const double apart = distance(landmarks.at(numbers[i]), landmarks.at(numbers[j]));
      if (apart <= share * spread.deviation[0])
        fail(RIIS_INVALID_ARGUMENT, words_for(landmarks, numbers[j]), " and ", words_for(landmarks, numbers[i]),
             " are in one place: ", rounded(landmarks.scale * apart, 3),
             " apart, but two landmarks of this valve must be more than ",
             rounded(landmarks.scale * share * spread.deviation[0], 3), " apart");
    }
}

void check_not_collinear(const Landmarks &landmarks, const std::vector<std::size_t> &numbers) {
  const Spread spread = spread_of(landmarks, numbers);
  if (!(spread.deviation[1] > least_width * spread.deviation[0]))
    fail(RIIS_INVALID_ARGUMENT, "the landmarks lie along a line: their standard deviation is ",
         landmarks.scale * spread.deviation[0], " along it and ", rounded(landmarks.scale * spread.deviation[1], 3),
         " across it; the landmarks must not be collinear");
}

void check_spread(const Landmarks &landmarks, const std::vector<std::size_t> &numbers, double share) {
  check_apart(landmarks, numbers, share);
  check_not_collinear(landmarks, numbers);
}

}  // namespace riis
