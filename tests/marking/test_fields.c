/* SPDX-License-Identifier: Apache-2.0
 * Tests the fields of closest points that a marking keeps. The fields equal those of single queries bit for bit, for any search,
 * number of threads and instruction set. The rim is compared with the numbering of patches and with a count of edges. Wrong
 * requests are refused. */
#include <riis/riis.h>

#include "test_support.h"

#include "handles.h"
#include "oracle.h"
#include "sanitized.h"
#include "searches.h"
#include "tie_oracle.h"

static random_source rng;

static int64_t any_of(int64_t n) { return (int64_t)(random_bits(&rng) % (uint64_t)n); }
static double between(double low, double high) { return random_between(&rng, low, high); }

enum {
  of_patches = RIIS_FIELD_POINT | RIIS_FIELD_NORMAL | RIIS_FIELD_PATCH,
  of_arrays = of_patches | RIIS_FIELD_BARYCENTRIC | RIIS_FIELD_SIDE | RIIS_FIELD_RIM,
  of_valves = of_arrays | RIIS_FIELD_UV,
  of_moving = of_valves | RIIS_FIELD_VELOCITY
};

static riis_mark_list marked_fields(const riis_marks *result) {
  riis_mark_list fields;
  CHECK_OK(riis_marks_get_list(result, RIIS_LIST_MARKED, &fields, sizeof fields));
  assert_int_equal(fields.n_nodes, marked_in(result).n);
  return fields;
}

static riis_mark_list within_fields(const riis_marks *result) {
  riis_mark_list fields;
  CHECK_OK(riis_marks_get_list(result, RIIS_LIST_WITHIN_LIMIT, &fields, sizeof fields));
  assert_int_equal(fields.n_nodes, within_in(result).n);
  return fields;
}

static int same_array(const void *a, const void *b, int64_t n, size_t size) {
  return (!a && !b) || (a && b && memcmp(a, b, (size_t)n * size) == 0);
}

static int same_fields(riis_mark_list a, riis_mark_list b) {
  const int64_t n = a.n_nodes;
  return n == b.n_nodes && same_array(a.point, b.point, 3 * n, 8) && same_array(a.normal, b.normal, 3 * n, 8) &&
         same_array(a.barycentric, b.barycentric, 3 * n, 8) && same_array(a.uv, b.uv, 2 * n, 8) &&
         same_array(a.velocity, b.velocity, 3 * n, 8) && same_array(a.side, b.side, n, 4) &&
         same_array(a.rim, b.rim, n, 4) && same_array(a.patch_id, b.patch_id, n, 4);
}

/* Returns the flags of all fields whose arrays are not NULL. */
static int32_t arrays_in(riis_mark_list f) {
  return (f.point ? RIIS_FIELD_POINT : 0) | (f.normal ? RIIS_FIELD_NORMAL : 0) |
         (f.barycentric ? RIIS_FIELD_BARYCENTRIC : 0) | (f.side ? RIIS_FIELD_SIDE : 0) | (f.rim ? RIIS_FIELD_RIM : 0) |
         (f.uv ? RIIS_FIELD_UV : 0) | (f.velocity ? RIIS_FIELD_VELOCITY : 0) | (f.patch_id ? RIIS_FIELD_PATCH : 0);
}

static int is_bit(int32_t fields) { return fields && !(fields & (fields - 1)); }

/* A result lists the marked nodes and the nodes within the limit. Checks that marked nodes have equal fields in both lists. */
static void check_part(const riis_marks *result) {
  const found_nodes all = within_in(result), some = marked_in(result);
  const riis_mark_list of_all = within_fields(result), of_some = marked_fields(result);
  if (some.n == 0) return;
  assert_int_equal(arrays_in(of_all), arrays_in(of_some));
  for (int64_t from = 0, to = 0; to < some.n; ++to, ++from) {
    while (all.node_id[from] != some.node_id[to]) ++from;
    assert_true(!of_all.point || memcmp(of_all.point + 3 * from, of_some.point + 3 * to, 24) == 0);
    assert_true(!of_all.normal || memcmp(of_all.normal + 3 * from, of_some.normal + 3 * to, 24) == 0);
    assert_true(!of_all.barycentric || memcmp(of_all.barycentric + 3 * from, of_some.barycentric + 3 * to, 24) == 0);
    assert_true(!of_all.velocity || memcmp(of_all.velocity + 3 * from, of_some.velocity + 3 * to, 24) == 0);
    assert_true(!of_all.uv || memcmp(of_all.uv + 2 * from, of_some.uv + 2 * to, 16) == 0);
    assert_true(!of_all.side || of_all.side[from] == of_some.side[to]);
    assert_true(!of_all.rim || of_all.rim[from] == of_some.rim[to]);
    assert_true(!of_all.patch_id || of_all.patch_id[from] == of_some.patch_id[to]);
  }
}

/* --- The rim, counted independently ---------------------------------------------------------------------------------- */

/* Each triangle has three flags for edges on the rim and three flags for corners on the rim. Edge k runs from corner k to the
 * next corner. A corner is on the rim if a rim edge ends there. */
typedef struct rims {
  riis_triangles c;
  const int64_t *triangle_id;
  uint8_t *edge, *corner;
} rims;

static const double *corner_of(const riis_triangles *c, int64_t k) { return c->xyz + 3 * c->vertex_id[k]; }
static int is_same_place(const double *a, const double *b) { return a[0] == b[0] && a[1] == b[1] && a[2] == b[2]; }
static int64_t next_of(int64_t k) { return k % 3 == 2 ? k - 2 : k + 1; }

static rims new_rims(const riis_surface *surface) {
  rims made = {triangles_of(surface), NULL, NULL, NULL};
  made.triangle_id = triangles_of(surface).triangle_id;
  made.edge = own(calloc((size_t)made.c.n_triangles, 3));
  made.corner = own(calloc((size_t)made.c.n_triangles, 3));
  return made;
}

static void mark_corners(rims *r) {
  for (int64_t e = 0; e < 3 * r->c.n_triangles; ++e) {
    if (!r->edge[e]) continue;
    const double *a = corner_of(&r->c, e), *b = corner_of(&r->c, next_of(e));
    for (int64_t k = 0; k < 3 * r->c.n_triangles; ++k)
      r->corner[k] |= is_same_place(corner_of(&r->c, k), a) || is_same_place(corner_of(&r->c, k), b);
  }
}

/* Marks the rim by the numbers of patches. On aortic valves the rim is u = 1 (the sinus) of all patches and v = 1 (the free edge)
 * of the upper patches. On mitral valves the rim contains v = 0 (the annulus) of all patches. The rim also contains v = 1 (the
 * free edge) where the leaflets do not meet. */
static rims rims_of_valve(const riis_surface *surface, int is_mitral, double opening) {
  rims r = new_rims(surface);
  for (int64_t e = 0; e < 3 * r.c.n_triangles; ++e) {
    const double *a = r.c.uv + 2 * r.c.vertex_id[e], *b = r.c.uv + 2 * r.c.vertex_id[next_of(e)];
    const int is_upper = r.c.patch_id[e / 3] % 2 == 1;
    r.edge[e] = is_mitral ? (a[1] == 0 && b[1] == 0) || (opening != 0 && a[1] == 1 && b[1] == 1)
                          : (a[0] == 1 && b[0] == 1) || (is_upper && a[1] == 1 && b[1] == 1);
  }
  mark_corners(&r);
  return r;
}

static rims rims_of_arrays(const riis_surface *surface) {
  rims r = new_rims(surface);
  for (int64_t e = 0; e < 3 * r.c.n_triangles; ++e) {
    const double *a = corner_of(&r.c, e), *b = corner_of(&r.c, next_of(e));
    int n = 0;
    for (int64_t f = 0; f < 3 * r.c.n_triangles; ++f) {
      const double *p = corner_of(&r.c, f), *q = corner_of(&r.c, next_of(f));
      n += (is_same_place(a, p) && is_same_place(b, q)) || (is_same_place(a, q) && is_same_place(b, p));
    }
    r.edge[e] = n == 1;
  }
  mark_corners(&r);
  return r;
}

static int64_t position_in(const rims *r, int64_t triangle_id) {
  int64_t at = triangle_id < r->c.n_triangles ? triangle_id : r->c.n_triangles - 1;
  while (r->triangle_id[at] > triangle_id) --at;
  assert_int_equal(r->triangle_id[at], triangle_id);
  return at;
}

static int is_rim(const rims *r, int64_t triangle, const double *w) {
  for (int k = 0; k < 3; ++k) {
    const int next = (k + 1) % 3, previous = (k + 2) % 3;
    if (w[next] == 0 && w[previous] == 0) return r->corner[3 * triangle + k];
    if (w[previous] == 0 && w[k] != 0 && w[next] != 0) return r->edge[3 * triangle + k];
  }
  return 0;
}

/* --- Against single queries ------------------------------------------------------------------------------------------ */

/* Compares all fields of the nodes within the limit with single queries and with the rim. A velocity must be that of the closest
 * triangle, except where several points of the surface are equally near. */
static void check_fields(const riis_surface *surface, const double *xyz, const rims *r, const riis_marks *result) {
  const riis_mark_list f = within_fields(result);
  const found_nodes nodes = within_in(result);
  const double *velocity = velocity_of(surface), fastest = f.velocity ? largest_velocity(&r->c, velocity) : 0;
  for (int64_t i = 0; i < nodes.n; ++i) {
    const double *p = xyz + 3 * nodes.node_id[i];
    const riis_closest closest = closest_to(surface, p[0], p[1], p[2]);
    assert_int_equal(closest.triangle_id, nodes.triangle_id[i]);
    if (f.point) assert_memory_equal(closest.point, f.point + 3 * i, 24);
    if (f.normal) assert_memory_equal(closest.normal, f.normal + 3 * i, 24);
    if (f.barycentric) assert_memory_equal(closest.barycentric, f.barycentric + 3 * i, 24);
    if (f.side) assert_int_equal(closest.side, f.side[i]);
    const int64_t t = position_in(r, closest.triangle_id), *corner = r->c.vertex_id + 3 * t;
    if (f.patch_id) assert_int_equal(r->c.patch_id[t], f.patch_id[i]);
    if (f.rim && f.rim[i] != is_rim(r, t, closest.barycentric))
      fail_msg("rim is %d at (%.17g %.17g %.17g), weights %.17g %.17g %.17g of triangle %lld", f.rim[i],
               closest.point[0], closest.point[1], closest.point[2], closest.barycentric[0], closest.barycentric[1],
               closest.barycentric[2], (long long)t);
    const tied_velocity tied =
        f.velocity ? tied_velocity_at(&r->c, velocity, p, nodes.distance[i], info_of(surface).half_thickness)
                   : (tied_velocity){.n_places = 1};
    for (int k = 0; k < 3; ++k) {
      const double *w = closest.barycentric;
      double uv = 0, v = 0, largest = 0;
      for (int j = 0; j < 3; ++j) {
        if (f.uv && k < 2) uv += w[j] * r->c.uv[2 * corner[j] + k];
        if (!f.velocity) continue;
        v += w[j] * velocity[3 * corner[j] + k];
        largest = fmax(largest, fabs(velocity[3 * corner[j] + k]));
      }
      if (f.uv && k < 2) CHECK_NEAR(f.uv[2 * i + k], uv, 1e-15);
      if (!f.velocity || !tied.is_clear) continue;
      if (tied.n_places == 1) CHECK_NEAR(f.velocity[3 * i + k], v, 1e-15 * largest);
      CHECK_NEAR(f.velocity[3 * i + k], tied.mean[k], 1e-9 * fastest);
    }
  }
}

/* Makes nodes on a surface, near it, at its corners, and beyond its edges. Each node's only neighbour is the next node in the
 * list. */
static test_mesh nodes_near(const riis_surface *surface, int64_t n, double reach) {
  const riis_triangles c = triangles_of(surface);
  test_mesh mesh = {.n = n};
  mesh.xyz = own(malloc((size_t)n * 3 * sizeof *mesh.xyz));
  for (int64_t i = 0; i < n; ++i) {
    const int64_t t = any_of(c.n_triangles), k = any_of(3);
    const double *a = corner_of(&c, 3 * t + k), *b = corner_of(&c, 3 * t + (k + 1) % 3);
    const double *d = corner_of(&c, 3 * t + (k + 2) % 3);
    const int64_t kind = any_of(5);
    const double s = kind == 0 ? 0 : between(0, 1);
    const double far = kind == 1 ? -between(0, 0.3) : kind == 2 ? between(0, 1 - s) : 0;
    const double off = kind == 3 ? 0 : reach * pow(10, between(-4, 0));
    for (int x = 0; x < 3; ++x)
      mesh.xyz[3 * i + x] = a[x] + s * (b[x] - a[x]) + far * (d[x] - a[x]) + off * between(-1, 1);
  }
  int64_t *pairs = own(malloc((size_t)n * 2 * sizeof *pairs));
  for (int64_t i = 0; i + 1 < n; ++i) pairs[2 * i] = i, pairs[2 * i + 1] = i + 1;
  set_rows(&mesh, n - 1, pairs);
  free_one_owned(pairs);
  return mesh;
}

/* Checks that each search, number of threads and instruction set gives the fields of the first search. */
static void check_all_ways(const riis_surface *surface, const rims *r, int32_t fields) {
  const double half_thickness = info_of(surface).half_thickness;
  test_mesh nodes = nodes_near(surface, 300 + any_of(400), 2 * half_thickness);
  riis_mesh *mesh = mesh_from(&nodes);
  riis_marks *expected = new_result(), *result = new_result();
  riis_mark_options options = mark_options();
  options.fields = fields;
  options.n_threads = 1;
  options.search = RIIS_SEARCH_EXHAUSTIVE;
  if (any_of(3)) options.distance_limit = half_thickness * between(1, 3);
  CHECK_OK(riis_mark_nodes(surface, mesh, &options, expected));
  assert_true(marked_in(expected).n > 0);
  assert_int_equal(arrays_in(within_fields(expected)), fields);
  check_fields(surface, nodes.xyz, r, expected);
  check_part(expected);
  for (int32_t search = RIIS_SEARCH_AUTO; search <= RIIS_SEARCH_CLUSTERS; ++search)
    for (int32_t n_threads = 1; n_threads <= 4; ++n_threads) {
      if (search == RIIS_SEARCH_PAPER) continue;
      options.search = search;
      options.n_threads = n_threads;
      options.instructions = (int32_t)any_of(4);
      const riis_status status = riis_mark_nodes(surface, mesh, &options, result);
      if (status == RIIS_UNAVAILABLE) continue;
      CHECK_OK(status);
      assert_true(same_results(result, expected));
      assert_true(same_fields(within_fields(result), within_fields(expected)));
      assert_true(same_fields(marked_fields(result), marked_fields(expected)));
    }
  options.search = RIIS_SEARCH_PAPER; /* this search finds fewer nodes, but gives all their fields */
  options.instructions = RIIS_INSTRUCTIONS_AUTO;
  CHECK_OK(riis_mark_nodes(surface, mesh, &options, result));
  check_fields(surface, nodes.xyz, r, result);
  check_part(result);
}

TEST(fields_of_valves_are_those_of_single_queries) {
  for (int trial = 0; trial < trials_of(72); ++trial) {
    const int is_mitral = trial % 2, owned_before = n_owned();
    const char *kind = is_mitral ? "mitral" : "aortic";
    riis_valve *valve = new_valve(kind), *before = NULL, *open = new_valve(kind);
    riis_surface_options options = surface_options();
    if (!is_mitral) CHECK_OK(riis_valve_set_scalar(open, "leaflet_angle", 45));
    CHECK_OK(riis_valve_set_open_state(valve, open));
    CHECK_OK(riis_valve_copy(valve, &before));
    own(before);
    const double opening = trial < 4 ? 0 : between(0, 1);
    CHECK_OK(riis_valve_set_scalar(valve, "opening", opening));
    CHECK_OK(riis_valve_set_scalar(before, "opening", between(0, 1)));
    options.tolerance = pow(10, between(-1, 0));
    options.flip_normals = any_of(3) == 0;
    if (any_of(2)) options.scale = 10, options.rotation_angle = 33, options.rotation_axis[0] = 1;
    riis_surface *surface = new_surface(valve, &options);
    CHECK_OK(riis_surface_update_moving(surface, valve, before, 0.1, NULL, NULL));
    rims r = rims_of_valve(surface, is_mitral, opening);
    int32_t fields = of_moving;
    for (int i = 0; i < 8; ++i)
      if (trial % 3 == 0 && any_of(2)) fields &= ~(1 << i);
    check_all_ways(surface, &r, trial >= 16 ? 1 << (trial - 16) : fields);
    free_owned_after(owned_before);
  }
}

/* The surface is a crumpled sheet with holes and with triangles without area. Either each triangle has its own corners, or
 * triangles share corners. */
TEST(fields_of_arrays_are_those_of_single_queries) {
  enum { side = 9, max_vertices = 6 * side * side };
  riis_surface *surface = surface_of_kind("mitral", NULL); /* arrays must replace the mitral valve's rim */
  for (int trial = 0; trial < trials_of(72); ++trial) {
    const int owned_before = n_owned();
    static double height[side + 1][side + 1], xyz[3 * max_vertices];
    static int32_t ids[max_vertices];
    int64_t n_vertices = 0, n_triangles = 0;
    for (int i = 0; i <= side; ++i)
      for (int j = 0; j <= side; ++j) height[i][j] = 0.1 * (double)any_of(4);
    for (int i = 0; i < side; ++i)
      for (int j = 0; j < side; ++j) {
        static const int steps[6][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 0}, {1, 1}, {0, 1}};
        for (int half = 0; half < 2; ++half) {
          if (any_of(6) == 0) continue;
          for (int k = 0; k < 3; ++k) {
            const int *step = steps[3 * half + k];
            double *p = xyz + 3 * n_vertices;
            p[0] = 0.1 * (i + step[0]), p[1] = 0.1 * (j + step[1]), p[2] = height[i + step[0]][j + step[1]];
            if (p[0] == 0 && any_of(2)) p[0] = -0.0; /* 0 and -0 must count as one position */
            int64_t same = n_vertices;
            for (int64_t v = 0; v < n_vertices && trial % 2; ++v)
              if (is_same_place(xyz + 3 * v, p)) same = v;
            if (same == n_vertices) ++n_vertices;
            ids[3 * n_triangles + k] = (int32_t)same;
          }
          if (any_of(10) == 0) ids[3 * n_triangles] = ids[3 * n_triangles + 1]; /* a triangle without area */
          ++n_triangles;
        }
      }
    riis_surface_arrays arrays = triangle_arrays(n_vertices, xyz, n_triangles, ids);
    riis_surface_options options = surface_options();
    options.half_thickness = 0.05;
    options.zero_area = RIIS_ZERO_AREA_SKIP;
    options.flip_normals = trial % 3 == 0;
    CHECK_OK(riis_surface_update_from_arrays(surface, &arrays, &options));
    assert_true(info_of(surface).n_zero_area > 0 || trial > 0);
    rims r = rims_of_arrays(surface);
    check_all_ways(surface, &r, of_arrays);
    free_owned_after(owned_before);
  }
}

/* --- The rim of valves ----------------------------------------------------------------------------------------------- */

/* Returns three points beyond each edge of each triangle: one in its plane, one off its plane, and one vertically below the
 * edge. */
static double *beyond_edges(const riis_triangles *c, double off) {
  double *xyz = own(malloc((size_t)c->n_triangles * 27 * sizeof *xyz)), *to = xyz;
  for (int64_t e = 0; e < 3 * c->n_triangles; ++e) {
    const double *a = corner_of(c, e), *b = corner_of(c, next_of(e)), *d = corner_of(c, next_of(next_of(e)));
    double ab[3], out[3], n[3], along = 0, size_sq = 0, length = 0, n_length = 0;
    for (int x = 0; x < 3; ++x) {
      ab[x] = b[x] - a[x], out[x] = a[x] - d[x];
      size_sq += ab[x] * ab[x], along += ab[x] * out[x];
    }
    for (int x = 0; x < 3; ++x) out[x] -= along / size_sq * ab[x], length += out[x] * out[x];
    for (int x = 0; x < 3; ++x) n[x] = ab[(x + 1) % 3] * out[(x + 2) % 3] - ab[(x + 2) % 3] * out[(x + 1) % 3];
    for (int x = 0; x < 3; ++x) n_length += n[x] * n[x];
    for (int k = 0; k < 3; ++k)
      for (int x = 0; x < 3; ++x) {
        const double below = x == 2 ? -1 : 0, beyond = out[x] / sqrt(length) + 0.5 * k * n[x] / sqrt(n_length);
        *to++ = 0.5 * (a[x] + b[x]) + off * (k == 2 ? below : beyond);
      }
  }
  return xyz;
}

/* A valve has no rim along the bending curve, along the symmetry planes or between patches. The closed mitral valve has no rim
 * along its free edges. */
TEST(valves_have_a_rim_all_around_and_none_inside) {
  const int step = is_short_test() ? 4 : 1;
  for (int is_mitral = 0; is_mitral < 2; ++is_mitral) {
    int64_t n_rim = 0, n_inside = 0, n_free = 0, n_free_closed = 0;
    const char *kind = is_mitral ? "mitral" : "aortic";
    riis_valve *valve = new_valve(kind), *open = new_valve(kind);
    riis_marks *result = new_result();
    if (!is_mitral) CHECK_OK(riis_valve_set_scalar(open, "leaflet_angle", 40));
    CHECK_OK(riis_valve_set_open_state(valve, open));
    riis_surface_options options = surface_options();
    options.tolerance = 0.5;
    riis_surface *surface = new_surface(valve, &options);
    for (int i = 0; i <= 100; i += step) {
      const int owned_before = n_owned();
      CHECK_OK(riis_valve_set_scalar(valve, "opening", i / 100.0));
      CHECK_OK(riis_surface_update(surface, valve, NULL));
      rims r = rims_of_valve(surface, is_mitral, i / 100.0);
      double *xyz = beyond_edges(&r.c, 1e-3);
      const int64_t n = 9 * r.c.n_triangles;
      const riis_mesh *mesh = mesh_of(n, xyz);
      riis_mark_options mark = mark_options();
      mark.fields = of_valves;
      mark.n_threads = 1;
      CHECK_OK(riis_mark_nodes(surface, mesh, &mark, result));
      const riis_mark_list f = marked_fields(result);
      const found_nodes nodes = marked_in(result);
      assert_int_equal(nodes.n, n);
      for (int64_t k = 0; k < n; ++k) {
        const int64_t t = nodes.triangle_id[k];
        const int expected = is_rim(&r, t, f.barycentric + 3 * k);
        if (f.rim[k] != expected)
          fail_msg("opening %g: rim is %d at u = %g, v = %g of patch %d", i / 100.0, f.rim[k], f.uv[2 * k],
                   f.uv[2 * k + 1], f.patch_id[k]);
        n_rim += expected;
        const int64_t e = k / 3;
        /* The node lies beyond an edge of the triangle, so this edge is the closest edge. */
        if (t == e / 3 && expected && r.edge[e]) ++n_free;
        if (!r.edge[e]) ++n_inside;
        if (f.uv[2 * k + 1] > 1 - 1e-9 && is_mitral && i == 0) {
          ++n_free_closed;
          assert_int_equal(f.rim[k], 0);
        }
        /* This check does not use the numbers of patches: no rim edge lies in the mitral valve's plane of symmetry. */
        if (is_mitral && f.rim[k] && r.edge[e] && t == e / 3)
          assert_true(corner_of(&r.c, e)[0] != 0 || corner_of(&r.c, next_of(e))[0] != 0);
      }
      free_owned_after(owned_before);
    }
    printf("%s: %lld nodes on the rim, %lld beyond edges of the rim, %lld beyond others, %lld at closed edges\n",
           is_mitral ? "mitral" : "aortic", (long long)n_rim, (long long)n_free, (long long)n_inside,
           (long long)n_free_closed);
    assert_true(step * n_rim > 2000 && step * n_free > 2000 && step * n_inside > 5000 &&
                (n_free_closed > 10) == is_mitral);
  }
}

/* The middle of a rim edge touches no other patch of the edge's leaflet. Mitral valves are opened at random. */
TEST(no_other_patch_touches_the_rim) {
  for (int is_mitral = 0; is_mitral < 2; ++is_mitral) {
    int64_t n = 0;
    for (int trial = 0; trial < trials_of(60); ++trial) {
      const int owned_before = n_owned();
      riis_valve *valve = new_valve(is_mitral ? "mitral" : "aortic");
      riis_surface_options options = surface_options();
      options.tolerance = 0.5;
      const double opening = is_mitral ? between(0.05, 1) : 0;
      CHECK_OK(riis_valve_set_scalar(valve, "opening", opening));
      riis_surface *surface = new_surface(valve, &options);
      riis_marks *result = new_result();
      riis_mark_options mark = mark_options();
      const riis_triangles c = triangles_of(surface);
      const riis_mesh *mesh = mesh_of(9 * c.n_triangles, beyond_edges(&c, 1e-3));
      mark.fields = RIIS_FIELD_RIM | RIIS_FIELD_POINT | RIIS_FIELD_BARYCENTRIC | RIIS_FIELD_PATCH;
      CHECK_OK(riis_mark_nodes(surface, mesh, &mark, result));
      const riis_mark_list f = marked_fields(result);
      for (int64_t k = 0; k < f.n_nodes; ++k) {
        const double *w = f.barycentric + 3 * k, *p = f.point + 3 * k;
        const double middle = fmax(w[0], fmax(w[1], w[2]));
        if (!f.rim[k] || middle > 0.6) continue; /* skips the ends of edges, which other patches share */
        ++n;
        for (int64_t t = 0; t < c.n_triangles; ++t) {
          /* Triangles of other leaflets may touch the edge, so the loop skips these triangles. */
          if (c.patch_id[t] == f.patch_id[k]) continue;
          if (c.leaflet_id[t] != (is_mitral ? f.patch_id[k] > 5 : f.patch_id[k] / 4)) continue;
          /* The distance to the box around the triangle is a lower bound of the distance to the triangle. */
          double gap = 0;
          for (int x = 0; x < 3; ++x) {
            double low = INFINITY, high = -INFINITY;
            for (int j = 0; j < 3; ++j) {
              const double q = corner_of(&c, 3 * t + j)[x];
              low = fmin(low, q), high = fmax(high, q);
            }
            gap = fmax(gap, fmax(low - p[x], p[x] - high));
          }
          if (gap > 0) continue;
          double abc[9];
          for (int j = 0; j < 9; ++j) abc[j] = corner_of(&c, 3 * t + j / 3)[j % 3];
          if (oracle_point_triangle(p, abc) < 1e-6)
            fail_msg("opening %g: patch %d has a rim where patch %d is", opening, f.patch_id[k], c.patch_id[t]);
        }
      }
      free_owned_after(owned_before);
    }
    CHECK_MET(n > 500);
  }
}

/* --- Parameters ------------------------------------------------------------------------------------------------------ */

TEST(parameters_turn_as_the_header_says) {
  for (int trial = 0; trial < trials_of(72); ++trial) {
    const int is_mitral = trial % 2, is_flipped = trial / 2 % 2;
    riis_valve *valve = new_valve(is_mitral ? "mitral" : "aortic");
    riis_surface_options options = surface_options();
    options.flip_normals = is_flipped;
    if (is_mitral) CHECK_OK(riis_valve_set_scalar(valve, "opening", trial < 4 ? 0 : between(0, 1)));
    const riis_triangles c = triangles_of(new_surface(valve, &options));
    for (int64_t t = 0; t < c.n_triangles; ++t) {
      const double *a = c.uv + 2 * c.vertex_id[3 * t], *b = c.uv + 2 * c.vertex_id[3 * t + 1],
                   *d = c.uv + 2 * c.vertex_id[3 * t + 2];
      const int32_t patch = c.patch_id[t];
      const int is_mirrored = is_mitral ? (patch >= 3 && patch <= 5) || patch >= 8 : patch % 4 >= 2;
      const double turn = (b[0] - a[0]) * (d[1] - a[1]) - (b[1] - a[1]) * (d[0] - a[0]);
      assert_true(is_mirrored != is_flipped ? turn < 0 : turn > 0);
    }
  }
}

/* --- Other distances ------------------------------------------------------------------------------------------------- */

TEST(other_distances_have_fields_of_patches) {
  for (int32_t distance = RIIS_MEASURE_SAMPLING; distance <= RIIS_MEASURE_MINIMIZATION; ++distance)
    for (int is_mitral = 0; is_mitral < 2; ++is_mitral) {
      riis_valve *valve = new_valve(is_mitral ? "mitral" : "aortic");
      riis_surface_options options = surface_options();
      options.measure = distance;
      options.measure_tolerance = 0.5;
      options.flip_normals = is_mitral;
      riis_surface *surface = new_surface(valve, &options);
      CHECK_OK(riis_surface_update_moving(surface, valve, valve, 1, NULL, NULL));
      test_mesh nodes = nodes_near(surface, 200, 0.2);
      riis_mesh *mesh = mesh_from(&nodes);
      riis_marks *result = new_result(), *other = new_result();
      riis_mark_options mark = mark_options();
      mark.fields = of_patches;
      mark.distance_limit = 0.15;
      mark.n_threads = 1;
      CHECK_OK(riis_mark_nodes(surface, mesh, &mark, result));
      const riis_mark_list f = within_fields(result);
      const found_nodes found = within_in(result);
      assert_true(found.n > 50);
      assert_int_equal(arrays_in(f), of_patches);
      check_part(result);
      for (int64_t i = 0; i < found.n; ++i) {
        const double *p = nodes.xyz + 3 * found.node_id[i];
        const riis_closest closest = closest_to(surface, p[0], p[1], p[2]);
        assert_memory_equal(closest.point, f.point + 3 * i, 24);
        assert_memory_equal(closest.normal, f.normal + 3 * i, 24);
        assert_int_equal(closest.leaflet_id, is_mitral ? f.patch_id[i] > 5 : f.patch_id[i] / 4);
        assert_in_range(f.patch_id[i], 0, is_mitral ? 9 : 11);
      }
      mark.n_threads = 3;
      CHECK_OK(riis_mark_nodes(surface, mesh, &mark, other));
      assert_true(same_results(other, result) && same_fields(within_fields(other), f));
      for (int32_t field = 1; field <= RIIS_FIELD_PATCH; field *= 2) {
        char text[200];
        mark.fields = field;
        if (field & of_patches) {
          CHECK_OK(riis_mark_nodes(surface, mesh, &mark, other));
          assert_int_equal(arrays_in(within_fields(other)), field);
          continue;
        }
        snprintf(text, sizeof text, "options.fields is %d,|distances are by %s|RIIS_FIELD_NORMAL and RIIS_FIELD_PATCH",
                 field, distance == RIIS_MEASURE_SAMPLING ? "sampling" : "minimi");
        CHECK_REFUSED(RIIS_INVALID_ARGUMENT, text, riis_mark_nodes(surface, mesh, &mark, other));
      }
    }
}

/* --- Refusals -------------------------------------------------------------------------------------------------------- */

TEST(fields_are_refused_by_name) {
  const double corners[9] = {0, 0, 0, 1, 0, 0, 0, 1, 0};
  const int32_t ids[3] = {0, 1, 2};
  const riis_surface_arrays arrays = triangle_arrays(3, corners, 1, ids);
  riis_valve *valve = new_valve("aortic");
  riis_surface *surface = new_surface(valve, NULL);
  CHECK_OK(riis_surface_update_moving(surface, valve, valve, 1, NULL, NULL));
  test_mesh nodes = nodes_near(surface, 300, 0.1);
  riis_mesh *mesh = mesh_from(&nodes);
  riis_marks *result = new_result(), *expected = new_result();
  riis_mark_options options = mark_options();
  options.fields = of_moving;
  assert_int_equal(of_moving, 255);
  CHECK_OK(riis_mark_nodes(surface, mesh, &options, result));
  CHECK_OK(riis_mark_nodes(surface, mesh, &options, expected));
#define FIELDS_REFUSED(value, parts)                                                               \
  do {                                                                                             \
    options.fields = value;                                                                        \
    CHECK_REFUSED(RIIS_INVALID_ARGUMENT, parts, riis_mark_nodes(surface, mesh, &options, result)); \
    assert_true(same_results(result, expected));                                                   \
    assert_true(same_fields(marked_fields(result), marked_fields(expected)));                      \
  } while (0)
  FIELDS_REFUSED(512, "options.fields is 512;|a sum of RIIS_FIELD_*, at most 511");
  FIELDS_REFUSED(RIIS_FIELD_GRADIENT, "options.fields is 256,|RIIS_FIELD_GRADIENT|riis_surface_add_direction");
  FIELDS_REFUSED(1 | 1 << 20, "options.fields is 1048577;");
  FIELDS_REFUSED(-1, "options.fields is -1;");
  FIELDS_REFUSED(INT32_MIN, "options.fields is -2147483648;");
  options.fields = of_moving;
  CHECK_OK(riis_surface_update(surface, valve, NULL));
  FIELDS_REFUSED(RIIS_FIELD_VELOCITY, "options.fields is 64,|RIIS_FIELD_VELOCITY|riis_surface_update_moving");
  FIELDS_REFUSED(of_moving, "options.fields is 255,|RIIS_FIELD_VELOCITY");
  CHECK_OK(riis_surface_update_from_arrays(surface, &arrays, NULL));
  FIELDS_REFUSED(RIIS_FIELD_UV, "options.fields is 32,|RIIS_FIELD_UV|from arrays");
  FIELDS_REFUSED(RIIS_FIELD_VELOCITY, "options.fields is 64,|RIIS_FIELD_VELOCITY");

  riis_mark_list f;
  CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "marks is NULL", riis_marks_get_list(NULL, RIIS_LIST_MARKED, &f, sizeof f));
  CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "marks is NULL",
                riis_marks_get_list(NULL, RIIS_LIST_WITHIN_LIMIT, &f, sizeof f));
  CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "list is NULL", riis_marks_get_list(result, RIIS_LIST_MARKED, NULL, sizeof f));
  CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "list is NULL",
                riis_marks_get_list(result, RIIS_LIST_WITHIN_LIMIT, NULL, sizeof f));
  static const int64_t sizes[] = {0, -8, offsetof(riis_mark_list, patch_id), sizeof f + 8};
  for (int i = 0; i < 4; ++i) {
    CHECK_REFUSED(RIIS_INVALID_STRUCT_SIZE, "list", riis_marks_get_list(result, RIIS_LIST_MARKED, &f, sizes[i]));
    CHECK_REFUSED(RIIS_INVALID_STRUCT_SIZE, "list", riis_marks_get_list(result, RIIS_LIST_WITHIN_LIMIT, &f, sizes[i]));
  }
}

/* Arrays that were not requested are NULL, even if the previous marking filled them. A result without nodes has no arrays. */
TEST(what_is_not_asked_for_is_null) {
  riis_surface *surface = aortic_surface(NULL);
  test_mesh nodes = nodes_near(surface, 300, 0.1);
  riis_mesh *mesh = mesh_from(&nodes);
  riis_marks *result = new_result();
  riis_mark_options options = mark_options();
  assert_int_equal(marked_fields(result).n_nodes, 0);
  assert_int_equal(arrays_in(marked_fields(result)) | arrays_in(within_fields(result)), 0);
  assert_int_equal(options.fields, 0);
  for (int wide = 0; wide < 2; ++wide)
    for (int32_t fields = 0; fields <= of_moving; ++fields) {
      if (fields & RIIS_FIELD_VELOCITY || (fields && !is_bit(fields) && any_of(4))) continue;
      options.fields = fields;
      options.distance_limit = wide ? 0.3 : RIIS_AUTO;
      CHECK_OK(riis_mark_nodes(surface, mesh, &options, result));
      assert_int_equal(arrays_in(marked_fields(result)), fields);
      assert_int_equal(arrays_in(within_fields(result)), fields);
    }
  const double xyz[3] = {1e3, 0, 0};
  options.fields = of_valves;
  CHECK_OK(riis_mark_nodes(surface, mesh_of(1, xyz), &options, result));
  assert_int_equal(marked_fields(result).n_nodes, 0);
  assert_int_equal(arrays_in(marked_fields(result)) | arrays_in(within_fields(result)), 0);
}

int main(void) {
  rng = random_start("test_fields");
  return run_cases(NULL, NULL);
}
