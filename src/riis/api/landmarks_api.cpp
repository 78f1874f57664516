// SPDX-License-Identifier: Apache-2.0
// Checks the arguments of riis_place. The work is in landmarks/.
#include <algorithm>
#include <cmath>

#include "api/handles.hpp"
#include "api/structs.hpp"
#include "base/errors.hpp"
#include "base/integer_array.hpp"
#include "geometry/strided.hpp"
#include "landmarks/landmarks.hpp"

using riis::guarded_with_handles;
using riis::require;
using riis::require_handle;

namespace {

constexpr std::int64_t most_landmarks = 10000;
// The standard deviation of repeated readings of a landmark, in centimetres.
constexpr double usual_noise = 0.03;

const riis_landmarks default_landmarks{
    sizeof(riis_landmarks), 0, nullptr, nullptr, nullptr, 1, nullptr, nullptr, RIIS_AUTO, RIIS_AUTO, {0, 0, 0}, 64, 0};

const riis_placement_arrays default_placement_arrays{sizeof(riis_placement_arrays), nullptr, nullptr, nullptr, nullptr};

riis::Landmarks landmarks_of(const riis_landmarks &given) {
  if (given.n_landmarks < 1 || given.n_landmarks > most_landmarks)
    riis::fail(RIIS_INVALID_ARGUMENT, "landmarks.n_landmarks is ", given.n_landmarks, "; it must be from 1 to ",
               most_landmarks);
  riis::check_bits("landmarks.real_bits", given.real_bits);
  riis::check_reserved("landmarks.reserved", given.reserved);
  require(given.role, "landmarks.role");
  if (given.scale == RIIS_AUTO)
    riis::fail(RIIS_INVALID_ARGUMENT,
               "landmarks.scale is not set; it is 10 for landmarks in millimetres, 1 in centimetres, 0.01 in metres");
  riis::check_range("landmarks", "scale", given.scale, 1e-12, 1e12);
  if (given.noise != RIIS_AUTO) riis::check_range("landmarks", "noise", given.noise, 0, 1e50);
  riis::Landmarks made{{}, {0, 0, 0}, given.scale, usual_noise, given.noise != RIIS_AUTO, {0, 0, 0}};
  if (made.has_noise) made.noise = given.noise / given.scale;
  const riis::Vec3 flow{given.flow[0], given.flow[1], given.flow[2]};
  if (!riis::is_usable(flow))
    riis::fail(RIIS_INVALID_ARGUMENT, "landmarks.flow is ", flow.x, " ", flow.y, " ", flow.z,
               "; it must be finite and at most ", riis::max_coordinate);
  const double largest = riis::largest_coordinate(flow);
  if (largest > 0) {
    const riis::Vec3 even{flow.x / largest, flow.y / largest, flow.z / largest};
    made.flow = (1 / length(even)) * even;
  }
  std::vector<riis::Vec3> points;
  riis::with_points(given.n_landmarks, {given.x, given.y, given.z}, given.stride, given.real_bits,
                    [&](const auto &from) {
                      riis::check_points(from, "landmark", RIIS_INVALID_ARGUMENT, "landmarks.");
                      for (std::int64_t i = 0; i < given.n_landmarks; ++i) points.push_back(from[i]);
                    });
  const double n = static_cast<double>(given.n_landmarks);
  for (const riis::Vec3 &point : points) made.mean = made.mean + (1 / n) * point;
  for (std::int64_t i = 0; i < given.n_landmarks; ++i) {
    const std::int32_t role = given.role[i];
    if (role < 0 || role >= riis::n_roles)
      riis::fail(RIIS_INVALID_ARGUMENT, "landmarks.role of landmark ", i, " is ", role, "; it must be from 0 to ",
                 riis::n_roles - 1);
    const auto leaflet = [&](std::int64_t k) { return given.leaflet_id ? given.leaflet_id[2 * i + k] : -1; };
    made.list.push_back(
        {(1 / given.scale) * (points[static_cast<std::size_t>(i)] - made.mean), role, {leaflet(0), leaflet(1)}});
  }
  riis::find_repeated(made.list);
  return made;
}

}  // namespace

extern "C" {

RIIS_DEFINE_INIT(riis_landmarks_init, riis_landmarks, landmarks, default_landmarks)

RIIS_DEFINE_INIT(riis_placement_arrays_init, riis_placement_arrays, arrays, default_placement_arrays)

riis_status riis_place(riis_valve *valve, const riis_landmarks *landmarks, const char *held,
                       const riis_placement_arrays *arrays, riis_placement *placement, int64_t struct_size) {
  return guarded_with_handles([&] {
    require_handle(valve, "valve");
    const riis_landmarks whole = riis::completed(require(landmarks, "landmarks"), "landmarks", default_landmarks);
    require(held, "held");
    const riis_placement_arrays to = riis::completed(arrays, "arrays", default_placement_arrays);
    require(placement, "placement");
    riis::check_struct_size<riis_placement>(struct_size, "placement");
    riis::PlacedValve placed = riis::place_valve(valve->valve, landmarks_of(whole), held);
    double squares = 0;
    std::size_t worst = 0;
    for (std::size_t i = 0; i < placed.residuals.size(); ++i) {
      squares += placed.residuals[i] * placed.residuals[i];
      if (placed.residuals[i] > placed.residuals[worst]) worst = i;
    }
    const riis::Vec3 axis = placed.rotation_axis, shift = placed.translation;
    riis::write_struct(placement, struct_size, "placement",
                       riis_placement{placed.scale,
                                      {axis.x, axis.y, axis.z},
                                      placed.rotation_angle,
                                      {shift.x, shift.y, shift.z},
                                      std::sqrt(squares / static_cast<double>(placed.residuals.size())),
                                      placed.residuals[worst],
                                      placed.noise,
                                      placed.rotation_error,
                                      placed.position_error,
                                      static_cast<std::int64_t>(worst),
                                      static_cast<std::int32_t>(std::count(
                                          placed.size_state.begin(), placed.size_state.end(), RIIS_SIZE_UNDETERMINED)),
                                      placed.n_as_annulus});
    if (to.residual) std::copy(placed.residuals.begin(), placed.residuals.end(), to.residual);
    if (to.standard_error) std::copy(placed.standard_error.begin(), placed.standard_error.end(), to.standard_error);
    if (to.size_state) std::copy(placed.size_state.begin(), placed.size_state.end(), to.size_state);
    if (to.place)
      for (std::size_t i = 0; i < placed.places.size(); ++i)
        riis::put_vector(to.place, static_cast<std::int64_t>(i), placed.places[i]);
    valve->valve = std::move(placed.valve);
  });
}
}
