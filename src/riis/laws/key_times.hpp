// SPDX-License-Identifier: Apache-2.0
// Interpolates in time between keys, which may repeat periodically. A key is a time with a value: an opening
// (laws/opening_laws.hpp) or the vertices of a keyframe (arrays/user_arrays.hpp).
// This file finds the keys around a time, and the values and rates between these keys.
#pragma once

#include <riis/riis.h>

#include <array>
#include <cstdint>

namespace riis {

struct ValueAndRate {
  double value, rate;
};

class KeyTimes {
 public:
  // Borrows the array of the keys' times, and checks the arguments, which are fields of the caller's struct `name`. Fails with
  // RIIS_INVALID_ARGUMENT. The message names the bad field or key, and its value.
  KeyTimes(const char *name, std::int64_t n_keys, const double *time, double period, std::int32_t interpolation);

  // Returns whether the last key is exactly one period after the first key. The values of these two keys must then be equal.
  bool is_closed() const { return is_closed_; }

  // The keys around a time, and the times between these keys. A key is given by its position in the arrays, so a time and the
  // same time one period later have the same keys.
  struct KeysAround {
    std::array<std::int64_t, 4> key;  // before the interval, at its two ends, after it
    std::array<double, 3> width;      // the time from each of these keys to the next key; infinite without a next key
    double since;                     // time since the interval's first end
    bool is_at_rest;                  // true before the first key and after the last; key[1] then gives the value
  };
  // A time counts as a key if the two differ, apart from whole periods, by at most 8 units of rounding. The interval then begins
  // at this key. The unit is 2^-52 times the largest of time, key and period. Fails with RIIS_INVALID_ARGUMENT for a time that is
  // not finite. `name` is the time's name in the message.
  KeysAround around(double time, const char *name = "time") const;

  // Returns the value and the rate at the time, from the values at these four keys.
  ValueAndRate between(const KeysAround &around, const std::array<double, 4> &values) const;

 private:
  std::int64_t n() const { return n_keys_ - (is_closed_ ? 1 : 0); }
  double time(std::int64_t i) const {
    return i < 0 ? time_[i + n()] - period_ : i >= n() ? time_[i - n()] + period_ : time_[i];
  }
  // If the time counts as the key, returns the distance between the two, apart from whole periods. Otherwise returns infinity.
  double from_key(std::int64_t i, double time) const;
  std::int64_t position(std::int64_t i) const { return i < 0 ? i + n() : i >= n() ? i - n() : i; }

  std::int64_t n_keys_;
  const double *time_;
  double period_;
  bool is_cubic_, is_closed_;
};

}  // namespace riis
