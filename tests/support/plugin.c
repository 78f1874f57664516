/* SPDX-License-Identifier: Apache-2.0
 * Stands for a solver's plug-in: a shared object that links riis. A program loads the plug-in, calls it and unloads it. */
#include <riis/riis.h>

#include <stddef.h>

enum { n_side = 20, n_nodes = n_side * n_side * n_side };

int64_t plugin_mark(int32_t n_threads);

/* Marks a box of nodes around the aortic valve. Returns the number of marked nodes, or -1. */
int64_t plugin_mark(int32_t n_threads) {
  static double xyz[3 * n_nodes];
  riis_valve *valve = NULL;
  riis_surface *surface = NULL;
  riis_mesh *mesh = NULL;
  riis_marks *result = NULL;
  riis_mark_options options;
  int64_t n_marked = -1;
  for (int i = 0; i < n_nodes; ++i) {
    xyz[3 * i] = -1.5 + 3.0 / n_side * (i % n_side);
    xyz[3 * i + 1] = -1.5 + 3.0 / n_side * (i / n_side % n_side);
    xyz[3 * i + 2] = -1.5 + 3.0 / n_side * (i / (n_side * n_side));
  }
  if (!riis_mark_options_init(&options, sizeof options) && !riis_valve_create("aortic", &valve) &&
      !riis_surface_create(valve, NULL, &surface) && !riis_mesh_create(n_nodes, xyz, xyz + 1, xyz + 2, 3, &mesh) &&
      !riis_marks_create(&result)) {
    options.n_threads = n_threads;
    riis_mark_list marked;
    if (!riis_mark_nodes(surface, mesh, &options, result) &&
        !riis_marks_get_list(result, RIIS_LIST_MARKED, &marked, sizeof marked))
      n_marked = marked.n_nodes;
  }
  riis_marks_destroy(&result);
  riis_mesh_destroy(&mesh);
  riis_surface_destroy(&surface);
  riis_valve_destroy(&valve);
  return n_marked;
}
