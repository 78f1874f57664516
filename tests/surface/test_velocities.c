/* SPDX-License-Identifier: Apache-2.0
 * Compares velocities of opening valves with the smooth motion, at vertices and inside triangles. Also tests the bound of the
 * errors of velocities, for any motion. */
#include <riis/riis.h>

#include "test_support.h"

#include "handles.h"
#include "sanitized.h"
#include "smooth_motion.h"
#include "velocity_bound.h"

static random_source rng;

static double between(double low, double high) { return random_between(&rng, low, high); }
static double distance(const double *p, const double *q) { return hypot(hypot(p[0] - q[0], p[1] - q[1]), p[2] - q[2]); }

static const char *kinds[] = {"aortic", "trileaflet", "mitral", "bileaflet", "coapting"};
enum { n_kinds = 5 };

static double largest_speed(const riis_surface *surface) {
  static const double zero[3] = {0, 0, 0};
  const double *velocity = velocity_of(surface);
  const int64_t n = triangles_of(surface).n_vertices;
  double largest = 0;
  for (int64_t i = 0; i < n; ++i) largest = fmax(largest, distance(velocity + 3 * i, zero));
  return largest;
}

/* The corners, the middles of the edges and the centre of a triangle. */
enum { n_weights = 7, n_corners = 3 };
static const double weights[n_weights][3] = {
    {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0.5, 0.5, 0}, {0, 0.5, 0.5}, {0.5, 0, 0.5}, {1. / 3, 1. / 3, 1. / 3}};

static void interpolate(const double *values, int n_values, const int64_t *corner, const double *weight, double *made) {
  for (int x = 0; x < n_values; ++x) {
    made[x] = 0;
    for (int k = 0; k < 3; ++k) made[x] += weight[k] * values[n_values * corner[k] + x];
  }
}

/* Differences from the velocity of the smooth valve's nearest point, as fractions of the largest speed. */
typedef struct compared {
  double vertices, inside;
} compared;

/* Compares every `one_of`-th triangle. */
static compared compare(const riis_surface *surface, const smooth_motion *motion, int64_t one_of) {
  const riis_triangles c = triangles_of(surface);
  const double *velocity = velocity_of(surface), speed = largest_speed(surface);
  compared made = {0, 0};
  for (int64_t t = (int64_t)(random_bits(&rng) % (uint64_t)one_of); t < c.n_triangles; t += one_of)
    for (int w = 0; w < n_weights; ++w) {
      double p[3], uv[2], found[3], expected[3];
      const int64_t *corner = c.vertex_id + 3 * t;
      interpolate(c.xyz, 3, corner, weights[w], p);
      interpolate(c.uv, 2, corner, weights[w], uv);
      interpolate(velocity, 3, corner, weights[w], found);
      smooth_motion_nearest(motion, c.patch_id[t], uv, p, expected);
      double *worst = w < n_corners ? &made.vertices : &made.inside;
      *worst = fmax(*worst, distance(found, expected) / speed);
    }
  return made;
}

/* The valve opens in steps of a thousandth. The first openings of the list have the largest known errors. RIIS_TEST_LONG tests
 * all openings. */
TEST(velocities_follow_the_smooth_valve) {
  static const int known[] = {957, 930, 950, 755, 1000};
  enum { n_known = sizeof known / sizeof *known };
  const int is_long = is_long_test(), n_random = trials_of(4);
  for (int kind = 0; kind < n_kinds; ++kind)
    for (int fixed = 0; fixed < 2; ++fixed)
      for (int fine = 0; fine < (is_short_test() ? 1 : 2); ++fine) {
        const int owned_before = n_owned();
        riis_valve *valve = new_valve(kinds[kind]), *before = new_valve(kinds[kind]);
        riis_surface_options options = surface_options();
        options.tolerance = fine ? 0.01 : 0.05;
        options.triangulation = fixed ? RIIS_TRIANGULATION_FIXED : RIIS_TRIANGULATION_ADAPTED;
        CHECK_OK(riis_valve_set_scalar(valve, "opening", 0));
        riis_surface *surface = new_surface(valve, &options);
        compared worst = {0, 0};
        for (int i = 0; i < (is_long ? 1000 : n_known + n_random); i += trial_step()) {
          const int at = is_long ? i + 1 : i < n_known ? known[i] : 1 + (int)(random_bits(&rng) % 1000);
          CHECK_OK(riis_valve_set_scalar(valve, "opening", at / 1000.));
          CHECK_OK(riis_valve_set_scalar(before, "opening", (at - 1) / 1000.));
          CHECK_OK(riis_surface_update_moving(surface, valve, before, 0.001, NULL, NULL));
          smooth_motion *motion = smooth_motion_create(valve, before, 0.001);
          const compared here = compare(surface, motion, fine ? 97 : i < 2 && !is_short_test() ? 1 : 8);
          smooth_motion_destroy(motion);
          if (here.vertices > 0.01 || here.inside > 0.02)
            fail_msg("%s at %d, triangulation %d, tolerance %g: off by %.3g at a vertex, by %.3g inside", kinds[kind],
                     at, fixed, options.tolerance, here.vertices, here.inside);
          worst.vertices = fmax(worst.vertices, here.vertices), worst.inside = fmax(worst.inside, here.inside);
        }
        printf("%s, triangulation %d, tolerance %g: at most %.2f %% off at vertices, %.2f %% inside triangles\n",
               kinds[kind], fixed, options.tolerance, 100 * worst.vertices, 100 * worst.inside);
        free_owned_after(owned_before);
      }
}

/* --- The bound for any motion ---------------------------------------------------------------------------------------- */

typedef struct value {
  const char *name;
  double low, high;
} value;
static const value aortic_values[] = {
    {"opening", 0, 1}, {"root_radius", 1.2, 1.4},      {"leaflet_height", 0.95, 1.1}, {"bending_height", 0.6, 0.75},
    {"xq", -0.3, 0},   {"open_radius_ratio", 0.6, 0.9}};
static const value trileaflet_values[] = {
    {"opening", 0, 1},  {"root_radius", 1.15, 1.35},    {"leaflet_height", 1.1, 1.3}, {"bending_height", 0.5, 0.7},
    {"zq", -0.4, -0.2}, {"open_radius_ratio", 0.7, 0.9}};
static const value mitral_values[] = {{"opening", 0, 1}, {"surface_angle", -30, 30}, {"anterior_ratio", 0.36, 0.45}};
static const value bileaflet_values[] = {{"opening", 0, 1}, {"closed_angle", 20, 35}};
static const value coapting_values[] = {{"opening", 0, 1},
                                        {"root_radius", 1.15, 1.35},
                                        {"commissure_height", 1.7, 1.9},
                                        {"effective_height", 0.85, 1},
                                        {"coaptation_height", 0.3, 0.5},
                                        {"belly", 0.4, 0.6},
                                        {"open_radius_ratio", 0.7, 0.85}};
static const struct {
  const value *values;
  int n;
} values_of[n_kinds] = {
    {aortic_values, 6}, {trileaflet_values, 6}, {mitral_values, 3}, {bileaflet_values, 2}, {coapting_values, 7}};

/* Changes one value, at position `only`, at random. If `only` is negative, changes about half of all values. */
static void move(riis_valve *valve, int kind, int only) {
  for (int i = 0; i < values_of[kind].n; ++i)
    if (only < 0 ? random_bits(&rng) % 2 : i == only)
      CHECK_OK(riis_valve_set_scalar(valve, values_of[kind].values[i].name,
                                     between(values_of[kind].values[i].low, values_of[kind].values[i].high)));
}

/* Scales, turns about z and shifts. */
static void place(const riis_surface_options *by, const double *p, double *placed) {
  const double angle = by->rotation_angle * acos(-1) / 180, c = cos(angle), s = sin(angle);
  placed[0] = by->scale * (c * p[0] - s * p[1]) + by->translation[0];
  placed[1] = by->scale * (s * p[0] + c * p[1]) + by->translation[1];
  placed[2] = by->scale * p[2] + by->translation[2];
}

/* Returns the largest difference from the smooth motion, at equal patch, u and v. */
static double farthest_at_labels(const riis_surface *surface, const smooth_motion *motion,
                                 const riis_surface_options *now, const riis_surface_options *then, double seconds) {
  const riis_triangles c = triangles_of(surface);
  const double *velocity = velocity_of(surface);
  double farthest = 0;
  for (int64_t t = 0; t < c.n_triangles; t += 3) {
    for (int i = 0; i < 4; ++i) {
      double weight[3] = {between(0, 1), between(0, 1), between(0, 1)};
      const double sum = weight[0] + weight[1] + weight[2];
      for (int k = 0; k < 3; ++k) weight[k] = i == 0 ? weights[3 + t % 4][k] : weight[k] / sum;
      double uv[2], found[3], p[3], q[3], p_placed[3], q_placed[3], expected[3];
      interpolate(c.uv, 2, c.vertex_id + 3 * t, weight, uv);
      interpolate(velocity, 3, c.vertex_id + 3 * t, weight, found);
      smooth_motion_places(motion, c.patch_id[t], uv, p, q);
      place(now, p, p_placed), place(then, q, q_placed);
      for (int x = 0; x < 3; ++x) expected[x] = (p_placed[x] - q_placed[x]) / seconds;
      farthest = fmax(farthest, distance(found, expected));
    }
  }
  return farthest;
}

TEST(the_bound_holds_for_any_motion) {
  double least_ratio = INFINITY;
  for (int trial = 0; trial < trials_of(80); ++trial) {
    const int owned_before = n_owned(), kind = trial % n_kinds;
    riis_valve *valve = new_valve(kinds[kind]), *before = NULL;
    riis_surface_options options = surface_options(), then;
    move(valve, kind, -1);
    CHECK_OK(riis_valve_copy(valve, &before));
    own(before);
    /* The motion is a step of the opening, or a jump of one or several values. */
    double opening;
    CHECK_OK(riis_valve_get(valve, "opening", 1, &opening));
    if (trial / n_kinds % 2)
      CHECK_OK(riis_valve_set_scalar(before, "opening", fmax(0, opening - pow(10, between(-4, -1)))));
    else
      move(before, kind, trial / n_kinds % 4 ? -1 : (int)(random_bits(&rng) % (uint64_t)values_of[kind].n));
    options.tolerance = pow(10, between(-2.3, -1));
    options.scale = pow(10, between(-1, 1));
    options.half_thickness = 0.1 * options.scale;
    options.triangulation = (int32_t)(random_bits(&rng) % 2);
    then = options;
    if (trial % 3 == 0) {
      then.scale *= between(0.8, 1.2), then.rotation_angle = between(-30, 30);
      for (int x = 0; x < 3; ++x) then.translation[x] = between(-1, 1);
    }
    const double seconds = pow(10, between(-3, 1));
    riis_surface *surface = new_surface(valve, &options);
    CHECK_OK(riis_surface_update_moving(surface, valve, before, seconds, NULL, &then));
    smooth_motion *motion = smooth_motion_create(valve, before, seconds);
    const double bound = velocity_error_bound(surface, valve, before, seconds, &then), speed = largest_speed(surface);
    const double off = farthest_at_labels(surface, motion, &options, &then, seconds);
    smooth_motion_destroy(motion);
    assert_true(bound >= 0 && bound < 1e300);
    if (off > bound + 1e-9 * options.scale / seconds)
      fail_msg("trial %d, %s: off by %.9g, more than the bound %.9g; the largest speed is %.3g", trial, kinds[kind],
               off, bound, speed);
    if (off > 1e-6 * speed) least_ratio = fmin(least_ratio, bound / off);
    free_owned_after(owned_before);
  }
  printf("the bound is at least %.2f times what was found\n", least_ratio);
}

/* The bound is useful: for an opening valve it is a small fraction of the speed. If few triangles bend strongly, the bound is
 * close to the true error. docs/theory/velocity.md has the printed shares. */
TEST(the_bound_is_near) {
  static const double most[n_kinds] = {0.35, 0.06, 0.08, 0.04, 0.06};
  const int n = is_short_test() ? 10 : 100;
  for (int kind = 0; kind < n_kinds; ++kind) {
    riis_valve *valve = new_valve(kinds[kind]), *before = new_valve(kinds[kind]);
    double least = INFINITY, largest = 0;
    for (int i = 1; i <= n; ++i) {
      CHECK_OK(riis_valve_set_scalar(valve, "opening", (double)i / n));
      CHECK_OK(riis_valve_set_scalar(before, "opening", (double)i / n - 0.001));
      riis_surface *surface = new_surface(valve, NULL);
      CHECK_OK(riis_surface_update_moving(surface, valve, before, 0.001, NULL, NULL));
      const double share = velocity_error_bound(surface, valve, before, 0.001, NULL) / largest_speed(surface);
      least = fmin(least, share), largest = fmax(largest, share);
      free_one_owned(surface);
      if (i == n) CHECK_AT_MOST(share, 0.06);
    }
    printf("%s, %d openings: the bound is %.3g to %.3g of the largest speed\n", kinds[kind], n, least, largest);
    CHECK_AT_MOST(largest, most[kind]);
  }
  /* At opening 0.633 a joint of the annulus passes the end of a mitral patch. The span after the joint is short at this opening,
   * and its length changes many times over. A bound that compared the two states on this short span would reach 3.8 times the
   * largest speed. */
  riis_valve *passing = new_valve("mitral"), *just_before = new_valve("mitral");
  double worst = 0;
  for (int i = 2; i <= 60; i += trial_step()) {
    const double opening = 0.62 + 0.0005 * i;
    CHECK_OK(riis_valve_set_scalar(passing, "opening", opening));
    CHECK_OK(riis_valve_set_scalar(just_before, "opening", opening - 0.001));
    riis_surface *surface = new_surface(passing, NULL);
    CHECK_OK(riis_surface_update_moving(surface, passing, just_before, 0.001, NULL, NULL));
    worst = fmax(worst, velocity_error_bound(surface, passing, just_before, 0.001, NULL) / largest_speed(surface));
    free_one_owned(surface);
  }
  printf("mitral, where a joint passes: the bound is at most %.3g of the largest speed\n", worst);
  CHECK_AT_MOST(worst, 0.2);
  /* At the opening below, the leaflets are flat and begin to bend. */
  riis_valve *valve = new_valve("mitral"), *before = new_valve("mitral"), *open = new_valve("mitral");
  CHECK_OK(riis_valve_set_scalar(valve, "surface_angle", 25));
  CHECK_OK(riis_valve_set_scalar(open, "surface_angle", -25));
  CHECK_OK(riis_valve_set_open_state(valve, open));
  CHECK_OK(riis_valve_set_scalar(valve, "opening", 0.5));
  free_one_owned(before);
  CHECK_OK(riis_valve_copy(valve, &before));
  own(before);
  CHECK_OK(riis_valve_set_scalar(before, "opening", 0.499));
  riis_surface_options options = surface_options();
  riis_surface *surface = new_surface(valve, &options);
  CHECK_OK(riis_surface_update_moving(surface, valve, before, 0.001, NULL, NULL));
  smooth_motion *motion = smooth_motion_create(valve, before, 0.001);
  const double off = farthest_at_labels(surface, motion, &options, &options, 0.001);
  smooth_motion_destroy(motion);
  const double bound = velocity_error_bound(surface, valve, before, 0.001, NULL);
  printf("flat leaflets that bend: off by %.3g, the bound is %.3g, the largest speed %.3g\n", off, bound,
         largest_speed(surface));
  assert_true(off > 0.3);
  CHECK_AT_MOST(off, bound);
  CHECK_AT_MOST(bound, 3 * off);
}

/* If a motion leaves everything in place, velocities have no error. */
TEST(no_motion_has_no_error) {
  for (int kind = 0; kind < n_kinds; ++kind) {
    riis_valve *valve = new_valve(kinds[kind]);
    riis_surface *surface = new_surface(valve, NULL);
    CHECK_OK(riis_surface_update_moving(surface, valve, valve, 1, NULL, NULL));
    assert_true(velocity_error_bound(surface, valve, valve, 1, NULL) == 0);
  }
}

int main(void) {
  rng = random_start("test_velocities");
  return run_cases(NULL, NULL);
}
