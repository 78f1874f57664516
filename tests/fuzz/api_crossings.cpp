// SPDX-License-Identifier: Apache-2.0
// Calls of riis_find_crossings and riis_surface_crossing_pairs.
#include <algorithm>
#include <cmath>
#include <cstring>

#include "api_state.hpp"

namespace fuzz {
namespace {

struct PairList {
  std::int64_t n = -9;
  const std::int64_t *triangle_id = nullptr;
  const double *point = nullptr, *depth = nullptr, *length = nullptr;
};

PairList pairs_of(const riis_surface *surface) {
  PairList p;
  EXPECT_OK(riis_surface_crossing_pairs(surface, &p.n, &p.triangle_id, &p.point, &p.depth, &p.length));
  EXPECT((p.n > 0) == (p.depth != nullptr), "%lld pairs", static_cast<long long>(p.n));
  return p;
}

// Checks that the pairs ascend and agree with the summary. test_self_crossings.c checks that they are the right ones.
void check_pairs(const riis_surface *surface, const riis_crossings &crossings, double depth) {
  riis_surface_info info;
  EXPECT_OK(riis_surface_get_info(surface, &info, sizeof info));
  const PairList p = pairs_of(surface);
  double deepest = 0, length = 0;
  for (std::int64_t i = 0; i < p.n; ++i) {
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
  EXPECT(crossings.n_pairs == p.n && crossings.depth == deepest && crossings.length == length && crossings.seconds >= 0,
         "%lld pairs", static_cast<long long>(crossings.n_pairs));
  EXPECT((p.n > 0) == (crossings.triangle_id[0] >= 0), "triangle %lld",
         static_cast<long long>(crossings.triangle_id[0]));
}

}  // namespace

void find_crossings(Input &in, State &state) {
  riis_surface *slot = state.surfaces[in.slot()];
  const Given<riis_surface> surface = given(in, state, State::surface, slot);
  riis_crossing_options options = initialised(in, riis_crossing_options_init);
  options.n_threads = in.n_threads();
  if (in.one_in(2)) options.depth = in.number();
  const riis_crossing_options *how = in.one_in(4) ? nullptr : &options;
  riis_crossings crossings;
  std::memset(static_cast<void *>(&crossings), 0x5a, sizeof crossings);
  const std::int64_t n_before = slot ? pairs_of(slot).n : -1;
  const std::int64_t size = in.mostly<std::int64_t>(sizeof crossings);
  const riis_status status =
      call(in, [&] { return riis_find_crossings(surface.handle, how, mostly(in, &crossings), size); });
  if (!surface.is_right) EXPECT(status == RIIS_INVALID_ARGUMENT, "%d", status);
  if (status != RIIS_OK) {
    EXPECT(crossings.n_pairs == 0x5a5a5a5a5a5a5a5a, "refused crossings were written");
    EXPECT(!slot || pairs_of(slot).n == n_before, "a refused call changed the pairs");
    return;
  }
  EXPECT(!how || (options.depth >= 0 && options.depth <= 1), "depth %g", options.depth);
  check_pairs(slot, crossings, how ? options.depth : 1e-6);
}

}  // namespace fuzz
