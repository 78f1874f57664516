/* SPDX-License-Identifier: Apache-2.0
 * The pressure of the solver opens a valve. riis sums the pressure over the nodes on either side of the closed valve, and a law
 * of opening takes the difference of the means. Instead of a solver, this program has a pressure that falls downstream. */
#include <riis/riis.h>
#include <stdio.h>
#include <stdlib.h>

enum { n = 33, n_nodes = n * n * n, n_steps = 6 };
static double xyz[3 * n_nodes];   /* [m] a cube of 4 cm around the valve, a node every 1.25 mm */
static double pressure[n_nodes];  /* [Pa] */
static double volume[n_nodes];    /* [m^3] around each node; 0 for nodes of other ranks */
static const double eps = 1.5e-3; /* [m] the half thickness */
static const double dt = 0.01;    /* [s] */

static void check(riis_status status) {
  if (status == RIIS_OK) return;
  fprintf(stderr, "%s: %s\n", riis_status_name(status), riis_last_error());
  exit(EXIT_FAILURE);
}

int main(void) {
  for (int i = 0; i < n_nodes; ++i) {
    xyz[3 * i] = -0.02 + 0.00125 * (i % n);
    xyz[3 * i + 1] = -0.02 + 0.00125 * (i / n % n);
    xyz[3 * i + 2] = -0.01 + 0.00125 * (i / (n * n));
    volume[i] = 0.00125 * 0.00125 * 0.00125;
  }
  riis_valve *valve = NULL;
  riis_surface *surface = NULL;
  riis_mesh *mesh = NULL;
  riis_marks *marks = NULL;
  riis_surface_options options;
  check(riis_valve_create("trileaflet", &valve)); /* closed: its opening is 0 */
  check(riis_surface_options_init(&options, sizeof options));
  options.scale = 0.01;
  options.half_thickness = eps;
  check(riis_surface_create(valve, &options, &surface));
  check(riis_mesh_create(n_nodes, xyz, xyz + 1, xyz + 2, 3, &mesh));
  check(riis_marks_create(&marks));

  /* The band from one to two half thicknesses. The band of the pressure does not overlap the resistance, so its pressure is that
   * of the blood. */
  riis_mark_options marking;
  check(riis_mark_options_init(&marking, sizeof marking));
  marking.distance_limit = 2 * eps;
  marking.fields = RIIS_FIELD_SIDE + RIIS_FIELD_RIM;
  check(riis_mark_nodes(surface, mesh, &marking, marks));
  riis_band band;
  check(riis_band_init(&band, sizeof band));
  band.inner = eps;
  band.outer = 2 * eps;
  band.n_nodes = n_nodes;
  band.value = pressure;
  band.weight = volume;

  riis_opening_switch law;
  riis_opening_switch_state state;
  check(riis_opening_switch_init(&law, sizeof law));
  law.opening_duration = 0.04;
  law.closing_duration = 0.04;
  law.open_above = 100; /* [Pa] */
  check(riis_opening_switch_state_init(&state, sizeof state));
  for (int step = 1; step <= n_steps; ++step) {
    for (int i = 0; i < n_nodes; ++i) pressure[i] = -8000 * step * xyz[3 * i + 2];
    riis_band_sums sums; /* with MPI, add up the sums and weights of all ranks first */
    check(riis_marks_get_band_sums(marks, &band, &sums, sizeof sums));
    const double upstream = sums.sum[0] / sums.weight[0], downstream = sums.sum[1] / sums.weight[1];
    check(riis_opening_switch_advance(&law, &state, step * dt, upstream - downstream, 0, &state));
    printf("%.2f s: %d nodes upstream, %d downstream, %7.3f Pa, opening %.4f\n", state.time, (int)sums.n_nodes[0],
           (int)sums.n_nodes[1], upstream - downstream, state.opening);
    /* A solver now sets the valve's "opening", updates the surface and marks the mesh, as in opening_valve.c. While the valve is
     * open, the two sides are not defined, and the law closes the valve by the flow. */
  }

  riis_marks_destroy(&marks);
  riis_mesh_destroy(&mesh);
  riis_surface_destroy(&surface);
  riis_valve_destroy(&valve);
  return 0;
}
