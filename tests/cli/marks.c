/* SPDX-License-Identifier: Apache-2.0 */
#include "marks.h"
#include "calls.h"

#include <stdlib.h>
#include <string.h>

#include "expect.h"
#include "scratch.h"
#include "vtk_shim.h"

expected_marks by_c;

void mark_by_c(const riis_valve *valve, const riis_surface_options *surface_options, double distance_limit,
               double far_distance) {
  static double xyz[3 * n_box];
  riis_mesh *mesh = NULL;
  riis_marks *result = NULL;
  riis_mark_options mark_options;
  assert_int_equal(shim_read_points(scratch_path("in.vtu"), NULL, NULL, NULL, xyz), 1);
  riis_surface_destroy(&by_c.surface);
  expect_fine(riis_surface_create(valve, surface_options, &by_c.surface));
  expect_fine(riis_mesh_create(n_box, xyz, xyz + 1, xyz + 2, 3, &mesh));
  expect_fine(riis_marks_create(&result));
  expect_fine(riis_mark_options_init(&mark_options, sizeof mark_options));
  mark_options.distance_limit = distance_limit;
  expect_fine(riis_mark_nodes(by_c.surface, mesh, &mark_options, result));
  expect_fine(dense_of(result, n_box, far_distance, by_c.marked, by_c.distance, NULL, by_c.leaflet));
  expect_fine(riis_marks_get_stats(result, &by_c.stats, sizeof by_c.stats));
  riis_marks_destroy(&result);
  riis_mesh_destroy(&mesh);
}

static void expect_array(const char *name, const char *expected_type, int kind) {
  static double values[n_box];
  char type[32];
  int64_t n_components = 0, n_tuples = 0;
  assert_int_equal(shim_read_array(scratch_path("out.vtu"), 'p', name, type, &n_components, &n_tuples, values), 1);
  assert_string_equal(type, expected_type);
  assert_int_equal(n_components, 1);
  assert_int_equal(n_tuples, n_box);
  for (int i = 0; i < n_box; ++i) {
    const double wanted = kind == 0 ? by_c.marked[i] : kind == 1 ? by_c.distance[i] : by_c.leaflet[i];
    if (memcmp(&values[i], &wanted, sizeof wanted))
      fail_msg("%s of node %d is %.17g, not %.17g", name, i, values[i], wanted);
  }
}

void expect_marked_mesh(void) {
  static double before[3 * n_box], after[3 * n_box];
  static int64_t corners[2][24 * n_box];
  int64_t n_points = 0, n_cells = 0;
  char type[32];
  assert_int_equal(shim_read_points(scratch_path("in.vtu"), NULL, NULL, type, before), 1);
  assert_string_equal(type, "float");
  assert_int_equal(shim_read_points(scratch_path("out.vtu"), &n_points, &n_cells, type, after), 1);
  assert_string_equal(type, "double");
  assert_int_equal(n_points, n_box);
  assert_memory_equal(before, after, sizeof before);
  const int64_t n_corners = shim_read_corners(scratch_path("in.vtu"), corners[0]);
  assert_int_equal(shim_read_corners(scratch_path("out.vtu"), corners[1]), n_corners);
  assert_memory_equal(corners[0], corners[1], (size_t)n_corners * sizeof corners[0][0]);
  assert_int_equal(shim_read_array(scratch_path("out.vtu"), 'p', "pressure", NULL, NULL, NULL, NULL), 1);
  assert_int_equal(shim_read_array(scratch_path("out.vtu"), 'c', "region", NULL, NULL, NULL, NULL), 1);
  expect_array("riis_marked", "unsigned char", 0);
  expect_array("riis_distance", "double", 1);
  expect_array("riis_leaflet", "int", 2);
  assert_true(by_c.stats.n_marked > 20);
}

void expect_surface_output(void) {
  int64_t n_points = 0, n_cells = 0;
  const int64_t n_vertices = triangles_of(by_c.surface).n_vertices;
  const double *xyz = triangles_of(by_c.surface).xyz;
  const int64_t n_triangles = triangles_of(by_c.surface).n_triangles;
  const int64_t *vertex_id = triangles_of(by_c.surface).vertex_id;
  char type[32];
  assert_int_equal(shim_read_points(scratch_path("out.vtp"), &n_points, &n_cells, type, NULL), 1);
  assert_string_equal(type, "double");
  assert_int_equal(n_points, n_vertices);
  assert_int_equal(n_cells, n_triangles);
  double *points = malloc((size_t)(3 * n_points) * sizeof *points);
  shim_read_points(scratch_path("out.vtp"), NULL, NULL, NULL, points);
  assert_memory_equal(points, xyz, (size_t)(3 * n_points) * sizeof *points);
  free(points);
  int64_t *corners = malloc((size_t)(3 * n_cells) * sizeof *corners);
  assert_int_equal(shim_read_corners(scratch_path("out.vtp"), corners), 3 * n_triangles);
  assert_memory_equal(corners, vertex_id, (size_t)(3 * n_cells) * sizeof *corners);
  free(corners);
}

void forget_marks(void) { riis_surface_destroy(&by_c.surface); }
