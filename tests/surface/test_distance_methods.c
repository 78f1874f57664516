/* SPDX-License-Identifier: Apache-2.0
 * Tests distances by sampling and by minimisation. The results are compared with known distances of flat and cylindrical patches,
 * with triangles fifty times as fine, and with each other. */
#include "internals.h"
#include "test_support.h"

#include "handles.h"
#include "sanitized.h"
#include "searches.h"

static const double half_thickness = 0.1;

static double distance_between(const double *p, const double *q) {
  return hypot(hypot(p[0] - q[0], p[1] - q[1]), p[2] - q[2]);
}

/* Makes patches one after the other, from the control points of their curves v = 0 and v = 1. The curves u = 0 and u = 1 are
 * straight. */
static riis_valve *patches_between(int32_t n_patches, int32_t degree, const double *v0_and_v1) {
  enum { most = 2 };
  int32_t degrees[4 * most], sides[4 * most], leaflet_ids[most];
  double control[3 * 12 * most], *to = control;
  const size_t n = 3 * (size_t)(degree + 1), at_end = n - 3;
  for (int32_t patch = 0; patch < n_patches; ++patch) {
    const double *v0 = v0_and_v1 + 2 * n * (size_t)patch, *v1 = v0 + n;
    const double *straight[4] = {v0, v1, v0 + at_end, v1 + at_end};
    memcpy(to, v0, 2 * n * sizeof *to);
    to += 2 * n;
    for (int i = 0; i < 4; ++i, to += 3) memcpy(to, straight[i], 3 * sizeof *to);
    for (int i = 0; i < 4; ++i) {
      degrees[4 * patch + i] = i < 2 ? degree : 1;
      sides[4 * patch + i] = 4 * patch + i;
    }
    leaflet_ids[patch] = 7 + patch;
  }
  riis_patches patches;
  CHECK_OK(riis_patches_init(&patches, sizeof patches));
  patches.n_curves = 4 * n_patches;
  patches.degree = degrees;
  patches.control = control;
  patches.n_patches = n_patches;
  patches.curve_id = sides;
  patches.leaflet_id = leaflet_ids;
  riis_valve *valve = NULL;
  CHECK_OK(riis_valve_create_from_patches(&patches, &valve));
  return own(valve);
}

/* The rectangle [0,2] x [0,1] in z = 0. */
static riis_valve *rectangle(void) {
  const double sides[12] = {0, 0, 0, 2, 0, 0, 0, 1, 0, 2, 1, 0};
  return patches_between(1, 1, sides);
}

static double distance_to_rectangle(const double *p) {
  const double x = fmax(fmax(-p[0], p[0] - 2), 0), y = fmax(fmax(-p[1], p[1] - 1), 0);
  return hypot(hypot(x, y), p[2]);
}

/* A cylinder over a plane curve, from y = 0 to y = 1. The curve turns by less than half a circle. */
static const double profile[12] = {-1, 0, 0, -0.4, 0, 0.8, 0.5, 0, 0.7, 1, 0, -0.1};

static riis_valve *cylinder(void) {
  double sides[24];
  for (int i = 0; i < 24; ++i) sides[i] = i < 12 || i % 3 != 1 ? profile[i % 12] : 1;
  return patches_between(1, 3, sides);
}

static double distance_to_profile(const double *p, double t) {
  const double a = 1 - t, w[4] = {a * a * a, 3 * a * a * t, 3 * a * t * t, t * t * t};
  double x = -p[0], z = -p[2];
  for (int i = 0; i < 4; ++i) x += w[i] * profile[3 * i], z += w[i] * profile[3 * i + 2];
  return hypot(x, z);
}

/* Follows every local minimum of a fine net of samples. Half way between two minima, the least sample of the net may lead to the
 * wrong minimum. */
static double distance_to_cylinder(const double *p) {
  enum { n = 400 };
  double at[n + 1], nearest = INFINITY;
  for (int i = 0; i <= n; ++i) at[i] = distance_to_profile(p, (double)i / n);
  for (int i = 0; i <= n; ++i) {
    if ((i > 0 && at[i - 1] < at[i]) || (i < n && at[i + 1] < at[i])) continue;
    double low = fmax(i - 1, 0) / n, high = fmin(i + 1, n) / n;
    for (int step = 0; step < 60; ++step) {
      const double third = (high - low) / 3;
      if (distance_to_profile(p, low + third) < distance_to_profile(p, high - third))
        high -= third;
      else
        low += third;
    }
    nearest = fmin(nearest, distance_to_profile(p, low));
  }
  return hypot(nearest, fmax(fmax(-p[1], p[1] - 1), 0));
}

static riis_valve *valve_of(const char *kind) { return new_valve(kind); }

static riis_surface *measured(const riis_valve *valve, int32_t distance, double tolerance) {
  riis_surface_options options = surface_options();
  options.measure = distance;
  options.measure_tolerance = tolerance;
  return new_surface(valve, &options);
}

/* A hairpin that leans more as v grows. At the middle of v, the hairpin's arm at x = 1 is nearest to the point. At v = 1, the
 * other arm is nearest. */
static const double between_arms[3] = {0.2, 1, 1};
static riis_valve *hairpin(void) {
  const double sides[24] = {-1.95, 0, 1, -1.95, 0, -2, 1, 0, -2, 1, 0, 1, -0.05, 1, 1, -0.05, 1, -2, 1, 1, -2, 1, 1, 1};
  return patches_between(1, 3, sides);
}

static void random_point(random_source *rng, const riis_surface *surface, double margin, double *p) {
  const riis_surface_info info = info_of(surface);
  for (int c = 0; c < 3; ++c) p[c] = random_between(rng, info.lower[c] - margin, info.upper[c] + margin);
}

/* Returns a random point of the surface's triangles. */
static void random_point_on(random_source *rng, const riis_surface *surface, double *p) {
  const riis_triangles all = triangles_of(surface);
  const int64_t *id = all.vertex_id + 3 * (random_bits(rng) % (uint64_t)all.n_triangles);
  double a = random_between(rng, 0, 1), b = random_between(rng, 0, 1);
  if (a + b > 1) a = 1 - a, b = 1 - b;
  for (int c = 0; c < 3; ++c)
    p[c] = (1 - a - b) * all.xyz[3 * id[0] + c] + a * all.xyz[3 * id[1] + c] + b * all.xyz[3 * id[2] + c];
}

/* Checks properties of an answer that both methods share on any surface. */
static void check_answer(const riis_closest *answer, const double *p) {
  CHECK_NEAR(answer->distance, distance_between(p, answer->point), 1e-14 * (1 + answer->distance));
  assert_int_equal(answer->triangle_id, -1);
  assert_int_equal(answer->side, 0);
  for (int c = 0; c < 3; ++c) CHECK_SAME(answer->barycentric[c], 0.0);
  const double size = hypot(hypot(answer->normal[0], answer->normal[1]), answer->normal[2]);
  if (size != 0) CHECK_NEAR(size, 1, 1e-14);
}

/* A surface whose distances are known up to an error of `known_to`. Query points lie in a box, or near the surface, where samples
 * have their largest error. */
typedef struct reference {
  const char *name;
  riis_valve *valve;
  double (*distance)(const double *p); /* if NULL, the distance to `fine` is used */
  riis_surface *fine;
  double known_to;
} reference;

enum { n_references = 4 };
static reference references[n_references];

static int make_references(void **state) {
  (void)state;
  riis_surface_options options = surface_options();
  options.tolerance = 1e-3;
  references[0] = (reference){"rectangle", rectangle(), distance_to_rectangle, NULL, 1e-12};
  references[1] = (reference){"cylinder", cylinder(), distance_to_cylinder, NULL, 1e-9};
  references[2] = (reference){"aortic", valve_of("aortic"), NULL, NULL, 1e-3 * half_thickness};
  references[3] = (reference){"mitral", valve_of("mitral"), NULL, NULL, 1e-3 * half_thickness};
  for (int i = 0; i < n_references; ++i) references[i].fine = new_surface(references[i].valve, &options);
  keep_owned_for_group();
  return 0;
}

static double true_distance(const reference *of, const double *p) {
  return of->distance ? of->distance(p) : closest_to(of->fine, p[0], p[1], p[2]).distance;
}

TEST(sampling_is_within_its_bound) {
  random_source rng = random_start("sampling_is_within_its_bound");
  const double tolerances[] = {0.5, 0.1, 0.03};
  for (int i = 0; i < n_references; ++i)
    for (size_t k = 0; k < sizeof tolerances / sizeof *tolerances; ++k) {
      const int owned_before = n_owned();
      const reference *of = &references[i];
      const double bound = tolerances[k] * half_thickness;
      riis_surface *surface = measured(of->valve, RIIS_MEASURE_SAMPLING, tolerances[k]);
      double largest = 0, largest_at_surface = 0;
      for (int n = 0; n < 1500; ++n) {
        double p[3];
        const int is_on = n % 3 == 0;
        if (is_on)
          random_point_on(&rng, of->fine, p);
        else
          random_point(&rng, of->fine, 0.3, p);
        const riis_closest answer = closest_to(surface, p[0], p[1], p[2]);
        check_answer(&answer, p);
        const double error = answer.distance - true_distance(of, p);
        CHECK_AT_MOST(error, bound + of->known_to);
        CHECK_AT_MOST(-error, 0.1 * bound + of->known_to);
        largest = fmax(largest, error / bound);
        if (is_on) largest_at_surface = fmax(largest_at_surface, error / bound);
      }
      printf("%s, tolerance %.2f: at most %.2f of the bound, at the surface %.2f\n", of->name, tolerances[k], largest,
             largest_at_surface);
      free_owned_after(owned_before);
    }
}

/* The rule gives the number of samples. On a rectangle, samples form squares whose half diagonal equals the bound. A point in the
 * middle of a square therefore reaches the bound. */
static char last_message[512];
static void keep_message(void *user_data, int32_t level, const char *message) {
  (void)user_data, (void)level;
  if (strstr(message, "samples")) snprintf(last_message, sizeof last_message, "%s", message);
}

TEST(samples_are_as_many_as_the_rule_says) {
  riis_valve *valve = rectangle();
  riis_set_log(keep_message, NULL);
  /* The tolerance is 0.05, so the steps of the samples are sqrt(2) times 0.05. */
  riis_surface *surface = measured(valve, RIIS_MEASURE_SAMPLING, 0.5);
  riis_set_log(NULL, NULL);
  assert_string_equal(last_message, "distances by sampling: 480 samples of 1 patches"); /* (29 + 1) (15 + 1) */
  const double step[2] = {2.0 / 29, 1.0 / 15};
  double between[3] = {3.5 * step[0], 7.5 * step[1], 0}, at[3] = {3 * step[0], 7 * step[1], 0.25};
  CHECK_NEAR(closest_to(surface, between[0], between[1], 0).distance, 0.5 * hypot(step[0], step[1]), 1e-14);
  const riis_closest answer = closest_to(surface, at[0], at[1], at[2]);
  CHECK_NEAR(answer.distance, 0.25, 1e-14);
  CHECK_NEAR(distance_between(answer.point, at), 0.25, 1e-14);
  CHECK_NEAR(answer.normal[2], 1, 1e-14);
  assert_int_equal(answer.leaflet_id, 7);
}

/* The tree of boxes loses no sample: it finds the nearest sample, and the first of several equally near samples. */
TEST(nearest_samples_are_found) {
  random_source rng = random_start("nearest_samples_are_found");
  for (int of = 0; of < n_references; ++of) {
    const int owned_before = n_owned();
    riis_surface *surface = measured(references[of].valve, RIIS_MEASURE_SAMPLING, of == 0 ? 0.4425 : 0.5);
    const double *xyz;
    const int64_t n_samples = samples_of(surface, &xyz);
    assert_true(n_samples > 500);
    for (int n = 0; n < 300; ++n) {
      double p[3];
      random_point(&rng, surface, pow(10, random_between(&rng, -2, 4)), p);
      if (n % 10 == 0) memcpy(p, xyz + 3 * (random_bits(&rng) % (uint64_t)n_samples), sizeof p);
      /* The rectangle's samples are 1/16 apart, so this point is equally near to four samples. */
      for (int c = 0; c < 2 && of == 0; ++c) p[c] = (double)(2 * (random_bits(&rng) % 16) + 1) / 32;
      double least = INFINITY;
      int64_t nearest = -1;
      for (int64_t i = 0; i < n_samples; ++i) {
        const double x = xyz[3 * i] - p[0], y = xyz[3 * i + 1] - p[1], z = xyz[3 * i + 2] - p[2];
        const double distance_sq = x * x + y * y + z * z;
        if (distance_sq < least) least = distance_sq, nearest = i;
      }
      const riis_closest answer = closest_to(surface, p[0], p[1], p[2]);
      CHECK_SAME(answer.distance, sqrt(least));
      for (int c = 0; c < 3; ++c) CHECK_SAME(answer.point[c], xyz[3 * nearest + c]);
    }
    free_owned_after(owned_before);
  }
}

static double narrow_valley(double u, double v) {
  const double a = u - 0.3, b = v - 0.8;
  return 1 + a * a + b * b - 1.99 * a * b;
}
static double bent_valley(double u, double v) { return 1 + 100 * (v - u * u) * (v - u * u) + (0.9 - u) * (0.9 - u); }
static double outside(double u, double v) { return (u + 1) * (u + 1) + (v - 2) * (v - 2) + (u + 1) * (2 - v); }
static double on_a_side(double u, double v) { return 1 + (u - 2) * (u - 2) + 3 * (v - u / 4) * (v - u / 4); }
static double flat(double u, double v) { return u * 0 + v * 0 + 2; }

/* Powell's method finds three kinds of minima exactly: inside the square, where its directions must turn, at a corner, and on a
 * side. */
TEST(powell_finds_minima) {
  const struct {
    double (*f)(double u, double v);
    double u, v, value, tolerance;
  } cases[] = {{narrow_valley, 0.3, 0.8, 1, 1e-5},
               {bent_valley, 0.9, 0.81, 1, 1e-4},
               {outside, 0, 1, 3, 0},
               {on_a_side, 1, 0.25, 2, 1e-6},
               {flat, 0.5, 0.5, 2, 0}};
  for (size_t i = 0; i < sizeof cases / sizeof *cases; ++i) {
    double uv[2];
    const double value = powell_minimum(cases[i].f, 1e-13, 1e-8, uv);
    CHECK_SAME(value, cases[i].f(uv[0], uv[1]));
    CHECK_NEAR(uv[0], cases[i].u, cases[i].tolerance);
    CHECK_NEAR(uv[1], cases[i].v, cases[i].tolerance);
    CHECK_NEAR(value, cases[i].value, 1e-9);
  }
}

/* The distances of two points from the surface differ by at most the distance between the points. The proof of the neighbour
 * search relies on this bound. */
TEST(sampling_is_lipschitz) {
  random_source rng = random_start("sampling_is_lipschitz");
  riis_surface *surface = measured(references[3].valve, RIIS_MEASURE_SAMPLING, 0.2);
  for (int n = 0; n < 2000; ++n) {
    double p[3], q[3];
    random_point(&rng, surface, 0.2, p);
    const double apart = pow(10, random_between(&rng, -6, 0));
    for (int c = 0; c < 3; ++c) q[c] = p[c] + apart * random_between(&rng, -1, 1);
    const double d = closest_to(surface, p[0], p[1], p[2]).distance, e = closest_to(surface, q[0], q[1], q[2]).distance;
    CHECK_AT_MOST(fabs(d - e), distance_between(p, q) + 1e-14);
  }
}

/* Minimisation never gives a distance that is too small. On a rectangle, minimisation is exact, because the squared distance has
 * one minimum. On other surfaces, minimisation may end in a wrong local minimum. Most answers are right, and the test prints the
 * number of wrong answers. */
TEST(minimisation_is_never_below) {
  random_source rng = random_start("minimisation_is_never_below");
  const double tolerances[] = {0.01, 0.001}; /* the tolerances of the paper */
  for (int i = 0; i < n_references; ++i)
    for (int k = 0; k < 2; ++k) {
      const int owned_before = n_owned();
      const reference *of = &references[i];
      riis_surface *surface = measured(of->valve, RIIS_MEASURE_MINIMIZATION, tolerances[k]);
      const int n_points = 1000;
      int n_off = 0;
      double largest = 0;
      for (int n = 0; n < n_points; ++n) {
        double p[3];
        if (n % 2)
          random_point_on(&rng, of->fine, p);
        else
          random_point(&rng, of->fine, 0.3, p);
        const riis_closest answer = closest_to(surface, p[0], p[1], p[2]);
        check_answer(&answer, p);
        const double error = (answer.distance - true_distance(of, p)) / half_thickness,
                     known = of->known_to / half_thickness;
        CHECK_AT_MOST(-error, 0.1 * tolerances[k] + known);
        if (i == 0) CHECK_AT_MOST(error, tolerances[k]);
        largest = fmax(largest, error);
        n_off += error > 0.02 + known;
      }
      printf("%s, tolerance %.3f: %d of %d more than 0.02 half thicknesses off, at most %.3f\n", of->name,
             tolerances[k], n_off, n_points, largest);
      CHECK_AT_MOST(n_off, 0.1 * n_points);
      free_owned_after(owned_before);
    }
}

/* A known failure: the search starts in the middle, goes to the wrong arm of the hairpin and stays there. The distance and the
 * mark from this search are wrong. */
TEST(minimisation_ends_in_local_minima) {
  riis_valve *valve = hairpin();
  riis_surface_options options = surface_options();
  options.half_thickness = 0.5;
  options.measure_tolerance = 0.01;
  int64_t n_marked[3];
  double distance[3];
  for (int32_t method = 0; method < 3; ++method) {
    const int owned_before = n_owned();
    options.measure = method;
    riis_marks *result = new_result();
    riis_surface *surface = new_surface(valve, &options);
    distance[method] = closest_to(surface, between_arms[0], between_arms[1], between_arms[2]).distance;
    riis_mesh *mesh = mesh_of(1, between_arms);
    CHECK_OK(riis_mark_nodes(surface, mesh, NULL, result));
    n_marked[method] = marked_in(result).n;
    free_owned_after(owned_before);
  }
  CHECK_NEAR(distance[RIIS_MEASURE_TRIANGLES], 0.25, 0.005);
  CHECK_NEAR(distance[RIIS_MEASURE_SAMPLING], 0.25, 0.005);
  CHECK_NEAR(distance[RIIS_MEASURE_MINIMIZATION], 0.8, 0.005);
  assert_int_equal(n_marked[RIIS_MEASURE_TRIANGLES], 1);
  assert_int_equal(n_marked[RIIS_MEASURE_SAMPLING], 1);
  assert_int_equal(n_marked[RIIS_MEASURE_MINIMIZATION], 0);
}

/* The patch with the nearest box may not contain the nearest point. In this test the nearest box even contains the query's
 * point. */
TEST(all_near_patches_are_asked) {
  /* A slope through [0,1]^3, and a floor below the slope. */
  const double sides[24] = {0, 0, 0, 1, 0, 1, 0, 1, 0, 1, 1, 1, 0, 0, -0.3, 1, 0, -0.3, 0, 1, -0.3, 1, 1, -0.3};
  riis_valve *valve = patches_between(2, 1, sides);
  riis_surface *surface = measured(valve, RIIS_MEASURE_MINIMIZATION, 0.001);
  const riis_closest below = closest_to(surface, 0.9, 0.5, 0.1), above = closest_to(surface, 0.1, 0.5, 0.3);
  CHECK_NEAR(below.distance, 0.4, 1e-4);
  assert_int_equal(below.leaflet_id, 8);
  CHECK_NEAR(above.distance, 0.2 / sqrt(2), 1e-4);
  assert_int_equal(above.leaflet_id, 7);
}

/* Surfaces are placed, flipped or mirrored. The normals are those of the triangles, and the distances are proportional to the
 * scale. */
TEST(placement_and_normals) {
  random_source rng = random_start("placement_and_normals");
  riis_valve *valve = valve_of("aortic");
  for (int32_t method = RIIS_MEASURE_SAMPLING; method <= RIIS_MEASURE_MINIMIZATION; ++method)
    for (int32_t flip = 0; flip < 2; ++flip) {
      const int owned_before = n_owned();
      riis_surface_options options = surface_options();
      options.scale = 10;
      options.rotation_axis[0] = 1;
      options.rotation_angle = 50;
      options.translation[1] = -7;
      options.flip_normals = flip;
      options.tolerance = options.measure_tolerance = 0.02;
      riis_surface *triangles = new_surface(valve, &options);
      options.measure = method;
      riis_surface *other = new_surface(valve, &options);
      int n_same = 0;
      const int n_points = 300;
      for (int n = 0; n < n_points; ++n) {
        double p[3];
        random_point_on(&rng, triangles, p);
        const riis_closest a = closest_to(triangles, p[0], p[1], p[2]), b = closest_to(other, p[0], p[1], p[2]);
        const double cosine = a.normal[0] * b.normal[0] + a.normal[1] * b.normal[1] + a.normal[2] * b.normal[2];
        n_same += a.leaflet_id == b.leaflet_id && cosine > 0.9 && b.distance <= 0.04 * 1.0;
      }
      CHECK_AT_MOST(0.95 * n_points, n_same); /* except for some points next to the bending curves */
      free_owned_after(owned_before);
    }
}

static void mark(const riis_surface *surface, const riis_mesh *mesh, int32_t search, int32_t n_threads, double limit,
                 const uint8_t *mask, riis_marks *result) {
  riis_mark_options options = mark_options();
  options.search = search;
  options.n_threads = n_threads;
  options.distance_limit = limit;
  options.node_mask = mask;
  CHECK_OK(riis_mark_nodes(surface, mesh, &options, result));
}

/* All complete searches find the nodes that a query of every node finds, for any number of threads. The paper's search may find
 * only a part of the nodes. */
TEST(searches_agree) {
  random_source rng = random_start("searches_agree");
  riis_valve *hairpin_valve = hairpin();
  const riis_valve *valves[3] = {references[2].valve, references[3].valve, hairpin_valve};
  for (int of = 0; of < 3; ++of)
    for (int32_t method = RIIS_MEASURE_SAMPLING; method <= RIIS_MEASURE_MINIMIZATION; ++method) {
      if (is_short_test() && of != method) continue;
      const int owned_before = n_owned();
      riis_surface *surface = measured(valves[of], method, method == RIIS_MEASURE_SAMPLING ? 0.2 : 0.01);
      test_mesh nodes = lattice_around(surface, is_short_test() ? 0.15 : 0.11, 0.2);
      riis_mesh *mesh = mesh_from(&nodes);
      uint8_t *mask = own(malloc((size_t)nodes.n));
      for (int64_t i = 0; i < nodes.n; ++i) mask[i] = random_bits(&rng) % 4 != 0;
      const double limits[] = {RIIS_AUTO, 0.17};
      for (int k = 0; k < 4; k += is_short_test() ? 3 : 1) {
        const int n_outside = n_owned();
        const double limit = limits[k / 2];
        const uint8_t *which = k % 2 ? mask : NULL;
        riis_marks *expected = new_result(), *result = new_result();
        mark(surface, mesh, RIIS_SEARCH_EXHAUSTIVE, 1, limit, which, expected);
        assert_int_equal(stats_of(expected).instructions, RIIS_INSTRUCTIONS_BASELINE);
        /* A query of every node gives the expected result. */
        const found_nodes within = within_in(expected);
        const double farthest = limit < 0 ? half_thickness : limit;
        int64_t n = 0;
        for (int64_t i = 0; i < nodes.n; ++i) {
          if (which && !which[i]) continue;
          const riis_closest one = closest_to(surface, nodes.xyz[3 * i], nodes.xyz[3 * i + 1], nodes.xyz[3 * i + 2]);
          if (!(one.distance <= farthest)) continue;
          assert_true(n < within.n);
          assert_int_equal(within.node_id[n], i);
          CHECK_SAME(within.distance[n], one.distance);
          assert_int_equal(within.leaflet_id[n], one.leaflet_id);
          assert_int_equal(within.triangle_id[n++], -1);
        }
        assert_int_equal(n, within.n);
        assert_true(marked_in(expected).n > 50 && marked_in(expected).n < nodes.n / 2);
        for (int32_t n_threads = 1; n_threads <= 3; ++n_threads) {
          /* The first marking starts without marks. The second marking starts from the nodes that the first one marked. In the
           * third marking, the library chooses the search. */
          for (int repeat = 0; repeat < 2; ++repeat) {
            mark(surface, mesh, RIIS_SEARCH_NEIGHBOR, n_threads, limit, which, result);
            assert_true(same_results(expected, result));
            assert_int_equal(stats_of(result).complete, 1);
            assert_int_equal(stats_of(result).search, RIIS_SEARCH_NEIGHBOR);
          }
          mark(surface, mesh, RIIS_SEARCH_AUTO, n_threads, limit, which, result);
          assert_int_equal(stats_of(result).search, RIIS_SEARCH_EXHAUSTIVE);
          assert_true(same_results(expected, result));
          free_one_owned(result);
          result = new_result();
        }
        mark(surface, mesh, RIIS_SEARCH_PAPER, 2, limit, which, result);
        const found_nodes of_paper = within_in(result), all = within_in(expected);
        assert_int_equal(stats_of(result).complete, 0);
        for (int64_t i = 0, j = 0; i < of_paper.n; ++i) {
          while (j < all.n && all.node_id[j] < of_paper.node_id[i]) ++j;
          assert_true(j < all.n && all.node_id[j] == of_paper.node_id[i]);
          CHECK_SAME(all.distance[j], of_paper.distance[i]);
        }
        free_owned_after(n_outside);
      }
      free_owned_after(owned_before);
    }
}

/* Two nodes near the hairpin form a ball. From the ball's middle, minimisation goes to the farther arm, which is twice the ball's
 * radius away. The search must keep the node, because minimisation from the node finds that it is near. */
TEST(local_minima_dismiss_no_group) {
  const double xyz[6] = {-0.1, 1, 0.9, 0.6, 1, 0.9};
  const int32_t offsets[3] = {0, 0, 0};
  riis_valve *valve = hairpin();
  riis_surface *surface = measured(valve, RIIS_MEASURE_MINIMIZATION, 0.01);
  assert_true(closest_to(surface, 0.25, 1, 0.9).distance > 0.7 && closest_to(surface, -0.1, 1, 0.9).distance < 0.1);
  riis_marks *result = new_result();
  riis_csr csr;
  CHECK_OK(riis_csr_init(&csr, sizeof csr));
  csr.n_rows = 2;
  csr.offsets = offsets;
  riis_mesh *mesh = mesh_of(2, xyz);
  CHECK_OK(riis_mesh_set_adjacency(mesh, &csr));
  mark(surface, mesh, RIIS_SEARCH_NEIGHBOR, 1, RIIS_AUTO, NULL, result);
  const found_nodes marked = marked_in(result);
  assert_true(marked.n == 1 && marked.node_id[0] == 0);
}

/* Batches give the results of single points for any number of threads. Far points are reported as far. */
TEST(batches_agree) {
  random_source rng = random_start("batches_agree");
  enum { n_points = 1500 };
  static double xyz[3 * n_points], distance[n_points], point[3 * n_points], normal[3 * n_points];
  static int64_t triangle_id[n_points];
  static int32_t leaflet_id[n_points];
  for (int32_t method = RIIS_MEASURE_SAMPLING; method <= RIIS_MEASURE_MINIMIZATION; ++method) {
    const int owned_before = n_owned();
    riis_surface *surface = measured(references[2].valve, method, 0.1);
    for (int i = 0; i < n_points; ++i) random_point(&rng, surface, 0.5, xyz + 3 * i);
    riis_closest_arrays arrays;
    riis_closest_options options;
    CHECK_OK(riis_closest_arrays_init(&arrays, sizeof arrays));
    CHECK_OK(riis_closest_options_init(&options, sizeof options));
    arrays.distance = distance, arrays.point = point, arrays.normal = normal;
    arrays.triangle_id = triangle_id, arrays.leaflet_id = leaflet_id;
    for (options.n_threads = 1; options.n_threads <= 3; ++options.n_threads) {
      options.distance_limit = options.n_threads == 3 ? 0.3 : INFINITY;
      CHECK_OK(closest_points_of(surface, n_points, xyz, xyz + 1, xyz + 2, 3, &options, &arrays));
      int n_far = 0;
      for (int i = 0; i < n_points; ++i) {
        const riis_closest one = closest_to(surface, xyz[3 * i], xyz[3 * i + 1], xyz[3 * i + 2]);
        const int is_far = options.n_threads == 3 && !(one.distance <= 0.3);
        n_far += is_far;
        CHECK_SAME(distance[i], is_far ? RIIS_FAR_DISTANCE : one.distance);
        assert_int_equal(leaflet_id[i], is_far ? -1 : one.leaflet_id);
        assert_int_equal(triangle_id[i], -1);
        for (int c = 0; c < 3; ++c) {
          CHECK_SAME(point[3 * i + c], is_far ? 0 : one.point[c]);
          CHECK_SAME(normal[3 * i + c], is_far ? 0 : one.normal[c]);
        }
      }
      assert_true(options.n_threads < 3 ? n_far == 0 : n_far > 0 && n_far < n_points);
    }
    free_owned_after(owned_before);
  }
}

TEST(what_has_no_meaning_is_refused) {
  double xyz[9] = {0, 0, 0, 1, 0, 0, 0, 1, 0}, barycentric[3];
  const int32_t ids[3] = {0, 1, 2};
  int32_t side;
  const riis_surface_arrays triangle = triangle_arrays(3, xyz, 1, ids);
  riis_surface_options options = surface_options();
  riis_surface *surface = NULL;
  for (options.measure = 1; options.measure < 3; ++options.measure) {
    char text[64];
    snprintf(text, sizeof text, "options.measure is %d|surface from arrays", options.measure);
    CHECK_REFUSED(RIIS_INVALID_ARGUMENT, text, riis_surface_create_from_arrays(&triangle, &options, &surface));
    assert_null(surface);
  }

  riis_valve *valve = rectangle();
  surface = measured(valve, RIIS_MEASURE_SAMPLING, 0.1);
  /* Options that only the surface of a valve uses are refused for arrays. A refusal does not change the surface. */
  CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "options.measure is 1",
                riis_surface_update_from_arrays(surface, &triangle, NULL));
  options = surface_options();
  options.measure = RIIS_MEASURE_SAMPLING;
  options.measure_tolerance = 1e-4; /* the ratio is 2 / 1e-10 */
  CHECK_REFUSED(RIIS_LIMIT_EXCEEDED, "16777216 samples|1e-05, which is measure_tolerance * half_thickness",
                riis_surface_update(surface, valve, &options));
  CHECK_NEAR(closest_to(surface, 1, 0.5, 3).distance, 3, 0.01);
  riis_valve *curved = cylinder();
  options.measure = RIIS_MEASURE_MINIMIZATION;
  options.measure_tolerance = 1e-6;
  options.half_thickness = 1e-8;
  options.tolerance = 1;
  CHECK_REFUSED(RIIS_LIMIT_EXCEEDED, "with a tenth of measure_tolerance",
                riis_surface_update(surface, curved, &options));
  free_one_owned(curved);
  options.half_thickness = 1e-4;
  options.translation[0] = 1e4;
  CHECK_REFUSED(RIIS_INVALID_ARGUMENT,
                "options.translation moves the valve by 10000|measure_tolerance * half_thickness, 1e-10",
                riis_surface_update(surface, valve, &options));

  riis_closest_arrays arrays;
  CHECK_OK(riis_closest_arrays_init(&arrays, sizeof arrays));
  arrays.side = &side;
  CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "arrays.side is given|by sampling",
                closest_points_of(surface, 1, xyz, xyz + 1, xyz + 2, 3, NULL, &arrays));
  arrays.side = NULL;
  arrays.barycentric = barycentric;
  CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "arrays.barycentric is given|by sampling",
                closest_points_of(surface, 1, xyz, xyz + 1, xyz + 2, 3, NULL, &arrays));
  riis_marks *result = new_result();
  riis_mark_options marking = mark_options();
  marking.search = RIIS_SEARCH_CLUSTERS;
  riis_mesh *mesh = mesh_of(3, xyz);
  CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "options.search is 4|by sampling",
                riis_mark_nodes(surface, mesh, &marking, result));
}

/* A surface keeps its method of measuring when its valve moves. */
TEST(options_stay_and_default) {
  riis_valve *valve = valve_of("mitral");
  riis_surface *surface = measured(valve, RIIS_MEASURE_SAMPLING, 0.2);
  CHECK_OK(riis_valve_set_scalar(valve, "opening", 0.3));
  CHECK_OK(riis_surface_update(surface, valve, NULL));
  riis_surface *twin = measured(valve, RIIS_MEASURE_SAMPLING, 0.2);
  random_source rng = random_start("options_stay_and_default");
  for (int n = 0; n < 100; ++n) {
    double p[3];
    random_point(&rng, surface, 0.2, p);
    const riis_closest a = closest_to(surface, p[0], p[1], p[2]), b = closest_to(twin, p[0], p[1], p[2]);
    assert_int_equal(a.triangle_id, -1);
    assert_memory_equal(&a, &b, sizeof a);
  }
  riis_surface_options options = surface_options();
  CHECK_OK(riis_surface_update(surface, valve, &options));
  assert_true(closest_to(surface, 0, 0, 0).triangle_id >= 0);
  /* RIIS_AUTO means the surface's tolerance. */
  options = surface_options();
  assert_true(options.measure == RIIS_MEASURE_TRIANGLES && options.measure_tolerance == RIIS_AUTO);
  options.measure = RIIS_MEASURE_SAMPLING;
  options.tolerance = 0.2;
  CHECK_OK(riis_surface_update(surface, valve, &options));
  for (int n = 0; n < 100; ++n) {
    double p[3];
    random_point(&rng, surface, 0.2, p);
    CHECK_SAME(closest_to(surface, p[0], p[1], p[2]).distance, closest_to(twin, p[0], p[1], p[2]).distance);
  }
}

int main(void) { return run_cases(make_references, free_owned_of_group); }
