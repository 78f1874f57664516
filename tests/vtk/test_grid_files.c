/* SPDX-License-Identifier: Apache-2.0
 *
 * Tests structured grids from files. An image and a rectilinear grid are read as axes. A turned or curvilinear grid is read as
 * points. All results equal those of a .vtu with these nodes and cells. */
#include <math.h>
#include <riis/riis_vtk.h>

#include "../support/test_support.h"

#include "../support/calls.h"

#include "expect.h"
#include "grids_shim.h"
#include "scratch.h"
#include "vtk_shim.h"

enum { most_along = 12, most_nodes = most_along * most_along * most_along };

static random_source rng;
static double between(double low, double high) { return random_between(&rng, low, high); }
static int64_t any_of(int64_t n) { return (int64_t)(random_bits(&rng) % (uint64_t)n); }

static double axis_values[3][most_along];

/* Makes a random image, or a rectilinear grid with unequal steps. */
static shim_grid random_grid(int is_image) {
  shim_grid grid = {.spacing = {1, 1, 1}, .n_zones = (int)any_of(20)};
  for (int c = 0; c < 3; ++c) {
    grid.n[c] = 2 + (int)any_of(most_along - 1);
    if (is_image) {
      grid.first[c] = (int)any_of(9) - 4;
      grid.origin[c] = between(-3, 3);
      grid.spacing[c] = between(0.05, 1);
      continue;
    }
    double x = between(-3, 3);
    for (int i = 0; i < grid.n[c]; ++i) axis_values[c][i] = x += between(0.05, 1);
    grid.x[c] = axis_values[c];
  }
  return grid;
}

static int n_with_regions;

static riis_vtk_mesh *mesh_of(const char *name) {
  riis_vtk_mesh *mesh = NULL;
  expect_fine(riis_vtk_mesh_read(scratch_path(name), &mesh));
  return mesh;
}

static riis_grid axes_of(const riis_vtk_mesh *mesh) {
  riis_grid axes;
  expect_fine(riis_vtk_mesh_get_axes(mesh, &axes, sizeof axes));
  return axes;
}

static int64_t n_nodes_of(const riis_vtk_mesh *mesh, int64_t *n_cells, const double **xyz) {
  int64_t n = 0;
  expect_fine(riis_vtk_mesh_get_nodes(mesh, &n, n_cells, xyz));
  return n;
}

static void check_boundaries(const riis_vtk_mesh *a, const riis_vtk_mesh *b) {
  riis_vtk_surface *surfaces[2] = {NULL, NULL};
  riis_surface_arrays arrays[2];
  const riis_vtk_mesh *const meshes[2] = {a, b};
  for (int i = 0; i < 2; ++i) {
    expect_fine(riis_vtk_mesh_get_boundary(meshes[i], &surfaces[i]));
    expect_fine(riis_surface_arrays_init(&arrays[i], sizeof arrays[i]));
    expect_fine(riis_vtk_surface_get_arrays(surfaces[i], &arrays[i], sizeof arrays[i]));
  }
  assert_int_equal(arrays[0].n_faces, arrays[1].n_faces);
  assert_int_equal(arrays[0].n_vertices, arrays[1].n_vertices);
  for (int i = 0; i < 2; ++i) riis_vtk_surface_destroy(&surfaces[i]);
}

/* Compares the results that do not need the cells, and then the results that do. */
static void check_meshes(riis_vtk_mesh *got, riis_vtk_mesh *expected, int has_axes) {
  int64_t n_cells[2], n_volumes[2], n_left_out[2];
  const double *xyz[2];
  riis_vtk_mesh *const meshes[2] = {got, expected};
  double edges[2];
  static double asked[3 * 200];
  uint8_t outside[2][200];
  const int64_t n = n_nodes_of(expected, &n_cells[1], &xyz[1]);
  assert_int_equal(n_nodes_of(got, &n_cells[0], NULL), n);
  assert_int_equal(n_cells[0], n_cells[1]);
  double lower[3] = {1e9, 1e9, 1e9}, upper[3] = {-1e9, -1e9, -1e9};
  for (int64_t i = 0; i < 3 * n; ++i) {
    lower[i % 3] = fmin(lower[i % 3], xyz[1][i]);
    upper[i % 3] = fmax(upper[i % 3], xyz[1][i]);
  }
  for (int i = 0; i < 600; ++i) asked[i] = between(lower[i % 3] - 1, upper[i % 3] + 1);
  memset(outside, 1, sizeof outside);
  for (int i = 0; i < 2; ++i) {
    expect_fine(riis_vtk_mesh_get_volume_cells(meshes[i], &n_volumes[i], &n_left_out[i]));
    expect_fine(riis_vtk_mesh_get_median_edge(meshes[i], &edges[i]));
    expect_fine(riis_vtk_mesh_find_outside(meshes[i], 200, asked, 0.3, outside[i]));
  }
  assert_int_equal(n_volumes[0], n_volumes[1]);
  assert_int_equal(n_left_out[0], n_left_out[1]);
  assert_memory_equal(&edges[0], &edges[1], sizeof edges[0]);
  assert_memory_equal(outside[0], outside[1], sizeof outside[0]);
  assert_int_equal(axes_of(got).ni > 0, has_axes);
  if (has_axes) {
    const riis_grid axes = axes_of(got);
    const double *const x = axes.x, *const y = axes.y, *const z = axes.z;
    assert_int_equal(axes.ni * axes.nj * axes.nk, n);
    for (int64_t i = 0; i < n; ++i) {
      const double at[3] = {x[i % axes.ni], y[i / axes.ni % axes.nj], z[i / axes.ni / axes.nj]};
      assert_memory_equal(at, xyz[1] + 3 * i, sizeof at);
    }
  }
  const char *regions[2];
  int64_t n_values[2];
  const double *region_values[2];
  for (int i = 0; i < 2; ++i)
    expect_fine(riis_vtk_mesh_find_regions(meshes[i], &regions[i], &n_values[i], &region_values[i]));
  assert_string_equal(regions[0], regions[1]);
  assert_int_equal(n_values[0], n_values[1]);
  for (int64_t i = 0; i < n_values[0]; ++i) assert_true(region_values[0][i] == region_values[1][i]);
  if (n_values[0] > 0) ++n_with_regions;
  riis_adjacency *rows[2] = {NULL, NULL};
  riis_csr csr[2];
  for (int i = 0; i < 2; ++i) {
    expect_fine(riis_vtk_mesh_create_adjacency(meshes[i], 1, &rows[i]));
    expect_fine(riis_adjacency_get_csr(rows[i], &csr[i], sizeof csr[i]));
  }
  const int64_t *const ends = csr[1].offsets;
  assert_memory_equal(csr[0].offsets, ends, (size_t)(n + 1) * sizeof *ends);
  assert_int_equal(csr[0].column_bits, csr[1].column_bits);
  assert_memory_equal(csr[0].columns, csr[1].columns, (size_t)(ends[n] * csr[0].column_bits / 8));
  for (int i = 0; i < 2; ++i) riis_adjacency_destroy(&rows[i]);
  n_nodes_of(got, NULL, &xyz[0]);
  assert_memory_equal(xyz[0], xyz[1], (size_t)n * 3 * sizeof(double));
  static int64_t offsets[2][most_nodes + 1], ids[2][8 * most_nodes];
  static uint8_t types[2][most_nodes];
  for (int i = 0; i < 2; ++i) {
    expect_fine(riis_vtk_mesh_copy_cells(meshes[i], n_cells[1], offsets[i], types[i], 0, NULL));
    expect_fine(riis_vtk_mesh_copy_cells(meshes[i], n_cells[1], offsets[i], types[i], offsets[i][n_cells[1]], ids[i]));
  }
  assert_memory_equal(types[0], types[1], (size_t)n_cells[1]);
  assert_memory_equal(offsets[0], offsets[1], (size_t)(n_cells[1] + 1) * sizeof(int64_t));
  assert_memory_equal(ids[0], ids[1], (size_t)offsets[1][n_cells[1]] * sizeof(int64_t));
  if (n_volumes[0] > 0) check_boundaries(got, expected);
}

static void check_arrays(const char *a, const char *b) {
  static double values[2][most_nodes];
  static const struct {
    char where;
    const char *name;
  } arrays[] = {{'p', "value"}, {'c', "sample"}};
  for (int i = 0; i < 2; ++i) {
    char type[32];
    int64_t n_components = 0, n[2] = {0, 0};
    assert_true(
        shim_read_array(scratch_path(a), arrays[i].where, arrays[i].name, type, &n_components, &n[0], values[0]));
    assert_true(
        shim_read_array(scratch_path(b), arrays[i].where, arrays[i].name, type, &n_components, &n[1], values[1]));
    assert_int_equal(n[0], n[1]);
    assert_memory_equal(values[0], values[1], (size_t)n[0] * sizeof(double));
  }
}

/* Compares a file of the grid with the .vtu of this grid. */
static void check_file(const char *name, int encoding, const shim_grid *grid, int has_axes) {
  assert_int_equal(shim_write_grid(scratch_path(name), encoding, grid), 1);
  assert_int_equal(shim_write_grid_as_cells(scratch_path("cells.vtu"), grid), 1);
  riis_vtk_mesh *got = mesh_of(name), *expected = mesh_of("cells.vtu");
  const char *notes = NULL;
  expect_fine(riis_vtk_mesh_get_notes(got, &notes));
  assert_string_equal(notes, grid->is_single ? "its points have single precision" : "");
  check_meshes(got, expected, has_axes);
  expect_fine(riis_vtk_mesh_write(got, scratch_path("written.vtu")));
  expect_fine(riis_vtk_mesh_write(expected, scratch_path("expected.vtu")));
  if (encoding != SHIM_LEGACY_ASCII) check_arrays("written.vtu", "expected.vtu"); /* its text has fewer digits */
  if (n_nodes_of(got, NULL, NULL) > 7) {
    expect_fine(riis_vtk_mesh_use_centers(got));
    expect_fine(riis_vtk_mesh_use_centers(expected));
    assert_int_equal(axes_of(got).ni, 0);
    const double *xyz[2];
    const int64_t n = n_nodes_of(got, NULL, &xyz[0]);
    assert_int_equal(n_nodes_of(expected, NULL, &xyz[1]), n);
    assert_memory_equal(xyz[0], xyz[1], (size_t)n * 3 * sizeof(double));
  }
  riis_vtk_mesh_destroy(&got);
  riis_vtk_mesh_destroy(&expected);
}

TEST(test_axes) {
  for (int trial = 0; trial < trials(6, 60); ++trial)
    for (int encoding = SHIM_ASCII; encoding <= SHIM_RAW; ++encoding) {
      shim_grid grid = random_grid(1);
      check_file("grid.vti", encoding, &grid, 1);
      grid = random_grid(0);
      grid.is_single = any_of(3) == 0;
      check_file("grid.vtr", encoding, &grid, 1);
      /* Legacy files of text have fewer digits of the origin. The first index of a legacy file is 0. */
      grid = random_grid(any_of(2) == 0);
      for (int c = 0; c < 3; ++c) grid.first[c] = 0, grid.origin[c] = 0.125 * c, grid.spacing[c] = 0.25;
      check_file("grid.vtk", grid.x[0] ? SHIM_LEGACY_BINARY : SHIM_LEGACY_ASCII + trial % 2, &grid, 1);
    }
  CHECK_MET(n_with_regions > 5);
}

/* If nodes do not lie on three ascending axes, they become points. */
TEST(test_points) {
  for (int trial = 0; trial < trials(4, 40); ++trial)
    for (int encoding = SHIM_ASCII; encoding <= SHIM_RAW; ++encoding) {
      shim_grid grid = random_grid(1);
      grid.turn = between(0.1, 3);
      check_file("turned.vti", encoding, &grid, 0);
      grid = random_grid(trial % 2);
      grid.is_curved = 1, grid.bend = 0.01, grid.is_single = any_of(3) == 0;
      check_file("curved.vts", encoding, &grid, 0);
      grid.is_single = 0;
      for (int c = 0; c < 3; ++c) grid.first[c] = 0, grid.origin[c] = 0.125 * c, grid.spacing[c] = 0.25;
      check_file("curved.vtk", SHIM_LEGACY_BINARY, &grid, 0);
    }
}

/* A layer, a row or a single node has no volume cells. The edges are unknown, as in a .vtu. */
TEST(test_thin_grids) {
  for (int thin = 1; thin < 8; ++thin) {
    shim_grid grid = random_grid(1);
    for (int c = 0; c < 3; ++c)
      if (thin >> c & 1) grid.n[c] = 1;
    assert_int_equal(shim_write_grid(scratch_path("thin.vti"), SHIM_RAW, &grid), 1);
    assert_int_equal(shim_write_grid_as_cells(scratch_path("cells.vtu"), &grid), 1);
    riis_vtk_mesh *got = mesh_of("thin.vti"), *expected = mesh_of("cells.vtu");
    check_meshes(got, expected, 0);
    riis_vtk_mesh_destroy(&got);
    riis_vtk_mesh_destroy(&expected);
  }
}

/* If axes descend, the cells keep their orientation, and the boundary points outwards. */
TEST(test_descending_axes) {
  for (int which = 1; which < 8; ++which) {
    shim_grid grid = random_grid(1);
    double expected = 1;
    for (int c = 0; c < 3; ++c) {
      expected *= (grid.n[c] - 1) * grid.spacing[c];
      if (which >> c & 1) grid.spacing[c] = -grid.spacing[c];
    }
    assert_int_equal(shim_write_grid(scratch_path("descending.vti"), SHIM_RAW, &grid), 1);
    riis_vtk_mesh *mesh = mesh_of("descending.vti");
    assert_int_equal(axes_of(mesh).ni, 0);
    riis_vtk_surface *boundary = NULL;
    riis_surface_arrays arrays;
    expect_fine(riis_vtk_mesh_get_boundary(mesh, &boundary));
    expect_fine(riis_surface_arrays_init(&arrays, sizeof arrays));
    expect_fine(riis_vtk_surface_get_arrays(boundary, &arrays, sizeof arrays));
    riis_surface *surface = NULL;
    expect_fine(riis_surface_create_from_arrays(&arrays, NULL, &surface));
    const riis_triangles triangles = triangles_of(surface);
    double volume = 0;
    for (int64_t t = 0; t < triangles.n_triangles; ++t) {
      const double *p[3];
      for (int k = 0; k < 3; ++k) p[k] = triangles.xyz + 3 * triangles.vertex_id[3 * t + k];
      for (int c = 0; c < 3; ++c) {
        const int u = (c + 1) % 3, v = (c + 2) % 3;
        volume += p[0][c] * (p[1][u] * p[2][v] - p[1][v] * p[2][u]) / 6;
      }
    }
    assert_true(fabs(volume - expected) < 1e-9 * expected);
    riis_surface_destroy(&surface);
    riis_vtk_surface_destroy(&boundary);
    riis_vtk_mesh_destroy(&mesh);
  }
}

/* Arrays that are set on axes can be read again from a .vti and a .vtr, and the axes of these files have the same bits. */
TEST(test_written_axes) {
  for (int trial = 0; trial < trials(10, 100); ++trial) {
    const int is_image = trial % 2;
    const shim_grid grid = random_grid(is_image);
    const char *const source = is_image ? "source.vti" : "source.vtr";
    assert_int_equal(shim_write_grid(scratch_path(source), SHIM_RAW, &grid), 1);
    riis_vtk_mesh *mesh = mesh_of(source);
    static double values[most_nodes], got[most_nodes], x[3][most_along];
    const int64_t n = n_nodes_of(mesh, NULL, NULL);
    for (int64_t i = 0; i < n; ++i) values[i] = between(-1, 1);
    expect_fine(riis_vtk_mesh_set_point_array(mesh, "K", n, 1, values));
    const riis_grid axes = axes_of(mesh);
    const double *const expected[3] = {axes.x, axes.y, axes.z};
    const int64_t sizes[3] = {axes.ni, axes.nj, axes.nk};
    for (int is_vti = 0; is_vti <= is_image; ++is_vti) {
      const char *const name = is_vti ? "written.vti" : "written.vtr";
      expect_fine(riis_vtk_mesh_write(mesh, scratch_path(name)));
      int sizes_read[3];
      double *const to[3] = {x[0], x[1], x[2]};
      assert_int_equal(shim_read_grid(scratch_path(name), sizes_read, to, "K", got), 1);
      assert_memory_equal(got, values, (size_t)n * sizeof *got);
      for (int c = 0; c < 3; ++c) {
        assert_int_equal(sizes_read[c], sizes[c]);
        assert_memory_equal(x[c], expected[c], (size_t)sizes[c] * sizeof(double));
      }
    }
    if (!is_image)
      expect_refused(
          riis_vtk_mesh_write(mesh, scratch_path("no.vti")), RIIS_FILE_ERROR,
          "no.vti: takes a mesh that was read as an image, with ascending axes; give a path that ends in .vtu");
    riis_vtk_mesh_destroy(&mesh);
  }
  const shim_grid grid = random_grid(1);
  assert_int_equal(shim_write_grid_as_cells(scratch_path("cells.vtu"), &grid), 1);
  riis_vtk_mesh *mesh = mesh_of("cells.vtu");
  expect_refused(riis_vtk_mesh_write(mesh, scratch_path("no.vtr")), RIIS_FILE_ERROR,
                 "takes a mesh that was read as a rectilinear grid");
  riis_grid axes;
  expect_refused(riis_vtk_mesh_get_axes(mesh, NULL, sizeof axes), RIIS_INVALID_ARGUMENT, "grid is NULL");
  expect_refused(riis_vtk_mesh_get_axes(NULL, &axes, sizeof axes), RIIS_INVALID_ARGUMENT, "mesh is NULL");
  expect_refused(riis_vtk_mesh_get_axes(mesh, &axes, 8), RIIS_INVALID_STRUCT_SIZE, "grid");
  riis_vtk_mesh_destroy(&mesh);
}

int main(void) {
  rng = random_start("test_grid_files");
  return run_cases(scratch_setup, scratch_teardown);
}
