/* SPDX-License-Identifier: Apache-2.0
 * Compares markings by the search over clusters with the exhaustive search. Include after searches.h. */
#ifndef RIIS_TEST_CLUSTER_CHECKS_H
#define RIIS_TEST_CLUSTER_CHECKS_H

static random_source rng;

/* Returns whether riis refused the call because this processor lacks the instructions. */
static inline int is_refused(riis_status status, int32_t instructions) {
  if (status == RIIS_OK) return 0;
  char text[64];
  snprintf(text, sizeof text, "options.instructions is %d, which this processor lacks", instructions);
  assert_true(instructions > RIIS_INSTRUCTIONS_BASELINE);
  CHECK_REFUSED(RIIS_UNAVAILABLE, text, status);
  return 1;
}

static int32_t most_threads; /* the largest number of threads in any marking */
static int64_t most_within;

/* Marks with every instruction set, and with 1 to max_threads threads. Checks that each marking uses expected_search. If `fresh`
 * is not 0, each marking gets a new mesh. */
static inline void check_with(const riis_surface *surface, riis_mesh *mesh, riis_mark_options options, int max_threads,
                              int32_t expected_search) {
  const int owned_before = n_owned();
  riis_marks *expected = new_result(), *result = new_result();
  options.search = RIIS_SEARCH_EXHAUSTIVE;
  options.instructions = RIIS_INSTRUCTIONS_BASELINE;
  options.n_threads = 1;
  CHECK_OK(riis_mark_nodes(surface, mesh, &options, expected));
  int n_sets = 0;
  for (int32_t set = RIIS_INSTRUCTIONS_BASELINE; set <= RIIS_INSTRUCTIONS_AVX512; ++set)
    for (int threads = 1; threads <= max_threads; ++threads) {
      options.search = RIIS_SEARCH_CLUSTERS;
      options.instructions = set;
      options.n_threads = threads;
      if (is_refused(riis_mark_nodes(surface, mesh, &options, result), set)) break;
      const riis_mark_stats stats = stats_of(result), of_expected = stats_of(expected);
      if (!same_results(result, expected))
        fail_msg(
            "instructions %d, %d threads: %lld nodes within %g instead of %lld, %lld marked instead of %lld; or not "
            "the same bits",
            set, threads, (long long)stats.n_within_limit, options.distance_limit,
            (long long)of_expected.n_within_limit, (long long)stats.n_marked, (long long)of_expected.n_marked);
      assert_int_equal(stats.search, expected_search);
      assert_int_equal(stats.instructions, set);
      assert_int_equal(stats.complete, 1);
      assert_int_equal(stats.n_unreached, 0);
      assert_int_equal(stats.n_nodes, of_expected.n_nodes);
      assert_true(stats.n_threads >= 1 && stats.n_threads <= threads);
      if (stats.n_threads > most_threads) most_threads = stats.n_threads;
      if (stats.n_within_limit > most_within) most_within = stats.n_within_limit;
      n_sets += threads == 1;
    }
  assert_true(n_sets >= 1);
  free_owned_after(owned_before);
}

/* Writes a random point of the surface's triangles, shifted by at most `off`. */
static inline void point_near(const riis_surface *surface, double off, double *p) {
  const riis_triangles all = triangles_of(surface);
  const int64_t *id = all.vertex_id + 3 * (random_bits(&rng) % (uint64_t)all.n_triangles);
  double w[3] = {random_between(&rng, 0, 1), 0, 0};
  w[1] = random_between(&rng, 0, 1) * (1 - w[0]), w[2] = 1 - w[0] - w[1];
  if (random_bits(&rng) % 3 == 0) w[0] = 1, w[1] = w[2] = 0;
  for (int c = 0; c < 3; ++c) {
    p[c] = off * random_between(&rng, -1, 1);
    for (int k = 0; k < 3; ++k) p[c] += w[k] * all.xyz[3 * id[k] + c];
  }
}

#endif
