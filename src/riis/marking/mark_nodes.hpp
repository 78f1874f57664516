// SPDX-License-Identifier: Apache-2.0
// Marking from request to marks: runs the search, then makes the lists.
#pragma once

#include <cstdint>

#include "marking/marks.hpp"
#include "marking/resistance.hpp"
#include "marking/search.hpp"

namespace riis {

// A marking besides its search for nodes.
struct MarkingRequest {
  std::int32_t search;           // RIIS_SEARCH_*
  std::int32_t fields;           // a sum of RIIS_FIELD_*
  const Resistance *resistance;  // null: none
};

// A failure leaves the lists as they were and where they were.
void mark_nodes(const SearchRequest &asked, const MarkingRequest &marking, Marks &marks);

// Writes the marks to the caller's arrays, whose far_distance was checked.
void write_dense(const Marks &marks, const riis_dense_arrays &to);

}  // namespace riis
