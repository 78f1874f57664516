// SPDX-License-Identifier: Apache-2.0
#include "laws/opening_laws.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "base/errors.hpp"
#include "base/integer_array.hpp"
#include "common/elementary.hpp"
#include "geometry/vec3.hpp"

namespace riis {
namespace {

constexpr double largest_number = 1e30;
constexpr double degree = pi / 180;

void check_time(double time) { check_range("", "time", time, -largest_number, largest_number); }

// Rises smoothly from 0 at x = 0 to 1 at x = 1. The ramp's first two derivatives are 0 at both ends, so the valve's velocity and
// acceleration do not jump. Just below x = 1, rounding may give a value above 1. No valve accepts such an opening, so the result
// is limited to 1.
double ramp(double x) { return x <= 0 ? 0 : x >= 1 ? 1 : std::min(1.0, x * x * x * (10 + x * (-15 + 6 * x))); }
double ramp_rate(double x) { return x <= 0 || x >= 1 ? 0 : 30 * x * x * (1 - x) * (1 - x); }

}  // namespace

ValueAndRate opening_from_table(const riis_opening_table &table, double time) {
  const KeyTimes keys("table", table.n_keys, table.time, table.period, table.interpolation);
  check_reserved("table.reserved", table.reserved);
  require(table.opening, "table.opening");
  for (std::int64_t i = 0; i < table.n_keys; ++i)
    if (!(table.opening[i] >= 0 && table.opening[i] <= 1))
      fail(RIIS_INVALID_ARGUMENT, "table.opening of key ", i, " is ", table.opening[i], "; it must be from 0 to 1");
  const double first = table.opening[0], last = table.opening[table.n_keys - 1];
  if (keys.is_closed() && first != last)
    fail(RIIS_INVALID_ARGUMENT, "table.opening of the last key, one period after the first key, is ", last,
         "; it must equal that of the first key, ", first);
  const KeyTimes::KeysAround around = keys.around(time);
  std::array<double, 4> openings;
  for (std::size_t k = 0; k < 4; ++k) openings[k] = table.opening[around.key[k]];
  const ValueAndRate made = keys.between(around, openings);
  // The opening is clamped to its range, because rounding could put it slightly outside.
  return {std::clamp(made.value, 0.0, 1.0), made.rate};
}

ValueAndRate opening_from_times(const riis_opening_times &times, double time) {
  check_range("times", "opening_start", times.opening_start, -largest_number, largest_number);
  check_range("times", "opening_duration", times.opening_duration, 1 / largest_number, largest_number);
  check_range("times", "closing_start", times.closing_start, times.opening_start + times.opening_duration,
              largest_number);
  check_range("times", "closing_duration", times.closing_duration, 1 / largest_number, largest_number);
  check_range("times", "closed", times.closed, 0, 1);
  check_range("times", "open", times.open, 0, 1);
  check_range("times", "period", times.period, 0, largest_number);
  const double length = times.closing_start + times.closing_duration - times.opening_start;
  if (times.period > 0 && length > times.period)
    fail(RIIS_INVALID_ARGUMENT, "times.period is ", times.period, "; opening and closing take ", length);
  check_time(time);
  double since = time - times.opening_start;
  if (times.period > 0) {
    since = std::fmod(since, times.period);
    if (since < 0) since += times.period;
  }
  const double opened = since / times.opening_duration;
  const double closed = (since - (times.closing_start - times.opening_start)) / times.closing_duration;
  const double height = times.open - times.closed;
  // The opening is clamped to its range, because rounding could put it slightly outside.
  return {std::clamp(times.closed + height * (ramp(opened) - ramp(closed)), std::min(times.closed, times.open),
                     std::max(times.closed, times.open)),
          height * (ramp_rate(opened) / times.opening_duration - ramp_rate(closed) / times.closing_duration)};
}

namespace {

// Returns the time since the previous state. Also checks the pressure difference and the flow.
double checked_step(double before, double time, double pressure_difference, double flow) {
  check_range("before", "time", before, -largest_number, largest_number);
  check_range("", "time", time, before, largest_number);
  check_range("", "pressure_difference", pressure_difference, -largest_number, largest_number);
  check_range("", "flow", flow, -largest_number, largest_number);
  return time - before;
}

// Returns the new value of a first-order filter. `before` is NaN before the first value.
double filtered(double before, double now, double step, double filter_time) {
  if (std::isnan(before) || filter_time == 0) return now;
  return before - exponential_minus_one(-step / filter_time) * (now - before);
}

void check_phase(std::int32_t phase) {
  if (phase != RIIS_PHASE_CLOSING && phase != RIIS_PHASE_OPENING)
    fail(RIIS_INVALID_ARGUMENT, "before.phase is ", phase, "; it must be RIIS_PHASE_CLOSING or RIIS_PHASE_OPENING");
}

}  // namespace

riis_opening_switch_state advance(const riis_opening_switch &law, const riis_opening_switch_state &before, double time,
                                  double pressure_difference, double flow) {
  check_range("law", "opening_duration", law.opening_duration, 1 / largest_number, largest_number);
  check_range("law", "closing_duration", law.closing_duration, 1 / largest_number, largest_number);
  check_range("law", "open_above", law.open_above, -largest_number, largest_number);
  check_range("law", "close_below", law.close_below, -largest_number, largest_number);
  check_range("law", "filter_time", law.filter_time, 0, largest_number);
  check_range("law", "dwell_time", law.dwell_time, 0, largest_number);
  check_range("before", "progress", before.progress, 0, 1);
  check_phase(before.phase);
  check_reserved("before.reserved", before.reserved);
  const double step = checked_step(before.time, time, pressure_difference, flow);

  riis_opening_switch_state now = before;
  now.time = time;
  if (step > 0 || std::isnan(before.pressure_difference)) {
    now.pressure_difference = filtered(before.pressure_difference, pressure_difference, step, law.filter_time);
    now.flow = filtered(before.flow, flow, step, law.filter_time);
  }
  // After a change of phase, the valve does not change back within dwell_time. Noise in the pressure and the flow of the solver
  // therefore does not make the valve flutter.
  const bool may_turn = std::isnan(before.turn_time) || time - before.turn_time >= law.dwell_time;
  const bool opens = before.phase == RIIS_PHASE_CLOSING && now.pressure_difference > law.open_above;
  const bool closes = before.phase == RIIS_PHASE_OPENING && now.flow < law.close_below;
  if (may_turn && (opens || closes)) {
    now.phase = opens ? RIIS_PHASE_OPENING : RIIS_PHASE_CLOSING;
    now.turn_time = time;
  }
  // The phase at the start of a step holds for the whole step, because a change of phase becomes known only at the end.
  const bool is_opening = before.phase == RIIS_PHASE_OPENING;
  const double per_second = is_opening ? 1 / law.opening_duration : -1 / law.closing_duration;
  now.progress = std::clamp(before.progress + step * per_second, 0.0, 1.0);
  now.opening = ramp(now.progress);
  now.rate = ramp_rate(now.progress) *
             (now.phase == RIIS_PHASE_OPENING ? 1 / law.opening_duration : -1 / law.closing_duration);
  return now;
}

namespace {

// An angle in radians and its rate of change.
struct AngleState {
  double angle, rate;
};

AngleState operator+(AngleState a, AngleState b) { return {a.angle + b.angle, a.rate + b.rate}; }
AngleState operator*(double s, AngleState a) { return {s * a.angle, s * a.rate}; }

// The law of Korakianitis and Shi. The pressure difference and the flow drive the valve. Both are taken as linear in time during
// a step.
class AngleLaw {
 public:
  struct Drive {
    double pressure_difference, flow;
  };
  AngleLaw(const riis_opening_angle &law, Drive from, Drive to) : law_(law), from_(from), to_(to) {}

  // Returns the time derivatives of the angle and of its rate, after a share of the step (0 to 1).
  AngleState derivative(AngleState at, double share) const {
    const double pressure = (1 - share) * from_.pressure_difference + share * to_.pressure_difference;
    const double flow = (1 - share) * from_.flow + share * to_.flow;
    const auto [sine, cosine] = sine_cosine(at.angle);
    return {at.rate, -law_.friction * at.rate + (law_.pressure_gain * pressure + law_.flow_gain * flow) * cosine -
                         law_.vortex_gain * std::max(flow, 0.0) * (2 * sine * cosine)};
  }

  // Bounds the rate at which the motion changes. The number of Runge-Kutta steps follows from this bound.
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

// Takes one step of the classical Runge-Kutta method. `from` and `to` are shares of the caller's step.
AngleState runge_kutta(const AngleLaw &law, AngleState at, double from, double to, double seconds) {
  const double middle = 0.5 * (from + to);
  const AngleState k1 = law.derivative(at, from), k2 = law.derivative(at + (0.5 * seconds) * k1, middle),
                   k3 = law.derivative(at + (0.5 * seconds) * k2, middle), k4 = law.derivative(at + seconds * k3, to);
  return at + (seconds / 6) * (k1 + 2 * k2 + 2 * k3 + k4);
}

// Limits the angle to the range between the leaflet's two stops. A leaflet at a stop may only move away from the stop.
AngleState stopped(AngleState at, double least, double most) {
  if (at.angle <= least) return {least, std::max(at.rate, 0.0)};
  if (at.angle >= most) return {most, std::min(at.rate, 0.0)};
  return at;
}

}  // namespace

riis_opening_angle_state advance(const riis_opening_angle &law, const riis_opening_angle_state &before, double time,
                                 double pressure_difference, double flow) {
  check_range("law", "pressure_gain", law.pressure_gain, 0, largest_number);
  check_range("law", "flow_gain", law.flow_gain, 0, largest_number);
  check_range("law", "friction", law.friction, 0, largest_number);
  check_range("law", "vortex_gain", law.vortex_gain, 0, largest_number);
  check_range("law", "angle_min", law.angle_min, 0, 90);
  check_range("law", "angle_max", law.angle_max, law.angle_min, 90);
  if (!(law.angle_max > law.angle_min))
    fail(RIIS_INVALID_ARGUMENT, "law.angle_max is ", law.angle_max, "; it must be above law.angle_min, ",
         law.angle_min);
  // An initial state has no pressure difference and no flow, so the values at the end of the step are used. The angle 0 of an
  // initial state stands for angle_min, where the valve is closed.
  const bool has_drive = !std::isnan(before.pressure_difference) && !std::isnan(before.flow);
  const double angle = has_drive || before.angle != 0 ? before.angle : law.angle_min;
  check_range("before", "angle", angle, law.angle_min, law.angle_max);
  check_range("before", "angle_rate", before.angle_rate, -largest_number, largest_number);
  const double step = checked_step(before.time, time, pressure_difference, flow);

  const AngleLaw::Drive to{pressure_difference, flow};
  const AngleLaw angle_law(law, has_drive ? AngleLaw::Drive{before.pressure_difference, before.flow} : to, to);
  // The method's error is proportional to the fourth power of the step. With steps of this size, the error is far below the error
  // that comes from taking pressure and flow as linear.
  constexpr double largest_step = 0.05;
  const double n_wanted = std::ceil(step * angle_law.fastest() / largest_step);
  constexpr double max_steps = 1e6;
  if (!(n_wanted <= max_steps))
    fail(RIIS_LIMIT_EXCEEDED, "time is ", step, " after before.time, which needs ", n_wanted,
         " steps of the angle's motion; at most ", max_steps,
         " are computed: take shorter steps, or look at the gains' units");
  const auto n = std::max<std::int64_t>(1, static_cast<std::int64_t>(n_wanted));
  const double least = law.angle_min * degree, most = law.angle_max * degree;
  AngleState at{angle * degree, before.angle_rate * degree};
  if (step > 0)
    for (std::int64_t i = 0; i < n; ++i) {
      const double from = static_cast<double>(i) / static_cast<double>(n),
                   until = static_cast<double>(i + 1) / static_cast<double>(n);
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
