/* SPDX-License-Identifier: Apache-2.0
 * Tests riis_marks_get_cells_across. Random graphs are compared with a serial search, and lattices with their known spacing. */
#include <riis/riis.h>

#include "test_support.h"

#include "handles.h"
#include "searches.h"

#include "random_meshes.h"

#include "flood_fill.h"

static riis_cells_across cells_of(const riis_marks *marks, const riis_mesh *mesh) {
  riis_cells_across cells;
  memset(&cells, 0x5a, sizeof cells);
  CHECK_OK(riis_marks_get_cells_across(marks, mesh, &cells, sizeof cells));
  return cells;
}

TEST(graphs_have_the_edges_of_a_serial_search) {
  for (int trial = 0; trial < trials_of(180); ++trial) {
    const int owned_before = n_owned();
    const test_mesh graph = random_graph(random_integer(1, 300), random_between(&rng, 0.5, 6));
    const test_mesh rows = both_ways(&graph);
    const riis_surface *surface = random_surface();
    riis_mesh *mesh = mesh_of_graph(&graph);
    riis_marks *marks = new_result();
    CHECK_OK(riis_mark_nodes(surface, mesh, NULL, marks));
    uint8_t *is_marked = own(calloc((size_t)graph.n, 1)), *is_seen = own(malloc((size_t)graph.n));
    const riis_mark_list list = marked_list(marks);
    for (int64_t i = 0; i < list.n_nodes; ++i) is_marked[list.node_id[i]] = 1;
    riis_cells_across expected = {.shortest_edge = INFINITY};
    double sum = 0;
    for (int64_t i = 0; i < rows.n; ++i) {
      memset(is_seen, 0, (size_t)graph.n);
      for (int64_t k = rows.offsets[i]; k < rows.offsets[i + 1]; ++k) {
        const int64_t j = rows.columns[k];
        if (j <= i || is_seen[j] || (!is_marked[i] && !is_marked[j])) continue;
        is_seen[j] = 1;
        const double *p = rows.xyz + 3 * i, *q = rows.xyz + 3 * j;
        const double length = hypot(hypot(p[0] - q[0], p[1] - q[1]), p[2] - q[2]);
        if (!(length > 0)) continue;
        ++expected.n_edges;
        sum += length;
        expected.shortest_edge = fmin(expected.shortest_edge, length);
        expected.longest_edge = fmax(expected.longest_edge, length);
      }
    }
    const riis_cells_across found = cells_of(marks, mesh);
    const double eps = info_of(surface).half_thickness;
    assert_int_equal(found.n_edges, expected.n_edges);
    CHECK_NEAR(found.half_thickness, eps, 0);
    if (found.n_edges == 0) {
      CHECK_NEAR(found.least + found.mean + found.most + found.shortest_edge + found.mean_edge + found.longest_edge, 0,
                 0);
    } else {
      const double mean = sum / (double)expected.n_edges;
      CHECK_NEAR(found.shortest_edge, expected.shortest_edge, 1e-14);
      CHECK_NEAR(found.longest_edge, expected.longest_edge, 1e-14);
      CHECK_NEAR(found.mean_edge, mean, 1e-12);
      CHECK_NEAR(found.least * found.longest_edge, 2 * eps, 1e-14);
      CHECK_NEAR(found.mean * found.mean_edge, 2 * eps, 1e-14);
      CHECK_NEAR(found.most * found.shortest_edge, 2 * eps, 1e-14);
    }
    free_owned_after(owned_before);
  }
}

TEST(a_lattice_has_its_spacing) {
  static const char *const kinds[5] = {"aortic", "mitral", "trileaflet", "bileaflet", "coapting"};
  for (int trial = 0; trial < 5; ++trial) {
    riis_surface_options options = surface_options();
    options.half_thickness = random_between(&rng, 0.1, 0.2);
    const riis_surface *surface = surface_of_kind(kinds[trial], &options);
    const double spacing = 0.08;
    const test_mesh nodes = lattice_around(surface, spacing, 0.5);
    riis_mesh *mesh = mesh_from(&nodes);
    riis_marks *marks = new_result();
    CHECK_OK(riis_mark_nodes(surface, mesh, NULL, marks));
    const riis_cells_across found = cells_of(marks, mesh);
    assert_true(found.n_edges > stats_of(marks).n_marked);
    CHECK_NEAR(found.least, found.most, 0.05 * found.most);
    CHECK_NEAR(found.mean * found.mean_edge, 2 * options.half_thickness, 1e-12);
    CHECK_NEAR(found.mean_edge, spacing, 0.05 * spacing);
  }
}

TEST(wrong_calls_are_refused) {
  const riis_surface *surface = aortic_surface(NULL);
  const test_mesh nodes = lattice_around(surface, 0.3, 0.5), fewer = lattice_around(surface, 0.5, 0.5);
  riis_mesh *mesh = mesh_from(&nodes), *other = mesh_from(&fewer);
  riis_marks *marks = new_result();
  riis_cells_across cells;
  CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "marks are empty",
                riis_marks_get_cells_across(marks, mesh, &cells, sizeof cells));
  CHECK_OK(riis_mark_nodes(surface, mesh, NULL, marks));
  CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "marks is NULL", riis_marks_get_cells_across(NULL, mesh, &cells, sizeof cells));
  CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "mesh is NULL", riis_marks_get_cells_across(marks, NULL, &cells, sizeof cells));
  CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "cells is NULL", riis_marks_get_cells_across(marks, mesh, NULL, sizeof cells));
  CHECK_REFUSED(RIIS_INVALID_STRUCT_SIZE, "cells is 60", riis_marks_get_cells_across(marks, mesh, &cells, 60));
  CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "marks are of a mesh with",
                riis_marks_get_cells_across(marks, other, &cells, sizeof cells));
  CHECK_OK(riis_mesh_set_adjacency(mesh, NULL));
  CHECK_REFUSED(RIIS_INVALID_ARGUMENT, "mesh has no adjacency",
                riis_marks_get_cells_across(marks, mesh, &cells, sizeof cells));
}

int main(void) {
  rng = random_start("test_cells_across");
  return run_cases(NULL, NULL);
}
