/* SPDX-License-Identifier: Apache-2.0
 *
 * Compares the adjacency of meshes from files with the edges of VTK's cells. Also compares the adjacency with the edges of other
 * cells on the same nodes. */
#include <math.h>
#include <riis/riis_vtk.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "../support/test_support.h"

#include "calls.h"
#include "expect.h"
#include "plain_mesh.h"
#include "scratch.h"
#include "vtk_shim.h"

enum { n_side = 9, n_box = n_side * n_side * n_side };
/* VTK's numbers of the types of volume cells with straight sides: tetrahedron, voxel, hexahedron, wedge, pyramid, prisms of
 * five and six sides, polyhedron. */
static const int volume_types[] = {10, 11, 12, 13, 14, 15, 16, 42};

static riis_vtk_mesh *read_mesh(const char *name) {
  riis_vtk_mesh *mesh = NULL;
  expect_fine(riis_vtk_mesh_read(scratch_path(name), &mesh));
  return mesh;
}

/* Sets are_joined[i * n + j] from VTK's edges. Returns the number of pairs. */
static int64_t join_by_vtk(const char *path, int64_t n_nodes, uint8_t *are_joined) {
  static int64_t edges[2 * 40000];
  int64_t n_pairs = 0;
  memset(are_joined, 0, (size_t)(n_nodes * n_nodes));
  const size_t n_types = sizeof volume_types / sizeof volume_types[0];
  for (size_t t = 0; t <= n_types; ++t) {
    const int64_t n = t < n_types ? shim_read_edges(path, volume_types[t], NULL) : shim_read_curved_edges(path, NULL);
    assert_in_range(n, 0, 40000);
    assert_int_equal(t < n_types ? shim_read_edges(path, volume_types[t], edges) : shim_read_curved_edges(path, edges),
                     n);
    for (int64_t i = 0; i < n; ++i) {
      const int64_t a = edges[2 * i], b = edges[2 * i + 1];
      n_pairs += 2 * !are_joined[a * n_nodes + b];
      are_joined[a * n_nodes + b] = are_joined[b * n_nodes + a] = 1;
    }
  }
  return n_pairs;
}

/* Checks the rows. Returns the number of columns. */
static int64_t expect_rows(const riis_adjacency *adjacency, int64_t n_nodes, const uint8_t *are_joined) {
  riis_csr csr;
  expect_fine(riis_adjacency_get_csr(adjacency, &csr, sizeof csr));
  assert_int_equal(csr.n_rows, n_nodes);
  assert_int_equal(csr.offset_bits, 64);
  assert_int_equal(csr.column_bits, 32);
  assert_int_equal(csr.index_base, 0);
  const int64_t *offsets = csr.offsets;
  const int32_t *columns = csr.columns;
  int64_t at = 0;
  for (int64_t i = 0; i < n_nodes; ++i) {
    assert_int_equal(offsets[i], at);
    for (int64_t j = 0; j < n_nodes; ++j) {
      if (!are_joined[i * n_nodes + j]) continue;
      assert_true(at < offsets[i + 1]);
      assert_int_equal(columns[at], j);
      ++at;
    }
  }
  assert_int_equal(offsets[n_nodes], at);
  return at;
}

static void expect_adjacency(const char *name, int64_t n_nodes, int64_t least_pairs) {
  uint8_t *are_joined = malloc((size_t)(n_nodes * n_nodes));
  const int64_t n_pairs = join_by_vtk(scratch_path(name), n_nodes, are_joined);
  assert_true(n_pairs >= least_pairs);
  riis_vtk_mesh *mesh = read_mesh(name);
  for (int32_t n_threads = 0; n_threads <= 3; ++n_threads) {
    riis_adjacency *adjacency = NULL;
    expect_fine(riis_vtk_mesh_create_adjacency(mesh, n_threads, &adjacency));
    assert_int_equal(expect_rows(adjacency, n_nodes, are_joined), n_pairs);
    riis_adjacency_destroy(&adjacency);
  }
  riis_vtk_mesh_destroy(&mesh);
  free(are_joined);
}

TEST(test_tetrahedra) {
  const double lower[3] = {0, 0, 0}, upper[3] = {1, 1, 1};
  assert_int_equal(shim_write_box(scratch_path("box.vtu"), SHIM_RAW, n_side, lower, upper, 0), 1);
  expect_adjacency("box.vtu", n_box, 7 * n_box);
  assert_int_equal(shim_write_box(scratch_path("box.vtk"), SHIM_LEGACY_BINARY, n_side, lower, upper, 0), 1);
  expect_adjacency("box.vtk", n_box, 7 * n_box);
}

TEST(test_every_cell) {
  assert_int_equal(shim_write_zoo(scratch_path("zoo.vtu")), 1);
  for (size_t t = 0; t < sizeof volume_types / sizeof volume_types[0]; ++t) {
    if (volume_types[t] == 16) continue;
    assert_true(shim_read_edges(scratch_path("zoo.vtu"), volume_types[t], NULL) >= 3 * 6);
  }
  assert_int_equal(shim_read_curved_edges(scratch_path("zoo.vtu"), NULL), 3 * 24);
  expect_adjacency("zoo.vtu", n_shim_zoo, 100);
}

/* Checks that the file has the expected rows. */
static void expect_same_rows(const char *name, const riis_csr *expected) {
  riis_vtk_mesh *mesh = read_mesh(name);
  riis_adjacency *adjacency = NULL;
  riis_csr csr;
  expect_fine(riis_vtk_mesh_create_adjacency(mesh, 2, &adjacency));
  expect_fine(riis_adjacency_get_csr(adjacency, &csr, sizeof csr));
  assert_int_equal(csr.n_rows, expected->n_rows);
  assert_memory_equal(csr.offsets, expected->offsets, (size_t)(csr.n_rows + 1) * 8);
  assert_memory_equal(csr.columns, expected->columns, (size_t)((const int64_t *)csr.offsets)[csr.n_rows] * 4);
  riis_adjacency_destroy(&adjacency);
  riis_vtk_mesh_destroy(&mesh);
}

/* Makes a triangle with the given bounding box. */
static riis_surface *surface_in(const double lower[3], const double upper[3]) {
  const double xyz[9] = {lower[0], lower[1], lower[2], upper[0], upper[1], lower[2], upper[0], lower[1], upper[2]};
  const int32_t ids[3] = {0, 1, 2};
  riis_surface_arrays arrays;
  riis_surface *surface = NULL;
  expect_fine(riis_surface_arrays_init(&arrays, sizeof arrays));
  arrays.n_vertices = 3, arrays.n_faces = 1, arrays.stride = 3, arrays.vertex_ids = ids;
  arrays.x = xyz, arrays.y = xyz + 1, arrays.z = xyz + 2;
  expect_fine(riis_surface_create_from_arrays(&arrays, NULL, &surface));
  return surface;
}

/* Checks the pairs that VTK joins. The rows must contain each pair that is long enough and whose bounding box meets the given
 * box. */
static void expect_long_edges(const char *name, int64_t n_nodes, const double lower[3], const double upper[3],
                              double longer_than, int64_t n_left_out) {
  uint8_t *are_joined = malloc((size_t)(n_nodes * n_nodes));
  int64_t n_all = join_by_vtk(scratch_path(name), n_nodes, are_joined), n = 0, n_out = -1;
  const double *xyz = NULL;
  riis_vtk_mesh *mesh = read_mesh(name);
  riis_surface *surface = surface_in(lower, upper);
  expect_fine(riis_vtk_mesh_get_nodes(mesh, NULL, NULL, &xyz));
  for (int64_t i = 0; i < n_nodes * n_nodes; ++i) {
    const double *a = xyz + 3 * (i / n_nodes), *b = xyz + 3 * (i % n_nodes);
    double square = 0;
    for (int c = 0; c < 3; ++c) {
      square += (a[c] - b[c]) * (a[c] - b[c]);
      are_joined[i] &= !(a[c] < lower[c] && b[c] < lower[c]) && !(a[c] > upper[c] && b[c] > upper[c]);
    }
    are_joined[i] &= sqrt(square) > longer_than * (1 - 1e-9);
    n += are_joined[i];
  }
  for (int32_t n_threads = 0; n_threads <= 2; ++n_threads) {
    riis_adjacency *adjacency = NULL;
    expect_fine(
        riis_vtk_mesh_create_long_edges(mesh, surface, longer_than, n_threads, n_threads ? &n_out : NULL, &adjacency));
    assert_int_equal(expect_rows(adjacency, n_nodes, are_joined), n);
    riis_adjacency_destroy(&adjacency);
  }
  assert_int_equal(n_out, n_left_out);
  assert_true(n > 0 && n < n_all);
  riis_surface_destroy(&surface);
  riis_vtk_mesh_destroy(&mesh);
  free(are_joined);
}

/* A quad's diagonals are not edges. A voxel and a hexahedron order their nodes differently. */
TEST(test_voxel) {
  scratch_write_text("voxel.vtk",
                     "# vtk DataFile Version 3.0\nvoxel\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 9 double\n"
                     "0 0 0 1 0 0 0 1 0 1 1 0 0 0 1 1 0 1 0 1 1 1 1 1 5 5 5\n"
                     "CELLS 1 9\n8 0 1 2 3 4 5 6 7\nCELL_TYPES 1\n11\n");
  uint8_t are_joined[81] = {0};
  for (int i = 0; i < 8; ++i) {
    for (int bit = 1; bit < 8; bit *= 2) are_joined[9 * i + (i ^ bit)] = 1;
  }
  riis_vtk_mesh *mesh = read_mesh("voxel.vtk");
  riis_adjacency *adjacency = NULL;
  expect_fine(riis_vtk_mesh_create_adjacency(mesh, 1, &adjacency));
  assert_int_equal(expect_rows(adjacency, 9, are_joined), 24);
  riis_adjacency_destroy(&adjacency);
  riis_vtk_mesh_destroy(&mesh);
}

/* The rows are empty in a mesh without volume cells, or with cells whose edges are unknown. The neighbour search still finds all
 * nodes. */
TEST(test_no_volume) {
  const char *cells[] = {"CELLS 0 0\nCELL_TYPES 0\n", "CELLS 2 8\n3 0 1 2\n3 1 2 3\nCELL_TYPES 2\n5\n5\n",
                         "CELLS 1 11\n10 0 1 2 3 4 5 6 7 8 9\nCELL_TYPES 1\n41\n"};
  const uint8_t are_joined[100] = {0};
  riis_valve *valve = NULL;
  riis_surface *surface = NULL;
  expect_fine(riis_valve_create("aortic", &valve));
  expect_fine(riis_surface_create(valve, NULL, &surface));
  riis_valve_destroy(&valve);
  for (size_t c = 0; c < sizeof cells / sizeof cells[0]; ++c) {
    char text[1024];
    snprintf(text, sizeof text,
             "# vtk DataFile Version 3.0\nplain\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 10 double\n"
             "1.3 0 -1 0 1.3 -1 0 0 -.2 0 0 9 0 0 -.3 .1 0 -.3 0 .1 -.3 .1 .1 -.3 0 0 -.5 0 0 -.7\n%s",
             cells[c]);
    scratch_write_text("plain.vtk", text);
    riis_vtk_mesh *file = read_mesh("plain.vtk");
    riis_adjacency *adjacency = NULL;
    expect_fine(riis_vtk_mesh_create_adjacency(file, 2, &adjacency));
    assert_int_equal(expect_rows(adjacency, 10, are_joined), 0);

    riis_csr csr;
    riis_mesh *mesh = NULL;
    riis_marks *result[2] = {NULL, NULL};
    riis_mark_options options;
    riis_mark_stats stats[2];
    const double *xyz = NULL;
    expect_fine(riis_vtk_mesh_get_nodes(file, NULL, NULL, &xyz));
    expect_fine(riis_mesh_create(10, xyz, xyz + 1, xyz + 2, 3, &mesh));
    expect_fine(riis_adjacency_get_csr(adjacency, &csr, sizeof csr));
    expect_fine(riis_mesh_set_adjacency(mesh, &csr));
    expect_fine(riis_mark_options_init(&options, sizeof options));
    options.distance_limit = 0.5;
    for (int i = 0; i < 2; ++i) {
      options.search = i ? RIIS_SEARCH_NEIGHBOR : RIIS_SEARCH_EXHAUSTIVE;
      expect_fine(riis_marks_create(&result[i]));
      expect_fine(riis_mark_nodes(surface, mesh, &options, result[i]));
      expect_fine(riis_marks_get_stats(result[i], &stats[i], sizeof stats[i]));
      assert_int_equal(stats[i].complete, 1);
    }
    assert_in_range(stats[0].n_within_limit, 3, 9);
    assert_int_equal(stats[0].n_within_limit, stats[1].n_within_limit);
    const int64_t *node[2];
    const double *distance[2];
    for (int i = 0; i < 2; ++i) {
      node[i] = within_list(result[i]).node_id;
      distance[i] = within_list(result[i]).distance;
    }
    assert_memory_equal(node[0], node[1], (size_t)stats[0].n_within_limit * sizeof *node[0]);
    assert_memory_equal(distance[0], distance[1], (size_t)stats[0].n_within_limit * sizeof *distance[0]);
    for (int i = 0; i < 2; ++i) riis_marks_destroy(&result[i]);
    riis_mesh_destroy(&mesh);
    riis_adjacency_destroy(&adjacency);
    riis_vtk_mesh_destroy(&file);
  }
  riis_surface_destroy(&surface);
}

TEST(test_threads) {
  shim_write_zoo(scratch_path("zoo.vtu"));
  scratch_write_text("point.vtk",
                     "# vtk DataFile Version 3.0\none\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 1 double\n0 0 0\n"
                     "CELLS 1 2\n1 0\nCELL_TYPES 1\n1\n");
  const char *names[] = {"zoo.vtu", "point.vtk"};
  for (int i = 0; i < 2; ++i) {
    riis_vtk_mesh *mesh = read_mesh(names[i]);
    riis_adjacency *adjacency = NULL;
    expect_refused(riis_vtk_mesh_create_adjacency(mesh, -1, &adjacency), RIIS_INVALID_ARGUMENT, "n_threads is -1");
    expect_refused(riis_vtk_mesh_create_adjacency(mesh, 1025, &adjacency), RIIS_INVALID_ARGUMENT, "n_threads is 1025");
    assert_true(strncmp(riis_last_error(), "n_threads", 9) == 0);
    assert_null(adjacency);
    riis_vtk_mesh_destroy(&mesh);
  }
}

TEST(test_long_edges) {
  const double lower[3] = {0, 0, 0}, upper[3] = {1, 1, 1}, inner[3] = {0.3, 0.2, 0.1}, outer[3] = {0.8, 0.9, 0.6};
  assert_int_equal(shim_write_box(scratch_path("box.vtu"), SHIM_RAW, n_side, lower, upper, 0), 1);
  expect_long_edges("box.vtu", n_box, inner, outer, 0, 0);
  expect_long_edges("box.vtu", n_box, lower, upper, 0.126, 0);
  /* The limit of the length equals the length of the cubes' diagonals, up to a billionth. */
  expect_long_edges("box.vtu", n_box, lower, upper, 0.125 * sqrt(3), 0);
  assert_int_equal(shim_write_zoo(scratch_path("zoo.vtu")), 1);
  expect_long_edges("zoo.vtu", n_shim_zoo, inner, outer, 2, 0);
}

TEST(test_long_edges_refused) {
  const double lower[3] = {0, 0, 0}, upper[3] = {1, 1, 1};
  riis_vtk_mesh *mesh = read_mesh("box.vtu");
  riis_surface *surface = surface_in(lower, upper);
  riis_adjacency *adjacency = NULL;
  const double bad[3] = {-1, NAN, INFINITY};
  const char *const texts[3] = {"longer_than is -1;", "longer_than is nan;", "longer_than is inf;"};
  for (int i = 0; i < 3; ++i)
    expect_refused(riis_vtk_mesh_create_long_edges(mesh, surface, bad[i], 1, NULL, &adjacency), RIIS_INVALID_ARGUMENT,
                   texts[i]);
  expect_refused(riis_vtk_mesh_create_long_edges(mesh, surface, 0, -1, NULL, &adjacency), RIIS_INVALID_ARGUMENT,
                 "n_threads is -1");
  assert_null(adjacency);
  riis_surface_destroy(&surface);
  riis_vtk_mesh_destroy(&mesh);
}

/* The mesh has random cells of all types of higher order, and prisms with six sides. */
TEST(test_curved_cells) {
  enum { n_nodes = 300 };
  random_source random = random_start("test_mesh_adjacency");
  for (int round = 0; round < 5; ++round) {
    assert_int_equal(shim_write_curved(scratch_path("curved.vtu"), n_nodes, (uint32_t)random_bits(&random)), 1);
    expect_adjacency("curved.vtu", n_nodes, 1000);
    riis_vtk_mesh *mesh = read_mesh("curved.vtu");
    int64_t n_volumes = 0, n_left_out = -1, n_cells = 0;
    expect_fine(riis_vtk_mesh_get_nodes(mesh, NULL, &n_cells, NULL));
    expect_fine(riis_vtk_mesh_get_volume_cells(mesh, &n_volumes, &n_left_out));
    assert_true(n_volumes == n_cells && n_left_out == 0);
    riis_vtk_mesh_destroy(&mesh);
  }
  scratch_write_text("prism.vtk",
                     "# vtk DataFile Version 3.0\nprism\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 12 double\n"
                     "0 0 0 1 0 0 2 1 0 1 2 0 0 2 0 -1 1 0 0 0 1 1 0 1 2 1 1 1 2 1 0 2 1 -1 1 1\n"
                     "CELLS 1 13\n12 0 1 2 3 4 5 6 7 8 9 10 11\nCELL_TYPES 1\n16\n");
  expect_adjacency("prism.vtk", 12, 36);
}

/* In a triangle, the node in the middle is joined to all other nodes. In a triquadratic pyramid, the node in the middle
 * is joined to the middles of the faces. */
TEST(test_triquadratic_pyramid) {
  char text[1024] = "# vtk DataFile Version 3.0\nx\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 19 double\n";
  for (int k = 0; k < 19; ++k) sprintf(text + strlen(text), "%d %d %d\n", k % 3, k / 3 % 3, k / 9);
  strcat(text, "CELLS 1 20\n19");
  for (int k = 0; k < 19; ++k) sprintf(text + strlen(text), " %d", k);
  strcat(text, "\nCELL_TYPES 1\n37\n");
  scratch_write_text("pyramid.vtk", text);
  /* The numbers of neighbours are tested at two corners and five middles. The corners are a corner of the base, and the apex. The
   * middles are those of a side of the base, a side to the apex, the base, a triangle and the cell. */
  static const int nodes[7] = {1, 4, 5, 10, 13, 14, 18}, n_neighbors[7] = {5, 8, 4, 4, 5, 7, 5};
  riis_vtk_mesh *mesh = read_mesh("pyramid.vtk");
  riis_adjacency *adjacency = NULL;
  riis_csr csr;
  expect_fine(riis_vtk_mesh_create_adjacency(mesh, 1, &adjacency));
  expect_fine(riis_adjacency_get_csr(adjacency, &csr, sizeof csr));
  const int64_t *offsets = csr.offsets;
  for (int i = 0; i < 7; ++i) assert_int_equal(offsets[nodes[i] + 1] - offsets[nodes[i]], n_neighbors[i]);
  assert_int_equal(offsets[19], 2 * 49);
  riis_adjacency_destroy(&adjacency);
  riis_vtk_mesh_destroy(&mesh);
}

/* Hexahedra have the edges of polyhedra with equal faces. The edges agree in both layouts of the file and in several pieces. */
TEST(test_polyhedra) {
  const double lower[3] = {0, 0, 0}, upper[3] = {1, 2, 3};
  plain_mesh hexahedra = plain_hexahedra(5, lower, upper);
  for (int n_pieces = 1; n_pieces <= 3; ++n_pieces) {
    riis_adjacency *adjacency = NULL;
    riis_csr csr;
    plain_write("cells.vtu", &hexahedra, PLAIN_CELLS, n_pieces);
    plain_write("streams.vtu", &hexahedra, PLAIN_STREAMS, n_pieces);
    plain_write("lists.vtu", &hexahedra, PLAIN_LISTS, n_pieces);
    riis_vtk_mesh *mesh = read_mesh("cells.vtu");
    expect_fine(riis_vtk_mesh_create_adjacency(mesh, 1, &adjacency));
    expect_fine(riis_adjacency_get_csr(adjacency, &csr, sizeof csr));
    assert_int_equal(csr.n_rows, n_pieces * 125);
    assert_true(((const int64_t *)csr.offsets)[csr.n_rows] > 300);
    expect_same_rows("streams.vtu", &csr);
    expect_same_rows("lists.vtu", &csr);
    riis_adjacency_destroy(&adjacency);
    riis_vtk_mesh_destroy(&mesh);
    /* If riis writes the mesh again, the file keeps the faces. */
    mesh = read_mesh("lists.vtu");
    expect_fine(riis_vtk_mesh_write(mesh, scratch_path("again.vtu")));
    expect_fine(riis_vtk_mesh_create_adjacency(mesh, 1, &adjacency));
    expect_fine(riis_adjacency_get_csr(adjacency, &csr, sizeof csr));
    expect_same_rows("again.vtu", &csr);
    riis_adjacency_destroy(&adjacency);
    riis_vtk_mesh_destroy(&mesh);
  }
  plain_free(&hexahedra);
}

/* A quadratic tetrahedron has exactly the edges of the four tetrahedra at its corners. */
TEST(test_quadratic_tetrahedra) {
  const double lower[3] = {0, 0, 0}, upper[3] = {1, 1, 1};
  plain_mesh hexahedra = plain_hexahedra(4, lower, upper), quadratic = plain_quadratic_tetrahedra(&hexahedra),
             corners = plain_cut(&quadratic, 4);
  riis_mesh_cells cells;
  riis_adjacency *adjacency = NULL;
  riis_csr csr;
  expect_fine(riis_mesh_cells_init(&cells, sizeof cells));
  cells.n_nodes = corners.n_nodes, cells.n_cells = corners.n_cells, cells.nodes_per_cell = 4;
  cells.node_ids = corners.ids, cells.id_bits = 64;
  expect_fine(riis_adjacency_create_from_cells(&cells, &adjacency));
  expect_fine(riis_adjacency_get_csr(adjacency, &csr, sizeof csr));
  plain_write("quadratic.vtu", &quadratic, PLAIN_CELLS, 1);
  expect_same_rows("quadratic.vtu", &csr);
  riis_adjacency_destroy(&adjacency);
  plain_free(&hexahedra);
  plain_free(&quadratic);
  plain_free(&corners);
}

/* riis counts cells whose edges it does not know. The cells with unknown edges are a convex point set, a Lagrange tetrahedron
 * with nodes beyond its lattice, and a Lagrange wedge of 21 nodes. Faces and points do not count as volume cells. */
TEST(test_unknown_cells) {
  const struct {
    const char *cells;
    int n_volumes, n_left_out;
  } cases[] = {{"CELLS 0 0\nCELL_TYPES 0\n", 0, 0},
               {"CELLS 2 8\n3 0 1 2\n3 1 2 3\nCELL_TYPES 2\n5\n5\n", 0, 0},
               {"CELLS 2 11\n5 0 1 2 3 4\n4 4 5 6 7\nCELL_TYPES 2\n41\n10\n", 2, 1},
               {"CELLS 1 16\n15 0 1 2 3 4 5 6 7 8 9 10 11 12 13 14\nCELL_TYPES 1\n71\n", 1, 1},
               {"CELLS 1 22\n21 0 1 2 3 4 5 6 7 8 9 10 11 12 13 14 15 16 17 18 19 20\nCELL_TYPES 1\n73\n", 1, 1}};
  for (size_t i = 0; i < sizeof cases / sizeof *cases; ++i) {
    char text[1024] = "# vtk DataFile Version 3.0\nx\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 21 double\n";
    for (int k = 0; k < 21; ++k) sprintf(text + strlen(text), "%d %d %d\n", k % 3, k / 3 % 3, k / 9);
    strcat(text, cases[i].cells);
    scratch_write_text("unknown.vtk", text);
    riis_vtk_mesh *mesh = read_mesh("unknown.vtk");
    int64_t n_volumes = -1, n_left_out = -1;
    expect_fine(riis_vtk_mesh_get_volume_cells(mesh, &n_volumes, &n_left_out));
    assert_int_equal(n_volumes, cases[i].n_volumes);
    assert_int_equal(n_left_out, cases[i].n_left_out);
    expect_fine(riis_vtk_mesh_get_volume_cells(mesh, NULL, NULL));
    expect_refused(riis_vtk_mesh_get_volume_cells(NULL, &n_volumes, NULL), RIIS_INVALID_ARGUMENT, "mesh is NULL");
    riis_vtk_mesh_destroy(&mesh);
  }
}

int main(void) { return run_cases(scratch_setup, scratch_teardown); }
