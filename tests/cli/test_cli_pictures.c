/* SPDX-License-Identifier: Apache-2.0
 *
 * If there is no display and no program that makes one, --picture ends with one line and exit code 1. With a display, each
 * --picture writes one file, and each may have a different view. */
#include <riis/riis_vtk.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "expect.h"
#include "program.h"
#include "scratch.h"
#include "virtual_display.h"
#include "vtk_shim.h"

/* test_virtual_display.py covers displays that the program makes. In this test, no program in PATH can make a display. */
TEST(test_without_display) {
  const char *const before[2] = {getenv("DISPLAY"), getenv("PATH")};
  char kept[2][4096] = {"", ""};
  for (int i = 0; i < 2; ++i)
    if (before[i]) snprintf(kept[i], sizeof kept[i], "%s", before[i]);
  unsetenv("DISPLAY");
  setenv("PATH", "/nowhere", 1);
  RUN_REFUSED(
      1,
      "DISPLAY is not set, and Xvfb, which makes one without a screen, is not on the PATH; on Debian the package "
      "xvfb has it",
      "mark", scratch_path("in.vtu"), "--picture", scratch_path("none.png"));
  assert_int_equal(scratch_exists("none.png"), 0);
  /* The refusal comes before any work. The mesh is also missing, but the message names only the fault of the picture. */
  RUN_REFUSED(1, "DISPLAY is not set", "mark", scratch_path("missing.vtu"), "--picture", scratch_path("none.png"));
  setenv("DISPLAY", ":7654", 1);
  /* The run has marked nodes before it fails, so it writes the other requested files. */
  RUN_REFUSED(1, "DISPLAY :7654 cannot be used, and Xvfb", "mark", scratch_path("in.vtu"), "--picture",
              scratch_path("none.png"), "--output", scratch_path("out.vtu"), "--stats", scratch_path("stats.json"));
  assert_int_equal(scratch_exists("none.png"), 0);
  assert_true(scratch_exists("out.vtu"));
  char *json = scratch_read(scratch_path("stats.json"), NULL);
  assert_true(json_number(json, "n_nodes") == n_box);
  free(json);
  before[0] ? setenv("DISPLAY", kept[0], 1) : unsetenv("DISPLAY");
  before[1] ? setenv("PATH", kept[1], 1) : unsetenv("PATH");
}

static void expect_picture(const char *name) {
  int width = 0, height = 0, n_colours = 0, n_coloured[2] = {0, 0};
  assert_int_equal(shim_read_png(scratch_path(name), &width, &height, &n_colours, n_coloured), 1);
  assert_int_equal(width, 1600);
  assert_int_equal(height, 800);
  assert_true(n_colours > 100);
  assert_true(n_coloured[0] > 30000 && n_coloured[1] > 30000);
}

TEST(test_pictures) {
  RUN_FINE("mark", scratch_path("in.vtu"), "--half-thickness", "0.3", "--picture", scratch_path("1.png"), "--view",
           "top", "--picture", scratch_path("2.png"), "--view", "side", "--picture", scratch_path("3.png"));
  expect_picture("1.png");
  expect_picture("2.png");
  expect_picture("3.png");
  assert_non_null(strstr(program_out, "3.png"));
  /* The third picture had no --view, so its view is oblique. */
  RUN_FINE("mark", "--half-thickness", "0.3", "--picture", scratch_path("4.png"), scratch_path("in.vtu"), "--view",
           "oblique");
  assert_true(scratch_is_same("3.png", "4.png"));
  assert_false(scratch_is_same("1.png", "2.png"));
  assert_false(scratch_is_same("1.png", "3.png"));
  assert_false(scratch_is_same("2.png", "3.png"));
  /* The name of the array does not change how marks are drawn. */
  RUN_FINE("mark", "--half-thickness", "0.3", "--picture", scratch_path("5.png"), scratch_path("in.vtu"), "--prefix",
           "left", "--output", scratch_path("left.vtu"));
  assert_true(scratch_is_same("3.png", "5.png"));
}

/* Most pictures of this test are small, because drawing takes most of its time. */
#define SMALL_PICTURE "--picture-size", "800x400"

static riis_vtk_picture_options small_picture(void) {
  riis_vtk_picture_options options;
  expect_fine(riis_vtk_picture_options_init(&options, sizeof options));
  options.width = 800;
  options.height = 400;
  return options;
}

/* Returns the title as a caption has it, with the orifice and the half thickness. The surface is in centimetres. */
static const char *with_sizes(const char *title, const riis_surface *surface) {
  static char text[256];
  riis_orifice orifice;
  riis_surface_info info;
  expect_fine(riis_surface_get_orifice(surface, NULL, &orifice, sizeof orifice));
  expect_fine(riis_surface_get_info(surface, &info, sizeof info));
  snprintf(text, sizeof text, "%s, orifice %.2f cm2\nhalf thickness %.3g mm", title, orifice.area,
           10 * info.half_thickness);
  return text;
}

/* Compares two pictures of a valve. The program draws one picture, and the C interface draws the other with the expected
 * title. */
static void expect_title(const char *title, const char *valve_name, const char *kind, const char *setting,
                         const char *value) {
  riis_valve *valve = NULL;
  riis_surface *surface = NULL;
  riis_vtk_picture_options options = small_picture();
  static const char *const names[3] = {"right", "left", "non-coronary"}, *const names_of_two[2] = {"cusp 0", "cusp 1"};
  const int is_bicuspid = strcmp(kind, "bicuspid") == 0;
  RUN_FINE("surface", "--valve", valve_name, "--picture", scratch_path("by_program.png"), SMALL_PICTURE, setting,
           value);
  expect_fine(riis_valve_create(kind, &valve));
  /* The title contains the value that the valve in the picture has. */
  const char *const number = strchr(value, '=') + 1;
  char name[64];
  snprintf(name, sizeof name, "%.*s", (int)(number - 1 - value), value);
  expect_fine(riis_valve_set_scalar(valve, name, strtod(number, NULL)));
  expect_fine(riis_surface_create(valve, NULL, &surface));
  options.title = with_sizes(title, surface);
  options.leaflet_names = is_bicuspid ? names_of_two : names;
  options.n_leaflet_names = is_bicuspid ? 2 : 3;
  options.unit = "cm";
  expect_fine(riis_vtk_draw(surface, NULL, &options, scratch_path("by_c.png")));
  assert_true(scratch_is_same("by_program.png", "by_c.png"));
  riis_surface_destroy(&surface);
  riis_valve_destroy(&valve);
}

/* Draws a placed mitral valve. The unit of the valve's mesh may be NULL. `scale` converts centimetres to this unit. */
static void draw_by_c(const riis_surface_options *placement, const char *unit, int32_t view) {
  riis_valve *valve = NULL;
  riis_surface *surface = NULL;
  riis_orifice orifice;
  riis_surface_info info;
  char title[256];
  riis_vtk_picture_options options = small_picture();
  expect_fine(riis_valve_create("mitral", &valve));
  expect_fine(riis_valve_set_scalar(valve, "opening", 0.5));
  expect_fine(riis_surface_create(valve, placement, &surface));
  expect_fine(riis_surface_get_orifice(surface, NULL, &orifice, sizeof orifice));
  expect_fine(riis_surface_get_info(surface, &info, sizeof info));
  const double scale = unit ? placement->scale : 1;
  snprintf(title, sizeof title, unit ? "%s %.2f cm2\nhalf thickness %.3g mm" : "%s %.3g\nhalf thickness %.3g",
           "Mitral valve, opening 0.5, orifice", orifice.area / (scale * scale),
           (unit ? 10 : 1) * info.half_thickness / scale);
  options.title = title;
  options.leaflet_names = (const char *const[]){"anterior", "posterior"};
  options.n_leaflet_names = 2;
  options.unit = unit;
  options.view = view;
  memcpy(options.rotation_axis, placement->rotation_axis, sizeof options.rotation_axis);
  options.rotation_angle = placement->rotation_angle;
  expect_fine(riis_vtk_draw(surface, NULL, &options, scratch_path("by_c.png")));
  riis_surface_destroy(&surface);
  riis_valve_destroy(&valve);
}

/* Views by the valve's axes get these axes from --rotate. Without --unit, the scale shows the unit of the mesh if it is a usual
 * factor from centimetres. */
TEST(test_valve_views) {
  static const char *const names[5] = {"valve-side", "valve-top", "valve-oblique", "valve-three", "valve-long"};
  riis_surface_options placement;
  expect_fine(riis_surface_options_init(&placement, sizeof placement));
  memcpy(placement.rotation_axis, (const double[3]){1, -2, 0.5}, sizeof placement.rotation_axis);
  placement.rotation_angle = 70;
  for (int i = 0; i < 5; ++i) {
    static const char *const scales[5] = {"10", "0.01", "1", "3", "1"}, *const units[5] = {"mm", "m", "cm", NULL, "cm"};
    RUN_FINE("surface", "--valve", "mitral", "--opening", "0.5", "--rotate", "1,-2,0.5,70", "--scale", scales[i],
             "--picture", scratch_path("by_program.png"), SMALL_PICTURE, "--view", names[i]);
    placement.scale = strtod(scales[i], NULL);
    draw_by_c(&placement, units[i], RIIS_VTK_VIEW_VALVE_SIDE + i);
    assert_true(scratch_is_same("by_program.png", "by_c.png"));
  }
}

/* The title must say that the paper's aortic valve is not closed. For a disease, the title has its name instead of the kind. */
TEST(test_titles) {
  expect_title("Aortic valve, opening 0 (the paper's, not closed)", "aortic", "aortic", "--set", "opening=0");
  expect_title("Aortic valve, opening 0 (the paper's, not closed)", "aortic", "aortic", "--set",
               "open_radius_ratio=0.9");
  expect_title("Aortic valve, opening 0", "aortic", "aortic", "--set", "leaflet_angle=60");
  expect_title("Bicuspid type 0, opening 0", "bicuspid_type_0", "bicuspid", "--set", "annulus=2.741");
}

/* The scale bar shows the unit that the user named. */
TEST(test_unit) {
  riis_surface_options placement;
  expect_fine(riis_surface_options_init(&placement, sizeof placement));
  placement.scale = 10;
  placement.half_thickness = 1;
  RUN_FINE("surface", "--valve", "mitral", "--opening", "0.5", "--unit", "mm", "--picture",
           scratch_path("by_program.png"), SMALL_PICTURE);
  draw_by_c(&placement, "mm", RIIS_VTK_VIEW_OBLIQUE);
  assert_true(scratch_is_same("by_program.png", "by_c.png"));
}

/* Each option changes the picture as its field in the C interface does. */
TEST(test_looks) {
  riis_valve *valve = NULL;
  riis_surface *surface = NULL;
  riis_vtk_picture_options options;
  RUN_FINE("surface", "--valve", "aortic", "--picture", scratch_path("by_program.png"), "--picture-size", "300x500",
           "--picture-background", "336699", "--picture-captions", "none", "--picture-panels", "valve");
  expect_fine(riis_valve_create("aortic", &valve));
  expect_fine(riis_surface_create(valve, NULL, &surface));
  expect_fine(riis_vtk_picture_options_init(&options, sizeof options));
  options.width = 300;
  options.height = 500;
  memcpy(options.background, (const double[4]){0x33 / 255.0, 0x66 / 255.0, 0x99 / 255.0, 1}, sizeof options.background);
  options.captions = RIIS_VTK_CAPTIONS_NONE;
  options.panels = RIIS_VTK_PANELS_VALVE;
  expect_fine(riis_vtk_draw(surface, NULL, &options, scratch_path("by_c.png")));
  assert_true(scratch_is_same("by_program.png", "by_c.png"));
  memcpy(options.background, (const double[4]){1, 1, 1, 0}, sizeof options.background);
  options.captions = RIIS_VTK_CAPTIONS_SCALE;
  options.unit = "cm";
  expect_fine(riis_vtk_draw(surface, NULL, &options, scratch_path("by_c.png")));
  RUN_FINE("surface", "--valve", "aortic", "--picture", scratch_path("by_program.png"), "--picture-size", "300x500",
           "--picture-background", "transparent", "--picture-captions", "scale");
  assert_true(scratch_is_same("by_program.png", "by_c.png"));
  riis_surface_destroy(&surface);
  riis_valve_destroy(&valve);
}

TEST(test_refused_looks) {
  static const struct {
    const char *option, *value, *text;
  } bad[] = {{"--picture-size", "1600", "--picture-size: 1600 is not WIDTHxHEIGHT, such as 1920x1080"},
             {"--picture-size", "1600x", "--picture-size: 1600x is not WIDTHxHEIGHT"},
             {"--picture-size", "wide", "--picture-size: wide is not WIDTHxHEIGHT"},
             {"--picture-size", "1600x99999", "--picture-size: 1600x99999: 99999 is not from 64 to 8192 pixels"},
             {"--picture-size", "63x64", "--picture-size: 63x64: 63 is not from 64 to 8192 pixels"},
             {"--picture-size", "1e3x800", "--picture-size: 1e3x800 is not WIDTHxHEIGHT"},
             {"--picture-size", "-64x64", "--picture-size: -64x64 is not WIDTHxHEIGHT"},
             {"--picture-background", "red",
              "--picture-background: red is not white, black, transparent, or six hexadecimal digits"},
             {"--picture-background", "12345g", "--picture-background: 12345g is not"},
             {"--picture-background", "", "--picture-background: "},
             {"--picture-captions", "some", "--picture-captions: some not in {all,scale,none}"},
             {"--picture-panels", "left", "--picture-panels: left not in {both,valve,marks}"},
             {"--picture-panels", "marks", "--picture-panels marks: there is no mesh, so nothing is marked"}};
  for (size_t i = 0; i < sizeof bad / sizeof bad[0]; ++i)
    RUN_REFUSED(2, bad[i].text, "surface", "--valve", "aortic", "--picture", scratch_path("no.png"), bad[i].option,
                bad[i].value);
  RUN_REFUSED(2, "--picture-size has no effect without --picture or --movie", "mark", scratch_path("in.vtu"),
              "--picture-size", "100x100");
  RUN_REFUSED(2, "--picture-captions has no effect without --picture", "surface", "--output", scratch_path("no.vtp"),
              "--picture-captions", "none");
  RUN_REFUSED(2, "--picture-velocity has no effect without --picture or --movie", "mark", scratch_path("in.vtu"),
              "--picture-velocity", "U");
  RUN_REFUSED(2, "--picture-velocity has no effect with --picture-panels valve", "mark", scratch_path("in.vtu"),
              "--picture", scratch_path("no.png"), "--picture-velocity", "U", "--picture-panels", "valve");
  RUN_REFUSED(2, "--picture-velocity: U is read at one time, but a movie shows many times", "mark",
              scratch_path("in.vtu"), "--times", "0,1", "--cycle", "no.csv", "--movie", scratch_path("no.gif"),
              "--picture-velocity", "U");
  RUN_REFUSED(2, "--picture-background: a movie cannot be transparent", "mark", scratch_path("in.vtu"), "--times",
              "0,1", "--cycle", "no.csv", "--movie", scratch_path("no.gif"), "--picture-background", "transparent");
  RUN_REFUSED(2, "--picture-size: both numbers must be even for the movie ", "mark", scratch_path("in.vtu"), "--times",
              "0,1", "--cycle", "no.csv", "--movie", scratch_path("no.mp4"), "--picture-size", "101x100");
  assert_int_equal(scratch_exists("no.png"), 0);
}

/* Returns whether two pictures are equal in a part that extends 800 pixels to the right of x0 and 40 pixels upwards from y0. */
static int have_same_part(const char *a, const char *b, int x0, int y0) {
  int size[2];
  unsigned char *rgb[2] = {shim_read_pixels(scratch_path(a), &size[0], &size[1]),
                           shim_read_pixels(scratch_path(b), &size[0], &size[1])};
  int n_dark = 0, is_same = 1;
  for (int y = y0; y < y0 + 40; ++y)
    for (int x = x0; x < x0 + 800; ++x) {
      const size_t at = 3 * ((size_t)y * 1600 + (size_t)x);
      n_dark += rgb[0][at] < 130;
      is_same &= rgb[0][at] == rgb[1][at];
    }
  assert_true(n_dark > 300);
  free(rgb[0]);
  free(rgb[1]);
  return is_same;
}

/* Compares the first line of text above the left panels, and the scale bars below the right panels. */
static int have_same_title(const char *a, const char *b) { return have_same_part(a, b, 0, 800 - 40); }
static int have_same_bar(const char *a, const char *b) { return have_same_part(a, b, 800, 0); }

/* Draws the surface of both.vtp in the marked mesh. */
static void draw_case_by_c(const char *title, const char *unit) {
  riis_vtk_surface *file = NULL;
  riis_surface *surface = NULL;
  riis_surface_arrays arrays;
  riis_vtk_mesh *mesh = NULL;
  riis_vtk_picture_options options;
  riis_marks *result = NULL;
  riis_mesh *nodes = NULL;
  int64_t n = 0;
  const double *xyz = NULL;
  expect_fine(riis_vtk_surface_read(scratch_path("both.vtp"), NULL, &file));
  expect_fine(riis_surface_arrays_init(&arrays, sizeof arrays));
  expect_fine(riis_vtk_surface_get_arrays(file, &arrays, sizeof arrays));
  expect_fine(riis_surface_create_from_arrays(&arrays, NULL, &surface));
  expect_fine(riis_vtk_mesh_read(scratch_path("in.vtu"), &mesh));
  expect_fine(riis_vtk_mesh_get_nodes(mesh, &n, NULL, &xyz));
  expect_fine(riis_mesh_create(n, xyz, xyz + 1, xyz + 2, 3, &nodes));
  expect_fine(riis_marks_create(&result));
  expect_fine(riis_mark_nodes(surface, nodes, NULL, result));
  expect_fine(riis_vtk_mesh_set_marks(mesh, result, -1, NULL));
  expect_fine(riis_vtk_picture_options_init(&options, sizeof options));
  options.title = title;
  options.unit = unit;
  expect_fine(riis_vtk_draw(surface, mesh, &options, scratch_path("by_c.png")));
  riis_marks_destroy(&result);
  riis_mesh_destroy(&nodes);
  riis_vtk_mesh_destroy(&mesh);
  riis_surface_destroy(&surface);
  riis_vtk_surface_destroy(&file);
}

/* Writes two.json with two valves. The program draws the valves, and may warn about sizes. */
static void draw_case(const char *first, const char *second) {
  char text[512];
  snprintf(text, sizeof text, "{\"mesh\": \"in.vtu\", \"half_thickness\": 0.3, \"valves\": [\n%s,\n%s]}\n", first,
           second);
  scratch_write_text("two.json", text);
  run_program("mark", "--case", scratch_path("two.json"), "--picture", scratch_path("by_program.png"),
              "--surface-output", scratch_path("both.vtp"), NULL);
  assert_int_equal(program_exit_code, 0);
}

/* A surface from a file has no opening, so the title and the summary show none. Movies also have this title. Any valve may give
 * the unit of the scale bar. Two valves must not contradict each other. */
TEST(test_cases) {
  static const char aortic[] = "{\"name\": \"aortic\", \"valve\": \"aortic\", \"opening\": 0.5}",
                    small[] = "{\"name\": \"small\", \"valve\": \"aortic\", \"scale\": 0.1}",
                    patient[] = "{\"name\": \"patient\", \"surface\": \"patient.vtp\"}";
  RUN_FINE("surface", "--valve", "trileaflet", "--translate", "0,0,-0.5", "--output", scratch_path("patient.vtp"));
  draw_case(aortic, patient);
  assert_non_null(strstr(program_out, "\nsurface   aortic: aortic valve, opening 0.5: "));
  const char *const line = strstr(program_out, "\nmarked    patient: ");
  assert_non_null(line);
  assert_true(line[20] >= '1' && line[20] <= '9');
  RUN_REFUSED(2, "--view valve-side: there are 2 valves, each with axes of its own; side looks by the mesh's axes",
              "mark", "--case", scratch_path("two.json"), "--picture", scratch_path("no.png"), "--view", "valve-side");
  RUN_REFUSED(2, "--movie-view valve-three: there are 2 valves", "mark", "--case", scratch_path("two.json"), "--times",
              "0,1", "--movie", scratch_path("no.gif"), "--movie-view", "valve-three");
  draw_case_by_c("aortic 0.50, patient", "cm");
  assert_true(have_same_title("by_program.png", "by_c.png") && have_same_bar("by_program.png", "by_c.png"));
  draw_case_by_c("aortic 0.50, patient 0.00", NULL);
  assert_false(have_same_title("by_program.png", "by_c.png") || have_same_bar("by_program.png", "by_c.png"));
  draw_case(patient, aortic);
  draw_case_by_c("", "cm");
  assert_true(have_same_bar("by_program.png", "by_c.png"));
  draw_case(aortic, small);
  draw_case_by_c("", NULL);
  assert_true(have_same_bar("by_program.png", "by_c.png"));
}

int main(int argc, char **argv) {
  (void)argc;
  enter_virtual_display(argv);
  return run_cases(make_box, scratch_teardown);
}
