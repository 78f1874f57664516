/* SPDX-License-Identifier: Apache-2.0
 * The neighbour search for a finite element code: makes an adjacency from tetrahedra, whose 32-bit node numbers count from 1,
 * and marks nodes. The exhaustive search, which needs no adjacency, finds the same nodes. Lengths are in cm. */
#include <riis/riis.h>
#include <stdio.h>
#include <stdlib.h>

enum { n = 27, n_nodes = n * n * n, n_cells = 6 * (n - 1) * (n - 1) * (n - 1) };
static double xyz[3 * n_nodes];      /* a cube of 3.25 cm around the valve, a node every 1.25 mm */
static int32_t node_ids[n_cells][4]; /* four nodes per tetrahedron; in Fortran node_ids(4, n_cells) */

static void check(riis_status status) {
  if (status == RIIS_OK) return;
  fprintf(stderr, "%s: %s\n", riis_status_name(status), riis_last_error());
  exit(EXIT_FAILURE);
}

/* Cuts each cube of the grid into six tetrahedra. Each tetrahedron follows three edges from the first node of the cube to its
 * last node. No two tetrahedra follow the axes in the same order. */
static void make_tetrahedra(void) {
  static const int axes[6][3] = {{0, 1, 2}, {0, 2, 1}, {1, 0, 2}, {1, 2, 0}, {2, 0, 1}, {2, 1, 0}};
  static const int step[3] = {1, n, n * n};
  int cell = 0;
  for (int node = 0; node < n_nodes; ++node) {
    if (node % n == n - 1 || node / n % n == n - 1 || node / (n * n) == n - 1) continue; /* no cube begins here */
    for (int i = 0; i < 6; ++i, ++cell) {
      node_ids[cell][0] = node + 1;
      for (int j = 0; j < 3; ++j) node_ids[cell][j + 1] = node_ids[cell][j] + step[axes[i][j]];
    }
  }
}

int main(void) {
  for (int i = 0; i < n_nodes; ++i) {
    xyz[3 * i] = -1.625 + 0.125 * (i % n);
    xyz[3 * i + 1] = -1.625 + 0.125 * (i / n % n);
    xyz[3 * i + 2] = -1.625 + 0.125 * (i / (n * n));
  }
  make_tetrahedra();

  riis_valve *valve = NULL;
  riis_surface *surface = NULL;
  riis_mesh *mesh = NULL;
  check(riis_valve_create("aortic", &valve));
  check(riis_surface_create(valve, NULL, &surface));
  check(riis_mesh_create(n_nodes, xyz, xyz + 1, xyz + 2, 3, &mesh));

  riis_mesh_cells cells;
  riis_adjacency *adjacency = NULL;
  riis_csr csr;
  check(riis_mesh_cells_init(&cells, sizeof cells)); /* 4 nodes per cell and 32 bits are the defaults */
  cells.n_nodes = n_nodes;
  cells.n_cells = n_cells;
  cells.node_ids = node_ids;
  cells.index_base = 1;
  check(riis_adjacency_create_from_cells(&cells, &adjacency));
  check(riis_adjacency_get_csr(adjacency, &csr, sizeof csr));
  check(riis_mesh_set_adjacency(mesh, &csr)); /* borrowed: the adjacency has to outlive the mesh */

  static const int32_t searches[2] = {RIIS_SEARCH_NEIGHBOR, RIIS_SEARCH_EXHAUSTIVE};
  static const char *const names[2] = {"neighbor", "exhaustive"};
  /* The marks are kept from step to step, because the neighbour search starts from the previously marked nodes. */
  riis_marks *marks[2] = {NULL, NULL};
  riis_mark_list marked[2];
  printf("%d nodes, %d tetrahedra\n", n_nodes, n_cells);
  for (int i = 0; i < 2; ++i) {
    riis_mark_options options;
    riis_mark_stats stats;
    check(riis_mark_options_init(&options, sizeof options));
    options.search = searches[i];
    check(riis_marks_create(&marks[i]));
    check(riis_mark_nodes(surface, mesh, &options, marks[i]));
    check(riis_marks_get_list(marks[i], RIIS_LIST_MARKED, &marked[i], sizeof marked[i]));
    check(riis_marks_get_stats(marks[i], &stats, sizeof stats));
    printf("%s search, marked: %lld, %s\n", names[i], (long long)marked[i].n_nodes,
           stats.complete ? "complete" : "perhaps not complete");
  }

  int same = marked[0].n_nodes == marked[1].n_nodes;
  for (int64_t i = 0; same && i < marked[0].n_nodes; ++i) {
    same = marked[0].node_id[i] == marked[1].node_id[i] && marked[0].distance[i] == marked[1].distance[i];
  }
  printf("nodes and distances: %s\n", same ? "the same, bit for bit" : "different");

  for (int i = 0; i < 2; ++i) riis_marks_destroy(&marks[i]);
  riis_mesh_destroy(&mesh);
  riis_adjacency_destroy(&adjacency);
  riis_surface_destroy(&surface);
  riis_valve_destroy(&valve);
  return same ? EXIT_SUCCESS : EXIT_FAILURE;
}
