/* SPDX-License-Identifier: Apache-2.0
 * A valve of one's own: a bioprosthesis of three cusps from control points, marked while it opens. Lengths are in cm.
 *
 * The ring, of radius 1.2, lies at z = 0; blood flows to +z; the tips of the posts, the commissures, are at z = 1.2. A
 * cusp is one patch between two curves that run counter-clockwise from commissure to commissure: at v = 0 its
 * attachment, down one post to the ring and up the next; at v = 1 its free edge. The sides u = 0 and u = 1 are
 * collapsed to the commissures, so the cusp consists of straight lines from the attachment to the free edge. To open,
 * only the free edges move. Closed, they pass the axis within 0.08, less than the half thickness: the marked valve is
 * tight. */
#include <riis/riis.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { n = 27, n_nodes = n * n * n };
static double xyz[3 * n_nodes]; /* a cube of 3.25 cm around the prosthesis, a node every 1.25 mm */

/* Control points of curves 0 to 2, the free edges, closed, */
static const double closed_edges[][3] = {
    {0.60, -1.04, 1.20}, {-0.10, 0.00, 0.90}, {-0.10, 0.00, 0.90}, {0.60, 1.04, 1.20},
    {0.60, 1.04, 1.20},  {0.05, -0.09, 0.90}, {0.05, -0.09, 0.90}, {-1.20, 0.00, 1.20},
    {-1.20, 0.00, 1.20}, {0.05, 0.09, 0.90},  {0.05, 0.09, 0.90},  {0.60, -1.04, 1.20},
};
/* and open; */
static const double open_edges[][3] = {
    {0.60, -1.04, 1.20}, {1.13, -0.60, 1.20},  {1.13, 0.60, 1.20},   {0.60, 1.04, 1.20},
    {0.60, 1.04, 1.20},  {-0.05, 1.28, 1.20},  {-1.08, 0.68, 1.20},  {-1.20, 0.00, 1.20},
    {-1.20, 0.00, 1.20}, {-1.08, -0.68, 1.20}, {-0.05, -1.28, 1.20}, {0.60, -1.04, 1.20},
};
/* of curves 3 to 5, the attachments; */
static const double attachments[][3] = {
    {0.60, -1.04, 1.20}, {1.40, -0.58, -0.40},  {1.40, 0.58, -0.40},   {0.60, 1.04, 1.20},
    {0.60, 1.04, 1.20},  {-0.20, 1.50, -0.40},  {-1.20, 0.92, -0.40},  {-1.20, 0.00, 1.20},
    {-1.20, 0.00, 1.20}, {-1.20, -0.92, -0.40}, {-0.20, -1.50, -0.40}, {0.60, -1.04, 1.20},
};
/* of curves 6 to 8, the commissures: lines from a point to itself. */
static const double commissures[][3] = {
    {0.60, -1.04, 1.20}, {0.60, -1.04, 1.20}, {0.60, 1.04, 1.20},
    {0.60, 1.04, 1.20},  {-1.20, 0.00, 1.20}, {-1.20, 0.00, 1.20},
};

static const int32_t degree[] = {3, 3, 3, 3, 3, 3, 1, 1, 1};
static const int32_t curve_id[] = {3, 0, 6, 7, 4, 1, 7, 8, 5, 2, 8, 6}; /* at v = 0, v = 1, u = 0, u = 1 of each cusp */
static const int32_t leaflet_id[] = {0, 1, 2};

static void check(riis_status status) {
  if (status == RIIS_OK) return;
  fprintf(stderr, "%s: %s\n", riis_status_name(status), riis_last_error());
  exit(EXIT_FAILURE);
}

static riis_valve *valve_with(const double (*free_edges)[3]) {
  double control[30][3];
  memcpy(control, free_edges, sizeof closed_edges);
  memcpy(control + 12, attachments, sizeof attachments);
  memcpy(control + 24, commissures, sizeof commissures);

  riis_patches patches;
  riis_valve *valve = NULL;
  check(riis_patches_init(&patches, sizeof patches));
  patches.n_curves = 9;
  patches.degree = degree;
  patches.control = control[0];
  patches.n_patches = 3;
  patches.curve_id = curve_id;
  patches.leaflet_id = leaflet_id;
  check(riis_valve_create_from_patches(&patches, &valve));
  return valve;
}

int main(void) {
  for (int i = 0; i < n_nodes; ++i) {
    xyz[3 * i] = -1.625 + 0.125 * (i % n);
    xyz[3 * i + 1] = -1.625 + 0.125 * (i / n % n);
    xyz[3 * i + 2] = -1 + 0.125 * (i / (n * n));
  }

  riis_valve *valve = valve_with(closed_edges), *open = valve_with(open_edges);
  riis_surface *surface = NULL;
  riis_mesh *mesh = NULL;
  riis_mark_result *result = NULL;
  check(riis_valve_set_open_state(valve, open));
  riis_valve_destroy(&open); /* it was copied */
  check(riis_surface_create(valve, NULL, &surface));
  check(riis_mesh_create(n_nodes, xyz, xyz + 1, xyz + 2, 3, &mesh));
  check(riis_mark_result_create(&result));

  printf("%d nodes\n", n_nodes);
  for (int step = 0; step <= 2; ++step) {
    int64_t n_marked = 0;
    check(riis_valve_set_scalar(valve, "opening", 0.5 * step)); /* the valve moves */
    check(riis_surface_update(surface, valve, NULL));
    check(riis_mark_nodes(surface, mesh, NULL, result));
    check(riis_mark_result_marked(result, &n_marked, NULL, NULL, NULL, NULL));
    printf("opening %3.1f, marked: %lld\n", 0.5 * step, (long long)n_marked);
  }

  riis_mark_result_destroy(&result);
  riis_mesh_destroy(&mesh);
  riis_surface_destroy(&surface);
  riis_valve_destroy(&valve);
  return 0;
}
