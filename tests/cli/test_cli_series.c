/* SPDX-License-Identifier: Apache-2.0
 *
 * Compares the files of a series (--times), their times, and their arrays with single runs and with the C interface. */
#include <math.h>
#include <riis/riis.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "calls.h"
#include "expect.h"
#include "program.h"
#include "scratch.h"
#include "vtk_shim.h"

enum { n_times = 5, most_cells = 6 * n_box };
static const double times[n_times] = {0, 0.1, 0.2, 0.3, 0.4};
/* The openings are linear between three keys: opening 0 at time 0, opening 1 at 0.2, and opening 0.5 at 0.4. */
static const double openings[n_times] = {0, 0.5, 1, 0.75, 0.5};
static const char *const opening_texts[n_times] = {"0", "0.5", "1", "0.75", "0.5"};
static const char *const cycle = "# a beat\ntime, opening\n0, 0\n\n0.2, 1\n0.4, 0.5\n";

static const char *step_path(const char *folder, int step, const char *ending) {
  char name[128];
  snprintf(name, sizeof name, "%s/%s_%04d.%s", folder, folder, step, ending);
  return scratch_path(name);
}

/* Checks the whole text of a .pvd file with one entry for each of these times. */
static void expect_list(const char *pvd, const char *folder, const char *ending, int n,
                        const char *const time_texts[]) {
  char *found = scratch_read(scratch_path(pvd), NULL), *expected = malloc(4096);
  int at = sprintf(expected,
                   "<?xml version=\"1.0\"?>\n<!-- written by riis -->\n<VTKFile type=\"Collection\" version=\"0.1\" "
                   "byte_order=\"LittleEndian\">\n"
                   "  <Collection>\n");
  for (int i = 0; i < n; ++i)
    at += sprintf(expected + at, "    <DataSet timestep=\"%s\" part=\"0\" file=\"%s/%s_%04d.%s\"/>\n", time_texts[i],
                  folder, folder, i, ending);
  sprintf(expected + at, "  </Collection>\n</VTKFile>\n");
  assert_string_equal(found, expected);
  free(found);
  free(expected);
}

static int64_t read_array(const char *path, const char *name, double *values) {
  int64_t n_components = 0, n_tuples = 0;
  if (!shim_read_array(path, 'p', name, NULL, &n_components, &n_tuples, NULL)) fail_msg("%s lacks %s", path, name);
  assert_true(n_components * n_tuples <= 3 * n_box);
  shim_read_array(path, 'p', name, NULL, NULL, NULL, values);
  return n_components * n_tuples;
}

/* Runs the program without a series, at the opening that the valve has in this step. */
static void run_single(int step) {
  RUN_FINE("mark", scratch_path("in.vtu"), "--valve", "mitral", "--half-thickness", "0.3", "--resistance", "7",
           "--opening", opening_texts[step], "--output", scratch_path("single.vtu"), "--quiet");
}

/* Checks that the part has all arrays of a single run, with the same bits at its nodes. */
static void expect_as_single(int step, const char *part) {
  static double whole[3 * n_box], values[3 * n_box], ids[n_box];
  static const char *const names[] = {"riis_marked", "riis_distance", "riis_leaflet", "riis_K", "pressure", "velocity"};
  run_single(step);
  const int64_t n = read_array(part, "riis_node_id", ids);
  for (int k = 0; k < 6; ++k) {
    const int64_t n_components = read_array(scratch_path("single.vtu"), names[k], whole) / n_box;
    assert_int_equal(read_array(part, names[k], values), n_components * n);
    for (int64_t i = 0; i < n; ++i)
      assert_memory_equal(values + n_components * i, whole + n_components * (int64_t)ids[i],
                          (size_t)n_components * sizeof *values);
  }
}

/* Returns the nodes of all cells that come near the surface: in some step, a node of the cell lies within the half thickness. The
 * nodes are in the input's order. */
static int64_t nodes_near_sweep(double *ids) {
  static unsigned char is_near[n_box], is_wanted[n_box];
  static double marked[n_box];
  static int64_t corners[4 * most_cells];
  memset(is_near, 0, sizeof is_near);
  for (int step = 0; step < n_times; ++step) {
    run_single(step);
    read_array(scratch_path("single.vtu"), "riis_marked", marked);
    for (int i = 0; i < n_box; ++i) is_near[i] |= marked[i] != 0;
  }
  memcpy(is_wanted, is_near, sizeof is_near);
  const int64_t n_corners = shim_read_corners(scratch_path("in.vtu"), corners);
  for (int64_t cell = 0; cell < n_corners; cell += 4) {
    int has = 0;
    for (int k = 0; k < 4; ++k) has |= is_near[corners[cell + k]];
    for (int k = 0; has && k < 4; ++k) is_wanted[corners[cell + k]] = 1;
  }
  int64_t n = 0;
  for (int i = 0; i < n_box; ++i)
    if (is_wanted[i]) ids[n++] = i;
  return n;
}

static void run_series(const char *output, const char *option, const char *value) {
  scratch_write_text("cycle.csv", cycle);
  RUN_FINE("mark", scratch_path("in.vtu"), "--valve", "mitral", "--half-thickness", "0.3", "--resistance", "7",
           "--cycle", scratch_path("cycle.csv"), "--times", "0:0.4:0.1", "--output", scratch_path(output), "--quiet",
           option, value);
}

TEST(test_files) {
  static const char *const texts[n_times] = {"0", "0.1", "0.2", "0.3", "0.4"};
  static double ids[n_box], expected[n_box];
  run_series("beat.pvd", "--surface-output", scratch_path("leaf.pvd"));
  assert_string_equal(program_out, "");
  expect_list("beat.pvd", "beat", "vtu", n_times, texts);
  expect_list("leaf.pvd", "leaf", "vtp", n_times, texts);
  const int64_t n_expected = nodes_near_sweep(expected);
  assert_true(n_expected > 50 && n_expected < n_box);
  for (int step = 0; step < n_times; ++step) {
    assert_int_equal(read_array(step_path("beat", step, "vtu"), "riis_node_id", ids), n_expected);
    assert_memory_equal(ids, expected, (size_t)n_expected * sizeof *ids);
  }
  expect_as_single(1, step_path("beat", 1, "vtu"));
  expect_as_single(4, step_path("beat", 4, "vtu"));
}

/* Each cell of the part equals the input's cell with this id, including its data. */
TEST(test_cells) {
  static double node_ids[n_box], region[most_cells], part_region[most_cells], cell_ids[most_cells];
  static int64_t corners[4 * most_cells], part_corners[4 * most_cells];
  int64_t n_cells = 0;
  run_series("cells.pvd", NULL, NULL);
  const char *part = step_path("cells", 0, "vtu");
  read_array(part, "riis_node_id", node_ids);
  assert_int_equal(shim_read_array(part, 'c', "riis_cell_id", NULL, NULL, &n_cells, cell_ids), 1);
  assert_true(n_cells > 50);
  assert_int_equal(shim_read_corners(part, part_corners), 4 * n_cells);
  shim_read_corners(scratch_path("in.vtu"), corners);
  assert_int_equal(shim_read_array(part, 'c', "region", NULL, NULL, NULL, part_region), 1);
  shim_read_array(scratch_path("in.vtu"), 'c', "region", NULL, NULL, NULL, region);
  for (int64_t i = 0; i < n_cells; ++i) {
    const int64_t cell = (int64_t)cell_ids[i];
    assert_true(i == 0 || cell_ids[i] > cell_ids[i - 1]);
    assert_true(part_region[i] == region[cell]);
    for (int k = 0; k < 4; ++k) assert_int_equal((int64_t)node_ids[part_corners[4 * i + k]], corners[4 * cell + k]);
  }
}

/* Compares a step's fields with those of the C interface. The velocity is the mean over the step that ends at this time. No step
 * ends at the first time, so the velocity there is the mean over an added step of equal length. */
static void expect_fields(int step, const char *path) {
  static double xyz[3 * n_box], normal[3 * n_box], velocity[3 * n_box], momentum[3 * n_box], side[n_box], K[n_box];
  riis_valve *now = NULL, *before = NULL;
  riis_surface *surface = NULL;
  riis_mesh *mesh = NULL;
  riis_marks *result = NULL;
  riis_surface_options options;
  riis_mark_options how;
  riis_mark_list fields;
  expect_fine(riis_surface_options_init(&options, sizeof options));
  options.half_thickness = 0.3;
  expect_fine(riis_valve_create("mitral", &now));
  expect_fine(riis_valve_create("mitral", &before));
  expect_fine(riis_valve_set_scalar(now, "opening", openings[step]));
  expect_fine(riis_valve_set_scalar(before, "opening", openings[step > 0 ? step - 1 : 0]));
  expect_fine(riis_surface_create(now, &options, &surface));
  expect_fine(
      riis_surface_update_moving(surface, now, before, step > 0 ? times[step] - times[step - 1] : 0.1, NULL, NULL));
  assert_int_equal(shim_read_points(scratch_path("in.vtu"), NULL, NULL, NULL, xyz), 1);
  expect_fine(riis_mesh_create(n_box, xyz, xyz + 1, xyz + 2, 3, &mesh));
  expect_fine(riis_marks_create(&result));
  expect_fine(riis_mark_options_init(&how, sizeof how));
  how.fields = RIIS_FIELD_NORMAL | RIIS_FIELD_VELOCITY | RIIS_FIELD_SIDE;
  expect_fine(riis_mark_nodes(surface, mesh, &how, result));
  const int64_t n = within_list(result).n_nodes;
  const int64_t *node_id = within_list(result).node_id;
  expect_fine(riis_marks_get_list(result, RIIS_LIST_WITHIN_LIMIT, &fields, sizeof fields));
  assert_int_equal(read_array(path, "riis_normal", normal), 3 * n_box);
  assert_int_equal(read_array(path, "riis_velocity", velocity), 3 * n_box);
  assert_int_equal(read_array(path, "riis_K_u_surface", momentum), 3 * n_box);
  assert_int_equal(read_array(path, "riis_side", side), n_box);
  assert_int_equal(read_array(path, "riis_K", K), n_box);
  assert_true(n > 50);
  double speed = 0;
  for (int64_t i = 0; i < n; ++i) {
    const int64_t node = node_id[i];
    assert_memory_equal(normal + 3 * node, fields.normal + 3 * i, 3 * sizeof *normal);
    assert_memory_equal(velocity + 3 * node, fields.velocity + 3 * i, 3 * sizeof *velocity);
    assert_true(side[node] == fields.side[i]);
    for (int k = 0; k < 3; ++k) {
      speed = fmax(speed, fabs(velocity[3 * node + k]));
      assert_true(fabs(momentum[3 * node + k] - K[node] * velocity[3 * node + k]) <=
                  1e-12 * fabs(momentum[3 * node + k]));
    }
  }
  int64_t n_still = 0;
  for (int i = 0; i < n_box; ++i) n_still += side[i] == 0 && normal[3 * i] == 0 && velocity[3 * i] == 0;
  assert_true(n_still >= n_box - n);
  assert_true(step == 0 ? speed == 0 : speed > 1);
  riis_marks_destroy(&result);
  riis_mesh_destroy(&mesh);
  riis_surface_destroy(&surface);
  riis_valve_destroy(&before);
  riis_valve_destroy(&now);
}

TEST(test_all_cells) {
  int64_t n_points = 0, n_cells = 0;
  run_series("all.pvd", "--all-cells", NULL);
  assert_int_equal(shim_read_points(step_path("all", 3, "vtu"), &n_points, &n_cells, NULL, NULL), 1);
  assert_int_equal(n_points, n_box);
  assert_int_equal(shim_read_array(step_path("all", 3, "vtu"), 'p', "riis_node_id", NULL, NULL, NULL, NULL), 0);
  expect_fields(0, step_path("all", 0, "vtu"));
  expect_fields(2, step_path("all", 2, "vtu"));
  expect_fields(3, step_path("all", 3, "vtu"));
}

TEST(test_table) {
  static double marked[n_box];
  run_series("t.pvd", "--series-table", scratch_path("t.csv"));
  char *text = scratch_read(scratch_path("t.csv"), NULL), *line = text;
  static const char head[] = "time,opening,n_marked,largest_speed,seconds\n";
  assert_int_equal(strncmp(line, head, strlen(head)), 0);
  for (int step = 0; step < n_times; ++step) {
    double time = 0, opening = 0, n_marked = 0, speed = 0, seconds = 0, n = 0;
    line = strchr(line, '\n') + 1;
    assert_int_equal(sscanf(line, "%lf,%lf,%lf,%lf,%lf", &time, &opening, &n_marked, &speed, &seconds), 5);
    assert_true(time == times[step] && fabs(opening - openings[step]) < 1e-12 && seconds > 0);
    const int64_t n_part = read_array(step_path("t", step, "vtu"), "riis_marked", marked);
    for (int64_t i = 0; i < n_part; ++i) n += marked[i];
    assert_true(n_marked == n && n > 20);
    assert_true(step == 0 ? speed == 0 : speed > 1);
  }
  assert_string_equal(strchr(line, '\n'), "\n");
  free(text);
}

/* After its last key a cycle is constant, or repeats if it has a period. Cubic openings equal the library's. */
static double opening_at(const char *line_of_time, const char *option, const char *value, const char *more,
                         const char *interpolation) {
  double time = 0, opening = -1;
  scratch_write_text("cycle.csv", cycle);
  RUN_FINE("mark", scratch_path("in.vtu"), "--valve", "mitral", "--half-thickness", "0.3", "--cycle",
           scratch_path("cycle.csv"), "--times", "0.05,0.45,0.55", "--series-table", scratch_path("o.csv"), "--quiet",
           option, value, more, interpolation);
  char *text = scratch_read(scratch_path("o.csv"), NULL);
  const char *line = strstr(text, line_of_time);
  assert_non_null(line);
  assert_int_equal(sscanf(line, "%lf,%lf", &time, &opening), 2);
  free(text);
  return opening;
}

TEST(test_cycles) {
  const double keys[] = {0, 0.2, 0.4}, at_keys[] = {0, 1, 0.5};
  riis_opening_table table;
  double expected = 0;
  assert_true(opening_at("0.55,", NULL, NULL, NULL, NULL) == 0.5);
  assert_true(fabs(opening_at("0.55,", "--period", "0.5", NULL, NULL) - 0.25) < 1e-12);
  expect_fine(riis_opening_table_init(&table, sizeof table));
  table.n_keys = 3;
  table.time = keys;
  table.opening = at_keys;
  table.period = 0.5;
  table.interpolation = RIIS_INTERPOLATION_CUBIC;
  expect_fine(riis_opening_from_table(&table, 0.05, &expected, NULL));
  assert_true(opening_at("0.05,", "--period", "0.5", "--interpolation", "cubic") == expected);
  assert_true(fabs(expected - 0.25) > 0.01);
}

/* At the first time, the velocity is the mean over an added step before this time. At the beginning of that step, a cycle with a
 * period has another opening. */
TEST(test_first_velocity) {
  double time = -1, opening = -1, n_marked = 0, speed = 0;
  scratch_write_text("cycle.csv", cycle);
  RUN_FINE("mark", scratch_path("in.vtu"), "--valve", "mitral", "--half-thickness", "0.3", "--cycle",
           scratch_path("cycle.csv"), "--period", "0.5", "--times", "0:0.4:0.1", "--series-table",
           scratch_path("v.csv"), "--quiet");
  char *text = scratch_read(scratch_path("v.csv"), NULL);
  assert_int_equal(sscanf(strchr(text, '\n'), "\n%lf,%lf,%lf,%lf", &time, &opening, &n_marked, &speed), 4);
  /* The opening goes from 0.5 to 0 within 0.1 units of time. */
  riis_valve *now = NULL, *before = NULL;
  riis_surface *surface = NULL;
  riis_surface_options options;
  double expected = 0;
  expect_fine(riis_surface_options_init(&options, sizeof options));
  options.half_thickness = 0.3;
  expect_fine(riis_valve_create("mitral", &now));
  expect_fine(riis_valve_create("mitral", &before));
  expect_fine(riis_valve_set_scalar(now, "opening", 0));
  expect_fine(riis_valve_set_scalar(before, "opening", 0.5));
  expect_fine(riis_surface_create(now, &options, &surface));
  expect_fine(riis_surface_update_moving(surface, now, before, 0.1, NULL, NULL));
  const int64_t n = triangles_of(surface).n_vertices;
  const double *velocity = triangles_of(surface).velocity;
  for (int64_t i = 0; i < n; ++i)
    expected = fmax(expected, hypot(hypot(velocity[3 * i], velocity[3 * i + 1]), velocity[3 * i + 2]));
  assert_true(time == 0 && opening == 0 && expected > 1);
  assert_true(fabs(speed - expected) <= 1e-9 * expected);
  riis_surface_destroy(&surface);
  riis_valve_destroy(&before);
  riis_valve_destroy(&now);
  free(text);
}

static int64_t read_triangles(const char *path, int64_t *corners) {
  int64_t n = 0;
  assert_int_equal(shim_read_points(path, NULL, &n, NULL, NULL), 1);
  assert_true(n > 100 && n < 100000);
  assert_int_equal(shim_read_corners(path, corners), 3 * n);
  return n;
}

/* The first series keeps its triangulation, and omits only triangles without area. The second series makes a new triangulation at
 * each time. */
TEST(test_triangulations) {
  static const char *const hows[] = {"fixed", "adapted"};
  static int64_t corners[2][300000];
  static double ids[2][100000];
  for (int how = 0; how < 2; ++how) {
    run_series("t.pvd", "--triangulation", hows[how]);
    RUN_FINE("mark", scratch_path("in.vtu"), "--valve", "mitral", "--half-thickness", "0.3", "--cycle",
             scratch_path("cycle.csv"), "--times", "0.05:0.2:0.05", "--surface-output", scratch_path("tri.pvd"),
             "--triangulation", hows[how], "--quiet");
    const int64_t n[2] = {read_triangles(step_path("tri", 0, "vtp"), corners[0]),
                          read_triangles(step_path("tri", 3, "vtp"), corners[1])};
    for (int k = 0; k < 2; ++k)
      assert_int_equal(shim_read_array(step_path("tri", 3 * k, "vtp"), 'c', "riis_triangle", NULL, NULL, NULL, ids[k]),
                       1);
    int n_same = 0;
    for (int64_t i = 0, j = 0; i < n[0]; ++i) {
      while (j < n[1] && ids[1][j] < ids[0][i]) ++j;
      n_same += j < n[1] && ids[1][j] == ids[0][i] && memcmp(corners[0] + 3 * i, corners[1] + 3 * j, 24) == 0;
    }
    if (how == 0)
      assert_int_equal(n_same, n[0]);
    else
      assert_true(n_same < n[0]);
  }
}

/* The frames lift the surface by 0.5 within one unit of time. The marks equal those of a single run at this time, and the
 * velocity is that of the frames. */
TEST(test_motion) {
  static double marked[n_box], single[n_box], velocity[3 * n_box];
  RUN_FINE("surface", "--valve", "mitral", "--output", scratch_path("low.vtp"), "--quiet");
  RUN_FINE("surface", "--valve", "mitral", "--translate", "0,0,0.5", "--output", scratch_path("high.vtp"), "--quiet");
  scratch_write_text("move.pvd",
                     "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\"><Collection>"
                     "<DataSet timestep=\"0\" file=\"low.vtp\"/><DataSet timestep=\"1\" file=\"high.vtp\"/>"
                     "</Collection></VTKFile>\n");
  RUN_FINE("mark", scratch_path("in.vtu"), "--surface", scratch_path("move.pvd"), "--half-thickness", "0.3", "--times",
           "0,0.5,1", "--output", scratch_path("mv.pvd"), "--all-cells", "--series-table", scratch_path("mv.csv"),
           "--quiet");
  /* A surface from a file has no opening to print. */
  run_program("mark", scratch_path("in.vtu"), "--surface", scratch_path("move.pvd"), "--half-thickness", "0.3",
              "--times", "0,1", NULL);
  assert_int_equal(program_exit_code, 0);
  assert_null(strstr(program_out, "opening"));
  assert_non_null(strstr(program_out, "move.pvd: "));
  assert_non_null(strstr(program_out, " nodes marked, largest speed 0.5\n"));
  RUN_FINE("mark", scratch_path("in.vtu"), "--surface", scratch_path("move.pvd"), "--half-thickness", "0.3", "--time",
           "0.5", "--output", scratch_path("at.vtu"), "--quiet");
  read_array(step_path("mv", 1, "vtu"), "riis_marked", marked);
  read_array(scratch_path("at.vtu"), "riis_marked", single);
  assert_memory_equal(marked, single, sizeof marked);
  read_array(step_path("mv", 1, "vtu"), "riis_distance", marked);
  read_array(scratch_path("at.vtu"), "riis_distance", single);
  assert_memory_equal(marked, single, sizeof marked);
  read_array(step_path("mv", 1, "vtu"), "riis_velocity", velocity);
  int n_marked = 0;
  for (int i = 0; i < n_box; ++i) {
    if (marked[i] > 0.3) continue;
    ++n_marked;
    assert_true(fabs(velocity[3 * i]) < 1e-12 && fabs(velocity[3 * i + 2] - 0.5) < 1e-12);
  }
  assert_true(n_marked > 50);
  /* The surface rests before its first frame. A surface from frames has no opening. */
  char *table = scratch_read(scratch_path("mv.csv"), NULL);
  double n = 0, speed = -1;
  assert_int_equal(sscanf(strchr(table, '\n'), "\n0,,%lf,%lf,", &n, &speed), 2);
  assert_true(n > 50 && speed == 0);
  free(table);
}

/* In the .pvd, characters that XML reserves must be escaped in the file name. */
TEST(test_names) {
  run_series("a & <b>.pvd", NULL, NULL);
  char *list = scratch_read(scratch_path("a & <b>.pvd"), NULL);
  assert_non_null(strstr(list, "file=\"a &amp; &lt;b&gt;/a &amp; &lt;b&gt;_0000.vtu\""));
  assert_true(scratch_exists("a & <b>/a & <b>_0004.vtu"));
  free(list);
}

/* Marks at times in steps of 0.1, up to this last time. */
#define RUN_UNTIL(mesh, last, ...)                                                                    \
  (run_program("mark", scratch_path(mesh), "--valve", "mitral", "--half-thickness", "0.3", "--cycle", \
               scratch_path("cycle.csv"), "--times", "0:" last ":0.1", __VA_ARGS__, NULL),            \
   assert_int_equal(program_exit_code, 0))

TEST(test_files_of_an_earlier_run_go) {
  scratch_write_text("cycle.csv", cycle);
  RUN_UNTIL("in.vtu", "0.4", "--output", scratch_path("old.pvd"), "--surface-output", scratch_path("leaf.pvd"));
  assert_null(strstr(program_out, "removed"));
  /* Files with other names belong to the user. */
  scratch_write_text("old/old_notes_2024.vtu", "mine");
  scratch_write_text("old/old_12.vtu", "mine");
  scratch_write_text("old/other_0003.vtu", "mine");
  RUN_UNTIL("in.vtu", "0.1", "--output", scratch_path("old.pvd"), "--surface-output", scratch_path("leaf.pvd"));
  assert_non_null(strstr(program_out, "2 files in "));
  assert_non_null(strstr(program_out, "; 3 files of an earlier run removed\n"));
  for (int step = 0; step < n_times; ++step) {
    char name[64];
    snprintf(name, sizeof name, "old/old_%04d.vtu", step);
    assert_int_equal(scratch_exists(name), step < 2);
    snprintf(name, sizeof name, "leaf/leaf_%04d.vtp", step);
    assert_int_equal(scratch_exists(name), step < 2);
  }
  assert_true(scratch_exists("old/old_notes_2024.vtu") && scratch_exists("old/old_12.vtu"));
  assert_true(scratch_exists("old/other_0003.vtu"));
  static const char *const texts[] = {"0", "0.1"};
  expect_list("old.pvd", "old", "vtu", 2, texts);
}

TEST(test_files_of_a_hand_made_list_stay) {
  static const char *const by_hand =
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\" byte_order=\"LittleEndian\">\n  "
      "<Collection>\n"
      "    <DataSet timestep=\"0.3\" part=\"0\" file=\"hand/hand_0003.vtu\"/>\n  </Collection>\n</VTKFile>\n";
  scratch_write_text("cycle.csv", cycle);
  RUN_UNTIL("in.vtu", "0.4", "--output", scratch_path("hand.pvd"));
  /* A list that riis did not write names one of the files. */
  scratch_write_text("mine.pvd", by_hand);
  RUN_REFUSED(1, "mine.pvd names hand/hand_0003.vtu, a step of an earlier ", "mark", scratch_path("in.vtu"), "--valve",
              "mitral", "--half-thickness", "0.3", "--cycle", scratch_path("cycle.csv"), "--times", "0,0.1", "--output",
              scratch_path("hand.pvd"));
  assert_true(scratch_exists("hand/hand_0003.vtu") && scratch_exists("hand/hand_0004.vtu"));
  /* riis did not write the list with this name. */
  assert_int_equal(remove(scratch_path("mine.pvd")), 0);
  scratch_write_text("hand.pvd", by_hand);
  for (int is_listed = 1; is_listed >= 0; --is_listed) {
    RUN_REFUSED(1, "but no list that riis wrote names it: remove it, or name another output", "mark",
                scratch_path("in.vtu"), "--valve", "mitral", "--half-thickness", "0.3", "--cycle",
                scratch_path("cycle.csv"), "--times", "0,0.1", "--output", scratch_path("hand.pvd"));
    assert_true(scratch_exists("hand/hand_0003.vtu") && scratch_exists("hand/hand_0004.vtu"));
    remove(scratch_path("hand.pvd"));
  }
  /* If a run writes all listed files, the run replaces these files. */
  RUN_UNTIL("in.vtu", "0.4", "--output", scratch_path("hand.pvd"));
}

TEST(test_earlier_files_of_a_mesh_in_pieces_go) {
  scratch_write_text("cycle.csv", cycle);
  assert_int_equal(shim_write_pieces(scratch_path("in.vtu"), scratch_path("parts.pvtu"), 3), 1);
  RUN_UNTIL("parts.pvtu", "0.4", "--output", scratch_path("pieces.pvd"));
  assert_true(scratch_exists("pieces/pieces_0003.pvtu") && scratch_exists("pieces/pieces_p0002_0003.vtu"));
  RUN_UNTIL("parts.pvtu", "0.2", "--output", scratch_path("pieces.pvd"));
  assert_non_null(strstr(program_out, "; 8 files of an earlier run removed\n"));
  assert_true(scratch_exists("pieces/pieces_0002.pvtu") && scratch_exists("pieces/pieces_p0002_0002.vtu"));
  assert_false(scratch_exists("pieces/pieces_0003.pvtu") || scratch_exists("pieces/pieces_p0002_0003.vtu"));
  /* The series of the whole mesh has other file names. */
  RUN_UNTIL("in.vtu", "0.1", "--output", scratch_path("pieces.pvd"));
  assert_non_null(strstr(program_out, "; 12 files of an earlier run removed\n"));
  assert_false(scratch_exists("pieces/pieces_0000.pvtu") || scratch_exists("pieces/pieces_p0000_0000.vtu"));
}

static int make_mitral_box(void **state) { return make_box_of(state, (double[3]){-3, -3, -2}, (double[3]){3, 3, 2}); }

int main(void) { return run_cases(make_mitral_box, scratch_teardown); }
