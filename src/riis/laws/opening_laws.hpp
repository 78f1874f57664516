// SPDX-License-Identifier: Apache-2.0
// Laws of opening: pure functions from time, pressure and flow to a valve's opening. A solver keeps the state, so a restart
// continues with the same bits.
// In: checked laws and the state before. Out: the opening now and its rate.
#pragma once

#include <riis/riis.h>

#include "laws/key_times.hpp"

namespace riis {

// All fail with RIIS_INVALID_ARGUMENT, naming the field and its value.
ValueAndRate opening_from_table(const riis_opening_table &table, double time);
ValueAndRate opening_from_times(const riis_opening_times &times, double time);
riis_opening_switch_state advance(const riis_opening_switch &law, const riis_opening_switch_state &before, double time,
                                  double pressure_difference, double flow);
riis_opening_angle_state advance(const riis_opening_angle &law, const riis_opening_angle_state &before, double time,
                                 double pressure_difference, double flow);

}  // namespace riis
