/* SPDX-License-Identifier: Apache-2.0
 * Computes resistances for a finite volume code: K of every cell, at the cell's centre. The cell centres are the nodes of
 * riis's mesh, which needs no adjacency. The program checks that the integral of K over the cells is the area of the valve
 * times R/eps. Lengths are in metres. */
#include <math.h>
#include <riis/riis.h>
#include <stdio.h>
#include <stdlib.h>

enum { n = 64, n_cells = n * n * n };
/* [m] centres of the cells, each 0.75 mm wide, in a cube of 4.8 cm around the valve. */
static double centre[3 * n_cells];
static double
    coefficient[n_cells]; /* [kg/(m^3 s)] K of each cell; a scheme adds K V u to the cell's momentum balance */
static const double width = 0.00075; /* [m] of a cell */
static const double R = 1e4;         /* [kg/(m s)] the resistance of the model */
static const double eps = 1e-3;      /* [m] the half thickness */

static void check(riis_status status) {
  if (status == RIIS_OK) return;
  fprintf(stderr, "%s: %s\n", riis_status_name(status), riis_last_error());
  exit(EXIT_FAILURE);
}

int main(void) {
  for (int i = 0; i < n_cells; ++i) {
    centre[3 * i] = -0.024 + width * (i % n + 0.5);
    centre[3 * i + 1] = -0.024 + width * (i / n % n + 0.5);
    centre[3 * i + 2] = -0.024 + width * (i / (n * n) + 0.5);
  }

  riis_valve *valve = NULL;
  riis_surface *surface = NULL;
  riis_mesh *mesh = NULL;
  riis_marks *marks = NULL;
  riis_surface_options options;
  check(riis_valve_create("mitral", &valve));
  check(riis_valve_set_scalar(valve, "opening", 0)); /* closed */
  check(riis_surface_options_init(&options, sizeof options));
  options.scale = 0.01; /* the valve is given in centimetres */
  options.half_thickness = eps;
  check(riis_surface_create(valve, &options, &surface));
  check(riis_mesh_create(n_cells, centre, centre + 1, centre + 2, 3, &mesh));
  check(riis_marks_create(&marks));

  /* With a round rim, the band would have half a tube around the free edges and the annulus. With a cut rim, the band ends at the
   * free edges and the annulus. */
  riis_mark_options mark_options;
  riis_resistance resistance;
  check(riis_mark_options_init(&mark_options, sizeof mark_options));
  mark_options.fields = RIIS_FIELD_RIM;
  check(riis_resistance_init(&resistance, sizeof resistance));
  resistance.R = R;
  resistance.rim = RIIS_RIM_CUT;
  check(riis_mark_nodes(surface, mesh, &mark_options, marks));
  riis_resistance_arrays arrays;
  check(riis_resistance_arrays_init(&arrays, sizeof arrays));
  arrays.n_nodes = n_cells;
  arrays.K = coefficient;
  check(riis_marks_add_resistance(marks, &resistance, &arrays));

  int n_resisting = 0;
  double integral = 0; /* integral of K over the cells */
  for (int i = 0; i < n_cells; ++i) {
    n_resisting += coefficient[i] > 0;
    integral += coefficient[i] * width * width * width;
  }
  riis_surface_info info;
  check(riis_surface_get_info(surface, &info, sizeof info));
  const double expected = R / eps * info.area;
  printf("%d cells, %d resist\n", n_cells, n_resisting);
  printf("integral of K %.4E kg/s, area * R/eps %.4E kg/s\n", integral, expected);

  riis_marks_destroy(&marks);
  riis_mesh_destroy(&mesh);
  riis_surface_destroy(&surface);
  riis_valve_destroy(&valve);
  if (fabs(integral / expected - 1) > 0.01) {
    fprintf(stderr, "the integral of K is off by more than 1 %%\n");
    return EXIT_FAILURE;
  }
  return 0;
}
