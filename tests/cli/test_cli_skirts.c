/* SPDX-License-Identifier: Apache-2.0
 *
 * Tests skirts of surfaces from files. A closed valve stands in a vessel that is wider than its attachment. The valve is read in
 * several ways: as one file, as a file for each leaflet, without the array of the attachment, as a motion and in a case. */
#include <math.h>
#include <riis/riis_vtk.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "expect.h"
#include "program.h"
#include "scratch.h"

enum { n_across = 27, n_along = 32 };
static const double radius = 1.6, lowest = -1.5, highest = 2.5;

/* Writes a vessel of hexahedra. Squares of a grid are mapped to discs. */
static int write_vessel(void) {
  FILE *file = fopen(scratch_path("vessel.vtk"), "w");
  assert_non_null(file);
  const int n_cells = (n_across - 1) * (n_across - 1) * (n_along - 1);
  fprintf(file, "# vtk DataFile Version 3.0\nvessel\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS %d double\n",
          n_across * n_across * n_along);
  for (int k = 0; k < n_along; ++k)
    for (int j = 0; j < n_across; ++j)
      for (int i = 0; i < n_across; ++i) {
        const double u = 2.0 * i / (n_across - 1) - 1, v = 2.0 * j / (n_across - 1) - 1;
        fprintf(file, "%.17g %.17g %.17g\n", radius * u * sqrt(1 - v * v / 2), radius * v * sqrt(1 - u * u / 2),
                lowest + (highest - lowest) * k / (n_along - 1));
      }
  fprintf(file, "CELLS %d %d\n", n_cells, 9 * n_cells);
  for (int k = 0; k + 1 < n_along; ++k)
    for (int j = 0; j + 1 < n_across; ++j)
      for (int i = 0; i + 1 < n_across; ++i) {
        fputs("8", file);
        for (int c = 0; c < 8; ++c) {
          const int a = i + (c % 4 == 1 || c % 4 == 2), b = j + (c % 4 > 1);
          fprintf(file, " %d", a + n_across * (b + n_across * (k + c / 4)));
        }
        fputs("\n", file);
      }
  fprintf(file, "CELL_TYPES %d\n", n_cells);
  for (int i = 0; i < n_cells; ++i) fputs("12\n", file);
  return fclose(file);
}

static char vessel[256], plain[256];

/* Writes the closed valve without a skirt, which leaks in the vessel. */
static int write_valve(void **state) {
  if (scratch_setup(state) != 0 || write_vessel() != 0) return 1;
  snprintf(vessel, sizeof vessel, "%s", scratch_path("vessel.vtk"));
  snprintf(plain, sizeof plain, "%s", scratch_path("plain.vtp"));
  RUN_FINE("surface", "--valve", "coapting", "--opening", "0", "--output", plain);
  return 0;
}

static riis_surface_arrays arrays_of(const char *path, riis_vtk_surface **file) {
  riis_surface_arrays arrays;
  expect_fine(riis_vtk_surface_read(path, NULL, file));
  expect_fine(riis_vtk_surface_get_arrays(*file, &arrays, sizeof arrays));
  return arrays;
}

/* Writes a leaflet as an .stl file, which has no arrays. The leaflet -1 stands for all leaflets. */
static void write_stl(const char *name, int leaflet) {
  riis_vtk_surface *from = NULL;
  const riis_surface_arrays arrays = arrays_of(plain, &from);
  FILE *file = fopen(scratch_path(name), "w");
  assert_non_null(file);
  fputs("solid leaflet\n", file);
  for (int64_t i = 0; i < arrays.n_faces; ++i) {
    if (leaflet >= 0 && arrays.leaflet_id[i] != leaflet) continue;
    fputs("facet normal 0 0 0\nouter loop\n", file);
    for (int k = 0; k < 3; ++k) {
      const double *p = (const double *)arrays.x + 3 * ((const int64_t *)arrays.vertex_ids)[3 * i + k];
      fprintf(file, "vertex %.9g %.9g %.9g\n", p[0], p[1], p[2]);
    }
    fputs("endloop\nendfacet\n", file);
  }
  fputs("endsolid leaflet\n", file);
  assert_int_equal(fclose(file), 0);
  riis_vtk_surface_destroy(&from);
}

#define BETWEEN "--between=0,0,-1.2", "0,0,2.2"

/* Takes the length from a warning such as "--half-thickness 0.4 or --skirt 0.41 closes it". */
static const char *advised_skirt(const char *warning) {
  static char length[32];
  const char *const text = strstr(warning, " or --skirt ");
  if (!text || sscanf(text, " or --skirt %31[0-9.]", length) != 1) fail_msg("stderr: %s", warning);
  size_t n = strlen(length);
  if (length[n - 1] == '.') length[n - 1] = 0;
  return length;
}

TEST(the_attachment_is_in_the_file) {
  riis_vtk_surface *file = NULL;
  const riis_surface_arrays arrays = arrays_of(plain, &file);
  assert_non_null(arrays.attached);
  riis_valve *valve = NULL;
  riis_surface *surface = NULL;
  riis_attachment held;
  riis_triangles triangles;
  expect_fine(riis_valve_create("coapting", &valve));
  expect_fine(riis_surface_create(valve, NULL, &surface));
  expect_fine(riis_surface_get_attachment(surface, &held, sizeof held));
  expect_fine(riis_surface_get_triangles(surface, &triangles, sizeof triangles));
  uint8_t *expected = calloc((size_t)triangles.n_vertices, 1);
  for (int64_t i = 0; i < 2 * held.n_edges; ++i)
    for (int64_t id = 0; id < triangles.n_vertices; ++id) /* also other vertices at this place */
      if (memcmp(triangles.xyz + 3 * id, held.edges + 3 * i, 3 * sizeof *held.edges) == 0) expected[id] = 1;
  assert_int_equal(arrays.n_vertices, triangles.n_vertices);
  assert_memory_equal(arrays.attached, expected, (size_t)arrays.n_vertices);
  free(expected);
  riis_surface_destroy(&surface);
  riis_valve_destroy(&valve);
  riis_vtk_surface_destroy(&file);
}

/* The struct of an old caller ends before the attachment. */
TEST(old_callers_get_no_attachment) {
  riis_vtk_surface *file = NULL;
  riis_surface_arrays arrays;
  memset(&arrays, 0x5a, sizeof arrays);
  const riis_surface_arrays before = arrays;
  expect_fine(riis_vtk_surface_read(plain, NULL, &file));
  expect_fine(riis_vtk_surface_get_arrays(file, &arrays, offsetof(riis_surface_arrays, skirt_length)));
  assert_memory_equal((const char *)&arrays + offsetof(riis_surface_arrays, skirt_length),
                      (const char *)&before + offsetof(riis_surface_arrays, skirt_length),
                      sizeof arrays - offsetof(riis_surface_arrays, skirt_length));
  riis_vtk_surface_destroy(&file);
}

TEST(the_advised_skirt_seals_the_vessel) {
  run_program("check", "leaks", vessel, "--surface", plain, BETWEEN, NULL);
  char length[32];
  snprintf(length, sizeof length, "%s", advised_skirt(program_leaks[0] ? program_leaks : program_err));
  RUN_FINE("check", "leaks", vessel, "--surface", plain, "--skirt", length, BETWEEN);
  RUN_FINE("mark", vessel, "--surface", plain, "--skirt", length, "--output", scratch_path("marked.vtu"));
}

TEST(the_wall_ends_the_skirt) {
  RUN_FINE("check", "leaks", vessel, "--surface", plain, "--skirt", "1", "--wall", vessel, BETWEEN);
  if (!strstr(program_out, "skirt     to the wall, ")) fail_msg("stdout: %s", program_out);
  run_program("check", "leaks", vessel, "--surface", plain, "--skirt", "0.1", "--wall", vessel, BETWEEN, NULL);
  assert_int_equal(program_exit_code, 1);
  assert_non_null(strstr(program_err, "wall is not within --skirt, 0.1, of the attachment: the widest gap is "));
}

TEST(other_files_of_the_same_valve) {
  static char leaflets[3][256], whole[256];
  for (int i = 0; i < 3; ++i) {
    const char *const name[3] = {"right.stl", "left.stl", "non.stl"};
    write_stl(name[i], i);
    snprintf(leaflets[i], sizeof leaflets[i], "%s", scratch_path(name[i]));
  }
  write_stl("whole.stl", -1);
  snprintf(whole, sizeof whole, "%s", scratch_path("whole.stl"));
  RUN_FINE("check", "leaks", vessel, "--surface", whole, "--skirt", "0.6", BETWEEN);
  RUN_FINE("check", "leaks", vessel, "--surface", leaflets[0], "--surface", leaflets[1], "--surface", leaflets[2],
           "--skirt", "0.6", BETWEEN);
  scratch_write_text(
      "case.json",
      "{\"mesh\": \"vessel.vtk\", \"valves\": [{\"surface\": [\"right.stl\", \"left.stl\", \"non.stl\"], "
      "\"skirt\": 0.6}]}");
  RUN_FINE("mark", "--case", scratch_path("case.json"), "--output", scratch_path("marked.vtu"));
}

TEST(a_motion_carries_its_skirt) {
  static char later[256];
  snprintf(later, sizeof later, "%s", scratch_path("later.vtp"));
  RUN_FINE("surface", "--valve", "coapting", "--opening", "0", "--translate", "0.05,0,0.1", "--output", later);
  scratch_write_text("motion.pvd",
                     "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\"><Collection>"
                     "<DataSet timestep=\"0\" file=\"plain.vtp\"/><DataSet timestep=\"1\" file=\"later.vtp\"/>"
                     "</Collection></VTKFile>\n");
  static char motion[256];
  snprintf(motion, sizeof motion, "%s", scratch_path("motion.pvd"));
  RUN_FINE("check", "leaks", vessel, "--surface", motion, "--time", "0.5", "--skirt", "0.6", BETWEEN);
  RUN_FINE("check", "leaks", vessel, "--surface", motion, "--time", "0.5", "--skirt", "1", "--wall", vessel, BETWEEN);
  RUN_FINE("mark", vessel, "--surface", motion, "--times", "0:1:0.5", "--skirt", "0.6", "--quiet", "--output",
           scratch_path("series.pvd"));
  RUN_FINE("states", scratch_path("states.csv"), "--surface", motion, "--skirt", "0.6");
}

TEST(measures_leave_the_skirt_out) {
  static char bare[longest_output];
  RUN_FINE("states", "-", "--surface", plain);
  snprintf(bare, sizeof bare, "%s", program_out);
  RUN_FINE("states", "-", "--surface", plain, "--skirt", "0.4");
  /* The table's first line names the columns. The skirt's two columns follow those of the leaflets. */
  char *const columns = strstr(program_out, ",skirt_area,skirt_area_ratio");
  char *const edges = strstr(program_out, ",skirt_edge,skirt_edge_ratio");
  assert_true(columns != NULL || edges != NULL);
  const char *const orifice = strrchr(bare, ',');
  assert_non_null(strstr(program_out, orifice));
}

TEST(refusals) {
  RUN_REFUSED(2, "--skirt: 12 m: skirt_length is 1200; it must be 0, or from ", "surface", "--valve", "trileaflet",
              "--unit", "m", "--skirt", "12", "--output", scratch_path("long.vtp"));
  RUN_REFUSED(2, "--skirt: skirt_length is 100; it must be 0, or from ", "surface", "--surface", plain, "--skirt",
              "100", "--output", scratch_path("out.vtp"));
  static char bileaflet[256];
  snprintf(bileaflet, sizeof bileaflet, "%s", scratch_path("bileaflet.vtp"));
  RUN_FINE("surface", "--valve", "bileaflet", "--opening", "1", "--output", bileaflet);
  run_program("surface", "--surface", bileaflet, "--skirt", "0.1", "--output", scratch_path("out.vtp"), NULL);
  assert_int_equal(program_exit_code, 1);
  assert_non_null(strstr(program_err, "name the attached vertices by the point array riis_attached"));
  for (int i = 0; i < 2; ++i) {
    RUN_REFUSED(2, "--skirt", "surface", "--surface", plain, "--skirt", i ? "nan" : "-1", "--output",
                scratch_path("out.vtp"));
  }
}

/* Writes a square of two triangles, with an array of the attachment. */
static const char *write_square(const char *array) {
  char text[1024];
  snprintf(text, sizeof text,
           "# vtk DataFile Version 3.0\nsquare\nASCII\nDATASET POLYDATA\nPOINTS 4 double\n0 0 0 1 0 0 1 1 0 0 1 0\n"
           "POLYGONS 2 8\n3 0 1 2\n3 0 2 3\nPOINT_DATA 4\n%s\n",
           array);
  scratch_write_text("square.vtk", text);
  return scratch_path("square.vtk");
}

TEST(arrays_of_the_attachment) {
  static char out[256];
  snprintf(out, sizeof out, "%s", scratch_path("out.vtp"));
  RUN_FINE("surface", "--surface", write_square("SCALARS riis_attached double 1\nLOOKUP_TABLE default\n1 1 1 0"),
           "--skirt", "0.1", "--half-thickness", "0.05", "--output", out);
  riis_vtk_surface *file = NULL;
  assert_int_equal(arrays_of(out, &file).n_faces, 2 + 2 * 2); /* two of the four edges are attached */
  /* The middle of the edges from (0, 0) to (1, 0) and from (1, 0) to (1, 1). */
  assert_non_null(strstr(program_out, "skirt     from 2 open edges of the length 2 in all, around 0.75 0.25 0\n"));
  riis_vtk_surface_destroy(&file);
  RUN_FINE("surface", "--surface", write_square("SCALARS other int 1\nLOOKUP_TABLE default\n1 1 1 0"), "--skirt", "0.1",
           "--half-thickness", "0.05", "--output", out);
  assert_int_equal(arrays_of(out, &file).n_faces, 2 + 2 * 4);
  assert_non_null(strstr(program_out, "skirt     from 4 open edges of the length 4 in all, around 0.5 0.5 0\n"));
  riis_vtk_surface_destroy(&file);
  RUN_REFUSED(1, "point array riis_attached must hold one number for each point", "surface", "--surface",
              write_square("VECTORS riis_attached double\n1 1 1 1 1 1 1 1 1 1 1 1"), "--skirt", "0.1", "--output", out);
  RUN_REFUSED(1, "the point array riis_attached: no open edge leads from vertex 0 to another attached vertex",
              "surface", "--surface", write_square("SCALARS riis_attached int 1\nLOOKUP_TABLE default\n1 0 1 0"),
              "--skirt", "0.1", "--output", out);
  RUN_REFUSED(1, "riis_attached is an array of cells; it must be a point array, with one number for each point",
              "surface", "--surface",
              write_square("CELL_DATA 2\nSCALARS riis_attached int 1\nLOOKUP_TABLE default\n1 0"), "--skirt", "0.1",
              "--output", out);
  scratch_write_text("nan.vtp", /* the array's values are 1, nan, 1, 0, encoded by base64 */
                     "<VTKFile type=\"PolyData\" version=\"0.1\" byte_order=\"LittleEndian\"><PolyData><Piece "
                     "NumberOfPoints=\"4\" NumberOfPolys=\"2\"><PointData><DataArray type=\"Float32\" "
                     "Name=\"riis_attached\" format=\"binary\">EAAAAAAAgD8AAMB/AACAPwAAAAA=</DataArray></PointData>"
                     "<Points><DataArray type=\"Float32\" NumberOfComponents=\"3\" format=\"ascii\">0 0 0 1 0 0 1 1 0 "
                     "0 1 0</DataArray></Points><Polys><DataArray type=\"Int32\" Name=\"connectivity\" "
                     "format=\"ascii\">0 1 2 0 2 3</DataArray><DataArray type=\"Int32\" Name=\"offsets\" "
                     "format=\"ascii\">3 6</DataArray></Polys></Piece></PolyData></VTKFile>\n");
  RUN_REFUSED(1, "nan.vtp: point array riis_attached is nan at point 1", "surface", "--surface",
              scratch_path("nan.vtp"), "--skirt", "0.1", "--output", out);
  /* Without a skirt, the array has no effect. */
  RUN_FINE("surface", "--surface", write_square("SCALARS riis_attached int 1\nLOOKUP_TABLE default\n1 0 1 0"),
           "--half-thickness", "0.05", "--output", out);
}

int main(void) { return run_cases(write_valve, scratch_teardown); }
