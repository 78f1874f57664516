/* SPDX-License-Identifier: Apache-2.0
 * Compares markings by the neighbour search with the exhaustive search. Include after searches.h. */
#ifndef RIIS_TEST_NEIGHBOR_CHECKS_H
#define RIIS_TEST_NEIGHBOR_CHECKS_H

/* Marks with both searches and compares their results. The neighbour search marks into `result`, or into a new result if it is
 * NULL. */
static inline riis_mark_stats check_same_as_exhaustive(const riis_surface *surface, const riis_mesh *mesh,
                                                       riis_mark_options options, riis_marks *result) {
  const int owned_before = n_owned();
  riis_marks *mine = result ? result : new_result(), *expected = new_result();
  options.search = RIIS_SEARCH_EXHAUSTIVE;
  CHECK_OK(riis_mark_nodes(surface, mesh, &options, expected));
  options.search = RIIS_SEARCH_NEIGHBOR;
  CHECK_OK(riis_mark_nodes(surface, mesh, &options, mine));
  const riis_mark_stats stats = stats_of(mine);
  if (!same_results(mine, expected))
    fail_msg("%lld nodes within the limit instead of %lld, %lld marked instead of %lld; or not the same bits",
             (long long)stats.n_within_limit, (long long)stats_of(expected).n_within_limit, (long long)stats.n_marked,
             (long long)stats_of(expected).n_marked);
  assert_int_equal(stats.search, RIIS_SEARCH_NEIGHBOR);
  assert_int_equal(stats.complete, 1);
  assert_int_equal(stats.n_nodes, stats_of(expected).n_nodes);
  assert_int_equal(stats.n_within_limit, within_in(mine).n);
  assert_int_equal(stats.n_marked, marked_in(mine).n);
  assert_true(stats.n_unreached >= 0 && stats.n_unreached <= stats.n_within_limit);
  assert_true(stats.n_threads >= 1 && (options.n_threads == 0 || stats.n_threads <= options.n_threads));
  free_owned_after(owned_before);
  return stats;
}

static inline riis_marks *marked_by(const riis_surface *surface, const riis_mesh *mesh, int32_t search,
                                    int32_t n_threads, const uint8_t *mask) {
  riis_marks *result = new_result();
  riis_mark_options options = mark_options();
  options.search = search;
  options.n_threads = n_threads;
  options.node_mask = mask;
  CHECK_OK(riis_mark_nodes(surface, mesh, &options, result));
  return result;
}

/* Makes the surface of the default aortic valve with this half thickness. */
static inline riis_surface *aortic_band(double half_thickness) {
  riis_surface_options options = surface_options();
  options.half_thickness = half_thickness;
  options.tolerance = 0.2;
  return aortic_surface(&options);
}

#endif
