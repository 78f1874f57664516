/* SPDX-License-Identifier: Apache-2.0
 *
 * --leaflets takes a surface file's leaflets from its connected pieces or from one of its arrays. --prefix adds the marks of a
 * second valve to those of the first. --replace removes the first valve's marks. */
#include <math.h>
#include <riis/riis_vtk.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "expect.h"
#include "program.h"
#include "scratch.h"
#include "vtk_shim.h"

/* Three squares lie above each other, with two triangles each. The file lists a triangle of each square in turn. */
static const double heights[3] = {-0.2, 0, -1};
static void write_squares(void) {
  static char text[4096];
  char *end = stpcpy(text, "solid squares\n");
  for (int half = 0; half < 2; ++half)
    for (int i = 0; i < 3; ++i)
      end += sprintf(end,
                     "facet normal 0 0 1\nouter loop\nvertex -1 -1 %g\nvertex %s %g\nvertex %s %g\nendloop\nendfacet\n",
                     heights[i], half ? "1 1" : "1 -1", heights[i], half ? "-1 1" : "1 1", heights[i]);
  strcpy(end, "endsolid\n");
  scratch_write_text("squares.stl", text);
}

static int make_files(void **state) {
  if (make_box(state)) return -1;
  write_squares();
  return 0;
}

/* Checks the leaflet of every node within the limit. The leaflet must be that of the square nearest to the node's height. */
static void expect_leaflets(const char *path, const int leaflets[3]) {
  static double xyz[3 * n_box], leaflet[n_box];
  int n_of[3] = {0, 0, 0};
  assert_int_equal(shim_read_points(path, NULL, NULL, NULL, xyz), 1);
  assert_int_equal(shim_read_array(path, 'p', "riis_leaflet", NULL, NULL, NULL, leaflet), 1);
  for (int i = 0; i < n_box; ++i) {
    if (leaflet[i] < 0) continue;
    int nearest = 0;
    for (int k = 1; k < 3; ++k)
      if (fabs(xyz[3 * i + 2] - heights[k]) < fabs(xyz[3 * i + 2] - heights[nearest])) nearest = k;
    if (leaflet[i] != leaflets[nearest]) fail_msg("node %d has leaflet %g, not %d", i, leaflet[i], leaflets[nearest]);
    ++n_of[nearest];
  }
  for (int k = 0; k < 3; ++k) assert_true(n_of[k] > 10);
}

#define RUN_LEAFLETS(surface, ...)                                                                                    \
  RUN_FINE("mark", scratch_path("in.vtu"), "--surface", scratch_path(surface), "--half-thickness", "0.2", "--output", \
           scratch_path("out.vtu"), __VA_ARGS__)

TEST(test_leaflets) {
  RUN_LEAFLETS("squares.stl", "--stats", scratch_path("s.json"));
  expect_leaflets(scratch_path("out.vtu"), (int[3]){0, 0, 0});
  assert_null(strstr(program_out, "leaflet"));
  RUN_LEAFLETS("squares.stl", "--leaflets", "connected");
  expect_leaflets(scratch_path("out.vtu"), (int[3]){0, 1, 2});
  assert_non_null(strstr(program_out, "squares.stl: 6 triangles, 3 leaflets, area 12\n"));
  RUN_LEAFLETS("squares.stl", "--leaflets", "connected", "--stats", "-");
  assert_true(json_number(program_out, "n_leaflets") == 3);
  /* The written surface keeps the leaflets. The array riis_triangle of a surface gives every triangle a different number. */
  RUN_FINE("surface", "--surface", scratch_path("squares.stl"), "--leaflets", "connected", "--output",
           scratch_path("squares.vtp"));
  RUN_LEAFLETS("squares.vtp", "--quiet");
  expect_leaflets(scratch_path("out.vtu"), (int[3]){0, 1, 2});
  RUN_LEAFLETS("squares.vtp", "--leaflets", "riis_leaflet");
  expect_leaflets(scratch_path("out.vtu"), (int[3]){0, 1, 2});
  RUN_LEAFLETS("squares.vtp", "--leaflets", "riis_patch");
  expect_leaflets(scratch_path("out.vtu"), (int[3]){0, 0, 0});
  RUN_LEAFLETS("squares.vtp", "--leaflets", "riis_triangle");
  assert_non_null(strstr(program_out, ", 6 leaflets, "));
}

TEST(test_leaflet_refusals) {
  const char *mesh = scratch_path("in.vtu");
  RUN_FINE("surface", "--surface", scratch_path("squares.stl"), "--output", scratch_path("s.vtp"));
  RUN_REFUSED(1, "s.vtp: has no cell array colour; there are: riis_leaflet, riis_patch, riis_triangle", "mark", mesh,
              "--surface", scratch_path("s.vtp"), "--leaflets", "colour");
  RUN_REFUSED(1, "squares.stl: has no cell array colour; there is none", "mark", mesh, "--surface",
              scratch_path("squares.stl"), "--leaflets", "colour");
  scratch_write_text(
      "bad.vtp",
      "<VTKFile type=\"PolyData\" version=\"0.1\" byte_order=\"LittleEndian\"><PolyData>\n"
      "<Piece NumberOfPoints=\"3\" NumberOfPolys=\"1\"><CellData>\n"
      "<DataArray type=\"Float64\" Name=\"half\" format=\"ascii\">1.5</DataArray></CellData><Points>\n"
      "<DataArray type=\"Float64\" NumberOfComponents=\"3\" format=\"ascii\">0 0 0 1 0 0 0 1 0</DataArray>"
      "</Points>\n<Polys><DataArray type=\"Int64\" Name=\"connectivity\" format=\"ascii\">0 1 2</DataArray>"
      "<DataArray type=\"Int64\" Name=\"offsets\" format=\"ascii\">3</DataArray></Polys>\n"
      "</Piece></PolyData></VTKFile>\n");
  RUN_REFUSED(1, "bad.vtp: cell array half: cell 0 has 1.5", "mark", mesh, "--surface", scratch_path("bad.vtp"),
              "--leaflets", "half");
  RUN_REFUSED(2, "--leaflets: the value is empty", "mark", mesh, "--surface", scratch_path("s.vtp"), "--leaflets", "");
}

/* Several files form one valve. Each file is a leaflet with the file's name. */
TEST(test_files_of_leaflets) {
  const char *names[3] = {"low.obj", "middle.ply", "deep.vtk"};
  static char mesh[256], paths[3][256];
  snprintf(mesh, sizeof mesh, "%s", scratch_path("in.vtu"));
  for (int i = 0; i < 3; ++i) {
    char text[512];
    const double z = heights[i];
    const char *format =
        i == 0 ? "v -1 -1 %g\nv 1 -1 %g\nv 1 1 %g\nv -1 1 %g\nf 1 2 3 4\n"
        : i == 1
            ? "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
              "element face 1\nproperty list uchar int vertex_indices\nend_header\n-1 -1 %g\n1 -1 %g\n1 1 "
              "%g\n-1 1 %g\n4 0 1 2 3\n"
            : "# vtk DataFile Version 3.0\nx\nASCII\nDATASET POLYDATA\nPOINTS 4 double\n-1 -1 %g 1 -1 %g 1 1 %g -1 "
              "1 %g\nPOLYGONS 2 8\n3 0 1 2\n3 0 2 3\n";
    snprintf(text, sizeof text, format, z, z, z, z);
    scratch_write_text(names[i], text);
    snprintf(paths[i], sizeof paths[i], "%s", scratch_path(names[i]));
  }
#define THREE_FILES "--surface", paths[0], "--surface", paths[1], "--surface", paths[2]
  RUN_FINE("mark", mesh, THREE_FILES, "--half-thickness", "0.2", "--output", scratch_path("out.vtu"));
  expect_leaflets(scratch_path("out.vtu"), (int[3]){0, 1, 2});
  assert_non_null(strstr(program_out, "low.obj and 2 more: 6 triangles, 3 leaflets, area 12\n"));
  RUN_FINE("surface", THREE_FILES, "--output", scratch_path("all.vtp"));
  RUN_LEAFLETS("all.vtp", "--quiet");
  expect_leaflets(scratch_path("out.vtu"), (int[3]){0, 1, 2});
  run_program("states", scratch_path("states.csv"), THREE_FILES, NULL);
  assert_int_equal(program_exit_code, 0);
  for (int i = 0; i < 3; ++i) {
    char name[32];
    snprintf(name, sizeof name, "%.*s", (int)strcspn(names[i], "."), names[i]);
    if (!strstr(program_out, name)) fail_msg("no %s in:\n%s", name, program_out);
  }
  run_program("check", "leaks", mesh, THREE_FILES, "--half-thickness", "0.2", "--between", "0,0,-0.6", "0,0,0.3", NULL);
  assert_non_null(strstr(program_out, "low.obj and 2 more: 6 triangles, 3 leaflets, area 12\n"));
  scratch_write_text("case.json",
                     "{\"mesh\": \"in.vtu\", \"half_thickness\": 0.2, \"valves\": [{\"surface\": [\"low.obj\", "
                     "\"middle.ply\", \"deep.vtk\"]}]}");
  RUN_FINE("mark", "--case", scratch_path("case.json"), "--output", scratch_path("out.vtu"), "--quiet");
  expect_leaflets(scratch_path("out.vtu"), (int[3]){0, 1, 2});
  RUN_REFUSED(2, "--leaflets has no effect with several files, because each file is one leaflet", "mark", mesh,
              THREE_FILES, "--leaflets", "connected");
  RUN_REFUSED(2, "--surface: one of ", "mark", mesh, "--surface", paths[0], "--surface", "a.pvd");
  RUN_REFUSED(1, "none.obj: cannot be read: No such file or directory", "mark", mesh, "--surface", paths[0],
              "--surface", "none.obj");
  RUN_REFUSED(2, "is also the file of --surface", "mark", mesh, THREE_FILES, "--stats", paths[2]);
  scratch_write_text("bad.json", "{\"mesh\": \"in.vtu\", \"valves\": [{\"surface\": [\"low.obj\", 3]}]}");
  RUN_REFUSED(1, "surface: 3 is not a path", "mark", "--case", scratch_path("bad.json"));
}

/* riis export writes a motion of each leaflet, and the program reads these files as a series. */
TEST(test_exported_motion) {
  static char paths[3][256];
  const char *leaflets[3] = {"right", "left", "non_coronary"};
  run_program("export", scratch_path("uris"), "--valve", "trileaflet", "--half-thickness", "0.2", "--resistance", "1e4",
              "--time-step", "0.02", "--opening-seconds", "0.1", "--closing-seconds", "0.1", NULL);
  assert_int_equal(program_exit_code, 0);
  for (int i = 0; i < 3; ++i) {
    char name[64];
    snprintf(name, sizeof name, "uris/%s_open.dat", leaflets[i]);
    snprintf(paths[i], sizeof paths[i], "%s", scratch_path(name));
  }
  for (int opening = 0; opening < 2; ++opening) {
    RUN_FINE("surface", THREE_FILES, "--time-step", "0.02", "--time", opening ? "0.1" : "0", "--output",
             scratch_path("read.vtp"));
    const char *found = strstr(program_out, " triangles, 3 leaflets, area ");
    if (!found) fail_msg("%s", program_out);
    const double area = strtod(strstr(found, "area ") + 5, NULL);
    RUN_FINE("surface", "--valve", "trileaflet", "--half-thickness", "0.2", "--triangulation", "fixed", "--opening",
             opening ? "1" : "0", "--output", scratch_path("made.vtp"));
    assert_true(fabs(area / strtod(strstr(program_out, "area ") + 5, NULL) - 1) < 1e-5);
  }
  RUN_FINE("mark", scratch_path("in.vtu"), THREE_FILES, "--time-step", "0.02", "--times", "0,0.03,0.1",
           "--half-thickness", "0.2", "--quiet", "--output", scratch_path("series.pvd"));
  run_program("states", scratch_path("states.csv"), THREE_FILES, "--time-step", "0.02", NULL);
  assert_int_equal(program_exit_code, 0);
  assert_non_null(strstr(program_out, "non_coronary_open"));
  RUN_REFUSED(2, "--time-step needs a motion, --surface FILE.dat", "states", scratch_path("states.csv"), "--surface",
              scratch_path("squares.stl"), "--time-step", "0.02");
  RUN_REFUSED(2, "--time-step needs a motion, --surface FILE.dat", "mark", scratch_path("in.vtu"), "--surface",
              scratch_path("squares.stl"), "--time-step", "0.02");
}

/* Each fault in the sides or the areas of faces is reported in one line. */
TEST(test_face_warnings) {
  static const struct {
    const char *faces, *line;
    int n_lines;
  } files[] = {
      {"f 1 2 3\nf 1 3 4\n", "", 0},
      {"f 1 2 3\nf 4 3 1\n",
       "1 of 2 triangles is turned over relative to the neighbours: normals and sides change there", 1},
      {"f 1 2 3\nf 1 3 4\nf 2 3 1\n", "1 triangle is in the file twice, and areas count both copies", 1},
      {"f 1 2 3\nf 1 3 5\nf 1 5 2\nf 3 2 5\n", "1 piece is closed like a thick leaflet, and areas count both faces", 1},
      {"f 1 2 3\nf 1 3 5\nf 1 5 2\nf 2 3 5\n", "1 of 4 triangles is turned over", 2}};
  for (size_t i = 0; i < sizeof files / sizeof *files; ++i) {
    char text[512];
    snprintf(text, sizeof text, "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\n%s", files[i].faces);
    scratch_write_text("faces.obj", text);
    run_program("surface", "--surface", scratch_path("faces.obj"), "--output", scratch_path("faces.vtp"), "--quiet",
                NULL);
    assert_int_equal(program_exit_code, 0);
    int n_lines = 0;
    for (const char *at = program_err; (at = strchr(at, '\n')); ++at) ++n_lines;
    if (n_lines != files[i].n_lines || !strstr(program_err, files[i].line)) fail_msg("%s%s", text, program_err);
    run_program("surface", "--surface", scratch_path("faces.obj"), "--output", scratch_path("faces.vtp"), "--strict",
                NULL);
    assert_int_equal(program_exit_code, n_lines > 0 ? 4 : 0);
  }
}

/* Writes the triangles of one leaflet of a valve as STL, perhaps turned over. Names it leaf_0.stl, leaf_1.stl, ... */
static void write_leaflet(const riis_triangles *triangles, int leaflet, int is_turned) {
  char name[32];
  snprintf(name, sizeof name, "leaf_%d.stl", leaflet);
  FILE *file = fopen(scratch_path(name), "w");
  assert_non_null(file);
  fprintf(file, "solid x\n");
  for (int64_t i = 0; i < triangles->n_triangles; ++i) {
    if (triangles->leaflet_id[i] != leaflet) continue;
    fprintf(file, "facet normal 0 0 0\nouter loop\n");
    for (int k = 0; k < 3; ++k) {
      const double *p = triangles->xyz + 3 * triangles->vertex_id[3 * i + (is_turned ? 2 - k : k)];
      fprintf(file, "vertex %.17g %.17g %.17g\n", p[0], p[1], p[2]);
    }
    fprintf(file, "endloop\nendfacet\n");
  }
  fprintf(file, "endsolid x\n");
  assert_int_equal(fclose(file), 0);
}

/* A leaflet that is turned over as a whole is named, for any set of turned leaflets and any placement. */
TEST(test_turned_leaflets) {
  static const struct {
    const char *kind;
    int n_leaflets;
    double opening;
  } valves[] = {{"trileaflet", 3, 0}, {"coapting", 3, 0.5}, {"mitral", 2, 0.6}, {"bicuspid", 2, 0}};
  for (size_t v = 0; v < sizeof valves / sizeof *valves; ++v) {
    riis_valve *valve = NULL;
    riis_surface *surface = NULL;
    riis_triangles triangles;
    expect_fine(riis_valve_create(valves[v].kind, &valve));
    expect_fine(riis_valve_set_scalar(valve, "opening", valves[v].opening));
    expect_fine(riis_surface_create(valve, NULL, &surface));
    expect_fine(riis_surface_get_triangles(surface, &triangles, sizeof triangles));
    const int n = valves[v].n_leaflets;
    for (int turned = 0; turned < 1 << n; ++turned) {
      char paths[3][256];
      int n_turned = 0, n_named = 0;
      for (int i = 0; i < n; ++i) {
        char name[32];
        write_leaflet(&triangles, i, turned >> i & 1);
        snprintf(name, sizeof name, "leaf_%d.stl", i);
        snprintf(paths[i], sizeof paths[i], "%s", scratch_path(name));
        n_turned += turned >> i & 1;
      }
      run_program("surface", "--rotate", "1,2,-3,77", "--output", scratch_path("turned.vtp"), "--quiet", "--surface",
                  paths[0], "--surface", paths[1], n > 2 ? "--surface" : NULL, n > 2 ? paths[2] : NULL, NULL);
      assert_int_equal(program_exit_code, 0);
      for (int i = 0; i < n; ++i) {
        char wanted[96];
        snprintf(wanted, sizeof wanted, "the leaflet leaf_%d is turned over relative to the other leaflets", i);
        const int is_named = strstr(program_err, wanted) != NULL;
        n_named += is_named;
        /* Of three leaflets, the one that differs from the other two is named. Of two leaflets, either may be named. */
        if (n == 3 && is_named != (n_turned == 1 ? turned >> i & 1 : n_turned == 2 && !(turned >> i & 1)))
          fail_msg("%s, turned %d: %s", valves[v].kind, turned, program_err);
      }
      assert_int_equal(n_named, n_turned > 0 && n_turned < n);
    }
    riis_surface_destroy(&surface);
    riis_valve_destroy(&valve);
  }
}

static double n_marked_in(const char *path, const char *name) {
  static double values[n_box];
  double n = 0;
  assert_int_equal(shim_read_array(path, 'p', name, NULL, NULL, NULL, values), 1);
  for (int i = 0; i < n_box; ++i) n += values[i];
  return n;
}

/* Marks two valves in one mesh, one after the other. */
TEST(test_two_valves) {
  char first[256], both[256];
  snprintf(first, sizeof first, "%s", scratch_path("first.vtu"));
  snprintf(both, sizeof both, "%s", scratch_path("both.vtu"));
  RUN_FINE("mark", scratch_path("in.vtu"), "--output", first, "--stats", "-");
  const double n_aortic = json_number(program_out, "n_marked");
  RUN_REFUSED(2, "first.vtu already has an array riis_marked: write --replace to replace it, or --prefix NAME", "mark",
              first, "--valve", "mitral", "--output", both);
  assert_int_equal(scratch_exists("both.vtu"), 0);
  RUN_FINE("mark", first, "--valve", "mitral", "--prefix", "mitral", "--output", both, "--stats", "-");
  const double n_mitral = json_number(program_out, "n_marked");
  assert_true(n_mitral > 0 && n_mitral != n_aortic);
  assert_true(n_marked_in(both, "riis_marked") == n_aortic);
  assert_true(n_marked_in(both, "mitral_marked") == n_mitral);
  assert_int_equal(shim_read_array(both, 'p', "mitral_distance", NULL, NULL, NULL, NULL), 1);
  assert_int_equal(shim_read_array(both, 'p', "mitral_leaflet", NULL, NULL, NULL, NULL), 1);
  RUN_REFUSED(2, "both.vtu already has an array mitral_marked", "mark", both, "--prefix", "mitral", "--output", first);
  RUN_FINE("mark", both, "--replace", "--prefix", "mitral", "--output", first, "--quiet");
  assert_true(n_marked_in(first, "mitral_marked") == n_aortic);
  RUN_FINE("mark", both, "--valve", "mitral", "--replace", "--output", first, "--quiet");
  assert_true(n_marked_in(first, "riis_marked") == n_mitral);
  /* Without an output there is nothing to replace. */
  RUN_FINE("mark", both, "--stats", "-");
  assert_true(json_number(program_out, "n_marked") == n_aortic);
}

int main(void) { return run_cases(make_files, scratch_teardown); }
