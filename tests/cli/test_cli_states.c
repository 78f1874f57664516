/* SPDX-License-Identifier: Apache-2.0
 *
 * Tests `riis states`. Lengths of free edges are compared with the valves' curves. Areas and orifices are compared with the
 * triangles of the surface. */
/* clang-format off: test_support.h checks statuses if riis.h comes before it */
#include <riis/riis.h>

#include "calls.h"
#include "test_support.h"
/* clang-format on */

#include "mitral_oracle.h"
#include "program.h"
#include "scratch.h"

static const double pi = 3.14159265358979323846;

/* ---- The table ---- */

enum { most_rows = 128, most_columns = 32 };
static struct {
  int n_rows, n_columns;
  char name[most_columns][64];
  double cell[most_rows][most_columns];
} table;

static void parse_table(char *text) {
  table.n_rows = table.n_columns = 0;
  char *next_line = NULL;
  for (char *line = strtok_r(text, "\n", &next_line); line; line = strtok_r(NULL, "\n", &next_line)) {
    char *next_cell = NULL;
    int column = 0;
    const int is_head = table.n_columns == 0;
    for (char *cell = strtok_r(line, ",", &next_cell); cell; cell = strtok_r(NULL, ",", &next_cell), ++column) {
      assert_true(column < most_columns && table.n_rows < most_rows);
      if (is_head)
        snprintf(table.name[table.n_columns++], sizeof table.name[0], "%s", cell);
      else
        table.cell[table.n_rows][column] = strtod(cell, NULL);
    }
    assert_int_equal(column, table.n_columns);
    table.n_rows += !is_head;
  }
}

static void read_table(void) {
  char *text = scratch_read(scratch_path("states.csv"), NULL);
  parse_table(text);
  free(text);
}

static int has_column(const char *name) {
  for (int i = 0; i < table.n_columns; ++i)
    if (strcmp(table.name[i], name) == 0) return 1;
  return 0;
}

static double cell(int row, const char *name) {
  for (int i = 0; i < table.n_columns; ++i)
    if (strcmp(table.name[i], name) == 0) return table.cell[row][i];
  fail_msg("there is no column %s", name);
  return 0;
}

#define RUN_STATES(...)                                          \
  do {                                                           \
    RUN_FINE("states", scratch_path("states.csv"), __VA_ARGS__); \
    read_table();                                                \
  } while (0)

static void expect_said(const char *text) {
  if (!strstr(program_out, text)) fail_msg("no '%s' in:\n%s", text, program_out);
}

/* Ratios are relative to the first row. */
static void check_ratios(void) {
  for (int i = 0; i < table.n_columns; ++i) {
    char ratio[80];
    snprintf(ratio, sizeof ratio, "%s_ratio", table.name[i]);
    if (!has_column(ratio)) continue;
    for (int row = 0; row < table.n_rows; ++row)
      CHECK_NEAR(cell(row, ratio), table.cell[row][i] / table.cell[0][i], 1e-15);
  }
}

/* ---- Surfaces by C ---- */

static riis_valve *make_valve(const char *kind) {
  riis_valve *valve = NULL;
  CHECK_OK(riis_valve_create(kind, &valve));
  return valve;
}

/* Computes the area of a leaflet from the triangles of a separate surface. Computes the orifice by counting grid points. */
typedef struct {
  double orifice, area[3];
} measured;

static int is_covered(int64_t n, const int64_t *vertex, const double *xyz, double x, double y) {
  for (int64_t i = 0; i < n; ++i) {
    int n_left = 0;
    for (int k = 0; k < 3; ++k) {
      const double *a = xyz + 3 * vertex[3 * i + k], *b = xyz + 3 * vertex[3 * i + (k + 1) % 3];
      n_left += (b[0] - a[0]) * (y - a[1]) - (b[1] - a[1]) * (x - a[0]) >= 0;
    }
    if (n_left == 0 || n_left == 3) return 1;
  }
  return 0;
}

/* is_inside returns whether a point is in the orifice's disc, which lies within `reach` of the axis. */
static measured measure(const riis_valve *valve, double reach, int (*is_inside)(double x, double y)) {
  enum { n_side = 120 };
  riis_surface *surface = NULL;
  int64_t n_open = 0;
  measured found = {0, {0, 0, 0}};
  CHECK_OK(riis_surface_create(valve, NULL, &surface));
  const double *xyz = triangles_of(surface).xyz;
  const int64_t n = triangles_of(surface).n_triangles;
  const int64_t *vertex = triangles_of(surface).vertex_id;
  const int32_t *leaflet = triangles_of(surface).leaflet_id;
  for (int64_t i = 0; i < n; ++i) {
    const double *a = xyz + 3 * vertex[3 * i], *b = xyz + 3 * vertex[3 * i + 1], *c = xyz + 3 * vertex[3 * i + 2];
    double ab[3], ac[3];
    for (int k = 0; k < 3; ++k) ab[k] = b[k] - a[k], ac[k] = c[k] - a[k];
    found.area[leaflet[i]] +=
        0.5 * hypot(hypot(ab[1] * ac[2] - ab[2] * ac[1], ab[2] * ac[0] - ab[0] * ac[2]), ab[0] * ac[1] - ab[1] * ac[0]);
  }
  for (int i = 0; i < n_side * n_side; ++i) {
    const double x = reach * ((2 * (i % n_side) + 1.0) / n_side - 1),
                 y = reach * ((2 * (i / n_side) + 1.0) / n_side - 1);
    n_open += is_inside(x, y) && !is_covered(n, vertex, xyz, x, y);
  }
  found.orifice = (double)n_open * 4 * reach * reach / (n_side * n_side);
  riis_surface_destroy(&surface);
  return found;
}

/* ---- The mitral valve ---- */

static const mitral_oracle *annulus_of;

static int is_in_annulus(double x, double y) {
  enum { n = 400 };
  static const mitral_oracle *last_of;
  static double corner[n + 1][3];
  int n_crossed = 0;
  for (int i = 0; i <= n && last_of != annulus_of; ++i) mitral_oracle_annulus(annulus_of, (double)i / n, corner[i]);
  last_of = annulus_of;
  for (int i = 0; i < n; ++i) {
    const double *a = corner[i], *b = corner[i + 1];
    if ((a[1] > y) != (b[1] > y)) n_crossed += a[0] + (b[0] - a[0]) * (y - a[1]) / (b[1] - a[1]) < x;
  }
  return n_crossed % 2;
}

TEST(test_mitral) {
  enum { n_states = 5 };
  mitral_parameters parameters = mitral_defaults();
  riis_valve *valve = make_valve("mitral");
  RUN_STATES("--valve", "mitral", "--count", "5");
  assert_int_equal(table.n_rows, n_states);
  assert_int_equal(table.n_columns, 12);
  check_ratios();
  for (int i = 0; i < n_states; ++i) {
    parameters.opening = 0.25 * i;
    mitral_oracle *oracle = mitral_oracle_create(&parameters, &parameters);
    double posterior = 0;
    for (int scallop = 0; scallop < 3; ++scallop) posterior += mitral_oracle_scallop_length(oracle, scallop);
    assert_true(cell(i, "opening") == parameters.opening);
    CHECK_NEAR(cell(i, "anterior_edge"), mitral_oracle_anterior_length(oracle), 5e-4);
    CHECK_NEAR(cell(i, "posterior_edge"), posterior, 5e-4);
    CHECK_OK(riis_valve_set_scalar(valve, "opening", parameters.opening));
    annulus_of = oracle;
    const measured found = measure(valve, 2.2, is_in_annulus);
    CHECK_NEAR(cell(i, "anterior_area"), found.area[0], 0.02);
    CHECK_NEAR(cell(i, "posterior_area"), found.area[1], 0.02);
    /* The points are seen along z. Until the valve is open, the axis of the annulus leans by up to 5 degrees from z, so the two
       orifices differ. */
    CHECK_NEAR(cell(i, "orifice_area"), found.orifice, i == 4 ? 0.03 : 0.06);
    CHECK_AT_MOST(cell(i, "effective_area"), cell(i, "orifice_area"));
    /* The band at the rim reaches at most two half thicknesses, 0.2. The closed orifice is 0 up to rounding. */
    CHECK_AT_MOST(cell(i, "orifice_area") - 0.2 * cell(i, "orifice_perimeter"), cell(i, "effective_area") + 1e-12);
    mitral_oracle_destroy(oracle);
  }
  annulus_of = NULL;
  /* The summary names values that are not physiological. */
  CHECK_NEAR(cell(0, "anterior_edge"), 3.91, 0.005);
  CHECK_NEAR(cell(4, "anterior_edge"), 4.58, 0.005);
  CHECK_NEAR(cell(4, "posterior_edge"), 7.28, 0.005);
  CHECK_NEAR(cell(0, "orifice_area"), 0, 1e-9);
  CHECK_NEAR(cell(4, "orifice_area"), 6.25, 0.005);
  expect_said("valve     mitral: 5 openings from 0 to 1\n");
  expect_said("anterior  free edge 3.91 when closed, times 0.925 at 0.25 to 1.17 at 1\n");
  expect_said("orifice   0 at 0, largest 6.25 at 1; the outline of the attachment has ");
  expect_said(
      "edges     not within 10 % of their closed length: anterior (1 opening, first 1), posterior (4 openings, ");
  riis_valve_destroy(&valve);
}

/* If the table goes to stdout, the program prints nothing else. */
TEST(test_stdout) {
  RUN_STATES("--valve", "bileaflet", "--quiet");
  assert_string_equal(program_out, "");
  assert_int_equal(table.n_rows, 101);
  for (int i = 0; i <= 100; ++i) assert_true(cell(i, "opening") == i / 100.0);
  RUN_FINE("states", "-", "--valve", "bileaflet");
  char *text = scratch_read(scratch_path("states.csv"), NULL);
  assert_string_equal(program_out, text);
  free(text);
}

/* Between closed leaflets, a slit that is narrower than a fifth of the half thickness has an area but no perimeter. The program
 * explains these numbers, because they look wrong. */
TEST(test_slits) {
  static const struct {
    const char *gap, *half_thickness;
    int is_told;
  } slits[] = {{"gap=0.019", "0.1", 1}, {"gap=0.021", "0.1", 0}, {"gap=0.019", "0.09", 0}, {"gap=0.019", "0.2", 1}};
  static const char *const text = "where slits narrower than a fifth of the half thickness do not count";
  for (size_t i = 0; i < sizeof slits / sizeof *slits; ++i) {
    RUN_STATES("--valve", "bileaflet", "--set", slits[i].gap, "--half-thickness", slits[i].half_thickness, "--count",
               "2");
    assert_true(cell(0, "orifice_area") > 0.03);
    assert_int_equal(cell(0, "orifice_perimeter") == 0, slits[i].is_told);
    assert_int_equal(strstr(program_out, text) != NULL, slits[i].is_told);
  }
}

/* ---- The aortic valve ---- */

/* Returns the length of a cubic, as the sum of chords. */
static double cubic_length(double p[4][3]) {
  enum { n = 20000 };
  double length = 0, last[3];
  for (int i = 0; i <= n; ++i) {
    const double t = (double)i / n, s = 1 - t, weight[4] = {s * s * s, 3 * s * s * t, 3 * s * t * t, t * t * t};
    double here[3] = {0, 0, 0};
    for (int k = 0; k < 12; ++k) here[k % 3] += weight[k / 3] * p[k / 3][k % 3];
    if (i > 0) length += hypot(hypot(here[0] - last[0], here[1] - last[1]), here[2] - last[2]);
    memcpy(last, here, sizeof last);
  }
  return length;
}

/* Returns half the length of a cusp's free edge for a power above 1 (docs/theory/aortic.md). */
static void free_edge(double r_in, double r_out, double degrees, double power, double t0, double t3, double p[4][3]) {
  const double x = r_out * cos(degrees * pi / 180), y = r_out * sin(degrees * pi / 180);
  const double made[4][3] = {
      {r_in, 0, 1.02}, {r_in, t0, 1.02}, {x - t3 * power * (x - r_in) / y, y - t3, 1.02}, {x, y, 1.02}};
  memcpy(p, made, sizeof made);
}

static int is_in_root(double x, double y) { return x * x + y * y < 1.29 * 1.29; }

/* Returns the orifice that the library measures (test_orifice and test_parted_leaflets compare it with rasters). */
static double orifice_by_c(const riis_valve *valve) {
  riis_surface_options options;
  riis_surface *surface = NULL;
  riis_orifice orifice;
  CHECK_OK(riis_surface_options_init(&options, sizeof options));
  options.tolerance = 0.01;
  CHECK_OK(riis_surface_create(valve, &options, &surface));
  CHECK_OK(riis_surface_get_orifice(surface, NULL, &orifice, sizeof orifice));
  riis_surface_destroy(&surface);
  return orifice.area;
}

TEST(test_aortic) {
  static const char *const cusp[3] = {"right", "left", "non_coronary"};
  static const double table_of_paper[3][6] = {
      {0.24, 1.365, 61, 1.58, 0.025, 0.5}, {0.49, 1.495, 58.5, 2.77, 0.1, 0.5}, {0.2, 1.38, 60.5, 1.19, 0.1, 0.65}};
  riis_valve *valve = make_valve("aortic"), *open = make_valve("aortic");
  CHECK_OK(riis_valve_set_scalar(open, "leaflet_radius_in", 1));
  CHECK_OK(riis_valve_set_open_state(valve, open));
  scratch_write_text("open.json", "{\"leaflet_radius_in\": 1}");
  RUN_STATES("--params-open", scratch_path("open.json"), "--count", "3");
  assert_int_equal(table.n_rows, 3);
  assert_int_equal(table.n_columns, 16);
  check_ratios();
  for (int i = 0; i < 3; ++i) {
    CHECK_OK(riis_valve_set_scalar(valve, "opening", 0.5 * i));
    const measured found = measure(valve, 1.3, is_in_root);
    CHECK_NEAR(cell(i, "orifice_area"), orifice_by_c(valve), 1e-12);
    CHECK_AT_MOST(cell(i, "effective_area"), cell(i, "orifice_area"));
    /* The band at the rim reaches at most two half thicknesses, 0.2. The closed orifice is 0 up to rounding. */
    CHECK_AT_MOST(cell(i, "orifice_area") - 0.2 * cell(i, "orifice_perimeter"), cell(i, "effective_area") + 1e-12);
    for (int k = 0; k < 3; ++k) {
      const double *of = table_of_paper[k];
      char name[64];
      double closed[4][3], opened[4][3];
      free_edge(of[0], of[1], of[2], of[3], of[4], of[5], closed);
      free_edge(1, of[1], of[2], of[3], of[4], of[5], opened);
      for (int j = 0; j < 12; ++j) closed[j / 3][j % 3] += 0.5 * i * (opened[j / 3][j % 3] - closed[j / 3][j % 3]);
      snprintf(name, sizeof name, "%s_edge", cusp[k]);
      CHECK_NEAR(cell(i, name), 2 * cubic_length(closed), 3e-4);
      snprintf(name, sizeof name, "%s_area", cusp[k]);
      CHECK_NEAR(cell(i, name), found.area[k], 0.02);
    }
  }
  expect_said("edges        all within 10 % of their closed length\n");
  expect_said("; the outline of the attachment has ");
  riis_valve_destroy(&valve);
  riis_valve_destroy(&open);
}

/* The table is in the valve's own frame, so a shift changes nothing. Units change lengths and areas. */
TEST(test_frame_and_unit) {
  scratch_write_text("open.json", "{\"leaflet_radius_in\": 1, \"translation\": [3, -2, 1]}");
  RUN_STATES("--params-open", scratch_path("open.json"), "--set", "translation=3,-2,1", "--count", "3");
  double edge[3], area[3], orifice[3];
  for (int i = 0; i < 3; ++i)
    edge[i] = cell(i, "left_edge"), area[i] = cell(i, "left_area"), orifice[i] = cell(i, "orifice_area");
  scratch_write_text("open.json", "{\"leaflet_radius_in\": 1}");
  RUN_STATES("--params-open", scratch_path("open.json"), "--count", "3", "--unit", "mm");
  for (int i = 0; i < 3; ++i) {
    CHECK_NEAR(cell(i, "left_edge"), 10 * edge[i], 1e-9);
    CHECK_NEAR(cell(i, "left_area"), 100 * area[i], 1e-9);
    CHECK_NEAR(cell(i, "orifice_area"), 100 * orifice[i], 1e-6);
  }
  expect_said("; the outline of the attachment has ");
}

/* ---- Valves from patches ---- */

/* Each free edge of the prosthesis consists of two cubics. The attachment and the leaflets of the prosthesis project to closed
 * curves. */
TEST(test_prosthesis) {
  double closed[4][3] = {{0.6, -1.04, 1.2}, {0.45, -0.78, 1}, {0.3, -0.52, 0.8}, {0, 0, 0.8}};
  double opened[4][3] = {{0.6, -1.04, 1.2}, {0.87, -0.8, 1.2}, {1.05, -0.37, 1.2}, {1.05, 0, 1.2}};
  RUN_STATES("--valve", RIIS_EXAMPLES "/prosthesis.json", "--count", "2");
  CHECK_NEAR(cell(0, "leaflet_0_edge"), 2 * cubic_length(closed), 3e-4);
  CHECK_NEAR(cell(1, "leaflet_0_edge"), 2 * cubic_length(opened), 3e-4);
  assert_true(has_column("leaflet_1_edge") && has_column("leaflet_2_area_ratio"));
  CHECK_NEAR(cell(0, "orifice_area"), 0, 1e-9);
  CHECK_NEAR(cell(1, "orifice_area"), 3.79, 0.01);
}

/* One side of a flat triangular patch is a point. The triangles at this point have no area, so the end of an edge at this point
 * belongs to no triangle. The sides along the axes have the lengths 1 and 2, and the slanted side has the length sqrt(5). */
static void run_flat_triangle(const char *sides) {
  char text[512];
  snprintf(text, sizeof text,
           "{\"curves\": {\"origin\": [[0, 0, 0]], \"x\": [[0, 0, 0], [1, 0, 0]], \"y\": [[0, 0, 0], [0, 2, 0]], "
           "\"slope\": [[1, 0, 0], [0, 2, 0]]}, \"patches\": [{%s}]}",
           sides);
  scratch_write_text("flat.json", text);
  RUN_STATES("--valve", scratch_path("flat.json"));
  assert_int_equal(table.n_rows, 1);
  CHECK_NEAR(cell(0, "leaflet_0_area"), 1, 1e-12);
  CHECK_NEAR(cell(0, "orifice_area"), 0, 1e-9);
  expect_said("only opening 0, because the valve has no open state\n");
  expect_said("; the outline of the attachment has 1\n");
}

TEST(test_collapsed_sides) {
  run_flat_triangle("\"v0\": \"x\", \"v1\": \"y\", \"u0\": \"origin\", \"u1\": \"slope\"");
  CHECK_NEAR(cell(0, "leaflet_0_edge"), 2, 1e-12);
  run_flat_triangle("\"v0\": \"-x\", \"v1\": \"-y\", \"u0\": \"slope\", \"u1\": \"origin\"");
  CHECK_NEAR(cell(0, "leaflet_0_edge"), 2, 1e-12);
  run_flat_triangle("\"v0\": \"origin\", \"v1\": \"slope\", \"u0\": \"x\", \"u1\": \"y\"");
  CHECK_NEAR(cell(0, "leaflet_0_edge"), sqrt(5), 1e-12);
  run_flat_triangle("\"v0\": \"slope\", \"v1\": \"origin\", \"u0\": \"-x\", \"u1\": \"-y\"");
  assert_false(has_column("leaflet_0_edge"));
  expect_said("edges     not measured: the side v = 1 of a leaflet is not free\n");
}

/* Two patches above each other share a side. The common side is the side v = 1 of one patch, but it is not a free edge. The
 * patches' other curves bend differently. Each patch alone would therefore cut the common side into different parts. The common
 * side is straight in one case, and curved in the other. */
TEST(test_shared_sides) {
  static const char *const middles[2] = {"[0, 1, 0], [2, 1, 0]", "[0, 1, 0], [1, 1.5, 0], [2, 1, 0]"};
  for (int i = 0; i < 2; ++i)
    for (int leaflet = 0; leaflet < 2; ++leaflet) {
      char text[1024];
      snprintf(
          text, sizeof text,
          "{\"curves\": {\"low\": [[0, 0, 0], [2, 0, 0]], \"middle\": [%s], \"high\": [[0, 2, 0], [0.5, 2, 2], "
          "[1.5, 2, -2], [2, 2, 0]], \"a\": [[0, 0, 0], [0, 1, 0]], \"b\": [[2, 0, 0], [2, 1, 0]], \"c\": [[0, 1, 0], "
          "[0, 2, 0]], \"d\": [[2, 1, 0], [2, 2, 0]]}, \"patches\": [{\"v0\": \"low\", \"v1\": \"middle\", \"u0\": "
          "\"a\", \"u1\": \"b\"}, {\"v0\": \"middle\", \"v1\": \"high\", \"u0\": \"c\", \"u1\": \"d\", \"leaflet\": "
          "%d}]}",
          middles[i], leaflet);
      double high[4][3] = {{0, 2, 0}, {0.5, 2, 2}, {1.5, 2, -2}, {2, 2, 0}};
      scratch_write_text("two.json", text);
      RUN_STATES("--valve", scratch_path("two.json"));
      char name[64];
      snprintf(name, sizeof name, "leaflet_%d_edge", leaflet);
      CHECK_NEAR(cell(0, name), cubic_length(high), 1e-3);
      /* If the patches belong to two leaflets, the common side is a free edge of the lower leaflet. */
      if (leaflet == 1) assert_true(cell(0, "leaflet_0_edge") > 1.999);
    }
}

/* ---- Skirts, surfaces from files ---- */

/* Writes a square tube around the z axis. The tube's sides are 2 units away from the axis. */
static void write_wall(const char *name, double unit) {
  const double corner[4][2] = {
      {2 * unit, 2 * unit}, {-2 * unit, 2 * unit}, {-2 * unit, -2 * unit}, {2 * unit, -2 * unit}};
  const double end = 5 * unit;
  char text[4096] = "solid wall\n";
  for (int i = 0; i < 4; ++i) {
    const double *a = corner[i], *b = corner[(i + 1) % 4];
    for (int k = 0; k < 2; ++k)
      snprintf(text + strlen(text), sizeof text - strlen(text),
               "facet normal 0 0 0\nouter loop\nvertex %g %g %g\nvertex %g %g %g\nvertex %g %g %g\nendloop\nendfacet\n",
               a[0], a[1], -end, b[0], b[1], k ? end : -end, k ? a[0] : b[0], k ? a[1] : b[1], end);
  }
  strcat(text, "endsolid wall\n");
  scratch_write_text(name, text);
}

TEST(test_skirts_and_files) {
  write_wall("wall.stl", 1);
  char wall[256], file[256];
  snprintf(wall, sizeof wall, "%s", scratch_path("wall.stl"));
  snprintf(file, sizeof file, "%s", scratch_path("skirt.vtp"));
  run_program("surface", "--valve", "trileaflet", "--skirt", "2", "--wall", wall, "--output", file, NULL);
  expect_run_fine(__FILE__, __LINE__);
  expect_said("skirt     to the wall, 0.7");
  /* In a file of a valve with a skirt, the outline is the skirt's outer edge. */
  RUN_STATES("--surface", file);
  CHECK_NEAR(cell(0, "orifice_area"), 0, 1e-3);
  /* In a file without a skirt, the outlines are the leaflets' free edges. */
  run_program("surface", "--valve", "trileaflet", "--output", file, NULL);
  expect_run_fine(__FILE__, __LINE__);
  RUN_STATES("--surface", file, "--coaptation");
  assert_int_equal(table.n_rows, 1);
  assert_true(has_column("time") && !has_column("opening"));
  CHECK_NEAR(cell(0, "leaflet_0_edge"), 2.5, 1e-6);
  CHECK_NEAR(cell(0, "orifice_area"), 0, 1e-3);
  assert_true(cell(0, "contact_edge") > 7.4);
  expect_said("; the outline of the open edges has ");

  RUN_STATES("--valve", "trileaflet", "--skirt", "0.1", "--coaptation", "--count", "2");
  CHECK_NEAR(cell(0, "contact_edge"), 7.5, 1e-9);
  assert_true(cell(1, "contact_edge") < 2 && cell(0, "skirt_area") > 0.5 && cell(0, "contact_area") > 0.1);
  /* With four cusps, the skirt has a larger id. */
  RUN_STATES("--valve", "quadricuspid", "--skirt", "0.1", "--count", "2");
  assert_true(cell(0, "skirt_area") > 0.5 && cell(0, "cusp_3_area") > 0.5 && cell(0, "cusp_3_edge") > 1);

  /* Two frames of a mitral valve. */
  for (int frame = 0; frame < 2; ++frame) {
    run_program("surface", "--valve", "mitral", "--triangulation", "fixed", "--opening", frame ? "1" : "0.5",
                "--tolerance", "0.01", "--output", scratch_path(frame ? "b.vtp" : "a.vtp"), NULL);
    expect_run_fine(__FILE__, __LINE__);
  }
  scratch_write_text("motion.pvd",
                     "<VTKFile type=\"Collection\"><Collection><DataSet timestep=\"0.25\" file=\"a.vtp\"/>"
                     "<DataSet timestep=\"0.5\" file=\"b.vtp\"/></Collection></VTKFile>");
  RUN_STATES("--surface", scratch_path("motion.pvd"));
  assert_int_equal(table.n_rows, 2);
  CHECK_NEAR(cell(0, "time"), 0.25, 0);
  CHECK_NEAR(cell(1, "time"), 0.5, 0);
  const double orifice = cell(1, "orifice_area");
  RUN_STATES("--valve", "mitral", "--count", "2");
  CHECK_NEAR(orifice, cell(1, "orifice_area"), 1e-3 * orifice);

  /* The cusps of the paper's aortic valve do not touch. A file of this valve nevertheless has the valve's orifice. */
  run_program("surface", "--valve", "aortic", "--opening", "1", "--tolerance", "0.01", "--output", file, NULL);
  expect_run_fine(__FILE__, __LINE__);
  RUN_STATES("--surface", file);
  const double of_file = cell(0, "orifice_area");
  RUN_STATES("--valve", "aortic", "--count", "2");
  CHECK_NEAR(of_file, cell(1, "orifice_area"), 0.005 * of_file);

  /* The leaflets of a mechanical valve leave the rest of a square tube open. */
  run_program("surface", "--valve", "bileaflet", "--opening", "1", "--tolerance", "0.01", "--output", file, NULL);
  expect_run_fine(__FILE__, __LINE__);
  RUN_STATES("--surface", file, "--wall", wall);
  expect_said("; the longest open boundary of the wall has 16");
  const double in_wall = cell(0, "orifice_area");
  RUN_STATES("--valve", "bileaflet", "--count", "2");
  const double disc = pi * 1.1 * 1.1;
  CHECK_NEAR(in_wall, 16 - (disc - cell(1, "orifice_area")), 0.005 * disc);

  char csv[256];
  snprintf(csv, sizeof csv, "%s", scratch_path("no.csv"));
  RUN_REFUSED(2, "--wall needs --skirt or --surface", "states", csv, "--wall", wall);
  RUN_REFUSED(2, "--skirt: -1 is not above 0 and finite", "states", csv, "--skirt", "-1");
  RUN_REFUSED(1, "'skirt_length' is not a parameter of the bileaflet valve", "states", csv, "--valve", "bileaflet",
              "--skirt", "1");
  RUN_REFUSED(1, "the wall is not within --skirt, 0.1", "states", csv, "--valve", "trileaflet", "--skirt", "0.1",
              "--wall", wall);
  write_wall("millimetres.stl", 10);
  RUN_REFUSED(1, "with its lengths times 0.1 the wall would be within --skirt: save the wall in the mesh's unit",
              "states", csv, "--valve", "trileaflet", "--skirt", "2", "--wall", scratch_path("millimetres.stl"));
  RUN_REFUSED(1, "none.stl", "states", csv, "--skirt", "1", "--wall", scratch_path("none.stl"));
  RUN_REFUSED(2, "is also the file of --wall", "states", wall, "--valve", "trileaflet", "--skirt", "2", "--wall", wall);
  scratch_write_text("case.json", "{\"valves\": [{\"valve\": \"trileaflet\", \"wall\": \"wall.stl\"}]}");
  RUN_REFUSED(1, "it needs \"skirt\"", "mark", file, "--case", scratch_path("case.json"));
}

/* ---- Refusals ---- */

TEST(test_refusals) {
  char csv[256];
  snprintf(csv, sizeof csv, "%s", scratch_path("no.csv"));
  RUN_REFUSED(2, "--count: 1 is not from 2 to 100001", "states", csv, "--count", "1");
  RUN_REFUSED(2, "--count: 0 is not from 2 to 100001", "states", csv, "--count", "0");
  RUN_REFUSED(2, "--count: 100002 is not from 2 to 100001", "states", csv, "--count", "100002");
  RUN_REFUSED(2, "--count: 'many' is not a whole number", "states", csv, "--count", "many");
  RUN_REFUSED(2, "OUT: the value is empty", "states", "");
  RUN_REFUSED(2, "OUT is required", "states");
  RUN_REFUSED(2, "in.vtu is one argument too many", "states", csv, scratch_path("in.vtu"));
  RUN_REFUSED(2, "--set opening has no effect, because the table lists all openings", "states", csv, "--set",
              "opening=0.5");
  const char *const others[] = {"--opening=0.5", "--rotate=0,0,1,90", "--threads=1", "--case=a.json"};
  for (size_t i = 0; i < sizeof others / sizeof others[0]; ++i)
    RUN_REFUSED(2, " is not an option", "states", csv, others[i]);
  RUN_REFUSED(2, "is also the file of --valve", "states", scratch_path("flat.json"), "--valve",
              scratch_path("flat.json"));
  RUN_REFUSED(2, "is also the file of --params", "states", scratch_path("open.json"), "--params",
              scratch_path("open.json"));
  RUN_REFUSED(1, "no/states.csv: cannot be written: the folder", "states", scratch_path("no/states.csv"));
  RUN_REFUSED(1, "is a directory", "states", scratch_path("."));
  RUN_REFUSED(1, "times root_radius, which is 0.001", "states", csv, "--set", "root_radius=0.001");
  RUN_REFUSED(1, "is not a kind of valve", "states", csv, "--valve", "pulmonary");
  assert_false(scratch_exists("no.csv"));
}

int main(void) { return run_cases(scratch_setup, scratch_teardown); }
