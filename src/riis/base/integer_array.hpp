// SPDX-License-Identifier: Apache-2.0
// Reads the caller's integers in place, 32 or 64 bits wide and counted from 0 or 1. Also checks the fields that state the
// width and the base.
#pragma once

#include <cstdint>

#include "base/errors.hpp"

namespace riis {

struct IntegerArray {
  const void *data = nullptr;
  bool is_64_bits = false;

  std::int64_t operator[](std::int64_t i) const {
    return is_64_bits ? static_cast<const std::int64_t *>(data)[i] : static_cast<const std::int32_t *>(data)[i];
  }
};

inline void check_bits(const char *field, std::int32_t bits) {
  if (bits != 32 && bits != 64) fail(RIIS_INVALID_ARGUMENT, field, " is ", bits, "; it must be 32 or 64");
}

inline void check_base(const char *field, std::int32_t base) {
  if (base != 0 && base != 1) fail(RIIS_INVALID_ARGUMENT, field, " is ", base, "; it must be 0 or 1");
}

inline void check_reserved(const char *field, std::int32_t value) {
  if (value != 0) fail(RIIS_INVALID_ARGUMENT, field, " is ", value, "; it must be 0");
}

}  // namespace riis
