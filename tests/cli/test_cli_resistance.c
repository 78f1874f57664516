/* SPDX-License-Identifier: Apache-2.0
 *
 * R, K, a pressure drop and the leak have units (docs/program.md, "Units of R"). One box with one valve is written in m, cm and
 * mm. K follows from the distances by its formula, with plain factors between the units. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "expect.h"
#include "program.h"
#include "scratch.h"
#include "vtk_shim.h"

/* A unit of length, its value in metres, and the value of a kilogram in the matching unit of mass. */
static const struct {
  const char *unit, *K_unit, *K_u_unit, *leak_unit;
  double metres, kilograms;
} systems[] = {{"m", "kg/(m3 s)", "kg/(m2 s2)", "m3/s", 1, 1},
               {"cm", "g/(cm3 s)", "g/(cm2 s2)", "cm3/s", 1e-2, 1e-3},
               {"mm", "g/(mm3 s)", "g/(mm2 s2)", "mm3/s", 1e-3, 1e-3}};
enum { n_systems = sizeof systems / sizeof systems[0] };

static double K[n_box], distance[n_box];

static const char *mesh_of(int i) {
  static char name[16];
  snprintf(name, sizeof name, "in_%s.vtu", systems[i].unit);
  return scratch_path(name);
}

/* Writes the box of make_box in each unit. The box's lengths are in centimetres. */
static int make_boxes(void **state) {
  const int status = make_box(state);
  for (int i = 0; status == 0 && i < n_systems; ++i) {
    const double s = 0.01 / systems[i].metres, lower[3] = {-1.7 * s, -1.7 * s, -1.3 * s},
                 upper[3] = {1.7 * s, 1.7 * s, 1.0 * s};
    if (!shim_write_box(mesh_of(i), SHIM_BINARY, n_box_side, lower, upper, 0)) return -1;
  }
  return status;
}

/* Compares K in SI units with the formula, with R in kg/(m s). Returns the largest difference over the largest K. */
static double error_of_K(const char *file, double R, double metres, double K_si) {
  const double eps = 0.003, pi = acos(-1);
  double largest = 0, error = 0;
  assert_int_equal(shim_read_array(scratch_path(file), 'p', "riis_K", NULL, NULL, NULL, K), 1);
  assert_int_equal(shim_read_array(scratch_path(file), 'p', "riis_distance", NULL, NULL, NULL, distance), 1);
  for (int i = 0; i < n_box; ++i) {
    const double d = distance[i] * metres, expected = d < eps ? R / eps * (1 + cos(pi * d / eps)) / (2 * eps) : 0;
    largest = fmax(largest, expected);
    error = fmax(error, fabs(K[i] * K_si - expected));
  }
  assert_true(largest > 0);
  return error / largest;
}

/* Returns whether a text file or a binary file contains the text. */
static int contains(const char *name, const char *text) {
  size_t n = 0;
  char *all = scratch_read(scratch_path(name), &n);
  const size_t length = strlen(text);
  int found = 0;
  for (size_t i = 0; !found && i + length <= n; ++i) found = memcmp(all + i, text, length) == 0;
  free(all);
  return found;
}

#define EPS(i) (snprintf(eps, sizeof eps, "%.17g", 0.003 / systems[i].metres), eps)

/* R without a unit is in kg/(m s). R with a unit has that unit. */
TEST(test_same_physics) {
  char eps[32], line[128];
  for (int i = 0; i < n_systems; ++i) {
    const double metres = systems[i].metres, K_si = systems[i].kilograms / (metres * metres * metres);
    const char *const texts[] = {"1e4", "1e5 g/(cm s)", "1e4g/mm/s", "10 kPa s", "1e5 P", "10 kg mm^-1 s-1"};
    for (size_t t = 0; t < sizeof texts / sizeof *texts; ++t) {
      RUN_FINE("mark", mesh_of(i), "--unit", systems[i].unit, "--half-thickness", EPS(i), "--resistance", texts[t],
               "--output", scratch_path("out.vtu"));
      assert_true(error_of_K("out.vtu", 1e4, metres, K_si) <= 1e-9);
      snprintf(line, sizeof line, "\nR         10000 kg/(m s); riis_K is in %s\n", systems[i].K_unit);
      assert_non_null(strstr(program_out, line));
    }
    assert_true(contains("out.vtu", "UNITS_LABEL") && contains("out.vtu", systems[i].K_unit));
    /* The user chooses another unit of K, in each mesh. */
    RUN_FINE("mark", mesh_of(i), "--unit", systems[i].unit, "--half-thickness", EPS(i), "--resistance", "1e4",
             "--k-unit", "kg/(mm3 s)", "--output", scratch_path("chosen.vtu"));
    assert_true(error_of_K("chosen.vtu", 1e4, metres, 1e9) <= 1e-9);
    assert_true(contains("chosen.vtu", "kg/(mm3 s)"));
    assert_non_null(strstr(program_out, "; riis_K is in kg/(mm3 s)\n"));
    RUN_FINE("mark", mesh_of(i), "--unit", systems[i].unit, "--half-thickness", EPS(i), "--resistance", "1e4",
             "--output", scratch_path("out.xdmf"));
    snprintf(line, sizeof line, "Name=\"riis_K\" AttributeType=\"Scalar\" Center=\"Node\" Unit=\"%s\">",
             systems[i].K_unit);
    assert_true(contains("out.xdmf", line));
  }
}

TEST(test_leak) {
  char eps[32], line[128];
  double leak[n_systems];
  for (int i = 0; i < n_systems; ++i) {
    RUN_FINE("check", "leaks", mesh_of(i), "--unit", systems[i].unit, "--half-thickness", EPS(i), "--valve", "coapting",
             "--opening", "0", "--resistance", "1e4", "--drop", "1e5 dyn/cm2", "--stats", scratch_path("stats.json"));
    snprintf(line, sizeof line, " %s at the drop 10000 Pa, through an ideal closed valve of the area ",
             systems[i].leak_unit);
    assert_non_null(strstr(program_out, line));
    assert_non_null(strstr(program_out, "\nR         10000 kg/(m s)\n"));
    char *json = scratch_read(scratch_path("stats.json"), NULL);
    snprintf(line, sizeof line, "\"%s\"", systems[i].leak_unit);
    assert_true(json_has_text(json, "leak_unit", line) && json_has_text(json, "drop_unit", "\"Pa\"") &&
                json_has_text(json, "resistance_unit", "\"kg/(m s)\""));
    const double metres = systems[i].metres, area = json_number(json, "closed_area") * metres * metres;
    leak[i] = json_number(json, "leak") * metres * metres * metres;
    assert_true(fabs(leak[i] - 1e4 * area * 0.003 / 1e4) <= 1e-9 * leak[i]);
    assert_true(fabs(leak[i] - leak[0]) <= 1e-9 * leak[0]);
    assert_true(fabs(json_number(json, "leak_per_drop") * 1e4 - json_number(json, "leak")) <=
                1e-9 * json_number(json, "leak"));
    free(json);
  }
}

/* If the mesh's unit is unknown, R and K are in units of the mesh, and the report says so. */
TEST(test_unknown_unit) {
  const char *const mesh = scratch_path("in.vtu");
  RUN_FINE("mark", mesh, "--half-thickness", "0.3", "--resistance", "10", "--output", scratch_path("out.vtu"),
           "--stats", scratch_path("stats.json"));
  assert_non_null(
      strstr(program_out, "\nR         10 and riis_K in the units of the mesh, whose unit of length is not known\n"));
  assert_false(contains("out.vtu", "UNITS_LABEL"));
  assert_true(contains("stats.json", "\"resistance_unit\": null") && contains("stats.json", "\"K_unit\": null"));
  RUN_REFUSED(
      2, "--resistance: '1e5 g/(cm s)' has a unit, but the unit of the mesh is not known: write --unit m, cm or mm",
      "mark", mesh, "--resistance", "1e5 g/(cm s)");
  RUN_REFUSED(2, "--k-unit needs the unit of the mesh: write --unit m, cm or mm", "mark", mesh, "--resistance", "1",
              "--k-unit", "kg/(m3 s)");
}

TEST(test_refused_units) {
  const char *const mesh = scratch_path("in.vtu");
#define REFUSED(text, ...) RUN_REFUSED(2, text, "mark", mesh, "--unit", "cm", __VA_ARGS__)
  REFUSED("--resistance: 'kg/m3' is not a unit of a resistance, such as kg/(m s)", "--resistance", "1 kg/m3");
  REFUSED(
      "--resistance: 'g/(cm2 s)' is not a unit of a resistance, such as kg/(m s); it is a unit of R/eps: multiply the "
      "number by the half thickness",
      "--resistance", "1e5 g/(cm2 s)");
  const char *const malformed[] = {"furlong", "kg/(m s", "kg/(m s))", "kg//", "kg^", "kg/(m s^-)", "()", "kg/m 0"};
  for (size_t i = 0; i < sizeof malformed / sizeof *malformed; ++i) {
    char typed[32], text[256];
    snprintf(typed, sizeof typed, "1 %s", malformed[i]);
    snprintf(
        text, sizeof text,
        "--resistance: '%s' is not a unit such as g/(cm s); it may have kg, g, mg, m, cm, mm, s, ms, N, dyn, Pa, kPa, "
        "mPa, mmHg, P, cP",
        malformed[i]);
    REFUSED(text, "--resistance", typed);
  }
  REFUSED("--resistance: 'ten' is not a number", "--resistance", "ten");
  REFUSED("--resistance is -1 kg/(m s); it must be at least 0", "--resistance", "-1 kg/(m s)");
  REFUSED("--k-unit: 'kg/(m s)' is not a unit of a K, such as kg/(m3 s)", "--resistance", "1", "--k-unit", "kg/(m s)");
  REFUSED("--k-unit requires --resistance", "--k-unit", "kg/(m3 s)");
  REFUSED("--density requires --resistance", "--density", "1060");
  REFUSED("--density: 'Pa' is not a unit of a density, such as kg/m3", "--resistance", "1", "--density", "1 Pa");
#undef REFUSED
}

/* In a case, R may be a number or a text with a unit. The unit is the case's "unit", or the unit of placed valves. */
TEST(test_units_in_a_case) {
  const struct {
    const char *text;
    int exit_code;
    const char *refusal;
  } cases[] = {
      {"{\"unit\": \"mm\", \"resistance\": 1e4, \"valves\": [{\"valve\": \"aortic\", \"half_thickness\": 3}]}", 0,
       NULL},
      {"{\"unit\": \"mm\", \"valves\": [{\"valve\": \"aortic\", \"half_thickness\": 3, \"resistance\": \"1e5 g/(cm "
       "s)\"}]}",
       0, NULL},
      {"{\"unit\": \"mm\", \"resistance\": 7, \"valves\": [{\"valve\": \"aortic\", \"half_thickness\": 3, "
       "\"resistance\": \"1e4 kg/(m s)\"}]}",
       0, NULL},
      {"{\"resistance\": \"1e4 kg/(m s)\", \"valves\": [{\"valve\": \"aortic\", \"scale\": 10}]}", 1,
       "case.json: resistance: '1e4 kg/(m s)' has a unit, but the unit of the mesh is not known"},
      {"{\"unit\": \"mm\", \"resistance\": \"1 Pa\", \"valves\": [{\"valve\": \"aortic\"}]}", 1,
       "case.json: resistance: 'Pa' is not a unit of a resistance, such as kg/(m s)"},
      {"{\"unit\": \"mm\", \"resistance\": \"-1 Pa s\", \"valves\": [{\"valve\": \"aortic\"}]}", 1,
       "case.json: resistance: \"-1 Pa s\" is below 0"},
      {"{\"unit\": \"mm\", \"resistance\": [1], \"valves\": [{\"valve\": \"aortic\"}]}", 1,
       "case.json: resistance: [1] is not a number"},
  };
  for (size_t i = 0; i < sizeof cases / sizeof cases[0]; ++i) {
    scratch_write_text("case.json", cases[i].text);
    if (cases[i].exit_code != 0) {
      RUN_REFUSED(cases[i].exit_code, cases[i].refusal, "mark", mesh_of(2), "--case", scratch_path("case.json"));
      continue;
    }
    RUN_FINE("mark", mesh_of(2), "--case", scratch_path("case.json"), "--output", scratch_path("out.vtu"));
    assert_true(error_of_K("out.vtu", 1e4, 1e-3, 1e6) <= 1e-9);
    assert_true(contains("out.vtu", "g/(mm3 s)"));
    assert_non_null(strstr(program_out, "\nR         10000 kg/(m s); riis_K is in g/(mm3 s)\n"));
  }
  /* R on the command line replaces R in the case. */
  scratch_write_text("case.json", cases[0].text);
  RUN_FINE("mark", mesh_of(2), "--case", scratch_path("case.json"), "--resistance", "5 kPa s", "--output",
           scratch_path("out.vtu"));
  assert_true(error_of_K("out.vtu", 5e3, 1e-3, 1e6) <= 1e-9);
}

/* A series has the unit in each file, also that of K u_surface. */
TEST(test_series) {
  scratch_write_text("beat.csv", "0,0\n0.5,1\n1,0\n");
  RUN_FINE("mark", mesh_of(1), "--unit", "cm", "--valve", "coapting", "--half-thickness", "0.3", "--resistance", "1e4",
           "--cycle", scratch_path("beat.csv"), "--times", "0.1,0.2", "--output", scratch_path("beat.pvd"), "--quiet");
  assert_true(contains("beat/beat_0001.vtu", systems[1].K_unit) && contains("beat/beat_0001.vtu", systems[1].K_u_unit));
  RUN_FINE("mark", mesh_of(1), "--unit", "cm", "--valve", "coapting", "--half-thickness", "0.3", "--resistance", "1e4",
           "--k-unit", "kg/(m3 s)", "--cycle", scratch_path("beat.csv"), "--times", "0.1,0.2", "--output",
           scratch_path("beat2.pvd"), "--quiet");
  assert_true(contains("beat2/beat2_0001.vtu", "kg/(m3 s) cm/s"));
}

int main(void) { return run_cases(make_boxes, scratch_teardown); }
