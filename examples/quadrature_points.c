/* SPDX-License-Identifier: Apache-2.0
 * Computes resistances for a finite element code: K and K u_surface at the quadrature points of tetrahedra, and their
 * integrals with the shape functions. The quadrature points are the nodes of riis's mesh, which needs no adjacency. The
 * valve is half open and moves with the heart. The program checks that the integral of K is the area of the valve times
 * R/eps, and that K u_surface is K times the valve's velocity. Lengths are in metres. */
#include <math.h>
#include <riis/riis.h>
#include <stdio.h>
#include <stdlib.h>

enum { n = 33, n_nodes = n * n * n, n_cells = 6 * (n - 1) * (n - 1) * (n - 1), n_points = 4 * n_cells };
static double xyz[n_nodes][3];                        /* [m] a cube of 4.8 cm around the valve, a node every 1.5 mm */
static int node_ids[n_cells][4];                      /* four nodes per tetrahedron */
static double point[n_points][3];                     /* [m] four quadrature points per tetrahedron, of degree 2 */
static double weight[n_points];                       /* [m^3] each is a quarter of the tetrahedron's volume */
static double coefficient[n_points];                  /* [kg/(m^3 s)] K */
static double momentum[n_points][3];                  /* [N/m^3] K u_surface */
static double lumped[n_nodes];                        /* [kg/s] integral of K times the node's shape function */
static double right_hand_side[n_nodes][3];            /* [N] integral of K u_surface times the shape function */
static const double R = 1e4, eps = 1.5e-3, dt = 1e-3; /* [kg/(m s)], [m], [s] */
static const double speed[3] = {0, 0.01, 0.05};       /* [m/s] the heart's velocity */

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
    for (int c = 0; c < 3; ++c) xyz[node][c] = -0.024 + 0.0015 * (node / step[c] % n);
    if (node % n == n - 1 || node / n % n == n - 1 || node / (n * n) == n - 1) continue; /* no cube begins here */
    for (int i = 0; i < 6; ++i, ++cell) {
      node_ids[cell][0] = node;
      for (int j = 0; j < 3; ++j) node_ids[cell][j + 1] = node_ids[cell][j] + step[axes[i][j]];
    }
  }
}

/* Returns the shape function of corner a at quadrature point q of its tetrahedron. */
static double shape(int a, int q) { return a == q ? 0.58541019662496852 : 0.1381966011250105; }

static void make_points(void) {
  for (int i = 0; i < n_points; ++i) {
    weight[i] = 0.0015 * 0.0015 * 0.0015 / 6 / 4;
    for (int a = 0; a < 4; ++a)
      for (int c = 0; c < 3; ++c) point[i][c] += shape(a, i % 4) * xyz[node_ids[i / 4][a]][c];
  }
}

/* Adds K and K u_surface of all points to the nodes, as in the assembly of any element vector. */
static void assemble(void) {
  for (int i = 0; i < n_points; ++i) {
    for (int a = 0; a < 4; ++a) {
      const int node = node_ids[i / 4][a];
      lumped[node] += weight[i] * shape(a, i % 4) * coefficient[i];
      for (int c = 0; c < 3; ++c) right_hand_side[node][c] += weight[i] * shape(a, i % 4) * momentum[i][c];
    }
  }
}

int main(void) {
  make_tetrahedra();
  make_points();
  riis_valve *valve = NULL;
  riis_surface *surface = NULL;
  riis_mesh *mesh = NULL;
  riis_marks *marks = NULL;
  riis_surface_options options, before;
  check(riis_valve_create("mitral", &valve));
  check(riis_valve_set_scalar(valve, "opening", 0.5));
  check(riis_surface_options_init(&options, sizeof options));
  options.scale = 0.01; /* the valve is given in centimetres */
  options.half_thickness = eps;
  /* One time step ago, the valve was at another place. If the valve also opened, the call would need a second valve with the
   * earlier opening. */
  before = options;
  for (int c = 0; c < 3; ++c) before.translation[c] = -speed[c] * dt;
  check(riis_surface_create(valve, &options, &surface));
  check(riis_surface_update_moving(surface, valve, valve, dt, &options, &before));
  check(riis_mesh_create(n_points, point[0], point[0] + 1, point[0] + 2, 3, &mesh));
  check(riis_marks_create(&marks));

  riis_mark_options mark_options;
  riis_resistance resistance;
  check(riis_mark_options_init(&mark_options, sizeof mark_options));
  mark_options.fields = RIIS_FIELD_VELOCITY + RIIS_FIELD_RIM;
  check(riis_resistance_init(&resistance, sizeof resistance));
  resistance.R = R;
  resistance.rim = RIIS_RIM_CUT; /* the band ends at the free edges and at the annulus */
  check(riis_mark_nodes(surface, mesh, &mark_options, marks));
  riis_resistance_arrays arrays;
  check(riis_resistance_arrays_init(&arrays, sizeof arrays));
  arrays.n_nodes = n_points;
  arrays.K = coefficient;
  for (int c = 0; c < 3; ++c) arrays.K_u_surface[c] = momentum[0] + c;
  arrays.K_u_surface_stride = 3;
  check(riis_marks_add_resistance(marks, &resistance, &arrays));
  assemble();

  double sum = 0, force[3] = {0, 0, 0};
  for (int i = 0; i < n_nodes; ++i) {
    sum += lumped[i];
    for (int c = 0; c < 3; ++c) force[c] += right_hand_side[i][c];
  }
  riis_surface_info info;
  check(riis_surface_get_info(surface, &info, sizeof info));
  const double expected = R / eps * info.area;
  printf("%d quadrature points in %d tetrahedra\n", n_points, n_cells);
  printf("sum of K %.4E kg/s, area * R/eps %.4E kg/s\n", sum, expected);
  printf("sum of K u_surface %.4E %.4E N along y and z\n", force[1], force[2]);
  int is_right = fabs(sum / expected - 1) < 0.01;
  for (int c = 0; c < 3; ++c) is_right = is_right && fabs(force[c] - sum * speed[c]) < 1e-9 * sum * speed[2];
  if (!is_right) fprintf(stderr, "the sums are off\n");

  riis_marks_destroy(&marks);
  riis_mesh_destroy(&mesh);
  riis_surface_destroy(&surface);
  riis_valve_destroy(&valve);
  return is_right ? 0 : EXIT_FAILURE;
}
