// SPDX-License-Identifier: Apache-2.0
// Marking from request to result: runs the search, then makes the lists.
#pragma once

#include <cstdint>

#include "marking/mark_result.hpp"
#include "marking/search.hpp"

namespace riis {

// search is a RIIS_SEARCH_* value, fields a sum of RIIS_FIELD_*. A failure leaves the content of the result as it was.
void mark_nodes(const SearchRequest &request, std::int32_t search, std::int32_t fields, MarkResult &result);

// Writes the result as dense arrays, any of which may be null. riis.h explains them at riis_mark_result_dense.
void write_dense(const MarkResult &result, double far_distance, std::uint8_t *mark, double *distance,
                 std::int64_t *triangle_id, std::int32_t *leaflet_id);

}  // namespace riis
