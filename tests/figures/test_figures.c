/* SPDX-License-Identifier: Apache-2.0
 *
 * The page of figures: every figure is there with a caption. Every picture is a PNG of the size that the page gives, with more
 * than one colour. Nothing is fetched from elsewhere. */
#include <stdint.h>
#include <stdlib.h>
#include <sys/wait.h>

#include "expect.h"
#include "scratch.h"
#include "virtual_display.h"
#include "vtk_shim.h"

enum { n_figures = 11 };

static char *page;

/* Returns the program's exit status. Its output goes to a file in the scratch folder. */
static int run_program(const char *arguments) {
  char command[2048];
  const int n =
      snprintf(command, sizeof command, "'%s' %s >%s 2>&1", RIIS_FIGURES_PROGRAM, arguments, scratch_path("printed"));
  assert_true(n > 0 && (size_t)n < sizeof command);
  const int status = system(command);
  assert_true(WIFEXITED(status));
  return WEXITSTATUS(status);
}

/* The same with the plots of a JSON file behind the figures. */
static int run_with_plots(const char *name, const char *json) {
  char arguments[1024];
  scratch_write("plots.json", json, strlen(json));
  const int n = snprintf(arguments, sizeof arguments, "%s ", scratch_path(name));
  snprintf(arguments + n, sizeof arguments - (size_t)n, "%s", scratch_path("plots.json"));
  return run_program(arguments);
}

static int draw_page(void **state) {
  scratch_setup(state);
  const char plots[] =
      "{\"figures\": [{\"title\": \"Costs\", \"columns\": 2, \"caption\": \"All of them.\", \"paper\": \"a table\", "
      "\"panels\":"
      " [{\"png\": \"" RIIS_TEST_PICTURE
      "\", \"caption\": \"first\"},"
      " {\"png\": \"" RIIS_TEST_PICTURE
      "\", \"caption\": \"second\"}]}], \"left_out\": [\"Peers: not measured.\", \"Threads: as well.\"]}";
  if (run_with_plots("figures.html", plots) != 0) {
    fprintf(stderr, "%s\n", scratch_read(scratch_path("printed"), NULL));
    return -1;
  }
  page = scratch_read(scratch_path("figures.html"), NULL);
  return 0;
}

static int remove_page(void **state) {
  free(page);
  return scratch_teardown(state);
}

static int base64_digit(char c) {
  static const char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  const char *found = c ? strchr(digits, c) : NULL;
  return found ? (int)(found - digits) : -1;
}

/* Decodes the text up to the closing quote into a file of the scratch folder. */
static void write_decoded(const char *text, const char *name) {
  const size_t length = strcspn(text, "\"");
  assert_true(length > 0 && length % 4 == 0);
  unsigned char *bytes = malloc(length / 4 * 3);
  size_t n = 0;
  for (size_t i = 0; i < length; i += 4) {
    uint32_t group = 0;
    int n_pads = 0;
    for (size_t k = 0; k < 4; ++k) {
      const int is_pad = text[i + k] == '=' && i + 4 == length && k >= 2;
      const int digit = is_pad ? 0 : base64_digit(text[i + k]);
      assert_true(digit >= 0);
      n_pads += is_pad;
      group = group << 6 | (uint32_t)digit;
    }
    for (int k = 0; k < 3 - n_pads; ++k) bytes[n++] = (unsigned char)(group >> (16 - 8 * k));
  }
  scratch_write(name, bytes, n);
  free(bytes);
}

/* Returns the place of a text in [from, end). */
static const char *find(const char *from, const char *end, const char *text) {
  const char *found = strstr(from, text);
  return found && found < end ? found : NULL;
}

static void expect_picture(const char *image, const char *end) {
  int expected_width = 0, expected_height = 0, width = 0, height = 0, n_colours = 0, n_coloured[2];
  assert_int_equal(sscanf(image, "<img width=\"%d\" height=\"%d\"", &expected_width, &expected_height), 2);
  assert_true(expected_width >= 400 && expected_height >= 300);
  const char *data = find(image, end, "src=\"data:image/png;base64,");
  assert_non_null(data);
  write_decoded(strchr(data, ',') + 1, "picture.png");
  assert_int_equal(shim_read_png(scratch_path("picture.png"), &width, &height, &n_colours, n_coloured), 1);
  assert_int_equal(width, expected_width);
  assert_int_equal(height, expected_height);
  assert_true(n_colours > 20);
  assert_true(n_coloured[0] + n_coloured[1] > width * height / 1000);
}

static void test_every_figure(void **state) {
  (void)state;
  for (int i = 1; i <= n_figures; ++i) {
    char start[64], caption[64];
    snprintf(start, sizeof start, "<section id=\"figure-%d\">", i);
    snprintf(caption, sizeof caption, "<p class=\"caption\"><b>Figure %d.</b> ", i);
    const char *section = strstr(page, start);
    if (!section) fail_msg("figure %d is missing", i);
    const char *end = strstr(section, "</section>");
    assert_non_null(end);
    assert_non_null(find(section, end, caption));
    assert_non_null(find(section, end, "<b>In the paper:</b> "));
    int n_pictures = 0;
    for (const char *image = section; (image = find(image, end, "<img ")); ++image, ++n_pictures)
      expect_picture(image, end);
    if (n_pictures < 4) fail_msg("figure %d has %d pictures", i, n_pictures);
  }
  char beyond[64];
  snprintf(beyond, sizeof beyond, "<section id=\"figure-%d\">", n_figures + 2); /* one figure is given by the JSON */
  assert_null(strstr(page, beyond));
}

static void test_page_stands_alone(void **state) {
  (void)state;
  assert_null(strstr(page, "http:")); /* encoded pictures have no colon */
  assert_null(strstr(page, "https:"));
  assert_null(strstr(page, "<script"));
  assert_null(strstr(page, "<link"));
  for (const char *source = page; (source = strstr(source, "src=\"")); ++source)
    assert_memory_equal(source, "src=\"data:image/png;base64,", strlen("src=\"data:image/png;base64,"));
  assert_null(strstr(page, " nan"));
  assert_non_null(strstr(page, "</html>"));
}

/* Figures that are drawn elsewhere follow the others. */
static void test_given_figures(void **state) {
  (void)state;
  char start[64];
  snprintf(start, sizeof start, "<section id=\"figure-%d\">", n_figures + 1);
  const char *section = strstr(page, start);
  assert_non_null(section);
  const char *end = strstr(section, "</section>");
  assert_non_null(find(section, end, "Costs</h2>"));
  assert_non_null(find(section, end, "All of them."));
  const char *first = find(section, end, "<img "), *second = find(first + 1, end, "<img ");
  assert_non_null(second);
  assert_non_null(find(second, end, "second</figcaption>"));
  expect_picture(first, end);
  expect_picture(second, end);
}

/* The page says which figures are missing. */
static void test_left_out(void **state) {
  (void)state;
  const char *section = strstr(page, "<section id=\"left-out\">");
  assert_non_null(section);
  const char *end = strstr(section, "</section>");
  assert_non_null(find(section, end, "Not on this page"));
  assert_non_null(find(section, end, "<li>Peers: not measured.</li>"));
  assert_non_null(find(section, end, "<li>Threads: as well.</li>"));
}

/* Faults of given figures are reported before anything is drawn. */
static void test_given_figures_refused(void **state) {
  (void)state;
  const struct {
    const char *json, *text;
  } wrong[] = {
      {"{", "plots.json: "},
      {"{}", "plots.json: "},
      {"{\"figures\": [{\"title\": 3}]}", "plots.json: "},
      {"{\"figures\": [], \"left_out\": [1]}", "plots.json: "},
      {"{\"figures\": [{\"title\": \"\", \"columns\": 0, \"caption\": \"\", \"paper\": \"\", \"panels\": []}]}",
       "plots.json: columns = 0 is not 1 to 4"},
      {"{\"figures\": [{\"title\": \"\", \"columns\": 1, \"caption\": \"\", \"paper\": \"\", \"panels\":"
       " [{\"png\": \"none.png\", \"caption\": \"\"}]}]}",
       "none.png: cannot be read"},
      {"{\"figures\": [{\"title\": \"\", \"columns\": 1, \"caption\": \"\", \"paper\": \"\", \"panels\":"
       " [{\"png\": \"plots.json\", \"caption\": \"\"}]}]}",
       "plots.json: no PNG"}};
  for (size_t i = 0; i < sizeof wrong / sizeof *wrong; ++i) {
    assert_int_equal(run_with_plots("wrong.html", wrong[i].json), 1);
    char *printed = scratch_read(scratch_path("printed"), NULL);
    if (!strstr(printed, wrong[i].text)) fail_msg("%s: '%s' is not in '%s'", wrong[i].json, wrong[i].text, printed);
    assert_null(strstr(printed, "figure 1"));
    free(printed);
  }
}

static void test_refusals(void **state) {
  (void)state;
  assert_int_equal(run_program(""), 2);
  assert_int_equal(run_program(scratch_path("no_folder/figures.html")), 1);
  char *printed = scratch_read(scratch_path("printed"), NULL);
  assert_non_null(strstr(printed, "figures.html: cannot be written"));
  free(printed);
}

int main(int argc, char **argv) {
  (void)argc;
  enter_virtual_display(argv);
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(test_every_figure),  cmocka_unit_test(test_page_stands_alone),
      cmocka_unit_test(test_given_figures), cmocka_unit_test(test_given_figures_refused),
      cmocka_unit_test(test_left_out),      cmocka_unit_test(test_refusals),
  };
  return cmocka_run_group_tests(tests, draw_page, remove_page);
}
