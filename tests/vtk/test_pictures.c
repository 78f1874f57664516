/* SPDX-License-Identifier: Apache-2.0
 *
 * Draws pictures under a virtual display. The pictures must have the requested size and one or two panels. Blank pictures are a
 * fault, and each view must differ. */
#include <math.h>
#include <riis/riis_vtk.h>
#include <signal.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>

#include "expect.h"
#include "scratch.h"
#include "test_support.h"
#include "virtual_display.h"
#include "vtk_shim.h"

static riis_surface *surface;
static riis_vtk_mesh *mesh;

/* Reads a mesh and marks it. */
static riis_vtk_mesh *marked_by(const riis_surface *valve, const char *name) {
  riis_vtk_mesh *read = NULL;
  riis_mesh *nodes = NULL;
  riis_marks *result = NULL;
  int64_t n_nodes = 0;
  const double *xyz = NULL;
  expect_fine(riis_vtk_mesh_read(scratch_path(name), &read));
  expect_fine(riis_vtk_mesh_get_nodes(read, &n_nodes, NULL, &xyz));
  expect_fine(riis_mesh_create(n_nodes, xyz, xyz + 1, xyz + 2, 3, &nodes));
  expect_fine(riis_marks_create(&result));
  expect_fine(riis_mark_nodes(valve, nodes, NULL, result));
  expect_fine(riis_vtk_mesh_set_marks(read, result, -1, NULL));
  riis_marks_destroy(&result);
  riis_mesh_destroy(&nodes);
  return read;
}

/* Makes a marked box of n x n x n nodes. */
static riis_vtk_mesh *marked_box(const char *name, int n, const double lower[3], const double upper[3]) {
  assert_int_equal(shim_write_box(scratch_path(name), SHIM_RAW, n, lower, upper, 0), 1);
  return marked_by(surface, name);
}

static int make_all(void **state) {
  const double lower[3] = {-1.7, -1.7, -1.3}, upper[3] = {1.7, 1.7, 0.4};
  riis_valve *valve = NULL;
  riis_surface_options options;
  scratch_setup(state);
  expect_fine(riis_valve_create("aortic", &valve));
  expect_fine(riis_surface_options_init(&options, sizeof options));
  options.half_thickness = 0.2;
  expect_fine(riis_surface_create(valve, &options, &surface));
  riis_valve_destroy(&valve);
  mesh = marked_box("in.vtu", 21, lower, upper);
  return 0;
}

static int destroy_all(void **state) {
  riis_vtk_mesh_destroy(&mesh);
  riis_surface_destroy(&surface);
  return scratch_teardown(state);
}

static void draw_by(const riis_vtk_picture_options *options, const char *name, const riis_vtk_mesh *drawn) {
  scratch_watch_output();
  const riis_status status = riis_vtk_draw(surface, drawn, options, scratch_path(name));
  const long n_printed = scratch_end_watch();
  expect_fine(status);
  assert_int_equal(n_printed, 0);
}

static void draw(const char *name, const riis_vtk_mesh *drawn, int32_t view, int32_t width, int32_t height) {
  riis_vtk_picture_options options;
  expect_fine(riis_vtk_picture_options_init(&options, sizeof options));
  options.view = view;
  options.width = width;
  options.height = height;
  draw_by(&options, name, drawn);
}

/* Checks that the picture has this size and many colours. A large part of each half must be coloured. */
static void expect_picture(const char *name, int expected_width, int expected_height) {
  int width = 0, height = 0, n_colours = 0, n_coloured[2] = {0, 0};
  assert_int_equal(shim_read_png(scratch_path(name), &width, &height, &n_colours, n_coloured), 1);
  assert_int_equal(width, expected_width);
  assert_int_equal(height, expected_height);
  assert_true(n_colours > 100);
  assert_true(n_coloured[0] > width * height / 40 && n_coloured[1] > width * height / 40);
}

static void draw_texts(const char *name, const char *title, const char *const *names, int64_t n_names) {
  riis_vtk_picture_options options;
  expect_fine(riis_vtk_picture_options_init(&options, sizeof options));
  options.width = 800;
  options.height = 400;
  options.title = title;
  options.leaflet_names = names;
  options.n_leaflet_names = n_names;
  draw_by(&options, name, mesh);
}

/* The texts are visible. Characters outside ASCII are drawn as ?, and formulas stay plain text. */
TEST(test_texts) {
  const char *names[3] = {"right", "left", "leaflet 2"};
  draw_texts("plain.png", NULL, NULL, 0);
  draw_texts("default.png", "Surface", (const char *const[]){"leaflet 0"}, 1);
  assert_true(scratch_is_same("plain.png", "default.png"));
  draw_texts("title.png", "Valve", NULL, 0);
  assert_false(scratch_is_same("plain.png", "title.png"));
  draw_texts("names.png", NULL, names, 2);
  assert_false(scratch_is_same("plain.png", "names.png"));
  draw_texts("more.png", NULL, names, 3);
  assert_true(scratch_is_same("names.png", "more.png"));
  draw_texts("two.png", "Surface\nhalf thickness", NULL, 0);
  assert_false(scratch_is_same("plain.png", "two.png"));
  draw_texts("odd.png", "a\tb \xff\xc3 $x^2$ | 7", (const char *const[]){"\xe4", "", "$"}, 3);
  draw_texts("marked.png", "a?b ?? $x^2$ | 7", (const char *const[]){"?", "", "$"}, 3);
  assert_true(scratch_is_same("odd.png", "marked.png"));
}

TEST(test_views) {
  const int n_before = scratch_n_files();
  draw("side.png", mesh, RIIS_VTK_VIEW_SIDE, 800, 400);
  draw("top.png", mesh, RIIS_VTK_VIEW_TOP, 800, 400);
  draw("oblique.png", mesh, RIIS_VTK_VIEW_OBLIQUE, 800, 400);
  assert_int_equal(scratch_n_files(), n_before + 3);
  const char *names[3] = {"side.png", "top.png", "oblique.png"};
  for (int i = 0; i < 3; ++i) {
    expect_picture(names[i], 800, 400);
    assert_false(scratch_is_same(names[i], names[(i + 1) % 3]));
  }
}

TEST(test_one_panel) {
  draw("alone.png", NULL, RIIS_VTK_VIEW_TOP, 300, 500);
  expect_picture("alone.png", 300, 500);
  draw("small.png", mesh, RIIS_VTK_VIEW_TOP, 64, 64);
  int width = 0, height = 0, n_colours = 0, n_coloured[2];
  assert_int_equal(shim_read_png(scratch_path("small.png"), &width, &height, &n_colours, n_coloured), 1);
  assert_true(width == 64 && height == 64 && n_colours > 1);
}

/* A mesh without marked nodes still gives a picture. */
TEST(test_nothing_marked) {
  const double lower[3] = {5, 5, 5}, upper[3] = {6, 6, 6};
  riis_vtk_mesh *other = marked_box("far.vtu", 3, lower, upper);
  draw("far.png", other, RIIS_VTK_VIEW_OBLIQUE, 400, 200);
  assert_int_equal(scratch_exists("far.png"), 1);
  riis_vtk_mesh_destroy(&other);
}

/* The pixels of a picture, from the bottom row up. */
typedef struct {
  int width, height;
  unsigned char *rgb;
} pixels;

static pixels read_pixels(const char *name) {
  pixels picture = {0, 0, NULL};
  picture.rgb = shim_read_pixels(scratch_path(name), &picture.width, &picture.height);
  assert_non_null(picture.rgb);
  return picture;
}

static const unsigned char *pixel_at(const pixels *picture, int x, int y) {
  return picture->rgb + 3 * ((size_t)y * (size_t)picture->width + (size_t)x);
}

/* The heights of the bands of text, for a picture of 800 pixels. Two lines of text stand above the panels, axes and colour keys
 * below. */
enum { upper_band = 85, lower_band = 83 };

static int is_red(const unsigned char *rgb) { return rgb[0] > 110 && rgb[1] < 40 && rgb[2] < 40; }
static int is_skin(const unsigned char *rgb) {
  return rgb[0] == rgb[1] && rgb[1] == rgb[2] && rgb[0] > 200 && rgb[0] < 250;
}
/* is_full is true for strong colours, and is_pale for pale colours. */
static int is_full(const unsigned char *rgb) {
  const int most = rgb[0] > rgb[1] ? (rgb[0] > rgb[2] ? rgb[0] : rgb[2]) : (rgb[1] > rgb[2] ? rgb[1] : rgb[2]);
  const int least = rgb[0] < rgb[1] ? (rgb[0] < rgb[2] ? rgb[0] : rgb[2]) : (rgb[1] < rgb[2] ? rgb[1] : rgb[2]);
  return 2 * (most - least) > most;
}
static int is_pale(const unsigned char *rgb) {
  const int most = rgb[0] > rgb[2] ? rgb[0] : rgb[2], least = rgb[0] < rgb[2] ? rgb[0] : rgb[2];
  return most > 100 && most - least > 20 && !is_full(rgb);
}

/* Returns the number of pixels of one kind in a panel. The panels are 0 and 1. */
static int count_pixels(const char *name, int panel, int (*is_kind)(const unsigned char *)) {
  pixels picture = read_pixels(name);
  int n = 0;
  for (int y = lower_band; y < picture.height - upper_band; ++y)
    for (int x = 0; x < picture.width / 2; ++x) n += is_kind(pixel_at(&picture, panel * picture.width / 2 + x, y));
  free(picture.rgb);
  return n;
}

/* Finds the numbers of the edge's two nodes by their positions. All nodes of the mesh have different positions. */
static void two_nodes(int64_t edge[2]) {
  const double *xyz = NULL;
  int64_t n = 0;
  double closest[2] = {1e9, 1e9};
  expect_fine(riis_vtk_mesh_get_nodes(mesh, &n, NULL, &xyz));
  const double wanted[2][3] = {{0, 0, -0.45}, {0.17, 0, -0.45}};
  for (int64_t i = 0; i < n; ++i)
    for (int k = 0; k < 2; ++k) {
      double squared = 0;
      for (int axis = 0; axis < 3; ++axis) {
        const double d = xyz[3 * i + axis] - wanted[k][axis];
        squared += d * d;
      }
      if (squared >= closest[k]) continue;
      closest[k] = squared;
      edge[k] = i;
    }
  assert_true(edge[0] != edge[1]);
}

/* Returns the longest run of dark pixels in a row of the right panel, for the rows `from` to `to`. */
static int longest_dark_run(const pixels *picture, int from, int to) {
  int longest = 0;
  for (int y = from; y < to; ++y) {
    int run = 0;
    for (int x = picture->width / 2; x < picture->width; ++x) {
      run = pixel_at(picture, x, y)[0] < 130 ? run + 1 : 0;
      if (run > longest) longest = run;
    }
  }
  return longest;
}

static int is_line(const unsigned char *rgb) { return rgb[0] == rgb[1] && rgb[1] == rgb[2] && rgb[0] < 200; }

/* Returns the largest number of changes between line and background in a row of the right panel. */
static int most_changes_in_a_row(const pixels *picture, int *row) {
  int most = 0;
  for (int y = lower_band; y < picture->height - upper_band; ++y) {
    int n = 0;
    for (int x = picture->width / 2 + 1; x < picture->width; ++x)
      n += is_line(pixel_at(picture, x, y)) != is_line(pixel_at(picture, x - 1, y));
    if (n > most) *row = y;
    if (n > most) most = n;
  }
  return most;
}

/* Returns how many columns or rows of a one-panel picture contain a pixel in a full colour. The bands of text do not count. */
static int count_coloured(const char *name, int by_rows) {
  pixels picture = read_pixels(name);
  const int y_end = picture.height - upper_band, n_lines = by_rows ? y_end : picture.width;
  int n = 0;
  for (int line = by_rows ? lower_band : 0; line < n_lines; ++line) {
    int has_colour = 0;
    for (int at = by_rows ? 0 : lower_band; at < (by_rows ? picture.width : y_end); ++at)
      has_colour |= is_full(by_rows ? pixel_at(&picture, at, line) : pixel_at(&picture, line, at));
    n += has_colour;
  }
  free(picture.rgb);
  return n;
}

static void draw_unit(const char *name, const char *unit, const riis_vtk_mesh *drawn) {
  riis_vtk_picture_options options;
  expect_fine(riis_vtk_picture_options_init(&options, sizeof options));
  assert_null(options.unit);
  options.width = drawn ? 800 : 400;
  options.height = 400;
  options.unit = unit;
  options.view = RIIS_VTK_VIEW_OBLIQUE;
  expect_fine(riis_vtk_draw(surface, drawn, &options, scratch_path(name)));
}

/* If a file may have only n_bytes, as on a full disk, the picture and the temporary file are removed. */
TEST(test_full_disk) {
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

TEST(test_refusals) {
  const int n_before = scratch_n_files();
  expect_refused(riis_vtk_draw(surface, NULL, NULL, scratch_path("a.jpg")), RIIS_FILE_ERROR, "must be .png");
  expect_refused(riis_vtk_draw(surface, NULL, NULL, scratch_path("no_folder/a.png")), RIIS_FILE_ERROR, "a.png: ");
  assert_int_equal(scratch_n_files(), n_before);
}

/* One scene may draw several views. Each view equals the picture of a separate call. */
TEST(test_one_scene) {
  const int32_t views[4] = {RIIS_VTK_VIEW_TOP, RIIS_VTK_VIEW_THREE, RIIS_VTK_VIEW_VALVE_OBLIQUE, RIIS_VTK_VIEW_TOP};
  const char *paths[4] = {scratch_path("s0.png"), scratch_path("s1.png"), scratch_path("s2.png"),
                          scratch_path("s3.png")};
  const char *const names[4] = {"s0.png", "s1.png", "s2.png", "s3.png"};
  const int64_t edge[2] = {0, 1};
  riis_vtk_picture_options options;
  expect_fine(riis_vtk_picture_options_init(&options, sizeof options));
  options.width = 800;
  options.height = 400;
  options.n_leaking_edges = 1;
  options.leaking_edges = edge;
  scratch_watch_output();
  const riis_status status = riis_vtk_draw_views(surface, mesh, &options, 4, views, paths);
  assert_int_equal(scratch_end_watch(), 0);
  expect_fine(status);
  for (int i = 0; i < 4; ++i) {
    options.view = views[i];
    expect_fine(riis_vtk_draw(surface, mesh, &options, scratch_path("alone.png")));
    assert_true(scratch_is_same(names[i], "alone.png"));
  }
  assert_false(scratch_is_same("s0.png", "s1.png"));
}

/* A leaking edge in the middle of the mesh is visible in every view. The caption mentions leaks only if they are known. */
TEST(test_leaks) {
  const char *paths[3] = {scratch_path("l0.png"), scratch_path("l1.png"), scratch_path("l2.png")};
  const char *const names[3] = {"l0.png", "l1.png", "l2.png"};
  const int32_t views[3] = {RIIS_VTK_VIEW_SIDE, RIIS_VTK_VIEW_TOP, RIIS_VTK_VIEW_OBLIQUE};
  int64_t edge[2] = {0, 0};
  two_nodes(edge);
  riis_vtk_picture_options options;
  expect_fine(riis_vtk_picture_options_init(&options, sizeof options));
  expect_fine(
      riis_vtk_draw_views(surface, mesh, &options, 1, views, (const char *const[]){scratch_path("unknown.png")}));
  assert_int_equal(count_pixels("unknown.png", 1, is_red), 0);
  options.leaking_edges = edge;
  expect_fine(riis_vtk_draw_views(surface, mesh, &options, 1, views, (const char *const[]){scratch_path("none.png")}));
  assert_int_equal(count_pixels("none.png", 1, is_red), 0);
  assert_false(scratch_is_same("unknown.png", "none.png"));
  options.n_leaking_edges = 1;
  expect_fine(riis_vtk_draw_views(surface, mesh, &options, 3, views, paths));
  for (int i = 0; i < 3; ++i) {
    const int n = count_pixels(names[i], 1, is_red);
    assert_true(n > 20 && n < 2000);
    assert_int_equal(count_pixels(names[i], 0, is_red), 0);
  }
}

/* In a coarse mesh without a wholly marked cell, the picture shows the marked nodes. In a fine mesh, the picture shows the wholly
 * marked cells. */
TEST(test_partly_marked) {
  const double lower[3] = {-1.7, -1.7, -1.3}, upper[3] = {1.7, 1.7, 0.4};
  riis_vtk_mesh *coarse = marked_box("coarse.vtu", 5, lower, upper);
  const int32_t views[3] = {RIIS_VTK_VIEW_SIDE, RIIS_VTK_VIEW_TOP, RIIS_VTK_VIEW_OBLIQUE};
  for (int i = 0; i < trials(1, 3); ++i) {
    draw("coarse.png", coarse, views[i], 1600, 800);
    assert_int_equal(count_pixels("coarse.png", 1, is_full), 0);
    assert_true(count_pixels("coarse.png", 1, is_pale) > 20000);
    draw("fine.png", mesh, views[i], 1600, 800);
    const int n_full = count_pixels("fine.png", 1, is_full), n_pale = count_pixels("fine.png", 1, is_pale);
    assert_true(n_pale > 1000);
    assert_true(n_full > 2 * n_pale);
  }
  riis_vtk_mesh_destroy(&coarse);
}

/* In a picture of a tube that is 20 times as long as wide, the region around the valve is as large as in a short tube. Dashes
 * show where the tube is cut off. */
TEST(test_long_mesh) {
  const double lower[3] = {-1.7, -1.7, -30}, upper[3] = {1.7, 1.7, 38};
  riis_vtk_mesh *tube = marked_box("tube.vtu", 21, lower, upper);
  draw("short.png", mesh, RIIS_VTK_VIEW_SIDE, 1600, 800);
  draw("long.png", tube, RIIS_VTK_VIEW_SIDE, 1600, 800);
  const int n_short = count_pixels("short.png", 0, is_full), n_long = count_pixels("long.png", 0, is_full);
  assert_true(n_long > 0.9 * n_short && n_long < 1.1 * n_short);
  pixels picture = read_pixels("long.png");
  int row = 0;
  assert_true(most_changes_in_a_row(&picture, &row) > 40);
  /* The space between the dashes and the panel's edge is empty. */
  const int end = row < picture.height / 2 ? lower_band + 4 : picture.height - upper_band - 5;
  for (int x = picture.width / 2; x < picture.width; ++x) assert_true(pixel_at(&picture, x, end)[0] > 250);
  free(picture.rgb);
  picture = read_pixels("short.png");
  assert_true(most_changes_in_a_row(&picture, &row) < 20);
  free(picture.rgb);
  /* Without captions, nothing would explain dashes, so none are drawn. */
  riis_vtk_picture_options options;
  expect_fine(riis_vtk_picture_options_init(&options, sizeof options));
  options.view = RIIS_VTK_VIEW_SIDE;
  options.captions = RIIS_VTK_CAPTIONS_SCALE;
  draw_by(&options, "plain.png", tube);
  picture = read_pixels("plain.png");
  assert_true(most_changes_in_a_row(&picture, &row) < 20);
  free(picture.rgb);
  riis_vtk_mesh_destroy(&tube);
}

/* Seen from above, the mesh is 3.4 wide. The scale bar's length, 1, should therefore have a known number of pixels. The mesh must
 * not reach behind the texts. */
TEST(test_scale_and_bands) {
  draw("bands.png", mesh, RIIS_VTK_VIEW_TOP, 1600, 800);
  pixels picture = read_pixels("bands.png");
  int left = picture.width, right = 0, n_skin_in_bands = 0;
  for (int y = 0; y < picture.height; ++y)
    for (int x = picture.width / 2; x < picture.width; ++x) {
      if (!is_skin(pixel_at(&picture, x, y))) continue;
      if (y < lower_band || y >= picture.height - upper_band) {
        n_skin_in_bands += pixel_at(&picture, x, y)[0] == 233;
        continue;
      }
      if (x < left) left = x;
      if (x > right) right = x;
    }
  const double per_length = (right - left) / 3.4;
  const int bar = longest_dark_run(&picture, 0, lower_band);
  assert_true(bar > 0.98 * per_length && bar < 1.02 * per_length + 2);
  /* The edges of letters may have any grey. */
  assert_true(n_skin_in_bands < 200);
  free(picture.rgb);
}

/* Flat leaflets are seen edge on: closed leaflets from the side, and open leaflets from above. Such leaflets appear as lines that
 * fill 1/1.08 of the panel, because the camera leaves this margin. */
TEST(test_edge_on) {
  const int32_t views[2] = {RIIS_VTK_VIEW_SIDE, RIIS_VTK_VIEW_TOP};
  const double expected[2] = {800 / 1.08, (800 - upper_band - lower_band) / 1.08};
  riis_surface *const kept = surface;
  riis_valve *valve = NULL;
  expect_fine(riis_valve_create("bileaflet", &valve));
  expect_fine(riis_valve_set_scalar(valve, "closed_angle", 0));
  expect_fine(riis_valve_set_scalar(valve, "open_angle", 90));
  for (int i = 0; i < 2; ++i) {
    expect_fine(riis_valve_set_scalar(valve, "opening", i));
    expect_fine(riis_surface_create(valve, NULL, &surface));
    draw("flat.png", NULL, views[i], 800, 800);
    riis_surface_destroy(&surface);
    surface = kept;
    if (abs(count_coloured("flat.png", i) - (int)expected[i]) > 5)
      fail_msg("%d lines of pixels, not %g", count_coloured("flat.png", i), expected[i]);
  }
  riis_valve_destroy(&valve);
}

/* The unit follows the number at the scale bar without changes. The unit replaces the default words. */
TEST(test_unit) {
  for (int with_mesh = 0; with_mesh < 2; ++with_mesh) {
    const riis_vtk_mesh *const drawn = with_mesh ? mesh : NULL;
    draw_unit("none.png", NULL, drawn);
    draw_unit("empty.png", "", drawn);
    draw_unit("one.png", with_mesh ? "mesh unit" : "unit", drawn);
    draw_unit("more.png", with_mesh ? "mesh units" : "units", drawn);
    draw_unit("mm.png", "mm", drawn);
    draw_unit("mms.png", "mms", drawn);
    assert_true(scratch_is_same("none.png", "empty.png"));
    assert_true(scratch_is_same("none.png", "one.png") != scratch_is_same("none.png", "more.png"));
    assert_false(scratch_is_same("none.png", "mm.png"));
    assert_false(scratch_is_same("mms.png", "mm.png"));
  }
}

enum { wide = 900, high = 300, n_pictures = 4 };

/* A valve in a mesh, after a common turn and shift of both. */
typedef struct {
  riis_surface *surface;
  riis_vtk_mesh *mesh;
  double axis[3], angle;
} placed;

/* Places a valve and a mesh of n random nodes, xyz(3, n). The tetrahedra do not depend on the placement. */
static placed place(const char *kind, const double axis[3], double angle, const double shift[3], int n,
                    const double *xyz) {
  placed made = {NULL, NULL, {axis[0], axis[1], axis[2]}, angle};
  riis_valve *valve = NULL;
  riis_surface_options options;
  double *const moved = malloc((size_t)n * 3 * sizeof *moved);
  const double length = sqrt(axis[0] * axis[0] + axis[1] * axis[1] + axis[2] * axis[2]);
  const double c = cos(angle * acos(-1.0) / 180), s = sin(angle * acos(-1.0) / 180);
  const double u[3] = {axis[0] / length, axis[1] / length, axis[2] / length};
  for (int i = 0; i < n; ++i) {
    const double *const p = xyz + 3 * i;
    const double along = u[0] * p[0] + u[1] * p[1] + u[2] * p[2];
    for (int k = 0; k < 3; ++k) {
      const int a = (k + 1) % 3, b = (k + 2) % 3;
      moved[3 * i + k] = c * p[k] + s * (u[a] * p[b] - u[b] * p[a]) + (1 - c) * along * u[k] + shift[k];
    }
  }
  assert_int_equal(shim_write_delaunay(scratch_path("turned.vtu"), n, moved), 1);
  free(moved);
  expect_fine(riis_surface_options_init(&options, sizeof options));
  memcpy(options.rotation_axis, axis, sizeof options.rotation_axis);
  memcpy(options.translation, shift, sizeof options.translation);
  options.rotation_angle = angle;
  options.half_thickness = 0.25;
  expect_fine(riis_valve_create(kind, &valve));
  expect_fine(riis_valve_set_scalar(valve, "opening", 0.3));
  expect_fine(riis_surface_create(valve, &options, &made.surface));
  riis_valve_destroy(&valve);
  made.mesh = marked_by(made.surface, "turned.vtu");
  return made;
}

/* Draws four views, starting with `first`, with or without the mesh. */
static void draw_four(const placed *what, int with_mesh, int32_t first, const char *const names[n_pictures]) {
  riis_vtk_picture_options options;
  int32_t views[n_pictures];
  char paths[n_pictures][400];
  const char *list[n_pictures];
  for (int i = 0; i < n_pictures; ++i) {
    views[i] = first + i;
    snprintf(paths[i], sizeof paths[i], "%s", scratch_path(names[i]));
    list[i] = paths[i];
  }
  expect_fine(riis_vtk_picture_options_init(&options, sizeof options));
  memcpy(options.rotation_axis, what->axis, sizeof options.rotation_axis);
  options.rotation_angle = what->angle;
  options.width = wide;
  options.height = high;
  expect_fine(riis_vtk_draw_views(what->surface, with_mesh ? what->mesh : NULL, &options, n_pictures, views, list));
}

/* Returns the share of pixels that differ by more than the noise of rendering at edges. Omits the arrows of the mesh's axes and
 * the line that names the views. */
static double share_of_changes(const char *a, const char *b) {
  const pixels pictures[2] = {read_pixels(a), read_pixels(b)};
  assert_true(pictures[0].width == wide && pictures[0].height == high && pictures[1].width == wide);
  const int letter = 8, is_three = strstr(a, "three") != NULL, column = is_three ? wide / 3 : wide;
  int n = 0, n_all = 0;
  for (int y = 0; y < high; ++y)
    for (int x = 0; x < wide; ++x) {
      if (y < 4 * letter && x % column < 6 * letter) continue;
      if (is_three && y > high - 4 * letter && y < high - 2 * letter) continue;
      const unsigned char *const p = pixel_at(&pictures[0], x, y), *const q = pixel_at(&pictures[1], x, y);
      ++n_all;
      n += abs(p[0] - q[0]) > 32 || abs(p[1] - q[1]) > 32 || abs(p[2] - q[2]) > 32;
    }
  free(pictures[0].rgb);
  free(pictures[1].rgb);
  return n / (double)n_all;
}

/* The long view is the view from the side after a turn about the valve's z. The turn is 30 degrees for three cusps, and the plane
 * then cuts two of them. The turn is 90 degrees for a mitral valve, and the plane then goes from one leaflet to the other.
 * Another turn shows another picture. The opening does not change the turn. By default, each kind has one of the two openings. */
TEST(test_long_view) {
  static const char *const kinds[4] = {"aortic", "coapting", "mitral", "mitral_coapting"};
  for (int trial = 0; trial < trials(4, 8); ++trial) {
    const int i = is_long_test() ? trial : 2 * trial + (trial + 1) / 2 % 2;
    riis_valve *valve = NULL;
    placed what = {NULL, NULL, {0, 0, 1}, 0};
    riis_vtk_picture_options options;
    expect_fine(riis_valve_create(kinds[i / 2], &valve));
    expect_fine(riis_valve_set_scalar(valve, "opening", i % 2));
    expect_fine(riis_surface_create(valve, NULL, &what.surface));
    expect_fine(riis_vtk_picture_options_init(&options, sizeof options));
    options.width = wide, options.height = high;
    options.view = RIIS_VTK_VIEW_VALVE_LONG;
    expect_fine(riis_vtk_draw(what.surface, NULL, &options, scratch_path("long.png")));
    options.view = RIIS_VTK_VIEW_VALVE_SIDE;
    const double turn = i / 2 < 2 ? 30 : 90;
    for (int other = 0; other < 2; ++other) {
      options.rotation_angle = turn + 45 * other;
      expect_fine(riis_vtk_draw(what.surface, NULL, &options, scratch_path("side.png")));
      const double changed = share_of_changes("long.png", "side.png");
      if (other ? changed < 0.03 : changed > 0.015)
        fail_msg("%s, opening %d: %g of the pixels differ from a turn by %g", kinds[i / 2], i % 2, changed,
                 options.rotation_angle);
    }
    riis_surface_destroy(&what.surface);
    riis_valve_destroy(&valve);
  }
}

/* If a valve and its mesh are turned and moved together, views by the valve's axes stay the same. Views by the mesh's axes
 * change. */
TEST(test_valve_axes) {
  enum { n = 1500 };
  static const char *const kinds[5] = {"aortic", "trileaflet", "coapting", "mitral", "bileaflet"};
  static const char *const before[n_pictures] = {"a0.png", "a1.png", "a2.png", "a_three.png"};
  static const char *const after[n_pictures] = {"b0.png", "b1.png", "b2.png", "b_three.png"};
  static const char *const by_mesh[n_pictures] = {"c0.png", "c1.png", "c2.png", "c_three.png"};
  const double z[3] = {0, 0, 1}, nowhere[3] = {0, 0, 0};
  random_source random = random_start("valve_axes");
  double *const xyz = malloc(3 * n * sizeof *xyz);
  for (int i = 0; i < 3 * n; ++i) xyz[i] = random_between(&random, -2.2, 2.2);
  const int first = (int)(random_bits(&random) % 5), n_kinds = is_long_test() ? 5 : 1;
  for (int kind = first; kind < first + n_kinds; ++kind) {
    double axis[3], shift[3];
    for (int k = 0; k < 3; ++k) {
      axis[k] = random_between(&random, -1, 1);
      shift[k] = random_between(&random, -50, 50);
    }
    placed here = place(kinds[kind % 5], z, 0, nowhere, n, xyz);
    placed there = place(kinds[kind % 5], axis, random_between(&random, 40, 180), shift, n, xyz);
    for (int with_mesh = 0; with_mesh < 2; ++with_mesh) {
      draw_four(&here, with_mesh, RIIS_VTK_VIEW_SIDE, before);
      draw_four(&there, with_mesh, RIIS_VTK_VIEW_VALVE_SIDE, after);
      draw_four(&there, with_mesh, RIIS_VTK_VIEW_SIDE, by_mesh);
      double most = 0;
      for (int i = 0; i < n_pictures; ++i) {
        const double same = share_of_changes(before[i], after[i]), other = share_of_changes(before[i], by_mesh[i]);
        if (same > 0.015)
          fail_msg("%s, view %d, mesh %d: %g of the pixels differ", kinds[kind % 5], i, with_mesh, same);
        if (other > most) most = other;
      }
      assert_true(most > 0.05);
    }
    riis_surface_destroy(&here.surface);
    riis_surface_destroy(&there.surface);
    riis_vtk_mesh_destroy(&here.mesh);
    riis_vtk_mesh_destroy(&there.mesh);
  }
  free(xyz);
}

/* A picture of three views has one column for each. All columns have one scale, so the surface is as wide from the side as from
 * above. Each column has panels for the surface and the marks. If the width is not a multiple of three, white fills the rest. */
TEST(test_three_views) {
  static const int widths[3] = {1200, 1201, 1202};
  for (int i = 0; i < 3; ++i) {
    draw("three.png", mesh, RIIS_VTK_VIEW_THREE, widths[i], 800);
    pixels picture = read_pixels("three.png");
    assert_true(picture.width == widths[i] && picture.height == 800);
    int n_across[2] = {0, 0}, n_full[3][2] = {{0}};
    for (int column = 0; column < 3; ++column)
      for (int x = column * widths[i] / 3; x < column * widths[i] / 3 + 400; ++x) {
        int n[2] = {0, 0};
        for (int y = 60; y < 750; ++y) n[y < 405] += is_full(pixel_at(&picture, x, y));
        for (int half = 0; half < 2; ++half) n_full[column][half] += n[half];
        if (column < 2) n_across[column] += n[0] > 0;
      }
    for (int column = 0; column < 3; ++column)
      for (int half = 0; half < 2; ++half) assert_true(n_full[column][half] > 3000);
    assert_in_range(n_across[1], n_across[0] - 3, n_across[0] + 3);
    for (int x = 3 * (widths[i] / 3); x < widths[i]; ++x)
      for (int y = 0; y < 800; ++y) {
        if (x >= 2 * widths[i] / 3 + widths[i] / 3) assert_int_equal(pixel_at(&picture, x, y)[0], 255);
      }
    free(picture.rgb);
  }
  draw("small.png", mesh, RIIS_VTK_VIEW_VALVE_THREE, 64, 64);
  int width = 0, height = 0, n_colours = 0, n_coloured[2];
  assert_int_equal(shim_read_png(scratch_path("small.png"), &width, &height, &n_colours, n_coloured), 1);
  assert_true(width == 64 && height == 64 && n_colours > 1);
}

/* ---- Looks ---- */

static riis_vtk_picture_options looks(double red, double green, double blue, double opacity, int32_t captions) {
  const double background[4] = {red, green, blue, opacity};
  riis_vtk_picture_options options;
  expect_fine(riis_vtk_picture_options_init(&options, sizeof options));
  options.width = 640;
  options.height = 320;
  memcpy(options.background, background, sizeof background);
  options.captions = captions;
  return options;
}

static void expect_corners(const char *name, int red, int green, int blue) {
  pixels picture = read_pixels(name);
  for (int i = 0; i < 4; ++i) {
    const unsigned char *const rgb = pixel_at(&picture, i % 2 ? picture.width - 1 : 0, i / 2 ? picture.height - 1 : 0);
    assert_true(rgb[0] == red && rgb[1] == green && rgb[2] == blue);
  }
  free(picture.rgb);
}

/* The background has the colour of the options. A transparent picture can be laid on white and on black. On either colour, the
 * transparent picture equals a picture that is drawn on this colour, up to the rounding of each layer. */
TEST(test_backgrounds) {
  static const char *const on[2] = {"white.png", "black.png"};
  riis_vtk_picture_options options = looks(0.2, 0.4, 0.6, 1, RIIS_VTK_CAPTIONS_ALL);
  draw_by(&options, "blue.png", mesh);
  expect_corners("blue.png", 51, 102, 153);
  options = looks(1, 1, 1, 1, RIIS_VTK_CAPTIONS_NONE);
  draw_by(&options, on[0], mesh);
  expect_corners(on[0], 255, 255, 255);
  options = looks(0, 0, 0, 1, RIIS_VTK_CAPTIONS_NONE);
  draw_by(&options, on[1], mesh);
  expect_corners(on[1], 0, 0, 0);
  int width = 0, height = 0;
  assert_null(shim_read_clear_pixels(scratch_path(on[0]), &width, &height));
  /* The brightness of the wall's lines follows from the options' colour. Transparent pictures for light pages therefore differ
   * from those for dark pages. */
  for (int i = 0; i < 2; ++i) {
    options = looks(1 - i, 1 - i, 1 - i, 0, RIIS_VTK_CAPTIONS_NONE);
    draw_by(&options, "clear.png", mesh);
    unsigned char *const clear = shim_read_clear_pixels(scratch_path("clear.png"), &width, &height);
    assert_non_null(clear);
    assert_true(width == 640 && height == 320);
    pixels drawn = read_pixels(on[i]);
    int n_of[3] = {0, 0, 0};
    for (int at = 0; at < width * height; ++at) {
      const unsigned char *const rgba = clear + 4 * at;
      ++n_of[rgba[3] == 0 ? 0 : rgba[3] == 255 ? 2 : 1];
      for (int k = 0; k < 3; ++k) {
        const double laid = (rgba[3] * rgba[k] + (255 - rgba[3]) * (i == 0 ? 255 : 0)) / 255.0;
        if (fabs(laid - drawn.rgb[3 * at + k]) > 4.0) fail_msg("pixel %d: %g for %d", at, laid, drawn.rgb[3 * at + k]);
      }
    }
    assert_true(n_of[0] > 30000 && n_of[1] > 10000 && n_of[2] > 10000);
    free(drawn.rgb);
    free(clear);
  }
}

/* Returns how many pixels differ from white. */
static int count_drawn(const char *name) {
  pixels picture = read_pixels(name);
  int n = 0;
  for (int i = 0; i < picture.width * picture.height; ++i) {
    const unsigned char *const rgb = picture.rgb + 3 * i;
    n += rgb[0] < 250 || rgb[1] < 250 || rgb[2] < 250;
  }
  free(picture.rgb);
  return n;
}

/* Without captions, the title has no effect. Without a scale bar, the unit has no effect. The panels then use the space of the
 * texts. */
TEST(test_captions) {
  int n_drawn[3];
  for (int32_t captions = 0; captions < 3; ++captions) {
    riis_vtk_picture_options options = looks(1, 1, 1, 1, captions);
    draw_by(&options, "plain.png", mesh);
    n_drawn[captions] = count_drawn("plain.png");
    options.title = "Valve";
    draw_by(&options, "title.png", mesh);
    assert_int_equal(scratch_is_same("plain.png", "title.png"), captions != RIIS_VTK_CAPTIONS_ALL);
    options.unit = "mm";
    draw_by(&options, "unit.png", mesh);
    assert_int_equal(scratch_is_same("title.png", "unit.png"), captions == RIIS_VTK_CAPTIONS_NONE);
  }
  assert_true(n_drawn[1] > 1.1 * n_drawn[0] && n_drawn[2] > 1.02 * n_drawn[1]);
}

/* One panel fills the picture. Without a mesh, a wall takes the place of the mesh's boundary around the surface. */
TEST(test_panels_and_wall) {
  riis_vtk_picture_options options = looks(1, 1, 1, 1, RIIS_VTK_CAPTIONS_NONE);
  riis_vtk_surface *boundary = NULL;
  riis_surface *wall = NULL;
  riis_surface_arrays arrays;
  expect_fine(riis_vtk_mesh_get_boundary(mesh, &boundary));
  expect_fine(riis_surface_arrays_init(&arrays, sizeof arrays));
  expect_fine(riis_vtk_surface_get_arrays(boundary, &arrays, sizeof arrays));
  expect_fine(riis_surface_create_from_arrays(&arrays, NULL, &wall));
  options.width = 320;
  options.panels = RIIS_VTK_PANELS_VALVE;
  draw_by(&options, "valve.png", mesh);
  options.panels = RIIS_VTK_PANELS_MARKS;
  draw_by(&options, "marks.png", mesh);
  assert_false(scratch_is_same("valve.png", "marks.png"));
  options.panels = RIIS_VTK_PANELS_BOTH;
  draw_by(&options, "alone.png", NULL);
  options.wall = wall;
  draw_by(&options, "walled.png", NULL);
  assert_false(scratch_is_same("alone.png", "walled.png"));
  const pixels pictures[2] = {read_pixels("valve.png"), read_pixels("walled.png")};
  int n = 0;
  for (int i = 0; i < 3 * 320 * 320; ++i) n += abs(pictures[0].rgb[i] - pictures[1].rgb[i]) > 8;
  assert_true(n < 3 * 320 * 320 / 100);
  free(pictures[0].rgb);
  free(pictures[1].rgb);
  riis_surface_destroy(&wall);
  riis_vtk_surface_destroy(&boundary);
}

/* Returns the colour that pictures give to a speed, from matplotlib's table of viridis at every eighth. `share` is 0 to 1. */
static double viridis(double share, int channel) {
  static const int table[9][3] = {{68, 1, 84},    {71, 44, 122}, {59, 81, 139},  {44, 113, 142}, {33, 144, 141},
                                  {39, 173, 129}, {92, 200, 99}, {170, 220, 50}, {253, 231, 37}};
  const int below = share >= 1 ? 7 : (int)(8 * share);
  return table[below][channel] + (8 * share - below) * (table[below + 1][channel] - table[below][channel]);
}

/* The speed is linear in x, as a point array. Each pixel of a row above the valve then has the colour of its speed. */
TEST(test_flow) {
  const double half = 1.7, middle = -0.45, pixels_per_length = 320 / (2 * 1.08 * 0.85);
  riis_vtk_picture_options options = looks(1, 1, 1, 1, RIIS_VTK_CAPTIONS_NONE);
  riis_vtk_mesh *box = marked_box("flow.vtu", 21, (const double[]){-1.7, -1.7, -1.3}, (const double[]){1.7, 1.7, 0.4});
  int64_t n = 0;
  const double *xyz = NULL;
  expect_fine(riis_vtk_mesh_get_nodes(box, &n, NULL, &xyz));
  double *wind = malloc(sizeof(double) * 3 * (size_t)n);
  for (int64_t i = 0; i < n; ++i) {
    const double speed = 1 + xyz[3 * i] / half; /* 0 to 2, so that the bar of colours ends at 2 */
    wind[3 * i] = 0.6 * speed;
    wind[3 * i + 1] = 0;
    wind[3 * i + 2] = -0.8 * speed;
  }
  expect_fine(riis_vtk_mesh_set_point_array(box, "wind", n, 3, wind));
  expect_fine(riis_vtk_mesh_set_point_array(box, "flat", n, 1, wind));
  free(wind);
  options.width = 640;
  options.height = 320;
  options.view = RIIS_VTK_VIEW_SIDE;
  options.panels = RIIS_VTK_PANELS_MARKS;
  options.velocity = "wind";
  draw_by(&options, "flow.png", box);
  const pixels picture = read_pixels("flow.png");
  const int row = (int)(160 - (0.3 - middle) * pixels_per_length);
  for (int i = -14; i <= 14; i += 2) {
    const double x = 0.1 * i + 0.03;
    const unsigned char *pixel = pixel_at(&picture, (int)(320 + x * pixels_per_length), row);
    for (int k = 0; k < 3; ++k)
      if (fabs(pixel[k] - viridis(0.5 + 0.5 * x / half, k)) > 4)
        fail_msg("x %g: channel %d is %d, not %.0f", x, k, pixel[k], viridis(0.5 + 0.5 * x / half, k));
  }
  free(picture.rgb);
  /* The panel of the valve is as without a flow. Captions and the bar of colours are drawn. */
  options.panels = RIIS_VTK_PANELS_BOTH;
  options.captions = RIIS_VTK_CAPTIONS_ALL;
  options.unit = "cm";
  options.height = 400;
  draw_by(&options, "both.png", box);
  expect_fine(riis_vtk_mesh_set_unit(box, "wind", "m/s"));
  draw_by(&options, "unit.png", box);
  assert_false(scratch_is_same("both.png", "unit.png"));
  options.captions = RIIS_VTK_CAPTIONS_SCALE;
  draw_by(&options, "scale.png", box);
  options.view = RIIS_VTK_VIEW_THREE;
  draw_by(&options, "three.png", box);
  expect_picture("three.png", 640, 400);
  options.velocity = "calm";
  expect_refused(riis_vtk_draw(surface, box, &options, scratch_path("no.png")), RIIS_INVALID_ARGUMENT,
                 "options->velocity is \"calm\", which is not an array of the mesh");
  options.velocity = "flat";
  expect_refused(riis_vtk_draw(surface, box, &options, scratch_path("no.png")), RIIS_INVALID_ARGUMENT,
                 "options->velocity is \"flat\", whose number of components is 1, not 3");
  expect_refused(riis_vtk_draw(surface, NULL, &options, scratch_path("no.png")), RIIS_INVALID_ARGUMENT,
                 "velocity is \"flat\", and mesh is NULL");
  riis_vtk_film *film = NULL;
  expect_refused(riis_vtk_film_create(box, (const double[]){0, 0, 0}, (const double[]){1, 1, 1}, &options, &film),
                 RIIS_INVALID_ARGUMENT, "velocity is \"flat\", which a film does not show");
  riis_vtk_mesh_destroy(&box);
}

/* A picture of twice the size looks equal, because letters, lines and panels grow with it. Each pixel of the small picture is
 * near the mean of four pixels of the large picture. */
TEST(test_sizes) {
  const int width = is_long_test() ? 1920 : 960, height = width * 9 / 16;
  riis_vtk_picture_options options = looks(1, 1, 1, 1, RIIS_VTK_CAPTIONS_ALL);
  options.width = width;
  options.height = height;
  draw_by(&options, "half.png", mesh);
  options.width = 2 * width;
  options.height = 2 * height;
  draw_by(&options, "whole.png", mesh);
  pixels half = read_pixels("half.png"), whole = read_pixels("whole.png");
  assert_true(whole.width == 2 * width && whole.height == 2 * height);
  double sum = 0;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      for (int k = 0; k < 3; ++k) {
        int mean = 2;
        for (int i = 0; i < 4; ++i) mean += pixel_at(&whole, 2 * x + i % 2, 2 * y + i / 2)[k];
        sum += abs(mean / 4 - pixel_at(&half, x, y)[k]);
      }
  assert_true(sum / (3.0 * width * height) < 1.5);
  free(half.rgb);
  free(whole.rgb);
}

int main(int argc, char **argv) {
  (void)argc;
  enter_virtual_display(argv);
  return run_cases(make_all, destroy_all);
}
