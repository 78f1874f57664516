/* SPDX-License-Identifier: Apache-2.0
 *
 * Compares `riis check leaks` with two points with the passage of the C interface. The mesh is a box inside the valve's annulus,
 * so no path leads round the valve. */
#include <math.h>
#include <riis/riis_vtk.h>
#include <stdlib.h>
#include <string.h>

#include "calls.h"
#include "expect.h"
#include "program.h"
#include "scratch.h"
#include "vtk_shim.h"

static const double below[3] = {0.01, 0, -1.2}, above[3] = {0, 0.02, 0.9};
static const double median_edge = 0.0958; /* the edges of the box are 0.067 to 0.135 long */
#define ENDS "0.01,0,-1.2", "0,0.02,0.9"
#define SEALED "--set", "leaflet_radius_in=0.02"

static int write_box(void **state) {
  const double lower[3] = {-0.8, -0.8, -1.3}, upper[3] = {0.8, 0.8, 1};
  const int failed = scratch_setup(state);
  return failed || shim_write_box(scratch_path("box.vtu"), SHIM_RAW, 25, lower, upper, 0) != 1;
}

static int64_t nearest(int64_t n, const double *xyz, const double *point) {
  int64_t found = 0;
  double least = INFINITY;
  for (int64_t i = 0; i < n; ++i) {
    const double *p = xyz + 3 * i, d = hypot(hypot(p[0] - point[0], p[1] - point[1]), p[2] - point[2]);
    if (d < least) least = d, found = i;
  }
  return found;
}

/* Returns the library's passage for the default valve. */
static riis_passage passage_by_c(void) {
  riis_vtk_mesh *file = NULL;
  riis_adjacency *adjacency = NULL;
  riis_mesh *mesh = NULL;
  riis_valve *valve = NULL;
  riis_surface *surface = NULL;
  riis_csr csr;
  riis_passage passage;
  int64_t n = 0;
  const double *xyz = NULL;
  expect_fine(riis_valve_create("aortic", &valve));
  expect_fine(riis_surface_create(valve, NULL, &surface));
  expect_fine(riis_vtk_mesh_read(scratch_path("box.vtu"), &file));
  expect_fine(riis_vtk_mesh_get_nodes(file, &n, NULL, &xyz));
  expect_fine(riis_vtk_mesh_create_adjacency(file, 0, &adjacency));
  expect_fine(riis_adjacency_get_csr(adjacency, &csr, sizeof csr));
  expect_fine(riis_mesh_create(n, xyz, xyz + 1, xyz + 2, 3, &mesh));
  expect_fine(riis_mesh_set_adjacency(mesh, &csr));
  const int64_t from = nearest(n, xyz, below), to = nearest(n, xyz, above);
  expect_fine(find_passage_between(surface, mesh, NULL, 1, &from, 1, &to, &passage, sizeof passage));
  riis_mesh_destroy(&mesh);
  riis_adjacency_destroy(&adjacency);
  riis_vtk_mesh_destroy(&file);
  riis_surface_destroy(&surface);
  riis_valve_destroy(&valve);
  return passage;
}

/* The advised command works as printed. */
TEST(test_open_valve) {
  const riis_passage passage = passage_by_c();
  RUN_FINE("check", "leaks", scratch_path("box.vtu"), "--between", ENDS, "--stats", "-");
  assert_true(json_has_text(program_out, "state", "\"open\""));
  assert_true(json_number(program_out, "node_id") == (double)passage.node_id);
  assert_true(json_number(strstr(program_out, "passage"), "distance") == passage.distance);
  char typed[32] = {0};
  const char *const expected =
      "riis: the surface leaks: unmarked nodes join 0.01 0 -1.2 and 0 0.02 0.9; the passage is at ";
  assert_int_equal(strncmp(program_leaks, expected, strlen(expected)), 0);
  expect_place(program_leaks + strlen(expected), passage.point, median_edge, ", and --half-thickness ");
  assert_int_equal(sscanf(strstr(program_leaks, "--half-thickness ") + 17, "%31s", typed), 1);
  assert_true(strtod(typed, NULL) >= passage.distance && strtod(typed, NULL) < 1.2 * passage.distance);
  RUN_FINE("check", "leaks", scratch_path("box.vtu"), "--between", ENDS, "--half-thickness", typed);
  assert_string_equal(program_leaks, "");
  assert_non_null(strstr(program_out, "\npassage   closed: at "));
}

/* As in riis mark --cells, the nodes are the centres of the cells. The leaks are the same, and only the open valve has a
 * passage. */
TEST(test_centres) {
  const char *const openings[] = {"0", "1"};
  for (int i = 0; i < 2; ++i) {
    run_program("mark", scratch_path("box.vtu"), "--cells", "--valve", "trileaflet", "--opening", openings[i],
                "--stats", "-", NULL);
    assert_int_equal(program_exit_code, 0);
    const double n_marked = json_number(program_out, "n_marked"), n_leaks = json_number(program_out, "n_leaking_edges");
    run_program("check", "leaks", scratch_path("box.vtu"), "--cells", "--between", ENDS, "--valve", "trileaflet",
                "--opening", openings[i], "--stats", "-", NULL);
    assert_int_equal(program_exit_code, 0);
    assert_true(n_marked > 100 && json_number(program_out, "n_marked") == n_marked);
    assert_true(json_number(program_out, "n_leaking_edges") == n_leaks);
    assert_true(json_has_text(strstr(program_out, "\"passage\""), "state", i == 0 ? "\"closed\"" : "\"open\""));
  }
}

/* The measures of valve and mesh equal results of the library's calls. */
TEST(test_flow) {
  RUN_FINE("check", "leaks", scratch_path("box.vtu"), "--between", ENDS, "--valve", "trileaflet", "--opening", "0",
           "--first-passage", "--resistance", "500", "--drop", "20", "--stats", "-");
  const char *const orifice = strstr(program_out, "\"orifice\""),
                    *const cells = strstr(program_out, "\"cells_across\""),
                    *const first = strstr(program_out, "\"first_passage\"");
  assert_true(orifice && cells && first);
  riis_valve *valve = NULL;
  riis_surface *surface = NULL;
  riis_orifice expected;
  riis_resistance how;
  double flow = 0;
  expect_fine(riis_valve_create("trileaflet", &valve));
  expect_fine(riis_surface_create(valve, NULL, &surface));
  expect_fine(riis_surface_get_orifice(surface, NULL, &expected, sizeof expected));
  expect_fine(riis_resistance_init(&how, sizeof how));
  how.R = 500;
  expect_fine(riis_surface_get_leak(surface, &how, 1, &flow));
  riis_surface_destroy(&surface);
  riis_valve_destroy(&valve);
  assert_true(fabs(json_number(orifice, "area") - expected.area) <= 1e-12);
  assert_true(fabs(json_number(orifice, "effective_area") - expected.effective_area) <= 1e-12);
  /* The leak flows through the closed area. The box contains only the middle of the leaflets. */
  const double closed_area = json_number(program_out, "closed_area"), area = flow * 500 / 0.1;
  assert_true(closed_area > 0.2 * area && closed_area < area);
  assert_true(fabs(json_number(program_out, "leak") - 20 * 0.1 / 500 * closed_area) <= 1e-12);
  const double half_thickness = json_number(program_out, "half_thickness");
  assert_true(fabs(json_number(cells, "mean") * json_number(cells, "mean_edge") - 2 * half_thickness) <= 1e-12);
  assert_true(json_number(cells, "least") <= json_number(cells, "mean") && json_number(cells, "n_edges") > 0);
  assert_true(json_has_text(first, "state", "\"found\""));
  char typed[32];
  snprintf(typed, sizeof typed, "%.17g", json_number(first, "opening"));
  RUN_FINE("check", "leaks", scratch_path("box.vtu"), "--between", ENDS, "--valve", "trileaflet", "--opening", typed);
  assert_non_null(strstr(program_out, "\npassage   open: at "));
  assert_non_null(strstr(program_out, "\nacross    "));
  assert_non_null(strstr(program_out, "\norifice   "));
  assert_null(strstr(program_out, "\nopens     "));
  RUN_REFUSED(2, "--first-passage requires --between", "check", "leaks", scratch_path("box.vtu"), "--first-passage");
  RUN_REFUSED(2, "--drop requires --resistance", "check", "leaks", scratch_path("box.vtu"), "--drop", "2");
  RUN_REFUSED(2, "--resistance requires --drop", "check", "leaks", scratch_path("box.vtu"), "--resistance", "2");
  RUN_REFUSED(2, "--resistance: 0 is not above 0", "check", "leaks", scratch_path("box.vtu"), "--resistance", "0",
              "--drop", "2");
  RUN_REFUSED(2, "--drop: '75 mmHg' has a unit, but the unit of the mesh is not known: write --unit m, cm or mm",
              "check", "leaks", scratch_path("box.vtu"), "--resistance", "1", "--drop", "75 mmHg");
  RUN_REFUSED(2, "--drop: 'kg/(m s)' is not a unit of a pressure, such as Pa", "check", "leaks",
              scratch_path("box.vtu"), "--unit", "cm", "--resistance", "1", "--drop", "75 kg/(m s)");
  RUN_REFUSED(2, "--drop: 'x'", "check", "leaks", scratch_path("box.vtu"), "--resistance", "1", "--drop", "x");
}

TEST(test_closed_valve) {
  RUN_FINE("check", "leaks", scratch_path("box.vtu"), "--between", ENDS, SEALED);
  assert_string_equal(program_leaks, "");
  assert_non_null(strstr(program_out, "\npassage   closed: at "));
  RUN_FINE("check", "leaks", scratch_path("box.vtu"), "--between", ENDS, SEALED, "--demand-sealed");
  RUN_FINE("mark", scratch_path("box.vtu"), SEALED);
  assert_null(strstr(program_out, "passage"));
}

/* An open valve has a passage, and the program advises no half thickness to close this passage. */
TEST(test_passage_through_an_open_valve) {
  RUN_FINE("check", "leaks", scratch_path("box.vtu"), "--between", ENDS, "--valve", "trileaflet", "--opening", "1");
  assert_int_equal(
      strncmp(program_leaks, "riis: the valve is open, at opening 1: unmarked nodes join 0.01 0 -1.2 and ", 75), 0);
  assert_null(strstr(program_leaks, "--half-thickness"));
  run_program("check", "leaks", scratch_path("box.vtu"), "--between", ENDS, "--valve", "trileaflet", "--opening", "1",
              "--demand-sealed", NULL);
  assert_int_equal(program_exit_code, 4);
}

/* An end of the path is nearer to the surface than the rest of the passage. */
TEST(test_end_is_the_narrowest_place) {
  RUN_FINE("check", "leaks", scratch_path("box.vtu"), "--between", "0,0,-1.2", "0.5,0,-0.1");
  assert_non_null(strstr(program_leaks,
                         "the passage is wide everywhere: no place on it is nearer to the surface than "
                         "its end at "));
  assert_non_null(
      strstr(program_leaks,
             " from it. Either the points are beside the surface, or the surface does not stand between the "
             "points: give points on both sides, farther away\n"));
  assert_null(strstr(program_leaks, "--half-thickness"));
}

TEST(test_what_is_refused) {
  const char *box = scratch_path("box.vtu");
#define REFUSED(text, ...) RUN_REFUSED(2, text, "check", "leaks", box, "--between", __VA_ARGS__)
  REFUSED("--between: FROM, 9 0 0, is outside the mesh, which goes from -0.8 -0.8 -1.3 to 0.8 0.8 1", "9,0,0",
          "0,0,0.9");
  REFUSED("--between: TO, 0 0 -1.4, is outside the mesh", "0,0,0.9", "0,0,-1.4");
  REFUSED("--between: TO, 0 0 0, is node ", "0,0,0.9", "0,0,0", SEALED);
  REFUSED(", in the band: its distance to the surface, ", "0,0,0.9", "0,0,0", SEALED);
  REFUSED("--between", "0,0", "0,0,-1.4");
  REFUSED("--between", "0,0,x", "0,0,-1.4");
  RUN_REFUSED(2, "--between", "check", "leaks", box, "--between", "0,0,0.9");
  RUN_REFUSED(2, "MESH is required", "check", "leaks");
}

/* The mesh has two pieces. A point between the pieces is in the mesh's bounding box, but far from every node. */
TEST(test_pieces) {
  scratch_write_text("pieces.vtk",
                     "# vtk DataFile Version 3.0\ntwo\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 8 double\n"
                     "0 0 0.5 1 0 0.5 0 1 0.5 0 0 1 0 0 9 1 0 9 0 1 9 0 0 8\n"
                     "CELLS 2 10\n4 0 1 2 3\n4 4 5 6 7\nCELL_TYPES 2\n10 10\n");
  scratch_write_text("one.stl",
                     "solid x\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\n"
                     "endloop\nendfacet\nendsolid\n");
  run_program("check", "leaks", scratch_path("pieces.vtk"), "--surface", scratch_path("one.stl"), "--allow-none",
              "--between", "0.1,0,0.6", "0,0,8.5", NULL);
  assert_int_equal(program_exit_code, 0);
  assert_non_null(strstr(program_err, "nothing to seal: the mesh itself does not join 0.1 0 0.6 and 0 0 8.5\n"));
  assert_non_null(strstr(program_out, "\npassage   none, because the mesh itself does not connect the two points\n"));
  RUN_REFUSED(2, "--between: FROM, 0 0 4, is outside the mesh: the nearest node, 3, is 3 away", "check", "leaks",
              scratch_path("pieces.vtk"), "--surface", scratch_path("one.stl"), "--allow-none", "--between", "0,0,4",
              "0,0,8.5");
}

/* Reads area, effective area, half thicknesses and perimeter from the line "orifice WORDS". Compares the numbers. */
static void expect_orifice(const char *words, const riis_orifice *expected) {
  char line[80];
  snprintf(line, sizeof line, "\norifice   %s", words);
  const char *const found = strstr(program_out, line);
  if (!found) fail_msg("no line '%s' in: %s", words, program_out);
  double area = -1, effective = -1, reach = -1, perimeter = -1;
  assert_int_equal(sscanf(found + strlen(line),
                          "%lf open, %lf effective: the band takes %lf half thicknesses along a perimeter of %lf",
                          &area, &effective, &reach, &perimeter),
                   4);
  assert_true(expected->area > 0.1 && expected->effective_area > 0 && expected->effective_area < expected->area);
  assert_true(fabs(area - expected->area) <= 1e-5 * expected->area);
  assert_true(fabs(effective - expected->effective_area) <= 1e-5 * expected->effective_area);
  assert_true(fabs(reach - expected->rim_reach) <= 1e-5);
  assert_true(fabs(perimeter - expected->perimeter) <= 1e-5 * expected->perimeter);
}

/* Measures the orifice of a kind of valve. */
static riis_orifice orifice_by_c(const char *kind, double opening, double half_thickness) {
  riis_valve *valve = NULL;
  riis_surface *surface = NULL;
  riis_surface_options options;
  riis_orifice orifice;
  expect_fine(riis_surface_options_init(&options, sizeof options));
  options.half_thickness = half_thickness;
  expect_fine(riis_valve_create(kind, &valve));
  expect_fine(riis_valve_set_scalar(valve, "opening", opening));
  expect_fine(riis_surface_create(valve, &options, &surface));
  expect_fine(riis_surface_get_orifice(surface, NULL, &orifice, sizeof orifice));
  riis_surface_destroy(&surface);
  riis_valve_destroy(&valve);
  return orifice;
}

/* Reads the mean number of mesh edges across the band of a valve. The line begins with the given words. */
static double across_of(const char *words) {
  char line[80];
  double mean = -1;
  snprintf(line, sizeof line, "\nacross    %s", words);
  const char *const found = strstr(program_out, line);
  if (!found) fail_msg("no line '%s' in: %s", words, program_out);
  assert_int_equal(sscanf(found + strlen(line), "%lf mesh edges of mean length in the band", &mean), 1);
  return mean;
}

/* Two valves stand in a row. Each valve alone closes the passage. */
TEST(test_cases) {
  scratch_write_text("one.json",
                     "{\"mesh\": \"box.vtu\", \"check_leaks\": [0.01,0,-1.2, 0,0.02,0.9],\n"
                     " \"valves\": [{\"valve\": \"aortic\"}]}\n");
  RUN_FINE("mark", "--case", scratch_path("one.json"));
  assert_non_null(strstr(program_leaks, "riis: the surface leaks: unmarked nodes join"));
  assert_non_null(strstr(program_out, "\npassage   open: at "));
  scratch_write_text(
      "two.json",
      "{\"mesh\": \"box.vtu\", \"check_leaks\": [0.01,0,-1.2, 0,0.02,0.9],\n"
      " \"valves\": [{\"name\": \"open\", \"valve\": \"aortic\", \"translate\": [0, 0, 0.3]},\n"
      "  {\"name\": \"closed\", \"valve\": \"aortic\", \"parameters\": {\"leaflet_radius_in\": 0.02}}]}\n");
  RUN_FINE("mark", "--case", scratch_path("two.json"));
  assert_string_equal(program_leaks, "");
  assert_non_null(strstr(program_out, "\npassage   closed: at "));
  scratch_write_text("outside.json",
                     "{\"mesh\": \"box.vtu\", \"check_leaks\": [9,0,0, 0,0.02,0.9],\n"
                     " \"valves\": [{\"valve\": \"aortic\"}]}\n");
  RUN_REFUSED(1, "outside.json: check_leaks: FROM, 9 0 0, is outside the mesh", "mark", "--case",
              scratch_path("outside.json"));
  scratch_write_text("unequal.json",
                     "{\"mesh\": \"box.vtu\", \"check_leaks\": [0.01,0,-1.2, 0,0.02,0.9],\n"
                     " \"valves\": [{\"name\": \"a\", \"valve\": \"aortic\", \"half_thickness\": 0.2},\n"
                     "  {\"name\": \"b\", \"valve\": \"aortic\"}]}\n");
  run_program("mark", "--case", scratch_path("unequal.json"), NULL);
  assert_int_equal(program_exit_code, 1);
  assert_non_null(strstr(program_err, "the valves must have one half thickness; that of a is 0.2, that of b 0.1"));
}

/* For a series, the check uses the time at which the valve is least open. */
TEST(test_series) {
  scratch_write_text("beat.csv", "0,0.5\n1,0\n2,1\n");
  scratch_write_text("series.json",
                     "{\"mesh\": \"box.vtu\", \"check_leaks\": [0.01,0,-1.2, 0,0.02,0.9], \"times\": \"0:2:0.5\",\n"
                     " \"valves\": [{\"valve\": \"aortic\", \"parameters\": {\"leaflet_radius_in\": 0.02},\n"
                     "  \"open_parameters\": {\"leaflet_radius_in\": 0.8}, \"opening\": {\"file\": \"beat.csv\"}}]}\n");
  RUN_FINE("mark", "--case", scratch_path("series.json"), "--series-table", scratch_path("table.csv"));
  assert_string_equal(program_leaks, "");
  assert_non_null(strstr(program_out, "\npassage   closed: at "));
}

/* With two points, each valve of a case has separate lines, with the numbers that the valve has alone. */
TEST(test_flow_of_several_valves) {
#define TWO_POINTS "{\"mesh\": \"box.vtu\", \"check_leaks\": [0.01,0,-1.2, 0,0.02,0.9], \"half_thickness\": 0.09,\n"
  scratch_write_text("flows.json", TWO_POINTS
                     " \"valves\": [{\"name\": \"left\", \"valve\": \"trileaflet\", \"opening\": 0.75},\n"
                     "  {\"name\": \"right\", \"valve\": \"bileaflet\", \"opening\": 0.25}]}\n");
  RUN_FINE("mark", "--case", scratch_path("flows.json"));
  const riis_orifice left = orifice_by_c("trileaflet", 0.75, 0.09), right = orifice_by_c("bileaflet", 0.25, 0.09);
  expect_orifice("left, opening 0.75: ", &left);
  expect_orifice("right, opening 0.25: ", &right);
  const double across[2] = {across_of("left: "), across_of("right: ")};
  const char *const kinds[2] = {"trileaflet", "bileaflet"}, *const openings[2] = {"0.75", "0.25"};
  for (int i = 0; i < 2; ++i) {
    RUN_FINE("check", "leaks", scratch_path("box.vtu"), "--valve", kinds[i], "--opening", openings[i],
             "--half-thickness", "0.09");
    assert_true(across_of("") == across[i]);
    expect_orifice("", i ? &right : &left);
  }
  /* In a series, the band is measured at the least opening, and the orifice at the largest. */
  scratch_write_text("rises.csv", "0,0.5\n1,0\n2,0.75\n");
  scratch_write_text("falls.csv", "0,0.25\n1,0.125\n2,0\n");
  scratch_write_text(
      "flow_series.json", TWO_POINTS
      " \"times\": \"0:2:1\",\n"
      " \"valves\": [{\"name\": \"left\", \"valve\": \"trileaflet\", \"opening\": {\"file\": \"rises.csv\"}},\n"
      "  {\"name\": \"right\", \"valve\": \"bileaflet\", \"opening\": {\"file\": \"falls.csv\"}}]}\n");
  RUN_FINE("mark", "--case", scratch_path("flow_series.json"), "--series-table", scratch_path("flow_table.csv"));
  expect_orifice("left, opening 0.75: ", &left);
  expect_orifice("right, opening 0.25: ", &right);
  const double closed[2] = {across_of("left: "), across_of("right: ")};
  for (int i = 0; i < 2; ++i) {
    RUN_FINE("check", "leaks", scratch_path("box.vtu"), "--valve", kinds[i], "--opening", "0", "--half-thickness",
             "0.09");
    assert_true(across_of("") == closed[i]);
  }
  /* The lines of a case with one valve are those of the valve alone. Without points nothing is measured. */
  scratch_write_text("flow_one.json", TWO_POINTS " \"valves\": [{\"valve\": \"trileaflet\", \"opening\": 0.75}]}\n");
  RUN_FINE("mark", "--case", scratch_path("flow_one.json"));
  expect_orifice("", &left);
  assert_true(across_of("") == across[0]);
  scratch_write_text("no_points.json", "{\"mesh\": \"box.vtu\", \"valves\": [{\"valve\": \"trileaflet\"}]}\n");
  RUN_FINE("mark", "--case", scratch_path("no_points.json"));
  assert_null(strstr(program_out, "orifice"));
  assert_null(strstr(program_out, "across"));
}

/* Returns the closed area of plates at these heights in the box. The plates reach beyond the box, whose section is 1.6 x 1.6. */
static double closed_area_of_plates(int n, const double *heights, const char *half_thickness) {
  char text[1024] = "";
  for (int i = 0; i < n; ++i) {
    const double z = heights[i];
    const int at = 4 * i;
    snprintf(text + strlen(text), sizeof text - strlen(text),
             "v -1 -1 %.17g\nv 1 -1 %.17g\nv 1 1 %.17g\nv -1 1 %.17g\nf %d %d %d\nf %d %d %d\n", z, z, z, z, at + 1,
             at + 2, at + 3, at + 1, at + 3, at + 4);
  }
  scratch_write_text("plates.obj", text);
  RUN_FINE("check", "leaks", scratch_path("box.vtu"), "--between", ENDS, "--surface", scratch_path("plates.obj"),
           "--leaflets", "connected", "--half-thickness", half_thickness, "--stats", "-");
  return json_number(program_out, "closed_area");
}

/* A plate closes its own area of the mesh. Two plates in one place close the area of one. If the plates are farther apart, the
 * integral of K between them gives the share of the second plate that counts. From a distance of two half thicknesses on, the
 * second plate counts fully. */
TEST(test_closed_area_of_plates) {
  const double one = 1.6 * 1.6, eps = 0.15, pi = acos(-1.0);
  for (int i = 0; i < 5; ++i) {
    const double gap = (const double[]){0, 1e-6, 0.05, 0.12, 0.35}[i], heights[2] = {-0.1, -0.1 + gap};
    const double share = gap < 2 * eps ? gap / (2 * eps) + sin(pi * gap / (2 * eps)) / pi : 1;
    const double found = closed_area_of_plates(i == 0 ? 1 : 2, heights, "0.15");
    if (fabs(found / (one * (1 + share)) - 1) > 5e-3)
      fail_msg("gap %g: area %.6g for %.6g", gap, found, one * (1 + share));
  }
}

/* Where two leaflets touch or are closer than half of a half thickness, only one of them counts. Half of the area of coaptation
 * therefore does not count. The half tube around the free edges also counts. The tube's width is 0.467 half thicknesses, which is
 * the integral of K across the tube over R / eps. */
TEST(test_closed_area_of_a_coaptation) {
  const double lower[3] = {-1.7, -1.7, -1.3}, upper[3] = {1.7, 1.7, 2.3};
  assert_int_equal(shim_write_box(scratch_path("wide.vtu"), SHIM_RAW, 32, lower, upper, 0), 1);
  static const char *const kinds[2] = {"coapting", "mitral_coapting"};
  for (int i = 0; i < 2; ++i) {
    riis_valve *valve = NULL;
    riis_surface *surface = NULL;
    riis_surface_info info;
    riis_coaptation contact;
    riis_attachment attachment;
    expect_fine(riis_valve_create(kinds[i], &valve));
    expect_fine(riis_surface_create(valve, NULL, &surface));
    expect_fine(riis_surface_get_info(surface, &info, sizeof info));
    expect_fine(
        riis_surface_get_coaptation(surface, info.half_thickness / 2, RIIS_ALL_LEAFLETS, &contact, sizeof contact));
    expect_fine(riis_surface_get_attachment(surface, &attachment, sizeof attachment));
    double rim = contact.edge / 2;
    for (int64_t e = 0; e < attachment.n_edges; ++e) {
      const double *p = attachment.edges + 6 * e;
      rim += hypot(hypot(p[3] - p[0], p[4] - p[1]), p[5] - p[2]);
    }
    const double expected = info.area - contact.area / 2 + 0.467 * info.half_thickness * rim;
    riis_surface_destroy(&surface);
    riis_valve_destroy(&valve);
    RUN_FINE("mark", scratch_path("wide.vtu"), "--valve", kinds[i], "--opening", "0", "--stats", "-");
    const double found = json_number(program_out, "closed_area");
    if (fabs(found / expected - 1) > 0.03 || contact.area / 2 < 0.06 * expected)
      fail_msg("%s: %g, expected %g, contact %g", kinds[i], found, expected, contact.area);
  }
}

int main(void) { return run_cases(write_box, scratch_teardown); }
