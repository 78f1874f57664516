/* SPDX-License-Identifier: Apache-2.0
 *
 * Tests surface files that are read and written. Written files contain the surface that queries use. A surface that is read keeps
 * its winding, order and leaflets. */
#include <locale.h>
#include <math.h>
#include <riis/riis_vtk.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "calls.h"
#include "expect.h"
#include "scratch.h"
#include "vtk_shim.h"

static riis_surface *make_valve(void) {
  riis_valve *valve = NULL;
  riis_surface *surface = NULL;
  riis_surface_options options;
  expect_fine(riis_valve_create("aortic", &valve));
  expect_fine(riis_surface_options_init(&options, sizeof options));
  options.scale = 0.01;
  options.rotation_axis[1] = 1;
  options.rotation_angle = 20;
  options.translation[0] = 0.5;
  options.tolerance = 0.3;
  expect_fine(riis_surface_create(valve, &options, &surface));
  riis_valve_destroy(&valve);
  return surface;
}

static double *numbers(int64_t n) {
  double *values = malloc((size_t)n * sizeof *values);
  assert_non_null(values);
  return values;
}

/* Checks that a cell array of the file has the expected type and values. The array has one value per triangle. */
static void expect_cell_array(const char *path, const char *name, const char *expected_type, int64_t n,
                              const int32_t *narrow, const int64_t *wide) {
  char type[32];
  int64_t n_components = 0, n_tuples = 0;
  double *values = numbers(n);
  assert_int_equal(shim_read_array(path, 'c', name, type, &n_components, &n_tuples, NULL), 1);
  assert_string_equal(type, expected_type);
  assert_int_equal(n_components, 1);
  assert_int_equal(n_tuples, n);
  assert_int_equal(shim_read_array(path, 'c', name, NULL, NULL, NULL, values), 1);
  for (int64_t i = 0; i < n; ++i) assert_true(values[i] == (double)(narrow ? narrow[i] : wide[i]));
  free(values);
}

static void expect_written(const riis_surface *surface, const char *path) {
  int64_t n_points = 0, n_cells = 0;
  const int64_t n_vertices = triangles_of(surface).n_vertices;
  const double *xyz = triangles_of(surface).xyz;
  const int64_t n_triangles = triangles_of(surface).n_triangles;
  const int64_t *vertex_id = triangles_of(surface).vertex_id;
  const int64_t *triangle_id = triangles_of(surface).triangle_id;
  const int32_t *leaflet_id = triangles_of(surface).leaflet_id;
  const int32_t *patch_id = triangles_of(surface).patch_id;
  char type[32];
  double *points = numbers(3 * n_vertices);
  int64_t *corners = malloc((size_t)(3 * n_triangles) * sizeof *corners);
  assert_int_equal(shim_read_points(path, &n_points, &n_cells, type, NULL), 1);
  assert_int_equal(n_points, n_vertices);
  assert_int_equal(n_cells, n_triangles);
  assert_string_equal(type, "double");
  assert_int_equal(shim_read_points(path, NULL, NULL, NULL, points), 1);
  assert_memory_equal(points, xyz, (size_t)(3 * n_vertices) * sizeof *points);
  assert_int_equal(shim_read_corners(path, NULL), 3 * n_triangles);
  shim_read_corners(path, corners);
  assert_memory_equal(corners, vertex_id, (size_t)(3 * n_triangles) * sizeof *corners);
  free(points);
  free(corners);
  expect_cell_array(path, "riis_leaflet", "int", n_triangles, leaflet_id, NULL);
  expect_cell_array(path, "riis_patch", "int", n_triangles, patch_id, NULL);
  expect_cell_array(path, "riis_triangle", "long long", n_triangles, NULL, triangle_id);
}

TEST(test_valve_is_written) {
  riis_surface *surface = make_valve();
  expect_fine(riis_vtk_surface_write(surface, scratch_path("valve.vtp")));
  expect_written(surface, scratch_path("valve.vtp"));
  int64_t n_components = 0, n_tuples = 0;
  const int64_t n = triangles_of(surface).n_vertices;
  const double *uv = triangles_of(surface).uv;
  double *values = numbers(2 * n);
  char type[32];
  assert_int_equal(shim_read_array(scratch_path("valve.vtp"), 'p', "riis_uv", type, &n_components, &n_tuples, NULL), 1);
  assert_string_equal(type, "double");
  assert_int_equal(n_components, 2);
  assert_int_equal(n_tuples, n);
  shim_read_array(scratch_path("valve.vtp"), 'p', "riis_uv", NULL, NULL, NULL, values);
  assert_memory_equal(values, uv, (size_t)(2 * n) * sizeof *values);
  free(values);
  riis_surface_destroy(&surface);
}

static riis_surface *surface_of_file(const char *name, const riis_surface_options *options,
                                     riis_surface_arrays *arrays) {
  riis_vtk_surface *file = NULL;
  riis_surface *surface = NULL;
  expect_fine(riis_vtk_surface_read(scratch_path(name), NULL, &file));
  expect_fine(riis_surface_arrays_init(arrays, sizeof *arrays));
  expect_fine(riis_vtk_surface_get_arrays(file, arrays, sizeof *arrays));
  expect_fine(riis_surface_create_from_arrays(arrays, options, &surface));
  riis_vtk_surface_destroy(&file);
  assert_null(file);
  return surface;
}

/* Writing and reading does not change a valve's surface: closest points have the same bits. */
TEST(test_round_trip) {
  riis_surface *valve = make_valve();
  expect_fine(riis_vtk_surface_write(valve, scratch_path("valve.vtp")));
  riis_surface_arrays arrays;
  riis_surface *read_back = surface_of_file("valve.vtp", NULL, &arrays);
  assert_int_equal(arrays.corners_per_face, 3);
  for (int i = 0; i < 500; ++i) {
    const double point[3] = {0.5 + 0.02 * sin(i), 0.02 * sin(1.7 * i), 0.02 * sin(2.9 * i) - 0.005};
    riis_closest before, after;
    expect_fine(riis_closest_point(valve, point, &before, sizeof before));
    expect_fine(riis_closest_point(read_back, point, &after, sizeof after));
    assert_memory_equal(&before, &after, sizeof before);
  }
  riis_surface_destroy(&read_back);
  riis_surface_destroy(&valve);
}

/* Points in the plane z = 0: first the square's corners anticlockwise, then points outside the square. */
static const char *const plane_points = "0 0 0  1 0 0  1 1 0  0 1 0  2 0 0  2 1 0  0.5 1.5 0";

static void write_polydata(const char *name, const char *verts, const char *polys, const char *strips,
                           const char *cell_data) {
  /* The caller passes further attributes of the piece, and the content of CellData, Polys and Strips. */
  char text[4096];
  snprintf(text, sizeof text,
           "<VTKFile type=\"PolyData\" version=\"0.1\" byte_order=\"LittleEndian\"><PolyData>\n"
           "<Piece NumberOfPoints=\"7\" %s>\n<CellData>%s</CellData>\n"
           "<Points><DataArray type=\"Float32\" NumberOfComponents=\"3\" format=\"ascii\">%s</DataArray></Points>\n"
           "<Polys>%s</Polys>\n<Strips>%s</Strips>\n</Piece></PolyData></VTKFile>\n",
           verts, cell_data, plane_points, polys, strips);
  scratch_write_text(name, text);
}

#define CELLS(corners, offsets)                                               \
  "<DataArray type=\"Int32\" Name=\"connectivity\" format=\"ascii\">" corners \
  "</DataArray>"                                                              \
  "<DataArray type=\"Int32\" Name=\"offsets\" format=\"ascii\">" offsets "</DataArray>"
#define LEAFLETS(type, values) \
  "<DataArray type=\"" type "\" Name=\"riis_leaflet\" format=\"ascii\">" values "</DataArray>"

TEST(test_quads_stay_quads) {
  write_polydata("quads.vtp", "NumberOfPolys=\"2\"", CELLS("0 1 2 3 1 4 5 2", "4 8"), "", LEAFLETS("UInt8", "5 9"));
  riis_vtk_surface *file = NULL;
  riis_surface_arrays arrays;
  expect_fine(riis_vtk_surface_read(scratch_path("quads.vtp"), NULL, &file));
  expect_fine(riis_surface_arrays_init(&arrays, sizeof arrays));
  expect_fine(riis_vtk_surface_get_arrays(file, &arrays, sizeof arrays));
  assert_int_equal(arrays.n_vertices, 7);
  assert_int_equal(arrays.n_faces, 2);
  assert_int_equal(arrays.corners_per_face, 4);
  assert_int_equal(arrays.id_bits, 64);
  assert_int_equal(arrays.index_base, 0);
  const int64_t expected[8] = {0, 1, 2, 3, 1, 4, 5, 2};
  assert_memory_equal(arrays.vertex_ids, expected, sizeof expected);
  assert_int_equal(arrays.leaflet_id[0], 5);
  assert_int_equal(arrays.leaflet_id[1], 9);
  const double *x = arrays.x, *y = arrays.y, *z = arrays.z;
  assert_true(x[3 * 4] == 2 && y[3 * 6] == 1.5 && z[3 * 6] == 0);
  riis_vtk_surface_destroy(&file);
}

/* Checks areas and normals through the core. Every triangle faces +z, the areas add up, and faces keep their leaflets. */
static void expect_faces(const char *name, int64_t n_triangles, double area, const int32_t *leaflets) {
  riis_surface_arrays arrays;
  riis_surface_info info;
  riis_surface *surface = surface_of_file(name, NULL, &arrays);
  expect_fine(riis_surface_get_info(surface, &info, sizeof info));
  assert_int_equal(info.n_triangles, n_triangles);
  assert_true(fabs(info.area - area) < 1e-12);
  const double *xyz = triangles_of(surface).xyz;
  const int64_t n = triangles_of(surface).n_triangles;
  const int64_t *corners = triangles_of(surface).vertex_id;
  const int32_t *leaflet_id = triangles_of(surface).leaflet_id;
  for (int64_t i = 0; i < n; ++i) {
    const double *a = xyz + 3 * corners[3 * i], *b = xyz + 3 * corners[3 * i + 1], *c = xyz + 3 * corners[3 * i + 2];
    assert_true((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]) > 0);
    assert_int_equal(leaflet_id[i], leaflets[i]);
  }
  riis_surface_destroy(&surface);
}

TEST(test_mixed_polygons) {
  /* A triangle, a quad, a pentagon and a strip of two triangles give 1 + 2 + 3 + 2 triangles. */
  write_polydata("mixed.vtp", "NumberOfPolys=\"3\" NumberOfStrips=\"1\"", CELLS("0 1 3 1 4 5 2 0 1 2 6 3", "3 7 12"),
                 CELLS("0 1 3 2", "4"), LEAFLETS("Float64", "4 1 0 2"));
  const int32_t leaflets[8] = {4, 1, 1, 0, 0, 0, 2, 2};
  expect_faces("mixed.vtp", 8, 0.5 + 1 + 1.25 + 1, leaflets);
}

/* Quads with an inward corner at 1 or 3 are cut along the diagonal that lies inside. This holds for a single quad and for a quad
 * beside a triangle. The quads have an area of 0.2 each and keep their winding. A quad with the inward corner at 0 or 2 keeps its
 * order. */
TEST(test_concave_quads) {
  const int32_t leaflets[3] = {0, 0, 0};
  const char *orders[4] = {"0 1 2 3", "1 2 3 0", "2 3 0 1", "3 0 1 2"};
  for (int i = 0; i < 4; ++i) {
    for (int with_triangle = 0; with_triangle < 2; ++with_triangle) {
      char text[2048];
      snprintf(text, sizeof text,
               "<VTKFile type=\"PolyData\" version=\"0.1\" byte_order=\"LittleEndian\"><PolyData>\n"
               "<Piece NumberOfPoints=\"4\" NumberOfPolys=\"%d\"><Points><DataArray type=\"Float64\" "
               "NumberOfComponents=\"3\" format=\"ascii\">0 0 0  1 0 0  0.2 0.2 0  0 1 0</DataArray></Points><Polys>"
               "<DataArray type=\"Int32\" Name=\"connectivity\" format=\"ascii\">%s %s</DataArray>"
               "<DataArray type=\"Int32\" Name=\"offsets\" format=\"ascii\">4 %s</DataArray></Polys>"
               "</Piece></PolyData></VTKFile>\n",
               1 + with_triangle, orders[i], with_triangle ? "0 1 3" : "", with_triangle ? "7" : "");
      scratch_write_text("concave.vtp", text);
      expect_faces("concave.vtp", 2 + with_triangle, 0.2 + 0.5 * with_triangle, leaflets);
    }
  }
}

TEST(test_without_leaflets) {
  write_polydata("plain.vtp", "NumberOfPolys=\"1\"", CELLS("0 1 3", "3"), "", "");
  const int32_t leaflets[1] = {0};
  expect_faces("plain.vtp", 1, 0.5, leaflets);
}

TEST(test_unstructured_grid) {
  char text[2048];
  snprintf(text, sizeof text,
           "<VTKFile type=\"UnstructuredGrid\" version=\"0.1\" byte_order=\"LittleEndian\"><UnstructuredGrid>\n"
           "<Piece NumberOfPoints=\"7\" NumberOfCells=\"2\"><CellData>%s</CellData>\n"
           "<Points><DataArray type=\"Float64\" NumberOfComponents=\"3\" format=\"ascii\">%s</DataArray></Points>\n"
           "<Cells>%s<DataArray type=\"UInt8\" Name=\"types\" format=\"ascii\">5 9</DataArray></Cells>\n"
           "</Piece></UnstructuredGrid></VTKFile>\n",
           LEAFLETS("Int64", "2 1"), plane_points, CELLS("0 1 3 1 4 5 2", "3 7"));
  scratch_write_text("grid.vtu", text);
  const int32_t leaflets[3] = {2, 1, 1};
  expect_faces("grid.vtu", 3, 1.5, leaflets);
}

/* Quadratic faces are cut at their nodes, and keep their area, winding and leaflet. The nodes lie on a plane, in the middles of
 * sides and faces. The last two types are the Lagrange cells of order 2 that dolfinx writes. */
TEST(test_quadratic_faces) {
  /* The corners of a square, the middles of its sides, and its middle. The middle of the square's diagonal and the middle of half
   * the diagonal follow. */
  const char *points = "0 0 0  2 0 0  2 2 0  0 2 0  1 0 0  2 1 0  1 2 0  0 1 0  1 1 0  0.6 0.6 0";
  static const struct {
    int type, n_triangles;
    double area;
    const char *corners;
  } cells[6] = {{22, 4, 2, "0 1 3 4 8 7"},       {34, 6, 2, "0 1 3 4 8 7 9"}, {23, 6, 4, "0 1 2 3 4 5 6 7"},
                {28, 8, 4, "0 1 2 3 4 5 6 7 8"}, {69, 4, 2, "0 1 3 4 8 7"},   {70, 8, 4, "0 1 2 3 4 5 6 7 8"}};
  for (int i = 0; i < 6; ++i) {
    char text[2048];
    const int n = ((int)strlen(cells[i].corners) + 1) / 2;
    snprintf(text, sizeof text,
             "<VTKFile type=\"UnstructuredGrid\" version=\"0.1\" byte_order=\"LittleEndian\"><UnstructuredGrid>\n"
             "<Piece NumberOfPoints=\"10\" NumberOfCells=\"2\"><CellData>%s</CellData>\n"
             "<Points><DataArray type=\"Float64\" NumberOfComponents=\"3\" format=\"ascii\">%s</DataArray></Points>\n"
             "<Cells><DataArray type=\"Int32\" Name=\"connectivity\" format=\"ascii\">0 1 2 %s</DataArray>\n"
             "<DataArray type=\"Int32\" Name=\"offsets\" format=\"ascii\">3 %d</DataArray>\n"
             "<DataArray type=\"UInt8\" Name=\"types\" format=\"ascii\">5 %d</DataArray></Cells>\n"
             "</Piece></UnstructuredGrid></VTKFile>\n",
             LEAFLETS("Int64", "2 1"), points, cells[i].corners, 3 + n, cells[i].type);
    scratch_write_text("quadratic.vtu", text);
    const int32_t leaflets[9] = {2, 1, 1, 1, 1, 1, 1, 1, 1};
    expect_faces("quadratic.vtu", 1 + cells[i].n_triangles, 2 + cells[i].area, leaflets);
  }
}

/* Each of several surfaces becomes a leaflet, and the leaflets in its file do not matter. Quads are cut beside triangles. */
TEST(test_append) {
  riis_vtk_surface *all = NULL, *other = NULL;
  riis_surface_arrays arrays;
  write_polydata("quads.vtp", "NumberOfPolys=\"2\"", CELLS("0 1 2 3 1 4 5 2", "4 8"), "", LEAFLETS("UInt8", "5 9"));
  write_polydata("triangle.vtp", "NumberOfPolys=\"1\"", CELLS("0 1 3", "3"), "", "");
  expect_fine(riis_vtk_surface_read(scratch_path("quads.vtp"), NULL, &all));
  expect_fine(riis_vtk_surface_read(scratch_path("quads.vtp"), NULL, &other));
  expect_fine(riis_vtk_surface_append(all, other));
  expect_fine(riis_surface_arrays_init(&arrays, sizeof arrays));
  expect_fine(riis_vtk_surface_get_arrays(all, &arrays, sizeof arrays));
  assert_int_equal(arrays.corners_per_face, 4);
  assert_int_equal(arrays.n_vertices, 14);
  const int64_t quads[16] = {0, 1, 2, 3, 1, 4, 5, 2, 7, 8, 9, 10, 8, 11, 12, 9};
  assert_int_equal(arrays.n_faces, 4);
  assert_memory_equal(arrays.vertex_ids, quads, sizeof quads);
  assert_true(arrays.leaflet_id[1] == 0 && arrays.leaflet_id[2] == 1);
  riis_vtk_surface_destroy(&other);
  expect_fine(riis_vtk_surface_read(scratch_path("triangle.vtp"), NULL, &other));
  expect_fine(riis_vtk_surface_append(all, other));
  expect_fine(riis_vtk_surface_get_arrays(all, &arrays, sizeof arrays));
  assert_int_equal(arrays.corners_per_face, 3);
  assert_int_equal(arrays.n_faces, 9);
  const int64_t *ids = arrays.vertex_ids;
  const int64_t first[6] = {0, 1, 2, 0, 2, 3}, last[3] = {14, 15, 17};
  assert_memory_equal(ids, first, sizeof first);
  assert_memory_equal(ids + 24, last, sizeof last);
  const int32_t leaflets[9] = {0, 0, 0, 0, 1, 1, 1, 1, 2};
  assert_memory_equal(arrays.leaflet_id, leaflets, sizeof leaflets);
  expect_refused(riis_vtk_surface_append(all, NULL), RIIS_INVALID_ARGUMENT, "other is NULL");
  riis_vtk_surface_destroy(&other);
  riis_vtk_surface_destroy(&all);
}

/* The boundary of a box has the area of its six sides and encloses its volume, so its faces point outwards. */
TEST(test_boundary_of_a_mesh) {
  riis_vtk_mesh *mesh = NULL;
  riis_vtk_surface *boundary = NULL;
  riis_surface_arrays arrays;
  assert_int_equal(shim_write_box(scratch_path("box.vtu"), SHIM_RAW, 5, (double[3]){0, 0, 0}, (double[3]){1, 2, 3}, 0),
                   1);
  expect_fine(riis_vtk_mesh_read(scratch_path("box.vtu"), &mesh));
  expect_fine(riis_vtk_mesh_get_boundary(mesh, &boundary));
  expect_fine(riis_surface_arrays_init(&arrays, sizeof arrays));
  expect_fine(riis_vtk_surface_get_arrays(boundary, &arrays, sizeof arrays));
  const double *const axes[3] = {arrays.x, arrays.y, arrays.z};
  double area = 0, volume = 0;
  assert_int_equal(arrays.corners_per_face, 3);
  for (int64_t face = 0; face < arrays.n_faces; ++face) {
    const int64_t *const ids = (const int64_t *)arrays.vertex_ids + 3 * face;
    double p[3][3], n[3];
    for (int c = 0; c < 3; ++c)
      for (int k = 0; k < 3; ++k) p[c][k] = axes[k][arrays.stride * ids[c]];
    for (int k = 0; k < 3; ++k) {
      const int i = (k + 1) % 3, j = (k + 2) % 3;
      n[k] = (p[1][i] - p[0][i]) * (p[2][j] - p[0][j]) - (p[1][j] - p[0][j]) * (p[2][i] - p[0][i]);
    }
    area += sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]) / 2;
    volume += (p[0][0] * n[0] + p[0][1] * n[1] + p[0][2] * n[2]) / 6;
  }
  assert_true(fabs(area - 22) < 1e-12 && fabs(volume - 6) < 1e-12);
  riis_vtk_surface_destroy(&boundary);
  expect_refused(riis_vtk_mesh_get_boundary(NULL, &boundary), RIIS_INVALID_ARGUMENT, "mesh is NULL");
  expect_refused(riis_vtk_mesh_get_boundary(mesh, NULL), RIIS_INVALID_ARGUMENT, "boundary is NULL");
  riis_vtk_mesh_destroy(&mesh);
  scratch_write_text("flat.vtk",
                     "# vtk DataFile Version 3.0\nx\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 3 double\n"
                     "0 0 0 1 0 0 0 1 0\nCELLS 1 4\n3 0 1 2\nCELL_TYPES 1\n5\n");
  expect_fine(riis_vtk_mesh_read(scratch_path("flat.vtk"), &mesh));
  expect_refused(riis_vtk_mesh_get_boundary(mesh, &boundary), RIIS_INVALID_ARGUMENT, "mesh has no volume cells");
  riis_vtk_mesh_destroy(&mesh);
}

static const float stl_triangles[3][9] = {
    /* The second triangle has no area. */
    {0, 0, 0, 1, 0, 0, 0, 1, 0},
    {1, 0, 0, 1, 0, 0, 0, 1, 0},
    {1, 0, 0, 1, 1, 0, 0, 1, 0}};

static void write_binary_stl(const char *name, uint32_t n_promised, int n_written) {
  unsigned char bytes[84 + 3 * 50] = "binary";
  memcpy(bytes + 80, &n_promised, 4);
  for (int i = 0; i < n_written; ++i) memcpy(bytes + 84 + 50 * i + 12, stl_triangles[i], 36);
  scratch_write(name, bytes, (size_t)(84 + 50 * n_written));
}

static void write_ascii_stl(const char *name, int n_written, int with_end) {
  char text[2048] = "solid valve\n";
  for (int i = 0; i < n_written; ++i) {
    const float *t = stl_triangles[i];
    snprintf(text + strlen(text), sizeof text - strlen(text),
             "facet normal 0 0 1\nouter loop\nvertex %g %g %g\nvertex %g %g %g\nvertex %g %g %g\nendloop\nendfacet\n",
             t[0], t[1], t[2], t[3], t[4], t[5], t[6], t[7], t[8]);
  }
  if (with_end) strcat(text, "endsolid valve\n");
  scratch_write_text(name, text);
}

/* A triangle without area keeps its position, so the ids of later triangles stay the same. */
static void expect_stl(const char *name) {
  riis_surface_options options;
  riis_surface_arrays arrays;
  expect_fine(riis_surface_options_init(&options, sizeof options));
  options.zero_area = RIIS_ZERO_AREA_SKIP;
  riis_surface *surface = surface_of_file(name, &options, &arrays);
  const int64_t n = triangles_of(surface).n_triangles;
  const int64_t *triangle_id = triangles_of(surface).triangle_id;
  assert_int_equal(n, 2);
  assert_int_equal(triangle_id[0], 0);
  assert_int_equal(triangle_id[1], 2);
  riis_surface_destroy(&surface);
}

TEST(test_stl) {
  write_binary_stl("binary.stl", 3, 3);
  expect_stl("binary.stl");
  write_ascii_stl("ascii.stl", 3, 1);
  expect_stl("ascii.stl");
  /* Two solids in one file. */
  char *one = scratch_read(scratch_path("ascii.stl"), NULL);
  char both[4096];
  snprintf(both, sizeof both, "%s%s", one, one);
  free(one);
  scratch_write_text("two.stl", both);
  riis_vtk_surface *file = NULL;
  riis_surface_arrays arrays;
  expect_fine(riis_vtk_surface_read(scratch_path("two.stl"), NULL, &file));
  expect_fine(riis_surface_arrays_init(&arrays, sizeof arrays));
  expect_fine(riis_vtk_surface_get_arrays(file, &arrays, sizeof arrays));
  assert_int_equal(arrays.n_faces, 6);
  riis_vtk_surface_destroy(&file);
}

/* Upper and lower case, blanks and line breaks vary as in files of other programs. Keywords count only at the beginning of a
 * line. */
TEST(test_ascii_stl_layouts) {
  const char *const facet =
      "  FACET NORMAL 0 0 1\n OUTER LOOP\nVERTEX 0 0 0\nVERTEX 1.5 0 0\nVERTEX 0 1 0\nENDLOOP\n ENDFACET\n";
  char text[8192];
  snprintf(text, sizeof text, "\n SOLID endfacet part\n%sENDSOLID endfacet part \n%5000s\n", facet, "");
  scratch_write_text("upper.stl", text);
  const int32_t leaflets[1] = {0};
  expect_faces("upper.stl", 1, 0.75, leaflets);
}

/* The caller may have set a locale with a comma as decimal separator. The call must not change this locale. */
TEST(test_decimal_comma) {
  static const char *const names[] = {"de_DE.UTF-8", "de_DE.utf8", "fr_FR.UTF-8", "it_IT.UTF-8", "es_ES.UTF-8"};
  size_t i = 0;
  while (i < sizeof names / sizeof names[0] && !setlocale(LC_ALL, names[i])) ++i;
  if (i == sizeof names / sizeof names[0]) skip();
  const int32_t leaflets[1] = {0};
  scratch_write_text("comma.stl",
                     "solid x\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1.5 0 0\nvertex 0 1 0\nendloop\n"
                     "endfacet\nendsolid x\n");
  expect_faces("comma.stl", 1, 0.75, leaflets);
  /* VTK's legacy reader changes the process's locale. */
  const double lower[3] = {0, 0, 0}, upper[3] = {1, 1, 1};
  riis_vtk_mesh *mesh = NULL;
  assert_int_equal(shim_write_box(scratch_path("comma.vtk"), SHIM_LEGACY_BINARY, 2, lower, upper, 0), 1);
  setlocale(LC_ALL, names[i]);
  expect_fine(riis_vtk_mesh_read(scratch_path("comma.vtk"), &mesh));
  riis_vtk_mesh_destroy(&mesh);
  assert_string_equal(localeconv()->decimal_point, ",");
  setlocale(LC_ALL, "C");
}

/* A surface from arrays with skipped triangles is written without uv. The triangles in the file have the ids that queries use. */
TEST(test_user_surface_is_written) {
  riis_surface_options options;
  riis_surface_arrays arrays;
  write_binary_stl("binary.stl", 3, 3);
  expect_fine(riis_surface_options_init(&options, sizeof options));
  options.zero_area = RIIS_ZERO_AREA_SKIP;
  options.scale = 3;
  riis_surface *surface = surface_of_file("binary.stl", &options, &arrays);
  expect_fine(riis_vtk_surface_write(surface, scratch_path("user.vtp")));
  expect_written(surface, scratch_path("user.vtp"));
  assert_int_equal(shim_read_array(scratch_path("user.vtp"), 'p', "riis_uv", NULL, NULL, NULL, NULL), 0);
  riis_surface_destroy(&surface);
}

static void expect_file_error(const char *name, const char *part_of_text) {
  riis_vtk_surface *surface = NULL;
  scratch_watch_output();
  const riis_status status = riis_vtk_surface_read(scratch_path(name), NULL, &surface);
  const long n_printed = scratch_end_watch();
  expect_refused(status, RIIS_FILE_ERROR, part_of_text);
  expect_refused(status, RIIS_FILE_ERROR, name);
  assert_null(surface);
  assert_int_equal(n_printed, 0);
}

TEST(test_not_surfaces) {
  const double lower[3] = {0, 0, 0}, upper[3] = {1, 1, 1};
  expect_file_error("missing.vtp", "No such file or directory");
  scratch_write_text("surface.off", "v 0 0 0\n");
  expect_file_error("surface.off", "a surface must be a .vtp, .vtu, .vtk, .stl, .obj or .ply file");
  scratch_write_text("empty.stl", "");
  expect_file_error("empty.stl", "is empty");
  scratch_write_text("garbage.vtp", "garbage");
  expect_file_error("garbage.vtp", "is not a VTK XML file");
  assert_int_equal(shim_write_box(scratch_path("box.vtu"), SHIM_RAW, 2, lower, upper, 0), 1);
  expect_file_error("box.vtu", "cell 0 is a vtkTetra with 4 points");
  write_polydata("line.vtp", "NumberOfPolys=\"1\"", CELLS("0 1", "2"), "", "");
  expect_file_error("line.vtp", "cell 0 is a face with 2 points");
  write_polydata("vertex.vtp", "NumberOfVerts=\"1\" NumberOfPolys=\"1\"", CELLS("0 1 3", "3"), "", "");
  expect_file_error("vertex.vtp", "vertex.vtp: ");
  write_polydata("none.vtp", "NumberOfPolys=\"0\"", CELLS("", ""), "", "");
  expect_file_error("none.vtp", "holds no faces");
  write_polydata("outside.vtp", "NumberOfPolys=\"1\"", CELLS("0 1 7", "3"), "", "");
  expect_file_error("outside.vtp", "cell 0 names point 7 of 7");
  write_polydata("flat.vtp", "NumberOfPolys=\"1\"", CELLS("0 0 0 0 0", "5"), "", "");
  expect_file_error("flat.vtp", "cell 0 is a polygon that cannot be cut");
}

TEST(test_broken_leaflets) {
  const char *const two = CELLS("0 1 3 1 2 3", "3 6");
  write_polydata("short.vtp", "NumberOfPolys=\"2\"", two, "", LEAFLETS("Int32", "1"));
  expect_file_error("short.vtp", "short.vtp: ");
  write_polydata("negative.vtp", "NumberOfPolys=\"2\"", two, "", LEAFLETS("Int32", "0 -1"));
  expect_file_error("negative.vtp", "riis_leaflet: cell 1 has -1");
  write_polydata("fraction.vtp", "NumberOfPolys=\"2\"", two, "", LEAFLETS("Float32", "0.5 1"));
  expect_file_error("fraction.vtp", "riis_leaflet: cell 0 has 0.5");
  write_polydata("nan.vtp", "NumberOfPolys=\"2\"", two, "", LEAFLETS("Float64", "nan 0"));
  expect_file_error("nan.vtp", "riis_leaflet: cell 0 has nan");
  write_polydata("large.vtp", "NumberOfPolys=\"2\"", two, "", LEAFLETS("Int64", "0 2147483648"));
  expect_file_error("large.vtp", "riis_leaflet: cell 1 has 2147483648");
  write_polydata(
      "wide.vtp", "NumberOfPolys=\"2\"", two, "",
      "<DataArray type=\"Int32\" Name=\"riis_leaflet\" NumberOfComponents=\"2\" format=\"ascii\">0 0 1 1</DataArray>");
  expect_file_error("wide.vtp", "riis_leaflet must hold one number for each cell");
  write_polydata("words.vtp", "NumberOfPolys=\"2\"", two, "",
                 "<Array type=\"String\" Name=\"riis_leaflet\" format=\"ascii\">97 0 98 0</Array>");
  expect_file_error("words.vtp", "riis_leaflet must hold one number for each cell");
}

TEST(test_truncated_stl) {
  write_binary_stl("cut.stl", 3, 2);
  expect_file_error("cut.stl", "is truncated or not an STL file: 184 bytes, 3 triangles");
  write_binary_stl("more.stl", 2, 3);
  expect_file_error("more.stl", "has 50 bytes behind the 2 triangles");
  write_ascii_stl("cut_ascii.stl", 2, 0);
  expect_file_error("cut_ascii.stl", "endsolid is missing");
  scratch_write_text("odd.stl", "solid x\nfacet normal 0 0 1\nouter loop\nvertex 0 0 zero\nendsolid\n");
  expect_file_error("odd.stl", "odd.stl: ");
}

TEST(test_truncated_polydata) {
  riis_surface *valve = make_valve();
  expect_fine(riis_vtk_surface_write(valve, scratch_path("whole.vtp")));
  riis_surface_destroy(&valve);
  size_t size = 0;
  free(scratch_read(scratch_path("whole.vtp"), &size));
  int n_refused = 0;
  scratch_watch_output();
  /* The last byte is a line break, which may be missing. */
  for (size_t kept = size - 2; kept > 0; kept -= kept > 4000 ? 997 : 1) {
    riis_vtk_surface *surface = NULL;
    assert_int_equal(truncate(scratch_path("whole.vtp"), (off_t)kept), 0);
    const riis_status status = riis_vtk_surface_read(scratch_path("whole.vtp"), NULL, &surface);
    if (status != RIIS_FILE_ERROR || surface || !strstr(riis_last_error(), "whole.vtp: ")) {
      scratch_end_watch();
      fail_msg("cut to %zu of %zu bytes: %s, %s", kept, size, riis_status_name(status), riis_last_error());
    }
    ++n_refused;
  }
  assert_int_equal(scratch_end_watch(), 0);
  assert_true(n_refused > 3000);
}

int main(void) { return run_cases(scratch_setup, scratch_teardown); }
