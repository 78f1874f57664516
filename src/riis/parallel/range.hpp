// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace riis {

// The positions i of a list with begin <= i < end.
struct Range {
  std::int64_t begin, end;
};

}  // namespace riis
