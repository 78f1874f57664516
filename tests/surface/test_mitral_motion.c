/* SPDX-License-Identifier: Apache-2.0
 * Compares the velocity of the mitral valve's surface with the oracle in extended precision. The velocity is compared with the
 * displacement of the point with equal patch, u and v, and with the derivative in time. */
#include <riis/riis.h>

#include "test_support.h"

#include "handles.h"
#include "mitral_oracle.h"
#include "oracle.h"
#include "searches.h"
#include "tie_oracle.h"

static random_source rng;

/* The parameters by name. */
#define FIELD(name) \
  { #name, offsetof(mitral_parameters, name) }
static const struct {
  const char *name;
  size_t at;
} scalars[] = {FIELD(anterior_ratio),
               FIELD(AP_diameter),
               FIELD(ALPM_diameter),
               FIELD(ALPM_position_ratio),
               FIELD(IT_distance),
               FIELD(indent_depth),
               FIELD(anterior_horn_height),
               FIELD(posterior_horn_height),
               FIELD(anterior_length),
               FIELD(posteromedial_commissure_height),
               FIELD(posterior_scallop_length1),
               FIELD(posterior_scallop_length2),
               FIELD(leaflet_arc_angle),
               FIELD(leaflet_inward_angle),
               FIELD(surface_angle),
               FIELD(triangle_size_ratio),
               FIELD(opening)};
enum { n_scalars = sizeof scalars / sizeof *scalars };

static double *scalar_of(mitral_parameters *p, int i) { return (double *)(void *)((char *)p + scalars[i].at); }

/* A valve and its open state. */
typedef struct states {
  mitral_parameters closed, open;
} states;

static states paper_at(double opening) {
  states s = {mitral_defaults(), mitral_defaults()};
  s.closed.opening = opening;
  return s;
}

static riis_valve *valve_with(mitral_parameters p) {
  riis_valve *valve = new_valve("mitral");
  for (int i = 0; i < n_scalars; ++i) CHECK_OK(riis_valve_set_scalar(valve, scalars[i].name, *scalar_of(&p, i)));
  CHECK_OK(riis_valve_set(valve, "translation", 3, p.translation));
  return valve;
}

static riis_valve *valve_of(const states *s) {
  riis_valve *valve = valve_with(s->closed), *open = valve_with(s->open);
  CHECK_OK(riis_valve_set_open_state(valve, open));
  free_one_owned(open);
  return valve;
}

/* The smooth valve, and the positions on its annulus at which the patches begin and end. */
typedef struct smooth {
  mitral_oracle *oracle;
  double from[10], to[10];
} smooth;

static void destroy_oracle(void *oracle) { mitral_oracle_destroy(oracle); }

static smooth smooth_of(const states *s) {
  smooth made = {mitral_oracle_create(&s->closed, &s->open), {0}, {0}};
  assert_non_null(made.oracle);
  own_object(made.oracle, destroy_oracle);
  double breaks[MITRAL_ORACLE_BREAKS];
  mitral_oracle_breaks(made.oracle, breaks);
  const double cleft = mitral_oracle_anterior_cleft(made.oracle);
  const double from[5] = {0.5, cleft, breaks[3], breaks[2], breaks[1]},
               to[5] = {cleft, breaks[3], breaks[2], breaks[1], 0};
  static const int patch[5] = {2, 1, 0, 6, 7}, mirrored[5] = {3, 4, 5, 9, 8};
  for (int i = 0; i < 5; ++i) {
    made.from[patch[i]] = from[i], made.to[patch[i]] = to[i];
    made.from[mirrored[i]] = 1 - from[i], made.to[mirrored[i]] = 1 - to[i];
  }
  return made;
}

static void smooth_point(const smooth *s, int patch, double u, double v, double *p) {
  mitral_oracle_point(s->oracle, s->from[patch] + u * (s->to[patch] - s->from[patch]), v, p);
}

/* Gives the mean velocity, between two states, of the point with a given patch, u and v. */
static void mean_velocity(const smooth *now, const smooth *before, double seconds, int patch, const double *uv,
                          double *velocity) {
  double p[3], q[3];
  smooth_point(now, patch, uv[0], uv[1], p);
  smooth_point(before, patch, uv[0], uv[1], q);
  for (int c = 0; c < 3; ++c) velocity[c] = (p[c] - q[c]) / seconds;
}

static double distance(const double *p, const double *q) { return hypot(hypot(p[0] - q[0], p[1] - q[1]), p[2] - q[2]); }

static double largest_speed(const riis_surface *surface) {
  static const double zero[3] = {0, 0, 0};
  const double *velocity = velocity_of(surface);
  const int64_t n = triangles_of(surface).n_vertices;
  double largest = 0;
  for (int64_t i = 0; i < n; ++i) {
    const double speed = distance(velocity + 3 * i, zero);
    if (!(speed <= largest)) largest = speed;
  }
  return largest;
}

/* the largest difference from the mean velocity of the oracle */
typedef struct compared {
  double vertices, points; /* the largest difference from the mean velocity of the oracle */
  double sides;            /* the largest difference at vertices on the annulus and on the free edges */
  /* The share of vertices that differ only by rounding. Only some vertices on sides of split quads differ by more. */
  double exact;
  /* The largest difference from the derivative at the present time, at vertices; -1: not compared. */
  double from_derivative;
  double sum, speed; /* sum: mean difference at random points; speed: largest speed */
} compared;

static const int32_t *patches_of_vertices(const riis_triangles *c) {
  int32_t *patch = own(malloc((size_t)c->n_vertices * sizeof *patch));
  for (int64_t i = 0; i < c->n_vertices; ++i) patch[i] = -1;
  for (int64_t k = 0; k < 3 * c->n_triangles; ++k) patch[c->vertex_id[k]] = c->patch_id[k / 3];
  return patch;
}

static compared compare(const states *now, const states *before, double seconds, double tolerance, int64_t n_points) {
  const int owned_before = n_owned();
  compared made = {0, 0, 0, 0, -1, 0, 0};
  riis_valve *valve = valve_of(now), *valve_before = valve_of(before);
  riis_surface_options options = surface_options();
  options.tolerance = tolerance;
  options.n_threads = 1;
  riis_surface *surface = new_surface(valve, &options);
  CHECK_OK(riis_surface_update_moving(surface, valve, valve_before, seconds, NULL, NULL));
  const smooth s = smooth_of(now), t = smooth_of(before);
  const riis_triangles c = triangles_of(surface);
  const double *velocity = velocity_of(surface);
  const int32_t *patch = patches_of_vertices(&c);
  double expected[3];
  int64_t n_left_out = 0, n_exact = 0;
  for (int64_t i = 0; i < c.n_vertices; ++i) {
    if (patch[i] < 0) {
      ++n_left_out;
      continue;
    }
    mean_velocity(&s, &t, seconds, patch[i], c.uv + 2 * i, expected);
    const double off = distance(expected, velocity + 3 * i);
    made.vertices = off <= made.vertices ? made.vertices : off;
    if (c.uv[2 * i + 1] == 0 || c.uv[2 * i + 1] == 1) made.sides = fmax(made.sides, off);
    n_exact += off <= 1e-13 + 1e-13 / fabs(seconds);
  }
  made.exact = (double)n_exact / (double)(c.n_vertices - n_left_out);
  assert_true(2 * n_left_out < c.n_vertices); /* vertices of grids with split quads are left out */
  const double h = 1e-4;
  const int is_same_valve = memcmp(&now->open, &before->open, sizeof now->open) == 0;
  if (is_same_valve && now->closed.opening >= h && now->closed.opening <= 1 - h) {
    states later = *now, earlier = *now;
    later.closed.opening += h, earlier.closed.opening -= h;
    const smooth a = smooth_of(&later), b = smooth_of(&earlier);
    made.from_derivative = 0;
    for (int64_t i = 0; i < c.n_vertices; ++i) {
      if (patch[i] < 0) continue;
      mean_velocity(&a, &b, later.closed.opening - earlier.closed.opening, patch[i], c.uv + 2 * i, expected);
      made.from_derivative = fmax(made.from_derivative, distance(expected, velocity + 3 * i));
    }
  }
  if (n_points > 0) {
    double *xyz = own(malloc((size_t)n_points * 3 * sizeof *xyz));
    riis_marks *result = new_result();
    riis_mark_options mark = mark_options();
    riis_mark_list fields;
    for (int64_t i = 0; i < n_points; ++i) {
      const double *vertex = c.xyz + 3 * c.vertex_id[random_bits(&rng) % (uint64_t)(3 * c.n_triangles)];
      for (int k = 0; k < 3; ++k) xyz[3 * i + k] = vertex[k] + random_between(&rng, -0.1, 0.1);
    }
    const riis_mesh *mesh = mesh_of(n_points, xyz);
    mark.fields = RIIS_FIELD_UV | RIIS_FIELD_VELOCITY | RIIS_FIELD_PATCH;
    mark.distance_limit = 0.5;
    mark.n_threads = 1;
    CHECK_OK(riis_mark_nodes(surface, mesh, &mark, result));
    CHECK_OK(riis_marks_get_list(result, RIIS_LIST_WITHIN_LIMIT, &fields, sizeof fields));
    assert_int_equal(fields.n_nodes, n_points);
    const double *at_vertices = velocity_of(surface), half_thickness = info_of(surface).half_thickness;
    for (int64_t i = 0; i < n_points; ++i) {
      /* If leaflets are equally near, the velocity is the mean of the leaflets' velocities (test_ties). */
      if (tied_velocity_at(&c, at_vertices, xyz + 3 * i, within_in(result).distance[i], half_thickness).n_leaflets > 1)
        continue;
      mean_velocity(&s, &t, seconds, fields.patch_id[i], fields.uv + 2 * i, expected);
      const double off = distance(expected, fields.velocity + 3 * i);
      made.points = fmax(made.points, off);
      made.sum += off / (double)n_points;
    }
  }
  made.speed = largest_speed(surface);
  free_owned_after(owned_before);
  return made;
}

/* Some quads of the mitral valve are split. A vertex that a split has added has a velocity between those of the quad's
 * corners. */
TEST(vertices_move_as_the_oracles) {
  double share = 0;
  for (int trial = 0; trial < trials_of(40); ++trial) {
    const double opening = random_between(&rng, 0, 1), opening_before = random_between(&rng, 0, 1);
    const double tolerance = pow(10, random_between(&rng, -1.7, -0.5));
    const double seconds = (trial % 2 ? 1 : -1) * pow(10, random_between(&rng, -3, 1));
    const states now = paper_at(opening), before = paper_at(trial % 4 ? opening_before : 1 - opening);
    const compared c = compare(&now, &before, seconds, tolerance, 200);
    const double moved = fabs(now.closed.opening - before.closed.opening) / fabs(seconds);
    share = fmax(share, c.points / (tolerance * moved));
    CHECK_AT_MOST(0.9, c.exact);
    CHECK_AT_MOST(c.vertices, 0.2 * tolerance * moved + 1e-13 / fabs(seconds));
    CHECK_AT_MOST(c.points, 0.4 * tolerance * moved + 1e-13 / fabs(seconds));
  }
  printf("at random points the velocity is off by %.3f of tolerance, per unit of opening, at most\n", share);
}

/* The mean velocity over a step is the velocity at the step's middle. The mean velocity therefore differs from the velocity at
 * the step's end in proportion to the length of the step. */
TEST(the_error_falls_with_the_time_between) {
  double last = 0;
  for (int i = 1; i <= 3; ++i) {
    const double seconds = pow(10, -i);
    const states now = paper_at(0.3), before = paper_at(0.3 - seconds);
    const compared c = compare(&now, &before, seconds, 0.05, 0);
    printf("%g before now: at vertices off by %.3g from the derivative, by %.3g from the mean\n", seconds,
           c.from_derivative, c.vertices);
    CHECK_AT_MOST(c.vertices, 1e-13 / seconds);
    assert_true(c.exact == 1); /* no quad is split */
    assert_true(c.from_derivative > 1e-3 * seconds);
    if (i > 1) assert_true(c.from_derivative < last / 7 && c.from_derivative > last / 13);
    last = c.from_derivative;
  }
}

TEST(the_error_at_any_point_falls_with_the_tolerance) {
  for (int k = 0; k < 3; k += trial_step()) {
    const double opening = k == 0 ? 0.3 : k == 1 ? 0.65 : 1;
    double last_mean = 1, last = 1;
    for (int i = 0; i < 3; ++i) {
      static const double tolerances[] = {0.2, 0.05, 0.01};
      const states now = paper_at(opening), before = paper_at(opening - 0.001);
      const compared c = compare(&now, &before, 0.001, tolerances[i], 2000);
      printf("opening %g, tolerance %g: off by %.3g at random points, %.3g in the mean\n", opening, tolerances[i],
             c.points, c.sum);
      CHECK_AT_MOST(c.sum, 0.5 * last_mean);
      CHECK_AT_MOST(c.points, 0.6 * last);
      last_mean = c.sum, last = c.points;
    }
    CHECK_AT_MOST(last_mean, 5e-4);
  }
}

/* At opening 0 the free edge is one curve of both leaflets. At any other opening each leaflet has a separate free edge. */
TEST(steps_into_and_out_of_the_closed_state) {
  static const double other[] = {1, 0.5, 0.1, 0.01, 0.001};
  for (int i = 0; i < 5; i += is_short_test() ? 4 : 1)
    for (int out_of = 0; out_of < 2; ++out_of) {
      const states now = paper_at(out_of ? other[i] : 0), before = paper_at(out_of ? 0 : other[i]);
      const double seconds = now.closed.opening - before.closed.opening;
      const compared c = compare(&now, &before, seconds, 0.05, 500);
      printf("opening %g from %g: vertices off by %.3g, random points by %.3g, largest speed %.4f\n",
             now.closed.opening, before.closed.opening, c.vertices, c.points, c.speed);
      CHECK_AT_MOST(0.9, c.exact);
      CHECK_AT_MOST(c.vertices, 0.006);
      CHECK_AT_MOST(c.points, 0.02);
      CHECK_AT_MOST(c.speed, 2.6);
    }
}

/* If a vertex jumped on its patch between steps, its speed would be the jump divided by the length of the step. */
TEST(no_vertex_is_an_outlier) {
  const states at = paper_at(0);
  riis_valve *valve = valve_of(&at), *before = valve_of(&at);
  riis_surface_options options = surface_options();
  options.n_threads = 1;
  riis_surface *surface = new_surface(valve, &options);
  double largest = 0;
  for (int i = 1; i <= 1000; i += trial_step()) {
    CHECK_OK(riis_valve_set_scalar(before, "opening", 0.001 * (i - 1)));
    CHECK_OK(riis_valve_set_scalar(valve, "opening", fmin(1, 0.001 * i)));
    CHECK_OK(riis_surface_update_moving(surface, valve, before, 0.001, NULL, NULL));
    largest = fmax(largest, largest_speed(surface));
  }
  printf("largest speed in 1000 steps: %.6f per unit of opening\n", largest);
  CHECK_AT_MOST(largest, 1.02 * 2.581);
  CHECK_AT_MOST(0.98 * 2.581, largest);
}

/* A patch without a bulge is a Coons patch with the same labels. Arcs that are nearly straight have few triangles, and the
 * velocity is linear between vertices. A change of the bulge is therefore visible only on bent arcs. */
TEST(a_bulge_goes_through_zero) {
  static const struct {
    double now, before;
    int is_straight;
  } steps[] = {{0.5, 0.4, 1},  {0.5, 0.5 + 1e-3, 1}, {0.5 - 1e-3, 0.5, 1}, {0.5 + 1e-6, 0.5 - 1e-6, 1}, {0.7, 0.5, 0},
               {0.25, 0.5, 0}, {0.75, 0.25, 0},      {0.3, 0.8, 0},        {0.2, 0.2 - 1e-4, 0}};
  for (size_t i = 0; i < sizeof steps / sizeof *steps; ++i) {
    states now = paper_at(steps[i].now), before;
    now.closed.surface_angle = 25, now.open.surface_angle = -25;
    before = now;
    before.closed.opening = steps[i].before;
    const double seconds = now.closed.opening - before.closed.opening;
    const compared c = compare(&now, &before, seconds, 0.05, 500);
    printf("opening %g from %g: sides off by %.3g, vertices by %.3g, random points by %.3g, largest speed %.4f\n",
           steps[i].now, steps[i].before, c.sides, c.vertices, c.points, c.speed);
    CHECK_AT_MOST(c.sides, 0.01);
    CHECK_AT_MOST(c.speed, 2.6);
    if (steps[i].is_straight) continue;
    CHECK_AT_MOST(0.9, c.exact);
    CHECK_AT_MOST(c.vertices, 0.01);
    CHECK_AT_MOST(c.points, 0.05);
  }
  for (int i = 0; i < 2; ++i) { /* no bulge in both states; then from no bulge to one */
    states now = paper_at(0.7), before = paper_at(0.65);
    if (i == 0) now.closed.surface_angle = now.open.surface_angle = 0;
    before.closed.surface_angle = before.open.surface_angle = 0;
    const compared c = compare(&now, &before, 0.05, 0.05, 500);
    printf("%s: sides off by %.3g, vertices by %.3g, random points by %.3g, largest speed %.4f\n",
           i == 0 ? "no bulge" : "from no bulge", c.sides, c.vertices, c.points, c.speed);
    CHECK_AT_MOST(0.9, c.exact);
    CHECK_AT_MOST(c.sides, 0.01 * c.speed);
    CHECK_AT_MOST(c.vertices, 0.01 * c.speed);
  }
}

TEST(any_parameter_moves) {
  double share = 0;
  for (int i = 0; i <= n_scalars + 1; ++i) {
    if (i < n_scalars && i % trial_step()) continue;
    states now = paper_at(random_between(&rng, 0.05, 0.95)), before;
    before = now;
    if (i == n_scalars) before.closed.translation[random_bits(&rng) % 3] += 0.1;
    for (int k = 0; k < n_scalars; ++k) { /* changes one parameter, or all parameters in the last round */
      if (i != k && i != n_scalars + 1) continue;
      *scalar_of(&before.closed, k) *= random_between(&rng, 0.95, 0.99);
      *scalar_of(&before.open, k) *= random_between(&rng, 0.95, 0.99);
    }
    const compared c = compare(&now, &before, 0.01, 0.05, 300);
    const char *name = i < n_scalars ? scalars[i].name : i == n_scalars ? "translation" : "all";
    printf("%s: largest speed %.3f, vertices off by %.2g, random points by %.2g, exact %.2f\n", name, c.speed,
           c.vertices, c.points, c.exact);
    assert_true(c.speed > 1e-3);
    share = fmax(share, c.points / c.speed);
    CHECK_AT_MOST(0.9, c.exact);
    CHECK_AT_MOST(c.vertices, 0.05 * c.speed + 1e-11);
    CHECK_AT_MOST(c.points, 0.1 * c.speed + 1e-11);
  }
  printf("off by %.4f of the largest speed at most\n", share);
}

int main(void) {
  rng = random_start("test_mitral_motion");
  return run_cases(NULL, NULL);
}
