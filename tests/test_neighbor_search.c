/* SPDX-License-Identifier: Apache-2.0
 * The neighbour search finds the same nodes as the exhaustive search, to the last bit, whatever the mesh, adjacency, mask,
 * limit, number of threads and last marking. The paper's own algorithm finds the piece of the band that it starts in, and
 * reports that it may be incomplete. */
#ifndef _GNU_SOURCE
#define _GNU_SOURCE /* dladdr, RTLD_DEFAULT */
#endif
#include <dlfcn.h>
#include <omp.h>
#include <pthread.h>
#include <riis/riis.h>

#include "test_support.h"

#include "handles.h"
#include "searches.h"

static random_source rng;

/* Marks by both searches and compares. The neighbour search marks into the result, or into a new one if NULL. */
static riis_mark_stats check_same_as_exhaustive(const riis_surface *surface, const riis_mesh *mesh,
                                                riis_mark_options options, riis_mark_result *result) {
  riis_mark_result *mine = result ? result : new_result(), *expected = new_result();
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
  riis_mark_result_destroy(&expected);
  if (!result) riis_mark_result_destroy(&mine);
  return stats;
}

static riis_mark_result *marked_by(const riis_surface *surface, const riis_mesh *mesh, int32_t search,
                                   int32_t n_threads, const uint8_t *mask) {
  riis_mark_result *result = new_result();
  riis_mark_options options = mark_options();
  options.search = search;
  options.n_threads = n_threads;
  options.node_mask = mask;
  CHECK_OK(riis_mark_nodes(surface, mesh, &options, result));
  return result;
}

/* The number of nodes that the paper's algorithm misses. The stats must not hide that it may miss some. */
static int64_t missed_by_the_paper(const riis_surface *surface, const riis_mesh *mesh, const uint8_t *mask) {
  riis_mark_result *paper = marked_by(surface, mesh, RIIS_SEARCH_PAPER, 2, mask);
  riis_mark_result *all = marked_by(surface, mesh, RIIS_SEARCH_EXHAUSTIVE, 2, mask);
  assert_int_equal(stats_of(paper).search, RIIS_SEARCH_PAPER);
  assert_int_equal(stats_of(paper).complete, 0);
  const int64_t missed = marked_in(all).n - marked_in(paper).n;
  riis_mark_result_destroy(&paper);
  riis_mark_result_destroy(&all);
  return missed;
}

static riis_surface *mitral_surface(double opening) {
  riis_valve *valve = NULL;
  riis_surface *surface = NULL;
  CHECK_OK(riis_valve_create("mitral", &valve));
  CHECK_OK(riis_valve_set_scalar(valve, "opening", opening));
  CHECK_OK(riis_surface_create(valve, NULL, &surface));
  riis_valve_destroy(&valve);
  return surface;
}

/* The default aortic valve with a half thickness. */
static riis_surface *aortic_band(double half_thickness) {
  riis_surface_options options = surface_options();
  options.half_thickness = half_thickness;
  options.tolerance = 0.2;
  return aortic_surface(&options);
}

/* --- Bands and meshes in pieces ------------------------------------------------------------------------------------ */

static void three_separate_cusps(void **state) {
  (void)state;
  static const char *const names[3] = {"right.translation", "left.translation", "non_coronary.translation"};
  static const double angle[3] = {0, 119.5, -121.5};
  riis_valve *valve = NULL;
  riis_surface *surface = NULL;
  CHECK_OK(riis_valve_create("aortic", &valve));
  for (int cusp = 0; cusp < 3; ++cusp) {
    const double a = angle[cusp] * 3.14159265358979323846 / 180, shift[3] = {cos(a), sin(a), -1};
    CHECK_OK(riis_valve_set(valve, names[cusp], 3, shift));
  }
  CHECK_OK(riis_surface_create(valve, NULL, &surface));
  test_mesh nodes = lattice_around(surface, 0.08, 0.15);
  riis_mesh *mesh = mesh_from(&nodes);
  const riis_mark_stats stats = check_same_as_exhaustive(surface, mesh, mark_options(), NULL);
  assert_int_equal(stats.n_unreached, 0); /* starts in every near ball reach all of a connected band */
  /* One start finds one cusp. */
  const int64_t missed = missed_by_the_paper(surface, mesh, NULL);
  assert_true(missed > stats.n_marked / 2 && missed < stats.n_marked);
  riis_mark_result *paper = marked_by(surface, mesh, RIIS_SEARCH_PAPER, 2, NULL);
  const found_nodes found = marked_in(paper);
  for (int64_t i = 0; i < found.n; ++i) assert_int_equal(found.leaflet_id[i], found.leaflet_id[0]);
  /* A walk that starts at these nodes leaves the others to the proof. */
  riis_mark_options options = mark_options();
  assert_true(check_same_as_exhaustive(surface, mesh, options, paper).n_unreached == missed);
  assert_int_equal(check_same_as_exhaustive(surface, mesh, options, paper).n_unreached, 0);
  riis_mark_result_destroy(&paper);
  riis_mesh_destroy(&mesh);
  free_test_mesh(&nodes);
  riis_surface_destroy(&surface);
  riis_valve_destroy(&valve);
}

/* Slabs that no edge joins, and the same region twice, the second time half a spacing away. */
static void mesh_of_several_components(void **state) {
  (void)state;
  riis_surface *surface = aortic_surface(NULL);
  test_mesh one = lattice_around(surface, 0.09, 0.15), two = {.n = 2 * one.n};
  two.xyz = malloc((size_t)two.n * 3 * sizeof *two.xyz);
  for (int64_t i = 0; i < 3 * one.n; ++i) two.xyz[i] = one.xyz[i], two.xyz[3 * one.n + i] = one.xyz[i] + 0.045;
  int64_t *pairs = malloc((size_t)one.offsets[one.n] * 4 * sizeof *pairs), n_pairs = 0;
  for (int64_t i = 0; i < one.n; ++i)
    for (int64_t k = one.offsets[i]; k < one.offsets[i + 1]; ++k) {
      const int64_t j = one.columns[k];
      /* No pair across x = -0.5, 0, 0.5. */
      if (j < i || floor(2 * one.xyz[3 * i]) != floor(2 * one.xyz[3 * j])) continue;
      for (int64_t copy = 0; copy < 2; ++copy)
        pairs[2 * n_pairs] = i + copy * one.n, pairs[2 * n_pairs++ + 1] = j + copy * one.n;
    }
  set_rows(&two, n_pairs, pairs);
  riis_mesh *mesh = mesh_from(&two);
  const riis_mark_stats stats = check_same_as_exhaustive(surface, mesh, mark_options(), NULL);
  assert_true(stats.n_marked > 1000);
  assert_true(missed_by_the_paper(surface, mesh, NULL) > stats.n_marked / 2);
  riis_mesh_destroy(&mesh);
  free(pairs);
  free_test_mesh(&one);
  free_test_mesh(&two);
  riis_surface_destroy(&surface);
}

static void bands_that_fall_apart_on_a_coarse_mesh(void **state) {
  (void)state;
  static const double half_thickness[4] = {0.05, 0.02, 0.005, 0.0005};
  for (int k = 0; k < 4; ++k) {
    riis_surface *surface = aortic_band(half_thickness[k]);
    test_mesh nodes = lattice_around(surface, 0.11, 0.2);
    riis_mesh *mesh = mesh_from(&nodes);
    riis_mark_options options = mark_options();
    const riis_mark_stats stats = check_same_as_exhaustive(surface, mesh, options, NULL);
    if (k < 3) {
      assert_true(stats.n_marked > 5);
      assert_true(missed_by_the_paper(surface, mesh, NULL) > 0);
    }
    riis_mesh_destroy(&mesh);
    free_test_mesh(&nodes);
    riis_surface_destroy(&surface);
  }
}

static void valve_that_sticks_out_of_the_mesh(void **state) {
  (void)state;
  riis_surface *surface = aortic_surface(NULL);
  const riis_surface_info info = info_of(surface);
  static const int64_t counts[3] = {24, 22, 26};
  for (int trial = 0; trial < 20; ++trial) { /* random boxes around a part of the valve, beside it or within it */
    double lower[3], upper[3];
    for (int c = 0; c < 3; ++c) {
      const double a = random_between(&rng, info.lower[c] - 0.3, info.upper[c] + 0.3);
      const double b = random_between(&rng, info.lower[c] - 0.3, info.upper[c] + 0.3);
      lower[c] = fmin(a, b), upper[c] = fmax(a, b);
    }
    if (trial == 0) /* this box surely holds half of the valve */
      for (int c = 0; c < 3; ++c) lower[c] = info.lower[c], upper[c] = c ? info.upper[c] : 0;
    test_mesh nodes = lattice(counts, lower, upper);
    riis_mesh *mesh = mesh_from(&nodes);
    const riis_mark_stats stats = check_same_as_exhaustive(surface, mesh, mark_options(), NULL);
    if (trial == 0) assert_true(stats.n_marked > 500);
    riis_mesh_destroy(&mesh);
    free_test_mesh(&nodes);
  }
  riis_surface_destroy(&surface);
}

static void isolated_nodes(void **state) {
  (void)state;
  riis_surface *surface = aortic_surface(NULL);
  test_mesh nodes = lattice_around(surface, 0.07, 0.15);
  set_rows(&nodes, 0, NULL);
  riis_mesh *mesh = mesh_from(&nodes);
  riis_csr csr = csr_of(&nodes);
  csr.columns = NULL;
  CHECK_OK(riis_mesh_set_adjacency(mesh, &csr));
  riis_mark_result *result = new_result();
  const riis_mark_stats first = check_same_as_exhaustive(surface, mesh, mark_options(), result);
  assert_true(first.n_marked > 1000);
  assert_true(first.n_unreached > first.n_marked / 2); /* each start's walk has one step */
  assert_int_equal(check_same_as_exhaustive(surface, mesh, mark_options(), result).n_unreached, 0); /* all are starts */
  assert_true(missed_by_the_paper(surface, mesh, NULL) >= first.n_marked - 1);
  riis_mark_result_destroy(&result);
  riis_mesh_destroy(&mesh);
  free_test_mesh(&nodes);
  riis_surface_destroy(&surface);
}

/* The adjacency only says where to look first, so the result does not depend on it. */
static void any_adjacency_is_right(void **state) {
  (void)state;
  riis_surface *surface = aortic_surface(NULL);
  test_mesh nodes = lattice_around(surface, 0.1, 0.3);
  for (int trial = 0; trial < 8; ++trial) {
    const int64_t n_pairs = trial * nodes.n / 2;
    int64_t *pairs = malloc((size_t)(2 * n_pairs + 1) * sizeof *pairs);
    for (int64_t k = 0; k < 2 * n_pairs; ++k) pairs[k] = (int64_t)(random_bits(&rng) % (uint64_t)nodes.n);
    set_rows(&nodes, n_pairs, pairs);
    riis_mesh *mesh = mesh_from(&nodes);
    riis_mark_options options = mark_options();
    options.n_threads = 1 + trial % 4;
    check_same_as_exhaustive(surface, mesh, options, NULL);
    riis_mesh_destroy(&mesh);
    free(pairs);
  }
  /* First each node has only the next one as a neighbour, in a ring. Then every node is its own neighbour many times. */
  for (int self = 0; self < 2; ++self) {
    free(nodes.columns);
    nodes.columns = malloc((size_t)nodes.n * 5 * sizeof *nodes.columns);
    for (int64_t i = 0; i < nodes.n; ++i) {
      nodes.offsets[i + 1] = 5 * (i + 1);
      for (int k = 0; k < 5; ++k) nodes.columns[5 * i + k] = self ? i : (i + 1) % nodes.n;
    }
    riis_mesh *mesh = mesh_from(&nodes);
    check_same_as_exhaustive(surface, mesh, mark_options(), NULL);
    riis_mesh_destroy(&mesh);
  }
  free_test_mesh(&nodes);
  riis_surface_destroy(&surface);
}

/* Rows with the other ranks' nodes, in every width and base. */
static void ghosts_are_passed_over(void **state) {
  (void)state;
  riis_surface *surface = aortic_surface(NULL);
  test_mesh nodes = lattice_around(surface, 0.1, 0.15);
  const int64_t n_entries = nodes.offsets[nodes.n] + nodes.n, n_all = nodes.n + 1000;
  int32_t *offsets = malloc((size_t)(nodes.n + 1) * sizeof *offsets);
  int32_t *columns = malloc((size_t)n_entries * sizeof *columns);
  int32_t at = 0;
  for (int64_t i = 0; i < nodes.n; ++i) {
    offsets[i] = at + 1;
    const int64_t place = (int64_t)(random_bits(&rng) % (uint64_t)(nodes.offsets[i + 1] - nodes.offsets[i] + 1));
    for (int64_t k = nodes.offsets[i]; k <= nodes.offsets[i + 1]; ++k) {
      if (k - nodes.offsets[i] == place) columns[at++] = (int32_t)(nodes.n + (int64_t)(random_bits(&rng) % 1000)) + 1;
      if (k < nodes.offsets[i + 1]) columns[at++] = (int32_t)nodes.columns[k] + 1;
    }
  }
  offsets[nodes.n] = at + 1;
  riis_csr csr;
  CHECK_OK(riis_csr_init(&csr, sizeof csr));
  csr.n_rows = nodes.n;
  csr.n_all = n_all;
  csr.offsets = offsets;
  csr.columns = columns;
  csr.index_base = 1;
  riis_mesh *mesh = mesh_from(&nodes), *with_ghosts = mesh_from(&nodes);
  CHECK_OK(riis_mesh_set_adjacency(with_ghosts, &csr));
  const riis_mark_stats plain = check_same_as_exhaustive(surface, mesh, mark_options(), NULL);
  const riis_mark_stats stats = check_same_as_exhaustive(surface, with_ghosts, mark_options(), NULL);
  assert_int_equal(stats.n_queries, plain.n_queries); /* the same walk */
  assert_int_equal(stats.n_unreached, plain.n_unreached);
  riis_mesh_destroy(&mesh);
  riis_mesh_destroy(&with_ghosts);
  free(offsets);
  free(columns);
  free_test_mesh(&nodes);
  riis_surface_destroy(&surface);
}

static void mesh_of_one_node(void **state) {
  (void)state;
  riis_surface *surface = aortic_surface(NULL);
  const double *vertices;
  CHECK_OK(riis_surface_vertices(surface, NULL, &vertices));
  const double places[3][3] = {{vertices[0], vertices[1], vertices[2] + 0.05}, {0, 0, 50}, {1e60, -1e60, 1e60}};
  for (int k = 0; k < 3; ++k)
    for (int self = 0; self < 2; ++self) {
      double xyz[3] = {places[k][0], places[k][1], places[k][2]};
      int64_t offsets[2] = {0, self}, columns[1] = {0};
      test_mesh one = {1, xyz, offsets, columns};
      riis_mesh *mesh = mesh_from(&one);
      riis_mark_options options = mark_options();
      riis_mark_result *result = new_result();
      for (int again = 0; again < 2; ++again)
        assert_int_equal(check_same_as_exhaustive(surface, mesh, options, result).n_marked, k == 0);
      const uint8_t mask = 0;
      options.node_mask = &mask;
      assert_int_equal(check_same_as_exhaustive(surface, mesh, options, result).n_marked, 0);
      riis_mark_result_destroy(&result);
      riis_mesh_destroy(&mesh);
    }
  riis_surface_destroy(&surface);
}

/* Nodes at the same place, on a line, in a plane, or far apart from each other. */
static void degenerate_meshes(void **state) {
  (void)state;
  riis_surface *surface = aortic_surface(NULL);
  static const int64_t counts[5][3] = {{3000, 1, 1}, {1, 60, 50}, {1, 1, 2000}, {12, 12, 12}, {12, 12, 12}};
  for (int k = 0; k < 5; ++k) {
    const double size = k < 3 ? 3 : k == 3 ? 0 : 1e40;
    const double lower[3] = {-size, -size, -0.4 - size}, upper[3] = {size, size, -0.4 + size};
    test_mesh nodes = lattice(counts[k], lower, upper);
    if (k == 3)
      for (int64_t i = 0; i < nodes.n; ++i) nodes.xyz[3 * i] = 0.3;
    riis_mesh *mesh = mesh_from(&nodes);
    riis_mark_options options = mark_options();
    check_same_as_exhaustive(surface, mesh, options, NULL);
    options.distance_limit = 1;
    check_same_as_exhaustive(surface, mesh, options, NULL);
    options.distance_limit = 1e60; /* all of them */
    assert_int_equal(check_same_as_exhaustive(surface, mesh, options, NULL).n_within_limit, nodes.n);
    riis_mesh_destroy(&mesh);
    free_test_mesh(&nodes);
  }
  riis_surface_destroy(&surface);
}

/* The limit is the library's own distance of the first node of a column over a triangle, which has any size. All other distances
 * in the proof equal it up to rounding, which must not lose the node. */
static void nodes_at_the_limit_are_found(void **state) {
  (void)state;
  static const int32_t ids[3] = {0, 1, 2};
  for (int trial = 0; trial < 3000; ++trial) {
    const double size = pow(10, random_between(&rng, -1, 6)), origin = trial % 3 ? 0 : random_between(&rng, -300, 300);
    double corners[9], normal[3], xyz[3 * 40], ab[3], ac[3];
    for (int k = 0; k < 9; ++k) corners[k] = size * random_between(&rng, -1, 1);
    for (int c = 0; c < 3; ++c) ab[c] = corners[3 + c] - corners[c], ac[c] = corners[6 + c] - corners[c];
    for (int c = 0; c < 3; ++c) normal[c] = ab[(c + 1) % 3] * ac[(c + 2) % 3] - ab[(c + 2) % 3] * ac[(c + 1) % 3];
    const double length = sqrt(normal[0] * normal[0] + normal[1] * normal[1] + normal[2] * normal[2]);
    const double b = random_between(&rng, 0.1, 0.5), a = random_between(&rng, 0.1, 0.4);
    for (int c = 0; c < 3; ++c) { /* the column's foot to the origin */
      const double foot = corners[c] + b * ab[c] + a * ac[c];
      for (int k = 0; k < 3; ++k) corners[3 * k + c] += origin - foot;
    }
    const int m = 1 + (int)(random_bits(&rng) % 40);
    const double first = random_between(&rng, 0.05, 0.2), step = pow(10, random_between(&rng, -4, 0));
    for (int i = 0; i < m; ++i)
      for (int c = 0; c < 3; ++c) xyz[3 * i + c] = origin + normal[c] / length * (first + i * step);
    riis_surface_arrays arrays = triangle_arrays(3, corners, 1, ids);
    riis_surface_options options = surface_options();
    riis_surface *surface = surface_from(&arrays, NULL);
    options.half_thickness = closest_to(surface, xyz[0], xyz[1], xyz[2]).distance;
    CHECK_OK(riis_surface_update_from_arrays(surface, &arrays, &options));
    test_mesh nodes = {.n = m, .xyz = xyz};
    set_rows(&nodes, 0, NULL);
    riis_mesh *mesh = mesh_from(&nodes);
    riis_mark_options marking = mark_options();
    marking.n_threads = 1;
    assert_true(check_same_as_exhaustive(surface, mesh, marking, NULL).n_marked >= 1);
    riis_mesh_destroy(&mesh);
    riis_surface_destroy(&surface);
    free(nodes.offsets);
    free(nodes.columns);
  }
}

/* Triangles have nearly no height, nodes are as close to them as that height, and the limit is the first node's distance. The
 * rounding of a needle's distances in the kernel must not lose a node. */
static void needles_lose_no_node(void **state) {
  (void)state;
  static const int32_t ids[3] = {0, 1, 2};
  int n_surfaces = 0;
  for (int trial = 0; trial < 6000; ++trial) {
    const double height = pow(10, random_between(&rng, -11.5, -7));
    double along[3], across[3], corners[9], xyz[6];
    for (int c = 0; c < 3; ++c) along[c] = random_between(&rng, -1, 1), across[c] = random_between(&rng, -1, 1);
    const double top = random_between(&rng, 0.1, 0.9);
    for (int c = 0; c < 3; ++c) {
      corners[c] = random_between(&rng, -0.01, 0.01);
      corners[3 + c] = corners[c] + along[c];
      corners[6 + c] = corners[c] + top * along[c] + height * across[c];
    }
    const double u = random_between(&rng, 0.1, 0.9),
                 w = fmin(u / top, (1 - u) / (1 - top)) * random_between(&rng, 0, 1);
    for (int i = 0; i < 2; ++i)
      for (int c = 0; c < 3; ++c)
        xyz[3 * i + c] = corners[c] + u * along[c] + height * (w * across[c] + random_between(&rng, -0.1, 0.1));
    riis_surface_arrays arrays = triangle_arrays(3, corners, 1, ids);
    riis_surface_options options = surface_options();
    riis_surface *surface = NULL;
    if (riis_surface_create_from_arrays(&arrays, NULL, &surface) != RIIS_OK) continue; /* all triangles are too thin */
    options.half_thickness = fmax(closest_to(surface, xyz[0], xyz[1], xyz[2]).distance, 1e-40);
    CHECK_OK(riis_surface_update_from_arrays(surface, &arrays, &options));
    test_mesh nodes = {.n = 2, .xyz = xyz};
    set_rows(&nodes, 0, NULL);
    riis_mesh *mesh = mesh_from(&nodes);
    riis_mark_options marking = mark_options();
    marking.n_threads = 1;
    assert_true(check_same_as_exhaustive(surface, mesh, marking, NULL).n_marked >= 1);
    ++n_surfaces;
    riis_mesh_destroy(&mesh);
    riis_surface_destroy(&surface);
    free(nodes.offsets);
    free(nodes.columns);
  }
  assert_true(n_surfaces > 3000);
}

/* --- Masks, limits --------------------------------------------------------------------------------------------------- */

static void masked_nodes_are_left_out(void **state) {
  (void)state;
  riis_surface *surface = aortic_surface(NULL);
  test_mesh nodes = lattice_around(surface, 0.08, 0.15);
  riis_mesh *mesh = mesh_from(&nodes);
  uint8_t *mask = malloc((size_t)nodes.n);
  riis_mark_result *reused = new_result();
  riis_mark_options options = mark_options();
  options.node_mask = mask;
  for (int trial = 0; trial < 9; ++trial) {
    for (int64_t i = 0; i < nodes.n; ++i) mask[i] = (uint8_t)(random_bits(&rng) % 8 >= (uint64_t)trial ? 200 : 0);
    riis_mark_result *fresh = new_result();
    check_same_as_exhaustive(surface, mesh, options, fresh);
    const riis_mark_stats stats =
        check_same_as_exhaustive(surface, mesh, options, reused); /* starts from the marking with another mask */
    const found_nodes found = within_in(reused);
    for (int64_t i = 0; i < found.n; ++i) assert_true(mask[found.node_id[i]]);
    if (trial == 8) {
      assert_int_equal(stats.n_within_limit, 0);
      missed_by_the_paper(surface, mesh, mask); /* there is no node to start from */
    } else {
      assert_true(stats.n_within_limit > 100);
    }
    riis_mark_result_destroy(&fresh);
  }
  riis_mark_result_destroy(&reused);
  free(mask);
  riis_mesh_destroy(&mesh);
  free_test_mesh(&nodes);
  riis_surface_destroy(&surface);
}

/* No walk passes a wall of one layer of masked nodes across a connected band. */
static void mask_that_cuts_the_band(void **state) {
  (void)state;
  const double corners[9] = {-1, -1, 0, 1, -1, 0, 0, 2, 0};
  const int32_t ids[3] = {0, 1, 2};
  riis_surface_arrays arrays = triangle_arrays(3, corners, 1, ids);
  riis_surface *surface = surface_from(&arrays, NULL);
  test_mesh nodes = lattice_around(surface, 0.05, 0.2);
  riis_mesh *mesh = mesh_from(&nodes);
  assert_int_equal(missed_by_the_paper(surface, mesh, NULL), 0); /* a band in one piece */
  uint8_t *mask = malloc((size_t)nodes.n);
  double wall = 10;
  for (int64_t i = 0; i < nodes.n; ++i)
    if (fabs(nodes.xyz[3 * i]) < fabs(wall)) wall = nodes.xyz[3 * i];
  for (int64_t i = 0; i < nodes.n; ++i) mask[i] = nodes.xyz[3 * i] != wall;
  riis_mark_options options = mark_options();
  options.node_mask = mask;
  const riis_mark_stats stats = check_same_as_exhaustive(surface, mesh, options, NULL);
  const int64_t missed = missed_by_the_paper(surface, mesh, mask);
  assert_true(missed > stats.n_marked / 3 && missed < stats.n_marked);
  riis_mark_result *paper = marked_by(surface, mesh, RIIS_SEARCH_PAPER, 2, mask);
  const found_nodes found = marked_in(paper);
  for (int64_t i = 0; i < found.n; ++i)
    assert_true(nodes.xyz[3 * found.node_id[i]] < wall); /* the first vertex's side */
  /* From one side's marking the walk does not reach the other side, but the proof does. */
  assert_int_equal(check_same_as_exhaustive(surface, mesh, options, paper).n_unreached, missed);
  riis_mark_result_destroy(&paper);
  free(mask);
  riis_mesh_destroy(&mesh);
  free_test_mesh(&nodes);
  riis_surface_destroy(&surface);
}

static void limits_wider_than_the_half_thickness(void **state) {
  (void)state;
  riis_surface *surface = aortic_surface(NULL);
  test_mesh nodes = lattice_around(surface, 0.25, 1);
  riis_mesh *mesh = mesh_from(&nodes);
  static const double limits[7] = {0.1, 0.11, 0.3, 5, 0.2, 1e60, 0.1};
  riis_mark_result *reused = new_result();
  for (int k = 0; k < 7; ++k) {
    riis_mark_options options = mark_options();
    options.distance_limit = limits[k];
    const riis_mark_stats stats = check_same_as_exhaustive(surface, mesh, options, reused);
    check_same_as_exhaustive(surface, mesh, options, NULL);
    if (limits[k] > 4) assert_int_equal(stats.n_within_limit, nodes.n);
  }
  riis_mark_result_destroy(&reused);
  riis_mesh_destroy(&mesh);
  free_test_mesh(&nodes);
  riis_surface_destroy(&surface);
}

/* --- The paper's algorithm ------------------------------------------------------------------------------------------- */

/* The paper's algorithm must find the marked nodes that neighbours connect to the node nearest to the first vertex. */
static void paper_finds_the_piece_that_it_starts_in(void **state) {
  (void)state;
  static const double half_thickness[4] = {0.03, 0.06, 0.1, 0.3};
  for (int k = 0; k < 4; ++k) {
    riis_surface *surface = aortic_band(half_thickness[k]);
    test_mesh nodes = lattice_around(surface, 0.1, 0.3);
    for (int64_t i = 0; i < 3 * nodes.n; ++i)
      nodes.xyz[i] += random_between(&rng, -0.02, 0.02); /* so no two nodes are equally near */
    riis_mesh *mesh = mesh_from(&nodes);
    riis_mark_result *all = marked_by(surface, mesh, RIIS_SEARCH_EXHAUSTIVE, 1, NULL);
    riis_mark_result *paper = marked_by(surface, mesh, RIIS_SEARCH_PAPER, 2, NULL);
    const double *vertices;
    const int64_t *vertex_id;
    CHECK_OK(riis_surface_vertices(surface, NULL, &vertices));
    CHECK_OK(riis_surface_triangles(surface, NULL, &vertex_id, NULL, NULL, NULL));
    const double *first = vertices + 3 * vertex_id[0];
    uint8_t *marked = calloc((size_t)nodes.n, 1);
    int64_t *queue = malloc((size_t)nodes.n * sizeof *queue), n_queued = 0, start = 0;
    double least = INFINITY;
    CHECK_OK(riis_mark_result_dense(all, nodes.n, 1e30, marked, NULL, NULL, NULL));
    for (int64_t i = 0; i < nodes.n; ++i) {
      double sum = 0;
      for (int c = 0; c < 3; ++c) sum += (nodes.xyz[3 * i + c] - first[c]) * (nodes.xyz[3 * i + c] - first[c]);
      if (sum < least) least = sum, start = i;
    }
    if (marked[start]) marked[start] = 2, queue[n_queued++] = start;
    for (int64_t q = 0; q < n_queued; ++q)
      for (int64_t e = nodes.offsets[queue[q]]; e < nodes.offsets[queue[q] + 1]; ++e)
        if (marked[nodes.columns[e]] == 1) marked[nodes.columns[e]] = 2, queue[n_queued++] = nodes.columns[e];
    const found_nodes found = marked_in(paper);
    assert_int_equal(found.n, n_queued);
    for (int64_t i = 0; i < found.n; ++i) assert_int_equal(marked[found.node_id[i]], 2);
    assert_int_equal(stats_of(paper).complete, 0);
    free(marked);
    free(queue);
    riis_mark_result_destroy(&all);
    riis_mark_result_destroy(&paper);
    riis_mesh_destroy(&mesh);
    free_test_mesh(&nodes);
    riis_surface_destroy(&surface);
  }
}

/* The default search is the library's choice, which is complete with or without an adjacency. */
static void auto_is_never_incomplete(void **state) {
  (void)state;
  riis_surface *surface = aortic_surface(NULL);
  test_mesh nodes = lattice_around(surface, 0.2, 0.2);
  riis_mesh *mesh = mesh_from(&nodes);
  riis_mark_result *result = new_result();
  riis_mark_options options = mark_options();
  assert_int_equal(options.search, RIIS_SEARCH_AUTO);
  CHECK_OK(riis_mark_nodes(surface, mesh, &options, result));
  assert_int_equal(stats_of(result).search, RIIS_SEARCH_EXHAUSTIVE);
  assert_int_equal(stats_of(result).complete, 1);
  CHECK_OK(riis_mark_nodes(surface, mesh, NULL, result));
  assert_int_equal(stats_of(result).search, RIIS_SEARCH_CLUSTERS);
  assert_int_equal(stats_of(result).complete, 1);
  options.search = RIIS_SEARCH_NEIGHBOR;
  CHECK_OK(riis_mark_nodes(surface, mesh, &options, result));
  assert_int_equal(stats_of(result).search, RIIS_SEARCH_NEIGHBOR);
  options.search = RIIS_SEARCH_EXHAUSTIVE;
  CHECK_OK(riis_mark_nodes(surface, mesh, &options, result));
  assert_int_equal(stats_of(result).search, RIIS_SEARCH_EXHAUSTIVE);
  CHECK_OK(riis_mesh_set_adjacency(mesh, NULL));
  CHECK_OK(riis_mark_nodes(surface, mesh, NULL, result));
  assert_int_equal(stats_of(result).search, RIIS_SEARCH_CLUSTERS);
  assert_int_equal(stats_of(result).complete, 1);
  assert_int_equal(stats_of(result).n_unreached, 0);
  options.search = 5;
  CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "options.search is 5", riis_mark_nodes(surface, mesh, &options, result));
  options.search = -1;
  CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "options.search is -1", riis_mark_nodes(surface, mesh, &options, result));
  riis_mark_result_destroy(&result);
  riis_mesh_destroy(&mesh);
  free_test_mesh(&nodes);
  riis_surface_destroy(&surface);
}

/* --- From step to step ----------------------------------------------------------------------------------------------- */

static void a_valve_moves(void **state) {
  (void)state;
  riis_valve *valve = NULL;
  riis_surface *surface = mitral_surface(0);
  test_mesh nodes = lattice_around(surface, 0.12, 0.8);
  riis_mesh *mesh = mesh_from(&nodes);
  riis_mark_result *result = new_result();
  CHECK_OK(riis_valve_create("mitral", &valve));
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
  assert_true(n_unreached < n_marked / 10); /* the last marking is a good start */
  riis_mark_result_destroy(&result);
  riis_mesh_destroy(&mesh);
  free_test_mesh(&nodes);
  riis_surface_destroy(&surface);
  riis_valve_destroy(&valve);
}

static void a_valve_jumps(void **state) {
  (void)state;
  riis_valve *valve = NULL;
  riis_surface *surface = NULL;
  CHECK_OK(riis_valve_create("aortic", &valve));
  CHECK_OK(riis_surface_create(valve, NULL, &surface));
  const int64_t counts[3] = {60, 30, 30};
  const double lower[3] = {-1.7, -1.7, -1.6}, upper[3] = {9, 1.7, 0.6};
  test_mesh nodes = lattice(counts, lower, upper);
  riis_mesh *mesh = mesh_from(&nodes);
  riis_mark_result *result = new_result();
  riis_surface_options options = surface_options();
  static const double x[10] = {0, 7, 0, 100, 0.01, 0, 4, 4.5, -50, 7}; /* some places are outside the mesh */
  for (int step = 0; step < 10; ++step) {
    options.translation[0] = x[step];
    CHECK_OK(riis_surface_update(surface, valve, &options));
    const riis_mark_stats stats = check_same_as_exhaustive(surface, mesh, mark_options(), result);
    assert_int_equal(stats.n_marked > 0, fabs(x[step]) < 10);
    if (step == 1 || step == 2) assert_int_equal(stats.n_unreached, stats.n_within_limit); /* the start was useless */
  }
  riis_mark_result_destroy(&result);
  riis_mesh_destroy(&mesh);
  free_test_mesh(&nodes);
  riis_surface_destroy(&surface);
  riis_valve_destroy(&valve);
}

static void a_result_goes_from_mesh_to_mesh(void **state) {
  (void)state;
  riis_surface *surface = aortic_surface(NULL);
  test_mesh a = lattice_around(surface, 0.15, 0.2), b = lattice_around(surface, 0.11, 0.3),
            c = lattice_around(surface, 0.15, 0.2);
  for (int64_t i = c.n - 1; i > 0; --i) /* c has as many nodes as a, at other places */
    for (int k = 0; k < 3; ++k) {
      const int64_t j = (int64_t)(random_bits(&rng) % (uint64_t)i);
      const double swap = c.xyz[3 * i + k];
      c.xyz[3 * i + k] = c.xyz[3 * j + k], c.xyz[3 * j + k] = swap;
    }
  riis_mesh *mesh[3] = {mesh_from(&a), mesh_from(&b), mesh_from(&c)};
  riis_mark_result *result = new_result();
  for (int step = 0; step < 30; ++step) {
    riis_mark_options options = mark_options();
    options.n_threads = 1 + (int)(random_bits(&rng) % 3);
    if (step % 5 == 4) { /* another search in between */
      options.search = step % 2 ? RIIS_SEARCH_EXHAUSTIVE : RIIS_SEARCH_PAPER;
      CHECK_OK(riis_mark_nodes(surface, mesh[random_bits(&rng) % 3], &options, result));
    }
    check_same_as_exhaustive(surface, mesh[random_bits(&rng) % 3], options, result);
  }
  riis_mark_result_destroy(&result);
  for (int k = 0; k < 3; ++k) riis_mesh_destroy(&mesh[k]);
  free_test_mesh(&a), free_test_mesh(&b), free_test_mesh(&c);
  riis_surface_destroy(&surface);
}

/* There are more steps than the 8-bit counter of walks holds. */
static void many_steps(void **state) {
  (void)state;
  riis_surface *surface = aortic_band(0.1);
  test_mesh nodes = lattice_around(surface, 0.3, 0.2);
  riis_mesh *mesh = mesh_from(&nodes);
  riis_mark_result *result = new_result();
  riis_mark_options options = mark_options();
  options.n_threads = 1;
  for (int step = 0; step < 600; ++step) check_same_as_exhaustive(surface, mesh, options, result);
  riis_mark_result_destroy(&result);
  riis_mesh_destroy(&mesh);
  free_test_mesh(&nodes);
  riis_surface_destroy(&surface);
}

static void nodes_move(void **state) {
  (void)state;
  riis_surface *surface = aortic_surface(NULL);
  test_mesh nodes = lattice_around(surface, 0.12, 0.3);
  riis_mesh *mesh = mesh_from(&nodes);
  riis_mark_result *result = new_result();
  double *moved = malloc((size_t)nodes.n * 3 * sizeof *moved);
  for (int step = 0; step < 12; ++step) {
    const double shift = step < 8 ? 0.03 * step : 1000 * (step % 2),
                 mix = step == 5 ? 3 : 0.05; /* step 5 changes all places */
    for (int64_t i = 0; i < 3 * nodes.n; ++i) {
      moved[i] = nodes.xyz[i] + shift + random_between(&rng, -mix, mix);
      if (step % 2 == 0) nodes.xyz[i] = moved[i]; /* the coordinates change in place, or in another array */
    }
    const double *now = step % 2 == 0 ? nodes.xyz : moved;
    CHECK_OK(riis_mesh_update(mesh, nodes.n, now, now + 1, now + 2, 3));
    check_same_as_exhaustive(surface, mesh, mark_options(), result);
    check_same_as_exhaustive(surface, mesh, mark_options(), NULL);
  }
  /* Fewer nodes remove the adjacency. With a new one the search goes on. */
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
  riis_mark_result_destroy(&result);
  riis_mesh_destroy(&mesh);
  free(half.offsets);
  free(half.columns);
  free(moved);
  free_test_mesh(&nodes);
  riis_surface_destroy(&surface);
}

/* Coordinates become non-finite without an update of the handle, before the first search or between two. */
static void non_finite_coordinates_are_refused(void **state) {
  (void)state;
  static const double bad[3] = {NAN, INFINITY, -INFINITY};
  riis_surface *surface = aortic_surface(NULL);
  test_mesh nodes = lattice_around(surface, 0.13, 0.15);
  riis_mark_result *expected = NULL;
  for (int trial = 0; trial < 36; ++trial) {
    riis_mesh *mesh = mesh_from(&nodes);
    riis_mark_result *result = new_result();
    riis_mark_options options = mark_options();
    options.search = RIIS_SEARCH_NEIGHBOR;
    options.n_threads = 1 + trial % 2;
    if (!expected) expected = marked_by(surface, mesh, RIIS_SEARCH_EXHAUSTIVE, 1, NULL);
    const found_nodes marked = marked_in(expected);
    const int is_first_search = trial % 4 < 2;
    if (!is_first_search) CHECK_OK(riis_mark_nodes(surface, mesh, &options, result));
    /* A node of the band has to be queried. */
    const int64_t node = marked.node_id[random_bits(&rng) % (uint64_t)marked.n];
    double *coordinate = nodes.xyz + 3 * node + trial % 3;
    const double good = *coordinate;
    *coordinate = bad[trial / 4 % 3];
    char text[64];
    snprintf(text, sizeof text, "%c of node %lld is %s", "xyz"[trial % 3], (long long)node,
             trial / 4 % 3 ? "inf" : "nan");
    if (trial / 4 % 3 == 2) snprintf(text, sizeof text, "of node %lld is -inf", (long long)node);
    CHECK_REFUSED(RIIS_INVALID_MESH, text, riis_mark_nodes(surface, mesh, &options, result));
    assert_int_equal(marked_in(result).n, is_first_search ? 0 : marked.n); /* as it was */
    if (!is_first_search) assert_true(same_results(result, expected));
    *coordinate = good;
    if (is_first_search) CHECK_OK(riis_mesh_update(mesh, nodes.n, nodes.xyz, nodes.xyz + 1, nodes.xyz + 2, 3));
    CHECK_OK(riis_mark_nodes(surface, mesh, &options, result)); /* the next marking works again */
    assert_true(same_results(result, expected));
    riis_mark_result_destroy(&result);
    riis_mesh_destroy(&mesh);
  }
  riis_mark_result_destroy(&expected);
  free_test_mesh(&nodes);
  riis_surface_destroy(&surface);
}

/* Nodes that moved in place are searched at their new places, even if the update of the handle was refused. */
static void a_refused_update_forgets_where_nodes_were(void **state) {
  (void)state;
  riis_surface *surface = aortic_surface(NULL);
  test_mesh nodes = lattice_around(surface, 0.13, 0.15);
  riis_mesh *mesh = mesh_from(&nodes);
  riis_mark_result *result = new_result();
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
  riis_mark_result *expected = marked_by(surface, mesh, RIIS_SEARCH_EXHAUSTIVE, 1, NULL);
  assert_true(stats_of(expected).n_marked > 0 && same_results(result, expected));
  riis_mark_result_destroy(&expected);
  riis_mark_result_destroy(&result);
  riis_mesh_destroy(&mesh);
  free_test_mesh(&nodes);
  riis_surface_destroy(&surface);
}

/* --- Threads --------------------------------------------------------------------------------------------------------- */

static void any_number_of_threads_gives_the_same_bits(void **state) {
  (void)state;
  riis_surface *surface = aortic_surface(NULL);
  test_mesh nodes = lattice_around(surface, 0.05, 0.3);
  riis_mesh *mesh = mesh_from(&nodes);
  assert_true(nodes.n > 50000);
  static const int32_t searches[2] = {RIIS_SEARCH_NEIGHBOR, RIIS_SEARCH_PAPER};
  for (int k = 0; k < 2; ++k) {
    riis_mark_result *one = marked_by(surface, mesh, searches[k], 1, NULL);
    assert_int_equal(stats_of(one).n_threads, 1);
    assert_true(stats_of(one).n_marked > 5000);
    int32_t most[5] = {0};
    for (int repeat = 0; repeat < 3; ++repeat)
      for (int threads = 1; threads <= 4; ++threads) {
        riis_mark_result *many = marked_by(surface, mesh, searches[k], threads, NULL);
        const riis_mark_stats stats = stats_of(many);
        assert_true(same_results(one, many));
        assert_int_equal(stats.n_queries, stats_of(one).n_queries);
        assert_int_equal(stats.n_unreached, stats_of(one).n_unreached);
        assert_true(stats.n_threads >= 1 && stats.n_threads <= threads);
        if (stats.n_threads > most[threads]) most[threads] = stats.n_threads;
        riis_mark_result_destroy(&many);
      }
    /* Several threads really ran. The paper's search is only the walk, which a second thread joins when the system lets it. */
    for (int repeat = 0; repeat < 500 && most[2] < 2; ++repeat) {
      riis_mark_result *two = marked_by(surface, mesh, searches[k], 2, NULL);
      most[2] = stats_of(two).n_threads;
      assert_true(same_results(one, two));
      riis_mark_result_destroy(&two);
    }
    assert_int_equal(most[2], 2);
    riis_mark_result_destroy(&one);
  }
  /* The balls do not depend on threads either: this is a mesh's first search, by any number of threads. */
  riis_mark_result *one = marked_by(surface, mesh, RIIS_SEARCH_NEIGHBOR, 1, NULL);
  for (int threads = 1; threads <= 4; ++threads) {
    riis_mesh *fresh = mesh_from(&nodes);
    riis_mark_result *many = marked_by(surface, fresh, RIIS_SEARCH_NEIGHBOR, threads, NULL);
    assert_true(same_results(one, many));
    assert_int_equal(stats_of(many).n_queries, stats_of(one).n_queries);
    riis_mark_result_destroy(&many);
    riis_mesh_destroy(&fresh);
  }
  riis_mark_result_destroy(&one);
  riis_mesh_destroy(&mesh);
  free_test_mesh(&nodes);
  riis_surface_destroy(&surface);
}

typedef struct caller {
  const riis_surface *surface;
  const riis_mesh *mesh;
  const riis_mark_result *expected;
  pthread_barrier_t *barrier;
  int n_threads, n_wrong;
} caller;

static void *mark_with_own_result(void *of) {
  caller *c = of;
  riis_mark_options options = {0};
  riis_mark_result *result = NULL;
  c->n_wrong = riis_mark_options_init(&options, sizeof options) || riis_mark_result_create(&result);
  options.search = RIIS_SEARCH_NEIGHBOR;
  options.n_threads = c->n_threads;
  pthread_barrier_wait(c->barrier);
  for (int step = 0; step < 3 && !c->n_wrong; ++step)
    c->n_wrong += riis_mark_nodes(c->surface, c->mesh, &options, result) || !same_results(result, c->expected);
  riis_mark_result_destroy(&result);
  return NULL;
}

/* All threads share a surface and a mesh that is new to them. The first one makes the mesh's balls. */
static void several_caller_threads_at_once(void **state) {
  (void)state;
  riis_surface *surface = aortic_surface(NULL);
  test_mesh nodes = lattice_around(surface, 0.1, 0.2);
  riis_mesh *mesh = mesh_from(&nodes);
  riis_mark_result *expected = marked_by(surface, mesh, RIIS_SEARCH_EXHAUSTIVE, 1, NULL);
  riis_mesh_destroy(&mesh);
  for (int n_callers = 2; n_callers <= 4; n_callers += 2)
    for (int n_threads = 1; n_threads <= 3; ++n_threads)
      for (int repeat = 0; repeat < 3; ++repeat) {
        pthread_barrier_t barrier;
        pthread_t threads[4];
        caller callers[4];
        mesh = mesh_from(&nodes);
        assert_int_equal(pthread_barrier_init(&barrier, NULL, (unsigned)n_callers), 0);
        for (int i = 0; i < n_callers; ++i) {
          callers[i] = (caller){surface, mesh, expected, &barrier, n_threads, 0};
          assert_int_equal(pthread_create(&threads[i], NULL, mark_with_own_result, &callers[i]), 0);
        }
        for (int i = 0; i < n_callers; ++i) assert_int_equal(pthread_join(threads[i], NULL), 0);
        for (int i = 0; i < n_callers; ++i) assert_int_equal(callers[i].n_wrong, 0);
        pthread_barrier_destroy(&barrier);
        riis_mesh_destroy(&mesh);
      }
  riis_mark_result_destroy(&expected);
  free_test_mesh(&nodes);
  riis_surface_destroy(&surface);
}

/* Returns 1 if the marking is not the expected one. */
static int marks_wrong(const riis_surface *surface, const riis_mesh *mesh, const riis_mark_result *expected,
                       int n_threads) {
  riis_mark_options options = {0};
  riis_mark_result *result = NULL;
  int wrong = riis_mark_options_init(&options, sizeof options) || riis_mark_result_create(&result);
  options.search = RIIS_SEARCH_NEIGHBOR;
  options.n_threads = n_threads;
  for (int step = 0; step < 2; ++step)
    wrong = wrong || riis_mark_nodes(surface, mesh, &options, result) || !same_results(result, expected);
  riis_mark_result_destroy(&result);
  return wrong;
}

static void inside_the_callers_openmp(void **state) {
  (void)state;
  riis_surface *surface = aortic_surface(NULL);
  test_mesh nodes = lattice_around(surface, 0.1, 0.2);
  riis_mesh *mesh = mesh_from(&nodes);
  riis_mark_result *expected = marked_by(surface, mesh, RIIS_SEARCH_EXHAUSTIVE, 1, NULL);
  for (int n_threads = 0; n_threads <= 3; ++n_threads)
    for (int nested = 1; nested <= 2; ++nested) { /* also regions within regions */
      const int levels = omp_get_max_active_levels();
      int n_wrong = 0;
      omp_set_max_active_levels(nested);
      /* Each time the mesh is one that no thread has searched. */
      riis_mesh_destroy(&mesh);
      mesh = mesh_from(&nodes);
#pragma omp parallel num_threads(3) reduction(+ : n_wrong)
      n_wrong += marks_wrong(surface, mesh, expected, n_threads);
      assert_int_equal(n_wrong, 0);
      riis_mesh_destroy(&mesh);
      mesh = mesh_from(&nodes);
#pragma omp parallel num_threads(3) shared(n_wrong)
#pragma omp single
      n_wrong += marks_wrong(surface, mesh, expected, n_threads);
      assert_int_equal(n_wrong, 0);
      riis_mesh_destroy(&mesh);
      mesh = mesh_from(&nodes);
#pragma omp parallel num_threads(3) shared(n_wrong)
#pragma omp single
      for (int task = 0; task < 8; ++task) {
#pragma omp task shared(n_wrong)
        {
          const int wrong = marks_wrong(surface, mesh, expected, n_threads);
#pragma omp atomic
          n_wrong += wrong;
        }
      }
      assert_int_equal(n_wrong, 0);
      omp_set_max_active_levels(levels);
    }
  riis_mark_result_destroy(&expected);
  riis_mesh_destroy(&mesh);
  free_test_mesh(&nodes);
  riis_surface_destroy(&surface);
}

static void the_callers_openmp_settings_stay(void **state) {
  (void)state;
  riis_surface *surface = aortic_surface(NULL);
  test_mesh nodes = lattice_around(surface, 0.1, 0.2);
  const int threads = omp_get_max_threads(), dynamic = omp_get_dynamic(), levels = omp_get_max_active_levels();
  omp_set_num_threads(3);
  omp_set_dynamic(1);
  omp_set_max_active_levels(2);
  omp_set_schedule(omp_sched_guided, 7);
  for (int n_threads = 0; n_threads <= 4; ++n_threads) {
    riis_mesh *mesh = mesh_from(&nodes);
    riis_mark_options options = mark_options();
    options.n_threads = n_threads;
    check_same_as_exhaustive(surface, mesh, options, NULL);
    omp_sched_t kind;
    int chunk;
    omp_get_schedule(&kind, &chunk);
    assert_int_equal(omp_get_max_threads(), 3);
    assert_int_equal(omp_get_dynamic(), 1);
    assert_int_equal(omp_get_max_active_levels(), 2);
    assert_int_equal(kind, omp_sched_guided);
    assert_int_equal(chunk, 7);
    riis_mesh_destroy(&mesh);
  }
  omp_set_num_threads(threads);
  omp_set_dynamic(dynamic);
  omp_set_max_active_levels(levels);
  free_test_mesh(&nodes);
  riis_surface_destroy(&surface);
}

/* --- Memory ---------------------------------------------------------------------------------------------------------- */

/* All allocations of the process pass through these functions, since an executable's symbols take precedence over the libraries'.
 * Allocations from the object that has riis_mark_nodes are counted. Sanitizers need their own allocators, so there is no counting
 * under them. */
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define IS_SANITIZED 1
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
#define IS_SANITIZED 1
#endif
#endif
#if defined(__GLIBC__) && defined(__x86_64__) && !defined(IS_SANITIZED)
#define COUNTS_ALLOCATIONS 1
void *__libc_malloc(size_t size);
void *__libc_calloc(size_t n, size_t size);
void *__libc_realloc(void *p, size_t size);
void *__libc_memalign(size_t alignment, size_t size);

static const void *counted_object; /* NULL: nothing is counted */
static int64_t n_counted;

static void *counted(void *p, const void *caller_address) {
  const void *const object = __atomic_load_n(&counted_object, __ATOMIC_ACQUIRE);
  Dl_info info;
  if (object && dladdr(caller_address, &info) && info.dli_fbase == object)
    __atomic_fetch_add(&n_counted, 1, __ATOMIC_RELAXED);
  return p;
}

void *malloc(size_t size) { return counted(__libc_malloc(size), __builtin_return_address(0)); }
void *calloc(size_t n, size_t size) { return counted(__libc_calloc(n, size), __builtin_return_address(0)); }
void *realloc(void *p, size_t size) { return counted(__libc_realloc(p, size), __builtin_return_address(0)); }
void *aligned_alloc(size_t alignment, size_t size) {
  return counted(__libc_memalign(alignment, size), __builtin_return_address(0));
}

/* operator new and new[], each also for aligned types. */
void *new_one(size_t size) __asm__("_Znwm");
void *new_many(size_t size) __asm__("_Znam");
void *new_aligned(size_t size, size_t alignment) __asm__("_ZnwmSt11align_val_t");
void *new_many_aligned(size_t size, size_t alignment) __asm__("_ZnamSt11align_val_t");

static void *or_abort(void *p) { return p ? p : (abort(), p); } /* C cannot throw */
void *new_one(size_t size) { return counted(or_abort(__libc_malloc(size ? size : 1)), __builtin_return_address(0)); }
void *new_many(size_t size) { return counted(or_abort(__libc_malloc(size ? size : 1)), __builtin_return_address(0)); }
void *new_aligned(size_t size, size_t alignment) {
  return counted(or_abort(__libc_memalign(alignment, size ? size : 1)), __builtin_return_address(0));
}
void *new_many_aligned(size_t size, size_t alignment) {
  return counted(or_abort(__libc_memalign(alignment, size ? size : 1)), __builtin_return_address(0));
}

static int64_t allocations_of_a_step(const riis_surface *surface, const riis_mesh *mesh,
                                     const riis_mark_options *options, riis_mark_result *result) {
  Dl_info info;
  void *function = dlsym(RTLD_DEFAULT, "riis_mark_nodes");
  assert_non_null(function);
  assert_true(dladdr(function, &info) != 0);
  n_counted = 0;
  __atomic_store_n(&counted_object, info.dli_fbase, __ATOMIC_RELEASE);
  const riis_status status = riis_mark_nodes(surface, mesh, options, result);
  __atomic_store_n(&counted_object, NULL, __ATOMIC_RELEASE);
  CHECK_OK(status);
  return n_counted;
}
#endif

static void a_steady_step_allocates_nothing(void **state) {
  (void)state;
#if defined(COUNTS_ALLOCATIONS)
  riis_surface *surface = aortic_surface(NULL);
  test_mesh nodes = lattice_around(surface, 0.09, 0.2);
  for (int wide = 0; wide < 2; ++wide)
    for (int32_t search = RIIS_SEARCH_EXHAUSTIVE; search <= RIIS_SEARCH_CLUSTERS; ++search) {
      riis_mesh *mesh = mesh_from(&nodes);
      riis_mark_result *result = new_result();
      riis_mark_options options = mark_options();
      options.search = search;
      options.n_threads = 1;
      if (wide) options.distance_limit = 0.2;
      /* The first step makes room. It shows that allocations are seen, both vectors' and aligned ones. */
      assert_true(allocations_of_a_step(surface, mesh, &options, result) > 5);
      allocations_of_a_step(surface, mesh, &options, result);
      for (int step = 3; step <= 5; ++step) assert_int_equal(allocations_of_a_step(surface, mesh, &options, result), 0);
      assert_true(marked_in(result).n > 1000);
      riis_mark_result_destroy(&result);
      riis_mesh_destroy(&mesh);
    }
  free_test_mesh(&nodes);
  riis_surface_destroy(&surface);
#else
  skip();
#endif
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(three_separate_cusps),
      cmocka_unit_test(mesh_of_several_components),
      cmocka_unit_test(bands_that_fall_apart_on_a_coarse_mesh),
      cmocka_unit_test(valve_that_sticks_out_of_the_mesh),
      cmocka_unit_test(isolated_nodes),
      cmocka_unit_test(any_adjacency_is_right),
      cmocka_unit_test(ghosts_are_passed_over),
      cmocka_unit_test(mesh_of_one_node),
      cmocka_unit_test(degenerate_meshes),
      cmocka_unit_test(nodes_at_the_limit_are_found),
      cmocka_unit_test(needles_lose_no_node),
      cmocka_unit_test(masked_nodes_are_left_out),
      cmocka_unit_test(mask_that_cuts_the_band),
      cmocka_unit_test(limits_wider_than_the_half_thickness),
      cmocka_unit_test(paper_finds_the_piece_that_it_starts_in),
      cmocka_unit_test(auto_is_never_incomplete),
      cmocka_unit_test(a_valve_moves),
      cmocka_unit_test(a_valve_jumps),
      cmocka_unit_test(a_result_goes_from_mesh_to_mesh),
      cmocka_unit_test(many_steps),
      cmocka_unit_test(nodes_move),
      cmocka_unit_test(non_finite_coordinates_are_refused),
      cmocka_unit_test(a_refused_update_forgets_where_nodes_were),
      cmocka_unit_test(any_number_of_threads_gives_the_same_bits),
      cmocka_unit_test(several_caller_threads_at_once),
      cmocka_unit_test(inside_the_callers_openmp),
      cmocka_unit_test(the_callers_openmp_settings_stay),
      cmocka_unit_test(a_steady_step_allocates_nothing),
  };
  rng = random_start("test_neighbor_search");
  return cmocka_run_group_tests(tests, NULL, NULL);
}
