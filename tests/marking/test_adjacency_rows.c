/* SPDX-License-Identifier: Apache-2.0
 * Tests the handle of an adjacency, the rows of a mesh, and the calls that remove a mesh's rows. */
#include <riis/riis.h>

#include "test_support.h"

#include "handles.h"
#include "searches.h"

TEST(handles_of_adjacencies) {
  riis_adjacency *adjacency = NULL;
  riis_csr csr;
  CHECK_OK(riis_adjacency_create_from_grid(3, 2, 1, 0, &adjacency));
  CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "adjacency|NULL", riis_adjacency_get_csr(NULL, &csr, sizeof csr));
  CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "csr|NULL", riis_adjacency_get_csr(adjacency, NULL, sizeof csr));
  CHECK_REFUSED(RIIS_INVALID_STRUCT_SIZE, "csr is 48", riis_adjacency_get_csr(adjacency, &csr, 48));
  CHECK_REFUSED(RIIS_INVALID_STRUCT_SIZE, "csr is 64", riis_adjacency_get_csr(adjacency, &csr, 64));
  CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "csr|NULL", riis_csr_init(NULL, sizeof csr));
  CHECK_REFUSED(RIIS_INVALID_STRUCT_SIZE, "csr is -8", riis_csr_init(&csr, -8));
  /* The handles of a mesh and an adjacency are swapped. */
  const double xyz[18] = {0};
  riis_mesh *mesh = NULL;
  CHECK_OK(riis_mesh_create(6, xyz, xyz + 1, xyz + 2, 3, &mesh));
  CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "adjacency is a handle of another kind",
                riis_adjacency_get_csr((const riis_adjacency *)(const void *)mesh, &csr, sizeof csr));
  CHECK_OK(riis_adjacency_get_csr(adjacency, &csr, sizeof csr));
  CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "mesh is a handle of another kind",
                riis_mesh_set_adjacency((riis_mesh *)(void *)adjacency, &csr));
  riis_adjacency *wrong = (riis_adjacency *)(void *)mesh;
  riis_adjacency_destroy(&wrong);
  assert_non_null(wrong); /* a refused call does not change the handle */
  CHECK_OK(riis_mesh_set_adjacency(mesh, &csr));
  riis_mesh_destroy(&mesh);
  riis_adjacency_destroy(&adjacency);
  assert_null(adjacency);
  riis_adjacency_destroy(&adjacency);
  riis_adjacency_destroy(NULL);
}

/* Returns 1 if the mesh can be searched along its adjacency. */
static int has_adjacency(const riis_surface *surface, const riis_mesh *mesh) {
  riis_marks *result = new_result();
  riis_mark_options options = mark_options();
  options.search = RIIS_SEARCH_NEIGHBOR;
  options.n_threads = 1;
  const riis_status status = riis_mark_nodes(surface, mesh, &options, result);
  free_one_owned(result);
  if (status == RIIS_OK) return 1;
  assert_int_equal(status, RIIS_INVALID_ARGUMENT);
  return 0;
}

TEST(rows_that_are_refused) {
  enum { n = 5 };
  riis_surface *surface = aortic_surface(NULL);
  double xyz[3 * n] = {0};
  int32_t offsets[n + 1] = {0, 1, 3, 5, 7, 8}, columns[8] = {1, 0, 2, 1, 3, 2, 4, 3};
  riis_csr good, csr;
  riis_mesh *mesh = mesh_of(n, xyz);
  CHECK_OK(riis_csr_init(&good, sizeof good));
  assert_int_equal(good.struct_size, sizeof good);
  assert_int_equal(good.n_rows, 0);
  assert_int_equal(good.n_all, 0);
  assert_null(good.offsets);
  assert_null(good.columns);
  assert_int_equal(good.offset_bits, 32);
  assert_int_equal(good.column_bits, 32);
  assert_int_equal(good.index_base, 0);
  good.n_rows = n;
  good.offsets = offsets;
  good.columns = columns;
  /* Wrong rows are always refused, and the mesh keeps its adjacency if it has one. */
  for (int has_one = 0; has_one < 2; ++has_one) {
    if (has_one) CHECK_OK(riis_mesh_set_adjacency(mesh, &good));
#define REFUSED(status, parts)                                         \
  do {                                                                 \
    CHECK_REFUSED(status, parts, riis_mesh_set_adjacency(mesh, &csr)); \
    assert_int_equal(has_adjacency(surface, mesh), has_one);           \
  } while (0)
#define REFUSED_WITH(change, status, parts) \
  do {                                      \
    csr = good;                             \
    csr.change;                             \
    REFUSED(status, parts);                 \
  } while (0)
    REFUSED_WITH(n_rows = n - 1, RIIS_INVALID_ARGUMENT, "csr.n_rows is 4|5 nodes");
    REFUSED_WITH(n_rows = n + 1, RIIS_INVALID_ARGUMENT, "csr.n_rows is 6|5 nodes");
    REFUSED_WITH(n_rows = 0, RIIS_INVALID_ARGUMENT, "csr.n_rows is 0");
    REFUSED_WITH(n_all = n - 1, RIIS_INVALID_ARGUMENT, "csr.n_all is 4|at least n_rows");
    REFUSED_WITH(n_all = -1, RIIS_INVALID_ARGUMENT, "csr.n_all is -1");
    REFUSED_WITH(offset_bits = 16, RIIS_INVALID_ARGUMENT, "csr.offset_bits is 16|32 or 64");
    REFUSED_WITH(column_bits = 0, RIIS_INVALID_ARGUMENT, "csr.column_bits is 0|32 or 64");
    REFUSED_WITH(index_base = 2, RIIS_INVALID_ARGUMENT, "csr.index_base is 2|0 or 1");
    REFUSED_WITH(reserved = 9, RIIS_INVALID_ARGUMENT, "csr.reserved is 9");
    REFUSED_WITH(offsets = NULL, RIIS_INVALID_ARGUMENT, "csr.offsets|NULL");
    REFUSED_WITH(columns = NULL, RIIS_INVALID_ARGUMENT, "csr.columns|NULL");
    REFUSED_WITH(struct_size = 0, RIIS_INVALID_STRUCT_SIZE, "csr is 0");
    REFUSED_WITH(struct_size = sizeof csr + 8, RIIS_INVALID_STRUCT_SIZE, "csr is 64");
    csr = good;
    columns[4] = 5;
    REFUSED(RIIS_INVALID_MESH, "row 2|column 5|nodes 0 to 4");
    columns[4] = -1;
    REFUSED(RIIS_INVALID_MESH, "row 2|column -1");
    columns[4] = 3;
    offsets[3] = 2;
    REFUSED(RIIS_INVALID_MESH, "row 2|ends at 2|begins, at 3");
    offsets[3] = 1000; /* exceeds the last offset, which is the number of columns, so nothing is read there */
    REFUSED(RIIS_INVALID_MESH, "row 3|ends at 7|begins, at 1000");
    offsets[3] = 5;
    offsets[0] = 1;
    REFUSED(RIIS_INVALID_MESH, "csr.offsets begins with 1|begin with 0");
    csr.index_base = 1;
    REFUSED(RIIS_INVALID_MESH, "row 1|column 0|nodes 1 to 5");
    offsets[0] = 0;
    csr.index_base = 1;
    REFUSED(RIIS_INVALID_MESH, "csr.offsets begins with 0|begin with 1");
#undef REFUSED
#undef REFUSED_WITH
  }
  CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "mesh|NULL", riis_mesh_set_adjacency(NULL, &good));
  CHECK_OK(riis_mesh_set_adjacency(mesh, NULL));
  assert_int_equal(has_adjacency(surface, mesh), 0);
  CHECK_OK(riis_mesh_set_adjacency(mesh, NULL));
}

TEST(when_an_adjacency_goes) {
  enum { n = 4 };
  riis_surface *surface = aortic_surface(NULL);
  double xyz[3 * (n + 1)] = {0};
  /* The numbers count from 1. Nodes 5 and 6 are ghosts. Three rows contain their own nodes, and one of these rows also contains
   * node 2. */
  int64_t offsets[n + 1] = {1, 4, 4, 7, 8}, columns[7] = {5, 6, 1, 3, 3, 2, 4};
  riis_csr csr;
  riis_marks *result = new_result();
  riis_mark_options options = mark_options();
  riis_mesh *mesh = mesh_of(n, xyz);
  CHECK_OK(riis_csr_init(&csr, sizeof csr));
  csr.n_rows = n;
  csr.offsets = offsets;
  csr.columns = columns;
  csr.offset_bits = csr.column_bits = 64;
  csr.index_base = 1;
  CHECK_REFUSED(RIIS_INVALID_MESH, "row 0|column 5|nodes 1 to 4", riis_mesh_set_adjacency(mesh, &csr));
  csr.n_all = n + 1;
  CHECK_REFUSED(RIIS_INVALID_MESH, "row 0|column 6|nodes 1 to 5", riis_mesh_set_adjacency(mesh, &csr));
  csr.n_all = n + 2;
  CHECK_OK(riis_mesh_set_adjacency(mesh, &csr));
  assert_int_equal(has_adjacency(surface, mesh), 1);
  /* The adjacency stays if the number of nodes stays the same, or if an update is refused. The adjacency is removed if the number
   * changes. */
  CHECK_OK(riis_mesh_update(mesh, n, xyz, xyz + 1, xyz + 2, 3));
  assert_int_equal(has_adjacency(surface, mesh), 1);
  xyz[3 * n] = NAN;
  CHECK_REFUSED(RIIS_INVALID_MESH, "x of node 4 is nan", riis_mesh_update(mesh, n + 1, xyz, xyz + 1, xyz + 2, 3));
  assert_int_equal(has_adjacency(surface, mesh), 1);
  xyz[3 * n] = 0;
  CHECK_OK(riis_mesh_update(mesh, n + 1, xyz, xyz + 1, xyz + 2, 3));
  assert_int_equal(has_adjacency(surface, mesh), 0);
  CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "csr.n_rows is 4|5 nodes", riis_mesh_set_adjacency(mesh, &csr));
  CHECK_OK(riis_mesh_update(mesh, n, xyz, xyz + 1, xyz + 2, 3));
  assert_int_equal(has_adjacency(surface, mesh), 0);
  options.search = RIIS_SEARCH_NEIGHBOR;
  CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "options.search is 2|adjacency",
                riis_mark_nodes(surface, mesh, &options, result));
  options.search = RIIS_SEARCH_PAPER;
  CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "options.search is 3|adjacency",
                riis_mark_nodes(surface, mesh, &options, result));
  CHECK_OK(riis_mesh_set_adjacency(mesh, &csr));
  assert_int_equal(has_adjacency(surface, mesh), 1);
  CHECK_OK(riis_mesh_set_adjacency(mesh, NULL));
  assert_int_equal(has_adjacency(surface, mesh), 0);
  /* If all rows are empty, columns may be NULL. */
  const int32_t nothing[n + 1] = {0};
  CHECK_OK(riis_csr_init(&csr, sizeof csr));
  csr.n_rows = n;
  csr.offsets = nothing;
  CHECK_OK(riis_mesh_set_adjacency(mesh, &csr));
  assert_int_equal(has_adjacency(surface, mesh), 1);
}

int main(void) { return run_cases(NULL, NULL); }
