/* SPDX-License-Identifier: Apache-2.0
 * The trileaflet valve has three equal cusps. The cusps have the same bits where they meet, close a vessel, and open
 * (docs/theory/trileaflet.md). */
#include <riis/riis.h>

#include "test_support.h"

#include "handles.h"

#include "cusp_checks.h"

static const double turn[3] = {0, 120, -120}, half_angle[3] = {60, 60, 60};
/* Defaults: the root radius R, the radius at the commissures, and the height of the free edges before and after the
 * translation. */
static const double root = 1.25, commissure = 1.25, edge_height = 1.2, edge_z = 0;

static riis_valve *copy_of(const riis_valve *valve) {
  riis_valve *copy = NULL;
  CHECK_OK(riis_valve_copy(valve, &copy));
  return own(copy);
}

static double distance(const double *p, const double *q) { return hypot(hypot(p[0] - q[0], p[1] - q[1]), p[2] - q[2]); }

/* --- The closed state -------------------------------------------------------------------------------------------------- */

/* Free edges lie on the lines from the axis to the commissures. */
TEST(closed_free_edges_are_straight) {
  const riis_triangles all = triangles_of(new_surface(new_valve("trileaflet"), NULL));
  double farthest = 0, nearest = 1;
  for (int64_t i = 0; i < 3 * all.n_triangles; ++i) {
    const int64_t v = all.vertex_id[i];
    const int32_t patch = all.patch_id[i / 3];
    if (patch % 2 == 0 || all.uv[2 * v + 1] != 1) continue;
    const double a = (turn[patch / 4] + (patch % 4 == 1 ? 60 : -60)) * cusp_degree, *p = all.xyz + 3 * v;
    const double along = p[0] * cos(a) + p[1] * sin(a), across = p[1] * cos(a) - p[0] * sin(a);
    CHECK_NEAR(across, 0, 1e-15);
    CHECK_NEAR(p[2], edge_z, 1e-15);
    /* The position along the edge is proportional to u, because arc length is the parameter of both curves. */
    CHECK_NEAR(along, all.uv[2 * v] * commissure, 1e-12);
    farthest = fmax(farthest, along), nearest = fmin(nearest, along);
  }
  CHECK_NEAR(farthest, commissure, 1e-15);
  CHECK_SAME(fabs(nearest), 0); /* fmin may return 0 or -0 */
}

static int64_t n_of_pairs, n_of_places;

/* Checks pairs of vertices of different cusps that are nearer than 1e-9. The vertices of a pair must have the same bits, up to
 * the sign of zero. Counts such pairs, and the pairs on the axis. */
static void check_common_vertices(const riis_surface *surface, double scale) {
  const riis_triangles all = triangles_of(surface);
  int32_t *cusp = own(malloc((size_t)all.n_vertices * sizeof *cusp));
  for (int64_t i = 0; i < all.n_vertices; ++i) cusp[i] = -1;
  for (int64_t i = 0; i < 3 * all.n_triangles; ++i) cusp[all.vertex_id[i]] = all.leaflet_id[i / 3];
  n_of_pairs = n_of_places = 0;
  for (int64_t i = 0; i < all.n_vertices; ++i)
    for (int64_t j = 0; j < i; ++j) {
      const double *p = all.xyz + 3 * i, *q = all.xyz + 3 * j;
      if (cusp[i] < 0 || cusp[j] < 0 || cusp[i] == cusp[j] || fabs(p[0] - q[0]) > 1e-9 * scale) continue;
      if (distance(p, q) > 1e-9 * scale) continue;
      for (int c = 0; c < 3; ++c) CHECK_SAME(p[c], q[c]);
      ++n_of_pairs;
      n_of_places += all.uv[2 * i] == 1 && all.uv[2 * i + 1] == 1;
    }
  free_one_owned(cusp);
}

/* Cusps have the same bits where they meet. The bits agree for both triangulations, in placed surfaces and after moving
 * updates. */
TEST(cusps_meet_in_the_same_bits) {
  random_source random = random_start("test_trileaflet");
  for (int trial = 0; trial < trials_of(72); ++trial) {
    const int owned_before = n_owned();
    riis_surface_options options = surface_options();
    options.tolerance = trial % 3 ? 0.3 : 0.1;
    options.triangulation = trial % 2 ? RIIS_TRIANGULATION_FIXED : RIIS_TRIANGULATION_ADAPTED;
    if (trial % 4 >= 2) {
      options.scale = pow(10, random_between(&random, -2, 2));
      options.rotation_angle = random_between(&random, -180, 180);
      for (int c = 0; c < 3; ++c) options.rotation_axis[c] = random_between(&random, 0.1, 1);
      for (int c = 0; c < 3; ++c) options.translation[c] = options.scale * random_between(&random, -1, 1);
    }
    const double opening = trial < 12 ? 0 : trial < 14 ? 1 : random_between(&random, 0.05, 1);
    riis_valve *valve = valve_at("trileaflet", opening), *before = valve_at("trileaflet", 0.5);
    const double shift[3] = {trial % 5 ? 0 : -0.0, random_between(&random, -1, 1), trial % 5 ? -1.2 : 0.3};
    CHECK_OK(riis_valve_set(valve, "translation", 3, shift));
    CHECK_OK(riis_valve_set(before, "translation", 3, shift));
    CHECK_OK(riis_valve_set_scalar(valve, "root_radius", 1.3));
    CHECK_OK(riis_valve_set_scalar(before, "root_radius", 1.3));
    riis_surface *surface = new_surface(valve, &options);
    check_common_vertices(surface, options.scale);
    assert_true(n_of_places >= 3);
    assert_true(opening > 0 ? n_of_pairs == n_of_places : n_of_pairs > 3 * 4 + n_of_places);
    const int64_t n_pairs = n_of_pairs;
    riis_surface *plain = new_surface(valve, &options);
    CHECK_OK(riis_surface_update_moving(surface, valve, before, 0.1, NULL, NULL));
    check_common_vertices(surface, options.scale);
    assert_int_equal(n_of_pairs, n_pairs);
    assert_true(is_same_content(surface, plain));
    free_owned_after(owned_before);
  }
}

/* A turn by 120 degrees about the axis does not change the valve. Each cusp equals its mirror image. */
TEST(cusps_are_equal) {
  for (int i = 0; i <= 4; ++i) {
    riis_surface_options options = surface_options();
    riis_valve *valve = valve_at("trileaflet", i / 4.0);
    riis_surface *surface = new_surface(valve, &options);
    options.rotation_angle = 120;
    riis_surface *turned = new_surface(valve, &options);
    const riis_triangles all = triangles_of(surface);
    for (int64_t v = 0; v < all.n_vertices; ++v) {
      const double *p = all.xyz + 3 * v;
      CHECK_AT_MOST(closest_to(turned, p[0], p[1], p[2]).distance, 1e-14);
      CHECK_AT_MOST(closest_to(surface, p[0], -p[1], p[2]).distance, 1e-14);
    }
    double area[12] = {0};
    for (int64_t t = 0; t < all.n_triangles; ++t) {
      const double *p = all.xyz + 3 * all.vertex_id[3 * t], *q = all.xyz + 3 * all.vertex_id[3 * t + 1],
                   *r = all.xyz + 3 * all.vertex_id[3 * t + 2];
      const double a = distance(p, q), b = distance(q, r), c = distance(r, p), s = (a + b + c) / 2;
      area[all.patch_id[t]] += sqrt(fmax(0, s * (s - a) * (s - b) * (s - c)));
    }
    for (int k = 0; k < 12; ++k) CHECK_NEAR(area[k], area[k % 2], 1e-12);
  }
}

/* Only the triangles at the three root points have no area. */
TEST(triangles_have_an_area) {
  for (int i = 0; i <= 10; ++i) {
    riis_surface *surface = new_surface(valve_at("trileaflet", i / 10.0), NULL);
    const riis_triangles all = triangles_of(surface);
    int64_t n_at_root = 0;
    for (int64_t t = 0; t < all.n_triangles; ++t) {
      const double *p[3];
      double n[3], longest = 0;
      int at_root = 0;
      for (int k = 0; k < 3; ++k) p[k] = all.xyz + 3 * all.vertex_id[3 * t + k];
      for (int c = 0; c < 3; ++c) {
        const int d = (c + 1) % 3, e = (c + 2) % 3;
        n[c] = (p[1][d] - p[0][d]) * (p[2][e] - p[0][e]) - (p[1][e] - p[0][e]) * (p[2][d] - p[0][d]);
      }
      for (int k = 0; k < 3; ++k) longest = fmax(longest, distance(p[k], p[(k + 1) % 3]));
      for (int k = 0; k < 3; ++k) at_root |= all.patch_id[t] % 2 == 0 && all.uv[2 * all.vertex_id[3 * t + k] + 1] == 0;
      assert_true(hypot(hypot(n[0], n[1]), n[2]) > 1e-6 * longest * longest);
      n_at_root += at_root;
    }
    /* Each quad at a root point has only one triangle with area. */
    assert_int_equal(info_of(surface).n_zero_area, n_at_root);
  }
}

/* --- Sealing ----------------------------------------------------------------------------------------------------------- */

TEST(closes_cylinders) {
  static const double radii[3] = {1.2, 1.25, 1.29};
  for (int i = 0; i < 3; ++i) {
    assert_false(leaks_through(new_valve("trileaflet"), radii[i], -2, 0.1));
    assert_true(leaks_through(valve_at("trileaflet", 0.25), radii[i], -2, 0.1));
    assert_true(leaks_through(new_valve("aortic"), radii[i], -2, 0.1)); /* the paper's aortic valve does not close */
  }
  assert_true(leaks_through(new_valve("trileaflet"), 1.6, -2, 0.1)); /* flow passes around the valve */
}

/* The attachment lies near the wall of a cylinder. The test prints the deviation for users who make meshes. */
TEST(attachment_is_near_a_cylinder) {
  riis_surface_options options = surface_options();
  options.tolerance = 0.01;
  const riis_triangles all = triangles_of(new_surface(new_valve("trileaflet"), &options));
  double low = 9, high = 0, printed = -1;
  for (int64_t v = 0; v < all.n_vertices; ++v) {
    const double *p = all.xyz + 3 * v, r = hypot(p[0], p[1]);
    if (all.uv[2 * v] != 1) continue;
    low = fmin(low, r), high = fmax(high, r);
  }
  printf("the attachment's radius is from %.4f to %.4f\n", low, high);
  for (int64_t i = 0; i < 3 * all.n_triangles; ++i) {
    const int64_t v = all.vertex_id[i];
    const double *p = all.xyz + 3 * v, angle = atan2(p[1], p[0]) / cusp_degree;
    if (all.patch_id[i / 3] > 1 || all.uv[2 * v] != 1 || angle < printed + 4) continue;
    printf("  at %4.1f degrees: radius %.3f, height %.3f\n", angle, hypot(p[0], p[1]), p[2] + edge_height);
    printed = angle;
  }
  assert_true(low > root - 0.04 && high < root + 0.04);
}

/* --- Opening ----------------------------------------------------------------------------------------------------------- */

/* Returns the length of both halves of the free edge, from their control points. */
static double edge_by_formula(double t) {
  const double sine = sin(60 * cusp_degree), closed = commissure, open = 1.1 * commissure, r = 0.8 * root;
  double control[4][2], length = 0, last[2] = {0, 0};
  for (int k = 0; k < 4; ++k) { /* a straight line, and the parabola r + (x1 - r) (y / y1)^2 */
    const double share = k / 3.0, end = open / 2;
    control[k][0] = (1 - t) * share * closed / 2 + t * (k < 2 ? r : k == 3 ? end : r + (end - r) / 3);
    control[k][1] = ((1 - t) * closed + t * open) * share * sine;
  }
  for (int i = 0; i <= 4000; ++i) {
    const double s = i / 4000.0,
                 p[4] = {(1 - s) * (1 - s) * (1 - s), 3 * s * (1 - s) * (1 - s), 3 * s * s * (1 - s), s * s * s};
    double at[2] = {0, 0};
    for (int k = 0; k < 4; ++k)
      for (int c = 0; c < 2; ++c) at[c] += p[k] * control[k][c];
    if (i > 0) length += hypot(at[0] - last[0], at[1] - last[1]);
    memcpy(last, at, sizeof at);
  }
  return 2 * length;
}

TEST(free_edges_have_the_lengths_of_the_formula) {
  riis_surface_options options = surface_options();
  options.tolerance = 0.01;
  for (int i = 0; i <= 10; ++i) {
    double lengths[3];
    free_edge_lengths(new_surface(valve_at("trileaflet", i / 10.0), &options), lengths);
    for (int cusp = 0; cusp < 3; ++cusp) CHECK_NEAR(lengths[cusp], edge_by_formula(i / 10.0), 2e-3);
  }
  CHECK_NEAR(edge_by_formula(0), 2.5, 1e-12);
  for (int i = 0; i <= 100; ++i) CHECK_NEAR(edge_by_formula(i / 100.0) / 2.5, 1, 0.1);
}

TEST(opens_by_itself) {
  const double orifice = check_opening(new_valve("trileaflet"), root, turn, half_angle, 0.1, "trileaflet");
  assert_true(orifice > 3 && orifice < 4);
  /* In the closed valve, only slivers along the wall stay uncovered. */
  assert_true(orifice_area(new_surface(new_valve("trileaflet"), NULL), root, 600) < 0.05);
  CHECK_AT_MOST(orifice_area(new_surface(new_valve("trileaflet"), NULL), 1.23, 600), 0);
}

/* With fixed triangles, a vertex's velocity is its displacement divided by the time. A small difference occurs only on grid lines
 * that end between two vertices of a side, because such lines end on chords. Closed cusps meet, and each vertex there has the
 * outward velocity of its own cusp. */
TEST(velocity_is_that_of_the_vertices) {
  riis_surface_options options = surface_options();
  options.triangulation = RIIS_TRIANGULATION_FIXED;
  static const double openings[4][2] = {{0.5, 0.25}, {1, 0.9}, {0, 0.125}, {0.1, 0}};
  for (int trial = 0; trial < 4; ++trial) {
    riis_valve *valve = valve_at("trileaflet", openings[trial][0]),
               *before = valve_at("trileaflet", openings[trial][1]);
    riis_surface *surface = new_surface(valve, &options), *then = new_surface(before, &options);
    const double seconds = openings[trial][0] - openings[trial][1];
    CHECK_OK(riis_surface_update_moving(surface, valve, before, seconds, NULL, NULL));
    const riis_triangles a = triangles_of(surface), b = triangles_of(then);
    const double *velocity = velocity_of(surface);
    assert_int_equal(a.n_vertices, b.n_vertices);
    for (int64_t i = 0; i < 3 * a.n_vertices; ++i) CHECK_NEAR(velocity[i], (a.xyz[i] - b.xyz[i]) / seconds, 0.01);
    /* Per unit of opening, the edge's middle moves by 0.8 root radii, and the commissure by a tenth of its radius. */
    for (int64_t i = 0; i < 3 * a.n_triangles; ++i) {
      const int64_t v = a.vertex_id[i];
      const int32_t patch = a.patch_id[i / 3];
      const double *w = velocity + 3 * v, share = a.uv[2 * v], middle = turn[a.leaflet_id[i / 3]] * cusp_degree;
      if (patch % 2 == 0 || a.uv[2 * v + 1] != 1) continue;
      assert_true(w[0] * cos(middle) + w[1] * sin(middle) > 0.05); /* outwards, in the direction of its own cusp */
      if (share == 0 || share == 1) {
        const double speed = share == 0 ? 0.8 * root : 0.1 * commissure;
        const double way = middle + share * (patch % 4 == 1 ? 60 : -60) * cusp_degree;
        CHECK_NEAR(w[0], speed * cos(way), 1e-13);
        CHECK_NEAR(w[1], speed * sin(way), 1e-13);
      }
    }
  }
}

/* A closed free edge is not a rim, because the neighbouring cusp continues there. An open free edge is a rim. */
TEST(closed_free_edges_are_no_rims) {
  const double probe[3] = {0.5 * cos(60 * cusp_degree), 0.5 * sin(60 * cusp_degree), 0.05};
  for (int opening = 0; opening <= 1; ++opening) {
    riis_surface *surface = new_surface(valve_at("trileaflet", opening), NULL);
    const double open_probe[3] = {1, 0, 0.05};
    riis_mesh *mesh = mesh_of(1, opening ? open_probe : probe);
    riis_mark_options options = mark_options();
    options.fields = RIIS_FIELD_RIM | RIIS_FIELD_SIDE;
    riis_marks *result = NULL;
    riis_mark_list fields;
    CHECK_OK(riis_marks_create(&result));
    own(result);
    CHECK_OK(riis_mark_nodes(surface, mesh, &options, result));
    CHECK_OK(riis_marks_get_list(result, RIIS_LIST_MARKED, &fields, sizeof fields));
    assert_int_equal(fields.n_nodes, 1);
    assert_int_equal(fields.rim[0], opening);
    if (!opening) assert_int_equal(fields.side[0], 1); /* above the closed valve is downstream */
  }
}

/* If there is a second valve, the closed curves come from the first valve, and the open curves from the second. */
TEST(opens_to_another_valves_open_state) {
  riis_valve *valve = new_valve("trileaflet"), *other = new_valve("trileaflet"), *plain = new_valve("trileaflet");
  CHECK_OK(riis_valve_set_scalar(other, "open_radius_ratio", 0.9));
  CHECK_OK(riis_valve_set_open_state(valve, other));
  assert_true(is_same_content(new_surface(valve, NULL), new_surface(plain, NULL)));
  CHECK_OK(riis_valve_set_scalar(valve, "opening", 1));
  CHECK_OK(riis_valve_set_scalar(other, "opening", 1));
  assert_true(is_same_content(new_surface(valve, NULL), new_surface(other, NULL)));
  assert_true(is_same_content(new_surface(valve, NULL), new_surface(copy_of(valve), NULL)));
  check_common_vertices(new_surface(valve, NULL), 1);
  CHECK_OK(riis_valve_set_scalar(plain, "opening", 1));
  assert_false(is_same_content(new_surface(valve, NULL), new_surface(plain, NULL)));
}

TEST(every_parameter_by_name) {
  static const struct {
    const char *name;
    int64_t n_values;
    double values[3];
  } table[] = {{"root_radius", 1, {1.25}},
               {"leaflet_radius_out", 1, {1.25}},
               {"leaflet_height", 1, {1.2}},
               {"bending_height", 1, {0.6}},
               {"bending_radius_in", 1, {0.4}},
               {"bending_radius_out", 1, {1.275}},
               {"bending_angle", 1, {35}},
               {"bending_power", 1, {1.8}},
               {"t0_bending", 1, {0.25}},
               {"t3_bending", 1, {0.25}},
               {"xq", 1, {-0.22}},
               {"zq", 1, {-0.35}},
               {"translation", 3, {0, 0, -1.2}},
               {"opening", 1, {0}},
               {"open_radius_ratio", 1, {0.8}},
               {"commissure_expansion", 1, {0.1}},
               {"skirt_length", 1, {0}}};
  const int n_parameters = sizeof table / sizeof *table;
  riis_valve *valve = new_valve("trileaflet");
  int64_t n;
  CHECK_OK(riis_valve_get_n_parameters(valve, &n));
  assert_int_equal(n, n_parameters);
  for (int i = 0; i < n_parameters; ++i) {
    riis_parameter parameter;
    double values[3] = {0, 0, 0};
    CHECK_OK(riis_valve_get_parameter(valve, i, &parameter, sizeof parameter));
    assert_string_equal(parameter.name, table[i].name);
    CHECK_OK(riis_valve_get(valve, table[i].name, table[i].n_values, values));
    assert_memory_equal(values, table[i].values, sizeof values);
    assert_memory_equal(parameter.default_values, table[i].values, sizeof values);
    /* A small change of the open state changes the surface. */
    riis_valve *changed = valve_at("trileaflet", 0.5);
    for (int k = 0; k < table[i].n_values; ++k) values[k] += 0.01;
    CHECK_OK(riis_valve_set(changed, table[i].name, table[i].n_values, values));
    assert_false(is_same_content(new_surface(changed, NULL), new_surface(valve_at("trileaflet", 0.5), NULL)));
  }
}

TEST(values_that_do_not_go_together_are_refused) {
  riis_surface *surface = NULL;
#define IS_REFUSED(name, value, text)                                                        \
  do {                                                                                       \
    riis_valve *valve = new_valve("trileaflet");                                             \
    CHECK_OK(riis_valve_set_scalar(valve, name, value));                                     \
    CHECK_REFUSED(RIIS_INVALID_PARAMETER, text, riis_surface_create(valve, NULL, &surface)); \
    assert_null(surface);                                                                    \
  } while (0)
  IS_REFUSED("bending_height", 1.2, "bending_height is 1.2|leaflet_height, which is 1.2");
  IS_REFUSED("leaflet_height", 20, "leaflet_height is 20|root_radius, which is 1.25");
  IS_REFUSED("leaflet_radius_out", 0.01, "leaflet_radius_out is 0.01|from 0.05");
  IS_REFUSED("bending_radius_in", 13, "bending_radius_in is 13|root_radius");
  IS_REFUSED("t0_bending", 13, "t0_bending is 13|root_radius");
  IS_REFUSED("bending_height", 0.07, "a cusp's symmetry curve reaches|bending_height");
  IS_REFUSED("t3_bending", 12, "a cusp's bending curve reaches|t3_bending");
  riis_valve *valve = new_valve("trileaflet"), *aortic = new_valve("aortic");
  CHECK_OK(riis_valve_set_scalar(valve, "leaflet_radius_out", 5));
  new_surface(valve, NULL);
  CHECK_OK(riis_valve_set_scalar(valve, "commissure_expansion", 0.5));
  CHECK_REFUSED(RIIS_INVALID_PARAMETER, "in the open state, a cusp's leaflet curve reaches 7.5|commissure_expansion",
                riis_surface_create(valve, NULL, &surface));
  CHECK_REFUSED(RIIS_INVALID_PARAMETER, "'bending_angle' is 61|from 5 to 60",
                riis_valve_set_scalar(valve, "bending_angle", 61));
  CHECK_REFUSED(RIIS_INVALID_PARAMETER, "'leaflet_radius_in' is not a parameter of the trileaflet valve",
                riis_valve_set_scalar(valve, "leaflet_radius_in", 0.1));
  CHECK_REFUSED(RIIS_INVALID_PARAMETER, "'right.bending_angle' is not a parameter of the trileaflet valve",
                riis_valve_set_scalar(valve, "right.bending_angle", 30));
  CHECK_REFUSED(RIIS_INVALID_PARAMETER, "the kind aortic, the valve of the kind trileaflet",
                riis_valve_set_open_state(valve, aortic));
}

int main(void) { return run_cases(NULL, NULL); }
