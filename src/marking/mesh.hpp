// SPDX-License-Identifier: Apache-2.0
// The caller's nodes, borrowed and checked.
#pragma once

#include <riis/riis.h>

#include "geometry/strided.hpp"

namespace riis {

// Checks pointers, stride and every coordinate; fails with RIIS_INVALID_ARGUMENT, or with bad_coordinate for the first
// coordinate (by number) that is not finite or too large, naming it as `what` ("node", "point").
void check_points(const StridedPoints &points, const char *what, riis_status bad_coordinate);

struct Mesh {
  StridedPoints nodes;
};

// Fails with RIIS_INVALID_ARGUMENT or RIIS_INVALID_MESH.
Mesh make_mesh(const StridedPoints &nodes);

}  // namespace riis
