/* SPDX-License-Identifier: Apache-2.0
 *
 * Tests the warning about leaks, which are edges that cross the valve between unmarked nodes. The C interface finds the expected
 * leaks among all edges of the mesh. */
#include <math.h>
#include <riis/riis_vtk.h>
#include <stdlib.h>
#include <string.h>

#include "calls.h"
#include "expect.h"
#include "plain_mesh.h"
#include "program.h"
#include "scratch.h"
#include "vtk_shim.h"

/* Writes a box around the valve. The longest edges are the diagonals of cubes, and have the length `longest`. */
static void write_mesh(const char *name, const riis_surface *surface, double longest) {
  riis_surface_info info;
  double lower[3], upper[3], extent = 0;
  expect_fine(riis_surface_get_info(surface, &info, sizeof info));
  for (int i = 0; i < 3; ++i) extent = fmax(extent, info.upper[i] - info.lower[i] + 0.7);
  const int n = 1 + (int)ceil(extent * sqrt(3) / longest);
  for (int i = 0; i < 3; ++i) {
    lower[i] = info.lower[i] - 0.33;
    upper[i] = lower[i] + longest / sqrt(3) * (n - 1) * (1 - 1e-12);
  }
  assert_int_equal(shim_write_box(scratch_path(name), SHIM_RAW, n, lower, upper, 0), 1);
}

static riis_surface *make_surface(const char *kind, double half_thickness) {
  riis_valve *valve = NULL;
  riis_surface *surface = NULL;
  riis_surface_options options;
  expect_fine(riis_surface_options_init(&options, sizeof options));
  options.half_thickness = half_thickness;
  expect_fine(riis_valve_create(kind, &valve));
  expect_fine(riis_valve_set_scalar(valve, "opening", 0));
  expect_fine(riis_surface_create(valve, &options, &surface));
  riis_valve_destroy(&valve);
  return surface;
}

/* Finds leaks by the C interface, which gets every edge of the mesh. */
static riis_leak_list leaks_by_c(const char *name, const riis_surface *surface) {
  riis_vtk_mesh *file = NULL;
  riis_adjacency *adjacency = NULL;
  riis_mesh *mesh = NULL;
  riis_marks *result = NULL;
  riis_csr csr;
  riis_leak_list leaks;
  int64_t n = 0;
  const double *xyz = NULL;
  expect_fine(riis_vtk_mesh_read(scratch_path(name), &file));
  expect_fine(riis_vtk_mesh_get_nodes(file, &n, NULL, &xyz));
  expect_fine(riis_vtk_mesh_create_adjacency(file, 0, &adjacency));
  expect_fine(riis_adjacency_get_csr(adjacency, &csr, sizeof csr));
  expect_fine(riis_mesh_create(n, xyz, xyz + 1, xyz + 2, 3, &mesh));
  expect_fine(riis_mesh_set_adjacency(mesh, &csr));
  expect_fine(riis_marks_create(&result));
  expect_fine(riis_mark_nodes(surface, mesh, NULL, result));
  expect_fine(find_leaks_in(surface, mesh, result, NULL, &leaks));
  riis_marks_destroy(&result);
  riis_mesh_destroy(&mesh);
  riis_adjacency_destroy(&adjacency);
  riis_vtk_mesh_destroy(&file);
  return leaks;
}

/* Checks that the program reports the leaks of the C interface, and that the advised command works as printed. */
static void expect_advice(const char *name, const char *kind) {
  riis_surface *surface = make_surface(kind, 0.1);
  const riis_leak_list leaks = leaks_by_c(name, surface);
  riis_surface_destroy(&surface);
  assert_true(leaks.n_edges > 1);
  run_program("mark", scratch_path(name), "--valve", kind, "--opening", "0", "--quiet", "--stats",
              scratch_path("stats.json"), NULL);
  assert_int_equal(program_exit_code, 0);
  char expected[256];
  snprintf(expected, sizeof expected,
           "riis: the surface leaks: %d edges cross it between two unmarked nodes, the longest (%.3g) at ",
           (int)leaks.n_edges, leaks.longest_length);
  assert_int_equal(strncmp(program_leaks, expected, strlen(expected)), 0);
  /* In the coarsest meshes, the half thickness is far too small for the edges. The warning about the half thickness then comes
   * first, and no other warning contains advice. */
  const char *const earlier = strstr(program_err, "the median edge of the mesh ");
  expect_place(program_leaks + strlen(expected), leaks.longest_middle, leaks.longest_length,
               earlier ? "\n" : "; --half-thickness ");
  assert_true(!strstr(program_leaks, "edges of at most two half thicknesses (0.2) do not leak\n") == (earlier != NULL));
  char *json = scratch_read(scratch_path("stats.json"), NULL);
  assert_true(json_number(json, "n_leaking_edges") == (double)leaks.n_edges);
  assert_true(json_number(json, "longest_leaking_edge") == leaks.longest_length);
  assert_true(json_number(json, "n_cells_without_known_edges") == 0);
  const double closing = json_number(json, "closing_half_thickness");
  free(json);
  assert_true(closing > 0.1 && closing <= 0.505 * leaks.longest_length + 0.02);

  char typed[32] = {0};
  snprintf(typed, sizeof typed, "%g", closing);
  if (!earlier) assert_int_equal(sscanf(strstr(program_leaks, "--half-thickness ") + 17, "%31s", typed), 1);
  assert_true(strtod(typed, NULL) == closing && strlen(typed) <= 5);
  RUN_FINE("mark", scratch_path(name), "--valve", kind, "--opening", "0", "--half-thickness", typed, "--stats", "-");
  assert_string_equal(program_leaks, "");
  assert_true(json_number(program_out, "n_leaking_edges") == 0);
  assert_true(json_has_text(program_out, "closing_half_thickness", "null"));
  surface = make_surface(kind, closing);
  assert_int_equal(leaks_by_c(name, surface).n_edges, 0);
  riis_surface_destroy(&surface);
}

TEST(test_coarse_meshes_leak) {
  const char *const kinds[2] = {"mitral", "aortic"};
  for (int i = 0; i < 2; ++i) {
    riis_surface *surface = make_surface(kinds[i], 0.1);
    for (double longest = 0.26; longest < 0.6; longest += 0.14) {
      write_mesh("coarse.vtu", surface, longest);
      expect_advice("coarse.vtu", kinds[i]);
    }
    riis_surface_destroy(&surface);
  }
}

TEST(test_fine_meshes_do_not) {
  const char *const kinds[2] = {"mitral", "aortic"};
  for (int i = 0; i < 2; ++i) {
    riis_surface *surface = make_surface(kinds[i], 0.1);
    write_mesh("fine.vtu", surface, 0.2);
    RUN_FINE("mark", scratch_path("fine.vtu"), "--valve", kinds[i], "--opening", "0");
    assert_string_equal(program_leaks, "");
    assert_non_null(
        strstr(program_out, "leaks     none: no mesh edge between two unmarked nodes crosses the surface\n"));
    riis_surface_destroy(&surface);
  }
}

/* Triangles from a file do not depend on the half thickness. The program therefore advises the library's number, rounded to three
 * digits. */
TEST(test_surface_from_file) {
  riis_surface *surface = make_surface("mitral", 0.1);
  write_mesh("coarse.vtu", surface, 0.5);
  expect_fine(riis_vtk_surface_write(surface, scratch_path("valve.vtp")));
  const riis_leak_list leaks = leaks_by_c("coarse.vtu", surface);
  riis_surface_destroy(&surface);
  run_program("mark", scratch_path("coarse.vtu"), "--surface", scratch_path("valve.vtp"), "--stats", "-", NULL);
  assert_true(json_number(program_out, "n_leaking_edges") == (double)leaks.n_edges);
  const double closing = json_number(program_out, "closing_half_thickness");
  assert_true(closing >= leaks.half_thickness && closing <= 1.01 * leaks.half_thickness);
  char text[32];
  snprintf(text, sizeof text, "%.17g", leaks.half_thickness);
  RUN_FINE("mark", scratch_path("coarse.vtu"), "--surface", scratch_path("valve.vtp"), "--half-thickness", text);
  assert_string_equal(program_leaks, "");
  snprintf(text, sizeof text, "%.17g", nextafter(leaks.half_thickness, 0));
  RUN_FINE("mark", scratch_path("coarse.vtu"), "--surface", scratch_path("valve.vtp"), "--half-thickness", text);
  assert_non_null(strstr(program_leaks, " edge"));
}

/* The table of statistics also reports leaks. The first three searches report equal leaks. The paper's search and the other ways
 * to measure distances also report leaks. */
TEST(test_searches_and_distances) {
  riis_surface *surface = make_surface("mitral", 0.1);
  write_mesh("coarse.vtu", surface, 0.5);
  write_mesh("finer.vtu", surface, 0.4);
  riis_surface_destroy(&surface);
  const char *const names[3] = {"exhaustive", "neighbor", "clusters"};
  static char first[longest_output];
  for (int i = 0; i < 3; ++i) {
    run_program("mark", scratch_path("coarse.vtu"), "--valve", "mitral", "--opening", "0", "--search", names[i], NULL);
    assert_int_equal(program_exit_code, 0); /* succeeds with a warning that the mesh is coarse */
    assert_non_null(strstr(program_out, " edges between unmarked nodes across the surface, length up to 0."));
    if (i == 0) memcpy(first, program_leaks, sizeof first);
    assert_true(first[0] && strcmp(program_leaks, first) == 0);
  }
  run_program("mark", scratch_path("finer.vtu"), "--valve", "mitral", "--opening", "0", "--distance", "sampling", NULL);
  assert_int_equal(program_exit_code, 0);
  assert_non_null(strstr(program_leaks, "--half-thickness"));
  run_program("mark", scratch_path("coarse.vtu"), "--valve", "mitral", "--opening", "0", "--search", "paper", NULL);
  assert_int_equal(program_exit_code, 3); /* the search's only start node is not marked, so the search finds nothing */
  assert_non_null(strstr(program_err, "may be incomplete"));
  assert_non_null(strstr(program_leaks, " between two unmarked nodes"));
  /* A larger half thickness does not help if the search misses nodes. */
  assert_null(strstr(program_leaks, "--half-thickness"));
}

TEST(test_one_edge) {
  scratch_write_text("one.vtk",
                     "# vtk DataFile Version 3.0\none\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 5 double\n"
                     "0.2 0.2 -0.5 0.2 0.2 0.25 5 0.2 -0.5 0.2 5 -0.5 0.3 0.3 0.05\n"
                     "CELLS 1 5\n4 0 1 2 3\nCELL_TYPES 1\n10\n");
  scratch_write_text("one.stl",
                     "solid x\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\n"
                     "endloop\nendfacet\nendsolid\n");
  RUN_FINE("mark", scratch_path("one.vtk"), "--surface", scratch_path("one.stl"));
  assert_string_equal(
      program_leaks,
      "riis: the surface leaks: 1 edge of length 0.75 crosses it between two unmarked nodes at 0.2 0.2 "
      "-0.12; --half-thickness 0.25 closes it; edges of at most two half thicknesses (0.2) do not leak\n");
  assert_non_null(
      strstr(program_out, "leaks     1 edge between unmarked nodes across the surface, length up to 0.75\n"));
}

/* Returns a box around the closed mitral valve. The box is so coarse that its edges leak. */
static plain_mesh box_of_mitral(int n) {
  riis_surface *surface = make_surface("mitral", 0.1);
  riis_surface_info info;
  double lower[3], upper[3];
  expect_fine(riis_surface_get_info(surface, &info, sizeof info));
  riis_surface_destroy(&surface);
  for (int i = 0; i < 3; ++i) lower[i] = info.lower[i] - 0.33, upper[i] = info.upper[i] + 0.37;
  return plain_hexahedra(n, lower, upper);
}

static riis_leak_list leaks_of_mitral(const char *name) {
  riis_surface *surface = make_surface("mitral", 0.1);
  const riis_leak_list leaks = leaks_by_c(name, surface);
  riis_surface_destroy(&surface);
  return leaks;
}

/* Copies 300 bytes of the output, from this key on, and the warning about leaks. */
static void keep(const char *key, char said[1000]) {
  const char *const found = strstr(program_out, key);
  assert_non_null(found);
  snprintf(said, 1000, "%.600s %.300s", program_leaks, found);
}

/* Runs the program with this mesh, far from the valve or around it. Expects that the leaks are unknown for the given reason. */
static void expect_unknown(const char *name, const char *place, int exit_code, const char *reason) {
  char text[512];
  run_program("mark", scratch_path(name), "--translate", place, "--quiet", "--stats", scratch_path("stats.json"), NULL);
  assert_int_equal(program_exit_code, exit_code);
  snprintf(text, sizeof text, "riis: leaks of the surface are unknown: %s in %s\n", reason, scratch_path(name));
  if (strstr(reason, "no volume"))
    snprintf(text, sizeof text, "riis: leaks of the surface are unknown: %s %s\n", scratch_path(name), reason);
  if (!strstr(program_err, text)) fail_msg("no '%s' in '%s'", text, program_err);
  char *json = scratch_read(scratch_path("stats.json"), NULL);
  assert_true(json_has_text(json, "n_leaking_edges", "null"));
  assert_true(json_has_text(json, "longest_leaking_edge", "null"));
  free(json);
  run_program("mark", scratch_path(name), "--translate", place, NULL);
  snprintf(text, sizeof text, "\nleaks     unknown: %s in the mesh\n", reason);
  if (strstr(reason, "no volume")) snprintf(text, sizeof text, "\nleaks     unknown: the mesh %s\n", reason);
  assert_non_null(strstr(program_out, text));
}

/* The mesh has cells of many types, and riis knows the edges of each type. */
TEST(test_other_cells) {
  assert_int_equal(shim_write_zoo(scratch_path("zoo.vtu")), 1);
  RUN_FINE("mark", scratch_path("zoo.vtu"), "--translate", "50,0,0", "--allow-none", "--quiet", "--stats",
           scratch_path("stats.json"));
  char *json = scratch_read(scratch_path("stats.json"), NULL);
  assert_true(json_number(json, "n_cells_without_known_edges") == 0);
  assert_true(json_number(json, "n_volume_cells") == 3 * 8);
  free(json);
  run_program("mark", scratch_path("zoo.vtu"), "--translate", "50,0,0", NULL);
  assert_non_null(strstr(program_out, "\nleaks     unknown: no node is marked\n"));
}

/* Tests the coordinates of a leak in a small mesh far from the origin, in two units. The coordinates are printed with the digits
 * that the edge length needs, and with their unit. */
TEST(test_places) {
  const struct {
    double origin, edge;
    const char *unit, *half_thickness, *follows;
  } meshes[] = {{1000, 1e-3, NULL, "3e-4", "; --half-thickness "},
                {20, 0.3, "mm", "0.1", " mm; --half-thickness "},
                {-3e5, 4000, "m", "1300", " m; --half-thickness "},
                {0, 2e-6, NULL, "7e-7", "; --half-thickness "}};
  for (int i = 0; i < 4; ++i) {
    char mesh[1024], surface[1024];
    const double o = meshes[i].origin, e = meshes[i].edge, middle[3] = {o + 0.2 * e, o + 0.2 * e, o - 0.1 * e};
    int n = sprintf(mesh, "# vtk DataFile Version 3.0\none\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 4 double\n");
    const double nodes[12] = {.2, .2, -.6, .2, .2, .4, 3, .2, -.6, .2, 3, -.6},
                 corners[9] = {0, 0, 0, 1, 0, 0, 0, 1, 0};
    for (int k = 0; k < 12; ++k) n += sprintf(mesh + n, "%.17g\n", o + e * nodes[k]);
    sprintf(mesh + n, "CELLS 1 5\n4 0 1 2 3\nCELL_TYPES 1\n10\n");
    n = sprintf(surface, "solid x\nfacet normal 0 0 1\nouter loop\n");
    for (int k = 0; k < 9; k += 3)
      n += sprintf(surface + n, "vertex %.17g %.17g %.17g\n", o + e * corners[k], o + e * corners[k + 1], o);
    sprintf(surface + n, "endloop\nendfacet\nendsolid\n");
    scratch_write_text("small.vtk", mesh);
    scratch_write_text("small.stl", surface);
    const char *const unit = meshes[i].unit;
    RUN_FINE("mark", scratch_path("small.vtk"), "--surface", scratch_path("small.stl"), "--half-thickness",
             meshes[i].half_thickness, "--allow-none", unit ? "--unit" : NULL, unit, "--surface-unit", unit);
    const char *const at = strstr(program_leaks, " between two unmarked nodes at ");
    assert_non_null(at);
    expect_place(at + strlen(" between two unmarked nodes at "), middle, e, meshes[i].follows);
  }
}

static void expect_warned(int exit_code) {
  if (program_exit_code != exit_code || !(program_err[0] || program_leaks[0] || program_crossings[0]))
    fail_msg("exit code %d, not %d; stderr: %s%s%s", program_exit_code, exit_code, program_err, program_leaks,
             program_crossings);
}

/* Runs the program on input that gives a warning. The status is 0 without --strict, and 4 with --strict. */
#define EXPECT_STRICT(...)                      \
  do {                                          \
    run_program(__VA_ARGS__, NULL);             \
    expect_warned(0);                           \
    run_program(__VA_ARGS__, "--strict", NULL); \
    expect_warned(4);                           \
  } while (0)

/* Tests warnings of every kind, with and without --quiet. The program always writes all outputs. */
TEST(test_strict) {
  char fine[256], coarse[256];
  riis_surface *surface = make_surface("mitral", 0.1);
  write_mesh("fine.vtu", surface, 0.2);
  write_mesh("coarse.vtu", surface, 0.5);
  riis_surface_destroy(&surface);
  snprintf(fine, sizeof fine, "%s", scratch_path("fine.vtu"));
  snprintf(coarse, sizeof coarse, "%s", scratch_path("coarse.vtu"));
  scratch_write_text("beat.csv", "0,0\n0.1,1\n0.2,0.5\n");
  scratch_write_text("one.json", "{\"mesh\": \"coarse.vtu\", \"valves\": [{\"valve\": \"mitral\", \"opening\": 0}]}");
#define MITRAL "--valve", "mitral"
#define CLOSED MITRAL, "--opening", "0"
  EXPECT_STRICT("mark", fine, CLOSED, "--half-thickness", "1.9", "--stats", scratch_path("s.json"));
  EXPECT_STRICT("mark", coarse, CLOSED, "--output", scratch_path("marked.vtu"), "--quiet");
  assert_true(scratch_exists("s.json") && scratch_exists("marked.vtu"));
  EXPECT_STRICT("check", "leaks", fine, MITRAL, "--between", "0,0,0.7", "0,0,1.9");
  EXPECT_STRICT("mark", fine, "--search", "paper", MITRAL);
  EXPECT_STRICT("surface", "--set", "right.rotation=0,0,60", "--opening", "0", "--output", scratch_path("s.vtp"));
  EXPECT_STRICT("mark", coarse, MITRAL, "--cycle", scratch_path("beat.csv"), "--times", "0,0.1", "--output",
                scratch_path("s.pvd"), "--quiet");
  assert_true(scratch_exists("s/s_0001.vtu"));
  EXPECT_STRICT("mark", "--case", scratch_path("one.json"), "--output", scratch_path("case.vtu"));
  for (int strict = 0; strict < 2; ++strict) {
    run_program("export", scratch_path(strict ? "strict" : "lenient"), MITRAL, "--resistance", "1e4", "--time-step",
                "0.05", "--cycle", scratch_path("beat.csv"), "--opening-span", "0:0.1", "--closing-span", "0.1:0.2",
                strict ? "--strict" : NULL, NULL);
    expect_warned(strict ? 4 : 0);
    assert_true(scratch_exists(strict ? "strict/normal.dat" : "lenient/normal.dat"));
  }
  /* Without a warning the status is 0. A run without marks keeps its status, even with --strict. */
  RUN_FINE("mark", fine, CLOSED, "--strict");
  assert_string_equal(program_leaks, "");
  RUN_FINE("params", "--strict");
  RUN_FINE("states", "-", MITRAL, "--count", "2", "--strict");
  run_program("mark", fine, "--translate", "50,0,0", "--strict", NULL);
  expect_warned(3);
}

static void expect_demanded(int exit_code, const char *mesh) {
  run_program("check", "leaks", mesh, CLOSED, "--demand-sealed", NULL);
  expect_warned(exit_code);
}

/* A mesh without leaking edges passes the check. A mesh with leaking edges, with unknown leaks or far from the valve fails the
 * check. */
TEST(test_demanded_seal) {
  riis_surface *surface = make_surface("mitral", 0.1);
  write_mesh("fine.vtu", surface, 0.2);
  write_mesh("coarse.vtu", surface, 0.5);
  riis_surface_destroy(&surface);
  RUN_FINE("check", "leaks", scratch_path("fine.vtu"), CLOSED, "--demand-sealed");
  assert_string_equal(program_leaks, "");
  expect_demanded(4, scratch_path("coarse.vtu"));
  run_program("check", "leaks", scratch_path("coarse.vtu"), CLOSED, NULL);
  expect_warned(0);
  run_program("check", "leaks", scratch_path("fine.vtu"), CLOSED, "--demand-sealed", "--translate", "50,0,0", NULL);
  expect_warned(3);
  run_program("check", "leaks", scratch_path("fine.vtu"), CLOSED, "--demand-sealed", "--translate", "50,0,0",
              "--allow-none", NULL);
  assert_int_equal(program_exit_code, 4);
  RUN_REFUSED(2, "--demand-sealed is not an option", "mark", scratch_path("fine.vtu"), "--demand-sealed");
}

/* The nodes of a quadratic cell divide it into linear cells, and a mesh of these linear cells has the same leaks. Each quadratic
 * cell has one inner edge that its linear cells lack. */
TEST(test_quadratic_cells) {
  plain_mesh hexahedra = box_of_mitral(9), quadratic = plain_quadratic_tetrahedra(&hexahedra),
             cut = plain_cut(&quadratic, 8), corners = plain_cut(&quadratic, 4);
  plain_write("quadratic.vtu", &quadratic, PLAIN_CELLS, 1);
  plain_write("cut.vtu", &cut, PLAIN_CELLS, 1);
  plain_write("corners.vtu", &corners, PLAIN_CELLS, 1);
  const riis_leak_list all = leaks_of_mitral("cut.vtu"), expected = leaks_of_mitral("corners.vtu");
  assert_true(expected.n_edges > 20 && expected.n_edges <= all.n_edges);
  assert_true(all.n_edges < expected.n_edges + quadratic.n_cells / 10);
  RUN_FINE("mark", scratch_path("quadratic.vtu"), "--valve", "mitral", "--opening", "0", "--stats", "-");
  assert_true(json_number(program_out, "n_leaking_edges") == (double)expected.n_edges);
  assert_true(json_number(program_out, "longest_leaking_edge") == expected.longest_length);
  assert_true(json_number(program_out, "n_volume_cells") == (double)quadratic.n_cells);
  assert_true(json_number(program_out, "n_cells_without_known_edges") == 0);
  char text[128];
  snprintf(text, sizeof text, "the surface leaks: %d edges", (int)expected.n_edges);
  assert_non_null(strstr(program_leaks, text));
  plain_free(&hexahedra);
  plain_free(&quadratic);
  plain_free(&cut);
  plain_free(&corners);
}

/* Hexahedra may be stored as polyhedra in two layouts. The leaks and the passage equal those of plain hexahedra. */
TEST(test_polyhedra) {
  static const char *const names[3] = {"cells.vtu", "streams.vtu", "lists.vtu"};
  static char said[3][2][1000];
  plain_mesh hexahedra = box_of_mitral(9);
  for (int i = 0; i < 3; ++i) {
    plain_write(names[i], &hexahedra, (enum plain_layout)i, 2);
    run_program("mark", scratch_path(names[i]), "--valve", "mitral", "--opening", "0", "--stats", "-", NULL);
    assert_int_equal(program_exit_code, 0);
    assert_true(json_number(program_out, "n_leaking_edges") > 10);
    keep("\"n_leaking_edges\"", said[i][0]);
    run_program("check", "leaks", scratch_path(names[i]), "--valve", "mitral", "--opening", "0", "--stats", "-",
                "--between", "0,0,2.1", "1,1,0.6", NULL);
    assert_int_equal(program_exit_code, 0);
    keep("\"passage\"", said[i][1]);
    for (int k = 0; k < 2; ++k) assert_string_equal(said[i][k], said[0][k]);
  }
  plain_free(&hexahedra);
}

/* Leaks are unknown in a cloud of points, in a mesh of triangles, and if riis does not know the edges of a cell. */
TEST(test_unknown) {
  static const char *const cells[4] = {"CELLS 0 0\nCELL_TYPES 0\n", "CELLS 1 4\n3 0 1 2\nCELL_TYPES 1\n5\n",
                                       "CELLS 1 7\n6 0 1 2 3 4 5\nCELL_TYPES 1\n41\n",
                                       "CELLS 2 12\n6 0 1 2 3 4 5\n4 0 1 2 3\nCELL_TYPES 2\n41\n10\n"};
  static const char *const reasons[4] = {"has no volume cells", "has no volume cells",
                                         "riis does not know the edges of 1 of 1 volume cell",
                                         "riis does not know the edges of 1 of 2 volume cells"};
  for (int i = 0; i < 4; ++i) {
    char text[512];
    snprintf(text, sizeof text,
             "# vtk DataFile Version 3.0\nx\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 6 double\n"
             "0 0 0.5 1 0 0.5 0 1 0.5 0 0 1 1 1 1 1.2 1.3 1.5\n%s",
             cells[i]);
    scratch_write_text("other.vtk", text);
    expect_unknown("other.vtk", "50,0,0", 3, reasons[i]);
    if (i < 3)
      RUN_REFUSED(2, reasons[i], "check", "leaks", scratch_path("other.vtk"), "--translate", "50,0,0", "--allow-none",
                  "--between", "0.1,0,0.6", "0,0.1,0.6");
  }
  /* A tetrahedron joins its nodes, even if the edges of another cell are unknown. A tetrahedron does not join nodes of other
   * cells. */
  run_program("check", "leaks", scratch_path("other.vtk"), "--translate", "50,0,0", "--allow-none", "--between",
              "0.1,0,0.6", "0,0.1,0.6", NULL);
  assert_non_null(strstr(program_out, "\npassage   open: at "));
  scratch_write_text("two.vtk",
                     "# vtk DataFile Version 3.0\nx\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 9 double\n"
                     "0 0 0.5 1 0 0.5 0 1 0.5 0 0 1 5 0 0.5 6 0 0.5 5 1 0.5 5 0 1 4 4 4\n"
                     "CELLS 3 16\n4 0 1 2 3\n4 4 5 6 7\n5 0 1 5 7 8\nCELL_TYPES 3\n10\n10\n41\n");
  run_program("check", "leaks", scratch_path("two.vtk"), "--translate", "50,0,0", "--allow-none", "--stats",
              scratch_path("stats.json"), "--between", "0.1,0,0.6", "5.1,0,0.6", NULL);
  assert_int_equal(program_exit_code, 0);
  assert_non_null(
      strstr(program_err,
             "riis: whether unmarked nodes join 0.1 0 0.6 and 5.1 0 0.6 is unknown: riis does not know the edges "
             "of 1 of 3 volume cells in "));
  assert_non_null(strstr(program_out, "\npassage   unknown; along the known edges none, because "));
  char *json = scratch_read(scratch_path("stats.json"), NULL);
  assert_true(json_has_text(json, "state", "\"unknown\""));
  free(json);
}

int main(void) { return run_cases(scratch_setup, scratch_teardown); }
