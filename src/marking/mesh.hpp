// SPDX-License-Identifier: Apache-2.0
// The caller's nodes, borrowed; checked when the handle is made or updated.
#pragma once

#include "geometry/strided.hpp"

namespace riis {

struct Mesh {
  StridedPoints nodes;
};

}  // namespace riis
