// SPDX-License-Identifier: Apache-2.0
// Edges of the mesh that cross the surface between two unmarked nodes: paths that the marks leave open.
// In: a surface, a mesh with an adjacency, what a marking found. Out: such edges, ascending.
#pragma once

#include "marking/mark_result.hpp"
#include "marking/search.hpp"

namespace riis {

// Replaces result.leaking; fails with RIIS_INVALID_MESH if a coordinate is not usable, and leaves the result as it was then. The
// request's limit does not matter.
riis_leaks find_leaks(const SearchRequest &request, MarkResult &result);

}  // namespace riis
