// SPDX-License-Identifier: Apache-2.0
// Edges of the mesh that cross the surface between two unmarked nodes: paths that the marks leave open.
// In: a surface, a mesh with an adjacency, a marking's result. Out: these edges, ascending.
#pragma once

#include "marking/mark_result.hpp"
#include "marking/search.hpp"

namespace riis {

// Replaces result.leaking. Fails with RIIS_INVALID_MESH if a coordinate is not usable, and then leaves the result as it was. Does
// not use the request's limit.
riis_leaks find_leaks(const SearchRequest &request, MarkResult &result);

}  // namespace riis
