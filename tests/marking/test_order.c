/* SPDX-License-Identifier: Apache-2.0
 * The library sorts the found nodes in the lists of several threads. The test compares the order of random nodes with a sort.
 * Meshes have up to 2^33 nodes, so a bin has from 4096 to 2^25 numbers. */
#include <stdlib.h>

#include "internals.h"
#include "test_support.h"

#include "handles.h"

static random_source rng;

typedef struct found_node {
  int64_t node;
  double distance;
  int64_t triangle;
} found_node;

static int by_node(const void *a, const void *b) {
  const int64_t p = ((const found_node *)a)->node, q = ((const found_node *)b)->node;
  return (p > q) - (p < q);
}

static int64_t below(int64_t n) { return (int64_t)(random_bits(&rng) % (uint64_t)n); }

/* The numbers of the nodes are spread over the mesh, or lie in a range about twice as long as their count. */
TEST(nodes_ascend) {
  enum { most = 20000 };
  static found_node sorted[most];
  static int64_t node[most], triangle[most], within_node[most], within_triangle[most], marked_node[most];
  static double distance[most], within_distance[most], marked_distance[most];
  const riis_surface *surface = surface_of_kind("aortic", NULL);
  riis_surface_info info;
  CHECK_OK(riis_surface_get_info(surface, &info, sizeof info));
  for (int trial = 0; trial < trials(300, 3000); ++trial) {
    const int64_t n_nodes = (int64_t)random_power_of_ten(&rng, 0, trial % 4 == 0 ? 9.9 : 6.5);
    int64_t n = trial % 3 == 0 ? below(100) : below(most);
    const int64_t range = trial % 2 ? n_nodes : n_nodes < 2 * n + 1 ? n_nodes : 2 * n + 1;
    const int64_t first = below(n_nodes - range + 1);
    for (int64_t i = 0; i < n; ++i)
      sorted[i] =
          (found_node){first + below(range), random_between(&rng, 0, 2 * info.half_thickness), below(info.n_triangles)};
    qsort(sorted, (size_t)n, sizeof *sorted, by_node);
    int64_t n_kept = 0; /* each node once */
    for (int64_t i = 0; i < n; ++i)
      if (i == 0 || sorted[i].node != sorted[i - 1].node) sorted[n_kept++] = sorted[i];
    n = n_kept;
    /* The lists get the nodes in a random order. Some lists stay empty. */
    enum { most_lists = 20 };
    const int n_lists = 1 + (int)below(most_lists), n_threads = 1 + (int)below(4), is_wider = (int)below(2);
    int64_t end[most_lists];
    for (int64_t i = 0; i < n; ++i) {
      const int64_t k = below(i + 1);
      node[i] = node[k], distance[i] = distance[k], triangle[i] = triangle[k];
      node[k] = sorted[i].node, distance[k] = sorted[i].distance, triangle[k] = sorted[i].triangle;
    }
    for (int list = 0; list < n_lists; ++list) {
      const int64_t begin = list == 0 ? 0 : end[list - 1];
      end[list] = list == n_lists - 1 ? n : begin + (below(3) ? below(n - begin + 1) : 0);
    }
    const int64_t n_marked =
        order_found_nodes(surface, n_nodes, n_threads, is_wider, n_lists, end, node, distance, triangle, within_node,
                          within_distance, within_triangle, marked_node, marked_distance);
    int64_t n_expected = 0;
    for (int64_t i = 0; i < n; ++i) {
      if (within_node[i] != sorted[i].node || within_distance[i] != sorted[i].distance ||
          within_triangle[i] != sorted[i].triangle)
        fail_msg("trial %d: entry %lld of %lld, %lld nodes", trial, (long long)i, (long long)n, (long long)n_nodes);
      if (!is_wider || sorted[i].distance > info.half_thickness) continue;
      assert_true(n_expected < n_marked);
      if (marked_node[n_expected] != sorted[i].node || marked_distance[n_expected] != sorted[i].distance)
        fail_msg("trial %d: marked entry %lld, %lld nodes", trial, (long long)n_expected, (long long)n_nodes);
      ++n_expected;
    }
    assert_int_equal(n_marked, is_wider ? n_expected : -1);
  }
}

int main(void) {
  rng = random_start("test_order");
  return run_cases(NULL, NULL);
}
