/* SPDX-License-Identifier: Apache-2.0
 * Tests surfaces with a velocity. The triangles equal those of an update without velocities. The velocities are compared with
 * known motions. A refusal does not change the surface. test_mitral_motion.c tests the motion of the mitral valve. */
#include <riis/riis.h>

#include "test_support.h"

#include "handles.h"
#include "sanitized.h"

static random_source rng;

static int64_t any_of(int64_t n) { return (int64_t)(random_bits(&rng) % (uint64_t)n); }
static double between(double low, double high) { return random_between(&rng, low, high); }
static double distance(const double *p, const double *q) { return hypot(hypot(p[0] - q[0], p[1] - q[1]), p[2] - q[2]); }

/* --- Valves ---------------------------------------------------------------------------------------------------------- */

/* A strip of three patches. Curves 0 to 2 are the lower ones, and curves 3 to 5 the upper ones. Curves 6 to 9 run upwards from
 * the lower to the upper curves, and curve 9 is a point. */
enum { n_curves = 10, n_patches = 3, n_control = 32 };
static const int32_t degrees[n_curves] = {3, 2, 1, 2, 3, 3, 1, 3, 2, 1};
static const int32_t is_reversed[n_curves] = {0, 0, 0, 0, 1, 0, 0, 1, 0, 0};
typedef struct strip {
  double control[n_control][3];
} strip;

static strip random_strip(double roughness) {
  strip made;
  double corner[2][4][3];
  for (int top = 0; top < 2; ++top)
    for (int j = 0; j < 4; ++j) {
      for (int c = 0; c < 3; ++c) corner[top][j][c] = roughness * between(-0.2, 0.2) + (c == 0 ? j : c == 1 ? top : 0);
      if (j == 3) memcpy(corner[top][j], corner[0][j], sizeof corner[0][j]);
    }
  for (int i = 0, at = 0; i < n_curves; at += degrees[i++] + 1) {
    const double *first = i < 6 ? corner[i / 3][i % 3] : corner[0][i - 6],
                 *last = i < 6 ? corner[i / 3][i % 3 + 1] : corner[1][i - 6];
    for (int k = 0; k <= degrees[i]; ++k) {
      const double t = (double)k / degrees[i], inside = k > 0 && k < degrees[i] ? roughness : 0;
      double *to = made.control[is_reversed[i] ? at + degrees[i] - k : at + k];
      for (int c = 0; c < 3; ++c) to[c] = (1 - t) * first[c] + t * last[c] + inside * between(-0.3, 0.3);
      if (k == 0 || k == degrees[i]) memcpy(to, k ? last : first, 3 * sizeof *to);
    }
  }
  return made;
}

static riis_valve *valve_of(const strip *from) {
  static const int32_t leaflet_id[n_patches] = {2, 0, 7};
  int32_t curve_id[4 * n_patches], reversed[4 * n_patches];
  for (int j = 0; j < n_patches; ++j) {
    const int32_t sides[4] = {j, 3 + j, 6 + j, 7 + j};
    for (int k = 0; k < 4; ++k) curve_id[4 * j + k] = sides[k], reversed[4 * j + k] = is_reversed[sides[k]];
  }
  riis_patches patches;
  riis_valve *valve = NULL;
  CHECK_OK(riis_patches_init(&patches, sizeof patches));
  patches.n_curves = n_curves;
  patches.degree = degrees;
  patches.control = from->control[0];
  patches.n_patches = n_patches;
  patches.curve_id = curve_id;
  patches.reversed = reversed;
  patches.leaflet_id = leaflet_id;
  CHECK_OK(riis_valve_create_from_patches(&patches, &valve));
  return own(valve);
}

/* Returns the strip at time t. At time t, each point x has moved to (1 + growth t) x + drift t. */
static strip strip_at(const strip *from, double t, double growth, const double *drift) {
  strip made;
  for (int i = 0; i < n_control; ++i)
    for (int c = 0; c < 3; ++c) made.control[i][c] = (1 + growth * t) * from->control[i][c] + drift[c] * t;
  return made;
}

static riis_valve *copy_of(const riis_valve *valve) {
  riis_valve *copy = NULL;
  CHECK_OK(riis_valve_copy(valve, &copy));
  return own(copy);
}

/* Makes a valve of any kind with an open state. */
static riis_valve *random_valve(int64_t kind) {
  riis_valve *valve = NULL, *open = NULL;
  if (kind == 2) {
    const strip closed = random_strip(1), opened = random_strip(1);
    valve = valve_of(&closed), open = valve_of(&opened);
  } else {
    valve = new_valve(kind ? "mitral" : "aortic"), open = copy_of(valve);
  }
  if (kind == 0) {
    static const char *cusps[3] = {"right", "left", "non_coronary"};
    for (int i = 0; i < 3; ++i) {
      char name[64];
      double values[3];
      snprintf(name, sizeof name, "%s.rotation", cusps[i]);
      CHECK_OK(riis_valve_get(open, name, 3, values));
      for (int c = 0; c < 3; ++c) values[c] += between(-20, 20);
      CHECK_OK(riis_valve_set(open, name, 3, values));
      snprintf(name, sizeof name, "%s.translation", cusps[i]);
      for (int c = 0; c < 3; ++c) values[c] = between(-0.3, 0.3) - (c == 2);
      CHECK_OK(riis_valve_set(open, name, 3, values));
    }
    CHECK_OK(riis_valve_set_scalar(open, "leaflet_angle", between(40, 60)));
    CHECK_OK(riis_valve_set_scalar(open, "bending_power", between(1.5, 3)));
  }
  if (kind == 1) {
    CHECK_OK(riis_valve_set_scalar(open, "surface_angle", between(-40, 40)));
    CHECK_OK(riis_valve_set_scalar(open, "anterior_ratio", between(0.35, 0.5)));
  }
  CHECK_OK(riis_valve_set_open_state(valve, open));
  free_one_owned(open);
  return valve;
}

/* --- Content --------------------------------------------------------------------------------------------------------- */

static void random_placement(riis_surface_options *options) {
  options->scale = pow(10, between(-2, 2));
  for (int c = 0; c < 3; ++c) {
    options->rotation_axis[c] = between(-1, 1) + (c == 1 ? 2 : 0);
    options->translation[c] = options->scale * between(-3, 3);
  }
  options->rotation_angle = between(-180, 180);
}

TEST(triangles_are_those_of_a_plain_update) {
  static const int32_t threads[] = {0, 2, 3, 7};
  riis_surface *moving = new_surface(random_valve(0), NULL);
  for (int trial = 0; trial < trials_of(60); ++trial) {
    const int owned_before = n_owned();
    riis_valve *valve = random_valve(trial % 3), *before = copy_of(valve);
    CHECK_OK(riis_valve_set_scalar(valve, "opening", any_of(5) ? between(0, 1) : (double)any_of(2)));
    CHECK_OK(riis_valve_set_scalar(before, "opening", any_of(5) ? between(0, 1) : (double)any_of(2)));
    riis_surface_options options = surface_options(), then = surface_options();
    if (any_of(2)) random_placement(&options);
    if (any_of(2)) random_placement(&then);
    options.flip_normals = any_of(4) == 0;
    options.tolerance = pow(10, between(-1.5, -0.2));
    if (any_of(6) == 0) options.measure = RIIS_MEASURE_SAMPLING, options.measure_tolerance = 0.5;
    const riis_surface_options *options_before = any_of(3) ? &then : NULL;
    const double seconds = (any_of(2) ? 1 : -1) * pow(10, between(-3, 1));
    options.n_threads = 1;
    riis_surface *plain = new_surface(valve, &options), *one = new_surface(valve, NULL);
    assert_null(velocity_of(plain));
    CHECK_OK(riis_surface_update_moving(one, valve, before, seconds, &options, options_before));
    options.n_threads = threads[any_of(4)];
    CHECK_OK(riis_surface_update_moving(moving, valve, before, seconds, &options, options_before));
    assert_true(is_same_content(one, plain));
    assert_true(is_same_content(moving, plain));
    const int64_t n = triangles_of(plain).n_vertices;
    assert_memory_equal(velocity_of(one), velocity_of(moving), (size_t)n * 3 * sizeof(double));
    for (int64_t i = 0; i < 3 * n; ++i) assert_true(isfinite(velocity_of(one)[i]));
    if (any_of(2)) { /* sometimes the next update starts from a surface without velocity */
      CHECK_OK(riis_surface_update(moving, valve, &options));
      assert_null(velocity_of(moving));
      assert_true(is_same_content(moving, plain));
    }
    free_owned_after(owned_before);
  }
}

TEST(arrays_have_no_velocity) {
  const double xyz[9] = {0, 0, 0, 1, 0, 0, 0, 1, 0};
  const int32_t ids[3] = {0, 1, 2};
  const riis_surface_arrays arrays = triangle_arrays(3, xyz, 1, ids);
  riis_valve *valve = random_valve(0);
  riis_surface *surface = new_surface(valve, NULL);
  CHECK_OK(riis_surface_update_moving(surface, valve, valve, 1, NULL, NULL));
  assert_non_null(velocity_of(surface));
  CHECK_OK(riis_surface_update_from_arrays(surface, &arrays, NULL));
  assert_null(velocity_of(surface));
  CHECK_OK(riis_surface_update_moving(surface, valve, valve, 1, NULL, NULL)); /* a valve that does not move */
  assert_non_null(velocity_of(surface));
}

/* --- Known motions --------------------------------------------------------------------------------------------------- */

/* Returns the largest speed of the vertices of a leaflet's triangles. The leaflet -1 means all triangles. */
static double largest_speed(const riis_surface *surface, int32_t leaflet_id) {
  static const double zero[3] = {0, 0, 0};
  const riis_triangles c = triangles_of(surface);
  const double *velocity = velocity_of(surface);
  double largest = 0;
  for (int64_t k = 0; k < 3 * c.n_triangles; ++k) {
    if (leaflet_id >= 0 && c.leaflet_id[k / 3] != leaflet_id) continue;
    const double speed = distance(velocity + 3 * c.vertex_id[k], zero);
    if (!(speed <= largest)) largest = speed;
  }
  return largest;
}

TEST(nothing_moves_where_nothing_changed) {
  for (int trial = 0; trial < trials_of(30); ++trial) {
    const int owned_before = n_owned();
    riis_valve *valve = random_valve(trial % 3);
    riis_surface_options options = surface_options();
    if (trial % 2) random_placement(&options);
    CHECK_OK(riis_valve_set_scalar(valve, "opening", trial < 6 ? (double)(trial % 2) : between(0, 1)));
    riis_valve *copy = copy_of(valve);
    riis_surface *surface = new_surface(valve, &options);
    const double seconds = pow(10, between(-30, 30));
    for (int i = 0; i < 4; ++i) {
      const riis_surface_options *before = i & 1 ? &options : NULL;
      CHECK_OK(riis_surface_update_moving(surface, valve, i & 2 ? copy : valve, seconds, NULL, before));
      const int64_t n = triangles_of(surface).n_vertices;
      for (int64_t k = 0; k < 3 * n; ++k)
        if (velocity_of(surface)[k] != 0) fail_msg("trial %d: %.17g", trial, velocity_of(surface)[k]);
    }
    free_owned_after(owned_before);
  }
}

/* Only one of three cusps moves, or only one scallop of the mitral valve. */
TEST(parts_at_rest_have_no_velocity) {
  static const double turned[3] = {5, 3, 121}, of_non_coronary[3] = {0, 0, -121.5};
  riis_valve *valve = new_valve("aortic"), *before = copy_of(valve);
  CHECK_OK(riis_valve_set(before, "non_coronary.rotation", 3, of_non_coronary)); /* it no longer follows */
  CHECK_OK(riis_valve_set_scalar(before, "left.leaflet_angle", 50));
  for (int i = 0; i < 2; ++i) {
    riis_surface *surface = new_surface(valve, NULL);
    CHECK_OK(riis_surface_update_moving(surface, valve, before, 0.01, NULL, NULL));
    assert_true(largest_speed(surface, RIIS_LEAFLET_RIGHT) == 0);
    assert_true(largest_speed(surface, RIIS_LEAFLET_NON_CORONARY) == 0);
    assert_true(largest_speed(surface, RIIS_LEAFLET_LEFT) > 1);
    CHECK_OK(riis_valve_set(before, "left.rotation", 3, turned));
  }
  valve = new_valve("mitral"), before = copy_of(valve);
  CHECK_OK(riis_valve_set_scalar(before, "posterior_scallop_length2", 1.3));
  riis_surface *surface = new_surface(valve, NULL);
  CHECK_OK(riis_surface_update_moving(surface, valve, before, 0.01, NULL, NULL));
  const riis_triangles c = triangles_of(surface);
  const double *velocity = velocity_of(surface);
  for (int64_t k = 0; k < 3 * c.n_triangles; ++k)
    for (int x = 0; x < 3 && c.patch_id[k / 3] != 7 && c.patch_id[k / 3] != 8; ++x)
      assert_true(velocity[3 * c.vertex_id[k] + x] == 0);
  assert_true(largest_speed(surface, RIIS_LEAFLET_POSTERIOR) > 1);
}

/* The rotation by Rodrigues' formula, in extended precision. */
typedef struct placed {
  long double m[3][3], shift[3];
} placed;

static placed placed_by(const riis_surface_options *o) {
  const long double angle = acosl(-1) * o->rotation_angle / 180, s = sinl(angle), c = cosl(angle);
  long double n[3], size = 0;
  for (int i = 0; i < 3; ++i) size += (long double)o->rotation_axis[i] * o->rotation_axis[i];
  for (int i = 0; i < 3; ++i) n[i] = o->rotation_axis[i] / sqrtl(size);
  placed made;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      const long double across = i == j ? 0 : (j == (i + 1) % 3 ? -1 : 1) * n[3 - i - j];
      made.m[i][j] = o->scale * ((i == j ? c : 0) + (1 - c) * n[i] * n[j] + s * across);
    }
    made.shift[i] = o->translation[i];
  }
  return made;
}

/* Finds the earlier position of a point that is now at x. The inverse of scale times rotation is its transpose divided by the
 * square of the scale. */
static void before_of(const riis_surface_options *now, const riis_surface_options *then, const double *x,
                      long double *was) {
  const placed a = placed_by(now), b = placed_by(then);
  const long double scale_sq = (long double)now->scale * now->scale;
  long double p[3] = {0, 0, 0};
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) p[i] += a.m[j][i] * (x[j] - a.shift[j]) / scale_sq;
  for (int i = 0; i < 3; ++i) {
    was[i] = b.shift[i];
    for (int j = 0; j < 3; ++j) was[i] += b.m[i][j] * p[j];
  }
}

/* A valve at rest is translated, turned, scaled, or all three. */
TEST(placements_move) {
  double worst = 0;
  for (int trial = 0; trial < trials_of(60); ++trial) {
    const int owned_before = n_owned();
    riis_valve *valve = random_valve(trial % 3);
    riis_surface_options now = surface_options(), then;
    if (trial % 2) random_placement(&now);
    now.flip_normals = trial % 5 == 0;
    then = now;
    /* The only options of the earlier state that count are those of its placement. */
    then.tolerance = 7, then.n_threads = -3, then.flip_normals = 9, then.half_thickness = NAN;
    const int what = trial / 3 % 4;
    for (int c = 0; c < 3 && (what == 0 || what == 3); ++c) then.translation[c] += now.scale * between(-1, 1);
    if (what == 1 || what == 3) then.rotation_angle += between(-30, 30);
    if (what == 3) then.rotation_axis[0] += 0.1;
    if (what == 2 || what == 3) then.scale *= between(0.8, 1.2);
    const double seconds = (any_of(2) ? 1 : -1) * pow(10, between(-4, 2));
    riis_surface *surface = new_surface(valve, NULL);
    CHECK_OK(riis_surface_update_moving(surface, valve, valve, seconds, &now, &then));
    const riis_triangles c = triangles_of(surface);
    const double *velocity = velocity_of(surface);
    double size = 5 * (now.scale + then.scale); /* the size of the coordinates */
    for (int i = 0; i < 3; ++i) size += fabs(now.translation[i]) + fabs(then.translation[i]);
    for (int64_t i = 0; i < c.n_vertices; ++i) {
      long double was[3];
      before_of(&now, &then, c.xyz + 3 * i, was);
      for (int k = 0; k < 3; ++k) {
        const double expected = (double)((c.xyz[3 * i + k] - was[k]) / seconds);
        const double off = fabs(velocity[3 * i + k] - expected) * fabs(seconds) / size;
        if (!(off <= worst)) worst = off;
      }
    }
    CHECK_AT_MOST(worst, 1e-14);
    free_owned_after(owned_before);
  }
  printf("off by %.2g of the coordinates over the time\n", worst);
}

/* Control points are scaled by 1 + growth t and moved by drift t. Every point of the surface moves like the control points, even
 * if arc length is its parameter. The other state may be earlier or later. */
TEST(patches_grow_and_drift) {
  double worst = 0;
  for (int trial = 0; trial < trials_of(40); ++trial) {
    const int owned_before = n_owned();
    const strip shape = random_strip(trial % 4 ? 1 : 0);
    const double growth = trial % 5 ? between(-0.5, 0.5) : 0, dt = (any_of(2) ? 1 : -1) * between(0.01, 0.5);
    const double drift[3] = {between(-1, 1), between(-1, 1), between(-1, 1)};
    const strip now = strip_at(&shape, 0, growth, drift), then = strip_at(&shape, -dt, growth, drift);
    riis_valve *valve = valve_of(&now), *before = valve_of(&then);
    riis_surface_options options = surface_options();
    options.tolerance = pow(10, between(-2, 0));
    riis_surface *surface = new_surface(valve, &options);
    CHECK_OK(riis_surface_update_moving(surface, valve, before, dt, NULL, NULL));
    const riis_triangles c = triangles_of(surface);
    const double *velocity = velocity_of(surface);
    /* Vertices lie on the polylines, which are within the tolerance of the curves. */
    const double allowed = fabs(growth) * options.tolerance * 0.1 + 1e-10 / fabs(dt);
    for (int64_t i = 0; i < c.n_vertices; ++i)
      for (int k = 0; k < 3; ++k) {
        const double off = fabs(velocity[3 * i + k] - (growth * c.xyz[3 * i + k] + drift[k]));
        if (!(off <= worst * allowed)) worst = off / allowed;
      }
    CHECK_AT_MOST(worst, 1);
    free_owned_after(owned_before);
  }
  printf("off by %.3f of what the tolerance allows\n", worst);
}

/* With a negative time, the two states give exactly the opposite velocities. */
TEST(time_goes_back) {
  for (int trial = 0; trial < trials_of(45); ++trial) {
    const int owned_before = n_owned();
    riis_valve *valve = random_valve(trial % 3), *before = copy_of(valve);
    riis_surface_options options = surface_options(), then = surface_options();
    random_placement(&then);
    CHECK_OK(riis_valve_set_scalar(valve, "opening", between(0, 1)));
    CHECK_OK(riis_valve_set_scalar(before, "opening", between(0, 1)));
    riis_surface *on = new_surface(valve, &options), *back = new_surface(valve, &options);
    const double seconds = between(0.001, 1);
    CHECK_OK(riis_surface_update_moving(on, valve, before, seconds, NULL, trial % 2 ? &then : NULL));
    CHECK_OK(riis_surface_update_moving(back, valve, before, -seconds, NULL, trial % 2 ? &then : NULL));
    assert_true(largest_speed(on, -1) > 0);
    for (int64_t i = 0; i < 3 * triangles_of(on).n_vertices; ++i) CHECK_SAME(velocity_of(on)[i], -velocity_of(back)[i]);
    free_owned_after(owned_before);
  }
}

/* Moving a vertex back by its velocity gives a point of the earlier surface, on the same patch at the same u and v. */
TEST(vertices_come_from_their_place_before) {
  double worst = 0, worst_uv = 0;
  for (int trial = 0; trial < trials_of(36); ++trial) {
    const int owned_before = n_owned();
    riis_valve *valve = random_valve(0), *before = copy_of(valve);
    riis_surface_options options = surface_options(), then;
    options.tolerance = 0.05;
    then = options;
    if (trial == 0) /* changes several parameters at once */
      CHECK_OK(riis_valve_set_scalar(valve, "bending_height", 0.7));
    CHECK_OK(riis_valve_set_scalar(valve, "opening", trial % 4 ? between(0, 1) : 0));
    CHECK_OK(riis_valve_set_scalar(before, "opening", trial % 4 == 1 ? 1 : between(0, 1)));
    if (trial % 3 == 0) then.rotation_angle = 12, then.scale = 1.1;
    const double seconds = between(0.01, 1);
    then.tolerance = 0.01;
    riis_surface *surface = new_surface(valve, &options), *was = new_surface(before, &then);
    CHECK_OK(riis_surface_update_moving(surface, valve, before, seconds, NULL, &then));
    const riis_triangles c = triangles_of(surface), w = triangles_of(was);
    const double *velocity = velocity_of(surface);
    for (int64_t k = 0; k < 3 * c.n_triangles; k += 3) {
      const int64_t i = c.vertex_id[k];
      double p[3];
      for (int x = 0; x < 3; ++x) p[x] = c.xyz[3 * i + x] - seconds * velocity[3 * i + x];
      const riis_closest closest = closest_to(was, p[0], p[1], p[2]);
      worst = fmax(worst, closest.distance);
      const int64_t t = closest.triangle_id;
      if (w.patch_id[t] != c.patch_id[k / 3]) { /* the vertex is on a border, or at a place where patches touch */
        assert_true(closest.distance < 0.02);
        continue;
      }
      double place[2] = {0, 0};
      for (int x = 0; x < 6; ++x)
        place[x % 2] += closest.barycentric[x / 2] * w.uv[2 * w.vertex_id[3 * t + x / 2] + x % 2];
      /* At the root point, u is not defined. */
      const double off =
          fmax(fabs(place[1] - c.uv[2 * i + 1]), c.uv[2 * i + 1] > 0.2 ? fabs(place[0] - c.uv[2 * i]) : 0);
      worst_uv = fmax(worst_uv, off);
    }
    free_owned_after(owned_before);
  }
  printf("off the surface before by %.3g, off the place there by %.3g\n", worst, worst_uv);
  CHECK_AT_MOST(worst, 0.02);
  CHECK_AT_MOST(worst_uv, 0.1);
}

/* Steps of a thousandth give nearly the same speeds as steps of a fiftieth. Rounding and jumps hardly affect the longer steps. */
TEST(no_vertex_of_the_aortic_valve_is_an_outlier) {
  riis_valve *valve = random_valve(0), *before = copy_of(valve);
  riis_surface *surface = new_surface(valve, NULL);
  double largest[2] = {0, 0};
  for (int fine = 0; fine < 2; ++fine)
    for (int n = fine ? 1000 : 50, i = 1; i <= n; i += fine && is_short_test() ? 4 : 1) {
      CHECK_OK(riis_valve_set_scalar(before, "opening", (double)(i - 1) / n));
      CHECK_OK(riis_valve_set_scalar(valve, "opening", (double)i / n));
      CHECK_OK(riis_surface_update_moving(surface, valve, before, 1.0 / n, NULL, NULL));
      largest[fine] = fmax(largest[fine], largest_speed(surface, -1));
    }
  printf("largest speed in 1000 steps: %.6f per unit of opening, in 50: %.6f\n", largest[1], largest[0]);
  CHECK_AT_MOST(largest[1], 1.02 * largest[0]);
  CHECK_AT_MOST(0.98 * largest[0], largest[1]);
}

/* --- Copies ---------------------------------------------------------------------------------------------------------- */

TEST(a_copy_is_a_valve_of_its_own) {
  for (int64_t kind = 0; kind < 3; ++kind) {
    riis_valve *valve = random_valve(kind), *none = NULL;
    CHECK_OK(riis_valve_set_scalar(valve, "opening", 0.3));
    riis_valve *copy = copy_of(valve);
    riis_surface *a = new_surface(valve, NULL), *b = new_surface(copy, NULL);
    assert_true(is_same_content(a, b));
    CHECK_OK(riis_valve_set_scalar(valve, "opening", 0.6));
    CHECK_OK(riis_surface_update(b, copy, NULL));
    assert_true(is_same_content(a, b));
    free_one_owned(valve);
    CHECK_OK(riis_surface_update(b, copy, NULL)); /* the copied valve has its own second state */
    assert_true(is_same_content(a, b));
    CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "copy is NULL", riis_valve_copy(copy, NULL));
    CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "valve is NULL", riis_valve_copy(NULL, &none));
    CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "valve is a handle of another kind", riis_valve_copy((const void *)a, &none));
    assert_null(none);
  }
}

/* --- Refusals -------------------------------------------------------------------------------------------------------- */

typedef struct kept {
  const riis_surface *surface;
  const double *velocity, *xyz;
  double *values;
} kept;

static kept keep(const riis_surface *surface) {
  const riis_triangles c = triangles_of(surface);
  kept made = {surface, velocity_of(surface), c.xyz, own(malloc((size_t)c.n_vertices * 6 * sizeof(double)))};
  memcpy(made.values, made.xyz, (size_t)c.n_vertices * 3 * sizeof(double));
  memcpy(made.values + 3 * c.n_vertices, made.velocity, (size_t)c.n_vertices * 3 * sizeof(double));
  return made;
}

/* Checks that the arrays have the same address and the same values as before. */
static void check_kept(const kept *k) {
  const riis_triangles c = triangles_of(k->surface);
  assert_ptr_equal(velocity_of(k->surface), k->velocity);
  assert_ptr_equal(c.xyz, k->xyz);
  assert_memory_equal(k->values, k->xyz, (size_t)c.n_vertices * 3 * sizeof(double));
  assert_memory_equal(k->values + 3 * c.n_vertices, k->velocity, (size_t)c.n_vertices * 3 * sizeof(double));
}

TEST(refusals_leave_the_surface_as_it_was) {
  const strip shape = random_strip(1);
  riis_valve *aortic = random_valve(0), *before = copy_of(aortic), *mitral = random_valve(1),
             *patches = valve_of(&shape);
  CHECK_OK(riis_valve_set_scalar(aortic, "opening", 0.5));
  riis_surface *surface = new_surface(aortic, NULL);
  CHECK_OK(riis_surface_update_moving(surface, aortic, before, 0.5, NULL, NULL));
  kept all = keep(surface);
#define MOVING_REFUSED(status, parts, ...)                                          \
  do {                                                                              \
    CHECK_REFUSED(status, parts, riis_surface_update_moving(surface, __VA_ARGS__)); \
    check_kept(&all);                                                               \
  } while (0)
  static const struct {
    double seconds;
    const char *text;
  } times[] = {{0, "dt is 0;"},           {-0.0, "dt is -0;"},        {NAN, "dt is nan;"},
               {INFINITY, "dt is inf;"},  {-INFINITY, "dt is -inf;"}, {1e-40, "dt is 1e-40;"},
               {-1e-40, "dt is -1e-40;"}, {1e31, "dt is 1e+31;"}};
  for (size_t i = 0; i < sizeof times / sizeof *times; ++i)
    MOVING_REFUSED(RIIS_INVALID_ARGUMENT, times[i].text, aortic, before, times[i].seconds, NULL, NULL);
  CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "surface is NULL",
                riis_surface_update_moving(NULL, aortic, before, 1, NULL, NULL));
  MOVING_REFUSED(RIIS_INVALID_ARGUMENT, "valve is NULL", NULL, before, 1, NULL, NULL);
  MOVING_REFUSED(RIIS_INVALID_ARGUMENT, "valve_before is NULL", aortic, NULL, 1, NULL, NULL);
  MOVING_REFUSED(RIIS_INVALID_ARGUMENT, "valve_before is a handle of another kind", aortic, (const void *)surface, 1,
                 NULL, NULL);
  MOVING_REFUSED(RIIS_INVALID_PARAMETER, "valve_before is of the kind mitral|aortic", aortic, mitral, 1, NULL, NULL);
  MOVING_REFUSED(RIIS_INVALID_PARAMETER, "valve_before is of the kind patches|aortic", aortic, patches, 1, NULL, NULL);
  MOVING_REFUSED(RIIS_INVALID_PARAMETER, "valve_before is of the kind aortic|mitral", mitral, aortic, 1, NULL, NULL);

  /* An earlier state that is not a valid valve. */
  riis_valve *bad = copy_of(before);
  CHECK_OK(riis_valve_set_scalar(bad, "bending_height", 1));
  MOVING_REFUSED(RIIS_INVALID_PARAMETER, "in valve_before: bending_height is 1;", aortic, bad, 1, NULL, NULL);
  MOVING_REFUSED(RIIS_INVALID_PARAMETER, "bending_height is 1;", bad, aortic, 1, NULL, NULL);
  assert_null(strstr(riis_last_error(), "valve_before"));
  bad = new_valve("aortic");
  CHECK_OK(riis_valve_set_scalar(bad, "opening", 0.25));
  CHECK_OK(riis_valve_set_scalar(bad, "left.leaflet_radius_out", 5));
  CHECK_OK(riis_valve_set_scalar(bad, "commissure_expansion", 0.5));
  MOVING_REFUSED(RIIS_INVALID_PARAMETER, "in valve_before: in the open state, the left cusp", aortic, bad, 1, NULL,
                 NULL);

  /* Wrong options are refused. If an option belongs to the earlier placement, the message says so. */
  riis_surface_options options = surface_options();
#define BEFORE_REFUSED(change, parts)                                             \
  do {                                                                            \
    riis_surface_options then = surface_options();                                \
    then.change;                                                                  \
    MOVING_REFUSED(RIIS_INVALID_ARGUMENT, parts, aortic, before, 1, NULL, &then); \
  } while (0)
  BEFORE_REFUSED(scale = 0, "options_before.scale is 0;|from 1e-12 to 1e+12");
  BEFORE_REFUSED(scale = -1, "options_before.scale is -1;");
  BEFORE_REFUSED(scale = NAN, "options_before.scale is nan;");
  BEFORE_REFUSED(rotation_angle = 2e6, "options_before.rotation_angle is 2e+06;");
  BEFORE_REFUSED(rotation_axis[2] = 0, "options_before.rotation_axis is (0, 0, 0);");
  BEFORE_REFUSED(rotation_axis[1] = INFINITY, "options_before.rotation_axis is inf;");
  BEFORE_REFUSED(translation[1] = 1e51, "options_before.translation is 1e+51;");
  riis_surface_options then = surface_options();
  then.struct_size = 8;
  MOVING_REFUSED(RIIS_INVALID_STRUCT_SIZE, "options_before is 8;", aortic, before, 1, NULL, &then);
  options.scale = 0;
  MOVING_REFUSED(RIIS_INVALID_ARGUMENT, "options.scale is 0;", aortic, before, 1, &options, NULL);
  options = surface_options();
  options.half_thickness = 1e-3, options.tolerance = 1e-6; /* a fault that is found only after the curves are made */
  MOVING_REFUSED(RIIS_LIMIT_EXCEEDED, "16777216 triangles", aortic, before, 1, &options, NULL);

  /* Patches with different curves. */
  CHECK_OK(riis_surface_update_moving(surface, patches, patches, 1, NULL, NULL));
  all = keep(surface);
  static const int32_t degree[4] = {1, 1, 1, 1}, sides[4] = {0, 1, 2, 3};
  static const double square[24] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0, 0, 0, 0, 0, 1, 0, 1, 0, 0, 1, 1, 0};
  riis_patches other;
  CHECK_OK(riis_patches_init(&other, sizeof other));
  other.n_curves = 4, other.n_patches = 1;
  other.degree = degree, other.control = square, other.curve_id = sides;
  CHECK_OK(riis_valve_create_from_patches(&other, &bad));
  own(bad);
  MOVING_REFUSED(RIIS_INVALID_PARAMETER, "valve_before has 4 curves and 1 patches|10 and 3", patches, bad, 1, NULL,
                 NULL);
  /* The surface still works after the refusals. */
  CHECK_OK(riis_surface_update_moving(surface, patches, patches, 1, NULL, NULL));
}

int main(void) {
  rng = random_start("test_motion");
  return run_cases(NULL, NULL);
}
