// SPDX-License-Identifier: Apache-2.0
// The widest passage: the path from one set of nodes to another whose smallest distance to the surface is largest.
// In: a surface, a mesh with an adjacency, the two sets. Out: the path's nearest node and its distance.
#pragma once

#include <riis/riis.h>

#include <cstdint>

#include "common/array_view.hpp"
#include "marking/search.hpp"

namespace riis {

// Nodes of the mesh, at least one of each, none masked out.
struct PassageEnds {
  ArrayView<const std::int64_t> from, to;
};

// Fails with RIIS_INVALID_ARGUMENT for an end within the half thickness, and with RIIS_INVALID_MESH if a coordinate is not
// usable. Does not use the request's limit.
riis_passage find_passage(const SearchRequest &request, const PassageEnds &ends);

}  // namespace riis
