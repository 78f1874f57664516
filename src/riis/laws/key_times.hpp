// SPDX-License-Identifier: Apache-2.0
// Interpolates between keys in time, once or periodically. The interpolation serves openings (laws/opening_laws.hpp) and the
// vertices of keyframes (arrays/user_arrays.hpp).
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
  // Borrows the keys' times and checks the fields. `name` is the name of the struct that has these fields. Fails with
  // RIIS_INVALID_ARGUMENT. A message names the field or the key, and its value.
  KeyTimes(const char *name, std::int64_t n_keys, const double *time, double period, std::int32_t interpolation);

  // Returns whether the last key is exactly one period after the first key. The values of these two keys must then be equal.
  bool is_closed() const { return is_closed_; }

  // The keys around a time, and the times between these keys. The value at the time follows from them and from the keys' values.
  // A key is given by its position in the arrays, so whole periods make no difference.
  struct KeysAround {
    std::array<std::int64_t, 4> key;  // before the interval, at its two ends, after it
    std::array<double, 3> width;      // the time from each of these keys to the next key; infinite without a next key
    double since;                     // time since the interval's first end
    bool is_at_rest;                  // true before the first key and after the last; key[1] then gives the value
  };
  // Apart from whole periods, a time within 8 units of rounding of a key counts as this key. The key then becomes the first end
  // of the interval. The unit is 2^-52 times the largest of time, key and period. Fails with RIIS_INVALID_ARGUMENT for a time
  // that is not finite. `name` is the time's name in the message.
  KeysAround around(double time, const char *name = "time") const;

  // Returns the value and the rate at the time, from the values at these four keys.
  ValueAndRate between(const KeysAround &around, const std::array<double, 4> &values) const;

 private:
  std::int64_t n() const { return n_keys_ - (is_closed_ ? 1 : 0); }
  double time(std::int64_t i) const {
    return i < 0 ? time_[i + n()] - period_ : i >= n() ? time_[i - n()] + period_ : time_[i];
  }
  // Returns the distance of a time from a key, apart from whole periods. Returns infinity if the time does not count as the
  // key.
  double from_key(std::int64_t i, double time) const;
  std::int64_t position(std::int64_t i) const { return i < 0 ? i + n() : i >= n() ? i - n() : i; }

  std::int64_t n_keys_;
  const double *time_;
  double period_;
  bool is_cubic_, is_closed_;
};

}  // namespace riis
