/* SPDX-License-Identifier: Apache-2.0
 *
 * --case reads several valves from a file. The output of the example has the arrays of single runs with equal options, and their
 * sums over the valves. */
#include <math.h>
#include <riis/riis.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "expect.h"
#include "program.h"
#include "scratch.h"
#include "vtk_shim.h"

enum { n_side = 31, n_nodes = n_side * n_side * n_side };
static const char *const example = RIIS_EXAMPLES "/beating_valves.json";

static int64_t read_array(const char *path, const char *name, double *values) {
  int64_t n_components = 0, n_tuples = 0;
  if (!shim_read_array(path, 'p', name, NULL, &n_components, &n_tuples, NULL)) fail_msg("%s lacks %s", path, name);
  assert_true(n_components * n_tuples <= 3 * n_nodes);
  shim_read_array(path, 'p', name, NULL, NULL, NULL, values);
  return n_components * n_tuples;
}

static int has_array(const char *path, const char *name) {
  return shim_read_array(path, 'p', name, NULL, NULL, NULL, NULL);
}

/* Compares an array of the written part of the mesh with the array of a single run, at the part's nodes. */
static void expect_same_array(const char *part, const char *single, const char *name) {
  static double ids[n_nodes], values[3 * n_nodes], whole[3 * n_nodes];
  const int64_t n = read_array(part, "riis_node_id", ids);
  const int64_t n_components = read_array(single, name, whole) / n_nodes;
  assert_int_equal(read_array(part, name, values), n_components * n);
  for (int64_t i = 0; i < n; ++i)
    assert_memory_equal(values + n_components * i, whole + n_components * (int64_t)ids[i],
                        (size_t)n_components * sizeof *values);
}

/* The mitral valve of the example opens as the library's law says. */
TEST(test_ramps) {
  riis_opening_times ramps;
  double opening = 0, time = 0, found = 0;
  expect_fine(riis_opening_times_init(&ramps, sizeof ramps));
  ramps.opening_start = 0.4;
  ramps.opening_duration = ramps.closing_duration = 0.06;
  ramps.closing_start = 0.72;
  ramps.period = 0.8;
  expect_fine(riis_opening_from_times(&ramps, 0.44, &opening, NULL));
  assert_true(opening > 0.5 && opening < 1);
  RUN_FINE("mark", scratch_path("heart.vtu"), "--case", example, "--times", "0.44,1.24", "--series-table",
           scratch_path("ramps.csv"), "--quiet");
  char *table = scratch_read(scratch_path("ramps.csv"), NULL);
  for (int i = 0; i < 2; ++i) {
    assert_int_equal(sscanf(strstr(table, i ? "\n1.24," : "\n0.44,"), "\n%lf,%lf", &time, &found), 2);
    assert_true(fabs(found - opening) < 1e-12);
  }
  free(table);
}

/* Tests the example at the times 0.44 and 0.3. At 0.44 the mitral valve opens, and the aortic valve is closed. At 0.3
 * the aortic valve closes. */
TEST(test_example) {
  static double K[n_nodes], of_mitral[n_nodes], of_aortic[n_nodes], ids[n_nodes], momentum[3 * n_nodes];
  static double u[2][3 * n_nodes];
  const char *mesh = scratch_path("heart.vtu");
  RUN_FINE("mark", mesh, "--case", example, "--times", "0.27,0.3,0.44", "--output", scratch_path("c.pvd"),
           "--series-table", scratch_path("c.csv"), "--surface-output", scratch_path("cs.pvd"), "--quiet");
  /* The mesh is too coarse for the closed valves, and the warning names them. */
  assert_non_null(strstr(program_leaks, "riis: the surface of mitral leaks: "));
  assert_non_null(strstr(program_leaks, "riis: the surface of aortic leaks: "));
  char *table = scratch_read(scratch_path("c.csv"), NULL);
  double row[8];
  assert_int_equal(strncmp(table,
                           "time,mitral_opening,mitral_n_marked,mitral_largest_speed,aortic_opening,"
                           "aortic_n_marked,aortic_largest_speed,seconds\n0.27,0,",
                           117),
                   0);
  const char *line = strstr(table, "\n0.3,");
  assert_non_null(line);
  assert_int_equal(sscanf(line, "%lf,%lf,%lf,%lf,%lf,%lf,%lf,%lf", row, row + 1, row + 2, row + 3, row + 4, row + 5,
                          row + 6, row + 7),
                   8);
  assert_true(row[1] == 0 && row[3] == 0 && fabs(row[4] - 0.5) < 1e-12 && row[5] > 20 && row[6] > 1);
  free(table);
  /* Marks the valves of the case one by one, with options instead of the file. */
  scratch_write_text("open.json", "{\"leaflet_radius_in\": 1, \"bending_radius_in\": 1.1}");
  RUN_FINE("mark", mesh, "--unit", "cm", "--half-thickness", "0.1", "--valve", "mitral", "--opening", "0",
           "--resistance", "10000", "--prefix", "mitral", "--output", scratch_path("m.vtu"), "--quiet");
  RUN_FINE("mark", mesh, "--unit", "cm", "--half-thickness", "0.1", "--valve", "aortic", "--params-open",
           scratch_path("open.json"), "--opening", "0.5", "--rotate", "1,0,0,-30", "--translate", "0,3.8,1",
           "--resistance", "20000", "--prefix", "aortic", "--output", scratch_path("a.vtu"), "--quiet");
  const char *part = scratch_path("c/c_0001.vtu");
  expect_same_array(part, scratch_path("m.vtu"), "mitral_marked");
  expect_same_array(part, scratch_path("m.vtu"), "mitral_distance");
  expect_same_array(part, scratch_path("m.vtu"), "mitral_leaflet");
  expect_same_array(part, scratch_path("a.vtu"), "aortic_marked");
  expect_same_array(part, scratch_path("a.vtu"), "aortic_leaflet");
  assert_false(has_array(part, "mitral_K"));
  /* K is the sum over the valves, and K_u_surface is the sum of K u. */
  const int64_t n = read_array(part, "riis_node_id", ids);
  read_array(part, "riis_K", K);
  read_array(part, "riis_K_u_surface", momentum);
  read_array(scratch_path("m.vtu"), "mitral_K", of_mitral);
  read_array(scratch_path("a.vtu"), "aortic_K", of_aortic);
  read_array(part, "mitral_velocity", u[0]);
  read_array(part, "aortic_velocity", u[1]);
  int n_resisting = 0, n_moving = 0;
  for (int64_t i = 0; i < n; ++i) {
    const int64_t node = (int64_t)ids[i];
    /* The cubic table gives 0.5 up to rounding. */
    assert_true(fabs(K[i] - (of_mitral[node] + of_aortic[node])) <= 1e-9 * K[i]);
    n_resisting += K[i] > 0;
    for (int k = 0; k < 3; ++k) {
      const double expected = of_mitral[node] * u[0][3 * i + k] + of_aortic[node] * u[1][3 * i + k];
      assert_true(fabs(momentum[3 * i + k] - expected) <= 1e-9 * (1 + fabs(expected)));
      n_moving += expected != 0;
    }
  }
  assert_true(n_resisting > 50 && n_moving > 50);
  assert_true(scratch_exists("cs/cs_mitral_0002.vtp") && scratch_exists("cs/cs_aortic_0002.vtp"));
  char *list = scratch_read(scratch_path("cs.pvd"), NULL);
  assert_non_null(strstr(list, "<DataSet timestep=\"0.3\" part=\"1\" file=\"cs/cs_aortic_0001.vtp\"/>"));
  free(list);
}

static void write_case(const char *valves, const char *rest) {
  char text[4096];
  snprintf(text, sizeof text, "{\"mesh\": \"in.vtu\", \"half_thickness\": 0.3, %s \"valves\": [%s]}", rest, valves);
  scratch_write_text("case.json", text);
}

/* Without times, the output is one mesh with the arrays of all valves. The program finds the mesh in the folder of the case. */
TEST(test_one_time) {
  static double K[n_nodes], one[n_nodes], two[n_nodes];
  const char *out = scratch_path("one.vtu");
  scratch_write_text("more.json", "{\"leaflet_radius_in\": 0.6}");
  write_case(
      "{\"name\": \"a\", \"valve\": \"mitral\", \"opening\": 0.25, \"resistance\": 5},"
      "{\"name\": \"b\", \"valve\": \"aortic\", \"translate\": [0, 0, 1], \"half_thickness\": 0.4,"
      "\"parameters\": \"more.json\"}",
      "\"resistance\": 3,");
  RUN_FINE("mark", "--case", scratch_path("case.json"), "--output", out, "--surface-output", scratch_path("one.vtp"));
  assert_non_null(strstr(program_out, "surface   a: mitral valve, opening 0.25: "));
  assert_non_null(strstr(program_out, "\nleaks     b: "));
  RUN_FINE("mark", scratch_path("in.vtu"), "--valve", "mitral", "--half-thickness", "0.3", "--opening", "0.25",
           "--resistance", "5", "--prefix", "a", "--output", scratch_path("a1.vtu"), "--quiet");
  RUN_FINE("mark", scratch_path("a1.vtu"), "--valve", "aortic", "--half-thickness", "0.4", "--translate", "0,0,1",
           "--params", scratch_path("more.json"), "--resistance", "3", "--prefix", "b", "--output",
           scratch_path("b1.vtu"), "--quiet");
  static const char *const names[] = {"a_marked", "a_distance", "a_leaflet", "b_marked", "b_distance", "b_leaflet"};
  for (int k = 0; k < 6; ++k) {
    read_array(out, names[k], one);
    assert_int_equal(read_array(scratch_path("b1.vtu"), names[k], two), n_box);
    assert_memory_equal(one, two, n_box * sizeof *one);
  }
  read_array(out, "riis_K", K);
  read_array(scratch_path("b1.vtu"), "a_K", one);
  read_array(scratch_path("b1.vtu"), "b_K", two);
  int n_both = 0;
  for (int i = 0; i < n_box; ++i) {
    assert_true(K[i] == one[i] + two[i]);
    n_both += one[i] > 0 && two[i] > 0;
  }
  assert_true(n_both > 0);
  assert_false(has_array(out, "riis_K_u_surface"));
}

/* A case has an offset, and a valve may have a different offset. Reversed normals reverse the offset. */
TEST(test_offsets) {
  static double K[n_nodes], one[n_nodes], two[n_nodes], plain[n_nodes];
  const char *out = scratch_path("offsets.vtu");
  write_case(
      "{\"name\": \"a\", \"valve\": \"mitral\", \"opening\": 0.25, \"offset\": -0.4},"
      "{\"name\": \"b\", \"valve\": \"aortic\", \"translate\": [0, 0, 1], \"flip_normals\": true}",
      "\"resistance\": 3, \"offset\": 0.6,");
  RUN_FINE("mark", "--case", scratch_path("case.json"), "--output", out);
  RUN_FINE("mark", scratch_path("in.vtu"), "--valve", "mitral", "--half-thickness", "0.3", "--opening", "0.25",
           "--resistance", "3", "--offset", "-0.4", "--prefix", "a", "--output", scratch_path("a2.vtu"), "--quiet");
  /* This run does not reverse the valve's normals, so the run has the opposite offset. */
  RUN_FINE("mark", scratch_path("a2.vtu"), "--valve", "aortic", "--half-thickness", "0.3", "--translate", "0,0,1",
           "--resistance", "3", "--offset", "-0.6", "--prefix", "b", "--output", scratch_path("b2.vtu"), "--quiet");
  RUN_FINE("mark", scratch_path("in.vtu"), "--valve", "aortic", "--half-thickness", "0.3", "--translate", "0,0,1",
           "--offset", "0.6", "--prefix", "b", "--output", scratch_path("c2.vtu"), "--quiet");
  static const char *const names[] = {"a_marked", "b_marked"};
  int n_marked[2] = {0, 0}, n_moved = 0;
  for (int k = 0; k < 2; ++k) {
    read_array(out, names[k], one);
    assert_int_equal(read_array(scratch_path("b2.vtu"), names[k], two), n_box);
    assert_memory_equal(one, two, n_box * sizeof *one);
    for (int i = 0; i < n_box; ++i) n_marked[k] += one[i] > 0;
  }
  read_array(scratch_path("c2.vtu"), "b_marked", plain);
  for (int i = 0; i < n_box; ++i) n_moved += plain[i] != one[i];
  assert_true(n_marked[0] > 0 && n_marked[1] > 0 && n_moved > 0);
  read_array(out, "riis_K", K);
  read_array(scratch_path("b2.vtu"), "a_K", one);
  read_array(scratch_path("b2.vtu"), "b_K", two);
  for (int i = 0; i < n_box; ++i) assert_true(fabs(K[i] - one[i] - two[i]) <= 1e-11 * 3 / 0.09);
}

static const char *text_of(const char *name) { return scratch_read(scratch_path(name), NULL); }

/* Removes the seconds, which differ from run to run. */
static char *without_seconds(const char *name) {
  char *text = scratch_read(scratch_path(name), NULL), *const begin = strstr(text, "\"seconds\"");
  assert_non_null(begin);
  char *const end = strchr(begin, '}');
  memmove(begin, end, strlen(end) + 1);
  return text;
}

/* A case may have a surface from a file that rests, and valves that move. */
TEST(test_surface_at_rest) {
  static double velocity[3 * n_box], marked[n_box];
  RUN_FINE("surface", "--output", scratch_path("stent.vtp"), "--quiet");
  write_case(
      "{\"name\": \"m\", \"valve\": \"mitral\", \"opening\": {\"file\": \"beat.csv\", \"period\": 1}},"
      "{\"name\": \"stent\", \"surface\": \"stent.vtp\", \"scale\": 1.2}",
      "\"times\": [0, 0.1, 0.2],");
  scratch_write_text("beat.csv", "0,0\n0.2,1\n");
  RUN_FINE("mark", "--case", scratch_path("case.json"), "--output", scratch_path("rest.pvd"), "--all-cells", "--quiet");
  const char *step = scratch_path("rest/rest_0002.vtu");
  int n_still = 0, n_moving = 0;
  read_array(step, "stent_marked", marked);
  read_array(step, "stent_velocity", velocity);
  for (int i = 0; i < n_box; ++i) n_still += marked[i] != 0 && velocity[3 * i] == 0 && velocity[3 * i + 2] == 0;
  for (int i = 0; i < n_box; ++i)
    assert_true(velocity[3 * i] == 0 && velocity[3 * i + 1] == 0 && velocity[3 * i + 2] == 0);
  read_array(step, "m_velocity", velocity);
  for (int i = 0; i < n_box; ++i) n_moving += velocity[3 * i + 2] != 0;
  assert_true(n_still > 20 && n_moving > 20);
}

#define LANDMARKS "[[1, 0, 0], [-1, 0, 0], [0, 1, 0], [0, -1, 0], [0, 0, 1], [0, 0, -1]]"

/* A warp that shifts all landmarks by 0.5 along x acts like a placement with this shift. */
TEST(test_warp) {
  static double one[n_box], two[n_box], velocity[3 * n_box];
  static const char *const shifted =
      "[[1.5, 0, 0], [-0.5, 0, 0], [0.5, 1, 0], [0.5, -1, 0], [0.5, 0, 1], [0.5, 0, -1]]";
  char valve[2048];
  for (int has_open = 0; has_open < 2; ++has_open) {
    char open[512] = "";
    if (has_open) snprintf(open, sizeof open, ", \"open\": {\"sources\": " LANDMARKS ", \"targets\": %s}", shifted);
    snprintf(
        valve, sizeof valve,
        "{\"valve\": \"trileaflet\", \"opening\": 0.4, \"rotate\": [0, 0, 1, 90], \"warp\": {\"sources\": " LANDMARKS
        ", \"targets\": %s, \"noise\": 0.01, \"coordinates\": \"mesh\"%s}}",
        shifted, open);
    write_case(valve, "");
    RUN_FINE("mark", "--case", scratch_path("case.json"), "--output", scratch_path("w.vtu"), "--quiet");
    RUN_FINE("mark", scratch_path("in.vtu"), "--valve", "trileaflet", "--half-thickness", "0.3", "--opening", "0.4",
             "--rotate", "0,0,1,90", "--translate", "0.5,0,0", "--output", scratch_path("w1.vtu"), "--quiet");
    read_array(scratch_path("w.vtu"), "riis_distance", one);
    assert_int_equal(read_array(scratch_path("w1.vtu"), "riis_distance", two), n_box);
    for (int i = 0; i < n_box; ++i) assert_true(fabs(one[i] - two[i]) < 0.02);
  }
  /* With "coordinates" set to "valve", the shift turns with the valve. The valve therefore moves along y. */
  snprintf(valve, sizeof valve,
           "{\"valve\": \"trileaflet\", \"opening\": 0.4, \"rotate\": [0, 0, 1, 90], \"warp\": {\"sources\": " LANDMARKS
           ", \"targets\": [%s, %s, %s], \"times\": [0, 0.2, 0.4], \"period\": 0.4, \"coordinates\": \"valve\"}}",
           LANDMARKS, shifted, LANDMARKS);
  write_case(valve, "\"times\": [0.1, 0.15, 0.7],");
  RUN_FINE("mark", "--case", scratch_path("case.json"), "--output", scratch_path("w.pvd"), "--all-cells", "--quiet");
  for (int step = 1; step < 3; ++step) {
    int n_moving = 0;
    read_array(scratch_path(step == 1 ? "w/w_0001.vtu" : "w/w_0002.vtu"), "riis_marked", one);
    read_array(scratch_path(step == 1 ? "w/w_0001.vtu" : "w/w_0002.vtu"), "riis_velocity", velocity);
    /* The last step is from 0.15 to 0.7, which is 0.3 in the period. The shift therefore goes from 0.375 to 0.25. */
    const double speed = step == 1 ? 2.5 : (0.25 - 0.375) / 0.55;
    for (int i = 0; i < n_box; ++i) {
      if (one[i] == 0) continue;
      ++n_moving;
      assert_true(fabs(velocity[3 * i]) < 1e-9);
      assert_true(fabs(velocity[3 * i + 1] - speed) < 1e-9);
    }
    assert_true(n_moving > 20);
  }
}

static void expect_case_refused(const char *text, const char *valves, const char *rest) {
  write_case(valves, rest);
  RUN_REFUSED(1, text, "mark", "--case", scratch_path("case.json"), "--output", scratch_path("r.vtu"));
  assert_non_null(strstr(program_err, "case.json: "));
}

TEST(test_refused_cases) {
  const char *mitral = "{\"valve\": \"mitral\"}";
  expect_case_refused("\"half_thickness_\" is unknown, did you mean \"half_thickness\"?", mitral,
                      "\"half_thickness_\": 1,");
  expect_case_refused("valve 0: \"oppening\" is unknown, did you mean \"opening\"?",
                      "{\"valve\": \"mitral\", \"oppening\": 1}", "");
  expect_case_refused("valves: it must be an array of at least one valve", "", "");
  expect_case_refused("valve 1: name: it is missing, and each of several valves needs a name",
                      "{\"name\": \"a\", \"valve\": \"mitral\"}, {\"valve\": \"mitral\"}", "");
  expect_case_refused("name: \"a\" is already the name of another valve",
                      "{\"name\": \"a\", \"valve\": \"mitral\"}, {\"name\": \"a\", \"valve\": \"mitral\"}", "");
  expect_case_refused("name: \"a b\" must have 1 to 64 characters: letters",
                      "{\"name\": \"a b\", \"valve\": \"mitral\"}", "");
  expect_case_refused("valve: either it or \"surface\" must be given", "{\"name\": \"a\"}", "");
  expect_case_refused("valve 0: 'pulmonary' is not a kind of valve", "{\"valve\": \"pulmonary\"}", "");
  expect_case_refused("opening: 1.5 is not from 0 to 1", "{\"valve\": \"mitral\", \"opening\": 1.5}", "");
  expect_case_refused("opening: a valve that moves needs times",
                      "{\"valve\": \"mitral\", \"opening\": {\"times\": [0, 1], \"openings\": [0, 1]}}", "");
  expect_case_refused("valve 0: opening: \"perod\" is unknown, did you mean \"period\"?",
                      "{\"valve\": \"mitral\", \"opening\": {\"times\": [0], \"openings\": [0], \"perod\": 1}}", "");
  expect_case_refused("valve 0: opening: openings: there are 1 for 2 times",
                      "{\"valve\": \"mitral\", \"opening\": {\"times\": [0, 1], \"openings\": [0]}}", "");
  expect_case_refused("valve 0: opening: table.time of key 1 is 0",
                      "{\"valve\": \"mitral\", \"opening\": {\"times\": [0, 0], \"openings\": [0, 1]}}", "");
  expect_case_refused("opening: closing_start: it is missing",
                      "{\"valve\": \"mitral\", \"opening\": {\"opening_start\": 0, \"opening_duration\": 1}}", "");
  expect_case_refused("opening: it must have file, times or opening_start", "{\"valve\": \"mitral\", \"opening\": {}}",
                      "");
  expect_case_refused(
      "interpolation: \"spline\" is none of linear, cubic",
      "{\"valve\": \"mitral\", \"opening\": {\"times\": [0], \"openings\": [0], \"interpolation\": \"spline\"}}", "");
  expect_case_refused("half_thickness: 0 is not above 0", "{\"valve\": \"mitral\", \"half_thickness\": 0}", "");
  expect_case_refused("resistance: -1 is below 0", "{\"valve\": \"mitral\", \"resistance\": -1}", "");
  expect_case_refused("rotate: [1,0,0] has 3 numbers; it takes 4", "{\"valve\": \"mitral\", \"rotate\": [1, 0, 0]}",
                      "");
  expect_case_refused("translate: \"x\" is not a number", "{\"valve\": \"mitral\", \"translate\": [0, 0, \"x\"]}", "");
  expect_case_refused("unit: \"inch\" is none of m, cm, mm", mitral, "\"unit\": \"inch\",");
  expect_case_refused("scale: it cannot be combined with \"unit\"", "{\"valve\": \"mitral\", \"scale\": 2}",
                      "\"unit\": \"m\",");
  expect_case_refused("times: the step 0 is not above 0", mitral, "\"times\": \"0:1:0\",");
  expect_case_refused("times: the time 1 is not above the time before it, 2", mitral, "\"times\": [2, 1],");
  expect_case_refused("parameters: 'anulus' is not a parameter",
                      "{\"valve\": \"mitral\", \"parameters\": {\"anulus\": 1}}", "");
  expect_case_refused("in the open state, the left cusp's leaflet curve reaches",
                      "{\"valve\": \"aortic\", \"opening\": 0.5,"
                      " \"parameters\": {\"left.leaflet_radius_out\": 5, \"commissure_expansion\": 0.5}}",
                      "");
#define WARP(rest) "{\"valve\": \"trileaflet\", \"warp\": {" rest "}}"
#define WARP_OF(rest) WARP("\"sources\": " LANDMARKS ", " rest)
  expect_case_refused("valve 0: warp: sources: it is missing", WARP(""), "");
  expect_case_refused("valve 0: warp: targets: it is missing", WARP("\"sources\": " LANDMARKS), "");
  expect_case_refused("valve 0: warp: sources: point 1, [1,2], is not [x, y, z]",
                      WARP("\"sources\": [[0, 0, 0], [1, 2]], \"targets\": []"), "");
  expect_case_refused("valve 0: warp: targets: there are 1 points for 6 sources", WARP_OF("\"targets\": [[1, 2, 3]]"),
                      "");
  expect_case_refused("valve 0: warp: \"noize\" is unknown, did you mean \"noise\"?",
                      WARP_OF("\"targets\": " LANDMARKS ", \"noize\": 1"), "");
  expect_case_refused("noise: -1 is below 0", WARP_OF("\"targets\": " LANDMARKS ", \"noise\": -1"), "");
  expect_case_refused("coordinates: \"world\" is none of mesh, valve",
                      WARP_OF("\"targets\": " LANDMARKS ", \"coordinates\": \"world\""), "");
  expect_case_refused("period: it needs \"times\"", WARP_OF("\"targets\": " LANDMARKS ", \"period\": 1"), "");
  expect_case_refused("targets: with \"times\" it must be an array of 2",
                      WARP_OF("\"targets\": " LANDMARKS ", \"times\": [0, 1]"), "");
  expect_case_refused("warp: landmarks that move need times",
                      WARP_OF("\"targets\": [" LANDMARKS ", " LANDMARKS "], \"times\": [0, 1]"), "");
  expect_case_refused("valve 0: warp: the warp folds near landmark",
                      WARP_OF("\"targets\": [[1, 0, 0], [-1, 0, 0], [0, -1, 0], [0, 1, 0], [0, 0, 1], [0, 0, -1]]"),
                      "");
  expect_case_refused(
      "landmarks 0 and 2 are in one place",
      WARP("\"sources\": [[1, 0, 0], [0, 1, 0], [1, 0, 0]], \"targets\": [[1, 0, 0], [0, 1, 0], [1, 0, 0]]"), "");
  expect_case_refused("warp: it cannot be combined with \"surface\"", "{\"surface\": \"a.stl\", \"warp\": {}}", "");
  expect_case_refused("surface: a surface that moves needs times", "{\"surface\": \"a.pvd\"}", "");
  expect_case_refused("period: it needs a \"surface\" that moves", "{\"surface\": \"a.stl\", \"period\": 1}", "");
  scratch_write_text("case.json", "{\"valves\": [{\"valve\": \"mitral\"}]}");
  RUN_REFUSED(1, "mesh: it is missing", "mark", "--case", scratch_path("case.json"));
  scratch_write_text("case.json", "[]");
  RUN_REFUSED(1, "the case must be an object", "mark", "--case", scratch_path("case.json"));
  RUN_REFUSED(1, "missing.json: cannot be read", "mark", "--case", "missing.json");
}

TEST(test_refused_options) {
  write_case("{\"valve\": \"mitral\"}", "");
  const char *file = scratch_path("case.json");
  RUN_REFUSED(2, "--movie needs times: ", "mark", "--case", file, "--movie", "a.avi.mp4");
  RUN_REFUSED(2, "--series-table needs times: ", "mark", "--case", file, "--series-table", scratch_path("a.csv"));
  RUN_REFUSED(2, "--all-cells needs times: ", "mark", "--case", file, "--all-cells");
  RUN_REFUSED(2, "--valve excludes --case", "mark", "--case", file, "--valve", "mitral");
  RUN_REFUSED(2, "--steps has no effect with --times or --case", "mark", "--case", file, "--steps", "2");
  RUN_REFUSED(2, "--half-thickness excludes --case", "mark", "--case", file, "--half-thickness", "1");
  RUN_REFUSED(2, "--prefix excludes --case", "mark", "--case", file, "--prefix", "x", "--output", "o.vtu");
  RUN_REFUSED(2, "is also the file of MESH", "mark", "--case", file, "--output", scratch_path("in.vtu"), "--replace");
  RUN_REFUSED(2, "is also the file of --case", "mark", "--case", file, "--surface-output", scratch_path("case.json"));
}

/* In a case of one valve, the statistics equal those of this valve on the command line. With several valves, each valve has the
 * numbers that it has alone. */
TEST(test_statistics) {
  const char *mesh = scratch_path("in.vtu");
  write_case("{\"valve\": \"mitral\", \"opening\": 0.25}", "");
  RUN_FINE("mark", "--case", scratch_path("case.json"), "--resistance", "7", "--search", "neighbor", "--output",
           scratch_path("one.vtu"), "--stats", scratch_path("case_stats.json"), "--quiet");
  RUN_FINE("mark", mesh, "--valve", "mitral", "--half-thickness", "0.3", "--opening", "0.25", "--resistance", "7",
           "--search", "neighbor", "--output", scratch_path("single.vtu"), "--stats", scratch_path("stats.json"),
           "--quiet");
  char *const of_case = without_seconds("case_stats.json"), *const single = without_seconds("stats.json");
  assert_string_equal(of_case, single);
  assert_true(json_has_text(single, "search", "\"neighbor\""));
  assert_true(scratch_is_same("one.vtu", "single.vtu"));
  write_case(
      "{\"name\": \"a\", \"valve\": \"mitral\", \"opening\": 0.25},"
      "{\"name\": \"b\", \"valve\": \"aortic\", \"resistance\": 2}",
      "");
  RUN_FINE("mark", "--case", scratch_path("case.json"), "--resistance", "7", "--search", "neighbor", "--stats", "-");
  static const char *const keys[] = {"n_marked", "n_within_limit",  "n_triangles",
                                     "area",     "n_leaking_edges", "effective_area"};
  const char *const first = strstr(program_out, "\"name\": \"a\""), *const second =
                                                                        strstr(program_out, "\"name\": \"b\"");
  assert_true(first && second);
  for (size_t i = 0; i < sizeof keys / sizeof *keys; ++i)
    assert_true(json_number(first, keys[i]) == json_number(single, keys[i]));
  assert_true(json_has_text(second, "valve", "\"aortic\""));
  free(of_case);
  free(single);
}

/* In a series, the statistics have an entry for each time, and the numbers of the least opening. */
TEST(test_statistics_of_series) {
  static const char *const openings[] = {"0.5", "0.25", "1"};
  write_case(
      "{\"name\": \"a\", \"valve\": \"mitral\", \"opening\": {\"times\": [0, 1, 2], \"openings\": [0.5, 0.25, 1]}},"
      "{\"name\": \"b\", \"valve\": \"aortic\"}",
      "\"times\": [0, 1, 2],");
  RUN_FINE("mark", "--case", scratch_path("case.json"), "--search", "clusters", "--stats", "-");
  const char *const second = strstr(program_out, "\"name\": \"b\""), *time = strstr(program_out, "\"times\"");
  assert_true(second && time && time < second);
  assert_true(json_number(program_out, "opening") == 0.25);
  double n_least = 0;
  char *const out = strdup(program_out);
  for (int i = 0; i < 3; ++i) {
    time = strstr(out + (time - program_out) * (i == 0) + (i > 0) * (time - out), "\"time\": ");
    assert_non_null(time);
    RUN_FINE("mark", scratch_path("in.vtu"), "--valve", "mitral", "--half-thickness", "0.3", "--opening", openings[i],
             "--stats", scratch_path("stats.json"), "--quiet");
    const char *const single = text_of("stats.json");
    assert_true(json_number(time, "n_marked") == json_number(single, "n_marked"));
    if (i == 1) n_least = json_number(single, "n_marked");
    free((void *)single);
    time += 8;
  }
  assert_true(json_number(out, "n_marked") == n_least);
  free(out);
}

/* A series may have only one time. The mesh of such a series has the marks of the opening at this time, and no velocities. */
TEST(test_one_time_of_series) {
  static double one[n_box], two[n_box];
  scratch_write_text("beat.csv", "0,0\n0.2,1\n");
  RUN_FINE("mark", scratch_path("in.vtu"), "--valve", "mitral", "--half-thickness", "0.3", "--cycle",
           scratch_path("beat.csv"), "--times", "0.1", "--output", scratch_path("single.pvd"), "--all-cells",
           "--quiet");
  RUN_FINE("mark", scratch_path("in.vtu"), "--valve", "mitral", "--half-thickness", "0.3", "--opening", "0.5",
           "--output", scratch_path("half.vtu"), "--quiet");
  read_array(scratch_path("single/single_0000.vtu"), "riis_distance", one);
  assert_int_equal(read_array(scratch_path("half.vtu"), "riis_distance", two), n_box);
  assert_memory_equal(one, two, n_box * sizeof *one);
  assert_true(has_array(scratch_path("single/single_0000.vtu"), "riis_side"));
  assert_false(has_array(scratch_path("single/single_0000.vtu"), "riis_velocity"));
}

/* riis check accepts a case. The output has separate lines for each valve of the case. */
TEST(test_checks) {
  write_case(
      "{\"name\": \"a\", \"valve\": \"mitral\"}, {\"name\": \"b\", \"valve\": \"trileaflet\", \"translate\": [0, 0, "
      "0.5]}",
      "\"check_leaks\": [0,0,-1.9, 0,0,1.9],");
  const char *file = scratch_path("case.json");
  RUN_FINE("check", "leaks", "--case", file);
  assert_non_null(strstr(program_out, "\npassage   "));
  assert_non_null(strstr(program_out, "\nacross    a: "));
  assert_non_null(strstr(program_out, "\norifice   b, opening 0: "));
  assert_non_null(strstr(program_out, "\nleaks     b: "));
  RUN_REFUSED(2, "--first-passage takes only one valve", "check", "leaks", "--case", file, "--between", "0,0,-1.9",
              "0,0,1.9", "--first-passage");
  RUN_REFUSED(2, "--valve excludes --case", "check", "leaks", "--case", file, "--valve", "mitral");
  RUN_FINE("check", "crossings", "--case", file, "--stats", "-");
  assert_non_null(strstr(program_out, "\"name\": \"b\""));
  assert_true(json_number(program_out, "n_openings") == 101);
  RUN_FINE("check", "crossings", "--case", file);
  assert_non_null(strstr(program_out, "\ncrossing  a: none: no triangles go through each other at 101 openings"));
  assert_non_null(strstr(program_out, "\ncrossing  b: none"));
  assert_null(strstr(program_out, "\nmesh "));
}

static int make_heart(void **state) {
  const int status = make_box_of(state, (double[3]){-3, -3, -2}, (double[3]){3, 3, 2});
  return status || !shim_write_box(scratch_path("heart.vtu"), SHIM_RAW, n_side, (double[3]){-2.6, -2.3, -2},
                                   (double[3]){2.6, 5.7, 2.4}, 0);
}

int main(void) { return run_cases(make_heart, scratch_teardown); }
