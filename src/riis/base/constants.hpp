// SPDX-License-Identifier: Apache-2.0
// Mathematical constants.
#pragma once

namespace riis {

constexpr double pi = 3.14159265358979323846;

}  // namespace riis
