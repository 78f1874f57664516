// SPDX-License-Identifier: Apache-2.0
// Finds the opening at which a valve first has a passage. The library uses this code for its caller's mesh, and the program also
// uses it for the pieces of a mesh.
#pragma once

#include <riis/riis.h>

#include <algorithm>

namespace riis {

// `passage_at` returns the passage at an opening. The seconds of the result are not set.
template <class PassageAt>
riis_first_passage first_passage(double tolerance, const PassageAt &passage_at) {
  constexpr int n_coarse = 8;
  riis_first_passage first{};
  const auto is_open_at = [&](double opening) {
    const riis_passage passage = passage_at(opening);
    const bool is_open = passage.state == RIIS_PASSAGE_OPEN;
    ++first.n_openings;
    (is_open ? first.opening : first.closed_opening) = opening;
    if (is_open || opening == 0 || opening == 1) {
      first.node_id = passage.node_id;
      first.distance = passage.distance;
      std::copy_n(passage.point, 3, first.point);
    }
    first.state = passage.state == RIIS_PASSAGE_NONE ? RIIS_FIRST_PASSAGE_NONE : RIIS_FIRST_PASSAGE_FOUND;
    return is_open;
  };
  bool is_open = is_open_at(0);
  if (is_open) first.state = RIIS_FIRST_PASSAGE_ALWAYS;
  if (first.state != RIIS_FIRST_PASSAGE_FOUND) return first;
  for (int i = 1; i <= n_coarse && !is_open; ++i) is_open = is_open_at(static_cast<double>(i) / n_coarse);
  if (!is_open) {
    first.state = RIIS_FIRST_PASSAGE_NEVER;
    first.opening = first.closed_opening;
    return first;
  }
  while (first.opening - first.closed_opening > tolerance) is_open_at(0.5 * (first.closed_opening + first.opening));
  return first;
}

}  // namespace riis
