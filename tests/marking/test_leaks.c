/* SPDX-License-Identifier: Apache-2.0
 * A leaking edge crosses the surface between unmarked nodes. Leaking edges are compared with a loop over all edges and triangles
 * of random surfaces. The loop computes with whole numbers. RIIS_TEST_LONG=1 tries a thousand times as many cases. */
#include <riis/riis.h>

#include "test_support.h"

#include "crossing_oracle.h"
#include "handles.h"
#include "oracle.h"
#include "searches.h"

#include "leak_lists.h"

static random_source rng;

static int64_t random_integer(int64_t low, int64_t high) {
  return low + (int64_t)(random_bits(&rng) % (uint64_t)(high - low + 1));
}
static int one_in(int64_t n) { return random_integer(1, n) == 1; }

/* --- Whole numbers ---------------------------------------------------------------------------------------------------- */

enum { max_nodes = 60, max_triangles = 48, max_columns = 12 * max_nodes };

/* A random case. The coordinates are whole numbers times 2^exponent. */
typedef struct whole_case {
  int64_t n_nodes, n_vertices, n_triangles;
  int64_t node[3 * max_nodes], vertex[9 * max_triangles];
  int32_t ids[3 * max_triangles];
  int64_t offsets[max_nodes + 1], columns[max_columns];
  uint8_t mask[max_nodes];
  int is_masked, exponent;
  double half_thickness;
} whole_case;

static int64_t whole(int64_t largest) { return random_integer(-largest, largest); }

/* Makes separate triangles, or a sheet of triangles that share corners. */
static void random_triangles(whole_case *c, int64_t largest) {
  int64_t m = 0;
  const int is_sheet = one_in(2), side = (int)random_integer(1, 4);
  if (is_sheet) {
    c->n_vertices = (side + 1) * (side + 1);
    for (int64_t i = 0; i < c->n_vertices; ++i) {
      c->vertex[3 * i] = largest * (2 * (i % (side + 1)) - side) / side;
      c->vertex[3 * i + 1] = largest * (2 * (i / (side + 1)) - side) / side;
      c->vertex[3 * i + 2] = one_in(2) ? 0 : whole(largest);
    }
    for (int32_t i = 0; i < side * side; ++i) {
      const int32_t at = i % side + (side + 1) * (i / side), corners[4] = {at, at + 1, at + side + 2, at + side + 1};
      static const int order[6] = {0, 1, 2, 0, 2, 3};
      for (int k = 0; k < 6; ++k) c->ids[m++] = corners[order[k]];
    }
  } else {
    c->n_vertices = 3 * random_integer(1, max_triangles);
    for (; m < c->n_vertices; ++m) c->ids[m] = (int32_t)m;
    for (int64_t i = 0; i < 3 * c->n_vertices; ++i) c->vertex[i] = whole(largest);
  }
  c->n_triangles = m / 3;
}

static void corners_of(const whole_case *c, int64_t triangle, int64_t *abc) {
  for (int k = 0; k < 9; ++k) abc[k] = c->vertex[3 * c->ids[3 * triangle + k / 3] + k % 3];
}

static void drop_flat_triangles(whole_case *c) {
  int64_t n = 0, abc[9];
  for (int64_t i = 0; i < c->n_triangles; ++i) {
    corners_of(c, i, abc);
    if (!has_area(abc)) continue;
    memmove(c->ids + 3 * n++, c->ids + 3 * i, 3 * sizeof *c->ids);
  }
  c->n_triangles = n;
}

static void random_rows(whole_case *c) {
  int64_t n = 0;
  for (int64_t i = 0; i < c->n_nodes; ++i) {
    c->offsets[i] = n;
    /* The row may contain the node itself, repeats and ghost nodes. */
    for (int64_t k = random_integer(0, 11); k > 0; --k)
      c->columns[n++] = one_in(12) ? c->n_nodes + 3 : random_integer(0, c->n_nodes - 1);
  }
  c->offsets[c->n_nodes] = n;
}

static void make_case(whole_case *c) {
  static const int64_t sizes[] = {3, 8, 1000, (int64_t)1 << 27};
  const int64_t largest = sizes[random_integer(0, 3)];
  do {
    random_triangles(c, largest);
    drop_flat_triangles(c);
  } while (c->n_triangles == 0);
  /* Some meshes are millions of times as large as the surface. */
  const int is_huge = largest == 3 && one_in(4);
  c->n_nodes = random_integer(2, max_nodes);
  for (int64_t i = 0; i < 3 * c->n_nodes; ++i)
    c->node[i] = whole(is_huge && one_in(2) ? (int64_t)1 << 36 : 2 * largest);
  random_rows(c);
  c->is_masked = one_in(3);
  for (int64_t i = 0; i < c->n_nodes; ++i) c->mask[i] = !one_in(4);
  c->exponent = (int)random_integer(-120, 120);
  c->half_thickness = ldexp((double)largest * pow(10, random_between(&rng, -3, 0)), c->exponent);
}

static double *scaled(const int64_t *whole_numbers, int64_t n, int exponent) {
  double *made = own(malloc((size_t)n * sizeof *made));
  for (int64_t i = 0; i < n; ++i) made[i] = ldexp((double)whole_numbers[i], exponent);
  return made;
}

static riis_surface *surface_of_case(const whole_case *c, double half_thickness) {
  double *xyz = scaled(c->vertex, 3 * c->n_vertices, c->exponent);
  riis_surface_arrays arrays = triangle_arrays(c->n_vertices, xyz, c->n_triangles, c->ids);
  riis_surface_options options = surface_options();
  options.half_thickness = half_thickness;
  riis_surface *surface = surface_from(&arrays, &options);
  return surface;
}

static int crosses(const whole_case *c, int64_t a, int64_t b) {
  int64_t abc[9];
  for (int64_t t = 0; t < c->n_triangles; ++t) {
    corners_of(c, t, abc);
    if (oracle_segment_meets_triangle(c->node + 3 * a, c->node + 3 * b, abc)) return 1;
  }
  return 0;
}

/* Sets leaks[a * n + b] for a < b. Returns the number of leaks. */
static int64_t expected_leaks(const whole_case *c, const uint8_t *marks, uint8_t *leaks) {
  int64_t n = 0;
  memset(leaks, 0, (size_t)(c->n_nodes * c->n_nodes));
  for (int64_t i = 0; i < c->n_nodes; ++i)
    for (int64_t k = c->offsets[i]; k < c->offsets[i + 1]; ++k) {
      const int64_t j = c->columns[k], a = i < j ? i : j, b = i < j ? j : i;
      if (a == b || b >= c->n_nodes || marks[a] || marks[b] || leaks[a * c->n_nodes + b]) continue;
      if (c->is_masked && (!c->mask[a] || !c->mask[b])) continue;
      n += leaks[a * c->n_nodes + b] = (uint8_t)crosses(c, a, b);
    }
  return n;
}

/* Writes the oracle's marks. Where rounding decides a mark, copies the result's mark. */
static void expected_marks(const whole_case *c, const double *xyz, const riis_surface *surface,
                           const riis_marks *result, uint8_t *marks) {
  const riis_triangles all = triangles_of(surface);
  int64_t nearest = 0;
  CHECK_OK(dense_of(result, c->n_nodes, 2e60, marks, NULL, NULL, NULL));
  for (int64_t i = 0; i < c->n_nodes; ++i) {
    const long double d = oracle_distance(xyz + 3 * i, all.n_triangles, all.vertex_id, all.xyz, &nearest);
    if (c->is_masked && !c->mask[i])
      marks[i] = 0;
    else if (fabsl(d - c->half_thickness) > 1e-12L * c->half_thickness + 1e-13L * d)
      marks[i] = d <= c->half_thickness;
  }
}

static void check_list(const whole_case *c, const double *xyz, const riis_surface *surface, leak_list list,
                       const uint8_t *leaks, int64_t n) {
  double longest = 0, closing = 0;
  int64_t longest_edge = -1, before = -1;
  assert_int_equal(list.sum.n_edges, n);
  for (int64_t e = 0; e < n; ++e) {
    const int64_t a = list.node_id[2 * e], b = list.node_id[2 * e + 1];
    assert_true(a >= 0 && a < b && b < c->n_nodes && leaks[a * c->n_nodes + b]);
    assert_true(a * c->n_nodes + b > before);
    before = a * c->n_nodes + b;
    const double *p = xyz + 3 * a, *q = xyz + 3 * b;
    const long double x = (long double)p[0] - q[0], y = (long double)p[1] - q[1], z = (long double)p[2] - q[2];
    const double length = (double)sqrtl(x * x + y * y + z * z);
    CHECK_NEAR(list.length[e], length, 1e-15 * length);
    CHECK_SAME(list.distance[e],
               fmin(closest_to(surface, p[0], p[1], p[2]).distance, closest_to(surface, q[0], q[1], q[2]).distance));
    if (list.length[e] > longest) longest = list.length[e], longest_edge = e;
    closing = fmax(closing, list.distance[e]);
  }
  CHECK_SAME(list.sum.longest_length, longest);
  CHECK_SAME(list.sum.half_thickness, closing);
  for (int i = 0; i < 2; ++i)
    assert_int_equal(list.sum.longest_node_id[i], n ? list.node_id[2 * longest_edge + i] : -1);
  for (int i = 0; i < 3; ++i) {
    const double middle =
        n ? 0.5 * xyz[3 * list.sum.longest_node_id[0] + i] + 0.5 * xyz[3 * list.sum.longest_node_id[1] + i] : 0;
    CHECK_NEAR(list.sum.longest_middle[i], middle, 1e-15 * longest);
  }
}

/* Returns the number of leaks with another half thickness. */
static int64_t n_leaks_with(const whole_case *c, const riis_mesh *mesh, double half_thickness) {
  const int owned_before = n_owned();
  riis_surface *surface = surface_of_case(c, half_thickness);
  riis_marks *result = new_result();
  riis_mark_options options = mark_options();
  if (c->is_masked) options.node_mask = c->mask;
  CHECK_OK(riis_mark_nodes(surface, mesh, &options, result));
  const int64_t n = leaks_of(surface, mesh, &options, result).sum.n_edges;
  free_owned_after(owned_before);
  return n;
}

static int64_t check_case(const whole_case *c) {
  const int owned_before = n_owned();
  static uint8_t marks[max_nodes], leaks[max_nodes * max_nodes];
  double *xyz = scaled(c->node, 3 * c->n_nodes, c->exponent);
  test_mesh nodes = {c->n_nodes, xyz, (int64_t *)c->offsets, (int64_t *)c->columns};
  riis_surface *surface = surface_of_case(c, c->half_thickness);
  riis_mesh *mesh = mesh_with_rows(&nodes, c->n_nodes + 4);
  riis_marks *result = new_result();
  riis_mark_options options = mark_options();
  if (c->is_masked) options.node_mask = c->mask;
  options.n_threads = (int32_t)random_integer(1, 3);
  options.distance_limit = one_in(2) ? RIIS_AUTO : 3 * c->half_thickness;
  CHECK_OK(riis_mark_nodes(surface, mesh, &options, result));
  expected_marks(c, xyz, surface, result, marks);
  const int64_t n = expected_leaks(c, marks, leaks);
  const leak_list list = leaks_of(surface, mesh, &options, result);
  check_list(c, xyz, surface, list, leaks, n);
  if (n > 0) {
    assert_int_equal(n_leaks_with(c, mesh, list.sum.half_thickness), 0);
    assert_true(n_leaks_with(c, mesh, nextafter(list.sum.half_thickness, 0)) > 0);
  }
  free_owned_after(owned_before);
  return n;
}

TEST(random_meshes_leak_where_the_loop_says) {
  const int n = trials(400, 400000);
  int n_leaking = 0;
  static whole_case c;
  for (int trial = 0; trial < n; ++trial) {
    const random_source before = rng;
    make_case(&c);
    const int64_t n_edges = check_case(&c);
    n_leaking += n_edges > 0;
    if (trial % 40000 == 39999) printf("%d trials, last seed %llu\n", trial + 1, (unsigned long long)before.state);
  }
  printf("%d of %d meshes leak\n", n_leaking, n);
  CHECK_MET(n_leaking > n / 4 && n_leaking < n);
}

/* --- Changes that must not matter ---------------------------------------------------------------------------------- */

/* A case keeps its leaking edges when it is turned by right angles, mirrored, moved and renumbered. */
TEST(motion_and_order_do_not_matter) {
  static whole_case c, moved;
  for (int trial = 0; trial < 60; ++trial) {
    make_case(&c);
    moved = c;
    const int64_t shift = random_integer(-100, 100);
    const int axis = (int)random_integer(0, 2), sign = one_in(2) ? 1 : -1;
    int64_t number[max_nodes];
    for (int64_t i = 0; i < c.n_nodes; ++i) number[i] = i;
    for (int64_t i = c.n_nodes - 1; i > 0; --i) {
      const int64_t j = random_integer(0, i), swap = number[i];
      number[i] = number[j], number[j] = swap;
    }
#define MOVED(x, i) ((x)[((i) + axis) % 3] * ((i) == 1 ? sign : 1) + ((i) == 2 ? shift : 0))
    for (int64_t v = 0; v < c.n_vertices; ++v)
      for (int i = 0; i < 3; ++i) moved.vertex[3 * v + i] = MOVED(c.vertex + 3 * v, i);
    int64_t n = 0, row_of[max_nodes];
    for (int64_t v = 0; v < c.n_nodes; ++v) {
      for (int i = 0; i < 3; ++i) moved.node[3 * number[v] + i] = MOVED(c.node + 3 * v, i);
      moved.mask[number[v]] = c.mask[v];
      row_of[number[v]] = v;
    }
    for (int64_t v = 0; v < c.n_nodes; ++v) {
      moved.offsets[v] = n;
      for (int64_t k = c.offsets[row_of[v]]; k < c.offsets[row_of[v] + 1]; ++k)
        moved.columns[n++] = c.columns[k] < c.n_nodes ? number[c.columns[k]] : c.columns[k];
    }
    const int64_t n_of_case = check_case(&c);
    assert_int_equal(check_case(&moved), n_of_case);
  }
}

/* The mesh has many blocks of rows. */
TEST(threads_do_not_matter) {
  const int64_t counts[3] = {24, 24, 20};
  const double lower[3] = {-1.6, -1.6, -1.5}, upper[3] = {1.6, 1.6, 1.5};
  test_mesh nodes = lattice(counts, lower, upper);
  for (int64_t i = 0; i < 3 * nodes.n; ++i) nodes.xyz[i] += random_between(&rng, -0.06, 0.06);
  riis_surface_options thin = surface_options();
  thin.half_thickness = 0.03;
  riis_surface *surface = aortic_surface(&thin);
  riis_mesh *mesh = mesh_with_rows(&nodes, 0);
  riis_marks *one = new_result(), *many = new_result();
  riis_mark_options options = mark_options();
  options.n_threads = 1;
  CHECK_OK(riis_mark_nodes(surface, mesh, &options, one));
  CHECK_OK(riis_mark_nodes(surface, mesh, &options, many));
  const leak_list a = leaks_of(surface, mesh, &options, one);
  assert_true(a.sum.n_edges > 100);
  for (options.n_threads = 2; options.n_threads <= 5; ++options.n_threads) {
    const leak_list b = leaks_of(surface, mesh, &options, many);
    const size_t n = (size_t)a.sum.n_edges;
    const size_t from = offsetof(riis_leak_list, half_thickness), to = offsetof(riis_leak_list, seconds);
    assert_int_equal(b.sum.n_edges, a.sum.n_edges);
    assert_memory_equal((const char *)&a.sum + from, (const char *)&b.sum + from, to - from);
    assert_memory_equal(a.node_id, b.node_id, 2 * n * sizeof *a.node_id);
    assert_memory_equal(a.length, b.length, n * sizeof *a.length);
    assert_memory_equal(a.distance, b.distance, n * sizeof *a.distance);
  }
}

int main(void) {
  rng = random_start("test_leaks");
  return run_cases(NULL, NULL);
}
