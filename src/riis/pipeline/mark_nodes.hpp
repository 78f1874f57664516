// SPDX-License-Identifier: Apache-2.0
// Makes the marks for a request: runs the search, and then makes the lists.
#pragma once

#include <cstdint>

#include "common/band.hpp"
#include "marks/marks.hpp"
#include "obstacle/resistance.hpp"
#include "search/search.hpp"

namespace riis {

// The kind of search, and the options of a marking that the search itself does not need.
struct MarkingRequest {
  std::int32_t search;           // RIIS_SEARCH_*
  std::int32_t fields;           // a sum of RIIS_FIELD_*
  const Resistance *resistance;  // null if not wanted
  const Band *listed = nullptr;  // null, or the band whose nodes alone are listed; it must step aside
};

// Marks the nodes. After a failure, the lists of `marks` have their old content and their old addresses.
void mark_nodes(const SearchRequest &asked, const MarkingRequest &marking, Marks &marks);

// Writes the marks to the caller's arrays. The caller must have checked far_distance.
void write_dense(const Marks &marks, const riis_dense_arrays &to);

}  // namespace riis
