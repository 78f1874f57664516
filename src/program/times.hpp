// SPDX-License-Identifier: Apache-2.0
// In: the times of a series as a user writes them. Out: the times, ascending.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace riis::program {

// The most that a series may have.
inline constexpr std::size_t most_times = 100000;

// START:STOP:STEP, with the stop, or times between commas. subject, such as "--times", begins refusals.
std::vector<double> parse_times(const std::string &text, const std::string &subject);

// Refuses times that do not ascend, fewer than two, and more than most_times.
void check_times(const std::vector<double> &times, const std::string &subject);

}  // namespace riis::program
