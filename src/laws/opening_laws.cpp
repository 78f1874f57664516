// SPDX-License-Identifier: Apache-2.0
#include "laws/opening_laws.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include "base/errors.hpp"
#include "base/integer_array.hpp"

namespace riis {
namespace {

constexpr double largest = 1e30;
constexpr double degree = 3.14159265358979323846 / 180;

void check_range(const char *name, double value, double least, double most) {
  if (!(value >= least && value <= most))
    fail(RIIS_INVALID_ARGUMENT, name, " is ", value, "; it must be from ", least, " to ", most);
}

void check_time(double time) { check_range("time", time, -largest, largest); }

// A ramp from 0 at x = 0 to 1 at x = 1 whose first two derivatives are 0 at both ends: neither the velocity nor the
// acceleration of the valve jumps.
double ramp(double x) { return x <= 0 ? 0 : x >= 1 ? 1 : x * x * x * (10 + x * (-15 + 6 * x)); }
double ramp_rate(double x) { return x <= 0 || x >= 1 ? 0 : 30 * x * x * (1 - x) * (1 - x); }

// Keys of a table, which go on for ever if it has a period.
class Keys {
 public:
  explicit Keys(const riis_opening_table &table) : table_(table) {
    constexpr std::int64_t max_keys = 1'000'000;
    if (table.n_keys < 1 || table.n_keys > max_keys)
      fail(RIIS_INVALID_ARGUMENT, "table.n_keys is ", table.n_keys, "; it must be from 1 to ", max_keys);
    require(table.time, "table.time");
    require(table.opening, "table.opening");
    check_range("table.period", table.period, 0, largest);
    if (table.interpolation != RIIS_INTERPOLATION_LINEAR && table.interpolation != RIIS_INTERPOLATION_CUBIC)
      fail(RIIS_INVALID_ARGUMENT, "table.interpolation is ", table.interpolation,
           "; it must be RIIS_INTERPOLATION_LINEAR or RIIS_INTERPOLATION_CUBIC");
    check_reserved("table.reserved", table.reserved);
    for (std::int64_t i = 0; i < table.n_keys; ++i) check_key(i);
    is_closed_ = table.period > 0 && table.n_keys > 1 && last() - table.time[0] >= (1 - rounding) * table.period;
    if (is_closed_ && table.opening[0] != table.opening[table.n_keys - 1])
      fail(RIIS_INVALID_ARGUMENT, "table.opening of the last key, a period after the first, is ",
           table.opening[table.n_keys - 1], "; it must be that of the first, ", table.opening[0]);
  }

  // The number of keys that differ: a last key a period after the first is the first again.
  std::int64_t n() const { return table_.n_keys - (is_closed_ ? 1 : 0); }
  bool is_periodic() const { return table_.period > 0; }

  // Key i, where -1 is the last of the period before and n() the first of the period after.
  double time(std::int64_t i) const {
    return i < 0 ? table_.time[i + n()] - table_.period : i >= n() ? table_.time[i - n()] + table_.period : table_.time[i];
  }
  double opening(std::int64_t i) const { return table_.opening[i < 0 ? i + n() : i >= n() ? i - n() : i]; }

  // The time in the period that begins with the first key.
  double wrapped(double time) const {
    if (!is_periodic()) return time;
    const double first = table_.time[0];
    const double since = std::fmod(time - first, table_.period);
    return first + (since < 0 ? since + table_.period : since);
  }

  // The last key at or before the time; -1 if there is none.
  std::int64_t before(double time) const {
    return std::upper_bound(table_.time, table_.time + n(), time) - table_.time - 1;
  }

 private:
  // Times such as 0.1 and 0.8 are a period of 0.7 apart, whatever the last bit says.
  static constexpr double rounding = 1e-9;

  double last() const { return table_.time[table_.n_keys - 1]; }

  void check_key(std::int64_t i) const {
    const double time = table_.time[i], opening = table_.opening[i];
    if (!(std::abs(time) <= largest))
      fail(RIIS_INVALID_ARGUMENT, "table.time of key ", i, " is ", time, "; it must be finite and at most ", largest,
           " in magnitude");
    if (i > 0 && !(time > table_.time[i - 1]))
      fail(RIIS_INVALID_ARGUMENT, "table.time of key ", i, " is ", time, "; it must be above that of the key before, ",
           table_.time[i - 1]);
    if (table_.period > 0 && time - table_.time[0] > (1 + rounding) * table_.period)
      fail(RIIS_INVALID_ARGUMENT, "table.time of key ", i, " is ", time, ", beyond the period of ", table_.period,
           " that begins with the first key, at ", table_.time[0]);
    if (!(opening >= 0 && opening <= 1))
      fail(RIIS_INVALID_ARGUMENT, "table.opening of key ", i, " is ", opening, "; it must be from 0 to 1");
  }

  const riis_opening_table &table_;
  bool is_closed_ = false;
};

double slope(const Keys &keys, std::int64_t i) {
  return (keys.opening(i + 1) - keys.opening(i)) / (keys.time(i + 1) - keys.time(i));
}

// The derivative of the monotone cubic at key i: the weighted harmonic mean of the slopes on either side, 0 where they differ
// in sign, and at an end without a neighbour (F. N. Fritsch, J. Butland, SIAM J. Sci. Stat. Comput. 5(2), 1984).
double tangent(const Keys &keys, std::int64_t i) {
  if (!keys.is_periodic() && (i == 0 || i == keys.n() - 1)) return 0;
  const double left = slope(keys, i - 1), right = slope(keys, i);
  if (!(left * right > 0)) return 0;
  const double width_left = keys.time(i) - keys.time(i - 1), width_right = keys.time(i + 1) - keys.time(i);
  const double w_left = 2 * width_right + width_left, w_right = width_right + 2 * width_left;
  return (w_left + w_right) / (w_left / left + w_right / right);
}

Opening interpolated(const Keys &keys, std::int64_t i, double time, bool is_cubic) {
  const double width = keys.time(i + 1) - keys.time(i), s = (time - keys.time(i)) / width;
  const double from = keys.opening(i), to = keys.opening(i + 1);
  if (!is_cubic) return {(1 - s) * from + s * to, (to - from) / width};
  const double d0 = width * tangent(keys, i), d1 = width * tangent(keys, i + 1), rise = to - from;
  const double c2 = 3 * rise - 2 * d0 - d1, c3 = d0 + d1 - 2 * rise;
  // Rounding must not leave the range of openings.
  return {std::clamp(from + s * (d0 + s * (c2 + s * c3)), 0.0, 1.0), (d0 + s * (2 * c2 + s * 3 * c3)) / width};
}

}  // namespace

Opening opening_from_table(const riis_opening_table &table, double time) {
  const Keys keys(table);
  check_time(time);
  if (keys.n() == 1) return {keys.opening(0), 0};
  const double wrapped = keys.wrapped(time);
  const std::int64_t i = keys.before(wrapped);
  if (!keys.is_periodic()) {
    if (i < 0) return {keys.opening(0), 0};
    if (i >= keys.n() - 1) return {keys.opening(keys.n() - 1), 0};
  }
  return interpolated(keys, std::max<std::int64_t>(i, 0), wrapped, table.interpolation == RIIS_INTERPOLATION_CUBIC);
}

Opening opening_from_times(const riis_opening_times &times, double time) {
  check_range("times.opening_start", times.opening_start, -largest, largest);
  check_range("times.opening_seconds", times.opening_seconds, 1 / largest, largest);
  check_range("times.closing_start", times.closing_start, times.opening_start + times.opening_seconds, largest);
  check_range("times.closing_seconds", times.closing_seconds, 1 / largest, largest);
  check_range("times.closed", times.closed, 0, 1);
  check_range("times.open", times.open, 0, 1);
  check_range("times.period", times.period, 0, largest);
  const double length = times.closing_start + times.closing_seconds - times.opening_start;
  if (times.period > 0 && length > times.period)
    fail(RIIS_INVALID_ARGUMENT, "times.period is ", times.period, "; opening and closing take ", length);
  check_time(time);
  double since = time - times.opening_start;
  if (times.period > 0) {
    since = std::fmod(since, times.period);
    if (since < 0) since += times.period;
  }
  const double opened = since / times.opening_seconds;
  const double closed = (since - (times.closing_start - times.opening_start)) / times.closing_seconds;
  const double height = times.open - times.closed;
  return {times.closed + height * (ramp(opened) - ramp(closed)),
          height * (ramp_rate(opened) / times.opening_seconds - ramp_rate(closed) / times.closing_seconds)};
}

namespace {

// The time since the state before. Values that drive the law are checked, too.
double checked_step(double before, double time, double pressure_difference, double flow) {
  check_range("before.time", before, -largest, largest);
  check_range("time", time, before, largest);
  check_range("pressure_difference", pressure_difference, -largest, largest);
  check_range("flow", flow, -largest, largest);
  return time - before;
}

// A filter of first order: NaN stands for no value yet.
double filtered(double before, double now, double step, double filter_seconds) {
  if (std::isnan(before) || filter_seconds == 0) return now;
  return before - std::expm1(-step / filter_seconds) * (now - before);
}

void check_phase(std::int32_t phase) {
  if (phase != RIIS_PHASE_CLOSING && phase != RIIS_PHASE_OPENING)
    fail(RIIS_INVALID_ARGUMENT, "before.phase is ", phase, "; it must be RIIS_PHASE_CLOSING or RIIS_PHASE_OPENING");
}

}  // namespace

riis_opening_switch_state advance(const riis_opening_switch &law, const riis_opening_switch_state &before, double time,
                                  double pressure_difference, double flow) {
  check_range("law.opening_seconds", law.opening_seconds, 1 / largest, largest);
  check_range("law.closing_seconds", law.closing_seconds, 1 / largest, largest);
  check_range("law.open_above", law.open_above, -largest, largest);
  check_range("law.close_below", law.close_below, -largest, largest);
  check_range("law.filter_seconds", law.filter_seconds, 0, largest);
  check_range("law.dwell_seconds", law.dwell_seconds, 0, largest);
  check_range("before.progress", before.progress, 0, 1);
  check_phase(before.phase);
  check_reserved("before.reserved", before.reserved);
  const double step = checked_step(before.time, time, pressure_difference, flow);

  riis_opening_switch_state now = before;
  now.time = time;
  if (step > 0 || std::isnan(before.pressure_difference)) {
    now.pressure_difference = filtered(before.pressure_difference, pressure_difference, step, law.filter_seconds);
    now.flow = filtered(before.flow, flow, step, law.filter_seconds);
  }
  // A valve that has just turned stays so for a while, whatever the noise of a solver.
  const bool may_turn = std::isnan(before.since) || time - before.since >= law.dwell_seconds;
  const bool opens = before.phase == RIIS_PHASE_CLOSING && now.pressure_difference > law.open_above;
  const bool closes = before.phase == RIIS_PHASE_OPENING && now.flow < law.close_below;
  if (may_turn && (opens || closes)) {
    now.phase = opens ? RIIS_PHASE_OPENING : RIIS_PHASE_CLOSING;
    now.since = time;
  }
  // The valve moves by the phase that it had during the step: the turn is known at its end only.
  const bool is_opening = before.phase == RIIS_PHASE_OPENING;
  const double per_second = is_opening ? 1 / law.opening_seconds : -1 / law.closing_seconds;
  now.progress = std::clamp(before.progress + step * per_second, 0.0, 1.0);
  now.opening = ramp(now.progress);
  now.rate = ramp_rate(now.progress) * (now.phase == RIIS_PHASE_OPENING ? 1 / law.opening_seconds : -1 / law.closing_seconds);
  return now;
}

namespace {

// An angle in radians and its rate.
struct Motion {
  double angle, rate;
};

Motion operator+(Motion a, Motion b) { return {a.angle + b.angle, a.rate + b.rate}; }
Motion operator*(double s, Motion a) { return {s * a.angle, s * a.rate}; }

// The law of Korakianitis and Shi, driven by a pressure difference and a flow that are linear in time.
class AngleLaw {
 public:
  struct Drive {
    double pressure_difference, flow;
  };
  AngleLaw(const riis_opening_angle &law, Drive from, Drive to) : law_(law), from_(from), to_(to) {}

  // The derivative at a share of the step.
  Motion derivative(Motion at, double share) const {
    const double pressure = (1 - share) * from_.pressure_difference + share * to_.pressure_difference;
    const double flow = (1 - share) * from_.flow + share * to_.flow;
    return {at.rate, -law_.friction * at.rate +
                         (law_.pressure_gain * pressure + law_.flow_gain * flow) * std::cos(at.angle) -
                         law_.vortex_gain * std::max(flow, 0.0) * std::sin(2 * at.angle)};
  }

  // Bounds how fast the motion changes, for the number of steps.
  double fastest() const {
    const double pressure = std::max(std::abs(from_.pressure_difference), std::abs(to_.pressure_difference));
    const double flow = std::max(std::abs(from_.flow), std::abs(to_.flow));
    return law_.friction + std::sqrt(std::abs(law_.pressure_gain) * pressure +
                                     (std::abs(law_.flow_gain) + 2 * std::abs(law_.vortex_gain)) * flow);
  }

 private:
  const riis_opening_angle &law_;
  Drive from_, to_;
};

// One step of the classical method of Runge and Kutta, from one share of the caller's step to another.
Motion runge_kutta(const AngleLaw &law, Motion at, double from, double to, double seconds) {
  const double middle = 0.5 * (from + to);
  const Motion k1 = law.derivative(at, from), k2 = law.derivative(at + (0.5 * seconds) * k1, middle),
               k3 = law.derivative(at + (0.5 * seconds) * k2, middle), k4 = law.derivative(at + seconds * k3, to);
  return at + (seconds / 6) * (k1 + 2 * k2 + 2 * k3 + k4);
}

// The stops of the leaflet take all of its speed.
Motion stopped(Motion at, double least, double most) {
  if (at.angle <= least) return {least, std::max(at.rate, 0.0)};
  if (at.angle >= most) return {most, std::min(at.rate, 0.0)};
  return at;
}

}  // namespace

riis_opening_angle_state advance(const riis_opening_angle &law, const riis_opening_angle_state &before, double time,
                                 double pressure_difference, double flow) {
  check_range("law.pressure_gain", law.pressure_gain, 0, largest);
  check_range("law.flow_gain", law.flow_gain, 0, largest);
  check_range("law.friction", law.friction, 0, largest);
  check_range("law.vortex_gain", law.vortex_gain, 0, largest);
  check_range("law.angle_min", law.angle_min, 0, 90);
  check_range("law.angle_max", law.angle_max, law.angle_min, 90);
  if (!(law.angle_max > law.angle_min))
    fail(RIIS_INVALID_ARGUMENT, "law.angle_max is ", law.angle_max, "; it must be above law.angle_min, ", law.angle_min);
  check_range("before.angle", before.angle, law.angle_min, law.angle_max);
  check_range("before.angle_rate", before.angle_rate, -largest, largest);
  const double step = checked_step(before.time, time, pressure_difference, flow);

  // A first state has no drive: that of now stands for it.
  const bool has_drive = !std::isnan(before.pressure_difference) && !std::isnan(before.flow);
  const AngleLaw::Drive to{pressure_difference, flow};
  const AngleLaw angle_law(law, has_drive ? AngleLaw::Drive{before.pressure_difference, before.flow} : to, to);
  // The error of the method falls with the fourth power of this, so that it is far below that of the drive.
  constexpr double largest_step = 0.05;
  const double n_wanted = std::ceil(step * angle_law.fastest() / largest_step);
  constexpr double max_steps = 1e6;
  if (!(n_wanted <= max_steps))
    fail(RIIS_LIMIT_EXCEEDED, "time is ", step, " after before.time, ", n_wanted, " steps of the angle's motion; at most ",
         max_steps, " are taken: take shorter steps, or look at the gains' units");
  const auto n = std::max<std::int64_t>(1, static_cast<std::int64_t>(n_wanted));
  const double least = law.angle_min * degree, most = law.angle_max * degree;
  Motion at{before.angle * degree, before.angle_rate * degree};
  if (step > 0)
    for (std::int64_t i = 0; i < n; ++i) {
      const double from = static_cast<double>(i) / static_cast<double>(n), until = static_cast<double>(i + 1) / static_cast<double>(n);
      at = stopped(runge_kutta(angle_law, at, from, until, step / static_cast<double>(n)), least, most);
    }

  riis_opening_angle_state now = before;
  now.time = time;
  now.angle = at.angle == least ? law.angle_min : at.angle == most ? law.angle_max : at.angle / degree;
  now.angle_rate = at.rate / degree;
  now.pressure_difference = pressure_difference;
  now.flow = flow;
  const double range = law.angle_max - law.angle_min;
  now.opening = std::clamp((now.angle - law.angle_min) / range, 0.0, 1.0);
  now.rate = now.angle_rate / range;
  return now;
}

}  // namespace riis
