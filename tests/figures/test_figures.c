/* SPDX-License-Identifier: Apache-2.0
 *
 * The page of figures must have every figure, each with a caption. Every picture must be a PNG of the size that the page gives,
 * with more than one colour. Tables of states must have the numbers of `riis states`. The page must not load anything from
 * elsewhere. */
#include <math.h>
#include <riis/riis.h>
#include <stdint.h>
#include <stdlib.h>
#include <sys/wait.h>

#include "answers.h"
#include "expect.h"
#include "scratch.h"
#include "virtual_display.h"
#include "vtk_shim.h"

enum { n_of_paper = 11, n_kinds = 4, n_figures = n_of_paper + n_kinds };

/* The kinds of valves with a table of states, and the number of openings in each table. For the fifth kind, aortic, the page says
 * that it has no table. */
static const char *const kinds[n_kinds] = {"trileaflet", "coapting", "mitral", "bileaflet"};
static const int n_openings[n_kinds] = {3, 2, 2, 2};

static char *page;

/* Returns a program's exit status. The program's output goes to a file in the scratch folder. */
static int run(const char *program, const char *arguments) {
  char command[4096];
  const int n = snprintf(command, sizeof command, "'%s' %s >%s 2>&1", program, arguments, scratch_path("printed"));
  assert_true(n > 0 && (size_t)n < sizeof command);
  const int status = system(command);
  assert_true(WIFEXITED(status));
  return WEXITSTATUS(status);
}

static int run_program(const char *arguments) {
  char all[4096];
  const int n = snprintf(all, sizeof all, "-B '" RIIS_DRAW_PAGE "' '" RIIS_PROGRAMS "' %s", arguments);
  assert_true(n > 0 && (size_t)n < sizeof all);
  return run(RIIS_PYTHON, all);
}

/* Draws a page that will be refused. Returns the exit status. */
static int run_refused(const char *arguments) {
  char all[4096];
  const int n = snprintf(all, sizeof all, "'" RIIS_PROGRAMS "' %s", arguments);
  assert_true(n > 0 && (size_t)n < sizeof all);
  return answer_of(RIIS_DRAW_PAGE, all);
}

/* Draws the page with a JSON file of faulty plots. Returns the exit status. */
static int run_with_plots(const char *name, const char *json) {
  char arguments[1024];
  scratch_write("plots.json", json, strlen(json));
  const int n = snprintf(arguments, sizeof arguments, "%s ", scratch_path(name));
  snprintf(arguments + n, sizeof arguments - (size_t)n, "%s", scratch_path("plots.json"));
  return run_refused(arguments);
}

static const char *table_path(const char *kind) {
  char name[64];
  snprintf(name, sizeof name, "%s.csv", kind);
  return scratch_path(name);
}

static int measure_states(void) {
  for (int i = 0; i < n_kinds; ++i) {
    char arguments[1024];
    snprintf(arguments, sizeof arguments, "states %s --quiet --valve %s --count %d", table_path(kinds[i]), kinds[i],
             n_openings[i]);
    if (run(RIIS_PROGRAM, arguments) != 0) return -1;
  }
  return 0;
}

static int draw_page(void **state) {
  scratch_setup(state);
  if (system("'" RIIS_PYTHON "' -c 'import matplotlib, vtkmodules' 2>/dev/null") != 0) {
    puts("skipped: " RIIS_PYTHON " lacks matplotlib or VTK (Debian: python3-matplotlib, python3-vtk9)");
    scratch_teardown(state);
    exit(77);
  }
  const char plots[] =
      "{\"figures\": [{\"title\": \"Costs\", \"columns\": 2, \"caption\": \"All of them.\", \"paper\": \"a table\", "
      "\"panels\":"
      " [{\"png\": \"" RIIS_TEST_PICTURE
      "\", \"caption\": \"first\"},"
      " {\"png\": \"" RIIS_TEST_PICTURE
      "\", \"caption\": \"second\"}]}], \"left_out\": [\"Peers: not measured.\", \"Threads: as well.\"]}";
  char arguments[2048];
  scratch_write_text("plots.json", plots);
  int n = snprintf(arguments, sizeof arguments, "%s", scratch_path("figures.html"));
  n += snprintf(arguments + n, sizeof arguments - (size_t)n, " %s", scratch_path("plots.json"));
  for (int i = 0; i < n_kinds; ++i)
    n += snprintf(arguments + n, sizeof arguments - (size_t)n, " %s", table_path(kinds[i]));
  if (measure_states() != 0 || run_program(arguments) != 0) {
    fprintf(stderr, "%s\n", scratch_read(scratch_path("printed"), NULL));
    return -1;
  }
  page = scratch_read(scratch_path("figures.html"), NULL);
  return 0;
}

static int remove_page(void **state) {
  free(page);
  end_answers();
  return scratch_teardown(state);
}

static int base64_digit(char c) {
  static const char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  const char *found = c ? strchr(digits, c) : NULL;
  return found ? (int)(found - digits) : -1;
}

/* Decodes the text up to the closing quote, and writes it to a file of the scratch folder. */
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

/* Returns the position of a text in [from, end). */
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

TEST(test_every_figure) {
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
  snprintf(beyond, sizeof beyond, "<section id=\"figure-%d\">", n_figures + 2); /* the JSON file adds one figure */
  assert_null(strstr(page, beyond));
}

/* Returns the section of the figure with this number, and the section's end. */
static const char *section_of(int number, const char **end) {
  char start[64];
  snprintf(start, sizeof start, "<section id=\"figure-%d\">", number);
  const char *section = strstr(page, start);
  assert_non_null(section);
  *end = strstr(section, "</section>");
  assert_non_null(*end);
  return section;
}

/* Reads a column of a table of `riis states`. Returns the number of lines, or 0 if the column is missing. */
static int read_column(const char *kind, const char *name, double *values) {
  char *csv = scratch_read(table_path(kind), NULL), *rest = NULL;
  int column = -1, n = 0;
  for (char *line = strtok_r(csv, "\n", &rest); line; line = strtok_r(NULL, "\n", &rest)) {
    char *cells = NULL;
    int i = 0;
    for (char *cell = strtok_r(line, ",", &cells); cell; cell = strtok_r(NULL, ",", &cells), ++i)
      if (column < 0 && strcmp(cell, name) == 0) {
        column = i;
        break;
      } else if (column >= 0 && i == column) {
        values[n++] = strtod(cell, NULL);
      }
  }
  free(csv);
  return n;
}

/* Checks that the row's cells are the column's numbers, and the changes of these numbers since the first one. */
static void expect_row(const char *kind, int figure, const char *row, const char *column) {
  double values[8];
  const int n = read_column(kind, column, values);
  if (n < 2) fail_msg("%s has no column %s", kind, column);
  char head[128];
  snprintf(head, sizeof head, "<tr><td>%s</td>", row);
  const char *end, *section = section_of(figure, &end), *cells = find(section, end, head);
  if (!cells) fail_msg("%s: '%s' is not in the table", kind, row);
  cells += strlen(head);
  for (int i = 0; i < n; ++i) {
    double value, change = 0;
    int is_negative = 0;
    assert_int_equal(sscanf(cells, "<td>%lf", &value), 1);
    assert_true(fabs(value - values[i]) <= 0.005 + 1e-9);
    const char *next = strstr(cells, "</td>"), *bracket = find(cells, next, "(");
    assert_non_null(next);
    if (strcmp(column, "orifice_area") == 0 || i == 0) {
      assert_null(bracket);
    } else {
      assert_non_null(bracket);
      is_negative = find(bracket, next, "\u2212") != NULL;
      assert_int_equal(sscanf(bracket + 1 + (is_negative ? (int)strlen("\u2212") : 0), "%lf", &change), 1);
      assert_true(fabs((is_negative ? -change : change) - 100 * (values[i] / values[0] - 1)) <= 0.05 + 1e-9);
    }
    cells = next + strlen("</td>");
  }
  assert_memory_equal(cells, "</tr>", 5);
}

TEST(test_page_stands_alone) {
  assert_null(strstr(page, "http:")); /* encoded pictures contain no colon */
  assert_null(strstr(page, "https:"));
  assert_null(strstr(page, "<script"));
  assert_null(strstr(page, "<link"));
  for (const char *source = page; (source = strstr(source, "src=\"")); ++source)
    assert_memory_equal(source, "src=\"data:image/png;base64,", strlen("src=\"data:image/png;base64,"));
  assert_null(strstr(page, " nan"));
  assert_non_null(strstr(page, "</html>"));
}

/* The page has the figures from the JSON file after the program's own figures. */
TEST(test_given_figures) {
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

/* Faults of these figures are reported before the program draws anything. */
TEST(test_given_figures_refused) {
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

/* The page says which figures are missing. */
TEST(test_left_out) {
  const char *section = strstr(page, "<section id=\"left-out\">");
  assert_non_null(section);
  const char *end = strstr(section, "</section>");
  assert_non_null(find(section, end, "Not on this page"));
  assert_non_null(find(section, end, "<li>Peers: not measured.</li>"));
  assert_non_null(find(section, end, "<li>Threads: as well.</li>"));
  assert_non_null(find(section, end, "<li>The states of the aortic valve: "));
  assert_null(find(section, end, "states of the mitral valve"));
}

TEST(test_refusals) {
  assert_int_equal(run_program(""), 2);
  assert_int_equal(run_program(scratch_path("no_folder/figures.html")), 1);
  char *printed = scratch_read(scratch_path("printed"), NULL);
  assert_non_null(strstr(printed, "figures.html: cannot be written"));
  free(printed);
}

TEST(test_tables_of_states) {
  const int trileaflet = n_of_paper + 1, coapting = trileaflet + 1, mitral = coapting + 1, bileaflet = mitral + 1;
  expect_row("trileaflet", trileaflet, "right cusp: free edge (cm)", "right_edge");
  expect_row("trileaflet", trileaflet, "non-coronary cusp: area (cm²)", "non_coronary_area");
  expect_row("trileaflet", trileaflet, "orifice (cm²)", "orifice_area");
  expect_row("coapting", coapting, "left cusp: free edge (cm)", "left_edge");
  expect_row("coapting", coapting, "right cusp: area (cm²)", "right_area");
  expect_row("coapting", coapting, "orifice (cm²)", "orifice_area");
  expect_row("mitral", mitral, "anterior leaflet: free edge (cm)", "anterior_edge");
  expect_row("mitral", mitral, "posterior leaflet: free edge (cm)", "posterior_edge");
  expect_row("mitral", mitral, "posterior leaflet: area (cm²)", "posterior_area");
  expect_row("mitral", mitral, "orifice (cm²)", "orifice_area");
  expect_row("bileaflet", bileaflet, "leaflet x &lt; 0: area (cm²)", "leaflet_1_area");
  expect_row("bileaflet", bileaflet, "orifice (cm²)", "orifice_area");
  const char *end, *section = section_of(bileaflet, &end);
  assert_null(find(section, end, "free edge (cm)"));
}

/* Each opening has a picture from above and one from the side. */
TEST(test_pictures_of_states) {
  for (int i = 0; i < n_kinds; ++i) {
    const char *end, *section = section_of(n_of_paper + 1 + i, &end);
    int n_pictures = 0;
    for (const char *image = section; (image = find(image, end, "<img ")); ++image) ++n_pictures;
    assert_int_equal(n_pictures, 2 * n_openings[i]);
    double openings[8];
    assert_int_equal(read_column(kinds[i], "opening", openings), n_openings[i]);
    for (int k = 0; k < n_openings[i]; ++k) {
      char text[64];
      snprintf(text, sizeof text, "Opening %.3g, from ", openings[k]);
      const char *above = find(section, end, text);
      assert_non_null(above);
      assert_non_null(find(above + 1, end, text));
    }
  }
}

/* The table of parameters has every parameter of every kind, with its description. */
TEST(test_parameters_of_all_kinds) {
  static const char *const all[] = {"aortic", "trileaflet", "coapting", "mitral", "bileaflet"};
  const char *section = strstr(page, "<section id=\"parameters\">");
  assert_non_null(section);
  for (size_t k = 0; k < sizeof all / sizeof *all; ++k) {
    char summary[64];
    snprintf(summary, sizeof summary, "<summary>%s valve: ", all[k]);
    const char *begin = strstr(section, summary);
    assert_non_null(begin);
    const char *end = strstr(begin, "</details>");
    riis_valve *valve = NULL;
    int64_t n = 0;
    assert_int_equal(riis_valve_create(all[k], &valve), RIIS_OK);
    assert_int_equal(riis_valve_get_n_parameters(valve, &n), RIIS_OK);
    for (int64_t i = 0; i < n; ++i) {
      riis_parameter parameter;
      char name[256];
      assert_int_equal(riis_valve_get_parameter(valve, i, &parameter, sizeof parameter), RIIS_OK);
      snprintf(name, sizeof name, "<tr><td><code>%s</code></td>", parameter.name);
      const char *row = find(begin, end, name);
      if (!row) fail_msg("%s: %s is not in the table", all[k], parameter.name);
      assert_non_null(find(row, strstr(row, "</tr>"), parameter.description));
    }
    riis_valve_destroy(&valve);
  }
}

/* Faults of the tables of states are also reported. */
TEST(test_tables_refused) {
  const struct {
    const char *name, *table, *text;
  } wrong[] = {{"mitral.csv", "", "mitral.csv: cannot be read"},
               {"mitral.csv", "opening\n", "mitral.csv: no table of openings"},
               {"mitral.csv", "time,orifice_area\n0,1\n", "mitral.csv: no table of openings"},
               {"mitral.csv", "opening,a_area,b_area\n0,1,1\n1,2\n", "mitral.csv: line 3: 2 cells under 3 names"},
               {"mitral.csv", "opening,a_area,b_area\n0,1,1\n1,2,two\n", "mitral.csv: line 3: 'two' is no number"},
               {"mitral.csv", "opening,a_area,b_area\n0,1,nan\n", "mitral.csv: line 2: 'nan' is no number"},
               {"mitral.csv", "opening,a_area,b_length\n0,1,1\n", "mitral.csv: 'b_length' is no measure of a state"},
               {"mitral.csv", "opening,a_area\n0,1\n", "mitral.csv: 1 leaflets have an area, not 2"},
               {"mitral.csv", "opening,a_area,b_area\n0,1,1\n2,1,1\n", "mitral.csv: opening 2 is not from 0 to 1"},
               {"mitral.csv", "opening,a_area,b_area\n0,1,1\n.1,1,1\n.2,1,1\n.3,1,1\n.4,1,1\n.5,1,1\n1,1,1\n",
                "mitral.csv: 7 openings are more than 6"},
               {"tricuspid.csv", "opening,a_area,b_area\n0,1,1\n",
                "tricuspid.csv: the page has no states of a valve 'tricuspid'"}};
  for (size_t i = 0; i < sizeof wrong / sizeof *wrong; ++i) {
    char arguments[1024];
    scratch_write_text(wrong[i].name, wrong[i].table);
    const int n = snprintf(arguments, sizeof arguments, "%s", scratch_path("wrong.html"));
    snprintf(arguments + n, sizeof arguments - (size_t)n, " %s", scratch_path(wrong[i].name));
    assert_int_equal(run_refused(arguments), 1);
    char *printed = scratch_read(scratch_path("printed"), NULL);
    if (!strstr(printed, wrong[i].text)) fail_msg("'%s' is not in '%s'", wrong[i].text, printed);
    assert_null(strstr(printed, "figure 1"));
    free(printed);
  }
}

int main(int argc, char **argv) {
  (void)argc;
  enter_virtual_display(argv);
  return run_cases(draw_page, remove_page);
}
