/* SPDX-License-Identifier: Apache-2.0
 *
 * Tests refusals of NULL pointers, of structs that no init function filled, and of options out of range. The caller's
 * floating-point environment does not change. */
#include <fenv.h>
#include <math.h>
#include <riis/riis_vtk.h>
#include <stdint.h>

#include "expect.h"
#include "scratch.h"
#include "vtk_shim.h"

static riis_surface *surface;
static riis_vtk_mesh *mesh;
static riis_marks *result;

static int make_all(void **state) {
  const double lower[3] = {0, 0, 0}, upper[3] = {1, 1, 1};
  riis_valve *valve = NULL;
  scratch_setup(state);
  expect_fine(riis_valve_create("aortic", &valve));
  expect_fine(riis_surface_create(valve, NULL, &surface));
  riis_valve_destroy(&valve);
  assert_int_equal(shim_write_box(scratch_path("in.vtu"), SHIM_RAW, 3, lower, upper, 0), 1);
  expect_fine(riis_vtk_mesh_read(scratch_path("in.vtu"), &mesh));
  expect_fine(riis_marks_create(&result));
  return 0;
}

static int destroy_all(void **state) {
  riis_vtk_mesh_destroy(&mesh);
  riis_surface_destroy(&surface);
  riis_marks_destroy(&result);
  return scratch_teardown(state);
}

TEST(test_null) {
  riis_vtk_mesh *other = NULL;
  riis_vtk_surface *file = NULL;
  riis_surface_arrays arrays;
  const char *path = scratch_path("out.vtu");
  expect_refused(riis_vtk_mesh_read(NULL, &other), RIIS_INVALID_ARGUMENT, "path is NULL");
  expect_refused(riis_vtk_mesh_read(path, NULL), RIIS_INVALID_ARGUMENT, "mesh is NULL");
  expect_refused(riis_vtk_mesh_get_nodes(NULL, NULL, NULL, NULL), RIIS_INVALID_ARGUMENT, "mesh is NULL");
  expect_fine(riis_vtk_mesh_get_nodes(mesh, NULL, NULL, NULL));
  riis_adjacency *adjacency = NULL;
  expect_refused(riis_vtk_mesh_create_adjacency(NULL, 1, &adjacency), RIIS_INVALID_ARGUMENT, "mesh is NULL");
  expect_refused(riis_vtk_mesh_create_adjacency(mesh, 1, NULL), RIIS_INVALID_ARGUMENT, "adjacency is NULL");
  expect_refused(riis_vtk_mesh_create_long_edges(NULL, surface, 0, 1, NULL, &adjacency), RIIS_INVALID_ARGUMENT,
                 "mesh is NULL");
  expect_refused(riis_vtk_mesh_create_long_edges(mesh, NULL, 0, 1, NULL, &adjacency), RIIS_INVALID_ARGUMENT,
                 "surface is NULL");
  expect_refused(riis_vtk_mesh_create_long_edges(mesh, surface, 0, 1, NULL, NULL), RIIS_INVALID_ARGUMENT,
                 "adjacency is NULL");
  expect_refused(riis_vtk_mesh_set_marks(NULL, result, -1, NULL), RIIS_INVALID_ARGUMENT, "mesh is NULL");
  expect_refused(riis_vtk_mesh_set_marks(mesh, NULL, -1, NULL), RIIS_INVALID_ARGUMENT, "marks is NULL");
  expect_refused(riis_vtk_mesh_write(NULL, path), RIIS_INVALID_ARGUMENT, "mesh is NULL");
  expect_refused(riis_vtk_mesh_write(mesh, NULL), RIIS_INVALID_ARGUMENT, "path is NULL");
  expect_refused(riis_vtk_surface_read(NULL, NULL, &file), RIIS_INVALID_ARGUMENT, "path is NULL");
  expect_refused(riis_vtk_surface_read(path, NULL, NULL), RIIS_INVALID_ARGUMENT, "surface is NULL");
  expect_refused(riis_vtk_surface_get_arrays(NULL, &arrays, sizeof arrays), RIIS_INVALID_ARGUMENT, "surface is NULL");
  expect_refused(riis_vtk_surface_write(NULL, path), RIIS_INVALID_ARGUMENT, "surface is NULL");
  expect_refused(riis_vtk_surface_write(surface, NULL), RIIS_INVALID_ARGUMENT, "path is NULL");
  expect_refused(riis_vtk_picture_options_init(NULL, sizeof(riis_vtk_picture_options)), RIIS_INVALID_ARGUMENT,
                 "options is NULL");
  expect_refused(riis_vtk_draw(NULL, mesh, NULL, path), RIIS_INVALID_ARGUMENT, "surface is NULL");
  expect_refused(riis_vtk_draw(surface, NULL, NULL, NULL), RIIS_INVALID_ARGUMENT, "path is NULL");
  riis_vtk_mesh_destroy(NULL);
  riis_vtk_mesh_destroy(&other);
  riis_vtk_surface_destroy(NULL);
  riis_vtk_surface_destroy(&file);
}

/* Tests refusals of a list of pieces, and the roles of nodes in a mesh without neighbours. */
TEST(test_pieces) {
  riis_vtk_pieces *pieces = NULL;
  riis_vtk_mesh *piece = NULL;
  riis_vtk_sharing sharing;
  uint8_t role[27];
  int64_t n = 0, n_cells = 0;
  const char *const files[2] = {"a.vtu", NULL}, *const *paths = NULL;
  expect_refused(riis_vtk_pieces_read(NULL, &pieces), RIIS_INVALID_ARGUMENT, "path is NULL");
  expect_refused(riis_vtk_pieces_read(scratch_path("in.vtu"), NULL), RIIS_INVALID_ARGUMENT, "pieces is NULL");
  expect_refused(riis_vtk_pieces_read(scratch_path("in.vtu"), &pieces), RIIS_FILE_ERROR, "must be a .pvtu file");
  expect_refused(riis_vtk_pieces_create(NULL, 1, files, &pieces), RIIS_INVALID_ARGUMENT, "mesh is NULL");
  expect_refused(riis_vtk_pieces_create(mesh, 0, files, &pieces), RIIS_INVALID_ARGUMENT, "n_files is 0");
  expect_refused(riis_vtk_pieces_create(mesh, 1, NULL, &pieces), RIIS_INVALID_ARGUMENT, "files is NULL");
  expect_refused(riis_vtk_pieces_create(mesh, 2, files, &pieces), RIIS_INVALID_ARGUMENT, "files[1] is NULL");
  expect_refused(riis_vtk_pieces_create(mesh, 1, files, NULL), RIIS_INVALID_ARGUMENT, "pieces is NULL");
  expect_fine(riis_vtk_pieces_create(mesh, 1, files, &pieces));
  const char *const in = scratch_path("in.vtu");
  expect_refused(riis_vtk_pieces_set_files(NULL, 1, &in), RIIS_INVALID_ARGUMENT, "pieces is NULL");
  expect_refused(riis_vtk_pieces_set_files(pieces, 1000001, &in), RIIS_INVALID_ARGUMENT, "n_files is 1000001");
  expect_fine(riis_vtk_pieces_set_files(pieces, 1, &in));
  expect_fine(riis_vtk_pieces_get_files(pieces, &n, &paths));
  assert_int_equal(n, 1);
  assert_string_equal(paths[0], in);
  expect_refused(riis_vtk_pieces_get_files(NULL, &n, &paths), RIIS_INVALID_ARGUMENT, "pieces is NULL");
  expect_refused(riis_vtk_pieces_write(NULL, scratch_path("a.pvtu")), RIIS_INVALID_ARGUMENT, "pieces is NULL");
  expect_refused(riis_vtk_pieces_write(pieces, NULL), RIIS_INVALID_ARGUMENT, "path is NULL");
  expect_refused(riis_vtk_pieces_write(pieces, scratch_path("a.vtu")), RIIS_FILE_ERROR, "ending must be .pvtu");
  expect_fine(riis_vtk_pieces_write(pieces, scratch_path("a.pvtu")));
  riis_vtk_pieces_destroy(&pieces);
  riis_vtk_pieces_destroy(&pieces);
  riis_vtk_pieces_destroy(NULL);
  /* The list is read again, with the piece's arrays. */
  expect_fine(riis_vtk_pieces_read(scratch_path("a.pvtu"), &pieces));
  expect_refused(riis_vtk_pieces_read_mesh(NULL, 0, &piece), RIIS_INVALID_ARGUMENT, "pieces is NULL");
  expect_refused(riis_vtk_pieces_read_mesh(pieces, 1, &piece), RIIS_INVALID_ARGUMENT, "piece is 1; there are 1 pieces");
  expect_refused(riis_vtk_pieces_read_mesh(pieces, -1, &piece), RIIS_INVALID_ARGUMENT, "piece is -1");
  expect_refused(riis_vtk_pieces_read_mesh(pieces, 0, NULL), RIIS_INVALID_ARGUMENT, "mesh is NULL");
  expect_fine(riis_vtk_pieces_read_mesh(pieces, 0, &piece));
  riis_vtk_pieces_destroy(&pieces);
  expect_fine(riis_vtk_mesh_get_nodes(piece, &n, &n_cells, NULL));
  assert_int_equal(n, 27);
  expect_refused(riis_vtk_mesh_get_sharing(NULL, n, role, NULL, &sharing, sizeof sharing), RIIS_INVALID_ARGUMENT,
                 "mesh is NULL");
  expect_refused(riis_vtk_mesh_get_sharing(piece, 26, role, NULL, &sharing, sizeof sharing), RIIS_INVALID_ARGUMENT,
                 "n_nodes is 26; the mesh has 27 nodes");
  expect_refused(riis_vtk_mesh_get_sharing(piece, n, NULL, NULL, &sharing, sizeof sharing), RIIS_INVALID_ARGUMENT,
                 "role is NULL");
  expect_refused(riis_vtk_mesh_get_sharing(piece, n, role, NULL, NULL, sizeof sharing), RIIS_INVALID_ARGUMENT,
                 "sharing is NULL");
  expect_refused(riis_vtk_mesh_get_sharing(piece, n, role, NULL, &sharing, 8), RIIS_INVALID_STRUCT_SIZE, "sharing");
  expect_fine(riis_vtk_mesh_get_sharing(piece, n, role, NULL, &sharing, sizeof sharing));
  assert_int_equal(sharing.n_cells, n_cells);
  assert_int_equal(sharing.n_volume_cells, n_cells);
  assert_int_equal(sharing.has_global_ids, 0);
  const double *xyz = NULL;
  expect_fine(riis_vtk_mesh_get_nodes(piece, NULL, NULL, &xyz));
  for (int64_t i = 0; i < n; ++i) { /* only the node in the middle of the box is inside */
    const int is_middle = xyz[3 * i] == 0.5 && xyz[3 * i + 1] == 0.5 && xyz[3 * i + 2] == 0.5;
    assert_int_equal(role[i], is_middle ? RIIS_VTK_NODE_INSIDE : RIIS_VTK_NODE_SHARED);
  }
  riis_vtk_mesh_destroy(&piece);
}

TEST(test_struct_sizes) {
  riis_vtk_surface *file = NULL;
  riis_surface_arrays arrays = {0};
  riis_vtk_picture_options options = {0};
  expect_fine(riis_vtk_surface_write(surface, scratch_path("valve.vtp")));
  expect_fine(riis_vtk_surface_read(scratch_path("valve.vtp"), NULL, &file));
  expect_refused(riis_vtk_surface_get_arrays(file, NULL, sizeof arrays), RIIS_INVALID_ARGUMENT, "arrays is NULL");
  expect_refused(riis_vtk_surface_get_arrays(file, &arrays, 0), RIIS_INVALID_STRUCT_SIZE,
                 "the struct size of arrays is 0; ");
  assert_int_equal(arrays.struct_size, 0);
  riis_vtk_surface_destroy(&file);
  const int64_t bad_sizes[] = {-8, 0, 4, 40, 52, 63, 168, INT64_MAX};
  for (size_t i = 0; i < sizeof bad_sizes / sizeof bad_sizes[0]; ++i) {
    char text[64];
    snprintf(text, sizeof text, "the struct size of options is %lld; ", (long long)bad_sizes[i]);
    expect_refused(riis_vtk_picture_options_init(&options, bad_sizes[i]), RIIS_INVALID_STRUCT_SIZE, text);
    assert_int_equal(options.struct_size, 0);
    options.struct_size = bad_sizes[i];
    expect_refused(riis_vtk_draw(surface, NULL, &options, scratch_path("a.png")), RIIS_INVALID_STRUCT_SIZE, text);
    options.struct_size = 0;
  }
}

static void expect_bad_edges(const char *part_of_text, const riis_vtk_mesh *drawn, int64_t n, const int64_t *edges) {
  riis_vtk_picture_options options;
  expect_fine(riis_vtk_picture_options_init(&options, sizeof options));
  assert_true(options.n_leaking_edges == 0 && !options.leaking_edges);
  options.n_leaking_edges = n;
  options.leaking_edges = edges;
  expect_refused(riis_vtk_draw(surface, drawn, &options, scratch_path("a.png")), RIIS_INVALID_ARGUMENT, part_of_text);
  assert_int_equal(scratch_exists("a.png"), 0);
}

TEST(test_leaking_edges) {
  const int64_t fine[4] = {0, 1, 25, 26}, below[4] = {0, 1, -1, 2}, above[4] = {0, 1, 2, 27};
  expect_bad_edges("n_leaking_edges is -1", mesh, -1, fine);
  expect_bad_edges("n_leaking_edges is 2, options->leaking_edges is NULL", mesh, 2, NULL);
  expect_bad_edges("n_leaking_edges is 2, and mesh is NULL", NULL, 2, fine);
  expect_bad_edges("leaking_edges[2] is -1; the mesh has 27 nodes", mesh, 2, below);
  expect_bad_edges("leaking_edges[3] is 27; the mesh has 27 nodes", mesh, 2, above);
  expect_bad_edges("mesh has no marks", mesh, 2, fine);
}

TEST(test_many_views) {
  const int32_t views[2] = {RIIS_VTK_VIEW_TOP, 9};
  const char *paths[2] = {scratch_path("a.png"), NULL}, *jpg[1] = {scratch_path("a.jpg")};
  expect_refused(riis_vtk_draw_views(NULL, NULL, NULL, 1, views, paths), RIIS_INVALID_ARGUMENT, "surface is NULL");
  expect_refused(riis_vtk_draw_views(surface, NULL, NULL, -1, views, paths), RIIS_INVALID_ARGUMENT, "n_views is -1");
  expect_refused(riis_vtk_draw_views(surface, NULL, NULL, 1, NULL, paths), RIIS_INVALID_ARGUMENT, "views is NULL");
  expect_refused(riis_vtk_draw_views(surface, NULL, NULL, 1, views, NULL), RIIS_INVALID_ARGUMENT, "paths is NULL");
  expect_refused(riis_vtk_draw_views(surface, NULL, NULL, 2, views, paths), RIIS_INVALID_ARGUMENT, "views[1] is 9");
  const int32_t fine[2] = {0, 1};
  expect_refused(riis_vtk_draw_views(surface, NULL, NULL, 2, fine, paths), RIIS_INVALID_ARGUMENT, "paths[1] is NULL");
  expect_refused(riis_vtk_draw_views(surface, NULL, NULL, 1, fine, jpg), RIIS_FILE_ERROR, "must be .png");
  expect_fine(riis_vtk_draw_views(surface, NULL, NULL, 0, NULL, NULL));
  assert_int_equal(scratch_exists("a.png"), 0);
}

static void expect_bad_picture(const char *part_of_text, int32_t view, int32_t width, int32_t height,
                               int32_t reserved) {
  riis_vtk_picture_options options;
  expect_fine(riis_vtk_picture_options_init(&options, sizeof options));
  assert_true(options.view == RIIS_VTK_VIEW_OBLIQUE && options.width == 1600 && options.height == 800 &&
              !options.reserved && !options.title && !options.leaflet_names && !options.n_leaflet_names);
  options.view = view;
  options.width = width;
  options.height = height;
  options.reserved = reserved;
  expect_refused(riis_vtk_draw(surface, NULL, &options, scratch_path("a.png")), RIIS_INVALID_ARGUMENT, part_of_text);
  assert_int_equal(scratch_exists("a.png"), 0);
}

TEST(test_picture_options) {
  expect_bad_picture("view is 9", 9, 800, 800, 0);
  expect_bad_picture("view is -1", -1, 800, 800, 0);
  expect_bad_picture("width is 63", RIIS_VTK_VIEW_TOP, 63, 800, 0);
  expect_bad_picture("height is 8193", RIIS_VTK_VIEW_TOP, 800, 8193, 0);
  expect_bad_picture("reserved is 1", RIIS_VTK_VIEW_TOP, 800, 800, 1);
  expect_refused(riis_vtk_draw(surface, mesh, NULL, scratch_path("a.png")), RIIS_INVALID_ARGUMENT, "mesh has no marks");
  riis_vtk_picture_options options;
  const char *names[2] = {"one", NULL};
  expect_fine(riis_vtk_picture_options_init(&options, sizeof options));
  options.n_leaflet_names = -1;
  expect_refused(riis_vtk_draw(surface, NULL, &options, scratch_path("a.png")), RIIS_INVALID_ARGUMENT,
                 "n_leaflet_names is -1");
  options.n_leaflet_names = 2;
  expect_refused(riis_vtk_draw(surface, NULL, &options, scratch_path("a.png")), RIIS_INVALID_ARGUMENT,
                 "n_leaflet_names is 2, options->leaflet_names is NULL");
  options.leaflet_names = names;
  expect_refused(riis_vtk_draw(surface, NULL, &options, scratch_path("a.png")), RIIS_INVALID_ARGUMENT,
                 "leaflet_names[1] is NULL");
}

/* Tests the looks of a picture: their defaults, and values out of range. */
TEST(test_looks) {
  riis_vtk_picture_options defaults, options;
  expect_fine(riis_vtk_picture_options_init(&defaults, sizeof defaults));
  for (int k = 0; k < 4; ++k) assert_true(defaults.background[k] == 1);
  assert_true(!defaults.wall && defaults.captions == RIIS_VTK_CAPTIONS_ALL && defaults.panels == RIIS_VTK_PANELS_BOTH);
  const struct {
    double blue, opacity;
    int32_t captions, panels;
    const char *text;
  } bad[] = {{1.5, 1, 0, 0, "background[2] is 1.5, not 0 to 1"},
             {(double)NAN, 1, 0, 0, "background[2] is nan"},
             {0, 0.5, 0, 0, "background[3] is 0.5, neither 0 nor 1"},
             {0, 1, 3, 0, "captions is 3, not a RIIS_VTK_CAPTIONS_*"},
             {0, 1, 0, -1, "panels is -1, not a RIIS_VTK_PANELS_*"},
             {0, 1, 0, RIIS_VTK_PANELS_MARKS, "panels is RIIS_VTK_PANELS_MARKS, and mesh is NULL"}};
  for (size_t i = 0; i < sizeof bad / sizeof bad[0]; ++i) {
    options = defaults;
    options.background[2] = bad[i].blue;
    options.background[3] = bad[i].opacity;
    options.captions = bad[i].captions;
    options.panels = bad[i].panels;
    expect_refused(riis_vtk_draw(surface, NULL, &options, scratch_path("a.png")), RIIS_INVALID_ARGUMENT, bad[i].text);
  }
  /* The struct of an older caller has no looks, so the defaults apply. The refusal below is therefore only for the width. */
  memset(&options, 0xff, sizeof options);
  expect_fine(riis_vtk_picture_options_init(&options, 104));
  options.width = 1;
  expect_refused(riis_vtk_draw(surface, NULL, &options, scratch_path("a.png")), RIIS_INVALID_ARGUMENT, "width is 1");
}

static void expect_bad_axes(const char *part_of_text, double x, double y, double z, double angle) {
  riis_vtk_picture_options options;
  expect_fine(riis_vtk_picture_options_init(&options, sizeof options));
  options.rotation_axis[0] = x;
  options.rotation_axis[1] = y;
  options.rotation_axis[2] = z;
  options.rotation_angle = angle;
  expect_refused(riis_vtk_draw(surface, NULL, &options, scratch_path("a.png")), RIIS_INVALID_ARGUMENT, part_of_text);
}

/* The axes of the valve have the ranges of a placement. The struct of an older caller lacks these axes, so the mesh's axes
 * apply. */
TEST(test_axes_of_valve) {
  riis_vtk_picture_options options;
  expect_fine(riis_vtk_picture_options_init(&options, sizeof options));
  assert_true(options.rotation_axis[0] == 0 && options.rotation_axis[1] == 0 && options.rotation_axis[2] == 1 &&
              options.rotation_angle == 0);
  expect_bad_axes("options->rotation_axis is (0, 0, 0), shorter than 1e-50", 0, 0, 0, 1);
  expect_bad_axes("options->rotation_axis[1] is nan, not -1e50 to 1e50", 0, (double)NAN, 1, 1);
  expect_bad_axes("options->rotation_axis[2] is -2e+50, not -1e50 to 1e50", 0, 0, -2e50, 1);
  expect_bad_axes("options->rotation_angle is 2e+06, not -1e6 to 1e6", 0, 0, 1, 2e6);
  expect_bad_axes("options->rotation_angle is inf, not -1e6 to 1e6", 0, 0, 1, (double)INFINITY);
  memset(&options, 0xff, sizeof options);
  expect_fine(riis_vtk_picture_options_init(&options, 72));
  options.width = 1;
  expect_refused(riis_vtk_draw(surface, NULL, &options, scratch_path("a.png")), RIIS_INVALID_ARGUMENT, "width is 1");
}

/* A message has one line even if a name contains a line break. With a very long name, the message keeps the reason. */
TEST(test_odd_names) {
  riis_vtk_mesh *other = NULL;
  expect_refused(riis_vtk_mesh_read(scratch_path("a\nb.vtu"), &other), RIIS_FILE_ERROR,
                 "a?b.vtu: cannot be read: No such file");
  static char name[4000];
  memset(name, 'x', sizeof name - 1);
  expect_refused(
      riis_vtk_mesh_read(name, &other), RIIS_FILE_ERROR,
      "xxx: a mesh must be a .vtu, .vtk, .vti, .vtr, .vts, .vtm, .msh, .xdmf or .exo file, or a case of OpenFOAM");
}

TEST(test_floating_point_environment) {
  riis_vtk_mesh *other = NULL;
  fesetround(FE_UPWARD);
  feclearexcept(FE_ALL_EXCEPT);
  feraiseexcept(FE_OVERFLOW);
  const riis_status status = riis_vtk_mesh_read(scratch_path("in.vtu"), &other);
  const int rounding = fegetround();
  const int flags = fetestexcept(FE_ALL_EXCEPT);
  fesetenv(FE_DFL_ENV);
  expect_fine(status);
  riis_vtk_mesh_destroy(&other);
  assert_int_equal(rounding, FE_UPWARD);
  assert_true(flags & FE_OVERFLOW);
}

int main(void) { return run_cases(make_all, destroy_all); }
