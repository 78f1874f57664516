/* SPDX-License-Identifier: Apache-2.0
 * Tests leaks, which are edges that cross the surface between unmarked nodes. The leaks of valves are compared with a loop in
 * extended precision. The leaks of plates are known. */
#include <riis/riis.h>

#include "test_support.h"

#include "handles.h"
#include "searches.h"

#include "leak_lists.h"

static random_source rng;

/* --- Valves ------------------------------------------------------------------------------------------------------------ */

/* Returns how deep inside the triangle the segment passes, as a fraction of the triangle's size. The result is negative if the
 * segment passes outside the triangle. */
static long double depth_in(const double *a, const double *b, const double *const *corner) {
  long double e1[3], e2[3], along[3], from[3], p[3], q[3], det = 0, t = 0, u = 0, v = 0;
  for (int i = 0; i < 3; ++i) {
    e1[i] = (long double)corner[1][i] - corner[0][i], e2[i] = (long double)corner[2][i] - corner[0][i];
    along[i] = (long double)b[i] - a[i], from[i] = (long double)a[i] - corner[0][i];
  }
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    p[i] = along[j] * e2[k] - along[k] * e2[j], q[i] = from[j] * e1[k] - from[k] * e1[j];
  }
  for (int i = 0; i < 3; ++i) det += e1[i] * p[i], t += e2[i] * q[i], u += from[i] * p[i], v += along[i] * q[i];
  if (det == 0) return -1;
  t /= det, u /= det, v /= det;
  const long double depths[5] = {t, 1 - t, u, v, 1 - u - v};
  long double least = 1;
  for (int i = 0; i < 5; ++i) least = depths[i] < least ? depths[i] : least;
  return least;
}

/* Compares every edge between two unmarked nodes, however short, with every triangle. */
static int64_t check_against_valve(const test_mesh *nodes, const riis_surface *surface, const uint8_t *marks,
                                   leak_list list) {
  const riis_triangles all = triangles_of(surface);
  int64_t next = 0;
  for (int64_t a = 0; a < nodes->n; ++a)
    for (int64_t k = nodes->offsets[a]; k < nodes->offsets[a + 1]; ++k) {
      const int64_t b = nodes->columns[k];
      if (b <= a || marks[a] || marks[b]) continue;
      long double deepest = -1;
      for (int64_t t = 0; t < all.n_triangles; ++t) {
        const int64_t *id = all.vertex_id + 3 * t;
        const double *corner[3] = {all.xyz + 3 * id[0], all.xyz + 3 * id[1], all.xyz + 3 * id[2]};
        const long double depth = depth_in(nodes->xyz + 3 * a, nodes->xyz + 3 * b, corner);
        if (depth > deepest) deepest = depth;
      }
      const int is_listed = next < list.sum.n_edges && list.node_id[2 * next] == a && list.node_id[2 * next + 1] == b;
      if (fabsl(deepest) > 1e-12L && is_listed != (deepest > 0))
        fail_msg("edge %lld %lld, depth %Lg: %d", (long long)a, (long long)b, deepest, is_listed);
      next += is_listed;
    }
  assert_int_equal(next, list.sum.n_edges);
  return next;
}

static int ascending_columns(const void *a, const void *b) {
  return (*(const int64_t *)a > *(const int64_t *)b) - (*(const int64_t *)a < *(const int64_t *)b);
}

/* Makes a jittered lattice around a valve, with ascending rows. */
static test_mesh mesh_round(const riis_surface *surface, double spacing) {
  const riis_surface_info info = info_of(surface);
  int64_t counts[3];
  double lower[3], upper[3];
  for (int i = 0; i < 3; ++i) {
    lower[i] = info.lower[i] - 0.3 + random_between(&rng, -0.1, 0);
    counts[i] = 2 + (int64_t)((info.upper[i] - lower[i] + 0.3) / spacing);
    upper[i] = lower[i] + spacing * (double)(counts[i] - 1);
  }
  test_mesh nodes = lattice(counts, lower, upper);
  for (int64_t i = 0; i < nodes.n; ++i)
    qsort(nodes.columns + nodes.offsets[i], (size_t)(nodes.offsets[i + 1] - nodes.offsets[i]), sizeof *nodes.columns,
          ascending_columns);
  return nodes;
}

static riis_surface *valve_surface(const char *kind, double opening, int32_t distance) {
  riis_surface_options options = surface_options();
  options.measure = distance;
  options.tolerance = 0.5;
  riis_valve *valve = new_valve(kind);
  CHECK_OK(riis_valve_set_scalar(valve, "opening", opening));
  riis_surface *surface = new_surface(valve, &options);
  free_one_owned(valve);
  return surface;
}

/* The marks may come from any method of measuring distances. */
TEST(valves_leak_where_the_loop_says) {
  static const char *const kinds[2] = {"aortic", "mitral"};
  int64_t n_leaking[3] = {0, 0, 0};
  for (int trial = 0; trial < trials_of(36); ++trial) {
    const int owned_before = n_owned();
    riis_surface *surface = valve_surface(kinds[trial % 2], 0, (int32_t)(trial % 3));
    test_mesh nodes = mesh_round(surface, trial < 6 ? 0.27 : 0.24);
    riis_mesh *mesh = mesh_with_rows(&nodes, 0);
    riis_marks *result = new_result();
    uint8_t *marks = own(malloc((size_t)nodes.n));
    CHECK_OK(riis_mark_nodes(surface, mesh, NULL, result));
    CHECK_OK(dense_of(result, nodes.n, 1e30, marks, NULL, NULL, NULL));
    n_leaking[trial % 3] += check_against_valve(&nodes, surface, marks, leaks_of(surface, mesh, NULL, result));
    free_owned_after(owned_before);
  }
  for (int i = 0; i < 3; ++i) CHECK_MET(n_leaking[i] > 0);
}

/* Edges of at most two half thicknesses cannot leak, even if a plane halves such an edge. */
TEST(short_edges_do_not_leak) {
  for (int trial = 0; trial < 4; ++trial) {
    const int owned_before = n_owned();
    riis_surface *surface = valve_surface(trial % 2 ? "mitral" : "aortic", 0, RIIS_MEASURE_TRIANGLES);
    test_mesh nodes = mesh_round(surface, 0.2 * (1 - 1e-15));
    riis_mesh *mesh = mesh_with_rows(&nodes, 0);
    riis_marks *result = new_result();
    CHECK_OK(riis_mark_nodes(surface, mesh, NULL, result));
    assert_int_equal(leaks_of(surface, mesh, NULL, result).sum.n_edges, 0);
    free_owned_after(owned_before);
  }
}

/* --- Plates ------------------------------------------------------------------------------------------------------------ */

/* Makes the squares [-1, 1]^2 at the heights 0 and 10, with half thickness 0.25. */
static riis_surface *two_plates(void) {
  static const double xyz[24] = {-1, -1, 0, 1, -1, 0, 1, 1, 0, -1, 1, 0, -1, -1, 10, 1, -1, 10, 1, 1, 10, -1, 1, 10};
  static const int32_t ids[12] = {0, 1, 2, 0, 2, 3, 4, 5, 6, 4, 6, 7};
  riis_surface_arrays arrays = triangle_arrays(8, xyz, 4, ids);
  riis_surface_options options = surface_options();
  options.half_thickness = 0.25;
  return surface_from(&arrays, &options);
}

/* Makes a column of nodes along z. Each node is joined to the next node. */
static test_mesh column_of_nodes(int64_t n, double from, double step) {
  const int64_t counts[3] = {1, 1, n};
  const double lower[3] = {0, 0, from}, upper[3] = {0, 0, from + step * (double)(n - 1)};
  return lattice(counts, lower, upper);
}

/* If the search may have missed nodes, short edges are also examined. */
TEST(what_the_papers_search_misses_leaks) {
  test_mesh nodes = column_of_nodes(121, -1, 0.1);
  riis_surface *surface = two_plates();
  riis_mesh *mesh = mesh_with_rows(&nodes, 0);
  riis_marks *result = new_result();
  riis_mark_options options = mark_options();
  CHECK_OK(riis_mark_nodes(surface, mesh, &options, result));
  assert_int_equal(leaks_of(surface, mesh, &options, result).sum.n_edges, 0);
  options.search = RIIS_SEARCH_PAPER;
  CHECK_OK(riis_mark_nodes(surface, mesh, &options, result));
  const leak_list list = leaks_of(surface, mesh, &options, result);
  /* If a node lies on the plate, two edges touch the plate there. */
  assert_true(list.sum.n_edges == 1 || list.sum.n_edges == 2);
  CHECK_NEAR(list.sum.longest_middle[2], 10, 0.06);
}

/* The list reflects the present mesh and adjacency, and the last marking. */
TEST(changes_are_seen) {
  test_mesh nodes = column_of_nodes(12, -0.5, 1);
  riis_surface *surface = two_plates();
  riis_mesh *mesh = mesh_with_rows(&nodes, 0);
  riis_marks *result = new_result();
  CHECK_OK(riis_mark_nodes(surface, mesh, NULL, result));
  leak_list list = leaks_of(surface, mesh, NULL, result);
  assert_int_equal(list.sum.n_edges, 2);
  assert_int_equal(list.node_id[0], 0);
  assert_int_equal(list.node_id[3], 11);
  CHECK_SAME(list.sum.half_thickness, 0.5);

  uint8_t mask[12] = {1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 0};
  riis_mark_options options = mark_options();
  options.node_mask = mask;
  CHECK_OK(riis_mark_nodes(surface, mesh, &options, result));
  assert_int_equal(leaks_of(surface, mesh, &options, result).sum.n_edges, 1);

  for (int64_t i = 0; i < nodes.n; ++i) nodes.xyz[3 * i + 2] += 0.3;
  CHECK_OK(riis_mesh_update(mesh, nodes.n, nodes.xyz, nodes.xyz + 1, nodes.xyz + 2, 3));
  CHECK_OK(riis_mark_nodes(surface, mesh, NULL, result));
  assert_int_equal(leaks_of(surface, mesh, NULL, result).sum.n_edges, 0); /* nodes at 0.2 from the plates are marked */

  static const int64_t offsets[13] = {0, 0, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1}, columns[1] = {11};
  riis_csr csr;
  CHECK_OK(riis_csr_init(&csr, sizeof csr));
  csr.n_rows = 12, csr.offsets = offsets, csr.columns = columns, csr.offset_bits = csr.column_bits = 64;
  CHECK_OK(riis_mesh_set_adjacency(mesh, &csr));
  list = leaks_of(surface, mesh, NULL, result); /* nodes from z = 0.8 to 10.8 */
  assert_int_equal(list.sum.n_edges, 1);
  CHECK_NEAR(list.sum.longest_length, 10, 1e-14);
  CHECK_NEAR(list.sum.half_thickness, 0.8, 1e-14);
}

/* --- Refusals ---------------------------------------------------------------------------------------------------------- */

TEST(what_makes_no_sense_is_refused) {
  test_mesh nodes = column_of_nodes(12, -0.5, 1), fewer = column_of_nodes(5, 0, 1);
  riis_surface *surface = two_plates();
  riis_mesh *mesh = mesh_with_rows(&nodes, 0), *other = mesh_with_rows(&fewer, 0);
  riis_marks *result = new_result();
  riis_leak_list leaks;
  memset(&leaks, 0x5a, sizeof leaks);
#define REFUSED(status, parts, a_mesh) \
  CHECK_REFUSED(status, parts, find_leaks_in(surface, a_mesh, result, NULL, &leaks))
  REFUSED(RIIS_INVALID_ARGUMENT, "marks are empty|riis_mark_nodes", mesh);
  CHECK_OK(riis_mark_nodes(surface, mesh, NULL, result));
  REFUSED(RIIS_INVALID_ARGUMENT, "marks are of a mesh with 12 nodes|mesh has 5", other);
  assert_int_equal(leaks.n_edges, 0x5a5a5a5a5a5a5a5a);
  assert_int_equal(leaks_of(surface, mesh, NULL, result).sum.n_edges, 2);

  CHECK_OK(riis_mesh_set_adjacency(mesh, NULL));
  REFUSED(RIIS_INVALID_ARGUMENT, "mesh has no adjacency|riis_mesh_set_adjacency", mesh);
  free_one_owned(mesh);
  mesh = mesh_with_rows(&nodes, 0);
  nodes.xyz[20] = NAN;
  REFUSED(RIIS_INVALID_MESH, "z of node 6 is nan", mesh);
  nodes.xyz[20] = 5.5;

  riis_mark_options options = mark_options();
  options.n_threads = -1;
  CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "options.n_threads is -1",
                find_leaks_in(surface, mesh, result, &options, &leaks));
  /* After a refused call, the edges of the last good call are still in the same memory. */
  riis_leaks *found = NULL;
  riis_leak_list before, after;
  CHECK_OK(riis_leaks_create(&found));
  CHECK_OK(riis_find_leaks(surface, mesh, result, NULL, own(found)));
  CHECK_OK(riis_leaks_get_list(found, &before, sizeof before));
  nodes.xyz[20] = NAN;
  CHECK_REFUSED(RIIS_INVALID_MESH, "z of node 6 is nan", riis_find_leaks(surface, mesh, result, NULL, found));
  nodes.xyz[20] = 5.5;
  CHECK_OK(riis_leaks_get_list(found, &after, sizeof after));
  assert_memory_equal(&before, &after, sizeof before);
  assert_int_equal(after.n_edges, 2);
  CHECK_REFUSED(RIIS_INVALID_STRUCT_SIZE, "list is 80|96", riis_leaks_get_list(found, &after, 80));
  CHECK_REFUSED(RIIS_INVALID_STRUCT_SIZE, "list is 104|96", riis_leaks_get_list(found, &after, 104));

  riis_valve *valve = new_valve("mitral");
  CHECK_OK(riis_surface_update(surface, valve, NULL)); /* the update keeps the half thickness */
  riis_surface_options thicker = surface_options();
  thicker.half_thickness = 0.3;
  CHECK_OK(riis_surface_update(surface, valve, &thicker));
  REFUSED(RIIS_INVALID_ARGUMENT, "half thickness 0.25|surface has 0.3|mark the nodes again", mesh);
}

int main(void) {
  rng = random_start("test_valve_leaks");
  return run_cases(NULL, NULL);
}
