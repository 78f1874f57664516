/* SPDX-License-Identifier: Apache-2.0
 * Compares the shape of the bileaflet valve with its closed form: distances, areas, rims, images and the ring. Wrong parameters
 * are refused. */
#include <riis/riis.h>

#include "test_support.h"

#include "handles.h"

#include "bileaflet_oracle.h"

static random_source rng;

static void random_point(const bileaflet *of, double *p) {
  for (int c = 0; c < 3; ++c) p[c] = random_between(&rng, -1.6, 1.6) * of->radius;
  p[2] += of->hinge_height;
}

TEST(defaults_are_as_documented) {
  riis_valve *valve = new_valve("bileaflet");
  const bileaflet expected = bileaflet_defaults();
  int64_t n;
  CHECK_OK(riis_valve_get_n_parameters(valve, &n));
  assert_int_equal(n, n_bileaflet_fields);
  for (int i = 0; i < n_bileaflet_fields; ++i) {
    riis_parameter parameter;
    double value;
    CHECK_OK(riis_valve_get_parameter(valve, i, &parameter, sizeof parameter));
    assert_string_equal(parameter.name, bileaflet_fields[i].name);
    assert_int_equal(parameter.n_values, 1);
    CHECK_OK(riis_valve_get(valve, parameter.name, 1, &value));
    CHECK_SAME(value, *bileaflet_field(&expected, i));
    CHECK_SAME(parameter.default_values[0], value);
  }
}

/* With a closed angle and a gap of 0, the leaflets are the halves of a disc, and the closed valve is this disc. */
TEST(half_discs_have_their_distances) {
  const double tolerance[3] = {0.05, 1e-3, 1e-5};
  double largest[3] = {0, 0, 0};
  for (int trial = 0; trial < trials_of(36); ++trial) {
    const int owned_before = n_owned(), t = trial % 3;
    bileaflet of = random_bileaflet(&rng, 0);
    of.gap = 0;
    if (trial % 2) of.opening = 0;
    riis_surface_options options = surface_options();
    options.half_thickness = 0.1;
    options.tolerance = tolerance[t];
    const riis_surface *surface = bileaflet_surface(&of, &options);
    const double bound = info_of(surface).error_bound;
    CHECK_AT_MOST(bound, 0.1 * tolerance[t]);
    for (int i = 0; i < 3000; ++i) {
      double p[3], expected = INFINITY;
      random_point(&of, p);
      for (int32_t leaflet = 0; leaflet < 2; ++leaflet)
        expected = fmin(expected, to_half_disc(of.radius, of.hinge_offset, to_leaflet(&of, leaflet, of.opening, p)));
      if (of.opening == 0)
        CHECK_NEAR(expected, hypot(fmax(hypot(p[0], p[1]) - of.radius, 0), p[2] - of.hinge_height), 1e-14);
      const double off = fabs(closest_to(surface, p[0], p[1], p[2]).distance - expected);
      largest[t] = fmax(largest[t], off / bound);
      CHECK_AT_MOST(off, bound + 1e-14);
    }
    free_owned_after(owned_before);
  }
  for (int t = 0; t < 3; ++t) CHECK_MET(largest[t] > 0.1); /* the bound must not be far too large */
}

/* The leaflets are half ellipses with slits between them, at any opening. */
TEST(leaflets_have_their_distances) {
  for (int trial = 0; trial < trials_of(90); ++trial) {
    const int owned_before = n_owned();
    const bileaflet of = random_bileaflet(&rng, trial % 2 ? 80 : 40);
    riis_surface_options options = surface_options();
    options.half_thickness = 0.1;
    options.tolerance = pow(10, random_between(&rng, -5, -1));
    const riis_surface *surface = bileaflet_surface(&of, &options);
    const double bound = info_of(surface).error_bound;
    CHECK_AT_MOST(bound, 0.1 * options.tolerance);
    for (int i = 0; i < 300; ++i) {
      double p[3];
      random_point(&of, p);
      CHECK_NEAR(closest_to(surface, p[0], p[1], p[2]).distance, to_bileaflet(&of, p), bound + 1e-9);
    }
    free_owned_after(owned_before);
  }
}

TEST(other_distances_are_right_too) {
  const bileaflet of = bileaflet_defaults();
  for (int32_t method = RIIS_MEASURE_SAMPLING; method <= RIIS_MEASURE_MINIMIZATION; ++method) {
    riis_surface_options options = surface_options();
    options.measure = method;
    const riis_surface *surface = bileaflet_surface(&of, &options);
    for (int i = 0; i < 200; ++i) {
      double p[3];
      random_point(&of, p);
      const double off = closest_to(surface, p[0], p[1], p[2]).distance - to_bileaflet(&of, p);
      CHECK_AT_MOST(-0.1 * 0.005, off + 1e-9);
      if (method == RIIS_MEASURE_SAMPLING) CHECK_AT_MOST(off, 0.005 + 1e-9);
    }
  }
}

TEST(areas_are_those_of_ellipses) {
  for (int trial = 0; trial < trials_of(120); ++trial) {
    const int owned_before = n_owned();
    const bileaflet of = random_bileaflet(&rng, 80);
    riis_surface_options options = surface_options();
    options.tolerance = pow(10, random_between(&rng, -5, -1));
    const riis_surface_info info = info_of(bileaflet_surface(&of, &options));
    const double area = bileaflet_area(&of), rim = 4 * 3.15 * of.radius / cos(degree * of.closed_angle);
    assert_true(info.area < area + 1e-8);
    CHECK_NEAR(info.area, area, rim * info.error_bound);
    free_owned_after(owned_before);
  }
}

/* The rim of closed leaflets lies on the housing. The middle edges are straight and half a gap away from the plane x = 0. A
 * closed valve without a gap was not rotated, so x is exactly 0 on its middle edges. */
TEST(closed_leaflets_fill_the_housing) {
  for (int trial = 0; trial < trials_of(120); ++trial) {
    const int owned_before = n_owned();
    bileaflet of = random_bileaflet(&rng, 80);
    of.opening = 0;
    const riis_triangles c = triangles_of(bileaflet_surface(&of, NULL));
    const double slope = tan(degree * of.closed_angle);
    for (int64_t i = 0; i < c.n_vertices; ++i) {
      const double *p = c.xyz + 3 * i, from_axis = hypot(p[0], p[1]), v = c.uv[2 * i + 1];
      CHECK_AT_MOST(from_axis, of.radius * (1 + 1e-8));
      if (v == 0) CHECK_NEAR(from_axis, of.radius, 1e-8 * of.radius);
      if (v == 1) CHECK_NEAR(fabs(p[0]), of.gap / 2, 1e-15 * of.gap); /* exactly 0 without a gap */
      CHECK_NEAR(p[2], of.hinge_height + (fabs(p[0]) - of.hinge_offset) * slope, 1e-13 * (1 + slope) * (1 + of.radius));
    }
    free_owned_after(owned_before);
  }
}

/* While the leaflets open, the corners of their middle edges leave the housing (docs/theory/bileaflet.md). */
TEST(open_leaflets_reach_beyond_the_housing) {
  for (int trial = 0; trial < trials_of(60); ++trial) {
    const int owned_before = n_owned();
    bileaflet of = trial ? random_bileaflet(&rng, 60) : bileaflet_defaults();
    of.gap = 0, of.opening = 1;
    riis_surface_options options = surface_options();
    options.tolerance = 1e-4;
    const riis_surface *surface = bileaflet_surface(&of, &options);
    const riis_triangles c = triangles_of(surface);
    const double q = cos(degree * of.open_angle) / cos(degree * of.closed_angle), h = of.hinge_offset;
    const double expected = sqrt(of.radius * of.radius + h * h * (1 - q) / (1 + q));
    double farthest = 0;
    for (int64_t i = 0; i < c.n_vertices; ++i) farthest = fmax(farthest, hypot(c.xyz[3 * i], c.xyz[3 * i + 1]));
    /* Vertices lie on the outline up to the error bound. The farthest point of the outline may lie between two vertices. */
    CHECK_AT_MOST(farthest, expected + 1e-8 * of.radius);
    CHECK_NEAR(farthest, expected, 20 * info_of(surface).error_bound);
    if (!trial) CHECK_NEAR(farthest / of.radius, 1.016, 5e-4);
    free_owned_after(owned_before);
  }
}

/* The patches are four images of one half leaflet. Without a gap, closed leaflets have the same bits where they meet. */
TEST(images_are_images) {
  static const double sign[4][2] = {{1, 1}, {1, -1}, {-1, -1}, {-1, 1}};
  for (int trial = 0; trial < trials_of(60); ++trial) {
    const int owned_before = n_owned();
    bileaflet of = random_bileaflet(&rng, 80);
    if (trial % 2) of.opening = 0, of.gap = 0;
    const riis_triangles c = triangles_of(bileaflet_surface(&of, NULL));
    const int64_t n = c.n_vertices / 4;
    assert_int_equal(c.n_vertices, 4 * n);
    for (int64_t i = 0; i < c.n_vertices; ++i) {
      const double *p = c.xyz + 3 * i, *q = c.xyz + 3 * (i % n);
      assert_true(p[0] == sign[i / n][0] * q[0] && p[1] == sign[i / n][1] * q[1] && p[2] == q[2]);
      if (trial % 2 && c.uv[2 * i + 1] == 1) assert_true(p[0] == 0);
    }
    for (int64_t t = 0; t < c.n_triangles; ++t) {
      assert_int_equal(c.leaflet_id[t], c.patch_id[t] / 2);
      for (int k = 0; k < 3; ++k) assert_int_equal(c.vertex_id[3 * t + k] / n, c.patch_id[t]);
    }
    free_owned_after(owned_before);
  }
}

/* Returns twice the area vector of a triangle. */
static void area_vector(const riis_triangles *c, int64_t triangle, double *normal) {
  const int64_t *id = c->vertex_id + 3 * triangle;
  double a[3], b[3];
  for (int k = 0; k < 3; ++k)
    a[k] = c->xyz[3 * id[1] + k] - c->xyz[3 * id[0] + k], b[k] = c->xyz[3 * id[2] + k] - c->xyz[3 * id[0] + k];
  for (int k = 0; k < 3; ++k) normal[k] = a[(k + 1) % 3] * b[(k + 2) % 3] - a[(k + 2) % 3] * b[(k + 1) % 3];
}

/* Every triangle's normal is its plane's normal. The normal points downstream in the closed valve, and towards the axis in the
 * open valve. */
TEST(normals_point_downstream) {
  for (int trial = 0; trial < trials_of(60); ++trial) {
    const int owned_before = n_owned();
    bileaflet of = random_bileaflet(&rng, 80);
    const riis_surface *surface = bileaflet_surface(&of, NULL);
    const riis_triangles c = triangles_of(surface);
    for (int64_t t = 0; t < c.n_triangles; ++t) {
      double n[3];
      area_vector(&c, t, n);
      const double size = sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]), angle = angle_of(&of, of.opening);
      assert_true(size > 0);
      half_turn(c.leaflet_id[t], n);
      CHECK_NEAR(n[0] / size, -sin(angle), 1e-6);
      CHECK_NEAR(n[1] / size, 0, 1e-6);
      CHECK_NEAR(n[2] / size, cos(angle), 1e-6);
    }
    assert_int_equal(info_of(surface).n_zero_area, 4); /* one triangle without area at each half leaflet's corner */
    free_owned_after(owned_before);
  }
  riis_surface *closed = surface_of_kind("bileaflet", NULL);
  assert_int_equal(closest_to(closed, 0.5, 0.3, 1).side, 1);
  assert_int_equal(closest_to(closed, 0.5, 0.3, 1).leaflet_id, RIIS_LEAFLET_POSITIVE);
  assert_int_equal(closest_to(closed, -0.5, 0.3, -0.5).side, -1);
  assert_int_equal(closest_to(closed, -0.5, 0.3, -0.5).leaflet_id, RIIS_LEAFLET_NEGATIVE);
}

/* The ring is a closed cylinder at rest. One half of the ring lies on each side of the orifice plane. */
TEST(a_ring_is_the_housing) {
  for (int trial = 0; trial < trials_of(30); ++trial) {
    const int owned_before = n_owned();
    bileaflet of = random_bileaflet(&rng, 60), without = of;
    of.ring_height = random_between(&rng, 0.01, 1) * of.radius;
    riis_surface_options options = surface_options();
    options.tolerance = pow(10, random_between(&rng, -4, -1));
    const riis_surface *surface = bileaflet_surface(&of, &options), *leaflets = bileaflet_surface(&without, &options);
    const riis_triangles c = triangles_of(surface), d = triangles_of(leaflets);
    const double bound = info_of(surface).error_bound;
    double area = 0;
    int64_t n_of_ring = 0;
    for (int64_t t = 0; t < c.n_triangles; ++t) {
      if (c.leaflet_id[t] != RIIS_LEAFLET_HOUSING) continue;
      double n[3], outwards = 0;
      area_vector(&c, t, n);
      area += 0.5 * sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
      assert_true(c.patch_id[t] >= 4 && c.patch_id[t] < 8);
      for (int k = 0; k < 3; ++k) {
        const double *p = c.xyz + 3 * c.vertex_id[3 * t + k];
        CHECK_NEAR(hypot(p[0], p[1]), of.radius, 1e-8 * of.radius);
        CHECK_NEAR(fabs(p[2]), of.ring_height / 2, 1e-15 * of.ring_height);
        outwards += n[0] * p[0] + n[1] * p[1];
      }
      assert_true(outwards > 0);
      ++n_of_ring;
    }
    assert_int_equal(n_of_ring, c.n_triangles - d.n_triangles);
    const double whole = 2 * 3.14159265358979323846 * of.radius * of.ring_height;
    CHECK_NEAR(area, whole, 7 * bound * of.ring_height);
    /* The ring does not change a single bit of the leaflets. */
    assert_memory_equal(c.xyz, d.xyz, (size_t)d.n_vertices * 24);
    for (int i = 0; i < 200; ++i) {
      double p[3];
      random_point(&of, p);
      const double to_ring = hypot(hypot(p[0], p[1]) - of.radius, fmax(fabs(p[2]) - of.ring_height / 2, 0));
      CHECK_NEAR(closest_to(surface, p[0], p[1], p[2]).distance, fmin(to_ring, to_bileaflet(&of, p)), bound + 1e-9);
    }
    free_owned_after(owned_before);
  }
}

/* Cubic curves approximate the arcs, and the error bound includes the deviation of the cubic curves from circles. A tolerance
 * that is not larger than the deviation is refused. */
TEST(the_bound_counts_that_arcs_are_cubics) {
  riis_valve *valve = new_valve("bileaflet");
  riis_surface *surface = NULL;
  riis_surface_options options = surface_options();
  options.tolerance = 1e-6;
  options.half_thickness = 2.5e-3;
  CHECK_REFUSED(RIIS_LIMIT_EXCEEDED,
                "the valve's curves are accurate to 1.3|more than half of tolerance * half_thickness",
                riis_surface_create(valve, &options, &surface));
  options.triangulation = RIIS_TRIANGULATION_FIXED;
  CHECK_REFUSED(RIIS_LIMIT_EXCEEDED, "the valve's curves are accurate to",
                riis_surface_create(valve, &options, &surface));
  options.triangulation = RIIS_TRIANGULATION_ADAPTED;
  options.half_thickness = 4e-3;
  surface = new_surface(valve, &options);
  const riis_triangles c = triangles_of(surface);
  double deviation = 0;
  for (int64_t i = 0; i < c.n_vertices; ++i)
    if (c.uv[2 * i + 1] == 0) deviation = fmax(deviation, fabs(hypot(c.xyz[3 * i], c.xyz[3 * i + 1]) - 1.1));
  CHECK_NEAR(deviation, 1.1 * 1.036e-9, 0.01e-9); /* 2/27 sin^6(a/4) / cos^2(a/4) for 11.25 degrees */
  const double bound = info_of(surface).error_bound;
  assert_true(bound > deviation);
  CHECK_AT_MOST(bound, 4e-9);
}

/* Checks that a value is refused if it is invalid together with the defaults of the other parameters. */
static void expect_refused(const char *name, double value, const char *parts) {
  riis_valve *valve = new_valve("bileaflet");
  riis_surface *surface = NULL;
  CHECK_OK(riis_valve_set_scalar(valve, name, value));
  CHECK_REFUSED(RIIS_INVALID_PARAMETER, parts, riis_surface_create(valve, NULL, &surface));
  free_one_owned(valve);
}

TEST(bad_values_are_refused) {
  riis_valve *valve = new_valve("bileaflet");
  CHECK_REFUSED(RIIS_INVALID_PARAMETER, "'radius' is 0", riis_valve_set_scalar(valve, "radius", 0));
  CHECK_REFUSED(RIIS_INVALID_PARAMETER, "'hinge_offset' is -0.1", riis_valve_set_scalar(valve, "hinge_offset", -0.1));
  CHECK_REFUSED(RIIS_INVALID_PARAMETER, "'gap' is -1", riis_valve_set_scalar(valve, "gap", -1));
  CHECK_REFUSED(RIIS_INVALID_PARAMETER, "'closed_angle' is -1; it must be from 0 to 80",
                riis_valve_set_scalar(valve, "closed_angle", -1));
  CHECK_REFUSED(RIIS_INVALID_PARAMETER, "'open_angle' is 90.5; it must be from 0 to 90",
                riis_valve_set_scalar(valve, "open_angle", 90.5));
  CHECK_REFUSED(RIIS_INVALID_PARAMETER, "'ring_height' is -1", riis_valve_set_scalar(valve, "ring_height", -1));
  CHECK_REFUSED(RIIS_INVALID_PARAMETER, "'raduis' is not a parameter of the bileaflet valve|did you mean 'radius'",
                riis_valve_set_scalar(valve, "raduis", 1));
  expect_refused("hinge_offset", 1.05, "hinge_offset is 1.05; it must be from 0 to 0.9 times radius, which is 1.1");
  expect_refused("hinge_height", -12, "hinge_height is -12; it must be from 0 to 10 times radius");
  expect_refused("gap", 1.2, "gap is 1.2; it must be from 0 to 1 times radius, which is 1.1");
  expect_refused("ring_height", 0.001, "ring_height is 0.001; it must be from 0.01 to 10 times radius");
  expect_refused("ring_height", 12, "ring_height is 12");
  expect_refused("open_angle", 30, "closed_angle is 30; it must be less than open_angle, which is 30");
  expect_refused("open_angle", 20, "closed_angle is 30; it must be less than open_angle, which is 20");
}

int main(void) {
  rng = random_start("test_bileaflet");
  return run_cases(NULL, NULL);
}
