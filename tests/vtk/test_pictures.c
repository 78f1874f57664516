/* SPDX-License-Identifier: Apache-2.0
 *
 * Pictures, under a virtual display: of the size that was asked for, not blank, one panel or two, different for each
 * view. */
#include <riis/riis_vtk.h>
#include <signal.h>
#include <stdint.h>
#include <stdlib.h>
#include <sys/resource.h>

#include "expect.h"
#include "scratch.h"
#include "virtual_display.h"
#include "vtk_shim.h"

static riis_surface *surface;
static riis_vtk_mesh *mesh;

static int make_all(void **state) {
  const double lower[3] = {-1.7, -1.7, -1.3}, upper[3] = {1.7, 1.7, 0.4};
  riis_valve *valve = NULL;
  riis_mesh *nodes = NULL;
  riis_mark_result *result = NULL;
  riis_surface_options options;
  int64_t n = 0;
  const double *xyz = NULL;
  scratch_setup(state);
  expect_fine(riis_valve_create("aortic", &valve));
  expect_fine(riis_surface_options_init(&options, sizeof options));
  options.half_thickness = 0.2;
  expect_fine(riis_surface_create(valve, &options, &surface));
  riis_valve_destroy(&valve);
  assert_int_equal(shim_write_box(scratch_path("in.vtu"), SHIM_RAW, 21, lower, upper, 0), 1);
  expect_fine(riis_vtk_mesh_read(scratch_path("in.vtu"), &mesh));
  expect_fine(riis_vtk_mesh_nodes(mesh, &n, NULL, &xyz));
  expect_fine(riis_mesh_create(n, xyz, xyz + 1, xyz + 2, 3, &nodes));
  expect_fine(riis_mark_result_create(&result));
  expect_fine(riis_mark_nodes(surface, nodes, NULL, result));
  expect_fine(riis_vtk_mesh_set_marks(mesh, result, -1));
  riis_mark_result_destroy(&result);
  riis_mesh_destroy(&nodes);
  return 0;
}

static int destroy_all(void **state) {
  riis_vtk_mesh_destroy(&mesh);
  riis_surface_destroy(&surface);
  return scratch_teardown(state);
}

static void draw(const char *name, const riis_vtk_mesh *drawn, int32_t view, int32_t width, int32_t height) {
  riis_vtk_picture_options options;
  expect_fine(riis_vtk_picture_options_init(&options, sizeof options));
  options.view = view;
  options.width = width;
  options.height = height;
  scratch_watch_output();
  const riis_status status = riis_vtk_draw(surface, drawn, &options, scratch_path(name));
  const long n_printed = scratch_end_watch();
  expect_fine(status);
  assert_int_equal(n_printed, 0);
}

/* The picture has this size, many colours, and colour on a good part of both halves. */
static void expect_picture(const char *name, int expected_width, int expected_height) {
  int width = 0, height = 0, n_colours = 0, n_coloured[2] = {0, 0};
  assert_int_equal(shim_read_png(scratch_path(name), &width, &height, &n_colours, n_coloured), 1);
  assert_int_equal(width, expected_width);
  assert_int_equal(height, expected_height);
  assert_true(n_colours > 100);
  assert_true(n_coloured[0] > width * height / 40 && n_coloured[1] > width * height / 40);
}

static void test_views(void **state) {
  (void)state;
  const int n_before = scratch_n_files();
  draw("side.png", mesh, RIIS_VTK_VIEW_SIDE, 800, 400);
  draw("top.png", mesh, RIIS_VTK_VIEW_TOP, 800, 400);
  draw("oblique.png", mesh, RIIS_VTK_VIEW_OBLIQUE, 800, 400);
  assert_int_equal(scratch_n_files(), n_before + 3);
  const char *names[3] = {"side.png", "top.png", "oblique.png"};
  for (int i = 0; i < 3; ++i) {
    expect_picture(names[i], 800, 400);
    size_t size[2] = {0, 0};
    char *bytes[2] = {scratch_read(scratch_path(names[i]), &size[0]),
                      scratch_read(scratch_path(names[(i + 1) % 3]), &size[1])};
    assert_true(size[0] != size[1] || memcmp(bytes[0], bytes[1], size[0]) != 0);
    free(bytes[0]);
    free(bytes[1]);
  }
}

static void test_one_panel(void **state) {
  (void)state;
  draw("alone.png", NULL, RIIS_VTK_VIEW_TOP, 300, 500);
  expect_picture("alone.png", 300, 500);
  draw("small.png", mesh, RIIS_VTK_VIEW_TOP, 64, 64);
  int width = 0, height = 0, n_colours = 0, n_coloured[2];
  assert_int_equal(shim_read_png(scratch_path("small.png"), &width, &height, &n_colours, n_coloured), 1);
  assert_true(width == 64 && height == 64 && n_colours > 1);
}

static int same_file(const char *a, const char *b) {
  size_t size[2] = {0, 0};
  char *bytes[2] = {scratch_read(scratch_path(a), &size[0]), scratch_read(scratch_path(b), &size[1])};
  const int same = size[0] == size[1] && memcmp(bytes[0], bytes[1], size[0]) == 0;
  free(bytes[0]);
  free(bytes[1]);
  return same;
}

static void draw_texts(const char *name, const char *title, const char *const *names, int64_t n_names) {
  riis_vtk_picture_options options;
  expect_fine(riis_vtk_picture_options_init(&options, sizeof options));
  options.title = title;
  options.leaflet_names = names;
  options.n_leaflet_names = n_names;
  scratch_watch_output();
  const riis_status status = riis_vtk_draw(surface, mesh, &options, scratch_path(name));
  const long n_printed = scratch_end_watch();
  expect_fine(status);
  assert_int_equal(n_printed, 0);
}

/* The texts are seen; what is no ASCII is drawn as ?, and nothing is taken for a formula. */
static void test_texts(void **state) {
  (void)state;
  const char *names[3] = {"right", "left", "leaflet 2"};
  draw_texts("plain.png", NULL, NULL, 0);
  draw_texts("default.png", "Surface", (const char *const[]){"leaflet 0"}, 1);
  assert_true(same_file("plain.png", "default.png"));
  draw_texts("title.png", "Valve", NULL, 0);
  assert_false(same_file("plain.png", "title.png"));
  draw_texts("names.png", NULL, names, 2);
  assert_false(same_file("plain.png", "names.png"));
  draw_texts("more.png", NULL, names, 3);
  assert_true(same_file("names.png", "more.png"));
  draw_texts("odd.png", "a\nb \xff\xc3 $x^2$ | 7", (const char *const[]){"\xe4", "", "$"}, 3);
  draw_texts("marked.png", "a?b ?? $x^2$ | 7", (const char *const[]){"?", "", "$"}, 3);
  assert_true(same_file("odd.png", "marked.png"));
}

/* A mesh of which nothing is marked still gives a picture. */
static void test_nothing_marked(void **state) {
  (void)state;
  const double lower[3] = {5, 5, 5}, upper[3] = {6, 6, 6};
  riis_vtk_mesh *other = NULL;
  riis_mesh *nodes = NULL;
  riis_mark_result *result = NULL;
  const double *xyz = NULL;
  assert_int_equal(shim_write_box(scratch_path("far.vtu"), SHIM_RAW, 3, lower, upper, 0), 1);
  expect_fine(riis_vtk_mesh_read(scratch_path("far.vtu"), &other));
  expect_fine(riis_vtk_mesh_nodes(other, NULL, NULL, &xyz));
  expect_fine(riis_mesh_create(27, xyz, xyz + 1, xyz + 2, 3, &nodes));
  expect_fine(riis_mark_result_create(&result));
  expect_fine(riis_mark_nodes(surface, nodes, NULL, result));
  expect_fine(riis_vtk_mesh_set_marks(other, result, -1));
  draw("far.png", other, RIIS_VTK_VIEW_OBLIQUE, 400, 200);
  assert_int_equal(scratch_exists("far.png"), 1);
  riis_mark_result_destroy(&result);
  riis_mesh_destroy(&nodes);
  riis_vtk_mesh_destroy(&other);
}

/* With room for n_bytes a file, as on a disk that fills up, there is no picture and nothing beside it. */
static void test_full_disk(void **state) {
  (void)state;
  struct rlimit limit, small;
  getrlimit(RLIMIT_FSIZE, &limit);
  void (*handler)(int) = signal(SIGXFSZ, SIG_IGN);
  const int n_before = scratch_n_files();
  const rlim_t rooms[] = {1, 100, 5000, 9000};
  for (size_t i = 0; i < sizeof rooms / sizeof rooms[0]; ++i) {
    small = limit;
    small.rlim_cur = rooms[i];
    scratch_watch_output();
    setrlimit(RLIMIT_FSIZE, &small);
    const riis_status status = riis_vtk_draw(surface, NULL, NULL, scratch_path("full.png"));
    setrlimit(RLIMIT_FSIZE, &limit);
    assert_int_equal(scratch_end_watch(), 0);
    expect_refused(status, RIIS_FILE_ERROR, "full.png: ");
    assert_int_equal(scratch_n_files(), n_before);
  }
  signal(SIGXFSZ, handler);
}

static void test_refusals(void **state) {
  (void)state;
  const int n_before = scratch_n_files();
  expect_refused(riis_vtk_draw(surface, NULL, NULL, scratch_path("a.jpg")), RIIS_FILE_ERROR, "must be .png");
  expect_refused(riis_vtk_draw(surface, NULL, NULL, scratch_path("no_folder/a.png")), RIIS_FILE_ERROR, "a.png: ");
  assert_int_equal(scratch_n_files(), n_before);
}

int main(int argc, char **argv) {
  (void)argc;
  enter_virtual_display(argv);
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(test_texts),          cmocka_unit_test(test_views),     cmocka_unit_test(test_one_panel),
      cmocka_unit_test(test_nothing_marked), cmocka_unit_test(test_full_disk), cmocka_unit_test(test_refusals),
  };
  return cmocka_run_group_tests(tests, make_all, destroy_all);
}
