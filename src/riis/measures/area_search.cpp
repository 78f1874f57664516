// SPDX-License-Identifier: Apache-2.0
#include "measures/area_search.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "common/elementary.hpp"

namespace riis {
namespace {

// An interval shorter than `shortest_interval` times the magnitude of its ends is not divided further.
constexpr double shortest_interval = 1e-13;
// The golden-section search shortens an interval to `extreme_interval` times its length. The area is flat at an extreme, so the
// relative error of the area is about the square of `extreme_interval`.
constexpr double extreme_interval = 1e-6;

}  // namespace

AreaSearch::AreaSearch(Area area, double from, double to, std::int32_t n_samples, bool grows) : area_(std::move(area)) {
  sample(from, to, n_samples, grows);
  if (points_.empty()) return;
  part();
  // Without the extremes, the search would miss areas between a sample and an extreme beside it. The extremes are therefore added
  // to the samples. The values at which to look for extremes are listed first, because each added extreme shifts the positions of
  // later points.
  std::vector<double> places;
  for (const Part &one : parts_) places.push_back(points_[one.last].value);
  for (const double place : {least().value, most().value}) places.push_back(place);
  std::sort(places.begin(), places.end());
  places.erase(std::unique(places.begin(), places.end()), places.end());
  for (const double place : places) {
    const auto is_before = [](const Point &point, double value) { return point.value < value; };
    const auto at = std::lower_bound(points_.begin(), points_.end(), place, is_before);
    add_extreme(static_cast<std::size_t>(at - points_.begin()));
  }
  part();
}

void AreaSearch::sample(double from, double to, std::int32_t n_samples, bool grows) {
  bool is_after_refused = false;
  for (std::int32_t i = 0; i < n_samples; ++i) {
    const double share = static_cast<double>(i) / (n_samples - 1);
    const double between = grows ? from * power_to_share(to / from, share) : (1 - share) * from + share * to;
    const double value = i == 0 ? from : i == n_samples - 1 ? to : between;
    if (const std::optional<double> area = area_(value)) {
      points_.push_back({value, *area});
      is_after_refused_.push_back(is_after_refused);
      is_after_refused = false;
    } else {
      ++n_refused_;
      is_after_refused = true;
    }
  }
}

// If the area here is larger or smaller than at both neighbours, finds the extreme area between them, and adds it to the points.
// Otherwise does nothing.
void AreaSearch::add_extreme(std::size_t at) {
  if (at == 0 || at + 1 == points_.size() || is_after_refused_[at] || is_after_refused_[at + 1]) return;
  const Point before = points_[at - 1], here = points_[at], after = points_[at + 1];
  const bool is_largest = here.area >= before.area && here.area >= after.area;
  if (!is_largest && !(here.area <= before.area && here.area <= after.area)) return;
  const auto is_better = [&](const Point &a, const Point &b) { return is_largest ? a.area > b.area : a.area < b.area; };
  const double golden = (std::sqrt(5.0) - 1) / 2;
  double low = before.value, high = after.value;
  const double shortest = extreme_interval * (high - low);
  bool is_refused = false;
  const auto point_at = [&](double value) -> Point {
    const std::optional<double> area = area_(value);
    is_refused = is_refused || !area;
    return {value, area.value_or(here.area)};
  };
  Point left = point_at(high - golden * (high - low)), right = point_at(low + golden * (high - low));
  Point best = here;
  while (!is_refused && high - low > shortest) {
    for (const Point &point : {left, right})
      if (is_better(point, best)) best = point;
    if (is_better(left, right)) {
      high = right.value;
      right = left;
      left = point_at(high - golden * (high - low));
    } else {
      low = left.value;
      left = right;
      right = point_at(low + golden * (high - low));
    }
  }
  if (is_refused || best.value == here.value) return;
  const std::size_t place = best.value < here.value ? at : at + 1;
  points_.insert(points_.begin() + static_cast<std::ptrdiff_t>(place), best);
  is_after_refused_.insert(is_after_refused_.begin() + static_cast<std::ptrdiff_t>(place), 0);
}

// Finds the least and the largest area. Divides the points into parts. A new part begins where the area begins to grow or to
// fall, and at each refused value.
void AreaSearch::part() {
  const auto has_less_area = [](const Point &a, const Point &b) { return a.area < b.area; };
  const auto begin = points_.begin(), end = points_.end();
  least_ = static_cast<std::size_t>(std::min_element(begin, end, has_less_area) - begin);
  most_ = static_cast<std::size_t>(std::max_element(begin, end, has_less_area) - begin);
  const double jump = largest_jump * most().area;
  parts_.clear();
  turns_.clear();
  std::size_t first = 0, low = 0, high = 0;  // the extremes since `first`
  int direction = 0;                         // 1 if the area grows, -1 if it falls, 0 if neither is known
  for (std::size_t i = 1; i < points_.size(); ++i) {
    if (is_after_refused_[i]) {
      parts_.push_back({first, i - 1});
      first = low = high = i;
      direction = 0;
      continue;
    }
    const double area = points_[i].area;
    if (area > points_[high].area) high = i;
    if (area < points_[low].area) low = i;
    const bool has_grown = area - points_[low].area > jump, has_fallen = points_[high].area - area > jump;
    if ((direction > 0 && has_fallen) || (direction < 0 && has_grown)) {
      const std::size_t turn = direction > 0 ? high : low;
      parts_.push_back({first, turn});
      turns_.push_back(points_[turn].value);
      first = turn;
      direction = -direction;
      (direction > 0 ? high : low) = i;
    } else if (direction == 0) {
      direction = has_grown ? 1 : has_fallen ? -1 : 0;
    }
    // While the area grows, the lowest point is sought only after the highest point so far. While the area falls, the highest
    // point is sought only after the lowest point so far.
    if (direction > 0) low = high;
    if (direction < 0) high = low;
  }
  parts_.push_back({first, points_.size() - 1});
}

std::optional<AreaSearch::Point> AreaSearch::find(double area, double near, double tolerance) const {
  std::optional<Point> best;
  for (const Part &one : parts_) {
    const std::optional<Point> found = in_part(one, area, near, tolerance);
    if (found && (!best || std::abs(found->value - near) < std::abs(best->value - near))) best = found;
  }
  return best;
}

std::optional<AreaSearch::Point> AreaSearch::in_part(const Part &part, double area, double near,
                                                     double tolerance) const {
  const auto is_it = [&](const Point &point) { return std::abs(point.area - area) <= tolerance * area; };
  std::optional<Point> best;
  const auto take = [&](const Point &point) {
    if (!best || std::abs(point.value - near) < std::abs(best->value - near)) best = point;
  };
  // Because the area may jump slightly, several intervals of the part may contain the area. These intervals are close together,
  // so only the nearest one is searched.
  std::size_t interval = part.last;
  for (std::size_t i = part.first; i <= part.last; ++i) {
    if (is_it(points_[i])) take(points_[i]);
    if (i == part.last) break;
    const double before = points_[i].area - area, after = points_[i + 1].area - area;
    if (!((before < 0 && after > 0) || (before > 0 && after < 0))) continue;
    const auto distance = [&](std::size_t at) {
      return std::max({points_[at].value - near, near - points_[at + 1].value, 0.0});
    };
    if (interval == part.last || distance(i) < distance(interval)) interval = i;
  }
  if (interval == part.last) return best;
  const Point end = points_[interval].value >= near ? points_[interval] : points_[interval + 1];
  if (best && std::abs(best->value - near) <= std::abs(end.value - near)) return best;
  take(between(points_[interval], points_[interval + 1], area, tolerance));
  return best;
}

// The method of false position, modified: it halves the value at an end that does not move (M. Dowell, P. Jarratt, BIT 11, 1971).
// Every third step halves the interval, so that a jump of the area needs at most three times the steps of a bisection.
AreaSearch::Point AreaSearch::between(Point a, Point b, double area, double tolerance) const {
  double weight_a = a.area - area, weight_b = b.area - area;
  Point best = std::abs(weight_a) < std::abs(weight_b) ? a : b;
  for (int step = 1;; ++step) {
    const double length = b.value - a.value;
    if (std::abs(best.area - area) <= tolerance * area ||
        length <= shortest_interval * std::max(std::abs(a.value), std::abs(b.value)))
      return best;
    double value = step % 3 == 0 ? 0.5 * (a.value + b.value) : a.value + length * (weight_a / (weight_a - weight_b));
    if (!(value > a.value && value < b.value)) value = 0.5 * (a.value + b.value);
    if (!(value > a.value && value < b.value)) return best;
    const Point here{value, area_(value).value()};
    if (std::abs(here.area - area) < std::abs(best.area - area)) best = here;
    const double weight = here.area - area;
    if ((weight < 0) == (weight_a < 0)) {
      if (step % 3 != 0) weight_b *= 0.5;
      a = here;
      weight_a = weight;
    } else {
      if (step % 3 != 0) weight_a *= 0.5;
      b = here;
      weight_b = weight;
    }
  }
}

}  // namespace riis
