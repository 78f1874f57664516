/* SPDX-License-Identifier: Apache-2.0
 * Tests warps. The map is compared with a separate solution of its equations. Warped valves are compared with the map and with
 * placed valves. Further cases test folds, an annulus that moves, and the patches that are read out. */
#include <riis/riis.h>

#include "test_support.h"

#include "handles.h"
#include "moving_surfaces.h"
#include "searches.h"

#include "random_meshes.h"
#include "shapes.h"
#include "velocity_bound.h"

static random_source rng;

#include "flood_fill.h"

static double between(double low, double high) { return random_between(&rng, low, high); }

enum { max_landmarks = 60 };

static const char *const kinds[5] = {"trileaflet", "aortic", "mitral", "mitral_coapting", "tricuspid"};

static riis_warp *new_warp(int64_t n, const double *xyz, double noise, const riis_surface_options *placement) {
  riis_warp_options options;
  riis_warp *warp = NULL;
  const riis_points points = points_at(n, xyz);
  CHECK_OK(riis_warp_options_init(&options, sizeof options));
  options.noise = noise;
  options.placement = placement;
  CHECK_OK(riis_warp_create(&points, &options, &warp));
  return own(warp);
}

static riis_status set_targets(riis_warp *warp, int64_t n, const double *xyz) {
  const riis_points points = points_at(n, xyz);
  return riis_warp_set_targets(warp, &points);
}

static void map_point(const riis_warp *warp, const double *from, double *to) {
  const riis_points points = points_at(1, from);
  CHECK_OK(riis_warp_map(warp, &points, to));
}

static riis_warp_info info_of_warp(const riis_warp *warp) {
  riis_warp_info info;
  CHECK_OK(riis_warp_get_info(warp, &info, sizeof info));
  return info;
}

static double distance3(const double *a, const double *b) {
  return sqrt(pow(a[0] - b[0], 2) + pow(a[1] - b[1], 2) + pow(a[2] - b[2], 2));
}

/* An affine map x -> linear x + shift, row by row. */
typedef struct {
  double linear[3][3], shift[3];
} affine;

static void apply(const affine *map, const double *x, double *y) {
  double made[3];
  for (int i = 0; i < 3; ++i) {
    made[i] = map->shift[i];
    for (int k = 0; k < 3; ++k) made[i] += map->linear[i][k] * x[k];
  }
  memcpy(y, made, sizeof made);
}

static affine random_affine(double size) {
  affine map;
  for (int i = 0; i < 3; ++i) {
    for (int k = 0; k < 3; ++k) map.linear[i][k] = (i == k) + between(-size, size);
    map.shift[i] = between(-1, 1);
  }
  return map;
}

static riis_surface_options random_placement(int32_t triangulation) {
  riis_surface_options options = surface_options();
  options.triangulation = triangulation;
  options.rotation_angle = between(-180, 180);
  for (int c = 0; c < 3; ++c) options.rotation_axis[c] = between(0.1, 1), options.translation[c] = between(-5, 5);
  return options;
}

/* The map of a placement, from Rodrigues' formula. */
static affine map_of(const riis_surface_options *options) {
  const double *a = options->rotation_axis, size = sqrt(a[0] * a[0] + a[1] * a[1] + a[2] * a[2]);
  const double angle = options->rotation_angle * acos(-1) / 180, c = cos(angle), s = sin(angle);
  const double k[3] = {a[0] / size, a[1] / size, a[2] / size};
  const double cross[3][3] = {{0, -k[2], k[1]}, {k[2], 0, -k[0]}, {-k[1], k[0], 0}};
  affine map;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j)
      map.linear[i][j] = options->scale * ((i == j) * c + s * cross[i][j] + (1 - c) * k[i] * k[j]);
    map.shift[i] = options->translation[i];
  }
  return map;
}

/* Makes landmarks along the attachment of a valve's surface, at every few vertices. Returns their number. */
static int64_t landmarks_on(const riis_surface *surface, int64_t n_wanted, double *xyz) {
  riis_attachment attachment;
  CHECK_OK(riis_surface_get_attachment(surface, &attachment, sizeof attachment));
  int64_t n = 0;
  for (int64_t k = 0; k < n_wanted; ++k) {
    const double *point = attachment.edges + 6 * (k * attachment.n_edges / n_wanted);
    int is_new = 1;
    for (int64_t i = 0; i < n; ++i) is_new = is_new && distance3(xyz + 3 * i, point) > 0.05;
    if (is_new) memcpy(xyz + 3 * n++, point, 3 * sizeof *xyz);
  }
  return n;
}

/* The landmarks lie near the attachment, but not on it. Landmarks off the attachment cut no curve, so a warped curve keeps its
 * spans. */
static int64_t landmarks_beside(const riis_surface *surface, int64_t n_wanted, double *xyz) {
  const int64_t n = landmarks_on(surface, n_wanted, xyz);
  for (int64_t i = 0; i < n; ++i)
    for (int c = 0; c < 2; ++c) xyz[3 * i + c] *= 1.3;
  return n;
}

/* A smooth deformation of a root, which widens, tilts and becomes oval. */
static void deform(const double *x, double size, double *y) {
  const double made[3] = {x[0] * (1 + size) + size * x[1] * x[2], x[1] * (1 - 0.7 * size) + 0.5 * size * x[0] * x[0],
                          x[2] * (1 + 0.5 * size) + size * (x[0] - 0.6 * x[1] * x[0])};
  memcpy(y, made, sizeof made);
}

static double distance_to(const riis_surface *surface, const double *p) {
  riis_closest closest;
  CHECK_OK(riis_closest_point(surface, p, &closest, sizeof closest));
  return closest.distance;
}

/* --- The map ---------------------------------------------------------------------------------------------------------- */

/* Solves the whole system [K P; P^T 0] by elimination with pivots, as textbooks do. */
static void solve_dense(int n, double *a, double *b) {
  for (int k = 0; k < n; ++k) {
    int pivot = k;
    for (int i = k + 1; i < n; ++i)
      if (fabs(a[i * n + k]) > fabs(a[pivot * n + k])) pivot = i;
    for (int j = 0; j < n; ++j) {
      const double swap = a[k * n + j];
      a[k * n + j] = a[pivot * n + j], a[pivot * n + j] = swap;
    }
    for (int c = 0; c < 3; ++c) {
      const double swap = b[3 * k + c];
      b[3 * k + c] = b[3 * pivot + c], b[3 * pivot + c] = swap;
    }
    for (int i = k + 1; i < n; ++i) {
      const double factor = a[i * n + k] / a[k * n + k];
      for (int j = k; j < n; ++j) a[i * n + j] -= factor * a[k * n + j];
      for (int c = 0; c < 3; ++c) b[3 * i + c] -= factor * b[3 * k + c];
    }
  }
  for (int k = n - 1; k >= 0; --k)
    for (int c = 0; c < 3; ++c) {
      for (int j = k + 1; j < n; ++j) b[3 * k + c] -= a[k * n + j] * b[3 * j + c];
      b[3 * k + c] /= a[k * n + k];
    }
}

TEST(the_map_solves_its_equations) {
  for (int trial = 0; trial < trials_of(60); ++trial) {
    const int owned_before = n_owned(), n = 5 + (int)between(0, 40), m = n + 4;
    double from[3 * max_landmarks], to[3 * max_landmarks], probe[3], got[3];
    double *a = own(calloc((size_t)(m * m), sizeof *a)), *b = own(calloc((size_t)(3 * m), sizeof *b));
    const double unit = random_power_of_ten(&rng, -3, 3), noise = trial % 2 ? 0.02 * unit : 0;
    for (int i = 0; i < 3 * n; ++i) from[i] = unit * between(-1, 1), to[i] = from[i] + 0.1 * unit * between(-1, 1);
    riis_warp *warp = new_warp(n, from, noise, NULL);
    const riis_status status = set_targets(warp, n, to);
    if (status == RIIS_INVALID_PARAMETER) { /* the map may fold, because these targets are wild */
      free_owned_after(owned_before);
      continue;
    }
    CHECK_OK(status);
    const riis_warp_info info = info_of_warp(warp);
    assert_int_equal(info.n_landmarks, n);
    if (info.is_planar) { /* a few landmarks may be nearly in a plane, where the map has other equations */
      free_owned_after(owned_before);
      continue;
    }
    assert_true((info.smoothing == 0) == (noise == 0));
    if (noise == 0) {
      CHECK_AT_MOST(info.largest_residual, 1e-11 * unit);
    } else if (isfinite(info.smoothing)) {
      CHECK_NEAR(info.rms_residual, sqrt(0.6 * 3 * (n - 4.0) / n) * noise, 1e-6 * noise);
    }
    if (isfinite(info.smoothing)) {
      /* The library's smoothing parameter lambda is for coordinates in units of the largest root mean square extent. The test
       * instead computes lambda from the residuals. Because K w + P c + residual is the target, each residual is lambda times the
       * weight of its landmark. */
      for (int i = 0; i < n; ++i) {
        for (int k = 0; k < n; ++k) a[i * m + k] = pow(distance3(from + 3 * i, from + 3 * k) / unit, 3);
        for (int k = 0; k < 4; ++k) a[i * m + n + k] = a[(n + k) * m + i] = k == 0 ? 1 : from[3 * i + k - 1] / unit;
        double mapped[3];
        map_point(warp, from + 3 * i, mapped);
        for (int c = 0; c < 3; ++c) b[3 * i + c] = mapped[c] / unit; /* the map interpolates its own values */
      }
      solve_dense(m, a, b);
      double factor = 0, weights = 0;
      for (int i = 0; i < n; ++i) {
        double mapped[3];
        map_point(warp, from + 3 * i, mapped);
        for (int c = 0; c < 3; ++c)
          factor += b[3 * i + c] * (to[3 * i + c] - mapped[c]) / unit, weights += b[3 * i + c] * b[3 * i + c];
      }
      factor /= weights; /* lambda in these units */
      for (int i = 0; i < n && noise > 0; ++i) {
        double mapped[3];
        map_point(warp, from + 3 * i, mapped);
        for (int c = 0; c < 3; ++c) CHECK_NEAR((to[3 * i + c] - mapped[c]) / unit, factor * b[3 * i + c], 1e-6);
      }
      for (int k = 0; k < 20; ++k) {
        double expected[3] = {0, 0, 0};
        for (int c = 0; c < 3; ++c) probe[c] = unit * between(-1.2, 1.2);
        map_point(warp, probe, got);
        for (int i = 0; i < n; ++i)
          for (int c = 0; c < 3; ++c) expected[c] += b[3 * i + c] * pow(distance3(probe, from + 3 * i) / unit, 3);
        for (int c = 0; c < 3; ++c) {
          expected[c] += b[3 * n + c];
          for (int j = 0; j < 3; ++j) expected[c] += b[3 * (n + 1 + j) + c] * probe[j] / unit;
          CHECK_NEAR(got[c] / unit, expected[c], 1e-7);
        }
      }
    }
    free_owned_after(owned_before);
  }
}

TEST(affine_and_planar_maps_are_reproduced) {
  for (int trial = 0; trial < trials_of(90); ++trial) {
    const int owned_before = n_owned(), n = 8 + (int)between(0, 30), is_planar = trial % 2;
    const affine turn = {.linear = {{0.6, 0, 0.8}, {0, 1, 0}, {-0.8, 0, 0.6}}, .shift = {1, 2, 3}};
    double from[3 * max_landmarks], to[3 * max_landmarks];
    affine map = random_affine(0.2);
    const double stretch = between(0.5, 2);
    if (is_planar) /* across a plane, only similar maps are determined */
      for (int i = 0; i < 3; ++i)
        for (int k = 0; k < 3; ++k) map.linear[i][k] = stretch * turn.linear[i][k];
    for (int i = 0; i < n; ++i) {
      const double x[3] = {between(-1, 1), between(-1, 1), is_planar ? 0.3 : between(-1, 1)};
      apply(&turn, x, from + 3 * i);
      apply(&map, from + 3 * i, to + 3 * i);
    }
    riis_warp *warp = new_warp(n, from, trial % 3 ? 0 : 0.01, NULL);
    assert_int_equal(info_of_warp(warp).is_planar, is_planar);
    CHECK_OK(set_targets(warp, n, to));
    for (int k = 0; k < 10; ++k) {
      double probe[3], got[3], expected[3];
      for (int c = 0; c < 3; ++c) probe[c] = between(-3, 3);
      map_point(warp, probe, got);
      apply(&map, probe, expected);
      for (int c = 0; c < 3; ++c) CHECK_NEAR(got[c], expected[c], 1e-9);
    }
    free_owned_after(owned_before);
  }
}

/* The derivatives of |r|^3 do not jump. A warped line through a landmark therefore has no kink. The line's direction changes
 * little over a short step. */
TEST(a_landmark_adds_no_kink) {
  double worst = 0;
  for (int trial = 0; trial < trials_of(30); ++trial) {
    const int owned_before = n_owned(), n = 30;
    double from[3 * max_landmarks], to[3 * max_landmarks];
    for (int i = 0; i < n; ++i) {
      const double angle = 2 * acos(-1) * i / n;
      const double at[3] = {1.2 * cos(angle), 1.2 * sin(angle), 0.4 * cos(3 * angle)};
      for (int c = 0; c < 3; ++c) from[3 * i + c] = at[c], to[3 * i + c] = at[c] + between(-0.05, 0.05);
    }
    riis_warp *warp = new_warp(n, from, 0, NULL);
    CHECK_OK(set_targets(warp, n, to));
    for (int i = 0; i < n; ++i) {
      const double step = 1e-4, along[3] = {between(-1, 1), between(-1, 1), between(-1, 1)};
      double p[3][3], product = 0, sizes[2] = {0, 0};
      for (int k = 0; k < 3; ++k) {
        double at[3];
        for (int c = 0; c < 3; ++c) at[c] = from[3 * i + c] + (k - 1) * step * along[c];
        map_point(warp, at, p[k]);
      }
      for (int c = 0; c < 3; ++c) {
        const double before = p[1][c] - p[0][c], after = p[2][c] - p[1][c];
        product += before * after, sizes[0] += before * before, sizes[1] += after * after;
      }
      worst = fmax(worst, acos(fmin(1, product / sqrt(sizes[0] * sizes[1]))) * 180 / acos(-1));
    }
    free_owned_after(owned_before);
  }
  printf("largest kink at a landmark: %g degrees\n", worst);
  CHECK_AT_MOST(worst, 0.1);
}

/* --- Warped valves ---------------------------------------------------------------------------------------------------- */

TEST(an_identity_changes_nothing) {
  for (int trial = 0; trial < trials_of(36); trial += trial_step()) {
    const int owned_before = n_owned();
    const riis_surface_options options = random_placement(trial % 4 == 3);
    riis_valve *valve = new_valve(kinds[trial % 3]);
    CHECK_OK(riis_valve_set_scalar(valve, "opening", trial < 3 ? 0 : trial < 6 ? 1 : between(0, 1)));
    riis_surface *plain = new_surface(valve, &options), *surface;
    double from[3 * max_landmarks];
    /* A curve that is cut may get other vertices. The surface stays the same within its error. */
    const int is_cut = trial % 4 == 2, is_fixed = trial % 4 == 3;
    const int64_t n = is_cut ? landmarks_on(plain, 30, from) : landmarks_beside(plain, 30, from);
    riis_warp *warp = new_warp(n, from, 0, &options);
    CHECK_OK(riis_valve_set_warp(valve, warp, NULL));
    surface = new_surface(valve, &options);
    const riis_triangles a = triangles_of(plain), b = triangles_of(surface);
    if (is_cut || is_fixed) { /* the fixed triangulation of a warped valve is finer, so that the warp may move */
      const double allowed = info_of(plain).error_bound + info_of(surface).error_bound + 1e-9;
      for (int64_t i = 0; i < a.n_vertices; i += 3) CHECK_AT_MOST(distance_to(surface, a.xyz + 3 * i), allowed);
      for (int64_t i = 0; i < b.n_vertices; i += 3) CHECK_AT_MOST(distance_to(plain, b.xyz + 3 * i), allowed);
      free_owned_after(owned_before);
      continue;
    }
    assert_int_equal(a.n_vertices, b.n_vertices);
    assert_int_equal(a.n_triangles, b.n_triangles);
    for (int64_t i = 0; i < 3 * a.n_vertices; ++i) CHECK_NEAR(a.xyz[i], b.xyz[i], 1e-12 * 20);
    assert_memory_equal(a.vertex_id, b.vertex_id, (size_t)a.n_triangles * 3 * sizeof *a.vertex_id);
    assert_memory_equal(a.leaflet_id, b.leaflet_id, (size_t)a.n_triangles * sizeof *a.leaflet_id);
    assert_memory_equal(a.patch_id, b.patch_id, (size_t)a.n_triangles * sizeof *a.patch_id);
    /* NULL removes the warp. */
    CHECK_OK(riis_valve_set_warp(valve, NULL, NULL));
    assert_true(is_same_content(plain, new_surface(valve, &options)));
    free_owned_after(owned_before);
  }
}

/* A rigid warp gives the same shape as the placement. Points of either surface lie on the other surface, within the errors of
 * both surfaces. The orifice, the swept volume and the attachment also agree. */
TEST(a_rigid_warp_equals_a_placement) {
  for (int trial = 0; trial < trials_of(27); trial += trial_step()) {
    const int owned_before = n_owned();
    const char *kind = kinds[trial % 3];
    const riis_surface_options placed = random_placement(trial >= 6);
    riis_surface_options in_place = surface_options();
    in_place.triangulation = placed.triangulation;
    const affine map = map_of(&placed);
    riis_valve *valve = new_valve(kind);
    CHECK_OK(riis_valve_set_scalar(valve, "opening", trial < 3 ? 0 : between(0, 1)));
    riis_surface *expected = new_surface(valve, &placed);
    double from[3 * max_landmarks], to[3 * max_landmarks], swept[2];
    const int64_t n = landmarks_on(new_surface(valve, &in_place), 30, from);
    for (int64_t i = 0; i < n; ++i) apply(&map, from + 3 * i, to + 3 * i);
    CHECK_OK(riis_valve_get_swept_volume(valve, 0.2, 0.7, &placed, RIIS_ALL_LEAFLETS, swept));
    riis_warp *warp = new_warp(n, from, 0, NULL);
    CHECK_OK(set_targets(warp, n, to));
    CHECK_OK(riis_valve_set_warp(valve, warp, NULL));
    riis_surface *got = new_surface(valve, &in_place);
    CHECK_OK(riis_valve_get_swept_volume(valve, 0.2, 0.7, &in_place, RIIS_ALL_LEAFLETS, swept + 1));
    CHECK_NEAR(swept[0], swept[1], 1e-6 * (1 + fabs(swept[0])));
    const double allowed = info_of(got).error_bound + info_of(expected).error_bound + 1e-9;
    const riis_triangles a = triangles_of(got), b = triangles_of(expected);
    for (int64_t i = 0; i < a.n_vertices; i += 7) CHECK_AT_MOST(distance_to(expected, a.xyz + 3 * i), allowed);
    for (int64_t i = 0; i < b.n_vertices; i += 7) CHECK_AT_MOST(distance_to(got, b.xyz + 3 * i), allowed);
    riis_orifice orifice[2];
    CHECK_OK(riis_surface_get_orifice(expected, NULL, orifice, sizeof *orifice));
    CHECK_OK(riis_surface_get_orifice(got, NULL, orifice + 1, sizeof *orifice));
    assert_int_equal(orifice[0].outline, orifice[1].outline);
    /* The axis follows from the triangles, which differ. */
    CHECK_NEAR(orifice[0].outline_area, orifice[1].outline_area, 2e-3 * orifice[0].outline_area);
    CHECK_NEAR(orifice[0].area, orifice[1].area, 0.02 * orifice[0].outline_area);
    for (int c = 0; c < 3; ++c) CHECK_NEAR(orifice[0].axis[c], orifice[1].axis[c], 2e-3);
    free_owned_after(owned_before);
  }
}

/* Curves of warped valves are compared with the map. The compared values are the curves' ends, the directions of the end
 * tangents, and the distance from the mapped curve. A curve that is not warped must equal the plain valve's curve. */
static riis_valve_patches patches_of(riis_valve *valve) {
  riis_valve_patches patches;
  CHECK_OK(riis_valve_get_patches(valve, &patches, sizeof patches));
  return patches;
}

TEST(warped_curves_are_near_mapped_curves) {
  double worst = 0, worst_angle = 0;
  for (int trial = 0; trial < trials_of(36); trial += trial_step()) {
    const int owned_before = n_owned();
    riis_valve *valve = new_valve(kinds[trial % 3]), *warped = NULL;
    CHECK_OK(riis_valve_set_scalar(valve, "opening", trial < 3 ? 0 : between(0, 1)));
    double from[3 * max_landmarks], to[3 * max_landmarks];
    const int64_t n = landmarks_beside(new_surface(valve, NULL), 30, from);
    const double size = between(-0.15, 0.15);
    for (int64_t i = 0; i < n; ++i) deform(from + 3 * i, size, to + 3 * i);
    riis_warp *warp = new_warp(n, from, 0, NULL);
    CHECK_OK(set_targets(warp, n, to));
    CHECK_OK(riis_valve_copy(valve, &warped));
    own(warped);
    CHECK_OK(riis_valve_set_warp(warped, warp, NULL));
    riis_valve *copy = NULL; /* copies have the warp */
    CHECK_OK(riis_valve_copy(warped, &copy));
    own(copy);
    assert_true(is_same_content(new_surface(warped, NULL), new_surface(copy, NULL)));
    const riis_valve_patches a = patches_of(valve), b = patches_of(warped);
    assert_true(a.n_curves == b.n_curves && a.n_pieces == b.n_pieces && a.n_patches == b.n_patches);
    char *is_arc = own(calloc((size_t)a.n_curves, 1));
    for (int64_t i = 0; i < a.n_patches; ++i) {
      assert_true((a.bulge[i] == 0) == (trial % 3 != 2));
      assert_memory_equal(a.curve_id + 4 * i, b.curve_id + 4 * i, 4 * sizeof *a.curve_id);
      if (a.bulge[i] != 0) is_arc[a.curve_id[4 * i + 2]] = is_arc[a.curve_id[4 * i + 3]] = 1;
    }
    const double *p = a.control, *q = b.control;
    int64_t curve = 0;
    for (int64_t i = 0; i < a.n_pieces; ++i) {
      while (a.first_piece[curve + 1] <= i) ++curve;
      for (int k = 0; k <= 8; ++k) {
        double x[3], mapped[3], y[3];
        evaluate(p, a.degree[i], k / 8.0, x);
        evaluate(q, b.degree[i], k / 8.0, y);
        map_point(warp, x, mapped);
        if (k % 8 == 0) CHECK_AT_MOST(distance3(mapped, y), 1e-12);
        if (!is_arc[curve]) worst = fmax(worst, distance3(mapped, y));
      }
      for (int end = 0; end < 2 && !is_arc[curve] && distance3(p, p + 3) > 1e-6; ++end) {
        const double *at = p + 3 * (end ? a.degree[i] : 0), *next = p + 3 * (end ? a.degree[i] - 1 : 1);
        const double *to_at = q + 3 * (end ? b.degree[i] : 0), *to_next = q + 3 * (end ? b.degree[i] - 1 : 1);
        double near[3], mapped[2][3], product = 0;
        if (distance3(at, next) < 1e-6) continue;
        for (int c = 0; c < 3; ++c) near[c] = at[c] + 1e-6 * (next[c] - at[c]);
        map_point(warp, at, mapped[0]);
        map_point(warp, near, mapped[1]);
        for (int c = 0; c < 3; ++c) product += (mapped[1][c] - mapped[0][c]) * (to_next[c] - to_at[c]);
        product /= distance3(mapped[0], mapped[1]) * distance3(to_at, to_next);
        worst_angle = fmax(worst_angle, acos(fmin(1, product)));
      }
      p += 3 * (a.degree[i] + 1), q += 3 * (b.degree[i] + 1);
    }
    free_owned_after(owned_before);
  }
  printf("curves are up to %g from mapped curves, end tangents up to %g degrees\n", worst,
         worst_angle * 180 / acos(-1));
  CHECK_AT_MOST(worst, 0.03);
  CHECK_AT_MOST(worst_angle, 1e-3);
}

/* A valve of Coons patches equals the valve that is made from its own patches. */
TEST(patches_make_the_same_valve) {
  for (int trial = 0; trial < trials_of(36); ++trial) {
    const int owned_before = n_owned(), is_warped = trial / 2 % 2;
    riis_valve *valve = new_valve(kinds[trial % 2]), *again = NULL;
    CHECK_OK(riis_valve_set_scalar(valve, "opening", trial < 4 ? 0 : between(0, 1)));
    riis_surface *plain = new_surface(valve, NULL);
    if (is_warped) {
      double from[3 * max_landmarks], to[3 * max_landmarks];
      const int64_t n = landmarks_beside(plain, 30, from);
      for (int64_t i = 0; i < n; ++i) deform(from + 3 * i, 0.1, to + 3 * i);
      riis_warp *warp = new_warp(n, from, 0, NULL);
      CHECK_OK(set_targets(warp, n, to));
      CHECK_OK(riis_valve_set_warp(valve, warp, NULL));
    }
    const riis_valve_patches got = patches_of(valve);
    assert_int_equal(got.n_pieces, got.n_curves);
    assert_int_equal(got.n_patches, 12);
    riis_patches patches;
    CHECK_OK(riis_patches_init(&patches, sizeof patches));
    patches.n_curves = got.n_curves, patches.degree = got.degree, patches.control = got.control;
    patches.n_patches = got.n_patches, patches.curve_id = got.curve_id, patches.reversed = got.reversed;
    patches.leaflet_id = got.leaflet_id;
    CHECK_OK(riis_valve_create_from_patches(&patches, &again));
    own(again);
    riis_surface *surface = new_surface(valve, NULL), *other = new_surface(again, NULL);
    const double allowed = info_of(surface).error_bound + info_of(other).error_bound + 1e-9;
    const riis_triangles a = triangles_of(surface), b = triangles_of(other);
    CHECK_NEAR(info_of(surface).area, info_of(other).area, 0.01 * info_of(surface).area);
    for (int64_t i = 0; i < a.n_vertices; i += 7) CHECK_AT_MOST(distance_to(other, a.xyz + 3 * i), allowed);
    for (int64_t i = 0; i < b.n_vertices; i += 7) CHECK_AT_MOST(distance_to(surface, b.xyz + 3 * i), allowed);
    /* Normals point to the same side. */
    for (int64_t i = 0; i < a.n_triangles; i += 5) {
      const double *v[3] = {a.xyz + 3 * a.vertex_id[3 * i], a.xyz + 3 * a.vertex_id[3 * i + 1],
                            a.xyz + 3 * a.vertex_id[3 * i + 2]};
      double middle[3], product = 0;
      for (int c = 0; c < 3; ++c) middle[c] = (v[0][c] + v[1][c] + v[2][c]) / 3;
      const riis_closest one = closest_to(surface, middle[0], middle[1], middle[2]),
                         two = closest_to(other, middle[0], middle[1], middle[2]);
      for (int c = 0; c < 3; ++c) product += one.normal[c] * two.normal[c];
      if (one.leaflet_id == two.leaflet_id) assert_true(product > 0);
    }
    free_owned_after(owned_before);
  }
}

/* The warped annulus of a mitral valve has separate landmarks in the closed and the open state. In either state the annulus
 * passes through its landmarks. */
TEST(closed_and_open_landmarks_are_met) {
  for (int trial = 0; trial < trials_of(18); ++trial) {
    const int owned_before = n_owned();
    const char *kind = kinds[trial % 3];
    double from[2][3 * max_landmarks], to[2][3 * max_landmarks];
    int64_t n[2];
    riis_warp *warp[2];
    riis_valve *valve = new_valve(kind);
    if (trial % 3 != 2) CHECK_OK(riis_valve_set_open_state(valve, new_valve(kind)));
    for (int s = 0; s < 2; ++s) {
      CHECK_OK(riis_valve_set_scalar(valve, "opening", s));
      n[s] = landmarks_on(new_surface(valve, NULL), 40, from[s]);
      for (int64_t i = 0; i < n[s]; ++i) deform(from[s] + 3 * i, s ? 0.1 : -0.08, to[s] + 3 * i);
      warp[s] = new_warp(n[s], from[s], 0, NULL);
      CHECK_OK(set_targets(warp[s], n[s], to[s]));
    }
    if (trial % 3 == 2) assert_true(!info_of_warp(warp[0]).is_planar && info_of_warp(warp[1]).is_planar);
    CHECK_OK(riis_valve_set_warp(valve, warp[0], warp[1]));
    for (int s = 0; s < 2; ++s) {
      CHECK_OK(riis_valve_set_scalar(valve, "opening", s));
      riis_surface *surface = new_surface(valve, NULL);
      for (int64_t i = 0; i < n[s]; ++i) CHECK_AT_MOST(distance_to(surface, to[s] + 3 * i), 0.006);
    }
    free_owned_after(owned_before);
  }
}

/* --- In a mesh -------------------------------------------------------------------------------------------------------- */

/* One warp moves the valve and the mesh of its root. The closed valve separates the mesh, and the open valve does not. A saddle's
 * annulus is not a circle, so its skirt closes the gap to the wall. */
TEST(warped_valves_seal) {
  static const char *const sealing[3] = {"trileaflet", "mitral_coapting", "tricuspid"};
  for (int trial = 0; trial < 6; ++trial) {
    const int owned_before = n_owned(), is_saddle = trial >= 2;
    riis_valve *valve = new_valve(sealing[trial / 2]);
    if (is_saddle) CHECK_OK(riis_valve_set_scalar(valve, "skirt_length", 1));
    double from[3 * max_landmarks], to[3 * max_landmarks];
    const int64_t n = landmarks_on(new_surface(valve, NULL), 30, from);
    const double size = between(-0.12, 0.12);
    for (int64_t i = 0; i < 3 * n; i += 3) {
      deform(from + i, size, to + i);
      for (int c = 0; c < 3; ++c) to[i + c] += between(-0.02, 0.02);
    }
    riis_warp *warp = new_warp(n, from, trial % 2 ? 0.02 : 0, NULL);
    CHECK_OK(set_targets(warp, n, to));
    CHECK_OK(riis_valve_set_warp(valve, warp, NULL));
    const double top = is_saddle ? 1.9 : 1.5, bottom = is_saddle ? -3.2 : -2.4;
    test_mesh nodes = tube(is_saddle ? 1.8 : 1.2, bottom, top, is_saddle ? 0.14 : 0.1);
    int64_t ends[2] = {0, 0};
    for (int64_t i = 0; i < nodes.n; ++i)
      for (int end = 0; end < 2; ++end) {
        const double at[3] = {0, 0, end ? top : bottom};
        if (distance3(nodes.xyz + 3 * i, at) < distance3(nodes.xyz + 3 * ends[end], at)) ends[end] = i;
      }
    const riis_points points = points_at(nodes.n, nodes.xyz);
    CHECK_OK(riis_warp_map(warp, &points, nodes.xyz));
    riis_mesh *mesh = mesh_from(&nodes);
    for (int is_open = 0; is_open < 2; ++is_open) {
      riis_surface_options options = surface_options();
      options.half_thickness = is_saddle ? 0.2 : 0.14;
      riis_passage passage;
      CHECK_OK(riis_valve_set_scalar(valve, "opening", is_open ? (is_saddle ? 0.6 : 0.3) : 0));
      riis_surface *surface = new_surface(valve, &options);
      CHECK_OK(find_passage_between(surface, mesh, NULL, 1, ends, 1, ends + 1, &passage, sizeof passage));
      assert_int_equal(passage.state == RIIS_PASSAGE_OPEN, is_open);
    }
    free_owned_after(owned_before);
  }
}

/* --- An annulus that moves -------------------------------------------------------------------------------------------- */

/* A step of a moving annulus. The maps at both times of the step come from separate warps. */
typedef struct {
  riis_valve *now, *before;           /* warped */
  riis_valve *rest_now, *rest_before; /* the same without warps */
  riis_warp *map_now, *map_before;
  double seconds;
} warped_step;

static riis_valve *valve_at(const riis_valve *valve, double opening) {
  riis_valve *made = NULL;
  CHECK_OK(riis_valve_copy(valve, &made));
  CHECK_OK(riis_valve_set_scalar(own(made), "opening", opening));
  return made;
}

static warped_step new_step(const char *kind, double opening, double opening_before,
                            const riis_surface_options *options) {
  warped_step step = {.seconds = 0.01};
  double from[3 * max_landmarks], to[3 * max_landmarks], in_valve[3 * max_landmarks], moved[3];
  const double of[4] = {between(0.03, 0.08), between(0.03, 0.06), between(0.03, 0.08), between(0.1, 0.2)};
  const double time = between(0, 1);
  const riis_surface_options in_place = surface_options();
  step.rest_now = new_valve(kind);
  CHECK_OK(riis_valve_set_scalar(step.rest_now, "opening", opening));
  step.rest_before = valve_at(step.rest_now, opening_before);
  step.now = valve_at(step.rest_now, opening);
  step.before = valve_at(step.rest_now, opening_before);
  const int64_t n = landmarks_on(new_surface(step.rest_now, &in_place), 40, in_valve);
  const affine map = map_of(options);
  for (int64_t i = 0; i < n; ++i) apply(&map, in_valve + 3 * i, from + 3 * i);
  for (int s = 0; s < 2; ++s) {
    for (int64_t i = 0; i < n; ++i) {
      beat(in_valve + 3 * i, time + s * step.seconds, of, moved);
      apply(&map, moved, to + 3 * i);
    }
    riis_warp *warp = new_warp(n, from, 0, options);
    CHECK_OK(set_targets(warp, n, to));
    CHECK_OK(riis_valve_set_warp(s ? step.now : step.before, warp, NULL));
    *(s ? &step.map_now : &step.map_before) = warp;
  }
  return step;
}

/* Compares the velocities of a surface with those of its material. Returns the largest difference, and writes the largest speed.
 * The map takes a material point x to the vertex y. In the earlier state, the valve without its warp had the same label at x, and
 * the earlier map took x to another place. */
static double material_error(const riis_surface *surface, const warped_step *step, const riis_surface_options *options,
                             double *largest, double *rms) {
  const riis_triangles t = triangles_of(surface);
  const int64_t n = t.n_vertices;
  double *x = own(malloc((size_t)n * 3 * sizeof *x)), *y = own(malloc((size_t)n * 3 * sizeof *y));
  memcpy(x, t.xyz, (size_t)n * 3 * sizeof *x);
  for (int round = 0; round < 16; ++round) {
    const riis_points points = points_at(n, x);
    CHECK_OK(riis_warp_map(step->map_now, &points, y));
    for (int64_t i = 0; i < 3 * n; ++i) x[i] += t.xyz[i] - y[i];
  }
  riis_surface_options fine = *options;
  fine.tolerance = 0.01;
  fine.triangulation = RIIS_TRIANGULATION_ADAPTED;
  riis_surface *rest = new_surface(step->rest_now, &fine);
  CHECK_OK(riis_surface_update_moving(rest, step->rest_now, step->rest_before, step->seconds, NULL, NULL));
  const riis_triangles r = triangles_of(rest);
  int64_t *triangle = own(malloc((size_t)n * sizeof *triangle));
  double *weights = own(malloc((size_t)n * 3 * sizeof *weights));
  riis_closest_arrays closest;
  CHECK_OK(riis_closest_arrays_init(&closest, sizeof closest));
  closest.triangle_id = triangle, closest.barycentric = weights;
  const riis_points points = points_at(n, x);
  CHECK_OK(riis_closest_points(rest, &points, NULL, &closest));
  for (int64_t i = 0; i < n; ++i) {
    int64_t at = 0; /* triangles without area are left out, so an id may be larger than the position */
    for (int64_t low = 0, high = r.n_triangles - 1; low <= high;) {
      at = (low + high) / 2;
      if (r.triangle_id[at] == triangle[i]) break;
      if (r.triangle_id[at] < triangle[i])
        low = at + 1;
      else
        high = at - 1;
    }
    for (int k = 0; k < 3; ++k)
      for (int c = 0; c < 3; ++c)
        x[3 * i + c] -= step->seconds * weights[3 * i + k] * r.velocity[3 * r.vertex_id[3 * at + k] + c];
  }
  const riis_points before = points_at(n, x);
  CHECK_OK(riis_warp_map(step->map_before, &before, y));
  double worst = 0, square = 0;
  *largest = 0;
  for (int64_t i = 0; i < n; ++i) {
    double wanted[3], zero[3] = {0, 0, 0};
    for (int c = 0; c < 3; ++c) wanted[c] = (t.xyz[3 * i + c] - y[3 * i + c]) / step->seconds;
    *largest = fmax(*largest, distance3(wanted, zero));
    const double off = distance3(wanted, t.velocity + 3 * i);
    worst = fmax(worst, off);
    square += off * off;
  }
  *rms = sqrt(square / (double)n);
  return worst;
}

/* A velocity is the displacement of the material over the step, also along the leaflet. The bound of velocities holds. The limits
 * of the errors are shares of the largest speed, and have held for 300 seeds. If RestInside and rest_of_offsets did not take
 * displacements at the labels, the first two steps would exceed the limits. */
TEST(a_moving_annulus_has_its_velocities) {
  static const struct {
    const char *name;
    double largest, rms;
  } with_warp[] = {{"trileaflet", 0.006, 0.0008}, {"coapting", 0.009, 0.002},        {"aortic", 0.008, 0.0015},
                   {"mitral", 0.006, 0.0025},     {"mitral_coapting", 0.004, 0.001}, {"tricuspid", 0.004, 0.001}};
  static const struct {
    int kind;
    uint64_t state;
  } hard[] = {{1, 55}, {3, 4}};
  enum { n_hard = sizeof hard / sizeof *hard, n_valves = sizeof with_warp / sizeof *with_warp };
  for (int trial = 0; trial < n_hard + trials_of(36); ++trial) {
    const random_source kept = rng;
    const int owned_before = n_owned(), is_hard = trial < n_hard, is_fixed = !is_hard && (trial - n_hard) / n_valves;
    const int kind = is_hard ? hard[trial].kind : (trial - n_hard) % n_valves;
    const char *name = with_warp[kind].name;
    if (is_hard) rng.state = hard[trial].state;
    const riis_surface_options options =
        random_placement(is_fixed ? RIIS_TRIANGULATION_FIXED : RIIS_TRIANGULATION_ADAPTED);
    const double opening = between(0.3, 0.9), rate = between(-2, 2);
    double largest = 0, rms, still = 0, moving = 0;
    for (int opens = is_hard; opens < 2; ++opens) {
      const warped_step step = new_step(name, opening, opening - opens * rate * 0.01, &options);
      riis_surface *surface = new_surface(step.now, &options);
      CHECK_OK(riis_surface_update_moving(surface, step.now, step.before, step.seconds, NULL, NULL));
      *(opens ? &moving : &still) = material_error(surface, &step, &options, &largest, &rms);
      printf("%s, %s, %s: velocities differ by %.2g %% of the largest, rms %.2g %%\n", name,
             is_fixed ? "fixed" : "adapted", opens ? "opening" : "still", 100 * (opens ? moving : still) / largest,
             100 * rms / largest);
      CHECK_AT_MOST(opens ? moving : still, with_warp[kind].largest * largest);
      CHECK_AT_MOST(rms, with_warp[kind].rms * largest);
      if (is_fixed) continue;
      const double bound = velocity_error_bound(surface, step.now, step.before, step.seconds, NULL);
      riis_surface_options fine = options;
      fine.tolerance = 0.01;
      riis_surface *finer = new_surface(step.now, &fine);
      CHECK_OK(riis_surface_update_moving(finer, step.now, step.before, step.seconds, NULL, NULL));
      const riis_triangles a = triangles_of(surface), b = triangles_of(finer);
      double worst = 0, velocity[3];
      for (int64_t i = 0; i < b.n_triangles; i += 7) {
        const int64_t vertex = b.vertex_id[3 * i];
        if (value_at_label(&a, a.uv, a.velocity, b.patch_id[i], b.uv + 2 * vertex, velocity))
          worst = fmax(worst, distance3(velocity, b.velocity + 3 * vertex));
      }
      assert_true(worst > 0);
      printf("  the bound is %.3g of the largest, with %.2g reached\n", bound / largest, worst / largest);
      CHECK_AT_MOST(worst, bound);
      CHECK_AT_MOST(bound, largest);
    }
    free_owned_after(owned_before);
    if (is_hard) rng = kept;
  }
}

/* With a fixed triangulation, the triangles move across the leaflet with the velocities. Along the leaflet, vertices follow
 * shares of lengths. */
TEST(fixed_vertices_move_with_their_velocities) {
  for (int trial = 0; trial < 5; trial += trial_step()) {
    const int owned_before = n_owned();
    const riis_surface_options options = random_placement(RIIS_TRIANGULATION_FIXED);
    const double opening = between(0.3, 0.9);
    const warped_step step = new_step(kinds[trial], opening, opening, &options);
    riis_surface *surface = new_surface(step.now, &options);
    CHECK_OK(riis_surface_update(surface, step.before, NULL));
    const riis_triangles first = triangles_of(surface);
    double *xyz = own(malloc((size_t)first.n_vertices * 3 * sizeof *xyz));
    memcpy(xyz, first.xyz, (size_t)first.n_vertices * 3 * sizeof *xyz);
    CHECK_OK(riis_surface_update_moving(surface, step.now, step.before, step.seconds, NULL, NULL));
    const riis_triangles second = triangles_of(surface);
    assert_int_equal(first.n_vertices, second.n_vertices);
    double largest = 0, worst = 0;
    for (int64_t i = 0; i < second.n_triangles; ++i) {
      const int64_t *id = second.vertex_id + 3 * i;
      const double *a = second.xyz + 3 * id[0], *b = second.xyz + 3 * id[1], *c = second.xyz + 3 * id[2];
      const double p[3] = {b[0] - a[0], b[1] - a[1], b[2] - a[2]}, q[3] = {c[0] - a[0], c[1] - a[1], c[2] - a[2]};
      const double normal[3] = {p[1] * q[2] - p[2] * q[1], p[2] * q[0] - p[0] * q[2], p[0] * q[1] - p[1] * q[0]};
      double across = 0, zero[3] = {0, 0, 0};
      for (int k = 0; k < 3; ++k)
        for (int d = 0; d < 3; ++d)
          across += normal[d] / distance3(normal, zero) / 3 *
                    (second.velocity[3 * id[k] + d] - (second.xyz[3 * id[k] + d] - xyz[3 * id[k] + d]) / step.seconds);
      for (int k = 0; k < 3; ++k) largest = fmax(largest, distance3(second.velocity + 3 * id[k], zero));
      worst = fmax(worst, fabs(across));
    }
    printf("%s: triangles move across by %.2g %% of the largest speed otherwise\n", kinds[trial],
           100 * worst / largest);
    /* The map and the warped valve bend mitral arcs differently. */
    CHECK_AT_MOST(worst, (trial == 2 ? 0.06 : 0.02) * largest);
    free_owned_after(owned_before);
  }
}

/* Equal targets give equal bits, whatever the earlier targets were. */
TEST(a_restart_repeats_velocities) {
  for (int trial = 0; trial < trials_of(18); trial += trial_step()) {
    const int owned_before = n_owned();
    const riis_surface_options options =
        random_placement(trial / 3 ? RIIS_TRIANGULATION_FIXED : RIIS_TRIANGULATION_ADAPTED);
    const double opening = between(0, 1);
    const warped_step step = new_step(kinds[trial % 3], opening, opening, &options);
    riis_valve *fresh = valve_at(step.rest_now, opening), *fresh_before = valve_at(step.rest_now, opening);
    CHECK_OK(riis_valve_set_warp(fresh, step.map_now, NULL));
    CHECK_OK(riis_valve_set_warp(fresh_before, step.map_before, NULL));
    riis_surface *one = new_surface(step.now, &options), *two = new_surface(fresh, &options);
    CHECK_OK(riis_surface_update_moving(one, step.before, step.now, 0.02, NULL, NULL));
    CHECK_OK(riis_surface_update_moving(one, step.now, step.before, step.seconds, NULL, NULL));
    CHECK_OK(riis_surface_update_moving(two, fresh, fresh_before, step.seconds, NULL, NULL));
    const riis_triangles a = triangles_of(one), b = triangles_of(two);
    assert_true(is_same_content(one, two));
    assert_memory_equal(a.velocity, b.velocity, (size_t)a.n_vertices * 3 * sizeof *a.velocity);
    free_owned_after(owned_before);
  }
}

/* A surface remembers the patches of its last state, because this is often the earlier state of the next step. If the valve has
 * changed since then, the library makes the patches again. */
TEST(a_changed_earlier_state_is_made_again) {
  for (int trial = 0; trial < trials_of(18); trial += trial_step()) {
    const int owned_before = n_owned();
    const riis_surface_options options =
        random_placement(trial / 3 ? RIIS_TRIANGULATION_FIXED : RIIS_TRIANGULATION_ADAPTED);
    const double opening = between(0.1, 0.9);
    const warped_step step = new_step(kinds[trial % 3], opening, opening, &options);
    riis_surface *one = new_surface(step.now, &options), *two = new_surface(step.now, &options);
    riis_valve *changed = valve_at(step.rest_now, opening);
    for (int change = 0; change < 2; ++change) {
      CHECK_OK(riis_valve_set_warp(changed, step.map_now, NULL));
      CHECK_OK(riis_surface_update(one, changed, NULL)); /* the same state as `now` */
      if (change == 0)
        CHECK_OK(riis_valve_set_warp(changed, step.map_before, NULL));
      else
        CHECK_OK(riis_valve_set_scalar(changed, "opening", opening + 0.01));
      riis_valve *fresh = valve_at(step.rest_now, change == 0 ? opening : opening + 0.01);
      CHECK_OK(riis_valve_set_warp(fresh, change == 0 ? step.map_before : step.map_now, NULL));
      CHECK_OK(riis_surface_update_moving(one, step.now, changed, step.seconds, NULL, NULL));
      CHECK_OK(riis_surface_update_moving(two, step.now, fresh, step.seconds, NULL, NULL));
      const riis_triangles a = triangles_of(one), b = triangles_of(two);
      assert_true(is_same_content(one, two));
      assert_memory_equal(a.velocity, b.velocity, (size_t)a.n_vertices * 3 * sizeof *a.velocity);
      double largest = 0;
      for (int64_t i = 0; i < 3 * a.n_vertices; ++i) largest = fmax(largest, fabs(a.velocity[i]));
      assert_true(largest > 0);
    }
    free_owned_after(owned_before);
  }
}

/* A table of keys gives the bits of targets that the test itself interpolates. The table repeats after a period. */
TEST(keys_in_time_give_targets) {
  double from[3 * 12], frames[3][3 * 12], by_hand[3 * 12], a[3], b[3];
  const double time[3] = {0, 0.25, 1}, probe[3] = {0.3, -0.2, 0.4};
  for (int i = 0; i < 36; ++i) {
    from[i] = between(-1, 1);
    frames[0][i] = frames[2][i] = from[i] + between(-0.02, 0.02);
    frames[1][i] = from[i] + between(-0.02, 0.02);
  }
  riis_keyframe_arrays keys;
  CHECK_OK(riis_keyframe_arrays_init(&keys, sizeof keys));
  keys.n_keys = 3, keys.n_vertices = 12, keys.time = time, keys.xyz = frames, keys.period = 1;
  riis_warp *warp = new_warp(12, from, 0, NULL);
  for (int64_t i = 0; i < 36; ++i) by_hand[i] = frames[0][i] + 0.5 * (frames[1][i] - frames[0][i]);
  CHECK_OK(set_targets(warp, 12, by_hand));
  map_point(warp, probe, a);
  CHECK_OK(riis_warp_set_targets_at(warp, &keys, 3.125));
  map_point(warp, probe, b);
  for (int c = 0; c < 3; ++c) CHECK_NEAR(a[c], b[c], 1e-12);
  CHECK_OK(riis_warp_set_targets_at(warp, &keys, 0.25));
  map_point(warp, probe, a);
  CHECK_OK(set_targets(warp, 12, frames[1]));
  map_point(warp, probe, b);
  assert_memory_equal(a, b, sizeof a);
  float single[3][36];
  for (int k = 0; k < 3; ++k)
    for (int i = 0; i < 36; ++i) single[k][i] = (float)frames[k][i];
  keys.xyz = single, keys.real_bits = 32;
  CHECK_OK(riis_warp_set_targets_at(warp, &keys, 0.25));
  map_point(warp, probe, b);
  for (int c = 0; c < 3; ++c) CHECK_NEAR(a[c], b[c], 1e-5);
  keys.n_vertices = 11;
  CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "frames.n_vertices is 11|12 landmarks",
                riis_warp_set_targets_at(warp, &keys, 0));
  keys.n_vertices = 12, keys.xyz = frames, keys.real_bits = 64;
  frames[1][4] = NAN;
  CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "y of landmark 1 in frame 1 is nan", riis_warp_set_targets_at(warp, &keys, 0.3));
  frames[1][4] = 0, frames[2][7] += 1;
  CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "landmark 2 in the last frame|y", riis_warp_set_targets_at(warp, &keys, 0.3));
  keys.n_keys = 0;
  CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "frames.n_keys is 0", riis_warp_set_targets_at(warp, &keys, 0.3));
}

/* --- Refusals --------------------------------------------------------------------------------------------------------- */

TEST(folds_are_found_and_named) {
  riis_valve *valve = new_valve("trileaflet");
  riis_surface *surface = new_surface(valve, NULL);
  double from[3 * max_landmarks], to[3 * max_landmarks], mapped[2][3];
  const int64_t n = landmarks_on(surface, 24, from);
  const double probe[3] = {0.1, 0.2, -0.3};
  riis_warp *warp = new_warp(n, from, 0, NULL);
  for (int64_t i = 0; i < n; ++i) deform(from + 3 * i, 0.1, to + 3 * i);
  CHECK_OK(set_targets(warp, n, to));
  map_point(warp, probe, mapped[0]);
  /* Two neighbours change places. */
  memcpy(to, from, sizeof to);
  memcpy(to, from + 3, 3 * sizeof *to);
  memcpy(to + 3, from, 3 * sizeof *to);
  CHECK_REFUSED(RIIS_INVALID_PARAMETER, "the warp folds near landmark|determinant is -|at (", set_targets(warp, n, to));
  /* Mirrored landmarks, as if the cusps had the wrong names. */
  for (int64_t i = 0; i < 3 * n; ++i) to[i] = i % 3 == 1 ? -from[i] : from[i];
  CHECK_REFUSED(RIIS_INVALID_PARAMETER, "the warp folds near landmark|determinant is -1|at (",
                set_targets(warp, n, to));
  map_point(warp, probe, mapped[1]);
  assert_memory_equal(mapped[0], mapped[1], sizeof mapped[0]); /* a refusal changes nothing */
}

/* A warp is refused if it turns over a part of a patch, or if it folds at a patch but not at landmarks. The message names the
 * patch. */
TEST(folds_at_patches_are_named) {
  riis_valve *valve = new_valve("trileaflet");
  riis_surface *surface = new_surface(valve, NULL);
  /* Landmarks lie at the corners of two cubes around the valve. The landmarks of the inner cube move inwards until the space
   * between the cubes folds. */
  int n_refused = 0;
  for (int trial = 0; trial < 100 && n_refused == 0; trial += trial_step()) {
    const int owned_before = n_owned();
    double from[3 * 16], to[3 * 16];
    for (int i = 0; i < 16; ++i)
      for (int c = 0; c < 3; ++c) {
        from[3 * i + c] = (i < 8 ? 1.2 : 2.4) * ((i >> c) & 1 ? 1 : -1);
        to[3 * i + c] = (i < 8 ? 1 - 0.01 * trial : 1) * from[3 * i + c];
      }
    riis_warp *warp = new_warp(16, from, 0, NULL);
    CHECK_OK(set_targets(warp, 16, to));
    CHECK_OK(riis_valve_set_warp(valve, warp, NULL));
    const riis_triangles before = triangles_of(surface);
    const riis_status status = riis_surface_update(surface, valve, NULL);
    if (status != RIIS_OK) {
      ++n_refused;
      CHECK_REFUSED(RIIS_INVALID_PARAMETER, "the warp |patch |of leaflet ", riis_surface_update(surface, valve, NULL));
      assert_ptr_equal(before.xyz, triangles_of(surface).xyz);
    }
    free_owned_after(owned_before);
  }
  assert_int_equal(n_refused, 1);
}

/* The attachment of a random patient, made from a point of the coapting valve's attachment. The patient's sectors, heights and
 * ellipse agree with examples/patient/make_patient.py. */
typedef struct {
  double commissure_height, sectors[3], commissure_rise[3], nadir_rise[3], ratio, direction;
} random_root;

static random_root draw_root(double commissure_height) {
  random_root root = {.commissure_height = commissure_height};
  double sum = 0;
  for (int i = 0; i < 3; ++i) {
    sum += root.sectors[i] = 120 + between(-18, 18);
    root.commissure_rise[i] = between(-0.15, 0.15), root.nadir_rise[i] = between(-0.08, 0.08);
  }
  for (int i = 0; i < 3; ++i) root.sectors[i] *= 2 * acos(-1) / sum;
  root.ratio = between(1, 1.25), root.direction = between(0, acos(-1));
  return root;
}

static void in_root(const random_root *root, const double *x, double *y) {
  const double sector = 2 * acos(-1) / 3, turned = atan2(x[1], x[0]) + sector / 2;
  const double angle = turned < 0 ? turned + 3 * sector : turned;
  const int cusp = angle < sector ? 0 : angle < 2 * sector ? 1 : 2;
  double begin = -root->sectors[0] / 2;
  for (int i = 0; i < cusp; ++i) begin += root->sectors[i];
  const double share = angle / sector - cusp, height = x[2] / root->commissure_height;
  const double commissure = root->commissure_rise[share < 0.5 ? (cusp + 2) % 3 : cusp];
  const double radius = hypot(x[0], x[1]), made = begin + share * root->sectors[cusp] - root->direction;
  const double u = radius * cos(made) * sqrt(root->ratio), v = radius * sin(made) / sqrt(root->ratio);
  y[0] = u * cos(root->direction) - v * sin(root->direction);
  y[1] = u * sin(root->direction) + v * cos(root->direction);
  y[2] = x[2] + height * commissure + (1 - height) * root->nadir_rise[cusp];
}

/* Returns a normally distributed random number. */
static double normal(double deviation) {
  return deviation * sqrt(-2 * log(between(1e-300, 1))) * cos(between(0, 2 * acos(-1)));
}

/* The landmarks of random patients have a clinician's noise, which smooths the warp. No part of a leaflet turns over at any
 * opening. With exact landmarks, no part turns over either. Five times a clinician's noise without smoothing folds nearly every
 * valve. RIIS_TEST_LONG=1 takes 100 patients of each sort. */
TEST(warps_of_patients_do_not_fold) {
  const int n_patients = trials(25, 100), n_openings = is_short_test() ? 5 : 50;
  const struct { double noise, smoothing; } sorts[3] = {{0.03, 0.03}, {0, 0}, {0.15, 0}};
  int n_refused = 0;
  for (int trial = 0; trial < 3 * n_patients; ++trial) {
    const int owned_before = n_owned(), sort = trial % 3;
    riis_valve *valve = new_valve("coapting");
    const double radius = between(1.15, 1.35), wanted = between(1.5, 1.8), commissures = radius * between(1, 1.12);
    /* If the heights are below 1.05 times the commissures' radius, even the valve without a warp is refused. */
    const double height = fmax(wanted, 1.1 * commissures);
    CHECK_OK(riis_valve_set_scalar(valve, "root_radius", radius));
    CHECK_OK(riis_valve_set_scalar(valve, "commissure_radius", commissures));
    CHECK_OK(riis_valve_set_scalar(valve, "commissure_height", height));
    riis_surface *surface = new_surface(valve, NULL);
    double from[3 * max_landmarks], to[3 * max_landmarks];
    const int64_t n = landmarks_on(surface, 24, from);
    const random_root root = draw_root(height);
    for (int64_t i = 0; i < n; ++i) {
      in_root(&root, from + 3 * i, to + 3 * i);
      for (int c = 0; c < 3; ++c) to[3 * i + c] += sorts[sort].noise > 0 ? normal(sorts[sort].noise) : 0;
    }
    riis_warp *warp = new_warp(n, from, sorts[sort].smoothing, NULL);
    riis_status status = set_targets(warp, n, to);
    if (status == RIIS_OK) CHECK_OK(riis_valve_set_warp(valve, warp, NULL));
    for (int k = 0; status == RIIS_OK && k <= n_openings; ++k) {
      riis_valve_patches patches;
      CHECK_OK(riis_valve_set_scalar(valve, "opening", (double)k / n_openings));
      status = riis_valve_get_patches(valve, &patches, sizeof patches);
    }
    if (status != RIIS_OK && sort < 2) fail_msg("patient %d: %s", trial, riis_last_error());
    n_refused += status != RIIS_OK;
    free_owned_after(owned_before);
  }
  printf("%d of %d wild warps are refused\n", n_refused, n_patients);
  CHECK_MET(n_refused >= 0.8 * n_patients);
}

typedef struct edge {
  int64_t lower, upper, triangle;
} edge;

static int compare_edges(const void *a, const void *b) {
  const edge *p = a, *q = b;
  if (p->lower != q->lower) return p->lower < q->lower ? -1 : 1;
  return p->upper != q->upper ? (p->upper < q->upper ? -1 : 1) : 0;
}

/* Returns the least cosine between the normals of two triangles of one patch that share an edge. */
static double least_cosine(const riis_surface *surface) {
  const riis_triangles all = triangles_of(surface);
  edge *edges = malloc(3 * (size_t)all.n_triangles * sizeof *edges);
  double(*normal_of)[3] = malloc((size_t)all.n_triangles * sizeof *normal_of), least = 1;
  for (int64_t i = 0; i < all.n_triangles; ++i) {
    const int64_t *id = all.vertex_id + 3 * i;
    double along[2][3];
    for (int k = 0; k < 3; ++k) {
      const int64_t a = id[k], b = id[(k + 1) % 3];
      edges[3 * i + k] = (edge){a < b ? a : b, a < b ? b : a, i};
      for (int e = 0; e < 2; ++e) along[e][k] = all.xyz[3 * id[e + 1] + k] - all.xyz[3 * id[0] + k];
    }
    for (int c = 0; c < 3; ++c) {
      const int n = (c + 1) % 3, m = (c + 2) % 3;
      normal_of[i][c] = along[0][n] * along[1][m] - along[0][m] * along[1][n];
    }
  }
  qsort(edges, 3 * (size_t)all.n_triangles, sizeof *edges, compare_edges);
  for (int64_t i = 0; i + 1 < 3 * all.n_triangles; ++i) {
    if (compare_edges(edges + i, edges + i + 1) != 0) continue;
    const double *a = normal_of[edges[i].triangle], *b = normal_of[edges[i + 1].triangle];
    const double product = a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    least = fmin(least, product / (hypot(hypot(a[0], a[1]), a[2]) * hypot(hypot(b[0], b[1]), b[2])));
  }
  free(edges);
  free(normal_of);
  return least;
}

/* Some grid cells of the half open coapting valve are hardly wider than a line. Rough landmarks, with errors of up to half a
 * millimetre, turn over such cells, but no triangles. */
TEST(slivers_of_rough_warps_are_no_folds) {
  static const struct {
    int roughness;
    double opening;
  } cases[] = {{12, 0.9}, {34, 0.9}, {50, 0.9}, {136, 0.9}, {136, 1}, {172, 0.6}, {342, 0.6}, {396, 1}};
  enum { n = 12 };
  for (size_t i = 0; i < sizeof cases / sizeof *cases; i += (size_t)trial_step()) {
    const int owned_before = n_owned();
    riis_valve *valve = new_valve("coapting");
    riis_attachment held;
    CHECK_OK(riis_surface_get_attachment(new_surface(valve, NULL), &held, sizeof held));
    double from[3 * n], to[3 * n];
    for (int k = 0; k < n; ++k)
      memcpy(from + 3 * k, held.edges + 6 * (k * held.n_edges / n + held.n_edges / (2 * n)), 24);
    for (int k = 0; k < 3 * n; ++k) to[k] = from[k] + 0.05 * sin(1.7 * cases[i].roughness * (k + 1));
    riis_warp *warp = new_warp(n, from, 0, NULL);
    CHECK_OK(set_targets(warp, n, to));
    CHECK_OK(riis_valve_set_warp(valve, warp, NULL));
    CHECK_OK(riis_valve_set_scalar(valve, "opening", cases[i].opening));
    assert_true(least_cosine(new_surface(valve, NULL)) > 0.6);
    free_owned_after(owned_before);
  }
}

TEST(bad_arguments_are_named) {
  double xyz[3 * 6] = {1, 0, 0, 0, 1, 0, -1, 0, 0, 0, -1, 0, 0, 0, 1, 0.5, 0.5, 0.5};
  riis_points points = points_at(6, xyz);
  riis_warp_options options;
  riis_warp *warp = NULL;
  riis_warp_info info;
  riis_valve *valve = new_valve("trileaflet");
  CHECK_OK(riis_warp_options_init(&options, sizeof options));
#define CREATE_IS_REFUSED(parts) CHECK_REFUSED(RIIS_INVALID_ARGUMENT, parts, riis_warp_create(&points, &options, &warp))
  points.n_points = 2;
  CREATE_IS_REFUSED("sources.n_points is 2|from 3 to 1000");
  points.n_points = 1001;
  CREATE_IS_REFUSED("sources.n_points is 1001|from 3 to 1000");
  points.n_points = 6;
  xyz[4] = NAN;
  CREATE_IS_REFUSED("y of landmark 1 is nan");
  xyz[4] = 1;
  memcpy(xyz + 15, xyz + 3, 3 * sizeof *xyz);
  CREATE_IS_REFUSED("landmarks 1 and 5 are in one place|(0, 1, 0)");
  for (int i = 0; i < 6; ++i) xyz[3 * i] = i, xyz[3 * i + 1] = 2 * i, xyz[3 * i + 2] = -i;
  CREATE_IS_REFUSED("all 6 landmarks lie on a line");
  for (int i = 0; i < 18; ++i) xyz[i] = between(-1, 1);
  options.noise = -1;
  CREATE_IS_REFUSED("options.noise is -1");
  options.noise = NAN;
  CREATE_IS_REFUSED("options.noise is nan");
  options.noise = 0;
  points.real_bits = 16;
  CREATE_IS_REFUSED("sources.real_bits is 16");
  points.real_bits = 64, points.reserved = 3;
  CREATE_IS_REFUSED("sources.reserved is 3");
  points.reserved = 0, points.y = NULL;
  CREATE_IS_REFUSED("sources.y is NULL");
  points.y = xyz + 1;
  riis_surface_options placement = surface_options();
  placement.scale = -1;
  options.placement = &placement;
  CREATE_IS_REFUSED("options.placement.scale is -1");
  options.placement = NULL;
  CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "warp is NULL", riis_warp_create(&points, &options, NULL));
  CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "sources is NULL", riis_warp_create(NULL, &options, &warp));
  CHECK_REFUSED(RIIS_INVALID_STRUCT_SIZE, "options is 8", riis_warp_options_init(&options, 8));
  CHECK_OK(riis_warp_create(&points, NULL, &warp));
  own(warp);
  points.n_points = 5;
  CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "targets.n_points is 5|6 landmarks", riis_warp_set_targets(warp, &points));
  points.n_points = 6;
  xyz[8] = INFINITY;
  CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "z of landmark 2 is inf", riis_warp_set_targets(warp, &points));
  CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "z of point 2 is inf", riis_warp_map(warp, &points, xyz));
  CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "targets is NULL", riis_warp_set_targets(warp, NULL));
  CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "warp is NULL", riis_warp_set_targets(NULL, &points));
  CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "frames is NULL", riis_warp_set_targets_at(warp, NULL, 0));
  CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "info is NULL", riis_warp_get_info(warp, NULL, sizeof info));
  CHECK_REFUSED(RIIS_INVALID_STRUCT_SIZE, "info is 16", riis_warp_get_info(warp, &info, 16));
  CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "points is NULL", riis_warp_map(warp, NULL, xyz));
  CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "mapped is NULL", riis_warp_map(warp, &points, NULL));
  CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "closed is NULL", riis_valve_set_warp(valve, NULL, warp));
  CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "valve is NULL", riis_valve_set_warp(NULL, warp, NULL));
  CHECK_REFUSED(RIIS_INVALID_PARAMETER, "the bileaflet valve cannot be warped",
                riis_valve_set_warp(new_valve("bileaflet"), warp, NULL));
  CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "valve is NULL", riis_valve_get_patches(NULL, NULL, 0));
  CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "patches is NULL", riis_valve_get_patches(valve, NULL, 96));
  riis_valve_patches patches;
  CHECK_REFUSED(RIIS_INVALID_STRUCT_SIZE, "patches is 8", riis_valve_get_patches(valve, &patches, 8));
  /* The earlier state has a warp, or has none. */
  riis_valve *warped = new_valve("trileaflet");
  CHECK_OK(riis_valve_set_warp(warped, warp, NULL));
  riis_surface *surface = new_surface(valve, NULL);
  CHECK_REFUSED(RIIS_INVALID_PARAMETER, "valve_before has a warp, but valve has none",
                riis_surface_update_moving(surface, valve, warped, 0.1, NULL, NULL));
  CHECK_REFUSED(RIIS_INVALID_PARAMETER, "valve_before has no warp, but valve has one",
                riis_surface_update_moving(surface, warped, valve, 0.1, NULL, NULL));
  riis_surface_options fixed = surface_options();
  fixed.triangulation = RIIS_TRIANGULATION_FIXED;
  CHECK_OK(riis_surface_update(surface, valve, &fixed));
  CHECK_REFUSED(RIIS_INVALID_PARAMETER, "the valve has a warp|none", riis_surface_update(surface, warped, NULL));
}

/* Bileaflet patches are given: the sides are spans of arcs, and each side is read out. */
TEST(bileaflet_patches_are_read_out) {
  riis_valve *valve = new_valve("bileaflet");
  const riis_valve_patches got = patches_of(valve);
  assert_int_equal(got.n_patches, 4);
  assert_true(got.n_pieces > got.n_curves);
  for (int64_t i = 0; i < got.n_patches; ++i) assert_int_equal(got.attached[i], -1);
}

int main(void) {
  rng = random_start("test_warp");
  return run_cases(NULL, NULL);
}
