// SPDX-License-Identifier: Apache-2.0
// The check of a number that the caller gives.
#pragma once

#include "base/errors.hpp"

namespace riis {

// Refuses a field that is not from least to most, such as NaN. `owner` is the argument that has the field, or "" if the
// number is the argument itself.
inline void check_range(const char *owner, const char *name, double value, double least, double most) {
  if (!(value >= least && value <= most))
    fail(RIIS_INVALID_ARGUMENT, owner, *owner ? "." : "", name, " is ", value, "; it must be from ", least, " to ",
         most);
}

}  // namespace riis
