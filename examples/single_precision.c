/* SPDX-License-Identifier: Apache-2.0
 * A solver in single precision. The solver's mesh moves, and the leaflets are the solver's own triangles. riis copies the
 * coordinates and converts them to double precision, so that the solver may change its arrays between calls. */
#include <riis/riis.h>
#include <stdio.h>
#include <stdlib.h>

enum { n = 21, n_nodes = n * n * n, n_fields = 4, n_steps = 3 };
static float xyz[3 * n_nodes];          /* [m] the nodes, every millimetre of a cube of 2 cm */
static double cell[n_fields * n_nodes]; /* the fields of each node side by side; K is the last of the four */
static float leaflet[12] = {-0.009f, -0.009f, 0, 0.009f, -0.009f, 0, 0.009f, 0.009f, 0, -0.009f, 0.009f, 0};
static const int32_t triangles[6] = {0, 1, 2, 0, 2, 3};

static void check(riis_status status) {
  if (status == RIIS_OK) return;
  fprintf(stderr, "%s: %s\n", riis_status_name(status), riis_last_error());
  exit(EXIT_FAILURE);
}

/* Describes points in single precision. */
static riis_points points_of(const float *all, int64_t n_points) {
  riis_points points;
  check(riis_points_init(&points, sizeof points));
  points.n_points = n_points;
  points.x = all, points.y = all + 1, points.z = all + 2;
  points.stride = 3;
  points.real_bits = 32;
  return points;
}

int main(void) {
  for (int i = 0; i < n_nodes; ++i) {
    xyz[3 * i] = -0.01f + 0.001f * (float)(i % n);
    xyz[3 * i + 1] = -0.01f + 0.001f * (float)(i / n % n);
    xyz[3 * i + 2] = -0.01f + 0.001f * (float)(i / (n * n));
  }
  riis_surface_arrays arrays;
  check(riis_surface_arrays_init(&arrays, sizeof arrays));
  arrays.n_vertices = 4;
  arrays.x = leaflet, arrays.y = leaflet + 1, arrays.z = leaflet + 2;
  arrays.stride = 3;
  arrays.real_bits = 32;
  arrays.n_faces = 2;
  arrays.vertex_ids = triangles;
  riis_surface_options options;
  check(riis_surface_options_init(&options, sizeof options));
  options.half_thickness = 1e-3;

  riis_surface *surface = NULL;
  riis_mesh *mesh = NULL;
  riis_marks *marks = NULL;
  check(riis_surface_create_from_arrays(&arrays, &options, &surface));
  riis_points nodes = points_of(xyz, n_nodes);
  check(riis_mesh_create_copy(&nodes, &mesh));
  check(riis_marks_create(&marks));
  riis_resistance resistance;
  check(riis_resistance_init(&resistance, sizeof resistance));
  resistance.R = 1e4;
  riis_resistance_arrays fields;
  check(riis_resistance_arrays_init(&fields, sizeof fields));
  fields.n_nodes = n_nodes;
  fields.K = cell + 3;
  fields.K_stride = n_fields; /* K of the next node lies four numbers further */

  for (int step = 0; step < n_steps; ++step) {
    for (int i = 0; i < 4; ++i) leaflet[3 * i + 2] = 0.002f * (float)step;      /* the leaflet rises */
    for (int i = 0; i < n_nodes; ++i) xyz[3 * i + 2] += step > 0 ? 0.0005f : 0; /* and so does the mesh */
    check(riis_surface_update_from_arrays(surface, &arrays, NULL));
    check(riis_mesh_update_copy(mesh, &nodes));
    check(riis_mark_nodes(surface, mesh, NULL, marks));
    for (int i = 0; i < n_nodes; ++i) cell[n_fields * i + 3] = 0;
    check(riis_marks_add_resistance(marks, &resistance, &fields));
    double sum = 0;
    for (int i = 0; i < n_nodes; ++i) sum += cell[n_fields * i + 3];
    riis_mark_stats stats;
    check(riis_marks_get_stats(marks, &stats, sizeof stats));
    printf("step %d: %d nodes marked, sum of K %.4E kg/(m^3 s)\n", step, (int)stats.n_marked, sum);
  }

  /* The distances of some nodes only. The entries of the other nodes are not written. */
  static double distance[n_nodes];
  static const int64_t wanted[3] = {0, n_nodes / 2, n_nodes - 1};
  riis_closest_options of_some;
  riis_closest_arrays written;
  check(riis_closest_options_init(&of_some, sizeof of_some));
  of_some.n_point_ids = 3;
  of_some.point_ids = wanted;
  check(riis_closest_arrays_init(&written, sizeof written));
  written.distance = distance;
  check(riis_closest_points(surface, &nodes, &of_some, &written));
  printf("distances %.3f, %.3f and %.3f mm\n", 1e3 * distance[wanted[0]], 1e3 * distance[wanted[1]],
         1e3 * distance[wanted[2]]);

  riis_marks_destroy(&marks);
  riis_mesh_destroy(&mesh);
  riis_surface_destroy(&surface);
  return 0;
}
