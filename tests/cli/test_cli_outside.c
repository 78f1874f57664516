/* SPDX-License-Identifier: Apache-2.0
 *
 * Tests which part of a valve is outside the mesh. If the mesh is a box, the distance of a point from it has a closed form. */
#include <math.h>
#include <riis/riis_vtk.h>

#include "brick_meshes.h"
#include "expect.h"
#include "program.h"
#include "scratch.h"
#include "vtk_shim.h"

enum { n_asked = 3000 };

/* The distance of a point from the box, which extends from 0 to `size`. */
static double distance_from_box(const double p[3], const double size[3]) {
  double square = 0;
  for (int k = 0; k < 3; ++k) {
    const double beyond = fmax(0, fmax(-p[k], p[k] - size[k]));
    square += beyond * beyond;
  }
  return sqrt(square);
}

/* Sets the columns of `turn` to the axes of a random frame. */
static void random_frame(random_source *random, double turn[3][3]) {
  for (int i = 0; i < 3; ++i) {
    for (int k = 0; k < 3; ++k) turn[i][k] = random_between(random, -1, 1);
    for (int j = 0; j < i; ++j) {
      const double along = turn[i][0] * turn[j][0] + turn[i][1] * turn[j][1] + turn[i][2] * turn[j][2];
      for (int k = 0; k < 3; ++k) turn[i][k] -= along * turn[j][k];
    }
    const double length = sqrt(turn[i][0] * turn[i][0] + turn[i][1] * turn[i][1] + turn[i][2] * turn[i][2]);
    for (int k = 0; k < 3; ++k) turn[i][k] /= length;
  }
}

TEST(test_points_outside_a_box_of_each_type_of_cell) {
  random_source random = random_start("points outside");
  static const double distances[] = {0, 0.02, 0.3, 2};
  static double xyz[3 * n_asked], own[3 * n_asked];
  static uint8_t is_outside[n_asked];
  for (int type = 0; type < n_elements_types; ++type) {
    const double size[3] = {1.5, 1, 0.5}, corner[3] = {3, -2, 7};
    double turn[3][3], side[3][3];
    random_frame(&random, turn);
    for (int i = 0; i < 3; ++i)
      for (int k = 0; k < 3; ++k) side[i][k] = size[i] * turn[i][k];
    mesh box = make_mesh(&elements[type], (const int[3]){6, 4, 2}, corner, side);
    write_mesh(&box, "box.vtk");
    free_mesh(&box);
    riis_vtk_mesh *file = NULL;
    expect_fine(riis_vtk_mesh_read(scratch_path("box.vtk"), &file));
    for (size_t at = 0; at < sizeof distances / sizeof *distances; ++at) {
      const double distance = distances[at];
      for (int i = 0; i < n_asked; ++i) {
        for (int k = 0; k < 3; ++k) {
          own[3 * i + k] = random_between(&random, -1.2 * distance - 0.3, size[k] + 1.2 * distance + 0.3);
          xyz[3 * i + k] = corner[k];
        }
        for (int j = 0; j < 3; ++j)
          for (int k = 0; k < 3; ++k) xyz[3 * i + k] += own[3 * i + j] * turn[j][k];
        is_outside[i] = i % 7 != 0;
      }
      expect_fine(riis_vtk_mesh_find_outside(file, n_asked, xyz, distance, is_outside));
      int n_outside = 0;
      for (int i = 0; i < n_asked; ++i) {
        const double away = distance_from_box(own + 3 * i, size);
        n_outside += is_outside[i];
        if (fabs(away - distance) > 1e-7 && is_outside[i] != (i % 7 != 0 && away > distance))
          fail_msg("%s: a point %.9g from the mesh is %d for %g", elements[type].name, away, is_outside[i], distance);
      }
      assert_true(n_outside > n_asked / 20 && n_outside < n_asked * 19 / 20);
    }
    riis_vtk_mesh_destroy(&file);
  }
}

TEST(test_arguments) {
  const double lower[3] = {0, 0, 0}, upper[3] = {1, 1, 1}, far[3] = {9, 9, 9}, bad[3] = {0, NAN, 0};
  uint8_t is_outside = 1;
  riis_vtk_mesh *file = NULL;
  assert_int_equal(shim_write_box(scratch_path("box.vtu"), SHIM_RAW, 3, lower, upper, 0), 1);
  expect_fine(riis_vtk_mesh_read(scratch_path("box.vtu"), &file));
  expect_fine(riis_vtk_mesh_find_outside(file, 0, NULL, 1, NULL));
  expect_fine(riis_vtk_mesh_find_outside(file, 1, far, 1, &is_outside));
  assert_int_equal(is_outside, 1);
  CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "distance is -1", riis_vtk_mesh_find_outside(file, 1, far, -1, &is_outside));
  CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "xyz[1] is nan", riis_vtk_mesh_find_outside(file, 1, bad, 1, &is_outside));
  CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "xyz is NULL", riis_vtk_mesh_find_outside(file, 1, NULL, 1, &is_outside));
  CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "n_points is -1", riis_vtk_mesh_find_outside(file, -1, far, 1, &is_outside));
  riis_vtk_mesh_destroy(&file);
}

/* Writes a square of two triangles, from `from` to `to` along x and from -1 to 1 along y. */
static void write_sheet(const char *name, double from, double to) {
  FILE *file = fopen(scratch_path(name), "w");
  assert_non_null(file);
  fprintf(file, "v %g -1 0\nv %g -1 0\nv %g 1 0\nv %g 1 0\nf 1 2 3\nf 1 3 4\n", from, to, to, from);
  assert_int_equal(fclose(file), 0);
}

/* Runs `riis mark` on box.vtu, and returns the JSON of --stats. */
#define MARK_BOX(...)                                                                                      \
  (run_program("mark", scratch_path("box.vtu"), "--stats", scratch_path("stats.json"), __VA_ARGS__, NULL), \
   scratch_read(scratch_path("stats.json"), &(size_t){0}))

TEST(test_share_of_two_sheets) {
  const double lower[3] = {-2, -2, -1}, upper[3] = {2, 2, 1};
  assert_int_equal(shim_write_box(scratch_path("box.vtu"), SHIM_RAW, 17, lower, upper, 0), 1);
  write_sheet("in.obj", 0, 1.95);
  write_sheet("out.obj", -4, 0);
  /* The leaflet `out` is 4 long. A length of 2 - 0.15 lies farther than 0.15 outside. */
  char *json =
      MARK_BOX("--half-thickness", "0.15", "--surface", scratch_path("in.obj"), "--surface", scratch_path("out.obj"));
  assert_int_equal(program_exit_code, 0);
  const double expected = 1.85 / 4;
  CHECK_NEAR(json_number(strstr(json, "\"outside\""), "share"), 1.85 / 5.95, 0.003);
  CHECK_NEAR(json_number(strstr(json, "\"leaflets\""), "share"), expected, 0.003);
  assert_non_null(strstr(json, "\"name\": \"out\""));
  assert_null(strstr(json, "\"name\": \"in\""));
  assert_non_null(strstr(program_outside,
                         "the surface stands through the wall: 31 % of the leaflets' area (out 46 %) is farther "
                         "than the half thickness 0.15 outside the mesh: move it"));
  assert_non_null(strstr(program_out, "outside   31 % of the leaflets' area (out 46 %)"));
  free(json);
  run_program("mark", scratch_path("box.vtu"), "--strict", "--quiet", "--stats", scratch_path("stats.json"),
              "--half-thickness", "0.15", "--surface", scratch_path("out.obj"), NULL);
  assert_int_equal(program_exit_code, 4);

  /* If at most 2 % of the area is outside, the program reports the share without a warning. */
  write_sheet("out.obj", -2.21, 1);
  json = MARK_BOX("--half-thickness", "0.15", "--surface", scratch_path("out.obj"));
  assert_string_equal(program_outside, "");
  CHECK_NEAR(json_number(strstr(json, "\"outside\""), "share"), 0.06 / 3.21, 0.002);
  assert_non_null(strstr(program_out, "outside   1.9 % of the leaflets' area (leaflet 0 1.9 %)"));
  free(json);
}

/* Uses random points to estimate which share of the leaflets' area lies outside a box. Only leaflets whose ids are below
 * n_leaflets count. */
static double random_share(const char *kind, const char *skirt, int n_leaflets, const double lower[3],
                           const double size[3]) {
  random_source random = random_start("share");
  riis_valve *valve = NULL;
  riis_surface *surface = NULL;
  riis_triangles triangles;
  expect_fine(riis_valve_create(kind, &valve));
  expect_fine(riis_valve_set_scalar(valve, "opening", 0));
  if (skirt) expect_fine(riis_valve_set_scalar(valve, "skirt_length", atof(skirt)));
  expect_fine(riis_surface_create(valve, NULL, &surface));
  expect_fine(riis_surface_get_triangles(surface, &triangles, sizeof triangles));
  double all = 0, outside = 0;
  for (int64_t i = 0; i < triangles.n_triangles; ++i) {
    if (triangles.leaflet_id[i] >= n_leaflets) continue;
    const double *corner[3], *p, *q, *r;
    for (int k = 0; k < 3; ++k) corner[k] = triangles.xyz + 3 * triangles.vertex_id[3 * i + k];
    p = corner[0], q = corner[1], r = corner[2];
    double a[3], b[3];
    for (int k = 0; k < 3; ++k) a[k] = q[k] - p[k], b[k] = r[k] - p[k];
    const double area = 0.5 * sqrt(pow(a[1] * b[2] - a[2] * b[1], 2) + pow(a[2] * b[0] - a[0] * b[2], 2) +
                                   pow(a[0] * b[1] - a[1] * b[0], 2));
    enum { n_points = 400 };
    for (int point = 0; point < n_points; ++point) {
      double u = random_between(&random, 0, 1), v = random_between(&random, 0, 1), at[3];
      if (u + v > 1) u = 1 - u, v = 1 - v;
      for (int k = 0; k < 3; ++k) at[k] = p[k] + u * a[k] + v * b[k] - lower[k];
      outside += distance_from_box(at, size) > 0.1 ? area / n_points : 0;
    }
    all += area;
  }
  riis_surface_destroy(&surface);
  riis_valve_destroy(&valve);
  return outside / all;
}

TEST(test_skirts_and_housings_do_not_count) {
  /* The leaflets end at x = 0.9. The skirt and the housing reach beyond the box everywhere. */
  const double lower[3] = {-3, -1.2, -3}, upper[3] = {0.9, 3, 3}, size[3] = {3.9, 4.2, 6};
  assert_int_equal(shim_write_box(scratch_path("box.vtu"), SHIM_RAW, 31, lower, upper, 0), 1);
  static const char *const kinds[] = {"coapting", "quadricuspid", "mitral", "bileaflet"};
  static const int n_leaflets[] = {3, 4, 2, 2};
  for (int i = 0; i < 4; ++i) {
    const char *const skirt = i < 3 ? "1" : NULL;
    char *json = MARK_BOX("--valve", kinds[i], "--opening", "0", "--set", skirt ? "skirt_length=1" : "ring_height=0.6");
    const double expected = random_share(kinds[i], skirt, n_leaflets[i], lower, size);
    CHECK_NEAR(json_number(strstr(json, "\"outside\""), "share"), expected, 0.005);
    assert_true(expected > 0.01);
    assert_true((strstr(program_outside, "stands through the wall") != NULL) == (expected > 0.02));
    assert_null(strstr(program_outside, "skirt"));
    free(json);
  }
}

/* A valve is in a wrong place if its closed leaflets are outside. Open leaflets may reach into the wall. The leaflets of this
 * test reach higher when they are open. */
TEST(test_the_closed_valve_decides) {
  const double lower[3] = {-3, -3, -3}, upper[3] = {3, 3, 1.4};
  assert_int_equal(shim_write_box(scratch_path("box.vtu"), SHIM_RAW, 31, lower, upper, 0), 1);
  static const char *const stands = "riis: the surface stands through the wall: ",
                           *const reaches = "riis: the surface reaches through the wall where it is open: ";
  const struct {
    const char *place, *opening, *text; /* the text that begins the line; "" for no line */
  } cases[] = {{"0,0,-0.6", "1", ""},
               {"0,0,0", "0", ""},
               {"0,0,0", "1", reaches},
               {"0,0,0.2", "0", stands},
               {"0,0,0.2", "1", stands}};
  for (int i = 0; i < 5; ++i) {
    const char *const text = cases[i].text;
    char *json = MARK_BOX("--valve", "coapting", "--opening", cases[i].opening, "--translate", cases[i].place);
    assert_int_equal(program_exit_code, 0);
    assert_int_equal(json_number(strstr(json, "\"outside\""), "share") > 0.02, *text != 0);
    assert_int_equal(strncmp(program_outside, text, strlen(text)), 0);
    assert_int_equal(*program_outside != 0, *text != 0);
    assert_int_equal(strstr(program_outside, ": move it, turn it") != NULL, text == stands);
    assert_int_equal(strstr(program_outside, "The closed valve stands inside the mesh") != NULL, text == reaches);
    free(json);
  }
  /* If a valve never closes in a series, the place of its closed state still decides. */
  scratch_write_text("cycle.csv", "0,0.9\n0.5,1\n1,0.9\n");
  for (int is_high = 0; is_high < 2; ++is_high) {
    free(MARK_BOX("--valve", "coapting", "--cycle", scratch_path("cycle.csv"), "--times", "0,0.25,0.5", "--translate",
                  is_high ? "0,0,0.2" : "0,0,0"));
    assert_non_null(strstr(program_outside, is_high ? "stands through the wall at opening 1: "
                                                    : "reaches through the wall where it is open at opening 1: "));
  }
}

TEST(test_a_series_tells_of_the_open_valve) {
  /* The closed leaflets end below z = 1.2. The open leaflets reach higher. */
  const double lower[3] = {-3, -3, -3}, upper[3] = {3, 3, 1};
  assert_int_equal(shim_write_box(scratch_path("box.vtu"), SHIM_RAW, 31, lower, upper, 0), 1);
  scratch_write_text("cycle.csv", "0,0\n0.5,1\n1,0\n");
  char *json = MARK_BOX("--valve", "coapting", "--cycle", scratch_path("cycle.csv"), "--times", "0,0.25,0.5");
  assert_int_equal(program_exit_code, 0);
  const double open = json_number(strstr(json, "\"outside\""), "share");
  assert_true(open > 0.02);
  CHECK_NEAR(json_number(strstr(json, "\"outside\""), "opening"), 1, 0);
  assert_non_null(strstr(program_outside, "the surface stands through the wall at opening 1: "));
  free(json);
  json = MARK_BOX("--valve", "coapting", "--opening", "1");
  CHECK_NEAR(json_number(strstr(json, "\"outside\""), "share"), open, 1e-9);
  free(json);
}

TEST(test_what_is_unknown) {
  const double lower[3] = {-3, -3, -3}, upper[3] = {3, 3, 3};
  assert_int_equal(shim_write_box(scratch_path("box.vtu"), SHIM_RAW, 13, lower, upper, 0), 1);
  char *json = MARK_BOX("--valve", "coapting", "--opening", "0", "--translate", "0,9,0", "--allow-none");
  assert_int_equal(program_exit_code, 0);
  assert_non_null(strstr(program_out, "leaks     unknown: no node is marked\n"));
  assert_non_null(strstr(json, "\"n_leaking_edges\": null"));
  CHECK_NEAR(json_number(strstr(json, "\"outside\""), "share"), 1, 0);
  free(json);
  /* A mesh without volume cells has no inside. */
  scratch_write_text("box.vtk",
                     "# vtk DataFile Version 3.0\nmesh\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 3 double\n"
                     "0 0 0\n1 0 0\n0 1 0\nCELLS 1 4\n3 0 1 2\nCELL_TYPES 1\n5\n");
  run_program("mark", scratch_path("box.vtk"), "--valve", "coapting", "--allow-none", "--stats",
              scratch_path("stats.json"), NULL);
  json = scratch_read(scratch_path("stats.json"), &(size_t){0});
  assert_non_null(strstr(json, "\"outside\": null"));
  free(json);
}

int main(void) { return run_cases(scratch_setup, scratch_teardown); }
