/* SPDX-License-Identifier: Apache-2.0
 * The neighbour search gives the same result as the exhaustive search, bit for bit. The results agree for any mesh, adjacency,
 * mask, limit, number of threads and earlier marking. The paper's own algorithm finds only the connected part of the band in
 * which it starts, and reports that nodes may be missing. */
#include <riis/riis.h>

#include "test_support.h"

#include "handles.h"
#include "searches.h"

#include "neighbor_checks.h"

static random_source rng;

/* Returns how many nodes the paper's algorithm misses. The algorithm must report that it may miss nodes. */
static int64_t missed_by_the_paper(const riis_surface *surface, const riis_mesh *mesh, const uint8_t *mask) {
  const int owned_before = n_owned();
  riis_marks *paper = marked_by(surface, mesh, RIIS_SEARCH_PAPER, 2, mask);
  riis_marks *all = marked_by(surface, mesh, RIIS_SEARCH_EXHAUSTIVE, 2, mask);
  assert_int_equal(stats_of(paper).search, RIIS_SEARCH_PAPER);
  assert_int_equal(stats_of(paper).complete, 0);
  const int64_t missed = marked_in(all).n - marked_in(paper).n;
  free_owned_after(owned_before);
  return missed;
}

/* --- Bands and meshes in pieces -------------------------------------------------------------------------------------- */

TEST(three_separate_cusps) {
  static const char *const names[3] = {"right.translation", "left.translation", "non_coronary.translation"};
  static const double angle[3] = {0, 119.5, -121.5};
  riis_valve *valve = new_valve("aortic");
  for (int cusp = 0; cusp < 3; ++cusp) {
    const double a = angle[cusp] * 3.14159265358979323846 / 180, shift[3] = {cos(a), sin(a), -1};
    CHECK_OK(riis_valve_set(valve, names[cusp], 3, shift));
  }
  riis_surface *surface = new_surface(valve, NULL);
  test_mesh nodes = lattice_around(surface, 0.08, 0.15);
  riis_mesh *mesh = mesh_from(&nodes);
  const riis_mark_stats stats = check_same_as_exhaustive(surface, mesh, mark_options(), NULL);
  assert_int_equal(stats.n_unreached,
                   0); /* the walk starts in every ball near the surface, so it reaches the whole connected band */
  /* The paper's walk has one start, so it finds one cusp. */
  const int64_t missed = missed_by_the_paper(surface, mesh, NULL);
  assert_true(missed > stats.n_marked / 2 && missed < stats.n_marked);
  riis_marks *paper = marked_by(surface, mesh, RIIS_SEARCH_PAPER, 2, NULL);
  const found_nodes found = marked_in(paper);
  for (int64_t i = 0; i < found.n; ++i) assert_int_equal(found.leaflet_id[i], found.leaflet_id[0]);
  /* A walk starts from the marks of the paper's search. The final check then finds all other nodes. */
  riis_mark_options options = mark_options();
  assert_true(check_same_as_exhaustive(surface, mesh, options, paper).n_unreached == missed);
  assert_int_equal(check_same_as_exhaustive(surface, mesh, options, paper).n_unreached, 0);
}

/* The mesh consists of slabs without edges between them. The mesh contains one region twice: the second copy is shifted by half a
 * spacing. */
TEST(mesh_of_several_components) {
  riis_surface *surface = aortic_surface(NULL);
  test_mesh one = lattice_around(surface, 0.09, 0.15), two = {.n = 2 * one.n};
  two.xyz = own(malloc((size_t)two.n * 3 * sizeof *two.xyz));
  for (int64_t i = 0; i < 3 * one.n; ++i) two.xyz[i] = one.xyz[i], two.xyz[3 * one.n + i] = one.xyz[i] + 0.045;
  int64_t *pairs = own(malloc((size_t)one.offsets[one.n] * 4 * sizeof *pairs)), n_pairs = 0;
  for (int64_t i = 0; i < one.n; ++i)
    for (int64_t k = one.offsets[i]; k < one.offsets[i + 1]; ++k) {
      const int64_t j = one.columns[k];
      /* Leaves out pairs of nodes on two sides of x = -0.5, 0 or 0.5. */
      if (j < i || floor(2 * one.xyz[3 * i]) != floor(2 * one.xyz[3 * j])) continue;
      for (int64_t copy = 0; copy < 2; ++copy)
        pairs[2 * n_pairs] = i + copy * one.n, pairs[2 * n_pairs++ + 1] = j + copy * one.n;
    }
  set_rows(&two, n_pairs, pairs);
  riis_mesh *mesh = mesh_from(&two);
  const riis_mark_stats stats = check_same_as_exhaustive(surface, mesh, mark_options(), NULL);
  assert_true(stats.n_marked > 1000);
  assert_true(missed_by_the_paper(surface, mesh, NULL) > stats.n_marked / 2);
}

TEST(bands_that_fall_apart_on_a_coarse_mesh) {
  static const double half_thickness[4] = {0.05, 0.02, 0.005, 0.0005};
  for (int k = 0; k < 4; ++k) {
    const int owned_before = n_owned();
    riis_surface *surface = aortic_band(half_thickness[k]);
    test_mesh nodes = lattice_around(surface, 0.11, 0.2);
    riis_mesh *mesh = mesh_from(&nodes);
    riis_mark_options options = mark_options();
    const riis_mark_stats stats = check_same_as_exhaustive(surface, mesh, options, NULL);
    if (k < 3) {
      assert_true(stats.n_marked > 5);
      assert_true(missed_by_the_paper(surface, mesh, NULL) > 0);
    }
    free_owned_after(owned_before);
  }
}

TEST(valve_that_sticks_out_of_the_mesh) {
  riis_surface *surface = aortic_surface(NULL);
  const riis_surface_info info = info_of(surface);
  static const int64_t counts[3] = {24, 22, 26};
  /* Random boxes that contain a part of the valve, lie inside it, or miss it. */
  for (int trial = 0; trial < trials_of(60); ++trial) {
    const int owned_before = n_owned();
    double lower[3], upper[3];
    for (int c = 0; c < 3; ++c) {
      const double a = random_between(&rng, info.lower[c] - 0.3, info.upper[c] + 0.3);
      const double b = random_between(&rng, info.lower[c] - 0.3, info.upper[c] + 0.3);
      lower[c] = fmin(a, b), upper[c] = fmax(a, b);
    }
    if (trial == 0) /* this box always contains half of the valve */
      for (int c = 0; c < 3; ++c) lower[c] = info.lower[c], upper[c] = c ? info.upper[c] : 0;
    test_mesh nodes = lattice(counts, lower, upper);
    riis_mesh *mesh = mesh_from(&nodes);
    const riis_mark_stats stats = check_same_as_exhaustive(surface, mesh, mark_options(), NULL);
    if (trial == 0) assert_true(stats.n_marked > 500);
    free_owned_after(owned_before);
  }
}

TEST(isolated_nodes) {
  riis_surface *surface = aortic_surface(NULL);
  test_mesh nodes = lattice_around(surface, 0.07, 0.15);
  set_rows(&nodes, 0, NULL);
  riis_mesh *mesh = mesh_from(&nodes);
  riis_csr csr = csr_of(&nodes);
  csr.columns = NULL;
  CHECK_OK(riis_mesh_set_adjacency(mesh, &csr));
  riis_marks *result = new_result();
  const riis_mark_stats first = check_same_as_exhaustive(surface, mesh, mark_options(), result);
  assert_true(first.n_marked > 1000);
  assert_true(first.n_unreached > first.n_marked / 2); /* each walk ends after one step */
  /* The second search starts a walk at every node that the first search marked. */
  assert_int_equal(check_same_as_exhaustive(surface, mesh, mark_options(), result).n_unreached, 0);
  assert_true(missed_by_the_paper(surface, mesh, NULL) >= first.n_marked - 1);
}

/* The adjacency determines only the order of queries, so the result does not depend on the adjacency. */
TEST(any_adjacency_is_right) {
  riis_surface *surface = aortic_surface(NULL);
  test_mesh nodes = lattice_around(surface, 0.1, 0.3);
  for (int trial = 0; trial < trials_of(24); ++trial) {
    const int64_t n_pairs = trial * nodes.n / 2;
    int64_t *pairs = own(malloc((size_t)(2 * n_pairs + 1) * sizeof *pairs));
    for (int64_t k = 0; k < 2 * n_pairs; ++k) pairs[k] = (int64_t)(random_bits(&rng) % (uint64_t)nodes.n);
    set_rows(&nodes, n_pairs, pairs);
    riis_mesh *mesh = mesh_from(&nodes);
    riis_mark_options options = mark_options();
    options.n_threads = 1 + trial % 4;
    check_same_as_exhaustive(surface, mesh, options, NULL);
  }
  /* In the first mesh, each node's only neighbour is the next node of a ring. In the second mesh, every node is its own
   * neighbour, many times. */
  for (int self = 0; self < 2; ++self) {
    nodes.columns = own(malloc((size_t)nodes.n * 5 * sizeof *nodes.columns));
    for (int64_t i = 0; i < nodes.n; ++i) {
      nodes.offsets[i + 1] = 5 * (i + 1);
      for (int k = 0; k < 5; ++k) nodes.columns[5 * i + k] = self ? i : (i + 1) % nodes.n;
    }
    riis_mesh *mesh = mesh_from(&nodes);
    check_same_as_exhaustive(surface, mesh, mark_options(), NULL);
  }
}

/* Rows also contain nodes of other ranks. The indices have every width, and count from 0 and from 1. */
TEST(ghosts_are_passed_over) {
  riis_surface *surface = aortic_surface(NULL);
  test_mesh nodes = lattice_around(surface, 0.1, 0.15);
  const int64_t n_entries = nodes.offsets[nodes.n] + nodes.n, n_all = nodes.n + 1000;
  int32_t *offsets = own(malloc((size_t)(nodes.n + 1) * sizeof *offsets));
  int32_t *columns = own(malloc((size_t)n_entries * sizeof *columns));
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
  assert_int_equal(stats.n_queries, plain.n_queries); /* the walk was the same */
  assert_int_equal(stats.n_unreached, plain.n_unreached);
}

TEST(mesh_of_one_node) {
  riis_surface *surface = aortic_surface(NULL);
  const double *vertices = triangles_of(surface).xyz;
  const double places[3][3] = {{vertices[0], vertices[1], vertices[2] + 0.05}, {0, 0, 50}, {1e60, -1e60, 1e60}};
  for (int k = 0; k < 3; ++k)
    for (int self = 0; self < 2; ++self) {
      const int owned_before = n_owned();
      double xyz[3] = {places[k][0], places[k][1], places[k][2]};
      int64_t offsets[2] = {0, self}, columns[1] = {0};
      test_mesh one = {1, xyz, offsets, columns};
      riis_mesh *mesh = mesh_from(&one);
      riis_mark_options options = mark_options();
      riis_marks *result = new_result();
      for (int again = 0; again < 2; ++again)
        assert_int_equal(check_same_as_exhaustive(surface, mesh, options, result).n_marked, k == 0);
      const uint8_t mask = 0;
      options.node_mask = &mask;
      assert_int_equal(check_same_as_exhaustive(surface, mesh, options, result).n_marked, 0);
      free_owned_after(owned_before);
    }
}

/* The nodes coincide, lie on a line or in a plane, or are far apart. */
TEST(degenerate_meshes) {
  riis_surface *surface = aortic_surface(NULL);
  static const int64_t counts[5][3] = {{3000, 1, 1}, {1, 60, 50}, {1, 1, 2000}, {12, 12, 12}, {12, 12, 12}};
  for (int k = 0; k < 5; ++k) {
    const int owned_before = n_owned();
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
    options.distance_limit = 1e60; /* includes all nodes */
    assert_int_equal(check_same_as_exhaustive(surface, mesh, options, NULL).n_within_limit, nodes.n);
    free_owned_after(owned_before);
  }
}

/* A column of nodes stands over a triangle of any size. The limit is the distance that the library computes for the first node.
 * The other nodes are equally far, up to rounding, so the search's check compares nearly equal numbers. Rounding must not lose a
 * node. */
TEST(nodes_at_the_limit_are_found) {
  static const int32_t ids[3] = {0, 1, 2};
  for (int trial = 0; trial < trials_of(9000); ++trial) {
    const int owned_before = n_owned();
    const double size = pow(10, random_between(&rng, -1, 6)), origin = trial % 3 ? 0 : random_between(&rng, -300, 300);
    double corners[9], normal[3], xyz[3 * 40], ab[3], ac[3];
    for (int k = 0; k < 9; ++k) corners[k] = size * random_between(&rng, -1, 1);
    for (int c = 0; c < 3; ++c) ab[c] = corners[3 + c] - corners[c], ac[c] = corners[6 + c] - corners[c];
    for (int c = 0; c < 3; ++c) normal[c] = ab[(c + 1) % 3] * ac[(c + 2) % 3] - ab[(c + 2) % 3] * ac[(c + 1) % 3];
    const double length = sqrt(normal[0] * normal[0] + normal[1] * normal[1] + normal[2] * normal[2]);
    const double b = random_between(&rng, 0.1, 0.5), a = random_between(&rng, 0.1, 0.4);
    for (int c = 0; c < 3; ++c) { /* moves the column's foot to the origin */
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
    free_owned_after(owned_before);
  }
}

/* The triangles are needles with a height of nearly 0. The distance of the nodes from the needles is as small as this height. The
 * limit is the first node's distance. The rounding of distances to needles must not lose a node. */
TEST(needles_lose_no_node) {
  static const int32_t ids[3] = {0, 1, 2};
  int n_surfaces = 0;
  for (int trial = 0; trial < trials_of(18000); ++trial) {
    const int owned_before = n_owned();
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
    /* A triangle of this thinness may count as having no area. */
    if (riis_surface_create_from_arrays(&arrays, NULL, &surface) != RIIS_OK) continue;
    own(surface);
    options.half_thickness = fmax(closest_to(surface, xyz[0], xyz[1], xyz[2]).distance, 1e-40);
    CHECK_OK(riis_surface_update_from_arrays(surface, &arrays, &options));
    test_mesh nodes = {.n = 2, .xyz = xyz};
    set_rows(&nodes, 0, NULL);
    riis_mesh *mesh = mesh_from(&nodes);
    riis_mark_options marking = mark_options();
    marking.n_threads = 1;
    assert_true(check_same_as_exhaustive(surface, mesh, marking, NULL).n_marked >= 1);
    ++n_surfaces;
    free_owned_after(owned_before);
  }
  CHECK_MET(n_surfaces > 3000);
}

/* --- Masks, limits --------------------------------------------------------------------------------------------------- */

TEST(masked_nodes_are_left_out) {
  riis_surface *surface = aortic_surface(NULL);
  test_mesh nodes = lattice_around(surface, 0.08, 0.15);
  riis_mesh *mesh = mesh_from(&nodes);
  uint8_t *mask = own(malloc((size_t)nodes.n));
  riis_marks *reused = new_result();
  riis_mark_options options = mark_options();
  options.node_mask = mask;
  for (int trial = 0; trial < trials_of(27); ++trial) {
    const int owned_before = n_owned();
    for (int64_t i = 0; i < nodes.n; ++i) mask[i] = (uint8_t)(random_bits(&rng) % 8 >= (uint64_t)trial ? 200 : 0);
    riis_marks *fresh = new_result();
    check_same_as_exhaustive(surface, mesh, options, fresh);
    const riis_mark_stats stats =
        /* Each later trial starts from the marks of the preceding trial, which had another mask. */
        check_same_as_exhaustive(surface, mesh, options, reused);
    const found_nodes found = within_in(reused);
    for (int64_t i = 0; i < found.n; ++i) assert_true(mask[found.node_id[i]]);
    if (trial == 8) {
      assert_int_equal(stats.n_within_limit, 0);
      missed_by_the_paper(surface, mesh, mask); /* no node of the earlier marks is in this mask, so no walk can start */
    } else {
      assert_true(stats.n_within_limit > 100);
    }
    free_owned_after(owned_before);
  }
}

/* A wall of one layer of masked nodes cuts a connected band, and no walk passes it. */
TEST(mask_that_cuts_the_band) {
  const double corners[9] = {-1, -1, 0, 1, -1, 0, 0, 2, 0};
  const int32_t ids[3] = {0, 1, 2};
  riis_surface_arrays arrays = triangle_arrays(3, corners, 1, ids);
  riis_surface *surface = surface_from(&arrays, NULL);
  test_mesh nodes = lattice_around(surface, 0.05, 0.2);
  riis_mesh *mesh = mesh_from(&nodes);
  assert_int_equal(missed_by_the_paper(surface, mesh, NULL), 0); /* without the wall the band is connected */
  uint8_t *mask = own(malloc((size_t)nodes.n));
  double wall = 10;
  for (int64_t i = 0; i < nodes.n; ++i)
    if (fabs(nodes.xyz[3 * i]) < fabs(wall)) wall = nodes.xyz[3 * i];
  for (int64_t i = 0; i < nodes.n; ++i) mask[i] = nodes.xyz[3 * i] != wall;
  riis_mark_options options = mark_options();
  options.node_mask = mask;
  const riis_mark_stats stats = check_same_as_exhaustive(surface, mesh, options, NULL);
  const int64_t missed = missed_by_the_paper(surface, mesh, mask);
  assert_true(missed > stats.n_marked / 3 && missed < stats.n_marked);
  riis_marks *paper = marked_by(surface, mesh, RIIS_SEARCH_PAPER, 2, mask);
  const found_nodes found = marked_in(paper);
  for (int64_t i = 0; i < found.n; ++i)
    assert_true(nodes.xyz[3 * found.node_id[i]] < wall); /* the node is on the first vertex's side of the wall */
  /* The walk starts from the marks on one side and does not reach the other side. The final check reaches it. */
  assert_int_equal(check_same_as_exhaustive(surface, mesh, options, paper).n_unreached, missed);
}

TEST(limits_wider_than_the_half_thickness) {
  riis_surface *surface = aortic_surface(NULL);
  test_mesh nodes = lattice_around(surface, 0.25, 1);
  riis_mesh *mesh = mesh_from(&nodes);
  static const double limits[7] = {0.1, 0.11, 0.3, 5, 0.2, 1e60, 0.1};
  riis_marks *reused = new_result();
  for (int k = 0; k < 7; ++k) {
    riis_mark_options options = mark_options();
    options.distance_limit = limits[k];
    const riis_mark_stats stats = check_same_as_exhaustive(surface, mesh, options, reused);
    check_same_as_exhaustive(surface, mesh, options, NULL);
    if (limits[k] > 4) assert_int_equal(stats.n_within_limit, nodes.n);
  }
}

/* --- The paper's algorithm ------------------------------------------------------------------------------------------- */

/* The paper's algorithm starts at the node nearest to the first vertex. The algorithm must find exactly the marked nodes that
 * marked neighbours connect to this node. */
TEST(paper_finds_the_piece_that_it_starts_in) {
  static const double half_thickness[4] = {0.03, 0.06, 0.1, 0.3};
  for (int k = 0; k < 4; ++k) {
    const int owned_before = n_owned();
    riis_surface *surface = aortic_band(half_thickness[k]);
    test_mesh nodes = lattice_around(surface, 0.1, 0.3);
    for (int64_t i = 0; i < 3 * nodes.n; ++i)
      nodes.xyz[i] += random_between(&rng, -0.02, 0.02); /* a random shift, so that no two nodes are equally near */
    riis_mesh *mesh = mesh_from(&nodes);
    riis_marks *all = marked_by(surface, mesh, RIIS_SEARCH_EXHAUSTIVE, 1, NULL);
    riis_marks *paper = marked_by(surface, mesh, RIIS_SEARCH_PAPER, 2, NULL);
    const double *vertices = triangles_of(surface).xyz;
    const int64_t *vertex_id = triangles_of(surface).vertex_id;
    const double *first = vertices + 3 * vertex_id[0];
    uint8_t *marked = own(calloc((size_t)nodes.n, 1));
    int64_t *queue = own(malloc((size_t)nodes.n * sizeof *queue)), n_queued = 0, start = 0;
    double least = INFINITY;
    CHECK_OK(dense_of(all, nodes.n, 1e30, marked, NULL, NULL, NULL));
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
    free_owned_after(owned_before);
  }
}

/* The search that the library chooses by default is complete with or without an adjacency. */
TEST(auto_is_never_incomplete) {
  riis_surface *surface = aortic_surface(NULL);
  test_mesh nodes = lattice_around(surface, 0.2, 0.2);
  riis_mesh *mesh = mesh_from(&nodes);
  riis_marks *result = new_result();
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
}

int main(void) {
  rng = random_start("test_neighbor_search");
  return run_cases(NULL, NULL);
}
