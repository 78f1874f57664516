// SPDX-License-Identifier: Apache-2.0
// Landmarks of a patient, the checks of them that are common to all kinds of valves, and the placed valve.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "geometry/vec3.hpp"
#include "valve/valve.hpp"

namespace riis {

struct Landmark {
  Vec3 point;                               // in centimetres, relative to the mean of all landmarks
  std::int32_t role;                        // RIIS_LANDMARK_*
  std::array<std::int32_t, 2> leaflet_ids;  // -1: not given
  // Another landmark in the same place that makes this landmark superfluous. For example, a horn makes a point of the annulus in
  // the same place superfluous.
  std::optional<std::size_t> repeated = std::nullopt;
};

struct Landmarks {
  std::vector<Landmark> list;
  Vec3 mean;       // mean of all landmarks, in mesh units
  double scale;    // mesh units in a centimetre
  double noise;    // centimetres
  bool has_noise;  // whether the caller stated it
  Vec3 flow;       // unit vector, or 0 if unknown

  bool has_flow() const { return !(flow == Vec3{0, 0, 0}); }
  // Returns the numbers of the landmarks that have this role, in ascending order. Leaves out landmarks that repeat another
  // landmark of this role.
  std::vector<std::size_t> with_role(std::int32_t role) const;
  std::size_t count(std::int32_t role) const { return with_role(role).size(); }
  Vec3 at(std::size_t i) const { return list[i].point; }
  Vec3 mean_of(const std::vector<std::size_t> &numbers) const;
};

// Finds the landmarks that repeat other landmarks.
void find_repeated(std::vector<Landmark> &list);

// Returns the name of a role, such as "nadir".
const char *role_name(std::int32_t role);
constexpr std::int32_t n_roles = 11;
// Returns the words for a landmark in messages, such as "landmark 3 (nadir)".
std::string words_for(const Landmarks &landmarks, std::size_t i);

// All checks below fail with RIIS_INVALID_ARGUMENT, and their messages name the landmarks.

// Refuses landmarks whose mean distance from their middle is too small or too large for a heart valve. The message also states
// this distance in other units.
void check_unit(const Landmarks &landmarks);
// Refuses a landmark whose role is not one of `roles`. `roles` contains the roles that this kind of valve uses.
void check_roles(const Landmarks &landmarks, const char *kind, const std::vector<std::int32_t> &roles);
// Checks that the number of landmarks with this role is in range. If there is no upper limit, `most` is 0.
void check_count(const Landmarks &landmarks, const char *kind, std::int32_t role, std::size_t least, std::size_t most);
// Refuses two landmarks of the list whose distance is less than `share` times the spread of the list.
void check_apart(const Landmarks &landmarks, const std::vector<std::size_t> &numbers, double share);
// Refuses landmarks along one line.
void check_not_collinear(const Landmarks &landmarks, const std::vector<std::size_t> &numbers);
// Calls check_apart and check_not_collinear.
void check_spread(const Landmarks &landmarks, const std::vector<std::size_t> &numbers, double share);

// The principal directions of points about their mean, and the standard deviations along these directions, the largest first.
struct Spread {
  std::array<Vec3, 3> direction;
  std::array<double, 3> deviation;
};
Spread spread_of(const Landmarks &landmarks, const std::vector<std::size_t> &numbers);

// place_valve sets a valve's sizes from a patient's landmarks, and finds its placement (docs/theory/landmarks.md). Another valve,
// the template, gives the proportions. The result is the patient's valve, its placement and the residuals.

struct PlacedValve {
  Valve valve;
  double scale;
  Vec3 rotation_axis;
  double rotation_angle;          // degrees
  Vec3 translation;               // mesh units
  std::vector<double> residuals;  // residuals of the landmarks, mesh units
  std::vector<Vec3> places;       // the landmarks' places on the closed valve, mesh units
  double noise;                   // the noise from which the standard errors follow, mesh units
  double rotation_error;          // degrees
  double position_error;          // standard error of the valve's origin, mesh units
  // One entry for each parameter of the kind.
  std::vector<std::int32_t> size_state;  // RIIS_SIZE_*
  std::vector<double> standard_error;    // infinite for RIIS_SIZE_TIED, 0 for RIIS_SIZE_KEPT
  std::int32_t n_as_annulus = 0;         // trigones that count as points of the annulus
};

// `held` names the sizes that stay as they are in `valve`, with blanks or commas between the names.
PlacedValve place_valve(const Valve &valve, const Landmarks &landmarks, std::string_view held);

}  // namespace riis
