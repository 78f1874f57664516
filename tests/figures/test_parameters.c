/* SPDX-License-Identifier: Apache-2.0
 *
 * Tests the drawings that explain the parameters. Each valve's drawing must name the parameters that riis_valve_get_parameter
 * lists, up to "skirt_length". The copy in docs/ must also name them. The script must refuse to draw if a parameter is missing or
 * has another value. The test is skipped if Python lacks matplotlib. */
#include <ctype.h>
#include <riis/riis.h>
#include <stdlib.h>
#include <sys/wait.h>

#include "answers.h"
#include "expect.h"
#include "scratch.h"

enum { n_valves = 5 };
static const char *const valves[n_valves] = {"aortic", "trileaflet", "coapting", "mitral", "bileaflet"};

/* Returns the exit status of a program. The program's output goes to a file in the scratch folder. */
static int run(const char *command, const char *word, const char *other_word, const char *kind) {
  char line[2048];
  const int n =
      snprintf(line, sizeof line, "%s '%s' '%s' %s >'%s", command, word, other_word, kind, scratch_path("printed"));
  assert_true(n > 0 && (size_t)n + 7 < sizeof line);
  strcat(line, "' 2>&1");
  const int status = system(line);
  assert_true(WIFEXITED(status));
  return WEXITSTATUS(status);
}

/* Draws one kind of valve, or all kinds for "". */
static int draw(const char *curves, const char *kind) {
  char words[2048];
  const char *path = scratch_path(curves);
  const int folder = (int)(strrchr(path, '/') - path);
  const int n = snprintf(words, sizeof words, "'%s' '%.*s' %s", path, folder, path, kind);
  assert_true(n > 0 && (size_t)n < sizeof words);
  return answer_of(RIIS_DRAW_PARAMETERS, words);
}

static int setup(void **state) {
  scratch_setup(state);
  if (system("'" RIIS_PYTHON "' -c 'import matplotlib, PIL' 2>/dev/null") != 0) {
    puts("skipped: " RIIS_PYTHON " has no matplotlib (Debian: python3-matplotlib)");
    scratch_teardown(state);
    exit(77);
  }
  char path[1024];
  snprintf(path, sizeof path, "%s", scratch_path("curves.json"));
  if (run("'" RIIS_FIGURES_PROGRAM "'", "--curves", path, "") == 0 && draw("curves.json", "") == 0) return 0;
  fprintf(stderr, "%s\n", scratch_read(scratch_path("printed"), NULL));
  return -1;
}

/* Calls visit with every parameter of the valve up to "skirt_length". Later parameters change single cusps, commissures and
 * places, so the drawings omit them. */
static void for_each_parameter(const char *kind, void (*visit)(const riis_parameter *, void *), void *what) {
  riis_valve *valve = NULL;
  assert_int_equal(riis_valve_create(kind, &valve), RIIS_OK);
  int64_t n = 0;
  assert_int_equal(riis_valve_get_n_parameters(valve, &n), RIIS_OK);
  assert_true(n >= 8);
  for (int64_t i = 0; i < n; ++i) {
    riis_parameter parameter;
    assert_int_equal(riis_valve_get_parameter(valve, i, &parameter, sizeof parameter), RIIS_OK);
    visit(&parameter, what);
    if (strcmp(parameter.name, "skirt_length") == 0) break;
  }
  riis_valve_destroy(&valve);
}

/* Returns whether a text in the drawing is the name, or begins with the name and a blank. */
static int is_written(const char *svg, const char *name) {
  char begin[256];
  const size_t n = (size_t)snprintf(begin, sizeof begin, ">%s", name);
  for (const char *found = svg; (found = strstr(found, begin)); ++found)
    if (found[n] == '<' || isspace((unsigned char)found[n])) return 1;
  return 0;
}

static void expect_written(const riis_parameter *parameter, void *svg) {
  /* A name without a cusp stands for all three cusps. */
  const char *dot = strchr(parameter->name, '.');
  if (!is_written(svg, parameter->name) && !(dot && is_written(svg, dot + 1)))
    fail_msg("%s is not in the drawing", parameter->name);
}

TEST(test_every_parameter_is_named) {
  for (size_t i = 0; i < n_valves; ++i) {
    char name[64];
    snprintf(name, sizeof name, "%s_parameters.svg", valves[i]);
    char *svg = scratch_read(scratch_path(name), NULL);
    for_each_parameter(valves[i], expect_written, svg);
    free(svg);
  }
}

struct picture {
  char *bytes;
  size_t n_bytes;
};

/* Expects the parameter's name and default as text in the drawing. */
static void expect_in_picture(const riis_parameter *parameter, void *what) {
  const struct picture *picture = what;
  char text[512];
  size_t n = (size_t)snprintf(text, sizeof text, "tEXt%s", parameter->name) + 1;
  for (int64_t i = 0; i < parameter->n_values; ++i)
    n += (size_t)snprintf(text + n, sizeof text - n, i ? " %.12g" : "%.12g", parameter->default_values[i]);
  for (size_t i = 0; i + n <= picture->n_bytes; ++i)
    if (memcmp(picture->bytes + i, text, n) == 0) return;
  fail_msg("%s with its default is not in the picture; ./run figures makes it anew in out/figures/parameters",
           parameter->name);
}

TEST(test_pictures_of_the_documents) {
  for (size_t i = 0; i < n_valves; ++i) {
    char path[1024];
    struct picture picture;
    snprintf(path, sizeof path, "%s/%s_parameters.png", RIIS_DOCS, valves[i]);
    picture.bytes = scratch_read(path, &picture.n_bytes);
    assert_true(picture.n_bytes > 20000 && picture.n_bytes < 250000);
    for_each_parameter(valves[i], expect_in_picture, &picture);
    free(picture.bytes);
  }
}

/* Replaces the first `old` after `mark` by `text`. The script must then refuse to draw this kind, with the message. */
static void expect_refused_drawing(const char *kind, const char *mark, const char *old, const char *text,
                                   const char *message) {
  char *json = scratch_read(scratch_path("curves.json"), NULL);
  char *found = strstr(json, mark);
  assert_non_null(found);
  assert_non_null(found = strstr(found, old));
  const size_t size = strlen(json) + strlen(text) + 1;
  char *changed = malloc(size);
  snprintf(changed, size, "%.*s%s%s", (int)(found - json), json, text, found + strlen(old));
  scratch_write_text("changed.json", changed);
  free(changed);
  free(json);
  assert_int_equal(draw("changed.json", kind), 1);
  char *printed = scratch_read(scratch_path("printed"), NULL);
  if (!strstr(printed, message)) fail_msg("'%s' is not in '%s'", message, printed);
  free(printed);
}

TEST(test_untrue_drawings_are_refused) {
  const char *more =
      "\"parameters\": [ {\"name\": \"left.tilt\", \"unit\": \"degree\", \"values\": [3], \"description\": \"\"},";
  expect_refused_drawing("aortic", "\"aortic\"", "\"parameters\": [", more, "aortic valve: not drawn: left.tilt");
  expect_refused_drawing("mitral", "\"mitral\"", "\"parameters\": [", more, "mitral valve: not drawn: left.tilt");
  expect_refused_drawing("mitral", "\"mitral\"", "\"name\": \"surface_angle\"", "\"name\": \"face_angle\"",
                         "surface_angle is not a parameter");
  expect_refused_drawing("trileaflet", "\"trileaflet\"", "\"parameters\": [", more,
                         "trileaflet valve: not drawn: left.tilt");
  expect_refused_drawing("bileaflet", "\"bileaflet\"", "\"parameters\": [", more,
                         "bileaflet valve: not drawn: left.tilt");
  expect_refused_drawing("trileaflet", "\"trileaflet\"", "\"name\": \"leaflet_radius_out\"",
                         "\"name\": \"leaflet_radius\"", "leaflet_radius_out is not a parameter");
  expect_refused_drawing("aortic", "\"name\": \"root_radius\"", "1.29", "1.28",
                         "aortic valve: root_radius is 1.28, but the drawing shows 1.29");
  expect_refused_drawing("mitral", "\"name\": \"leaflet_arc_angle\"", "120.0", "119.0",
                         "leaflet_arc_angle is 119.0, but the drawing shows 120");
  expect_refused_drawing("mitral", "\"name\": \"anterior_ratio\"", "0.41", "0.42",
                         "anterior_ratio is 0.42, but the drawing shows 0.4");
  expect_refused_drawing("aortic", "\"name\": \"left.leaflet_power\"", "2.77", "2.7",
                         "leaflet_power is 2.7, but the drawing shows 2.7");
}

/* Returns the position after a text in the curves of a kind. */
static char *after(char *json, const char *kind, const char *text) {
  char *found = strstr(json, kind);
  assert_non_null(found);
  assert_non_null(found = strstr(found, text));
  return found + strlen(text);
}

/* Checks that a drawing is refused if a parameter has another value. Tries every parameter whose value is not 0. */
static void expect_compared(const char *kind, const char *quoted_kind, const char *name) {
  char *json = scratch_read(scratch_path("curves.json"), NULL), text[256];
  snprintf(text, sizeof text, "\"name\": \"%s\"", name);
  char *end, *values = after(after(json, quoted_kind, text), "\"values\"", "[");
  const double value = strtod(values, &end);
  assert_true(end > values && value != 0);
  const size_t size = strlen(json) + 64;
  char *changed = malloc(size);
  snprintf(changed, size, "%.*s%.17g%s", (int)(values - json), json, value * 1.01, end);
  scratch_write_text("changed.json", changed);
  free(changed);
  free(json);
  assert_int_equal(draw("changed.json", kind), 1);
  char *printed = scratch_read(scratch_path("printed"), NULL);
  snprintf(text, sizeof text, "draw.py: %s valve: ", kind);
  if (!strstr(printed, text) || !strstr(printed, "but the drawing shows"))
    fail_msg("%s of the %s valve: '%s'", name, kind, printed);
  free(printed);
}

TEST(test_new_kinds_are_compared) {
  static const char *const trileaflet[] = {"root_radius",
                                           "leaflet_radius_out",
                                           "leaflet_height",
                                           "bending_height",
                                           "bending_radius_in",
                                           "bending_radius_out",
                                           "bending_angle",
                                           "bending_power",
                                           "t0_bending",
                                           "t3_bending",
                                           "xq",
                                           "zq",
                                           "open_radius_ratio",
                                           "commissure_expansion"};
  static const char *const coapting[] = {"root_radius",         "commissure_radius",
                                         "commissure_height",   "effective_height",
                                         "coaptation_height",   "gap",
                                         "bottom_angle",        "belly",
                                         "edge_rise",           "attachment_width",
                                         "attachment_drop",     "open_radius_ratio",
                                         "commissure_expansion"};
  static const char *const bileaflet[] = {"radius", "hinge_offset", "closed_angle", "open_angle"};
  for (size_t i = 0; i < sizeof trileaflet / sizeof *trileaflet; ++i)
    expect_compared("trileaflet", "\"trileaflet\"", trileaflet[i]);
  for (size_t i = 0; i < sizeof coapting / sizeof *coapting; ++i)
    expect_compared("coapting", "\"coapting\"", coapting[i]);
  for (size_t i = 0; i < sizeof bileaflet / sizeof *bileaflet; ++i)
    expect_compared("bileaflet", "\"bileaflet\"", bileaflet[i]);
  expect_refused_drawing("bileaflet", "\"bileaflet\"", "\"gap\": 0.1", "\"gap\": 0.2",
                         "gap is 0.2, but the drawing shows 0.1");
  expect_refused_drawing("bileaflet", "\"bileaflet\"", "\"hinge_height\": 0.14", "\"hinge_height\": 0.2",
                         "hinge_height is 0.2, but the drawing shows 0.1");
  expect_refused_drawing("bileaflet", "\"bileaflet\"", "\"ring_height\": 1.4", "\"ring_height\": 1.5",
                         "ring_height is 1.5, but the drawing shows 1.4");
}

TEST(test_refused_arguments) {
  assert_int_equal(run("'" RIIS_FIGURES_PROGRAM "'", "--curves", scratch_path("none/curves.json"), ""), 1);
  char *printed = scratch_read(scratch_path("printed"), NULL);
  assert_non_null(strstr(printed, "curves.json: cannot be written"));
  free(printed);
  assert_int_equal(system("'" RIIS_FIGURES_PROGRAM "' --curves 2>/dev/null"), 2 << 8);
  assert_int_equal(system("'" RIIS_PYTHON "' -B '" RIIS_DRAW_PARAMETERS "' 2>/dev/null"), 2 << 8);
  assert_int_equal(draw("curves.json", "pulmonary"), 2);
}

static int teardown(void **state) {
  end_answers();
  return scratch_teardown(state);
}

int main(void) { return run_cases(setup, teardown); }
