// SPDX-License-Identifier: Apache-2.0
// The former version of riis_adjacency_create_from_cells, which did not yet count into 32-bit entries. It competes with the
// present version.
#pragma once

#include <riis/riis.h>

#include <cstdint>
#include <vector>

namespace bench {

struct PlainRows {
  std::vector<std::int64_t> offsets;
  std::vector<std::int32_t> columns;
};

// Makes the rows of cells of 4, 5, 6 or 8 nodes each, with ids of either width. The cells must be valid, and there must be fewer
// than 2^31 nodes.
PlainRows plain_adjacency(const riis_mesh_cells &cells, int n_threads);

}  // namespace bench
