/* SPDX-License-Identifier: Apache-2.0
 * A mitral valve that opens step by step, and the resistance of every node to the flow through it. The mesh is in metres, the
 * valve's tables are in centimetres, so the scale is 0.01. */
#include <math.h>
#include <riis/riis.h>
#include <stdio.h>
#include <stdlib.h>

enum { n = 37, n_nodes = n * n * n, n_steps = 5 };
static double xyz[3 * n_nodes];    /* [m] a cube of 4.5 cm around the valve, a node every 1.25 mm */
static double resistance[n_nodes]; /* [kg/(m^3 s)]; times the flow's velocity relative to the valve: N/m^3 against it */
static const double R = 1e4;       /* [kg/(m s)] of the model, from its literature or by calibration */
static const double eps = 1e-3;    /* [m] the half thickness */

static void check(riis_status status) {
  if (status == RIIS_OK) return;
  fprintf(stderr, "%s: %s\n", riis_status_name(status), riis_last_error());
  exit(EXIT_FAILURE);
}

/* [1/m] The delta function smeared over the band: its integral from -eps to eps is 1. */
static double delta(double distance) {
  return distance <= eps ? (1 + cos(acos(-1.0) * distance / eps)) / (2 * eps) : 0;
}

int main(void) {
  for (int i = 0; i < n_nodes; ++i) {
    xyz[3 * i] = -0.0225 + 0.00125 * (i % n);
    xyz[3 * i + 1] = -0.0225 + 0.00125 * (i / n % n);
    xyz[3 * i + 2] = -0.02 + 0.00125 * (i / (n * n));
  }

  /* These are made once, and every step reuses their memory. */
  riis_valve *valve = NULL;
  riis_surface *surface = NULL;
  riis_mesh *mesh = NULL;
  riis_mark_result *result = NULL;
  riis_surface_options options;
  check(riis_valve_create("mitral", &valve));
  check(riis_surface_options_init(&options, sizeof options));
  options.scale = 0.01;         /* centimetres to metres */
  options.half_thickness = eps; /* in the mesh's unit */
  check(riis_surface_create(valve, &options, &surface));
  check(riis_mesh_create(n_nodes, xyz, xyz + 1, xyz + 2, 3, &mesh));
  check(riis_mark_result_create(&result));

  int64_t n_marked = 0;
  const int64_t *node_id = NULL;
  const double *distance = NULL;
  for (int step = 0; step <= n_steps; ++step) {
    /* Resets only the nodes that the last step set. Their list lives until the next marking into the result. */
    for (int64_t i = 0; i < n_marked; ++i) resistance[node_id[i]] = 0;

    check(riis_valve_set_scalar(valve, "opening", (double)step / n_steps)); /* a solver has a function of time */
    check(riis_surface_update(surface, valve, NULL));                       /* NULL: the surface keeps its options */
    check(riis_mark_nodes(surface, mesh, NULL, result));
    check(riis_mark_result_marked(result, &n_marked, &node_id, &distance, NULL, NULL));
    for (int64_t i = 0; i < n_marked; ++i) resistance[node_id[i]] = R / eps * delta(distance[i]);

    double sum = 0, maximum = 0;
    for (int i = 0; i < n_nodes; ++i) {
      sum += resistance[i];
      if (resistance[i] > maximum) maximum = resistance[i];
    }
    printf("opening %3.1f, marked: %5lld, resistance: sum %.5E, maximum %.5E kg/(m^3 s)\n", (double)step / n_steps,
           (long long)n_marked, sum, maximum);
  }

  riis_mark_result_destroy(&result);
  riis_mesh_destroy(&mesh);
  riis_surface_destroy(&surface);
  riis_valve_destroy(&valve);
  return 0;
}
