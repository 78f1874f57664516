// SPDX-License-Identifier: Apache-2.0
#include "laws/key_times.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/errors.hpp"

namespace riis {
namespace {

constexpr double largest_time = 1e30, infinity = std::numeric_limits<double>::infinity();
// A relative tolerance for rounding. For example, 0.1 and 0.8 count as one period of 0.7 apart, although their difference is
// rounded.
constexpr double rounding = 1e-9;
constexpr std::int64_t max_keys = 1'000'000;

// Returns the derivative of the monotone cubic at a key. The derivative at a key is the weighted harmonic mean of the slopes
// before and after the key (F. N. Fritsch, J. Butland, SIAM J. Sci. Stat. Comput. 5(2), 1984). The derivative is 0 if the slopes
// have different signs, or if the key lacks a neighbour on one side.
double tangent(double slope_before, double slope_behind, double width_before, double width_behind) {
  if (!(slope_before * slope_behind > 0) || width_before == infinity || width_behind == infinity) return 0;
  const double w_before = 2 * width_behind + width_before, w_behind = width_behind + 2 * width_before;
  return (w_before + w_behind) / (w_before / slope_before + w_behind / slope_behind);
}

}  // namespace

KeyTimes::KeyTimes(const char *name, std::int64_t n_keys, const double *time, double period, std::int32_t interpolation)
    : n_keys_(n_keys), time_(time), period_(period), is_cubic_(interpolation == RIIS_INTERPOLATION_CUBIC) {
  if (n_keys < 1 || n_keys > max_keys)
    fail(RIIS_INVALID_ARGUMENT, name, ".n_keys is ", n_keys, "; it must be from 1 to ", max_keys);
  if (!time) fail(RIIS_INVALID_ARGUMENT, name, ".time is NULL");
  check_range(name, "period", period, 0, largest_time);
  if (interpolation != RIIS_INTERPOLATION_LINEAR && interpolation != RIIS_INTERPOLATION_CUBIC)
    fail(RIIS_INVALID_ARGUMENT, name, ".interpolation is ", interpolation,
         "; it must be RIIS_INTERPOLATION_LINEAR or RIIS_INTERPOLATION_CUBIC");
  for (std::int64_t i = 0; i < n_keys; ++i) {
    if (!(std::abs(time[i]) <= largest_time))
      fail(RIIS_INVALID_ARGUMENT, name, ".time of key ", i, " is ", time[i], "; it must be finite and at most ",
           largest_time, " in magnitude");
    if (i > 0 && !(time[i] > time[i - 1]))
      fail(RIIS_INVALID_ARGUMENT, name, ".time of key ", i, " is ", time[i],
           "; it must be above the time of the key before it, ", time[i - 1]);
    if (period > 0 && time[i] - time[0] > (1 + rounding) * period)
      fail(RIIS_INVALID_ARGUMENT, name, ".time of key ", i, " is ", time[i], ", beyond the period of ", period,
           " that begins with the first key, at ", time[0]);
  }
  is_closed_ = period > 0 && n_keys > 1 && time[n_keys - 1] - time[0] >= (1 - rounding) * period;
}

// A time is rounded whenever periods are added to it, here or in the caller's program. Without a tolerance, a time at a key could
// be rounded to just before the key, where the rate is different.
double KeyTimes::from_key(std::int64_t i, double time) const {
  const auto if_at = [&](double key) {
    const double difference = time - key, key_lost = difference - time;
    const double rest = (time - (difference - key_lost)) - (key + key_lost);  // the rounding error of the subtraction
    const double distance = std::abs((period_ > 0 ? std::remainder(difference, period_) : difference) + rest);
    constexpr double unit = std::numeric_limits<double>::epsilon();
    return distance <= 8 * unit * std::max({std::abs(time), std::abs(key), period_}) ? distance : infinity;
  };
  const std::int64_t key = position(i);
  const double distance = if_at(time_[key]);
  return is_closed_ && key == 0 ? std::min(distance, if_at(time_[n_keys_ - 1])) : distance;
}

KeyTimes::KeysAround KeyTimes::around(double time, const char *name) const {
  if (!(std::abs(time) <= largest_time))
    fail(RIIS_INVALID_ARGUMENT, name, " is ", time, "; it must be finite and at most ", largest_time, " in magnitude");
  if (n() == 1) return {{0, 0, 0, 0}, {infinity, infinity, infinity}, 0, true};
  const bool repeats = period_ > 0;
  double in_period = time;
  if (repeats) {
    const double since = std::fmod(time - time_[0], period_);
    in_period = time_[0] + (since < 0 ? since + period_ : since);
  }
  const std::int64_t last = n() - 1;
  std::int64_t i = std::upper_bound(time_, time_ + n(), in_period) - time_ - 1;
  if (repeats) i = std::max<std::int64_t>(i, 0);
  const double from_this = i < 0 ? infinity : from_key(i, time),
               from_next = repeats || i < last ? from_key(i + 1, time) : infinity;
  const bool is_next = from_next < infinity && from_next <= from_this, is_key = is_next || from_this < infinity;
  if (is_next) i = repeats ? position(i + 1) : i + 1;
  if (!repeats && (i < 0 || i >= last)) {
    const std::int64_t end = i < 0 ? 0 : last;
    return {{end, end, end, end}, {infinity, infinity, infinity}, 0, true};
  }
  const bool has_before = repeats || i > 0, has_behind = repeats || i + 1 < last;
  return {{has_before ? position(i - 1) : i, i, position(i + 1), has_behind ? position(i + 2) : position(i + 1)},
          {has_before ? this->time(i) - this->time(i - 1) : infinity, this->time(i + 1) - this->time(i),
           has_behind ? this->time(i + 2) - this->time(i + 1) : infinity},
          is_key ? 0 : in_period - this->time(i),
          false};
}

ValueAndRate KeyTimes::between(const KeysAround &around, const std::array<double, 4> &values) const {
  const double from = values[1], to = values[2];
  if (around.is_at_rest) return {from, 0};
  const double width = around.width[1], s = around.since / width, slope = (to - from) / width;
  if (!is_cubic_) return {(1 - s) * from + s * to, slope};
  const double slope_before = (from - values[0]) / around.width[0], slope_behind = (values[3] - to) / around.width[2];
  const double d0 = width * tangent(slope_before, slope, around.width[0], width);
  const double d1 = width * tangent(slope, slope_behind, width, around.width[2]);
  const double rise = to - from, c2 = 3 * rise - 2 * d0 - d1, c3 = d0 + d1 - 2 * rise;
  return {from + s * (d0 + s * (c2 + s * c3)), (d0 + s * (2 * c2 + s * 3 * c3)) / width};
}

}  // namespace riis
