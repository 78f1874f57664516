/* SPDX-License-Identifier: Apache-2.0
 * Tests the bileaflet valve as it opens. Velocities are compared with rotations in closed form. Further cases test sealing, fixed
 * triangles, second states and copies. */
#include <riis/riis.h>

#include "test_support.h"

#include "handles.h"

#include "bileaflet_oracle.h"
#include "oracle.h"
#include "searches.h"
#include "tie_oracle.h"

static random_source rng;

static double distance(const double *p, const double *q) { return hypot(hypot(p[0] - q[0], p[1] - q[1]), p[2] - q[2]); }

static void set_opening(riis_valve *valve, double opening) {
  CHECK_OK(riis_valve_set_scalar(valve, "opening", opening));
}

static void moving_update(riis_surface *surface, riis_valve *valve, double now, double before, double seconds,
                          const riis_surface_options *options) {
  riis_valve *earlier = NULL;
  set_opening(valve, before);
  CHECK_OK(riis_valve_copy(valve, &earlier));
  own(earlier);
  set_opening(valve, now);
  CHECK_OK(riis_surface_update_moving(surface, valve, earlier, seconds, options, NULL));
  free_one_owned(earlier);
}

/* Gives the mean velocity over the step of the leaflet's point that is now at p. */
static void chord_velocity(const bileaflet *of, int32_t leaflet_id, const double *p, double now, double before,
                           double seconds, double *velocity) {
  double q[3];
  from_leaflet(of, leaflet_id, before, to_leaflet(of, leaflet_id, now, p), q);
  for (int c = 0; c < 3; ++c) velocity[c] = (p[c] - q[c]) / seconds;
}

/* Gives omega x r at p. The axis omega of the leaflet at x > 0 points along -y: the leaflet's rim goes downstream as the valve
 * opens. */
static void spin_velocity(const bileaflet *of, int32_t leaflet_id, const double *p, double angular_speed,
                          double *velocity) {
  double r[3] = {p[0], p[1], p[2]};
  half_turn(leaflet_id, r);
  r[0] -= of->hinge_offset, r[2] -= of->hinge_height;
  velocity[0] = -angular_speed * r[2], velocity[1] = 0, velocity[2] = angular_speed * r[0];
  half_turn(leaflet_id, velocity);
}

TEST(vertices_and_closest_points_turn_exactly) {
  for (int trial = 0; trial < trials_of(90); ++trial) {
    const int owned_before = n_owned();
    bileaflet of = random_bileaflet(&rng, 80);
    if (trial % 3 == 0) of.ring_height = 0.5 * of.radius;
    const double now = trial % 5 == 0 ? 0 : of.opening, before = trial % 5 == 1 ? 1 : random_between(&rng, 0, 1);
    const double seconds = (trial % 2 ? 1 : -1) * pow(10, random_between(&rng, -3, 1));
    riis_valve *valve = bileaflet_valve(&of);
    riis_surface *surface = new_surface(valve, NULL);
    riis_surface_options options = surface_options();
    if (trial % 4 == 3) options.triangulation = RIIS_TRIANGULATION_FIXED;
    moving_update(surface, valve, now, before, seconds, &options);
    const riis_triangles c = triangles_of(surface);
    const double *velocity = velocity_of(surface),
                 rounding = 1e-13 * (1 + 3 * of.radius / cos(degree * of.closed_angle)) / fabs(seconds);
    const double half_thickness = info_of(surface).half_thickness;
    double expected[3];
    for (int64_t k = 0; k < 3 * c.n_triangles; ++k) {
      const int64_t i = c.vertex_id[k];
      const int32_t leaflet = c.leaflet_id[k / 3];
      if (leaflet == RIIS_LEAFLET_HOUSING) {
        assert_true(velocity[3 * i] == 0 && velocity[3 * i + 1] == 0 && velocity[3 * i + 2] == 0);
        continue;
      }
      chord_velocity(&of, leaflet, c.xyz + 3 * i, now, before, seconds, expected);
      CHECK_AT_MOST(distance(expected, velocity + 3 * i), rounding);
    }
    enum { n_points = 200 };
    double *xyz = own(malloc(n_points * 3 * sizeof *xyz));
    for (int i = 0; i < 3 * n_points; ++i) xyz[i] = random_between(&rng, -1.3, 1.3) * of.radius;
    riis_mark_options mark = mark_options();
    mark.fields = RIIS_FIELD_POINT | RIIS_FIELD_VELOCITY;
    mark.distance_limit = 1e3;
    riis_marks *result = new_result();
    CHECK_OK(riis_mark_nodes(surface, mesh_of(n_points, xyz), &mark, result));
    const found_nodes found = within_in(result);
    riis_mark_list fields;
    CHECK_OK(riis_marks_get_list(result, RIIS_LIST_WITHIN_LIMIT, &fields, sizeof fields));
    assert_int_equal(found.n, n_points);
    for (int64_t i = 0; i < n_points; ++i) {
      if (found.leaflet_id[i] == RIIS_LEAFLET_HOUSING) continue;
      /* If leaflets are equally near, the velocity is the mean of the leaflets' velocities (test_ties). Ties that rounding
       * decides are skipped. */
      const tied_velocity tied = tied_velocity_at(&c, velocity, xyz + 3 * i, found.distance[i], half_thickness);
      if (tied.n_leaflets > 1 || !tied.is_clear) continue;
      chord_velocity(&of, found.leaflet_id[i], fields.point + 3 * i, now, before, seconds, expected);
      /* If patches of one leaflet are equally near, the velocity is also a mean. The patches' closest points may lie apart next
       * to a seam. */
      CHECK_AT_MOST(distance(tied.n_places > 1 ? tied.mean : expected, fields.velocity + 3 * i), 10 * rounding);
    }
    free_owned_after(owned_before);
  }
}

/* Returns the largest difference from omega x r over a step of the opening. */
static double from_spin(const bileaflet *of, riis_valve *valve, riis_surface *surface, double opening, double step) {
  const double per_opening =
      degree * (of->open_angle - of->closed_angle); /* radians per second, if the opening rises by 1 per second */
  moving_update(surface, valve, opening, opening - step, step, NULL);
  const riis_triangles c = triangles_of(surface);
  const double *velocity = velocity_of(surface);
  double largest = 0, expected[3];
  for (int64_t k = 0; k < 3 * c.n_triangles; ++k) {
    const int64_t i = c.vertex_id[k];
    spin_velocity(of, c.leaflet_id[k / 3], c.xyz + 3 * i, per_opening, expected);
    largest = fmax(largest, distance(expected, velocity + 3 * i));
  }
  return largest;
}

/* The velocity is a backward difference, which is of first order. The error is half the step times the acceleration, omega^2
 * |r|. */
TEST(velocities_tend_to_omega_cross_r) {
  const bileaflet of = bileaflet_defaults();
  riis_valve *valve = bileaflet_valve(&of);
  riis_surface *surface = new_surface(valve, NULL);
  const double omega = degree * 55,
               farthest = (1.1 - 0.22) / cos(degree * 30); /* the apex is farther from the hinge than the corner */
  for (int i = 1; i <= 4; ++i) {
    const double opening = 0.25 * i;
    for (double step = 0.1; step > 1e-4; step /= 10) {
      const double error = from_spin(&of, valve, surface, opening, step);
      /* For the angle a = omega step, the chord divided by the step differs from the velocity by omega a / 2 per unit of radius,
       * to second order. */
      CHECK_NEAR(error / (0.5 * omega * omega * farthest * step), 1, 0.01 * step + 1e-6);
    }
  }
}

/* Fills the unmarked nodes of a grid inside the housing, from the lowest layer. Returns 1 if the fill reaches the top. */
static int leaks(const bileaflet *of, double spacing, double half_thickness) {
  const int owned_before = n_owned();
  const double height = of->radius * (1.2 + tan(degree * of->closed_angle)) + fabs(of->hinge_height);
  const int64_t n = (int64_t)ceil(2 * of->radius / spacing), n_z = (int64_t)ceil(2 * height / spacing);
  const double half = 0.5 * spacing * (double)(n - 1), half_z = 0.5 * spacing * (double)(n_z - 1);
  const test_mesh mesh =
      lattice((int64_t[3]){n, n, n_z}, (double[3]){-half, -half, -half_z}, (double[3]){half, half, half_z});
  riis_surface_options options = surface_options();
  options.half_thickness = half_thickness;
  const riis_surface *surface = bileaflet_surface(of, &options);
  riis_marks *result = new_result();
  CHECK_OK(riis_mark_nodes(surface, mesh_of(mesh.n, mesh.xyz), NULL, result));
  const found_nodes marked = marked_in(result);
  char *is_closed = own(calloc((size_t)mesh.n, 1));
  for (int64_t i = 0; i < marked.n; ++i) is_closed[marked.node_id[i]] = 1;
  for (int64_t i = 0; i < mesh.n; ++i)
    if (hypot(mesh.xyz[3 * i], mesh.xyz[3 * i + 1]) > of->radius) is_closed[i] = 1;
  int64_t *stack = own(malloc((size_t)mesh.n * sizeof *stack)), top = 0;
  for (int64_t i = 0; i < n * n; ++i)
    if (!is_closed[i]) is_closed[i] = 1, stack[top++] = i;
  assert_true(top > 0);
  int has_leaked = 0;
  while (top > 0) {
    const int64_t i = stack[--top];
    if (i >= mesh.n - n * n) has_leaked = 1;
    for (int64_t k = mesh.offsets[i]; k < mesh.offsets[i + 1]; ++k) {
      const int64_t j = mesh.columns[k];
      if (!is_closed[j]) is_closed[j] = 1, stack[top++] = j;
    }
  }
  free_owned_after(owned_before);
  return has_leaked;
}

/* If an edge of the grid crosses a leaflet, one of its ends is within half the edge's length of the leaflet. A half thickness of
 * 0.55 spacings therefore seals. This half thickness is half a spacing plus the tolerance. */
TEST(a_closed_valve_seals_its_housing) {
  static const double angle[4] = {0, 25, 30, 45};
  for (int trial = 0; trial < trials_of(24); ++trial) {
    bileaflet of = bileaflet_defaults();
    of.closed_angle = angle[trial % 4];
    of.hinge_offset = random_between(&rng, 0, 0.9);
    of.hinge_height = trial < 4 ? 0 : random_between(&rng, -0.3, 0.3);
    const double spacing = 2.2 / random_between(&rng, 50, 60);
    assert_false(leaks(&of, spacing, 0.55 * spacing));
    /* A slit of four spacings leaks, and so does a valve at opening 0.3. */
    of.gap = 4 * spacing;
    assert_true(leaks(&of, spacing, 0.55 * spacing));
    of.gap = 0, of.opening = 0.3;
    assert_true(leaks(&of, spacing, 0.55 * spacing));
  }
}

/* Returns 1 if the closest point is on the rim, otherwise 0. */
static int rim_at(const riis_surface *surface, const double *p) {
  riis_mark_options mark = mark_options();
  mark.fields = RIIS_FIELD_RIM | RIIS_FIELD_SIDE;
  mark.distance_limit = 10;
  riis_marks *result = new_result();
  riis_mark_list fields;
  CHECK_OK(riis_mark_nodes(surface, mesh_of(1, p), &mark, result));
  CHECK_OK(riis_marks_get_list(result, RIIS_LIST_WITHIN_LIMIT, &fields, sizeof fields));
  assert_int_equal(fields.n_nodes, 1);
  return fields.rim[0];
}

/* Closed leaflets meet in an edge that is not a rim. A band that is cut at rims therefore has no slit between closed leaflets. */
TEST(leaflets_that_meet_have_no_rim_there) {
  bileaflet of = bileaflet_defaults();
  of.ring_height = 0.4;
  const double z = -0.22 * tan(degree * 30) - 0.05;
  for (int i = 0; i < 40; ++i) {
    const int owned_before = n_owned();
    const double y = random_between(&rng, -1, 1), around = 3.14159265358979323846 / 2 * i;
    of.opening = 0, of.gap = 0;
    const riis_surface *closed = bileaflet_surface(&of, NULL);
    assert_int_equal(rim_at(closed, (double[3]){0, y, z}), 0);
    assert_int_equal(closest_to(closed, 0, y, z).side, -1);
    assert_int_equal(rim_at(closed, (double[3]){random_between(&rng, 0.3, 0.8), 0, 0.3}), 0);
    /* The quarters of the ring meet without a rim. The ring's only rims are its upper and lower edges. */
    assert_int_equal(rim_at(closed, (double[3]){1.3 * cos(around), 1.3 * sin(around), 0.1}), 0);
    assert_int_equal(rim_at(closed, (double[3]){1.3 * cos(around), 1.3 * sin(around), i % 2 ? -0.3 : 0.3}), 1);
    of.gap = 0.01;
    assert_int_equal(rim_at(bileaflet_surface(&of, NULL), (double[3]){0, y, z}), 1);
    of.gap = 0, of.opening = 0.01;
    assert_int_equal(rim_at(bileaflet_surface(&of, NULL), (double[3]){0, y, z - 0.05}), 1);
    free_owned_after(owned_before);
  }
}

TEST(fixed_triangles_stay) {
  for (int trial = 0; trial < 4; ++trial) {
    const int owned_before = n_owned();
    bileaflet of = random_bileaflet(&rng, 60);
    if (trial % 2) of.ring_height = 0.3 * of.radius;
    riis_surface_options options = surface_options();
    options.triangulation = RIIS_TRIANGULATION_FIXED;
    options.tolerance = pow(10, random_between(&rng, -3, -1));
    riis_valve *valve = bileaflet_valve(&of);
    riis_surface *first = new_surface(valve, &options), *surface = new_surface(valve, &options);
    const riis_triangles a = triangles_of(first);
    for (int i = 0; i <= 20; ++i) {
      of.opening = 0.05 * i;
      set_opening(valve, of.opening);
      CHECK_OK(riis_surface_update(surface, valve, NULL));
      const riis_triangles b = triangles_of(surface);
      assert_int_equal(a.n_vertices, b.n_vertices);
      assert_int_equal(a.n_triangles, b.n_triangles);
      assert_memory_equal(a.vertex_id, b.vertex_id, (size_t)a.n_triangles * 24);
      const double bound = info_of(surface).error_bound;
      CHECK_AT_MOST(bound, 0.1 * options.tolerance);
      if (of.ring_height != 0) continue;
      for (int k = 0; k < 30; ++k) {
        double p[3];
        for (int c = 0; c < 3; ++c) p[c] = random_between(&rng, -1.5, 1.5) * of.radius;
        CHECK_NEAR(closest_to(surface, p[0], p[1], p[2]).distance, to_bileaflet(&of, p), bound + 1e-9);
      }
    }
    free_owned_after(owned_before);
  }
}

/* A second state changes all numbers. While the valve opens, the angle goes from the first state's closed angle to the second
 * state's open angle. */
TEST(numbers_blend_to_a_second_state) {
  for (int trial = 0; trial < trials_of(30); ++trial) {
    const int owned_before = n_owned();
    bileaflet from = random_bileaflet(&rng, 40), to = random_bileaflet(&rng, 40);
    from.open_angle = random_between(&rng, 41, 90), to.open_angle = random_between(&rng, 41, 90);
    if (trial % 2) from.ring_height = 0.3, to.ring_height = 0.6;
    from.opening = 0, to.opening = 1;
    riis_valve *valve = bileaflet_valve(&from), *open = bileaflet_valve(&to);
    CHECK_OK(riis_valve_set_open_state(valve, open));
    riis_surface *surface = new_surface(valve, NULL);
    assert_true(is_same_content(surface, bileaflet_surface(&from, NULL)));
    set_opening(valve, 1);
    CHECK_OK(riis_surface_update(surface, valve, NULL));
    assert_true(is_same_content(surface, new_surface(open, NULL)));
    const double s = random_between(&rng, 0, 1);
    bileaflet between;
    for (int i = 0; i < n_bileaflet_fields; ++i)
      memcpy((char *)&between + bileaflet_fields[i].at,
             &(double){(1 - s) * *bileaflet_field(&from, i) + s * *bileaflet_field(&to, i)}, sizeof(double));
    /* The oracle needs the closed and the open angle, and its outline depends on the closed angle. */
    const double angle = (1 - s) * from.closed_angle + s * to.open_angle;
    between.open_angle = 90;
    between.opening = (angle - between.closed_angle) / (90 - between.closed_angle);
    set_opening(valve, s);
    CHECK_OK(riis_surface_update(surface, valve, NULL));
    const double bound = info_of(surface).error_bound;
    for (int k = 0; k < 200; ++k) {
      double p[3];
      for (int c = 0; c < 3; ++c) p[c] = random_between(&rng, -1.5, 1.5);
      const double to_ring = hypot(hypot(p[0], p[1]) - between.radius, fmax(fabs(p[2]) - between.ring_height / 2, 0));
      const double expected = fmin(to_bileaflet(&between, p), trial % 2 ? to_ring : INFINITY);
      CHECK_NEAR(closest_to(surface, p[0], p[1], p[2]).distance, expected, bound + 1e-9);
    }
    free_owned_after(owned_before);
  }
}

TEST(second_states_are_refused) {
  riis_valve *valve = new_valve("bileaflet"), *open = new_valve("bileaflet"), *aortic = new_valve("aortic");
  riis_surface *surface = new_surface(valve, NULL);
  CHECK_REFUSED(RIIS_INVALID_PARAMETER, "the kind aortic, the valve of the kind bileaflet",
                riis_valve_set_open_state(valve, aortic));
  CHECK_OK(riis_valve_set_scalar(open, "ring_height", 0.5));
  CHECK_REFUSED(RIIS_INVALID_PARAMETER,
                "ring_height is 0 in the valve and 0.5 in the open state|both must have a ring, or neither",
                riis_valve_set_open_state(valve, open));
  CHECK_REFUSED(RIIS_INVALID_PARAMETER, "ring_height is 0 in the valve and 0.5 in valve_before",
                riis_surface_update_moving(surface, valve, open, 1, NULL, NULL));
  /* The ring of the open state may be removed after the second state was set. */
  CHECK_OK(riis_valve_set_scalar(open, "ring_height", 0));
  CHECK_OK(riis_valve_set_open_state(valve, open));
  CHECK_OK(riis_valve_set_scalar(valve, "ring_height", 0.5));
  CHECK_REFUSED(RIIS_INVALID_PARAMETER, "ring_height is 0.5 in the valve and 0 in the open state",
                riis_surface_update(surface, valve, NULL));
  CHECK_OK(riis_valve_set_scalar(valve, "ring_height", 0));
  CHECK_OK(riis_valve_set_scalar(open, "closed_angle", 10));
  CHECK_OK(riis_valve_set_scalar(open, "open_angle", 25));
  CHECK_OK(riis_valve_set_open_state(valve, open));
  CHECK_REFUSED(RIIS_INVALID_PARAMETER,
                "open_angle is 25 in the open state; it must be more than the valve's closed_angle, which is 30",
                riis_surface_update(surface, valve, NULL));
  CHECK_OK(riis_valve_set_scalar(open, "gap", 3));
  CHECK_OK(riis_valve_set_open_state(valve, open));
  CHECK_REFUSED(RIIS_INVALID_PARAMETER, "in the open state: gap is 3", riis_surface_update(surface, valve, NULL));
}

TEST(a_copy_moves_by_itself) {
  bileaflet of = random_bileaflet(&rng, 60);
  riis_valve *valve = bileaflet_valve(&of), *copy = NULL;
  CHECK_OK(riis_valve_copy(valve, &copy));
  own(copy);
  const riis_surface *before = new_surface(valve, NULL);
  assert_true(is_same_content(before, new_surface(copy, NULL)));
  set_opening(valve, of.opening / 2);
  assert_true(is_same_content(before, new_surface(copy, NULL)));
  assert_false(is_same_content(before, new_surface(valve, NULL)));
}

int main(void) {
  rng = random_start("test_bileaflet_motion");
  return run_cases(NULL, NULL);
}
