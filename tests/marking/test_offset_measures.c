/* SPDX-License-Identifier: Apache-2.0
 * Tests measures of a band with an offset: leaks of flat and curved surfaces, orifices, first passages, forces and moments, and K
 * of a sheet that turns about its rim. Each result is compared with a closed form or an oracle. */
#include <riis/riis.h>

#include "test_support.h"

#include "handles.h"
#include "searches.h"

#include "band_oracle.h"
#include "random_meshes.h"
#include "shapes.h"

#include "flood_fill.h"

#include "band_floods.h"

static const double pi = 3.14159265358979323846;

static riis_resistance resistance_of(double R, double half_thickness, int32_t rim) {
  riis_resistance made;
  CHECK_OK(riis_resistance_init(&made, sizeof made));
  made.R = R, made.half_thickness = half_thickness, made.rim = rim;
  return made;
}

static riis_surface_options banded(double half_thickness, double offset, int flips) {
  riis_surface_options options = surface_options();
  options.half_thickness = half_thickness, options.offset = offset, options.flip_normals = flips;
  return options;
}

/* --- The ideal leak --- */

enum { n_around = 40, n_rows = 5, n_across = 24 };

/* Returns the leak for R = 1, a drop of 1 and the half thickness eps, divided by eps. The returned quotient equals the area of
 * the moved surface. */
static double moved_area(const riis_surface_arrays *arrays, double eps, double offset, int flips) {
  const riis_surface_options options = banded(flips ? eps : 2 * eps, offset, flips);
  riis_surface *surface = surface_from(arrays, &options);
  /* The resistance may have a separate half thickness, which then scales the band's offset. */
  const riis_resistance how = resistance_of(1, flips ? RIIS_AUTO : eps, RIIS_RIM_ROUND);
  double flow = 0;
  CHECK_OK(riis_surface_get_leak(surface, &how, 1, &flow));
  free_one_owned(surface);
  return flow / eps;
}

TEST(the_leak_of_a_flat_sheet_has_the_sheets_area) {
  static const double corner[12] = {-1, -1, 0, 2, -1, 0, 2, 1, 0, -1, 1, 0};
  static const int32_t ids[6] = {0, 1, 2, 0, 2, 3};
  const riis_surface_arrays arrays = triangle_arrays(4, corner, 2, ids);
  for (int flips = 0; flips < 2; ++flips)
    for (double offset = -0.75; offset < 1; offset += 0.25)
      CHECK_NEAR(moved_area(&arrays, 0.1, offset, flips), 6, 1e-14);
}

/* Makes a cylinder of quads. The cylinder's normals point outwards, and the normals at its vertices are radial. */
TEST(the_leak_of_a_cylinder_grows_with_its_radius) {
  const double radius = 1.5, height = 2, eps = 0.1;
  double xyz[3 * n_around * n_rows];
  int32_t ids[4 * n_around * (n_rows - 1)], *next = ids;
  for (int j = 0; j < n_rows; ++j)
    for (int i = 0; i < n_around; ++i) {
      const double angle = 2 * pi * i / n_around,
                   vertex[3] = {radius * cos(angle), radius * sin(angle), height * j / (n_rows - 1)};
      memcpy(xyz + 3 * (j * n_around + i), vertex, sizeof vertex);
      if (j + 1 == n_rows) continue;
      const int32_t here = j * n_around + i, beside = j * n_around + (i + 1) % n_around;
      const int32_t quad[4] = {here, beside, beside + n_around, here + n_around};
      memcpy(next, quad, sizeof quad), next += 4;
    }
  riis_surface_arrays arrays = triangle_arrays(n_around * n_rows, xyz, n_around * (n_rows - 1), ids);
  arrays.corners_per_face = 4;
  const double area = 2 * n_around * radius * sin(pi / n_around) * height, H = 1 / (2 * radius);
  for (int flips = 0; flips < 2; ++flips)
    for (double offset = -0.75; offset < 1; offset += 0.25) {
      const double outwards = flips ? -offset : offset;
      CHECK_NEAR(moved_area(&arrays, eps, offset, flips), area * (1 + 2 * H * outwards * eps), 1e-13 * area);
    }
}

/* Makes a ball from an octahedron's triangles. The moved ball has (1 + H o eps)^2 times the area, because H is 1 / radius. */
TEST(the_leak_of_a_ball_grows_with_its_radius) {
  const double radius = 1.5, eps = 0.1;
  static double xyz[8 * n_across * n_across * 9];
  static int32_t ids[8 * n_across * n_across * 3];
  int32_t n = 0;
  for (int octant = 0; octant < 8; ++octant)
    for (int i = 0; i < n_across; ++i)
      for (int j = 0; j < 2 * (n_across - i) - 1; ++j) {
        const int turns = j % 2, a = i, b = j / 2;
        const int corners[3][2] = {{a + turns, b + turns}, {a + 1, b}, {a, b + 1}};
        const int sign[3] = {octant & 1 ? -1 : 1, octant & 2 ? -1 : 1, octant & 4 ? -1 : 1};
        const int is_mirrored = (sign[0] * sign[1] * sign[2] < 0) != (turns != 0);
        for (int k = 0; k < 3; ++k, ++n) {
          const int *const at = corners[k], whole[3] = {at[0], at[1], n_across - at[0] - at[1]};
          const double size = hypot(hypot(whole[0], whole[1]), whole[2]);
          for (int c = 0; c < 3; ++c) xyz[3 * n + c] = radius * sign[c] * whole[c] / size + 0.0;
          ids[n] = n - k + (is_mirrored ? 2 - k : k);
        }
      }
  const riis_surface_arrays arrays = triangle_arrays(n, xyz, n / 3, ids);
  const double area = moved_area(&arrays, eps, 0, 0), H = 1 / radius;
  CHECK_NEAR(area, 4 * pi * radius * radius, 3e-3 * area);
  for (int flips = 0; flips < 2; ++flips)
    for (double offset = -0.75; offset < 1; offset += 0.25) {
      const double moved = 1 + H * (flips ? -offset : offset) * eps;
      /* The normals at vertices are radial up to the size of a triangle, so the area changes to second order. */
      CHECK_NEAR(moved_area(&arrays, eps, offset, flips), area * moved * moved, 2e-3 * fabs(moved * moved - 1) * area);
    }
}

/* --- Orifices --- */

static riis_orifice orifice_of(const riis_surface *surface, const riis_resistance *how) {
  riis_orifice orifice;
  CHECK_OK(riis_surface_get_orifice(surface, how, &orifice, sizeof orifice));
  return orifice;
}

/* The offset at which the band's reach into the orifice vanishes, or 0 for a kind whose reach does not depend on the offset. */
static double vanishing_offset(const char *kind, int32_t rim) {
  if (strcmp(kind, "bileaflet") == 0) return 0;
  if (rim == RIIS_RIM_ROUND) return 1.05;
  return strcmp(kind, "mitral") == 0 ? 0.8 : 0.85;
}

TEST(orifices_reach_less_far_into_the_flow) {
  static const char *const kinds[] = {"aortic", "trileaflet", "coapting", "mitral", "bileaflet", "arrays"};
  static const double offsets[] = {-0.5, 0, 0.5, 0.75, 0.9};
  const double eps = 0.1;
  for (int kind = 0; kind < 6; kind += trial_step())
    for (int32_t rim = RIIS_RIM_ROUND; rim <= RIIS_RIM_CUT; ++rim)
      for (int k = 0; k < 5; ++k) {
        const int n_before = n_owned();
        const riis_surface_options options = banded(eps, offsets[k], 0), plain = banded(eps, 0, 0);
        riis_valve *valve = new_valve(kind < 5 ? kinds[kind] : "trileaflet");
        CHECK_OK(riis_valve_set_scalar(valve, "opening", 0.7));
        const riis_surface *without = new_surface(valve, &plain);
        const riis_surface *surface =
            kind < 5 ? new_surface(valve, &options) : same_triangles(without, eps, offsets[k]);
        const riis_resistance how = resistance_of(1, RIIS_AUTO, rim);
        const riis_orifice found = orifice_of(surface, &how);
        const double c = rim == RIIS_RIM_CUT ? 0.7 : 0.84, vanishing = vanishing_offset(kinds[kind], rim);
        const double share = vanishing == 0 ? 1 : fmax(0, 1 - offsets[k] / vanishing);
        CHECK_NEAR(found.rim_reach, c * share, 1e-15);
        assert_true(found.half_thickness == eps);
        /* A band without an offset leaves the same area if it reaches equally far into the orifice. */
        const riis_resistance thinner = resistance_of(1, fmax(share * eps, 1e-9), rim);
        const riis_orifice as_far = orifice_of(without, &thinner);
        CHECK_NEAR(found.effective_area, as_far.effective_area, 1e-7 * found.outline_area);
        CHECK_NEAR(found.area, as_far.area, 1e-12 * found.outline_area);
        free_owned_after(n_before);
      }
}

/* --- First passages --- */

/* Returns whether a flood passes the valve. */
static int floods_pass(riis_valve *valve, double opening, const riis_surface_options *options, const test_mesh *grid,
                       const test_mesh *rows, int64_t from, int64_t to) {
  const int n_before = n_owned();
  uint8_t *is_open = own(malloc((size_t)grid->n));
  int64_t *label = own(malloc((size_t)grid->n * sizeof *label));
  CHECK_OK(riis_valve_set_scalar(valve, "opening", opening));
  const riis_surface *surface = new_surface(valve, options);
  open_nodes(surface, grid, options->half_thickness, options->offset, is_open);
  flood_fill(rows, is_open, label);
  const int passes = label[from] >= 0 && label[from] == label[to];
  free_owned_after(n_before);
  return passes;
}

TEST(valves_first_open_where_floods_pass) {
  static const char *const kinds[] = {"trileaflet", "bileaflet", "mitral", "coapting"};
  int n_found = 0;
  for (int trial = 0; trial < trials_of(16); ++trial) {
    const int n_before = n_owned(), kind = trial % 4;
    riis_valve *valve = new_valve(kinds[kind]);
    if (kind != 1) CHECK_OK(riis_valve_set_scalar(valve, "skirt_length", 0.3));
    riis_surface_options surface =
        banded(random_between(&rng, 0.12, 0.2), one_in(2) ? 0.75 : random_between(&rng, -0.6, 0.9), 0);
    surface.tolerance = 0.3;
    const double radius = kind == 2 ? 1.6 : kind == 1 ? 1.05 : 1.2;
    const test_mesh grid = tube(radius, -2.4, 3, random_between(&rng, 0.1, 0.14)), rows = both_ways(&grid);
    riis_mesh *mesh = mesh_from(&grid);
    const int64_t from = node_at(&grid, 0, 0, -2.4), to = node_at(&grid, 0, 0, 3);
    riis_passage_ends ends;
    riis_first_passage_options options;
    riis_first_passage first;
    CHECK_OK(riis_passage_ends_init(&ends, sizeof ends));
    CHECK_OK(riis_first_passage_options_init(&options, sizeof options));
    ends.n_from = ends.n_to = 1, ends.from = &from, ends.to = &to;
    options.surface = &surface, options.tolerance = 1.0 / 32;
    CHECK_OK(riis_find_first_passage(valve, mesh, &ends, &options, &first, sizeof first));
    const int passes_at_0 = floods_pass(valve, 0, &surface, &grid, &rows, from, to);
    assert_int_equal(first.state == RIIS_FIRST_PASSAGE_ALWAYS, passes_at_0);
    if (first.state == RIIS_FIRST_PASSAGE_FOUND) {
      ++n_found;
      assert_true(floods_pass(valve, first.opening, &surface, &grid, &rows, from, to));
      assert_false(floods_pass(valve, first.closed_opening, &surface, &grid, &rows, from, to));
      for (double before = 0.125; before < first.closed_opening; before += 0.125)
        assert_false(floods_pass(valve, before, &surface, &grid, &rows, from, to));
    }
    printf("%s, offset %.2f: state %d, opening %.3f\n", kinds[kind], surface.offset, first.state, first.opening);
    free_owned_after(n_before);
  }
  CHECK_MET(n_found > 0);
}

/* --- Forces and moments --- */

/* Sets random numbers of three components. */
static void set_random(double *v) {
  for (int c = 0; c < 3; ++c) v[c] = random_between(&rng, -1, 1);
}

static void add_cross(const double *a, const double *b, double factor, double *to) {
  for (int c = 0; c < 3; ++c) to[c] += factor * (a[(c + 1) % 3] * b[(c + 2) % 3] - a[(c + 2) % 3] * b[(c + 1) % 3]);
}

static double dot(const double *a, const double *b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

/* A rigid surface moves in a random flow. The oracle's K and closest points determine the forces. */
static void check_balance(const char *kind) {
  const double eps = random_between(&rng, 0.1, 0.2), offset = one_in(2) ? 0.75 : random_between(&rng, -0.9, 0.9);
  const int32_t rim = one_in(2) ? RIIS_RIM_ROUND : RIIS_RIM_CUT;
  riis_valve *valve = new_valve(kind);
  CHECK_OK(riis_valve_set_scalar(valve, "opening", random_between(&rng, 0.2, 0.8)));
  riis_surface_options options = banded(eps, 0, 0);
  options.tolerance = 0.3;
  const riis_triangles all = triangles_of(new_surface(valve, &options));
  double v[3], omega[3], about[3], *velocity = own(malloc((size_t)all.n_vertices * 3 * sizeof *velocity));
  set_random(v), set_random(omega), set_random(about);
  for (int64_t i = 0; i < all.n_vertices; ++i) {
    memcpy(velocity + 3 * i, v, sizeof v);
    const double arm[3] = {all.xyz[3 * i] - about[0], all.xyz[3 * i + 1] - about[1], all.xyz[3 * i + 2] - about[2]};
    add_cross(omega, arm, 1, velocity + 3 * i);
  }
  riis_surface_arrays arrays = triangle_arrays(all.n_vertices, all.xyz, all.n_triangles, NULL);
  arrays.vertex_ids = all.vertex_id, arrays.id_bits = 64, arrays.leaflet_id = all.leaflet_id;
  arrays.vx = velocity, arrays.vy = velocity + 1, arrays.vz = velocity + 2, arrays.velocity_stride = 3;
  options.offset = offset;
  const riis_surface *surface = surface_from(&arrays, &options);
  const riis_surface_info info = info_of(surface);
  enum { n = 6000 };
  double *xyz = own(malloc(3 * n * sizeof *xyz)), *u = own(malloc(3 * n * sizeof *u)),
         *weight = own(malloc(n * sizeof *weight));
  for (int64_t i = 0; i < n; ++i) {
    for (int c = 0; c < 3; ++c) xyz[3 * i + c] = random_between(&rng, info.lower[c] - 2 * eps, info.upper[c] + 2 * eps);
    set_random(u + 3 * i);
    weight[i] = random_between(&rng, 0, 1);
  }
  riis_marks *marks = new_result();
  const riis_resistance how = resistance_of(7, RIIS_AUTO, rim);
  riis_mark_options asked = mark_options();
  asked.fields = RIIS_FIELD_POINT | RIIS_FIELD_VELOCITY | RIIS_FIELD_RIM;
  CHECK_OK(riis_mark_nodes(surface, mesh_of(n, xyz), &asked, marks));
  double force[3] = {0}, moment[3] = {0};
  riis_flow_arrays flow;
  riis_reaction reaction;
  CHECK_OK(riis_flow_arrays_init(&flow, sizeof flow));
  CHECK_OK(riis_reaction_init(&reaction, sizeof reaction));
  flow.n_nodes = n, flow.velocity_stride = 3, flow.weight = weight;
  for (int c = 0; c < 3; ++c) flow.velocity[c] = u + c;
  memcpy(reaction.about, about, sizeof about);
  reaction.force = force, reaction.moment = moment;
  CHECK_OK(riis_marks_add_reaction(marks, &how, &flow, &reaction));
  double expected_force[3] = {0}, expected_moment[3] = {0}, power = 0, size = 0;
  int n_ties = 0;
  const riis_triangles own_triangles = triangles_of(surface);
  const riis_mark_list list = marked_list(marks);
  for (int64_t i = 0; i < list.n_nodes; ++i) {
    const int64_t node = list.node_id[i];
    const band_place place = place_of(&own_triangles, xyz + 3 * node, list.triangle_id[i], list.rim[i]);
    const double K = oracle_K(&place, how.R, eps, offset, rim == RIIS_RIM_CUT);
    double arm[3], there[3], f[3];
    for (int c = 0; c < 3; ++c) arm[c] = xyz[3 * node + c] - (double)place.way[c] - about[c];
    memcpy(there, v, sizeof v);
    add_cross(omega, arm, 1, there);
    /* If two leaflets are equally near, the velocity is the mean of the velocities at two places. */
    const double *mean = list.velocity + 3 * i;
    const double off = fabs(mean[0] - there[0]) + fabs(mean[1] - there[1]) + fabs(mean[2] - there[2]);
    n_ties += off > 1e-9;
    for (int c = 0; c < 3; ++c) {
      f[c] = weight[node] * K * (u[3 * node + c] - (off > 1e-9 ? mean : there)[c]);
      expected_force[c] += f[c], size += fabs(f[c]);
    }
    add_cross(arm, f, 1, expected_moment);
    power += dot(f, there);
  }
  assert_true(list.n_nodes > 100 && size > 0 && n_ties <= 2);
  for (int c = 0; c < 3; ++c) {
    CHECK_NEAR(force[c], expected_force[c], 1e-11 * size);
    CHECK_NEAR(moment[c], expected_moment[c], 1e-10 * size);
  }
  CHECK_NEAR(dot(force, v) + dot(moment, omega), power, 1e-10 * size);
}

TEST(power_is_force_times_velocity_and_moment_times_angular_velocity) {
  static const char *const kinds[] = {"aortic", "trileaflet", "coapting", "mitral", "bileaflet"};
  for (int trial = 0; trial < trials_of(15); ++trial) {
    const int n_before = n_owned();
    check_balance(kinds[trial % 5]);
    free_owned_after(n_before);
  }
}

/* --- A sheet that turns about its rim --- */

/* Places the unit square of x and y, turned by an angle about the edge x = 0, which is a rim. Angles are in radians. */
static riis_surface_options turned_by(double angle, double eps, double offset) {
  riis_surface_options options = banded(eps, offset, 0);
  options.rotation_axis[0] = 0, options.rotation_axis[1] = -1, options.rotation_axis[2] = 0;
  options.rotation_angle = angle * 180 / pi;
  return options;
}

/* Beside a rim at rest, the distance stays constant. The end of the band at a round rim nevertheless turns with the normal. */
TEST(a_round_rim_turns_with_a_sheet_that_turns_about_it) {
  enum { n = 400 };
  const double eps = 0.3, R = 2, step = 1e-5;
  const shape square = unit_square();
  riis_valve *valve = valve_from(&square);
  for (int trial = 0; trial < trials_of(18); ++trial) {
    const int n_before = n_owned();
    const double angle = random_between(&rng, -1, 1), offset = trial == 0   ? 0
                                                               : trial == 1 ? 0.75
                                                                            : random_between(&rng, -0.9, 0.9);
    double xyz[3 * n], K[2][n];
    for (int i = 0; i < n; ++i) {
      /* The nodes lie beyond the rim x = 0, in the frame of the sheet. */
      const double along = random_between(&rng, -2 * eps, -0.01), over = random_between(&rng, -2 * eps, 2 * eps);
      xyz[3 * i] = along * cos(angle) - over * sin(angle);
      xyz[3 * i + 1] = random_between(&rng, 0.1, 0.9);
      xyz[3 * i + 2] = along * sin(angle) + over * cos(angle);
    }
    riis_mesh *mesh = mesh_of(n, xyz);
    const riis_resistance how = resistance_of(R, RIIS_AUTO, RIIS_RIM_ROUND);
    riis_mark_options asked = mark_options();
    asked.resistance = &how;
    asked.distance_limit = 4 * eps;
    for (int k = 0; k < 2; ++k) {
      const riis_surface_options options = turned_by(angle + (k == 0 ? step : -step), eps, offset);
      riis_marks *marks = new_result();
      CHECK_OK(riis_mark_nodes(new_surface(valve, &options), mesh, &asked, marks));
      const riis_mark_list list = within_list(marks);
      assert_int_equal(list.n_nodes, n);
      memcpy(K[k], list.K, sizeof K[k]);
    }
    const riis_surface_options now = turned_by(angle, eps, offset), after = turned_by(angle + step, eps, offset),
                               before = turned_by(angle - step, eps, offset);
    riis_surface *surface = new_surface(valve, &now);
    CHECK_OK(riis_surface_add_direction(surface, valve, valve, 2 * step, &after, &before));
    asked.fields = RIIS_FIELD_GRADIENT | RIIS_FIELD_RIM;
    riis_marks *marks = new_result();
    CHECK_OK(riis_mark_nodes(surface, mesh, &asked, marks));
    const riis_mark_list list = within_list(marks);
    const double most = R / (eps * eps) * pi / 2;
    int n_in_band = 0;
    for (int i = 0; i < n; ++i) {
      const double normal[2] = {-sin(angle), cos(angle)}, rate[2] = {-cos(angle), -sin(angle)};
      const double over[2] = {xyz[3 * i] - offset * eps * normal[0], xyz[3 * i + 2] - offset * eps * normal[1]};
      const double middle = hypot(over[0], over[1]);
      const double middle_rate = -offset * eps * (over[0] * rate[0] + over[1] * rate[1]) / middle;
      const double expected = middle < eps ? -R * pi / (2 * eps * eps * eps) * sin(pi * middle / eps) * middle_rate : 0;
      assert_true(list.rim[i]);
      CHECK_NEAR(list.distance_gradient[i], 0, 1e-9);
      CHECK_NEAR(list.K_gradient[i], expected, 1e-8 * most);
      CHECK_NEAR(list.K_gradient[i], (K[0][i] - K[1][i]) / (2 * step), 1e-6 * most);
      n_in_band += fabs(expected) > 1e-3 * fabs(offset) * most; /* the derivative grows with the offset */
    }
    assert_true(offset == 0 ? n_in_band == 0 : n_in_band > 20);
    free_owned_after(n_before);
  }
}

int main(void) {
  rng = random_start("test_offset_measures");
  return run_cases(NULL, NULL);
}
