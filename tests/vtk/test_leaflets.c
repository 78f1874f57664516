/* SPDX-License-Identifier: Apache-2.0
 *
 * Tests leaflets of surface files from connected pieces and from arrays. Also tests marks with other names, and the length of a
 * mesh's edges. Slow and simple computations check the pieces and the edges. */
#include <math.h>
#include <riis/riis_vtk.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "expect.h"
#include "scratch.h"
#include "vtk_shim.h"

static uint64_t state_of_random = 88172645463325252u;
static int random_below(int n) {
  state_of_random ^= state_of_random << 13;
  state_of_random ^= state_of_random >> 7;
  state_of_random ^= state_of_random << 17;
  return (int)(state_of_random % (uint64_t)n);
}

enum { most_faces = 60 };

/* Random triangles on few points, so that some triangles touch. Each z is 0 or -0, which are equal positions. A loop gives the
 * expected pieces: the number of the lowest face spreads to touching faces until nothing changes. */
static int write_random_faces(const char *name, int n_faces, int n_lattice, int pieces[most_faces]) {
  static char text[most_faces * 200 + 100];
  int corners[most_faces][3];
  char *end = stpcpy(text, "solid x\n");
  for (int face = 0; face < n_faces; ++face) {
    do {
      for (int k = 0; k < 3; ++k) corners[face][k] = random_below(n_lattice);
    } while (corners[face][0] == corners[face][1] || corners[face][0] == corners[face][2] ||
             corners[face][1] == corners[face][2]);
    end = stpcpy(end, "facet normal 0 0 1\nouter loop\n");
    for (int k = 0; k < 3; ++k)
      end += sprintf(end, "vertex %d %d %s\n", corners[face][k], corners[face][k] * corners[face][k],
                     random_below(2) ? "0" : "-0.0");
    end = stpcpy(end, "endloop\nendfacet\n");
    pieces[face] = face;
  }
  strcpy(end, "endsolid\n");
  scratch_write_text(name, text);
  for (int changed = 1; changed;) {
    changed = 0;
    for (int a = 0; a < n_faces; ++a)
      for (int b = 0; b < n_faces; ++b)
        for (int k = 0; k < 9; ++k)
          if (corners[a][k / 3] == corners[b][k % 3] && pieces[b] > pieces[a]) pieces[b] = pieces[a], changed = 1;
  }
  int n_pieces = 0, number[most_faces];
  for (int face = 0; face < n_faces; ++face) {
    if (pieces[face] == face) number[face] = n_pieces++;
    pieces[face] = number[pieces[face]];
  }
  return n_pieces;
}

static riis_surface_arrays arrays_of(const riis_vtk_surface *surface) {
  riis_surface_arrays arrays;
  expect_fine(riis_surface_arrays_init(&arrays, sizeof arrays));
  expect_fine(riis_vtk_surface_get_arrays(surface, &arrays, sizeof arrays));
  return arrays;
}

TEST(test_pieces) {
  int most_pieces = 0;
  for (int run = 0; run < 40; ++run) {
    int pieces[most_faces];
    const int n_faces = 1 + random_below(most_faces), n_lattice = 4 + random_below(150);
    const int n_pieces = write_random_faces("random.stl", n_faces, n_lattice, pieces);
    riis_vtk_surface *surface = NULL;
    expect_fine(riis_vtk_surface_read(scratch_path("random.stl"), NULL, &surface));
    assert_null(arrays_of(surface).leaflet_id);
    expect_fine(riis_vtk_surface_number_pieces(surface));
    const riis_surface_arrays arrays = arrays_of(surface);
    assert_int_equal(arrays.n_faces, n_faces);
    for (int face = 0; face < n_faces; ++face) assert_int_equal(arrays.leaflet_id[face], pieces[face]);
    riis_vtk_surface_destroy(&surface);
    if (n_pieces > most_pieces) most_pieces = n_pieces;
  }
  assert_true(most_pieces > 5);
}

/* The quads share the ids of vertices. Leaflets from pieces replace the array's leaflets. */
static const char *const quads =
    "<VTKFile type=\"UnstructuredGrid\" version=\"0.1\" byte_order=\"LittleEndian\"><UnstructuredGrid>\n"
    "<Piece NumberOfPoints=\"10\" NumberOfCells=\"3\"><CellData>\n"
    "<DataArray type=\"Int32\" Name=\"riis_leaflet\" format=\"ascii\">4 5 6</DataArray>\n"
    "<DataArray type=\"Float32\" Name=\"body\" format=\"ascii\">7 8 7</DataArray>\n"
    "<DataArray type=\"Int32\" Name=\"below\" format=\"ascii\">7 -8 7</DataArray>\n"
    "<DataArray type=\"Int32\" NumberOfComponents=\"2\" Name=\"two\" format=\"ascii\">7 8 7 8 7 "
    "8</DataArray></CellData>\n"
    "<Points><DataArray type=\"Float64\" NumberOfComponents=\"3\" format=\"ascii\">0 0 0 1 0 0 1 1 0 0 1 0 5 0 0 6 0 0 "
    "6 1 0 5 1 0 "
    "2 0 0 2 1 0</DataArray></Points>\n"
    "<Cells><DataArray type=\"Int64\" Name=\"connectivity\" format=\"ascii\">0 1 2 3 4 5 6 7 1 8 9 2</DataArray>"
    "<DataArray type=\"Int64\" Name=\"offsets\" format=\"ascii\">4 8 12</DataArray>"
    "<DataArray type=\"UInt8\" Name=\"types\" format=\"ascii\">9 9 9</DataArray></Cells>\n"
    "</Piece></UnstructuredGrid></VTKFile>\n";

static void expect_leaflets(const riis_vtk_surface *surface, const int32_t expected[3]) {
  const riis_surface_arrays arrays = arrays_of(surface);
  assert_int_equal(arrays.n_faces, 3);
  assert_int_equal(arrays.corners_per_face, 4);
  for (int i = 0; i < 3; ++i) assert_int_equal(arrays.leaflet_id[i], expected[i]);
}

TEST(test_arrays) {
  riis_vtk_surface *surface = NULL;
  scratch_write_text("quads.vtu", quads);
  const char *path = scratch_path("quads.vtu");
  expect_fine(riis_vtk_surface_read(path, NULL, &surface));
  expect_leaflets(surface, (int32_t[3]){4, 5, 6});
  expect_fine(riis_vtk_surface_number_pieces(surface));
  expect_leaflets(surface, (int32_t[3]){0, 1, 0});
  riis_vtk_surface_destroy(&surface);
  expect_fine(riis_vtk_surface_read(path, "body", &surface));
  expect_leaflets(surface, (int32_t[3]){7, 8, 7});
  riis_vtk_surface_destroy(&surface);
  expect_refused(riis_vtk_surface_read(path, "soul", &surface), RIIS_FILE_ERROR,
                 "quads.vtu: has no cell array soul; there are: riis_leaflet, body, below, two");
  expect_refused(riis_vtk_surface_read(path, "below", &surface), RIIS_FILE_ERROR, "cell array below: cell 1 has -8");
  expect_refused(riis_vtk_surface_read(path, "two", &surface), RIIS_FILE_ERROR,
                 "cell array two must hold one number for each cell");
  expect_refused(riis_vtk_surface_read("missing.vtu", "body", &surface), RIIS_FILE_ERROR, "missing.vtu");
  expect_refused(riis_vtk_surface_read(NULL, "body", &surface), RIIS_INVALID_ARGUMENT, "path is NULL");
  expect_refused(riis_vtk_surface_read(path, "body", NULL), RIIS_INVALID_ARGUMENT, "surface is NULL");
  expect_refused(riis_vtk_surface_number_pieces(NULL), RIIS_INVALID_ARGUMENT, "surface is NULL");
  assert_null(surface);
}

static int ascending(const void *a, const void *b) {
  const double x = *(const double *)a, y = *(const double *)b;
  return (x > y) - (x < y);
}

/* The expected median comes from the sorted lengths of all edges in a box of tetrahedra. */
TEST(test_median_edge) {
  enum { n_side = 9, n_points = n_side * n_side * n_side, n_cells = 6 * 8 * 8 * 8, n_edges = 6 * n_cells };
  static double xyz[3 * n_points], lengths[n_edges];
  static int64_t corners[4 * n_cells];
  const double lower[3] = {0, 0, 0}, upper[3] = {1, 2, 7};
  const char *path = scratch_path("box.vtu");
  double length = -1;
  riis_vtk_mesh *mesh = NULL;
  assert_int_equal(shim_write_box(path, SHIM_RAW, n_side, lower, upper, 0), 1);
  assert_int_equal(shim_read_points(path, NULL, NULL, NULL, xyz), 1);
  assert_int_equal(shim_read_corners(path, corners), 4 * n_cells);
  int n = 0;
  for (int cell = 0; cell < n_cells; ++cell)
    for (int a = 0; a < 4; ++a)
      for (int b = 0; b < a; ++b) {
        const double *p = xyz + 3 * corners[4 * cell + a], *q = xyz + 3 * corners[4 * cell + b];
        lengths[n++] =
            sqrt((p[0] - q[0]) * (p[0] - q[0]) + (p[1] - q[1]) * (p[1] - q[1]) + (p[2] - q[2]) * (p[2] - q[2]));
      }
  qsort(lengths, (size_t)n, sizeof lengths[0], ascending);
  expect_fine(riis_vtk_mesh_read(path, &mesh));
  expect_fine(riis_vtk_mesh_get_median_edge(mesh, &length));
  assert_true(fabs(length - lengths[n / 2]) < 1e-12);
  expect_refused(riis_vtk_mesh_get_median_edge(NULL, &length), RIIS_INVALID_ARGUMENT, "mesh is NULL");
  expect_refused(riis_vtk_mesh_get_median_edge(mesh, NULL), RIIS_INVALID_ARGUMENT, "length is NULL");
  riis_vtk_mesh_destroy(&mesh);
  /* Tests a uniform box with more cells than the median uses, and then cells without edges. */
  assert_int_equal(shim_write_box(scratch_path("large.vtu"), SHIM_RAW, 22, lower, upper, 0), 1);
  expect_fine(riis_vtk_mesh_read(scratch_path("large.vtu"), &mesh));
  expect_fine(riis_vtk_mesh_get_median_edge(mesh, &length));
  assert_true(length > 0.3 && length < 0.4);
  riis_vtk_mesh_destroy(&mesh);
  scratch_write_text("point.vtk",
                     "# vtk DataFile Version 3.0\none\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 1 double\n0 0 0\n"
                     "CELLS 1 2\n1 0\nCELL_TYPES 1\n1\n");
  expect_fine(riis_vtk_mesh_read(scratch_path("point.vtk"), &mesh));
  expect_fine(riis_vtk_mesh_get_median_edge(mesh, &length));
  assert_true(length == 0);
  riis_vtk_mesh_destroy(&mesh);
  assert_true(shim_write_zoo(scratch_path("zoo.vtu")));
  expect_fine(riis_vtk_mesh_read(scratch_path("zoo.vtu"), &mesh));
  expect_fine(riis_vtk_mesh_get_median_edge(mesh, &length));
  assert_true(length > 0);
  riis_vtk_mesh_destroy(&mesh);
}

/* VTK reads the same cells. */
static void expect_cells(const char *path, int type) {
  riis_vtk_mesh *mesh = NULL;
  int64_t n_cells = 0;
  expect_fine(riis_vtk_mesh_read(path, &mesh));
  expect_fine(riis_vtk_mesh_get_nodes(mesh, NULL, &n_cells, NULL));
  const int64_t n = shim_read_corners(path, NULL);
  int64_t *offsets = calloc((size_t)n_cells + 1, sizeof *offsets), *ids = calloc((size_t)n, sizeof *ids),
          *expected = calloc((size_t)n, sizeof *expected);
  uint8_t *types = calloc((size_t)n_cells, sizeof *types);
  assert_true(shim_read_corners(path, expected) == n && n > 0);
  expect_fine(riis_vtk_mesh_copy_cells(mesh, n_cells, offsets, types, 0, NULL));
  assert_true(offsets[0] == 0 && offsets[n_cells] == n);
  expect_fine(riis_vtk_mesh_copy_cells(mesh, n_cells, NULL, NULL, n, ids));
  assert_memory_equal(ids, expected, (size_t)n * sizeof *ids);
  int n_of_type = 0;
  for (int64_t i = 0; i < n_cells; ++i) {
    assert_true(offsets[i + 1] > offsets[i]);
    n_of_type += types[i] == type;
  }
  assert_true(n_of_type > 0);
  char text[80];
  snprintf(text, sizeof text, "n_cells is 3; the mesh has %lld cells", (long long)n_cells);
  expect_refused(riis_vtk_mesh_copy_cells(mesh, 3, offsets, NULL, 0, NULL), RIIS_INVALID_ARGUMENT, text);
  snprintf(text, sizeof text, "n_node_ids is 5; the cells have %lld node ids", (long long)n);
  expect_refused(riis_vtk_mesh_copy_cells(mesh, n_cells, NULL, NULL, 5, ids), RIIS_INVALID_ARGUMENT, text);
  expect_refused(riis_vtk_mesh_copy_cells(NULL, n_cells, NULL, NULL, 0, NULL), RIIS_INVALID_ARGUMENT, "mesh is NULL");
  riis_vtk_mesh_destroy(&mesh);
  free(offsets);
  free(ids);
  free(expected);
  free(types);
}

TEST(test_cells) {
  const double lower[3] = {0, 0, 0}, upper[3] = {1, 2, 7};
  int64_t n_cells = 0;
  riis_vtk_mesh *mesh = NULL;
  assert_true(shim_write_zoo(scratch_path("zoo.vtu")));
  expect_cells(scratch_path("zoo.vtu"), 24);
  assert_int_equal(shim_write_box(scratch_path("box.vtu"), SHIM_RAW, 5, lower, upper, 0), 1);
  expect_cells(scratch_path("box.vtu"), 10);
  expect_fine(riis_vtk_mesh_read(scratch_path("box.vtu"), &mesh));
  expect_fine(riis_vtk_mesh_use_centers(mesh));
  expect_fine(riis_vtk_mesh_get_nodes(mesh, NULL, &n_cells, NULL));
  expect_refused(riis_vtk_mesh_copy_cells(mesh, n_cells, NULL, NULL, 0, NULL), RIIS_INVALID_ARGUMENT,
                 "the nodes of mesh are centres of cells, and no cells join them");
  riis_vtk_mesh_destroy(&mesh);
}

static void expect_array(const riis_vtk_mesh *mesh, const char *name, int expected) {
  int32_t has = -1;
  expect_fine(riis_vtk_mesh_has_point_array(mesh, name, &has));
  if (has != expected) fail_msg("%s: %d", name, has);
}

TEST(test_named_marks) {
  enum { n_side = 9, n_points = n_side * n_side * n_side };
  const char *path = scratch_path("box.vtu"), *out = scratch_path("out.vtu");
  const double lower[3] = {-1.5, -1.5, -1}, upper[3] = {1.5, 1.5, 0.5};
  int64_t n_nodes = 0;
  const double *xyz = NULL;
  riis_valve *valve = NULL;
  riis_surface *surface = NULL;
  riis_mesh *nodes = NULL;
  riis_vtk_mesh *mesh = NULL;
  riis_marks *result = NULL;
  assert_int_equal(shim_write_box(path, SHIM_RAW, n_side, lower, upper, 0), 1);
  expect_fine(riis_valve_create("aortic", &valve));
  expect_fine(riis_surface_create(valve, NULL, &surface));
  expect_fine(riis_vtk_mesh_read(path, &mesh));
  expect_fine(riis_vtk_mesh_get_nodes(mesh, &n_nodes, NULL, &xyz));
  expect_fine(riis_mesh_create(n_nodes, xyz, xyz + 1, xyz + 2, 3, &nodes));
  expect_fine(riis_marks_create(&result));
  expect_refused(riis_vtk_mesh_set_marks(mesh, result, -1, "x"), RIIS_INVALID_ARGUMENT, "mesh with 0 nodes");
  expect_fine(riis_mark_nodes(surface, nodes, NULL, result));
  const char *bad[] = {"",         "a b", "a\nb",
                       "\xc3\xa4", "a/b", "0123456789012345678901234567890123456789012345678901234567890123x"};
  for (int i = 0; i < 6; ++i)
    expect_refused(riis_vtk_mesh_set_marks(mesh, result, -1, bad[i]), RIIS_INVALID_ARGUMENT, "prefix is \"");
  expect_refused(riis_vtk_mesh_set_marks(mesh, NULL, -1, "x"), RIIS_INVALID_ARGUMENT, "marks is NULL");
  expect_refused(riis_vtk_mesh_set_marks(NULL, result, -1, "x"), RIIS_INVALID_ARGUMENT, "mesh is NULL");
  int32_t has = 7;
  expect_refused(riis_vtk_mesh_has_point_array(NULL, "x", &has), RIIS_INVALID_ARGUMENT, "mesh is NULL");
  expect_refused(riis_vtk_mesh_has_point_array(mesh, NULL, &has), RIIS_INVALID_ARGUMENT, "name is NULL");
  expect_refused(riis_vtk_mesh_has_point_array(mesh, "x", NULL), RIIS_INVALID_ARGUMENT, "has is NULL");
  assert_int_equal(has, 7);
  expect_array(mesh, "pressure", 1);
  expect_array(mesh, "region", 0); /* "region" is a cell array, not a point array */
  expect_array(mesh, "Left.1_marked", 0);
  expect_fine(riis_vtk_mesh_set_marks(mesh, result, -1, "Left.1"));
  expect_array(mesh, "Left.1_marked", 1);
  expect_array(mesh, "riis_marked", 0);
  expect_fine(riis_vtk_mesh_set_marks(mesh, result, -1, NULL));
  expect_fine(riis_vtk_mesh_write(mesh, out));
  const char *names[][2] = {
      {"Left.1_marked", "riis_marked"}, {"Left.1_distance", "riis_distance"}, {"Left.1_leaflet", "riis_leaflet"}};
  for (int i = 0; i < 3; ++i) {
    static double values[2][n_points];
    char types[2][32];
    for (int k = 0; k < 2; ++k)
      assert_int_equal(shim_read_array(out, 'p', names[i][k], types[k], NULL, NULL, values[k]), 1);
    assert_string_equal(types[0], types[1]);
    assert_memory_equal(values[0], values[1], sizeof values[0]);
  }
  riis_marks_destroy(&result);
  riis_mesh_destroy(&nodes);
  riis_vtk_mesh_destroy(&mesh);
  riis_surface_destroy(&surface);
  riis_valve_destroy(&valve);
}

int main(void) { return run_cases(scratch_setup, scratch_teardown); }
