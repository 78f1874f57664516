// SPDX-License-Identifier: Apache-2.0
// Laws of opening: pure functions from time, pressure and flow to a valve's present opening and its rate. Some laws also need the
// previous state, which the solver keeps. If the solver saves this state, a restarted run continues with the same bits.
#pragma once

#include <riis/riis.h>

#include "laws/key_times.hpp"

namespace riis {

// All functions of this file fail with RIIS_INVALID_ARGUMENT for bad input. The message names the field and its value.
ValueAndRate opening_from_table(const riis_opening_table &table, double time);
ValueAndRate opening_from_times(const riis_opening_times &times, double time);
riis_opening_switch_state advance(const riis_opening_switch &law, const riis_opening_switch_state &before, double time,
                                  double pressure_difference, double flow);
riis_opening_angle_state advance(const riis_opening_angle &law, const riis_opening_angle_state &before, double time,
                                 double pressure_difference, double flow);

}  // namespace riis
