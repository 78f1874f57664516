// SPDX-License-Identifier: Apache-2.0
// Laws of opening: pure functions from time, pressure and flow to a valve's opening. The state belongs to the solver, which can
// save it. A restarted run therefore continues with the same bits.
// Each law gives the present opening and its rate. Some laws need the previous state.
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
