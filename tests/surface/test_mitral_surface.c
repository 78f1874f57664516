/* SPDX-License-Identifier: Apache-2.0
 * Tests the mitral valve through the public interface. The tests cover the numbers of docs/theory/mitral.md, and properties that
 * hold at any opening. */
#include <riis/riis.h>

#include "test_support.h"

#include "handles.h"
#include "mitral_oracle.h"
#include "oracle.h"

static const struct {
  const char *name;
  double value;
} table[] = {{"anterior_ratio", 0.41},
             {"AP_diameter", 3.0},
             {"ALPM_diameter", 4.0},
             {"ALPM_position_ratio", 0.55},
             {"IT_distance", 2.5},
             {"indent_depth", 0.5},
             {"anterior_horn_height", 0.8},
             {"posterior_horn_height", 0.6},
             {"anterior_length", 2.12},
             {"posteromedial_commissure_height", 0.8},
             {"posterior_scallop_length1", 1.35},
             {"posterior_scallop_length2", 1.35},
             {"leaflet_arc_angle", 120},
             {"leaflet_inward_angle", 75},
             {"surface_angle", 20},
             {"triangle_size_ratio", 0.1},
             {"opening", 1}};
enum { n_scalars = sizeof table / sizeof *table };

/* Returns the valve without a translation, because the expected numbers exclude it. */
static riis_valve *mitral_valve(double opening) {
  const double no_shift[3] = {0, 0, 0};
  riis_valve *valve = new_valve("mitral");
  CHECK_OK(riis_valve_set(valve, "translation", 3, no_shift));
  CHECK_OK(riis_valve_set_scalar(valve, "opening", opening));
  return valve;
}

static riis_surface *mitral_surface(double opening, double tolerance) {
  riis_surface_options options = surface_options();
  options.tolerance = tolerance;
  riis_valve *valve = mitral_valve(opening);
  riis_surface *surface = new_surface(valve, &options);
  free_one_owned(valve);
  return surface;
}

static double distance(const double *p, const double *q) { return hypot(hypot(p[0] - q[0], p[1] - q[1]), p[2] - q[2]); }

TEST(parameters_are_the_papers) {
  int64_t n;
  double values[3];
  riis_valve *valve = new_valve("mitral");
  CHECK_OK(riis_valve_get_n_parameters(valve, &n));
  /* The paper has 18 parameters: the parameters of its table, its t, and the translation. The last parameter here is the skirt's
   * length. */
  assert_int_equal(n, n_scalars + 2);
  for (int i = 0; i < n_scalars; ++i) {
    riis_parameter parameter;
    CHECK_OK(riis_valve_get_parameter(valve, i, &parameter, sizeof parameter));
    assert_string_equal(parameter.name, table[i].name);
    CHECK_SAME(parameter.default_values[0], table[i].value);
    CHECK_OK(riis_valve_get(valve, table[i].name, 1, values));
    CHECK_SAME(values[0], table[i].value);
  }
  CHECK_OK(riis_valve_get(valve, "translation", 3, values));
  assert_true(values[0] == 0 && values[1] == 0 && values[2] == 1);
}

/* Each parameter changes the closed, the open or the half-open surface. The old value restores the old surface. */
TEST(every_parameter_matters) {
  for (int i = 0; i <= n_scalars; ++i) {
    const int owned_before = n_owned();
    const char *name = i < n_scalars ? table[i].name : "translation";
    riis_valve *valve = mitral_valve(0.5);
    riis_surface *before = new_surface(valve, NULL);
    double values[3];
    CHECK_OK(riis_valve_get(valve, name, i < n_scalars ? 1 : 3, values));
    const double moved[3] = {0.95 * values[0] + (i < n_scalars ? 0 : 0.1), values[1], values[2]};
    CHECK_OK(riis_valve_set(valve, name, i < n_scalars ? 1 : 3, moved));
    riis_surface *after = new_surface(valve, NULL);
    const riis_surface_info a = info_of(before), b = info_of(after);
    if (a.area == b.area && a.upper[0] == b.upper[0]) fail_msg("%s does not matter", name);
    CHECK_OK(riis_valve_set(valve, name, i < n_scalars ? 1 : 3, values));
    CHECK_OK(riis_surface_update(after, valve, NULL));
    CHECK_SAME(info_of(after).area, a.area);
    free_owned_after(owned_before);
  }
}

/* Returns the total length of all edges with v = 0. */
static double annulus_length(const riis_triangles *c) {
  double sum = 0;
  for (int64_t t = 0; t < c->n_triangles; ++t)
    for (int k = 0; k < 3; ++k) {
      const int64_t a = c->vertex_id[3 * t + k], b = c->vertex_id[3 * t + (k + 1) % 3];
      if (c->uv[2 * a + 1] == 0 && c->uv[2 * b + 1] == 0) sum += distance(c->xyz + 3 * a, c->xyz + 3 * b);
    }
  return sum;
}

/* The surface is fine enough for the digits in docs/theory/mitral.md. For more digits the oracle would be needed. */
TEST(numbers_of_the_model) {
  const struct {
    double opening, area, area_to_6_digits, annulus, z_low, z_high;
  } expected[2] = {{0, 12.188, 12.188000, 12.62, -0.09, 0.80}, {1, 15.980, 15.980787, 12.21, -2.05, 0.00}};
  for (int i = 0; i < 2; ++i) {
    const int owned_before = n_owned();
    riis_surface *surface = mitral_surface(expected[i].opening, 5e-4);
    const riis_surface_info info = info_of(surface);
    const riis_triangles c = triangles_of(surface);
    CHECK_NEAR(info.area, expected[i].area, 1e-3);
    CHECK_NEAR(info.area, expected[i].area_to_6_digits, 2.5e-4);
    CHECK_NEAR(annulus_length(&c), expected[i].annulus, 5e-3);
    CHECK_NEAR(info.lower[2], expected[i].z_low, 5e-3);
    CHECK_NEAR(info.upper[2], expected[i].z_high, 5e-3);
    free_owned_after(owned_before);
  }
  /* The tip of the open anterior leaflet is a control point, so it does not depend on the tolerance. */
  riis_surface *surface = mitral_surface(1, 0.5);
  const riis_closest tip = closest_to(surface, 0, 0.951, -2.048);
  CHECK_NEAR(tip.point[1], 0.951, 5e-4);
  CHECK_NEAR(tip.point[2], -2.048, 5e-4);
  assert_int_equal(tip.leaflet_id, RIIS_LEAFLET_ANTERIOR);
}

TEST(area_is_the_oracles) {
  for (int i = 0; i <= 4; ++i) {
    mitral_parameters parameters = mitral_defaults();
    parameters.opening = 0.25 * i;
    mitral_oracle *oracle = mitral_oracle_create(&parameters, &parameters);
    riis_surface *surface = mitral_surface(parameters.opening, 2e-3);
    CHECK_NEAR(info_of(surface).area, mitral_oracle_area(oracle, 100, 100), 2e-3);
    free_one_owned(surface);
    mitral_oracle_destroy(oracle);
  }
}

TEST(is_symmetric) {
  for (int i = 0; i <= 2; ++i) {
    const int owned_before = n_owned();
    riis_surface *surface = mitral_surface(0.5 * i, 0.02);
    const riis_triangles c = triangles_of(surface);
    for (int64_t k = 0; k < c.n_vertices; ++k)
      CHECK_AT_MOST(closest_to(surface, -c.xyz[3 * k], c.xyz[3 * k + 1], c.xyz[3 * k + 2]).distance, 1e-12);
    free_owned_after(owned_before);
  }
}

TEST(leaflets_and_patches) {
  static const int32_t mirrored[10] = {5, 4, 3, 2, 1, 0, 9, 8, 7, 6};
  for (int i = 0; i <= 2; ++i) {
    const int owned_before = n_owned();
    riis_surface *surface = mitral_surface(0.5 * i, 0.05);
    const riis_triangles c = triangles_of(surface);
    int64_t n_of_patch[10] = {0};
    for (int64_t t = 0; t < c.n_triangles; ++t) {
      const int32_t patch = c.patch_id[t];
      assert_true(patch >= 0 && patch < 10);
      assert_int_equal(c.leaflet_id[t], patch < 6 ? RIIS_LEAFLET_ANTERIOR : RIIS_LEAFLET_POSTERIOR);
      ++n_of_patch[patch];
      double p[3][3], n[3], longest = 0;
      for (int k = 0; k < 3; ++k) {
        const int64_t id = c.vertex_id[3 * t + k];
        memcpy(p[k], c.xyz + 3 * id, sizeof p[k]);
        for (int a = 0; a < 2; ++a) assert_true(c.uv[2 * id + a] >= 0 && c.uv[2 * id + a] <= 1);
        /* Half of the patches are mirror images. */
        const int is_mirror_image = (patch >= 3 && patch <= 5) || patch >= 8;
        assert_true(is_mirror_image ? p[k][0] <= 0 : p[k][0] >= 0);
      }
      for (int k = 0; k < 3; ++k) longest = fmax(longest, distance(p[k], p[(k + 1) % 3]));
      for (int a = 0; a < 3; ++a) {
        const int d = (a + 1) % 3, e = (a + 2) % 3;
        n[a] = (p[1][d] - p[0][d]) * (p[2][e] - p[0][e]) - (p[1][e] - p[0][e]) * (p[2][d] - p[0][d]);
      }
      assert_true(sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]) > 1e-12 * longest * longest);
    }
    for (int patch = 0; patch < 10; ++patch) {
      assert_true(n_of_patch[patch] > 20);
      assert_int_equal(n_of_patch[patch], n_of_patch[mirrored[patch]]);
    }
    assert_true(info_of(surface).n_zero_area > 0); /* at the commissures, quads end in points and lose a triangle */
    free_owned_after(owned_before);
  }
}

/* An edge of only one triangle lies on the annulus or on the free edge of an open valve. Any other such edge lies inside another
 * triangle's edge, up to rounding. Edges inside another edge occur where quads of different levels or polylines of different
 * patches meet. */
TEST(has_no_cracks) {
  for (int i = 0; i <= 2; ++i) {
    const int owned_before = n_owned();
    const double opening = 0.5 * i;
    riis_surface *surface = mitral_surface(opening, 0.1);
    const riis_triangles c = triangles_of(surface);
    int n_rim = 0, n_inside = 0;
    for (int64_t t = 0; t < c.n_triangles; ++t)
      for (int k = 0; k < 3; ++k) {
        const int64_t a = c.vertex_id[3 * t + k], b = c.vertex_id[3 * t + (k + 1) % 3];
        const double *p = c.xyz + 3 * a, *q = c.xyz + 3 * b;
        int64_t n_like_it = 0;
        for (int64_t other = 0; other < c.n_triangles; ++other)
          for (int m = 0; m < 3; ++m) {
            const double *r = c.xyz + 3 * c.vertex_id[3 * other + m],
                         *s = c.xyz + 3 * c.vertex_id[3 * other + (m + 1) % 3];
            n_like_it += (memcmp(p, s, 3 * sizeof *p) == 0 && memcmp(q, r, 3 * sizeof *p) == 0) ||
                         (memcmp(p, r, 3 * sizeof *p) == 0 && memcmp(q, s, 3 * sizeof *p) == 0);
          }
        if (n_like_it > 1) continue;
        if (c.uv[2 * a + 1] == 0 && c.uv[2 * b + 1] == 0) {
          ++n_rim;
          continue;
        }
        if (opening > 0 && c.uv[2 * a + 1] == 1 && c.uv[2 * b + 1] == 1) continue;
        long double nearest = 1;
        for (int w = 1; w <= 3; ++w) {
          double middle[3];
          nearest = 1;
          for (int x = 0; x < 3; ++x) middle[x] = p[x] + 0.25 * w * (q[x] - p[x]);
          for (int64_t other = 0; other < c.n_triangles; ++other) {
            double abc[9];
            if (other == t) continue;
            for (int m = 0; m < 3; ++m) memcpy(abc + 3 * m, c.xyz + 3 * c.vertex_id[3 * other + m], 3 * sizeof *abc);
            nearest = fminl(nearest, oracle_point_triangle(middle, abc));
          }
          CHECK_AT_MOST((double)nearest, 1e-14);
        }
        ++n_inside;
      }
    printf("opening %.1f: %d edges on the annulus, %d inside other edges\n", opening, n_rim, n_inside);
    assert_true(n_rim > 40);
    free_owned_after(owned_before);
  }
}

/* Closed leaflets meet in one polyline. Both leaflets have the vertices of this polyline, bit for bit. */
TEST(closed_leaflets_share_their_edge) {
  riis_surface *surface = mitral_surface(0, 0.05);
  const riis_triangles c = triangles_of(surface);
  int n_shared = 0, n_of_edge = 0;
  for (int64_t t = 0; t < c.n_triangles; ++t)
    for (int k = 0; k < 3; ++k) {
      const int64_t id = c.vertex_id[3 * t + k];
      if (c.patch_id[t] != 7 || c.uv[2 * id + 1] != 1) continue; /* half of the middle scallop */
      ++n_of_edge;
      for (int64_t other = 0; other < 3 * c.n_triangles; ++other)
        if (c.leaflet_id[other / 3] == RIIS_LEAFLET_ANTERIOR &&
            memcmp(c.xyz + 3 * id, c.xyz + 3 * c.vertex_id[other], 3 * sizeof *c.xyz) == 0) {
          ++n_shared;
          break;
        }
    }
  /* At other corners, a grid line of one leaflet ends inside a chord of the other leaflet. */
  printf("closed edge: %d of %d corners are also the other leaflet's\n", n_shared, n_of_edge);
  assert_true(n_shared >= 6 && 3 * n_shared >= n_of_edge);
}

/* Two neighbouring grid lines of a patch join the same two sides. Returns the least distance of two neighbouring grid lines, as a
 * fraction of the longer side. */
static double least_step(const riis_triangles *c, int32_t patch, double *longer) {
  double length_of[2] = {0, 0}, *u = own(malloc((size_t)c->n_triangles * 2 * sizeof *u));
  size_t n = 0;
  for (int64_t t = 0; t < c->n_triangles; ++t)
    for (int k = 0; k < 3; ++k) {
      const int64_t p = c->vertex_id[3 * t + k], q = c->vertex_id[3 * t + (k + 1) % 3];
      const double v = c->uv[2 * p + 1];
      if (c->patch_id[t] != patch || c->uv[2 * q + 1] != v || (v != 0 && v != 1)) continue;
      /* A triangle has at most one edge on the side. */
      length_of[(int)v] += distance(c->xyz + 3 * p, c->xyz + 3 * q);
      u[n++] = c->uv[2 * p];
      u[n++] = c->uv[2 * q];
    }
  double least = 1;
  for (size_t i = 0; i < n; ++i)
    for (size_t j = 0; j < n; ++j)
      if (u[j] > u[i]) least = fmin(least, u[j] - u[i]);
  free_one_owned(u);
  *longer = fmax(length_of[0], length_of[1]);
  return least;
}

/* In valves of many shapes, no two grid lines nearly coincide. If both sides need a line, and these lines are within 0.02 of the
 * tolerance, they become one line (docs/theory/triangles.md). At a joint of the annulus, the offset O of the arcs has a kink. A
 * line next to a joint exists only if the tolerance needs it. The least ratio in 3,840 valves was 0.4. (Triangles can still be
 * flat: if a leaflet's arcs meet its free edge at a small angle, the quads are sheared.) */
TEST(has_no_slivers) {
  random_source rng = random_start("test_mitral_surface");
  double least = 1e30;
  for (int trial = 0; trial < trials_of(180); ++trial) {
    const int owned_before = n_owned();
    riis_valve *valve = mitral_valve(trial % 3 == 0 ? 0 : random_between(&rng, 0, 1));
    for (int i = 0; i < 16; ++i)
      CHECK_OK(riis_valve_set_scalar(valve, table[i].name, table[i].value * random_between(&rng, 0.85, 1.15)));
    riis_surface_options options = surface_options();
    options.tolerance = pow(10, random_between(&rng, -2, -0.5));
    riis_surface *surface = new_surface(valve, &options);
    const riis_triangles c = triangles_of(surface);
    const double max_error = options.tolerance * info_of(surface).half_thickness;
    for (int32_t patch = 0; patch < 10; ++patch) {
      double longer;
      const double step = least_step(&c, patch, &longer);
      assert_true(longer > 0 && step < 1);
      least = fmin(least, step * longer / max_error);
    }
    free_owned_after(owned_before);
  }
  printf("nearest lines: %.2f of the tolerance apart\n", least);
  CHECK_AT_MOST(0.1, least);
}

/* Downstream is the ventricle, which lies below the closed valve and around the open valve. */
TEST(normals_point_downstream) {
  riis_surface *closed = mitral_surface(0, 0.05), *open = mitral_surface(1, 0.05);
  assert_int_equal(closest_to(closed, 0, 0, -1).side, 1);
  assert_int_equal(closest_to(closed, 0, -1.2, -1).side, 1);
  assert_int_equal(closest_to(closed, 0, 0, 1).side, -1);
  assert_int_equal(closest_to(open, 0, 0, -0.5).side, -1);
  assert_int_equal(closest_to(open, 0, 2.2, -1).side, 1);
  assert_int_equal(closest_to(open, 0, -2, -0.7).side, 1);
  assert_int_equal(closest_to(open, 2.4, 0, -0.5).side, 1);
}

/* The oracle says that points of the valve move by at most about 2.6 times the change of the opening. At an opening 1e-9 from
 * either end, the surface therefore has nearly the vertices of that end. */
TEST(opens_continuously) {
  const double ends[2] = {0, 1}, near[2] = {1e-9, 1 - 1e-9};
  for (int i = 0; i < 2; ++i) {
    const int owned_before = n_owned();
    riis_surface *at_end = mitral_surface(ends[i], 0.05), *beside = mitral_surface(near[i], 0.05);
    const riis_triangles a = triangles_of(at_end), b = triangles_of(beside);
    assert_int_equal(a.n_vertices, b.n_vertices);
    double largest = 0;
    for (int64_t k = 0; k < a.n_vertices; ++k) largest = fmax(largest, distance(a.xyz + 3 * k, b.xyz + 3 * k));
    CHECK_AT_MOST(largest, 2.7e-9);
    CHECK_AT_MOST(1e-9, largest);
    free_owned_after(owned_before);
  }
}

/* An update to a new opening equals a new surface at this opening, bit for bit. */
TEST(an_update_moves_the_valve) {
  riis_valve *valve = mitral_valve(0);
  riis_surface *moving = new_surface(valve, NULL);
  for (int i = 0; i <= 10; ++i) {
    const int owned_before = n_owned();
    CHECK_OK(riis_valve_set_scalar(valve, "opening", i / 10.0));
    CHECK_OK(riis_surface_update(moving, valve, NULL));
    riis_surface *fresh = mitral_surface(i / 10.0, 0.05);
    const riis_triangles a = triangles_of(moving), b = triangles_of(fresh);
    assert_int_equal(a.n_vertices, b.n_vertices);
    assert_int_equal(a.n_triangles, b.n_triangles);
    assert_memory_equal(a.xyz, b.xyz, (size_t)a.n_vertices * 3 * sizeof *a.xyz);
    free_owned_after(owned_before);
  }
}

static double area_of(const riis_valve *valve) {
  riis_surface *surface = new_surface(valve, NULL);
  const double area = info_of(surface).area;
  free_one_owned(surface);
  return area;
}

/* With a second state, opening 0 is the first state and opening 1 the second state. */
TEST(opens_from_one_state_to_another) {
  const char *kinds[2] = {"aortic", "mitral"}, *names[2] = {"leaflet_radius_in", "AP_diameter"};
  const double values[2] = {0.9, 3.3};
  for (int i = 0; i < 2; ++i) {
    const int owned_before = n_owned();
    riis_valve *valve = new_valve(kinds[i]), *first = new_valve(kinds[i]), *second = new_valve(kinds[i]);
    CHECK_OK(riis_valve_set_scalar(second, names[i], values[i]));
    const double shift[3] = {0.25, 0, 1}; /* the translation is also interpolated */
    CHECK_OK(riis_valve_set(second, "translation", 3, shift));
    CHECK_OK(riis_valve_set_open_state(valve, second));
    CHECK_OK(riis_valve_set_scalar(valve, "opening", 0));
    CHECK_OK(riis_valve_set_scalar(first, "opening", 0));
    /* The vertices of an aortic valve depend on its motion between the states. With only one state, the valve therefore has other
     * vertices. */
    const double off = i == 0 ? 1e-3 : 0;
    CHECK_NEAR(area_of(valve), area_of(first), off);
    CHECK_OK(riis_valve_set_scalar(valve, "opening", 0.5));
    const double half_open = area_of(valve);
    riis_surface *surface = new_surface(valve, NULL);
    if (i == 1) CHECK_NEAR(info_of(surface).lower[0] + info_of(surface).upper[0], 0.25, 1e-12);
    free_one_owned(surface);
    CHECK_OK(riis_valve_set_scalar(valve, "opening", 1));
    if (i == 1) CHECK_OK(riis_valve_set_scalar(second, "opening", 1));
    CHECK_NEAR(area_of(valve), area_of(second), off);
    assert_true(half_open != area_of(valve) && half_open != area_of(first));
    /* The second state was copied, so later changes of the original have no effect. */
    const double open = area_of(valve);
    free_one_owned(second);
    CHECK_SAME(area_of(valve), open);
    free_owned_after(owned_before);
  }
}

/* Half way between two aortic states, the middle of each free edge is half way between its places in both states. */
TEST(control_points_are_blended) {
  riis_valve *valve = new_valve("aortic"), *open = new_valve("aortic");
  CHECK_OK(riis_valve_set_scalar(open, "right.leaflet_radius_in", 1.04));
  CHECK_OK(riis_valve_set_open_state(valve, open));
  CHECK_OK(riis_valve_set_scalar(valve, "opening", 0.25));
  riis_surface *surface = new_surface(valve, NULL);
  CHECK_AT_MOST(closest_to(surface, 0.75 * 0.24 + 0.25 * 1.04, 0, 0.02).distance, 1e-15);
}

TEST(refusals) {
  riis_valve *valve = mitral_valve(0.5), *aortic = NULL;
  riis_surface *surface = NULL;
  CHECK_REFUSED(RIIS_INVALID_PARAMETER, "'opening' is 1.5|from 0 to 1", riis_valve_set_scalar(valve, "opening", 1.5));
  CHECK_REFUSED(RIIS_INVALID_PARAMETER, "'opening' is nan", riis_valve_set_scalar(valve, "opening", (double)NAN));
  CHECK_REFUSED(RIIS_INVALID_PARAMETER, "'surface_angle' is 90", riis_valve_set_scalar(valve, "surface_angle", 90));
  CHECK_REFUSED(RIIS_INVALID_PARAMETER, "'root_radius' is not a parameter of the mitral",
                riis_valve_set_scalar(valve, "root_radius", 1));
  CHECK_OK(riis_valve_set_scalar(valve, "triangle_size_ratio", 0.25));
  CHECK_REFUSED(RIIS_INVALID_PARAMETER, "triangle_size_ratio is 0.25|anterior_ratio, which is 0.41",
                riis_surface_create(valve, NULL, &surface));
  CHECK_OK(riis_valve_set_scalar(valve, "triangle_size_ratio", 0.1));
  CHECK_OK(riis_valve_set_scalar(valve, "anterior_length", 20));
  CHECK_REFUSED(RIIS_INVALID_PARAMETER, "anterior_length is 20|5 times AP_diameter, which is 3",
                riis_surface_create(valve, NULL, &surface));
  CHECK_OK(riis_valve_set_scalar(valve, "anterior_length", 2.12));
  /* At the commissure, the tangent of the flat annulus points to the end of the free edge. */
  riis_valve *flat = mitral_valve(0);
  CHECK_OK(riis_valve_set_scalar(flat, "anterior_horn_height", 0));
  CHECK_OK(riis_valve_set_scalar(flat, "posterior_horn_height", 0));
  surface = new_surface(flat, NULL);
  free_one_owned(surface);
  CHECK_OK(riis_valve_set_scalar(flat, "IT_distance", 4));
  CHECK_OK(riis_valve_set_scalar(flat, "posteromedial_commissure_height", 2));
  CHECK_REFUSED(RIIS_INVALID_PARAMETER, "runs along the annulus|surface_angle|near (",
                riis_surface_create(flat, NULL, &surface));
  free_one_owned(flat);
  aortic = new_valve("aortic");
  CHECK_REFUSED(RIIS_INVALID_PARAMETER, "the kind aortic, the valve of the kind mitral",
                riis_valve_set_open_state(valve, aortic));
  CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "open is NULL", riis_valve_set_open_state(aortic, NULL));
  CHECK_REFUSED(RIIS_INVALID_PARAMETER, "'pulmonary'|there are: aortic, bi|mitral|, trileaflet",
                riis_valve_create("pulmonary", &aortic));
  /* The message names the wrong state. */
  riis_valve *open = mitral_valve(1);
  CHECK_OK(riis_valve_set_scalar(open, "anterior_length", 20));
  CHECK_OK(riis_valve_set_open_state(valve, open));
  CHECK_REFUSED(RIIS_INVALID_PARAMETER, "in the open state: anterior_length is 20",
                riis_surface_create(valve, NULL, &surface));
  CHECK_OK(riis_valve_set_scalar(open, "anterior_length", 2));
  CHECK_OK(riis_valve_set_open_state(valve, open));
  free_one_owned(open);
  /* A refused state leaves the surface unchanged. */
  surface = new_surface(valve, NULL);
}

int main(void) { return run_cases(NULL, NULL); }
