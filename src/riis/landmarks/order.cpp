// SPDX-License-Identifier: Apache-2.0
#include "landmarks/order.hpp"

#include <riis/riis.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "base/errors.hpp"
#include "common/elementary.hpp"
#include "landmarks/fit.hpp"

namespace riis {
namespace {

// Joins the names to one text, such as "right, left and non_coronary".
std::string listed(const std::vector<std::string> &names) {
  std::string text = names[0];
  for (std::size_t k = 1; k < names.size(); ++k) text += (k + 1 < names.size() ? ", " : " and ") + names[k];
  return text;
}

const std::string &name_of(const LeafletsAround &leaflets, std::int32_t leaflet_id) {
  return leaflets.names[static_cast<std::size_t>(leaflet_id)];
}

// Returns whether a landmark's leaflet ids, if it has any, agree with its position in the order.
bool fits_nadir(const Landmark &landmark, std::size_t leaflet) {
  return landmark.leaflet_ids[0] == -1 || landmark.leaflet_ids[0] == static_cast<std::int32_t>(leaflet);
}
bool fits_commissure(const Landmark &landmark, std::size_t leaflet, std::size_t next) {
  const auto &[first, second] = landmark.leaflet_ids;
  const auto a = static_cast<std::int32_t>(leaflet), b = static_cast<std::int32_t>(next);
  return first == -1 || (first == a && second == b) || (first == b && second == a);
}
bool fits(const Landmarks &landmarks, const LeafletsAround &leaflets, const Order &order) {
  for (std::size_t k = 0; k < order.nadir.size(); ++k)
    if (!fits_nadir(landmarks.list[order.nadir[k]], k)) return false;
  for (std::size_t k = 0; k < leaflets.n(); ++k)
    if (!fits_commissure(landmarks.list[order.commissure[k]], k, leaflets.next(k))) return false;
  return true;
}

std::vector<std::size_t> rotated(std::vector<std::size_t> numbers, std::size_t by) {
  if (!numbers.empty()) std::rotate(numbers.begin(), numbers.begin() + static_cast<std::ptrdiff_t>(by), numbers.end());
  return numbers;
}
Order rotated(const Order &order, std::size_t by) { return {rotated(order.nadir, by), rotated(order.commissure, by)}; }

// Returns the order in the opposite direction about the axis. A commissure that came before a leaflet in the given order now
// comes after it.
Order mirrored(Order order) {
  if (!order.nadir.empty()) std::reverse(order.nadir.begin() + 1, order.nadir.end());
  std::reverse(order.commissure.begin(), order.commissure.end());
  return order;
}

// Returns the landmarks in the order of their angles about the axis. Refuses commissures and nadirs that do not alternate.
Order turn_of(const Landmarks &landmarks, Vec3 axis, Vec3 middle) {
  struct Seen {
    double angle;
    std::size_t landmark;
  };
  const auto nadirs = landmarks.with_role(RIIS_LANDMARK_NADIR),
             commissures = landmarks.with_role(RIIS_LANDMARK_COMMISSURE);
  const std::size_t start = nadirs.empty() ? commissures[0] : nadirs[0];
  const Rotation back = transposed(rotation_to(landmarks.at(start) - middle, axis));
  std::vector<Seen> seen;
  for (const auto *list : {&nadirs, &commissures})
    for (const std::size_t i : *list) {
      const Vec3 p = back * (landmarks.at(i) - middle);
      const double angle = arc_tangent(p.y, p.x);
      seen.push_back({i == start ? 0 : angle < 0 ? angle + 2 * pi : angle, i});
    }
  std::sort(seen.begin(), seen.end(), [](const Seen &a, const Seen &b) {
    return a.angle != b.angle ? a.angle < b.angle : a.landmark < b.landmark;
  });
  Order order{};
  for (std::size_t k = 0; k < seen.size(); ++k) {
    const std::size_t i = seen[k].landmark;
    const bool is_nadir = landmarks.list[i].role == RIIS_LANDMARK_NADIR;
    if (!nadirs.empty() && is_nadir != (k % 2 == 0))
      fail(RIIS_INVALID_ARGUMENT, words_for(landmarks, seen[k - 1].landmark), " and ", words_for(landmarks, i),
           " follow each other around the valve; commissures and nadirs must alternate");
    (is_nadir ? order.nadir : order.commissure).push_back(i);
  }
  return order;
}

// Returns whether the names would fit if the order began at another leaflet.
bool fits_turned(const Landmarks &landmarks, const LeafletsAround &leaflets, const Order &turn) {
  for (std::size_t by = 0; by < leaflets.n(); ++by)
    if (fits(landmarks, leaflets, rotated(turn, by))) return true;
  return false;
}

// Looks for two landmarks whose names were exchanged: if they are changed back, all names fit. If there is exactly one such pair,
// fails with a message about this pair.
void refuse_exchanged(Landmarks landmarks, const LeafletsAround &leaflets, const Order &turn) {
  std::vector<std::array<std::size_t, 2>> found;
  for (std::size_t i = 0; i < landmarks.list.size(); ++i)
    for (std::size_t j = i + 1; j < landmarks.list.size(); ++j) {
      Landmark &a = landmarks.list[i], &b = landmarks.list[j];
      if (a.role != b.role || (a.role != RIIS_LANDMARK_NADIR && a.role != RIIS_LANDMARK_COMMISSURE)) continue;
      if (a.leaflet_ids[0] == -1 || b.leaflet_ids[0] == -1) continue;  // a landmark without a name
      std::swap(a.leaflet_ids, b.leaflet_ids);
      if (fits_turned(landmarks, leaflets, turn)) found.push_back({i, j});
      std::swap(a.leaflet_ids, b.leaflet_ids);
    }
  if (found.size() == 1)
    fail(RIIS_INVALID_ARGUMENT, "landmarks.leaflet_id of ", words_for(landmarks, found[0][0]), " and that of ",
         words_for(landmarks, found[0][1]), " are exchanged: all names fit if these two change places");
}

// Fails with a message about the first landmark whose leaflet ids do not fit the order.
[[noreturn]] void refuse_names(const Landmarks &landmarks, const LeafletsAround &leaflets, const Order &order) {
  for (std::size_t k = 0; k < leaflets.n(); ++k) {
    if (!order.nadir.empty() && !fits_nadir(landmarks.list[order.nadir[k]], k))
      fail(RIIS_INVALID_ARGUMENT, "landmarks.leaflet_id of ", words_for(landmarks, order.nadir[k]), " says ",
           name_of(leaflets, landmarks.list[order.nadir[k]].leaflet_ids[0]),
           ", but the other landmarks' names say that it is of the ", leaflets.names[k], " cusp");
    const std::size_t c = order.commissure[k];
    const auto &[first, second] = landmarks.list[c].leaflet_ids;
    if (!fits_commissure(landmarks.list[c], k, leaflets.next(k)))
      fail(RIIS_INVALID_ARGUMENT, "landmarks.leaflet_id of ", words_for(landmarks, c), " says ",
           name_of(leaflets, first), " and ", name_of(leaflets, second), ", but it is between ", leaflets.names[k],
           " and ", leaflets.names[leaflets.next(k)]);
  }
  fail(RIIS_INTERNAL_ERROR, "the names of the landmarks fit, although they were refused");
}

}  // namespace

void check_leaflet_ids(const Landmarks &landmarks, const LeafletsAround &leaflets) {
  for (std::size_t i = 0; i < landmarks.list.size(); ++i) {
    const auto &[first, second] = landmarks.list[i].leaflet_ids;
    const bool is_commissure = landmarks.list[i].role == RIIS_LANDMARK_COMMISSURE;
    for (const std::int32_t id : {first, second})
      if (id < -1 || id >= static_cast<std::int32_t>(leaflets.n())) {
        std::string known;
        for (std::size_t k = 0; k < leaflets.n(); ++k) known += std::to_string(k) + " (" + leaflets.names[k] + "), ";
        known.resize(known.size() - 2);
        fail(RIIS_INVALID_ARGUMENT, "landmarks.leaflet_id of ", words_for(landmarks, i), " is ", id, "; it must be ",
             known, " or -1");
      }
    if (is_commissure ? (first == -1) != (second == -1) || (first != -1 && first == second) : second != -1)
      fail(RIIS_INVALID_ARGUMENT, "landmarks.leaflet_id of ", words_for(landmarks, i), " is ", first, " and ", second,
           is_commissure ? "; a commissure has two different leaflets, or -1 and -1"
                         : "; only a commissure has two leaflets");
  }
}

bool names_fit(const Landmarks &landmarks, const LeafletsAround &leaflets, Vec3 axis, Vec3 middle) {
  return fits_turned(landmarks, leaflets, turn_of(landmarks, axis, middle));
}

// The names of the leaflets decide at which leaflet the order begins.
Order order_around(const Landmarks &landmarks, const LeafletsAround &leaflets, Vec3 axis, Vec3 middle) {
  const Order turn = turn_of(landmarks, axis, middle);
  const std::size_t n = leaflets.n();
  std::size_t n_fitting = 0, fitting = 0;
  for (std::size_t by = n; by-- > 0;)
    if (fits(landmarks, leaflets, rotated(turn, by))) {
      ++n_fitting;
      fitting = by;
    }
  if (n_fitting == 1 || (n_fitting > 1 && !leaflets.why_names)) return rotated(turn, fitting);
  if (n_fitting > 1) fail(RIIS_INVALID_ARGUMENT, "landmarks.leaflet_id does not say ", leaflets.why_names);
  for (std::size_t by = 0; by < n; ++by)
    if (fits(landmarks, leaflets, mirrored(rotated(turn, by)))) {
      const std::string must = leaflets.seen_along_flow, are = must == "clockwise" ? "counter-clockwise" : "clockwise";
      fail(RIIS_INVALID_ARGUMENT, "landmarks.leaflet_id: seen along the flow, ", listed(leaflets.names),
           " follow each other ", are, ", but they must follow ", must, ": the landmarks or their names are mirrored");
    }
  refuse_exchanged(landmarks, leaflets, turn);
  for (std::size_t by = 0; by < n && !turn.nadir.empty(); ++by)
    if (landmarks.list[rotated(turn, by).nadir[0]].leaflet_ids[0] == 0)
      refuse_names(landmarks, leaflets, rotated(turn, by));
  refuse_names(landmarks, leaflets, turn);
}

}  // namespace riis
