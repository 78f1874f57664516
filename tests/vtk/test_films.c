/* SPDX-License-Identifier: Apache-2.0
 *
 * Each frame of a film shows the present surface and mesh, without anything from the frame before. The camera does not move. */
#include <math.h>
#include <riis/riis_vtk.h>
#include <stdlib.h>
#include <string.h>

#include "expect.h"
#include "scratch.h"
#include "virtual_display.h"
#include "vtk_shim.h"

static const double lower[3] = {-3, -3, -2}, upper[3] = {3, 3, 2};
static riis_vtk_mesh *mesh;
static riis_valve *valve;
static riis_surface *surface;

static int make_all(void **state) {
  scratch_setup(state);
  assert_int_equal(shim_write_box(scratch_path("in.vtu"), SHIM_RAW, 15, lower, upper, 0), 1);
  expect_fine(riis_vtk_mesh_read(scratch_path("in.vtu"), &mesh));
  expect_fine(riis_valve_create("mitral", &valve));
  expect_fine(riis_surface_create(valve, NULL, &surface));
  return 0;
}

static int destroy_all(void **state) {
  riis_surface_destroy(&surface);
  riis_valve_destroy(&valve);
  riis_vtk_mesh_destroy(&mesh);
  return scratch_teardown(state);
}

/* Moves the valve, and marks the mesh again. */
static void open_valve(double opening) {
  riis_mesh *nodes = NULL;
  riis_marks *result = NULL;
  riis_surface_options options;
  int64_t n = 0;
  const double *xyz = NULL;
  expect_fine(riis_surface_options_init(&options, sizeof options));
  options.half_thickness = 0.4;
  expect_fine(riis_valve_set_scalar(valve, "opening", opening));
  expect_fine(riis_surface_update(surface, valve, &options));
  expect_fine(riis_vtk_mesh_get_nodes(mesh, &n, NULL, &xyz));
  expect_fine(riis_mesh_create(n, xyz, xyz + 1, xyz + 2, 3, &nodes));
  expect_fine(riis_marks_create(&result));
  expect_fine(riis_mark_nodes(surface, nodes, NULL, result));
  expect_fine(riis_vtk_mesh_set_marks(mesh, result, -1, NULL));
  riis_marks_destroy(&result);
  riis_mesh_destroy(&nodes);
}

static riis_vtk_film *make_film(const riis_vtk_mesh *of) {
  riis_vtk_film *film = NULL;
  riis_vtk_picture_options options;
  /* The film copies the names of views, so the caller may change the names later. */
  char names[2][16] = {"front", "back"};
  const char *pointers[2] = {names[0], names[1]};
  expect_fine(riis_vtk_picture_options_init(&options, sizeof options));
  options.width = 800;
  options.height = 400;
  options.view = RIIS_VTK_VIEW_SIDE;
  options.leaflet_names = pointers;
  options.n_leaflet_names = 2;
  expect_fine(riis_vtk_film_create(of, lower, upper, &options, &film));
  memset(names, 'x', sizeof names);
  names[0][15] = names[1][15] = 0;
  return film;
}

static void draw_frame(riis_vtk_film *film, const char *title, const char *name) {
  scratch_watch_output();
  const riis_status status = riis_vtk_film_draw(film, surface, title, scratch_path(name));
  const long n_printed = scratch_end_watch();
  expect_fine(status);
  assert_int_equal(n_printed, 0);
}

static int same_pixels(const char *a, const char *b, int first_row, int n_rows) {
  int size[2][2];
  unsigned char *pixels[2] = {shim_read_pixels(scratch_path(a), &size[0][0], &size[0][1]),
                              shim_read_pixels(scratch_path(b), &size[1][0], &size[1][1])};
  assert_true(pixels[0] && pixels[1] && size[0][0] == 800 && size[0][1] == 400 && size[1][0] == 800);
  const size_t row = 3 * 800;
  const int same =
      memcmp(pixels[0] + row * (size_t)first_row, pixels[1] + row * (size_t)first_row, row * (size_t)n_rows) == 0;
  free(pixels[0]);
  free(pixels[1]);
  return same;
}

static void expect_drawn(const char *name) {
  int width = 0, height = 0, n_colours = 0, n_coloured[2] = {0, 0};
  assert_int_equal(shim_read_png(scratch_path(name), &width, &height, &n_colours, n_coloured), 1);
  assert_true(width == 800 && height == 400 && n_colours > 100 && n_coloured[0] > 4000 && n_coloured[1] > 4000);
}

TEST(test_frames) {
  riis_vtk_film *film = make_film(mesh);
  open_valve(0);
  draw_frame(film, "Frame", "closed.png");
  open_valve(1);
  draw_frame(film, "Frame", "open.png");
  open_valve(0);
  draw_frame(film, "Frame", "again.png");
  riis_vtk_film_destroy(&film);
  assert_null(film);
  expect_drawn("closed.png");
  expect_drawn("open.png");
  assert_true(same_pixels("closed.png", "again.png", 0, 400));
  assert_false(same_pixels("closed.png", "open.png", 0, 400));
  /* The axes, the colour key and the scale bar stay. */
  assert_true(same_pixels("closed.png", "open.png", 0, 30));
  /* A second film of this state draws an equal picture, without anything from the first film. */
  film = make_film(mesh);
  open_valve(1);
  draw_frame(film, "Frame", "other.png");
  draw_frame(film, NULL, "untitled.png");
  riis_vtk_film_destroy(&film);
  assert_true(same_pixels("open.png", "other.png", 0, 400));
  assert_false(same_pixels("other.png", "untitled.png", 300, 100));
}

/* The mesh may be destroyed before the film. Without a mesh the film shows only the surface. */
TEST(test_lifetime) {
  riis_vtk_mesh *own = NULL;
  int n[2][2] = {{0, 0}, {0, 0}}, width = 0, height = 0, n_colours = 0;
  open_valve(1);
  expect_fine(riis_vtk_mesh_write(mesh, scratch_path("marked.vtu")));
  expect_fine(riis_vtk_mesh_read(scratch_path("marked.vtu"), &own));
  riis_vtk_film *film = make_film(own);
  riis_vtk_mesh_destroy(&own);
  draw_frame(film, "Frame", "alone.png");
  riis_vtk_film_destroy(&film);
  assert_true(same_pixels("open.png", "alone.png", 0, 400));
  film = make_film(NULL);
  draw_frame(film, "Frame", "surface.png");
  riis_vtk_film_destroy(&film);
  assert_int_equal(shim_read_png(scratch_path("surface.png"), &width, &height, &n_colours, n[0]), 1);
  assert_int_equal(shim_read_png(scratch_path("alone.png"), &width, &height, &n_colours, n[1]), 1);
  assert_true(n[0][0] > 4000 && abs(n[0][0] - n[0][1]) < n[0][0]);
  riis_vtk_film_destroy(NULL);
  riis_vtk_film_destroy(&film);
}

TEST(test_refusals) {
  const double bad[3] = {-3, NAN, -2}, turned[3] = {-3, -4, 2};
  riis_vtk_film *film = NULL;
  riis_vtk_mesh *plain = NULL;
  riis_vtk_picture_options options;
  const char *path = scratch_path("r.png");
  expect_refused(riis_vtk_film_create(mesh, NULL, upper, NULL, &film), RIIS_INVALID_ARGUMENT, "lower is NULL");
  expect_refused(riis_vtk_film_create(mesh, lower, NULL, NULL, &film), RIIS_INVALID_ARGUMENT, "upper is NULL");
  expect_refused(riis_vtk_film_create(mesh, lower, upper, NULL, NULL), RIIS_INVALID_ARGUMENT, "film is NULL");
  expect_refused(riis_vtk_film_create(mesh, bad, upper, NULL, &film), RIIS_INVALID_ARGUMENT,
                 "lower[1] is nan, upper[1] is 3");
  expect_refused(riis_vtk_film_create(mesh, lower, turned, NULL, &film), RIIS_INVALID_ARGUMENT, "upper[1] is -4");
  expect_fine(riis_vtk_picture_options_init(&options, sizeof options));
  options.view = 99;
  expect_refused(riis_vtk_film_create(mesh, lower, upper, &options, &film), RIIS_INVALID_ARGUMENT,
                 "options->view is 99");
  assert_null(film);
  film = make_film(mesh);
  expect_refused(riis_vtk_film_draw(NULL, surface, NULL, path), RIIS_INVALID_ARGUMENT, "film is NULL");
  expect_refused(riis_vtk_film_draw(film, NULL, NULL, path), RIIS_INVALID_ARGUMENT, "surface is NULL");
  expect_refused(riis_vtk_film_draw(film, surface, NULL, NULL), RIIS_INVALID_ARGUMENT, "path is NULL");
  expect_refused(riis_vtk_film_draw(film, surface, NULL, scratch_path("r.jpg")), RIIS_FILE_ERROR, "must be .png");
  riis_vtk_film_destroy(&film);
  expect_fine(riis_vtk_mesh_read(scratch_path("in.vtu"), &plain));
  film = make_film(plain);
  expect_refused(riis_vtk_film_draw(film, surface, NULL, path), RIIS_INVALID_ARGUMENT, "mesh has no marks");
  riis_vtk_film_destroy(&film);
  riis_vtk_mesh_destroy(&plain);
  assert_false(scratch_exists("r.png"));
}

int main(int argc, char **argv) {
  (void)argc;
  enter_virtual_display(argv);
  return run_cases(make_all, destroy_all);
}
