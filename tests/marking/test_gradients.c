/* SPDX-License-Identifier: Apache-2.0
 * Tests derivatives of distances and of K. The derivatives are compared with central differences of distances to surfaces with
 * equal triangles. At rims and ties the derivatives are compared with closed forms. */
#include <riis/riis.h>

#include "test_support.h"

#include "handles.h"
#include "sanitized.h"
#include "shapes.h"

static random_source rng;

static double between(double low, double high) { return random_between(&rng, low, high); }
static int one_in(int n) { return (int)(random_bits(&rng) % (uint64_t)n) == 0; }
static double dot3(const double *a, const double *b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

static const char *const kinds[] = {"aortic", "trileaflet", "mitral", "bileaflet", "coapting", "patches"};
enum { n_kinds = 6, n_points = 1500, max_directions = 6 };

/* --- Random valves and directions ------------------------------------------------------------------------------------ */

/* A valve and its placement in one state. */
typedef struct placed_valve {
  riis_valve *valve;
  riis_surface_options options;
} placed_valve;

static placed_valve copy_of(const placed_valve *from) {
  placed_valve made = {NULL, from->options};
  CHECK_OK(riis_valve_copy(from->valve, &made.valve));
  own(made.valve);
  return made;
}

/* A direction changes one number: the value of a parameter, a number of the placement, or a landmark of a warp. */
typedef enum { of_parameter, of_translation, of_angle, of_scale, of_landmark } sort_of_change;
typedef struct change {
  sort_of_change sort;
  char name[64];
  int component;
  double size; /* a change of medium size */
} change;

/* The landmarks of the warp are the corners of a box round the valve. */
enum { n_corners = 8 };
static const double no_shifts[3 * n_corners];

static void warp_valve(riis_valve *valve, const double *shifts) {
  double from[3 * n_corners], to[3 * n_corners];
  for (int i = 0; i < n_corners; ++i)
    for (int x = 0; x < 3; ++x) from[3 * i + x] = ((i >> x & 1) ? 2.0 : -2.0) + 0.1 * ((i * 7 + x * 3) % 5);
  for (int i = 0; i < 3 * n_corners; ++i) to[i] = from[i] + shifts[i];
  riis_points points;
  riis_warp *warp = NULL;
  CHECK_OK(riis_points_init(&points, sizeof points));
  points.n_points = n_corners, points.stride = 3;
  points.x = from, points.y = from + 1, points.z = from + 2;
  CHECK_OK(riis_warp_create(&points, NULL, &warp));
  points.x = to, points.y = to + 1, points.z = to + 2;
  CHECK_OK(riis_warp_set_targets(warp, &points));
  CHECK_OK(riis_valve_set_warp(valve, warp, NULL));
  riis_warp_destroy(&warp);
}

/* Moves a state in a direction by `by`. Returns whether the valve accepted the value. */
static int apply(const change *c, const double *shifts, double by, placed_valve *to) {
  if (c->sort == of_translation) to->options.translation[c->component] += by;
  if (c->sort == of_angle) to->options.rotation_angle += by;
  if (c->sort == of_scale) to->options.scale += by;
  if (c->sort == of_landmark) {
    double moved[3 * n_corners];
    memcpy(moved, shifts, sizeof moved);
    moved[c->component] += by;
    warp_valve(to->valve, moved);
  }
  if (c->sort != of_parameter) return 1;
  double values[3] = {0, 0, 0};
  const int64_t n = c->component < 0 ? 1 : 3;
  CHECK_OK(riis_valve_get(to->valve, c->name, n, values));
  values[c->component < 0 ? 0 : c->component] += by;
  return riis_valve_set(to->valve, c->name, n, values) == RIIS_OK;
}

static change random_parameter(const riis_valve *valve) {
  int64_t n;
  CHECK_OK(riis_valve_get_n_parameters(valve, &n));
  riis_parameter parameter;
  CHECK_OK(riis_valve_get_parameter(valve, (int64_t)(random_bits(&rng) % (uint64_t)n), &parameter, sizeof parameter));
  change made = {of_parameter, "", parameter.n_values == 3 ? (int)(random_bits(&rng) % 3) : -1, 1};
  snprintf(made.name, sizeof made.name, "%s", parameter.name);
  if (strcmp(parameter.unit, "degree") == 0) made.size = 20;
  return made;
}

/* A valve of one bent patch that opens to another patch. Apart from the skirt's length, the valve's only parameter is
 * "opening". */
static riis_valve *bent_patches(void) {
  shape closed = unit_square(), open;
  for (int i = 0; i < 4; ++i) {
    closed.degree[i] = 2;
    memcpy(closed.control[i][2], closed.control[i][1], sizeof closed.control[i][1]);
    for (int x = 0; x < 3; ++x)
      closed.control[i][1][x] = 0.5 * (closed.control[i][0][x] + closed.control[i][2][x]) + between(-0.3, 0.3);
  }
  open = closed;
  for (int i = 0; i < 4; ++i)
    for (int x = 0; x < 3; ++x) open.control[i][1][x] += between(-0.3, 0.3);
  riis_valve *valve = valve_from(&closed), *other = valve_from(&open);
  CHECK_OK(riis_valve_set_open_state(valve, other));
  free_one_owned(other);
  return valve;
}

/* Makes a valve with about every third parameter changed by up to 4 %. Values that are invalid together are drawn again. */
static placed_valve random_valve(int kind, int fixed, double *shifts) {
  for (;;) {
    placed_valve made = {kind == 5 ? bent_patches() : new_valve(kinds[kind]), surface_options()};
    int64_t n;
    CHECK_OK(riis_valve_get_n_parameters(made.valve, &n));
    for (int64_t i = 0; i < n; ++i) {
      riis_parameter parameter;
      double values[3];
      CHECK_OK(riis_valve_get_parameter(made.valve, i, &parameter, sizeof parameter));
      if (!one_in(3) || strcmp(parameter.name, "opening") == 0 || strcmp(parameter.name, "skirt_length") == 0) continue;
      CHECK_OK(riis_valve_get(made.valve, parameter.name, parameter.n_values, values));
      for (int64_t k = 0; k < parameter.n_values; ++k) values[k] *= between(0.96, 1.04);
      riis_valve_set(made.valve, parameter.name, parameter.n_values, values);
    }
    /* A quarter of the valves are closed, so that their leaflets touch. At 0 the opening has no central difference, so no
       direction changes it there. */
    CHECK_OK(riis_valve_set_scalar(made.valve, "opening", one_in(4) ? 0 : between(0.03, 0.97)));
    if (kind != 3 && kind != 5 && one_in(3)) CHECK_OK(riis_valve_set_scalar(made.valve, "skirt_length", 0.3));
    memcpy(shifts, no_shifts, sizeof no_shifts);
    if (kind != 3 && one_in(3)) {
      for (int i = 0; i < 3 * n_corners; ++i) shifts[i] = between(-0.1, 0.1);
      warp_valve(made.valve, shifts);
    } else {
      shifts[0] = NAN; /* no warp */
    }
    made.options.triangulation = fixed ? RIIS_TRIANGULATION_FIXED : RIIS_TRIANGULATION_ADAPTED;
    made.options.tolerance = random_power_of_ten(&rng, is_long_test() ? -2 : -1.5, -1);
    made.options.scale = random_power_of_ten(&rng, -2, 1);
    made.options.rotation_angle = between(-180, 180);
    for (int x = 0; x < 3; ++x) {
      made.options.rotation_axis[x] = between(-1, 1);
      made.options.translation[x] = made.options.scale * between(-10, 10);
    }
    made.options.flip_normals = one_in(2);
    riis_surface *surface = NULL;
    if (riis_surface_create(made.valve, &made.options, &surface) == RIIS_OK) {
      riis_surface_destroy(&surface);
      return made;
    }
  }
}

/* --- Central differences on the same triangles ----------------------------------------------------------------------- */

/* Returns whether both surfaces have equal triangles, and vertices at nearly equal u and v. */
static int is_same_triangulation(const riis_surface *a, const riis_surface *b) {
  const riis_triangles s = triangles_of(a), t = triangles_of(b);
  if (s.n_vertices != t.n_vertices || s.n_triangles != t.n_triangles) return 0;
  if (memcmp(s.vertex_id, t.vertex_id, 3 * (size_t)s.n_triangles * sizeof *s.vertex_id) != 0) return 0;
  for (int64_t i = 0; i < 2 * s.n_vertices; ++i)
    if (fabs(s.uv[i] - t.uv[i]) > 1e-3) return 0;
  return 1;
}

static void find_distances(const riis_surface *surface, int64_t n, const double *xyz, double *distance) {
  riis_points points;
  riis_closest_arrays arrays;
  CHECK_OK(riis_points_init(&points, sizeof points));
  CHECK_OK(riis_closest_arrays_init(&arrays, sizeof arrays));
  points.n_points = n, points.stride = 3;
  points.x = xyz, points.y = xyz + 1, points.z = xyz + 2;
  arrays.distance = distance;
  CHECK_OK(riis_closest_points(surface, &points, NULL, &arrays));
}

/* Makes the surface of a state. With the fixed triangulation, a change of the opening or of the placement keeps the triangles of
 * `like`. The function then updates `like`. Returns NULL if the values are invalid together. */
static riis_surface *surface_in(const placed_valve *state) {
  riis_surface *surface = NULL;
  return riis_surface_create(state->valve, &state->options, &surface) == RIIS_OK ? own(surface) : NULL;
}

/* The differences of a point's distance over a step forwards and over a step backwards. */
typedef struct slopes {
  double left, right, middle;
} slopes;
static slopes slopes_of(double before, double now, double after, double step) {
  return (slopes){(now - before) / step, (after - now) / step, (after - before) / (2 * step)};
}

/* Tells whether a derivative is right although it differs from the central difference. The two differ near a tie, where the
 * closest point jumps from one place of the surface to another within the step. The slope then falls at a kink, and the central
 * difference is off by up to half the kink. The derivative must be the slope on the side without the tie. */
static int is_beside_tie(slopes s, double gradient, double speed) {
  return s.right < s.left && fmin(fabs(gradient - s.left), fabs(gradient - s.right)) <= 1e-5 * speed;
}

typedef struct tally {
  int64_t n, n_off, n_ties, n_skipped, n_directions, n_vertices, n_off_vertices;
  double worst, worst_vertex, worst_area;
} tally;

static const double *rates_of(const riis_surface *surface, int64_t direction_id) {
  riis_direction direction;
  CHECK_OK(riis_surface_get_direction(surface, direction_id, &direction, sizeof direction));
  assert_int_equal(direction.n_vertices, triangles_of(surface).n_vertices);
  return direction.rate;
}

static double area_rate_of(const riis_surface *surface, int64_t direction_id) {
  riis_direction direction;
  CHECK_OK(riis_surface_get_direction(surface, direction_id, &direction, sizeof direction));
  return direction.area_rate;
}

/* Computes the derivative of a surface's area if its vertices move at these rates. Each corner contributes its rate times the
 * derivative of the area by the corner. */
static double rate_of_area(const riis_surface *surface, const double *rate) {
  const riis_triangles c = triangles_of(surface);
  double sum = 0;
  for (int64_t i = 0; i < c.n_triangles; ++i) {
    const int64_t *const id = c.vertex_id + 3 * i;
    const double *const corner[3] = {c.xyz + 3 * id[0], c.xyz + 3 * id[1], c.xyz + 3 * id[2]};
    for (int k = 0; k < 3; ++k) {
      /* If a corner moves away from the opposite edge by 1, the area grows by half of this edge's length. */
      double edge[3], towards[3], height[3];
      for (int x = 0; x < 3; ++x) edge[x] = corner[(k + 2) % 3][x] - corner[(k + 1) % 3][x];
      for (int x = 0; x < 3; ++x) towards[x] = corner[k][x] - corner[(k + 1) % 3][x];
      const double along = dot3(towards, edge) / dot3(edge, edge);
      for (int x = 0; x < 3; ++x) height[x] = towards[x] - along * edge[x];
      sum += 0.5 * sqrt(dot3(edge, edge) / dot3(height, height)) * dot3(height, rate + 3 * id[k]);
    }
  }
  return sum;
}

/* Makes points near random triangles, up to `reach` away. */
static void make_points(const riis_surface *surface, double reach, double *xyz) {
  const riis_triangles c = triangles_of(surface);
  for (int i = 0; i < n_points; ++i) {
    const int64_t *corner = c.vertex_id + 3 * (int64_t)(random_bits(&rng) % (uint64_t)c.n_triangles);
    double w[3] = {between(0, 1), between(0, 1), between(0, 1)};
    const double sum = w[0] + w[1] + w[2];
    for (int x = 0; x < 3; ++x) {
      xyz[3 * i + x] = reach * between(-1, 1);
      for (int k = 0; k < 3; ++k) xyz[3 * i + x] += w[k] / sum * c.xyz[3 * corner[k] + x];
    }
  }
}

/* Compares one direction with central differences. `gradient` and `K_gradient` have one number for each point. */
static void compare(const riis_surface *at, const placed_valve *state, const change *c, const double *shifts,
                    const double *xyz, const double *gradient, int64_t direction_id, const double *K,
                    const double *K_gradient, double R, tally *t) {
  const double *const rate = rates_of(at, direction_id);
  static double now[n_points], distance[2][n_points];
  const double step = 1e-6 * c->size, eps = info_of(at).half_thickness;
  const int owned_before = n_owned();
  double speed = 0;
  int is_same = 1;
  find_distances(at, n_points, xyz, now);
  riis_surface *surfaces[2] = {NULL, NULL};
  for (int i = 0; i < 2 && is_same; ++i) {
    placed_valve moved = copy_of(state);
    if (!apply(c, shifts, i ? step : -step, &moved)) is_same = 0;
    /* A surface keeps its fixed triangles if only the opening and the placement change. */
    const int keeps = state->options.triangulation == RIIS_TRIANGULATION_FIXED &&
                      (c->sort != of_parameter || strcmp(c->name, "opening") == 0);
    riis_surface *surface = is_same ? surface_in(keeps ? state : &moved) : NULL;
    if (surface && keeps && riis_surface_update(surface, moved.valve, &moved.options) != RIIS_OK) surface = NULL;
    is_same = surface && is_same_triangulation(at, surface);
    surfaces[i] = surface;
    if (is_same) find_distances(surface, n_points, xyz, distance[i]);
  }
  ++t->n_directions;
  if (!is_same) {
    ++t->n_skipped;
    free_owned_after(owned_before);
    return;
  }
  const riis_triangles low = triangles_of(surfaces[0]), high = triangles_of(surfaces[1]);
  for (int64_t i = 0; i < low.n_vertices; ++i) {
    double v[3];
    for (int x = 0; x < 3; ++x) v[x] = (high.xyz[3 * i + x] - low.xyz[3 * i + x]) / (2 * step);
    speed = fmax(speed, sqrt(dot3(v, v)));
  }
  for (int64_t i = 0; i < low.n_vertices; ++i) {
    double off[3];
    for (int x = 0; x < 3; ++x) off[x] = rate[3 * i + x] - (high.xyz[3 * i + x] - low.xyz[3 * i + x]) / (2 * step);
    const double relative = sqrt(dot3(off, off)) / fmax(speed, 1e-300);
    ++t->n_vertices, t->n_off_vertices += !(relative <= 1e-5);
    t->worst_vertex = fmax(t->worst_vertex, relative);
  }
  /* The area's rate of change is about the square root of the area times the speed. */
  const double area = info_of(at).area;
  const double slope_of_area = (info_of(surfaces[1]).area - info_of(surfaces[0]).area) / (2 * step);
  const double growth = area_rate_of(at, direction_id), size = fmax(sqrt(area) * speed, 1e-8 * area / step);
  CHECK_NEAR(growth, rate_of_area(at, rate), 1e-8 * size);
  t->worst_area = fmax(t->worst_area, fabs(growth - slope_of_area) / size);
  for (int i = 0; i < n_points; ++i) {
    if (!(now[i] > 0.05 * eps)) continue;
    const slopes s = slopes_of(distance[0][i], now[i], distance[1][i], step);
    const double off = fabs(gradient[i] - s.middle) / fmax(speed, 1e-300);
    if (off > 1e-5 && is_beside_tie(s, gradient[i], speed)) {
      ++t->n_ties;
      continue;
    }
    ++t->n, t->n_off += !(off <= 1e-5);
    t->worst = fmax(t->worst, off);
    /* K follows from the distance alone. */
    const double a = acos(-1) * now[i] / eps;
    const double K_now = now[i] < eps ? R / eps * (1 + cos(a)) / (2 * eps) : 0;
    const double K_slope = now[i] < eps ? -R / eps * acos(-1) / (2 * eps * eps) * sin(a) : 0;
    CHECK_NEAR(K[i], K_now, 1e-9 * R / eps / eps);
    CHECK_NEAR(K_gradient[i], K_slope * gradient[i], 1e-9 * R / eps / eps / eps * speed);
  }
  free_owned_after(owned_before);
}

TEST(derivatives_are_central_differences) {
  static double xyz[3 * n_points], gradient[n_points], K_gradient[n_points];
  const int n_trials = is_long_test() ? 20 : 1;
  /* A short test has few valves, so a larger share of its points may be at kinks. */
  const double most_off = is_long_test() ? 0.01 : 0.05;
  for (int kind = 0; kind < n_kinds; ++kind)
    for (int fixed = 0; fixed < 2; ++fixed) {
      if (is_short_test() && fixed != kind % 2) continue;
      tally t = {0, 0, 0, 0, 0, 0, 0, 0, 0, 0};
      for (int trial = 0; trial < n_trials; ++trial) {
        const int owned_before = n_owned();
        double shifts[3 * n_corners];
        const placed_valve state = random_valve(kind, fixed, shifts);
        const double scale = state.options.scale, R = random_power_of_ten(&rng, 0, 4);
        const change turn = {of_angle, "", 0, 20}, growth = {of_scale, "", 0, scale};
        const change turn_or_growth = one_in(2) ? turn : growth;
        const change choices[max_directions] = {{of_parameter, "opening", -1, 1},
                                                random_parameter(state.valve),
                                                random_parameter(state.valve),
                                                {of_translation, "", (int)(random_bits(&rng) % 3), scale},
                                                turn_or_growth,
                                                {of_landmark, "", (int)(random_bits(&rng) % (3 * n_corners)), 1}};
        change directions[max_directions];
        int n = 0;
        riis_surface *surface = new_surface(state.valve, &state.options);
        for (int i = 0; i < max_directions; ++i) {
          const change *c = choices + i;
          if (c->sort == of_landmark && isnan(shifts[0])) continue;
          placed_valve after = copy_of(&state), before = copy_of(&state);
          const double half = 1e-5 * c->size; /* below most kinks that a curve's polyline makes at its vertices */
          double skirt = 1;
          if (strcmp(c->name, "skirt_length") == 0) CHECK_OK(riis_valve_get(state.valve, c->name, 1, &skirt));
          if (skirt == 0 || !apply(c, shifts, half, &after) || !apply(c, shifts, -half, &before)) continue;
          const riis_status status =
              riis_surface_add_direction(surface, after.valve, before.valve, 2 * half, &after.options, &before.options);
          if (status == RIIS_INVALID_PARAMETER) continue; /* values that barely fit together */
          CHECK_OK(status);
          directions[n++] = *c;
        }
        const double eps = info_of(surface).half_thickness;
        make_points(surface, 1.5 * eps, xyz);
        riis_marks *marks = NULL;
        CHECK_OK(riis_marks_create(&marks));
        own(marks);
        riis_resistance resistance;
        CHECK_OK(riis_resistance_init(&resistance, sizeof resistance));
        resistance.R = R;
        riis_mark_options options = mark_options();
        options.distance_limit = 10 * eps;
        options.fields = RIIS_FIELD_GRADIENT;
        options.resistance = &resistance;
        CHECK_OK(riis_mark_nodes(surface, mesh_of(n_points, xyz), &options, marks));
        const riis_mark_list list = within_list(marks);
        assert_int_equal(list.n_nodes, n_points);
        assert_int_equal(list.n_directions, n);
        for (int d = 0; d < n; ++d) {
          for (int i = 0; i < n_points; ++i)
            gradient[i] = list.distance_gradient[n * i + d], K_gradient[i] = list.K_gradient[n * i + d];
          compare(surface, &state, directions + d, shifts, xyz, gradient, d, list.K, K_gradient, R, &t);
        }
        free_owned_after(owned_before);
      }
      printf(
          "%s, triangulation %d: %lld derivatives, %.3f %% off by more than 1e-5, at most %.2g; %lld ties; %lld of "
          "%lld directions changed triangles\n",
          kinds[kind], fixed, (long long)t.n, 100. * (double)t.n_off / (double)(t.n ? t.n : 1), t.worst,
          (long long)t.n_ties, (long long)t.n_skipped, (long long)t.n_directions);
      printf("%s, triangulation %d: %lld rates of vertices, %.3f %% off by more than 1e-5, at most %.2g; area %.2g\n",
             kinds[kind], fixed, (long long)t.n_vertices, 100. * (double)t.n_off_vertices / (double)t.n_vertices,
             t.worst_vertex, t.worst_area);
      assert_true(t.n > 0);
      if ((double)t.n_off > most_off * (double)t.n) fail_msg("%lld of %lld", (long long)t.n_off, (long long)t.n);
      assert_true(t.n_vertices > 0);
      if ((double)t.n_off_vertices > most_off * (double)t.n_vertices)
        fail_msg("%lld of %lld vertices", (long long)t.n_off_vertices, (long long)t.n_vertices);
      CHECK_AT_MOST(t.worst_area, 1e-5);
    }
}

/* --- The smooth valve, and velocities -------------------------------------------------------------------------------- */

static int compare_reals(const void *a, const void *b) {
  const double x = *(const double *)a, y = *(const double *)b;
  return (x > y) - (x < y);
}

typedef struct spread {
  double median, percentile99, most, above; /* `above` is the share of differences above 1e-5 */
} spread;

static spread spread_of(int n, double *values) {
  assert_true(n > 100);
  qsort(values, (size_t)n, sizeof *values, compare_reals);
  int n_above = 0;
  for (int i = 0; i < n; ++i) n_above += values[i] > 1e-5;
  return (spread){values[n / 2], values[n - 1 - n / 100], values[n - 1], (double)n_above / n};
}

/* Marks the points, with their derivatives in the direction of the opening and their velocities. */
static riis_mark_list opening_of(const char *kind, double tolerance, int32_t triangulation, double opening, double *xyz,
                                 double *speed, riis_surface **at) {
  riis_valve *valve = new_valve(kind), *after = new_valve(kind), *before = new_valve(kind);
  riis_surface_options options = surface_options();
  options.tolerance = tolerance, options.triangulation = triangulation;
  CHECK_OK(riis_valve_set_scalar(valve, "opening", opening));
  CHECK_OK(riis_valve_set_scalar(after, "opening", opening + 1e-4));
  CHECK_OK(riis_valve_set_scalar(before, "opening", opening - 1e-4));
  *at = new_surface(valve, &options);
  CHECK_OK(riis_surface_update_moving(*at, valve, before, 1e-4, NULL, NULL));
  CHECK_OK(riis_surface_add_direction(*at, after, before, 2e-4, NULL, NULL));
  if (isnan(*xyz)) make_points(*at, 0.1, xyz);
  *speed = 0;
  const double *velocity = velocity_of(*at);
  for (int64_t i = 0; i < triangles_of(*at).n_vertices; ++i)
    *speed = fmax(*speed, sqrt(dot3(velocity + 3 * i, velocity + 3 * i)));
  riis_marks *marks = NULL;
  CHECK_OK(riis_marks_create(&marks));
  own(marks);
  riis_mark_options mark = mark_options();
  mark.distance_limit = 1;
  mark.fields = RIIS_FIELD_GRADIENT | RIIS_FIELD_VELOCITY | RIIS_FIELD_POINT;
  CHECK_OK(riis_mark_nodes(*at, mesh_of(n_points, xyz), &mark, marks));
  return within_list(marks);
}

/* Prints the table that docs/theory/gradients.md summarises. "Smooth" compares with central differences of distances to triangles
 * with the tolerance 0.0005. "Velocity" and "direction" compare with central differences on the fixed triangles. */
TEST(derivatives_approach_those_of_the_smooth_valve) {
  static double xyz[3 * n_points], distance[3][n_points], off[3][n_points];
  static const double tolerances[] = {0.05, 0.01, 0.003};
  const double fine = is_long_test() ? 0.0005 : 0.002;
  rng = random_start("the smooth valve"); /* so that the table does not depend on the test before it */
  for (int kind = 0; kind < (is_long_test() ? 5 : 1); ++kind)
    for (int i = 0; i < (is_long_test() ? 3 : 1); ++i) {
      const int owned_before = n_owned();
      const double opening = 0.6, h = 1e-4, eps = 0.1;
      double speed = 0;
      riis_surface *at = NULL;
      xyz[0] = NAN;
      const riis_mark_list list =
          opening_of(kinds[kind], tolerances[i], RIIS_TRIANGULATION_FIXED, opening, xyz, &speed, &at);
      riis_valve *valve = new_valve(kinds[kind]);
      riis_surface_options options = surface_options();
      int n = 0, n_ties = 0;
      for (int is_smooth = 0; is_smooth < 2; ++is_smooth) {
        const double step = is_smooth ? h : 1e-6;
        options.tolerance = is_smooth ? fine : tolerances[i];
        options.triangulation = is_smooth ? RIIS_TRIANGULATION_ADAPTED : RIIS_TRIANGULATION_FIXED;
        riis_surface *surface = NULL;
        for (int k = 0; k < 3; ++k) {
          CHECK_OK(riis_valve_set_scalar(valve, "opening", opening + (k - 1) * step));
          if (surface)
            CHECK_OK(riis_surface_update(surface, valve, NULL));
          else
            surface = new_surface(valve, &options);
          find_distances(surface, n_points, xyz, distance[k]);
        }
        n = 0;
        for (int p = 0; p < n_points; ++p) {
          const slopes s = slopes_of(distance[0][p], distance[1][p], distance[2][p], step);
          const double slope = s.middle, d = list.distance[p],
                       off_slope = fabs(list.distance_gradient[p] - slope) / speed;
          if (!(d > 0.05 * eps)) continue;
          if (is_smooth ? fabs(s.right - s.left) > 0.1 * speed
                        : off_slope > 1e-5 && is_beside_tie(s, list.distance_gradient[p], speed)) {
            n_ties += !is_smooth;
            continue;
          }
          double away[3];
          for (int x = 0; x < 3; ++x) away[x] = (xyz[3 * p + x] - list.point[3 * p + x]) / d;
          off[0][n] = off_slope;
          off[1][n] = fabs(-dot3(away, list.velocity + 3 * p) - slope) / speed;
          ++n;
        }
        const spread of_direction = spread_of(n, off[0]), of_velocity = spread_of(n, off[1]);
        if (is_smooth) {
          printf("%s, tolerance %g, smooth: median %.2f %%, 99 %% within %.1f %%\n", kinds[kind], tolerances[i],
                 100 * of_direction.median, 100 * of_direction.percentile99);
          CHECK_AT_MOST(of_direction.median, 0.05);
        } else {
          printf(
              "%s, tolerance %g, direction: median %.1g, most %.1g, %.2f %% above 1e-5; velocity: median %.1g, most "
              "%.1g, %.0f %% above 1e-5; %d ties\n",
              kinds[kind], tolerances[i], of_direction.median, of_direction.most, 100 * of_direction.above,
              of_velocity.median, of_velocity.most, 100 * of_velocity.above, n_ties);
          CHECK_AT_MOST(of_direction.above, 0.01);
        }
      }
      free_owned_after(owned_before);
    }
}

/* --- Closed forms at rims, on the surface and at ties ---------------------------------------------------------------- */

static riis_mark_list gradients_of(const riis_surface *surface, int64_t n, const double *xyz,
                                   const riis_resistance *resistance) {
  riis_marks *marks = NULL;
  CHECK_OK(riis_marks_create(&marks));
  own(marks);
  riis_mark_options options = mark_options();
  options.distance_limit = 10;
  options.fields = RIIS_FIELD_GRADIENT | RIIS_FIELD_RIM;
  options.resistance = resistance;
  CHECK_OK(riis_mark_nodes(surface, mesh_of(n, xyz), &options, marks));
  assert_int_equal(within_list(marks).n_nodes, n);
  return within_list(marks);
}

/* A square shifts by (1, 2, 3). */
TEST(rims_and_the_surface_itself) {
  const shape square = unit_square();
  riis_valve *valve = valve_from(&square);
  riis_surface_options options = surface_options(), after, before;
  riis_surface *surface = new_surface(valve, &options);
  after = before = options;
  for (int x = 0; x < 3; ++x) after.translation[x] = 0.01 * (x + 1), before.translation[x] = -after.translation[x];
  CHECK_OK(riis_surface_add_direction(surface, valve, valve, 0.02, &after, &before));
  const double xyz[] = {0.3, 0.6, 0.02, 0.3, 0.6, -0.02, 1.03, 0.5, 0.04, -0.03, -0.04, 0, 0.25, 0.5, 0, 0.5, 0.5, 1};
  riis_resistance resistance;
  CHECK_OK(riis_resistance_init(&resistance, sizeof resistance));
  resistance.R = 2;
  for (int cut = 0; cut < 2; ++cut) {
    resistance.rim = cut ? RIIS_RIM_CUT : RIIS_RIM_ROUND;
    const riis_mark_list list = gradients_of(surface, 6, xyz, &resistance);
    assert_int_equal(list.n_directions, 1);
    static const double expected[] = {-3, 3, -(0.6 * 1 + 0.8 * 3), 0.6 * 1 + 0.8 * 2, 0, -3};
    for (int i = 0; i < 6; ++i) {
      CHECK_NEAR(list.distance_gradient[i], expected[i], 1e-12);
      const double d = list.distance[i], eps = 0.1;
      const double slope =
          d < eps && !(cut && list.rim[i]) ? -2 / eps * acos(-1) / (2 * eps * eps) * sin(acos(-1) * d / eps) : 0;
      CHECK_NEAR(list.K_gradient[i], slope * list.distance_gradient[i], 1e-8);
      assert_int_equal(list.rim[i], i == 2 || i == 3);
    }
  }
}

/* K is flat at both ends of the band. Near an end of the band, the derivative of K is proportional to the distance from the end,
 * and keeps its digits. The square shifts by (1, 2, 3), so the distance of a node above the square falls by 3. */
TEST(K_is_derived_from_the_distance_up_to_both_ends) {
  enum { n_powers = 15, n = 2 * n_powers };
  const double R = random_power_of_ten(&rng, -20, 20), eps = 0.1;
  const shape square = unit_square();
  riis_valve *valve = valve_from(&square);
  riis_surface_options after = surface_options(), before = after;
  riis_surface *surface = new_surface(valve, NULL);
  for (int x = 0; x < 3; ++x) after.translation[x] = 0.01 * (x + 1), before.translation[x] = -after.translation[x];
  CHECK_OK(riis_surface_add_direction(surface, valve, valve, 0.02, &after, &before));
  double xyz[3 * n];
  for (int i = 0; i < n; ++i) {
    const double near = eps * pow(10, -i / 2 - 1); /* the distance from one end of the band */
    xyz[3 * i] = between(0.3, 0.4), xyz[3 * i + 1] = between(0.6, 0.7), xyz[3 * i + 2] = i % 2 ? eps - near : near;
  }
  riis_resistance resistance;
  CHECK_OK(riis_resistance_init(&resistance, sizeof resistance));
  resistance.R = R;
  const riis_mark_list list = gradients_of(surface, n, xyz, &resistance);
  for (int i = 0; i < n; ++i) {
    const double d = list.distance[i], sine = sin(acos(-1) * ((d < eps / 2 ? d : eps - d) / eps));
    const double expected = -R * acos(-1) / (2 * eps * eps * eps) * sine * list.distance_gradient[i];
    if (d > 1e-12) CHECK_NEAR(list.distance_gradient[i], -3, 1e-3);
    CHECK_NEAR(list.K_gradient[i], expected, 1e-12 * fabs(expected));
  }
}

/* Two squares, at z = 0 and z = 1. Only the upper square moves. A node at equal distances gets the derivative of the lower
 * square, which triangle_id names. The distance of this node has a kink, with the derivatives 0 and -1 on the two sides. */
TEST(ties_take_the_first_triangle) {
  shape two = unit_square();
  add_line(&two, 0, 0, 1, 1, 0, 1);
  add_line(&two, 0, 1, 1, 1, 1, 1);
  add_line(&two, 0, 0, 1, 0, 1, 1);
  add_line(&two, 1, 0, 1, 1, 1, 1);
  add_patch(&two, 4, 5, 6, 7);
  two.leaflet_id[1] = 1;
  shape up = two, down = two;
  for (int i = 4; i < 8; ++i)
    for (int k = 0; k < 2; ++k) up.control[i][k][2] += 1e-3, down.control[i][k][2] -= 1e-3;
  riis_valve *valve = valve_from(&two), *after = valve_from(&up), *before = valve_from(&down);
  riis_surface *surface = new_surface(valve, NULL);
  CHECK_OK(riis_surface_add_direction(surface, after, before, 2e-3, NULL, NULL));
  const double xyz[] = {0.3, 0.4, 0.5 - 1e-6, 0.3, 0.4, 0.5, 0.3, 0.4, 0.5 + 1e-6, 0.3, 0.4, 1.5};
  const riis_mark_list list = gradients_of(surface, 4, xyz, NULL);
  static const double expected[] = {0, 0, 1, -1};
  for (int i = 0; i < 4; ++i) {
    CHECK_NEAR(list.distance_gradient[i], expected[i], 1e-10);
    assert_int_equal(list.leaflet_id[i], i < 2 ? 0 : 1);
  }
  assert_null(list.K_gradient);
}

/* --- Bits, updates and refusals -------------------------------------------------------------------------------------- */

/* The derivatives do not depend on threads, search, instructions or the number of directions. An update invalidates them. */
TEST(bits_and_updates) {
  static double xyz[3 * n_points];
  riis_valve *valve = new_valve("mitral"), *after = new_valve("mitral"), *before = new_valve("mitral");
  CHECK_OK(riis_valve_set_scalar(valve, "opening", 0.5));
  CHECK_OK(riis_valve_set_scalar(after, "opening", 0.501));
  CHECK_OK(riis_valve_set_scalar(before, "opening", 0.499));
  riis_surface *surface = new_surface(valve, NULL);
  make_points(surface, 0.15, xyz);
  riis_mesh *mesh = mesh_of(n_points, xyz);
  riis_marks *first = NULL, *marks = NULL;
  CHECK_OK(riis_marks_create(&first));
  CHECK_OK(riis_marks_create(&marks));
  own(first), own(marks);
  riis_mark_options options = mark_options();
  options.distance_limit = 0.15;
  options.fields = RIIS_FIELD_GRADIENT;
  CHECK_OK(riis_surface_add_direction(surface, after, before, 2e-3, NULL, NULL));
  CHECK_OK(riis_mark_nodes(surface, mesh, &options, first));
  const riis_mark_list of_first = within_list(first);
  for (int i = 0; i < 8; ++i) {
    options.n_threads = 1 + i % 3;
    options.search = i % 2 ? RIIS_SEARCH_CLUSTERS : RIIS_SEARCH_EXHAUSTIVE;
    options.instructions = i < 4 ? RIIS_INSTRUCTIONS_BASELINE : RIIS_INSTRUCTIONS_AUTO;
    options.fields = i % 4 ? RIIS_FIELD_GRADIENT : RIIS_FIELD_GRADIENT | RIIS_FIELD_POINT | RIIS_FIELD_SIDE;
    /* The valve returns to the earlier opening with a step of opposite sign. The second direction gets its earlier derivatives
     * again. */
    if (i == 4) CHECK_OK(riis_surface_add_direction(surface, before, after, -2e-3, NULL, NULL));
    CHECK_OK(riis_mark_nodes(surface, mesh, &options, marks));
    const riis_mark_list all = within_list(marks), some = marked_list(marks);
    const int64_t n = i < 4 ? 1 : 2;
    assert_int_equal(all.n_directions, n);
    assert_int_equal(all.n_nodes, of_first.n_nodes);
    assert_true(some.n_nodes > 0 && some.n_nodes < all.n_nodes);
    for (int64_t k = 0, at = 0; k < all.n_nodes; ++k) {
      CHECK_SAME(all.distance_gradient[n * k], of_first.distance_gradient[k]);
      CHECK_NEAR(all.distance_gradient[n * k + n - 1], of_first.distance_gradient[k], 1e-9);
      if (at == some.n_nodes || some.node_id[at] != all.node_id[k]) continue;
      for (int64_t d = 0; d < n; ++d) CHECK_SAME(some.distance_gradient[n * at + d], all.distance_gradient[n * k + d]);
      ++at;
    }
  }
  /* A moving update removes the directions. A direction and velocities may exist at the same time. */
  CHECK_OK(riis_surface_update_moving(surface, valve, before, 1e-3, NULL, NULL));
  CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "no direction|riis_surface_add_direction",
                riis_mark_nodes(surface, mesh, &options, marks));
  CHECK_OK(riis_surface_add_direction(surface, after, before, 2e-3, NULL, NULL));
  options.fields = RIIS_FIELD_GRADIENT | RIIS_FIELD_VELOCITY;
  CHECK_OK(riis_mark_nodes(surface, mesh, &options, marks));
  assert_int_equal(within_list(marks).n_directions, 1);
  for (int64_t k = 0; k < of_first.n_nodes; ++k)
    CHECK_SAME(within_list(marks).distance_gradient[k], of_first.distance_gradient[k]);
  options.fields = 0;
  CHECK_OK(riis_mark_nodes(surface, mesh, &options, marks));
  assert_int_equal(within_list(marks).n_directions, 0);
  assert_null(within_list(marks).distance_gradient);
}

/* A distance's derivative follows from the rates at the closest point. Rates do not depend on the number of threads. Later
 * directions leave the arrays of earlier directions in place. */
TEST(rates_give_the_derivatives) {
  static double xyz[3 * n_points];
  riis_valve *valve = new_valve("mitral"), *after = new_valve("mitral");
  CHECK_OK(riis_valve_set_scalar(valve, "opening", 0.5));
  CHECK_OK(riis_valve_set_scalar(after, "opening", 0.501));
  riis_surface_options options = surface_options(), shifted;
  options.n_threads = 1;
  riis_surface *surface = new_surface(valve, &options);
  options.n_threads = 3;
  riis_surface *threaded = new_surface(valve, &options);
  make_points(surface, 0.05, xyz);
  CHECK_OK(riis_surface_add_direction(surface, after, valve, 1e-3, NULL, NULL));
  CHECK_OK(riis_surface_add_direction(threaded, after, valve, 1e-3, NULL, NULL));
  const double *const rate = rates_of(surface, 0);
  const riis_triangles c = triangles_of(surface);
  assert_memory_equal(rate, rates_of(threaded, 0), 3 * (size_t)c.n_vertices * sizeof *rate);
  shifted = options;
  shifted.translation[2] += 0.25;
  for (int i = 0; i < 20; ++i) CHECK_OK(riis_surface_add_direction(surface, valve, valve, 0.5, &shifted, NULL));
  assert_ptr_equal(rates_of(surface, 0), rate);
  for (int64_t i = 0; i < 3 * c.n_vertices; ++i) CHECK_NEAR(rates_of(surface, 20)[i], i % 3 == 2 ? 0.5 : 0, 1e-12);
  riis_marks *marks = NULL;
  CHECK_OK(riis_marks_create(&marks));
  own(marks);
  riis_mark_options mark = mark_options();
  mark.fields = RIIS_FIELD_GRADIENT | RIIS_FIELD_POINT | RIIS_FIELD_BARYCENTRIC;
  CHECK_OK(riis_mark_nodes(surface, mesh_of(n_points, xyz), &mark, marks));
  const riis_mark_list list = marked_list(marks);
  assert_true(list.n_nodes > n_points / 2 && list.n_directions == 21);
  for (int64_t i = 0; i < list.n_nodes; ++i) {
    const int64_t *const id = c.vertex_id + 3 * list.triangle_id[i];
    double sum = 0;
    for (int x = 0; x < 3 && list.distance[i] > 0; ++x)
      for (int k = 0; k < 3; ++k)
        sum -= (xyz[3 * list.node_id[i] + x] - list.point[3 * i + x]) / list.distance[i] * list.barycentric[3 * i + k] *
               rate[3 * id[k] + x];
    CHECK_NEAR(list.distance_gradient[21 * i], sum, 1e-9);
  }
}

TEST(missing_directions_are_refused) {
  riis_valve *valve = new_valve("aortic");
  riis_surface *surface = new_surface(valve, NULL);
  riis_direction got;
  memset(&got, 0x22, sizeof got);
  const riis_direction before = got;
#define REFUSED(status, parts, id, size) \
  CHECK_REFUSED(status, parts, riis_surface_get_direction(surface, id, &got, size))
  REFUSED(RIIS_INVALID_ARGUMENT, "direction_id is 0, but the surface has no direction|riis_surface_add_direction", 0,
          24);
  for (int i = 0; i < 3; ++i) CHECK_OK(riis_surface_add_direction(surface, valve, valve, 1, NULL, NULL));
  REFUSED(RIIS_INVALID_ARGUMENT, "direction_id is -1; it must be from 0 to 2", -1, 24);
  REFUSED(RIIS_INVALID_ARGUMENT, "direction_id is 3; it must be from 0 to 2", 3, 24);
  REFUSED(RIIS_INVALID_ARGUMENT, "direction_id is -9223372036854775808;", INT64_MIN, 24);
  REFUSED(RIIS_INVALID_STRUCT_SIZE, "struct size of direction is 16", 2, 16);
  REFUSED(RIIS_INVALID_STRUCT_SIZE, "struct size of direction is 32", 2, 32);
  CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "direction is NULL", riis_surface_get_direction(surface, 2, NULL, 24));
  assert_memory_equal(&got, &before, sizeof got);
  CHECK_OK(riis_surface_get_direction(surface, 2, &got, sizeof got));
  CHECK_OK(riis_surface_update(surface, valve, NULL));
  REFUSED(RIIS_INVALID_ARGUMENT, "the surface has no direction", 0, 24);
  const double xyz[9] = {0, 0, 0, 1, 0, 0, 0, 1, 0};
  const int32_t face[3] = {0, 1, 2};
  const riis_surface_arrays arrays = triangle_arrays(3, xyz, 1, face);
  surface = surface_from(&arrays, NULL);
  REFUSED(RIIS_INVALID_ARGUMENT, "the surface has no direction", 0, 24);
#undef REFUSED
}

TEST(bad_directions_are_refused) {
  riis_valve *valve = new_valve("aortic"), *coapting = new_valve("coapting"), *warped = new_valve("aortic");
  riis_valve *skirted = new_valve("aortic"), *wrong = new_valve("aortic");
  warp_valve(warped, no_shifts);
  CHECK_OK(riis_valve_set_scalar(skirted, "skirt_length", 0.2));
  CHECK_OK(riis_valve_set_scalar(wrong, "leaflet_height", 30));
  riis_surface *surface = new_surface(valve, NULL);
#define REFUSED(status, parts, after, before, dp, options) \
  CHECK_REFUSED(status, parts, riis_surface_add_direction(surface, after, before, dp, options, NULL))
  REFUSED(RIIS_INVALID_ARGUMENT, "dp is 0;|valve_before to valve_after", valve, valve, 0, NULL);
  REFUSED(RIIS_INVALID_ARGUMENT, "dp is nan;", valve, valve, NAN, NULL);
  REFUSED(RIIS_INVALID_ARGUMENT, "dp is -1e-31;", valve, valve, -1e-31, NULL);
  REFUSED(RIIS_INVALID_PARAMETER, "valve_after is of the kind coapting|the surface's valve of the kind aortic",
          coapting, valve, 1, NULL);
  REFUSED(RIIS_INVALID_PARAMETER, "valve_before is of the kind coapting", valve, coapting, 1, NULL);
  REFUSED(RIIS_INVALID_PARAMETER, "valve_after has a warp, but the surface's valve has none", warped, valve, 1, NULL);
  REFUSED(RIIS_INVALID_PARAMETER, "valve_before has|patches, the surface's valve has", valve, skirted, 1, NULL);
  REFUSED(RIIS_INVALID_PARAMETER, "in valve_after: |leaflet_height is 30", wrong, valve, 1, NULL);
  riis_surface_options options = surface_options();
  options.scale = -1;
  REFUSED(RIIS_INVALID_ARGUMENT, "options_after.scale is -1", valve, valve, 1, &options);
  CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "options_before.scale is -1",
                riis_surface_add_direction(surface, valve, valve, 1, NULL, &options));
  options.struct_size = 8;
  REFUSED(RIIS_INVALID_STRUCT_SIZE, "options_after", valve, valve, 1, &options);
  const double point[3] = {0, 0, 0};
  riis_marks *marks = NULL;
  CHECK_OK(riis_marks_create(&marks));
  own(marks);
  riis_mark_options mark = mark_options();
  mark.fields = RIIS_FIELD_GRADIENT;
  CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "no direction",
                riis_mark_nodes(surface, mesh_of(1, point), &mark, marks)); /* none was added */
  for (int i = 0; i < 1000; ++i) CHECK_OK(riis_surface_add_direction(surface, valve, valve, 1, NULL, NULL));
  REFUSED(RIIS_LIMIT_EXCEEDED, "surface has 1000 directions", valve, valve, 1, NULL);
  options = surface_options();
  options.measure = RIIS_MEASURE_SAMPLING;
  CHECK_OK(riis_surface_update(surface, valve, &options));
  CHECK_OK(riis_surface_add_direction(surface, valve, valve, 1, NULL, NULL));
  CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "options.fields is 256|sampling",
                riis_mark_nodes(surface, mesh_of(1, point), &mark, marks));
  const double xyz[9] = {0, 0, 0, 1, 0, 0, 0, 1, 0};
  const int32_t face[3] = {0, 1, 2};
  const riis_surface_arrays arrays = triangle_arrays(3, xyz, 1, face);
  surface = surface_from(&arrays, NULL);
  REFUSED(RIIS_INVALID_ARGUMENT, "surface was made from arrays", valve, valve, 1, NULL);
}

int main(void) {
  rng = random_start("test_gradients");
  return run_cases(NULL, NULL);
}
