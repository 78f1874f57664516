/* SPDX-License-Identifier: Apache-2.0
 * A mitral valve opens step by step by a law of opening. The program computes the resistance of every node to the flow
 * relative to the moving leaflets. The mesh is in metres and the valve in centimetres, so the scale is 0.01. */
#include <riis/riis.h>
#include <stdio.h>
#include <stdlib.h>

enum { n = 37, n_nodes = n * n * n, n_steps = 5 };
static double xyz[3 * n_nodes];      /* [m] a cube of 4.5 cm around the valve, a node every 1.25 mm */
static double coefficient[n_nodes];  /* [kg/(m^3 s)] K in the term K (u - u_surface) of the momentum equation */
static double momentum[3 * n_nodes]; /* [N/m^3] K u_surface, which goes to the right-hand side */
static const double R = 1e4;         /* [kg/(m s)] the resistance of the model, from literature or by calibration */
static const double eps = 1e-3;      /* [m] the half thickness */
static const double dt = 0.01;       /* [s] the time step */

static void check(riis_status status) {
  if (status == RIIS_OK) return;
  fprintf(stderr, "%s: %s\n", riis_status_name(status), riis_last_error());
  exit(EXIT_FAILURE);
}

int main(void) {
  for (int i = 0; i < n_nodes; ++i) {
    xyz[3 * i] = -0.0225 + 0.00125 * (i % n);
    xyz[3 * i + 1] = -0.0225 + 0.00125 * (i / n % n);
    xyz[3 * i + 2] = -0.02 + 0.00125 * (i / (n * n));
  }

  /* All objects of riis are made once, and every step reuses their memory. */
  riis_valve *valve = NULL, *valve_before = NULL;
  riis_surface *surface = NULL;
  riis_mesh *mesh = NULL;
  riis_marks *marks = NULL;
  check(riis_valve_create("mitral", &valve));
  check(riis_valve_set_scalar(valve, "opening", 0));
  check(riis_valve_copy(valve, &valve_before)); /* valve_before has the opening of the previous step */
  riis_surface_options options;
  check(riis_surface_options_init(&options, sizeof options));
  options.scale = 0.01;         /* centimetres to metres */
  options.half_thickness = eps; /* the unit is the mesh's */
  check(riis_surface_create(valve, &options, &surface));
  check(riis_mesh_create(n_nodes, xyz, xyz + 1, xyz + 2, 3, &mesh));
  check(riis_marks_create(&marks));
  riis_mark_options mark_options;
  check(riis_mark_options_init(&mark_options, sizeof mark_options));
  mark_options.fields = RIIS_FIELD_VELOCITY; /* the marks keep the surface's velocity at the nodes */
  riis_opening_times times; /* the valve opens at 0.45 s in 50 ms, and closes at 0.95 s, every second */
  check(riis_opening_times_init(&times, sizeof times));
  times.opening_start = 0.45;
  times.opening_duration = 0.05;
  times.closing_start = 0.95;
  times.closing_duration = 0.05;
  times.period = 1;
  riis_resistance resistance;
  check(riis_resistance_init(&resistance, sizeof resistance));
  resistance.R = R;

  riis_resistance_arrays arrays;
  check(riis_resistance_arrays_init(&arrays, sizeof arrays));
  arrays.n_nodes = n_nodes;
  arrays.K = coefficient;
  for (int c = 0; c < 3; ++c) arrays.K_u_surface[c] = momentum + c;
  arrays.K_u_surface_stride = 3;

  riis_mark_list marked = {.n_nodes = 0};
  for (int step = 0; step <= n_steps; ++step) {
    /* Resets only the nodes that the last step set. The list of marked nodes is valid until the next marking. */
    for (int64_t i = 0; i < marked.n_nodes; ++i) {
      coefficient[marked.node_id[i]] = 0;
      for (int c = 0; c < 3; ++c) momentum[3 * marked.node_id[i] + c] = 0;
    }

    const double time = times.opening_start + step * dt;
    /* In other laws the flow opens the valve: riis_opening_switch_advance and riis_opening_angle_advance. */
    double opening;
    check(riis_opening_from_times(&times, time, &opening, NULL));
    check(riis_valve_set_scalar(valve, "opening", opening));
    /* NULL: the surface keeps its options. */
    check(riis_surface_update_moving(surface, valve, valve_before, dt, NULL, NULL));
    check(riis_valve_set_scalar(valve_before, "opening", opening));
    check(riis_mark_nodes(surface, mesh, &mark_options, marks));
    check(riis_marks_add_resistance(marks, &resistance, &arrays));
    check(riis_marks_get_list(marks, RIIS_LIST_MARKED, &marked, sizeof marked));

    double sum = 0, maximum = 0, sum_z = 0;
    for (int i = 0; i < n_nodes; ++i) {
      sum += coefficient[i];
      if (coefficient[i] > maximum) maximum = coefficient[i];
      sum_z += momentum[3 * i + 2];
    }
    printf("%4.2f s, opening %5.3f, marked: %5lld, K: sum %.5E, maximum %.5E kg/(m^3 s), ", time, opening,
           (long long)marked.n_nodes, sum, maximum);
    printf("z of K u_surface: sum %+.5E N/m^3\n", sum_z);
  }

  riis_marks_destroy(&marks);
  riis_mesh_destroy(&mesh);
  riis_surface_destroy(&surface);
  riis_valve_destroy(&valve_before);
  riis_valve_destroy(&valve);
  return 0;
}
