/* SPDX-License-Identifier: Apache-2.0
 * Tests the triangles of the aortic valve: the published numbers, the shape, the triangles' data, and the placement. */
#include <riis/riis.h>

#include "test_support.h"

#include "handles.h"

TEST(numbers_of_the_model) {
  /* The area and bounds of the smooth model. Triangles lie on chords. As the tolerance falls, the area and the bounds of the
   * triangles approach those of the smooth model from below. */
  const double tolerance[3] = {0.05, 0.005, 0.0005}, area_error[3] = {2e-2, 2e-3, 4e-4};
  double last_area = 0;
  for (int i = 0; i < 3; ++i) {
    riis_surface_options options = surface_options();
    options.tolerance = tolerance[i];
    riis_surface *surface = aortic_surface(&options);
    const riis_surface_info info = info_of(surface);
    free_one_owned(surface);
    CHECK_NEAR(info.area, 6.9862, area_error[i]);
    assert_true(info.area > last_area);
    last_area = info.area;
    const double lower[3] = {-1.494, -1.431, -1.000}, upper[3] = {1.290, 1.321, 0.020};
    for (int c = 0; c < 3; ++c) {
      CHECK_NEAR(info.lower[c], lower[c], 5e-4 + tolerance[i] * 0.1);
      CHECK_NEAR(info.upper[c], upper[c], 5e-4 + tolerance[i] * 0.1);
    }
  }
}

TEST(default_half_thickness_follows_the_scale) {
  riis_surface_options options = surface_options();
  riis_surface *surface = aortic_surface(NULL);
  CHECK_NEAR(info_of(surface).half_thickness, 0.1, 1e-17);
  free_one_owned(surface);
  options.scale = 0.01;
  surface = aortic_surface(&options);
  CHECK_NEAR(info_of(surface).half_thickness, 0.001, 1e-18);
  free_one_owned(surface);
  options.half_thickness = 0.0005;
  surface = aortic_surface(&options);
  CHECK_SAME(info_of(surface).half_thickness, 0.0005);
}

/* Checks all data of every triangle. */
TEST(triangles_carry_patch_leaflet_u_and_v) {
  riis_surface *surface = aortic_surface(NULL);
  int64_t per_patch[12] = {0};
  const int64_t n_vertices = triangles_of(surface).n_vertices;
  const double *xyz = triangles_of(surface).xyz;
  const int64_t n_uv = triangles_of(surface).n_vertices;
  const double *uv = triangles_of(surface).uv;
  const int64_t n_triangles = triangles_of(surface).n_triangles;
  const int64_t *vertex_id = triangles_of(surface).vertex_id;
  const int64_t *triangle_id = triangles_of(surface).triangle_id;
  const int32_t *leaflet_id = triangles_of(surface).leaflet_id;
  const int32_t *patch_id = triangles_of(surface).patch_id;
  assert_int_equal(n_uv, n_vertices);
  assert_int_equal(n_triangles, info_of(surface).n_triangles);
  assert_int_equal(n_vertices, info_of(surface).n_vertices);
  assert_true(info_of(surface).n_zero_area >= 6); /* triangles at the root points of the half cusps */
  for (int64_t i = 0; i < n_triangles; ++i) {
    double p[3][3], n[3], longest = 0;
    assert_int_equal(triangle_id[i], i);
    assert_true(patch_id[i] >= 0 && patch_id[i] < 12);
    assert_int_equal(leaflet_id[i], patch_id[i] / 4);
    ++per_patch[patch_id[i]];
    for (int k = 0; k < 3; ++k) {
      const int64_t id = vertex_id[3 * i + k];
      assert_true(id >= 0 && id < n_vertices);
      memcpy(p[k], xyz + 3 * id, sizeof p[k]);
      for (int c = 0; c < 2; ++c) assert_true(uv[2 * id + c] >= 0 && uv[2 * id + c] <= 1);
      /* The side v = 1 of a top patch is the free edge. The side v = 0 of a bottom patch has the root point's height. */
      if (patch_id[i] % 2 == 1 && uv[2 * id + 1] == 1) CHECK_NEAR(p[k][2], 0.02, 1e-12);
      if (patch_id[i] % 2 == 0 && uv[2 * id + 1] == 0) CHECK_NEAR(p[k][2], -1, 1e-12);
    }
    for (int k = 0; k < 3; ++k) {
      double sum = 0;
      for (int c = 0; c < 3; ++c) sum += (p[(k + 1) % 3][c] - p[k][c]) * (p[(k + 1) % 3][c] - p[k][c]);
      longest = fmax(longest, sqrt(sum));
    }
    for (int c = 0; c < 3; ++c) {
      const int d = (c + 1) % 3, e = (c + 2) % 3;
      n[c] = (p[1][d] - p[0][d]) * (p[2][e] - p[0][e]) - (p[1][e] - p[0][e]) * (p[2][d] - p[0][d]);
    }
    assert_true(sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]) > 1e-12 * longest * longest);
  }
  for (int i = 0; i < 12; ++i) assert_true(per_patch[i] > 50);
  for (int i = 0; i < 12; i += 4) { /* mirror images have the same number of triangles */
    assert_int_equal(per_patch[i], per_patch[i + 2]);
    assert_int_equal(per_patch[i + 1], per_patch[i + 3]);
  }
}

/* Downstream is from the ventricle to the sinus. A point in each sinus, between cusp and wall, has the side +1. A point below the
 * closed middle has the side -1. Flipped normals exchange the sides. */
TEST(normals_point_downstream) {
  const double angle[3] = {0, 119.5, -121.5};
  for (int flip = 0; flip < 2; ++flip) {
    const int owned_before = n_owned();
    riis_surface_options options = surface_options();
    options.flip_normals = flip;
    riis_surface *surface = aortic_surface(&options);
    const int downstream = flip ? -1 : 1;
    for (int cusp = 0; cusp < 3; ++cusp) {
      const double a = angle[cusp] * 3.14159265358979323846 / 180;
      riis_closest in_sinus = closest_to(surface, 1.15 * cos(a), 1.15 * sin(a), -0.3);
      assert_int_equal(in_sinus.leaflet_id, cusp);
      assert_int_equal(in_sinus.side, downstream);
      riis_closest below = closest_to(surface, 0.7 * cos(a), 0.7 * sin(a), -1.2);
      assert_int_equal(below.leaflet_id, cusp);
      assert_int_equal(below.side, -downstream);
    }
    /* A cusp as a whole faces downstream: its area vector points outwards and upwards. */
    double outwards[3] = {0, 0, 0}, upwards[3] = {0, 0, 0};
    const double *xyz = triangles_of(surface).xyz;
    const int64_t n = triangles_of(surface).n_triangles;
    const int64_t *id = triangles_of(surface).vertex_id;
    const int32_t *leaflet_id = triangles_of(surface).leaflet_id;
    for (int64_t i = 0; i < n; ++i) {
      const double *a = xyz + 3 * id[3 * i], *b = xyz + 3 * id[3 * i + 1], *c = xyz + 3 * id[3 * i + 2];
      const double normal[3] = {(b[1] - a[1]) * (c[2] - a[2]) - (b[2] - a[2]) * (c[1] - a[1]),
                                (b[2] - a[2]) * (c[0] - a[0]) - (b[0] - a[0]) * (c[2] - a[2]),
                                (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])};
      const double turn = angle[leaflet_id[i]] * 3.14159265358979323846 / 180;
      outwards[leaflet_id[i]] += downstream * (normal[0] * cos(turn) + normal[1] * sin(turn));
      upwards[leaflet_id[i]] += downstream * normal[2];
    }
    for (int cusp = 0; cusp < 3; ++cusp) {
      assert_true(outwards[cusp] > 0.5);
      assert_true(upwards[cusp] > 0.5);
    }
    free_owned_after(owned_before);
  }
}

/* The triangles are scaled, then rotated, then moved. */
TEST(placement_is_applied_last) {
  riis_surface_options options = surface_options();
  options.scale = 0.01;
  options.rotation_axis[0] = 3; /* the x axis, of any length */
  options.rotation_axis[2] = 0;
  options.rotation_angle = 90; /* maps y to z, and z to -y */
  options.translation[0] = 5;
  options.translation[1] = -7;
  options.translation[2] = 11;
  riis_surface *plain = aortic_surface(NULL), *placed = aortic_surface(&options);
  const int64_t n = triangles_of(plain).n_vertices;
  const double *a = triangles_of(plain).xyz;
  const int64_t n_placed = triangles_of(placed).n_vertices;
  const double *b = triangles_of(placed).xyz;
  assert_int_equal(n, n_placed);
  for (int64_t i = 0; i < 3 * n; i += 3) {
    CHECK_NEAR(b[i], 0.01 * a[i] + 5, 1e-14);
    CHECK_NEAR(b[i + 1], -0.01 * a[i + 2] - 7, 1e-14);
    CHECK_NEAR(b[i + 2], 0.01 * a[i + 1] + 11, 1e-14);
  }
}

TEST(three_cusps_are_three_pieces) {
  riis_surface *surface = aortic_surface(NULL);
  const int64_t n_vertices = triangles_of(surface).n_vertices;
  const double *xyz = triangles_of(surface).xyz;
  const int64_t n = triangles_of(surface).n_triangles;
  const int64_t *id = triangles_of(surface).vertex_id;
  const int32_t *leaflet_id = triangles_of(surface).leaflet_id;
  /* A vertex of one cusp never touches another cusp, because the cusps have different radii at a commissure. Measures the
   * smallest gap at each commissure. */
  double gap = INFINITY;
  int32_t *of_vertex = own(malloc((size_t)n_vertices * sizeof *of_vertex));
  for (int64_t i = 0; i < n_vertices; ++i) of_vertex[i] = -1; /* -1 stays at vertices without a triangle */
  for (int64_t i = 0; i < 3 * n; ++i) of_vertex[id[i]] = leaflet_id[i / 3];
  for (int64_t i = 0; i < n_vertices; ++i)
    for (int64_t j = i + 1; j < n_vertices; ++j)
      if (of_vertex[i] >= 0 && of_vertex[j] >= 0 && of_vertex[i] != of_vertex[j]) {
        const double *a = xyz + 3 * i, *b = xyz + 3 * j;
        gap = fmin(gap, hypot(hypot(a[0] - b[0], a[1] - b[1]), a[2] - b[2]));
      }
  printf("smallest gap between vertices of two cusps: %.3g\n", gap);
  assert_true(gap > 1e-3);
}

static int compare_edges(const void *a, const void *b) { return memcmp(a, b, 6 * sizeof(double)); }

/* In any placement, the two halves of a cusp have the same bits where they meet, in the cusp's symmetry plane. Every edge in a
 * cusp's symmetry plane (u = 0 at both ends) belongs to exactly two triangles. If an edge belonged to one triangle only, the
 * sides of points at a folded cusp would be wrong. */
TEST(halves_meet_to_the_last_bit) {
  const double turned[3] = {10, -20, 77}, moved[3] = {0.3, 0.2, -0.1};
  riis_valve *valve = new_valve("aortic");
  for (int trial = 0; trial < 3; ++trial) {
    const int owned_before = n_owned();
    riis_surface_options options = surface_options();
    if (trial == 1) { /* the sharpest fold that the parameters allow */
      CHECK_OK(riis_valve_set_scalar(valve, "leaflet_power", 1));
      CHECK_OK(riis_valve_set_scalar(valve, "bending_power", 1));
      CHECK_OK(riis_valve_set_scalar(valve, "leaflet_angle", 20));
      CHECK_OK(riis_valve_set_scalar(valve, "bending_angle", 20));
    }
    if (trial == 2) {
      CHECK_OK(riis_valve_set(valve, "rotation", 3, turned));
      CHECK_OK(riis_valve_set(valve, "translation", 3, moved));
      options.scale = 0.01;
      options.rotation_angle = 33;
      options.translation[1] = 3;
    }
    riis_surface *surface = new_surface(valve, &options);
    int64_t n_edges = 0;
    const double *xyz = triangles_of(surface).xyz;
    const double *uv = triangles_of(surface).uv;
    const int64_t n = triangles_of(surface).n_triangles;
    const int64_t *id = triangles_of(surface).vertex_id;
    double(*edges)[6] = own(malloc((size_t)n * 3 * sizeof *edges));
    for (int64_t i = 0; i < 3 * n; ++i) {
      const int64_t a = id[i], b = id[i % 3 == 2 ? i - 2 : i + 1];
      if (uv[2 * a] != 0 || uv[2 * b] != 0) continue;
      const int swap = memcmp(xyz + 3 * a, xyz + 3 * b, 3 * sizeof *xyz) > 0;
      for (int c = 0; c < 3; ++c) { /* + 0 turns -0 into 0 */
        edges[n_edges][c] = xyz[3 * (swap ? b : a) + c] + 0.0;
        edges[n_edges][3 + c] = xyz[3 * (swap ? a : b) + c] + 0.0;
      }
      ++n_edges;
    }
    qsort(edges, (size_t)n_edges, sizeof *edges, compare_edges);
    int64_t n_lonely = n_edges % 2;
    for (int64_t i = 0; i + 1 < n_edges; i += 2) n_lonely += compare_edges(edges[i], edges[i + 1]) != 0;
    free_owned_after(owned_before);
    assert_true(n_edges > 50);
    assert_int_equal(n_lonely, 0);
  }
}

TEST(parameters_change_the_surface_and_update_keeps_the_handle) {
  riis_valve *valve = NULL;
  riis_surface *surface = NULL;
  const double translation[3] = {0, 0, 4};
  riis_surface_options options = surface_options();
  options.scale = 2;
  CHECK_OK(riis_valve_create("aortic", &valve));
  CHECK_OK(riis_surface_create(valve, &options, &surface));
  CHECK_NEAR(info_of(surface).lower[2], -2, 1e-12);
  CHECK_OK(riis_valve_set(valve, "translation", 3, translation)); /* moves all cusps */
  CHECK_OK(riis_surface_update(surface, valve, NULL));            /* the update keeps the scale */
  CHECK_NEAR(info_of(surface).lower[2], 8, 1e-12);
  CHECK_OK(riis_valve_set_scalar(valve, "leaflet_height", 1.5));
  CHECK_OK(riis_surface_update(surface, valve, NULL));
  CHECK_NEAR(info_of(surface).upper[2], 11, 1e-12);
  const double own[3] = {0, 0, 5};
  CHECK_OK(riis_valve_set(valve, "right.translation", 3, own));
  CHECK_OK(riis_surface_update(surface, valve, NULL));
  CHECK_NEAR(info_of(surface).lower[2], 8, 1e-12);
  CHECK_NEAR(info_of(surface).upper[2], 13, 1e-12);
  /* A refused update changes nothing. */
  const riis_surface_info before = info_of(surface);
  CHECK_OK(riis_valve_set_scalar(valve, "bending_height", 1.5));
  CHECK_REFUSED(RIIS_INVALID_PARAMETER, "bending_height", riis_surface_update(surface, valve, NULL));
  const riis_surface_info after = info_of(surface);
  assert_memory_equal(&before, &after, sizeof before);
  riis_surface_destroy(&surface);
  riis_valve_destroy(&valve);
  assert_null(surface);
  assert_null(valve);
}

/* Every parameter except root_height changes the triangles. All parameters of the paper's table exist and have the paper's
 * defaults. */
TEST(every_parameter_by_name) {
  static const struct {
    const char *name;
    double value;
  } table[] = {{"root_height", 1},
               {"root_radius", 1.29},
               {"leaflet_height", 1.02},
               {"bending_height", 0.71},
               {"xq", -0.2},
               {"zq", -0.2},
               {"right.leaflet_radius_in", 0.24},
               {"right.leaflet_radius_out", 1.365},
               {"right.leaflet_angle", 61},
               {"right.leaflet_power", 1.58},
               {"right.bending_radius_in", 0.4},
               {"right.bending_radius_out", 1.39},
               {"right.bending_angle", 47.3},
               {"right.bending_power", 1.82},
               {"left.leaflet_radius_in", 0.49},
               {"left.leaflet_radius_out", 1.495},
               {"left.leaflet_angle", 58.5},
               {"left.leaflet_power", 2.77},
               {"left.bending_radius_in", 0.74},
               {"left.bending_radius_out", 1.355},
               {"left.bending_angle", 43},
               {"left.bending_power", 4.12},
               {"non_coronary.leaflet_radius_in", 0.2},
               {"non_coronary.leaflet_radius_out", 1.38},
               {"non_coronary.leaflet_angle", 60.5},
               {"non_coronary.leaflet_power", 1.19},
               {"non_coronary.bending_radius_in", 0.67},
               {"non_coronary.bending_radius_out", 1.435},
               {"non_coronary.bending_angle", 42.75},
               {"non_coronary.bending_power", 2.54},
               {"open_radius_ratio", 0.75},
               {"commissure_expansion", 0.05},
               {"skirt_length", 0}};
  static const struct {
    const char *name;
    double values[3];
  } vectors[] = {
      {"t3_leaflet", {0.5, 0.5, 0.65}},          {"t3_bending", {0.55, 0.23, 0.4}}, {"t0_leaflet", {0.025, 0.1, 0.1}},
      {"t0_bending", {0.1, 0.1, 0.1}},           {"right.rotation", {0, 0, 0}},     {"left.rotation", {0, 0, 119.5}},
      {"non_coronary.rotation", {0, 0, -121.5}}, {"right.translation", {0, 0, -1}}, {"left.translation", {0, 0, -1}},
      {"non_coronary.translation", {0, 0, -1}}};
  const int n_scalars = sizeof table / sizeof *table, n_vectors = sizeof vectors / sizeof *vectors;
  int64_t n = 0;
  riis_valve *valve = new_valve("aortic");
  CHECK_OK(riis_valve_get_n_parameters(valve, &n));
  assert_int_equal(n, n_scalars + n_vectors + 1); /* + 1 is the opening */
  for (int i = 0; i < n_scalars + n_vectors; ++i) {
    const char *name = i < n_scalars ? table[i].name : vectors[i - n_scalars].name;
    const int n_values = i < n_scalars ? 1 : 3;
    const double *expected = i < n_scalars ? &table[i].value : vectors[i - n_scalars].values;
    double values[3];
    CHECK_OK(riis_valve_get(valve, name, n_values, values));
    for (int k = 0; k < n_values; ++k) CHECK_SAME(values[k], expected[k]);
    /* A small change of a parameter changes the surface. The old value restores the old surface. */
    const int owned_before = n_owned();
    riis_surface *before = new_surface(valve, NULL);
    for (int k = 0; k < n_values; ++k) values[k] += 0.01;
    CHECK_OK(riis_valve_set(valve, name, n_values, values));
    riis_surface *after = new_surface(valve, NULL);
    const int changed = info_of(before).area != info_of(after).area ||
                        info_of(before).upper[2] != info_of(after).upper[2] ||
                        info_of(before).upper[0] != info_of(after).upper[0];
    free_owned_after(owned_before);
    /* At opening 0 the parameters of the open state have no effect. */
    const int matters =
        strcmp(name, "root_height") && strcmp(name, "open_radius_ratio") && strcmp(name, "commissure_expansion");
    if (changed != matters) fail_msg("%s: the surface %s", name, changed ? "changed" : "did not change");
    CHECK_OK(riis_valve_set(valve, name, n_values, expected));
  }
  for (int64_t i = 0; i < n; ++i) {
    riis_parameter parameter;
    double values[3];
    CHECK_OK(riis_valve_get_parameter(valve, i, &parameter, sizeof parameter));
    CHECK_OK(riis_valve_get(valve, parameter.name, parameter.n_values, values));
    for (int64_t k = 0; k < parameter.n_values; ++k) {
      CHECK_SAME(values[k], parameter.default_values[k]);
      assert_true(parameter.minimum <= values[k] && values[k] <= parameter.maximum);
    }
    assert_true(strlen(parameter.unit) > 0 && strlen(parameter.description) > 10);
  }
}

int main(void) { return run_cases(NULL, NULL); }
