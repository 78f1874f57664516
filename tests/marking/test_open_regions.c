/* SPDX-License-Identifier: Apache-2.0
 * Compares labels of open regions with a serial flood fill, on random graphs, on long chains and around valves. RIIS_TEST_LONG=1
 * tries many more cases. */
#include <riis/riis.h>

#include "test_support.h"

#include "handles.h"
#include "searches.h"

#include "random_meshes.h"

#include "flood_fill.h"

/* Labels the regions with 1, 2 and 4 threads, checks the labels, and returns the number of regions. */
static int64_t check_labels(const test_mesh *graph, const riis_mesh *mesh, const riis_marks *result,
                            const uint8_t *mask) {
  const test_mesh rows = both_ways(graph);
  const size_t n = (size_t)graph->n;
  int64_t *expected = own(malloc(n * sizeof *expected)), *label = own(malloc(n * sizeof *label));
  uint8_t *is_open = own(malloc(n));
  CHECK_OK(dense_of(result, graph->n, 2e60, is_open, NULL, NULL, NULL));
  for (size_t i = 0; i < n; ++i) is_open[i] = !is_open[i] && (!mask || mask[i]);
  const int64_t n_regions = flood_fill(&rows, is_open, expected);
  static const int32_t threads[] = {1, 2, 4};
  for (int t = 0; t < 3; ++t) {
    int64_t found = -1;
    riis_mark_options options = mark_options();
    options.node_mask = mask;
    options.n_threads = threads[t];
    memset(label, 0x5a, n * sizeof *label);
    CHECK_OK(riis_label_open_regions(mesh, result, &options, graph->n, label, t == 2 ? NULL : &found));
    assert_memory_equal(label, expected, n * sizeof *label);
    if (t < 2) assert_int_equal(found, n_regions);
  }
  return n_regions;
}

TEST(graphs_are_labelled_as_the_flood_fill_does) {
  const int n_trials = trials(100, 20000);
  int n_many = 0;
  for (int trial = 0; trial < n_trials; ++trial) {
    const int owned_before = n_owned();
    const int64_t n = one_in(10) ? random_integer(4096, 30000) : random_integer(1, 200);
    const test_mesh graph = random_graph(n, random_between(&rng, 0.5, 2.5));
    riis_surface *surface = random_surface();
    riis_mesh *mesh = mesh_of_graph(&graph);
    riis_marks *result = new_result();
    riis_mark_options options = mark_options();
    uint8_t *mask = own(malloc((size_t)n));
    for (int64_t i = 0; i < n; ++i) mask[i] = !one_in(5);
    if (one_in(3)) options.node_mask = mask;
    CHECK_OK(riis_mark_nodes(surface, mesh, &options, result));
    n_many += check_labels(&graph, mesh, result, options.node_mask) > 1;
    free_owned_after(owned_before);
  }
  CHECK_MET(n_many > n_trials / 2);
}

/* Makes a surface that is far from all nodes. */
static riis_surface *far_surface(void) {
  static const double xyz[9] = {1e3, 0, 0, 1e3, 1, 0, 1e3, 0, 1};
  static const int32_t ids[3] = {0, 1, 2};
  const riis_surface_arrays arrays = triangle_arrays(3, xyz, 1, ids);
  return surface_from(&arrays, NULL);
}

/* A chain's nodes are numbered in any order, so the labelling joins trees many times. Some links between the nodes are
 * missing. */
TEST(chains_are_labelled_as_the_flood_fill_does) {
  riis_surface *surface = far_surface();
  for (int trial = 0; trial < 6; ++trial) {
    const int owned_before = n_owned();
    test_mesh chain = {.n = 60000};
    chain.xyz = own(calloc((size_t)chain.n * 3, sizeof *chain.xyz));
    int64_t *pairs = own(malloc((size_t)chain.n * 2 * sizeof *pairs)), n_pairs = 0;
    for (int64_t i = 0; i + 1 < chain.n; ++i)
      if (trial < 2 || !one_in(1000)) pairs[2 * n_pairs] = i, pairs[2 * n_pairs++ + 1] = i + 1;
    set_rows(&chain, n_pairs, pairs);
    if (trial % 2) shuffle(&chain);
    riis_mesh *mesh = mesh_of_graph(&chain);
    riis_marks *result = new_result();
    CHECK_OK(riis_mark_nodes(surface, mesh, NULL, result));
    const int64_t n_regions = check_labels(&chain, mesh, result, NULL);
    assert_true(trial < 2 ? n_regions == 1 : n_regions > 20);
    free_owned_after(owned_before);
  }
}

TEST(meshes_round_valves_are_labelled_as_the_flood_fill_does) {
  for (int trial = 0; trial < 6; ++trial) {
    const int owned_before = n_owned();
    riis_valve *valve = new_valve(trial % 2 ? "mitral" : "aortic");
    CHECK_OK(riis_valve_set_scalar(valve, "opening", 0));
    riis_surface_options options = surface_options();
    options.half_thickness = trial < 4 ? 0.1 : 0.3; /* the larger half thickness closes off pockets */
    riis_surface *surface = new_surface(valve, &options);
    const riis_surface_info info = info_of(surface);
    double spacing;
    const test_mesh nodes = random_mesh(trial % n_kinds, 30000, info.lower, info.upper, &spacing);
    riis_mesh *mesh = mesh_from(&nodes);
    riis_marks *result = new_result();
    CHECK_OK(riis_mark_nodes(surface, mesh, NULL, result));
    assert_true(marked_in(result).n > 0);
    check_labels(&nodes, mesh, result, NULL);
    free_owned_after(owned_before);
  }
}

/* The rows have 32 bits and count from 1, as in Fortran codes. The labels are ids that count from 0. */
TEST(rows_that_count_from_1_give_the_same_labels) {
  static const int32_t offsets[6] = {1, 2, 2, 3, 4, 4}, columns[3] = {3, 5, 2}; /* the edges 0-2, 2-4 and 1-3 */
  static const double xyz[15] = {0};
  riis_mesh *mesh = mesh_of(5, xyz);
  riis_csr csr;
  CHECK_OK(riis_csr_init(&csr, sizeof csr));
  csr.n_rows = 5, csr.offsets = offsets, csr.columns = columns, csr.index_base = 1;
  CHECK_OK(riis_mesh_set_adjacency(mesh, &csr));
  riis_marks *result = new_result();
  CHECK_OK(riis_mark_nodes(far_surface(), mesh, NULL, result));
  static const int64_t expected[5] = {0, 1, 0, 1, 0};
  int64_t label[5], n_regions = 0;
  CHECK_OK(riis_label_open_regions(mesh, result, NULL, 5, label, &n_regions));
  assert_memory_equal(label, expected, sizeof label);
  assert_int_equal(n_regions, 2);
}

TEST(what_makes_no_sense_is_refused) {
  const test_mesh nodes = tube(0.5, 0, 1, 0.25);
  riis_mesh *mesh = mesh_from(&nodes), *bare = mesh_of(nodes.n, nodes.xyz), *fewer = mesh_of(3, nodes.xyz);
  const int64_t none[4] = {0};
  riis_csr csr = csr_of(&nodes);
  csr.n_rows = 3, csr.offsets = none;
  CHECK_OK(riis_mesh_set_adjacency(fewer, &csr));
  riis_marks *result = new_result();
  int64_t *label = own(malloc((size_t)nodes.n * sizeof *label));
  memset(label, 0x5a, (size_t)nodes.n * sizeof *label);
#define REFUSED(status, parts, mesh, options, n, label) \
  CHECK_REFUSED(status, parts, riis_label_open_regions(mesh, result, options, n, label, NULL))
  REFUSED(RIIS_INVALID_ARGUMENT, "marks are empty|riis_mark_nodes", mesh, NULL, nodes.n, label);
  CHECK_OK(riis_mark_nodes(far_surface(), mesh, NULL, result));
  REFUSED(RIIS_INVALID_ARGUMENT, "mesh has no adjacency|riis_mesh_set_adjacency", bare, NULL, nodes.n, label);
  REFUSED(RIIS_INVALID_ARGUMENT, "marks are of a mesh with|mesh has 3", fewer, NULL, 3, label);
  REFUSED(RIIS_INVALID_ARGUMENT, "n_nodes is 4", mesh, NULL, 4, label);
  REFUSED(RIIS_INVALID_ARGUMENT, "label is NULL", mesh, NULL, nodes.n, NULL);
  riis_mark_options options = mark_options();
  options.n_threads = -1;
  REFUSED(RIIS_INVALID_ARGUMENT, "options.n_threads is -1", mesh, &options, nodes.n, label);
  const double limits[] = {NAN, 0, 1e61};
  for (int i = 0; i < 3; ++i) {
    options = mark_options();
    options.distance_limit = limits[i];
    REFUSED(RIIS_INVALID_ARGUMENT, "options.distance_limit is |must be from the half thickness", mesh, &options,
            nodes.n, label);
  }
  options = mark_options();
  options.search = 5;
  REFUSED(RIIS_INVALID_ARGUMENT, "options.search is 5", mesh, &options, nodes.n, label);
  options = mark_options();
  options.instructions = 4;
  REFUSED(RIIS_INVALID_ARGUMENT, "options.instructions is 4", mesh, &options, nodes.n, label);
  options = mark_options();
  options.struct_size = 24;
  REFUSED(RIIS_INVALID_STRUCT_SIZE, "options is 24", mesh, &options, nodes.n, label);
  for (int64_t i = 0; i < nodes.n; ++i) assert_int_equal(label[i], 0x5a5a5a5a5a5a5a5a);
}

int main(void) {
  rng = random_start("test_open_regions");
  return run_cases(NULL, NULL);
}
