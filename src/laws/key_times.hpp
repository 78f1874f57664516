// SPDX-License-Identifier: Apache-2.0
// Interpolation between keys in time, once or again and again: of openings (laws/opening_laws.hpp) and of vertices
// (surface/keyframes.hpp).
// In: times of keys, a period. Out: the keys around a time, and the values and rates between them.
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
  // Checks the arrays' fields, calls them by the name of their struct, and fails with RIIS_INVALID_ARGUMENT, naming the field
  // or key and its value. The times are borrowed.
  KeyTimes(const char *name, std::int64_t n_keys, const double *time, double period, std::int32_t interpolation);

  // True if the last key is the first again, a period later: their values must be equal.
  bool is_closed() const { return is_closed_; }

  // What a value at a time depends on: the keys around it and the weights of an interpolation between them. A key counts by
  // its position in the arrays, so a time in the next period has keys of this one.
  struct Place {
    std::array<std::int64_t, 4> key;  // before the interval, at its two ends, behind it
    std::array<double, 3> width;      // from each of these to the next; infinite where there is no key
    double since;                     // time since the interval's first end
    bool is_at_rest;                  // before the first or behind the last key: the value is that of key[1]
  };
  // Fails with RIIS_INVALID_ARGUMENT for a time that is not finite.
  Place place(double time) const;

  // The value and the rate at a place, from the values at its four keys.
  ValueAndRate between(const Place &place, const std::array<double, 4> &values) const;

 private:
  std::int64_t n() const { return n_keys_ - (is_closed_ ? 1 : 0); }
  double time(std::int64_t i) const {
    return i < 0 ? time_[i + n()] - period_ : i >= n() ? time_[i - n()] + period_ : time_[i];
  }
  std::int64_t position(std::int64_t i) const { return i < 0 ? i + n() : i >= n() ? i - n() : i; }

  std::int64_t n_keys_;
  const double *time_;
  double period_;
  bool is_cubic_, is_closed_;
};

}  // namespace riis
