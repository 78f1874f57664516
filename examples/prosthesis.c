/* SPDX-License-Identifier: Apache-2.0
 * Makes a user-defined valve, a bioprosthesis of three cusps, from control points, and marks it while it opens. Lengths are in
 * cm.
 *
 * The ring of radius 1.2 lies at z = 0, and blood flows to +z. The tips of the posts, the commissures, are at z = 1.2. A leaflet
 * consists of two patches. The two halves meet at the leaflet's middle line, which runs from the ring to the free edge. Each
 * patch lies between two curves from a commissure to the middle line. The attachment at v = 0 runs down the post to the ring. The
 * curve at v = 1 is half of the free edge. The patch's side at the commissure is a point, so the patch consists of straight lines
 * from the attachment to the free edge. When the valve opens, only the free edges and the middle lines move.
 *
 * When the valve is closed, each half of a free edge runs from its commissure to the axis. The curve has the same control points
 * as the adjacent half of the neighbouring leaflet, so the leaflets meet without a hole. All control points of a leaflet lie in
 * its third of the ring, at every opening. A third is convex, so the whole leaflet stays in it, and leaflets never cross. */
#include <riis/riis.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { n = 27, n_nodes = n * n * n };
static double xyz[3 * n_nodes]; /* a cube of 3.25 cm around the prosthesis, a node every 1.25 mm */

/* Control points of the closed valve: curves 0 to 5 are the free edges, and 6 to 8 the middle lines. */
static const double closed_moving[][3] = {
    {0.60, -1.04, 1.20},  {0.45, -0.78, 1.00}, {0.30, -0.52, 0.80}, {0.00, 0.00, 0.80}, /* edge 0a */
    {0.60, 1.04, 1.20},   {0.45, 0.78, 1.00},  {0.30, 0.52, 0.80},  {0.00, 0.00, 0.80}, /* edge 0b */
    {0.60, 1.04, 1.20},   {0.45, 0.78, 1.00},  {0.30, 0.52, 0.80},  {0.00, 0.00, 0.80}, /* edge 1a */
    {-1.20, 0.00, 1.20},  {-0.90, 0.00, 1.00}, {-0.60, 0.00, 0.80}, {0.00, 0.00, 0.80}, /* edge 1b */
    {-1.20, 0.00, 1.20},  {-0.90, 0.00, 1.00}, {-0.60, 0.00, 0.80}, {0.00, 0.00, 0.80}, /* edge 2a */
    {0.60, -1.04, 1.20},  {0.45, -0.78, 1.00}, {0.30, -0.52, 0.80}, {0.00, 0.00, 0.80}, /* edge 2b */
    {1.20, 0.00, 0.00},   {0.00, 0.00, 0.80},                                           /* middle 0 */
    {-0.60, 1.04, 0.00},  {0.00, 0.00, 0.80},                                           /* middle 1 */
    {-0.60, -1.04, 0.00}, {0.00, 0.00, 0.80},                                           /* middle 2 */
};
/* Control points of the same nine curves for the open valve. */
static const double open_moving[][3] = {
    {0.60, -1.04, 1.20},  {0.87, -0.80, 1.20},  {1.05, -0.37, 1.20},  {1.05, 0.00, 1.20},   /* edge 0a */
    {0.60, 1.04, 1.20},   {0.87, 0.80, 1.20},   {1.05, 0.37, 1.20},   {1.05, 0.00, 1.20},   /* edge 0b */
    {0.60, 1.04, 1.20},   {0.26, 1.15, 1.20},   {-0.20, 1.09, 1.20},  {-0.52, 0.91, 1.20},  /* edge 1a */
    {-1.20, 0.00, 1.20},  {-1.13, 0.35, 1.20},  {-0.85, 0.72, 1.20},  {-0.52, 0.91, 1.20},  /* edge 1b */
    {-1.20, 0.00, 1.20},  {-1.13, -0.35, 1.20}, {-0.85, -0.72, 1.20}, {-0.52, -0.91, 1.20}, /* edge 2a */
    {0.60, -1.04, 1.20},  {0.26, -1.15, 1.20},  {-0.20, -1.09, 1.20}, {-0.52, -0.91, 1.20}, /* edge 2b */
    {1.20, 0.00, 0.00},   {1.05, 0.00, 1.20},                                               /* middle 0 */
    {-0.60, 1.04, 0.00},  {-0.52, 0.91, 1.20},                                              /* middle 1 */
    {-0.60, -1.04, 0.00}, {-0.52, -0.91, 1.20},                                             /* middle 2 */
};
/* These control points do not move. Curves 9 to 14 are the attachments. Curves 15 to 17 are the commissures: each is a line from
 * a point to itself. */
static const double fixed[][3] = {
    {0.60, -1.04, 1.20}, {1.00, -0.81, 0.40},  {1.20, -0.40, 0.00},  {1.20, 0.00, 0.00},   /* attachment 0a */
    {0.60, 1.04, 1.20},  {1.00, 0.81, 0.40},   {1.20, 0.40, 0.00},   {1.20, 0.00, 0.00},   /* attachment 0b */
    {0.60, 1.04, 1.20},  {0.20, 1.27, 0.40},   {-0.25, 1.24, 0.00},  {-0.60, 1.04, 0.00},  /* attachment 1a */
    {-1.20, 0.00, 1.20}, {-1.20, 0.46, 0.40},  {-0.95, 0.84, 0.00},  {-0.60, 1.04, 0.00},  /* attachment 1b */
    {-1.20, 0.00, 1.20}, {-1.20, -0.46, 0.40}, {-0.95, -0.84, 0.00}, {-0.60, -1.04, 0.00}, /* attachment 2a */
    {0.60, -1.04, 1.20}, {0.20, -1.27, 0.40},  {-0.25, -1.24, 0.00}, {-0.60, -1.04, 0.00}, /* attachment 2b */
    {0.60, -1.04, 1.20}, {0.60, -1.04, 1.20},                                              /* commissure 0 */
    {0.60, 1.04, 1.20},  {0.60, 1.04, 1.20},                                               /* commissure 1 */
    {-1.20, 0.00, 1.20}, {-1.20, 0.00, 1.20},                                              /* commissure 2 */
};

static const int32_t degree[] = {3, 3, 3, 3, 3, 3, 1, 1, 1, 3, 3, 3, 3, 3, 3, 1, 1, 1};
/* The curves at v = 0, v = 1, u = 0, u = 1 of each half leaflet, and whether a side runs opposite to its curve. */
static const int32_t curve_id[][4] = {{9, 0, 15, 6},  {10, 1, 6, 16}, {11, 2, 16, 7},
                                      {12, 3, 7, 17}, {13, 4, 17, 8}, {14, 5, 8, 15}};
static const int32_t reversed[][4] = {{0, 0, 0, 0}, {1, 1, 0, 0}, {0, 0, 0, 0},
                                      {1, 1, 0, 0}, {0, 0, 0, 0}, {1, 1, 0, 0}};
static const int32_t leaflet_id[] = {0, 0, 1, 1, 2, 2};

static void check(riis_status status) {
  if (status == RIIS_OK) return;
  fprintf(stderr, "%s: %s\n", riis_status_name(status), riis_last_error());
  exit(EXIT_FAILURE);
}

static riis_valve *valve_with(const double (*moving)[3]) {
  double control[60][3];
  memcpy(control, moving, sizeof closed_moving);
  memcpy(control + 30, fixed, sizeof fixed);

  riis_patches patches;
  riis_valve *valve = NULL;
  check(riis_patches_init(&patches, sizeof patches));
  patches.n_curves = 18;
  patches.degree = degree;
  patches.control = control[0];
  patches.n_patches = 6;
  patches.curve_id = curve_id[0];
  patches.reversed = reversed[0];
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

  riis_valve *valve = valve_with(closed_moving), *open = valve_with(open_moving);
  riis_surface *surface = NULL;
  riis_mesh *mesh = NULL;
  riis_marks *result = NULL;
  check(riis_valve_set_open_state(valve, open));
  riis_valve_destroy(&open); /* the valve has copied it */
  check(riis_surface_create(valve, NULL, &surface));
  check(riis_mesh_create(n_nodes, xyz, xyz + 1, xyz + 2, 3, &mesh));
  check(riis_marks_create(&result));

  printf("%d nodes\n", n_nodes);
  for (int step = 0; step <= 2; ++step) {
    riis_mark_list marked;
    check(riis_valve_set_scalar(valve, "opening", 0.5 * step)); /* moves the valve */
    check(riis_surface_update(surface, valve, NULL));
    check(riis_mark_nodes(surface, mesh, NULL, result));
    check(riis_marks_get_list(result, RIIS_LIST_MARKED, &marked, sizeof marked));
    printf("opening %3.1f, marked: %lld\n", 0.5 * step, (long long)marked.n_nodes);
  }

  riis_marks_destroy(&result);
  riis_mesh_destroy(&mesh);
  riis_surface_destroy(&surface);
  riis_valve_destroy(&valve);
  return 0;
}
