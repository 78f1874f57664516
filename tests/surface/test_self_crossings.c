/* SPDX-License-Identifier: Apache-2.0
 * A search finds the pairs of a surface's triangles that go through each other. The search is compared with a check of all pairs
 * in extended precision. Triangles are in general position, touch in every way, lie in one plane, or go through each other by a
 * given depth. RIIS_TEST_LONG=1 tries fifty times as many. */
#include <riis/riis.h>

#include "test_support.h"

#include "handles.h"
#include "penetration_oracle.h"

static random_source rng;

static int64_t random_integer(int64_t low, int64_t high) {
  return low + (int64_t)(random_bits(&rng) % (uint64_t)(high - low + 1));
}
static int one_in(int64_t n) { return random_integer(1, n) == 1; }

enum { max_triangles = 1200 };

typedef struct soup {
  int64_t n_vertices, n_triangles;
  double xyz[9 * max_triangles];
  int32_t ids[3 * max_triangles], leaflet_id[max_triangles];
} soup;

static int has_area(const double *t) {
  double ab[3], ac[3];
  for (int i = 0; i < 3; ++i) ab[i] = t[3 + i] - t[i], ac[i] = t[6 + i] - t[i];
  const double n[3] = {ab[1] * ac[2] - ab[2] * ac[1], ab[2] * ac[0] - ab[0] * ac[2], ab[0] * ac[1] - ab[1] * ac[0]};
  return n[0] * n[0] + n[1] * n[1] + n[2] * n[2] > 1e-12;
}

/* Adds a triangle with separate vertices. A triangle with hardly any area is left out. */
static void add_triangle(soup *s, const double *t, int32_t leaflet_id) {
  if (!has_area(t)) return;
  memcpy(s->xyz + 3 * s->n_vertices, t, 9 * sizeof *t);
  for (int k = 0; k < 3; ++k) s->ids[3 * s->n_triangles + k] = (int32_t)s->n_vertices++;
  s->leaflet_id[s->n_triangles++] = leaflet_id;
}

static void random_triangle(double *t, double size) {
  double centre[3];
  for (int i = 0; i < 3; ++i) centre[i] = random_between(&rng, -1, 1);
  do
    for (int k = 0; k < 9; ++k) t[k] = centre[k % 3] + size * random_between(&rng, -1, 1);
  while (!has_area(t));
}

static void add_random(soup *s) {
  double t[9];
  const double size = exp(random_between(&rng, -3, 0.5));
  for (int k = 0; k < 16; ++k) {
    random_triangle(t, size);
    if (one_in(4)) /* a sliver */
      for (int i = 0; i < 3; ++i) t[6 + i] = 0.5 * (t[i] + t[3 + i]) + 1e-3 * (t[6 + i] - t[i]);
    add_triangle(s, t, (int32_t)random_integer(0, 2));
  }
}

/* Triangles have small whole coordinates. They therefore share corners and sides, lie in common planes, and cross exactly at
   corners and sides. */
static void add_whole_numbers(soup *s) {
  const int64_t largest = random_integer(1, 4);
  const int in_plane = one_in(3);
  double t[9];
  for (int k = 0; k < 14; ++k) {
    for (int i = 0; i < 9; ++i) t[i] = in_plane && i % 3 == 2 ? 1 : (double)random_integer(-largest, largest);
    add_triangle(s, t, (int32_t)random_integer(0, 1));
  }
}

/* Gives a point of the triangle: a corner, a point of a side, or an inner point. */
static void point_of(const double *t, int kind, double *point) {
  const double u = kind == 0 ? 0 : random_between(&rng, 0, 1), v = kind == 2 ? random_between(&rng, 0, 1 - u) : 0;
  for (int i = 0; i < 3; ++i) point[i] = t[i] + u * (t[3 + i] - t[i]) + v * (t[6 + i] - t[i]);
}

/* A corner or the middle of a side of the second triangle lies on the first triangle, up to a shift of any size. */
static void add_touching(soup *s) {
  double t[9], other[9], point[3];
  for (int k = 0; k < 8; ++k) {
    random_triangle(t, 1);
    add_triangle(s, t, 0);
    random_triangle(other, 1);
    point_of(t, (int)random_integer(0, 2), point);
    const double shift = one_in(2) ? 0 : ldexp(random_between(&rng, -1, 1), -(int)random_integer(2, 50));
    for (int i = 0; i < 3; ++i) {
      other[i] = point[i] + shift;
      /* Mirrors the corner on some axes only. The triangles then do not touch, but are near each other. */
      if (one_in(3) && k % 2) other[i] = 2 * point[i] - other[3 + i];
    }
    if (k % 4 == 0)
      for (int i = 0; i < 3; ++i) other[i] = 2 * point[i] - other[3 + i] + shift;
    if (k % 4 == 2) memcpy(other + 3, t + 3, 3 * sizeof *t);
    add_triangle(s, other, (int32_t)random_integer(0, 1));
  }
}

/* All triangles are in one plane, up to rounding. The plane is oblique to the axes. */
static void add_in_plane(soup *s) {
  const double u[3] = {random_between(&rng, -1, 1), random_between(&rng, -1, 1), random_between(&rng, -1, 1)};
  const double v[3] = {random_between(&rng, -1, 1), random_between(&rng, -1, 1), 0.5};
  for (int k = 0; k < 14; ++k) {
    double t[9];
    for (int corner = 0; corner < 3; ++corner) {
      const double x = random_between(&rng, -1, 1), y = random_between(&rng, -1, 1);
      for (int i = 0; i < 3; ++i) t[3 * corner + i] = x * u[i] + y * v[i];
    }
    add_triangle(s, t, (int32_t)random_integer(0, 1));
  }
}

/* A wavy sheet. Triangles have separate vertices, or share the vertices of their neighbours. */
static void add_sheet(soup *s, int side, int32_t leaflet_id, int shares) {
  const double height = random_between(&rng, -0.1, 0.1), tilt = random_between(&rng, -0.5, 0.5);
  const int64_t first = s->n_vertices;
  double *xyz = s->xyz + 3 * first;
  const int n = (side + 1) * (side + 1);
  for (int i = 0; i < n; ++i) {
    xyz[3 * i] = -1 + 2.0 * (i % (side + 1)) / side;
    xyz[3 * i + 1] = -1 + 2.0 * (double)(i / (side + 1)) / side;
    xyz[3 * i + 2] = height + tilt * xyz[3 * i] + 0.1 * sin(5 * xyz[3 * i + 1] + leaflet_id);
  }
  static const int order[6] = {0, 1, 2, 0, 2, 3};
  double sheet[3 * 400];
  memcpy(sheet, xyz, 3 * (size_t)n * sizeof *sheet);
  if (shares) s->n_vertices += n;
  for (int i = 0; i < side * side; ++i) {
    const int at = i % side + (side + 1) * (i / side), corners[4] = {at, at + 1, at + side + 2, at + side + 1};
    for (int half = 0; half < 2; ++half) {
      double t[9];
      for (int k = 0; k < 3; ++k) memcpy(t + 3 * k, sheet + 3 * corners[order[3 * half + k]], 3 * sizeof *t);
      if (!shares) add_triangle(s, t, leaflet_id);
      for (int k = 0; shares && k < 3; ++k)
        s->ids[3 * s->n_triangles + k] = (int32_t)(first + corners[order[3 * half + k]]);
      if (shares) s->leaflet_id[s->n_triangles++] = leaflet_id;
    }
  }
}

static void add_sheets(soup *s) {
  const int side = (int)random_integer(2, 5), shares = one_in(2);
  for (int32_t k = 0; k < 2; ++k) add_sheet(s, side, one_in(3) ? 0 : k, shares);
}

/* Changes the unit and the position of the triangles. */
static void move(soup *s) {
  const double unit = ldexp(1, (int)random_integer(-120, 120)), far = one_in(2) ? 0 : random_between(&rng, -50, 50);
  for (int64_t i = 0; i < 3 * s->n_vertices; ++i) s->xyz[i] = unit * (s->xyz[i] + far);
}

static riis_surface *surface_of_soup(const soup *s, double half_thickness) {
  riis_surface_options options = surface_options();
  options.half_thickness = half_thickness;
  riis_surface_arrays arrays = triangle_arrays(s->n_vertices, s->xyz, s->n_triangles, s->ids);
  arrays.leaflet_id = s->leaflet_id;
  return surface_from(&arrays, &options);
}

/* Returns the crossings. The list's arrays live as long as the test. If the caller passes `crossings`, the call reuses the memory
 * of this list. */
static riis_crossing_list crossings_in(const riis_surface *surface, double depth, int32_t n_threads,
                                       riis_crossings *crossings) {
  riis_crossing_options options;
  riis_crossing_list list;
  CHECK_OK(riis_crossing_options_init(&options, sizeof options));
  options.depth = depth;
  options.n_threads = n_threads;
  CHECK_OK(riis_find_crossings(surface, &options, crossings));
  CHECK_OK(riis_crossings_get_list(crossings, &list, sizeof list));
  return list;
}

static riis_crossings *new_crossings(void) {
  riis_crossings *crossings = NULL;
  CHECK_OK(riis_crossings_create(&crossings));
  return own(crossings);
}

static riis_crossing_list crossings_of(const riis_surface *surface, double depth, int32_t n_threads) {
  return crossings_in(surface, depth, n_threads, new_crossings());
}

static int are_neighbours(const double *a, const double *b) {
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      if (a[3 * i] == b[3 * j] && a[3 * i + 1] == b[3 * j + 1] && a[3 * i + 2] == b[3 * j + 2]) return 1;
  return 0;
}

static double longest_edge(const double *t) {
  double longest = 0;
  for (int k = 0; k < 3; ++k) {
    const double *p = t + 3 * k, *q = t + 3 * ((k + 1) % 3);
    longest = fmax(longest, sqrt(pow(p[0] - q[0], 2) + pow(p[1] - q[1], 2) + pow(p[2] - q[2], 2)));
  }
  return longest;
}

static int boxes_overlap(const double *a, const double *b) {
  for (int i = 0; i < 3; ++i)
    if (fmax(fmax(a[i], a[3 + i]), a[6 + i]) < fmin(fmin(b[i], b[3 + i]), b[6 + i]) ||
        fmax(fmax(b[i], b[3 + i]), b[6 + i]) < fmin(fmin(a[i], a[3 + i]), a[6 + i]))
      return 0;
  return 1;
}

typedef struct tally {
  int64_t n_crossing, n_touching, n_undecided;
} tally;

/* Checks the numbers that are reported for a pair. */
static void check_pair(const riis_crossing_list *pairs, int64_t at, const double *a, const double *b, double depth,
                       double largest) {
  const double longest = fmax(longest_edge(a), longest_edge(b));
  double middle[3];
  const double length = oracle_segment(a, b, middle);
  CHECK_NEAR(pairs->depth[at], depth, 0x1p-24 * longest + 0x1p-48 * largest);
  /* The angle between the planes is at least depth / longest. If this ratio is smaller, the segment is less exact. */
  const double error = 0x1p-44 * (longest + largest) * longest / depth;
  CHECK_NEAR(pairs->length[at], length, error);
  for (int i = 0; i < 3; ++i) CHECK_NEAR(pairs->point[3 * at + i], middle[i], error);
}

/* Compares all pairs with the oracle. */
static void check_soup(const soup *s, const riis_crossing_list *pairs, double limit, tally *count) {
  double largest = 0;
  for (int64_t i = 0; i < 9 * s->n_triangles; ++i) largest = fmax(largest, fabs(s->xyz[3 * s->ids[i / 3] + i % 3]));
  int64_t next = 0;
  for (int64_t i = 0; i < s->n_triangles; ++i)
    for (int64_t j = i + 1; j < s->n_triangles; ++j) {
      double a[9], b[9];
      for (int k = 0; k < 9; ++k) {
        a[k] = s->xyz[3 * s->ids[3 * i + k / 3] + k % 3];
        b[k] = s->xyz[3 * s->ids[3 * j + k / 3] + k % 3];
      }
      const int is_found =
          next < pairs->n_pairs && pairs->triangle_id[2 * next] == i && pairs->triangle_id[2 * next + 1] == j;
      const int is_no_pair = s->leaflet_id[i] == s->leaflet_id[j] && are_neighbours(a, b);
      const double depth = is_no_pair || !boxes_overlap(a, b) ? 0 : oracle_depth(a, b);
      const double longest = fmax(longest_edge(a), longest_edge(b));
      const double error = 0x1p-24 * longest + 0x1p-48 * largest;
      const double least = fmax(limit, 0x1p-24 * longest + 0x1p-46 * largest);
      if (is_found && depth <= fmax(least - error, 0))
        fail_msg("%lld %lld of depth %g cross", (long long)i, (long long)j, depth);
      if (!is_found && depth > least + error)
        fail_msg("%lld %lld of depth %g are missing", (long long)i, (long long)j, depth);
      if (is_found) check_pair(pairs, next++, a, b, depth, largest);
      count->n_crossing += is_found;
      count->n_touching += !is_found && depth > 0;
      count->n_undecided += fabs(depth - least) <= error;
    }
  assert_int_equal(next, pairs->n_pairs);
}

static void check_summary(const soup *s, const riis_crossing_list *crossings) {
  const riis_crossing_list pairs = *crossings;
  double length = 0;
  int64_t deepest = 0;
  for (int64_t i = 0; i < pairs.n_pairs; ++i) {
    length += pairs.length[i];
    if (pairs.depth[i] > pairs.depth[deepest]) deepest = i;
  }
  CHECK_SAME(crossings->total_length, length);
  if (pairs.n_pairs == 0) {
    assert_null(pairs.triangle_id);
    assert_int_equal(crossings->deepest_triangle_id[0], -1);
    assert_int_equal(crossings->deepest_leaflet_id[1], -1);
    CHECK_SAME(crossings->deepest_depth, 0);
    return;
  }
  CHECK_SAME(crossings->deepest_depth, pairs.depth[deepest]);
  for (int i = 0; i < 3; ++i) CHECK_SAME(crossings->deepest_point[i], pairs.point[3 * deepest + i]);
  for (int i = 0; i < 2; ++i) {
    assert_int_equal(crossings->deepest_triangle_id[i], pairs.triangle_id[2 * deepest + i]);
    assert_int_equal(crossings->deepest_leaflet_id[i], s->leaflet_id[pairs.triangle_id[2 * deepest + i]]);
  }
}

TEST(pairs_equal_those_of_all_triangles) {
  static void (*const kinds[])(soup *) = {add_random, add_whole_numbers, add_touching, add_in_plane, add_sheets};
  enum { n_kinds = sizeof kinds / sizeof *kinds };
  const int n_trials = n_kinds * trials(100, 5000);
  tally tallies[n_kinds] = {{0}};
  riis_crossings *crossings = new_crossings();
  soup *s = own(malloc(sizeof *s));
  for (int trial = 0; trial < n_trials; ++trial) {
    s->n_vertices = s->n_triangles = 0;
    kinds[trial % n_kinds](s);
    move(s);
    if (s->n_triangles == 0) continue;
    double size = 0;
    for (int64_t i = 0; i < s->n_triangles; ++i) {
      double t[9];
      for (int k = 0; k < 9; ++k) t[k] = s->xyz[3 * s->ids[3 * i + k / 3] + k % 3];
      size = fmax(size, longest_edge(t));
    }
    const double depths[] = {1e-6, 0, 1e-3, 0.3};
    const double depth = depths[random_integer(0, 3)], half_thickness = 0.2 * size;
    riis_surface *surface = surface_of_soup(s, half_thickness);
    const riis_crossing_list list = crossings_in(surface, depth, 1, crossings);
    check_soup(s, &list, depth * half_thickness, &tallies[trial % n_kinds]);
    check_summary(s, &list);
    free_one_owned(surface);
  }
  free_one_owned(s);
  for (int kind = 0; kind < n_kinds; ++kind) {
    print_message("kind %d: %lld cross, %lld touch, %lld are too close to call\n", kind,
                  (long long)tallies[kind].n_crossing, (long long)tallies[kind].n_touching,
                  (long long)tallies[kind].n_undecided);
    /* Random triangles have the fewest crossing pairs of all kinds: 157 in 100 trials, and 85 with the worst of 81 seeds. */
    if (kinds[kind] == add_in_plane)
      assert_int_equal(tallies[kind].n_crossing, 0);
    else
      assert_true(5 * tallies[kind].n_crossing > n_trials / n_kinds);
    assert_true(tallies[kind].n_undecided <= tallies[kind].n_crossing / 10);
  }
}

/* Compares the numbers of two lists, except the seconds. */
static int same_summary(const riis_crossing_list *a, const riis_crossing_list *b) {
  const size_t from = offsetof(riis_crossing_list, total_length), to = offsetof(riis_crossing_list, seconds);
  return a->n_pairs == b->n_pairs && memcmp((const char *)a + from, (const char *)b + from, to - from) == 0;
}

/* There are so many groups of triangles that threads share the work. The tree of boxes has several levels. */
TEST(threads_find_the_same) {
  soup *s = own(malloc(sizeof *s));
  s->n_vertices = s->n_triangles = 0;
  for (int32_t k = 0; k < 2; ++k) add_sheet(s, 17, k, 1);
  double *second = s->xyz + 3 * (s->n_vertices / 2);
  for (int64_t i = 0; i < s->n_vertices / 2; ++i) second[3 * i + 2] = 0.5 * s->xyz[3 * i] - s->xyz[3 * i + 2];
  riis_surface *one = surface_of_soup(s, 0.1), *many = surface_of_soup(s, 0.1);
  const riis_crossing_list p = crossings_of(one, 1e-6, 1);
  tally count = {0};
  check_soup(s, &p, 1e-7, &count);
  for (int32_t n_threads = 2; n_threads < 9; n_threads += 3) {
    const riis_crossing_list q = crossings_of(many, 1e-6, n_threads);
    assert_true(same_summary(&p, &q));
    assert_true(p.n_pairs > 20);
    const size_t n = (size_t)p.n_pairs;
    assert_memory_equal(p.triangle_id, q.triangle_id, 2 * n * sizeof *p.triangle_id);
    assert_memory_equal(p.point, q.point, 3 * n * sizeof *p.point);
    assert_memory_equal(p.depth, q.depth, n * sizeof *p.depth);
    assert_memory_equal(p.length, q.length, n * sizeof *p.length);
  }
}

/* Two unit squares at right angles cross along a segment as long as a side. Each triangle of one square crosses one triangle of
 * the other square. The shortest way to separate two triangles moves a corner across the other triangle's diagonal. The length of
 * this way is half a side times sin 45 degrees. */
TEST(unit_squares_cross_along_one_unit) {
  const double xyz[] = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 0.5, 0, -0.5, 0.5, 1, -0.5, 0.5, 1, 0.5, 0.5, 0, 0.5};
  const int32_t ids[] = {0, 1, 2, 0, 2, 3, 4, 5, 6, 4, 6, 7};
  int32_t leaflet_id[] = {0, 0, 7, 7};
  riis_surface_arrays arrays = triangle_arrays(8, xyz, 4, ids);
  arrays.leaflet_id = leaflet_id;
  for (int one_leaflet = 0; one_leaflet < 2; ++one_leaflet) {
    if (one_leaflet) memset(leaflet_id, 0, sizeof leaflet_id);
    riis_surface *surface = surface_from(&arrays, NULL);
    const riis_crossing_list crossings = crossings_of(surface, 1e-6, 0);
    assert_int_equal(crossings.n_pairs, 2);
    CHECK_NEAR(crossings.total_length, 1, 1e-15);
    CHECK_NEAR(crossings.deepest_depth, sqrt(0.125), 1e-15);
    assert_int_equal(crossings.deepest_triangle_id[0], 0);
    assert_int_equal(crossings.deepest_triangle_id[1], 3);
    assert_int_equal(crossings.deepest_leaflet_id[1], one_leaflet ? 0 : 7);
    CHECK_NEAR(crossings.deepest_point[0], 0.5, 1e-15);
    CHECK_NEAR(crossings.deepest_point[1], 0.25, 1e-15);
    CHECK_NEAR(crossings.deepest_point[2], 0, 1e-15);
    assert_true(crossings.seconds > 0);
    free_one_owned(surface);
  }
}

/* A tip goes through a floor by a known depth. The limit is given in half thicknesses. */
TEST(a_tip_crosses_beyond_the_limit) {
  for (int i = -2; i <= 2; ++i) {
    const double through = 0.25e-4 * (1 + 0.01 * i);
    const double xyz[] = {-9, -9, 0, 9, -9, 0, 0, 9, 0, 0, 0, -through, -1, 0, 1, 1, 0, 1};
    const int32_t ids[] = {0, 1, 2, 3, 4, 5};
    const riis_surface_arrays arrays = triangle_arrays(6, xyz, 2, ids);
    riis_surface_options options = surface_options();
    options.half_thickness = 0.25;
    riis_surface *surface = surface_from(&arrays, &options);
    const riis_crossing_list crossings = crossings_of(surface, 1e-4, 1);
    assert_int_equal(crossings.n_pairs, i > 0);
    if (i > 0) CHECK_NEAR(crossings.deepest_depth, through, 1e-15);
    if (i > 0) CHECK_NEAR(crossings.total_length, 2 * through / (1 + through), 1e-15);
    free_one_owned(surface);
  }
}

/* Triangles without area keep their ids. An update of the surface and a refused search leave the pairs as they were. */
TEST(pairs_stay_until_the_next_search) {
  const double xyz[] = {-1, -1, 0, 1, -1, 0, 0, 1, 0, 0, 0, -1, -1, 0, 1, 1, 0, 1};
  const int32_t ids[] = {0, 0, 1, 0, 1, 2, 1, 1, 1, 3, 4, 5};
  const riis_surface_arrays arrays = triangle_arrays(6, xyz, 4, ids);
  riis_surface_options options = surface_options();
  options.zero_area = RIIS_ZERO_AREA_SKIP;
  riis_surface *surface = surface_from(&arrays, &options);
  riis_crossings *crossings = new_crossings();
  riis_crossing_list before, after;
  CHECK_OK(riis_crossings_get_list(crossings, &before, sizeof before));
  assert_true(before.n_pairs == 0 && !before.triangle_id && before.deepest_triangle_id[0] == -1);
  before = crossings_in(surface, 1e-6, 0, crossings);
  assert_int_equal(before.n_pairs, 1);
  assert_int_equal(before.triangle_id[0], 1);
  assert_int_equal(before.triangle_id[1], 3);
  riis_crossing_options wrong;
  CHECK_OK(riis_crossing_options_init(&wrong, sizeof wrong));
  wrong.depth = 2;
  CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "options.depth is 2", riis_find_crossings(surface, &wrong, crossings));
  riis_valve *valve = new_valve("mitral");
  CHECK_OK(riis_surface_update(surface, valve, NULL));
  CHECK_OK(riis_crossings_get_list(crossings, &after, sizeof after));
  assert_memory_equal(&before, &after, sizeof before);
  assert_int_equal(after.triangle_id[1], 3);
}

TEST(bad_arguments_are_refused_by_name) {
  riis_surface *surface = surface_of_kind("mitral", NULL);
  riis_crossing_options options;
  riis_crossings *crossings = new_crossings();
  riis_crossing_list list;
  CHECK_OK(riis_crossing_options_init(&options, sizeof options));
  CHECK_SAME(options.depth, 1e-6);
  assert_int_equal(options.n_threads, 0);
  const double wrong[] = {-1e-9, RIIS_AUTO, 1.0000001, INFINITY, NAN};
  for (size_t i = 0; i < sizeof wrong / sizeof *wrong; ++i) {
    options.depth = wrong[i];
    CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "options.depth is |from 0 to 1",
                  riis_find_crossings(surface, &options, crossings));
  }
  options.depth = 1e-6;
  options.n_threads = -1;
  CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "options.n_threads is -1", riis_find_crossings(surface, &options, crossings));
  options.n_threads = 0;
  options.struct_size = 16;
  CHECK_REFUSED(RIIS_INVALID_STRUCT_SIZE, "options|16", riis_find_crossings(surface, &options, crossings));
  CHECK_REFUSED(RIIS_INVALID_STRUCT_SIZE, "options|32", riis_crossing_options_init(&options, 32));
  CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "options", riis_crossing_options_init(NULL, sizeof options));
  CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "crossings is NULL", riis_find_crossings(surface, NULL, NULL));
  CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "surface is NULL", riis_find_crossings(NULL, NULL, crossings));
  CHECK_REFUSED(RIIS_INVALID_STRUCT_SIZE, "list is 120|112", riis_crossings_get_list(crossings, &list, 120));
  CHECK_REFUSED(RIIS_INVALID_STRUCT_SIZE, "list is 104|112", riis_crossings_get_list(crossings, &list, 104));
  CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "list is NULL", riis_crossings_get_list(crossings, NULL, sizeof list));
}

/* The library's default states do not cross at any opening, for any kind of valve. */
TEST(valves_do_not_cross) {
  static const char *const kinds[] = {"aortic", "trileaflet", "bileaflet", "mitral", "coapting"};
  for (int kind = 0; kind < 5; ++kind) {
    riis_valve *valve = new_valve(kinds[kind]);
    riis_surface *surface = new_surface(valve, NULL);
    for (int i = 0; i <= 100; ++i) {
      CHECK_OK(riis_valve_set_scalar(valve, "opening", 0.01 * i));
      CHECK_OK(riis_surface_update(surface, valve, NULL));
      const riis_crossing_list crossings = crossings_of(surface, 1e-6, 0);
      if (crossings.n_pairs > 0)
        fail_msg("%s, opening %g: %lld pairs", kinds[kind], 0.01 * i, (long long)crossings.n_pairs);
    }
  }
}

/* The closed leaflets of the mitral valve touch. Fixed triangles of closed leaflets may cross by twice the error bound. The test
 * prints the depth at opening 0 for docs/theory/crossings.md. */
TEST(fixed_triangles_cross_within_their_error) {
  riis_surface_options options = surface_options();
  options.triangulation = RIIS_TRIANGULATION_FIXED;
  riis_valve *valve = new_valve("mitral");
  riis_surface *surface = new_surface(valve, &options);
  for (int i = 0; i <= 100; i += 5) {
    CHECK_OK(riis_valve_set_scalar(valve, "opening", 0.01 * i));
    CHECK_OK(riis_surface_update(surface, valve, NULL));
    const riis_surface_info info = info_of(surface);
    assert_int_equal(crossings_of(surface, 2 * info.error_bound / info.half_thickness, 0).n_pairs, 0);
    const riis_crossing_list crossings = crossings_of(surface, 1e-6, 0);
    if (i > 0) {
      assert_int_equal(crossings.n_pairs, 0);
    } else {
      print_message(
          "closed mitral valve, fixed triangles: %lld pairs cross by up to %.2g half thicknesses, error bound %.2g\n",
          (long long)crossings.n_pairs, crossings.deepest_depth / info.half_thickness,
          info.error_bound / info.half_thickness);
    }
  }
}

/* A cusp that is turned by 60 degrees goes through its neighbours. All methods of measuring distances use these triangles. */
TEST(a_turned_cusp_crosses) {
  riis_valve *valve = new_valve("aortic");
  const double turned[3] = {0, 0, 60};
  double rotation[3];
  CHECK_OK(riis_valve_get(valve, "right.rotation", 3, rotation));
  for (int i = 0; i < 3; ++i) rotation[i] += turned[i];
  CHECK_OK(riis_valve_set(valve, "right.rotation", 3, rotation));
  riis_surface_options options = surface_options();
  riis_crossing_list by_triangles = {0};
  for (options.measure = RIIS_MEASURE_TRIANGLES; options.measure <= RIIS_MEASURE_MINIMIZATION; ++options.measure) {
    riis_surface *surface = new_surface(valve, &options);
    const riis_crossing_list crossings = crossings_of(surface, 1e-6, 0);
    if (options.measure == RIIS_MEASURE_TRIANGLES) by_triangles = crossings;
    assert_true(same_summary(&crossings, &by_triangles));
    assert_true(crossings.n_pairs > 10 && crossings.deepest_depth > 1e-3);
    assert_true(crossings.deepest_leaflet_id[0] != crossings.deepest_leaflet_id[1]);
  }
}

int main(void) {
  rng = random_start("test_self_crossings");
  return run_cases(NULL, NULL);
}
