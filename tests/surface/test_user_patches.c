/* SPDX-License-Identifier: Apache-2.0
 * Compares surfaces of valves from the caller's patches with the curves of these patches. */
#include <riis/riis.h>

#include "test_support.h"

#include "handles.h"

#include "shapes.h"

TEST(square_has_its_area_and_normal) {
  shape square = unit_square();
  square.leaflet_id[0] = 5;
  riis_surface *surface = surface_of(&square, NULL);
  const riis_surface_info info = info_of(surface);
  CHECK_NEAR(info.area, 1, 1e-15);
  assert_int_equal(info.n_triangles, 2);
  assert_int_equal(info.n_vertices, 4);
  assert_int_equal(info.n_zero_area, 0);
  riis_closest above = closest_to(surface, 0.3, 0.6, 2);
  CHECK_NEAR(above.distance, 2, 1e-15);
  CHECK_NEAR(above.normal[2], 1, 1e-15);
  assert_int_equal(above.side, 1);
  assert_int_equal(above.leaflet_id, 5);
  const riis_triangles all = triangles_of(surface);
  for (int64_t i = 0; i < all.n_vertices; ++i) /* here u is x and v is y */
    for (int c = 0; c < 2; ++c) CHECK_SAME(all.uv[2 * i + c], all.xyz[3 * i + c]);
  free_one_owned(surface);

  square.n_patches = 0; /* here u and v are swapped */
  add_patch(&square, 2, 3, 0, 1);
  surface = surface_of(&square, NULL);
  above = closest_to(surface, 0.3, 0.6, 2);
  CHECK_NEAR(above.normal[2], -1, 1e-15);
  assert_int_equal(above.side, -1);
}

/* Makes a wavy patch with curves of every degree. Coordinates are small multiples of 1/8, so interpolation between states is
 * exact. */
static shape wavy(void) {
  static const double v0[4][3] = {{0, 0, 0}, {0.375, -0.25, 0.5}, {0.75, 0.25, -0.25}, {1.25, 0, 0.125}};
  static const double v1[3][3] = {{0, 1, 0.25}, {0.5, 1.5, 0.75}, {1, 1.25, 0}};
  static const double u0[4][3] = {{0, 0, 0}, {-0.25, 0.25, 0.25}, {0.125, 0.75, 0.5}, {0, 1, 0.25}};
  shape made = {0};
  add_curve(&made, 3, v0);
  add_curve(&made, 2, v1);
  add_curve(&made, 3, u0);
  add_line(&made, 1.25, 0, 0.125, 1, 1.25, 0);
  add_patch(&made, 0, 1, 2, 3);
  return made;
}

TEST(both_bases_and_no_optional_arrays_give_the_same) {
  const shape from = wavy();
  shape one_based = from;
  arrays_of_shape arrays;
  riis_valve *valve = NULL;
  for (int i = 0; i < 4; ++i) ++one_based.curve_id[i];
  arrays_from(&one_based, &arrays);
  arrays.patches.index_base = 1;
  arrays.patches.reversed = NULL;
  arrays.patches.leaflet_id = NULL;
  CHECK_OK(riis_valve_create_from_patches(&arrays.patches, &valve));
  own(valve);
  riis_surface *surface = new_surface(valve, NULL);
  free_one_owned(valve);
  check_same_surfaces(surface, surface_of(&from, NULL));
}

TEST(line_of_any_degree_gives_the_same_surface) {
  const shape from = wavy();
  const double *a = from.control[3][0], *b = from.control[3][1];
  /* The degree, and the positions of the inner control points on the line. The positions are evenly or unevenly spaced. */
  const struct {
    int32_t degree;
    double at[2];
  } other[4] = {{2, {0.5}}, {2, {0.125}}, {3, {1.0 / 3, 2.0 / 3}}, {3, {0.125, 0.25}}};
  for (int i = 0; i < 4; ++i) {
    shape changed = from;
    changed.degree[3] = other[i].degree;
    for (int k = 1; k < other[i].degree; ++k)
      for (int c = 0; c < 3; ++c) changed.control[3][k][c] = a[c] + other[i].at[k - 1] * (b[c] - a[c]);
    memcpy(changed.control[3][other[i].degree], b, sizeof changed.control[3][0]);
    check_same_surfaces(surface_of(&from, NULL), surface_of(&changed, NULL));
  }
}

/* Gives a point of a Bézier curve by Bernstein polynomials. */
static void bezier_point(const shape *from, int64_t curve, double t, double *p) {
  static const double binomial[4][4] = {{1}, {1, 1}, {1, 2, 1}, {1, 3, 3, 1}};
  const int n = from->degree[curve];
  for (int c = 0; c < 3; ++c) p[c] = 0;
  for (int k = 0; k <= n; ++k)
    for (int c = 0; c < 3; ++c) p[c] += binomial[n][k] * pow(t, k) * pow(1 - t, n - k) * from->control[curve][k][c];
}

enum { n_steps = 4000, n_dense = 120 };

/* Gives the points of the curve at the fractions 0, 1 / n_dense, 2 / n_dense, ... of its length. The length is measured along
 * n_steps chords. */
static void points_by_length(const shape *from, int side, double (*points)[3]) {
  static double fine[n_steps + 1][3], length[n_steps + 1];
  const int64_t curve = from->curve_id[side];
  for (int i = 0; i <= n_steps; ++i) {
    bezier_point(from, curve, (double)i / n_steps, fine[i]);
    length[i] = 0;
    if (i > 0) {
      for (int c = 0; c < 3; ++c) length[i] += (fine[i][c] - fine[i - 1][c]) * (fine[i][c] - fine[i - 1][c]);
      length[i] = length[i - 1] + sqrt(length[i]);
    }
  }
  for (int j = 0, i = 0; j <= n_dense; ++j) {
    const double wanted = length[n_steps] * j / n_dense;
    while (i + 1 < n_steps && length[i + 1] < wanted) ++i;
    const double step = length[i + 1] - length[i], rest = step > 0 ? (wanted - length[i]) / step : 0;
    const int to = from->reversed[side] ? n_dense - j : j;
    for (int c = 0; c < 3; ++c) points[to][c] = fine[i][c] + rest * (fine[i + 1][c] - fine[i][c]);
  }
}

/* Makes a surface from arrays of points of the shape's first patch. Coons' formula gives the points. */
static riis_surface *dense_surface(const shape *from) {
  static double side[4][n_dense + 1][3], xyz[(n_dense + 1) * (n_dense + 1)][3];
  static int32_t quads[n_dense * n_dense][4];
  for (int k = 0; k < 4; ++k) points_by_length(from, k, side[k]);
  for (int j = 0; j <= n_dense; ++j)
    for (int i = 0; i <= n_dense; ++i) {
      const double u = (double)i / n_dense, v = (double)j / n_dense;
      for (int c = 0; c < 3; ++c)
        xyz[j * (n_dense + 1) + i][c] = (1 - v) * side[0][i][c] + v * side[1][i][c] + (1 - u) * side[2][j][c] +
                                        u * side[3][j][c] - (1 - u) * (1 - v) * side[0][0][c] -
                                        u * (1 - v) * side[0][n_dense][c] - (1 - u) * v * side[1][0][c] -
                                        u * v * side[1][n_dense][c];
    }
  for (int32_t j = 0; j < n_dense; ++j)
    for (int32_t i = 0; i < n_dense; ++i) {
      const int32_t first = j * (n_dense + 1) + i;
      int32_t *quad = quads[j * n_dense + i];
      quad[0] = first, quad[1] = first + 1, quad[2] = first + n_dense + 2, quad[3] = first + n_dense + 1;
    }
  riis_surface_arrays arrays = triangle_arrays((n_dense + 1) * (n_dense + 1), xyz[0], n_dense * n_dense, quads[0]);
  riis_surface_options options = surface_options();
  arrays.corners_per_face = 4;
  options.zero_area = RIIS_ZERO_AREA_SKIP;
  return surface_from(&arrays, &options);
}

/* Returns the largest distance to a surface from another surface's vertices and from the middles of its triangles. */
static double largest_distance(const riis_surface *to, const riis_surface *from) {
  const riis_triangles all = triangles_of(from);
  double largest = 0;
  for (int64_t i = 0; i < all.n_triangles; ++i) {
    const double *a = all.xyz + 3 * all.vertex_id[3 * i], *b = all.xyz + 3 * all.vertex_id[3 * i + 1],
                 *c = all.xyz + 3 * all.vertex_id[3 * i + 2];
    static const double weight[7][3] = {
        {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0.5, 0.5, 0}, {0, 0.5, 0.5}, {0.5, 0, 0.5}, {1. / 3, 1. / 3, 1. / 3}};
    for (int k = 0; k < 7; ++k) {
      double p[3];
      for (int x = 0; x < 3; ++x) p[x] = weight[k][0] * a[x] + weight[k][1] * b[x] + weight[k][2] * c[x];
      largest = fmax(largest, closest_to(to, p[0], p[1], p[2]).distance);
    }
  }
  return largest;
}

/* The dense surface itself is accurate to about 1e-4. */
static void check_against_dense(const shape *from, double tolerance) {
  const int owned_before = n_owned();
  riis_surface_options options = surface_options();
  options.tolerance = tolerance;
  riis_surface *dense = dense_surface(from), *surface = surface_of(from, &options);
  const double bound = tolerance * info_of(surface).half_thickness + 1e-4;
  const double there = largest_distance(surface, dense), back = largest_distance(dense, surface);
  free_owned_after(owned_before);
  CHECK_AT_MOST(there, bound);
  CHECK_AT_MOST(back, bound);
}

TEST(patch_is_the_coons_patch_of_its_sides) {
  shape arcs = unit_square(); /* two sides nearly circular */
  const double arc0[4][3] = {{0, 0, 0}, {0, 0, 0.6667}, {1, 0, 0.6667}, {1, 0, 0}};
  const double arc1[4][3] = {{0, 0, 0}, {-0.2, 0.3, 0}, {-0.2, 0.7, 0}, {0, 1, 0}};
  arcs.degree[0] = arcs.degree[2] = 3;
  memcpy(arcs.control[0], arc0, sizeof arc0);
  memcpy(arcs.control[2], arc1, sizeof arc1);
  check_against_dense(&arcs, 0.05);
  const shape from = wavy();
  check_against_dense(&from, 0.2);
  check_against_dense(&from, 0.01);
}

TEST(random_patches_are_coons_patches) {
  random_source rng = random_start("random_patches_are_coons_patches");
  for (int trial = 0; trial < trials_of(18); ++trial) {
    shape from = {0};
    const double corner[4][2] = {{0, 0}, {1, 0}, {0, 1}, {1, 1}};
    double p[4][3]; /* the corners are moved */
    const int ends[4][2] = {{0, 1}, {2, 3}, {0, 2}, {1, 3}};
    for (int k = 0; k < 4; ++k)
      for (int c = 0; c < 3; ++c) p[k][c] = (c < 2 ? corner[k][c] : 0) + random_between(&rng, -0.3, 0.3);
    for (int side = 0; side < 4; ++side) {
      const int degree = 1 + (int)(random_bits(&rng) % 3), turned = (int)(random_bits(&rng) % 2);
      const double *a = p[ends[side][turned]], *b = p[ends[side][1 - turned]];
      double control[4][3];
      for (int k = 0; k <= degree; ++k)
        for (int c = 0; c < 3; ++c)
          control[k][c] = k == 0        ? a[c]
                          : k == degree ? b[c]
                                        : a[c] + (b[c] - a[c]) * k / degree + random_between(&rng, -0.3, 0.3);
      add_curve(&from, degree, (const double(*)[3])control);
      from.reversed[side] = turned;
    }
    add_patch(&from, 0, 1, 2, 3);
    check_against_dense(&from, 0.05);
  }
}

/* Makes two patches that share their side u = 1, a curve from (0, 0, 0) to (0, 1, z). The second patch is turned by half a
 * circle, so its v runs backwards along the curve. */
static shape pair_of_patches(double z) {
  const double shared[4][3] = {{0, 0, 0}, {0.5, 0.25, z}, {-0.25, 0.75, 3 * z}, {0, 1, z}};
  const double far[3][3] = {{2, 1, 0}, {2.5, 0.5, 2 * z}, {2, 0, z}};
  shape pair = {0};
  add_curve(&pair, 3, shared);
  add_line(&pair, -1, 0, 0, 0, 0, 0);
  add_line(&pair, -1, 1, 0, 0, 1, z);
  add_line(&pair, -1, 0, 0, -1, 1, 0);
  add_line(&pair, 2, 1, 0, 0, 1, z);
  add_line(&pair, 0, 0, 0, 2, 0, z); /* this curve also runs backwards */
  add_curve(&pair, 2, far);
  add_patch(&pair, 1, 2, 3, 0);
  add_patch(&pair, 4, 5, 6, 0);
  pair.reversed[4 + 1] = 1;
  pair.reversed[4 + 3] = 1;
  return pair;
}

/* Lists each vertex at u = 1 of a patch once, in the order of v. For the second patch, v is reversed. */
typedef struct {
  double v, p[3];
} boundary_vertex;

static int by_v(const void *a, const void *b) {
  const double v = ((const boundary_vertex *)a)->v, w = ((const boundary_vertex *)b)->v;
  return (v > w) - (v < w);
}

static int boundary(const riis_triangles *all, int32_t patch, boundary_vertex *out, int most) {
  int n = 0, n_kept = 0;
  for (int64_t i = 0; i < 3 * all->n_triangles; ++i) {
    const int64_t id = all->vertex_id[i];
    if (all->patch_id[i / 3] != patch || all->uv[2 * id] != 1) continue;
    assert_true(n < most);
    out[n].v = patch ? 1 - all->uv[2 * id + 1] : all->uv[2 * id + 1];
    memcpy(out[n++].p, all->xyz + 3 * id, sizeof out->p);
  }
  qsort(out, (size_t)n, sizeof *out, by_v);
  for (int i = 0; i < n; ++i) {
    if (n_kept > 0 && out[n_kept - 1].v == out[i].v) {
      for (int c = 0; c < 3; ++c) CHECK_NEAR(out[i].p[c], out[n_kept - 1].p[c], 1e-15);
      continue;
    }
    out[n_kept++] = out[i];
  }
  return n_kept;
}

/* Returns the distance of a vertex from a polyline. */
static double distance_to_polyline(const double *p, const boundary_vertex *line, int n) {
  double smallest = INFINITY;
  for (int i = 0; i + 1 < n; ++i) {
    double ab_ab = 0, ab_ap = 0, sum = 0;
    for (int c = 0; c < 3; ++c) {
      const double ab = line[i + 1].p[c] - line[i].p[c];
      ab_ab += ab * ab, ab_ap += ab * (p[c] - line[i].p[c]);
    }
    const double t = fmin(fmax(ab_ap / ab_ab, 0), 1);
    for (int c = 0; c < 3; ++c) {
      const double d = p[c] - line[i].p[c] - t * (line[i + 1].p[c] - line[i].p[c]);
      sum += d * d;
    }
    smallest = fmin(smallest, sqrt(sum));
  }
  return smallest;
}

/* Makes a patch with the shared curve at u = 1, and a moved copy of this curve at u = 0. The patch's quads are planar and never
 * split. The vertices at u = 1 therefore form the curve's polyline. */
static shape strip_along_shared_curve(const shape *pair) {
  shape strip = {0};
  double moved[4][3];
  memcpy(moved, pair->control[0], sizeof moved);
  for (int k = 0; k < 4; ++k) moved[k][0] -= 1;
  add_curve(&strip, 3, (const double(*)[3])pair->control[0]);
  add_curve(&strip, 3, (const double(*)[3])moved);
  add_line(&strip, moved[0][0], moved[0][1], moved[0][2], 0, 0, 0);
  add_line(&strip, moved[3][0], moved[3][1], moved[3][2], 0, 1, moved[3][2]);
  add_patch(&strip, 2, 3, 1, 0);
  return strip;
}

static void check_holds(const boundary_vertex *some, int n, const boundary_vertex *vertex) {
  const boundary_vertex *found = bsearch(vertex, some, (size_t)n, sizeof *some, by_v);
  assert_non_null(found);
  for (int c = 0; c < 3; ++c) CHECK_SAME(found->p[c], vertex->p[c]);
}

TEST(shared_curves_leave_no_cracks) {
  enum { most = 50000 };
  static boundary_vertex a[most], b[most], of_curve[most];
  for (int is_plane = 0; is_plane < 2; ++is_plane) {
    const int owned_before = n_owned();
    shape pair = pair_of_patches(is_plane ? 0 : 0.25);
    if (is_plane) { /* the far side is also straight, so all grid lines come from the shared curve */
      pair.degree[6] = 1;
      memcpy(pair.control[6][1], pair.control[6][2], sizeof pair.control[6][1]);
    }
    const shape strip = strip_along_shared_curve(&pair);
    riis_surface_options options = surface_options();
    options.tolerance = 0.01;
    riis_surface *surface = surface_of(&pair, &options), *alone = surface_of(&strip, &options);
    riis_triangles all = triangles_of(surface);
    const int n_a = boundary(&all, 0, a, most), n_b = boundary(&all, 1, b, most);
    all = triangles_of(alone);
    const int n_of_curve = boundary(&all, 0, of_curve, most);
    assert_true(n_of_curve > 10);
    if (is_plane) assert_true(n_a == n_of_curve && n_b == n_of_curve);
    for (int i = 0; i < n_of_curve; ++i) {
      check_holds(a, n_a, &of_curve[i]);
      check_holds(b, n_b, &of_curve[i]);
    }
    /* A vertex that only one patch has lies on the other patch's edges, up to rounding. */
    for (int i = 0; i < n_a; ++i) CHECK_AT_MOST(distance_to_polyline(a[i].p, b, n_b), 1e-15);
    for (int i = 0; i < n_b; ++i) CHECK_AT_MOST(distance_to_polyline(b[i].p, a, n_a), 1e-15);
    /* The normals of both patches point along S_u x S_v. */
    assert_int_equal(closest_to(surface, -0.5, 0.5, 5).side, 1);
    assert_int_equal(closest_to(surface, 1.5, 0.5, 5).side, 1);
    free_owned_after(owned_before);
  }
}

TEST(collapsed_sides_leave_no_triangles_without_area) {
  const double up[4][3] = {{0, 0, 0}, {0.25, 1, 0.5}, {0.75, 1, 0.5}, {1, 0, 0}};
  const double area[2] = {0.5, 0};
  for (int which = 0; which < 2; ++which) {
    shape from = {0};
    add_line(&from, 0, 0, 0, 1, 0, 0);
    if (which == 0) { /* a triangle: the side v = 1 is a point */
      add_line(&from, 0, 1, 0, 0, 1, 0);
      add_line(&from, 0, 0, 0, 0, 1, 0);
      add_line(&from, 1, 0, 0, 0, 1, 0);
    } else { /* a chord and an arc: the sides u = 0 and u = 1 are points */
      add_curve(&from, 3, up);
      add_line(&from, 0, 0, 0, 0, 0, 0);
      add_line(&from, 1, 0, 0, 1, 0, 0);
    }
    add_patch(&from, 0, 1, 2, 3);
    riis_surface *surface = surface_of(&from, NULL);
    const riis_surface_info info = info_of(surface);
    const riis_triangles all = triangles_of(surface);
    assert_true(info.n_triangles > 0 && info.n_zero_area > 0);
    if (area[which] > 0) CHECK_NEAR(info.area, area[which], 1e-14);
    for (int64_t i = 0; i < all.n_triangles; ++i) {
      const double *a = all.xyz + 3 * all.vertex_id[3 * i], *b = all.xyz + 3 * all.vertex_id[3 * i + 1],
                   *c = all.xyz + 3 * all.vertex_id[3 * i + 2];
      double size = 0, longest = 0;
      for (int x = 0; x < 3; ++x) {
        const int y = (x + 1) % 3, z = (x + 2) % 3;
        const double n = (b[y] - a[y]) * (c[z] - a[z]) - (b[z] - a[z]) * (c[y] - a[y]);
        size += n * n;
        longest = fmax(longest, fmax(fabs(b[x] - a[x]), fmax(fabs(c[x] - b[x]), fabs(a[x] - c[x]))));
      }
      assert_true(sqrt(size) > 1e-12 * longest * longest);
    }
    free_one_owned(surface);
    check_against_dense(&from, 0.05);
  }
}

TEST(opening_blends_control_points) {
  const shape closed = wavy();
  shape open = closed, middle = closed;
  for (int64_t i = 0; i < closed.n_curves; ++i)
    for (int k = 0; k <= closed.degree[i]; ++k)
      for (int c = 0; c < 3; ++c) {
        /* The open state is sheared and lifted. The sides of this state still meet at the corners. */
        open.control[i][k][c] += c == 2 ? 0.5 + closed.control[i][k][0] : 0.25 * closed.control[i][k][2];
        middle.control[i][k][c] = 0.5 * (closed.control[i][k][c] + open.control[i][k][c]);
      }
  const shape *expected[3] = {&closed, &middle, &open};
  riis_valve *valve = valve_from(&closed), *other = valve_from(&open);
  CHECK_OK(riis_valve_set_scalar(other, "opening", 0.25)); /* the open state's own opening has no effect */
  CHECK_OK(riis_valve_set_open_state(valve, other));
  free_one_owned(other);
  for (int step = 0; step <= 2; ++step) {
    CHECK_OK(riis_valve_set_scalar(valve, "opening", 0.5 * step));
    riis_surface *surface = new_surface(valve, NULL);
    check_same_surfaces(surface, surface_of(expected[step], NULL));
  }
  /* A valve may be its own open state. */
  CHECK_OK(riis_valve_set_open_state(valve, valve));
  riis_surface *surface = new_surface(valve, NULL);
  free_one_owned(valve);
  check_same_surfaces(surface, surface_of(&closed, NULL));
}

TEST(sizes_are_limited_by_precision_and_number) {
  shape large = unit_square();
  for (int i = 0; i < 4; ++i)
    for (int k = 0; k < 2; ++k)
      for (int c = 0; c < 3; ++c) large.control[i][k][c] *= 1e30;
  riis_surface_options options = surface_options();
  options.half_thickness = 1e29;
  CHECK_NEAR(info_of(surface_of(&large, &options)).area, 1e60, 1e46);
  riis_surface *surface = NULL;
  riis_valve *valve = valve_from(&large);
  CHECK_REFUSED(RIIS_LIMIT_EXCEEDED, "coordinates up to 1e+30", riis_surface_create(valve, NULL, &surface));
  free_one_owned(valve);

  const shape from = wavy();
  valve = valve_from(&from);
  options.half_thickness = 1e-3;
  options.tolerance = 1e-6;
  CHECK_REFUSED(RIIS_LIMIT_EXCEEDED, "more than 16777216 triangles", riis_surface_create(valve, &options, &surface));
  assert_null(surface);
}

int main(void) { return run_cases(NULL, NULL); }
