/* SPDX-License-Identifier: Apache-2.0
 * Swept volumes are compared with sums over moving updates. Swept volumes are also compared with closed forms, for leaflets that
 * turn and patches that translate. The volumes of parts must add up to the whole volume. */
#include <riis/riis.h>

#include "test_support.h"

#include "handles.h"

#include "shapes.h"

static random_source rng;

static const double pi = 3.14159265358979323846;

static double between(double low, double high) { return random_between(&rng, low, high); }

static double swept(const riis_valve *valve, double from, double to, const riis_surface_options *options,
                    int32_t leaflet_id) {
  double volume = -7;
  CHECK_OK(riis_valve_get_swept_volume(valve, from, to, options, leaflet_id, &volume));
  return volume;
}

static void set(riis_valve *valve, const char *name, double value) {
  CHECK_OK(riis_valve_set_scalar(valve, name, value));
}

enum { n_kinds = 5 };
static const char *const kinds[n_kinds] = {"aortic", "mitral", "trileaflet", "bileaflet", "coapting"};
static int n_trials(void) { return trials(n_kinds, 2 * n_kinds); }

/* A valve of a kind, with the values of some parameters. */
static riis_valve *random_valve(int kind) {
  riis_valve *valve = new_valve(kinds[kind]);
  if (kind == 0) set(valve, "leaflet_angle", between(45, 60));
  if (kind == 1) set(valve, "surface_angle", between(-20, 20));
  if (kind == 2) set(valve, "leaflet_height", between(1.3, 1.6));
  if (kind == 3) set(valve, "closed_angle", between(20, 40));
  if (kind == 4) set(valve, "effective_height", between(0.85, 1));
  return valve;
}

static void random_placement(riis_surface_options *options) {
  options->scale = pow(10, between(-1, 1));
  for (int c = 0; c < 3; ++c) {
    options->rotation_axis[c] = between(-1, 1) + (c == 1 ? 2 : 0);
    options->translation[c] = options->scale * between(-3, 3);
  }
  options->rotation_angle = between(-180, 180);
}

/* Returns the volume of one step: the integral of u . n over the triangles at the step's middle, times the step's time. */
static double rate_on(const riis_surface *surface, int32_t leaflet_id) {
  const riis_triangles all = triangles_of(surface);
  double sum = 0;
  for (int64_t i = 0; i < all.n_triangles; ++i) {
    if (leaflet_id >= 0 && all.leaflet_id[i] != leaflet_id) continue;
    const double *p[3], *u[3];
    double e[3], f[3], mean[3];
    for (int k = 0; k < 3; ++k)
      p[k] = all.xyz + 3 * all.vertex_id[3 * i + k], u[k] = all.velocity + 3 * all.vertex_id[3 * i + k];
    for (int c = 0; c < 3; ++c)
      e[c] = p[1][c] - p[0][c], f[c] = p[2][c] - p[0][c], mean[c] = (u[0][c] + u[1][c] + u[2][c]) / 3;
    sum += 0.5 * (mean[0] * (e[1] * f[2] - e[2] * f[1]) + mean[1] * (e[2] * f[0] - e[0] * f[2]) +
                  mean[2] * (e[0] * f[1] - e[1] * f[0]));
  }
  return sum;
}

/* The volume is compared with a sum over many small steps in time. Each step uses the triangles of a moving update. */
static double by_steps(riis_valve *valve, double from, double to, const riis_surface_options *options,
                       int32_t leaflet_id) {
  enum { n_steps = 12 };
  riis_valve *before = NULL;
  CHECK_OK(riis_valve_copy(valve, &before));
  own(before);
  set(valve, "opening", from);
  riis_surface *surface = new_surface(valve, options);
  double sum = 0;
  for (int i = 0; i < n_steps; ++i)
    for (int half = 0; half < 2; ++half) {
      const double width = (to - from) / n_steps, end = from + width * (i + half);
      set(valve, "opening", from + width * (i + 0.5));
      set(before, "opening", fmin(fmax(end, 0), 1));
      CHECK_OK(riis_surface_update_moving(surface, valve, before, half ? -0.5 : 0.5, NULL, NULL));
      sum += 0.5 * rate_on(surface, leaflet_id);
    }
  free_one_owned(surface), free_one_owned(before);
  return sum;
}

TEST(volumes_are_sums_over_steps) {
  for (int trial = 0; trial < n_trials(); ++trial) {
    riis_valve *valve = random_valve(trial % n_kinds);
    riis_surface_options options = surface_options();
    if (trial >= n_kinds) random_placement(&options);
    options.triangulation = trial % 2 ? RIIS_TRIANGULATION_FIXED : RIIS_TRIANGULATION_ADAPTED;
    options.flip_normals = trial >= n_kinds;
    options.tolerance = 0.004; /* the error of these sums grows with the tolerance */
    const double from = trial < n_kinds ? 0 : between(0, 1), to = trial < n_kinds ? 1 : between(0, 1);
    for (int32_t leaflet_id = -1; leaflet_id < 1; ++leaflet_id) {
      const double whole = fabs(swept(valve, 0, 1, &options, leaflet_id));
      CHECK_NEAR(swept(valve, from, to, &options, leaflet_id), by_steps(valve, from, to, &options, leaflet_id),
                 1e-3 * whole);
    }
  }
}

static double value_of(const riis_valve *valve, const char *name) {
  double value = 0;
  CHECK_OK(riis_valve_get(valve, name, 1, &value));
  return value;
}

/* A leaflet turns about its hinge. The swept volume is the angle times the moment of its area about the hinge. */
TEST(rigid_leaflets_sweep_their_moments) {
  for (int trial = 0; trial < trials_of(60); ++trial) {
    riis_valve *valve = new_valve("bileaflet");
    set(valve, "closed_angle", between(15, 45));
    set(valve, "open_angle", between(70, 90));
    if (trial % 2) set(valve, "ring_height", 0.5);
    const double R = value_of(valve, "radius"), x0 = 0.5 * value_of(valve, "gap");
    const double offset = value_of(valve, "hinge_offset"), closed = value_of(valve, "closed_angle") * pi / 180;
    const double half = sqrt(R * R - x0 * x0), area = R * R * acos(x0 / R) - x0 * half;
    const double moment = (2.0 / 3 * half * half * half - offset * area) / pow(cos(closed), 2);
    const double from = between(0, 1), to = between(0, 1);
    const double angle = (to - from) * (value_of(valve, "open_angle") * pi / 180 - closed);
    const double whole = fabs(moment) * pi / 2;
    CHECK_NEAR(swept(valve, from, to, NULL, RIIS_LEAFLET_POSITIVE), angle * moment, 2e-4 * whole);
    CHECK_NEAR(swept(valve, from, to, NULL, RIIS_LEAFLET_NEGATIVE), angle * moment, 2e-4 * whole);
    if (trial % 2) CHECK_NEAR(swept(valve, from, to, NULL, RIIS_LEAFLET_HOUSING), 0, 0);
    CHECK_NEAR(swept(valve, from, to, NULL, RIIS_ALL_LEAFLETS), 2 * angle * moment, 4e-4 * whole);
    free_one_owned(valve);
  }
}

/* A square translates. The swept volume is the area times the shift along its normal. */
TEST(squares_sweep_boxes) {
  for (int trial = 0; trial < trials_of(30); ++trial) {
    const shape closed = unit_square();
    shape moved = unit_square();
    double shift[3];
    for (int c = 0; c < 3; ++c) shift[c] = between(-2, 2);
    for (int64_t i = 0; i < moved.n_curves; ++i)
      for (int k = 0; k <= moved.degree[i]; ++k)
        for (int c = 0; c < 3; ++c) moved.control[i][k][c] += shift[c];
    riis_valve *valve = valve_from(&closed), *open = valve_from(&moved);
    CHECK_REFUSED(RIIS_INVALID_PARAMETER, "opening is 0.5|one state",
                  riis_valve_get_swept_volume(valve, 0, 0.5, NULL, RIIS_ALL_LEAFLETS, shift));
    CHECK_NEAR(swept(valve, 0, 0, NULL, 0), 0, 0);
    CHECK_OK(riis_valve_set_open_state(valve, open));
    riis_surface_options options = surface_options();
    random_placement(&options);
    options.flip_normals = trial % 2;
    const double from = between(0, 1), to = between(0, 1), size = pow(options.scale, 3);
    CHECK_NEAR(swept(valve, from, to, &options, 0), (trial % 2 ? -1 : 1) * size * (to - from) * shift[2], 1e-12 * size);
    free_one_owned(valve), free_one_owned(open);
  }
}

TEST(volumes_are_conserved) {
  const int first = is_short_test() ? 3 : 0; /* a short test takes the kind with the fewest triangles */
  for (int trial = first; trial < first + trials(n_kinds + 2, 2 * n_kinds + 2); ++trial) {
    riis_valve *valve = random_valve(trial % n_kinds);
    const double a = between(0, 1), b = between(0, 1), c = between(0, 1);
    riis_surface_options options = surface_options(), placed = surface_options();
    random_placement(&placed);
    const double whole = fabs(swept(valve, 0, 1, NULL, RIIS_ALL_LEAFLETS));
    const double there = swept(valve, a, b, NULL, RIIS_ALL_LEAFLETS);
    CHECK_SAME(swept(valve, b, a, NULL, RIIS_ALL_LEAFLETS), -there);
    CHECK_NEAR(there + swept(valve, b, c, NULL, RIIS_ALL_LEAFLETS), swept(valve, a, c, NULL, RIIS_ALL_LEAFLETS),
               1e-4 * whole);
    CHECK_NEAR(swept(valve, 0, 0.25, NULL, -1) + swept(valve, 0.25, 1, NULL, -1), swept(valve, 0, 1, NULL, -1),
               1e-13 * whole);
    CHECK_NEAR(swept(valve, a, b, &placed, RIIS_ALL_LEAFLETS), pow(placed.scale, 3) * there,
               1e-14 * pow(placed.scale, 3) * whole);
    double sum = 0;
    for (int32_t id = 0; id < (trial % n_kinds % 2 ? 2 : 3); ++id) sum += swept(valve, a, b, NULL, id);
    CHECK_NEAR(sum, there, 1e-13 * whole);
    set(valve, "opening", c);
    for (int32_t n = 1; n < 5; n += 2) {
      options.n_threads = n;
      CHECK_SAME(swept(valve, a, b, &options, RIIS_ALL_LEAFLETS), there);
    }
    options.flip_normals = 1;
    CHECK_SAME(swept(valve, a, b, &options, RIIS_ALL_LEAFLETS), -there);
    free_one_owned(valve);
  }
}

/* --- Refusals -------------------------------------------------------------------------------------------------------------- */

TEST(wrong_calls_are_refused) {
  riis_valve *valve = new_valve("mitral");
  riis_surface_options options = surface_options();
  double volume = -7;
  CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "valve is NULL", riis_valve_get_swept_volume(NULL, 0, 1, NULL, -1, &volume));
  CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "volume is NULL", riis_valve_get_swept_volume(valve, 0, 1, NULL, -1, NULL));
  CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "opening_from is -0.5|0 to 1",
                riis_valve_get_swept_volume(valve, -0.5, 1, NULL, -1, &volume));
  CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "opening_to is nan|0 to 1",
                riis_valve_get_swept_volume(valve, 0, NAN, NULL, -1, &volume));
  CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "leaflet_id is 2|patches of the valve lack",
                riis_valve_get_swept_volume(valve, 0, 1, NULL, 2, &volume));
  CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "leaflet_id is -2", riis_valve_get_swept_volume(valve, 0, 1, NULL, -2, &volume));
  options.scale = 0;
  CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "options.scale is 0",
                riis_valve_get_swept_volume(valve, 0, 1, &options, -1, &volume));
  options = surface_options();
  options.struct_size = 12;
  CHECK_REFUSED(RIIS_INVALID_STRUCT_SIZE, "options is 12",
                riis_valve_get_swept_volume(valve, 0, 1, &options, -1, &volume));
  riis_valve *tall = new_valve("trileaflet");
  set(tall, "leaflet_height", 30);
  CHECK_REFUSED(RIIS_INVALID_PARAMETER, "leaflet_height is 30",
                riis_valve_get_swept_volume(tall, 0, 1, NULL, -1, &volume));
  CHECK_NEAR(volume, -7, 0);
}

int main(void) {
  rng = random_start("test_swept_volume");
  return run_cases(NULL, NULL);
}
