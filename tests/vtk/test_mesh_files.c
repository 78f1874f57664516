/* SPDX-License-Identifier: Apache-2.0
 *
 * Tests meshes that are read from files and written again. Nodes keep the file's order, and points are doubles. Every array
 * stays, and marks equal those of the core. */
#include <riis/riis_vtk.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "calls.h"
#include "expect.h"
#include "scratch.h"
#include "vtk_shim.h"

enum { n_side = 9, n_nodes = n_side * n_side * n_side, n_cells = 6 * (n_side - 1) * (n_side - 1) * (n_side - 1) };
static const double lower[3] = {-1.7, -1.6, -1.3}, upper[3] = {1.5, 1.6, 0.4};

static riis_vtk_mesh *read_mesh(const char *name) {
  riis_vtk_mesh *mesh = NULL;
  expect_fine(riis_vtk_mesh_read(scratch_path(name), &mesh));
  return mesh;
}

/* Checks that an array is equal in two files: in type, shape and every value. */
static void expect_same_array(const char *before, const char *after, char where, const char *name, int has_numbers) {
  static double values[2][3 * n_cells];
  char type[2][32];
  int64_t n_components[2], n_tuples[2];
  memset(values, 0, sizeof values);
  const char *paths[2] = {before, after};
  for (int i = 0; i < 2; ++i) {
    if (!shim_read_array(paths[i], where, name, type[i], &n_components[i], &n_tuples[i],
                         has_numbers ? values[i] : NULL)) {
      fail_msg("%s has no array %s", paths[i], name);
    }
  }
  assert_string_equal(type[0], type[1]);
  assert_int_equal(n_components[0], n_components[1]);
  assert_int_equal(n_tuples[0], n_tuples[1]);
  assert_memory_equal(values[0], values[1], sizeof values[0]);
}

static void expect_same_mesh(const char *before, const char *after) {
  static double xyz[2][3 * n_nodes];
  static int64_t corners[2][4 * n_cells];
  int64_t n_points = 0, n_grid_cells = 0;
  char type[32];
  assert_int_equal(shim_read_points(before, NULL, NULL, NULL, xyz[0]), 1);
  assert_int_equal(shim_read_points(after, &n_points, &n_grid_cells, type, xyz[1]), 1);
  assert_int_equal(n_points, n_nodes);
  assert_int_equal(n_grid_cells, n_cells);
  assert_string_equal(type, "double");
  assert_memory_equal(xyz[0], xyz[1], sizeof xyz[0]);
  assert_int_equal(shim_read_corners(before, corners[0]), 4 * n_cells);
  assert_int_equal(shim_read_corners(after, corners[1]), 4 * n_cells);
  assert_memory_equal(corners[0], corners[1], sizeof corners[0]);
}

static void round_trip(const char *name, int encoding, int float_points) {
  assert_int_equal(shim_write_box(scratch_path(name), encoding, n_side, lower, upper, float_points), 1);
  riis_vtk_mesh *mesh = read_mesh(name);
  int64_t n = 0, n_read_cells = 0;
  const double *xyz = NULL;
  expect_fine(riis_vtk_mesh_get_nodes(mesh, &n, &n_read_cells, &xyz));
  assert_int_equal(n, n_nodes);
  assert_int_equal(n_read_cells, n_cells);
  static double expected[3 * n_nodes];
  assert_int_equal(shim_read_points(scratch_path(name), NULL, NULL, NULL, expected), 1);
  assert_memory_equal(xyz, expected, sizeof expected);

  expect_fine(riis_vtk_mesh_write(mesh, scratch_path("out.vtu")));
  riis_vtk_mesh_destroy(&mesh);
  assert_null(mesh);
  expect_same_mesh(scratch_path(name), scratch_path("out.vtu"));
  expect_same_array(scratch_path(name), scratch_path("out.vtu"), 'p', "pressure", 1);
  expect_same_array(scratch_path(name), scratch_path("out.vtu"), 'p', "velocity", 1);
  expect_same_array(scratch_path(name), scratch_path("out.vtu"), 'c', "region", 1);
  expect_same_array(scratch_path(name), scratch_path("out.vtu"), 'f', "time", 1);
  const int legacy = encoding == SHIM_LEGACY_ASCII || encoding == SHIM_LEGACY_BINARY;
  if (!legacy) expect_same_array(scratch_path(name), scratch_path("out.vtu"), 'p', "name", 0);
}

TEST(test_round_trips) {
  for (int float_points = 0; float_points < 2; ++float_points) {
    round_trip("in.vtu", SHIM_ASCII, float_points);
    round_trip("in.vtu", SHIM_BINARY, float_points);
    round_trip("in.vtu", SHIM_COMPRESSED, float_points);
    round_trip("in.VTU", SHIM_RAW, float_points);
    round_trip("in.vtk", SHIM_LEGACY_ASCII, float_points);
    round_trip("in.vtk", SHIM_LEGACY_BINARY, float_points);
  }
}

/* The box's nodes are shuffled, so a reader that reorders nodes fails this test. */
TEST(test_nodes_are_shuffled) {
  static double xyz[3 * n_nodes];
  assert_int_equal(shim_write_box(scratch_path("in.vtu"), SHIM_RAW, n_side, lower, upper, 0), 1);
  assert_int_equal(shim_read_points(scratch_path("in.vtu"), NULL, NULL, NULL, xyz), 1);
  int n_descents = 0;
  for (int i = 1; i < n_nodes; ++i) n_descents += xyz[3 * i + 2] < xyz[3 * i - 1];
  assert_true(n_descents > n_nodes / 4);
}

/* The file has every keyword that an unstructured grid in the legacy format may have, in the spelling of older versions. */
TEST(test_legacy_keywords) {
  scratch_write_text(
      "old.vtk",
      "# vtk DataFile Version 2.0\nold\nASCII\nDATASET UNSTRUCTURED_GRID\n"
      "POINTS 5 float\n0 0 0 1 0 0 0 1 0 0 0 1 2 2 2\nCELLS 2 7\n4 0 1 2 3\n1 4\nCELL_TYPES 2\n10\n1\n"
      "CELL_DATA 2\nSCALARS rank int 1\nLOOKUP_TABLE default\n7 8\n"
      "POINT_DATA 5\nSCALARS first double\nLOOKUP_TABLE own\n1 2 3 4 5\nLOOKUP_TABLE own 2\n0 0 0 1 1 1 1 1\n"
      "SCALARS second float 2\nLOOKUP_TABLE default\n1 2 3 4 5 6 7 8 9 10\n"
      "VECTORS flow double\n1 0 0 2 0 0 3 0 0 4 0 0 5 0 0\n"
      "NORMALS n float\n1 0 0 1 0 0 1 0 0 1 0 0 1 0 0\n"
      "TEXTURE_COORDINATES t 2 float\n0 0 0 1 1 0 1 1 0 0\n"
      "FIELD more 1\nextra 1 5 long\n5 4 3 2 1\n");
  riis_vtk_mesh *mesh = read_mesh("old.vtk");
  int64_t n = 0, n_read_cells = 0;
  expect_fine(riis_vtk_mesh_get_nodes(mesh, &n, &n_read_cells, NULL));
  assert_int_equal(n, 5);
  assert_int_equal(n_read_cells, 2);
  expect_fine(riis_vtk_mesh_write(mesh, scratch_path("old.vtu")));
  riis_vtk_mesh_destroy(&mesh);
  const char *names[] = {"first", "second", "flow", "n", "t", "extra"};
  for (size_t i = 0; i < sizeof names / sizeof names[0]; ++i) {
    double values[15] = {0};
    int64_t n_tuples = 0;
    if (!shim_read_array(scratch_path("old.vtu"), 'p', names[i], NULL, NULL, &n_tuples, values))
      fail_msg("no %s", names[i]);
    assert_int_equal(n_tuples, 5);
  }
  double rank[2] = {0};
  assert_int_equal(shim_read_array(scratch_path("old.vtu"), 'c', "rank", NULL, NULL, NULL, rank), 1);
  assert_true(rank[0] == 7 && rank[1] == 8);
}

/* The file has bit arrays and blocks of METADATA. VTK's writer puts a block of METADATA after each array whose range was
 * queried. */
TEST(test_legacy_metadata) {
  for (int i = 0; i < 4; ++i) {
    int64_t n = 0, n_read_cells = 0;
    assert_int_equal(shim_write_legacy(scratch_path("range.vtk"), i % 2, i < 2 ? 42 : 51), 1);
    char *bytes = scratch_read(scratch_path("range.vtk"), NULL);
    if (i % 2 == 0) assert_non_null(strstr(bytes, "METADATA\nINFORMATION"));
    if (i % 2 == 0) assert_non_null(strstr(bytes, "COMPONENT_NAMES\nalong%20x\n\n\n"));
    free(bytes);
    riis_vtk_mesh *mesh = read_mesh("range.vtk");
    expect_fine(riis_vtk_mesh_get_nodes(mesh, &n, &n_read_cells, NULL));
    assert_int_equal(n, 40);
    assert_int_equal(n_read_cells, 1);
    expect_fine(riis_vtk_mesh_write(mesh, scratch_path("range.vtu")));
    riis_vtk_mesh_destroy(&mesh);
    const char *const names[] = {"flow", "p", "bits"};
    for (int k = 0; k < 3; ++k)
      expect_same_array(scratch_path("range.vtk"), scratch_path("range.vtu"), 'p', names[k], 1);
  }
}

#define LEGACY(version) "# vtk DataFile Version " version "\nx\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 4 double\n"

/* The cases are lines that end with a carriage return, a mesh without cells, and METADATA at a place where VTK never puts it. */
TEST(test_legacy_layouts) {
  const char *texts[] = {
      LEGACY("2.0") "0 0 0 1 0 0 0 1 0 0 0 1\r\nMETADATA\r\nINFORMATION 0\r\n\r\nCELLS 1 5\r\n4 0 1 2 3\r\n"
                    "CELL_TYPES 1\r\n10\r\n",
      LEGACY("2.0") "0 0 0 1 0 0 0 1 0 0 0 1\nCELLS 1 5\n4 0 1 2 3\nCELL_TYPES 1\n10\nFIELD f 2\n"
                    "a 1 1 int\n1\nMETADATA\nINFORMATION 0\n\nb 1 1 int\n1\n",
      LEGACY("3.0") "0 0 0 1 0 0 0 1 0 0 0 1\nCELLS 0 0\nCELL_TYPES 0\n"};
  for (int i = 0; i < 3; ++i) {
    int64_t n = 0, n_read_cells = -1;
    scratch_write_text("layout.vtk", texts[i]);
    riis_vtk_mesh *mesh = read_mesh("layout.vtk");
    expect_fine(riis_vtk_mesh_get_nodes(mesh, &n, &n_read_cells, NULL));
    assert_int_equal(n, 4);
    assert_int_equal(n_read_cells, i < 2);
    riis_vtk_mesh_destroy(&mesh);
  }
}

/* An array does not begin at a word "Array" in a name or a comment. */
TEST(test_word_array) {
  scratch_write_text(
      "word.vtu",
      "<VTKFile type=\"UnstructuredGrid\" version=\"0.1\" byte_order=\"LittleEndian\"><UnstructuredGrid>\n"
      "<!-- The Array of <DataArray > cells --><Piece NumberOfPoints=\"1\" NumberOfCells=\"1\">\n"
      "<PointData><DataArray Name=\"Result Array 1\" type=\"Float64\" format=\"ascii\">7</DataArray></PointData>\n"
      "<Points><DataArray type=\"Float64\" NumberOfComponents=\"3\" format=\"ascii\">1 2 3</DataArray></Points>\n"
      "<Cells><DataArray type=\"Int64\" Name=\"connectivity\" format=\"ascii\">0</DataArray>\n"
      "<DataArray type=\"Int64\" Name=\"offsets\" format=\"ascii\">1</DataArray>\n"
      "<DataArray type=\"UInt8\" Name=\"types\" format=\"ascii\">1</DataArray></Cells>\n"
      "</Piece></UnstructuredGrid></VTKFile>\n");
  riis_vtk_mesh *mesh = read_mesh("word.vtu");
  riis_vtk_mesh_destroy(&mesh);
}

/* Marks the mesh with the aortic valve. */
static riis_marks *mark(riis_vtk_mesh *mesh, double half_thickness, double distance_limit) {
  riis_valve *valve = NULL;
  riis_surface *surface = NULL;
  riis_mesh *nodes = NULL;
  riis_marks *result = NULL;
  riis_surface_options surface_options;
  riis_mark_options mark_options;
  int64_t n = 0;
  const double *xyz = NULL;
  expect_fine(riis_valve_create("aortic", &valve));
  expect_fine(riis_surface_options_init(&surface_options, sizeof surface_options));
  surface_options.half_thickness = half_thickness;
  expect_fine(riis_surface_create(valve, &surface_options, &surface));
  expect_fine(riis_vtk_mesh_get_nodes(mesh, &n, NULL, &xyz));
  expect_fine(riis_mesh_create(n, xyz, xyz + 1, xyz + 2, 3, &nodes));
  expect_fine(riis_marks_create(&result));
  expect_fine(riis_mark_options_init(&mark_options, sizeof mark_options));
  mark_options.distance_limit = distance_limit;
  expect_fine(riis_mark_nodes(surface, nodes, &mark_options, result));
  riis_mesh_destroy(&nodes);
  riis_surface_destroy(&surface);
  riis_valve_destroy(&valve);
  return result;
}

static void expect_marks(const char *path, const riis_marks *result, double far_distance) {
  static uint8_t marked[n_nodes];
  static double distance[n_nodes], values[n_nodes];
  static int32_t leaflet[n_nodes];
  expect_fine(dense_of(result, n_nodes, far_distance, marked, distance, NULL, leaflet));
  const char *names[3] = {"riis_marked", "riis_distance", "riis_leaflet"};
  const char *types[3] = {"unsigned char", "double", "int"};
  int n_marked = 0, n_far = 0;
  for (int k = 0; k < 3; ++k) {
    char type[32];
    int64_t n_components = 0, n_tuples = 0;
    assert_int_equal(shim_read_array(path, 'p', names[k], type, &n_components, &n_tuples, values), 1);
    assert_string_equal(type, types[k]);
    assert_int_equal(n_components, 1);
    assert_int_equal(n_tuples, n_nodes);
    for (int i = 0; i < n_nodes; ++i) {
      const double expected = k == 0 ? marked[i] : k == 1 ? distance[i] : leaflet[i];
      assert_memory_equal(&values[i], &expected, sizeof expected);
      n_marked += k == 0 && marked[i];
      n_far += k == 1 && distance[i] == far_distance;
    }
  }
  assert_true(n_marked > 10 && n_far > 10 && n_marked + n_far < n_nodes);
}

TEST(test_marks) {
  assert_int_equal(shim_write_box(scratch_path("in.vtu"), SHIM_RAW, n_side, lower, upper, 0), 1);
  riis_vtk_mesh *mesh = read_mesh("in.vtu");
  riis_marks *result = mark(mesh, 0.15, 0.3);
  expect_fine(riis_vtk_mesh_set_marks(mesh, result, RIIS_FAR_DISTANCE, NULL));
  expect_fine(riis_vtk_mesh_write(mesh, scratch_path("marked.vtu")));
  expect_marks(scratch_path("marked.vtu"), result, RIIS_FAR_DISTANCE);
  expect_same_mesh(scratch_path("in.vtu"), scratch_path("marked.vtu"));
  expect_same_array(scratch_path("in.vtu"), scratch_path("marked.vtu"), 'p', "pressure", 1);

  /* New marks replace earlier marks of this mesh, and marks that were read with the mesh. */
  riis_marks *wider = mark(mesh, 0.25, 0.4);
  expect_fine(riis_vtk_mesh_set_marks(mesh, wider, -7, NULL));
  expect_fine(riis_vtk_mesh_write(mesh, scratch_path("again.vtu")));
  expect_marks(scratch_path("again.vtu"), wider, -7);
  riis_vtk_mesh_destroy(&mesh);
  mesh = read_mesh("again.vtu");
  expect_fine(riis_vtk_mesh_set_marks(mesh, result, -1, NULL));
  expect_fine(riis_vtk_mesh_write(mesh, scratch_path("again.vtu")));
  expect_marks(scratch_path("again.vtu"), result, -1);

  /* Refusals leave the marks as they were. */
  expect_refused(riis_vtk_mesh_set_marks(mesh, result, 0.1, NULL), RIIS_INVALID_ARGUMENT, "far_distance");
  riis_marks *unused = NULL;
  expect_fine(riis_marks_create(&unused));
  expect_refused(riis_vtk_mesh_set_marks(mesh, unused, -1, NULL), RIIS_INVALID_ARGUMENT, "nodes");
  expect_fine(riis_vtk_mesh_write(mesh, scratch_path("again.vtu")));
  expect_marks(scratch_path("again.vtu"), result, -1);
  riis_marks_destroy(&unused);
  riis_marks_destroy(&wider);
  riis_marks_destroy(&result);
  riis_vtk_mesh_destroy(&mesh);
}

int main(void) { return run_cases(scratch_setup, scratch_teardown); }
