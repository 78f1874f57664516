/* SPDX-License-Identifier: Apache-2.0
 * A process without nodes makes all calls that other processes make, with NULL for arrays. The calls make meshes, adjacencies,
 * markings, leaks and sums over nodes. */
#include <riis/riis.h>

#include "test_support.h"

#include "handles.h"
#include "searches.h"

static riis_mesh *empty_mesh(void) {
  riis_mesh *mesh = NULL;
  CHECK_OK(riis_mesh_create(0, NULL, NULL, NULL, 3, &mesh));
  return own(mesh);
}

static riis_csr empty_csr(void) {
  riis_csr csr;
  CHECK_OK(riis_csr_init(&csr, sizeof csr));
  return csr;
}

/* Makes a moving valve, so that no field is refused. */
static riis_surface *moving_surface(void) {
  riis_valve *valve = new_valve("mitral");
  riis_surface *surface = new_surface(valve, NULL);
  CHECK_OK(riis_surface_update_moving(surface, valve, valve, 1, NULL, NULL));
  return surface;
}

static void check_nothing_found(const riis_marks *result, int32_t search) {
  riis_mark_stats stats = stats_of(result);
  assert_int_equal(stats.n_nodes, 0);
  assert_int_equal(stats.n_marked, 0);
  assert_int_equal(stats.n_within_limit, 0);
  assert_int_equal(stats.n_queries, 0);
  assert_int_equal(stats.n_unreached, 0);
  assert_int_equal(stats.complete, 1);
  assert_true(stats.seconds >= 0 && stats.n_threads >= 1);
  assert_int_equal(stats.search, search == RIIS_SEARCH_AUTO ? stats.search : search);
  assert_true(stats.search > RIIS_SEARCH_AUTO && stats.search <= RIIS_SEARCH_CLUSTERS);
  assert_true(stats.instructions > RIIS_INSTRUCTIONS_AUTO);
  const found_nodes lists[2] = {marked_in(result), within_in(result)};
  riis_mark_list fields[2];
  memset(fields, 0x55, sizeof fields);
  CHECK_OK(riis_marks_get_list(result, RIIS_LIST_MARKED, fields, sizeof *fields));
  CHECK_OK(riis_marks_get_list(result, RIIS_LIST_WITHIN_LIMIT, fields + 1, sizeof *fields));
  for (int i = 0; i < 2; ++i) {
    assert_int_equal(lists[i].n, 0);
    assert_true(!lists[i].node_id && !lists[i].distance && !lists[i].triangle_id && !lists[i].leaflet_id);
    assert_int_equal(fields[i].n_nodes, 0);
    assert_true(!fields[i].point && !fields[i].normal && !fields[i].barycentric && !fields[i].uv);
    assert_true(!fields[i].velocity && !fields[i].side && !fields[i].rim && !fields[i].patch_id);
  }
  CHECK_OK(dense_of(result, 0, RIIS_FAR_DISTANCE, NULL, NULL, NULL, NULL));
  CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "n_nodes is 1;|0 nodes",
                dense_of(result, 1, RIIS_FAR_DISTANCE, NULL, NULL, NULL, NULL));
  CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "n_nodes is -1;",
                dense_of(result, -1, RIIS_FAR_DISTANCE, NULL, NULL, NULL, NULL));
}

TEST(meshes_may_be_empty) {
  const double xyz[6] = {0, 0, 0, 1, 1, 1};
  riis_mesh *mesh = empty_mesh();
  CHECK_OK(riis_mesh_update(mesh, 0, NULL, NULL, NULL, 3));
  CHECK_OK(riis_mesh_update(mesh, 2, xyz, xyz + 1, xyz + 2, 3));
  CHECK_OK(riis_mesh_update(mesh, 0, xyz, xyz + 1, xyz + 2, 3));
  for (int32_t n_threads = 0; n_threads <= 3; ++n_threads) CHECK_OK(riis_mesh_prepare(mesh, n_threads));
  CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "n_threads is -1", riis_mesh_prepare(mesh, -1));
  riis_mesh *none = NULL;
  CHECK_REFUSED(RIIS_INVALID_MESH, "n_nodes is -1;|at least 0", riis_mesh_create(-1, NULL, NULL, NULL, 1, &none));
  CHECK_REFUSED(RIIS_INVALID_MESH, "n_nodes is -9223372036854775808;",
                riis_mesh_update(mesh, INT64_MIN, NULL, NULL, NULL, 1));
  CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "mesh is NULL", riis_mesh_create(0, NULL, NULL, NULL, 1, NULL));
  /* Only a mesh without nodes may have NULL as pointers to arrays. */
  assert_int_equal(riis_mesh_create(1, NULL, NULL, NULL, 1, &none), RIIS_INVALID_ARGUMENT);
  assert_null(none);
}

TEST(adjacencies_may_be_empty) {
  riis_mesh *mesh = empty_mesh();
  riis_csr csr = empty_csr(), own;
  CHECK_OK(riis_mesh_set_adjacency(mesh, &csr));
  static const int64_t from_one = 1, zero = 0;
  csr.offsets = &zero, csr.offset_bits = 64;
  CHECK_OK(riis_mesh_set_adjacency(mesh, &csr));
  csr.offsets = &from_one, csr.index_base = 1, csr.n_all = 7; /* ghost nodes, which belong to other ranks */
  CHECK_OK(riis_mesh_set_adjacency(mesh, &csr));
  csr = empty_csr();
  csr.n_rows = -1;
  CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "csr.n_rows is -1", riis_mesh_set_adjacency(mesh, &csr));
  csr.n_rows = 1;
  CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "csr.n_rows is 1", riis_mesh_set_adjacency(mesh, &csr));
  csr = empty_csr();
  csr.n_all = -1;
  CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "csr.n_all is -1", riis_mesh_set_adjacency(mesh, &csr));

  riis_mesh_cells cells;
  riis_adjacency *adjacency = NULL;
  CHECK_OK(riis_mesh_cells_init(&cells, sizeof cells));
  for (int64_t n_nodes = 0; n_nodes <= 5; n_nodes += 5) /* first without cells and nodes, then only without cells */
    for (int32_t base = 0; base < 2; ++base)
      for (int with_offsets = 0; with_offsets < 2; ++with_offsets) {
        const int32_t first = base;
        cells.n_nodes = n_nodes;
        cells.index_base = base;
        cells.offsets = with_offsets ? &first : NULL;
        cells.n_threads = 1 + with_offsets;
        CHECK_OK(riis_adjacency_create_from_cells(&cells, &adjacency));
        own(adjacency);
        CHECK_OK(riis_adjacency_get_csr(adjacency, &own, sizeof own));
        assert_int_equal(own.n_rows, n_nodes);
        const int64_t *offsets = own.offsets;
        for (int64_t i = 0; i <= n_nodes; ++i) assert_int_equal(offsets[i], own.index_base);
        if (n_nodes == 0) CHECK_OK(riis_mesh_set_adjacency(mesh, &own));
        CHECK_OK(riis_mesh_set_adjacency(mesh, NULL));
        free_one_owned(adjacency);
      }
  CHECK_OK(riis_mesh_cells_init(&cells, sizeof cells));
  cells.n_nodes = -1;
  CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "cells.n_nodes is -1", riis_adjacency_create_from_cells(&cells, &adjacency));
  cells.n_nodes = 4, cells.n_cells = -1;
  CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "cells.n_cells is -1", riis_adjacency_create_from_cells(&cells, &adjacency));
  cells.n_cells = 1; /* a cell needs nodes */
  CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "cells.node_ids", riis_adjacency_create_from_cells(&cells, &adjacency));
  static const int32_t ids[4] = {0, 1, 2, 3};
  cells.node_ids = ids, cells.n_nodes = 0;
  CHECK_REFUSED(RIIS_INVALID_MESH, "node 0 of cell 0 is 0", riis_adjacency_create_from_cells(&cells, &adjacency));

  riis_mesh_faces faces;
  CHECK_OK(riis_mesh_faces_init(&faces, sizeof faces));
  for (int64_t n_cells = 0; n_cells <= 5; n_cells += 5) {
    faces.n_cells = n_cells;
    CHECK_OK(riis_adjacency_create_from_faces(&faces, &adjacency));
    own(adjacency);
    CHECK_OK(riis_adjacency_get_csr(adjacency, &own, sizeof own));
    assert_int_equal(own.n_rows, n_cells);
    if (n_cells == 0) CHECK_OK(riis_mesh_set_adjacency(mesh, &own));
    CHECK_OK(riis_mesh_set_adjacency(mesh, NULL));
    free_one_owned(adjacency);
    adjacency = NULL;
  }
  faces.n_cells = -1;
  CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "faces.n_cells is -1", riis_adjacency_create_from_faces(&faces, &adjacency));
  faces.n_cells = 0, faces.n_faces = -1;
  CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "faces.n_faces is -1", riis_adjacency_create_from_faces(&faces, &adjacency));
  faces.n_faces = 1, faces.owner = faces.neighbor = ids;
  CHECK_REFUSED(RIIS_INVALID_MESH, "owner of face 0 is 0", riis_adjacency_create_from_faces(&faces, &adjacency));
  assert_null(adjacency);
}

TEST(every_search_finds_all_of_nothing) {
  riis_surface *surface = moving_surface();
  const riis_csr csr = empty_csr();
  riis_marks *result = new_result();
  for (int32_t search = RIIS_SEARCH_AUTO; search <= RIIS_SEARCH_CLUSTERS; ++search)
    for (int kind = 0; kind < 16; ++kind) {
      riis_mesh *mesh = empty_mesh();
      CHECK_OK(riis_mesh_set_adjacency(mesh, &csr));
      riis_mark_options options = mark_options();
      options.search = search;
      options.n_threads = kind % 4;
      if (kind & 4) options.distance_limit = 0.3;
      if (kind & 8) options.fields = 255;
      if (kind % 3 == 0) CHECK_OK(riis_mesh_prepare(mesh, 1));
      for (int again = 0; again < 3; ++again) {
        CHECK_OK(riis_mark_nodes(surface, mesh, &options, result));
        check_nothing_found(result, search);
      }
    }
  /* A mesh without nodes may lack an adjacency, like any mesh. The two searches along an adjacency are then refused. */
  riis_mesh *mesh = empty_mesh();
  riis_mark_options options = mark_options();
  for (int32_t search = RIIS_SEARCH_NEIGHBOR; search <= RIIS_SEARCH_PAPER; ++search) {
    options.search = search;
    CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "mesh has none", riis_mark_nodes(surface, mesh, &options, result));
  }
}

TEST(other_distances_find_nothing_too) {
  riis_mesh *mesh = empty_mesh();
  riis_marks *result = new_result();
  riis_surface_options options = surface_options();
  riis_mark_options mark = mark_options();
  options.measure_tolerance = 0.5;
  mark.fields = RIIS_FIELD_POINT | RIIS_FIELD_NORMAL | RIIS_FIELD_PATCH;
  for (options.measure = RIIS_MEASURE_SAMPLING; options.measure <= RIIS_MEASURE_MINIMIZATION; ++options.measure) {
    CHECK_OK(riis_mark_nodes(aortic_surface(&options), mesh, &mark, result));
    check_nothing_found(result, RIIS_SEARCH_EXHAUSTIVE);
  }
}

/* First the result and the mesh have nodes, then no nodes, then nodes again. */
TEST(nodes_come_and_go) {
  riis_surface *surface = moving_surface();
  test_mesh nodes = lattice_around(surface, 0.2, 0.2);
  const riis_csr csr = csr_of(&nodes), none = empty_csr();
  for (int32_t search = RIIS_SEARCH_AUTO; search <= RIIS_SEARCH_CLUSTERS; ++search) {
    if (search == RIIS_SEARCH_PAPER) continue;
    riis_mesh *mesh = empty_mesh();
    riis_marks *result = new_result(), *expected = new_result();
    riis_mark_options options = mark_options();
    options.fields = 255;
    options.distance_limit = 0.2;
    riis_mesh *whole = mesh_from(&nodes);
    CHECK_OK(riis_mark_nodes(surface, whole, &options, expected));
    options.search = search;
    for (int turn = 0; turn < 3; ++turn) {
      CHECK_OK(riis_mesh_set_adjacency(mesh, &none));
      CHECK_OK(riis_mark_nodes(surface, mesh, &options, result));
      check_nothing_found(result, search);
      CHECK_OK(riis_mesh_update(mesh, nodes.n, nodes.xyz, nodes.xyz + 1, nodes.xyz + 2, 3));
      CHECK_OK(riis_mesh_set_adjacency(mesh, &csr));
      for (int again = 0; again < 2; ++again) {
        CHECK_OK(riis_mark_nodes(surface, mesh, &options, result));
        assert_true(marked_in(result).n > 50);
        assert_true(same_results(result, expected));
      }
      CHECK_OK(riis_mesh_update(mesh, 0, NULL, NULL, NULL, 1));
    }
  }
}

TEST(nothing_leaks) {
  riis_surface *surface = moving_surface();
  riis_mesh *mesh = empty_mesh();
  const riis_csr csr = empty_csr();
  riis_marks *result = new_result();
  riis_leak_list leaks;
  CHECK_OK(riis_mark_nodes(surface, mesh, NULL, result));
  CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "mesh has no adjacency", find_leaks_in(surface, mesh, result, NULL, &leaks));
  CHECK_OK(riis_mesh_set_adjacency(mesh, &csr));
  for (int32_t n_threads = 0; n_threads <= 3; ++n_threads) {
    riis_mark_options options = mark_options();
    options.n_threads = n_threads;
    memset(&leaks, 0x55, sizeof leaks);
    CHECK_OK(find_leaks_in(surface, mesh, result, &options, &leaks));
    assert_int_equal(leaks.n_edges, 0);
    assert_true(leaks.longest_node_id[0] == -1 && leaks.longest_node_id[1] == -1 && leaks.longest_length == 0);
    assert_true(leaks.longest_middle[0] == 0 && leaks.half_thickness == 0 && leaks.seconds >= 0);
    assert_true(!leaks.node_id && !leaks.length && !leaks.distance);
    int64_t n = -1;
    CHECK_OK(riis_label_open_regions(mesh, result, &options, 0, NULL, &n));
    assert_int_equal(n, 0);
  }
  const int64_t node = 0;
  riis_passage passage;
  CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "ends.from[0] is 0|0 nodes",
                find_passage_between(surface, mesh, NULL, 1, &node, 1, &node, &passage, sizeof passage));
  /* No marking has yet filled the result. */
  riis_marks *empty = new_result();
  CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "marks are empty", find_leaks_in(surface, mesh, empty, NULL, &leaks));
}

TEST(sums_over_no_nodes) {
  riis_surface *surface = moving_surface();
  riis_mesh *mesh = empty_mesh();
  riis_marks *result = new_result();
  riis_mark_options options = mark_options();
  riis_resistance resistance;
  double nothing[3] = {4, 4, 4}, force[3] = {1, 2, 3};
  options.fields = RIIS_FIELD_SIDE | RIIS_FIELD_RIM | RIIS_FIELD_VELOCITY;
  CHECK_OK(riis_mark_nodes(surface, mesh, &options, result));
  CHECK_OK(riis_resistance_init(&resistance, sizeof resistance));
  resistance.R = 1;
  for (int32_t rim = RIIS_RIM_ROUND; rim <= RIIS_RIM_CUT; ++rim) {
    resistance.rim = rim;
    CHECK_OK(add_resistance_to(result, &resistance, 0, NULL, NULL));
    CHECK_OK(add_resistance_to(result, &resistance, 0, nothing, nothing));
    CHECK_OK(add_reaction_to(result, &resistance, 0, nothing, nothing, force));
    CHECK_OK(add_reaction_to(result, &resistance, 0, NULL, NULL, force));
    CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "reaction has no array to add to",
                  add_reaction_to(result, &resistance, 0, NULL, NULL, NULL));
  }
  assert_true(nothing[0] == 4 && nothing[2] == 4 && force[0] == 1 && force[1] == 2 && force[2] == 3);
  riis_band_sums sums;
  memset(&sums, 0x55, sizeof sums);
  CHECK_OK(band_sums_of(result, 0, 0.1, 0, NULL, NULL, &sums, sizeof sums));
  for (int side = 0; side < 2; ++side)
    assert_true(sums.sum[side] == 0 && sums.weight[side] == 0 && sums.n_nodes[side] == 0);
}

static void nobody_is_warned(void *user_data, int32_t level, const char *message) {
  (void)message;
  if (level == RIIS_LOG_WARNING) ++*(int *)user_data;
}

/* The box of a mesh without nodes has no size, so no warning compares this box with the valve. */
TEST(no_warning_of_proportions) {
  int n_warnings = 0;
  riis_surface *surface = moving_surface();
  riis_mesh *mesh = empty_mesh();
  riis_marks *result = new_result();
  riis_set_log(nobody_is_warned, &n_warnings);
  for (int i = 0; i < 3; ++i) CHECK_OK(riis_mark_nodes(surface, mesh, NULL, result));
  riis_set_log(NULL, NULL);
  assert_int_equal(n_warnings, 0);
}

int main(void) { return run_cases(NULL, NULL); }
