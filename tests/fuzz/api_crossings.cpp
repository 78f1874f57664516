// SPDX-License-Identifier: Apache-2.0
// Calls of riis_find_crossings.
#include <algorithm>
#include <cmath>

#include "api_state.hpp"

namespace fuzz {
namespace {

riis_crossing_list list_of(const riis_crossings *crossings) {
  riis_crossing_list list;
  EXPECT_OK(riis_crossings_get_list(crossings, &list, sizeof list));
  EXPECT((list.n_pairs > 0) == (list.depth != nullptr), "%lld pairs", static_cast<long long>(list.n_pairs));
  return list;
}

// Checks that the pairs are in ascending order and agree with the summary. test_self_crossings.c checks whether the pairs are
// right.
void check_pairs(const riis_surface *surface, const riis_crossing_list &p, double depth) {
  riis_surface_info info;
  EXPECT_OK(riis_surface_get_info(surface, &info, sizeof info));
  double deepest = 0, length = 0;
  for (std::int64_t i = 0; i < p.n_pairs; ++i) {
    const std::int64_t *id = p.triangle_id + 2 * i;
    EXPECT(id[0] >= 0 && id[0] < id[1], "pair %lld", static_cast<long long>(i));
    EXPECT(i == 0 || std::lexicographical_compare(id - 2, id, id, id + 2), "pair %lld", static_cast<long long>(i));
    EXPECT(p.depth[i] > depth * info.half_thickness && p.length[i] >= 0, "depth %g, length %g", p.depth[i],
           p.length[i]);
    for (int axis = 0; axis < 3; ++axis)
      EXPECT(std::isfinite(p.point[3 * i + axis]), "pair %lld", static_cast<long long>(i));
    deepest = std::max(deepest, p.depth[i]);
    length += p.length[i];
  }
  EXPECT(p.deepest_depth == deepest && p.total_length == length && p.seconds >= 0, "%lld pairs",
         static_cast<long long>(p.n_pairs));
  EXPECT((p.n_pairs > 0) == (p.deepest_triangle_id[0] >= 0), "triangle %lld",
         static_cast<long long>(p.deepest_triangle_id[0]));
}

}  // namespace

void find_crossings(Input &in, State &state) {
  riis_surface *slot = state.surfaces[in.slot()];
  const Given<riis_surface> surface = given(in, state, State::surface, slot);
  riis_crossing_options options = initialised(in, riis_crossing_options_init);
  options.n_threads = in.n_threads();
  if (in.one_in(2)) options.depth = in.number();
  const riis_crossing_options *how = in.one_in(4) ? nullptr : &options;
  riis_crossings *&crossings_slot = state.crossings[in.slot()];
  if (!crossings_slot)
    crossings_slot = made_by<riis_crossings>(in, [](riis_crossings **made) { return riis_crossings_create(made); });
  if (!crossings_slot) return;
  const Given<riis_crossings> crossings = given(in, state, State::crossing, crossings_slot);
  const std::int64_t n_before = list_of(crossings_slot).n_pairs;
  const riis_status status = call(in, [&] { return riis_find_crossings(surface.handle, how, crossings.handle); });
  if (!(surface.is_right && crossings.is_right)) EXPECT(status == RIIS_INVALID_ARGUMENT, "%d", status);
  if (status != RIIS_OK) {
    EXPECT(list_of(crossings_slot).n_pairs == n_before, "a refused call changed the pairs");
    return;
  }
  EXPECT(!how || (options.depth >= 0 && options.depth <= 1), "depth %g", options.depth);
  check_pairs(slot, list_of(crossings_slot), how ? options.depth : 1e-6);
}

}  // namespace fuzz
