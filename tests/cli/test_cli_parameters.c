/* SPDX-License-Identifier: Apache-2.0
 *
 * Tests valve parameters from JSON and from --set. The parameters are checked by `riis params` and by the surface's area. */
#include <math.h>
#include <riis/riis.h>
#include <stdio.h>
#include <string.h>

#include "program.h"
#include "scratch.h"

/* Returns the number that follows the key inside the object of a cusp. */
static double in_cusp(const char *json, const char *cusp, const char *key) {
  char quoted[64];
  snprintf(quoted, sizeof quoted, "\"%s\": {", cusp);
  const char *object = strstr(json, quoted);
  if (!object) fail_msg("no %s in %s", cusp, json);
  return json_number(object, key);
}

/* Returns the first number of the array that follows the key inside the object of a cusp. */
static double first_in_cusp(const char *json, const char *cusp, const char *key) {
  char quoted[64];
  snprintf(quoted, sizeof quoted, "\"%s\": {", cusp);
  const char *object = strstr(json, quoted);
  snprintf(quoted, sizeof quoted, "\"%s\": [", key);
  const char *array = object ? strstr(object, quoted) : NULL;
  if (!array) fail_msg("no %s in %s of %s", key, cusp, json);
  double value = 0;
  assert_int_equal(sscanf(array + strlen(quoted), "%lf", &value), 1);
  return value;
}

/* The template has every parameter of the library. When the program reads the template, the values stay the same. */
static void expect_template(const char *kind) {
  static char defaults[longest_output];
  RUN_FINE("params", "--valve", kind);
  strcpy(defaults, program_out);
  riis_valve *valve = NULL;
  int64_t n = 0;
  assert_int_equal(riis_valve_create(kind, &valve), RIIS_OK);
  assert_int_equal(riis_valve_get_n_parameters(valve, &n), RIIS_OK);
  for (int64_t i = 0; i < n; ++i) {
    riis_parameter parameter;
    assert_int_equal(riis_valve_get_parameter(valve, i, &parameter, sizeof parameter), RIIS_OK);
    const char *dot = strrchr(parameter.name, '.');
    char quoted[80];
    snprintf(quoted, sizeof quoted, "\"%s\": ", dot ? dot + 1 : parameter.name);
    if (!strstr(defaults, quoted)) fail_msg("%s is not in the template", parameter.name);
  }
  riis_valve_destroy(&valve);
  scratch_write_text("template.json", defaults);
  RUN_FINE("params", "--valve", kind, "--params", scratch_path("template.json"));
  assert_string_equal(program_out, defaults);
}

TEST(test_template) {
  expect_template("mitral");
  assert_true(json_number(program_out, "ALPM_diameter") == 4);
  assert_true(json_number(program_out, "opening") == 1);
  RUN_FINE("params", "--valve", "mitral", "--opening", "0.5");
  assert_true(json_number(program_out, "opening") == 0.5);
  expect_template("aortic");
  assert_true(json_number(program_out, "root_radius") == 1.29);
  assert_true(json_number(program_out, "opening") == 0);
  assert_true(in_cusp(program_out, "right", "leaflet_angle") == 61);
  assert_true(in_cusp(program_out, "left", "leaflet_angle") == 58.5);
  static char aortic[longest_output];
  strcpy(aortic, program_out);
  RUN_FINE("params");
  assert_string_equal(program_out, aortic);
}

TEST(test_json_forms) {
  scratch_write_text("p.json",
                     "{\"root_radius\": 1.3, \"right\": {\"leaflet_angle\": 60}, \"left.leaflet_angle\": 59}");
  RUN_FINE("params", "--params", scratch_path("p.json"));
  assert_true(json_number(program_out, "root_radius") == 1.3);
  assert_true(in_cusp(program_out, "right", "leaflet_angle") == 60);
  assert_true(in_cusp(program_out, "left", "leaflet_angle") == 59);
  assert_true(in_cusp(program_out, "non_coronary", "leaflet_angle") == 60.5);
}

/* A value for one cusp overrides the value for all cusps, in any order of the two values in the file. */
TEST(test_json_order) {
  const char *files[3] = {"{\"right.translation\": [1, 2, 3], \"translation\": [7, 8, 9]}",
                          "{\"translation\": [7, 8, 9], \"right.translation\": [1, 2, 3]}",
                          "{\"right\": {\"translation\": [1, 2, 3]}, \"translation\": [7, 8, 9]}"};
  for (int i = 0; i < 3; ++i) {
    scratch_write_text("p.json", files[i]);
    RUN_FINE("params", "--params", scratch_path("p.json"));
    assert_true(first_in_cusp(program_out, "right", "translation") == 1);
    assert_true(first_in_cusp(program_out, "left", "translation") == 7);
    assert_true(first_in_cusp(program_out, "non_coronary", "translation") == 7);
  }
}

/* Options --set are applied after the file, strictly from left to right. */
TEST(test_set_order) {
  scratch_write_text("p.json", "{\"right.translation\": [1, 2, 3]}");
  RUN_FINE("params", "--set", "translation=4,5,6", "--params", scratch_path("p.json"));
  assert_true(first_in_cusp(program_out, "right", "translation") == 4);
  RUN_FINE("params", "--set", "right.translation=1,2,3", "--set", "translation=4,5,6");
  assert_true(first_in_cusp(program_out, "right", "translation") == 4);
  RUN_FINE("params", "--set", "translation=4,5,6", "--set", "right.translation=1,2,3");
  assert_true(first_in_cusp(program_out, "right", "translation") == 1);
  assert_true(first_in_cusp(program_out, "left", "translation") == 4);
}

/* A disease is a kind with parameters. First --params, and then --set, may change its parameters. */
TEST(test_diseases) {
  RUN_FINE("params", "--valve", "mitral_clip");
  assert_non_null(strstr(program_out, "\"anterior_length\""));
  for (const char *const *bump = (const char *[]){"bump_0", "bump_1", NULL}; *bump; ++bump) {
    assert_true(in_cusp(program_out, *bump, "open") == 0);
    assert_true(in_cusp(program_out, *bump, "leaflet") == (*bump)[5] - '0');
  }
  scratch_write_text("p.json", "{\"bump_0\": {\"open\": 0.5}, \"bump_1\": {\"open\": 0.5}}");
  RUN_FINE("params", "--valve", "mitral_clip", "--params", scratch_path("p.json"), "--set", "bump_1.open=0.25");
  assert_true(in_cusp(program_out, "bump_0", "open") == 0.5);
  assert_true(in_cusp(program_out, "bump_1", "open") == 0.25);
  RUN_REFUSED(1, "diseases (riis help diseases)", "params", "--valve", "mitral_clips");
}

/* Changing a parameter changes the surface. */
TEST(test_surface_changes) {
  RUN_FINE("mark", scratch_path("in.vtu"), "--stats", "-");
  const double area = json_number(program_out, "area");
  scratch_write_text("p.json", "{\"right\": {\"leaflet_angle\": 55}}");
  RUN_FINE("mark", scratch_path("in.vtu"), "--params", scratch_path("p.json"), "--stats", "-");
  const double from_file = json_number(program_out, "area");
  RUN_FINE("mark", scratch_path("in.vtu"), "--set", "right.leaflet_angle=55", "--stats", "-");
  assert_true(json_number(program_out, "area") == from_file);
  assert_true(from_file < area - 0.01);
}

TEST(test_json_refusals) {
  const struct {
    const char *json, *text;
  } files[] = {
      {"", "p.json: is empty"},
      {"{\"root_radius\": }", "p.json: is not JSON: parse error at line 1"},
      {"[1, 2]", "p.json: must hold a JSON object"},
      {"{\"rootradius\": 1}", "rootradius"},
      {"{\"middle\": {\"leaflet_angle\": 1}}", "p.json: middle is not a part of the valve"},
      {"{\"middle.leaflet_angle\": 1}", "middle"},
      {"{\"right\": {\"leaflet_angel\": 1}}", "leaflet_angel"},
      {"{\"right\": 3}", "right"},
      {"{\"root_radius\": \"1.3\"}", "p.json: root_radius must be a number or an array of numbers, not of type string"},
      {"{\"root_radius\": null}", "p.json: root_radius must be a number"},
      {"{\"root_radius\": true}", "p.json: root_radius must be a number"},
      {"{\"root_radius\": []}", "p.json: root_radius must be a number or an array of numbers, not an empty array"},
      {"{\"right\": {\"translation\": []}}", "p.json: right.translation must be a number"},
      {"{\"root_radius\\u0000x\": 1}", "p.json: a name holds a control character"},
      {"{\"root_radius\\n\": 1}", "p.json: a name holds a control character"},
      {"{\"root_radius\": [1.3, 1.4]}", "root_radius"},
      {"{\"right\": {\"translation\": [1, 2]}}", "right.translation"},
      {"{\"right\": {\"translation\": [1, [2], 3]}}", "p.json: right.translation must be a number"},
      {"{\"right\": {\"leaflet_angle\": {\"deep\": 1}}}", "p.json: right.leaflet_angle must be a number"},
      {"{\"root_radius\": -1}", "root_radius"},
      {"{\"root_radius\": 1e999}", "p.json: is not JSON: "},
      {"{\"root_radius\": 1, \"root_radius\": 2}", "p.json: root_radius is given twice"},
      {"{\"right.leaflet_angle\": 60, \"right\": {\"leaflet_angle\": 61}}",
       "p.json: right.leaflet_angle is given twice"},
      {"{\"bending_height\": 1.5}", "bending_height"},
  };
  for (size_t i = 0; i < sizeof files / sizeof files[0]; ++i) {
    scratch_write_text("p.json", files[i].json);
    RUN_REFUSED(1, files[i].text, "mark", scratch_path("in.vtu"), "--params", scratch_path("p.json"));
  }
  RUN_REFUSED(1, "missing.json: cannot be read: No such file", "mark", scratch_path("in.vtu"), "--params",
              scratch_path("missing.json"));
  RUN_REFUSED(1, ": cannot be read", "mark", scratch_path("in.vtu"), "--params", scratch_path("."));
}

/* A file with deep nesting or very long strings is refused in one line. */
TEST(test_json_sizes) {
  enum { depth = 1000000, length = 100000 };
  static char text[2 * depth + 64];
  const char *opening[] = {"[", "{\"a\":"}, *closing[] = {"]", "}"};
  for (int i = 0; i < 2; ++i) {
    const int n = i == 0 ? depth : depth / 5;
    char *end = text + sprintf(text, "{\"root_radius\": ");
    for (int k = 0; k < n; ++k) end = stpcpy(end, opening[i]);
    end = stpcpy(end, "1");
    for (int k = 0; k < n; ++k) end = stpcpy(end, closing[i]);
    strcpy(end, "}");
    scratch_write_text("p.json", text);
    RUN_REFUSED(1, "p.json: is nested deeper", "params", "--params", scratch_path("p.json"));
  }
  /* The long string is a value, a name, or a string that does not end. */
  const char *before[] = {"{\"root_radius\": \"", "{\"", "{\"root_radius\": \""};
  const char *after[] = {"\"}", "\": null}", ""};
  for (int i = 0; i < 3; ++i) {
    char *end = stpcpy(text, before[i]);
    memset(end, 'x', length);
    strcpy(end + length, after[i]);
    scratch_write_text("p.json", text);
    RUN_REFUSED(1, "p.json: ", "params", "--params", scratch_path("p.json"));
    assert_true(strlen(program_err) < 500);
  }
}

TEST(test_set_refusals) {
  RUN_REFUSED(2, "--set: 'root_radius' is not NAME=VALUE", "params", "--set", "root_radius");
  RUN_REFUSED(2, "--set: '=3' is not NAME=VALUE", "params", "--set", "=3");
  RUN_REFUSED(2, "--set root_radius: '' is not a number", "params", "--set", "root_radius=");
  RUN_REFUSED(2, "--set root_radius: '1.3cm' is not a number", "params", "--set", "root_radius=1.3cm");
  RUN_REFUSED(2, "--set translation: '' is not a number", "params", "--set", "translation=1,,3");
  RUN_REFUSED(1, "root_diameter", "params", "--set", "root_diameter=2");
  RUN_REFUSED(1, "root_radius", "params", "--set", "root_radius=1,2,3");
  RUN_REFUSED(1, "root_radius", "params", "--set", "root_radius=nan");
  RUN_REFUSED(1, "right.leaflet_power", "params", "--set", "right.leaflet_power=0.5");
}

/* The table has a line for every parameter, with its value, unit, range and description. */
static void expect_table(const char *kind) {
  RUN_FINE("params", "--describe", "--valve", kind);
  riis_valve *valve = NULL;
  int64_t n = 0, n_lines = 0;
  assert_int_equal(riis_valve_create(kind, &valve), RIIS_OK);
  assert_int_equal(riis_valve_get_n_parameters(valve, &n), RIIS_OK);
  for (const char *c = program_out; *c; ++c) n_lines += *c == '\n';
  /* After an empty line, the table gives advice on the band. */
  const int n_of_advice = strcmp(kind, "bileaflet") == 0  ? 1
                          : strcmp(kind, "coapting") == 0 ? 6
                          : strcmp(kind, "mitral") == 0   ? 5
                                                          : 4;
  assert_int_equal(n_lines, n + 2 + n_of_advice);
  assert_non_null(strstr(program_out, n_of_advice == 1 ? "\n\nband: leave --offset at 0" : "\n\nband: with a cut rim"));
  const char *line = strchr(program_out, '\n') + 1;
  for (int64_t i = 0; i < n; ++i, line = strchr(line, '\n') + 1) {
    riis_parameter parameter;
    char value[128] = "", range[64], name[64], shown_value[128], unit[16];
    assert_int_equal(riis_valve_get_parameter(valve, i, &parameter, sizeof parameter), RIIS_OK);
    for (int64_t k = 0; k < parameter.n_values; ++k)
      snprintf(value + strlen(value), sizeof value - strlen(value), "%s%g", k ? "," : "", parameter.default_values[k]);
    snprintf(range, sizeof range, " %g to %g ", parameter.minimum, parameter.maximum);
    assert_int_equal(sscanf(line, "%63s %127s %15s", name, shown_value, unit), 3);
    assert_string_equal(name, parameter.name);
    assert_string_equal(shown_value, value);
    assert_string_equal(unit, strcmp(parameter.unit, "length") == 0 ? "cm"
                              : strcmp(parameter.unit, "1") == 0    ? "-"
                                                                    : "degree");
    char description[512];
    size_t length = (size_t)snprintf(description, sizeof description, "%s", parameter.description);
    if (*parameter.rule)
      length += (size_t)snprintf(description + length, sizeof description - length, "; unless set: %s", parameter.rule);
    if (*parameter.other_name) {
      const char *dot = strrchr(parameter.name, '.');
      length += (size_t)snprintf(description + length, sizeof description - length, "; %.*s%s = %s%s",
                                 dot ? (int)(dot + 1 - parameter.name) : 0, parameter.name, parameter.other_name,
                                 parameter.other_factor > 1 ? "2 " : "", parameter.name);
    }
    const char *end = strchr(line, '\n'), *shown = strstr(line, description);
    assert_non_null(strstr(line, range));
    assert_true(shown && shown + length == end);
  }
  riis_valve_destroy(&valve);
}

TEST(test_table) {
  expect_table("aortic");
  expect_table("mitral");
  expect_table("trileaflet");
  assert_non_null(strstr(program_out, "; unless set: 0.32 root_radius\n"));
  assert_non_null(strstr(program_out, "; annulus = 2 root_radius\n"));
  expect_table("bileaflet");
  RUN_FINE("params", "--describe", "--set", "root_radius=1.3", "--set", "translation=1,2,3", "--opening", "0.5");
  assert_non_null(strstr(program_out, "root_radius"));
  assert_non_null(strstr(program_out, " 1.3 "));
  assert_non_null(strstr(program_out, " 1,2,3 "));
  assert_non_null(strstr(program_out, " 0.5 "));
}

/* One line of the table stands for all parts that equal the part before them. */
TEST(test_table_of_parts) {
  RUN_FINE("params", "--describe", "--valve", "quadricuspid");
  assert_non_null(strstr(program_out, "\ncommissure_0.fusion "));
  assert_non_null(
      strstr(program_out, "\ncommissure_1 to commissure_3 have the same parameters and values as commissure_0\n"));
  assert_non_null(strstr(program_out, "\ncusp_1 to cusp_3 have the same parameters and values as cusp_0\n"));
  assert_non_null(strstr(program_out, "\nbump_1 to bump_5 have the same parameters and values as bump_0\n"));
  assert_null(strstr(program_out, "\nbump_1.open "));
  RUN_FINE("params", "--describe", "--valve", "bicuspid", "--set", "bump_2.leaflet=1", "--set", "cusp_1.sector=200");
  assert_non_null(strstr(program_out, "\nbump_1 has the same parameters and values as bump_0\n"));
  assert_non_null(strstr(program_out, "\nbump_2.leaflet "));
  assert_non_null(strstr(program_out, "\nbump_3.leaflet "));
  assert_non_null(strstr(program_out, "\nbump_4 to bump_5 have the same parameters and values as bump_3\n"));
  assert_non_null(strstr(program_out, "\ncusp_1.sector "));
}

/* In a file and in the template, the parts are objects. The template leaves out bumps without a place, except the first. */
TEST(test_parts_in_files) {
  scratch_write_text("p.json",
                     "{\"cusp_0\": {\"sector\": 140}, \"commissure_1.fusion\": 0.2, \"effective_height\": 0.95,"
                     " \"cusp_1\": {\"effective_height\": 0.9}, \"bump_2\": {\"leaflet\": 1, \"open\": 0.3}}");
  RUN_FINE("params", "--valve", "coapting", "--params", scratch_path("p.json"));
  assert_true(in_cusp(program_out, "cusp_0", "sector") == 140);
  assert_true(in_cusp(program_out, "cusp_0", "effective_height") == 0.95);
  assert_true(in_cusp(program_out, "cusp_1", "effective_height") == 0.9);
  assert_true(in_cusp(program_out, "commissure_1", "fusion") == 0.2);
  assert_true(in_cusp(program_out, "bump_0", "leaflet") == -1);
  assert_true(in_cusp(program_out, "bump_2", "open") == 0.3);
  assert_null(strstr(program_out, "\"bump_1\""));
  static char printed[longest_output];
  strcpy(printed, program_out);
  scratch_write_text("p.json", printed);
  RUN_FINE("params", "--valve", "coapting", "--params", scratch_path("p.json"));
  assert_string_equal(program_out, printed);
  scratch_write_text("p.json", "{\"bump_6\": {\"leaflet\": 1}}");
  RUN_REFUSED(1, "p.json: bump_6 is not a part of the valve that has its own parameters", "params", "--valve",
              "coapting", "--params", scratch_path("p.json"));
  RUN_REFUSED(1, "'bump_0.open' is not a parameter of the trileaflet valve: only bicuspid", "params", "--valve",
              "trileaflet", "--set", "bump_0.open=0.5");
  scratch_write_text("case.json",
                     "{\"mesh\": \"in.vtu\", \"valves\": [{\"name\": \"a\", \"valve\": \"bicuspid\","
                     " \"parameters\": {\"cusp_0\": {\"sector\": 200}, \"bump_0.commissure\": 1}}]}");
  RUN_FINE("mark", "--case", scratch_path("case.json"), "--output", scratch_path("case.vtu"));
}

/* If the band closes a gap of the closed valve, a run reports this gap. An open valve and a wide gap need no line. */
TEST(test_gap_of_bumps) {
#define MARK(...)                                                                                             \
  run_program("mark", scratch_path("in.vtu"), "--valve", "coapting", "--set", "bump_0.commissure=0", "--set", \
              "bump_0.closed=0.4", "--tolerance", "0.1", "--stats", scratch_path("gap.json"), __VA_ARGS__, NULL)
  MARK("--half-thickness", "0.1");
  assert_non_null(strstr(program_err, "bumps leave a gap of 0.08"));
  assert_non_null(
      strstr(program_err, "the band closes gaps of up to 0.2, 2 half thicknesses; a half thickness below 0.05"));
  MARK("--half-thickness", "0.1", "--offset", "0.25");
  assert_non_null(
      strstr(program_err, "the band closes gaps of up to 0.15, 1.5 half thicknesses; a half thickness below 0.07"));
  MARK("--half-thickness", "0.1", "--offset", "0.75");
  assert_null(strstr(program_err, "leave a gap"));
  MARK("--half-thickness", "0.1", "--opening", "0.5");
  assert_null(strstr(program_err, "leave a gap"));
  MARK("--half-thickness", "0.1", "--set", "bump_0.closed=0");
  assert_null(strstr(program_err, "leave a gap"));
#undef MARK
}

/* A refusal of an unknown name suggests a similar name. */
TEST(test_near_names) {
  RUN_REFUSED(1, "'leaflet_angel' is not a parameter of the aortic valve; did you mean 'leaflet_angle'?", "params",
              "--set", "leaflet_angel=60");
  RUN_REFUSED(1, "did you mean 'right.leaflet_angle'?", "params", "--set", "right.leafletangle=60");
  RUN_REFUSED(1, "did you mean 'AP_diameter'?", "params", "--valve", "mitral", "--set", "ap_diameter=3");
  RUN_REFUSED(1, "'colour' is not a parameter of the aortic valve; riis_valve_get_parameter", "params", "--set",
              "colour=3");
  scratch_write_text("p.json", "{\"rootradius\": 1}");
  RUN_REFUSED(1, "did you mean 'root_radius'?", "params", "--params", scratch_path("p.json"));
}

/* Options and files set sizes by a surgeon's names. Rules give the other sizes, and the template file lists these sizes. */
TEST(test_named_sizes) {
  static char by_options[longest_output];
  RUN_FINE("params", "--valve", "trileaflet", "--set", "effective_height=1", "--set", "stj=2.6", "--set",
           "annulus=2.3");
  strcpy(by_options, program_out);
  const struct {
    const char *name;
    double value;
  } sizes[] = {{"root_radius", 1.15},   {"leaflet_radius_out", 1.3},  {"leaflet_height", 1},
               {"bending_height", 0.5}, {"bending_radius_in", 0.368}, {"bending_angle", 35},
               {"t0_bending", 0.23},    {"t3_bending", 0.23},         {"bending_radius_out", 1.2495},
               {"bending_power", 1.8},  {"open_radius_ratio", 0.8}};
  for (size_t i = 0; i < sizeof sizes / sizeof *sizes; ++i)
    assert_true(fabs(json_number(program_out, sizes[i].name) - sizes[i].value) <= 1e-15);
  scratch_write_text("p.json", "{\"annulus\": 2.3, \"effective_height\": 1, \"stj\": 2.6}");
  RUN_FINE("params", "--valve", "trileaflet", "--params", scratch_path("p.json"));
  assert_string_equal(program_out, by_options);
  RUN_FINE("params", "--valve", "trileaflet", "--params", scratch_path("p.json"), "--set", "leaflet_height=1.4");
  assert_true(json_number(program_out, "bending_height") == 0.7);
  /* A template sets all values. After the program has read this template, no value follows from others by a rule. */
  scratch_write_text("p.json", by_options);
  RUN_FINE("params", "--valve", "trileaflet", "--params", scratch_path("p.json"), "--set", "leaflet_height=1.4");
  assert_true(json_number(program_out, "leaflet_height") == 1.4 && json_number(program_out, "bending_height") == 0.5);
  scratch_write_text("p.json",
                     "{\"stj\": 2.8, \"right\": {\"stj\": 2.6, \"leaflet_angle\": 62}, \"left.leaflet_angle\": 57.5}");
  RUN_FINE("params", "--params", scratch_path("p.json"));
  assert_true(in_cusp(program_out, "right", "leaflet_radius_out") == 1.3);
  assert_true(in_cusp(program_out, "left", "leaflet_radius_out") == 1.4);
  assert_non_null(strstr(program_out, "\"rotation\": [\n      0.0,\n      0.0,\n      119.5\n"));
  assert_non_null(strstr(program_out, "\"rotation\": [\n      0.0,\n      0.0,\n      -122.5\n"));

  /* A case file also accepts the surgeon's names. */
  const char *const parameters[] = {"\"annulus\": 2.4", "\"annulus\": -2.4", "\"annulus\": 2.4, \"root_radius\": 1.2"};
  const char *const texts[] = {"", "parameter 'annulus' is -2.4; it must be from 2e-09",
                               "annulus and root_radius are given, but both are names of one size"};
  for (int i = 0; i < 3; ++i) {
    char json[256];
    snprintf(json, sizeof json,
             "{\"mesh\": \"in.vtu\", \"valves\": [{\"name\": \"a\", \"valve\": \"trileaflet\", \"parameters\": {%s}}]}",
             parameters[i]);
    scratch_write_text("case.json", json);
    if (i == 0)
      RUN_FINE("mark", "--case", scratch_path("case.json"), "--output", scratch_path("case.vtu"));
    else
      RUN_REFUSED(1, texts[i], "mark", "--case", scratch_path("case.json"), "--output", scratch_path("case.vtu"));
  }

  const struct {
    const char *kind, *json, *text;
  } refused[] = {
      {"trileaflet", "{\"annulus\": 2.5, \"root_radius\": 1.25}",
       "p.json: annulus and root_radius are given, but both are names of one size; give only one of them"},
      {"aortic", "{\"right\": {\"leaflet_radius_out\": 1.3}, \"right.stj\": 2.6}",
       "p.json: right.leaflet_radius_out and right.stj are given, but both are names of one size; give only one of "
       "them"},
      {"aortic", "{\"stj\": 2.6, \"leaflet_radius_out\": 1.3}",
       "p.json: stj and leaflet_radius_out are given, but both are names of one size; give only one of them"},
      {"mitral", "{\"annulus\": 3.5}",
       "p.json: 'annulus' is not a parameter of the mitral valve: its annulus is not round; set AP_diameter and "
       "ALPM_diameter"},
      {"bileaflet", "{\"stj\": 3.5}",
       "p.json: 'stj' is not a parameter of the bileaflet valve: its housing has only one radius"},
      {"trileaflet", "{\"stj\": -3.5}", "p.json: parameter 'stj' is -3.5; it must be from 2e-09 to 2e+09"},
  };
  for (size_t i = 0; i < sizeof refused / sizeof *refused; ++i) {
    scratch_write_text("p.json", refused[i].json);
    RUN_REFUSED(1, refused[i].text, "params", "--valve", refused[i].kind, "--params", scratch_path("p.json"));
  }
  RUN_REFUSED(1, "did you mean 'annulus'?", "params", "--set", "anulus=2.5");
}

int main(void) { return run_cases(make_box, scratch_teardown); }
