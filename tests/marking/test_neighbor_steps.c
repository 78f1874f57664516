/* SPDX-License-Identifier: Apache-2.0
 * Tests the neighbour search from step to step. Valves and nodes move, two meshes exchange their results, and some calls are
 * refused. */
#include <riis/riis.h>

#include "test_support.h"

#include "handles.h"
#include "searches.h"

#include "neighbor_checks.h"

static random_source rng;

static riis_surface *mitral_surface(double opening) {
  riis_valve *valve = new_valve("mitral");
  CHECK_OK(riis_valve_set_scalar(valve, "opening", opening));
  riis_surface *surface = new_surface(valve, NULL);
  free_one_owned(valve);
  return surface;
}

/* --- From step to step ----------------------------------------------------------------------------------------------- */

TEST(a_valve_moves) {
  riis_surface *surface = mitral_surface(0);
  test_mesh nodes = lattice_around(surface, 0.12, 0.8);
  riis_mesh *mesh = mesh_from(&nodes);
  riis_marks *result = new_result();
  riis_valve *valve = new_valve("mitral");
  int64_t n_unreached = 0, n_marked = 0;
  for (int step = 0; step < 20; ++step) {
    CHECK_OK(riis_valve_set_scalar(valve, "opening", step / 19.0));
    CHECK_OK(riis_surface_update(surface, valve, NULL));
    riis_mark_options options = mark_options();
    options.n_threads = 1 + step % 3;
    const riis_mark_stats stats = check_same_as_exhaustive(surface, mesh, options, result);
    assert_true(stats.n_marked > 1000);
    n_unreached += stats.n_unreached, n_marked += stats.n_marked;
  }
  assert_true(n_unreached < n_marked / 10); /* the walk reaches most nodes, because the last marking is a good start */
}

TEST(a_valve_jumps) {
  riis_valve *valve = new_valve("aortic");
  riis_surface *surface = new_surface(valve, NULL);
  const int64_t counts[3] = {60, 30, 30};
  const double lower[3] = {-1.7, -1.7, -1.6}, upper[3] = {9, 1.7, 0.6};
  test_mesh nodes = lattice(counts, lower, upper);
  riis_mesh *mesh = mesh_from(&nodes);
  riis_marks *result = new_result();
  riis_surface_options options = surface_options();
  static const double x[10] = {0, 7, 0, 100, 0.01, 0, 4, 4.5, -50, 7}; /* some positions are outside the mesh */
  for (int step = 0; step < 10; ++step) {
    options.translation[0] = x[step];
    CHECK_OK(riis_surface_update(surface, valve, &options));
    const riis_mark_stats stats = check_same_as_exhaustive(surface, mesh, mark_options(), result);
    assert_int_equal(stats.n_marked > 0, fabs(x[step]) < 10);
    /* After the valve jumps to another place, the earlier marking does not help. The final check then finds all nodes. */
    if (step == 1 || step == 2) assert_int_equal(stats.n_unreached, stats.n_within_limit);
  }
}

TEST(a_result_goes_from_mesh_to_mesh) {
  riis_surface *surface = aortic_surface(NULL);
  test_mesh a = lattice_around(surface, 0.15, 0.2), b = lattice_around(surface, 0.11, 0.3),
            c = lattice_around(surface, 0.15, 0.2);
  for (int64_t i = c.n - 1; i > 0; --i) /* mesh c has as many nodes as mesh a, at other positions */
    for (int k = 0; k < 3; ++k) {
      const int64_t j = (int64_t)(random_bits(&rng) % (uint64_t)i);
      const double swap = c.xyz[3 * i + k];
      c.xyz[3 * i + k] = c.xyz[3 * j + k], c.xyz[3 * j + k] = swap;
    }
  riis_mesh *mesh[3] = {mesh_from(&a), mesh_from(&b), mesh_from(&c)};
  riis_marks *result = new_result();
  for (int step = 0; step < 30; ++step) {
    riis_mark_options options = mark_options();
    options.n_threads = 1 + (int)(random_bits(&rng) % 3);
    if (step % 5 == 4) { /* another search runs in between */
      options.search = step % 2 ? RIIS_SEARCH_EXHAUSTIVE : RIIS_SEARCH_PAPER;
      CHECK_OK(riis_mark_nodes(surface, mesh[random_bits(&rng) % 3], &options, result));
    }
    check_same_as_exhaustive(surface, mesh[random_bits(&rng) % 3], options, result);
  }
}

/* The test makes more steps than a counter of 8 bits can count. */
TEST(many_steps) {
  riis_surface *surface = aortic_band(0.1);
  test_mesh nodes = lattice_around(surface, 0.3, 0.2);
  riis_mesh *mesh = mesh_from(&nodes);
  riis_marks *result = new_result();
  riis_mark_options options = mark_options();
  options.n_threads = 1;
  for (int step = 0; step < 600; ++step) check_same_as_exhaustive(surface, mesh, options, result);
}

TEST(nodes_move) {
  riis_surface *surface = aortic_surface(NULL);
  test_mesh nodes = lattice_around(surface, 0.12, 0.3);
  riis_mesh *mesh = mesh_from(&nodes);
  riis_marks *result = new_result();
  double *moved = own(malloc((size_t)nodes.n * 3 * sizeof *moved));
  for (int step = 0; step < 12; ++step) {
    const double shift = step < 8 ? 0.03 * step : 1000 * (step % 2),
                 mix = step == 5 ? 3 : 0.05; /* in step 5, all nodes get new positions */
    for (int64_t i = 0; i < 3 * nodes.n; ++i) {
      moved[i] = nodes.xyz[i] + shift + random_between(&rng, -mix, mix);
      if (step % 2 == 0) nodes.xyz[i] = moved[i]; /* changes the coordinates in place, or passes another array */
    }
    const double *now = step % 2 == 0 ? nodes.xyz : moved;
    CHECK_OK(riis_mesh_update(mesh, nodes.n, now, now + 1, now + 2, 3));
    check_same_as_exhaustive(surface, mesh, mark_options(), result);
    check_same_as_exhaustive(surface, mesh, mark_options(), NULL);
  }
  /* If the number of nodes changes, the mesh loses its adjacency. With an adjacency for the new nodes, the search runs again. */
  const int64_t fewer = nodes.n / 2;
  CHECK_OK(riis_mesh_update(mesh, fewer, nodes.xyz, nodes.xyz + 1, nodes.xyz + 2, 3));
  riis_mark_options options = mark_options();
  options.search = RIIS_SEARCH_NEIGHBOR;
  CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "options.search is 2|riis_mesh_set_adjacency",
                riis_mark_nodes(surface, mesh, &options, result));
  test_mesh half = {.n = fewer, .xyz = nodes.xyz};
  set_rows(&half, 0, NULL);
  const riis_csr csr = csr_of(&half);
  CHECK_OK(riis_mesh_set_adjacency(mesh, &csr));
  check_same_as_exhaustive(surface, mesh, options, result);
}

/* Before the first search or between two searches, coordinates become infinite or NaN without an update of the handle. */
TEST(non_finite_coordinates_are_refused) {
  static const double bad[3] = {NAN, INFINITY, -INFINITY};
  riis_surface *surface = aortic_surface(NULL);
  test_mesh nodes = lattice_around(surface, 0.13, 0.15);
  riis_marks *expected = NULL;
  for (int trial = 0; trial < trials_of(108); ++trial) {
    riis_mesh *mesh = mesh_from(&nodes);
    riis_marks *result = new_result();
    riis_mark_options options = mark_options();
    options.search = RIIS_SEARCH_NEIGHBOR;
    options.n_threads = 1 + trial % 2;
    if (!expected) expected = marked_by(surface, mesh, RIIS_SEARCH_EXHAUSTIVE, 1, NULL);
    const found_nodes marked = marked_in(expected);
    const int is_first_search = trial % 4 < 2;
    if (!is_first_search) CHECK_OK(riis_mark_nodes(surface, mesh, &options, result));
    /* A node of the band is always queried, so its bad coordinate is noticed. */
    const int64_t node = marked.node_id[random_bits(&rng) % (uint64_t)marked.n];
    double *coordinate = nodes.xyz + 3 * node + trial % 3;
    const double good = *coordinate;
    *coordinate = bad[trial / 4 % 3];
    char text[64];
    snprintf(text, sizeof text, "%c of node %lld is %s", "xyz"[trial % 3], (long long)node,
             trial / 4 % 3 ? "inf" : "nan");
    if (trial / 4 % 3 == 2) snprintf(text, sizeof text, "of node %lld is -inf", (long long)node);
    CHECK_REFUSED(RIIS_INVALID_MESH, text, riis_mark_nodes(surface, mesh, &options, result));
    assert_int_equal(marked_in(result).n, is_first_search ? 0 : marked.n); /* the marks stay as they were */
    if (!is_first_search) assert_true(same_results(result, expected));
    *coordinate = good;
    if (is_first_search) CHECK_OK(riis_mesh_update(mesh, nodes.n, nodes.xyz, nodes.xyz + 1, nodes.xyz + 2, 3));
    CHECK_OK(riis_mark_nodes(surface, mesh, &options, result)); /* the next search succeeds */
    assert_true(same_results(result, expected));
    free_one_owned(result);
    free_one_owned(mesh);
  }
}

/* Nodes that moved in place are searched at their new positions, even if an update has refused these coordinates. */
TEST(a_refused_update_forgets_where_nodes_were) {
  riis_surface *surface = aortic_surface(NULL);
  test_mesh nodes = lattice_around(surface, 0.13, 0.15);
  riis_mesh *mesh = mesh_from(&nodes);
  riis_marks *result = new_result();
  riis_mark_options options = mark_options();
  options.search = RIIS_SEARCH_NEIGHBOR;
  for (int64_t i = 0; i < nodes.n; ++i) nodes.xyz[3 * i] += 50;
  CHECK_OK(riis_mesh_update(mesh, nodes.n, nodes.xyz, nodes.xyz + 1, nodes.xyz + 2, 3));
  CHECK_OK(riis_mark_nodes(surface, mesh, &options, result));
  assert_int_equal(stats_of(result).n_marked, 0);
  for (int64_t i = 0; i < nodes.n; ++i) nodes.xyz[3 * i] -= 50;
  const double good = nodes.xyz[3];
  nodes.xyz[3] = NAN;
  CHECK_REFUSED(RIIS_INVALID_MESH, "x of node 1 is nan",
                riis_mesh_update(mesh, nodes.n, nodes.xyz, nodes.xyz + 1, nodes.xyz + 2, 3));
  CHECK_REFUSED(RIIS_INVALID_MESH, "x of node 1 is nan", riis_mark_nodes(surface, mesh, &options, result));
  nodes.xyz[3] = good;
  CHECK_OK(riis_mark_nodes(surface, mesh, &options, result));
  riis_marks *expected = marked_by(surface, mesh, RIIS_SEARCH_EXHAUSTIVE, 1, NULL);
  assert_true(stats_of(expected).n_marked > 0 && same_results(result, expected));
}

int main(void) {
  rng = random_start("test_neighbor_steps");
  return run_cases(NULL, NULL);
}
