/* SPDX-License-Identifier: Apache-2.0
 * Marks the nodes of a box that are near the default coapting valve. Lengths are in cm, like the valve's default parameters. */
#include <riis/riis.h>
#include <stdio.h>
#include <stdlib.h>

enum { n = 27, n_nodes = n * n * n };
static double xyz[3 * n_nodes]; /* a cube of 3.25 cm around the origin, a node every 1.25 mm */

static void check(riis_status status) {
  if (status == RIIS_OK) return;
  fprintf(stderr, "%s: %s\n", riis_status_name(status), riis_last_error());
  exit(EXIT_FAILURE);
}

static void print_node(const double *node, double distance) {
  printf("(%6.3f, %6.3f, %6.3f) at %8.6f cm\n", node[0], node[1], node[2], distance);
}

int main(void) {
  for (int i = 0; i < n_nodes; ++i) {
    xyz[3 * i] = -1.625 + 0.125 * (i % n);
    xyz[3 * i + 1] = -1.625 + 0.125 * (i / n % n);
    xyz[3 * i + 2] = -1.625 + 0.125 * (i / (n * n));
  }

  riis_valve *valve = NULL;
  riis_surface *surface = NULL;
  riis_mesh *mesh = NULL;
  riis_marks *marks = NULL;

  check(riis_valve_create("coapting", &valve));
  check(riis_surface_create(valve, NULL, &surface)); /* half thickness 0.1 cm, tolerance 5 % of the half thickness */
  check(riis_mesh_create(n_nodes, xyz, xyz + 1, xyz + 2, 3, &mesh));
  check(riis_marks_create(&marks));
  check(riis_mark_nodes(surface, mesh, NULL, marks)); /* repeated in every time step */
  riis_mark_list marked;
  check(riis_marks_get_list(marks, RIIS_LIST_MARKED, &marked, sizeof marked));

  printf("%d nodes, marked: %lld, the first of them:\n", n_nodes, (long long)marked.n_nodes);
  int64_t closest = 0;
  for (int64_t i = 0; i < marked.n_nodes; ++i) {
    if (i < 5) print_node(xyz + 3 * marked.node_id[i], marked.distance[i]);
    if (marked.distance[i] < marked.distance[closest]) closest = i;
  }
  printf("and the closest:\n");
  if (marked.n_nodes > 0) print_node(xyz + 3 * marked.node_id[closest], marked.distance[closest]);

  riis_marks_destroy(&marks);
  riis_mesh_destroy(&mesh);
  riis_surface_destroy(&surface);
  riis_valve_destroy(&valve);
  return 0;
}
