/* SPDX-License-Identifier: Apache-2.0
 *
 * Tests `riis from-area`. riis_surface_get_orifice checks the openings and sizes, and riis mark uses the cycles. */
/* clang-format off: test_support.h checks statuses if riis.h comes before it */
#include <riis/riis.h>

#include "calls.h"
#include "test_support.h"
/* clang-format on */

#include "program.h"
#include "scratch.h"

/* Returns the orifice of a valve at an opening. The triangles are those of riis states. */
static riis_orifice orifice_of(const char *kind, double opening, const char *name, double value, double scale) {
  riis_valve *valve = NULL;
  riis_surface *surface = NULL;
  riis_surface_options options;
  riis_orifice orifice;
  CHECK_OK(riis_valve_create(kind, &valve));
  if (name) CHECK_OK(riis_valve_set_scalar(valve, name, value));
  CHECK_OK(riis_valve_set_scalar(valve, "opening", opening));
  CHECK_OK(riis_surface_options_init(&options, sizeof options));
  options.tolerance = 0.01;
  options.scale = scale;
  CHECK_OK(riis_surface_create(valve, &options, &surface));
  CHECK_OK(riis_surface_get_orifice(surface, NULL, &orifice, sizeof orifice));
  riis_surface_destroy(&surface);
  riis_valve_destroy(&valve);
  return orifice;
}

static void expect_said(const char *text) {
  if (!strstr(program_out, text)) fail_msg("no '%s' in:\n%s", text, program_out);
}

/* Returns the number after a label that begins a line. */
static double said(const char *label) {
  for (const char *line = program_out; line && *line; line = strchr(line, '\n') ? strchr(line, '\n') + 1 : NULL)
    if (strncmp(line, label, strlen(label)) == 0) return strtod(line + strlen(label), NULL);
  fail_msg("no line begins with '%s' in:\n%s", label, program_out);
  return 0;
}

TEST(test_openings) {
  RUN_FINE("from-area", "--area", "1.8", "--valve", "bileaflet");
  expect_said("valve     bileaflet\n");
  expect_said("reached   area 1.8");
  expect_said("range     from opening 0 to 1 the area goes from ");
  CHECK_NEAR(orifice_of("bileaflet", said("opening"), NULL, 0, 1).area, 1.8, 1e-4);
  RUN_FINE("from-area", "--area", "180 mm2", "--valve", "bileaflet");
  const double by_millimetres = said("opening");
  RUN_FINE("from-area", "--area", "1.8e-4", "--valve", "bileaflet", "--unit", "m");
  CHECK_NEAR(said("opening"), by_millimetres, 1e-4);
  CHECK_NEAR(orifice_of("bileaflet", by_millimetres, NULL, 0, 1).area, 1.8, 1e-4);
  RUN_FINE("from-area", "--area", "1.8 cm2", "--valve", "bileaflet", "--effective", "--triangulation", "fixed");
  expect_said("reached   effective area 1.8");
  CHECK_NEAR(orifice_of("bileaflet", said("opening"), NULL, 0, 1).effective_area, 1.8, 1e-3);
}

/* If no opening is given, sizes are found for the open valve. */
TEST(test_sizes) {
  RUN_FINE("from-area", "--area", "7", "--valve", "bileaflet", "--solve", "scale");
  expect_said("valve     bileaflet, at opening 1\n");
  CHECK_NEAR(said("scale"), sqrt(7 / orifice_of("bileaflet", 1, NULL, 0, 1).area), 1e-6);
  CHECK_NEAR(orifice_of("bileaflet", 1, NULL, 0, said("scale")).area, 7, 1e-3);
  RUN_FINE("from-area", "--area", "1.5", "--valve", "bileaflet", "--solve", "annulus", "--opening", "0.4", "--from",
           "2", "--to", "3");
  expect_said("valve     bileaflet, at opening 0.4\n");
  expect_said("range     from annulus 2 to 3 the area goes from ");
  CHECK_NEAR(orifice_of("bileaflet", 0.4, "annulus", said("annulus"), 1).area, 1.5, 1e-3);
}

/* Returns the orifice with three changed parameters. Two of these parameters are given as "NAME=VALUE". */
static double area_with(const char *kind, double opening, const char *const *settings, const char *name, double value) {
  riis_valve *valve = NULL;
  riis_surface *surface = NULL;
  riis_orifice orifice;
  CHECK_OK(riis_valve_create(kind, &valve));
  for (int i = 0; i < 2 && settings[i]; ++i) {
    char set[64];
    const char *equals = strchr(settings[i], '=');
    snprintf(set, sizeof set, "%.*s", (int)(equals - settings[i]), settings[i]);
    CHECK_OK(riis_valve_set_scalar(valve, set, atof(equals + 1)));
  }
  CHECK_OK(riis_valve_set_scalar(valve, name, value));
  CHECK_OK(riis_valve_set_scalar(valve, "opening", opening));
  CHECK_OK(riis_surface_create(valve, NULL, &surface));
  CHECK_OK(riis_surface_get_orifice(surface, NULL, &orifice, sizeof orifice));
  riis_surface_destroy(&surface);
  riis_valve_destroy(&valve);
  return orifice.area;
}

/* With the found parameter, a diseased valve has the wanted orifice, or the wanted gap when it is closed. --from and --to may be
 * missing for a parameter that is a share and has the value 0. */
TEST(test_diseases) {
  static const struct {
    const char *kind, *area, *solve, *opening, *settings[2], *range[4];
  } cases[] = {
      {"coapting", "3.7", "bump_0.open", "1", {"bump_0.leaflet=0", "bump_0.width=1"}, {"--from", "0", "--to", "1"}},
      {"coapting", "4", "cusp_0.open_radius_ratio", "1", {NULL}, {"--from", "0.4", "--to", "0.85"}},
      {"coapting", "4", "commissure_0.fusion", "1", {NULL}, {"--from", "0.05", "--to", "0.35"}},
      {"coapting", "0.12", "bump_0.closed", "0", {"bump_0.commissure=0"}, {NULL}},
      {"bicuspid", "0.3", "bump_0.closed", "0", {"bump_0.leaflet=0", "bump_0.width=0.6"}, {NULL}},
      {"mitral_coapting", "0.3", "bump_0.closed", "0", {"bump_0.leaflet=1"}, {NULL}},
  };
  for (size_t i = 0; i < sizeof cases / sizeof *cases; ++i) {
    const char *more[9] = {NULL};
    int n = 0;
    for (int k = 0; k < 2 && cases[i].settings[k]; ++k) more[n++] = "--set", more[n++] = cases[i].settings[k];
    for (int k = 0; k < 4 && cases[i].range[k]; ++k) more[n++] = cases[i].range[k];
    run_program("from-area", "--area", cases[i].area, "--valve", cases[i].kind, "--solve", cases[i].solve, "--opening",
                cases[i].opening, "--tolerance", "0.3", more[0], more[1], more[2], more[3], more[4], more[5], more[6],
                more[7], NULL);
    assert_int_equal(program_exit_code, 0);
    const double wanted = atof(cases[i].area), found = said(cases[i].solve);
    CHECK_NEAR(area_with(cases[i].kind, atof(cases[i].opening), cases[i].settings, cases[i].solve, found), wanted,
               0.03 * wanted);
  }
  RUN_REFUSED(1, "; the valve is open: --opening 0 closes it", "from-area", "--area", "1", "--valve", "coapting",
              "--tolerance", "0.1", "--set", "bump_0.leaflet=0", "--solve", "bump_0.closed");
}

/* If the user gives the band, the program reports a gap that the band closes. */
TEST(test_gap_in_band) {
#define GAP(...)                                                                                                      \
  run_program("from-area", "--area", "0.12", "--valve", "coapting", "--opening", "0", "--set", "bump_0.commissure=0", \
              "--solve", "bump_0.closed", "--tolerance", "0.4", __VA_ARGS__, NULL);                                   \
  assert_int_equal(program_exit_code, 0)
  GAP("--half-thickness", "0.1");
  assert_non_null(strstr(program_err, "bumps leave a gap of 0.0"));
  assert_non_null(strstr(program_err, " wide, and the band closes gaps of up to 0.2, 2 half thicknesses; "));
  const char *const advice = strstr(program_err, "a half thickness below ");
  assert_non_null(advice);
  const double enough = atof(advice + strlen("a half thickness below "));
  assert_true(enough > 0.01 && enough < 0.1);
  char less[32];
  snprintf(less, sizeof less, "%g", 0.9 * enough);
  GAP("--half-thickness", less);
  assert_null(strstr(program_err, "leave a gap"));
  GAP("--quiet");
  assert_null(strstr(program_err, "leave a gap"));
#undef GAP
}

/* The areas of a known motion lead back to this motion. riis mark moves the valve by this motion, and writes velocities. */
TEST(test_cycle) {
  enum { n = 9 };
  static const double openings[n] = {0, 0.2, 0.7, 1, 1, 0.8, 0.4, 0, 0};
  char text[4096] = "# an echo\ntime;area\n";
  for (int i = 0; i < n; ++i)
    snprintf(text + strlen(text), sizeof text - strlen(text), "%.17g; %.17g\n", 0.1 * i,
             openings[i] > 0 ? 100 * orifice_of("bileaflet", openings[i], NULL, 0, 1).area : 0);
  scratch_write_text("areas.csv", text);
  RUN_FINE("from-area", "--areas", scratch_path("areas.csv"), "--area-unit", "mm2", "--valve", "bileaflet", "--period",
           "0.8", "--output", scratch_path("openings.csv"));
  expect_said("cycle     9 times from 0 to 0.8, openings from 0 to 1\n");
  riis_opening_table table;
  assert_int_equal(riis_opening_table_init(&table, sizeof table), RIIS_OK);
  double times[n], fastest = 0;
  for (int i = 0; i < n; ++i) times[i] = 0.1 * i;
  table.n_keys = n, table.time = times, table.opening = openings, table.period = 0.8;
  table.interpolation = RIIS_INTERPOLATION_CUBIC;
  for (int i = 0; i < 8000; ++i) {
    double rate;
    assert_int_equal(riis_opening_from_table(&table, 1e-4 * i, NULL, &rate), RIIS_OK);
    fastest = fmax(fastest, fabs(rate));
  }
  const char *told = strstr(program_out, "rate      fastest ");
  assert_non_null(told);
  CHECK_NEAR(atof(told + strlen("rate      fastest ")), fastest, 0.005 * fastest);
  char *cycle = scratch_read(scratch_path("openings.csv"), NULL), *next = NULL;
  assert_string_equal(strtok_r(cycle, "\n", &next), "time,opening");
  for (int i = 0; i < n; ++i) {
    double time, opening;
    assert_int_equal(sscanf(strtok_r(NULL, "\n", &next), "%lf,%lf", &time, &opening), 2);
    assert_true(fabs(time - 0.1 * i) < 1e-12);
    CHECK_NEAR(opening, openings[i], 1e-4);
  }
  free(cycle);
  RUN_FINE("from-area", "--areas", scratch_path("areas.csv"), "--area-unit", "mm2", "--valve", "bileaflet", "--output",
           "-");
  char *same = scratch_read(scratch_path("openings.csv"), NULL);
  assert_string_equal(program_out, same);
  free(same);
  RUN_FINE("mark", scratch_path("in.vtu"), "--unit", "cm", "--valve", "bileaflet", "--cycle",
           scratch_path("openings.csv"), "--period", "0.8", "--interpolation", "cubic", "--times", "0.15,0.3",
           "--surface-output", scratch_path("moving.pvd"), "--quiet");
}

#define REFUSED(code, text, ...) RUN_REFUSED(code, text, "from-area", "--valve", "bileaflet", __VA_ARGS__)

TEST(test_refusals) {
  REFUSED(2, "nothing to do: --area or --areas is needed", "--quiet");
  REFUSED(2, "--area: nan is not a finite area of at least 0", "--area", "nan");
  REFUSED(2, "--area: -1 is not a finite area of at least 0", "--area=-1");
  REFUSED(2, "--area: 'big' is not a number", "--area", "big");
  REFUSED(2, "--area: 'mm' is not a unit of an area, such as m2\n", "--area", "3 mm");
  REFUSED(2, "but the unit of the mesh is not known: write --unit m, cm or mm", "--area", "3 mm2", "--scale", "2");
  REFUSED(2, "--area is 9, which is out of reach: from opening 0 to 1 the area goes from 0.0", "--area", "9");
  REFUSED(2, "--from is 2; it must be from 0 to 1", "--area", "1", "--from", "2");
  REFUSED(2, "--to is 0.2; it must be above the start of the range, 0.3", "--area", "1", "--from", "0.3", "--to",
          "0.2");
  REFUSED(2, "a given opening has no effect, because the command finds the opening", "--area", "1", "--opening", "0.5");
  REFUSED(2, "a given opening has no effect, because the command finds the opening", "--area", "1", "--set",
          "opening=0.5");
  REFUSED(1, "'radus' is not a parameter of the bileaflet valve; did you mean 'radius'?", "--area", "1", "--solve",
          "radus");
  RUN_REFUSED(1, "parameter 'translation' has 3 values, not 1", "from-area", "--area", "1", "--valve", "trileaflet",
              "--solve", "translation");
  REFUSED(1, "ring_height does not change the area, which is ", "--area", "1", "--solve", "ring_height", "--from",
          "0.1", "--to", "0.2");
  REFUSED(2, "ring_height is 0, so a range to search is needed: from and to", "--area", "1", "--solve", "ring_height");
  REFUSED(2, "--tolerance is 5", "--area", "1", "--tolerance", "5");
  REFUSED(2, "--areas needs --output", "--areas", "areas.csv");
  REFUSED(2, "--area excludes --areas", "--area", "1", "--areas", "areas.csv");
  REFUSED(2, "--area-unit: 'cm' is not a unit of an area", "--areas", "a.csv", "--output", "-", "--area-unit", "cm");
  REFUSED(2, "--area-unit needs the unit of the mesh: write --unit m, cm or mm", "--areas", "a.csv", "--output", "-",
          "--area-unit", "cm2", "--scale", "2");
}

static void expect_areas(const char *text, const char *areas) {
  scratch_write_text("bad.csv", areas);
  REFUSED(1, text, "--areas", scratch_path("bad.csv"), "--output", scratch_path("never.csv"));
  assert_false(scratch_exists("never.csv"));
}

TEST(test_refused_areas) {
  REFUSED(1, "missing.csv", "--areas", scratch_path("missing.csv"), "--output", "-");
  expect_areas("bad.csv: holds no times and areas", "time,area\n");
  expect_areas("bad.csv: holds no times and areas", "# nothing\n");
  expect_areas("bad.csv: line 3: has 3 columns: '1,1,1'; it must have 2, time and area", "time,area\n0,0\n1,1,1\n");
  expect_areas("bad.csv: line 2: the time 0 is not above the time before it", "0,1\n0,1\n");
  expect_areas("bad.csv: line 3: the time 0.1 is not above the time before it", "0,1\n0.2,1\n0.1,1\n");
  expect_areas("bad.csv: line 2: the area 'nan' is not a finite number", "0,1\n1,nan\n");
  expect_areas("bad.csv: line 2: the time 'nan' is not a finite number", "0,1\nnan,1\n");
  expect_areas("bad.csv: line 2: the area 'x' is not a finite number", "0,1\n1,x\n");
  expect_areas("bad.csv: line 2: the area -1 is below 0", "0,1\n1,-1\n");
  expect_areas("bad.csv: the area 9 at time 1 is out of reach: from opening 0 to 1 the area goes from 0.0",
               "0,1\n1,9\n");
  scratch_write_text("bad.csv", "0,1\n0.8,1.2\n");
  REFUSED(1, "table.opening of the last key, one period after the first key", "--areas", scratch_path("bad.csv"),
          "--period", "0.8", "--output", scratch_path("never.csv"));
  REFUSED(2, "--output", "--areas", scratch_path("bad.csv"), "--output", scratch_path("bad.csv"));
}

/* A line on stderr reports the value at which the area stops growing and begins to fall. With --strict, this warning changes the
 * exit status. */
TEST(test_turns) {
  run_program("from-area", "--area", "10.7", "--valve", "mitral", "--solve", "leaflet_inward_angle", "--from", "100",
              "--to", "176", "--tolerance", "0.3", "--strict", NULL);
  assert_int_equal(program_exit_code, 4);
  if (!strstr(program_err,
              "the area grows in a part of the range and falls in another: it turns at leaflet_inward_angle 1"))
    fail_msg("no turn in: %s", program_err);
  expect_said("reached   area 10.7");
}

int main(void) { return run_cases(make_box, scratch_teardown); }
