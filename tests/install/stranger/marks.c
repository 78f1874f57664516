/* SPDX-License-Identifier: Apache-2.0
 * Prints the nodes that the half-open mitral valve marks in a box, and the bits of their distances. The programs in C++, Fortran
 * and Python print the same, with every installation of riis. */
#include <inttypes.h>
#include <riis/riis.h>
#include <stdio.h>
#include <string.h>

enum { n = 41, n_nodes = n * n * n };
static double xyz[3 * n_nodes]; /* a cube of 5 cm around the origin */

static int failed(void) {
  fprintf(stderr, "%s\n", riis_last_error());
  return 1;
}

int main(void) {
  riis_valve *valve = NULL;
  riis_surface *surface = NULL;
  riis_mesh *mesh = NULL;
  riis_marks *marks = NULL;
  riis_mark_list marked;
  for (int i = 0; i < n_nodes; ++i) {
    xyz[3 * i] = -2.5 + 0.125 * (i % n);
    xyz[3 * i + 1] = -2.5 + 0.125 * (i / n % n);
    xyz[3 * i + 2] = -2.5 + 0.125 * (i / (n * n));
  }
  if (riis_valve_create("mitral", &valve) || riis_valve_set_scalar(valve, "opening", 0.5) ||
      riis_surface_create(valve, NULL, &surface) || riis_mesh_create(n_nodes, xyz, xyz + 1, xyz + 2, 3, &mesh) ||
      riis_marks_create(&marks) || riis_mark_nodes(surface, mesh, NULL, marks) ||
      riis_marks_get_list(marks, RIIS_LIST_MARKED, &marked, sizeof marked))
    return failed();
  for (int64_t i = 0; i < marked.n_nodes; ++i) {
    uint64_t bits;
    memcpy(&bits, &marked.distance[i], sizeof bits);
    printf("%" PRId64 " %016" PRIX64 "\n", marked.node_id[i], bits);
  }
  riis_marks_destroy(&marks);
  riis_mesh_destroy(&mesh);
  riis_surface_destroy(&surface);
  riis_valve_destroy(&valve);
  return 0;
}
