// SPDX-License-Identifier: Apache-2.0
// The widest passage: the path from one set of nodes to another that stays farthest from the surface.
// In: a surface, a mesh with an adjacency, the two sets. Out: the path's node nearest to the surface, and its distance.
#pragma once

#include <riis/riis.h>

#include <cstdint>

#include "common/array_view.hpp"
#include "search/search.hpp"

namespace riis {

// The two sets of nodes. Each has at least one node, and none is masked out.
struct PassageEnds {
  ArrayView<const std::int64_t> from, to;
};

// Finds the widest passage. Fails with RIIS_INVALID_ARGUMENT for an end within the half thickness, and with RIIS_INVALID_MESH for
// an unusable coordinate. Does not use the request's distance limit.
riis_passage find_passage(const SearchRequest &request, const PassageEnds &ends);

}  // namespace riis
