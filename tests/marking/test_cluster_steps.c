/* SPDX-License-Identifier: Apache-2.0
 * Tests the search over clusters from step to step, as the choice of RIIS_SEARCH_AUTO, and in simultaneous calls by several
 * threads. */
#include <omp.h>
#include <riis/riis.h>

#include "test_support.h"

#include "handles.h"
#include "searches.h"

#include "cluster_checks.h"

enum { max_nodes = 9000 };
static double xyz[3 * max_nodes];

/* --- From step to step ----------------------------------------------------------------------------------------------- */

TEST(nodes_and_valve_move) {
  enum { n = 9000 };
  riis_valve *valve = new_valve("mitral");
  riis_surface *surface = new_surface(valve, NULL);
  for (int i = 0; i < 3 * n; ++i) xyz[i] = random_between(&rng, -2, 2);
  static double other[3 * n];
  memcpy(other, xyz, sizeof other);
  riis_mesh *mesh = mesh_of(n, xyz);
  riis_mark_options options = mark_options();
  for (int step = 0; step < 8; ++step) {
    check_with(surface, mesh, options, 2, RIIS_SEARCH_CLUSTERS);
    const double turn = 0.3 * step, grow = step == 5 ? 40 : 1; /* step 5 moves nodes far apart, step 6 at random */
    double *to = step % 2 ? xyz : other;
    for (int i = 0; i < n; ++i) {
      const double *p = (step % 2 ? other : xyz) + 3 * i, x = p[0], y = p[1];
      to[3 * i] = grow * (x * cos(turn) - y * sin(turn)), to[3 * i + 1] = grow * (x * sin(turn) + y * cos(turn)),
             to[3 * i + 2] = p[2];
    }
    for (int i = 0; i < 3 * n && step == 6; ++i) to[i] = random_between(&rng, -2, 2);
    const int64_t n_now = step == 3 ? 77 : step == 4 ? n - 5 : n;
    CHECK_OK(riis_mesh_update(mesh, n_now, to, to + 1, to + 2, 3));
    CHECK_OK(riis_valve_set_scalar(valve, "opening", 0));
    CHECK_OK(riis_surface_update(surface, valve, NULL));
  }
}

/* The nodes move before they are sorted, without a call of riis_mesh_update. The clusters contain the nodes at their present
 * positions, however far the nodes moved. */
TEST(nodes_that_moved_without_a_word) {
  riis_surface *surface = aortic_surface(NULL);
  riis_mark_options options = mark_options();
  riis_marks *result = new_result(), *expected = new_result();
  for (int trial = 0; trial < trials_of(40); ++trial) {
    const int owned_before = n_owned();
    const double far = trial % 4 ? random_power_of_ten(&rng, -12, 50) : 0;
    for (int i = 0; i < 3 * max_nodes; ++i) xyz[i] = random_between(&rng, -far, far);
    riis_mesh *mesh = mesh_of(max_nodes, xyz);
    for (int i = 0; i < max_nodes; ++i) point_near(surface, 0.2, xyz + 3 * i);
    options.search = RIIS_SEARCH_CLUSTERS;
    options.n_threads = 1 + trial % 2;
    CHECK_OK(riis_mark_nodes(surface, mesh, &options, result));
    CHECK_OK(riis_mark_nodes(surface, mesh_of(max_nodes, xyz), &options, expected));
    assert_true(same_results(result, expected));
    assert_true(marked_in(result).n > max_nodes / 10);
    free_owned_after(owned_before);
  }
}

TEST(non_finite_coordinates) {
  enum { n = 3000 };
  riis_surface *surface = aortic_surface(NULL);
  for (int i = 0; i < n; ++i) point_near(surface, 0.2, xyz + 3 * i);
  riis_marks *result = new_result(), *kept = new_result();
  riis_mark_options options = mark_options();
  options.search = RIIS_SEARCH_CLUSTERS;
  const double spoilt[] = {NAN, INFINITY, -INFINITY, 1e61};
  for (int k = 0; k < 4; ++k)
    for (int threads = 1; threads <= 3; threads += 2)
      for (int made_before = 0; made_before < 3; ++made_before) {
        const int owned_before = n_owned();
        const int which = 1 + 3 * (int)(random_bits(&rng) % n);
        const double was = xyz[which];
        riis_mesh *mesh = mesh_of(n, xyz);
        options.n_threads = threads;
        CHECK_OK(riis_mark_nodes(surface, mesh, &options, kept));
        CHECK_OK(riis_mark_nodes(surface, mesh, &options, result));
        if (made_before < 2) { /* otherwise the mesh keeps its clusters, and the next marking uses them unchanged */
          free_one_owned(mesh);
          mesh = mesh_of(n, xyz);
        }
        /* The next marking must make clusters or update the positions in earlier clusters. */
        if (made_before == 1) {
          CHECK_OK(riis_mesh_prepare(mesh, threads));
          CHECK_OK(riis_mesh_update(mesh, n, xyz, xyz + 1, xyz + 2, 3));
        }
        xyz[which] = spoilt[k];
        if (made_before < 2) CHECK_REFUSED(RIIS_INVALID_MESH, "node", riis_mesh_prepare(mesh, threads));
        const riis_status status = riis_mark_nodes(surface, mesh, &options, result);
        if (made_before < 2 || status) CHECK_REFUSED(RIIS_INVALID_MESH, "node", status);
        assert_true(same_results(result, kept));
        CHECK_REFUSED(RIIS_INVALID_MESH, "node", riis_mesh_update(mesh, n, xyz, xyz + 1, xyz + 2, 3));
        CHECK_REFUSED(RIIS_INVALID_MESH, "node", riis_mark_nodes(surface, mesh, &options, result));
        assert_true(same_results(result, kept));
        xyz[which] = was;
        CHECK_OK(riis_mark_nodes(surface, mesh, &options, result));
        assert_int_equal(stats_of(result).search, RIIS_SEARCH_CLUSTERS);
        assert_true(same_results(result, kept));
        free_owned_after(owned_before);
      }
}

static int32_t search_of(const riis_surface *surface, const riis_mesh *mesh, int32_t asked_for) {
  riis_marks *result = new_result();
  riis_mark_options options = mark_options();
  options.search = asked_for;
  CHECK_OK(riis_mark_nodes(surface, mesh, &options, result));
  const int32_t search = stats_of(result).search;
  free_one_owned(result);
  return search;
}

/* RIIS_SEARCH_AUTO is exhaustive for the first marking of a mesh, and uses clusters for later markings. In a prepared mesh, the
 * first marking also uses clusters. */
TEST(what_auto_is) {
  enum { n = 200 };
  riis_surface *surface = aortic_surface(NULL);
  for (int i = 0; i < n; ++i) point_near(surface, 0.2, xyz + 3 * i);
  riis_mesh *mesh = mesh_of(n, xyz);
  const int32_t any = RIIS_SEARCH_AUTO;
  assert_int_equal(search_of(surface, mesh, any), RIIS_SEARCH_EXHAUSTIVE);
  assert_int_equal(search_of(surface, mesh, any), RIIS_SEARCH_CLUSTERS);
  CHECK_OK(riis_mesh_update(mesh, n, xyz, xyz + 1, xyz + 2, 3));
  assert_int_equal(search_of(surface, mesh, any), RIIS_SEARCH_CLUSTERS);
  CHECK_OK(riis_mesh_update(mesh, n - 1, xyz, xyz + 1, xyz + 2, 3)); /* the mesh has other nodes now */
  assert_int_equal(search_of(surface, mesh, any), RIIS_SEARCH_EXHAUSTIVE);
  assert_int_equal(search_of(surface, mesh, any), RIIS_SEARCH_CLUSTERS);
  free_one_owned(mesh);
  mesh = mesh_of(n, xyz);
  CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "n_threads is -1", riis_mesh_prepare(mesh, -1));
  CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "n_threads is 1025", riis_mesh_prepare(mesh, 1025));
  CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "mesh is NULL", riis_mesh_prepare(NULL, 1));
  CHECK_OK(riis_mesh_prepare(mesh, 0));
  CHECK_OK(riis_mesh_prepare(mesh, 2));
  assert_int_equal(search_of(surface, mesh, any), RIIS_SEARCH_CLUSTERS);
  CHECK_OK(riis_mesh_update(mesh, n, xyz, xyz + 1, xyz + 2, 3)); /* an update of positions keeps the clusters */
  assert_int_equal(search_of(surface, mesh, any), RIIS_SEARCH_CLUSTERS);
  free_one_owned(mesh);
  mesh = mesh_of(n, xyz);
  CHECK_OK(riis_mesh_prepare(mesh, 1));
  CHECK_OK(riis_mesh_update(mesh, n, xyz, xyz + 1, xyz + 2, 3));
  assert_int_equal(search_of(surface, mesh, any), RIIS_SEARCH_CLUSTERS);
  free_one_owned(mesh);
  mesh = mesh_of(n, xyz); /* an earlier marking leads to clusters, whatever its search */
  assert_int_equal(search_of(surface, mesh, RIIS_SEARCH_EXHAUSTIVE), RIIS_SEARCH_EXHAUSTIVE);
  assert_int_equal(search_of(surface, mesh, any), RIIS_SEARCH_CLUSTERS);
}

/* --- Threads --------------------------------------------------------------------------------------------------------- */

/* Returns 1 if a marking differs from the expected marking. The mesh may be new to all threads. */
static int marks_wrong(const riis_surface *surface, riis_mesh *mesh, const riis_marks *expected, int n_threads,
                       int prepares) {
  riis_mark_options options = {0};
  riis_marks *result = NULL;
  int wrong = riis_mark_options_init(&options, sizeof options) || riis_marks_create(&result);
  options.search = RIIS_SEARCH_CLUSTERS;
  options.n_threads = n_threads;
  if (prepares) wrong = wrong || riis_mesh_prepare(mesh, n_threads);
  for (int step = 0; step < 2; ++step)
    wrong = wrong || riis_mark_nodes(surface, mesh, &options, result) || !same_results(result, expected);
  riis_marks_destroy(&result);
  return wrong;
}

/* The thread sanitizer misses the end of an OpenMP team inside another team. If another team reuses the stack of the team that
 * ended, the sanitizer reports a race. */
#if defined(__has_feature)
#if __has_feature(thread_sanitizer)
#define RIIS_TEST_MOST_NESTED 1
#endif
#endif
#ifndef RIIS_TEST_MOST_NESTED
#define RIIS_TEST_MOST_NESTED 2
#endif

TEST(several_callers_of_one_mesh) {
  riis_surface *surface = aortic_surface(NULL);
  test_mesh nodes = lattice_around(surface, 0.1, 0.2);
  riis_mesh *mesh = mesh_of(nodes.n, nodes.xyz);
  riis_marks *expected = new_result();
  riis_mark_options options = mark_options();
  options.search = RIIS_SEARCH_EXHAUSTIVE;
  CHECK_OK(riis_mark_nodes(surface, mesh, &options, expected));
  const int levels = omp_get_max_active_levels();
  for (int n_threads = 1; n_threads <= 3; ++n_threads)
    for (int nested = 1; nested <= RIIS_TEST_MOST_NESTED; ++nested)
      for (int moved = 0; moved < 2; ++moved) {
        int n_wrong = 0;
        free_one_owned(mesh);
        mesh = mesh_of(nodes.n, nodes.xyz);
        if (moved) { /* these clusters only need new positions */
          CHECK_OK(riis_mesh_prepare(mesh, 1));
          CHECK_OK(riis_mesh_update(mesh, nodes.n, nodes.xyz, nodes.xyz + 1, nodes.xyz + 2, 3));
        }
        omp_set_max_active_levels(nested);
#pragma omp parallel num_threads(4) reduction(+ : n_wrong)
        n_wrong += marks_wrong(surface, mesh, expected, n_threads, omp_get_thread_num() % 2);
        assert_int_equal(n_wrong, 0);
      }
  omp_set_max_active_levels(levels);
}

/* The mesh has so many nodes that several threads sort it together. */
TEST(a_mesh_that_threads_sort_together) {
  const int64_t n = 300000;
  riis_surface *surface = aortic_surface(NULL);
  double *many = own(malloc((size_t)n * 3 * sizeof *many));
  for (int64_t i = 0; i < n; ++i)
    if (i % 8 == 0)
      point_near(surface, 0.2, many + 3 * i);
    else
      for (int c = 0; c < 3; ++c) many[3 * i + c] = i % 8 == 1 ? 1.25 : random_between(&rng, -8, 8);
  riis_marks *one = new_result(), *result = new_result();
  riis_mark_options options = mark_options();
  options.search = RIIS_SEARCH_EXHAUSTIVE;
  for (int threads = 1; threads <= 3; ++threads) {
    const int owned_before = n_owned();
    riis_mesh *mesh = mesh_of(n, many);
    options.n_threads = threads;
    if (threads == 1) CHECK_OK(riis_mark_nodes(surface, mesh, &options, one));
    options.search = RIIS_SEARCH_CLUSTERS;
    CHECK_OK(riis_mesh_prepare(mesh, threads));
    CHECK_OK(riis_mark_nodes(surface, mesh, &options, result));
    assert_true(same_results(result, one));
    assert_true(marked_in(result).n > n / 50);
    free_owned_after(owned_before);
  }
}

int main(void) {
  rng = random_start("test_cluster_steps");
  return run_cases(NULL, NULL);
}
