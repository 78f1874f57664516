// SPDX-License-Identifier: Apache-2.0
// Checks the arguments of riis_opening_*. The work is in laws/.
#include <limits>

#include "api/structs.hpp"
#include "base/errors.hpp"
#include "laws/opening_laws.hpp"

using riis::guarded;
using riis::require;

namespace {

constexpr double no_value = std::numeric_limits<double>::quiet_NaN();

const riis_opening_table default_table{sizeof(riis_opening_table), 0, nullptr, nullptr, 0,
                                       RIIS_INTERPOLATION_LINEAR,  0};
const riis_opening_times default_times{sizeof(riis_opening_times), no_value, no_value, no_value, no_value, 0, 1, 0};
const riis_opening_switch default_switch{sizeof(riis_opening_switch), no_value, no_value, 0, 0, 0, 0};
const riis_opening_switch_state default_switch_state{
    sizeof(riis_opening_switch_state), 0, 0, 0, 0, no_value, no_value, no_value, RIIS_PHASE_CLOSING, 0};
const riis_opening_angle default_angle{sizeof(riis_opening_angle), no_value, no_value, no_value, no_value, 0, 75};
const riis_opening_angle_state default_angle_state{sizeof(riis_opening_angle_state), 0, 0, 0, 0, 0, no_value, no_value};

void write(const riis::ValueAndRate &made, double *opening, double *rate) {
  riis::put(opening, made.value);
  riis::put(rate, made.rate);
}

// The body of both functions that advance a state. `now` and `before` may be the same struct.
template <class Law, class State>
void advance(const Law *law, const Law &default_law, const State *before, const State &default_state, double time,
             double pressure_difference, double flow, State *now) {
  const Law whole_law = riis::completed(require(law, "law"), "law", default_law);
  const State whole_before = riis::completed(require(before, "before"), "before", default_state);
  const std::int64_t size = before->struct_size;
  require(now, "now");
  State made = riis::advance(whole_law, whole_before, time, pressure_difference, flow);
  made.struct_size = size;
  riis::write_struct(now, size, "now", made);
}

}  // namespace

extern "C" {

RIIS_DEFINE_INIT(riis_opening_table_init, riis_opening_table, table, default_table)

riis_status riis_opening_from_table(const riis_opening_table *table, double time, double *opening, double *rate) {
  return guarded([&] {
    write(riis::opening_from_table(riis::completed(require(table, "table"), "table", default_table), time), opening,
          rate);
  });
}

RIIS_DEFINE_INIT(riis_opening_times_init, riis_opening_times, times, default_times)

riis_status riis_opening_from_times(const riis_opening_times *times, double time, double *opening, double *rate) {
  return guarded([&] {
    write(riis::opening_from_times(riis::completed(require(times, "times"), "times", default_times), time), opening,
          rate);
  });
}

RIIS_DEFINE_INIT(riis_opening_switch_init, riis_opening_switch, law, default_switch)

RIIS_DEFINE_INIT(riis_opening_switch_state_init, riis_opening_switch_state, state, default_switch_state)

riis_status riis_opening_switch_advance(const riis_opening_switch *law, const riis_opening_switch_state *before,
                                        double time, double pressure_difference, double flow,
                                        riis_opening_switch_state *now) {
  return guarded(
      [&] { advance(law, default_switch, before, default_switch_state, time, pressure_difference, flow, now); });
}

RIIS_DEFINE_INIT(riis_opening_angle_init, riis_opening_angle, law, default_angle)

RIIS_DEFINE_INIT(riis_opening_angle_state_init, riis_opening_angle_state, state, default_angle_state)

riis_status riis_opening_angle_advance(const riis_opening_angle *law, const riis_opening_angle_state *before,
                                       double time, double pressure_difference, double flow,
                                       riis_opening_angle_state *now) {
  return guarded(
      [&] { advance(law, default_angle, before, default_angle_state, time, pressure_difference, flow, now); });
}
}
