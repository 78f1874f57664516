/* SPDX-License-Identifier: Apache-2.0
 * c_marks COORDINATES OUTPUT OFFSET: marks nodes in C. The tests of the Python package compare its marks with theirs. Reads xyz
 * as doubles. Marks nodes around the mitral valve, which moves from opening 0.3 to 0.4 in 0.05 s. Writes the marks as raw arrays.
 * The number of marked nodes, ids, distances, triangles, leaflets, normals and velocities come first. K and K u of all nodes
 * follow. With an offset, the heights of the marked nodes come last. */
#include <riis/riis.h>
#include <stdio.h>
#include <stdlib.h>

static void check(riis_status status) {
  if (!status) return;
  fprintf(stderr, "%s: %s\n", riis_status_name(status), riis_last_error());
  exit(1);
}

static void require(int holds, const char *what) {
  if (holds) return;
  fprintf(stderr, "c_marks: %s\n", what);
  exit(1);
}

static double *read_coordinates(const char *path, int64_t *n_nodes) {
  FILE *file = fopen(path, "rb");
  require(file && fseek(file, 0, SEEK_END) == 0, "the coordinates cannot be read");
  const long size = ftell(file);
  require(size > 0 && size % 24 == 0, "the coordinates are no points");
  rewind(file);
  double *xyz = malloc((size_t)size);
  require(xyz && fread(xyz, 1, (size_t)size, file) == (size_t)size, "the coordinates cannot be read");
  fclose(file);
  *n_nodes = size / 24;
  return xyz;
}

static void put(FILE *file, const void *data, size_t size, int64_t n) {
  require(fwrite(data, size, (size_t)n, file) == (size_t)n, "the output cannot be written");
}

int main(int n_arguments, char **arguments) {
  riis_valve *valve = NULL, *before = NULL;
  riis_surface *surface = NULL;
  riis_mesh *mesh = NULL;
  riis_marks *marks = NULL;
  riis_surface_options surface_options;
  riis_mark_options options;
  riis_resistance model;
  riis_resistance_arrays arrays;
  riis_mark_list marked;
  int64_t n_nodes = 0;
  require(n_arguments == 4, "usage: c_marks COORDINATES OUTPUT OFFSET");
  double *xyz = read_coordinates(arguments[1], &n_nodes);
  double *coefficient = calloc((size_t)n_nodes, 8), *momentum = calloc(3 * (size_t)n_nodes, 8);
  FILE *file = fopen(arguments[2], "wb");
  require(file && coefficient && momentum, "no memory, or the output cannot be opened");

  check(riis_valve_create("mitral", &valve));
  check(riis_valve_copy(valve, &before));
  check(riis_valve_set_scalar(before, "opening", 0.3));
  check(riis_valve_set_scalar(valve, "opening", 0.4));
  check(riis_surface_options_init(&surface_options, sizeof surface_options));
  surface_options.half_thickness = 0.15;
  surface_options.offset = strtod(arguments[3], NULL);
  check(riis_surface_create(valve, &surface_options, &surface));
  check(riis_surface_update_moving(surface, valve, before, 0.05, NULL, NULL));
  check(riis_mesh_create(n_nodes, xyz, xyz + 1, xyz + 2, 3, &mesh));
  check(riis_marks_create(&marks));
  check(riis_mark_options_init(&options, sizeof options));
  options.fields = RIIS_FIELD_NORMAL | RIIS_FIELD_VELOCITY;
  check(riis_mark_nodes(surface, mesh, &options, marks));
  check(riis_marks_get_list(marks, RIIS_LIST_MARKED, &marked, sizeof marked));
  check(riis_resistance_init(&model, sizeof model));
  model.R = 1e4;
  check(riis_resistance_arrays_init(&arrays, sizeof arrays));
  arrays.n_nodes = n_nodes;
  arrays.K = coefficient;
  for (int c = 0; c < 3; ++c) arrays.K_u_surface[c] = momentum + c;
  arrays.K_u_surface_stride = 3;
  check(riis_marks_add_resistance(marks, &model, &arrays));

  const int64_t n = marked.n_nodes;
  put(file, &n, 8, 1);
  put(file, marked.node_id, 8, n);
  put(file, marked.distance, 8, n);
  put(file, marked.triangle_id, 8, n);
  put(file, marked.leaflet_id, 4, n);
  put(file, marked.normal, 8, 3 * n);
  put(file, marked.velocity, 8, 3 * n);
  put(file, coefficient, 8, n_nodes);
  put(file, momentum, 8, 3 * n_nodes);
  require(!marked.height == (surface_options.offset == 0), "heights come with an offset");
  if (marked.height) put(file, marked.height, 8, n);
  require(fclose(file) == 0, "the output cannot be written");
  riis_marks_destroy(&marks);
  riis_mesh_destroy(&mesh);
  riis_surface_destroy(&surface);
  riis_valve_destroy(&before);
  riis_valve_destroy(&valve);
  free(xyz);
  free(coefficient);
  free(momentum);
  return 0;
}
